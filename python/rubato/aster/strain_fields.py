# SPDX-License-Identifier: LGPL-3.0-or-later
"""Strains of the displacement for every DEFORMATION: EPSI linear, EPSG Green-Lagrange's, EPSL logarithmic."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from .concepts import CellPart, Stored
from .mesh_parts import blocks_with, nodes_of_part, points_of
from .shapes import DIMENSIONS, gauss_points, reference_nodes, shape_gradients, shape_of, shape_values


def linear(h: np.ndarray) -> np.ndarray:
    return 0.5 * (h + np.swapaxes(h, -1, -2))


def green_lagrange(h: np.ndarray) -> np.ndarray:
    return linear(h) + 0.5 * np.swapaxes(h, -1, -2) @ h


def logarithmic(h: np.ndarray) -> np.ndarray:
    """½ ln C. C − 1 keeps the digits of small strains."""
    excess, axes = np.linalg.eigh(2 * green_lagrange(h))
    with np.errstate(invalid="ignore", divide="ignore"):
        principal = 0.5 * np.log1p(excess)
    return np.einsum("...ij,...j,...kj->...ik", axes, principal, axes)


MEASURES: dict[str, Callable[[np.ndarray], np.ndarray]] = {
    "EPSI": linear, "EPSG": green_lagrange, "EPSL": logarithmic, "EPME": linear, "EPMG": green_lagrange,
}
# Components in Code_Aster's order.
PLACES = ((0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2))


def strain_parts(stored: Stored, kind: str, place: str) -> list[CellPart]:
    """Returns a strain at Gauss points, or extrapolated from them to the nodes of cells: cells × places × components. In
    plane stress the component ZZ is nan, because it follows from the law alone."""
    solved = stored.solved
    points = points_of(solved.mesh)
    moves = np.nan_to_num(solved.displacement(stored.state))
    count = 4 if solved.mesh.dimension == 2 else 6
    parts = []
    for cell_type, cells in blocks_with(solved.mesh, solved.cell_of):
        if DIMENSIONS.get(cell_type) != solved.mesh.dimension:
            continue
        nodes = nodes_of_part(solved.mesh, cells)
        h = gradients(solved.physics, cell_type, points[nodes], moves[nodes])
        tensor = MEASURES[kind](h)
        values = np.stack([tensor[..., i, j] for i, j in PLACES[:count]], axis=-1)
        if solved.physics == "plane_stress":
            values[..., 2] = np.nan
        if place == "ELNO":
            values = np.einsum("np,cpk->cnk", to_nodes(cell_type), values)
        parts.append(CellPart(cells, values))
    return parts


def gradients(physics: str, cell_type: str, corners: np.ndarray, moves: np.ndarray) -> np.ndarray:
    """Returns ∂u/∂X at the Gauss points, cells × points × 3 × 3. `corners`, `moves`: cells × nodes × 3."""
    xi = gauss_points(cell_type)[0]
    by_reference = shape_gradients(cell_type, xi)
    dimension = by_reference.shape[2]
    to_reference = np.einsum("pnd,cnx->cpdx", by_reference, corners)[..., :dimension]
    slopes = np.einsum("cpxd,pnd->cpnx", np.linalg.inv(to_reference), by_reference)
    h = np.zeros((*slopes.shape[:2], 3, 3))
    h[..., :dimension, :dimension] = np.einsum("cnx,cpny->cpxy", moves[..., :dimension], slopes)
    if physics == "axisymmetric":
        shapes = shape_values(cell_type, xi)
        h[..., 2, 2] = (moves[..., 0] @ shapes.T) / (corners[..., 0] @ shapes.T)
    return h


def to_nodes(cell_type: str) -> np.ndarray:
    """Returns nodes × points: fits the corners' shape functions to the values at the Gauss points by least squares."""
    family = shape_of(cell_type).corners
    linear_type = next(name for name in DIMENSIONS if name.rstrip("0123456789") == family and shape_of(name).order == 1)
    at_points = shape_values(linear_type, gauss_points(cell_type)[0])
    return shape_values(linear_type, reference_nodes(cell_type)) @ np.linalg.pinv(at_points)
