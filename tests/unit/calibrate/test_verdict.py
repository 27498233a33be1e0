"""Verdicts of a calibration, from what the loop leaves in tests fitted to and in others."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import pytest

from edesign.calibrate.outcome import verdict_of
from edesign.calibrate.result import Errors

FLOOR = 1e-4


def _found(adopted: int, left: float, ending: str = "complete") -> Any:
    """A selection with so many effects that leaves so many times the noise in the tests fitted to."""
    return SimpleNamespace(
        adopted=(object(),) * adopted,
        final=SimpleNamespace(left=left, fitted=SimpleNamespace(reduced=left)),
        ending=ending,
    )


@pytest.mark.parametrize(
    ("adopted", "left", "validate", "verdict"),
    [
        (0, 1.0, 1.0, "none"),
        (0, 8.0, 0.99, "none"),  # in tests fitted to alone: nothing is left to explain where it counts
        (0, 8.0, 1.01, "unexplained"),
        (0, 1.0, 30.0, "unexplained"),  # fitted away, and back in the tests that were not fitted to
        (1, 1.0, 1.0, "explained"),
        (1, 1.0, 1.49, "explained"),
        (1, 1.0, 1.51, "partly_explained"),
        (0, 1.0, 1.99, "none"),  # effects claim more than their absence does
        (0, 1.0, 2.01, "unexplained"),
        (1, 8.0, 1.0, "partly_explained"),
        (1, 1.0, 30.0, "partly_explained"),
    ],
)
def test_verdict(adopted: int, left: float, validate: float, verdict: str) -> None:
    errors = Errors(fit=left * FLOOR, validate=validate * FLOOR, tests={})
    assert verdict_of(_found(adopted, left), errors, {"fit": FLOOR, "validate": FLOOR}) == verdict
