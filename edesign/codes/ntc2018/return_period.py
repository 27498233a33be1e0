"""Reference life and return period of the limit states, NTC 2018, 2.4 and 3.2.1."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType

from edesign.codes.names import unknown
from edesign.codes.quantities import check_positive

CLASS_OF_USE = MappingProxyType({"I": 0.7, "II": 1.0, "III": 1.5, "IV": 2.0})
"""Coefficient of use C_U by class of use. Source: NTC 2018, Table 2.4.II."""


@dataclass(frozen=True)
class LimitState:
    """A limit state and how rare its action is.

    Attributes:
        name: in Italian.
        probability: P_VR of exceedance in the reference life.
        ultimate: whether it is one of the ultimate limit states.

    Source: NTC 2018, 3.2.1 and Table 3.2.I.
    """

    name: str
    probability: float
    ultimate: bool


LIMIT_STATES: Mapping[str, LimitState] = MappingProxyType(
    {
        "SLO": LimitState("Stato Limite di Operativita", 0.81, ultimate=False),
        "SLD": LimitState("Stato Limite di Danno", 0.63, ultimate=False),
        "SLV": LimitState("Stato Limite di salvaguardia della Vita", 0.10, ultimate=True),
        "SLC": LimitState("Stato Limite di prevenzione del Collasso", 0.05, ultimate=True),
    }
)


def reference_life(nominal_life: float, class_of_use: str) -> float:
    """Return V_R = V_N C_U, years.

    Args:
        nominal_life: V_N, years.
        class_of_use: I to IV.

    Raises:
        InputError: the nominal life is not greater than zero, or there is no such class.

    Source: NTC 2018, 2.4.3, Eq. 2.4.1, and Table 2.4.II.
    """
    check_positive(V_N=nominal_life)
    if class_of_use not in CLASS_OF_USE:
        raise unknown("class of use", class_of_use, CLASS_OF_USE)
    return nominal_life * CLASS_OF_USE[class_of_use]


def return_period(limit_state: str, reference_life: float) -> float:
    """Return T_R = -V_R / ln(1 - P_VR), years.

    Args:
        limit_state: SLO, SLD, SLV or SLC.
        reference_life: V_R, years.

    Raises:
        InputError: there is no such limit state, or V_R is not greater than zero.

    Source: NTC 2018, 3.2, Eq. 3.2.0, and Table 3.2.I.
    """
    check_positive(V_R=reference_life)
    if limit_state not in LIMIT_STATES:
        raise unknown("limit state", limit_state, LIMIT_STATES)
    return -reference_life / math.log1p(-LIMIT_STATES[limit_state].probability)
