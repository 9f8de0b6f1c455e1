# SPDX-License-Identifier: LGPL-3.0-or-later
"""CREA_CHAMP: fields made of results, meshes, values, formulas and other fields."""

from __future__ import annotations

from typing import Any

import numpy as np

from ..concepts import CellField, CellPart, Function, MeshConcept, NodalField, TableConcept
from ..fields import field_of, geometry, in_cells, nodal_mean
from ..keys import (Arguments, Command, CommandError, Key, concept, factor, harmless, integer, real, reals, text, texts,
                    words, yes, yes_no)
from ..mesh_parts import blocks_with
from ..normals import nodal_normals
from ..selection import NODES, chosen_states, one_state
from ..shapes import DIMENSIONS, gauss_points, reference_nodes

FIELDS = ("NodalField", "CellField")
KEYS: dict[str, Key] = {
    "TYPE_CHAM": text(required=True),
    "OPERATION": words("EXTR", "AFFE", "ASSE", "COMB", "EVAL", "DISC", "NORMALE", required=True, missing={
        "R2C": "There are no complex fields.", "C2R": "There are no complex fields.", "ASSE_DEPL": ""}),
    "MAILLAGE": concept("MeshConcept"),
    "MODELE": concept("ModelConcept"),
    # EXTR
    "RESULTAT": concept("Result"), "TABLE": concept("TableConcept"), "NOM_CHAM": text(), "NUME_ORDRE": integer(),
    "INST": real(), "TOUT_ORDRE": yes(), "LIST_INST": concept("RealList"),
    "CRITERE": words("RELATIF", "ABSOLU", default="RELATIF"), "PRECISION": real(1e-6),
    "INTERPOL": words("NON", default="NON", missing={"LIN": "States are taken at their instants."}),
    "TYPE_MAXI": words("MAXI", "MINI", "MAXI_ABS", "MINI_ABS", "NORM_TRAN"), "TYPE_RESU": words("VALE", "INST"),
    # AFFE
    "AFFE": factor({**NODES, "NOM_CMP": texts(required=True), "VALE": reals(), "VALE_I": reals(),
                    "VALE_F": concept("Function", many=True)}),
    # ASSE
    "ASSE": factor({**NODES, "CHAM_GD": concept(*FIELDS, required=True), "NOM_CMP": texts(), "NOM_CMP_RESU": texts(),
                    "CUMUL": yes_no("NON"), "COEF_R": real(1.0)}),
    # COMB
    "COMB": factor({"CHAM_GD": concept(*FIELDS, required=True), "COEF_R": real(required=True)}),
    # EVAL, DISC, NORMALE
    "CHAM_F": concept(*FIELDS), "CHAM_PARA": concept(*FIELDS, many=True), "CHAM_GD": concept(*FIELDS),
    "GROUP_MA": texts(), "MAILLE": texts(),
    "OPTION": harmless(), "PROL_ZERO": yes_no("NON"), "NUME_DDL": harmless(), "CHAM_NO": harmless(),
    "INFO": harmless(), "TITRE": harmless(),
}

Field = NodalField | CellField
# Where a table of EXTR says that a row is.
PLACES = ("NOEUD", "MAILLE", "POINT", "SOUS_POINT")


def create(session: Any, arguments: Arguments) -> Field:
    made = OPERATIONS[arguments.OPERATION](arguments)
    place, _, quantity = arguments.TYPE_CHAM.partition("_")
    if place == "CART":
        raise CommandError("CREA_CHAMP/TYPE_CHAM: CART is not available; ELEM and NOEU are.")
    found = "NOEU" if isinstance(made, NodalField) else made.place
    if found != place:
        raise CommandError(f"CREA_CHAMP/TYPE_CHAM: the field has its values at {found}, {place} was asked for.")
    made.quantity = quantity
    return made


def copy_of(field: Field) -> Field:
    if isinstance(field, NodalField):
        return NodalField(field.mesh, field.quantity, field.components, field.values.copy(), dict(field.functions))
    parts = [CellPart(part.cells.copy(), part.values.copy()) for part in field.parts]
    return CellField(field.mesh, field.place, field.quantity, field.components, parts, dict(field.functions))


# ---- EXTR ------------------------------------------------------------------------------------------------------


def extract(arguments: Arguments) -> Field:
    if arguments.RESULTAT is not None:
        return _of_result(arguments)
    if arguments.TABLE is not None:
        mesh = arguments.MAILLAGE or (arguments.MODELE.mesh if arguments.MODELE else None)
        if mesh is None:
            raise CommandError("CREA_CHAMP/EXTR: TABLE needs MAILLAGE or MODELE.")
        return _of_table(arguments.TABLE, mesh)
    if arguments.MAILLAGE is None:
        raise CommandError("CREA_CHAMP/EXTR: RESULTAT, MAILLAGE or TABLE is missing.")
    if arguments.NOM_CHAM != "GEOMETRIE":
        raise CommandError(f"CREA_CHAMP/NOM_CHAM: {arguments.NOM_CHAM} of a mesh is not available; GEOMETRIE is.")
    return geometry(arguments.MAILLAGE)


def _of_result(arguments: Arguments) -> Field:
    result, name = arguments.RESULTAT, arguments.NOM_CHAM
    if name is None:
        raise CommandError("CREA_CHAMP/EXTR: NOM_CHAM is missing.")
    if arguments.TYPE_MAXI is None:
        return copy_of(field_of(result, one_state(result, arguments, "CREA_CHAMP/EXTR"), name))
    states = chosen_states(result, arguments)
    fields = [field_of(result, stored, name) for stored in states]
    return _over_instants(fields, np.array([stored.instant for stored in states]), arguments)


def _over_instants(fields: list[Field], instants: np.ndarray, arguments: Arguments) -> Field:
    """TYPE_MAXI: of each value the extreme of all instants, or the instant of it."""
    made = copy_of(fields[0])
    for slot in range(1 if isinstance(made, NodalField) else len(made.parts)):
        values = np.stack([field.values if isinstance(field, NodalField) else field.parts[slot].values
                           for field in fields])
        chosen = _extreme(values, instants, arguments)
        if isinstance(made, NodalField):
            made.values = chosen
        else:
            made.parts[slot].values = chosen
    return made


def _extreme(values: np.ndarray, instants: np.ndarray, arguments: Arguments) -> np.ndarray:
    if arguments.TYPE_MAXI == "NORM_TRAN":
        sizes = np.linalg.norm(np.nan_to_num(values), axis=-1, keepdims=True)
        place = np.broadcast_to(np.argmax(sizes, axis=0)[None], (1, *values.shape[1:]))
    else:
        sizes = np.abs(values) if arguments.TYPE_MAXI.endswith("ABS") else values
        highest = arguments.TYPE_MAXI.startswith("MAXI")
        filled = np.where(np.isnan(sizes), -np.inf if highest else np.inf, sizes)
        place = (np.argmax if highest else np.argmin)(filled, axis=0)[None]
    if arguments.TYPE_RESU == "INST":
        return np.where(np.isnan(values[0]), np.nan, instants[place[0]])
    return np.take_along_axis(values, place, axis=0)[0]


def _of_table(table: TableConcept, mesh: MeshConcept) -> NodalField:
    if "NOEUD" not in table.columns or "MAILLE" in table.columns:
        raise CommandError("CREA_CHAMP/EXTR: TABLE is available with column NOEUD, for fields at nodes.")
    components = tuple(name for name in table.columns if name not in PLACES)
    values = np.full((mesh.mesh.node_count, len(components)), np.nan)
    for row in table.rows:
        for column, name in enumerate(components):
            if row.get(name) is not None:
                values[mesh.node_named(row["NOEUD"]), column] = row[name]
    return NodalField(mesh, "", components, values)


# ---- AFFE ------------------------------------------------------------------------------------------------------


def mesh_of(arguments: Arguments) -> MeshConcept:
    mesh = arguments.MAILLAGE or (arguments.MODELE.mesh if arguments.MODELE else None)
    if mesh is None:
        raise CommandError(f"CREA_CHAMP/{arguments.OPERATION}: MAILLAGE or MODELE is missing.")
    return mesh


def assign(arguments: Arguments) -> Field:
    """Values, or functions where TYPE_CHAM is of NEUT_F; the last one given counts."""
    mesh = mesh_of(arguments)
    components = tuple(dict.fromkeys(name for one in arguments.AFFE for name in one.NOM_CMP))
    place = arguments.TYPE_CHAM.partition("_")[0]
    # Numbers stand for functions: nothing is no number then.
    fill = 0.0 if arguments.PROL_ZERO == "OUI" and not any(one.VALE_F for one in arguments.AFFE) else np.nan
    made = _empty(mesh, place, components, _model_cells(arguments, mesh), fill)
    functions: dict[str, Function] = {}
    for one in arguments.AFFE:
        for name, value in zip(one.NOM_CMP, _given_values(one)):
            if isinstance(value, Function):
                number = len(functions)
                functions[str(number)] = value
                value = float(number)
            _put(made, one, components.index(name), value)
    made.functions = functions
    return made


def _given_values(one: Arguments) -> tuple[Any, ...]:
    values = one.VALE or one.VALE_I or one.VALE_F
    if len(values) != len(one.NOM_CMP):
        raise CommandError("CREA_CHAMP/AFFE: VALE needs as many values as NOM_CMP has names.")
    return values


def _model_cells(arguments: Arguments, mesh: MeshConcept) -> np.ndarray:
    """The cells of the model, else all."""
    if arguments.MODELE is None:
        return mesh.all_cells()
    parts = [part.cells for part in arguments.MODELE.parts]
    return np.unique(np.concatenate(parts)) if parts else mesh.all_cells()


def _empty(mesh: MeshConcept, place: str, components: tuple[str, ...], cells: np.ndarray, fill: float) -> Field:
    if place == "NOEU":
        return NodalField(mesh, "", components, np.full((mesh.mesh.node_count, len(components)), np.nan))
    parts = []
    for cell_type, inside in blocks_with(mesh, cells):
        if DIMENSIONS.get(cell_type) == 0:
            continue
        places = {"ELNO": lambda: len(reference_nodes(cell_type)), "ELGA": lambda: len(gauss_points(cell_type)[1]),
                  "ELEM": lambda: 1}
        if place not in places:
            raise CommandError(f"CREA_CHAMP/TYPE_CHAM: {place} is not available; NOEU, ELNO, ELGA and ELEM are.")
        parts.append(CellPart(inside, np.full((len(inside), places[place](), len(components)), fill)))
    return CellField(mesh, place, "", components, parts)


def _put(field: Field, where: Arguments, column: int, value: float) -> None:
    if isinstance(field, NodalField):
        field.values[field.mesh.nodes(where), column] = value
        return
    cells = field.mesh.cells(where)
    for part in field.parts:
        part.values[np.isin(part.cells, cells), :, column] = value


# ---- ASSE, COMB --------------------------------------------------------------------------------------------------


def assemble(arguments: Arguments) -> Field:
    """Parts of fields, one after the other; with CUMUL they are added."""
    mesh = mesh_of(arguments)
    names: list[str] = []
    for one in arguments.ASSE:
        names += [new for _, new in _renamed(one)]
    components = tuple(dict.fromkeys(names))
    place = arguments.TYPE_CHAM.partition("_")[0]
    first = arguments.ASSE[0].CHAM_GD
    if place == "NOEU":
        made: Field = _empty(mesh, place, components, mesh.all_cells(), np.nan)
    else:
        made = CellField(mesh, place, "", components, [])
    for one in arguments.ASSE:
        source = one.CHAM_GD
        if isinstance(source, NodalField) != isinstance(made, NodalField):
            raise CommandError("CREA_CHAMP/ASSE: the fields are not at the places of TYPE_CHAM.")
        for old, new in _renamed(one):
            _add(made, source, one, source.components.index(old), components.index(new))
    if isinstance(made, CellField) and not made.parts:
        raise CommandError(f"CREA_CHAMP/ASSE: field {first.name} has nothing there.")
    if isinstance(made, CellField) and arguments.PROL_ZERO == "OUI":
        for part in made.parts:
            part.values[np.isnan(part.values)] = 0.0
    return made


def _renamed(one: Arguments) -> list[tuple[str, str]]:
    old = one.NOM_CMP or one.CHAM_GD.components
    new = one.NOM_CMP_RESU or old
    if len(old) != len(new):
        raise CommandError("CREA_CHAMP/ASSE: NOM_CMP_RESU needs as many names as NOM_CMP.")
    for name in old:
        if name not in one.CHAM_GD.components:
            raise CommandError(f"CREA_CHAMP/ASSE: field {one.CHAM_GD.name} has no component {name}; it has "
                               f"{', '.join(one.CHAM_GD.components)}.")
    return list(zip(old, new))


def _add(made: Field, source: Field, one: Arguments, old: int, new: int) -> None:
    if isinstance(made, NodalField):
        assert isinstance(source, NodalField)
        nodes = made.mesh.nodes(one)
        _merge(made.values, (nodes, new), one.COEF_R * source.values[nodes, old], one.CUMUL == "OUI")
        return
    assert isinstance(source, CellField)
    cells = made.mesh.cells(one)
    for part in source.parts:
        there = np.isin(part.cells, cells)
        if not np.any(there):
            continue
        target = _matching_part(made, part, part.cells[there], len(made.components))
        at = np.searchsorted(target.cells, part.cells[there])
        slots = np.ix_(at, np.arange(part.values.shape[1]), [new])
        _merge(target.values, slots, one.COEF_R * part.values[there][..., [old]], one.CUMUL == "OUI")


def _matching_part(made: CellField, like: CellPart, cells: np.ndarray, width: int) -> CellPart:
    """A part with these cells, ascending; it grows where it must."""
    places = like.values.shape[1]
    for part in made.parts:
        if part.values.shape[1] == places and np.any(np.isin(like.cells, part.cells)):
            if np.all(np.isin(cells, part.cells)):
                return part
            whole = np.union1d(part.cells, cells)
            grown = np.full((len(whole), places, width), np.nan)
            grown[np.searchsorted(whole, part.cells)] = part.values
            part.cells, part.values = whole, grown
            return part
    whole = np.sort(cells)
    made.parts.append(CellPart(whole, np.full((len(whole), places, width), np.nan)))
    return made.parts[-1]


def _merge(target: np.ndarray, slots: Any, values: np.ndarray, adds: bool) -> None:
    """Values that are not there change nothing."""
    before = target[slots]
    new = np.where(np.isnan(before), 0.0, before) + values if adds else values
    target[slots] = np.where(np.isnan(values), before, new)


def combine(arguments: Arguments) -> Field:
    """Σ coefficient · field; all have the same components at the same places."""
    made = copy_of(arguments.COMB[0].CHAM_GD)
    for slot, values in enumerate(_arrays(made)):
        values *= arguments.COMB[0].COEF_R
        for one in arguments.COMB[1:]:
            other = one.CHAM_GD
            arrays = _arrays(other)
            same = type(other) is type(made) and set(made.components) <= set(other.components)
            if not same or len(arrays) <= slot or arrays[slot].shape[:-1] != values.shape[:-1]:
                raise CommandError(f"CREA_CHAMP/COMB: field {other.name} has other components or places.")
            columns = [other.components.index(name) for name in made.components]
            values += one.COEF_R * arrays[slot][..., columns]
    return made


def _arrays(field: Field) -> list[np.ndarray]:
    return [field.values] if isinstance(field, NodalField) else [part.values for part in field.parts]


# ---- EVAL, DISC, NORMALE -----------------------------------------------------------------------------------------


def evaluate(arguments: Arguments) -> Field:
    """Functions at the values of other fields, whose components are their parameters."""
    formulas = arguments.CHAM_F
    if formulas is None or not formulas.functions:
        raise CommandError("CREA_CHAMP/EVAL: CHAM_F needs a field of functions.")
    made = copy_of(formulas)
    made.functions = {}
    for slot, codes in enumerate(_arrays(formulas)):
        known = _parameters(formulas, arguments.CHAM_PARA, slot)
        flat = codes.reshape(-1)
        values = np.full(flat.shape, np.nan)
        for i in np.flatnonzero(~np.isnan(flat)):
            values[i] = _value_at(formulas.functions[str(int(flat[i]))], known, i // codes.shape[-1])
        _arrays(made)[slot][...] = values.reshape(codes.shape)
    return made


def _parameters(formulas: Field, fields: tuple[Field, ...], slot: int) -> dict[str, np.ndarray]:
    """Of each component the values at the places of the formulas; a place a row."""
    known: dict[str, np.ndarray] = {}
    for field in fields:
        if isinstance(formulas, NodalField):
            if not isinstance(field, NodalField):
                raise CommandError("CREA_CHAMP/EVAL: CHAM_F and CHAM_PARA are at different places.")
            values = field.values
        else:
            values = _aligned(formulas, field, slot)
        for column, name in enumerate(field.components):
            known[name] = values[..., column].reshape(-1)
    return known


def _aligned(formulas: CellField, field: Field, slot: int) -> np.ndarray:
    """The values in the cells of a part of the formulas."""
    wanted = formulas.parts[slot]
    if not isinstance(field, CellField) or field.place != formulas.place:
        raise CommandError("CREA_CHAMP/EVAL: CHAM_F and CHAM_PARA are at different places.")
    values = np.full((*wanted.values.shape[:2], len(field.components)), np.nan)
    for part in field.parts:
        if part.values.shape[1] != wanted.values.shape[1]:
            continue
        _, here, there = np.intersect1d(wanted.cells, part.cells, return_indices=True)
        values[here] = part.values[there]
    return values


def _value_at(function: Function, known: dict[str, np.ndarray], place: int) -> float:
    values = []
    for name in function.parameters:
        if name not in known:
            raise CommandError(f"CREA_CHAMP/EVAL: parameter {name} of formula {function.name} is no component of "
                               f"CHAM_PARA; there are {', '.join(known)}.")
        values.append(float(known[name][place]))
    return np.nan if any(np.isnan(value) for value in values) else float(function(*values))


def discretise(arguments: Arguments) -> Field:
    """A field at other places: nodes to Gauss points by shape functions, cells' nodes to nodes by means."""
    field, place = arguments.CHAM_GD, arguments.TYPE_CHAM.partition("_")[0]
    if field is None:
        raise CommandError("CREA_CHAMP/DISC: CHAM_GD is missing.")
    if isinstance(field, NodalField) and place in ("ELGA", "ELNO"):
        cells = _model_cells(arguments, field.mesh)
        body = [inside for kind, inside in blocks_with(field.mesh, cells) if DIMENSIONS.get(kind, 3) > 0]
        return in_cells(field, np.concatenate(body), place)
    if isinstance(field, CellField) and field.place == "ELNO" and place == "NOEU":
        return nodal_mean(field)
    found = "NOEU" if isinstance(field, NodalField) else field.place
    if found == place:
        return copy_of(field)
    raise CommandError(f"CREA_CHAMP/DISC: from {found} to {place} is not available.")


def normals(arguments: Arguments) -> NodalField:
    if arguments.MODELE is None:
        raise CommandError("CREA_CHAMP/NORMALE: MODELE is missing.")
    mesh = arguments.MODELE.mesh
    faces = mesh.cells(arguments)
    values = nodal_normals(mesh, faces, np.asarray(mesh.mesh.points), _model_cells(arguments, mesh))
    return NodalField(mesh, "GEOM_R", ("X", "Y", "Z")[:mesh.dimension], values[:, :mesh.dimension])


OPERATIONS = {"EXTR": extract, "AFFE": assign, "ASSE": assemble, "COMB": combine, "EVAL": evaluate,
              "DISC": discretise, "NORMALE": normals}

COMMANDS = [Command("CREA_CHAMP", KEYS, create)]
