"""Lines of progress while a report is made, with the share of the work that is done."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence

SHARES = {
    "model": 0.12,
    "ground_motion": 0.05,
    "pushover": 0.05,
    "response": 0.1,
    "motion": 0.13,
    "hinges": 0.18,
    "moment_rotation": 0.04,
    "histories": 0.09,
    "dampers": 0.13,
    "Members": 0.4,
}
"""Usual shares of sections of the time that all take, measured on reports of 5 to 42 analyses; of others `OTHER`."""
OTHER = 0.01


class Step(str):
    """A line of progress.

    Attributes:
        share: of the work that is done when the line is said, 0 to 1.
    """

    share: float

    def __new__(cls, text: str, share: float) -> Step:
        """Return the line."""
        made = super().__new__(cls, text)
        made.share = share
        return made


def steps(names: Sequence[str]) -> Iterator[Step]:
    """Yield the line to be said before each section.

    Args:
        names: of the sections, as `SHARES` has them.
    """
    weights = [SHARES.get(name, OTHER) for name in names]
    for number, name in enumerate(names):
        words = name.strip("_").replace("_", " ").lower()
        yield Step(f"section {number + 1} of {len(names)}, {words}", sum(weights[:number]) / sum(weights))


def part_of(progress: Callable[[str], None], first: float, last: float) -> Callable[[str], None]:
    """Return a listener for a part of the work, which tells another one how much of the whole is done.

    Args:
        progress: listens to the whole.
        first: share of the whole that is done before the part.
        last: share that is done after it.
    """

    def listen(line: str) -> None:
        share = line.share if isinstance(line, Step) else None
        progress(line if share is None else Step(line, first + share * (last - first)))

    return listen
