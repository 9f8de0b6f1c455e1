# SPDX-License-Identifier: LGPL-3.0-or-later
"""In which cell a place is, and where in it: for values between the nodes of a mesh."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .concepts import MeshConcept
from .mesh_parts import blocks_with, nodes_of_part, points_of
from .shapes import DIMENSIONS, reference_nodes, shape_gradients, shape_of, shape_values

# A place that is outside of the reference cell by less is on its side.
SLACK = 1e-6
NEWTON = 25


@dataclass
class Place:
    """A cell, and the values of its nodes' shape functions. `distance`: how far the place is from the cell."""

    cell: int
    nodes: np.ndarray
    shape: np.ndarray
    distance: float


class Locator:
    """Finds places in some cells of a mesh, those of the mesh's dimension among them."""

    def __init__(self, mesh: MeshConcept, cells: np.ndarray):
        self.points = points_of(mesh)
        self.blocks = []
        for kind, inside in blocks_with(mesh, cells):
            if DIMENSIONS.get(kind) == mesh.dimension:
                nodes = nodes_of_part(mesh, inside)
                corners = self.points[nodes]
                self.blocks.append((kind, inside, nodes, corners.min(axis=1), corners.max(axis=1)))

    def find(self, x: np.ndarray, reach: float) -> Place | None:
        """The cell that has the place, else the nearest one within `reach`; None without one."""
        inside = self._nearest(x, 0.0)
        if inside is not None or reach <= 0:
            return inside
        found = self._nearest(x, reach)
        return found if found is not None and found.distance <= reach else None

    def _nearest(self, x: np.ndarray, reach: float) -> Place | None:
        """The nearest of the cells whose boxes, wider by `reach`, have the place; without reach only one that has
        it."""
        best: Place | None = None
        for kind, inside, nodes, low, high in self.blocks:
            margin = SLACK * np.max(high - low, axis=1) + reach
            near = np.all((x >= low - margin[:, None]) & (x <= high + margin[:, None]), axis=1)
            for i in np.flatnonzero(near):
                place = self.in_cell(kind, int(inside[i]), nodes[i], x)
                if best is None or place.distance < best.distance:
                    best = place
                size = float(np.max(high[i] - low[i]))
                if best.distance <= SLACK * size:
                    return best
        return best if reach > 0 else None

    def in_cell(self, kind: str, cell: int, nodes: np.ndarray, x: np.ndarray) -> Place:
        """By Newton's method on the reference cell; a place outside is moved to the cell."""
        corners = self.points[nodes]
        xi = clamped(kind, locate(kind, corners, x))
        shape = shape_values(kind, xi)[0]
        return Place(cell, nodes, shape, float(np.linalg.norm(shape @ corners - x)))


def locate(kind: str, corners: np.ndarray, x: np.ndarray) -> np.ndarray:
    dimension = shape_of(kind).dimension
    xi = reference_nodes(kind).mean(axis=0)
    for _ in range(NEWTON):
        miss = x - shape_values(kind, xi)[0] @ corners
        tangents = shape_gradients(kind, xi)[0].T @ corners
        step = np.linalg.lstsq(tangents.T, miss, rcond=None)[0]
        xi = xi.copy()
        xi[:dimension] += step
        if np.max(np.abs(step)) < 1e-12 or np.max(np.abs(xi)) > 1e3:
            break
    return xi


def clamped(kind: str, xi: np.ndarray) -> np.ndarray:
    """The place on the reference cell, moved to it along its directions."""
    family = shape_of(kind).corners
    xi = xi.copy()
    if family in ("seg", "quad", "hexa"):
        return np.clip(xi, -1, 1)
    simplex = 2 if family in ("tria", "penta") else 3
    xi[:simplex] = np.maximum(xi[:simplex], 0)
    total = np.sum(xi[:simplex])
    if total > 1:
        xi[:simplex] /= total
    if family == "penta":
        xi[2] = np.clip(xi[2], -1, 1)
    return xi
