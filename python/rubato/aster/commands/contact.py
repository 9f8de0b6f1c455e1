# SPDX-License-Identifier: LGPL-3.0-or-later
"""DEFI_CONTACT. solve/contact.py makes contact zones of it."""

from __future__ import annotations

from typing import Any

from ..concepts import ContactConcept
from ..keys import (Arguments, Command, CommandError, concept, factor, harmless, integer, real, reals, texts,
                    words, yes_no)

ZONE = {
    "GROUP_MA_MAIT": texts(), "MAILLE_MAIT": texts(), "GROUP_MA_ESCL": texts(), "MAILLE_ESCL": texts(),
    "SANS_GROUP_MA": texts(), "SANS_MAILLE": texts(), "SANS_GROUP_NO": texts(), "SANS_NOEUD": texts(),
    "SANS_GROUP_NO_FR": texts(), "SANS_NOEUD_FR": texts(), "SANS_GROUP_MA_FR": texts(), "SANS_MAILLE_FR": texts(),
    "ALGO_CONT": words("STANDARD", "PENALISATION", "LAC", "CONTRAINTE", "LAGRANGIEN", "GCP", "VERIF",
                       missing={"CZM": "", "AVANCE": ""}),
    "ALGO_FROT": words("STANDARD", "PENALISATION", "LAGRANGIEN"),
    "COULOMB": real(), "COEF_PENA_CONT": real(), "COEF_PENA_FROT": real(), "E_N": real(), "E_T": real(),
    "COEF_PENA": real(),
    "INTEGRATION": words("AUTO", "GAUSS", "SIMPSON", "NCOTES", "NOEUD", default="AUTO"), "ORDRE_INT": integer(),
    "NORMALE": words("MAIT", "ESCL", "MAIT_ESCL", default="MAIT"),
    "VECT_MAIT": words("AUTO", "FIXE", "VECT_Y", default="AUTO"), "MAIT_FIXE": reals(), "MAIT_VECT_Y": reals(),
    "VECT_ESCL": words("AUTO", "FIXE", "VECT_Y", default="AUTO"), "ESCL_FIXE": reals(), "ESCL_VECT_Y": reals(),
    "TYPE_PROJECTION": words("ORTHOGONALE", "FIXE", default="ORTHOGONALE"), "DIRE_APPA": reals(),
    "APPARIEMENT": words("MAIT_ESCL", "NODAL", "MORTAR", default="MAIT_ESCL"),
    "GLISSIERE": yes_no("NON"), "RESOLUTION": yes_no("OUI"),
    "DIST_MAIT": concept("Function"), "DIST_ESCL": concept("Function"), "DIST_POUTRE": words("NON"),
    "DIST_COQUE": words("NON"), "CARA_ELEM": harmless(),
    "TOLE_INTERP": harmless(), "SEUIL_INIT": harmless(), "CONTACT_INIT": harmless(), "COEF_CONT": real(),
    "COEF_FROT": real(), "COEF_MATR_FROT": harmless(), "TOLE_PROJ_EXT": real(0.5),
    "ADAPTATION": words("NON", "CYCLAGE", "ADAPT_COEF", "TOUT", default="CYCLAGE"),
    "TOLE_PROJ_INT": harmless(), "DIST_APPA": harmless(), "TYPE_APPA": harmless(), "TYPE_JACOBIEN": harmless(),
    "GRAND_GLIS": harmless(), "PENE_MAXI": harmless(), "COEF_REGU_CONT": harmless(),
    "COEF_REGU_FROT": harmless(), "ALARME_JEU": harmless(), "COEF_ECHELLE": harmless(),
    # LIAISON_UNIL
    "GROUP_NO": texts(), "NOEUD": texts(), "GROUP_MA": texts(), "MAILLE": texts(),
    "NOM_CMP": words("DX", "DY", "DZ", many=True), "COEF_MULT": concept("Function", many=True),
    "COEF_IMPO": concept("Function"),
}

DEFI_CONTACT = {
    "MODELE": concept("ModelConcept", required=True),
    "FORMULATION": words("DISCRETE", "CONTINUE", "LIAISON_UNIL", default="DISCRETE",
                         missing={"XFEM": "Cracks are meshed here."}),
    "FROTTEMENT": words("SANS", "COULOMB", default="SANS"),
    "ALGO_RESO_GEOM": words("NEWTON", "POINT_FIXE", default="POINT_FIXE"),
    "ALGO_RESO_CONT": words("NEWTON", "POINT_FIXE", default="NEWTON"),
    "ALGO_RESO_FROT": words("NEWTON", "POINT_FIXE", default="NEWTON"),
    "REAC_GEOM": words("AUTOMATIQUE", "CONTROLE", "SANS", default="AUTOMATIQUE"),
    "NB_ITER_GEOM": integer(2), "ITER_GEOM_MAXI": integer(10), "RESI_GEOM": real(),
    "ITER_FROT_MAXI": integer(10), "RESI_FROT": real(1e-4),
    "ITER_CONT_TYPE": harmless(), "ITER_CONT_MULT": harmless(), "ITER_CONT_MAXI": integer(30),
    "LISSAGE": yes_no("NON"), "VERI_NORM": harmless(), "STOP_SINGULIER": harmless(),
    "STOP_INTERP": words("NON", default="NON", missing={"OUI": "Gaps are in CONT_NOEU."}),
    "NB_RESOL": harmless(), "RESI_ABSO": harmless(), "ITER_GCP_MAXI": harmless(), "PRE_COND": harmless(),
    "RECH_LINEAIRE": harmless(), "COEF_RESI": harmless(), "ITER_PRE_MAXI": harmless(), "INFO": harmless(),
    "TITRE": harmless(), "RESI_CONT": harmless(), "GLISSIERE": yes_no(),
    "ZONE": factor(ZONE, required=True),
}


def defi_contact(session: Any, arguments: Arguments) -> ContactConcept:
    for number, zone in enumerate(arguments.ZONE, 1):
        if arguments.FORMULATION == "LIAISON_UNIL":
            continue
        if not (zone.GROUP_MA_MAIT or zone.MAILLE_MAIT) or not (zone.GROUP_MA_ESCL or zone.MAILLE_ESCL):
            raise CommandError(f"DEFI_CONTACT/ZONE: zone {number} has no master (GROUP_MA_MAIT) or no slave "
                               "(GROUP_MA_ESCL).")
    if arguments.FORMULATION == "DISCRETE" and arguments.FROTTEMENT == "COULOMB":
        for zone in arguments.ZONE:
            if zone.ALGO_FROT == "STANDARD":
                raise CommandError("DEFI_CONTACT/ZONE/ALGO_FROT: DISCRETE has PENALISATION only.")
    return ContactConcept(arguments.MODELE, arguments)


COMMANDS = [Command("DEFI_CONTACT", DEFI_CONTACT, defi_contact)]
