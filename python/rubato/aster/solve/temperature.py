# SPDX-License-Identifier: LGPL-3.0-or-later
"""AFFE_VARC with NOM_VARC='TEMP': temperatures, and the one at which nothing is expanded."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

import rubato

from ..concepts import MaterialField, NodalField, Result
from ..keys import Arguments, CommandError
from .problem import Problem


def add_temperatures(problem: Problem, materials: MaterialField) -> None:
    made = []
    for item in materials.variables:
        cells = problem.concept.cells(item) if (item.GROUP_MA or item.MAILLE or item.TOUT) else problem.solid
        cells = np.intersect1d(cells, problem.solid)
        for nodes in layers(problem, problem.concept.nodes_of_cells(cells)):
            made.append(rubato.Temperature(on=problem.node_group(nodes), value=field_of(problem, item, nodes)))
        set_reference(problem, item, cells)
    problem.study.temperatures = made


def layers(problem: Problem, nodes: np.ndarray) -> list[np.ndarray]:
    """The nodes, so that no two of a layer stand at one place, as those of bodies that touch do."""
    places = np.asarray(problem.concept.mesh.points)[nodes]
    _, of_node = np.unique(places, axis=0, return_inverse=True)
    seen: dict[int, int] = {}
    level = np.zeros(len(nodes), dtype=np.int64)
    for i, place in enumerate(of_node.ravel()):
        level[i] = seen[place] = seen.get(place, -1) + 1
    return [nodes[level == number] for number in range(int(level.max(initial=-1)) + 1)]


def set_reference(problem: Problem, item: Arguments, cells: np.ndarray) -> None:
    """VALE_REF is of the cells: materials that have some of them, which then must be theirs alone."""
    if item.VALE_REF is None:
        return
    for material in problem.study.materials:
        if material.expansion is None:
            continue
        of_material = {int(cell) for name in material.cells for cell in problem.cells_named(name)}
        shared = of_material & {int(cell) for cell in problem.in_mesh(cells)}
        if shared and shared != of_material:
            raise CommandError("AFFE_VARC/VALE_REF: a material whose cells have two of them is not available.")
        if shared:
            material.expansion = rubato.ThermalExpansion(along=material.expansion.along, reference=item.VALE_REF)


def field_of(problem: Problem, item: Arguments, nodes: np.ndarray) -> Any:
    if item.CHAM_GD is not None:
        return rubato.Field(given(problem, item.CHAM_GD, nodes))
    if item.EVOL is None:
        raise CommandError("AFFE_VARC: keyword CHAM_GD or EVOL is missing.")
    return rubato.Field(of_result(problem, item, nodes))


def given(problem: Problem, field: NodalField, nodes: np.ndarray) -> Any:
    at_place = by_place(problem, field.column("TEMP"), nodes)
    return rubato.GivenField(field.name or "TEMP", lambda x, y, z, t: at_place(x, y, z), False)


def of_result(problem: Problem, item: Arguments, nodes: np.ndarray) -> Any:
    """Linear between the instants of the result."""
    from ..fields import field_of as field_of_result

    result: Result = item.EVOL
    fields = [by_place(problem, field_of_result(result, stored, "TEMP").column("TEMP"), nodes)
              for stored in result.stored]
    instants = np.array(result.instants())

    def at(x: float, y: float, z: float, t: float) -> float:
        clock = clock_of(item, problem.clock(t))
        check_instant(item, instants, clock)
        return float(np.interp(clock, instants, [field(x, y, z) for field in fields]))

    return rubato.GivenField(result.name or "TEMP", at, len(instants) > 1)


def clock_of(item: Arguments, t: float) -> float:
    """FONC_INST: the instant of the result at an instant of the study."""
    return item.FONC_INST(t) if callable(item.FONC_INST) else t


def check_instant(item: Arguments, instants: np.ndarray, t: float) -> None:
    slack = 1e-9 * max(1.0, abs(instants[-1]))
    if len(instants) > 1 and t < instants[0] - slack and item.PROL_GAUCHE == "EXCLU":
        raise CommandError(f"AFFE_VARC/EVOL: instant {t:g} is before the first one, {instants[0]:g}.")
    if len(instants) > 1 and t > instants[-1] + slack and item.PROL_DROITE == "EXCLU":
        raise CommandError(f"AFFE_VARC/EVOL: instant {t:g} is after the last one, {instants[-1]:g}.")


def by_place(problem: Problem, values: np.ndarray, nodes: np.ndarray) -> Callable[[float, float, float], float]:
    """The value of the node at a place; no two of the nodes stand at one."""
    points = np.asarray(problem.concept.mesh.points)
    missing = nodes[np.isnan(values[nodes])]
    if len(missing):
        raise CommandError(f"AFFE_VARC: node {problem.concept.node_name(int(missing[0]))} has no temperature.")
    at = {tuple(points[node]): float(values[node]) for node in nodes}
    return lambda x, y, z: at[x, y, z]
