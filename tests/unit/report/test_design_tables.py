"""Tables of a design: the rounds with what was judged in them, and the bounds with the one that governs."""

from __future__ import annotations

import numpy as np

from edesign.archive.dataset import Group, Variable
from edesign.report.design.tables import bounds_table, design_tables, rounds_table


def design() -> Group:
    about = {"name": "small", "status": "completed", "changed": "area", "chosen_round": 2, "layers": 2, "places": 4}
    group = Group(attributes={**about, "governing": {"storey_drift": "lower"}})

    def axis(name: str, values: list[object]) -> None:
        group.coords[name] = Variable((name,), np.asarray(values), "1", name)

    axis("round", [1, 2])
    axis("storey", [1, 2])
    axis("criterion", ["drift"])
    axis("bound", ["lower", "upper"])
    group.add("round_changed", ("round",), [1.0, 1.5], "1", "factor on the area")
    group.add("round_damping_strain_energy", ("round",), [0.08, 0.10], "1", "damping")
    group.add("round_period", ("round",), [1.0, 0.9], "s", "period")
    group.add("round_layer_area", ("round", "storey"), [[0.2, 0.1], [0.3, 0.15]], "m^2", "area")
    group.add("round_met", ("round",), [0, 1], "1", "met")
    group.add("round_strain", ("round",), [0.2, 0.2], "1", "strain")
    group.add("round_history_strain", ("round",), [0.31, 0.24], "1", "strain")
    group.add("verdict_value", ("round", "criterion"), [[0.015], [0.012]], "1", "value")
    group.add("verdict_limit", ("round", "criterion"), [[0.0125], [0.0125]], "1", "limit")
    group.add("criterion_unit", ("criterion",), ["1"], "", "unit")
    group.add("bound_factor", ("bound",), [0.85, 1.2], "1", "factor")
    group.add("bound_storey_drift", ("bound", "storey"), [[0.010, 0.014], [0.008, 0.011]], "1", "drift")
    group.add("bound_temperature", ("bound",), [35.0, np.nan], "degC", "temperature")
    return group


def test_rounds_say_what_was_judged_and_whether_it_was_met() -> None:
    table = rounds_table(design())
    wanted = ["round", "factor on areas", "damping [%]", "T1 [s]", "all layers [m2]"]
    assert table.headers == [*wanted, "strain [%]", "in histories [%]", "drift [%]", "met"]
    assert table.texts[0] == ["1", "1.000", "8.000", "1.000", "1.200", "20.00", "31.00", "1.500", "no"]
    assert table.texts[1][:2] == ["2 (chosen)", "1.500"] and table.texts[1][6:] == ["24.00", "1.200", "yes"]
    assert table.notes == ["limits: drift 1.250 %"]


def test_bounds_show_the_largest_over_the_height_and_what_governs() -> None:
    rows = {row[0]: row[1:] for row in bounds_table(design()).texts}
    assert rows["storey drift [%]"] == ["1.400", "1.100", "lower"]
    assert rows["temperature [degC]"] == ["35.00", "-", ""]


def test_a_failed_design_shows_its_reason() -> None:
    (table,) = design_tables(Group(attributes={"name": "x", "status": "failed", "reason": "out of rounds"}))
    assert table.notes == ["failed: out of rounds"]
