# SPDX-License-Identifier: LGPL-3.0-or-later
"""How runs of several ranks end: well, badly, killed, stopped; and how they go on."""

import os
import signal
import subprocess
import time

import pytest
import running

BEAMS = running.SOURCES / "cases" / "sdnl140"
F = BEAMS / "f.yaml"
# Runs of some seconds. The implicit one makes few steps, which many would make chaos of: impacts amplify rounding.
COMMON = ["run", BEAMS / "c.yaml", "--only", "evol1", "--set", "fields=", "--set", "checks="]
RUNS = {
    "implicit": [*COMMON, "--set", "mesh.refine=3", "--set", "checkpoint={every: 1}"],
    "explicit": [
        *COMMON,
        *["--set", "mesh.refine=2", "--set", "contact.interface.method=penalty", "--set", "checkpoint={every: 5}"],
        *["--set", 'time={"scheme": "central_difference", "step": "auto", "end": 2e-3, "record": 4e-6, "alpha": ~, "start": ~}'],
    ],
}


def said_by_rubato(ended):
    """Lines of the program in what mpiexec hands on."""
    return [line for line in ended.stderr.splitlines() if line.startswith("error: ")]


@pytest.mark.parametrize(
    ("arguments", "code", "words"),
    [
        (["run", "missing.yaml"], 2, "missing.yaml"),
        (["run", F, "--set", "time.step=-1"], 2, "time.step"),
        (["run", F, "--only", "evol1", "--set", "loads.0.nodal_force.on=Roof"], 2, "Roof"),
        (["run", F, "--only", "evol1", "--set", "newton={residual: 1e-300, max_iterations: 1}"], 3, "evol1"),
        (["run", F, "--jobs", "2"], 2, "--jobs"),
        (["run", "-"], 2, "standard input"),
    ],
)
def test_what_is_wrong_is_told_once(tmp_path, arguments, code, words):
    ended = running.rubato(tmp_path, 2, *arguments, stdin=subprocess.DEVNULL)
    assert ended.returncode == code, ended.stderr
    assert len(said_by_rubato(ended)) == 1, ended.stderr
    assert words in said_by_rubato(ended)[0]


def test_rank_that_fails_alone_ends_all(tmp_path):
    """The second one does not find its deck, as where a file lies on one machine only."""
    ranks = [[running.PROGRAM, "run", deck, "--only", "evol1"] for deck in (str(F), "missing.yaml")]
    began = time.monotonic()
    ended = running.called(tmp_path, [running.MPIEXEC, "-n", "1", *ranks[0], ":", "-n", "1", *ranks[1]])
    assert time.monotonic() - began < 60
    assert ended.returncode == 2, ended.stderr
    (line,) = said_by_rubato(ended)
    assert line.startswith("error: rank 1 of 2 ended alone: ")
    assert "missing.yaml" in line


def test_failed_check(tmp_path):
    changes = ["--only", "evol1", "--set", "fields=", "--set", "checks.0.tolerance=1e-300"]
    ended = running.rubato(tmp_path, 2, "run", F, *changes)
    assert ended.returncode == 1, ended.stderr


def test_folder_that_cannot_be_made(tmp_path):
    (tmp_path / "file").write_text("")
    ended = running.rubato(tmp_path, 2, "run", F, "--only", "evol1", "-o", "file/below")
    assert ended.returncode == 2, ended.stderr
    assert len(said_by_rubato(ended)) == 1


def test_other_commands_are_done_by_the_first_rank(tmp_path):
    ended = running.rubato(tmp_path, 2, "list")
    alone = running.rubato(tmp_path, 1, "list")
    assert (ended.returncode, ended.stdout) == (0, alone.stdout)


def test_without_its_module(tmp_path):
    copy = tmp_path / "rubato"
    copy.write_bytes(open(running.PROGRAM, "rb").read())
    copy.chmod(0o755)
    ended = running.called(tmp_path, [running.MPIEXEC, "-n", "2", copy, "run", F, "--only", "evol1"])
    assert ended.returncode == 2, ended.stderr
    (line,) = said_by_rubato(ended)
    assert "2 processes were started for one run, which needs PETSc" in line
    assert "make deps build PETSC=1" in line


# ---- killed, stopped, resumed -----------------------------------------------------------------------------------


def ranks_of(run):
    """The process of each rank below mpiexec."""
    listed = subprocess.run(["ps", "-o", "pid=", "--ppid", str(run.pid)], capture_output=True, text=True, check=False)
    return [int(word) for word in listed.stdout.split()]


def wait_for(condition, seconds=60):
    end = time.monotonic() + seconds
    while not condition():
        assert time.monotonic() < end
        time.sleep(0.02)


def has_checkpoint(folder):
    return (folder / "evol1" / "checkpoint.h5").exists()


@pytest.mark.parametrize(("kind", "victim"), [("implicit", 1), ("explicit", 0), ("explicit", 2)])
def test_killed_rank_ends_all(tmp_path, kind, victim):
    deck = RUNS[kind]
    run = running.start(tmp_path, 3, *deck, "-o", "killed")
    wait_for(lambda: has_checkpoint(tmp_path / "killed"))
    ranks = ranks_of(run)
    assert len(ranks) == 3
    killed = time.monotonic()
    os.kill(ranks[victim], signal.SIGKILL)
    _, errors = run.communicate(timeout=60)
    assert time.monotonic() - killed < 10
    assert run.returncode != 0
    assert "signal 9 (Killed)" in errors
    assert running.summary(tmp_path / "killed" / "evol1")["status"] == "running"
    half = ["--set", "time.end=0.006"] if kind == "implicit" else ["--set", "time.end=1e-3"]
    for ranks, end in ((2, half), (1, [])):
        resumed = running.rubato(tmp_path, ranks, *deck, *end, "-o", "killed", "--resume")
        if "the checkpoint stands at" not in resumed.stderr:  # beyond that end
            assert resumed.returncode == 0, resumed.stderr
    whole = running.rubato(tmp_path, 1, *deck, "-o", "whole")
    assert whole.returncode == 0, whole.stderr
    difference, where = running.largest_difference(tmp_path / "whole" / "evol1", tmp_path / "killed" / "evol1")
    assert difference < 1e-10, where


@pytest.mark.parametrize("asked", [signal.SIGINT, signal.SIGTERM])
def test_stopped_run_keeps_its_state(tmp_path, asked):
    deck = RUNS["explicit"]
    run = running.start(tmp_path, 2, *deck, "--set", "time.end=1", "-o", "stopped")
    wait_for(lambda: has_checkpoint(tmp_path / "stopped"))
    run.send_signal(asked)
    run.communicate(timeout=60)
    assert run.returncode != 0
    assert running.summary(tmp_path / "stopped" / "evol1")["status"] == "interrupted"
    _, rows = running.table(tmp_path / "stopped" / "evol1" / "probes.csv")
    end = f"time.end={rows[-1][0] + 4e-5}"
    resumed = running.rubato(tmp_path, 3, *deck, "--set", end, "-o", "stopped", "--resume")
    assert resumed.returncode == 0, resumed.stderr
    assert "goes on from" in resumed.stderr
    assert running.summary(tmp_path / "stopped" / "evol1")["status"] == "complete"
