"""Frequency-consistent iteration: dampers with the properties at the first frequency of the frame with them."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from edesign.errors import AnalysisError
from edesign.study.design.condensed import LinearModes
from edesign.study.design.damping import strain_energy_damping
from edesign.study.design.elastomer.material import Elastomer, Moduli
from edesign.study.design.elastomer.model import ElastomerModel, Iteration
from edesign.study.design.relaxation import AGREEMENT, MOST_ITERATIONS

_SLOWEST = AGREEMENT ** (1.0 / MOST_ITERATIONS)  # of a difference over the one before, to agree in time


@dataclass(frozen=True)
class AtFrequency:
    """Dampers with the elastomer's properties at one frequency.

    Attributes:
        iterations: on the way to it; properties, k_D and damping are those of the last.
        stiffness: complex, at each place with the brace, (d,) N/m.
        modes: with its storage.
        reason: why the frequency is not that of the first mode; empty if it is.
    """

    iterations: tuple[Iteration, ...]
    stiffness: np.ndarray
    modes: LinearModes
    reason: str

    @property
    def last(self) -> Iteration:
        """The last iteration."""
        return self.iterations[-1]


def at_consistent_frequency(
    model: ElastomerModel,
    elastomer: Elastomer,
    k_D: Callable[[Moduli], np.ndarray],
    start: float,
    braces: bool = True,
) -> AtFrequency:
    """Iterate until the elastomer's properties are those at the first frequency of the frame with its dampers.

    Where they go to and fro too slowly to agree in time, as with modes that share a direction, their bracket is halved
    from there on.

    Args:
        k_D: horizontal storage stiffness of the storeys (s,) N/m that dampers of some properties have.
        start: frequency of the first iteration, Hz.
        braces: whether the braces are in series.
    """
    frequency, iterations = start, list[Iteration]()
    apart, slow, low, high = np.inf, False, 0.0, np.inf
    reason = f"the frequencies did not agree to {AGREEMENT:g} within {MOST_ITERATIONS} iterations"
    while reason and len(iterations) < MOST_ITERATIONS:
        moduli = elastomer(frequency)
        wanted = k_D(moduli)
        stiffness = model.stiffness(wanted, moduli.loss_factor, braces)
        modes = model.building.frame.modes(stiffness.real)
        before, found = frequency, modes.first_frequency
        damping = modes.lead.mean(strain_energy_damping(modes, stiffness).__getitem__)
        iterations.append(Iteration(before, moduli, wanted, found, damping, {}))
        if abs(found - before) <= AGREEMENT * found:
            reason = ""
        low, high = (max(low, before), high) if found > before else (low, min(high, before))
        slow = slow or abs(found - before) > _SLOWEST * apart
        frequency, apart = (0.5 * (low + high) if slow and 0.0 < low < high < np.inf else found), abs(found - before)
    return AtFrequency(tuple(iterations), stiffness, modes, reason)


def agreed(found: AtFrequency) -> AtFrequency:
    """Return dampers whose properties are consistent with the frequency.

    Raises:
        AnalysisError: the iteration did not converge.
    """
    if found.reason:
        raise AnalysisError(found.reason)
    return found
