# SPDX-License-Identifier: LGPL-3.0-or-later
"""fields.frd and tables.dat: as an own reader, CalculiX itself, CalculiX GraphiX and VTK have them."""

import csv
import re
import shutil
import subprocess

import ccx_files
import corpus
import pytest

CELLS = ["tetra4", "tetra10", "penta6", "penta15", "hexa8", "hexa20", "hexa27"]
PLANE = ["tria3", "tria6", "quad4", "quad8", "quad9"]

SOLID = """
mesh: {{generate: [{{name: b, box: {{from: [0, 0, 0], to: [2, 1, 1]}}, divisions: [2, 1, 1], cells: {cells}, sides: {{left: held, right: pulled}}}}]}}
physics: solid
materials: {{steel: {{young: 1000, poisson: 0.3}}}}
supports: [{{on: held, fix: [x, y, z]}}]
loads: [{{surface_force: {{on: pulled, x: 3, z: 1}}}}]
time: {{scheme: static, step: 0.5, end: 1}}
fields: {{formats: [frd, vtu], frd: {numbers}, also: [reaction, strain], digits: 17, every: 1}}
"""
FLAT = """
mesh: {{generate: [{{name: b, rectangle: {{from: [1, 0], to: [3, 1]}}, divisions: [2, 1], cells: {cells}, sides: {{left: held, right: pulled}}}}]}}
physics: plane_strain
materials: {{steel: {{young: 1000, poisson: 0.3}}}}
supports: [{{on: held, fix: [x, y]}}]
loads: [{{surface_force: {{on: pulled, x: 3, y: 1}}}}]
time: {{scheme: static, step: 0.5, end: 1}}
fields: {{formats: [frd, vtu], frd: {numbers}, also: [reaction, strain], digits: 17, every: 1}}
"""


def run(folder, name, text):
    (folder / name).write_text(text)
    code, _, errors = corpus.outcome("run", str(folder / name), "-o", str(folder / "out"))
    assert code == 0, errors
    return folder / "out", errors


def close(a, b, relative=2e-6):
    size = max((abs(x) for row in b for x in row), default=0)
    return all(abs(x - y) <= relative * size + 1e-12 for r, s in zip(a, b, strict=True) for x, y in zip(r, s, strict=True))


@pytest.mark.parametrize("cells", CELLS + PLANE)
def test_binary_and_ascii_hold_the_same(tmp_path, cells):
    files = []
    for numbers in ["ascii", "binary"]:
        (tmp_path / numbers).mkdir()
        deck = (FLAT if cells in PLANE else SOLID).format(cells=cells, numbers=numbers)
        out, _ = run(tmp_path / numbers, "deck.yaml", deck)
        files.append(ccx_files.Frd(out / "run/fields.frd"))
    ascii_file, binary = files
    assert ascii_file.cells == binary.cells and len(binary.cells) >= 2
    assert set(ascii_file.nodes) == set(binary.nodes)
    assert {node for _, nodes in binary.cells.values() for node in nodes} <= set(binary.nodes)
    names = ["DISP", "STRESS", "TOSTRAIN", "FORC"]
    assert [block["name"] for block in ascii_file.blocks] == 2 * names
    assert [block["number"] for block in binary.blocks] == list(range(1, 9))
    assert [block["time"] for block in binary.blocks] == 4 * [0.5] + 4 * [1.0]
    for a, b in zip(ascii_file.blocks, binary.blocks, strict=True):
        assert close(a["values"].values(), b["values"].values(), 1e-5)
    # Forces at the nodes are in equilibrium: those on the held side are the load.
    forces = ascii_file.last("FORC")["values"]
    held = [forces[node] for node, place in ascii_file.nodes.items() if place[0] == min(p[0] for p in ascii_file.nodes.values())]
    wanted = (-3, -1, 0) if cells in PLANE else (-3, 0, -1)
    assert all(abs(sum(row[i] for row in held) - wanted[i]) < 1e-3 for i in range(3))


@pytest.mark.parametrize("cells", ["hexa20", "tria6"])
def test_vtk_has_the_same_values(tmp_path, cells):
    vtk = pytest.importorskip("vtkmodules.vtkIOXML")
    convert = pytest.importorskip("vtkmodules.util.numpy_support").vtk_to_numpy
    out, _ = run(tmp_path, "deck.yaml", (FLAT if cells in PLANE else SOLID).format(cells=cells, numbers="ascii"))
    frd = ccx_files.Frd(out / "run/fields.frd")
    reader = vtk.vtkXMLUnstructuredGridReader()
    reader.SetFileName(str(out / "run/fields/000002.vtu"))
    reader.Update()
    data = reader.GetOutput().GetPointData()
    for name, field in [("DISP", "displacement"), ("STRESS", "stress"), ("TOSTRAIN", "strain")]:
        assert close(list(frd.last(name)["values"].values()), convert(data.GetArray(field)).tolist(), 1e-5), name


@pytest.mark.parametrize("cells", CELLS + PLANE)
@pytest.mark.parametrize("numbers", ["ascii", "binary"])
def test_graphix_opens_them(tmp_path, cells, numbers):
    if shutil.which("cgx") is None:
        pytest.skip("CalculiX GraphiX is not installed (make deps CGX=1)")
    out, _ = run(tmp_path, "deck.yaml", (FLAT if cells in PLANE else SOLID).format(cells=cells, numbers=numbers))
    frd = ccx_files.Frd(out / "run/fields.frd")
    (tmp_path / "look.fbd").write_text("read out/run/fields.frd\nds 5 e 1\nprnt se all\nquit\n")
    seen = subprocess.run(["cgx", "-bg", "look.fbd"], cwd=tmp_path, capture_output=True, text=True, timeout=60).stdout
    assert f"{len(frd.nodes)} nodes, {len(frd.cells)} elements" in re.sub(r"\s+", " ", seen), seen
    shown = dict(re.findall(r"^ +(\d+) (\S+) +\S+ +\S+ +\S+$", seen, re.MULTILINE))
    wanted = frd.last("DISP")["values"]
    assert len(shown) == len(wanted)
    assert all(abs(float(shown[str(node)]) - row[0]) < 1e-5 for node, row in wanted.items())


ELEMENTS = ["c3d4", "c3d5", "c3d6", "c3d8", "c3d8r", "c3d10", "c3d15", "c3d20", "c3d20r", "c3d27", "cps3", "cps4", "cps6", "cps8r", "cpe4", "cpe6", "cax4", "cax8"]


@pytest.mark.parametrize("name", ELEMENTS)
def test_graphix_opens_every_element(tmp_path, name):
    """Files of one element type each, with requests of fields and tables."""
    if shutil.which("cgx") is None:
        pytest.skip("CalculiX GraphiX is not installed (make deps CGX=1)")
    text = (corpus.SOURCES / f"tests/inp/{name}.inp").read_text()
    out, _ = run(tmp_path, "study.inp", text.replace("*END STEP", "*NODE OUTPUT\nU, RF\n*EL PRINT\nS, COORD\n*END STEP", 1))
    frd = ccx_files.Frd(out / "study.frd")
    (tmp_path / "look.fbd").write_text("read out/study.frd\nds 1 e 1\nprnt se all\nquit\n")
    seen = subprocess.run(["cgx", "-bg", "look.fbd"], cwd=tmp_path, capture_output=True, text=True, timeout=60).stdout
    assert f"{len(frd.nodes)} nodes, {len(frd.cells)} elements" in re.sub(r"\s+", " ", seen), seen
    stresses, places = (table[2] for table in ccx_files.tables(out / "study.dat")[:2])
    assert len(stresses) == len(places) and len(stresses) % len(frd.cells) == 0


MESH = {
    "C3D8": "1,0,0,0\n2,1,0,0\n3,1,1,0\n4,0,1,0\n5,0,0,1\n6,1,0,1\n7,1,1.2,1\n8,0,1,1\n"
    "*ELEMENT, TYPE=C3D8, ELSET=EALL\n1,1,2,3,4,5,6,7,8\n*NSET,NSET=BOT\n1,2,3,4\n*NSET,NSET=TOP\n5,6,7,8\n*NSET,NSET=TIP\n7\n*SURFACE,NAME=END\n1,S2\n",
    "C3D4": "1,0,0,0\n2,1,0,0\n3,0,1,0\n5,0,0,1\n7,1,1,1.3\n"
    "*ELEMENT, TYPE=C3D4, ELSET=EALL\n1,1,2,3,5\n2,5,2,3,7\n*NSET,NSET=BOT\n1,2,3\n*NSET,NSET=TOP\n5,7\n*NSET,NSET=TIP\n7\n*SURFACE,NAME=END\n2,S2\n",
    "C3D10": "1,0,0,0\n2,1,0,0\n3,0,1,0\n7,0,0,1\n11,.5,0,0\n12,.5,.5,0\n13,0,.5,0\n14,0,0,.5\n15,.5,0,.5\n16,0,.5,.5\n"
    "*ELEMENT, TYPE=C3D10, ELSET=EALL\n1,1,2,3,7,11,12,13,14,15,16\n*NSET,NSET=BOT\n1,2,3,11,12,13\n*NSET,NSET=TOP\n7,14\n*NSET,NSET=TIP\n7\n*SURFACE,NAME=END\n1,S2\n",
    "C3D15": "1,0,0,0\n2,1,0,0\n3,0,1,0\n4,0,0,1\n5,1,0,1\n7,0,1,1\n11,.5,0,0\n12,.5,.5,0\n13,0,.5,0\n14,.5,0,1\n15,.5,.5,1\n16,0,.5,1\n17,0,0,.5\n18,1,0,.5\n19,0,1,.5\n"
    "*ELEMENT, TYPE=C3D15, ELSET=EALL\n1,1,2,3,4,5,7,11,12,13,14,15,16,17,18,19\n*NSET,NSET=BOT\n1,2,3,11,12,13\n*NSET,NSET=TOP\n4,5,7\n*NSET,NSET=TIP\n7\n*SURFACE,NAME=END\n1,S2\n",
    "C3D20": "1,0,0,0\n2,1,0,0\n3,1,1,0\n4,0,1,0\n5,0,0,1\n6,1,0,1\n7,1,1,1\n8,0,1,1\n9,.5,0,0\n10,1,.5,0\n11,.5,1,0\n12,0,.5,0\n"
    "13,.5,0,1\n14,1,.5,1\n15,.5,1,1\n16,0,.5,1\n17,0,0,.5\n18,1,0,.5\n19,1,1,.5\n20,0,1,.5\n"
    "*ELEMENT, TYPE=C3D20, ELSET=EALL\n1,1,2,3,4,5,6,7,8,9,10,11,12,13,14,15,\n16,17,18,19,20\n"
    "*NSET,NSET=BOT\n1,2,3,4,9,10,11,12\n*NSET,NSET=TOP\n5,6,7,8\n*NSET,NSET=TIP\n7\n*SURFACE,NAME=END\n1,S2\n",
}
STUDY = """*HEADING
Tables and fields beside those of CalculiX
*NODE, NSET=NALL
{mesh}*MATERIAL, NAME=M
*ELASTIC
1000.,0.3
*DENSITY
2.
*SOLID SECTION, ELSET=EALL, MATERIAL=M
*BOUNDARY
BOT,1,3
*STEP
*STATIC, DIRECT
1.,1.
*CLOAD
TOP,3,1.
TIP,1,1.5
*NODE PRINT, NSET=NALL
U, RF
*NODE PRINT, NSET=BOT, TOTALS=YES
RF
*NODE PRINT, NSET=NALL, TOTALS=ONLY, FREQUENCY=2
RF
*EL PRINT, ELSET=EALL
S,E,ME,ENER,COORD
*EL PRINT, ELSET=EALL, TOTALS=YES
ELSE, EVOL
*SECTION PRINT, SURFACE=END, NAME=SP
SOF, SOM, SOAREA
*{nodes}
U, RF
*{cells}
S, E
*END STEP
*STEP
*STATIC, DIRECT
1.,1.
*CLOAD
TIP,1,2.
*NODE PRINT, NSET=TIP
U
*END STEP
"""


def study_of(kind, nodes="NODE FILE", cells="EL FILE"):
    return STUDY.format(mesh=MESH[kind], nodes=nodes, cells=cells)


def ccx(folder, text):
    if shutil.which("ccx") is None:
        pytest.skip("CalculiX is not installed")
    (folder / "ref").mkdir()
    (folder / "ref/study.inp").write_text(text)
    subprocess.run(["ccx", "study"], cwd=folder / "ref", stdout=subprocess.DEVNULL, timeout=60, check=True)
    return folder / "ref"


def rows_of(lines):
    return [[float(word) for word in line.split()] for line in lines]


@pytest.mark.parametrize("kind", MESH)
def test_tables_are_those_of_calculix(tmp_path, kind):
    text = study_of(kind)
    ref = ccx_files.tables(ccx(tmp_path, text) / "study.dat")
    out, _ = run(tmp_path, "study.inp", text)
    own = ccx_files.tables(out / "study.dat")
    assert sorted(heading for heading, _, _ in own) == sorted(heading for heading, _, _ in ref)
    for heading in {heading for heading, _, _ in ref}:
        for mine, theirs in zip([t for t in own if t[0] == heading], [t for t in ref if t[0] == heading], strict=True):
            assert mine[1] == theirs[1]
            assert [ccx_files.layout(line) for line in mine[2]] == [ccx_files.layout(line) for line in theirs[2]], heading
            if "statistics" in heading and kind == "C3D20":
                continue  # 27 points are extrapolated to nodes in another way
            tolerance = 2e-2 if "statistics" in heading else 2e-5
            assert close(rows_of(mine[2]), rows_of(theirs[2]), tolerance), (heading, mine, theirs)


@pytest.mark.parametrize("word", ["FILE", "OUTPUT"])
@pytest.mark.parametrize("kind", MESH)
def test_fields_are_those_of_calculix(tmp_path, kind, word):
    """*NODE FILE in ASCII, *NODE OUTPUT in binary. Only linear cells are extrapolated to nodes in one way."""
    text = study_of(kind, f"NODE {word}", "EL FILE" if word == "FILE" else "ELEMENT OUTPUT")
    ref = ccx_files.Frd(ccx(tmp_path, text) / "study.frd")
    out, _ = run(tmp_path, "study.inp", text)
    own = ccx_files.Frd(out / "study.frd")
    assert own.nodes == ref.nodes and own.cells == ref.cells
    wanted = [block for block in ref.blocks if block["name"] != "ERROR"]
    for mine, theirs in zip(own.blocks, wanted, strict=True):
        for key in ["name", "components", "time", "instant", "increment", "step"]:
            assert mine[key] == theirs[key], key
        tolerance = 1e-4 if mine["name"] in ["DISP", "FORC"] or kind in ["C3D8", "C3D4"] else 0.5
        assert close(list(mine["values"].values()), list(theirs["values"].values()), tolerance), mine["name"]
    assert [block["number"] for block in own.blocks] == list(range(1, len(wanted) + 1))


def test_a_resumed_run_has_the_files_of_a_whole_one(tmp_path):
    deck = SOLID.format(cells="hexa8", numbers="binary").replace("every: 1", "every: 1, tables: [{nodes: pulled, quantities: [U, RF], totals: also}]")
    runs = []
    for name, ends in [("whole", ["1"]), ("resumed", ["0.5", "1"])]:
        (tmp_path / name).mkdir()
        for end in ends:
            (tmp_path / name / "deck.yaml").write_text(deck.replace("end: 1", f"end: {end}"))
            more = ["--resume"] if len(runs) and end == "1" else []
            code, _, errors = corpus.outcome("run", str(tmp_path / name / "deck.yaml"), *more, "-o", str(tmp_path / name / "out"))
            assert code == 0, errors
        folder = tmp_path / name / "out/run"
        frd = ccx_files.Frd(folder / "fields.frd")
        runs.append(((folder / "tables.dat").read_text(), frd.nodes, frd.cells, frd.blocks))
    assert runs[0] == runs[1]
    assert [block["time"] for block in runs[1][3]] == 4 * [0.5] + 4 * [1.0]


def test_probes_are_called_as_sets(tmp_path):
    out, _ = run(tmp_path, "study.inp", study_of("C3D8"))
    with open(out / "step2/probes.csv") as file:
        row = list(csv.DictReader(file))[-1]
    heading, _, rows = [table for table in ccx_files.tables(out / "study.dat") if "displacements" in table[0]][-1]
    assert "set TIP" in heading and len(rows) == 1
    assert close([[float(row[f"TIP_U.{axis}"]) for axis in "xyz"]], [rows_of(rows)[0][1:]])
