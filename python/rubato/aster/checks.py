# SPDX-License-Identifier: LGPL-3.0-or-later
"""What TEST_RESU, TEST_TABLE and TEST_FONCTION compare, which comparisons decide, and the tables they print."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field

NON_REGRESSION = "NON_REGRESSION"
# Below this a reference is zero (Code_Aster's own limit).
ZERO = 1e-16
COLUMN = 16


@dataclass
class CheckRow:
    """One comparison. `kind`: the source of the reference, or NON_REGRESSION for Code_Aster's own value (VALE_CALC).
    `error`, `tolerance`: relative to the reference, or absolute. `holds`: None where nothing was compared.
    `decides`: whether the run depends on it."""

    title: str
    label: str
    kind: str
    reference: float | str
    value: float | str
    error: float
    tolerance: float
    relative: bool
    holds: bool | None
    decides: bool = True


@dataclass(frozen=True)
class Wanted:
    """What a check asks for. `own`: VALE_CALC, Code_Aster's value; `outside`: VALE_REFE with its source (REFERENCE).
    One criterion serves both. `magnitude`: ORDRE_GRANDEUR."""

    own: float | str | None = None
    outside: float | str | None = None
    source: str = "NON_DEFINI"
    label: str = "XXXX"
    relative: bool = True
    own_tolerance: float = 1e-6
    outside_tolerance: float = 1e-3
    magnitude: float | None = None
    # Counts of another program's iterations are shown; no answer depends on them.
    comparable: bool = True


def difference(reference: float | str, value: float | str, relative: bool) -> float:
    """|ref − x|, relative to the reference where that is asked for and possible. Texts differ by 0 or infinity."""
    if isinstance(reference, str) or isinstance(value, str):
        return 0.0 if str(reference).strip() == str(value).strip() else float("inf")
    apart = abs(reference - value)
    if not relative or apart == 0:
        return apart
    return apart / abs(reference) if reference != 0 else float("inf")


def judge(title: str, value: float | str, wanted: Wanted, regression_tolerance: float) -> Iterator[CheckRow]:
    """The comparisons of one check, and which of them decide.

    1. VALE_REFE, a reference from outside, holds within PRECISION. Where there is one, it decides.
    2. VALE_CALC is the value that Code_Aster itself gave: non-regression of that program, within TOLE_MACHINE. Beside
       a VALE_REFE it is shown and decides nothing. Alone it decides, and holds within TOLE_MACHINE or within
       `regression_tolerance`, whichever is larger: relative to the value, as this is another program; where the
       check asks for ABSOLU and the value is zero, ORDRE_GRANDEUR takes its place.
    3. A VALE_CALC of zero is compared only when ORDRE_GRANDEUR says what it is small against.
    """
    has_outside = wanted.outside is not None
    if wanted.own is not None:
        yield _regression(title, value, wanted, 0.0 if has_outside else regression_tolerance,
                          decides=not has_outside and wanted.comparable)
    if has_outside:
        error = difference(wanted.outside, value, wanted.relative)
        yield CheckRow(title, wanted.label, wanted.source, wanted.outside, value, error, wanted.outside_tolerance,
                       wanted.relative, error <= wanted.outside_tolerance, wanted.comparable)


def _regression(title: str, value: float | str, wanted: Wanted, of_this_program: float, decides: bool) -> CheckRow:
    reference = wanted.own
    assert reference is not None
    relative, tolerance = wanted.relative, wanted.own_tolerance
    is_zero = not isinstance(reference, str) and abs(reference) < ZERO
    if is_zero and wanted.magnitude is None:
        error = difference(reference, value, False)
        return CheckRow(title, wanted.label, NON_REGRESSION, reference, value, error, tolerance, False, None, False)
    if is_zero:
        relative = False
        scale = abs(wanted.magnitude or 0.0)
        tolerance *= scale
    else:
        scale = 1.0 if relative or isinstance(reference, str) else abs(reference)
    # The tolerance of this program is relative: to the value, or to its order of magnitude.
    tolerance = max(tolerance, of_this_program * scale)
    error = difference(reference, value, relative)
    return CheckRow(title, wanted.label, NON_REGRESSION, reference, value, error, tolerance, relative,
                    error <= tolerance, decides)


@dataclass
class CheckTable:
    rows: list[CheckRow] = field(default_factory=list)

    def failed(self) -> list[CheckRow]:
        """Comparisons that decide and do not hold."""
        return [row for row in self.rows if row.holds is False and row.decides]

    def hold(self) -> bool:
        return not self.failed()

    def add(self, title: str, value: float | str, wanted: Wanted, regression_tolerance: float) -> list[str]:
        """Compares, keeps the rows, and returns the lines of Code_Aster's table without its head."""
        made = list(judge(title, value, wanted, regression_tolerance))
        self.rows.extend(made)
        return [line_of(row) for row in made]

    def summary(self) -> list[str]:
        """Every comparison, a line each, and how many hold."""
        if not self.rows:
            return []
        width = max(len(row.title) for row in self.rows)
        lines = [f"      {'CHECK':<{width}} {HEAD}"]
        lines += [f"{_mark(row)} {row.title:<{width}} {_columns(row)}" for row in self.rows]
        return [*lines, *self._counts()]

    def _counts(self) -> list[str]:
        outside = [row for row in self.rows if row.kind != NON_REGRESSION and row.decides]
        own = [row for row in self.rows if row.kind == NON_REGRESSION and row.decides]
        shown = [row for row in self.rows if not row.decides and row.holds is not None]
        skipped = [row for row in self.rows if row.holds is None]
        lines = []
        for what, rows in (("outside references (VALE_REFE)", outside),
                           ("Code_Aster's own values (VALE_CALC) without an outside reference", own),
                           ("Code_Aster's own values that decide nothing", shown)):
            if rows:
                lines.append(f"{what}: {sum(bool(row.holds) for row in rows)} of {len(rows)} hold")
        if skipped:
            lines.append(f"not compared, the value is zero without ORDRE_GRANDEUR: {len(skipped)}")
        return lines


HEAD = " ".join(f"{name:<{COLUMN}}" for name in ("REFERENCE", "LEGENDE", "VALE_REFE", "VALE_CALC", "ERREUR", "TOLE"))


def line_of(row: CheckRow) -> str:
    """As Code_Aster prints it: OK, NOOK, SKIP. A dash before OK and NOOK: the comparison decides nothing."""
    return f"{_mark(row)} {_columns(row)}".rstrip()


def _mark(row: CheckRow) -> str:
    if row.holds is None:
        return "SKIP "
    sign = " " if row.decides else "-"
    return f"{sign}OK  " if row.holds else f"{sign.strip()}NOOK".ljust(5)


def _columns(row: CheckRow) -> str:
    cells = (row.kind, row.label, _value(row.reference), _value(row.value), _error(row.error, row.relative),
             _error(row.tolerance, row.relative))
    return " ".join(f"{cell:<{COLUMN}}" for cell in cells)


def _value(value: float | str) -> str:
    return value.strip() if isinstance(value, str) else f"{value:.10g}"


def _error(value: float, relative: bool) -> str:
    return f"{100 * value:.6g}%" if relative else f"{value:.6g}"
