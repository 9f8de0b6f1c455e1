# SPDX-License-Identifier: LGPL-3.0-or-later
"""What commands make and other commands take: meshes, models, materials, loads, functions, results, fields, tables."""

from __future__ import annotations

import itertools
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

import numpy as np

import rubato

from .extracted import ExtractedComponent, ExtractedTable, component_at_nodes, component_in_cells
from .keys import Arguments, CommandError, nearest


class Named:
    """A concept has the name of the variable that it is assigned to, for messages and files."""

    name: str = ""


# ---- meshes --------------------------------------------------------------------------------------------------


class MeshConcept(Named):
    """A mesh (maillage). Commands with `reuse` change it in place: `mesh` is replaced by another one."""

    def __init__(self, mesh: rubato.Mesh, title: str = ""):
        self.mesh = mesh
        self.title = title
        self._nodes: dict[str, int] | None = None
        self._cells: dict[str, int] | None = None

    def replace(self, mesh: rubato.Mesh) -> None:
        self.mesh = mesh
        self._nodes = self._cells = None

    @property
    def dimension(self) -> int:
        return self.mesh.dimension

    def node_name(self, node: int) -> str:
        """Its name in the file, else N with its number."""
        names = self.mesh.node_names
        return names[node] if names else f"N{self.mesh.node_numbers[node]}"

    def cell_name(self, cell: int) -> str:
        for block in self.mesh.blocks:
            place = cell - block.first
            if 0 <= place < len(block.nodes):
                return block.names[place] if block.names else f"M{block.numbers[place]}"
        raise IndexError(cell)

    def node_named(self, name: str) -> int:
        if self._nodes is None:
            self._nodes = {self.node_name(i): i for i in range(self.mesh.node_count)}
        if name.strip() not in self._nodes:
            raise CommandError(f"there is no node {name!r} in the mesh.{nearest(name, list(self._nodes)[:5000])}")
        return self._nodes[name.strip()]

    def cell_named(self, name: str) -> int:
        if self._cells is None:
            self._cells = {self.cell_name(i): i for i in range(self.mesh.cell_count)}
        if name.strip() not in self._cells:
            raise CommandError(f"there is no cell {name!r} in the mesh.{nearest(name, list(self._cells)[:5000])}")
        return self._cells[name.strip()]

    def cells_in(self, group: str) -> np.ndarray:
        """Cells of a group of cells, in its order."""
        groups = self.mesh.cell_groups
        if group not in groups:
            raise CommandError(f"there is no group of cells {group!r} in the mesh.{nearest(group, groups)}")
        return np.asarray(groups[group], dtype=np.int64)

    def nodes_in(self, group: str) -> np.ndarray:
        """Nodes of a group of nodes, in its order."""
        groups = self.mesh.node_groups
        if group not in groups:
            raise CommandError(f"there is no group of nodes {group!r} in the mesh.{nearest(group, groups)}")
        return np.asarray(groups[group], dtype=np.int64)

    def nodes_of_cell(self, cell: int) -> np.ndarray:
        for block in self.mesh.blocks:
            place = cell - block.first
            if 0 <= place < len(block.nodes):
                return np.asarray(block.nodes[place])
        raise IndexError(cell)

    def nodes_of_cells(self, cells: Any) -> np.ndarray:
        """Ascending, without repeats."""
        cells = np.asarray(cells, dtype=np.int64)
        parts = [np.zeros(0, dtype=np.int64)]
        for block in self.mesh.blocks:
            inside = cells[(cells >= block.first) & (cells < block.first + len(block.nodes))] - block.first
            parts.append(np.asarray(block.nodes)[inside].ravel().astype(np.int64))
        return np.unique(np.concatenate(parts))

    def all_cells(self) -> np.ndarray:
        return np.arange(self.mesh.cell_count)

    def cells(self, where: Arguments, before: str = "", after: str = "") -> np.ndarray:
        """The cells that TOUT, GROUP_MA, MAILLE name, each once, in their order. Nothing given: none. `before`, `after`:
        what the keywords have around these names, SANS_ or _MAIT."""
        given = _lists(where, before, after)
        parts = [self.all_cells()] if where.get("TOUT") and not before and not after else []
        parts += [self.cells_in(group) for group in given("GROUP_MA")]
        parts.append(np.array([self.cell_named(name) for name in given("MAILLE")]))
        return _each_once(parts)

    def nodes(self, where: Arguments, before: str = "", after: str = "") -> np.ndarray:
        """The nodes that TOUT, GROUP_NO, NOEUD, and the cells of GROUP_MA and MAILLE have, likewise."""
        given = _lists(where, before, after)
        parts = [np.arange(self.mesh.node_count)] if where.get("TOUT") and not before and not after else []
        parts += [self.nodes_in(group) for group in given("GROUP_NO")]
        parts.append(np.array([self.node_named(name) for name in given("NOEUD")]))
        parts += [self.nodes_of_cells(self.cells_in(group)) for group in given("GROUP_MA")]
        parts.append(self.nodes_of_cells([self.cell_named(name) for name in given("MAILLE")]))
        return _each_once(parts)


def _lists(where: Arguments, before: str, after: str) -> Callable[[str], tuple[str, ...]]:
    return lambda name: where.get(f"{before}{name}{after}") or ()


def _each_once(parts: list[np.ndarray]) -> np.ndarray:
    whole = np.concatenate([np.asarray(part, dtype=np.int64) for part in parts] or [np.zeros(0, dtype=np.int64)])
    _, first = np.unique(whole, return_index=True)
    return whole[np.sort(first)]


# ---- functions and lists -------------------------------------------------------------------------------------


class Function(Named):
    """A function: called with the values of its parameters, in their order."""

    parameters: tuple[str, ...] = ()

    def __call__(self, *values: float) -> float:
        raise NotImplementedError


class TableFunction(Function):
    """DEFI_FONCTION: values at ascending places, with an interpolation between them. `before`, `after`: EXCLU (an
    error), CONSTANT, LINEAIRE."""

    def __init__(self, parameter: str, places: Any, values: Any, before: str = "EXCLU", after: str = "EXCLU",
                 interpolation: tuple[str, str] = ("LIN", "LIN"), result: str = "TOUTRESU"):
        self.parameters = (parameter,)
        self.places = np.asarray(places, dtype=float)
        self.values = np.asarray(values, dtype=float)
        self.before = before
        self.after = after
        self.interpolation = interpolation
        self.result = result

    # Code_Aster's Python methods
    def Valeurs(self) -> list[list[float]]:
        return [self.places.tolist(), self.values.tolist()]

    def Absc(self) -> list[float]:
        return self.places.tolist()

    def Ordo(self) -> list[float]:
        return self.values.tolist()

    def __call__(self, *values: float) -> float:
        (x,) = values
        x = float(x)
        if x < self.places[0] or x > self.places[-1]:
            return self._outside(x)
        return self._between(x)

    def _outside(self, x: float) -> float:
        first = x < self.places[0]
        way = self.before if first else self.after
        edge = self.places[0] if first else self.places[-1]
        # Instants are sums of steps: what is outside by rounding only is the edge.
        if abs(x - edge) <= 1e-9 * max(abs(edge), abs(self.places[-1] - self.places[0])):
            return float(self.values[0 if first else -1])
        if way == "CONSTANT":
            return float(self.values[0 if first else -1])
        if way == "LINEAIRE" and len(self.places) > 1:
            i, j = (0, 1) if first else (-2, -1)
            slope = (self.values[j] - self.values[i]) / (self.places[j] - self.places[i])
            return float(self.values[i] + slope * (x - self.places[i]))
        raise CommandError(f"function {self.name or 'without a name'}: {self.parameters[0]} = {x:g} is outside of "
                           f"{self.places[0]:g} to {self.places[-1]:g}, and it is not extended there.")

    def _between(self, x: float) -> float:
        i = int(np.searchsorted(self.places, x, side="right")) - 1
        if i >= len(self.places) - 1 or self.places[i] == x:
            return float(self.values[min(i, len(self.places) - 1)])
        x0, x1 = self.places[i], self.places[i + 1]
        y0, y1 = self.values[i], self.values[i + 1]
        of_place, of_value = self.interpolation
        if of_place == "LOG":
            share = np.log(x / x0) / np.log(x1 / x0)
        else:
            share = (x - x0) / (x1 - x0)
        if of_value == "LOG":
            return float(y0 * (y1 / y0) ** share)
        return float(y0 + share * (y1 - y0))


class Constant(Function):
    """DEFI_CONSTANTE."""

    def __init__(self, value: float):
        self.value = value

    def __call__(self, *values: float) -> float:
        return self.value


class Formula(Function):
    """FORMULE: a Python expression of its parameters. It sees the constants it was given and the variables of the
    files."""

    def __init__(self, parameters: tuple[str, ...], expression: str, constants: dict[str, Any],
                 variables: dict[str, Any]):
        self.parameters = parameters
        self.expression = expression
        self.constants = constants
        self.variables = variables
        self._code = compile(expression.strip().replace("\n", " "), "<FORMULE>", "eval")

    def __call__(self, *values: float) -> float:
        known = {**self.constants, **dict(zip(self.parameters, values))}
        try:
            return eval(self._code, self.variables, known)  # noqa: S307 - a command file is the user's own program
        except CommandError:
            raise
        except Exception as error:
            place = ", ".join(f"{name} = {value:g}" for name, value in zip(self.parameters, values))
            raise CommandError(f"formula {self.name or self.expression!r} at {place}: {error}") from error


class RealList(Named):
    """DEFI_LIST_REEL."""

    def __init__(self, values: Any):
        self.values = np.asarray(values, dtype=float)

    def Valeurs(self) -> list[float]:
        return self.values.tolist()


@dataclass
class Cuts:
    """What is done when a step fails: `levels` 0 means that the run ends."""

    parts: int = 4
    levels: int = 3
    shortest: float = 0.0


class TimeList(RealList):
    """DEFI_LIST_INST has instants and the rule that cuts steps between them. With `bounds_penetration` Code_Aster raises
    the penalties of contact until penetrations are small."""

    def __init__(self, values: Any, cuts: Cuts, bounds_penetration: bool = False):
        super().__init__(values)
        self.cuts = cuts
        self.bounds_penetration = bounds_penetration


# ---- models and materials ------------------------------------------------------------------------------------


@dataclass
class ModelPart:
    """Cells of a model and their kind: a MODELISATION."""

    cells: np.ndarray
    kind: str


class ModelConcept(Named):
    """AFFE_MODELE: what cells are, in the order of assignment; later parts count before earlier ones."""

    def __init__(self, mesh: MeshConcept, parts: list[ModelPart]):
        self.mesh = mesh
        self.parts = parts


class MaterialConcept(Named):
    """DEFI_MATERIAU: keywords of each law, {"ELAS": {"E": 2e11, …}}."""

    def __init__(self, laws: dict[str, Arguments]):
        self.laws = laws


class MaterialField(Named):
    """AFFE_MATERIAU: (cells, material) in the order of assignment; temperatures."""

    def __init__(self, mesh: MeshConcept, parts: list[tuple[np.ndarray, MaterialConcept]],
                 variables: list[Arguments]):
        self.mesh = mesh
        self.parts = parts
        self.variables = variables


class DiscreteField(Named):
    """AFFE_CARA_ELEM: stiffness, mass and damping of discrete elements."""

    def __init__(self, model: ModelConcept, parts: list[Arguments]):
        self.model = model
        self.parts = parts
        self.axes: list[Arguments] = []  # MASSIF: axes of orthotropic materials


class LoadConcept(Named):
    """AFFE_CHAR_MECA(_F), AFFE_CHAR_CINE(_F): what was written, checked. `formulas`: values may be functions."""

    def __init__(self, model: ModelConcept, command: str, arguments: Arguments):
        self.model = model
        self.command = command
        self.arguments = arguments


class ContactConcept(Named):
    """DEFI_CONTACT: what was written, checked."""

    def __init__(self, model: ModelConcept, arguments: Arguments):
        self.model = model
        self.arguments = arguments


# ---- fields --------------------------------------------------------------------------------------------------


@dataclass
class NodalField(Named):
    """A field at nodes: values, one row a node of the mesh, one column a component; nan where a node does not carry
    the component. Components are numbers, or functions (TYPE_CHAM NEUT_F), then `functions` has them."""

    mesh: MeshConcept
    quantity: str  # "DEPL_R"
    components: tuple[str, ...]
    values: np.ndarray
    functions: dict[str, Function] = field(default_factory=dict)

    def column(self, component: str) -> np.ndarray:
        if component not in self.components:
            raise CommandError(f"the field has no component {component}; it has {', '.join(self.components)}."
                               f"{nearest(component, self.components)}")
        return self.values[:, self.components.index(component)]

    # Code_Aster's Python methods
    def EXTR_COMP(self, comp: str = "", lgno: Any = (), topo: int = 0) -> ExtractedComponent:
        return component_at_nodes(self, comp.strip(), lgno, bool(topo))


@dataclass
class CellPart:
    """Cells with equally many places each: values of cells × places × components."""

    cells: np.ndarray
    values: np.ndarray


@dataclass
class CellField(Named):
    """A field in cells: at their nodes (ELNO), at Gauss points (ELGA), or one value each (ELEM)."""

    mesh: MeshConcept
    place: str
    quantity: str
    components: tuple[str, ...]
    parts: list[CellPart]
    functions: dict[str, Function] = field(default_factory=dict)

    # Code_Aster's Python methods
    def EXTR_COMP(self, comp: str = "", lgma: Any = (), topo: int = 0) -> ExtractedComponent:
        return component_in_cells(self, comp.strip(), lgma, bool(topo))


# ---- results -------------------------------------------------------------------------------------------------


@dataclass
class Stored:
    """A stored state of a result: its order number, its instant, and where its fields come from. `solved` is the
    model that was solved (solve.py); `state` its rubato.State; `given` has fields that CREA_RESU or LIRE_RESU gave."""

    order: int
    instant: float
    solved: Any = None
    state: Any = None
    iterations: int = 0
    given: dict[str, Any] = field(default_factory=dict)
    parameters: dict[str, float] = field(default_factory=dict)


class Result(Named):
    """A result: stored states in ascending order. Fields are computed when they are asked for (fields.py)."""

    def __init__(self, kind: str, mesh: MeshConcept, model: ModelConcept | None = None):
        self.kind = kind  # "EVOL_NOLI", "EVOL_ELAS", "MODE_MECA", "EVOL_THER"
        self.mesh = mesh
        self.model = model
        self.stored: list[Stored] = []
        self.observations: list[dict[str, Any]] = []
        self.parameters: list[dict[str, Any]] = []  # PARA_CALC, one row a step
        self.calculated: list[str] = []  # fields that CALC_CHAMP named
        self.cache: dict[tuple[str, int], Any] = {}
        self.solved_within: dict[float, list[Stored]] = {}  # states within steps, by instant

    def orders(self) -> list[int]:
        return [stored.order for stored in self.stored]

    def instants(self) -> list[float]:
        return [stored.instant for stored in self.stored]

    def of_order(self, order: int) -> Stored:
        for stored in self.stored:
            if stored.order == order:
                return stored
        raise CommandError(f"result {self.name} has no order {order}; it has {_range(self.orders())}.")

    def at(self, instant: float, precision: float = 1e-6, criterion: str = "RELATIF") -> Stored:
        """The state stored at an instant."""
        allowed = precision * abs(instant) if criterion == "RELATIF" else precision
        if instant == 0 and criterion == "RELATIF":
            allowed = precision
        close = [stored for stored in self.stored if abs(stored.instant - instant) <= allowed]
        close = close or self._between(instant)
        if len(close) != 1:
            found = "no state" if not close else f"{len(close)} states"
            raise CommandError(f"result {self.name} has {found} at instant {instant:g}; it has "
                               f"{_range(self.instants())}.")
        return close[0]

    def _between(self, instant: float) -> list[Stored]:
        """Returns the state at an instant within a step if steps may be cut. It is solved from the state before and not
        stored, so that orders stay."""
        for before, after in itertools.pairwise(self.stored):
            if before.instant < instant < after.instant and after.solved is not None and after.solved.within is not None:
                if instant not in self.solved_within:
                    self.solved_within[instant] = after.solved.within(before, after, instant)
                return self.solved_within[instant]
        return []

    # Code_Aster's Python methods
    def LIST_VARI_ACCES(self) -> dict[str, list[Any]]:
        return {"NUME_ORDRE": self.orders(), "INST": self.instants()}


def _range(values: list[Any]) -> str:
    if len(values) <= 12:
        return ", ".join(f"{value:g}" for value in values) or "none"
    return f"{len(values)} of them, from {values[0]:g} to {values[-1]:g}"


# ---- tables --------------------------------------------------------------------------------------------------


class TableConcept(Named):
    """A table: columns in order, rows as dicts; a row lacks the columns in which it has nothing."""

    def __init__(self, columns: list[str], rows: list[dict[str, Any]], title: str = ""):
        self.columns = columns
        self.rows = rows
        self.title = title

    def __getitem__(self, place: tuple[str, int]) -> Any:
        """Code_Aster's tab['COLUMN', row], rows from 1."""
        column, row = place
        if column not in self.columns:
            raise KeyError(f"the table has no column {column!r}; it has {', '.join(self.columns)}")
        if not 1 <= row <= len(self.rows) or column not in self.rows[row - 1]:
            raise KeyError(f"the table has nothing in column {column!r}, row {row}")
        return self.rows[row - 1][column]

    def EXTR_TABLE(self) -> ExtractedTable:
        return ExtractedTable(self)
