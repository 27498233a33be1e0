"""Binary SAC files that are composed here: both orders of bytes, what is refused, and the peaks of the header."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from strong_motion_samples import motion

from edesign.errors import InputError
from edesign.ground_motion.formats.read import detect, read_record_file
from edesign.ground_motion.formats.sac import read_sac

VALUES = motion(40).astype("f4")


def sac_bytes(order: str = "<", peaks: tuple[float, float] | None = None, **whole: int) -> bytes:
    """A file of SAC version 6, by IRIS' documentation; `whole` replaces integers of its header."""
    low, high = peaks or (float(VALUES.min()), float(VALUES.max()))
    reals, integers = np.full(70, -12345.0, f"{order}f4"), np.full(40, -12345, f"{order}i4")
    reals[:3] = 0.02, low, high
    integers[6], integers[9] = whole.get("nvhdr", 6), whole.get("npts", VALUES.size)
    integers[15], integers[16], integers[35] = whole.get("iftype", 1), whole.get("idep", 8), whole.get("leven", 1)
    texts = bytearray(b"-12345  " * 24)
    texts[0:8], texts[160:168], texts[168:176] = b"XXXX    ", b"HNE     ", b"YY      "
    return reals.tobytes() + integers.tobytes() + bytes(texts) + VALUES.astype(f"{order}f4").tobytes()


@pytest.mark.parametrize("order", ["<", ">"])
def test_samples_are_those_that_were_written(tmp_path: Path, order: str) -> None:
    path = tmp_path / "record.sac"
    path.write_bytes(sac_bytes(order))
    assert detect(path) == "sac"
    record = read_record_file(path, acceleration_unit="cm/s^2", component="E")
    np.testing.assert_array_equal(record.acceleration, 0.01 * VALUES.astype(float))
    assert record.time_step == 0.02  # as a decimal, not the single precision next to it
    assert "SAC, YY.XXXX, component HNE" in record.source


def test_the_unit_must_be_declared_and_nothing_else(tmp_path: Path) -> None:
    path = tmp_path / "record.sac"
    path.write_bytes(sac_bytes())
    with pytest.raises(InputError, match="E-REC-11"):
        read_record_file(path)
    with pytest.raises(InputError, match="E-REC-16"):
        read_record_file(path, acceleration_unit="g", time_step=0.01)
    with pytest.raises(InputError, match="`HNE`.*E-REC-14"):
        read_record_file(path, acceleration_unit="g", component="HNN")


@pytest.mark.parametrize(
    ("data", "message"),
    [
        (sac_bytes(idep=7), "E-REC-09"),
        (sac_bytes(iftype=2), "E-REC-09"),
        (sac_bytes(leven=0), "E-REC-09"),
        (sac_bytes(peaks=(-50.0, 90.0)), "E-REC-22"),
        (sac_bytes()[:-4], "E-REC-01"),
        (sac_bytes(nvhdr=5), "E-REC-01"),
        (b"", "E-REC-01"),
    ],
)
def test_what_is_refused(tmp_path: Path, data: bytes, message: str) -> None:
    path = tmp_path / "record.sac"
    path.write_bytes(data)
    with pytest.raises(InputError, match=message):
        read_sac(path, "g")
