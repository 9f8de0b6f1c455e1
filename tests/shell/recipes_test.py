# SPDX-License-Identifier: LGPL-3.0-or-later
"""The recipes of the guide, done as a reader does them: decks saved, commands typed, outputs and pictures compared."""

import os
import re
import subprocess
import xml.etree.ElementTree as xml
from pathlib import Path

import corpus
import pytest

RECIPES = corpus.SOURCES / "docs/guide/recipes"
PICTURES = corpus.SOURCES / "docs/pictures/recipes"
NUMBER = re.compile(r"[-+−]?\d+(?:\.\d+)?(?:[eE][-+]?\d+)?")
RELATIVE = 2e-3  # of numbers: the last digit that is shown may round the other way
ROUNDING = 1e-7  # deviations below that differ from machine to machine


def blocks_of(text):
    """(language, content) of each fenced block."""
    return re.findall(r"^```(\w+)\n(.*?)^```$", text, re.DOTALL | re.MULTILINE)


def typed(folder, commands):
    environment = os.environ | {"PATH": f"{Path(corpus.PROGRAM).parent}:{os.environ['PATH']}", "LC_ALL": "C.UTF-8"}
    done = subprocess.run(
        ["bash", "-euo", "pipefail", "-c", commands], capture_output=True, text=True, check=False, cwd=folder, env=environment
    )
    assert done.returncode == 0, f"{commands}\n{done.stdout}{done.stderr}"
    told = [line for line in done.stderr.splitlines() if "warning" in line]
    # SDNL140's meshes have two layers of linear cells and its beams turn by small strain, as its document wants.
    assert all("too stiff in bending" in line or "small strain stretches what turns" in line for line in told), done.stderr
    return done.stdout


def expect_same(found, shown):
    """Equal words, and numbers that are equal but for rounding."""
    assert NUMBER.sub("#", found).split() == NUMBER.sub("#", shown).split(), f"{found}\nin place of\n{shown}"
    for one, other in zip(NUMBER.findall(found), NUMBER.findall(shown), strict=True):
        a, b = float(one), float(other)
        assert abs(a - b) <= max(RELATIVE * abs(b), ROUNDING), f"{one} in place of {other} in\n{found}"


def follow(recipe, folder):
    """Does what the recipe says. Returns the numbers of commands and of outputs that were compared."""
    commands = compared = 0
    last = None
    for language, content in blocks_of(recipe.read_text(encoding="utf-8")):
        if language == "yaml":
            name = re.match(r"# ([\w.]+)\n", content).group(1)
            (folder / name).write_text(content, encoding="utf-8")
        elif language == "sh":
            last = typed(folder, content)
            commands += 1
        else:
            assert language == "text" and last is not None, "an output follows its command"
            expect_same(last, content)
            compared += 1
            last = None
    return commands, compared


def expect_same_picture(path, kept):
    """Same elements and texts; numbers, places among them, to half a pixel."""
    if path.suffix == ".png":
        assert path.read_bytes()[:24] == kept.read_bytes()[:24], "signature and size"
        return
    found, wanted = list(xml.parse(path).iter()), list(xml.parse(kept).iter())
    assert [element.tag for element in found] == [element.tag for element in wanted], f"{kept.name} is not as it is drawn now"
    for one, other in zip(found, wanted):
        assert (one.text or "").strip() == (other.text or "").strip()
        assert one.keys() == other.keys()
        for key in one.keys():
            assert NUMBER.sub("#", one.get(key)) == NUMBER.sub("#", other.get(key)), key
            if not one.get(key).startswith("#"):  # a colour
                for a, b in zip(NUMBER.findall(one.get(key)), NUMBER.findall(other.get(key)), strict=True):
                    assert abs(float(a) - float(b)) <= 0.5, (kept.name, key)


@pytest.mark.parametrize("name, commands, outputs", [("shrink-fit", 5, 2), ("lap-joint", 7, 2), ("beams", 5, 3)])
def test_a_recipe_does_what_it_says(name, commands, outputs, tmp_path):
    recipe = RECIPES / f"{name}.md"
    assert follow(recipe, tmp_path) == (commands, outputs)
    pictures = re.findall(r"!\[[^]]+\]\(\.\./\.\./pictures/recipes/([\w.]+)\)", recipe.read_text(encoding="utf-8"))
    assert pictures
    for picture in pictures:
        if os.environ.get("RUBATO_KEEP_PICTURES"):
            PICTURES.mkdir(parents=True, exist_ok=True)
            (PICTURES / picture).write_bytes((tmp_path / picture).read_bytes())
        expect_same_picture(tmp_path / picture, PICTURES / picture)


def test_every_recipe_is_followed_and_has_no_python():
    assert {path.stem for path in RECIPES.glob("*.md")} == {"shrink-fit", "lap-joint", "beams"}
    for path in RECIPES.glob("*.md"):
        assert {language for language, _ in blocks_of(path.read_text(encoding="utf-8"))} <= {"yaml", "sh", "text"}
        assert "python" not in path.read_text(encoding="utf-8").lower()
