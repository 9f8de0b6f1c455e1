#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Draws the runs of SDNL140: for every modeling the history of the loaded end in each of its runs, beside the
converged history, Code_Aster's and the document's points; below, how far each run is from the first one.

    draw_histories.py RUNS_FOLDER PICTURES_FOLDER [CODE_ASTER_FOLDER]

Reads RUNS_FOLDER/<letter>/<run>/probes.csv and RUNS_FOLDER/converged/probes.csv, as `make verify` leaves them, and
CODE_ASTER_FOLDER/<letter>_<run>.csv when it is there; writes PICTURES_FOLDER/sdnl140_<letter>.svg.
A run that stopped early is drawn as far as it went, a folder without a history is left out.
Needs Debian's python3-matplotlib and python3-numpy.
"""
import csv
import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

MILLISECOND = 1e-3
MILLIMETRE = 1e-3
END = 12
# The document's external reference: an order of magnitude from a book, with its own tolerance at 6 ms.
DOCUMENT = ((6, -150, 15), (12, -9, 0))
# No date and the same names each time: a figure changes when its numbers do.
METADATA = {"Date": None, "Creator": None, "Rights": "SPDX-License-Identifier: LGPL-3.0-or-later"}
matplotlib.rcParams.update({"svg.fonttype": "none", "svg.hashsalt": "sdnl140", "font.size": 9, "font.family": "sans-serif"})


def read_columns(path, time, deflection):
    """Time [ms] and deflection [mm] of a table; nothing when there is none, or nothing in it."""
    try:
        with open(path, newline="", encoding="utf-8") as file:
            rows = [(float(row[time]), float(row[deflection])) for row in csv.DictReader(file)]
    except (OSError, KeyError, TypeError, ValueError):
        return None
    return np.array(rows).T / [[MILLISECOND], [MILLIMETRE]] if rows else None


def runs_of(folder):
    found = {}
    for run in sorted(entry for entry in folder.iterdir() if entry.is_dir()):
        history = read_columns(run / "probes.csv", "t", "tip.y")
        if history is not None:
            found[run.name] = history
    return found


def draw_references(axes, converged, references):
    if converged is not None:
        axes.plot(*converged, color="#909090", linewidth=3, alpha=0.6, label="converged")
    for number, history in enumerate(references.values()):
        axes.plot(*history, "x", color="black", markersize=4, linewidth=0, label=None if number else "Code_Aster 15.1.21")
    for number, (t, y, tolerance) in enumerate(DOCUMENT):
        axes.errorbar(t, y, yerr=tolerance or None, fmt="D", color="#c00000", markersize=5, capsize=3, clip_on=False,
                      label=None if number else "document", zorder=5)


def draw_runs(axes, runs):
    styles = ("-", (0, (6, 2)), "-.", (0, (3, 1, 1, 1, 1, 1)), ":")
    for number, (name, (t, y)) in enumerate(runs.items()):
        stopped = "" if t[-1] > END - 1e-6 else f" (to {t[-1]:.3g} ms)"
        axes.plot(t, y, linestyle=styles[number % len(styles)], color=f"C{number}", linewidth=1.4, label=name + stopped)
        if stopped:
            axes.plot(t[-1], y[-1], "o", color=f"C{number}", markersize=4)


def draw_differences(axes, runs):
    """|run − first run| on a logarithmic scale, at the instants of the first run that both reached."""
    (first, (t, y)), *others = runs.items()
    for number, (_, (t_other, y_other)) in enumerate(others, start=1):
        common = (t > 0) & (t <= t_other[-1] + 1e-9)
        difference = np.abs(np.interp(t[common], t_other, y_other) - y[common])
        axes.semilogy(t[common], np.maximum(difference, 1e-12), ".-", color=f"C{number}", linewidth=1)
    axes.set_ylabel(f"|DY − {first}'s| [mm]")


def draw(letter, runs, converged, references, picture):
    count = 2 if len(runs) > 1 else 1
    figure, panels = plt.subplots(count, 1, figsize=(7.5, 4.2 + 2.2 * (count - 1)), sharex=True, squeeze=False,
                                  gridspec_kw={"height_ratios": [2, 1][:count]})
    panels = panels[:, 0]
    draw_references(panels[0], converged, references)
    draw_runs(panels[0], runs)
    panels[0].set_ylabel("deflection of the loaded end, DY [mm]")
    panels[0].set_title(f"SDNL140 {letter.upper()}", loc="left")
    panels[0].legend(frameon=False, fontsize=8, loc="upper center")
    if count > 1:
        draw_differences(panels[1], runs)
    for axes in panels:
        axes.grid(color="#d8d8d8", linewidth=0.5)
        for side in ("top", "right"):
            axes.spines[side].set_visible(False)
    panels[-1].set_xlabel("t [ms]")
    panels[-1].set_xlim(0, END)
    figure.savefig(picture, bbox_inches="tight", pad_inches=0.08, metadata=METADATA)
    plt.close(figure)


def main(folder, pictures, code_aster):
    converged = read_columns(folder / "converged" / "probes.csv", "t", "tip.y")
    drawn = 0
    for modeling in sorted(entry for entry in folder.iterdir() if entry.is_dir() and len(entry.name) == 1):
        runs = runs_of(modeling)
        if not runs:
            continue
        tables = {name: read_columns(code_aster / f"{modeling.name}_{name}.csv", "t", "dy") for name in runs} if code_aster else {}
        references = {name: history for name, history in tables.items() if history is not None}
        draw(modeling.name, runs, converged, references, pictures / f"sdnl140_{modeling.name}.svg")
        drawn += 1
    if drawn == 0:
        sys.exit(f"{folder}: found no runs, expected what `make verify` leaves there")


if __name__ == "__main__":
    if len(sys.argv) not in (3, 4) or not Path(sys.argv[1]).is_dir():
        sys.exit(__doc__)
    main(Path(sys.argv[1]), Path(sys.argv[2]), Path(sys.argv[3]) if len(sys.argv) == 4 else None)
