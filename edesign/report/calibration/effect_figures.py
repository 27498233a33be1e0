"""Effects of the damper that a calibration found, as a factor or a force over what drives them."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from edesign.calibration.residual.series import Series
from edesign.calibration.results.result import Effect
from edesign.damper.temperature import REFERENCE_C
from edesign.report.calibration.view import COLOURS, View
from edesign.report.drawing.style import grid_figure, styled

if TYPE_CHECKING:
    from matplotlib.figure import Figure

_POINTS = 121
Values = Mapping[str, float]


@dataclass(frozen=True)
class _Shape:
    """How an effect follows its driver.

    Attributes:
        driver: with its unit.
        scale: the unit of the driver, SI.
        reach: least and largest value of the driver in the tests, SI.
        of: factor, or force in N, of the parameters and the driver.
        force: whether it is a force.
    """

    driver: str
    scale: float
    reach: Callable[[tuple[Series, ...]], tuple[float, float]]
    of: Callable[[Values, np.ndarray], np.ndarray]
    force: bool = False


def _largest(series: tuple[Series, ...]) -> float:
    return max(float(np.max(np.abs(one.displacement))) for one in series)


def _deformation(series: tuple[Series, ...]) -> tuple[float, float]:
    return -_largest(series), _largest(series)


def _envelope(series: tuple[Series, ...]) -> tuple[float, float]:
    return 0.0, _largest(series)


def _velocity(series: tuple[Series, ...]) -> tuple[float, float]:
    fastest = max(float(np.max(np.abs(one.velocity))) for one in series)
    return -fastest, fastest


def _path(series: tuple[Series, ...]) -> tuple[float, float]:
    return 0.0, sum(float(np.sum(np.abs(np.diff(one.displacement)))) for one in series)


def _work(series: tuple[Series, ...]) -> tuple[float, float]:
    return 0.0, sum(float(np.trapezoid(one.measured, one.displacement)) for one in series)


def _temperature(series: tuple[Series, ...]) -> tuple[float, float]:
    every = np.concatenate([one.temperature for one in series])
    return float(np.min(every)), float(np.max(every))


def _broken(p: Values, a: np.ndarray) -> np.ndarray:
    ratio = (a / p["a0"]) ** p["m"]
    return np.asarray(ratio / (1.0 + ratio))


def _threshold(p: Values, u: np.ndarray) -> np.ndarray:
    return np.asarray(p["k"] * np.maximum(np.abs(u) - p["u0"], 0.0) * np.sign(u))


def _one_sided_spring(p: Values, u: np.ndarray) -> np.ndarray:
    return np.asarray(p["k"] * np.maximum(p["side"] * u - p["u0"], 0.0) * p["side"])


def _falls(p: Values, t: np.ndarray) -> np.ndarray:
    warmer = t - REFERENCE_C
    return np.asarray(np.exp(-p["b"] * warmer / (1.0 + p.get("c", 0.0) * warmer)))


_SIDES = ("positive", "negative")
_AMPLITUDE, _U, _PATH = "recent amplitude (mm)", "displacement (mm)", "path travelled (m)"
_FALL = _Shape("temperature (°C)", 1.0, _temperature, _falls)
_SPRING = _Shape(_U, 1e-3, _deformation, _one_sided_spring, force=True)
_FACTOR = _Shape(_U, 1e-3, _deformation, lambda p, u: 1.0 + p["b"] * (p["side"] * u > 0.0))
_SHAPES: dict[tuple[str, str], _Shape] = {
    ("payne", "whole"): _Shape(_AMPLITUDE, 1e-3, _envelope, lambda p, a: 1.0 - p["d"] * _broken(p, a)),
    ("payne", "elastic"): _Shape(_AMPLITUDE, 1e-3, _envelope, lambda p, a: -p["k"] * a * _broken(p, a), force=True),
    ("mullins", "path"): _Shape(_PATH, 1.0, _path, lambda p, s: 1.0 + p["m"] * np.exp(-((s / p["s0"]) ** p["q"]))),
    ("degradation", "energy"): _Shape(
        "work done (J)",
        1.0,
        _work,
        lambda p, e: 1.0 - p["d"] * (1.0 - np.exp(-((np.maximum(e, 0.0) / p["E0"]) ** p["q"]))),
    ),
    ("degradation", "path"): _Shape(
        _PATH, 1.0, _path, lambda p, s: 1.0 - p["d"] * (1.0 - np.exp(-((s / p["s0"]) ** p["q"])))
    ),
    ("temperature_law", "exponential"): _FALL,
    ("temperature_law", "wlf"): _FALL,
    ("hardening", "power"): _Shape(
        _U, 1e-3, _deformation, lambda p, u: p["k"] * u * (np.abs(u) / p["r"]) ** (p["p"] - 1.0), force=True
    ),
    ("hardening", "threshold"): _Shape(_U, 1e-3, _deformation, _threshold, force=True),
    **{("one_sided", f"spring_{side}"): _SPRING for side in _SIDES},
    **{("one_sided", f"factor_{side}"): _FACTOR for side in _SIDES},
    ("velocity_exponent", "dashpot"): _Shape(
        "velocity (mm/s)",
        1e-3,
        _velocity,
        lambda p, v: p["F_V"] * (np.abs(v) / p["V"]) ** p["alpha"] * np.sign(v),
        force=True,
    ),
}


def effect_figures(view: View) -> Iterator[tuple[str, str, Figure]]:
    """Effects of the damper that follow one driver, over its range in the tests; others have no such curve."""
    shown = [(effect, values) for effect in view.calibration.effects if (values := _values(effect)) is not None]
    if shown:
        names = " and ".join(effect.title for effect, _ in shown)
        caption = (
            f"What was added to the law: {names}, over the range of the tests. A factor multiplies the force of the "
            "law (1: no change), a force is added to it; its uncertainty is in the table of its parameters."
        )
        yield "effects", caption, _effects_figure(view, shown)


def _values(effect: Effect) -> Values | None:
    """Parameters of an effect that can be drawn, SI; None of others."""
    if (effect.name, effect.form) not in _SHAPES:
        return None
    return {name: estimate.value for name, estimate in effect.parameters.items()} | dict(effect.fixed)


@styled
def _effects_figure(view: View, shown: list[tuple[Effect, Values]]) -> Figure:
    figure, cells = grid_figure(len(shown), 2, 3.4, 2.4)
    for axis, (effect, values) in zip(cells, shown, strict=True):
        shape = _SHAPES[(effect.name, effect.form)]
        driver = np.linspace(*shape.reach(view.calibration.series), _POINTS)
        found = shape.of(values, driver)
        axis.plot(driver / shape.scale, 1e-3 * found if shape.force else found, color=COLOURS["corrected"], lw=1.2)
        axis.set_xlabel(shape.driver)
        axis.set_ylabel("force (kN)" if shape.force else "factor")
        axis.set_title(f"{effect.name}.{effect.form}", fontsize=8.0, loc="left")
        if not shape.force:
            low, high = float(np.min(found)), float(np.max(found))
            axis.set_ylim(min(low, 1.0) - 0.05, max(high, 1.0) + 0.05)
            axis.axhline(1.0, color="#111111", lw=0.5)
    return figure
