"""Braces, connections and factored forces of dampers against hand calculations, a printed example and reactions.

References: Gardner & Nethercot, Designers' Guide to EN 1993-1-1, Example 6.7 (CHS 244.5 x 10, S355, 4 m: 2297 kN);
statics of a chevron; F = c v^alpha; EN 1993-1-1, 6.3.1, written out; reactions of the frame in the core.
"""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest
from design_examples import LAWS, design, refusal, shear_project

from edesign.archive.dataset import Group
from edesign.codes.device_factors import DEVICE_FACTORS, DeviceFactors, factors_of_code
from edesign.core import Analysis, Channel, LawValues
from edesign.damper.factored import force_ratio
from edesign.errors import InputError
from edesign.frame.sections.profiles import profile_names
from edesign.frame.sections.steel_section import steel_section
from edesign.project import Project, parse_project
from edesign.project.dampers.dampers import BraceSection, DamperRun
from edesign.report.inputs.connections import Connection, connections_of
from edesign.study.analysis.structure import make_frame
from edesign.study.design.design import DesignResult, run_design

E, FY = 210e9, 355e6
FRAME = """\
edesign: 1
title: One bay of 4.8 m, one storey of 3.2 m
frame:
  bays: [4.8 m]
  storeys: [3.2 m]
  columns: [{storeys: all, section: HEB200, material: S355}]
  beams: [{floors: all, section: IPE300, material: S355}]
  diaphragms: all
materials:
  S355: {law: bilinear, E: 210 GPa, fy: 355 MPa}
  elastic: {law: elastic, E: 210 GPa}
elements: {geometry: {columns: linear}}
masses: {given: [{lines: all, floors: all, mass: 10 t}]}
dampers:
  laws:
    spring: {type: kelvin_voigt, parameters: {k: 20 kN/mm, c: 0 kN*s/mm}}
  devices:
    - {kind: @kind@, law: spring, bays: 1, storeys: all, brace: @brace@}
analyses: [{name: modes, kind: modal, modes: 1}]
"""


def project(kind: str, brace: str = "rigid") -> Project:
    text = FRAME.replace("@kind@", kind).replace("@brace@", brace)
    return parse_project(text, "project.yaml", profile_names())


def test_a_brace_of_a_damper_has_the_resistance_of_the_printed_strut() -> None:
    """The braces of a chevron are hypot(2.4, 3.2) = 4 m long, as the strut of Example 6.7."""
    (device,) = make_frame(project("chevron", "{section: CHS244.5x10, material: S355}"), dampers=True).devices
    bar = device.brace_bar
    assert bar is not None and bar.strut is not None
    assert bar.strut.length == pytest.approx(4.0) and bar.strut.resistance == pytest.approx(2297e3, rel=1e-3)
    assert bar.share == pytest.approx(1.0 / (2.0 * 0.6))  # two braces at cos = 2.4 / 4
    # A = 7367 mm2: 2 E A / L cos^2 along the damper
    assert device.brace == pytest.approx(2.0 * E * 7367e-6 / 4.0 * 0.36, rel=1e-3)
    half = "{section: CHS244.5x10, material: S355, buckling_length_factor: 0.5}"
    (shorter,) = make_frame(project("chevron", half), dampers=True).devices
    assert shorter.brace_bar is not None and shorter.brace_bar.strut is not None
    assert shorter.brace_bar.strut.length == pytest.approx(2.0) and shorter.brace == pytest.approx(device.brace)


def resistance(side: float, thickness: float, length: float) -> float:
    """N_b,Rd of a hot finished square, curve a, by hand; A and I of EN 10210-2 with r_o = 1.5 t, r_i = t."""
    b, t = side, thickness
    area = 2.0 * t * (2.0 * b - 2.0 * t) - (4.0 - math.pi) * ((1.5 * t) ** 2 - t**2)
    inner = b - 2.0 * t

    def corners(of: float, r: float) -> float:
        a, h = (1.0 - math.pi / 4.0) * r**2, ((10.0 - 3.0 * math.pi) / (12.0 - 3.0 * math.pi)) * r
        own = (1.0 / 3.0 - math.pi / 16.0 - 1.0 / (3.0 * (12.0 - 3.0 * math.pi))) * r**4
        return 4.0 * (own + a * (of / 2.0 - h) ** 2)

    inertia = (b**4 - inner**4) / 12.0 - corners(b, 1.5 * t) + corners(inner, t)
    slenderness = math.sqrt(area * FY / (math.pi**2 * E * inertia / length**2))
    phi = 0.5 * (1.0 + 0.21 * (slenderness - 0.2) + slenderness**2)
    return area * FY / (phi + math.sqrt(phi**2 - slenderness**2))


def test_a_device_gets_the_lightest_section_that_holds_it() -> None:
    """300 kN x 1.2 / (2 x 0.6) = 300 kN in a brace of 4 m. By hand 100x4 has 242 kN, 120x4 has 385 kN."""
    assert resistance(0.1, 0.004, 4.0) < 300e3 < resistance(0.12, 0.004, 4.0)
    brace = "{choose: [SHS100x4, SHS120x8, SHS120x4], material: S355, force: 300 kN, overstrength: 1.2}"
    (device,) = make_frame(project("chevron", brace), dampers=True).devices
    assert device.brace_bar is not None and device.brace_bar.strut is not None
    assert device.brace_bar.section == "SHS120x4"
    assert device.brace_bar.strut.resistance == pytest.approx(resistance(0.12, 0.004, 4.0), rel=2e-3)
    # 120x4 has 1840 mm2; 80 kN/mm along the damper need 80 / (2 x 210 x 0.36 / 4000) = 2116 mm2, which 120x8 has
    # slenderness of 120x4: i = 47.3 mm, 4000 / 47.3 / 76.4 = 1.11
    slim = brace.replace("force", "largest_slenderness: 1.1, force").replace("SHS120x8", "SHS140x5")
    (stout,) = make_frame(project("chevron", slim), dampers=True).devices
    assert stout.brace_bar is not None and stout.brace_bar.section == "SHS140x5"
    stiff = brace.replace("force", "stiffness: 80 kN/mm, force")
    (stiffer,) = make_frame(project("chevron", stiff), dampers=True).devices
    assert stiffer.brace_bar is not None and stiffer.brace_bar.section == "SHS120x8" and stiffer.brace > 80e6


@pytest.mark.parametrize(
    ("brace", "message"),
    [
        (
            "{choose: [SHS50x5], material: S355, force: 300 kN, largest_slenderness: 9}",
            "the strongest, SHS50x5, has N_b,Rd = ",
        ),
        ("{choose: [SHS100x4], material: S355, force: 9 kN, stiffness: 1 MN/mm}", "the stiffest, SHS100x4, has"),
        ("{choose: [RHS], material: S355, force: 9 kN}", "`RHS` has no list of sizes"),
        ("{choose: [SHS300x4], material: S355, force: 9 kN}", "are of class 4 in compression, or more slender than 2"),
        ("{choose: [SHS100x4], material: elastic, force: 9 kN}", "does not yield"),
    ],
)
def test_what_cannot_be_chosen_is_refused_with_what_there_is(brace: str, message: str) -> None:
    with pytest.raises(InputError, match=r"dampers.devices\[0\]: brace\.") as found:
        make_frame(project("chevron", brace), dampers=True)
    assert message in str(found.value)


CHEVRON = {  # of a damper that pulls with 1: half of it across, and F h / w upwards
    ("lower gusset", "A0"): ((0.5, 3.2 / 4.8), 1.0),
    ("lower gusset", "B0"): ((0.5, -3.2 / 4.8), -1.0),
    ("apex, to the damper", "storey 1"): ((1.0, 0.0), 1.0),
    ("beam above", "storey 1"): ((-1.0, 0.0), 1.0),
}
_L = math.hypot(4.8, 3.2)
RISING = {("upper gusset", "B1"): ((-4.8 / _L, -3.2 / _L), 1.0), ("lower gusset", "A0"): ((4.8 / _L, 3.2 / _L), 1.0)}
STOREY = {("floor below", "floor 0"): ((1.0, 0.0), 1.0), ("floor above", "floor 1"): ((-1.0, 0.0), 1.0)}
BRACES = {
    ("upper gusset", "B_1_1"): ((-0.6, -0.8), 1.0),
    ("lower gusset", "A0"): ((0.6, 0.8), 1.0),
}


@pytest.mark.parametrize(
    ("kind", "expected"), [("chevron", CHEVRON), ("rising", RISING), ("storey", STOREY), ("chevron_braces", BRACES)]
)
def test_connections_are_those_of_statics(
    kind: str, expected: dict[tuple[str, str], tuple[tuple[float, float], float]]
) -> None:
    frame = make_frame(project(kind), dampers=True)
    found = connections_of(frame, frame.devices[0])
    assert {(one.part, one.at) for one in found} == set(expected)
    for one in found:
        force, pulled = expected[one.part, one.at]
        assert one.force == pytest.approx(force, abs=1e-12) and one.pulled == pulled
    if kind == "chevron":  # a brace carries F / (2 cos)
        assert found[0].size == pytest.approx(1.0 / 1.2)


@pytest.mark.parametrize("kind", ["chevron", "rising"])
def test_reactions_are_those_of_columns_and_gussets(kind: str) -> None:
    """At each foot: reaction = end force of the column - force of the connection; so base shear and couple close."""
    frame = make_frame(project(kind, "{section: CHS244.5x10, material: S355}"), dampers=True)
    pattern = frame.model.pattern()
    frame.model.nodal_load(pattern, frame.nodes["A1"], 1e5, 0.0, 0.0)
    names = [(name, at) for name in ("A0", "B0") for at in (0, 1)]
    channels = [Channel(f"R {name} {at}", ((1.0, "reaction", frame.nodes[name], at),)) for name, at in names]
    for name in ("A0", "B0"):  # local x of a column goes up, local y to the left
        element = frame.members[f"C_{name[0]}_1"].element
        channels.append(Channel(f"{name} 0", ((-1.0, "end_force", element, 1),)))
        channels.append(Channel(f"{name} 1", ((1.0, "end_force", element, 0),)))
    channels.append(Channel("F", ((1.0, "damper_force", frame.devices[0].number, 0),)))
    analysis = Analysis(frame.model, tolerance=1e-12)
    analysis.install_dampers()
    response = analysis.static(pattern, 1.0, 2, channels)
    assert response.status == "completed", response.reason
    of, force = response.final, response.final["F"]
    assert abs(force) > 1e4
    held: dict[str, Connection] = {one.at: one for one in connections_of(frame, frame.devices[0])}
    for name, at in names:
        gusset = force * held[name].force[at] if name in held else 0.0
        assert of[f"R {name} {at}"] == pytest.approx(of[f"{name} {at}"] - gusset, abs=1e-3), name
    assert of["R A0 0"] + of["R B0 0"] == pytest.approx(-1e5, abs=1e-2)


def test_a_dashpot_at_its_factored_velocity() -> None:
    """F = 300 kN (s/m)^0.35 x (1.5 x 0.2 m/s)^0.35 = 196.8 kN, 1.1525 times the 170.8 kN at 0.2 m/s."""
    oil = LawValues("viscous_power", (300e3, 0.35))
    bare, raised = 300e3 * 0.2**0.35, 300e3 * 0.3**0.35
    assert (bare, raised) == pytest.approx((170.8e3, 196.8e3), rel=1e-3)
    assert force_ratio(oil, 0.03, 0.2, 1.2, 1.5) == pytest.approx(raised / bare, rel=1e-12)
    assert force_ratio(LawValues("viscous", (1e6,)), 0.03, None, 1.0, 1.3) == pytest.approx(1.3)


def test_a_yielding_damper_at_its_factored_stroke() -> None:
    """Fy = 200 kN, k = 100 kN/mm, b = 2 %: 200 + 2 (u - 2 mm); 236 kN at 20 mm, 244 kN at 24 mm."""
    steel = LawValues("elastic_plastic", (100e6, 200e3, 0.02))
    assert force_ratio(steel, 0.020, None, 1.2, 1.0) == pytest.approx(244.0 / 236.0, rel=1e-6)
    rate = LawValues("kelvin_voigt", (1e6, 1e5))
    assert math.isnan(force_ratio(rate, 0.02, None, 1.2, 1.0))  # the velocity is not known
    # |k + i omega c| u at u = 20 mm and 0.2 m/s: 28.28 kN; at 24 mm and 0.26 m/s: hypot(24, 26) = 35.38 kN
    assert force_ratio(rate, 0.02, 0.2, 1.2, 1.3) == pytest.approx(math.hypot(24, 26) / math.hypot(20, 20), rel=1e-3)


def test_factors_of_codes() -> None:
    asce = factors_of_code("asce7-22")
    assert (asce.stroke, asce.velocity, asce.overstrength, asce.isolator_stroke) == (1.3, 1.3, 1.2, 1.0)
    assert factors_of_code("ec8-2004").isolator_stroke == 1.2 and not factors_of_code("ec8-2004").on_dampers
    assert DEVICE_FACTORS["fema356"].stroke == 2.0 and DEVICE_FACTORS["fema356_redundant"].velocity == 1.3
    assert not factors_of_code("ntc-2018").on_dampers


OIL = "\ndampers: {laws: {oil: {type: viscous_power, parameters: {c: 1 kN*(s/m)^0.5, alpha: 0.5}}}}\n"
FACTORS = DeviceFactors("", stroke=1.2, velocity=1.5, overstrength=1.1)


def braced(text: str, laws: str, factors: DeviceFactors = FACTORS) -> tuple[Project, DesignResult]:
    found = shear_project(2, laws)
    plain = found.with_values({"materials.S355": {"law": "bilinear", "E": "210 GPa", "fy": "355 MPa"}})
    return plain, run_design(plain, "tried", design(text, plain), Path("."), factors=factors)


def of_storeys(group: Group, name: str) -> np.ndarray:
    return np.asarray(group.variables[name].values)


def test_a_viscous_design_reaches_its_damping_behind_the_braces_that_it_chose() -> None:
    """The stiffness by hand is 2 E A / L cos^2; N_Ed = 1.1 x 1.5^0.5 x c v^0.5 / (2 cos)."""
    text = "method: viscous, law: oil, kind: chevron, bays: 1, state: initial, level: DBE, damping: 12 %"
    text += ", brace: {choose: [SHS], material: S355}"
    _, result = braced(text, OIL)
    group = result.group
    assert result.status == "completed" and group.attributes["damping"] == pytest.approx(0.12, rel=1e-5)
    (run,) = result.dampers.devices
    assert isinstance(run, DamperRun) and isinstance(run.brace, BraceSection)
    length = math.hypot(4.0, 4.0)  # half a bay of 8 m, a storey of 4 m: cos^2 = 1/2
    areas = np.array([steel_section(name).A for name in run.brace.sections])
    assert of_storeys(group, "brace_stiffness") == pytest.approx(2.0 * E * areas / length * 0.5)
    force = of_storeys(group, "estimated_device_force")
    expected = 1.1 * math.sqrt(1.5) * force / (2.0 * math.sqrt(0.5))
    assert of_storeys(group, "brace_force") == pytest.approx(expected)
    use = of_storeys(group, "brace_force") / of_storeys(group, "brace_resistance")
    assert np.all(use <= 1.0) and np.all(use > 0.5)


def test_no_lighter_section_of_the_list_would_hold() -> None:
    text = "method: viscous, law: oil, kind: chevron, bays: 1, state: initial, level: DBE, damping: 12 %"
    lists = "SHS40x2.5, SHS60x3, SHS80x3.2, SHS100x4, SHS120x5, SHS140x6.3, SHS200x8"
    _, result = braced(f"{text}, brace: {{choose: [{lists}], material: S355, largest_slenderness: 9}}", OIL)
    chosen = [str(name) for name in of_storeys(result.group, "brace_section")]
    names = lists.split(", ")
    for i, name in enumerate(chosen):
        lighter = names[max(names.index(name) - 1, 0)]
        _, other = braced(f"{text}, brace: {{section: {lighter}, material: S355}}", OIL)
        use = of_storeys(other.group, "brace_force") / of_storeys(other.group, "brace_resistance")
        assert name == names[0] or use[i] > 1.0


def test_a_target_with_its_braces_counts_the_chosen_stiffness() -> None:
    """K'' / (2 (k_S + K')) = zeta with K of damper and brace in series, thesis Eq. 5.9 with braces."""
    text = "method: strain_energy, law: rubber, kind: chevron, bays: 1, state: initial, level: DBE, damping: 5 %"
    text += ", properties: {G_storage: 1 MPa, loss_factor: 0.4}, strain: 20 %, layer_thickness: 20 mm"
    text += ", braces_in_target: true, target_in: storeys, brace: {choose: [SHS], material: S355, ratio: 4}"
    _, result = braced(text, LAWS)
    group = result.group
    brace, storey, damper = (of_storeys(group, f"{name}_stiffness") for name in ("brace", "storey", "damper"))
    assert np.all(brace >= 4.0 * storey)
    of_damper = damper * (1.0 + 0.4j)
    series = of_damper * brace / (of_damper + brace)
    assert series.imag / (2.0 * (storey + series.real)) == pytest.approx(np.full(2, 0.05))


def test_braces_of_a_given_section_are_checked() -> None:
    text = "method: viscous, law: oil, kind: chevron, bays: 1, state: initial, level: DBE, damping: 12 %"
    _, result = braced(f"{text}, brace: {{section: SHS50x3, material: S355}}", OIL)
    (warning,) = [one for one in result.group.attributes["warnings"] if "do not hold" in one]
    assert "storey 1, 2" in warning and "SHS50x3 with N_Ed = " in warning


def test_wrong_braces_of_designs_are_refused() -> None:
    found = shear_project(2, OIL)
    text = "method: viscous, law: oil, kind: @, bays: 1, damping: 12 %, brace: {choose: [SHS], material: steel}"
    assert "are those of a hazard level" in refusal(text.replace("@", "chevron"), found)
    levelled = f"{text}, level: DBE"
    assert "has no brace geometry" in refusal(levelled.replace("@", "storey"), found)
    wrong = levelled.replace("@", "rising").replace("material: steel", "material: S3")
    assert "there is no material `S3`" in refusal(wrong, found)
    listed = levelled.replace("@", "rising").replace("choose: [SHS]", "section: [SHS100x4, SHS90x4, SHS90x4]")
    assert "3 values for 2 storeys" in refusal(listed, found)
