"""Shear frames: columns fixed in rigid floors, so that answers are known in closed form."""

from __future__ import annotations

E, AREA, INERTIA = 210e9, 1000.0, 1e-4  # Pa, m2, m4 of the columns
HEIGHT, BAY, MASS = 4.0, 8.0, 40e3  # m, m, kg a floor
STIFFNESS = 2 * 12 * E * INERTIA / HEIGHT**3
"""N/m, of a storey of two columns between floors that do not bend."""

_FRAME = """\
edesign: 1
title: Frame with columns fixed in rigid floors
frame:
  bays: [8 m]
  storeys: {count: @storeys@, height: 4 m}
  diaphragms: all
  columns: [{storeys: all, section: column, material: steel}]
  beams: [{floors: all, section: rigid, material: steel}]
materials:
  steel: {law: elastic, E: 210 GPa}
sections:
  column: {area: 1000 m^2, inertia: 1e-4 m^4}
  rigid: {area: 1 m^2, inertia: 1e3 m^4}
elements: {geometry: {columns: linear}}
masses:
  given: [{lines: all, floors: all, mass: 20 t}]
  directions: horizontal
"""


def shear_frame_text(storeys: int) -> str:
    """The project file of a shear frame of equal storeys and floors; analyses, loads and the like are to follow."""
    return _FRAME.replace("@storeys@", str(storeys))
