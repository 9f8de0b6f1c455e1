# SPDX-License-Identifier: LGPL-3.0-or-later
"""POST_ELEM: norms, integrals, energies, masses over groups of cells."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any

import numpy as np

from ..concepts import CellField, MaterialField, MeshConcept, ModelConcept, NodalField, Result, Stored, TableConcept
from ..fields import cell_values, field_of, model_cells
from ..keys import (Arguments, Command, CommandError, Key, concept, factor, harmless, reals, text, texts, words, yes_no)
from ..mesh_parts import blocks_with, nodes_of_part, points_of
from ..selection import CELLS, STATES, chosen_states
from ..shapes import DIMENSIONS, gauss_points, mass_points, measures, shape_values
from ..tables import Row
from .post_releve import access, add_rows

WHERE = {**CELLS}
FIELD: dict[str, Key] = {"RESULTAT": concept("Result"), "CHAM_GD": concept("NodalField", "CellField"),
                         "NOM_CHAM": text(), "MODELE": concept("ModelConcept")}
KEYS: dict[str, Key] = {
    "NORME": factor({**WHERE, **STATES, **FIELD, "TYPE_NORM": words("L2", "FROBENIUS", default="L2"),
                     "TYPE_MAILLE": words("2D", "3D"), "COEF_MULT": reals()}, most=1),
    "INTEGRALE": factor({**WHERE, "NOM_CHAM": text(), "NOM_CMP": texts(required=True), "DEJA_INTEGRE": yes_no("NON"),
                         "TYPE_MAILLE": words("1D", "2D", "3D")}),
    "ENER_POT": factor(WHERE), "ENER_ELAS": factor(WHERE),
    "ENER_CIN": factor({**WHERE, "OPTION": words("MASS_MECA", default="MASS_MECA", missing={"MASS_MECA_DIAG": ""})}),
    "MASS_INER": factor({**WHERE, "ORIG_INER": reals()}),
    "RESULTAT": concept("Result"), "CHAM_GD": concept("NodalField", "CellField"), "MODELE": concept("ModelConcept"),
    "CHAM_MATER": concept("MaterialField"), "CARA_ELEM": concept("DiscreteField"), **STATES,
    "GEOMETRIE": words("INITIALE", default="INITIALE", missing={"DEFORMEE": ""}), "CHARGE": harmless(),
    "INFO": harmless(), "TITRE": texts(),
}


def post_elem(session: Any, arguments: Arguments) -> TableConcept:
    given = [name for name in OPTIONS if arguments.get(name)]
    if len(given) != 1:
        raise CommandError(f"POST_ELEM: one of {', '.join(OPTIONS)} is needed.")
    table = TableConcept([], [], " ".join(arguments.TITRE))
    for one in arguments.get(given[0]):
        add_rows(table, list(OPTIONS[given[0]](arguments, one)))
    return table


# ---- over cells --------------------------------------------------------------------------------------------------


def is_ring(model: ModelConcept | None) -> bool:
    """Whether the model is axisymmetric: integrals are per radian, the radius is x."""
    return model is not None and any(part.kind.startswith("AXIS") for part in model.parts)


def regions(mesh: MeshConcept, where: Arguments, model: ModelConcept | None) -> Iterator[tuple[str, np.ndarray]]:
    """A name and its cells: all (the model's), each group, each cell."""
    if where.TOUT:
        parts = [part.cells for part in model.parts] if model else [mesh.all_cells()]
        yield "TOUT", np.unique(np.concatenate(parts))
    for group in where.GROUP_MA:
        yield group, np.asarray(mesh.cells_in(group))
    for cell in where.MAILLE:
        yield cell, np.array([mesh.cell_named(cell)])


def highest(mesh: MeshConcept, cells: np.ndarray, dimension: int | None = None) -> list[tuple[str, np.ndarray]]:
    """The cells of a dimension by type; of the highest one that they have unless it is given."""
    blocks = blocks_with(mesh, cells)
    if dimension is None:
        dimension = max((DIMENSIONS[kind] for kind, _ in blocks), default=0)
    return [(kind, inside) for kind, inside in blocks if DIMENSIONS[kind] == dimension]


def places_and_weights(mesh: MeshConcept, kind: str, cells: np.ndarray, rule: tuple[np.ndarray, np.ndarray],
                       ring: bool) -> tuple[np.ndarray, np.ndarray]:
    """Places of the points (cells × points × 3), and what each stands for; per radian with a ring."""
    corners = points_of(mesh)[nodes_of_part(mesh, cells)]
    weights = measures(kind, corners, *rule)
    places = np.einsum("pn,cnx->cpx", shape_values(kind, rule[0]), corners)
    return places, weights * places[..., 0] if ring else weights


def values_at_points(field: NodalField | CellField, kind: str, cells: np.ndarray,
                     rule: tuple[np.ndarray, np.ndarray]) -> np.ndarray:
    """Cells × points × components."""
    if isinstance(field, NodalField):
        return np.einsum("pn,cnk->cpk", shape_values(kind, rule[0]), field.values[nodes_of_part(field.mesh, cells)])
    whole = np.full((len(cells), len(rule[1]), len(field.components)), np.nan)
    for part in field.parts:
        _, here, there = np.intersect1d(cells, part.cells, return_indices=True)
        if not len(here):
            continue
        values = part.values[there]
        if field.place == "ELNO":
            values = np.einsum("pn,cnk->cpk", shape_values(kind, rule[0]), values)
        elif field.place == "ELGA" and values.shape[1] != len(rule[1]):
            raise CommandError(f"POST_ELEM: the field has {values.shape[1]} points in {kind} cells, {len(rule[1])} are "
                               "known.")
        whole[here] = values
    return whole


# ---- NORME, INTEGRALE --------------------------------------------------------------------------------------------


def fields(arguments: Arguments, name: str | None, states: Arguments) -> Iterator[tuple[NodalField | CellField, Row]]:
    if arguments.CHAM_GD is not None:
        yield arguments.CHAM_GD, {"CHAM_GD": arguments.CHAM_GD.name}
        return
    if arguments.RESULTAT is None or name is None:
        raise CommandError("POST_ELEM: CHAM_GD, or RESULTAT and NOM_CHAM are needed.")
    for stored in chosen_states(arguments.RESULTAT, states):
        yield field_of(arguments.RESULTAT, stored, name), {
            "RESULTAT": arguments.RESULTAT.name, "NOM_CHAM": name, **access(stored)}


def norm(arguments: Arguments, one: Arguments) -> Iterator[Row]:
    """√∫ Σ f² over the cells; of tensors off-diagonal components count twice."""
    model = one.MODELE or (one.RESULTAT.model if one.RESULTAT else None)
    for field, head in fields(one, one.NOM_CHAM, one):
        factors = _norm_factors(field, one)
        for name, cells in regions(field.mesh, one, model):
            total = 0.0
            for kind, inside in highest(field.mesh, cells, {"2D": 2, "3D": 3}.get(one.TYPE_MAILLE or "")):
                rule = gauss_points(kind)
                values = np.nan_to_num(values_at_points(field, kind, inside, rule))
                _, weights = places_and_weights(field.mesh, kind, inside, rule, is_ring(model))
                total += float(np.einsum("cpk,k,cp->", values**2, factors, weights))
            yield {**head, "GROUP_MA": name, "TYPE_MAIL": one.TYPE_MAILLE or f"{field.mesh.dimension}D",
                   "TYPE_NORM": one.TYPE_NORM, "VALE_NORM": total**0.5}


def _norm_factors(field: NodalField | CellField, one: Arguments) -> np.ndarray:
    if one.COEF_MULT:
        if len(one.COEF_MULT) < len(field.components):
            raise CommandError("POST_ELEM/NORME/COEF_MULT: expected a number for each component.")
        return np.array(one.COEF_MULT[:len(field.components)])
    return np.array([2.0 if name[:2] in ("SI", "EP") and name[2:] in ("XY", "XZ", "YZ") else 1.0
                     for name in field.components])


def integral(arguments: Arguments, one: Arguments) -> Iterator[Row]:
    """∫ f and its mean over the cells, per radian with a ring."""
    if one.DEJA_INTEGRE == "OUI":
        raise CommandError("POST_ELEM/INTEGRALE/DEJA_INTEGRE: OUI is not available.")
    model = arguments.MODELE or (arguments.RESULTAT.model if arguments.RESULTAT else None)
    for field, head in fields(arguments, one.NOM_CHAM, arguments):
        for name, cells in regions(field.mesh, one, model):
            volume, sums = 0.0, np.zeros(len(one.NOM_CMP))
            for kind, inside in highest(field.mesh, cells, {"1D": 1, "2D": 2, "3D": 3}.get(one.TYPE_MAILLE or "")):
                rule = gauss_points(kind)
                values = values_at_points(field, kind, inside, rule)[..., [
                    field.components.index(component) for component in one.NOM_CMP]]
                _, weights = places_and_weights(field.mesh, kind, inside, rule, is_ring(model))
                volume += float(np.sum(weights))
                sums += np.einsum("cpk,cp->k", np.nan_to_num(values), weights)
            if volume == 0:
                raise CommandError(f"POST_ELEM/INTEGRALE: {name} has no cells of {one.TYPE_MAILLE}.")
            row = {**head, "GROUP_MA": name, "VOL": volume}
            row.update({f"INTE_{component}": float(value) for component, value in zip(one.NOM_CMP, sums)})
            row.update({f"MOYE_{component}": float(value / volume) for component, value in zip(one.NOM_CMP, sums)})
            yield row


# ---- energies ----------------------------------------------------------------------------------------------------


def _energies(of_cells: Callable[[Result, Stored, np.ndarray], float]) -> Callable[..., Iterator[Row]]:
    def rows(arguments: Arguments, one: Arguments) -> Iterator[Row]:
        result = arguments.RESULTAT
        if result is None:
            raise CommandError("POST_ELEM: energies need RESULTAT.")
        for stored in chosen_states(result, arguments):
            if stored.solved is None:
                raise CommandError(f"POST_ELEM: result {result.name} has no solved states.")
            whole = of_cells(result, stored, np.arange(stored.solved.mesh.mesh.cell_count))
            for name, cells in regions(stored.solved.mesh, one, None):
                value = of_cells(result, stored, cells)
                yield {**access(stored), "LIEU": stored.solved.mesh.name if name == "TOUT" else name,
                       "ENTITE": "TOUT" if name == "TOUT" else "GROUP_MA" if name in one.GROUP_MA else "MAILLE",
                       "TOTALE": value, "POUR_CENT_TOTAL": 100 * value / whole if whole else 0.0}

    return rows


def strain_energy(result: Result, stored: Stored, cells: np.ndarray) -> float:
    """½∫ σ:ε of the cells, in axisymmetric models per radian."""
    model = stored.solved.model
    if stored.solved.materials.variables:
        raise CommandError("POST_ELEM/ENER_ELAS: energies with temperatures are not available.")
    volumes = model.cell_field(stored.state, "stress_elga").volumes
    stress, strain = cell_values(stored, "stress_elga"), cell_values(stored, "strain_elga")
    # Shears count twice in a tensor product.
    factors = np.array([1, 1, 1, 2, 2, 2])
    total = 0.0
    for (mine, s), (_, e), (kind, _) in zip(stress, strain, model_cells(stored, volumes)):
        inside = np.isin(mine, cells)
        total += 0.5 * float(np.einsum("cpk,cpk,k,cp->", s[inside], e[inside], factors,
                                       np.asarray(volumes[kind])[inside]))
    return total / stored.solved.ring


def kinetic_energy(result: Result, stored: Stored, cells: np.ndarray) -> float:
    """½∫ ρ v² of the cells, in axisymmetric models per radian."""
    mesh = stored.solved.mesh
    velocity = stored.state.velocity(stored.solved.model)
    density = densities(stored.solved.materials, mesh.mesh.cell_count)
    bodies = np.intersect1d(cells, np.concatenate([inside for inside, _ in cell_values(stored, "stress_elno")]))
    total = 0.0
    for kind, inside in highest(mesh, bodies, mesh.dimension):
        rule = mass_points(kind)
        v = np.einsum("pn,cnx->cpx", shape_values(kind, rule[0]), velocity[nodes_of_part(mesh, inside)])
        _, weights = places_and_weights(mesh, kind, inside, rule, stored.solved.axisymmetric)
        total += 0.5 * float(np.einsum("cpx,cpx,cp,c->", v, v, weights, density[inside]))
    return total


def densities(materials: MaterialField, count: int) -> np.ndarray:
    """RHO of each cell; nan where none is given."""
    values = np.full(count, np.nan)
    for cells, material in materials.parts:
        laws = [law.get("RHO") for law in material.laws.values() if law.get("RHO") is not None]
        values[cells] = laws[0] if laws else np.nan
    return values


# ---- MASS_INER ---------------------------------------------------------------------------------------------------


def mass(arguments: Arguments, one: Arguments) -> Iterator[Row]:
    """Mass, centre and inertia about the centre. In axisymmetric models of the whole ring, as Code_Aster has it."""
    model, materials = arguments.MODELE, arguments.CHAM_MATER
    if model is None or materials is None:
        raise CommandError("POST_ELEM/MASS_INER: MODELE and CHAM_MATER are needed.")
    if is_ring(model):
        raise CommandError("POST_ELEM/MASS_INER: it is not available in axisymmetric models.")
    if one.ORIG_INER:
        raise CommandError("POST_ELEM/MASS_INER/ORIG_INER: it is not available.")
    mesh = model.mesh
    density = densities(materials, mesh.mesh.cell_count)
    for name, cells in regions(mesh, one, model):
        yield {"LIEU": mesh.name if name == "TOUT" else name, "ENTITE": "TOUT" if name == "TOUT" else "GROUP_MA",
               **_inertia(mesh, cells, density)}


def _inertia(mesh: MeshConcept, cells: np.ndarray, density: np.ndarray) -> Row:
    total, first, second = 0.0, np.zeros(3), np.zeros((3, 3))
    for kind, inside in highest(mesh, cells, mesh.dimension):
        if np.any(np.isnan(density[inside])):
            raise CommandError("POST_ELEM/MASS_INER: a material has no RHO.")
        places, weights = places_and_weights(mesh, kind, inside, mass_points(kind), False)
        masses = weights * density[inside][:, None]
        total += float(np.sum(masses))
        first += np.einsum("cp,cpx->x", masses, places)
        second += np.einsum("cp,cpx,cpy->xy", masses, places, places)
    if total == 0:
        raise CommandError("POST_ELEM/MASS_INER: the cells have no mass.")
    centre = first / total
    about = second - total * np.outer(centre, centre)
    spread = np.trace(about) * np.eye(3) - about
    return {"MASSE": total, **{f"CDG_{axis}": float(x) for axis, x in zip("XYZ", centre)},
            "IX_G": float(spread[0, 0]), "IY_G": float(spread[1, 1]), "IZ_G": float(spread[2, 2]),
            "IXY_G": float(about[0, 1]), "IXZ_G": float(about[0, 2]), "IYZ_G": float(about[1, 2])}


OPTIONS = {"NORME": norm, "INTEGRALE": integral, "ENER_POT": _energies(strain_energy),
           "ENER_ELAS": _energies(strain_energy), "ENER_CIN": _energies(kinetic_energy), "MASS_INER": mass}

COMMANDS = [Command("POST_ELEM", KEYS, post_elem)]
