"""Names and titles of PEER files, of the forms that the data base has used; titles as its files have them."""

from __future__ import annotations

from pathlib import Path

import pytest

from edesign.ground_motion.peer_header import contradictions, read_peer_header, same_year
from edesign.ground_motion.peer_name import PeerName, may_be_peer

EL_CENTRO = PeerName("IMPVALL.I", "I-ELC180", 6)
EL_ALAMO = PeerName("ELALAMO", "ELC180")


@pytest.mark.parametrize(
    ("text", "name"),
    [
        ("RSN6_IMPVALL.I_I-ELC180.AT2", EL_CENTRO),
        ("rsn6_IMPVALL.I_I-ELC180.time_acc.csv", EL_CENTRO),
        ("ELALAMO_ELC180", EL_ALAMO),
        ("RSN1633_MANJIL_ABBAR--L", PeerName("MANJIL", "ABBAR--L", 1633)),
        ("RSN570_SMART1.45_45C00DN.at2", PeerName("SMART1.45", "45C00DN", 570)),
        ("I-ELC180", None),
        ("RSN6", None),
        ("", None),
    ],
)
def test_reading_names(text: str, name: PeerName | None) -> None:
    assert PeerName.parse(text) == name


@pytest.mark.parametrize(
    ("name", "file", "complete", "short"),
    [
        (EL_CENTRO, "RSN6_IMPVALL.I_I-ELC180.AT2", True, False),
        (EL_CENTRO, "rsn6_impvall.i_i-elc180.at2", True, False),
        (EL_CENTRO, "IMPVALL.I_I-ELC180.time_acc.csv", True, False),
        (EL_CENTRO, "IMPVALL_I-ELC180.AT2", False, True),
        (EL_CENTRO, "NGA_no_6_I-ELC180.AT2", False, True),
        (EL_CENTRO, "I-ELC180.at2", False, True),
        (EL_CENTRO, "RSN6_IMPVALL_I-ELC180.AT2", False, True),
        (EL_CENTRO, "RSN60_IMPVALL.I_I-ELC180.AT2", False, False),  # another number
        (EL_CENTRO, "RSN6_IMPVALLxI_I-ELC180.AT2", False, True),  # the point is a point
        (EL_CENTRO, "RSN6_IMPVALL.I_I-ELC180.VT2", False, False),
        (EL_CENTRO, "RSN6_IMPVALL.I_I-ELC180-hor1.AT2", False, False),
        (EL_CENTRO, "I-ELC180.time_acc.csv", False, False),  # has no title that names the earthquake
        (EL_ALAMO, "RSN22_ELALAMO_ELC180.AT2", True, False),  # number not known
        (EL_ALAMO, "RSN6_IMPVALL.I_I-ELC180.AT2", False, False),
        (EL_ALAMO, "A-ELC180.AT2", False, False),
        (EL_ALAMO, "ELC180.AT2", False, True),
        (EL_ALAMO, "XELC180.AT2", False, False),
    ],
)
def test_names_of_files(name: PeerName, file: str, complete: bool, short: bool) -> None:
    assert (name.is_complete(file), name.is_short(file)) == (complete, short)
    assert may_be_peer(file) or not (complete or short)


def header(folder: Path, title: str):  # type: ignore[no-untyped-def]
    path = folder / "x.AT2"
    path.write_text(f"PEER\n{title}\nACCELERATION\n")
    return read_peer_header(path)


@pytest.mark.parametrize(
    ("title", "event", "year", "station", "azimuth"),
    [
        (
            "Imperial Valley-02, 5/19/1940, El Centro Array #9, 180",
            "Imperial Valley-02",
            1940,
            "El Centro Array #9",
            180,
        ),
        (
            "IMPERIAL VALLEY 5/19/40 4:39, EL CENTRO ARRAY #9, 180 (USGS STATION 117)",
            "IMPERIAL VALLEY",
            40,
            "EL CENTRO ARRAY #9",
            180,
        ),
        ("Northern Calif-03, 12/21/1954, Ferndale City Hall, 44", "Northern Calif-03", 1954, "Ferndale City Hall", 44),
        ("Tabas Iran, 9/16/1978, Ferdows, L", "Tabas Iran", 1978, "Ferdows", None),
        ("Somewhere, 1/1/1990, A, B, UP", "Somewhere", 1990, "A, B", None),
        ("a title of one's own", "", None, "", None),
        ("", "", None, "", None),
    ],
)
def test_reading_titles(
    tmp_path: Path, title: str, event: str, year: int | None, station: str, azimuth: int | None
) -> None:
    found = header(tmp_path, title)
    assert (found.event, found.year, found.station, found.azimuth) == (event, year, station, azimuth)


def test_two_digits_of_a_year(tmp_path: Path) -> None:
    old = header(tmp_path, "KERN COUNTY 7/21/52 11:53, LA - HOLLYWOOD STOR LOT, 090 (USGS STATION 135)")
    assert same_year(old, 1952) and not same_year(old, 1971)
    assert contradictions(old, "Kern County", 1952, "LA - Hollywood Stor FF", "PEL090") == []


@pytest.mark.parametrize(
    ("event", "year", "station", "component", "said"),
    [
        ("Imperial Valley-06", 1979, "El Centro Array #7", "H-E07140", []),
        ("Imperial Valley", 1979, "Array 7", "H-E07230", ["azimuth 140 instead of 230"]),
        (None, None, None, "H-E07-UP", []),
        (None, None, None, "H-E07500", []),  # not an azimuth
        ("Imperial Valley-02", 1979, None, None, ["earthquake"]),
        ("Imperial Valley-06", 1940, None, None, ["year 1979 instead of 1940"]),
        (None, None, "El Centro Array #8", "H-E08140", ["station `El Centro Array #7` instead of"]),
        (None, None, "Brawley Airport", "H-BRA225", ["station", "azimuth 140 instead of 225"]),
    ],
)
def test_contradictions(
    tmp_path: Path, event: str | None, year: int | None, station: str | None, component: str | None, said: list[str]
) -> None:
    found = contradictions(
        header(tmp_path, "Imperial Valley-06, 10/15/1979, El Centro Array #7, 140"), event, year, station, component
    )
    assert len(found) == len(said) and all(part in text for part, text in zip(said, found, strict=True))


def test_north_is_0_and_360(tmp_path: Path) -> None:
    assert contradictions(header(tmp_path, "X, 1/1/1990, Y, 0"), component="RIO360") == []
