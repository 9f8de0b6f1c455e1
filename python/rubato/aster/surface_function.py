# SPDX-License-Identifier: LGPL-3.0-or-later
"""Functions of two parameters that are tables of functions (nappe)."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from .concepts import Function, TableFunction


class SurfaceFunction(Function):
    """DEFI_NAPPE: functions of the second parameter at ascending places of the first one, and an interpolation
    between them."""

    def __init__(self, parameters: tuple[str, str], places: Any, functions: Sequence[Function], before: str = "EXCLU",
                 after: str = "EXCLU", interpolation: tuple[str, str] = ("LIN", "LIN"), result: str = "TOUTRESU"):
        self.parameters = parameters
        self.places = np.asarray(places, dtype=float)
        self.functions = list(functions)
        self.before = before
        self.after = after
        self.interpolation = interpolation
        self.result = result

    def __call__(self, *values: float) -> float:
        outer, inner = values
        # Only the functions next to the place are asked: others may have nothing there.
        near = self._neighbours(float(outer))
        table = TableFunction(self.parameters[0], self.places[near], [self.functions[i](inner) for i in near],
                              self.before, self.after, self.interpolation)
        table.name = self.name
        return table(outer)

    def _neighbours(self, outer: float) -> list[int]:
        last = len(self.places) - 1
        exact = np.flatnonzero(self.places == outer)
        if last == 0 or len(exact):
            return [int(exact[0])] if len(exact) else [0]
        at = int(np.clip(np.searchsorted(self.places, outer), 1, last))
        return [at - 1, at]

    # Code_Aster's Python methods
    def Valeurs(self) -> list[Any]:
        tables = [function for function in self.functions if isinstance(function, TableFunction)]
        return [self.places.tolist(), [table.Valeurs() for table in tables]]
