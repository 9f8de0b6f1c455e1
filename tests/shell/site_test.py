# SPDX-License-Identifier: LGPL-3.0-or-later
"""The web site of the pages (`make site`): it is built without a warning, and no link in it is dead."""

import html.parser
import re
import shutil
import subprocess
from pathlib import Path
from urllib.parse import unquote, urlsplit

import corpus
import pytest


class Page(html.parser.HTMLParser):
    """Links and anchors of a page."""

    def __init__(self, path):
        super().__init__()
        self.links, self.anchors, self.loaded = [], set(), []
        self.feed(path.read_text(encoding="utf-8"))

    def handle_starttag(self, tag, attributes):
        attributes = dict(attributes)
        self.anchors |= {attributes[key] for key in ("id", "name") if attributes.get(key)}
        if tag == "a" and attributes.get("href"):
            self.links.append(attributes["href"])
        if tag in ("img", "script") and attributes.get("src"):
            self.loaded.append(attributes["src"])
        if tag == "link" and attributes.get("rel") == "stylesheet":
            self.loaded.append(attributes["href"])


@pytest.fixture(scope="module")
def site(tmp_path_factory):
    if shutil.which("mkdocs") is None:
        pytest.skip("mkdocs is not installed")
    folder = tmp_path_factory.mktemp("site") / "site"
    done = subprocess.run([corpus.SOURCES / "docs/make-site", str(folder)], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
    assert [path.name for path in folder.parent.iterdir()] == ["site"], "nothing else is left"
    return folder


@pytest.fixture(scope="module")
def pages(site):
    return {path.resolve(): Page(path) for path in site.rglob("*.html") if path.name != "404.html"}


def test_every_page_of_the_sources_is_in_the_site(site, pages):
    for folder in ["docs", "cases"]:
        for source in (corpus.SOURCES / folder).rglob("*.md"):
            page = source.relative_to(corpus.SOURCES).with_suffix(".html")
            page = page.with_name("index.html") if page.name == "README.html" else page
            assert (site / page).resolve() in pages, page
    assert {(site / name).resolve() for name in ["index.html", "CHANGELOG.html", "CONTRIBUTING.html"]} <= set(pages)


def test_no_link_within_the_site_is_dead(site, pages):
    dead = []
    count = 0
    for path, page in pages.items():
        for link in page.links:
            parts = urlsplit(link)
            if parts.scheme or parts.netloc:
                continue
            count += 1
            target = (path.parent / unquote(parts.path)).resolve() if parts.path else path
            where = f"{path.relative_to(site.resolve())}: {link}"
            if not target.is_file() or not target.is_relative_to(site.resolve()):
                dead.append(where)
            elif parts.fragment and target in pages and unquote(parts.fragment) not in pages[target].anchors:
                dead.append(f"{where} (no such heading)")
    assert count > 1000 and not dead, "\n".join(sorted(set(dead)))


def test_nothing_is_loaded_from_elsewhere(site, pages):
    for path, page in pages.items():
        for link in page.loaded:
            assert not urlsplit(link).netloc, f"{path}: {link}"
            assert (path.parent / unquote(urlsplit(link).path)).resolve().is_file(), f"{path}: {link}"


def test_the_site_can_be_searched(site):
    index = (site / "search/search_index.json").read_text(encoding="utf-8")
    assert "interference" in index and "docs/guide/plots.html" in index


def test_the_navigation_names_every_page():
    named = set(re.findall(r"^ +- .*?([\w./-]+\.md)$", (corpus.SOURCES / "mkdocs.yml").read_text(), re.MULTILINE))
    there = {
        path.relative_to(corpus.SOURCES).as_posix()
        for folder in ["docs", "cases"]
        for path in (corpus.SOURCES / folder).rglob("*.md")
    } | {"README.md", "CHANGELOG.md", "CONTRIBUTING.md"}
    assert named == there
