# SPDX-License-Identifier: LGPL-3.0-or-later
"""`rubato new`, `run -`, `check -`, `run --dry-run`."""

import re
import subprocess

import corpus
import pytest

NAMES = ["beams", "hertz", "impact", "preload", "shrink_fit"]

BLOCK = """mesh: {generate: [{name: block, rectangle: {from: [0, 0], to: [1, 1]}, divisions: [2, 2],
  sides: {bottom: ground, top: roof}}]}
physics: plane_strain
materials: {rubber: {young: 1e6, poisson: 0.3, density: 1000}}
supports: [{on: ground, fix: [x, y]}]
loads: [{pressure: {on: roof, value: 1000}}]
time: {scheme: static, step: 0.5, end: 1}
runs: {light: {}, heavy: {loads: [{pressure: {on: roof, value: 5000}}]}}
"""


def rubato(folder, *arguments, text=""):
    return subprocess.run(
        [corpus.PROGRAM, *arguments], input=text, capture_output=True, text=True, check=False, cwd=folder
    )


def everything_in(folder):
    return sorted(path.relative_to(folder).as_posix() for path in folder.rglob("*"))


# ---- new ------------------------------------------------------------------------------------------------------


def test_new_lists_the_decks_there_are_with_a_sentence_each(tmp_path):
    done = rubato(tmp_path, "new")
    assert done.returncode == 0
    lines = done.stdout.splitlines()
    assert [line.split()[0] for line in lines] == NAMES
    assert all(re.fullmatch(r"  \w+ +[A-Z].{20,}\.", line) for line in lines)
    assert everything_in(tmp_path) == []


def test_new_writes_a_deck_once(tmp_path):
    done = rubato(tmp_path, "new", "hertz")
    assert done.returncode == 0 and "rubato run hertz.yaml" in done.stdout
    again = rubato(tmp_path, "new", "hertz")
    assert again.returncode == 2
    assert again.stderr == "error: hertz.yaml: there is a file already, expected -o with another name\n"
    assert rubato(tmp_path, "new", "hertz", "-o", "mine.yaml").returncode == 0
    assert (tmp_path / "mine.yaml").read_text() == (tmp_path / "hertz.yaml").read_text()
    assert rubato(tmp_path, "new", "hertz", "-o", "-").stdout == (tmp_path / "hertz.yaml").read_text()


def test_new_names_the_deck_that_was_meant(tmp_path):
    done = rubato(tmp_path, "new", "herz")
    assert done.returncode == 2
    assert done.stderr == f"error: found 'herz', expected one of {', '.join(NAMES)}; did you mean 'hertz'?\n"


@pytest.mark.parametrize("name", NAMES)
def test_new_decks_run_as_they_are_and_their_checks_hold(name, tmp_path):
    assert rubato(tmp_path, "new", name).returncode == 0
    text = (tmp_path / f"{name}.yaml").read_text()
    assert text.count("#") >= 8 and "source: analytic" in text
    assert rubato(tmp_path, "check", f"{name}.yaml").returncode == 0
    done = rubato(tmp_path, "run", f"{name}.yaml")
    assert done.returncode == 0, done.stdout + done.stderr
    assert "analytic" in done.stdout
    assert "warning" not in done.stderr, done.stderr


# ---- standard input -------------------------------------------------------------------------------------------


def test_run_reads_the_deck_from_standard_input(tmp_path):
    done = rubato(tmp_path, "run", "-", "-q", text=BLOCK)
    assert (done.returncode, done.stderr) == (0, "")
    assert {"stdin/light/run.json", "stdin/heavy/run.json"} <= set(everything_in(tmp_path))
    assert rubato(tmp_path, "run", "-", "-q", "-o", "out", "--only", "light", text=BLOCK).returncode == 0
    assert (tmp_path / "out/light/run.json").exists() and not (tmp_path / "out/heavy").exists()


def test_meshes_of_a_deck_from_standard_input_are_in_the_current_folder(tmp_path):
    assert rubato(tmp_path, "mesh", "-", "block.med", text=BLOCK).returncode == 0
    deck = re.sub(r"mesh: \{.*?\}\]\}\n", "mesh: {file: block.med}\n", BLOCK, flags=re.DOTALL)
    assert "file: block.med" in deck
    assert rubato(tmp_path, "run", "-", "-q", text=deck).returncode == 0


def test_faults_of_standard_input_have_line_and_column(tmp_path):
    for command in ["run", "check"]:
        done = rubato(tmp_path, command, "-", text=BLOCK.replace("young", "yung"))
        assert done.returncode == 2
        assert done.stderr.startswith("error: <stdin>:4:21: materials.rubber: 'young' is missing\n")
        assert "error: <stdin>:4:22: unknown key 'materials.rubber.yung'; did you mean 'young'?\n" in done.stderr
    assert rubato(tmp_path, "run", "-", text="").stderr == "error: <stdin>: found no deck: the text is empty\n"
    assert everything_in(tmp_path) == []


def test_check_tells_the_runs_of_a_deck_without_its_mesh(tmp_path):
    (tmp_path / "deck.yaml").write_text(BLOCK)
    done = rubato(tmp_path, "check", "deck.yaml")
    assert (done.returncode, done.stdout) == (0, "deck.yaml: no fault in the deck; 2 runs: light, heavy\n")


# ---- dry run --------------------------------------------------------------------------------------------------


def test_a_dry_run_tells_what_would_be_run_and_writes_nothing(tmp_path):
    (tmp_path / "block.yaml").write_text(BLOCK)
    done = rubato(tmp_path, "run", "block.yaml", "--dry-run", "--set", "time.step=0.25")
    assert (done.returncode, done.stderr) == (0, "")
    for line in [
        "light: results in block/light\n",
        "heavy: results in block/heavy\n",
        "  9 nodes, 8 cells, 12 unknowns, 0 contact points\n",
        "  scheme static, 4 steps from 0 to 1\n",
        "dry run: nothing was computed or written\n",
    ]:
        assert line in done.stdout, done.stdout
    assert re.search(r"  factoring the matrix takes [\d.]+ \w+ of memory \([\d.]+ GB are free\)\n", done.stdout)
    assert everything_in(tmp_path) == ["block.yaml"]


def test_a_dry_run_tells_what_happens_to_former_results(tmp_path):
    (tmp_path / "block.yaml").write_text(BLOCK)
    assert rubato(tmp_path, "run", "block.yaml", "-q").returncode == 0
    before = everything_in(tmp_path)
    assert "  the former results move into block/light/former\n" in rubato(tmp_path, "run", "block.yaml", "--dry-run").stdout
    resumed = rubato(tmp_path, "run", "block.yaml", "--dry-run", "--resume")
    assert "  goes on from the checkpoint there\n" in resumed.stdout
    assert everything_in(tmp_path) == before


def test_a_dry_run_refuses_what_the_run_would_refuse(tmp_path):
    (tmp_path / "block.yaml").write_text(BLOCK.replace("on: ground", "on: floor"))
    dry = rubato(tmp_path, "run", "block.yaml", "--dry-run")
    assert dry.returncode == 2 and "'floor'" in dry.stderr
    assert rubato(tmp_path, "run", "block.yaml").stderr == dry.stderr
    assert everything_in(tmp_path) == ["block.yaml"]
