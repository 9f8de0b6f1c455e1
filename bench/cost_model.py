#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Measures runs of one process and of two ranks, fits what they cost, and goes on to sizes nobody here can run.

    python3 bench/cost_model.py build/release/rubato

Prints tables of docs/performance.md. n: dofs, c: cells, N: ranks, p: points in contact. Constants are fitted by least
squares of relative errors, none of them negative. Times are by the clock, of one thread; memory is that of the process,
of several ranks of the largest one. Needs numpy; nothing else should run beside it."""

import itertools
import json
import os
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy

CUBE = """mesh: {{generate: [{{name: block, box: {{from: [0, 0, 0], to: [{long}, 1, 1]}}, divisions: [{cells}, {k}, {k}],
  cells: hexa8, sides: {{left: ground, right: roof}}}}]}}
physics: solid
materials: {{steel: {{young: 2e11, poisson: 0.3, density: 7800{law}}}}}
supports: [{{on: ground, fix: [x, y, z]}}]
loads: [{{pressure: {{on: roof, value: 1e6}}}}]
time: {time}
"""
IMPLICIT = "{scheme: hht, alpha: -0.1, step: 1e-5, end: 1e-4}"
YIELDS = ", law: plastic, hardening: {linear: {yield_stress: 250e6, modulus: 2e9}}"
FACTOR, RECORDS = 4 / 3, 10
ALLOWED = {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}


def measured(program, place, deck, ranks=1):
    """What run.json says, and the memory [bytes] that the process had at most."""
    (place / "deck.yaml").write_text(deck)
    command = [program, "run", "deck.yaml", "--threads", "1", "-o", "out", "-q"]
    if ranks > 1:
        command = ["mpiexec", "-n", str(ranks), *command]
    process = subprocess.Popen(command, cwd=place, env=os.environ | ALLOWED, stdout=subprocess.DEVNULL)
    _, status, usage = os.wait4(process.pid, 0)
    if status != 0:
        raise SystemExit(f"{' '.join(command)} ended with status {status}")
    run = json.loads((place / "out" / "run" / "run.json").read_text())
    loop = run["elapsed_seconds"] - run["setup_seconds"] if ranks == 1 else run["loop_seconds"]
    return {"setup": run["setup_seconds"], "step": loop / run["steps"], "memory": 1024 * usage.ru_maxrss, "factor": run.get("factor_bytes", 0), "steps": run["steps"], "sent": run["sent_bytes"]}


def fitted(terms, values):
    """Constants ≥ 0 of a sum of terms: those that would be negative are left out."""
    chosen = list(range(terms.shape[1]))
    while True:
        weighted = terms[:, chosen] / values[:, None]
        constants = numpy.linalg.lstsq(weighted, numpy.ones(len(values)), rcond=None)[0]
        if (constants >= 0).all():
            all_constants = numpy.zeros(terms.shape[1])
            all_constants[chosen] = constants
            return all_constants
        del chosen[int(constants.argmin())]


def table(header, rows):
    print("\n| " + " | ".join(header) + " |\n|" + "---|" * len(header))
    for row in rows:
        print("| " + " | ".join(row) + " |")


def dofs_of(k, long=1):
    return 3 * (long * k + 1) * (k + 1) ** 2


def box(k, time, law="", long=1):
    """A cube of k³ cells, or so many one after the other."""
    return CUBE.format(k=k, cells=long * k, long=long, law=law, time=time)


def explicit_time(k, steps):
    """Of about so many steps: the run takes the stable one that it finds."""
    end = steps * 0.4 / k / 5100  # of waves in steel
    return f"{{scheme: central_difference, step: auto, end: {end}, record: {end}}}"


def implicit(program, place, sizes, ranks):
    n = numpy.array([float(dofs_of(k)) for k in sizes])
    runs = [measured(program, place, box(k, IMPLICIT), ranks) for k in sizes]
    value = {name: numpy.array([run[name] for run in runs]) for name in runs[0]}
    one = numpy.ones_like(n)
    forms = {
        "setup": numpy.stack([n, n**2], 1),
        "step": numpy.stack([n, value["factor"]], 1),
        "memory": numpy.stack([one, n, n**FACTOR], 1),
        "factor": numpy.stack([n**FACTOR], 1),
    }
    found = {name: fitted(terms, value[name]) for name, terms in forms.items()}
    rows = []
    for i, k in enumerate(sizes):
        row = [f"{k}³", f"{int(n[i]):,}"]
        for name, unit in (("setup", 1), ("step", 1), ("factor", 1e9), ("memory", 1e9)):
            model = forms[name][i] @ found[name]
            row.append(f"{value[name][i] / unit:.3g} ({model / value[name][i]:.2f})")
        rows.append(row)
    print(f"\nImplicit, cube, ranks: {ranks}. In brackets: model over measured.")
    table(["cells", "n", "set-up [s]", "step [s]", "factor [GB]", "memory [GB]"], rows)
    for name, constants in found.items():
        print(f"{name}: " + ", ".join(f"{constant:.3g}" for constant in constants))
    return found


def explicit(program, place, sizes, law, ranks):
    """Time a step of one cell [s], and memory of one dof [bytes]."""
    rows, times, memories = [], [], []
    for k in sizes:
        run = measured(program, place, box(k, explicit_time(k, 100), law), ranks)
        times.append(run["step"] / k**3)
        memories.append(run["memory"] / dofs_of(k))
        rows.append([f"{k}³", f"{dofs_of(k):,}", f"{run['steps']}", f"{1e3 * run['step']:.3g}", f"{1e9 * times[-1]:.3g}", f"{run['memory'] / 1e9:.2f}", f"{memories[-1]:.0f}"])
    print(f"\nExplicit, cube, {'J2' if law else 'elastic'}, ranks: {ranks}")
    table(["cells", "n", "steps", "step [ms]", "step of a cell [ns]", "memory [GB]", "of a dof [bytes]"], rows)
    return times[-1], memories[-1]


def sent_in_a_step(program, place, deck_of, ranks):
    """By all ranks [bytes], from a run and one of twice as many steps; and the shorter one."""
    one, two = (measured(program, place, deck_of(times), ranks) for times in (1, 2))
    return (two["sent"] - one["sent"]) / (two["steps"] - one["steps"]), one


def weak_scaling(program, place, k_implicit, k_explicit):
    rows = []
    for ranks in (1, 2, 4):
        sent, run = sent_in_a_step(program, place, lambda times, ranks=ranks: box(k_implicit, IMPLICIT.replace("1e-4", f"{times}e-4"), long=ranks), ranks)
        n = dofs_of(k_implicit, ranks)
        counted = 8 * (n - 3 * (k_implicit + 1) ** 2 + 2 * ranks * n) if ranks > 1 else 0
        rows.append(["implicit", f"{ranks}", f"{n:,}", f"{run['setup']:.2f}", f"{1e3 * run['step']:.3g}", f"{run['memory'] / 1e9:.2f}", f"{sent:,.0f}", f"{counted:,}"])
    for law in ("", YIELDS):
        for ranks in (1, 2, 4):
            sent, run = sent_in_a_step(program, place, lambda times, ranks=ranks, law=law: box(k_explicit, explicit_time(k_explicit, 100 * times), law, ranks), ranks)
            rows.append(["explicit, J2" if law else "explicit, elastic", f"{ranks}", f"{dofs_of(k_explicit, ranks):,}", f"{run['setup']:.2f}", f"{1e3 * run['step']:.3g}", f"{run['memory'] / 1e9:.2f}", f"{sent:,.0f}", ""])
    print(f"\nWeak scaling: boxes of {k_implicit}³ and {k_explicit}³ cells a rank, one after the other")
    table(["run", "ranks", "n", "set-up [s]", "step [ms]", "memory of a rank [GB]", "sent in a step [bytes]", "counted"], rows)


def main():
    program = str(Path(sys.argv[1]).resolve())
    with tempfile.TemporaryDirectory() as folder:
        place = Path(folder)
        weak_scaling(program, place, 20, 32)
        for ranks, sizes in ((1, (12, 16, 20, 24, 32, 40)), (2, (12, 16, 20, 24, 32))):
            implicit(program, place, sizes, ranks)
        for law, ranks in itertools.product(("", YIELDS), (1, 2)):
            explicit(program, place, (24, 32, 48, 64), law, ranks)


if __name__ == "__main__":
    main()
