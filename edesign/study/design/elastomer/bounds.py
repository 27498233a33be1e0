"""Response with the bounds of an elastomer, at the temperature, frequency and strain of each."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from edesign.project.dampers.designs import ElastomerDesign
from edesign.study.design.bounds import NAMES, Bound, property_factors
from edesign.study.design.building import Building
from edesign.study.design.condensed import LinearModes
from edesign.study.design.damping import strain_energy_damping
from edesign.study.design.elastomer.material import Material, Moduli
from edesign.study.design.elastomer.own_frequency import at_own_frequency
from edesign.study.design.elastomer.own_strain import at_own_strain, effective_strain
from edesign.study.design.elastomer.sizing import Sizing
from edesign.study.design.estimate import Action, Estimate, estimate


def analyse_bounds(
    building: Building,
    sizing: Sizing,
    spec: ElastomerDesign,
    material: Callable[[float | None], Material],
    action: Action,
    share: float = 1.0,
) -> tuple[Bound[Estimate], ...]:
    """Estimate the response for the lower bound (at the highest temperature), the design, and the upper bound.

    Where the strain is followed, each bound has its own.

    Args:
        building: the frame with its places.
        sizing: the dampers.
        spec: the design, with factors and temperatures.
        material: the elastomer at a temperature (degC; None: that of the design).
        action: the spectrum.
        share: what the strain of histories is of the estimated one, where the strain is followed.
    """
    bounds = spec.bounds
    assert bounds is not None
    low, high = property_factors(bounds)
    cold, hot = bounds.temperatures if bounds.temperatures is not None else (None, None)
    cases = zip(NAMES, (low, 1.0, high), (hot, None, cold), strict=True)
    return tuple(_bound(building, sizing, spec, *case, material(case[2]), action, share) for case in cases)


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
