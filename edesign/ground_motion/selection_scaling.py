"""How records of a choice are scaled, and how good the choice then is."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Literal

import numpy as np

from edesign.codes import Spectrum
from edesign.errors import InputError

_MARGIN = 1e-9  # relative: what the common factor adds so that rounding cannot undo a criterion


@dataclass(frozen=True)
class SelectionOptions:
    """Options for scaling records and comparing choices.

    Attributes:
        scaling: `none`; `individual`, each record by its own factor to the geometric mean ratio of 1 over the band;
            `common`, all by one factor; `both`, the individual factors times a common one. The common factor is the
            one of least misfit that meets the criteria of the code.
        scale_bounds: least and largest factor of a record.
        band: ends of the periods over which misfit counts, s; None for that of the code's criteria.
        scatter_weight: of the scatter's square beside the square of the mean's deviation, at least 0.
        max_per_event: how many records of one earthquake at most; None for any number.
        max_per_station: how many records of one station in one earthquake, such as its components; None likewise.
        exhaustive_limit: up to how many combinations all are compared.
    """

    scaling: Literal["none", "individual", "common", "both"] = "both"
    scale_bounds: tuple[float, float] = (0.2, 5.0)
    band: tuple[float, float] | None = None
    scatter_weight: float = 0.2
    max_per_event: int | None = None
    max_per_station: int | None = None
    exhaustive_limit: int = 100_000

    def __post_init__(self) -> None:
        low, high = self.scale_bounds
        if not 0.0 < low <= high < math.inf:
            raise InputError(
                f"the bounds of the scale factors must rise from above zero, not {low:g} and {high:g} [E-VALUE-04]"
            )
        if self.band is not None and not 0.0 < self.band[0] < self.band[1] < math.inf:
            low, high = self.band
            raise InputError(
                f"the band of periods must rise from above zero, not {low:g} s and {high:g} s [E-VALUE-04]"
            )
        if not (math.isfinite(self.scatter_weight) and self.scatter_weight >= 0.0):
            raise InputError(
                f"the weight of the scatter must be at least zero, not {self.scatter_weight:g} [E-VALUE-02]"
            )
        for key in ("max_per_event", "max_per_station"):
            most = getattr(self, key)
            if most is not None and most < 1:
                raise InputError(f"{key} must be at least 1, not {most} [E-VALUE-02]")


@dataclass(frozen=True)
class Scaling:
    """Many choices of k records: their factors and how good they are.

    Attributes:
        common: common factor, shape (m,).
        factors: of the records, common factor included, shape (m, k).
        shortfall: what is missing to the code's criteria on the mean, relative, 0 where they hold, shape (m,).
        misfit: deviation2 + scatter_weight scatter2, shape (m,).
    """

    common: np.ndarray
    factors: np.ndarray
    shortfall: np.ndarray
    misfit: np.ndarray


class Library:
    """The candidates relative to the target, ready for many comparisons."""

    def __init__(
        self,
        periods: np.ndarray,
        psa: np.ndarray,
        pga: np.ndarray,
        spectrum: Spectrum,
        T_1: float,
        options: SelectionOptions,
    ) -> None:
        self.periods, self.psa, self.pga = periods, psa, pga
        self.spectrum, self.T_1, self.options = spectrum, T_1, options
        self.target = spectrum.acceleration(periods)
        rules = spectrum.set_rules
        low, high = options.band or rules.period_band(T_1)
        self.band = (periods >= low * (1.0 - 1e-9)) & (periods <= high * (1.0 + 1e-9))
        if not np.any(self.band) or low < periods[0] * (1.0 - 1e-9) or high > periods[-1] * (1.0 + 1e-9):
            raise InputError(f"the periods do not cover the band from {low:g} s to {high:g} s [E-MATCH-04]")
        checked = rules.in_band(periods, T_1)
        self._own = self._own_factors()
        scaled = self._own[:, None] * psa / self.target
        self._fit = scaled[:, self.band]
        self._checked = scaled[:, checked]
        self._peaks = self._own * pga / spectrum.zero_period if rules.has_zero_period else None

    def scale(self, choices: np.ndarray) -> Scaling:
        """Scale choices as the options say.

        Args:
            choices: (m, k) indices of records.
        """
        fit = self._fit[choices]
        mean, variance = np.mean(fit, axis=1), np.var(fit, axis=1)
        square = np.mean(mean**2, axis=1) + self.options.scatter_weight * np.mean(variance, axis=1)
        least = np.min(np.mean(self._checked[choices], axis=1), axis=1) / self.spectrum.set_rules.least_ratio
        if self._peaks is not None:
            least = np.minimum(least, np.mean(self._peaks[choices], axis=1))  # below 1: a criterion fails by that much
        common = np.ones(len(choices))
        own = self._own[choices]
        if self.options.scaling in ("common", "both"):
            low, high = self.options.scale_bounds
            best = np.maximum(np.mean(mean, axis=1) / square, (1.0 + _MARGIN) / least)
            common = np.minimum(np.maximum(best, low / np.min(own, axis=1)), high / np.max(own, axis=1))
        misfit = common**2 * square - 2.0 * common * np.mean(mean, axis=1) + 1.0
        shortfall = np.maximum(0.0, 1.0 - common * least)
        shortfall[shortfall < _MARGIN] = 0.0
        return Scaling(common, common[:, None] * own, shortfall, misfit)

    def _own_factors(self) -> np.ndarray:
        """Factor of each record by itself, shape (n,): least squares of the logarithms, within the bounds."""
        if self.options.scaling in ("none", "common"):
            return np.ones(len(self.psa))
        logarithms = np.log(self.psa[:, self.band] / self.target[self.band])
        return np.clip(np.exp(-np.mean(logarithms, axis=1)), *self.options.scale_bounds)
