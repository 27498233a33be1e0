"""Tables of an archive as workbooks, CSV and Parquet files, data frames and datasets: the numbers of the archive."""

from __future__ import annotations

import ast
import csv
import sys
from pathlib import Path

import numpy as np
import pytest
from plain_tables import plain_table
from support.messages import says
from unit.report.figure_archive import small_archive

import edesign
from edesign.archive.dataset import Group, Variable
from edesign.archive.reader import open_archive
from edesign.archive.writer import ArchiveWriter
from edesign.cli.main import main
from edesign.errors import InputError
from edesign.report.export.export_table import ExportColumn, ExportTable, as_one, export_table
from edesign.report.export.names import LONGEST_FILE, slug, table_names
from edesign.report.export.tables_by_name import tables_by_name
from edesign.report.export.workbook import number_format, sheet_names
from edesign.report.tables.cell import Quantity, Value
from edesign.report.tables.column import col, text
from edesign.report.tables.table import Table
from edesign.report.tables.unit import MM, MS, ONE, PERCENT, M

REPORT = Path(edesign.__file__).parent / "report"
openpyxl = pytest.importorskip("openpyxl")
parquet = pytest.importorskip("pyarrow.parquet")


@pytest.fixture(scope="module")
def archive(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return small_archive(tmp_path_factory.mktemp("export"))


def _exact(path: Path) -> tuple[np.ndarray, list[str]]:
    """Largest drifts of all storeys of all analyses as HDF5 has them, and the analysis of each."""
    import h5py

    values, names = [], []
    with h5py.File(path) as file:
        for name in sorted(file["analyses"], key=lambda one: file["analyses"][one].attrs["order"]):
            if "storey_drift_max" in file["analyses"][name]:
                found = file["analyses"][name]["storey_drift_max"][()]
                values += found.tolist()
                names += [name] * len(found)
    return np.array(values), names


def test_columns_have_numbers_units_and_no_dashes() -> None:
    columns = (
        text("analysis"),
        col("drift", PERCENT),
        col("value", ONE),
        col("delay", MS, form=".1f", bare=True),
        col("with [] sign", M),
    )
    rows: list[list[Value]] = [
        ["a", 0.01234, Quantity(0.05, PERCENT, 2), 0.003, "x"],
        ["b", None, Quantity(0.002, MM, 2), 0.004, None],
    ]
    found = export_table("peaks", Table("Peaks", columns, rows))
    assert [(column.header, list(column.values)) for column in found.columns] == [
        ("analysis", ["a", "b"]),
        ("drift [%]", [0.01234 / 0.01, None]),
        ("value", [5.0, 2.0]),
        ("unit of value", ["%", "mm"]),
        ("delay [ms]", [3.0, 4.0]),
        ("with sign [m]", ["x", None]),
    ]
    assert [column.numeric for column in found.columns] == [False, True, True, False, True, False]


def test_tables_that_each_analysis_has_are_one() -> None:
    one = plain_table("a: periods", ("mode", "T [s]"), [["1", "2.0"]], ["a note"], keys=0)
    other = plain_table("b: periods", ("mode", "f [Hz]"), [["1", "0.5"]], ["a note"], keys=0)
    made = as_one("Periods", [("a", one), ("b", other)])
    assert made.headers == ["of", "mode", "T [s]", "f [Hz]"] and made.keys == 1 and made.notes == ["a note"]
    assert made.rows == [["a", "1", "2.0", None], ["b", "1", None, "0.5"]]


def test_names_of_tables_and_sheets_differ() -> None:
    titles = ["Footings (bare)", "Footings (damped)", "Storeys (largest)", "A: x", "A: x", "\u03b1"]
    assert table_names(titles) == ["footings_bare", "footings_damped", "storeys", "a_x", "a_x_2", "table"]
    long = "a" * 40
    found = sheet_names([long, long + "b", "Contents", "history", "History"])
    assert found[0] == "a" * 31 and len({name.casefold() for name in found}) == 5
    assert all(len(name) <= 31 for name in found) and "history" not in map(str.casefold, found)


def test_names_stay_when_titles_change() -> None:
    assert table_names(["A new title", "Footings"], ["floor_masses", ""]) == ["floor_masses", "footings"]
    alike = table_names(["Dampers, bare", "Dampers, damped", "Checks", "Checks"], ["dampers", "dampers", "", ""])
    assert alike == ["dampers_bare", "dampers_damped", "checks", "checks_2"]


def test_tables_with_a_title_have_a_name() -> None:
    """Every `Table("...")` of the report that can be exported; a title is free to change, a name is not."""
    without, names = [], set()
    for path in sorted(REPORT.rglob("*.py")):
        if path.parent.name in ("inspection", "check") or "short" in path.stem:
            continue  # of terminals alone
        source = path.read_text(encoding="utf-8")
        if "edesign.report.tables.table import" not in source:
            continue
        for call in ast.walk(ast.parse(source)):
            if isinstance(call, ast.Call) and isinstance(call.func, ast.Name) and call.func.id == "Table" and call.args:
                title = call.args[0]
                given = next((word.value for word in call.keywords if word.arg == "name"), None)
                if isinstance(given, ast.Constant):
                    names.add(given.value)
                elif isinstance(title, ast.Constant) and title.value and given is None:
                    without.append(f"{path.name}:{call.lineno}")
    names |= set(tables_by_name())
    assert without == [] and {"governing", "mean_response"} <= names
    assert all(name == slug(name) for name in names)


@pytest.mark.parametrize(
    ("text", "form"),
    [
        ("12.30", "0.00"),
        ("1234", "0"),
        ("-0.5", "0.0"),
        ("5.358e+17", "0.000E+00"),
        ("+3.1", "+0.0;-0.0;0.0"),
        ("+-3.1", '"±"0.0'),
        ("1.20 %", '0.00" %"'),
        ("0.123*", '0.000"*"'),
        ("nan", "General"),
    ],
)
def test_a_workbook_shows_the_digits_of_the_report(text: str, form: str) -> None:
    assert number_format(text) == form


def test_every_file_has_the_numbers_of_the_archive(archive: Path, tmp_path: Path) -> None:
    book, folder, columns = tmp_path / "all.xlsx", tmp_path / "csv", tmp_path / "parquet"
    words = ["--xlsx", str(book), "--csv", str(folder), "--parquet", str(columns), "--histories", "bare*"]
    assert main(["export", str(archive), *words]) == 0
    drifts, names = _exact(archive)
    assert drifts.size >= 8

    read = openpyxl.load_workbook(book)
    assert read.sheetnames[0] == "contents" and read.sheetnames[-1] == "provenance"
    sheet = read["analyses_by_storey"]
    assert sheet.freeze_panes == "C4" and sheet["A2"].hyperlink.location == "'contents'!A1"
    headers = [cell.value for cell in sheet[3]]
    at = headers.index("storey_drift_max") + 1
    cells = [sheet.cell(row, at) for row in range(4, 4 + drifts.size)]
    assert all(cell.data_type == "n" for cell in cells)
    # a workbook has 16 significant digits of a number, and a double needs 17
    np.testing.assert_allclose([cell.value for cell in cells], drifts, rtol=1e-15)
    assert [sheet.cell(row, 1).value for row in range(4, 4 + drifts.size)] == names
    links = [cell.hyperlink.location.split("!")[0].strip("'") for cell in read["contents"]["A"] if cell.hyperlink]
    assert links == read.sheetnames[1:]

    with (folder / "analyses_by_storey.csv").open() as file:
        rows = list(csv.DictReader(file))
    np.testing.assert_array_equal([float(row["storey_drift_max"]) for row in rows], drifts)
    assert "storey_shear_max [N]" in rows[0]
    with (folder / "contents.csv").open() as file:
        listed = [row["file"] for row in csv.DictReader(file)]
    assert sorted([*listed, "contents.csv", "provenance.csv"]) == sorted(path.name for path in folder.iterdir())

    table = parquet.read_table(columns / "analyses_by_storey.parquet")
    np.testing.assert_array_equal(table["storey_drift_max"].to_numpy(), drifts)
    assert table.schema.field("storey_shear_max").metadata == {b"unit": b"N", b"long_name": b"largest"}

    with open_archive(archive) as opened:
        place = next(name for name in opened.names("analyses") if name.startswith("bare"))
        expected = opened.group(f"analyses/{place}").variables["floor_displacement"].values[:, 1]
    with (folder / f"{slug(f'histories_analyses/{place}', LONGEST_FILE)}.csv").open() as file:
        found = [float(row["floor_displacement 2 [m]"]) for row in csv.DictReader(file)]
    np.testing.assert_array_equal(found, expected)


def test_the_same_archive_gives_the_same_workbook(archive: Path, tmp_path: Path) -> None:
    first, second = tmp_path / "a.xlsx", tmp_path / "b.xlsx"
    for path in (first, second):
        assert main(["export", str(archive), "--xlsx", str(path), "--tables", "governing*"]) == 0
    assert first.read_bytes() == second.read_bytes()


def test_no_number_of_a_table_is_left_as_text(archive: Path) -> None:
    from edesign.report.export.catalogue import archive_tables

    def as_text(value: object) -> bool:
        try:
            return isinstance(value, str) and float(value) is not None
        except ValueError:
            return False

    with open_archive(archive) as opened:
        for table in archive_tables(opened):
            for column in table.columns[table.left :]:
                assert not any(map(as_text, column.values)), (table.name, column.header)


def test_texts_of_users_stay_texts(tmp_path: Path) -> None:
    from edesign.report.export.files import write_csv_folder, write_parquet_folder
    from edesign.report.export.workbook import write_workbook

    odd = ["=1+1", "https://example.org", "0012", "\x1b[31m", "x" * 40_000]
    columns = (ExportColumn("name", "", odd), ExportColumn("n [x]", "", [1.0, float("nan"), None, float("inf"), 2]))
    table = ExportTable("odd", "=2+2", columns, ("=3+3",))
    write_workbook([table], {"title": "=4+4"}, tmp_path / "odd.xlsx")
    sheet = openpyxl.load_workbook(tmp_path / "odd.xlsx")["odd"]
    assert [sheet.cell(row, 1).value for row in (4, 5, 6, 7)] == ["=1+1", "https://example.org", "0012", "\\u001b[31m"]
    assert sheet["A4"].data_type == "s" and len(sheet["A8"].value) == 32_767 and sheet["A1"].value == "=2+2"
    assert [sheet.cell(row, 2).value for row in range(4, 9)] == [1, "nan", None, "inf", 2]
    write_parquet_folder([table], {}, tmp_path / "p")
    assert parquet.read_table(tmp_path / "p" / "odd.parquet")["name"].to_pylist() == odd
    write_csv_folder([table], {}, tmp_path / "c")
    assert (tmp_path / "c" / "odd.csv").read_text().splitlines()[1] == "'=1+1,1.0"


def test_errors_name_tables_files_and_packages(
    archive: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    def said(*words: str) -> str:
        assert main(["export", str(archive), *words]) == 2
        return capsys.readouterr().err

    assert says(said("--tables", "governing_respons", "--list"), "did you mean E-ARCH-07")
    assert says(said("--xlsx", str(tmp_path / "a.csv")), "a.csv: .xlsx E-FILE-08")
    assert says(said("--histories", "nothing", "--list"), "'nothing' histories E-ARCH-07")
    assert says(said("--tables", " , "), "--tables: E-CLI-04")
    monkeypatch.setitem(sys.modules, "xlsxwriter", None)
    assert says(said("--xlsx", str(tmp_path / "a.xlsx")), "XlsxWriter edesign[tables] E-CLI-06")
    monkeypatch.setitem(sys.modules, "pyarrow", None)
    assert says(said("--parquet", str(tmp_path / "p")), "pyarrow edesign[tables] E-CLI-06")
    assert not list(tmp_path.iterdir())


def test_a_table_that_no_sheet_takes_is_left_out_and_refused_alone(tmp_path: Path) -> None:
    from edesign.report.export.workbook import MOST_ROWS, write_workbook

    table = ExportTable("forces", "Forces", (ExportColumn("n", "", range(MOST_ROWS)),))
    with pytest.raises(InputError, match="table forces: 1048576 rows .*--csv.*E-CLI-07"):
        write_workbook([table], {}, tmp_path / "a.xlsx")
    assert not list(tmp_path.iterdir())
    small = ExportTable("loads", "Loads", (ExportColumn("n", "", [1.0]),))
    assert write_workbook([table, small], {}, tmp_path / "a.xlsx") == [table], "the others are written"
    book = openpyxl.load_workbook(tmp_path / "a.xlsx")
    assert book.sheetnames == ["contents", "loads", "provenance"]
    assert [book["contents"].cell(6, column).value for column in (1, 3)] == ["forces", MOST_ROWS]
    assert "--csv" in book["contents"].cell(6, 2).value


def test_the_motion_of_nodes_is_a_history(tmp_path: Path) -> None:
    """It has hundreds of pictures of all nodes, which are no rows of the values of the analyses."""
    from edesign.report.export.value_tables import history_tables, value_tables

    group = Group(attributes={"kind": "history"})
    group.add("roof_drift_max", (), np.array(0.01), "1", "largest drift of the roof")
    group.coords["motion_time"] = Variable(("motion_time",), np.array([0.0, 0.1, 0.2]), "s", "time of the pictures")
    group.add("node_displacement", ("motion_time",), np.array([0.0, 0.1, 0.3]), "", "displacement of the node")
    with ArchiveWriter(tmp_path / "moving.h5", Group(attributes={"kind": "project"})) as writer:
        writer.write("analyses/shake", group)
        writer.finish({"status": "completed"})
    with open_archive(tmp_path / "moving.h5") as opened:
        headers = [column.header for table in value_tables(opened) for column in table.columns]
        (history,) = history_tables(opened, ["shake"])
    assert any("roof_drift_max" in header for header in headers)
    assert not any("node_displacement" in header for header in headers)
    assert [column.name for column in history.columns] == ["motion_time", "node_displacement"]
