"""Delay compensators by their formulas, as difference equations or adaptive laws that the core runs.

Each function gives a compensator for a main step. docs/theory/compensators.md has a page for each, with its source.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from edesign.core.compensator import MEMORY, AdaptiveTimeSeries, DifferenceEquation, Signal, Term
from edesign.errors import InputError

_INTERPOLATED = 4
"""Samples through which a signal between samples is interpolated: a cubic, exact to the fourth order of the step."""


def none() -> DifferenceEquation:
    """Return the compensator that sends the target as it is."""
    return DifferenceEquation((Term("target", 0, 1.0),))


def polynomial(order: int, delay: float, step: float, spacing: float | None = None) -> DifferenceEquation:
    """Return the extrapolation of a polynomial through the last order + 1 targets.

    With nodes a delay apart its coefficients are binomial ones: of the third order 4, -6, 4, -1.

    Args:
        delay: by which it extrapolates, s.
        step: main step, s.
        spacing: of the nodes, s; the delay without it.

    Raises:
        InputError: the nodes reach further back than a compensator remembers, or nearer than a step.

    Source: Horiuchi, Inoue, Konno & Namita (1999), Earthquake Engng Struct. Dyn. 28, 1121-1141.
    """
    apart = delay if spacing is None else spacing
    if order > 0 and apart < step:
        raise InputError(f"polynomial: nodes {apart:g} s apart are closer than the main step of {step:g} s [E-RTS-04]")
    nodes = -apart * np.arange(order + 1)
    return _equation(_delayed("target", -nodes / step, _lagrange(nodes, delay), step))


def least_squares_polynomial(order: int, points: int, delay: float, step: float) -> DifferenceEquation:
    """Return the extrapolation of a polynomial fitted to the last targets by least squares.

    Args:
        points: targets, a step apart; more than the order.
        delay: by which it extrapolates, s.
        step: main step, s.

    Source: Wallace, Wagg & Neild (2005), Proc. R. Soc. A 461, 3807-3826.
    """
    back = np.arange(points)
    powers = np.vander(-back.astype(float), order + 1, increasing=True)
    ahead = np.vander([delay / step], order + 1, increasing=True)[0]
    weights = ahead @ np.linalg.pinv(powers)
    return _equation([Term("target", int(lag), float(weight)) for lag, weight in zip(back, weights, strict=True)])


def linear_acceleration(delay: float, step: float) -> DifferenceEquation:
    """Return x + d v + d2/3 a + d2/6 a_ahead, the acceleration a delay ahead by the line through a and a delay before.

    Args:
        delay: d, s.
        step: main step, s.

    Source: Horiuchi & Konno (2001), Phil. Trans. R. Soc. A 359, 1893-1909.
    """
    now = [Term("target", 0, 1.0), Term("velocity", 0, delay), Term("acceleration", 0, delay**2 / 3.0)]
    ahead = _delayed("acceleration", [0.0, delay / step], np.array([2.0, -1.0]) * delay**2 / 6.0, step)
    return _equation([*now, *ahead])


def inverse(delay: float, step: float) -> DifferenceEquation:
    """Return u_k = a x_k - (a - 1) x_(k-1), a = delay / step + 1: the inverse of a first-order rig.

    Args:
        delay: of the rig, s.
        step: main step, s.

    Source: Chen & Ricles (2009), Earthquake Engng Struct. Dyn. 38, 1147-1165.
    """
    a = delay / step + 1.0
    return DifferenceEquation((Term("target", 0, a), Term("target", 1, 1.0 - a)))


def phase_lead(lead: float, lag: float, step: float) -> DifferenceEquation:
    """Return (lead s + 1) / (lag s + 1) by the bilinear rule.

    Args:
        lead: s.
        lag: s.
        step: main step, s.
    """
    forward, backward = 2.0 * lead / step, 2.0 * lag / step
    below = backward + 1.0
    return DifferenceEquation(
        (
            Term("target", 0, (forward + 1.0) / below),
            Term("target", 1, (1.0 - forward) / below),
            Term("command", 1, (backward - 1.0) / below),
        )
    )


def fixed_alpha(alpha: Sequence[float], step: float) -> DifferenceEquation:
    """Return alpha_0 x + alpha_1 v + alpha_2 a + alpha_3 a', Taylor's series of the inverse rig.

    The derivative a' is a backward difference.

    Args:
        alpha: two to four values, s to the power of their place.
        step: main step, s.

    Returns:
        The compensator as a difference equation.

    Source: thesis Eq. 6.16; as feed-forward of a model, Phillips & Spencer (2013), J. Struct. Eng. 139, 04013001.
    """
    signals: list[Signal] = ["target", "velocity", "acceleration"]
    terms = [Term(of, 0, value) for of, value in zip(signals, alpha, strict=False)]
    if len(alpha) > len(signals):
        terms += [Term("acceleration", 0, alpha[3] / step), Term("acceleration", 1, -alpha[3] / step)]
    return _equation(terms)


def smith(delay: float, gain: float, stiffness: float, damping: float, step: float) -> DifferenceEquation:
    """Return the Smith predictor, which sends the target as it is and corrects the measured force.

    A model of rig and specimen says what is missing in it: k (x - g x_late) + c (v - g v_late).

    Args:
        delay: of the rig, s.
        gain: g of the rig, dimensionless.
        stiffness: k of the specimen, N/m.
        damping: c of the specimen, N s/m.
        step: main step, s.

    Returns:
        The compensator as a difference equation.

    Source: Smith (1957), Chem. Eng. Prog. 53, 217-219.
    """
    force: list[Term] = []
    pairs: list[tuple[Signal, float]] = [("target", stiffness), ("velocity", damping)]
    for of, factor in pairs:
        force += _delayed(of, [0.0, delay / step], factor * np.array([1.0, -gain]), step)
    return DifferenceEquation((Term("target", 0, 1.0),), _merged(force))


def butterworth(order: int, cutoff: float, step: float) -> np.ndarray:
    """Return the sections of a low-pass filter as the core takes them, (n, 5) b0, b1, b2, a1, a2.

    Each is w^2 / (s^2 + 2 zeta w s + w^2) by the bilinear rule, exact at the cut-off; the least damped stands last.
    `scipy.signal` has them too, and takes a second to load.

    Args:
        order: even.
        cutoff: Hz.
        step: main step, s.

    Source: Oppenheim & Schafer, Discrete-Time Signal Processing, 7.1.
    """
    w = math.tan(math.pi * cutoff * step)
    sections = []
    for k in range(order // 2):
        damped = 2.0 * w * math.cos((2 * k + 1) * math.pi / (2 * order))
        below = 1.0 + damped + w**2
        gain = w**2 / below
        sections.append([gain, 2.0 * gain, gain, 2.0 * (w**2 - 1.0) / below, (1.0 - damped + w**2) / below])
    return np.array(sections)


def pi_phase_lead(proportional: float, integral: float, lead: float, lag: float, step: float) -> DifferenceEquation:
    """Return (p + i/s) on the target led by (lead s + 1) / (lag s + 1), less what is measured; by the bilinear rule.

    Target and measured are of one instant, the start of the main step.

    Args:
        proportional: p, dimensionless.
        integral: i, 1/s.
        lead: time constant of the numerator of the filter before the loop, s.
        lag: time constant of its denominator, s.
        step: main step, s.

    Returns:
        The compensator as a difference equation.

    Source: sample controller of the virtual RTHS benchmark, Silva, Gomez, Maghareh, Dyke & Spencer (2020).
    """
    controller, below = _bilinear((proportional, integral), (1.0, 0.0), step)
    ahead, ahead_below = _bilinear((lead, 1.0), (lag, 1.0), step)
    of_target, of_measured = np.convolve(controller, ahead), np.convolve(controller, ahead_below)
    own = np.convolve(below, ahead_below)
    terms = [Term("target", late + 1, float(value)) for late, value in enumerate(of_target)]
    terms += [Term("measured", late, -float(value)) for late, value in enumerate(of_measured)]
    terms += [Term("command", late, -float(value)) for late, value in enumerate(own) if late]
    return DifferenceEquation(tuple(terms))


def _bilinear(above: tuple[float, float], below: tuple[float, float], step: float) -> tuple[np.ndarray, np.ndarray]:
    """Return what becomes of (a s + b) / (c s + d) with s = 2 (1 - z) / ((1 + z) step): coefficients of 1 and z."""
    rates = 2.0 / step * np.array([above[0], below[0]])
    (first, second), (first_below, second_below) = (
        (rate + rest, rest - rate) for rate, rest in zip(rates, (above[1], below[1]), strict=True)
    )
    return np.array([first, second]) / first_below, np.array([1.0, second_below / first_below])


def ats(window: float, every: int, step: float, adaptive: AdaptiveTimeSeries) -> AdaptiveTimeSeries:
    """Return the adaptive time series compensator over a window with equal weights.

    Args:
        window: s.
        every: of so many main steps one counts.
        step: main step, s.
        adaptive: its limits, rates and filter.

    Source: Chae, Kazemibidokhti & Ricles (2013), Earthquake Engng Struct. Dyn. 42, 1697-1715; thesis 6.2.2.
    """
    return replace(adaptive, window=round(window / step), every=every, forgetting=None)


def modified_ats(forgetting: float, adaptive: AdaptiveTimeSeries) -> AdaptiveTimeSeries:
    """Return the modified adaptive time series compensator, whose samples lose weight each step.

    Args:
        forgetting: factor on the weight each step.
        adaptive: its limits, rates and filter.

    Source: Malloy & Blakeborough in the thesis, 6.2.3, Eqs. 6.18-6.27.
    """
    return replace(adaptive, forgetting=forgetting)


def response(compensator: DifferenceEquation, step: float, s: np.ndarray) -> np.ndarray:
    """Return command over target; terms of the measured displacement do not count.

    Args:
        step: main step, s.
        s: (m,) complex frequencies, 1/s.

    Returns:
        In the shape of `s`, dimensionless.
    """
    above, below = np.zeros(np.shape(s), dtype=complex), np.ones(np.shape(s), dtype=complex)
    order = {"target": 0, "velocity": 1, "acceleration": 2}
    for term in compensator.terms:
        late = np.exp(-s * term.lag * step)
        if term.of == "command":
            below -= term.coefficient * late
        elif term.of != "measured":
            above += term.coefficient * s ** order[term.of] * late
    return np.asarray(above / below)


def _lagrange(nodes: np.ndarray, at: float) -> np.ndarray:
    """Weights of the polynomial through values at nodes, at a place."""
    weights = np.ones(len(nodes))
    for i, own in enumerate(nodes):
        for j, other in enumerate(nodes):
            if j != i:
                weights[i] *= (at - other) / (own - other)
    return weights


def _delayed(of: Signal, lags: Sequence[float] | np.ndarray, weights: np.ndarray, step: float) -> list[Term]:
    """Terms of a signal at lags (main steps) that need not be whole: a cubic through the nearest samples."""
    terms = []
    for lag, weight in zip(lags, weights, strict=True):
        whole = round(lag)
        if math.isclose(lag, whole, abs_tol=1e-9):
            terms.append(Term(of, whole, float(weight)))
            continue
        nodes = np.arange(_INTERPOLATED) + max(math.floor(lag) - 1, 0)
        shares = _lagrange(nodes.astype(float), lag)
        terms += [Term(of, int(node), float(weight * share)) for node, share in zip(nodes, shares, strict=True)]
    if any(term.lag >= MEMORY for term in terms):
        raise InputError(
            f"the compensator would look back {max(lags):g} main steps of {step:g} s; {MEMORY} at most [E-RTS-04]"
        )
    return terms


def _merged(terms: Sequence[Term]) -> tuple[Term, ...]:
    """One term for each signal and lag."""
    sums: dict[tuple[Signal, int], float] = {}
    for term in terms:
        sums[term.of, term.lag] = sums.get((term.of, term.lag), 0.0) + term.coefficient
    return tuple(Term(of, lag, value) for (of, lag), value in sums.items())


def _equation(terms: Sequence[Term]) -> DifferenceEquation:
    return DifferenceEquation(_merged(terms))
