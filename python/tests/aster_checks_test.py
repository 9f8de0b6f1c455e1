# SPDX-License-Identifier: LGPL-3.0-or-later
"""Which comparisons of TEST_* hold and which decide: CheckTable, TEST_TABLE, TEST_FONCTION."""

from types import SimpleNamespace

import pytest

from rubato.aster.checks import CheckTable, Wanted, judge
from rubato.aster.commands.tests import COMMANDS
from rubato.aster.concepts import TableConcept, TableFunction
from rubato.aster.keys import CommandError, check

BY_NAME = {row.name: row for row in COMMANDS}


def rows(value, tolerance=1e-3, **wanted):
    return list(judge("t", value, Wanted(**wanted), tolerance))


def test_a_relative_reference_holds_within_its_precision():
    (row,) = rows(10.009, outside=10.0)
    assert row.holds and row.decides and row.error == pytest.approx(9e-4)
    (row,) = rows(10.011, outside=10.0)
    assert not row.holds


def test_a_reference_of_zero_needs_an_absolute_criterion():
    assert not rows(1e-30, outside=0.0)[0].holds
    assert rows(0.0, outside=0.0)[0].holds
    assert rows(1e-4, outside=0.0, relative=False)[0].holds


def test_the_outside_reference_decides_alone():
    own, outside = rows(10.05, own=10.0, outside=10.1, outside_tolerance=0.01)
    assert own.kind == "NON_REGRESSION" and own.holds is False and not own.decides
    assert outside.holds and outside.decides


def test_an_own_value_alone_decides_with_the_tolerance_of_this_program():
    (row,) = rows(10.005, own=10.0)
    assert row.holds and row.decides and row.tolerance == 1e-3
    assert not rows(10.05, own=10.0)[0].holds
    # A looser tolerance of the file counts.
    assert rows(10.05, own=10.0, own_tolerance=0.01)[0].holds


def test_an_own_value_with_an_absolute_criterion():
    (row,) = rows(1000.5, own=1000.0, relative=False)
    assert row.tolerance == pytest.approx(1.0) and row.holds


def test_an_own_value_of_zero():
    (row,) = rows(3e-9, own=0.0)
    assert row.holds is None and not row.decides
    (row,) = rows(3e-9, own=0.0, magnitude=1e-5)
    assert row.holds and row.tolerance == pytest.approx(1e-8) and not row.relative
    assert not rows(3e-8, own=0.0, magnitude=1e-5)[0].holds


def test_counts_of_iterations_decide_nothing():
    (row,) = rows(7, own=4, comparable=False)
    assert row.holds is False and not row.decides


def test_texts_are_equal_or_not():
    assert rows("N7", own="N7  ")[0].holds
    assert rows("N8", own="N7")[0].holds is False


def test_the_lines_and_the_summary():
    table = CheckTable()
    lines = table.add("U DX", 0.5, Wanted(own=0.5, outside=1.0, source="ANALYTIQUE"), 1e-3)
    assert lines[0].startswith("-OK   NON_REGRESSION   XXXX             0.5")
    assert lines[1].startswith("NOOK  ANALYTIQUE")
    assert lines[1].split()[-2:] == ["50%", "0.1%"]
    table.add("zero", 0.0, Wanted(own=0.0), 1e-3)
    assert not table.hold() and [row.title for row in table.failed()] == ["U DX"]
    summary = table.summary()
    assert summary[3].startswith("SKIP  zero")
    assert summary[-3:] == ["outside references (VALE_REFE): 0 of 1 hold",
                            "Code_Aster's own values that decide nothing: 1 of 1 hold",
                            "not compared, the value is zero without ORDRE_GRANDEUR: 1"]


# ---- commands ----------------------------------------------------------------------------------------------------


def session():
    return SimpleNamespace(checks=CheckTable(), regression_tolerance=1e-3, say=lambda text: None)


def run(name, **given):
    here = session()
    BY_NAME[name].run(here, check(BY_NAME[name], given))
    return here.checks.rows


TABLE = TableConcept(["NOEUD", "INST", "DX", "NUME_ORDRE"], [
    {"NOEUD": "N1", "INST": 0.1, "DX": 1.0, "NUME_ORDRE": 1}, {"NOEUD": "N2", "INST": 0.1, "DX": -3.0, "NUME_ORDRE": 1},
    {"NOEUD": "N1", "INST": 0.2, "DX": 2.0, "NUME_ORDRE": 2}, {"NOEUD": "N3", "INST": 0.2, "NUME_ORDRE": 2}])


def test_a_row_of_a_table():
    (row,) = run("TEST_TABLE", TABLE=TABLE, NOM_PARA="DX", VALE_CALC=2.0, FILTRE=(
        dict(NOM_PARA="INST", VALE=0.20001), dict(NOM_PARA="NOEUD", VALE_K="N1   ")))
    assert row.value == 2.0 and row.holds


def test_a_reduction_of_a_column():
    assert run("TEST_TABLE", TABLE=TABLE, NOM_PARA="DX", TYPE_TEST="SOMM_ABS", VALE_CALC=6.0)[0].holds
    assert run("TEST_TABLE", TABLE=TABLE, NOM_PARA="DX", TYPE_TEST="MIN", VALE_CALC=-3.0)[0].holds


@pytest.mark.parametrize("sign", [1, -1])
def test_vale_abs_compares_absolute_values_of_both_sides(sign):
    own, outside = run("TEST_TABLE", TABLE=TABLE, NOM_PARA="DX", VALE_ABS="OUI", VALE_CALC=sign * 3.0,
                       VALE_REFE=-sign * 3.0, REFERENCE="ANALYTIQUE", FILTRE=dict(NOM_PARA="NOEUD", VALE_K="N2"))
    assert own.value == own.reference == outside.reference == 3.0 and own.holds and outside.holds
    (row,) = run("TEST_TABLE", TABLE=TABLE, NOM_PARA="DX", TYPE_TEST="MIN", VALE_CALC=sign * 3.0)
    assert row.holds == (sign < 0)


def test_vale_abs_of_a_function_and_of_a_text():
    function = TableFunction("INST", [0.0, 2.0], [0.0, -10.0])
    (row,) = run("TEST_FONCTION", VALEUR=dict(FONCTION=function, VALE_PARA=0.5, VALE_CALC=2.5, VALE_ABS="OUI"))
    assert row.holds
    assert run("TEST_TABLE", TABLE=TABLE, NOM_PARA="NOEUD", VALE_CALC_K="N2", VALE_ABS="OUI",
               FILTRE=dict(NOM_PARA="DX", CRIT_COMP="LT", VALE=0.0))[0].holds


def test_one_row_must_remain():
    with pytest.raises(CommandError, match="2 with a value in column DX remain"):
        run("TEST_TABLE", TABLE=TABLE, NOM_PARA="DX", VALE_CALC=2.0, FILTRE=dict(NOM_PARA="NOEUD", VALE_K="N1"))
    with pytest.raises(CommandError, match="no column 'DZ'"):
        run("TEST_TABLE", TABLE=TABLE, NOM_PARA="DZ", VALE_CALC=2.0)


def test_texts_and_whole_numbers_of_a_table():
    filters = (dict(NOM_PARA="INST", VALE=0.1), dict(NOM_PARA="DX", CRIT_COMP="LT", VALE=0.0))
    assert run("TEST_TABLE", TABLE=TABLE, NOM_PARA="NOEUD", VALE_CALC_K="N2", FILTRE=filters)[0].holds
    assert run("TEST_TABLE", TABLE=TABLE, NOM_PARA="NUME_ORDRE", VALE_CALC_I=1, FILTRE=filters)[0].holds


def test_a_reference_needs_its_source():
    with pytest.raises(CommandError, match="needs REFERENCE"):
        run("TEST_TABLE", TABLE=TABLE, NOM_PARA="DX", TYPE_TEST="MAX", VALE_CALC=2.0, VALE_REFE=2.0)


def test_a_function():
    ramp = TableFunction("INST", [0.0, 2.0], [0.0, 10.0])
    own, outside = run("TEST_FONCTION", VALEUR=dict(FONCTION=ramp, NOM_PARA="INST", VALE_PARA=0.5, VALE_CALC=2.5,
                                                    VALE_REFE=2.5, REFERENCE="ANALYTIQUE"))
    assert own.holds and outside.holds
