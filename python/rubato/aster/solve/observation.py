# SPDX-License-Identifier: LGPL-3.0-or-later
"""OBSERVATION stores values of fields after each step, PARA_CALC energies, as rows of tables."""

from __future__ import annotations

from typing import Any

import numpy as np

from ..concepts import CellField, NodalField, Result, Stored
from ..keys import Arguments, CommandError
from ..selection import column_of

REDUCTIONS = {"MIN": np.nanmin, "MAX": np.nanmax, "MOY": np.nanmean, "MINI_ABS": lambda v: np.nanmin(np.abs(v)),
              "MAXI_ABS": lambda v: np.nanmax(np.abs(v))}


class Observations:
    """Rows go to result.observations. Whatever is observed of a step is computed then."""

    def __init__(self, session: Any, items: list[Arguments], result: Result):
        self.items = items
        self.result = result
        self.steps = 0
        self.reused = len({row["NUME_REUSE"] for row in result.observations})

    def note(self, stored: Stored, first: bool = False) -> None:
        if not first:
            self.steps += 1
        for number, item in enumerate(self.items, 1):
            if first and item.OBSE_ETAT_INIT != "OUI":
                continue
            if self.wanted(item, stored.instant, first):
                self.observe(number, item, stored)

    def wanted(self, item: Arguments, instant: float, first: bool) -> bool:
        instants = item.LIST_INST.values if item.LIST_INST is not None else np.asarray(item.INST)
        if len(instants):
            allowed = item.PRECISION * (np.abs(instants) if item.CRITERE == "RELATIF" else 1.0)
            return bool(np.any(np.abs(instants - instant) <= allowed))
        return first or item.PAS_OBSE is None or self.steps % max(1, item.PAS_OBSE) == 0

    def observe(self, number: int, item: Arguments, stored: Stored) -> None:
        from ..fields import field_of

        for name in item.NOM_CHAM:
            field = field_of(Result("EVOL_NOLI", self.result.mesh), stored, name)
            for component in item.NOM_CMP or item.NOM_VARI or field.components:
                if isinstance(field, NodalField):
                    nodes = self.result.mesh.nodes(item)
                    places = [{"NOEUD": self.result.mesh.node_name(int(node))} for node in nodes]
                    self.rows(number, item, stored, name, component, field.column(component)[nodes], places)
                else:
                    self.rows(number, item, stored, name, component, *values_in_cells(field, item, component))

    def rows(self, number: int, item: Arguments, stored: Stored, name: str, component: str, values: np.ndarray,
             places: list[dict[str, Any]]) -> None:
        base: dict[str, Any] = {"NUME_OBSE": number, "NOM_OBSERVATION": item.TITRE or f"OBSERVATION_{number}",
                                "TYPE_OBJET": "R", "NUME_REUSE": self.reused, "INST": stored.instant,
                                "NUME_ORDRE": stored.order, "NOM_CHAM": name, "EVAL_CHAM": item.EVAL_CHAM,
                                "NOM_CMP": component, "EVAL_CMP": item.EVAL_CMP}
        if item.EVAL_CHAM != "VALE":
            self.result.observations.append({**base, "VALE": float(REDUCTIONS[item.EVAL_CHAM](values))})
            return
        for place, value in zip(places, values):
            if not np.isnan(value):
                self.result.observations.append({**base, **place, "VALE": float(value)})


def values_in_cells(field: CellField, item: Arguments, component: str) -> tuple[np.ndarray, list[dict[str, Any]]]:
    """Returns values at the Gauss points POINT of the cells, or at all, or the extreme value of each cell (EVAL_ELGA); and
    the place of each value."""
    if any(point != 1 for point in item.SOUS_POINT):
        raise CommandError("OBSERVATION/SOUS_POINT: continuum cells have one.")
    column = column_of(field, component)
    values: list[float] = []
    places: list[dict[str, Any]] = []
    wanted = set(field.mesh.cells(item).tolist())
    for part in field.parts:
        for cell, rows in zip(part.cells, part.values[..., column]):
            if int(cell) not in wanted:
                continue
            there = {"MAILLE": field.mesh.cell_name(int(cell))}
            if item.EVAL_ELGA != "VALE":
                values.append(float(REDUCTIONS[item.EVAL_ELGA](rows)))
                places.append(there)
                continue
            for point in item.POINT or range(1, len(rows) + 1):
                if not 1 <= point <= len(rows):
                    raise CommandError(f"OBSERVATION/POINT: cell {there['MAILLE']} has the points 1 to {len(rows)}.")
                values.append(float(rows[point - 1]))
                places.append({**there, "POINT": point})
    return np.array(values), places


# ---- PARA_CALC -------------------------------------------------------------------------------------------------


def energies(solved: Any, ledger: Any) -> dict[str, float]:
    """Returns Code_Aster's energies since the start of the solve, in axisymmetric models per radian. TRAV_EXT = ENER_CIN +
    ENER_TOT + TRAV_AMOR + TRAV_LIAI + DISS_SCH. Supports and contact take TRAV_LIAI."""
    parts = {
        "TRAV_EXT": ledger.external_work,
        "ENER_CIN": ledger.kinetic,
        "ENER_TOT": ledger.strain + ledger.plastic + ledger.back_stress + ledger.viscous + ledger.hourglass - ledger.heat,
        "TRAV_AMOR": ledger.damping,
        "TRAV_LIAI": ledger.contact + ledger.friction + ledger.impact - ledger.support_work - ledger.overlap_work,
        "DISS_SCH": ledger.numerical + ledger.bulk_scheme - ledger.unbalanced,
    }
    return {name: value / solved.ring for name, value in parts.items()}
