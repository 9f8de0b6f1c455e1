# SPDX-License-Identifier: LGPL-3.0-or-later
"""Simulations: steps, states, callbacks, exceptions, signals, threads."""

import gc
import subprocess
import sys
import textwrap
import threading
import time
import weakref

import numpy
import pytest
import rubato
import studies


def numbers_of(state):
    return [state.u, state.v, state.a, state.contact_force, state.external_force, state.reaction]


def test_steps_are_those_of_the_program():
    simulation = rubato.Simulation(studies.case())
    for step in simulation:
        assert step.accepted and step.verdict == "accepted" and step.report == ""
        if simulation.t == pytest.approx(0.001):
            tip = simulation.state.displacement(simulation.model)[simulation.model.mesh.nodes_named("Force")]
            assert tip[0, 1] == pytest.approx(-0.0112465264187, rel=1e-6)
    assert simulation.finished and simulation.next is None and simulation.t == simulation.end == 0.012
    assert simulation.counters.steps == 12 and simulation.state.t == 0.012
    assert abs(simulation.energy.balance) < 1e-9 * simulation.energy.external_work
    with pytest.raises(RuntimeError, match="finished"):
        simulation.advance()
    assert list(simulation) == []


def test_a_state_stays_what_it_is_whatever_steps_follow():
    simulation = rubato.Simulation(studies.blocks(scheme="hht", alpha=-0.1, step=0.01, end=2))
    kept = []
    while not simulation.finished:
        state = simulation.state
        arrays = numbers_of(state) + [state.zones[0].multipliers, state.zones[0].status]
        kept.append((state.t, arrays, [array.copy() for array in arrays]))
        assert simulation.advance().accepted
    assert len(kept) == 200
    del simulation, state
    gc.collect()
    filler = [numpy.full(len(kept[0][1][0]), 9.0) for _ in range(1000)]
    for t, arrays, copies in kept:
        assert t >= 0
        for array, copy in zip(arrays, copies):
            assert numpy.array_equal(array, copy), t
    assert any((one[1][0] != other[1][0]).any() for one, other in zip(kept, kept[1:])), "they are different states"
    del filler


def test_states_are_not_copied_and_cannot_be_written():
    simulation = rubato.Simulation(studies.bar())
    assert simulation.state is simulation.state
    assert simulation.state.u.ctypes.data == simulation.state.u.ctypes.data
    with pytest.raises(ValueError, match="read-only"):
        simulation.state.u[0] = 1
    before = simulation.state
    simulation.advance()
    assert simulation.state is not before and before.t == 0 and simulation.state.t > 0


def test_held_states_change_no_bit_of_what_follows():
    def end(keeps):
        simulation = rubato.Simulation(studies.blocks(scheme="hht", alpha=-0.1, step=0.02, end=1))
        kept = [simulation.state]
        for _ in simulation:
            kept = kept + [simulation.state] if keeps else []
        return simulation.state.u.copy()

    assert numpy.array_equal(end(True), end(False))


def test_supports_that_end_and_locked_preloads_leave_states_alone():
    study = studies.bar(step=0.1)
    study.supports.append(rubato.Support(on="end", components=(0.1, None), until=0.5))
    simulation = rubato.Simulation(study)
    seen = []
    for _ in simulation:
        state = simulation.state
        seen.append((state.a, state.a.copy(), state.reaction, state.reaction.copy()))
    for a, a_then, reaction, reaction_then in seen:
        assert numpy.array_equal(a, a_then) and numpy.array_equal(reaction, reaction_then)


def test_supports_rotate_their_groups():
    study = studies.bar(step=0.1)
    study.loads = []
    spin = rubato.Rotation(about=(0, 0), angle=rubato.Field(0.04, given="velocity"))
    study.supports = [rubato.Support(on="held", rotate=spin)]
    study.probes = [rubato.Probe(name="drive", node="held", field="reaction", take="sum", about=(0, 0))]
    simulation = rubato.Simulation(study)
    assert simulation.state.v.min() == pytest.approx(-0.04)  # along x, of the upper corner
    for _ in simulation:
        pass
    places, dofs = simulation.model.mesh.points, simulation.model.dofs
    held = numpy.flatnonzero(places[:, 0] == 0)
    assert simulation.state.u[dofs[held, 0]] == pytest.approx(-numpy.sin(0.04) * places[held, 1])
    assert simulation.state.u[dofs[held, 1]] == pytest.approx((numpy.cos(0.04) - 1) * places[held, 1])
    spin.angle = 0.06
    with pytest.raises(rubato.InputError, match="at most 0.05 radians"):
        rubato.Model(study)


def test_only_pressures_follow_their_faces():
    study = studies.bar()
    study.loads[0].follower = True
    with pytest.raises(rubato.InputError, match="a surface_force that follows the faces, expected 'pressure'"):
        study.validate()


def test_a_preload_that_is_locked_leaves_states_alone():
    study = studies.bar(scheme="static", step=0.25, end=1)
    study.loads = []
    cut = rubato.Cut(point=(1, 0.5), normal=(1, 0))
    study.preload = [rubato.Preload("bolt", cut, True, rubato.Amplitude(1, "tighten"), lock=0.5)]
    study.supports.append(rubato.Support(on="end", components=(0, 0)))
    study.functions["tighten"] = ([0, 0.5], [0, 1])
    simulation = rubato.Simulation(study)
    seen = []
    for _ in simulation:
        seen.append((simulation.state, [array.copy() for array in numbers_of(simulation.state)]))
    for state, copies in seen:
        assert all(numpy.array_equal(one, other) for one, other in zip(numbers_of(state), copies))
    assert len(seen) == 4 and numpy.abs(seen[1][0].u).max() > 1e-4


def test_a_callback_is_told_where_a_step_stands_and_may_end_it():
    simulation = rubato.Simulation(studies.blocks())
    told = []
    step = simulation.advance(told.append)
    assert step.accepted and len(told) >= 1 and told[0].attempt.end == 0.25
    assert [where.iterations for where in told] == sorted(where.iterations for where in told)
    before = simulation.state
    step = simulation.advance(lambda where: False)
    assert step.verdict == "interrupted" and not step.accepted and step.report == ""
    assert simulation.state is before and simulation.t == 0.25
    assert simulation.advance().accepted


def test_what_a_callback_raises_leaves_the_simulation_as_it_was():
    whole = rubato.Simulation(studies.blocks())
    ends = [whole.state.u.copy() for _ in whole]
    simulation = rubato.Simulation(studies.blocks())

    def fail(where):
        if where.iterations >= 1:
            raise LookupError("enough")

    for expected in ends[:4]:
        before = simulation.state
        with pytest.raises(LookupError, match="enough"):
            simulation.advance(fail)
        assert simulation.state is before
        simulation.advance()
        assert numpy.array_equal(simulation.state.u, expected)


def test_an_explicit_simulation_goes_back_too():
    study = studies.bar(scheme="central_difference", step=0, record=5, end=10)
    whole = rubato.Simulation(study)
    for _ in whole:
        pass
    simulation = rubato.Simulation(study)
    calls = []

    def fail(where):
        calls.append(where)
        raise LookupError("enough")

    with pytest.raises(LookupError):
        simulation.advance(fail)
    assert calls and simulation.t == 0
    for _ in simulation:
        pass
    assert numpy.array_equal(simulation.state.u, whole.state.u)


def test_an_explicit_simulation_keeps_relations():
    study = studies.bar(scheme="central_difference", step=0, record=0.5, end=1)
    study.relations = [rubato.Relation(name="flat", kind="equal", on="end")]
    model = rubato.Model(study)
    simulation = rubato.Simulation(model)
    for _ in simulation:
        pass
    x = model.mesh.points[:, 0]
    moved = simulation.state.u.reshape(-1, 2)[x == x.max()]
    assert len(moved) > 1 and abs(moved).min() > 0
    assert numpy.ptp(moved, axis=0).max() < 1e-14


def test_a_step_that_fails_says_why():
    study = studies.blocks()
    study.newton.max_iterations = 1
    study.time.cut_levels = 1
    simulation = rubato.Simulation(study)
    cut = simulation.attempt()
    assert cut.verdict == "cut" and "no convergence from t = 0 to 0.25" in cut.report
    step = simulation.advance()
    assert step.verdict == "not_converged" and "no convergence from t = 0 to 0.125" in step.report and step.attempt.cut_level == 1
    with pytest.raises(rubato.StepError, match="no convergence") as caught:
        for _ in simulation:
            pass
    assert caught.value.step.verdict == "not_converged"


def test_observers_are_told_before_a_step_counts():
    simulation = rubato.Simulation(studies.blocks())
    told, late = [], []

    def accepted(step):
        assert step.before is simulation.state and step.before.t == step.attempt.begin == simulation.t
        assert step.now.t == step.attempt.end
        told.append((step.attempt.end, step.now.u.copy(), step.energy.strain, step.last))
        late.append(step)

    simulation.observe(accepted=accepted)
    ends = [(simulation.t, simulation.state.u.copy()) for _ in simulation]
    assert [entry[0] for entry in told] == [t for t, _ in ends]
    assert all(numpy.array_equal(entry[1], u) for entry, (_, u) in zip(told, ends))
    assert [entry[3] for entry in told] == [False] * (len(told) - 1) + [True]
    with pytest.raises(RuntimeError, match="while the observer is told"):
        late[0].now


def test_when_an_observer_raises_all_that_were_told_take_back():
    simulation = rubato.Simulation(studies.blocks())
    taken, fails = [], [True]

    def refuse(step):
        if fails:
            raise OSError("disk full")

    simulation.observe(accepted=lambda step: None, take_back=lambda state: taken.append(("first", state.t)))
    simulation.observe(accepted=refuse, take_back=lambda state: taken.append(("second", state.t)))
    with pytest.raises(OSError, match="disk full"):
        simulation.advance()
    assert taken == [("second", 0.0), ("first", 0.0)] and simulation.t == 0
    fails.clear()
    assert simulation.advance().accepted and len(taken) == 2


def test_rejected_attempts_are_told():
    study = studies.blocks()
    study.newton.max_iterations = 1
    study.time.cut_levels = 1
    simulation = rubato.Simulation(study)
    told = []
    simulation.observe(rejected=lambda step: told.append((step.last, step.report != "", step.energy)))
    simulation.advance()
    assert told == [(False, True, None), (True, True, None)]


def test_a_simulation_that_its_observers_refer_to_is_collected():
    class Witness:
        pass

    witness = Witness()
    gone = weakref.ref(witness)
    simulation = rubato.Simulation(studies.bar())
    simulation.observe(accepted=lambda step, of=simulation, other=witness: None)
    simulation.advance()
    del simulation, witness
    gc.collect()
    assert gone() is None


def test_a_memento_brings_a_simulation_back_to_the_same_bits():
    simulation = rubato.Simulation(studies.blocks(scheme="hht", alpha=-0.1, step=0.02, end=1))
    for _ in range(20):
        simulation.advance()
    memento = simulation.memento()
    for _ in simulation:
        pass
    expected = simulation.state.u.copy()
    other = rubato.Simulation(simulation.model, memento=memento)
    assert other.t == memento.t == pytest.approx(0.4) and other.counters == memento.counters
    simulation.restore(memento)
    for again in (simulation, other):
        for _ in again:
            pass
        assert numpy.array_equal(again.state.u, expected)
    with pytest.raises(rubato.InputError):
        rubato.Simulation(studies.bar()).restore(memento)


def test_a_run_begins_at_the_end_of_another_one():
    first = rubato.Simulation(studies.blocks())
    for _ in first:
        pass
    study = studies.blocks(begin=2, end=3, start="from_run", start_run="blocks")
    study.name = "second"
    with pytest.raises(ValueError, match="needs the end of that run"):
        rubato.Simulation(study)
    second = rubato.Simulation(study, previous=first.state)
    assert numpy.array_equal(second.state.u, first.state.u) and second.t == 2


def test_what_is_called_within_a_step_may_look_but_not_step():
    simulation = rubato.Simulation(studies.blocks())
    with pytest.raises(RuntimeError, match="is being advanced"):
        simulation.advance(lambda where: simulation.advance() and None)
    with pytest.raises(RuntimeError, match="is being advanced"):
        simulation.advance(lambda where: simulation.restore(simulation.memento()))
    seen = []
    simulation.advance(lambda where: seen.append(simulation.t))
    assert set(seen) == {0.0}


def large():
    """A study whose steps take long."""
    study = studies.bar(scheme="central_difference", step=0, record=100, end=100)
    study.mesh.bodies = [studies.box((200, 100))]
    return study


def test_other_threads_run_while_a_step_is_made():
    simulation = rubato.Simulation(large())
    counted, done = [0], threading.Event()

    def count():
        while not done.is_set():
            counted[0] += 1

    thread = threading.Thread(target=count)
    start = time.monotonic()
    while time.monotonic() - start < 0.2:
        pass
    alone = counted[0]
    thread.start()
    simulation.advance(lambda where: time.monotonic() - start < 1.2)
    within = counted[0]
    done.set()
    thread.join()
    assert alone == 0 and within > 100_000


def test_another_thread_may_not_look_at_a_simulation_that_is_being_advanced():
    simulation = rubato.Simulation(large())
    inside, looked, found = threading.Event(), threading.Event(), []

    def advance():
        simulation.advance(lambda where: inside.set() or not looked.wait(0))

    thread = threading.Thread(target=advance)
    thread.start()
    inside.wait(10)
    for ask in (lambda: simulation.t, simulation.advance, lambda: simulation.state):
        try:
            ask()
        except RuntimeError as error:
            found.append(str(error))
    looked.set()
    thread.join(10)
    assert len(found) == 3 and all("is being advanced" in text for text in found)
    assert simulation.t == 0


INTERRUPTED = """
    import os, signal, sys, threading
    sys.path.insert(0, {tests!r})
    import rubato, simulation_test
    simulation = rubato.Simulation(simulation_test.large())
    threading.Timer(0.5, lambda: os.kill(os.getpid(), signal.SIGINT)).start()
    try:
        simulation.advance()
    except KeyboardInterrupt:
        print("caught", simulation.t, simulation.next.end)
        seen = []
        step = simulation.advance(lambda where: seen.append(1) or len(seen) < 3)
        print(step.verdict, len(seen))
"""


def test_ctrl_c_ends_a_step_and_leaves_a_simulation_that_can_go_on():
    code = textwrap.dedent(INTERRUPTED.format(tests=str(studies.Path(__file__).parent)))
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False, timeout=120)
    assert done.stdout.splitlines() == ["caught 0.0 100.0", "interrupted 3"], done.stderr


def test_what_contact_points_have_are_views_that_outlive_the_simulation():
    simulation = rubato.Simulation(studies.blocks())
    for _ in simulation:
        pass
    (zone,) = simulation.state.zones
    arrays = [zone.pressure, zone.gap, zone.status, zone.normal_force, zone.tangential_force, zone.slip,
              zone.friction_work]
    kept = [array.copy() for array in arrays]
    assert all(not array.flags.owndata and not array.flags.writeable for array in arrays)
    assert zone.normal_force.shape == (len(zone), 3) and zone.slip.shape == (len(zone), 2)
    assert zone.pressure.max() > 0
    del simulation, zone
    gc.collect()
    assert all(numpy.array_equal(array, copy) for array, copy in zip(arrays, kept))
