# SPDX-License-Identifier: LGPL-3.0-or-later
"""The folder of a run, read back."""

from __future__ import annotations

import csv
import json
import os
from functools import cached_property
from pathlib import Path

import numpy

from . import _rubato


class StoredRun:
    """The folder of a run, read when it is asked for. Tables are dictionaries of arrays, a column each."""

    def __init__(self, folder: str | os.PathLike[str]) -> None:
        """Raises InputError when the folder is no run's."""
        self.folder = Path(folder)
        self.name, self._echo, self.status, self.reason = _rubato._stored_run(self.folder)

    def __repr__(self) -> str:
        return f"<rubato.StoredRun: {self.name}, {self.status}>"

    @cached_property
    def summary(self) -> dict:
        """run.json: what docs/guide/results.md says of it."""
        return json.loads((self.folder / "run.json").read_text(encoding="utf-8"))

    @cached_property
    def study(self):
        """The Study of the run. Raises InputError where it has fields of functions."""
        return _rubato._parse_echo(self._echo, str(self.folder / "run.json"))

    @cached_property
    def probes(self) -> dict:
        """probes.csv: "t" and "tip.x" and so on."""
        return _rubato.read_csv(self.folder / "probes.csv")

    @cached_property
    def energy(self) -> dict:
        """energy.csv: the energy ledger."""
        return _rubato.read_csv(self.folder / "energy.csv")

    @cached_property
    def resultants(self) -> dict:
        """resultants_ZONE.csv of each contact zone, by its name."""
        return {zone: _rubato.read_csv(self.folder / f"resultants_{zone}.csv") for zone in self.zones}

    @cached_property
    def contact(self) -> dict:
        """contact_ZONE.csv of each contact zone, by its name; nan where it is empty, texts for node and status."""
        return {zone: _mixed_table(self.folder / f"contact_{zone}.csv") for zone in self.zones}

    @property
    def zones(self) -> list[str]:
        """Names of the contact zones that have tables."""
        return _rubato._contact_zones(self.folder)

    @cached_property
    def attempts(self) -> list[dict]:
        """steps.jsonl: an entry an attempt at a step."""
        lines = (self.folder / "steps.jsonl").read_text(encoding="utf-8").splitlines()
        return [json.loads(line) for line in lines]

    @property
    def steps(self) -> dict:
        """The keys that every entry of steps.jsonl has, as arrays."""
        shared = set.intersection(*(set(entry) for entry in self.attempts)) if self.attempts else set()
        keys = [key for key in (self.attempts[0] if self.attempts else {}) if key in shared]
        return {key: numpy.array([entry[key] for entry in self.attempts]) for key in keys}

    @property
    def fields(self):
        """StoredFields, from .vtu files or fields.med; None when the run stored none."""
        return _rubato._stored_fields(self.folder)

    def evaluate_checks(self) -> list:
        """The checks of the study, evaluated again: a list of CheckResult."""
        return _rubato._evaluate_checks(self.study, self.folder)


def _mixed_table(path):
    """Columns of numbers, and of texts where one is no number."""
    if not path.exists():
        return {}
    with open(path, encoding="utf-8", newline="") as file:
        header, *rows = list(csv.reader(file))
    columns = zip(*rows) if rows else ((),) * len(header)
    return {name: _column(name, texts) for name, texts in zip(header, columns)}


def _column(name, texts):
    if name in ("node", "status"):
        return numpy.array(texts, dtype=str)
    return numpy.array([float(text) if text else numpy.nan for text in texts])


def open_run(folder: str | os.PathLike[str]) -> StoredRun:
    """The folder of a run, read back. Raises InputError when it is no run's."""
    return StoredRun(folder)
