# SPDX-License-Identifier: LGPL-3.0-or-later
"""Functions: DEFI_FONCTION, DEFI_CONSTANTE, DEFI_NAPPE, FORMULE, CALC_FONC_INTERP, CALC_FONCTION, INFO_FONCTION."""

import math
from types import SimpleNamespace

import pytest

from rubato.aster.commands import function_operations, functions
from rubato.aster.concepts import RealList
from rubato.aster.keys import CommandError, check

COMMANDS = {row.name: row for row in (*functions.COMMANDS, *function_operations.COMMANDS)}
SESSION = SimpleNamespace(namespace={"sqrt": math.sqrt, "height": 2.0})


def call(name, **given):
    return COMMANDS[name].run(SESSION, check(COMMANDS[name], given))


def table(*values, **more):
    return call("DEFI_FONCTION", NOM_PARA=more.pop("NOM_PARA", "INST"), VALE=values, **more)


# ---- DEFI_FONCTION -------------------------------------------------------------------------------------------


def test_values_between_places():
    ramp = table(0, 0, 2, 10)
    assert ramp.parameters == ("INST",)
    assert [ramp(0.0), ramp(0.5), ramp(2.0)] == [0.0, 2.5, 10.0]
    assert ramp.Valeurs() == [[0.0, 2.0], [0.0, 10.0]]


def test_extensions():
    with pytest.raises(CommandError, match="outside"):
        table(0, 0, 1, 1)(2.0)
    assert table(0, 3, 1, 4, PROL_GAUCHE="CONSTANT")(-1.0) == 3.0
    assert table(0, 3, 1, 4, PROL_DROITE="LINEAIRE")(3.0) == 6.0


def test_other_forms():
    assert call("DEFI_FONCTION", NOM_PARA="X", ABSCISSE=(0, 1), ORDONNEE=(1, 3))(0.5) == 2.0
    assert call("DEFI_FONCTION", NOM_PARA="X", VALE_PARA=RealList([0, 1]), VALE_FONC=RealList([1, 3]))(0.5) == 2.0
    assert table(1, 3, 0, 1, VERIF="NON")(0.5) == 2.0
    assert table(1, 1, 100, 100, INTERPOL=("LOG", "LOG"))(10.0) == pytest.approx(10.0)
    assert table(1, 0, 100, 2, INTERPOL=("LOG", "LIN"))(10.0) == pytest.approx(1.0)


@pytest.mark.parametrize("given, what", [
    ({"VALE": (0, 1, 2)}, "pairs"), ({"VALE": (1, 0, 0, 0)}, "ascend"), ({"VALE": (0, 0, 0, 1)}, "ascend"),
    ({}, "one of VALE"), ({"ABSCISSE": (0, 1), "ORDONNEE": (1,)}, "expected 2"),
    ({"VALE": (0, 0, 1, 1), "INTERPOL": "LOG"}, "LOG"), ({"VALE": (0, 0, 1, 1), "INTERPOL": "NON"}, "LIN"),
    ({"VALE_C": (0, 0, 0)}, "VALE_C"),
])
def test_faulty_functions(given, what):
    with pytest.raises(CommandError, match=what):
        call("DEFI_FONCTION", NOM_PARA="INST", **given)


def test_constants():
    constant = call("DEFI_CONSTANTE", VALE=3)
    assert constant(1.0) == constant() == 3.0


# ---- DEFI_NAPPE ----------------------------------------------------------------------------------------------


def test_functions_of_two_parameters():
    parts = (dict(VALE=(0, 0, 1, 1)), dict(VALE=(0, 0, 1, 3)))
    surface = call("DEFI_NAPPE", NOM_PARA="TEMP", PARA=(0, 10), NOM_PARA_FONC="X", PROL_DROITE="LINEAIRE",
                   DEFI_FONCTION=parts)
    assert surface.parameters == ("TEMP", "X")
    assert [surface(0, 0.5), surface(10, 1), surface(5, 1), surface(20, 1)] == [0.5, 3.0, 2.0, 5.0]
    with pytest.raises(CommandError, match="TEMP"):
        surface(-1, 0.5)


def test_only_neighbours_are_asked():
    parts = (table(0, 1, 1, 1, NOM_PARA="X"), table(0, 2, 1, 2, NOM_PARA="X"), table(5, 0, 6, 0, NOM_PARA="X"))
    surface = call("DEFI_NAPPE", NOM_PARA="TEMP", PARA=(0, 1, 2), FONCTION=parts)
    assert surface(0.5, 0.5) == 1.5
    with pytest.raises(CommandError, match="as many"):
        call("DEFI_NAPPE", NOM_PARA="TEMP", PARA=(0, 1), FONCTION=parts)


# ---- FORMULE -------------------------------------------------------------------------------------------------


def test_formulas_see_constants_functions_and_the_file():
    inner = call("FORMULE", NOM_PARA="X", VALE="X**2")
    formula = call("FORMULE", NOM_PARA=("X", "Y"), VALE="""
        height * square(X) +
        sqrt(Y) * scale""", square=inner, scale=10.0)
    assert formula(3.0, 4.0) == 38.0
    assert call("FORMULE", NOM_PARA="X, Y", VALE="X - Y")(3, 1) == 2


def test_faulty_formulas():
    with pytest.raises(CommandError, match="FORMULE/VALE"):
        call("FORMULE", NOM_PARA="X", VALE="X +")
    with pytest.raises(CommandError, match="VALE_C"):
        call("FORMULE", NOM_PARA="X", VALE_C="X")
    with pytest.raises(CommandError, match="missing"):
        call("FORMULE", NOM_PARA="X")
    with pytest.raises(CommandError, match="X = 0"):
        call("FORMULE", NOM_PARA="X", VALE="1/X")(0.0)


# ---- CALC_FONC_INTERP ----------------------------------------------------------------------------------------


def test_formulas_become_tables():
    formula = call("FORMULE", NOM_PARA="INST", VALE="INST**2")
    made = call("CALC_FONC_INTERP", FONCTION=formula, VALE_PARA=(2, 0, 1), NOM_RESU="DX", PROL_DROITE="CONSTANT")
    assert made.Valeurs() == [[0.0, 1.0, 2.0], [0.0, 1.0, 4.0]]
    assert (made(1.5), made(3.0), made.parameters, made.result) == (2.5, 4.0, ("INST",), "DX")
    with pytest.raises(CommandError, match="one of"):
        call("CALC_FONC_INTERP", FONCTION=formula)


def test_formulas_of_two_parameters_become_surfaces():
    formula = call("FORMULE", NOM_PARA=("INST", "X"), VALE="INST * X")
    made = call("CALC_FONC_INTERP", FONCTION=formula, LIST_PARA=RealList([0, 2]), NOM_PARA="INST", NOM_PARA_FONC="X",
                VALE_PARA_FONC=(0, 4))
    assert made(1, 2) == 2.0


# ---- CALC_FONCTION -------------------------------------------------------------------------------------------


def test_combinations_take_the_places_of_both():
    first, second = table(0, 0, 2, 2), table(1, 1, 3, 3)
    made = call("CALC_FONCTION", COMB=(dict(FONCTION=first, COEF=2.0), dict(FONCTION=second, COEF=-1.0)))
    assert made.Valeurs() == [[1.0, 2.0], [1.0, 2.0]]
    extended = table(0, 0, 2, 2, PROL_DROITE="CONSTANT")
    made = call("CALC_FONCTION", COMB=(dict(FONCTION=extended, COEF=1.0), dict(FONCTION=second, COEF=1.0)))
    assert made.Valeurs() == [[1.0, 2.0, 3.0], [2.0, 4.0, 5.0]]
    constant = call("DEFI_CONSTANTE", VALE=5)
    made = call("CALC_FONCTION", COMB=(dict(FONCTION=first, COEF=1.0), dict(FONCTION=constant, COEF=1.0)))
    assert (made(0.0), made(2.0)) == (5.0, 7.0)


def test_integral_and_derivative():
    speed = table(0, 0, 1, 2, 3, 2, NOM_RESU="VITE")
    way = call("CALC_FONCTION", INTEGRE=dict(FONCTION=speed, COEF=1.0))
    assert way.Valeurs() == [[0.0, 1.0, 3.0], [1.0, 2.0, 6.0]]
    assert way.result == "DEPL"
    slopes = call("CALC_FONCTION", DERIVE=dict(FONCTION=speed))
    assert slopes.Ordo() == [2.0, pytest.approx(2 / 3), 0.0]
    # x² over uneven steps: exact at every second place.
    square = table(0, 0, 1, 1, 3, 9)
    assert call("CALC_FONCTION", INTEGRE=dict(FONCTION=square, METHODE="SIMPSON")).Ordo()[2] == pytest.approx(9.0)


def test_other_operations():
    slope = table(-1, -2, 1, 2)
    assert call("CALC_FONCTION", ABS=dict(FONCTION=slope)).Ordo() == [2.0, 2.0]
    assert call("CALC_FONCTION", PUISSANCE=dict(FONCTION=slope, EXPOSANT=2)).Ordo() == [4.0, 4.0]
    assert call("CALC_FONCTION", INVERSE=dict(FONCTION=slope)).Valeurs() == [[-2.0, 2.0], [-1.0, 1.0]]
    assert call("CALC_FONCTION", MULT=(dict(FONCTION=slope), dict(FONCTION=slope))).Ordo() == [4.0, 4.0]
    other = table(-1, 1, 1, 1)
    assert call("CALC_FONCTION", ENVELOPPE=dict(FONCTION=(slope, other))).Ordo() == [1.0, 2.0]
    assert call("CALC_FONCTION", ENVELOPPE=dict(FONCTION=(slope, other), CRITERE="INF")).Ordo() == [-2.0, 1.0]
    inner = table(0, -1, 1, 1, NOM_PARA="INST", NOM_RESU="DX")
    outer = table(-1, 10, 1, 20, NOM_PARA="DX")
    composed = call("CALC_FONCTION", COMPOSE=dict(FONC_RESU=outer, FONC_PARA=inner))
    assert (composed.parameters, composed(0.5)) == (("INST",), 15.0)
    joined = call("CALC_FONCTION", ASSE=dict(FONCTION=(table(0, 0, 2, 2), table(1, 5, 3, 5))))
    assert joined.Valeurs() == [[0.0, 1.0, 3.0], [0.0, 5.0, 5.0]]


def test_names_and_places_are_changed():
    slope = table(0, 0, 2, 2)
    made = call("CALC_FONCTION", COMB=dict(FONCTION=slope, COEF=1.0), LIST_PARA=RealList([0, 1, 2]), NOM_PARA="X",
                PROL_DROITE="CONSTANT")
    assert (made.Absc(), made.parameters, made(9.0)) == ([0.0, 1.0, 2.0], ("X",), 2.0)
    with pytest.raises(CommandError, match="one of"):
        call("CALC_FONCTION", NOM_PARA="X")
    with pytest.raises(CommandError, match="COMB_C"):
        call("CALC_FONCTION", COMB_C=dict(FONCTION=slope, COEF_R=1.0))


# ---- INFO_FONCTION -------------------------------------------------------------------------------------------


def test_extrema():
    wave = table(0, 0, 1, 3, 2, -1, 3, 0, NOM_RESU="DX")
    made = call("INFO_FONCTION", MAX=dict(FONCTION=wave))
    assert made.columns == ["FONCTION", "TYPE", "INST", "DX"]
    assert [(row["TYPE"], row["INST"], row["DX"]) for row in made.rows] == [("MINI", 2.0, -1.0), ("MAXI", 1.0, 3.0)]
    made = call("INFO_FONCTION", MAX=dict(FONCTION=wave, INTERVALLE=(0, 0.5)))
    assert [(row["INTERVALLE"], row["DX"]) for row in made.rows] == [(1, 0.0), (1, 1.5)]


def test_means():
    two = table(0, 1, 2, 1)
    assert call("INFO_FONCTION", RMS=dict(FONCTION=two))["RMS", 1] == 1.0
    row = call("INFO_FONCTION", ECART_TYPE=dict(FONCTION=table(0, 1, 1, 1, 2, 3, 3, 3))).rows[0]
    assert row["MOYENNE"] == pytest.approx(2.0)
    surface = call("DEFI_NAPPE", NOM_PARA="TEMP", PARA=(0,), FONCTION=table(0, 2, 4, 2))
    assert call("INFO_FONCTION", NORME=dict(FONCTION=surface))["NORME", 1] == pytest.approx(4.0)
