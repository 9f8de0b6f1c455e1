# SPDX-License-Identifier: LGPL-3.0-or-later
"""MECA_STATIQUE."""

from __future__ import annotations

from typing import Any

import numpy as np

from ..concepts import Cuts, Result, Stored
from ..keys import Arguments, CommandError
from ..python_modules import NotConverged
from .nonlinear import RESIDUAL, Start, advance, begin, make_problem, set_time


def meca_statique(session: Any, arguments: Arguments) -> Result:
    """Each instant by itself, without contact; orders count from 1."""
    result = arguments.reuse or Result("EVOL_ELAS", arguments.MODELE.mesh, arguments.MODELE)
    if arguments.LIST_INST is not None:
        instants = np.asarray(arguments.LIST_INST.values, dtype=float)
        if arguments.INST_FIN is not None:
            instants = instants[instants <= arguments.INST_FIN * (1 + 1e-6)]
    else:
        instants = np.array([arguments.INST or 0.0])
    if len(instants) == 0 or np.any(np.diff(instants) <= 0):
        raise CommandError("MECA_STATIQUE/LIST_INST: expected ascending instants.")
    spacing = instants[1] - instants[0] if len(instants) > 1 else 1.0
    listed = np.concatenate([[instants[0] - spacing], instants])
    problem = make_problem(session, "MECA_STATIQUE", arguments, listed, False, False, earliest=float(instants[0]))
    set_time(problem, arguments, listed, Cuts(2, 0), False, Start())
    problem.study.newton.residual = RESIDUAL
    solved, simulation = begin(session, problem, arguments, Start(), False)
    order = result.stored[-1].order if result.stored else 0
    while not simulation.finished:
        step = advance(simulation)
        if not step.accepted:
            raise NotConverged(f"MECA_STATIQUE: {step.report}", "", result)
        order += 1
        result.stored.append(Stored(order, simulation.state.t, solved, simulation.state))
    return result
