"""Pinching: bolts and plates slip through clearances that their largest deformation has opened."""

from __future__ import annotations

from dataclasses import replace

from edesign.calibration.dampers.effect import EffectForm
from edesign.calibration.dampers.mechanisms import CoreEffect
from edesign.calibration.form import shape, size

_SLIP = EffectForm(
    "pinching",
    "slip",
    "damper",
    "force that slips through the middle of the loops",
    "too much force in the middle of the loops, after a larger deformation alone: wider with that deformation",
    "Baber & Noori (1986), J. Vib. Acoust. Stress Reliab. Des. 108, 411-420; its zone a share of the largest "
    "deformation",
    (CoreEffect("pinching.slip"),),
    # at its bound the middle carries all but nothing: it slips
    lambda s: (replace(size("d", "", 0.5, 0.0, 0.98), whole=True), shape("w", "", 0.3, 0.02, 1.0, spread=0.7)),
    lambda s: tuple((0.2, w) for w in (0.1, 0.3, 0.6)),
)

FORMS = (_SLIP,)
