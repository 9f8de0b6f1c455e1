# SPDX-License-Identifier: LGPL-3.0-or-later
"""Lists of numbers and instants: DEFI_LIST_REEL, DEFI_LIST_ENTI, DEFI_LIST_INST."""

from types import SimpleNamespace

import numpy as np
import pytest

from rubato.aster.commands.lists import COMMANDS
from rubato.aster.concepts import Cuts, RealList, Result, Stored
from rubato.aster.keys import CommandError, check


NOTES: list[str] = []


def call(name, **given):
    command = next(row for row in COMMANDS if row.name == name)
    return command.run(SimpleNamespace(note=NOTES.append), check(command, given))


def reals(**given):
    return call("DEFI_LIST_REEL", **given).Valeurs()


def test_values_are_kept():
    assert reals(VALE=(0, 0.5, 2)) == [0.0, 0.5, 2.0]
    assert reals(VALE=3) == [3.0]


def test_a_number_of_steps():
    assert reals(DEBUT=-1, INTERVALLE=(dict(JUSQU_A=0, NOMBRE=1), dict(JUSQU_A=1, NOMBRE=4))) == [
        -1.0, 0.0, 0.25, 0.5, 0.75, 1.0]


def test_steps_are_summed_and_the_end_is_exact():
    values = reals(DEBUT=0.0, INTERVALLE=dict(JUSQU_A=1.0, PAS=0.1))
    assert len(values) == 11
    assert values[3] == 0.1 + 0.1 + 0.1
    assert values[-1] == 1.0


def test_a_last_step_of_another_length():
    assert reals(DEBUT=0.0, INTERVALLE=dict(JUSQU_A=1.0, PAS=0.4)) == [0.0, 0.4, 0.8, 1.0]
    assert reals(DEBUT=0.0, INTERVALLE=dict(JUSQU_A=1.1, PAS=0.5)) == [0.0, 0.5, 1.0, 1.1]
    assert reals(DEBUT=0.0, INTERVALLE=dict(JUSQU_A=1.0001, PAS=0.5)) == [0.0, 0.5, 1.0001]


@pytest.mark.parametrize("given", [
    {}, {"DEBUT": 0.0}, {"VALE": (0, 1), "DEBUT": 0.0, "INTERVALLE": {"JUSQU_A": 1.0, "NOMBRE": 1}},
    {"DEBUT": 0.0, "INTERVALLE": {"JUSQU_A": 1.0}}, {"DEBUT": 0.0, "INTERVALLE": {"JUSQU_A": 1.0, "NOMBRE": 0}},
    {"DEBUT": 0.0, "INTERVALLE": {"JUSQU_A": 1.0, "PAS": -0.1}},
    {"DEBUT": 0.0, "INTERVALLE": {"JUSQU_A": 1.0, "PAS": 2}},
])
def test_faulty_lists(given):
    with pytest.raises(CommandError, match="DEFI_LIST_REEL"):
        reals(**given)


def test_whole_numbers():
    made = call("DEFI_LIST_ENTI", DEBUT=1, INTERVALLE=(dict(JUSQU_A=5, PAS=2), dict(JUSQU_A=11, NOMBRE=2)))
    assert made.Valeurs() == [1.0, 3.0, 5.0, 8.0, 11.0]


def instants(**given):
    return call("DEFI_LIST_INST", **given)


def test_instants_are_cut_as_by_default():
    made = instants(DEFI_LIST=dict(LIST_INST=RealList([0, 1])))
    assert made.Valeurs() == [0.0, 1.0]
    assert made.cuts == Cuts(parts=4, levels=3, shortest=0.0)


def test_cuts():
    where = dict(VALE=(0, 1, 2))
    made = instants(DEFI_LIST=where, ECHEC=dict(SUBD_PAS=10, SUBD_NIVEAU=2, SUBD_PAS_MINI=1e-4))
    assert made.cuts == Cuts(10, 2, 1e-4)
    assert instants(DEFI_LIST=where, ECHEC=dict(EVENEMENT="ERREUR", ACTION="ARRET")).cuts.levels == 0
    automatic = instants(DEFI_LIST=where, ECHEC=dict(SUBD_METHODE="AUTO", SUBD_PAS_MINI=0.1)).cuts
    assert (automatic.parts, automatic.shortest) == (2, 0.1)
    several = (dict(EVENEMENT="ERREUR", SUBD_PAS=5), dict(EVENEMENT="DIVE_RESI"))
    assert instants(DEFI_LIST=where, ECHEC=several).cuts.parts == 5


@pytest.mark.parametrize("echec, cuts, bounds", [
    (dict(EVENEMENT="COLLISION", SUBD_METHODE="AUTO", SUBD_INST=1e-3, SUBD_DUREE=0.1), Cuts(), False),
    (dict(EVENEMENT="INTERPENETRATION", PENE_MAXI=1e-6, ACTION="ADAPT_COEF_PENA", COEF_MAXI=1e9), Cuts(), True),
    ((dict(EVENEMENT="ERREUR", SUBD_PAS=2), dict(EVENEMENT="COLLISION")), Cuts(parts=2), False),
    (dict(EVENEMENT="RESI_MAXI", RESI_GLOB_MAXI=1e5, ACTION="CONTINUE"), Cuts(), False),
    (dict(ACTION="ITER_SUPPL", PCENT_ITER_PLUS=30), Cuts(), False),
])
def test_events(echec, cuts, bounds):
    NOTES.clear()
    made = instants(DEFI_LIST=dict(VALE=(0, 1, 2), METHODE="AUTO", PAS_MINI=1e-6, NB_PAS_MAXI=99), METHODE="AUTO",
                    ECHEC=echec, ADAPTATION=dict(EVENEMENT="SEUIL"))
    assert made.Valeurs() == [0.0, 1.0, 2.0]
    assert (made.cuts, made.bounds_penetration) == (cuts, bounds)
    assert "METHODE='AUTO' is solved as MANUEL" in NOTES[0]
    assert any("INTERPENETRATION" in note for note in NOTES) == bounds


def test_instants_of_a_result_are_divided():
    result = Result("EVOL_NOLI", None)
    result.stored = [Stored(0, 0.0), Stored(1, 1.0), Stored(2, 3.0)]
    assert instants(DEFI_LIST=dict(RESULTAT=result, SUBD_PAS=2)).Valeurs() == [0.0, 0.5, 1.0, 2.0, 3.0]
    with pytest.raises(CommandError, match="two states"):
        instants(DEFI_LIST=dict(RESULTAT=Result("EVOL_NOLI", None)))


@pytest.mark.parametrize("given, what", [
    ({"DEFI_LIST": {"VALE": (0, 1)}, "ECHEC": {"EVENEMENT": "DELTA_GRANDEUR"}}, "DELTA_GRANDEUR"),
    ({"DEFI_LIST": {"VALE": (0, 1), "LIST_INST": RealList([0, 1])}}, "one of LIST_INST"),
    ({"DEFI_LIST": {"VALE": (1, 0)}}, "ascend"), ({"DEFI_LIST": {}}, "LIST_INST"), ({}, "DEFI_LIST"),
    ({"DEFI_LIST": {"VALE": (0, 1)}, "ECHEC": {"SUBD_PAS": 1}}, "at least 2"),
])
def test_faulty_instants(given, what):
    with pytest.raises(CommandError, match=what):
        instants(**given)


def test_arrays_are_lists():
    assert reals(VALE=np.linspace(0, 1, 3)) == [0.0, 0.5, 1.0]
