# SPDX-License-Identifier: LGPL-3.0-or-later
"""The cell types: how many corners and middles they have, their sides, and what Code_Aster calls them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np


@dataclass(frozen=True)
class CellKind:
    """A cell type. `corners`, `middles`: numbers of nodes; the rest of its `nodes` are centres."""

    name: str
    aster: str
    dimension: int
    nodes: int
    corners: int
    middles: int


KINDS = {row.name: row for row in (
    CellKind("point1", "POI1", 0, 1, 1, 0),
    CellKind("seg2", "SEG2", 1, 2, 2, 0), CellKind("seg3", "SEG3", 1, 3, 2, 1),
    CellKind("tria3", "TRIA3", 2, 3, 3, 0), CellKind("tria6", "TRIA6", 2, 6, 3, 3),
    CellKind("tria7", "TRIA7", 2, 7, 3, 3),
    CellKind("quad4", "QUAD4", 2, 4, 4, 0), CellKind("quad8", "QUAD8", 2, 8, 4, 4),
    CellKind("quad9", "QUAD9", 2, 9, 4, 4),
    CellKind("tetra4", "TETRA4", 3, 4, 4, 0), CellKind("tetra10", "TETRA10", 3, 10, 4, 6),
    CellKind("pyra5", "PYRAM5", 3, 5, 5, 0), CellKind("pyra13", "PYRAM13", 3, 13, 5, 8),
    CellKind("penta6", "PENTA6", 3, 6, 6, 0), CellKind("penta15", "PENTA15", 3, 15, 6, 9),
    CellKind("penta18", "PENTA18", 3, 18, 6, 9),
    CellKind("hexa8", "HEXA8", 3, 8, 8, 0), CellKind("hexa20", "HEXA20", 3, 20, 8, 12),
    CellKind("hexa27", "HEXA27", 3, 27, 8, 12),
)}

# Code_Aster reads the cells of MED files in this order, and numbers them so.
MED_ORDER = ("point1", "seg2", "seg3", "tria3", "quad4", "tria6", "tria7", "quad8", "quad9", "tetra4", "pyra5",
             "penta6", "hexa8", "tetra10", "pyra13", "penta15", "penta18", "hexa20", "hexa27")

# The corners of the sides, the normal pointing out of a cell of positive volume.
SIDES: dict[str, tuple[tuple[int, ...], ...]] = {
    "tria": ((0, 1), (1, 2), (2, 0)),
    "quad": ((0, 1), (1, 2), (2, 3), (3, 0)),
    "tetra": ((0, 2, 1), (0, 1, 3), (1, 2, 3), (2, 0, 3)),
    "pyra": ((0, 3, 2, 1), (0, 1, 4), (1, 2, 4), (2, 3, 4), (3, 0, 4)),
    "penta": ((0, 2, 1), (3, 4, 5), (0, 1, 4, 3), (1, 2, 5, 4), (2, 0, 3, 5)),
    "hexa": ((0, 4, 7, 3), (1, 2, 6, 5), (0, 1, 5, 4), (2, 3, 7, 6), (0, 3, 2, 1), (4, 5, 6, 7)),
}

# Node i of the turned cell is node TURNED[i] of the cell.
TURNED = {
    "seg2": (1, 0), "seg3": (1, 0, 2),
    "tria3": (0, 2, 1), "tria6": (0, 2, 1, 5, 4, 3), "tria7": (0, 2, 1, 5, 4, 3, 6),
    "quad4": (0, 3, 2, 1), "quad8": (0, 3, 2, 1, 7, 6, 5, 4), "quad9": (0, 3, 2, 1, 7, 6, 5, 4, 8),
}


def family(name: str) -> str:
    """"hexa" of "hexa20"."""
    return name.rstrip("0123456789")


def kind_of(block: Any) -> CellKind:
    """The kind of a block's cells."""
    return KINDS[word_of(block)]


def word_of(block: Any) -> str:
    return str(getattr(block.type, "value", block.type))


def block_of(mesh: Any, cell: int) -> tuple[Any, int]:
    """The block of a cell, and its place there."""
    for block in mesh.blocks:
        place = int(cell) - block.first
        if 0 <= place < len(block.nodes):
            return block, place
    raise IndexError(cell)


def in_block(block: Any, cells: np.ndarray) -> np.ndarray:
    """Those of `cells` that are in the block, as places in it."""
    return cells[(cells >= block.first) & (cells < block.first + len(block.nodes))] - block.first


def dimensions(mesh: Any) -> np.ndarray:
    """The dimension of every cell."""
    parts = [np.full(len(block.nodes), kind_of(block).dimension) for block in mesh.blocks]
    return np.concatenate(parts) if parts else np.zeros(0, dtype=int)
