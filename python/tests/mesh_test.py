# SPDX-License-Identifier: LGPL-3.0-or-later
"""Meshes: views, builders, derived meshes, files."""

import errno
import gc
import resource

import numpy
import pytest
import rubato
import studies


@pytest.fixture
def mesh():
    return rubato.generate([studies.box()])


def test_a_mesh_has_nodes_cells_and_groups(mesh):
    assert (mesh.dimension, mesh.node_count, mesh.cell_count) == (2, 15, 8 + 2 + 2 + 4)
    assert mesh.points.shape == (15, 3) and mesh.points.dtype == numpy.float64
    assert [block.type for block in mesh.blocks] == ["seg2", "quad4"]
    quads = mesh.blocks[1]
    assert quads.nodes.shape == (8, 4) and quads.nodes.dtype == numpy.int32 and len(quads) == 8
    assert quads.first == 8 and mesh.blocks[0].first == 0
    assert set(mesh.cell_groups) == {"box", "held", "end", "top"} and set(mesh.node_groups) == {"tip"}
    assert list(mesh.cell_groups["box"]) == list(range(8, 16))
    assert mesh.points[mesh.node_groups["tip"][0]].tolist() == [2, 1, 0]
    assert mesh.group_names() == ["box", "end", "held", "tip", "top"]
    area = 0
    for corners in mesh.points[quads.nodes]:
        x, y = corners[:, 0], corners[:, 1]
        area += 0.5 * (x @ numpy.roll(y, -1) - y @ numpy.roll(x, -1))
    assert area == pytest.approx(2)


def test_views_are_the_meshs_own_memory_and_cannot_be_written(mesh):
    block = mesh.blocks[1]
    for get in (lambda: mesh.points, lambda: block.nodes, lambda: block.numbers, lambda: mesh.cell_groups["box"]):
        one, other = get(), get()
        assert one.ctypes.data == other.ctypes.data, "no copy"
        with pytest.raises(ValueError, match="read-only"):
            one[0] = 0
        with pytest.raises(ValueError, match="WRITEABLE"):
            one.flags.writeable = True


def test_views_keep_the_mesh_alive():
    mesh = rubato.generate([studies.box((60, 60))])
    points, nodes = mesh.points, mesh.blocks[1].nodes
    groups = mesh.node_groups
    expected, cells = points.copy(), nodes.copy()
    del mesh
    gc.collect()
    filler = [numpy.full(points.shape, 7.0) for _ in range(50)]
    assert numpy.array_equal(points, expected) and numpy.array_equal(nodes, cells) and len(groups["tip"]) == 1
    del filler


def test_a_mesh_is_built_of_nodes_and_cells():
    builder = rubato.MeshBuilder(2)
    nodes = builder.add_nodes([[0, 0], [1, 0], [1, 1], [0, 1]])
    assert nodes.tolist() == [0, 1, 2, 3]
    assert builder.add_node((2, 0), number=90) == 4
    cells = builder.add_cells("tria3", numpy.array([[0, 1, 2], [0, 2, 3]]))
    edge = builder.add_cell("seg2", [1, 4])
    builder.add_to_cell_group("body", cells)
    builder.add_to_cell_group("edge", [edge])
    builder.add_to_node_group("corner", [3, 3])
    mesh = builder.build()
    assert mesh.node_count == 5 and [len(block) for block in mesh.blocks] == [1, 2]
    assert mesh.cell_groups["body"].tolist() == [1, 2] and mesh.cell_groups["edge"].tolist() == [0]
    assert mesh.node_groups["corner"].tolist() == [3] and mesh.nodes_named("N90").tolist() == [4]
    with pytest.raises(RuntimeError, match="is built"):
        builder.add_node((0, 0))


def test_wrong_indices_and_shapes_are_refused_by_the_builder():
    builder = rubato.MeshBuilder(2)
    builder.add_nodes(numpy.zeros((3, 2)))
    with pytest.raises(IndexError, match="index 3 of nodes, expected 0 to 2"):
        builder.add_cell("tria3", [0, 1, 3])
    with pytest.raises(IndexError, match="index -1"):
        builder.add_to_node_group("a", [-1])
    with pytest.raises(ValueError, match="found 2 nodes, expected 3 of a tria3"):
        builder.add_cell("tria3", [0, 1])
    with pytest.raises(TypeError, match="whole numbers"):
        builder.add_cell("tria3", [0.0, 1.0, 2.0])
    with pytest.raises(ValueError, match="cells x 3"):
        builder.add_cells("tria3", numpy.zeros((2, 4), int))
    with pytest.raises(rubato.InputError, match="tria33"):
        builder.add_cell("tria33", [0, 1, 2])
    with pytest.raises(ValueError, match="expected 2 or 3"):
        rubato.MeshBuilder(4)


def test_meshes_are_derived_and_the_first_one_stays_as_it_is(mesh):
    named = mesh.with_node_group("line", [4, 2, 3], ordered=True).with_node_group("set", [4, 2, 3, 2])
    assert named.node_groups["line"].tolist() == [4, 2, 3] and named.node_groups["set"].tolist() == [2, 3, 4]
    with pytest.raises(ValueError, match="without repeats"):
        mesh.with_node_group("line", [1, 1], ordered=True)
    with pytest.raises(IndexError, match="of nodes"):
        mesh.with_node_group("line", [15])
    cells = mesh.with_cell_group("some", mesh.cell_groups["box"][:2]).without_group("box")
    assert cells.cell_groups["some"].tolist() == [8, 9] and "box" not in cells.cell_groups
    with pytest.raises(KeyError):
        mesh.without_group("nothing")
    moved = mesh.with_points(mesh.points * 2)
    assert moved.points.max() == 4 and mesh.points.max() == 2
    with pytest.raises(ValueError, match="one a node"):
        mesh.with_points(mesh.points[:3])
    assert set(mesh.node_groups) == {"tip"} and "box" in mesh.cell_groups
    assert mesh.copy().points.ctypes.data != mesh.points.ctypes.data


def test_meshes_are_refined_and_converted(mesh):
    assert mesh.refined(2).blocks[1].nodes.shape == (32, 4)
    assert mesh.converted("quadratic").blocks[1].type == "quad8"
    assert mesh.converted(rubato.MeshConversion.full_quadratic).blocks[1].type == "quad9"
    with pytest.raises(rubato.InputError):
        mesh.refined(3)
    with pytest.raises(rubato.InputError, match="did you mean 'quadratic'"):
        mesh.converted("quadratik")


def test_groups_are_made(mesh):
    made = mesh.with_groups([rubato.MadeGroup("corner", "box", from_=(1.9, 0.9), to=(2.1, 1.1))])
    assert made.node_groups["corner"].tolist() == mesh.node_groups["tip"].tolist()


def test_the_skin_has_normals_that_point_out(mesh):
    (faces,) = [mesh.skin()["seg2"]]
    nodes, owners = faces
    assert nodes.shape == (12, 2) and owners.shape == (12,)
    middle = mesh.points[mesh.blocks[1].nodes[owners - mesh.blocks[1].first]].mean(axis=1)
    along = mesh.points[nodes[:, 1]] - mesh.points[nodes[:, 0]]
    outward = mesh.points[nodes].mean(axis=1) - middle
    assert ((along[:, 1] * outward[:, 0] - along[:, 0] * outward[:, 1]) > 0).all()


def test_the_report_tells_what_looks_wrong(mesh):
    report = mesh.quality()
    assert report.looks_right() and report.bulk_measure == pytest.approx(2) and report.connected_bodies == 1
    assert [types.type for types in report.types] == ["seg2", "quad4"] and report.types[1].smallest_jacobian == 1
    points = mesh.points.copy()
    points[:, 0] *= -1
    wrong = mesh.with_points(points)
    assert wrong.quality().reversed_cells.count == 8 and wrong.mended().quality().reversed_cells.count == 0
    assert "quad4" in str(report).lower()


@pytest.mark.parametrize("ending", [".med", ".mail"])
def test_files_are_written_and_read(mesh, tmp_path, ending):
    path = tmp_path / f"a{ending}"
    rubato.write_mesh(path, mesh)
    again = rubato.read_mesh(path)
    assert numpy.allclose(again.points, mesh.points) and set(again.group_names()) == set(mesh.group_names())
    assert numpy.array_equal(again.blocks[1].nodes, mesh.blocks[1].nodes)
    for name, cells in mesh.cell_groups.items():
        assert numpy.array_equal(again.cell_groups[name], cells)


def test_files_that_cannot_be_read_or_written_are_told(mesh, tmp_path):
    with pytest.raises(rubato.InputError, match="nothing.med"):
        rubato.read_mesh(tmp_path / "nothing.med")
    with pytest.raises(rubato.InputError):
        rubato.write_mesh(tmp_path / "a.abc", mesh)


def test_a_file_that_cannot_grow_is_an_os_error_and_leaves_nothing(mesh, tmp_path):
    before = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (100, before[1]))
    try:
        with pytest.raises(OSError, match="a.mail") as caught:
            rubato.write_mesh(tmp_path / "a.mail", mesh)
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, before)
    assert caught.value.errno == errno.EFBIG
    assert list(tmp_path.iterdir()) == []


def test_names_of_nodes_are_found_and_told(mesh):
    assert mesh.node_name(0) == "N1" and mesh.nodes_named("N1").tolist() == [0]
    assert mesh.nodes_named("held").tolist() == [0, 5, 10]
    with pytest.raises(rubato.InputError, match="N99"):
        mesh.nodes_named("N99")
    with pytest.raises(IndexError):
        mesh.node_name(15)
