# SPDX-License-Identifier: LGPL-3.0-or-later
"""CALC_CHAMP, CALC_PRESSION, CREA_RESU: fields put into results."""

from __future__ import annotations

from typing import Any

import numpy as np

from ..concepts import CellField, CellPart, Function, NodalField, Result, Stored
from ..fields import CELL_PLACES, field_of
from ..keys import (Arguments, Command, CommandError, Key, anything, concept, factor, harmless, integer, real, text,
                    texts, words)
from ..mesh_parts import points_of
from ..normals import nodal_normals
from ..selection import NODES, STATES, chosen_states

# ---- CALC_CHAMP --------------------------------------------------------------------------------------------------


def _places(*kinds: str) -> tuple[str, ...]:
    return tuple(f"{kind}_{place}" for kind in kinds for place in CELL_PLACES)


STRESSES, STRAINS = _places("SIEF", "SIGM"), _places("EPSI", "EPME", "EPSG", "EPMG", "EPSL", "EPSP")
CRITERIA, VARIABLES = _places("SIEQ", "EPEQ", "EPMQ", "EPGQ"), _places("VARI")
FORCES = ("FORC_NODA", "REAC_NODA")
CALCULATE: dict[str, Key] = {
    **{name: key for name, key in STATES.items() if name != "LIST_ORDRE"}, **NODES,
    "LIST_ORDRE": concept("RealList"),
    "RESULTAT": concept("Result", required=True), "reuse": anything(), "MODELE": concept("ModelConcept"),
    "CHAM_MATER": concept("MaterialField"), "CARA_ELEM": concept("DiscreteField"), "EXCIT": harmless(),
    "CONTRAINTE": words(*STRESSES, many=True), "DEFORMATION": words(*STRAINS, many=True),
    "CRITERES": words(*CRITERIA, many=True), "FORCE": words(*FORCES, many=True),
    "VARI_INTERNE": words(*VARIABLES, many=True), "INFO": harmless(), "TITRE": harmless(),
}
OPTIONS = ("CONTRAINTE", "DEFORMATION", "CRITERES", "FORCE", "VARI_INTERNE")


def calculate(session: Any, arguments: Arguments) -> Result:
    """Fields are computed when they are asked for: this looks only whether they will be there. Without `reuse` the
    result is another one with the same states."""
    source = arguments.RESULTAT
    states = chosen_states(source, arguments)
    for option in OPTIONS:
        for name in arguments.get(option):
            _check_available(source, states, name)
    made = source
    if not arguments.given("reuse"):
        made = Result(source.kind, source.mesh, source.model)
        made.stored = states
    made.calculated += [name for option in OPTIONS for name in arguments.get(option) if name not in made.calculated]
    return made


def _check_available(result: Result, states: list[Stored], name: str) -> None:
    if any(stored.solved is None and name not in stored.given for stored in states):
        raise CommandError(f"CALC_CHAMP: {name} of result {result.name} cannot be computed: its fields were given, not "
                           "solved for.")


# ---- CALC_PRESSION -----------------------------------------------------------------------------------------------

PRESSURE: dict[str, Key] = {
    "RESULTAT": concept("Result", required=True), "reuse": anything(), "MAILLAGE": concept("MeshConcept"),
    "GROUP_MA": texts(required=True), "GEOMETRIE": words("INITIALE", "DEFORMEE", default="DEFORMEE"),
    "MODELE": concept("ModelConcept"), **STATES, "INFO": harmless(),
}


def pressure(session: Any, arguments: Arguments) -> Result:
    """PRES_NOEU = n·σ·n of SIEF_NOEU at the nodes of GROUP_MA, n the normal out of the body: on the deformed mesh
    unless GEOMETRIE is INITIALE. Negative in compression."""
    result = arguments.RESULTAT
    model = arguments.MODELE or result.model
    if model is None:
        raise CommandError(f"CALC_PRESSION: MODELE is missing: result {result.name} has no model.")
    bodies = np.unique(np.concatenate([part.cells for part in model.parts]))
    for stored in chosen_states(result, arguments):
        stored.given["PRES_NOEU"] = pressure_field(result, stored, arguments, bodies)
    return result


def pressure_field(result: Result, stored: Stored, arguments: Arguments, bodies: np.ndarray) -> NodalField:
    stress = field_of(result, stored, "SIEF_NOEU")
    assert isinstance(stress, NodalField)
    mesh = stress.mesh
    points = points_of(mesh)
    if arguments.GEOMETRIE == "DEFORMEE":
        moved = field_of(result, stored, "DEPL")
        assert isinstance(moved, NodalField)
        for axis, name in enumerate(("DX", "DY", "DZ")[:mesh.dimension]):
            points[:, axis] += np.nan_to_num(moved.column(name))
    faces = np.unique(np.concatenate([mesh.cells_in(group) for group in arguments.GROUP_MA]))
    normal = nodal_normals(mesh, faces, points, bodies)
    value = np.zeros(len(points))
    for i, j, pair in ((0, 0, "XX"), (1, 1, "YY"), (2, 2, "ZZ"), (0, 1, "XY"), (0, 2, "XZ"), (1, 2, "YZ")):
        if f"SI{pair}" in stress.components and max(i, j) < mesh.dimension:
            value += (1 if i == j else 2) * stress.column(f"SI{pair}") * normal[:, i] * normal[:, j]
    return NodalField(mesh, "PRES_R", ("PRES",), value.reshape(-1, 1))


# ---- CREA_RESU ---------------------------------------------------------------------------------------------------

CREATE: dict[str, Key] = {
    "OPERATION": words("AFFE", required=True, missing={name: "" for name in (
        "ASSE", "ECLA_PG", "PERM_CHAM", "PROL_RTZ", "PREP_VRC1", "PREP_VRC2", "CONV_CHAR", "CONV_RESU", "KUCV")}),
    "TYPE_RESU": words("EVOL_ELAS", "EVOL_NOLI", "EVOL_THER", "EVOL_VARC", required=True, missing={
        name: "" for name in ("MODE_MECA", "MULT_ELAS", "DYNA_TRANS", "DYNA_HARMO", "EVOL_CHAR", "FOURIER_ELAS")}),
    "NOM_CHAM": text(), "RESULTAT": concept("Result"), "reuse": anything(),
    "AFFE": factor({"CHAM_GD": concept("NodalField", "CellField", required=True), "NOM_CHAM": text(),
                    "INST": Key(real().takes, many=True), "LIST_INST": concept("RealList"),
                    "NUME_INIT": integer(), "NUME_FIN": integer(), "MODELE": concept("ModelConcept"),
                    "CHAM_MATER": harmless(), "CARA_ELEM": harmless(), "PRECISION": real(0.0),
                    "CRITERE": words("RELATIF", "ABSOLU", default="RELATIF")}, required=True),
    "EXCIT": harmless(), "COMPORTEMENT": harmless(), "INFO": harmless(), "TITRE": harmless(),
}


def create(session: Any, arguments: Arguments) -> Result:
    first = arguments.AFFE[0]
    given = arguments.RESULTAT or arguments.reuse
    result = given if isinstance(given, Result) else Result(arguments.TYPE_RESU, first.CHAM_GD.mesh, first.MODELE)
    for one in arguments.AFFE:
        name = one.NOM_CHAM or arguments.NOM_CHAM
        if name is None:
            raise CommandError("CREA_RESU: NOM_CHAM is missing.")
        for instant in _instants(one):
            stored = state_at(result, float(instant), max(one.PRECISION, 1e-9), one.CRITERE)
            stored.given[name] = at_instant(one.CHAM_GD, float(instant))
    return result


def _instants(one: Arguments) -> np.ndarray:
    if one.LIST_INST is None:
        if not one.INST:
            raise CommandError("CREA_RESU/AFFE: INST or LIST_INST is missing.")
        return np.asarray(one.INST)
    first = (one.NUME_INIT or 1) - 1
    return np.asarray(one.LIST_INST.values)[first:one.NUME_FIN]


def state_at(result: Result, instant: float, precision: float, criterion: str) -> Stored:
    """The state of the result at an instant; a new one where there is none. States ascend."""
    allowed = precision * (abs(instant) if criterion == "RELATIF" else 1.0)
    for stored in result.stored:
        if abs(stored.instant - instant) <= max(allowed, 1e-14):
            return stored
    made = Stored(max(result.orders(), default=-1) + 1, instant)
    result.stored.append(made)
    return made


def at_instant(field: NodalField | CellField, instant: float) -> NodalField | CellField:
    """A field of functions at an instant; at nodes they may also have the place."""
    if not field.functions:
        return field
    if isinstance(field, CellField):
        values = {code: _of_time(function, instant) for code, function in field.functions.items()}
        parts = [CellPart(part.cells, _decoded(part.values, values)) for part in field.parts]
        return CellField(field.mesh, field.place, field.quantity, field.components, parts)
    made = field.values.copy()
    points = points_of(field.mesh)
    for node, column in np.argwhere(~np.isnan(field.values)):
        function = field.functions[str(int(field.values[node, column]))]
        known = {**dict(zip("XYZ", points[node])), "INST": instant}
        made[node, column] = function(*(known[name] for name in function.parameters or ()))
    return NodalField(field.mesh, field.quantity, field.components, made)


def _of_time(function: Function, instant: float) -> float:
    if any(name != "INST" for name in function.parameters):
        raise CommandError(f"CREA_RESU: function {function.name} in cells must be one of INST.")
    return float(function(*([instant] * len(function.parameters))))


def _decoded(codes: np.ndarray, values: dict[str, float]) -> np.ndarray:
    made = codes.copy()
    for code, value in values.items():
        made[codes == float(code)] = value
    return made


COMMANDS = [
    Command("CALC_CHAMP", CALCULATE, calculate),
    Command("CALC_PRESSION", PRESSURE, pressure),
    Command("CREA_RESU", CREATE, create),
]
