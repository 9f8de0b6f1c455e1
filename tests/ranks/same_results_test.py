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
    both(tmp_path, ranks, BEAMS / f"{case}.yaml", "--only", "evol1", "--set", "fields=", run="evol1")


@pytest.mark.parametrize("ranks", [2, 3, 4])
def test_shrink_fit(tmp_path, ranks):
    assert running.rubato(tmp_path, 1, "new", "shrink_fit").returncode == 0
    both(tmp_path, ranks, "shrink_fit.yaml")


@pytest.mark.parametrize("ranks", [2, 3, 4])
def test_plastic_beams(tmp_path, ranks):
    changes = ["--set", f"materials={PLASTIC}", "--set", "checks=", "--set", "time.start=consistent", "--set", "fields="]
    both(tmp_path, ranks, BEAMS / "c.yaml", "--only", "evol1", *changes, run="evol1")


@pytest.mark.parametrize("ranks", [2, 3])
@pytest.mark.parametrize("solver", ["full", "iterative"])
def test_other_solvers(tmp_path, ranks, solver):
    changes = ["--set", f"solver={solver}", "--set", "fields=", "--set", "time.end=0.003", "--set", "checks="]
    both(tmp_path, ranks, BEAMS / "e.yaml", "--only", "evol1", *changes, run="evol1")


def test_explicit_beams(tmp_path):
    changes = ["--set", "time.end=0.001", "--set", "fields=", "--set", "checks="]
    both(tmp_path, 2, BEAMS / "explicit.yaml", *changes, run=first_run(BEAMS / "explicit.yaml"))


def first_run(deck):
    listed = running.rubato(deck.parent, 1, "run", deck, "--dry-run")
    return listed.stdout.split()[0].rstrip(":")


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
