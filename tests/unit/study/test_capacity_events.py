"""Events of braces along capacity curves, against statics."""

from __future__ import annotations

import numpy as np
import pytest

from edesign.project import parse_project
from edesign.study.analysis.capacity_events import _limit_point
from edesign.study.run.analyses import run_analysis

TRUSS = """\
edesign: 1
title: A braced bay on hinges
frame:
  bays: [4 m]
  storeys: [3 m]
  supports: pinned
  columns: [{storeys: all, section: C, material: E}]
  beams: [{floors: all, section: C, material: E}]
  braces: [{bays: 1, storeys: 1, kind: rising, section: CHS60.3x4, material: S235}]
  releases: [{beams: {floors: all}, ends: both}]
sections: {C: {area: 1 m^2, inertia: 1e-3 m^4}}
materials:
  S235: {law: bilinear, E: 210 GPa, fy: 235 MPa, hardening: 1 %}
  E: {law: elastic, E: 210 GPa}
elements: {geometry: {columns: linear, beams: linear, braces: linear}}
masses: {given: [{floors: all, mass: 1 t}]}
analyses: [{name: push, kind: pushover, pattern: uniform, direction: @way@, roof_drift: 1 %, steps: 1000}]
"""


@pytest.mark.parametrize("way", ["right", "left"])
def test_a_bar_yields_where_its_elongation_is_that_of_yield(way: str) -> None:
    """Stiff beams and columns: u cos(a) = f_y L / E, with L = 5 m and cos a = 0.8, both ways of a bar.

    The columns are a thousandth of a millimetre shorter or longer; the event is in the first step beyond, of 0.03 mm.
    """
    project = parse_project(TRUSS.replace("@way@", way), "project.yaml")
    group = run_analysis(project, project.analyses[0])
    events = group.variables["capacity_event_what"].values.tolist()
    at = events.index("first yield of a brace")
    assert group.variables["capacity_event_place"].values[at] == "D_1_1_r"
    u = 235e6 / 210e9 * 5.0 / 0.8
    assert 0.0 <= group.variables["capacity_event_displacement"].values[at] - u < 3e-5 + 1e-2 * u


@pytest.mark.parametrize(
    ("compression", "shortening", "step"),
    [
        ([0, 1, 2, 1.5, 1], [0, 1, 2, 3, 4], 2),  # a limit point
        ([0, 1, 2, 1.5, 1], [0, 1, 2, 1.5, 1], None),  # unloading along the line of loading
        ([0, 1, 2, 1.5, 2.5, 2], [0, 1, 2, 1.5, 2.5, 3], 4),  # unloading, and then a limit point
        ([0, 1, 2, 3], [0, 1, 2, 3], None),
        ([0, -1, -2, -1], [0, -1, -2, -3], None),  # in tension
    ],
)
def test_a_brace_has_buckled_at_its_limit_point(
    compression: list[float], shortening: list[float], step: int | None
) -> None:
    assert _limit_point(np.array(compression, dtype=float), np.array(shortening, dtype=float)) == step


PORTAL = """\
edesign: 1
title: A portal with a loaded beam
frame:
  bays: [6 m]
  storeys: [3 m]
  columns: [{storeys: all, section: HEB300, material: S}]
  beams: [{floors: all, section: IPE240, material: S}]
materials: {S: {law: bilinear, E: 210 GPa, fy: 235 MPa}}
loads: {beams: [{floors: all, G: 15 kN/m}]}
masses: {given: [{floors: all, mass: 20 t}]}
analyses: [{name: push, kind: pushover, pattern: uniform, direction: right, roof_drift: 2 %, steps: 200}]
"""


def test_a_beam_yields_first_at_its_ends_where_a_load_divides_it() -> None:
    """A load of 1 N in its middle does not change when the beam yields, first at its leeward end."""
    steps = []
    for load in ("G: 15 kN/m", "G: 15 kN/m, points: [{at: 50 %, G: 1 N}]"):
        project = parse_project(PORTAL.replace("G: 15 kN/m", load), "project.yaml")
        group = run_analysis(project, project.analyses[0])
        events = group.variables["capacity_event_what"].values.tolist()
        steps.append(group.variables["capacity_event_step"].values[events.index("first yield of a beam")])
    assert steps[0] == steps[1]


SECOND = """\
edesign: 1
title: Two storeys pushed by their second mode
frame:
  bays: [6 m]
  storeys: [3 m, 3 m]
  columns: [{storeys: all, section: HEB200, material: S}]
  beams: [{floors: all, section: IPE300, material: S}]
materials: {S: {law: bilinear, E: 210 GPa, fy: 235 MPa, hardening: @hardening@}}
elements: {geometry: {columns: linear, beams: linear}}
masses: {given: [{floors: all, mass: 20 t}]}
analyses: [{name: push, kind: pushover, pattern: {mode: 2}, direction: @way@, roof_drift: @drift@, steps: 40}]
"""


@pytest.mark.parametrize("way", ["right", "left"])
@pytest.mark.parametrize(("drift", "yields"), [("0.01 %", False), ("1 %", True)])
def test_a_second_mode_resists_against_its_own_resultant(way: str, drift: str, yields: bool) -> None:
    """The resultant of mode 2 acts against the roof; a frame whose steel hardens resists it at every step."""
    text = SECOND.replace("@way@", way).replace("@drift@", drift).replace("@hardening@", "1 %")
    project = parse_project(text, "project.yaml")
    group = run_analysis(project, project.analyses[0])
    shear = (1.0 if way == "right" else -1.0) * group.variables["base_shear"].values
    assert np.all(shear[1:] < 0.0)
    found = group.variables.get("capacity_event_what")
    events = [] if found is None else found.values.tolist()
    assert not {"no resistance left", "largest base shear"} & set(events)
    assert ("first yield of a beam" in events or "first yield of a column" in events) is yields
