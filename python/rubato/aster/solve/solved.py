# SPDX-License-Identifier: LGPL-3.0-or-later
"""What was solved, for the fields of its states."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from ..concepts import MaterialField, MeshConcept
from .contact import ZoneRecord
from .discrete import Spring


@dataclass
class Solved:
    """`model`: the rubato.Model; `mesh`: the mesh that the command file has; `cell_of`: which of its cells each cell of
    the model's mesh is; `zones`: contact zones in the order of the model; `springs`: those to ends that belong to no
    body; `ends`: their displacements, functions of time by node and axis; `dynamic`: whether there is inertia."""

    model: Any
    mesh: MeshConcept
    cell_of: np.ndarray
    physics: str
    zones: list[ZoneRecord]
    springs: list[Spring]
    ends: dict[int, dict[int, Any]]
    materials: MaterialField
    dynamic: bool
    formulation: str = ""
    notes: list[str] = field(default_factory=list)
    large_strain: bool = False  # whether laws see another strain than the linear one
    # Solves for an instant within a step, from the states before and after it. The list is empty if that fails.
    within: Callable[[Any, Any, float], list[Any]] | None = None

    @property
    def axisymmetric(self) -> bool:
        return self.physics == "axisymmetric"

    @property
    def ring(self) -> float:
        """Forces of the study are of the whole ring, Code_Aster's per radian."""
        return 2 * np.pi if self.axisymmetric else 1.0

    def displacement(self, state: Any) -> np.ndarray:
        """Nodes × 3, with the ends of springs."""
        values = np.array(state.displacement(self.model), dtype=float)
        for node, axes in self.ends.items():
            for axis, at in axes.items():
                values[node, axis] = at(state.t)
        return values

    def end_forces(self, state: Any) -> np.ndarray:
        """Internal forces at the ends of springs that belong to no body: nodes × 3."""
        moved = self.displacement(state)
        forces = np.zeros_like(moved)
        for spring in self.springs:
            longer = float(spring.along @ (moved[spring.far] - moved[spring.node]))
            forces[spring.far] += spring.stiffness * longer * spring.along
        return forces

    def pulls(self, t: float) -> np.ndarray:
        """The loads on bodies that stand for the displacements of these ends: nodes × 3."""
        forces = np.zeros((self.mesh.mesh.node_count, 3))
        for spring in self.springs:
            for axis, at in self.ends.get(spring.far, {}).items():
                forces[spring.node] += spring.stiffness * spring.along * spring.along[axis] * at(t)
        return forces
