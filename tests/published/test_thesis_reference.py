"""projects/thesis_10_storey/reference.yaml has every number of Tables 5.3 (modes in X), 5.7, 5.8 and 5.9 of the thesis.

The text of the thesis lies beside the repository, not in it: where it is not, what the tables say of themselves is
checked: changes follow from values, damper stiffness and areas from storey stiffness and A_P.
"""

from __future__ import annotations

import os
import re
from pathlib import Path

import pytest

from edesign.project.study.reference import Reference, ResponseTable, VariableTable
from edesign.project.study.reference_loader import load_reference

ROOT = Path(__file__).parents[2]
FILE = ROOT / "projects" / "thesis_10_storey" / "reference.yaml"
THESIS = Path(os.environ.get("EDESIGN_SHARED") or ROOT.parent / "shared") / "seed" / "thesis.txt"

needs_thesis = pytest.mark.skipif(not THESIS.is_file(), reason="the text of the thesis is not beside the repository")

ROWS = {  # of the thesis, and of the reference
    "Roof Displacement": "roof displacement",
    "Residual Roof Displacement": "residual roof displacement",
    "Roof Drift": "roof drift",
    "InterStorey Drift": "interstorey drift",
    "Residual InterStorey Drift": "residual interstorey drift",
    "Base Shear": "base shear",
    "Roof Acceleration": "roof acceleration",
    "Beam Plastic Rotation": "beam plastic rotation",
    "Column Plastic Rotation": "column plastic rotation",
    "Column Axial Force": "column axial force",
}
UNITS = {"cm": "cm", "%": "%", "kN": "kN", "m/sec <sup>2</sup>": "m/s^2", "Rad": "rad"}


def reference() -> Reference:
    return load_reference(FILE)


def responses(start: str) -> ResponseTable:
    (table,) = [table for table in reference().tables if table.title.startswith(start)]
    assert isinstance(table, ResponseTable)
    return table


def variables(start: str) -> VariableTable:
    (table,) = [table for table in reference().tables if table.title.startswith(start)]
    assert isinstance(table, VariableTable)
    return table


def printed_rows(title: str) -> list[list[str]]:
    """Cells of the lines below a table's title, up to the next text."""
    lines = THESIS.read_text(encoding="utf-8").splitlines()
    at = next(i for i, line in enumerate(lines) if line.startswith(title))
    rows: list[list[str]] = []
    for line in lines[at + 1 :]:
        if line.strip() and "\t" not in line:
            break
        if line.strip():
            rows.append([re.sub(r"</?b>", "", cell).strip() for cell in line.split("\t")])
    return rows


@needs_thesis
def test_table_5_3() -> None:
    rows = {row[0]: row for row in printed_rows("Table 5.3:") if row[0].isdigit()}
    assert len(rows) == 9
    table = variables("Table 5.3")
    assert table.labels is not None
    in_x = [mode for mode, row in rows.items() if float(row[3]) > 0.01]  # the other modes hardly move in X
    assert list(table.labels) == in_x
    for row, column in zip(table.rows, (1, 2, 3), strict=True):
        assert [cell.value for cell in row.cells()] == [float(rows[mode][column]) for mode in in_x]


@needs_thesis
def test_table_5_7() -> None:
    rows = printed_rows("Table 5.7:")[1:]
    assert [row[0] for row in rows] == [str(storey) for storey in range(1, 11)]
    for row, column in zip(variables("Table 5.7").rows, (1, 2, 3, 4), strict=True):
        assert [cell.value for cell in row.cells()] == [float(line[column]) for line in rows]


@needs_thesis
def test_added_damping() -> None:
    (row,) = variables("Section 5.3.4").rows
    found = re.search(
        r"using the modal strain energy and Eq. 5.8 the estimated damping is ([\d.]+)%", THESIS.read_text("utf-8")
    )
    assert found is not None and [cell.value for cell in row.cells()] == [float(found[1])]


@needs_thesis
@pytest.mark.parametrize("title", ["Table 5.8", "Table 5.9"])
def test_tables_5_8_and_5_9(title: str) -> None:
    rows = printed_rows(f"{title}:")[2:]
    table = responses(f"{title}, m")
    assert table.statistic == ("mean" if title == "Table 5.8" else "maximum")
    assert len(rows) == len(table.rows) == len(ROWS)
    for line, row in zip(rows, table.rows, strict=True):
        name, _, unit = line[0].partition(" (")
        assert ROWS[name] == row.label and UNITS[unit.rstrip(") ")] == row.unit
        bare_dbe, damped_dbe, change_dbe = (float(cell) for cell in line[2:5])
        bare_mce, damped_mce, change_mce = (float(cell) for cell in line[6:9])
        values = {(variant, level): cell.value for variant, level, cell in row.cells()}
        assert values == {
            ("bare", "DBE"): bare_dbe,
            ("bare", "MCE"): bare_mce,
            ("damped", "DBE"): damped_dbe,
            ("damped", "MCE"): damped_mce,
        }
        assert {level: cell.value for level, cell in row.changes()} == {"DBE": change_dbe, "MCE": change_mce}


@pytest.mark.parametrize("title", ["Table 5.8, m", "Table 5.9, m"])
def test_printed_changes_follow_from_the_printed_values(title: str) -> None:
    """Where they do not by more than the rounding of the last digit, a note says so."""
    for row in responses(title).rows:
        values = {(variant, level): cell.value for variant, level, cell in row.cells()}
        for level, cell in row.changes():
            change = 100.0 * (values["damped", level] / values["bare", level] - 1.0)
            assert change == pytest.approx(cell.value, abs=0.1) or cell.note, (row.label, level)


def test_readings_repeat_the_printed_values() -> None:
    """The table that reads the numbers otherwise has the same numbers for the same kind of quantity."""
    of_measure = {
        "base_shear": "column_base_shear",
        "final_roof_displacement": "residual_roof_displacement",
        "final_interstorey_drift": "residual_interstorey_drift",
        "relative_roof_acceleration": "roof_acceleration",
    }
    as_printed = {
        row.measure: {(variant, level): cell.value for variant, level, cell in row.cells()}
        for row in responses("Table 5.8, m").rows
    }
    for row in responses("Table 5.8, read").rows:
        cells = {(variant, level): cell.value for variant, level, cell in row.cells()}
        assert cells == as_printed[of_measure.get(row.measure, row.measure)]


def test_table_5_7_agrees_with_itself() -> None:
    """Damper stiffness 1.300 times the storey's; A_D/A_P of layers of 180 mm by 230 mm, to the rounding in print."""
    storey, damper, area, ratio = ([cell.value for cell in row.cells()] for row in variables("Table 5.7").rows)
    assert damper == pytest.approx([1.3 * k for k in storey], abs=2.0)
    assert ratio == pytest.approx([a / 0.0414 for a in area], abs=0.0051 / 0.0414)
