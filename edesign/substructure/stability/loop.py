"""The loop of a substructure test as transfer functions: numerical part, specimen, rig and compensator."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from edesign.substructure.stability.whole import WholeStructure

Transfer = Callable[[np.ndarray], np.ndarray]
"""Of s, 1/s, complex of any shape; the value has the same shape."""
PHASE_POINTS = 200
"""From rest to a frequency, over which a phase is followed: it may turn by half a circle from one to the next."""


def phase_delay(transfer: Transfer, frequency: float) -> float:
    """Return what a sine comes late by, -phase/omega with the phase followed from near rest, s; NaN: of no frequency.

    Args:
        transfer: at rest itself it may be 0 / 0.
        frequency: Hz.
    """
    if frequency <= 0.0:
        return math.nan
    omega = 2.0 * math.pi * np.linspace(0.0, frequency, PHASE_POINTS)[1:]
    return float(-np.unwrap(np.angle(transfer(1j * omega)))[-1] / omega[-1])


def ideal(s: np.ndarray) -> np.ndarray:
    """Return the transfer function of a rig without error, or of no compensator: 1.

    Args:
        s: (m,) complex frequencies, 1/s.

    Returns:
        (m,) ones.
    """
    return np.ones_like(s, dtype=complex)


def nothing(s: np.ndarray) -> np.ndarray:
    """Return the transfer function of a rig that stands still: 0.

    Args:
        s: (m,) complex frequencies, 1/s.

    Returns:
        (m,) zeros.
    """
    return np.zeros_like(s, dtype=complex)


def pure_delay(delay: float) -> Transfer:
    """Return the transfer function exp(-s tau) of a delay tau.

    Args:
        delay: tau, s.
    """

    def transfer(s: np.ndarray) -> np.ndarray:
        value: np.ndarray = np.exp(-np.asarray(s) * delay)
        return value

    return transfer


@dataclass(frozen=True)
class Loop:
    """Numerical part, specimen, rig and compensator of a substructure test.

    M x'' + C x' + K x + interface F = -M influence a_g, with F = k_E G C (interface . x).

    Attributes:
        whole: numerical part and specimen.
        rig: G, measured displacement over command, delay included; stable by itself.
        compensator: C, command over target; stable by itself.
    """

    whole: WholeStructure
    rig: Transfer = ideal
    compensator: Transfer = ideal

    def actuation(self, s: np.ndarray) -> np.ndarray:
        """Return G C at s: measured displacement over target.

        Args:
            s: (m,) complex frequencies, 1/s.

        Returns:
            (m,), dimensionless.
        """
        value: np.ndarray = self.rig(s) * self.compensator(s)
        return value

    def transfer(self, s: np.ndarray) -> np.ndarray:
        """Return L = k_E H G C, with H the receptance of the numerical part at the interface; (m,).

        Args:
            s: (m,) complex frequencies, 1/s.
        """
        over, under = self.parts(self.actuation(s), self.whole.specimen_share(s), s)
        with np.errstate(divide="ignore", invalid="ignore"):  # without damping: at a frequency of the part
            return np.asarray(over / under)

    def parts(self, actuation: np.ndarray, share: np.ndarray, s: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Return A and B of L = A / B, which are finite where L is not; (m,) each.

        Args:
            actuation: (m,), what `actuation` gives at s.
            share: (m,), the share T of the specimen at s.
            s: (m,), 1/s.

        Returns:
            A and B, (m,) each.
        """
        return actuation * share, 1.0 - share

    def ratio(self, s: np.ndarray) -> np.ndarray:
        """Return R = (1 + L)/(1 + L of the ideal loop) = 1 + (G C - 1) T, (m,): its zeros are the roots of the loop.

        Args:
            s: (m,) complex frequencies, 1/s.
        """
        value: np.ndarray = 1.0 + (self.actuation(s) - 1.0) * self.whole.specimen_share(s)
        return value


@dataclass(frozen=True)
class RigDelayLoop(Loop):
    """A loop that is opened at the rig: a further delay d of the rig multiplies its L by exp(-s d), and nothing else.

    Then R is 0 where L exp(-s d) is -1. That L is not k_E H G C if a compensator corrects the measured force, which
    comes in time however late the rig is; or if it feeds back what is measured, and so has the delay in its command.
    In both cases R, times what the command is without the rig over what it is with it, is A + B G with A and B that
    do not know the rig; L is B G / A.

    Attributes:
        still: what the numerical part gets of the force while the rig stands still, over the force of the target.
        opened: command while the rig stands still, over the command as it is.
    """

    still: Transfer = nothing
    opened: Transfer = ideal

    def parts(self, actuation: np.ndarray, share: np.ndarray, s: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Return A and B of L = A / B, as of any loop.

        Args:
            actuation: (m,), what `actuation` gives at s.
            share: (m,), the share T of the specimen at s.
            s: (m,) complex frequencies, 1/s.

        Returns:
            A and B, (m,) each.
        """
        moving, standing = (1.0 + (one - 1.0) * share for one in (actuation, self.still(s)))
        return moving * self.opened(s) - standing, standing
