"""Numbers that clauses are asked with: checks of them, and the standard acceleration of gravity."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from edesign.errors import InputError

STANDARD_GRAVITY = 9.80665
"""Standard acceleration of gravity, m/s2 (exact by definition); scipy, which has it too, takes 0.2 s to load."""


def check_positive(**values: ArrayLike) -> None:
    """Check that values, numbers or arrays, are finite and greater than zero.

    Args:
        **values: by the name for the message.

    Raises:
        InputError: one of them is not.
    """
    for name, value in values.items():
        _check(name, np.asarray(value, dtype=float), allow_zero=False)


def check_not_negative(**values: ArrayLike) -> None:
    """Check that values, numbers or arrays, are finite and at least zero.

    Args:
        **values: by the name for the message.

    Raises:
        InputError: one of them is not.
    """
    for name, value in values.items():
        _check(name, np.asarray(value, dtype=float), allow_zero=True)


def _check(name: str, values: np.ndarray, allow_zero: bool) -> None:
    fits = np.isfinite(values) & ((values >= 0.0) if allow_zero else (values > 0.0))
    if not fits.all():
        least = "at least zero" if allow_zero else "greater than zero"
        raise InputError(f"{name} must be {least}, not {values[~fits].flat[0]:g} [E-VALUE-02]")
