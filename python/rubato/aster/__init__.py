# SPDX-License-Identifier: LGPL-3.0-or-later
"""Code_Aster studies: `python3 -m rubato.aster study.comm` or `study.export`.

A command file is a Python program and runs with its user's rights, in a process of its own with limits on time and
memory. docs/guide/aster.md has the commands and keywords that there are, and what is done otherwise.
"""
