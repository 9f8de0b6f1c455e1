# SPDX-License-Identifier: LGPL-3.0-or-later
"""The program with one process and with several, and what their folders have in common."""

import csv
import json
import os
import subprocess
from pathlib import Path

PROGRAM = os.environ["RUBATO_PROGRAM"]
SOURCES = Path(os.environ["RUBATO_SOURCE_DIR"])
MPIEXEC = os.environ["RUBATO_MPIEXEC"]

# Open MPI refuses to start processes of root, and more of them than there are cores, unless it is told to.
ALLOWED = {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1", "OMPI_MCA_rmaps_base_oversubscribe": "1"}


def environment():
    return {name: value for name, value in os.environ.items() if not name.startswith(("OMPI_", "PMIX_"))} | ALLOWED


def command(ranks, *arguments):
    return ([MPIEXEC, "-n", str(ranks)] if ranks > 1 else []) + [PROGRAM, *map(str, arguments)]


def called(place, words, **options):
    return subprocess.run(
        words,
        capture_output=True,
        text=True,
        check=False,
        cwd=place,
        env=environment(),
        timeout=900,
        **options,
    )


def rubato(place, ranks, *arguments, **options):
    return called(place, command(ranks, *arguments), **options)


def start(place, ranks, *arguments):
    return subprocess.Popen(
        command(ranks, *arguments),
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        cwd=place,
        env=environment(),
    )


def summary(folder):
    return json.loads((folder / "run.json").read_text())


def table(path):
    with path.open() as file:
        rows = list(csv.reader(file))
    return rows[0], [[float(word) if word else float("nan") for word in row] for row in rows[1:]]


def vectors(columns):
    """Columns of one vector belong together: a part of it that should be zero is measured by the others."""
    found = {}
    for place, name in enumerate(columns[1:], start=1):
        found.setdefault(name.rsplit(".", 1)[0] if name.endswith((".x", ".y", ".z")) else name, []).append(place)
    return found


# What is zero but for rounding, whatever the number of ranks.
ROUNDING = {"smallest_gap", "balance"}


def largest_difference(one, other, files=""):
    """Of the histories of two folders, of the peak of each; of those whose names begin so."""
    names = sorted(path.name for path in one.glob("*.csv") if not path.name.startswith("contact_"))
    assert names == sorted(path.name for path in other.glob("*.csv") if not path.name.startswith("contact_"))
    worst = (0.0, "")
    for name in names:
        if not name.startswith(files):
            continue
        columns, rows = table(one / name)
        other_columns, other_rows = table(other / name)
        assert columns == other_columns
        assert [row[0] for row in rows] == [row[0] for row in other_rows]
        energy = max((abs(value) for row in rows for value in row[1:]), default=0) if name == "energy.csv" else 0
        for vector, places in vectors(columns).items():
            if vector in ROUNDING:
                continue
            peak = energy or max(abs(row[place]) for row in rows for place in places) or 1
            difference = max(abs(a[place] - b[place]) for a, b in zip(rows, other_rows) for place in places)
            worst = max(worst, (difference / peak, f"{name}: {vector}"))
    return worst


def assert_same(one, other, resultants=1e-9):
    """Pressures between quadratic cells are worse conditioned: `condensed` and `full` of one process differ as much."""
    assert [path.name for path in sorted(one.iterdir())] == [path.name for path in sorted(other.iterdir())]
    for files, tolerance in (("probes", 1e-10), ("energy", 1e-10), ("resultants", resultants)):
        difference, where = largest_difference(one, other, files)
        assert difference <= tolerance, where
