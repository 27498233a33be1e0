"""Limit loads of yielding frames in space against limit analysis, which knows neither stiffness nor path."""

from __future__ import annotations

from collections.abc import Callable

import pytest
from verification.limit_frames import FACTOR, LimitFrame, setback, sway, two_storeys


@pytest.mark.parametrize("make", [two_storeys, setback])
def test_first_order(make: Callable[[], tuple[LimitFrame, int]]) -> None:
    """Pushed far in linear geometry, the factor of the loads rises to that of the static theorem.

    5e-5 below: fibres nearest to axes of bending yield last (2e-5 were seen, 1.6e-4 at a fifth of the displacement).
    Torsion has 1e-6 of its stiffness, as the theorem has none; this and what the core leaves a yielded fibre, 1e-8 of
    E, are below 1e-5.
    """
    frame, roof = make()
    expected = frame.limit_load()
    factor = frame.push("linear", roof, "ux", 100.0, 300, points=3, torsion=1e-6).values[FACTOR]
    assert (1.0 - 5e-5) * expected < factor[-1] < (1.0 + 1e-5) * expected
    assert factor.argmax() == factor.size - 1


@pytest.mark.parametrize("columns", ["SHS140x10", "CHS168.3x8"])
def test_second_order(columns: str) -> None:
    """Once the columns of a storey are a mechanism, the load falls as the static theorem says of the moved frame.

    6e-4 from 6 % to 17 % of drift: end sections are turned against the chords, which the theorem leaves out (5e-4 were
    seen at the end). Before that the theorem is a bound, and the limit load is well below that of first order.
    """
    frame, roof = sway(columns)
    r = frame.push("corotational", roof, "ux", 0.6, 120)
    factor = r.values[FACTOR]
    for row in (40, 60, 80, 100, 120):
        assert factor[row] == pytest.approx(frame.moved(r, row).limit_load(), rel=6e-4)
    peak = int(factor.argmax())
    assert 0 < peak < 20
    assert factor[peak] < frame.moved(r, peak).limit_load() < frame.limit_load()
    assert factor[peak] < 0.9 * frame.limit_load()
