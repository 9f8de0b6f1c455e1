# SPDX-License-Identifier: LGPL-3.0-or-later
"""POST_RELEVE_T: tables of fields at nodes: values, sums, means, extremes."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np

from ..concepts import CellField, NodalField, Stored, TableConcept
from ..fields import field_of, nodal_mean
from ..frames import (STRESS_INVARIANTS, along_line, around_axis, by_angles, stress_invariants, tensor_of, turned)
from ..keys import (Arguments, Command, CommandError, Key, concept, factor, harmless, reals, text, texts, words, yes)
from ..selection import NODES, STATES, chosen_states
from ..tables import Row

ACTION: dict[str, Key] = {
    **STATES, **NODES,
    "OPERATION": texts(required=True),
    "INTITULE": text(required=True),
    "RESULTAT": concept("Result"),
    "CHAM_GD": concept("NodalField", "CellField"),
    "NOM_CHAM": text(),
    "TOUT_CMP": yes(),
    "NOM_CMP": texts(),
    "INVARIANT": yes(),
    "ELEM_PRINCIPAUX": yes(),
    "RESULTANTE": texts(),
    "MOMENT": texts(),
    "POINT": reals(),
    "REPERE": words("GLOBAL", "LOCAL", "POLAIRE", "CYLINDRIQUE", "UTILISATEUR", default="GLOBAL"),
    "ANGL_NAUT": reals(),
    "ORIGINE": reals(),
    "AXE_Z": reals(),
    "MOYE_NOEUD": words("OUI", default="OUI", missing={"NON": "Values in cells are averaged at nodes."}),
    "FORMAT_C": harmless(),
}
KEYS: dict[str, Key] = {"ACTION": factor(ACTION, required=True), "reuse": concept("TableConcept"), "TITRE": texts(),
                        "INFO": harmless()}

AXES = ("X", "Y", "Z")


def post_releve(session: Any, arguments: Arguments) -> TableConcept:
    table = arguments.reuse or TableConcept([], [], " ".join(arguments.TITRE))
    for action in arguments.ACTION:
        for operation in action.OPERATION:
            if operation not in OPERATIONS:
                raise CommandError(f"POST_RELEVE_T/OPERATION: {operation} is not available; there are "
                                   f"{', '.join(OPERATIONS)}.")
            for field, head in fields_of(action, "POST_RELEVE_T/ACTION"):
                add_rows(table, OPERATIONS[operation](field, head, action))
    return table


def add_rows(table: TableConcept, rows: list[Row]) -> None:
    for row in rows:
        table.columns += [name for name in row if name not in table.columns]
        table.rows.append(row)


def fields_of(action: Arguments, command: str) -> Iterator[tuple[NodalField | CellField, Row]]:
    """The fields that an action names, with the columns that say which one it is."""
    if (action.RESULTAT is None) == (action.CHAM_GD is None):
        raise CommandError(f"{command}: one of RESULTAT and CHAM_GD is needed.")
    if action.CHAM_GD is not None:
        yield action.CHAM_GD, {"INTITULE": action.INTITULE, "CHAM_GD": action.CHAM_GD.name}
        return
    result = action.RESULTAT
    if action.NOM_CHAM is None:
        raise CommandError(f"{command}: NOM_CHAM is missing.")
    for stored in chosen_states(result, action):
        yield field_of(result, stored, action.NOM_CHAM), {
            "INTITULE": action.INTITULE, "RESU": result.name, "NOM_CHAM": action.NOM_CHAM, **access(stored)}


def access(stored: Stored) -> Row:
    return {"NUME_ORDRE": stored.order, "INST": stored.instant}


def extracted_rows(one: Arguments, command: str) -> tuple[list[str], list[Row]]:
    """CREA_TABLE/RESU: columns and rows."""
    table = TableConcept([], [])
    for field, head in fields_of(one, command):
        values = at_nodes(field, one)
        for node in nodes_of(field, one, command):
            there = {name: float(values.column(name)[node]) for name in asked_components(values, one)}
            row = {name: value for name, value in there.items() if not np.isnan(value)}
            add_rows(table, [{**head, "NOEUD": field.mesh.node_name(int(node)), **coordinates(field, node), **row}])
    return table.columns, table.rows


# ---- where and what --------------------------------------------------------------------------------------------


def nodes_of(field: NodalField | CellField, where: Arguments, command: str) -> np.ndarray:
    """GROUP_NO and NOEUD in their order; else the nodes of cells."""
    mesh = field.mesh
    listed = [mesh.nodes_in(group) for group in where.get("GROUP_NO") or ()]
    if where.get("NOEUD"):
        listed.append(np.array([mesh.node_named(name) for name in where.NOEUD]))
    if listed:
        whole = np.concatenate(listed)
        _, first = np.unique(whole, return_index=True)
        return whole[np.sort(first)]
    nodes = mesh.nodes(where)
    if not len(nodes):
        raise CommandError(f"{command}: GROUP_NO or NOEUD is missing.")
    return nodes


def at_nodes(field: NodalField | CellField, where: Arguments) -> NodalField:
    """Of a field in cells the mean at each node, over the cells that GROUP_MA and MAILLE name with GROUP_NO."""
    if isinstance(field, NodalField):
        return field
    cells = None
    if where.get("GROUP_NO") or where.get("NOEUD"):
        named = field.mesh.cells(where)
        cells = named if len(named) else None
    return nodal_mean(field, cells)


def asked_components(field: NodalField, action: Arguments) -> tuple[str, ...]:
    if action.NOM_CMP:
        for name in action.NOM_CMP:
            field.column(name)
        return action.NOM_CMP
    return field.components


def coordinates(field: NodalField | CellField, node: int) -> Row:
    return {f"COOR_{axis}": float(x) for axis, x in zip(AXES, field.mesh.mesh.points[node])}


def abscissae(points: np.ndarray) -> np.ndarray:
    return np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(points, axis=0), axis=1))])


def local_values(field: NodalField, nodes: np.ndarray, action: Arguments) -> np.ndarray:
    """Values at the nodes in the axes of REPERE: nodes × components."""
    values, points = field.values[nodes], np.asarray(field.mesh.mesh.points)[nodes]
    frame = action.REPERE
    if frame == "GLOBAL":
        return values
    if frame == "UTILISATEUR":
        if not action.ANGL_NAUT:
            raise CommandError("POST_RELEVE_T/ACTION: ANGL_NAUT is missing.")
        axes = by_angles(action.ANGL_NAUT, len(nodes))
    elif frame == "LOCAL":
        if field.mesh.dimension != 2:
            raise CommandError("POST_RELEVE_T/REPERE: LOCAL is available in the plane.")
        if len(nodes) < 2:
            raise CommandError("POST_RELEVE_T/REPERE: LOCAL needs a line of at least two nodes.")
        axes = along_line(points)
    else:
        axes = around_axis(points, _three(action.ORIGINE, (0.0, 0.0, 0.0)), _three(action.AXE_Z, (0.0, 0.0, 1.0)))
    return turned(field.components, values, axes)


def _three(given: tuple[float, ...], otherwise: tuple[float, ...]) -> np.ndarray:
    return np.array((*given, *otherwise[len(given):])) if given else np.array(otherwise)


# ---- operations ------------------------------------------------------------------------------------------------


def extraction(field: NodalField | CellField, head: Row, action: Arguments) -> list[Row]:
    ways = ("TOUT_CMP", "NOM_CMP", "INVARIANT", "ELEM_PRINCIPAUX", "RESULTANTE")
    given = [name for name in ways if action.get(name)]
    if len(given) != 1:
        raise CommandError(f"POST_RELEVE_T/ACTION: one of {', '.join(ways)} is needed.")
    nodal = at_nodes(field, action)
    nodes = nodes_of(field, action, "POST_RELEVE_T/ACTION")
    if action.RESULTANTE:
        return [{**head, **resultant(nodal, nodes, action)}]
    names, values = quantities(nodal, nodes, action)
    lengths = abscissae(np.asarray(nodal.mesh.mesh.points)[nodes])
    rows = []
    for node, length, line in zip(nodes, lengths, values):
        there = {name: float(value) for name, value in zip(names, line) if not np.isnan(value)}
        rows.append({**head, "NOEUD": nodal.mesh.node_name(int(node)), "ABSC_CURV": float(length),
                     **coordinates(nodal, node), **there})
    return rows


def quantities(field: NodalField, nodes: np.ndarray, action: Arguments) -> tuple[tuple[str, ...], np.ndarray]:
    """What the table has of each node: components, or invariants of a stress."""
    values = local_values(field, nodes, action)
    if action.INVARIANT or action.ELEM_PRINCIPAUX:
        if "SIXX" not in field.components:
            raise CommandError("POST_RELEVE_T: INVARIANT and ELEM_PRINCIPAUX are available for stresses.")
        tensor = tensor_of(field.components, values, "SI")
        invariants = stress_invariants(tensor)
        if action.INVARIANT:
            return ("VMIS", "TRESCA", "TRACE", "DETER"), np.column_stack([
                invariants[:, :2], np.trace(tensor, axis1=1, axis2=2), np.linalg.det(tensor)])
        chosen = [i for i, name in enumerate(STRESS_INVARIANTS) if name.startswith(("PRIN", "VECT"))]
        return tuple(STRESS_INVARIANTS[i] for i in chosen), invariants[:, chosen]
    names = asked_components(field, action)
    return names, values[:, [field.components.index(name) for name in names]]


def resultant(field: NodalField, nodes: np.ndarray, action: Arguments) -> Row:
    """Sums over the nodes. With MOMENT the columns are RESULT_X … and MOMENT_X …, about POINT."""
    values = np.nan_to_num(local_values(field, nodes, action))
    forces = {name: values[:, field.components.index(name)] for name in ("DX", "DY", "DZ") if name in field.components}
    for name in action.RESULTANTE:
        if name not in forces:
            raise CommandError(f"POST_RELEVE_T/RESULTANTE: the field has no component {name}; it has "
                               f"{', '.join(field.components)}.")
    sums = {name: float(np.sum(forces[name])) for name in action.RESULTANTE}
    if not action.MOMENT:
        return sums
    arms = np.asarray(field.mesh.mesh.points)[nodes] - _three(action.POINT, (0.0, 0.0, 0.0))
    vectors = np.column_stack([forces.get(name, np.zeros(len(nodes))) for name in ("DX", "DY", "DZ")])
    moments = np.sum(np.cross(arms, vectors), axis=0)
    row = {f"RESULT_{name[-1]}": value for name, value in sums.items()}
    return {**row, **{f"MOMENT_{name[-1]}": float(moments[AXES.index(name[-1])]) for name in action.MOMENT}}


def mean_along(field: NodalField | CellField, head: Row, action: Arguments) -> list[Row]:
    """MOYENNE: the mean along the line, its linear part, and extremes."""
    nodal = at_nodes(field, action)
    nodes = nodes_of(field, action, "POST_RELEVE_T/ACTION")
    if len(nodes) < 2:
        raise CommandError("POST_RELEVE_T/OPERATION: MOYENNE needs a line of at least two nodes.")
    names, values = quantities(nodal, nodes, action)
    return mean_rows(names, abscissae(np.asarray(nodal.mesh.mesh.points)[nodes]), values, head)


def mean_rows(names: tuple[str, ...], lengths: np.ndarray, values: np.ndarray, head: Row) -> list[Row]:
    rows: dict[str, Row] = {}
    for name, column in zip(names, values.T):
        for quantity, value in line_means(lengths, column).items():
            rows.setdefault(quantity, {**head, "QUANTITE": quantity})[name] = value
    return list(rows.values())


def line_means(s: np.ndarray, f: np.ndarray) -> dict[str, float]:
    """MOMENT_0 ∫f ds/L, MOMENT_1 12/L² ∫f (s − L/2) ds, extremes, and what of the linear part is at both ends. f is
    linear between places; pieces that lack a value are left out."""
    there = ~np.isnan(f[:-1]) & ~np.isnan(f[1:])
    s1, s2, f1, f2 = s[:-1][there], s[1:][there], f[:-1][there], f[1:][there]
    if not len(s1):
        raise CommandError("POST_RELEVE_T/OPERATION: MOYENNE: the line has no values.")
    steps = s2 - s1
    length = np.sum(steps)
    mean = np.sum(steps * (f1 + f2)) / 2 / length
    first = np.sum(steps * (f1 * s1 + (f1 + f2) * (s1 + s2) + f2 * s2)) / 6 / length**2
    slope = 12 * first - 6 * mean
    return {"MOMENT_0": float(mean), "MOMENT_1": float(slope), "MINIMUM": float(min(f1.min(), f2.min())),
            "MAXIMUM": float(max(f1.max(), f2.max())), "MOYE_INT": float(mean - slope / 2),
            "MOYE_EXT": float(mean + slope / 2)}


def mean_of_nodes(field: NodalField | CellField, head: Row, action: Arguments) -> list[Row]:
    """MOYENNE_ARITH: a row a component."""
    nodal = at_nodes(field, action)
    nodes = nodes_of(field, action, "POST_RELEVE_T/ACTION")
    rows = []
    for name in asked_components(nodal, action):
        values = nodal.column(name)[nodes]
        if not np.all(np.isnan(values)):
            rows.append({**head, "CMP": name, "MOYENNE": float(np.nanmean(values))})
    return rows


def extremes(field: NodalField | CellField, head: Row, action: Arguments) -> list[Row]:
    """EXTREMA: the largest and the smallest value of all components, and those of largest and smallest size."""
    nodal = at_nodes(field, action)
    nodes = nodes_of(field, action, "POST_RELEVE_T/ACTION")
    names = asked_components(nodal, action)
    values = np.column_stack([nodal.column(name)[nodes] for name in names])
    if np.all(np.isnan(values)):
        raise CommandError("POST_RELEVE_T/OPERATION: EXTREMA: the nodes have no values.")
    rows = []
    sizes = np.abs(values)
    for word, measured, best in (("MAX", values, np.nanargmax), ("MIN", values, np.nanargmin),
                                 ("MAXI_ABS", sizes, np.nanargmax), ("MINI_ABS", sizes, np.nanargmin)):
        place, column = np.unravel_index(best(measured), values.shape)
        rows.append({**head, "EXTREMA": word, "NOEUD": nodal.mesh.node_name(int(nodes[place])), "CMP": names[column],
                     "VALE": float(measured[place, column])})
    return rows


OPERATIONS = {"EXTRACTION": extraction, "MOYENNE": mean_along, "MOYENNE_ARITH": mean_of_nodes, "EXTREMA": extremes}

COMMANDS = [Command("POST_RELEVE_T", KEYS, post_releve)]
