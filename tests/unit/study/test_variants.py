"""The frames of the variants: forces times the property factor, laws at another temperature, exactly."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from cases.small_study import write

from edesign.archive.dataset import Group
from edesign.frame.project_file import load_study
from edesign.project.analysis.analyses import HistoryAnalysis
from edesign.project.dampers.dampers import DamperRun, Dampers
from edesign.project.notation.selections import ALL_NUMBERS
from edesign.project.study.study import Study
from edesign.study.analysis.dampers import device_laws
from edesign.study.analysis.history import run_history
from edesign.study.plan.study_plan import make_study_plan
from edesign.study.plan.variants import variant_project, variant_warnings

AREA = 0.01  # m2, of a layer
SPEC = HistoryAnalysis(name="shake", kind="history", record="motion", pga="0.3 g", free_vibration="1 s")


def study(folder: Path, *variants: str) -> Study:
    """The small study with other variants."""
    return load_study(write(folder, ("  upper: {", "".join(f"  {text}\n" for text in variants) + "  upper: {")))


def dampers(of: Study, area: float = AREA, number: int = 1) -> dict[str, Dampers]:
    """What the design of the study might be."""
    assert of.base.dampers is not None
    run = DamperRun.model_construct(
        kind="chevron",
        bays=ALL_NUMBERS,
        storeys=ALL_NUMBERS,
        law="rubber",
        number=number,
        layers=2,
        layer_area=area,
        layer_thickness=0.012,
        brace="rigid",
    )
    return {"added": of.base.dampers.model_copy(update={"devices": (run,)})}


def respond(of: Study, variant: str, designed: dict[str, Dampers], temperature_C: float | None = None) -> Group:
    return run_history(variant_project(of, variant, designed, temperature_C), SPEC)


def same(one: Group, other: Group, apart_from: tuple[str, ...] = ()) -> None:
    """All variables are equal bit by bit."""
    assert list(one.variables) == list(other.variables)
    for name, variable in one.variables.items():
        if name not in apart_from:
            assert variable.values.tobytes() == other.variables[name].values.tobytes(), name


def test_a_factor_of_two_is_a_double_area(tmp_path: Path) -> None:
    """Twice the force of each damper: twice its area, or two side by side; powers of two are exact in binary."""
    of = study(tmp_path, "twice: {design: added, property_factor: 2}")
    twice = respond(of, "twice", dampers(of))
    same(twice, respond(of, "damped", dampers(of, 2.0 * AREA)))
    same(twice, respond(of, "damped", dampers(of, number=2)))
    once = respond(of, "damped", dampers(of))
    drift, larger = (group.variables["storey_drift_max"].values for group in (twice, once))
    assert np.all(drift < larger)  # it does something


def test_factors_of_variant_and_law_multiply(tmp_path: Path) -> None:
    of = study(tmp_path, "fourfold: {design: added, property_factor: 4}")
    base = dampers(of)["added"]
    laws = {name: law.model_copy(update={"property_factor": 0.5}) for name, law in base.laws.items()}
    halved = {"added": base.model_copy(update={"laws": laws})}
    same(respond(of, "fourfold", halved), respond(of, "damped", dampers(of, 2.0 * AREA)))


@pytest.mark.parametrize(("T", "gamma"), [(20.0, 1.0), (25.0, 0.935), (35.0, 0.82)])
def test_the_temperature_replaces_that_of_the_laws(tmp_path: Path, T: float, gamma: float) -> None:
    """Thesis Table 4.4: gamma_T, which multiplies k1; Table 4.2: k1."""
    of = study(tmp_path, f"other: {{design: added, temperature: {T:g} degC}}")
    project = variant_project(of, "other", dampers(of))
    assert project.dampers is not None and project.dampers.laws["rubber"].temperature == T
    k1 = device_laws(project)["rubber"].law.values[0]
    reference = device_laws(of.base)["rubber"].law.values[0]
    assert reference == 0.515e6  # N/m, Table 4.2
    assert k1 / reference == pytest.approx(gamma, rel=1e-12)


def test_the_temperature_of_a_history_goes_before_that_of_the_variant(tmp_path: Path) -> None:
    of = study(tmp_path)
    warm = respond(of, "warm", dampers(of))
    same(warm, respond(of, "damped", dampers(of), 35.0))
    same(respond(of, "damped", dampers(of)), respond(of, "warm", dampers(of), 20.0))
    cool = respond(of, "damped", dampers(of))
    assert np.all(warm.variables["storey_drift_max"].values != cool.variables["storey_drift_max"].values)


def test_variants_without_dampers_and_with_those_of_the_project(tmp_path: Path) -> None:
    own = "  devices: [{kind: chevron, bays: all, storeys: 1, law: rubber}]\nanalyses:"
    path = write(tmp_path, ("  upper: {design: added,", "  upper: {dampers: project,"), project=(("analyses:", own),))
    of = load_study(path)
    assert variant_project(of, "bare", {}).dampers is None
    upper = variant_project(of, "upper", {}).dampers
    assert upper is not None and upper.laws["rubber"].property_factor == 1.5 and len(upper.devices) == 1
    assert of.base.dampers is not None and of.base.dampers.laws["rubber"].property_factor == 1.0  # left as it was


def test_only_the_laws_of_the_variant_change(tmp_path: Path) -> None:
    """Another law of the project need not know the temperature."""
    spare = "  laws:\n    spare: {type: kelvin_voigt, parameters: {k: 1 kN/mm, c: 10 kN*s/m}}\n"
    of = load_study(write(tmp_path, project=(("  laws:\n", spare),)))
    laws = variant_project(of, "warm", dampers(of)).dampers
    assert laws is not None and laws.laws["spare"].temperature is None and laws.laws["rubber"].temperature == 35.0
    assert not any("spare" in text for text in variant_warnings(of, make_study_plan(of)))


def test_warnings_about_temperatures_name_the_variant(tmp_path: Path) -> None:
    of = study(tmp_path)
    reported = variant_warnings(of, make_study_plan(of))
    assert any(text.startswith("variant warm: damper law rubber: ") and "at 35 degC" in text for text in reported)
    assert any(
        text.startswith("variant damped: ") and "beyond its table" in text and "10 degC" in text for text in reported
    )
    assert not any("bare" in text or "upper" in text for text in reported)
