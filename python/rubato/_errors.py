# SPDX-License-Identifier: LGPL-3.0-or-later
"""What is raised for bad input."""

from typing import NamedTuple


class Fault(NamedTuple):
    """One fault of an input: a whole sentence that says what was found and what was expected.

    Lines and columns count from 1; 0, and an empty file, mean unknown. `path` is that of the value in the study,
    "supports.0.on", where its place in a file is not known.
    """

    text: str
    file: str = ""
    line: int = 0
    column: int = 0
    path: str = ""


class InputError(ValueError):
    """Bad input: one or several faults, reported together.

    str() has a line a fault, as the program prints them: "file:line:column: text".
    """

    def __init__(self, message: str, faults: tuple[Fault, ...] = ()) -> None:
        super().__init__(message, tuple(faults))
        self.faults: list[Fault] = list(faults) or [Fault(message)]

    def __str__(self) -> str:
        return str(self.args[0])


class StepError(RuntimeError):
    """A step that did not converge with no cut left, in a for loop over a Simulation.

    str() says which criterion is not met, by how much and where; `step` is the Step.
    """

    def __init__(self, message: str, step: object = None) -> None:
        super().__init__(message)
        self.step = step
