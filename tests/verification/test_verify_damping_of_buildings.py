"""Every kind of inherent damping in a building: free vibrations decay in each of its modes as the file says."""

from __future__ import annotations

import numpy as np
import pytest
from building_examples import changed
from verification.test_verify_shaken_buildings import TABLE, UNEQUAL

from edesign.frame.sections.building_sections import BuildingSections
from edesign.project.building import Building, parse_building
from edesign.study.analysis.history import load_and_damp
from edesign.study.analysis.structure import make_structure

PERIODS = (0.6, 0.15)


def building(damping: str) -> Building:
    """One storey whose centres of mass and stiffness are apart: both translations and the turn are coupled."""
    analyses = TABLE[TABLE.index("records:") : TABLE.index("outputs:")]
    text = changed(TABLE.replace(analyses, ""), *UNEQUAL[:2]).replace("damping: {kind: none}", f"damping: {damping}")
    return parse_building(text, "building.yaml", BuildingSections())


def decays(damping: str) -> tuple[np.ndarray, np.ndarray]:
    """Ratios of critical of the three modes, as the energy over two periods shows, and their frequencies."""
    found, omega = [], np.zeros(3)
    for k in range(3):
        project = building(damping)
        structure = make_structure(project)
        load_and_damp(project, structure)
        modes = structure.modes(3)
        omega = modes.omega
        structure.analysis.initial_velocity(modes.equations[k])
        cycles = 2
        r = structure.analysis.history(np.zeros(400 * cycles + 1), 2.0 * np.pi / omega[k] / 400)
        energy = r.energy["kinetic"] + r.energy["elastic"]
        zeta = -np.log(energy[-1] / energy[0]) / (4.0 * np.pi * cycles)
        found.append(zeta * (1.0 + 0.5 * zeta**2))  # whole undamped periods are not whole damped ones
    return np.array(found), omega


@pytest.mark.parametrize("stiffness", ["initial", "committed", "current"])
def test_rayleigh(stiffness: str) -> None:
    """zeta = a0 / (2 omega) + a1 omega / 2 (Chopra, Eq. 11.4.8); 0.3 % for steps and whole periods."""
    found, omega = decays(f"{{kind: rayleigh, ratio: 3 %, periods: [0.6 s, 0.15 s], stiffness: {stiffness}}}")
    first, second = (2.0 * np.pi / period for period in PERIODS)
    a0, a1 = 0.06 * first * second / (first + second), 0.06 / (first + second)
    np.testing.assert_allclose(found, a0 / (2.0 * omega) + a1 * omega / 2.0, rtol=3e-3)
    assert omega[1] / omega[0] > 1.1 and omega[2] / omega[1] > 1.1


def test_mass_or_stiffness_alone() -> None:
    found, omega = decays("{kind: mass_proportional, ratio: 5 %}")
    np.testing.assert_allclose(found, 0.05 * omega[0] / omega, rtol=3e-3)
    found, omega = decays("{kind: stiffness_proportional, ratio: 2 %, mode: 2, stiffness: initial}")
    np.testing.assert_allclose(found, 0.02 * omega / omega[1], rtol=3e-3)


def test_modal() -> None:
    """The mode beyond keeps its energy."""
    found, _ = decays("{kind: modal, ratio: [2 %, 7 %]}")
    np.testing.assert_allclose(found, [0.02, 0.07, 0.0], rtol=3e-3, atol=1e-5)


@pytest.mark.parametrize("modes", [(1, 3), (1, 2, 3)])
def test_caughey(modes: tuple[int, ...]) -> None:
    """zeta = sum a_b omega^(2b - 1) / 2 (Chopra, Eq. 11.4.15), with as many terms as ratios."""
    ratios = (0.03, 0.05, 0.04)[: len(modes)]
    texts = ", ".join(f"{100.0 * ratio:g} %" for ratio in ratios)
    found, omega = decays(f"{{kind: caughey, ratio: [{texts}], modes: [{', '.join(map(str, modes))}]}}")
    anchors = omega[np.array(modes) - 1]
    powers = 2.0 * np.arange(len(modes)) - 1.0
    series = np.linalg.solve(0.5 * anchors[:, None] ** powers, ratios)
    np.testing.assert_allclose(found, 0.5 * omega[:, None] ** powers @ series, rtol=3e-3)
