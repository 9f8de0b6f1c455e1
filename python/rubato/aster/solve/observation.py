# SPDX-License-Identifier: LGPL-3.0-or-later
"""OBSERVATION: values of fields at nodes after each step, rows of a table."""

from __future__ import annotations

from typing import Any

import numpy as np

from ..concepts import NodalField, Result, Stored
from ..keys import Arguments, CommandError

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
            if not isinstance(field, NodalField):
                raise CommandError(f"OBSERVATION/NOM_CHAM: {name} is not at nodes: that is not available.")
            nodes = self.result.mesh.nodes(item)
            for component in item.NOM_CMP or field.components:
                self.rows(number, item, stored, name, component, field.column(component)[nodes], nodes)

    def rows(self, number: int, item: Arguments, stored: Stored, name: str, component: str, values: np.ndarray,
             nodes: np.ndarray) -> None:
        base: dict[str, Any] = {"NUME_OBSE": number, "NOM_OBSERVATION": item.TITRE or f"OBSERVATION_{number}",
                                "TYPE_OBJET": "R", "NUME_REUSE": self.reused, "INST": stored.instant,
                                "NUME_ORDRE": stored.order, "NOM_CHAM": name, "EVAL_CHAM": item.EVAL_CHAM,
                                "NOM_CMP": component, "EVAL_CMP": item.EVAL_CMP}
        if item.EVAL_CHAM != "VALE":
            self.result.observations.append({**base, "VALE": float(REDUCTIONS[item.EVAL_CHAM](values))})
            return
        for node, value in zip(nodes, values):
            if not np.isnan(value):
                self.result.observations.append({**base, "NOEUD": self.result.mesh.node_name(int(node)),
                                                 "VALE": float(value)})
