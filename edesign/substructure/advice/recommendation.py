"""Which compensator to take: the least error among those that are safe enough, and of equals the simplest."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from edesign.project.reading.words import percent

ROUNDING = 0.1
"""Of the accepted response error: expected errors that differ by less decide nothing. Of 5 % it is half a percent of
the response, and a law that is linearised does not give it more closely."""
_FEEDBACK = ("smith", "pi_phase_lead")
ADAPTIVE = ("live_delay", "ats", "modified_ats")
"""Compensators that learn from what they have measured: their coefficients have limits."""


@dataclass(frozen=True)
class Candidate:
    """Compensator with the errors and margins of its worst test.

    Attributes:
        name, kind: of it.
        stable: in every test.
        delay_factor: least factor on the delay that is left until a test is unstable.
        error: largest expected error, of the response or, without a loop, of tracking.
        of_response: whether it is that of the response.
        cycle_error: largest share of the motion that a limit cycle of small motions may be; 0: no such motion grows.
        reason: why it is unstable, in words, where the structure has no part in it; empty: it has.
    """

    name: str
    kind: str
    stable: bool
    delay_factor: float
    error: float
    of_response: bool
    cycle_error: float = 0.0
    reason: str = ""

    @property
    def whole_error(self) -> float:
        """Error with that of the limit cycle, which has nothing to do with the earthquake."""
        return math.hypot(self.error, self.cycle_error)

    @property
    def simplicity(self) -> int:
        """Rank of simplicity: 0 none, 1 constant, 2 with feedback or a model of the specimen, 3 adaptive."""
        if self.kind == "none":
            return 0
        return 3 if self.kind in ADAPTIVE else 2 if self.kind in _FEEDBACK else 1


@dataclass(frozen=True)
class Recommendation:
    """Recommended compensator, with the reason.

    Attributes:
        compensator: its name; empty: none is stable with the margin that is asked for.
        reason: in sentences.
        accurate: whether its error is accepted.
    """

    compensator: str
    reason: str
    accurate: bool


def recommended(candidates: Sequence[Candidate], delay_margin: float, response_error: float) -> Recommendation:
    """Return the compensator of least error among the safe ones; the simpler of those that are equal.

    Small motions that grow end in a limit cycle. It counts as an error of the response, and bars a compensator if it
    alone is more than is accepted.

    Args:
        candidates: in the order of the file.
        delay_margin: least factor on the delay that is left.
    """
    if not candidates:
        return Recommendation("", "There is no test of kind command or rts to judge by.", accurate=False)
    stable = [one for one in candidates if one.stable]
    quiet = [one for one in stable if one.cycle_error <= response_error]
    safe = [one for one in quiet if one.delay_factor >= delay_margin and math.isfinite(one.error)]
    if not safe:
        return Recommendation("", _why_none(candidates, delay_margin, response_error), accurate=False)
    least = min(one.whole_error for one in safe)
    equal = [one for one in safe if one.whole_error <= least + ROUNDING * response_error]
    best = min(equal, key=lambda one: (one.simplicity, one.whole_error))
    accurate = best.whole_error <= response_error
    reason = _why(best, least, safe, delay_margin, response_error)
    return Recommendation(best.name, reason, accurate)


def _why(best: Candidate, least: float, safe: Sequence[Candidate], delay_margin: float, response_error: float) -> str:
    said = [_quality(best, delay_margin), *_rival(best, least, safe)]
    if best.cycle_error > 0.0:
        said.append(f"That counts a limit cycle of small motions, of {percent(best.cycle_error)} at most")
    if best.simplicity == 1:
        said.append("It relies on the rig as the file states it; an adaptive one follows a rig that differs")
    if best.whole_error > response_error:
        said.append(f"The error is larger than the {percent(response_error)} that are accepted")
    return ". ".join(said) + "."


def _quality(best: Candidate, delay_margin: float) -> str:
    if not best.of_response:
        return f"Expected tracking error {percent(best.whole_error)}"
    error = f"Expected response error {percent(best.whole_error)}"
    if math.isinf(best.delay_factor):
        return f"{error}, stable whatever the delay"
    return f"{error}, stable up to {best.delay_factor:.3g} times the delay that is left (asked: {delay_margin:g})"


def _rival(best: Candidate, least: float, safe: Sequence[Candidate]) -> list[str]:
    """The best of the others, in words; none if there are none."""
    rival = min((one for one in safe if one is not best), key=lambda one: one.whole_error, default=None)
    if rival is None:
        return []
    if best.whole_error > least:
        return [
            f'"{rival.name}" has {percent(rival.whole_error)}: a difference of less than {ROUNDING:g} of the accepted '
            "error decides nothing, and it is less simple"
        ]
    return [f'The next best is "{rival.name}" with {percent(rival.whole_error)}']


def _why_none(candidates: Sequence[Candidate], delay_margin: float, response_error: float) -> str:
    stable = [one for one in candidates if one.stable]
    if not stable:
        reasons = {one.reason for one in candidates}
        why = f": {reasons.pop()}" if len(reasons) == 1 and "" not in reasons else ""
        return f"Every compensator of the file leaves the test unstable{why}."
    said = []
    if growing := [one for one in stable if one.cycle_error > response_error]:
        names = ", ".join(f'"{one.name}" (to {percent(one.cycle_error)} of the response)' for one in growing)
        said.append(f"Small motions grow with {names}.")
    if quiet := [one for one in stable if one.cycle_error <= response_error]:
        names = ", ".join(f'"{one.name}" ({one.delay_factor:.3g})' for one in quiet)
        said.append(f"None has a margin of {delay_margin:g} times the delay that is left; stable with less: {names}.")
    return " ".join(said)
