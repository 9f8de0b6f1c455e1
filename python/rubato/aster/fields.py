# SPDX-License-Identifier: LGPL-3.0-or-later
"""Fields of stored states by their Code_Aster names, computed when they are asked for."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from .concepts import CellField, CellPart, MeshConcept, NodalField, Result, Stored
from .contact_fields import contact_elements, contact_nodes, multipliers
from .frames import (STRAIN_INVARIANTS, STRESS_INVARIANTS, strain_invariants, stress_invariants, tensor_of)
from .keys import CommandError, nearest
from .mesh_parts import blocks_with, nodes_of_part, points_of
from .shapes import gauss_points, point_order, shape_values
from .strain_fields import MEASURES, strain_parts

DISPLACEMENTS = ("DX", "DY", "DZ")
AXES = ("X", "Y", "Z")
# Components of tensors, and where rubato has them: it keeps xx yy zz xy yz xz.
PLANE_PAIRS = (("XX", 0), ("YY", 1), ("ZZ", 2), ("XY", 3))
SPACE_PAIRS = (*PLANE_PAIRS, ("XZ", 5), ("YZ", 4))
# Of fields in cells: rubato's field, the letters of the components, the quantity.
TENSORS = {
    "SIEF": ("stress", "SI", "SIEF_R"),
    "SIGM": ("stress", "SI", "SIEF_R"),
    "EPSI": ("strain", "EP", "EPSI_R"),
    "EPME": ("strain", "EP", "EPSI_R"),
    "EPSG": ("", "EP", "EPSI_R"),
    "EPMG": ("", "EP", "EPSI_R"),
    "EPSL": ("", "EP", "EPSI_R"),
    "EPSP": ("plastic_strain", "EP", "EPSI_R"),
}
INVARIANTS: dict[str, tuple[str, str, tuple[str, ...], Callable[[np.ndarray], np.ndarray]]] = {
    "SIEQ": ("SIEF", "SIEF_R", STRESS_INVARIANTS, stress_invariants),
    "EPEQ": ("EPSI", "EPSI_R", STRAIN_INVARIANTS, strain_invariants),
    "EPMQ": ("EPME", "EPSI_R", STRAIN_INVARIANTS, strain_invariants),
    "EPGQ": ("EPSG", "EPSI_R", STRAIN_INVARIANTS, strain_invariants),
}
CELL_PLACES = ("ELGA", "ELNO", "NOEU")
LETTERS = {"SIEQ": "SI", "EPEQ": "EP", "EPMQ": "EP", "EPGQ": "EP"}


def field_of(result: Result, stored: Stored, name: str) -> NodalField | CellField:
    """A field of a stored state. What CREA_RESU and the like gave comes first. Raises CommandError for fields that
    are not available."""
    if name in stored.given:
        return stored.given[name]
    # A result that another run goes on with may have another state of the same order later.
    of_state, made = result.cache.get((name, stored.order), (None, None))
    if of_state is not stored:
        made = _made(result, stored, name)
        made.name = f"{result.name} {name}".strip()
        result.cache[name, stored.order] = (stored, made)
    return made


def _made(result: Result, stored: Stored, name: str) -> NodalField | CellField:
    kind, _, place = name.rpartition("_")
    if stored.solved is not None:
        if name in NODAL:
            return NODAL[name](result, stored)
        if name == "CONT_ELEM":
            return contact_elements(stored)
        if kind in TENSORS and place in CELL_PLACES:
            return tensor_field(result, stored, kind, place)
        if kind == "VARI" and place in CELL_PLACES:
            return variables(result, stored, place)
    if kind in INVARIANTS and place in CELL_PLACES:
        return invariant_field(result, stored, kind, place)
    if place == "NOEU" and f"{kind}_ELNO" in stored.given:
        return nodal_mean(stored.given[f"{kind}_ELNO"])
    raise CommandError(f"field {name} of result {result.name} is not available; there are "
                       f"{', '.join(known_names(stored))}.{nearest(name, known_names(stored))}")


def known_names(stored: Stored) -> list[str]:
    names = list(stored.given)
    if stored.solved is not None:
        names += NODAL
        names += [f"{kind}_{place}" for kind in (*TENSORS, *INVARIANTS, "VARI") for place in CELL_PLACES]
        if stored.solved.zones:
            names.append("CONT_ELEM")
    return list(dict.fromkeys(names))


# ---- at nodes --------------------------------------------------------------------------------------------------


def geometry(mesh: MeshConcept) -> NodalField:
    components = AXES[:mesh.dimension]
    return NodalField(mesh, "GEOM_R", components, points_of(mesh)[:, :len(components)])


def _vector(stored: Stored, values: np.ndarray, quantity: str) -> NodalField:
    """nan at nodes without degrees of freedom."""
    mesh, dimension = stored.solved.mesh, stored.solved.mesh.dimension
    values = np.array(values[:, :dimension], dtype=float)
    without = np.asarray(stored.solved.model.dofs)[:, 0] < 0
    without[list(stored.solved.ends)] = False
    values[without] = np.nan
    return NodalField(mesh, quantity, DISPLACEMENTS[:dimension], values)


def displacement(result: Result, stored: Stored) -> NodalField:
    """DEPL, with the multipliers of contact at slave nodes."""
    field = _vector(stored, stored.solved.displacement(stored.state), "DEPL_R")
    names, columns = multipliers(stored)
    if names:
        field.components += names
        field.values = np.column_stack([field.values, columns])
    return field


def velocity(result: Result, stored: Stored) -> NodalField:
    return _vector(stored, stored.state.velocity(stored.solved.model), "DEPL_R")


def acceleration(result: Result, stored: Stored) -> NodalField:
    return _vector(stored, stored.state.acceleration(stored.solved.model), "DEPL_R")


def at_nodes(stored: Stored, values: np.ndarray) -> np.ndarray:
    """What has an entry a degree of freedom: nodes × 3."""
    dofs = np.asarray(stored.solved.model.dofs)
    result = np.zeros((len(dofs), 3))
    result[:, :dofs.shape[1]] = np.where(dofs >= 0, np.asarray(values)[np.maximum(dofs, 0)], 0.0)
    return result


def internal_force(stored: Stored) -> np.ndarray:
    """Nodes × 3."""
    return nodal_values(stored, "internal_force")


def nodal_values(stored: Stored, name: str) -> np.ndarray:
    """A field of rubato at the nodes: nodes × 3 of a vector, else as it is."""
    values = np.asarray(stored.solved.model.nodal_fields(stored.state, [name])[name])
    if values.ndim == 2 and values.shape[1] == 2 and stored.solved.mesh.dimension == 2:
        return np.column_stack([values, np.zeros(len(values))])
    return values


def nodal_forces(result: Result, stored: Stored) -> NodalField:
    """FORC_NODA: ∫ Bᵀσ and the forces of springs, in axisymmetric models per radian."""
    solved = stored.solved
    forces = internal_force(stored) - solved.pulls(stored.state.t) + solved.end_forces(stored.state)
    return _vector(stored, forces / solved.ring, "DEPL_R")


def reactions(result: Result, stored: Stored) -> NodalField:
    """REAC_NODA: FORC_NODA without the loads. Supports, contact, inertia and damping are what is left."""
    solved = stored.solved
    loads = at_nodes(stored, solved.model.external_force(stored.state.t))
    forces = internal_force(stored) + solved.end_forces(stored.state)
    return _vector(stored, (forces - loads) / solved.ring, "DEPL_R")


def temperature(result: Result, stored: Stored) -> NodalField:
    if not stored.solved.materials.variables:
        raise CommandError(f"field TEMP of result {result.name} is not available: there are no temperatures.")
    return NodalField(stored.solved.mesh, "TEMP_R", ("TEMP",), nodal_values(stored, "temperature").reshape(-1, 1))


NODAL: dict[str, Callable[[Result, Stored], NodalField]] = {
    "DEPL": displacement,
    "VITE": velocity,
    "ACCE": acceleration,
    "FORC_NODA": nodal_forces,
    "REAC_NODA": reactions,
    "CONT_NOEU": contact_nodes,
    "TEMP": temperature,
    "GEOMETRIE": lambda result, stored: geometry(stored.solved.mesh),
}

# ---- in cells --------------------------------------------------------------------------------------------------


def tensor_field(result: Result, stored: Stored, kind: str, place: str) -> NodalField | CellField:
    if place == "NOEU":
        return nodal_mean(_in_cells(result, stored, f"{kind}_ELNO"))
    if kind in ("EPME", "EPMG") and stored.solved.materials.variables:
        raise CommandError(f"field {kind}_{place} of result {result.name} is not available with temperatures.")
    source, letters, quantity = TENSORS[kind]
    pairs = PLANE_PAIRS if stored.solved.mesh.dimension == 2 else SPACE_PAIRS
    columns = [column for _, column in pairs]
    if kind in MEASURES and (not source or stored.solved.large_strain):
        parts = strain_parts(stored, kind, place)
    else:
        parts = [CellPart(cells, values[..., columns]) for cells, values in
                 placed_values(stored, f"{source}_{place.lower()}", place)]
    return CellField(stored.solved.mesh, place, quantity, tuple(letters + pair for pair, _ in pairs), parts)


def cell_values(stored: Stored, name: str) -> list[tuple[np.ndarray, np.ndarray]]:
    """A field of rubato in cells: cells of the command file's mesh, and cells × places × components."""
    model = stored.solved.model
    values = model.cell_field(stored.state, name).values
    return [(cells, np.asarray(values[cell_type])) for cell_type, cells in model_cells(stored, values)]


def placed_values(stored: Stored, name: str, place: str) -> list[tuple[np.ndarray, np.ndarray]]:
    """The same with the places of each cell in Code_Aster's order: the nodes as the command file's mesh has them, which
    rubato may have turned around, and the Gauss points of the type."""
    mesh, placed = stored.solved.mesh, []
    blocks = {block.type: block for block in stored.solved.model.mesh.blocks}
    values = stored.solved.model.cell_field(stored.state, name).values
    for kind, cells in model_cells(stored, values):
        given = np.asarray(values[kind])
        if place == "ELNO":
            given = with_nodes_in_order(given, np.asarray(blocks[kind].nodes), nodes_of_part(mesh, cells))
        elif (order := point_order(str(kind))) is not None:
            given = given[:, order]
        placed.append((cells, given))
    return placed


def with_nodes_in_order(values: np.ndarray, nodes: np.ndarray, wanted: np.ndarray) -> np.ndarray:
    """Cells × nodes × components, from one order of the nodes of each cell to another."""
    if np.array_equal(nodes, wanted):
        return values
    result = np.empty_like(values)
    ascending = np.take_along_axis(values, np.argsort(nodes, axis=1)[..., None], axis=1)
    np.put_along_axis(result, np.argsort(wanted, axis=1)[..., None], ascending, axis=1)
    return result


def model_cells(stored: Stored, types: Any) -> list[tuple[Any, np.ndarray]]:
    """Cells of the command file's mesh by the types of the model's mesh."""
    blocks = {block.type: block for block in stored.solved.model.mesh.blocks}
    return [(kind, stored.solved.cell_of[blocks[kind].first:blocks[kind].first + len(blocks[kind].nodes)])
            for kind in types]


def _in_cells(result: Result, stored: Stored, name: str) -> CellField:
    field = field_of(result, stored, name)
    if not isinstance(field, CellField):
        raise CommandError(f"field {name} of result {result.name} is not a field in cells.")
    return field


def variables(result: Result, stored: Stored, place: str) -> NodalField | CellField:
    """VARI_*: V1 is the cumulated plastic strain, 0 of what does not yield; other variables are not there."""
    if place == "NOEU":
        return nodal_mean(_in_cells(result, stored, "VARI_ELNO"))
    parts = [CellPart(cells, values[..., :1]) for cells, values in
             placed_values(stored, f"cumulated_plastic_strain_{place.lower()}", place)]
    return CellField(stored.solved.mesh, place, "VARI_R", ("V1",), parts)


def invariant_field(result: Result, stored: Stored, kind: str, place: str) -> NodalField | CellField:
    """At nodes: the mean of the invariants of the cells there, as Code_Aster has it."""
    source, quantity, names, invariants = INVARIANTS[kind]
    if place == "NOEU":
        return nodal_mean(_in_cells(result, stored, f"{kind}_ELNO"))
    field = _in_cells(result, stored, f"{source}_{place}")
    parts = []
    for part in field.parts:
        flat = part.values.reshape(-1, len(field.components))
        values = invariants(tensor_of(field.components, flat, LETTERS[kind]))
        parts.append(CellPart(part.cells, values.reshape(*part.values.shape[:2], len(names))))
    return CellField(field.mesh, place, quantity, names, parts)


def nodal_mean(field: CellField, cells: np.ndarray | None = None) -> NodalField:
    """At each node the plain mean over the cells that share it, or over those of them that are named. nan where
    there is none."""
    if field.place != "ELNO":
        raise CommandError(f"a field at {field.place} cannot be averaged at nodes.")
    count, width = field.mesh.mesh.node_count, len(field.components)
    sums, shares = np.zeros((count, width)), np.zeros((count, width))
    for part in field.parts:
        chosen = np.ones(len(part.cells), bool) if cells is None else np.isin(part.cells, cells)
        nodes = nodes_of_part(field.mesh, part.cells[chosen]).ravel()
        values = part.values[chosen].reshape(-1, width)
        np.add.at(sums, nodes, np.nan_to_num(values))
        np.add.at(shares, nodes, ~np.isnan(values))
    mean = np.divide(sums, shares, out=np.full_like(sums, np.nan), where=shares > 0)
    return NodalField(field.mesh, field.quantity, field.components, mean)


# ---- from one place to another -----------------------------------------------------------------------------------


def in_cells(field: NodalField, cells: np.ndarray, place: str) -> CellField:
    """A nodal field at the nodes of cells or at their Gauss points."""
    parts = []
    for cell_type, inside in blocks_with(field.mesh, cells):
        values = field.values[nodes_of_part(field.mesh, inside)]
        if place == "ELGA":
            shapes = shape_values(cell_type, gauss_points(cell_type)[0])
            values = np.einsum("pn,cnk->cpk", shapes, values)
        parts.append(CellPart(inside, values))
    return CellField(field.mesh, place, field.quantity, field.components, parts)
