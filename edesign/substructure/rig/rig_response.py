"""What a linear rig does to a recorded command: its exact response between samples, at any delay."""

from __future__ import annotations

import math

import numpy as np
import scipy

from edesign.substructure.rig.rigs import RigTransfer


def rig_response(transfer: RigTransfer, command: np.ndarray, step: float) -> np.ndarray:
    """Return the displacement (n,) m of a rig under a command that is linear between its samples, from rest there.

    A delay that is no whole number of steps is met between samples: states go from sample to sample, and the output
    is taken a share of a step later.

    Args:
        transfer: of at most second order; its denominator has a higher power than its numerator, or both are numbers.
        command: (n,) m.
        step: between samples, s.
    """
    whole = math.ceil(transfer.delay / step - 1e-9)
    share = min(max(whole - transfer.delay / step, 0.0), 1.0)
    moved = _between(transfer, command - command[0], step, share)
    late = np.concatenate([np.zeros(min(whole, command.size)), moved[: max(command.size - whole, 0)]])
    return np.asarray(late + transfer.gain * command[0])


def _between(transfer: RigTransfer, command: np.ndarray, step: float, share: float) -> np.ndarray:
    """Displacement (n,) a share of a step after each sample, without delay; the command holds on after its end."""
    ahead = np.append(command[1:], command[-1])
    undelayed = RigTransfer(transfer.numerator, transfer.denominator)
    if len(transfer.denominator) == 1:
        return transfer.gain * ((1.0 - share) * command + share * ahead)
    over = undelayed.discrete(step)
    A, b0, b1, c = over.A, over.b0, over.b1, over.c
    here, direct, slope = c, 0.0, 0.0
    if share > 0.0:  # r(t + share h) = A_s r + b0_s w(t) + b1_s w(t + share h)
        part = undelayed.discrete(share * step)
        here, direct, slope = c @ part.A, float(c @ part.b0), float(c @ part.b1)
    # with s = r - b1 w the step is s' = A s + (A b1 + b0) w
    one = direct + (1.0 - share) * slope + float(here @ b1)
    numerator, denominator = scipy.signal.ss2tf(A, (A @ b1 + b0)[:, None], here[None, :], np.array([[one]]))
    return np.asarray(scipy.signal.lfilter(numerator[0], denominator, command) + share * slope * ahead)
