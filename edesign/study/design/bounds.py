"""Response with upper and lower bounds of the dampers' properties, and which of them governs what."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

from edesign.codes.asce7 import largest_property_factor, smallest_property_factor
from edesign.project.dampers.designs import Bounds
from edesign.study.design.estimate import FrameEstimate


@dataclass(frozen=True)
class Bound:
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
    response: FrameEstimate


def property_factors(bounds: Bounds) -> tuple[float, float]:
    """Return the lower and upper property modification factor of a design: as given, or by ASCE/SEI 7-16, 18.2.4.5.

    With neither, only the temperatures change the properties.

    Returns:
        Lower and upper factor; 1 where the design gives none.
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


def analyse_bounds(bounds: Bounds, analyse: Callable[[str, float, float | None], Bound]) -> tuple[Bound, ...]:
    """Return the response with lower properties (at the highest temperature), those of the design, and upper ones.

    Args:
        bounds: of the design, with factors and temperatures.
        analyse: estimates the response of a bound by its name, factor and temperature (degC; None: of the design).
    """
    low, high = property_factors(bounds)
    cold, hot = bounds.temperatures if bounds.temperatures is not None else (None, None)
    cases = zip(("lower", "nominal", "upper"), (low, 1.0, high), (hot, None, cold), strict=True)
    return tuple(analyse(*case) for case in cases)


def governing(found: Sequence[Bound], further: Mapping[str, Callable[[FrameEstimate], float]]) -> dict[str, str]:
    """Return the bound of the properties that makes each response quantity largest.

    Args:
        found: the responses with lower, nominal and upper properties.
        further: quantities of the method beside those of every frame, as functions of a response, by name.

    Returns:
        The name of the governing bound, by the name of the quantity.
    """
    quantities: dict[str, Callable[[FrameEstimate], float]] = {
        "storey_drift": lambda r: float(r.drift.max()),
        "roof_displacement": lambda r: r.roof_displacement,
        "column_shear": lambda r: float(r.storey_shear.max()),
        "base_shear": lambda r: r.base_shear,
        "damper_force": lambda r: float(r.damper_force.max()),
        **further,
    }
    return {name: max(found, key=lambda b: of(b.response)).name for name, of in quantities.items()}
