"""Words of captions and names of files."""

from __future__ import annotations

import pytest

from edesign.report.drawing.captions import file_name, plain, record_label
from edesign.report.response.histories import history_of


@pytest.mark.parametrize(
    ("value", "text"),
    [
        (1098.4, "1098"),
        (123.45, "123"),
        (12.345, "12.3"),
        (99.9999, "100"),
        (0.0456, "0.0456"),
        (-2.0, "-2.00"),
        (0.0, "0"),
        (1e-9, "0"),
    ],
)
def test_three_significant_digits(value: float, text: str) -> None:
    assert plain(value) == text


@pytest.mark.parametrize(
    ("reference", "label"),
    [
        ("table_5_6/ImperialValley1979_H-EMO000", "Imperial Valley 1979 H-EMO000"),
        ("table_5_6/Tabas1978_FER-L1", "Tabas 1978 FER-L1"),
        ("el_centro", "el centro"),
    ],
)
def test_records_in_words(reference: str, label: str) -> None:
    assert record_label(reference) == label


def test_file_names_have_no_strange_characters() -> None:
    assert file_name("response", "", "MCE +", "suite/A b_1") == "response_MCE-_A-b_1"


def test_histories_of_a_building_are_told_apart() -> None:
    """By angle and place of the masses, which stand at the end of names; of a plane frame by the record alone."""
    about = {"record": "pairs/el_centro", "level": "DBE", "angle_deg": 22.5, "eccentricity": "+x-y"}
    words = {
        "bare.DBE.el_centro.22.5deg.+x-y": "el centro, 22.5 deg, masses +x-y",
        "bare.DBE.el_centro.22.5deg": "el centro, 22.5 deg",
        "bare.DBE.el_centro.+x-y": "el centro, masses +x-y",
        "bare.DBE.el_centro": "el centro",
    }
    for name, text in words.items():
        assert history_of(name, about).motion == text
    places = [history_of(f"a.{at}", {**about, "eccentricity": at}) for at in ("0", "+x+y", "-x-y")]
    assert places[0].motion == "el centro, masses in place"
    assert len({file_name(one.shaken_by) for one in places}) == 3
    plane = history_of("bare.DBE.el_centro", {"record": "suite/el_centro", "level": "DBE"})
    assert (plane.shaken_by, plane.motion) == ("suite/el_centro", "el centro")
