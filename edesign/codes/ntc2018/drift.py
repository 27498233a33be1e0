"""Stiffness of buildings at the serviceability limit states, NTC 2018, 7.3.6.1."""

from __future__ import annotations

from edesign.codes.ec8.verification.drift import drift_limit
from edesign.codes.names import unknown
from edesign.codes.ntc2018.return_period import CLASS_OF_USE

ORDINARY = ("I", "II")
"""Classes of use whose drifts are looked at under SLD; those of the others under SLO. Source: NTC 2018, 7.3.6.1."""
STRATEGIC_SHARE = 2.0 / 3.0
"""Of the limits, for classes III and IV. Source: NTC 2018, 7.3.6.1."""


def limit_state_of_drift(class_of_use: str) -> str:
    """Return the limit state whose drifts are limited, SLD or SLO.

    Args:
        class_of_use: I to IV.

    Raises:
        InputError: there is no such class.

    Source: NTC 2018, 7.3.6.1 and Table 7.3.III.
    """
    if class_of_use not in CLASS_OF_USE:
        raise unknown("class of use", class_of_use, CLASS_OF_USE)
    return "SLD" if class_of_use in ORDINARY else "SLO"


def limit_of_drift(elements: str, class_of_use: str) -> float:
    """Return the limit of q d_r / h.

    Args:
        elements: `brittle` 0.0050, `ductile` 0.0075; `none_attached` 0.0100 of infills that drifts cannot damage.
        class_of_use: I to IV; in III and IV two thirds.

    Raises:
        InputError: there is no such kind, or no such class.

    Source: NTC 2018, 7.3.6.1, Eqs. 7.3.11a, 7.3.11b and 7.3.12; the figures are those of EN 1998-1, 4.4.3.2(1).
    """
    share = 1.0 if limit_state_of_drift(class_of_use) == "SLD" else STRATEGIC_SHARE
    return share * drift_limit(elements)
