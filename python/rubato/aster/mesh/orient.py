# SPDX-License-Identifier: LGPL-3.0-or-later
"""Surfaces turned: outwards from the bodies behind them, or alike with a given normal."""

from __future__ import annotations

from collections import deque
from typing import Any

import numpy as np

from ..concepts import MeshConcept
from ..keys import CommandError
from .cells import SIDES, TURNED, family, in_block, kind_of, word_of
from .pieces import built, pieces_of
from .select import corner_normals

# ---- turning -------------------------------------------------------------------------------------------------


def turned(mesh: Any, cells: np.ndarray) -> Any:
    """The mesh with these segments and surfaces turned round."""
    if not len(cells):
        return mesh
    pieces = pieces_of(mesh)
    for part, block in zip(pieces.cells, mesh.blocks):
        places = in_block(block, cells)
        if len(places):
            part.nodes[places] = part.nodes[places][:, TURNED[part.type]]
    return built(pieces)


def faces_of(mesh: Any, cells: np.ndarray) -> tuple[np.ndarray, list[tuple[int, ...]]]:
    """Those of `cells` that can bound bodies, and their corners."""
    wanted, corners = [], []
    for block in mesh.blocks:
        kind = kind_of(block)
        if kind.dimension != mesh.dimension - 1:
            continue
        places = in_block(block, cells)
        wanted.append(places + block.first)
        corners += [tuple(row) for row in np.asarray(block.nodes)[places][:, :kind.corners].tolist()]
    return np.concatenate([np.zeros(0, dtype=np.int64), *wanted]), corners


# ---- outwards ------------------------------------------------------------------------------------------------


def outwards(mesh: Any, cells: np.ndarray, bodies: np.ndarray | None) -> Any:
    """The mesh with the normals of these faces pointing out of the cells behind them, chosen among `bodies` when they
    are given. Faces with no cell behind them, or one on each side, stay as they are."""
    faces, corners = faces_of(mesh, cells)
    behind = _sides_behind(mesh, corners, bodies)
    wrong = [face for face, own in zip(faces.tolist(), corners)
             if len(behind.get(frozenset(own), ())) == 1 and not _runs_alike(own, behind[frozenset(own)][0])]
    return turned(mesh, np.array(wrong, dtype=np.int64))


def _sides_behind(mesh: Any, corners: list[tuple[int, ...]],
                  bodies: np.ndarray | None) -> dict[frozenset[int], list[tuple[int, ...]]]:
    """By the corners of a face: the sides of cells there, each with its corners in outward order."""
    wanted: dict[frozenset[int], list[tuple[int, ...]]] = {frozenset(own): [] for own in corners}
    on_face = np.zeros(mesh.node_count, dtype=bool)
    on_face[[node for own in corners for node in own]] = True
    for block in mesh.blocks:
        if kind_of(block).dimension != mesh.dimension:
            continue
        nodes = np.asarray(block.nodes)
        if bodies is not None:
            nodes = nodes[in_block(block, bodies)]
        for side in SIDES[family(word_of(block))]:
            rows = nodes[:, side]
            for row in rows[np.all(on_face[rows], axis=1)].tolist():
                if frozenset(row) in wanted:
                    wanted[frozenset(row)].append(tuple(row))
    return wanted


def _runs_alike(first: tuple[int, ...], second: tuple[int, ...]) -> bool:
    """Whether the corners of both run the same way round."""
    place = second.index(first[0])
    if len(first) == 2:
        return place == 0
    return second[(place + 1) % len(second)] == first[1]


# ---- alike ---------------------------------------------------------------------------------------------------


def alike(path: str, mesh: MeshConcept, cells: np.ndarray, node: int | None, wanted: np.ndarray | None) -> Any:
    """The mesh with these faces turned as their neighbours are, beginning at a face with that node whose normal gets
    the wanted direction; without them as the first face of each connected part."""
    faces, corners = faces_of(mesh.mesh, cells)
    if not len(faces):
        raise CommandError(f"{path}: the groups have no cells that can be a surface.")
    turn = np.zeros(len(faces), dtype=bool)
    reached = np.zeros(len(faces), dtype=bool)
    starts = list(range(len(faces)))
    if node is not None and wanted is not None:
        start = _start(path, mesh, faces, corners, node)
        turn[start] = float(_normal(mesh, int(faces[start])) @ wanted) < 0
        starts.insert(0, start)
    neighbours = _neighbours(corners)
    for start in starts:
        _spread(start, corners, neighbours, turn, reached)
    return turned(mesh.mesh, faces[turn])


def _start(path: str, mesh: MeshConcept, faces: np.ndarray, corners: list[tuple[int, ...]], node: int) -> int:
    nodes = [set(mesh.nodes_of_cell(int(face)).tolist()) for face in faces]
    at = [i for i, own in enumerate(nodes) if node in own]
    if not at:
        raise CommandError(f"{path}: node {mesh.node_name(node)} is not on the surface.")
    return at[0]


def _normal(mesh: MeshConcept, face: int) -> np.ndarray:
    nodes = mesh.nodes_of_cell(face)[None, :]
    return corner_normals(np.asarray(mesh.mesh.points), nodes, mesh.dimension - 1)[0]


def _borders(corners: tuple[int, ...]) -> list[tuple[frozenset[int], bool]]:
    """The borders of a face, and whether the face runs along each from its smaller node on; a segment ends (True) and
    begins at its nodes."""
    if len(corners) == 2:
        return [(frozenset(corners[:1]), False), (frozenset(corners[1:]), True)]
    pairs = zip(corners, (*corners[1:], corners[0]))
    return [(frozenset(pair), pair[0] < pair[1]) for pair in pairs]


def _neighbours(corners: list[tuple[int, ...]]) -> dict[frozenset[int], list[tuple[int, bool]]]:
    at_border: dict[frozenset[int], list[tuple[int, bool]]] = {}
    for face, own in enumerate(corners):
        for border, forwards in _borders(own):
            at_border.setdefault(border, []).append((face, forwards))
    return at_border


def _spread(start: int, corners: list[tuple[int, ...]], at_border: dict[frozenset[int], list[tuple[int, bool]]],
            turn: np.ndarray, reached: np.ndarray) -> None:
    if reached[start]:
        return
    reached[start] = True
    waiting = deque([start])
    while waiting:
        face = waiting.popleft()
        for border, forwards in _borders(corners[face]):
            for other, other_forwards in at_border[border]:
                if not reached[other]:
                    # Neighbours turned alike run along their border in opposite directions.
                    turn[other] = bool(turn[face]) != (forwards == other_forwards)
                    reached[other] = True
                    waiting.append(other)
