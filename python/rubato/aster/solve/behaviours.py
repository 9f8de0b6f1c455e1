# SPDX-License-Identifier: LGPL-3.0-or-later
"""COMPORTEMENT: which law and which strain cells have. Formulas of the laws: Code_Aster's R5.03.02, R5.03.04, R5.03.16,
R5.03.19 (plasticity), R5.03.20 (GROT_GDEP) and R5.03.22 (GDEF_LOG)."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np

import rubato

from ..concepts import MaterialConcept, TableFunction
from ..keys import Arguments, CommandError
from .problem import Problem

STRAINS = {"PETIT": "small", "GROT_GDEP": "green_lagrange", "GREEN_LAGRANGE": "green_lagrange", "GDEF_LOG": "logarithmic",
           "SIMO_MIEHE": "logarithmic", "PETIT_REAC": "logarithmic"}
# Notes about strains that are solved as other ones.
NOTES = {
    "SIMO_MIEHE": "SIMO_MIEHE is solved as GDEF_LOG; forces of bodies that yield differ by some tenths of a percent.",
    "PETIT_REAC": "PETIT_REAC is solved as GDEF_LOG: small strains on the current geometry add up to logarithmic ones; "
                  "stresses turn with the body here, and do not turn in PETIT_REAC.",
}


class Behaviour(NamedTuple):
    relation: str = "ELAS"
    deformation: str = "PETIT"


def behaviours_of_cells(problem: Problem, arguments: Arguments) -> list[Behaviour]:
    """One for each cell of the command file's mesh; entries that come later count."""
    of_cell = [Behaviour()] * problem.concept.mesh.cell_count
    for keyword in ("COMPORTEMENT", "COMP_INCR", "COMP_ELAS"):
        for item in arguments.get(keyword) or []:
            behaviour = Behaviour(item.RELATION, item.DEFORMATION)
            named = item.get("GROUP_MA") or item.get("MAILLE")
            for cell in problem.concept.cells(item) if named else problem.concept.all_cells():
                of_cell[int(cell)] = behaviour
    return of_cell


def split_by_behaviour(of_cell: list[Behaviour], cells: np.ndarray) -> list[tuple[Behaviour, np.ndarray]]:
    kinds = list(dict.fromkeys(of_cell[int(cell)] for cell in cells))
    return [(kind, np.array([cell for cell in cells if of_cell[int(cell)] == kind])) for kind in kinds]


def give_behaviour(problem: Problem, material: Any, concept: MaterialConcept, behaviour: Behaviour) -> None:
    """Gives a material of rubato its law, its strain and Code_Aster's integration of all points."""
    relation, deformation = behaviour
    if relation == "ELAS":
        if STRAINS[deformation] == "logarithmic" and "ELAS_ORTH" in concept.laws:
            raise CommandError(f"{problem.command}/COMPORTEMENT/DEFORMATION: {deformation} is not available with "
                               "ELAS_ORTH; PETIT and GROT_GDEP are.")
    elif relation == "ELAS_HYPER":
        if STRAINS[deformation] == "logarithmic":
            raise CommandError(f"{problem.command}/COMPORTEMENT/DEFORMATION: ELAS_HYPER goes with GROT_GDEP.")
        give_rubber(problem, material, concept)
        deformation = "GROT_GDEP"
    else:
        material.law = "plastic"
        PLASTIC[relation](problem, material, concept)
    if deformation in NOTES:
        problem.notes.append(f"{problem.command}/COMPORTEMENT/DEFORMATION: {NOTES[deformation]}")
    strain = STRAINS[deformation]
    if relation != "ELAS" or strain != "small":
        material.strain = strain
        material.formulation = "full"


def law_of(problem: Problem, concept: MaterialConcept, relation: str, name: str) -> Arguments:
    if name not in concept.laws:
        raise CommandError(f"{problem.command}/COMPORTEMENT/RELATION: {relation} needs {name}, which material "
                           f"{concept.name} does not have.")
    return concept.laws[name]


def hardening_modulus(young: float, tangent: float) -> float:
    """dR/dp of a slope of the tension curve."""
    return young * tangent / (young - tangent)


def give_linear(material: Any, yield_stress: float, modulus: float) -> None:
    material.plasticity.hardening = "linear"
    material.plasticity.yield_stress = yield_stress
    material.plasticity.modulus = modulus


def isotropic_linear(problem: Problem, material: Any, concept: MaterialConcept) -> None:
    numbers = law_of(problem, concept, "VMIS_ISOT_LINE", "ECRO_LINE")
    give_linear(material, numbers.SY, hardening_modulus(material.young, numbers.D_SIGM_EPSI))


def isotropic_table(problem: Problem, material: Any, concept: MaterialConcept) -> None:
    curve = law_of(problem, concept, "VMIS_ISOT_TRAC", "TRACTION").SIGM
    if not isinstance(curve, TableFunction) or len(curve.places) == 0:
        raise CommandError(f"{problem.command}/COMPORTEMENT/RELATION: TRACTION/SIGM of material {concept.name} must be "
                           "a DEFI_FONCTION of the strain.")
    if len(curve.places) > 1 and curve.after == "CONSTANT":
        raise CommandError(f"{problem.command}/COMPORTEMENT/RELATION: TRACTION/SIGM of material {concept.name} has "
                           "PROL_DROITE='CONSTANT'; the last slope goes on here: add a last point far away.")
    material.plasticity.hardening = "tension_table"
    material.plasticity.points = [(float(x), float(y)) for x, y in zip(curve.places, curve.values, strict=True)]
    material.plasticity.yield_stress = float(curve.values[0])


def kinematic_linear(problem: Problem, material: Any, concept: MaterialConcept) -> None:
    numbers = law_of(problem, concept, "VMIS_CINE_LINE", "ECRO_LINE")
    give_linear(material, numbers.SY, 0.0)
    modulus = hardening_modulus(material.young, numbers.D_SIGM_EPSI)
    material.plasticity.kinematic = [rubato.BackStress(modulus=modulus, recall=0.0)]


def mixed_linear(problem: Problem, material: Any, concept: MaterialConcept) -> None:
    """Their back stress is C ε^p, ours ⅔ C α."""
    numbers = law_of(problem, concept, "VMIS_ECMI_LINE", "ECRO_LINE")
    kinematic = 1.5 * law_of(problem, concept, "VMIS_ECMI_LINE", "PRAGER").C
    give_linear(material, numbers.SY, hardening_modulus(material.young, numbers.D_SIGM_EPSI) - kinematic)
    material.plasticity.kinematic = [rubato.BackStress(modulus=kinematic, recall=0.0)]


def give_chaboche(problem: Problem, material: Any, concept: MaterialConcept, name: str,
                  terms: list[tuple[float, float]]) -> None:
    """R = R_I + (R_0 − R_I) e^(−B p)."""
    numbers = concept.laws[name]
    # C(p) = C_I (1 + (K − 1) e^(−W p)), γ(p) = G_0 (A_I + (1 − A_I) e^(−B p))
    if numbers.K != 1 and numbers.W != 0:
        raise CommandError(f"{problem.command}/COMPORTEMENT/RELATION: {name} of material {concept.name} has a modulus "
                           "that changes with p (K, W); K = 1 is available.")
    if numbers.A_I != 1:
        raise CommandError(f"{problem.command}/COMPORTEMENT/RELATION: {name} of material {concept.name} has a recall "
                           "that changes with p (A_I); A_I = 1 is available.")
    if numbers.R_I is not None and numbers.R_I < numbers.R_0:
        raise CommandError(f"{problem.command}/COMPORTEMENT/RELATION: {name} of material {concept.name} softens: R_I "
                           f"{numbers.R_I:g} is below R_0 {numbers.R_0:g}; its answer would depend on the mesh.")
    final = numbers.R_0 if numbers.R_I is None else numbers.R_I
    if final > numbers.R_0 and numbers.B:
        material.plasticity.hardening = "voce"
        material.plasticity.yield_stress = numbers.R_0
        material.plasticity.saturation = final - numbers.R_0
        material.plasticity.rate = numbers.B
    else:
        give_linear(material, numbers.R_0, 0.0)
    material.plasticity.kinematic = [rubato.BackStress(modulus=modulus * numbers.K, recall=recall)
                                     for modulus, recall in terms]


def chaboche_one(problem: Problem, material: Any, concept: MaterialConcept) -> None:
    numbers = law_of(problem, concept, "VMIS_CIN1_CHAB", "CIN1_CHAB")
    give_chaboche(problem, material, concept, "CIN1_CHAB", [(numbers.C_I, numbers.G_0)])


def chaboche_two(problem: Problem, material: Any, concept: MaterialConcept) -> None:
    numbers = law_of(problem, concept, "VMIS_CIN2_CHAB", "CIN2_CHAB")
    give_chaboche(problem, material, concept, "CIN2_CHAB",
                  [(numbers.C1_I, numbers.G1_0), (numbers.C2_I, numbers.G2_0)])


def johnson_cook(problem: Problem, material: Any, concept: MaterialConcept) -> None:
    numbers = law_of(problem, concept, "VMIS_JOHN_COOK", "ECRO_COOK")
    # The factor of temperature is 1 without AFFE_VARC: 1 − ((T − TROOM)/(TMELT − TROOM))^M_PUIS is 1.
    if problem.has_temperatures and numbers.TMELT is not None and (numbers.M_PUIS or numbers.M):
        raise CommandError(f"{problem.command}/COMPORTEMENT/RELATION: ECRO_COOK of material {concept.name} softens with "
                           "the temperature (TMELT, M_PUIS), which is not available with AFFE_VARC TEMP.")
    plasticity = material.plasticity
    plasticity.hardening = "johnson_cook"
    plasticity.yield_stress, plasticity.factor, plasticity.exponent = numbers.A, numbers.B, numbers.N_PUIS
    plasticity.rate_factor, plasticity.reference_rate = numbers.C or 0.0, numbers.EPSP0 or 1.0


PLASTIC: dict[str, Callable[[Problem, Any, MaterialConcept], None]] = {
    "VMIS_ISOT_LINE": isotropic_linear,
    "VMIS_ISOT_TRAC": isotropic_table,
    "VMIS_CINE_LINE": kinematic_linear,
    "VMIS_ECMI_LINE": mixed_linear,
    "VMIS_CIN1_CHAB": chaboche_one,
    "VMIS_CIN2_CHAB": chaboche_two,
    "VMIS_JOHN_COOK": johnson_cook,
}


def give_rubber(problem: Problem, material: Any, concept: MaterialConcept) -> None:
    """Without K it is 6 (C10 + C01)/(3 (1 − 2 NU))."""
    numbers = law_of(problem, concept, "ELAS_HYPER", "ELAS_HYPER")
    rubber = material.hyperelasticity
    rubber.c10, rubber.c01 = numbers.C10, numbers.C01
    rubber.volume = "quadratic"
    rubber.bulk = numbers.K
    if rubber.bulk is None:
        if numbers.NU is None:
            raise CommandError(f"{problem.command}/CHAM_MATER: ELAS_HYPER of material {concept.name} has neither K nor "
                               "NU.")
        rubber.bulk = 6 * (numbers.C10 + numbers.C01) / (3 * (1 - 2 * numbers.NU))
    if not numbers.C20:
        material.law = "hyperelastic"
    elif numbers.C01 == 0:
        material.law = "yeoh"
        rubber.c20 = numbers.C20
    else:
        raise CommandError(f"{problem.command}/CHAM_MATER: ELAS_HYPER of material {concept.name} has C01 and C20; one of "
                           "them is available.")
