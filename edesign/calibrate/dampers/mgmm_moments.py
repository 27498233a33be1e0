"""Force of the MGMM by moments of its terms over each step of a motion.

Moments hold for all relaxation times and moduli (ed_mgmm_moments): once they are known, a force is a recursion over the
steps. They depend on the motion, on alpha, and on what softens the moduli.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from functools import lru_cache
from typing import NamedTuple

import numpy as np
from numpy.polynomial.chebyshev import chebvander
from scipy.special import ive

from edesign.calibrate.dampers.trial import Motion
from edesign.core.damper import MOMENTS, CoreDamper, Term
from edesign.core.fading import fading
from edesign.damper.history import NONE, Extremes

_MOTIONS = 96  # moments of tests, with some powers each
_SHORTEST = (2.00001, 1.35)
"""Relaxation times over the longest step to which moments suit: the series of an exponential fading over a step misses
8e-9 and 8e-8 of it then with 6 terms.
"""
_LARGEST_POWER = 2.0  # of the law
_NODES = 6
_SHAPES, _ALPHAS = 0.2, 0.1
"""Sections of the logarithm of u_ref and v_ref, and of alpha, within which moments are interpolated between so many
nodes: exp(-a/u_ref) and |v|^alpha to 1e-8 of the largest.
"""
_LENGTHS = 8  # different steps of a motion, up to which series are made for each
_ONE = np.ones(1)
_SAME = 1e-9  # relative difference of steps


def by_moments(p: Mapping[str, float], motion: Motion, been: Extremes, v_ref: float | None) -> np.ndarray | None:
    """Force (n,) N of an MGMM; None: moments do not suit, or no law has such parameters.

    Args:
        p: all its parameters, SI.
        motion: of the specimen.
        been: what it went through before.
        v_ref: about 1e-7 of which the power of the velocity is rounded, m/s; None: as `p` has it.

    Raises:
        CoreError: the motion is none.
    """
    above = min(p[name] for name in ("k1", "c1", "alpha", "u_ref", "v_ref"))
    if not (above > 0.0 and min(p.values()) >= 0.0 and p["alpha"] <= _LARGEST_POWER):
        return None
    tau = float(f"{p['c1'] / p['k1']:.13g}")  # the same where temperature has multiplied both
    lengths, _ = _lengths(motion)
    shortest = next((s for s in _SHORTEST if tau >= s * lengths[-1]), None)
    if shortest is None or len(lengths) > _LENGTHS or p["consistent"]:
        return None
    shortest *= float(lengths[-1])
    # c v relaxes to c (u - R) / tau, if u relaxes to R
    pace = (p["c1"] + p["c_b"]) / tau
    made, begun = (p["k_b"] - pace) * _straight(tau, motion), (p["k_b"] - pace) * motion.displacement[0]
    if p["k_a"]:
        spring, held = _made(_Term("spring", shortest, been), p["u_ref"], tau, motion)
        made, begun = made + p["k_a"] * spring, begun + p["k_a"] * held
    if p["c_a"]:
        dashpot, _ = _made(_Term("dashpot", shortest, been), p["v_ref"], tau, motion)
        made = made + p["c_a"] * dashpot
    if p["c_NL"]:
        power, _ = _made(_Term("power", shortest, NONE, v_ref or p["v_ref"]), p["alpha"], tau, motion)
        made = made + p["c_NL"] * power
    relaxing = fading(_fading(tau, motion).decay, made, float(begun))
    return np.asarray((p["k0"] + pace) * motion.displacement + relaxing)


class _Fading(NamedTuple):
    """Over each step of a motion.

    Attributes:
        decay: (n - 1,) what a relaxation leaves of a force.
        series: (MOMENTS,), or (MOMENTS, n - 1) where steps differ, by which moments of a force make the relaxed one.
    """

    decay: np.ndarray
    series: np.ndarray

    def made(self, moments: np.ndarray, weights: np.ndarray = _ONE) -> np.ndarray:
        """Of moments (k, MOMENTS, n - 1) with weights (k,): what each step makes (n - 1,)."""
        k, _, steps = moments.shape
        if self.series.ndim == 1:
            return np.asarray(np.outer(weights, self.series).ravel() @ moments.reshape(k * MOMENTS, steps))
        return np.einsum("k,kij,ij->j", weights, moments, self.series, optimize=True)


@lru_cache(maxsize=_MOTIONS)
def _lengths(motion: Motion) -> tuple[np.ndarray, np.ndarray]:
    """Different lengths (m,) of the steps of a motion, s, ascending, and which each step (n - 1,) has."""
    steps = motion.steps
    unit = float(np.max(steps)) * _SAME if steps.size else 1.0
    rounded, which = np.unique(np.round(steps / unit), return_inverse=True)
    return (rounded * unit if steps.size else np.ones(1)), which


@lru_cache(maxsize=2 * _MOTIONS)
def _fading(tau: float, motion: Motion) -> _Fading:
    lengths, which = _lengths(motion)
    # exp(-(1 - x) t) = exp(-t/2) (I_0(t/2) + 2 sum I_k(t/2) T_k(2 x - 1)): Abramowitz & Stegun (1964), 9.6.34
    time = lengths / tau
    order = np.arange(MOMENTS)[:, np.newaxis]
    series, decay = time * np.where(order, 2.0, 1.0) * ive(order, 0.5 * time), np.exp(-time)
    return _Fading(decay[which], series[:, 0] if len(lengths) == 1 else series[:, which])


def _hermite() -> np.ndarray:
    """Moments (4, MOMENTS) over a step of the cubics with value or slope 1 at its beginning or end, else 0 there."""
    x, weights = np.polynomial.legendre.leggauss(MOMENTS)
    s = 0.5 * (1.0 + x)
    cubics = np.array([(1.0 + 2.0 * s) * (1.0 - s) ** 2, s**2 * (3.0 - 2.0 * s), s * (1.0 - s) ** 2, s**2 * (s - 1.0)])
    return np.asarray((0.5 * weights * cubics) @ chebvander(x, MOMENTS - 1))


_HERMITE = _hermite()


@lru_cache(maxsize=2 * _MOTIONS)
def _straight(tau: float, motion: Motion) -> np.ndarray:
    """What the deformation makes (n - 1,) m in each step."""
    return _fading(tau, motion).made(_straight_moments(motion))


@lru_cache(maxsize=_MOTIONS)
def _straight_moments(motion: Motion) -> np.ndarray:
    u, v, h = motion.displacement, motion.velocity, motion.steps
    return (_HERMITE.T @ np.array((u[:-1], u[1:], h * v[:-1], h * v[1:])))[np.newaxis]


class _Term(NamedTuple):
    """A term whose shape has one parameter: u_ref of springs, v_ref of dashpots, alpha of the power."""

    of: Term
    shortest: float
    been: Extremes
    v_ref: float = 1.0

    def moments(self, shape: float, motion: Motion) -> tuple[np.ndarray, float]:
        """Moments (MOMENTS, n - 1), and what the term is at the first sample, where the specimen is held."""
        u_ref, v_ref, alpha = (shape if self.of == name else 1.0 for name in ("spring", "dashpot", "power"))
        v_ref = self.v_ref if self.of == "power" else v_ref
        values = (1.0, self.shortest, 0.0, 1.0, alpha, 1.0, 0.0, u_ref, 1.0, 0.0, v_ref, 0.0)
        damper = CoreDamper("mgmm", values, been=self.been)
        moments, held = damper.moments(motion.time, motion.displacement, motion.velocity, self.of)
        return moments.T, held


@lru_cache(maxsize=4 * _MOTIONS)
def _made(term: _Term, shape: float, tau: float, motion: Motion) -> tuple[np.ndarray, float]:
    """What a term makes (n - 1,) in each step, and what it is at the first sample."""
    fades = _fading(tau, motion)
    position = shape / _ALPHAS if term.of == "power" else math.log(shape) / _SHAPES
    section = math.floor(position)
    asked = _asked_in_section(term, section, motion)
    asked[0] += 1
    if asked[0] <= _NODES or (term.of == "power" and not 0 < section < _LARGEST_POWER / _ALPHAS - 1):
        moments, held = term.moments(shape, motion)
        return fades.made(np.ascontiguousarray(moments)[np.newaxis]), held
    nodes, held_at_nodes = _nodes(term, section, motion)
    weights = _weights(position - section)
    return fades.made(nodes, weights), float(weights @ held_at_nodes)


@lru_cache(maxsize=4 * _MOTIONS)
def _asked_in_section(term: _Term, section: int, motion: Motion) -> list[int]:
    return [0]


@lru_cache(maxsize=_MOTIONS)
def _nodes(term: _Term, section: int, motion: Motion) -> tuple[np.ndarray, np.ndarray]:
    """Moments (_NODES, MOMENTS, n - 1) with shapes at Chebyshev's nodes of a section, and what is held there."""
    positions = section + 0.5 * (1.0 + _AT)
    shapes = _ALPHAS * positions if term.of == "power" else np.exp(_SHAPES * positions)
    found = [term.moments(float(shape), motion) for shape in shapes]
    return np.ascontiguousarray([moments for moments, _ in found]), np.array([held for _, held in found])


_ORDERS = np.arange(_NODES)
_AT = np.cos(np.pi * (_ORDERS + 0.5) / _NODES)
_POLYNOMIALS = chebvander(_AT, _NODES - 1) * np.where(_ORDERS, 2.0, 1.0) / _NODES


def _weights(share: float) -> np.ndarray:
    """Of the nodes (_NODES,) at a share of a section: Lagrange's polynomials, by Chebyshev's."""
    return np.asarray(_POLYNOMIALS @ np.cos(_ORDERS * math.acos(min(2.0 * share - 1.0, 1.0))))
