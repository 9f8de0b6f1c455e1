# SPDX-License-Identifier: LGPL-3.0-or-later
"""EXTR_COMP: what Python in command files reads of fields."""

from __future__ import annotations

from typing import Any

import numpy as np

from .keys import CommandError


class ExtractedComponent:
    """`valeurs`: the values; `noeud`, `maille`, `point`, `sous_point`, `comp`: where, if it was asked for, numbers from
    1."""

    def __init__(self, valeurs: np.ndarray):
        self.valeurs = valeurs
        self.noeud: Any = None
        self.maille: Any = None
        self.point: Any = None
        self.sous_point: Any = None
        self.comp: Any = None


def component_at_nodes(field: Any, component: str, groups: Any, places: bool) -> ExtractedComponent:
    """Of a nodal field, at the nodes of groups or at all; all components without one."""
    nodes = _union([field.mesh.nodes_in(name) for name in groups], field.mesh.mesh.node_count)
    columns = [component] if component else list(field.components)
    values = np.column_stack([field.column(name) for name in columns])[nodes]
    there = ~np.isnan(values)
    made = ExtractedComponent(values[there])
    if places:
        made.noeud = np.repeat(nodes + 1, len(columns)).reshape(values.shape)[there]
        made.comp = np.tile(columns, len(nodes)).reshape(values.shape)[there].tolist()
    return made


def component_in_cells(field: Any, component: str, groups: Any, places: bool) -> ExtractedComponent:
    """Of a field in cells, in those of groups or in all."""
    if component not in field.components:
        raise CommandError(f"EXTR_COMP: the field has no component {component!r}; it has "
                           f"{', '.join(field.components)}.")
    chosen = set(_union([field.mesh.cells_in(name) for name in groups], field.mesh.mesh.cell_count).tolist())
    column = field.components.index(component)
    lines = [(int(cell), point, value) for part in field.parts
             for cell, values in zip(part.cells, part.values[..., column]) if int(cell) in chosen
             for point, value in enumerate(values.tolist(), 1) if not np.isnan(value)]
    lines.sort(key=lambda line: line[:2])
    made = ExtractedComponent(np.array([value for _, _, value in lines]))
    if places:
        made.maille = np.array([cell + 1 for cell, _, _ in lines])
        made.point = np.array([point for _, point, _ in lines])
        made.sous_point = np.ones(len(lines), dtype=int)
    return made


def _union(groups: list[np.ndarray], count: int) -> np.ndarray:
    """Ascending, without repeats; everything where there are no groups."""
    return np.unique(np.concatenate(groups)) if groups else np.arange(count)
