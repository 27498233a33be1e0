"""YAML as the project file reads it: YAML 1.2 scalars, marks, no duplicates."""

from __future__ import annotations

import math
from typing import Any

import pytest
from hypothesis import example, given
from hypothesis import strategies as st
from messages import says

from edesign import yaml_parser
from edesign.project.reading import yaml_nodes
from edesign.project.reading.yaml_nodes import Mark, find, parse


def read(text: str) -> Any:
    root, faults = parse(text)
    assert not faults
    return root.plain()


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("1e-5", 1e-5),
        ("1E5", 1e5),
        ("-2.5e+3", -2500.0),
        (".5", 0.5),
        ("3.", 3.0),
        ("12", 12),
        ("-12", -12),
        ("010", 10),  # octal in YAML 1.1
        ("true", True),
        ("false", False),
        ("null", None),
        ("~", None),
        ("no", "no"),  # false in YAML 1.1
        ("on", "on"),
        ("1:30", "1:30"),  # 90 in YAML 1.1
        ("1_000", "1_000"),
        ("0x10", "0x10"),
        ("2020-01-01", "2020-01-01"),
        ("1-4", "1-4"),
        (".nan", ".nan"),
        (".inf", ".inf"),
        ("'12'", "12"),
        ('"1e-5"', "1e-5"),
        ("3.5 m", "3.5 m"),
    ],
)
def test_scalars_follow_yaml_1_2(text: str, value: object) -> None:
    got = read(f"a: {text}")["a"]
    assert got == value and type(got) is type(value)


def test_overflowing_numbers_stay_visible() -> None:
    assert math.isinf(read("a: 1e999")["a"])


def test_marks_count_from_one() -> None:
    root, _ = parse("a:\n  b: [1, {c: 2}]\n")
    assert find(root, ("a", "b", 1, "c")).mark == Mark(2, 14)
    assert root.entries is not None and root.entries["a"].key_marks["b"] == Mark(2, 3)
    assert find(root, ("a", "b", 7)).mark == Mark(2, 6), "the nearest part that exists"


def test_duplicate_keys_are_all_found_and_the_first_stays() -> None:
    root, faults = parse("a: 1\nb: {c: 1, c: 2}\na: 2\n")
    assert [(f.mark, f.keys) for f in faults] == [(Mark(2, 11), ("b", "c")), (Mark(3, 1), ("a",))]
    assert root.plain() == {"a": 1, "b": {"c": 1}}


@pytest.mark.parametrize(
    ("text", "mark", "said"),
    [
        ("a: &x 1", Mark(1, 4), "`&x` E-FILE-04"),
        ("a: *x", Mark(1, 4), "`*x` E-FILE-04"),
        ("a: !!str 1", Mark(1, 4), "tag E-FILE-04"),
        ("a: !python/object:os.system 1", Mark(1, 4), "tag E-FILE-04"),
        ("<<: *x", Mark(1, 5), "alias E-FILE-04"),
        ("a: 1\n---\nb: 2", Mark(2, 1), "document E-FILE-04"),
        ("a: [1, 2\nb: 3", Mark(2, 2), "E-FILE-04"),
        ("a:\n\tb: 1", Mark(2, 1), "tabs E-FILE-04"),
        ("? [1, 2]\n: 3", Mark(1, 3), "key E-FILE-04"),
        ("a: \x01", Mark(1, 4), "E-FILE-04"),
    ],
)
def test_what_is_refused(text: str, mark: Mark, said: str) -> None:
    _, faults = parse(text)
    assert faults[0].mark == mark
    assert says(faults[0].message, said)


SPECIAL = [" ", "\n", "\n\n", ":", "- ", "#", '"', *"[]{},?\té", "&a ", "*a", "!t ", "|\n", ">-\n  ", "---\n"]
SAMPLE = """title: frame  # of two bays
sections: {column: HEB300, beam: "IPE400"}
analyses:
  - {name: modes, kind: modal, modes: 3}
  - name: push
    note: >-
      as long as
      it holds
    steps: [1, 2.5e-3, no]
"""


@pytest.mark.skipif(yaml_parser._QUICK is None, reason="PyYAML was built without libyaml")
@example([(148, 0, "#")])  # a comment at the head of a block of text
@given(st.lists(st.tuples(st.integers(0, len(SAMPLE)), st.integers(0, 2), st.sampled_from(SPECIAL)), max_size=3))
def test_libyaml_reads_the_same(edits: list[tuple[int, int, str]]) -> None:
    """Tree, marks and faults, as by PyYAML's own parser, of texts right and wrong."""
    text = SAMPLE
    for place, cut, new in edits:
        text = text[:place] + new + text[place + cut :]
    quickly = yaml_nodes.parse(text)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(yaml_parser, "_QUICK", None)
        assert yaml_nodes.parse(text) == quickly
