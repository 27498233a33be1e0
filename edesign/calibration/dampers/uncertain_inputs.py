"""What is not known of tests: temperatures up to an error of the thermometer, what the specimen did before a record."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

from edesign.calibration.dampers.effect import EffectForm
from edesign.calibration.dampers.experiment import Experiment
from edesign.damper.history import Extremes
from edesign.damper.testing.start import SOFTENED, either_way, widest

_THERMOMETER = 0.2
"""K: tolerance of a platinum resistor of class A near room temperature, IEC 60751."""
_WAYS = (1.0, -1.0)
"""Mirror images of a test, through its first point and in time: two ways to it, as far and as fast as the test."""


@dataclass(frozen=True, eq=False)
class UncertainInput:
    """Tests as they would be one standard deviation from what is thought of them.

    Attributes:
        name: of what is not known.
        experiments: all tests.
        thought: all tests as they are thought of, beside which these are.
        effects: names of the effects through which it acts.
        through_law: whether it acts through the law too.
        before: whether it is what the specimen did before records: predictions have it as tests show it.
        state: whether it is what is inside the specimen at the first sample: it acts through all that remembers.
        size: of one standard deviation, for people.
        unit: of that.
    """

    name: str
    experiments: tuple[Experiment, ...]
    thought: tuple[Experiment, ...]
    effects: tuple[str, ...]
    through_law: bool
    before: bool = False
    state: bool = False
    size: float = 1.0
    unit: str = ""

    def acts_through(self, form: EffectForm) -> bool:
        """Return whether it acts through an effect."""
        return form.remembers if self.state else form.name in self.effects


def uncertain_inputs(
    experiments: Sequence[Experiment], law: str, depends_on_temperature: bool
) -> tuple[UncertainInput, ...]:
    """Return what is not known of tests.

    Before a record that begins in motion the specimen may have gone as far, or as fast, as in it: a standard deviation
    is what that softens more than the extremes do that were found. Forces inside the specimen, and all that effects
    remember, may be as after a mirror image of the test: a standard deviation is what that makes of the force.

    Args:
        depends_on_temperature: whether the law does.
    """
    found, every = [], tuple(experiments)
    degrees = [one.temperature for one in experiments]
    if max(degrees) - min(degrees) > _THERMOMETER:
        warmer = tuple(replace(one, temperature=one.temperature + _THERMOMETER) for one in experiments)
        through = ("temperature_law",), depends_on_temperature
        found.append(UncertainInput("temperature", warmer, every, *through, size=_THERMOMETER, unit="K"))
    if not any(one.prior_extremes_unknown for one in experiments):
        return tuple(found)
    softened = law in SOFTENED
    if softened:
        for name, before in (("deformation before", _as_far), ("velocity before", _as_fast)):
            there = tuple(_softened(one, before) for one in experiments)
            found.append(UncertainInput(name, there, every, ("extremes",), True, True))
    # the way makes both extremes of the law: beside it stands what they have softened
    thought = tuple(_softened(one, _as_far_and_fast) for one in experiments) if softened else every
    for way in _WAYS:
        came = tuple(
            replace(there, way=way) if one.prior_extremes_unknown else there
            for one, there in zip(experiments, thought, strict=True)
        )
        found.append(UncertainInput("start", came, thought, (), True, True, True, unit="N"))
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


def _as_far_and_fast(own: Extremes) -> Extremes:
    # a mirror image through the first point goes up to three times as far from zero
    return either_way(3.0 * max(own[0], -own[1]), max(own[2], -own[3]))
