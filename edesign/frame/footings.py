"""Footings as springs and dashpots at column bases."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from math import inf, isfinite, pi, sqrt

from edesign.codes.asce7.soil_strain import damping_ratio, modulus_ratio
from edesign.codes.ec8.action.soil_strain import soil_strain
from edesign.errors import InputError
from edesign.frame.footing_impedance import (
    Block,
    Way,
    dynamic_modifiers,
    radiation_damping,
    static_stiffness,
)
from edesign.project.analysis_file import AnalysisFile
from edesign.project.frame.foundations import Asce7Strain, Eurocode8Strain, Footing, Formula, Soil
from edesign.project.notation.units import STANDARD_GRAVITY
from edesign.project.reading.problems import keys_text

DIRECTIONS = {2: ("x", "y", "rotation"), 3: ("x", "y", "z", "rx", "ry", "rz")}
"""By the dimension of the model the motions of a footing, in the order of the degrees of the core."""
_ALONG_THE_LONG_SIDE: Mapping[int, tuple[Way, ...]] = {2: ("x", "z", "yy"), 3: ("x", "y", "z", "xx", "yy", "zz")}
"""The same in the notation of the impedance, of a footing whose length is not below its width."""
_TURNED: Mapping[Way, Way] = {"x": "y", "y": "x", "z": "z", "xx": "yy", "yy": "xx", "zz": "zz"}

_AGREEMENT = 1e-10  # of two periods that follow each other
_MOST_ROUNDS = 50


@dataclass(frozen=True)
class SoilUnderLoad:
    """A soil at the strains of the earthquake.

    Attributes:
        shear_modulus: G, Pa.
        modulus_ratio: G over that at small strains.
        damping: hysteretic damping ratio.
        wave_velocity: V_s that belongs to G, m/s.
    """

    shear_modulus: float
    modulus_ratio: float
    damping: float
    wave_velocity: float


@dataclass(frozen=True)
class FootingSprings:
    """A footing at a period; tuples are over the motions of `DIRECTIONS`.

    Attributes:
        period: s.
        a_0: omega B / V_s.
        static, stiffness: N/m or N m/rad: without frequency, and at the period.
        radiation: damping ratios.
        soil: that it stands on.
        dashpot: N s/m or N m s/rad; none acts vertically at a footing that lifts off.
        formula: of the static stiffness.
        uplift, capacity: whether it lifts off, and the force (N) at which the soil gives way; infinite: it does not.
        mass, inertia: of the block, kg, and for each rotation kg m2 about the middle of its underside.
    """

    period: float
    a_0: float
    static: tuple[float, ...]
    stiffness: tuple[float, ...]
    radiation: tuple[float, ...]
    soil: SoilUnderLoad
    dashpot: tuple[float, ...]
    formula: Formula
    uplift: bool = False
    capacity: float = inf
    mass: float = 0.0
    inertia: tuple[float, ...] = ()

    @property
    def damping(self) -> tuple[float, ...]:
        """Damping ratios of radiation and soil together."""
        return tuple(ratio + self.soil.damping for ratio in self.radiation)


def _soil_under_load(soil: Soil) -> SoilUnderLoad:
    """Return a soil at the strains of the earthquake.

    Args:
        soil: as the project gives it.

    Raises:
        InputError: the tables of the code do not have its case.
    """
    if soil.shear_modulus is not None:
        small = soil.shear_modulus
    else:
        small = soil.density * (soil.shear_wave_velocity or 0.0) ** 2
    ratio, damping = 1.0, soil.damping
    match soil.strain:
        case Eurocode8Strain(acceleration=acceleration):
            ratio, of_code = soil_strain(acceleration / STANDARD_GRAVITY)
            damping = of_code if damping is None else damping
        case Asce7Strain(site_class=site_class, acceleration=acceleration):
            ratio = modulus_ratio(site_class, acceleration / STANDARD_GRAVITY)
            damping = damping_ratio(site_class, acceleration / STANDARD_GRAVITY) if damping is None else damping
        case None:
            pass
        case given:
            ratio = given.modulus_ratio
    modulus = ratio * small
    return SoilUnderLoad(modulus, ratio, damping or 0.0, sqrt(modulus / soil.density))


def footing_springs(footing: Footing, soil: Soil, period: float, dimension: int = 2) -> FootingSprings:
    """Return a footing as springs and dashpots.

    Args:
        footing: as the project gives it.
        soil: below it, as the project gives it.
        period: at which stiffness and damping are taken, s; infinite: static, without dashpots.
        dimension: 2: in the plane of a frame that its length is along; 3: in space, with its length along x.

    Returns:
        Springs and dashpots, by direction.

    Raises:
        InputError: the tables of the code do not have the case of the soil.
    """
    loaded = _soil_under_load(soil)
    half_length, half_width = 0.5 * max(footing.length, footing.width), 0.5 * min(footing.length, footing.width)
    block = Block(half_length, half_width, footing.embedment, footing.contact, loaded.shear_modulus, soil.poisson)
    omega = 2.0 * pi / period
    a_0 = omega * half_width / loaded.wave_velocity
    along = _ALONG_THE_LONG_SIDE[dimension]
    if footing.length < footing.width:
        along = tuple(_TURNED[way] for way in along)
    static, alpha = static_stiffness(block, footing.formula), dynamic_modifiers(block.slenderness, a_0)
    radiated = radiation_damping(block, static, a_0)
    stiffness = [alpha[way] * static[way] for way in along]
    ratios = [radiated[way] if footing.radiation else 0.0 for way in along]
    dashpots = [
        2.0 * k * (beta + loaded.damping) / omega if omega > 0.0 else 0.0
        for k, beta in zip(stiffness, ratios, strict=True)
    ]
    if footing.uplift:
        dashpots[along.index("z")] = 0.0
    area, thickness = footing.length * footing.width, footing.thickness or 0.0
    mass = footing.density * area * thickness
    about_y, about_x = (mass * (side**2 / 12.0 + thickness**2 / 3.0) for side in (footing.length, footing.width))
    about_z = mass * (footing.length**2 + footing.width**2) / 12.0
    return FootingSprings(
        period,
        a_0,
        tuple(static[way] for way in along),
        tuple(stiffness),
        tuple(ratios),
        loaded,
        tuple(dashpots),
        footing.formula,
        footing.uplift,
        inf if footing.bearing_resistance is None else footing.bearing_resistance * area,
        mass,
        (about_y,) if dimension == 2 else (about_x, about_y, about_z),
    )


def footings_of(
    project: AnalysisFile, first_period: Callable[[Mapping[str, FootingSprings]], float], dimension: int = 2
) -> dict[str, FootingSprings]:
    """Return the footings of a frame or building by the lines of columns that stand on them.

    Those without a `period` are taken at the first one of the frame on its footings, which depends on them: both are
    found together. Footings that lift off are then on the ground.

    Args:
        first_period: of the frame on such footings, s; of its dampers only buckling-restrained braces count.

    Raises:
        InputError: the tables of a code do not have the case of a soil, or no period was found.
        CoreError: the frame is a mechanism or unstable.
    """
    footings = project.footings

    def at(period: float) -> dict[str, FootingSprings]:
        return {
            line: springs_under(project, line, period if footing.period is None else footing.period, dimension)
            for line, footing in footings.items()
        }

    if all(footing.period is not None for footing in footings.values()):
        return at(inf)
    period = inf
    for _ in range(_MOST_ROUNDS):
        found = at(period)
        before = period
        period = first_period({line: replace(of, uplift=False, capacity=inf) for line, of in found.items()})
        if abs(period - before) <= _AGREEMENT * period:
            return found
    where = project.where(*project.support_keys(next(iter(footings)))[:-1])
    raise InputError(
        f"{where}: the period at which footings are taken and the first period of the frame on them do not settle "
        f"(last {before:.6g} s and {period:.6g} s); give the `period` of the footings [E-FOOT-01]"
    )


def springs_under(project: AnalysisFile, line: str, period: float, dimension: int) -> FootingSprings:
    """Return the footing under a line of columns at a period.

    Args:
        line: whose support is a footing.

    Raises:
        InputError: the tables of a code do not have the case of its soil, or no stiffness follows from its sides.
    """
    footing = project.footings[line]
    try:
        found = footing_springs(footing, project.soils[footing.soil], period, dimension)
        values = (*found.static, *found.stiffness, *found.dashpot, *found.radiation, found.mass, *found.inertia)
        usable = all(map(isfinite, values)) and min(found.stiffness) > 0.0
    except InputError as error:
        where = project.where("soils", footing.soil, "strain")
        raise InputError(f"{where}: soils.{footing.soil}.strain: {error}") from error
    except (OverflowError, ZeroDivisionError):
        usable = False
    if not usable:
        keys = (*project.support_keys(line), "footing")
        message = "its sides or its soil are so large or small that no stiffness follows from them [E-FOOT-01]"
        raise InputError(f"{project.where(*keys)}: {keys_text(keys)}: {message}")
    return found
