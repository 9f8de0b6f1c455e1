# SPDX-License-Identifier: LGPL-3.0-or-later
"""What `rubato report` writes, opened in a browser from the disk and held against the files of the run."""

import csv
import json
import math
import os
import subprocess
from pathlib import Path

import pytest

pytest.importorskip("selenium", reason="python3-selenium is not installed (make deps BROWSER=1)")

import browser
from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys

if browser.CHROMIUM is None or browser.DRIVER is None:
    pytest.skip("chromium or chromium-driver is not installed (make deps BROWSER=1)", allow_module_level=True)

PROGRAM = os.environ["RUBATO_PROGRAM"]
CASES = Path(os.environ["RUBATO_SOURCE_DIR"]) / "cases" / "sdnl140"
PICTURES = os.environ.get("RUBATO_PICTURES", "")  # a folder: pictures for the documentation go there


def rubato(*arguments, folder=None):
    """Runs the program in a folder, to its end."""
    done = subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True, check=False, cwd=folder)
    assert done.returncode == 0, done.stderr
    return done


@pytest.fixture(scope="session")
def results(tmp_path_factory):
    """Runs of two beams in the plane, from .vtu files, and of the same beams in space, from fields.med."""
    folder = tmp_path_factory.mktemp("results")
    every = "fields={every: 1, formats: [%s]}"
    rubato("run", CASES / "f.yaml", "--only", "evol1,evol3", "-o", folder / "plane", "--set", every % "vtu", "--set", "checks=")
    rubato("run", CASES / "c.yaml", "--only", "evol1", "-o", folder / "space", "--set", every % "med", "--set", "time.end=0.006",
           "--set", "checks=")
    rubato("report", folder / "plane/evol1", folder / "plane/evol3", "-o", folder / "two.html")
    for run in ["plane/evol1", "space/evol1"]:
        rubato("report", folder / run)
    return folder


@pytest.fixture(scope="session")
def driver():
    with browser.chromium() as chromium:
        yield chromium


@pytest.fixture(scope="session")
def opened(results, driver):
    """Opens a report, whose console must have stayed empty so far."""

    def open_page(name):
        page = browser.Page(driver, results / name)
        assert page.messages() == []
        return page

    return open_page


def table(path):
    with open(path, encoding="utf-8") as file:
        return list(csv.DictReader(file))


def different(one, other):
    """How many pixels differ."""
    return sum(one[i : i + 4] != other[i : i + 4] for i in range(0, len(one), 4))


def row_at(rows, t):
    return min(rows, key=lambda row: abs(float(row["t"]) - t))


def click_on(page, node):
    """Clicks where the view shows a node; its values are then in the table."""
    place = page.run(
        """(() => { const { picture, i } = rubato.viewer.panes[0];
        const node = rubato.nodeNamed(rubato.viewer.runs[0], rubato.viewer.shapes[0], arguments[0]);
        const { x, y } = picture.screenOf(node);
        return [x - picture.size.width / 2, y - picture.size.height / 2]; })()""",
        node,
    )
    canvas = page.driver.find_element(By.CSS_SELECTOR, "canvas.bodies")
    ActionChains(page.driver).move_to_element_with_offset(canvas, *map(round, place)).click().perform()
    page.settle()
    assert page.driver.find_element(By.CSS_SELECTOR, ".node-panel h3").text.startswith(f"Node {node} ")
    return {f"{row['field']}.{row['component']}".rstrip("."): row for row in page.run("rubato.viewer.nodeValues")}


def node_at(page, *place):
    """The name of the node that stands there, undeformed."""
    return page.run(
        """((place) => { const { base } = rubato.viewer.shapes[0], run = rubato.viewer.runs[0];
        const stands = (i) => place.every((at, axis) => Math.abs(base[3 * i + axis] + run.view.centre[axis] - at) < 1e-5);
        for (let i = 0; i < run.view.drawn_nodes; ++i) if (stands(i)) return rubato.nodeName(run, rubato.viewer.shapes[0], i);
        })(arguments[0])""",
        place,
    )


def holds(shown, value):
    """Within the rounding that the page names itself."""
    assert abs(shown["value"] - value) <= shown["off"] * (1 + 1e-6) + 1e-12 * abs(value), (shown, value)


def go_to(page, t):
    page.run("rubato.viewer.step(rubato.viewer.instants.reduce((best, at, i, all) =>"
             " Math.abs(at - arguments[0]) < Math.abs(all[best] - arguments[0]) ? i : best, 0))", t)
    page.settle()


def test_nothing_comes_from_elsewhere(results, opened):
    page = opened("plane/evol1/report.html")
    text = (results / "plane/evol1/report.html").read_text(encoding="utf-8")
    assert 'src="' not in text.split("<body>")[0] and "<link rel=\"stylesheet\"" not in text
    assert page.run("performance.getEntriesByType('resource').filter((entry) => !entry.name.startsWith('data:')).length") == 0


@pytest.mark.parametrize("name", ["plane/evol1/report.html", "space/evol1/report.html"])
def test_bodies_are_drawn(opened, name):
    page = opened(name)
    pixels = page.pixels()
    colours = {pixels[i : i + 4] for i in range(0, len(pixels), 4)}
    assert len(colours) > 20
    assert page.messages() == []


@pytest.mark.parametrize("name", ["plane/evol1/report.html", "space/evol1/report.html"])
def test_the_slider_moves_the_body_by_keyboard_too(opened, name):
    page = opened(name)
    last = page.pixels()
    slider = page.driver.find_element(By.CSS_SELECTOR, "input[aria-label=Instant]")
    slider.send_keys(Keys.ARROW_LEFT, Keys.ARROW_LEFT)
    before = page.pixels()
    assert page.run("rubato.viewer.state.instant") == page.run("rubato.viewer.instants.length") - 3
    assert different(last, before) > 500
    slider.send_keys(Keys.END)
    assert different(last, page.pixels()) == 0


def test_the_scale_enlarges_the_deformation(opened):
    page = opened("space/evol1/report.html")
    once = page.pixels()
    scale = page.driver.find_element(By.CSS_SELECTOR, "input[aria-label='Scale of the displacement']")
    scale.clear()
    scale.send_keys("0", Keys.TAB)
    still = page.pixels()
    assert different(once, still) > 500
    places = page.run("Array.from(rubato.viewer.panes[0].picture.positions)")
    base = page.run("Array.from(rubato.viewer.shapes[0].base)")
    assert places == base


def test_dragging_turns_bodies_in_space_and_reset_turns_them_back(opened):
    page = opened("space/evol1/report.html")
    first = page.pixels()
    canvas = page.driver.find_element(By.CSS_SELECTOR, "canvas.bodies")
    ActionChains(page.driver).drag_and_drop_by_offset(canvas, 120, 60).perform()
    page.wait("!rubato.viewer.panes[0].picture.turning")
    assert different(first, page.pixels()) > 1000
    buttons = {button.text: button for button in page.driver.find_elements(By.CSS_SELECTOR, ".controls button")}
    assert {"Reset", "along x", "along y", "along z"} <= set(buttons)
    buttons["Reset"].click()
    page.wait("!rubato.viewer.panes[0].picture.turning")
    assert different(first, page.pixels()) == 0


def test_a_body_can_be_hidden(opened):
    page = opened("plane/evol1/report.html")
    first = page.pixels()
    page.driver.find_element(By.XPATH, "//label[contains(., 'body 2')]/input").click()
    assert different(first, page.pixels()) > 5000


def test_a_picked_node_shows_what_the_probe_holds(results, opened):
    """The tip of SDNL140 F is a node with the number that contact and probes know."""
    page = opened("plane/evol1/report.html")
    probes = table(results / "plane/evol1/probes.csv")
    tip = node_at(page, 1, 0.1)
    for t in [0.003, 0.006, 0.012]:
        go_to(page, t)
        values = click_on(page, tip)
        holds(values["displacement.x"], float(row_at(probes, t)["tip.x"]))
        holds(values["displacement.y"], float(row_at(probes, t)["tip.y"]))


def test_the_history_of_a_node_is_that_of_the_probe(results, opened):
    page = opened("plane/evol1/report.html")
    probes = table(results / "plane/evol1/probes.csv")
    page.run("rubato.viewer.choose('displacement')")
    page.run("rubato.viewer.set({ component: '1' })")
    page.settle()
    click_on(page, "N63")
    t, y = page.run("rubato.viewer.nodeChart.data")
    assert t == pytest.approx([float(row["t"]) for row in probes], rel=1e-11)
    largest = max(abs(float(row["tip.y"])) for row in probes)
    assert y == pytest.approx([float(row["tip.y"]) for row in probes], abs=2e-5 * largest)


@pytest.mark.parametrize("name", ["plane", "space"])
def test_picked_slave_nodes_show_what_contact_has_there(results, opened, name):
    page = opened(f"{name}/evol1/report.html")
    page.run("rubato.viewer.panes[0].picture.showBody(0, false)")  # the master lies on it
    if name == "space":
        page.run("rubato.viewer.panes[0].picture.lookAlong('iso')")
    rows = table(results / f"{name}/evol1/contact_interface.csv")
    last = max(float(row["t"]) for row in rows)
    closed = [row for row in rows if float(row["t"]) == last and row["status"] != "open"]
    assert closed
    words = ["open", "sticks", "slips"]
    for row in closed[:2]:
        values = click_on(page, row["node"])
        holds(values["contact_pressure"], float(row["pressure"]))
        holds(values["contact_gap"], float(row["gap"]))
        assert words[round(values["contact_status"]["value"])] == row["status"]


def test_status_is_shown_in_its_colours(opened):
    page = opened("plane/evol1/report.html")
    pixels = page.pixels()
    colours = {tuple(pixels[i : i + 3]) for i in range(0, len(pixels), 4)}
    legend = page.run("rubato.statusColours.map((rgb) => rgb.map((part) => Math.round(255 * part)))")
    shown = [any(math.dist(colour, wanted) < 3 for colour in colours) for wanted in legend]
    assert shown[0] and shown[2], "open and slipping nodes at the end of the run"
    page.driver.find_element(By.XPATH, "//label[contains(., 'At slave nodes')]/input").click()
    assert different(pixels, page.pixels()) > 100


@pytest.mark.parametrize("kind, file", [("probes", "probes.csv"), ("energy", "energy.csv"), ("resultants", "resultants_interface.csv")])
def test_curves_are_the_tables(results, opened, kind, file):
    page = opened("plane/evol1/report.html")
    rows = table(results / "plane/evol1" / file)
    for column in list(rows[0])[1:]:
        page.run("rubato.charts.find((chart) => chart.kind === arguments[0]).choose([arguments[1]])", kind, column)
        t, values = page.run("rubato.charts.find((chart) => chart.kind === arguments[0]).chart.data", kind)
        assert t == [float(row["t"]) for row in rows]
        wanted = [float(row[column]) for row in rows]
        assert values == [value if math.isfinite(value) else None for value in wanted], column


def test_convergence_is_that_of_the_steps(results, opened):
    page = opened("plane/evol1/report.html")
    steps = [json.loads(line) for line in (results / "plane/evol1/steps.jsonl").read_text().splitlines()]
    charts = {chart["title"]: chart["data"] for chart in page.run(
        "rubato.charts.filter((chart) => chart.kind === 'convergence').map(({ title, chart }) => ({ title, data: chart.data }))")}
    assert charts["Iterations of the accepted steps"] == [[step["end"] for step in steps], [step["iterations"] for step in steps]]
    assert charts["Residual of the last iterate"][1] == [step["residual"] for step in steps]


def test_two_runs_stand_side_by_side(results, opened):
    page = opened("two.html")
    assert page.run("rubato.viewer.panes.length") == 2
    one, other = page.pixels(0), page.pixels(1)
    assert len(one) == len(other) and len({one[i : i + 4] for i in range(0, len(one), 4)}) > 20
    go_to(page, 0.006)
    assert different(one, page.pixels(0)) > 500 and different(other, page.pixels(1)) > 500
    chart = page.run("(({ chart }) => ({ data: chart.data, labels: chart.series.map((one) => one.label) }))"
                     "(rubato.charts.find((chart) => chart.kind === 'probes'))")
    for label, run in [("A: tip.y", "evol1"), ("B: tip.y", "evol3")]:
        rows = table(results / "plane" / run / "probes.csv")
        shown = dict(zip(chart["data"][0], chart["data"][chart["labels"].index(label)]))
        assert [shown[float(row["t"])] for row in rows] == [float(row["tip.y"]) for row in rows]


def test_views_of_two_runs_move_together(opened):
    page = opened("two.html")
    canvas = page.driver.find_elements(By.CSS_SELECTOR, "canvas.bodies")[0]
    before = page.pixels(1)
    ActionChains(page.driver).drag_and_drop_by_offset(canvas, 60, 40).perform()
    page.wait("rubato.viewer.panes.every(({ picture }) => !picture.turning)")
    assert different(before, page.pixels(1)) > 500


def test_a_run_without_fields_has_a_report_without_a_view(results, driver):
    folder = results / "bare"
    rubato("run", CASES / "f.yaml", "--only", "evol1", "-o", folder, "--set", "fields=", "--set", "time.end=0.002", "--set", "checks=")
    done = rubato("report", folder / "evol1")
    assert "stored no fields" in done.stderr and "fields: {at: [" in done.stderr
    page = browser.Page(driver, folder / "evol1/report.html")
    assert page.messages() == []
    assert "fields: {at: [" in driver.find_element(By.ID, "view").text
    assert driver.find_elements(By.CSS_SELECTOR, "canvas.bodies") == []
    assert page.run("rubato.charts.find((chart) => chart.kind === 'probes').chart.data[0].length") == 3


def test_pictures_for_the_documentation(tmp_path):
    """docs/pictures/report.png, where RUBATO_PICTURES names a folder."""
    if not PICTURES:
        pytest.skip("RUBATO_PICTURES names no folder for the picture (make picture)")
    rubato("run", CASES / "c.yaml", "--only", "evol1", "-o", "beams", "--set", "mesh.refine=2", "--set", "fields={every: 1}", "--set", "checks=", folder=tmp_path)
    rubato("report", "beams/evol1", folder=tmp_path)
    with browser.chromium(1280, 1080) as driver:
        page = browser.Page(driver, tmp_path / "beams/evol1/report.html")
        go_to(page, 0.004)
        page.run("rubato.viewer.panes[0].picture.turn(0.1, 0), rubato.viewer.panes[0].picture.zoomBy(1.25),"
                 " rubato.viewer.drawAxes(rubato.viewer.panes[0])")
        page.run("rubato.viewer.set({ range: rubato.viewer.rangeSelect.value = 'one' })")
        page.settle()
        click_on(page, node_at(page, 1, 0.1, 0.1))
        picture = Path(PICTURES) / "report.png"
        driver.save_screenshot(str(picture))
        assert picture.stat().st_size < 300_000
