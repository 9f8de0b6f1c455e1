# SPDX-License-Identifier: LGPL-3.0-or-later
"""Text dumps of Cast3M (GIBI): its named meshes become groups of cells, its named points groups of nodes. As in
Code_Aster nodes are called N1, … by the place of their coordinates, cells M1, … by their place among the cells of
all meshes of the file; meshes without a name, and that none with a name is made of, are left out."""

from __future__ import annotations

import re
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, NoReturn

import numpy as np

from ..keys import CommandError
from .cells import KINDS
from .pieces import Pieces, built, laid_flat

# Stacks (piles) of objects: meshes, nodes, coordinates; old dumps have nodes and coordinates in one.
MESHES, NODES, COORDINATES, OLD_NODES = 1, 32, 33, 0
# Meshes are made of meshes no deeper than this.
DEEPEST = 20
# Width and number in a line of whole numbers, by the level of the dump.
LEVEL_3, OTHER_LEVELS = (5, 16), (8, 10)


def _around(count: int) -> tuple[int, ...]:
    """Corners and middles take turns round a face: corners first."""
    return (*range(0, 2 * count, 2), *range(1, 2 * count, 2))


# By Cast3M's number: our type, and which of its nodes our nodes are.
TYPES: dict[int, tuple[str, tuple[int, ...]]] = {
    1: ("point1", ()), 2: ("seg2", ()), 3: ("seg3", (0, 2, 1)), 4: ("tria3", ()), 6: ("tria6", _around(3)),
    7: ("tria7", (*_around(3), 6)), 8: ("quad4", ()), 10: ("quad8", _around(4)), 11: ("quad9", (*_around(4), 8)),
    14: ("hexa8", ()), 16: ("penta6", ()), 23: ("tetra4", ()), 25: ("pyra5", ()),
    15: ("hexa20", (0, 2, 4, 6, 12, 14, 16, 18, 1, 3, 5, 7, 13, 15, 17, 19, 8, 9, 10, 11)),
    17: ("penta15", (0, 2, 4, 9, 11, 13, 1, 3, 5, 10, 12, 14, 6, 7, 8)),
    24: ("tetra10", (0, 2, 4, 9, 1, 3, 5, 6, 7, 8)),
    26: ("pyra13", (0, 2, 4, 6, 12, 1, 3, 5, 7, 8, 9, 10, 11)),
}


@dataclass
class _Object:
    """A mesh of one cell type, or of other meshes. `first`: the number of its first cell; `cells`: indices into those
    of its type, once they are wanted."""

    kind: str = ""
    first: int = 1
    rows: list[list[int]] = field(default_factory=list)
    parts: list[int] = field(default_factory=list)
    cells: list[int] = field(default_factory=list)


class _Reader:
    """Numbers and names in Cast3M's columns; every list begins on a line of its own."""

    def __init__(self, path: Path):
        self.path = path
        self._lines = path.read_text(encoding="latin-1").splitlines()
        self._at = 0
        self.whole = OTHER_LEVELS

    def line(self) -> str:
        if self._at >= len(self._lines):
            self.refuse("the file ends too early")
        self._at += 1
        return self._lines[self._at - 1]

    def find(self, wanted: str) -> str:
        """The next line that begins so, or nothing."""
        while self._at < len(self._lines):
            line = self.line()
            if line.strip().startswith(wanted):
                return line
        return ""

    def whole_numbers(self, count: int) -> list[int]:
        return [self._number(int, text) for text in self._columns(count, *self.whole)]

    def reals(self, count: int) -> np.ndarray:
        return np.array([self._number(float, text.replace("D", "E")) for text in self._columns(count, 22, 3)])

    def names(self, count: int) -> list[str]:
        return [text.strip() for text in self._columns(count, 9, 8)]

    def skip(self, count: int) -> None:
        """Whole numbers."""
        for _ in range(-(-count // self.whole[1])):
            self.line()

    def _columns(self, count: int, width: int, on_line: int) -> list[str]:
        texts: list[str] = []
        while len(texts) < count:
            line = self.line()
            here = min(on_line, count - len(texts))
            texts += [line[width * i:width * (i + 1)] for i in range(here)]
        return texts

    def _number(self, kind: type, text: str) -> Any:
        try:
            number = kind(text)
        except ValueError:
            number = np.nan
        if not np.isfinite(number):
            self.refuse(f"expected a number, found {text.strip()!r}")
        return number

    def refuse(self, text: str) -> NoReturn:
        raise CommandError(f"{self.path}:{self._at}: {text}.")


class _Content:
    """What the stacks hold."""

    def __init__(self) -> None:
        self.dimension = 0
        self.objects: list[_Object] = []
        self.cell_count = 0
        self.mesh_names: list[tuple[str, int]] = []
        self.point_names: list[tuple[str, int]] = []
        self.places: list[int] = []
        self.coordinates = np.zeros((0, 3))


def read_gibi(path: Path) -> Any:
    """The mesh of a text dump."""
    reader, content = _Reader(path), _Content()
    while True:
        line = reader.find("ENREGISTREMENT DE TYPE")
        if not line or line.split()[-1] == "5":
            break
        if line.split()[-1] == "4":
            content.dimension = _dimension(reader)
        elif line.split()[-1] == "2":
            _read_stack(reader, content)
    if not content.dimension or not content.objects or not len(content.coordinates):
        reader.refuse("this is no dump of Cast3M that has a mesh")
    return _mesh(reader, content)


def _dimension(reader: _Reader) -> int:
    found = re.search(r"NIVEAU\s+(\d+).*DIMENSION\s+([23])\b", reader.line())
    if not found:
        reader.refuse("expected a level, and a dimension of 2 or 3")
    reader.whole = LEVEL_3 if found[1] == "3" else OTHER_LEVELS
    return int(found[2])


def _read_stack(reader: _Reader, content: _Content) -> None:
    found = re.search(r"PILE NUMERO\s*(\d+)\D+(\d+)\D+(\d+)", reader.line())
    if not found:
        reader.refuse("expected 'PILE NUMERO'")
    stack, named, count = (int(text) for text in found.groups())
    if stack not in (MESHES, NODES, COORDINATES, OLD_NODES):
        return
    names = list(zip(reader.names(named), reader.whole_numbers(named)))
    if stack == MESHES:
        content.mesh_names = names
        for _ in range(count):
            content.objects.append(_read_object(reader, content))
    elif stack == NODES:
        content.point_names = names
        content.places = reader.whole_numbers(reader.whole_numbers(1)[0])
    else:
        width = content.dimension + 1  # coordinates and a density
        values = reader.reals(count * width if stack == OLD_NODES else reader.whole_numbers(1)[0])
        content.coordinates = values[:len(values) // width * width].reshape(-1, width)[:, :-1]
        if stack == OLD_NODES:
            content.point_names = names
            content.places = list(range(1, count + 1))


def _read_object(reader: _Reader, content: _Content) -> _Object:
    code, parts, references, width, count = reader.whole_numbers(5)
    if min(parts, references, width, count) < 0:
        reader.refuse("expected numbers of parts, references, nodes and cells")
    made = _Object(first=content.cell_count + 1, parts=[number - 1 for number in reader.whole_numbers(parts)])
    content.cell_count += count
    reader.skip(references)
    reader.skip(count)  # colours
    if code <= 0 or parts:
        return made
    rows = np.array(reader.whole_numbers(count * width), dtype=np.int64).reshape(count, width)
    if code in TYPES:
        made.kind, order = TYPES[code]
        if width != KINDS[made.kind].nodes:
            reader.refuse(f"expected {KINDS[made.kind].nodes} nodes of a cell of type {made.kind}, found {width}")
        made.rows = (rows[:, order] if order else rows).tolist()
    return made


# ---- the mesh ------------------------------------------------------------------------------------------------


def _mesh(reader: _Reader, content: _Content) -> Any:
    rows = _wanted_cells(reader, content)
    used = sorted({_place(reader, content, node) for cells in rows.values() for _, nodes in cells for node in nodes})
    if not used:
        reader.refuse("no named mesh has cells")
    place = {node: i for i, node in enumerate(used)}
    points = np.zeros((len(used), 3))
    points[:, :content.dimension] = content.coordinates[np.array(used) - 1]
    pieces = Pieces(content.dimension, points, np.array(used), [""] * len(used))
    first: dict[str, int] = {}
    for kind, cells in rows.items():
        first[kind] = pieces.cell_count
        pieces.add_cells(kind, [[place[content.places[node - 1]] for node in nodes] for _, nodes in cells])
        pieces.cells[-1].numbers = np.array([number for number, _ in cells])
    for name, number in content.mesh_names:
        made = [first[part.kind] + cell for part in _parts(reader, content, number - 1) for cell in part.cells]
        if made and not name.startswith("#"):
            pieces.cell_groups[name] = np.unique(made)
    for name, number in content.point_names:
        node = place.get(content.places[number - 1]) if 1 <= number <= len(content.places) else None
        if node is not None and not name.startswith("#"):
            pieces.node_groups[name] = np.array([node])
    return built(laid_flat(pieces))


def _place(reader: _Reader, content: _Content, node: int) -> int:
    """Where the coordinates of a node stand, from 1."""
    if not 1 <= node <= len(content.places):
        reader.refuse(f"a cell has node {node}, but the nodes go from 1 to {len(content.places)}")
    place = content.places[node - 1]
    if not 1 <= place <= len(content.coordinates):
        reader.refuse(f"node {node} has no coordinates")
    return place


def _wanted_cells(reader: _Reader, content: _Content) -> dict[str, list[tuple[int, list[int]]]]:
    """Numbers and nodes of the cells of each type, each cell once: several meshes may have it."""
    wanted = {id(part) for _, number in content.mesh_names for part in _parts(reader, content, number - 1)}
    cells: dict[str, list[tuple[int, list[int]]]] = {}
    known: dict[tuple[str, frozenset[int]], int] = {}
    for item in content.objects:
        if id(item) not in wanted:
            continue
        of_type = cells.setdefault(item.kind, [])
        for i, nodes in enumerate(item.rows):
            key = (item.kind, frozenset(nodes))
            if key not in known:
                known[key] = len(of_type)
                of_type.append((item.first + i, nodes))
            item.cells.append(known[key])
    return cells


def _parts(reader: _Reader, content: _Content, index: int, depth: int = 0) -> list[_Object]:
    """The meshes of one cell type that a mesh is made of."""
    if not 0 <= index < len(content.objects) or depth > DEEPEST:
        reader.refuse(f"there is no mesh number {index + 1}")
    item = content.objects[index]
    simple = [item] if item.rows else []
    return simple + [part for inner in item.parts for part in _parts(reader, content, inner, depth + 1)]
