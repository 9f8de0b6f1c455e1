# SPDX-License-Identifier: LGPL-3.0-or-later
"""Nodes and cells chosen by where they are, and lines of segments put in order."""

from __future__ import annotations

import numpy as np

from ..concepts import MeshConcept
from ..keys import Arguments, CommandError
from .cells import in_block, kind_of

# What is on a bound but for rounding is inside: share of the size.
BOUND_ROUNDING = 1e-12

# ---- points and directions -----------------------------------------------------------------------------------


def centre(path: str, mesh: MeshConcept, where: Arguments) -> np.ndarray:
    """POINT, NOEUD_CENTRE, or the node of GROUP_NO_CENTRE."""
    given = [name for name in ("POINT", "NOEUD_CENTRE", "GROUP_NO_CENTRE") if where.given(name)]
    if len(given) != 1:
        raise CommandError(f"{path}: expected one of POINT, NOEUD_CENTRE and GROUP_NO_CENTRE.")
    if given == ["POINT"]:
        return in_space(path + "/POINT", where.POINT)
    node = one_node(path, mesh, where, "CENTRE")
    return np.asarray(mesh.mesh.points[node])


def one_node(path: str, mesh: MeshConcept, where: Arguments, ending: str) -> int | None:
    """The node of NOEUD_<ending> or GROUP_NO_<ending>, if there is one."""
    node, group = where.get(f"NOEUD_{ending}"), where.get(f"GROUP_NO_{ending}")
    if node and group:
        raise CommandError(f"{path}: expected one of NOEUD_{ending} and GROUP_NO_{ending}.")
    if node:
        return mesh.node_named(node)
    if group:
        return int(mesh.nodes_in(group)[0])
    return None


def in_space(path: str, values: tuple[float, ...]) -> np.ndarray:
    if len(values) not in (2, 3):
        raise CommandError(f"{path}: expected 2 or 3 numbers, found {len(values)}.")
    return np.array([*values, 0.0][:3])


def direction(path: str, mesh: MeshConcept, where: Arguments) -> np.ndarray:
    """VECT_NORMALE or ANGL_NAUT, of length 1."""
    if bool(where.VECT_NORMALE) == bool(where.ANGL_NAUT):
        raise CommandError(f"{path}: expected one of VECT_NORMALE and ANGL_NAUT.")
    if where.VECT_NORMALE:
        vector = in_space(path + "/VECT_NORMALE", where.VECT_NORMALE)
    else:
        vector = nautical_axis(where.ANGL_NAUT, mesh.dimension)
    size = np.linalg.norm(vector)
    if size == 0:
        raise CommandError(f"{path}/VECT_NORMALE: found a vector of length 0.")
    return vector / size


def nautical_axis(angles: tuple[float, ...], dimension: int) -> np.ndarray:
    """The x axis turned by α about z, then by β about the new y axis [degrees]."""
    alpha, beta = np.radians([*angles, 0.0, 0.0][:2])
    if dimension == 2:
        beta = 0.0
    return np.array([np.cos(alpha) * np.cos(beta), np.sin(alpha) * np.cos(beta), -np.sin(beta)])


def distances_to_axis(points: np.ndarray, point: np.ndarray, axis: np.ndarray) -> np.ndarray:
    return np.linalg.norm(np.cross(points - point, axis), axis=1)


# ---- nodes ---------------------------------------------------------------------------------------------------


def nodes_of_cells(mesh: MeshConcept, cells: np.ndarray, which: str) -> np.ndarray:
    """Nodes of cells, ascending: TOUS, or only corners (SOMMET), middles (MILIEU), centres (CENTRE) of a cell."""
    if which == "TOUS":
        return mesh.nodes_of_cells(cells)
    parts = [np.zeros(0, dtype=np.int64)]
    for block in mesh.mesh.blocks:
        kind = kind_of(block)
        edge = kind.corners + kind.middles
        columns = {"SOMMET": slice(0, kind.corners), "MILIEU": slice(kind.corners, edge),
                   "CENTRE": slice(edge, kind.nodes)}[which]
        parts.append(np.asarray(block.nodes)[in_block(block, cells)][:, columns].ravel().astype(np.int64))
    return np.unique(np.concatenate(parts))


def on_sphere(path: str, mesh: MeshConcept, where: Arguments) -> np.ndarray:
    sizes = np.linalg.norm(np.asarray(mesh.mesh.points) - centre(path, mesh, where), axis=1)
    return np.flatnonzero(np.abs(sizes - where.RAYON) <= where.PRECISION)


def on_cylinder(path: str, mesh: MeshConcept, where: Arguments) -> np.ndarray:
    _need_space(path, mesh)
    sizes = distances_to_axis(np.asarray(mesh.mesh.points), centre(path, mesh, where), direction(path, mesh, where))
    return np.flatnonzero(np.abs(sizes - where.RAYON) <= where.PRECISION)


def on_plane(path: str, mesh: MeshConcept, where: Arguments) -> np.ndarray:
    heights = (np.asarray(mesh.mesh.points) - centre(path, mesh, where)) @ direction(path, mesh, where)
    return np.flatnonzero(np.abs(heights) <= where.PRECISION)


def _need_space(path: str, mesh: MeshConcept) -> None:
    if mesh.dimension != 3:
        raise CommandError(f"{path}: a cylinder needs a mesh in space.")


def along_segment(path: str, mesh: MeshConcept, where: Arguments) -> np.ndarray:
    """Nodes in the order of their projections on the segment between two nodes."""
    origin, end = one_node(path, mesh, where, "ORIG"), one_node(path, mesh, where, "EXTR")
    nodes = mesh.nodes(where)
    if origin is None or end is None or not len(nodes):
        raise CommandError(f"{path}: expected nodes, and the node of each end.")
    points = np.asarray(mesh.mesh.points)
    axis = points[end] - points[origin]
    size = float(np.dot(axis, axis))
    if size == 0:
        raise CommandError(f"{path}: both ends are at one place.")
    ways = points[nodes] - points[origin]
    shares = ways @ axis / size
    aside = np.linalg.norm(ways - np.outer(shares, axis), axis=1)
    allowed = where.PRECISION * (np.sqrt(size) if where.CRITERE == "RELATIF" else 1.0)
    if np.any(aside > allowed):
        node = int(np.argmax(aside))
        raise CommandError(f"{path}: node {mesh.node_name(nodes[node])} is {aside[node]:g} beside the segment.")
    return nodes[np.argsort(shares, kind="stable")]


# ---- lines ---------------------------------------------------------------------------------------------------


def along_line(path: str, mesh: MeshConcept, where: Arguments) -> np.ndarray:
    """The nodes of a line of segments from its origin to its end, middles in place."""
    segments = _segments(path, mesh, where)
    origin, end = one_node(path, mesh, where, "ORIG"), one_node(path, mesh, where, "EXTR")
    start = _checked_end(path, mesh, segments, origin, end) if origin is not None else _found_end(path, segments, where)
    line = _walk(path, segments, start)
    if end is not None and line[-1] != end:
        raise CommandError(f"{path}: the line ends at node {mesh.node_name(line[-1])}, not at "
                           f"{mesh.node_name(end)}.")
    if where.VECT_ORIE and origin == end:
        line = _turned_along(np.asarray(mesh.mesh.points), line, in_space(path + "/VECT_ORIE", where.VECT_ORIE))
    return line


def _segments(path: str, mesh: MeshConcept, where: Arguments) -> np.ndarray:
    cells = np.unique(np.concatenate([mesh.cells_in(group) for group in where.GROUP_MA]))
    found = []
    for block in mesh.mesh.blocks:
        inside = in_block(block, cells)
        if len(inside):
            found.append((kind_of(block), np.asarray(block.nodes)[inside].astype(np.int64)))
    if len(found) != 1 or found[0][0].dimension != 1:
        kinds = ", ".join(kind.aster for kind, _ in found) or "none"
        raise CommandError(f"{path}/GROUP_MA: expected segments of one type, found cells of type {kinds}.")
    return found[0][1]


def _counts(segments: np.ndarray) -> dict[int, int]:
    nodes, counts = np.unique(segments[:, :2], return_counts=True)
    if np.max(counts) > 2 or np.sum(counts == 1) > 2:
        return {}
    return dict(zip(nodes.tolist(), counts.tolist()))


def _checked_end(path: str, mesh: MeshConcept, segments: np.ndarray, origin: int, end: int | None) -> int:
    count = _counts(segments).get(origin, 0)
    if count != 1 and not (origin == end and count == 2):
        raise CommandError(f"{path}: node {mesh.node_name(origin)} is no end of one line of segments.")
    return origin


def _found_end(path: str, segments: np.ndarray, where: Arguments) -> int:
    counts = _counts(segments)
    if not counts:
        raise CommandError(f"{path}/GROUP_MA: the segments are no single line.")
    for node in segments[:, :2].T.ravel().tolist():
        if counts[node] == 1:
            return node
    if where.ORIGINE == "SANS":
        return int(segments[0, 0])
    raise CommandError(f"{path}: the line is closed; name its origin, or write ORIGINE='SANS'.")


def _walk(path: str, segments: np.ndarray, start: int) -> np.ndarray:
    at_node: dict[int, list[int]] = {}
    for number, (first, second) in enumerate(segments[:, :2].tolist()):
        at_node.setdefault(first, []).append(number)
        at_node.setdefault(second, []).append(number)
    line, used, node = [start], set(), start
    for _ in range(len(segments)):
        ahead = [number for number in at_node[node] if number not in used]
        if not ahead:
            raise CommandError(f"{path}/GROUP_MA: the segments are no single line.")
        used.add(ahead[0])
        segment = segments[ahead[0]]
        node = int(segment[1] if segment[0] == node else segment[0])
        line += [*segment[2:].tolist(), node]
    return np.array(line, dtype=np.int64)


def _turned_along(points: np.ndarray, line: np.ndarray, wanted: np.ndarray) -> np.ndarray:
    def share(first: int, second: int) -> float:
        way = points[second] - points[first]
        return float(np.dot(way, wanted) / np.linalg.norm(way))

    return line[::-1] if share(line[-1], line[-2]) > share(line[0], line[1]) else line


# ---- cells ---------------------------------------------------------------------------------------------------


def with_nodes(mesh: MeshConcept, inside: np.ndarray, rule: str) -> np.ndarray:
    """Cells of which at least one node (AU_MOINS_UN), at least half of them (MAJORITE), all (TOUS, TOUT) or all
    corners (SOMMET) are inside."""
    found = []
    for block in mesh.mesh.blocks:
        nodes = np.asarray(block.nodes)
        columns = kind_of(block).corners if rule == "SOMMET" else nodes.shape[1]
        counts = np.sum(inside[nodes[:, :columns]], axis=1)
        least = {"AU_MOINS_UN": 1, "MAJORITE": (columns + 1) // 2}.get(rule, columns)
        found.append(np.flatnonzero(counts >= least) + block.first)
    return np.concatenate([np.zeros(0, dtype=np.int64), *found])


def in_sphere(path: str, mesh: MeshConcept, where: Arguments) -> np.ndarray:
    sizes = np.linalg.norm(np.asarray(mesh.mesh.points) - centre(path, mesh, where), axis=1)
    return with_nodes(mesh, sizes <= where.RAYON * (1 + BOUND_ROUNDING), where.CRIT_NOEUD)


def in_cylinder(path: str, mesh: MeshConcept, where: Arguments) -> np.ndarray:
    _need_space(path, mesh)
    sizes = distances_to_axis(np.asarray(mesh.mesh.points), centre(path, mesh, where), direction(path, mesh, where))
    return with_nodes(mesh, sizes <= where.RAYON * (1 + BOUND_ROUNDING), where.CRIT_NOEUD)


def in_band(path: str, mesh: MeshConcept, where: Arguments) -> np.ndarray:
    heights = (np.asarray(mesh.mesh.points) - centre(path, mesh, where)) @ direction(path, mesh, where)
    return with_nodes(mesh, np.abs(heights) <= where.DIST * (1 + BOUND_ROUNDING), where.CRIT_NOEUD)


def on_nodes(path: str, mesh: MeshConcept, where: Arguments) -> np.ndarray:
    if where.TYPE_APPUI is None:
        raise CommandError(f"{path}: keyword TYPE_APPUI is missing.")
    inside = np.zeros(mesh.mesh.node_count, dtype=bool)
    inside[mesh.nodes(where)] = True
    return with_nodes(mesh, inside, where.TYPE_APPUI)


def facing(path: str, mesh: MeshConcept, where: Arguments) -> np.ndarray:
    """Sides (of solids in space, of surfaces in the plane) whose normal, from their first corners, is along a
    direction within ANGL_PREC."""
    axis = direction(path, mesh, where)
    limit = np.cos(np.radians(where.ANGL_PREC))
    found = []
    for block in mesh.mesh.blocks:
        if kind_of(block).dimension != mesh.dimension - 1:
            continue
        normals = corner_normals(np.asarray(mesh.mesh.points), np.asarray(block.nodes), kind_of(block).dimension)
        shares = normals @ axis
        if where.VERI_SIGNE == "NON":
            shares = np.abs(shares)
        found.append(np.flatnonzero(shares > limit) + block.first)
    return np.concatenate([np.zeros(0, dtype=np.int64), *found])


def corner_normals(points: np.ndarray, nodes: np.ndarray, dimension: int) -> np.ndarray:
    """Of length 1: of segments (dimension 1) in the plane, to their right; of surfaces, by their first corners."""
    first = points[nodes[:, 1]] - points[nodes[:, 0]]
    if dimension == 1:
        normals = np.column_stack([first[:, 1], -first[:, 0], np.zeros(len(first))])
    else:
        normals = np.cross(first, points[nodes[:, 2]] - points[nodes[:, 0]])
    sizes = np.linalg.norm(normals, axis=1)
    return normals / np.where(sizes == 0, 1.0, sizes)[:, None]
