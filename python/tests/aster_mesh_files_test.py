# SPDX-License-Identifier: LGPL-3.0-or-later
"""Meshes from files: LIRE_MAILLAGE, PRE_GMSH, PRE_GIBI."""

import numpy as np
import pytest

import rubato
from aster_mesh_cases import SQUARES, Session, call, cell_names, groups, med_of, names, nodes_of, two_squares
from rubato.aster.keys import CommandError


@pytest.fixture
def session(tmp_path):
    return Session(tmp_path)


@pytest.fixture
def squares(session):
    return two_squares(session)


# ---- files ---------------------------------------------------------------------------------------------------


def test_text_files_keep_their_names(squares):
    assert squares.dimension == 2
    assert nodes_of(squares, "K2") == ["B", "C", "F", "E"]
    assert cell_names(squares, "BODY") == ["K1", "K2"]
    assert groups(squares, "CORNERS") == [["F", "A"]]


def test_text_files_that_begin_with_a_comment(session, tmp_path):
    path = tmp_path / "mesh.dat"
    path.write_text("% made by hand\n" + SQUARES)
    session.files[31] = path
    assert call(session, "LIRE_MAILLAGE", FORMAT="ASTER", UNITE=31).mesh.node_count == 6


def test_med_files_without_names_count_by_position(session, tmp_path):
    builder = rubato.MeshBuilder(2)
    for number, place in zip((50, 40, 30, 20, 10), ((0, 0), (1, 0), (1, 1), (0, 1), (2, 0.5))):
        builder.add_node(place, number)
    builder.add_cell("tria3", [1, 4, 2], 7)
    builder.add_cell("quad4", [0, 1, 2, 3], 3)
    builder.add_cell("seg2", [0, 1], 9)
    session.files[20] = med_of(tmp_path, builder.build(), ".20")
    mesh = call(session, "LIRE_MAILLAGE", UNITE=20, VERI_MAIL={"VERIF": "NON"}, INFO_MED=2)
    assert names(mesh, range(5)) == ["N1", "N2", "N3", "N4", "N5"]
    assert nodes_of(mesh, "M1") == ["N1", "N2"]
    assert nodes_of(mesh, "M2") == ["N2", "N5", "N3"]
    assert nodes_of(mesh, "M3") == ["N1", "N2", "N3", "N4"]


def test_med_numbers_cells_by_their_types_in_its_own_order(session, tmp_path):
    builder = rubato.MeshBuilder(2)
    builder.add_nodes(np.array([(0, 0), (1, 0), (1, 1), (0, 1), (3, 0), (5, 0), (4, 2), (4, 0), (4.5, 1), (3.5, 1)]))
    builder.add_cell("tria6", [4, 5, 6, 7, 8, 9])
    builder.add_cell("quad4", [0, 1, 2, 3])
    session.files[20] = med_of(tmp_path, builder.build())
    mesh = call(session, "LIRE_MAILLAGE")
    assert nodes_of(mesh, "M1") == ["N1", "N2", "N3", "N4"]
    assert len(nodes_of(mesh, "M2")) == 6


def test_old_med_files_are_converted(session, squares, tmp_path, monkeypatch):
    h5py = pytest.importorskip("h5py")
    session.files[20] = tmp_path / "old.mmed"
    with h5py.File(session.files[20], "w", libver=("earliest", "v108")) as file:
        group = file.create_group("INFOS_GENERALES")
        for name, value in (("MAJ", 2), ("MIN", 3), ("REL", 6)):
            group.attrs.create(name, value, dtype=np.int32)
    monkeypatch.setenv("PATH", str(tmp_path))
    with pytest.raises(CommandError, match="libmed-tools"):
        call(session, "LIRE_MAILLAGE")
    rubato.write_mesh(tmp_path / "new.med", squares.mesh)
    program = tmp_path / "medimport"
    program.write_text(f"#!/bin/sh\n/bin/cp {tmp_path}/new.med $2\n")
    program.chmod(0o755)
    assert cell_names(call(session, "LIRE_MAILLAGE"), "BODY") == ["K1", "K2"]
    program.write_text("#!/bin/sh\necho it is damaged\n/bin/cp $1 $2\nexit 3\n")
    with pytest.raises(CommandError, match="it is damaged"):
        call(session, "LIRE_MAILLAGE")


def test_unreadable_files(session, tmp_path):
    with pytest.raises(CommandError, match="unit 20"):
        call(session, "LIRE_MAILLAGE")
    session.files[20] = tmp_path / "not there.med"
    with pytest.raises(CommandError, match="cannot be read"):
        call(session, "LIRE_MAILLAGE")
    session.files[20] = tmp_path / "broken.med"
    session.files[20].write_bytes(b"\x89HDF\r\n\x1a\n" + bytes(100))
    with pytest.raises(CommandError, match="LIRE_MAILLAGE"):
        call(session, "LIRE_MAILLAGE")
    with pytest.raises(CommandError, match="IDEAS"):
        call(session, "LIRE_MAILLAGE", FORMAT="IDEAS")


GMSH_1 = """$NOD
5
11 0 0 0
2 1 0 0
3 1 1 0
7 0 1 0
8 5 5 5
$ENDNOD
$ELM
4
1 15 4 1 1 2
3 1 1 1 2 11 2
5 2 2 1 3 11 2 3
9 2 2 1 3 11 3 7
$ENDELM
"""


def test_old_gmsh_files(session, tmp_path):
    session.files[19] = tmp_path / "mesh.msh"
    session.files[19].write_text(GMSH_1)
    call(session, "PRE_GMSH", UNITE_GMSH=19, UNITE_MAILLAGE=20)
    mesh = call(session, "LIRE_MAILLAGE", FORMAT="ASTER", UNITE=20)
    assert (mesh.dimension, mesh.mesh.node_count) == (2, 4)
    assert nodes_of(mesh, "M9") == ["N11", "N3", "N7"]
    assert cell_names(mesh, "GM2") == ["M5", "M9"]
    assert cell_names(mesh, "GM4") == ["M1"]
    assert cell_names(call(session, "LIRE_MAILLAGE", FORMAT="GMSH"), "GM1") == ["M3"]


def test_gmsh_files_of_version_2(session, tmp_path):
    text = GMSH_1.replace("$NOD", "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n1\n2 2 \"inside it\"\n"
                          "$EndPhysicalNames\n$Nodes").replace("$ENDNOD", "$EndNodes")
    text = text.replace("$ELM", "$Elements").replace("$ENDELM", "$EndElements")
    text = text.replace("1 15 4 1 1 2", "1 15 2 4 1 2").replace("3 1 1 1 2 11 2", "3 1 2 1 1 11 2")
    text = text.replace("5 2 2 1 3 ", "5 2 2 2 1 ").replace("9 2 2 1 3 ", "9 2 2 2 1 ")
    session.files[20] = tmp_path / "mesh.msh"
    session.files[20].write_text(text)
    mesh = call(session, "LIRE_MAILLAGE", FORMAT="GMSH")
    assert cell_names(mesh, "inside i") == ["M5", "M9"]
    assert cell_names(mesh, "GM1") == ["M3"]


@pytest.mark.parametrize("old, new, what", [
    ("9 2 2 1 3 11 3 7", "9 2 2 1 3 11 3", "expected 3 nodes"), ("11 3 7", "11 3 6", "no node 6"),
    ("$ENDELM\n", "", "too early"), ("2 1 0 0", "2 1 x 0", "numbers"), ("1 15 4", "1 99 4", "type 99"),
])
def test_faulty_gmsh_files(session, tmp_path, old, new, what):
    session.files[20] = tmp_path / "mesh.msh"
    session.files[20].write_text(GMSH_1.replace(old, new, 1))
    with pytest.raises(CommandError, match=what):
        call(session, "LIRE_MAILLAGE", FORMAT="GMSH")


def ints(*numbers):
    lines = [numbers[i:i + 10] for i in range(0, len(numbers), 10)]
    return "".join("".join(f"{number:8d}" for number in line) + "\n" for line in lines)


def texts(*words):
    return "".join(f" {word:8}" for word in words) + "\n"


def reals(*numbers):
    lines = [numbers[i:i + 3] for i in range(0, len(numbers), 3)]
    return "".join("".join(f"{number:22.14E}" for number in line) + "\n" for line in lines)


def stack(number, named, count):
    return (f" ENREGISTREMENT DE TYPE   2\n PILE NUMERO{number:4d}NBRE OBJETS NOMMES{named:8d}"
            f"NBRE OBJETS{count:8d}\n")


# A quadratic triangle and a quadrangle; the mesh ALL has both, LINE the lower side of the quadrangle.
GIBI = (" ENREGISTREMENT DE TYPE   4\n NIVEAU  15 NIVEAU ERREUR   0 DIMENSION   2\n DENSITE 0.00000E+00\n"
        + " ENREGISTREMENT DE TYPE   7\n NOMBRE INFO CASTEM2000   8\n IFOUR   2\n NSDPGE     0\n"
        + stack(1, 3, 4) + texts("ALL", "LINE", "QUADR") + ints(3, 4, 2)
        + ints(6, 0, 1, 6, 1) + ints(9) + ints(7) + ints(2, 5, 6, 7, 3, 8)
        + ints(8, 0, 0, 4, 1) + ints(0) + ints(1, 2, 3, 4)
        + ints(0, 2, 0, 0, 0) + ints(1, 2)
        + ints(2, 0, 0, 2, 1) + ints(0) + ints(1, 2)
        + stack(32, 1, 8) + texts("P1") + ints(1) + ints(8) + ints(8, 7, 6, 5, 4, 3, 2, 1)
        + stack(33, 0, 8) + ints(24)
        + reals(1, 0.5, 0, 1.5, 1, 0, 2, 1, 0, 1.5, 0.5, 0, 0, 1, 0, 1, 1, 0, 1, 0, 0, 0, 0, 0)
        + " ENREGISTREMENT DE TYPE   5\nLABEL AUTOMATIQUE :   1\n")


def test_dumps_of_cast3m(session, tmp_path):
    session.files[19] = tmp_path / "mesh.mgib"
    session.files[19].write_text(GIBI)
    mesh = call(session, "LIRE_MAILLAGE", FORMAT="GIBI")
    assert mesh.dimension == 2
    assert sorted(mesh.mesh.cell_groups) == ["ALL", "LINE", "QUADR"]
    assert len(mesh.cells_in("ALL")) == 2
    # The place of the coordinates of node 1, and cells by their place in the file.
    assert groups(mesh, "P1") == [["N8"]]
    assert cell_names(mesh, "ALL") == ["M1", "M2"]
    assert cell_names(mesh, "LINE") == ["M3"]
    triangle = mesh.nodes_of_cell(int(np.setdiff1d(mesh.cells_in("ALL"), mesh.cells_in("QUADR"))[0]))
    places = mesh.mesh.points[triangle][:, :2].tolist()
    assert places[:3] == [[1.0, 0.0], [2.0, 1.0], [1.0, 1.0]]
    assert places[3:] == [[1.5, 0.5], [1.5, 1.0], [1.0, 0.5]]
    call(session, "PRE_GIBI")
    assert call(session, "LIRE_MAILLAGE").mesh.cell_count == 3


@pytest.mark.parametrize("length, what", [(300, "early"), (700, "early|no dump"), (60, "early|no dump")])
def test_truncated_dumps(session, tmp_path, length, what):
    session.files[19] = tmp_path / "mesh.mgib"
    session.files[19].write_text(GIBI[:length])
    with pytest.raises(CommandError, match=what):
        call(session, "LIRE_MAILLAGE", FORMAT="GIBI")
