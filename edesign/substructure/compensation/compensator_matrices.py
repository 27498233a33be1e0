"""Difference equations of compensators as matrices of a discrete state space."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from edesign.core.compensator import DifferenceEquation, Signal, Term

INPUTS: tuple[Signal, ...] = ("target", "velocity", "acceleration", "measured")
OUTPUTS = ("command", "force")


@dataclass(frozen=True)
class StateSpace:
    """Discrete state space z' = A z + B w, y = C z + D w once a main step, z = 0 before the first.

    w: target displacement (m), velocity (m/s) and acceleration (m/s2) at the end of the step, measured displacement (m)
    at its beginning. y: command (m), and what is added to the force that is measured at the end of the step (N).

    Attributes:
        A: (n, n); B: (n, 4); C: (2, n); D: (2, 4).
    """

    A: np.ndarray
    B: np.ndarray
    C: np.ndarray
    D: np.ndarray

    @property
    def states(self) -> int:
        """Number of states, n."""
        return len(self.A)

    def run(self, inputs: np.ndarray) -> np.ndarray:
        """Return the outputs to inputs.

        Args:
            inputs: (m, 4).

        Returns:
            (m, 2).
        """
        z, outputs = np.zeros(self.states), np.empty((len(inputs), len(OUTPUTS)))
        for k, w in enumerate(inputs):
            outputs[k] = self.C @ z + self.D @ w
            z = self.A @ z + self.B @ w
        return outputs


def state_space(equation: DifferenceEquation) -> StateSpace:
    """Return the matrices of a difference equation, in observer form.

    There are as many states as main steps that command and force correction look back, each by itself. None can be
    spared, unless a numerator and a denominator have a factor in common, or the correction depends on past commands.
    """
    direct, late, past = _coefficients(equation.terms)
    n = len(late)
    A, B = np.eye(n, k=1), late + np.outer(past, direct)
    A[:, :1] += past[:, None]
    of_command = np.eye(1, n)[0]
    force_direct, force_late, force_past = _coefficients(equation.force_terms)
    m = len(force_late)
    return StateSpace(
        np.block([[A, np.zeros((n, m))], [np.outer(force_past, of_command), np.eye(m, k=1)]]),
        np.vstack([B, force_late + np.outer(force_past, direct)]),
        np.vstack([np.concatenate([of_command, np.zeros(m)]), np.concatenate([np.zeros(n), np.eye(1, m)[0]])]),
        np.vstack([direct, force_direct]),
    )


def _coefficients(terms: Iterable[Term]) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Of the inputs now (4,) and 1 to n steps ago (n, 4), and of the commands 1 to n steps ago (n,)."""
    terms = tuple(terms)
    longest = max((term.lag for term in terms), default=0)
    inputs, commands = np.zeros((longest + 1, len(INPUTS))), np.zeros(longest + 1)
    for term in terms:
        if term.of == "command":
            commands[term.lag] += term.coefficient
        else:
            inputs[term.lag, INPUTS.index(term.of)] += term.coefficient
    return inputs[0], inputs[1:], commands[1:]
