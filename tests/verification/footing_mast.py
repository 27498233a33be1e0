"""One mass on a cantilever on a footing, as a project."""

from __future__ import annotations

from math import pi

from edesign.project import Project, parse_project

RHO, V_S = 1800.0, 200.0
_TEXT = """\
edesign: 1
title: Mast on a footing
frame:
  bays: [1 m]
  storeys: [{h} m]
  supports:
    default:
      footing: {{soil: soil, length: {length} m, width: {width} m, embedment: {embedment} m, radiation: {on}}}
  columns: [{{lines: A, storeys: 1, section: post, material: steel}}]
  beams: []
  missing: {{columns: [{{lines: B, storeys: 1}}], beams: [{{bays: 1, floors: 1}}]}}
sections: {{post: {{area: 1 m^2, inertia: {inertia} m^4}}}}
materials: {{steel: {{law: elastic, E: 210 GPa}}}}
elements: {{geometry: {{columns: linear}}}}
soils: {{soil: {{density: {rho} kg/m^3, shear_wave_velocity: {v_s} m/s, poisson: {poisson}, damping: {damping}}}}}
masses: {{given: [{{lines: A, floors: 1, mass: {mass} kg}}], directions: horizontal}}
analyses: [{{name: modes, kind: modal, modes: 1, state: initial}}]
"""


def mast(
    h: float,
    width: float,
    length: float,
    stiffness_ratio: float,
    embedment: float = 0.0,
    damping: float = 0.0,
    poisson: float = 0.33,
    turned: bool = False,
    radiation: bool = True,
) -> tuple[Project, float, float, float]:
    """Return the project, its mass m (kg), height h (m) and stiffness on a fixed base k (N/m).

    Args:
        h: height, m.
        width, length: of the footing across and along the frame, m; turned: the other way round.
        stiffness_ratio: h / (V_s T) of the mast on a fixed base.
        embedment: m.
        damping: of the soil.
        poisson: of the soil.
        turned: whether the sides change places.
        radiation: whether it radiates.

    The mass is 0.15 rho times the footprint times h, as in the figures of the literature.
    """
    mass = 0.15 * RHO * width * length * h
    k = mass * (2.0 * pi * V_S * stiffness_ratio / h) ** 2
    if turned:
        width, length = length, width
    text = _TEXT.format(
        h=h,
        length=length,
        width=width,
        embedment=embedment,
        inertia=k * h**3 / 3.0 / 210e9,
        rho=RHO,
        v_s=V_S,
        poisson=poisson,
        damping=damping,
        mass=mass,
        on=str(radiation).lower(),
    )
    return parse_project(text), mass, h, k
