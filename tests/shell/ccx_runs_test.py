# SPDX-License-Identifier: LGPL-3.0-or-later
"""Own .inp files, each run by rubato and by CalculiX (CCX=1): displacements and forces of their .dat files agree."""

import re
import shutil
import subprocess

import ccx_files
import corpus
import pytest
from ccx_grids import PRINT, Grid, blocks, nset

if shutil.which("ccx") is None:
    pytest.skip("CalculiX is missing (make deps CCX=1)", allow_module_level=True)

STEEL = "*MATERIAL, NAME=M\n*ELASTIC\n2e5, 0.3\n*DENSITY\n7.8e-9\n*SOLID SECTION, ELSET=E, MATERIAL=M\n"


def bar(kind, material=STEEL, divisions=(4, 2, 1), low=(0, 0, 0), size=(8, 2, 1)):
    """A bar along x whose end is held; of plane elements one layer."""
    grid = Grid(kind, divisions if kind.startswith("C3D") else (*divisions[:2], 1), size)
    if not kind.startswith("C3D"):
        grid.numbers = {place: number for place, number in grid.numbers.items() if place[2] == 0}
    plane = "" if kind.startswith("C3D") else "1.\n"
    sets = nset("FIX", grid.where(0, 0)) + nset("TIP", grid.where(0, 1)) + nset("ALL", sorted(grid.numbers.values()))
    return grid.text(low=low) + sets + material + (plane if kind.startswith("CP") else "")


def held(kind):
    return "*BOUNDARY\nFIX, 1, 3\n" if kind.startswith("C3D") else "*BOUNDARY\nFIX, 1, 2\n"


def pulled(kind):
    force = "*CLOAD\nTIP, 1, 30.\nTIP, 2, -5.\n"
    return force + ("TIP, 3, 2.\n" if kind.startswith("C3D") else "")


def static(kind, loads=None, procedure="*STEP\n*STATIC\n1., 1.\n", **more):
    return bar(kind, **more) + procedure + held(kind) + (loads or pulled(kind)) + PRINT


def last_of(path, heading):
    found = [rows for words, _, rows in ccx_files.tables(path) if words.startswith(heading)]
    assert found, f"{path} has no table of {heading}"
    return [[float(word) for word in row.split()] for row in found[-1]]


def largest_difference(ours, theirs):
    size = max(abs(x) for row in theirs for x in row)
    return max(abs(a - b) for r, s in zip(ours, theirs, strict=True) for a, b in zip(r, s, strict=True)) / size


def compare(folder, text, tolerance, forces=True):
    (folder / "a.inp").write_text(text)
    done = subprocess.run(["ccx", "a"], cwd=folder, text=True, capture_output=True, timeout=600)
    assert "Job finished" in done.stdout, done.stdout[-2000:]
    code, _, errors = corpus.outcome("run", str(folder / "a.inp"), "-o", str(folder / "out"))
    assert code == 0, errors
    ours, theirs = folder / "out/a.dat", folder / "a.dat"
    rows = [[row[1:] for row in sorted(last_of(path, "displacements"))] for path in (ours, theirs)]
    assert largest_difference(*rows) < tolerance
    if forces:
        assert largest_difference(last_of(ours, "total force"), last_of(theirs, "total force")) < tolerance


SOLIDS = ["C3D4", "C3D10", "C3D6", "C3D15", "C3D8", "C3D20", "C3D20R"]
PLANE = ["CPE4", "CPE8", "CPE8R"]
RINGS = ["CAX4", "CAX8", "CAX8R"]
EQUAL = 2e-6  # numbers of .dat files have seven digits
NUMBER = re.compile(r"[ -]\d\.\d+E[+-]\d\d")


@pytest.mark.parametrize("kind", SOLIDS + PLANE)
def test_forces_on_nodes(tmp_path, kind):
    compare(tmp_path, static(kind), EQUAL)


@pytest.mark.parametrize("kind", SOLIDS)
def test_weight(tmp_path, kind):
    compare(tmp_path, static(kind, "*DLOAD\nE, GRAV, 9810., 0.6, 0., -0.8\n"), EQUAL)


@pytest.mark.parametrize("kind", ["C3D8", "C3D20", "C3D20R"])
def test_pressure_on_a_face_of_every_element(tmp_path, kind):
    compare(tmp_path, static(kind, "*DLOAD\nE, P1, 3.\n"), EQUAL)


@pytest.mark.parametrize("kind", RINGS)
def test_rings(tmp_path, kind):
    """CalculiX turns rings into wedges of two degrees with straight sides."""
    text = bar(kind, low=(10, 0, 0), divisions=(3, 2, 1)).replace("*STEP", "")
    compare(tmp_path, text + "*STEP\n*STATIC\n1., 1.\n*BOUNDARY\nFIX, 1, 2\n*CLOAD\nTIP, 2, -5.\n" + PRINT, 1e-4 if "8" in kind else 5e-3, forces=False)


@pytest.mark.parametrize("kind", ["C3D8I"])
def test_incompatible_modes(tmp_path, kind):
    compare(tmp_path, static(kind), 5e-3)


@pytest.mark.parametrize("kind", SOLIDS)
def test_large_deflections(tmp_path, kind):
    loads = "*CLOAD\nTIP, 2, -800.\n"
    compare(tmp_path, static(kind, loads, "*STEP, NLGEOM\n*STATIC\n0.25, 1.\n"), 2e-5)


@pytest.mark.parametrize("kind", ["C3D10", "C3D6", "C3D15", "C3D8", "C3D20", "C3D20R"])
def test_plastic_bars(tmp_path, kind):
    material = STEEL.replace("*DENSITY", "*PLASTIC\n250., 0.\n300., 0.05\n*DENSITY")
    loads = "*BOUNDARY\nTIP, 1, 1, 0.05\n"
    compare(tmp_path, static(kind, loads, "*STEP\n*STATIC\n0.1, 1.\n", material=material), 5e-3)


RUBBERS = {
    "NEO HOOKE": "1., 0.02", "MOONEY-RIVLIN": "0.8, 0.2, 0.02", "YEOH": "1., 0.1, 0.02, 0.02, 0.02, 0.02",
}


@pytest.mark.parametrize("law", ["NEO HOOKE", "MOONEY-RIVLIN"])
@pytest.mark.parametrize("kind", ["C3D8", "C3D20R"])
def test_rubber(tmp_path, law, kind):
    material = f"*MATERIAL, NAME=M\n*HYPERELASTIC, {law}\n{RUBBERS[law]}\n*SOLID SECTION, ELSET=E, MATERIAL=M\n"
    loads = "*BOUNDARY\nTIP, 1, 1, 2.\n"
    compare(tmp_path, static(kind, loads, "*STEP, NLGEOM\n*STATIC\n0.1, 1.\n", material=material), 1e-3)


@pytest.mark.parametrize("kind", ["C3D8", "C3D20", "C3D20R"])
def test_motions(tmp_path, kind):
    loads = "*CLOAD\nTIP, 2, -5.\n"
    dynamic = "*STEP, INC=1000\n*DYNAMIC, DIRECT, ALPHA=-0.05\n2e-6, 1e-4\n"
    text = static(kind, loads, dynamic).replace("*NODE PRINT", "*NODE PRINT, FREQUENCY=1000")
    compare(tmp_path, text, 1e-3, forces=False)


@pytest.mark.parametrize("kind", ["C3D8", "C3D20", "C3D20R"])
@pytest.mark.parametrize("slope", ["1e7", "1e8"])
def test_pressed_blocks(tmp_path, kind, slope):
    text = blocks(kind, f"*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR\n{slope}\n")
    compare(tmp_path, text, 1e-2)


@pytest.mark.parametrize("kind", ["C3D8", "C3D20"])
def test_blocks_of_exponential_pressure(tmp_path, kind):
    """Gaps are within the clearance, where laws differ most."""
    compare(tmp_path, blocks(kind, "*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=EXPONENTIAL\n2e-3, 100.\n"), 1e-2)


@pytest.mark.parametrize("kind", ["C3D8", "C3D20"])
def test_blocks_that_friction_holds(tmp_path, kind):
    behaviour = "*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR\n1e7\n"
    compare(tmp_path, blocks(kind, behaviour, friction="*FRICTION\n0.5, 1e7\n", push="0.0005"), 2e-2)


@pytest.mark.parametrize("kind", ["C3D8", "C3D20R"])
def test_steps_one_after_another(tmp_path, kind):
    second = "*STEP\n*STATIC\n1., 1.\n*CLOAD, OP=NEW\nTIP, 3, 7.\n*DLOAD\nE, P2, 1.\n" + PRINT
    compare(tmp_path, static(kind) + second, EQUAL)


@pytest.mark.parametrize("kind", ["C3D10", "C3D8"])
def test_large_steps_one_after_another(tmp_path, kind):
    first = static(kind, "*CLOAD\nTIP, 2, -800.\n", "*STEP, NLGEOM\n*STATIC\n0.25, 1.\n")
    second = "*STEP, NLGEOM\n*STATIC\n0.25, 1.\n*CLOAD\nTIP, 3, 100.\n" + PRINT
    compare(tmp_path, first + second, 1e-3)  # CalculiX accepts residuals of 0.5 %


@pytest.mark.parametrize("kind", ["C3D8", "C3D20"])
def test_temperatures(tmp_path, kind):
    material = STEEL.replace("*DENSITY", "*EXPANSION\n1e-5\n*DENSITY")
    start = "*INITIAL CONDITIONS, TYPE=TEMPERATURE\nALL, 20.\n"
    text = static(kind, "*TEMPERATURE\nALL, 120.\n", material=material).replace("*STEP\n", start + "*STEP\n", 1)
    compare(tmp_path, text, EQUAL, forces=False)


@pytest.mark.parametrize("kind", ["C3D10", "C3D8", "C3D20", "C3D20R"])
def test_equations(tmp_path, kind):
    grid = Grid(kind, (4, 2, 1), (8, 2, 1))
    first, *others = grid.where(0, 1)
    ties = "".join(f"*EQUATION\n2\n{node}, 1, 1., {first}, 1, -1.\n" for node in others)
    text = static(kind, f"*CLOAD\n{first}, 1, 100.\n").replace("*STEP\n", ties + "*STEP\n", 1)
    compare(tmp_path, text, EQUAL)


def numbers_of(words, rows):
    """The values of a table of modes in one list."""
    first = 2 if words.startswith("stresses") else 0 if words.startswith("total") else 1
    return [float(word) for row in rows if "E I G" not in row for word in row.split()[first:]]


@pytest.mark.parametrize("kind", ["C3D8", "C3D20"])
def test_modes(tmp_path, kind):
    """Frequencies, participation and the displacements, forces and stresses of each mode, whose sign is free."""
    requests = "*NODE PRINT, NSET=TIP\nU\n*NODE PRINT, NSET=FIX, TOTALS=ONLY\nRF\n*EL PRINT, ELSET=E\nS\n*END STEP\n"
    (tmp_path / "a.inp").write_text(bar(kind) + "*STEP\n*FREQUENCY\n4\n" + held(kind) + requests)
    subprocess.run(["ccx", "a"], cwd=tmp_path, capture_output=True, timeout=600, check=True)
    code, _, errors = corpus.outcome("run", str(tmp_path / "a.inp"), "-o", str(tmp_path / "out"))
    assert code == 0, errors
    ours, theirs = ((tmp_path / place / "a.dat").read_text() for place in ("out", "."))
    heads = [text.split("E I G E N V A L U E    N U M B E R")[0].split("\n     ") for text in (ours, theirs)]
    for mine, other in zip(*heads, strict=True):
        assert NUMBER.sub("#", mine) == NUMBER.sub("#", other)
        rows = [[[abs(float(word)) for word in NUMBER.findall(text)]] for text in (mine, other)]
        if rows[1] != [[]]:
            assert largest_difference(*rows) < EQUAL, other
    tables = [ccx_files.tables(tmp_path / place / "a.dat") for place in ("out", ".")]
    assert [words for words, _, _ in tables[0]] == [words for words, _, _ in tables[1]]
    assert len(tables[0]) == 12
    largest = {words: max(abs(x) for other, _, rows in tables[1] if other == words for x in numbers_of(other, rows)) for words, _, _ in tables[1]}
    for (words, _, mine), (_, _, others) in zip(*tables, strict=True):
        pairs = list(zip(numbers_of(words, mine), numbers_of(words, others), strict=True))
        apart = min(max(abs(a - sign * b) for a, b in pairs) for sign in (1, -1))
        assert apart < 1e-5 * largest[words], words
