"""Crustal models: what an earthquake's spectrum and duration depend on besides magnitude and distance."""

from __future__ import annotations

from dataclasses import dataclass, replace


@dataclass(frozen=True)
class Crust:
    """Source, path and reference site of a region, as published for the stochastic point-source method.

    Attributes:
        name: of the region and of the model.
        shear_velocity: near the source, m/s.
        density: near the source, kg/m3.
        stress_drop: of the Brune source, Pa; rules the high frequencies.
        double_corner: intercept and slope over magnitude, of log10 of the lower corner frequency in Hz and of log10 of
            the share of the upper one; None: one corner frequency.
        radiation: mean radiation pattern of S waves.
        free_surface: factor of the free surface.
        partition: share of the motion in one horizontal component.
        spreading: (distance from which it holds in m, exponent of the distance) of each part; amplitudes are 1 at 1 km.
        quality: factor Q at 1 Hz and exponent of the frequency.
        path_velocity: shear velocity of the path, to which Q belongs, m/s.
        kappa: diminution of high frequencies near the site, s.
        pseudo_depth: intercept and slope of log10(h in km) over magnitude, first for small, then for large events.
        pseudo_depth_blend: magnitudes over which one line passes smoothly into the other.
        path_duration: (distance in m, duration in s) of the knots; straight between them.
        path_duration_slope: beyond the last knot, s/m.
        rock_velocity: v_S30 of the rock that `rock_amplification` describes, m/s.
        rock_amplification: (frequency in Hz, amplification from source to surface) of that rock.
    """

    name: str
    shear_velocity: float
    density: float
    stress_drop: float
    double_corner: tuple[tuple[float, float], tuple[float, float]] | None
    radiation: float
    free_surface: float
    partition: float
    spreading: tuple[tuple[float, float], ...]
    quality: tuple[float, float]
    path_velocity: float
    kappa: float
    pseudo_depth: tuple[tuple[float, float], tuple[float, float]]
    pseudo_depth_blend: float
    path_duration: tuple[tuple[float, float], ...]
    path_duration_slope: float
    rock_velocity: float
    rock_amplification: tuple[tuple[float, float], ...]


# fmt: off
# Boore (2016, BSSA 106, 316-320): the generic rock profile of Boore & Joyner (1997) for a v_S30 of 760 m/s
_GENERIC_ROCK_760 = (
    (0.010, 1.00), (0.015, 1.01), (0.021, 1.02), (0.031, 1.02), (0.045, 1.04), (0.065, 1.06), (0.095, 1.09),
    (0.138, 1.13), (0.200, 1.18), (0.291, 1.25), (0.423, 1.32), (0.615, 1.41), (0.894, 1.51), (1.301, 1.64),
    (1.892, 1.80), (2.751, 1.99), (4.000, 2.18), (5.817, 2.38), (8.459, 2.56), (12.301, 2.75), (17.889, 2.95),
    (26.014, 3.17), (37.830, 3.42), (55.012, 3.68), (80.000, 3.96),
)
# fmt: on

SINGLE_CORNER = Crust(
    name="western North America, one corner frequency",
    shear_velocity=3500.0,  # Boore & Thompson 2015, as their program SMSIM 6.0 has it
    density=2720.0,
    stress_drop=10.0e6,  # 100 bar: Campbell 2003; Boore & Thompson 2015
    double_corner=None,
    radiation=0.55,  # Boore & Boatwright 1984
    free_surface=2.0,
    partition=0.5**0.5,  # two equal horizontal components: Boore 2003
    spreading=((1.0e3, -1.0), (40.0e3, -0.5)),  # Raoof, Herrmann & Malagnini 1999
    quality=(180.0, 0.45),  # Raoof, Herrmann & Malagnini 1999
    path_velocity=3500.0,
    kappa=0.035,  # Boore & Joyner 1997, generic rock
    pseudo_depth=((-1.72, 0.43), (-0.405, 0.235)),  # Yenier & Atkinson 2014; 2015
    pseudo_depth_blend=2.0,  # Boore & Thompson 2015
    path_duration=(  # Boore & Thompson 2014, Table 1
        (0.0, 0.0),
        (7.0e3, 2.4),
        (45.0e3, 8.4),
        (125.0e3, 10.9),
        (175.0e3, 17.4),
        (270.0e3, 34.2),
    ),
    path_duration_slope=0.156e-3,
    rock_velocity=760.0,
    rock_amplification=_GENERIC_ROCK_760,
)
"""Active crust, simple Brune source: the parameters with which Boore & Thompson (2015, BSSA 105, 1029-1041) simulate.

Campbell (2003, BSSA 93, 1012-1033) differs in density (2800 kg/m3), kappa (0.04 s) and path duration (0.05 s/km).
"""

WESTERN_NORTH_AMERICA = replace(
    SINGLE_CORNER,
    name="western North America",
    double_corner=((2.181, -0.496), (0.605, -0.255)),  # Atkinson & Silva 2000; Boore 2003, Table 3
)
"""Active crust with the source of Atkinson & Silva (2000), which has two corner frequencies.

One corner overestimates recorded motion at periods of some seconds, up to twice for large magnitudes.
"""
