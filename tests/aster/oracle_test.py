# SPDX-License-Identifier: LGPL-3.0-or-later
"""Command files against Code_Aster's own numbers, where these are beside the project: the public files of SDNL140 as they
are; contact on meshes that do not match, relations and oblique supports, orthotropic bodies, temperatures."""

from __future__ import annotations

import csv
import json
import math
import os
import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import rubato

SOURCE = Path(os.environ["RUBATO_SOURCE_DIR"])
# An empty variable says that nothing is shared.
SHARED = Path(os.environ.get("RUBATO_SHARED", SOURCE.parent / "shared") or os.devnull)
ORACLE = SHARED / "oracle"
pytestmark = pytest.mark.skipif(not ORACLE.is_dir(), reason="Code_Aster's numbers are not there")

HEAD = """DEBUT()
import json
mesh = LIRE_MAILLAGE(FORMAT='{format}')
model = AFFE_MODELE(MAILLAGE=mesh, AFFE=_F(TOUT='OUI', PHENOMENE='MECANIQUE', MODELISATION='{kind}'))
"""
TAIL = """
found = {}
for order in result.LIST_VARI_ACCES()['NUME_ORDRE']:
    field = CREA_CHAMP(OPERATION='EXTR', TYPE_CHAM='NOEU_DEPL_R', RESULTAT=result, NOM_CHAM='DEPL', NUME_ORDRE=order)
    for i in range(field.values.shape[0]):
        found['%d %s' % (order, mesh.node_name(i))] = dict(zip(field.components, field.values[i].tolist()))
json.dump(found, open('found.json', 'w'))
FIN()
"""


def run(folder: Path, mesh: Path, text: str) -> dict[str, dict[str, float]]:
    """Displacements and multipliers by order and node."""
    (folder / "study.comm").write_text(text + TAIL)
    done = subprocess.run([sys.executable, "-m", "rubato.aster", "study.comm", "-o", "run", "--file", f"20={mesh}"],
                          cwd=folder, text=True, capture_output=True, timeout=300, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
    return json.loads((folder / "run" / "found.json").read_text())


def rows_of(name: str) -> list[dict[str, str]]:
    with open(ORACLE / f"{name}.csv", encoding="ascii") as file:
        return list(csv.DictReader(file))


def largest_difference(found: dict[str, dict[str, float]], rows: list[dict[str, str]], order: str = "") -> float:
    """Over all rows and components, by the largest displacement."""
    names = [name for name in ("dx", "dy", "dz") if name in rows[0]]
    # Nodes that DECOUPE_LAC added are called C…
    nodes = [row for row in rows if row.get("side", "") != "base_reaction" and (row.get("node") or "N")[0] == "N"]
    peak = max(abs(float(row[name])) for row in nodes for name in names)
    return max(abs(found[f"{order or row['nume_ordre']} {row.get('node') or row['noeud']}"][name.upper()]
                   - float(row[name])) for row in nodes for name in names) / peak


# ---- contact -----------------------------------------------------------------------------------------------


def contact_study(dimension: int, algorithm: str, pressed: tuple[str, ...]) -> str:
    axis = "XYZ"[dimension - 1]
    sides = [f"_F(GROUP_MA='L{axis}0', D{axis}=0.)", "_F(GROUP_MA=('LX0', 'UX0'), DX=0.)"]
    if dimension == 3:
        sides.append("_F(GROUP_MA=('LY0', 'UY0'), DY=0.)")
    return HEAD.format(format="ASTER", kind="D_PLAN" if dimension == 2 else "3D") + f"""
rubber = DEFI_MATERIAU(ELAS=_F(E=2000., NU=0.3))
material = AFFE_MATERIAU(MAILLAGE=mesh, AFFE=_F(TOUT='OUI', MATER=rubber))
held = AFFE_CHAR_MECA(MODELE=model, DDL_IMPO=({', '.join(sides)}))
press = AFFE_CHAR_MECA(MODELE=model, PRES_REP=_F(GROUP_MA={pressed}, PRES=25.))
contact = DEFI_CONTACT(MODELE=model, FORMULATION='CONTINUE', ALGO_RESO_GEOM='NEWTON', ALGO_RESO_CONT='NEWTON',
                       ZONE=_F(ALGO_CONT='{algorithm}', GROUP_MA_MAIT='L{axis}1', GROUP_MA_ESCL='U{axis}0'))
once = DEFI_LIST_REEL(DEBUT=0., INTERVALLE=_F(JUSQU_A=1., NOMBRE=1))
ramp = DEFI_FONCTION(NOM_PARA='INST', VALE=(0., 0., 1., 1.))
result = STAT_NON_LINE(MODELE=model, CHAM_MATER=material, CONTACT=contact, COMPORTEMENT=_F(RELATION='ELAS'),
                       EXCIT=(_F(CHARGE=held), _F(CHARGE=press, FONC_MULT=ramp)), INCREMENT=_F(LIST_INST=once),
                       CONVERGENCE=_F(RESI_GLOB_RELA=1e-9))
"""


@pytest.mark.parametrize("dimension", [2, 3])
@pytest.mark.parametrize("load", ["full", "half"])
def test_standard_contact_on_meshes_that_do_not_match(dimension, load, tmp_path):
    pressed = ("UYH", "UYG") if load == "full" else ("UYH",)
    found = run(tmp_path, ORACLE / f"lac{dimension}d.mail", contact_study(dimension, "STANDARD", pressed))
    rows = rows_of(f"contact_std{dimension}d_{load}")
    assert largest_difference(found, rows, "1") < 2e-9  # solved to 1e-9 by Code_Aster
    for row in rows:
        if row["lags_c"]:
            assert found[f"1 {row['node']}"]["LAGS_C"] == pytest.approx(float(row["lags_c"]), abs=1e-7)


@pytest.mark.parametrize("dimension", [2, 3])
@pytest.mark.parametrize("load, tolerance", [("full", 1e-10), ("half", 5e-3)])
def test_mortar_contact_on_meshes_that_do_not_match(dimension, load, tolerance, tmp_path):
    """Code_Aster's pressures are constant on each face and lose 0.2 to 0.3 % of half a load (12.468 of 12.5 in the plane);
    those here are linear and lose nothing."""
    pressed = ("UYH", "UYG") if load == "full" else ("UYH",)
    found = run(tmp_path, ORACLE / f"lac{dimension}d.mail", contact_study(dimension, "LAC", pressed))
    assert largest_difference(found, rows_of(f"contact_lac{dimension}d_{load}"), "1") < tolerance


# ---- statics -----------------------------------------------------------------------------------------------

LINEAR = """
material = AFFE_MATERIAU(MAILLAGE=mesh, AFFE=_F(TOUT='OUI', MATER=steel))
result = MECA_STATIQUE(MODELE=model, CHAM_MATER=material, EXCIT=_F(CHARGE=load){more})
"""
STEEL = "steel = DEFI_MATERIAU(ELAS=_F(E=200e9, NU=0.3))\n"
CLAMPED = "DDL_IMPO=_F(GROUP_MA=('Haut_Encastre', 'Bas_Encastre'), LIAISON='ENCASTRE')"


def end_nodes() -> tuple[str, ...]:
    return tuple(row["noeud"] for row in rows_of("static_c_rigid_end_a"))


@pytest.mark.parametrize("case, force", [("a", "FY=-1e5"), ("b", "FZ=1e5"), ("c", "FX=1e5"),
                                         ("d", "FX=3e4, FY=-1e5, FZ=2e4"), ("n", "FX=3e4, FY=-1e5, FZ=2e4")])
def test_a_rigid_end(case, force, tmp_path):
    rigid = "" if case == "n" else ", LIAISON_SOLIDE=_F(GROUP_NO='end')"
    # The six nodes of the upper beam's end, that of the lower one not among them.
    text = HEAD.format(format="MED", kind="3D") + STEEL + f"""
mesh = DEFI_GROUP(reuse=mesh, MAILLAGE=mesh, CREA_GROUP_NO=_F(NOM='end', NOEUD={end_nodes()}))
load = AFFE_CHAR_MECA(MODELE=model, {CLAMPED}, FORCE_NODALE=_F(NOEUD='N7', {force}){rigid})
""" + LINEAR.format(more="")
    found = run(tmp_path, SHARED / "sdnl140" / "sdnl140c.med", text)
    assert largest_difference(found, rows_of(f"static_c_rigid_end_{case}")) < 1e-9


@pytest.mark.parametrize("name, kind, held", [
    ("incl3d_dnor", "3D", "FACE_IMPO=_F(GROUP_MA='X1', DNOR=0.), DDL_IMPO=(_F(GROUP_MA='X0', DX=0.), "
                          "_F(GROUP_MA='Y0', DY=0.), _F(GROUP_MA='Z0', DZ=0.))"),
    ("incl2d_dnor", "D_PLAN", "FACE_IMPO=_F(GROUP_MA='X1', DNOR=0.), DDL_IMPO=(_F(GROUP_MA='X0', DX=0.), "
                              "_F(GROUP_MA='Y0', DY=0.))"),
    ("incl2d_ddl", "D_PLAN", "DDL_IMPO=_F(NOEUD='N1', DX=0., DY=0.), LIAISON_OBLIQUE=_F(NOEUD='N4', ANGL_NAUT=30., "
                             "DY=0.), LIAISON_DDL=_F(NOEUD=('N16', 'N13'), DDL=('DY', 'DX'), COEF_MULT=(1., -2.), "
                             "COEF_IMPO=1e-4)"),
])
def test_inclined_faces_and_relations(name, kind, held, tmp_path):
    text = HEAD.format(format="ASTER", kind=kind) + STEEL + f"""
load = AFFE_CHAR_MECA(MODELE=model, {held}, PRES_REP=_F(GROUP_MA='Y1', PRES=1e8))
""" + LINEAR.format(more="")
    found = run(tmp_path, ORACLE / f"{name.split('_')[0]}.mail", text)
    assert largest_difference(found, rows_of(f"static_{name}")) < 1e-9


@pytest.mark.parametrize("mesh, kind, angle", [("c", "3D", 0), ("c", "3D", 30), ("fdp", "D_PLAN", 0),
                                               ("fdp", "D_PLAN", 30), ("fcp", "C_PLAN", 30)])
def test_orthotropic_bodies(mesh, kind, angle, tmp_path):
    load = ("DDL_IMPO=_F(GROUP_MA='Encastrement', LIAISON='ENCASTRE'), FORCE_NODALE=_F(GROUP_NO='Force', FY=-1e7)"
            if kind != "3D" else f"{CLAMPED}, FORCE_ARETE=_F(GROUP_MA='Haut_Pression', FY=-1e7)")
    text = HEAD.format(format="MED", kind=kind) + f"""
mesh = DEFI_GROUP(reuse=mesh, MAILLAGE=mesh, CREA_GROUP_MA=_F(NOM='bodies', TOUT='OUI'))
steel = DEFI_MATERIAU(ELAS_ORTH=_F(E_L=200e9, E_T=100e9, E_N=80e9, NU_LT=.3, NU_LN=.25, NU_TN=.2, G_LT=60e9, G_LN=50e9,
                                   G_TN=40e9))
axes = AFFE_CARA_ELEM(MODELE=model, MASSIF=_F(GROUP_MA='bodies', ANGL_REP=({angle}., 0., 0.)))
load = AFFE_CHAR_MECA(MODELE=model, {load})
""" + LINEAR.format(more=", CARA_ELEM=axes")
    found = run(tmp_path, SHARED / "sdnl140" / ("sdnl140c.med" if kind == "3D" else "sdnl140f.med"), text)
    assert largest_difference(found, rows_of(f"static_{mesh}_orth{angle}")) < 1e-9


# ---- temperatures ------------------------------------------------------------------------------------------


def upper_nodes(solid: bool) -> tuple[str, ...]:
    """Nodes of the upper beam: of the cells whose middle is above the interface."""
    mesh = rubato.read_mesh(SHARED / "sdnl140" / ("sdnl140c.med" if solid else "sdnl140f.med"))
    points = np.asarray(mesh.points)
    (cells,) = (np.asarray(block.nodes) for block in mesh.blocks if block.type == ("hexa8" if solid else "quad4"))
    upper = cells[points[cells][:, :, 1].mean(axis=1) > 0]
    return tuple(f"N{node + 1}" for node in np.unique(upper))


@pytest.mark.parametrize("name, kind", [("c_uni", "3D"), ("c_uni_mu02", "3D"), ("c_grad", "3D"), ("fdp_grad", "D_PLAN"),
                                        ("fcp_uni_mu02", "C_PLAN")])
def test_heated_beams(name, kind, tmp_path):
    solid = kind == "3D"
    clamped = "('Haut_Encastre', 'Bas_Encastre')" if solid else "('Encastrement',)"
    out = "('N11', 'N12')" if solid else "'N6'"
    value = "100. * Y / 0.1" if "grad" in name else "100."
    friction = "FROTTEMENT='COULOMB'," if "mu02" in name else ""
    coulomb = ", COULOMB=0.2" if friction else ""
    text = HEAD.format(format="MED", kind=kind) + f"""
mesh = DEFI_GROUP(reuse=mesh, MAILLAGE=mesh, CREA_GROUP_NO=_F(NOM='upper', NOEUD={upper_nodes(solid)}))
steel = DEFI_MATERIAU(ELAS=_F(E=200e9, NU=0.3, ALPHA=1.2e-5))
places = CREA_CHAMP(OPERATION='EXTR', TYPE_CHAM='NOEU_GEOM_R', NOM_CHAM='GEOMETRIE', MAILLAGE=mesh)
grows = FORMULE(VALE='{value}', NOM_PARA=('X', 'Y'))
formula = CREA_CHAMP(OPERATION='AFFE', TYPE_CHAM='NOEU_NEUT_F', MAILLAGE=mesh,
                     AFFE=_F(GROUP_NO='upper', NOM_CMP='X1', VALE_F=grows))
values = CREA_CHAMP(OPERATION='EVAL', TYPE_CHAM='NOEU_NEUT_R', CHAM_F=formula, CHAM_PARA=places)
warm = CREA_CHAMP(OPERATION='ASSE', TYPE_CHAM='NOEU_TEMP_R', MAILLAGE=mesh, ASSE=_F(
    GROUP_NO='upper', CHAM_GD=values, NOM_CMP='X1', NOM_CMP_RESU='TEMP'))
cold = CREA_CHAMP(OPERATION='AFFE', TYPE_CHAM='NOEU_TEMP_R', MAILLAGE=mesh, AFFE=_F(TOUT='OUI', NOM_CMP='TEMP', VALE=0.))
whole = CREA_CHAMP(OPERATION='ASSE', TYPE_CHAM='NOEU_TEMP_R', MAILLAGE=mesh, ASSE=(
    _F(TOUT='OUI', CHAM_GD=cold), _F(GROUP_NO='upper', CHAM_GD=warm)))
history = CREA_RESU(OPERATION='AFFE', TYPE_RESU='EVOL_THER', NOM_CHAM='TEMP',
                    AFFE=(_F(CHAM_GD=cold, INST=0.), _F(CHAM_GD=whole, INST=1.)))
material = AFFE_MATERIAU(MAILLAGE=mesh, AFFE=_F(TOUT='OUI', MATER=steel),
                         AFFE_VARC=_F(TOUT='OUI', NOM_VARC='TEMP', EVOL=history, NOM_CHAM='TEMP', VALE_REF=0.))
held = AFFE_CHAR_MECA(MODELE=model, DDL_IMPO=_F(GROUP_MA={clamped}, LIAISON='ENCASTRE'))
contact = DEFI_CONTACT(MODELE=model, FORMULATION='CONTINUE', {friction} ALGO_RESO_GEOM='NEWTON', ALGO_RESO_CONT='NEWTON',
                       ZONE=_F(GROUP_MA_MAIT='Haut_Contact', GROUP_MA_ESCL='Bas_Contact', SANS_NOEUD={out}{coulomb}))
steps = DEFI_LIST_REEL(DEBUT=0., INTERVALLE=_F(JUSQU_A=1., NOMBRE=4))
result = STAT_NON_LINE(MODELE=model, CHAM_MATER=material, EXCIT=_F(CHARGE=held), CONTACT=contact,
                       INCREMENT=_F(LIST_INST=steps))
"""
    found = run(tmp_path, SHARED / "sdnl140" / ("sdnl140c.med" if solid else "sdnl140f.med"), text)
    rows = [row for row in rows_of(f"thermal_{name}") if float(row["t"]) * 4 % 1 == 0]
    node = "N7" if solid else "N4"
    names = [axis for axis in ("dx", "dy", "dz") if axis in rows[0]]
    peak = max(abs(float(row[axis])) for row in rows for axis in names)
    assert len(rows) == 5
    for order, row in enumerate(rows):
        for axis in names:
            assert found[f"{order} {node}"][axis.upper()] == pytest.approx(float(row[axis]), abs=1e-8 * peak)


# ---- SDNL140 -----------------------------------------------------------------------------------------------


# ---- bodies that yield, turn and stretch ---------------------------------------------------------------------

YIELDS = "ECRO_LINE=_F(SY=400e6, D_SIGM_EPSI=2e9)"
BEHAVIOURS = {
    "isot_line": (YIELDS, "VMIS_ISOT_LINE", "PETIT", 2e6),
    "isot_trac": ("TRACTION=_F(SIGM=DEFI_FONCTION(NOM_PARA='EPSI', PROL_DROITE='LINEAIRE', VALE=(.002, 400e6, .004, "
                  "430e6, .008, 460e6, .03, 500e6)))", "VMIS_ISOT_TRAC", "PETIT", 2e6),
    "cine_line": (YIELDS, "VMIS_CINE_LINE", "PETIT", 2e6),
    "ecmi_line": (f"{YIELDS}, PRAGER=_F(C=1e9)", "VMIS_ECMI_LINE", "PETIT", 2e6),
    "cin1_chab": ("CIN1_CHAB=_F(R_0=300e6, R_I=400e6, B=20., C_I=40e9, K=1., W=0., G_0=200., A_I=1.)",
                  "VMIS_CIN1_CHAB", "PETIT", 2e6),
    "gdep_elas": ("", "ELAS", "GROT_GDEP", 1e7),
    "log_isot": (YIELDS, "VMIS_ISOT_LINE", "GDEF_LOG", 2e6),
}


def beams_study(prefix: str, name: str) -> str:
    numbers, relation, deformation, load = BEHAVIOURS[name]
    solid = prefix == "c"
    instants = [float(row["t"]) for row in rows_of(f"{prefix}_{name}")]
    force = (f"FORCE_ARETE=_F(GROUP_MA='Haut_Pression', FY={-load})" if solid else
             f"FORCE_NODALE=_F(GROUP_NO='Force', FY={-load})")
    clamped = "('Haut_Encastre', 'Bas_Encastre')" if solid else "'Encastrement'"
    excluded = "('N11', 'N12')" if solid else "'N6'"
    return HEAD.format(format="MED", kind="3D" if solid else "D_PLAN") + f"""
steel = DEFI_MATERIAU(ELAS=_F(E=200e9, NU=0.3, RHO=7800.){', ' + numbers if numbers else ''})
material = AFFE_MATERIAU(MAILLAGE=mesh, AFFE=_F(TOUT='OUI', MATER=steel))
held = AFFE_CHAR_MECA(MODELE=model, DDL_IMPO=_F(GROUP_MA={clamped}, DX=0., DY=0.{', DZ=0.' if solid else ''}))
force = AFFE_CHAR_MECA(MODELE=model, {force})
contact = DEFI_CONTACT(MODELE=model, FORMULATION='CONTINUE', FROTTEMENT='COULOMB', ALGO_RESO_GEOM='NEWTON',
                       ALGO_RESO_CONT='NEWTON', ALGO_RESO_FROT='NEWTON', ZONE=_F(
                           GROUP_MA_MAIT='Haut_Contact', GROUP_MA_ESCL='Bas_Contact', COULOMB=0.2, COEF_CONT=1e9,
                           COEF_FROT=1e7, CONTACT_INIT='OUI', SANS_NOEUD={excluded}, ADAPTATION='NON'))
instants = DEFI_LIST_REEL(VALE={instants})
result = DYNA_NON_LINE(MODELE=model, CHAM_MATER=material, CONTACT=contact, EXCIT=(_F(CHARGE=held), _F(CHARGE=force)),
                       COMPORTEMENT=_F(TOUT='OUI', RELATION='{relation}', DEFORMATION='{deformation}'),
                       SCHEMA_TEMPS=_F(SCHEMA='HHT', FORMULATION='DEPLACEMENT', ALPHA=-0.3, MODI_EQUI='OUI'),
                       INCREMENT=_F(LIST_INST=instants), CONVERGENCE=_F(RESI_GLOB_RELA=1e-9, ITER_GLOB_MAXI=30))
plastic = []
for order in result.LIST_VARI_ACCES()['NUME_ORDRE']:
    field = CREA_CHAMP(OPERATION='EXTR', TYPE_CHAM='ELGA_VARI_R', RESULTAT=result, NOM_CHAM='VARI_ELGA', NUME_ORDRE=order)
    plastic.append(max(part.values.max() for part in field.parts))
json.dump(plastic, open('plastic.json', 'w'))
"""


@pytest.mark.parametrize("prefix", ["c", "fdp"])
@pytest.mark.parametrize("name", BEHAVIOURS)
def test_beams_that_yield_and_turn(prefix, name, tmp_path):
    rows = rows_of(f"{prefix}_{name}")
    mesh, node = (SHARED / "sdnl140" / "sdnl140c.med", "N7") if prefix == "c" else (
        SHARED / "sdnl140" / "sdnl140f.med", "N4")
    found = run(tmp_path, mesh, beams_study(prefix, name))
    peak = max(abs(float(row["dy"])) for row in rows)
    for order, row in enumerate(rows):
        assert found[f"{order} {node}"]["DY"] == pytest.approx(float(row["dy"]), abs=1e-6 * peak)
    plastic = json.loads((tmp_path / "run" / "plastic.json").read_text())
    if "VMIS_ISOT" in BEHAVIOURS[name][1]:
        largest = max(float(row["v1_max"]) for row in rows)
        for value, row in zip(plastic, rows, strict=True):
            assert value == pytest.approx(float(row["v1_max"]), abs=1e-5 * largest)
    assert not any(math.isnan(value) for value in plastic)


@pytest.mark.parametrize("modeling", "abcdef")
def test_public_command_files_run_as_they_are(modeling, tmp_path):
    for name in (f"sdnl140{modeling}.comm", f"sdnl140{modeling}.export"):
        shutil.copy(SHARED / "sdnl140" / "comm" / name, tmp_path)
    mesh = "c" if modeling == "e" else modeling
    shutil.copy(SHARED / "sdnl140" / f"sdnl140{mesh}.med", tmp_path / f"sdnl140{mesh}.mmed")
    done = subprocess.run([sys.executable, "-m", "rubato.aster", f"sdnl140{modeling}.export"], cwd=tmp_path, text=True,
                          capture_output=True, timeout=300, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
    assert "OK" in done.stdout
    assert "\nNOOK" not in done.stdout
