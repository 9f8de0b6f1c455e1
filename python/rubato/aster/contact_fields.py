# SPDX-License-Identifier: LGPL-3.0-or-later
"""What contact does, as Code_Aster has it: multipliers in DEPL, CONT_NOEU at slave nodes, CONT_ELEM on slave faces.

Forces are on the side of the internal ones, as Code_Aster keeps them: minus what the slave feels. rubato's are of the
whole ring in axisymmetric models, Code_Aster's per radian.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from .concepts import CellField, CellPart, NodalField, Result, Stored
from .keys import CommandError
from .normals import nodal_normals

OPEN, STICK = 0, 1
CONTACT = ("CONT", "JEU", "RN", "RNX", "RNY", "RNZ", "GLIX", "GLIY", "GLI", "RTAX", "RTAY", "RTAZ", "RTGX", "RTGY",
           "RTGZ", "RX", "RY", "RZ", "R", "HN", "I", "IX", "IY", "IZ", "PT_X", "PT_Y", "PT_Z", "PROJ_X", "PROJ_Y",
           "PROJ_Z")
ELEMENT = ("CONT", "PRES", "JEU", "COEFSURF", "PRESCOOR")


@dataclass
class SlaveValues:
    """Of a zone, an entry a slave node, ascending. `status` as CONT; `normal`, `tangential`: of the master on the
    node, of the study's ring or thickness; `direction`: of the slip, along the tangents."""

    nodes: np.ndarray
    status: np.ndarray
    paired: np.ndarray
    gap: np.ndarray
    normal: np.ndarray
    tangential: np.ndarray
    slip: np.ndarray


def slave_values(stored: Stored, record: Any) -> SlaveValues:
    """Sums over the points of each node."""
    solved = stored.solved
    points = solved.model.contact_points(record.index)
    zone = stored.state.zones[record.index]
    on_node = np.asarray(points["node"])
    if np.any(on_node < 0):
        return _between_nodes(stored, record)
    place = np.searchsorted(record.slave_nodes, on_node)
    count = len(record.slave_nodes)
    values = SlaveValues(record.slave_nodes, np.zeros(count), np.zeros(count, bool), np.full(count, np.nan),
                         np.zeros((count, 3)), np.zeros((count, 3)), np.zeros((count, 2)))
    np.add.at(values.normal, place, np.asarray(zone.normal_force))
    np.add.at(values.tangential, place, np.asarray(zone.tangential_force))
    status, gap, slip = (np.asarray(part) for part in (zone.status, zone.gap, zone.slip))
    # Of several points on a node the one that touches says most, else the one that faces something.
    for i in np.lexsort((status != OPEN, np.isfinite(gap))):
        node = place[i]
        if np.isfinite(gap[i]):
            values.paired[node] = True
            values.gap[node] = gap[i]
            values.status[node] = status[i]
            values.slip[node] = slip[i] if status[i] != OPEN else 0.0
    return values


def _between_nodes(stored: Stored, record: Any) -> SlaveValues:
    """Points stand between the nodes: the forces that the nodes get of them, their parts along and across the normals
    of the deformed slave at the nodes."""
    nodes, model = record.slave_nodes, stored.solved.model
    fields = model.nodal_fields(stored.state, ["contact_force", "contact_gap", "contact_status", "contact_slip"])
    force, slip = np.zeros((len(nodes), 3)), np.zeros((len(nodes), 2))
    for target, name in ((force, "contact_force"), (slip, "contact_slip")):
        given = np.asarray(fields[name])[nodes].reshape(len(nodes), -1)
        target[:, :given.shape[1]] = given
    normal = force
    if record.friction:
        mesh = stored.solved.mesh
        moved = np.asarray(mesh.mesh.points) + stored.state.displacement(model)
        outward = nodal_normals(mesh, record.slave_cells, moved, stored.solved.cell_of)[nodes]
        normal = np.einsum("nx,nx->n", force, outward)[:, None] * outward
    return SlaveValues(nodes, np.asarray(fields["contact_status"])[nodes].ravel(), np.ones(len(nodes), bool),
                       np.asarray(fields["contact_gap"])[nodes].ravel(), normal, force - normal, slip)


# ---- multipliers -----------------------------------------------------------------------------------------------


def multipliers(stored: Stored) -> tuple[tuple[str, ...], np.ndarray]:
    """LAGS_C, LAGS_F1, LAGS_F2 at the slave nodes of CONTINUE: names, and nodes × components, nan elsewhere."""
    solved = stored.solved
    zones = [record for record in solved.zones if record.formulation == "CONTINUE" and record.resolved]
    if not zones:
        return (), np.zeros((0, 0))
    dimension = solved.mesh.dimension
    tangents = dimension - 1 if any(record.friction for record in zones) else 0
    names = ("LAGS_C", "LAGS_F1", "LAGS_F2")[:1 + tangents]
    columns = np.full((solved.mesh.mesh.node_count, 1 + tangents), np.nan)
    pressure = np.asarray(solved.model.nodal_fields(stored.state, ["contact_pressure"])["contact_pressure"]).ravel()
    for record in zones:
        columns[record.slave_nodes, 0] = -pressure[record.slave_nodes]
        if tangents:
            columns[record.slave_nodes, 1:] = _semi_multipliers(stored, record, tangents)
    return names, columns


def _semi_multipliers(stored: Stored, record: Any, tangents: int) -> np.ndarray:
    """Where they are unknowns, these; else friction over its limit, along the slip."""
    count = len(record.slave_nodes)
    if not record.friction:
        return np.zeros((count, tangents))
    unknowns = np.asarray(stored.state.zones[record.index].multipliers)
    if record.method == "STANDARD" and len(unknowns) == count * (1 + tangents):
        return unknowns.reshape(count, 1 + tangents)[:, 1:]
    values = slave_values(stored, record)
    limit = record.friction * np.linalg.norm(values.normal, axis=1)
    lengths = np.linalg.norm(values.slip, axis=1)
    share = np.divide(np.linalg.norm(values.tangential, axis=1), limit, out=np.zeros(count), where=limit > 0)
    ways = np.divide(values.slip, lengths[:, None], out=np.zeros((count, 2)), where=lengths[:, None] > 0)
    return (share[:, None] * ways)[:, :tangents]


# ---- CONT_NOEU -------------------------------------------------------------------------------------------------


def contact_nodes(result: Result, stored: Stored) -> NodalField:
    solved = stored.solved
    if not solved.zones:
        raise CommandError(f"field CONT_NOEU of result {result.name} is not available: there is no contact.")
    values = np.full((solved.mesh.mesh.node_count, len(CONTACT)), np.nan)
    for record in solved.zones:
        lines = _lines(stored, record)
        values[record.slave_nodes] = lines
    _add_impulses(result, stored, values)
    return NodalField(solved.mesh, "INFC_R", CONTACT, values)


def _lines(stored: Stored, record: Any) -> np.ndarray:
    """Nodes × CONTACT of a zone, without impulses."""
    of = slave_values(stored, record)
    ring = stored.solved.ring
    normal, tangential = -of.normal / ring, -of.tangential / ring
    status = _status(stored, of, record)
    closed = status > OPEN
    sticks = (status == STICK)[:, None]
    slip = np.where(closed[:, None] & bool(record.friction), of.slip, 0.0)
    whole = normal + tangential
    zero = np.zeros((len(of.nodes), 3))
    placed = _projections(stored, of)
    values = np.column_stack([
        status, of.gap, np.linalg.norm(normal, axis=1), normal, slip, np.linalg.norm(slip, axis=1),
        np.where(sticks, tangential, 0.0), np.where(sticks, 0.0, tangential), whole, np.linalg.norm(whole, axis=1),
        zero[:, :1], zero[:, :1], zero, zero, placed])
    return values + 0.0  # no -0


def _status(stored: Stored, of: SlaveValues, record: Any) -> np.ndarray:
    """Without friction every closed node slips; nodes that face nothing are -1 in DISCRETE."""
    status = of.status.copy()
    if stored.state.step == 0 and not np.any(of.normal):
        # Before the first step statuses are only a first guess.
        status[:] = OPEN
    if not record.friction:
        status[status != OPEN] = 2
    if record.formulation == "DISCRETE":
        status[~of.paired] = -1
    return status


def _projections(stored: Stored, of: SlaveValues) -> np.ndarray:
    """Where closed nodes touch the master; nan of open ones."""
    moved = (np.asarray(stored.solved.model.mesh.points)[of.nodes]
             + stored.state.displacement(stored.solved.model)[of.nodes])
    lengths = np.linalg.norm(of.normal, axis=1)[:, None]
    outward = np.divide(of.normal, lengths, out=np.full_like(of.normal, np.nan), where=lengths > 0)
    return moved - np.where(np.isfinite(of.gap), of.gap, np.nan)[:, None] * outward


def _add_impulses(result: Result, stored: Stored, values: np.ndarray) -> None:
    """I, IX, IY, IZ: forces times the lengths of their steps, since the node closed. Only of results that have stored
    every step; else nan."""
    columns = [CONTACT.index(name) for name in ("I", "IX", "IY", "IZ")]
    before = [one for one in result.stored if one.order <= stored.order and one.state is not None]
    if not before or before[-1] is not stored or not _all_steps(before):
        values[:, columns] = np.nan
        return
    sums = np.zeros((len(values), 4))
    for one in before:
        for record in one.solved.zones:
            lines = values[record.slave_nodes] if one is stored else _lines(one, record)
            forces = lines[:, [CONTACT.index(name) for name in ("R", "RX", "RY", "RZ")]]
            grown = sums[record.slave_nodes] + forces * one.state.step
            sums[record.slave_nodes] = np.where(forces[:, :1] > 0, grown, 0.0)
    there = ~np.isnan(values[:, CONTACT.index("CONT")])
    values[np.ix_(there, columns)] = sums[there]


def _all_steps(states: list[Stored]) -> bool:
    return all(abs(one.instant - last.instant - one.state.step) <= 1e-9 * max(abs(one.instant), one.state.step)
               for last, one in zip(states, states[1:]))


# ---- CONT_ELEM -------------------------------------------------------------------------------------------------


def contact_elements(stored: Stored) -> CellField:
    """Of LAC, one value a slave face: means over its nodes. PRES is negative in compression; COEFSURF is the share of
    the face that faces the master."""
    solved = stored.solved
    zones = [record for record in solved.zones if record.method == "LAC"]
    if not zones:
        raise CommandError("field CONT_ELEM is not available: it is that of DEFI_CONTACT/ALGO_CONT='LAC'.")
    pressure = np.asarray(solved.model.nodal_fields(stored.state, ["contact_pressure"])["contact_pressure"]).ravel()
    parts = []
    for record in zones:
        gap, share = _gaps_and_shares(stored, record, len(pressure))
        values = np.zeros((len(record.slave_cells), 1, len(ELEMENT)))
        for i, cell in enumerate(record.slave_cells):
            nodes = solved.mesh.nodes_of_cell(int(cell))
            p, covered = -np.mean(pressure[nodes]), np.mean(share[nodes])
            # Nodes that face nothing have no gap.
            facing = gap[nodes][np.isfinite(gap[nodes])]
            values[i, 0] = (float(p < 0), p, np.mean(facing) if len(facing) else np.nan, covered, covered * p)
        parts.append(CellPart(np.asarray(record.slave_cells), values))
    return CellField(solved.mesh, "ELEM", "NEUT_R", ELEMENT, parts)


def _gaps_and_shares(stored: Stored, record: Any, count: int) -> tuple[np.ndarray, np.ndarray]:
    points = stored.solved.model.contact_points(record.index)
    zone = stored.state.zones[record.index]
    node = np.asarray(points["node"])
    on_nodes = node >= 0
    gap, faced, whole = np.full(count, np.nan), np.zeros(count), np.zeros(count)
    gap[node[on_nodes]] = np.asarray(zone.gap)[on_nodes]
    np.add.at(faced, node[on_nodes], np.asarray(zone.area)[on_nodes])
    np.add.at(whole, node[on_nodes], np.asarray(points["area"])[on_nodes])
    return gap, np.divide(faced, whole, out=np.zeros(count), where=whole > 0)
