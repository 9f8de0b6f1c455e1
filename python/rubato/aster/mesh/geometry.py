# SPDX-License-Identifier: LGPL-3.0-or-later
"""Points moved: by fields, translations, rotations, reflections."""

from __future__ import annotations

import numpy as np

from ..concepts import NodalField
from ..keys import Arguments, CommandError
from .select import in_space

# The perturbation of a mesh is random, but the same in every run.
SEED = 20


def moved_by(path: str, points: np.ndarray, field: NodalField) -> np.ndarray:
    """A displacement added; nodes that do not carry it stay."""
    if len(field.values) != len(points):
        raise CommandError(f"{path}: the field has {len(field.values)} nodes, the mesh {len(points)}.")
    moved = points.copy()
    for axis, component in enumerate(("DX", "DY", "DZ")):
        if component in field.components:
            moved[:, axis] += np.nan_to_num(field.column(component), nan=0.0)
    return moved


def perturbed(points: np.ndarray, share: float) -> np.ndarray:
    """Each coordinate increased by up to that share of the extent of the mesh."""
    extent = np.ptp(points, axis=0)
    return points + share * extent * np.random.default_rng(SEED).random(points.shape)


def in_base(path: str, points: np.ndarray, base: Arguments, dimension: int) -> np.ndarray:
    """Coordinates along the axes VECT_X and VECT_Y."""
    first = in_space(path + "/VECT_X", base.VECT_X)
    second = np.array([-first[1], first[0], 0.0]) if dimension == 2 else in_space(path + "/VECT_Y", base.VECT_Y)
    axes = np.array([_unit(path, first), _unit(path, second), _unit(path, np.cross(first, second))])
    if abs(axes[0] @ axes[1]) > 1e-9:
        raise CommandError(f"{path}: VECT_X and VECT_Y are not at right angles.")
    return points @ axes.T


def rotated(path: str, points: np.ndarray, turn: Arguments, dimension: int) -> np.ndarray:
    """Turned by ANGLE [degrees] about an axis through POIN_1."""
    origin = in_space(path + "/POIN_1", turn.POIN_1)
    if bool(turn.DIR) and bool(turn.POIN_2):
        raise CommandError(f"{path}: expected one of DIR and POIN_2.")
    if dimension == 2:
        axis = np.array([0.0, 0.0, 1.0])
    elif turn.POIN_2:
        axis = in_space(path + "/POIN_2", turn.POIN_2) - origin
    else:
        axis = in_space(path + "/DIR", turn.DIR)
    axis = _unit(path, axis)
    angle = np.radians(turn.ANGLE)
    ways = points - origin
    along = np.outer(ways @ axis, axis)
    return origin + along + np.cos(angle) * (ways - along) + np.sin(angle) * np.cross(axis, ways)


def reflected(path: str, points: np.ndarray, mirror: Arguments, dimension: int) -> np.ndarray:
    """Mirrored in the plane of AXE_1 and AXE_2, in 2D in the line of AXE_1."""
    origin = in_space(path + "/POINT", mirror.POINT)
    first = in_space(path + "/AXE_1", mirror.AXE_1)
    second = np.array([0.0, 0.0, 1.0]) if dimension == 2 else in_space(path + "/AXE_2", mirror.AXE_2)
    normal = _unit(path, np.cross(first, second))
    return points - 2 * np.outer((points - origin) @ normal, normal)


def _unit(path: str, vector: np.ndarray) -> np.ndarray:
    size = np.linalg.norm(vector)
    if size == 0:
        raise CommandError(f"{path}: found a direction of length 0.")
    return vector / size
