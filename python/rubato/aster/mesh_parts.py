# SPDX-License-Identifier: LGPL-3.0-or-later
"""Nodes and cells of a mesh as arrays."""

from __future__ import annotations

from typing import Any

import numpy as np

from .concepts import MeshConcept


def points_of(mesh: MeshConcept) -> np.ndarray:
    """Nodes × 3."""
    given = np.asarray(mesh.mesh.points)
    points = np.zeros((mesh.mesh.node_count, 3))
    points[:, :given.shape[1]] = given
    return points


def nodes_of_part(mesh: MeshConcept, cells: np.ndarray) -> np.ndarray:
    """Cells of one type: cells × nodes."""
    if not len(cells):
        return np.zeros((0, 0), dtype=np.int64)
    block = block_of(mesh, int(cells[0]))
    return np.asarray(block.nodes)[np.asarray(cells) - block.first]


def block_of(mesh: MeshConcept, cell: int) -> Any:
    for block in mesh.mesh.blocks:
        if block.first <= cell < block.first + len(block.nodes):
            return block
    raise IndexError(cell)


def blocks_with(mesh: MeshConcept, cells: np.ndarray) -> list[tuple[str, np.ndarray]]:
    """The cells by their types."""
    found = []
    for block in mesh.mesh.blocks:
        inside = cells[(cells >= block.first) & (cells < block.first + len(block.nodes))]
        if len(inside):
            found.append((str(block.type), inside))
    return found
