# SPDX-License-Identifier: LGPL-3.0-or-later
"""A problem in the making: the study, its mesh with the groups that the study names, and values of place and time."""

from __future__ import annotations

from typing import Any

import numpy as np

import rubato

from ..concepts import Constant, Function, MeshConcept, ModelConcept, TableFunction
from ..keys import CommandError

PARAMETERS = ("X", "Y", "Z", "INST")
AXES = {"DX": 0, "DY": 1, "DZ": 2, "FX": 0, "FY": 1, "FZ": 2}


class Problem:
    """What the parts of solve/ add to.

    `solid`: cells that deform; `mesh`: the mesh that is solved on, with every node of the concept's; `cell_of`: which
    cell of the concept's mesh each of its cells is; `begin`, `end`: the instants between which functions of time must
    hold; `axisymmetric`: forces per radian become forces of the ring.
    """

    def __init__(self, command: str, model: ModelConcept, begin: float, end: float):
        self.command = command
        self.model = model
        self.concept: MeshConcept = model.mesh
        self.begin = begin
        self.end = end
        self.study = rubato.Study()
        self.study.name = "run"
        self.mesh: rubato.Mesh = model.mesh.mesh
        self.cell_of: np.ndarray = np.arange(self.mesh.cell_count)
        self.solid: np.ndarray = np.zeros(0, dtype=np.int64)
        self.body_nodes: np.ndarray = np.zeros(0, dtype=np.int64)
        self.rigid_nodes: np.ndarray = np.zeros(0, dtype=np.int64)
        self.physics = "solid"
        self.zones: list[Any] = []
        self.notes: list[str] = []  # what is done otherwise than asked for
        self.springs: list[Any] = []  # discrete.Spring: those to ends that belong to no body
        # These ends: by node and axis the displacement as a function of time.
        self.ends: dict[int, dict[int, Any]] = {}
        self._node_groups: dict[str, np.ndarray] = {}  # groups that the file does not have
        self._cell_groups: dict[str, np.ndarray] = {}
        self._names: dict[tuple[str, bytes], str] = {}
        self._own_nodes: dict[bytes, str] | None = None  # those of the file, by their items
        self._own_cells: dict[bytes, str] | None = None
        self._place_in_mesh: np.ndarray | None = None
        self._functions: dict[int, str] = {}
        self.tables: dict[str, tuple[np.ndarray, np.ndarray]] = {}  # functions of time, by their names in the study
        self.following: set[int] = set()  # loads whose pressures follow the faces, by their identity
        self.continues = False  # from an initial state
        self.has_temperatures = False  # AFFE_VARC gives TEMP
        self.bounds_penetration = False  # Code_Aster raises penalties of contact (EVENEMENT='INTERPENETRATION')
        # The first instant at which anything is asked for; states before it have the values of that instant.
        self.earliest = begin
        self._kept: list[Any] = []  # functions by whose identity names were given

    # ---- where ---------------------------------------------------------------------------------------------

    @property
    def dimension(self) -> int:
        return 3 if self.physics == "solid" else 2

    @property
    def axisymmetric(self) -> bool:
        return self.physics == "axisymmetric"

    @property
    def ring(self) -> float:
        """What forces are multiplied with: Code_Aster's are per radian, those of the study of the whole ring."""
        return 2 * np.pi if self.axisymmetric else 1.0

    def keep_cells(self, kept: np.ndarray) -> None:
        """Leaves the other cells out of the mesh that is solved on."""
        if len(kept) == self.concept.mesh.cell_count:
            return
        self.mesh, self.cell_of = with_cells(self.concept.mesh, kept)
        self._place_in_mesh = None

    def in_mesh(self, cells: np.ndarray) -> np.ndarray:
        """Cells of the concept's mesh as cells of the mesh that is solved on."""
        if self._place_in_mesh is None:
            self._place_in_mesh = np.full(self.concept.mesh.cell_count, -1)
            self._place_in_mesh[self.cell_of] = np.arange(len(self.cell_of))
        places = self._place_in_mesh[np.asarray(cells, dtype=np.int64)]
        return places[places >= 0]

    def node_group(self, nodes: Any) -> str:
        """A group of these nodes: one of the file's own, that messages name, or a new one."""
        nodes = np.unique(np.asarray(nodes, dtype=np.int64))
        if self._own_nodes is None:
            self._own_nodes = {np.unique(items).tobytes(): name for name, items in self._named_nodes().items()}
        return self._own_nodes.get(nodes.tobytes()) or self._new_group(self._node_groups, nodes, "nodes")

    def _named_nodes(self) -> dict[str, np.ndarray]:
        """The nodes of each group of the file whose name means nothing else."""
        mesh = self.concept.mesh
        groups = {name: np.asarray(items, dtype=np.int64) for name, items in mesh.node_groups.items()}
        for name, items in mesh.cell_groups.items():
            nodes = self.concept.nodes_of_cells(items)
            if name in groups and not np.array_equal(np.unique(groups[name]), nodes):
                groups.pop(name)
            elif name not in groups:
                groups[name] = nodes
        known = {self.concept.node_name(i) for i in range(mesh.node_count)} & set(groups)
        return {name: nodes for name, nodes in groups.items() if name not in known and len(nodes)}

    def cell_group(self, cells: Any) -> str:
        """A group of these cells of the concept's mesh, likewise."""
        cells = np.unique(self.in_mesh(cells)).astype(np.int64)
        if self._own_cells is None:
            own = {name: np.unique(self.in_mesh(items)) for name, items in self.concept.mesh.cell_groups.items()}
            self._own_cells = {items.astype(np.int64).tobytes(): name for name, items in own.items() if len(items)}
        return self._own_cells.get(cells.tobytes()) or self._new_group(self._cell_groups, cells, "cells")

    def _new_group(self, made: dict[str, np.ndarray], items: np.ndarray, kind: str) -> str:
        key = kind, items.tobytes()
        if key not in self._names:
            self._names[key] = f"rubato_{kind}_{len(made) + 1}"
        made[self._names[key]] = items
        return self._names[key]

    def cells_named(self, name: str) -> np.ndarray:
        """Cells of the mesh that is solved on."""
        groups = self._cell_groups if name in self._cell_groups else self.mesh.cell_groups
        return np.asarray(groups[name])

    def finished_mesh(self) -> rubato.Mesh:
        """The mesh that is solved on, with all groups that the study names."""
        return self.mesh.with_node_groups(self._node_groups).with_cell_groups(self._cell_groups).mended()

    def moving(self, nodes: Any) -> np.ndarray:
        """Those of the nodes that have displacements: nodes of bodies and of rigid surfaces."""
        known = np.concatenate([self.body_nodes, self.rigid_nodes])
        nodes = np.asarray(nodes, dtype=np.int64)
        return nodes[np.isin(nodes, known)]

    # ---- what ----------------------------------------------------------------------------------------------

    def value(self, value: Any, multiplier: Function | None = None, factor: float = 1.0) -> tuple[Any, str]:
        """A number or a function of place and time, times a function of time and a factor, as the value and the name
        of the function of a study."""
        if isinstance(value, Constant):
            value = value.value
        if isinstance(multiplier, Constant):
            factor *= multiplier.value
            multiplier = None
        if not isinstance(value, Function):
            number = float(value) * factor
            if multiplier is None:
                return number, ""
            if self._is_table(multiplier):
                return number, self._table_name(multiplier)
            return self._given(lambda x, y, z, t: number * multiplier(t), multiplier, True), ""
        check_parameters(value)
        if self._is_table(value) and multiplier is None:
            return factor, self._table_name(value)
        of_place = evaluate(value)
        if multiplier is None:
            return self._given(lambda x, y, z, t: factor * of_place(x, y, z, t), value, "INST" in value.parameters), ""
        if self._is_table(multiplier) and "INST" not in value.parameters:
            return self._given(lambda x, y, z, t: factor * of_place(x, y, z, t), value, False), \
                self._table_name(multiplier)
        return self._given(lambda x, y, z, t: factor * of_place(x, y, z, t) * multiplier(t), value, True), ""

    def field(self, value: Any, multiplier: Function | None = None, factor: float = 1.0) -> Any:
        """The same as one rubato.Field."""
        return rubato.Field(*self.value(value, multiplier, factor))

    def displacement(self, value: Any, multiplier: Function | None = None) -> Any:
        """The same for what is imposed. Without an initial state Code_Aster's bodies are undeformed at the first
        instant, whatever the value is there, and all of it comes with the first step: slip is counted from 0."""
        amount, name = self.value(value, multiplier)
        if self.continues or (isinstance(amount, float) and amount == 0):
            return rubato.Field(amount, name)
        if not name:
            return rubato.Field(amount, self._onset()) if isinstance(amount, float) or not amount.varies_in_time \
                else rubato.Field(self._after_begin(amount))
        return rubato.Field(amount, self._from_zero(name))

    def _onset(self) -> str:
        """The name of the function that is 0 at the first instant and 1 afterwards."""
        return self._add_function("onset", [self.begin, self._after], [0.0, 1.0])

    @property
    def _after(self) -> float:
        """So soon after the first instant that no step ends before."""
        return self.begin + 1e-9 * (self.end - self.begin)

    def _from_zero(self, name: str) -> str:
        """The function of time that is 0 at the first instant and that function afterwards."""
        table = self.tables[name]
        if np.interp(self.begin, *table) == 0:
            return name
        later = table[0] > self._after
        return self._add_function(f"{name}_from_zero", [self.begin, self._after, *table[0][later]],
                                  [0.0, float(np.interp(self._after, *table)), *table[1][later]])

    def _after_begin(self, given: Any) -> Any:
        function, begin = given.function, self.begin
        return rubato.GivenField(given.name, lambda x, y, z, t: function(x, y, z, t) if t > begin else 0.0, True)

    def _add_function(self, name: str, places: Any, values: Any) -> str:
        if name not in self.tables:
            self.tables[name] = (np.asarray(places, dtype=float), np.asarray(values, dtype=float))
            functions = dict(self.study.functions)
            functions[name] = rubato.LinearTable([float(x) for x in places], [float(y) for y in values])
            self.study.functions = functions
        return name

    def clock(self, t: float) -> float:
        """The instant at which functions are asked for at instant t."""
        return max(t, self.earliest)

    def _given(self, function: Any, of: Function, varies: bool) -> Any:
        self._kept.append(function)
        return rubato.GivenField(of.name or "formula", lambda x, y, z, t: function(x, y, z, self.clock(t)), varies)

    def _is_table(self, function: Function) -> bool:
        """Whether a table of the study is the same function of time between begin and end."""
        return (isinstance(function, TableFunction) and function.parameters == ("INST",)
                and function.interpolation == ("LIN", "LIN"))

    def _table_name(self, function: Any) -> str:
        if id(function) not in self._functions:
            name = f"function_{len(self._functions) + 1}"
            self._functions[id(function)] = name
            self._kept.append(function)
            self._add_function(name, *self._extended(function))
        return self._functions[id(function)]

    def _extended(self, function: TableFunction) -> tuple[np.ndarray, np.ndarray]:
        """The table with values at begin and end where these are outside of it: raises CommandError where it is not
        extended. Beyond these instants the study keeps the last value, and nothing is asked for there."""
        places, values = list(function.places), list(function.values)
        if self.begin < places[0]:
            first = self._outside_begin(function)
            if first is not None:
                places.insert(0, self.begin)
                values.insert(0, first)
        if self.end > places[-1]:
            places.append(self.end)
            values.append(function(self.end))
        return np.array(places), np.array(values)

    def _outside_begin(self, function: TableFunction) -> float | None:
        """The initial state is not solved for: a function that has no value there counts from its first instant on."""
        try:
            return function(self.begin)
        except CommandError:
            return None


def check_parameters(function: Function) -> None:
    for parameter in function.parameters:
        if parameter not in PARAMETERS:
            raise CommandError(f"function {function.name}: expected a function of X, Y, Z and INST, found the "
                               f"parameter {parameter}.")


def evaluate(function: Function) -> Any:
    """A function of X, Y, Z and INST, in whatever order it has them, as one of x, y, z, t."""
    places = [PARAMETERS.index(name) for name in function.parameters]

    def at(x: float, y: float, z: float, t: float) -> float:
        known = (x, y, z, t)
        return float(function(*(known[place] for place in places)))

    return at


def with_cells(mesh: rubato.Mesh, kept: np.ndarray) -> tuple[rubato.Mesh, np.ndarray]:
    """A mesh with all nodes and these cells, and which cell of the first each of its cells is; groups of cells keep
    what is left of them."""
    builder = rubato.MeshBuilder(mesh.dimension)
    names = mesh.node_names or [""] * mesh.node_count
    for point, number, name in zip(np.asarray(mesh.points), np.asarray(mesh.node_numbers), names):
        builder.add_node(point, int(number), name)
    place = np.full(mesh.cell_count, -1)
    cell_of = []
    for block in mesh.blocks:
        cells = np.flatnonzero(np.isin(np.arange(block.first, block.first + len(block.nodes)), kept))
        if len(cells) == 0:
            continue
        place[block.first + cells] = len(cell_of) + np.arange(len(cells))
        cell_of.extend(block.first + cells)
        builder.add_cells(block.type, np.asarray(block.nodes)[cells])
    for name, items in mesh.cell_groups.items():
        inside = place[np.asarray(items, dtype=np.int64)]
        inside = inside[inside >= 0]
        if len(inside):
            builder.add_to_cell_group(name, inside.astype(np.int32))
    for name, items in mesh.node_groups.items():
        if len(items):
            builder.add_to_node_group(name, np.asarray(items, dtype=np.int32))
    return builder.build(), np.array(cell_of, dtype=np.int64)
