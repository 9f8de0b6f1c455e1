# SPDX-License-Identifier: LGPL-3.0-or-later
"""Normals of skins at their nodes."""

from __future__ import annotations

import numpy as np

from .concepts import MeshConcept
from .keys import CommandError
from .mesh_parts import block_of, blocks_with, nodes_of_part
from .shapes import DIMENSIONS, reference_nodes, shape_gradients


def nodal_normals(mesh: MeshConcept, faces: np.ndarray, points: np.ndarray, bodies: np.ndarray) -> np.ndarray:
    """Unit normals at the nodes of faces: the mean of the unit normals of the faces there, out of the bodies behind
    them. Nodes × 3, nan elsewhere. `points`: where the nodes are."""
    sums = np.zeros((mesh.mesh.node_count, 3))
    met = np.zeros(mesh.mesh.node_count, bool)
    for cell_type, cells in blocks_with(mesh, faces):
        if DIMENSIONS.get(cell_type) != mesh.dimension - 1:
            continue
        nodes = nodes_of_part(mesh, cells)
        each = face_normals(cell_type, points[nodes], mesh.dimension)
        outward = _outward_signs(mesh, nodes, points, bodies, each)
        np.add.at(sums, nodes.ravel(), (each * outward[:, None, None]).reshape(-1, 3))
        met[nodes.ravel()] = True
    if not np.any(met):
        raise CommandError("NORMALE: GROUP_MA has no faces.")
    lengths = np.linalg.norm(sums, axis=1)
    result = np.full_like(sums, np.nan)
    result[met] = sums[met] / np.maximum(lengths[met], 1e-300)[:, None]
    return result


def face_normals(cell_type: str, corners: np.ndarray, dimension: int) -> np.ndarray:
    """Unit normals at the nodes of each face, by its own orientation: faces × nodes × 3."""
    gradients = shape_gradients(cell_type, reference_nodes(cell_type))
    tangents = np.einsum("pnd,cnx->cpdx", gradients, corners)
    if dimension == 2:
        normals = np.stack([tangents[:, :, 0, 1], -tangents[:, :, 0, 0], np.zeros(tangents.shape[:2])], axis=2)
    else:
        normals = np.cross(tangents[:, :, 0], tangents[:, :, 1])
    return normals / np.linalg.norm(normals, axis=2)[:, :, None]


def _outward_signs(mesh: MeshConcept, faces: np.ndarray, points: np.ndarray, bodies: np.ndarray,
                   normals: np.ndarray) -> np.ndarray:
    """1 where the normal points away from the body cell behind the face, -1 where into it; 1 without one."""
    behind = bodies_behind(mesh, faces, bodies)
    signs = np.ones(len(faces))
    for i, cell in enumerate(behind):
        if cell < 0:
            continue
        block = block_of(mesh, int(cell))
        inside = points[np.asarray(block.nodes)[cell - block.first]].mean(axis=0)
        away = points[faces[i]].mean(axis=0) - inside
        signs[i] = 1.0 if normals[i].mean(axis=0) @ away >= 0 else -1.0
    return signs


def bodies_behind(mesh: MeshConcept, faces: np.ndarray, bodies: np.ndarray) -> np.ndarray:
    """Of each face a cell of highest dimension that has all its nodes; -1: none."""
    wanted = {frozenset(face.tolist()): i for i, face in enumerate(faces)}
    on_faces = np.zeros(mesh.mesh.node_count, bool)
    on_faces[faces.ravel()] = True
    found = np.full(len(faces), -1)
    touching: dict[int, list[int]] = {}
    cell_nodes: dict[int, frozenset[int]] = {}
    for cell_type, cells in blocks_with(mesh, bodies):
        if DIMENSIONS.get(cell_type, 3) != mesh.dimension:
            continue
        for cell, nodes in zip(cells, nodes_of_part(mesh, cells)):
            shared = nodes[on_faces[nodes]]
            if len(shared) < mesh.dimension:
                continue
            cell_nodes[int(cell)] = frozenset(shared.tolist())
            for node in shared:
                touching.setdefault(int(node), []).append(int(cell))
    for nodes, i in wanted.items():
        for cell in touching.get(next(iter(nodes)), ()):
            if nodes <= cell_nodes[cell]:
                found[i] = cell
                break
    return found
