"""What work, path and time do to a damper: heat within a test, wear for good, ageing from test to test."""

from __future__ import annotations

import math
from dataclasses import replace

from edesign.calibration.dampers.effect import EffectForm, placed
from edesign.calibration.dampers.mechanisms import CoreEffect, Placement, Rest
from edesign.calibration.dampers.sizes import Sizes
from edesign.calibration.form import Rows, Words, fading, shape, size
from edesign.estimation.parameters import Parameter

KOHLRAUSCH = "Williams & Watts (1970), Trans. Faraday Soc. 66, 80-85 (Kohlrausch's stretched exponential)"
"""Source of what fades slower than exponentially."""

_LASTING = 100.0  # tests: heat that stays longer does not change within one
_LARGEST = 0.9  # change of the force by ageing up to the last test
_FACTORS = (Placement.WHOLE, Placement.SPRINGS, Placement.DASHPOTS)


def _several(s: Sizes) -> bool:
    return s.tests > 1 and s.ordered


def _heat(s: Sizes) -> tuple[Parameter, ...]:
    each = s.tests / s.work  # q = 1 by the work of one test
    return (
        size("beta", "1/J", 0.5 * each, 0.0, 20.0 * each),
        shape("tau_h", "s", s.duration, 0.3 * s.period, _LASTING * s.duration),
    )


def _heat_starts(s: Sizes) -> Rows:
    each, quick = s.tests / s.work, max(0.2 * s.duration, s.period)
    return (0.2 * each, quick), *((0.1 * each, times * s.duration) for times in (1.0, 3.0, _LASTING))


_RATE = EffectForm(
    "self_heating",
    "rate",
    "damper",
    "softening by self-heating within a test",
    "the force falls with the work done within a test, fastest in large and fast tests, comes back in pauses, and is "
    "whole again in the next test",
    "Kasai, Munshi, Lai & Maison (1993), ATC-17-1; lumped heat balance, Incropera & DeWitt, Fundamentals of Heat and "
    "Mass Transfer, section 5.1",
    (CoreEffect("self_heating.rate"),),
    _heat,
    _heat_starts,
    meanings={"rest": "how long the specimen rests between two tests"},
)
_CARRIED = replace(
    _RATE,
    form="carried",
    title="softening by self-heating, part of which lasts into the next test",
    signature="as self_heating.rate, and a test that follows a heavy one begins with too little force",
    mechanisms=(*_RATE.mechanisms, Rest("rest")),
    parameters=lambda s: (*_heat(s), shape("rest", "s", s.duration, 1e-2 * s.duration, 1e3 * s.duration)),
    starts=lambda s: tuple((*row, 0.7 * row[1]) for row in _heat_starts(s)),
    shown=_several,
)
_ENERGY = EffectForm(
    "degradation",
    "energy",
    "damper",
    "lasting degradation by dissipated energy",
    "the force falls within heavy tests and stays so in all later ones: a test repeated at the end is softer",
    "Baber & Wen (1981), J. Eng. Mech. Div. ASCE 107, 1069-1087 (energy); Simo (1987) (exponential saturation); "
    f"q: {KOHLRAUSCH}",
    (CoreEffect("degradation.energy"),),
    lambda s: (size("d", "", 0.5, -0.95, 0.95), shape("E0", "J", 0.3 * s.work, 1e-3 * s.work, 1e2 * s.work), fading()),
    lambda s: (*((0.1, part * s.work, 1.0) for part in (0.02, 0.1, 0.5)), (0.3, 3.0 * s.work, 1.0)),
    negative=Words(
        "lasting cyclic hardening by dissipated energy",
        "the force grows within heavy tests and stays so in all later ones: a test repeated at the end is stiffer",
    ),
)
_PATH = EffectForm(
    "degradation",
    "path",
    "damper",
    "lasting degradation by the path travelled",
    "the force falls from test to test with the path travelled, small amplitudes counting as much as large ones",
    "wear by travelled path: Archard (1953), J. Appl. Phys. 24, 981-988; Simo (1987) (exponential saturation); "
    f"q: {KOHLRAUSCH}",
    (CoreEffect("degradation.path"),),
    lambda s: (size("d", "", 0.5, -0.95, 0.95), shape("s0", "m", 0.3 * s.path, 1e-3 * s.path, 1e2 * s.path), fading()),
    lambda s: (*((0.1, part * s.path, 1.0) for part in (0.02, 0.1, 0.5)), (0.3, 3.0 * s.path, 1.0)),
    negative=Words(
        "lasting cyclic hardening by the path travelled",
        "the force grows from test to test with the path travelled, small amplitudes counting as much as large ones",
    ),
)


def _rate(s: Sizes, last: float) -> tuple[Parameter, ...]:
    return (size("rate", "", 0.3 / last, -_LARGEST / last, 10.0 * _LARGEST / last),)


_LINEAR = EffectForm(
    "ageing",
    "linear",
    "damper",
    "ageing by as much from test to test",
    "a factor of the force, constant within a test, that depends on the order of the tests",
    "phenomenological: first order in the number of tests; ISO 22762-1:2018, 6.6 (ageing)",
    (CoreEffect("constant", factor=lambda p, test: 1.0 + p["rate"] * test.order),),
    lambda s: _rate(s, s.tests - 1.0),
    lambda s: ((0.1 / (s.tests - 1.0),),),
    shown=lambda s: s.between,
)
_LOGARITHMIC = replace(
    _LINEAR,
    form="logarithmic",
    title="ageing that slows down from test to test",
    source="physical ageing follows the logarithm of time: Struik (1978), Physical Aging in Amorphous Polymers",
    mechanisms=(CoreEffect("constant", factor=lambda p, test: 1.0 + p["rate"] * math.log1p(test.order / p["n0"])),),
    # where n0 is small most of it has come with the second test
    parameters=lambda s: (*_rate(s, math.log1p(s.tests - 1.0)), shape("n0", "", 1.0, 1e-3, 1e2)),
    starts=lambda s: tuple((0.1 / math.log1p((s.tests - 1.0) / n0), n0) for n0 in (0.01, 0.3, 3.0)),
    shown=lambda s: s.between,
)

FORMS = (
    _RATE,
    *placed(_CARRIED, *_FACTORS),
    *placed(_ENERGY, *_FACTORS),
    *placed(_PATH, *_FACTORS),
    *placed(_LINEAR, *_FACTORS),
    _LOGARITHMIC,
)
