# SPDX-License-Identifier: LGPL-3.0-or-later
"""Uniform refinement of a part of a mesh, as by MACR_ADAP_MAIL with GROUP_MA."""

from __future__ import annotations

from typing import Any

import numpy as np

from .cells import SIDES, family, word_of
from .pieces import CellPieces, built, pieces_of, restricted


def refined_part(mesh: Any, named: np.ndarray) -> tuple[Any, np.ndarray]:
    """Returns the mesh with every edge of the named cells halved, and the cells of `mesh` with halved and whole edges.
    Such cells cannot stay conforming: the mesh is None if there are any.

    Every cell is cut if all its edges are halved, named or not. Skins are cut with their bodies in this way. Nodes keep
    their index.
    """
    keys = [edge_keys(block, mesh.node_count) for block in mesh.blocks]
    owners = np.repeat(np.arange(mesh.cell_count), np.concatenate([np.full(len(rows), rows.shape[1]) for rows in keys]))
    edges = np.concatenate([rows.ravel() for rows in keys])
    halved = np.isin(edges, edges[np.isin(owners, named)])
    count = np.bincount(owners, minlength=mesh.cell_count)
    cut = np.bincount(owners, halved, minlength=mesh.cell_count).astype(np.int64)
    between = np.flatnonzero((cut > 0) & (cut < count))
    if len(between):
        return None, between
    whole = (cut == 0) & ~np.isin(np.arange(mesh.cell_count), named[count[named] == 0])
    return joined(mesh, np.flatnonzero(~whole), np.flatnonzero(whole)), between


def edge_keys(block: Any, node_count: int) -> np.ndarray:
    """Returns a number for each edge of each cell, cells × edges. Cells that share an edge have the same number for it."""
    nodes = np.asarray(block.nodes, dtype=np.int64)
    pairs = edges_of(family(word_of(block)))
    if not pairs:
        return np.zeros((len(nodes), 0), dtype=np.int64)
    ends = np.sort(nodes[:, np.array(pairs)], axis=2)
    return ends[:, :, 0] * node_count + ends[:, :, 1]


def edges_of(shape: str) -> list[tuple[int, int]]:
    if shape == "seg":
        return [(0, 1)]
    found = {tuple(sorted((side[i], side[i - 1]))) for side in SIDES.get(shape, ()) for i in range(len(side))}
    return sorted(found)


def joined(mesh: Any, cut: np.ndarray, kept: np.ndarray) -> Any:
    """Returns a mesh of the cells of `cut`, refined, and behind them those of `kept`. Cells are numbered anew."""
    if len(kept) == 0:
        return mesh.refined(2)
    pieces = pieces_of(mesh)
    nodes = np.arange(mesh.node_count)
    made = pieces_of(built(restricted(pieces, cut, nodes)).refined(2))
    rest = restricted(pieces, kept, nodes)
    first = made.cell_count
    made.cells += rest.cells
    made.cells = [CellPieces(part.type, part.nodes, np.zeros(len(part), dtype=np.int64), [""] * len(part))
                  for part in made.cells]
    empty = np.zeros(0, dtype=np.int64)
    made.cell_groups = {name: np.concatenate([made.cell_groups.get(name, empty),
                                              first + rest.cell_groups.get(name, empty)])
                        for name in pieces.cell_groups}
    made.node_groups = pieces.node_groups
    return built(made)
