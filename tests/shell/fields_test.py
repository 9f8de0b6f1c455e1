# SPDX-License-Identifier: LGPL-3.0-or-later
"""Files of fields as others read them: VTK, meshio and HDF5. Tests are skipped where these are not installed."""

import csv
import xml.etree.ElementTree as xml

import corpus
import pytest

DECK = """
mesh:
  generate:
    - {name: upper, box: {from: [0, 0, 0.1], to: [1, 0.2, 0.2]}, divisions: [6, 2, 2], cells: penta6, sides: {left: held, back: under}, points: {right_top_front: tip}}
    - {name: lower, box: {from: [0, 0, 0], to: [1, 0.2, 0.1]}, divisions: [6, 2, 2], cells: hexa20, sides: {left: held, front: over}}
physics: solid
materials: {steel: {young: 1e6, poisson: 0.3, density: 1000}}
supports: [{on: held, fix: [x, y, z]}]
loads: [{nodal_force: {on: tip, z: -1}}]
contact: {joint: {master: over, slave: under, integration: nodes}}
time: {step: 1e-3, end: 4e-3}
probes:
  tip: {node: tip}
  stress: {node: tip, field: stress}
fields: {formats: [vtu, med, vtkhdf], also: [strain, stress_elga, stress_elno], digits: 17, every: 2}
"""


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    place = tmp_path_factory.mktemp("fields")
    (place / "deck.yaml").write_text(DECK)
    code, _, errors = corpus.outcome("run", str(place / "deck.yaml"), "-q", "-o", str(place / "out"))
    assert code == 0, errors
    return place / "out/run"


def probes(folder):
    with open(folder / "probes.csv") as file:
        return [{key: float(value) for key, value in row.items()} for row in csv.DictReader(file)]


def entries(folder):
    series = xml.parse(folder / "fields.pvd").getroot().iter("DataSet")
    return [(float(entry.get("timestep")), folder / entry.get("file")) for entry in series]


def tip_of(points, member):
    [tip] = [i for i in range(len(points)) if member[i] == 1]
    assert tuple(points[tip]) == (1, 0.2, 0.2)
    return tip


def test_there_are_three_instants(folder):
    assert [time for time, _ in entries(folder)] == [0, 0.002, 0.004]


def test_vtk_reads_them(folder):
    vtk = pytest.importorskip("vtkmodules.vtkIOXML")
    convert = pytest.importorskip("vtkmodules.util.numpy_support").vtk_to_numpy
    rows = probes(folder)
    for number, (_, file) in enumerate(entries(folder)):
        reader = vtk.vtkXMLUnstructuredGridReader()
        reader.SetFileName(str(file))
        reader.Update()
        grid = reader.GetOutput()
        data = grid.GetPointData()
        points = convert(grid.GetPoints().GetData())
        tip = tip_of(points, convert(data.GetArray("group_tip")))
        for axis, name in enumerate("xyz"):
            assert convert(data.GetArray("displacement"))[tip][axis] == rows[2 * number]["tip." + name]
        assert convert(data.GetArray("stress"))[tip][0] == rows[2 * number]["stress.xx"]
        cells = grid.GetCellData()
        assert cells.GetArray("stress_elga").GetNumberOfComponents() == 6
        upper = convert(cells.GetArray("group_upper"))
        assert sorted(set(upper + convert(cells.GetArray("group_lower")))) == [1]
        assert sum(upper) == 48
        assert grid.GetNumberOfCells() == 48 + 24
        bounds = grid.GetCell(0).GetBounds()
        assert bounds[1] > bounds[0]


def test_meshio_reads_them(folder):
    meshio = pytest.importorskip("meshio")
    rows = probes(folder)
    grid = meshio.read(entries(folder)[-1][1])
    assert sorted(block.type for block in grid.cells) == ["hexahedron20", "wedge"]
    tip = tip_of(grid.points, grid.point_data["group_tip"])
    assert list(grid.point_data["displacement"][tip]) == [rows[-1]["tip." + axis] for axis in "xyz"]
    assert sum(int(part.sum()) for part in grid.cell_data["group_lower"]) == 24
    assert grid.point_data["strain"].shape[1] == 6


def test_vtkhdf_has_what_its_description_asks_for(folder):
    h5py = pytest.importorskip("h5py")
    rows = probes(folder)
    with h5py.File(folder / "fields.vtkhdf") as file:
        root = file["VTKHDF"]
        assert list(root.attrs["Version"]) == [2, 0] and root.attrs["Type"] == b"UnstructuredGrid"
        steps = root["Steps"]
        assert steps.attrs["NSteps"] == 3
        assert list(steps["Values"]) == [row["t"] for row in rows[::2]]
        points, cells = int(root["NumberOfPoints"][0]), int(root["NumberOfCells"][0])
        assert root["Points"].shape == (points, 3)
        assert root["Offsets"].shape == (cells + 1,) and root["Types"].shape == (cells,)
        assert root["Offsets"][-1] == root["NumberOfConnectivityIds"][0] == root["Connectivity"].shape[0]
        tip = tip_of(root["Points"][:], root["PointData/group_tip"][:])
        for data, count in (("PointData", points), ("CellData", cells)):
            assert set(root[data]) == set(steps[data + "Offsets"])
            for name, array in root[data].items():
                starts = list(steps[data + "Offsets"][name])
                changes = not name.startswith("group_") and not name.endswith("_number")
                assert starts == ([0, count, 2 * count] if changes else [0, 0, 0]), name
                assert array.shape[0] == (3 * count if changes else count)
        for step in range(3):
            start = steps["PointDataOffsets/displacement"][step]
            assert list(root["PointData/displacement"][start + tip]) == [rows[2 * step]["tip." + a] for a in "xyz"]


def test_med_has_gauss_points_with_their_places(folder):
    h5py = pytest.importorskip("h5py")
    with h5py.File(folder / "fields.med") as file:
        assert set(file["GAUSS"]) == {"gauss_PENTA6", "gauss_HEXA20"}
        field = file["CHA/stress_elga"]
        assert len(field) == 3
        last = field[sorted(field)[-1]]
        assert set(last) == {"MAI.PE6", "MAI.H20"}
        assert set(file["CHA/stress_elno"][sorted(field)[-1]]) == {"NOE.PE6", "NOE.H20"}
