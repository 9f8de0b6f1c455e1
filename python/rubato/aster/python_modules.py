# SPDX-License-Identifier: LGPL-3.0-or-later
"""Modules that command files import: `aster` (the supervisor's exceptions), `code_aster` (the form of 15.x), and a few
of Code_Aster's own of which files take names only."""

from __future__ import annotations

import sys
import types
import unittest
from typing import Any

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
    sys.modules.update({"aster": aster, "code_aster": root, "code_aster.Commands": commands})
