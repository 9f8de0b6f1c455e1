# SPDX-License-Identifier: LGPL-3.0-or-later
"""CREA_TABLE, CALC_TABLE, RECU_TABLE, IMPR_TABLE, IMPR_FONCTION: tables made, changed and written."""

from __future__ import annotations

from typing import Any

import numpy as np

from ..concepts import Result, TableConcept, TableFunction
from ..keys import (Arguments, Command, CommandError, Key, anything, concept, factor, harmless, integer, integers, text,
                    texts, words, yes, yes_no)
from ..selection import NODES, STATES
from ..tables import FILTER_KEYS, Row, filtered, joined, need_column, ordered_rows, table_lines
from .post_releve import extracted_rows

# ---- CREA_TABLE ------------------------------------------------------------------------------------------------

CREATE: dict[str, Key] = {
    "LISTE": factor({"PARA": text(required=True), "LISTE_R": anything(), "LISTE_I": integers(),
                     "LISTE_K": texts(), "NUME_LIGN": integers(), "TYPE_K": harmless()}),
    "FONCTION": factor({"FONCTION": concept("TableFunction", required=True), "PARA": texts()}, most=1),
    "RESU": factor({**STATES, **NODES, "RESULTAT": concept("Result"), "CHAM_GD": concept("NodalField", "CellField"),
                    "NOM_CHAM": text(), "INTITULE": text("CREA_TABLE"), "NOM_CMP": texts(),
                    "TOUT_CMP": yes()}, most=1),
    "TYPE_TABLE": words("TABLE", "TABLE_SDASTER", default="TABLE", missing={"TABLE_FONCTION": "",
                                                                            "TABLE_CONTENEUR": ""}),
    "TITRE": texts(),
    "INFO": harmless(),
}


def create(session: Any, arguments: Arguments) -> TableConcept:
    title = " ".join(arguments.TITRE)
    if arguments.LISTE:
        return _of_lists(arguments.LISTE, title)
    if arguments.FONCTION:
        (one,) = arguments.FONCTION
        function = one.FONCTION
        names = list(one.PARA) or [*function.parameters, function.result]
        if len(names) != 2:
            raise CommandError("CREA_TABLE/FONCTION/PARA: expected two names.")
        rows = [dict(zip(names, map(float, pair))) for pair in zip(function.places, function.values)]
        return TableConcept(names, rows, title)
    if arguments.RESU:
        (one,) = arguments.RESU
        columns, rows = extracted_rows(one, "CREA_TABLE/RESU")
        return TableConcept(columns, rows, title)
    raise CommandError("CREA_TABLE: LISTE, FONCTION or RESU is missing.")


def _of_lists(lists: list[Arguments], title: str) -> TableConcept:
    columns = [one.PARA for one in lists]
    rows: list[Row] = []
    for one in lists:
        for place, value in zip(*_places_and_values(one)):
            while len(rows) <= place:
                rows.append({})
            rows[place][one.PARA] = value
    return TableConcept(columns, rows, title)


def _places_and_values(one: Arguments) -> tuple[list[int], list[Any]]:
    given = [name for name in ("LISTE_R", "LISTE_I", "LISTE_K") if one.given(name)]
    if len(given) != 1:
        raise CommandError("CREA_TABLE/LISTE: one of LISTE_R, LISTE_I and LISTE_K is needed.")
    values: list[Any]
    if given[0] == "LISTE_R":
        # Also what functions and lists give; None is an empty place.
        whole = one.LISTE_R if isinstance(one.LISTE_R, (list, tuple)) else np.atleast_1d(one.LISTE_R)
        values = [None if value is None else float(value) for value in whole]
    else:
        values = list(one.get(given[0]))
    places = [number - 1 for number in one.NUME_LIGN] or list(range(len(values)))
    if len(places) != len(values) or min(places, default=0) < 0:
        raise CommandError("CREA_TABLE/LISTE/NUME_LIGN: expected a number from 1 for each value.")
    return ([place for place, value in zip(places, values) if value is not None],
            [value for value in values if value is not None])


# ---- CALC_TABLE ------------------------------------------------------------------------------------------------

CALCULATE: dict[str, Key] = {
    "TABLE": concept("TableConcept", required=True),
    "reuse": anything(),
    "ACTION": factor({
        **{name: key for name, key in FILTER_KEYS.items() if name != "NOM_PARA"},
        "OPERATION": words("FILTRE", "EXTR", "SUPPRIME", "RENOMME", "TRI", "COMB", "AJOUT_LIGNE", "AJOUT_COLONNE",
                           "OPER", "CALCUL", required=True),
        "NOM_PARA": texts(), "ORDRE": words("CROISSANT", "DECROISSANT", default="CROISSANT"),
        "TABLE": concept("TableConcept"), "RESTREINT": yes_no("NON"), "FORMULE": concept("Function"),
        "NOM_COLONNE": texts(), "VALE": anything(), "FORMAT_R": harmless(),
        "TYPE_CALCUL": words("MAXI", "MINI", "SOMM", "MOY", "MAXI_ABS", "MINI_ABS", "SOMM_ABS", many=True),
    }, required=True),
    "TITRE": texts(),
    "INFO": harmless(),
}


def calculate(session: Any, arguments: Arguments) -> TableConcept:
    source = arguments.TABLE
    made = TableConcept(list(source.columns), [dict(row) for row in source.rows], source.title)
    for action in arguments.ACTION:
        made = ACTIONS[action.OPERATION](made, action)
    made.title = " ".join(arguments.TITRE) or source.title
    if arguments.given("reuse"):
        source.columns, source.rows, source.title = made.columns, made.rows, made.title
        return source
    return made


def _filter(table: TableConcept, action: Arguments) -> TableConcept:
    values: dict[str, Any] = {name: action.get(name) for name in FILTER_KEYS}
    values["NOM_PARA"] = _one_name(action)
    values["VALE"] = _as_tuple(action.VALE)
    rows = filtered(table, [Arguments(values, set(values))], "CALC_TABLE")
    return TableConcept(table.columns, rows)


def _as_tuple(value: Any) -> tuple[Any, ...]:
    if value is None:
        return ()
    return tuple(value) if isinstance(value, (list, tuple)) else (value,)


def _one_name(action: Arguments) -> str:
    if len(action.NOM_PARA) != 1:
        raise CommandError(f"CALC_TABLE/{action.OPERATION}/NOM_PARA: expected one column.")
    return action.NOM_PARA[0]


def _keep(table: TableConcept, action: Arguments) -> TableConcept:
    for name in action.NOM_PARA:
        need_column(table, name, "CALC_TABLE/EXTR")
    return TableConcept(list(action.NOM_PARA),
                        [{name: row[name] for name in action.NOM_PARA if name in row} for row in table.rows])


def _drop(table: TableConcept, action: Arguments) -> TableConcept:
    columns = [name for name in table.columns if name not in action.NOM_PARA]
    return TableConcept(columns, [{name: row[name] for name in columns if name in row} for row in table.rows])


def _rename(table: TableConcept, action: Arguments) -> TableConcept:
    if len(action.NOM_PARA) != 2:
        raise CommandError("CALC_TABLE/RENOMME/NOM_PARA: expected the old and the new name.")
    old, new = action.NOM_PARA
    need_column(table, old, "CALC_TABLE/RENOMME")
    if new in table.columns:
        raise CommandError(f"CALC_TABLE/RENOMME: the table has a column {new!r} already.")
    names = {old: new}
    return TableConcept([names.get(name, name) for name in table.columns],
                        [{names.get(name, name): value for name, value in row.items()} for row in table.rows])


def _sort(table: TableConcept, action: Arguments) -> TableConcept:
    for name in action.NOM_PARA:
        need_column(table, name, "CALC_TABLE/TRI")
    return TableConcept(table.columns, ordered_rows(table.rows, action.NOM_PARA, action.ORDRE == "DECROISSANT"))


def _join(table: TableConcept, action: Arguments) -> TableConcept:
    if action.TABLE is None:
        raise CommandError("CALC_TABLE/COMB: TABLE is missing.")
    for name in action.NOM_PARA:
        need_column(table, name, "CALC_TABLE/COMB")
        need_column(action.TABLE, name, "CALC_TABLE/COMB")
    return joined(table, action.TABLE, action.NOM_PARA, action.RESTREINT == "OUI")


def _named_values(action: Arguments) -> Row:
    values = _as_tuple(action.VALE)
    if len(values) != len(action.NOM_PARA):
        raise CommandError(f"CALC_TABLE/{action.OPERATION}: VALE needs as many values as NOM_PARA has names.")
    return dict(zip(action.NOM_PARA, values))


def _add_row(table: TableConcept, action: Arguments) -> TableConcept:
    row = _named_values(action)
    return TableConcept(_with_columns(table.columns, row), [*table.rows, row])


def _add_columns(table: TableConcept, action: Arguments) -> TableConcept:
    extra = _named_values(action)
    return TableConcept(_with_columns(table.columns, extra), [{**row, **extra} for row in table.rows])


def _with_columns(columns: list[str], row: Row) -> list[str]:
    return columns + [name for name in row if name not in columns]


def _operate(table: TableConcept, action: Arguments) -> TableConcept:
    """A column by a formula; rows that lack one of its columns get nothing."""
    formula, name = action.FORMULE, _one_name(action)
    if formula is None:
        raise CommandError("CALC_TABLE/OPER: FORMULE is missing.")
    columns = action.NOM_COLONNE or formula.parameters
    for column in columns:
        need_column(table, column, "CALC_TABLE/OPER")
    rows = []
    for row in table.rows:
        values = [row.get(column) for column in columns]
        made = {} if any(value is None for value in values) else {name: formula(*values)}
        rows.append({**row, **made})
    return TableConcept(_with_columns(table.columns, {name: None}), rows)


REDUCTIONS = {"MAXI": max, "MINI": min, "SOMM": sum, "MOY": lambda values: sum(values) / len(values)}


def _reduce(table: TableConcept, action: Arguments) -> TableConcept:
    """CALCUL: a row a reduction of the columns."""
    rows = []
    for word in action.TYPE_CALCUL:
        row: Row = {}
        for name in action.NOM_PARA:
            need_column(table, name, "CALC_TABLE/CALCUL")
            values = [value for value in (one.get(name) for one in table.rows) if value is not None]
            if word.endswith("_ABS"):
                values = [abs(value) for value in values]
            if values:
                row[name] = REDUCTIONS[word.removesuffix("_ABS")](values)
        rows.append({**row, "TYPE_CALCUL": word})
    return TableConcept([*action.NOM_PARA, "TYPE_CALCUL"], rows)


ACTIONS = {"CALCUL": _reduce,
           "FILTRE": _filter, "EXTR": _keep, "SUPPRIME": _drop, "RENOMME": _rename, "TRI": _sort, "COMB": _join,
           "AJOUT_LIGNE": _add_row, "AJOUT_COLONNE": _add_columns, "OPER": _operate}

# ---- RECU_TABLE ------------------------------------------------------------------------------------------------

RECOVER: dict[str, Key] = {"CO": concept("Result", required=True), "NOM_TABLE": text(), "NOM_PARA": texts(),
                           "TITRE": texts(), "INFO": harmless()}
OBSERVATION = ["NOM_OBSERVATION", "NUME_REUSE", "INST", "TYPE_OBJET", "NOM_CHAM", "EVAL_CHAM", "NOM_CMP", "NOM_VARI",
               "EVAL_CMP", "NOEUD", "MAILLE", "POINT", "SOUS_POINT", "VALE"]


def recover(session: Any, arguments: Arguments) -> TableConcept:
    result, title = arguments.CO, " ".join(arguments.TITRE)
    if arguments.NOM_PARA:
        return TableConcept(["NUME_ORDRE", *arguments.NOM_PARA],
                            [_parameters(result, place, arguments.NOM_PARA) for place in range(len(result.stored))],
                            title)
    if arguments.NOM_TABLE == "PARA_CALC":
        if not result.parameters:
            raise CommandError(f"RECU_TABLE: result {result.name} has no PARA_CALC: it was not solved in steps.")
        return TableConcept(list(dict.fromkeys(name for row in result.parameters for name in row)),
                            [dict(row) for row in result.parameters], title)
    if arguments.NOM_TABLE != "OBSERVATION":
        raise CommandError(f"RECU_TABLE/NOM_TABLE: {arguments.NOM_TABLE} is not available; OBSERVATION and PARA_CALC "
                           "are.")
    if not result.observations:
        raise CommandError(f"RECU_TABLE: result {result.name} has no observations.")
    extra = [name for row in result.observations for name in row if name not in OBSERVATION]
    columns = [name for name in OBSERVATION if any(name in row for row in result.observations)]
    return TableConcept(columns + list(dict.fromkeys(extra)), [dict(row) for row in result.observations], title)


def _parameters(result: Result, place: int, names: tuple[str, ...]) -> Row:
    stored = result.stored[place]
    known = {"INST": stored.instant, "ITER_GLOB": stored.iterations, **stored.parameters}
    for name in names:
        if name not in known:
            raise CommandError(f"RECU_TABLE/NOM_PARA: there is no parameter {name}; there are {', '.join(known)}.")
    return {"NUME_ORDRE": stored.order, **{name: known[name] for name in names}}


# ---- IMPR_TABLE, IMPR_FONCTION ------------------------------------------------------------------------------------

PRINT: dict[str, Key] = {
    "TABLE": concept("TableConcept", required=True), "UNITE": integer(8), "FILTRE": factor(FILTER_KEYS),
    "TRI": factor({"NOM_PARA": texts(required=True), "ORDRE": words("CROISSANT", "DECROISSANT", default="CROISSANT")},
                  most=1),
    "NOM_PARA": texts(), "SEPARATEUR": anything(default=" "),
    "COMMENTAIRE": anything(default="#"), "FORMAT": harmless(), "FORMAT_R": harmless(),
    "PAGINATION": harmless(), "FORMAT_C": harmless(), "TITRE": texts(), "INFO": harmless(), "IMPR_FONCTION": harmless(),
    "LEGENDE_X": harmless(), "LEGENDE_Y": harmless(), "BORNE_X": harmless(), "BORNE_Y": harmless(),
    "LEGENDE": harmless(), "ECHELLE_X": harmless(), "ECHELLE_Y": harmless(), "STYLE": harmless(),
    "COULEUR": harmless(), "MARQUEUR": harmless(), "FREQ_MARQUEUR": harmless(), "GRILLE_X": harmless(),
    "GRILLE_Y": harmless(), "TABL_FONC": harmless(), "PILOTE": harmless(), "DEBUT_TABLE": harmless(),
    "FIN_TABLE": harmless(), "DEBUT_LIGNE": harmless(), "FIN_LIGNE": harmless(),
}


def print_table(session: Any, arguments: Arguments) -> None:
    table = arguments.TABLE
    rows = filtered(table, arguments.FILTRE, "IMPR_TABLE")
    for order in arguments.TRI:
        rows = ordered_rows(rows, order.NOM_PARA, order.ORDRE == "DECROISSANT")
    shown = TableConcept(table.columns, rows, " ".join(arguments.TITRE) or table.title or table.name)
    lines = table_lines(shown, arguments.NOM_PARA or None, arguments.SEPARATEUR, arguments.COMMENTAIRE)
    write_lines(session, arguments.UNITE, lines)


def write_lines(session: Any, unit: int, lines: list[str]) -> None:
    """To the screen, units 6 and 8 without a file, or to the file of the unit, behind what the session wrote there."""
    if unit in (6, 8) and unit not in session.files:
        for line in lines:
            session.say(line)
        return
    path = session.output_of(unit, ".txt")
    with path.open("a" if path in session.written else "w", encoding="utf-8") as file:
        file.write("\n".join(lines) + "\n")
    session.written.add(path)


CURVE: dict[str, Key] = {
    "FONCTION": concept("Function"), "ABSCISSE": anything(), "ORDONNEE": anything(),
    "LIST_PARA": concept("RealList"), "LEGENDE": text(), "FONC_X": concept("Function"), "FONC_Y": concept("Function"),
    **{name: harmless() for name in ("STYLE", "COULEUR", "MARQUEUR", "FREQ_MARQUEUR", "TRI")},
}
PRINT_FUNCTION: dict[str, Key] = {
    "COURBE": factor(CURVE, required=True), "UNITE": integer(8), "TITRE": texts(),
    "SEPARATEUR": anything(default=" "), "COMMENTAIRE": anything(default="#"),
    **{name: harmless() for name in (
        "FORMAT", "SOUS_TITRE", "BORNE_X", "BORNE_Y", "LEGENDE_X", "LEGENDE_Y", "ECHELLE_X", "ECHELLE_Y", "GRILLE_X",
        "GRILLE_Y", "TRI", "INFO", "PILOTE", "FORMAT_R", "DEBUT_LIGNE", "FIN_LIGNE", "DEBUT_TABLE", "FIN_TABLE",
        "LARG", "HAUT", "NB_CHIFFRE", "UNITE_DIGR", "AVEC_TITRE")},
}


def print_functions(session: Any, arguments: Arguments) -> None:
    for curve in arguments.COURBE:
        columns, places, values = _points_of(curve)
        rows = [dict(zip(columns, pair)) for pair in zip(places, values)]
        title = " ".join(arguments.TITRE) or curve.LEGENDE or ""
        write_lines(session, arguments.UNITE, table_lines(TableConcept(columns, rows, title), None,
                                                          arguments.SEPARATEUR, arguments.COMMENTAIRE))


def _points_of(curve: Arguments) -> tuple[list[str], list[float], list[float]]:
    if curve.FONC_X is not None and curve.FONC_Y is not None:
        where = curve.LIST_PARA.values if curve.LIST_PARA else curve.FONC_X.places
        return ["X", "Y"], [curve.FONC_X(t) for t in where], [curve.FONC_Y(t) for t in where]
    if curve.FONCTION is None:
        return ["ABSCISSE", "ORDONNEE"], list(_as_tuple(curve.ABSCISSE)), list(_as_tuple(curve.ORDONNEE))
    function = curve.FONCTION
    if curve.LIST_PARA is not None:
        places = list(map(float, curve.LIST_PARA.values))
    elif isinstance(function, TableFunction):
        places = function.places.tolist()
    else:
        raise CommandError("IMPR_FONCTION/COURBE: LIST_PARA is missing for a function without places of its own.")
    name = function.parameters[0] if function.parameters else "X"
    return [name, function.name or "VALE"], places, [float(function(x)) for x in places]


COMMANDS = [
    Command("CREA_TABLE", CREATE, create),
    Command("CALC_TABLE", CALCULATE, calculate),
    Command("RECU_TABLE", RECOVER, recover),
    Command("IMPR_TABLE", PRINT, print_table),
    Command("IMPR_FONCTION", PRINT_FUNCTION, print_functions),
    Command("IMPR_CO", {}, print_functions, harmless=True),
]
