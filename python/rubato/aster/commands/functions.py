# SPDX-License-Identifier: LGPL-3.0-or-later
"""DEFI_FONCTION, DEFI_CONSTANTE, DEFI_NAPPE, FORMULE, CALC_FONC_INTERP: functions of one or several parameters."""

from __future__ import annotations

from typing import Any

import numpy as np

from ..concepts import Constant, Formula, Function, RealList, TableFunction
from ..keys import (Arguments, Command, CommandError, Key, concept, factor, harmless, real, reals, text,
                    texts, words)
from ..surface_function import SurfaceFunction

PROLONGED = ("EXCLU", "CONSTANT", "LINEAIRE")
_NO_INTERPOLATION = {"NON": "Values between the places are needed: LIN."}


def interpolations(**more: Any) -> Key:
    """INTERPOL: for places and values, or one word for both."""
    return words("LIN", "LOG", many=True, missing=_NO_INTERPOLATION, **more)


def both(given: tuple[str, ...], otherwise: tuple[str, str] = ("LIN", "LIN")) -> tuple[str, str]:
    """The interpolation of places and of values."""
    return (given[0], given[-1]) if given else otherwise


# ---- DEFI_FONCTION -------------------------------------------------------------------------------------------

DEFI_FONCTION = {
    "NOM_PARA": text(required=True), "NOM_RESU": text("TOUTRESU"),
    "VALE": reals(), "ABSCISSE": reals(), "ORDONNEE": reals(),
    "VALE_PARA": concept("RealList"), "VALE_FONC": concept("RealList"),
    "INTERPOL": interpolations(),
    "PROL_GAUCHE": words(*PROLONGED, default="EXCLU"), "PROL_DROITE": words(*PROLONGED, default="EXCLU"),
    "VERIF": words("CROISSANT", "NON", default="CROISSANT"),
    "INFO": harmless(), "TITRE": harmless(),
}


def defi_fonction(session: Any, arguments: Arguments) -> TableFunction:
    places, values = _pairs(arguments)
    places, values = ascending("DEFI_FONCTION", places, values, arguments.VERIF == "NON")
    interpolation = both(arguments.INTERPOL)
    check_logarithms("DEFI_FONCTION", places, values, interpolation)
    return TableFunction(arguments.NOM_PARA, places, values, arguments.PROL_GAUCHE, arguments.PROL_DROITE,
                         interpolation, arguments.NOM_RESU)


def _pairs(arguments: Arguments) -> tuple[np.ndarray, np.ndarray]:
    forms = [name for name in ("VALE", "ABSCISSE", "VALE_PARA") if arguments.given(name)]
    if len(forms) != 1:
        raise CommandError("DEFI_FONCTION: expected one of VALE, ABSCISSE and VALE_PARA.")
    if forms == ["VALE"]:
        return split_pairs("DEFI_FONCTION/VALE", arguments.VALE)
    first, second = ("ABSCISSE", "ORDONNEE") if forms == ["ABSCISSE"] else ("VALE_PARA", "VALE_FONC")
    places = _numbers(getattr(arguments, first))
    values = _numbers(getattr(arguments, second))
    if len(places) != len(values) or not len(places):
        raise CommandError(f"DEFI_FONCTION/{second}: expected {len(places)} values, found {len(values)}.")
    return places, values


def _numbers(given: Any) -> np.ndarray:
    return given.values if isinstance(given, RealList) else np.asarray(given or (), dtype=float)


def split_pairs(path: str, values: tuple[float, ...]) -> tuple[np.ndarray, np.ndarray]:
    """x1, y1, x2, y2, …: places and values."""
    if len(values) < 2 or len(values) % 2:
        raise CommandError(f"{path}: expected pairs of place and value, found {len(values)} numbers.")
    table = np.asarray(values, dtype=float).reshape(-1, 2)
    return table[:, 0], table[:, 1]


def ascending(path: str, places: np.ndarray, values: np.ndarray, sort: bool) -> tuple[np.ndarray, np.ndarray]:
    """Places that ascend strictly. `sort`: they may stand in any order."""
    if sort:
        order = np.argsort(places, kind="stable")
        places, values = places[order], values[order]
    wrong = np.flatnonzero(np.diff(places) <= 0)
    if len(wrong):
        first, second = places[wrong[0]], places[wrong[0] + 1]
        raise CommandError(f"{path}: the places must ascend strictly, found {first:g} before {second:g}.")
    return places, values


def check_logarithms(path: str, places: np.ndarray, values: np.ndarray, interpolation: tuple[str, str]) -> None:
    for numbers, way, what in ((places, interpolation[0], "places"), (values, interpolation[1], "values")):
        if way == "LOG" and np.min(numbers) <= 0:
            raise CommandError(f"{path}/INTERPOL: LOG needs {what} above 0, found {np.min(numbers):g}.")


# ---- DEFI_CONSTANTE ------------------------------------------------------------------------------------------

DEFI_CONSTANTE = {"VALE": real(required=True), "NOM_RESU": harmless(), "INFO": harmless(), "TITRE": harmless()}


def defi_constante(session: Any, arguments: Arguments) -> Constant:
    return Constant(arguments.VALE)


# ---- DEFI_NAPPE ----------------------------------------------------------------------------------------------

DEFI_NAPPE = {
    "NOM_PARA": text(required=True), "NOM_PARA_FONC": text(), "NOM_RESU": text("TOUTRESU"),
    "PARA": reals(required=True), "FONCTION": concept("TableFunction", "Constant", many=True),
    "DEFI_FONCTION": factor({
        "VALE": reals(required=True), "INTERPOL": interpolations(),
        "PROL_GAUCHE": words(*PROLONGED, default="EXCLU"), "PROL_DROITE": words(*PROLONGED, default="EXCLU"),
    }),
    "INTERPOL": interpolations(),
    "PROL_GAUCHE": words(*PROLONGED, default="EXCLU"), "PROL_DROITE": words(*PROLONGED, default="EXCLU"),
    "VERIF": words("CROISSANT"), "INFO": harmless(), "TITRE": harmless(),
}


def defi_nappe(session: Any, arguments: Arguments) -> SurfaceFunction:
    if bool(arguments.FONCTION) == bool(arguments.DEFI_FONCTION):
        raise CommandError("DEFI_NAPPE: expected one of FONCTION and DEFI_FONCTION.")
    inner, functions = _functions_of_surface(arguments)
    if len(functions) != len(arguments.PARA):
        raise CommandError(f"DEFI_NAPPE/PARA: expected as many numbers as functions ({len(functions)}), found "
                           f"{len(arguments.PARA)}.")
    places = np.asarray(arguments.PARA, dtype=float)
    order = np.arange(len(places)) if arguments.VERIF else np.argsort(places, kind="stable")
    if len(places) > 1 and np.min(np.diff(places[order])) <= 0:
        raise CommandError("DEFI_NAPPE/PARA: the numbers must ascend strictly.")
    return SurfaceFunction((arguments.NOM_PARA, inner), places[order], [functions[i] for i in order],
                           arguments.PROL_GAUCHE, arguments.PROL_DROITE, both(arguments.INTERPOL),
                           arguments.NOM_RESU)


def _functions_of_surface(arguments: Arguments) -> tuple[str, list[Function]]:
    if arguments.FONCTION:
        names = {function.parameters[0] for function in arguments.FONCTION if function.parameters}
        if len(names) > 1:
            raise CommandError(f"DEFI_NAPPE/FONCTION: the functions have several parameters: {', '.join(names)}.")
        return (names.pop() if names else "TOUTPARA"), list(arguments.FONCTION)
    inner = arguments.NOM_PARA_FONC
    if inner is None:
        raise CommandError("DEFI_NAPPE: keyword NOM_PARA_FONC is missing.")
    functions: list[Function] = []
    for item in arguments.DEFI_FONCTION:
        path = "DEFI_NAPPE/DEFI_FONCTION"
        places, values = split_pairs(f"{path}/VALE", item.VALE)
        places, values = ascending(path, places, values, arguments.VERIF is None)
        check_logarithms(path, places, values, both(item.INTERPOL))
        functions.append(TableFunction(inner, places, values, item.PROL_GAUCHE, item.PROL_DROITE,
                                       both(item.INTERPOL), arguments.NOM_RESU))
    return inner, functions


# ---- FORMULE -------------------------------------------------------------------------------------------------

# Other keywords are the formula's own constants and functions.
FORMULE = {
    "NOM_PARA": texts(required=True), "VALE": text(),
    "INFO": harmless(),
}


def formule(session: Any, arguments: Arguments) -> Formula:
    if "VALE_C" in arguments.others:
        raise CommandError("FORMULE: keyword VALE_C is not available. There are real formulas only: VALE.")
    if not arguments.given("VALE"):
        raise CommandError("FORMULE: keyword VALE is missing.")
    parameters = tuple(name.strip() for item in arguments.NOM_PARA for name in item.strip("() ").split(","))
    wrong = [name for name in parameters if not name.isidentifier()]
    if wrong:
        raise CommandError(f"FORMULE/NOM_PARA: expected names of parameters, found {wrong[0]!r}.")
    expression = arguments.VALE.replace("\\\n", " ")
    try:
        return Formula(parameters, expression, arguments.others, session.namespace)
    except (SyntaxError, ValueError) as error:
        raise CommandError(f"FORMULE/VALE: {error.args[0]} in {expression!r}.") from error


# ---- CALC_FONC_INTERP ----------------------------------------------------------------------------------------

CALC_FONC_INTERP = {
    "FONCTION": concept("Function", required=True),
    "VALE_PARA": reals(), "LIST_PARA": concept("RealList"),
    "NOM_PARA": text(), "NOM_RESU": text(), "INTERPOL": interpolations(),
    "PROL_GAUCHE": words(*PROLONGED), "PROL_DROITE": words(*PROLONGED),
    "NOM_PARA_FONC": text(), "VALE_PARA_FONC": reals(), "LIST_PARA_FONC": concept("RealList"),
    "INTERPOL_FONC": interpolations(), "PROL_GAUCHE_FONC": words(*PROLONGED), "PROL_DROITE_FONC": words(*PROLONGED),
    "INFO": harmless(), "TITRE": harmless(),
}


def calc_fonc_interp(session: Any, arguments: Arguments) -> Function:
    function = arguments.FONCTION
    count = len(function.parameters)
    if count > 2:
        raise CommandError(f"CALC_FONC_INTERP/FONCTION: expected a function of one or two parameters, found {count}.")
    places = np.sort(_chosen(arguments, "VALE_PARA", "LIST_PARA"))
    if count == 2:
        return _interpolated_surface(function, places, arguments)
    values = np.array([float(function(place)) for place in places])
    parameter = arguments.NOM_PARA or (function.parameters[0] if count else "TOUTPARA")
    return _table(parameter, places, values, function, arguments, "")


def _chosen(arguments: Arguments, numbers: str, values: str) -> np.ndarray:
    if bool(getattr(arguments, numbers)) == arguments.given(values):
        raise CommandError(f"CALC_FONC_INTERP: expected one of {numbers} and {values}.")
    return _numbers(getattr(arguments, numbers) or getattr(arguments, values))


def _table(parameter: str, places: np.ndarray, values: np.ndarray, function: Function, arguments: Arguments,
           ending: str) -> TableFunction:
    """A table with the ways given by the keywords with that ending, else those of the function."""
    before = getattr(arguments, "PROL_GAUCHE" + ending) or getattr(function, "before", "EXCLU")
    after = getattr(arguments, "PROL_DROITE" + ending) or getattr(function, "after", "EXCLU")
    interpolation = both(getattr(arguments, "INTERPOL" + ending), getattr(function, "interpolation", ("LIN", "LIN")))
    ascending("CALC_FONC_INTERP", places, values, False)
    check_logarithms("CALC_FONC_INTERP", places, values, interpolation)
    result = arguments.NOM_RESU or getattr(function, "result", "TOUTRESU")
    return TableFunction(parameter, places, values, before, after, interpolation, result)


def _interpolated_surface(function: Function, places: np.ndarray, arguments: Arguments) -> SurfaceFunction:
    outer, inner = function.parameters
    for keyword, name in (("NOM_PARA", outer), ("NOM_PARA_FONC", inner)):
        if getattr(arguments, keyword) not in (None, name):
            raise CommandError(f"CALC_FONC_INTERP/{keyword}: the function has the parameter {name}, found "
                               f"{getattr(arguments, keyword)}.")
    inner_places = np.sort(_chosen(arguments, "VALE_PARA_FONC", "LIST_PARA_FONC"))
    functions = []
    for place in places:
        values = np.array([float(function(place, x)) for x in inner_places])
        functions.append(_table(inner, inner_places, values, function, arguments, "_FONC"))
    return SurfaceFunction((outer, inner), places, functions,
                           arguments.PROL_GAUCHE or getattr(function, "before", "EXCLU"),
                           arguments.PROL_DROITE or getattr(function, "after", "EXCLU"),
                           both(arguments.INTERPOL), arguments.NOM_RESU or "TOUTRESU")


COMMANDS = [
    Command("DEFI_FONCTION", DEFI_FONCTION, defi_fonction),
    Command("DEFI_CONSTANTE", DEFI_CONSTANTE, defi_constante),
    Command("DEFI_NAPPE", DEFI_NAPPE, defi_nappe),
    Command("FORMULE", FORMULE, formule, others=True),
    Command("CALC_FONC_INTERP", CALC_FONC_INTERP, calc_fonc_interp),
]
