"""Hysteresis of the path that the law lacks: parts that stiffen or soften on their way, or rub with stretch.

A part that yields at another deformation is `friction.presliding`: the equation is one.
"""

from __future__ import annotations

from dataclasses import replace

from edesign.calibration.dampers.acts import Amendment, Values
from edesign.calibration.dampers.effect import EffectForm, shape, size
from edesign.estimation.parameters import Parameter


def _beta(p: Values) -> Values:
    """Return beta as a share of gamma: the loops of all shares are as wide."""
    return {"beta": p["b"] * p["gamma"]}


_STRETCH = EffectForm(
    "hysteresis",
    "stretch",
    "damper",
    "friction or yielding whose force grows with the deformation",
    "loops that are wide at their tips and narrow in the middle, more than those of the law: the same at all rates",
    "friction in proportion to the deformation: Nims, Richter & Bachman (1993), Earthquake Spectra 9, 467-489; rounded "
    "as by Dahl (1976), AIAA Journal 14, 1675-1682",
    (Amendment("hysteresis.stretch"),),
    lambda s: (
        size("F_y", "N", 0.3 * s.force, 0.0, 10.0 * s.force),
        shape("Y", "m", 0.3 * s.displacement, 1e-3 * s.displacement, 10.0 * s.displacement),
        shape("n", "", 1.0, 0.3, 4.0, spread=0.5),
    ),
    lambda s: tuple((0.1 * s.force, part * s.displacement, 1.0) for part in (0.03, 0.1, 0.3, 1.0)),
    lambda s: {"r": s.displacement},
    meanings={"F_y": "force at which the part yields", "Y": "deformation over which it yields"},
)
_BOUC_WEN = replace(
    _STRETCH,
    form="bouc_wen",
    title="a part with hysteresis that stiffens or softens on its way",
    signature="loops that bend otherwise than those of the law on the way out or back: the same at all rates",
    source="Wen (1976), J. Eng. Mech. Div. 102, 249-263; hardening: Noel & Schoukens (2016), Workshop on Nonlinear "
    "System Identification Benchmarks",
    acts=(Amendment("hysteresis.bouc_wen", more=_beta),),
    parameters=lambda s: (
        size("k", "N/m", s.stiffness, 0.0, 50.0 * s.stiffness),
        shape("gamma", "1/m", 1.0 / s.displacement, 0.01 / s.displacement, 1e3 / s.displacement),
        # 0: friction.presliding; -1: no bend on the way out, and a stiffening one below; 1: none on the way back
        Parameter("b", "", -5.0, 1.0, 0.0, 1.0),
    ),
    starts=lambda s: tuple(
        (0.1 * s.stiffness * max(bend, 1.0), bend / s.displacement, b) for bend in (0.5, 2.0, 10.0) for b in (-1.5, 0.7)
    ),
    constants=lambda s: {},
)

FORMS = (_STRETCH, _BOUC_WEN)
