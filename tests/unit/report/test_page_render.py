"""Tables and text on the page: escaping, alignment, verdicts that are words."""

from __future__ import annotations

import re

import pytest

from edesign.report.page.render import Cover, alignments, render, state, typeset
from edesign.report.page.section import Section
from edesign.report.tables.table import Table

HOSTILE = "<img src=x onerror=alert(1)> & \"quotes\" 'too' -> T_B"


def test_numbers_stand_right_words_left_sentences_in_lines() -> None:
    rows = [
        ["a", "1.2e-05", "0.4 -> 0.5", "4 of 4", "met", "a sentence that is longer than a column should be"],
        ["b", "-", "+12.5", "-3", "-", "short"],
    ]
    table = Table("t", ("name", "x", "pair", "count", "verdict", "text"), rows)
    assert alignments(table) == ["text", "right", "right", "right", "text", "long"]


@pytest.mark.parametrize(
    ("cell", "found"),
    [("met", "good"), ("NOT MET", "bad"), ("failed", "bad"), ("open", "open"), ("metal", ""), ("-", "")],
)
def test_verdicts(cell: str, found: str) -> None:
    assert state(cell) == found


def test_signs_of_print_and_escaping() -> None:
    assert typeset("-") == "–"
    assert typeset("1 m/s2 -> 20 degC, gamma_I") == "1 m/s² → 20 °C, γ<sub>I</sub>"
    assert typeset("max_T_B_x <b>") == "max_T_B_x &lt;b&gt;"


def test_everything_in_a_page_is_escaped_and_verdicts_are_words() -> None:
    table = Table(HOSTILE, ("a", HOSTILE), [[HOSTILE, "not met"]], [HOSTILE])
    section = Section("one", HOSTILE, (HOSTILE,), (table,), (HOSTILE,))
    page = render(Cover(HOSTILE, HOSTILE, HOSTILE, HOSTILE, HOSTILE), [section])
    assert "<img" not in page and page.count("&lt;img src=x onerror=alert(1)&gt;") >= 12
    assert re.search(r'<td class="text"><span class="badge bad">not met</span></td>', page)
    assert re.search(r'<th scope="col"[^>]*>a</th>', page) and re.search(r'<th scope="row"', page)
    assert "Not complete." in page
