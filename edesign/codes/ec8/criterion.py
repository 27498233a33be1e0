"""One rule of EN 1998-1 and what was found."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Criterion:
    """One rule and what was found.

    Attributes:
        clause: of EN 1998-1:2004.
        text: what is asked.
        required: the limit; None where the rule sets none.
        value: what was found; None where the rule does not apply.
        unit: of both; empty for ratios and counts.
        passed: None for a rule that does not apply or only informs.
        detail: where the worst value stands, or what follows.
    """

    clause: str
    text: str
    required: float | None
    value: float | None
    unit: str
    passed: bool | None
    detail: str = ""
