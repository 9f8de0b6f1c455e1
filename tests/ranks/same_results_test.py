# SPDX-License-Identifier: LGPL-3.0-or-later
"""Several ranks leave what one process leaves: histories to 1e-10 of their peaks."""

import json

import pytest
import running

BEAMS = running.SOURCES / "cases" / "sdnl140"

PLASTIC = json.dumps(
    {
        "steel": {
            "law": "plastic",
            "young": 200e9,
            "poisson": 0,
            "density": 7800,
            "hardening": {"linear": {"yield_stress": 400e6, "modulus": 2e9}},
        }
    }
)


def both(place, ranks, *arguments, run="run", code=0):
    one = running.rubato(place, 1, "run", *arguments, "-o", "one", "--threads", "1")
    several = running.rubato(place, ranks, "run", *arguments, "-o", "several")
    assert one.returncode == code, one.stderr
    assert several.returncode == code, several.stderr
    running.assert_same(place / "one" / run, place / "several" / run)
    assert running.summary(place / "several" / run)["ranks"] == ranks
    return one, several


@pytest.mark.parametrize("case", "abcdef")
@pytest.mark.parametrize("ranks", [2, 3, 4])
def test_beams(tmp_path, case, ranks):
    # Later steps of B, whose augmentation shows, are cut again and again: they take minutes.
    end = ["--set", "time.end=0.001", "--set", "checks="] if case == "b" else []
    both(tmp_path, ranks, BEAMS / f"{case}.yaml", "--only", "evol1", "--set", "fields=", *end, run="evol1")


@pytest.mark.parametrize("ranks", [2, 3, 4])
def test_shrink_fit(tmp_path, ranks):
    assert running.rubato(tmp_path, 1, "new", "shrink_fit").returncode == 0
    both(tmp_path, ranks, "shrink_fit.yaml")


@pytest.mark.parametrize("ranks", [2, 3, 4])
def test_plastic_beams(tmp_path, ranks):
    changes = ["--set", f"materials={PLASTIC}", "--set", "checks=", "--set", "time.start=consistent", "--set", "fields="]
    changes += ["--set", "newton.residual=1e-10"]  # iterations end somewhere below it
    both(tmp_path, ranks, BEAMS / "c.yaml", "--only", "evol1", *changes, run="evol1")


@pytest.mark.parametrize("ranks", [2, 3])
@pytest.mark.parametrize("solver", ["full", "iterative"])
def test_other_solvers(tmp_path, ranks, solver):
    changes = ["--set", f"solver={solver}", "--set", "fields=", "--set", "time.end=0.003", "--set", "checks="]
    both(tmp_path, ranks, BEAMS / "e.yaml", "--only", "evol1", *changes, run="evol1")


EXPLICIT = [
    *["--only", "evol1", "--set", "contact.interface.method=penalty", "--set", "fields=", "--set", "checks="],
    *["--set", 'time={"scheme": "central_difference", "step": "auto", "end": 2e-3, "record": 2e-4, "alpha": ~, "start": ~}'],
]


def steel(**more):
    return ["--set", "materials=" + json.dumps({"steel": {"young": 200e9, "poisson": 0.3, "density": 7800} | more})]


HARDENING = {"linear": {"yield_stress": 200e6, "modulus": 2e9}}
MATERIALS = {
    "linear": steel(),
    "damped": steel(rayleigh={"stiffness": 1e-8, "mass": 10}),
    "large_plastic": steel(law="plastic", strain="logarithmic", hardening=HARDENING, kinematic={"modulus": 2e10, "recall": 100}),
    "reduced": steel(law="plastic", formulation="reduced", hardening=HARDENING, rayleigh={"mass": 10}),
}


@pytest.mark.parametrize("material", sorted(MATERIALS))
@pytest.mark.parametrize("ranks", [2, 3])
def test_explicit_beams(tmp_path, material, ranks):
    both(tmp_path, ranks, BEAMS / "c.yaml", *EXPLICIT, *MATERIALS[material], run="evol1")


def test_explicit_beams_under_pushed_supports(tmp_path):
    supports = "supports=" + json.dumps(
        [
            {"on": "Haut_Encastre", "fix": ["x", "y", "z"]},
            {"on": "Bas_Encastre", "fix": ["x", "z"], "y": {"value": 0.001, "function": "push"}},
        ]
    )
    push = "functions=" + json.dumps({"push": {"times": [0, 2e-3], "values": [0, 1]}})
    both(tmp_path, 3, BEAMS / "c.yaml", *EXPLICIT, "--set", supports, "--set", push, run="evol1")


def test_explicit_run_that_is_not_dealt_out_says_so(tmp_path):
    spring = 'springs=[{"on": "Haut_Libre", "y": 1e6}]'
    _, several = both(tmp_path, 2, BEAMS / "c.yaml", *EXPLICIT, "--set", spring, run="evol1")
    assert "with springs or dashpots each of the 2 ranks computes all cells" in several.stderr


def test_explicit_run_with_relations_says_so(tmp_path):
    flat = 'relations={"flat": {"equal": {"on": "Haut_Libre"}}}'
    _, several = both(tmp_path, 2, BEAMS / "c.yaml", *EXPLICIT, "--set", flat, run="evol1")
    assert "with relations or ties each of the 2 ranks computes all cells" in several.stderr


@pytest.mark.parametrize("material", ["large_plastic", "damped"])
def test_explicit_run_goes_on_with_other_ranks(tmp_path, material):
    keep = ["run", BEAMS / "c.yaml", *EXPLICIT, *MATERIALS[material], "--set", "checkpoint={every: 3}"]
    part = ["--set", "time.end=6e-4"]
    assert running.rubato(tmp_path, 1, *keep, "-o", "whole").returncode == 0
    assert running.rubato(tmp_path, 3, *keep, *part, "-o", "parts").returncode == 0
    for ranks, end in ((2, "1.2e-3"), (1, "1.6e-3"), (4, "2e-3")):
        resumed = running.rubato(tmp_path, ranks, *keep, "--set", f"time.end={end}", "-o", "parts", "--resume")
        assert resumed.returncode == 0, resumed.stderr
        assert "goes on from" in resumed.stderr
    difference, where = running.largest_difference(tmp_path / "whole" / "evol1", tmp_path / "parts" / "evol1")
    assert difference <= 1e-10, where


@pytest.mark.parametrize("threads", [1, 2])
def test_threads_of_each_rank(tmp_path, threads):
    common = ["run", BEAMS / "c.yaml", "--only", "evol1", "--set", "fields="]
    assert running.rubato(tmp_path, 1, *common, "-o", "one").returncode == 0
    assert running.rubato(tmp_path, 2, *common, "-o", "several", "--threads", threads).returncode == 0
    running.assert_same(tmp_path / "one" / "evol1", tmp_path / "several" / "evol1")
    summary = running.summary(tmp_path / "several" / "evol1")
    assert (summary["ranks"], summary["threads"]) == (2, threads)


def test_runs_that_start_from_others(tmp_path):
    both(tmp_path, 2, BEAMS / "f.yaml", "--set", "fields=", run="evol2")


CUBE = """mesh: {generate: [{name: block, box: {from: [0, 0, 0], to: [1, 1, 1]}, divisions: [1, 1, 1],
  sides: {bottom: ground, top: roof}}]}
physics: solid
materials: {steel: {young: 2e11, poisson: 0.3, density: 7800}}
supports: [{on: ground, fix: [x, y, z]}]
loads: [{pressure: {on: roof, value: 1e6}}]
time: {scheme: hht, alpha: -0.1, step: 1e-4, end: 3e-4}
probes: {corner: {point: [1, 1, 1]}}
"""


@pytest.mark.parametrize("solver", ["auto", "full"])
def test_more_ranks_than_cells(tmp_path, solver):
    (tmp_path / "cube.yaml").write_text(CUBE)
    both(tmp_path, 4, "cube.yaml", "--set", f"solver={solver}")


def test_fields_are_written_once(tmp_path):
    _, several = both(tmp_path, 2, BEAMS / "f.yaml", "--only", "evol1", run="evol1")
    assert several.stdout.count("evol1: 12 steps") == 1
    fields = sorted(path.name for path in (tmp_path / "several" / "evol1" / "fields").iterdir())
    assert fields == sorted(path.name for path in (tmp_path / "one" / "evol1" / "fields").iterdir())
