"""How far single members change between variants: the largest of all columns hides it where another one governs."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
import pytest

from edesign.archive.dataset import Group, Variable
from edesign.assess.changes import largest_change, tension
from edesign.assess.sets import HistorySet, history_sets
from edesign.report.assessment.change_tables import changes_in_short, changes_table
from edesign.report.assessment.measure_tables import statistics_tables

COLUMNS = ("C_A_1", "C_B_1", "C_A_2")


def history(
    variant: str, record: str, forces: Mapping[str, tuple[float, float]], drifts: tuple[float, float], rotation: float
) -> Group:
    """Smallest and largest axial force of each column, kN, tension positive; drifts of two storeys, %."""
    about = {"kind": "history", "variant": variant, "level": "DBE", "record": record, "status": "completed"}
    found = Group(attributes=about)
    found.coords["column"] = Variable(("column",), np.array(list(forces)), "", "name")
    found.coords["storey"] = Variable(("storey",), np.array([1, 2]), "1", "number")
    found.coords["beam"] = Variable(("beam",), np.array(["B_1_1"]), "", "name")
    for at, which in enumerate(("min", "max")):
        values = [1e3 * force[at] for force in forces.values()]
        found.add(f"column_axial_force_{which}", ("column",), values, "N", "axial force")
    found.add("storey_drift_max", ("storey",), [0.01 * drift for drift in drifts], "1", "drift")
    found.add("beam_plastic_rotation_max", ("beam",), [rotation], "rad", "plastic rotation")
    return found


BARE = {"C_A_1": (-1000.0, -500.0), "C_B_1": (-400.0, -200.0), "C_A_2": (-300.0, -100.0)}
DAMPED = {"C_A_1": (-993.0, -480.0), "C_B_1": (-528.0, 60.0), "C_A_2": (-310.0, 25.0)}
MORE = {"C_A_1": (-993.0, -480.0), "C_B_1": (-528.0, 40.0), "C_A_2": (-310.0, -90.0)}


@pytest.fixture
def sets() -> tuple[HistorySet, ...]:
    """The largest force of all falls by 0.7 %, that of C_B_1 grows by 32 %; drift grows in storey 2 alone."""
    return history_sets(
        {
            "bare.one": history("bare", "one", BARE, (1.0, 0.5), 0.003),
            "bare.two": history("bare", "two", BARE, (1.0, 0.5), 0.003),
            "bare.three": history("bare", "three", {name: (-9e3, 0.0) for name in COLUMNS}, (9.0, 9.0), 0.0),
            "damped.one": history("damped", "one", DAMPED, (0.6, 0.55), 0.0),
            "damped.two": history("damped", "two", MORE, (0.6, 0.55), 0.0),
        }
    )


def test_the_column_that_grows_most_is_named(sets: tuple[HistorySet, ...]) -> None:
    rows = {row[1]: row for row in changes_table(sets).texts}
    # record three has no history with dampers, and counts in neither mean
    assert rows["column axial force [kN]"] == [
        "damped, DBE", "column axial force [kN]", "C_B_1", "400.0", "528.0", "+32.0",
    ]  # fmt: skip
    assert rows["storey drift [%]"][2:] == ["storey 2", "0.5000", "0.5500", "+10.0"]
    assert "beam plastic rotation [mrad]" in rows and rows["beam plastic rotation [mrad]"][-1] == "-100.0"
    (short,) = changes_in_short(sets).texts
    assert short == ["damped, DBE", "+10.0 % storey 2", "+32.0 % C_B_1", "60.0 kN C_B_1"]


def test_the_maximum_of_all_columns_stays_and_points_to_the_table(sets: tuple[HistorySet, ...]) -> None:
    mean = statistics_tables(sets)[0]
    row = next(row for row in mean.texts if row[0] == "column axial force [kN]")
    assert row[-1] == "-0.7"
    assert any("grows most is another table" in note for note in mean.notes)
    assert not any("grows most" in note for note in statistics_tables(sets[:1])[0].notes)


def test_columns_in_tension_and_uplift_are_reported(sets: tuple[HistorySet, ...]) -> None:
    found = tension(sets[1].completed.values())
    assert found is not None
    assert (found.column, found.force, found.columns, found.lifting) == (
        "C_B_1", 60e3, ("C_B_1", "C_A_2"), ("C_B_1",),
    )  # fmt: skip
    assert tension(sets[0].completed.values()) is None
    reported = "damped, DBE: 2 columns in tension, most C_B_1, 60.0 kN; 1 of them in storey 1, which pulls at supports"
    assert reported in changes_table(sets).notes


def test_what_may_be_zero_is_compared_by_its_difference() -> None:
    before, after = history("a", "r", BARE, (1.0, 1.0), 0.0), history("b", "r", BARE, (1.0, 1.0), 0.002)
    found = largest_change([[before]], [[after]], "beam_plastic_rotation")
    assert found is not None and (found.place, found.before, found.after) == ("B_1_1", 0.0, 0.002)
    assert largest_change([[before]], [[after]], "brace_axial_force") is None


def test_one_variant_has_nothing_to_be_compared_with(sets: tuple[HistorySet, ...]) -> None:
    assert not changes_table(sets[:1]).rows and not changes_in_short(sets[:1]).rows


def test_of_one_motion_the_worst_angle_counts_for_each_place() -> None:
    """Storeys 1 and 2: means of the worst of two angles over two records, by hand."""
    drifts = {  # before, after; each at two angles
        "one": (((1.0, 0.2), (0.4, 0.6)), ((0.5, 0.9), (0.8, 0.1))),
        "two": (((0.6, 0.4), (0.6, 0.2)), ((0.4, 0.3), (0.2, 0.5))),
    }
    groups = {}
    for at, variant in enumerate(("bare", "damped")):
        for record, of in drifts.items():
            for angle, pair in zip((0.0, 90.0), of[at], strict=True):
                group = history(variant, record, BARE, pair, 0.0)
                group.attributes["angle_deg"] = angle
                groups[f"{variant}.{record}.{angle:g}deg"] = group
    (row,) = (row for row in changes_table(history_sets(groups)).texts if row[1] == "storey drift [%]")
    # storey 1: 0.8 and 0.6 %; storey 2: (0.6 + 0.4) / 2 and (0.9 + 0.5) / 2
    assert row[2:] == ["storey 2", "0.5000", "0.7000", "+40.0"]
