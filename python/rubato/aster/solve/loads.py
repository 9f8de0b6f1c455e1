# SPDX-License-Identifier: LGPL-3.0-or-later
"""Forces: FORCE_NODALE, FORCE_ARETE, FORCE_CONTOUR, FORCE_FACE, FORCE_INTERNE, PRES_REP, PESANTEUR."""

from __future__ import annotations

from typing import Any

import numpy as np

import rubato

from ..concepts import Function, LoadConcept, MaterialField
from ..keys import Arguments, CommandError
from .cells import dimensions, materials_of_cells
from .problem import Problem

FORCES = ("FX", "FY", "FZ")


def add_loads(problem: Problem, loads: list[tuple[LoadConcept, Function | None]], materials: MaterialField) -> None:
    made: list[Any] = []
    for load, multiplier in loads:
        refuse_other_followers(problem, load)
        made += nodal_forces(problem, load, multiplier)
        made += distributed_forces(problem, load, multiplier)
        made += pressures(problem, load, multiplier)
        made += body_forces(problem, load, multiplier, materials)
        made += gravities(problem, load, multiplier)
    problem.study.loads = [*problem.study.loads, *made]


def refuse_other_followers(problem: Problem, load: LoadConcept) -> None:
    for keyword in ("FORCE_NODALE", "FORCE_ARETE", "FORCE_CONTOUR", "FORCE_FACE", "FORCE_INTERNE"):
        if id(load) in problem.following and load.arguments.get(keyword):
            raise CommandError(f"{problem.command}/EXCIT/TYPE_CHARGE: SUIV is available for PRES_REP, found {keyword} in "
                               f"{load.name}.")


def make_load(problem: Problem, kind: str, on: str, values: dict[int, Any], multiplier: Function | None,
              factor: float = 1.0) -> list[Any]:
    """A load for each function of time among its components: a study's load has one for all of them."""
    by_function: dict[str, list[Any]] = {}
    for axis, value in values.items():
        amount, name = problem.value(value, multiplier, factor)
        by_function.setdefault(name, [0.0, 0.0, 0.0])[axis] = amount
    return [rubato.Load(kind=kind, on=on, components=tuple(components), function=name)
            for name, components in by_function.items()]


def nodal_forces(problem: Problem, load: LoadConcept, multiplier: Function | None) -> list[Any]:
    """Later entries of a load count."""
    source: dict[tuple[int, int], Any] = {}
    items = load.arguments.get("FORCE_NODALE") or []
    for place, item in enumerate(items):
        nodes = problem.concept.nodes(item)
        if len(nodes) and len(problem.moving(nodes)) == 0:
            name = problem.concept.node_name(int(nodes[0]))
            raise CommandError(f"{load.command}/FORCE_NODALE: node {name} belongs to no body.")
        for axis, name in enumerate(FORCES[:problem.dimension]):
            if item.get(name) is not None:
                source.update({(int(node), axis): place for node in problem.moving(nodes)})
    made = []
    for place, item in enumerate(items):
        for nodes, axes in same_components({key for key, of in source.items() if of == place}):
            values = {axis: item.get(FORCES[axis]) for axis in axes}
            made += make_load(problem, "nodal_force", problem.node_group(nodes), values, multiplier, problem.ring)
    return made


def same_components(keys: set[tuple[int, int]]) -> list[tuple[list[int], tuple[int, ...]]]:
    """Of pairs of an item and an axis: the items that have the same axes, with these."""
    axes_of: dict[int, list[int]] = {}
    for item, axis in sorted(keys):
        axes_of.setdefault(item, []).append(axis)
    groups: dict[tuple[int, ...], list[int]] = {}
    for item, axes in axes_of.items():
        groups.setdefault(tuple(axes), []).append(item)
    return [(items, axes) for axes, items in groups.items()]


def distributed_forces(problem: Problem, load: LoadConcept, multiplier: Function | None) -> list[Any]:
    kinds = {"FORCE_ARETE": ("line_force", 1), "FORCE_CONTOUR": ("surface_force", 1),
             "FORCE_FACE": ("surface_force", 2)}
    made = []
    for keyword, (kind, dimension) in kinds.items():
        items = load.arguments.get(keyword) or []
        if items and (problem.dimension == 3) == (keyword == "FORCE_CONTOUR"):
            raise CommandError(f"{load.command}/{keyword}: not for models of {problem.dimension} dimensions.")
        for cells, values in entries_of_cells(problem, load.command, keyword, items, dimension):
            made += make_load(problem, kind, problem.cell_group(cells), values, multiplier)
    return made


def entries_of_cells(problem: Problem, command: str, keyword: str, items: list[Arguments],
                     dimension: int) -> list[tuple[list[int], dict[int, Any]]]:
    """Cells and their components of each entry; component by component the last entry counts."""
    of_dimension = dimensions(problem.concept.mesh) == dimension
    source: dict[tuple[int, int], int] = {}
    for place, item in enumerate(items):
        cells = without(problem, item)
        cells = cells[of_dimension[cells]]
        if len(cells) == 0:
            raise CommandError(f"{command}/{keyword}: there are no cells of {dimension} dimensions in "
                               f"{', '.join(item.get('GROUP_MA') or item.get('MAILLE') or ('the mesh',))}.")
        for axis, name in enumerate(FORCES[:problem.dimension]):
            if item.get(name) is not None:
                source.update({(int(cell), axis): place for cell in cells})
    made = []
    for place, item in enumerate(items):
        for cells, axes in same_components({key for key, of in source.items() if of == place}):
            made.append((cells, {axis: item.get(FORCES[axis]) for axis in axes}))
    return made


def without(problem: Problem, item: Arguments) -> np.ndarray:
    """The cells of an entry without those of SANS_*."""
    cells = problem.concept.cells(item)
    return cells[~np.isin(cells, problem.concept.cells(item, "SANS_"))]


def pressures(problem: Problem, load: LoadConcept, multiplier: Function | None) -> list[Any]:
    items = load.arguments.get("PRES_REP") or []
    of_dimension = dimensions(problem.concept.mesh) == problem.dimension - 1
    last: dict[int, int] = {}
    for place, item in enumerate(items):
        if item.CISA_2D is not None and item.CISA_2D != 0:
            raise CommandError(f"{load.command}/PRES_REP: CISA_2D is not available; FORCE_CONTOUR is.")
        cells = without(problem, item)
        cells = cells[of_dimension[cells]]
        if item.PRES is not None and len(cells) == 0:
            raise CommandError(f"{load.command}/PRES_REP: there are no faces in "
                               f"{', '.join(item.get('GROUP_MA') or item.get('MAILLE') or ('the mesh',))}.")
        if item.PRES is not None:
            last.update({int(cell): place for cell in cells})
    made = []
    for place, item in enumerate(items):
        cells = [cell for cell, of in last.items() if of == place]
        if cells and not (isinstance(item.PRES, float) and item.PRES == 0):
            made += make_load(problem, "pressure", problem.cell_group(cells), {0: item.PRES}, multiplier)
    for pressure in made:
        pressure.follower = id(load) in problem.following
    return made


def body_forces(problem: Problem, load: LoadConcept, multiplier: Function | None,
                materials: MaterialField) -> list[Any]:
    """FORCE_INTERNE [force/volume] as an acceleration of the mass: the force over the density of each material."""
    items = load.arguments.get("FORCE_INTERNE") or []
    if not items:
        return []
    of_cell, listed = materials_of_cells(materials, problem.concept.mesh.cell_count)
    solid = np.isin(np.arange(problem.concept.mesh.cell_count), problem.solid)
    made = []
    for cells, values in entries_of_cells(problem, load.command, "FORCE_INTERNE", items, problem.dimension):
        inside = np.array(cells)[solid[cells]]
        for place in np.unique(of_cell[inside]):
            density = density_of(listed[place])
            part = problem.cell_group(inside[of_cell[inside] == place])
            made += make_load(problem, "gravity", part, values, multiplier, 1 / density)
    return made


def density_of(material: Any) -> float:
    """Static studies need no density: add_materials and this agree on 1 then."""
    numbers = next(iter(material.laws.values()))
    return numbers.RHO if numbers.RHO else 1.0


def give_missing_densities(problem: Problem) -> None:
    """Body forces act on the mass: in a static study a body without density gets one, which cancels out."""
    if any(load.kind == rubato.LoadKind.gravity for load in problem.study.loads):
        for material in problem.study.materials:
            if not material.density:
                material.density = 1.0


def gravities(problem: Problem, load: LoadConcept, multiplier: Function | None) -> list[Any]:
    made = []
    for item in load.arguments.get("PESANTEUR") or []:
        direction = np.array((*item.DIRECTION, 0.0, 0.0)[:3])
        if not np.linalg.norm(direction) > 0:
            raise CommandError(f"{load.command}/PESANTEUR/DIRECTION: expected a vector of length > 0.")
        if any(not material.density for material in problem.study.materials):
            raise CommandError(f"{load.command}/PESANTEUR: a material has no RHO.")
        acceleration = item.GRAVITE * direction / np.linalg.norm(direction)
        whole = not item.GROUP_MA and not item.MAILLE
        solid = problem.solid if whole else np.intersect1d(problem.concept.cells(item), problem.solid)
        on = "" if whole else problem.cell_group(solid)
        values = {axis: float(acceleration[axis]) for axis in range(problem.dimension)}
        made += make_load(problem, "gravity", on, values, multiplier)
    return made
