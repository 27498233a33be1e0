"""Incremental studies: what the plan has, factors on the records, curves that start linear, what the archive says."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest
from cases.incremental_portal import HEIGHT, histories, study, write
from numpy.typing import ArrayLike

from edesign.archive.reader import open_archive
from edesign.assess.incremental import collect_stripes
from edesign.errors import InputError
from edesign.frame.project_file import load_study
from edesign.ground_motion.record import Record
from edesign.ground_motion.sources import Found
from edesign.project.analysis.analyses import HistoryAnalysis
from edesign.project.analysis.validity import Validity
from edesign.project.notation.units import STANDARD_GRAVITY
from edesign.project.study.incremental import LevelFactorStudy, PeakAccelerationStudy, SpectralAccelerationStudy
from edesign.project.study.study_loader import StudyError
from edesign.study.analysis.intensity import check_hazard_curves, intensity_period, level_intensity, motion_intensity
from edesign.study.motions.motions import Motion
from edesign.study.plan.plan import waves
from edesign.study.plan.study_plan import make_study_plan
from edesign.study.run.analyses import run_analysis
from edesign.study.run.incremental import incremental_group
from edesign.study.run.run import run_study

DRIFT = "interstorey_drift"


def spectral(levels: list[str], **more: object) -> SpectralAccelerationStudy:
    about = {"name": "ida", "records": "shake", "intensity": "spectral_acceleration", "levels": tuple(levels)}
    return SpectralAccelerationStudy.model_validate(about | more)


def test_the_plan_has_every_variant_record_and_intensity(tmp_path: Path) -> None:
    about = "records: [shake, still], intensity: pga, levels: {from: 0.1 g, to: 0.3 g, count: 3}, collapse_drift: 7 %"
    plan = make_study_plan(study(tmp_path, f"variants: same, free_vibration: 3 s, {about}"))
    assert [task.name for task in plan[:4]] == ["bare.modes", "bare.gravity", "same.modes", "same.gravity"]
    names = [f"same.ida.{record}.{level}" for record in ("shake", "still") for level in ("0.1g", "0.2g", "0.3g")]
    assert [task.name for task in plan[4:]] == names
    assert [task.order for task in plan] == list(range(10))
    assert {task.entry for task in plan[4:]} == {"same.ida"}
    last = plan[-1]
    assert isinstance(last.spec, HistoryAnalysis) and last.stripe is not None
    assert (last.stripe.incremental, last.stripe.step, last.stripe.chain) == ("ida", 2, "same.ida.still")
    assert last.stripe.intensity == 0.3 * STANDARD_GRAVITY == last.labels["intensity"]
    assert (last.record, last.spec.collapse_drift, last.spec.free_vibration) == ("still", 0.07, 3.0)
    sorted_plan = [[task.name for task in wave] for wave in waves(plan)]
    assert sorted_plan[0] == ["bare.modes", "bare.gravity", "same.modes", "same.gravity"]
    assert sorted_plan[1:] == [
        [f"same.ida.{r}.{level}" for r in ("shake", "still")] for level in ("0.1g", "0.2g", "0.3g")
    ]


def test_a_variant_of_the_study_or_one_history_can_be_asked_for(tmp_path: Path) -> None:
    found = study(tmp_path, "records: fitted, intensity: level_factor, level: MCE, levels: [0.5, 1]")
    both = [f"same.ida.fitted.x{factor}" for factor in ("0.5", "1")]
    assert [task.name for task in make_study_plan(found, ["same.ida"])] == both
    one = make_study_plan(found, ["bare.ida.fitted.x1"])
    assert [task.name for task in one] == ["bare.ida.fitted.x1"] and one[0].labels["level"] == "MCE"
    with pytest.raises(InputError, match="`bare.ida`.*E-NAME-01"):
        make_study_plan(found, ["bare.idb"])


@pytest.mark.parametrize(
    "name, words",
    [
        ("MCE", r"incremental\[0\].name.*`VARIANT.MCE`.*E-NAME-02"),
        ("modes", r"incremental\[0\].name.*`VARIANT.modes`.*E-NAME-02"),
    ],
)
def test_names_that_are_taken(tmp_path: Path, name: str, words: str) -> None:
    path = write(tmp_path, "records: shake, intensity: pga, levels: [0.1 g, 0.2 g]")
    text = path.read_text(encoding="utf-8")
    path.write_text(text.replace("name: ida", f"name: {name}"), encoding="utf-8")
    with pytest.raises(StudyError, match=words):
        load_study(path)
    line = text[text.index("  - {name: ida") : text.index("outputs:")]
    path.write_text(text.replace(line, 2 * line), encoding="utf-8")
    with pytest.raises(StudyError, match=r"incremental\[1\].name.*E-NAME-02"):
        load_study(path)


def test_an_elastoplastic_oscillator_starts_exactly_linear(tmp_path: Path) -> None:
    """Below yield the drift is Sa(T, 5 %) (T / 2 pi)^2 / h, and its ratio to Sa is one number; beyond, it is another.

    1e-3: the trapezoidal rule with 1/70 of the period against the exact spectrum. The columns yield at the drift
    sy h / (6 E c) of a member that is bent in double curvature by the strain sy / E at its layers' depth c; which layer
    of a plate yields first is left open by 14 %, the depth of the plates.
    """
    levels = [0.01, 0.02, 0.05, 0.1, 0.2, 0.4, 0.8, 1.6, 3.2]
    about = f"variants: bare, records: shake, intensity: spectral_acceleration, levels: {[f'{sa} g' for sa in levels]}"
    shaken = study(tmp_path, about, "linear", "0 kN")
    groups = histories(run_study(shaken, backend="serial").archive)
    period = intensity_period(shaken.base, dampers=False)
    drift = collect_stripes(groups, "ida", "bare", (DRIFT,))[DRIFT].values[0]
    intensity = np.array(levels) * STANDARD_GRAVITY
    slope = (period / (2.0 * math.pi)) ** 2 / HEIGHT
    yield_drift = 250e6 * HEIGHT / (6.0 * 210e9 * 0.14)
    elastic = slope * intensity < 0.85 * yield_drift
    assert 4 <= elastic.sum() <= 7 and np.isfinite(drift).all()
    assert drift[elastic] / intensity[elastic] == pytest.approx(slope, rel=1e-3)
    assert np.ptp(drift[elastic] / intensity[elastic]) <= 1e-8 * slope  # tolerance of the equilibrium
    beyond = slope * intensity > 2.0 * yield_drift
    assert beyond.any() and np.all(np.abs(drift[beyond] / (slope * intensity[beyond]) - 1.0) > 0.02)
    yielded = [group.variables["column_plastic_rotation_max"].values.max() for group in groups.values()]
    assert np.all(np.array(yielded)[elastic] < 1e-12) and np.all(np.array(yielded)[beyond] > 1e-4)


def test_intensities_of_each_measure(tmp_path: Path) -> None:
    project = study(tmp_path).base
    motion = recorded([0.0, 2.0, -1.0, 0.0])
    peak = PeakAccelerationStudy.model_validate(
        {"name": "p", "records": "shake", "intensity": "pga", "levels": ("1 m/s^2", "3 m/s^2"), "level": "MCE"}
    )
    assert motion_intensity(project, peak, motion, None) == 2.0
    factors = LevelFactorStudy.model_validate(
        {"name": "f", "records": "shake", "intensity": "level_factor", "levels": (1.0, 2.0), "level": "MCE"}
    )
    importance = (0.02 / 0.10) ** (-1.0 / 3.0)  # EN 1998-1, 2.1(4) Note, k = 3
    assert 1.0 / motion_intensity(project, factors, motion, None) == pytest.approx(importance)
    # a_g S at the period 0, and the branch of constant velocity: EN 1998-1, 3.2.2.2
    ag_s = importance * 0.36 * STANDARD_GRAVITY * 1.15
    assert level_intensity(project, peak, None, peak.level) == pytest.approx(ag_s)
    assert level_intensity(project, factors, None, factors.level) == 1.0
    sa = spectral(["0.1 g", "0.2 g"], level="MCE")
    assert level_intensity(project, sa, 1.2, sa.level) == pytest.approx(ag_s * 2.5 * 0.6 / 1.2)
    assert level_intensity(project, spectral(["0.1 g", "0.2 g"]), 1.2, None) is None
    with pytest.raises(InputError, match="E-MODAL-02"):
        motion_intensity(project, sa, motion, None)
    with pytest.raises(InputError, match="shake.*E-IDA-01"):
        motion_intensity(project, peak, recorded(np.zeros(4)), None)


def recorded(acceleration: ArrayLike) -> Motion:
    return Motion("shake", Found(Record("shake", np.array(acceleration), 0.01, "here", ""), "file", ""))


def test_records_are_scaled_to_the_intensities(tmp_path: Path) -> None:
    """The peak is the intensity; a fitted record is multiplied by the level's importance factor and the intensity."""
    shaken = study(tmp_path, "variants: bare, records: shake, intensity: pga, levels: [0.02 g, 0.05 g]")
    found = histories(run_study(shaken, backend="serial").archive)
    peaks = [group.attributes["input_pga_m_s2"] for group in found.values()]
    assert peaks == pytest.approx([0.02 * STANDARD_GRAVITY, 0.05 * STANDARD_GRAVITY], rel=1e-12)
    about = "variants: bare, records: fitted, intensity: level_factor, level: MCE, levels: [0.02, 0.05]"
    found = histories(run_study(study(tmp_path, about), backend="serial").archive)
    factors = [group.attributes["scale_factor"] for group in found.values()]
    assert factors == pytest.approx([factor * 5.0 ** (1.0 / 3.0) for factor in (0.02, 0.05)], rel=1e-12)


def test_without_a_limit_equilibrium_is_lost_at_a_large_drift(tmp_path: Path) -> None:
    """The history of a project ends as before, but says that it is a collapse."""
    spec = HistoryAnalysis(kind="history", name="strong", record="shake", scale=50.0).model_copy(
        update={"free_vibration": 20.0}
    )
    base = study(tmp_path).base
    group = run_analysis(base.model_copy(update={"validity": Validity(drift=1e9)}), spec)
    assert group.attributes["status"] == "failed"
    assert group.attributes["collapsed"] is True
    assert "equilibrium was lost" in group.attributes["reason"] and "drift of storey 1" in group.attributes["reason"]


def test_the_group_of_the_study(tmp_path: Path) -> None:
    project = study(tmp_path).base
    sa = spectral(["0.1 g", "0.2 g"], level="MCE", limits={"LS": {"interstorey_drift": "2.5 %"}})
    group = incremental_group(project, sa, {"bare": 2.4, "damped": 1.2, "failed": None})
    assert group.coords["intensity"].values == pytest.approx([0.1 * STANDARD_GRAVITY, 0.2 * STANDARD_GRAVITY])
    assert group.coords["intensity"].unit == "m/s^2"
    assert group.variables["period"].values.tolist()[:2] == [2.4, 1.2]
    # the branch of constant velocity, as above: inversely proportional to the period
    at_one_second = (0.02 / 0.10) ** (-1.0 / 3.0) * 0.36 * STANDARD_GRAVITY * 1.15 * 2.5 * 0.6
    assert group.variables["level_intensity"].values[1] == pytest.approx(at_one_second / 1.2)
    assert np.isnan(group.variables["period"].values[2]) and np.isnan(group.variables["level_intensity"].values[2])
    assert group.attributes["limits"] == {"LS": ["interstorey_drift", 0.025]}
    assert group.attributes["level"] == "MCE" and group.attributes["collapse_drift"] == 0.1


def test_the_period_of_a_variant_is_that_with_its_dampers(tmp_path: Path) -> None:
    """A spring k beside the frame of K: T = 2 pi sqrt(m / (K + k)), with m = 40 t and K by the period without it."""
    path = write(
        tmp_path, "records: shake, intensity: spectral_acceleration, levels: [0.01 g, 0.02 g]", "linear", "0 kN"
    )
    path.write_text(path.read_text(encoding="utf-8").replace("same: {dampers: none}", "damped: {dampers: project}"))
    project = tmp_path / "project.yaml"
    spring = "{type: kelvin_voigt, parameters: {k: 2 kN/mm, c: 0 N*s/m}}"
    dampers = f"dampers: {{laws: {{spring: {spring}}}, devices: [{{kind: storey, bays: 1, storeys: 1, law: spring}}]}}"
    project.write_text(f"{project.read_text(encoding='utf-8')}{dampers}\n", encoding="utf-8")
    with open_archive(run_study(load_study(path), backend="serial").archive) as opened:
        group = opened.group("incremental/ida")
    assert group.coords["variant"].values.tolist() == ["bare", "damped"]
    bare, damped = group.variables["period"].values
    assert damped == pytest.approx(bare / math.sqrt(1.0 + 2e6 * bare**2 / (4.0 * math.pi**2 * 40e3)), rel=1e-6)
    assert damped < 0.9 * bare


RARER = (
    "records: shake, intensity: spectral_acceleration, {period}levels: [0.5 g, 1 g], collapse_drift: 8 %, "
    "life_cycle: {{hazard_curve: {{levels: {{DBE: 475 years, MCE: {rare}}}}}}}"
)


@pytest.mark.parametrize(
    ("period", "said"), [("period: 0.8 s, ", r"at 0.8 s \(0.77625g and 1.32737g\)"), ("", "any period")]
)
def test_a_rarer_level_has_the_larger_intensity(tmp_path: Path, period: str, said: str) -> None:
    levels = ("levels: {MCE: {probability: 2 %}}", "levels: {DBE: {gamma_I: 1}, MCE: {probability: 2 %}}")
    path = write(tmp_path, RARER.format(period=period, rare="2475 years"))
    project = tmp_path / "project.yaml"
    project.write_text(project.read_text(encoding="utf-8").replace(*levels), encoding="utf-8")
    check_hazard_curves(load_study(path))
    text = path.read_text(encoding="utf-8").replace("MCE: 2475 years", "MCE: 95 years")
    path.write_text(text, encoding="utf-8")
    with pytest.raises(InputError, match=rf"study.yaml:7:\d+: incremental\[0\].*levels.DBE: .*{said}.*E-IDA-02"):
        check_hazard_curves(load_study(path))
