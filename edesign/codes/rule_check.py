"""One rule of a standard, most often EN 1998-1, and what was found."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

ROUNDING = 1e-9
"""Share of a limit by which rounding may miss it: a suite scaled to a_g S exactly must not fail by the last bits."""


def first_of_largest(values: np.ndarray) -> int:
    """Return the flat index of the largest value, and of values that differ by rounding alone the first.

    Symmetric members govern alike; which one has the larger last bits depends on the processor.

    Args:
        values: not empty, no NaN.
    """
    largest = float(values.max())
    least = largest - ROUNDING * abs(largest) if np.isfinite(largest) else largest
    return int(np.flatnonzero(values >= least)[0])


_NAMED = ("EN ", "ASCE ", "AISC ", "NTC ")  # a clause of another standard than EN 1998-1 begins with its name


def with_standard(clause: str) -> str:
    """Return a clause with its standard: EN 1998-1, if it names none.

    Args:
        clause: number of the clause, with or without its standard.
    """
    return clause if clause.startswith(_NAMED) else f"EN 1998-1, {clause}"


UNREAD = "No public text of these numbers could be read: compare them with your copy of the standard."
"""What tables say of numbers of a standard that no text at hand confirmed."""


@dataclass(frozen=True)
class RuleCheck:
    """One rule and what was found.

    Attributes:
        clause: of EN 1998-1:2004, or of another standard that it names.
        text: what is asked.
        required: the limit; None where the rule sets none.
        value: what was found; None where the rule does not apply.
        unit: of both; empty for ratios and counts.
        passed: None for a rule that does not apply or only informs.
        detail: where the worst value stands, or what follows.
        least: whether the limit is the least value, not the largest.
        told: the clause that the code in use has in its place, with the standard; empty: `clause`.
    """

    clause: str
    text: str
    required: float | None
    value: float | None
    unit: str
    passed: bool | None
    detail: str = ""
    least: bool = False
    told: str = ""

    @property
    def reference(self) -> str:
        """The clause with its standard."""
        return self.told or with_standard(self.clause)

    def __post_init__(self) -> None:
        """Make numbers and truth values of numpy plain ones: `passed is False` must hold for both."""
        if self.value is not None:
            object.__setattr__(self, "value", float(self.value))
        if self.passed is not None:
            object.__setattr__(self, "passed", bool(self.passed))

    @property
    def utilisation(self) -> float:
        """Share of the limit that is used: 1 is the limit, whichever way it counts.

        It is 0 of a rule without limit or value.
        """
        if not self.required or self.value is None:
            return 0.0
        if not self.least:
            return self.value / self.required
        return self.required / self.value if self.value > 0.0 else float("inf")


def at_most(clause: str, text: str, limit: float, value: float, detail: str = "") -> RuleCheck:
    """Return the criterion that a ratio is at most a limit; the limit itself passes, whatever its last bits.

    Args:
        text: what is required.
        limit: largest value.
        detail: place or remark.
    """
    return RuleCheck(clause, text, limit, value, "", bool(value <= limit * (1.0 + ROUNDING)), detail)


def at_least(clause: str, text: str, limit: float, value: float, detail: str = "") -> RuleCheck:
    """Return the criterion that a ratio is at least a limit; the limit itself passes, whatever its last bits.

    Args:
        text: what is required.
        detail: place or remark.
    """
    return RuleCheck(clause, text, limit, value, "", bool(value >= limit * (1.0 - ROUNDING)), detail, least=True)
