"""Verdicts on histories whose measures are known, and what missing histories do to them."""

from __future__ import annotations

import io

import numpy as np
import pytest
from unit.assess.assessed import frame, history, part

from edesign.archive.dataset import Group, Variable
from edesign.assess.judgement import within
from edesign.assess.members import VariantMembers, frame_members, with_gravity
from edesign.assess.performance import BEYOND, drift_performance, member_performance, set_performance
from edesign.assess.requirement import requirement_of
from edesign.assess.sets import HistorySet, history_sets
from edesign.assess.verdicts import Verdict, judge
from edesign.project.reading.yaml_file import check_model
from edesign.project.study.study import Study
from edesign.report.assessment.verdict_tables import performance_tables
from edesign.report.tables.text import print_tables

DRIFT = "criteria: [{name: drift, measure: interstorey_drift, variants: damped, levels: DBE, %s}]"


def verdicts(text: str, histories: dict[str, Group]) -> tuple[Verdict, ...]:
    given = part(text)
    return judge(given.criteria, given.objectives, histories, frame())


def drifts(*values: float) -> dict[str, Group]:
    return {f"damped.DBE.{at}": history("damped", "DBE", value) for at, value in enumerate(values)}


@pytest.mark.parametrize(
    ("limits", "met", "remark"),
    [
        ("most: 1.3 %, statistic: mean", True, ""),
        ("most: 1.0 %, statistic: mean", True, ""),  # the limit itself is allowed
        ("most: 0.99 %, statistic: mean", False, ""),
        ("least: 0.7 %, most: 1.3 %, statistic: mean", True, "within the range"),
        ("least: 1.1 %, most: 1.3 %, statistic: mean", True, "better than the range"),
        ("least: 1.1 %, statistic: mean", False, ""),  # alone it is a requirement
        ("most: 1.3 %, statistic: maximum", False, ""),
        ("most: 1.49 %", False, ""),  # without `statistic` the largest of three counts, EN 1998-1, 4.3.3.4.3(3)
        ("most: 1.5 %", True, ""),
        ("least: 0.7 %", True, ""),  # and of a limit from below the smallest
        ("least: 0.75 %", False, ""),
        ("most: 0.8 %, statistic: median", True, ""),
        ("most: 1.3 %, statistic: 84 %", False, ""),
        ("most: 0.75 %, statistic: maximum, storeys: 2", True, ""),  # half of 1.5 %
    ],
)
def test_limits_of_a_drift(limits: str, met: bool, remark: str) -> None:
    (found,) = verdicts(DRIFT % limits, drifts(0.007, 0.008, 0.015))  # mean 1.0 %, median 0.8 %, maximum 1.5 %
    assert (found.met, found.remark) == (met, remark)


@pytest.mark.parametrize(
    ("limit", "words"),
    [
        ("quantity: column_axial_force, side: tension, most: 1 MN", "column axial force in tension at most 1000 kN"),
        (
            "quantity: support_vertical_reaction, side: tension, most: 0 kN",
            "support vertical reaction in uplift at most",
        ),
        (
            "quantity: support_vertical_reaction, side: compression, most: 1 MN",
            "reaction in compression at most 1000 kN",
        ),
    ],
)
def test_sides_of_a_force_have_their_words(limit: str, words: str) -> None:
    """A support is lifted off, a member is in tension."""
    (criterion,) = part(f"criteria: [{{name: force, {limit}}}]").criteria
    assert words in requirement_of(criterion, {}, frame()).words


def test_a_verdict_says_where_it_comes_from() -> None:
    (found,) = verdicts(DRIFT % "least: 0.7 %, most: 1.3 %, statistic: mean", drifts(0.007, 0.015, 0.008))
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
    assert found.ratio == np.inf  # and not 0.9/1.3, which is of those that are there


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


def test_what_nobody_ran_is_open_and_what_nobody_has_does_not_apply() -> None:
    (found,) = verdicts(DRIFT % "most: 1.3 %", {"bare.DBE.0": history("bare", "DBE")})
    assert (found.answer, found.remark, found.variant, found.level) == ("open", "no such histories", "damped", "DBE")
    (found,) = verdicts("criteria: [{name: s, measure: damper_strain, most: 50 %}]", drifts(0.01))
    assert (found.answer, found.remark, found.missing) == ("does not apply", "there are no dampers", ())


STUDY = """\
edesign_study: 1
title: Two variants
project: project.yaml
variants: {bare: {dampers: none}, damped: {dampers: project}}
histories:
  - {variants: bare, levels: DBE, records: motion}
  - {variants: damped, levels: [DBE, MCE], records: motion}
"""


def test_a_study_lists_what_should_have_run() -> None:
    """Planned and not run is open; not planned, or of dampers that a variant has not, does not apply."""
    read, problems = check_model(STUDY, Study, "study file", "edesign_study: 1")
    assert read is not None and not problems.found
    text = (
        "criteria:\n"
        "  - {name: drift, measure: interstorey_drift, variants: [bare, damped], levels: [DBE, MCE], most: 1.3 %}\n"
        "  - {name: stroke, quantity: damper_deformation, most: 20 mm}\n"
        "  - {name: brace, quantity: brace_axial_force, most: 20 kN}\n"
    )
    given = part(text)
    answers = {
        (v.name, v.variant, v.level): (v.answer, v.remark)
        for v in judge(given.criteria, (), {"bare.DBE.0": history("bare", "DBE")}, frame(), read)
    }
    nothing, idle = ("open", "no such histories"), ("does not apply", "there are no dampers")
    assert answers == {
        ("drift", "bare", "DBE"): ("met", ""),
        ("drift", "damped", "DBE"): nothing,
        ("drift", "damped", "MCE"): nothing,
        ("drift", "bare", "MCE"): ("does not apply", "the study runs no such histories"),
        ("stroke", "bare", "DBE"): idle,
        ("stroke", "damped", "DBE"): nothing,
        ("stroke", "damped", "MCE"): nothing,
        ("brace", "bare", "DBE"): ("does not apply", "there are no braces"),
        ("brace", "damped", "DBE"): nothing,
        ("brace", "damped", "MCE"): nothing,
    }


@pytest.mark.parametrize(
    ("text", "value", "place"),
    [  # known_history: floors peak at 7 and 5 m/s2, columns between -900 and 100 kN, and -800 and -200 kN
        ("quantity: floor_acceleration, most: 1 g", 7.0, "floor 1"),
        ("quantity: floor_acceleration, floors: 2, most: 1 g", 5.0, "floor 2"),
        ("quantity: floor_displacement, most: 0.3 m", 0.21, "floor 2"),
        ("quantity: storey_drift, storeys: 2, most: 1 %", 0.005, "storey 2"),
        ("quantity: residual_storey_drift, most: 1 %", 0.001, "storey 1"),
        ("quantity: storey_shear, storeys: 2, most: 1 MN", 1e5, "storey 2"),
        ("quantity: base_shear, most: 1 MN", 3e5, ""),
        ("quantity: column_axial_force, most: 1 MN", 9e5, "C_A_1"),
        ("quantity: column_axial_force, side: tension, most: 1 MN", 1e5, "C_A_1"),
        ("quantity: column_axial_force, side: tension, members: C_B_1, most: 1 MN", 0.0, "C_B_1"),
        ("quantity: column_axial_force, side: compression, members: C_B_1, most: 1 MN", 8e5, "C_B_1"),
        ("quantity: beam_plastic_rotation, storeys: 2, most: 1 rad", 0.004, "B_1_2"),
    ],
)
def test_quantities_at_places(text: str, value: float, place: str) -> None:
    (found,) = verdicts(f"criteria: [{{name: one, {text}}}]", drifts(0.01))
    assert found.value == pytest.approx(value, rel=1e-15) and found.place == place
    assert found.ratio == pytest.approx(value / found.limit, rel=1e-15)


def test_a_share_of_the_motions() -> None:
    """Of five motions three are at most 1 %; a failed one does not meet, one to come may still."""
    text = "criteria: [{name: one, measure: interstorey_drift, most: 1 %%, share: %s}]"
    five = drifts(0.007, 0.008, 0.010, 0.012, 0.013)
    for share, met in (("60 %", True), ("0.61", False), ("100 %", False)):
        (found,) = verdicts(text % share, five)
        assert (found.met, found.value, found.statistic, found.count) == (met, 0.6, "share", 5)
        assert found.governing_history == "damped.DBE.4" and found.unit == "1"
    assert found.ratio == pytest.approx(1.0 / 0.6)
    failed = five | {"damped.DBE.x": history("damped", "DBE", status="failed")}
    (found,) = verdicts(text % "60 %", failed)
    assert (found.met, found.value, found.missing) == (False, 0.5, ("damped.DBE.x",))
    to_come = five | {"damped.DBE.y": history("damped", "DBE", status="not run")}
    (none_met,) = verdicts("criteria: [{name: one, measure: interstorey_drift, most: 0.001 %, share: 50 %}]", five)
    assert (none_met.met, none_met.value, none_met.ratio) == (False, 0.0, None)
    for share, met in (("50 %", True), ("60 %", None), ("70 %", False)):  # 3 or 4 of 6
        (found,) = verdicts(text % share, to_come)
        assert (found.met, found.answer) == (met, {True: "met", None: "open", False: "not met"}[met])


def test_statistics_of_codes_and_percentiles() -> None:
    """EN 1998-1, 4.3.3.4.3(3): the mean of seven motions or more, else the maximum; ASCE/SEI 7-22, 16.2.2: eleven."""
    values = [0.001 * number for number in range(1, 12)]
    for statistic, count, value, taken in (
        ("ec8", 6, 0.006, "maximum"),
        ("ec8", 7, 0.004, "mean"),
        ("code", 6, 0.006, "maximum"),
        ("code", 7, 0.004, "mean"),
        ("asce7", 10, 0.010, "maximum"),
        ("asce7", 11, 0.006, "mean"),
        ("percentile 90 %", 10, 0.009, "90%"),
        ("84 %", 10, 0.009, "84%"),
        ("50%", 10, 0.005, "50%"),
    ):
        (found,) = verdicts(DRIFT % f"most: 1.3 %, statistic: {statistic}", drifts(*values[:count]))
        assert found.value == pytest.approx(value, rel=1e-12) and found.statistic == taken


def test_histories_that_an_archive_lacks_leave_a_verdict_open() -> None:
    text = "criteria: [{name: e, quantity: floor_spectral_acceleration, frequency: 5 Hz, damping: 2 %, most: 1 g}]"
    (found,) = verdicts(text, drifts(0.01))
    assert (found.answer, found.remark) == ("open", "`floor_acceleration` is not in the archive")


def test_a_floor_spectrum_of_a_sine_by_its_closed_form() -> None:
    """An oscillator at rest on a floor that begins to shake as a sine at its own frequency.

    Its relative displacement is a/(2 zeta w^2) (cos wt - e^(-zeta w t) (cos w_d t + zeta/sqrt(1-zeta^2) sin w_d t)).
    """
    w, zeta, amplitude, step = 2.0 * np.pi * 5.0, 0.02, 3.0, 0.002
    time = step * np.arange(2001)  # 20 cycles, at the end of which the floor stands still
    group = history("damped", "DBE")
    group.coords["time"] = Variable(("time",), time, "s", "time")
    floors = np.column_stack([0.0 * time, amplitude * np.sin(w * time)])
    group.add("floor_acceleration", ("time", "floor"), floors, "m/s^2", "total acceleration")
    root = np.sqrt(1.0 - zeta**2)
    wd, decay = w * root, np.exp(-zeta * w * time)
    u = (
        amplitude
        / (2.0 * zeta * w**2)
        * (np.cos(w * time) - decay * (np.cos(wd * time) + zeta / root * np.sin(wd * time)))
    )
    total = w**2 * u + 2.0 * zeta * w * np.gradient(u, step, edge_order=2)
    text = "criteria: [{name: e, quantity: floor_spectral_acceleration, frequency: 5 Hz, damping: 2 %, most: 10 g}]"
    (found,) = verdicts(text, {"one": group})
    assert found.value == pytest.approx(np.abs(total).max(), rel=1e-3)  # its peaks lie between the samples
    assert found.place == "floor 2"


def test_the_velocity_of_a_damper_by_its_deformation() -> None:
    """A sine of 5 Hz that swells and fades, at 0.01 s; the spline gives its velocity to (w h)^4/180 = 5e-5."""
    w, step = 2.0 * np.pi * 5.0, 0.01
    time = step * np.arange(201)
    group = history("damped", "DBE")
    group.coords["time"] = Variable(("time",), time, "s", "time")
    group.coords["damper"] = Variable(("damper",), np.array(["V_1_1", "V_1_2"]), "", "damper")
    group.add("damper_storey", ("damper",), [1, 2], "1", "storey")
    swell = np.sin(0.5 * np.pi * time) ** 2
    wave = swell * np.sin(w * time)
    rate = 0.5 * np.pi * np.sin(np.pi * time) * np.sin(w * time) + swell * w * np.cos(w * time)
    strokes = np.column_stack([0.01 * wave, 0.02 * wave])
    group.add("damper_deformation", ("time", "damper"), strokes, "m", "deformation")
    for chosen, amplitude, name in (("storeys: 1", 0.01, "V_1_1"), ("dampers: V_1_2", 0.02, "V_1_2")):
        (found,) = verdicts(
            f"criteria: [{{name: v, quantity: damper_velocity, {chosen}, most: 1 m/s}}]", {"one": group}
        )
        assert found.value == pytest.approx(amplitude * np.abs(rate).max(), rel=1e-4) and found.place == name


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
    assert column.of_force == ""


def test_a_record_and_its_reverse_are_one_motion() -> None:
    """Seven motions have a mean by EN 1998-1, 4.3.3.4.3(3); four of both signs are eight histories, and have none."""

    def reported(signs: list[str]) -> str:
        histories = {}
        for sign in signs:
            for at in range(8 // len(signs)):
                one = history("damped", "DBE", 0.001 * at)
                one.attributes |= {"record_checksum": str(at), "record_source": f"{at}.csv{sign}"}
                histories[f"{at}{sign}"] = one
        return verdicts(DRIFT % "most: 1 %, statistic: ec8", histories)[0].statistic

    assert [reported([""]), reported(["; reversed"]), reported(["", "; reversed"])] == ["mean", "mean", "maximum"]


def test_a_force_controlled_column_may_not_turn() -> None:
    one = history("damped", "DBE")
    one.variables["column_axial_force_min"].values[:] = [-2.6e6, -8e5]  # P/P_CL = 2600/4958 = 0.52
    column = member_performance(one, frame_members(frame()), "CP", ("column",))
    assert column is not None
    said = "column C_A_1 is force-controlled (P/P_CL = 0.52) and yields: plastic rotation 2 mrad"
    assert column.of_force == said
    assert column.ratio == pytest.approx(0.002 / 0.001, rel=1e-12)  # of what still counts as elastic
    (table,) = performance_tables([HistorySet("damped", "DBE", {"one": one})], VariantMembers(frame()))[1:]
    assert table.rows[0][8] == f"{said}, one"
    (verdict,) = verdicts("criteria: [{name: c, performance: CP, by: members, of: columns}]", {"damped.DBE.one": one})
    assert (verdict.met, verdict.remark) == (False, said)
    one.variables["column_plastic_rotation_max"].values[:] *= 0.4
    column = member_performance(one, frame_members(frame()), "CP", ("column",))
    assert column is not None and column.of_force == "column C_A_1 is force-controlled (P/P_CL = 0.52) and elastic"


def test_levels_of_other_standards() -> None:
    one = history("damped", "DBE")
    one.variables["column_axial_force_min"].values[:] = [-4.0e6, -8e5]  # P/P_ye = 4000/5822.3 = 0.69
    text = "criteria: [{name: c, standard: %s, performance: %s, of: columns}]"
    histories = {"damped.DBE.one": one}
    (verdict,) = verdicts(text % ("asce41-17", "CP"), histories)
    said = "column C_A_1 is force-controlled (P_G/P_ye = 0.69) and yields: plastic rotation 2 mrad"
    assert (verdict.met, verdict.remark) == (False, said)
    assert verdict.requirement == "Collapse Prevention of ASCE/SEI 41-17 by plastic rotation of columns"
    (verdict,) = verdicts(text % ("en1998-3", "SD"), histories)
    assert verdict.remark.startswith("column C_A_1 has no plastic rotation in Table B.1 (nu = 0.69) and yields")
    # 900 kN of gravity: P_G/P_ye = 0.15458, L/r_y = 53.787, h/t_w = 24.571:
    # b = 7.4*0.84542^2.3/(26.893 + 71.257) - 0.006 = 0.045240
    gravity = Group(dict(one.coords), {}, {"kind": "gravity", "variant": "damped"})
    gravity.add("column_axial_force_final", ("column",), [-9e5, -9e5], "N", "axial force")
    (verdict,) = verdicts(text % ("asce41-17", "CP"), {**histories, "damped.gravity": gravity})
    assert verdict.met and verdict.value == pytest.approx(0.002 / 0.045240, rel=1e-3)
    assert verdict.governing_member == "C_A_1" and verdict.remark == ""


def test_tables_of_other_standards() -> None:
    """A table for each standard that a criterion asks for, with its levels: reached, and motions at each.

    C_A_1 (HEB450, 3.5 m) turns by 2 mrad under 4000 kN, 900 kN of gravity. By ASCE 41 P_G counts:
    a = 0.8 x 0.84542^2.2 / (5.3787 + 19.657) - 0.0035 = 0.01858, IO = a/2 = 9.3 mrad. B_1_1 (IPE450, 6 m) turns
    by 11 mrad, theta_y = 1.6239e-3 x 275e6 x 6 / (6 x 210e9 x 3.2140e-4) = 6.62 mrad: above IO = 1, below LS = 9. By
    EN 1998-3 N counts, nu = 0.69 is above 0.3, and the column has to stay elastic.
    """
    one = history("damped", "DBE")
    one.variables["column_axial_force_min"].values[:] = [-4.0e6, -8e5]
    gravity = Group(dict(one.coords), {}, {"kind": "gravity", "variant": "damped"})
    gravity.add("column_axial_force_final", ("column",), [-9e5, -9e5], "N", "axial force")
    asked = part("criteria: [{name: a, standard: asce41-17, performance: CP}, {name: b, performance: CP}]").criteria
    sets, members = [HistorySet("damped", "DBE", {"one": one})], VariantMembers(frame())
    *_, fema, asce = performance_tables(sets, members, asked, {"damped.gravity": gravity})
    assert (fema.name, asce.name) == ("performance_by_rotation", "performance_by_rotation_asce41")
    asked = part("criteria: [{name: c, standard: en1998-3, performance: NC}]").criteria
    *_, european = performance_tables(sets, members, asked, {"damped.gravity": gravity})
    assert [column.head for column in european.columns[3:7]] == ["DL", "SD", "NC", "beyond"]
    assert european.rows[0][2] == "beyond NC" and european.rows[0][6] == 1
    assert str(european.rows[0][8]).startswith("column C_A_1 has no plastic rotation in Table B.1 (nu = 0.69)")
    found = set_performance(sets[0], with_gravity(members, {"damped.gravity": gravity})("damped"), "mean", "asce41-17")
    assert found.by_drift is None and found.by_members == "LS" == asce.rows[0][2]


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
        ("objective h, by drift", "DBE", False),  # the larger one counts: 2.8 of 2.5 %
        ("objective h, by members", "DBE", True),
        ("objective l, by drift", "MCE", False),
        ("objective l, by members", "MCE", True),
    ]
    assert found[0].value == pytest.approx(1.12, rel=1e-12)
    mean, *_ = verdicts("objectives: [h]", drifts(*6 * [0.02], 0.04))  # of seven the mean, FEMA 356, 3.3.2.2.4
    assert (mean.statistic, mean.met, mean.value) == ("mean", True, pytest.approx(0.16 / 7.0 / 0.025, rel=1e-12))


def test_a_limit_from_below_fails_with_failed_histories() -> None:
    values = {"a": 3.0, "b": 4.0, "c": None}
    assert within("mean", values, (), None, 2.0) is False
    assert within("median", values, (), None, 2.0) is True  # of minus infinity, 3 and 4
    assert within("median", values, (), None, 3.5) is False
    assert within("maximum", values, (), None, 3.5) is True


def test_tables_of_performance_fit_a_page() -> None:
    """By drift and by members apart, each with its own usage, on 80 columns."""
    one = history("modified", "el_centro", 0.03)
    tables = performance_tables([HistorySet("modified", "el_centro", {"one": one})], VariantMembers(frame()))
    stream = io.StringIO()
    print_tables(tables, stream, widest=80)
    assert max(map(len, stream.getvalue().splitlines())) <= 80
    drift, members = (table.texts[0] for table in tables)
    assert drift[:8] == ["modified", "el_centro", "CP", "0", "0", "1", "0", "1/1"] and "transient drift" in drift[8]
    assert members[:8] == ["modified", "el_centro", "LS", "0", "1", "0", "0", "1/1"] and "B_1_1" in members[8]


@pytest.mark.parametrize(
    ("criterion", "said"),
    [
        ("quantity: member_bending_moment, most: 1 kN*m", True),
        ("quantity: member_shear_force, most: 1 kN, members: [B_1_1]", True),
        ("quantity: member_shear_force, most: 1 kN, storeys: 2", False),
        ("quantity: member_bending_moment, most: 1 kN*m, members: [C_A_1]", False),
        ("quantity: column_axial_force, most: 1 kN", False),
        ("measure: beam_plastic_rotation_rad, most: 0.01 rad", True),
        ("measure: interstorey_drift, most: 1 %", False),
        ("plastic_hinges: none", True),
        ("plastic_hinges: none, of: columns", False),
        ("performance: LS, by: members", True),
        ("performance: LS, by: drift", False),
    ],
)
def test_beams_that_miss_the_vertical_motion_are_reported(criterion: str, said: bool) -> None:
    one = history("damped", "DBE")
    one.attributes["beams_without_vertical_motion"] = ["B_1_1"]
    one.coords["member"] = Variable(("member",), np.array(["C_A_1", "B_1_1", "B_1_2"]), "", "name")
    for name in ("member_shear_force_max", "member_shear_force_min", "member_bending_moment_max"):
        one.variables[name] = Variable(("member", "end"), np.zeros((3, 2)), "N", "known")
    one.variables["member_bending_moment_min"] = one.variables["member_bending_moment_max"]
    (found,) = verdicts(f"criteria: [{{name: c, {criterion}}}]", {"damped.DBE.one": one})
    assert ("vertical motion does not bend `B_1_1`" in found.remark) == said
