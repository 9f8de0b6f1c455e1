# SPDX-License-Identifier: LGPL-3.0-or-later
"""Readers of CalculiX's .frd and .dat files, written from their description, for tests."""

import re
import struct

NODES_OF_TYPE = {1: 8, 2: 6, 3: 4, 4: 20, 5: 15, 6: 10, 7: 3, 8: 6, 9: 4, 10: 8, 11: 2, 12: 3}


class Frd:
    """nodes: number -> place; cells: number -> (type, nodes); blocks: name, time, step, values by node."""

    def __init__(self, path):
        self.data = path.read_bytes()
        self.at = 0
        self.nodes, self.cells, self.blocks, self.head = {}, {}, [], []
        while True:
            line = self.line()
            if line == " 9999":
                break
            if line.startswith("    2C"):
                self.read_nodes(int(line[24:36]), int(line[-1]))
            elif line.startswith("    3C"):
                self.read_cells(int(line[24:36]), int(line[-1]))
            elif line.startswith("    1PSTEP"):
                self.read_block(line)
            else:
                self.head.append(line)
        assert self.at == len(self.data), "nothing follows the last line"

    def line(self):
        end = self.data.index(b"\n", self.at)
        text = self.data[self.at : end].decode()
        self.at = end + 1
        return text

    def unpack(self, form):
        size = struct.calcsize(form)
        values = struct.unpack_from(form, self.data, self.at)
        self.at += size
        return values

    def read_nodes(self, count, form):
        for _ in range(count):
            if form == 3:
                number, *place = self.unpack("<i3d")
            else:
                line = self.line()
                assert line[:3] == " -1"
                number, place = int(line[3:13]), numbers(line[13:])
            self.nodes[number] = tuple(place)
        assert form == 3 or self.line() == " -3"

    def read_cells(self, count, form):
        for _ in range(count):
            if form == 2:
                number, kind, _group, _material = self.unpack("<4i")
                nodes = self.unpack(f"<{NODES_OF_TYPE[kind]}i")
            else:
                number, kind, _group, _material = map(int, self.line()[3:].split())
                nodes = []
                while len(nodes) < NODES_OF_TYPE[kind]:
                    line = self.line()
                    assert line[:3] == " -2"
                    nodes += [int(line[i : i + 10]) for i in range(3, len(line), 10)]
            self.cells[number] = (kind, tuple(nodes))
        assert form == 2 or self.line() == " -3"

    def read_block(self, first):
        second = self.line()
        name = self.line()
        components = [self.line()[5:13].strip() for _ in range(int(name[13:18]))]
        components = [component for component in components if component != "ALL"]
        values = {}
        binary = int(second[-1]) == 2
        for _ in range(int(second[24:36])):
            if binary:
                number, *row = self.unpack(f"<i{len(components)}f")
            else:
                line = self.line()
                assert line[:3] == " -1"
                number, row = int(line[3:13]), numbers(line[13:])
            values[number] = tuple(row)
        assert binary or self.line() == " -3"
        number, increment, step = map(int, first[10:].split())
        self.blocks.append(
            {
                "name": name[5:13].strip(),
                "components": components,
                "time": float(second[12:24]),
                "instant": int(second[58:63]),
                "number": number,
                "increment": increment,
                "step": step,
                "values": values,
            }
        )

    def last(self, name):
        return [block for block in self.blocks if block["name"] == name][-1]


def numbers(text):
    return [float(text[i : i + 12]) for i in range(0, len(text), 12)]


def tables(path):
    """Of each table of a .dat file its heading, instant and rows of numbers as text."""
    found = []
    for line in path.read_text().splitlines():
        heading = re.match(r" ([a-z].*?) *time +(\S+)$", line)
        if heading:
            found.append((heading[1], float(heading[2]), []))
        elif line.strip() and found and not re.search("[a-z]", line):
            found[-1][2].append(line)
    return found


def layout(text):
    """A file with its numbers masked: what must be equal when values differ."""
    return re.sub(r"[ -]\d\.\d+E[+-]\d\d", "#", text)
