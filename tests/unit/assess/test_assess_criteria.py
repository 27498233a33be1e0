"""Verdicts on histories whose measures are known, and what missing histories do to them."""

from __future__ import annotations

import io

import pytest
from unit.assess.assessed import frame, history, part

from edesign.archive.dataset import Group
from edesign.assess.criteria import Verdict, judge
from edesign.assess.judgement import within
from edesign.assess.members import frame_members
from edesign.assess.performance import BEYOND, drift_performance, member_performance, set_performance
from edesign.assess.sets import HistorySet, history_sets
from edesign.report.text import print_tables
from edesign.report.verdict_tables import performance_tables

DRIFT = "criteria: [{name: drift, measure: interstorey_drift, variants: damped, levels: DBE, %s}]"


def verdicts(text: str, histories: dict[str, Group]) -> tuple[Verdict, ...]:
    given = part(text)
    return judge(given.criteria, given.objectives, histories, frame())


def drifts(*values: float) -> dict[str, Group]:
    return {f"damped.DBE.{at}": history("damped", "DBE", value) for at, value in enumerate(values)}


@pytest.mark.parametrize(
    ("limits", "met", "remark"),
    [
        ("most: 1.3 %", True, ""),
        ("most: 1.0 %", True, ""),  # the limit itself is allowed
        ("most: 0.99 %", False, ""),
        ("least: 0.7 %, most: 1.3 %", True, "within the range"),
        ("least: 1.1 %, most: 1.3 %", True, "better than the range"),
        ("least: 1.1 %", False, ""),  # alone it is a requirement
        ("most: 1.3 %, statistic: maximum", False, ""),
        ("most: 0.8 %, statistic: median", True, ""),
        ("most: 1.3 %, statistic: 84 %", False, ""),
        ("most: 0.75 %, statistic: maximum, storeys: 2", True, ""),  # half of 1.5 %
    ],
)
def test_limits_of_a_drift(limits: str, met: bool, remark: str) -> None:
    (found,) = verdicts(DRIFT % limits, drifts(0.007, 0.008, 0.015))  # mean 1.0 %, median 0.8 %, maximum 1.5 %
    assert (found.met, found.remark) == (met, remark)


def test_a_verdict_says_where_it_comes_from() -> None:
    (found,) = verdicts(DRIFT % "least: 0.7 %, most: 1.3 %", drifts(0.007, 0.015, 0.008))
    assert found.value == pytest.approx(0.01, rel=1e-14)
    assert found.requirement == "interstorey drift 0.7 to 1.3 %"
    assert (found.limit, found.unit, found.count, found.missing) == (pytest.approx(0.013), "1", 3, ())
    assert (found.governing_history, found.governing_storey, found.governing_member) == ("damped.DBE.1", 1, "")


def test_a_failed_history_counts_as_beyond_the_limit() -> None:
    histories = drifts(0.007, 0.008, 0.009) | {"damped.DBE.x": history("damped", "DBE", 0.002, status="failed")}
    answers = {}
    for statistic in ("mean", "maximum", "median", "84%"):
        (found,) = verdicts(DRIFT % f"most: 1.3 %, statistic: {statistic}", histories)
        answers[statistic] = (found.met, found.value)
        assert (found.count, found.missing) == (3, ("damped.DBE.x",))
        assert "failed histories" in found.remark
    # the median of 0.7, 0.8, 0.9 % and infinity; an infinite statistic gives way to that of those that are there
    assert answers["median"] == (True, pytest.approx(0.0085))
    assert answers["mean"] == (False, pytest.approx(0.008))
    assert answers["maximum"] == (False, 0.009) and answers["84%"] == (False, 0.009)


def test_nothing_but_failed_histories_is_not_met() -> None:
    histories = {"damped.DBE.x": history("damped", "DBE", status="failed")}
    (found,) = verdicts(DRIFT % "most: 1.3 %", histories)
    assert (found.met, found.value, found.count) == (False, None, 0)


def test_histories_to_come_leave_a_verdict_open_unless_it_is_settled() -> None:
    to_come = {"damped.DBE.y": history("damped", "DBE", status="not run")}
    for statistic, open_one, settled in (("mean", None, None), ("maximum", None, False), ("median", True, False)):
        (found,) = verdicts(DRIFT % f"most: 1.3 %, statistic: {statistic}", drifts(0.007, 0.008, 0.009) | to_come)
        assert found.met is open_one, statistic  # the median of 0.7, 0.8, 0.9 and anything is at most 0.85 %
        (found,) = verdicts(DRIFT % f"most: 0.75 %, statistic: {statistic}", drifts(0.01, 0.008, 0.009) | to_come)
        assert found.met is settled, statistic
        assert "not run" in found.remark
    (found,) = verdicts(DRIFT % "most: 1.3 %", to_come)
    assert (found.met, found.value) == (None, None)


def test_what_nobody_ran_or_nobody_has_is_open() -> None:
    (found,) = verdicts(DRIFT % "most: 1.3 %", {"bare.DBE.0": history("bare", "DBE")})
    assert (found.met, found.remark, found.variant, found.level) == (None, "no such histories", "damped", "DBE")
    (found,) = verdicts("criteria: [{name: s, measure: damper_strain, most: 50 %}]", drifts(0.01))
    assert (found.met, found.remark) == (None, "does not apply")


def test_each_variant_and_level_is_judged_on_its_own() -> None:
    histories = {
        "bare.DBE.0": history("bare", "DBE", 0.02),
        "damped.DBE.0": history("damped", "DBE", 0.01),
        "damped.MCE.0": history("damped", "MCE", 0.03),
        "damped.35C.DBE.0": history("damped", "DBE", 0.04, temperature_C=35.0),
        "ida.0": history("damped", "DBE", 0.09, incremental="ida"),
    }
    found = verdicts("criteria: [{name: d, measure: interstorey_drift, most: 1.3 %}]", histories)
    assert [(v.variant, v.level, v.met) for v in found] == [
        ("bare", "DBE", False),
        ("damped", "DBE", True),  # neither the one at 35 degC nor the incremental one is among them
        ("damped", "MCE", False),
        ("damped at 35 degC", "DBE", False),
    ]


def test_plastic_hinges_of_columns_and_beams() -> None:
    # known_history: beams 0.011, columns 0.002 (C_A_1) and 0.001 (C_B_1)
    for text, met, member in (
        ("of: columns", False, "C_A_1"),
        ("of: columns, rotation: 2 mrad", True, "C_A_1"),
        ("of: columns, members: C_B_1", True, "C_B_1"),
        ("of: all", False, "B_1_1"),
        ("of: beams, storeys: 2, rotation: 0.004 rad", True, "B_1_2"),
    ):
        (found,) = verdicts(f"criteria: [{{name: elastic, plastic_hinges: none, {text}}}]", drifts(0.01))
        assert (found.met, found.governing_member) == (met, member), text


def test_performance_of_one_history_by_hand() -> None:
    members, one = frame_members(frame()), history("damped", "DBE", 0.03)
    found = set_performance(HistorySet("damped", "DBE", {"one": one}), members)
    drift, rotation = drift_performance(one, "CP"), member_performance(one, members, "LS")
    # drift 3 % is beyond 2.5 % and within 5 %; beam 0.011 rad within 6 theta_y = 6*0.0079398*6/7.2
    assert (found.by_drift, found.by_members) == ("CP", "LS")
    assert drift is not None and rotation is not None
    assert drift.ratio == pytest.approx(0.03 / 0.05, rel=1e-12)
    assert (drift.governing, drift.storey) == ("transient drift", 1)
    one.variables["residual_storey_drift"].values[:] = [0.002, 0.045]  # 90 % of the permanent drift
    drift = drift_performance(one, "CP")
    assert drift is not None and drift.ratio == pytest.approx(0.045 / 0.05, rel=1e-12)
    assert (drift.governing, drift.storey) == ("residual drift", 2)
    assert rotation.ratio == pytest.approx(0.011 / (6 * 0.0066165), rel=1e-4)
    assert rotation.member == "B_1_1"
    # column A of 4 m under 900 kN: P_CL = 4958 kN (P/P_CL 0.18), theta_y = 0.0043469*(1 - 900/5822.3) = 0.0036750
    column = member_performance(one, members, "IO", ("column",))
    assert column is not None and column.member == "C_A_1"
    assert column.ratio == pytest.approx(0.002 / 0.0036750, rel=1e-4)
    assert not column.force_controlled


def test_a_force_controlled_column_may_not_turn() -> None:
    one = history("damped", "DBE")
    one.variables["column_axial_force_min"].values[:] = [-2.6e6, -8e5]  # P/P_CL = 2600/4958 = 0.52
    column = member_performance(one, frame_members(frame()), "CP", ("column",))
    assert column is not None and column.force_controlled
    assert column.ratio == pytest.approx(0.002 / 0.001, rel=1e-12)  # of what still counts as elastic


def test_performance_of_a_set() -> None:
    histories = drifts(0.006, 0.02, 0.022, 0.06) | {"damped.DBE.x": history("damped", "DBE", status="failed")}
    (together,) = history_sets(histories)
    found = set_performance(together, frame_members(frame()))
    assert found.drift_counts == {"IO": 1, "LS": 2, "CP": 0, BEYOND: 1}
    assert found.by_drift == "CP"  # the mean of 0.6, 2.0, 2.2 and 6.0 % is 2.7 %
    assert set_performance(together, frame_members(frame()), "median").by_drift == "LS"
    assert set_performance(together, frame_members(frame()), "maximum").by_drift == BEYOND
    assert found.worst_drift is not None and found.worst_drift[0] == "damped.DBE.3"
    assert found.worst_drift[1].ratio == pytest.approx(1.2, rel=1e-12)
    assert (found.count, found.missing) == (4, ("damped.DBE.x",))


def test_objectives_go_by_drift_and_by_members() -> None:
    histories = drifts(0.02, 0.028) | {"damped.MCE.0": history("damped", "MCE", 0.051)}
    found = verdicts("objectives: [h, l]", histories)  # 475 years are 10 % in 50 years
    assert [(v.name, v.level, v.met) for v in found] == [
        ("objective h, by drift", "DBE", True),  # mean 2.4 of 2.5 %
        ("objective h, by members", "DBE", True),
        ("objective l, by drift", "MCE", False),
        ("objective l, by members", "MCE", True),
    ]
    assert found[0].value == pytest.approx(0.96, rel=1e-12)


def test_a_limit_from_below_fails_with_failed_histories() -> None:
    values = {"a": 3.0, "b": 4.0, "c": None}
    assert within("mean", values, (), None, 2.0) is False
    assert within("median", values, (), None, 2.0) is True  # of minus infinity, 3 and 4
    assert within("median", values, (), None, 3.5) is False
    assert within("maximum", values, (), None, 3.5) is True


def test_tables_of_performance_fit_a_page() -> None:
    """By drift and by members apart, each with its own usage, on 80 columns."""
    one = history("modified", "el_centro", 0.03)
    tables = performance_tables([HistorySet("modified", "el_centro", {"one": one})], frame_members(frame()))
    stream = io.StringIO()
    print_tables(tables, stream)
    assert max(map(len, stream.getvalue().splitlines())) <= 80
    drift, members = (table.rows[0] for table in tables)
    assert drift[:8] == ["modified", "el_centro", "CP", "0", "0", "1", "0", "1/1"] and "transient drift" in drift[8]
    assert members[:8] == ["modified", "el_centro", "LS", "0", "1", "0", "0", "1/1"] and "B_1_1" in members[8]
