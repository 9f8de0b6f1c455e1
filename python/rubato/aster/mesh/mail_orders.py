# SPDX-License-Identifier: LGPL-3.0-or-later
"""The order of the groups of nodes of .mail files: rubato's reader gives sets."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np


def with_orders(mesh: Any, path: Path) -> Any:
    """The mesh that was read from this file, with its groups of nodes in the order of the file."""
    if not mesh.node_groups:
        return mesh
    place = {name: i for i, name in enumerate(mesh.node_names)}
    for name, members in node_groups(path.read_text(encoding="latin-1")).items():
        order = [place[member] for member in dict.fromkeys(members) if member in place]
        if len(order) > 1 and np.min(np.diff(order)) < 0 and len(order) == len(mesh.node_groups.get(name, ())):
            mesh = mesh.with_node_group(name, np.array(order, dtype=np.int32), ordered=True)
    return mesh


def node_groups(text: str) -> dict[str, list[str]]:
    """Members of the groups of nodes, in the order of the text. A block begins with its keyword, on a line with its
    name or with the name as first word of the next line, and ends with FINSF."""
    groups: dict[str, list[str]] = {}
    members: list[str] | None = None
    for line in text.splitlines():
        words = line.split("%")[0].replace(",", " ").replace("=", " = ").split()
        if not words:
            continue
        if words[0] == "GROUP_NO" and members is None:
            members = _named(words)
        elif words[0] == "FINSF" and members is not None:
            if members:
                groups.setdefault(members[0], []).extend(members[1:])
            members = None
        elif members is not None:
            members += words
    return groups


def _named(words: list[str]) -> list[str]:
    """[name] where the keyword's line has it: NOM = name."""
    for i, word in enumerate(words[:-2]):
        if word == "NOM" and words[i + 1] == "=":
            return [words[i + 2]]
    return []
