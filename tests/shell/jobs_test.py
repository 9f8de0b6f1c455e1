# SPDX-License-Identifier: LGPL-3.0-or-later
"""`rubato run --jobs N`: runs side by side leave what runs one after another leave."""

import fcntl
import json
import os
import pty
import re
import resource
import signal
import subprocess
import time
from pathlib import Path

import corpus
import pytest

BLOCKS = """mesh:
  generate:
    - name: upper
      rectangle: {from: [0, 0], to: [1, 0.2]}
      divisions: [4, 2]
      sides: {left: held, bottom: upper_face, top: roof}
      points: {right_top: tip}
    - name: lower
      rectangle: {from: [0, -0.2], to: [1, 0]}
      divisions: [4, 2]
      sides: {left: held, top: lower_face}
physics: plane_stress
materials: {steel: {young: 200e9, poisson: 0.3, density: 7800}}
supports: [{on: held, fix: [x, y]}]
loads: [{surface_force: {on: roof, x: 2e5, y: -1e6}}]
contact: {interface: {master: upper_face, slave: lower_face, friction: 0.2}}
time: {scheme: hht, alpha: -0.1, step: 1e-4, end: 4e-4}
probes: {end: {node: tip}}
"""

PRELOAD = "preload: {time: {scheme: static, alpha: ~, step: 0.5, end: 1}}"
HOPELESS = "newton: {residual: 1e-300, max_iterations: 1}"
LONG = "time: {end: 1}"  # ten thousand steps

CUBE = """mesh: {generate: [{name: block, box: {from: [0, 0, 0], to: [1, 1, 1]}, divisions: [8, 8, 8],
  sides: {bottom: ground, top: roof}}]}
physics: solid
materials: {steel: {young: 2e11, poisson: 0.3, density: 7800}}
supports: [{on: ground, fix: [x, y, z]}]
loads: [{pressure: {on: roof, value: 1e6}}]
time: {scheme: hht, alpha: -0.1, step: 1e-4, end: 3e-4}
runs: {one: {}, two: {loads: [{pressure: {on: roof, value: 2e6}}]}, three: {loads: [{pressure: {on: roof, value: 3e6}}]}}
"""


def runs(*lines):
    return BLOCKS + "runs:\n" + "".join(f"  {line}\n" for line in lines)


@pytest.fixture
def place(tmp_path):
    return tmp_path


def rubato(place, *arguments, **options):
    return subprocess.run(
        [corpus.PROGRAM, *arguments], capture_output=True, text=True, check=False, cwd=place, timeout=600, **options
    )


def run(place, deck, *arguments, **options):
    (place / "deck.yaml").write_text(deck)
    return rubato(place, "run", "deck.yaml", *arguments, **options)


def both(place, deck, *arguments, jobs=2):
    """The same deck one run after another, and side by side."""
    one = run(place, deck, "-o", "one", *arguments)
    beside = run(place, deck, "-o", "beside", "--jobs", str(jobs), *arguments)
    assert beside.returncode == one.returncode, one.stderr + beside.stderr
    assert_same(place / "one", place / "beside")
    return one, beside


def files_in(folder):
    return sorted(path.relative_to(folder) for path in folder.rglob("*") if path.is_file())


def content(path):
    """What a file holds but for seconds and for the folder it lies in; nothing of those that hold them inside."""
    if path.suffix in [".h5", ".med"]:
        return None
    if path.name == "steps.jsonl":
        return [json.loads(line) | {"seconds": 0} for line in path.read_text().splitlines()]
    if path.name == "run.json":
        return json.loads(path.read_text()) | {"setup_seconds": 0, "loop_seconds": 0, "elapsed_seconds": 0}
    return path.read_bytes()


def assert_same(one, other):
    assert files_in(one) == files_in(other)
    for name in files_in(one):
        assert content(one / name) == content(other / name), name


def without_seconds(text, *folders):
    """Lines in the order of the alphabet: runs end in any."""
    text = re.sub(r"set-up .* s, loop .* s", "", text)
    for folder in folders:
        text = text.replace(f"in {folder}/", "in ")
    return sorted(text.splitlines())


def summary(folder):
    return json.loads((folder / "run.json").read_text())


# ---- the same results -----------------------------------------------------------------------------------------


@pytest.mark.parametrize("jobs", [2, 9])
def test_results_are_those_of_runs_one_after_another(place, jobs):
    deck = (corpus.SOURCES / "cases/sdnl140/f.yaml").read_text()
    one, beside = both(place, deck, jobs=jobs)
    assert one.returncode == 0, one.stdout
    assert without_seconds(beside.stdout, "beside") == without_seconds(one.stdout, "one")
    done = rubato(place, "compare", "one/evol3", "beside/evol3", "--at", "0.001", "--norms", "--tolerance", "0")
    assert done.returncode == 0, done.stdout


def test_summary_and_checks_of_a_run_stay_together(place):
    deck = runs(*[f"{name}: {{checks: [{{probe: end.y, at: 1e-4, reference: 1, tolerance: 1}}]}}" for name in "abcd"])
    done = run(place, deck, "--jobs", "3", "-q")
    one = run(place, deck, "-q", "-o", "one")
    assert done.returncode == one.returncode
    assert len(done.stdout.splitlines()) % 4 == 0
    lines = without_seconds(done.stdout, "deck")
    assert lines == without_seconds(one.stdout, "one")
    blocks = [line.split(":")[0] for line in done.stdout.splitlines() if " steps, " in line]
    assert sorted(blocks) == list("abcd")


@pytest.mark.parametrize("checkpoint", ["", "checkpoint: {last: false}, "])
def test_runs_wait_for_the_run_they_start_from(place, checkpoint):
    deck = runs(
        PRELOAD.replace("{time", f"{{{checkpoint}time", 1),
        *[f"{name}: {{time: {{end: 2e-3, start: {{from: preload}}}}, loads: []}}" for name in ["a", "b"]],
        "c: {time: {start: {from: b}, begin: 2e-3, end: 3e-3}, loads: []}",
    )
    before = sorted(Path(os.environ.get("TMPDIR", "/tmp")).glob("rubato-*"))
    one, beside = both(place, deck, jobs=4)
    assert one.returncode == 0, one.stderr
    assert sorted(Path(os.environ.get("TMPDIR", "/tmp")).glob("rubato-*")) == before


def test_runs_wait_for_the_run_they_are_compared_with(place):
    check = "checks: [{probe: end.y, at: 4e-4, run: first, tolerance: 1, kind: absolute}]"
    one, beside = both(place, runs(f"first: {{{LONG.replace('1}', '0.02}')}}}", f"second: {{{check}}}"))
    assert one.returncode == 0
    assert "other_run first" in beside.stdout
    only = run(place, runs("first: {}", f"second: {{{check}}}"), "--only", "second", "-o", "one", "--jobs", "2")
    assert only.returncode == 0, only.stderr


def test_jobs_with_one_run_and_from_standard_input(place):
    done = rubato(place, "run", "-", "--jobs", "3", "-o", "single", input=BLOCKS)
    assert done.returncode == 0 and summary(place / "single/run")["status"] == "complete"
    done = rubato(place, "run", "-", "--jobs", "3", "-q", input=runs("a: {}", "b: {}"))
    assert (done.returncode, done.stderr) == (0, "")
    assert files_in(place / "stdin/a") == files_in(place / "stdin/b")


# ---- words ----------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("value", ["0", "-2", "two", "1.5", "99999999999"])
def test_what_is_no_number_of_runs_is_refused(place, value):
    done = run(place, BLOCKS, f"--jobs={value}")
    assert done.returncode == 2
    assert done.stderr == f"error: --jobs: found '{value}', expected a whole number from 1 on (rubato --help tells more)\n"


@pytest.mark.parametrize("value", ["0", "-1", "two", "1.5"])
def test_what_is_no_number_of_threads_is_refused(place, value):
    done = run(place, BLOCKS, f"--threads={value}")
    assert done.returncode == 2
    assert done.stderr == f"error: --threads: found '{value}', expected a whole number from 1 on (rubato --help tells more)\n"


def test_threads_of_each_run_are_in_its_summary(place):
    """Without a wish the cores are shared out among runs that are computed at once."""
    environment = {name: value for name, value in os.environ.items() if name != "RUBATO_THREADS"}
    deck = runs("a: {}", "b: {}")
    cores = len(os.sched_getaffinity(0))
    for arguments, threads in ((["--threads", "3"], 3), (["--threads", "2", "--jobs", "2"], 2), (["--jobs", "2"], None)):
        assert run(place, deck, *arguments, env=environment).returncode == 0
        for name in "ab":
            told = summary(place / "deck" / name)["threads"]
            assert told == threads or (threads is None and 1 <= told <= max(1, cores // 2))


def test_faults_of_the_models_are_told_with_their_places_before_anything_runs(place):
    deck = runs("a: {}", "b: {supports: [{on: nowhere, fix: [x]}]}")
    one = run(place, deck)
    beside = run(place, deck, "--jobs", "2")
    assert (beside.returncode, beside.stderr) == (2, one.stderr)
    assert "deck.yaml:" in one.stderr and not (place / "deck").exists()


# ---- failures -------------------------------------------------------------------------------------------------


def test_a_run_that_fails_leaves_the_others_alone(place):
    deck = runs(
        PRELOAD.replace("{time", "{" + HOPELESS + ", time", 1),
        "after: {time: {start: {from: preload}}}",
        "last: {time: {start: {from: after}, begin: 4e-4, end: 5e-4}}",
        "alone: {}",
    )
    one, beside = both(place, deck)
    assert one.returncode == 3
    assert without_seconds(beside.stderr, "beside") == without_seconds(one.stderr, "one")
    assert "error: after: not run, because preload did not come to its end\n" in beside.stderr
    assert summary(place / "beside/alone")["status"] == "complete"


def test_no_run_starts_after_one_that_is_refused(place):
    """Here for a folder that another program writes into."""
    check = "checks: [{probe: end.y, at: 1e-4, run: bad, tolerance: 1, kind: absolute}]"
    (place / "deck/bad").mkdir(parents=True)
    folder = os.open(place / "deck/bad", os.O_RDONLY)
    try:
        fcntl.flock(folder, fcntl.LOCK_EX)
        done = run(place, runs("beside: {time: {end: 0.1}}", "bad: {}", f"later: {{{check}}}"), "--jobs", "2")
    finally:
        os.close(folder)
    assert done.returncode == 2, done.stderr
    errors = [line for line in done.stderr.splitlines() if line.startswith("error:")]
    assert len(errors) == 1 and "deck/bad: another run is writing into this folder" in errors[0], done.stderr
    assert summary(place / "deck/beside")["status"] == "complete"
    assert not (place / "deck/later").exists()


# ---- signals --------------------------------------------------------------------------------------------------


def started(place, deck, *arguments, **options):
    (place / "deck.yaml").write_text(deck)
    return subprocess.Popen(
        [corpus.PROGRAM, "run", "deck.yaml", "--jobs", "2", *arguments],
        cwd=place,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        start_new_session=True,
        **options,
    )


def wait_for_steps(process, *folders):
    def some(folder):
        steps = folder / "steps.jsonl"
        return steps.exists() and steps.stat().st_size > 500

    while process.poll() is None and not all(some(folder) for folder in folders):
        time.sleep(0.005)
    assert process.poll() is None, process.communicate()


def children_of(process):
    return [int(number) for number in Path(f"/proc/{process.pid}/task/{process.pid}/children").read_text().split()]


VERY_LONG = LONG.replace("1}", "10}")
TWO_LONG = runs(f"a: {{{VERY_LONG}}}", f"b: {{{VERY_LONG}, contact: {{interface: {{friction: 0.3}}}}}}", "c: {}")


def shorter(place):
    """Ends somewhat after both runs were stopped, which depends on how fast the machine is."""
    steps = max(summary(place / f"deck/{name}")["steps"] for name in ["a", "b"])
    return ["--set", f"time.end={(steps // 500 + 1) * 500 * 1e-4:.4g}"]


def assert_resumed(place):
    """Both at once, to the bits of those that nobody touched."""
    to_end = shorter(place)
    assert run(place, TWO_LONG, "-o", "whole", "-q", *to_end).returncode == 0
    done = run(place, TWO_LONG, "-o", "deck", "--jobs", "2", "--resume", *to_end)
    assert done.returncode == 0, done.stderr
    for name in ["a", "b", "c"]:
        for file in ["probes.csv", "energy.csv", "resultants_interface.csv"]:
            assert (place / f"deck/{name}/{file}").read_bytes() == (place / f"whole/{name}/{file}").read_bytes()
    again = run(place, TWO_LONG, "-o", "deck", "--jobs", "2", "--resume", *to_end)
    assert again.returncode == 0 and again.stderr.count("complete already") == 3, again.stderr


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
@pytest.mark.parametrize("of_all", [True, False])
def test_ctrl_c_stops_every_run_with_a_checkpoint(place, number, of_all):
    process = started(place, TWO_LONG)
    wait_for_steps(process, place / "deck/a", place / "deck/b")
    (os.killpg if of_all else os.kill)(process.pid, number)
    _, err = process.communicate()
    assert process.returncode == 4
    for name in ["a", "b"]:
        assert re.search(
            rf"^error: {name}: interrupted at t = .*; the results up to there are in deck/{name}, --resume goes on from there$",
            err,
            re.MULTILINE,
        ), err
        assert summary(place / f"deck/{name}")["status"] == "interrupted"
    assert not (place / "deck/c").exists()
    assert err.count("stopping;") == (number == signal.SIGINT)
    if of_all and number == signal.SIGINT:
        assert_resumed(place)


def test_a_second_signal_ends_all_at_once(place):
    process = started(place, TWO_LONG, "-q", "--set", "mesh.refine=30")
    while process.poll() is None and not (place / "deck/a/run.json").exists():
        time.sleep(0.005)
    children = children_of(process)
    process.send_signal(signal.SIGINT)
    process.send_signal(signal.SIGTERM)
    process.communicate()
    assert process.returncode in [-signal.SIGINT, -signal.SIGTERM]
    assert not any(Path(f"/proc/{number}").exists() for number in children)


def test_a_killed_run_is_told_and_the_others_go_on(place):
    deck = runs(f"a: {{{LONG}}}", "b: {time: {end: 0.02}}", "c: {}", "d: {time: {start: {from: a}, begin: 1, end: 1.1}}")
    process = started(place, deck, "--set", "checkpoint.every=10")
    while process.poll() is None and not (place / "deck/a/checkpoint.h5").exists():
        time.sleep(0.005)
    os.kill(children_of(process)[0], signal.SIGKILL)
    _, err = process.communicate()
    assert process.returncode == 4, err
    errors = [line for line in err.splitlines() if line.startswith("error:")]
    assert errors == [
        "error: a: its process was ended by signal 9 (Killed), as the system does when memory runs out; the results "
        "up to there are in deck/a, --resume goes on from the last checkpoint",
        "error: d: not run, because a did not come to its end",
    ]
    assert summary(place / "deck/a")["status"] == "running"
    assert [summary(place / f"deck/{name}")["status"] for name in "bc"] == ["complete", "complete"]


def test_runs_stop_with_a_checkpoint_when_the_program_is_killed(place):
    process = started(place, TWO_LONG)
    wait_for_steps(process, place / "deck/a", place / "deck/b")
    children = children_of(process)
    process.kill()
    process.communicate()
    while any(Path(f"/proc/{number}").exists() for number in children):
        time.sleep(0.01)
    assert [summary(place / f"deck/{name}")["status"] for name in "ab"] == ["interrupted", "interrupted"]
    assert_resumed(place)


# ---- memory ---------------------------------------------------------------------------------------------------


ONE_BLAS_THREAD = {"env": os.environ | {"OPENBLAS_NUM_THREADS": "1"}}


def address_space(place, deck):
    """Of the first of its runs by itself, in bytes: libraries, stacks of threads and what it computes with."""
    process = started(place, deck.replace("end: 3e-4", "end: 10"), **ONE_BLAS_THREAD)
    wait_for_steps(process, place / "deck/one")
    peaks = [re.search(r"VmPeak:\s*(\d+)", Path(f"/proc/{child}/status").read_text()) for child in children_of(process)]
    process.send_signal(signal.SIGINT)
    process.communicate()
    return max(int(peak[1]) for peak in peaks) << 10


@pytest.fixture(scope="module")
def small_run(tmp_path_factory):
    return address_space(tmp_path_factory.mktemp("small"), CUBE)


def limited(address_space):
    def limit():
        resource.setrlimit(resource.RLIMIT_AS, (address_space, address_space))

    return {"preexec_fn": limit, **ONE_BLAS_THREAD}


def is_sanitized():
    return b"__asan_init" in Path(corpus.PROGRAM).read_bytes()


without_limit = pytest.mark.skipif(
    is_sanitized(), reason="the sanitizer reserves more address space than there is to limit"
)


@without_limit
def test_runs_that_do_not_fit_beside_others_wait(place, tmp_path_factory):
    deck = CUBE.replace("[8, 8, 8]", "[16, 16, 16]")  # needs twice as much memory as a process before it begins
    one_run = address_space(tmp_path_factory.mktemp("one_run"), deck)
    one = run(place, deck, "-o", "one", "-q")
    beside = run(place, deck, "-o", "beside", "--jobs", "3", **limited(one_run + (20 << 20)))
    assert one.returncode == beside.returncode == 0, beside.stderr
    # Whichever of them counts its memory first says so first.
    waits = sorted((line for line in beside.stderr.splitlines() if " waits for memory: " in line), reverse=True)
    assert [line.split(":")[0] for line in waits] == ["two", "three"]
    assert re.fullmatch(
        r"two: waits for memory: it needs \d+ MB, as runs like it do, and [\d.]+ [kM]B are left beside one", waits[0]
    ), waits
    assert_same(place / "one", place / "beside")


@without_limit
def test_a_run_unlike_the_others_waits_before_it_factors_its_matrix(place, small_run):
    deck = CUBE.replace("one: {}, two: {", "one: {time: {end: 0.05}}, two: {solver: condensed, ")
    beside = run(place, deck, "-o", "beside", "--jobs", "2", "--only", "one,two", **limited(small_run + (50 << 20)))
    assert beside.returncode == 0, beside.stderr
    assert re.search(
        r"^two: waits for memory: the factor of its matrix needs .* MB, and .* [kM]B are left beside one$",
        beside.stderr,
        re.MULTILINE,
    ), beside.stderr
    assert run(place, deck, "-o", "one", "-q", "--only", "one,two").returncode == 0
    assert_same(place / "one", place / "beside")


@without_limit
def test_a_run_that_waits_for_memory_stops_at_once(place, small_run):
    deck = CUBE.replace("two: {", "two: {solver: condensed, ").replace("end: 3e-4", "end: 10")
    process = started(place, deck, **limited(small_run + (50 << 20)))
    err = ""
    while "two: waits" not in err:
        err += process.stderr.readline()
        assert process.poll() is None, err
    wait_for_steps(process, place / "deck/one")
    process.send_signal(signal.SIGINT)
    err += process.communicate()[1]
    assert process.returncode == 4
    assert "error: two: interrupted before its first step, nothing was written\n" in err
    assert re.search("^error: one: interrupted at t = .*--resume goes on from there$", err, re.MULTILINE), err
    assert not (place / "deck/two").exists() and not (place / "deck/three").exists()


@without_limit
def test_a_run_that_does_not_fit_alone_is_refused_as_ever(place, small_run):
    deck = CUBE.replace("[8, 8, 8]", "[22, 22, 22]")
    one = run(place, deck, "-q", **limited(small_run + (150 << 20)))
    beside = run(place, deck, "-q", "--jobs", "2", **limited(small_run + (150 << 20)))
    assert (one.returncode, beside.returncode) == (2, 2)
    for done in [one, beside]:
        assert re.fullmatch(r"error: the model is too large for this machine: with its 34914 unknowns .*\n", done.stderr)
    assert not (place / "deck").exists()


# ---- what is shown --------------------------------------------------------------------------------------------


def shown_on_terminal(place, *arguments):
    """What a terminal of 80 columns gets."""
    child, terminal = pty.fork()
    if child == 0:
        os.chdir(place)
        os.execv(corpus.PROGRAM, [corpus.PROGRAM, "run", "deck.yaml", "--jobs", "2", *arguments])
    text = b""
    try:
        while piece := os.read(terminal, 65536):
            text += piece
    except OSError:  # the other end is closed
        pass
    os.close(terminal)
    _, status = os.waitpid(child, 0)
    return os.waitstatus_to_exitcode(status), text.decode()


def test_a_terminal_has_whole_lines_and_one_for_all_runs(place):
    (place / "deck.yaml").write_text(runs("a: {time: {end: 0.1}}", "b: {time: {end: 0.1}}", "c: {}"))
    code, text = shown_on_terminal(place)
    assert code == 0, text
    pieces = re.split(r"\r\x1b\[K|\r\n", text)
    states = [piece for piece in pieces if re.fullmatch(r"\w+ (set-up|\d+ %).*", piece)]
    assert any(re.fullmatch(r"a \d+ %.* \| b (set-up|\d+ %).* \| 1 to come", state) for state in states), text
    assert all(len(state) < 80 for state in states)
    others = [piece for piece in pieces if piece and piece not in states]
    assert all(re.match(r"[abc]: ", line) for line in others), others


def test_a_log_has_lines_that_begin_with_the_run(place):
    done = run(place, runs("a: {time: {end: 0.1}}", "b: {time: {end: 0.1}}"), "--jobs", "2")
    assert done.returncode == 0
    assert all(re.match(r"[ab](: | +\d+ %)", line) for line in done.stderr.splitlines()), done.stderr
    for name in ["a", "b"]:
        assert re.search(rf"^{name} 100 % t = 0.1 ", done.stderr, re.MULTILINE)
