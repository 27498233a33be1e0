"""Whole files that pages show, without commands of their own, are read as the program would read them."""

from __future__ import annotations

import re
import shutil
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from edesign.damper.testing.programme_file import load_programme
from edesign.ground_motion.suite import load_suite
from edesign.project.study.reference_loader import load_reference
from tools import doc_pages

ROOT = Path(__file__).parents[3]
LOADERS: dict[str, Callable[[Path], object]] = {
    "edesign_suite": load_suite,
    "edesign_reference": load_reference,
    "specimen": load_programme,
}
"""By the first key; other files are given to `edesign check`."""
KEY = re.compile(r"(?<=\n\n) {4}(edesign(?:_\w+)?): 1$", re.MULTILINE)


def texts() -> dict[str, str]:
    return {
        page.relative_to(ROOT / "docs").as_posix(): page.read_text(encoding="utf-8")
        for page in sorted((ROOT / "docs").rglob("*.md"))
    }


def examples() -> list[Any]:
    found = []
    for page, text in texts().items():
        made = list(doc_pages.steps(text))
        if made and all(step.kind == "write" for step in made):
            found += [pytest.param(step, id=f"{page}:{step.line}") for step in made]
    return found


@pytest.mark.parametrize("example", examples())
def test_whole_file_is_read(example: doc_pages.Step, tmp_path: Path) -> None:
    shutil.copytree(ROOT / "projects", tmp_path, dirs_exist_ok=True, ignore=shutil.ignore_patterns("*.h5", "*.html"))
    path = tmp_path / example.name
    path.write_text(example.text, encoding="utf-8")
    load = LOADERS.get(example.text.partition(":")[0])
    if load is not None:
        load(path)
    else:
        doc_pages.printed_by(f"edesign check {path}", tmp_path)


def test_every_whole_file_is_marked() -> None:
    """A block that begins with the key of a file is a whole file, and has the title that makes it an example."""
    unmarked = [
        f"{page}: {found[0].strip()}"
        for page, text in texts().items()
        for found in KEY.finditer(doc_pages.BLOCK.sub("", text))
    ]
    assert unmarked == []
