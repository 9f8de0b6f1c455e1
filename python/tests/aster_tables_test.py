# SPDX-License-Identifier: LGPL-3.0-or-later
"""Tables: CREA_TABLE, CALC_TABLE, RECU_TABLE, RECU_FONCTION, IMPR_TABLE, IMPR_FONCTION, POST_RELEVE_T."""

from types import SimpleNamespace

import numpy as np
import pytest

import rubato
from rubato.aster.commands import lines, post_releve, recovery, tables
from rubato.aster.concepts import Formula, MeshConcept, NodalField, Result, Stored, TableConcept, TableFunction
from rubato.aster.keys import CommandError, check

COMMANDS = {row.name: row for module in (lines, post_releve, recovery, tables) for row in module.COMMANDS}


def call(name, **given):
    session = given.pop("session", None)
    return COMMANDS[name].run(session, check(COMMANDS[name], given))


def made(**columns):
    names = list(columns)
    return TableConcept(names, [{name: value for name, value in zip(names, row) if value is not None}
                                for row in zip(*columns.values())])


# ---- making and changing -----------------------------------------------------------------------------------------


def test_lists_make_columns():
    table = call("CREA_TABLE", LISTE=(dict(PARA="H", LISTE_R=(1.0, 0.5)), dict(PARA="N", LISTE_I=(10, 20)),
                                      dict(PARA="NAME", LISTE_K="a", NUME_LIGN=2)))
    assert table.columns == ["H", "N", "NAME"]
    assert table.rows == [{"H": 1.0, "N": 10}, {"H": 0.5, "N": 20, "NAME": "a"}]
    assert table["N", 2] == 20
    assert table.EXTR_TABLE().values()["NAME"] == [None, "a"]
    assert table.EXTR_TABLE().H.values() == [1.0, 0.5]


def test_a_function_makes_a_table():
    table = call("CREA_TABLE", FONCTION=dict(FONCTION=TableFunction("INST", [0, 1], [5, 6]), PARA=("T", "F")))
    assert table.rows == [{"T": 0.0, "F": 5.0}, {"T": 1.0, "F": 6.0}]


def test_a_formula_makes_a_column():
    table = made(A=(1.0, 2.0, None), B=(3.0, 4.0, 5.0))
    formula = Formula(("A", "B"), "A*B", {}, {})
    result = call("CALC_TABLE", TABLE=table, ACTION=dict(OPERATION="OPER", FORMULE=formula, NOM_PARA="AB"))
    assert result.columns == ["A", "B", "AB"]
    assert [row.get("AB") for row in result.rows] == [3.0, 8.0, None]
    assert table.columns == ["A", "B"]


def test_rows_are_chosen_sorted_and_columns_kept_and_named():
    table = made(A=(3.0, 1.0, 2.0, None), B=(30, 10, 20, 0))
    result = call("CALC_TABLE", TABLE=table, ACTION=(
        dict(OPERATION="FILTRE", NOM_PARA="A", CRIT_COMP="GE", VALE=1.5), dict(OPERATION="TRI", NOM_PARA="A"),
        dict(OPERATION="EXTR", NOM_PARA="B"), dict(OPERATION="RENOMME", NOM_PARA=("B", "C"))))
    assert result.columns == ["C"] and [row["C"] for row in result.rows] == [20, 30]


@pytest.mark.parametrize("how, kept", [("VIDE", [0]), ("NON_VIDE", [30, 10, 20]), ("MAXI", [30]), ("MINI", [10]),
                                       ("MAXI_ABS", [30]), ("MINI_ABS", [10])])
def test_filters_without_a_value(how, kept):
    table = made(A=(-3.0, -5.0, 1.0, None), B=(20, 30, 10, 0)) if how.endswith("ABS") else \
        made(A=(3.0, 1.0, 2.0, None), B=(30, 10, 20, 0))
    result = call("CALC_TABLE", TABLE=table, ACTION=dict(OPERATION="FILTRE", NOM_PARA="A", CRIT_COMP=how))
    assert [row["B"] for row in result.rows] == kept


def test_tables_are_joined():
    one, other = made(N=("N1", "N2"), A=(1.0, 2.0)), made(N=("N2", "N3"), B=(5.0, 6.0))
    both = call("CALC_TABLE", TABLE=one, ACTION=dict(OPERATION="COMB", TABLE=other, NOM_PARA="N"))
    assert both.rows == [{"N": "N1", "A": 1.0}, {"N": "N2", "A": 2.0, "B": 5.0}, {"N": "N3", "B": 6.0}]
    common = call("CALC_TABLE", TABLE=one, ACTION=dict(OPERATION="COMB", TABLE=other, NOM_PARA="N", RESTREINT="OUI"))
    assert common.rows == [{"N": "N2", "A": 2.0, "B": 5.0}]


def test_rows_and_columns_are_added_in_place():
    table = made(A=(1.0,))
    result = call("CALC_TABLE", reuse=table, TABLE=table, ACTION=(
        dict(OPERATION="AJOUT_LIGNE", NOM_PARA=("A", "B"), VALE=(2.0, "x")),
        dict(OPERATION="AJOUT_COLONNE", NOM_PARA="C", VALE=7)))
    assert result is table
    assert table.rows == [{"A": 1.0, "C": 7}, {"A": 2.0, "B": "x", "C": 7}]


def test_columns_are_reduced():
    result = call("CALC_TABLE", TABLE=made(A=(1.0, -3.0)), ACTION=dict(OPERATION="CALCUL", NOM_PARA="A",
                                                                      TYPE_CALCUL=("MAXI", "MAXI_ABS", "MOY")))
    assert [(row["TYPE_CALCUL"], row["A"]) for row in result.rows] == [("MAXI", 1.0), ("MAXI_ABS", 3.0), ("MOY", -1.0)]


def test_observations_are_a_table():
    result = Result("EVOL_NOLI", None)
    with pytest.raises(CommandError, match="no observations"):
        call("RECU_TABLE", CO=result, NOM_TABLE="OBSERVATION")
    result.observations = [{"INST": 1.0, "VALE": 2.0, "NOM_CMP": "DX"}]
    table = call("RECU_TABLE", CO=result, NOM_TABLE="OBSERVATION")
    assert table.columns == ["INST", "NOM_CMP", "VALE"] and table["VALE", 1] == 2.0


# ---- functions ---------------------------------------------------------------------------------------------------


def test_a_function_of_two_columns():
    table = made(INST=(2.0, 1.0, 3.0), F=(20.0, 10.0, None), N=("a", "a", "b"))
    function = call("RECU_FONCTION", TABLE=table, PARA_X="INST", PARA_Y="F", PROL_DROITE="CONSTANT",
                    FILTRE=dict(NOM_PARA="N", VALE_K="a"))
    assert function.parameters == ("INST",)
    assert [function(1.5), function(9.0)] == [15.0, 20.0]


# ---- files -------------------------------------------------------------------------------------------------------


def session_with(path):
    return SimpleNamespace(files={}, written=set(), output_of=lambda unit, ending: path, say=print)


def test_a_table_is_written(tmp_path):
    path = tmp_path / "table"
    call("IMPR_TABLE", session=session_with(path), UNITE=30, TABLE=made(N=("N1", "N2"), A=(1.0, None)), TITRE="two")
    assert path.read_text().split("\n")[:4] == ["#two", " N  A", " N1  1.00000E+00", " N2 -"]


def test_a_function_is_written(tmp_path):
    path = tmp_path / "curve"
    call("IMPR_FONCTION", session=session_with(path), UNITE=30, FORMAT="XMGRACE",
         COURBE=dict(FONCTION=TableFunction("INST", [0, 1], [5, 6])))
    assert path.read_text().split("\n")[2].split() == ["0.00000E+00", "5.00000E+00"]


# ---- POST_RELEVE_T -----------------------------------------------------------------------------------------------


def square():
    """Nodes N1 to N4 around a square of side 2, with a line of three sides."""
    builder = rubato.MeshBuilder(2)
    nodes = builder.add_nodes(np.array([[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [0.0, 2.0]]))
    builder.add_cells("quad4", np.array([nodes]))
    mesh = builder.build().with_node_group("LINE", [1, 2, 3], ordered=True)
    return MeshConcept(mesh)


def field_on(mesh, **columns):
    return NodalField(mesh, "DEPL_R", tuple(columns), np.column_stack([np.array(c, float) for c in columns.values()]))


def action(operation, **more):
    return call("POST_RELEVE_T", ACTION=dict(OPERATION=operation, INTITULE="I", **more))


def test_values_along_a_line():
    mesh = square()
    field = field_on(mesh, DX=(1, 2, 3, 4), DY=(0, 0, np.nan, 0))
    table = action("EXTRACTION", CHAM_GD=field, GROUP_NO="LINE", TOUT_CMP="OUI")
    assert table.columns == ["INTITULE", "CHAM_GD", "NOEUD", "ABSC_CURV", "COOR_X", "COOR_Y", "COOR_Z", "DX", "DY"]
    assert [row["NOEUD"] for row in table.rows] == ["N2", "N3", "N4"]
    assert [row["ABSC_CURV"] for row in table.rows] == [0.0, 2.0, 4.0]
    assert "DY" not in table.rows[1] and table["DX", 2] == 3.0


def test_states_and_their_columns():
    mesh = square()
    result = Result("EVOL_NOLI", mesh)
    result.name = "U"
    result.stored = [Stored(k, 0.5 * k, given={"DEPL": field_on(mesh, DX=[k] * 4)}) for k in range(3)]
    table = action("EXTRACTION", RESULTAT=result, NOM_CHAM="DEPL", NOEUD="N1", NOM_CMP="DX", NUME_ORDRE=(1, 2))
    assert table.rows[1] == {"INTITULE": "I", "RESU": "U", "NOM_CHAM": "DEPL", "NUME_ORDRE": 2, "INST": 1.0,
                             "NOEUD": "N1", "ABSC_CURV": 0.0, "COOR_X": 0.0, "COOR_Y": 0.0, "COOR_Z": 0.0, "DX": 2.0}
    assert len(action("EXTRACTION", RESULTAT=result, NOM_CHAM="DEPL", NOEUD="N1", NOM_CMP="DX").rows) == 3
    with pytest.raises(CommandError, match="no state at instant 0.7"):
        action("EXTRACTION", RESULTAT=result, NOM_CHAM="DEPL", NOEUD="N1", NOM_CMP="DX", INST=0.7)


def test_sums_and_moments():
    field = field_on(square(), DX=(0, 1, 1, 1), DY=(0, 0, 0, 5))
    table = action("EXTRACTION", CHAM_GD=field, GROUP_NO="LINE", RESULTANTE=("DX", "DY"))
    assert table.rows == [{"INTITULE": "I", "CHAM_GD": "", "DX": 3.0, "DY": 5.0}]
    table = action("EXTRACTION", CHAM_GD=field, GROUP_NO="LINE", RESULTANTE="DX", MOMENT="DRZ", POINT=(2.0, 0.0))
    # Σ (x − 2) FY − y FX = −2·5 − (0 + 2 + 2)
    assert table.rows[0]["RESULT_X"] == 3.0 and table.rows[0]["MOMENT_Z"] == -14.0


def test_other_axes():
    field = field_on(square(), DX=(1, 1, 1, 1), DY=(0, 0, 0, 0))
    polar = action("EXTRACTION", CHAM_GD=field, NOEUD=("N2", "N3"), TOUT_CMP="OUI", REPERE="POLAIRE")
    assert [polar["DX", 2], polar["DY", 2]] == pytest.approx([0.5**0.5, -(0.5**0.5)])
    # Along the line from N2 up to N3 and left to N4: the tangent is first y, then −x.
    local = action("EXTRACTION", CHAM_GD=field, GROUP_NO="LINE", TOUT_CMP="OUI", REPERE="LOCAL")
    assert [(row["DX"], row["DY"]) for row in local.rows] == [(0.0, -1.0), (-0.5, -0.5), (-1.0, 0.0)]


def test_means():
    field = field_on(square(), DX=(9, 0, 1, 4))
    rows = {row["QUANTITE"]: row["DX"] for row in action("MOYENNE", CHAM_GD=field, GROUP_NO="LINE", NOM_CMP="DX").rows}
    # ∫ = 1 + 5 over a length of 4; ∫ f s = 4/3 + (2·1 + 5·6 + 4·4)/3
    first = (4 / 3 + 48 / 3) / 16
    assert rows["MOMENT_0"] == 1.5
    assert rows["MOMENT_1"] == pytest.approx(12 * first - 6 * 1.5)
    assert rows["MOYE_EXT"] - rows["MOYE_INT"] == pytest.approx(rows["MOMENT_1"])
    assert (rows["MINIMUM"], rows["MAXIMUM"]) == (0.0, 4.0)
    mean = action("MOYENNE_ARITH", CHAM_GD=field, GROUP_NO="LINE", NOM_CMP="DX").rows[0]
    assert (mean["CMP"], mean["MOYENNE"]) == ("DX", pytest.approx(5 / 3))


def test_extremes():
    field = field_on(square(), DX=(9, 0, 1, -4))
    rows = action("EXTREMA", CHAM_GD=field, GROUP_NO="LINE", TOUT_CMP="OUI").rows
    assert [(row["EXTREMA"], row["NOEUD"], row["VALE"]) for row in rows] == [
        ("MAX", "N3", 1.0), ("MIN", "N4", -4.0), ("MAXI_ABS", "N4", 4.0), ("MINI_ABS", "N2", 0.0)]


def test_a_line_through_cells():
    field = field_on(square(), DX=(0, 2, 4, 2))
    table = call("MACR_LIGN_COUPE", CHAM_GD=field, LIGN_COUPE=dict(NB_POINTS=3, COOR_ORIG=(0.0, 1.0),
                                                                  COOR_EXTR=(2.0, 1.0)))
    assert [row["DX"] for row in table.rows] == pytest.approx([1.0, 2.0, 3.0])
    with pytest.raises(CommandError, match="no point of a line"):
        call("MACR_LIGN_COUPE", CHAM_GD=field, LIGN_COUPE=dict(NB_POINTS=2, COOR_ORIG=(5.0, 5.0), COOR_EXTR=(6.0, 5.0)))
