"""From the hazard of a project to spectra; reference values by hand from EN 1998-1:2004."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from edesign.errors import InputError
from edesign.ground_motion.hazard import (
    checked_hazard,
    code_spectra,
    design_spectrum,
    elastic_spectrum,
    factor_of_level,
    vertical_spectrum,
)
from edesign.project import Project, parse_project
from edesign.project.actions.hazard import EC8Hazard

LEVELS = """
  levels:
    DBE: {probability: 10 %}
    MCE: {probability: 2 %}
    rare: {return_period: 3800 years}
    hospital: {importance_class: IV}
    own: {gamma_I: 1.3}
"""
FRAME = """\
# A portal.


edesign: 1
title: portal
frame:
  bays: [6 m]
  storeys: [4 m]
  columns: [{storeys: all, section: HEB260, material: S275}]
  beams: [{floors: all, section: IPE360, material: S275}]
materials:
  S275: {law: elastic, E: 210 GPa}
analyses:
  - {name: gravity, kind: gravity}
"""
GREECE = "  country: greece\n  zone: 3\n  ground: C\n  spectrum: 1" + LEVELS


@pytest.fixture
def project(tmp_path: Path) -> Project:
    return with_hazard(tmp_path, GREECE)


def with_hazard(folder: Path, lines: str) -> Project:
    path = folder / "project.yaml"
    text = path.read_text() if path.exists() else FRAME
    return parse_project(f"{text}\nhazard:\n  code: ec8-2004\n{lines}", "frame.yaml")


def hazard_of(project: Project) -> EC8Hazard:
    assert project.hazard is not None
    return project.hazard


def test_reference_action_and_levels(project: Project) -> None:
    hazard = checked_hazard(project)
    reference = elastic_spectrum(hazard)
    assert reference.zero_period == pytest.approx(4.0599531, rel=1e-12)  # 0.36 x 9.80665 x 1.15
    factors = {level: factor_of_level(hazard, level) for level in hazard.levels}
    # 5^(1/3); (3800 / 475)^(1/3) = 2; 4.2.5(5)P Note
    expected = {"DBE": 1.0, "MCE": 1.7099759, "rare": 2.0, "hospital": 1.4, "own": 1.3}
    assert factors == pytest.approx(expected, rel=1e-7)
    periods = np.geomspace(0.01, 6.0, 100)
    for level, factor in factors.items():
        at_level = elastic_spectrum(hazard, level)
        np.testing.assert_array_equal(at_level.acceleration(periods), factor * reference.acceleration(periods))
        assert level in at_level.label and "EN 1998-1:2004" in at_level.label
    np.testing.assert_array_equal(
        elastic_spectrum(hazard, "DBE").acceleration(periods), reference.acceleration(periods)
    )


def test_values_of_the_site_replace_those_of_the_table(tmp_path: Path) -> None:
    lines = (
        "  a_gR: 1 m/s^2\n  ground: C\n  spectrum: 1\n  damping: 10 %\n  parameters: {S: 1.3, T_D: 2.5 s}\n  k: 2"
        + LEVELS
    )
    hazard = checked_hazard(with_hazard(tmp_path, lines))
    spectrum = elastic_spectrum(hazard)
    p = spectrum.parameters
    assert (p.S, p.T_B, p.T_C, p.T_D, spectrum.damping) == (1.3, 0.2, 0.6, 2.5, 0.10)
    # 1.3 x 2.5 x sqrt(10 / 15) x 0.6 x 2.5 / 16
    assert spectrum.acceleration(4.0) == pytest.approx(0.24877631, rel=1e-7)
    assert factor_of_level(hazard, "MCE") == pytest.approx(2.2360680, rel=1e-7)  # 5^(1/2)
    assert factor_of_level(hazard, "rare") == pytest.approx(2.8284271, rel=1e-7)  # 8^(1/2)


def test_vertical_and_design_spectra(tmp_path: Path) -> None:
    lines = "  a_gR: 1 m/s^2\n  ground: C\n  spectrum: 1\n  behaviour_factor: 4" + LEVELS
    hazard = hazard_of(with_hazard(tmp_path, lines))
    assert vertical_spectrum(hazard, "own").acceleration(0.1) == pytest.approx(3.51, rel=1e-12)  # 2.7 x 1.3
    design = design_spectrum(hazard, "hospital")
    np.testing.assert_allclose(design.acceleration([0.4, 4.0]), [1.00625, 0.28], rtol=1e-12)  # 1.4 x (0.71875, 0.2)
    assert "q = 4" in design.label


def test_spectra_of_one_component(tmp_path: Path) -> None:
    lines = "  a_gR: 1 m/s^2\n  ground: C\n  spectrum: 1\n  behaviour_factor: 4" + LEVELS
    hazard = hazard_of(with_hazard(tmp_path, lines))
    elastic, design = code_spectra(hazard)
    assert elastic.acceleration(0.4) == pytest.approx(2.875, rel=1e-12)
    assert design is not None and design.acceleration(0.4) == pytest.approx(2.875 / 4.0, rel=1e-12)
    assert code_spectra(hazard, vertical=True)[1] is None  # 4 is for the horizontal components
    assert code_spectra(hazard.model_copy(update={"behaviour_factor": None}))[1] is None
    elastic, design = code_spectra(hazard, "own", q=2.0)  # in place of the 4 of the hazard
    assert design is not None and design.acceleration(0.4) == pytest.approx(1.3 * 1.4375, rel=1e-12)
    elastic, design = code_spectra(hazard, "own", vertical=True, q=1.5)
    assert elastic.acceleration(0.1) == pytest.approx(3.51, rel=1e-12)
    assert design is not None and design.acceleration(0.1) == pytest.approx(1.3 * 1.5, rel=1e-12)
    with pytest.raises(InputError, match="too large for the vertical component"):
        code_spectra(hazard, vertical=True, q=4.0)


def test_what_the_code_does_not_know_is_reported_with_its_place(tmp_path: Path) -> None:
    for old, new, words in [
        ("zone: 3", "zone: 4", r"frame.yaml:\d+:9: hazard.zone: there is no zone in greece `4`.*`Z3`"),
        ("greece", "grece", r"frame.yaml:\d+:12: hazard.country: .*did you mean `greece`"),
        ("ground: C", "ground: C\n  k: 1e-6", r"frame.yaml:\d+:6: hazard.k: with the exponent k = 1e-06 .* no factor"),
        ("ground: C", "ground: C\n  parameters: {T_D: 0.5 s}", r"frame.yaml:\d+:15: hazard.parameters: .*T_B <= T_C"),
    ]:
        with pytest.raises(InputError, match=words):
            checked_hazard(with_hazard(tmp_path, GREECE.replace(old, new)))


def test_missing_things_are_reported(project: Project, tmp_path: Path) -> None:
    with pytest.raises(InputError, match=r"hazard.levels: there is no level `MCF`; did you mean `MCE`\?"):
        elastic_spectrum(hazard_of(project), "MCF")
    with pytest.raises(InputError, match="E-KEY-02"):
        design_spectrum(hazard_of(project))
    bare = parse_project(FRAME, "bare.yaml")
    with pytest.raises(InputError, match="bare.yaml:4:1: .*E-KEY-02"):
        checked_hazard(bare)
