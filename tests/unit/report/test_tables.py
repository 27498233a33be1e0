"""Tables as text: numbers that can be compared, and tables that fit a terminal."""

from __future__ import annotations

import io
import re

import numpy as np
import pytest
from plain_tables import plain_table

from edesign.archive.dataset import Group, Variable
from edesign.report.response.analysis_tables import fallbacks_table
from edesign.report.response.brace_table import brace_table
from edesign.report.tables.column import col, text
from edesign.report.tables.table import Row, TableSpec
from edesign.report.tables.text import filled, fitted, folded, in_facts, print_tables, printed, progress_text
from edesign.report.tables.unit import KN, KN_M, ONE


@pytest.mark.parametrize(
    ("value", "said"),
    [
        (None, "-"),
        (0.0, "0"),
        (1e-12, "0"),  # below what is negligible
        (0.012345, "0.01235"),
        (123.456, "123.5"),
        (-12345.6, "-12346"),
        (9999.7, "10000"),  # rounds up to a number of five digits
        (9.9e6, "9900000"),
        (5.35835968e17, "5.358e+17"),  # of a run that went astray: no wall of digits
    ],
)
def test_numbers_have_four_significant_digits(value: float | None, said: str) -> None:
    assert col("x", ONE, negligible=1e-9).text(value) == said


WIDE = plain_table(
    "Peaks",
    ("analysis", "roof u [m]", "base shear [kN]", "status"),
    [["modes", "0.1234", "1234", "completed"], ["el_centro", "0.0001", "-", "failed"]],
    ["* a note"],
)


def test_a_wide_table_is_cut_between_columns_and_repeats_the_first() -> None:
    wide = printed(WIDE)
    assert folded(wide, 200) == [wide]
    parts = folded(wide, 34)
    assert [list(part.columns) for part in parts] == [["analysis", "roof u [m]"], ["analysis", "base shear [kN]"]] + [
        ["analysis", "status"]
    ]
    assert parts[1].rows == [["modes", "1234"], ["el_centro", "-"]]
    assert [part.title for part in parts] == ["Peaks", "", ""] and [part.notes for part in parts] == [
        [],
        [],
        WIDE.notes,
    ]


def test_columns_that_distinguish_rows_are_repeated() -> None:
    """The third cycle of a test and the mean of all have one name."""
    rows = [["sine", "3", "1.2", "8.8"], ["sine", "1-18", "1.2", "8.9"]]
    parts = folded(printed(plain_table("Tests", ("test", "cycle", "x0 [mm]", "k' [kN/mm]"), rows, keys=2)), 28)
    assert [list(part.columns) for part in parts] == [["test", "cycle", "x0 [mm]"], ["test", "cycle", "k' [kN/mm]"]]
    assert [part.left for part in parts] == [2, 2]
    much = plain_table(
        "Tests", ("test", "cycle", "x0 [mm]", "k' [kN/mm]"), [[10 * "x", *row[1:]] for row in rows], keys=2
    )
    assert [list(part.columns)[0:2] for part in folded(printed(much), 28)][-1] == ["test", "k' [kN/mm]"]


def test_a_column_that_is_wider_than_the_terminal_stands_alone() -> None:
    assert [len(part.columns) for part in folded(printed(WIDE), 10)] == [2, 2, 2]
    heading = printed(plain_table("t", (), [["archive", "x" * 100]], keys=2))
    assert folded(heading, 10) == [heading]


class Terminal(io.StringIO):
    """A stream that says it is a terminal."""

    def isatty(self) -> bool:
        return True


def test_no_table_in_a_pipe_is_wider_than_120_characters() -> None:
    stream = io.StringIO()
    note = "a sentence that is longer than a line of a file, " * 4
    columns = ["storey", *(f"quantity number {i}" for i in range(20))]
    print_tables([plain_table("Wide", columns, [[str(i) for i in range(21)]], [note])], stream)
    lines = stream.getvalue().splitlines()
    assert max(map(len, lines)) <= 120
    assert " ".join(lines).count("quantity number") == 20 and " ".join(lines).count("a sentence that is longer") == 4


@pytest.mark.parametrize("columns", [34, 40, 80, 200])
def test_no_number_is_broken_on_a_terminal(columns: int, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("TERM", "xterm")
    monkeypatch.setenv("NO_COLOR", "1")
    monkeypatch.setenv("COLUMNS", str(columns))
    stream = Terminal()
    print_tables([WIDE], stream)
    text = re.sub(r"\x1b\[[0-9;]*m", "", stream.getvalue())
    words = text.split()
    assert {"0.1234", "0.0001", "1234", "completed", "failed", "el_centro"} <= set(words)
    assert max(len(line) for line in text.splitlines()) <= columns


def test_columns_count_in_pipes_too(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("COLUMNS", "80")
    stream = io.StringIO()
    print_tables([WIDE], stream)
    assert max(map(len, stream.getvalue().splitlines())) <= 80
    assert max(map(len, filled("a paragraph of words " * 20, stream).splitlines())) <= 80


def test_a_line_of_progress_is_broken_under_its_text(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("COLUMNS", "40")
    text = "  test_01: read: rest before the motion for 0.052 s, and more of it"
    lines = progress_text("   4.3 s  ", text, Terminal()).splitlines()
    assert lines == [
        "   4.3 s    test_01: read: rest before",
        "              the motion for 0.052 s,",
        "              and more of it",
    ]
    assert progress_text("   4.3 s  ", text, io.StringIO()) == f"   4.3 s  {text}"


def test_a_file_gets_the_table_in_one_piece(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv("COLUMNS", raising=False)
    stream = io.StringIO()
    print_tables([WIDE], stream)
    assert stream.getvalue().splitlines()[1].split() == [
        "analysis",
        "roof",
        "u",
        "[m]",
        "base",
        "shear",
        "[kN]",
        "status",
    ]


@pytest.mark.parametrize(
    ("kind", "header"), [("gravity", "load factor"), ("pushover", "roof u [m]"), ("history", "time [s]")]
)
def test_fallbacks_stand_where_the_run_was(kind: str, header: str) -> None:
    event = {"time": 0.125, "step": 7, "rung": "new factors", "detail": "step / 1, converged after 3 iterations"}
    table = fallbacks_table("a", Group(attributes={"kind": kind, "events": [event]}))
    assert table.headers[1] == header
    assert table.texts == [["7", "0.1250", "new factors", "step / 1, converged after 3 iterations"]]


def test_a_brace_that_was_never_in_tension_has_none() -> None:
    group = Group()
    for dim in ("brace", "buckling_brace"):
        group.coords[dim] = Variable((dim,), np.array(["D_1_1_r"]), "", dim)
    for kind, low, high in (("axial_force", -2e5, -9e4), ("ductility", -1.5, -0.062)):
        dim = "brace" if kind == "axial_force" else "buckling_brace"
        group.add(f"brace_{kind}_min", (dim,), [low], "1", "least")
        group.add(f"brace_{kind}_max", (dim,), [high], "1", "largest")
    (row,) = brace_table({"push": group}).texts
    assert row[2].startswith("200") and [float(row[3]), float(row[5])] == [0.0, 0.0]


def test_long_facts_go_on_below_themselves() -> None:
    lines = in_facts("loads:", "floor 1: G 2.0 kN\nbuilding: G 12.0 kN, self_weight 3.0 kN", 8, 30)
    assert lines == [
        "loads:  floor 1: G 2.0 kN",
        "        building: G 12.0 kN,",
        "          self_weight 3.0 kN",
    ]


def test_what_is_rounding_beside_the_largest_of_its_unit_is_0() -> None:
    """1e-12 of 2704 kN is 2.7e-9 kN; a moment has a scale of its own, and ratios have none."""
    spec = TableSpec[Row]("t", "T", (text("of"), col("V", KN), col("M", KN_M), col("error", ONE)))
    table = spec.of([("a", 2.704e6, 1.2e-13, 1e-16), ("b", 8.6e-12, 3.0e3, 2.0)])
    assert table.texts == [["a", "2704", "0", "1.000e-16"], ["b", "0", "3.000", "2.000"]]
    assert table.rows[1][1] == 8.6e-12  # files keep it


def test_parts_of_a_table_repeat_the_columns_that_tell_rows_apart_though_cells_are_broken() -> None:
    spec = TableSpec[Row]("t", "T", (text("kind"), text("section"), text("each", broken=1), text("cost")), keys=2)
    rows = [("column", f"HEB{size}", "12 x 3.90, 12 x 4.50, 8 x 5.10", "9" * 20) for size in (300, 400)]
    first, second = fitted(spec.of(rows), 44)
    assert list(second.columns) == ["kind", "section", "cost"] and len(first.rows) > len(second.rows) == 2
