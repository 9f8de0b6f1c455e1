# SPDX-License-Identifier: LGPL-3.0-or-later
"""Sweeps over processes, long loops, memory."""

import gc
import os
import resource
import subprocess
import sys
import textwrap
from concurrent.futures import ProcessPoolExecutor, ThreadPoolExecutor

import numpy
import pytest
import rubato
import studies


def largest_tip(friction):
    """A variant of a sweep; True for the process that computed it."""
    study = studies.case()
    study.contact[0].friction = friction
    simulation = rubato.Simulation(study)
    tip = simulation.model.dof("Force", "y")
    return max(abs(simulation.state.u[tip]) for _ in simulation), os.getpid()


def test_a_sweep_runs_in_processes():
    frictions = [0.0, 0.1, 0.2, 0.3]
    with ProcessPoolExecutor(2) as pool:
        found = list(pool.map(largest_tip, frictions))
    assert [value for value, _ in found] == [largest_tip(friction)[0] for friction in frictions]
    assert len({round(value, 12) for value, _ in found}) == 4 and os.getpid() not in {process for _, process in found}


def energy_of(study):
    """A study that went to another process."""
    simulation = rubato.Simulation(study)
    for _ in simulation:
        pass
    return simulation.energy.as_dict(), simulation.state.u.copy()


def failing(study):
    study.supports[0].on = "nothing"
    return rubato.Model(study).dof_count


def test_studies_go_to_processes_and_errors_come_back():
    study = studies.blocks()
    with ProcessPoolExecutor(2) as pool:
        energy, u = pool.submit(energy_of, study).result()
        expected = energy_of(study)
        assert energy == expected[0] and numpy.array_equal(u, expected[1])
        with pytest.raises(rubato.InputError) as caught:
            pool.submit(failing, study).result()
    assert caught.value.faults[0].path == "supports.0.on"


def works_beside_another(study, own, other):
    """Makes steps until the other process has made some since this one began; whether it has."""
    simulation = rubato.Simulation(study)
    for _ in range(100_000):
        simulation.advance()
        own.write_text(str(simulation.counters.steps))
        if other.exists() and int(other.read_text() or 0) > 20 and simulation.counters.steps > 20:
            return True
    return False


def long_one():
    study = studies.bar(scheme="newmark", step=1e-3, end=1e3)
    study.mesh.bodies = [studies.box((40, 20))]
    return study


@pytest.mark.skipif(len(os.sched_getaffinity(0)) < 2, reason="needs two processors")
def test_two_processes_work_at_the_same_time(tmp_path):
    one, other = tmp_path / "one", tmp_path / "other"
    with ProcessPoolExecutor(2) as pool:
        found = [pool.submit(works_beside_another, long_one(), *files) for files in ((one, other), (other, one))]
        assert [work.result() for work in found] == [True, True]


def test_threads_advance_simulations_of_their_own():
    expected = energy_of(studies.blocks())[1]
    with ThreadPoolExecutor(4) as pool:
        for _, u in pool.map(energy_of, [studies.blocks() for _ in range(8)]):
            assert numpy.array_equal(u, expected)


LOOP = """
    import resource, sys, time
    sys.path.insert(0, {tests!r})
    import rubato, studies
    from processes_test import resident

    study = studies.bar(**{time})
    study.mesh.bodies = [studies.box((1, 1))]
    simulation = rubato.Simulation(study)
    largest, steps, begin = 0.0, 0, time.monotonic()
    early = None
    while not simulation.finished:
        simulation.advance()
        largest = max(largest, simulation.state.u[0], simulation.state.v.max())
        steps += 1
        if steps == {steps} // 10:
            early = resident()
    print(steps, largest > 0, (resident() - early) / 1e6, time.monotonic() - begin)
"""


def resident():
    """Memory of the process that is in use [bytes]."""
    with open("/proc/self/statm", encoding="ascii") as file:
        return int(file.read().split()[1]) * resource.getpagesize()


@pytest.mark.parametrize(
    "scheme", [{"scheme": "newmark", "step": 1e-3}, {"scheme": "central_difference", "step": 1e-3, "record": 1e-3}]
)
def test_a_million_steps_take_no_memory(scheme):
    steps = 1_000_000
    code = LOOP.format(tests=str(studies.Path(__file__).parent), time=scheme | {"end": steps * 1e-3}, steps=steps)
    done = subprocess.run([sys.executable, "-c", textwrap.dedent(code)], capture_output=True, text=True, check=True)
    made, moves, grown, seconds = done.stdout.split()
    print(scheme["scheme"], made, "steps", seconds, "s", grown, "MB")
    assert int(made) == steps and moves == "True"
    assert float(grown) < 1, "MB between the tenth part of the steps and the end"


def test_studies_models_and_meshes_are_given_back():
    def once():
        study = studies.blocks()
        simulation = rubato.Simulation(study)
        simulation.observe(accepted=lambda step, of=simulation: step.now.u.sum())
        simulation.advance()
        assert simulation.model.mesh.points.shape[1] == 3 and simulation.memento().t > 0
        rubato.load_mesh(study.mesh).with_node_group("a", [1]).quality()
        study.copy().echo()

    def many(times):
        for _ in range(times):
            once()
            gc.collect()  # an observer refers to its simulation
        return resident()

    before = many(50)
    assert many(200) - before < 1e6
