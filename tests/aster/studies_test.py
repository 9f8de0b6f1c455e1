# SPDX-License-Identifier: LGPL-3.0-or-later
"""The studies of this folder, each in a process of its own: every check that decides holds, and there are as many as
expected. And checks that must not hold do not."""

from __future__ import annotations

import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

import meshes

HERE = Path(__file__).parent
# The studies, and how many values each compares with a number from outside (VALE_REFE).
STUDIES = {
    "bar.comm": 22, "choices.comm": 29, "column.comm": 24, "cook.comm": 6, "damping.comm": 15, "edges.comm": 12,
    "errors.comm": 2, "excit.comm": 140, "excluded.comm": 13, "explicit.comm": 12, "failing.comm": 1,
    "fields.comm": 25, "form15.comm": 3, "friction.comm": 60, "frozen.comm": 12, "functions.comm": 12,
    "gaps.comm": 28, "gmsh.comm": 2, "groups.export": 23, "layers.comm": 8, "legs.comm": 4, "mortar.comm": 17,
    "mortar3d.export": 10, "onesided.comm": 14, "opposite.comm": 24, "ortho.export": 22, "oscillator.comm": 94, "pairs.export": 17,
    "patch2d.export": 440, "patch3d.export": 259, "press.comm": 72, "press3d.export": 175, "printing.export": 3,
    "quadratic.comm": 29, "reduced.comm": 8, "refined.comm": 15, "relations.comm": 19, "restart.comm": 13,
    "ring.comm": 8, "settle.comm": 18, "sheet.comm": 24, "sheets.export": 17, "slide.comm": 23, "springs.comm": 18,
    "stops.comm": 6, "surfaces.export": 54, "textmesh.comm": 6, "thermal.comm": 16, "tied.comm": 8, "tubes.comm": 49,
    "turning.comm": 80, "views.comm": 7, "watched.comm": 27, "yielding.comm": 20,
}
COUNT = re.compile(r"outside references \(VALE_REFE\): (\d+) of (\d+) hold")


def names_in(export: Path) -> list[str]:
    """Files that an .export reads."""
    lines = [line.split() for line in export.read_text().splitlines() if line.startswith("F ")]
    return [line[2] for line in lines if "D" in line[3]]


def files_of(study: str) -> list[str]:
    """What belongs to a study beside itself: what the .export names, or files of the same name."""
    if study.endswith(".export"):
        return names_in(HERE / study)
    stem = Path(study).stem
    beside = [path.name for path in HERE.glob(f"{stem}.*") if path.name != study]
    return beside + [name for name in meshes.MESHES if Path(name).stem == stem]


def prepare(study: str, folder: Path) -> Path:
    """A copy of the study in a folder of its own, with its meshes."""
    for name in [study, *files_of(study)]:
        if name in meshes.MESHES:
            meshes.write(folder, [name])
        else:
            shutil.copy(HERE / name, folder / name)
    return folder / study


def run(path: Path, *options: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run([sys.executable, "-m", "rubato.aster", path.name, "-o", "run", *options], cwd=path.parent,
                          capture_output=True, text=True, check=False, timeout=600)


def failures(output: str) -> list[str]:
    """Lines of checks that decide and do not hold."""
    return [line for line in output.splitlines() if line.startswith("NOOK")]


def test_every_study_is_listed() -> None:
    exports = sorted(HERE.glob("*.export"))
    parts = {name for path in exports for name in names_in(path)}
    alone = {path.name for path in HERE.glob("*.comm")} - parts
    assert {path.name for path in exports} | alone == set(STUDIES)


@pytest.mark.parametrize("study", STUDIES)
def test_study(study: str, tmp_path: Path) -> None:
    done = run(prepare(study, tmp_path))
    assert failures(done.stdout) == []
    assert done.returncode == 0, done.stderr
    found = COUNT.search(done.stdout)
    assert found is not None
    assert [int(number) for number in found.groups()] == [STUDIES[study]] * 2


# ---- checks that must not hold -----------------------------------------------------------------------------------

PLAIN = """
DEBUT()
mesh = LIRE_MAILLAGE()
model = AFFE_MODELE(MAILLAGE=mesh, AFFE=_F(TOUT='OUI', PHENOMENE='MECANIQUE', MODELISATION='C_PLAN'))
steel = DEFI_MATERIAU(ELAS=_F(E=1000., NU=0.))
material = AFFE_MATERIAU(MAILLAGE=mesh, AFFE=_F(TOUT='OUI', MATER=steel))
held = AFFE_CHAR_MECA(MODELE=model, DDL_IMPO=(_F(GROUP_MA='LEFT', DX=0.), _F(GROUP_MA='BOTTOM', DY=0.)))
load = AFFE_CHAR_MECA(MODELE=model, FORCE_CONTOUR=_F(GROUP_MA='RIGHT', FX=10.))
result = MECA_STATIQUE(MODELE=model, CHAM_MATER=material, EXCIT=(_F(CHARGE=held), _F(CHARGE=load)))
field = CREA_CHAMP(TYPE_CHAM='NOEU_DEPL_R', OPERATION='EXTR', RESULTAT=result, NOM_CHAM='DEPL', NUME_ORDRE=1)
cells = CREA_CHAMP(TYPE_CHAM='ELGA_SIEF_R', OPERATION='EXTR', RESULTAT=result, NOM_CHAM='SIEF_ELGA', NUME_ORDRE=1)
table = POST_RELEVE_T(ACTION=_F(OPERATION='EXTRACTION', INTITULE='T', CHAM_GD=field, NOEUD=('N2', 'N4'), NOM_CMP='DX'))
function = DEFI_FONCTION(NOM_PARA='INST', VALE=(0., 0., 1., 2.))
{check}
FIN()
"""
AT = "NUME_ORDRE=1, NOM_CHAM='DEPL', NOM_CMP='DX'"
SOURCE = "REFERENCE='ANALYTIQUE'"
# The value is 0.01 at the right side, 10 in the cells, and 1 of the function at 0.5.
CHECKS = {
    "result": f"TEST_RESU(RESU=_F(RESULTAT=result, {AT}, NOEUD='N2', {SOURCE}, VALE_CALC=0.01, VALE_REFE={{0}}))",
    "sum": f"TEST_RESU(RESU=_F(RESULTAT=result, {AT}, TYPE_TEST='MAX', {SOURCE}, VALE_CALC=0.01, VALE_REFE={{0}}))",
    "absolute": f"TEST_RESU(RESU=_F(RESULTAT=result, {AT}, NOEUD='N2', {SOURCE}, CRITERE='ABSOLU', PRECISION=1e-6, "
                "VALE_CALC=0.01, VALE_REFE={0}))",
    "nodal field": f"TEST_RESU(CHAM_NO=_F(CHAM_GD=field, NOM_CMP='DX', NOEUD='N4', {SOURCE}, VALE_CALC=0.01, "
                   "VALE_REFE={0}))",
    "cell field": f"TEST_RESU(CHAM_ELEM=_F(CHAM_GD=cells, NOM_CMP='SIXX', MAILLE='M5', POINT=1, {SOURCE}, "
                  "VALE_CALC=10., VALE_REFE=1000*{0}))",
    "mesh": f"TEST_RESU(MAILLAGE=_F(MAILLAGE=mesh, CARA='NB_NOEUD', {SOURCE}, VALE_CALC_I=4, "
            "VALE_REFE_I=round(400*{0})))",
    "table": f"TEST_TABLE(TABLE=table, NOM_PARA='DX', FILTRE=_F(NOM_PARA='NOEUD', VALE_K='N2'), {SOURCE}, "
             "VALE_CALC=0.01, VALE_REFE={0})",
    "function": f"TEST_FONCTION(VALEUR=_F(FONCTION=function, VALE_PARA=0.5, {SOURCE}, VALE_CALC=1., "
                "VALE_REFE=100*{0}))",
    "own value": f"TEST_RESU(RESU=_F(RESULTAT=result, {AT}, NOEUD='N2', VALE_CALC={{0}}))",
}


def run_check(check: str, folder: Path) -> subprocess.CompletedProcess[str]:
    meshes.write(folder, ["one.med"])
    (folder / "one.comm").write_text(PLAIN.format(check=check))
    return run(folder / "one.comm")


@pytest.mark.parametrize("kind", CHECKS)
def test_a_right_reference_holds_and_a_wrong_one_does_not(kind: str, tmp_path: Path) -> None:
    right = run_check(CHECKS[kind].format("0.01"), tmp_path)
    assert right.returncode == 0 and not failures(right.stdout), right.stdout + right.stderr
    # 1.5 % off: beyond the usual tolerance of 1e-3, and of Code_Aster's own values here.
    wrong = run_check(CHECKS[kind].format("0.01015" if kind != "mesh" else "0.0125"), tmp_path)
    assert wrong.returncode == 1 and len(failures(wrong.stdout)) == 2, wrong.stdout + wrong.stderr


def test_a_zero_reference_holds_for_zero_only(tmp_path: Path) -> None:
    check = (f"TEST_RESU(RESU=_F(RESULTAT=result, {AT}, NOEUD='{{0}}', {SOURCE}, VALE_CALC=0., VALE_REFE=0., "
             "PRECISION=1.))")
    assert run_check(check.format("N1"), tmp_path).returncode == 0
    assert run_check(check.format("N2"), tmp_path).returncode == 1


def test_what_is_not_available_is_told_before_anything_runs(tmp_path: Path) -> None:
    done = run_check("result = CALC_CHAMP(reuse=result, RESULTAT=result, THERMIQUE='FLUX_ELGA')\n"
                     "x = DEFI_COQUE(MODELE=model)", tmp_path)
    assert done.returncode == 2
    assert "one.comm:14" in done.stderr and "THERMIQUE" in done.stderr
    assert "one.comm:15" in done.stderr and "DEFI_COQUE" in done.stderr
    assert not (tmp_path / "run").exists()


def test_an_error_that_nothing_expects_ends_the_run(tmp_path: Path) -> None:
    done = run_check("mesh = DEFI_GROUP(reuse=mesh, MAILLAGE=mesh, CREA_GROUP_NO=_F(GROUP_MA='NOWHERE'))\n"
                     "raise AssertionError('not reached')", tmp_path)
    assert done.returncode == 2
    assert "one.comm:14: " in done.stderr and "'NOWHERE'" in done.stderr and "not reached" not in done.stderr


def test_a_run_that_does_not_converge_has_its_own_exit_code(tmp_path: Path) -> None:
    study = prepare("failing.comm", tmp_path)
    study.write_text(study.read_text().replace("aster.NonConvergenceError", "ZeroDivisionError"))
    done = run(study)
    assert done.returncode == 3
    assert "no convergence" in done.stderr and "failing.comm:17" in done.stderr
