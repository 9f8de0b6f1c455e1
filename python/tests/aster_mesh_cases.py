# SPDX-License-Identifier: LGPL-3.0-or-later
"""What the tests of meshes share: a session, a small mesh, and what it is like."""

from __future__ import annotations

import rubato
from rubato.aster.commands import mesh_changes, mesh_files, mesh_groups
from rubato.aster.concepts import MeshConcept
from rubato.aster.keys import CommandError, check

COMMANDS = {row.name: row for module in (mesh_changes, mesh_files, mesh_groups) for row in module.COMMANDS}


class Session:
    """What mesh commands ask of a session."""

    def __init__(self, folder, files=None):
        self.folder = folder
        self.files = dict(files or {})
        self.notes = []
        self.made = {}

    def file_of(self, unit, what):
        if unit not in self.files:
            raise CommandError(f"unit {unit} ({what}) has no file")
        return self.files[unit]

    def note(self, text):
        self.notes.append(text)

    def new_concept(self, co, made):
        self.made[co.name] = made


def call(session, name, **given):
    return COMMANDS[name].run(session, check(COMMANDS[name], given))


# Two squares side by side, with their left and upper sides:
#   D--E--F
#   A--B--C
SQUARES = """TITRE
 two squares
FINSF
COOR_2D
 A 0. 0.
 B 1.D0 0.
 C 2. 0.
 D 0. 1.
 E 1. 1.
 F 2. 1.
FINSF
QUAD4
 K1 A B E D
 K2 B C F E
FINSF
SEG2
 S1 F E
 S2 D E
 S3 A D
FINSF
GROUP_MA
 BODY K1 K2
FINSF
GROUP_MA NOM=UPPER
 S1 S2
FINSF
GROUP_MA
 LEFT S3
FINSF
GROUP_NO
 CORNERS F A
FINSF
FIN
"""


def two_squares(session: Session) -> MeshConcept:
    path = session.folder / "squares.20"
    path.write_text(SQUARES)
    session.files[20] = path
    return call(session, "LIRE_MAILLAGE", FORMAT="ASTER")


def names(mesh, nodes):
    return [mesh.node_name(int(node)) for node in nodes]


def groups(mesh, *wanted):
    return [names(mesh, mesh.nodes_in(name)) for name in wanted]


def cell_names(mesh, group):
    return [mesh.cell_name(int(cell)) for cell in mesh.cells_in(group)]


def nodes_of(mesh, cell):
    return names(mesh, mesh.nodes_of_cell(mesh.cell_named(cell)))


def med_of(tmp_path, mesh, ending=".mmed"):
    path = tmp_path / "mesh.med"
    rubato.write_mesh(path, mesh)
    return path.rename(tmp_path / f"other{ending}")
