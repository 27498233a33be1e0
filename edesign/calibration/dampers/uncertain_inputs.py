"""What is not known of tests: temperatures up to an error of the thermometer, what softened the law before a record."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

from edesign.calibration.dampers.experiment import Experiment
from edesign.damper.history import Extremes
from edesign.damper.testing.start import SOFTENED, either_way, widest

_THERMOMETER = 0.2
"""K: tolerance of a platinum resistor of class A near room temperature, IEC 60751."""


@dataclass(frozen=True, eq=False)
class UncertainInput:
    """Tests as they would be one standard deviation from what is thought of them.

    Attributes:
        experiments: all tests.
        effects: names of the effects through which it acts.
        through_law: whether it acts through the law too.
    """

    experiments: tuple[Experiment, ...]
    effects: tuple[str, ...]
    through_law: bool


def uncertain_inputs(
    experiments: Sequence[Experiment], law: str, depends_on_temperature: bool
) -> tuple[UncertainInput, ...]:
    """Return what is not known of tests.

    Before a record that begins in motion the specimen may have gone as far, or as fast, as in it: a standard deviation
    is what that softens more than the extremes do that were found.

    Args:
        depends_on_temperature: whether the law does.
    """
    found = []
    degrees = [one.temperature for one in experiments]
    if max(degrees) - min(degrees) > _THERMOMETER:
        warmer = tuple(replace(one, temperature=one.temperature + _THERMOMETER) for one in experiments)
        found.append(UncertainInput(warmer, ("temperature_law",), depends_on_temperature))
    if law in SOFTENED and any(one.prior_extremes_unknown for one in experiments):
        for softened in (_as_far, _as_fast):
            found.append(UncertainInput(tuple(_softened(one, softened) for one in experiments), ("extremes",), True))
    return tuple(found)


def _softened(test: Experiment, before: Callable[[Extremes], Extremes]) -> Experiment:
    """Return a test whose specimen went before it as it does in it, if that is not known."""
    if test.start is None or test.start.known:
        return test
    prior = widest(test.start.prior_extremes, before(test.motion.extremes))
    return replace(test, start=replace(test.start, prior_extremes=prior, known=True))


def _as_far(own: Extremes) -> Extremes:
    return either_way(max(own[0], -own[1]), 0.0)


def _as_fast(own: Extremes) -> Extremes:
    return either_way(0.0, max(own[2], -own[3]))
