# SPDX-License-Identifier: LGPL-3.0-or-later
"""The command line: reads the study, looks for what is not available, and runs it in a process with limits."""

from __future__ import annotations

import argparse
import os
import sys
from pathlib import Path

from .export import StudyFiles, read_study
from .limits import Limits, run_limited
from .session import Session, StudyFailed

DONE, CHECK_FAILED, BAD_INPUT, NOT_CONVERGED, OTHER = 0, 1, 2, 3, 4


def parse(arguments: list[str]) -> argparse.Namespace:
    parser = argparse.ArgumentParser(
        prog="rubato aster", description="Run a Code_Aster study: a command file (.comm) or an .export file. A command "
        "file is a Python program and runs with your rights.",
        epilog="Exit codes: 0 done and all tests hold, 1 a test fails, 2 bad input, 3 no convergence, 4 anything else.")
    parser.add_argument("study", type=Path, help="a .comm or an .export file")
    parser.add_argument("-o", "--output", type=Path, help="run folder, where relative paths of the commands are "
                        "(default: out/NAME)")
    parser.add_argument("--file", action="append", default=[], metavar="UNIT=PATH", help="the file of a unit")
    parser.add_argument("--check", action="store_true", help="only look for what is not available")
    parser.add_argument("--time", type=float, metavar="S", help="largest time of the run in seconds (default: the "
                        "study's time_limit, at least 900)")
    parser.add_argument("--memory", type=float, metavar="MB", help="largest memory of the run (default: four fifths of "
                        "what is free)")
    parser.add_argument("--regression-tolerance", type=float, default=1e-3, metavar="R", help="relative tolerance of "
                        "values of Code_Aster itself (VALE_CALC) without a reference (default: %(default)g)")
    return parser.parse_args(arguments)


def main(arguments: list[str]) -> int:
    options = parse(arguments)
    try:
        study = complete(options)
        ready = examine(study)
        if not ready:
            return BAD_INPUT
        if options.check:
            print("every command and keyword of the study is available")
            return DONE
        folder = (options.output or Path("out") / options.study.stem).resolve()
        folder.mkdir(parents=True, exist_ok=True)
        limits = Limits.of(options.time, options.memory, study.time_limit)
        return run_limited(lambda: run(study, folder, options), limits)
    except StudyFailed as failure:
        print(failure, file=sys.stderr)
        return failure.code
    except OSError as error:
        print(f"{error.filename}: {error.strerror}.", file=sys.stderr)
        return BAD_INPUT


def complete(options: argparse.Namespace) -> StudyFiles:
    """The study with the files of the command line; all paths absolute, as the run is in another folder."""
    study = read_study(options.study)
    for text in options.file:
        unit, sign, name = text.partition("=")
        if not sign or not unit.isdigit() or not Path(name).is_file():
            raise StudyFailed(f"--file {text}: expected UNIT=PATH with an existing file.")
        study.units[int(unit)] = Path(name)
    study.commands = [path.resolve() for path in study.commands]
    study.units = {unit: path.resolve() for unit, path in study.units.items()}
    return study


def examine(study: StudyFiles) -> bool:
    """Prints everything that is not available and what is accepted without influence; whether the study may run."""
    from .catalogue import all_commands
    from .scan import scan

    commands = all_commands()
    found, ignored = [], {}
    included = [path for path in study.units.values() if looks_like_commands(path)]
    for path in [*study.commands, *included]:
        missing, harmless = scan(path, commands)
        found += missing
        for command, keywords in harmless.items():
            ignored.setdefault(command, set()).update(keywords)
    for finding in found:
        print(finding, file=sys.stderr)
    if found:
        print(f"{len(found)} not available; nothing was run.", file=sys.stderr)
        return False
    listed = "; ".join(command + (f"/{', '.join(sorted(keywords))}" if keywords else "")
                       for command, keywords in sorted(ignored.items()))
    if listed:
        print(f"accepted, without influence: {listed}")
    return True


def looks_like_commands(path: Path) -> bool:
    """Whether the file of a unit is read by INCLUDE: a text with a command in it."""
    if path.suffix in (".mmed", ".med", ".mail", ".msh", ".mgib"):
        return False
    try:
        text = path.read_bytes()[:20000]
    except OSError:
        return False
    return b"\0" not in text and (b"_F(" in text or b"def " in text or b"FORMULE(" in text)


def run(study: StudyFiles, folder: Path, options: argparse.Namespace) -> int:
    """In the process of the run: executes the files one after the other."""
    from .catalogue import all_commands

    os.chdir(folder)
    units = dict(study.units)
    units.update({unit: folder / name for unit, name in study.outputs.items()})
    session = Session(all_commands(), units, folder)
    session.regression_tolerance = options.regression_tolerance
    code = DONE
    try:
        for path in study.commands:
            session.execute(path)
    except StudyFailed as failure:
        print(failure, file=sys.stderr)
        code = failure.code
    for line in session.checks.summary():
        print(line)
    sys.stdout.flush()
    return code or (DONE if session.checks.hold() else CHECK_FAILED)
