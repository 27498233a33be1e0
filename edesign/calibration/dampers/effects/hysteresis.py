"""Hysteresis of the path that the law lacks: what yields later than the rest, as parts of a steel damper do."""

from __future__ import annotations

from edesign.calibration.dampers.acts import Amendment, Values
from edesign.calibration.dampers.effect import EffectForm, shape, size


def _yielding(p: Values) -> Values:
    """Return the branch as friction that builds up over a way: the same equation."""
    return {"F_c": p["F_y"], "x0": p["Y"]}


_BRANCH = EffectForm(
    "hysteresis",
    "branch",
    "damper",
    "a part that yields at another deformation",
    "loops rounder at their corners, or stiffer beyond these, than those of the law: the same at all rates",
    "parallel elements that yield one after the other: Iwan (1966), J. Appl. Mech. 33, 893-900; rounded as by Dahl "
    "(1976), AIAA Journal 14, 1675-1682",
    (Amendment("friction.presliding", more=_yielding),),
    lambda s: (
        size("F_y", "N", 0.3 * s.force, 0.0, 10.0 * s.force),
        shape("Y", "m", 0.3 * s.displacement, 1e-3 * s.displacement, 10.0 * s.displacement),
    ),
    lambda s: tuple((0.1 * s.force, part * s.displacement) for part in (0.03, 0.1, 0.3, 1.0)),
    meanings={"F_y": "force at which the part yields", "Y": "deformation over which it yields"},
)

FORMS = (_BRANCH,)
