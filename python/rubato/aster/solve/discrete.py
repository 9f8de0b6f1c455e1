# SPDX-License-Identifier: LGPL-3.0-or-later
"""Discrete elements (DISCRET, DISCRET_2D): springs, dashpots and masses on two-node cells and at nodes."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

import rubato

from ..commands.model import DISCRETE
from ..concepts import DiscreteField, Function
from ..keys import Arguments, CommandError
from .cells import dimensions, kinds_of_cells
from .problem import Problem, evaluate
from .supports import Imposed, ImposedDisplacements


@dataclass(frozen=True)
class Spring:
    """A spring along one direction from a node of a body to an end that belongs to none: rubato knows the ground only,
    so results need the force on the end, and the load that stands for its displacement."""

    node: int
    far: int
    along: np.ndarray
    stiffness: float


NUMBERS = {"K_T_D_L": "stiffness", "A_T_D_L": "damping", "K_T_D_N": "stiffness", "A_T_D_N": "damping"}


def add_discrete(problem: Problem, discrete: DiscreteField | None, imposed: ImposedDisplacements) -> None:
    """Discrete elements of cells that the model has as such; later entries of one kind count."""
    if discrete is None:
        return
    kinds = kinds_of_cells(problem)
    is_discrete = np.array([part.kind in DISCRETE for part in problem.model.parts] + [False])[kinds]
    last: dict[tuple[int, str], Arguments] = {}
    for item in discrete.parts:
        for cell in cells_of(problem, item):
            if not is_discrete[cell]:
                name = problem.concept.cell_name(int(cell))
                raise CommandError(f"AFFE_CARA_ELEM/DISCRET: cell {name} is no discrete element of model "
                                   f"{problem.model.name}.")
            last[int(cell), item.CARA] = item
    for (cell, kind), item in last.items():
        add_cell(problem, cell, kind, item, imposed)
    for item in discrete.parts:
        for node in nodes_of(problem, item):
            add_to_node(problem, int(node), item.CARA, item, problem.ring)


def cells_of(problem: Problem, item: Arguments) -> np.ndarray:
    cells = problem.concept.cells(item)
    wanted = 1 if item.CARA.endswith("_L") else 0
    return cells[dimensions(problem.concept.mesh)[cells] == wanted]


def nodes_of(problem: Problem, item: Arguments) -> list[int]:
    if item.CARA.endswith("_L"):
        return []
    nodes: list[int] = []
    for name in item.GROUP_NO:
        nodes += problem.concept.nodes_in(name).tolist()
    return nodes + [problem.concept.node_named(name) for name in item.NOEUD]


def add_cell(problem: Problem, cell: int, kind: str, item: Arguments, imposed: ImposedDisplacements) -> None:
    nodes = [int(node) for node in problem.concept.nodes_of_cell(cell)]
    if kind.endswith("_N"):
        add_to_node(problem, nodes[0], kind, item, problem.ring)
    elif kind.startswith("M_"):
        if any(item.VALE):
            raise CommandError(f"AFFE_CARA_ELEM/DISCRET: {kind} other than 0 is not available; M_T_D_N is.")
    else:
        add_spring(problem, nodes, kind, item, imposed)


def add_to_node(problem: Problem, node: int, kind: str, item: Arguments, ring: float) -> None:
    if len(problem.moving([node])) == 0:
        raise CommandError(f"AFFE_CARA_ELEM/DISCRET: node {problem.concept.node_name(node)} belongs to no body.")
    on = problem.node_group([node])
    if kind == "M_T_D_N":
        problem.study.masses = [*problem.study.masses, rubato.PointMasses(on=on, mass=item.VALE[0] * ring)]
        return
    check_size(problem, kind, item)
    for axis, amount in enumerate(item.VALE):
        if amount:
            connect(problem, on, "", np.eye(3)[axis], kind, amount * ring)


def check_size(problem: Problem, kind: str, item: Arguments) -> None:
    if len(item.VALE) != problem.dimension:
        raise CommandError(f"AFFE_CARA_ELEM/DISCRET: {kind} takes {problem.dimension} numbers, found {len(item.VALE)}.")


def connect(problem: Problem, on: str, to: str, along: np.ndarray, kind: str, amount: float) -> None:
    connector = rubato.Connector(on=on, to=to, along=tuple(float(value) for value in along))
    setattr(connector, NUMBERS[kind], amount)
    problem.study.connectors = [*problem.study.connectors, connector]


def add_spring(problem: Problem, nodes: list[int], kind: str, item: Arguments, imposed: ImposedDisplacements) -> None:
    """A connector along each axis. An end that belongs to no body has all displacements imposed: it is the ground, and
    where it moves, the spring's force by that is a force on the other end."""
    check_size(problem, kind, item)
    on_bodies = [node for node in nodes if len(problem.moving([node]))]
    if not on_bodies:
        return
    axes = local_axes(problem, nodes) if item.REPERE == "LOCAL" else np.eye(3)
    for axis, amount in enumerate(item.VALE):
        if not amount:
            continue
        if len(on_bodies) == 2:
            connect(problem, problem.node_group([nodes[0]]), problem.node_group([nodes[1]]), axes[axis], kind,
                    amount * problem.ring)
        else:
            node = on_bodies[0]
            connect(problem, problem.node_group([node]), "", axes[axis], kind, amount * problem.ring)
            far = nodes[1] if nodes[0] == node else nodes[0]
            if NUMBERS[kind] == "stiffness":
                problem.springs.append(Spring(node, far, axes[axis], amount * problem.ring))
            pull_from(problem, node, far, axes[axis], kind, amount * problem.ring, imposed)


def pull_from(problem: Problem, node: int, far: int, along: np.ndarray, kind: str, amount: float,
              imposed: ImposedDisplacements) -> None:
    """The force k d (d·U) on the node, U being what is imposed on the far end of a spring along d."""
    for axis in range(problem.dimension):
        if abs(along[axis]) < 1e-14:
            continue
        source = imposed.at(far, axis)
        if source is None:
            raise CommandError(f"AFFE_CARA_ELEM/DISCRET: node {problem.concept.node_name(far)} belongs to no body, and "
                               f"nothing imposes its {('DX', 'DY', 'DZ')[axis]}: such ends of springs are not "
                               "available.")
        note_end(problem, far, axis, source)
        if isinstance(source.value, float) and source.value == 0:
            continue
        if kind.startswith("A_"):
            raise CommandError("AFFE_CARA_ELEM/DISCRET: a dashpot to a place that moves is not available.")
        for into in range(problem.dimension):
            if abs(along[into]) < 1e-14:
                continue
            value, function = problem.value(source.value, source.multiplier, amount * along[axis] * along[into])
            components: list[Any] = [0.0, 0.0, 0.0]
            components[into] = value
            problem.study.loads = [*problem.study.loads,
                                   rubato.Load(kind="nodal_force", on=problem.node_group([node]),
                                               components=tuple(components), function=function)]


def note_end(problem: Problem, node: int, axis: int, source: Imposed) -> None:
    """What is imposed on the end of a spring, as a function of time, for its displacement in results."""
    place = np.zeros(3)
    place[:problem.dimension] = np.asarray(problem.concept.mesh.points)[node][:problem.dimension]
    problem.ends.setdefault(node, {})[axis] = of_time(source, place)


def of_time(source: Imposed, place: np.ndarray) -> Callable[[float], float]:
    of_place = evaluate(source.value) if isinstance(source.value, Function) else None
    number = 0.0 if of_place else float(source.value)

    def at(t: float) -> float:
        value = of_place(*place, t) if of_place else number
        return value * (source.multiplier(t) if source.multiplier else 1.0)

    return at


def local_axes(problem: Problem, nodes: list[int]) -> np.ndarray:
    """x along the cell; y horizontal as Code_Aster takes it without ORIENTATION, a row each."""
    points = np.asarray(problem.concept.mesh.points)
    along = np.zeros(3)
    along[:points.shape[1]] = points[nodes[1]] - points[nodes[0]]
    length = np.linalg.norm(along)
    if length == 0:
        return np.eye(3)
    x = along / length
    if abs(x[0]) < 1e-12 and abs(x[1]) < 1e-12:
        y = np.array([0.0, 1.0, 0.0])
    else:
        y = np.array([-x[1], x[0], 0.0]) / np.hypot(x[0], x[1])
    return np.array([x, y, np.cross(x, y)])
