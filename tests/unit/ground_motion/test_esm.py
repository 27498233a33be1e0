"""ESM and ITACA files composed here: units, header, and every fault with its line."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from strong_motion_samples import esm_file, motion

from edesign.errors import InputError
from edesign.ground_motion.formats.esm import FORMAT

G = 9.80665  # m/s2


def write(folder: Path, text: str) -> Path:
    path = folder / "IT.NRC..HGE.D.20161030.064018.C.ACC.ASC"
    path.write_text(text)
    return path


@pytest.mark.parametrize(("unit", "factor"), [("cm/s^2", 0.01), ("m/s^2", 1.0), ("g", G)])
def test_samples_in_each_unit(tmp_path: Path, unit: str, factor: float) -> None:
    record = FORMAT.read(write(tmp_path, esm_file(motion(), UNITS=unit)))
    np.testing.assert_allclose(record.acceleration, factor * motion(), atol=0.5e-6 * factor)
    assert record.time_step == 0.005
    for said in ("NOWHERE", "20161030", "Mw 6.5", "IT NRC NORCIA", "HGE"):
        assert said in record.source


def test_shorter_header_of_older_files(tmp_path: Path) -> None:
    text = esm_file(motion(), DATA_TYPE=None, USER1=None, USER2=None, MAGNITUDE_W="", MAGNITUDE_L="6.1")
    record = FORMAT.read(write(tmp_path, text))
    assert record.acceleration.size == 20 and "ML 6.1" in record.source


def test_the_component_must_be_that_of_the_file(tmp_path: Path) -> None:
    path = write(tmp_path, esm_file(motion()))
    assert FORMAT.read(path, "HGE").checksum == FORMAT.read(path, "e").checksum == FORMAT.read(path).checksum
    with pytest.raises(InputError, match="`HGE`.*E-REC-14"):
        FORMAT.read(path, "N")


WHOLE = esm_file(motion())


@pytest.mark.parametrize(
    ("text", "line", "code"),
    [
        (esm_file(motion(), NDATA="21"), 84, "E-REC-05"),
        (esm_file(motion(), NDATA="19"), 84, "E-REC-05"),
        ("".join(WHOLE.splitlines(True)[:64]), 64, "E-REC-05"),
        (esm_file(motion(), NDATA="1"), 30, "E-REC-04"),
        (esm_file(motion(), NDATA="many"), 30, "E-TABLE-08"),
        (esm_file(motion(), NDATA=None), 63, "E-REC-03"),
        (esm_file(motion(), UNITS=None), 63, "E-REC-03"),
        (esm_file(motion(), UNITS=""), 33, "E-REC-03"),
        (esm_file(motion(), UNITS="cm/s"), 33, "E-REC-10"),
        (esm_file(motion(), DATA_TYPE="VELOCITY"), 50, "E-REC-09"),
        (esm_file(motion(), SAMPLING_INTERVAL_S="0.0"), 29, "E-REC-20"),
        (esm_file(motion(), SAMPLING_INTERVAL_S="?"), 29, "E-TABLE-08"),
        (WHOLE.replace("75.248937", "NaN"), 67, "E-TABLE-08"),
        (WHOLE.replace("-13.", "x13.", 1), 76, "E-TABLE-08"),
        ("1.0\n2.0\n", 1, "E-REC-03"),
    ],
)
def test_faults_name_file_and_line(tmp_path: Path, text: str, line: int, code: str) -> None:
    assert text != WHOLE
    path = write(tmp_path, text)
    with pytest.raises(InputError, match=f"{path.name}:{line}: .*{code}"):
        FORMAT.read(path)


def test_nothing_to_read(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="E-REC-21"):
        FORMAT.read(write(tmp_path, "\n"))
