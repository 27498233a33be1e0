"""Where dampers stand in a frame and at what size, against models in which every brace is an element of its own.

References: bars, apex nodes and springs in the core; 2 E A cos^2 / L by hand; thesis Eqs. 5.15-5.21. The frames are
elastic and the equations linear: results agree to the rounding of the solution, 1e-9.
"""

from __future__ import annotations

import numpy as np
import pytest

from edesign.core import Analysis, Channel, CoreDamper, Elastic, Model
from edesign.damper.laws import law
from edesign.damper.parameters import read_parameters
from edesign.frame.frame import build_frame
from edesign.frame.frame_model import FrameModel
from edesign.frame.sections.profiles import profile_names
from edesign.project import Project, parse_project
from edesign.study.analysis.dampers import device_laws
from edesign.study.analysis.structure import device_stiffness, make_frame

E, AREA = 210e9, 2.6e-3  # Pa, m2 of the braces
BAY, HEIGHTS = 6.0, (4.0, 3.0)  # m
K = 45e6  # N/m of the spring that stands for a damper

FRAME = """\
edesign: 1
title: Two storeys, one bay, elastic
frame:
  bays: [6 m]
  storeys: [4 m, 3 m]
  diaphragms: @diaphragms@
  columns: [{storeys: all, section: HEB200, material: steel}]
  beams: [{floors: all, section: IPE300, material: steel}]
materials:
  steel: {law: elastic, E: 210 GPa}
sections:
  strut: {area: 26 cm^2}
elements: {geometry: {columns: linear}}
masses:
  given: [{lines: all, floors: all, mass: 10 t}]
dampers:
  laws:
    spring:
      type: kelvin_voigt
      parameters: {k: 45 kN/mm, c: 0 kN*s/mm}
      prototype: {layers: 2, layer_area: 40000 mm^2, layer_thickness: 10 mm}
  devices:
    - @device@
analyses:
  - {name: modes, kind: modal, modes: 1}
"""


def project(device: str, diaphragms: str = "all") -> Project:
    text = FRAME.replace("@device@", device).replace("@diaphragms@", diaphragms)
    return parse_project(text, "project.yaml", profile_names())


Results = dict[str, float]
LOADS = ("A2.x", "B1.x", "A1.y", "B2.r")  # force or moment that each unit load case puts on a node


def responses(frame: FrameModel, dampers: bool) -> dict[str, Results]:
    """Displacements, axial forces of columns and base reactions under each unit load (1 MN, 1 MN m)."""
    patterns = {}
    for load in LOADS:
        patterns[load] = frame.model.pattern()
        forces = {"x": (1e6, 0.0, 0.0), "y": (0.0, 1e6, 0.0), "r": (0.0, 0.0, 1e6)}[load[-1]]
        frame.model.nodal_load(patterns[load], frame.nodes[load[:2]], *forces)
    channels = [
        Channel(f"u {name} {at}", ((1.0, "displacement", node, at),))
        for name, node in frame.nodes.items()
        for at in range(3)
    ]
    channels += [Channel(f"N {m.name}", ((1.0, "axial_force", m.element, 0),)) for m in frame.of_kind("column")]
    channels += [
        Channel(f"R {name} {at}", ((1.0, "reaction", frame.nodes[name], at),))
        for name in frame.supports
        for at in range(3)
    ]
    found = {}
    for load, pattern in patterns.items():
        analysis = Analysis(frame.model, tolerance=1e-13)
        if dampers:
            analysis.install_dampers()
        response = analysis.static(pattern, 1.0, 2, channels)
        assert response.status == "completed", response.reason
        found[load] = response.final
    return found


def compare(
    found: dict[str, Results], expected: dict[str, Results], tolerance: float = 1e-9, kinds: str = "uNR"
) -> None:
    """Each kind of quantity within the tolerance of its largest value."""
    for load, exact in expected.items():
        for kind in kinds:
            names = [name for name in exact if name[0] == kind]
            largest = max(abs(exact[name]) for name in names)
            for name in names:
                assert abs(found[load][name] - exact[name]) < tolerance * largest, (load, name)


def plain(one: Project) -> tuple[FrameModel, int]:
    """The frame without dampers, and the core's material of braces to be added."""
    model = Model()
    steel = model.material(Elastic(E))
    return build_frame(one, model), steel


def chevrons(one: Project, storeys: list[int]) -> FrameModel:
    """The frame with apex nodes under the beams, two bars each, and a horizontal spring to the rigid floor."""
    frame, steel = plain(one)
    model = frame.model
    for storey in storeys:
        top = sum(HEIGHTS[:storey])
        apex, tied = (model.node(f"{name}{storey}", 0.5 * BAY, top) for name in ("apex", "tied"))
        model.fix(apex, rz=True)  # bars do not turn it
        model.fix(tied, uy=True, rz=True)
        model.tie(tied, frame.nodes[f"A{storey}"], ux=True)
        model.link(f"spring{storey}", apex, tied, (K, 0.0, 0.0))
        for line in "AB":
            model.truss(f"{line}{storey}", frame.nodes[f"{line}{storey - 1}"], apex, steel, AREA)
    return frame


@pytest.mark.parametrize("storeys", ["1", "2", "1-2"])
def test_chevron_is_an_apex_with_two_bars(storeys: str) -> None:
    """The apex is condensed out of the model; the lower ends get the vertical forces of the bars, up and down."""
    there = {"1": [1], "2": [2], "1-2": [1, 2]}[storeys]
    device = f"{{kind: chevron, bays: 1, storeys: {storeys}, law: spring, brace: {{section: strut, material: steel}}}}"
    one = project(device)
    found = responses(make_frame(one, dampers=True), dampers=True)
    compare(found, responses(chevrons(one, there), dampers=False))


def test_brace_stiffness_by_hand_and_by_section_are_the_same() -> None:
    """2 E A cos^2 / L of a chevron, E A / L of a diagonal; per storey."""
    stiffness = []
    for height in HEIGHTS:
        length = np.hypot(0.5 * BAY, height)
        stiffness.append(2.0 * E * AREA / length * (0.5 * BAY / length) ** 2)
    device = "{kind: chevron, bays: 1, storeys: 1-2, law: spring, brace: @}"
    by_section = make_frame(project(device.replace("@", "{section: strut, material: steel}")), dampers=True)
    assert [d.brace for d in by_section.devices] == pytest.approx(stiffness, rel=1e-14)
    listed = ", ".join(f"{k!r} N/m" for k in map(float, stiffness))
    by_hand = make_frame(project(device.replace("@", f"{{stiffness: [{listed}]}}")), dampers=True)
    compare(responses(by_hand, dampers=True), responses(by_section, dampers=True), 1e-12)
    along = device.replace("chevron", "rising").replace("@", "{section: strut, material: steel}")
    diagonal = make_frame(project(along), dampers=True)
    assert [d.brace for d in diagonal.devices] == pytest.approx([E * AREA / np.hypot(BAY, h) for h in HEIGHTS])


def test_without_diaphragm_a_chevron_pulls_at_both_ends_of_the_beam() -> None:
    """A spring to the middle of a bar under the beam: exactly the same but for the bar's stretch, 4 E A / width, which
    is in series with the braces. The model leaves the stretch of a beam out (IPE 450 over 7.2 m: 1150 kN/mm)."""
    area = 3e-3  # m2 of the bar
    device = "{kind: chevron, bays: 1, storeys: 1, law: spring, brace: @}"
    one = project(device.replace("@", "{section: strut, material: steel}"), "none")
    frame, steel = plain(one)
    model = frame.model
    apex, middle = (model.node(name, 0.5 * BAY, HEIGHTS[0]) for name in ("apex", "middle"))
    model.fix(apex, rz=True)
    model.fix(middle, uy=True, rz=True)
    model.link("spring", apex, middle, (K, 0.0, 0.0))
    for line in "AB":
        model.truss(f"end{line}", frame.nodes[f"{line}0"], apex, steel, AREA)
        model.truss(f"half{line}", frame.nodes[f"{line}1"], middle, steel, area)
    exact = responses(frame, dampers=False)

    (damper,) = make_frame(one, dampers=True).devices
    series = 1.0 / (1.0 / damper.brace + BAY / (4.0 * E * area))
    soft = project(device.replace("@", f"{{stiffness: {series!r} N/m}}"), "none")
    model = Model()
    steel = model.material(Elastic(E))
    frame = build_frame(soft, model, laws=device_laws(soft))
    model.truss("bar", frame.nodes["A1"], frame.nodes["B1"], steel, area)
    compare(responses(frame, dampers=True), exact)


@pytest.mark.parametrize("diaphragms", ["all", "none"])
@pytest.mark.parametrize(
    ("device", "ends"),
    [
        ("kind: rising, bays: 1, storeys: 1-2", [("A0", "B1"), ("A1", "B2")]),
        ("kind: falling, bays: 1, storeys: 2", [("A2", "B1")]),
        ("kind: nodes, nodes: [A0, B2]", [("A0", "B2")]),
        ("kind: nodes, nodes: [B2, A1]", [("A1", "B2")]),
    ],
)
def test_dampers_along_a_line_are_bars(device: str, ends: list[tuple[str, str]], diaphragms: str) -> None:
    """Damper and brace in series, 1 / (1/k + L / (E A)), as the area of a bar."""
    one = project(f"{{{device}, law: spring, brace: {{section: strut, material: steel}}}}", diaphragms)
    frame, steel = plain(one)
    for start, end in ends:
        (x0, y0), (x1, y1) = one.frame.nodes[start], one.frame.nodes[end]
        length = np.hypot(x1 - x0, y1 - y0)
        stiffness = 1.0 / (1.0 / K + length / (E * AREA))
        frame.model.truss(f"{start}{end}", frame.nodes[start], frame.nodes[end], steel, stiffness * length / E)
    compare(responses(make_frame(one, dampers=True), dampers=True), responses(frame, dampers=False))


def test_dampers_between_floors_are_horizontal_springs() -> None:
    one = project("{kind: storey, bays: 1, storeys: 1-2, law: spring, number: 3, brace: {stiffness: 70 kN/mm}}")
    frame, _ = plain(one)
    model = frame.model
    stiffness = 1.0 / (1.0 / (3.0 * K) + 1.0 / 70e6)
    for storey in (1, 2):
        below, above = (model.node(f"{name}{storey}", 0.0, HEIGHTS[0]) for name in ("below", "above"))
        for node, floor in ((below, storey - 1), (above, storey)):
            model.fix(node, ux=floor == 0, uy=True, rz=True)
            if floor > 0:
                model.tie(node, frame.nodes[f"A{floor}"], ux=True)
        model.link(f"spring{storey}", below, above, (stiffness, 0.0, 0.0))
    found = responses(make_frame(one, dampers=True), dampers=True)
    # the spring of the first storey holds on a support of its own, the damper by halves on A0 and B0
    compare(found, responses(frame, dampers=False), kinds="uN")
    for load, result in found.items():
        base = sum(result[f"R {name} 0"] for name in ("A0", "B0"))
        assert base == pytest.approx(-1e6 if load[-1] == "x" else 0.0, abs=1e-3)


# ---- size and number

SIZED = """\
{kind: storey, bays: 1, storeys: 1-2, law: soft, layers: 4, layer_area: [0.2 m^2, 0.4 m^2], layer_thickness: 60 mm}
    - {kind: storey, bays: 1, storeys: 1, law: soft}
    - {kind: chevron, bays: 1, storeys: 1, law: soft, number: 3}
    - {kind: storey, bays: 1, storeys: 1, law: soft, layers: 1, number: 2}"""
SOFT = """\
    soft:
      type: mgmm
      parameters: thesis_table_4_2
      prototype: {layers: 2, layer_area: 41400 mm^2, layer_thickness: 12 mm}
"""


def test_size_scales_force_by_area_and_deformation_by_thickness() -> None:
    """Eqs. 5.19 and 5.21, F_D(u_D) = A_D / A_P F_P(h_P / h_D u_D), of every device on its own deformation."""
    text = FRAME.replace("@device@", SIZED).replace("@diaphragms@", "all").replace("  devices:", SOFT + "  devices:")
    one = parse_project(text, "project.yaml", profile_names())
    frame = make_frame(one, dampers=True)
    names = ["S_1_1", "S_1_2", "S_1_1_2", "V_1_1", "S_1_1_3"]
    assert [d.name for d in frame.devices] == names == frame.model.damper_names
    areas = [4 * 0.2 / 0.0828, 4 * 0.4 / 0.0828, 1.0, 3.0, 1.0]  # A_D / A_P; twice one layer are the prototype
    ratios = [12 / 60, 12 / 60, 1.0, 1.0, 1.0]  # h_P / h_D
    channels = []
    for device in frame.devices:
        for kind in ("displacement", "velocity"):
            terms = tuple((c, kind, node, degree) for c, node, degree in device.terms)
            channels.append(Channel(f"{kind} {device.name}", terms))
        channels.append(Channel(f"force {device.name}", ((1.0, "damper_force", device.number, 0),)))
    analysis = Analysis(frame.model)
    analysis.install_dampers()
    t = np.arange(301) * 0.01
    response = analysis.history(4.0 * np.sin(9.0 * t) * np.sin(2.3 * t), 0.01, channels=channels)
    assert response.status == "completed", response.reason
    values = list(read_parameters(law("mgmm"), "thesis_table_4_2").values())
    prototype = CoreDamper("mgmm", values)
    for name, area, ratio in zip(names, areas, ratios, strict=True):
        u, v = response.values[f"displacement {name}"], response.values[f"velocity {name}"]
        expected = area * prototype.force(response.time, ratio * u, ratio * v)
        peak = np.max(np.abs(expected))
        assert peak > 1e3
        # the same steps on the same numbers; where v changes its sign |v|^alpha magnifies its last digit
        assert np.max(np.abs(response.values[f"force {name}"] - expected)) < 1e-8 * peak, name


@pytest.mark.parametrize("alpha", [0.1, 0.35, 1.0])
def test_a_braced_power_dashpot_in_modes(alpha: float) -> None:
    """alpha = 1: 1 / (1/k_b + 1/(i omega c)); below, the force stays under that of a rigid brace, c (omega u)^alpha."""
    device = "{kind: storey, bays: 1, storeys: 1, law: oil, number: 2, brace: {stiffness: 20 kN/mm}}"
    oil = f"    oil: {{type: viscous_power, parameters: {{c: 30 kN*(s/m)^alpha, alpha: {alpha}}}}}\n"
    text = FRAME.replace("@device@", device).replace("@diaphragms@", "all").replace("  devices:", oil + "  devices:")
    (one,) = make_frame(parse_project(text, "project.yaml", profile_names()), dampers=True).devices
    omega, amplitude = 2.0 * np.pi, 0.01
    found = device_stiffness(one, amplitude, 1.0)
    loss = 2 * 30e3 * (omega * amplitude) ** alpha / amplitude  # of a power dashpot: at most 4/pi of the force
    if alpha == 1.0:
        assert found == pytest.approx(1.0 / (1.0 / 20e6 + 1.0 / (1j * omega * 60e3)), rel=1e-4)
    else:
        assert 0.5 * loss < found.imag < 4.0 / np.pi * loss and 0.0 < found.real < loss
