# SPDX-License-Identifier: LGPL-3.0-or-later
"""MACR_LIGN_COUPE, PROJ_CHAMP: fields along lines through a mesh, and on other meshes."""

from __future__ import annotations

from typing import Any

import numpy as np

from ..concepts import CellField, MeshConcept, NodalField, Result, Stored, TableConcept
from ..fields import field_of, nodal_mean
from ..frames import along_line, around_axis, turned
from ..keys import (Arguments, Command, CommandError, Key, concept, factor, harmless, integer, real, reals, text, texts,
                    words)
from ..location import Locator
from ..selection import STATES, chosen_states, column_of
from ..tables import Row
from .post_releve import abscissae, access, add_rows, mean_rows

LINE: dict[str, Key] = {
    "INTITULE": text(), "TYPE": words("SEGMENT", "ARC", "GROUP_NO", default="SEGMENT", missing={
        "GROUP_MA": "A group of nodes is: GROUP_NO."}),
    "NB_POINTS": integer(), "COOR_ORIG": reals(), "COOR_EXTR": reals(), "CENTRE": reals(), "ANGLE": real(),
    "DNOR": reals(), "GROUP_NO": text(), "NOM_CMP": texts(), "OPERATION": words("EXTRACTION", "MOYENNE",
                                                                               default="EXTRACTION"),
    "REPERE": words("GLOBAL", "LOCAL", "POLAIRE", "CYLINDRIQUE", default="GLOBAL", missing={"UTILISATEUR": ""}),
    "ORIGINE": reals(), "AXE_Z": reals(), "DISTANCE_MAX": real(0.0), "DISTANCE_ALARME": harmless(),
}
CUT: dict[str, Key] = {
    "RESULTAT": concept("Result"), "CHAM_GD": concept("NodalField", "CellField"), "NOM_CHAM": text(), **STATES,
    "MODELE": concept("ModelConcept"), "LIGN_COUPE": factor(LINE, required=True), "UNITE_MAILLAGE": harmless(),
    "INFO": harmless(), "TITRE": texts(),
}


def cut(session: Any, arguments: Arguments) -> TableConcept:
    table = TableConcept([], [], " ".join(arguments.TITRE))
    model = arguments.MODELE or (arguments.RESULTAT.model if arguments.RESULTAT else None)
    for field, head in _fields(arguments):
        nodal = field if isinstance(field, NodalField) else nodal_mean(field)
        cells = np.unique(np.concatenate([part.cells for part in model.parts])) if model else nodal.mesh.all_cells()
        locator = Locator(nodal.mesh, cells)
        for number, line in enumerate(arguments.LIGN_COUPE, 1):
            rows = _rows(nodal, locator, line, {"INTITULE": line.INTITULE or f"l.coupe{number}", **head})
            if not rows:
                raise CommandError("MACR_LIGN_COUPE: no point of a line is in the mesh.")
            add_rows(table, rows)
    return table


def _fields(arguments: Arguments) -> list[tuple[NodalField | CellField, Row]]:
    if (arguments.RESULTAT is None) == (arguments.CHAM_GD is None):
        raise CommandError("MACR_LIGN_COUPE: one of RESULTAT and CHAM_GD is needed.")
    if arguments.CHAM_GD is not None:
        return [(arguments.CHAM_GD, {"CHAM_GD": arguments.CHAM_GD.name})]
    name = arguments.NOM_CHAM or "SIGM_NOEU"
    return [(field_of(arguments.RESULTAT, stored, name),
             {"RESU": arguments.RESULTAT.name, "NOM_CHAM": name, **access(stored)})
            for stored in chosen_states(arguments.RESULTAT, arguments)]


def _rows(field: NodalField, locator: Locator, line: Arguments, head: Row) -> list[Row]:
    points = line_points(field.mesh, line)
    lengths = abscissae(points)
    values = np.full((len(points), len(field.components)), np.nan)
    for i, point in enumerate(points):
        place = locator.find(point, line.DISTANCE_MAX)
        if place is not None:
            # A component that one of the nodes lacks is not there.
            values[i] = place.shape @ field.values[place.nodes]
    found = ~np.all(np.isnan(values), axis=1)
    if not np.any(found):
        return []
    points, lengths = points[found], lengths[found]
    values = in_axes(field, values[found], points, line)
    names = line.NOM_CMP or field.components
    values = values[:, [column_of(field, name) for name in names]]
    if line.OPERATION == "MOYENNE":
        return mean_rows(names, lengths, values, head)
    return [{**head, "ABSC_CURV": float(s), **{f"COOR_{axis}": float(x) for axis, x in zip("XYZ", point)},
             **{name: float(value) for name, value in zip(names, row) if not np.isnan(value)}}
            for s, point, row in zip(lengths, points, values)]


def line_points(mesh: MeshConcept, line: Arguments) -> np.ndarray:
    if line.TYPE == "GROUP_NO":
        return np.array(np.asarray(mesh.mesh.points)[mesh.nodes_in(line.GROUP_NO)])
    if line.NB_POINTS is None or line.NB_POINTS < 2 or not line.COOR_ORIG:
        raise CommandError("MACR_LIGN_COUPE: NB_POINTS of at least 2 and COOR_ORIG are needed.")
    first = _three(line.COOR_ORIG)
    shares = np.linspace(0, 1, line.NB_POINTS)
    if line.TYPE == "SEGMENT":
        return first + np.outer(shares, _three(line.COOR_EXTR) - first)
    centre, axis = _three(line.CENTRE), _three(line.DNOR) if line.DNOR else np.array([0.0, 0.0, 1.0])
    axis = axis / np.linalg.norm(axis)
    arm = first - centre
    angles = np.radians((line.ANGLE or 0.0) * shares)[:, None]
    along = (arm @ axis) * axis
    return centre + along + np.cos(angles) * (arm - along) + np.sin(angles) * np.cross(axis, arm)


def _three(given: tuple[float, ...]) -> np.ndarray:
    return np.array((*given, 0.0, 0.0, 0.0)[:3])


def in_axes(field: NodalField, values: np.ndarray, points: np.ndarray, line: Arguments) -> np.ndarray:
    if line.REPERE == "GLOBAL":
        return values
    if line.REPERE == "LOCAL":
        if field.mesh.dimension != 2:
            raise CommandError("MACR_LIGN_COUPE/REPERE: LOCAL is available in the plane.")
        return turned(field.components, values, along_line(points))
    origin = line.ORIGINE or line.CENTRE
    axis = line.AXE_Z or line.DNOR or (0.0, 0.0, 1.0)
    return turned(field.components, values, around_axis(points, _three(origin), _three(axis)))


# ---- PROJ_CHAMP --------------------------------------------------------------------------------------------------

PROJECT: dict[str, Key] = {
    "METHODE": words("COLLOCATION", "AUTO", default="AUTO", missing={name: "" for name in (
        "ECLA_PG", "COUPLAGE", "NUAGE_DEG_0", "NUAGE_DEG_1", "SOUS_POINT")}),
    "CHAM_GD": concept("NodalField", "CellField"), "RESULTAT": concept("Result"), "NOM_CHAM": texts(),
    "MODELE_1": concept("ModelConcept"), "MODELE_2": concept("ModelConcept"), "MAILLAGE_1": concept("MeshConcept"),
    "MAILLAGE_2": concept("MeshConcept"), **STATES, "DISTANCE_MAX": real(), "TOUT_CHAM": words("OUI"),
    "DISTANCE_ALARME": harmless(), "ALARME": harmless(), "INFO": harmless(), "TITRE": harmless(),
    "PROL_ZERO": words("NON", default="NON", missing={"OUI": ""}), "TYPE_CHAM": words("NOEU"),
}


def project(session: Any, arguments: Arguments) -> Result | NodalField:
    """Nodes of the second mesh take the values in the cells of the first that have them; outside the nearest cell."""
    mesh = arguments.MAILLAGE_2 or (arguments.MODELE_2.mesh if arguments.MODELE_2 else None)
    if mesh is None:
        raise CommandError("PROJ_CHAMP: MODELE_2 or MAILLAGE_2 is missing.")
    source = arguments.CHAM_GD.mesh if arguments.CHAM_GD is not None else arguments.RESULTAT and arguments.RESULTAT.mesh
    if source is None:
        raise CommandError("PROJ_CHAMP: CHAM_GD or RESULTAT is missing.")
    model = arguments.MODELE_1
    cells = np.unique(np.concatenate([part.cells for part in model.parts])) if model else source.all_cells()
    places = _places(Locator(source, cells), np.asarray(mesh.mesh.points), arguments.DISTANCE_MAX)
    if arguments.CHAM_GD is not None:
        return projected(arguments.CHAM_GD, mesh, places)
    names = arguments.NOM_CHAM or ("DEPL",)
    made = Result(arguments.RESULTAT.kind, mesh, arguments.MODELE_2)
    for stored in chosen_states(arguments.RESULTAT, arguments):
        given = {name: projected(field_of(arguments.RESULTAT, stored, name), mesh, places) for name in names}
        made.stored.append(Stored(stored.order, stored.instant, given=given))
    return made


def _places(locator: Locator, points: np.ndarray, reach: float | None) -> list[Any]:
    if reach is None:
        reach = float(np.max(np.ptp(locator.points, axis=0)))
    return [locator.find(point, reach) for point in points]


def projected(field: NodalField | CellField, mesh: MeshConcept, places: list[Any]) -> NodalField:
    if isinstance(field, CellField):
        raise CommandError("PROJ_CHAMP: fields in cells are not available; fields at nodes are.")
    values = np.full((len(places), len(field.components)), np.nan)
    for i, place in enumerate(places):
        if place is not None:
            values[i] = place.shape @ field.values[place.nodes]
    return NodalField(mesh, field.quantity, field.components, values)


COMMANDS = [Command("MACR_LIGN_COUPE", CUT, cut), Command("PROJ_CHAMP", PROJECT, project)]
