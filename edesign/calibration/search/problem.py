"""What a search works on: tests, a base model of them, and effects that it may lack."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Literal, Protocol

import numpy as np

from edesign.estimation.model import Model
from edesign.estimation.parameters import Parameter

Kind = Literal["damper", "rig", "instrument", "structure"]


@dataclass(frozen=True)
class Effect:
    """One form of an effect that a model may lack.

    Attributes:
        name: of the effect.
        form: how it acts; an effect may have several forms.
        kind: what it belongs to.
        parameters: its own; the first is its size.
        starts: (k, p) values, SI, to start from: a grid over what acts non-linearly, at a typical size.
        linear: whether what it does is proportional to its size, about no effect at zero.
        nuisance: whether it acts through nuisance amplitudes of each test.
        data: what the problem needs to predict with it, with its `words` and `constants`.
        cost: of a prediction, in those of the base model.
        confounded: what it may be by the tests that are fitted, which others separate; (): one thing alone.
        tests: indices of those that are fitted in which it acts; (): in all.
        log_prior: logarithm of the probability that it stands here, if it does in one of several places.
        exact: whether its equation is right by what it is, as that of a constant: what that misses is another effect.
    """

    name: str
    form: str
    kind: Kind
    parameters: tuple[Parameter, ...]
    starts: tuple[tuple[float, ...], ...]
    linear: bool
    nuisance: bool = False
    data: Any = None
    cost: float = 1.0
    confounded: tuple[Effect, ...] = ()
    tests: tuple[int, ...] = ()
    log_prior: float = 0.0
    exact: bool = False

    @property
    def label(self) -> str:
        """Name and form."""
        return f"{self.name}.{self.form}"


class Problem(Protocol):
    """What a search works on.

    Attributes:
        deviations: (tests,) standard deviation of the noise of each test that is fitted.
        sizes: (tests,) root mean square of what was measured in each.
        input_noise: share of the power of what was measured that noise of measured inputs makes through the model.
        effects: that the model may lack.
        start: (p,) values of the base model, SI, from which it is fitted.
    """

    @property
    def deviations(self) -> tuple[float, ...]:
        """Standard deviation of the noise of each test that is fitted."""

    @property
    def sizes(self) -> tuple[float, ...]:
        """Root mean square of what was measured in each."""

    @property
    def input_noise(self) -> float:
        """Share of the power of what was measured that noise of measured inputs makes through the model."""

    @property
    def effects(self) -> tuple[Effect, ...]:
        """Effects that the model may lack."""

    @property
    def start(self) -> tuple[float, ...]:
        """Values (p,) of the base model, SI, from which it is fitted."""

    def model(self, effects: Sequence[Effect]) -> Model:
        """Return the base model with effects; its parameters are those of the base, then of the effects in order."""


Columns = Sequence[np.ndarray]
"""(n_i, k) of each test."""
