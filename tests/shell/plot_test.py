# SPDX-License-Identifier: LGPL-3.0-or-later
"""`rubato plot`: pictures read back and held against the tables that they are made of; `rubato check --markdown`."""

import csv
import math
import os
import re
import struct
import subprocess

import corpus
import pytest
from drawing import SVG, Axis, Figure

NAMES = ["beams", "hertz", "impact", "preload", "shrink_fit"]

# A block is pressed on another one and pushed to and fro.
BLOCKS = """title: "blocks < rubbing & sliding"
units: mm, N, MPa
mesh:
  generate:
    - {name: low, rectangle: {from: [0, 0], to: [4, 1]}, divisions: [8, 2], sides: {bottom: ground, top: seat}}
    - {name: up, rectangle: {from: [1, 1], to: [3, 2]}, divisions: [5, 2], cells: quad8, sides: {bottom: foot, top: roof}}
physics: plane_strain
materials: {steel: {young: 200e3, poisson: 0.3}}
supports:
  - {on: ground, fix: [x, y]}
  - {on: roof, y: {value: -1e-3, function: press}, x: {value: 2e-3, function: slide}}
functions: {press: {times: [0, 1], values: [0, 1]}, slide: {times: [1, 2, 4], values: [0, 1, -1]}}
contact: {joint: {master: seat, slave: foot, friction: 0.3}}
time: {scheme: static, step: 0.25, end: 4}
probes:
  roof: {on: roof, take: mean}
  force: {on: roof, take: sum, field: reaction}
  hottest: {on: foot, take: max, field: contact_pressure}
fields: {formats: [vtu], at: [1, 2, 4]}
runs:
  rough: {checks: [{probe: roof.y, at: 1, reference: -1e-3, tolerance: 1e-6, source: analytic, note: "a | b"}]}
  smooth:
    contact: {joint: {friction: 0.1}}
    fields: {formats: [vtu, med]}
    checks: [{probe: force.y, at: 1, reference: -1, tolerance: 1e-6}, {energy: friction, over: max, reference: 1, tolerance: 1e9}]
  bare: {fields: ~, probes: ~}
"""

SOLID = """mesh:
  generate:
    - {name: low, box: {from: [0, 0, 0], to: [1, 1, 0.4]}, divisions: [3, 3, 2], sides: {back: ground, front: seat}}
    - {name: up, box: {from: [0.2, 0.2, 0.4], to: [0.8, 0.8, 0.7]}, divisions: [2, 2, 1], cells: penta15, sides: {back: foot, front: roof}}
physics: solid
materials: {steel: {young: 200e9, poisson: 0.3}}
supports: [{on: ground, fix: [x, y, z]}]
loads: [{pressure: {on: roof, value: 1e8}}]
contact: {joint: {master: seat, slave: foot, friction: 0.3}}
time: {scheme: static, step: 1, end: 1}
fields: {formats: [vtu]}
"""


def rubato(folder, *arguments):
    return subprocess.run([corpus.PROGRAM, *arguments], capture_output=True, text=True, check=False, cwd=folder)


def run_of(folder, deck):
    (folder / "deck.yaml").write_text(deck)
    done = rubato(folder, "run", "deck.yaml", "-q", "-o", "out")
    assert done.returncode in (0, 1), done.stderr
    return folder


@pytest.fixture(scope="module")
def blocks(tmp_path_factory):
    return run_of(tmp_path_factory.mktemp("blocks"), BLOCKS)


@pytest.fixture(scope="module")
def solid(tmp_path_factory):
    return run_of(tmp_path_factory.mktemp("solid"), SOLID)


def drawn(folder, *arguments):
    """The figure of `rubato plot`, and what it says."""
    done = rubato(folder, "plot", *arguments, "-o", "plot.svg")
    assert (done.returncode, done.stdout, done.stderr) == (0, "written to plot.svg\n", "")
    return Figure(folder / "plot.svg")


def table(path):
    with open(path, encoding="utf-8") as file:
        return list(csv.DictReader(file))


def column(rows, name):
    return [float(row[name]) for row in rows]


def tables_of(folder, run):
    run = folder / "out" / run
    return table(run / "probes.csv"), table(run / "energy.csv"), table(run / "resultants_joint.csv")


# ---- histories ------------------------------------------------------------------------------------------------


def test_without_more_every_probe_is_drawn_in_a_panel_for_each_kind(blocks):
    figure = drawn(blocks, "out/rough")
    probes = tables_of(blocks, "rough")[0]
    assert [panel.label for panel in figure.panels] == [
        "displacement [length]",
        "reaction [force]",
        "contact_pressure [force/length²]",
    ]
    for panel in figure.panels:
        assert panel.x.label == "t [time]"
        for curve in panel.curves:
            if not curve.rings:
                panel.expect(curve.label, column(probes, "t"), column(probes, curve.label))
    labels = [curve.label for panel in figure.panels for curve in panel.curves if not curve.rings]
    assert labels == [name for name in probes[0] if name != "t"]


def test_curves_have_the_values_of_probes_energies_and_resultants(blocks):
    figure = drawn(blocks, "out/rough", "--history", "roof.x,energy.friction,joint.normal,force")
    probes, energy, resultants = tables_of(blocks, "rough")
    displacement, work, contact, reaction = figure.panels
    displacement.expect("roof.x", column(probes, "t"), column(probes, "roof.x"))
    work.expect("energy.friction", column(energy, "t"), column(energy, "friction"))
    contact.expect("joint.normal", column(resultants, "t"), column(resultants, "normal"))
    for name in ["force.x", "force.y"]:
        reaction.expect(name, column(probes, "t"), column(probes, name))
    assert [panel.label for panel in figure.panels] == [
        "displacement [length]",
        "energy [force·length]",
        "contact force [force]",
        "reaction [force]",
    ]


def test_title_and_units_are_those_of_the_deck(blocks):
    figure = drawn(blocks, "out/rough", "--history", "roof.x")
    assert figure.title == "blocks < rubbing & sliding (rough)"
    assert "units: mm, N, MPa" in figure.texts and figure.title in figure.texts


def test_two_runs_have_colours_and_their_quantities_dashes(blocks):
    figure = drawn(blocks, "out/rough", "out/smooth", "--history", "force.x,force.y")
    (panel,) = figure.panels
    for run in ["rough", "smooth"]:
        probes = tables_of(blocks, run)[0]
        for name in ["force.x", "force.y"]:
            panel.expect(f"{run}, {name}", column(probes, "t"), column(probes, name))
    styles = {curve.label: curve.style[0] for curve in panel.curves if not curve.rings}
    assert styles["rough, force.x"][0] == styles["rough, force.y"][0] != styles["smooth, force.x"][0]
    assert styles["rough, force.x"][1] is None and styles["rough, force.y"][1] is not None
    assert panel.legend == [*styles, "reference of a check"]
    assert len(set(styles.values())) == 4


def test_a_folder_of_runs_stands_for_its_runs(blocks):
    figure = drawn(blocks, "out", "--history", "joint.normal")
    assert [curve.label for curve in figure.panels[0].curves] == [
        f"{run}, joint.normal" for run in ["bare", "rough", "smooth"]
    ]


def test_runs_of_one_name_are_told_apart_by_their_folders(blocks):
    assert rubato(blocks, "run", "deck.yaml", "-q", "--only", "rough", "-o", "again").returncode == 0
    figure = drawn(blocks, "out/rough", "again/rough", "--history", "roof.x")
    assert {curve.label for curve in figure.panels[0].curves} == {"out/rough, roof.x", "again/rough, roof.x"}


def test_references_of_checks_are_rings_at_their_instants(blocks):
    (panel,) = drawn(blocks, "out/rough", "--history", "roof.y").panels
    (ring,) = [curve for curve in panel.curves if curve.rings]
    ((t, value),) = ring.points
    assert abs(t - 1) < 1e-3 and abs(value + 1e-3) < 1e-6
    assert panel.legend == ["roof.y", "reference of a check"]


def test_one_quantity_over_another_makes_a_loop(blocks):
    figure = drawn(blocks, "out/rough", "--history", "force.x", "--against", "roof.x")
    (panel,) = figure.panels
    probes = tables_of(blocks, "rough")[0]
    panel.expect("force.x", column(probes, "roof.x"), column(probes, "force.x"))
    assert panel.x.label.split("  ")[0] == "roof.x: displacement [length]"


def test_quantities_of_different_tables_meet_at_common_instants(blocks):
    """Resultants have no line for the start."""
    (panel,) = drawn(blocks, "out/rough", "--history", "joint.friction", "--against", "roof.x").panels
    probes, _, resultants = tables_of(blocks, "rough")
    x = {row["t"]: float(row["roof.x"]) for row in probes}
    panel.expect("joint.friction", [x[row["t"]] for row in resultants], column(resultants, "friction"))


def test_a_reference_is_an_expression_of_the_abscissa(blocks):
    (panel,) = drawn(blocks, "out/rough", "--history", "roof.x", "--reference", "1e-3*sin(pi*t)").panels
    points = panel.curve("1e-3*sin(pi*t)").points
    assert len(points) == 401 and abs(points[0][0]) < 1e-3 and abs(points[-1][0] - 4) < 1e-2
    for x, y in points:
        assert abs(y - 1e-3 * math.sin(math.pi * x)) < 1e-5


# ---- along a line ---------------------------------------------------------------------------------------------


def line_of(folder, run, t, name, along="s"):
    rows = [row for row in table(folder / "out" / run / "contact_joint.csv") if float(row["t"]) == t]
    rows.sort(key=lambda row: float(row["s"]))
    return column(rows, along), column(rows, name)


def test_the_pressure_along_a_zone_is_that_of_its_table(blocks):
    figure = drawn(blocks, "out/rough", "--line", "joint", "--at", "1,2")
    (panel,) = figure.panels
    assert panel.label == "joint: pressure [force/length²]"
    assert panel.x.label.split("  ")[0] == "arc length s [length]"
    for t in [1, 2]:
        panel.expect(f"t = {t}", *line_of(blocks, "rough", t, "pressure"))


def test_other_columns_and_axes_and_the_last_instant(blocks):
    (panel,) = drawn(blocks, "out/rough", "out/smooth", "--line", "joint.traction.x", "--along", "x").panels
    for run in ["rough", "smooth"]:
        panel.expect(f"{run}, t = 4", *line_of(blocks, run, 4, "traction.x", "x"))


def test_in_space_points_are_dots_along_the_longest_axis(solid):
    (panel,) = drawn(solid, "out/run", "--line", "joint").panels
    rows = table(solid / "out/run/contact_joint.csv")
    assert panel.x.label == "x [length]" and panel.curves[0].style == []
    panel.expect("t = 1", column(rows, "x"), column(rows, "pressure"))


# ---- deformed bodies ------------------------------------------------------------------------------------------


def bar_of(figure):
    bar = figure.group("colour-bar")
    return Axis(bar, "y")


def test_the_deformed_bodies_are_drawn_at_the_places_of_their_nodes(blocks):
    figure = drawn(blocks, "out/rough", "--field", "displacement.y", "--scale", "100")
    x = Axis(figure.group("x-axis"), "x")
    y = Axis(figure.group("y-axis"), "y")
    outlines = [
        [(x.value(a), y.value(b)) for a, b in (point.split(",") for point in outline.get("points").split())]
        for outline in figure.group("bodies").findall(f"{SVG}polygon")
    ]
    assert len(outlines) == 8 * 2 + 5 * 2
    last = tables_of(blocks, "rough")[0][-1]
    top = max(b for outline in outlines for _, b in outline)
    right = max(a for outline in outlines for a, b in outline if b > 1.95 + 100 * float(last["roof.y"]))
    assert abs(top - (2 + 100 * float(last["roof.y"]))) < 1e-2
    assert abs(right - (3 + 100 * float(last["roof.x"]))) < 1e-2
    assert abs(abs(x.unit) - abs(y.unit)) < 1e-3 * abs(x.unit), "a length is as long in both directions"
    assert "units: mm, N, MPa; displacements enlarged 100 times" in figure.texts
    assert figure.title == "blocks < rubbing & sliding (rough), t = 4"


def test_the_colour_bar_has_the_range_of_the_field(blocks):
    figure = drawn(blocks, "out/rough", "--field", "displacement.y", "--at", "1")
    bar = bar_of(figure)
    assert bar.label.split("  ")[0] == "displacement.y [length]"
    box = figure.group("colour-bar").find(f"{SVG}rect")
    top, height = float(box.get("y")), float(box.get("height"))
    assert abs(bar.value(top + height) + 1e-3) < 1e-5 and abs(bar.value(top)) < 1e-5
    figure = drawn(blocks, "out/rough", "--field", "displacement.y", "--at", "1", "--range", "-2e-3,2e-3")
    bar = bar_of(figure)
    box = figure.group("colour-bar").find(f"{SVG}rect")
    assert abs(bar.value(float(box.get("y"))) - 2e-3) < 1e-5


def test_fields_of_vtu_and_med_make_the_same_picture(blocks):
    """The run smooth has both; where there is MED it is read."""
    with_med = drawn(blocks, "out/smooth", "--field", "von_mises").root
    (blocks / "out/smooth/fields.med").rename(blocks / "out/smooth/kept.med")
    with_vtu = drawn(blocks, "out/smooth", "--field", "von_mises").root
    (blocks / "out/smooth/kept.med").rename(blocks / "out/smooth/fields.med")
    assert [element.attrib for element in with_med.iter()] == [element.attrib for element in with_vtu.iter()]


def test_bodies_in_space_are_seen_from_a_side(solid):
    figure = drawn(solid, "out/run", "--field", "von_mises", "--view", "0,0", "--scale", "0")
    assert [text.text for text in figure.group("axes").findall(f"{SVG}text")] == ["x", "y", "z"]
    outlines = figure.group("bodies").findall(f"{SVG}polygon")
    assert len(outlines) == 3 * 2 + 2 * 1, "of the faces with x = 1 and x = 0.8 alone"
    other = drawn(solid, "out/run", "--field", "von_mises", "--view", "0,90", "--scale", "0")
    assert len(other.group("bodies").findall(f"{SVG}polygon")) == 9 + 2 * 4, "from above: squares and triangles"


# ---- files ----------------------------------------------------------------------------------------------------


def test_pngs_have_the_size_that_was_asked_for(blocks):
    for kind in [["--history", "roof"], ["--line", "joint"], ["--field", "von_mises"]]:
        done = rubato(blocks, "plot", "out/rough", *kind, "--width", "640", "--height", "444", "-o", "plot.png")
        assert done.returncode == 0, done.stderr
        data = (blocks / "plot.png").read_bytes()
        assert data.startswith(b"\x89PNG\r\n\x1a\n") and data.endswith(b"IEND\xaeB`\x82")
        assert struct.unpack(">II", data[16:24]) == (640, 444)
        assert len(data) > 5000
        assert rubato(blocks, "plot", "out/rough", *kind, "--width", "640", "--height", "444", "-o", "p.svg").returncode == 0
        assert Figure(blocks / "p.svg").size == (640, 444)


def test_files_without_a_name_are_called_as_what_they_show(blocks, tmp_path):
    for kind, name in [([], "history"), (["--line", "joint"], "line"), (["--field", "von_mises"], "field")]:
        done = rubato(tmp_path, "plot", str(blocks / "out/rough"), *kind)
        assert done.stdout == f"written to {name}.svg\n", done.stderr
        assert (tmp_path / f"{name}.svg").exists()


REFUSED = [
    (["nowhere"], "nowhere: there is no such folder, expected the folder of a run"),
    (["."], ".: found no run.json, expected the folder of a run"),
    (["out/rough", "--history", "rof.x"], "out/rough: no quantity is called 'rof.x'; did you mean 'roof.x'?"),
    (["out/rough", "--history", "energy.fricton"], "out/rough: no quantity is called 'energy.fricton'; did you mean 'energy.friction'?"),
    (["out/rough", "--history", "roof.x", "--against", "roof"], "--against: found 'roof', expected one of roof.x, roof.y"),
    (["out/rough", "--line", "join"], "out/rough: no contact zone is called 'join'; did you mean 'joint'?"),
    (["out/rough", "--line", "joint.presure"], "out/rough: --line: a contact zone has no column 'presure'; did you mean 'pressure'?"),
    (["out/rough", "--line", "joint", "--along", "z"], "out/rough: --along: a contact zone has no column 'z'; did you mean 's'?"),
    (["out/rough", "--line", "joint", "--at", "1.5"], "out/rough: nothing is stored at t = 1.5; the nearest stored are 1 and 2"),
    (["out/rough", "--field", "von_misses"], "--field: no field is called 'von_misses'; did you mean 'von_mises'?"),
    (["out/rough", "--field", "von_mises", "--at", "5"], "out/rough: nothing is stored at t = 5; the nearest stored is 4"),
    (["out/rough", "--field", "von_mises", "--at", "1,2"], "--at: found 2 instants, expected one with --field"),
    (["out", "--field", "von_mises"], "--field: found 3 runs, expected one; the first is out/bare"),
    (["out/bare", "--field", "von_mises"], "out/bare: holds no fields to draw, expected a run with 'fields: {formats: [vtu]}' in its deck"),
    (["out/rough", "--field", "von_mises", "--view", "30"], "--view: found 1 number, expected two with a comma between them"),
    (["out/rough", "--field", "von_mises", "--range", "2,1"], "--range: found 2,1, expected a number and a larger one"),
    (["out/rough", "--at", "1"], "--at: found instants for histories, expected --line or --field beside them"),
    (["out/rough", "--height", "160"], "found a size of 800 x 160 pixels, which has no room for 3 panels of curves"),
    (["out/rough", "--height", "20000"], "found a size of 20000 pixels, expected 1 to 10000"),
    (["out/rough", "--line", "joint", "--field", "von_mises"], "--line excludes --field (rubato --help tells more)"),
]


@pytest.mark.parametrize("arguments, sentence", REFUSED)
def test_what_cannot_be_drawn_is_told_and_no_file_is_left(arguments, sentence, blocks):
    before = sorted(os.listdir(blocks))
    done = rubato(blocks, "plot", *arguments, "-o", "none.svg")
    assert (done.returncode, done.stdout, done.stderr) == (2, "", f"error: {sentence}\n")
    assert sorted(os.listdir(blocks)) == before


def test_runs_without_probes_name_what_they_have(blocks):
    done = rubato(blocks, "plot", "out/bare", "-o", "none.svg")
    assert done.returncode == 2
    assert done.stderr.startswith("error: out/bare: found no probes, expected --history with one of energy.kinetic, ")
    assert "joint.normal" in done.stderr and not (blocks / "none.svg").exists()


def test_files_that_cannot_be_written_are_refused_and_former_ones_stay(blocks):
    assert rubato(blocks, "plot", "out/rough", "-o", "a.pdf").stderr == "error: a.pdf: found the ending '.pdf', expected .svg or .png\n"
    assert rubato(blocks, "plot", "out/rough", "-o", "no/a.svg").stderr == "error: no/a.svg: cannot be written: there is no such folder\n"
    (blocks / "former.svg").write_text("former")
    assert rubato(blocks, "plot", "out/rough", "--history", "x.y.z", "-o", "former.svg").returncode == 2
    assert (blocks / "former.svg").read_text() == "former"


def test_damaged_fields_are_refused(blocks, tmp_path):
    subprocess.run(["cp", "-r", str(blocks / "out/rough"), str(tmp_path / "rough")], check=True)
    for file in (tmp_path / "rough/fields").iterdir():
        file.write_bytes(file.read_bytes()[:-2000])
    done = rubato(tmp_path, "plot", "rough", "--field", "von_mises")
    assert done.returncode == 2 and re.fullmatch(
        r"error: rough/fields/\d+\.vtu: [^\n]+\n", done.stderr
    )
    (tmp_path / "rough/fields.pvd").write_text("<VTKFile")
    done = rubato(tmp_path, "plot", "rough", "--field", "von_mises")
    assert done.returncode == 2 and "fields.pvd: found no valid XML" in done.stderr
    assert sorted(os.listdir(tmp_path)) == ["rough"]


# ---- decks of `rubato new` -------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", NAMES)
def test_the_decks_of_rubato_new_are_drawn(name, tmp_path):
    assert rubato(tmp_path, "new", name).returncode == 0
    assert rubato(tmp_path, "run", f"{name}.yaml", "-q").returncode == 0
    for run in sorted((tmp_path / name).iterdir()):
        figure = drawn(tmp_path, str(run))
        probes = table(run / "probes.csv")
        for panel in figure.panels:
            for curve in panel.curves:
                if not curve.rings:
                    panel.expect(curve.label, column(probes, "t"), column(probes, curve.label))
        if (run / "fields.pvd").exists():
            assert len(drawn(tmp_path, str(run), "--field", "displacement").group("bodies")) > 0
        for contact in run.glob("contact_*.csv"):
            zone = contact.stem.removeprefix("contact_")
            assert drawn(tmp_path, str(run), "--line", zone).panels[0].curves[0].points
    assert drawn(tmp_path, name).panels


# ---- checks ---------------------------------------------------------------------------------------------------


def test_checks_are_a_table_in_markdown_with_the_same_exit_code(blocks):
    done = rubato(blocks, "check", "out", "--markdown")
    assert done.returncode == rubato(blocks, "check", "out").returncode == 1
    bare, rough, smooth = done.stdout.split("### ")[1:]
    assert bare == "bare\n\ncomplete\n\nno checks in the deck\n\n"
    head, line = [row for row in rough.splitlines() if row.startswith("|") and "---" not in row]
    assert head == "| quantity | t | value | reference | difference | deviation | tolerance | verdict | source |"
    cells = [cell.strip() for cell in re.split(r"(?<!\\)\|", line)[1:-1]]
    assert cells[0] == "roof.y" and cells[6:] == ["1.0e-06 relative", "ok", r"analytic: a \| b"]
    assert float(cells[3]) == -1e-3 and abs(float(cells[2]) + 1e-3) < 1e-9
    assert float(cells[1]) == 1 and abs(float(cells[4])) < 1e-9
    rows = [re.split(r"(?<!\\)\|", row) for row in smooth.splitlines() if row.startswith("| ")][1:]
    assert [row[8].strip() for row in rows] == ["**FAILS**", "ok"]
    assert rows[1][1].strip() == "energy friction" and rows[1][2].strip() == "max"
    value = float(rows[0][3])
    assert abs(float(rows[0][5]) - (value + 1)) < 1e-2 * abs(value + 1)


def test_fields_in_cells_beside_those_at_nodes_do_not_stand_in_the_way(tmp_path):
    deck = SOLID.replace("formats: [vtu]", "formats: [med], also: [strain, stress_elga, strain_elno]")
    (tmp_path / "solid.yaml").write_text(deck)
    assert rubato(tmp_path, "run", "solid.yaml", "-o", "out", "-q").returncode == 0
    done = rubato(tmp_path, "plot", "out/run", "--field", "strain.zz", "-o", "a.svg")
    assert done.returncode == 0, done.stderr
    assert rubato(tmp_path, "plot", "out/run", "--field", "stress_elga.xx", "-o", "b.svg").returncode == 2
    done = rubato(tmp_path, "report", "out/run")
    assert done.returncode == 0, done.stderr
    assert "strain" in (tmp_path / "out/run/report.html").read_text()
