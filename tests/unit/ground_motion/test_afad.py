"""Files of AFAD composed here: three components in gal, checked against the peaks in their own header."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from strong_motion_samples import afad_file, motion

from edesign.errors import InputError
from edesign.ground_motion.formats.read import read_record_file

PEAK = float(np.max(np.abs(motion(40))))  # gal


def write(folder: Path, data: bytes) -> Path:
    path = folder / "20170720223109_0921.txt"
    path.write_bytes(data)
    return path


@pytest.mark.parametrize(("component", "factor"), [("N-S", 1.0), ("ew", -2.0), ("U", 0.5)])
def test_a_component_in_gal(tmp_path: Path, component: str, factor: float) -> None:
    values = motion(40)
    record = read_record_file(write(tmp_path, afad_file(values)), component=component)
    np.testing.assert_allclose(record.acceleration, 0.01 * factor * values, atol=0.5e-8)
    assert record.time_step == 0.01 and record.acceleration.size == 40
    for said in ("AFAD, unprocessed", "2017/07/20", "6.5 Mw", "0921 AYD\u0131N GERMENCIK"):
        assert said in record.source


@pytest.mark.parametrize(
    ("changed", "code"),
    [
        ({"NUMBER": "41"}, ":54: .*E-REC-05"),
        ({"NUMBER": None}, "E-REC-03"),
        ({"SAMPLING": "0"}, ":10: .*E-REC-20"),
        ({"SAMPLING": "fast"}, ":10: .*E-TABLE-08"),
        ({"RAW": ""}, ":11: .*E-REC-03"),
        ({"RAW": "(N-S) 67.5 (E-W) 135"}, ":11: .*E-REC-22"),
        ({"RAW": f"(N-S) {PEAK:.3f} (E-W) {2 * PEAK:.3f}"}, ":11: .*E-REC-03"),
    ],
)
def test_faults_of_the_header(tmp_path: Path, changed: dict[str, str | None], code: str) -> None:
    path = write(tmp_path, afad_file(motion(40), **changed))
    with pytest.raises(InputError, match=code):
        read_record_file(path, component="N-S")


def test_faults_of_the_samples(tmp_path: Path) -> None:
    text = afad_file(motion(40)).decode("iso-8859-9")
    path = write(tmp_path, text.encode("iso-8859-9"))
    with pytest.raises(InputError, match="`N-S`, `E-W`, `U-D`.*E-REC-13"):
        read_record_file(path)
    lines = text.splitlines()
    for changed, said in (
        (lines[20].replace(lines[20].split()[1], ""), ":21: 2 numbers; each line has one of each of the 3 components"),
        (lines[20].replace(lines[20].split()[1], "x"), ":21: `x` is not a number"),
    ):
        path.write_text("\n".join([*lines[:20], changed, *lines[21:]]))
        with pytest.raises(InputError, match=said):
            read_record_file(path, component="N-S")
    path.write_text(text.replace("(gal)", "(mg)"))
    with pytest.raises(InputError, match=":11: .*E-REC-10"):
        read_record_file(path, component="N-S")
    exchanged = text.replace("N-S          E-W", "E-W          N-S")
    path.write_text(exchanged)
    with pytest.raises(InputError, match="E-REC-22"):
        read_record_file(path, component="N-S")
