# SPDX-License-Identifier: LGPL-3.0-or-later
"""Fields that functions of Python give stand wherever expressions do, and give what these give."""

import gc
import pickle
import weakref

import numpy
import pytest
import rubato
import studies


def slope(x, y, z, t):
    return 0.01 * (1 + 2 * x - y)


def growing(x, y, z, t):
    return slope(x, y, z, t) * t


SLOPE, GROWING = "0.01*(1+2*x-y)", "0.01*(1+2*x-y)*t"


def end_of(study):
    simulation = rubato.Simulation(study)
    for _ in simulation:
        pass
    return simulation.state


def static():
    return studies.bar(scheme="static", step=0.5, end=1)


PLACES = {
    "support": lambda study, value: study.supports.append(rubato.Support(on="end", components=(value, None))),
    "support times a function": lambda study, value: (
        study.supports.append(rubato.Support(on="end", components=(rubato.Field(value, "half"), None))),
        study.functions.update(half=([0, 1], [0, 0.5])),
    ),
    "surface force": lambda study, value: study.loads.append(rubato.Load("surface_force", "top", (value, 0))),
    "pressure": lambda study, value: study.loads.append(rubato.Load("pressure", "top", (value, 0))),
    "temperature": lambda study, value: (
        study.temperatures.append(rubato.Temperature("all", value)),
        setattr(study.materials[0], "expansion", rubato.ThermalExpansion((1, 1, 1))),
    ),
}


@pytest.mark.parametrize("place", PLACES)
@pytest.mark.parametrize(("function", "expression", "in_time"), [(slope, SLOPE, False), (growing, GROWING, True)])
def test_a_function_gives_what_the_expression_gives(place, function, expression, in_time):
    ends = []
    for value in (rubato.GivenField("mine", function, in_time), expression):
        study = static()
        PLACES[place](study, value)
        ends.append(end_of(study).u)
    assert numpy.abs(ends[1]).max() > 1e-4
    assert numpy.allclose(ends[0], ends[1], rtol=1e-12, atol=1e-15)
    assert numpy.abs(ends[0] - end_of(static()).u).max() > 1e-6, "it matters"


def test_materials_frictions_and_gaps_take_functions():
    for put in (
        lambda study, value: study.materials[0].in_place.update(young=value),
        lambda study, value: setattr(study.contact[0], "gap", value),
        lambda study, value: (
            setattr(study.contact[0], "friction_in_place", value),
            setattr(study.contact[0], "friction", 1),
        ),
    ):
        ends = []
        for value in (rubato.GivenField("mine", lambda x, y, z, t: 0.02 * (2 + x)), "0.02*(2+x)"):
            study = studies.blocks()
            put(study, value)
            ends.append(end_of(study).u)
        assert numpy.allclose(ends[0], ends[1], rtol=1e-12, atol=1e-15)


def test_materials_take_no_function_that_varies_in_time():
    study = static()
    study.materials[0].in_place["young"] = rubato.GivenField("E", lambda x, y, z, t: 100 + t, True)
    with pytest.raises(rubato.InputError, match="materials.rubber.young: the field 'E' varies in time"):
        rubato.Model(study)


def test_a_velocity_takes_no_function_that_varies_in_time():
    study = studies.bar()
    value = rubato.GivenField("v", growing, True)
    study.supports.append(rubato.Support(on="end", components=(rubato.Field(value, given="velocity"), None)))
    with pytest.raises(rubato.InputError, match="found a field that varies in time, in a velocity"):
        rubato.Model(study)


def test_what_a_function_raises_ends_the_step_with_its_name_and_the_place():
    calls = []

    def fails(x, y, z, t):
        calls.append(t)
        if 0.4 < t < 0.6:  # not at the first and the last instant, which the model asks for
            raise ZeroDivisionError("no more")
        return 0.0

    study = static()
    study.supports.append(rubato.Support(on="end", components=(rubato.GivenField("mine", fails, True), None)))
    simulation = rubato.Simulation(study)
    before = simulation.state
    with pytest.raises(rubato.InputError) as caught:
        simulation.advance()
    assert "the field 'mine' raised ZeroDivisionError (no more) at x = 2" in str(caught.value)
    assert "t = 0.5" in str(caught.value) and caught.value.faults[0].path == "supports.1.x"
    assert simulation.state is before and calls


@pytest.mark.parametrize(
    ("value", "sentence"),
    [(float("nan"), "is not a number"), (float("inf"), "is infinite"), ("1", "is no number"), (None, "is no number")],
)
def test_what_is_no_finite_number_is_told(value, sentence):
    study = static()
    study.loads.append(rubato.Load("pressure", "top", (rubato.GivenField("p", lambda x, y, z, t: value), 0)))
    with pytest.raises(rubato.InputError, match=f"the field 'p' {sentence} at x ="):
        rubato.Model(study)


def test_ctrl_c_within_a_function_passes():
    def stop(x, y, z, t):
        raise KeyboardInterrupt

    study = static()
    study.loads.append(rubato.Load("pressure", "top", (rubato.GivenField("p", stop), 0)))
    with pytest.raises(KeyboardInterrupt):
        rubato.Model(study)


def test_the_echo_has_the_name_and_no_deck_can_have_it():
    study = static()
    field = rubato.GivenField("mine", slope)
    study.loads.append(rubato.Load("pressure", "top", (field, 0)))
    study.supports.append(rubato.Support(on="end", components=(rubato.Field(field, "half"), None)))
    study.functions["half"] = ([0, 1], [0, 0.5])
    assert study.echo()["loads"][1]["pressure"]["value"] == {"given": "mine"}
    assert study.echo()["supports"][1]["x"] == {"value": {"given": "mine"}, "function": "half"}
    with pytest.raises(rubato.InputError) as caught:
        rubato.parse(study.to_json())
    assert str(caught.value).count("found a field that a program gave to the study") == 2


def test_fields_are_equal_when_they_have_one_function():
    field = rubato.GivenField("mine", slope)
    assert field == field and (field.name, field.function, field.varies_in_time) == ("mine", slope, False)
    assert field != rubato.GivenField("mine", growing) and field != "mine"
    study = static()
    study.loads.append(rubato.Load("pressure", "top", (field, 0)))
    assert study.copy() == study and study.copy().loads[1].components[0] == field
    assert rubato.Model(study).study == study
    again = pickle.loads(pickle.dumps(study))
    assert again.loads[1].components[0].function is slope
    assert numpy.array_equal(end_of(again).u, end_of(study).u)
    with pytest.raises(TypeError, match="expected a function"):
        rubato.GivenField("mine", 1)


def test_a_function_lives_as_long_as_a_model_has_it():
    class Owner:
        def __call__(self, x, y, z, t):
            return 1.0

    owner = Owner()
    gone = weakref.ref(owner)
    study = static()
    study.supports.append(rubato.Support(on="end", components=(rubato.GivenField("f", owner, True), None)))
    simulation = rubato.Simulation(study)
    del owner, study
    gc.collect()
    assert gone() is not None and simulation.advance().accepted
    del simulation
    gc.collect()
    assert gone() is None


def test_a_study_without_values_is_refused_by_a_run(tmp_path):
    study = static()
    study.loads.append(rubato.Load("pressure", "top", (rubato.GivenField("mine", slope), 0)))
    result = rubato.run(study, tmp_path / "run")
    assert result.status == "complete"
    stored = rubato.open_run(tmp_path / "run")
    assert stored.summary["study"]["loads"][1]["pressure"]["value"] == {"given": "mine"}
    with pytest.raises(rubato.InputError, match="no deck has the function"):
        stored.study
