# SPDX-License-Identifier: LGPL-3.0-or-later
"""Fields of small studies that can be computed by hand, and what is made of fields."""

import numpy as np
import pytest

import rubato
from rubato.aster.catalogue import all_commands
from rubato.aster.concepts import CellField, CellPart, MeshConcept, NodalField
from rubato.aster.fields import field_of, in_cells, nodal_mean, with_nodes_in_order
from rubato.aster.frames import STRESS_INVARIANTS, by_angles, stress_invariants
from rubato.aster.keys import CommandError, check
from rubato.aster.selection import all_values, value_in_cell
from rubato.aster.session import Session
from rubato.aster.shapes import DIMENSIONS, SHAPES, gauss_points, measures, reference_nodes, shape_values
from rubato.aster.strain_fields import strain_parts

COMMANDS = all_commands()


def call(session, name, **given):
    made = COMMANDS[name].run(session, check(COMMANDS[name], given))
    if made is not None and not made.name:
        made.name = "made"
    return made


@pytest.fixture
def session(tmp_path):
    return Session(COMMANDS, {}, tmp_path)


# ---- studies -----------------------------------------------------------------------------------------------------


class Study:
    """Blocks of quadrangles, x from 1 to 2, one above the other, with a gap of nodes between them. Groups: B0, T0 the
    bottom and top edges of block 0, and so on."""

    def __init__(self, session, blocks, kind="D_PLAN", poisson=0.0, density=3.0):
        self.session = session
        builder = rubato.MeshBuilder(2)
        for block in range(blocks):
            nodes = np.array([builder.add_nodes(np.array([[x, y] for x in (1.0, 1.5, 2.0)]))
                              for y in (block, block + 1.0)])
            for i in range(2):
                builder.add_cells("quad4", np.array([[*nodes[0, i:i + 2], *nodes[1, i:i + 2][::-1]]]))
            for name, row in (("B", nodes[0]), ("T", nodes[1])):
                for i in range(2):
                    cells = builder.add_cells("seg2", np.array([row[i:i + 2]]))
                    builder.add_to_cell_group(f"{name}{block}", cells)
                builder.add_to_node_group(f"{name}{block}", row)
        self.mesh = MeshConcept(builder.build())
        self.mesh.name = "M"
        self.model = call(session, "AFFE_MODELE", MAILLAGE=self.mesh,
                          AFFE=dict(TOUT="OUI", PHENOMENE="MECANIQUE", MODELISATION=kind))
        material = call(session, "DEFI_MATERIAU", ELAS=dict(E=1000.0, NU=poisson, RHO=density))
        self.materials = call(session, "AFFE_MATERIAU", MAILLAGE=self.mesh, AFFE=dict(TOUT="OUI", MATER=material))
        self.loads = []

    def impose(self, group, **values):
        self.loads.append(call(self.session, "AFFE_CHAR_MECA", MODELE=self.model,
                               DDL_IMPO=dict(GROUP_NO=group, **values)))

    def pull(self, group, **values):
        self.loads.append(call(self.session, "AFFE_CHAR_MECA", MODELE=self.model,
                               FORCE_NODALE=dict(GROUP_NO=group, **values)))

    def solve(self, command="STAT_NON_LINE", steps=1, **more):
        instants = call(self.session, "DEFI_LIST_REEL", DEBUT=0.0, INTERVALLE=dict(JUSQU_A=1.0, NOMBRE=steps))
        ramp = call(self.session, "DEFI_FONCTION", NOM_PARA="INST", VALE=(0.0, 0.0, 1.0, 1.0))
        result = call(self.session, command, MODELE=self.model, CHAM_MATER=self.materials,
                      EXCIT=[dict(CHARGE=load, FONC_MULT=ramp) for load in self.loads],
                      INCREMENT=dict(LIST_INST=instants), **more)
        result.name = "U"
        return result

    def pressed(self, formulation="CONTINUE", friction=None, slide=0.0, **zone):
        """Block 1 pressed on block 0 by 0.02: a strain of 0.01 and a pressure of 10."""
        self.impose("B0", DX=0.0, DY=0.0)
        self.impose("T1", DX=slide, DY=-0.02)
        if friction:
            zone["COULOMB"] = friction
        contact = call(self.session, "DEFI_CONTACT", MODELE=self.model, FORMULATION=formulation,
                       FROTTEMENT="COULOMB" if friction else "SANS",
                       ZONE=dict(GROUP_MA_MAIT="T0", GROUP_MA_ESCL="B1", **zone))
        return self.solve(CONTACT=contact)


def last(result, name):
    return field_of(result, result.stored[-1], name)


def at(study, field, group, component):
    return field.column(component)[study.mesh.nodes_in(group)]


# ---- a bar in tension --------------------------------------------------------------------------------------------


@pytest.fixture
def bar(session):
    """A force of 3 · 2 along y on the upper edge of one block: a stress of 6."""
    study = Study(session, 1)
    study.impose("B0", DX=0.0, DY=0.0)
    study.pull("T0", FY=2.0)
    return study


def test_stress_and_strain_of_a_bar(bar):
    # The middle node of the edge gets 2 of 6 and belongs to both cells: the stress is not uniform, its mean is 6.
    result = bar.solve()
    stress = last(result, "SIEF_ELGA")
    assert stress.components == ("SIXX", "SIYY", "SIZZ", "SIXY")
    assert [part.values.shape for part in stress.parts] == [(2, 4, 4)]
    assert np.mean(all_values(stress, "SIYY")) == pytest.approx(6.0)
    strain = last(result, "EPSI_ELGA")
    assert all_values(strain, "EPYY") == pytest.approx(all_values(stress, "SIYY") / 1000)
    # The shear of Code_Aster is half the engineering one: σ_xy = 2 G ε_xy, G = E/2.
    assert all_values(strain, "EPXY") == pytest.approx(all_values(stress, "SIXY") / 1000)
    assert last(result, "VARI_ELNO").components == ("V1",) and not np.any(all_values(last(result, "VARI_ELNO"), "V1"))


KINDS = [("D_PLAN", cells) for cells in ("tria3", "tria6", "quad4", "quad8", "quad9")] + [
    ("AXIS", "quad4"), ("AXIS", "quad8"), ("AXIS", "tria6")] + [
    ("3D", cells) for cells in ("tetra4", "tetra10", "penta6", "penta15", "hexa8", "hexa20", "hexa27")]


@pytest.mark.parametrize("kind, cells", KINDS)
def test_strains_of_the_displacement_are_those_of_small_strain(session, kind, cells):
    """EPSI from the displacement equals the strain that the law sees, at Gauss points and extrapolated to nodes; the
    others differ by squares of the strain."""
    dimension = 3 if kind == "3D" else 2
    mesh = MeshConcept(rubato.generate([rubato.Body(
        name="B", dimension=dimension, from_=(1, 0, 0), to=(2, 1, 1 if dimension == 3 else 0), cells=cells,
        divisions=(2, 1, 1), sides={"bottom": "LOW", "top": "HIGH", "left": "IN"})]))
    points = np.array(mesh.mesh.points)
    points[:, :dimension] += 0.03 * np.sin(7 * points[:, :dimension].sum(axis=1))[:, None]
    mesh.replace(mesh.mesh.with_points(points))
    model = call(session, "AFFE_MODELE", MAILLAGE=mesh, AFFE=dict(TOUT="OUI", PHENOMENE="MECANIQUE", MODELISATION=kind))
    steel = call(session, "DEFI_MATERIAU", ELAS=dict(E=1000.0, NU=0.3))
    material = call(session, "AFFE_MATERIAU", MAILLAGE=mesh, AFFE=dict(TOUT="OUI", MATER=steel))
    held = {name: 0.0 for name in ("DX", "DY", "DZ")[:dimension]}
    load = call(session, "AFFE_CHAR_MECA", MODELE=model, DDL_IMPO=dict(GROUP_MA="LOW", **held),
                **{"FORCE_FACE" if dimension == 3 else "FORCE_CONTOUR": dict(GROUP_MA="HIGH", FX=1e-2, FY=2e-2)})
    result = call(session, "MECA_STATIQUE", MODELE=model, CHAM_MATER=material, EXCIT=dict(CHARGE=load))
    for place in ("ELGA", "ELNO"):
        own = last(result, f"EPSI_{place}")
        size = max(np.max(np.abs(part.values)) for part in own.parts)
        for measure, error in (("EPSI", 1e-12), ("EPSG", 30 * size**2), ("EPSL", 30 * size**2)):
            for one, two in zip(strain_parts(result.stored[-1], measure, place), own.parts, strict=True):
                assert one.cells.tolist() == two.cells.tolist()
                assert np.max(np.abs(one.values - two.values)) <= max(error, 1e-10 * size)
    assert last(result, "EPSL_NOEU").components == last(result, "EPSI_NOEU").components


def test_reactions_of_a_bar(bar):
    result = bar.solve(steps=2)
    reactions, forces = last(result, "REAC_NODA"), last(result, "FORC_NODA")
    assert np.sum(at(bar, reactions, "B0", "DY")) == pytest.approx(-6.0)
    assert at(bar, reactions, "T0", "DY") == pytest.approx(0.0, abs=1e-9)
    assert at(bar, forces, "T0", "DY") == pytest.approx(2.0)
    half = field_of(result, result.at(0.5), "REAC_NODA")
    assert np.sum(at(bar, half, "B0", "DY")) == pytest.approx(-3.0)


def test_fields_are_computed_once_and_unknown_ones_are_told(bar):
    result = bar.solve()
    assert last(result, "DEPL") is last(result, "DEPL")
    with pytest.raises(CommandError, match="field SIEF_NEOU of result U is not available.*Did you mean SIEF_NOEU"):
        last(result, "SIEF_NEOU")
    with pytest.raises(CommandError, match="CONT_NOEU"):
        last(result, "CONT_NOEU")


def test_invariants_of_a_bar(bar):
    result = bar.solve()
    stress, invariants = last(result, "SIEF_ELNO"), last(result, "SIEQ_ELNO")
    s = stress.parts[0].values[0, 2]
    mises = np.sqrt(s[0]**2 - s[0] * s[1] + s[1]**2 + 3 * s[3]**2)
    assert value_in_cell(invariants, int(stress.parts[0].cells[0]), 2, "VMIS") == pytest.approx(mises)


def test_energies(session, bar):
    result = bar.solve()
    table = call(session, "POST_ELEM", RESULTAT=result, INST=1.0, ENER_POT=dict(TOUT="OUI"))
    work = 0.5 * np.sum(at(bar, last(result, "DEPL"), "T0", "DY") * 2.0)
    assert table["TOTALE", 1] == pytest.approx(work)


def test_reactions_hold_inertia(session):
    """A free block that 6 accelerates: REAC_NODA is −M a."""
    study = Study(session, 1)
    study.pull("T0", FY=2.0)
    result = study.solve("DYNA_NON_LINE", steps=4, SCHEMA_TEMPS=dict(SCHEMA="NEWMARK", FORMULATION="DEPLACEMENT"))
    assert np.nansum(last(result, "REAC_NODA").column("DY")) == pytest.approx(-6.0)
    energy = call(session, "POST_ELEM", RESULTAT=result, INST=1.0, ENER_CIN=dict(TOUT="OUI"))["TOTALE", 1]
    velocity = last(result, "VITE").column("DY")
    # Mass 3, nearly rigid against its speed: not below the energy of the mean speed.
    assert energy >= 0.5 * 3.0 * np.mean(velocity)**2 * 0.99


# ---- blocks pressed together -------------------------------------------------------------------------------------


def test_pressure_of_continue(session):
    study = Study(session, 2)
    result = study.pressed()
    assert at(study, last(result, "DEPL"), "B1", "LAGS_C") == pytest.approx(-10.0)
    assert np.all(np.isnan(at(study, last(result, "DEPL"), "T0", "LAGS_C")))
    contact = last(result, "CONT_NOEU")
    assert at(study, contact, "B1", "RN") == pytest.approx([2.5, 5.0, 2.5])
    # On the side of the internal forces: minus what the master does to the slave.
    assert at(study, contact, "B1", "RNY") == pytest.approx([-2.5, -5.0, -2.5])
    assert at(study, contact, "B1", "CONT") == pytest.approx(2.0)
    assert at(study, contact, "B1", "JEU") == pytest.approx(0.0, abs=1e-12)
    assert at(study, contact, "B1", "PROJ_Y") == pytest.approx(0.99)
    assert at(study, contact, "B1", "I") == pytest.approx([2.5, 5.0, 2.5])
    reactions = last(result, "REAC_NODA")
    sums = [np.sum(at(study, reactions, group, "DY")) for group in ("B0", "T0", "B1", "T1")]
    assert sums == pytest.approx([10.0, -10.0, 10.0, -10.0])


def test_pressure_of_discrete(session):
    study = Study(session, 2)
    result = study.pressed("DISCRETE")
    assert last(result, "DEPL").components == ("DX", "DY")
    assert at(study, last(result, "CONT_NOEU"), "B1", "RN") == pytest.approx([2.5, 5.0, 2.5])


def test_forces_are_per_radian(session):
    study = Study(session, 2, "AXIS")
    result = study.pressed()
    # ∫ 10 r dr from 1 to 2
    assert np.sum(at(study, last(result, "REAC_NODA"), "B0", "DY")) == pytest.approx(15.0)
    assert np.sum(at(study, last(result, "FORC_NODA"), "B0", "DY")) == pytest.approx(15.0)
    assert np.sum(at(study, last(result, "CONT_NOEU"), "B1", "RN")) == pytest.approx(15.0)
    assert at(study, last(result, "DEPL"), "B1", "LAGS_C") == pytest.approx(-10.0)
    energy = call(session, "POST_ELEM", RESULTAT=result, INST=1.0, ENER_ELAS=dict(TOUT="OUI"))["TOTALE", 1]
    assert energy == pytest.approx(0.5 * 10.0 * 0.01 * 3.0)


def test_friction_that_slips(session):
    study = Study(session, 2)
    result = study.pressed(friction=0.3, slide=0.05)
    field, contact = last(result, "DEPL"), last(result, "CONT_NOEU")
    # The master's tangent runs along −x: the body is to its left. The slave slips along +x.
    assert at(study, field, "B1", "LAGS_F1") == pytest.approx(-1.0)
    assert at(study, contact, "B1", "CONT") == pytest.approx(2.0)
    assert np.all(at(study, contact, "B1", "GLIX") < 0)
    tangential = np.hypot(at(study, contact, "B1", "RTGX"), at(study, contact, "B1", "RTGY"))
    assert tangential == pytest.approx(0.3 * at(study, contact, "B1", "RN"))
    assert at(study, contact, "B1", "RTAX") == pytest.approx(0.0)
    assert np.all(at(study, contact, "B1", "RTGX") > 0)


def test_friction_that_sticks(session):
    study = Study(session, 2)
    result = study.pressed(friction=0.3, slide=0.001)
    contact, share = last(result, "CONT_NOEU"), at(study, last(result, "DEPL"), "B1", "LAGS_F1")
    assert at(study, contact, "B1", "CONT") == pytest.approx(1.0)
    assert np.all(np.abs(share) < 1) and np.all(share < 0)
    assert at(study, contact, "B1", "RTGX") == pytest.approx(0.0)
    friction = np.hypot(at(study, contact, "B1", "RTAX"), at(study, contact, "B1", "RTAY"))
    assert friction == pytest.approx(0.3 * np.abs(share) * at(study, contact, "B1", "RN"))


def test_open_contact(session):
    study = Study(session, 2)
    result = study.pressed(DIST_ESCL=call(session, "DEFI_CONSTANTE", VALE=-0.1))
    contact = last(result, "CONT_NOEU")
    if np.all(at(study, contact, "B1", "CONT") == 0):
        assert at(study, contact, "B1", "RN") == pytest.approx(0.0)
        assert np.all(at(study, contact, "B1", "JEU") > 0)
        assert at(study, last(result, "DEPL"), "B1", "LAGS_C") == pytest.approx(0.0)


def test_pressure_of_stresses(session):
    study = Study(session, 2)
    result = study.pressed()
    call(session, "CALC_PRESSION", reuse=result, RESULTAT=result, MAILLAGE=study.mesh, GROUP_MA="B1", INST=1.0)
    pressure = last(result, "PRES_NOEU")
    assert at(study, pressure, "B1", "PRES") == pytest.approx(-10.0)
    assert np.all(np.isnan(at(study, pressure, "T1", "PRES")))


# ---- made fields -------------------------------------------------------------------------------------------------


@pytest.fixture
def mesh(session):
    return Study(session, 1)


def made(session, place_type, operation, **more):
    return call(session, "CREA_CHAMP", TYPE_CHAM=place_type, OPERATION=operation, **more)


def test_values_at_nodes(session, mesh):
    field = made(session, "NOEU_DEPL_R", "AFFE", MAILLAGE=mesh.mesh, AFFE=(
        dict(TOUT="OUI", NOM_CMP=("DX", "DY"), VALE=(1.0, 2.0)), dict(GROUP_NO="T0", NOM_CMP="DY", VALE=5.0)))
    assert field.components == ("DX", "DY")
    assert at(mesh, field, "B0", "DY").tolist() == [2.0] * 3 and at(mesh, field, "T0", "DY").tolist() == [5.0] * 3
    extracted = field.EXTR_COMP("DY", ["T0"], 1)
    assert extracted.valeurs.tolist() == [5.0] * 3
    assert extracted.noeud.tolist() == sorted((mesh.mesh.nodes_in("T0") + 1).tolist())


def test_formulas_at_nodes_and_gauss_points(session, mesh):
    geometry = made(session, "NOEU_GEOM_R", "EXTR", MAILLAGE=mesh.mesh, NOM_CHAM="GEOMETRIE")
    formula = call(session, "FORMULE", NOM_PARA=("X", "Y"), VALE="2*X+Y")
    functions = made(session, "NOEU_NEUT_F", "AFFE", MAILLAGE=mesh.mesh, AFFE=dict(
        TOUT="OUI", NOM_CMP="X1", VALE_F=formula))
    values = made(session, "NOEU_NEUT_R", "EVAL", CHAM_F=functions, CHAM_PARA=geometry)
    assert at(mesh, values, "T0", "X1").tolist() == [3.0, 4.0, 5.0]
    there = made(session, "ELGA_GEOM_R", "DISC", MODELE=mesh.model, CHAM_GD=geometry)
    functions = made(session, "ELGA_NEUT_F", "AFFE", MODELE=mesh.model, PROL_ZERO="OUI", AFFE=dict(
        TOUT="OUI", NOM_CMP="X1", VALE_F=formula))
    at_points = made(session, "ELGA_NEUT_R", "EVAL", CHAM_F=functions, CHAM_PARA=there)
    moved = made(session, "ELGA_NEUT_R", "DISC", MODELE=mesh.model, CHAM_GD=values)
    assert all_values(at_points, "X1") == pytest.approx(all_values(moved, "X1"))
    # ∫ (2x + y)² over [1, 2] × [0, 1] = 4·7/3 + 4·(3/2)·(1/2) + 1/3
    for field in (values, at_points):
        norm = call(session, "POST_ELEM", NORME=dict(TYPE_NORM="L2", TOUT="OUI", CHAM_GD=field, MODELE=mesh.model))
        assert norm["VALE_NORM", 1]**2 == pytest.approx(28 / 3 + 3 + 1 / 3)


def test_functions_in_some_cells(session, mesh):
    geometry = made(session, "NOEU_GEOM_R", "EXTR", MAILLAGE=mesh.mesh, NOM_CHAM="GEOMETRIE")
    there = made(session, "ELGA_GEOM_R", "DISC", MODELE=mesh.model, CHAM_GD=geometry)
    formula = call(session, "FORMULE", NOM_PARA="X", VALE="1.0")
    functions = made(session, "ELGA_NEUT_F", "AFFE", MODELE=mesh.model, PROL_ZERO="OUI", AFFE=dict(
        GROUP_MA="B0", NOM_CMP="X1", VALE_F=formula))
    values = made(session, "ELGA_NEUT_R", "EVAL", CHAM_F=functions, CHAM_PARA=there)
    assert all_values(values, "X1").tolist() == [1.0] * 4


def test_fields_are_put_together(session, mesh):
    one = made(session, "NOEU_NEUT_R", "AFFE", MAILLAGE=mesh.mesh, AFFE=dict(TOUT="OUI", NOM_CMP=("X1", "X2"),
                                                                          VALE=(1.0, 2.0)))
    whole = made(session, "NOEU_DEPL_R", "ASSE", MAILLAGE=mesh.mesh, ASSE=(
        dict(TOUT="OUI", CHAM_GD=one, NOM_CMP="X2", NOM_CMP_RESU="DX", COEF_R=3.0),
        dict(GROUP_NO="T0", CHAM_GD=one, NOM_CMP="X1", NOM_CMP_RESU="DX", CUMUL="OUI", COEF_R=-1.0)))
    assert at(mesh, whole, "B0", "DX").tolist() == [6.0] * 3 and at(mesh, whole, "T0", "DX").tolist() == [5.0] * 3
    sum_ = made(session, "NOEU_DEPL_R", "COMB", COMB=(dict(CHAM_GD=whole, COEF_R=2.0), dict(CHAM_GD=whole, COEF_R=-1)))
    assert np.array_equal(sum_.values, whole.values)


def test_cells_are_put_together(session, mesh):
    one = made(session, "ELGA_NEUT_R", "AFFE", MODELE=mesh.model, PROL_ZERO="OUI", AFFE=dict(
        TOUT="OUI", NOM_CMP="X1", VALE=4.0))
    whole = made(session, "ELGA_NEUT_R", "ASSE", MODELE=mesh.model, ASSE=(
        dict(GROUP_MA="B0", CHAM_GD=one, NOM_CMP="X1", NOM_CMP_RESU="X2"),
        dict(TOUT="OUI", CHAM_GD=one, NOM_CMP="X1", NOM_CMP_RESU="X2", CUMUL="OUI")))
    edge, body = int(mesh.mesh.cells_in("B0")[0]), int(last_cell(mesh))
    assert value_in_cell(whole, edge, 0, "X2") == 8.0 and value_in_cell(whole, body, 3, "X2") == 4.0


def last_cell(study):
    return study.mesh.mesh.cell_count - 1


def test_normals_point_out_of_the_body(session, mesh):
    normals = made(session, "NOEU_GEOM_R", "NORMALE", MODELE=mesh.model, GROUP_MA=("T0", "B0"))
    assert at(mesh, normals, "T0", "Y") == pytest.approx(1.0)
    assert at(mesh, normals, "B0", "Y") == pytest.approx(-1.0)


def test_extremes_over_instants(session, bar):
    result = bar.solve(steps=2)
    field = made(session, "NOEU_DEPL_R", "EXTR", RESULTAT=result, NOM_CHAM="DEPL", TYPE_MAXI="MAXI", TOUT_ORDRE="OUI")
    assert at(bar, field, "T0", "DY") == pytest.approx(at(bar, last(result, "DEPL"), "T0", "DY"))
    when = made(session, "NOEU_DEPL_R", "EXTR", RESULTAT=result, NOM_CHAM="DEPL", TYPE_MAXI="MAXI", TYPE_RESU="INST")
    assert at(bar, when, "T0", "DY").tolist() == [1.0] * 3


def test_a_place_that_does_not_fit(session, mesh):
    with pytest.raises(CommandError, match="NOEU, ELGA was asked for"):
        made(session, "ELGA_GEOM_R", "EXTR", MAILLAGE=mesh.mesh, NOM_CHAM="GEOMETRIE")


def test_results_of_given_fields(session, mesh):
    function = call(session, "FORMULE", NOM_PARA=("X", "INST"), VALE="X*INST")
    field = made(session, "NOEU_TEMP_F", "AFFE", MAILLAGE=mesh.mesh, AFFE=dict(TOUT="OUI", NOM_CMP="TEMP",
                                                                            VALE_F=function))
    result = call(session, "CREA_RESU", OPERATION="AFFE", TYPE_RESU="EVOL_THER", NOM_CHAM="TEMP",
                  AFFE=dict(CHAM_GD=field, INST=(1.0, 3.0)))
    assert result.orders() == [0, 1]
    assert at(mesh, field_of(result, result.at(3.0), "TEMP"), "T0", "TEMP").tolist() == [3.0, 4.5, 6.0]


def test_a_field_on_another_mesh(session, mesh):
    field = made(session, "NOEU_GEOM_R", "EXTR", MAILLAGE=mesh.mesh, NOM_CHAM="GEOMETRIE")
    other = Study(session, 1)
    other.mesh.replace(other.mesh.mesh.with_points(0.5 + 0.5 * np.asarray(other.mesh.mesh.points)))
    moved = call(session, "PROJ_CHAMP", METHODE="COLLOCATION", CHAM_GD=field, MODELE_1=mesh.model, MODELE_2=other.model)
    assert at(other, moved, "T0", "X") == pytest.approx([1.0, 1.25, 1.5])


def test_med_files(session, bar, tmp_path):
    result = bar.solve()
    call(session, "IMPR_RESU", FORMAT="MED", UNITE=81, RESU=dict(RESULTAT=result, NOM_CHAM=("DEPL", "SIEF_NOEU")))
    (path,) = tmp_path.glob("fort.81*")
    assert b"U_______DEPL" in path.read_bytes() and b"U_______SIEF_NOEU" in path.read_bytes()
    assert rubato.read_mesh(path).node_count == bar.mesh.mesh.node_count


# ---- places ------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("kind", SHAPES)
def test_shape_functions(kind):
    nodes = reference_nodes(kind)
    assert shape_values(kind, nodes) == pytest.approx(np.eye(len(nodes)), abs=1e-12)
    volume = {"point1": 1, "seg": 2, "tria": 0.5, "quad": 4, "tetra": 1 / 6, "penta": 1, "hexa": 8}
    if DIMENSIONS[kind]:
        whole = measures(kind, nodes[None], *gauss_points(kind))
        assert np.sum(whole) == pytest.approx(volume[SHAPES[kind].corners])


def test_means_at_nodes_do_not_weigh():
    builder = rubato.MeshBuilder(2)
    nodes = builder.add_nodes(np.array([[0.0, 0], [1, 0], [1, 1], [0, 1], [9, 0], [9, 1]]))
    builder.add_cells("quad4", np.array([nodes[[0, 1, 2, 3]], nodes[[1, 4, 5, 2]]]))
    mesh = MeshConcept(builder.build())
    values = np.array([[1.0, 1, 1, 1], [4.0, 4, 4, 4]])[..., None]
    field = CellField(mesh, "ELNO", "SIEF_R", ("SIXX",), [CellPart(np.array([0, 1]), values)])
    assert nodal_mean(field).column("SIXX").tolist() == [1.0, 2.5, 2.5, 1.0, 4.0, 4.0]
    assert nodal_mean(field, np.array([1])).column("SIXX")[1] == 4.0
    assert np.isnan(nodal_mean(field, np.array([1])).column("SIXX")[0])


def test_gauss_points_have_the_order_of_code_aster():
    mesh = MeshConcept(_one_square())
    field = NodalField(mesh, "GEOM_R", ("X", "Y"), np.asarray(mesh.mesh.points)[:, :2].copy())
    places = in_cells(field, np.array([0]), "ELGA").parts[0].values[0]
    assert np.sign(places).tolist() == [[-1, -1], [1, -1], [1, 1], [-1, 1]]


def _one_square():
    builder = rubato.MeshBuilder(2)
    nodes = builder.add_nodes(np.array([[-1.0, -1], [1, -1], [1, 1], [-1, 1]]))
    builder.add_cells("quad4", np.array([nodes]))
    return builder.build()


def test_values_follow_their_nodes():
    values = np.array([[[10.0], [20], [30]]])
    assert with_nodes_in_order(values, np.array([[1, 2, 3]]), np.array([[3, 1, 2]])).ravel().tolist() == [30, 10, 20]


def test_invariants():
    uniaxial, pressure = np.diag([0.0, -6.0, 0.0]), -3 * np.eye(3)
    rows = stress_invariants(np.array([uniaxial, pressure]))
    of = dict(zip(STRESS_INVARIANTS, rows[0]))
    assert (of["VMIS"], of["TRESCA"], of["PRIN_1"], of["PRIN_3"], of["VMIS_SG"]) == pytest.approx((6, 6, -6, 0, -6))
    assert of["TRIAX"] == pytest.approx(-1 / 3) and of["TRSIG"] == pytest.approx(-6)
    assert rows[1, :2] == pytest.approx(0.0)


def test_axes_by_angles():
    axes = by_angles((90.0, 0.0, 0.0), 1)[0]
    assert axes @ np.array([0.0, 1.0, 0.0]) == pytest.approx([1.0, 0.0, 0.0])
