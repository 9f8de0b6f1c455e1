# SPDX-License-Identifier: LGPL-3.0-or-later
"""DDL_IMPO, FACE_IMPO, ARETE_IMPO, MECA_IMPO, LIAISON_OBLIQUE: displacements that are given."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

import rubato

from ..concepts import Function, LoadConcept, MeshConcept
from ..keys import Arguments, CommandError
from .problem import Problem

COMPONENTS = ("DX", "DY", "DZ")


@dataclass(frozen=True)
class Imposed:
    """Where a displacement comes from: equal sources are one support."""

    value: Any
    multiplier: Function | None
    load: str


class ImposedDisplacements:
    """What is imposed on each component of each node, over all loads of a command."""

    def __init__(self) -> None:
        self.of: dict[tuple[int, int], Imposed] = {}

    def add(self, other: dict[tuple[int, int], Imposed], mesh: MeshConcept) -> None:
        """Adds those of one load. Two loads that say different things of one component are an error, as they are in
        Code_Aster (a singular matrix)."""
        for key, source in other.items():
            there = self.of.get(key)
            if there is not None and (there.value, there.multiplier) != (source.value, source.multiplier):
                node, axis = key
                raise CommandError(f"EXCIT: loads {there.load} and {source.load} both impose {COMPONENTS[axis]} of "
                                   f"node {mesh.node_name(node)}.")
            self.of[key] = source

    def at(self, node: int, axis: int) -> Imposed | None:
        return self.of.get((node, axis))


def imposed_by(problem: Problem, load: LoadConcept, multiplier: Function | None) -> dict[tuple[int, int], Imposed]:
    """Of one load: later entries count."""
    imposed: dict[tuple[int, int], Imposed] = {}
    for keyword in ("DDL_IMPO", "FACE_IMPO", "ARETE_IMPO", "MECA_IMPO"):
        for item in load.arguments.get(keyword) or []:
            nodes = nodes_without(problem.concept, item)
            for axis, value in values_of(problem, item).items():
                source = Imposed(value, multiplier, load.name)
                imposed.update({(int(node), axis): source for node in nodes})
    return imposed


def values_of(problem: Problem, item: Arguments) -> dict[int, Any]:
    """Components that an entry gives, by axis."""
    values = {axis: item.get(name) for axis, name in enumerate(COMPONENTS) if item.get(name) is not None}
    if item.get("LIAISON") or item.get("BLOCAGE"):
        values.update({axis: 0.0 for axis in range(problem.dimension)})
    return {axis: value for axis, value in values.items() if axis < problem.dimension}


def nodes_without(mesh: MeshConcept, item: Arguments) -> np.ndarray:
    """The nodes of an entry without those of SANS_*."""
    nodes = mesh.nodes(item)
    return nodes[~np.isin(nodes, mesh.nodes(item, "SANS_"))]


def add_supports(problem: Problem, loads: list[tuple[LoadConcept, Function | None]]) -> ImposedDisplacements:
    whole = ImposedDisplacements()
    for load, multiplier in loads:
        whole.add(imposed_by(problem, load, multiplier), problem.concept)
    supports = list(supports_of(problem, whole))
    for load, multiplier in loads:
        supports += oblique_supports(problem, load, multiplier)
    problem.study.supports = supports
    return whole


def supports_of(problem: Problem, whole: ImposedDisplacements) -> list[Any]:
    """A support for the nodes and the component of each source."""
    moving = set(problem.moving(sorted({node for node, _ in whole.of})).tolist())
    nodes_of: dict[tuple[int, int], list[int]] = {}
    sources: dict[int, Imposed] = {}
    for (node, axis), source in whole.of.items():
        if node in moving:
            sources[id(source)] = source
            nodes_of.setdefault((id(source), axis), []).append(node)
    made = []
    for (source_id, axis), nodes in nodes_of.items():
        source = sources[source_id]
        support = rubato.Support(on=problem.node_group(sorted(nodes)))
        components = [None, None, None]
        components[axis] = problem.displacement(source.value, source.multiplier)
        support.components = tuple(components)
        made.append(support)
    return made


def oblique_supports(problem: Problem, load: LoadConcept, multiplier: Function | None) -> list[Any]:
    made = []
    for item in load.arguments.get("FACE_IMPO") or []:
        if item.DNOR is None:
            continue
        if item.SANS_GROUP_MA or item.SANS_MAILLE or item.SANS_GROUP_NO or item.SANS_NOEUD:
            raise CommandError(f"{load.command}/FACE_IMPO: DNOR without some of the nodes is not available.")
        support = rubato.Support(on=problem.cell_group(problem.concept.cells(item)))
        support.along = rubato.ObliqueSupport(normal=True, value=problem.displacement(item.DNOR, multiplier))
        made.append(support)
    for item in load.arguments.get("LIAISON_OBLIQUE") or []:
        axes = turned_axes(item.ANGL_NAUT)
        group = problem.node_group(problem.moving(problem.concept.nodes(item)))
        for axis, value in values_of(problem, item).items():
            support = rubato.Support(on=group)
            imposed = problem.displacement(value, multiplier)
            support.along = rubato.ObliqueSupport(direction=tuple(axes[axis]), value=imposed)
            made.append(support)
    return made


def turned_axes(degrees: tuple[float, ...]) -> np.ndarray:
    """The local axes of ANGL_NAUT, a row each: turned about z, then about the new y, then about the new x, each by the
    right-hand rule."""
    alpha, beta, gamma = np.radians((*degrees, 0.0, 0.0)[:3])
    ca, sa, cb, sb, cg, sg = np.cos(alpha), np.sin(alpha), np.cos(beta), np.sin(beta), np.cos(gamma), np.sin(gamma)
    # The rotation R = Rz(α) Ry(β) Rx(γ) has the new axes as columns.
    turn = (np.array([[ca, -sa, 0], [sa, ca, 0], [0, 0, 1]]) @ np.array([[cb, 0, sb], [0, 1, 0], [-sb, 0, cb]])
            @ np.array([[1, 0, 0], [0, cg, -sg], [0, sg, cg]]))
    return turn.T
