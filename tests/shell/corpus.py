# SPDX-License-Identifier: LGPL-3.0-or-later
"""Every deck of the sources, as an editor reads it: YAML 1.2, in which `on` and `yes` are words."""

import functools
import os
import re
import subprocess
from pathlib import Path

import yaml

SOURCES = Path(os.environ["RUBATO_SOURCE_DIR"])
PROGRAM = os.environ["RUBATO_PROGRAM"]


class Core(getattr(yaml, "CSafeLoader", yaml.SafeLoader)):  # libyaml is ten times as fast
    """YAML 1.2's core schema, keys as text."""

    def construct_mapping(self, node, deep=False):
        self.flatten_mapping(node)
        if not all(isinstance(key, yaml.ScalarNode) for key, _ in node.value):
            raise yaml.constructor.ConstructorError("a key is no word", node.start_mark)
        return {key.value: self.construct_object(value, deep=True) for key, value in node.value}


Core.yaml_implicit_resolvers = {}
for tag, pattern, first in [
    ("null", r"^(~|null|Null|NULL|)$", ["~", "n", "N", ""]),
    ("bool", r"^(true|True|TRUE|false|False|FALSE)$", list("tTfF")),
    ("int", r"^[-+]?[0-9]+$", list("-+0123456789")),
    ("float", r"^[-+]?(\.[0-9]+|[0-9]+(\.[0-9]*)?)([eE][-+]?[0-9]+)?$", list("-+.0123456789")),
    ("merge", r"^<<$", ["<"]),
]:
    Core.add_implicit_resolver("tag:yaml.org,2002:" + tag, re.compile(pattern), first)
Core.add_constructor("tag:yaml.org,2002:map", lambda loader, node: loader.construct_mapping(node))
Core.add_constructor("tag:yaml.org,2002:int", lambda loader, node: int(loader.construct_scalar(node)))
Core.add_constructor("tag:yaml.org,2002:float", lambda loader, node: float(loader.construct_scalar(node)))


def load(text):
    return yaml.load(text, Core)


def _files(folder, pattern):
    for path in sorted((SOURCES / folder).rglob(pattern)):
        yield path.relative_to(SOURCES).as_posix(), path.read_text(encoding="utf-8")


def _quoted(folder, pattern, form):
    """Blocks of text inside of other files, by "file:number"."""
    for name, text in _files(folder, pattern):
        for number, block in enumerate(re.findall(form, text, re.DOTALL)):
            yield f"{name}:{number}", block


def of_files():
    """The decks that stand in files of their own."""
    return {
        name: text
        for folder in ["cases", "apps/rubato/templates", "tests/shell/decks"]
        for name, text in _files(folder, "*.yaml")
    }


def of_documents():
    """Whatever the pages show as YAML: decks and parts of decks."""
    blocks = dict(_quoted("docs", "*.md", r"```yaml\n(.*?)```"))
    blocks |= dict(_quoted("cases", "*.md", r"```yaml\n(.*?)```"))
    readme = (SOURCES / "README.md").read_text(encoding="utf-8")
    return blocks | {f"README.md:{i}": block for i, block in enumerate(re.findall(r"```yaml\n(.*?)```", readme, re.DOTALL))}


def is_whole(deck):
    return isinstance(deck, dict) and {"mesh", "physics", "materials", "time"} <= set(deck)


def of_tests():
    """The raw strings of the tests that are whole decks."""
    decks = {}
    for pattern in ["*.hpp", "*.cpp"]:
        for name, block in _quoted("tests", pattern, r'R"\((.*?)\)"'):
            try:
                if is_whole(load(block)):
                    decks[name] = block
            except yaml.YAMLError:
                pass
    return decks


def outcome(*arguments, text="", folder=None):
    """The program's exit code, output and errors."""
    done = subprocess.run([PROGRAM, *arguments], input=text, capture_output=True, text=True, check=False, cwd=folder)
    return done.returncode, done.stdout, done.stderr


@functools.cache
def refusal(text):
    """What the program's own check says against a deck; empty when it takes it."""
    code, _, errors = outcome("check", "-", text=text, folder=SOURCES / "tests/shell/decks")
    assert code in (0, 2), errors
    return errors if code == 2 else ""
