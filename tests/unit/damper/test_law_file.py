"""Law files: what `edesign fit` writes, a project uses as it is."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from messages import says

from edesign.damper import laws
from edesign.damper.law_file import read_law_file, resolve, strain_of_tests
from edesign.errors import InputError
from edesign.project.dampers.dampers import LawDescription
from edesign.project.loader import parse_project
from edesign.study.analysis.dampers import device_laws, law_warnings, strain_warnings
from edesign.study.analysis.structure import make_frame

LAW = """# a law file
type: zener
parameters: {k0: 2 kN/mm, k1: 5 kN/mm, c1: 0.1 kN*s/mm}
temperature_law:
  ferry: {p1: 2, p2: 50 K, reference: 20 degC}
prototype: {layers: 2, layer_area: 41400 mm^2, layer_thickness: 12 mm}
standard_errors: {k0: 0.01 kN/mm}
tested: {shear_strain: 10 to 50 %, frequency: 0.25 to 4 Hz, temperature: 20 to 30 degC}
"""

PROJECT = """
edesign: 1
title: one storey
frame:
  bays: [6 m]
  storeys: [3 m]
  columns: [{storeys: all, section: HEB200, material: steel}]
  beams: [{floors: all, section: IPE300, material: steel}]
materials: {steel: {law: elastic, E: 210 GPa}}
dampers:
  laws:
    rubber: {file: law.yaml, temperature: 35 degC}
  devices: [{kind: storey, bays: 1, storeys: 1, law: rubber, layer_thickness: 24 mm}]
analyses: [{name: gravity, kind: gravity}]
"""


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    (tmp_path / "law.yaml").write_text(LAW, encoding="utf-8")
    return tmp_path


def test_a_law_file_is_read_with_its_size_and_its_range(folder):
    described, source = read_law_file(folder / "law.yaml")
    found = resolve(described, source, 20.0)
    assert found.law.name == "zener"
    assert found.values == pytest.approx({"k0": 2e6, "k1": 5e6, "c1": 1e5})
    assert found.effects == ()
    assert found.warnings == ()


def test_a_project_uses_it_as_it_is_and_warns_outside_its_tests(folder):
    project = parse_project(PROJECT, folder / "project.yaml")
    assert device_laws(project)["rubber"].layer_thickness == 0.012
    (device,) = make_frame(project, dampers=True).devices
    assert device.deformation_scale == 0.5
    assert law_warnings(project) == ["damper law rubber: it was tested at 20 to 30 degC and is used at 35 degC"]


@pytest.mark.parametrize(
    ("changed", "part"),
    [
        (LAW.replace("zener", "zenner"), "law.yaml:2:7: type: there is no damper law `zenner`; did you mean `zener`?"),
        (LAW.replace("2 kN/mm", "2 kN"), "law.yaml:3:18: parameters.k0: E-UNIT-02"),
        (LAW.replace("type: zener\n", ""), "law.yaml:1:1: type: E-KEY-02"),
        (LAW + "colour: red\n", "colour"),
        (LAW.replace("p2: 50 K", "p2: 50"), "temperature_law.ferry.p2"),
        ("", "law.yaml:1 E-FILE-05"),
    ],
)
def test_what_is_wrong_in_a_law_file_is_reported_with_its_place(folder, changed, part):
    (folder / "law.yaml").write_text(changed, encoding="utf-8")
    with pytest.raises(InputError) as error:
        device_laws(parse_project(PROJECT, folder / "project.yaml"))
    assert says(str(error.value), part)


def test_a_missing_file_is_reported_at_the_project(folder):
    project = parse_project(PROJECT.replace("law.yaml", "lost.yaml"), folder / "project.yaml")
    with pytest.raises(InputError, match=r"project\.yaml:12:20: dampers\.laws\.rubber\.file: .*lost\.yaml.*E-FILE-01"):
        device_laws(project)


def test_a_law_stands_in_the_file_or_in_the_project(folder):
    both = PROJECT.replace("file: law.yaml,", "file: law.yaml, type: zener,")
    with pytest.raises(InputError, match=r"laws\.rubber\.type: .*E-KEY-03"):
        parse_project(both, folder / "project.yaml")
    neither = PROJECT.replace("file: law.yaml, ", "")
    with pytest.raises(InputError, match=r"laws\.rubber\.parameters: .*E-KEY-02"):
        parse_project(neither, folder / "project.yaml")


def test_a_size_needs_a_prototype(folder):
    (folder / "law.yaml").write_text(LAW.replace(LAW.splitlines()[5] + "\n", ""), encoding="utf-8")
    with pytest.raises(InputError, match=r"devices\[0\]: .*E-DEVICE-01"):
        make_frame(parse_project(PROJECT, folder / "project.yaml"), dampers=True)


def test_strains_beyond_the_tests_are_reported(folder):
    project = parse_project(PROJECT, folder / "project.yaml")
    devices = make_frame(project, dampers=True).devices
    assert devices[0].tested_strain == 0.5
    assert strain_warnings(devices, np.array([0.5])) == []
    (warning,) = strain_warnings(devices, np.array([0.62]))
    assert warning.text == "law rubber: 1 damper strains beyond its tests, which went to 50 %: S_1_1 to 62 %"
    assert warning.kind == "damper_strain" and warning.ratio == pytest.approx(1.24)


def test_strains_beyond_the_limit_of_a_device_are_reported(folder):
    text = PROJECT.replace("layer_thickness: 24 mm", "layer_thickness: 24 mm, strain_limit: 40 %")
    devices = make_frame(parse_project(text, folder / "project.yaml"), dampers=True).devices
    assert strain_warnings(devices, np.array([0.4])) == []
    (warning,) = strain_warnings(devices, np.array([0.5]))
    assert warning.text == "law rubber: 1 damper strains beyond `strain_limit`, 40 %: S_1_1 to 50 %"
    assert warning.kind == "strain_limit" and warning.ratio == pytest.approx(1.25)


def test_published_parameters_know_their_tests():
    assert strain_of_tests(LawDescription(type="mgmm", parameters="thesis_table_4_2")) == 0.5
    assert strain_of_tests(LawDescription(type="mgmm", parameters={})) is None


@pytest.mark.parametrize(
    ("written", "meant"),
    [
        ("BRB", "buckling_restrained"),
        ("power_viscous", "viscous_power"),
        ("lrb", "lead_rubber"),
        ("maxwel", "maxwell"),
        ("self-centring", "self_centring"),
    ],
)
def test_a_law_by_its_name_in_practice_is_answered_with_ours(written: str, meant: str) -> None:
    with pytest.raises(InputError, match=f"no damper law `{written}`; did you mean `{meant}`"):
        laws.law(written)


def test_what_practice_calls_laws_are_laws() -> None:
    assert set(laws._ALSO_CALLED.values()) <= set(laws.LAWS) and not set(laws._ALSO_CALLED) & set(laws.LAWS)
