"""Response with upper and lower bounds of the dampers' properties, and which of them governs what."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Generic, TypeVar

import numpy as np

from edesign.codes.asce7 import largest_property_factor, smallest_property_factor
from edesign.project.dampers.designs import Bounds, ElastomerDesign
from edesign.study.design.building import Building
from edesign.study.design.condensed import LinearModes
from edesign.study.design.damping import strain_energy_damping
from edesign.study.design.elastomer import Material, Moduli
from edesign.study.design.estimate import Action, Estimate, FrameEstimate, estimate
from edesign.study.design.own_frequency import at_own_frequency
from edesign.study.design.own_strain import at_own_strain, effective_strain
from edesign.study.design.sizing import Sizing

NAMES = ("lower", "nominal", "upper")


E = TypeVar("E", bound=FrameEstimate)


@dataclass(frozen=True)
class Bound(Generic[E]):
    """The frame with one set of properties.

    Attributes:
        name: lower, nominal or upper.
        factor: property modification factor.
        temperature_C: of the dampers, degC; None: that of the design.
        stiffness_ratio: what the dampers have over what they have in the design, factor and temperature together.
        period: first period with braces, s.
        damping: that is added to the first mode, with braces.
        response: estimated.
    """

    name: str
    factor: float
    temperature_C: float | None
    stiffness_ratio: float
    period: float
    damping: float
    response: E


def property_factors(bounds: Bounds) -> tuple[float, float]:
    """Lower and upper property modification factor of a design: as given, or by ASCE/SEI 7-16, 18.2.4.5.

    With neither, only the temperatures change the properties.
    """
    low = high = 1.0
    if bounds.lower is not None:
        low = bounds.lower
    elif bounds.lower_factors is not None:
        low = smallest_property_factor(**bounds.lower_factors.model_dump())
    if bounds.upper is not None:
        high = bounds.upper
    elif bounds.upper_factors is not None:
        high = largest_property_factor(**bounds.upper_factors.model_dump())
    return low, high


def analyse_bounds(
    building: Building,
    sizing: Sizing,
    spec: ElastomerDesign,
    material: Callable[[float | None], Material],
    action: Action,
    share: float = 1.0,
) -> tuple[Bound[Estimate], ...]:
    """Estimate the response for the lower bound (at the highest temperature), the design, and the upper bound.

    Args:
        building: the frame with its places.
        sizing: the dampers.
        spec: the design, with factors and temperatures.
        material: the elastomer at a temperature (degC; None: that of the design).
        action: the spectrum.
        share: what the strain of histories is of the estimated one, where the strain is followed.

    Where the strain is followed, each bound has its own.
    """
    bounds = spec.bounds
    assert bounds is not None
    low, high = property_factors(bounds)
    cold, hot = bounds.temperatures if bounds.temperatures is not None else (None, None)
    cases = zip(NAMES, (low, 1.0, high), (hot, None, cold), strict=True)
    return tuple(_bound(building, sizing, spec, *case, material(case[2]), action, share) for case in cases)


def governing(found: tuple[Bound[E], ...], further: Mapping[str, Callable[[E], float]]) -> dict[str, str]:
    """The bound that makes each quantity largest, by the name of the quantity; `further` ones are of the method."""
    quantities: dict[str, Callable[[E], float]] = {
        "storey_drift": lambda r: float(r.drift.max()),
        "roof_displacement": lambda r: r.roof_displacement,
        "column_shear": lambda r: float(r.storey_shear.max()),
        "base_shear": lambda r: r.base_shear,
        "damper_force": lambda r: float(r.damper_force.max()),
        **further,
    }
    return {name: max(found, key=lambda b: of(b.response)).name for name, of in quantities.items()}


def _bound(
    building: Building,
    sizing: Sizing,
    spec: ElastomerDesign,
    name: str,
    factor: float,
    temperature_C: float | None,
    material: Material,
    action: Action,
    share: float,
) -> Bound[Estimate]:
    brace = None if sizing.brace is None else building.at_places(sizing.brace)

    def ratio(moduli: Moduli) -> float:
        return factor * moduli.G_storage / sizing.moduli.G_storage

    def solve(strain: float) -> tuple[Moduli, np.ndarray, LinearModes, Estimate]:
        moduli, at_places, modes = at_own_frequency(
            building, material(strain), lambda moduli: ratio(moduli) * sizing.stiffness, sizing.brace, sizing.frequency
        )
        return moduli, at_places, modes, estimate(building, action, at_places, brace, sizing.thickness)

    def reached(found: tuple[Moduli, np.ndarray, LinearModes, Estimate]) -> float:
        return share * effective_strain(building.at_places(sizing.stiffness), found[3].damper_strain)

    at = at_own_strain(spec, solve, lambda found: found[0], reached, sizing.strain)
    moduli, at_places, modes, response = at.found
    damping, period = float(strain_energy_damping(modes, at_places)[0]), 2.0 * np.pi / float(modes.omega[0])
    return Bound(name, factor, temperature_C, ratio(moduli), period, damping, response)
