# SPDX-License-Identifier: LGPL-3.0-or-later
"""Studies: records, words, decks, errors."""

import copy
import pickle
import subprocess

import numpy
import pytest
import rubato
import studies


def test_a_record_has_the_members_of_the_struct_with_their_defaults():
    material = rubato.Material(name="steel", young=2e11)
    assert (material.name, material.young, material.poisson, material.density) == ("steel", 2e11, 0.0, None)
    assert material.law == "elastic" and material.law is rubato.LawKind.elastic
    assert rubato.TimeStepping().scheme == "moreau_jean" and rubato.TimeStepping().cut_levels == 12
    assert rubato.ContactZone().geometry == rubato.Level(by="newton", tolerance=1e-2, max_loops=10)


def test_records_that_are_equal_are_so_member_by_member():
    one, other = rubato.Material(name="a", young=1), rubato.Material(name="a", young=1.0)
    assert one == other and one is not other
    other.damping = rubato.DampingRatios((0.01, 0.02), (50, 400))
    assert one != other and one != "a"
    with pytest.raises(TypeError):
        hash(one)


def test_what_a_record_shows_is_an_expression_that_makes_it():
    study = studies.blocks()
    assert eval(repr(study), vars(rubato)) == study  # noqa: S307
    assert repr(rubato.Material(young=1)) == "Material(young=1.0)"


def test_names_that_a_record_has_not_are_refused_with_the_nearest_one():
    with pytest.raises(AttributeError, match="found 'yung'; did you mean 'young'?"):
        rubato.Material().yung = 1
    with pytest.raises(TypeError, match="found 'densty'; did you mean 'density'?"):
        rubato.Material(densty=1)
    with pytest.raises(AttributeError):
        del rubato.Material().young


def test_words_are_checked_and_told_the_nearest_one():
    study = studies.bar()
    with pytest.raises(rubato.InputError, match="TimeStepping.scheme: found 'newmrk'; did you mean 'newmark'?"):
        study.time.scheme = "newmrk"
    assert study.time.scheme == "newmark"
    study.time.scheme = rubato.SchemeKind.hht
    assert study.time.scheme == "hht"


@pytest.mark.parametrize(
    ("name", "value", "expected"),
    [
        ("young", "2e11", "a number"),
        ("young", True, "a number"),
        ("young", None, "a number"),
        ("cells", "all", "a list"),
        ("everywhere", 1, "True or False"),
        ("damping", 0.1, "DampingRatios"),
        ("in_place", [1], "a dictionary"),
    ],
)
def test_values_of_another_type_are_refused(name, value, expected):
    material = rubato.Material()
    with pytest.raises(TypeError, match=f"Material.{name}: found .*, expected {expected}"):
        setattr(material, name, value)
    assert material == rubato.Material()


def test_numbers_of_numpy_are_numbers():
    body = rubato.Body(to=numpy.array([1, 2, 3]), divisions=numpy.array([2, 2, 2]))
    assert body.to == (1.0, 2.0, 3.0) and body.divisions == (2, 2, 2)
    assert rubato.Material(young=numpy.float32(2)).young == 2.0
    assert rubato.Body(dimension=numpy.int64(2)).dimension == 2
    with pytest.raises(TypeError, match="a whole number"):
        rubato.Body(dimension=2.0)


def test_members_of_lists_can_be_changed_in_place():
    study = studies.bar()
    study.materials[0].young = 7
    assert study.materials[0].young == 7
    kept = study.materials[0]
    for i in range(1000):
        study.materials.append(rubato.Material(name=f"m{i}"))
    kept.young = 8
    assert study.materials[0].young == 8
    study.materials = (kept,)
    assert study.materials == [kept] and study.materials[0] is kept


def test_tuples_cannot_be_changed_behind_the_studys_back():
    body = rubato.Body()
    with pytest.raises(TypeError):
        body.to[0] = 1
    support = rubato.Support(components=(0, None, "1e-3*y"))
    assert support.components == (rubato.Field(0.0), None, rubato.Field(rubato.Formula("1e-3*y")))
    support.components[0].function = "f"
    assert support.components[0].function == "f", "a record in a tuple is the study's own"


def test_values_that_stand_for_fields_and_functions_become_them():
    field = rubato.Field("2*x", "f")
    assert field.value == rubato.Formula("2*x")
    assert rubato.Load(components=(1, "x", rubato.Profile("y", ([0, 1], [2, 3])))).components[2].axis == "y"
    study = rubato.Study(functions={"a": ([0, 1], [0, 2]), "b": "sin(t)", "c": rubato.Product(["t", rubato.Sine()])})
    assert study.functions["a"] == rubato.LinearTable(at=[0, 1], values=[0, 2])
    assert study.functions["b"] == rubato.Formula("sin(t)")
    assert study.functions["c"].factors == [rubato.Formula("t"), rubato.Sine()]
    with pytest.raises(rubato.InputError, match="functions.d"):
        rubato.Study(functions={"d": "sin(t"}).echo()


def test_lists_that_were_changed_in_place_are_checked_when_the_study_is_used():
    study = studies.bar()
    study.materials.append("steel")
    with pytest.raises(TypeError, match=r"materials.1: found 'steel' \(str\), expected Material"):
        study.validate()


def test_broken_rules_are_told_as_the_program_tells_them(tmp_path):
    deck = (studies.SOURCES / "cases/sdnl140/f.yaml").read_text(encoding="utf-8")
    deck = deck.replace("friction: 0.2", "friction: -0.2").replace("density: 7800", "densty: 7800")
    path = tmp_path / "bad.yaml"
    path.write_text(deck, encoding="utf-8")
    printed = subprocess.run([studies.PROGRAM, "check", path], capture_output=True, text=True, check=False).stderr
    with pytest.raises(rubato.InputError) as caught:
        rubato.load_all(path)
    assert [f"error: {line}" for line in str(caught.value).splitlines()] == printed.splitlines()
    assert {(fault.file, fault.line) for fault in caught.value.faults} == {(str(path), 20), (str(path), 30)}
    assert isinstance(caught.value, ValueError)


def test_rules_that_a_study_breaks_are_told_with_their_paths():
    study = studies.bar()
    study.materials[0].poisson = 0.7
    study.time.step = -1
    with pytest.raises(rubato.InputError) as caught:
        study.validate()
    assert [fault.path for fault in caught.value.faults] == ["time.step", "materials.rubber.poisson"]
    assert "materials.rubber.poisson: found '0.7'" in str(caught.value)
    back = pickle.loads(pickle.dumps(caught.value))
    assert str(back) == str(caught.value) and back.faults == caught.value.faults


def test_a_deck_and_the_echo_of_its_study_are_the_same_study():
    study = studies.case()
    again = rubato.parse(study.to_json())
    assert again == study and again.echo() == study.echo()
    assert study.echo()["physics"] == "plane_stress"


@pytest.mark.parametrize("deck", sorted(studies.SOURCES.glob("cases/*/*.yaml")), ids=lambda path: path.stem)
def test_every_case_goes_to_python_and_back(deck):
    for study in rubato.load_all(deck):
        if study.mesh.file and not studies.Path(study.mesh.file).exists():
            pytest.skip("the mesh is not here")
        assert study.time.start != "from_run" or study.time.start_run
        assert pickle.loads(pickle.dumps(study)).to_json() == study.to_json()


def test_settings_change_a_deck_as_those_of_the_program():
    deck = studies.SOURCES / "cases/sdnl140/f.yaml"
    study = rubato.load(
        deck, "evol1", {"time.step": 5e-4, "contact.interface.friction": "0.3", "fields.at": [0.001], "checks": None}
    )
    assert study.time.step == 5e-4 and study.contact[0].friction == 0.3
    assert study.fields.at == [0.001] and study.checks == []
    with pytest.raises(rubato.InputError, match="--set time.stp"):
        rubato.load(deck, "evol1", {"time.stp": 1})


def test_a_deck_of_several_runs_needs_the_name_of_one():
    deck = studies.SOURCES / "cases/sdnl140/f.yaml"
    with pytest.raises(rubato.InputError, match="expected the name of one of them as 'run'"):
        rubato.load(deck)
    with pytest.raises(rubato.InputError, match="evol11?"):
        rubato.load(deck, "evol11")
    assert [study.name for study in rubato.load_all(deck, ["evol1", "evol3"])] == ["evol1", "evol3"]


def test_copies_share_nothing():
    study = studies.blocks()
    for other in (study.copy(), copy.deepcopy(study), pickle.loads(pickle.dumps(study))):
        assert other == study
        other.materials[0].young = 1
        other.functions["press"].values[1] = 5
        other.supports[0].components[0].value = 3
        assert other != study
    assert study == studies.blocks()


def test_a_class_of_the_program_may_extend_a_record():
    class Beam(rubato.Study):
        pass

    beam = Beam(name="b", physics="plane_stress")
    assert beam.echo()["physics"] == "plane_stress" and isinstance(beam, rubato.Study)


def test_studies_are_written_as_input_files_of_calculix(tmp_path):
    study = studies.blocks()
    notes = rubato.write_inp(study, tmp_path / "a.inp")
    text = (tmp_path / "a.inp").read_text()
    assert notes and all(isinstance(note, str) for note in notes)
    assert text.startswith("** ") and "*CONTACT PAIR" in text and text.count("*STEP") == 1
    rubato.write_inp([study], tmp_path / "modes.inp", modes=3)
    assert "*FREQUENCY, STORAGE=NO\n3\n" in (tmp_path / "modes.inp").read_text()
    study.time = rubato.TimeStepping(scheme="energy_momentum", step=1e-3, end=1e-2)
    with pytest.raises(rubato.InputError, match="time.scheme: found motions of linear cells in the plane"):
        rubato.write_inp(study, tmp_path / "b.inp")
    assert not (tmp_path / "b.inp").exists()
    with pytest.raises(rubato.InputError, match="found no study"):
        rubato.write_inp([], tmp_path / "b.inp")
