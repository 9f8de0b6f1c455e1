# SPDX-License-Identifier: LGPL-3.0-or-later
"""IMPR_RESU: fields and meshes written to files."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np

import rubato

from ..concepts import CellField, MeshConcept, NodalField, Result, Stored
from ..fields import field_of
from ..keys import (Arguments, Command, CommandError, Key, concept, factor, harmless, integer, real, text, texts, words,
                    yes, yes_no)
from ..selection import NODES, STATES, chosen_states
from .gmsh_output import WIDTHS, mesh_lines, view_lines
from .tables import write_lines

_FOREIGN = "MED, GMSH, ASTER and RESULTAT are."
ITEM: dict[str, Key] = {
    **STATES, **NODES, "RESULTAT": concept("Result"), "CHAM_GD": concept("NodalField", "CellField"),
    "MAILLAGE": concept("MeshConcept"), "NOM_CHAM": texts(), "NOM_CHAM_MED": texts(), "NOM_RESU_MED": text(),
    "TOUT_CHAM": yes_no(), "NOM_CMP": texts(), "TOUT_CMP": yes(), "VALE_MAX": yes(), "VALE_MIN": yes(),
    "TYPE_CHAM": words(*WIDTHS, default="SCALAIRE"), "BORNE_SUP": real(), "BORNE_INF": real(),
    "NUME_MODE": harmless(), "FREQ": harmless(),
    **{name: harmless() for name in ("INFO_MAILLAGE", "FORM_TABL", "IMPR_COOR", "PARTIE", "CARA_ELEM",
                                     "IMPR_NOM_VARI", "SOUS_TITRE", "TOUT_PARA", "NOM_PARA", "FORMAT_R", "SOUS_POINT",
                                     "CARTE", "RESTREINT")},
}
KEYS: dict[str, Key] = {
    "FORMAT": words("MED", "RESULTAT", "ASTER", "GMSH", default="MED", missing={
        name: _FOREIGN for name in ("IDEAS", "CASTEM", "ENSIGHT")}),
    "UNITE": integer(), "RESU": factor(ITEM), "CONCEPT": harmless(), "MODELE": harmless(),
    **{name: harmless() for name in ("VERSION", "VERSION_MED", "PROC0", "TYPE_CHAM", "RESTREINT", "INFO",
                                     "FICHIER_UNIQUE", "IMPR_NOM_VARI")},
}
UNITS = {"MED": 80, "RESULTAT": 8, "ASTER": 26, "GMSH": 37}
ENDINGS = {"MED": ".med", "RESULTAT": ".resu", "ASTER": ".mail", "GMSH": ".msh"}

Field = NodalField | CellField


def print_results(session: Any, arguments: Arguments) -> None:
    unit = arguments.UNITE if arguments.UNITE is not None else UNITS[arguments.FORMAT]
    for item in arguments.RESU:
        if arguments.FORMAT == "RESULTAT":
            write_lines(session, unit, list(listing(session, item)))
            continue
        path = session.output_of(unit, ENDINGS[arguments.FORMAT])
        if arguments.FORMAT == "ASTER":
            write_mesh_file(path, mesh_of(item))
        elif arguments.FORMAT == "GMSH":
            write_gmsh(session, path, item)
        else:
            write_med(session, path, item)


def mesh_of(item: Arguments) -> MeshConcept:
    for source in (item.MAILLAGE, item.RESULTAT and item.RESULTAT.mesh, item.CHAM_GD and item.CHAM_GD.mesh):
        if source:
            return source
    raise CommandError("IMPR_RESU/RESU: RESULTAT, CHAM_GD or MAILLAGE is missing.")


def write_mesh_file(path: Path, mesh: MeshConcept) -> None:
    """rubato chooses the format by the ending of the name, which a unit's file need not have."""
    temporary = path.with_name(path.name + ".mail")
    rubato.write_mesh(temporary, mesh.mesh)
    temporary.replace(path)


# ---- which fields ------------------------------------------------------------------------------------------------


def states_and_fields(session: Any, item: Arguments) -> Iterator[tuple[Stored | None, str, Field]]:
    """Each asked field at each asked state; of a field concept itself, without a state. Fields that are not available
    are told and left out: nothing is computed with what is written."""
    if item.CHAM_GD is not None:
        yield None, item.CHAM_GD.name, item.CHAM_GD
    if item.RESULTAT is None:
        return
    for stored in chosen_states(item.RESULTAT, item):
        for name in item.NOM_CHAM or usual_names(item.RESULTAT, stored):
            try:
                field = field_of(item.RESULTAT, stored, name)
            except CommandError as error:
                session.note(f"IMPR_RESU: {error}")
                continue
            yield stored, name, field


def usual_names(result: Result, stored: Stored) -> list[str]:
    """What the result has when no field is named: what was solved for, given, and computed by CALC_CHAMP."""
    names = list(stored.given)
    if stored.solved is not None:
        names.append("DEPL")
        names += ["VITE", "ACCE"] if stored.solved.dynamic else []
        names += result.calculated
    return list(dict.fromkeys(names))


# ---- MED ---------------------------------------------------------------------------------------------------------


def write_med(session: Any, path: Path, item: Arguments) -> None:
    """The mesh where the file is new, then the fields at nodes, an instant after the other. Fields have Code_Aster's
    names: that of the result in eight letters, and the field's."""
    mesh = mesh_of(item)
    name = (mesh.name or "mesh")[:64]
    if path not in session.written:
        rubato.write_med(path, mesh.mesh, name)
        session.written.add(path)
    for order, instant, fields in _by_state(session, item):
        values, components = {}, {}
        for label, field in fields.items():
            columns = _columns(field, item)
            values[label] = np.ascontiguousarray(np.nan_to_num(field.values[:, columns]))
            components[label] = [field.components[i] for i in columns]
        if values:
            rubato.write_med_fields(path, name, order, instant, values, [], components)


def _by_state(session: Any, item: Arguments) -> Iterator[tuple[int, float, dict[str, NodalField]]]:
    fields: dict[str, NodalField] = {}
    current: Stored | None = None
    for stored, name, field in states_and_fields(session, item):
        if stored is not current and fields:
            yield current.order if current else 0, current.instant if current else 0.0, fields
            fields = {}
        current = stored
        if isinstance(field, CellField):
            session.note(f"IMPR_RESU: {name} has its values in cells; fields at nodes are written to MED files.")
            continue
        fields[_label(item, name, stored)] = field
    if fields:
        yield current.order if current else 0, current.instant if current else 0.0, fields


def _label(item: Arguments, name: str, stored: Stored | None) -> str:
    if item.NOM_CHAM_MED:
        if item.CHAM_GD is None and len(item.NOM_CHAM_MED) == len(item.NOM_CHAM):
            return item.NOM_CHAM_MED[item.NOM_CHAM.index(name)]
        return item.NOM_CHAM_MED[0]
    if stored is None:
        return f"{name or 'field'}"
    return f"{(item.NOM_RESU_MED or item.RESULTAT.name or 'result')[:8]:_<8}{name}"


def _columns(field: Field, item: Arguments) -> list[int]:
    """Those of the asked components that the field has."""
    chosen = [field.components.index(name) for name in item.NOM_CMP if name in field.components]
    return chosen if item.NOM_CMP else list(range(len(field.components)))


def keep(session: Any, result: Result) -> Path:
    """Writes what there is of a result that could not be finished into the run folder."""
    path = session.folder / f"{result.name or 'result'}.med"
    keys = KEYS["RESU"].takes.keys  # type: ignore[union-attr]
    values = {name: () if key.many else key.default for name, key in keys.items()}
    write_med(session, path, Arguments({**values, "RESULTAT": result, "TOUT_ORDRE": "OUI"}, {"RESULTAT"}))
    return path


# ---- GMSH --------------------------------------------------------------------------------------------------------


def write_gmsh(session: Any, path: Path, item: Arguments) -> None:
    """Writes the mesh if the file is new, then the views of the fields."""
    lines = [] if path in session.written else list(mesh_lines(mesh_of(item)))
    for stored, name, field in states_and_fields(session, item):
        components = [field.components[i] for i in _columns(field, item)]
        if components:
            lines += view_lines(_label(item, name, stored), stored, field, components, item.TYPE_CHAM)
    with path.open("a" if path in session.written else "w", encoding="utf-8") as file:
        file.write("\n".join(lines) + "\n")
    session.written.add(path)


# ---- RESULTAT ----------------------------------------------------------------------------------------------------


def listing(session: Any, item: Arguments) -> Iterator[str]:
    for stored, name, field in states_and_fields(session, item):
        where = f" NUME_ORDRE {stored.order} INST {stored.instant:.6g}" if stored else ""
        yield f" FIELD {name}{where}"
        yield from (_extremes if item.VALE_MAX or item.VALE_MIN else _values)(field, item)


def _lines_of(field: Field, item: Arguments) -> Iterator[tuple[str, np.ndarray]]:
    """A label and the values of the asked components: of each node, or of each place of each cell."""
    columns = _columns(field, item)
    mesh = field.mesh
    anywhere = not any(item.get(name) for name in NODES)
    if isinstance(field, NodalField):
        nodes = np.arange(mesh.mesh.node_count) if anywhere else mesh.nodes(item)
        for node in nodes:
            if not np.all(np.isnan(field.values[node])):
                yield mesh.node_name(int(node)), field.values[node][columns]
        return
    cells = None if anywhere else set(mesh.cells(item).tolist())
    for part in field.parts:
        for cell, values in zip(part.cells, part.values):
            if cells is None or int(cell) in cells:
                for place, line in enumerate(values, 1):
                    yield f"{mesh.cell_name(int(cell))} {place}", line[columns]


def _values(field: Field, item: Arguments) -> Iterator[str]:
    names = [field.components[i] for i in _columns(field, item)]
    yield f" {'':<12}" + "".join(f" {name:<12}" for name in names)
    for label, line in _lines_of(field, item):
        inside = all((item.BORNE_SUP is None or value <= item.BORNE_SUP)
                     and (item.BORNE_INF is None or value >= item.BORNE_INF) for value in line if not np.isnan(value))
        if inside:
            yield f" {label:<12}" + "".join(f" {'-':<12}" if np.isnan(value) else f" {value:12.5E}" for value in line)


def _extremes(field: Field, item: Arguments) -> Iterator[str]:
    lines = list(_lines_of(field, item))
    for column, name in enumerate(field.components[i] for i in _columns(field, item)):
        there = [(line[column], label) for label, line in lines if not np.isnan(line[column])]
        for asked, word, best in ((item.VALE_MAX, "MAX", max), (item.VALE_MIN, "MIN", min)):
            if asked and there:
                value, label = best(there)
                yield f" {name:<12} {word} {value:12.5E} at {label}"


COMMANDS = [Command("IMPR_RESU", KEYS, print_results)]
