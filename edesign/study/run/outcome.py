"""How the analyses of a run ended."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from edesign.notebook import facts_html, pictures_html

COMPLETED, FAILED = "completed", "failed"
COLLAPSED, SKIPPED = "collapsed", "skipped"
"""Of histories of incremental studies only: the frame fell, which is what they look for; and what is therefore not run,
at the intensities above."""


@dataclass(frozen=True)
class Outcome:
    """The status, reason and duration of one analysis.

    Attributes:
        name: of the analysis.
        status: "completed" or "failed"; in an incremental study also "collapsed" or "skipped".
        reason: why it is not completed, "" if it is.
        reused: whether the result is that of an earlier, interrupted run.
        seconds: time it took (s), 0 if reused.
    """

    name: str
    status: str
    reason: str = ""
    reused: bool = False
    seconds: float = 0.0

    @property
    def failed(self) -> bool:
        """Whether the analysis counts as a failure of the run; a collapse that is looked for does not."""
        return self.status not in (COMPLETED, COLLAPSED, SKIPPED)


@dataclass(frozen=True)
class RunSummary:
    """The outcomes of a run.

    Attributes:
        archive: the finished archive.
        outcomes: one for each analysis, in the order of the plan.
        notes: what was reported to the user, such as what became of an interrupted run.
        seconds: time of the whole run (s).
    """

    archive: Path
    outcomes: tuple[Outcome, ...]
    notes: tuple[str, ...] = ()
    seconds: float = 0.0

    def _repr_html_(self) -> str:
        failed = [f"{outcome.name}: {outcome.reason}" for outcome in self.failed]
        rows = {"analyses": len(self.outcomes), "failed": failed, "seconds": f"{self.seconds:.1f}"}
        return facts_html(str(self.archive), rows.items()) + pictures_html(self)

    @property
    def failed(self) -> tuple[Outcome, ...]:
        """The analyses that failed."""
        return tuple(outcome for outcome in self.outcomes if outcome.failed)
