# SPDX-License-Identifier: LGPL-3.0-or-later
"""DEFI_LIST_REEL, DEFI_LIST_ENTI, DEFI_LIST_INST: lists of numbers and instants."""

from __future__ import annotations

from typing import Any

import numpy as np

from ..concepts import Cuts, RealList, TimeList
from ..keys import Arguments, Command, CommandError, concept, factor, harmless, integer, integers, real, reals, words

# A last step that differs from PAS by more than this share of it is a step of its own.
STEP_ROUNDING = 1e-3
# A list that is longer was not meant.
MOST_NUMBERS = 1_000_000
# How often a step is halved with SUBD_METHODE='AUTO', which bounds the length of steps only.
AUTOMATIC_LEVELS = 10

# ---- DEFI_LIST_REEL ------------------------------------------------------------------------------------------

DEFI_LIST_REEL = {
    "VALE": reals(), "DEBUT": real(),
    "INTERVALLE": factor({"JUSQU_A": real(required=True), "NOMBRE": integer(), "PAS": real()}),
    "INFO": harmless(), "TITRE": harmless(),
}


def defi_list_reel(session: Any, arguments: Arguments) -> RealList:
    _check_choice("DEFI_LIST_REEL", arguments)
    if arguments.VALE:
        return RealList(arguments.VALE)
    instants = [arguments.DEBUT]
    for interval in arguments.INTERVALLE:
        instants += _interval("DEFI_LIST_REEL/INTERVALLE", instants[-1], interval)
    return RealList(instants)


def _check_choice(command: str, arguments: Arguments) -> None:
    ranges = arguments.given("DEBUT") and bool(arguments.INTERVALLE)
    if bool(arguments.VALE) == ranges or arguments.given("DEBUT") != bool(arguments.INTERVALLE):
        raise CommandError(f"{command}: expected VALE, or DEBUT and INTERVALLE.")


def _interval(path: str, start: float, interval: Arguments) -> list[float]:
    """The numbers after `start` up to JUSQU_A: sums of the step, the last one exactly JUSQU_A."""
    if interval.given("NOMBRE") == interval.given("PAS"):
        raise CommandError(f"{path}: expected one of NOMBRE and PAS.")
    end = interval.JUSQU_A
    if interval.given("NOMBRE"):
        if not 1 <= interval.NOMBRE <= MOST_NUMBERS:
            raise CommandError(f"{path}/NOMBRE: expected 1 to {MOST_NUMBERS}, found {interval.NOMBRE}.")
        return _steps(start, (end - start) / interval.NOMBRE, interval.NOMBRE, end)
    return _steps_of(path, start, interval.PAS, end)


def _steps_of(path: str, start: float, step: float, end: float) -> list[float]:
    if step == 0 or not 1 - STEP_ROUNDING < (end - start) / step <= MOST_NUMBERS:
        raise CommandError(f"{path}/PAS: there is no step of {step:g} from {start:g} to {end:g}.")
    count = round((end - start) / step)
    last = end - (start + (count - 1) * step)
    if abs((last - step) / step) <= STEP_ROUNDING:
        return _steps(start, step, count, end)
    if (start + count * step - end) * np.sign(step) > 0:
        count -= 1
    return _steps(start, step, count, start + count * step) + [end]


def _steps(start: float, step: float, count: int, end: float) -> list[float]:
    # A sum, not a product: an instant of the list is found again by the same sum in a command file.
    values = []
    value = start
    for _ in range(count - 1):
        value += step
        values.append(value)
    return [*values, end]


# ---- DEFI_LIST_ENTI ------------------------------------------------------------------------------------------

DEFI_LIST_ENTI = {
    "VALE": integers(), "DEBUT": integer(),
    "INTERVALLE": factor({"JUSQU_A": integer(required=True), "NOMBRE": integer(), "PAS": integer()}),
    "OPERATION": words("DEFI", missing={"NUME_ORDRE": ""}), "INFO": harmless(), "TITRE": harmless(),
}


def defi_list_enti(session: Any, arguments: Arguments) -> RealList:
    _check_choice("DEFI_LIST_ENTI", arguments)
    if arguments.VALE:
        return RealList(arguments.VALE)
    numbers = [arguments.DEBUT]
    for interval in arguments.INTERVALLE:
        numbers += _whole_interval(numbers[-1], interval)
    return RealList(numbers)


def _whole_interval(start: int, interval: Arguments) -> list[int]:
    path, end = "DEFI_LIST_ENTI/INTERVALLE", interval.JUSQU_A
    if interval.given("NOMBRE") == interval.given("PAS"):
        raise CommandError(f"{path}: expected one of NOMBRE and PAS.")
    step = interval.PAS
    if interval.given("NOMBRE"):
        if interval.NOMBRE < 1 or (end - start) % interval.NOMBRE:
            raise CommandError(f"{path}/NOMBRE: {start} to {end} cannot be cut into {interval.NOMBRE} whole steps.")
        step = (end - start) // interval.NOMBRE
    if not step or (end - start) % step or not 1 <= (end - start) // step <= MOST_NUMBERS:
        raise CommandError(f"{path}: there is no whole number of steps of {step} from {start} to {end}.")
    return [start + step * (k + 1) for k in range((end - start) // step)]


# ---- DEFI_LIST_INST ------------------------------------------------------------------------------------------

_EVENTS = {"DELTA_GRANDEUR": "Write a list of shorter steps.", "INSTABILITE": ""}
# Failures of a step; the others are events of steps that are solved.
_FAILURES = ("ERREUR", "DIVE_RESI", "RESI_MAXI")
_NOTES = {
    "AUTO": "DEFI_LIST_INST: METHODE='AUTO' is solved as MANUEL: steps are those of the list.",
    "COLLISION": "DEFI_LIST_INST: EVENEMENT='COLLISION' is not followed: steps are not shorter where bodies meet.",
    "INTERPENETRATION": "DEFI_LIST_INST: EVENEMENT='INTERPENETRATION': contact by penalty is solved without penetration, "
                        "which is within any PENE_MAXI.",
    "ITER_SUPPL": "DEFI_LIST_INST: ACTION='ITER_SUPPL' is solved as DECOUPE: iterations end where they do not converge.",
}

DEFI_LIST_INST = {
    "DEFI_LIST": factor({
        "METHODE": words("MANUEL", "AUTO"), "LIST_INST": concept("RealList"), "VALE": reals(),
        "RESULTAT": concept("Result"), "SUBD_PAS": integer(1),
        "PAS_MINI": harmless(), "PAS_MAXI": harmless(), "NB_PAS_MAXI": harmless(),
    }, most=1),
    "ECHEC": factor({
        "EVENEMENT": words(*_FAILURES, "COLLISION", "INTERPENETRATION", default="ERREUR", missing=_EVENTS),
        "ACTION": words("DECOUPE", "ARRET", "ITER_SUPPL", "ADAPT_COEF_PENA", "CONTINUE",
                        missing={"AUTRE_PILOTAGE": ""}),
        "SUBD_METHODE": words("MANUEL", "AUTO"),
        "SUBD_PAS": integer(4), "SUBD_NIVEAU": integer(3), "SUBD_PAS_MINI": real(0.0),
        "SUBD_INST": real(), "SUBD_DUREE": real(), "PENE_MAXI": real(), "COEF_MAXI": real(),
        "RESI_GLOB_MAXI": harmless(), "PCENT_ITER_PLUS": harmless(),
    }),
    # ADAPTATION changes the length of steps between the instants of the list.
    "ADAPTATION": harmless(),
    "METHODE": words("MANUEL", "AUTO", default="MANUEL"),
    "INFO": harmless(),
}


def defi_list_inst(session: Any, arguments: Arguments) -> TimeList:
    if not arguments.DEFI_LIST:
        raise CommandError("DEFI_LIST_INST: keyword DEFI_LIST is missing.")
    (where,) = arguments.DEFI_LIST
    instants = _instants(where)
    if len(instants) > 1 and np.min(np.diff(instants)) <= 0:
        raise CommandError("DEFI_LIST_INST: the instants must ascend.")
    events = {item.EVENEMENT for item in arguments.ECHEC}
    chosen = {where.METHODE or arguments.METHODE, *(item.ACTION for item in arguments.ECHEC), *events}
    for word, text in _NOTES.items():
        if word in chosen:
            session.note(text)
    return TimeList(instants, _cuts(arguments.ECHEC), "INTERPENETRATION" in events)


def _instants(where: Arguments) -> np.ndarray:
    if [where.given("LIST_INST"), bool(where.VALE), where.given("RESULTAT")].count(True) != 1:
        raise CommandError("DEFI_LIST_INST/DEFI_LIST: expected one of LIST_INST, VALE and RESULTAT.")
    if not where.given("RESULTAT"):
        return where.LIST_INST.values if where.given("LIST_INST") else np.asarray(where.VALE)
    stored = np.asarray(where.RESULTAT.instants())
    if len(stored) < 2 or where.SUBD_PAS < 1:
        raise CommandError("DEFI_LIST_INST/DEFI_LIST: RESULTAT needs two states and SUBD_PAS at least 1.")
    return np.interp(np.arange((len(stored) - 1) * where.SUBD_PAS + 1) / where.SUBD_PAS, np.arange(len(stored)), stored)


def _cuts(items: list[Arguments]) -> Cuts:
    """What is done when a step is not solved. Of several ECHEC that for ERREUR counts."""
    failures = [item for item in items if item.EVENEMENT in _FAILURES and item.ACTION != "CONTINUE"]
    if not failures:
        return Cuts()
    failure = ([item for item in failures if item.EVENEMENT == "ERREUR"] or failures)[-1]
    if failure.ACTION == "ARRET":
        return Cuts(levels=0)
    if failure.SUBD_METHODE == "AUTO":
        # Code_Aster chooses the cut by the course of the residual; here steps are halved.
        return Cuts(parts=2, levels=AUTOMATIC_LEVELS, shortest=failure.SUBD_PAS_MINI)
    if failure.SUBD_PAS < 2:
        raise CommandError(f"DEFI_LIST_INST/ECHEC/SUBD_PAS: expected at least 2, found {failure.SUBD_PAS}.")
    return Cuts(failure.SUBD_PAS, failure.SUBD_NIVEAU, failure.SUBD_PAS_MINI)


COMMANDS = [
    Command("DEFI_LIST_REEL", DEFI_LIST_REEL, defi_list_reel),
    Command("DEFI_LIST_ENTI", DEFI_LIST_ENTI, defi_list_enti),
    Command("DEFI_LIST_INST", DEFI_LIST_INST, defi_list_inst),
]
