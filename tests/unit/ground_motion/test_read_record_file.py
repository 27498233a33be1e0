"""The format of a file is found from its content; what does not belong to it is refused."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from shared_records import SHARED, needs_recordings
from strong_motion_samples import cosmos_channel, csmip_channel, esm_file, knet_file, motion

from edesign.errors import InputError
from edesign.ground_motion.formats.at2 import read_at2
from edesign.ground_motion.formats.csv_record import read_csv
from edesign.ground_motion.formats.read import FORMATS, read_record_file

G = 9.80665  # m/s2
AT2_OLD = (
    "PEER STRONG MOTION DATABASE RECORD. PROCESSING BY PACIFIC ENGINEERING.\n"
    "NOWHERE 10/15/79 2319, A STATION, 000 (CDMG STATION 5054)\n"
    "{} TIME HISTORY IN UNITS OF {}. FILTER POINTS: HP=0.1 Hz LP=40.0 Hz\n"
    "   20   0.0050  NPTS, DT\n"
)
AT2_NEW = (
    "PEER NGA STRONG MOTION DATABASE RECORD\nNowhere, 10/15/1979, A Station, 0\n"
    "{} TIME SERIES IN UNITS OF {}\nNPTS=     20, DT=   .0050 SEC,\n"
)
VALUES = "".join(f"{value:15.7E}" + "\n" * (k % 5 == 4) for k, value in enumerate(motion(20, 0.3)))
TWO_COLUMNS = "".join(f"{0.005 * k:.3f}\t{value:.6f}\n" for k, value in enumerate(motion(20, 30.0)))


def write(folder: Path, name: str, text: str) -> Path:
    path = folder / name
    path.write_text(text)
    return path


@pytest.mark.parametrize(
    ("name", "text", "peak"),
    [
        ("a.AT2", AT2_OLD.format("ACCELERATION", "G") + VALUES, 0.3 * G),
        ("a.txt", AT2_NEW.format("ACCELERATION", "G") + VALUES, 0.3 * G),
        ("a.V2", cosmos_channel(motion()), 1.23456),
        ("a", cosmos_channel(motion()), 1.23456),
        ("a.V2", csmip_channel(motion(20, 40.0)), 0.4),
        ("a.ASC", esm_file(motion()), 1.23456),
        ("a.txt", esm_file(motion(), DATA_CITATION="NPTS= 3, DT= 1"), 1.23456),
    ],
)
def test_the_format_is_found(tmp_path: Path, name: str, text: str, peak: float) -> None:
    record = read_record_file(write(tmp_path, name, text), name="mine")
    np.testing.assert_allclose(record.acceleration, motion(20, peak), atol=1e-5)
    assert record.time_step == 0.005 and record.name == "mine"


def test_k_net_is_found(tmp_path: Path) -> None:
    counts = np.round(motion(100, 4e5))
    record = read_record_file(write(tmp_path, "noted.down", knet_file(counts)), component="EW")
    assert record.time_step == 0.01 and record.acceleration.size == 100


@pytest.mark.parametrize("suffix", ["txt", "dat", "acc", "csv", "anything"])
@pytest.mark.parametrize("separator", ["\t", "   ", ",", ";", " , "])
@pytest.mark.parametrize("header", ["", "Time (s){}Acceleration (cm/s^2)\n", "# t a\n", "t{}a\n"])
def test_tables(tmp_path: Path, suffix: str, separator: str, header: str) -> None:
    text = header.format(separator) + TWO_COLUMNS.replace("\t", separator)
    record = read_record_file(write(tmp_path, f"a.{suffix}", text), acceleration_unit="cm/s^2")
    np.testing.assert_allclose(record.acceleration, 0.01 * motion(20, 30.0), atol=0.5e-8)
    assert record.time_step == 0.005


def test_columns_of_blanks_by_header_and_one_column(tmp_path: Path) -> None:
    path = write(
        tmp_path, "a.txt", "% made here\nTime (s)   NS (g)  EW (g)\n 0.00  1.0  4\n 0.01 -2.5E-1 5\n\n 0.02  3 6\n"
    )
    ns = read_record_file(path, acceleration_unit="g", time_column="Time (s)", acceleration_column="NS (g)")
    np.testing.assert_allclose(ns.acceleration, np.array([1.0, -0.25, 3.0]) * G, rtol=1e-15)
    with pytest.raises(InputError, match=r"Time \(s\), NS \(g\), EW \(g\).*E-REC-14"):
        read_record_file(path, acceleration_unit="g", acceleration_column="NS", time_step=0.01)
    with pytest.raises(InputError, match=r":3: .*1 `Time \(s\)`, 2 `NS \(g\)`, 3 `EW \(g\)`.*E-REC-13"):
        read_record_file(path, acceleration_unit="g")
    one = write(tmp_path, "a.acc", "  1.0\n  2.0\n -3.0\n")
    assert read_record_file(one, acceleration_unit="m/s^2", time_step=0.02).pga == 3.0


def test_a_table_needs_its_unit_and_step(tmp_path: Path) -> None:
    path = write(tmp_path, "a.txt", TWO_COLUMNS)
    with pytest.raises(InputError, match="E-REC-11"):
        read_record_file(path)
    with pytest.raises(InputError, match="E-UNIT-02"):
        read_record_file(path, acceleration_unit="gal")
    with pytest.raises(InputError, match="E-REC-17"):
        read_record_file(write(tmp_path, "b.txt", "1\n2\n3\n"), acceleration_unit="g")
    with pytest.raises(InputError, match=":3: .*E-REC-07"):
        read_record_file(write(tmp_path, "c.txt", "0 1\n1 2\n2\n"), acceleration_unit="g")
    with pytest.raises(InputError, match=":2: .*E-TABLE-08"):
        read_record_file(write(tmp_path, "d.txt", "0 1\n1 nan\n2 3\n"), acceleration_unit="g")


@pytest.mark.parametrize("form", [AT2_OLD, AT2_NEW])
@pytest.mark.parametrize(("name", "quantity", "unit"), [("a.VT2", "VELOCITY", "CM/S"), ("a.DT2", "DISPLACEMENT", "CM")])
def test_velocity_and_displacement_files_of_peer_are_refused(
    tmp_path: Path, form: str, name: str, quantity: str, unit: str
) -> None:
    path = write(tmp_path, name, form.format(quantity, unit) + VALUES)
    with pytest.raises(InputError, match=":3: .*E-REC-09"):
        read_record_file(path)


def test_arguments_that_do_not_belong_to_the_format(tmp_path: Path) -> None:
    peer = write(tmp_path, "a.AT2", AT2_NEW.format("ACCELERATION", "G") + VALUES)
    with pytest.raises(InputError, match="acceleration_unit, time_step: .*E-REC-16"):
        read_record_file(peer, acceleration_unit="g", time_step=0.01)
    with pytest.raises(InputError, match="E-REC-16"):
        read_record_file(peer, component=1)
    with pytest.raises(InputError, match="E-REC-16"):
        read_record_file(write(tmp_path, "a.csv", "1\n2\n"), acceleration_unit="g", time_step=1.0, component="x")
    with pytest.raises(InputError, match="did you mean `cosmos`.*E-VALUE-03"):
        read_record_file(peer, file_format="cosmo")  # type: ignore[arg-type]
    with pytest.raises(InputError, match="E-REC-01"):
        read_record_file(peer, file_format="cosmos")


def test_nothing_fits(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="E-REC-01") as caught:
        read_record_file(write(tmp_path, "letter.txt", "Dear colleague,\nthe record follows.\n"))
    assert all(text in str(caught.value) for text in FORMATS.values())
    with pytest.raises(InputError, match="E-REC-01"):
        read_record_file(write(tmp_path, "comments.txt", "# 1\n# 2\n"))
    with pytest.raises(InputError, match="E-REC-01"):
        read_record_file(write(tmp_path, "a.at2", "Dear colleague,\nthe record follows.\n"))
    with pytest.raises(InputError, match="E-REC-21"):
        read_record_file(write(tmp_path, "a.txt", ""))
    with pytest.raises(InputError, match="there is no such record file"):
        read_record_file(tmp_path / "none.V2")
    (tmp_path / "a.mseed").write_bytes(b"000001D \0\0")
    with pytest.raises(InputError, match="E-TABLE-01"):
        read_record_file(tmp_path / "a.mseed")


@needs_recordings
def test_real_records_are_found_by_content() -> None:
    at2, csv = sorted(SHARED.glob("*.AT2")), sorted(SHARED.glob("*.csv"))
    assert at2 or csv
    for path in at2:
        assert read_record_file(path).checksum == read_at2(path).checksum
    for path in csv:
        record = read_record_file(path, acceleration_unit="g")
        assert record.checksum == read_csv(path, "g").checksum and record.time_step in (0.005, 0.01)
