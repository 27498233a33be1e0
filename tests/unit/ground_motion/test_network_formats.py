"""Formats of networks: samples, step, unit and component are those that were written, and the header's peak counts."""

from __future__ import annotations

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
from strong_motion_samples import motion

from edesign.errors import InputError
from edesign.ground_motion.formats.read import component_labels, detect, read_record_file

G = 9.80665  # m/s2
MOTION = motion(40)  # its peak is sample 2, 123.456 exp(-0.2) sin(1)
COLUMNS = [0.5 * MOTION, MOTION, -0.25 * MOTION]


def write(folder: Path, text: str, name: str = "record.dat") -> Path:
    path = folder / name
    path.write_text(text)
    return path


CASES: list[tuple[str, str, str | None, float, float, float]] = [
    # format, text, component, step (s), factor of the motion to m/s2, one unit of the last digit written in m/s2
    ("smc", smc_file(MOTION), None, 0.005, 0.01, 1e-4),
    ("smc", smc_file(MOTION, "1 UNCORRECTED ACCELEROGRAM", bearing=None), "up", 0.005, 0.01, 1e-4),
    ("geonet", geonet_component(MOTION), "10", 0.02, 0.001, 1e-4),
    (
        "geonet",
        geonet_component(MOTION, corrected=False) + geonet_component(2.0 * MOTION, "S80E", 100, corrected=False),
        "S80E",
        0.02,
        0.002,
        1e-4,
    ),
    ("volume1", volume_one_channel(0.1 * MOTION), None, 0.005, 0.01 * G, 1e-3),
    (
        "volume1",
        volume_one_channel(0.1 * MOTION) + volume_one_channel(0.02 * MOTION, 2, "90 DEG"),
        "90",
        0.005,
        0.002 * G,
        1e-3,
    ),
    ("volume1", bhrc_component(0.01 * MOTION) + bhrc_component(0.03 * MOTION, "T3"), "82", 0.005, 0.003 * G, 1e-5),
    ("csmip", csmip_volume_one(0.001 * MOTION), "360", 0.005, 0.001 * G, 1e-5),
    ("cwb", cwb_file(COLUMNS), "E", 0.02, -0.0025, 1e-5),
    ("asa", asa_file(COLUMNS), "N00E", 0.005, 0.01, 1e-6),
    ("csmnc", csmnc_file(MOTION), "EW", 0.005, 0.01, 1e-6),
    ("jma", jma_file(COLUMNS), "N-S", 0.01, 0.005, 1e-5),
    ("isesd", isesd_file(0.01 * MOTION), "NS", 0.01, 0.01, 1e-5),
]


@pytest.mark.parametrize(("file_format", "text", "component", "step", "factor", "digit"), CASES)
def test_samples_are_those_that_were_written(
    tmp_path: Path, file_format: str, text: str, component: str | None, step: float, factor: float, digit: float
) -> None:
    path = write(tmp_path, text)
    assert detect(path) == file_format
    record = read_record_file(path, component=component)
    assert record.time_step == pytest.approx(step, rel=1e-12)  # decimal numbers that are read back
    np.testing.assert_allclose(record.acceleration, factor * MOTION, rtol=0.0, atol=digit)


@pytest.mark.parametrize(
    ("file_format", "text"),
    [
        ("smc", smc_file(MOTION, largest=90.0)),
        ("geonet", geonet_component(MOTION, peak=90.0)),
        ("volume1", volume_one_channel(0.1 * MOTION, peak=0.9)),
        ("csmip", csmip_volume_one(0.001 * MOTION, peak=0.09)),
        ("cwb", cwb_file(COLUMNS, peaks=[(90.0, -90.0)] * 3)),
        ("asa", asa_file(COLUMNS, peaks=[1.0, 90.0, 1.0])),
        ("csmnc", csmnc_file(MOTION, peak=90.0)),
    ],
)
def test_another_peak_than_that_of_the_header_is_refused(tmp_path: Path, file_format: str, text: str) -> None:
    path = write(tmp_path, text)
    with pytest.raises(InputError, match=r"record\.dat:\d+: .*E-REC-22"):
        read_record_file(path, component="N00E" if file_format == "asa" else None)


@pytest.mark.parametrize(
    ("text", "labels"),
    [
        (geonet_component(MOTION) + geonet_component(MOTION, "Up", 0), ("N10E", "Up")),
        (volume_one_channel(0.1 * MOTION) + volume_one_channel(0.1 * MOTION, 2, "UP"), ("1: EW", "2: UP")),
        (cwb_file(COLUMNS), ("U", "N", "E")),
        (asa_file(COLUMNS), ("V", "N00E", "N90E")),
        (jma_file(COLUMNS), ("NS", "EW", "UD")),
    ],
)
def test_a_file_of_several_components_needs_one_named(tmp_path: Path, text: str, labels: tuple[str, ...]) -> None:
    path = write(tmp_path, text)
    assert component_labels(path, detect(path)) == labels
    with pytest.raises(InputError, match=f"holds {len(labels)} components; name one"):
        read_record_file(path)
    with pytest.raises(InputError, match=f"no component `S33W`; the file has `{labels[0]}`"):
        read_record_file(path, component="S33W")


@pytest.mark.parametrize(
    ("text", "component"),
    [
        (smc_file(MOTION), None),
        (geonet_component(MOTION, corrected=False), None),
        (volume_one_channel(0.1 * MOTION), None),
        (bhrc_component(0.1 * MOTION), None),
        (csmip_volume_one(0.001 * MOTION), None),
        (cwb_file(COLUMNS), "U"),
        (asa_file(COLUMNS), "V"),
        (csmnc_file(MOTION), None),
    ],
)
def test_a_file_that_is_cut_off_or_damaged_is_refused_with_its_line(
    tmp_path: Path, text: str, component: str | None
) -> None:
    lines = text.splitlines()
    for cut in (len(lines) // 3, len(lines) - 4, len(lines) - 3):
        with pytest.raises(InputError, match=r"record\.dat"):
            read_record_file(write(tmp_path, "\n".join(lines[:cut])), component=component)
    at = next(i for i in range(len(lines) - 3, 0, -1) if "." in lines[i])
    damaged = [*lines[:at], "  oops  ".join(lines[at].rsplit(".", 1)), *lines[at + 1 :]]
    with pytest.raises(InputError, match=r"record\.dat:\d+"):
        read_record_file(write(tmp_path, "\n".join(damaged)), component=component)


def test_corrected_geonet_without_its_displacements_is_refused(tmp_path: Path) -> None:
    text = geonet_component(MOTION)
    with pytest.raises(InputError, match="E-REC-05"):
        read_record_file(write(tmp_path, text[: text.rindex("\n", 0, -2)]))


def uneven(count: int = 400) -> tuple[np.ndarray, np.ndarray]:
    """Times that a digitizer chose, and a straight rise and fall through them, whose interpolation is exact."""
    times = np.round(np.cumsum(np.where(np.arange(count) % 3, 0.006, 0.009)) - 0.009, 4)
    values = np.where(times < 1.2, times, 2.4 - times)
    return times, values


@pytest.mark.parametrize("form", ["smc", "volume1"])
def test_pairs_at_uneven_times_are_interpolated_and_it_is_reported(tmp_path: Path, form: str) -> None:
    times, values = uneven()
    writers: dict[str, Callable[[], str]] = {
        "smc": lambda: smc_file(values, "1 UNCORRECTED ACCELEROGRAM", rate=None, times=times),
        "volume1": lambda: volume_one_channel(values, times=times),
    }
    record = read_record_file(write(tmp_path, writers[form]()))
    assert record.time_step == 0.005
    assert "digitized at uneven times, interpolated linearly to 0.005 s" in record.source
    at = record.time
    expected = np.where(at < 1.2, at, 2.4 - at) * (0.01 if form == "smc" else 0.1 * G)
    away = np.abs(at - 1.2) > 0.01  # the corner lies between two samples
    # five digits of SMC, three decimals of volume 1, of numbers about 1
    np.testing.assert_allclose(record.acceleration[away], expected[away], rtol=0.0, atol=1.1e-3 * (0.1 * G))


def test_even_times_that_were_rounded_stay_as_they_are(tmp_path: Path) -> None:
    times = np.round(0.00497 * np.arange(200), 3)  # 0.050, 0.055, 0.060, 0.065, 0.070, 0.075: as CSMIP prints them
    record = read_record_file(write(tmp_path, volume_one_channel(0.1 * motion(200), times=times)))
    assert record.acceleration.size == 200
    assert record.time_step == pytest.approx(0.00497, abs=3e-6)  # the end is known to 0.5 ms in 199 steps
    assert "interpolated" not in record.source


def test_times_that_go_back_are_refused(tmp_path: Path) -> None:
    times = 0.005 * np.arange(40)
    times[20] = 0.05
    with pytest.raises(InputError, match="pair 21 .*E-REC-19"):
        read_record_file(write(tmp_path, volume_one_channel(0.1 * MOTION, times=times)))


def test_a_gap_in_the_times_is_refused(tmp_path: Path) -> None:
    times = 0.005 * np.arange(40)
    times[20:] += 2.0
    with pytest.raises(InputError, match="2.005 s .*E-REC-19"):
        read_record_file(write(tmp_path, volume_one_channel(0.1 * MOTION, times=times)))


def test_velocity_and_spectra_are_refused(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="E-REC-09"):
        read_record_file(write(tmp_path, smc_file(MOTION, "3 VELOCITY")))
    spectra = "Response and Fourier amplitude spectra (78 periods,  .04 -  6.0 sec)   for\n1\n2\n"
    with pytest.raises(InputError, match="E-REC-09"):
        read_record_file(write(tmp_path, spectra))


def test_the_end_may_be_padded_with_zero_bytes(tmp_path: Path) -> None:
    path = tmp_path / "a.smc"
    path.write_bytes(smc_file(MOTION).encode() + b"\0" * 80 + b"\r\n")
    assert read_record_file(path).acceleration.size == 40


def test_another_unit_than_gal_is_refused(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="E-REC-10"):
        read_record_file(write(tmp_path, asa_file(COLUMNS, unit="g")), component="V")


def test_whether_it_is_processed_is_reported(tmp_path: Path) -> None:
    reported = {
        "SMC, corrected": smc_file(MOTION),
        "SMC, uncorrected": smc_file(MOTION, "1 UNCORRECTED ACCELEROGRAM"),
        "GeoNet, uncorrected": geonet_component(MOTION, corrected=False),
        "RENADIC, volume 1, uncorrected": volume_one_channel(0.1 * MOTION),
        "BHRC Iran, volume 1, uncorrected": bhrc_component(0.1 * MOTION),
        "CSMIP volume 1, uncorrected": csmip_volume_one(0.001 * MOTION),
    }
    for words, text in reported.items():
        assert words in read_record_file(write(tmp_path, text)).source


def test_other_contents_of_european_and_chinese_files_are_refused(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="E-REC-09"):
        read_record_file(write(tmp_path, isesd_file(0.01 * MOTION, "uncorrected acceleration")))
    with pytest.raises(InputError, match=":16: .*E-REC-05"):
        read_record_file(write(tmp_path, isesd_file(0.01 * MOTION, count=41)))
    with pytest.raises(InputError, match="E-REC-09"):
        read_record_file(write(tmp_path, csmnc_file(MOTION, quantity="CORRECTED VELOCITY")))
    with pytest.raises(InputError, match="E-REC-10"):
        read_record_file(write(tmp_path, jma_file(COLUMNS, unit="kine")), component="NS")
    with pytest.raises(InputError, match=":12: .*E-REC-07"):
        lines = jma_file(COLUMNS).splitlines()
        read_record_file(write(tmp_path, "\n".join([*lines[:11], "1.0,2.0,,,", *lines[11:]])), component="NS")


def test_european_files_are_known_by_their_sampling_alone(tmp_path: Path) -> None:
    """As a public reader of these files has them: four lines above the block, and displacements among the units."""
    text = isesd_file(0.01 * MOTION)
    head = "sampling period:               0.010000s\nnumber of samples:             40\n"
    head += "record length:                 0.390s\nunits:                        m/s*s, m/s, m & s\n"
    path = write(tmp_path, head + text[text.index("-> corrected acc") :], "000042xa.cor")
    record = read_record_file(path)
    np.testing.assert_allclose(record.acceleration, 0.01 * MOTION, rtol=1e-5)  # digits of the file


def test_an_unknown_text_is_described(tmp_path: Path) -> None:
    text = "A STATION\n090 DEGREES\n" + "   -1.95   -2.05   -2.09\n" * 5 + "   1.00\n"
    with pytest.raises(InputError, match=r"`table: \{skip: 2\}`.*E-REC-01"):
        read_record_file(write(tmp_path, text, "record.044"))
    (tmp_path / "a.zip").write_bytes(b"PK\x03\x04\0\0")
    with pytest.raises(InputError, match="compressed.*E-REC-02"):
        read_record_file(tmp_path / "a.zip")
    (tmp_path / "a.mseed").write_bytes(b"000001D BBB    BHZ\0\0")
    with pytest.raises(InputError, match="miniSEED.*E-REC-02"):
        read_record_file(tmp_path / "a.mseed")


ROTATED = (
    "PEER NGA Rotated Accelerogram (v1.1)\nH1 for rotation: NOWHERE 10/15/79 2316, A STATION, 092\n"
    "H2 for rotation: NOWHERE 10/15/79 2316, A STATION, 002\nrotation angle - clockwise  51.000000\n"
    "SN component, azimuth =  53.000000\nAccelerations in {}\n4 0.005000 NPTS, DT\n0.0 \t 0.1 \t -0.2 \t 0.05\n"
)


def test_peer_headers_of_seven_lines_are_read_if_they_say_that_the_unit_is_g(tmp_path: Path) -> None:
    record = read_record_file(write(tmp_path, ROTATED.format("g"), "rotated.txt"))
    np.testing.assert_allclose(record.acceleration, G * np.array([0.0, 0.1, -0.2, 0.05]), rtol=1e-15)
    assert record.time_step == 0.005
    with pytest.raises(InputError):
        read_record_file(write(tmp_path, ROTATED.format("gal"), "rotated.txt"))


def test_geonet_writes_more_than_9999_mm_as_whole_numbers(tmp_path: Path) -> None:
    """So does the record of 1.1 g at Waiau, 2016, whose header has -11026.2 mm/s2 and whose sample is -11026."""
    large = 100.0 * MOTION
    text = geonet_component(large, corrected=False)
    written = "".join(f"{v:8.1f}" if abs(v) < 9999.5 else f"{v:8.0f}" for v in large)
    head = text.splitlines()[:26]
    rows = [written[k : k + 80] for k in range(0, len(written), 80)]
    record = read_record_file(write(tmp_path, "\n".join([*head, *rows])))
    np.testing.assert_allclose(record.acceleration, 0.001 * large, atol=5.1e-4)
    small = rows[-1].replace(".", " ")[:79] + rows[-1][-1:]
    with pytest.raises(InputError):
        read_record_file(write(tmp_path, "\n".join([*head, *rows[:-1], small])))


def test_half_of_a_file_of_pairs_is_not_taken_for_accelerations_alone(tmp_path: Path) -> None:
    lines = volume_one_channel(0.1 * motion(50)).splitlines()  # ten lines of five pairs below 27
    with pytest.raises(InputError, match="E-REC-05"):
        read_record_file(write(tmp_path, "\n".join(lines[:32])))


def test_asa_may_repeat_its_last_sample_only(tmp_path: Path) -> None:
    text = asa_file(COLUMNS)
    last = text.splitlines()[-1]
    whole = read_record_file(write(tmp_path, text), component="V")
    assert read_record_file(write(tmp_path, text + f"{last}\n{last}\n"), component="V").checksum == whole.checksum
    with pytest.raises(InputError, match="E-REC-05"):
        read_record_file(write(tmp_path, text + "    9.0000    9.0000    9.0000\n"), component="V")


def test_the_step_of_geonet_is_the_same_in_text_and_numbers(tmp_path: Path) -> None:
    text = geonet_component(MOTION).replace("at 0.020 sec intervals", "at 0.010 sec intervals")
    with pytest.raises(InputError, match=":11: .*E-REC-18"):
        read_record_file(write(tmp_path, text))
