# SPDX-License-Identifier: LGPL-3.0-or-later
"""A process of its own for the run, with limits: a command file that never ends, or that takes all memory, is stopped
with a sentence."""

from __future__ import annotations

import os
import resource
import signal
import sys
import time
from collections.abc import Callable
from dataclasses import dataclass

OTHER = 4
INTERRUPTED = 130
_PAUSE = 0.02  # seconds between two looks at the process


@dataclass(frozen=True)
class Limits:
    seconds: float
    megabytes: float

    @staticmethod
    def of(seconds: float | None, megabytes: float | None, of_study: float | None) -> Limits:
        """Those asked for; else the study's own time, which was measured elsewhere, but not less than 15 minutes, and
        four fifths of the memory that is free."""
        return Limits(seconds if seconds is not None else max(900.0, of_study or 0.0),
                      megabytes if megabytes is not None else 0.8 * free_megabytes())


def free_megabytes() -> float:
    with open("/proc/meminfo", encoding="ascii") as file:
        for line in file:
            if line.startswith("MemAvailable:"):
                return int(line.split()[1]) / 1024
    return 4096.0


def run_limited(work: Callable[[], int], limits: Limits) -> int:
    """The exit code of `work`, done in a child process."""
    sys.stdout.flush()
    sys.stderr.flush()
    child = os.fork()
    if child == 0:
        code = OTHER
        try:
            os.setsid()
            code = in_child(work, limits)
        finally:
            sys.stdout.flush()
            sys.stderr.flush()
            os._exit(code)
    return wait_for(child, limits)


def in_child(work: Callable[[], int], limits: Limits) -> int:
    size = int(limits.megabytes * 1024 * 1024)
    resource.setrlimit(resource.RLIMIT_DATA, (size, size))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    try:
        return work()
    except MemoryError:
        print(f"The study takes more than {limits.megabytes:.0f} MB; --memory gives it more.", file=sys.stderr)
        return OTHER
    except KeyboardInterrupt:
        return INTERRUPTED


def wait_for(child: int, limits: Limits) -> int:
    deadline = time.monotonic() + limits.seconds
    while True:
        try:
            ended, status = os.waitpid(child, os.WNOHANG)
            if ended:
                return code_of(status, limits)
            if time.monotonic() > deadline:
                stop(child)
                print(f"The study was stopped: it takes more than {limits.seconds:g} s; --time gives it more.",
                      file=sys.stderr)
                return OTHER
            time.sleep(_PAUSE)
        except KeyboardInterrupt:
            os.killpg(child, signal.SIGINT)
            deadline = min(deadline, time.monotonic() + 2)


def stop(child: int) -> None:
    """Ends the process and all that it started."""
    try:
        os.killpg(child, signal.SIGKILL)
    except ProcessLookupError:
        pass
    os.waitpid(child, 0)


def code_of(status: int, limits: Limits) -> int:
    if os.WIFEXITED(status):
        return os.WEXITSTATUS(status)
    number = os.WTERMSIG(status)
    print(f"The study was ended by signal {signal.Signals(number).name}"
          + (f"; it may need more than {limits.megabytes:.0f} MB (--memory)." if number in (6, 9, 11) else "."),
          file=sys.stderr)
    return OTHER
