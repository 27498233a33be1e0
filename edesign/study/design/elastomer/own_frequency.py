"""Dampers whose properties are those at the first frequency that the frame has with them."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from edesign.errors import AnalysisError
from edesign.study.design.building import Building
from edesign.study.design.condensed import LinearModes
from edesign.study.design.elastomer.material import Elastomer, Moduli
from edesign.study.design.elastomer.sizing import place_stiffness
from edesign.study.design.relaxation import AGREEMENT, MOST_ITERATIONS


def at_own_frequency(
    building: Building,
    material: Elastomer,
    k_D: Callable[[Moduli], np.ndarray],
    brace: np.ndarray | None,
    start: float,
) -> tuple[Moduli, np.ndarray, LinearModes]:
    """Iterate until the elastomer's properties are those at the first frequency of the frame with its dampers.

    Args:
        building: the frame with its places.
        material: properties of the elastomer at a frequency.
        k_D: horizontal storage stiffness of the storeys (s,) N/m that dampers of some properties have.
        brace: of the storeys, (s,) N/m; None: rigid.
        start: frequency of the first iteration, Hz.

    Returns:
        The properties, the complex stiffness at each place with its brace (d,) N/m, and the modes with it.

    Raises:
        AnalysisError: no frequency agrees with itself.
    """
    frequency = start
    for _ in range(MOST_ITERATIONS):
        moduli = material(frequency)
        at_places = place_stiffness(building, k_D(moduli), moduli.loss_factor, brace)
        modes = building.frame.modes(at_places.real)
        before, frequency = frequency, modes.first_frequency
        if abs(frequency - before) <= AGREEMENT * frequency:
            return moduli, at_places, modes
    raise AnalysisError(f"the frequencies did not agree to {AGREEMENT:g} within {MOST_ITERATIONS} iterations")
