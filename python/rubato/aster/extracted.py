# SPDX-License-Identifier: LGPL-3.0-or-later
"""EXTR_COMP and EXTR_TABLE give values of fields and tables to Python in command files."""

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


class TableColumn(list[Any]):
    """A column of an extracted table: a list that also has `values()`."""

    def values(self) -> list[Any]:
        return list(self)


class ExtractedTable:
    """What EXTR_TABLE gives: `rows`, `values()`, columns by attribute."""

    def __init__(self, table: Any):
        self.rows = [dict(row) for row in table.rows]
        self.para = list(table.columns)
        self.titr = table.title

    def append(self, row: dict[str, Any]) -> None:
        self.rows.append(dict(row))
        self.para += [name for name in row if name not in self.para]

    def dict_CREA_TABLE(self) -> dict[str, Any]:
        """Returns the keywords of CREA_TABLE that make this table."""
        lists = []
        for name in self.para:
            lines = [i for i, row in enumerate(self.rows, 1) if row.get(name) is not None]
            values = [self.rows[i - 1][name] for i in lines]
            kind = "K" if any(isinstance(value, str) for value in values) else \
                "I" if all(isinstance(value, int) for value in values) else "R"
            if values:
                lists.append({"PARA": name, f"LISTE_{kind}": values, "NUME_LIGN": lines})
        return {"LISTE": lists, "TITRE": self.titr or None}

    def values(self) -> dict[str, list[Any]]:
        return {column: [row.get(column) for row in self.rows] for column in self.para}

    def __getitem__(self, column: str) -> TableColumn:
        return TableColumn(self.values()[column])

    def __getattr__(self, column: str) -> TableColumn:
        if column.startswith("_") or column not in self.para:
            raise AttributeError(column)
        return self[column]

    def __len__(self) -> int:
        return len(self.rows)
