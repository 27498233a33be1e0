"""What came of a fit."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Literal

import numpy as np

from edesign.damper.damper import Damper
from edesign.damper.fitting.thermal import Thermal
from edesign.damper.law import Law
from edesign.notebook import pictures_html


@dataclass(frozen=True)
class Tested:
    """Range of motions and temperatures of the tests of a fit; beyond it a law is extrapolated.

    Attributes:
        deformation: smallest and largest amplitude, m (of a property table: shear strain, as `strain` says).
        frequency: lowest and highest mean frequency, Hz.
        temperature_C: lowest and highest, degC.
        strain: whether `deformation` is a shear strain.
    """

    deformation: tuple[float, float]
    frequency: tuple[float, float]
    temperature_C: tuple[float, float]
    strain: bool = False


@dataclass(frozen=True)
class Fit:
    """A law fitted to tests.

    Attributes:
        law: the law.
        values: all its parameters, SI, at the reference temperature.
        thermal_values: unknowns of the temperature by name: gamma_25 ..., p1, p2; {} without.
        thermal: how temperature enters.
        free: names of what was fitted, in the order of `correlation`; parameters at a bound are not among them.
        fixed: parameters that were not fitted, with the reason.
        at_bound: parameters that ended at a bound of the law or the user, with that bound, SI.
        standard_error: by name, SI: that of `error_kind`.
        standard_error_white: by name, SI, if errors of samples were independent.
        standard_error_robust: by name, SI, with errors that hang together; nan where there are too few blocks.
        error_kind: "robust"; or, where blocks of tests are too few for that, "correlation time": that of white noise
            times the root of samples per independent error.
        correlation: (n, n) of the free ones.
        nrms: of each test: squared errors over squared measurements, as a ratio (print times 100).
        nrms_overall: over all samples of all tests, as a ratio.
        rms_error: of each test: rms of the error / rms of the measured force.
        peak_error: of each test: rms of the error / largest measured force.
        determination: R2 of each test.
        condition: of the least squares, columns of unit length.
        warnings: what the user should know, in words.
        cost: half the weighted sum of squares, relative to the measured forces.
        starts: costs at the end of each start, ascending.
        same_minimum: how many starts ended at the least cost.
        iterations, evaluations: of all searches together.
        converged: whether the last search ended by itself.
        samples: how many forces (or properties) were fitted.
        tested: range of the tests.
        independent: number of independent errors: samples over the correlation time of the errors.
        against: "forces" or "properties".
    """

    law: Law
    values: dict[str, float]
    thermal_values: dict[str, float]
    thermal: Thermal
    free: tuple[str, ...]
    fixed: dict[str, str]
    at_bound: dict[str, float]
    standard_error: dict[str, float]
    standard_error_white: dict[str, float]
    standard_error_robust: dict[str, float]
    error_kind: Literal["robust", "correlation time"]
    correlation: np.ndarray
    nrms: dict[str, float]
    nrms_overall: float
    rms_error: dict[str, float]
    peak_error: dict[str, float]
    determination: dict[str, float]
    condition: float
    warnings: tuple[str, ...]
    cost: float
    starts: tuple[float, ...]
    same_minimum: int
    iterations: int
    evaluations: int
    converged: bool
    samples: int
    tested: Tested
    independent: float
    against: Literal["forces", "properties"] = "forces"
    seconds: float = field(default=0.0, compare=False)

    def _repr_html_(self) -> str:
        return pictures_html(self)

    @property
    def all_values(self) -> dict[str, float]:
        """Parameters of the law and unknowns of the temperature."""
        return {**self.values, **self.thermal_values}

    def values_at(self, temperature_C: float) -> dict[str, float]:
        """Return the parameters of the law at a temperature, SI.

        Args:
            temperature_C: degC.
        """
        return self.thermal.at(self.law, self.all_values, temperature_C)

    def damper(self, temperature_C: float | None = None) -> Damper:
        """Return the fitted damper.

        Args:
            temperature_C: degC; None: the reference temperature.
        """
        return Damper(self.law, self.values if temperature_C is None else self.values_at(temperature_C))

    @property
    def mean_rms_error(self) -> float:
        """Mean over the tests of rms error / rms of the measured force."""
        return float(np.mean(list(self.rms_error.values())))

    @property
    def follows(self) -> bool:
        """True if the law follows the tests that it was fitted to."""
        return self.mean_rms_error <= FOLLOWS

    def correlation_of(self, first: str, second: str) -> float:
        """Return the correlation of two fitted parameters.

        Args:
            second: name of another one.
        """
        return float(self.correlation[self.free.index(first), self.free.index(second)])


FOLLOWS = 0.15
"""A law follows tests where its rms error is at most this share of the rms of their forces, mean over the tests: as far
as forces and loops of one device may differ from their mean (ASCE/SEI 7-22, 18.6.1.4)."""


def mean_nrms(nrms: Mapping[str, float]) -> float:
    """Return the mean of NRMS over tests, as Table 4.1 has it."""
    return float(np.mean(list(nrms.values())))
