"""Bounds of the properties of damping devices, ASCE/SEI 7-16, 18.2.4.5."""

from __future__ import annotations

from edesign.errors import InputError

LEAST_UPPER = 1.2
LARGEST_LOWER = 0.85
SYSTEM = 0.75
"""Not all devices are at their extreme of ageing and environment at once."""


def largest_property_factor(ageing: float = 1.0, test: float = 1.0, specification: float = 1.0) -> float:
    """Return lambda_max = (1 + 0.75 (lambda_ae,max - 1)) lambda_test,max lambda_spec,max, at least 1.2.

    Args:
        ageing: lambda_ae,max, ageing and environment, at least 1.
        test: lambda_test,max, change during the tests, at least 1.
        specification: lambda_spec,max, tolerance of production, at least 1.

    Raises:
        InputError: a factor is less than 1.

    Source: ASCE/SEI 7-16, 18.2.4.5.
    """
    for name, value in (("ageing", ageing), ("test", test), ("specification", specification)):
        if not value >= 1.0:
            raise InputError(f"the upper factor of {name} is {value:g}; at least 1 is allowed [E-VALUE-02]")
    return max((1.0 + SYSTEM * (ageing - 1.0)) * test * specification, LEAST_UPPER)


def smallest_property_factor(ageing: float = 1.0, test: float = 1.0, specification: float = 1.0) -> float:
    """Return lambda_min = (1 - 0.75 (1 - lambda_ae,min)) lambda_test,min lambda_spec,min, at most 0.85.

    Args:
        ageing: lambda_ae,min of ageing and environment, greater than 0 and at most 1.
        test: lambda_test,min of effects seen in tests, greater than 0 and at most 1.
        specification: lambda_spec,min of the tolerance of production, greater than 0 and at most 1.

    Raises:
        InputError: a factor is out of range.

    Source: ASCE/SEI 7-16, 18.2.4.5.
    """
    for name, value in (("ageing", ageing), ("test", test), ("specification", specification)):
        if not 0.0 < value <= 1.0:
            raise InputError(
                f"the lower factor of {name} is {value:g}; greater than 0 and at most 1 is allowed [E-VALUE-02]"
            )
    return min((1.0 - SYSTEM * (1.0 - ageing)) * test * specification, LARGEST_LOWER)
