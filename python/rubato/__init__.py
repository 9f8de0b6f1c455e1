# SPDX-License-Identifier: LGPL-3.0-or-later
"""Nonlinear structural dynamics with frictional contact.

A Study says what is computed: load() reads one from a deck, or a program makes it of its parts. Model is its
discrete problem, Simulation advances it through time, run() does that with a folder of results, which open_run()
reads. Mesh has nodes, cells and groups. Arrays are numpy's; those of meshes and states are views that cannot be
written. Bad input raises InputError with the sentences of the program.
"""

from . import _rubato
from ._errors import Fault, InputError, StepError
from ._records import Record, records as _records, words as _words
from ._rubato import *  # noqa: F403
from ._stored import StoredRun, open_run

globals().update(_words)
globals().update(_records)

__version__ = _rubato.__version__
_written = {"Fault", "InputError", "Record", "StepError", "StoredRun", "open_run"}
_compiled = {name for name in vars(_rubato) if not name.startswith("_")}
__all__ = sorted(_written | _compiled | set(_words) | set(_records))
