"""Files with the parameters of a country: those of the package are such files, and what is wrong in one is reported."""

from __future__ import annotations

from pathlib import Path

import pytest

from edesign.codes.ec8.national import countries, data_text, national_parameters, parameters_of_file
from edesign.errors import InputError
from edesign.ground_motion.hazard import checked_hazard, design_spectrum, elastic_spectrum, factor_of_level, national_of
from edesign.project import parse_project
from edesign.project.actions.hazard import EC8Hazard
from edesign.project.actions.national_file import NationalFileError, parse_national

ANNEX = """\
zones:
  clause: 3.2.1(1)P, (2)
  source: made for this test
  unit: g
  value: {"1": 0.1, "2": 0.2}
horizontal:
  clause: 3.2.2.2(2)P Note 1
  source: made for this test
  unit: s
  value:
    1:
      B: {S: 1.3, T_B: 0.1, T_C: 0.4, T_D: 2.0, F_0: 2.75}
importance_factors:
  clause: 4.2.5(5)P Note
  source: made for this test
  value: {II: 1.0, III: 1.3}
lower_bound_factor: {clause: 3.2.2.5(4)P Note, source: made for this test, value: 0.1}
"""
BLOCK = """\
hazard:
  code: ec8-2004
  country: annex.yaml
  zone: 2
  ground: B
  spectrum: 1
  behaviour_factor: 4
  levels: {DBE: {importance_class: III}}
"""


def hazard_of(small: str, folder: Path, annex: str = ANNEX, block: str = BLOCK) -> EC8Hazard:
    (folder / "annex.yaml").write_text(annex, encoding="utf-8")
    hazard = checked_hazard(parse_project(small + block, folder / "small.yaml"))
    assert isinstance(hazard, EC8Hazard)
    return hazard


@pytest.mark.parametrize("name", ["recommended", *countries()])
def test_the_files_of_the_package_are_such_files(name: str) -> None:
    """What the checks of a file let through is what the package reads without them."""
    entries = parse_national(data_text(name), Path(f"{name}.yaml"))
    read = national_parameters(None if name == "recommended" else name).parameters
    for key, parameter in parameters_of_file(name, entries).parameters.items():
        if key in entries:
            assert (parameter.unit, parameter.clause, parameter.source) == (
                read[key].unit,
                read[key].clause,
                read[key].source,
            )
    assert parameters_of_file(name, entries).zones == national_parameters(None if name == "recommended" else name).zones


def test_a_country_of_the_user(small: str, tmp_path: Path) -> None:
    """a_gR 0.2 g, S 1.3, F_0 2.75; 1 s: 0.2 x 1.3 x 2.75 x 0.4 g; gamma_I of class III 1.3; beta 0.1."""
    hazard = hazard_of(small, tmp_path)
    spectrum = elastic_spectrum(hazard)
    assert float(spectrum.acceleration(1.0)) / 9.80665 == pytest.approx(0.2 * 1.3 * 2.75 * 0.4, rel=1e-12)
    assert factor_of_level(hazard, "DBE") == 1.3
    design = design_spectrum(hazard)
    at = [float(value) / 9.80665 for value in design.acceleration([0.2, 4.0])]
    assert at == pytest.approx([0.2 * 1.3 * 2.75 / 4.0, 0.02], rel=1e-12)
    assert national_of(hazard).gamma_M == national_parameters().gamma_M  # the rest is as recommended
    assert national_of(hazard).gamma_I("IV") == 1.4
    assert national_of(hazard).parameters["zones"].origin == "annex"


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("zones:", "zoness:", "annex.yaml:1:1: zoness.*`zones`.*E-KEY-01"),
        ("  unit: g\n", "  unit: G\n", "annex.yaml:4:9: zones.unit.*E-VALUE-03"),
        ("  unit: g\n", "", "annex.yaml:1:1: zones.unit.*E-KEY-02"),
        ("    1:\n", "    3:\n", r"annex.yaml:\d+:\d+: horizontal.value.3.*`1`, `2`.*E-NAME-01"),
        ("      B: {S: 1.3", "      F: {S: 1.3", "horizontal.value.1.F.*`E`.*E-NAME-01"),
        ("T_B: 0.1, ", "", r"annex.yaml:\d+:\d+: horizontal.value.1.B.T_B.*E-KEY-02"),
        ("II: 1.0", "II: 1.1", "importance_factors.value.II.*E-VALUE-02"),
        ("value: 0.1}", "value: 2}", "lower_bound_factor.value.*E-VALUE-02"),
        ("  clause: 4.2.5(5)P Note\n", "", "importance_factors.clause.*E-KEY-02"),
        ('{"1": 0.1, "2": 0.2}', "[0.1, 0.2]", "zones.value.*E-VALUE-01"),
    ],
)
def test_wrong_files(small: str, tmp_path: Path, old: str, new: str, message: str) -> None:
    assert ANNEX.count(old) == 1
    with pytest.raises(InputError, match=message):
        hazard_of(small, tmp_path, ANNEX.replace(old, new))


def test_corners_in_disorder_and_grounds_left_out(small: str, tmp_path: Path) -> None:
    with pytest.raises(InputError, match="hazard.parameters.*E-VALUE-04"):
        hazard_of(small, tmp_path, ANNEX.replace("T_B: 0.1", "T_B: 1.1"))
    with pytest.raises(InputError, match="hazard.parameters.*`B`.*E-NAME-01"):
        hazard_of(small, tmp_path, block=BLOCK.replace("ground: B", "ground: C"))
    with pytest.raises(NationalFileError):
        parse_national("zones: {}", Path("annex.yaml"))


def test_a_missing_file(small: str, tmp_path: Path) -> None:
    with pytest.raises(InputError, match=r"small.yaml:\d+:12: hazard.country.*E-FILE-01"):
        parse_project(small + BLOCK, tmp_path / "small.yaml")
