"""The governing one of symmetric members is the first, whatever the last bits of the processor."""

from __future__ import annotations

import numpy as np
import pytest

from edesign.codes.rule_check import first_of_largest


@pytest.mark.parametrize(
    ("values", "place"),
    [
        ([0.3, 0.9, 0.9 * (1.0 + 1e-12), 0.2], 1),
        ([0.3, 0.9, 0.9 * (1.0 + 1e-6), 0.2], 2),
        ([[0.1, 0.5], [0.5, 0.5]], 1),
        ([-2.0, -1.0 - 1e-12, -1.0], 1),
        ([-np.inf, 3.0, np.inf, np.inf], 2),
        ([0.0, 0.0], 0),
    ],
    ids=["rounding", "larger", "flat index", "negative", "inf", "zero"],
)
def test_first_of_the_largest(values: list[float], place: int) -> None:
    assert first_of_largest(np.array(values)) == place
