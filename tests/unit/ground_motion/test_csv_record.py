"""CSV records composed here: layouts, units, and what is refused."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from edesign.errors import InputError
from edesign.ground_motion.csv_record import read_csv

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
        ("0,1,2\n0.01,2,3\n", "3 columns; name the one"),
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
