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


def _associate(session: Any, arguments: Any) -> int:
    """DEFI_FICHIER: the file of a unit, which is its result; of a free unit where none is given."""
    unit = arguments.UNITE
    if unit is None:
        unit = next(number for number in range(99, 0, -1) if number not in session.files)
    if arguments.ACTION == "LIBERER":
        session.files.pop(unit, None)
    elif arguments.FICHIER is not None:
        session.files[unit] = session.folder / arguments.FICHIER
    return unit


def session_commands() -> list[Command]:
    """Commands about the session itself."""
    from .keys import integer, text, words

    start = {name: harmless() for name in ("CODE", "DEBUG", "IMPR_MACRO", "LANG", "PAR_LOT", "IGNORE_ALARM", "ERREUR",
                                           "BASE", "CATALOGUE", "MEMOIRE", "MESURE_TEMPS", "RESERVE_CPU", "FORMAT_HDF",
                                           "PYTHON", "INFO", "STAGE_NUMBER")}
    return [
        Command("DEBUT", start, lambda session, arguments: None),
        Command("POURSUITE", start, lambda session, arguments: None),
        Command("FIN", {name: harmless() for name in ("FORMAT_HDF", "RETASSAGE", "INFO_RESU", "PROC0", "INFO_BASE",
                                                      "INFO")}, _end),
        Command("INCLUDE", {"UNITE": integer(required=True), "INFO": harmless()}, _include),
        Command("DEFI_FICHIER", {
            "ACTION": words("ASSOCIER", "RESERVER", "LIBERER", default="ASSOCIER"), "UNITE": integer(),
            "FICHIER": text(), "TYPE": harmless(), "ACCES": harmless(), "INFO": harmless()}, _associate),
    ]


def all_commands() -> dict[str, Command]:
    modules = (champ, contact, function_operations, functions, lines, lists, loads, mesh_changes, mesh_files,
               mesh_groups, model, output, post_elem, post_releve, recovery, results, solve, tables, tests)
    commands = session_commands() + [command for module in modules for command in module.COMMANDS]
    table = {command.name: command for command in commands}
    if len(table) != len(commands):
        raise ValueError("a command stands twice in the table")
    return table
