# SPDX-License-Identifier: LGPL-3.0-or-later
"""Runs with a folder of results are those of the program, and are read back."""

import json
import re
import signal
import subprocess
import sys
import textwrap

import numpy
import pytest
import rubato
import studies

DECK = studies.SOURCES / "cases/sdnl140/f.yaml"
CLOCKS = re.compile(r'"(setup_seconds|loop_seconds|elapsed_seconds|seconds)":\s*[0-9.e+-]+')


@pytest.fixture(scope="module")
def folders(tmp_path_factory):
    """(of the program, of Python): the same two runs."""
    program, python = tmp_path_factory.mktemp("program"), tmp_path_factory.mktemp("python")
    subprocess.run(
        [studies.PROGRAM, "run", DECK, "--only", "evol1,evol3", "-o", program, "--quiet"], check=False, capture_output=True
    )
    for study in rubato.load_all(DECK, ["evol1", "evol3"]):
        rubato.run(study, python / study.name)
    return program, python


def without_clocks(path):
    return CLOCKS.sub("", path.read_text(encoding="utf-8"))


@pytest.mark.parametrize("run", ["evol1", "evol3"])
def test_files_are_those_of_the_program_byte_for_byte(folders, run):
    program, python = folders[0] / run, folders[1] / run
    names = {str(path.relative_to(program)) for path in program.rglob("*") if path.is_file()}
    assert names == {str(path.relative_to(python)) for path in python.rglob("*") if path.is_file()}
    for name in sorted(names):
        one, other = program / name, python / name
        if name in ("run.json", "steps.jsonl"):
            assert without_clocks(one) == without_clocks(other), name
        elif name == "fields.med":  # HDF5 has instants of its own
            mine, theirs = (rubato.read_mesh(path) for path in (one, other))
            assert numpy.array_equal(mine.points, theirs.points)
            assert (rubato.compare_fields(program, python, "displacement", 0.006).difference == 0).all()
        elif name != "checkpoint.h5":  # has the seconds spent
            assert one.read_bytes() == other.read_bytes(), name


def test_a_run_is_read_back(folders):
    run = rubato.open_run(folders[1] / "evol1")
    assert (run.name, run.status, run.reason) == ("evol1", "complete", "") and run.zones == ["interface"]
    assert run.study == studies.case() and run.summary["steps"] == 12
    assert run.probes["t"].shape == (13,) and run.probes["tip.y"][1] == pytest.approx(-0.0112465264187, rel=1e-6)
    assert numpy.abs(run.energy["balance"]).max() < 1e-9 * run.energy["external_work"].max()
    simulation = rubato.Simulation(studies.case())
    assert list(run.energy) == ["t", *simulation.energy.as_dict()]
    assert all(getattr(simulation.energy, name) == value for name, value in simulation.energy.as_dict().items())
    assert run.resultants["interface"]["in_contact"].shape == (12,)
    table = run.contact["interface"]
    assert set(table["status"]) <= {"open", "sticks", "slips"} and table["node"][0].startswith("N")
    at_end = table["t"] == 0.012
    total = (table["pressure"] * table["area"])[at_end].sum()
    assert total == pytest.approx(run.resultants["interface"]["normal"][-1], rel=1e-9)
    assert run.steps["accepted"].all() and run.steps["end"][-1] == 0.012 and len(run.attempts) == 12
    with pytest.raises(rubato.InputError):
        rubato.open_run(folders[1])
    assert rubato.run_folders(folders[1]) == [folders[1] / "evol1", folders[1] / "evol3"]


def test_stored_fields_are_read_instant_by_instant(folders):
    run = rubato.open_run(folders[1] / "evol1")
    fields = run.fields
    assert fields.instants.tolist() == [0.001, 0.006, 0.012] and "displacement" in fields.names
    tip = fields.mesh.nodes_named("Force")[0] if "Force" in fields.mesh.group_names() else None
    values = fields.at(0)
    assert values["displacement"].shape[0] == fields.mesh.node_count == 126 and values["von_mises"].shape == (126,)
    assert fields.components("stress") == ["xx", "yy", "zz", "xy", "yz", "xz"]
    assert tip is None or values["displacement"][tip, 1] == pytest.approx(-0.0112465264187, rel=1e-6)
    assert values["displacement"][:, 1].min() == pytest.approx(-0.0112465264187, rel=1e-2)
    with pytest.raises(IndexError):
        fields.at(3)
    with pytest.raises(rubato.InputError, match="did you mean 'stress'"):
        fields.components("stres")


def test_checks_are_those_of_the_program(folders):
    run = rubato.open_run(folders[1] / "evol1")
    checks = run.evaluate_checks()
    assert [check.holds for check in checks] == [True] * 3 and checks[0].quantity == "tip.y"
    printed = subprocess.run(
        [studies.PROGRAM, "check", folders[0] / "evol1"], capture_output=True, text=True, check=False
    ).stdout
    assert rubato.checks_text(checks).strip() in printed


def test_two_runs_are_compared(folders):
    a, b = folders[1] / "evol1", folders[1] / "evol3"
    fields = rubato.compare_fields(a, b, "displacement", 0.001)
    assert fields.difference.shape == (126, 2) and numpy.array_equal(fields.difference, fields.a - fields.b)
    extents = fields.extents("Haut_Contact")
    assert [extent.component for extent in extents] == ["x", "y"]
    nodes = fields.mesh.nodes_named("Haut_Contact")
    assert abs(extents[1].difference) == numpy.abs(fields.difference[nodes, 1]).max()
    (history,) = rubato.compare_histories(a, b, "tip.y")
    one, other = (rubato.open_run(folder).probes["tip.y"] for folder in (a, b))
    assert abs(history.difference) == numpy.abs(one - other).max() and history.instants == 13
    with pytest.raises(rubato.InputError):
        rubato.compare_fields(a, b, "displacement", 0.002)


def test_a_run_tells_of_its_steps(tmp_path):
    told, said = [], []
    result = rubato.run(studies.case(), tmp_path / "a", progress=told.append, say=said.append)
    assert (result.status, result.steps, result.message) == ("complete", 12, "") and result.checks_hold
    assert [entry.t for entry in told][-1] == 0.012 and all(entry.accepted for entry in told) and said
    assert result.state.t == 0.012 and len(result.checks) == 3


def test_what_progress_raises_ends_the_run_with_a_folder_that_can_be_resumed(tmp_path):
    def fail(progress):
        if progress.t > 0.0055:
            raise LookupError("enough")

    study = studies.case()
    with pytest.raises(LookupError, match="enough"):
        rubato.run(study, tmp_path / "a", progress=fail)
    assert rubato.open_run(tmp_path / "a").status == "interrupted"
    seen = []
    result = rubato.run(study, tmp_path / "a", progress=lambda progress: seen.append(progress.t), resume=True)
    assert result.status == "complete" and min(seen) > 0.0055
    rubato.run(study, tmp_path / "b")
    assert (tmp_path / "a/probes.csv").read_bytes() == (tmp_path / "b/probes.csv").read_bytes()


def test_a_function_that_raises_ends_the_run_with_its_name(tmp_path):
    def fails(x, y, z, t):
        if 0.4 < t < 0.6:
            raise ZeroDivisionError("no more")
        return 0.0

    study = studies.bar(scheme="static", step=0.25, end=1)
    study.supports.append(rubato.Support(on="end", components=(rubato.GivenField("mine", fails, True), None)))
    with pytest.raises(rubato.InputError, match=r"the field 'mine' raised ZeroDivisionError \(no more\)"):
        rubato.run(study, tmp_path / "a")
    stored = rubato.open_run(tmp_path / "a")
    assert stored.status == "interrupted" and "the last whole step ends at t = 0.25" in stored.reason


def test_a_run_takes_a_mesh_of_the_program(tmp_path):
    study = studies.bar(scheme="static", step=0.25, end=1)
    study.checkpoint.every = 1
    mesh = rubato.load_mesh(study.mesh)
    rubato.run(study, tmp_path / "named")
    study.mesh = rubato.MeshSource()
    with pytest.raises(rubato.InputError):
        rubato.run(study, tmp_path / "none")

    def fail(progress):
        if progress.t > 0.4:
            raise LookupError

    with pytest.raises(LookupError):
        rubato.run(study, tmp_path / "given", mesh=mesh, progress=fail)
    with pytest.raises(rubato.InputError, match="mesh"):
        rubato.run(study, tmp_path / "given", mesh=mesh.with_points(mesh.points * 1.01), resume=True)
    assert rubato.run(study, tmp_path / "given", mesh=mesh, resume=True).status == "complete"
    assert (tmp_path / "given/probes.csv").read_bytes() == (tmp_path / "named/probes.csv").read_bytes()
    assert rubato.open_run(tmp_path / "given").study.mesh.file.endswith("(mesh of a program)")


def test_a_study_that_cannot_be_run_leaves_no_folder(tmp_path):
    study = studies.case()
    study.supports[0].on = "Encastremnt"
    with pytest.raises(rubato.InputError, match="did you mean 'Encastrement'"):
        rubato.run(study, tmp_path / "a")
    assert not (tmp_path / "a").exists()


def test_a_run_goes_on_from_another_one(tmp_path):
    first = rubato.run(studies.blocks(), tmp_path / "first")
    study = studies.blocks(begin=2, end=3, start="from_run", start_run="blocks")
    study.name = "second"
    result = rubato.run(study, tmp_path / "second", previous=first.state)
    assert result.status == "complete" and result.state.t == 3


INTERRUPTED = """
    import sys
    sys.path.insert(0, {tests!r})
    import rubato, simulation_test
    print("ready", flush=True)
    try:
        rubato.run(simulation_test.large(), {folder!r})
    except KeyboardInterrupt:
        print("caught", rubato.open_run({folder!r}).status)
"""


def test_ctrl_c_ends_a_run_as_it_ends_the_program(tmp_path):
    code = textwrap.dedent(INTERRUPTED.format(tests=str(studies.Path(__file__).parent), folder=str(tmp_path / "a")))
    with subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE, text=True) as process:
        assert process.stdout.readline() == "ready\n"
        while not (tmp_path / "a/run.json").exists():
            assert process.poll() is None
        process.send_signal(signal.SIGINT)
        assert process.stdout.readlines() == ["caught interrupted\n"]


def test_fields_are_written_to_med_files(tmp_path):
    simulation = rubato.Simulation(studies.bar())
    simulation.advance()
    model, state = simulation.model, simulation.state
    path = tmp_path / "a.med"
    rubato.write_med(path, model.mesh, "mine")
    nodal = model.nodal_fields(state, ["displacement", "von_mises"])
    for number, factor in enumerate((1, 2)):
        rubato.write_med_fields(
            path,
            "mine",
            number,
            time=0.1 * number,
            nodal={name: factor * values for name, values in nodal.items()},
            cells=[model.cell_field(state, "stress_elga"), model.cell_field(state, "strain_elno")],
            components={"displacement": ["DX", "DY"]},
        )
    study = studies.bar()
    study.mesh = rubato.MeshSource(file=path)
    field = rubato.FileField(path, "displacement", "DX", 0.1)
    study.supports.append(rubato.Support(on="end", components=(field, None)))
    read = rubato.Simulation(study)
    end = read.model.mesh.nodes_named("end")
    assert numpy.allclose(read.state.displacement(read.model)[end, 0], 2 * nodal["displacement"][end, 0], rtol=1e-12)
    with pytest.raises(ValueError, match="displacement"):
        rubato.write_med_fields(path, "mine", 5, 0.5, nodal={"displacement": nodal["displacement"][:3]})
    with pytest.raises(rubato.InputError):
        rubato.write_med_fields(path, "other", 5, 0.5, nodal={"a": nodal["von_mises"]})


def test_run_json_is_json(folders):
    run = rubato.open_run(folders[1] / "evol3")
    assert run.summary == json.loads((folders[1] / "evol3/run.json").read_text(encoding="utf-8"))
