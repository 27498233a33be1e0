"""A damper behind a rig in one test, as a campaign of the core has it."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from edesign.core import CampaignTest, CoreDamper, CoreError, SeriesRig, campaign_forces

BESIDE = ("factor", "added", "spring")
METHOD = ("method", "length")


def force_in_series(
    damper: CoreDamper,
    time: ArrayLike,
    deformation: ArrayLike,
    velocity: ArrayLike,
    stiffness: float,
    play: float = 0.0,
    **options: Any,
) -> tuple[np.ndarray, np.ndarray]:
    """Return the force through rig and damper (n,) N, and the damper's own deformation (n,) m.

    Args:
        damper: behind the rig.
        time: (n,) s.
        deformation: (n,) m, of both.
        velocity: (n,) m/s.
        stiffness: of the rig, N/m.
        play: of its pins, m.
        options: more of the rig, of what stands beside the damper, of the method.

    Raises:
        CoreError: the core refuses the test, or the damper fails in it.
    """
    beside, method = ({name: options.pop(name) for name in names if name in options} for names in (BESIDE, METHOD))
    test = CampaignTest(time, deformation, velocity, rig=SeriesRig(stiffness, play, **options), **beside)
    found = campaign_forces([damper], [test], own=True, threads=1, **method)
    if found.failed:
        raise CoreError("ED_E_NOT_CONVERGED", found.failed[0])
    assert found.own is not None
    return found.force[0][0], found.own[0][0]
