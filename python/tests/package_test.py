# SPDX-License-Identifier: LGPL-3.0-or-later
"""The package: what it offers, its help, its annotations, and that it works where it is installed."""

import ast
import inspect
import os
import shutil
import subprocess
import sys
import textwrap
from pathlib import Path

import pytest
import rubato
import studies

PACKAGE = Path(rubato.__file__).parent


def public(names):
    return {name for name in names if not name.startswith("_")}


def members_of(cls):
    """What a class has itself and of its public bases, but for what all objects have."""
    names = set()
    for base in cls.__mro__:
        if base.__module__.startswith("rubato"):
            names |= public(vars(base))
    return names


def stub_classes(path):
    """Public names of each class of a stub, and the functions beside them."""
    tree = ast.parse(path.read_text(encoding="utf-8"))
    classes, functions = {}, set()
    for node in tree.body:
        if isinstance(node, ast.ClassDef):
            names = {item.name for item in node.body if isinstance(item, ast.FunctionDef)}
            names |= {target.id for item in node.body if isinstance(item, ast.Assign) for target in item.targets}
            names |= {item.target.id for item in node.body if isinstance(item, ast.AnnAssign)}
            classes[node.name] = (public(names), [ast.unparse(base) for base in node.bases])
        elif isinstance(node, ast.FunctionDef):
            functions.add(node.name)
    return classes, functions


def test_everything_public_is_imported_from_the_package():
    for name in rubato.__all__:
        assert getattr(rubato, name) is not None
    assert {"Study", "Mesh", "Model", "Simulation", "load", "run", "open_run", "InputError"} <= set(rubato.__all__)
    assert rubato.__version__.count(".") == 2


def test_every_name_of_the_compiled_part_has_an_annotation():
    classes, functions = stub_classes(PACKAGE / "_rubato.pyi")
    compiled = rubato._rubato
    for name in (name for name in vars(compiled) if not name.startswith("__")):
        value = getattr(compiled, name)
        if inspect.isclass(value):
            assert members_of(value) == classes.pop(name)[0], name
        else:
            functions.remove(name)
    assert classes == {} and functions == set(), "in the annotations, but not in the module"


def test_every_record_and_word_has_annotations():
    classes, _ = stub_classes(PACKAGE / "_records.pyi")
    for name, _, members in rubato._rubato._records():
        names = classes.pop(name)[0]
        assert {member for member, _, _ in members} <= names and names <= members_of(getattr(rubato, name)), name
    for name, _, words in rubato._rubato._words():
        assert classes.pop(name)[0] == set(words), name
    assert set(classes) == {"Record", "Word"}
    listed = ast.parse((PACKAGE / "__init__.pyi").read_text(encoding="utf-8")).body
    assert {alias.name for node in listed if isinstance(node, ast.ImportFrom) for alias in node.names} == set(
        rubato.__all__
    )


def test_every_class_function_and_member_says_what_it_is():
    for name in rubato.__all__:
        value = getattr(rubato, name)
        assert value.__doc__, name
        assert "::" not in value.__doc__, f"{name} shows a type of C++"
        if not inspect.isclass(value) or issubclass(value, (str, tuple)):
            continue
        for member in members_of(value):
            text = inspect.getattr_static(value, member)
            if type(text).__name__ == "member_descriptor":
                assert f"    {member}: " in value.__doc__, f"{name}.{member}"
                continue
            text = getattr(value, member).__doc__
            assert text and "::" not in text, f"{name}.{member}: {text}"


GOOD = """
    import rubato

    study = rubato.load("deck.yaml", settings={"time.step": 1e-3})
    study.materials.append(rubato.Material(name="steel", young=2e11, law="elastic"))
    study.supports = [rubato.Support(on="held", components=(0.0, "x*t", None))]
    step: rubato.Step = rubato.Simulation(study).advance()
    highest: float = rubato.open_run("folder").probes["tip.y"].max()
    law: str = study.materials[0].law
    mesh = rubato.generate([rubato.Body(cells="hexa8")]).refined(2)
"""
BAD = {
    "study.materials[0].yung = 1": "has no attribute",
    'rubato.Material(young="stiff")': "incompatible type",
    "rubato.Simulation(3)": "incompatible type",
    "step.acepted": "has no attribute",
    "step.attempt.end = 1": "final attribute",
    "rubato.lod('a')": "has no attribute",
}


def test_a_type_checker_knows_the_package(tmp_path):
    if subprocess.run([sys.executable, "-m", "mypy", "--version"], capture_output=True, check=False).returncode:
        pytest.skip("mypy is not installed")
    path = tmp_path / "program.py"
    path.write_text(textwrap.dedent(GOOD) + "\n".join(BAD) + "\n", encoding="utf-8")
    done = subprocess.run(
        [sys.executable, "-m", "mypy", "--cache-dir", tmp_path / "cache", path],
        capture_output=True,
        text=True,
        check=False,
        env=os.environ | {"MYPYPATH": str(PACKAGE.parent)},
    )
    lines = done.stdout.splitlines()[:-1]
    first = textwrap.dedent(GOOD).count("\n") + 1
    assert len(lines) == len(BAD), done.stdout
    for number, (line, told) in enumerate(zip(lines, BAD.values()), first):
        assert f"program.py:{number}:" in line and told in line, line


@pytest.fixture(scope="module")
def prefix(tmp_path_factory):
    """The package alone, installed."""
    folder = tmp_path_factory.mktemp("prefix")
    cmake = shutil.which("cmake")
    subprocess.run(
        [cmake, "--install", studies.BUILD, "--prefix", folder, "--component", "python"], check=True, capture_output=True
    )
    return folder


def test_an_installed_package_works_without_the_build(prefix):
    code = """
        import pathlib, rubato
        assert str(pathlib.Path(rubato.__file__)).startswith({prefix!r}), rubato.__file__
        simulation = rubato.Simulation(rubato.load({deck!r}, "evol1"))
        print(sum(step.accepted for step in simulation), sorted(p.name for p in pathlib.Path(rubato.__file__).parent.glob("*.py*")))
    """
    code = code.format(prefix=str(prefix), deck=str(studies.SOURCES / "cases/sdnl140/f.yaml"))
    environment = os.environ | {"PYTHONPATH": str(prefix / "lib/python3/dist-packages")}
    done = subprocess.run(
        [sys.executable, "-c", textwrap.dedent(code)],
        capture_output=True,
        text=True,
        check=True,
        env=environment,
        cwd=prefix,
    )
    assert done.stdout.startswith("12 ")
    for name in ("__init__.py", "__init__.pyi", "_records.pyi", "_rubato.pyi"):
        assert f"'{name}'" in done.stdout, done.stdout
    assert (prefix / "lib/python3/dist-packages/rubato/py.typed").exists()


def test_every_module_of_the_package_is_built_and_installed(prefix):
    source = studies.SOURCES / "python/rubato"
    for path in source.rglob("*.py"):
        for root in (PACKAGE, prefix / "lib/python3/dist-packages/rubato"):
            assert (root / path.relative_to(source)).read_bytes() == path.read_bytes(), path


def test_records_show_their_members_to_editors():
    parameters = inspect.signature(rubato.Material).parameters
    assert list(parameters)[:3] == ["name", "law", "young"] and parameters["young"].annotation == "float"
    assert "> 0 [pressure]" in inspect.getdoc(rubato.Material.young)
