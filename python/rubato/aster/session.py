# SPDX-License-Identifier: LGPL-3.0-or-later
"""A session: the command files of a study, executed in one namespace that has all commands."""

from __future__ import annotations

import ast
import math
import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

from .checks import CheckTable
from .concepts import Named
from .keys import Command, CommandError, check
from .python_modules import NotConverged, install_modules


class EndOfFile(Exception):
    """FIN: the rest of the file is not executed."""


class StudyFailed(Exception):
    """A study that cannot go on: a sentence with the place in the files. `code`: the exit code of the program."""

    def __init__(self, text: str, code: int = 2):
        super().__init__(text)
        self.code = code


class CO:
    """The name of a concept that a command makes as one of its outputs."""

    def __init__(self, name: str):
        self.name = name


class _F(dict):
    """Keywords and values of one factor keyword."""

    def __init__(self, *pairs: Any, **values: Any):
        super().__init__(*pairs, **values)


class Session:
    """What commands know of the run.

    `files`: paths by unit number; `folder`: where results are written; `checks`: what TEST_* found; `say(text)` prints
    a line; `note(text)` collects a sentence about the study, printed once. `namespace`: the variables of the files.
    """

    def __init__(self, commands: dict[str, Command], files: dict[int, Path], folder: Path):
        self.files = files
        self.folder = folder
        self.checks = CheckTable()
        self.notes: list[str] = []
        self.written: set[Path] = set()  # result files that commands have begun
        self.regression_tolerance = 1e-3  # relative, of values that are Code_Aster's own
        self.assigned = ""  # the variable that the command being run is assigned to
        self._sources: dict[str, ast.Module] = {}
        self.namespace: dict[str, Any] = {"__name__": "__main__", "__builtins__": __builtins__}
        self._names = {**{name: self._callable(command) for name, command in commands.items()}, "_F": _F, "CO": CO,
                       **mathematics()}
        self.namespace.update(self._names)
        install_modules(self._names)

    # ---- files ---------------------------------------------------------------------------------------------

    def file_of(self, unit: int, what: str) -> Path:
        """The file of a unit. Raises CommandError where the study has none."""
        if unit not in self.files:
            known = ", ".join(f"{number}: {path.name}" for number, path in sorted(self.files.items())) or "none"
            raise CommandError(f"unit {unit} ({what}) has no file; units with a file: {known}.")
        return self.files[unit]

    def output_of(self, unit: int, ending: str) -> Path:
        """Where a unit is written: the file in the run folder that the study gives it, else fort.UNIT there. Files
        elsewhere are what the study reads: they are never written."""
        path = self.files.get(unit)
        if path is not None and path.parent == self.folder:
            return path
        return self.folder / f"fort.{unit}{ending}"

    def include(self, unit: int) -> None:
        """INCLUDE: executes the file of a unit in the same namespace."""
        self.execute(self.file_of(unit, "INCLUDE"))

    def execute(self, path: Path) -> None:
        """Executes a command file. Raises StudyFailed with file and line for what goes wrong."""
        source = read_source(path)
        try:
            self._sources[str(path)] = tree = ast.parse(source, str(path))
        except SyntaxError as error:
            raise StudyFailed(f"{path}:{error.lineno}: {error.msg}.") from error
        try:
            exec(compile(tree, str(path), "exec"), self.namespace)  # noqa: S102 - the user's own program
        except EndOfFile:
            return
        except StudyFailed:
            raise
        except KeyboardInterrupt:
            raise
        except BaseException as error:
            raise self._failure(error) from error

    def _failure(self, error: BaseException) -> StudyFailed:
        place = self.place_of(error)
        if isinstance(error, CommandError):
            code = getattr(error, "exit_code", 2)
            return StudyFailed(f"{place}: {error}{self._kept(error)}", code)
        if isinstance(error, SystemExit):
            return StudyFailed(f"{place}: the command file called exit.", 4)
        if isinstance(error, MemoryError):
            return StudyFailed(f"{place}: there is not enough memory; --memory gives the study more.", 4)
        return StudyFailed(f"{place}: {type(error).__name__}: {error}", 2)

    def _kept(self, error: CommandError) -> str:
        """Writes what a step that could not be solved leaves, and says where."""
        if not isinstance(error, NotConverged) or error.result is None or not error.result.stored:
            return ""
        from .commands.output import keep

        return f" What was solved before is in {keep(self, error.result).name}."

    def place_of(self, error: BaseException) -> str:
        """file:line of the last line of the study's own files that an error went through."""
        place = ""
        trace = error.__traceback__
        while trace is not None:
            if trace.tb_frame.f_code.co_filename in self._sources:
                place = f"{trace.tb_frame.f_code.co_filename}:{trace.tb_lineno}"
            trace = trace.tb_next
        return place or next(iter(self._sources), "")

    # ---- what commands tell --------------------------------------------------------------------------------

    def say(self, text: str = "") -> None:
        print(text, flush=True)

    def note(self, text: str) -> None:
        if text not in self.notes:
            self.notes.append(text)
            self.say(f"note: {text}")

    # ---- calls ---------------------------------------------------------------------------------------------

    def _callable(self, command: Command) -> Callable[..., Any]:
        def call(*positional: Any, **given: Any) -> Any:
            if positional and not command.harmless:
                raise CommandError(f"{command.name}: arguments without keyword are not available.")
            if command.harmless:
                return None
            arguments = check(command, given)
            frame = sys._getframe(1)
            before, self.assigned = self.assigned, self._assigned_name(frame) or ""
            try:
                made = command.run(self, arguments)
            except NotConverged as error:
                self._keep_part(error, frame)
                raise
            finally:
                self.assigned = before
            if isinstance(made, Named):
                self._register(made, frame)
            return made

        call.__name__ = command.name
        return call

    def _keep_part(self, error: NotConverged, frame: Any) -> None:
        """What was solved up to the failure is a result, as in Code_Aster: the file may go on with it."""
        if error.result is None:
            return
        self._register(error.result, frame)
        if error.result.name.isidentifier():
            self.namespace[error.result.name] = error.result

    def _register(self, made: Named, frame: Any) -> None:
        """Names a concept after the variable it is assigned to. Code_Aster's supervisor knows concepts that functions
        make by that name everywhere, so they become variables of the files."""
        name = self._assigned_name(frame)
        if name is None:
            return
        made.name = name
        known = self.namespace.get(name)
        if frame.f_code.co_name != "<module>" and name.isidentifier() and (known is None or isinstance(known, Named)):
            self.namespace[name] = made

    def _assigned_name(self, frame: Any) -> str | None:
        tree = self._sources.get(frame.f_code.co_filename)
        if tree is None:
            return None
        for target, first, last in assignments(tree):
            if first <= frame.f_lineno <= last:
                return target
        return None

    def new_concept(self, co: CO, made: Named) -> None:
        """A concept that a command makes as an output, X = CO('X')."""
        made.name = co.name
        # The object that stands for the name becomes the concept: files keep it in lists.
        co.__class__, co.__dict__ = type(made), made.__dict__  # type: ignore[assignment]
        self.namespace[co.name] = co


def assignments(tree: ast.Module) -> Iterator[tuple[str, int, int]]:
    """Targets of assignments whose value is a call, with their first and last lines; innermost lines last."""
    for node in ast.walk(tree):
        if isinstance(node, ast.Assign) and isinstance(node.value, (ast.Call, ast.Tuple)):
            yield ast.unparse(node.targets[0]), node.lineno, node.end_lineno or node.lineno


def mathematics() -> dict[str, Any]:
    """The functions that command files have without importing them."""
    names = ("pi", "sqrt", "sin", "cos", "tan", "asin", "acos", "atan", "atan2", "sinh", "cosh", "tanh", "exp", "log",
             "log10", "floor", "ceil")
    return {name: getattr(math, name) for name in names}


def read_source(path: Path) -> str:
    """The text of a command file: UTF-8, or Latin-1 as old ones are. Raises StudyFailed."""
    try:
        data = path.read_bytes()
    except OSError as error:
        raise StudyFailed(f"{path}: the file cannot be read: {error.strerror}.") from error
    if b"\0" in data:
        raise StudyFailed(f"{path}: this is no text file.")
    try:
        source = data.decode("utf-8-sig")
    except UnicodeDecodeError:
        source = data.decode("latin-1")
    return source.replace("\r\n", "\n")
