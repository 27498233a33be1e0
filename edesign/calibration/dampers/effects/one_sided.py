"""Unequal sides: the damper answers differently to the two directions."""

from __future__ import annotations

from dataclasses import replace

from edesign.calibration.dampers.effect import REFINED, EffectForm, both_sides, placed
from edesign.calibration.dampers.mechanisms import CoreEffect, Placement
from edesign.calibration.dampers.sizes import Sizes
from edesign.calibration.form import Words, shape, size
from edesign.estimation.parameters import Parameter

_TIPS = "too little force at the tips of one side of the loops alone: even multiples of the frequency"
_TOO_MUCH = "too much force at the tips of one side of the loops alone: even multiples of the frequency"


def _stiffness(s: Sizes) -> Parameter:
    return size("k", "N/m", s.stiffness, -5.0 * s.stiffness, 20.0 * s.stiffness)


def _begin(s: Sizes) -> Parameter:
    return Parameter("u0", "m", 0.0, 0.98 * s.displacement, 0.3 * s.displacement, 0.3 * s.displacement)


def _exponent(centre: float) -> Parameter:
    return Parameter("n", "", 1.0, 5.0, centre, 1.0)


_CONTACT = EffectForm(
    "one_sided",
    "contact",
    "damper",
    "contact that stiffens",
    _TIPS,
    "contact of curved bodies: Jankowski (2005), Earthquake Engng Struct. Dyn. 34, 595-611 (power 3/2)",
    (CoreEffect("one_sided.contact"),),
    lambda s: (_stiffness(s), _begin(s), _exponent(1.5)),
    lambda s: tuple((0.1 * s.stiffness / (1.0 - at) ** 2, at * s.displacement, 2.0) for at in (0.0, 0.4)),
    lambda s: {"r": s.displacement},
    negative=Words("softening that grows with deformation", _TOO_MUCH),
)
_SPRING = EffectForm(
    "one_sided",
    "spring",
    "damper",
    "contact or hardening",
    _TIPS,
    "contact by a one-sided spring: Jankowski (2005), Earthquake Engng Struct. Dyn. 34, 595-611 (linear case)",
    (CoreEffect("one_sided.spring"),),
    lambda s: (_stiffness(s), _begin(s)),
    lambda s: tuple((0.1 * s.stiffness / (1.0 - at), at * s.displacement) for at in (0.0, 0.3, 0.6, 0.8)),
    negative=Words("opening or softening", _TOO_MUCH),
)
_FACTOR = EffectForm(
    "one_sided",
    "factor",
    "damper",
    "larger or smaller force",
    "loops larger on one side than on the other by a share of the force, at all amplitudes",
    "phenomenological: a law with a stiffness for each side, as for cracked or partly debonded layers",
    (CoreEffect("one_sided.factor"),),
    lambda s: (size("b", "", 0.4, -0.9, 3.0),),
    lambda s: ((0.1,),),
    refined=4,  # it changes at once, within a step
)
_FORCE = replace(
    _FACTOR,
    form="force",
    title="larger or smaller force where the force is",
    signature="peaks of the force larger to one side than to the other by a share, at all amplitudes and frequencies",
    source="phenomenological: factors of tension and compression, as for bonded layers that are not alike in both",
    mechanisms=(CoreEffect("one_sided.force"),),
    refined=REFINED,  # the force has no jump
)
_VALVE = EffectForm(
    "one_sided",
    "valve",
    "damper",
    "larger or smaller force in motion",
    "loops higher in motion to one side than to the other, by a share of the force of the velocity",
    "valves of rebound and compression: Dixon (2007), The Shock Absorber Handbook, Wiley, chapter 7",
    (CoreEffect("one_sided.valve"),),
    lambda s: (
        size("b", "", 0.4, -0.9, 3.0),
        shape("v0", "m/s", 0.02 * s.velocity, 1e-3 * s.velocity, s.velocity),
    ),
    lambda s: tuple((0.1, part * s.velocity) for part in (0.01, 0.1)),
    refined=4,  # it changes where the velocity passes zero
)
_EVEN = EffectForm(
    "one_sided",
    "even",
    "damper",
    "stiffer with deformation to one side, softer to the other",
    "a force to the same side at both tips of the loops: even multiples of the frequency alone",
    "Kovacic & Brennan (2011), The Duffing Equation, Wiley, section 2.5 (Helmholtz-Duffing: n = 2)",
    (CoreEffect("one_sided.even"),),
    lambda s: (size("k", "N/m", 0.5 * s.stiffness, -20.0 * s.stiffness, 20.0 * s.stiffness), _exponent(2.0)),
    lambda s: ((0.1 * s.stiffness, 2.0),),
    lambda s: {"r": s.displacement},
)

FORMS = (
    *both_sides(_CONTACT),
    *both_sides(_SPRING),
    *(one for side in both_sides(_FACTOR) for one in placed(side, Placement.WHOLE, Placement.INSIDE)),
    *both_sides(_FORCE),
    *both_sides(_VALVE),
    placed(both_sides(_VALVE)[0], Placement.DASHPOTS)[0],
    _EVEN,
)
