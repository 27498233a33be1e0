"""What makes dampers of any method implausible although the procedure gives them, and the range that needs no word."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any

import numpy as np
import scipy

from edesign.codes.asce7 import largest_property_factor, smallest_property_factor
from edesign.project.dampers.designs import Bounds, SizedDesign
from edesign.project.reading.words import percent
from edesign.study.design.bounds import property_factors
from edesign.study.design.condensed import LinearModes
from edesign.study.design.device_model import Sizing
from edesign.study.design.loop import Search
from edesign.study.design.reach import REACHABLE

ROUNDING = 1e-6  # of shares and ratios
_SHARED = 0.5  # of the largest share: the mean says little of either
_AT_LIMIT = 1e-5  # relative, of a drift that a search has led to its limit
_LEAST_SHARE = 1e-3  # of the dampers, from which a share with the same damping is looked for
_SHARES = np.geomspace(_LEAST_SHARE, 1.0, 61)


def beyond_the_optimum(damping: Callable[[float], float], what: str) -> Iterator[str]:
    """Say so if a smaller share of the dampers adds as much damping to the first mode.

    Args:
        damping: ratio of the first mode with a share of the dampers.
        what: the dampers are made of, or have, in that share.
    """
    present = damping(1.0)
    known = [damping(share) for share in _SHARES.tolist()]
    above = next(i for i, value in enumerate(known) if value >= present * (1.0 - 1e-12))
    if above in (0, len(known) - 1):
        return
    low, high = _SHARES[above - 1 : above + 1]
    share = float(scipy.optimize.brentq(lambda x: damping(x) - present, low, high, rtol=ROUNDING))
    yield (
        f"the dampers are beyond the size that adds most damping to the first mode ({percent(max(known))} with "
        f"braces): they add {percent(present)}, and {100.0 * share:.3g} % of the {what} would add as much"
    )


def shared_mode(modes: LinearModes, damping: np.ndarray) -> Iterator[str]:
    """Say so if modes of a building share the direction of a design, whose target is the mean of their damping.

    Args:
        damping: ratio that the dampers add to each, (n,).
    """
    share = modes.lead.share
    first, other = np.argsort(-share, kind="stable")[:2] if share.size > 1 else (0, 0)
    if share[other] > _SHARED * share[first] and other != first:
        yield (
            f"modes {first + 1} and {other + 1} with dampers share the direction, {percent(share[first])} and "
            f"{percent(share[other])} of it: torsion or nearly equal periods couple them. The dampers add "
            f"{percent(damping[first])} and {percent(damping[other])} to them by strain energy, and the target is of "
            "the mean over the modes"
        )


def short_of_target(sizing: Sizing) -> list[str]:
    """Return a warning where the estimate knows no dampers that reach the target damping, and histories decide."""
    if not sizing.short:
        return []
    return [
        f"the dampers add {percent(sizing.reached)} to the first mode, not the {percent(sizing.target)} of the target: "
        f"the estimate says that about {percent(sizing.reached / REACHABLE)} is the most behind these braces and with "
        "this distribution"
    ]


def estimate_warnings(spec: SizedDesign, done: Search[Any], drift: float) -> list[str]:
    """Return warnings: an estimate asks for more dampers than histories judged, or rounds were too few.

    Args:
        done: all rounds and the chosen one.
        drift: the largest storey drift over height that is estimated.
    """
    outcome, limit, verify = done.chosen.outcome, spec.drift, spec.verify
    if verify is not None and outcome is not None and outcome.met and outcome.drift:  # searched storey by storey
        last = len(done.rounds)
        few = f"all {last} `rounds` were used: more may find a smaller sum of the dampers"
        return [few] if last >= verify.rounds else []
    judged = outcome is not None and outcome.met
    if limit is None or verify is None or judged or drift <= (1.0 + _AT_LIMIT) * limit:
        return []
    found = f"the estimated drift is {100.0 * drift:.4g} %, more than {100.0 * limit:.4g} %"
    return [f"{found}; that is an estimate, and histories decide"]


def spread(bounds: Bounds | None) -> tuple[float, float, str]:
    """Return the range of properties that a design covers, by its own bounds or the least range of ASCE/SEI 7-16.

    Args:
        bounds: of the design; None: it has none.

    Returns:
        The lower and the upper factor, and where they come from.
    """
    low, high = (1.0, 1.0) if bounds is None else property_factors(bounds)
    if low < 1.0 < high:
        return low, high, "the bounds of the design"
    return smallest_property_factor(), largest_property_factor(), "the least bounds of ASCE/SEI 7-16, 18.2.4.5"
