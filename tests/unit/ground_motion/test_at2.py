"""AT2 files composed here, in both forms of the header; every fault is reported with file and line."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from edesign.errors import InputError
from edesign.ground_motion.formats.at2 import read_at2

TITLE = "PEER NGA STRONG MOTION DATABASE RECORD\nSomewhere, 1/1/1990, A Station, 180\n"
TITLE += "ACCELERATION TIME SERIES IN UNITS OF G\n"
NEW = "NPTS=      7, DT=   .0100 SEC,\n"
OLD = "    7    0.0100    NPTS, DT\n"
DATA = "   .1000000E+00  -.2000000E+00   .3000000E-01   .0000000E+00   .5000000E-02\n  -.1000000E-03   .2500000E+00\n"
VALUES = [0.1, -0.2, 0.03, 0.0, 0.005, -0.0001, 0.25]
G = 9.80665  # m/s2, standard gravity, exact by definition


def write(folder: Path, text: str) -> Path:
    path = folder / "RSN1_X.AT2"
    path.write_text(text)
    return path


@pytest.mark.parametrize("header", [NEW, OLD, "NPTS= 7, DT= .0100 SEC\n", "7 .01 NPTS,DT\n", "npts=7,dt=.01\n"])
def test_both_forms_of_the_header(tmp_path: Path, header: str) -> None:
    record = read_at2(write(tmp_path, TITLE + header + DATA))
    np.testing.assert_allclose(record.acceleration, np.array(VALUES) * G, rtol=1e-15)
    assert record.time_step == 0.01
    assert record.name == "RSN1_X"
    assert "A Station, 180" in record.source


@pytest.mark.parametrize(
    ("text", "place", "code"),
    [
        (TITLE + NEW.replace("7", "8") + DATA, ":6", "E-REC-05"),
        (TITLE + NEW.replace(".0100", "1e300") + DATA, ":4", "E-REC-20"),
        (TITLE + NEW + DATA.replace(".2500000E+00", "NaN"), ":6", "E-TABLE-08"),
        (TITLE + NEW + DATA.replace(".2500000E+00", "1e999"), ":6", "E-TABLE-08"),
        (TITLE + NEW + DATA.replace("  -.2000000E+00", "  broken"), ":5", "E-TABLE-08"),
        (TITLE + NEW.replace(".0100", "0.0"), ":4", "E-REC-20"),
        (TITLE + NEW.replace(".0100", "-.01") + DATA, ":4", "E-REC-20"),
        (TITLE + NEW.replace(".0100", "fast") + DATA, ":4", "E-TABLE-08"),
        (TITLE + NEW.replace("7", "0") + DATA, ":4", "E-REC-04"),
        (TITLE + NEW.replace("7", "6.5") + DATA, ":4", "E-REC-04"),
        (TITLE + DATA, ":4", "E-REC-01"),
        (TITLE, ":3", "E-REC-01"),
        (TITLE + NEW, ":4", "E-REC-05"),
        (TITLE.replace("ACCELERATION", "VELOCITY") + NEW + DATA, ":3", "E-REC-09"),
        (TITLE.replace("OF G", "OF CM/S/S") + NEW + DATA, ":3", "E-REC-09"),
        ("", "", "E-REC-21"),
        ("\n \n", "", "E-REC-21"),
    ],
)
def test_faults_name_file_and_line(tmp_path: Path, text: str, place: str, code: str) -> None:
    path = write(tmp_path, text)
    with pytest.raises(InputError, match=f"{path.name}{place}: .*{code}"):
        read_at2(path)


def test_files_that_cannot_be_read(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="there is no such record file"):
        read_at2(tmp_path / "none.AT2")
    with pytest.raises(InputError, match="this is a folder"):
        read_at2(tmp_path)
    (tmp_path / "binary.AT2").write_bytes(b"\x89HDF\0\0\0")
    with pytest.raises(InputError, match="E-TABLE-01"):
        read_at2(tmp_path / "binary.AT2")
