"""The parameters of a damper law as unknowns of the loop."""

from __future__ import annotations

import math
from collections.abc import Mapping

from edesign.calibrate.dampers.trial import Sizes
from edesign.calibrate.unknown import Unknown
from edesign.damper.fitting.identifiable import HELD, LIMITED_BY, why_held
from edesign.damper.fitting.scales import Scales
from edesign.damper.law import Law, Parameter

_FARTHEST = 1e3  # times a declared value, or a part of it: laws without a scale are none that anybody declares
_INSIDE = 1e-9  # share of a size that is kept from a bound which is not allowed itself


def law_unknowns(law: Law, declared: Mapping[str, float], sizes: Sizes) -> tuple[Unknown, ...]:
    """Unknowns for the parameters of a law that data can tell, about the declared ones. Those that others make needless
    are held as declared, as `edesign fit` holds them.

    A positive one is searched by its logarithm, in units of its declared value, up to a thousand times that or a
    thousandth of it; one that is zero in units that the
    campaign suggests.
    """
    scales = Scales(sizes.force, sizes.displacement, sizes.velocity)
    held = held_parameters(law)
    return tuple(
        _unknown(parameter, declared, scales)
        for parameter in law.all_parameters(declared)
        if parameter.fitted and parameter.name not in held
    )


def held_parameters(law: Law) -> dict[str, str]:
    """Parameters of a law that are held as others make them needless, with the reason. Those that limit others where
    they are held above zero, as a declared law has them, are not: k0 and c_b of the MGMM.
    """
    limiting = LIMITED_BY.get(law.name, {}).values()
    return {name: why_held(law, name) for name in HELD.get(law.name, {}) if name not in limiting}


def _unknown(parameter: Parameter, declared: Mapping[str, float], scales: Scales) -> Unknown:
    value = declared[parameter.name]
    size = abs(value) if value else scales.of(parameter.unit, declared)
    lower = parameter.lower + (0.0 if parameter.lower_allowed or math.isinf(parameter.lower) else _INSIDE * size)
    upper = parameter.upper - (0.0 if parameter.upper_allowed or math.isinf(parameter.upper) else _INSIDE * size)
    logarithmic = value > 0.0 and lower >= 0.0
    if logarithmic:
        lower, upper = max(lower, value / _FARTHEST), min(upper, value * _FARTHEST)
    return Unknown(parameter.name, parameter.unit, lower, upper, size, logarithmic=logarithmic)
