"""Capacity curves and target displacements of frames whose answers are known in closed form."""

from __future__ import annotations

import math
import re
from pathlib import Path

import numpy as np
import pytest
from unit.study.frames import PORTAL, project, shear_frame

from edesign.archive.dataset import Group
from edesign.frame.frame import build_frame
from edesign.ground_motion.hazard import elastic_spectrum
from edesign.project import Project
from edesign.project.analysis.pushover import GivenPattern
from edesign.study.analysis.lateral_patterns import lateral_loads
from edesign.study.plan.plan import make_plan
from edesign.study.results.warnings import warnings_of
from edesign.study.run.analyses import run_analysis

CASES = Path(__file__).parents[2] / "cases"
HAZARD = """\
hazard:
  code: ec8-2004
  a_gR: @a@
  ground: C
  spectrum: 1
  levels: {DBE: {gamma_I: 1.0}, MCE: {gamma_I: 1.5}}
"""


def results(made: Project) -> dict[str, Group]:
    return {task.name: run_analysis(made, task.spec) for task in make_plan(made)}


def shear(analysis: str, storeys: int) -> Project:
    """A shear frame with a hazard."""
    text = shear_frame("{name: g, kind: gravity}", storeys=storeys).text.replace("{name: g, kind: gravity}", analysis)
    return project(text.replace("analyses:\n", HAZARD.replace("@a@", "0.1 g") + "analyses:\n"))


def portal(acceleration: str, analysis: str) -> Project:
    """The portal of `frames.PORTAL` with 20 t: k = 24 E I / h^3, four hinges of M_p."""
    text = PORTAL.partition("analyses:")[0].replace("mass: 1 t", "mass: 10 t")
    return project(f"{text}{HAZARD.replace('@a@', acceleration)}analyses:\n  - {analysis}\n")


B, D, H, E, FY, MASS = 0.1, 0.2, 4.0, 210e9, 250e6, 20e3
INERTIA = B * D**3 / 12 * (1 - 1 / 16**2)  # of 16 layers
K = 24 * E * INERTIA / H**3
V_P = 4 * FY * B * D**2 / 4 / H
T = 2 * math.pi * math.sqrt(MASS / K)


def test_n2_of_an_elastoplastic_portal() -> None:
    """One mass: Gamma = 1, m* = 20 t. The curve bends at its hinges, so that T* is a little longer than T; at these
    drifts elastic layers near the axis leave 0.4 % of V_P.

    The target and the state follow from what the idealisation gives by Eq. B.10, as T* is below T_C.
    """
    made = portal("1 g", "{name: push, kind: pushover, pattern: uniform, targets: n2, direction: both}")
    found = results(made)
    assert list(found) == [f"push.{way}{target}" for way in ("right", "left") for target in ("", ".n2.DBE", ".n2.MCE")]
    for level, factor in (("DBE", 1.0), ("MCE", 1.5)):
        v = {
            name[3:]: float(x.values) for name, x in found[f"push.right.n2.{level}"].variables.items() if "n2_" in name
        }
        assert (v["Gamma"], v["m"]) == pytest.approx((1.0, MASS))
        assert v["F_y"] == pytest.approx(V_P, rel=0.005)
        assert T < v["T"] < 1.05 * T
        S_e = factor * 9.80665 * 1.15 * 2.5
        q_u, d_et = S_e * MASS / v["F_y"], S_e * (v["T"] / (2 * math.pi)) ** 2
        assert v["S_e"] == pytest.approx(S_e, rel=1e-12)
        assert v["d_t"] == pytest.approx(d_et / q_u * (1 + (q_u - 1) * 0.6 / v["T"]), rel=1e-9)
        state = found[f"push.right.n2.{level}"]
        assert state.attributes["status"] == "completed" and state.attributes["level"] == level
        assert state.variables["roof_displacement"].values[-1] == pytest.approx(v["d_t"], rel=1e-12)
        left = found[f"push.left.n2.{level}"]
        assert left.variables["roof_displacement"].values[-1] == pytest.approx(-v["d_t"], rel=1e-6)
        assert left.variables["n2_d_t"].values == pytest.approx(v["d_t"], rel=1e-6)
    curve = found["push.right"]
    largest = float(found["push.right.n2.MCE"].variables["n2_d_t"].values)
    assert curve.variables["control_displacement"].values[-1] == pytest.approx(1.5 * largest, rel=1e-3)


def test_events_of_the_portal() -> None:
    """The outer layers, centred at 15/16 of half the depth, yield at M_y = fy I / y; hinges rotate by u/h less M/(k h).

    Each event stands in the first step at or after it.
    """
    made = portal("1 g", "{name: push, kind: pushover, pattern: uniform, roof_drift: 6 %, steps: 600}")
    group = results(made)["push"]
    what = group.variables["capacity_event_what"].values.tolist()
    at = dict(zip(what, group.variables["capacity_event_displacement"].values.tolist(), strict=True))
    step = 0.06 * H / 600
    first_yield = 4 * FY * INERTIA / (D / 2 * 15 / 16) / H / K
    assert 0.0 <= at["first yield of a column"] - first_yield < step
    hinge = at["first hinge in a column"]
    shear = np.interp(hinge, group.variables["control_displacement"].values, group.variables["base_shear"].values)
    assert 0.0 <= (hinge - shear / K) / H - 0.001 < 1.01 * step / H
    for name, drift in (("drift of IO, 0.7 %", 0.007), ("drift of LS, 2.5 %", 0.025), ("drift of CP, 5 %", 0.05)):
        assert 0.0 <= at[name] - drift * H < 1.01 * step
    assert "first yield of a beam" not in at  # it is elastic
    assert "largest base shear" not in at  # no descent


@pytest.mark.parametrize("method", ["n2", "fema356", "asce41"])
def test_elastic_frames_move_by_the_spectrum(method: str) -> None:
    """Under the first mode's forces an elastic frame moves in that mode: T* = T_1, d_t = Gamma S_De(T_1), 3 methods.

    1 s divides: above it the coefficients are 1, below it the strength ratio of a frame without strength is near 1.
    """
    made = shear(
        f"{{name: push, kind: pushover, pattern: first_mode, roof_drift: 1 %, targets: {method}, levels: DBE}}", 3
    )
    found = results(made)["push." + method + ".DBE"]
    modes = results(shear_frame("{name: modes, kind: modal, modes: 1}", storeys=3))["modes"]
    period = float(modes.variables["period"].values[0])
    Gamma = float(modes.variables["participation_factor_x"].values[0])
    S_De = float(elastic_spectrum(made.hazard, "DBE").displacement(period))
    assert found.variables[f"{method}_d_t"].values == pytest.approx(Gamma * S_De, rel=1e-5)
    assert found.attributes["status"] == "completed"


def test_storey_shears_of_modes() -> None:
    """Two equal storeys and masses: shapes (1, 1.618) and (1, -0.618), T_2/T_1 = 0.381966; shears by hand."""
    made = shear("{name: g, kind: gravity}", 2)

    modes = results(shear_frame("{name: modes, kind: modal, modes: 2}", storeys=2))["modes"]
    S_e = elastic_spectrum(made.hazard).acceleration(modes.variables["period"].values)
    shapes = np.array([[1.0, 1.6180340], [1.0, -0.6180340]])
    Gamma = shapes.sum(axis=1) / (shapes**2).sum(axis=1)
    forces = (Gamma * S_e)[:, None] * shapes
    base, top = (math.hypot(*x) for x in (forces.sum(axis=1), forces[:, 1]))
    loads = lateral_loads(made, build_frame(made), GivenPattern(modes=2))
    assert loads["A2"] + loads["B2"] == pytest.approx(top / base, rel=1e-5)
    assert sum(loads.values()) == pytest.approx(1.0, rel=1e-12)
    floors = lateral_loads(made, build_frame(made), GivenPattern(floors=(1.0, 3.0)))
    assert [floors[name] for name in ("A1", "B1", "A2", "B2")] == pytest.approx([0.125, 0.125, 0.375, 0.375])
    second = lateral_loads(made, build_frame(made), GivenPattern(mode=2))
    assert second["A1"] / second["A2"] == pytest.approx(-1.6180340, rel=1e-5)


def test_a_target_beyond_the_curve_has_failed() -> None:
    made = portal("1 g", "{name: push, kind: pushover, pattern: uniform, roof_drift: 2 %, targets: [n2, asce41]}")
    found = results(made)
    state = found["push.n2.MCE"].attributes
    assert state["status"] == "failed"
    assert "beyond the end of the capacity curve at 0.08 m" in state["reason"]
    assert float(found["push.n2.MCE"].variables["n2_d_t"].values) > 0.08


def test_a_curve_shorter_than_150_per_cent_is_reported() -> None:
    made = portal("0.5 g", "{name: push, kind: pushover, pattern: uniform, roof_drift: 2 %, targets: n2, levels: DBE}")
    state = results(made)["push.n2.DBE"]
    assert state.attributes["status"] == "completed"
    assert [warning["kind"] for warning in state.attributes["warnings"]] == ["target_range"]


def test_the_descent_of_a_mechanism_under_p_delta() -> None:
    """A hall on pinned columns whose beams have hinged: V falls by P / h at last.

    alpha_2 is the slope from the peak to 60 % of V_y, and a little less steep: near the peak hinges still form.
    FEMA 356 has its own alpha, up to the target.
    """
    text = (CASES / "p_delta_past_peak" / "project.yaml").read_text(encoding="utf-8")
    hazard = HAZARD.replace("@a@", "0.4 g")
    push = (
        "  - {name: push, kind: pushover, pattern: uniform, roof_drift: 8 %, targets: [asce41, fema356], levels: MCE}\n"
    )
    found = results(project(f"{text.partition('analyses:')[0]}{hazard}analyses:\n{push}"))
    v = {name: float(x.values) for name, x in found["push.asce41.MCE"].variables.items() if name.startswith("asce41_")}
    P, h = 2 * (250e3 + 0.3 * 100e3) + 2 * (500e3 + 0.3 * 200e3), 6.0
    d, V = (found["push"].variables[name].values for name in ("control_displacement", "base_shear"))
    assert (V[-1] - V[-20]) / (d[-1] - d[-20]) == pytest.approx(-P / h, rel=0.005)
    slope, peak = v["asce41_alpha_2"] * v["asce41_K_e"], int(np.argmax(V))
    level = 0.6 * v["asce41_V_y"]
    down = np.interp(-level, -V[peak:], d[peak:])
    assert slope == pytest.approx((level - V[peak]) / (down - d[peak]), rel=1e-6)
    assert -P / h < slope < -0.9 * P / h
    # of one storey the loads take P / h whatever yields; S_X1 = 0.4 x 1.5 x 1.15 x 2.5 x 0.6 = 1.03 g is near a fault
    assert v["asce41_alpha_PDelta"] * v["asce41_K_e"] == pytest.approx(-P / h, rel=1e-4)
    assert v["asce41_lambda"] == 0.8
    alpha_e = v["asce41_alpha_PDelta"] + 0.8 * (v["asce41_alpha_2"] - v["asce41_alpha_PDelta"])
    assert v["asce41_alpha_e"] == pytest.approx(alpha_e, rel=1e-12)
    exponent = 1 + 0.15 * math.log(v["asce41_T_e"])
    expected = v["asce41_D_d"] / v["asce41_D_y"] + abs(alpha_e) ** -exponent / 4
    assert v["asce41_mu_max"] == pytest.approx(expected)
    old = found["push.fema356.MCE"].variables
    assert float(old["fema356_alpha"].values) < 0.0 and float(old["fema356_C_3"].values) > 1.0
    events = found["push"].variables["capacity_event_what"].values.tolist()
    assert "largest base shear" in events


@pytest.mark.parametrize(("acceleration", "factor"), [("0.55 g", 0.8), ("0.2 g", 0.2)])
def test_a_strength_limit_where_members_lose_strength(acceleration: str, factor: float) -> None:
    """Hinges that fall faster than the loads alone: lambda decides how much of it counts; S_X1 is 1.42 g and 0.52 g.

    alpha_PDelta is what a frame whose columns know no second order resists more, over the same descent. Its drifts
    differ a little, so that its hinges have not deteriorated by the same: 1 %. Without second order it is not known.
    """
    text = (CASES / "deteriorating_hinges" / "project.yaml").read_text(encoding="utf-8").partition("records:")[0]
    text = text.replace("theta_pc: 0.12 rad", "theta_pc: 0.03 rad").replace("G: 22 kN/m", "G: 90 kN/m")
    push = "  - {name: push, kind: pushover, pattern: uniform, roof_drift: 7.5 %, targets: asce41, levels: MCE}\n"
    text = f"{text}{HAZARD.replace('@a@', acceleration)}analyses:\n{push}"
    found, linear = results(project(text)), results(project(f"elements: {{geometry: {{columns: linear}}}}\n{text}"))
    state = found["push.asce41.MCE"]
    v = {name[7:]: float(x.values) for name, x in state.variables.items() if name.startswith("asce41_")}
    assert v["lambda"] == factor
    (d, V), (d_linear, V_linear) = (
        [of["push"].variables[name].values for name in ("control_displacement", "base_shear")] for of in (found, linear)
    )
    peak = int(np.argmax(V))
    last = float(np.interp(-0.6 * v["V_y"], -V[peak:], d[peak:]))
    more = np.interp([d[peak], last], d_linear, V_linear) - np.interp([d[peak], last], d, V)
    assert v["alpha_PDelta"] * v["K_e"] == pytest.approx(-(more[1] - more[0]) / (last - d[peak]), rel=0.01)
    alpha_e = v["alpha_PDelta"] + factor * (v["alpha_2"] - v["alpha_PDelta"])
    assert v["alpha_2"] < v["alpha_e"] < v["alpha_PDelta"] < 0.0 and v["alpha_e"] == pytest.approx(alpha_e, rel=1e-12)
    kinds = [warning["kind"] for warning in state.attributes.get("warnings", [])]
    assert ("target_strength" in kinds) == (v["mu_strength"] > v["mu_max"]) == (factor == 0.8)
    without = linear["push.asce41.MCE"].variables
    assert math.isnan(without["asce41_alpha_PDelta"].values)
    assert without["asce41_alpha_e"].values == without["asce41_alpha_2"].values


@pytest.mark.parametrize(("last", "factor"), [("0.8 s", 0.8), ("4 s", 0.2)])
def test_the_near_fault_factor_of_a_table(last: str, factor: float) -> None:
    """A table of 2 % damping has no ordinates of 5 %; one that ends at 0.8 s with 0.7 g gives that for 1 s.

    The other one goes on to 0.56 g at 1 s.
    """
    periods, accelerations = "0 s, 0.1 s, 0.5 s, 0.8 s", "0.4 g, 1.0 g, 1.0 g, 0.7 g"
    if last == "4 s":
        periods, accelerations = f"{periods}, 1 s, 4 s", f"{accelerations}, 0.56 g, 0.1 g"
    push = "{name: push, kind: pushover, pattern: uniform, roof_drift: 5 %, targets: asce41, site_class: D}"
    made = portal("1 g", push)
    head, _, rest = made.text.partition("hazard:\n")
    table = (
        "hazard:\n  code: user\n  damping: 2 %\n  criteria: asce7-22\n"
        f"  levels: {{MCE: {{spectrum: {{periods: [{periods}], accelerations: [{accelerations}]}}}}}}\n"
    )
    found = results(project(f"{head}{table}analyses:{rest.partition('analyses:')[2]}"))["push.asce41.MCE"]
    assert found.variables["asce41_lambda"].values == factor
    assert math.isnan(found.variables["asce41_alpha_e"].values)  # an elastoplastic portal has no descent


DEVICES = {
    "metal": "{type: elastic_plastic, parameters: {k: 2 kN/mm, Fy: 10 kN, b: 1 %}}",
    "stop": "{type: gap, parameters: {k: 1 kN/mm, gap: 30 mm}}",
    "rubber": "{type: kelvin_voigt, parameters: {k: 1 kN/mm, c: 100 kN*s/m}}",
}


@pytest.mark.parametrize(
    ("laws", "damping", "said"),
    [
        ("metal", "", ""),
        ("metal stop", "", ""),  # contact without loss depends on the deformation alone
        ("metal", ", damping: 3 %", ""),
        ("metal stop", ", damping: 20 %", "`damping` of 20 % is more than the inherent 5 %"),
        ("rubber", "", "the spectrum does not have the damping of the velocity-dependent dampers; `damping`"),
        ("metal rubber", "", "the velocity-dependent dampers, 1 of 2; `damping`"),
        ("metal rubber", ", damping: 20 %", ""),
    ],
)
def test_work_of_dampers_counts_once(laws: str, damping: str, said: str) -> None:
    """FEMA 356, 9.3.5.1: of displacement-dependent dampers in the capacity curve, of others in the spectrum."""
    push = f"{{name: push, kind: pushover, pattern: uniform, roof_drift: 2 %, targets: n2, levels: DBE{damping}}}"
    hazard = HAZARD.replace("@a@", "0.3 g")
    text = PORTAL.partition("analyses:")[0].replace("mass: 1 t", "mass: 10 t")
    dampers = "dampers:\n  laws:\n" + "".join(f"    {name}: {DEVICES[name]}\n" for name in laws.split())
    dampers += "  devices:\n" + "".join(
        f"    - {{kind: storey, bays: 1, storeys: 1, law: {name}}}\n" for name in laws.split()
    )
    group = results(project(f"{text}{hazard}{dampers}analyses:\n  - {push}\n"))["push.n2.DBE"]
    reported = [warning for warning in warnings_of(group) if warning.kind.startswith("target_damping")]
    assert len(reported) == (said != "")
    assert not reported or said in reported[0].text
    if "20 %" in said:
        first, second = map(float, re.findall(r"([\d.]+) mm", reported[0].text))
        assert first == pytest.approx(1e3 * float(group.variables["n2_d_t"].values), rel=1e-3)
        assert first < second
        alone = results(project(f"{text}{hazard}{dampers}analyses:\n  - {push.replace(damping, '')}\n"))
        expected = 1e3 * float(alone["push.n2.DBE"].variables["n2_d_t"].values)
        assert second == pytest.approx(expected, rel=2e-3)  # of curves in steps of another size


@pytest.mark.parametrize("method", ["fema356", "asce41"])
def test_the_period_has_the_stiffness_of_the_curve(method: str) -> None:
    """K_i has what displacement-dependent dampers are before they yield, and so has T_i: 2 pi sqrt(m / (K + k)).

    A damper that does not yield makes an elastic frame of that period, which moves by S_De.
    """
    k, push = 2e6, f"{{name: push, kind: pushover, pattern: uniform, targets: {method}, levels: DBE, site_class: C}}"
    push = push.replace(", site_class: C", "") if method == "fema356" else push
    text = PORTAL.partition("analyses:")[0].replace("mass: 1 t", "mass: 10 t")
    metal = DEVICES["metal"].replace("Fy: 10 kN", "Fy: 10 MN")
    dampers = f"dampers: {{laws: {{m: {metal}}}, devices: [{{kind: storey, bays: 1, storeys: 1, law: m}}]}}\n"
    group = results(project(f"{text}{HAZARD.replace('@a@', '0.02 g')}{dampers}analyses:\n  - {push}\n"))[
        f"push.{method}.DBE"
    ]
    found = {
        name: float(v.values) for name, v in group.variables.items() if name.startswith(method) and v.values.ndim == 0
    }
    period = 2.0 * math.pi * math.sqrt(MASS / (K + k))
    assert found[f"{method}_T_i"] == pytest.approx(period, rel=1e-5)
    assert found[f"{method}_K_i"] == pytest.approx(K + k, rel=1e-5)
    assert found[f"{method}_d_t"] == pytest.approx(found[f"{method}_S_a"] * (period / (2.0 * math.pi)) ** 2, rel=1e-5)


@pytest.mark.parametrize(("acceleration", "reported"), [("1 g", True), ("0.02 g", False)])
def test_a_limit_of_C_1_is_reported(acceleration: str, reported: bool) -> None:
    """FEMA 440 advises against it: C_1 = (1 + (R - 1) T_S / T_e) / R of a short period; of an elastic frame 1."""
    made = portal(acceleration, "{name: push, kind: pushover, pattern: uniform, targets: fema356, levels: DBE}")
    group = results(made)["push.fema356.DBE"]
    warnings = [warning.text for warning in warnings_of(group) if warning.kind == "target_limit"]
    assert len(warnings) == reported
    if reported:
        R, T_e, C_1 = (float(group.variables[f"fema356_{name}"].values) for name in ("R", "T_e", "C_1"))
        free = (1.0 + (R - 1.0) * 0.6 / T_e) / R
        assert (
            free > C_1 and f"C_1 is {C_1:.3g} by the limit" in warnings[0] and f"and {free:.3g} without" in warnings[0]
        )
