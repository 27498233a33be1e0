"""Limits of the force: relief valves, a part that slips or yields at a force of its own, the end of a load cell.

What a valve lets pass still makes some force, while a reading at its end is flat. So a share that is lost of what is
beyond, and that is all, is one parameter less, and a force that is flat the end of the channel first of all.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from edesign.calibration.dampers.effect import EffectForm, both_sides, either
from edesign.calibration.dampers.experiment import Experiment
from edesign.calibration.dampers.mechanisms import CoreEffect, ForceChannel
from edesign.calibration.dampers.motion import Motion
from edesign.calibration.dampers.sizes import Sizes
from edesign.calibration.form import Values, shape, size
from edesign.estimation.parameters import Parameter


def _limit(s: Sizes) -> Parameter:
    """Return a force: a limit above the largest one is none; of less than a tenth of it the law is another one."""
    return shape("F_l", "N", 0.6 * s.force, 0.1 * s.force, s.force, spread=0.5)


def _flat(p: Values, test: Experiment, motion: Motion, force: np.ndarray) -> np.ndarray:
    return np.clip(force, -p["F_l"], p["F_l"])


def _all_of_it(p: Values) -> Values:
    return {"s": 1.0, "side": 0.0}


_BOTH = EffectForm(
    "limit",
    "force",
    "damper",
    "limit of the force, as by a relief valve,",
    "too much force at the peaks of the force alone, from one force on, at all amplitudes and frequencies",
    "relief valves: JSSI (2003), manual for passively controlled buildings; Kasai & Kibayashi (2004)",
    (CoreEffect("limit.force"),),
    lambda s: (replace(size("s", "", 0.5, 0.0, 1.0), whole=True), _limit(s)),
    lambda s: tuple((0.5, part * s.force) for part in (0.4, 0.75)),
    meanings={"s": "share of what is beyond the limit that is lost; 1: it is all", "F_l": "limit of the force"},
)
_RANGE = replace(
    _BOTH,
    form="range",
    kind="instrument",
    title="end of the range of the load cell or its amplifier, under other noise,",
    signature="no force beyond one force, the same in all tests: peaks are flat",
    source="Doebelin, Measurement Systems, chapter 3 (saturation)",
    mechanisms=(ForceChannel(_flat),),
    parameters=lambda s: (_limit(s),),
    starts=lambda s: tuple((part * s.force,) for part in (0.4, 0.75, 0.95)),
    meanings={"F_l": "largest reading of either side"},
)
FORMS = (
    either(
        _RANGE,
        "limit of the force on both sides, beyond which it does not grow at all,",
        (CoreEffect("limit.force", more=_all_of_it),),
    ),
    replace(_BOTH, title=f"{_BOTH.title} on both sides", constants=lambda _: {"side": 0.0}),
    *both_sides(_BOTH),
)
