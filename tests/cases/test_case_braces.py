"""Braces that buckle in a frame, against EN 1993-1-1, the plastic hinge at their middle, and fracture."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
import pytest

from edesign.archive.dataset import Group

Results = Callable[[str, str], Group]
CASE = "buckling_braces"
E, FY = 210e9, 355e6


def of_brace(group: Group, variable: str, brace: str) -> np.ndarray:
    """What is kept over time, or an extreme, of a brace."""
    stored = group.variables[variable]
    names = list(group.coords[stored.dims[-1]].values)
    return np.asarray(stored.values[..., names.index(brace)])


def test_the_first_chevron_buckles_at_its_resistance(results_of: Results) -> None:
    """SHS 100 x 5, 18.4 cm2 and i = 3.86 cm (EN 10210-2), 5 m long; curve a of Table 6.2 as S355 is hot finished.

    The camber is that of first yield at N_b,Rd. Behind it the section has 18 % more in bending (W_pl / W_el), and the
    chords of four beams have 5 % more of Euler's load; the curve of the steel bends before it yields.
    """
    area, radius, length = 18.4e-4, 3.86e-2, 5.0
    slenderness = length / radius / (math.pi * math.sqrt(E / FY))
    phi = 0.5 * (1.0 + 0.21 * (slenderness - 0.2) + slenderness**2)
    resistance = FY * area / (phi + math.sqrt(phi**2 - slenderness**2))
    peak = -float(of_brace(results_of(CASE, "push"), "brace_axial_force_min", "D_1_1_f"))
    assert 0.98 * resistance < peak < 1.08 * resistance


@pytest.mark.parametrize("analysis", ["push", "shake"])
def test_no_middle_carries_more_than_its_plastic_moment(results_of: Results, analysis: str) -> None:
    """HEA 100 about its weak axis between pins: N w at most f_y (2 t_f b^2 / 4 + h_w t_w^2 / 4), plus hardening."""
    group = results_of(CASE, analysis)
    moment = FY * (2.0 * 8e-3 * 0.1**2 / 4.0 + 80e-3 * 5e-3**2 / 4.0)
    length = 0.5 * math.hypot(6.0, 3.5)
    euler = math.pi**2 * E * 2.0 * 8e-3 * 0.1**3 / 12.0 / length**2
    for brace in ("D_1_2_r", "D_1_2_f"):
        force = of_brace(group, "recorded_brace_axial_force", brace)
        deflection = of_brace(group, "recorded_brace_deflection", brace)
        assert np.max(-force * deflection) < 1.15 * moment
        assert np.max(-force) < min(1.06 * euler, FY * 2.0 * 8e-3 * 0.1 * 1.25)  # chords of four beams; with the web


def test_broken_chevrons_carry_nothing_and_energy_is_kept(results_of: Results) -> None:
    group = results_of(CASE, "shake")
    assert group.attributes["status"] == "completed"
    share = {brace: float(of_brace(group, "brace_broken_share_final", brace)) for brace in ("D_1_1_r", "D_1_1_f")}
    broken = [brace for brace, value in share.items() if value == 1.0]
    assert broken
    for brace in broken:
        force = np.abs(of_brace(group, "recorded_brace_axial_force", brace))
        assert force[-50:].max() < 1e-3 * FY * 18.4e-4 < 0.1 * force.max()
        assert float(of_brace(group, "brace_damage_final", brace)) == 1.0
    others = [float(of_brace(group, "brace_broken_share_final", brace)) for brace in ("D_1_2_r", "D_1_2_f", "D_2_2_r")]
    assert others == [0.0, 0.0, 0.0]
    assert group.attributes["statistics"]["energy_error"] < 1e-3
    terms = list(group.coords["energy_term"].values)
    damping = group.variables["energy"].values[:, terms.index("damping")]
    assert np.min(np.diff(damping)) > -1e-4 * damping[-1] and damping[-1] > 0.0  # braces that soften are not driven
    assert "broken by low-cycle fatigue" in str(group.attributes["warnings"])


def test_what_buckles_gets_no_warning_for_its_compression(results_of: Results) -> None:
    for analysis in ("gravity", "push", "shake"):
        group = results_of(CASE, analysis)
        assert "brace_buckling" not in str(group.attributes["warnings"])
        assert np.all(np.isnan(group.variables["brace_buckling_resistance"].values))


def test_the_capacity_curve_marks_the_first_buckling(results_of: Results) -> None:
    """The first brace to carry its largest compression: D_1_1_f, in the step in which what is kept of it is least."""
    group = results_of(CASE, "push")
    events = group.variables["capacity_event_what"].values.tolist()
    at = events.index("first buckling of a brace")
    assert group.variables["capacity_event_place"].values[at] == "D_1_1_f"
    force = of_brace(group, "recorded_brace_axial_force", "D_1_1_f")
    assert group.variables["capacity_event_step"].values[at] == np.argmin(force)
    assert "first yield of a brace" not in events  # none is stretched that far
    ductility = group.variables["brace_ductility_max"].values
    assert np.all(ductility < 1.0)
