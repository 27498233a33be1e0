"""Pages get no more long sentences and lines than they have; new pages have none."""

from __future__ import annotations

import yaml

from tools import prose


def test_no_page_becomes_harder_to_read() -> None:
    allowed = yaml.safe_load(prose.BASELINE.read_text(encoding="utf-8"))
    none = {"sentences": 0, "lines": 0}
    worse = {
        page: f"{found}, allowed are {allowed.get(page, none)}"
        for page, found in prose.counts().items()
        if any(found[kind] > allowed.get(page, none)[kind] for kind in found)
    }
    assert worse == {}, f"python tools/prose.py PAGE lists them: {worse}"


def test_what_counts() -> None:
    long = "word " * 26
    assert [number for number, _ in prose.long_sentences(f"# Title\n\nShort. {long}end.\n")] == [3]
    assert not [*prose.long_sentences(f"    {long}\n\n```\n{long}\n```\n")]
    assert not [*prose.long_sentences(f"<!-- begin table -->\n{long}\n<!-- end -->\n")]
    assert [number for number, _ in prose.long_lines("x\n" + "y" * 101 + "\n| " + "z" * 200 + " |\n")] == [2]


def test_wrapping_changes_no_word() -> None:
    page = "# T\n\n- " + "one two - three 1. four " * 12 + "\n\n    " + "code " * 40 + "\n\n| " + "cell " * 40 + "|\n"
    made = prose.wrapped(page)
    assert made.split() == page.split() and max(len(line) for line in made.splitlines()[2:5]) <= prose.WRAPPED
    assert made.count("\n- ") == 1 and prose.wrapped(made) == made
