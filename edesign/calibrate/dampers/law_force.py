"""Force of a law alone in a test: a search asks for it in the same motions with thousands of sets of parameters."""

from __future__ import annotations

from collections.abc import Mapping
from functools import lru_cache

import numpy as np

from edesign.calibrate.dampers.mgmm_moments import by_moments
from edesign.calibrate.dampers.trial import Motion
from edesign.calibrate.problem import PredictionError
from edesign.core import CoreError
from edesign.core.damper import CoreDamper
from edesign.damper.history import Extremes
from edesign.damper.law import Law

_KEPT = 512  # histories: of some sets of parameters


def law_force(
    law: Law, values: Mapping[str, float], motion: Motion, been: Extremes, v_ref: float | None = None
) -> np.ndarray:
    """Force (n,) N.

    Args:
        law: of the parameters.
        values: all parameters, in the order of the core, SI.
        motion: of the specimen.
        been: what it went through before, if the law remembers it.
        v_ref: about 1e-7 of which an MGMM rounds the power of the velocity, m/s; the same for all values spares time,
            and hardly matters. None: as the values have it.

    Raises:
        PredictionError: there is none.
    """
    if motion.with_onset is not None:
        whole, own = motion.with_onset
        return law_force(law, values, whole, been, v_ref)[own]
    if motion.passing:
        return _force(law.name, tuple(values.values()), motion, been)
    return _kept_force(law.name, tuple(values.items()), motion, been, v_ref)


def _force(law: str, values: tuple[float, ...], motion: Motion, been: Extremes) -> np.ndarray:
    try:
        return CoreDamper(law, values, been=been).force(motion.time, motion.displacement, motion.velocity)
    except CoreError as error:
        raise PredictionError(str(error)) from error


@lru_cache(maxsize=_KEPT)
def _kept_force(
    law: str, values: tuple[tuple[str, float], ...], motion: Motion, been: Extremes, v_ref: float | None
) -> np.ndarray:
    asked = _asked(motion, been)
    asked[0] += 1
    p = dict(values)
    try:
        force = by_moments(p, motion, been, v_ref) if law == "mgmm" and asked[0] > 1 else None
    except CoreError as error:
        raise PredictionError(str(error)) from error
    if force is None:
        force = _force(law, tuple(p.values()), motion, been)
    force.setflags(write=False)
    return force


@lru_cache(maxsize=_KEPT)
def _asked(motion: Motion, been: Extremes) -> list[int]:
    """How often a motion has been asked for with other parameters: moments are not worth while for once."""
    return [0]
