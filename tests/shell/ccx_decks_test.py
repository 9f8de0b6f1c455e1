# SPDX-License-Identifier: LGPL-3.0-or-later
"""Decks written as input files of CalculiX: CalculiX' displacements and forces, and those of the file read back."""

import copy
import csv
import json
import re
import shutil
import subprocess

import ccx_files
import corpus
import pytest

STEEL = {"young": 2e5, "poisson": 0.3, "density": 7.8e-9}
STATIC = {"scheme": "static", "step": 1, "end": 1}
RAMP = {"ramp": {"times": [0, 1], "values": [0, 1]}}
TABLES = {"tables": [{"nodes": "all", "quantities": ["U"], "every": 100000},
                     {"nodes": "clamped", "quantities": ["RF"], "totals": "only", "every": 100000}]}


def bar(cells="hexa8", divisions=(4, 2, 2), material=None, **more):
    """A bar along x, held at its left side."""
    solid = not cells.startswith(("tria", "quad"))
    end = [4, 1, 1] if solid else [4, 1]
    sides = {"left": "clamped", "right": "tip", "top": "roof", "bottom": "floor"}
    points = {"right_top_front": "corner"} if solid else {"right_top": "corner"}
    shape = {"box" if solid else "rectangle": {"from": [0] * len(end), "to": end}}
    body = {"name": "bar", **shape, "divisions": list(divisions)[: len(end)], "cells": cells, "sides": sides, "points": points}
    deck = {
        "title": "bar", "physics": "solid" if solid else "plane_strain", "mesh": {"generate": [body]},
        "materials": {"steel": material or STEEL}, "supports": [{"on": "clamped", "fix": ["x", "y", "z"][: len(end)]}],
        "loads": [{"nodal_force": {"on": "tip", "x": 30, "y": -5}}], "time": STATIC,
        "probes": {"corner": {"node": "corner"}}, "fields": TABLES,
    }
    return deck | more


def moved(deck, **functions):
    """The deck with its bodies at another place."""
    deck = copy.deepcopy(deck)
    for body in deck["mesh"]["generate"]:
        shape = body.get("rectangle") or body["box"]
        for side in ("from", "to"):
            shape[side] = [a + b for a, b in zip(shape[side], functions["by"], strict=True)]
    return deck


def blocks(cells="quad8", friction=0.0, **zone):
    """A block pressed on a wider one and pushed aside."""
    up = {"name": "up", "rectangle": {"from": [1.5, 2], "to": [4.5, 3]}, "divisions": [6, 2], "cells": cells,
          "sides": {"bottom": "sole", "top": "lid"}, "points": {"left_top": "corner"}}
    low = {"name": "low", "rectangle": {"from": [0, 0], "to": [6, 2]}, "divisions": [12, 4], "cells": cells,
           "sides": {"bottom": "clamped", "top": "table"}}
    return {
        "physics": "plane_strain", "mesh": {"generate": [low, up]}, "materials": {"steel": STEEL},
        "functions": RAMP,
        "supports": [{"on": "clamped", "fix": ["x", "y"]}, {"on": "lid", "x": {"value": 0.002, "function": "ramp"},
                                                            "y": {"value": -0.01, "function": "ramp"}}],
        "contact": {"joint": {"master": "table", "slave": "sole", "friction": friction, **zone}},
        "time": {"scheme": "static", "step": 0.1, "end": 1}, "probes": {"corner": {"node": "corner"}}, "fields": TABLES,
    }


def cubes(cells="hexa8", **zone):
    """A block on a wider one, in space."""
    up = {"name": "up", "box": {"from": [1, 1, 1], "to": [3, 2, 2]}, "divisions": [4, 2, 2], "cells": cells,
          "sides": {"back": "sole", "front": "lid"}, "points": {"left_top_front": "corner"}}
    low = {"name": "low", "box": {"from": [0, 0, 0], "to": [4, 3, 1]}, "divisions": [4, 3, 1], "cells": cells,
           "sides": {"back": "clamped", "front": "table"}}
    deck = blocks(**zone)
    motion = {"x": {"value": 0.002, "function": "ramp"}, "y": 0, "z": {"value": -0.01, "function": "ramp"}}
    return deck | {"physics": "solid", "mesh": {"generate": [low, up]}, "supports": [
        {"on": "clamped", "fix": ["x", "y", "z"]}, {"on": "lid", **motion}]}


def tied(deck):
    deck["contact"]["joint"] = {"master": "table", "slave": "sole", "tie": True}
    return deck | {"time": STATIC}


def on_plane(deck, slave, normal):
    """The upper block alone, pressed on a plane that moves."""
    up = deck["mesh"]["generate"][1]
    least = up.get("rectangle", up.get("box"))["from"]
    wall = {"plane": {"point": least, "normal": normal}, "move": {"x": {"value": 0.001, "function": "ramp"}}}
    return deck | {"mesh": {"generate": [up | {"sides": up["sides"] | {"left": "clamped"}}]}, "supports": deck["supports"][1:],
                   "contact": {"joint": {"obstacle": wall, "slave": slave, "friction": 0.3}}, "fields": {"tables": TABLES["tables"][:1]}}


def ring_on_plane():
    """A ring that a plane compresses."""
    disc = {"name": "disc", "rectangle": {"from": [0.2, 0], "to": [1, 0.5]}, "divisions": [8, 4], "cells": "quad8",
            "sides": {"top": "lid", "bottom": "clamped"}, "points": {"right_top": "corner"}}
    plane = {"plane": {"point": [0, 0.5], "normal": [0, -1]}, "move": {"y": {"value": -0.01, "function": "ramp"}}}
    return blocks() | {"physics": "axisymmetric", "mesh": {"generate": [disc]},
                       "supports": [{"on": "clamped", "fix": ["x", "y"]}],
                       "contact": {"joint": {"obstacle": plane, "slave": "lid"}}, "fields": {"tables": TABLES["tables"][:1]}}


def pulled(value, axes="xyz"):
    """The bar's end is moved along x over ten steps."""
    return {"functions": RAMP, "time": {"scheme": "static", "step": 0.1, "end": 1}, "loads": [], "supports": [
        {"on": "clamped", "fix": list(axes)}, {"on": "tip", "x": {"value": value, "function": "ramp"}}]}


EXACT = 2e-6  # numbers of .dat files have seven digits
NEAR = 1e-2
AGAIN = 1e-9

WOOD = {"law": "orthotropic", "young_x": 1e4, "young_y": 500, "young_z": 800, "poisson_xy": 0.4, "poisson_yz": 0.3,
        "poisson_xz": 0.35, "shear_xy": 700, "shear_yz": 60, "shear_xz": 650, "angle_z": 30, "angle_y": 20}
ROUND = {key: value for key, value in WOOD.items() if "angle" not in key} | {"axes": {"cylindrical": {
    "point": [2, -3, 0], "direction": [0, 0, 1]}}}
PLASTIC = STEEL | {"law": "plastic", "hardening": {"linear": {"yield_stress": 250, "modulus": 1000}}, "formulation": "full"}
RUBBER = {"law": "hyperelastic", "c10": 0.8, "c01": 0.2, "bulk": 100, "volumetric": "quadratic", "formulation": "full"}
YEOH = {"law": "yeoh", "c10": 0.8, "c20": 0.1, "c30": 0.02, "bulk": 100, "volumetric": "quadratic", "formulation": "full"}
OGDEN = {"law": "ogden", "terms": [{"shear": 1.2, "exponent": 1.5}, {"shear": 0.1, "exponent": 4}], "bulk": 100,
         "volumetric": "quadratic", "formulation": "full"}
WARM = STEEL | {"expansion": 1e-5, "reference_temperature": 20}
TABLE = {"on": "corner", "along": [0, 1, 0], "force": {"elongations": [-1, -0.001, 0, 1], "forces": [-1000, -30, 0, 10]}}
PRESSED = [{"pressure": {"on": "roof", "value": 3}}]
FINITE = STEEL | {"strain": "green_lagrange"}
DYNAMIC = {"scheme": "hht", "alpha": -0.05, "step": 2e-6, "end": 1e-4}

# Deck; how near CalculiX' results are; how near those of the file that is read back are.
CASES = {
    "plane strain": (bar("quad4"), EXACT, AGAIN),
    "plane strain, quadratic": (bar("quad8", loads=PRESSED), EXACT, AGAIN),
    "plane stress": (bar("quad8", physics="plane_stress", thickness=0.1), 1e-3, AGAIN),
    "triangles": (bar("tria6"), EXACT, AGAIN),
    "rings": (moved(bar("quad8", physics="axisymmetric", loads=PRESSED), by=[10, 0]), 1e-3, AGAIN),
    "bricks": (bar("hexa8", loads=[*PRESSED, {"gravity": {"y": -9810}}]), EXACT, AGAIN),
    "bricks, quadratic": (bar("hexa20", divisions=(3, 1, 1), loads=PRESSED), EXACT, AGAIN),
    "bricks, reduced": (bar("hexa20", divisions=(3, 2, 2), material=STEEL | {"formulation": "reduced"}), EXACT, AGAIN),
    "bricks, enhanced": (bar("hexa8", material=STEEL | {"formulation": "enhanced"}), NEAR, AGAIN),
    "tetrahedra": (bar("tetra10", loads=[{"gravity": {"y": -9810}}]), EXACT, AGAIN),
    "pressure on each side": (bar("hexa8", loads=[{"pressure": {"on": side, "value": value}} for side, value in (
        ("roof", 3), ("floor", 1), ("tip", 2))]), EXACT, AGAIN),
    "prisms under pressure": (bar("penta6", loads=PRESSED, material=STEEL | {"formulation": "reduced"}), EXACT, AGAIN),
    "prisms": (bar("penta15", material=STEEL | {"formulation": "reduced"}), EXACT, AGAIN),
    "a pressure that depends on the place": (bar("hexa8", loads=[{"pressure": {"on": "roof", "value": "3*x^2"}}]), EXACT, AGAIN),
    "two forces on the same nodes": (bar("hexa8", functions=RAMP, loads=[
        {"nodal_force": {"on": "tip", "y": -5, "function": "ramp"}}, {"nodal_force": {"on": "corner", "y": 2}}]), EXACT, AGAIN),
    "orthotropic": (bar("hexa20", divisions=(3, 1, 1), material=WOOD), EXACT, AGAIN),
    "warm": (bar("hexa8", material=WARM, loads=[], temperature=[{"on": "all", "value": 120}]), EXACT, AGAIN),
    "plastic": (bar("hexa8", material=PLASTIC, **pulled(0.02)), EXACT, AGAIN),
    "rubber": (bar("hexa8", material=RUBBER, **pulled(1.0)), EXACT, AGAIN),
    "yeoh": (bar("hexa8", material=YEOH, **pulled(1.0)), EXACT, AGAIN),
    "ogden": (bar("hexa8", material=OGDEN, **pulled(1.0)), EXACT, AGAIN),
    "hardening by a table": (bar("hexa20", material=PLASTIC | {"hardening": {
        "table": [[0, 250], [0.01, 300], [0.05, 310]]}}, divisions=(2, 1, 1), **pulled(0.02)), EXACT, AGAIN),
    "large deflections": (bar("hexa20", divisions=(3, 1, 1), material=FINITE, functions=RAMP,
                              time={"scheme": "static", "step": 0.25, "end": 1},
                              loads=[{"pressure": {"on": "roof", "value": 300, "function": "ramp", "follower": True}}]), 1e-3, AGAIN),
    "motion": (bar("hexa8", time=DYNAMIC), 5e-3, AGAIN),
    "motion in the plane": (bar("quad8", time=DYNAMIC), 5e-3, AGAIN),
    "cells that keep their volume": (bar("quad4", divisions=(6, 3), material=PLASTIC | {"formulation": "mean_dilatation"},
                                         **pulled(0.02, "xy")), 6e-2, None),
    "rubber that keeps its volume": (bar("hexa8", material=RUBBER | {"formulation": "mean_dilatation"}, **pulled(0.5)), 3e-2, None),
    "damped motion": (bar("hexa8", time=DYNAMIC, material=STEEL | {"rayleigh": {"mass": 1e4, "stiffness": 1e-6}}), 2e-2, AGAIN),
    "a body that flies": (bar("hexa8", supports=[], time=DYNAMIC | {"alpha": 0}, loads=[], fields={"tables": TABLES["tables"][:1]},
                              initial=[{"on": "bar", "velocity": {"x": 100, "y": 3}}]), 1e-4, AGAIN),
    "equation": (bar("hexa8", relations={"even": {"equal": {"on": "tip", "in": ["x"]}}, "one": {"equation": {
        "terms": [{"on": "corner", "y": 1, "z": -2}], "value": 0.01}}}), EXACT, AGAIN),
    "coupling": (bar("hexa8", relations={"head": {"rigid": {"on": "tip", "at": [5, 0.5, 0.5]}}}, loads=[
        {"nodal_force": {"on": "head", "y": -20}}, {"moment": {"on": "head", "x": 7, "z": 3}}]), EXACT, AGAIN),
    "distributed coupling": (bar("hexa8", relations={"head": {"distributed": {"on": "tip", "at": [5, 0.5, 0.5]}}}, supports=[
        {"on": "clamped", "fix": ["x", "y", "z"]}, {"on": "head", "x": 0.01}], loads=[{"moment": {"on": "head", "x": 7, "z": 3}}]), EXACT, AGAIN),
    "springs": (bar("hexa8", springs=[{"on": "roof", "y": 1000}], connectors=[
        {"on": "corner", "along": [1, 2, 2], "stiffness": 3000}]), EXACT, AGAIN),
    "springs between nodes": (bar("hexa8", connectors=[{"on": "corner", "to": "N2", "stiffness": 4e4}]), EXACT, AGAIN),
    "springs by a table": (bar("hexa8", material=FINITE, connectors=[TABLE]), 5e-4, AGAIN),
    "springs that rotate": (bar("hexa8", material=FINITE, connectors=[
        {"on": "corner", "to": "N1", "stiffness": 4e4, "rotates": True},
        {"on": "corner", "anchor": [4, 3, 1], "stiffness": 4e4, "rotates": True}]), EXACT, AGAIN),
    "pairs and faces that are held along their normals": (bar("hexa8", relations={
        "p": {"pairs": {"on": "roof", "with": "floor", "difference": {"y": 0.01}}}}, loads=[{"nodal_force": {"on": "tip", "x": 1}}],
        supports=[{"on": "N1", "fix": ["y", "z"]}, {"on": "N31", "fix": ["y"]}, {"on": "clamped", "along": "normal", "value": 0}]), EXACT, AGAIN),
    "axes about a line": (bar("hexa20", divisions=(2, 2, 2), material=ROUND), EXACT, AGAIN),
    "supports by place and time": (bar("hexa8", time={"scheme": "static", "step": 0.25, "end": 1}, supports=[
        {"on": "clamped", "fix": ["x", "y", "z"]}, {"on": "tip", "x": "1e-2*sin(3*t)*y"}]), EXACT, AGAIN),
    "springs in the plane": (bar("quad4", springs=[{"on": "roof", "y": 1000}]), EXACT, AGAIN),
    "slanted support": (bar("hexa8", supports=[{"on": "clamped", "fix": ["x", "y", "z"]},
                                               {"on": "corner", "along": [1, 1, 0], "value": 0.02}]), EXACT, AGAIN),
    "masses": (bar("hexa8", time=DYNAMIC, masses=[{"on": "tip", "mass": 1e-8}]), 1e-3, AGAIN),
    "contact": (blocks(), NEAR, None),
    "contact with friction": (blocks(friction=0.3), 2e-2, None),
    "contact by a penalty": (blocks(method="penalty", coefficients={"normal": 1e7}), NEAR, None),
    "contact in space": (cubes(friction=0.3), 3e-2, None),
    "contact of quadratic cells": (cubes("hexa20"), NEAR, None),
    "a plane in space": (on_plane(cubes(), "sole", [0, 0, 1]), 3e-2, None),
    "a plane": (on_plane(blocks(), "sole", [0, 1]), 2e-2, None),
    "rings in contact": (moved(blocks(), by=[10, 0]) | {"physics": "axisymmetric"}, NEAR, None),
    "a ring on a plane": (ring_on_plane(), NEAR, None),
    "tie": (tied(cubes()), EXACT, None),
    "tie in the plane": (tied(blocks()), NEAR, None),
}


def last_of(path, heading):
    found = [rows for words, _, rows in ccx_files.tables(path) if words.startswith(heading)]
    assert found, f"{path} has no table of {heading}"
    return [[float(word) for word in row.split()] for row in found[-1]]


def difference(ours, theirs):
    size = max([abs(x) for row in theirs for x in row] + [1e-6])
    return max(abs(a - b) for r, s in zip(ours, theirs, strict=True) for a, b in zip(r, s, strict=True)) / size


def last_probe(path):
    with path.open(encoding="utf-8") as file:
        rows = list(csv.reader(line for line in file if not line.startswith("#")))
    return {key.lower().replace("_u", ""): float(value) for key, value in zip(rows[0], rows[-1], strict=True)}


def write(folder, deck, *options):
    (folder / "a.yaml").write_text(json.dumps(deck))
    return corpus.outcome("deck", str(folder / "a.yaml"), "-o", str(folder / "a.inp"), *options)


def by_ccx(folder):
    if shutil.which("ccx") is None:
        pytest.skip("CalculiX is missing (make deps CCX=1)")
    done = subprocess.run(["ccx", "a"], cwd=folder, text=True, capture_output=True, timeout=60, check=False)
    assert "Job finished" in done.stdout, done.stdout[-2000:]
    return folder / "a.dat"


def own(folder):
    code, _, errors = corpus.outcome("run", str(folder / "a.yaml"), "-o", str(folder / "own"))
    assert code == 0, errors
    return folder / "own/run"


@pytest.mark.parametrize("name", CASES)
def test_ccx_has_the_same_results(tmp_path, name):
    deck, tolerance, _ = CASES[name]
    code, _, errors = write(tmp_path, deck)
    assert code == 0, errors
    theirs, ours = by_ccx(tmp_path), own(tmp_path) / "tables.dat"
    wanted = {row[0]: row[1:] for row in last_of(ours, "displacements")}
    found = {row[0]: row[1:] for row in last_of(theirs, "displacements (vx,vy,vz) for set NALL")}
    assert difference([wanted[n] for n in wanted], [found[n] for n in wanted]) < tolerance
    if "clamped" in str(deck["supports"]) and deck["physics"] != "axisymmetric":
        totals = [last_of(path, "total force") for path in (ours, theirs)]
        assert difference(*totals) < tolerance


@pytest.mark.parametrize("name", [name for name in CASES if CASES[name][2]])
def test_the_file_read_back_has_the_same_results(tmp_path, name):
    deck, _, tolerance = CASES[name]
    assert write(tmp_path, deck)[0] == 0
    code, _, errors = corpus.outcome("run", str(tmp_path / "a.inp"), "-o", str(tmp_path / "back"))
    assert code == 0, errors
    wanted, found = last_probe(own(tmp_path) / "probes.csv"), last_probe(tmp_path / "back/run/probes.csv")
    size = max(abs(value) for key, value in wanted.items() if key != "t")
    for key in [key for key in wanted if key.startswith("corner")]:
        assert abs(wanted[key] - found[key]) < tolerance * size, key


def test_runs_that_follow_one_another(tmp_path):
    deck = bar("hexa8") | {"runs": {"first": {}, "second": {"time": {"begin": 1, "end": 2, "start": {"from": "first"}}, "loads": [
        {"nodal_force": {"on": "tip", "z": 7}}, {"pressure": {"on": "roof", "value": 3}}, {"gravity": {"y": 1e7}}]}}}
    code, _, errors = write(tmp_path, deck)
    assert code == 0, errors
    theirs = by_ccx(tmp_path)
    assert corpus.outcome("run", str(tmp_path / "a.yaml"), "-o", str(tmp_path / "own"))[0] == 0
    assert corpus.outcome("run", str(tmp_path / "a.inp"), "-o", str(tmp_path / "back"))[0] == 0
    wanted = {row[0]: row[1:] for row in last_of(tmp_path / "own/second/tables.dat", "displacements")}
    found = {row[0]: row[1:] for row in last_of(theirs, "displacements (vx,vy,vz) for set NALL")}
    assert difference([wanted[n] for n in wanted], [found[n] for n in wanted]) < EXACT
    again = {row[0]: row[1:] for row in last_of(tmp_path / "back/a.dat", "displacements (vx,vy,vz) for set NALL")}
    assert difference([wanted[n] for n in wanted], [again[n] for n in wanted]) < EXACT


@pytest.mark.parametrize("cells", ["hexa8", "hexa20", "quad8"])
def test_natural_modes(tmp_path, cells):
    code, _, errors = write(tmp_path, bar(cells), "--modes", "5")
    assert code == 0, errors
    theirs = by_ccx(tmp_path)
    code, output, errors = corpus.outcome("modes", str(tmp_path / "a.yaml"), "--number", "5", "-o", str(tmp_path / "own"))
    assert code == 0, errors
    rows = re.findall(r"^ +(\d+) +0\.\d+E[+-]\d+ +\S+ +(\S+) ", theirs.read_text(), re.MULTILINE)
    with (tmp_path / "own/run/modes.csv").open(encoding="utf-8") as file:
        own = list(csv.DictReader(line for line in file if not line.startswith("#")))
    wanted = [float(row["frequency"]) for row in own]
    found = [float(row[1]) for row in rows[:5]]
    assert found == pytest.approx(wanted, rel=EXACT)


REFUSED = {
    "base_motion": ({"base_motion": {"y": {"acceleration": "sin(t)"}}, "time": DYNAMIC}, "found a moving base"),
    "explicit": ({"time": {"scheme": "central_difference", "step": "auto", "end": 1e-4, "record": 1e-5}}, "found central_difference"),
    "energy": ({"time": {"scheme": "energy_momentum", "step": 1e-6, "end": 1e-5}, "materials": {"steel": FINITE}}, "found energy_momentum"),
    "newmark": ({"time": {"scheme": "newmark", "beta": 0.3, "gamma": 0.6, "step": 1e-6, "end": 1e-5}}, "found beta 0.3 and gamma 0.6"),
    "until": ({"supports": [{"on": "clamped", "fix": ["x", "y", "z"]}, {"on": "corner", "fix": ["z"], "until": 0.5}]},
              "found the end of a support within a run"),
    "obstacle": ({"contact": {"wall": {"obstacle": {"sphere": {"point": [0, -2, 0], "radius": 1}}, "slave": "floor"}}},
                 "found an obstacle"),
    "place": ({"materials": {"steel": STEEL | {"young": "2e5+x"}}}, "found a value that depends on the place"),
    "cells": ({"mesh": bar("hexa27")["mesh"]}, "found HEXA27 cells"),
    "prony": ({"materials": {"steel": {"law": "prony", "young": 2e5, "poisson": 0.3, "terms": [{"shear": 1e4, "time": 1}]}}}, "found the law prony"),
    "kinematic": ({"materials": {"steel": PLASTIC | {"kinematic": [{"modulus": 1000}]}}}, "found kinematic hardening"),
    "place and time": ({"loads": [{"pressure": {"on": "roof", "value": "x*t"}}]}, "a value that changes with place and time at once"),
    "table": ({"connectors": [TABLE]}, "CalculiX takes tables of springs with NLGEOM alone"),
    "dashpot": ({"connectors": [{"on": "corner", "along": [1, 0, 0], "damping": 1}], "time": DYNAMIC}, "dashpots of CalculiX"),
    "motions in the plane": (bar("quad4", time=DYNAMIC), "found motions of linear cells in the plane"),
    "initial displacement": ({"time": DYNAMIC, "initial": [{"on": "tip", "displacement": {"x": 0.001}}]},
                             "found displacements at the begin of a motion"),
    "nodes without contact": (cubes(exclude_nodes=["corner", "sole"]) | {"loads": []}, "without contact, which no support holds"),
    "surfaces on the axis": (blocks() | {"physics": "axisymmetric", "loads": []}, "faces that end on the axis; CalculiX misses contact"),
    "gap": (cubes(gap=0.1) | {"loads": []}, "found a distance that is added to that of the meshes"),
}


@pytest.mark.parametrize("name", REFUSED)
def test_what_does_not_map_is_refused(tmp_path, name):
    changes, sentence = REFUSED[name]
    (tmp_path / "a.inp").write_text("before")
    code, _, errors = write(tmp_path, bar("hexa8") | changes)
    assert code == 2, errors
    assert sentence in errors
    assert "a.yaml:1:" in errors
    assert (tmp_path / "a.inp").read_text() == "before"


def test_notes_are_the_head_of_the_file(tmp_path):
    code, _, errors = write(tmp_path, bar("hexa8", material=STEEL | {"formulation": "enhanced"}))
    assert code == 0
    assert "C3D8I has other incompatible modes than 'enhanced'" in errors
    assert (tmp_path / "a.inp").read_text().startswith("** C3D8I has other incompatible modes")


def test_names_that_calculix_takes(tmp_path):
    deck = bar("hexa8")
    deck["mesh"]["generate"][0]["sides"] |= {"front": "1st side", "back": "Tip"}
    deck["mesh"]["generate"].append({"name": "other", "box": {"from": [0, 0, 5], "to": [1, 1, 6]}, "divisions": [1, 1, 1],
                                     "sides": {"left": "clamped"}})
    deck["materials"] = {"steel": STEEL | {"cells": "bar"}, "Steel": STEEL | {"cells": "other"}}
    code, _, errors = write(tmp_path, deck)
    assert code == 0
    assert "1st side is N1st_side" in errors
    text = (tmp_path / "a.inp").read_text()
    assert "NSET=N1st_side\n" in text
    assert "*MATERIAL, NAME=steel_2\n" in text or "*MATERIAL, NAME=Steel_2\n" in text
    assert "NSET=Tip_2\n" in text or "NSET=tip_2\n" in text
    by_ccx(tmp_path)


OWN_INPUTS = ["c3d8", "c3d20r", "cpe4", "cax8", "amplitudes", "relations", "gravity", "rigid_body", "two_steps", "preloaded", "points", "orientation"]


@pytest.mark.parametrize("name", OWN_INPUTS)
def test_inputs_are_written_again(tmp_path, name):
    """What rubato computes of an input file, it computes of the one that it writes of its study."""
    source = corpus.SOURCES / f"tests/inp/{name}.inp"
    code, _, errors = corpus.outcome("deck", str(source), "-o", str(tmp_path / "a.inp"))
    assert code == 0, errors
    for path, folder in ((source, "own"), (tmp_path / "a.inp", "back")):
        code, _, errors = corpus.outcome("run", str(path), "-o", str(tmp_path / folder))
        assert code in (0, 1), errors
    runs = sorted(path.name for path in (tmp_path / "own").iterdir() if (path / "probes.csv").exists())
    again = sorted(path.name for path in (tmp_path / "back").iterdir() if (path / "probes.csv").exists())
    assert len(runs) == len(again) > 0
    for one, other in zip(runs, again, strict=True):
        wanted, found = last_probe(tmp_path / "own" / one / "probes.csv"), last_probe(tmp_path / "back" / other / "probes.csv")
        shared = [key for key in wanted if key in found and key != "t"]
        size = max([abs(wanted[key]) for key in shared] + [1e-300])
        assert all(abs(wanted[key] - found[key]) < AGAIN * size for key in shared)
    by_ccx(tmp_path)


COMMENTED = """** by hand
*HEADING
a cube
*NODE, NSET=ALL
1, 0., 0., 0.
2, 1., 0., 0.
3, 1., 1., 0.
4, 0., 1., 0.
5, 0., 0., 1.
6, 1., 0., 1.
7, 1., 1., 1.
8, 0., 1., 1.
*ELEMENT, TYPE=C3D8, ELSET=CUBE
1, 1, 2, 3, 4, 5, 6, 7, 8
*NSET, NSET=LEFT
1, 4, 5, 8
** good steel:
**
**   from the mill
*MATERIAL, NAME=STEEL
*ELASTIC
2e5, 0.3
*SOLID SECTION, ELSET=CUBE, MATERIAL=STEEL
** STEP: pull
*STEP, NAME=pull
*STATIC
1., 1.
** held
*BOUNDARY
LEFT, 1, 3
*CLOAD
2, 1, 10.
** and its pair
3, 1, 10.
*NODE PRINT, NSET=ALL
U
*END STEP
** STEP: push
*STEP, NAME=push
*STATIC
1., 1.
** aside
*CLOAD
6, 2, 1.
*END STEP
"""


def line_after(lines, comment):
    number = next(i for i, line in enumerate(lines) if line.strip() == "# " + comment)
    return next(line.strip() for line in lines[number:] if not line.strip().startswith("#"))


def test_comments_of_an_input_file_stand_before_its_entries(tmp_path):
    (tmp_path / "a.inp").write_text(COMMENTED)
    assert corpus.outcome("deck", str(tmp_path / "a.inp"), "-o", str(tmp_path / "a.yaml"))[0] == 0
    text = (tmp_path / "a.yaml").read_text()
    lines = text.splitlines()
    assert lines[0] == "# by hand"
    assert line_after(lines, "STEP: pull") == '"pull": {'
    assert line_after(lines, "STEP: push") == '"push": {'
    assert line_after(lines, "good steel:") == line_after(lines, "from the mill") == '"STEEL": {'
    whole = corpus.load(text)
    for comment, key in (("held", "supports"), ("and its pair", "loads"), ("aside", "loads")):
        number = next(i for i, line in enumerate(lines) if line.strip() == "# " + comment)
        part = next(line.strip() for line in reversed(lines[:number]) if line.startswith('  "'))
        assert part.startswith(f'"{key}"'), comment
    assert list(whole["runs"]) == ["pull", "push"]
    code, output, errors = corpus.outcome("check", str(tmp_path / "a.yaml"))
    assert code == 0, errors
