"""Selections: reading, meaning, and writing them again."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st
from pydantic_core import PydanticCustomError

from edesign.project.notation.names import line_index, line_name
from edesign.project.notation.selections import parse_lines, parse_numbers, parse_numbers_or_none
from edesign.project.reading.yaml_nodes import parse

LINES = tuple(line_name(i) for i in range(60))


@pytest.mark.parametrize(
    ("value", "numbers"),
    [
        ("all", (1, 2, 3, 4, 5, 6, 7, 8)),
        (3, (3,)),
        ("3", (3,)),
        ("1-4", (1, 2, 3, 4)),
        ("2 - 3", (2, 3)),
        ((1, 3, "5-7"), (1, 3, 5, 6, 7)),
        (("5-7", 1, 6), (1, 5, 6, 7)),
    ],
)
def test_numbers(value: object, numbers: tuple[int, ...]) -> None:
    assert parse_numbers(value).numbers(1, 8) == numbers


@pytest.mark.parametrize(
    ("value", "lines"),
    [("all", ("A", "B", "C", "D")), ("B", ("B",)), ("B-D", ("B", "C", "D")), (("D", "A"), ("A", "D"))],
)
def test_lines(value: object, lines: tuple[str, ...]) -> None:
    assert parse_lines(value).names(("A", "B", "C", "D")) == lines


def test_none_is_no_floor_where_it_is_allowed() -> None:
    assert parse_numbers_or_none("none").numbers(1, 8) == ()
    with pytest.raises(PydanticCustomError):
        parse_numbers("none")


@pytest.mark.parametrize("value", ["4-1", 1.5, True, None, "", (), "1-2-3", "A", -1, {"a": 1}, ((1,),), "1,2"])
def test_what_is_no_selection_of_numbers(value: object) -> None:
    with pytest.raises(PydanticCustomError):
        parse_numbers(value)


@pytest.mark.parametrize("value", ["D-A", 1, "a", None, (), "A-", "A-B-C", True])
def test_what_is_no_selection_of_lines(value: object) -> None:
    with pytest.raises(PydanticCustomError):
        parse_lines(value)


def test_lines_beyond_z() -> None:
    assert [line_name(i) for i in (0, 25, 26, 27, 51, 52, 701, 702)] == ["A", "Z", "AA", "AB", "AZ", "BA", "ZZ", "AAA"]
    assert parse_lines("Y-AB").names(LINES) == ("Y", "Z", "AA", "AB")


@given(st.integers(0, 20_000))
def test_line_names_and_positions_are_inverse(index: int) -> None:
    assert line_index(line_name(index)) == index


def _spans(low: int, high: int) -> st.SearchStrategy[list[tuple[int, int]]]:
    span = st.tuples(st.integers(low, high), st.integers(low, high)).map(lambda ends: (min(ends), max(ends)))
    return st.lists(span, min_size=1, max_size=6)


@given(_spans(1, 30))
def test_numbers_come_back_from_their_text(spans: list[tuple[int, int]]) -> None:
    chosen = parse_numbers(tuple(f"{a}-{b}" for a, b in spans))
    again = parse_numbers(parse(f"x: {chosen}")[0].plain()["x"])
    assert again == chosen and str(again) == str(chosen)
    assert chosen.numbers(1, 25) == tuple(sorted({n for a, b in spans for n in range(a, b + 1) if n <= 25}))


@given(_spans(0, 59))
def test_lines_come_back_from_their_text(spans: list[tuple[int, int]]) -> None:
    chosen = parse_lines(tuple(f"{line_name(a)}-{line_name(b)}" for a, b in spans))
    again = parse_lines(parse(f"x: {chosen}")[0].plain()["x"])
    assert again == chosen
    assert chosen.names(LINES) == tuple(line_name(i) for i in sorted({n for a, b in spans for n in range(a, b + 1)}))
