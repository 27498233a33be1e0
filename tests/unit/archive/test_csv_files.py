"""What edesign writes for spreadsheets: texts that would be formulas stay texts, numbers stay numbers."""

from __future__ import annotations

import csv
import re
from pathlib import Path

import pytest

import edesign
from edesign.archive.csv_files import Cell, write_csv_file


def written(tmp_path: Path, *rows: list[Cell], headers: tuple[str, ...] = ("a",)) -> list[list[str]]:
    write_csv_file(headers, rows, tmp_path / "t.csv")
    with (tmp_path / "t.csv").open(encoding="utf-8", newline="") as file:
        return list(csv.reader(file))


@pytest.mark.parametrize("sign", ["=", "+", "-", "@", "\t", "\r", "\n", "＝"])
def test_a_formula_becomes_a_text(tmp_path: Path, sign: str) -> None:
    """The signs are those of OWASP, "CSV Injection"; `;` and tab separate cells in many locales."""
    formula = f'{sign}HYPERLINK("http://x","y")'
    header, (cell, behind) = written(tmp_path, [formula, f"drift;{formula}"], headers=(formula, "T [s]"))
    assert header == [f"'{formula}", "T [s]"]
    assert cell == f"'{formula}" and behind == f"drift;'{formula}"


def test_numbers_and_other_texts_stay(tmp_path: Path) -> None:
    cells: list[Cell] = [-0.1, 1e-300, -3, None, True, "-0.25", "+7", "-1e-3", "-", "a-b", "3 = 2 + 1", 'x,"y"', "bare"]
    assert written(tmp_path, cells)[1] == [
        "-0.1", "1e-300", "-3", "", "true", "-0.25", "+7", "-1e-3", "-", "a-b", "3 = 2 + 1", 'x,"y"', "bare",
    ]  # fmt: skip


def test_digits(tmp_path: Path) -> None:
    write_csv_file(("a", "b"), [(1 / 3, 2)], tmp_path / "t.csv", digits=7)
    assert (tmp_path / "t.csv").read_bytes() == b"a,b\n0.3333333,2\n"


def test_no_other_place_writes_csv() -> None:
    """All tables go by the one writer; the generator of the catalogue writes into the package, not for users."""
    package = Path(edesign.__file__).parent
    found = [path for path in package.rglob("*.py") if re.search(r"csv\.(writer|DictWriter)", path.read_text("utf-8"))]
    assert {path.name for path in found} == {"csv_files.py", "generate_profiles.py"}
