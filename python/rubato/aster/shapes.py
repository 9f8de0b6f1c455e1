# SPDX-License-Identifier: LGPL-3.0-or-later
"""Shape functions and Gauss points of the cell types. Nodes are in rubato's order, points in Code_Aster's where it has
the same points. For what is computed on a field without the solver: values at Gauss points, norms, integrals, normals,
values between nodes."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache

import numpy as np

from .keys import CommandError


@dataclass(frozen=True)
class CellShape:
    """A cell type: its linear type, order, and the exponents (of ξ, η, ζ) of its monomials."""

    name: str
    dimension: int
    corners: str
    order: int
    exponents: tuple[tuple[int, int, int], ...]


CORNERS = {
    "point1": ((0, 0, 0),),
    "seg": ((-1, 0, 0), (1, 0, 0)),
    "tria": ((0, 0, 0), (1, 0, 0), (0, 1, 0)),
    "quad": ((-1, -1, 0), (1, -1, 0), (1, 1, 0), (-1, 1, 0)),
    "tetra": ((0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)),
    "pyra": ((-1, -1, 0), (1, -1, 0), (1, 1, 0), (-1, 1, 0), (0, 0, 1)),
    "penta": ((0, 0, -1), (1, 0, -1), (0, 1, -1), (0, 0, 1), (1, 0, 1), (0, 1, 1)),
    "hexa": ((-1, -1, -1), (1, -1, -1), (1, 1, -1), (-1, 1, -1), (-1, -1, 1), (1, -1, 1), (1, 1, 1), (-1, 1, 1)),
}
EDGES = {
    "seg": ((0, 1),),
    "tria": ((0, 1), (1, 2), (2, 0)),
    "quad": ((0, 1), (1, 2), (2, 3), (3, 0)),
    "tetra": ((0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3)),
    "penta": ((0, 1), (1, 2), (2, 0), (3, 4), (4, 5), (5, 3), (0, 3), (1, 4), (2, 5)),
    "hexa": ((0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4), (0, 4), (1, 5), (2, 6), (3, 7)),
}
# Sides with a node in their middle, and whether the cell has an inner node.
CENTRES: dict[str, tuple[tuple[tuple[int, ...], ...], bool]] = {
    "quad9": ((), True),
    "penta18": (((0, 1, 4, 3), (1, 2, 5, 4), (2, 0, 3, 5)), False),
    "hexa27": (((0, 4, 7, 3), (1, 2, 6, 5), (0, 1, 5, 4), (2, 3, 7, 6), (0, 3, 2, 1), (4, 5, 6, 7)), True),
}


def _products(*ranges: int) -> tuple[tuple[int, int, int], ...]:
    a, b, c = (*ranges, 1, 1)[:3]
    return tuple((i, j, k) for k in range(c) for j in range(b) for i in range(a))


def _total(dimension: int, degree: int) -> tuple[tuple[int, int, int], ...]:
    limit = degree + 1
    whole = _products(limit, limit if dimension > 1 else 1, limit if dimension > 2 else 1)
    return tuple(e for e in whole if sum(e) <= degree)


def _serendipity(dimension: int) -> tuple[tuple[int, int, int], ...]:
    """Monomials whose powers above 1 sum to 2 at most."""
    whole = _products(3, 3, 3 if dimension > 2 else 1)
    return tuple(e for e in whole if sum(p for p in e if p > 1) <= 2)


_PRISM_15 = tuple((i, j, k) for k in range(3) for i, j, _ in _total(2, 2) if not (k == 2 and i + j == 2))

SHAPES = {
    shape.name: shape
    for shape in (
        CellShape("point1", 0, "point1", 1, ((0, 0, 0),)),
        CellShape("seg2", 1, "seg", 1, _total(1, 1)),
        CellShape("seg3", 1, "seg", 2, _total(1, 2)),
        CellShape("tria3", 2, "tria", 1, _total(2, 1)),
        CellShape("tria6", 2, "tria", 2, _total(2, 2)),
        CellShape("quad4", 2, "quad", 1, _products(2, 2)),
        CellShape("quad8", 2, "quad", 2, _serendipity(2)),
        CellShape("quad9", 2, "quad", 2, _products(3, 3)),
        CellShape("tetra4", 3, "tetra", 1, _total(3, 1)),
        CellShape("tetra10", 3, "tetra", 2, _total(3, 2)),
        CellShape("penta6", 3, "penta", 1, tuple((i, j, k) for k in range(2) for i, j, _ in _total(2, 1))),
        CellShape("penta15", 3, "penta", 2, _PRISM_15),
        CellShape("penta18", 3, "penta", 2, tuple((i, j, k) for k in range(3) for i, j, _ in _total(2, 2))),
        CellShape("hexa8", 3, "hexa", 1, _products(2, 2, 2)),
        CellShape("hexa20", 3, "hexa", 2, _serendipity(3)),
        CellShape("hexa27", 3, "hexa", 2, _products(3, 3, 3)),
    )
}
DIMENSIONS = {**{name: shape.dimension for name, shape in SHAPES.items()}, "tria7": 2, "pyra5": 3, "pyra13": 3}


def shape_of(cell_type: str) -> CellShape:
    if cell_type not in SHAPES:
        raise CommandError(f"values between the nodes of {cell_type} cells are not available.")
    return SHAPES[cell_type]


@cache
def reference_nodes(cell_type: str) -> np.ndarray:
    """Places of the nodes on the reference cell."""
    shape = shape_of(cell_type)
    corners = np.array(CORNERS[shape.corners], dtype=float)
    nodes = list(corners)
    if shape.order == 2:
        nodes += [corners[list(edge)].mean(axis=0) for edge in EDGES[shape.corners]]
    sides, inner = CENTRES.get(cell_type, ((), False))
    nodes += [corners[list(side)].mean(axis=0) for side in sides]
    if inner:
        nodes.append(corners.mean(axis=0))
    return np.array(nodes)


def _monomials(exponents: np.ndarray, xi: np.ndarray) -> np.ndarray:
    return np.prod(xi[:, None, :] ** exponents[None, :, :], axis=2)


@cache
def _coefficients(cell_type: str) -> tuple[np.ndarray, np.ndarray]:
    """Exponents, and the matrix from monomials to shape functions."""
    exponents = np.array(shape_of(cell_type).exponents)
    return exponents, np.linalg.inv(_monomials(exponents, reference_nodes(cell_type)))


def shape_values(cell_type: str, xi: np.ndarray) -> np.ndarray:
    """Points × nodes."""
    exponents, matrix = _coefficients(cell_type)
    return _monomials(exponents, np.atleast_2d(xi)) @ matrix


def shape_gradients(cell_type: str, xi: np.ndarray) -> np.ndarray:
    """Points × nodes × reference directions of the cell."""
    exponents, matrix = _coefficients(cell_type)
    xi = np.atleast_2d(xi)
    parts = []
    for axis in range(shape_of(cell_type).dimension):
        lowered = exponents.copy()
        lowered[:, axis] = np.maximum(exponents[:, axis] - 1, 0)
        parts.append((_monomials(lowered, xi) * exponents[:, axis]) @ matrix)
    return np.stack(parts, axis=2)


# ---- Gauss points ----------------------------------------------------------------------------------------------

Rule = tuple[np.ndarray, np.ndarray]


def _line(n: int) -> Rule:
    x, weights = np.polynomial.legendre.leggauss(n)
    return np.column_stack([x, np.zeros((n, 2))]), weights


def _extruded(base: Rule, line: Rule, axis: int) -> Rule:
    """Points of the base repeated along an axis, which runs slowest."""
    points, weights = [], []
    for level, weight in zip(*line):
        moved = base[0].copy()
        moved[:, axis] = level[0]
        points.append(moved)
        weights.append(base[1] * weight)
    return np.concatenate(points), np.concatenate(weights)


def _orbits(*rows: tuple[list[tuple[float, float, float]], float]) -> Rule:
    points = np.array([point for orbit, _ in rows for point in orbit])
    return points, np.array([weight for orbit, weight in rows for _ in orbit])


def _triangle(points: int) -> Rule:
    if points == 1:
        return _orbits(([(1 / 3, 1 / 3, 0)], 0.5))
    if points == 3:
        return _orbits(([(1 / 6, 1 / 6, 0), (2 / 3, 1 / 6, 0), (1 / 6, 2 / 3, 0)], 1 / 6))
    a, b = 0.44594849091596488632, 0.09157621350977074346
    return _orbits(([(b, b, 0), (1 - 2 * b, b, 0), (b, 1 - 2 * b, 0)], 0.10995174365532186764 / 2),
                   ([(a, 1 - 2 * a, 0), (a, a, 0), (1 - 2 * a, a, 0)], 0.22338158967801146570 / 2))


def _tetrahedron(points: int) -> Rule:
    if points == 1:
        return _orbits(([(0.25, 0.25, 0.25)], 1 / 6))
    p = (5 - 5**0.5) / 20
    return _orbits(([(p, p, p), (1 - 3 * p, p, p), (p, 1 - 3 * p, p), (p, p, 1 - 3 * p)], 1 / 24))


def _square(n: int) -> Rule:
    return _extruded(_line(n), _line(n), 1)


@cache
def point_order(cell_type: str) -> np.ndarray | None:
    """Which of rubato's points each of Code_Aster's is. rubato: the first direction runs fastest. Code_Aster: in
    quadrangles around the cell, corners first; in hexahedra the last direction runs fastest. None: the same order."""
    if cell_type == "quad4":
        return np.array([0, 1, 3, 2])
    if cell_type in ("quad8", "quad9"):
        return np.array([0, 2, 8, 6, 1, 5, 7, 3, 4])
    if cell_type in ("hexa8", "hexa20", "hexa27"):
        n = 2 if cell_type == "hexa8" else 3
        return np.array([i + n * j + n * n * k for i in range(n) for j in range(n) for k in range(n)])
    return None


@cache
def gauss_points(cell_type: str) -> Rule:
    """Places and weights of the points at which stresses are computed, in the order of point_order."""
    points, weights = _rubato_points(cell_type)
    order = point_order(cell_type)
    return (points, weights) if order is None else (points[order], weights[order])


def _rubato_points(cell_type: str) -> Rule:
    rules = {
        "point1": lambda: (np.zeros((1, 3)), np.ones(1)),
        "seg2": lambda: _line(2), "seg3": lambda: _line(3),
        "tria3": lambda: _triangle(1), "tria6": lambda: _triangle(3),
        "quad4": lambda: _square(2), "quad8": lambda: _square(3), "quad9": lambda: _square(3),
        "tetra4": lambda: _tetrahedron(1), "tetra10": lambda: _tetrahedron(4),
        "penta6": lambda: _extruded(_triangle(3), _line(2), 2),
        "penta15": lambda: _extruded(_triangle(6), _line(3), 2),
        "penta18": lambda: _extruded(_triangle(6), _line(3), 2),
        "hexa8": lambda: _extruded(_square(2), _line(2), 2),
        "hexa20": lambda: _extruded(_square(3), _line(3), 2),
        "hexa27": lambda: _extruded(_square(3), _line(3), 2),
    }
    if cell_type not in rules:
        raise CommandError(f"Gauss points of {cell_type} cells are not available here.")
    return rules[cell_type]()


@cache
def mass_points(cell_type: str) -> Rule:
    """Points that integrate products of two shape functions exactly on cells with straight sides."""
    richer = {"tria3": lambda: _triangle(3), "tria6": lambda: _triangle(6), "tetra4": lambda: _tetrahedron(4),
              "tetra10": _tetrahedron_of_cube}
    return richer[cell_type]() if cell_type in richer else gauss_points(cell_type)


def _tetrahedron_of_cube() -> Rule:
    """Of degree 4: Gauss points of a cube that one of its corners collapses."""
    points, weights = _extruded(_square(4), _line(4), 2)
    x = 0.5 * (1 + points[:, 0])
    y = 0.5 * (1 - x) * (1 + points[:, 1])
    z = 0.5 * (1 - x - y) * (1 + points[:, 2])
    return np.column_stack([x, y, z]), weights * 0.125 * (1 - x) * (1 - x - y)


def measures(cell_type: str, corners: np.ndarray, xi: np.ndarray, weights: np.ndarray) -> np.ndarray:
    """Length, area or volume of each point of each cell. `corners`: cells × nodes × 3."""
    tangents = np.einsum("pnd,cnx->cpdx", shape_gradients(cell_type, xi), corners)
    gram = np.einsum("cpdx,cpex->cpde", tangents, tangents)
    return np.sqrt(np.maximum(np.linalg.det(gram), 0.0)) * weights
