# SPDX-License-Identifier: LGPL-3.0-or-later
"""What command files ask for that is not available, found before anything runs."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from .keys import Command, Factor, Key, Words, nearest
from .session import read_source

COMMAND_NAME = re.compile(r"[A-Z][A-Z0-9]*_[A-Z0-9_]+|DEBUT|FIN|POURSUITE|INCLUDE|FORMULE|DETRUIRE|CALCUL")


@dataclass(frozen=True)
class Finding:
    """Something that is not available, with its place."""

    file: str
    line: int
    text: str

    def __str__(self) -> str:
        return f"{self.file}:{self.line}: {self.text}"


def scan(path: Path, commands: dict[str, Command]) -> tuple[list[Finding], dict[str, set[str]]]:
    """All commands, keywords and words of a file that are not available, in its order, and the keywords that are
    accepted and have no influence, by command. Computed keywords and values are seen when the file runs only. Raises
    StudyFailed for a file that cannot be read; one that is no Python is left to its execution."""
    source = read_source(path)
    try:
        tree = ast.parse(source, str(path))
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        return [], {}
    return Scanner(str(path), commands, own_names(tree)).scan(tree)


def own_names(tree: ast.Module) -> set[str]:
    """Names that the file gives to things of its own: calls of these are no commands."""
    names = set()
    for node in ast.walk(tree):
        if isinstance(node, (ast.FunctionDef, ast.ClassDef)):
            names.add(node.name)
        elif isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store):
            names.add(node.id)
        elif isinstance(node, ast.alias):
            names.add((node.asname or node.name).split(".")[0])
        elif isinstance(node, ast.arg):
            names.add(node.arg)
    return names


class Scanner:
    def __init__(self, file: str, commands: dict[str, Command], own: set[str]):
        self.file = file
        self.commands = commands
        self.own = own
        self.found: list[Finding] = []
        self.ignored: dict[str, set[str]] = {}

    def scan(self, tree: ast.Module) -> tuple[list[Finding], dict[str, set[str]]]:
        for node in ast.walk(tree):
            if isinstance(node, ast.Call) and isinstance(node.func, ast.Name):
                self.call(node, node.func.id)
        self.found.sort(key=lambda finding: finding.line)
        return self.found, self.ignored

    def call(self, node: ast.Call, name: str) -> None:
        if name in self.commands:
            command = self.commands[name]
            if command.harmless:
                self.ignored.setdefault(name, set())
                return
            given = [keyword for keyword in node.keywords if not command.others or keyword.arg in command.keys]
            self.keywords(name, name, command.keys, given)
        elif COMMAND_NAME.fullmatch(name) and name not in self.own:
            self.report(node.lineno, f"command {name} is not available.{nearest(name, self.commands)}")

    def keywords(self, command: str, path: str, keys: dict[str, Key], given: list[ast.keyword]) -> None:
        for keyword in given:
            if keyword.arg is None:
                continue  # **values: checked when it is called
            if keyword.arg not in keys:
                self.report(keyword.lineno, f"{path}: keyword {keyword.arg} is not available."
                                            f"{nearest(keyword.arg, keys)}")
                continue
            key = keys[keyword.arg]
            if key.harmless:
                self.ignored.setdefault(command, set()).add(keyword.arg)
                continue
            self.value(command, f"{path}/{keyword.arg}", key, keyword.value)

    def value(self, command: str, path: str, key: Key, value: ast.expr) -> None:
        if isinstance(key.takes, Factor):
            for item in factors(value):
                self.keywords(command, path, key.takes.keys, item.keywords)
        elif isinstance(key.takes, Words):
            for constant in constants(value):
                fault = key.takes.fault(constant.value)
                if fault:
                    self.report(constant.lineno, f"{path}: {fault}")

    def report(self, line: int, text: str) -> None:
        finding = Finding(self.file, line, text)
        if finding not in self.found:
            self.found.append(finding)


def factors(value: ast.expr) -> Iterator[ast.Call]:
    """Each _F(…) of a value, as far as it is written out."""
    if isinstance(value, ast.Call) and isinstance(value.func, ast.Name) and value.func.id in ("_F", "dict"):
        yield value
    elif isinstance(value, (ast.Tuple, ast.List)):
        for item in value.elts:
            yield from factors(item)
    elif isinstance(value, (ast.ListComp, ast.GeneratorExp)):
        yield from factors(value.elt)


def constants(value: ast.expr) -> Iterator[ast.Constant]:
    """Each text or number of a value, as far as it is written out."""
    if isinstance(value, ast.Constant) and value.value is not None:
        yield value
    elif isinstance(value, (ast.Tuple, ast.List)):
        for item in value.elts:
            yield from constants(item)
