# SPDX-License-Identifier: LGPL-3.0-or-later
"""IMPR_RESU FORMAT='GMSH' writes a text file of version 2.2 with the mesh and a view for each field and instant."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from ..concepts import CellField, MeshConcept, NodalField, Stored
from ..frames import tensor_of
from ..keys import CommandError
from ..mesh.cells import KINDS, block_of, dimensions, word_of
from ..mesh.gmsh import TYPES

# Numbers that Gmsh stores per node, and the most components that TYPE_CHAM takes.
WIDTHS = {"SCALAIRE": (1, 1), "VECT_2D": (3, 2), "VECT_3D": (3, 3), "TENS_2D": (9, 4), "TENS_3D": (9, 6)}
OURS = {name: (number, order) for number, (name, order) in TYPES.items()}
# Types that are written without their last nodes.
FURTHER = {"hexa27": ("hexa20", 20), "penta18": ("penta15", 15), "tria7": ("tria6", 6), "pyra13": ("pyra5", 5)}


def written_as(kind: str) -> tuple[int, list[int]]:
    """Returns Gmsh's number of a cell type, and the place of each of Gmsh's nodes in the cell."""
    kept, count = FURTHER.get(kind, (kind, KINDS[kind].nodes))
    code, order = OURS[kept]
    return code, [int(i) for i in np.argsort(order)] if order else list(range(count))


def mesh_lines(mesh: MeshConcept) -> Iterator[str]:
    """Yields the mesh. Nodes and cells are numbered from 1 by their place; a cell has the number of its first group."""
    yield from ("$MeshFormat", "2.2 0 8", "$EndMeshFormat")
    groups = list(mesh.mesh.cell_groups)
    of_cell = np.zeros(mesh.mesh.cell_count, dtype=int)
    for number, name in reversed(list(enumerate(groups, 1))):
        of_cell[np.asarray(mesh.mesh.cell_groups[name], dtype=int)] = number
    dimensions = {name: _dimension_of(mesh, name) for name in groups}
    yield from ("$PhysicalNames", str(len(groups)))
    yield from (f'{dimensions[name]} {number} "{name}"' for number, name in enumerate(groups, 1))
    yield from ("$EndPhysicalNames", "$Nodes", str(mesh.mesh.node_count))
    for number, point in enumerate(np.asarray(mesh.mesh.points), 1):
        yield f"{number} {point[0]:.16g} {point[1]:.16g} {point[2]:.16g}"
    yield from ("$EndNodes", "$Elements", str(mesh.mesh.cell_count))
    for block in mesh.mesh.blocks:
        code, order = written_as(word_of(block))
        for place, row in enumerate((np.asarray(block.nodes)[:, order] + 1).tolist(), block.first):
            yield f"{place + 1} {code} 2 {of_cell[place]} {of_cell[place]} {' '.join(map(str, row))}"
    yield "$EndElements"


def _dimension_of(mesh: MeshConcept, group: str) -> int:
    cells = np.asarray(mesh.mesh.cell_groups[group], dtype=int)
    return int(dimensions(mesh.mesh)[cells].max()) if len(cells) else 0


def view_lines(label: str, stored: Stored | None, field: NodalField | CellField, components: list[str],
               kind: str) -> Iterator[str]:
    """Yields a view for each component (SCALAIRE), or one view of the vector or tensor."""
    width, taken = WIDTHS[kind]
    if kind != "SCALAIRE" and len(components) > (3 if kind.startswith("VECT") else 6):
        raise CommandError(f"IMPR_RESU/RESU/TYPE_CHAM: {kind} takes {taken} components, found {len(components)}.")
    for name in components if kind == "SCALAIRE" else [""]:
        chosen = [name] if name else components
        yield from _view(f"{label} {name}".strip(), stored, field, chosen, width)


def _view(label: str, stored: Stored | None, field: NodalField | CellField, components: list[str],
          width: int) -> Iterator[str]:
    columns = [field.components.index(name) for name in components]
    at_nodes = isinstance(field, NodalField)
    word = "NodeData" if at_nodes else "ElementNodeData" if field.place == "ELNO" else "ElementData"
    rows = list(_node_rows(field, columns, components, width) if at_nodes else
                _cell_rows(field, columns, components, width))
    order, instant = (stored.order, stored.instant) if stored else (0, 0.0)
    yield from (f"${word}", "1", f'"{label}"', "1", f"{instant:.16g}", "3", str(order), str(width), str(len(rows)))
    yield from rows
    yield f"$End{word}"


def _numbers(values: np.ndarray, components: list[str], width: int) -> np.ndarray:
    """Returns rows × width: zeros fill vectors up, tensors have all nine numbers."""
    values = np.nan_to_num(values)
    if width == 9:
        letters = components[0][:-2]
        return tensor_of(tuple(components), values, letters).reshape(-1, 9)
    made = np.zeros((len(values), width))
    made[:, :values.shape[1]] = values
    return made


def _shown(row: np.ndarray) -> str:
    return " ".join(f"{value:.9g}" for value in row)


def _node_rows(field: NodalField, columns: list[int], components: list[str], width: int) -> Iterator[str]:
    there = np.flatnonzero(~np.all(np.isnan(field.values[:, columns]), axis=1))
    for node, row in zip(there, _numbers(field.values[np.ix_(there, columns)], components, width)):
        yield f"{node + 1} {_shown(row)}"


def _cell_rows(field: CellField, columns: list[int], components: list[str], width: int) -> Iterator[str]:
    """Yields values at the nodes of cells, or the mean over the Gauss points of each cell."""
    for part in field.parts:
        if field.place != "ELNO":
            for cell, row in zip(part.cells, _numbers(part.values[..., columns].mean(axis=1), components, width)):
                yield f"{cell + 1} {_shown(row)}"
            continue
        for cell, values in zip(part.cells, part.values[..., columns]):
            order = written_as(word_of(block_of(field.mesh.mesh, int(cell))[0]))[1]
            numbers = _numbers(values[order], components, width)
            yield f"{cell + 1} {len(numbers)} {' '.join(map(_shown, numbers))}"
