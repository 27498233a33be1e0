"""Where an effect acts in the way from the measured motion to the recorded force.

measured motion -> MotionChannel  the motion that the rig made, then the one of the specimen
                -> Thermometer    temperature of this test
                -> LawParameters  parameters of the law in this test
                -> CoreEffect, Rig law with its effects, in series with the rig: one history of the C core
                -> ForceChannel   forces of what moves with the actuator, then what the channel makes of the sum
                -> NuisanceAmplitudes      amplitudes of histories, another in each test
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from enum import Enum
from functools import lru_cache
from typing import Literal, NamedTuple

import numpy as np

from edesign.calibration.dampers.experiment import Experiment
from edesign.calibration.dampers.motion import Motion
from edesign.calibration.dampers.nuisance import Told
from edesign.calibration.form import Values
from edesign.core.damper import EffectValues, effect_remembers
from edesign.damper.effect_forms import parameters_in_core
from edesign.damper.law import Law
from edesign.estimation.model import PredictionError


class Placement(Enum):
    """Where the equation of an effect acts."""

    WHOLE = "whole"
    INSIDE = "inside"
    SPRINGS = "springs"
    DASHPOTS = "dashpots"


@dataclass(frozen=True)
class CoreEffect:
    """An effect beside or on the law that the C core computes.

    Attributes:
        equation: its name in the core, e.g. "payne.whole"; its parameters are values of the form with the same names.
        placement: where it acts.
        factor: of "constant" alone: the factor of the force in a test.
        more: parameters of the equation that are none of the form, of the form's values.
        own: parameters of the equation that are another in each test, of the form's values.
    """

    equation: str
    placement: Placement = Placement.WHOLE
    factor: Callable[[Values, Experiment], float] | None = None
    more: Callable[[Values], Values] | None = None
    own: Callable[[Values, Experiment], Values] | None = None

    @property
    def carries(self) -> bool:
        """Whether the specimen remembers its state from test to test, however long it rests between."""
        return self.equation.partition(".")[0] in ("mullins", "degradation", "pinching")

    @property
    def remembers(self) -> bool:
        """Whether its force depends on what the specimen did before."""
        return effect_remembers(self.equation)

    def in_test(self, p: Values, test: Experiment) -> EffectValues:
        """Return the effect as the core takes it in a test.

        Args:
            p: parameters of the form.
            test: that is predicted.

        Raises:
            PredictionError: this core has no such equation.
        """
        if self.factor is not None:
            return EffectValues(self.equation, (self.factor(p, test),), self.placement.value)
        names = _parameter_names().get(self.equation)
        if names is None:
            raise PredictionError(f"the core has no effect {self.equation}")
        known = p if self.more is None else {**p, **self.more(p)}
        known = known if self.own is None else {**known, **self.own(p, test)}
        return EffectValues(self.equation, tuple(known[name] for name in names), self.placement.value)


@lru_cache(maxsize=1)
def _parameter_names() -> dict[str, tuple[str, ...]]:
    return {kind: tuple(one.name for one in own) for kind, own in parameters_in_core().items()}


class RigValues(NamedTuple):
    """What stands in series with the specimen (core.rig.SeriesRig).

    Attributes:
        stiffness: N/m.
        play: from end to end, m.
        cubic: by which the rig stiffens, 1/m2.
        play_stiffness: stiffness across the play, N/m.
        power: with which the force goes, if none of the above: stiffness z |sqrt(cubic) z|^(power - 1), z the stretch.
        damping: beside all of it, N s/m.
    """

    stiffness: float
    play: float = 0.0
    cubic: float = 0.0
    play_stiffness: float = 0.0
    power: float = 1.0
    damping: float = 0.0

    @staticmethod
    def together(each: Sequence[RigValues]) -> RigValues:
        """Return rigs that stand one behind the other as one.

        Compliances add, plays too; ends of soft parts are where the same force closes them. Little damping is assumed.

        Args:
            each: rigs, one at least.

        Raises:
            PredictionError: one stiffens with a power of its stretch, and there is another.
        """
        if len(each) == 1:
            return each[0]
        if any(one.power > 1.0 for one in each):
            raise PredictionError("a rig that stiffens with a power of its stretch has no other one in series")
        stiffness = 1.0 / sum(1.0 / one.stiffness for one in each)
        # e = F/s - b (F/s)^3 of each, for a little of the cubic part; 1/(s + i w c) = 1/s - i w c/s^2
        cubic = sum(one.cubic * (stiffness / one.stiffness) ** 3 for one in each)
        damping = sum(one.damping * (stiffness / one.stiffness) ** 2 for one in each)
        soft = [one.play_stiffness if one.play > 0.0 else one.stiffness for one in each]
        if 0.0 in soft:
            return RigValues(stiffness, sum(one.play for one in each), cubic, damping=damping)
        play_stiffness = 1.0 / sum(1.0 / one for one in soft)
        play = sum(one.play * one.play_stiffness for one in each) / play_stiffness
        return RigValues(stiffness, play, cubic, play_stiffness, damping=damping)


@dataclass(frozen=True)
class Rig:
    """What stands in series with the specimen.

    Attributes:
        values: of the parameters of the form.
    """

    values: Callable[[Values], RigValues]


@dataclass(frozen=True)
class Rest:
    """How long the specimen rests between two tests; a form without it has tests long after each other.

    Attributes:
        duration: name of the parameter, s.
    """

    duration: str


@dataclass(frozen=True)
class LastingExtremes:
    """Extremes of one test soften the law in the next: the specimen is fresh in the first one alone."""


@dataclass(frozen=True)
class Thermometer:
    """Another temperature than the one that was read.

    Attributes:
        error: name of the parameter by which the reading is too high, K.
    """

    error: str


@dataclass(frozen=True)
class LawParameters:
    """Other parameters of the law in a test.

    Attributes:
        change: the law's parameters, all of them by name, of those that it would have.
        in_place_of_gamma: whether gamma_T of the MGMM does not act.
    """

    change: Callable[[Values, Experiment, Law, dict[str, float]], dict[str, float]]
    in_place_of_gamma: bool = False


@dataclass(frozen=True)
class MotionChannel:
    """Another motion than the measured one.

    Attributes:
        change: the motion that was made, of the one that would have been.
        of: whether of the whole actuator, or of the specimen alone.
    """

    change: Callable[[Values, Experiment, Motion], Motion]
    of: Literal["actuator", "specimen"] = "actuator"


@dataclass(frozen=True)
class ForceChannel:
    """Another force than the specimen's.

    Attributes:
        change: the force (n,) N, of the motion of the actuator and the force (n,) N that would have been.
        of: whether of what moves with the actuator, before the load cell, or of the channel.
        remembers: whether it depends on the force before.
    """

    change: Callable[[Values, Experiment, Motion, np.ndarray], np.ndarray]
    of: Literal["carriage", "channel"] = "channel"
    remembers: bool = False


@dataclass(frozen=True)
class NuisanceAmplitudes:
    """Histories whose amplitudes are nuisance parameters, others in each test.

    Attributes:
        columns: (n, k) N at the samples of a test; an amplitude has the prior N(0, 1).
        told: what is told of the amplitudes of a test.
    """

    columns: Callable[[Values, Experiment], np.ndarray]
    told: Callable[[Values, Experiment], tuple[Told, ...]]


Mechanism = (
    CoreEffect
    | Rig
    | Rest
    | LastingExtremes
    | Thermometer
    | LawParameters
    | MotionChannel
    | ForceChannel
    | NuisanceAmplitudes
)
