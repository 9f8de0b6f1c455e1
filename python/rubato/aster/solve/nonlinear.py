# SPDX-License-Identifier: LGPL-3.0-or-later
"""STAT_NON_LINE and DYNA_NON_LINE."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np

import rubato

from ..concepts import CellField, ContactConcept, Function, LoadConcept, NodalField, Result, Stored
from ..keys import Arguments, CommandError
from ..python_modules import NotConverged
from .behaviours import behaviours_of_cells
from .cells import add_materials, choose_cells
from .contact import add_contact, note_rigid_surfaces
from .discrete import add_discrete
from .loads import add_loads, give_missing_densities
from .middle_nodes import SIDE
from .observation import Observations, energies
from .problem import Problem
from .relations import add_relations
from .solved import Solved
from .supports import add_supports
from .temperature import add_temperatures
from .times import Archive, instants_of

# Steps are solved at least that well: an iteration costs little, and the tolerance of Code_Aster's residual is in its
# answers.
RESIDUAL = 1e-8
# Steps of a list that differ by that share are one length.
SAME_LENGTH = 1e-9


def stat_non_line(session: Any, arguments: Arguments) -> Result:
    return solve(session, "STAT_NON_LINE", arguments, False)


def dyna_non_line(session: Any, arguments: Arguments) -> Result:
    return solve(session, "DYNA_NON_LINE", arguments, True)


def solve(session: Any, command: str, arguments: Arguments, dynamic: bool) -> Result:
    result = arguments.reuse or Result("EVOL_NOLI", arguments.MODELE.mesh, arguments.MODELE)
    start = initial_state(arguments, result)
    (increment,) = arguments.INCREMENT
    instants, cuts = instants_of(command, increment, start.instant)
    problem = make_problem(session, command, arguments, instants, dynamic, start.given)
    set_time(problem, arguments, instants, cuts, dynamic, start)
    before, observed, parameters = list(result.stored), list(result.observations), list(result.parameters)
    residuals = wanted_residuals(problem, arguments)
    for residual in residuals:
        result.stored[:], result.observations[:], result.parameters[:] = before, observed, parameters
        problem.study.newton.residual = residual
        solved, simulation = begin(session, problem, arguments, start, dynamic)
        if cuts.levels > 0:
            solved.within = within_steps(session, problem, arguments, solved, cuts)
        try:
            march(session, command, arguments, result, solved, simulation, start)
            break
        except NotConverged:
            if residual == residuals[-1]:
                raise
            session.note(f"{command}: {session.assigned}: a residual of {residual:g} is not reached; solved again for "
                         f"{residuals[-1]:g}, as the file asks.")
    return result


# ---- the initial state -----------------------------------------------------------------------------------------


class Start:
    """ETAT_INIT. `stored`: a stored state of a result; `fields`: displacement, velocity and acceleration at nodes;
    `stress`: SIGM; `instant`: of that state, None where the list of instants begins."""

    def __init__(self) -> None:
        self.stored: Stored | None = None
        self.fields: dict[str, NodalField] = {}
        self.stress: CellField | None = None
        self.instant: float | None = None

    @property
    def given(self) -> bool:
        return self.stored is not None or bool(self.fields)


def initial_state(arguments: Arguments, result: Result) -> Start:
    start = Start()
    for item in arguments.ETAT_INIT:
        start.stress = item.SIGM
        if item.EVOL_NOLI is not None:
            start.stored = chosen(item)
            start.instant = item.INST_ETAT_INIT if item.INST_ETAT_INIT is not None else start.stored.instant
        for name in ("DEPL", "VITE", "ACCE"):
            if item.get(name) is not None:
                start.fields[name] = item.get(name)
    if arguments.reuse is not None and start.stored is None and result.stored:
        raise CommandError("reuse: keyword ETAT_INIT/EVOL_NOLI is missing.")
    return start


def chosen(item: Arguments) -> Stored:
    result = item.EVOL_NOLI
    if not result.stored:
        raise CommandError(f"ETAT_INIT/EVOL_NOLI: result {result.name} has no state.")
    if item.NUME_ORDRE is not None:
        return result.of_order(item.NUME_ORDRE)
    if item.INST is not None:
        return result.at(item.INST, item.PRECISION, item.CRITERE)
    return result.stored[-1]


# ---- the study -------------------------------------------------------------------------------------------------


def make_problem(session: Any, command: str, arguments: Arguments, instants: np.ndarray, dynamic: bool,
                 continues: bool, earliest: float | None = None) -> Problem:
    problem = Problem(command, arguments.MODELE, float(instants[0]), float(instants[-1]))
    problem.continues = continues
    problem.bounds_penetration = any(getattr(item.LIST_INST, "bounds_penetration", False)
                                     for item in arguments.get("INCREMENT") or [])
    if earliest is not None:
        problem.earliest = earliest
    choose_cells(problem)
    note_rigid_surfaces(problem, arguments.get("CONTACT"))
    loads = excitations(arguments)
    problem.following = {id(item.CHARGE) for item in arguments.EXCIT if item.TYPE_CHARGE == "SUIV"}
    add_materials(problem, arguments.CHAM_MATER, arguments.CARA_ELEM, dynamic,
                  behaviours_of_cells(problem, arguments))
    imposed = add_supports(problem, loads)
    add_loads(problem, loads, arguments.CHAM_MATER)
    add_relations(problem, loads)
    add_discrete(problem, arguments.CARA_ELEM, imposed)
    add_temperatures(problem, arguments.CHAM_MATER)
    add_contact(problem, arguments.get("CONTACT"))
    if not dynamic:
        give_missing_densities(problem)
    tell_choices(session, arguments.get("CONTACT"))
    return problem


def excitations(arguments: Arguments) -> list[tuple[LoadConcept, Function | None]]:
    return [(item.CHARGE, item.FONC_MULT) for item in arguments.EXCIT]


def tell_choices(session: Any, contact: ContactConcept | None) -> None:
    """What the command file asks for and is done otherwise, once each."""
    if contact is None:
        return
    given = contact.arguments
    if given.REAC_GEOM == "CONTROLE":
        session.note("DEFI_CONTACT: REAC_GEOM='CONTROLE' is solved as AUTOMATIQUE: pairs are found anew until they "
                     "stay.")
    for zone in given.ZONE:
        if zone.APPARIEMENT == "NODAL" and given.FORMULATION != "DISCRETE":
            session.note("DEFI_CONTACT: APPARIEMENT='NODAL' is solved as MAIT_ESCL: slave nodes on master faces.")
        if zone.INTEGRATION == "NCOTES":
            session.note("DEFI_CONTACT: INTEGRATION='NCOTES' is solved by SIMPSON.")


def set_time(problem: Problem, arguments: Arguments, instants: np.ndarray, cuts: Any, dynamic: bool,
             start: Start) -> None:
    time = problem.study.time
    time.begin, time.end = float(instants[0]), float(instants[-1])
    lengths = np.diff(instants)
    if np.ptp(lengths) <= SAME_LENGTH * lengths[0]:
        time.step = float(f"{np.mean(lengths):.12g}")  # one length, one factor: instants are sums, with their rounding
    else:
        time.instants = [float(value) for value in instants[1:]]
    time.contact_mass = "consistent"
    time.cut_parts = max(2, int(cuts.parts))
    time.cut_levels = int(cuts.levels)
    if not dynamic:
        time.scheme = "static"
        return
    (scheme,) = arguments.SCHEMA_TEMPS
    set_scheme(time, scheme)
    if arguments.MASS_DIAG == "OUI" and scheme.SCHEMA != "DIFF_CENT":
        raise CommandError(f"{problem.command}/MASS_DIAG: OUI is not available with {scheme.SCHEMA}; masses are those "
                           "of the cells' shape functions.")
    # Without an initial state Code_Aster's first step takes no forces at its beginning.
    time.start = "consistent" if start.given or scheme.SCHEMA == "DIFF_CENT" else "at_rest_unloaded"


def set_scheme(time: Any, scheme: Arguments) -> None:
    if scheme.SCHEMA == "NEWMARK":
        time.scheme = "newmark"
        time.beta, time.gamma = scheme.BETA, scheme.GAMMA
    elif scheme.SCHEMA == "HHT":
        time.scheme = "hht" if scheme.MODI_EQUI == "OUI" else "modified_average_acceleration"
        time.alpha = scheme.ALPHA
    else:
        if time.instants:
            raise CommandError("DYNA_NON_LINE/INCREMENT: DIFF_CENT takes equal steps here.")
        time.scheme = "central_difference"
        time.record = time.step


def wanted_residuals(problem: Problem, arguments: Arguments) -> list[float]:
    """Tighter than what the file asks for; where that cannot be reached, what it asks for."""
    asked = 1e-6
    for item in arguments.CONVERGENCE:
        if item.RESI_GLOB_RELA is not None:
            asked = item.RESI_GLOB_RELA
        if item.ARRET == "NON":
            raise CommandError(f"{problem.command}/CONVERGENCE/ARRET: NON is not available: a state that is not solved "
                               "for is not stored.")
    return [RESIDUAL, asked] if asked > RESIDUAL else [asked]


# ---- solution --------------------------------------------------------------------------------------------------


def begin(session: Any, problem: Problem, arguments: Arguments, start: Start, dynamic: bool) -> tuple[Solved, Any]:
    previous = matching(problem, arguments, start)
    if previous is not None:
        problem.study.time.start = "from_run"
        problem.study.time.start_run = "before"
    try:
        model = rubato.Model(problem.study, problem.finished_mesh())
        if previous is None and start.given:
            give_motion(problem, model, start)
        simulation = rubato.Simulation(model, previous=previous)
    except rubato.InputError as error:
        raise CommandError(f"{problem.command}: {error}") from error
    for note in [*problem.notes, *model.notes]:
        # Sides that supports keep straight already would be told one by one.
        if not note.startswith(f"relations.{SIDE}"):
            session.note(note)
    contact = arguments.get("CONTACT")
    solved = Solved(model, problem.concept, problem.cell_of, problem.physics, problem.zones, problem.springs,
                    problem.ends, arguments.CHAM_MATER, dynamic, contact.arguments.FORMULATION if contact else "",
                    large_strain=any(str(one.strain or "small") != "small" for one in problem.study.materials))
    if "ACCE" in start.fields:
        session.note(f"{problem.command}: ETAT_INIT/ACCE is not followed; the first acceleration balances the forces.")
    if "DEPL" in start.fields or start.stress is not None:
        check_initial_stress(problem, start, Stored(0, simulation.state.t, solved, simulation.state))
    return solved, simulation


def matching(problem: Problem, arguments: Arguments, start: Start) -> Any:
    """The state that the run goes on from with its contact, where that is of the same zones."""
    if start.stored is None or start.stored.state is None or start.fields:
        return None
    solved = start.stored.solved
    same = (solved.mesh is problem.concept and np.array_equal(solved.cell_of, problem.cell_of)
            and len(solved.zones) == len(problem.zones)
            and all(np.array_equal(one.slave_nodes, other.slave_nodes) and one.formulation == other.formulation
                    and one.method == other.method for one, other in zip(solved.zones, problem.zones)))
    return start.stored.state if same else None


def give_motion(problem: Problem, model: Any, start: Start) -> None:
    """Displacements and velocities at nodes, from fields or from the state of another model."""
    fields = dict(start.fields)
    if start.stored is not None:
        from ..fields import field_of

        result = Result("EVOL_NOLI", problem.concept)
        for name in ("DEPL", "VITE"):
            if name == "DEPL" or start.stored.solved is None or start.stored.solved.dynamic:
                fields.setdefault(name, field_of(result, start.stored, name))
    for name, target in (("DEPL", "initial_displacement"), ("VITE", "initial_velocity")):
        if name in fields:
            setattr(model, target, of_dofs(problem, model, fields[name]))


def check_initial_stress(problem: Problem, start: Start, first: Stored) -> None:
    """Code_Aster begins with the stresses of SIGM, else without any, whatever DEPL is; bodies here are under the stress
    of their strain, and springs under the force of their ends. Raises CommandError where these differ."""
    from ..fields import field_of

    result = Result("EVOL_NOLI", problem.concept)
    own = field_of(result, first, "SIEF_ELGA")
    assert isinstance(own, CellField)
    # Rounding of displacements: strains of this size are none.
    allowed = 1e-9 * max(max(material.young or 0.0, getattr(material.orthotropy, "young_x", 0.0) or 0.0)
                         for material in problem.study.materials)
    given = {int(cell): values for part in (start.stress.parts if start.stress else [])
             for cell, values in zip(part.cells, part.values)}
    for part in own.parts:
        for cell, values in zip(part.cells, part.values):
            wanted = np.nan_to_num(given.get(int(cell), np.zeros(values.shape)))
            size = max(np.max(np.abs(values)), np.max(np.abs(wanted)))
            if wanted.shape != values.shape or np.max(np.abs(values - wanted)) > allowed + 1e-6 * size:
                name = problem.concept.cell_name(int(cell))
                raise CommandError(f"ETAT_INIT: the stress of cell {name} (SIGM, else 0) is not that of the strain of "
                                   "DEPL: such initial states are not available; a state of EVOL_NOLI is.")
    moved = np.nan_to_num(start.fields["DEPL"].values) if "DEPL" in start.fields else np.zeros(1)
    if problem.study.connectors and np.any(moved):
        raise CommandError("ETAT_INIT/DEPL: springs have no force at the beginning then: that is not available.")


def of_dofs(problem: Problem, model: Any, given: NodalField) -> np.ndarray:
    """A nodal field as a number a degree of freedom; 0 where it has nothing."""
    dofs = np.asarray(model.dofs)
    values = np.zeros(int(dofs.max()) + 1)
    for axis, name in enumerate(("DX", "DY", "DZ")[:dofs.shape[1]]):
        if name in given.components:
            column = np.nan_to_num(given.column(name))
            known = dofs[:len(column), axis]
            values[known[known >= 0]] = column[known >= 0]
    return values


def march(session: Any, command: str, arguments: Arguments, result: Result, solved: Solved, simulation: Any,
          start: Start) -> None:
    result.cache.clear()  # of states whose orders others get now
    archive = Archive(arguments.ARCHIVAGE)
    observations = Observations(session, arguments.OBSERVATION, result)
    order = store_first(result, solved, simulation, start, arguments)
    observations.note(result.stored[-1] if start.stored is None else
                      Stored(order, simulation.state.t, solved, simulation.state), first=True)
    reused = len({row["NUME_REUSE"] for row in result.parameters})
    wants_energies = any(item.CALCUL == "OUI" for item in arguments.ENERGIE)
    while not simulation.finished:
        step = advance(simulation)
        if not step.accepted:
            raise NotConverged(f"{command}: {step.report}", "MECANONLINE9_7", result)
        state = simulation.state
        stored = Stored(order + 1, state.t, solved, state, step.iterations,
                        parameters={"ITER_GLOB": step.iterations})
        observations.note(stored)
        row = {"NUME_REUSE": reused, "INST": state.t}
        result.parameters.append({**row, **(energies(solved, simulation.energy) if wants_energies else {})})
        if archive.wants(state.t, simulation.finished):
            result.stored.append(stored)
            order += 1
    session.say(f"{command}: {session.assigned}: {simulation.counters.steps} steps, "
                f"{simulation.counters.iterations} iterations, to instant {simulation.state.t:g}")


def within_steps(session: Any, problem: Problem, arguments: Arguments, solved: Solved,
                 cuts: Any) -> Callable[[Stored, Stored, float], list[Stored]]:
    """Returns a function that solves for an instant within a step, where Code_Aster may have cut it."""

    def solve_within(before: Stored, after: Stored, instant: float) -> list[Stored]:
        length = after.instant - before.instant
        if before.state is None or before.solved is not solved or abs(after.state.step - length) > 1e-9 * length:
            return []
        session.note(f"{problem.command}: no step ends at instant {instant:g}, which the file asks for; it is solved from "
                     "the step before.")
        problem.study.time.instants = []
        set_time(problem, arguments, np.array([before.instant, instant]), cuts, solved.dynamic, Start())
        problem.study.time.start, problem.study.time.start_run = "from_run", "before"
        model = rubato.Model(problem.study, problem.finished_mesh())
        simulation = rubato.Simulation(model, previous=before.state)
        while not simulation.finished:
            if not advance(simulation).accepted:
                return []
        return [Stored(before.order, instant, replace(solved, model=model), simulation.state)]

    return solve_within


def advance(simulation: Any) -> Any:
    try:
        return simulation.advance()
    except rubato.InputError as error:
        raise CommandError(str(error)) from error


def store_first(result: Result, solved: Solved, simulation: Any, start: Start, arguments: Arguments) -> int:
    """The initial state has order 0; a result that goes on has it already. Returns the last order there is."""
    if arguments.reuse is not None and result.stored:
        instant = simulation.state.t
        kept = [stored for stored in result.stored if stored.instant <= instant + 1e-12 * max(1.0, abs(instant))]
        result.stored[:] = kept
        return kept[-1].order if kept else -1
    result.stored.append(Stored(0, simulation.state.t, solved, simulation.state))
    return 0
