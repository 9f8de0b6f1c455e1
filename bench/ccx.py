#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Times static contact with friction by rubato and by CalculiX, of the same .inp files, one thread each.

    python3 bench/ccx.py build/release/rubato

Prints the table of docs/performance.md: user and system time of each process, one run, one program after the other,
and how far the forces on the ground are apart. Needs CalculiX (make deps CCX=1)."""

import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "tests" / "shell"))
from ccx_grids import ELASTIC, blocks

LINEAR = "*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR\n1e7\n"
FRICTION = "*FRICTION\n0.3, 1e6\n"
PLASTIC = ELASTIC + "*PLASTIC\n400., 0.\n500., 0.05\n"
SMALL = "*STEP, INC=1000\n*STATIC\n0.05, 1., 1e-5, 0.05\n"
LARGE = SMALL.replace("*STEP", "*STEP, NLGEOM")
STUDIES = [
    ("C3D8", 1, 4, ELASTIC, SMALL), ("C3D8", 2, 3, ELASTIC, SMALL), ("C3D8", 3, 6, ELASTIC, SMALL),
    ("C3D20", 1, 2, ELASTIC, SMALL), ("C3D20", 2, 3, ELASTIC, SMALL),
    ("C3D8", 2, 3, ELASTIC, LARGE), ("C3D20", 1, 2, ELASTIC, LARGE),
    ("C3D8", 2, 3, PLASTIC, SMALL), ("C3D20", 1, 2, PLASTIC, SMALL),
]


def seconds(command, folder):
    """Processor time of a process that ends well."""
    with open(folder / "log", "w") as log:
        process = subprocess.Popen(command, cwd=folder, env=os.environ | {"OMP_NUM_THREADS": "1"}, stdout=log, stderr=log)
        _, status, usage = os.wait4(process.pid, 0)
    if status != 0:
        raise SystemExit(f"{' '.join(command)} ended with status {status}:\n{(folder / 'log').read_text()[-2000:]}")
    return usage.ru_utime + usage.ru_stime


def last_force(path):
    """The last total force of a .dat file."""
    found = re.findall(r"total force.*\n\n(.*)\n", path.read_text())
    return [float(word) for word in found[-1].split()]


def main(program):
    print("| elements | unknowns | study | CalculiX [s] | rubato [s] | ratio | forces differ by |\n|---|---|---|---|---|---|---|")
    for kind, cut, layers, law, procedure in STUDIES:
        text = blocks(kind, LINEAR, procedure, FRICTION, "0.02", cut, layers, law)
        study = ("NLGEOM" if procedure is LARGE else "small strain") + (", plastic" if law is PLASTIC else "")
        with tempfile.TemporaryDirectory() as place:
            folder = Path(place)
            (folder / "a.inp").write_text(text)
            theirs = seconds(["ccx", "a"], folder)
            ours = seconds([program, "run", "a.inp", "--threads", "1", "-q", "-o", "out"], folder)
            a, b = last_force(folder / "a.dat"), last_force(folder / "out" / "a.dat")
        nodes = text.count("\n") and len(re.findall(r"^\d+, \S+, \S+, \S+$", text, re.M))
        apart = max(abs(x - y) for x, y in zip(a, b)) / max(map(abs, a))
        print(f"| {kind} | {3 * nodes} | {study} | {theirs:.2f} | {ours:.2f} | {theirs / ours:.0f} | {100 * apart:.2f} % |", flush=True)


if __name__ == "__main__":
    main(str(Path(sys.argv[1]).resolve()))
