# SPDX-License-Identifier: LGPL-3.0-or-later
"""Command files import these modules: `aster` (the supervisor's exceptions), `code_aster` (the form of 15.x), `aster_core`
and parts of `Utilitai`."""

from __future__ import annotations

import sys
import types
import unittest
from typing import Any

from .concepts import TableConcept
from .extracted import ExtractedTable
from .keys import CommandError


class NotConverged(CommandError):
    """A step was not solved. Code_Aster: aster.NonConvergenceError. `result`: what was solved up to there."""

    exit_code = 3

    def __init__(self, text: str, id_message: str = "", result: Any = None):
        super().__init__(text, id_message)
        self.result = result


class TimeLimit(CommandError):
    """Code_Aster: aster.ArretCPUError."""

    exit_code = 4


class TestCase(unittest.TestCase):
    """code_aster.TestCase: assertions of a file; the first that does not hold ends it."""

    __test__ = False

    def runTest(self) -> None:
        """There is nothing to run: assertions are called by the file."""

    def printSummary(self) -> None:
        print("assertions of the file hold")


def install_modules(names: dict[str, Any]) -> None:
    """Puts the modules where `import` finds them. `names`: commands and what else files have without importing."""
    aster = types.ModuleType("aster")
    aster.error = CommandError  # type: ignore[attr-defined]
    aster.AsterError = CommandError  # type: ignore[attr-defined]
    aster.FatalError = CommandError  # type: ignore[attr-defined]
    aster.NonConvergenceError = NotConverged  # type: ignore[attr-defined]
    aster.ArretCPUError = TimeLimit  # type: ignore[attr-defined]
    aster.onFatalError = lambda *values: "EXCEPTION"  # type: ignore[attr-defined]

    commands = types.ModuleType("code_aster.Commands")
    commands.__dict__.update(names)
    commands.__all__ = list(names)  # type: ignore[attr-defined]
    root = types.ModuleType("code_aster")
    root.Commands = commands  # type: ignore[attr-defined]
    root.init = lambda *values, **more: None  # type: ignore[attr-defined]
    root.close = names["FIN"]  # type: ignore[attr-defined]
    root.TestCase = TestCase  # type: ignore[attr-defined]
    root.AsterError = CommandError  # type: ignore[attr-defined]
    root.__path__ = []  # type: ignore[attr-defined]
    aster.matfpe = lambda *values: None  # type: ignore[attr-defined]
    aster.affiche = lambda unit, text="": print(text)  # type: ignore[attr-defined]
    sys.modules.update({"aster": aster, "code_aster": root, "code_aster.Commands": commands, **own_modules()})


def own_modules() -> dict[str, types.ModuleType]:
    """Returns `aster_core` of a single process, and messages and tables of Utilitai."""
    core = types.ModuleType("aster_core")
    core.__dict__.update({
        "_NO_EXPIR": 1, "_POSIX": 1, "_USE_64_BITS": 1, "_USE_OPENMP": 0, "_USE_MPI": 0, "ASTER_INT_SIZE": 8,
        "matfpe": lambda *values: None, "get_option": lambda name: None,
        "get_mem_stat": lambda *names: (0.0,) * len(names),
        "set_mem_stat": lambda *values: 0, "MPI_CommRankSize": lambda: (0, 1), "MPI_Barrier": lambda *values: None,
    })
    messages = types.ModuleType("Utilitai.Utmess")
    messages.UTMESS = message  # type: ignore[attr-defined]
    tables = types.ModuleType("Utilitai.Table")
    tables.Table = table_of  # type: ignore[attr-defined]
    utilities = types.ModuleType("Utilitai")
    utilities.Utmess, utilities.Table = messages, tables  # type: ignore[attr-defined]
    utilities.__path__ = []
    return {"aster_core": core, "Utilitai": utilities, "Utilitai.Utmess": messages, "Utilitai.Table": tables}


def table_of(rows: Any = (), para: Any = (), typ: Any = (), titr: str = "", nom: str = "") -> ExtractedTable:
    """Returns a table of these rows, dicts of columns. `para` orders the columns."""
    columns = list(para) or list(dict.fromkeys(name for row in rows for name in row))
    return ExtractedTable(TableConcept(columns, list(rows), titr))


def message(code: str, number: str, valk: Any = (), vali: Any = (), valr: Any = (), **more: Any) -> None:
    """UTMESS. Raises CommandError with this number for errors (E, F, S, Z); prints information and alarms."""
    values = [value for given in (valk, vali, valr)
              for value in (given if isinstance(given, (list, tuple)) else [given])]
    text = " ".join([number, *map(str, values)])
    if code[:1] in "EFSZ":
        raise CommandError(text, number)
    print(text)
