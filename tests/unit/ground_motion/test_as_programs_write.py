"""Files as programs and systems write them: other line ends, capitals, exponents, and last lines filled up with zeros.

What such a file holds is the same motion to the last bit, so it is compared with the file as the network documents it.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from network_samples import (
    asa_file,
    bhrc_component,
    csmip_volume_one,
    csmnc_file,
    cwb_file,
    geonet_component,
    isesd_file,
    jma_file,
    smc_file,
    volume_one_channel,
)
from strong_motion_samples import (
    afad_file,
    cosmos_channel,
    csmip_channel,
    csmip_channel_of_1983,
    esm_file,
    fixed,
    knet_file,
    motion,
)

from edesign.errors import InputError
from edesign.ground_motion.formats.read import read_record_file
from edesign.ground_motion.plausibility import record_warnings
from edesign.ground_motion.record import Record

MOTION = motion(43)  # a prime, so that every last line is short
COLUMNS = [0.5 * MOTION, MOTION, -0.25 * MOTION]
PEER = "PEER NGA STRONG MOTION DATABASE RECORD\nNowhere, 1/1/1990, A Station, 180\n"
PEER += "ACCELERATION TIME SERIES IN UNITS OF G\nNPTS=     43, DT=   .0100 SEC\n"
EXPONENTS = "".join(
    "".join(f"{v:15.7E}" for v in 1e-3 * MOTION[k : k + 5]) + "\n" for k in range(0, 43, 5)
)  # 5E15.7, as PEER writes
FILES: dict[str, tuple[str, str | None]] = {
    "at2": (PEER + EXPONENTS, None),
    "smc": (smc_file(MOTION), None),
    "geonet": (geonet_component(MOTION, corrected=False), None),
    "geonet corrected": (geonet_component(MOTION), None),
    "volume1": (volume_one_channel(0.1 * MOTION), None),
    "bhrc": (bhrc_component(0.01 * MOTION), None),
    "csmip volume 1": (csmip_volume_one(0.001 * MOTION), None),
    "csmip": (csmip_channel(MOTION), None),
    "csmip 1983": (csmip_channel_of_1983(MOTION), None),
    "cosmos": (cosmos_channel(MOTION), None),
    "cwb": (cwb_file(COLUMNS), "E"),
    "asa": (asa_file(COLUMNS), "N00E"),
    "csmnc": (csmnc_file(MOTION), None),
    "jma": (jma_file(COLUMNS), "NS"),
    "isesd": (isesd_file(0.01 * MOTION), None),
    "afad": (afad_file(MOTION).decode("iso-8859-9").replace("\r\n", "\n"), "N-S"),
    "esm": (esm_file(MOTION), None),
    "knet": (knet_file(np.round(1000 * MOTION).astype(int)), None),
}
FILLED = {  # by numbers a line, and a zero as the file writes numbers
    "at2": (5, "  0.0000000E+00"),
    "smc": (8, " 0.0000E+0"),
    "geonet": (10, "     0.0"),
    "geonet corrected": (10, "    0.00"),
    "volume1": (10, "  0.000"),
    "bhrc": (10, "  .000000E+00"),
    "csmip volume 1": (8, " 0.000000"),
    "csmip": (8, "  0.000000"),
    "csmip 1983": (8, "     0.000"),
    "cosmos": (8, "     0.000"),
    "csmnc": (8, "  0.000000E+0"),
    "isesd": (6, " 0.00000E+00"),
}


def is_numbers(line: str) -> bool:
    return re.fullmatch(r"[-+0-9.EeDd,\s]*[0-9][-+0-9.EeDd,\s]*", line) is not None


def with_exponents(letter: str) -> Callable[[str], str]:
    def change(text: str) -> str:
        lines = text.split("\n")
        return "\n".join(re.sub(r"(?<=\d)E(?=[-+])", letter, x) if is_numbers(x) else x for x in lines)

    return change


def with_a_page(text: str) -> str:
    lines = text.split("\n")
    return "\n".join([*lines[:-4], "\f" + lines[-4], *lines[-3:]])


CHANGES: dict[str, Callable[[str], str]] = {
    "CR LF": lambda text: text.replace("\n", "\r\n"),
    "CR CR LF of a transfer": lambda text: text.replace("\n", "\r\r\n"),
    "CR": lambda text: text.replace("\n", "\r"),
    "byte order mark": lambda text: "\ufeff" + text,
    "no last line end": lambda text: text.rstrip("\n"),
    "lines of 132": lambda text: "\n".join(line.ljust(132) for line in text.split("\n")),
    "pages": lambda text: "\f" + with_a_page(text) + "\f",
    "blank lines at the end": lambda text: text + "\n \n\n",
    "end of file of CP/M": lambda text: text + "\x1a",
    "capitals": str.upper,
    "small letters": str.lower,
    "D": with_exponents("D"),
    "d": with_exponents("d"),
}


def read(folder: Path, text: str, component: str | None) -> Record:
    path = folder / "record.txt"
    path.write_bytes(text.encode("utf-8"))
    return read_record_file(path, component=component)


@pytest.mark.parametrize("change", CHANGES)
@pytest.mark.parametrize("name", FILES)
def test_a_file_is_read_as_systems_leave_it(tmp_path: Path, name: str, change: str) -> None:
    text, component = FILES[name]
    plain, changed = (read(tmp_path, one, component) for one in (text, CHANGES[change](text)))
    assert changed.time_step == plain.time_step
    np.testing.assert_array_equal(changed.acceleration, plain.acceleration)


@pytest.mark.parametrize("name", FILLED)
def test_zeros_that_fill_up_the_last_line_are_no_samples(tmp_path: Path, name: str) -> None:
    text, component = FILES[name]
    fields, zero = FILLED[name]
    full, lines = fields * len(zero), text.split("\n")
    for i in range(1, len(lines)):
        cells, rest = divmod(len(lines[i]), len(zero))
        if is_numbers(lines[i]) and is_numbers(lines[i - 1]) and len(lines[i - 1]) == full and not rest:
            lines[i] += zero * (fields - cells)
    filled = "\n".join(lines)
    assert filled != text
    plain, padded = (read(tmp_path, one, component) for one in (text, filled))
    np.testing.assert_array_equal(padded.acceleration, plain.acceleration)
    assert padded.remarks == ()


@pytest.mark.parametrize(
    ("header", "step"),
    [
        ("NPTS=  43, DT= .0050 SEC", 0.005),
        ("NPTS=  43, DT= .0050SEC,", 0.005),
        ("npts = 43 , dt = 5.0E-03 sec.", 0.005),
        ("NPTS=43,DT=.5D-02 SECONDS", 0.005),
        ("NPTS=  43  DT= 0.02", 0.02),
        ("  43    0.0050    NPTS, DT", 0.005),
        ("   43   .02  npts,dt (sec)", 0.02),
    ],
)
def test_headers_of_peer(tmp_path: Path, header: str, step: float) -> None:
    record = read(tmp_path, PEER.replace(PEER.splitlines()[3], header) + EXPONENTS, None)
    assert record.time_step == step and record.acceleration.size == 43


def test_numbers_of_peer_that_touch(tmp_path: Path) -> None:
    """8F9.6: a minus sign is all that stands between neighbours; the numbers are those of the motion to six digits."""
    record = read(tmp_path, PEER + fixed(MOTION - 500.0, 8, 10, 5), None)
    np.testing.assert_allclose(record.acceleration / 9.80665, MOTION - 500.0, rtol=0.0, atol=0.51e-5)


def test_numbers_beyond_the_count_that_are_not_zero_are_reported(tmp_path: Path) -> None:
    plain = read(tmp_path, PEER + EXPONENTS, None)
    longer = read(tmp_path, PEER + EXPONENTS + "  0.1000000E+00  0.0000000E+00\n", None)
    np.testing.assert_array_equal(longer.acceleration, plain.acceleration)
    said = "2 more numbers than NPTS = 43 stand below, not all zero: they are left out"
    assert longer.remarks == (said,) and record_warnings(longer)[0] == said
    for name in ("csmnc", "cosmos", "smc"):  # whose count stands beside a peak, blocks and an end
        text, component = FILES[name]
        fields, zero = FILLED[name]
        one = zero.replace("0", "1", 1)
        lines = text.split("\n")
        last = max(i for i in range(1, len(lines)) if is_numbers(lines[i]) and len(lines[i]) < fields * len(zero))
        with pytest.raises(InputError, match=r"record\.txt:\d+"):
            read(tmp_path, "\n".join([*lines[:last], lines[last] + one, *lines[last + 1 :]]), component)


def test_text_that_is_no_number_below_the_samples_is_refused(tmp_path: Path) -> None:
    with pytest.raises(InputError, match=r"record\.txt:14: .*E-TABLE-08"):
        read(tmp_path, PEER + EXPONENTS + "END\n", None)
