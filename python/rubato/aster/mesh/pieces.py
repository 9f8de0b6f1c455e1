# SPDX-License-Identifier: LGPL-3.0-or-later
"""A mesh taken apart into arrays and lists, and built again: for changes that rubato's meshes do not have."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np

import rubato

from .cells import KINDS, MED_ORDER, word_of

# Points of a plane mesh differ by less than this share of its size in z.
FLATNESS = 1e-9


@dataclass
class CellPieces:
    """Cells of one type. Number 0 and an empty name mean not given: then MeshBuilder numbers them."""

    type: str
    nodes: np.ndarray
    numbers: np.ndarray
    names: list[str]

    def __len__(self) -> int:
        return len(self.nodes)


@dataclass
class Pieces:
    """Cells count through `cells` in their order; groups have such indices, in their own order."""

    dimension: int
    points: np.ndarray
    node_numbers: np.ndarray
    node_names: list[str]
    cells: list[CellPieces] = field(default_factory=list)
    node_groups: dict[str, np.ndarray] = field(default_factory=dict)
    cell_groups: dict[str, np.ndarray] = field(default_factory=dict)

    @property
    def cell_count(self) -> int:
        return sum(len(part) for part in self.cells)

    def add_cells(self, kind: str, nodes: Any, names: list[str] | None = None) -> np.ndarray:
        """New cells behind the others; their indices."""
        rows = np.asarray(nodes, dtype=np.int64).reshape(-1, KINDS[kind].nodes)
        first = self.cell_count
        self.cells.append(CellPieces(kind, rows, np.zeros(len(rows), dtype=np.int64), names or [""] * len(rows)))
        return np.arange(first, first + len(rows))


def pieces_of(mesh: Any) -> Pieces:
    """Cell indices are those of the mesh."""
    pieces = Pieces(mesh.dimension, np.array(mesh.points, dtype=float), np.array(mesh.node_numbers, dtype=np.int64),
                    _names(mesh.node_names, mesh.node_count))
    for block in mesh.blocks:
        nodes = np.array(block.nodes, dtype=np.int64)
        numbers = np.array(block.numbers, dtype=np.int64)
        pieces.cells.append(CellPieces(word_of(block), nodes, numbers, _names(block.names, len(nodes))))
    pieces.node_groups = {name: np.array(items, dtype=np.int64) for name, items in mesh.node_groups.items()}
    pieces.cell_groups = {name: np.array(items, dtype=np.int64) for name, items in mesh.cell_groups.items()}
    return pieces


def _names(given: Any, count: int) -> list[str]:
    return list(given) if len(given) else [""] * count


def built(pieces: Pieces) -> Any:
    """The mesh of these pieces."""
    builder = rubato.MeshBuilder(pieces.dimension)
    for point, number, name in zip(pieces.points.tolist(), pieces.node_numbers.tolist(), pieces.node_names):
        builder.add_node(point, number, name)
    for part in pieces.cells:
        for nodes, number, name in zip(part.nodes.tolist(), part.numbers.tolist(), part.names):
            builder.add_cell(part.type, nodes, number, name)
    for name, items in pieces.node_groups.items():
        builder.add_to_node_group(name, np.asarray(items, dtype=np.int32))
    for name, items in pieces.cell_groups.items():
        builder.add_to_cell_group(name, np.asarray(items, dtype=np.int32))
    return _with_orders(builder.build(), pieces)


def _with_orders(mesh: Any, pieces: Pieces) -> Any:
    for name, items in pieces.node_groups.items():
        if len(items) > 1 and np.min(np.diff(items)) < 0:
            mesh = mesh.with_node_group(name, np.asarray(items, dtype=np.int32), ordered=True)
    return mesh


def restricted(pieces: Pieces, cells: np.ndarray, nodes: np.ndarray) -> Pieces:
    """Only these cells and nodes, both ascending; the nodes must have those of the cells. Groups lose the others,
    and are dropped when nothing is left."""
    new_node = np.full(len(pieces.points), -1, dtype=np.int64)
    new_node[nodes] = np.arange(len(nodes))
    new_cell = np.full(pieces.cell_count, -1, dtype=np.int64)
    new_cell[cells] = np.arange(len(cells))
    kept = Pieces(pieces.dimension, pieces.points[nodes], pieces.node_numbers[nodes],
                  [pieces.node_names[i] for i in nodes])
    first = 0
    for part in pieces.cells:
        own = cells[(cells >= first) & (cells < first + len(part))] - first
        first += len(part)
        if len(own):
            kept.cells.append(CellPieces(part.type, new_node[part.nodes[own]], part.numbers[own],
                                         [part.names[i] for i in own]))
    kept.node_groups = _renumbered(pieces.node_groups, new_node)
    kept.cell_groups = _renumbered(pieces.cell_groups, new_cell)
    return kept


def _renumbered(groups: dict[str, np.ndarray], new: np.ndarray) -> dict[str, np.ndarray]:
    moved = {name: new[items] for name, items in groups.items()}
    return {name: items[items >= 0] for name, items in moved.items() if np.any(items >= 0)}


def numbered_as_read(mesh: Any) -> Any:
    """The mesh with its nodes and cells numbered from 1 as Code_Aster numbers what it reads from MED files: in the
    order of the file, cells by the order of MED's types. Only numbers by which things without a name are called."""
    pieces = pieces_of(mesh)
    changed = False
    if not any(pieces.node_names):
        wanted = np.arange(1, len(pieces.points) + 1)
        changed = not np.array_equal(wanted, pieces.node_numbers)
        pieces.node_numbers = wanted
    first = 1
    for part in sorted(pieces.cells, key=lambda part: MED_ORDER.index(part.type)):
        wanted = np.arange(first, first + len(part))
        first += len(part)
        changed = changed or not (any(part.names) or np.array_equal(wanted, part.numbers))
        part.numbers = wanted
    return built(pieces) if changed else mesh


def laid_flat(pieces: Pieces) -> Pieces:
    """A mesh of surfaces at one z, without solids, is a mesh of the plane."""
    dimensions = {KINDS[part.type].dimension for part in pieces.cells}
    heights = pieces.points[:, 2]
    extent = np.linalg.norm(np.ptp(pieces.points, axis=0))
    if max(dimensions) == 2 and np.ptp(heights) <= FLATNESS * extent:
        pieces.dimension = 2
        pieces.points[:, 2] = 0.0
    return pieces
