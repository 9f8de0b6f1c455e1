# SPDX-License-Identifier: LGPL-3.0-or-later
"""How runs of several ranks end: well, badly, killed, stopped; and how they go on."""

import signal
import subprocess
import time

import pytest
import running

BEAMS = running.SOURCES / "cases" / "sdnl140"
F = BEAMS / "f.yaml"
LONG = ["run", F, "--only", "evol1", "--set", "fields=", "--set", "checks=", "--set", "time.end=1"]  # 1,000 steps
KEPT = [*LONG, "--set", "checkpoint={every: 5}"]


def said_by_rubato(ended):
    """Lines of the program in what mpiexec hands on."""
    return [line for line in ended.stderr.splitlines() if line.startswith("error: ")]


@pytest.mark.parametrize(
    ("arguments", "code", "words"),
    [
        (["run", "missing.yaml"], 2, "missing.yaml"),
        (["run", F, "--set", "time.step=-1"], 2, "time.step"),
        (["run", F, "--only", "evol1", "--set", "loads.0.line_force.on=Roof"], 2, "Roof"),
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
    ended = subprocess.run(
        [running.MPIEXEC, "-n", "2", copy, "run", F, "--only", "evol1"],
        capture_output=True,
        text=True,
        check=False,
        cwd=tmp_path,
        env=running.environment(),
        timeout=300,
    )
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


@pytest.mark.parametrize("victim", [0, 1])
def test_killed_rank_ends_all(tmp_path, victim):
    run = running.start(tmp_path, 3, *KEPT, "-o", "killed")
    wait_for(lambda: has_checkpoint(tmp_path / "killed"))
    ranks = ranks_of(run)
    assert len(ranks) == 3
    killed = time.monotonic()
    subprocess.run(["kill", "-9", str(ranks[victim])], check=True)
    _, errors = run.communicate(timeout=60)
    assert time.monotonic() - killed < 10
    assert run.returncode != 0
    assert "signal 9 (Killed)" in errors
    assert running.summary(tmp_path / "killed" / "evol1")["status"] == "running"
    for ranks in (2, 1):
        end = ["--set", "time.end=0.1"] if ranks == 2 else []
        resumed = running.rubato(tmp_path, ranks, *KEPT, *end, "-o", "killed", "--resume")
        if "already" in resumed.stderr:  # it had come further before it was killed
            continue
        assert resumed.returncode == 0, resumed.stderr
    whole = running.rubato(tmp_path, 1, *KEPT, "-o", "whole")
    assert whole.returncode == 0, whole.stderr
    difference, where = running.largest_difference(tmp_path / "whole" / "evol1", tmp_path / "killed" / "evol1")
    assert difference < 1e-10, where


@pytest.mark.parametrize("asked", [signal.SIGINT, signal.SIGTERM])
def test_stopped_run_keeps_its_state(tmp_path, asked):
    run = running.start(tmp_path, 2, *KEPT, "-o", "stopped")
    wait_for(lambda: has_checkpoint(tmp_path / "stopped"))
    run.send_signal(asked)
    run.communicate(timeout=60)
    assert run.returncode != 0
    summary = running.summary(tmp_path / "stopped" / "evol1")
    assert summary["status"] == "interrupted"
    resumed = running.rubato(tmp_path, 3, *KEPT, "--set", "time.end=1", "-o", "stopped", "--resume")
    assert resumed.returncode == 0, resumed.stderr
    assert running.summary(tmp_path / "stopped" / "evol1")["status"] == "complete"
