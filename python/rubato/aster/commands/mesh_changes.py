# SPDX-License-Identifier: LGPL-3.0-or-later
"""MODI_MAILLAGE, CREA_MAILLAGE, MACR_ADAP_MAIL, ASSE_MAILLAGE, COPIER, DETRUIRE: meshes made of meshes."""

from __future__ import annotations

import copy
from collections.abc import Callable
from typing import Any

import numpy as np

import rubato

from ..concepts import MeshConcept, Named
from ..keys import (Arguments, Command, CommandError, Key, anything, concept, factor, harmless, integer, real, reals,
                    text, texts, words, yes, yes_no)
from ..mesh import geometry, orders, orient
from ..mesh.pieces import built, pieces_of, restricted
from ..mesh.refine import refined_part
from ..mesh.select import in_space

# A mesh with more cells was not meant.
MOST_CELLS = 100_000_000


def _where(**more: Key) -> dict[str, Key]:
    """TOUT, GROUP_MA, MAILLE: cells."""
    return {"TOUT": yes(), "GROUP_MA": texts(), "MAILLE": texts(), **more}


def _cells(path: str, mesh: MeshConcept, where: Arguments) -> np.ndarray:
    cells = mesh.cells(where)
    if not len(cells):
        raise CommandError(f"{path}: expected cells: TOUT, GROUP_MA or MAILLE.")
    return np.sort(cells)


def done(path: str, change: Callable[..., Any], *values: Any) -> Any:
    """What rubato makes of a mesh; what it refuses, as an error of the command."""
    try:
        return change(*values)
    except rubato.InputError as error:
        raise CommandError(f"{path}: {error}") from error


# ---- MODI_MAILLAGE -------------------------------------------------------------------------------------------

_SKIN = {"GROUP_MA": texts(required=True)}
MODI_MAILLAGE = {
    "reuse": anything(), "MAILLAGE": concept("MeshConcept", required=True),
    "DEFORME": factor({"OPTION": words("TRAN", default="TRAN", missing={"TRAN_APPUI": "Write TRAN."}),
                       "DEPL": concept("NodalField"), "ALEA": real()}, most=1),
    "TRANSLATION": reals(),
    "MODI_BASE": factor({"VECT_X": reals(required=True), "VECT_Y": reals()}, most=1),
    "ROTATION": factor({"POIN_1": reals(required=True), "ANGLE": real(0.0), "POIN_2": reals(), "DIR": reals()}),
    "SYMETRIE": factor({"POINT": reals(required=True), "AXE_1": reals(required=True), "AXE_2": reals()}, most=1),
    "ECHELLE": real(),
    "ORIE_PEAU_2D": factor({**_SKIN, "GROUP_MA_SURF": texts()}),
    "ORIE_PEAU_3D": factor({**_SKIN, "GROUP_MA_VOLU": texts()}),
    "ORIE_PEAU": factor({"GROUP_MA_PEAU": texts(required=True), "GROUP_MA_INTERNE": texts()}),
    "ORIE_NORM_COQUE": factor({**_SKIN, "VECT_NORM": reals(), "NOEUD": text(), "GROUP_NO": text()}),
    "INFO": harmless(),
}


def modi_maillage(session: Any, arguments: Arguments) -> MeshConcept:
    mesh = arguments.MAILLAGE
    points = np.array(mesh.mesh.points, dtype=float)
    moved = _moved(mesh, points, arguments)
    if moved is not points:
        # A reflection turns cells inside out; the others are left as they are.
        mesh.replace(mesh.mesh.with_points(moved).mended())
    for skins, bodies, items in (("GROUP_MA", "GROUP_MA_SURF", arguments.ORIE_PEAU_2D),
                                 ("GROUP_MA", "GROUP_MA_VOLU", arguments.ORIE_PEAU_3D),
                                 ("GROUP_MA_PEAU", "GROUP_MA_INTERNE", arguments.ORIE_PEAU)):
        for item in items:
            behind = _cells_of(mesh, getattr(item, bodies)) if item.given(bodies) else None
            mesh.replace(orient.outwards(mesh.mesh, _cells_of(mesh, getattr(item, skins)), behind))
    for item in arguments.ORIE_NORM_COQUE:
        _turn_alike(mesh, item)
    return mesh


def _moved(mesh: MeshConcept, points: np.ndarray, arguments: Arguments) -> np.ndarray:
    path, dimension = "MODI_MAILLAGE", mesh.dimension
    for item in arguments.DEFORME:
        if item.given("DEPL") == item.given("ALEA"):
            raise CommandError(f"{path}/DEFORME: expected one of DEPL and ALEA.")
        if item.given("DEPL"):
            points = geometry.moved_by(path + "/DEFORME/DEPL", points, item.DEPL)
        else:
            points = geometry.perturbed(points, item.ALEA)
    if arguments.TRANSLATION:
        points = points + in_space(path + "/TRANSLATION", arguments.TRANSLATION)
    for item in arguments.MODI_BASE:
        points = geometry.in_base(path + "/MODI_BASE", points, item, dimension)
    for item in arguments.ROTATION:
        points = geometry.rotated(path + "/ROTATION", points, item, dimension)
    for item in arguments.SYMETRIE:
        points = geometry.reflected(path + "/SYMETRIE", points, item, dimension)
    return points if arguments.ECHELLE is None else arguments.ECHELLE * points


def _cells_of(mesh: MeshConcept, groups: tuple[str, ...]) -> np.ndarray:
    return np.unique(np.concatenate([mesh.cells_in(group) for group in groups]))


def _turn_alike(mesh: MeshConcept, item: Arguments) -> None:
    path = "MODI_MAILLAGE/ORIE_NORM_COQUE"
    node = mesh.node_named(item.NOEUD) if item.NOEUD else None
    if item.GROUP_NO:
        node = int(mesh.nodes_in(item.GROUP_NO)[0])
    if bool(item.VECT_NORM) != (node is not None):
        raise CommandError(f"{path}: VECT_NORM goes with NOEUD or GROUP_NO.")
    wanted = in_space(path + "/VECT_NORM", item.VECT_NORM) if item.VECT_NORM else None
    mesh.replace(orient.alike(path, mesh, _cells_of(mesh, item.GROUP_MA), node, wanted))


# ---- CREA_MAILLAGE -------------------------------------------------------------------------------------------

_NAMES = {"PREF_NOEUD": harmless(), "PREF_NUME": harmless()}


def _linear(session: Any, mesh: MeshConcept, items: list[Arguments]) -> Any:
    return orders.linear(mesh.mesh, _cells("CREA_MAILLAGE/QUAD_LINE", mesh, items[0]))


def _quadratic(session: Any, mesh: MeshConcept, items: list[Arguments]) -> Any:
    path = "CREA_MAILLAGE/LINE_QUAD"
    if len(_cells(path, mesh, items[0])) < mesh.mesh.cell_count:
        raise CommandError(f"{path}: only the whole mesh can be made quadratic: TOUT.")
    return done(path, mesh.mesh.converted, "quadratic")


def _centred(keyword: str, types: dict[str, str]) -> Callable[[Any, MeshConcept, list[Arguments]], Any]:
    def change(session: Any, mesh: MeshConcept, items: list[Arguments]) -> Any:
        cells = _cells(f"CREA_MAILLAGE/{keyword}", mesh, items[0])
        others = set(orders.TRIANGLES) | set(orders.PRISMS) | set(orders.HEXAHEDRA)
        if len(cells) == mesh.mesh.cell_count and not {str(b.type) for b in mesh.mesh.blocks} & (others - set(types)):
            return mesh.mesh.converted("full_quadratic")
        return orders.with_centres(mesh.mesh, cells, types)

    return change


def _other_cells(session: Any, mesh: MeshConcept, items: list[Arguments]) -> Any:
    changed = mesh.mesh
    for item in items:
        types = orders.QUADRANGLES if item.OPTION == "QUAD8_9" else orders.TRIANGLES
        changed = orders.with_centres(changed, _cells("CREA_MAILLAGE/MODI_MAILLE", mesh, item), types)
    return changed


def _unsplit(session: Any, mesh: MeshConcept, items: list[Arguments]) -> Any:
    # Code_Aster splits slave faces because its multipliers need a node inside each face. The mortar multipliers here
    # live on the nodes, so that the mesh can stay as it is: names, groups and nodes are those of the file.
    session.note("CREA_MAILLAGE/DECOUPE_LAC: faces are not split, mortar contact does not need it here; a field by "
                 "face has one value for each face of the mesh as it was read.")
    for item in items:
        _cells_of(mesh, item.GROUP_MA_ESCL)
    return mesh.mesh.copy()


def _part_of(session: Any, mesh: MeshConcept, items: list[Arguments]) -> Any:
    item = items[0]
    cells = _cells("CREA_MAILLAGE/RESTREINT", mesh, item)
    kept = restricted(pieces_of(mesh.mesh), cells, mesh.nodes_of_cells(cells))
    if item.TOUT_GROUP_MA == "NON":
        kept.cell_groups = {name: kept.cell_groups[name] for name in item.GROUP_MA if name in kept.cell_groups}
    if item.TOUT_GROUP_NO == "NON":
        for name in item.GROUP_NO:
            mesh.nodes_in(name)
        kept.node_groups = {name: kept.node_groups[name] for name in item.GROUP_NO if name in kept.node_groups}
    return built(kept)


def _with_points(session: Any, mesh: MeshConcept, items: list[Arguments]) -> Any:
    """A cell at each node, called as the node."""
    pieces = pieces_of(mesh.mesh)
    known = _points_by_name(mesh)
    for item in items:
        nodes = mesh.nodes(item)
        names = {int(node): mesh.node_name(int(node)) for node in nodes}
        new = [node for node, name in names.items() if name not in known]
        known.update(zip((names[node] for node in new), pieces.add_cells("point1", new, [names[i] for i in new])))
        if len(item.NOM_GROUP_MA) > 1:
            raise CommandError("CREA_MAILLAGE/CREA_POI1/NOM_GROUP_MA: expected one name.")
        for group in item.NOM_GROUP_MA:
            _check_new(pieces.cell_groups, group)
            pieces.cell_groups[group] = np.array([known[name] for name in names.values()], dtype=np.int64)
    return built(pieces)


def _points_by_name(mesh: MeshConcept) -> dict[str, int]:
    points = [block for block in mesh.mesh.blocks if np.asarray(block.nodes).shape[1] == 1]
    return {mesh.cell_name(cell): cell for block in points
            for cell in range(block.first, block.first + len(block.nodes))}


def _check_new(groups: dict[str, Any], name: str) -> None:
    if name in groups:
        raise CommandError(f"CREA_MAILLAGE: there is already a group of cells {name!r}.")


def _with_copies(session: Any, mesh: MeshConcept, items: list[Arguments]) -> Any:
    """Cells twice: the second ones in a group of their own."""
    pieces = pieces_of(mesh.mesh)
    for item in items:
        _check_new(pieces.cell_groups, item.NOM)
        cells = _cells("CREA_MAILLAGE/CREA_MAILLE", mesh, item)
        made: list[int] = []
        first = 0
        for part in list(pieces.cells[:len(mesh.mesh.blocks)]):
            own = cells[(cells >= first) & (cells < first + len(part))]
            names = [_copy_name(mesh, item, int(cell), len(made) + i) for i, cell in enumerate(own)]
            if len(own):
                made += pieces.add_cells(part.type, part.nodes[own - first], names).tolist()
            first += len(part)
        pieces.cell_groups[item.NOM] = np.array(made, dtype=np.int64)
    return built(pieces)


def _copy_name(mesh: MeshConcept, item: Arguments, cell: int, place: int) -> str:
    if item.given("PREF_NUME"):
        return f"{item.PREF_MAILLE}{item.PREF_NUME + place}"
    return f"{item.PREF_MAILLE}{mesh.cell_name(cell)}"


def _refined(session: Any, mesh: MeshConcept, items: list[Arguments]) -> Any:
    path, level = "CREA_MAILLAGE/RAFFINEMENT", items[0].NIVEAU
    if level < 1 or mesh.mesh.cell_count * 2 ** min(level * mesh.dimension, 99) > MOST_CELLS:
        raise CommandError(f"{path}/NIVEAU: expected at least 1, and a mesh of at most {MOST_CELLS} cells.")
    return done(path, mesh.mesh.refined, 2 ** level)


WAYS: dict[str, tuple[Key, Callable[[Any, MeshConcept, list[Arguments]], Any]]] = {
    "QUAD_LINE": (factor(_where(), most=1), _linear),
    "LINE_QUAD": (factor(_where(**_NAMES), most=1), _quadratic),
    "HEXA20_27": (factor(_where(**_NAMES), most=1), _centred("HEXA20_27", orders.HEXAHEDRA)),
    "PENTA15_18": (factor(_where(**_NAMES), most=1), _centred("PENTA15_18", orders.PRISMS)),
    "MODI_MAILLE": (factor(_where(OPTION=words("QUAD8_9", "TRIA6_7", missing={"QUAD_TRIA3": "", "SEG3_4": ""}),
                                  PREF_MAILLE=harmless(), **_NAMES)), _other_cells),
    "DECOUPE_LAC": (factor({"GROUP_MA_ESCL": texts(required=True), "DECOUPE_HEXA": harmless(), **_NAMES}), _unsplit),
    "RESTREINT": (factor({"GROUP_MA": texts(), "MAILLE": texts(), "GROUP_NO": texts(),
                          "TOUT_GROUP_MA": yes_no("NON"), "TOUT_GROUP_NO": yes_no("NON")}, most=1), _part_of),
    "CREA_POI1": (factor(_where(GROUP_NO=texts(), NOEUD=texts(), NOM_GROUP_MA=texts())), _with_points),
    "CREA_MAILLE": (factor(_where(NOM=text(required=True), PREF_MAILLE=text(required=True), PREF_NUME=integer())),
                    _with_copies),
    "RAFFINEMENT": (factor({"TOUT": yes(), "NIVEAU": integer(1)}, most=1), _refined),
}
CREA_MAILLAGE = {
    "MAILLAGE": concept("MeshConcept", required=True), **{name: key for name, (key, _) in WAYS.items()},
    "TITRE": harmless(), "INFO": harmless(),
}


def crea_maillage(session: Any, arguments: Arguments) -> MeshConcept:
    wanted = [name for name in WAYS if getattr(arguments, name)]
    if len(wanted) != 1:
        raise CommandError(f"CREA_MAILLAGE: expected one of {', '.join(WAYS)}.")
    return MeshConcept(WAYS[wanted[0]][1](session, arguments.MAILLAGE, getattr(arguments, wanted[0])))


# ---- MACR_ADAP_MAIL ------------------------------------------------------------------------------------------

_REPORTS = ("NOMBRE", "QUALITE", "CONNEXITE", "TAILLE", "INTERPENETRATION", "PROP_CALCUL", "DIAMETRE", "INFO", "LANGUE",
            "VERSION_HOMARD", "LOGICIEL")
_BY_FIELD = "Only uniform refinement is available: RAFFINEMENT_UNIFORME."
MACR_ADAP_MAIL = {
    "ADAPTATION": words("RAFFINEMENT_UNIFORME", "RIEN", required=True, missing={
        name: _BY_FIELD for name in ("RAFF_DERA", "RAFFINEMENT", "DERAFFINEMENT", "RAFF_DERA_ZONE",
                                     "DERAFFINEMENT_UNIFORME", "MODIFICATION", "LECTURE")}),
    "MAILLAGE_N": concept("MeshConcept", required=True), "MAILLAGE_NP1": anything(required=True),
    "GROUP_MA": texts(),
    **{name: harmless() for name in _REPORTS},
}


def macr_adap_mail(session: Any, arguments: Arguments) -> None:
    mesh = arguments.MAILLAGE_N.mesh
    if not hasattr(arguments.MAILLAGE_NP1, "name"):
        raise CommandError("MACR_ADAP_MAIL/MAILLAGE_NP1: expected CO('…').")
    if arguments.ADAPTATION == "RIEN":
        made = mesh.copy()
    elif arguments.GROUP_MA:
        made = _refined_groups(arguments.MAILLAGE_N, arguments.GROUP_MA)
    else:
        made = done("MACR_ADAP_MAIL", mesh.refined, 2)
    session.new_concept(arguments.MAILLAGE_NP1, MeshConcept(made))


def _refined_groups(mesh: MeshConcept, groups: tuple[str, ...]) -> Any:
    """Returns the mesh with the cells of these groups refined. Raises CommandError for parts of bodies."""
    made, between = done("MACR_ADAP_MAIL", refined_part, mesh.mesh, _cells_of(mesh, groups))
    if made is None:
        raise CommandError(f"MACR_ADAP_MAIL/GROUP_MA: cell {mesh.cell_name(int(between[0]))} shares edges with cells of "
                           f"{', '.join(groups)} and is not refined itself, as are {len(between)} cells; only whole "
                           "bodies can be refined: name all cells of the body.")
    return made


# ---- ASSE_MAILLAGE -------------------------------------------------------------------------------------------

ASSE_MAILLAGE = {
    "MAILLAGE_1": concept("MeshConcept", required=True), "MAILLAGE_2": concept("MeshConcept", required=True),
    "OPERATION": words("SUPERPOSE", required=True, missing={"SOUS_STR": "There are no substructures.", "COLLAGE": ""}),
}


def asse_maillage(session: Any, arguments: Arguments) -> MeshConcept:
    """Both meshes in one: nodes and cells are called by their place in it."""
    first, second = arguments.MAILLAGE_1.mesh, arguments.MAILLAGE_2.mesh
    for kind in ("node_groups", "cell_groups"):
        both = set(getattr(first, kind)) & set(getattr(second, kind))
        if both:
            raise CommandError(f"ASSE_MAILLAGE: both meshes have a group {min(both)!r}.")
    builder = rubato.MeshBuilder(max(first.dimension, second.dimension))
    builder.append(first)
    builder.append(second)
    return MeshConcept(builder.build())


# ---- COPIER --------------------------------------------------------------------------------------------------

COPIER = {"CONCEPT": anything(required=True), "INFO": harmless()}


def copier(session: Any, arguments: Arguments) -> Named:
    if not isinstance(arguments.CONCEPT, Named):
        raise CommandError("COPIER/CONCEPT: expected the result of a command.")
    made = copy.copy(arguments.CONCEPT)
    # What a later command with `reuse` adds to must not be shared.
    made.__dict__.update({name: value.copy() for name, value in vars(made).items() if isinstance(value, (list, dict))})
    made.name = ""
    return made


# Deleting a concept has no effect on what follows: names that are still used are kept.
DETRUIRE = {name: harmless() for name in ("CONCEPT", "OBJET", "INFO", "ALARME", "NOM")}

COMMANDS = [
    Command("MODI_MAILLAGE", MODI_MAILLAGE, modi_maillage),
    Command("CREA_MAILLAGE", CREA_MAILLAGE, crea_maillage),
    Command("MACR_ADAP_MAIL", MACR_ADAP_MAIL, macr_adap_mail),
    Command("ASSE_MAILLAGE", ASSE_MAILLAGE, asse_maillage),
    Command("COPIER", COPIER, copier),
    Command("DETRUIRE", DETRUIRE, lambda session, arguments: None, harmless=True),
]
