# SPDX-License-Identifier: LGPL-3.0-or-later
"""Models: numbering, matrices, loads, fields, contact points."""

import numpy
import pytest
import rubato
import studies


def dense(columns, size):
    """The matrix of (data, indices, indptr)."""
    data, rows, starts = columns
    matrix = numpy.zeros((size, size))
    for column in range(size):
        part = slice(starts[column], starts[column + 1])
        matrix[rows[part], column] = data[part]
    return matrix


@pytest.fixture(scope="module")
def model():
    return rubato.Model(studies.bar())


def test_dofs_are_numbered_node_by_node(model):
    assert model.dofs.shape == (15, 2) and model.dofs.dtype == numpy.int32 and model.dof_count == 30
    assert sorted(model.dofs.ravel()) == list(range(30))
    tip = model.mesh.node_groups["tip"][0]
    assert model.dof(int(tip), "y") == model.dofs[tip, 1] == model.dof("tip", 1) == model.dof(tip, rubato.Axis.y)
    with pytest.raises(rubato.InputError, match="group 'held' has 3 nodes, expected one"):
        model.dof("held", 0)
    with pytest.raises(IndexError):
        model.dof(0, 2)


def test_nodes_of_no_cell_have_no_dof():
    mesh = rubato.MeshBuilder(2)
    mesh.append(rubato.generate([studies.box()]))
    lost = mesh.add_node((5, 5))
    model = rubato.Model(studies.bar(), mesh.build())
    assert model.dofs[lost].tolist() == [-1, -1] and model.dof(lost, 0) == -1
    state = rubato.Simulation(model).state
    assert state.displacement(model).shape == (16, 3) and (state.displacement(model)[lost] == 0).all()


def test_matrices_are_those_of_the_bodies(model):
    stiffness, mass = dense(model.stiffness, 30), dense(model.mass, 30)
    assert numpy.allclose(stiffness, stiffness.T) and numpy.allclose(mass, mass.T)
    along = numpy.zeros(30)
    along[model.dofs[:, 0]] = 1
    assert along @ mass @ along == pytest.approx(4), "density times area"
    assert numpy.abs(stiffness @ along).max() < 1e-10, "a rigid motion"
    turn = numpy.zeros(30)
    turn[model.dofs[:, 0]], turn[model.dofs[:, 1]] = -model.mesh.points[:, 1], model.mesh.points[:, 0]
    assert numpy.abs(stiffness @ turn).max() < 1e-10
    for array in model.mass + model.stiffness:
        assert not array.flags.writeable
    assert len(model.damping[0]) == 0 and len(model.lumped_mass) == 0


def test_an_explicit_run_has_a_lumped_mass():
    model = rubato.Model(studies.bar(scheme="central_difference", step=0, record=0.1))
    assert model.lumped_mass.sum() == pytest.approx(2 * 4)


def test_loads_are_nodal_forces(model):
    force = model.external_force(0.3)
    assert force[model.dofs[:, 0]].sum() == pytest.approx(1) and force[model.dofs[:, 1]].sum() == pytest.approx(0.5)


def test_matrices_stay_when_the_model_is_gone():
    model = rubato.Model(studies.bar())
    data = model.mass[0]
    expected = data.copy()
    del model
    filler = [numpy.full(len(data), 3.0) for _ in range(100)]
    assert numpy.array_equal(data, expected)
    del filler


def test_a_mesh_of_the_program_takes_the_place_of_that_of_the_study():
    study = studies.bar()
    mesh = rubato.load_mesh(study.mesh).refined(2)
    assert rubato.Model(study, mesh).mesh.node_count == mesh.node_count == 45
    study.mesh = rubato.MeshSource(groups=[rubato.MadeGroup("corner", "box", from_=(1.9, 0.9), to=(2, 1))])
    with pytest.raises(rubato.InputError, match="mesh.generate: there is no body to mesh"):
        rubato.Model(study)
    model = rubato.Model(study, mesh)
    assert len(model.mesh.node_groups["corner"]) == 1
    assert study.mesh.file == "", "the study of the program stays as it is"


def test_cells_that_run_the_wrong_way_round_are_mended():
    study = studies.bar()
    mesh = rubato.load_mesh(study.mesh)
    nodes = mesh.blocks[1].nodes[:, ::-1]
    builder = rubato.MeshBuilder(2)
    builder.add_nodes(mesh.points)
    builder.add_to_cell_group("box", builder.add_cells("quad4", nodes))
    for name in ("held", "end"):
        builder.add_to_node_group(name, mesh.nodes_named(name))
    builder.add_to_node_group("tip", mesh.nodes_named("tip"))
    study.loads = [rubato.Load(kind="gravity", components=(0, -1))]
    expected = dense(rubato.Model(study).stiffness, 30)
    assert numpy.allclose(dense(rubato.Model(study, builder.build()).stiffness, 30), expected)


def test_faults_against_the_mesh_have_the_paths_of_the_values():
    study = studies.bar()
    study.supports[0].on = "hold"
    with pytest.raises(rubato.InputError, match="did you mean 'held'") as caught:
        rubato.Model(study)
    assert caught.value.faults[0].path == "supports.0.on"


def test_initial_motion_can_be_written():
    model = rubato.Model(studies.bar())
    model.initial_velocity[model.dofs[:, 0]] = model.mesh.points[:, 0]
    model.initial_displacement = numpy.full(30, 0.01)
    state = rubato.Simulation(model).state
    velocity = state.velocity(model)
    assert numpy.array_equal(velocity[:, 0], model.mesh.points[:, 0])
    held = model.mesh.nodes_named("held")
    assert (state.displacement(model)[held] == 0).all() and (velocity[held] == 0).all(), "supports count before it"
    free = numpy.setdiff1d(numpy.arange(15), held)
    assert (state.displacement(model)[free, :2] == 0.01).all()
    with pytest.raises(ValueError, match="one a degree of freedom: 30"):
        model.initial_velocity = [1, 2]


def test_stresses_are_those_of_the_closed_form():
    study = studies.bar(scheme="static", step=1)
    study.materials[0].poisson = 0
    study.loads[0].components = (3, 0)
    simulation = rubato.Simulation(study)
    simulation.advance()
    model, state = simulation.model, simulation.state
    fields = model.nodal_fields(state, ["stress", "von_mises", "strain", "reaction", "internal_force"])
    assert list(fields) == ["stress", "von_mises", "strain", "reaction", "internal_force"]
    assert numpy.allclose(fields["stress"], [3, 0, 0, 0, 0, 0], atol=1e-9) and numpy.allclose(fields["von_mises"], 3)
    assert fields["strain"].shape == (15, 6) and fields["reaction"].sum(axis=0) == pytest.approx([-3, 0])
    assert fields["internal_force"][model.mesh.nodes_named("held")].sum(axis=0) == pytest.approx([-3, 0])
    assert model.field_components("stress") == ["xx", "yy", "zz", "xy", "yz", "xz"]
    field = model.cell_field(state, "stress_elga")
    stress, volumes = field.values["quad4"], field.volumes["quad4"]
    assert stress.shape == (8, 4, 6) and volumes.shape == (8, 4) and field.place == "gauss_points"
    assert volumes.sum() == pytest.approx(2) and numpy.allclose(stress[:, :, 0], 3)
    assert field.means().shape == (8, 6) and numpy.allclose(field.means()[:, 0], 3)
    assert model.cell_field(state, "stress_elno").volumes == {}
    mean = model.cell_field(state, "tresca_elem")
    assert mean.place == "cells" and mean.volumes == {} and mean.components == []
    assert mean.values["quad4"].shape == (8, 1, 1) and numpy.allclose(mean.values["quad4"], 3)
    principal = model.cell_field(state, "principal_stress_elno").values["quad4"]
    assert principal.shape == (8, 4, 3) and numpy.allclose(principal, [3, 0, 0], atol=1e-9)
    assert model.field_components("principal_stress") == ["1", "2", "3"] and model.field_components("tresca") == []
    others = model.nodal_fields(state, ["tresca", "mean_stress", "principal_stress", "cumulated_plastic_strain"])
    assert numpy.allclose(others["tresca"], 3) and numpy.allclose(others["mean_stress"], 1)
    assert others["principal_stress"].shape == (15, 3) and not others["cumulated_plastic_strain"].any()
    assert state.displacement(model)[model.mesh.nodes_named("tip"), 0] == pytest.approx(3 / 100 * 2)


def test_names_of_fields_are_checked(model):
    state = rubato.Simulation(model).state
    with pytest.raises(rubato.InputError, match="'stres'; did you mean 'stress'"):
        model.nodal_fields(state, ["stres"])
    with pytest.raises(rubato.InputError, match="no field 'contact_gap': it has no contact"):
        model.nodal_fields(state, ["contact_gap"])
    with pytest.raises(rubato.InputError, match="no field 'temperature': it has no temperatures"):
        model.nodal_fields(state, ["temperature"])
    with pytest.raises(rubato.InputError, match="'stress'"):
        model.cell_field(state, "stress")
    with pytest.raises(rubato.InputError, match="no field 'temperature_elga': it has no temperatures"):
        model.cell_field(state, "temperature_elga")
    other = rubato.Model(studies.bar(), rubato.load_mesh(studies.bar().mesh).refined(2))
    with pytest.raises(rubato.InputError, match="of another model"):
        other.nodal_fields(state)
    with pytest.raises(rubato.InputError, match="of another model"):
        state.displacement(other)


def test_contact_points_have_nodes_places_and_forces():
    simulation = rubato.Simulation(studies.blocks())
    for _ in simulation:
        pass
    model, state = simulation.model, simulation.state
    points = model.contact_points("pair")
    assert model.zone_names == ["pair"] and set(points) == {"node", "place", "area", "excluded"}
    assert numpy.array_equal(model.mesh.points[points["node"]], points["place"])
    assert points["area"].sum() == pytest.approx(1) and not points["excluded"].any()
    zone = state.zones[0]
    assert len(zone) == len(points["node"]) == 4
    for name, shape in [("gap", (4,)), ("pressure", (4,)), ("slip", (4, 2)), ("normal_force", (4, 3))]:
        assert getattr(zone, name).shape == shape
    sums = model.contact_resultants(state, 0)
    total = (zone.normal_force + zone.tangential_force).sum(axis=0)
    assert sums["force"] == pytest.approx(total)
    assert sums["normal"] == pytest.approx(numpy.linalg.norm(zone.normal_force, axis=1).sum())
    assert sums["friction"] == pytest.approx(0.2 * sums["normal"], rel=1e-4), "it slides"
    assert (zone.status == 2).all() and (zone.cumulated_slip > 0).all() and (zone.friction_work > 0).all()
    assert zone.friction_work.sum() == pytest.approx(simulation.energy.friction)
    held = model.mesh.nodes_named("held")
    reaction = model.nodal_fields(state, ["reaction"])["reaction"]
    assert reaction[held].sum(axis=0) == pytest.approx(total[:2], rel=1e-6)
    with pytest.raises(rubato.InputError, match="'pear'; did you mean 'pair'"):
        model.contact_points("pear")
    with pytest.raises(IndexError):
        model.contact_points(1)
