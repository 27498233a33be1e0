"""What the figures of a calibration share: stages that differ, tests that show most, windows and thinned curves."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from edesign.calibration.residual.cycles import Cycles
from edesign.calibration.residual.pool import Dependence, Pool, against
from edesign.calibration.residual.series import FEWEST, Residual, Series, Stage
from edesign.calibration.residual.whiteness import effective_samples
from edesign.calibration.results.result import Calibration
from edesign.report.calibration.error_tables import label_of
from edesign.report.drawing.style import AFTER, BEFORE, MEAN, VARIANTS
from edesign.report.drawing.thin_out import thin_out

MEASURED, NOISE = BEFORE, MEAN
COLOURS: dict[Stage, str] = {"declared": VARIANTS[0], "refit": VARIANTS[2], "corrected": AFTER}
MOST_TESTS = 4
_MOST_SAMPLES = 3000  # of a test, for means over bins
_HALF_CYCLES = 3  # on each side of the one that is shown
_TOLERANCE = 2e-3  # of the range of a curve
_COLUMNS = 400  # of a history: what a figure can show


@dataclass(frozen=True, eq=False)
class View:
    """A calibration as its figures show it.

    Attributes:
        calibration: what was found.
    """

    calibration: Calibration

    @cached_property
    def stages(self) -> dict[Stage, str]:
        """Before and after in words; only before if nothing was changed."""
        if self.calibration.effects:
            return {"declared": "as declared", "corrected": "corrected"}
        if self.calibration.law_fixed:
            return {"declared": "as declared"}
        return {"declared": "as declared", "corrected": "fitted again"}

    @cached_property
    def most_different(self) -> tuple[Series, ...]:
        """Tests with the largest errors of the declared law, half of them for validation, in their order."""
        errors = self.calibration.errors["declared"].tests
        ranked = sorted(self.calibration.series, key=lambda one: -errors[one.name])
        half = MOST_TESTS // 2
        first = [*[s for s in ranked if s.use == "validate"][:half], *[s for s in ranked if s.use == "fit"][:half]]
        rest = [one for one in ranked if one not in first]
        return tuple(sorted((first + rest)[:MOST_TESTS], key=lambda one: one.order))

    @cached_property
    def motions(self) -> dict[str, Cycles]:
        """Of each test by name."""
        return {one.name: Cycles(one.time, one.displacement) for one in self.calibration.series}

    def residuals(self, stage: Stage) -> tuple[Residual, ...]:
        """Of all tests that are long enough."""
        return tuple(one.residual(stage) for one in self.calibration.series if one.time.size >= FEWEST)

    @cached_property
    def dependences(self) -> dict[Stage, tuple[Dependence, ...]]:
        """Residuals against what may explain them, in every stage shown, from every so many samples of a test."""
        found: dict[Stage, tuple[Dependence, ...]] = {}
        motions: list[Cycles] = []
        for stage in self.stages:
            tests = self.residuals(stage)
            samples = [effective_samples(test.residual) for test in tests]
            light = [_lighter(test) for test in tests]
            motions = motions or [Cycles(test.time, test.displacement) for test in light]
            found[stage] = against(Pool(light, motions, samples, 0.0))
        return found

    def window(self, series: Series) -> slice:
        """The half cycles about the one with the largest error of the declared law."""
        number = self.motions[series.name].half_cycles.number
        error = np.bincount(number, residual(series, "declared") ** 2) / np.maximum(np.bincount(number), 1)
        worst = int(np.argmax(error))
        inside = np.flatnonzero(np.abs(number - worst) <= _HALF_CYCLES)
        return slice(int(inside[0]), int(inside[-1]) + 1)


def residual(series: Series, stage: Stage) -> np.ndarray:
    """Measured less predicted force (n,), N."""
    return np.asarray(series.measured - series.predicted[stage])


def _lighter(test: Residual) -> Residual:
    step = max(test.time.size // _MOST_SAMPLES, 1)
    return replace(
        test,
        time=test.time[::step],
        displacement=test.displacement[::step],
        velocity=test.velocity[::step],
        measured=test.measured[::step],
        predicted=test.predicted[::step],
        temperature_C=test.temperature[::step],
    )


def curve(x: np.ndarray, y: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """A curve without the points that nobody can see."""
    scale = np.array([np.ptp(x) or 1.0, np.ptp(y) or 1.0])
    points = thin_out(np.column_stack((x, y)) / scale, _TOLERANCE) * scale
    return points[:, 0], points[:, 1]


def outline(time: np.ndarray, values: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """A history as the least and the largest value in each of many columns, in their order."""
    if time.size <= 2 * _COLUMNS:
        return time, values
    parts: Sequence[np.ndarray] = np.array_split(np.arange(time.size), _COLUMNS)
    at = np.concatenate([np.sort([part[np.argmin(values[part])], part[np.argmax(values[part])]]) for part in parts])
    return time[at], values[at]


def series_label(series: Series) -> str:
    """Name, title and use of a test."""
    return f"{label_of(series)} ({'validation' if series.use == 'validate' else 'fitted'})"


def excess(one: Dependence) -> float:
    """Share of the squared residual that a dependence explains above chance."""
    return max(one.share - one.chance, 0.0)
