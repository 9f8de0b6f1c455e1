# SPDX-License-Identifier: LGPL-3.0-or-later
"""LIRE_MAILLAGE, PRE_GMSH, PRE_GIBI: meshes from files. What a file is, is seen from its first bytes."""

from __future__ import annotations

import shutil
import subprocess
from pathlib import Path
from typing import Any

import rubato

from ..concepts import MeshConcept
from ..keys import Arguments, Command, CommandError, factor, harmless, integer, text, words
from ..mesh.gibi import read_gibi
from ..mesh.gmsh import read_gmsh
from ..mesh.mail_orders import with_orders
from ..mesh.pieces import numbered_as_read

MESH_UNIT, OTHER_UNIT = 20, 19
# A conversion of a mesh file takes no longer [s].
CONVERSION_LIMIT = 300

LIRE_MAILLAGE = {
    "FORMAT": words("MED", "ASTER", "GMSH", "GIBI", default="MED",
                    missing={"IDEAS": "Convert the file to MED."}),
    "UNITE": integer(), "NOM_MED": text(),
    "VERI_MAIL": factor({"VERIF": harmless(), "APLAT": harmless()}), "INFO": harmless(), "INFO_MED": harmless(),
    "ABSC_CURV": words("NON", missing={"OUI": ""}), "PARTITIONNEUR": harmless(),
}


def lire_maillage(session: Any, arguments: Arguments) -> MeshConcept:
    path = session.file_of(_unit(session, arguments), "LIRE_MAILLAGE/UNITE")
    try:
        return MeshConcept(_mesh_of(session, Path(path), arguments.NOM_MED or "").mended())
    except rubato.InputError as error:
        raise CommandError(f"LIRE_MAILLAGE: {error}") from error
    except OSError as error:
        raise CommandError(f"LIRE_MAILLAGE: {path}: the file cannot be read: {error.strerror}.") from error


def _unit(session: Any, arguments: Arguments) -> int:
    if arguments.given("UNITE"):
        return arguments.UNITE
    other = arguments.FORMAT in ("GMSH", "GIBI") and OTHER_UNIT in session.files
    return OTHER_UNIT if other else MESH_UNIT


# ---- by content ----------------------------------------------------------------------------------------------


def _mesh_of(session: Any, path: Path, name: str) -> Any:
    with path.open("rb") as file:
        head = file.read(4096)
    if head.startswith(b"\x89HDF"):
        return numbered_as_read(_med(session, path, name))
    first = head.lstrip()[:40].decode("latin-1").upper()
    if first.startswith("$NOD") or _is_old_gmsh(head):
        return read_gmsh(path)
    if first.startswith("ENREGISTREMENT DE TYPE"):
        return read_gibi(path)
    if first.startswith("$MESHFORMAT"):
        return rubato.read_mesh(path)
    path = _named(session, path, ".mail")
    return with_orders(rubato.read_mesh(path), path)


def _is_old_gmsh(head: bytes) -> bool:
    words_ = head.split()[:4]
    return len(words_) > 2 and words_[0].upper() == b"$MESHFORMAT" and words_[1].startswith(b"2") and words_[2] == b"0"


def _named(session: Any, path: Path, ending: str) -> Path:
    """The file, or a copy of it with the ending by which rubato knows its format."""
    if path.suffix.lower() == ending:
        return path
    copy = Path(session.folder) / f"{path.name}{ending}"
    shutil.copyfile(path, copy)
    return copy


def _med(session: Any, path: Path, name: str) -> Any:
    try:
        return rubato.read_mesh(path, name)
    except rubato.InputError as error:
        if "older than 3.0" not in str(error):
            raise
        program = shutil.which("medimport")
        if program is None:
            raise CommandError(f"LIRE_MAILLAGE: {path} is of MED version 2; the program medimport converts it, install "
                               "it (on Debian the package libmed-tools).") from error
    return rubato.read_mesh(_imported(session, program, path), name)


def _imported(session: Any, program: str, path: Path) -> Path:
    new = Path(session.folder).resolve() / f"{path.name}.med"
    new.unlink(missing_ok=True)
    try:
        done = subprocess.run([program, str(path.resolve()), str(new)], cwd=session.folder, capture_output=True,
                              text=True, errors="replace", timeout=CONVERSION_LIMIT, check=False)
    except (OSError, subprocess.TimeoutExpired) as error:
        raise CommandError(f"LIRE_MAILLAGE: medimport could not convert {path}: {error}.") from error
    # It begins with a copy of the file: what it leaves when it fails is of no use.
    if done.returncode or not new.exists():
        new.unlink(missing_ok=True)
        lines = [line.strip() for line in (done.stdout + done.stderr).splitlines() if line.strip()]
        raise CommandError(f"LIRE_MAILLAGE: medimport could not convert {path}: {lines[-1] if lines else 'no message'}")
    session.note(f"{path.name} is of MED version 2; medimport has converted it.")
    return new


# ---- files converted in between ------------------------------------------------------------------------------

PRE_GMSH = {"UNITE_GMSH": integer(OTHER_UNIT), "UNITE_MAILLAGE": integer(MESH_UNIT),
            "MODI_QUAD": words("NON", default="NON", missing={"OUI": "Write CREA_MAILLAGE/LINE_QUAD."}),
            "INFO": harmless()}
PRE_GIBI = {"UNITE_GIBI": integer(OTHER_UNIT), "UNITE_MAILLAGE": integer(MESH_UNIT), "INFO": harmless()}


def pre_gmsh(session: Any, arguments: Arguments) -> None:
    _pass_on(session, "PRE_GMSH/UNITE_GMSH", arguments.UNITE_GMSH, arguments.UNITE_MAILLAGE)


def pre_gibi(session: Any, arguments: Arguments) -> None:
    _pass_on(session, "PRE_GIBI/UNITE_GIBI", arguments.UNITE_GIBI, arguments.UNITE_MAILLAGE)


def _pass_on(session: Any, what: str, source: int, target: int) -> None:
    """LIRE_MAILLAGE reads the file as it is: no file has to be written in between."""
    session.files[target] = session.file_of(source, what)


COMMANDS = [
    Command("LIRE_MAILLAGE", LIRE_MAILLAGE, lire_maillage),
    Command("PRE_GMSH", PRE_GMSH, pre_gmsh),
    Command("PRE_GIBI", PRE_GIBI, pre_gibi),
]
