# SPDX-License-Identifier: LGPL-3.0-or-later
"""STAT_NON_LINE, DYNA_NON_LINE, MECA_STATIQUE: their keywords. solve/ does them."""

from __future__ import annotations

from ..keys import (Command, Key, concept, factor, harmless, integer, integers, real, reals, text, texts, words, yes,
                    yes_no)
from ..solve.linear import meca_statique
from ..solve.nonlinear import dyna_non_line, stat_non_line

_plastic = ("Plasticity here: VMIS_ISOT_LINE, VMIS_ISOT_TRAC, VMIS_CINE_LINE, VMIS_ECMI_LINE, VMIS_CIN1_CHAB, "
            "VMIS_CIN2_CHAB, VMIS_JOHN_COOK.")
_strain = "Strains here: PETIT, PETIT_REAC, GROT_GDEP, GDEF_LOG."
_COMPORTEMENT = factor({
    "RELATION": words("ELAS", "ELAS_HYPER", "VMIS_ISOT_LINE", "VMIS_ISOT_TRAC", "VMIS_CINE_LINE", "VMIS_ECMI_LINE",
                      "VMIS_CIN1_CHAB", "VMIS_CIN2_CHAB", "VMIS_JOHN_COOK", default="ELAS", missing={
                          law: _plastic for law in (
                              "LEMAITRE", "ELAS_VMIS_LINE", "VMIS_ECMI_TRAC", "VMIS_ISOT_PUIS", "DIS_CHOC",
                              "DIS_CONTACT", "VISC_CIN1_CHAB", "VISC_CIN2_CHAB", "VMIS_ISOT_NL", "DIS_ECRO_TRAC",
                              "KIT_DDI", "MFRONT", "UMAT")}),
    "DEFORMATION": words("PETIT", "PETIT_REAC", "GROT_GDEP", "GREEN_LAGRANGE", "GDEF_LOG", "SIMO_MIEHE", default="PETIT",
                         missing={kind: _strain for kind in ("GDEF_HYPO_ELAS", "EULER_ALMANSI")}),
    "TOUT": yes(), "GROUP_MA": texts(), "MAILLE": texts(), "PARM_THETA": harmless(), "ITER_INTE_MAXI": harmless(),
    "RESI_INTE_RELA": harmless(), "ALGO_INTE": harmless(), "ITER_INTE_PAS": harmless(), "TYPE_MATR_TANG": harmless(),
    "ITER_CPLAN_MAXI": harmless(), "RESI_CPLAN_RELA": harmless(), "RESI_CPLAN_MAXI": harmless(),
    "SYME_MATR_TANG": harmless(), "RESI_INTE": harmless(),
})
_EXCIT = factor({"CHARGE": concept("LoadConcept", required=True), "FONC_MULT": concept("Function"),
                 "TYPE_CHARGE": words("FIXE_CSTE", "SUIV", default="FIXE_CSTE", missing={
                     "DIDI": "", "FIXE_PILO": "", "SUIV_PILO": ""})})
_INCREMENT = factor({"LIST_INST": concept("RealList", required=True), "NUME_INST_INIT": integer(),
                     "INST_INIT": real(), "NUME_INST_FIN": integer(), "INST_FIN": real(), "PRECISION": real(1e-6)},
                    required=True, most=1)
_ETAT_INIT: dict[str, Key] = {
    "EVOL_NOLI": concept("Result"), "NUME_ORDRE": integer(), "INST": real(), "DEPL": concept("NodalField"),
    "PRECISION": real(1e-6), "CRITERE": words("RELATIF", "ABSOLU", default="RELATIF"), "NUME_DIDI": harmless(),
    "INST_ETAT_INIT": real(), "SIGM": concept("CellField"), "VARI": harmless(), "STRX": harmless()}
_ARCHIVAGE = factor({"LIST_INST": concept("RealList"), "INST": reals(), "PAS_ARCH": integer(), "PAS_OBSE": integer(),
                     "PRECISION": real(1e-6), "CRITERE": words("RELATIF", "ABSOLU", default="RELATIF"),
                     "CHAM_EXCLU": harmless(), "ARCH_ETAT_INIT": harmless(), "NUME_INIT": harmless(),
                     "DETR_NUME_SUIV": harmless()}, most=1)
_OBSERVATION = factor({"NOM_CHAM": texts(required=True), "NOM_CMP": texts(), "EVAL_CMP": words("VALE", default="VALE"),
                       "EVAL_CHAM": words("VALE", "MIN", "MAX", "MOY", "MINI_ABS", "MAXI_ABS", default="VALE"),
                       "EVAL_ELGA": words("VALE", "MIN", "MAX", default="VALE"), "NOM_VARI": texts(),
                       "GROUP_NO": texts(), "NOEUD": texts(), "TOUT": yes(), "GROUP_MA": texts(), "MAILLE": texts(),
                       "LIST_INST": concept("RealList"), "INST": reals(), "PAS_OBSE": integer(),
                       "OBSE_ETAT_INIT": yes_no("OUI"), "TITRE": text(), "PRECISION": real(1e-6),
                       "CRITERE": words("RELATIF", "ABSOLU", default="RELATIF"), "POINT": integers(),
                       "SOUS_POINT": integers()})

_COMMON: dict[str, Key] = {
    "MODELE": concept("ModelConcept", required=True), "CHAM_MATER": concept("MaterialField", required=True),
    "CARA_ELEM": concept("DiscreteField"), "EXCIT": _EXCIT, "CONTACT": concept("ContactConcept"),
    "COMPORTEMENT": _COMPORTEMENT, "COMP_INCR": _COMPORTEMENT, "COMP_ELAS": _COMPORTEMENT, "INCREMENT": _INCREMENT,
    "reuse": Key(concept("Result").takes), "RESULTAT": concept("Result"),
    "CONVERGENCE": factor({"RESI_GLOB_RELA": real(), "RESI_GLOB_MAXI": real(), "ITER_GLOB_MAXI": integer(10),
                           "ARRET": yes_no("OUI"), "RESI_REFE_RELA": real(), "RESI_COMP_RELA": real(),
                           "ITER_GLOB_ELAS": harmless(), "SIGM_REFE": harmless(), "FORC_REFE": harmless(),
                           "DEPL_REFE": harmless(), "LAGR_REFE": harmless(), "TYPE": harmless(),
                           "PLATEAU_ITER": harmless(), "PLATEAU_RELA": harmless(), "VERIF": harmless(),
                           "EFFORT_REFE": harmless(), "MOMENT_REFE": harmless()}, most=1),
    "NEWTON": factor({"REAC_INCR": harmless(), "REAC_ITER": harmless(), "MATRICE": harmless(),
                      "PREDICTION": words("TANGENTE", "ELASTIQUE", "EXTRAPOLE", "DEPL_CALCULE"),
                      "MATR_RIGI_SYME": harmless(), "EVOL_NOLI": harmless(), "PAS_MINI_ELAS": harmless(),
                      "REAC_ITER_ELAS": harmless()}, most=1),
    "ARCHIVAGE": _ARCHIVAGE, "OBSERVATION": _OBSERVATION,
    "SOLVEUR": harmless(), "RECH_LINEAIRE": harmless(), "METHODE": harmless(), "AFFICHAGE": harmless(),
    "MESURE": harmless(), "SUIVI_DDL": harmless(), "INFO": harmless(), "INFO_DBG": harmless(), "TITRE": harmless(),
    "ENERGIE": factor({"CALCUL": yes_no("OUI")}, most=1), "CRIT_QUALITE": harmless(), "MATR_DISTRIBUEE": harmless(),
}

STAT_NON_LINE = {**_COMMON, "ETAT_INIT": factor(_ETAT_INIT, most=1)}
DYNA_NON_LINE = {
    **_COMMON,
    "ETAT_INIT": factor({**_ETAT_INIT, "VITE": concept("NodalField"), "ACCE": concept("NodalField")}, most=1),
    "SCHEMA_TEMPS": factor({
        "SCHEMA": words("NEWMARK", "HHT", "DIFF_CENT", required=True, missing={
            "KRENK": "", "TCHAMWA": "DIFF_CENT is the explicit scheme here.", "THETA_METHODE": ""}),
        "FORMULATION": words("DEPLACEMENT", "ACCELERATION", missing={
            "VITESSE": "Schemes that solve for displacements give the same answer: DEPLACEMENT."}),
        "BETA": real(0.25), "GAMMA": real(0.5), "ALPHA": real(-0.1), "MODI_EQUI": yes_no("NON"),
        "STOP_CFL": harmless(), "COEF_MASS_SHIFT": harmless()}, required=True, most=1),
    "AMOR_RAYL_RIGI": words("TANGENTE", "ELASTIQUE"), "MASS_DIAG": yes_no("NON"),
}
MECA_STATIQUE = {
    "MODELE": concept("ModelConcept", required=True), "CHAM_MATER": concept("MaterialField", required=True),
    "CARA_ELEM": concept("DiscreteField"), "EXCIT": _EXCIT, "INST": real(), "LIST_INST": concept("RealList"),
    "INST_FIN": real(), "reuse": Key(concept("Result").takes), "RESULTAT": concept("Result"),
    "OPTION": words("SIEF_ELGA", "SANS"), "SOLVEUR": harmless(), "INFO": harmless(), "TITRE": harmless(),
}

COMMANDS = [
    Command("STAT_NON_LINE", STAT_NON_LINE, stat_non_line),
    Command("DYNA_NON_LINE", DYNA_NON_LINE, dyna_non_line),
    Command("MECA_STATIQUE", MECA_STATIQUE, meca_statique),
]
