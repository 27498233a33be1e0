"""What any smooth function of displacement and velocity takes of a residual, whatever its equation.

A curve is a Gaussian process, as a sum of sines: its size and its length are those of the largest marginal likelihood
in the fitted tests. It is judged by the validation tests, of which chance takes nothing.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Literal

import numpy as np

from edesign.calibration.residual.series import Residual
from edesign.estimation.noise import correlation_length

Driver = Literal["displacement", "velocity"]
Of = Literal["displacement", "velocity", "sum", "product"]
UNITS: dict[Driver, str] = {"displacement": "m", "velocity": "m/s"}
_SAMPLES = 2000  # of a test
_SINES = 32  # of a curve: waves down to a twelfth of the range
_DOMAIN = 1.25  # of the range: sines are zero at its ends
_LENGTHS = np.geomspace(0.05, 3.0, 10)  # of half the range
_SIZES = np.geomspace(0.01, 10.0, 13)  # of the rms of what is left
_LEAST = 1e-9  # noise, of what is left: no curve takes more
_FITS = 4  # each under the noise that the one before leaves
_TURNS = 4  # of the two curves of a product
_CELLS = 16  # each way, of the map from which a product starts
_POINTS = 121  # of a table
_PARITY = 0.8  # share of even or odd
_SURE = 1.96  # standard errors of a 95 % band


@dataclass(frozen=True, eq=False)
class Curve:
    """A curve over displacement or velocity.

    Attributes:
        driver: over what.
        at: (n,) of it, m or m/s, ascending.
        value: (n,) N; of the velocity in a product a factor whose mean square over the tests is 1.
        error: (n,) standard error of it.
    """

    driver: Driver
    at: np.ndarray
    value: np.ndarray
    error: np.ndarray

    @property
    def band(self) -> tuple[np.ndarray, np.ndarray]:
        """Ends (n,) of its 95 % band."""
        return self.value - _SURE * self.error, self.value + _SURE * self.error

    @property
    def symmetry(self) -> str:
        """Whether it is "even" or "odd", as far as it has two sides; "" if neither."""
        return symmetry_of(self.at, self.value) or ""

    def scaled(self, factor: float) -> Curve:
        """Return it times a factor."""
        return replace(self, value=factor * self.value, error=factor * self.error)


@dataclass(frozen=True, eq=False)
class FreeCurve:
    """A force that is a smooth function of displacement u and velocity v.

    Attributes:
        of: displacement: g(u); velocity: h(v); sum: g(u) + h(v); product: g(u) h(v).
        share: of the squared residual of the validation tests, each over its rms force, that it takes.
        curves: that of the displacement, that of the velocity, or both.
    """

    of: Of
    share: float
    curves: tuple[Curve, ...]

    @property
    def words(self) -> str:
        """What it is, for people: of a single curve also whether it is even or odd."""
        if self.of in ("sum", "product"):
            return f"a {self.of} of a smooth function of the displacement and one of the velocity"
        (one,) = self.curves
        return f"a smooth function of the {self.of} alone{', ' + symmetry if (symmetry := one.symmetry) else ''}"

    def force(self, displacement: np.ndarray, velocity: np.ndarray) -> np.ndarray:
        """Return the force (n,) N at displacements (n,) m and velocities (n,) m/s; beyond a curve that of its end."""
        at = {"displacement": displacement, "velocity": velocity}
        parts = [np.interp(at[one.driver], one.at, one.value) for one in self.curves]
        return np.asarray(np.prod(parts, axis=0) if self.of == "product" else np.sum(parts, axis=0))


def free_curves(tests: Sequence[Residual]) -> tuple[FreeCurve, ...]:
    """Return what smooth functions take of a residual: g(u), h(v), their sum and their product, in this order.

    Args:
        tests: fitted ones and validation tests; nothing is told without both, nor where nothing is left or moves.

    Sources: Solin and Sarkka (2020), Statistics and Computing 30, 419-446 (a Gaussian process as a sum of sines);
    Rasmussen and Williams (2006), Gaussian Processes for Machine Learning, sections 2.2 and 5.4.1 (marginal
    likelihood), equation 4.17 (Matern's covariance of smoothness 3/2).
    """
    drivers = [np.concatenate([getattr(one, name) for one in tests]) for name in UNITS] if tests else []
    if len({one.use for one in tests}) < 2 or not all(np.any(one) for one in drivers):
        return ()
    judged, fitted = _Tests(tests, "validate"), _Tests(tests, "fit")
    if not (np.any(judged.left) and np.any(fitted.left)):
        return ()
    u, v = (_Axis(name, float(np.max(np.abs(one)))) for name, one in zip(UNITS, drivers, strict=True))
    alone = fitted.fit([u]), fitted.fit([v])
    both = fitted.fit([u, v])
    found: list[tuple[Of, tuple[Curve, ...]]] = [
        ("displacement", alone[0]),
        ("velocity", alone[1]),
        ("sum", both),
        ("product", fitted.product(u, v)),
    ]
    return tuple(FreeCurve(of, judged.share(FreeCurve(of, 0.0, curves)), curves) for of, curves in found)


def plainest(curves: Sequence[FreeCurve], nearly: float) -> FreeCurve | None:
    """Return the first of them that takes nearly as much as the one that takes most; None: there are none.

    Args:
        nearly: share of what that takes.
    """
    most = max((one.share for one in curves), default=0.0)
    return next((one for one in curves if one.share >= nearly * most), None)


def symmetry_of(at: np.ndarray, value: np.ndarray) -> str | None:
    """Return "even", "odd", "" for neither, or None where there are no two sides.

    Args:
        at: (n,) ascending.
        value: (n,) there.
    """
    reach = min(float(at[-1]), -float(at[0]))
    if reach <= 0.0:
        return None
    sides = np.linspace(0.1, 1.0, 10) * reach
    right, left = (np.interp(side * sides, at, value) for side in (1.0, -1.0))
    even, odd = (float(np.sum((right + sign * left) ** 2)) for sign in (1.0, -1.0))
    return "even" if even > _PARITY * (even + odd) else "odd" if odd > _PARITY * (even + odd) else ""


@dataclass(frozen=True)
class _Axis:
    """Sines of a coordinate from -1 to 1: the displacement, or the root of the velocity, over their largest ones.

    The root spreads tests of all frequencies, and the powers with which dampers follow the velocity.
    """

    driver: Driver
    reach: float

    @property
    def waves(self) -> np.ndarray:
        """Wave numbers (sines,)."""
        return 0.5 * np.pi * np.arange(1, _SINES + 1) / _DOMAIN

    def coordinate(self, values: np.ndarray) -> np.ndarray:
        """Return the coordinates (n,) of values, m or m/s."""
        x = values / self.reach
        return x if self.driver == "displacement" else np.asarray(np.sign(x) * np.sqrt(np.abs(x)))

    def sines(self, values: np.ndarray) -> np.ndarray:
        """Return the sines (n, sines) at values, m or m/s."""
        return np.sin(np.multiply.outer(self.coordinate(values) + _DOMAIN, self.waves)) / math.sqrt(_DOMAIN)

    def variances(self, size: float, length: float) -> np.ndarray:
        """Return the prior variances (sines,) of their amplitudes: Matern's spectral density."""
        corner = math.sqrt(3.0) / length
        return np.asarray(4.0 * size**2 * corner**3 / (corner**2 + self.waves**2) ** 2)

    def table(self, values: np.ndarray) -> np.ndarray:
        """Return values (points,) from the least to the largest one that tests have."""
        low, high = self.coordinate(np.array([values.min(), values.max()]))
        x = np.linspace(low, high, _POINTS)
        return np.asarray(self.reach * (x if self.driver == "displacement" else np.sign(x) * x**2))


class _Tests:
    """Samples of the tests of one use, each over the rms force of its test."""

    def __init__(self, tests: Sequence[Residual], use: str) -> None:
        every = [(one, slice(None, None, max(one.time.size // _SAMPLES, 1))) for one in tests if one.use == use]
        self.weight = np.concatenate([np.full(one.time[at].size, 1.0 / one.rms_force) for one, at in every])
        self.left = self.weight * np.concatenate([one.residual[at] for one, at in every])
        self.driver: dict[Driver, np.ndarray] = {
            name: np.concatenate([getattr(one, name)[at] for one, at in every]) for name in UNITS
        }
        self._ends = np.cumsum([one.time[at].size for one, at in every])[:-1]

    def share(self, curve: FreeCurve) -> float:
        """Return the share of the squared residual that a curve takes; nothing where it adds to it."""
        rest = self.left - self.weight * curve.force(self.driver["displacement"], self.driver["velocity"])
        return max(1.0 - float(rest @ rest) / float(self.left @ self.left), 0.0)

    def fit(self, axes: Sequence[_Axis], factor: np.ndarray | None = None) -> tuple[Curve, ...]:
        """Return the curves of a sum.

        Args:
            factor: (n,) of the force; None: 1.
        """
        weight = self.weight if factor is None else self.weight * factor
        columns = np.hstack([weight[:, np.newaxis] * one.sines(self.driver[one.driver]) for one in axes])
        gram, pull = columns.T @ columns, columns.T @ self.left
        unit = math.sqrt(float(self.left @ self.left) / max(float(weight @ weight), 1e-300))  # of a curve: N
        first, scales = float(self.left @ self.left) / self.left.size, [(1.0, 1.0)] * len(axes)
        noise = first
        for _ in range(_FITS):
            scales = _likeliest(axes, gram / noise, pull / noise, unit, scales)
            mean, root = _posterior(gram / noise, pull / noise, _variances(axes, unit, scales))
            noise = max(self._noise(self.left - columns @ mean), _LEAST * first)
        found = []
        for i, one in enumerate(axes):
            at, own = one.table(self.driver[one.driver]), slice(i * _SINES, (i + 1) * _SINES)
            sines = one.sines(at)
            found.append(Curve(one.driver, at, sines @ mean[own], np.linalg.norm(sines @ root[own], axis=1)))
        return tuple(found)

    def product(self, u: _Axis, v: _Axis) -> tuple[Curve, Curve]:
        """Return the curves of a product: one and the other in turns, from the map's largest singular vector."""
        edges = np.linspace(-1.0, 1.0, _CELLS + 1)
        x, y = (one.coordinate(self.driver[one.driver]) for one in (u, v))
        count = np.histogram2d(x, y, [edges, edges], weights=self.weight**2)[0]
        total = np.histogram2d(x, y, [edges, edges], weights=self.weight * self.left)[0]
        _, _, vectors = np.linalg.svd(np.divide(total, count, out=np.zeros_like(total), where=count > 0.0))
        factor = np.interp(y, 0.5 * (edges[1:] + edges[:-1]), vectors[0])
        for _ in range(_TURNS):
            (g,) = self.fit([u], factor)
            (h,) = self.fit([v], np.interp(self.driver["displacement"], g.at, g.value))
            factor = np.interp(self.driver["velocity"], h.at, h.value)
            size = math.sqrt(float(factor @ factor) / factor.size) or 1.0
            factor = factor / size
        return g.scaled(size), h.scaled(1.0 / size)

    def _noise(self, rest: np.ndarray) -> float:
        """Return the long-run variance of what a curve leaves: its variance times its correlation length."""
        parts = np.split(rest, self._ends)
        return sum(float(r @ r) * correlation_length(r) for r in parts) / rest.size


def _variances(axes: Sequence[_Axis], unit: float, scales: Sequence[tuple[float, float]]) -> np.ndarray:
    """Return the prior variances of all amplitudes, from the size and the length of each curve."""
    return np.concatenate(
        [one.variances(unit * size, length) for one, (size, length) in zip(axes, scales, strict=True)]
    )


def _likeliest(
    axes: Sequence[_Axis], gram: np.ndarray, pull: np.ndarray, unit: float, scales: Sequence[tuple[float, float]]
) -> list[tuple[float, float]]:
    """Return the size and length of each curve with the largest marginal likelihood, one curve after the other."""
    found = list(scales)
    for i in range(len(axes)):
        every = [[*found[:i], (size, length), *found[i + 1 :]] for size in _SIZES for length in _LENGTHS]
        deviation = np.sqrt([_variances(axes, unit, one) for one in every])
        whole = np.eye(pull.size) + deviation[:, :, np.newaxis] * gram * deviation[:, np.newaxis]
        shown = deviation * pull
        solved = np.linalg.solve(whole, shown[:, :, np.newaxis])[:, :, 0]
        evidence = 0.5 * np.sum(shown * solved, axis=1) - 0.5 * np.linalg.slogdet(whole).logabsdet
        found = every[int(np.argmax(evidence))]
    return found


def _posterior(gram: np.ndarray, pull: np.ndarray, variances: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return the mean (k,) of the amplitudes, and a root S (k, k) of their covariance S S'."""
    deviation = np.sqrt(variances)
    whole = np.linalg.cholesky(np.eye(deviation.size) + deviation[:, np.newaxis] * gram * deviation)
    root = deviation[:, np.newaxis] * np.linalg.inv(whole).T
    return root @ (root.T @ pull), root
