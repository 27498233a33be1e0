"""Chains of incremental histories: scale factors, curves that start linear, collapse, and what is skipped."""

from __future__ import annotations

import math
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy as np
import pytest

from edesign.archive.dataset import Group
from edesign.assess.incremental import collect_stripes
from edesign.errors import InputError
from edesign.ground_motion.project_records import find_recordings
from edesign.ground_motion.record import Record
from edesign.project.incremental import LevelFactorStudy, PeakAccelerationStudy, SpectralAccelerationStudy
from edesign.project.loader import parse_project
from edesign.project.project import Project
from edesign.project.units import STANDARD_GRAVITY
from edesign.study.analyses import run_analysis
from edesign.study.incremental import Chain, chain_factors, incremental_group, make_chains, run_chain
from edesign.study.intensity import first_period, level_intensity
from edesign.study.motions import Motion

HEIGHT, MASS = 4.0, 40e3
TEXT = """\
edesign: 1
title: Portal whose columns yield sharply, under a heavy beam that does not bend
frame:
  bays: [1000 m]
  storeys: [4 m]
  diaphragms: all
  columns: [{storeys: all, section: column, material: steel}]
  beams: [{floors: 1, section: rigid, material: elastic}]
sections:
  column: {rectangles: [{width: 100 mm, depth: 20 mm, centre: -140 mm}, {width: 100 mm, depth: 20 mm, centre: 140 mm}]}
  rigid: {area: 1 m^2, inertia: 1e6 m^4}
materials:
  steel: {law: bilinear, E: 210 GPa, fy: 250 MPa}
  elastic: {law: elastic, E: 210 GPa}
elements: {geometry: {columns: @geometry@}}
loads: {nodes: [{lines: all, floors: 1, G: @load@}]}
masses: {given: [{lines: all, floors: all, mass: 20 t}], directions: horizontal}
damping: {kind: modal, ratio: 5 %, modes: 1}
integration: {method: newmark, time_step: 0.005 s, tolerance: 1e-10}
hazard: {code: ec8-2004, country: greece, zone: 3, ground: C, spectrum: 1, levels: {MCE: {probability: 2 %}}}
records:
  shake: {file: shake.csv, acceleration_unit: m/s^2, time_step: 0.01 s}
analyses: [{name: modes, kind: modal, modes: 1}]
"""
DRIFT = "interstorey_drift"


def portal(folder: Path, geometry: str = "linear", load: str = "0 kN") -> Project:
    t = np.arange(400) * 0.01
    motion = np.sin(np.pi * t / 4.0) ** 2 * (np.sin(9.0 * t) + 0.5 * np.sin(23.0 * t + 1.0))
    (folder / "shake.csv").write_text("\n".join(map(str, motion)), encoding="utf-8")
    text = TEXT.replace("@geometry@", geometry).replace("@load@", load)
    return parse_project(text, folder / "project.yaml")


def shake(project: Project) -> Motion:
    return Motion("shake", find_recordings(project, ["shake"])["shake"])


def spectral(levels: list[str], **more: object) -> SpectralAccelerationStudy:
    about = {"name": "ida", "records": "shake", "intensity": "spectral_acceleration", "levels": tuple(levels)}
    return SpectralAccelerationStudy.model_validate(about | more)


def one_chain(study: SpectralAccelerationStudy, variant: str = "bare") -> Chain:
    return make_chains(study, {variant: False}, ["shake"])[0]


def test_an_elastoplastic_oscillator_starts_exactly_linear(tmp_path: Path) -> None:
    """Below yield the drift is Sa(T, 5 %) (T / 2 pi)^2 / h, and its ratio to Sa is one number; beyond, it is another.

    1e-3: the trapezoidal rule with 1/70 of the period against the exact spectrum. The columns yield at the drift
    sy h / (6 E c) of a member that is bent in double curvature by the strain sy / E at its layers' depth c; which layer
    of a plate yields first is left open by 14 %, the depth of the plates.
    """
    project = portal(tmp_path)
    period = first_period(project, dampers=False)
    levels = [0.01, 0.02, 0.05, 0.1, 0.2, 0.4, 0.8, 1.6, 3.2]
    groups = run_chain(project, one_chain(spectral([f"{sa} g" for sa in levels])), shake(project), period)
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


def test_factors_of_each_measure(tmp_path: Path) -> None:
    project = portal(tmp_path)
    record = Record("shake", np.array([0.0, 2.0, -1.0, 0.0]), 0.01, "here", "")
    peak = PeakAccelerationStudy.model_validate(
        {"name": "p", "records": "shake", "intensity": "pga", "levels": ("1 m/s^2", "3 m/s^2"), "level": "MCE"}
    )
    chain = make_chains(peak, {"bare": False}, ["shake"])[0]
    assert chain_factors(project, chain, record, None) == pytest.approx((0.5, 1.5))
    factors = LevelFactorStudy.model_validate(
        {"name": "f", "records": "shake", "intensity": "level_factor", "levels": (1.0, 2.0), "level": "MCE"}
    )
    chain = make_chains(factors, {"bare": False}, ["shake"])[0]
    importance = (0.02 / 0.10) ** (-1.0 / 3.0)  # EN 1998-1, 2.1(4) Note, k = 3
    assert chain_factors(project, chain, record, None) == pytest.approx((importance, 2.0 * importance))
    assert [spec.name for spec in chain.histories] == ["bare.f.shake.x1", "bare.f.shake.x2"]
    assert {spec.level for spec in chain.histories} == {"MCE"}
    # a_g S at the period 0, and the branch of constant velocity: EN 1998-1, 3.2.2.2
    ag_s = importance * 0.36 * STANDARD_GRAVITY * 1.15
    assert level_intensity(project, peak, None) == pytest.approx(ag_s)
    assert level_intensity(project, factors, None) == 1.0
    study = spectral(["0.1 g", "0.2 g"], level="MCE")
    assert level_intensity(project, study, 1.2) == pytest.approx(ag_s * 2.5 * 0.6 / 1.2)
    assert level_intensity(project, spectral(["0.1 g", "0.2 g"]), 1.2) is None
    with pytest.raises(InputError, match="no period"):
        chain_factors(project, one_chain(study), record, None)
    with pytest.raises(InputError, match="shake: the record has no pga"):
        still = Record("shake", np.zeros(4), 0.01, "here", "")
        chain_factors(project, make_chains(peak, {"bare": False}, ["shake"])[0], still, None)


def test_collapse_ends_a_chain(tmp_path: Path) -> None:
    """Under gravity the yielding portal falls; at lower intensities it stands, and higher ones are not run."""
    project = portal(tmp_path, "p_delta", "500 kN")
    chain = one_chain(
        spectral(["0.05 g", "2 g", "3 g", "4 g", "5 g", "6 g"], collapse_drift="8 %", free_vibration="2 s")
    )
    groups = run_chain(project, chain, shake(project), 0.8)
    assert list(groups) == [spec.name for spec in chain.histories]
    assert list(groups)[0] == "bare.ida.shake.0.05g"
    states = [str(group.attributes["status"]) for group in groups.values()]
    first = states.index("failed")
    assert 1 <= first <= 4, states
    assert states == ["completed"] * first + ["failed"] + ["skipped"] * (5 - first)
    fallen, skipped = list(groups.values())[first], list(groups.values())[-1]
    assert fallen.attributes["collapsed"] is True
    assert str(fallen.attributes["reason"]).startswith("collapsed: drift of storey 1 reached 8")
    ends = [abs(fallen.variables[f"storey_drift_{end}"].values[0]) for end in ("max", "min")]
    assert 0.08 < max(ends) < 0.09  # the step beyond the limit
    assert "residual_storey_drift" not in fallen.variables
    level = f"{fallen.attributes['intensity'] / STANDARD_GRAVITY:g}g"
    assert skipped.attributes["reason"] == f"collapsed at {level}" and not skipped.variables
    about = {"incremental": "ida", "variant": "bare", "record": "shake", "kind": "history", "height": 4.0}
    for group, intensity in zip(groups.values(), chain.intensities, strict=True):
        assert {key: group.attributes[key] for key in about} == about
        assert group.attributes["intensity"] == intensity
    values = collect_stripes(groups, "ida", "bare", (DRIFT,))[DRIFT].values[0]
    assert np.isfinite(values[:first]).all() and np.isinf(values[first:]).all()


def test_without_a_limit_equilibrium_is_lost_at_a_large_drift(tmp_path: Path) -> None:
    """The history of a project ends as before, but says that it is a collapse."""
    project = portal(tmp_path, "p_delta", "500 kN")
    chain = one_chain(spectral(["5 g", "6 g"], free_vibration="20 s"))
    spec = chain.histories[0].model_copy(update={"scale": 50.0, "collapse_drift": None})
    group = run_analysis(project, spec, motion=shake(project))
    assert group.attributes["status"] == "failed"
    assert group.attributes["collapsed"] is True
    assert "equilibrium was lost" in group.attributes["reason"] and "drift of storey 1" in group.attributes["reason"]


def same(a: Group, b: Group) -> bool:
    def plain(group: Group) -> dict[str, object]:
        about = dict(group.attributes)
        about["statistics"] = {k: v for k, v in dict(about.get("statistics", {})).items() if k != "cpu_s"}
        return about

    values = all(np.array_equal(v.values, b.variables[k].values) for k, v in a.variables.items())
    return values and list(a.variables) == list(b.variables) and plain(a) == plain(b)


def test_results_do_not_depend_on_what_runs_beside(tmp_path: Path) -> None:
    """Four chains side by side, and one after the other in reverse: the same bits."""
    project = portal(tmp_path, "p_delta", "500 kN")
    study = spectral(["0.05 g", "2 g", "4 g"], collapse_drift="8 %")
    chains = make_chains(study, {name: False for name in "abcd"}, ["shake"])
    assert len({chain.name for chain in chains}) == 4
    motion = shake(project)
    with ThreadPoolExecutor(4) as pool:
        together = list(pool.map(lambda chain: run_chain(project, chain, motion, 0.8), chains))
    alone = [run_chain(project, chain, motion, 0.8) for chain in reversed(chains)][::-1]
    for a, b in zip(together, alone, strict=True):
        assert list(a) == list(b)
        assert all(same(a[name], b[name]) for name in a)


def test_what_cannot_be_run_is_kept_as_failed(tmp_path: Path) -> None:
    project = portal(tmp_path)
    chain = one_chain(spectral(["0.05 g", "0.1 g"]))
    found = shake(project).found
    groups = run_chain(project, chain, Motion("shake", found, failure="shake cannot be fitted"), 0.8)
    assert [group.attributes["status"] for group in groups.values()] == ["failed", "failed"]
    assert {group.attributes["reason"] for group in groups.values()} == {"shake cannot be fitted"}
    assert [group.attributes["intensity"] for group in groups.values()] == list(chain.intensities)


def test_a_stop_keeps_what_was_finished(tmp_path: Path) -> None:
    project = portal(tmp_path)
    chain = one_chain(spectral(["0.05 g", "0.1 g", "0.2 g"]))
    told: list[tuple[int, int]] = []

    def progress(done: int, steps: int) -> None:
        told.append((done, steps))

    groups = run_chain(project, chain, shake(project), 0.8, progress, lambda: told[-1][0] > told[-1][1] / 3)
    assert list(groups) == ["bare.ida.shake.0.05g"]
    assert all(steps == told[0][1] and done <= steps for done, steps in told)
    assert [done for done, _ in told] == sorted(done for done, _ in told)


def test_the_group_of_the_study(tmp_path: Path) -> None:
    project = portal(tmp_path)
    study = spectral(["0.1 g", "0.2 g"], level="MCE", limits={"LS": {"interstorey_drift": "2.5 %"}})
    group = incremental_group(project, study, {"bare": 2.4, "damped": 1.2})
    assert group.coords["intensity"].values == pytest.approx([0.1 * STANDARD_GRAVITY, 0.2 * STANDARD_GRAVITY])
    assert group.coords["intensity"].unit == "m/s^2"
    assert group.variables["period"].values.tolist() == [2.4, 1.2]
    assert group.variables["level_intensity"].values[1] == level_intensity(project, study, 1.2)
    assert group.attributes["limits"] == {"LS": ["interstorey_drift", 0.025]}
    assert group.attributes["level"] == "MCE" and group.attributes["collapse_drift"] == 0.1
