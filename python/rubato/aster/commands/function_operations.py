# SPDX-License-Identifier: LGPL-3.0-or-later
"""CALC_FONCTION, INFO_FONCTION: functions of functions, and what they are like."""

from __future__ import annotations

from collections.abc import Callable
from functools import reduce
from typing import Any

import numpy as np

from ..concepts import Constant, TableConcept, TableFunction
from ..keys import Arguments, Command, CommandError, Key, concept, factor, harmless, integer, real, reals, text, words
from .functions import PROLONGED, ascending, both, interpolations

# Steps that differ by less than this share are equal in Simpson's rule.
EQUAL_STEPS = 1e-4


def function(**more: Any) -> Key:
    return concept("TableFunction", "Constant", **more)


# ---- tables --------------------------------------------------------------------------------------------------


def as_table(given: TableFunction | Constant) -> TableFunction:
    """A constant is a table of one place, extended to both sides."""
    if isinstance(given, Constant):
        table = TableFunction("TOUTPARA", [1.0], [given.value], "CONSTANT", "CONSTANT")
        table.name = given.name
        return table
    return given


def like(table: TableFunction, places: Any, values: Any, **changes: Any) -> TableFunction:
    """Other numbers, and the parameter, extensions, interpolation and result of a table unless changed."""
    made = TableFunction(changes.get("parameter", table.parameters[0]), places, values,
                         changes.get("before", table.before), changes.get("after", table.after),
                         changes.get("interpolation", table.interpolation), changes.get("result", table.result))
    made.name = table.name
    return made


def values_at(table: TableFunction, places: np.ndarray) -> np.ndarray:
    return np.array([table(place) for place in places])


def common(first: TableFunction, second: TableFunction) -> tuple[np.ndarray, str, str]:
    """The places of both functions where both have values, and how that is extended: where one is not extended, the
    other one is cut off."""
    lower, upper = (second, first) if second.places[0] > first.places[0] else (first, second)
    left = upper if lower.before != "EXCLU" else lower
    lower, upper = (second, first) if first.places[-1] > second.places[-1] else (first, second)
    right = upper if lower.after != "EXCLU" else lower
    places = np.unique(np.clip(np.concatenate([first.places, second.places]), left.places[0], right.places[-1]))
    return places, left.before, right.after


def combined(first: TableFunction, second: TableFunction, operation: Callable[[Any, Any], Any]) -> TableFunction:
    places, before, after = common(first, second)
    values = operation(values_at(first, places), values_at(second, places))
    return like(first, places, values, before=before, after=after)


def derived(result: str, ways: dict[str, str]) -> str:
    """What the integral or derivative of a function gives: DEPL, VITE, ACCE follow each other."""
    return ways.get(result[:4], result)


_INTEGRAL = {"VITE": "DEPL", "ACCE": "VITE"}
_DERIVATIVE = {"DEPL": "VITE", "VITE": "ACCE"}


def trapezoidal(table: TableFunction, start: float) -> np.ndarray:
    x, y = table.places, table.values
    return np.cumsum(np.concatenate([[start], (y[1:] + y[:-1]) / 2 * np.diff(x)]))


def simpson(table: TableFunction, start: float) -> np.ndarray:
    """Simpson's rule over every two intervals; odd places continue from the first one, a trapezium."""
    x, y = table.places, table.values
    sums = [start, start + (y[0] + y[1]) * (x[1] - x[0]) / 2]
    for i in range(2, len(x)):
        h1, h2 = x[i - 1] - x[i - 2], x[i] - x[i - 1]
        difference = h2 - h1
        weights = (1.0, 4.0, 1.0)
        if abs(difference / h1) > EQUAL_STEPS:
            share = difference / (h1 * h2)
            weights = (1 - share * h2, 4 + share * difference, 1 + share * h1)
        sums.append(sums[i - 2] + (h1 + h2) / 6 * float(np.dot(weights, y[i - 2:i + 1])))
    return np.array(sums)


def cut_off(table: TableFunction, start: float, end: float) -> TableFunction:
    inner = (table.places > start) & (table.places < end)
    places = np.concatenate([[start], table.places[inner], [end]])
    return like(table, places, values_at(table, places), before="EXCLU", after="EXCLU")


# ---- CALC_FONCTION -------------------------------------------------------------------------------------------


def _linear_combination(items: list[Arguments]) -> TableFunction:
    tables = [as_table(item.FONCTION) for item in items]
    scaled = [like(table, table.places, item.COEF * table.values) for table, item in zip(tables, items)]
    whole = reduce(lambda done, added: combined(added, done, np.add), scaled)
    # Extensions, interpolation and names are those of the first function.
    return like(tables[0], whole.places, whole.values)


def _product(items: list[Arguments]) -> TableFunction:
    tables = [as_table(item.FONCTION) for item in items]
    whole = reduce(lambda done, factor_: combined(factor_, done, np.multiply), tables)
    return like(tables[0], whole.places, whole.values)


def _integral(items: list[Arguments]) -> TableFunction:
    table = as_table(items[0].FONCTION)
    rule = simpson if items[0].METHODE == "SIMPSON" else trapezoidal
    if len(table.places) < 2:
        raise CommandError("CALC_FONCTION/INTEGRE: expected a function with at least two places.")
    return like(table, table.places, rule(table, items[0].COEF), before="EXCLU", after="EXCLU",
                result=derived(table.result, _INTEGRAL))


def _derivative(items: list[Arguments]) -> TableFunction:
    table = as_table(items[0].FONCTION)
    if len(table.places) < 2:
        raise CommandError("CALC_FONCTION/DERIVE: expected a function with at least two places.")
    steps = np.diff(table.places)
    slopes = np.diff(table.values) / steps
    inner = (slopes[1:] * steps[1:] + slopes[:-1] * steps[:-1]) / (steps[1:] + steps[:-1])
    return like(table, table.places, np.concatenate([slopes[:1], inner, slopes[-1:]]), before="EXCLU", after="EXCLU",
                result=derived(table.result, _DERIVATIVE))


def _absolute(items: list[Arguments]) -> TableFunction:
    table = as_table(items[0].FONCTION)
    before, after = ("EXCLU" if way == "LINEAIRE" else way for way in (table.before, table.after))
    return like(table, table.places, np.abs(table.values), before=before, after=after)


def _power(items: list[Arguments]) -> TableFunction:
    table = as_table(items[0].FONCTION)
    return like(table, table.places, table.values ** items[0].EXPOSANT)


def _inverse(items: list[Arguments]) -> TableFunction:
    table = as_table(items[0].FONCTION)
    places, values = table.values, table.places
    if len(places) > 1 and places[0] > places[-1]:
        places, values = places[::-1], values[::-1]
    ascending("CALC_FONCTION/INVERSE", places, values, False)
    before, after = ("EXCLU" if way == "CONSTANT" else way for way in (table.before, table.after))
    return like(table, places, values, before=before, after=after, result="TOUTRESU",
                interpolation=table.interpolation[::-1])


def _composition(items: list[Arguments]) -> TableFunction:
    outer, inner = as_table(items[0].FONC_RESU), as_table(items[0].FONC_PARA)
    if isinstance(items[0].FONC_RESU, TableFunction) and inner.result != outer.parameters[0]:
        raise CommandError(f"CALC_FONCTION/COMPOSE: FONC_RESU has the parameter {outer.parameters[0]}, FONC_PARA gives "
                           f"{inner.result}.")
    return like(outer, inner.places, values_at(outer, inner.values), parameter=inner.parameters[0])


def _envelope(items: list[Arguments]) -> TableFunction:
    tables = [as_table(given) for given in items[0].FONCTION]
    places = np.unique(np.concatenate([table.places for table in tables]))
    whole = np.array([values_at(table, places) for table in tables])
    return like(tables[0], places, np.max(whole, axis=0) if items[0].CRITERE == "SUP" else np.min(whole, axis=0))


def _joined(items: list[Arguments]) -> TableFunction:
    tables = [as_table(given) for given in items[0].FONCTION]
    if len(tables) != 2 or tables[0].interpolation != tables[1].interpolation:
        raise CommandError("CALC_FONCTION/ASSE: expected two functions of the same interpolation.")
    first, second = sorted(tables, key=lambda table: table.places[0])
    if items[0].SURCHARGE == "GAUCHE":
        kept_first = np.full(len(first.places), True)
        kept_second = second.places > first.places[-1]
    else:
        kept_first = first.places < second.places[0]
        kept_second = np.full(len(second.places), True)
    places = np.concatenate([first.places[kept_first], second.places[kept_second]])
    values = np.concatenate([first.values[kept_first], second.values[kept_second]])
    return like(tables[0], places, values, before=first.before,
                after=(second if second.places[-1] >= first.places[-1] else first).after)


OPERATIONS: dict[str, tuple[Key, Callable[[list[Arguments]], TableFunction]]] = {
    "COMB": (factor({"FONCTION": function(required=True), "COEF": real(required=True)}), _linear_combination),
    "MULT": (factor({"FONCTION": function(required=True)}), _product),
    "INTEGRE": (factor({"FONCTION": function(required=True), "COEF": real(0.0),
                        "METHODE": words("TRAPEZE", "SIMPSON", default="TRAPEZE")}, most=1), _integral),
    "DERIVE": (factor({"FONCTION": function(required=True),
                       "METHODE": words("DIFF_CENTREE", default="DIFF_CENTREE")}, most=1), _derivative),
    "ABS": (factor({"FONCTION": function(required=True)}, most=1), _absolute),
    "PUISSANCE": (factor({"FONCTION": function(required=True), "EXPOSANT": integer(1)}, most=1), _power),
    "INVERSE": (factor({"FONCTION": function(required=True)}, most=1), _inverse),
    "COMPOSE": (factor({"FONC_RESU": function(required=True), "FONC_PARA": function(required=True)}, most=1),
                _composition),
    "ENVELOPPE": (factor({"FONCTION": function(required=True, many=True),
                          "CRITERE": words("SUP", "INF", default="SUP")}, most=1), _envelope),
    "ASSE": (factor({"FONCTION": function(required=True, many=True),
                     "SURCHARGE": words("DROITE", "GAUCHE", default="DROITE")}, most=1), _joined),
}

CALC_FONCTION = {
    **{name: key for name, (key, _) in OPERATIONS.items()},
    "LIST_PARA": concept("RealList"), "NOM_PARA": text(), "NOM_RESU": text(), "INTERPOL": interpolations(),
    "PROL_GAUCHE": words(*PROLONGED), "PROL_DROITE": words(*PROLONGED), "INFO": harmless(),
}


def calc_fonction(session: Any, arguments: Arguments) -> TableFunction:
    wanted = [name for name in OPERATIONS if getattr(arguments, name)]
    if len(wanted) != 1:
        raise CommandError(f"CALC_FONCTION: expected one of {', '.join(OPERATIONS)}.")
    made = OPERATIONS[wanted[0]][1](getattr(arguments, wanted[0]))
    if arguments.given("LIST_PARA"):
        if wanted[0] not in ("COMB", "MULT"):
            raise CommandError(f"CALC_FONCTION: LIST_PARA goes with COMB and MULT, not with {wanted[0]}.")
        made = like(made, arguments.LIST_PARA.values, values_at(made, arguments.LIST_PARA.values))
    return _renamed(made, arguments)


def _renamed(made: TableFunction, arguments: Arguments) -> TableFunction:
    table = like(made, made.places, made.values, parameter=arguments.NOM_PARA or made.parameters[0],
                 result=arguments.NOM_RESU or made.result, before=arguments.PROL_GAUCHE or made.before,
                 after=arguments.PROL_DROITE or made.after, interpolation=both(arguments.INTERPOL, made.interpolation))
    table.name = ""
    return table


# ---- INFO_FONCTION -------------------------------------------------------------------------------------------

_SIGNAL = {
    "FONCTION": function(required=True), "METHODE": words("TRAPEZE", "SIMPSON", default="TRAPEZE"),
    "INST_INIT": real(), "INST_FIN": real(), "CRITERE": harmless(), "PRECISION": harmless(),
}
INFO_FONCTION = {
    "MAX": factor({"FONCTION": function(required=True, many=True), "INTERVALLE": reals()}, most=1),
    "RMS": factor(_SIGNAL), "ECART_TYPE": factor(_SIGNAL, most=1),
    "NORME": factor({"FONCTION": concept("SurfaceFunction", required=True)}, most=1),
    "INFO": harmless(),
}


def info_fonction(session: Any, arguments: Arguments) -> TableConcept:
    rows = {"MAX": _extrema, "RMS": _root_mean_squares, "ECART_TYPE": _deviation, "NORME": _norms}
    wanted = [name for name in rows if getattr(arguments, name)]
    if len(wanted) != 1:
        raise CommandError(f"INFO_FONCTION: expected one of {', '.join(rows)}.")
    return rows[wanted[0]](getattr(arguments, wanted[0]))


def _extrema(items: list[Arguments]) -> TableConcept:
    tables = [as_table(given) for given in items[0].FONCTION]
    names = {(table.parameters[0], table.result) for table in tables}
    if len(names) > 1:
        raise CommandError("INFO_FONCTION/MAX: the functions have different parameters or results.")
    parameter, result = names.pop()
    ranges = _ranges(items[0].INTERVALLE)
    columns = ["FONCTION", "TYPE", *(("INTERVALLE", f"{parameter}_MIN", f"{parameter}_MAX") if ranges else ()),
               parameter, result]
    rows = []
    for table in tables:
        for number, (start, end) in enumerate(ranges or [(table.places[0], table.places[-1])], 1):
            bounds = {"INTERVALLE": number, f"{parameter}_MIN": start, f"{parameter}_MAX": end} if ranges else {}
            part = cut_off(table, start, end) if end > start else table
            for word, value in (("MINI", np.min(part.values)), ("MAXI", np.max(part.values))):
                rows += [{"FONCTION": table.name, "TYPE": word, **bounds, parameter: float(place), result: float(value)}
                         for place in part.places[part.values == value]]
    return TableConcept(columns, rows, "extrema")


def _ranges(bounds: tuple[float, ...]) -> list[tuple[float, float]]:
    if len(bounds) % 2 or any(end < start for start, end in zip(bounds[::2], bounds[1::2])):
        raise CommandError("INFO_FONCTION/MAX/INTERVALLE: expected pairs of ascending numbers.")
    return list(zip(bounds[::2], bounds[1::2]))


def _signal(item: Arguments) -> tuple[TableFunction, float, float]:
    table = as_table(item.FONCTION)
    start = table.places[0] if item.INST_INIT is None else item.INST_INIT
    end = table.places[-1] if item.INST_FIN is None else item.INST_FIN
    if end <= start:
        raise CommandError(f"INFO_FONCTION: expected a range of instants, found {start:g} to {end:g}.")
    return cut_off(table, start, end), float(start), float(end)


def _mean(item: Arguments, table: TableFunction) -> float:
    rule = simpson if item.METHODE == "SIMPSON" else trapezoidal
    return float(rule(table, 0.0)[-1] / (table.places[-1] - table.places[0]))


def _root_mean_squares(items: list[Arguments]) -> TableConcept:
    rows = []
    for item in items:
        table, start, end = _signal(item)
        square = like(table, table.places, table.values ** 2)
        rows.append({"FONCTION": table.name, "METHODE": item.METHODE, "INST_INIT": start, "INST_FIN": end,
                     "RMS": float(np.sqrt(_mean(item, square)))})
    return TableConcept(["FONCTION", "METHODE", "INST_INIT", "INST_FIN", "RMS"], rows, "root mean squares")


def _deviation(items: list[Arguments]) -> TableConcept:
    table, start, end = _signal(items[0])
    mean = _mean(items[0], table)
    square = like(table, table.places, (table.values - mean) ** 2)
    row = {"FONCTION": table.name, "METHODE": items[0].METHODE, "MOYENNE": mean,
           "ECART_TYPE": float(np.sqrt(_mean(items[0], square))), "INST_INIT": start, "INST_FIN": end}
    return TableConcept(list(row), [row], "standard deviation")


def _norms(items: list[Arguments]) -> TableConcept:
    surface = items[0].FONCTION
    rows = []
    for given in surface.functions:
        table = as_table(given)
        square = like(table, table.places, table.values ** 2)
        rows.append({"NORME": float(np.sqrt(trapezoidal(square, 0.0)[-1])), "FONCTION": surface.name})
    return TableConcept(["NORME", "FONCTION"], rows, "norms")


COMMANDS = [
    Command("CALC_FONCTION", CALC_FONCTION, calc_fonction),
    Command("INFO_FONCTION", INFO_FONCTION, info_fonction),
]
