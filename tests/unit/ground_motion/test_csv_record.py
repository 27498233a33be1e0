"""CSV records composed here: layouts, units, and what is refused."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from edesign.errors import InputError
from edesign.ground_motion.formats.csv_record import read_csv

G = 9.80665  # m/s2


def write(folder: Path, text: str) -> Path:
    path = folder / "record.csv"
    path.write_text(text)
    return path


def test_time_and_acceleration_with_headers(tmp_path: Path) -> None:
    record = read_csv(write(tmp_path, "time,acc (g)\n0,0\n0.02,0.0063\n0.04,-0.00364\n"), "g")
    np.testing.assert_allclose(record.acceleration, [0.0, 0.0063 * G, -0.00364 * G], rtol=1e-15)
    assert record.time_step == 0.02


@pytest.mark.parametrize(("unit", "factor"), [("g", G), ("m/s^2", 1.0), ("cm/s^2", 0.01), ("mm/s^2", 0.001)])
def test_one_column_in_each_unit(tmp_path: Path, unit: str, factor: float) -> None:
    record = read_csv(write(tmp_path, "# comment\n1\n\n-2.5\n"), unit, time_step=0.005)
    np.testing.assert_allclose(record.acceleration, [factor, -2.5 * factor], rtol=1e-15)


def test_columns_by_name_and_number(tmp_path: Path) -> None:
    path = write(tmp_path, "t;ns;ew\n0;1;4\n0.1;2;5\n0.2;3;6\n")
    by_name = read_csv(path, "m/s^2", time_column="t", acceleration_column="ew")
    by_number = read_csv(path, "m/s^2", time_column=1, acceleration_column=3)
    np.testing.assert_array_equal(by_name.acceleration, [4, 5, 6])
    np.testing.assert_array_equal(by_number.acceleration, [4, 5, 6])
    assert by_name.time_step == by_number.time_step == 0.1


def test_times_may_begin_anywhere_and_be_rounded(tmp_path: Path) -> None:
    """Times of a step of 1/300 s with four decimals, whose differences vary by 3 %: rounding is not unevenness."""
    step = 1.0 / 300.0
    lines = [f"{1.0 + i * step:.4f},{i}" for i in range(301)]
    record = read_csv(write(tmp_path, "\n".join(lines)), "m/s^2")
    assert record.time_step == pytest.approx(step, rel=1e-4)


@pytest.mark.parametrize(
    ("text", "code"),
    [
        ("0,1\n0.01,2\n0.03,3\n", ":3: .*E-REC-19"),
        ("0,1\n0.01,2\n0.02,2\n0.04,2\n0.05,3\n", ":4: .*E-REC-19"),
        ("0,1\n0.01,2\n0.01,3\n", ":3: .*E-REC-19"),
        ("0,1\n0.01,2\n0.02\n", ":3: .*E-REC-07"),
        ("0,1\n0.01,x\n0.02,3\n", ":2: .*E-REC-08"),
        ("0,1\n0.01,nan\n0.02,3\n", ":2: .*E-TABLE-08"),
        ("t,a,b\n0,1,2\n0.01,2,3\n", "E-REC-13"),
        ("time,acc\n0,1\n", "E-REC-21"),
        ("# only a comment\n", "E-REC-21"),
        ("1\n2\n", "E-REC-17"),
    ],
)
def test_faults(tmp_path: Path, text: str, code: str) -> None:
    with pytest.raises(InputError, match=code):
        read_csv(write(tmp_path, text), "g")


def test_faults_of_arguments(tmp_path: Path) -> None:
    path = write(tmp_path, "time,acc\n0,1\n0.01,2\n")
    with pytest.raises(InputError, match="E-UNIT-02"):
        read_csv(path, "gal")
    with pytest.raises(InputError, match="did you mean `acc`.*E-REC-14"):
        read_csv(path, "g", acceleration_column="acd")
    with pytest.raises(InputError, match="E-REC-14"):
        read_csv(path, "g", acceleration_column=3)
    with pytest.raises(InputError, match="0.01 s.* 0.02 s.*E-REC-18"):
        read_csv(path, "g", time_step=0.02)
    with pytest.raises(InputError, match="E-REC-20"):
        read_csv(path, "g", time_step=0.0, acceleration_column=2)
    with pytest.raises(InputError, match="E-VALUE-04"):
        read_csv(path, "g", time_column=2, acceleration_column=2)


CASE = "0 .1 .2 .3 .4\n.5 .6 .7 .8 .9\n"  # ten samples, five a line
WAVE = np.sin(0.4 * np.arange(60)) * np.exp(-0.05 * np.arange(60))  # m/s2


def lines_of(values: np.ndarray, width: int, separator: str = " ", end: str = "") -> str:
    words = [f"{value:.6f}" for value in values]
    return "".join(separator.join(words[k : k + width]) + end + "\n" for k in range(0, len(words), width))


def test_samples_along_the_lines(tmp_path: Path) -> None:
    record = read_csv(write(tmp_path, CASE), "m/s^2", time_step=0.01, layout="rows")
    np.testing.assert_array_equal(record.acceleration, np.arange(10) / 10)
    assert record.time_step == 0.01


@pytest.mark.parametrize("width", [1, 2, 5, 7, 8, 60, 61])
@pytest.mark.parametrize(("separator", "end"), [(" ", ""), (",", ""), (",", ","), (";", ""), ("\t", "")])
def test_the_width_of_the_lines_does_not_matter(tmp_path: Path, width: int, separator: str, end: str) -> None:
    """60 samples are the same record however many stand on a line; the last line may be shorter (7, 8)."""
    path = write(tmp_path, "# in m/s2\n" + lines_of(WAVE, width, separator, end))
    record = read_csv(path, "m/s^2", time_step=0.02, layout="rows")
    np.testing.assert_allclose(record.acceleration, WAVE, atol=0.5e-6)


@pytest.mark.parametrize(
    ("text", "arguments", "code"),
    [
        (CASE, {}, ":1: .*E-REC-13"),
        (CASE, {"acceleration_column": 1}, ":1: .*E-REC-15"),
        (lines_of(WAVE, 2), {}, ":4: .*E-REC-19"),
        (lines_of(WAVE, 2), {"time_step": 0.01}, "E-REC-19"),
        (lines_of(np.arange(20) / 10, 2), {}, "0.2 s.*E-REC-15"),
        (lines_of(np.arange(20) / 10, 2), {"time_step": 0.01}, "E-REC-18"),
        (lines_of(np.arange(8) / 100, 2), {}, "E-REC-15"),
        (lines_of(WAVE, 8), {}, ":8: .*E-REC-07"),
        ("1 2 3\n", {"time_step": 0.01}, ":1: .*E-REC-21"),
    ],
)
def test_what_may_be_rows_is_refused(tmp_path: Path, text: str, arguments: dict[str, float], code: str) -> None:
    with pytest.raises(InputError, match=code) as caught:
        read_csv(write(tmp_path, text), "m/s^2", **arguments)  # type: ignore[arg-type]
    assert "`layout: rows` (--layout rows)" in str(caught.value)


TIMES = 0.05 * np.arange(12)
BESIDE_TIMES = np.column_stack((TIMES, WAVE.reshape(12, 5)))
PAIRS = np.column_stack((0.005 * np.arange(60), WAVE)).reshape(15, 8)


@pytest.mark.parametrize(
    ("text", "code"),
    [
        (lines_of(BESIDE_TIMES.ravel(), 6), ":1: .*E-REC-15"),
        (lines_of(PAIRS.ravel(), 8), "E-REC-15"),
        ("a b\n1 2\n3 4\n", ":1: .*E-REC-15"),
        ("1 2 3\n4 5\n6 7 8\n", ":2: .*E-REC-07"),
        ("1 2 3\n4 5 6 7\n", ":2: .*E-REC-07"),
        ("1 2 3\n4 x 6\n", ":2: .*E-TABLE-08"),
        ("1,2,,\n3,4,5,\n", ":1: .*E-TABLE-08"),
        ("1\n", ":1: .*E-REC-21"),
    ],
)
def test_faults_of_rows(tmp_path: Path, text: str, code: str) -> None:
    with pytest.raises(InputError, match=code):
        read_csv(write(tmp_path, text), "m/s^2", time_step=0.01, layout="rows")


def test_rows_that_rise_all_are_no_times(tmp_path: Path) -> None:
    record = read_csv(write(tmp_path, lines_of(np.arange(60) / 100, 5)), "m/s^2", time_step=0.01, layout="rows")
    np.testing.assert_allclose(record.acceleration, np.arange(60) / 100, rtol=1e-12)


def test_the_layout_may_be_said(tmp_path: Path) -> None:
    path = write(tmp_path, CASE)
    one = read_csv(path, "m/s^2", time_step=0.01, acceleration_column=2, layout="columns")
    np.testing.assert_array_equal(one.acceleration, [0.1, 0.6])
    np.testing.assert_array_equal(read_csv(path, "m/s^2", None, 1, 5).acceleration, [0.4, 0.9])
    two = write(tmp_path, "0 1\n0.2 2\n")
    assert read_csv(two, "m/s^2", layout="columns").time_step == 0.2
    assert read_csv(two, "m/s^2", time_step=0.2).acceleration.tolist() == [1.0, 2.0]
    with pytest.raises(InputError, match="E-KEY-03"):
        read_csv(path, "g", 0.01, None, 1, layout="rows")
    with pytest.raises(InputError, match="did you mean `rows`.*E-VALUE-03"):
        read_csv(path, "g", 0.01, layout="row")  # type: ignore[arg-type]
    with pytest.raises(InputError, match="E-REC-17"):
        read_csv(path, "g", layout="rows")
