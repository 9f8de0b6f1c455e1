# SPDX-License-Identifier: LGPL-3.0-or-later
"""Man pages and completions as shells see them. A shell that is not installed is skipped with a word."""

import os
import pty
import re
import select
import shutil
import subprocess
import time
from pathlib import Path

import corpus
import pytest

DECK = """mesh: {file: none.med}
physics: solid
materials: {steel: {young: 1, poisson: 0, density: 1}}
time: {step: 1, end: 2}
runs: {first: {}, second: {}, third: {}}
"""


BLOCK = """mesh: {generate: [{name: block, rectangle: {from: [0, 0], to: [1, 1]}, divisions: [2, 2],
  sides: {bottom: ground, top: roof}}]}
physics: plane_strain
materials: {rubber: {young: 1e6, poisson: 0.3}}
supports: [{on: ground, fix: [x, y]}]
loads: [{pressure: {on: roof, value: 1000}}]
time: {scheme: static, step: 1, end: 1}
probes: {roof: {on: roof, take: mean}}
"""


@pytest.fixture(scope="session")
def share(tmp_path_factory):
    folder = tmp_path_factory.mktemp("share")
    assert corpus.outcome("shell-files", str(folder))[0] == 0
    return folder


@pytest.fixture
def place(tmp_path):
    """A folder with a deck, a mesh, a folder and another file."""
    (tmp_path / "deck.yaml").write_text(DECK)
    (tmp_path / "part.med").write_text("")
    (tmp_path / "notes.txt").write_text("")
    (tmp_path / "results").mkdir()
    return tmp_path


def commands():
    """Subcommands and their options, as --help has them."""
    names = re.findall(r"^  ([a-z]+) +\S", corpus.outcome("--help")[1].split("Subcommands:")[1], re.MULTILINE)
    return {
        name: re.findall(r"^  (?:-\w,)?(--[a-z-]+)", corpus.outcome(name, "--help")[1], re.MULTILINE) for name in names
    }


def environment():
    path = f"{Path(corpus.PROGRAM).parent}:{os.environ['PATH']}"
    return {"PATH": path, "HOME": "/nonexistent", "TERM": "dumb", "LC_ALL": "C.UTF-8"}


# ---- man ------------------------------------------------------------------------------------------------------


def shown(share, page):
    if shutil.which("man") is None:
        pytest.skip("man is not installed")
    done = subprocess.run(
        ["man", "--warnings", "-M", str(share / "man"), page],
        capture_output=True,
        text=True,
        check=True,
        env=environment() | {"MANWIDTH": "200", "MANPAGER": "cat"},
    )
    assert done.stderr == ""
    return re.sub(r"\s+", " ", re.sub(".\b", "", done.stdout)).replace("−", "-").replace("‐", "-")


def test_the_programs_page_has_every_command(share):
    text = shown(share, "rubato")
    for name in commands():
        assert f"rubato-{name}(1)" in text
    assert "EXIT STATUS" in text and "3 no convergence" in text


def test_each_command_has_a_page_with_its_options(share):
    found = commands()
    assert {"run", "new", "check", "compare", "info", "mesh", "list", "schema"} <= set(found)
    for name, options in found.items():
        text = shown(share, f"rubato-{name}")
        for option in options:
            assert option in text, name


# ---- completions ----------------------------------------------------------------------------------------------


class Bash:
    name = "bash"
    file = "bash-completion/completions/rubato"

    def candidates(self, share, place, words):
        script = f"""source {share / self.file}
        COMP_WORDS=({' '.join(f"'{word}'" for word in words)})
        COMP_CWORD={len(words) - 1}
        _rubato
        printf '%s\\n' "${{COMPREPLY[@]}}"
        """
        done = subprocess.run(
            ["bash", "--norc", "-c", script], capture_output=True, text=True, check=True, cwd=place, env=environment()
        )
        assert done.stderr == ""
        return set(done.stdout.split())


class Fish:
    name = "fish"
    file = "fish/vendor_completions.d/rubato.fish"

    def candidates(self, share, place, words):
        script = f"source {share / self.file}; complete -C '{' '.join(words)}'"
        done = subprocess.run(
            ["fish", "--no-config", "-c", script],
            capture_output=True,
            text=True,
            check=True,
            cwd=place,
            env=environment() | {"HOME": str(place / "results")},
        )
        return {line.split("\t")[0] for line in done.stdout.splitlines()}


class Zsh:
    name = "zsh"
    file = "zsh/site-functions/_rubato"

    def candidates(self, share, place, words):
        """Types the words and a tab into a terminal; whatever zsh adds to its list goes into a file, too."""
        listed = share / "listed"
        listed.write_text("")
        settings = place / "settings"
        settings.write_text(f"""fpath=({(share / self.file).parent} $fpath)
        autoload -Uz compinit
        compinit -u -D
        compadd() {{
          if [[ ${{@[1,(i)(-|--)]}} != *-(O|A|D)\\ * ]]; then
            local -a hits
            builtin compadd -A hits "$@"
            print -rl -- $hits >> {listed}
          fi
          builtin compadd "$@"
        }}
        say_end() {{ print -r -- "end of list" >> {listed} }}
        comppostfuncs=(say_end)
        print -r -- ready >> {listed}
        """)
        child, terminal = pty.fork()
        if child == 0:
            os.chdir(place)
            os.execvpe("zsh", ["zsh", "-f", "-i"], environment() | {"COLUMNS": "200", "LINES": "200"})
        try:
            os.write(terminal, f"source {settings}\n".encode())
            wait_for(listed, "ready", terminal)
            os.write(terminal, " ".join(words).encode() + b"\t")
            wait_for(listed, "end of list", terminal)
            return set(listed.read_text().splitlines())
        finally:
            os.close(terminal)
            os.waitpid(child, 0)


def wait_for(file, line, terminal, longest=120):
    """Reads the terminal until the line stands in the file."""
    text, end = "", time.monotonic() + longest
    while line not in file.read_text().splitlines():
        assert time.monotonic() < end, text
        if select.select([terminal], [], [], 0.1)[0]:
            text += os.read(terminal, 65536).decode(errors="replace")


@pytest.fixture(params=[Bash(), Zsh(), Fish()], ids=lambda shell: shell.name)
def complete(request, share, place):
    if shutil.which(request.param.name) is None:
        pytest.skip(f"{request.param.name} is not installed")
    return lambda *words: request.param.candidates(share, place, words)


def test_commands_are_offered(complete):
    assert set(commands()) <= complete("rubato", "")


def test_options_of_each_command_are_offered(complete):
    for name, options in commands().items():
        assert set(options) <= complete("rubato", name, "--"), name


def test_words_of_options_are_offered(complete):
    assert {"linear", "quadratic", "full_quadratic"} <= complete("rubato", "mesh", "--convert", "")


def test_names_of_templates_are_offered(complete):
    names = {line.split()[0] for line in corpus.outcome("new")[1].splitlines()}
    assert names <= complete("rubato", "new", "")


def test_decks_are_offered_to_run(complete):
    found = complete("rubato", "run", "d")
    assert "deck.yaml" in found and "notes.txt" not in found


def test_meshes_are_offered_to_info(complete):
    found = complete("rubato", "info", "p")
    assert "part.med" in found and "deck.yaml" not in found


def test_folders_are_offered_for_results(complete):
    found = complete("rubato", "run", "deck.yaml", "-o", "")
    assert {"results", "results/"} & found and "notes.txt" not in found


def test_folders_are_offered_for_each_run_of_a_plot(complete):
    for words in [["r"], ["results", "r"], ["results", "results", "r"]]:
        found = complete("rubato", "plot", *words)
        assert {"results", "results/"} & found and "notes.txt" not in found, words


def test_what_runs_have_histories_of_is_offered(complete, place):
    (place / "block.yaml").write_text(BLOCK)
    assert corpus.outcome("run", str(place / "block.yaml"), "-q", "-o", str(place / "results"))[0] == 0
    for option in ["--history", "--against"]:
        found = complete("rubato", "plot", "results/run", option, "")
        assert {"roof", "roof.y", "energy.strain"} <= found, option
    assert any("energy.strain" in word for word in complete("rubato", "plot", "results/run", "--history", "roof,energy.s"))


def test_runs_of_the_deck_are_offered(complete):
    assert {"first", "second", "third"} <= complete("rubato", "run", "deck.yaml", "--only", "")
    assert any("second" in word for word in complete("rubato", "run", "deck.yaml", "--only", "first,s"))
