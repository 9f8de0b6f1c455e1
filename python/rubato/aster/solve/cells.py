# SPDX-License-Identifier: LGPL-3.0-or-later
"""Which cells deform, and what they are made of."""

from __future__ import annotations

from typing import Any

import numpy as np

import rubato

from ..commands.model import PHYSICS
from ..concepts import DiscreteField, MaterialConcept, MaterialField, MeshConcept
from ..keys import Arguments, CommandError
from .behaviours import Behaviour, give_behaviour, split_by_behaviour
from .problem import Problem

RUBBER = ("hyperelastic", "yeoh", "ogden")
DIMENSION = {"point1": 0, "seg2": 1, "seg3": 1, "tria3": 2, "tria6": 2, "tria7": 2, "quad4": 2, "quad8": 2, "quad9": 2}


def dimensions(mesh: rubato.Mesh) -> np.ndarray:
    """The dimension of each cell: 0 points, 1 lines, 2 faces, 3 solids."""
    parts = [np.full(len(block.nodes), DIMENSION.get(block.type, 3)) for block in mesh.blocks]
    return np.concatenate(parts) if parts else np.zeros(0, dtype=np.int64)


def kinds_of_cells(problem: Problem) -> np.ndarray:
    """The MODELISATION of each cell, by its place in the model's parts; -1: none. Later parts count."""
    kinds = np.full(problem.concept.mesh.cell_count, -1)
    for place, part in enumerate(problem.model.parts):
        kinds[part.cells] = place
    return kinds


def choose_cells(problem: Problem) -> None:
    """Finds the physics and the cells that deform; those of that dimension that are not in the model are left out."""
    solids = {part.kind for part in problem.model.parts if part.kind in PHYSICS}
    if not solids:
        raise CommandError(f"{problem.command}/MODELE: model {problem.model.name} has no solids.")
    problem.physics = PHYSICS[solids.pop()]
    problem.study.physics = problem.physics
    kinds = kinds_of_cells(problem)
    is_solid = np.array([part.kind in PHYSICS for part in problem.model.parts] + [False])
    dimension = dimensions(problem.concept.mesh)
    body = dimension == problem.dimension
    problem.solid = np.flatnonzero(body & is_solid[kinds])
    if len(problem.solid) == 0:
        raise CommandError(f"{problem.command}/MODELE: model {problem.model.name} has no cells of "
                           f"{problem.dimension} dimensions.")
    problem.keep_cells(np.flatnonzero(~body | (body & is_solid[kinds])))
    problem.body_nodes = problem.concept.nodes_of_cells(problem.solid)
    if problem.concept.mesh.dimension != problem.dimension:
        raise CommandError(f"{problem.command}/MODELE: the mesh has {problem.concept.mesh.dimension} coordinates, the "
                           f"model asks for {problem.dimension}.")


# Formulations of cells with _SI, by type; cells of other types are integrated in full, with _SI or without.
REDUCED = {"quad8": "reduced", "hexa20": "reduced", "quad4": "enhanced", "hexa8": "enhanced"}


def formulations_of_cells(problem: Problem) -> np.ndarray:
    """The formulation that MODELISATION asks for, of each cell of the mesh; "" where it is the usual one."""
    mesh = problem.concept.mesh
    types = np.concatenate([np.full(len(block.nodes), REDUCED.get(block.type, "")) for block in mesh.blocks])
    is_reduced = np.array([part.kind.endswith("_SI") for part in problem.model.parts] + [False])
    return np.where(is_reduced[kinds_of_cells(problem)], types, "")


def note_reduced(problem: Problem, formulations: np.ndarray) -> None:
    if "enhanced" in formulations:
        problem.notes.append(f"{problem.command}/MODELE: linear cells with _SI have one point and assumed strains in "
                             "Code_Aster, 'formulation: enhanced' here; they agree on fine meshes.")


def materials_of_cells(materials: MaterialField, cell_count: int) -> tuple[np.ndarray, list[MaterialConcept]]:
    """The material of each cell, by its place in the list; -1: none. Later ones count."""
    of_cell = np.full(cell_count, -1)
    listed = []
    for place, (cells, material) in enumerate(materials.parts):
        of_cell[cells] = place
        listed.append(material)
    return of_cell, listed


def add_materials(problem: Problem, materials: MaterialField, discrete: DiscreteField | None, dynamic: bool,
                  behaviours: list[Behaviour] | None = None) -> None:
    """`behaviours`: of each cell of the command file's mesh; linear ones when not given."""
    problem.has_temperatures = bool(materials.variables)
    of_behaviour = behaviours or [Behaviour()] * problem.concept.mesh.cell_count
    of_cell, listed = materials_of_cells(materials, problem.concept.mesh.cell_count)
    of_solid = of_cell[problem.solid]
    if np.any(of_solid < 0):
        cell = problem.solid[np.flatnonzero(of_solid < 0)[0]]
        raise CommandError(f"{problem.command}/CHAM_MATER: cell {problem.concept.cell_name(int(cell))} has no "
                           "material.")
    formulations = formulations_of_cells(problem)
    note_reduced(problem, formulations[problem.solid])
    made = []
    for place in np.unique(of_solid):
        cells = problem.solid[of_solid == place]
        for axes, turned in split_by_axes(problem.concept, discrete, cells):
            for behaviour, alike in split_by_behaviour(of_behaviour, turned):
                for formulation in np.unique(formulations[alike]):
                    material = make_material(problem, listed[place], dynamic, axes)
                    give_behaviour(problem, material, listed[place], behaviour)
                    give_formulation(material, str(formulation))
                    material.name = f"{material.name}_{len(made) + 1}"
                    material.everywhere = False
                    material.cells = [problem.cell_group(alike[formulations[alike] == formulation])]
                    made.append(material)
    problem.study.materials = made


def give_formulation(material: Any, formulation: str) -> None:
    """Enhanced cells have no logarithmic strain and no rubber; mean dilatation is near to them there."""
    if formulation == "enhanced" and (material.strain == "logarithmic" or material.law in RUBBER):
        formulation = "mean_dilatation"
    if formulation:
        material.formulation = formulation


def make_material(problem: Problem, concept: MaterialConcept, dynamic: bool, axes: Arguments | None) -> Any:
    material = rubato.Material()
    material.name = "".join(c for c in concept.name if c.isalnum() or c == "_") or "material"
    if "ELAS" in concept.laws:
        numbers = concept.laws["ELAS"]
        material.young = numbers.E
        material.poisson = numbers.NU
        expansion = [numbers.ALPHA] * 3
    elif "ELAS_ORTH" in concept.laws:
        numbers = concept.laws["ELAS_ORTH"]
        material.law = "orthotropic"
        material.orthotropy = orthotropy(problem, numbers, axes)
        expansion = [numbers.ALPHA_L, numbers.ALPHA_T, numbers.ALPHA_N]
    elif "ELAS_HYPER" in concept.laws:
        numbers = concept.laws["ELAS_HYPER"]
        expansion = [0.0]
    else:
        raise CommandError(f"{problem.command}/CHAM_MATER: material {concept.name} has no ELAS.")
    if numbers.RHO is not None:
        material.density = numbers.RHO
    elif dynamic:
        raise CommandError(f"{problem.command}/CHAM_MATER: material {concept.name} has no RHO.")
    # Code_Aster's names: AMOR_ALPHA multiplies the stiffness, AMOR_BETA the mass.
    material.rayleigh_stiffness = numbers.get("AMOR_ALPHA") or 0.0
    material.rayleigh_mass = numbers.get("AMOR_BETA") or 0.0
    if any(expansion):
        material.expansion = rubato.ThermalExpansion(along=tuple(value or 0.0 for value in expansion))
    return material


def orthotropy(problem: Problem, numbers: Arguments, axes: Arguments | None) -> Any:
    made = rubato.Orthotropy()
    made.young_x, made.young_y, made.poisson_xy, made.shear_xy = (numbers.E_L, numbers.E_T, numbers.NU_LT,
                                                                  numbers.G_LT)
    if problem.physics != "plane_stress":
        made.young_z, made.poisson_yz, made.poisson_xz = numbers.E_N, numbers.NU_TN, numbers.NU_LN
    if problem.physics == "solid":
        made.shear_yz, made.shear_xz = numbers.G_TN, numbers.G_LN
    if axes is not None:
        angles = (*axes.ANGL_REP, 0.0, 0.0)[:3]
        made.angle_z, made.angle_y, made.angle_x = angles
    return made


def split_by_axes(mesh: MeshConcept, discrete: DiscreteField | None,
                  cells: np.ndarray) -> list[tuple[Arguments | None, np.ndarray]]:
    """Cells with their axes of orthotropy (MASSIF); the last one given counts."""
    of_cell = np.full(mesh.mesh.cell_count, -1)
    given = discrete.axes if discrete else []
    for place, axes in enumerate(given):
        if axes.ANGL_AXE or axes.ORIG_AXE:
            raise CommandError("AFFE_CARA_ELEM/MASSIF: ANGL_AXE is not available; ANGL_REP is.")
        of_cell[mesh.cells(axes)] = place
    parts = []
    for place in np.unique(of_cell[cells]):
        parts.append((given[place] if place >= 0 else None, cells[of_cell[cells] == place]))
    return parts
