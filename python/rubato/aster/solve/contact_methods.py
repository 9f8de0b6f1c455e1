# SPDX-License-Identifier: LGPL-3.0-or-later
"""The method of contact that solves a zone of DEFI_CONTACT."""

from __future__ import annotations

import numpy as np

from ..keys import Arguments, CommandError
from .problem import Problem

# Largest ratio of a penalty to the stiffness of the cells beside the surface.
STIFF = 1e5
METHODS = {
    ("CONTINUE", "STANDARD"): "augmented_lagrangian", ("CONTINUE", "PENALISATION"): "penalty",
    ("CONTINUE", "LAC"): "augmented_lagrangian", ("DISCRETE", "CONTRAINTE"): "nodal_lagrange",
    ("DISCRETE", "LAGRANGIEN"): "nodal_lagrange", ("DISCRETE", "PENALISATION"): "nodal_penalty",
    ("DISCRETE", "GCP"): "nodal_pcg", ("DISCRETE", "VERIF"): "nodal_lagrange",
}
USUAL = {"CONTINUE": "STANDARD", "DISCRETE": "CONTRAINTE"}


def algorithm_of(problem: Problem, contact: Arguments, zone: Arguments) -> str:
    """Returns ALGO_CONT. Contact by penalties that Code_Aster raises is solved without penetration."""
    formulation = contact.FORMULATION
    algorithm = named_algorithm(contact, zone)
    if algorithm != "PENALISATION":
        return algorithm
    exact = "LAC" if zone.APPARIEMENT == "MORTAR" else USUAL[formulation]
    if problem.bounds_penetration:
        return exact
    if formulation != "CONTINUE" or not adapts(zone):
        return algorithm
    if penalty_of(zone, "COEF_PENA_CONT") is None:
        problem.notes.append(f"DEFI_CONTACT: ADAPTATION='{zone.ADAPTATION}' without COEF_PENA_CONT is solved without "
                             "penetration, as ALGO_CONT='STANDARD': that is within any PENE_MAXI.")
        return exact
    problem.notes.append(f"DEFI_CONTACT: ADAPTATION='{zone.ADAPTATION}': penalties stay as they are given.")
    return algorithm


def named_algorithm(contact: Arguments, zone: Arguments) -> str:
    """Returns ALGO_CONT or its default. APPARIEMENT='MORTAR' is the older spelling of LAC."""
    formulation = contact.FORMULATION
    algorithm = zone.ALGO_CONT or USUAL[formulation]
    if zone.APPARIEMENT == "MORTAR":
        if formulation != "CONTINUE":
            raise CommandError(f"DEFI_CONTACT/ZONE/APPARIEMENT: MORTAR is not available with {formulation}; CONTINUE has "
                               "it.")
        algorithm = "PENALISATION" if algorithm == "PENALISATION" else "LAC"
    if (formulation, algorithm) not in METHODS:
        raise CommandError(f"DEFI_CONTACT/ZONE/ALGO_CONT: {algorithm} is not available with {formulation}.")
    return algorithm


def adapts(zone: Arguments) -> bool:
    """Returns whether Code_Aster changes penalties until penetrations are below PENE_MAXI."""
    return zone.ADAPTATION in ("ADAPT_COEF", "TOUT")


def penalty_of(zone: Arguments, name: str) -> float | None:
    """Returns the penalty of the normal direction. COEF_PENA is an older spelling of it."""
    return zone.get(name) if zone.get(name) is not None else zone.COEF_PENA


def bounded(problem: Problem, formulation: str, slave: np.ndarray, penalty: float) -> float:
    """Returns the penalty, limited to STIFF times the stiffness of the smallest slave face. Rounding of larger penalties
    exceeds the forces of the bodies, so that iterations stagnate."""
    points = np.asarray(problem.concept.mesh.points)
    length = min(np.ptp(points[problem.concept.nodes_of_cell(int(cell))], axis=0).max() for cell in slave)
    young = max(max(material.young or 0.0, getattr(material.orthotropy, "young_x", 0.0) or 0.0)
                for material in problem.study.materials)
    # CONTINUE has penalties by area, DISCRETE penalties of nodes [force/length].
    stiffness = young / length if formulation == "CONTINUE" else young * length ** (problem.dimension - 2)
    if young == 0 or penalty <= STIFF * stiffness:
        return penalty
    most = float(f"{STIFF * stiffness:.3g}")
    problem.notes.append(f"DEFI_CONTACT: the penalty {penalty:g} is solved as {most:g}: surfaces penetrate by less than "
                         f"{1 / STIFF:g} of what the cells beside them deform.")
    return most
