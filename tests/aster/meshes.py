# SPDX-License-Identifier: LGPL-3.0-or-later
"""Meshes of the studies in this folder, made anew for every test: MESHES has what makes them, by file name."""

from __future__ import annotations

import itertools
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import numpy as np

import rubato

# Sides and corners of the bodies of a stack: the lower one, the upper one.
LOWER = {"bottom": "BASE", "top": "MASTER", "left": "LEFT", "right": "RIGHT"}
UPPER = {"bottom": "SLAVE", "top": "TOP", "left": "LEFT", "right": "RIGHT"}
DEPTH = {"back": "BACK", "front": "FRONT"}


def rectangle(name: str, start: Sequence[float], end: Sequence[float], divisions: Sequence[int], cells: str = "quad4",
              **more: Any) -> rubato.Body:
    return rubato.Body(name=name, dimension=2, from_=(*start, 0.0), to=(*end, 0.0), divisions=(*divisions, 1),
                       cells=cells, **more)


def box(name: str, start: Sequence[float], end: Sequence[float], divisions: Sequence[int], cells: str = "hexa8",
        **more: Any) -> rubato.Body:
    return rubato.Body(name=name, dimension=3, from_=tuple(start), to=tuple(end), divisions=tuple(divisions),
                       cells=cells, **more)


def one_rectangle(end: Sequence[float], divisions: Sequence[int], cells: str = "quad4",
                  start: Sequence[float] = (0.0, 0.0)) -> rubato.Mesh:
    """One body BODY with all sides and corners named."""
    sides = {"left": "LEFT", "right": "RIGHT", "bottom": "BOTTOM", "top": "TOP"}
    points = {"left_bottom": "LB", "right_bottom": "RB", "left_top": "LT", "right_top": "RT"}
    return rubato.generate([rectangle("BODY", start, end, divisions, cells, sides=sides, points=points)])


def one_box(end: Sequence[float], divisions: Sequence[int], cells: str = "hexa8") -> rubato.Mesh:
    sides = {"left": "LEFT", "right": "RIGHT", "bottom": "BOTTOM", "top": "TOP", **DEPTH}
    points = {"left_bottom_back": "ORIGIN", "right_top_front": "FAR"}
    return rubato.generate([box("BODY", (0, 0, 0), end, divisions, cells, sides=sides, points=points,
                                edges={"right_top": "EDGE"})])


def stack(below: Sequence[int], above: Sequence[int], cells: str = "quad4", cells_above: str = "",
          width: float = 2.0, gap: float = 0.0) -> rubato.Mesh:
    """Two rectangles of height 1 on one another; the lower surface of the upper one is the slave."""
    lower = rectangle("LOWER", (0, 0), (width, 1), below, cells, sides=LOWER, points={"left_top": "ML"})
    upper = rectangle("UPPER", (0, 1 + gap), (width, 2 + gap), above, cells_above or cells, sides=UPPER,
                      points={"left_top": "TL", "right_top": "TR", "left_bottom": "SL", "right_bottom": "SR"})
    return rubato.generate([lower, upper])


def two_rings() -> rubato.Mesh:
    """Two rings of one cell each, radius 1 to 3, on one another, in an axial section."""
    return rubato.generate([
        rectangle("LOWER", (1, 0), (3, 1), (1, 1), sides=LOWER),
        rectangle("UPPER", (1, 1), (3, 2), (1, 1), sides=UPPER, points={"left_bottom": "SL", "right_bottom": "SR"})])


def boxes(below: Sequence[int], above: Sequence[int], cells: str = "hexa8", cells_above: str = "") -> rubato.Mesh:
    """The same in space, of unit cubes."""
    lower = box("LOWER", (0, 0, 0), (1, 1, 1), below, cells, sides={**LOWER, **DEPTH})
    upper = box("UPPER", (0, 1, 0), (1, 2, 1), above, cells_above or cells, sides={**UPPER, **DEPTH},
                points={"left_top_back": "TL"})
    return rubato.generate([lower, upper])


def cubes_with_edges() -> rubato.Mesh:
    """Two cubes of one cell on one another; two lower edges of the upper one are lines."""
    lower = box("LOWER", (0, 0, 0), (1, 1, 1), (1, 1, 1), sides={**LOWER, **DEPTH})
    upper = box("UPPER", (0, 1, 0), (1, 2, 1), (1, 1, 1), sides={**UPPER, **DEPTH}, points={"left_top_back": "TL"},
                edges={"left_bottom": "EDGES", "right_bottom": "EDGES"})
    return rubato.generate([lower, upper])


def sliding_block() -> rubato.Mesh:
    """A block on a wider one."""
    return rubato.generate([
        rectangle("LOWER", (-1, 0), (3, 1), (5, 1), sides=LOWER),
        rectangle("UPPER", (0, 1), (2, 2), (4, 1), sides={**UPPER, "left": "SIDE_L", "right": "SIDE_R"},
                  points={"left_bottom": "SL", "right_bottom": "SR", "left_top": "TL"})])


def sliding_cube(cells: str, above: str = "") -> rubato.Mesh:
    """The same in space."""
    sides = {"left": "SIDE_L", "right": "SIDE_R", "back": "SIDE_B", "front": "SIDE_F", "bottom": "SLAVE", "top": "TOP"}
    return rubato.generate([box("LOWER", (-0.5, 0, -0.5), (1.5, 1, 1.5), (3, 1, 3), cells, sides={"top": "MASTER"}),
                            box("UPPER", (0, 1, 0), (1, 2, 1), (2, 1, 2), above or cells, sides=sides)])


def three_layers() -> rubato.Mesh:
    """Three rectangles on one another, two contact zones, meshes that do not match."""
    middle = {"bottom": "SLAVE1", "top": "MASTER2", "left": "LEFT"}
    return rubato.generate([
        rectangle("LOWER", (0, 0), (2, 1), (3, 1), sides={"bottom": "BASE", "top": "MASTER1", "left": "LEFT"}),
        rectangle("MIDDLE", (0, 1), (2, 2), (2, 2), sides=middle),
        rectangle("UPPER", (0, 2), (2, 3), (2, 1), sides={"bottom": "SLAVE2", "top": "TOP", "left": "LEFT"},
                  points={"left_top": "TL"})])


def block_on_sheet() -> rubato.Mesh:
    """A block above a line that no body has behind it."""
    block = one_rectangle((1, 1), (2, 2))
    builder = copied(block)
    ends = builder.add_nodes(np.array([[-1.0, -0.1, 0.0], [0.5, -0.1, 0.0], [2.0, -0.1, 0.0]]))
    for first, second in itertools.pairwise(ends):
        builder.add_to_cell_group("SHEET", [builder.add_cell("seg2", [int(second), int(first)])])
    return builder.build()


def block_on_edge() -> rubato.Mesh:
    """A block on a line that is flat up to x = 0.6 and then falls."""
    builder = copied(one_rectangle((0.5, 1), (1, 1)))
    ends = builder.add_nodes(np.array([[-1.0, 0.0, 0.0], [0.6, 0.0, 0.0], [2.0, -0.5, 0.0]]))
    for first, second in itertools.pairwise(ends):
        builder.add_to_cell_group("SHEET", [builder.add_cell("seg2", [int(second), int(first)])])
    return builder.build()


def cube_on_sheet() -> rubato.Mesh:
    """A unit cube on a square of two by two faces that no body has behind it."""
    builder = copied(one_box((1, 1, 1), (2, 2, 2)))
    side = (-2.0, 0.5, 3.0)
    nodes = builder.add_nodes(np.array([[x, 0.0, z] for z in side for x in side]))
    for row, column in itertools.product((0, 1), (0, 1)):
        first = 3 * row + column
        corners = [int(nodes[first + shift]) for shift in (0, 3, 4, 1)]
        builder.add_to_cell_group("SHEET", [builder.add_cell("quad4", corners)])
    return builder.build()


def ring_on_sheet() -> rubato.Mesh:
    """A ring of square section, radius 1 to 2, above a disc that no body has behind it, in an axial section."""
    builder = copied(one_rectangle((2, 1), (2, 2), start=(1, 0)))
    ends = builder.add_nodes(np.array([[0.5, 0.0, 0.0], [3.0, 0.0, 0.0]]))
    builder.add_to_cell_group("SHEET", [builder.add_cell("seg2", [int(ends[1]), int(ends[0])])])
    return builder.build()


def copied(mesh: rubato.Mesh) -> Any:
    """A builder that has the nodes, cells and groups of a mesh."""
    builder = rubato.MeshBuilder(mesh.dimension)
    builder.add_nodes(np.asarray(mesh.points))
    for block in mesh.blocks:
        builder.add_cells(block.type, np.asarray(block.nodes))
    for name, cells in mesh.cell_groups.items():
        builder.add_to_cell_group(name, cells)
    for name, nodes in mesh.node_groups.items():
        builder.add_to_node_group(name, nodes)
    return builder


def with_springs(mesh: rubato.Mesh, springs: Sequence[tuple[str, Any, Any]]) -> rubato.Mesh:
    """Two-node cells in groups. Their ends: the place of a node that is there, or of a new one."""
    builder = copied(mesh)
    places = [tuple(point) for point in np.round(np.asarray(mesh.points), 9)]
    for group, first, second in springs:
        ends = []
        for place in (first, second):
            place = (*map(float, place), 0.0, 0.0)[:3]
            if place not in places:
                builder.add_nodes(np.array([place]))
                places.append(place)
                builder.add_to_node_group(f"END_{group}", [len(places) - 1])
            ends.append(places.index(place))
        builder.add_to_cell_group(group, [builder.add_cell("seg2", ends)])
    return builder.build()


def two_bars_and_springs() -> rubato.Mesh:
    """Two unit squares a unit apart, with springs to the ground, between them and to a place."""
    points = {"left_bottom": "A", "right_bottom": "B"}
    sides = {"left": "AL", "right": "AR"}
    bars = rubato.generate([
        rectangle("ONE", (0, 0), (1, 1), (1, 1), sides=sides, points=points),
        rectangle("TWO", (2, 0), (3, 1), (1, 1), sides={"left": "BL", "right": "BR"}, points={"left_bottom": "C"})])
    return with_springs(bars, [("GROUND", (0, 0), (-1, 0)), ("GROUND", (0, 1), (-1, 1)), ("BETWEEN", (1, 0), (2, 0)),
                               ("BETWEEN", (1, 1), (2, 1)), ("PULLED", (3, 0), (4, 0)), ("PULLED", (3, 1), (4, 1))])


def cube_with_legs() -> rubato.Mesh:
    """A unit cube on four oblique springs."""
    cube = one_box((1, 1, 1), (1, 1, 1))
    legs = [("LEGS", (x, 0, z), (x + 3, -4, z)) for x in (0, 1) for z in (0, 1)]
    return with_springs(cube, legs)


def pyramids(cells: str) -> rubato.Mesh:
    """A block of 2 × 1 × 1 cubes, each of six pyramids with the tip in its centre; an outer face group for each
    side."""
    grid = {place: number for number, place in enumerate(itertools.product((0, 1, 2), (0, 1), (0, 1)))}
    builder = rubato.MeshBuilder(3)
    builder.add_nodes(np.array(list(grid), dtype=float))
    faces = (((0, 0, 0), (0, 0, 1), (0, 1, 1), (0, 1, 0)), ((1, 0, 0), (1, 1, 0), (1, 1, 1), (1, 0, 1)),
             ((0, 0, 0), (1, 0, 0), (1, 0, 1), (0, 0, 1)), ((0, 1, 0), (0, 1, 1), (1, 1, 1), (1, 1, 0)),
             ((0, 0, 0), (0, 1, 0), (1, 1, 0), (1, 0, 0)), ((0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)))
    for x in (0, 1):
        tip = int(builder.add_node(np.array([x + 0.5, 0.5, 0.5])))
        for face in faces:
            nodes = [grid[place[0] + x, place[1], place[2]] for place in face]
            # Seen from the tip the base turns to the left.
            builder.add_to_cell_group("BODY", [builder.add_cell("pyra5", [*nodes[::-1], tip])])
            for name, axis, value in (("LEFT", 0, 0), ("RIGHT", 0, 2), ("BOTTOM", 1, 0), ("TOP", 1, 1), ("BACK", 2, 0),
                                      ("FRONT", 2, 1)):
                if all((place[0] + x, place[1], place[2])[axis] == value for place in face):
                    builder.add_to_cell_group(name, [builder.add_cell("quad4", nodes)])
    mesh = builder.build().mended()
    return mesh if cells == "pyra5" else mesh.converted("quadratic")


def tubes() -> rubato.Mesh:
    """Two tubes in an axial section, radius 1 to 2 and 2 to 3, height 0.1; the inner one's outside is the slave."""
    ends = {"bottom": "LOW", "top": "HIGH"}
    return rubato.generate([
        rectangle("INNER", (1, 0), (2, 0.1), (8, 1), "quad8", sides={**ends, "left": "BORE", "right": "SLAVE"},
                  points={"left_bottom": "A", "right_bottom": "B"}),
        rectangle("OUTER", (2, 0), (3, 0.1), (8, 1), "quad8", sides={**ends, "left": "MASTER", "right": "RIM"},
                  points={"left_bottom": "C", "right_bottom": "D"})])


def tied_bars() -> rubato.Mesh:
    """Two bars that share a plane, with meshes that do not match there."""
    return rubato.generate([
        rectangle("ONE", (0, 0), (1, 1), (1, 1), sides={"left": "LEFT", "right": "MEET1", "bottom": "BOTTOM"}),
        rectangle("TWO", (1, 0), (2, 1), (1, 2), sides={"left": "MEET2", "right": "RIGHT", "bottom": "BOTTOM"},
                  points={"right_top": "RT"})])


SOLIDS = ("hexa8", "hexa20", "hexa27", "tetra4", "tetra10", "penta6", "penta15")
FACES = ("hexa8", "hexa20", "hexa27", "tetra10", "penta6", "penta15")
PRESSED = ("hexa8", "hexa20", "hexa27", "tetra4", "tetra10")
# Studies of one square cell.
UNIT_SQUARES = ("one", "watched", "relations", "oscillator", "damping", "explicit", "errors", "excit")
PLANES = ("quad4", "quad8", "quad9", "tria3", "tria6")

MESHES: dict[str, Callable[[], rubato.Mesh]] = {
    "press.med": lambda: stack((4, 2), (4, 2)),
    "quadratic.med": lambda: stack((2, 1), (2, 1), "quad8"),
    "friction.med": sliding_block,
    "restart.med": sliding_block,
    "mortar.med": lambda: stack((3, 1), (4, 1), "quad4", "tria3"),
    "mortar3d.med": lambda: boxes((2, 1, 2), (3, 1, 3)),
    "mixed3d.med": lambda: boxes((2, 1, 2), (2, 1, 2), "hexa8", "tetra4"),
    "gaps.med": lambda: stack((2, 1), (2, 1), gap=0.01),
    "sheet.med": block_on_sheet,
    "cube_on_sheet.med": cube_on_sheet,
    "ring_on_sheet.med": ring_on_sheet,
    "layers.med": three_layers,
    "slide.med": lambda: stack((2, 1), (2, 1)),
    "onesided.med": lambda: one_rectangle((2, 1), (4, 2)),
    "thermal.med": lambda: one_rectangle((2, 1), (4, 2), "quad8"),
    "fields.med": lambda: one_rectangle((2, 1), (4, 2), "quad8"),
    "square.med": lambda: one_rectangle((2, 1), (4, 2), "quad8"),
    **{f"{name}.med": lambda: one_rectangle((1, 1), (1, 1)) for name in UNIT_SQUARES},
    "bar.med": lambda: one_rectangle((4, 1), (8, 1), "quad8"),
    "springs.med": two_bars_and_springs,
    "legs.med": cube_with_legs,
    "tied.med": tied_bars,
    "choices.med": lambda: stack((1, 1), (1, 1)),
    "stops.med": lambda: one_rectangle((2, 1), (4, 2)),
    "cook.med": lambda: one_box((1, 1, 1), (1, 1, 1)),
    "opposite.med": lambda: stack((5, 1), (3, 1)),
    "ring.med": two_rings,
    "edges.med": cubes_with_edges,
    "column.med": lambda: boxes((2, 1, 2), (2, 1, 2)),
    "views.med": lambda: one_box((1, 1, 1), (2, 1, 1), "hexa20"),
    "turning.med": lambda: one_box((1, 1, 1), (2, 2, 2)),
    "refined.med": lambda: stack((1, 1), (1, 1)),
    "form15.med": lambda: one_box((1, 1, 1), (2, 2, 2)),
    **{f"{kind}.med": lambda kind=kind: sliding_cube(kind) for kind in FACES},
    "settle.med": lambda: stack((2, 1), (2, 1), gap=0.01),
    **{f"press_{kind}.med": lambda kind=kind: boxes((2, 1, 2), (2, 1, 2), kind) for kind in PRESSED},
    "frozen.med": block_on_edge,
    "failing.med": lambda: stack((4, 1), (4, 1)),
    "excluded.med": lambda: stack((4, 1), (4, 1)),
    "cube.med": lambda: one_box((1, 1, 1), (2, 2, 2)),
    "yielding.med": lambda: one_box((1, 1, 1), (2, 2, 2)),
    "tubes.med": tubes,
    "pyramids5.med": lambda: pyramids("pyra5"),
    "pyramids13.med": lambda: pyramids("pyra13"),
    **{f"patch_{kind}.med": lambda kind=kind: one_box((2, 1, 1), (2, 2, 1), kind) for kind in SOLIDS},
    **{f"patch_{kind}.med": lambda kind=kind: one_rectangle((2, 1), (3, 2), kind) for kind in PLANES},
}


def write(folder: Path, names: Sequence[str]) -> None:
    """Writes the named files."""
    for name in names:
        rubato.write_mesh(folder / name, MESHES[name]())
