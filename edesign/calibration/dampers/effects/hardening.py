"""Hardening at large strain: the chains of the rubber come to their length."""

from __future__ import annotations

import math
from functools import partial

from edesign.calibration.dampers.effect import EffectForm, placed
from edesign.calibration.dampers.mechanisms import CoreEffect, Placement
from edesign.calibration.dampers.sizes import Sizes
from edesign.calibration.form import Values, Words, shape, size
from edesign.estimation.parameters import Parameter

_TOO_MUCH = "too much force at the tips of large loops alone, odd in the deformation, the same at all frequencies"
_SIGNATURE = "too little force at the tips of large loops alone, odd in the deformation, the same at all frequencies"


def _at_zero(p: Values) -> Values:
    """Return k of an exponential spring that is given by its secant stiffness at r."""
    return {"k": p["k_r"] / math.expm1((p["r"] / p["u0"]) ** 2)}


def _at_rest(p: Values) -> Values:
    """Return k of a spring that is given by the force at which it saturates."""
    return {"k": p["F_s"] / p["u0"]}


def _to(side: float, _: Values) -> Values:
    """Return the side of a contact."""
    return {"side": side}


def _spring(s: Sizes) -> Parameter:
    return size("k", "N/m", 0.5 * s.stiffness, -2.0 * s.stiffness, 5.0 * s.stiffness)


_POWER = EffectForm(
    "hardening",
    "power",
    "damper",
    "elastic hardening at large strain",
    _SIGNATURE,
    "odd power of the simple shear of Yeoh (1990), Rubber Chem. Technol. 63, 792-805, with a free exponent",
    (CoreEffect("hardening.power"),),
    lambda s: (_spring(s), shape("p", "", 3.0, 1.5, 15.0, spread=0.7)),
    lambda s: tuple((0.1 * s.stiffness, p) for p in (2.0, 3.0, 5.0, 9.0)),
    lambda s: {"r": s.displacement},
    negative=Words("elastic softening at large strain", _TOO_MUCH),
)
_THRESHOLD = EffectForm(
    "hardening",
    "threshold",
    "damper",
    "a second stiffness beyond a deformation",
    _SIGNATURE,
    "bilinear hardening of high damping rubber: Grant, Fenves & Whittaker (2004), J. Struct. Eng. 130, 1683-1693",
    (CoreEffect("hardening.threshold"),),
    lambda s: (
        size("k", "N/m", s.stiffness, -5.0 * s.stiffness, 20.0 * s.stiffness),
        Parameter("u0", "m", 0.0, 0.98 * s.displacement, 0.5 * s.displacement, 0.3 * s.displacement),
    ),
    lambda s: tuple((0.1 * s.stiffness / (1.0 - at), at * s.displacement) for at in (0.3, 0.6, 0.8)),
    negative=Words("less stiffness beyond a deformation", _TOO_MUCH),
)
_CONTACT = EffectForm(
    "hardening",
    "contact",
    "damper",
    "contact that stiffens, on both sides",
    _SIGNATURE,
    "contact of curved bodies: Jankowski (2005), Earthquake Engng Struct. Dyn. 34, 595-611 (power 3/2)",
    tuple(CoreEffect("one_sided.contact", more=partial(_to, side)) for side in (1.0, -1.0)),
    lambda s: (
        size("k", "N/m", s.stiffness, -5.0 * s.stiffness, 20.0 * s.stiffness),
        Parameter("u0", "m", 0.0, 0.98 * s.displacement, 0.3 * s.displacement, 0.3 * s.displacement),
        Parameter("n", "", 1.0, 5.0, 1.5, 1.0),
    ),
    lambda s: tuple((0.1 * s.stiffness / (1.0 - at) ** 2, at * s.displacement, 2.0) for at in (0.3, 0.6)),
    lambda s: {"r": s.displacement},
    meanings={
        "k": "secant stiffness at r beyond u0",
        "u0": "deformation at which it begins",
        "n": "power of the approach: 3/2 of round bodies (Hertz)",
    },
    negative=Words("softening that grows beyond a deformation, on both sides", _TOO_MUCH),
)
_EXPONENTIAL = EffectForm(
    "hardening",
    "exponential",
    "damper",
    "exponential hardening at large strain",
    _SIGNATURE,
    "Fung (1993), Biomechanics: Mechanical Properties of Living Tissues, section 7.5",
    (CoreEffect("hardening.exponential", more=_at_zero),),
    lambda s: (
        size("k_r", "N/m", 0.5 * s.stiffness, -2.0 * s.stiffness, 5.0 * s.stiffness),
        shape("u0", "m", s.displacement, 0.3 * s.displacement, 5.0 * s.displacement, spread=0.7),
    ),
    lambda s: tuple((0.1 * s.stiffness, at * s.displacement) for at in (0.5, 1.0)),
    lambda s: {"r": s.displacement},
    meanings={"k_r": "of the added spring at the largest displacement: force over displacement"},
    negative=Words("exponential softening at large strain", _TOO_MUCH),
)
_SATURATING = EffectForm(
    "hardening",
    "saturating",
    "damper",
    "a spring that is stiff at first and saturates",
    "too little force at small deformation, odd in it, and the same beyond; the same at all frequencies",
    "hyperbolic tangent of a spring: API RP 2A-WSD, section 6.8.7",
    (CoreEffect("hardening.saturating", more=_at_rest),),
    lambda s: (
        size("F_s", "N", 0.3 * s.force, -2.0 * s.force, 2.0 * s.force),
        # in much less than the motion it jumps, as friction does; in much more it is the law's own spring
        shape("u0", "m", 0.2 * s.displacement, 0.01 * s.displacement, 2.0 * s.displacement, spread=0.7),
    ),
    lambda s: tuple((0.1 * s.force, at * s.displacement) for at in (0.05, 0.2, 0.5)),
    meanings={"F_s": "force that the spring comes to"},
    negative=Words(
        "less stiffness at small deformation",
        "too much force at small deformation, odd in it, and the same beyond; the same at all frequencies",
    ),
)

FORMS = (*placed(_POWER, Placement.WHOLE, Placement.INSIDE), _THRESHOLD, _CONTACT, _EXPONENTIAL, _SATURATING)
