"""What pages name in code is there: names, files, tests, commands, options, sections; what is verified names a test."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from edesign.study.results.warnings import COMMON
from tools import doc_names

HERE = doc_names.ROOT / "docs" / "theory" / "core.md"


@pytest.mark.parametrize("page", doc_names.PAGES, ids=lambda page: page.relative_to(doc_names.ROOT).as_posix())
def test_page_names_what_there_is(page: Path) -> None:
    assert doc_names.faults(page) == []


@pytest.mark.parametrize(
    ("text", "reported"),
    [
        ("`drift_limits_of` is one", ["drift_limits_of"]),
        ("`drift_limit` and `SteelSection` are ones, `IPE_TREE` is not", ["IPE_TREE"]),
        ("    indented\n\nthen `no_such_name`", ["no_such_name"]),
        ("`hinge_rotation` is put together, `V_1_3_r` is a damper", []),
    ],
)
def test_names(text: str, reported: list[str]) -> None:
    assert [name for _, name in doc_names.unknown_names(text)] == reported


@pytest.mark.parametrize(
    ("text", "reported"),
    [
        ("`tests/verification/test_verify_nothing.py`", ["tests/verification/test_verify_nothing.py"]),
        ("`torsion.py`, `edesign/codes/ec8`, `effect_*.c`, `../../README.md`", []),
        ("`core_c/src/damper/NAME.c` and `test_no_such.c`", ["test_no_such.c"]),
    ],
)
def test_files(text: str, reported: list[str]) -> None:
    assert [name for _, name in doc_names.missing_files(text, HERE)] == reported


@pytest.mark.parametrize(
    ("text", "reported"),
    [
        ("    edesign run a.yaml --report\n", []),
        ("`edesign run a.yaml --reprot`", ["edesign run --reprot"]),
        ("`edesign rnu a.yaml`", ["edesign rnu a.yaml"]),
        ("`make tests` and `make test`", ["make tests"]),
        ("`--no-such-option`", ["--no-such-option"]),
    ],
)
def test_commands(text: str, reported: list[str]) -> None:
    assert [name for _, name in doc_names.wrong_commands(text)] == reported


def test_sections() -> None:
    text = '[a](../index.md#install) [b](../index.md#start) the section "Install" or the section "Start"'
    assert [name for _, name in doc_names.missing_sections(text, HERE)] == ["../index.md#start", 'section "Start"']


def test_what_is_verified_names_its_test() -> None:
    table = "| what | against |\n|---|---|\n| a | b |\n"
    assert [found for _, found in doc_names.unproven_sections(f"## Verified\n\n{table}")] == ["## Verified"]
    assert not [*doc_names.unproven_sections(f"## Verified\n\n`tests/published/test_fema356.py`:\n\n{table}")]
    rows = "| verified | against | test |\n|---|---|---|\n| a | b | `test_fema356.py` |\n| c | d | |\n"
    assert [found for _, found in doc_names.unproven_sections(f"## Other\n\n{rows}")] == ["| c | d | |"]


def test_every_warning_about_a_result_stands_on_its_page() -> None:
    page = (doc_names.ROOT / "docs" / "reference" / "validity.md").read_text(encoding="utf-8")
    rows = page.partition("## Warnings about a result")[2].partition("\n**Buckling.**")[0]
    reported = {name for _, name in doc_names.spans(re.sub(r"(?m)^(\| [^|]+\|).*$", r"\1", rows))}
    assert reported == {*COMMON, "kind"}
