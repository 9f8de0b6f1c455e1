# SPDX-License-Identifier: LGPL-3.0-or-later
"""What is done with tables: rows are chosen, sorted, joined, and written."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable
from typing import Any

from .concepts import TableConcept
from .keys import Arguments, CommandError, Key, integers, is_number, nearest, real, reals, text, texts, words

Row = dict[str, Any]

FILTER_KEYS: dict[str, Key] = {
    "NOM_PARA": text(required=True),
    "CRIT_COMP": words("EQ", "NE", "LT", "GT", "LE", "GE", "VIDE", "NON_VIDE", "MAXI", "MAXI_ABS", "MINI",
                       "MINI_ABS", "REGEXP", default="EQ"),
    "VALE": reals(),
    "VALE_I": integers(),
    "VALE_K": texts(),
    "CRITERE": words("RELATIF", "ABSOLU", default="RELATIF"),
    "PRECISION": real(1e-3),
}

ORDERS: dict[str, Callable[[float, float], bool]] = {
    "LT": lambda value, limit: value < limit,
    "GT": lambda value, limit: value > limit,
    "LE": lambda value, limit: value <= limit,
    "GE": lambda value, limit: value >= limit,
}
# Which row is kept: the measure of its value, and which of two measures wins.
EXTREMES: dict[str, tuple[Callable[[float], float], Callable[[Iterable[float]], float]]] = {
    "MAXI": (float, max), "MINI": (float, min), "MAXI_ABS": (abs, max), "MINI_ABS": (abs, min),
}


def need_column(table: TableConcept, column: str, where: str) -> None:
    if column not in table.columns:
        raise CommandError(f"{where}: the table has no column {column!r}; it has {', '.join(table.columns)}."
                           f"{nearest(column, table.columns)}")


def filtered(table: TableConcept, filters: Iterable[Arguments], where: str) -> list[Row]:
    """The rows that all filters let pass, one filter after the other."""
    rows = table.rows
    for one in filters:
        need_column(table, one.NOM_PARA, f"{where}/FILTRE")
        rows = _filtered(rows, one, where)
    return rows


def _filtered(rows: list[Row], one: Arguments, where: str) -> list[Row]:
    column, how = one.NOM_PARA, one.CRIT_COMP
    if how == "VIDE":
        return [row for row in rows if row.get(column) is None]
    there = [row for row in rows if row.get(column) is not None]
    if how == "NON_VIDE":
        return there
    if how in EXTREMES:
        measure, best = EXTREMES[how]
        if not there:
            return []
        limit = best(measure(row[column]) for row in there)
        return [row for row in there if measure(row[column]) == limit]
    wanted = one.VALE or one.VALE_I or one.VALE_K
    if not wanted:
        raise CommandError(f"{where}/FILTRE: VALE, VALE_I or VALE_K is missing.")
    if how == "REGEXP":
        return [row for row in there if re.search(str(wanted[0]), str(row[column]))]
    if how in ORDERS:
        return [row for row in there if ORDERS[how](row[column], wanted[0])]
    equal = [row for row in there
             if any(matches(row[column], value, one.PRECISION, one.CRITERE) for value in wanted)]
    return equal if how == "EQ" else [row for row in there if not any(row is other for other in equal)]


def matches(found: Any, wanted: Any, precision: float, criterion: str) -> bool:
    """Whole numbers and texts are equal, texts up to blanks around them; numbers within the precision."""
    if isinstance(found, str) or isinstance(wanted, str):
        return str(found).strip() == str(wanted).strip()
    if isinstance(wanted, int) and isinstance(found, int):
        return found == wanted
    allowed = precision * abs(wanted) if criterion == "RELATIF" else precision
    return abs(found - wanted) <= allowed


def ordered_rows(rows: list[Row], columns: Iterable[str], descending: bool) -> list[Row]:
    """By the columns, one after the other; what is not there comes last."""
    names = list(columns)

    def key(row: Row) -> tuple[Any, ...]:
        return tuple(row[name] for name in names)

    full = [row for row in rows if all(row.get(name) is not None for name in names)]
    rest = [row for row in rows if not any(row is other for other in full)]
    return sorted(full, key=key, reverse=descending) + rest


def joined(table: TableConcept, other: TableConcept, keys: tuple[str, ...], only_common: bool) -> TableConcept:
    """Rows of both where the key columns agree; without keys the rows of the second are put beneath."""
    columns = table.columns + [name for name in other.columns if name not in table.columns]
    rows = [dict(row) for row in table.rows]
    if not keys:
        return TableConcept(columns, rows + [dict(row) for row in other.rows])
    met = []
    for extra in other.rows:
        same = [row for row in rows if all(row.get(name) == extra.get(name) for name in keys)]
        for row in same:
            row.update(extra)
        met += same
        if not same and not only_common:
            rows.append(dict(extra))
            met.append(rows[-1])
    if only_common:
        rows = [row for row in rows if any(row is other_row for other_row in met)]
    return TableConcept(columns, rows)


# ---- text ------------------------------------------------------------------------------------------------------


def shown_value(value: Any, number: str = "{:12.5E}") -> str:
    if value is None:
        return "-"
    if isinstance(value, str):
        return value
    if is_number(value) and not isinstance(value, int) and not hasattr(value, "bit_count"):
        return number.format(value)
    return str(value)


def table_lines(table: TableConcept, columns: Iterable[str] | None = None, separator: str = " ",
                comment: str = "#") -> list[str]:
    """A title line, the columns' names, and a line a row."""
    names = [name for name in (columns or table.columns) if name in table.columns]
    cells = [[shown_value(row.get(name)) for name in names] for row in table.rows]
    widths = [max([len(name), *(len(line[i]) for line in cells)]) for i, name in enumerate(names)]
    head = [f"{comment}{table.title}" if table.title else comment]
    lines = [[name.ljust(width) for name, width in zip(names, widths)]]
    lines += [[cell.ljust(width) for cell, width in zip(line, widths)] for line in cells]
    return head + [separator + separator.join(line).rstrip() for line in lines]
