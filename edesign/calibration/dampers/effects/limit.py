"""Limits of the force: relief valves, a part that slips or yields at a force of its own."""

from __future__ import annotations

from dataclasses import replace

from edesign.calibration.dampers.effect import EffectForm, both_sides
from edesign.calibration.dampers.mechanisms import CoreEffect
from edesign.calibration.form import shape, size

_BOTH = EffectForm(
    "limit",
    "force",
    "damper",
    "limit of the force, as by a relief valve,",
    "too much force at the peaks of the force alone, from one force on, at all amplitudes and frequencies",
    "relief valves: JSSI (2003), manual for passively controlled buildings; Kasai & Kibayashi (2004)",
    (CoreEffect("limit.force"),),
    # a limit above the largest force is none; of less than a tenth of it the law is another one
    lambda s: (
        replace(size("s", "", 0.5, 0.0, 1.0), whole=True),
        shape("F_l", "N", 0.6 * s.force, 0.1 * s.force, s.force, spread=0.5),
    ),
    lambda s: tuple((0.5, part * s.force) for part in (0.4, 0.75)),
    meanings={"s": "share of what is beyond the limit that is lost; 1: it is all", "F_l": "limit of the force"},
)
FORMS = (
    replace(_BOTH, title=f"{_BOTH.title} on both sides", constants=lambda _: {"side": 0.0}),
    *both_sides(_BOTH),
)
