# SPDX-License-Identifier: LGPL-3.0-or-later
"""AFFE_CHAR_MECA(_F), AFFE_CHAR_CINE(_F): supports, forces, relations. solve/ makes parts of a study of them."""

from __future__ import annotations

from typing import Any

from ..concepts import LoadConcept
from ..keys import (Arguments, Command, CommandError, Key, concept, factor, harmless, real, reals, texts, words,
                    yes)

_COMPONENTS = ("DX", "DY", "DZ")
_FORCES = ("FX", "FY", "FZ")
_CELLS = {"TOUT": yes(), "GROUP_MA": texts(), "MAILLE": texts(), "SANS_GROUP_MA": texts(), "SANS_MAILLE": texts()}
_NODES = {"TOUT": yes(), "GROUP_NO": texts(), "NOEUD": texts(), "GROUP_MA": texts(), "MAILLE": texts(),
          "SANS_GROUP_MA": texts(), "SANS_GROUP_NO": texts(), "SANS_NOEUD": texts(), "SANS_MAILLE": texts()}


def _keys(value: Key, values: Key) -> dict[str, Key]:
    """Keywords that both families have; values are numbers or functions."""
    forces = {name: value for name in _FORCES}
    held = {name: value for name in _COMPONENTS}
    return {
        "MODELE": concept("ModelConcept", required=True), "INFO": harmless(), "VERI_NORM": harmless(),
        "VERI_AFFE": harmless(), "VERI_DDL": harmless(), "DOUBLE_LAGRANGE": harmless(),
        "DDL_IMPO": factor({**_NODES, **held, "LIAISON": words("ENCASTRE"), "BLOCAGE":
                            words("DEPLACEMENT", "TOUT_DDL", many=True)}),
        "FACE_IMPO": factor({**_CELLS, **held, "DNOR": value, "SANS_GROUP_NO": texts(), "SANS_NOEUD": texts()}),
        "ARETE_IMPO": factor({**_CELLS, **held, "SANS_GROUP_NO": texts(), "SANS_NOEUD": texts()}),
        "FORCE_NODALE": factor({"GROUP_NO": texts(), "NOEUD": texts(), **forces}),
        "FORCE_ARETE": factor({**_CELLS, **forces}),
        "FORCE_CONTOUR": factor({**_CELLS, **forces}),
        "FORCE_FACE": factor({**_CELLS, **forces}),
        "FORCE_INTERNE": factor({**_CELLS, **forces}),
        "PRES_REP": factor({**_CELLS, "PRES": value, "CISA_2D": value}),
        "LIAISON_DDL": factor({"GROUP_NO": texts(), "NOEUD": texts(), "DDL": words(*_COMPONENTS, many=True),
                               "COEF_MULT": reals(), "COEF_IMPO": value}),
        "LIAISON_UNIF": factor({**_NODES, "DDL": words(*_COMPONENTS, many=True, required=True)}),
        "LIAISON_GROUP": factor({
            "GROUP_MA_1": texts(), "GROUP_MA_2": texts(), "GROUP_NO_1": texts(), "GROUP_NO_2": texts(),
            "NOEUD_1": texts(), "NOEUD_2": texts(), "MAILLE_1": texts(), "MAILLE_2": texts(),
            "DDL_1": words(*_COMPONENTS, "DNOR", many=True, required=True),
            "DDL_2": words(*_COMPONENTS, "DNOR", many=True, required=True), "COEF_MULT_1": reals(),
            "COEF_MULT_2": reals(), "COEF_IMPO": value, "CENTRE": reals(), "ANGL_NAUT": reals(), "TRAN": reals(),
            "SANS_NOEUD": texts(), "SANS_GROUP_NO": texts(), "SOMMET": words("OUI"), "NUME_LAGR": harmless()}),
        "LIAISON_OBLIQUE": factor({"GROUP_NO": texts(), "NOEUD": texts(), "ANGL_NAUT": reals(required=True), **held}),
    }


_NUMBERS: dict[str, Key] = {
    **_keys(real(), reals()),
    "PESANTEUR": factor({"GRAVITE": real(required=True), "DIRECTION": reals(required=True), "GROUP_MA": texts(),
                         "MAILLE": texts(), "TOUT": yes()}, most=1),
    "LIAISON_SOLIDE": factor({"GROUP_NO": texts(), "NOEUD": texts(), "GROUP_MA": texts(), "MAILLE": texts(),
                              "NUME_LAGR": harmless(), "DIST_MIN": harmless()}),
    "LIAISON_MAIL": factor({"GROUP_MA_MAIT": texts(), "MAILLE_MAIT": texts(), "GROUP_NO_ESCL": texts(),
                            "NOEUD_ESCL": texts(), "GROUP_MA_ESCL": texts(), "MAILLE_ESCL": texts(),
                            "TYPE_RACCORD": words("MASSIF", default="MASSIF"), "DDL_MAIT": words("DNOR"),
                            "DDL_ESCL": words("DNOR"), "DISTANCE_MAX": harmless(), "DISTANCE_ALARME": harmless(),
                            "ELIM_MULT": harmless()}),
}
_FUNCTIONS: dict[str, Key] = _keys(concept("Function"), Key(concept("Function").takes, many=True))

_CINE = {"MODELE": concept("ModelConcept", required=True), "INFO": harmless(), "SYNTAXE": harmless()}
AFFE_CHAR_CINE = {**_CINE, "MECA_IMPO": factor({**_NODES, **{name: real() for name in _COMPONENTS}})}
AFFE_CHAR_CINE_F = {**_CINE, "MECA_IMPO": factor({**_NODES, **{name: concept("Function") for name in _COMPONENTS}})}


def _make(command: str):
    def run(session: Any, arguments: Arguments) -> LoadConcept:
        kinds = [name for name in arguments.names_given() if isinstance(arguments.get(name), list)]
        if not kinds:
            raise CommandError(f"{command}: there is nothing to impose.")
        return LoadConcept(arguments.MODELE, command, arguments)

    return run


COMMANDS = [
    Command("AFFE_CHAR_MECA", _NUMBERS, _make("AFFE_CHAR_MECA")),
    Command("AFFE_CHAR_MECA_F", _FUNCTIONS, _make("AFFE_CHAR_MECA_F")),
    Command("AFFE_CHAR_CINE", AFFE_CHAR_CINE, _make("AFFE_CHAR_CINE")),
    Command("AFFE_CHAR_CINE_F", AFFE_CHAR_CINE_F, _make("AFFE_CHAR_CINE_F")),
]
