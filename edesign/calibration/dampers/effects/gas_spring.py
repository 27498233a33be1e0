"""Gas in a fluid damper: it is compressed by the rod that comes in, and pushes it out."""

from __future__ import annotations

from dataclasses import replace

from edesign.calibration.dampers.effect import EffectForm
from edesign.calibration.dampers.mechanisms import CoreEffect
from edesign.calibration.form import size

_BETWEEN = 1.2  # exponent between that of slow motions, 1, and of fast ones, 1.4: their forces differ by a tenth

FLUID = ("viscous", "viscous_power", "asymmetric_viscous", "bilinear_oil", "maxwell", "maxwell_power")
"""Names of the laws of fluid dampers, in which there may be gas."""

_GAS = CoreEffect("gas_spring.polytropic")

PRESSED = replace(_GAS, more=lambda p: {"P": p["offset"], "c": 0.0, "n": _BETWEEN})
"""A constant force `offset`, as of gas so large that no motion compresses it."""

_POLYTROPIC = EffectForm(
    "gas_spring",
    "polytropic",
    "damper",
    "gas that is compressed by the rod",
    "a constant force, a stiffness, and more of both to one side: all the same at all rates",
    "polytropic change of a gas: Dixon (2007), The Shock Absorber Handbook, Wiley, section 5.11",
    (_GAS,),
    lambda s: (
        size("P", "N", 0.1 * s.force, -s.force, s.force),
        size("c", "1/m", 0.3 / s.displacement, -0.9 / s.displacement, 0.9 / s.displacement),
    ),
    lambda s: tuple((0.05 * s.force, at / s.displacement) for at in (-0.6, -0.2, 0.2, 0.6)),
    lambda s: {"n": _BETWEEN},
    laws=FLUID,
)

FORM = _POLYTROPIC
"""Of a gas that is the same in all tests."""

FORMS = (_POLYTROPIC,)
