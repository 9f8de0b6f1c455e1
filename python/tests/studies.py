# SPDX-License-Identifier: LGPL-3.0-or-later
"""Studies that tests share."""

import os
from pathlib import Path

import rubato

SOURCES = Path(os.environ["RUBATO_SOURCE_DIR"])
BUILD = Path(os.environ["RUBATO_BUILD_DIR"])
PROGRAM = os.environ["RUBATO_PROGRAM"]


def box(divisions=(4, 2), cells="quad4"):
    """A box in the plane with the sides "held", "end" and "top", and the corner "tip"."""
    return rubato.Body(
        name="box",
        dimension=2,
        to=(2, 1),
        divisions=(*divisions, 1),
        cells=cells,
        sides={"left": "held", "right": "end", "top": "top"},
        points={"right_top": "tip"},
    )


def bar(**time):
    """A box that is pulled."""
    return rubato.Study(
        name="bar",
        physics="plane_strain",
        mesh=rubato.MeshSource(bodies=[box()]),
        materials=[rubato.Material(name="rubber", young=100, poisson=0.3, density=2)],
        supports=[rubato.Support(on="held", components=(0, 0))],
        loads=[rubato.Load(kind="surface_force", on="end", components=(1, 0.5))],
        probes=[rubato.Probe(name="tip", node="tip")],
        time=rubato.TimeStepping(**({"scheme": "newmark", "contact_mass": "consistent", "step": 0.05, "end": 1} | time)),
    )


def blocks(friction=0.2, **time):
    """A block that is pressed on another one and pushed along it."""
    lower = rubato.Body(
        name="lower",
        dimension=2,
        from_=(0, -1),
        to=(3, 0),
        divisions=(6, 2, 1),
        cells="quad4",
        sides={"top": "ground", "bottom": "held"},
    )
    upper = rubato.Body(
        name="upper", dimension=2, from_=(1, 0), to=(2, 1), divisions=(3, 3, 1), cells="quad4",
        sides={"bottom": "sole", "top": "roof"},
    )
    return rubato.Study(
        name="blocks",
        physics="plane_strain",
        mesh=rubato.MeshSource(bodies=[lower, upper]),
        materials=[rubato.Material(name="rubber", young=100, poisson=0.3, density=1)],
        supports=[
            rubato.Support(on="held", components=(0, 0)),
            rubato.Support(on="roof", components=(rubato.Field(0.2, "push"), rubato.Field(-0.02, "press"))),
        ],
        functions={"press": ([0, 1], [0, 1]), "push": rubato.Ramp(1, 2)},
        contact=[rubato.ContactZone(name="pair", master="ground", slave="sole", friction=friction)],
        time=rubato.TimeStepping(**({"scheme": "static", "contact_mass": "consistent", "step": 0.25, "end": 2} | time)),
    )


def case(run="evol1"):
    """SDNL140 F with Code_Aster's values in its checks."""
    return rubato.load(SOURCES / "cases/sdnl140/f.yaml", run)
