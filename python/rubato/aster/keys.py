# SPDX-License-Identifier: LGPL-3.0-or-later
"""What keywords of commands take, and how arguments are checked against it.

A command is a row of a table: its name, its keywords, and the function that does it. A keyword that no row has is not
available; the scan of the files (scan.py) says so before anything runs, and calls are checked once more when they are
made, because arguments may be computed.
"""

from __future__ import annotations

import difflib
import numbers
from collections.abc import Callable, Iterable
from dataclasses import dataclass, field
from typing import Any


class CommandError(Exception):
    """What a command cannot do, in one sentence. `id_message` is what Code_Aster's own exceptions have."""

    def __init__(self, text: str, id_message: str = ""):
        super().__init__(text)
        self.id_message = id_message


def nearest(word: str, known: Iterable[str]) -> str:
    """' Did you mean WORD?', or nothing where no known word resembles it."""
    close = difflib.get_close_matches(word, list(known), 1, 0.6)
    return f" Did you mean {close[0]}?" if close else ""


# ---- what a keyword takes ------------------------------------------------------------------------------------


@dataclass(frozen=True)
class Real:
    """A number."""

    def fault(self, value: Any) -> str:
        return "" if is_number(value) else f"expected a number, found {shown(value)}."


@dataclass(frozen=True)
class Integer:
    """A whole number."""

    def fault(self, value: Any) -> str:
        whole = is_number(value) and float(value) == int(value)
        return "" if whole else f"expected a whole number, found {shown(value)}."


@dataclass(frozen=True)
class Text:
    """Any text: names of groups, nodes, components."""

    def fault(self, value: Any) -> str:
        return "" if isinstance(value, str) else f"expected a text, found {shown(value)}."


@dataclass(frozen=True)
class Words:
    """One of some words. `missing`: words that Code_Aster has and that are not available here, each with what to
    write instead, or with an empty text."""

    known: tuple[str, ...]
    missing: dict[str, str] = field(default_factory=dict)

    def fault(self, value: Any) -> str:
        if not isinstance(value, str):
            return f"expected one of {', '.join(self.known)}, found {shown(value)}."
        if value.strip() in self.known:
            return ""
        if value.strip() in self.missing:
            return f"{value!r} is not available. {self.missing[value.strip()]}".rstrip()
        return f"{value!r} is not available; there are {', '.join(self.known)}.{nearest(value, self.known)}"


@dataclass(frozen=True)
class Concept:
    """The result of another command: an object of one of these classes of concepts.py, named by their names."""

    kinds: tuple[str, ...]

    def fault(self, value: Any) -> str:
        names = {kind.__name__ for kind in type(value).__mro__}
        return "" if names & set(self.kinds) else f"expected {' or '.join(self.kinds)}, found {shown(value)}."


@dataclass(frozen=True)
class Anything:
    """Whatever the command itself looks at."""

    def fault(self, value: Any) -> str:
        return ""


@dataclass(frozen=True)
class Factor:
    """One or several `_F(…)`, each with these keywords."""

    keys: dict[str, Key]


@dataclass(frozen=True)
class Key:
    """A keyword. `many`: it takes a list, and a single value stands for a list of one. `harmless`: it is accepted,
    has no influence on the answer, and is listed once."""

    takes: Real | Integer | Text | Words | Concept | Anything | Factor
    many: bool = False
    default: Any = None
    required: bool = False
    harmless: bool = False
    most: int | None = None  # factors: how many


def real(default: float | None = None, **more: Any) -> Key:
    return Key(Real(), default=default, **more)


def reals(**more: Any) -> Key:
    return Key(Real(), many=True, **more)


def integer(default: int | None = None, **more: Any) -> Key:
    return Key(Integer(), default=default, **more)


def integers(**more: Any) -> Key:
    return Key(Integer(), many=True, **more)


def text(default: str | None = None, **more: Any) -> Key:
    return Key(Text(), default=default, **more)


def texts(**more: Any) -> Key:
    return Key(Text(), many=True, **more)


def words(*known: str, default: str | None = None, missing: dict[str, str] | None = None, **more: Any) -> Key:
    return Key(Words(known, missing or {}), default=default, **more)


def yes_no(default: str | None = None, **more: Any) -> Key:
    return words("OUI", "NON", default=default, **more)


def yes(**more: Any) -> Key:
    return words("OUI", **more)


def concept(*kinds: str, **more: Any) -> Key:
    return Key(Concept(kinds), **more)


def anything(**more: Any) -> Key:
    return Key(Anything(), **more)


def factor(keys: dict[str, Key] | None = None, **more: Any) -> Key:
    """One or several `_F(…)`; their arguments are always a list of Arguments."""
    return Key(Factor(keys or {}), many=True, **more)


def harmless() -> Key:
    """A keyword that cannot change the answer, with whatever it has."""
    return Key(Anything(), harmless=True)


# ---- commands ------------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class Command:
    """A command. `run(session, arguments)` does it and returns its concept, or nothing. `harmless`: it does nothing
    and takes any keyword. `others`: keywords that the table does not list are values with names of the file's own;
    `arguments.others` has them."""

    name: str
    keys: dict[str, Key]
    run: Callable[..., Any]
    harmless: bool = False
    others: bool = False


class Arguments:
    """The arguments of a call, checked: keywords are attributes. What is not given is its default, or None; lists are
    tuples, `()` when not given; factors are lists of Arguments."""

    def __init__(self, values: dict[str, Any], given: set[str]):
        self._values = values
        self._given = given
        self.others: dict[str, Any] = {}

    def __getattr__(self, name: str) -> Any:
        try:
            return self._values[name]
        except KeyError:
            raise AttributeError(name) from None

    def given(self, name: str) -> bool:
        """Whether the call has the keyword, with something else than None."""
        return name in self._given

    def names_given(self) -> list[str]:
        return [name for name in self._values if name in self._given]

    def get(self, name: str, other: Any = None) -> Any:
        """As the attribute, for keywords that not every command has."""
        return self._values.get(name, other)


def is_number(value: Any) -> bool:
    return isinstance(value, numbers.Real) and not isinstance(value, bool)


def shown(value: Any) -> str:
    """A value in a message, cut where it is long."""
    whole = repr(value)
    return whole if len(whole) <= 60 else whole[:57] + "..."


def as_items(value: Any) -> tuple[Any, ...]:
    """A list or a tuple, as a tuple; anything else as a tuple of one. Arrays are lists."""
    if isinstance(value, (list, tuple)):
        return tuple(value)
    if hasattr(value, "tolist") and not is_number(value):
        return tuple(value.tolist())
    return (value,)


def check(command: Command, given: dict[str, Any]) -> Arguments:
    """The arguments of a call. Raises CommandError, naming the keyword, for what the command does not take."""
    if not command.others:
        return _arguments(command.name, command.keys, given)
    arguments = _arguments(command.name, command.keys, {k: v for k, v in given.items() if k in command.keys})
    arguments.others = {k: v for k, v in given.items() if k not in command.keys}
    return arguments


def _arguments(path: str, keys: dict[str, Key], given: dict[str, Any]) -> Arguments:
    values: dict[str, Any] = {}
    for name, key in keys.items():
        values[name] = () if key.many and key.default is None else key.default
    if any(isinstance(key.takes, Factor) for key in keys.values()):
        for name, key in keys.items():
            if isinstance(key.takes, Factor):
                values[name] = []
    present = set()
    for name, value in given.items():
        if value is None:
            continue
        if name not in keys:
            raise CommandError(f"{path}: keyword {name} is not available.{nearest(name, keys)}")
        values[name] = _value(f"{path}/{name}", keys[name], value)
        present.add(name)
    for name, key in keys.items():
        if key.required and name not in present:
            raise CommandError(f"{path}: keyword {name} is missing.")
    return Arguments(values, present)


def _value(path: str, key: Key, value: Any) -> Any:
    if key.harmless:
        return value
    if isinstance(key.takes, Factor):
        return _factors(path, key, value)
    if not key.many:
        items = as_items(value) if isinstance(value, (list, tuple)) else (value,)
        if isinstance(key.takes, Anything):
            return value
        if len(items) != 1:
            raise CommandError(f"{path}: expected one value, found {len(items)}.")
        return _item(path, key, items[0])
    return tuple(_item(path, key, item) for item in as_items(value))


def _item(path: str, key: Key, item: Any) -> Any:
    if isinstance(item, tuple) and len(item) == 1 and isinstance(key.takes, Concept):
        item = item[0]  # a command with a comma behind it
    fault = key.takes.fault(item)  # type: ignore[union-attr]
    if fault:
        raise CommandError(f"{path}: {fault}")
    if isinstance(key.takes, Real):
        return float(item)
    if isinstance(key.takes, Integer):
        return int(item)
    if isinstance(key.takes, (Text, Words)):
        return item.strip()
    return item


def _factors(path: str, key: Key, value: Any) -> list[Arguments]:
    items = [value] if isinstance(value, dict) else list(as_items(value))
    for item in items:
        if not isinstance(item, dict):
            raise CommandError(f"{path}: expected _F(…), found {shown(item)}.")
    if key.most is not None and len(items) > key.most:
        raise CommandError(f"{path}: expected at most {key.most} _F(…), found {len(items)}.")
    takes = key.takes
    assert isinstance(takes, Factor)
    return [_arguments(path, takes.keys, dict(item)) for item in items]
