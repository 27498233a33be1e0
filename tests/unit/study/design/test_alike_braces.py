"""Sections of braces that are alike, against all choices that there are."""

from __future__ import annotations

from itertools import product

import numpy as np
import pytest

from edesign.study.design.alike_braces import alike

NAMES = ["SHS80x4", "SHS100x4", "SHS100x6.3", "SHS120x5", "SHS120x8", "SHS140x6.3"]
LINES = np.array([9.2, 11.7, 17.5, 17.8, 27.2, 25.7])  # kg/m, about
RESISTANCES = np.array([60.0, 115.0, 165.0, 200.0, 290.0, 350.0])


def masses(forces: list[float], length: float = 10.0) -> np.ndarray:
    return np.where(RESISTANCES >= np.array(forces)[:, None], LINES * length, np.inf)


@pytest.mark.parametrize("most", [None, 1, 2, 3])
@pytest.mark.parametrize("same_depth", [False, True])
@pytest.mark.parametrize("forces", [[340, 270, 180, 50], [190, 160, 110, 50], [50, 190, 60, 280], [100, 100, 100, 60]])
def test_the_least_mass_of_all_allowed_choices(forces: list[float], same_depth: bool, most: int | None) -> None:
    mass = masses(forces)

    def allowed(choice: tuple[int, ...]) -> bool:
        depths = {NAMES[n].partition("x")[0] for n in choice}
        return not (same_depth and len(depths) > 1) and len(set(choice)) <= (most or len(forces))

    choices = filter(allowed, product(range(6), repeat=4))
    best = min(float(sum(mass[i, n] for i, n in enumerate(choice))) for choice in choices)
    found = alike(NAMES, mass, same_depth, most)
    if not np.isfinite(best):
        assert found is None
        return
    assert found is not None and allowed(tuple(NAMES.index(name) for name in found))
    assert sum(mass[i, NAMES.index(name)] for i, name in enumerate(found)) == pytest.approx(best)
