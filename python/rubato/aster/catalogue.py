# SPDX-License-Identifier: LGPL-3.0-or-later
"""The table of commands."""

from __future__ import annotations

from typing import Any

from .commands import (
    champ, contact, function_operations, functions, lines, lists, loads, mesh_changes, mesh_files, mesh_groups,
    model, output, post_elem, post_releve, recovery, results, solve, tables, tests,
)
from .keys import Command, harmless


def _end(session: Any, arguments: Any) -> None:
    from .session import EndOfFile

    raise EndOfFile


def _include(session: Any, arguments: Any) -> None:
    session.include(arguments.UNITE)


def session_commands() -> list[Command]:
    """Commands about the session itself."""
    from .keys import integer

    start = {name: harmless() for name in ("CODE", "DEBUG", "IMPR_MACRO", "LANG", "PAR_LOT", "IGNORE_ALARM", "ERREUR",
                                           "BASE", "CATALOGUE", "MEMOIRE", "MESURE_TEMPS", "RESERVE_CPU", "FORMAT_HDF",
                                           "PYTHON", "INFO", "STAGE_NUMBER")}
    return [
        Command("DEBUT", start, lambda session, arguments: None),
        Command("POURSUITE", start, lambda session, arguments: None),
        Command("FIN", {name: harmless() for name in ("FORMAT_HDF", "RETASSAGE", "INFO_RESU", "PROC0", "INFO_BASE",
                                                      "INFO")}, _end),
        Command("INCLUDE", {"UNITE": integer(required=True), "INFO": harmless()}, _include),
    ]


def all_commands() -> dict[str, Command]:
    modules = (champ, contact, function_operations, functions, lines, lists, loads, mesh_changes, mesh_files,
               mesh_groups, model, output, post_elem, post_releve, recovery, results, solve, tables, tests)
    commands = session_commands() + [command for module in modules for command in module.COMMANDS]
    table = {command.name: command for command in commands}
    if len(table) != len(commands):
        raise ValueError("a command stands twice in the table")
    return table
