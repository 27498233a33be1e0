"""How much the equations of effects may miss: what is left below that is none of another effect."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from edesign.calibrate.evidence import Judged
from edesign.calibrate.problem import PredictionError

_SMALL, _MISSED = 0.01, 5e-4
"""Shares of all that the refitted law leaves over noise, and of what the effects found before do to the force: below
the larger stands what the equations of these effects miss.
"""
_NEARLY_ALL = 0.8  # of what is left over noise
_TOLD = 0.25  # of the noise: of less that is left a share says little


def more_than_misses(current: Judged, left: Sequence[np.ndarray]) -> bool:
    """Whether more is left than what the equations of the known effects may miss."""
    return current.fitted.chi2 - current.fitted.samples >= may_miss(current, left)


def may_miss(current: Judged, left: Sequence[np.ndarray]) -> float:
    """Sum of squares that the equations of the known effects may miss: what is each test's own, as a tone is, has
    none that others could make up for.
    """
    fitted = current.fitted
    bare = replace(fitted.model, effects=())
    shared = fitted.shared(left)
    material = _SMALL * (sum(float(r @ r) for r in shared) - fitted.samples)
    try:
        without = fitted.shared(bare.residuals(fitted.x[: len(bare.base)]))
    except PredictionError:
        return material
    done = sum(float((w - r) @ (w - r)) for w, r in zip(without, fitted.residuals, strict=True))
    return max(material, _MISSED * done)


def matters(judged: Judged, current: Judged, left: Sequence[np.ndarray]) -> bool:
    """Whether what new effects remove is more than the equations of the known ones may miss, or nearly all that is
    left, as no other effect does with the errors of an equation; further forms of the known ones may do less.
    """
    known = {effect.name for effect in current.fitted.model.effects}
    new = any(effect.name not in known for effect in judged.fitted.model.effects)
    removed = current.fitted.chi2 - judged.fitted.chi2
    return not new or removed >= min(may_miss(current, left), nearly_all(current))


def nearly_all(current: Judged) -> float:
    """Sum of squares that is nearly all that is left; none is where that is far less than noise."""
    excess = current.fitted.chi2 - current.fitted.samples
    return _NEARLY_ALL * excess if excess > _TOLD * current.fitted.samples else math.inf
