# SPDX-License-Identifier: LGPL-3.0-or-later
"""Studies: an .export file, or command files alone with meshes beside them."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path

from .session import StudyFailed

# Kinds of files that have nothing to do here.
UNUSED = ("datg", "mess", "resu", "base", "bhdf", "mess", "rmed", "repe", "erre", "nom", "para", "unv")
MESH_KINDS = {"mmed": 20, "mail": 20, "msh": 19, "mgib": 19, "mast": 20}
MESH_ENDINGS = {".mmed": 20, ".med": 20, ".mail": 20, ".msh": 19, ".mgib": 19}


@dataclass
class StudyFiles:
    """Command files in their order; files by unit; limits that the study itself has [s, MB]."""

    commands: list[Path] = field(default_factory=list)
    units: dict[int, Path] = field(default_factory=dict)
    outputs: dict[int, Path] = field(default_factory=dict)
    time_limit: float | None = None
    memory_limit: float | None = None


def read_study(path: Path) -> StudyFiles:
    """Of an .export file, or of a command file: then its further stages (.com1 …) and files of the same name with the
    ending of a mesh belong to it. Raises StudyFailed."""
    if not path.is_file():
        raise StudyFailed(f"{path}: there is no such file.")
    return read_export(path) if path.suffix == ".export" else beside(path)


def beside(path: Path) -> StudyFiles:
    study = StudyFiles([path])
    study.commands += sorted(path.parent.glob(f"{path.stem}.com[1-9]"))
    for ending, unit in MESH_ENDINGS.items():
        mesh = path.with_suffix(ending)
        if mesh.is_file():
            study.units.setdefault(unit, mesh)
    for number in range(10, 100):
        numbered = path.with_suffix(f".{number}")
        if numbered.is_file():
            study.units[number] = numbered
    return study


def read_export(path: Path) -> StudyFiles:
    """Lines `P key value` and `F kind file D|R unit`; what is unknown there does not matter."""
    study = StudyFiles()
    for number, line in enumerate(path.read_text(errors="replace").splitlines(), 1):
        parts = line.split()
        if len(parts) >= 3 and parts[0] == "P":
            read_parameter(study, path, number, parts[1], parts[2])
        elif len(parts) >= 4 and parts[0] == "F":
            read_file(study, path, number, parts)
    if not study.commands:
        raise StudyFailed(f"{path}: there is no command file (a line `F comm …`) in it.")
    return study


def read_parameter(study: StudyFiles, path: Path, number: int, key: str, value: str) -> None:
    if key not in ("time_limit", "memory_limit"):
        return
    try:
        setattr(study, key, float(value))
    except ValueError:
        raise StudyFailed(f"{path}:{number}: expected a number for {key}, found {value!r}.") from None


def read_file(study: StudyFiles, path: Path, number: int, parts: list[str]) -> None:
    kind, name, way = parts[1], parts[2], parts[3]
    unit = parts[4] if len(parts) > 4 else "0"
    if not unit.lstrip("-").isdigit():
        raise StudyFailed(f"{path}:{number}: expected the number of a unit, found {unit!r}.")
    file = path.parent / name
    if "R" in way and "D" not in way:
        study.outputs[int(unit)] = Path(Path(name).name)
        return
    if kind == "comm":
        require(file, path, number)
        study.commands.append(file)
    elif kind not in UNUSED or int(unit) > 1:
        require(file, path, number)
        study.units[int(unit) or MESH_KINDS.get(kind, 20)] = file


def require(file: Path, path: Path, number: int) -> None:
    if not file.exists():
        raise StudyFailed(f"{path}:{number}: there is no file {file}.")
