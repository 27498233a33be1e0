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
    ("text", "said"),
    [
        ("0,1\n0.01,2\n0.03,3\n", ":3: the times are not evenly spaced"),
        ("0,1\n0.01,2\n0.02,2\n0.04,2\n0.05,3\n", ":4: the times are not evenly spaced"),
        ("0,1\n0.01,2\n0.01,3\n", ":3: the time 0.01 s is not after"),
        ("0,1\n0.01,2\n0.02\n", ":3: 1 columns; the lines before have 2"),
        ("0,1\n0.01,x\n0.02,3\n", ":2: `x` is not a number"),
        ("0,1\n0.01,nan\n0.02,3\n", ":2: `nan` is not a finite number"),
        ("t,a,b\n0,1,2\n0.01,2,3\n", "(1 `t`, 2 `a`, 3 `b`); name the one"),
        ("time,acc\n0,1\n", "at least two samples, not 1"),
        ("# only a comment\n", "no samples"),
        ("1\n2\n", "no column of times; a time step is needed"),
    ],
)
def test_faults(tmp_path: Path, text: str, said: str) -> None:
    path = write(tmp_path, text)
    with pytest.raises(InputError) as caught:
        read_csv(path, "g")
    assert str(caught.value).startswith(str(path)) and said in str(caught.value)


def test_faults_of_arguments(tmp_path: Path) -> None:
    path = write(tmp_path, "time,acc\n0,1\n0.01,2\n")
    with pytest.raises(InputError, match="unknown unit `gal`; allowed: g,"):
        read_csv(path, "gal")
    with pytest.raises(InputError, match="no column `acd`; did you mean `acc`"):
        read_csv(path, "g", acceleration_column="acd")
    with pytest.raises(InputError, match="no column 3; the columns are numbered 1 to 2"):
        read_csv(path, "g", acceleration_column=3)
    with pytest.raises(InputError, match="a step of 0.01 s, but 0.02 s is given"):
        read_csv(path, "g", time_step=0.02)
    with pytest.raises(InputError, match="must be greater than zero, not 0 s"):
        read_csv(path, "g", time_step=0.0, acceleration_column=2)
    with pytest.raises(InputError, match="cannot be both"):
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
    ("text", "arguments", "said"),
    [
        (
            CASE,
            {},
            ":1: 5 columns; name the one that is the acceleration: by --column on the command line, by `columns` in a",
        ),
        (CASE, {"acceleration_column": 1}, ":1: 5 numbers a line without headers may be 5 channels, or 5 samples"),
        (lines_of(WAVE, 2), {}, ":4: the time 0.500395 s is not after"),
        (lines_of(WAVE, 2), {"time_step": 0.01}, "if both are samples, write `layout: rows` (--layout rows)"),
        (lines_of(np.arange(20) / 10, 2), {}, "is the first of two numbers a line the time? the step would be 0.2 s"),
        (lines_of(np.arange(20) / 10, 2), {"time_step": 0.01}, "a step of 0.2 s, but 0.01 s is given; if the first"),
        (lines_of(np.arange(8) / 100, 2), {}, "is the first of two numbers a line the time? 4 lines do not show it"),
        (lines_of(WAVE, 8), {}, ":8: 4 columns; the lines before have 8; if the numbers are samples in turn"),
        ("1 2 3\n", {"time_step": 0.01}, ":1: a record needs at least two samples, not 1; if the numbers are samples"),
    ],
)
def test_what_may_be_rows_is_refused(tmp_path: Path, text: str, arguments: dict[str, float], said: str) -> None:
    with pytest.raises(InputError) as caught:
        read_csv(write(tmp_path, text), "m/s^2", **arguments)  # type: ignore[arg-type]
    assert said in str(caught.value) and "`layout: rows` (--layout rows)" in str(caught.value)


TIMES = 0.05 * np.arange(12)
BESIDE_TIMES = np.column_stack((TIMES, WAVE.reshape(12, 5)))
PAIRS = np.column_stack((0.005 * np.arange(60), WAVE)).reshape(15, 8)


@pytest.mark.parametrize(
    ("text", "said"),
    [
        (
            lines_of(BESIDE_TIMES.ravel(), 6),
            ":1: in `layout: rows` (--layout rows) every number is a sample, but number 1",
        ),
        (lines_of(PAIRS.ravel(), 8), "number 1 of each line rises evenly by 0.02, as times do"),
        ("a b\n1 2\n3 4\n", ":1: `layout: rows` (--layout rows) is for lines of numbers alone; put # before"),
        ("1 2 3\n4 5\n6 7 8\n", ":2: 2 samples; the others have 3"),
        ("1 2 3\n4 5 6 7\n", ":2: 4 samples; the others have 3"),
        ("1 2 3\n4 x 6\n", ":2: `x` is not a number"),
        ("1,2,,\n3,4,5,\n", ":1: `` is not a number"),
        ("1\n", ":1: a record needs at least two samples, not 1"),
    ],
)
def test_faults_of_rows(tmp_path: Path, text: str, said: str) -> None:
    with pytest.raises(InputError) as caught:
        read_csv(write(tmp_path, text), "m/s^2", time_step=0.01, layout="rows")
    assert said in str(caught.value) and str(caught.value).startswith(str(tmp_path / "record.csv"))


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
    with pytest.raises(InputError, match="rows. .--layout rows. has no columns, but columns are named"):
        read_csv(path, "g", 0.01, None, 1, layout="rows")
    with pytest.raises(InputError, match="unknown layout `row`; did you mean `rows`"):
        read_csv(path, "g", 0.01, layout="row")  # type: ignore[arg-type]
    with pytest.raises(InputError, match="a time step is needed"):
        read_csv(path, "g", layout="rows")
