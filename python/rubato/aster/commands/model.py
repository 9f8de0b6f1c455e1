# SPDX-License-Identifier: LGPL-3.0-or-later
"""AFFE_MODELE, DEFI_MATERIAU, AFFE_MATERIAU, AFFE_CARA_ELEM: what cells are and what they are made of."""

from __future__ import annotations

from typing import Any

from ..concepts import DiscreteField, MaterialConcept, MaterialField, ModelConcept, ModelPart
from ..keys import (Arguments, Command, CommandError, Key, concept, factor, harmless, real, reals,
                    text, texts, words, yes)

# ---- model -----------------------------------------------------------------------------------------------------

PHYSICS = {"3D": "solid", "C_PLAN": "plane_stress", "D_PLAN": "plane_strain", "AXIS": "axisymmetric"}
PHYSICS |= {f"{kind}_SI": physics for kind, physics in PHYSICS.items()}
DISCRETE = ("DIS_T", "2D_DIS_T")
_MISSING_KINDS = {
    "DIS_TR": "Discrete elements have no rotations here: DIS_T.", "2D_DIS_TR": "Discrete elements: 2D_DIS_T.",
    **{kind: "There are solids only: 3D, C_PLAN, D_PLAN, AXIS." for kind in (
        "DKT", "DST", "Q4G", "COQUE_3D", "COQUE_AXIS", "POU_D_E", "POU_D_T", "POU_D_TG", "POU_D_EM", "BARRE",
        "2D_BARRE", "CABLE", "MEMBRANE", "GRILLE_MEMBRANE", "DKTG", "PLAN", "3D_INCO_UP", "3D_INCO_UPG",
        "D_PLAN_INCO_UP", "AXIS_INCO_UP", "3D_GRAD_VARI")},
}

AFFE_MODELE = {
    "MAILLAGE": concept("MeshConcept", required=True),
    "AFFE": factor({
        "TOUT": yes(), "GROUP_MA": texts(), "MAILLE": texts(), "GROUP_NO": texts(), "NOEUD": texts(),
        "PHENOMENE": words("MECANIQUE", missing={"THERMIQUE": "Temperatures are given by CREA_RESU or LIRE_RESU.",
                                                 "ACOUSTIQUE": ""}),
        "MODELISATION": words(*PHYSICS, *DISCRETE, many=True, missing=_MISSING_KINDS, required=True),
    }),
    "DISTRIBUTION": harmless(), "VERI_JACOBIEN": harmless(), "INFO": harmless(), "PARTITION": harmless(),
    "GRANDEUR_CARA": harmless(), "VERI_PLAN": harmless(), "VERI_NORM_IFS": harmless(),
}


def affe_modele(session: Any, arguments: Arguments) -> ModelConcept:
    mesh = arguments.MAILLAGE
    parts = []
    for item in arguments.AFFE:
        if len(item.MODELISATION) != 1:
            raise CommandError("AFFE_MODELE/MODELISATION: expected one word.")
        parts.append(ModelPart(mesh.cells(item), item.MODELISATION[0]))
    if not parts:
        raise CommandError("AFFE_MODELE: keyword AFFE is missing.")
    kinds = {PHYSICS[part.kind] for part in parts if part.kind in PHYSICS}
    if len(kinds) > 1:
        raise CommandError(f"AFFE_MODELE: a model has one kind of solids, found {', '.join(sorted(kinds))}.")
    return ModelConcept(mesh, parts)


# ---- materials -------------------------------------------------------------------------------------------------

_ELAS = {"E": real(required=True), "NU": real(required=True), "RHO": real(), "ALPHA": real(), "AMOR_ALPHA": real(),
         "AMOR_BETA": real(), "AMOR_HYST": harmless(), "COEF_AMOR": harmless()}
_ELAS_ORTH = {"E_L": real(required=True), "E_T": real(required=True), "E_N": real(), "NU_LT": real(required=True),
              "NU_LN": real(), "NU_TN": real(), "G_LT": real(required=True), "G_LN": real(), "G_TN": real(),
              "RHO": real(), "ALPHA_L": real(), "ALPHA_T": real(), "ALPHA_N": real(), "AMOR_ALPHA": real(),
              "AMOR_BETA": real()}
_CHABOCHE = {"R_0": real(required=True), "R_I": real(), "B": real(0.0), "K": real(1.0), "W": real(0.0), "A_I": real(1.0)}
# What laws of COMPORTEMENT take beside the elastic numbers.
_PLASTIC: dict[str, dict[str, Key]] = {
    "ECRO_LINE": {"D_SIGM_EPSI": real(required=True), "SY": real(required=True), "SIGM_LIM": harmless(),
                  "EPSI_LIM": harmless()},
    "TRACTION": {"SIGM": concept("Function", required=True)},
    "PRAGER": {"C": real(required=True)},
    "CIN1_CHAB": {**_CHABOCHE, "C_I": real(required=True), "G_0": real(0.0)},
    "CIN2_CHAB": {**_CHABOCHE, "C1_I": real(required=True), "C2_I": real(required=True), "G1_0": real(0.0),
                  "G2_0": real(0.0)},
    "ECRO_COOK": {"A": real(required=True), "B": real(0.0), "N_PUIS": real(1.0), "C": real(0.0), "EPSP0": real(1.0),
                  "M_PUIS": real(), "M": real(), "TROOM": real(), "TMELT": real(), "EPSPM": harmless()},
}
_ELAS_HYPER = {"C10": real(required=True), "C01": real(0.0), "C20": real(0.0), "K": real(), "NU": real(), "RHO": real()}
# Laws that no RELATION here asks for: their numbers are kept and say nothing.
_UNUSED = ("ECRO_PUIS", "ECRO_NL", "LEMAITRE", "VISCOCHAB", "THER", "FATIGUE", "WEIBULL", "RCCM", "TAHERI",
           "BETON_DOMMAGE_SB")

DEFI_MATERIAU: dict[str, Key] = {
    "ELAS": factor(_ELAS, most=1), "ELAS_ORTH": factor(_ELAS_ORTH, most=1), "ELAS_HYPER": factor(_ELAS_HYPER, most=1),
    "INFO": harmless(), "TITRE": harmless(),
    **{law: factor(keys, most=1) for law, keys in _PLASTIC.items()},
    **{law: harmless() for law in _UNUSED},
}


def defi_materiau(session: Any, arguments: Arguments) -> MaterialConcept:
    laws = {name: getattr(arguments, name)[0] for name in ("ELAS", "ELAS_ORTH", "ELAS_HYPER", *_PLASTIC)
            if getattr(arguments, name)}
    if "ELAS" in laws and "ELAS_ORTH" in laws:
        raise CommandError("DEFI_MATERIAU: expected one of ELAS and ELAS_ORTH.")
    return MaterialConcept(laws)


AFFE_MATERIAU = {
    "MAILLAGE": concept("MeshConcept"), "MODELE": concept("ModelConcept"),
    "AFFE": factor({"TOUT": yes(), "GROUP_MA": texts(), "MAILLE": texts(), "GROUP_NO": harmless(),
                    "MATER": concept("MaterialConcept", many=True, required=True), "TEMP_REF": real()}),
    "AFFE_COMPOR": harmless(),
    "AFFE_VARC": factor({"TOUT": yes(), "GROUP_MA": texts(), "MAILLE": texts(), "NOM_CHAM": words("TEMP"),
                         "NOM_VARC": words("TEMP", required=True), "CHAM_GD": concept("NodalField"),
                         "EVOL": concept("Result"), "FONC_INST": concept("Function", "RealList"),
                         "PROL_DROITE": text("EXCLU"), "PROL_GAUCHE": text("EXCLU"), "VALE_REF": real()}),
    "INFO": harmless(), "LIST_NOM_VARC": harmless(),
}


def affe_materiau(session: Any, arguments: Arguments) -> MaterialField:
    mesh = arguments.MAILLAGE or (arguments.MODELE.mesh if arguments.MODELE else None)
    if mesh is None:
        raise CommandError("AFFE_MATERIAU: keyword MAILLAGE is missing.")
    parts = []
    for item in arguments.AFFE:
        elastic = [material for material in item.MATER if material.laws] or list(item.MATER)
        if len(elastic) > 1:
            raise CommandError("AFFE_MATERIAU/MATER: expected one material with ELAS or ELAS_ORTH.")
        parts.append((mesh.cells(item), elastic[0]))
    return MaterialField(mesh, parts, list(arguments.AFFE_VARC))


# ---- discrete elements -----------------------------------------------------------------------------------------

AFFE_CARA_ELEM = {
    "MODELE": concept("ModelConcept", required=True), "INFO": harmless(), "VERIF": harmless(),
    "DISCRET": factor({"CARA": words("K_T_D_L", "K_T_D_N", "M_T_D_N", "M_T_L", "M_T_D_L", "A_T_D_L", "A_T_D_N",
                                     required=True),
                       "VALE": reals(required=True), "GROUP_MA": texts(), "MAILLE": texts(), "GROUP_NO": texts(),
                       "NOEUD": texts(), "REPERE": words("GLOBAL", "LOCAL", default="GLOBAL"), "SYME": harmless()}),
    "DISCRET_2D": factor({"CARA": words("K_T_D_L", "K_T_D_N", "M_T_D_N", "M_T_L", "M_T_D_L", "A_T_D_L", "A_T_D_N",
                                        required=True),
                          "VALE": reals(required=True), "GROUP_MA": texts(), "MAILLE": texts(), "GROUP_NO": texts(),
                          "NOEUD": texts(), "REPERE": words("GLOBAL", "LOCAL", default="GLOBAL"), "SYME": harmless()}),
    "ORIENTATION": factor({"CARA": words("ANGL_VRIL", "VECT_Y"), "VALE": reals(), "GROUP_MA": texts(),
                           "MAILLE": texts()}),
    "MASSIF": factor({"GROUP_MA": texts(), "MAILLE": texts(), "ANGL_REP": reals(), "ANGL_AXE": reals(),
                      "ORIG_AXE": reals()}),
}


def affe_cara_elem(session: Any, arguments: Arguments) -> DiscreteField:
    made = DiscreteField(arguments.MODELE, [*arguments.DISCRET, *arguments.DISCRET_2D])
    made.axes = list(arguments.MASSIF)
    for item in arguments.ORIENTATION:
        if any(item.VALE):
            raise CommandError("AFFE_CARA_ELEM/ORIENTATION: springs have their x axis along the cell only; "
                               "a turn about it is not available.")
    return made


COMMANDS = [
    Command("AFFE_MODELE", AFFE_MODELE, affe_modele),
    Command("DEFI_MATERIAU", DEFI_MATERIAU, defi_materiau),
    Command("AFFE_MATERIAU", AFFE_MATERIAU, affe_materiau),
    Command("AFFE_CARA_ELEM", AFFE_CARA_ELEM, affe_cara_elem),
]
