"""What stands at the ends of the members of a building: lengths, places, names, and what cannot be."""

from __future__ import annotations

import re

import numpy as np
import pytest
from building_examples import SMALL, building
from messages import says

from edesign.core import Analysis, Channel
from edesign.errors import InputError
from edesign.exchange.opensees.limits import refuse
from edesign.frame.frame_model import FrameModel
from edesign.frame.panel_zones import panel_of
from edesign.frame.sections.i_shape import plates_of
from edesign.project.building import BuildingError
from edesign.report.building.assumptions import building_assumption_rows
from edesign.space.check import check_building
from edesign.space.nonlinear import build_building
from edesign.space.nonlinear.rigid_ends import rigid_ends
from edesign.study.results.members import plastic_rotation
from edesign.study.results.requested import chord_rotation

HINGE = "{M_y: 100 kN*m, theta_p: 0.02 rad, theta_pc: 0.1 rad, theta_u: 0.2 rad}"
RIGID = ("ends: pinned", "ends: rigid")


def built(*more: str, changes: tuple[tuple[str, str], ...] = (RIGID,)) -> FrameModel:
    return build_building(building(SMALL + "".join(f"{line}\n" for line in more), *changes))


def test_rigid_ends_are_halves_of_depths() -> None:
    """HEB200 with h = b = 200 mm; beams of 300 and 240 mm meet at each node, none at the base."""
    found = rigid_ends(building(SMALL + "elements: {rigid_ends: {columns: 1, beams: 50 %}}\n"))
    assert found["C_A1_1"] == pytest.approx((0.0, 0.15)) and found["C_A1_2"] == pytest.approx((0.15, 0.15))
    assert found["BX_1_1_1"] == found["BY_A_1_1"] == pytest.approx((0.05, 0.05))
    turned = ("section: HEB200, material: S275, strong: x", "section: IPE300, material: S275, strong: y")
    found = rigid_ends(building(SMALL + "elements: {rigid_ends: {beams: 1}}\n", turned))
    assert found["BX_1_1_1"] == pytest.approx((0.075, 0.075)) and found["BY_A_1_1"] == pytest.approx((0.15, 0.15))
    assert "C_A1_1" not in found


def test_the_middle_of_a_beam_that_braces_meet_is_free() -> None:
    chevron = ("kind: cross", "kind: chevron"), ("concentric_diagonal", "concentric_v")
    found = rigid_ends(building(SMALL + "elements: {rigid_ends: {beams: 0.1 m}}\n", *chevron))
    assert found["BY_A_1_1_1"] == (0.1, 0.0) and found["BY_A_1_1_2"] == (0.0, 0.1)


def test_rigid_ends_that_leave_nothing_are_refused() -> None:
    with pytest.raises(InputError, match=r":\d+:\d+: elements.rigid_ends: .*BX_1_2_1.*E-HINGE-05"):
        built("elements: {rigid_ends: {beams: 2 m}}")


def test_springs_have_the_names_of_their_members() -> None:
    frame = built(
        f"hinges: [{{beams: {{along: x, frames: 2, floors: 1}}, parameters: {HINGE}}}]",
        "joints: [{columns: {at: A1, storeys: 1}, ends: start, stiffness: 20 MN*m/rad}]",
    )
    hinged, joined = frame.members["BX_2_1_1"], frame.members["C_A1_1"]
    assert [spring.kind for end in hinged.springs for spring in end] == ["hinge", "hinge"]
    assert hinged.fibres is None and hinged.yields
    assert [len(end) for end in joined.springs] == [1, 0] and joined.fibres is not None
    assert not frame.members["BX_1_1_1"].springs[0] and not frame.members["BY_A_1_1"].springs[0]
    assert frame.model.element_names.count("BX_2_1_1.start.hinge") == 1
    assert joined.springs[0][0].of_member == pytest.approx(210e9 * 5696e-8 / 4.0, rel=1e-3)  # HEB200


def test_a_support_feels_what_stands_on_a_joint() -> None:
    """Reactions of a fixed base whose column turns on a joint: about y the spring's moment, else the column's."""
    more = "joints: [{columns: {at: all, storeys: 1}, ends: start, stiffness: 20 MN*m/rad}]"
    frame = built(more, changes=(RIGID, ("spans: x}]\n", "spans: x}]\n  self_weight: false\n")))
    column = frame.members["C_B2_1"]
    channels = [Channel(str(d), frame.reaction("B2.0", d)) for d in range(6)]
    channels += [Channel(f"c{d}", ((1.0, "global_force", column.element, d),)) for d in range(6)]
    run = Analysis(frame.model, tolerance=1e-12).static(frame.gravity, 1.0, 5, channels)
    found, forces = ([run.final[f"{name}{d}"] for d in range(6)] for name in ("", "c"))
    assert found == pytest.approx(forces, abs=1e-6 * np.abs(forces).max())
    assert max(map(abs, forces[3:])) > 1.0


def test_panels_shear_where_columns_bend_about_their_strong_axis() -> None:
    """By Krawinkler's model of the column and the beams along its strong axis; other joints have none."""
    frame = built("panel_zones: [{at: [A1, B2], floors: 1, doubler: 5 mm}]")
    column = plates_of("HEB200", {})
    assert column is not None and set(frame.panels) == {"A1.1", "B2.1"}
    assert frame.panels["A1.1"].panel == panel_of(0.3, column, 5e-3, 210e9, 275e6, 0.03)
    assert frame.members["C_A1_1"].stretches.arms == (0.0, 0.15)
    assert frame.members["BX_1_1_1"].stretches.arms == (0.1, 0.0)
    assert frame.members["BY_A_1_1"].stretches.arms == (0.0, 0.0)


def test_panels_stand_in_a_building_on_footings() -> None:
    """Beams end at rigid floors beside their panels, and dashpots under the columns; reactions of springs sum up."""
    more = (
        "panel_zones: [{floors: 1}]",
        "soils: {clay: {density: 1900 kg/m^3, shear_wave_velocity: 180 m/s, poisson: 0.45, damping: 5 %}}",
        "supports: {default: {uz: 500 MN/m}, A: {footing: {soil: clay, length: 2 m, width: 2 m, thickness: 0.5 m}}}",
    )
    frame = built(*more)
    assert frame.panels and len(frame.footings) == 3
    up = Channel("up", tuple(term for name in frame.supports for term in frame.reaction(name, 2)))
    final = Analysis(frame.model).static(frame.gravity, 1.0, 5, [up]).final
    assert final["up"] == pytest.approx(frame.sinking.loads + 3 * 2.0 * 2.0 * 0.5 * 2500.0 * 9.80665, rel=1e-6)


@pytest.mark.parametrize(
    ("more", "said"),
    [  # `@` marks the place that is named
        ("hinges: [@{parameters: lignos_krawinkler_2011}]", "hinges[0] `beams` `columns` E-KEY-03"),
        ("hinges: [{beams: {along: x, floors: @3}, parameters: lignos_krawinkler_2011}]", "E-NAME-01"),
        ("hinges: [@{beams: {along: y}, parameters: lignos_krawinkler_2011}]", "BY_A_1_1 `ends` E-FRAME-05"),
        ("hinges: [{columns: {at: A1}, parameters: @lignos_krawinkler_2011}]", "hinges[0].parameters E-KEY-03"),
        ("joints: [{columns: {at: @D1}, stiffness: 20 MN*m/rad}]", "joints[0].columns.at C3 E-NAME-01"),
        (
            "elements: {rigid_ends: {beams: 1}}\njoints: [{@beams: {along: x}, stiffness: 20 MN*m/rad}]",
            "joints[0].beams E-KEY-03",
        ),
        ("elements: {rigid_ends: {beams: 1}}\npanel_zones: [@{floors: 1}]", "panel_zones[0] E-KEY-03"),
        ("panel_zones: [{floors: @3}]", "panel_zones[0].floors E-NAME-01"),
    ],
)
def test_what_cannot_stand_at_an_end(more: str, said: str) -> None:
    text = f"{SMALL}{more}\n"
    before = text[: text.index("@")]
    with pytest.raises(BuildingError) as caught:
        building(text.replace("@", ""))
    (problem,) = caught.value.problems
    assert (problem.mark.line, problem.mark.column) == (before.count("\n") + 1, len(before) - before.rfind("\n"))
    assert says(str(problem), said)


def test_the_report_says_what_ends_do() -> None:
    more = f"hinges: [{{beams: {{along: x}}, parameters: {HINGE}}}]\npanel_zones: [{{floors: 1}}]\n"
    whole = building(
        SMALL + more + "analyses: [{name: gravity, kind: gravity}]\n", ("ends: pinned", "ends: 9 MN*m/rad")
    )
    said = dict(building_assumption_rows(whole))["Ends of members in analyses"]
    assert [word in said for word in ("rigid ends", "Joints", "Plastic hinges", "Panel zones")] == [
        False,
        True,
        True,
        True,
    ]
    assert "Ends of members in analyses" not in dict(building_assumption_rows(building(SMALL + more)))


def test_a_beam_has_joints_or_ends_with_a_stiffness() -> None:
    soft = ("ends: pinned", "ends: 20 MN*m/rad")
    with pytest.raises(BuildingError) as caught:
        building(SMALL + "joints: [{beams: {along: y}, stiffness: 20 MN*m/rad}]\n", soft)
    assert re.search(r"joints\[0\].beams: BY_A_1_1 .*`beams: ends`.*E-FRAME-05", str(caught.value))


def test_panels_of_tubes_are_refused() -> None:
    tubes = ("section: HEB200", "section: SHS200x10")
    with pytest.raises(InputError, match=r":\d+:\d+: the joint A1.1 .*E-HINGE-04"):
        built("panel_zones: [{floors: 1}]", changes=(RIGID, tubes))
    with pytest.raises(InputError, match=r":\d+:\d+: the joint A1.1 .*E-HINGE-04"):
        check_building(building(SMALL + "panel_zones: [{floors: 1}]\n", tubes))


@pytest.mark.parametrize("distance", ["", ", distance: 0.4 m"])
def test_rotations_of_members_with_hinges(distance: str) -> None:
    """Hinges at rest leave a plain member, whose chord rotations about both axes are its deformations."""
    more = f"hinges: [{{beams: {{along: x, floors: 1}}{distance}, parameters: {HINGE}}}]"
    elastic = ("S275: {fy: 275 MPa}", "S275: {fy: 275 MPa, law: elastic}")
    hinged, plain = built(more, changes=(RIGID, elastic)), built(changes=(RIGID, elastic))
    found = [_rotations(frame) for frame in (hinged, plain)]
    assert found[0] == pytest.approx(found[1], abs=1e-7 * max(map(abs, found[1])))
    member = hinged.members["BX_2_1_1"]
    about_y, about_z = member.bending
    assert plastic_rotation(member, 0, about_y) and not plastic_rotation(member, 0, about_z)


def _rotations(frame: FrameModel) -> list[float]:
    """Chord rotations of a beam at both ends about y and z under gravity and a push along x and y."""
    member, push = frame.members["BX_2_1_1"], frame.model.pattern()
    frame.model.nodal_load(push, frame.nodes["A1.1"], 2e4, 1e4, fz=-2e4)
    channels = [
        Channel(f"{end}{bending.axis}", chord_rotation(frame, member, end, bending))
        for end in (0, 1)
        for bending in member.bending
    ]
    analysis = Analysis(frame.model, tolerance=1e-12)
    analysis.static(frame.gravity, 0.2)
    return list(analysis.static(push, channels=channels).final.values())


@pytest.mark.parametrize(
    ("more", "keys"),
    [
        (f"hinges: [{{columns: {{at: A1}}, parameters: {HINGE}}}]", "hinges[0]"),
        ("joints: [{beams: {along: x}, stiffness: 20 MN*m/rad}]", "joints[0]"),
        ("panel_zones: [{floors: 1}]", "panel_zones[0]"),
        ("", "beams[1].ends"),
    ],
)
def test_springs_are_not_translated_for_opensees(more: str, keys: str) -> None:
    soft = () if more else (("ends: pinned", "ends: 20 MN*m/rad"),)
    with pytest.raises(InputError, match=rf":\d+:\d+: {re.escape(keys)}: .*E-OPS-06"):
        refuse(building(f"{SMALL}{more}\n", *soft), without_dampers=False)
