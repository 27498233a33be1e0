"""The case with hinges against its backbones, worked out here from the project file."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

from edesign.archive.dataset import Group

Results = Callable[[str, str], Group]
CASE = "deteriorating_hinges"
E = 210e9  # Pa

# IPE 400 of three rectangles, less two cuts of 40 mm in each flange; 275 MPa; Lignos & Krawinkler 2011: M_y = 1.06 M_p
REDUCED_MODULUS = 0.180 * 0.0135 * 0.3865 + 0.0086 * 0.373**2 / 4.0 - 2.0 * 0.040 * 0.0135 * 0.3865  # m3
REDUCED = 1.06 * REDUCED_MODULUS * 275e6


def values(group: Group, name: str) -> dict[str, float]:
    """Values of a variable of hinges by the names of these."""
    return dict(zip(group.coords["hinge"].values.tolist(), group.variables[name].values.tolist(), strict=True))


def test_hinges_are_those_of_the_project(results_of: Results) -> None:
    """Names, yield moments by hand, and theta_p of the reduced beams by the regression with the numbers put in."""
    group = results_of(CASE, "push")
    moments, plastic = values(group, "hinge_M_y"), values(group, "hinge_theta_p")
    assert list(moments) == ["C_A_1:start", "C_B_1:start", "B_1_1:start", "B_1_1:end", "B_1_2:start", "B_1_2:end"]
    expected = [620e3, 620e3, REDUCED, REDUCED, 400e3, 400e3]
    assert list(moments.values()) == pytest.approx(expected, rel=1e-9)
    # h / t_w with fillets of 21 mm, b_f / 2 t_f, L_b / r_y = 0.086 E / f_y, half the length between the hinges / d
    web, flange, lateral = (400.0 - 27.0 - 42.0) / 8.6, 180.0 / 27.0, 0.086 * 210e9 / 275e6
    span = 0.5 * (7.0 - 2.0 * (0.16 + 0.1 + 0.15)) / 0.4  # from the columns' faces
    theta_p = 0.19 * web**-0.314 * flange**-0.1 * lateral**-0.185 * span**0.113
    theta_p *= (400.0 / 533.0) ** -0.76 * (275.0 / 355.0) ** -0.07
    assert plastic["B_1_1:end"] == pytest.approx(theta_p, rel=1e-9)


def test_pushed_hinges_lie_on_their_backbones(results_of: Results) -> None:
    """Moment at the end of the pushover from the rotation there; those pushed one way only do not deteriorate."""
    group = results_of(CASE, "push")
    rotation, moment, stiffness = (
        values(group, f"hinge_{name}") for name in ("rotation_final", "moment_final", "stiffness")
    )
    sagging = {"C_A_1:start": (620e3, 1.1, 0.02), "B_1_2:start": (400e3, 1.1, 0.03)}
    hogging = {"B_1_2:end": (330e3, 1.1, 0.02)}
    beams = {f"B_1_1:{end}": (REDUCED, 1.09, values(group, "hinge_theta_p")["B_1_1:end"]) for end in ("start", "end")}
    checked = 0
    for name, (M_y, capped, theta_p) in {**sagging, **hogging, **beams}.items():
        turned = abs(rotation[name]) - M_y / stiffness[name]
        if turned <= 0.0:
            continue
        theta_pc = values(group, "hinge_theta_pc")[name]
        hardening = M_y * (1.0 + (capped - 1.0) * turned / theta_p)
        softening = capped * M_y * (1.0 - (turned - theta_p) / theta_pc)
        expected = max(min(hardening, softening), 0.4 * M_y)
        assert abs(moment[name]) == pytest.approx(expected, rel=1e-6), name
        checked += 1
    assert checked >= 4
    assert max(abs(rotation[f"B_1_1:{end}"]) for end in ("start", "end")) > 0.04  # beyond capping


def test_joint_and_spring_under_the_column(results_of: Results) -> None:
    """The joint's moment is that of the beam's end, on the line of its stiffness or beyond its resistance."""
    group = results_of(CASE, "push")
    moment, rotation = (float(group.variables[f"joint_{name}_final"].values[0]) for name in ("moment", "rotation"))
    expected = rotation * 90e6
    if abs(expected) > 300e3:
        expected = np.sign(rotation) * (300e3 + 0.01 * (abs(expected) - 300e3))
    assert moment == pytest.approx(expected, rel=1e-9)
    assert moment == pytest.approx(values(group, "hinge_moment_final")["B_1_2:end"], rel=1e-7)
    at_bases = group.variables["support_reaction_moment_final"].values
    turned = group.variables["support_rotation_final"].values
    assert at_bases[0] == pytest.approx(-120e6 * turned[0], rel=1e-6)
    assert abs(at_bases[1]) <= 500e3 * (1.0 + 1e-9)


def test_panels_lie_on_their_lines(results_of: Results) -> None:
    """Panels of HEB 320 and IPE 400 with 6 mm of doubler plate, pushed to a moment on their three lines."""
    group = results_of(CASE, "push")
    moments, turned = (group.variables[f"panel_{name}_final"].values for name in ("moment", "distortion"))
    area = 0.95 * 0.320 * (0.0115 + 0.006)
    K, M_y = area * E / 2.6 * 0.4, area * 355e6 / 3.0**0.5 * 0.4
    M_p = M_y * (1.0 + 3.0 * 0.300 * 0.0205**2 / (0.4 * 0.320 * 0.0175))
    line = np.interp(np.abs(turned) * K / M_y, [0.0, 1.0, 4.0, 104.0], [0.0, M_y, M_p, M_p + 3.0 * M_y])
    np.testing.assert_allclose(np.abs(moments), line, rtol=1e-6)


def test_shaken_hinges_deteriorate_within_their_bounds(results_of: Results) -> None:
    """Moments stay below those at capping, what is left of the strength falls, and the balance of energy closes."""
    group = results_of(CASE, "shake")
    left = values(group, "hinge_strength_left_final")
    assert min(left.values()) < 0.9 and max(left.values()) <= 1.0
    M_y = values(group, "hinge_M_y")
    for which in ("max", "min"):
        for name, moment in values(group, f"hinge_moment_{which}").items():
            assert abs(moment) <= (1.09 if name.startswith("B_1_1") else 1.1) * M_y[name] * (1.0 + 1e-9)
    assert abs(group.variables["energy_final"].values[-1]) < 5e-3 * group.variables["energy_final"].values[0]
    energy = group.variables["energy_final"].values
    assert energy[4] > 0.3 * energy[0]  # hysteretic, of the input


def test_events_of_the_capacity_curve_name_hinges(results_of: Results) -> None:
    """The first yield of a beam is that of a hinge or joint, in the first step in which one has turned plastically."""
    group = results_of(CASE, "push")
    what = group.variables["capacity_event_what"].values.tolist()
    first = what.index("first yield of a beam")
    step = int(group.variables["capacity_event_step"].values[first])
    place = str(group.variables["capacity_event_place"].values[first])
    member = group.coords["recorded_member"].values.tolist().index(place)
    plastic = np.abs(group.variables["member_plastic_rotation"].values[:, member]).max(axis=1)
    assert plastic[step] > 1e-8 and np.max(plastic[:step]) < 1e-8
