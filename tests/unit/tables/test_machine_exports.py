"""Exports of test machines in the forms that public files of MTS, Instron, Zwick, LabVIEW and dSPACE have."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
import scipy.io

from edesign.damper.testing.measured_files import TestReading, read_test
from edesign.errors import InputError
from edesign.ground_motion.formats.read import read_record_file
from edesign.project.notation.table_format import TableFormat
from edesign.report.inspection.account import table_keys
from edesign.tables.columns import Chosen
from edesign.tables.table import read_table

ROWS = [(0.0, 0.25, 1.5), (0.01, 1.5, 2.0), (0.02, -2.0, 3.25), (0.03, 0.125, -0.5)]
MM, KN = [1e-3 * row[1] for row in ROWS], [1e3 * row[2] for row in ROWS]


def write(folder: Path, text: str, name: str = "t.dat", encoding: str = "cp1252") -> Path:
    path = folder / name
    path.write_bytes(text.encode(encoding))
    return path


def read(path: Path, **said: object) -> tuple[list[float], list[float], list[float]]:
    test = read_test(path, temperature_C=20.0, said=TestReading(**said))  # type: ignore[arg-type]
    assert test.force is not None
    return test.time.tolist(), test.displacement.tolist(), test.force.tolist()


def mts_block(cycle: int, rows: list[tuple[float, float, float]]) -> str:
    lines = [
        "",
        f"Cyclic Acquisition\t\t\t\t\t\tTime:\t{20 + cycle},048504\tSec\t14/12/2021 9:40:47",
        f"Stored at: \t{cycle}\tcycle\t\t\tStored for: \t2\tsegments\t\t\tRelative to: \t1\tcycle",
        f"Points: \t{len(rows)}",
        "Time\tAxial Desplazamiento\tAxial Fuerza\tAxial Count",
        "Sec\tmm\tkN\tsegments",
    ]
    lines += ["\t".join(f"{value:.7g}".replace(".", ",") for value in (*row, 198.0)) for row in rows]
    return "\r\n".join(lines) + "\r\n"


def test_blocks_of_an_mts_file_follow_each_other(tmp_path: Path) -> None:
    """What stands between the blocks is that above the first one, with other times and counts."""
    path = write(tmp_path, "MTS***|MPT|***|*|*|*|*|*\r\n" + mts_block(100, ROWS[:2]) + mts_block(200, ROWS[2:]))
    assert read(path) == ([row[0] for row in ROWS], MM, KN)
    table = read_table(path, "table", "a,b", Chosen().names)
    assert (table.form.mark, table.form.repeated, table.form.decimal) == ("MTS", 5, "comma")


def test_mts_says_the_sign_of_its_decimals(tmp_path: Path) -> None:
    """Commas with three digits behind each would be ambiguous, but for the sixth sign of the first line."""
    lines = "Laufzeit\tCh 1 Kraft Sollwert\tCh 1 Kraft\tCh 1 Weg\t1281068\ns\tkN\tkN\tmm\tmm\n"
    rows = "1,000\t9,000\t1,500\t2,250\t7,000\n2,000\t9,000\t2,000\t1,500\t7,000\n3,000\t9,000\t3,250\t2,000\t7,000\n"
    path = write(tmp_path, f"MTS793|MPT|DEU|1|2|,|.|:|49|1|1|A\n\nPrüfer : \tKh\nMasse :\t5349,4\n{lines}{rows}")
    assert read(path) == ([1.0, 2.0, 3.0], [1e-3 * u for u in (2.25, 1.5, 2.0)], KN[:3])
    assert table_keys(read_table(path, "table", "a,b", Chosen().names).form) == ""
    with pytest.raises(InputError, match=r"t\.dat:4.*E-TABLE-09"):
        read(write(tmp_path, "Maschine\n" + lines + rows))


def test_a_second_table_in_a_file_is_refused(tmp_path: Path) -> None:
    """Its columns may be the same in number, and in another order."""
    above = (
        "MTS793|MPT|DEU|1|2|,|.|:|49|1|1|A\nDatum : \t28.02.2014\nDatum\tLaufzeit\tCh 1 Weg\tCh 1 Kraft\nd\ts\tmm\tkN\n"
    )
    below = "\nDatum\tLaufzeit\tCh 1 Kraft\tCh 1 Weg\nd\ts\tkN\tmm\n"
    rows = "".join(f"42032\t{i},5\t{i},25\t{2 * i},75\n" for i in range(4))
    path = write(tmp_path, above + rows + below + rows)
    with pytest.raises(InputError, match=r"t\.dat:10.*skip: 9.*E-TABLE-06"):
        read(path)
    _, displacement, force = read(path, table=TableFormat(skip=9))
    assert (displacement[1], force[1]) == (2.75e-3, 1.25e3)


@pytest.mark.parametrize(
    "headers",
    [
        '"Time","Crosshead absolute","Standard travel","Standard force"\n"s","mm","mm","kN"\n',
        '"Temps","Traverse absolue","Course standard","Force standard"\n"s","mm","mm","kN"\n',
    ],
)
def test_zwick_in_two_languages(tmp_path: Path, headers: str) -> None:
    above = '"Epaisseur éprouvette",1,"mm"\n"Section",5.96,"mm²"\n"Capteur de course",""\n"v1",1,"mm/min"\n'
    rows = "".join(f"{a},-794.864,{b},{c}\n" for a, b, c in ROWS)
    assert read(write(tmp_path, above + headers + rows, "t.TRA")) == ([row[0] for row in ROWS], MM, KN)


def test_instron_parts_thousands_between_quotes(tmp_path: Path) -> None:
    rows = '"0.00","0.00100","999.86420"\n"0.01","0.00200","1,000.00665"\n"0.02","0.00100","12,001,000.5"\n'
    path = write(tmp_path, "Time,Extension,Load\n(s),(mm),(N)\n" + rows, "Specimen_RawData_1.csv")
    assert read(path)[2] == [999.8642, 1000.00665, 12001000.5]
    with pytest.raises(InputError, match=r"t\.dat:3, column 3.*E-TABLE-08"):
        read(write(tmp_path, 'Time,Extension,Load\n(s),(mm),(N)\n"0","0","1,000"\n"1","1","2,000"\n"2","1","2"\n'))


def test_kilograms_of_force(tmp_path: Path) -> None:
    """By definition 1 kgf = 9.80665 N."""
    path = write(
        tmp_path, "Time (Sec)\tChannel 1 Displacement (mm)\tChannel 1 Force (kgf)\n0\t0\t1\n1\t1\t2\n2\t1\t3\n"
    )
    np.testing.assert_allclose(read(path)[2], [9.80665, 19.6133, 29.41995], rtol=1e-14)  # rounding


def lvm(columns: str, header: str, rows: str, sign: str = ".") -> str:
    return (
        f"LabVIEW Measurement\t\nWriter_Version\t2\nSeparator\tTab\nDecimal_Separator\t{sign}\nX_Columns\t{columns}\n"
        "Date\t2013/02/19\nTime\t09:51:39,19705\n***End_of_Header***\t\n\t\nChannels\t2\t\t\n" + header + rows
    )


def test_labview_without_times_has_them_from_its_step(tmp_path: Path) -> None:
    header = (
        "Y_Unit_Label\tmm\tkN\nX_Dimension\tTime\tTime\nX0\t0,5E+0\t0,5E+0\nDelta_X\t1,000000E-2\t1,000000E-2\n"
        "***End_of_Header***\t\t\t\nX_Value\tDisplacement\tForce\tComment\n"
    )
    rows = "".join(f"\t{b}\t{c}\n".replace(".", ",") for _, b, c in ROWS)
    path = write(tmp_path, lvm("No", header, rows, ","), "t.lvm")
    assert read(path) == ([0.5, 0.51, 0.52, 0.53], MM, KN)
    table = read_table(path, "table", "a,b", Chosen().names)
    assert (table.header_line, table.lines.tolist(), table.form.decimal) == (16, [17, 18, 19, 20], "comma")
    with pytest.raises(InputError, match="a LabVIEW measurement"):
        read_record_file(path)


@pytest.mark.parametrize("comment", ["", "\tOK"])
def test_labview_with_one_column_of_times_and_a_silent_channel(tmp_path: Path, comment: str) -> None:
    header = "Y_Unit_Label\tmm\tVolts\tNewtons\n***End_of_Header***\nX_Value\tWeg\tUntitled\tKraft\tComment\n"
    rows = "".join(f"{a}\t{b}\t\t{c}{comment}\n" for a, b, c in ROWS)
    found = read(write(tmp_path, lvm("One", header, rows), "t.lvm"))
    assert found == ([row[0] for row in ROWS], MM, [row[2] for row in ROWS])


def test_labview_with_times_of_each_channel(tmp_path: Path) -> None:
    header = "Y_Unit_Label\tmm\t\tkN\n***End_of_Header***\nX_Value\tDisplacement\tX_Value\tForce\tComment\n"
    rows = [f"{a}\t{b}\t{a}\t{c}\n" for a, b, c in ROWS]
    assert read(write(tmp_path, lvm("Multi", header, "".join(rows)), "t.lvm"))[1:] == (MM, KN)
    rows[2] = "0.02\t-2.0\t0.025\t3.25\n"
    with pytest.raises(InputError, match=r"t\.lvm:16.*E-TABLE-13"):
        read(write(tmp_path, lvm("Multi", header, "".join(rows)), "t.lvm"))


def test_labview_without_rows_or_with_other_channels(tmp_path: Path) -> None:
    header = "***End_of_Header***\nX_Value\tDisplacement (mm)\tForce (kN)\n"
    with pytest.raises(InputError, match=r"t\.lvm:12.*E-TABLE-04"):
        read(write(tmp_path, lvm("One", header, ""), "t.lvm"))
    section = "Channels\t1\n***End_of_Header***\nX_Value\tForce (kN)\n4\t5\n"
    with pytest.raises(InputError, match=r"t\.lvm:17.*E-TABLE-06"):
        read(write(tmp_path, lvm("One", header, "0\t1\t2\n1\t2\t3\n" + section), "t.lvm"))


def capture(signals: list[tuple[str, str, str, np.ndarray]], *times: np.ndarray) -> dict[str, np.ndarray]:
    """A structure as public scripts read it: NAME.X(i).Data, NAME.Y(i).Name, .Path and .Data."""
    kinds = [("Name", "O"), ("Path", "O"), ("Unit", "O"), ("Data", "O")]
    x, y = np.zeros((1, len(times)), dtype=kinds[:1] + kinds[3:]), np.zeros((1, len(signals)), dtype=kinds)
    for i, time in enumerate(times):
        x[0, i] = ("time", time)
    for i, signal in enumerate(signals):
        y[0, i] = signal
    return {"X": x, "Y": y}


def test_dspace_captures(tmp_path: Path) -> None:
    """Paths stand in the name, between quotes, or in a field of their own; values may be of single precision."""
    time = np.array([row[0] for row in ROWS])
    disp, force = np.array([row[1] for row in ROWS], dtype=np.float32), np.array([row[2] for row in ROWS])
    signals = [('"Model Root"/"disp"/"Out1"', "", "mm", disp), ("force", "Model Root/Sensors", "kN", force)]
    path = tmp_path / "test_01.mat"
    scipy.io.savemat(path, {"test_01": capture(signals, time)})
    assert read(path) == ([row[0] for row in ROWS], MM, KN)
    with pytest.raises(InputError, match="E-TABLE-15"):
        read(path, table=TableFormat(skip=3))
    scipy.io.savemat(path, {"test_01": capture(signals, time, time + 1.0)})
    with pytest.raises(InputError, match="2 columns.*E-TABLE-13"):
        read(path)
    scipy.io.savemat(path, {"test_01": capture([signals[0], ("f", "", "kN", force[:3])], time)})
    with pytest.raises(InputError, match=r"Y\(2\).*E-TABLE-13"):
        read(path)
    scipy.io.savemat(path, {"F": force, "u": disp})
    with pytest.raises(InputError, match=r"\(it has: F, u\).*E-TABLE-14"):
        read(path)
    path.write_bytes(path.read_bytes()[:150])
    with pytest.raises(InputError, match="E-TABLE-02"):
        read(path)


@pytest.mark.parametrize(
    ("content", "reported"),
    [
        (b"TDSm\x0e\0\0\0", "TDMS.*E-TABLE-01"),
        (b"|CF,2,1,1;\0", "FAMOS.*E-TABLE-01"),
        (b"MATLAB 7.3 MAT-file, \0", "save -v7.*E-TABLE-01"),
        (b"PK\x03\x04\x14\0[Content_Types].xml", "workbook.*E-TABLE-01"),
        (b"PK\x03\x04\x14\0t.csv", "compressed.*E-TABLE-01"),
        (b"\x00\x01\x02", "UTF-8.*E-TABLE-01"),
    ],
)
def test_files_that_are_no_text_are_recognised_by_their_first_bytes(
    tmp_path: Path, content: bytes, reported: str
) -> None:
    path = tmp_path / "t.bin"
    path.write_bytes(content)
    with pytest.raises(InputError, match=reported):
        read(path)
