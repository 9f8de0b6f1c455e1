# SPDX-License-Identifier: LGPL-3.0-or-later
"""From concepts of a command file to a rubato.Study, and its solution.

problem.py has what is being made; cells.py, supports.py, loads.py, relations.py, discrete.py, contact.py and
temperature.py each make a part of the study of it; nonlinear.py and linear.py solve.
"""
