# SPDX-License-Identifier: LGPL-3.0-or-later
"""SDNL140 by command files: the numbers of the decks, for every modeling and algorithm."""

from __future__ import annotations

import csv
import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

SOURCE = Path(os.environ["RUBATO_SOURCE_DIR"])
PROGRAM = os.environ["RUBATO_PROGRAM"]
HERE = SOURCE / "tests" / "aster" / "sdnl140"
RUNS = 5


def call(*words: object, folder: Path) -> str:
    done = subprocess.run([str(word) for word in words], cwd=folder, text=True, capture_output=True, timeout=600,
                          check=False)
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


def from_deck(modeling: str, folder: Path) -> dict[tuple[int, float], float]:
    """DY of the tip by run and instant; runs but the first to 1 ms. Command files have Code_Aster's normals beyond the
    border of a face, which decks of plane faces need not ask for: rounding there grows to 1.2e-12 in modeling E."""
    settings = ["--set", "checks=~", "--set", "fields=~", "--set", "contact.interface.clamped_normal=code_aster"]
    for run in range(1, RUNS + 1):
        settings += ["--set", f"runs.evol{run}.checks=~"]
        if run > 1 or modeling == "b":
            settings += ["--set", f"runs.evol{run}.time.end=1e-3"]
    call(PROGRAM, "run", SOURCE / "cases" / "sdnl140" / f"{modeling}.yaml", "-q", "-o", folder / "deck", *settings,
         folder=folder)
    values = {}
    for run in range(1, RUNS + 1):
        with open(folder / "deck" / f"evol{run}" / "probes.csv", encoding="ascii") as file:
            for row in csv.DictReader(file):
                values[run, round(float(row["t"]), 9)] = float(row["tip.y"])
    return values


def from_commands(modeling: str, folder: Path) -> dict[tuple[int, float], float]:
    with open(folder / "run" / "history.csv", encoding="ascii") as file:
        return {(int(run), round(float(t), 9)): float(value) for run, t, value in csv.reader(file)}


def make_study(modeling: str, folder: Path) -> Path:
    convert = ["--set", "mesh.convert=none"] if modeling == "d" else []
    call(PROGRAM, "mesh", SOURCE / "cases" / "sdnl140" / f"{modeling}.yaml", folder / "beams.med", *convert,
         folder=folder)
    export = folder / "study.export"
    for name in (f"{modeling}.comm", "beams.comm"):
        shutil.copy(HERE / name, folder)
    export.write_text(f"P time_limit 120\nF comm {modeling}.comm D 1\nF mmed beams.med D 20\nF libr beams.comm D 38\n")
    return export


@pytest.mark.parametrize("modeling", "abcdef")
def test_command_files_give_the_numbers_of_the_decks(modeling, tmp_path):
    printed = call(sys.executable, "-m", "rubato.aster", make_study(modeling, tmp_path), "-o", "run", folder=tmp_path)
    assert "\nNOOK" not in printed
    commands, deck = from_commands(modeling, tmp_path), from_deck(modeling, tmp_path)
    assert len(commands) == (2 if modeling == "b" else 13) + 4 * 2
    assert commands.keys() == deck.keys()
    peak = max(abs(value) for value in deck.values())
    worst = max(abs(commands[key] - deck[key]) for key in deck)
    assert worst <= 1e-12 * peak
