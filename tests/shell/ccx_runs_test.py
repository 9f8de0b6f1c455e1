# SPDX-License-Identifier: LGPL-3.0-or-later
"""Own .inp files, each run by rubato and by CalculiX (CCX=1): displacements and forces of their .dat files agree."""

import shutil
import subprocess

import ccx_files
import corpus
import pytest

if shutil.which("ccx") is None:
    pytest.skip("CalculiX is missing (make deps CCX=1)", allow_module_level=True)

# Nodes of a cube of side 2, of its corners and then of the middles of its edges, in Abaqus' order.
CORNERS = [(0, 0, 0), (2, 0, 0), (2, 2, 0), (0, 2, 0), (0, 0, 2), (2, 0, 2), (2, 2, 2), (0, 2, 2)]
EDGES = [(0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4), (0, 4), (1, 5), (2, 6), (3, 7)]
# Cells that a cube is cut into: their corners, and pairs of these with a node between.
TETRAHEDRA = [(0, 1, 2, 6), (0, 2, 3, 6), (0, 3, 7, 6), (0, 7, 4, 6), (0, 4, 5, 6), (0, 5, 1, 6)]
TETRAHEDRON_EDGES = [(0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3)]
SHAPES = {
    "C3D8": ([range(8)], []), "C3D20": ([range(8)], EDGES),
    "C3D4": (TETRAHEDRA, []), "C3D10": (TETRAHEDRA, TETRAHEDRON_EDGES),
}
PLANE_EDGES = EDGES[:4]


def middle(a, b):
    return tuple((x + y) // 2 for x, y in zip(a, b, strict=True))


class Grid:
    """Elements of one type in a box; `numbers` of nodes by twice their place in cells."""

    def __init__(self, kind, divisions, size):
        self.kind, self.divisions, self.size = kind, divisions, size
        self.numbers, self.elements = {}, []
        for k in range(divisions[2]):
            for j in range(divisions[1]):
                for i in range(divisions[0]):
                    self.cut((2 * i, 2 * j, 2 * k))

    def cut(self, at):
        base = self.kind.rstrip("RI")
        plane = not base.startswith("C3D")
        if plane:
            cells, edges = [range(4)], PLANE_EDGES if base.endswith("8") else []
        else:
            cells, edges = SHAPES[base]
        for cell in cells:
            corners = [tuple(a + b for a, b in zip(at, CORNERS[c], strict=True)) for c in cell]
            places = corners + [middle(corners[a], corners[b]) for a, b in edges]
            self.elements.append([self.numbers.setdefault(place, len(self.numbers) + 1) for place in places])

    def where(self, axis, side):
        wanted = 2 * self.divisions[axis] * side
        return sorted(number for place, number in self.numbers.items() if place[axis] == wanted)

    def text(self, first=0, low=(0, 0, 0), name="E"):
        lines = ["*NODE, NSET=N" + name]
        for place, number in self.numbers.items():
            x = [a + s * p / (2 * n) for a, s, p, n in zip(low, self.size, place, self.divisions, strict=True)]
            lines.append(f"{first + number}, {x[0]:.9g}, {x[1]:.9g}, {x[2]:.9g}")
        lines.append(f"*ELEMENT, TYPE={self.kind}, ELSET={name}")
        for number, nodes in enumerate(self.elements):
            words = [str(first + 1 + number)] + [str(first + node) for node in nodes]
            lines += [", ".join(words[:14]) + ("," if len(words) > 14 else "")]
            lines += [", ".join(words[14:])] if len(words) > 14 else []
        return "\n".join(lines) + "\n"


def nset(name, numbers):
    rows = [", ".join(map(str, numbers[i : i + 12])) for i in range(0, len(numbers), 12)]
    return f"*NSET, NSET={name}\n" + ",\n".join(rows) + "\n"


STEEL = "*MATERIAL, NAME=M\n*ELASTIC\n2e5, 0.3\n*DENSITY\n7.8e-9\n*SOLID SECTION, ELSET=E, MATERIAL=M\n"
PRINT = "*NODE PRINT, NSET=ALL\nU\n*NODE PRINT, NSET=FIX, TOTALS=ONLY\nRF\n*END STEP\n"


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


SOLIDS = ["C3D4", "C3D10", "C3D8", "C3D20", "C3D20R"]
PLANE = ["CPE4", "CPE8", "CPE8R"]
RINGS = ["CAX4", "CAX8", "CAX8R"]
EQUAL = 2e-6  # numbers of .dat files have seven digits


@pytest.mark.parametrize("kind", SOLIDS + PLANE)
def test_forces_on_nodes(tmp_path, kind):
    compare(tmp_path, static(kind), EQUAL)


@pytest.mark.parametrize("kind", ["C3D4", "C3D10", "C3D8", "C3D20", "C3D20R"])
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


@pytest.mark.parametrize("kind", ["C3D10", "C3D8", "C3D20", "C3D20R"])
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


def elset(name, numbers):
    return nset(name, numbers).replace("*NSET, NSET", "*ELSET, ELSET")


def blocks(kind, behaviour, procedure="*STEP\n*STATIC\n0.5, 1.\n", friction="", push=""):
    """A block pressed on a wider one: nodes of the upper one begin at 1000."""
    low, up = Grid(kind, (12, 4, 1), (6, 2, 1)), Grid(kind, (6, 2, 1), (3, 1, 1))
    text = low.text(name="LOW") + up.text(1000, (1.5, 2, 0), "UP")
    text += nset("FIX", low.where(1, 0)) + nset("ROOF", [1000 + n for n in up.where(1, 1)])
    text += nset("ALL", [1000 + n for n in up.numbers.values()])
    text += nset("FLAT", sorted([*low.numbers.values(), *(1000 + n for n in up.numbers.values())]))
    top = [n + 1 for n in range(len(low.elements)) if n // 12 == 3]
    text += elset("TOPS", top)
    text += elset("SOLES", [1000 + n + 1 for n in range(len(up.elements)) if n // 6 == 0])
    text += "*SURFACE, NAME=OVER\nTOPS, S5\n*SURFACE, NAME=UNDER\nSOLES, S3\n"
    text += "*MATERIAL, NAME=M\n*ELASTIC\n2e5, 0.3\n*SOLID SECTION, ELSET=LOW, MATERIAL=M\n"
    text += "*SOLID SECTION, ELSET=UP, MATERIAL=M\n*SURFACE INTERACTION, NAME=I\n" + behaviour + friction
    text += "*CONTACT PAIR, INTERACTION=I, TYPE=SURFACE TO SURFACE\nUNDER, OVER\n"
    return text + procedure + "*BOUNDARY\nFIX, 1, 3\nFLAT, 3, 3\nROOF, 1, 1, " + (push or "0.") + "\nROOF, 2, 2, -0.01\n" + PRINT


@pytest.mark.parametrize("kind", ["C3D8", "C3D20", "C3D20R"])
@pytest.mark.parametrize("slope", ["1e7", "1e8"])
def test_pressed_blocks(tmp_path, kind, slope):
    text = blocks(kind, f"*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR\n{slope}\n")
    compare(tmp_path, text, 1e-2)


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
