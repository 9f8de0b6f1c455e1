# SPDX-License-Identifier: LGPL-3.0-or-later
"""The commands, a file for each kind of them; catalogue.py has the whole table."""
