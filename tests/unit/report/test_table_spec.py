"""Tables as declarations: what is printed, what files get, and that one list knows them all."""

from __future__ import annotations

import math
import re
from pathlib import Path
from typing import NamedTuple

import pytest

import edesign
from edesign.report.export.export_table import export_table
from edesign.report.export.tables_by_name import tables_by_name
from edesign.report.html.render import alignments, cells
from edesign.report.tables.cell import Listed, Marked, Quantity, Rounded, Value, Verdict
from edesign.report.tables.column import bounded, col, count, formula, known, literal, text, verdict
from edesign.report.tables.table import MORE, Row, TableSpec
from edesign.report.tables.text import plain
from edesign.report.tables.unit import KN, MM, ONE, PERCENT, Unit


class Storey(NamedTuple):
    """An item of the tables of these tests."""

    name: str
    bays: int
    drift: float | None
    shear: Value = None
    answer: Verdict = Verdict("met", "good")


STOREYS = TableSpec[Storey](
    "storeys",
    "{whose}: storeys",
    (
        text("storey", "name"),
        count("bays", "bays"),
        col("drift [] at the end", PERCENT, "drift", 3, mark=lambda storey: "*" if storey.bays == 2 else ""),
        col("V", KN, "shear", optional=True),
        formula("rule", lambda storey: "V_Ed / V_Rd"),
        verdict("drift", "answer", name="verdict"),
    ),
    notes=("* of {years} years",),
    signs=("*: of two bays", "+: of none"),
    each="Storeys",
)
ITEMS = (Storey("1", 3, 0.0123456), Storey("2", 2, 0.07), Storey("3", 2, None, answer=Verdict("not met", "bad")))


def test_a_table_is_its_declaration() -> None:
    table = STOREYS.of(ITEMS, whose="bare", years=50)
    assert plain(table).splitlines()[0::6] == ["bare: storeys", "* of 50 years"]
    assert table.notes == ["* of 50 years", "*: of two bays"]
    assert table.headers == ["storey", "bays", "drift [%] at the end", "rule", "drift"]  # no shear anywhere
    assert [row[2] for row in table.texts] == ["1.23", "7.00*", "-*"]
    assert table.each == ("Storeys", "bare") and table.column("bays") == [3, 2, 2]
    assert alignments(table) == ["text", "right", "right", "text", "text"]
    assert alignments(STOREYS.of((), whose="bare")) == ["text", "right", "right", "text", "text"]
    assert cells(table)[2][-1] == ("not met", "bad", False) and cells(table)[0][3][2]


def test_files_get_numbers_with_all_digits_and_units() -> None:
    name, bays, drift, rule, answer = export_table("storeys", STOREYS.of(ITEMS, whose="a", years=50)).columns
    assert (drift.name, drift.unit) == ("drift at the end", "%")
    assert drift.values[0] == 0.0123456 / 0.01 and drift.values[2] == "-*" and bays.values == [3, 2, 2]
    assert answer.name == "verdict" and list(answer.values) == ["met", "met", "not met"]


@pytest.mark.parametrize(
    ("value", "shown", "data"),
    [
        (1234.5, "1.234", 1.2345),
        (0.4, "0", 0.0),  # below what is negligible
        (None, "-", None),
        ("none", "none", "none"),
        (Marked(1500.0, " (mean)", "> "), "> 1.500 (mean)", 1.5),
        (Quantity(0.0123, MM, 3), "12.3 mm", 12.3),
        (Rounded("1230", 1234.567), "1230", 1234.567),  # as its error leaves it
        (Listed((1e3, 2e3)), "1.000, 2.000", "1.000, 2.000"),
    ],
)
def test_cells(value: Value, shown: str, data: object) -> None:
    column = col("V", KN, "shear", negligible=0.5)
    assert column.text(value) == shown and column.data(value) == pytest.approx(data) if data else not column.data(value)


def test_units_of_several_numbers_have_a_column_in_files() -> None:
    spec = TableSpec[Value]("mixed", "Mixed", (text("what", lambda _: "x"), col("value", ONE, lambda value: value)))
    table = export_table("mixed", spec.of([Quantity(0.01, MM), Quantity(2e3, KN), None]))
    assert [(column.name, list(column.values)) for column in table.columns[1:]] == [
        ("value", [10.0, 2.0, None]),
        ("unit of value", ["mm", "kN", None]),
    ]


def test_columns_may_be_left_out_added_and_have_the_unit_of_the_project() -> None:
    spec = TableSpec[Storey](
        "u",
        "U",
        (text("storey", "name"), col("u", "length", "drift"), count("bays", "bays")),
        most=2,
        cut="{shown}/{all}, {more} more",
    )
    more = [col("{times} u", "length", lambda storey: 2.0 * (storey.drift or 0.0))]
    table = spec.of(
        ITEMS, without=("bays",), more=more, units={"length": Unit("cm", 0.01)}, times=2, heading=lambda s: "all"
    )
    assert table.headers == ["storey", "u [cm]", "2 u [cm]"] and table.texts[1] == ["2", "7.000", "14.00"]
    assert table.notes == ["2/3, 1 more"] and table.headings == {0: "all"}


def test_a_sign_may_stand_behind_a_blank() -> None:
    spec = TableSpec[str]("names", "Names", (text("name", lambda name: Marked(name, " *")),), signs=("* not done",))
    assert (spec.of(["a"]).texts, spec.of(["a"]).notes) == ([["a *"]], ["* not done"])


def test_columns_of_one_table_stand_where_the_declaration_says() -> None:
    spec = TableSpec[Storey]("u", "U", (text("storey", "name"), MORE, count("bays", "bays")), named_as="all_u")
    table = spec.of(ITEMS, more=[col(literal("{u}"), MM, "drift")])
    assert table.headers == ["storey", "{u} [mm]", "bays"] and table.name == "all_u"
    assert spec.of(ITEMS).headers == ["storey", "bays"]


def test_a_row_may_be_a_tuple_of_its_values() -> None:
    spec = TableSpec[Row]("u", "U", (text("storey"), col("u", MM, mark=lambda row: "*" if row[0] == "1" else ""), MORE))
    table = spec.of([("1", 0.012, 2e3), ("2", None, 3e3)], more=[col("V", KN)])
    assert table.texts == [["1", "12.00*", "2.000"], ["2", "-", "3.000"]]


def test_columns_read_attributes_of_attributes_where_they_are_known() -> None:
    class Pair(NamedTuple):
        low: Storey
        high: Storey

    columns = (text("low", "low.name"), col("u", ONE, known("low.drift"), 2), col("V", ONE, bounded("high.drift"), 2))
    pairs = [Pair(Storey("1", 2, 0.5), Storey("2", 2, math.inf)), Pair(Storey("1", 2, math.nan), Storey("2", 2, 0.3))]
    assert TableSpec[Pair]("u", "U", columns).of(pairs).texts == [["1", "0.50", "-"], ["1", "-", "0.30"]]


def test_all_tables_are_found_by_their_names() -> None:
    """None has the name of another, which the function refuses."""
    sources = (path.read_text(encoding="utf-8") for path in (Path(edesign.__file__).parent / "report").rglob("*.py"))
    declared = sum(
        len(re.findall(r"^[A-Z_0-9]+ = (?:TableSpec\[|_table\()", source, re.MULTILINE)) for source in sources
    )
    assert declared == len(tables_by_name())
