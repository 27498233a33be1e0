"""COSMOS and CSMIP volume 2 files composed here: counts, steps, units, channels, and every fault with its line."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from strong_motion_samples import cosmos_channel, csmip_channel, csmip_channel_of_1983, fixed, motion

from edesign.errors import InputError
from edesign.ground_motion.formats import cosmos, csmip
from edesign.ground_motion.record import Record

G = 9.80665  # m/s2
DATA_LINE = 13 + 11 + 18 + 3 + 1  # of a channel that begins in line 1


def write(folder: Path, text: str) -> Path:
    path = folder / "CE1.V2"
    path.write_text(text)
    return path


def read(folder: Path, text: str, component: str | int | None = None) -> Record:
    return cosmos.FORMAT.read(write(folder, text), component)


def test_samples_step_and_description(tmp_path: Path) -> None:
    record = read(tmp_path, cosmos_channel(motion()))
    np.testing.assert_allclose(record.acceleration, 0.01 * motion(), atol=0.5e-5)  # three decimals of cm/s2
    assert record.time_step == 0.005  # value 62 in ms, not value 34, which is that of the recorder
    assert record.name == "CE1"
    for said in ("CE1.V2: Corrected acceleration", "Nowhere Earthquake", "Mw=7.0 ML=6.8", "Yucaipa", "1: 340 deg"):
        assert said in record.source


def test_fields_that_touch(tmp_path: Path) -> None:
    values = np.array([-1234.567, 1000.001, -999.999, -100.25, 7654.321, -1.5, 0.0, -4321.125, 2222.5])
    text = cosmos_channel(values, layout=(8, 9, 3))
    assert "-1234.567 1000.001 -999.999 -100.250 7654.321" in text
    packed = cosmos_channel(-np.abs(values), layout=(8, 9, 3))
    assert "-1234.567-1000.001" in packed
    np.testing.assert_allclose(read(tmp_path, text).acceleration, 0.01 * values, rtol=1e-12)
    np.testing.assert_allclose(read(tmp_path, packed).acceleration, -0.01 * np.abs(values), rtol=1e-12)


def test_one_value_a_line_in_g(tmp_path: Path) -> None:
    text = cosmos_channel(motion(12, 0.25), unit="g.     (02)", layout=(1, 15, 6))
    np.testing.assert_allclose(read(tmp_path, text).acceleration, G * motion(12, 0.25), atol=0.5e-6 * G)


@pytest.mark.parametrize(
    ("component", "factor"),
    [(1, 1.0), ("2", 2.0), ("90 deg", 2.0), ("90", 2.0), ("up", 3.0), ("HN3", 3.0), ("3:Up", 3.0)],
)
def test_a_channel_is_chosen(tmp_path: Path, component: str | int, factor: float) -> None:
    record = read(tmp_path, three_channels(), component)
    np.testing.assert_allclose(record.acceleration, factor * 0.01 * motion(), atol=0.5e-5)


def three_channels() -> str:
    other = cosmos_channel(7.0 * motion(), 1, quantity="velocity", unit="cm/sec(05)")
    channels = [cosmos_channel(k * motion(), k, name) for k, name in ((1, "340 deg"), (2, "90 deg"), (3, "Up"))]
    return channels[0] + other + channels[1] + "\n" + channels[2]


def test_channels_that_do_not_fit_are_listed(tmp_path: Path) -> None:
    listed = "`1: 340 deg`, `2: 90 deg`, `3: Up`"
    with pytest.raises(InputError, match=f"holds 3 components; name one: {listed}"):
        read(tmp_path, three_channels())
    with pytest.raises(InputError, match=f"no component `east`; the file has {listed}"):
        read(tmp_path, three_channels(), "east")
    twice = cosmos_channel(motion(), 1, "Up") + cosmos_channel(motion(), 2, "Up")
    with pytest.raises(InputError, match="`1: Up`, `2: Up`.*E-REC-13"):
        read(tmp_path, twice, "Up")


WHOLE = cosmos_channel(motion())


@pytest.mark.parametrize(
    ("text", "line", "code"),
    [
        ("Something else\n" + WHOLE, 1, "E-REC-01"),
        ("".join(WHOLE.splitlines(True)[:30]), 30, "E-REC-05"),
        ("".join(WHOLE.splitlines(True)[:13]), 13, "E-REC-05"),
        ("".join(WHOLE.splitlines(True)[: DATA_LINE + 2]), DATA_LINE + 2, "E-REC-05"),
        (cosmos_channel(motion(), count=28), DATA_LINE + 3, "E-REC-07"),
        (cosmos_channel(motion(16), count=24), DATA_LINE + 3, "E-REC-05"),
        (cosmos_channel(motion(24), count=16), DATA_LINE + 3, "E-REC-06"),
        (cosmos_channel(motion(), count=1), DATA_LINE, "E-REC-21"),
        (cosmos_channel(motion(), unit="furlong/sec2(04)").replace("(04)", ""), DATA_LINE, "E-REC-10"),
        (cosmos_channel(motion(), unit="g(04)"), DATA_LINE, "E-REC-10"),
        (cosmos_channel(motion(), unit="counts (50)"), DATA_LINE, "E-REC-09"),
        (cosmos_channel(motion(), unit=" "), DATA_LINE, "E-REC-10"),
        (cosmos_channel(motion(), step_ms=-999.0, seconds=0.1), DATA_LINE, "E-REC-03"),
        (cosmos_channel(motion(), step_ms=0.0), DATA_LINE, "E-REC-20"),
        (cosmos_channel(motion(), seconds=60.0), DATA_LINE, "E-REC-18"),
        (WHOLE.replace("    85.054", "       NaN"), DATA_LINE + 1, "E-TABLE-08"),
        (WHOLE.replace("    85.054", "**********"), DATA_LINE + 1, "E-TABLE-08"),
        (WHOLE.replace("     0.000    85", "              85"), DATA_LINE + 1, "E-TABLE-08"),
        (WHOLE.replace("85.054", " 85054"), DATA_LINE + 1, "E-REC-08"),
        (WHOLE.replace("Format=(8F10.3)", "Format=(free)"), DATA_LINE, "E-REC-03"),
        (WHOLE.replace("  10 lines", "  12 lines"), 14, "E-REC-04"),
        (WHOLE.replace("Comment line", "Remark line"), 43, "E-REC-06"),
    ],
)
def test_faults_name_file_and_line(tmp_path: Path, text: str, line: int, code: str) -> None:
    assert text != WHOLE
    with pytest.raises(InputError, match=rf"CE1\.V2:{line}: .*{code}"):
        read(tmp_path, text)


def test_no_acceleration_and_no_text(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="E-REC-09"):
        read(tmp_path, cosmos_channel(motion(), quantity="velocity", unit="cm/sec(05)"))
    with pytest.raises(InputError, match="E-REC-21"):
        read(tmp_path, " \n")


def test_csmip_reads_the_acceleration_of_a_channel(tmp_path: Path) -> None:
    values = motion(20, 40.0)
    record = csmip.FORMAT.read(write(tmp_path, csmip_channel(values)))
    np.testing.assert_allclose(record.acceleration, 0.01 * values, atol=0.5e-8)
    assert record.time_step == 0.005
    assert "Nowhere Earthquake" in record.source and "ML: 5.6" in record.source and "1: 360 Deg" in record.source
    both = write(tmp_path, csmip_channel(values) + csmip_channel(-2.0 * values, 2, "Up"))
    np.testing.assert_allclose(csmip.FORMAT.read(both, "Up").acceleration, -0.02 * values, atol=0.5e-8)
    with pytest.raises(InputError, match="`1: 360 Deg`, `2: Up`.*E-REC-13"):
        csmip.FORMAT.read(both)


@pytest.mark.parametrize(
    ("old", "new", "line", "code"),
    [
        ("    20 points of accel", "    30 points of accel", 14, "E-REC-07"),
        ("    20 points of accel", "    12 points of accel", 13, "E-REC-07"),
        ("    20 points of accel", "    16 points of accel", 14, "E-REC-06"),
        ("    20 points of accel", "     1 points of accel", 11, "E-REC-21"),
        ("at  .005 sec, in cm/sec2", "at  .000 sec, in cm/sec2", 11, "E-REC-20"),
        ("at  .005 sec, in cm/sec2", "at  fast sec, in cm/sec2", 11, "E-TABLE-08"),
        ("in cm/sec2", "in ft/sec2", 11, "E-REC-10"),
    ],
)
def test_csmip_faults(tmp_path: Path, old: str, new: str, line: int, code: str) -> None:
    text = csmip_channel(motion(20, 40.0))
    assert old in text
    path = write(tmp_path, text.replace(old, new, 1))
    with pytest.raises(InputError, match=rf"CE1\.V2:{line}: .*{code}"):
        csmip.FORMAT.read(path)


def test_csmip_of_the_eighties(tmp_path: Path) -> None:
    """The file announces no format of its numbers: width 10 follows from a line of 80 characters with 8 points.

    Reference: the data line of the 1983 Coalinga record of Parkfield Fault Zone 14 (CDMG QC83A456), which was read too.
    """
    values = motion(20, -1267.957)  # such values fill their fields
    text = csmip_channel_of_1983(values) + csmip_channel_of_1983(0.5 * values, 2, "UP")
    record = csmip.FORMAT.read(write(tmp_path, text), "90")
    np.testing.assert_allclose(record.acceleration, 0.01 * values, atol=0.5e-5)
    assert record.time_step == 0.02
    for said in ("NOWHERE EARTHQUAKE     MAY 2, 1983".replace("     ", " "), "NOWHERE FAULT ZONE 14", "1: 90 DEG"):
        assert said in record.source
    np.testing.assert_allclose(csmip.FORMAT.read(write(tmp_path, text), "up").acceleration, 0.005 * values, atol=0.5e-5)
    short = csmip_channel_of_1983(values).replace("   20 POINTS OF ACCEL", "   24 POINTS OF ACCEL")
    with pytest.raises(InputError, match=":14: .*E-REC-07"):
        csmip.FORMAT.read(write(tmp_path, short))
    with pytest.raises(InputError, match=":11: .*E-REC-10"):
        csmip.FORMAT.read(write(tmp_path, csmip_channel_of_1983(values, unit="FURLONG")))
    uneven = csmip_channel_of_1983(values).replace(fixed(values, 8, 10, 3)[:10], "1.5")
    with pytest.raises(InputError, match=":11: .*E-REC-03"):
        csmip.FORMAT.read(write(tmp_path, uneven))


def test_csmip_without_data(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="E-REC-03"):
        csmip.FORMAT.read(write(tmp_path, "Corrected accelerogram\n"))
