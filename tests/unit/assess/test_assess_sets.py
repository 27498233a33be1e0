"""Histories that belong together: no mean is over one record twice."""

from __future__ import annotations

from unit.assess.assessed import history

from edesign.assess.sets import history_sets


def test_one_record_at_two_scales_is_no_set_of_two_motions() -> None:
    histories = {
        "weak.a": history("", "", 0.01, record="suite/a"),
        "weak.b": history("", "", 0.02, record="suite/b"),
        "strong.a": history("", "", 0.03, record="suite/a"),
        "other": history("", "DBE", 0.03, record="c"),
    }
    found = {(one.variant, one.level): list(one.histories) for one in history_sets(histories)}
    assert found == {
        ("weak", ""): ["weak.a", "weak.b"],
        ("strong", ""): ["strong.a"],
        ("other", "DBE"): ["other"],
    }


def test_different_records_of_a_level_are_one_set() -> None:
    histories = {name: history("", "DBE", record=name) for name in ("a", "b")}
    assert [list(one.histories) for one in history_sets(histories)] == [["a", "b"]]
