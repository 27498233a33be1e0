"""What a run tells while it goes on; who listens decides how to show it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Literal


@dataclass(frozen=True)
class Progress:
    """One report of a run.

    Attributes:
        event: "note" (text for the user), "start", "advance" or "end" of an analysis, "reuse" of an earlier result.
        analysis: name of the analysis, "" for a note.
        index: its place in the plan, from 1; 0 for a note, and for what is not in the plan, such as the fit of records.
        count: number of analyses in the plan.
        fraction: done part of this analysis, 0 to 1.
        message: text of a note; at the end the status, with the reason of a failure.
        seconds: time that the analysis took, at its end (s).
    """

    event: Literal["note", "start", "advance", "end", "reuse"]
    analysis: str = ""
    index: int = 0
    count: int = 0
    fraction: float = 0.0
    message: str = ""
    seconds: float = 0.0


Listener = Callable[[Progress], None]


def silent(report: Progress) -> None:
    """Listen to nothing."""
