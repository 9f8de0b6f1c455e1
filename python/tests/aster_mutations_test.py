# SPDX-License-Identifier: LGPL-3.0-or-later
"""Damaged command files and meshes: each ends with one sentence, in time, and the process goes on."""

from __future__ import annotations

import contextlib
import io
import random
import signal

import pytest

import rubato
from rubato.aster.catalogue import all_commands
from rubato.aster.keys import CommandError
from rubato.aster.mesh.gibi import read_gibi
from rubato.aster.mesh.gmsh import read_gmsh
from rubato.aster.scan import scan
from rubato.aster.session import Session, StudyFailed

# Python's own remarks about damaged files are not of interest.
pytestmark = pytest.mark.filterwarnings("ignore::SyntaxWarning")

# Seconds that one text may take.
LIMIT = 60  # seconds, of one text: far more than any takes

MAIL = """TITRE
 a square with its sides
FINSF
COOR_2D
 N1 0. 0.
 N2 1.D0 0.
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
GROUP_MA NOM=BODY
 M1
FINSF
GROUP_MA
 LOWER M2
FINSF
GROUP_MA
 UPPER M3
FINSF
GROUP_NO
 LEFT N4 N1
FINSF
FIN
"""

STUDY = """# a study that does not solve
DEBUT(CODE=_F(NIV_PUB_WEB='INTERNET'))

mesh = LIRE_MAILLAGE(FORMAT='ASTER', UNITE=20, VERI_MAIL=_F(VERIF='OUI'))
mesh = DEFI_GROUP(reuse=mesh, MAILLAGE=mesh,
                  CREA_GROUP_NO=(_F(GROUP_MA=('LOWER', 'UPPER')),
                                 _F(OPTION='NOEUD_ORDO', NOM='LINE', GROUP_MA='UPPER', NOEUD_ORIG='N4'),
                                 _F(UNION=('LOWER', 'LEFT'), NOM='BOTH'),
                                 _F(OPTION='PLAN', POINT=(0., 1.), VECT_NORMALE=(0., 1.), PRECISION=1.E-6, NOM='H')),
                  CREA_GROUP_MA=_F(NOM='ALL', TOUT='OUI', TYPE_MAILLE='2D'))
mesh = MODI_MAILLAGE(reuse=mesh, MAILLAGE=mesh, ORIE_PEAU_2D=_F(GROUP_MA=('LOWER', 'UPPER')), ECHELLE=2.)
fine = CREA_MAILLAGE(MAILLAGE=mesh, LINE_QUAD=_F(TOUT='OUI'))
MACR_ADAP_MAIL(ADAPTATION='RAFFINEMENT_UNIFORME', MAILLAGE_N=fine, MAILLAGE_NP1=CO('finer'))

instants = DEFI_LIST_REEL(DEBUT=-1., INTERVALLE=(_F(JUSQU_A=0., NOMBRE=1), _F(JUSQU_A=1., PAS=0.25)))
steps = DEFI_LIST_INST(DEFI_LIST=_F(LIST_INST=instants), ECHEC=_F(SUBD_PAS=4, SUBD_NIVEAU=3, SUBD_PAS_MINI=1.E-3))
ramp = DEFI_FONCTION(NOM_PARA='INST', VALE=(-1., 0., 0., 0., 1., 1.), PROL_DROITE='LINEAIRE')
square = FORMULE(NOM_PARA=('X', 'Y'), VALE='a * X**2 + sqrt(abs(Y))', a=3.)
other = CALC_FONCTION(COMB=(_F(FONCTION=ramp, COEF=2.), _F(FONCTION=ramp, COEF=-1.)))
rows = CALC_FONC_INTERP(FONCTION=ramp, LIST_PARA=instants, NOM_PARA='INST')

def height(x):
    return square(x, 2.) if x > 0 else [0.] * 3

for i in range(3):
    value = height(1. + i)
model = AFFE_MODELE(MAILLAGE=mesh, AFFE=_F(TOUT='OUI', PHENOMENE='MECANIQUE', MODELISATION='D_PLAN'))
steel = DEFI_MATERIAU(ELAS=_F(E=2.E11, NU=0.3, RHO=7800.))
parts = AFFE_MATERIAU(MAILLAGE=mesh, AFFE=_F(TOUT='OUI', MATER=steel))
held = AFFE_CHAR_MECA(MODELE=model, DDL_IMPO=(_F(GROUP_MA='LOWER', DX=0., DY=0.), _F(GROUP_MA='UPPER', DY=-0.1)),
                      PRES_REP=_F(GROUP_MA='UPPER', PRES=1.E6))
contact = DEFI_CONTACT(MODELE=model, FORMULATION='CONTINUE', FROTTEMENT='COULOMB',
                       ZONE=_F(GROUP_MA_MAIT='UPPER', GROUP_MA_ESCL='LOWER', COULOMB=0.3))
numbers = CREA_TABLE(LISTE=(_F(PARA='INST', LISTE_R=(0., 1.)), _F(PARA='DX', LISTE_R=(1., 2.))))
TEST_TABLE(TABLE=numbers, NOM_PARA='DX', VALE_CALC=2., REFERENCE='ANALYTIQUE', VALE_REFE=2.,
           FILTRE=_F(NOM_PARA='INST', VALE=1.))
DETRUIRE(CONCEPT=_F(NOM=rows))
FIN()
"""

GMSH = """$NOD
4
1 0 0 0
2 1 0 0
3 1 1 0
7 0 1 0
$ENDNOD
$ELM
3
1 15 4 1 1 2
5 2 2 1 3 1 2 3
9 2 2 1 3 1 3 7
$ENDELM
"""

GIBI = """ ENREGISTREMENT DE TYPE   4
 NIVEAU  15 NIVEAU ERREUR   0 DIMENSION   2
 DENSITE 0.00000E+00
 ENREGISTREMENT DE TYPE   2
 PILE NUMERO   1NBRE OBJETS NOMMES       1NBRE OBJETS       1
 ALL
       1
       8       0       0       4       1
       0
       1       2       3       4
 ENREGISTREMENT DE TYPE   2
 PILE NUMERO  32NBRE OBJETS NOMMES       0NBRE OBJETS       4
       4
       1       2       3       4
 ENREGISTREMENT DE TYPE   2
 PILE NUMERO  33NBRE OBJETS NOMMES       0NBRE OBJETS       4
      12
  0.00000000000000E+00  0.00000000000000E+00  0.00000000000000E+00
  1.00000000000000E+00  0.00000000000000E+00  0.00000000000000E+00
  1.00000000000000E+00  1.00000000000000E+00  0.00000000000000E+00
  0.00000000000000E+00  1.00000000000000E+00  0.00000000000000E+00
 ENREGISTREMENT DE TYPE   5
"""

WORDS = ("_F(", ")", "(", ",", "=", "'", '"', "None", "-1", "0", "1e308", "nan", "'NON'", "()", "[]", "{}", "\n", "\t",
         "%", "é", "\0", "FINSF", "N1", "lambda: 0", "mesh", "X" * 30, "2147483648", "-0.", "for", "$", "#")


def damaged(text: str, chance: random.Random) -> str:
    """The text with one to four changes of characters, words or lines."""
    for _ in range(chance.randint(1, 4)):
        at = chance.randrange(len(text) + 1) if text else 0
        end = min(len(text), at + chance.choice((1, 1, 1, 3, 10, 60)))
        way = chance.randrange(6)
        if way == 0:
            text = text[:at] + text[end:]
        elif way == 1:
            text = text[:at] + chance.choice(WORDS) + text[at:]
        elif way == 2:
            text = text[:at] + chance.choice(WORDS) + text[end:]
        elif way == 3:
            text = text[:end] + text[at:]
        elif way == 4:
            text = "".join(without_one(text.splitlines(keepends=True), chance))
        else:
            text = text[:at] + text[at:at + 1].swapcase() + text[at + 1:]
    return text[:chance.randrange(len(text) + 1)] if chance.random() < 0.02 else text


def without_one(lines: list[str], chance: random.Random) -> list[str]:
    """Lines without one of them, or out of order."""
    if chance.random() < 0.1:
        chance.shuffle(lines)
    elif lines:
        lines.pop(chance.randrange(len(lines)))
    return lines


class TooLong(BaseException):
    """A text took more than its time."""


@contextlib.contextmanager
def limited():
    def stop(number, frame):
        raise TooLong

    before = signal.signal(signal.SIGALRM, stop)
    signal.alarm(LIMIT)
    try:
        with contextlib.redirect_stdout(io.StringIO()):
            yield
    finally:
        signal.alarm(0)
        signal.signal(signal.SIGALRM, before)


def is_a_sentence(text: str) -> bool:
    return bool(text.strip()) and "\n" not in text.strip() and "Traceback" not in text


def failure_of(work, *kinds: type[BaseException]) -> str | None:
    with limited():
        try:
            work()
        except kinds as error:
            return str(error)
    return None


def test_the_undamaged_texts_are_sound(tmp_path):
    (tmp_path / "mesh.mail").write_text(MAIL)
    (tmp_path / "study.comm").write_text(STUDY)
    commands = all_commands()
    assert scan(tmp_path / "study.comm", commands)[0] == []
    Session(commands, {20: tmp_path / "mesh.mail"}, tmp_path).execute(tmp_path / "study.comm")
    assert rubato.read_mesh(tmp_path / "mesh.mail").node_count == 4
    for text, read in ((GMSH, read_gmsh), (GIBI, read_gibi)):
        (tmp_path / "mesh").write_text(text)
        assert read(tmp_path / "mesh").node_count == 4


def test_damaged_command_files(tmp_path):
    chance = random.Random(1)
    commands = all_commands()
    (tmp_path / "mesh.mail").write_text(MAIL)
    file = tmp_path / "study.comm"
    executed = 0
    for number in range(2000):
        text = damaged(STUDY, chance)
        file.write_text(text, errors="surrogatepass")
        found: list = []
        failure = failure_of(lambda: found.extend(scan(file, commands)[0]), StudyFailed)
        sentences = [str(finding) for finding in found] + ([] if failure is None else [failure])
        if not sentences:
            session = Session(commands, {20: tmp_path / "mesh.mail"}, tmp_path)
            failure = failure_of(lambda: session.execute(file), StudyFailed)
            sentences = [] if failure is None else [failure]
            executed += 1
        assert all(is_a_sentence(sentence) for sentence in sentences), (number, sentences)
    assert executed > 500


@pytest.mark.parametrize("text, read, seed, count", [
    (MAIL, rubato.read_mesh, 2, 2000), (GMSH, read_gmsh, 3, 400), (GIBI, read_gibi, 4, 400)],
    ids=["mail", "gmsh", "gibi"])
def test_damaged_meshes(tmp_path, text, read, seed, count):
    chance = random.Random(seed)
    file = tmp_path / "mesh.mail"
    failed = 0
    for number in range(count):
        file.write_text(damaged(text, chance), errors="surrogatepass")
        failure = failure_of(lambda: read(file), rubato.InputError, CommandError)
        failed += failure is not None
        assert failure is None or is_a_sentence(failure), (number, failure)
    assert failed > count // 4
