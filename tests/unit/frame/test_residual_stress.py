"""Residual stresses of rolled sections: in equilibrium, as the pattern says, and in a column that yields."""

from __future__ import annotations

import numpy as np
import pytest

from edesign.frame.sections.profiles import Profile, profile
from edesign.frame.sections.residual_stress import residual_stress
from edesign.frame.sections.space_section import space_section
from edesign.project.frame.sections import PlateSection

F_Y = 235e6


@pytest.mark.parametrize(("name", "share"), [("HEB300", 0.5), ("HEB360", 0.5), ("HEB400", 0.3), ("IPE360", 0.3)])
def test_the_pattern_is_in_equilibrium(name: str, share: float) -> None:
    """h / b is 1, 1.2, 1.33 and 2.1. The fillets take less than 2 % of f_y from the pattern."""
    rolled, section = profile(name), space_section(name)
    stress = residual_stress(rolled, section, F_Y)
    scale = F_Y * section.area.sum() * rolled.h
    for arm in (1.0, section.y, section.z):
        assert abs(np.sum(stress * section.area * arm)) < 1e-15 * scale
    flange = abs(section.z) > 0.5 * rolled.h - rolled.tf
    slope, middle = np.polyfit(abs(section.y[flange]), stress[flange], 1)
    assert slope == pytest.approx(-4.0 * share * F_Y / rolled.b, rel=1e-9)
    assert middle == pytest.approx(share * F_Y, abs=0.02 * F_Y)


def test_the_elastic_core_of_a_column() -> None:
    """Flanges yield from the tips under 0.8 f_y: 0.8 + 0.5 (4 y / b - 1) = 1 at y = 0.35 b, so I_z falls to 0.7^3.

    The web yields in its middle, where it adds nothing to I_z. Without fillets, with fibres of a hundredth of a flange.
    """
    sizes = {"height": 0.3, "width": 0.3, "flange": 0.019, "web": 0.011}
    section = space_section(PlateSection.model_validate({key: f"{size} m" for key, size in sizes.items()}), 100)
    rolled = Profile("plates", 0.3, 0.3, 0.011, 0.019, 0.0, area=0.0, inertia=0.0)
    elastic = residual_stress(rolled, section, F_Y) - 0.8 * F_Y > -F_Y
    second = section.area * section.y**2
    assert second[elastic].sum() / second.sum() == pytest.approx(0.7**3, rel=0.015)  # half a fibre of 70, cubed
