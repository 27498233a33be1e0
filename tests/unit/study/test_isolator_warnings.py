"""What is reported of moments of column bases that do not reach the isolators."""

from __future__ import annotations

import numpy as np
import pytest

from edesign.study.analysis.isolators import _couples


@pytest.mark.parametrize(
    ("moments", "places", "expected"),
    [
        ([100.0, 60.0], [0.0, 8.0], [20.0, 20.0]),  # equilibrium: (M_1 + M_2) / L
        ([100.0, 100.0, 100.0], [0.0, 5.0, 10.0], [30.0, 0.0, 30.0]),  # slope-deflection: M/2 each way by antisymmetry
        # the middle gives 60 to the span of 4 m and 30 to that of 8 m: shears 150 / 4 and 120 / 8
        ([90.0, 90.0, 90.0], [0.0, 4.0, 12.0], [37.5, 22.5, 15.0]),
    ],
)
def test_moments_of_bases_as_couples(moments: list[float], places: list[float], expected: list[float]) -> None:
    assert _couples(np.array(moments), np.array(places)) == pytest.approx(expected)
