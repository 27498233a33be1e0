"""Tables and text on the page: escaping, alignment, verdicts that are words."""

from __future__ import annotations

import re

import pytest
from plain_tables import plain_table

from edesign.report.html.render import Cover, alignments, render, typeset
from edesign.report.html.section import Section
from edesign.report.tables.cell import Verdict
from edesign.report.tables.column import col, count, text, verdict
from edesign.report.tables.table import Row, TableSpec
from edesign.report.tables.unit import ONE

HOSTILE = "<img src=x onerror=alert(1)> & \"quotes\" 'too' -> T_B"


@pytest.mark.parametrize(
    ("plain", "printed"),
    [
        ("-1.1", "−1.1"),
        ("1.849 (-0.0076 %)", "1.849 (−0.0076 %)"),
        ("0.1 -> -0.2", "0.1 → −0.2"),
        ("FER-L1, 1-15, EN 1998-1, 2026-11-27, run-3.csv", "FER-L1, 1-15, EN 1998-1, 2026-11-27, run-3.csv"),
        ("3.1e-04 of the input", "3.1 × 10<sup>−4</sup> of the input"),
        ("alpha_2 [1e-6 s2]", "α<sub>2</sub> [10<sup>−6</sup> s²]"),
        ("1.5e+16", "1.5 × 10<sup>16</sup>"),
        ("`tolerance: 1e-5, -3`, 5e-3.csv", "<code>tolerance: 1e-5, -3</code>, 5e-3.csv"),
    ],
)
def test_numbers_have_the_signs_of_print_and_names_stay(plain: str, printed: str) -> None:
    assert typeset(plain) == printed


def test_numbers_stand_right_words_left_sentences_in_lines() -> None:
    rows = [
        ("a", 1.2e-05, 4, Verdict("met", "good"), "a sentence that is longer than a column should be"),
        ("b", None, -3, None, "short"),
    ]
    columns = (text("name"), col("x", ONE), count("count"), verdict("verdict"), text("text"))
    assert alignments(TableSpec[Row]("t", "t", columns).of(rows)) == ["text", "right", "right", "text", "long"]


def test_signs_of_print_and_escaping() -> None:
    assert typeset("-") == "–"
    assert typeset("1 m/s2 -> 20 degC, gamma_I") == "1 m/s² → 20 °C, γ<sub>I</sub>"
    assert typeset("pulled with gamma_Rd Omega, by F_z; Omega_1") == (
        "pulled with γ<sub>Rd</sub> Ω, by F<sub>z</sub>; Omega_1"
    )
    assert typeset("max_T_B_x <b>") == "max_T_B_x &lt;b&gt;"


def test_everything_in_a_page_is_escaped_and_verdicts_are_words() -> None:
    table = plain_table(HOSTILE, ("a", HOSTILE), [[HOSTILE, Verdict("not met", "bad")]], [HOSTILE])
    section = Section("one", HOSTILE, (HOSTILE,), (table,), (HOSTILE,))
    page = render(Cover(HOSTILE, HOSTILE, HOSTILE, HOSTILE, HOSTILE), [section])
    assert "<img" not in page and page.count("&lt;img src=x onerror=alert(1)&gt;") >= 12
    assert re.search(r'<td class="text"><span class="badge bad">not met</span></td>', page)
    assert re.search(r'<th scope="col"[^>]*>a</th>', page) and re.search(r'<th scope="row"', page)
    assert "Not complete." in page
