"""The time step that a record file states."""

from __future__ import annotations

from edesign.errors import InputError
from edesign.ground_motion.plausibility import LONGEST_STEP, SHORTEST_STEP

_BEYOND = 1000.0
"""Times as far as the steps with a warning lie those that are refused: no instrument has them, and what is computed
with them may overflow."""


def check_step(where: str, step: float, said: str = "") -> None:
    """Check a time step.

    Args:
        where: file and line, for messages.
        step: s.
        said: how the file writes it, for messages: `DT = 0.0`.

    Raises:
        InputError: it is not greater than zero, no finite number, or that of no instrument.
    """
    if not step > 0.0:
        raise InputError(f"{where}: the time step must be greater than zero, not {said or f'{step:g} s'} [E-REC-20]")
    shortest, longest = SHORTEST_STEP / _BEYOND, LONGEST_STEP * _BEYOND
    if not shortest <= step <= longest:
        raise InputError(
            f"{where}: a time step of {step:g} s is that of no record; read are {shortest:g} s to {longest:g} s"
            f"{f' ({said})' if said else ''} [E-REC-20]"
        )


def check_rate(where: str, rate: float) -> None:
    """Check a sampling rate.

    Args:
        where: file and line, for messages.
        rate: samples a second.

    Raises:
        InputError: it is not greater than zero, or that of no instrument.
    """
    if not rate > 0.0:
        raise InputError(f"{where}: the sampling rate must be greater than zero, not {rate:g} a second [E-REC-20]")
    check_step(where, 1.0 / rate, f"{rate:g} samples a second")
