"""Collapse of a frame in a history: the drift that is given for it passed, or equilibrium lost at a large one."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from edesign.core import Response
from edesign.study.results.recording import Quantity

LARGE_DRIFT = 0.05
"""Equilibrium that is lost at a larger drift is lost to collapse. Source: FEMA 356, Table C1-3, steel moment frames at
Collapse Prevention (thesis Table 5.5); frames that are merely hard to compute fail far below it."""


def drift_limits(drifts: Quantity, drift: float | None) -> dict[str, float]:
    """Return the limit of each channel of the drifts on column lines.

    Args:
        drifts: on all column lines, as `line_drifts` gives them.
        drift: drift ratio that counts as collapse; None: none does.

    Returns:
        The limit by name of the channel; empty without one.
    """
    return {} if drift is None else {channel.name: drift for channel in drifts.channels()}


def collapse_reason(response: Response, drifts: Quantity, words: Sequence[str]) -> str:
    """Return how a frame collapsed in words, "" if it did not.

    Args:
        response: of the history.
        drifts: on all column lines, as `line_drifts` gives them.
        words: what each of these drifts is.
    """
    if response.status not in ("limit", "failed"):
        return ""
    last = np.abs(drifts.extreme(response, "final"))
    worst = int(np.argmax(last))
    what, drift, time = words[worst], f"{100.0 * last[worst]:.3g} %", f"{response.end:.6g} s"
    if response.status == "limit":
        return f"collapsed: {what} reached {drift} at {time} [E-HIST-05]"
    if last[worst] <= LARGE_DRIFT:
        return ""
    return f"collapsed: equilibrium was lost at {time}, when the {what} was {drift} [E-HIST-05]; {response.reason}"
