"""Histories of one record at several angles, and with masses at several places, are one motion: the worst counts."""

from __future__ import annotations

from types import SimpleNamespace
from typing import cast

import numpy as np
import pytest
from building_examples import SMALL, building
from unit.assess.assessed import history, part

from edesign.archive.dataset import Group, Variable
from edesign.assess.acceptance import ELASTIC_ROTATION
from edesign.assess.members import frame_members, member_usages
from edesign.assess.performance import member_performance, set_performance
from edesign.assess.sets import history_sets, measure_statistics
from edesign.assess.verdicts import Verdict, judge
from edesign.codes.ec8.action.accelerograms import SET_RULES
from edesign.frame.devices import Device
from edesign.report.inputs.damper_demand import demand
from edesign.report.response.torsion_tables import torsion_tables

DRIFTS = {
    "bare.DBE.a.0deg.0": 0.004,
    "bare.DBE.a.0deg.+x+y": 0.010,
    "bare.DBE.a.90deg.0": 0.006,
    "bare.DBE.a.90deg.+x+y": 0.008,
    "bare.DBE.b.0deg.0": 0.006,
    "bare.DBE.b.0deg.+x+y": 0.005,
    "bare.DBE.b.90deg.0": 0.002,
    "bare.DBE.b.90deg.+x+y": 0.004,
}


def histories(**status: str) -> dict[str, Group]:
    """Two records at two angles and two places of the masses; by name what is not completed."""
    found = {}
    for name, drift in DRIFTS.items():
        _, _, record, angle, place = name.split(".")
        about = {"record": f"pairs/{record}", "angle_deg": float(angle[:-3]), "eccentricity": place}
        state = status.get(name.replace(".", "_").replace("+", ""), "completed")
        about = {} if state == "not run" else about
        found[name] = history("bare", "DBE", drift, status=state, **about)
    return found


def verdict(limits: str, groups: dict[str, Group]) -> Verdict:
    criteria = part(f"criteria: [{{name: d, measure: interstorey_drift, levels: DBE, {limits}}}]").criteria
    (found,) = judge(criteria, (), groups, building(SMALL))
    return found


def test_the_statistic_is_over_the_worst_of_each_motion() -> None:
    (of_one_level,) = history_sets(histories())
    assert of_one_level.motions == 2 and set(of_one_level.motion_of.values()) == {
        "bare.DBE.a.0deg.0",
        "bare.DBE.b.0deg.0",
    }
    found = verdict("most: 0.85 %, statistic: mean", histories())
    assert found.value == pytest.approx(0.008, rel=1e-14)  # the mean of 1.0 and 0.6 %; of all eight it is 0.56 %
    assert (found.met, found.count, found.motions, found.governing_history) == (True, 8, 2, "bare.DBE.a.0deg.+x+y")
    assert measure_statistics(of_one_level)["interstorey_drift"].mean == pytest.approx(0.008, rel=1e-14)
    least = verdict("least: 0.3 %, statistic: mean", histories())
    assert (least.value, least.met) == (pytest.approx(0.003), True)  # the mean of 0.4 and 0.2 %
    half = verdict("most: 0.7 %, share: 50 %", histories())
    assert (half.value, half.met) == (0.5, True)
    assert verdict("most: 0.7 %, statistic: ec8", histories()).statistic == "maximum"  # two motions, not eight


def test_dampers_are_asked_for_by_the_worst_of_each_motion() -> None:
    """Eight histories of two motions are two: the largest counts, and the mean is that of 10 and 6 mm."""
    groups = histories()
    for name, group in groups.items():
        group.coords["damper"] = Variable(("damper",), np.array(["VX_1_1_1"]), "", "")
        group.add("damper_deformation_max", ("damper",), np.array([DRIFTS[name]]), "m", "")
        group.add("damper_deformation_min", ("damper",), np.array([0.0]), "m", "")
    (of_one_level,) = history_sets(groups)
    device = cast(Device, SimpleNamespace(name="VX_1_1_1"))
    found = demand(of_one_level, [device], "damper_deformation")
    assert found is not None and (found.count, found.maximum) == (2, 0.010)
    assert found.mean == pytest.approx(0.008, rel=1e-14) and found.governing(SET_RULES) == 0.010


def test_torsion_is_that_of_the_worst_of_each_motion() -> None:
    """Line A1 has the drift of the history, line B1 a half of it, along x alone."""
    groups = histories()
    for name, group in groups.items():
        drift = np.array([[DRIFTS[name], 0.0], [DRIFTS[name] / 2.0, 0.0]])
        for coordinate, values in {"storey": [1], "direction": ["x", "y"], "drift_line": ["A1.1", "B1.1"]}.items():
            group.coords[coordinate] = Variable((coordinate,), np.array(values), "", "")
        group.add("drift_line_storey", ("drift_line",), np.array([1, 1]), "", "")
        group.add("line_drift_max", ("drift_line", "direction"), drift, "1", "")
        group.add("line_drift_min", ("drift_line", "direction"), 0.0 * drift, "1", "")
    (table,) = torsion_tables(history_sets(groups))
    along_x, along_y = table.texts
    assert along_x[2:6] == ["0.4000", "0.8000", "A1", "1.33"]  # the mean of 1.0 and 0.6 %
    assert along_y[2:4] == ["0", "0"] and "worst" in table.notes[0]


def test_failed_and_waiting_histories_decide_for_their_motion() -> None:
    failed = verdict("most: 2 %, statistic: median", histories(bare_DBE_b_90deg_0="failed"))
    assert failed.met is False  # one of two motions failed
    waiting = verdict("most: 0.85 %, statistic: mean", histories(bare_DBE_b_90deg_xy="not run"))
    assert (waiting.met, waiting.missing) == (None, ("bare.DBE.b.90deg.+x+y",))
    settled = verdict("most: 0.9 %, statistic: maximum", histories(bare_DBE_b_90deg_xy="not run"))
    assert settled.met is False
    (found,) = history_sets(histories(bare_DBE_b_90deg_xy="not run"))
    assert len(set(found.motion_of.values())) == 2


def test_levels_are_counted_by_motion() -> None:
    (found,) = history_sets(histories())
    performance = set_performance(found, {})
    # IO up to 0.7 %, LS to 2.5 % (FEMA 356, Table C1-3): the worst of the motions are 1.0 and 0.6 %
    assert performance.drift_counts == {"IO": 1, "LS": 1, "CP": 0, "beyond CP": 0}
    assert performance.worst_drift is not None and performance.worst_drift[0] == "bare.DBE.a.0deg.+x+y"


def test_histories_without_a_variant_are_told_apart_by_more_than_angle_and_place() -> None:
    groups = {}
    for scale in ("weak", "strong"):
        for name, group in histories().items():
            own = name.replace("bare.DBE", scale)
            groups[own] = Group(group.coords, group.variables, {**group.attributes, "variant": "", "level": ""})
    found = {one.variant: list(one.histories) for one in history_sets(groups)}
    assert set(found) == {"weak", "strong"} and [len(names) for names in found.values()] == [8, 8]
    alone = {name: group for name, group in groups.items() if name.startswith("weak")}
    assert [one.variant for one in history_sets(alone)] == [""]


def rotating(strong: float, weak: float, compression: float) -> Group:
    """A history of one column, with plastic rotations about both axes."""
    group = Group()
    for name, labels in (("column", ["C_A1_1"]), ("end", ["start", "end"]), ("axis", ["y", "z"])):
        group.coords[name] = Variable((name,), np.array(labels), "", name)
    rotations = np.array([[[0.0, weak], [strong, 0.0]]])
    group.add("column_plastic_rotation_max", ("column", "end", "axis"), rotations, "rad", "largest")
    group.add("column_plastic_rotation_min", ("column", "end", "axis"), 0.0 * rotations, "rad", "smallest")
    group.add("column_axial_force_min", ("column",), [-compression], "N", "smallest")
    group.attributes |= {"kind": "history", "status": "completed", "variant": "bare", "level": "DBE"}
    return group


def test_rotations_about_the_weak_axis_are_shown_and_not_judged() -> None:
    members = frame_members(building(SMALL))
    assert {member.kind for member in members.values()} == {"column", "beam"}  # braces are tubes, and no beams
    usages = member_usages(rotating(0.004, 0.03, 1e5), members, "LS")
    assert usages is not None
    (found,) = usages
    assert (found.rotation, found.axis, found.other) == (0.004, "y", 0.03)
    performance = member_performance(rotating(0.004, 0.03, 1e5), members, "LS")
    assert performance is not None and performance.not_judged == (0.03, "C_A1_1")
    criteria = part("criteria: [{name: p, performance: LS, by: members}]").criteria
    (verdict,) = judge(criteria, (), {"h": rotating(0.004, 0.03, 1e5)}, building(SMALL))
    assert verdict.place == "C_A1_1, about y"
    assert verdict.remark == "rotations about weak axes, up to 30 mrad (C_A1_1), are not judged: no limit is known"
    (verdict,) = judge(criteria, (), {"h": rotating(0.004, 0.0005, 1e5)}, building(SMALL))
    assert verdict.remark == ""


def test_a_force_controlled_column_stays_elastic_about_both_axes() -> None:
    """FEMA 356, 5.5.2.4.2: above half of P_CL flexure is force-controlled, about either axis."""
    members = frame_members(building(SMALL))
    compression = 0.6 * members["C_A1_1"].strength
    usages = member_usages(rotating(0.0002, 0.002, compression), members, "CP")
    assert usages is not None
    (found,) = usages
    assert (found.axis, found.allowed, found.rotation) == ("z", ELASTIC_ROTATION, 0.002)
    assert found.ratio == pytest.approx(2.0)
