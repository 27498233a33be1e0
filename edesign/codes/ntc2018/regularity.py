"""Regularity of buildings in elevation, NTC 2018, 7.2.1; changes of mass and stiffness are in `ec8.regularity`."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from edesign.codes.rule_check import RuleCheck, at_most

SETBACK, OF_FIRST = 0.10, 0.30
"""Setback of a storey over the dimension of the one below, and over that of the first. Source: NTC 2018, 7.2.1 g."""
ROOF_EXEMPT = 4
"""So many storeys have a last one that may be set back freely. Source: NTC 2018, 7.2.1 g."""
CLAUSE = "4.2.3.3(5)"
"""Of EN 1998-1, by which setbacks are known in the rules of a building."""


def setbacks(lower: ArrayLike, upper: ArrayLike, top: ArrayLike) -> tuple[RuleCheck, ...]:
    """Check the setbacks of the building in one horizontal direction: each at most 10 % of the storey below.

    Nor may a storey be smaller than the first one by more than 30 %. The last of at least four storeys is exempt.

    Args:
        lower: (n_storeys,) coordinate of the lower face of each storey, from the lowest storey up, m.
        upper: (n_storeys,) coordinate of the upper face, m.
        top: (n_storeys,) level of the top of each storey, m; does not count.

    Returns:
        The criteria of both; none where nothing is set back.

    Source: NTC 2018, 7.2.1 g.
    """
    width = np.asarray(upper, dtype=float) - np.asarray(lower, dtype=float)
    counted = width[:-1] if width.size >= ROOF_EXEMPT else width
    if counted.size < 2 or not (np.diff(counted) < -1e-6 * counted[:-1]).any():
        return ()
    each, whole = 1.0 - counted[1:] / counted[:-1], 1.0 - counted[1:] / counted[0]
    worst, most = int(each.argmax()), int(whole.argmax())
    below, first = "setback over the plan below", "setback over the plan of the first storey"
    return (
        at_most(CLAUSE, below, SETBACK, float(each[worst]), f"above storey {worst + 1}"),
        at_most(CLAUSE, first, OF_FIRST, float(whole[most]), f"storey {most + 2}"),
    )
