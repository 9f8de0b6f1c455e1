# SPDX-License-Identifier: LGPL-3.0-or-later
"""TEST_RESU, TEST_TABLE, TEST_FONCTION: values that a study must give."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from ..checks import HEAD, Wanted
from ..concepts import CellField, NodalField, Result, Stored
from ..fields import field_of
from ..keys import (Arguments, Command, CommandError, Key, concept, factor, harmless, integer, real, reals,
                    text, texts, words, yes_no)
from ..selection import all_values, column_of, one_cell, one_node, place_of_node, value_in_cell
from ..tables import FILTER_KEYS, filtered, need_column

SOURCES = ("ANALYTIQUE", "SOURCE_EXTERNE", "AUTRE_ASTER", "NON_DEFINI")
REFERENCE: dict[str, Key] = {
    "VALE_CALC": real(),
    "VALE_CALC_I": integer(),
    "VALE_REFE": real(),
    "VALE_REFE_I": integer(),
    "REFERENCE": words(*SOURCES),
    "PRECISION": real(1e-3),
    "CRITERE": Key(words("RELATIF", "ABSOLU").takes, many=True),
    "TOLE_MACHINE": reals(),
    "ORDRE_GRANDEUR": real(),
    "VALE_ABS": yes_no("NON"),
    "LEGENDE": text("XXXX"),
}
TEXTS: dict[str, Key] = {"VALE_CALC_K": text(), "VALE_REFE_K": text()}
TYPE_TEST = words("SOMM_ABS", "SOMM", "MAX", "MIN")

SUMS: dict[str, Callable[[np.ndarray], float]] = {
    "MAX": np.max, "MIN": np.min, "SOMM": np.sum, "SOMM_ABS": lambda values: np.sum(np.abs(values)),
}

PLACE: dict[str, Key] = {"NOEUD": texts(), "GROUP_NO": texts(), "NOM_CMP": text(), "TYPE_TEST": TYPE_TEST}
CELL_PLACE: dict[str, Key] = {**PLACE, "MAILLE": text(), "GROUP_MA": text(), "POINT": integer(),
                              "SOUS_POINT": integer()}
TABLE_KEYS = {**REFERENCE, **TEXTS, "TABLE": concept("TableConcept", required=True), "NOM_PARA": text(required=True),
              "FILTRE": factor(FILTER_KEYS), "TYPE_TEST": TYPE_TEST, "INFO": harmless()}
RESULT_KEYS = {
    "CHAM_NO": factor({**REFERENCE, **PLACE, "CHAM_GD": concept("NodalField", required=True)}),
    "CHAM_ELEM": factor({**REFERENCE, **CELL_PLACE, "CHAM_GD": concept("CellField", required=True)}),
    "RESU": factor({**REFERENCE, **CELL_PLACE, "RESULTAT": concept("Result", required=True), "NUME_ORDRE": integer(),
                    "INST": real(), "FREQ": real(), "NUME_MODE": integer(), "NOM_CHAM": text(), "PARA": text()}),
    "MAILLAGE": factor({**REFERENCE, "MAILLAGE": concept("MeshConcept", required=True),
                        "CARA": words("NB_MAILLE", "NB_NOEUD", "NB_GROUP_MA", "NB_GROUP_NO", "NB_MA_GROUP_MA",
                                      "NB_NO_GROUP_NO", required=True),
                        "NOM_GROUP_MA": text(), "NOM_GROUP_NO": text()}),
    "TEST_NAN": harmless(),
}
FUNCTION_KEYS = {
    "VALEUR": factor({**REFERENCE, "FONCTION": concept("Function", required=True), "NOM_PARA": texts(),
                      "VALE_PARA": reals(required=True)}, required=True),
}

# Counts of the iterations of another program.
COUNTS = ("ITER_GLOB", "ITER_LINE", "NB_ITER")


# ---- what is wanted ----------------------------------------------------------------------------------------------


def wanted_of(check: Arguments, command: str) -> Wanted:
    own = _one_of(check, command, "VALE_CALC", "VALE_CALC_I", "VALE_CALC_K")
    outside = _one_of(check, command, "VALE_REFE", "VALE_REFE_I", "VALE_REFE_K")
    if own is None and outside is None:
        raise CommandError(f"{command}: VALE_CALC is missing.")
    if outside is not None and check.REFERENCE is None:
        raise CommandError(f"{command}: VALE_REFE needs REFERENCE.")
    criterion = check.CRITERE[0] if check.CRITERE else "RELATIF"
    tolerance = check.TOLE_MACHINE[0] if check.TOLE_MACHINE else 1e-6
    para = check.get("PARA")
    if check.VALE_ABS == "OUI":
        own, outside = magnitude(own), magnitude(outside)
    return Wanted(own, outside, check.REFERENCE or "NON_DEFINI", check.LEGENDE, criterion == "RELATIF", tolerance,
                  check.PRECISION, check.ORDRE_GRANDEUR, comparable=not (para and para.startswith(COUNTS)))


def _one_of(check: Arguments, command: str, *names: str) -> float | str | None:
    given = [name for name in names if check.get(name) is not None]
    if len(given) > 1:
        raise CommandError(f"{command}: only one of {', '.join(given)} can be given.")
    return check.get(given[0]) if given else None


def magnitude(value: Any) -> Any:
    """Returns the absolute value of a number. Texts and None stay as they are."""
    return value if value is None or isinstance(value, str) else abs(value)


def compare(session: Any, command: str, title: str, value: float | str, check: Arguments) -> None:
    if check.VALE_ABS == "OUI":
        value = magnitude(value)
    tolerance = getattr(session, "regression_tolerance", 1e-3)
    lines = session.checks.add(title, value, wanted_of(check, command), tolerance)
    for line in [f" ---- {title}", f"      {HEAD}".rstrip(), *lines]:
        session.say(line)


# ---- TEST_RESU ---------------------------------------------------------------------------------------------------


def test_result(session: Any, arguments: Arguments) -> None:
    ways = {"CHAM_NO": _nodal_field, "CHAM_ELEM": _cell_field, "RESU": _result, "MAILLAGE": _mesh}
    for name, way in ways.items():
        for check in arguments.get(name):
            title, value = way(check, f"TEST_RESU/{name}")
            compare(session, f"TEST_RESU/{name}", title, value, check)


def _nodal_field(check: Arguments, command: str) -> tuple[str, float]:
    return _title(check.CHAM_GD.name, check), field_value(check.CHAM_GD, check, command)


_cell_field = _nodal_field


def _result(check: Arguments, command: str) -> tuple[str, float]:
    result = check.RESULTAT
    stored = _state(result, check, command)
    if (check.NOM_CHAM is None) == (check.PARA is None):
        raise CommandError(f"{command}: one of NOM_CHAM and PARA is needed.")
    at = f"NUME_ORDRE {check.NUME_ORDRE}" if check.NUME_ORDRE is not None else f"INST {stored.instant:g}"
    if check.PARA is not None:
        return f"{result.name} {at} {check.PARA}", parameter(stored, check.PARA)
    value = field_value(field_of(result, stored, check.NOM_CHAM), check, command)
    return _title(f"{result.name} {at} {check.NOM_CHAM}", check), value


def _state(result: Result, check: Arguments, command: str) -> Stored:
    if check.NUME_ORDRE is not None:
        return result.of_order(check.NUME_ORDRE)
    # The first criterion serves the value and the instant; the second tolerance is that of the instant.
    criterion = check.CRITERE[0] if check.CRITERE else "RELATIF"
    precision = check.TOLE_MACHINE[1] if len(check.TOLE_MACHINE) > 1 else 1e-6
    if check.INST is not None:
        return result.at(check.INST, precision, criterion)
    if check.NUME_MODE is not None:
        return result.of_order(check.NUME_MODE)
    if check.FREQ is not None:
        close = [one for one in result.stored if abs(one.parameters.get("FREQ", np.inf) - check.FREQ)
                 <= max(precision, 1e-3) * abs(check.FREQ)]
        if len(close) == 1:
            return close[0]
        raise CommandError(f"{command}: result {result.name} has {len(close)} states at FREQ {check.FREQ:g}.")
    raise CommandError(f"{command}: NUME_ORDRE or INST is missing.")


def parameter(stored: Stored, name: str) -> float:
    known = {"INST": stored.instant, "ITER_GLOB": stored.iterations, **stored.parameters}
    if name not in known:
        raise CommandError(f"PARA: there is no parameter {name}; there are {', '.join(known)}.")
    return known[name]


def _mesh(check: Arguments, command: str) -> tuple[str, float]:
    concept_, mesh = check.MAILLAGE, check.MAILLAGE.mesh
    ways: dict[str, Callable[[], int]] = {
        "NB_MAILLE": lambda: mesh.cell_count, "NB_NOEUD": lambda: mesh.node_count,
        "NB_GROUP_MA": lambda: len(mesh.cell_groups), "NB_GROUP_NO": lambda: len(mesh.node_groups),
        "NB_MA_GROUP_MA": lambda: len(concept_.cells_in(check.NOM_GROUP_MA)),
        "NB_NO_GROUP_NO": lambda: len(concept_.nodes_in(check.NOM_GROUP_NO)),
    }
    return f"{concept_.name} {check.CARA}", ways[check.CARA]()


def _title(head: str, check: Arguments) -> str:
    parts = [head]
    for name in ("NOM_CMP", "MAILLE", "GROUP_MA", "NOEUD", "GROUP_NO", "POINT", "TYPE_TEST"):
        value = check.get(name)
        if value not in (None, ()):
            parts.append(" ".join(value) if isinstance(value, tuple) else str(value))
    return " ".join(parts)


def field_value(field: NodalField | CellField, check: Arguments, command: str) -> float:
    """The value of a field that a check asks for: at a place, or over the whole field (TYPE_TEST)."""
    if check.get("SOUS_POINT") not in (None, 1):
        raise CommandError(f"{command}/SOUS_POINT: continuum cells have one.")
    if check.TYPE_TEST is not None:
        values = all_values(field, check.NOM_CMP)
        if not len(values):
            raise CommandError(f"{command}: the field has no value.")
        return float(SUMS[check.TYPE_TEST](values))
    if check.NOM_CMP is None:
        raise CommandError(f"{command}: NOM_CMP is missing.")
    if isinstance(field, NodalField):
        return _at_node(field, check, command)
    return _in_cell(field, check, command)


def _at_node(field: NodalField, check: Arguments, command: str) -> float:
    node = one_node(field, check, command)
    if node is None:
        raise CommandError(f"{command}: GROUP_NO, NOEUD or TYPE_TEST is missing.")
    value = float(field.values[node, column_of(field, check.NOM_CMP)])
    if np.isnan(value):
        raise CommandError(f"{command}: node {field.mesh.node_name(node)} has no component {check.NOM_CMP}.")
    return value


def _in_cell(field: CellField, check: Arguments, command: str) -> float:
    cell = one_cell(field, check, command)
    if cell is None:
        raise CommandError(f"{command}: MAILLE, GROUP_MA or TYPE_TEST is missing.")
    node = one_node(field, check, command)
    if node is not None:
        return value_in_cell(field, cell, place_of_node(field, cell, node), check.NOM_CMP)
    point = check.POINT if check.POINT is not None else 1
    if check.POINT is None and field.place != "ELEM":
        raise CommandError(f"{command}: POINT or GROUP_NO is missing.")
    return value_in_cell(field, cell, point - 1, check.NOM_CMP)


# ---- TEST_TABLE, TEST_FONCTION -------------------------------------------------------------------------------------


def test_table(session: Any, arguments: Arguments) -> None:
    table, column = arguments.TABLE, arguments.NOM_PARA
    need_column(table, column, "TEST_TABLE")
    rows = filtered(table, arguments.FILTRE, "TEST_TABLE")
    values = [row[column] for row in rows if row.get(column) is not None]
    title = " ".join([table.name or "table", column, *map(_shown_filter, arguments.FILTRE)])
    if arguments.TYPE_TEST is not None:
        if not values:
            raise CommandError(f"TEST_TABLE: no row has a value in column {column}.")
        value = float(SUMS[arguments.TYPE_TEST](np.array(values, dtype=float)))
        title += f" {arguments.TYPE_TEST}"
    elif len(values) == 1:
        value = values[0]
    else:
        raise CommandError(f"TEST_TABLE: expected one row, {len(values)} with a value in column {column} remain "
                           "after FILTRE.")
    compare(session, "TEST_TABLE", title, value, arguments)


def _shown_filter(one: Arguments) -> str:
    value = one.VALE or one.VALE_I or one.VALE_K
    sign = "=" if one.CRIT_COMP == "EQ" else f" {one.CRIT_COMP} "
    return f"{one.NOM_PARA}{sign}{' '.join(f'{v:g}' if isinstance(v, float) else str(v) for v in value)}"


def test_function(session: Any, arguments: Arguments) -> None:
    for check in arguments.VALEUR:
        function = check.FONCTION
        value = float(function(*check.VALE_PARA))
        at = " ".join(f"{place:g}" for place in check.VALE_PARA)
        compare(session, "TEST_FONCTION/VALEUR", f"{function.name or 'function'} at {at}", value, check)


def nothing(session: Any, arguments: Arguments) -> None:
    """TEST_TEMPS: times of another computer."""


COMMANDS = [
    Command("TEST_RESU", RESULT_KEYS, test_result),
    Command("TEST_TABLE", TABLE_KEYS, test_table),
    Command("TEST_FONCTION", FUNCTION_KEYS, test_function),
    Command("TEST_TEMPS", {}, nothing, harmless=True),
]
