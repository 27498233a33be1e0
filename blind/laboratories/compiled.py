"""The compiler with which harbour, polytechnic and proving step their specimens."""

from __future__ import annotations

try:
    from numba import njit
except ModuleNotFoundError as error:
    raise ModuleNotFoundError(
        'this laboratory needs numba, of the extra `blind`: pip install "edesign[blind]", '
        'in a checkout pip install -e ".[blind]"',
        name=error.name,
    ) from error

__all__ = ["njit"]
