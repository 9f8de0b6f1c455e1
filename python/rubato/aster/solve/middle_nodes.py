# SPDX-License-Identifier: LGPL-3.0-or-later
"""Middle nodes of QUAD8 faces in discrete contact. A uniform pressure pulls at the corners of such a face, so
Code_Aster keeps its sides straight: a middle node is at the mean of the corners beside it, and only corners touch."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

import rubato

from ..keys import Arguments
from .problem import Problem
from .relations import term

SIDE = "side_"  # how names of these relations begin


def middle_nodes(problem: Problem, faces: np.ndarray) -> dict[int, tuple[int, int]]:
    """Middle nodes of the QUAD8 among the faces, each with the corners beside it."""
    found: dict[int, tuple[int, int]] = {}
    for block in problem.concept.mesh.blocks:
        if block.type != "quad8":
            continue
        inside = faces[(faces >= block.first) & (faces < block.first + len(block.nodes))] - block.first
        for nodes in np.asarray(block.nodes)[inside]:
            for side in range(4):
                found[int(nodes[4 + side])] = (int(nodes[side]), int(nodes[(side + 1) % 4]))
    return found


def straight_sides(problem: Problem, middles: dict[int, tuple[int, int]],
                   excluded: np.ndarray) -> Iterator[rubato.Relation]:
    """Sides with a node that is left out of contact keep their shape; those of rigid surfaces are imposed anyway."""
    bodies = set(problem.body_nodes.tolist())
    out = set(excluded.tolist())
    for middle, corners in middles.items():
        if middle not in bodies or out & {middle, *corners}:
            continue
        for axis in range(3):
            terms = [term(problem, middle, axis, 1.0), *(term(problem, corner, axis, -0.5) for corner in corners)]
            yield rubato.Relation(name=f"{SIDE}{middle}_{axis}", kind="equation", terms=terms)


def keeps_sides_straight(contact: Arguments, zone: Arguments) -> bool:
    return contact.FORMULATION == "DISCRETE" and zone.RESOLUTION == "OUI" and zone.ALGO_CONT != "VERIF"
