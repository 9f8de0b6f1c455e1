# SPDX-License-Identifier: LGPL-3.0-or-later
"""INCREMENT, ARCHIVAGE: which instants are solved for, and which are stored."""

from __future__ import annotations



import numpy as np

from ..concepts import Cuts, TimeList
from ..keys import Arguments, CommandError


def instants_of(command: str, increment: Arguments, begin: float | None) -> tuple[np.ndarray, Cuts]:
    """The instants, the first one being that of the initial state. `begin`: the instant of an initial state that comes
    from elsewhere; None: the list's first."""
    values = np.asarray(increment.LIST_INST.values, dtype=float)
    if len(values) < 2 or np.any(np.diff(values) <= 0):
        raise CommandError(f"{command}/INCREMENT/LIST_INST: expected ascending instants, at least two.")
    first, last = 0, len(values) - 1
    if increment.NUME_INST_INIT is not None:
        first = increment.NUME_INST_INIT
    elif increment.INST_INIT is not None:
        first = place_of(command, "INST_INIT", values, increment.INST_INIT, increment.PRECISION)
    elif begin is not None:
        first = int(np.argmin(np.abs(values - begin)))
        if abs(values[first] - begin) > increment.PRECISION * max(abs(begin), np.min(np.diff(values))):
            raise CommandError(f"{command}/INCREMENT: the initial state is of instant {begin:g}, which the list of "
                               "instants does not have.")
    if increment.NUME_INST_FIN is not None:
        last = increment.NUME_INST_FIN
    elif increment.INST_FIN is not None:
        last = place_of(command, "INST_FIN", values, increment.INST_FIN, increment.PRECISION)
    if not 0 <= first < last <= len(values) - 1:
        raise CommandError(f"{command}/INCREMENT: there are no instants between number {first} and number {last}.")
    listed = increment.LIST_INST
    return values[first:last + 1], listed.cuts if isinstance(listed, TimeList) else Cuts(2, 0)


def place_of(command: str, keyword: str, values: np.ndarray, instant: float, precision: float) -> int:
    place = int(np.argmin(np.abs(values - instant)))
    if abs(values[place] - instant) > precision * max(abs(instant), np.min(np.diff(values))):
        raise CommandError(f"{command}/INCREMENT/{keyword}: instant {instant:g} is not in the list of instants; the "
                           f"nearest one is {values[place]:g}.")
    return place


class Archive:
    """Which states are stored: all, every n-th, or those at listed instants; the last one always."""

    def __init__(self, items: list[Arguments]):
        self.every = 1
        self.instants: np.ndarray | None = None
        self.count = 0
        self.precision, self.relative = 1e-6, True
        for item in items:
            self.precision, self.relative = item.PRECISION, item.CRITERE == "RELATIF"
            if item.LIST_INST is not None:
                self.instants = np.asarray(item.LIST_INST.values)
            elif item.INST:
                self.instants = np.asarray(item.INST)
            elif item.PAS_ARCH is not None:
                self.every = max(1, item.PAS_ARCH)

    def wants(self, instant: float, last: bool) -> bool:
        """Asked once a step, in their order."""
        self.count += 1
        if last:
            return True
        if self.instants is None:
            return self.count % self.every == 0
        scale = np.abs(self.instants) if self.relative else 1.0
        return bool(np.any(np.abs(self.instants - instant) <= self.precision * np.maximum(scale, 1e-300)))


