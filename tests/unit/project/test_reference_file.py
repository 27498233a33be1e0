"""Reference files: what is read, and what is refused with its line and column."""

from __future__ import annotations

from pathlib import Path

import pytest
from messages import says

from edesign.project.study.reference import ResponseTable, VariableTable
from edesign.project.study.reference_loader import ReferenceFileError, load_reference

HEAD = "edesign_reference: 1\ntitle: Trial\ntables:\n"
TABLE = HEAD + "  - title: T\n    kind: responses\n    statistic: mean\n"  # the next line is 7
ROW = "      - {measure: interstorey_drift, label: drift, unit: '%', values: {bare: {DBE: 2, MCE: 3.1}}"
DESIGN = HEAD + "  - {title: T, kind: variables, group: designs/a, over: storey, rows: [\n"


def write(folder: Path, text: str) -> Path:
    path = folder / "reference.yaml"
    path.write_text(text, encoding="utf-8")
    return path


def test_the_nearest_bar_holds(tmp_path: Path) -> None:
    rows = (
        f"{ROW}, within: {{bare: {{MCE: 5 %}}}}}}\n"
        "      - {measure: base_shear, label: V, unit: kN, values:\n"
        "          {bare: {DBE: {value: 900, within: 1 %, note: seen}}, damped: {DBE: 800}}}\n"
    )
    text = TABLE + "    within: {bare: 10 %, damped: {DBE: 0.2}}\n    rows:\n" + rows
    table = load_reference(write(tmp_path, text)).tables[0]
    assert isinstance(table, ResponseTable)
    bars = {
        (row.label, variant, level): table.bar(row, variant, level, cell)
        for row in table.rows
        for variant, level, cell in row.cells()
    }
    assert bars == {
        ("drift", "bare", "DBE"): 0.1,  # of the table
        ("drift", "bare", "MCE"): 0.05,  # of the row
        ("V", "bare", "DBE"): 0.01,  # its own
        ("V", "damped", "DBE"): 0.2,
    }
    assert [cell.note for _, _, cell in table.rows[1].cells()] == ["seen", None]


def test_a_table_of_variables(tmp_path: Path) -> None:
    rows = "    {variable: k, label: k, unit: kN/m, within: 3 %, values: [1, {value: 2, within: 1 %}]}]}\n"
    reference = load_reference(write(tmp_path, DESIGN + rows))
    table = reference.tables[0]
    assert isinstance(table, VariableTable)
    (row,) = table.rows
    assert [(cell.value, table.bar(row, cell)) for cell in row.cells()] == [(1.0, 0.03), (2.0, 0.01)]
    assert reference.where("tables", 0, "rows", 0, "unit") == f"{reference.path}:5:35"


@pytest.mark.parametrize(
    ("text", "place", "said"),
    [
        ("", "1:1", "E-FILE-05"),
        ("edesign: 1\ntitle: x\n", "1:1", "edesign E-FILE-05"),
        ("edesign_study: 1\n", "1:1", "edesign_study E-FILE-05"),
        (HEAD + "  - {title: T, kind: response}\n", "4:22", "tables[0].kind `responses` E-VALUE-03"),
        (TABLE + "    rows: []\n", "7:11", "tables[0].rows E-VALUE-01"),
        (TABLE.replace("mean", "average") + f"    rows:\n{ROW}}}\n", "6:16", "tables[0].statistic E-VALUE-03"),
        (
            TABLE + f"    rows:\n{ROW.replace('drift', 'drfit', 1)}}}\n",
            "8:19",
            "tables[0].rows[0].measure `interstorey_drift` E-NAME-01",
        ),
        (TABLE + f"    rows:\n{ROW.replace('%', 'cm')}}}\n", "8:58", "tables[0].rows[0].unit E-UNIT-02"),
        (TABLE + f"    rows:\n{ROW.replace('2,', 'two,')}}}\n", "8:84", "tables[0].rows[0].values.bare.DBE E-VALUE-01"),
        (TABLE + f"    rows:\n{ROW}}}\n{ROW}}}\n", "9:45", "tables[0].rows[1].label `drift` E-NAME-02"),
        (
            TABLE + "    rows:\n      - {measure: base_shear, label: V, unit: kg, values: {bare: {DBE: 2}}}\n",
            "8:47",
            "tables[0].rows[0].unit E-UNIT-02",
        ),
        (
            TABLE.replace("mean", "mean_profile")
            + "    rows:\n      - {measure: base_shear, label: V, unit: kN, values: {bare: {DBE: 2}}}\n",
            "8:19",
            "tables[0].rows[0].measure `interstorey_drift` E-CRIT-04",
        ),
        (
            TABLE.replace("mean", "mean_profile") + f"    rows:\n{ROW}, storeys: [1]}}\n",
            "8:99",
            "tables[0].rows[0].storeys E-CRIT-04",
        ),
        (TABLE + f"    within: {{bear: 1 %}}\n    rows:\n{ROW}}}\n", "7:14", "tables[0].within.bear `bare` E-NAME-01"),
        (
            TABLE + f"    rows:\n{ROW}, within: {{bare: {{DB: 1 %}}}}}}\n",
            "8:115",
            "tables[0].rows[0].within.bare.DB `DBE` E-NAME-01",
        ),
        (TABLE + f"    within: -3 %\n    rows:\n{ROW}}}\n", "7:13", "tables[0].within E-VALUE-02"),
        (
            TABLE + f"    within: 3 %\n    rows:\n{ROW.replace('2,', '0,')}}}\n",
            "9:84",
            "tables[0].rows[0].values.bare.DBE E-CRIT-04",
        ),
        (
            TABLE + f"    rows:\n{ROW}, change: {{DBE: -3}}}}\n",
            "8:99",
            "tables[0].rows[0].change `change: {of: ..., against: ...}` E-KEY-02",
        ),
        (
            TABLE + f"    change: {{of: damped, against: bare}}\n    rows:\n{ROW}, change: {{DBE: -3}}}}\n",
            "7:18",
            "tables[0].change.of E-NAME-01",
        ),
        (
            TABLE + f"    change: {{of: bare, against: bare}}\n    rows:\n{ROW}, change: {{SLE: -3}}}}\n",
            "9:108",
            "tables[0].rows[0].change.SLE E-NAME-01",
        ),
        (
            DESIGN + "    {variable: k, label: k, unit: N/m, values: [1, 2]},\n"
            "    {variable: d, label: d, unit: N/m, values: [1]}]}\n",
            "6:48",
            "tables[0].rows[1].values E-VALUE-04",
        ),
    ],
)
def test_what_is_refused(tmp_path: Path, text: str, place: str, said: str) -> None:
    path = write(tmp_path, text)
    with pytest.raises(ReferenceFileError) as caught:
        load_reference(path)
    matching = [line for line in str(caught.value).splitlines() if line.startswith(f"{path}:{place}: ")]
    assert any(says(line, said) for line in matching), str(caught.value)
