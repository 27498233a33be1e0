"""A real factor on the Fourier spectrum of a motion, smooth over log frequency; the phase stays."""

from __future__ import annotations

import numpy as np
import scipy

from edesign.ground_motion.transform_length import transform_length

TRANSITION = 0.4
"""Width of the smooth passage to 1 at either end, in log frequency (0.58 octaves)."""


class FourierFactor:
    """The factor exp(sum of theta_j hat_j(log f)): nodes evenly spaced in log frequency, 1 outside of the nodes.

    Attributes:
        nodes: frequencies of the nodes, shape (n_n,), Hz; theta of the first and the last is zero by definition.
        length: of the transform, in samples.
        index: of the frequencies that lie between the end nodes, in units of 1 / (length time_step), shape (n_f,).
        frequency: the same in Hz, shape (n_f,).
        hats: value of each hat function at each of them, sparse, shape (n_f, n_n).
    """

    def __init__(self, samples: int, time_step: float, lowest: float, highest: float, spacing: float) -> None:
        """Prepare the factor for motions of one length.

        Args:
            samples: of the motion; it is padded with as many zeros before it is transformed.
            time_step: s.
            lowest: frequency above which the factor may differ from 1, Hz.
            highest: frequency below which it may, Hz; the Nyquist frequency at the most.
            spacing: of the nodes, in log frequency.
        """
        self.length = transform_length(2 * samples)
        frequency = np.fft.rfftfreq(self.length, time_step)
        highest = min(highest, 0.5 / time_step)
        count = max(3, round(np.log(highest / lowest) / spacing) + 1)
        self.nodes = np.geomspace(lowest, highest, count)
        self.index = np.flatnonzero((frequency > lowest) & (frequency < highest))
        self.frequency = frequency[self.index]
        position = np.interp(np.log(self.frequency), np.log(self.nodes), np.arange(count))
        left = np.minimum(position.astype(int), count - 2)
        rise, row = position - left, np.arange(left.size)
        self.hats = scipy.sparse.csr_array(
            (np.concatenate((1.0 - rise, rise)), (np.concatenate((row, row)), np.concatenate((left, left + 1)))),
            shape=(left.size, count),
        )

    def transform(self, acceleration: np.ndarray) -> np.ndarray:
        """Return the Fourier spectrum of a motion at `frequency`, complex, shape (n_f,).

        Args:
            acceleration: (n,) m/s2.
        """
        return np.asarray(np.fft.rfft(acceleration, self.length))[self.index]

    def added(self, acceleration: np.ndarray, theta: np.ndarray) -> np.ndarray:
        """Return what the factor adds to a motion, within its duration.

        Args:
            acceleration: shape (samples,), m/s2.
            theta: log of the factor at the nodes, shape (n_n,).

        Returns:
            (n,) m/s2.
        """
        change = np.zeros(self.length // 2 + 1, dtype=complex)
        change[self.index] = self.transform(acceleration) * np.expm1(self.hats @ theta)
        return np.asarray(np.fft.irfft(change, self.length))[: acceleration.size]
