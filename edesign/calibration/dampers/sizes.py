"""How large things are in a campaign: priors and starts of effects are set by it."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np

from edesign.calibration.dampers.experiment import Experiment
from edesign.calibration.dampers.motion import Motion

APART = 1.0
"""K between temperatures that are not the same: a thermometer may be wrong by 0.2 K in each test."""

_BETWEEN = 4
_LONGEST = 20.0  # s, of a slow period up to which lags depend on it


@dataclass(frozen=True)
class Condition:
    """A condition that each test declares, as gas pressure, in the unit of the campaign.

    Attributes:
        name: of it.
        lowest, highest, mean: in the tests fitted to.
        reach: largest distance of any test from the mean, in shares of the range of the tests fitted to.
        positive: whether no test has a negative value.
    """

    name: str
    lowest: float
    highest: float
    mean: float
    reach: float
    positive: bool

    @property
    def span(self) -> float:
        """Range of the tests fitted to."""
        return self.highest - self.lowest

    @staticmethod
    def of(name: str, fitted: Sequence[float], every: Sequence[float]) -> Condition:
        """Return a condition by its values in the tests fitted to, and in all."""
        lowest, highest, mean = min(fitted), max(fitted), sum(fitted) / len(fitted)
        farthest = max(abs(one - mean) for one in every)
        reach = farthest / (highest - lowest) if highest > lowest else 0.0
        return Condition(name, lowest, highest, mean, reach, min(every) >= 0.0)


@dataclass(frozen=True)
class Sizes:
    """Typical sizes in a campaign, over the tests fitted to; SI.

    Attributes:
        force, displacement, velocity, acceleration: largest.
        rms: root mean square of the force, over all samples.
        duration: of the longest test.
        total: duration of all tests.
        path: of all tests.
        work: dissipated in all tests.
        tests: number in the campaign.
        fitted: (tests,) whether each of them is fitted to.
        period: of the slowest motion.
        temperatures: lowest and highest of the tests fitted to, degC.
        levels: how many temperatures these have, each APART from the next.
        tones: frequencies of narrow peaks that the tests have in common, Hz, the strongest first.
        conditions: that the tests declare.
        ordered: whether it is known in which order the tests were made.
        names: (tests,) of the tests; (): not known.
    """

    force: float
    displacement: float
    velocity: float
    acceleration: float
    rms: float
    duration: float
    total: float
    path: float
    work: float
    tests: int
    fitted: tuple[bool, ...]
    period: float
    temperatures: tuple[float, float]
    levels: int
    tones: tuple[float, ...] = ()
    conditions: tuple[Condition, ...] = ()
    ordered: bool = True
    names: tuple[str, ...] = ()

    def name(self, number: int) -> str:
        """Return what a test is called, for people.

        Args:
            number: its place in the campaign, from 1.
        """
        return self.names[number - 1] if self.names else f"test {number}"

    @property
    def stiffness(self) -> float:
        """Largest force over largest displacement, N/m."""
        return self.force / self.displacement

    @property
    def frequency(self) -> float:
        """Frequency of a sine with the largest velocity and the largest acceleration, Hz."""
        return self.acceleration / self.velocity / (2.0 * np.pi)

    @property
    def lag_period(self) -> float:
        """Period in shares of which lags are sought, s."""
        return min(self.period, _LONGEST)

    @property
    def between(self) -> bool:
        """Whether the tests show what changes from one to the next alone.

        That takes their order, a test for the law, one for the change, and two that show how tests scatter.
        """
        return self.ordered and sum(self.fitted) >= _BETWEEN

    @staticmethod
    def of(experiments: Sequence[Experiment], tones: Sequence[float] = (), ordered: bool = True) -> Sizes:
        """Return the sizes in tests.

        Args:
            experiments: all tests of the campaign.
            tones: frequencies of narrow peaks, Hz.
            ordered: whether it is known in which order they were made.
        """
        fitted = [one for one in experiments if one.use == "fit"]
        motions = [one.motion for one in fitted]
        power = sum(float(one.force @ one.force) for one in fitted)
        temperatures = [one.temperature for one in fitted]
        return Sizes(
            force=_largest(one.force for one in fitted),
            displacement=_largest(one.displacement for one in motions),
            velocity=_largest(one.velocity for one in motions),
            acceleration=_largest(one.acceleration for one in motions),
            rms=float(np.sqrt(power / sum(one.force.size for one in fitted))),
            duration=max(float(one.motion.since[-1]) for one in experiments),
            total=sum(float(one.motion.since[-1]) for one in experiments),
            path=sum(one.motion.path for one in experiments),
            work=abs(sum(one.work for one in experiments)),
            tests=len(experiments),
            fitted=tuple(one.use == "fit" for one in experiments),
            names=tuple(one.name for one in experiments),
            period=max(map(_period, motions)),
            temperatures=(min(temperatures), max(temperatures)),
            levels=_levels(temperatures),
            tones=tuple(tones),
            conditions=tuple(
                Condition.of(
                    name, [one.conditions[name] for one in fitted], [one.conditions[name] for one in experiments]
                )
                for name in experiments[0].conditions
            ),
            ordered=ordered,
        )


def _largest(histories: Iterable[np.ndarray]) -> float:
    return max(float(np.max(np.abs(values))) for values in histories)


def _period(motion: Motion) -> float:
    """Period of a sine with the root mean squares of displacement and velocity, s."""
    ratio = np.mean(motion.displacement**2) / max(np.mean(motion.velocity**2), 1e-300)
    return float(2.0 * np.pi * np.sqrt(ratio))


def _levels(temperatures: Sequence[float]) -> int:
    """How many of them stand APART."""
    first, *others = sorted(temperatures)
    number = 1
    for value in others:
        if value - first >= APART:
            first, number = value, number + 1
    return number
