# SPDX-License-Identifier: LGPL-3.0-or-later
"""LIAISON_DDL, LIAISON_UNIF, LIAISON_GROUP, LIAISON_SOLIDE, LIAISON_MAIL: linear relations between displacements."""

from __future__ import annotations

from typing import Any

import numpy as np

import rubato

from ..concepts import Function, LoadConcept
from ..keys import Arguments, CommandError
from .problem import AXES, Problem
from .supports import nodes_without, turned_axes


def add_relations(problem: Problem, loads: list[tuple[LoadConcept, Function | None]]) -> None:
    made: list[Any] = []
    for load, multiplier in loads:
        arguments = load.arguments
        for item in arguments.get("LIAISON_DDL") or []:
            made.append(equation(problem, load.command, item, multiplier))
        for item in arguments.get("LIAISON_UNIF") or []:
            made.append(equal(problem, item))
        for item in arguments.get("LIAISON_GROUP") or []:
            made += paired(problem, load.command, item, multiplier)
        for item in arguments.get("LIAISON_SOLIDE") or []:
            nodes = problem.moving(problem.concept.nodes(item))
            made.append(rubato.Relation(kind="rigid", on=problem.node_group(nodes)))
        for item in arguments.get("LIAISON_MAIL") or []:
            made.append(embedded(problem, load.command, item))
    for number, relation in enumerate(made, 1):
        relation.name = f"relation_{number}"
    problem.study.relations = made


def term(problem: Problem, node: int, axis: int, coefficient: float) -> Any:
    coefficients = [0.0, 0.0, 0.0]
    coefficients[axis] = coefficient
    return rubato.RelationTerm(on=problem.node_group([node]), coefficients=tuple(coefficients))


def equation(problem: Problem, command: str, item: Arguments, multiplier: Function | None) -> Any:
    """Σ COEF_MULT · DDL = COEF_IMPO, a component for each node that is listed."""
    nodes: list[int] = []
    for name in item.GROUP_NO:
        nodes += problem.concept.nodes_in(name).tolist()
    nodes += [problem.concept.node_named(name) for name in item.NOEUD]
    if not len(nodes) == len(item.DDL) == len(item.COEF_MULT):
        raise CommandError(f"{command}/LIAISON_DDL: expected as many nodes as DDL and COEF_MULT, found {len(nodes)}, "
                           f"{len(item.DDL)} and {len(item.COEF_MULT)}.")
    value = item.COEF_IMPO if item.COEF_IMPO is not None else 0.0
    terms = [term(problem, node, AXES[name], factor)
             for node, name, factor in zip(nodes, item.DDL, item.COEF_MULT)]
    return rubato.Relation(kind="equation", terms=terms, value=problem.displacement(value, multiplier))


def equal(problem: Problem, item: Arguments) -> Any:
    axes = {AXES[name] for name in item.DDL}
    nodes = problem.moving(nodes_without(problem.concept, item))
    return rubato.Relation(kind="equal", on=problem.node_group(nodes),
                           components=tuple(axis in axes for axis in range(3)))


def paired(problem: Problem, command: str, item: Arguments, multiplier: Function | None) -> list[Any]:
    """A relation for each node of the first group and the node of the second that its turned and moved place is nearest
    to."""
    if "DNOR" in (*item.DDL_1, *item.DDL_2):
        raise CommandError(f"{command}/LIAISON_GROUP: DNOR is not available; write components.")
    first, second = nodes_of_side(problem, item, "1"), nodes_of_side(problem, item, "2")
    if len(first) != len(second):
        raise CommandError(f"{command}/LIAISON_GROUP: the groups have {len(first)} and {len(second)} nodes.")
    ones = item.COEF_MULT_1 or (1.0,) * len(item.DDL_1)
    twos = item.COEF_MULT_2 or (1.0,) * len(item.DDL_2)
    if len(ones) != len(item.DDL_1) or len(twos) != len(item.DDL_2):
        raise CommandError(f"{command}/LIAISON_GROUP: expected a COEF_MULT for each DDL.")
    value = item.COEF_IMPO if item.COEF_IMPO is not None else 0.0
    made = []
    for one, two in partners(problem, command, item, first, second):
        terms = [term(problem, one, AXES[name], factor) for name, factor in zip(item.DDL_1, ones)]
        terms += [term(problem, two, AXES[name], factor) for name, factor in zip(item.DDL_2, twos)]
        made.append(rubato.Relation(kind="equation", terms=terms, value=problem.displacement(value, multiplier)))
    return made


def nodes_of_side(problem: Problem, item: Arguments, side: str) -> np.ndarray:
    mesh = problem.concept
    nodes = np.unique(mesh.nodes(item, after=f"_{side}"))
    return nodes[~np.isin(nodes, mesh.nodes(item, "SANS_"))]


def partners(problem: Problem, command: str, item: Arguments, first: np.ndarray,
             second: np.ndarray) -> list[tuple[int, int]]:
    points = np.asarray(problem.concept.mesh.points)
    centre = np.array((*item.CENTRE, 0.0, 0.0, 0.0)[:3])
    axes = turned_axes(item.ANGL_NAUT or (0.0,))
    moved = (points[first] - centre) @ axes + centre + np.array((*item.TRAN, 0.0, 0.0, 0.0)[:3])
    found = []
    taken: set[int] = set()
    for node, place in zip(first, moved):
        nearest = int(np.argmin(np.linalg.norm(points[second] - place, axis=1)))
        if nearest in taken:
            name = problem.concept.node_name(int(second[nearest]))
            raise CommandError(f"{command}/LIAISON_GROUP: node {name} is the partner of two nodes.")
        taken.add(nearest)
        found.append((int(node), int(second[nearest])))
    return found


def embedded(problem: Problem, command: str, item: Arguments) -> Any:
    if item.DDL_MAIT or item.DDL_ESCL:
        raise CommandError(f"{command}/LIAISON_MAIL: DNOR is not available; the whole displacement is tied.")
    mesh = problem.concept
    slave, cells = np.unique(mesh.nodes(item, after="_ESCL")), np.unique(mesh.cells(item, after="_MAIT"))
    if len(slave) == 0 or len(cells) == 0:
        raise CommandError(f"{command}/LIAISON_MAIL: there are no slave nodes or no master cells.")
    return rubato.Relation(kind="embedded", on=problem.node_group(slave),
                           cells=problem.cell_group(cells))
