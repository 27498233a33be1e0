"""Rigs: actuator, controller and valve as a transfer function with a pure delay, or as a servo-hydraulic model."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import scipy.linalg

from edesign.core.substructure import MOST_RIG_STATES, LinearRig
from edesign.errors import InputError


@dataclass(frozen=True)
class RigTransfer:
    """Transfer function x / u = numerator(s) / denominator(s) e^(-s delay), of displacement over command.

    Attributes:
        numerator, denominator: coefficients of falling powers of s.
        delay: s.
    """

    numerator: tuple[float, ...] = (1.0,)
    denominator: tuple[float, ...] = (1.0,)
    delay: float = 0.0

    def __call__(self, s: np.ndarray) -> np.ndarray:
        """Return the transfer function at complex frequencies s (rad/s)."""
        ratio = np.polyval(self.numerator, s) / np.polyval(self.denominator, s)
        return np.asarray(ratio * np.exp(-s * self.delay))

    @property
    def gain(self) -> float:
        """Gain at rest."""
        return self.numerator[-1] / self.denominator[-1]

    @property
    def low_frequency_delay(self) -> float:
        """Delay of a slow motion, -d phase / d omega at rest, s."""
        num, den = self.numerator, self.denominator
        of_denominator = den[-2] / den[-1] if len(den) > 1 else 0.0
        of_numerator = num[-2] / num[-1] if len(num) > 1 else 0.0
        return self.delay + of_denominator - of_numerator

    def inverse_series(self, order: int) -> tuple[float, ...]:
        """Return alpha_0 ... alpha_order of 1 / G = alpha_0 + alpha_1 s + alpha_2 s2 + ...; it compensates the rig."""
        lead = [self.delay**k / math.factorial(k) for k in range(order + 1)]
        ahead = np.convolve(self.denominator[::-1], lead)[: order + 1]
        ahead = np.concatenate([ahead, np.zeros(order + 1 - len(ahead))])
        behind = np.array(self.numerator[::-1], dtype=float)
        found: list[float] = []
        for k in range(order + 1):
            known = sum(behind[j] * found[k - j] for j in range(1, min(k, len(behind) - 1) + 1))
            found.append(float((ahead[k] - known) / behind[0]))
        return tuple(found)

    def discrete(self, sub_step: float) -> LinearRig:
        """Return the rig over sub-steps, exact for a command that is linear over each.

        Args:
            sub_step: s.

        Raises:
            InputError: there are too many states, or the output jumps with the command beside some dynamics.
        """
        num, den = np.trim_zeros(np.array(self.numerator, dtype=float), "f"), np.array(self.denominator, dtype=float)
        n = len(den) - 1
        if n == 0:
            return LinearRig(delay=self.delay, d=float(num[0] / den[0]))
        if n > MOST_RIG_STATES:
            raise InputError(
                f"the transfer function of the rig has the order {n}; {MOST_RIG_STATES} at most are possible [E-RIG-04]"
            )
        if len(num) >= len(den):
            raise InputError(
                "the transfer function of the rig needs a denominator of a higher power of s than its numerator"
                " [E-RIG-04]"
            )
        # in time units of the rig, so that powers of s are of one size
        unit = abs(den[-1] / den[0]) ** (1.0 / n) if den[-1] != 0.0 else 1.0
        powers = unit ** np.arange(n, -1.0, -1.0)
        num, den = num * powers[-len(num) :] / den[0] / powers[0], den * powers / den[0] / powers[0]
        A, B, C = np.eye(n, k=-1), np.zeros(n), np.zeros(n)  # controllable canonical form
        A[0], B[0], C[n - len(num) :] = -den[1:], 1.0, num
        A, B = A * unit, B * unit
        # exact over a linear command: [r, w, dw] of the sub-step
        block = np.zeros((n + 2, n + 2))
        block[:n, :n], block[:n, n], block[n, n + 1] = A * sub_step, B * sub_step, 1.0
        exact = scipy.linalg.expm(block)
        ramp = exact[:n, n + 1]
        return LinearRig(
            delay=self.delay,
            A=exact[:n, :n],
            b0=exact[:n, n] - ramp,
            b1=ramp,
            c=C,
            c_v=C @ A,
            d=0.0,
            d_v=float(C @ B),
        )


def ideal() -> RigTransfer:
    """Return a rig that follows every command."""
    return RigTransfer()


def pure_delay(delay: float, gain: float = 1.0) -> RigTransfer:
    """Return a rig that follows the command after a delay.

    Args:
        delay: s.
        gain: displacement over command.
    """
    return RigTransfer((gain,), (1.0,), delay)


def first_order(time_constant: float, delay: float = 0.0, gain: float = 1.0) -> RigTransfer:
    """Return gain / (time_constant s + 1) behind a delay.

    Args:
        time_constant: s.
        delay: s.
        gain: displacement over command.
    """
    return RigTransfer((gain,), (time_constant, 1.0), delay)


def second_order(frequency: float, damping: float, delay: float = 0.0, gain: float = 1.0) -> RigTransfer:
    """Return gain / (s2/w2 + 2 zeta s/w + 1) behind a delay.

    Args:
        frequency: w / 2 pi, Hz.
        damping: zeta, ratio of critical.
        delay: s.
        gain: displacement over command.
    """
    omega = 2.0 * np.pi * frequency
    return RigTransfer((gain,), (omega**-2, 2.0 * damping / omega, 1.0), delay)


def servo_hydraulic(gain: float, valve_lag: float, delay: float, specimen_to_oil: float) -> RigTransfer:
    """Return what a servo-hydraulic rig does to a spring as specimen, as long as no limit is met.

    The piston stands at x = s - F/k_oil with s' = q, valve_lag q' + q = gain (w - x), F = k x.

    Args:
        gain: 1/s.
        valve_lag: time constant of the valve, s.
        delay: s.
        specimen_to_oil: stiffness of the specimen over that of the oil.

    Returns:
        The transfer function.
    """
    soft = 1.0 + specimen_to_oil
    return RigTransfer((gain,), (valve_lag * soft, soft, gain), delay)
