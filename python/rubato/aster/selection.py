# SPDX-License-Identifier: LGPL-3.0-or-later
"""Keywords that many commands share: which stored states of a result, and where in a field."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from .concepts import CellField, NodalField, Result, Stored
from .keys import Arguments, CommandError, Key, concept, integers, real, reals, texts, words, yes

# TOUT_ORDRE, NUME_ORDRE, INST …: which states.
STATES: dict[str, Key] = {
    "TOUT_ORDRE": yes(),
    "NUME_ORDRE": integers(),
    "LIST_ORDRE": concept("RealList"),
    "INST": reals(),
    "LIST_INST": concept("RealList"),
    "CRITERE": words("RELATIF", "ABSOLU", default="RELATIF"),
    "PRECISION": real(1e-6),
}
CELLS: dict[str, Key] = {"TOUT": yes(), "GROUP_MA": texts(), "MAILLE": texts()}
NODES: dict[str, Key] = {**CELLS, "GROUP_NO": texts(), "NOEUD": texts()}


def chosen_states(result: Result, where: Arguments) -> list[Stored]:
    """The states that the keywords name, all when there is none."""
    if where.get("NUME_ORDRE"):
        return [result.of_order(order) for order in _items(where.NUME_ORDRE)]
    if where.get("LIST_ORDRE"):
        return [result.of_order(int(order)) for order in where.LIST_ORDRE.values]
    instants = where.get("INST")
    if where.get("LIST_INST"):
        instants = tuple(where.LIST_INST.values)
    if instants is not None and instants != ():
        return [result.at(instant, where.PRECISION, where.CRITERE) for instant in _items(instants)]
    return list(result.stored)


def one_state(result: Result, where: Arguments, command: str) -> Stored:
    """The state that NUME_ORDRE or INST names; the only one of a result that has one."""
    order, instant = where.get("NUME_ORDRE"), where.get("INST")
    if order is not None:
        return result.of_order(order)
    if instant is not None:
        return result.at(instant, where.PRECISION, where.CRITERE)
    if len(result.stored) == 1:
        return result.stored[0]
    raise CommandError(f"{command}: NUME_ORDRE or INST is missing; result {result.name} has {len(result.stored)} "
                       "states.")


def _items(value: Any) -> tuple[Any, ...]:
    return value if isinstance(value, tuple) else (value,)


def one_node(field: NodalField | CellField, where: Arguments, command: str) -> int | None:
    """The node that GROUP_NO, a group of one node, or NOEUD names."""
    mesh = field.mesh
    names = where.get("NOEUD") or ()
    groups = where.get("GROUP_NO") or ()
    if isinstance(names, str):
        names = (names,)
    if isinstance(groups, str):
        groups = (groups,)
    nodes = [mesh.node_named(name) for name in names]
    for group in groups:
        nodes += [int(node) for node in mesh.nodes_in(group)]
    if not nodes:
        return None
    if len(nodes) != 1:
        raise CommandError(f"{command}: expected one node, GROUP_NO or NOEUD names {len(nodes)}.")
    return nodes[0]


def one_cell(field: CellField, where: Arguments, command: str) -> int | None:
    """The cell that GROUP_MA, a group of one cell, or MAILLE names."""
    mesh = field.mesh
    group, name = where.get("GROUP_MA"), where.get("MAILLE")
    if name:
        return mesh.cell_named(name)
    if not group:
        return None
    cells = mesh.cells_in(group)
    if len(cells) != 1:
        raise CommandError(f"{command}/GROUP_MA: expected a group of one cell, {group} has {len(cells)}.")
    return int(cells[0])


def column_of(field: NodalField | CellField, component: str) -> int:
    if component not in field.components:
        raise CommandError(f"the field has no component {component}; it has {', '.join(field.components)}.")
    return field.components.index(component)


def value_in_cell(field: CellField, cell: int, place: int, component: str) -> float:
    """At a place (from 0) of a cell. Raises CommandError where the field has nothing."""
    column = column_of(field, component)
    for part in field.parts:
        found = np.flatnonzero(part.cells == cell)
        if len(found):
            if not 0 <= place < part.values.shape[1]:
                raise CommandError(f"POINT: cell {field.mesh.cell_name(cell)} has the points 1 to "
                                   f"{part.values.shape[1]}.")
            return float(part.values[found[0], place, column])
    raise CommandError(f"the field has nothing in cell {field.mesh.cell_name(cell)}.")


def place_of_node(field: CellField, cell: int, node: int) -> int:
    """Of a field at nodes of cells."""
    if field.place != "ELNO":
        raise CommandError(f"GROUP_NO and NOEUD are not available for a field at {field.place}.")
    found = np.flatnonzero(field.mesh.nodes_of_cell(cell) == node)
    if not len(found):
        raise CommandError(f"node {field.mesh.node_name(node)} is none of cell {field.mesh.cell_name(cell)}.")
    return int(found[0])


def all_values(field: NodalField | CellField, component: str | None,
               inside: Callable[[np.ndarray], np.ndarray] | None = None) -> np.ndarray:
    """Every value of a component, or of all; without those that are not there."""
    if isinstance(field, NodalField):
        values = field.values if component is None else field.column(component)
    else:
        parts = [np.zeros(0)]
        for part in field.parts:
            rows = part.values if inside is None else part.values[inside(part.cells)]
            parts.append((rows if component is None else rows[..., column_of(field, component)]).ravel())
        values = np.concatenate(parts)
    values = np.asarray(values, dtype=float).ravel()
    return values[~np.isnan(values)]
