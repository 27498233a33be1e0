"""The navigation of the site and the public functions of the package are complete; pages need no other host."""

from __future__ import annotations

import re
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest
import yaml

import edesign
from tools import site_hooks

ROOT = Path(__file__).parents[3]
DOCS = ROOT / "docs"
CONFIG: dict[str, Any] = yaml.safe_load((ROOT / "mkdocs.yml").read_text(encoding="utf-8"))


def test_navigation_names_pages_that_exist() -> None:
    named = site_hooks.paths_in(CONFIG["nav"])
    assert [page for page in named if not (DOCS / page).is_file()] == []
    assert len(named) == len(set(named))


def test_every_folder_of_pages_has_an_index() -> None:
    folders = {page.parent for page in DOCS.rglob("*.md")} - {DOCS}
    assert [folder.name for folder in folders if not (folder / "README.md").is_file()] == []


def test_pages_without_a_line_follow_those_of_their_folder(tmp_path: Path) -> None:
    """In the order of the links in the index; a folder that is not named is a section under its heading."""
    pages = {
        "reference/README.md": "# Reference\n",
        "reference/laws/README.md": "# Laws\n[zener](zener.md), [gap](gap.md)\n",
        "reference/laws/gap.md": "# Gap\n",
        "reference/laws/other.md": "# Other\n",
        "reference/laws/zener.md": "# Zener\n",
        "reference/keys/README.md": "# Keys of `files`\n",
        "reference/keys/frame.md": "# Frame\n",
    }
    for name, text in pages.items():
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).write_text(text, encoding="utf-8")
    nav: list[Any] = ["index.md", {"Reference": ["reference/README.md", {"Laws": ["reference/laws/README.md"]}]}]
    files = SimpleNamespace(documentation_pages=lambda: [SimpleNamespace(src_uri=name) for name in pages])
    site_hooks.on_files(files, SimpleNamespace(nav=nav, docs_dir=str(tmp_path)))
    laws = ["README", "zener", "gap", "other"]
    assert nav[1]["Reference"][1:] == [
        {"Laws": [f"reference/laws/{name}.md" for name in laws]},
        {"Keys of files": ["reference/keys/README.md", "reference/keys/frame.md"]},
    ]


@pytest.mark.parametrize("name", [name for name in edesign.__all__ if not name.startswith("__")])
def test_public_function_stands_on_the_page_of_python(name: str) -> None:
    function = getattr(edesign, name)
    assert f"::: {function.__module__}.{name}\n" in (DOCS / "reference" / "python.md").read_text(encoding="utf-8")


def test_pages_load_nothing_from_other_hosts() -> None:
    assert CONFIG["theme"]["font"] is False
    scripts = [*CONFIG["extra"]["polyfills"], *CONFIG["extra_css"], *CONFIG.get("extra_javascript", [])]
    assert all((DOCS / name).is_file() for name in scripts)
    pictures = re.compile(r"!\[[^\]]*\]\((https?:[^)]*)\)|<(?:img|script)[^>]*https?:")
    assert [page.name for page in DOCS.rglob("*.md") if pictures.search(page.read_text(encoding="utf-8"))] == []


def test_pictures_are_small() -> None:
    large = [p.name for p in (DOCS / "tutorials" / "figures").iterdir() if p.stat().st_size > 150_000]
    assert large == []


def test_result_of_the_readme_is_that_of_the_tutorial() -> None:
    """The table of README.md rounds what the first tutorial prints, which a test repeats."""
    tutorial = (DOCS / "tutorials" / "first_damped_building.md").read_text(encoding="utf-8")
    readme = (ROOT / "README.md").read_text(encoding="utf-8")
    rows = {
        "interstorey drift": ("interstorey drift [%]", 1.0),
        "base shear of the columns": ("base shear, columns [kN]", 1.0),
        "roof acceleration": ("roof acceleration [m/s2]", 1.0),
        "plastic rotation of beams": ("beam plastic rotation [rad]", 1e3),
        "axial force of the columns": ("column axial force [kN]", 1.0),
    }
    for shown, (printed, factor) in rows.items():
        bare, damped, change = re.search(rf"^{re.escape(printed)} +(\S+) +(\S+) +(\S+)$", tutorial, re.M).groups()
        cells = re.search(rf"^\| {shown} \| (\S+) .*?\| (\S+).*?\| (\S+) % \|$", readme, re.M).groups()
        # within half of the last digit that is shown
        for cell, value in zip(cells, (factor * float(bare), factor * float(damped), float(change)), strict=True):
            half = 0.5 * 10.0 ** -len(cell.partition(".")[2])
            assert abs(float(cell) - value) <= 1.001 * half, (shown, cell, value)
    grown, pulled = re.search(r"^damped, DBE +\S+ % storey \d +\+(\S+) % \w+ +(\w+)$", tutorial, re.M).groups()
    assert f"carries {float(grown):.0f} % more" in readme.replace("\n", " ")
    assert pulled == "none" and "no column goes into tension" in readme.replace("\n", " ")


def test_links_say_where_they_lead() -> None:
    """A reader sees the name of a page, not that of its file; links inside the docs lead to pages that are there."""
    unnamed, broken = [], []
    for page in [*DOCS.rglob("*.md"), ROOT / "README.md"]:
        text = page.read_text(encoding="utf-8")
        unnamed += [f"{page.name}: {found}" for found in re.findall(r"\[[\w/]+\.md\]\(", text)]
        for target in re.findall(r"\]\((?!\w+:)([^)#\s]+)", text):
            broken += [] if (page.parent / target).exists() else [f"{page.name}: {target}"]
    assert unnamed == [] and broken == []


@pytest.mark.slow
def test_site_is_built_without_a_broken_link(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Strict: unknown pages, anchors and functions of the reference are errors. The search index opens as a file."""
    build = pytest.importorskip("mkdocs.commands.build")
    pytest.importorskip("mkdocstrings_handlers.python")
    from mkdocs.config import load_config

    monkeypatch.setenv("NO_MKDOCS_2_WARNING", "1")
    build.build(load_config(str(ROOT / "mkdocs.yml"), site_dir=str(tmp_path)))
    assert (tmp_path / "search" / "search_index.js").is_file()
    index = (tmp_path / "index.html").read_text(encoding="utf-8")
    assert re.findall(r'<(?:script|link|img)[^>]*(?:src|href)="https?:[^"]*', index) == []
