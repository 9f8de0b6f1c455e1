# SPDX-License-Identifier: LGPL-3.0-or-later
"""Meshes made of meshes: MODI_MAILLAGE, CREA_MAILLAGE, MACR_ADAP_MAIL, ASSE_MAILLAGE, COPIER."""

from types import SimpleNamespace

import numpy as np
import pytest

import rubato
from aster_mesh_cases import COMMANDS, SQUARES, Session, call, cell_names, groups, nodes_of, two_squares
from rubato.aster.catalogue import all_commands
from rubato.aster.concepts import MeshConcept, NodalField
from rubato.aster.keys import CommandError
from rubato.aster.mesh import cells
from rubato.aster.session import Session as RealSession


@pytest.fixture
def session(tmp_path):
    return Session(tmp_path)


@pytest.fixture
def squares(session):
    return two_squares(session)


# ---- MODI_MAILLAGE -------------------------------------------------------------------------------------------


def change(session, mesh, **given):
    return call(session, "MODI_MAILLAGE", reuse=mesh, MAILLAGE=mesh, **given)


def test_skins_are_turned_outwards(session, squares):
    change(session, squares, ORIE_PEAU_2D={"GROUP_MA": ("UPPER", "LEFT")})
    assert [nodes_of(squares, name) for name in ("S1", "S2", "S3")] == [["F", "E"], ["E", "D"], ["D", "A"]]
    assert cell_names(squares, "UPPER") == ["S1", "S2"]
    assert groups(squares, "CORNERS") == [["F", "A"]]


def cube():
    """Two cubes one upon the other, the face between them and the top."""
    points = [(x, y, z) for z in (0, 1, 2) for x, y in ((0, 0), (1, 0), (1, 1), (0, 1))]
    builder = rubato.MeshBuilder(3)
    builder.add_nodes(np.array(points, dtype=float))
    bodies = builder.add_cells("hexa8", np.array([range(8), range(4, 12)]))
    builder.add_to_cell_group("LOW", bodies[:1])
    builder.add_to_cell_group("HIGH", bodies[1:])
    builder.add_to_cell_group("TOP", builder.add_cells("quad4", np.array([[8, 11, 10, 9]])))
    builder.add_to_cell_group("BETWEEN", builder.add_cells("quad4", np.array([[4, 5, 6, 7]])))
    return MeshConcept(builder.build())


def test_skins_in_space(session):
    mesh = cube()
    change(session, mesh, ORIE_PEAU_3D=dict(GROUP_MA=("TOP", "BETWEEN")))
    top, between = int(mesh.cells_in("TOP")[0]), int(mesh.cells_in("BETWEEN")[0])
    assert mesh.nodes_of_cell(top).tolist() == [8, 9, 10, 11]
    assert mesh.nodes_of_cell(between).tolist() == [4, 5, 6, 7]
    change(session, mesh, ORIE_PEAU_3D=dict(GROUP_MA="BETWEEN", GROUP_MA_VOLU="HIGH"))
    assert mesh.nodes_of_cell(between).tolist() == [4, 7, 6, 5]
    change(session, mesh, ORIE_PEAU=dict(GROUP_MA_PEAU="BETWEEN", GROUP_MA_INTERNE="LOW"))
    assert mesh.nodes_of_cell(between).tolist() == [4, 5, 6, 7]


def test_free_surfaces_are_turned_alike(session):
    builder = rubato.MeshBuilder(3)
    builder.add_nodes(np.array([(x, y, 0.1 * x * y) for x in range(4) for y in range(2)]))
    faces = [[0, 2, 3, 1], [2, 3, 5, 4], [4, 6, 7, 5]]
    builder.add_to_cell_group("SHEET", builder.add_cells("quad4", np.array(faces)))
    mesh = MeshConcept(builder.build())
    change(session, mesh, ORIE_NORM_COQUE=dict(GROUP_MA="SHEET", VECT_NORM=(0, 0, -1), NOEUD="N1"))
    assert [mesh.nodes_of_cell(i).tolist() for i in range(3)] == [[0, 1, 3, 2], [2, 3, 5, 4], [4, 5, 7, 6]]
    change(session, mesh, ORIE_NORM_COQUE=dict(GROUP_MA="SHEET", VECT_NORM=(0, 0, 1), NOEUD="N8"))
    assert [mesh.nodes_of_cell(i).tolist() for i in range(3)] == [[0, 2, 3, 1], [2, 4, 5, 3], [4, 6, 7, 5]]
    with pytest.raises(CommandError, match="VECT_NORM"):
        change(session, mesh, ORIE_NORM_COQUE=dict(GROUP_MA="SHEET", VECT_NORM=(0, 0, 1)))


def test_free_lines_are_turned_alike(session, squares):
    change(session, squares, ORIE_NORM_COQUE=dict(GROUP_MA="UPPER", VECT_NORM=(0, -1), NOEUD="F"))
    assert [nodes_of(squares, name) for name in ("S1", "S2")] == [["E", "F"], ["D", "E"]]


def test_points_are_moved(session, squares):
    def place(name):
        return np.round(squares.mesh.points[squares.node_named(name)][:2], 12).tolist()

    field = NodalField(squares, "DEPL_R", ("DX", "DY"), np.full((6, 2), np.nan))
    field.values[squares.node_named("C")] = (0.5, -1.0)
    change(session, squares, DEFORME=dict(OPTION="TRAN", DEPL=field))
    assert (place("A"), place("C")) == ([0.0, 0.0], [2.5, -1.0])
    change(session, squares, TRANSLATION=(1, 1))
    assert place("A") == [1.0, 1.0]
    change(session, squares, ROTATION=dict(POIN_1=(1, 1), ANGLE=90))
    assert place("B") == [1.0, 2.0]
    change(session, squares, ECHELLE=2)
    assert place("B") == [2.0, 4.0]
    change(session, squares, SYMETRIE=dict(POINT=(0, 0), AXE_1=(0, 1)))
    assert place("B") == [-2.0, 4.0]
    # A reflected square runs the other way round, which is mended.
    corners = squares.mesh.points[squares.nodes_of_cell(squares.cell_named("K1"))][:, :2]
    assert np.cross(corners[1] - corners[0], corners[2] - corners[1]) > 0
    before = squares.mesh.points.copy()
    change(session, squares, DEFORME=dict(ALEA=0.01))
    moved = squares.mesh.points - before
    assert 0 < np.max(moved[:, :2]) < 0.01 * np.max(np.ptp(before, axis=0)) + 1e-12
    assert not np.any(moved[:, 2])


def test_rotation_in_space(session):
    mesh = cube()
    change(session, mesh, ROTATION=dict(POIN_1=(0, 0, 0), DIR=(0, 2, 0), ANGLE=90))
    assert np.round(mesh.mesh.points[1], 12).tolist() == [0.0, 0.0, -1.0]
    change(session, mesh, MODI_BASE=dict(VECT_X=(0, 0, -1), VECT_Y=(0, 1, 0)))
    assert np.round(mesh.mesh.points[1], 12).tolist() == [1.0, 0.0, 0.0]
    with pytest.raises(CommandError, match="ORIE_FISSURE"):
        change(session, mesh, ORIE_FISSURE=dict(GROUP_MA="TOP"))


# ---- CREA_MAILLAGE -------------------------------------------------------------------------------------------


def make(session, mesh, **given):
    return call(session, "CREA_MAILLAGE", MAILLAGE=mesh, **given)


def test_orders(session, squares):
    quadratic = make(session, squares, LINE_QUAD=dict(TOUT="OUI", PREF_NOEUD="NS"))
    assert quadratic.mesh.node_count == 6 + 7
    assert nodes_of(quadratic, "K1")[:4] == ["A", "B", "E", "D"]
    half = make(session, quadratic, QUAD_LINE=dict(MAILLE="K1"))
    assert len(nodes_of(half, "K1")) == 4
    assert len(nodes_of(half, "K2")) == 8
    # The middle of AB is gone, those of the edges that others have are not.
    assert half.mesh.node_count == 12
    linear = make(session, quadratic, QUAD_LINE=dict(TOUT="OUI"))
    assert (linear.mesh.node_count, nodes_of(linear, "K2")) == (6, ["B", "C", "F", "E"])
    assert groups(linear, "CORNERS") == [["F", "A"]]
    assert cell_names(linear, "UPPER") == ["S1", "S2"]
    full = make(session, quadratic, MODI_MAILLE=dict(GROUP_MA="BODY", OPTION="QUAD8_9"))
    assert full.mesh.points[full.nodes_of_cell(full.cell_named("K2"))[8]].tolist() == [1.5, 0.5, 0.0]
    assert cell_names(full, "BODY") == ["K1", "K2"]
    with pytest.raises(CommandError, match="whole mesh"):
        make(session, squares, LINE_QUAD=dict(GROUP_MA="BODY"))


def test_centres_in_space(session):
    quadratic = make(session, cube(), LINE_QUAD=dict(TOUT="OUI"))
    whole = make(session, quadratic, HEXA20_27=dict(TOUT="OUI"))
    kinds = {cells.word_of(block): len(block) for block in whole.mesh.blocks}
    assert kinds == {"quad9": 2, "hexa27": 2}
    # 11 faces and 2 bodies.
    assert whole.mesh.node_count == quadratic.mesh.node_count + 13
    hexahedron = whole.mesh.points[whole.nodes_of_cell(int(whole.cells_in("LOW")[0]))]
    assert hexahedron[20:].tolist() == [[0, 0.5, 0.5], [1, 0.5, 0.5], [0.5, 0, 0.5], [0.5, 1, 0.5], [0.5, 0.5, 0],
                                        [0.5, 0.5, 1], [0.5, 0.5, 0.5]]
    assert whole.nodes_of_cell(int(whole.cells_in("BETWEEN")[0]))[8] == whole.nodes_of_cell(
        int(whole.cells_in("LOW")[0]))[25]
    part = make(session, quadratic, HEXA20_27=dict(GROUP_MA="LOW"))
    assert {cells.word_of(block) for block in part.mesh.blocks} == {"quad8", "hexa20", "hexa27"}
    assert whole.mesh.converted("full_quadratic").node_count == whole.mesh.node_count


def test_parts(session, squares):
    part = make(session, squares, RESTREINT=dict(GROUP_MA=("LEFT", "UPPER"), GROUP_NO="CORNERS"))
    assert (part.mesh.node_count, part.mesh.cell_count) == (4, 3)
    assert sorted(part.mesh.cell_groups) == ["LEFT", "UPPER"]
    assert groups(part, "CORNERS") == [["F", "A"]]
    assert nodes_of(part, "S3") == ["A", "D"]
    part = make(session, squares, RESTREINT=dict(MAILLE="K1", TOUT_GROUP_MA="OUI", TOUT_GROUP_NO="OUI"))
    assert cell_names(part, "BODY") == ["K1"]
    assert groups(part, "CORNERS") == [["A"]]


def test_cells_at_nodes(session, squares):
    made = make(session, squares, CREA_POI1=(dict(GROUP_NO="CORNERS", NOM_GROUP_MA="P"),
                                             dict(NOEUD=("A", "B"), NOM_GROUP_MA="Q")))
    assert sorted(cell_names(made, "P")) == ["A", "F"]
    assert sorted(cell_names(made, "Q")) == ["A", "B"]
    assert made.mesh.cell_count == 8
    assert nodes_of(made, "K1") == ["A", "B", "E", "D"]


def test_copies_of_cells(session, squares):
    made = make(session, squares, CREA_MAILLE=dict(NOM="AGAIN", GROUP_MA="UPPER", PREF_MAILLE="Z", PREF_NUME=7))
    assert cell_names(made, "AGAIN") == ["Z7", "Z8"]
    assert nodes_of(made, "Z8") == ["D", "E"]


def test_contact_faces_are_not_split(session, squares):
    made = make(session, squares, DECOUPE_LAC=dict(GROUP_MA_ESCL="UPPER"))
    assert made.mesh.cell_count == 5
    assert "DECOUPE_LAC" in session.notes[0]
    with pytest.raises(CommandError, match="NOT_THERE"):
        make(session, squares, DECOUPE_LAC=dict(GROUP_MA_ESCL="NOT_THERE"))


@pytest.mark.parametrize("given, what", [
    ({}, "one of"), ({"COQU_VOLU": {"NOM": "X"}}, "COQU_VOLU"), ({"ECLA_PG": {}}, "ECLA_PG"),
    ({"QUAD_LINE": {}}, "expected cells"), ({"MODI_MAILLE": {"TOUT": "OUI", "OPTION": "QUAD_TRIA3"}}, "QUAD_TRIA3"),
    ({"CREA_MAILLE": {"NOM": "UPPER", "TOUT": "OUI", "PREF_MAILLE": "Z"}}, "already"),
])
def test_faulty_meshes(session, squares, given, what):
    with pytest.raises(CommandError, match=what):
        make(session, squares, **given)


# ---- others --------------------------------------------------------------------------------------------------


def test_uniform_refinement(session, squares):
    call(session, "MACR_ADAP_MAIL", ADAPTATION="RAFFINEMENT_UNIFORME", MAILLAGE_N=squares,
         MAILLAGE_NP1=SimpleNamespace(name="FINE"), QUALITE="OUI", INFO=1)
    fine = session.made["FINE"]
    assert (fine.mesh.node_count, fine.mesh.cell_count) == (15, 14)
    assert len(fine.cells_in("BODY")) == 8
    assert groups(fine, "CORNERS") == [["F", "A"]]
    assert make(session, squares, RAFFINEMENT=dict(TOUT="OUI", NIVEAU=2)).mesh.cell_count == 2 * 16 + 3 * 4
    with pytest.raises(CommandError, match="RAFF_DERA"):
        call(session, "MACR_ADAP_MAIL", ADAPTATION="RAFF_DERA", MAILLAGE_N=squares,
             MAILLAGE_NP1=SimpleNamespace(name="X"))


def two_bodies(session, cells):
    """A square of 2 × 1 cells, one of 1 × 1 that does not touch it, a skin of each, a free line and a point."""
    sides = {"left": "L", "top": "T"}
    builder = rubato.MeshBuilder(2)
    builder.append(rubato.generate([
        rubato.Body(name=name, dimension=2, from_=(x, 0, 0), to=(x + 1, 1, 0), divisions=(count, 1, 1), cells=cells,
                    sides={key: name + side for key, side in sides.items()}, points={"left_bottom": name + "P"})
        for name, x, count in (("A", 0, 2), ("B", 3, 1))]))
    ends = builder.add_nodes(np.array([[0.0, 9.0, 0.0], [1.0, 9.0, 0.0]]))
    builder.add_to_cell_group("LINE", [builder.add_cell("seg2", [int(end) for end in ends])])
    builder.add_to_cell_group("POINT", [builder.add_cell("point1", [int(ends[0])])])
    return MeshConcept(builder.build())


@pytest.mark.parametrize("cells, area_cells", [("quad4", 1), ("quad8", 1), ("tria3", 2), ("tria6", 2)])
def test_groups_are_refined_with_their_skins_and_the_rest_stays(session, cells, area_cells):
    mesh = two_bodies(session, cells)
    call(session, "MACR_ADAP_MAIL", ADAPTATION="RAFFINEMENT_UNIFORME", MAILLAGE_N=mesh, GROUP_MA=("A", "POINT"),
         MAILLAGE_NP1=SimpleNamespace(name="FINE"))
    fine = session.made["FINE"]
    counts = {name: len(fine.cells_in(name)) for name in ("A", "AL", "AT", "B", "BL", "BT", "LINE", "POINT")}
    assert counts == {"A": 8 * area_cells, "AL": 2, "AT": 4, "B": area_cells, "BL": 1, "BT": 1, "LINE": 1, "POINT": 1}
    assert np.allclose(fine.mesh.points[:mesh.mesh.node_count], mesh.mesh.points)
    assert fine.nodes_in("BP").tolist() == mesh.nodes_in("BP").tolist()
    whole = call(session, "CREA_MAILLAGE", MAILLAGE=two_bodies(session, cells), RAFFINEMENT=dict(TOUT="OUI", NIVEAU=1))
    assert np.sort(fine.mesh.points[fine.nodes_of_cells(fine.cells_in("A"))], axis=0) == pytest.approx(
        np.sort(whole.mesh.points[whole.nodes_of_cells(whole.cells_in("A"))], axis=0))
    # A line that bounds nothing is refined by its name alone.
    call(session, "MACR_ADAP_MAIL", ADAPTATION="RAFFINEMENT_UNIFORME", MAILLAGE_N=mesh, GROUP_MA="LINE",
         MAILLAGE_NP1=SimpleNamespace(name="LINES"))
    assert (len(session.made["LINES"].cells_in("LINE")), len(session.made["LINES"].cells_in("A"))) == (2, 2 * area_cells)


def test_a_part_of_a_body_is_not_refined(session, squares):
    for group in ("UPPER", "LEFT"):
        with pytest.raises(CommandError, match="cell K1 shares edges with cells of"):
            call(session, "MACR_ADAP_MAIL", ADAPTATION="RAFFINEMENT_UNIFORME", MAILLAGE_N=squares, GROUP_MA=group,
                 MAILLAGE_NP1=SimpleNamespace(name="X"))
    call(session, "MACR_ADAP_MAIL", ADAPTATION="RAFFINEMENT_UNIFORME", MAILLAGE_N=squares, GROUP_MA="BODY",
         MAILLAGE_NP1=SimpleNamespace(name="FINE"))
    assert session.made["FINE"].mesh.cell_count == 14


@pytest.mark.parametrize("cells", ["hexa8", "hexa20", "hexa27", "tetra4", "tetra10", "penta6", "penta15"])
def test_a_body_in_space_is_refined_by_its_group(session, cells):
    mesh = MeshConcept(rubato.generate([
        rubato.Body(name=name, dimension=3, from_=(0, 0, z), to=(1, 1, z + 1), divisions=(1, 1, 1), cells=cells,
                    sides={"top": name + "T"}) for name, z in (("A", 0), ("B", 2))]))
    call(session, "MACR_ADAP_MAIL", ADAPTATION="RAFFINEMENT_UNIFORME", MAILLAGE_N=mesh, GROUP_MA="A",
         MAILLAGE_NP1=SimpleNamespace(name="FINE"))
    fine = session.made["FINE"]
    for name, factor in (("A", 8), ("AT", 4), ("B", 1), ("BT", 1)):
        assert len(fine.cells_in(name)) == factor * len(mesh.cells_in(name))


def test_names_of_outputs_become_meshes(tmp_path):
    (tmp_path / "mesh.mail").write_text(SQUARES)
    (tmp_path / "study.comm").write_text("""
meshes = [LIRE_MAILLAGE(FORMAT='ASTER')] + [None] * 2
for i in range(2):
    meshes[i + 1] = CO('FINE%d' % i)
    MACR_ADAP_MAIL(ADAPTATION='RAFFINEMENT_UNIFORME', MAILLAGE_N=meshes[i], MAILLAGE_NP1=meshes[i + 1])
FINE1 = MODI_MAILLAGE(reuse=FINE1, MAILLAGE=FINE1, TRANSLATION=(1., 0.))
""")
    session = RealSession(all_commands(), {20: tmp_path / "mesh.mail"}, tmp_path)
    session.execute(tmp_path / "study.comm")
    last = session.namespace["meshes"][2]
    assert isinstance(last, MeshConcept)
    assert last.mesh.cell_count == 2 * 16 + 3 * 4
    assert session.namespace["FINE1"].name == "FINE1"
    assert np.min(last.mesh.points[:, 0]) == 1.0


def test_two_meshes_in_one(session, squares):
    both = call(session, "ASSE_MAILLAGE", MAILLAGE_1=cube(), MAILLAGE_2=squares, OPERATION="SUPERPOSE")
    assert (both.mesh.node_count, both.mesh.cell_count) == (18, 9)
    with pytest.raises(CommandError, match="both meshes"):
        call(session, "ASSE_MAILLAGE", MAILLAGE_1=squares, MAILLAGE_2=squares, OPERATION="SUPERPOSE")


def test_copies(session, squares):
    made = call(session, "COPIER", CONCEPT=squares)
    change(session, made, TRANSLATION=(1, 0))
    assert (squares.mesh.points[0][0], made.mesh.points[0][0]) == (0.0, 1.0)
    with pytest.raises(CommandError, match="result of a command"):
        call(session, "COPIER", CONCEPT=3)
    assert COMMANDS["DETRUIRE"].harmless
