"""Names that the program made for analyses and records are words on the page."""

from __future__ import annotations

from dataclasses import replace

from plain_tables import plain_table

from edesign.archive.dataset import Group
from edesign.report.html.section import Facts, Folded, Section, Warnings
from edesign.report.page.words import analysis_words, in_words, words_of
from edesign.report.tables.table import Table

TABAS = "suite/Tabas1978_FER-L1"
NAME = "damped.35C.DBE.Tabas1978_FER-L1"


def group(kind: str, variant: str = "", record: str = "", level: str = "", **others: object) -> Group:
    return Group(attributes={"kind": kind, "variant": variant, "record": record, "level": level, **others})


def test_histories_name_variant_temperature_level_and_record() -> None:
    history = group("history", "damped", TABAS, "DBE", temperature_C=35.0)
    assert analysis_words(NAME, history) == "damped at 35 °C, DBE, Tabas 1978 FER-L1"
    scaled = group("history", "bare", TABAS)
    assert analysis_words("bare.ida.Tabas1978_FER-L1.1.5g", scaled) == "bare, ida, Tabas 1978 FER-L1, 1.5g"


def test_pushes_name_pattern_direction_and_method() -> None:
    pushed = group("target", "bare", level="MCE")
    words = "bare, push, first mode, to the left, N2, MCE"
    assert analysis_words("bare.push.first_mode.left.n2.MCE", pushed) == words


def test_names_that_people_gave_stay() -> None:
    assert analysis_words("el_centro", group("history", record="el_centro")) == "el_centro"
    two = {"a.DBE.x": group("history", "a", "s/x", "DBE"), "a.DBE.y": group("history", "a", "t/x", "DBE")}
    two["a.DBE.y"].attributes["record"] = "t/y"
    assert words_of(two, []) == {"a.DBE.x": "a, DBE, x", "a.DBE.y": "a, DBE, y"}


def test_what_would_become_alike_is_left_as_it_is() -> None:
    alike = {f"push.{name}.right": group("pushover") for name in ("first_mode", "first mode")}
    assert words_of(alike, []) == {}


def test_every_text_of_a_section_is_said_in_words_but_the_table_of_names() -> None:
    words = words_of({NAME: group("history", "damped", TABAS, "DBE", temperature_C=35.0)}, [TABAS])
    said = "damped at 35 °C, DBE, Tabas 1978 FER-L1"
    table = plain_table(f"{NAME}: dampers", ("analysis",), [[NAME]], [f"most in {NAME}."])
    kept = replace(plain_table("All", ("name",), [[NAME]]), names_kept=True)
    parts = (
        table,
        kept,
        Folded(NAME, (table,), NAME),
        Facts((("Worst", f"({NAME})"),)),
        Warnings("W", (f"{NAME}: x",)),
    )
    found = in_words(Section("id", "Title", (f"In {NAME}, {TABAS}.",), parts), words)
    assert found.intro == (f"In {said}, Tabas 1978 FER-L1.",)
    first, second, folded, facts, warnings = found.parts
    assert isinstance(first, Table) and isinstance(second, Table) and isinstance(folded, Folded)
    assert (first.title, first.texts, first.notes) == (f"{said}: dampers", [[said]], [f"most in {said}."])
    assert second.texts == [[NAME]]
    assert folded.summary == said and folded.text == NAME  # a file to the letter stays
    assert facts == Facts((("Worst", f"({said})"),)) and warnings == Warnings("W", (f"{said}: x",))


def test_notes_broken_for_a_terminal_are_one_again() -> None:
    long = "Members: Table 5-6. A column with P/P_CL > 0.5 is force-controlled and has to"
    section = Section("id", "T", (), (plain_table("", ("a",), [["1"]], [long, "stay elastic.", "Another note."]),))
    (table,) = in_words(section, {}).parts
    assert isinstance(table, Table) and table.notes == [f"{long} stay elastic.", "Another note."]


def test_a_long_note_is_not_joined_with_one_that_has_a_label() -> None:
    notes = [f"more than 30 % {'x' * 64}", "not met: of the other direction", "histories: 4 of 4"]
    (table,) = in_words(Section("id", "T", (), (plain_table("", ("a",), [["1"]], notes),)), {}).parts
    assert isinstance(table, Table) and table.notes == notes
