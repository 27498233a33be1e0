"""K-NET files composed here: scale, mean, direction, and every fault with its line."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from strong_motion_samples import knet_file, motion

from edesign.errors import InputError
from edesign.ground_motion.formats.knet import FORMAT

COUNTS = np.round(motion(100, 4.0e5)).astype(int) - 9876
WHOLE = knet_file(COUNTS)


def write(folder: Path, text: str) -> Path:
    path = folder / "MYG0041103111446.EW"
    path.write_text(text)
    return path


def test_counts_become_accelerations_about_their_mean(tmp_path: Path) -> None:
    record = FORMAT.read(write(tmp_path, WHOLE))
    expected = 0.01 * 3920.0 / 6182761.0 * (COUNTS - np.mean(COUNTS))  # NIED: scale factor in gal a count
    np.testing.assert_allclose(record.acceleration, expected, rtol=1e-12, atol=1e-15)
    assert record.time_step == 0.01 and record.name == "MYG0041103111446.EW"
    for said in ("2011/03/11 14:46:00", "M 9.0", "MYG004", "E-W", f"mean of {np.mean(COUNTS):.6g} counts subtracted"):
        assert said in record.source


def test_directions_of_kik_net(tmp_path: Path) -> None:
    record = FORMAT.read(write(tmp_path, knet_file(COUNTS, Dir="5", Sampling="200Hz", Duration="0.5")))
    assert record.time_step == 0.005 and "component EW2" in record.source


def test_the_component_must_be_that_of_the_file(tmp_path: Path) -> None:
    path = write(tmp_path, WHOLE)
    assert FORMAT.read(path, "EW").checksum == FORMAT.read(path, "E-W").checksum == FORMAT.read(path).checksum
    with pytest.raises(InputError, match="`E-W`.*E-REC-14"):
        FORMAT.read(path, "NS")


@pytest.mark.parametrize(
    ("text", "line", "code"),
    [
        ("".join(WHOLE.splitlines(True)[:12]), 12, "E-REC-01"),
        ("".join(WHOLE.splitlines(True)[:17]), 17, "E-REC-01"),
        (knet_file(COUNTS, Mag=None), 17, "E-REC-01"),
        ("".join(WHOLE.splitlines(True)[:-2]), 28, "E-REC-05"),
        (knet_file(COUNTS, Duration="2"), 30, "E-REC-05"),
        (knet_file(COUNTS, Sampling="fast"), 11, "E-REC-04"),
        (knet_file(COUNTS, Scale="3920/6182761"), 14, "E-REC-04"),
        (WHOLE.replace("Scale Factor", "Scale       "), 17, "E-REC-03"),
        (WHOLE.replace(f"{COUNTS[1]:9d}", "      NaN"), 18, "E-TABLE-08"),
        (WHOLE.replace(f"{COUNTS[1]:9d}", "      1.5"), 18, "E-REC-08"),
        (WHOLE.replace(f"{COUNTS[1]:9d}", "   broken"), 18, "E-TABLE-08"),
    ],
)
def test_faults_name_file_and_line(tmp_path: Path, text: str, line: int, code: str) -> None:
    assert text != WHOLE
    path = write(tmp_path, text)
    with pytest.raises(InputError, match=f"{path.name}:{line}: .*{code}"):
        FORMAT.read(path)


def test_a_frequency_or_scale_of_zero(tmp_path: Path) -> None:
    for changed in ({"Sampling": "0Hz"}, {"Scale": "3920(gal)/0"}):
        with pytest.raises(InputError, match="E-REC-(04|20)"):
            FORMAT.read(write(tmp_path, knet_file(COUNTS, **changed)))


def test_another_peak_than_that_of_the_header_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "MYG0041103111446.EW"
    path.write_text(knet_file(COUNTS, Max="1.000"))
    with pytest.raises(InputError, match="EW:15: .*E-REC-22"):
        FORMAT.read(path)
