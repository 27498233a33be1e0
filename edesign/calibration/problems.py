"""What problems of the search have in common: tests by their use, and models with effects beside a base."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Generic, TypeVar

import numpy as np

from edesign.calibration.form import FormInCampaign, Values
from edesign.calibration.search.problem import Effect
from edesign.damper.testing.measured_histories import Use
from edesign.estimation.model import PredictionError
from edesign.estimation.parameters import Parameter

Predicted = list[np.ndarray] | PredictionError
"""Values (n_i,) of each test by a set of parameters, or why there are none."""


class TestedProblem(ABC):
    """Tests of one specimen or structure, and a base model of it."""

    __test__ = False  # no test of pytest

    @property
    @abstractmethod
    def base(self) -> tuple[Parameter, ...]:
        """Parameters of the base model with priors."""

    @property
    @abstractmethod
    def uses(self) -> tuple[Use, ...]:
        """Use of each test."""

    def used_for(self, *uses: Use) -> tuple[int, ...]:
        """Return the indices of tests of some uses.

        Args:
            uses: fit, validate.
        """
        return tuple(i for i, use in enumerate(self.uses) if use in uses)

    @property
    def start(self) -> tuple[float, ...]:
        """Values, SI, from which the base is fitted."""
        return tuple(one.centre for one in self.base)

    @property
    def input_noise(self) -> float:
        """Share of the power of what was measured that noise of measured inputs makes through the model."""
        return 0.0


P = TypeVar("P", bound=TestedProblem)


@dataclass(frozen=True, eq=False)
class EffectModel(Generic[P]):
    """A base model with effects, of some tests.

    Attributes:
        problem: of the tests.
        effects: beside or on the base model.
        tests: indices of the tests.
    """

    problem: P
    effects: tuple[Effect, ...]
    tests: tuple[int, ...]

    @cached_property
    def parameters(self) -> tuple[Parameter, ...]:
        """Those of the base, and of the effects in their order."""
        return (*self.problem.base, *(one for effect in self.effects for one in effect.parameters))

    def nuisance_columns(self, values: np.ndarray) -> list[np.ndarray | None]:
        """Return None of each test: there are no nuisance amplitudes."""
        return [None] * len(self.tests)

    def columns_near(self, values: np.ndarray, around: np.ndarray) -> list[np.ndarray | None]:
        """Return the columns of each test; where some are rough by themselves, those as near by."""
        return self.nuisance_columns(values)

    def base_values(self, values: np.ndarray) -> dict[str, float]:
        """Return the parameters of the base by name, SI.

        Args:
            values: (p,) SI.
        """
        return {one.name: float(value) for one, value in zip(self.problem.base, values, strict=False)}

    def effect_values(self, values: np.ndarray) -> list[tuple[FormInCampaign, Values]]:
        """Return the form of each effect with its values by name, SI.

        Args:
            values: (p,) SI.
        """
        at, found = len(self.problem.base), list[tuple[FormInCampaign, Values]]()
        for effect in self.effects:
            found.append((effect.data, effect.data.values(values[at : at + len(effect.parameters)])))
            at += len(effect.parameters)
        return found


def changed(predicted: Sequence[np.ndarray], here: Sequence[np.ndarray], there: Sequence[Predicted]) -> list[Predicted]:
    """Return predictions with rough changes.

    Args:
        predicted: (n_i,) of each test with a set of parameters.
        here: the same, roughly.
        there: with each of some other sets, roughly.
    """
    return [
        one if isinstance(one, PredictionError) else [y + (f - g) for y, f, g in zip(predicted, one, here, strict=True)]
        for one in there
    ]
