# SPDX-License-Identifier: LGPL-3.0-or-later
"""Gmsh's text files of versions 1 and 2, with the names that Code_Aster gives: nodes N1, …, cells M1, … by the
numbers of the file, groups GM1, … by the physical numbers."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any, NoReturn

import numpy as np

from ..keys import CommandError
from .cells import KINDS
from .orders import EDGES
from .pieces import Pieces, built, laid_flat

_FULL_EDGES = {"tetra": ((0, 1), (1, 2), (2, 0), (0, 3), (2, 3), (1, 3)),
               "hexa": ((0, 1), (0, 3), (0, 4), (1, 2), (1, 5), (2, 3), (2, 6), (3, 7), (4, 5), (4, 7), (5, 6), (6, 7)),
               "penta": ((0, 1), (0, 2), (0, 3), (1, 2), (1, 4), (2, 5), (3, 4), (3, 5), (4, 5))}
_OUR_TETRA = ((0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3))


def _middles(family: str, corners: int) -> tuple[int, ...]:
    """Our node i is Gmsh's node order[i]: the corners agree, middles follow Gmsh's own list of edges."""
    ours = _OUR_TETRA if family == "tetra" else EDGES[family]
    theirs = [frozenset(edge) for edge in _FULL_EDGES[family]]
    return (*range(corners), *(corners + theirs.index(frozenset(edge)) for edge in ours))


# By Gmsh's number: our type, and the order of the nodes where it differs.
TYPES: dict[int, tuple[str, tuple[int, ...]]] = {
    1: ("seg2", ()), 2: ("tria3", ()), 3: ("quad4", ()), 4: ("tetra4", ()), 5: ("hexa8", ()), 6: ("penta6", ()),
    7: ("pyra5", ()), 8: ("seg3", ()), 9: ("tria6", ()), 10: ("quad9", ()), 11: ("tetra10", _middles("tetra", 4)),
    15: ("point1", ()), 16: ("quad8", ()), 17: ("hexa20", _middles("hexa", 8)), 18: ("penta15", _middles("penta", 6)),
}
# By type: number, physical number and nodes of each cell.
CellRows = dict[str, list[tuple[int, int, list[int]]]]
# Code_Aster keeps so many characters of a physical name.
NAME_LENGTH = 8


class _Reader:
    """Lines of a file, and where it stands."""

    def __init__(self, path: Path):
        self.path = path
        self._lines = path.read_text(encoding="latin-1").splitlines()
        self._at = 0

    def next(self) -> list[str]:
        while self._at < len(self._lines):
            words = self._lines[self._at].split()
            self._at += 1
            if words:
                return words
        self.refuse("the file ends too early")

    def more(self) -> bool:
        return any(line.strip() for line in self._lines[self._at:])

    def numbers(self, kind: type, least: int) -> list[Any]:
        words = self.next()
        try:
            numbers = [kind(word) for word in words]
        except ValueError:
            self.refuse(f"expected numbers, found {' '.join(words)!r}")
        if len(numbers) < least:
            self.refuse(f"expected {least} numbers, found {len(numbers)}")
        return numbers

    def rows(self) -> Iterator[list[int]]:
        """As many lines of at least 4 whole numbers as the next line says."""
        for _ in range(self.numbers(int, 1)[0]):
            yield self.numbers(int, 4)

    def nodes(self) -> dict[int, list[float]]:
        """Places by the numbers of nodes, as many as the next line says."""
        places = {}
        for _ in range(self.numbers(int, 1)[0]):
            row = self.numbers(float, 4)[:4]
            if not np.all(np.isfinite(row)) or row[0] != int(row[0]):
                self.refuse("expected the number of a node and its place")
            places[int(row[0])] = row[1:]
        return places

    def refuse(self, text: str) -> NoReturn:
        raise CommandError(f"{self.path}:{self._at}: {text}.")


def read_gmsh(path: Path) -> Any:
    """The mesh of a text file of version 1 or 2."""
    reader = _Reader(path)
    opening = reader.next()[0].upper()
    points: dict[int, list[float]] = {}
    cells: CellRows = {}
    names: dict[tuple[int, int], str] = {}
    version = 1 if opening == "$NOD" else 2
    if version == 2:
        _check_format(reader)
        opening = reader.next()[0].upper()
    while True:
        if opening in ("$NOD", "$NODES"):
            points = reader.nodes()
        elif opening in ("$ELM", "$ELEMENTS"):
            for row in reader.rows():
                _add_cell(reader, row, version, cells)
        elif opening == "$PHYSICALNAMES":
            _read_names(reader, names)
        _skip_to_end(reader)
        if not reader.more():
            break
        opening = reader.next()[0].upper()
    return _mesh(reader, points, cells, names)


def _check_format(reader: _Reader) -> None:
    version = reader.numbers(float, 2)
    if not 2 <= version[0] < 3 or version[1] != 0:
        reader.refuse("expected a text file of version 1 or 2")
    _skip_to_end(reader)


def _skip_to_end(reader: _Reader) -> None:
    while not reader.next()[0].upper().startswith("$END"):
        pass


def _read_names(reader: _Reader, names: dict[tuple[int, int], str]) -> None:
    for _ in range(reader.numbers(int, 1)[0]):
        words = reader.next()
        if len(words) < 3 or not (words[0].isdigit() and words[1].isdigit()):
            reader.refuse("expected dimension, number and name of a physical group")
        names[int(words[0]), int(words[1])] = " ".join(words[2:]).strip('"')[:NAME_LENGTH].strip()


def _add_cell(reader: _Reader, row: list[int], version: int, cells: CellRows) -> None:
    number, code = row[:2]
    if code not in TYPES:
        reader.refuse(f"cells of Gmsh's type {code} are not available")
    kind, order = TYPES[code]
    # Version 1: number, type, physical number, piece of the geometry, how many nodes, nodes.
    first = 5 if version == 1 else 3 + row[2]
    group = abs(row[2]) if version == 1 else (abs(row[3]) if row[2] > 0 else 0)
    nodes = row[first:]
    if len(nodes) != KINDS[kind].nodes:
        reader.refuse(f"expected {KINDS[kind].nodes} nodes of cell {number}, found {len(nodes)}")
    cells.setdefault(kind, []).append((number, group, [nodes[i] for i in order] if order else nodes))


def _mesh(reader: _Reader, points: dict[int, list[float]], cells: CellRows, names: dict[tuple[int, int], str]) -> Any:
    used = sorted({node for rows in cells.values() for _, _, nodes in rows for node in nodes})
    missing = [node for node in used if node not in points]
    if missing or not used:
        reader.refuse(f"there is no node {missing[0]}, which a cell has" if missing else "there are no cells")
    place = {node: i for i, node in enumerate(used)}
    pieces = Pieces(3, np.array([points[node] for node in used]), np.array(used), [""] * len(used))
    groups: dict[str, list[int]] = {}
    for kind, rows in cells.items():
        made = pieces.add_cells(kind, [[place[node] for node in nodes] for _, _, nodes in rows])
        pieces.cells[-1].numbers = np.array([number for number, _, _ in rows])
        for cell, (_, group, _) in zip(made.tolist(), rows):
            name = names.get((KINDS[kind].dimension, group)) or f"GM{group}"
            groups.setdefault(name, []).append(cell)
    pieces.cell_groups = {name: np.array(items) for name, items in groups.items()}
    return built(laid_flat(pieces))
