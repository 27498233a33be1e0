"""Rig and specimen of a file between two main steps: from commands at main steps to what is measured at main steps."""

from __future__ import annotations

import math

import numpy as np

from edesign.core.substructure import LinearRig, ServoHydraulicRig
from edesign.substructure.laboratory import Laboratory
from edesign.substructure.stability.sampled import Resolvent, RigSteps
from edesign.substructure.stability.whole import ComplexStiffness

MOST_SUB_STEPS = 20
"""In a main step. The rig is exact over any that are linear in the command, and the ramp between two is followed by the
specimen; what is left falls with the square of the sub-step, 1/400 of a main step's."""


def sampled_rig(laboratory: Laboratory, specimen: ComplexStiffness, step: float, sub_steps: int) -> RigSteps:
    """Return what the loop does in sub-steps, at main steps.

    A command at main steps is a ramp between two. In sub-steps h it has the spectrum of the command at main steps
    T = N h times (sinh(s T/2) / sinh(s h/2))^2 / N. What is taken at main steps is the mean over the N frequencies
    s + 2 pi i k / T that look alike there, so the sum over them is finite and exact.

    Args:
        laboratory: its rig, with flexibility and sensors.
        specimen: complex stiffness up to REACH times half the rate of the sub-steps.
        step: main step, s.

    Source: Franklin, Powell & Workman, Digital Control of Dynamic Systems, 5.2 and 11 (multirate sampling).
    """
    count = min(sub_steps, MOST_SUB_STEPS)
    h = step / count
    alike = 2j * np.pi / step * (np.arange(count) - count // 2)
    follow = _SubSteps(laboratory, specimen, h)

    def rig(s: np.ndarray) -> np.ndarray:
        at = s[:, None] + alike
        weight = (np.sinh(0.5 * s * step)[:, None] / (count * np.sinh(0.5 * at * h))) ** 2
        return np.asarray(np.sum(weight * follow(at.ravel()).reshape(3, *at.shape), axis=2))

    return rig


REACH = 3
"""Half rates of the sub-steps up to which the specimen is asked. A ramp over a sub-step has higher frequencies too, but
passes on 1/25 of them at most; and a spring and a dashpot, which have no error, take most of what the specimen does."""
_ALIKE = np.arange(-(REACH // 2), REACH // 2 + 1)


class _SubSteps:
    """Displacement and piston (m), and force as read (N), over a command in sub-steps, as core_c's loop moves them.

    Of the specimen a spring and a dashpot, which it resembles at high frequencies, have the force of each path exactly.
    The rest has it by its stiffness at the frequencies of the path: of a ramp those that look alike in sub-steps.

    Args:
        laboratory, specimen: as of `sampled_rig`.
        h: sub-step, s.
    """

    def __init__(self, laboratory: Laboratory, specimen: ComplexStiffness, h: float) -> None:
        self.h, self.specimen, self.sensors = h, specimen, laboratory.sensors
        highest = REACH * np.pi / h
        stiffness = complex(specimen(np.array([highest + 0j]))[0])
        self.spring, self.dashpot = stiffness.real, stiffness.imag / highest
        rig = laboratory.rig
        self.rig = laboratory.transfer.discrete(h) if isinstance(rig, LinearRig) else rig
        self.in_series = 1.0 / laboratory.rig_stiffness if laboratory.rig_stiffness else 0.0
        if isinstance(self.rig, ServoHydraulicRig):
            self.in_series += 1.0 / self.rig.oil
        elif len(self.rig.A):
            inputs = np.column_stack([self.rig.b0, self.rig.b1])
            self.states = Resolvent(self.rig.A, inputs, np.vstack([self.rig.c, self.rig.c_v]))

    def __call__(self, s: np.ndarray) -> np.ndarray:
        back = np.exp(-s * self.h)
        ramp = (1.0 - back) / self.h  # velocity over displacement where the specimen moves in ramps
        in_ramps = self.in_series > 0.0 or not len(self.rig.A)  # type: ignore[union-attr]
        spring, dashpot = self.spring + self._rest(s, in_ramps), self.dashpot
        met = spring + dashpot * ramp
        reach = 1.0 / (1.0 + self.in_series * met)
        late = self._late(back, self.rig.delay)
        if isinstance(self.rig, ServoHydraulicRig):
            drive = self._servo(self.rig, back, 1.0 - reach * met / self.rig.oil)
            moved, force = reach * drive, met * reach * drive
            piston = drive - force / self.rig.oil
        else:
            drive, velocity = self._linear(self.rig, back, ramp)
            piston, moved = drive, reach * drive
            force = met * moved if self.in_series else spring * drive + dashpot * velocity
        return late * np.array([moved, piston, force * self._late(back, self.sensors.force_delay)])

    def _rest(self, s: np.ndarray, in_ramps: bool) -> np.ndarray:
        """Stiffness of the specimen beside spring and dashpot, over displacements in sub-steps, N/m."""
        if not in_ramps:
            return self._beside(s)
        at = s[:, None] + 2j * np.pi / self.h * _ALIKE
        weight = (np.sinh(0.5 * s * self.h)[:, None] / (0.5 * at * self.h)) ** 2
        return np.asarray(np.sum(weight * self._beside(at), axis=1))

    def _beside(self, s: np.ndarray) -> np.ndarray:
        """Stiffness of the specimen less spring and dashpot, N/m."""
        upper = np.where(s.imag < 0.0, s.conj(), s)
        rest = self.specimen(-1j * upper) - self.spring - self.dashpot * upper
        return np.asarray(np.where(s.imag < 0.0, rest.conj(), rest))

    def _late(self, back: np.ndarray, delay: float) -> np.ndarray:
        whole = math.floor(delay / self.h)
        part = delay / self.h - whole
        return np.asarray(back**whole * (1.0 - part + part * back))

    def _linear(self, rig: LinearRig, back: np.ndarray, ramp: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Position and velocity over the delayed command."""
        if not len(rig.A):
            return rig.d + 0.0 * ramp, rig.d * ramp
        over = self.states(1.0 / back)
        position, velocity = over[:, 0] + over[:, 1] / back
        return position + rig.d, velocity + rig.d_v

    def _servo(self, rig: ServoHydraulicRig, back: np.ndarray, piston: np.ndarray) -> np.ndarray:
        """Drive over the delayed command; piston: over the drive."""
        h, left, mean = self.h, 0.0, 0.0
        if rig.valve_lag > 0.0:
            left = math.exp(-h / rig.valve_lag)
            mean = (1.0 - left) * rig.valve_lag / h
        first, last = mean - left, 1.0 - mean  # shares of the errors at both ends of a sub-step
        turn = 0.5 * h * (1.0 + back) * rig.gain
        own = (1.0 - back) * (1.0 - left * back + rig.gain * last * h * back)
        return np.asarray(turn * (first * back + last) / (own + turn * back * (first + last) * piston))
