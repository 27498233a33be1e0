"""Which campaign has which rig, and whether the damper hides something too: the same for a seed, however many."""

from __future__ import annotations

import numpy as np

from blind.effects import EFFECTS
from blind.plan import Planned

RIGS = ("none", "constant", "with_amplitude", "drifting", "second_order", "encoder_gain", "force_delay")
"""No lag at all; a pure delay: the same always, growing with the amplitude, changing over the campaign, behind a second
order, beside a gain of the encoder, beside a late load cell.
"""
_OFTEN = (4, 4, 2, 2, 4, 2, 2)
PATTERN = tuple(rig for i in range(4) for rig, often in zip(RIGS, _OFTEN, strict=True) if i < often)
"""Of twenty campaigns; every second time a kind comes, the damper hides an effect."""
EFFECTS_OF_DAMPER = tuple(
    name
    for name, forms in EFFECTS.items()
    if all(form.kind == "damper" and form.needs == "" for form in forms) or name == "friction"
)


def plan(number: int, seed: int) -> list[Planned]:
    """So many campaigns; their kind is that of the rig.

    Args:
        number: how many.
        seed: of the choice of effects.
    """
    rng = np.random.default_rng((seed, 11))
    made = dict.fromkeys(RIGS, 0)
    out = []
    for i in range(number):
        rig = PATTERN[i % len(PATTERN)]
        made[rig] += 1
        effect = (str(rng.choice(EFFECTS_OF_DAMPER)), int(rng.integers(12)))
        out.append(Planned(i + 1, rig, () if made[rig] % 2 else (effect,)))
    return out
