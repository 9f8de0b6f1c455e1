# SPDX-License-Identifier: LGPL-3.0-or-later
"""DEFI_GROUP: groups of nodes and of cells."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from ..concepts import MeshConcept
from ..keys import Arguments, Command, CommandError, anything, concept, factor, harmless, integer, real, reals
from ..keys import text, texts, words, yes
from ..mesh import select
from ..mesh.cells import KINDS, in_block, kind_of

# ---- what is there -------------------------------------------------------------------------------------------

_SETS = ("INTERSEC", "UNION", "DIFFE")
_PLACE = {"POINT": reals(), "NOEUD_CENTRE": text(), "GROUP_NO_CENTRE": text()}
_AXIS = {"ANGL_NAUT": reals(), "VECT_NORMALE": reals()}

NODE_OPTIONS: dict[str, Callable[[str, MeshConcept, Arguments], np.ndarray]] = {
    "NOEUD_ORDO": select.along_line, "SEGM_DROI_ORDO": select.along_segment, "PLAN": select.on_plane,
    "ENV_SPHERE": select.on_sphere, "ENV_CYLINDRE": select.on_cylinder,
    "INTERVALLE_VALE": lambda path, mesh, where: _by_value(path, mesh, where),
}
CELL_OPTIONS: dict[str, Callable[[str, MeshConcept, Arguments], np.ndarray]] = {
    "SPHERE": select.in_sphere, "CYLINDRE": select.in_cylinder, "BANDE": select.in_band,
    "FACE_NORMALE": select.facing, "APPUI": select.on_nodes,
}
# Keywords that an option cannot do without.
NEEDED = {
    "NOEUD_ORDO": ("GROUP_MA",), "SEGM_DROI_ORDO": ("PRECISION", "CRITERE"), "PLAN": ("PRECISION",),
    "ENV_SPHERE": ("RAYON", "PRECISION"), "ENV_CYLINDRE": ("RAYON", "PRECISION"),
    "INTERVALLE_VALE": ("CHAM_GD", "NOM_CMP", "VALE"),
    "SPHERE": ("RAYON",), "CYLINDRE": ("RAYON",), "BANDE": ("DIST",),
}
_MISSING_NODE_OPTIONS = {"TUNNEL": "", "INCLUSION": "", "FISS_XFEM": "", "RELA_CINE_BP": ""}

CREA_GROUP_NO = {
    "NOM": texts(), "TOUT_GROUP_MA": yes(), "GROUP_MA": texts(), "GROUP_NO": texts(), "NOEUD": texts(),
    **{name: texts() for name in _SETS},
    "CRIT_NOEUD": words("TOUS", "SOMMET", "MILIEU", "CENTRE", default="TOUS"),
    "POSITION": words("INIT", "FIN", "MILIEU"), "NUME_INIT": integer(), "NUME_FIN": integer(),
    "OPTION": words(*NODE_OPTIONS, missing=_MISSING_NODE_OPTIONS), **_PLACE, **_AXIS,
    "RAYON": real(), "PRECISION": real(), "CRITERE": words("RELATIF", "ABSOLU"),
    "NOEUD_ORIG": text(), "GROUP_NO_ORIG": text(), "NOEUD_EXTR": text(), "GROUP_NO_EXTR": text(),
    "VECT_ORIE": reals(), "ORIGINE": words("SANS"),
    "CHAM_GD": concept("NodalField"), "NOM_CMP": text(), "VALE": reals(),
}
CREA_GROUP_MA = {
    "NOM": text(required=True), "TOUT": yes(), "GROUP_MA": texts(), "MAILLE": texts(),
    **{name: texts() for name in _SETS},
    "TYPE_MAILLE": words("TOUT", "1D", "2D", "3D", *(kind.aster for kind in KINDS.values()), default="TOUT",
                         missing={"SEG4": ""}),
    "POSITION": words("INIT", "FIN", "MILIEU"), "NUME_INIT": integer(), "NUME_FIN": integer(),
    "OPTION": words(*CELL_OPTIONS, missing={"FISS_XFEM": ""}), **_PLACE, **_AXIS,
    "RAYON": real(), "DIST": real(), "CRIT_NOEUD": words("AU_MOINS_UN", "TOUS", "MAJORITE", default="AU_MOINS_UN"),
    "ANGL_PREC": real(0.5), "VERI_SIGNE": words("OUI", "NON", default="OUI"),
    "NOEUD": texts(), "GROUP_NO": texts(), "TYPE_APPUI": words("AU_MOINS_UN", "TOUT", "SOMMET", "MAJORITE"),
}
DEFI_GROUP = {
    "reuse": anything(), "MAILLAGE": concept("MeshConcept", required=True),
    "CREA_GROUP_NO": factor(CREA_GROUP_NO), "CREA_GROUP_MA": factor(CREA_GROUP_MA),
    "DETR_GROUP_NO": factor({"NOM": texts(required=True)}), "DETR_GROUP_MA": factor({"NOM": texts(required=True)}),
    "ALARME": harmless(), "INFO": harmless(),
}


def defi_group(session: Any, arguments: Arguments) -> MeshConcept:
    mesh = arguments.MAILLAGE
    for item in arguments.DETR_GROUP_MA:
        _delete(session, mesh, "cell_groups", item.NOM)
    for item in arguments.DETR_GROUP_NO:
        _delete(session, mesh, "node_groups", item.NOM)
    for item in arguments.CREA_GROUP_MA:
        _create_cells(session, mesh, item)
    for item in arguments.CREA_GROUP_NO:
        _create_nodes(session, mesh, item)
    return mesh


# ---- groups are made and deleted -----------------------------------------------------------------------------


def _delete(session: Any, mesh: MeshConcept, kind: str, names: tuple[str, ...]) -> None:
    for name in names:
        if name not in getattr(mesh.mesh, kind):
            session.note(f"DEFI_GROUP: there is no group {name!r} to delete.")
            continue
        other = "node_groups" if kind == "cell_groups" else "cell_groups"
        kept = getattr(mesh.mesh, other).get(name)
        mesh.replace(mesh.mesh.without_group(name))
        # The group of the other kind that shares the name stays.
        if kept is not None:
            _put(mesh, other, name, kept)


def _put(mesh: MeshConcept, kind: str, name: str, items: np.ndarray) -> None:
    items = np.asarray(items, dtype=np.int32)
    if kind == "cell_groups":
        mesh.replace(mesh.mesh.with_cell_group(name, items))
    else:
        in_order = len(items) > 1 and np.min(np.diff(items)) < 0
        mesh.replace(mesh.mesh.with_node_group(name, items, ordered=bool(in_order)))


def _new(session: Any, mesh: MeshConcept, kind: str, name: str, items: np.ndarray) -> None:
    """A group that must not be there yet; a group of nothing is not made."""
    if name in getattr(mesh.mesh, kind):
        what = "cells" if kind == "cell_groups" else "nodes"
        raise CommandError(f"DEFI_GROUP/NOM: there is already a group of {what} {name!r}.")
    once = _each_once(items)
    if len(once) < len(items):
        session.note(f"DEFI_GROUP: the group {name!r} begins and ends at one node, which it has once.")
    if len(once):
        _put(mesh, kind, name, once)
    else:
        session.note(f"DEFI_GROUP: the group {name!r} would be empty, it is not made.")


def _check_option(path: str, where: Arguments) -> None:
    for name in NEEDED.get(where.OPTION, ()):
        if not where.given(name):
            raise CommandError(f"{path}: OPTION={where.OPTION!r} needs the keyword {name}.")


def _chosen(path: str, where: Arguments, names: tuple[str, ...]) -> str:
    given = [name for name in names if where.given(name)]
    if len(given) != 1:
        raise CommandError(f"{path}: expected one of {', '.join(names)}, or OPTION.")
    return given[0]


# ---- nodes ---------------------------------------------------------------------------------------------------


def _create_nodes(session: Any, mesh: MeshConcept, where: Arguments) -> None:
    path = "DEFI_GROUP/CREA_GROUP_NO"
    if where.OPTION:
        _check_option(path, where)
        _new(session, mesh, "node_groups", _one_name(path, where), NODE_OPTIONS[where.OPTION](path, mesh, where))
        return
    way = _chosen(path, where, ("TOUT_GROUP_MA", "GROUP_MA", "GROUP_NO", "NOEUD", *_SETS))
    if way in ("TOUT_GROUP_MA", "GROUP_MA"):
        _nodes_of_groups(session, mesh, where, path)
        return
    if way == "NOEUD":
        nodes = mesh.nodes(where)
    elif way == "GROUP_NO":
        nodes = _part(path, mesh.nodes_in(_single(path, where.GROUP_NO)), where)
    else:
        nodes = _combined(way, [mesh.nodes_in(name) for name in getattr(where, way)])
    _new(session, mesh, "node_groups", _one_name(path, where), nodes)


def _one_name(path: str, where: Arguments) -> str:
    if len(where.NOM) != 1:
        raise CommandError(f"{path}/NOM: expected one name, found {len(where.NOM)}.")
    return where.NOM[0]


def _single(path: str, names: tuple[str, ...]) -> str:
    if len(names) != 1:
        raise CommandError(f"{path}: expected one group, found {len(names)}.")
    return names[0]


def _nodes_of_groups(session: Any, mesh: MeshConcept, where: Arguments, path: str) -> None:
    groups = tuple(mesh.mesh.cell_groups) if where.TOUT_GROUP_MA else where.GROUP_MA
    if len(where.NOM) not in (0, 1, len(groups)):
        raise CommandError(f"{path}/NOM: expected {len(groups)} names, found {len(where.NOM)}.")
    parts = [select.nodes_of_cells(mesh, mesh.cells_in(group), where.CRIT_NOEUD) for group in groups]
    names = where.NOM or groups
    if len(names) < len(parts):
        parts = [_combined("UNION", parts)]
    for name, nodes in zip(names, parts):
        # Code_Aster keeps a group that is there, for these two keywords only.
        if name in mesh.mesh.node_groups:
            session.note(f"DEFI_GROUP: the group of nodes {name!r} is there already, it stays as it is.")
        elif len(nodes):
            _put(mesh, "node_groups", name, nodes)


def _by_value(path: str, mesh: MeshConcept, where: Arguments) -> np.ndarray:
    """Nodes at which a component of a field is in a range."""
    if len(where.VALE) != 2:
        raise CommandError(f"{path}/VALE: expected 2 numbers, found {len(where.VALE)}.")
    values = where.CHAM_GD.column(where.NOM_CMP)
    return np.flatnonzero((values >= where.VALE[0]) & (values <= where.VALE[1]))


# ---- cells ---------------------------------------------------------------------------------------------------


def _create_cells(session: Any, mesh: MeshConcept, where: Arguments) -> None:
    path = "DEFI_GROUP/CREA_GROUP_MA"
    if where.OPTION:
        _check_option(path, where)
        cells = CELL_OPTIONS[where.OPTION](path, mesh, where)
    else:
        way = _chosen(path, where, ("TOUT", "GROUP_MA", "MAILLE", *_SETS))
        if way in _SETS:
            cells = _combined(way, [mesh.cells_in(name) for name in getattr(where, way)])
        elif way == "GROUP_MA":
            cells = _part(path, mesh.cells_in(_single(path, where.GROUP_MA)), where)
        else:
            cells = mesh.cells(where)
    _new(session, mesh, "cell_groups", where.NOM, _of_type(mesh, cells, where.TYPE_MAILLE))


def _of_type(mesh: MeshConcept, cells: np.ndarray, wanted: str) -> np.ndarray:
    if wanted == "TOUT":
        return cells
    kept = np.zeros(mesh.mesh.cell_count, dtype=bool)
    for block in mesh.mesh.blocks:
        kind = kind_of(block)
        if wanted in (kind.aster, f"{kind.dimension}D"):
            kept[in_block(block, cells) + block.first] = True
    return cells[kept[cells]]


# ---- sets ----------------------------------------------------------------------------------------------------


def _combined(way: str, parts: list[np.ndarray]) -> np.ndarray:
    """In the order of the first set, then of the next ones."""
    whole = _each_once(parts[0])
    for part in parts[1:]:
        if way == "UNION":
            whole = np.concatenate([whole, _each_once(part[~np.isin(part, whole)])])
        else:
            whole = whole[np.isin(whole, part) == (way == "INTERSEC")]
    return whole


def _each_once(items: np.ndarray) -> np.ndarray:
    _, first = np.unique(items, return_index=True)
    return items[np.sort(first)]


def _part(path: str, items: np.ndarray, where: Arguments) -> np.ndarray:
    """POSITION, or NUME_INIT to NUME_FIN, counted from 1; else the whole."""
    if where.POSITION:
        place = {"INIT": 0, "FIN": len(items) - 1, "MILIEU": (len(items) + 1) // 2 - 1}[where.POSITION]
        return items[place:place + 1]
    first = 1 if where.NUME_INIT is None else where.NUME_INIT
    last = len(items) if where.NUME_FIN is None else where.NUME_FIN
    if not 1 <= first <= last <= len(items):
        raise CommandError(f"{path}: expected NUME_INIT and NUME_FIN within 1 to {len(items)}, found {first} to "
                           f"{last}.")
    return items[first - 1:last]


COMMANDS = [Command("DEFI_GROUP", DEFI_GROUP, defi_group)]
