# SPDX-License-Identifier: LGPL-3.0-or-later
"""The studies of this folder, each by a program of its own: all their checks hold."""

from __future__ import annotations

import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

import meshes

HERE = Path(__file__).parent
# Files that another one of the folder executes.
PARTS = re.compile(r"\.com[1-9]$")


def studies() -> list[str]:
    """The .export files, and the .comm files that belong to none."""
    exports = sorted(HERE.glob("*.export"))
    listed = {line.split()[2] for path in exports for line in path.read_text().splitlines()
              if line.startswith("F ")}
    return [path.name for path in exports] + sorted(path.name for path in HERE.glob("*.comm") if path.name not in listed)


def files_of(study: str) -> list[str]:
    """The study's files, without itself: those that the .export names, or those of the same name."""
    if study.endswith(".export"):
        return [line.split()[2] for line in (HERE / study).read_text().splitlines()
                if line.startswith("F ") and "D" in line.split()[3]]
    stem = Path(study).stem
    beside = [path.name for path in HERE.glob(f"{stem}.*") if path.name != study]
    return beside + [name for name in meshes.MESHES if Path(name).stem == stem]


def prepare(study: str, folder: Path) -> Path:
    """A copy of the study in a folder of its own, with its meshes."""
    for name in [study, *files_of(study)]:
        if name in meshes.MESHES:
            meshes.write(folder, [name])
        else:
            shutil.copy(HERE / name, folder / name)
    return folder / study


def run(path: Path) -> subprocess.CompletedProcess[str]:
    return subprocess.run([sys.executable, "-m", "rubato.aster", path.name, "-o", "run"], cwd=path.parent,
                          capture_output=True, text=True, check=False)
