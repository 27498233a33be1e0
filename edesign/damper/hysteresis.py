"""Dampers that yield or slip: yield force, stiffness, and the closed loop of a steady cycle of any amplitude."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import Protocol

import numpy as np
import scipy

from edesign.codes.aisc341.buckling_restrained import RestrainedBrace
from edesign.core import LawValues
from edesign.damper.restrained_cycles import RestrainedCycles
from edesign.errors import InputError
from edesign.project.reading.problems import listed

_ROUNDING = 1e-14  # relative, of forces
_MOST_STEPS = 50  # of Newton's method, which needs about five


class Hysteresis(Protocol):
    """The steady cycles of a law that does not depend on the speed of its deformation."""

    @property
    def yield_force(self) -> float:
        """Force at which the damper yields, slips or opens, N."""

    @property
    def stiffness(self) -> float:
        """Initial stiffness, N/m."""

    @property
    def hardening(self) -> float:
        """Stiffness after yielding over the initial one; nan: it keeps changing."""

    def force(self, amplitude: np.ndarray) -> np.ndarray:
        """Return the force at the largest deformation of a steady cycle, N; of different sides the mean.

        Args:
            amplitude: largest deformation (...), m.

        Returns:
            N, in the shape of `amplitude`.
        """

    def tangent(self, amplitude: np.ndarray) -> np.ndarray:
        """Return the derivative of the force by the amplitude, N/m.

        Args:
            amplitude: largest deformation (...), m.

        Returns:
            N/m, in the shape of `amplitude`.
        """

    def energy(self, amplitude: np.ndarray) -> np.ndarray:
        """Return the energy that a steady cycle dissipates, J.

        Args:
            amplitude: largest deformation (...), m.

        Returns:
            J, in the shape of `amplitude`.
        """


@dataclass(frozen=True)
class Bilinear:
    """Straight lines of two stiffnesses.

    Attributes:
        yield_force: N.
        stiffness: N/m.
        hardening: stiffness after yielding over the one before.
        loop: energy of a cycle over that of kinematic hardening; flags have less.
    """

    yield_force: float
    stiffness: float
    hardening: float
    loop: float = 1.0

    def force(self, amplitude: np.ndarray) -> np.ndarray:
        """Return the force at the largest deformation of a steady cycle, N.

        Args:
            amplitude: largest deformation (...), m.
        """
        elastic = np.minimum(amplitude, self.yield_force / self.stiffness)
        return self.stiffness * (elastic + self.hardening * (amplitude - elastic))

    def tangent(self, amplitude: np.ndarray) -> np.ndarray:
        """Return the derivative of the force by the amplitude, N/m.

        Args:
            amplitude: largest deformation (...), m.
        """
        elastic = np.asarray(amplitude) < self.yield_force / self.stiffness
        return np.where(elastic, self.stiffness, self.hardening * self.stiffness)

    def energy(self, amplitude: np.ndarray) -> np.ndarray:
        """Return 4 (1 - b) F_y (u - u_y), J: a parallelogram.

        Args:
            amplitude: largest deformation (...), m.

        Source: Christopoulos and Filiatrault (2006), Principles of Passive Supplemental Damping and Seismic Isolation.
        """
        yielded = np.maximum(amplitude - self.yield_force / self.stiffness, 0.0)
        return 4.0 * self.loop * (1.0 - self.hardening) * self.yield_force * yielded


@dataclass(frozen=True)
class RambergOsgood:
    """Ramberg and Osgood's law u = F/k (1 + a |F/F_y|^(n-1)) with Masing's rule.

    Attributes:
        stiffness: k, N/m.
        yield_force: F_y, the reference force, N.
        a, n: of the skeleton.
        hardening: nan.
    """

    stiffness: float
    yield_force: float
    a: float
    n: float
    hardening: float = np.nan

    def force(self, amplitude: np.ndarray) -> np.ndarray:
        """Return the force at the largest deformation of a steady cycle, N: Newton's method from above falls to it.

        Args:
            amplitude: largest deformation (...), m.
        """
        elastic = self.stiffness * np.asarray(amplitude) / self.yield_force
        f = np.minimum(elastic, (elastic / self.a) ** (1.0 / self.n))
        for _ in range(_MOST_STEPS):
            power = self.a * f ** (self.n - 1.0)
            step = (f * (1.0 + power) - elastic) / (1.0 + self.n * power)
            f = f - step
            if np.all(np.abs(step) <= _ROUNDING * f):
                break
        return np.asarray(self.yield_force * f)

    def tangent(self, amplitude: np.ndarray) -> np.ndarray:
        """Return the derivative of the force by the amplitude, N/m.

        Args:
            amplitude: largest deformation (...), m.
        """
        power = self.a * (self.force(amplitude) / self.yield_force) ** (self.n - 1.0)
        return np.asarray(self.stiffness / (1.0 + self.n * power))

    def energy(self, amplitude: np.ndarray) -> np.ndarray:
        """Return 4 (n - 1)/(n + 1) F times the plastic deformation at F, J.

        Args:
            amplitude: largest deformation (...), m.

        Source: Jennings (1964), Journal of the Engineering Mechanics Division 90(EM2).
        """
        force = self.force(amplitude)
        plastic = np.maximum(amplitude - force / self.stiffness, 0.0)
        return np.asarray(4.0 * (self.n - 1.0) / (self.n + 1.0) * force * plastic)


class BoucWen:
    """Bouc and Wen's law in steady cycles.

    z goes from -z_m to 0 with A + (gamma - beta) |z|^n, and on to z_m with A - (gamma + beta) z^n. The integrals over z
    are cubic Hermite splines between points that Gauss's rule finds to rounding.
    """

    def __init__(self, Fy: float, Y: float, alpha: float, A: float, beta: float, gamma: float, n: float) -> None:
        z0 = (A / (beta + gamma)) ** (1.0 / n)
        self.stiffness = Fy / Y * (alpha + (1.0 - alpha) * A)
        self.hardening = alpha * Fy / Y / self.stiffness
        self.yield_force = Fy * z0 * (alpha / A + 1.0 - alpha)  # where the lines of both stiffnesses meet
        self._parallel, self._hysteretic = alpha * Fy / Y, (1.0 - alpha) * Fy
        # y = z/z0 = 1 - exp(-w): steps of w reach z0 evenly, and u grows with w in the end
        w = np.linspace(0.0, _LARGEST_W, _POINTS)
        nodes, weights = np.polynomial.legendre.leggauss(5)
        half = 0.5 * (w[1] - w[0])
        between = w[:-1, None] + half * (1.0 + nodes)
        gone = np.exp(-between)
        power = -np.expm1(n * np.log1p(-gone))  # 1 - y^n
        away = gone / power / A  # dy / (A - c z^n)
        back = gone / (A + (gamma - beta) / (gamma + beta) * A * (1.0 - power))
        unit = 0.5 * Y * z0

        def cumulated(of: np.ndarray) -> np.ndarray:
            return np.concatenate(([0.0], np.cumsum(half * (of @ weights))))

        u = unit * cumulated(away + back)
        y = -np.expm1(-w)
        # twice the integral of z du from -z_m to z_m
        energy = 4.0 * self._hysteretic * z0 * unit * cumulated((1.0 - gone) * (away - back))
        at, power = np.exp(-w), -np.expm1(n * np.log1p(-np.exp(-w[1:])))
        slope_away = at / np.concatenate(([1.0], power)) / A
        slope_back = at / (A + (gamma - beta) / (gamma + beta) * A * (1.0 - np.concatenate(([1.0], power))))
        du = unit * (slope_away + slope_back)
        self._z = scipy.interpolate.CubicHermiteSpline(u, z0 * y, z0 * at / du)
        self._energy = scipy.interpolate.CubicHermiteSpline(
            u, energy, 4.0 * self._hysteretic * z0 * unit * y * (slope_away - slope_back) / du
        )
        self._largest, self._strength = float(u[-1]), z0

    def force(self, amplitude: np.ndarray) -> np.ndarray:
        """Return the force at the largest deformation of a steady cycle, N.

        Args:
            amplitude: largest deformation (...), m.
        """
        u = np.asarray(amplitude)
        z = np.where(u < self._largest, self._z(np.minimum(u, self._largest)), self._strength)
        return np.asarray(self._parallel * u + self._hysteretic * z)

    def tangent(self, amplitude: np.ndarray) -> np.ndarray:
        """Return the derivative of the force by the amplitude, N/m.

        Args:
            amplitude: largest deformation (...), m.
        """
        u = np.asarray(amplitude)
        slope = np.where(u < self._largest, self._z(np.minimum(u, self._largest), 1), 0.0)
        return np.asarray(self._parallel + self._hysteretic * slope)

    def energy(self, amplitude: np.ndarray) -> np.ndarray:
        """Return the energy that a steady cycle dissipates, J: the closed integral of z du.

        Args:
            amplitude: largest deformation (...), m.
        """
        u = np.asarray(amplitude)
        beyond = 4.0 * self._hysteretic * self._strength * np.maximum(u - self._largest, 0.0)
        return np.maximum(self._energy(np.minimum(u, self._largest)) + beyond, 0.0)  # where it is less than rounding


_LARGEST_W, _POINTS = 36.0, 3001  # exp(-36): z is z0 to rounding; the splines err by 1e-10

_LAWS: Mapping[str, Callable[..., Hysteresis]] = MappingProxyType(
    {
        "friction": lambda mu, N, k: Bilinear(mu * N, k, 0.0),
        "elastic_plastic": lambda k, Fy, b: Bilinear(Fy, k, b),
        "self_centring": lambda k, Fy, b, beta: Bilinear(Fy, k, b, 0.5 * beta),
        "ramberg_osgood": RambergOsgood,
        "bouc_wen": BoucWen,
        "buckling_restrained": lambda *values: RestrainedCycles(RestrainedBrace.of_law(values)),
    }
)
"""What can be sized: the hysteresis of each law from its parameters, in the order of the core."""


def hysteresis(law: LawValues) -> Hysteresis:
    """Return the steady cycles of a law that yields or slips.

    Raises:
        InputError: the law has no yield or slip force, or effects beside.

    Source: thesis Eqs. 2.22, 2.67, 2.68; Ramberg and Osgood (1943); Christopoulos, Filiatrault and Folz (2002); AISC
        341-16, F4.
    """
    if law.law not in _LAWS:
        raise InputError(
            f"the law {law.law} cannot be sized by its yield or slip force; {listed(_LAWS)} can [E-DESIGN-03]"
        )
    if law.effects:
        raise InputError(
            f"this law {law.law} has `effects`; the sizing of hysteretic dampers counts its loop alone [E-DESIGN-03]"
        )
    return _LAWS[law.law](*law.values)


def behind_brace(loop: Hysteresis, deformation: np.ndarray, flexibility: np.ndarray) -> np.ndarray:
    """Return the amplitude (d,) m of the damper in a steady cycle of damper and brace: u + f F(u) is that of both.

    Nothing in the brace dissipates, so the cycle of the damper is one of this amplitude.

    Args:
        deformation: amplitude of damper and brace, (d,) m.
        flexibility: of the brace over the force that a force of the law's stands for, (d,) m/N; 0: rigid.
    """
    u = deformation / (1.0 + flexibility * loop.stiffness)
    for _ in range(_MOST_STEPS):
        step = (u + flexibility * loop.force(u) - deformation) / (1.0 + flexibility * loop.tangent(u))
        u = np.clip(u - step, 0.0, deformation)
        if np.all(np.abs(step) <= _ROUNDING * deformation):
            break
    return np.asarray(u)
