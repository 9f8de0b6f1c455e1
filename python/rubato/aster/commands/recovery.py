# SPDX-License-Identifier: LGPL-3.0-or-later
"""RECU_FONCTION: functions out of results, fields and tables."""

from __future__ import annotations

from typing import Any

import numpy as np

from ..concepts import CellField, Function, NodalField, Result, TableConcept, TableFunction
from ..fields import field_of
from ..keys import (Arguments, Command, CommandError, Key, concept, factor, harmless, integer, text, texts, words, yes)
from ..selection import STATES, chosen_states, column_of, one_cell, one_node, place_of_node, value_in_cell
from ..tables import FILTER_KEYS, filtered, need_column

KEYS: dict[str, Key] = {
    "RESULTAT": concept("Result"), "TABLE": concept("TableConcept"), **STATES, "TOUT_INST": yes(),
    "NOM_CHAM": text(), "NOM_CMP": text(), "NOM_PARA_RESU": text(),
    "NOEUD": texts(), "GROUP_NO": texts(), "MAILLE": text(), "GROUP_MA": text(), "POINT": integer(),
    "SOUS_POINT": integer(),
    "PARA_X": text(), "PARA_Y": text(), "FILTRE": factor(FILTER_KEYS),
    "NOM_PARA_TABL": words("FONCTION", missing={"FONCTION_C": "There are no complex functions."}),
    "NOM_PARA": text(), "NOM_RESU": text(), "INTERPOL": words("LIN", "LOG", many=True),
    "PROL_DROITE": words("EXCLU", "CONSTANT", "LINEAIRE", default="EXCLU"),
    "PROL_GAUCHE": words("EXCLU", "CONSTANT", "LINEAIRE", default="EXCLU"),
    "INTERP_NUME": words("NON", missing={"LIN": "States are taken at their instants."}),
    "INFO": harmless(), "TITRE": harmless(),
}


def recover(session: Any, arguments: Arguments) -> Function:
    if (arguments.RESULTAT is None) == (arguments.TABLE is None):
        raise CommandError("RECU_FONCTION: one of RESULTAT and TABLE is needed.")
    if arguments.TABLE is not None:
        if arguments.NOM_PARA_TABL is not None:
            return _function_in(arguments.TABLE, arguments)
        parameter, result, places, values = _of_table(arguments.TABLE, arguments)
    else:
        parameter, result, places, values = _of_result(arguments.RESULTAT, arguments)
    if not len(places):
        raise CommandError("RECU_FONCTION: there are no values.")
    order = np.argsort(places, kind="stable")
    ways = (arguments.INTERPOL * 2)[:2] or ("LIN", "LIN")
    return TableFunction(arguments.NOM_PARA or parameter, places[order], values[order], arguments.PROL_GAUCHE,
                         arguments.PROL_DROITE, ways, arguments.NOM_RESU or result)


Points = tuple[str, str, np.ndarray, np.ndarray]


def _of_result(result: Result, arguments: Arguments) -> Points:
    """Over the stored states."""
    states = chosen_states(result, arguments)
    instants = np.array([stored.instant for stored in states])
    name = arguments.NOM_PARA_RESU
    if name is not None:
        known = [{"ITER_GLOB": float(stored.iterations), **stored.parameters} for stored in states]
        if any(name not in one for one in known):
            raise CommandError(f"RECU_FONCTION/NOM_PARA_RESU: there is no parameter {name}.")
        return "INST", name, instants, np.array([float(one[name]) for one in known])
    if arguments.NOM_CHAM is None or arguments.NOM_CMP is None:
        raise CommandError("RECU_FONCTION: NOM_CHAM and NOM_CMP are needed.")
    values = [value_of(field_of(result, stored, arguments.NOM_CHAM), arguments) for stored in states]
    return "INST", arguments.NOM_CMP, instants, np.array(values)


def value_of(field: NodalField | CellField, where: Arguments) -> float:
    command = "RECU_FONCTION"
    node = one_node(field, where, command)
    if isinstance(field, NodalField):
        if node is None:
            raise CommandError(f"{command}: GROUP_NO or NOEUD is missing.")
        value = float(field.values[node, column_of(field, where.NOM_CMP)])
        if np.isnan(value):
            raise CommandError(f"{command}: node {field.mesh.node_name(node)} has no component {where.NOM_CMP}.")
        return value
    cell = one_cell(field, where, command)
    if cell is None:
        raise CommandError(f"{command}: MAILLE or GROUP_MA is missing.")
    place = place_of_node(field, cell, node) if node is not None else (where.POINT or 1) - 1
    return value_in_cell(field, cell, place, where.NOM_CMP)


def _of_table(table: TableConcept, arguments: Arguments) -> Points:
    """Two columns of the rows that have both."""
    x, y = arguments.PARA_X, arguments.PARA_Y
    if x is None or y is None:
        raise CommandError("RECU_FONCTION: PARA_X and PARA_Y are needed.")
    for column in (x, y):
        need_column(table, column, "RECU_FONCTION")
    pairs = [(row[x], row[y]) for row in filtered(table, arguments.FILTRE, "RECU_FONCTION")
             if row.get(x) is not None and row.get(y) is not None]
    return x, y, np.array([float(pair[0]) for pair in pairs]), np.array([float(pair[1]) for pair in pairs])


def _function_in(table: TableConcept, arguments: Arguments) -> Function:
    """A table may have a function in a column."""
    column = arguments.NOM_PARA_TABL
    need_column(table, column, "RECU_FONCTION")
    found = [row[column] for row in filtered(table, arguments.FILTRE, "RECU_FONCTION")
             if isinstance(row.get(column), Function)]
    if len(found) != 1:
        raise CommandError(f"RECU_FONCTION: {len(found)} rows have a function, expected one.")
    return found[0]


COMMANDS = [Command("RECU_FONCTION", KEYS, recover)]
