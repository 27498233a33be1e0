"""How the ordinates of a response spectrum answer to a factor on the Fourier spectrum."""

from __future__ import annotations

import numpy as np
import scipy

from edesign.ground_motion.matching.fourier_factor import FourierFactor


class Sensitivity:
    """Derivative of the log of spectral ordinates with respect to theta of a `FourierFactor`.

    While the time t_i of the peak of oscillator i stands still, the peak is linear in the factor: it is the sum over
    frequencies of transfer function times Fourier spectrum times exp(i omega t_i), and each term is proportional to the
    factor at its frequency. The ground itself is the first row: an oscillator of period zero.
    """

    def __init__(self, factor: FourierFactor, time_step: float, periods: np.ndarray, damping: float) -> None:
        """Prepare.

        Args:
            factor: whose theta is meant.
            time_step: s.
            periods: of the oscillators, greater than zero, shape (n_p,), s.
            damping: ratio of critical.
        """
        self._factor = factor
        self._roots = np.exp(2j * np.pi / factor.length * np.arange(factor.length))  # exp(i omega t) of all samples
        natural, forced = 2.0 * np.pi / periods[:, None], 2.0 * np.pi * factor.frequency
        oscillators = natural**2 / (natural**2 - forced**2 + 2j * damping * natural * forced)
        self._transfer = np.vstack((np.ones(forced.size), oscillators))
        damped = natural[:, 0] * np.sqrt(1.0 - damping**2) * time_step
        decay = np.exp(-damping * natural[:, 0] * time_step)
        self._recursion = [
            (np.array([0.0, d * np.sin(w)]), np.array([1.0, -2.0 * d * np.cos(w), d * d]))
            for d, w in zip(decay, damped, strict=True)
        ]

    def _peak_samples(self, acceleration: np.ndarray) -> np.ndarray:
        """Return the sample at which each oscillator's displacement is largest, the ground first, shape (n_p + 1,).

        Oscillators are driven by one impulse a sample: right for the time of the peak, up to a constant factor in size.

        Args:
            acceleration: (n,) m/s2.
        """
        at = [int(np.argmax(np.abs(acceleration)))]
        at += [int(np.argmax(np.abs(scipy.signal.lfilter(b, a, acceleration)))) for b, a in self._recursion]
        return np.array(at)

    def matrix(self, acceleration: np.ndarray) -> np.ndarray:
        """Return the derivatives of the ordinates, ground first, shape (n_p + 1, n_n).

        Args:
            acceleration: (n,) m/s2.
        """
        turned = self._roots[np.outer(self._peak_samples(acceleration), self._factor.index) % self._roots.size]
        terms = np.real(self._transfer * self._factor.transform(acceleration) * turned)
        return np.asarray((self._factor.hats.T @ terms.T).T) / np.sum(terms, axis=1, keepdims=True)
