"""The compiler with which all laboratories step their specimens."""

from __future__ import annotations

try:
    from numba import njit
except ModuleNotFoundError as error:
    raise ModuleNotFoundError(
        'the laboratories need numba, of the extra `blind`: pip install "edesign[blind]", '
        'in a checkout pip install -e ".[blind]"',
        name=error.name,
    ) from error

__all__ = ["njit"]
