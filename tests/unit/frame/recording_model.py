"""A fake of the core's model that records its calls, and small projects to build with it."""

from __future__ import annotations

from typing import Any

from edesign.frame.frame import build_frame
from edesign.frame.frame_model import FrameModel
from edesign.frame.sections.profiles import profile_names
from edesign.project import Project, parse_project

SMALL = """\
edesign: 1
title: Small frame
frame:
  bays: [6 m, 7.5 m]
  storeys: [4 m, 3 m]
  supports: {default: fixed, B: pinned}
  columns: [{storeys: all, section: HEB260, material: S275}]
  beams: [{floors: all, section: IPE360, material: S275}]
materials:
  S275: {law: bilinear, E: 210 GPa, fy: 275 MPa, hardening: 1 %}
  weak: {law: menegotto_pinto, E: 200 GPa, fy: 235 MPa, hardening: 2 %}
  soft: {law: elastic, E: 70 GPa}
sections:
  rod: {area: 20 cm^2}
  girder: {height: 400 mm, width: 180 mm, flange: 14 mm, web: 9 mm}
  stiff: {area: 0.1 m^2, inertia: 1e-3 m^4}
loads:
  beams:
    - {floors: all, G: 20 kN/m, Q: 10 kN/m}
    - {floors: 2, bays: 2, G: 4 kN/m}
  nodes: [{lines: A, floors: 2, G: 50 kN}]
  gravity: {G: 1.0, Q: 0.5}
masses: {from_loads: {G: 1.0, Q: 0.2}}
analyses: [{name: gravity, kind: gravity}]
"""


class RecordingModel:
    """Remembers every call; ids count from 0 for each kind of object.

    Attributes:
        made: for each method the list of its arguments, keywords last.
    """

    def __init__(self) -> None:
        self.made: dict[str, list[tuple[Any, ...]]] = {}

    def __getattr__(self, method: str) -> Any:
        def record(*arguments: Any, **keywords: Any) -> int:
            kind = "element" if method in ("beam_column", "truss") else method
            calls = self.made.setdefault(kind, [])
            calls.append((*arguments, keywords))
            return len(calls) - 1

        return record

    def get(self, method: str) -> list[tuple[Any, ...]]:
        """Calls of a method."""
        return self.made.get(method, [])


def project(*changes: tuple[str, str]) -> Project:
    """The small project with parts of its text replaced."""
    text = SMALL
    for old, new in changes:
        assert old in text, old
        text = text.replace(old, new)
    return parse_project(text, profiles=profile_names())


def built(*changes: tuple[str, str]) -> tuple[FrameModel, RecordingModel]:
    """The small project's frame, and the calls of the model."""
    model = RecordingModel()
    return build_frame(project(*changes), model), model  # type: ignore[arg-type]
