"""The outer loop of a design: histories judge a sizing, and what misses is changed until it meets, or cannot."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Generic, Protocol, TypeVar

from edesign.assess.requirement import shown
from edesign.errors import AnalysisError, InputError
from edesign.project.notation.printed_unit import told_apart

LARGEST_FACTOR = 10.0  # on the size of the dampers
LARGEST_STEP, _SMALLEST_STEP = 1.6, 1.05  # of what is changed, from one missing round to the next
_AIM = 0.99  # of the limit
_MET, _MISSED = 0.9, 1.1  # demands where there is no value: only their side of 1 counts, and steps stay small
_MIDDLE = 0.15  # share of a bracket at both ends in which no new trial lies


class Sized(Protocol):
    """Dampers of a sizing by any method."""

    @property
    def target(self) -> float:
        """The target that the dampers were sized for, in the quantity of the method."""

    @property
    def reason(self) -> str:
        """Why the sizing failed; empty if it did not."""

    @property
    def short(self) -> bool:
        """Whether what the dampers reach stays below the target."""


S = TypeVar("S", bound=Sized)


@dataclass(frozen=True)
class RoundVerdict:
    """The verdict on one criterion in a round; value and limit are nan where there is none.

    Both are in the SI unit beside them, "1" for ratios.
    """

    name: str
    value: float
    limit: float
    met: bool
    unit: str = "1"

    @property
    def demand(self) -> float:
        """Value over limit, or limit over value where the value is bounded from below; nan where there is none."""
        value, limit = self.value, self.limit
        if not (math.isfinite(value) and math.isfinite(limit)) or limit <= 0.0:
            return math.nan
        if value <= 0.0:
            return 0.0 if self.met else math.inf
        # a value above its limit that is met, or below it that is missed, is one that must be larger
        return value / limit if (value <= limit) == self.met else limit / value


@dataclass(frozen=True)
class RoundOutcome:
    """The verdicts on the histories of a round.

    Attributes:
        verdicts: of the criteria.
        failed: names of histories that were not completed.
        strain: effective strain of the layers of the dampers, mean of the histories; nan: there are none.
        drift: storey drifts over height, mean of the histories, (f,); none: nothing is changed by them.
        force: of all dampers of a place in each storey with dampers, (s,) N; none: their braces have no sections.
        force_level: hazard level of these forces.
        brace_use: the largest N_Ed / N_b,Rd of their braces; nan: these have no sections.
    """

    verdicts: tuple[RoundVerdict, ...]
    failed: tuple[str, ...] = ()
    strain: float = math.nan
    drift: tuple[float, ...] = ()
    force: tuple[float, ...] = ()
    force_level: str = ""
    brace_use: float = math.nan

    @property
    def met(self) -> bool:
        """Whether every criterion is met; the criteria decide how failed histories count."""
        return bool(self.verdicts) and all(verdict.met for verdict in self.verdicts)

    @property
    def demand(self) -> float:
        """The largest demand of the verdicts (see `RoundVerdict.demand`)."""
        return max((demand_of(verdict) for verdict in self.verdicts), default=1.0)

    @property
    def misses(self) -> str:
        """The criteria that are not met with value and limit, and the histories that were not completed, in words."""
        text = ", ".join(_said(verdict) for verdict in self.verdicts if not verdict.met)
        if not self.failed:
            return text
        failed = f"{len(self.failed)} histories were not completed, the first {self.failed[0]}"
        return f"{text}; {failed}" if text else failed


@dataclass(frozen=True)
class Round(Generic[S]):
    """One sizing and its verification.

    Attributes:
        number: from 1.
        changed: the value of what is changed: target damping or beta, or a factor on the size.
        sizing: the dampers.
        outcome: None: not verified.
    """

    number: int
    changed: float
    sizing: S
    outcome: RoundOutcome | None = None

    @property
    def met(self) -> bool:
        """Whether its histories meet every criterion, the braces hold their dampers, and these reach their target."""
        held = self.outcome is not None and self.outcome.met and not self.outcome.brace_use > 1.0
        return held and not self.sizing.short


@dataclass(frozen=True)
class Search(Generic[S]):
    """All rounds of a design, the chosen one, and why it does not meet the criteria (empty if it does)."""

    rounds: tuple[Round[S], ...]
    chosen: Round[S]
    reason: str = ""


def search(
    make: Callable[[float], S],
    verify: Callable[[S, int, float], RoundOutcome],
    start: float,
    largest: float,
    most_rounds: int,
    precision: float,
    kept: Callable[[Sequence[Round[S]]], None] = lambda rounds: None,
    actual: Callable[[S, float], float] = lambda sizing, value: value,
    settled: Callable[[Round[S]], bool] = lambda last: True,
) -> Search[S]:
    """Find the smallest value that meets all criteria, by secants up to the first that does, then inside the bracket.

    Args:
        make: the sizing of a value.
        verify: histories and verdicts of a sizing, its round and its value.
        start: value of the first round; when it is met the search is over.
        largest: value that is not exceeded.
        most_rounds: how many may be tried.
        precision: relative width of the bracket at which the search is over.
        kept: called with all rounds after each.
        actual: the value that a sizing really has, where a method may take a larger one than it is asked for.
        settled: whether what a sizing presumes of its histories agrees with them: asked of the first value, and of the
            one that is found. If not, the same value is sized anew with what they say, and the rounds before do not
            count.

    Returns:
        The search; the chosen round is the smallest met, or the last where none is.
    """
    rounds: list[Round[S]] = []
    first = 0  # of the rounds that count
    value, reason = start, ""
    while True:
        try:
            sizing = make(value)
        except (InputError, AnalysisError) as error:
            if not rounds:
                raise
            if first == len(rounds):
                return Search(tuple(rounds), rounds[-1], f"with what the histories say of strain and forces: {error}")
            # what can be reached may shrink as dampers grow, because their properties follow the frequency
            reached, largest = rounds[-1].changed, min(largest, value)
            if value - reached <= precision * reached:
                reason = str(error)
                break
            value = 0.5 * (reached + value)
            continue
        value = actual(sizing, value)
        if sizing.reason:
            rounds.append(Round(len(rounds) + 1, value, sizing))
            reason = sizing.reason
            break
        rounds.append(Round(len(rounds) + 1, value, sizing, verify(sizing, len(rounds) + 1, value)))
        kept(rounds)
        if len(rounds) == most_rounds:
            break
        if len(rounds) == first + 1 and not settled(rounds[-1]):
            first = len(rounds)
            continue
        following = _next(rounds[first:], largest, precision)
        if following is not None:
            value = following
            continue
        best = _least(rounds[first:])
        if best is None or settled(best):
            break
        first, value = len(rounds), best.changed
    best = _least(rounds[first:]) or _least(rounds)
    if best is not None:
        return Search(tuple(rounds), best)
    if rounds[-1].outcome is not None:
        reason = _missed(rounds, largest, most_rounds, reason)
    return Search(tuple(rounds), rounds[-1], reason)


def _least(rounds: Sequence[Round[S]]) -> Round[S] | None:
    """The round of the least value that meets all criteria, of equal ones the last; None: none does."""
    good = [r for r in rounds if r.outcome is not None and r.outcome.met]
    return min(reversed(good), key=lambda r: r.changed) if good else None


def _next(rounds: Sequence[Round[S]], largest: float, precision: float) -> float | None:
    """The next value; None when the search is over."""
    tried = sorted(((r.changed, r.outcome) for r in rounds if r.outcome is not None), key=lambda item: item[0])
    met = [(x, o) for x, o in tried if o.met]
    high = met[0] if met else None
    below = [(x, o) for x, o in tried if not o.met and (high is None or x < high[0])]
    if high is not None:
        if not below or high[0] - below[-1][0] <= precision * high[0]:
            return None
        (x0, o0), (x1, o1) = below[-1], high
        width = x1 - x0
        slope = (o1.demand - o0.demand) / width
        guess = x0 + (_AIM - o0.demand) / slope if slope < 0.0 else x0 + 0.5 * width
        return min(max(guess, x0 + _MIDDLE * width), x1 - _MIDDLE * width)
    x, outcome = below[-1]
    if x >= largest:
        return None
    step = outcome.demand**2  # displacements fall about with the root of what is added
    if len(below) > 1:
        x0, o0 = below[-2]
        slope = (outcome.demand - o0.demand) / (x - x0)
        step = (x + (_AIM - outcome.demand) / slope) / x if slope < 0.0 else LARGEST_STEP
    if not math.isfinite(step):
        step = LARGEST_STEP
    return min(x * min(max(step, _SMALLEST_STEP), LARGEST_STEP), largest)


def _missed(rounds: Sequence[Round[S]], largest: float, most_rounds: int, beyond: str) -> str:
    last = rounds[-1].outcome
    assert last is not None
    text = last.misses
    if beyond:
        return f"the largest value that can be reached, {rounds[-1].changed:.4g}, misses: {text}; beyond it {beyond}"
    if rounds[-1].changed >= largest:
        return f"even the largest value, {largest:.4g}, misses: {text}"
    return f"not met within {most_rounds} rounds; the last, with {rounds[-1].changed:.4g}, misses: {text}"


def _said(verdict: RoundVerdict) -> str:
    if math.isnan(verdict.value) or math.isnan(verdict.limit):
        return verdict.name
    value, limit = told_apart(verdict.value, verdict.limit, lambda of, digits: shown(of, verdict.unit, digits), 4)
    return f"{verdict.name} ({value}, limit {limit})"


def demand_of(verdict: RoundVerdict) -> float:
    """Return the demand of a verdict, or a positive finite number on the right side of 1 where it has none."""
    demand = verdict.demand
    if 0.0 < demand < math.inf:
        return demand
    return _MET if verdict.met else _MISSED
