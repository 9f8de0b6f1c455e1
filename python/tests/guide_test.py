# SPDX-License-Identifier: LGPL-3.0-or-later
"""docs/guide/python.md, done as a reader does it: its blocks are one program, which prints what the page shows."""

import re
import subprocess
import sys

import studies

PAGE = studies.SOURCES / "docs/guide/python.md"
NUMBER = re.compile(r"[-+]?\d+(?:\.\d*)?(?:[eE][-+]?\d+)?")
RELATIVE = 2e-3  # the last digit that is shown may round the other way
END = "-- end of block --"


def blocks():
    """(program, what it is shown to print or None) of each block of the page."""
    found = re.findall(r"^```(\w+)\n(.*?)^```$", PAGE.read_text(encoding="utf-8"), re.DOTALL | re.MULTILINE)
    result = []
    for language, content in found:
        if language == "python":
            result.append([content, None])
        elif language == "text":
            assert result and result[-1][1] is None, "an output without a program"
            result[-1][1] = content
    return result


def expect_same(found, shown):
    """Equal words, and numbers that are equal but for rounding."""
    assert NUMBER.sub("#", found).split() == NUMBER.sub("#", shown).split(), f"{found}\nin place of\n{shown}"
    for one, other in zip(NUMBER.findall(found), NUMBER.findall(shown), strict=True):
        assert abs(float(one) - float(other)) <= RELATIVE * abs(float(other)), f"{one} in place of {other} in\n{found}"


def test_the_page_prints_what_it_shows(tmp_path):
    program = "".join(f"{code}\nprint({END!r}, flush=True)\n" for code, _ in blocks())
    (tmp_path / "page.py").write_text(program, encoding="utf-8")
    done = subprocess.run([sys.executable, "page.py"], capture_output=True, text=True, check=False, cwd=tmp_path)
    assert done.returncode == 0, done.stderr
    outputs = done.stdout.split(END + "\n")
    assert len(outputs) == len(blocks()) + 1
    for output, (code, shown) in zip(outputs, blocks()):
        if shown is None:
            assert output == "", f"the page does not show what\n{code}\nprints"
        else:
            expect_same(output, shown)


def test_every_block_with_a_print_shows_it():
    assert len(blocks()) >= 8
    for code, shown in blocks():
        assert (shown is not None) == ("print(" in code), code
