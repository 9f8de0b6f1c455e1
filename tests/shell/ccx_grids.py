# SPDX-License-Identifier: LGPL-3.0-or-later
"""Inputs for CalculiX of boxes that are cut into elements."""

# Nodes of a cube of side 2, of its corners and then of the middles of its edges, in Abaqus' order.
CORNERS = [(0, 0, 0), (2, 0, 0), (2, 2, 0), (0, 2, 0), (0, 0, 2), (2, 0, 2), (2, 2, 2), (0, 2, 2)]
EDGES = [(0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4), (0, 4), (1, 5), (2, 6), (3, 7)]
# Cells that a cube is cut into: their corners, and pairs of these with a node between.
TETRAHEDRA = [(0, 1, 2, 6), (0, 2, 3, 6), (0, 3, 7, 6), (0, 7, 4, 6), (0, 4, 5, 6), (0, 5, 1, 6)]
TETRAHEDRON_EDGES = [(0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3)]
PRISMS = [(0, 1, 2, 4, 5, 6), (0, 2, 3, 4, 6, 7)]
PRISM_EDGES = [(0, 1), (1, 2), (2, 0), (3, 4), (4, 5), (5, 3), (0, 3), (1, 4), (2, 5)]
SHAPES = {
    "C3D8": ([range(8)], []), "C3D20": ([range(8)], EDGES),
    "C3D4": (TETRAHEDRA, []), "C3D10": (TETRAHEDRA, TETRAHEDRON_EDGES),
    "C3D6": (PRISMS, []), "C3D15": (PRISMS, PRISM_EDGES),
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


def elset(name, numbers):
    return nset(name, numbers).replace("*NSET, NSET", "*ELSET, ELSET")


ELASTIC = "*ELASTIC\n2e5, 0.3\n"
PRINT = "*NODE PRINT, NSET=ALL\nU\n*NODE PRINT, NSET=FIX, TOTALS=ONLY\nRF\n*END STEP\n"


def blocks(kind, behaviour, procedure="*STEP\n*STATIC\n0.5, 1.\n", friction="", push="0.", cut=1, layers=1, law=ELASTIC, down="-0.01"):
    """A block pressed on a wider one, each edge cut into `cut` times as many; with one layer in plane strain."""
    divisions = (12 * cut, 4 * cut, layers), (6 * cut, 2 * cut, layers)
    low, up = Grid(kind, divisions[0], (6, 2, 1)), Grid(kind, divisions[1], (3, 1, 1))
    first = 10 ** len(str(len(low.numbers)))
    text = low.text(name="LOW") + up.text(first, (1.5, 2, 0), "UP")
    text += nset("FIX", low.where(1, 0)) + nset("ROOF", [first + n for n in up.where(1, 1)])
    text += nset("ALL", [first + n for n in up.numbers.values()])
    text += nset("FLAT", sorted([*low.numbers.values(), *(first + n for n in up.numbers.values())]))
    text += elset("TOPS", [n + 1 for n in range(len(low.elements)) if n // (12 * cut) % (4 * cut) == 4 * cut - 1])
    text += elset("SOLES", [first + n + 1 for n in range(len(up.elements)) if n // (6 * cut) % (2 * cut) == 0])
    text += "*SURFACE, NAME=OVER\nTOPS, S5\n*SURFACE, NAME=UNDER\nSOLES, S3\n"
    text += f"*MATERIAL, NAME=M\n{law}*SOLID SECTION, ELSET=LOW, MATERIAL=M\n"
    text += "*SOLID SECTION, ELSET=UP, MATERIAL=M\n*SURFACE INTERACTION, NAME=I\n" + behaviour + friction
    text += "*CONTACT PAIR, INTERACTION=I, TYPE=SURFACE TO SURFACE\nUNDER, OVER\n"
    flat = "FLAT, 3, 3\n" if layers == 1 else "ROOF, 3, 3\n"
    return text + procedure + "*BOUNDARY\nFIX, 1, 3\n" + flat + f"ROOF, 1, 1, {push}\nROOF, 2, 2, {down}\n" + PRINT
