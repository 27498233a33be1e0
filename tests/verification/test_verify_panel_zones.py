"""Panel zones against closed forms of an interior joint between the middles of its members."""

from __future__ import annotations

import numpy as np
import pytest
from verification.structures import channel

from edesign.core import Analysis, Model
from edesign.frame.panel_zones import ARM_STIFFNESS, Panel, PanelBuilder, panel_of
from edesign.frame.sections.i_shape import IShape
from edesign.frame.sections.profiles import profile_names
from edesign.project import parse_project
from edesign.study.run.analyses import run_analysis

H, L = 3.6, 7.0  # m, between the middles of columns, of beams
D_B, D_C = 0.6, 0.4
EA = 1e17  # N: so stiff that the beams carry nothing of the axial force
EI_B, EI_C = 2.0e8, 1.5e8  # N m2
K = 5e7


def joint(K: float, EI_B: float, EI_C: float, geometry: str, axial: float = 0.0) -> float:
    """Sway of the top over the force there, m/N, of a joint with a panel zone under an axial force in the column."""
    m = Model()
    places = {
        "top": (0.0, 0.5 * H),
        "J": (0.0, 0.0),
        "base": (0.0, -0.5 * H),
        "left": (-0.5 * L, 0.0),
        "right": (0.5 * L, 0.0),
    }
    nodes = {name: m.node(name, *place) for name, place in places.items()}
    sections = {"C": m.elastic_section(EA, EI_C), "B": m.elastic_section(EA, EI_B)}
    panel = Panel(D_B, D_C, K, 1e9, 2e9, 0.03)
    panels = PanelBuilder(m, nodes, {node: places[name] for name, node in nodes.items()}, {"J": panel})
    for name, ends in (("C1", ("base", "J")), ("C2", ("J", "top")), ("B1", ("left", "J")), ("B2", ("J", "right"))):
        EI = EI_C if name[0] == "C" else EI_B
        of = geometry if name[0] == "C" else "linear"
        m.beam_column(name, *panels.ends(name, ends, EI, of), sections[name[0]], geometry=of)
    m.fix(nodes["base"], True, True, False)
    for name in ("left", "right"):
        m.fix(nodes[name], False, True, False)
    weight, push = m.pattern(), m.pattern()
    m.nodal_load(weight, nodes["top"], fy=-axial)
    m.nodal_load(push, nodes["top"], fx=1e3)
    analysis = Analysis(m)
    if axial:
        assert analysis.static(weight).status == "completed"
    response = analysis.static(push, 1.0, 1, [channel("displacement", nodes["top"])])
    assert response.status == "completed", response.reason
    return response.final[f"displacement_{nodes['top']}_0"] / 1e3


def test_interior_joint() -> None:
    """Beams, columns and panel by statics: H^2 (L - d_c)^3 / (12 E I_b L^2) + (H - d_b)^3 / (12 E I_c) + (H rho)^2 / K.

    rho = 1 - d_b / H - d_c / L (Charney & Marshall 2006, Engineering Journal AISC 43(1), Krawinkler's joint).
    """
    rho = 1.0 - D_B / H - D_C / L
    expected = H**2 * (L - D_C) ** 3 / (12.0 * EI_B * L**2) + (H - D_B) ** 3 / (12.0 * EI_C) + (H * rho) ** 2 / K
    assert joint(K, EI_B, EI_C, "linear") == pytest.approx(expected, rel=3.0 / ARM_STIFFNESS + 1e-6)


def test_second_order_forces_in_the_panel() -> None:
    """Stiff members: the force P does P / 2 (d_b theta_v^2 + (H - d_b) theta_h^2) of work, by hand.

    The vertical edges turn by theta_v with the beams, the horizontal ones by theta_h = -theta_v (L - d_c) / d_c.
    """
    axial = 5e6
    theta_v = 1.0
    theta_h = -theta_v * (L - D_C) / D_C
    sway = -(D_B * theta_v + (H - D_B) * theta_h)
    resisting = K * (theta_v - theta_h) ** 2 - axial * (D_B * theta_v**2 + (H - D_B) * theta_h**2)
    found = joint(K, 1e5 * EI_B, 1e5 * EI_C, "p_delta", axial)
    assert found == pytest.approx(sway**2 / resisting, rel=3e-4)


def test_values_of_a_panel_by_hand() -> None:
    """W14x311 column of 345 MPa, W30x108 beam, without doubler plates, by FEMA 355C, 2.4.2 in its own units."""
    inch, ksi = 0.0254, 6.894757e6
    column = IShape(17.1 * inch, 16.2 * inch, 2.26 * inch, 1.41 * inch, 0.0)
    panel = panel_of(29.8 * inch, column, 0.0, 29000.0 * ksi, 50.0 * ksi, 0.03)
    shear = panel.yield_moment / panel.height / (ksi * inch**2)
    assert shear == pytest.approx(0.55 * 50.0 * 17.1 * 1.41, rel=4e-3)  # kip; 0.55 is 0.95 / sqrt 3 rounded
    full = shear * (1.0 + 3.0 * 16.2 * 2.26**2 / (29.8 * 17.1 * 1.41))
    assert panel.full_moment / panel.height / (ksi * inch**2) == pytest.approx(full, rel=1e-6)
    stiffness = 0.95 * 17.1 * 1.41 * 29000.0 / 2.6
    assert panel.stiffness / panel.height / (ksi * inch**2) == pytest.approx(stiffness, rel=1e-6)


FRAME = """\
edesign: 1
title: Portal with panel zones
frame:
  bays: [7 m, 7 m]
  storeys: [3.6 m, 3.6 m]
  columns: [{storeys: all, section: HEB320, material: S355}]
  beams: [{floors: all, section: IPE450, material: S355}]
materials: {S355: {law: bilinear, E: 210 GPa, fy: 355 MPa, hardening: 1 %}}
loads: {beams: [{floors: all, G: 20 kN/m}]}
masses: {from_loads: {}, directions: horizontal}
panel_zones: [{lines: all, floors: all@doubler@}]
analyses:
  - {name: gravity, kind: gravity}
  - {name: push, kind: pushover, pattern: uniform, roof_drift: 3 %, steps: 150}
"""


def test_panels_of_a_frame_share_the_work() -> None:
    """Reactions carry all of the load; an inner panel is on its line of shear; doubler plates keep it elastic."""
    distortion = {}
    for doubler in ("", ", doubler: 40 mm"):
        project = parse_project(FRAME.replace("@doubler@", doubler), "project.yaml", profile_names())
        gravity, push = (run_analysis(project, analysis) for analysis in project.analyses)
        assert gravity.attributes["status"] == "completed", gravity.attributes["reason"]
        assert push.attributes["status"] == "completed", push.attributes["reason"]
        total = np.sum(gravity.variables["reaction_y_final"].values)
        assert total == pytest.approx(20e3 * 14.0 * 2.0, rel=1e-6)
        at = list(push.coords["panel"].values).index("B1")
        stiffness, M_y, M_p, moment, turned = (
            float(push.variables[f"panel_{name}"].values[at])
            for name in ("stiffness", "yield_moment", "full_moment", "moment_final", "distortion_final")
        )
        ductility = abs(turned) * stiffness / M_y
        line = np.interp(ductility, [0.0, 1.0, 4.0, 104.0], [0.0, M_y, M_p, M_p + 3.0 * M_y])
        assert abs(moment) == pytest.approx(line, rel=1e-6)
        distortion[doubler] = ductility
        events = push.variables["capacity_event_what"].values.tolist()
        assert ("first yield of a panel zone" in events) == (doubler == "")
    assert distortion[""] > 2.0 and distortion[", doubler: 40 mm"] < 1.0
