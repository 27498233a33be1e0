"""Hysteresis of the path that the law lacks: friction or yielding that grows with stretch.

A part that yields at another deformation is `friction.presliding`: the equation is one.
"""

from __future__ import annotations

from edesign.calibration.dampers.effect import EffectForm
from edesign.calibration.dampers.mechanisms import CoreEffect
from edesign.calibration.form import shape, size

_STRETCH = EffectForm(
    "hysteresis",
    "stretch",
    "damper",
    "friction or yielding whose force grows with the deformation",
    "loops that are wide at their tips and narrow in the middle, more than those of the law: the same at all rates",
    "friction in proportion to the deformation: Nims, Richter & Bachman (1993), Earthquake Spectra 9, 467-489; rounded "
    "as by Dahl (1976), AIAA Journal 14, 1675-1682",
    (CoreEffect("hysteresis.stretch"),),
    lambda s: (
        size("F_y", "N", 0.3 * s.force, 0.0, 10.0 * s.force),
        shape("Y", "m", 0.3 * s.displacement, 1e-3 * s.displacement, 10.0 * s.displacement),
        shape("n", "", 1.0, 0.3, 4.0, spread=0.5),
    ),
    lambda s: tuple((0.1 * s.force, part * s.displacement, 1.0) for part in (0.03, 0.1, 0.3, 1.0)),
    lambda s: {"r": s.displacement},
    meanings={"F_y": "force at which the part yields", "Y": "deformation over which it yields"},
)
FORMS = (_STRETCH,)
