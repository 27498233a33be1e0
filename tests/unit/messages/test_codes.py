"""Every message that refuses an input has a code, and every code a remedy in docs/reference/messages.

The sentences stand in sentences.txt alone; tests of single inputs look for the place and the code.
`make messages` writes that file anew after a sentence has changed.
"""

from __future__ import annotations

import re

import pytest

from edesign.errors import split_code
from tools.messages import ROOT, SENTENCES, sentences, text_of, uncoded

PAGES = ROOT / "docs" / "reference" / "messages"
PACKAGE = ROOT / "edesign"


@pytest.mark.parametrize("part", sorted(path.name for path in PACKAGE.iterdir() if path.name != "__pycache__"))
def test_every_sentence_has_a_code(part: str) -> None:
    place = PACKAGE / part
    files = sorted(place.rglob("*.py")) if place.is_dir() else [place] * (place.suffix == ".py")
    assert [f"{path}:{node.lineno}: {text_of(node)}" for path in files for node in uncoded(path)] == []


def test_every_code_has_a_remedy() -> None:
    """A section a code: what is wrong, and what to do."""
    pages = "".join(path.read_text(encoding="utf-8") for path in PAGES.glob("*.md"))
    remedies = dict(re.findall(r"^### (E-[A-Z0-9]+-\d\d)\n(.+?)(?=\n\n|\Z)", pages, re.MULTILINE | re.DOTALL))
    assert len(remedies) == pages.count("\n### ")  # none twice
    statuses = re.findall(r"X\(ED_E_\w+, -(\d+),", (ROOT / "core_c/include/edstatus.h").read_text(encoding="utf-8"))
    of_core = {f"E-CORE-{int(number):02d}" for number in statuses}
    assert set(remedies) == {code for code, _ in sentences(PACKAGE)} | of_core
    assert [code for code, text in remedies.items() if len(re.findall(r"[.;:](?:\s|$)", text)) < 2] == []


def test_the_sentences_are_those_of_the_golden_file() -> None:
    assert "".join(f"{code}  {text}\n" for code, text in sentences(PACKAGE)) == SENTENCES.read_text(encoding="utf-8")


def test_a_code_is_split_off_wherever_it_stands() -> None:
    assert split_code("a [1, 2] b [E-TABLE-08]") == ("a [1, 2] b", " [E-TABLE-08]")
    assert split_code("a [E-TABLE-08]\n  b") == ("a\n  b", " [E-TABLE-08]")
    assert split_code("a [1, 2]") == ("a [1, 2]", "")
