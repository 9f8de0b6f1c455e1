# SPDX-License-Identifier: LGPL-3.0-or-later
"""The classes that a study is made of: records with the members of the C++ structs, and words."""

from __future__ import annotations

import copy
import enum
import inspect
import json
import textwrap

from . import _rubato


class Record:
    """A record of a study. Its members are set by keywords, in their order, or as attributes.

    Assigned values are checked and brought to their usual form: words to members of their enumeration, sequences
    to lists, or to tuples where their number is fixed, numbers to float. Values have the bounds that decks have;
    Study.validate() tells of all that are broken.
    """

    __slots__ = ()
    __hash__ = None
    _members: tuple[str, ...] = ()

    def __init__(self, *values, **members):
        cls = type(self)
        names = cls._members
        if len(values) > len(names):
            raise TypeError(f"{cls.__name__}: found {len(values)} values, expected at most {len(names)}")
        for name, value in zip(names, _rubato._defaults(_record_name(cls))):
            object.__setattr__(self, name, value)
        for name, value in zip(names, values):
            if name in members:
                raise TypeError(f"{cls.__name__}: found {name!r} twice")
            setattr(self, name, value)
        for name, value in members.items():
            if name not in names:
                raise TypeError(f"{cls.__name__}: {_unknown(name, names)}")
            setattr(self, name, value)

    def __setattr__(self, name, value):
        names = self._members
        if name not in names:
            raise AttributeError(f"{type(self).__name__}: {_unknown(name, names)}")
        object.__setattr__(self, name, _rubato._tidied(_record_name(type(self)), name, value))

    def __delattr__(self, name):
        raise AttributeError(f"{type(self).__name__}: members cannot be deleted, {name!r} can be set")

    def __eq__(self, other):
        if type(other) is not type(self):
            return NotImplemented
        return all(getattr(self, name) == getattr(other, name) for name in self._members)

    def __repr__(self):
        """The members that differ from their defaults."""
        defaults = zip(self._members, _rubato._defaults(_record_name(type(self))))
        shown = (f"{name}={getattr(self, name)!r}" for name, value in defaults if getattr(self, name) != value)
        return f"{type(self).__name__}({', '.join(shown)})"

    def __reduce__(self):
        return _restored, (type(self), tuple(getattr(self, name) for name in self._members))

    def copy(self):
        """A copy that shares nothing with this one but functions of GivenField."""
        return copy.deepcopy(self)


def _record_name(cls):
    """The record that a class is, or that it extends."""
    return next(base.__name__ for base in cls.__mro__ if base.__dict__.get("_is_record"))


def _unknown(name, names):
    return _rubato._unknown_name(name, list(names))


def _restored(cls, values):
    record = cls.__new__(cls)
    for name, value in zip(cls._members, values):
        object.__setattr__(record, name, value)
    return record


class _StudyMethods(Record):
    """What a study can do beside having members."""

    __slots__ = ()

    def validate(self):
        """Raises InputError with every rule that the study breaks, each with its path."""
        _rubato._validate(self)

    def to_json(self):
        """The study as a deck of one run, in JSON, with every default written out: what results keep of it.

        It is a deck itself, unless it names other runs or has fields of functions (GivenField).
        """
        return _rubato._to_json(self)

    def echo(self):
        """to_json() as a dictionary."""
        return json.loads(self.to_json())


def _paragraph(text, indent):
    return textwrap.fill(text, 110, initial_indent=indent, subsequent_indent=indent + "    ")


def _documented(meaning, members):
    lines = [_paragraph(f"{name}: {type_}{'; ' if text else ''}{text}", "    ") for name, type_, text in members]
    return "\n".join([meaning, "", *lines])


def _signature(members):
    """Each member by its position or its name; `...` stands for its default."""
    kind = inspect.Parameter.POSITIONAL_OR_KEYWORD
    return inspect.Signature([inspect.Parameter(name, kind, default=..., annotation=type_) for name, type_, _ in members])


def _make_record(name, meaning, members):
    base = _StudyMethods if name == "Study" else Record
    names = tuple(member for member, _, _ in members)
    return type(
        name,
        (base,),
        {
            "__slots__": {member: f"{type_}; {text}" if text else type_ for member, type_, text in members},
            "__doc__": _documented(meaning, members),
            "__module__": "rubato",
            "_members": names,
            "__signature__": _signature(members),
            "_is_record": True,
        },
    )


class Word(enum.StrEnum):
    """A word of an enumeration: equal to its text."""

    def __repr__(self):
        return repr(str(self))


def _make_words(name, meaning, words):
    made = Word(name, [(word, word) for word in words], module="rubato")
    made.__doc__ = meaning + " Each is equal to its word."
    return made


words = {entry[0]: _make_words(*entry) for entry in _rubato._words()}
records = {entry[0]: _make_record(*entry) for entry in _rubato._records()}
globals().update(words)
globals().update(records)
