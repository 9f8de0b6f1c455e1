# SPDX-License-Identifier: LGPL-3.0-or-later
"""Command files as programs: what stops them before they run, where errors are told, limits, files of a study."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

from rubato.aster.catalogue import all_commands
from rubato.aster.export import read_study
from rubato.aster.scan import scan
from rubato.aster.session import Session, StudyFailed

MESH = """COOR_2D
N1 0. 0.
N2 1. 0.
N3 1. 1.
N4 0. 1.
FINSF
QUAD4
M1 N1 N2 N3 N4
FINSF
SEG2
M2 N1 N2
M3 N3 N4
FINSF
GROUP_MA
bottom M2
FINSF
GROUP_MA
top M3
FINSF
FIN
"""


def session_in(folder: Path) -> Session:
    return Session(all_commands(), {}, folder)


def execute(folder: Path, text: str) -> Session:
    file = folder / "study.comm"
    file.write_text(text)
    session = session_in(folder)
    session.execute(file)
    return session


def run(folder: Path, text: str, *options: str) -> subprocess.CompletedProcess[str]:
    (folder / "study.comm").write_text(text)
    return subprocess.run([sys.executable, "-m", "rubato.aster", "study.comm", *options], cwd=folder, text=True,
                          capture_output=True, timeout=120, check=False)


# ---- what is not available ---------------------------------------------------------------------------------


def findings(folder: Path, text: str) -> list[str]:
    file = folder / "study.comm"
    file.write_text(text)
    return [f"{finding.line}: {finding.text}" for finding in scan(file, all_commands())[0]]


def test_everything_that_is_not_available_is_listed_with_its_line(tmp_path):
    found = findings(tmp_path, """DEBUT()
x = DEFI_LIST_REEL(DEBUT=0., INTERVALLE=_F(JUSQU_A=1., NOMBRES=2))
y = AFFE_CHAR_MECAA(MODELE=1)
z = STAT_NON_LINE(COMPORTEMENT=(_F(RELATION='ELAS',
                                   DEFORMATION='EULER_ALMANSI'),))
FIN()
""")
    assert found == ["2: DEFI_LIST_REEL/INTERVALLE: keyword NOMBRES is not available. Did you mean NOMBRE?",
                     "3: command AFFE_CHAR_MECAA is not available. Did you mean AFFE_CHAR_MECA?",
                     "5: STAT_NON_LINE/COMPORTEMENT/DEFORMATION: 'EULER_ALMANSI' is not available. "
                     "Strains here: PETIT, PETIT_REAC, GROT_GDEP, GDEF_LOG."]


def test_own_functions_in_capitals_are_no_commands(tmp_path):
    assert findings(tmp_path, "def MY_OWN(x):\n    return x\ny = MY_OWN(1)\nfrom m import OTHER_ONE\nOTHER_ONE()\n") == []


def test_nothing_runs_when_something_is_not_available(tmp_path):
    done = run(tmp_path, "open('ran', 'w').close()\nDEFI_NOTHING()\n")
    assert done.returncode == 2
    assert "study.comm:2: command DEFI_NOTHING is not available." in done.stderr
    assert "1 not available; nothing was run." in done.stderr
    assert not list(tmp_path.rglob("ran"))


def test_computed_keywords_are_checked_when_they_are_called(tmp_path):
    with pytest.raises(StudyFailed, match=r"study.comm:2: DEFI_LIST_REEL: keyword WRONG is not available"):
        execute(tmp_path, "more = {'WRONG': 1}\nDEFI_LIST_REEL(VALE=(0., 1.), **more)\n")


@pytest.mark.parametrize("call, sentence", [
    ("DEFI_CONSTANTE(VALE='one')", "DEFI_CONSTANTE/VALE: expected a number, found 'one'"),
    ("DEFI_CONSTANTE()", "DEFI_CONSTANTE: keyword VALE is missing"),
    ("DEFI_CONSTANTE(1)", "arguments without keyword"),
    ("LIRE_MAILLAGE(UNITE=20)", "unit 20"),
    ("AFFE_MODELE(MAILLAGE=3, AFFE=_F(TOUT='OUI', MODELISATION='3D'))", "expected MeshConcept, found 3"),
    ("1 / 0", "ZeroDivisionError: division by zero"),
    ("undefined", "NameError"),
    ("exit(0)", "called exit"),
])
def test_a_sentence_with_file_and_line(tmp_path, call, sentence):
    with pytest.raises(StudyFailed) as failure:
        execute(tmp_path, f"DEBUT()\n\nx = {call}\n")
    assert "study.comm:3: " in str(failure.value)
    assert sentence in str(failure.value)
    assert "\n" not in str(failure.value)


def test_a_syntax_error_is_told_with_its_line(tmp_path):
    done = run(tmp_path, "DEBUT()\nx = (1,\n")
    assert done.returncode == 2
    assert "study.comm:2: " in done.stderr
    assert "Traceback" not in done.stderr


def test_the_guide_names_every_command():
    guide = (Path(__file__).parents[2] / "docs" / "guide" / "aster.md").read_text()
    assert [name for name in all_commands() if f"`{name}`" not in guide] == []


# ---- the namespace -----------------------------------------------------------------------------------------


def test_concepts_have_the_name_of_their_variable(tmp_path):
    session = execute(tmp_path, """
first = DEFI_LIST_REEL(VALE=(0., 1.))
rows = [None] * 2
for i in range(2):
    rows[i] = DEFI_CONSTANTE(VALE=float(i))
def inside():
    LIST = DEFI_LIST_REEL(VALE=(0.,
                                2.))
    return LIST
given = inside()
""")
    names = session.namespace
    assert names["first"].name == "first"
    assert names["rows"][1].name == "rows[i]"
    assert names["LIST"] is names["given"]  # as Code_Aster's supervisor knows it


def test_mathematics_and_further_stages_share_the_namespace(tmp_path):
    (tmp_path / "study.com1").write_text("POURSUITE()\nsecond = sqrt(first)\nFIN()\n")
    (tmp_path / "study.comm").write_text("DEBUT()\nfirst = 4 * cos(0) * pi / pi\nFIN()\nraise ValueError\n")
    study = read_study(tmp_path / "study.comm")
    session = session_in(tmp_path)
    for path in study.commands:
        session.execute(path)
    assert session.namespace["second"] == 2


def test_include_and_the_form_of_15(tmp_path):
    other = tmp_path / "other"
    other.write_text("value = 3\n")
    file = tmp_path / "study.comm"
    file.write_text("import code_aster\nfrom code_aster.Commands import *\ncode_aster.init('--test')\n"
                    "INCLUDE(UNITE=38)\nc = DEFI_CONSTANTE(VALE=value)\ntest = code_aster.TestCase()\n"
                    "test.assertEqual(value, 3)\ntest.printSummary()\nFIN()\n")
    session = Session(all_commands(), {38: other}, tmp_path)
    session.execute(file)
    assert session.namespace["c"](0) == 3


def test_expected_errors_are_caught_by_the_file(tmp_path):
    session = execute(tmp_path, """
import aster
try:
    DEFI_CONSTANTE(VALE='x')
except aster.error as error:
    caught = str(error)
""")
    assert "expected a number" in session.namespace["caught"]


def test_sympy_and_the_like_may_be_absent(tmp_path):
    session = execute(tmp_path, "try:\n    import a_module_that_is_not_there\n    there = True\nexcept ImportError:\n"
                                "    there = False\n")
    assert session.namespace["there"] is False


# ---- studies -----------------------------------------------------------------------------------------------


def test_an_export_file_names_the_files(tmp_path):
    for name in ("a.comm", "a.com1", "m.mmed", "lib.py"):
        (tmp_path / name).write_text("x\n")
    (tmp_path / "s.export").write_text("P time_limit 60\nP actions make_etude\nF comm a.comm D 1\nF comm a.com1 D 1\n"
                                       "F mmed m.mmed D 20\nF libr lib.py D 38\nF resu a.resu R 8\nF libr out.txt R 40\n")
    study = read_study(tmp_path / "s.export")
    assert [path.name for path in study.commands] == ["a.comm", "a.com1"]
    assert {unit: path.name for unit, path in study.units.items()} == {20: "m.mmed", 38: "lib.py"}
    assert study.time_limit == 60
    assert study.outputs[40].name == "out.txt"


@pytest.mark.parametrize("text, sentence", [
    ("P time_limit 60\n", "there is no command file"),
    ("F comm nothing.comm D 1\n", "s.export:1: there is no file"),
    ("F comm s.comm D one\n", "s.export:1: expected the number of a unit"),
    ("P time_limit soon\nF comm s.comm D 1\n", "s.export:1: expected a number for time_limit"),
])
def test_what_is_wrong_with_an_export_file(tmp_path, text, sentence):
    (tmp_path / "s.comm").write_text("FIN()\n")
    (tmp_path / "s.export").write_text(text)
    with pytest.raises(StudyFailed, match=sentence):
        read_study(tmp_path / "s.export")


def test_relative_paths_are_in_the_run_folder(tmp_path):
    done = run(tmp_path, "open('written', 'w').close()\n", "-o", "results")
    assert done.returncode == 0
    assert (tmp_path / "results" / "written").exists()


# ---- limits ------------------------------------------------------------------------------------------------


def test_a_file_that_never_ends_is_stopped(tmp_path):
    done = run(tmp_path, "while True:\n    pass\n", "--time", "1")
    assert done.returncode == 4
    assert "The study was stopped: it takes more than 1 s; --time gives it more." in done.stderr


def test_a_file_that_takes_all_memory_is_stopped(tmp_path):
    done = run(tmp_path, "x = []\nwhile True:\n    x.append(bytearray(10**7))\n", "--memory", "600")
    assert done.returncode == 4
    assert "memory" in done.stderr
    assert "Traceback" not in done.stderr


def test_a_process_that_the_file_starts_ends_with_it(tmp_path):
    done = run(tmp_path, "import os, time\nif os.fork() == 0:\n    time.sleep(100)\nelse:\n    while True:\n"
                         "        pass\n", "--time", "1")
    assert done.returncode == 4


# ---- the whole ---------------------------------------------------------------------------------------------


def test_a_block_in_compression_from_its_mesh_file(tmp_path):
    (tmp_path / "study.mail").write_text(MESH)
    done = run(tmp_path, """DEBUT()
mesh = LIRE_MAILLAGE(FORMAT='ASTER')
model = AFFE_MODELE(MAILLAGE=mesh, AFFE=_F(TOUT='OUI', PHENOMENE='MECANIQUE', MODELISATION='C_PLAN'))
steel = DEFI_MATERIAU(ELAS=_F(E=1000., NU=0.))
material = AFFE_MATERIAU(MAILLAGE=mesh, AFFE=_F(TOUT='OUI', MATER=steel))
held = AFFE_CHAR_MECA(MODELE=model, DDL_IMPO=_F(GROUP_MA='bottom', DX=0., DY=0.))
load = AFFE_CHAR_MECA(MODELE=model, PRES_REP=_F(GROUP_MA='top', PRES=10.))
result = MECA_STATIQUE(MODELE=model, CHAM_MATER=material, EXCIT=(_F(CHARGE=held), _F(CHARGE=load)))
TEST_RESU(RESU=_F(RESULTAT=result, NOM_CHAM='DEPL', NOM_CMP='DY', NOEUD='N3', NUME_ORDRE=1, REFERENCE='ANALYTIQUE',
                  VALE_CALC=-0.01, VALE_REFE=-0.01, CRITERE='RELATIF', PRECISION=1e-9))
TEST_RESU(RESU=_F(RESULTAT=result, NOM_CHAM='DEPL', NOM_CMP='DY', NOEUD='N4', NUME_ORDRE=1, REFERENCE='ANALYTIQUE',
                  VALE_CALC=-0.01, VALE_REFE=WRONG, CRITERE='RELATIF', PRECISION=1e-9))
FIN()
""".replace("WRONG", "-0.01"))
    assert done.returncode == 0, done.stderr
    assert "OK" in done.stdout
    wrong = run(tmp_path, (tmp_path / "study.comm").read_text().replace("VALE_REFE=-0.01, CRITERE='RELATIF', "
                                                                        "PRECISION=1e-9))\nFIN", "VALE_REFE=-0.02, "
                                                                        "CRITERE='RELATIF', PRECISION=1e-9))\nFIN"))
    assert wrong.returncode == 1
    assert "NOOK" in wrong.stdout


def test_a_step_that_is_not_solved_leaves_what_was_before(tmp_path):
    """A block that only friction holds is pulled off: the first half of the pull is solved."""
    (tmp_path / "study.mail").write_text(BLOCKS)
    text = """DEBUT()
mesh = LIRE_MAILLAGE(FORMAT='ASTER')
model = AFFE_MODELE(MAILLAGE=mesh, AFFE=_F(TOUT='OUI', PHENOMENE='MECANIQUE', MODELISATION='C_PLAN'))
steel = DEFI_MATERIAU(ELAS=_F(E=1000., NU=0.))
material = AFFE_MATERIAU(MAILLAGE=mesh, AFFE=_F(TOUT='OUI', MATER=steel))
held = AFFE_CHAR_MECA(MODELE=model, DDL_IMPO=_F(GROUP_MA='bottom', DX=0., DY=0.))
press = AFFE_CHAR_MECA(MODELE=model, PRES_REP=_F(GROUP_MA='top', PRES=10.))
pull = AFFE_CHAR_MECA(MODELE=model, FORCE_CONTOUR=_F(GROUP_MA='top', FX=4.))
ramp = DEFI_FONCTION(NOM_PARA='INST', VALE=(0., 0., 2., 2.), PROL_DROITE='LINEAIRE')
steps = DEFI_LIST_REEL(DEBUT=0., INTERVALLE=_F(JUSQU_A=2., NOMBRE=4))
contact = DEFI_CONTACT(MODELE=model, FORMULATION='CONTINUE', FROTTEMENT='COULOMB',
                       ZONE=_F(GROUP_MA_MAIT='lower', GROUP_MA_ESCL='upper', COULOMB=0.5))
part = STAT_NON_LINE(MODELE=model, CHAM_MATER=material, CONTACT=contact, INCREMENT=_F(LIST_INST=steps),
                     EXCIT=(_F(CHARGE=held), _F(CHARGE=press), _F(CHARGE=pull, FONC_MULT=ramp)))
FIN()
"""
    done = run(tmp_path, text, "-o", "results")
    assert done.returncode == 3
    assert "study.comm:13: STAT_NON_LINE: " in done.stderr
    assert "What was solved before is in part.med." in done.stderr
    assert (tmp_path / "results" / "part.med").stat().st_size > 0
    caught = text.replace("part = STAT", "import aster\ntry:\n  part = STAT").replace(
        "FIN()", "except aster.NonConvergenceError:\n  solved = part.LIST_VARI_ACCES()['INST']\nassert solved[-1] == 1.0")
    done = run(tmp_path, caught, "-o", "results")
    assert done.returncode == 0, done.stderr


BLOCKS = """COOR_2D
A1 0. 0.
A2 1. 0.
A3 1. 1.
A4 0. 1.
B1 0. 1.
B2 1. 1.
B3 1. 2.
B4 0. 2.
FINSF
QUAD4
M1 A1 A2 A3 A4
M2 B1 B2 B3 B4
FINSF
SEG2
S1 A1 A2
S2 A3 A4
S3 B1 B2
S4 B3 B4
FINSF
GROUP_MA
bottom S1
FINSF
GROUP_MA
lower S2
FINSF
GROUP_MA
upper S3
FINSF
GROUP_MA
top S4
FINSF
FIN
"""
