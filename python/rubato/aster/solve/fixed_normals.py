# SPDX-License-Identifier: LGPL-3.0-or-later
"""Fixed normals and directions of projection (VECT_MAIT, VECT_ESCL, TYPE_PROJECTION) are available if they are the
normals of the faces. Others are refused."""

from __future__ import annotations

from typing import Any

import numpy as np

from ..keys import Arguments, CommandError
from ..mesh_parts import blocks_with, nodes_of_part
from ..normals import face_normals
from .problem import Problem

# Largest angle between the vector and a normal [radians]. The error of a gap is half its square.
SAME_DIRECTION = 1e-3


def check_fixed_normals(problem: Problem, given: Arguments, zone: Any, master: np.ndarray, slave: np.ndarray) -> None:
    """Chooses the surface whose normals are the given ones. Raises CommandError where no surface has them."""
    for side, faces in (("MAIT", master), ("ESCL", slave)):
        if given.get(f"VECT_{side}") == "VECT_Y":
            raise CommandError(f"DEFI_CONTACT/ZONE/VECT_{side}: VECT_Y is that of lines in space; faces have normals.")
        if given.get(f"VECT_{side}") == "AUTO" or side not in given.NORMALE.split("_"):
            continue
        vector = direction(problem, given, f"{side}_FIXE", f"VECT_{side}='FIXE'")
        away = deviation(problem, faces, vector)
        if away > SAME_DIRECTION and given.NORMALE == "ESCL" and deviation(problem, master, vector) <= SAME_DIRECTION:
            zone.normal = "master"
        elif away > SAME_DIRECTION:
            refuse(f"VECT_{side}", f"{side}_FIXE", f"GROUP_MA_{side}", away)
        problem.notes.append(f"DEFI_CONTACT: VECT_{side}='FIXE' is the normal of the faces, and turns with them.")
    if given.TYPE_PROJECTION == "FIXE":
        away = deviation(problem, master, direction(problem, given, "DIRE_APPA", "TYPE_PROJECTION='FIXE'"))
        if away > SAME_DIRECTION:
            refuse("TYPE_PROJECTION", "DIRE_APPA", "GROUP_MA_MAIT", away)
        problem.notes.append("DEFI_CONTACT: TYPE_PROJECTION='FIXE' is along the normals of the master, and turns with "
                             "them.")


def refuse(keyword: str, vector: str, group: str, away: float) -> None:
    raise CommandError(f"DEFI_CONTACT/ZONE/{keyword}: {vector} is up to {np.degrees(away):.3g} degrees off the normals of "
                       f"the faces of {group}; directions that are not those of the faces are not available.")


def direction(problem: Problem, given: Arguments, keyword: str, needed_by: str) -> np.ndarray:
    values = given.get(keyword)
    if len(values) not in (problem.dimension, 3) or not np.any(values):
        raise CommandError(f"DEFI_CONTACT/ZONE/{keyword}: {needed_by} needs a vector of {problem.dimension} numbers that "
                           f"are not all 0, found {len(values)} numbers.")
    vector = np.array((*values, 0.0)[:3])
    return vector / np.linalg.norm(vector)


def deviation(problem: Problem, faces: np.ndarray, vector: np.ndarray) -> float:
    """Returns the largest angle between the vector and normals at the nodes of faces, regardless of sign [radians]."""
    points = np.asarray(problem.concept.mesh.points)
    largest = 0.0
    for cell_type, cells in blocks_with(problem.concept, faces):
        normals = face_normals(cell_type, points[nodes_of_part(problem.concept, cells)], problem.dimension)
        across = np.linalg.norm(np.cross(normals, vector), axis=-1)
        largest = max(largest, float(np.max(np.arctan2(across, np.abs(normals @ vector)))))
    return largest
