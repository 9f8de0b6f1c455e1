# SPDX-License-Identifier: LGPL-3.0-or-later
"""DEFI_CONTACT as contact zones."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

import rubato

from ..concepts import ContactConcept, Function
from ..keys import Arguments, CommandError
from .cells import dimensions
from .contact_methods import METHODS, adapts, algorithm_of, bounded, penalty_of
from .fixed_normals import check_fixed_normals
from .middle_nodes import keeps_sides_straight, middle_nodes, straight_sides
from .problem import Problem, check_parameters, evaluate

# rubato takes tolerances of loops below 1.
MOST_TOLERANCE = 0.99
NORMALS = {"MAIT": "master", "ESCL": "slave", "MAIT_ESCL": "average"}


@dataclass
class ZoneRecord:
    """A zone of the study, for what is computed of it. `index`: its place among the zones of the model;
    `slave_nodes`, `slave_cells`: of the concept's mesh; `friction`: μ; `resolved`: False where only gaps are wanted."""

    index: int
    formulation: str
    method: str
    friction: float
    slave_nodes: np.ndarray
    slave_cells: np.ndarray
    resolved: bool = True


def add_contact(problem: Problem, contact: ContactConcept | None) -> None:
    """The zones; also which nodes only rigid surfaces have, that supports may then move."""
    if contact is None:
        return
    if contact.arguments.FORMULATION == "LIAISON_UNIL":
        for zone in contact.arguments.ZONE:
            add_one_sided(problem, zone)
        return
    zones = contact.arguments.ZONE
    problem.study.contact = [make_zone(problem, contact.arguments, zone, number)
                             for number, zone in enumerate(zones, 1)]
    tie_middle_nodes(problem, contact.arguments)


def tie_middle_nodes(problem: Problem, contact: Arguments) -> None:
    middles: dict[int, tuple[int, int]] = {}
    for zone in contact.ZONE:
        if keeps_sides_straight(contact, zone):
            faces = [faces_of(problem, zone, "MAIT"), slave_of(problem, contact, zone)[0]]
            middles.update(middle_nodes(problem, np.concatenate(faces)))
    if not middles:
        return
    problem.notes.append("DEFI_CONTACT: sides of QUAD8 faces stay straight, as in DISCRETE contact of Code_Aster.")
    excluded = np.concatenate([excluded_nodes(problem, zone) for zone in contact.ZONE])
    problem.study.relations = [*problem.study.relations, *straight_sides(problem, middles, excluded)]


def note_rigid_surfaces(problem: Problem, contact: ContactConcept | None) -> None:
    """Nodes of masters that belong to no body."""
    if contact is None or contact.arguments.FORMULATION == "LIAISON_UNIL":
        return
    masters = [faces_of(problem, zone, "MAIT") for zone in contact.arguments.ZONE]
    nodes = problem.concept.nodes_of_cells(np.concatenate(masters))
    problem.rigid_nodes = nodes[~np.isin(nodes, problem.body_nodes)]


def faces_of(problem: Problem, zone: Arguments, side: str) -> np.ndarray:
    mesh = problem.concept
    cells = np.unique(mesh.cells(zone, after=f"_{side}"))
    faces = cells[dimensions(mesh.mesh)[cells] == problem.dimension - 1]
    if len(faces) == 0:
        raise CommandError(f"DEFI_CONTACT/ZONE: GROUP_MA_{side} has no faces.")
    return faces


def slave_of(problem: Problem, contact: Arguments, zone: Arguments) -> tuple[np.ndarray, np.ndarray]:
    """Returns slave faces and slave nodes. Points, and lines in space, get the skin faces around their nodes."""
    mesh = problem.concept
    cells = np.unique(mesh.cells(zone, after="_ESCL"))
    flat = dimensions(mesh.mesh)[cells]
    if len(cells) == 0 or contact.FORMULATION != "DISCRETE" or np.any(flat >= problem.dimension - 1):
        faces = faces_of(problem, zone, "ESCL")
        return faces, mesh.nodes_of_cells(faces)
    nodes = mesh.nodes_of_cells(cells)
    return faces_for(problem, nodes, "contact"), nodes


def make_zone(problem: Problem, contact: Arguments, given: Arguments, number: int) -> Any:
    formulation = contact.FORMULATION
    master = faces_of(problem, given, "MAIT")
    slave, slave_nodes = slave_of(problem, contact, given)
    algorithm = algorithm_of(problem, contact, given)
    zone = rubato.ContactZone(name=f"zone_{number}", method=METHODS[formulation, algorithm])
    zone.master, zone.slave = problem.cell_group(master), problem.cell_group(slave)
    resolved = given.RESOLUTION == "OUI" and algorithm != "VERIF"
    set_friction(problem, contact, given, zone, formulation)
    set_places(problem, given, zone, algorithm, slave)
    zone.smoothing = zone.smoothing or smooths(contact, zone)
    check_fixed_normals(problem, given, zone, master, slave)
    set_coefficients(given, zone, formulation, algorithm, between_nodes(problem, zone, slave))
    if algorithm == "PENALISATION":
        zone.normal_coefficient = bounded(problem, formulation, slave, zone.normal_coefficient)
    if formulation == "DISCRETE":
        scale_to_ring(problem, zone)
    set_levels(contact, zone, formulation)
    out = [excluded_nodes(problem, given), np.setdiff1d(problem.concept.nodes_of_cells(slave), slave_nodes)]
    if not resolved:
        out.append(slave_nodes)
    elif keeps_sides_straight(contact, given):
        out.append(np.array(list(middle_nodes(problem, slave)), dtype=np.int64))
    nodes = np.unique(np.concatenate(out))
    if len(nodes):
        zone.exclude_nodes = [problem.node_group(nodes)]
    zone.bilateral = (given if given.given("GLISSIERE") else contact).GLISSIERE == "OUI"
    zone.gap = gap_of(problem, given)
    zone.history_force = formulation != "DISCRETE"
    problem.zones.append(ZoneRecord(number - 1, formulation, algorithm, zone.friction, slave_nodes, slave, resolved))
    return zone


def set_friction(problem: Problem, contact: Arguments, given: Arguments, zone: Any, formulation: str) -> None:
    if formulation == "DISCRETE":
        zone.friction_method = "nodal_penalty"
    else:
        usual = "PENALISATION" if given.ALGO_CONT == "PENALISATION" else "STANDARD"
        by_penalty = (given.ALGO_FROT or usual) == "PENALISATION"
        if by_penalty and contact.FROTTEMENT == "COULOMB" and adapts(given) and given.COEF_PENA_FROT is None:
            by_penalty = False
            problem.notes.append(f"DEFI_CONTACT: ADAPTATION='{given.ADAPTATION}' without COEF_PENA_FROT is solved with "
                                 "friction that sticks exactly, as ALGO_FROT='STANDARD'.")
        zone.friction_method = "penalty" if by_penalty else "augmented_lagrangian"
    zone.friction = (given.COULOMB or 0.0) if contact.FROTTEMENT == "COULOMB" else 0.0
    smooth = problem.concept.nodes(given, "SANS_", "_FR")
    if len(smooth) and zone.friction:
        # Code_Aster's SANS_GROUP_NO_FR takes one direction of friction away; without any the answer is the same
        # wherever that direction is the only one.
        if given.INTEGRATION not in ("AUTO", "NOEUD"):
            problem.notes.append("DEFI_CONTACT: SANS_GROUP_NO_FR is not followed with contact points between the nodes "
                                 f"(INTEGRATION='{given.INTEGRATION}').")
        at = {tuple(point) for point in np.asarray(problem.concept.mesh.points)[smooth]}
        coefficient = zone.friction
        zone.friction = 1.0
        zone.friction_in_place = rubato.GivenField(
            "COULOMB", lambda x, y, z, t: 0.0 if (x, y, z) in at else coefficient, False)


def between_nodes(problem: Problem, zone: Any, slave: np.ndarray) -> bool:
    """Whether gaps close on average over faces only: there augmentations are part of the answer."""
    serendipity = any(block.type in ("tria6", "quad8")
                    and np.any((slave >= block.first) & (slave < block.first + len(block.nodes)))
                    for block in problem.concept.mesh.blocks)
    return zone.integration.by != rubato.ContactIntegration.mortar and (
        serendipity or zone.integration.by != rubato.ContactIntegration.nodes)


def set_coefficients(given: Arguments, zone: Any, formulation: str, algorithm: str, averaged: bool) -> None:
    """Stiffnesses of penalties, which the answer depends on; augmentations only where they count."""
    if formulation == "CONTINUE" and algorithm == "STANDARD" and averaged:
        zone.normal_coefficient = given.COEF_CONT
        if zone.friction:
            zone.tangential_coefficient = given.COEF_FROT
    if formulation == "DISCRETE":
        if algorithm == "PENALISATION":
            zone.normal_coefficient = required(given, "E_N", penalty_of(given, "E_N"))
        if zone.friction:
            zone.tangential_coefficient = required(given, "E_T")
        return
    if algorithm == "PENALISATION":
        zone.normal_coefficient = required(given, "COEF_PENA_CONT", penalty_of(given, "COEF_PENA_CONT"))
    if zone.friction and str(zone.friction_method).endswith("penalty"):
        zone.tangential_coefficient = required(given, "COEF_PENA_FROT")


def scale_to_ring(problem: Problem, zone: Any) -> None:
    """Multiplies penalties of nodes, which command files have per radian, to those of the whole ring."""
    for name in ("normal_coefficient", "tangential_coefficient"):
        value = getattr(zone, name)
        if value is not None:
            setattr(zone, name, value * problem.ring)


def required(given: Arguments, name: str, value: float | None = None) -> float:
    value = given.get(name) if value is None else value
    if value is None:
        raise CommandError(f"DEFI_CONTACT/ZONE: keyword {name} is missing.")
    return value


def set_places(problem: Problem, given: Arguments, zone: Any, algorithm: str, slave: np.ndarray) -> None:
    """Where contact points stand, and whose normals count."""
    kind, order = "nodes", 0
    if algorithm == "LAC" or given.APPARIEMENT == "MORTAR":
        kind = "mortar"
    elif given.INTEGRATION == "GAUSS":
        kind, order = "gauss", given.ORDRE_INT or 3
    elif given.INTEGRATION == "SIMPSON":
        kind, order = "simpson", given.ORDRE_INT or 1
    elif given.INTEGRATION == "NCOTES":
        # Closed rules both: ends and points between them. Orders of Newton and Cotes count points less one.
        kind, order = "simpson", max(1, (given.ORDRE_INT or 3) // 2)
    if kind == "simpson" and has_triangles(problem, slave):
        kind, order = "gauss", 3
        problem.notes.append("DEFI_CONTACT: SIMPSON and NCOTES are solved by GAUSS of order 3 on triangular faces.")
    zone.integration = rubato.ContactRule(by=kind, order=order)
    if kind != "mortar":
        zone.normal = NORMALS[given.NORMALE]
        zone.clamped_normal = "code_aster"
        zone.projection_tolerance = given.TOLE_PROJ_EXT
    if given.APPARIEMENT == "NODAL" and zone.method.startswith("nodal"):
        zone.nodal_pairs = True
        zone.smoothing = True  # Code_Aster takes the mean normal at the master's node
        zone.projection_tolerance = 1.0  # Code_Aster pairs every slave node


def smooths(contact: Arguments, zone: Any) -> bool:
    """Whether normals are averaged at nodes; mortar's always are."""
    return contact.LISSAGE == "OUI" and zone.integration.by != rubato.ContactIntegration.mortar


def has_triangles(problem: Problem, faces: np.ndarray) -> bool:
    blocks = [block for block in problem.concept.mesh.blocks if block.type.startswith("tria")]
    return any(np.any((faces >= block.first) & (faces < block.first + len(block.nodes))) for block in blocks)


def set_levels(contact: Arguments, zone: Any, formulation: str) -> None:
    """Levels of geometry, friction and status: by Newton's method, or in loops."""
    zone.freeze = contact.REAC_GEOM == "SANS"
    # Nodal methods always have the level of geometry; with frozen surfaces it is done at once.
    loops = formulation == "DISCRETE" or (contact.ALGO_RESO_GEOM == "POINT_FIXE" and not zone.freeze)
    if loops:
        tolerance = min(contact.RESI_GEOM, MOST_TOLERANCE) if contact.RESI_GEOM is not None else 0.01
        zone.geometry = rubato.Level(by="fixed_point", tolerance=tolerance, max_loops=contact.ITER_GEOM_MAXI)
    if formulation == "DISCRETE":
        return
    if contact.ALGO_RESO_FROT == "POINT_FIXE" and zone.friction:
        zone.threshold = rubato.Level(by="fixed_point", tolerance=min(contact.RESI_FROT, MOST_TOLERANCE),
                                      max_loops=contact.ITER_FROT_MAXI)
    if contact.ALGO_RESO_CONT == "POINT_FIXE":
        zone.status = rubato.Level(by="fixed_point", tolerance=0.0, max_loops=contact.ITER_CONT_MAXI)


def excluded_nodes(problem: Problem, given: Arguments) -> np.ndarray:
    """Of SANS_GROUP_NO and the like."""
    return np.unique(problem.concept.nodes(given, "SANS_"))


def gap_of(problem: Problem, given: Arguments) -> Any:
    """DIST_MAIT and DIST_ESCL are material that the mesh does not have: the gap is smaller by them."""
    functions: list[Function] = [value for value in (given.DIST_MAIT, given.DIST_ESCL) if value is not None]
    if not functions:
        return 0.0
    for function in functions:
        check_parameters(function)
    evaluated = [evaluate(function) for function in functions]
    varies = any("INST" in function.parameters for function in functions)
    closer = rubato.GivenField("DIST", lambda x, y, z, t: -sum(one(x, y, z, t) for one in evaluated), varies)
    return rubato.Field(closer)


def add_one_sided(problem: Problem, given: Arguments) -> None:
    """LIAISON_UNIL: Σ COEF_MULT · u ≤ COEF_IMPO at each node. That is the distance (c − a·u)/|a| from a plane of normal
    −a/|a|, whose gap is counted from the displacement alone."""
    mesh = problem.concept
    nodes = mesh.nodes(given)
    faces = faces_for(problem, nodes, "LIAISON_UNIL")
    if len(given.NOM_CMP) != len(given.COEF_MULT):
        raise CommandError("DEFI_CONTACT/ZONE: expected a COEF_MULT for each NOM_CMP.")
    factors = np.zeros(3)
    for name, function in zip(given.NOM_CMP, given.COEF_MULT):
        factors[("DX", "DY", "DZ").index(name)] += constant(function)
    size = float(np.linalg.norm(factors))
    if size == 0 or given.COEF_IMPO is None:
        raise CommandError("DEFI_CONTACT/ZONE: COEF_MULT is zero, or COEF_IMPO is missing.")
    normal = -factors / size
    check_parameters(given.COEF_IMPO)
    bound = evaluate(given.COEF_IMPO)
    zone = rubato.ContactZone(name=f"zone_{len(problem.zones) + 1}", method="nodal_lagrange")
    zone.friction_method = "nodal_penalty"
    algorithm = given.ALGO_CONT or "CONTRAINTE"
    if algorithm == "PENALISATION":
        # The energy ½ COEF_PENA (a·u − c)² gives the stiffness by the distance (a·u − c)/|a|.
        zone.method = "nodal_penalty"
        zone.normal_coefficient = required(given, "COEF_PENA") * size**2 * problem.ring
    elif algorithm != "CONTRAINTE":
        raise CommandError(f"DEFI_CONTACT/ZONE/ALGO_CONT: {algorithm} is not available with LIAISON_UNIL.")
    zone.slave = problem.cell_group(faces)
    others = np.setdiff1d(mesh.nodes_of_cells(faces), nodes)
    if len(others):
        zone.exclude_nodes = [problem.node_group(others)]
    zone.obstacle = rubato.Obstacle(kind="plane", point=(0.0, 0.0, 0.0), direction=tuple(normal))
    zone.integration = rubato.ContactRule(by="nodes")
    zone.geometry = rubato.Level(by="fixed_point", tolerance=0.01, max_loops=10)
    zone.gap = rubato.Field(rubato.GivenField(
        "LIAISON_UNIL", lambda x, y, z, t: bound(x, y, z, t) / size - float(normal @ (x, y, z)),
        "INST" in given.COEF_IMPO.parameters))
    slave = mesh.nodes_of_cells(faces)
    problem.zones.append(ZoneRecord(len(problem.zones), "LIAISON_UNIL", algorithm, 0.0, slave, faces))
    problem.study.contact = [*problem.study.contact, zone]


def faces_for(problem: Problem, nodes: np.ndarray, what: str) -> np.ndarray:
    """Skin cells that have the nodes: those with these nodes only; for nodes that none of them has, all of theirs."""
    whole, touching = [], []
    for block in problem.concept.mesh.blocks:
        first = np.arange(block.first, block.first + len(block.nodes))
        among = np.isin(np.asarray(block.nodes), nodes)
        whole.append(first[np.all(among, axis=1)])
        touching.append(first[np.any(among, axis=1)])
    flat = dimensions(problem.concept.mesh) == problem.dimension - 1
    faces, others = (cells[flat[cells]] for cells in (np.concatenate(whole), np.concatenate(touching)))
    missing = np.setdiff1d(nodes, problem.concept.nodes_of_cells(faces))
    more = [cell for cell in others if np.any(np.isin(problem.concept.nodes_of_cell(cell), missing))]
    faces = np.union1d(faces, np.array(more, dtype=np.int64))
    bare = np.setdiff1d(nodes, problem.concept.nodes_of_cells(faces))
    if len(bare):
        name = problem.concept.node_name(int(bare[0]))
        raise CommandError(f"DEFI_CONTACT/ZONE: {what} at node {name}, which no skin cell has, is not available.")
    return faces


def constant(function: Function) -> float:
    """The value of a function that does not depend on anything."""
    try:
        return float(function(*(0.0 for _ in function.parameters)))
    except CommandError:
        raise
    except Exception as error:
        raise CommandError(f"DEFI_CONTACT/ZONE/COEF_MULT: expected a constant: {error}") from error
