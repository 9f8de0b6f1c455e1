# SPDX-License-Identifier: LGPL-3.0-or-later
"""Groups of nodes and cells: DEFI_GROUP."""

import numpy as np
import pytest

import rubato
from aster_mesh_cases import Session, call, cell_names, groups, two_squares
from rubato.aster.concepts import MeshConcept, NodalField
from rubato.aster.keys import CommandError


@pytest.fixture
def session(tmp_path):
    return Session(tmp_path)


@pytest.fixture
def squares(session):
    return two_squares(session)


# ---- groups of nodes -----------------------------------------------------------------------------------------


def nodes(session, mesh, **given):
    return call(session, "DEFI_GROUP", reuse=mesh, MAILLAGE=mesh, CREA_GROUP_NO=given)


def test_nodes_of_cell_groups(session, squares):
    nodes(session, squares, GROUP_MA=("UPPER", "LEFT"))
    assert groups(squares, "UPPER", "LEFT") == [["D", "E", "F"], ["A", "D"]]
    nodes(session, squares, GROUP_MA="LEFT", NOM="ONE")
    nodes(session, squares, GROUP_MA=("UPPER", "LEFT"), NOM="BOTH")
    assert groups(squares, "ONE", "BOTH") == [["A", "D"], ["D", "E", "F", "A"]]
    nodes(session, squares, TOUT_GROUP_MA="OUI")
    assert len(squares.nodes_in("BODY")) == 6


def test_a_group_that_is_there_stays_for_cell_groups_only(session, squares):
    nodes(session, squares, GROUP_MA="LEFT", NOM="CORNERS")
    assert groups(squares, "CORNERS") == [["F", "A"]]
    assert len(session.notes) == 1
    with pytest.raises(CommandError, match="already"):
        nodes(session, squares, NOEUD="A", NOM="CORNERS")


def test_sets_of_nodes_keep_the_order(session, squares):
    nodes(session, squares, NOEUD=("F", "B", "A"), NOM="S1")
    nodes(session, squares, NOEUD=("C", "A", "F"), NOM="S2")
    nodes(session, squares, UNION=("S1", "S2"), NOM="U")
    nodes(session, squares, INTERSEC=("S1", "S2"), NOM="I")
    nodes(session, squares, DIFFE=("S1", "S2"), NOM="D")
    assert groups(squares, "U", "I", "D") == [["F", "B", "A", "C"], ["F", "A"], ["B"]]
    nodes(session, squares, DIFFE=("S1", "S1"), NOM="NOTHING")
    assert "NOTHING" not in squares.mesh.node_groups
    nodes(session, squares, GROUP_NO="S1", POSITION="FIN", NOM="LAST")
    nodes(session, squares, GROUP_NO="S1", NUME_INIT=2, NUME_FIN=3, NOM="REST")
    assert groups(squares, "LAST", "REST") == [["A"], ["B", "A"]]


def test_nodes_by_place(session, squares):
    nodes(session, squares, OPTION="PLAN", POINT=(0, 1), VECT_NORMALE=(0, 2), PRECISION=0.1, NOM="HIGH")
    nodes(session, squares, OPTION="ENV_SPHERE", NOEUD_CENTRE="A", RAYON=1, PRECISION=1e-6, NOM="ROUND")
    nodes(session, squares, OPTION="PLAN", POINT=(2, 0), ANGL_NAUT=0, PRECISION=0.1, NOM="RIGHT")
    nodes(session, squares, OPTION="SEGM_DROI_ORDO", NOEUD=("A", "C", "B"), NOEUD_ORIG="C", NOEUD_EXTR="A",
          PRECISION=1e-6, CRITERE="RELATIF", NOM="LINE")
    assert groups(squares, "HIGH", "ROUND", "RIGHT", "LINE") == [["D", "E", "F"], ["B", "D"], ["C", "F"],
                                                                  ["C", "B", "A"]]
    with pytest.raises(CommandError, match="beside"):
        nodes(session, squares, OPTION="SEGM_DROI_ORDO", NOEUD=("A", "E"), NOEUD_ORIG="C", NOEUD_EXTR="A",
              PRECISION=1e-6, CRITERE="RELATIF", NOM="BENT")
    with pytest.raises(CommandError, match="in space"):
        nodes(session, squares, OPTION="ENV_CYLINDRE", POINT=(0, 0), VECT_NORMALE=(0, 1), RAYON=1, PRECISION=1, NOM="X")
    with pytest.raises(CommandError, match="TUNNEL"):
        nodes(session, squares, OPTION="TUNNEL", NOM="X")


def test_nodes_by_value(session, squares):
    field = NodalField(squares, "DEPL_R", ("DX",), np.array([[0.0], [1.0], [2.0], [np.nan], [1.0], [5.0]]))
    nodes(session, squares, OPTION="INTERVALLE_VALE", CHAM_GD=field, NOM_CMP="DX", VALE=(0.5, 2.5), NOM="SOME")
    assert groups(squares, "SOME") == [["B", "C", "E"]]


def test_lines_are_put_in_order(session, squares):
    nodes(session, squares, NOEUD="F", NOM="START")
    nodes(session, squares, OPTION="NOEUD_ORDO", GROUP_MA=("UPPER", "LEFT"), GROUP_NO_ORIG="START", NOM="L1")
    nodes(session, squares, OPTION="NOEUD_ORDO", GROUP_MA=("UPPER", "LEFT"), NOEUD_ORIG="A", NOEUD_EXTR="F", NOM="L2")
    # Without an origin: the first end among the first nodes of the segments.
    nodes(session, squares, OPTION="NOEUD_ORDO", GROUP_MA=("UPPER", "LEFT"), NOM="L3")
    assert groups(squares, "L1", "L2", "L3") == [["F", "E", "D", "A"], ["A", "D", "E", "F"], ["F", "E", "D", "A"]]
    with pytest.raises(CommandError, match="no end"):
        nodes(session, squares, OPTION="NOEUD_ORDO", GROUP_MA="UPPER", NOEUD_ORIG="E", NOM="L4")
    with pytest.raises(CommandError, match="QUAD4"):
        nodes(session, squares, OPTION="NOEUD_ORDO", GROUP_MA="BODY", NOM="L4")


def test_middle_nodes_stand_in_the_line(session, squares):
    mesh = call(session, "CREA_MAILLAGE", MAILLAGE=squares, LINE_QUAD={"TOUT": "OUI"})
    nodes(session, mesh, OPTION="NOEUD_ORDO", GROUP_MA="UPPER", NOEUD_ORIG="D", NOM="LINE")
    assert mesh.mesh.points[mesh.nodes_in("LINE")][:, 0].tolist() == [0.0, 0.5, 1.0, 1.5, 2.0]
    nodes(session, mesh, GROUP_MA="UPPER", NOM="ENDS", CRIT_NOEUD="SOMMET")
    nodes(session, mesh, GROUP_MA="UPPER", NOM="MIDDLES", CRIT_NOEUD="MILIEU")
    assert mesh.mesh.points[mesh.nodes_in("ENDS")][:, 0].tolist() == [0.0, 1.0, 2.0]
    assert sorted(mesh.mesh.points[mesh.nodes_in("MIDDLES")][:, 0].tolist()) == [0.5, 1.5]


def test_closed_lines(session):
    builder = rubato.MeshBuilder(2)
    builder.add_nodes(np.array([(0, 0), (1, 0), (1, 1), (0, 1)]))
    builder.add_cells("quad4", np.array([[0, 1, 2, 3]]))
    builder.add_to_cell_group("RING", builder.add_cells("seg2", np.array([[0, 1], [2, 1], [2, 3], [3, 0]])))
    mesh = MeshConcept(builder.build())
    ring = dict(OPTION="NOEUD_ORDO", GROUP_MA="RING")
    nodes(session, mesh, **ring, NOEUD_ORIG="N2", NOEUD_EXTR="N2", VECT_ORIE=(0, 1), NOM="UP")
    nodes(session, mesh, **ring, NOEUD_ORIG="N2", NOEUD_EXTR="N2", VECT_ORIE=(-1, 0), NOM="BACK")
    nodes(session, mesh, **ring, ORIGINE="SANS", NOM="ANY")
    # Groups have a node once.
    assert groups(mesh, "UP", "BACK", "ANY") == [["N2", "N3", "N4", "N1"], ["N2", "N1", "N4", "N3"],
                                                 ["N1", "N2", "N3", "N4"]]
    with pytest.raises(CommandError, match="closed"):
        nodes(session, mesh, **ring, NOM="NONE")


# ---- groups of cells -----------------------------------------------------------------------------------------


def made_cells(session, mesh, **given):
    call(session, "DEFI_GROUP", reuse=mesh, MAILLAGE=mesh, CREA_GROUP_MA=dict(NOM="X", **given))
    made = cell_names(mesh, "X") if "X" in mesh.mesh.cell_groups else []
    if made:
        call(session, "DEFI_GROUP", reuse=mesh, MAILLAGE=mesh, DETR_GROUP_MA=dict(NOM="X"))
    return made


def test_sets_of_cells(session, squares):
    assert made_cells(session, squares, TOUT="OUI", TYPE_MAILLE="2D") == ["K1", "K2"]
    assert made_cells(session, squares, TOUT="OUI", TYPE_MAILLE="SEG2") == ["S1", "S2", "S3"]
    assert made_cells(session, squares, UNION=("UPPER", "LEFT")) == ["S1", "S2", "S3"]
    assert made_cells(session, squares, MAILLE=("S2", "K1")) == ["S2", "K1"]
    assert made_cells(session, squares, GROUP_MA="BODY", NUME_INIT=2) == ["K2"]
    assert made_cells(session, squares, INTERSEC=("UPPER", "LEFT")) == []
    with pytest.raises(CommandError, match="BODDY.*BODY"):
        made_cells(session, squares, UNION=("BODDY", "LEFT"))


def test_cells_by_place(session, squares):
    assert made_cells(session, squares, OPTION="SPHERE", POINT=(2, 0), RAYON=0.5) == ["K2"]
    assert made_cells(session, squares, OPTION="BANDE", POINT=(0, 0), VECT_NORMALE=(1, 0), DIST=0.1,
                      CRIT_NOEUD="TOUS") == ["S3"]
    assert made_cells(session, squares, OPTION="FACE_NORMALE", VECT_NORMALE=(0, 1)) == ["S1"]
    assert made_cells(session, squares, OPTION="FACE_NORMALE", VECT_NORMALE=(0, 1), VERI_SIGNE="NON") == ["S1", "S2"]
    assert made_cells(session, squares, OPTION="APPUI", NOEUD=("D", "E", "A"), TYPE_APPUI="TOUT") == ["S2", "S3"]
    assert made_cells(session, squares, OPTION="APPUI", NOEUD="A", TYPE_APPUI="AU_MOINS_UN") == ["S3", "K1"]
    with pytest.raises(CommandError, match="RAYON"):
        made_cells(session, squares, OPTION="SPHERE", POINT=(2, 0))


def test_deleting_a_group_of_one_kind_leaves_the_other(session, squares):
    nodes(session, squares, NOEUD=("F", "A"), NOM="BODY")
    call(session, "DEFI_GROUP", reuse=squares, MAILLAGE=squares, DETR_GROUP_MA={"NOM": ("BODY", "NOT_THERE")})
    assert groups(squares, "BODY") == [["F", "A"]]
    assert "BODY" not in squares.mesh.cell_groups
    assert "NOT_THERE" in session.notes[0]
