"""What the tutorials say to write and to run is done as it stands there, and prints what they show."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from tools import doc_pages

DOCS = Path(__file__).parents[3] / "docs"
LONG = {"what_the_law_lacks", "damper_test", "building", "irregular_plan", "index"}  # searches, fits, buildings


def pages() -> list[Any]:
    """Pages with examples, the long ones marked."""
    found = [page for page in sorted(DOCS.rglob("*.md")) if any(doc_pages.steps(page.read_text(encoding="utf-8")))]
    return [pytest.param(page, id=page.stem, marks=[pytest.mark.slow] if page.stem in LONG else []) for page in found]


@pytest.mark.parametrize("page", pages())
def test_page_does_what_it_says(page: Path, tmp_path: Path) -> None:
    wrong = []
    for step, printed in doc_pages.follow(page, tmp_path):
        said = doc_pages.difference(step.text, printed) if step.kind == "run" else ""
        wrong += [f"{page.name}:{step.line}: {step.name}\n{said}"] if said else []
    assert not wrong, "\n\n".join(wrong)


def test_a_line_that_is_not_printed_is_reported() -> None:
    assert doc_pages.difference("a 1.00\n...\nb 2 ...\n", "a 1.01\nx\nb 2 3\n") == ""
    assert doc_pages.difference("a 1.00\nb\n", "a 1.05\nb\n").startswith("not printed: a 1.00")
    assert doc_pages.difference("a\n", "a\nb\n") == "printed as well: b"
    assert doc_pages.difference("a\n...\n", "a\nb\nc\n") == ""
