"""What is estimated: a model that predicts tests for many sets of parameters at once."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Protocol, runtime_checkable

import numpy as np

from edesign.estimation.parameters import Parameter


class PredictionError(Exception):
    """A model cannot predict with a set of parameters; a search goes elsewhere."""


class Model(Protocol):
    """A model of tests with measured values."""

    @property
    def parameters(self) -> tuple[Parameter, ...]:
        """Parameters (p,)."""

    @property
    def measured(self) -> tuple[np.ndarray, ...]:
        """Measured values (n_i,) of each test."""

    def predict(self, values: np.ndarray) -> Sequence[Sequence[np.ndarray] | PredictionError]:
        """Return the predicted values (n_i,) of each test for each set of parameters (m, p), or why there are none."""

    def nuisance_columns(self, values: np.ndarray) -> Sequence[np.ndarray | None]:
        """Return columns (n_i, k) of the nuisance amplitudes of each test, as of the phase of hum; None: none.

        An amplitude has the prior N(0, 1): a column is as large as one standard deviation of what it stands for. A
        parameter may act through columns alone, as the frequency of hum does.

        Args:
            values: (p,) SI.
        """


@runtime_checkable
class RoughModel(Protocol):
    """A model that gives changes of predictions and of nuisance columns at less cost."""

    def near(
        self, values: np.ndarray, around: np.ndarray, predicted: Sequence[np.ndarray]
    ) -> Sequence[Sequence[np.ndarray] | PredictionError]:
        """Return predictions as `predict` does, with changes from a set of parameters near by that may be rough.

        Args:
            values: (m, p) SI.
            around: (p,) SI, near them.
            predicted: (n_i,) of each test with that set.
        """

    def columns_near(self, values: np.ndarray, around: np.ndarray) -> Sequence[np.ndarray | None]:
        """Return columns as `nuisance_columns` does; those that are rough by themselves may be as near by.

        Args:
            values: (p,) SI.
            around: (p,) SI, near them.
        """


def predict_near(
    model: Model, values: np.ndarray, around: np.ndarray, predicted: Sequence[np.ndarray]
) -> Sequence[Sequence[np.ndarray] | PredictionError]:
    """Return predictions for differences: at less cost, where a model has such ones.

    Args:
        model: of the tests.
        values: (m, p) SI.
        around: (p,) SI, near them.
        predicted: (n_i,) of each test with that set.
    """
    return model.near(values, around, predicted) if isinstance(model, RoughModel) else model.predict(values)


def columns_near(model: Model, values: np.ndarray, around: np.ndarray) -> Sequence[np.ndarray | None]:
    """Return nuisance columns (n_i, k) of each test for differences: at less cost, where a model has such ones.

    Args:
        values: (p,) SI.
        around: (p,) SI, near them.
    """
    return model.columns_near(values, around) if isinstance(model, RoughModel) else model.nuisance_columns(values)
