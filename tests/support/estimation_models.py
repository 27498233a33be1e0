"""Models in closed form for the estimator."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field

import numpy as np

from edesign.estimation.model import PredictionError
from edesign.estimation.parameters import Parameter

Tests = Sequence[np.ndarray]


@dataclass
class FormulaModel:
    """A model whose predictions are a function of one set of values."""

    parameters: tuple[Parameter, ...]
    measured: tuple[np.ndarray, ...]
    formula: Callable[[np.ndarray], Tests | PredictionError]
    columns: Callable[[np.ndarray], Sequence[np.ndarray | None]] | None = None
    batches: list[int] = field(default_factory=list)

    def predict(self, values: np.ndarray) -> list[Tests | PredictionError]:
        self.batches.append(len(values))
        return [self.formula(one) for one in values]

    def nuisance_columns(self, values: np.ndarray) -> Sequence[np.ndarray | None]:
        return self.columns(values) if self.columns else [None] * len(self.measured)


def linear(matrices: Tests, measured: Tests, parameters: Sequence[Parameter]) -> FormulaModel:
    return FormulaModel(tuple(parameters), tuple(measured), lambda v: [matrix @ v for matrix in matrices])


def free(names: str, scale: float = 1.0, lower: float = -np.inf, upper: float = np.inf) -> tuple[Parameter, ...]:
    """Parameters with flat priors."""
    return tuple(Parameter(name, "", lower, upper, 0.0, scale, flat=True) for name in names)


def normal(names: str, spread: float = 1.0, centre: float = 0.0) -> tuple[Parameter, ...]:
    return tuple(Parameter(name, "", -np.inf, np.inf, centre, spread) for name in names)
