# SPDX-License-Identifier: LGPL-3.0-or-later
"""Cells of another order: middle nodes dropped, centres added."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np

from .cells import KINDS, SIDES, family
from .pieces import Pieces, built, pieces_of, restricted

# The corners of the edges, in the order of the middle nodes.
EDGES = {
    "tria": ((0, 1), (1, 2), (2, 0)),
    "quad": ((0, 1), (1, 2), (2, 3), (3, 0)),
    "penta": ((0, 1), (1, 2), (2, 0), (3, 4), (4, 5), (5, 3), (0, 3), (1, 4), (2, 5)),
    "hexa": ((0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4), (0, 4), (1, 5), (2, 6), (3, 7)),
}
LINEAR = {kind.name: next(other.name for other in KINDS.values()
                          if family(other.name) == family(kind.name) and other.nodes == other.corners)
          for kind in KINDS.values()}
# What each quadratic type becomes with nodes in the centres of its quadrangles, and of itself.
HEXAHEDRA = {"hexa20": "hexa27", "quad8": "quad9"}
PRISMS = {"penta15": "penta18", "quad8": "quad9"}
QUADRANGLES = {"quad8": "quad9"}
TRIANGLES = {"tria6": "tria7"}


def linear(mesh: Any, cells: np.ndarray) -> Any:
    """The mesh with these cells made linear. Nodes that no cell has any more are dropped."""
    pieces = pieces_of(mesh)
    dropped = np.zeros(len(pieces.points), dtype=bool)
    chosen = _chosen(pieces, cells)
    for part, own in zip(pieces.cells, chosen):
        dropped[part.nodes[own][:, KINDS[part.type].corners:]] = True
    changed = _split_types(pieces, chosen, LINEAR, lambda kind, rows: rows[:, :KINDS[kind].corners])
    for part in changed.cells:
        dropped[part.nodes] = False
    return built(restricted(changed, np.arange(changed.cell_count), np.flatnonzero(~dropped)))


def with_centres(mesh: Any, cells: np.ndarray, types: dict[str, str]) -> Any:
    """The mesh with nodes in the centres of these cells and of their quadrangles. Nodes are shared by cells that share
    the face."""
    pieces = pieces_of(mesh)
    chosen = _chosen(pieces, cells)
    rows = {part.type: part.nodes[own] for part, own in zip(pieces.cells, chosen) if part.type in types and own.any()}
    if not rows:
        return mesh.copy()
    places, centres = _centres(pieces.points, rows)
    changed = _split_types(pieces, chosen, types, lambda kind, nodes: np.hstack([nodes, centres[kind]]))
    changed.points = np.concatenate([pieces.points, places])
    changed.node_numbers = np.concatenate([pieces.node_numbers, np.zeros(len(places), dtype=np.int64)])
    changed.node_names = pieces.node_names + [""] * len(places)
    return built(changed)


def _centres(points: np.ndarray, rows: dict[str, np.ndarray]) -> tuple[np.ndarray, dict[str, np.ndarray]]:
    """New points, and by type the indices of those that each cell gets: of its faces, then of itself."""
    wanted = [(kind, *face) for kind, nodes in rows.items() for face in _faces(kind, points, nodes)]
    keys = np.concatenate([key for _, key, _ in wanted])
    _, first, same = np.unique(keys, axis=0, return_index=True, return_inverse=True)
    places = np.concatenate([place for _, _, place in wanted])[first]
    found: dict[str, list[np.ndarray]] = {kind: [] for kind in rows}
    at = 0
    for kind, key, _ in wanted:
        found[kind].append(len(points) + same.ravel()[at:at + len(key)])
        at += len(key)
    return places, {kind: np.column_stack(columns) for kind, columns in found.items()}


def _faces(kind: str, points: np.ndarray, nodes: np.ndarray) -> Iterator[tuple[np.ndarray, np.ndarray]]:
    """For each centre that cells get: what it is the centre of (8 sorted corners, −1 where there are fewer), and its
    place."""
    name, corners = family(kind), KINDS[kind].corners
    if KINDS[kind].dimension == 2:
        yield _centre(points, nodes[:, :corners], nodes[:, corners:], 0.5 if corners == 4 else 4 / 9)
        return
    for side in SIDES[name]:
        if len(side) == 4:
            middles = [corners + _edge(name, side[i], side[(i + 1) % 4]) for i in range(4)]
            yield _centre(points, nodes[:, side], nodes[:, middles], 0.5)
    if name == "hexa":
        yield _centre(points, nodes[:, :corners], nodes[:, corners:], 0.25)


def _centre(points: np.ndarray, corners: np.ndarray, middles: np.ndarray,
            share: float) -> tuple[np.ndarray, np.ndarray]:
    """Where the shape functions of the quadratic cell put its centre: that share of each middle, and as much of each
    corner that the sum is 1."""
    of_corners = (1 - share * middles.shape[1]) / corners.shape[1]
    place = of_corners * np.sum(points[corners], axis=1) + share * np.sum(points[middles], axis=1)
    key = np.full((len(corners), 8), -1, dtype=np.int64)
    key[:, :corners.shape[1]] = np.sort(corners, axis=1)
    return key, place


def _edge(name: str, first: int, second: int) -> int:
    return next(i for i, edge in enumerate(EDGES[name]) if set(edge) == {first, second})


def _chosen(pieces: Pieces, cells: np.ndarray) -> list[np.ndarray]:
    """For each part: which of its cells are among `cells`."""
    wanted = np.zeros(pieces.cell_count, dtype=bool)
    wanted[cells] = True
    bounds = np.cumsum([0, *(len(part) for part in pieces.cells)])
    return [wanted[first:last] for first, last in zip(bounds[:-1], bounds[1:])]


def _split_types(pieces: Pieces, chosen: list[np.ndarray], types: dict[str, str], rows_of: Any) -> Pieces:
    """The chosen cells of each part with another type, and rows of nodes from `rows_of(old type, rows)`; the others
    as they are. Groups follow."""
    changed = Pieces(pieces.dimension, pieces.points, pieces.node_numbers, pieces.node_names)
    changed.node_groups = pieces.node_groups
    new = np.zeros(pieces.cell_count, dtype=np.int64)
    first = 0
    for part, own in zip(pieces.cells, chosen):
        target = types.get(part.type, part.type)
        own = own & (target != part.type)
        for mask, kind, rows in ((~own, part.type, part.nodes), (own, target, part.nodes)):
            places = np.flatnonzero(mask)
            if len(places):
                nodes = rows[places] if kind == part.type else rows_of(part.type, rows[places])
                new[first + places] = changed.add_cells(kind, nodes, [part.names[i] for i in places])
                changed.cells[-1].numbers = part.numbers[places]
        first += len(part)
    changed.cell_groups = {name: new[items] for name, items in pieces.cell_groups.items()}
    return changed
