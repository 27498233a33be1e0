"""Campaign files of structures, and their problem for the loop."""

from __future__ import annotations

import gzip
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from messages import says

from edesign.calibration import load_campaign
from edesign.calibration.structures.campaign import StructureCampaign, load_structure_campaign
from edesign.calibration.structures.from_campaign import blank_problem
from edesign.calibration.structures.problem import StructureProblem
from edesign.errors import InputError
from edesign.estimation.least_squares import fit
from edesign.estimation.model import PredictionError
from edesign.estimation.noise import Noise
from edesign.estimation.parameters import coordinates_of
from tools.campaign_of_isolated_building import isolation_layer_tests

STEP = 0.02
ISOLATED = """\
structure:
  name: model
  base: isolated
  floor_masses: [100 t, 100 t, 80 t]
  storey_stiffness: [200 kN/mm, 150 kN/mm]
  damping: {type: modal, ratio: 3 %}
law: {type: kelvin_voigt, parameters: {k: 3 kN/mm, c: 200 kN*s/m}}
channels:
  time: time
  base_acceleration: table
  floor_accelerations: [a1, a2, a3]
  floor_displacements: [u1, null, null]
  units: {time: s, acceleration: g, displacement: mm}
tests:
  - {file: small.csv, title: small, use: fit}
  - {file: large.csv.gz, use: validate}
"""
FIXED = """\
structure:
  base: fixed
  floor_masses: [100 t, 100 t]
  storey_stiffness: [20 kN/mm, 15 kN/mm]
  storey_heights: [4 m, 3 m]
  damping: {type: rayleigh, ratio: 0.02, modes: [1, 2]}
channels:
  time: time
  base_acceleration: table
  floor_accelerations: [a1, a2]
  units: {}
tests:
  - {file: small.csv}
"""


def base_motion(size: float, samples: int = 300) -> np.ndarray:
    """Frequencies from 0.3 to 12 Hz, so that all modes move; begins and ends at rest."""
    time = STEP * np.arange(samples)
    rng = np.random.default_rng(5)
    omega = np.linspace(2.0, 75.0, 60)
    total = np.sin(np.outer(time, omega) + rng.uniform(0.0, 2.0 * np.pi, omega.size)) @ (1.0 / np.sqrt(omega))
    return np.asarray(size * total * np.sin(np.pi * time / time[-1]))


def written(folder: Path, size: float, a: float = 9.80665, u: float = 1e-3) -> str:
    """A record of a three-storey building, numbers of no meaning but the base's."""
    base = base_motion(size)
    time = STEP * np.arange(base.size)
    rows = [(t, g / a, 0.5 * g / a, 0.6 * g / a, 0.7 * g / a, g / u / 10) for t, g in zip(time, base, strict=True)]
    return "\n".join(["time,table,a1,a2,a3,u1", *(",".join(f"{x:.9g}" for x in row) for row in rows), ""])


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    (tmp_path / "small.csv").write_text(written(tmp_path, 0.4))
    (tmp_path / "large.csv.gz").write_bytes(gzip.compress(written(tmp_path, 3.0).encode()))
    return tmp_path


def load(folder: Path, text: str) -> StructureCampaign:
    path = folder / "campaign.yaml"
    path.write_text(text)
    return load_structure_campaign(path)


def problem(folder: Path, text: str, *true: tuple[str, tuple[float, ...]], noise: float = 0.0) -> StructureProblem:
    """A problem whose measured values are those of the declared structure with effects."""
    blank = blank_problem(load(folder, text), threads=1)
    named = {effect.label: effect for effect in blank.effects}
    model = blank.model([named[label] for label, _ in true], ("fit", "validate"))
    values = [*(one.centre for one in blank.base), *(value for _, own in true for value in own)]
    rng = np.random.default_rng(3)
    tests = []
    for test, found in zip(blank.tests, model.histories(np.array(values)), strict=True):
        noisy = found + noise * found.std(axis=0) * rng.standard_normal(found.shape)
        tests.append(replace(test, values=noisy))
    return replace(blank, tests=tuple(tests))


def nrms(predicted: np.ndarray, measured: np.ndarray) -> float:
    return float(np.sum((predicted - measured) ** 2) / np.sum(measured**2))


def fitted(of: StructureProblem, label: str | None) -> tuple[np.ndarray, list[float]]:
    """Values of base and effect fitted to the tests for fitting, from the last start of the effect; errors of all."""
    chosen = [effect for effect in of.effects if effect.label == label]
    model, every = of.model(chosen), of.model(chosen, ("fit", "validate"))
    start = [*(one.centre for one in of.base), *(chosen[0].starts[-1] if chosen else ())]
    noise = Noise.white([0.01 * size for size in of.sizes])
    found = fit(model, noise, coordinates_of(model.parameters, start), 30)
    (predicted,) = every.predict(found.values[np.newaxis])
    assert not isinstance(predicted, PredictionError)
    return found.values, [nrms(p, m) for p, m in zip(predicted, every.measured, strict=True)]


def test_file_becomes_si(folder: Path) -> None:
    campaign = load(folder, ISOLATED)
    assert isinstance(load_campaign(campaign.path), StructureCampaign)
    assert campaign.building.masses.tolist() == [1e5, 1e5, 8e4]
    assert campaign.building.stiffness.tolist() == [0.0, 2e8, 1.5e8]
    assert campaign.isolation is not None and campaign.isolation.values == {"k": 3e6, "c": 2e5}
    mixed = load(folder, ISOLATED.replace("ratio: 3 %}", "ratio: 3 %, other: mass, share: 20 %}")).building.damping
    assert (mixed.kind, mixed.other, mixed.share) == ("modal", "mass", 0.2)
    small, large = campaign.tests
    assert (small.name, large.name) == ("small", "large")
    assert (small.use, large.use, small.title, small.step) == ("fit", "validate", "small", pytest.approx(STEP))
    assert np.allclose(small.base, base_motion(0.4), atol=1e-7)
    assert np.allclose(large.values[:, 3], base_motion(3.0) / 10, atol=1e-7)
    assert [c.label for c in small.channels][-1] == "displacement of floor 1"


@pytest.mark.parametrize(
    ("text", "old", "new", "message"),
    [
        (ISOLATED, "[200 kN/mm, 150 kN/mm]", "[200 kN/mm]", "5:21: structure.storey_stiffness: 1 2 E-VALUE-04"),
        (ISOLATED, "100 t, 100 t, 80 t", "100 t, 100 kN, 80 t", "structure.floor_masses[1] E-UNIT-02"),
        (ISOLATED, "floor_masses", "floor_mases", "did you mean `floor_masses`"),
        (ISOLATED, "  damping: {type: modal, ratio: 3 %}\n", "", "structure.damping E-KEY-02"),
        (ISOLATED, "type: modal", "type: critical", "modal"),
        (ISOLATED, "law: {type: kelvin_voigt, parameters: {k: 3 kN/mm, c: 200 kN*s/m}}\n", "", "law E-KEY-02"),
        (ISOLATED, ", c: 200 kN*s/m", "", "law.parameters.c: this parameter"),
        (ISOLATED, "ratio: 3 %}", "ratio: 3 %, other: mass}", "structure.damping.share E-KEY-02"),
        (ISOLATED, "ratio: 3 %}", "ratio: 3 %, share: 20 %}", "structure.damping.share E-KEY-02"),
        (ISOLATED, "ratio: 3 %}", "ratio: 3 %, other: modal, share: 20 %}", "structure.damping.other E-KEY-03"),
        (ISOLATED, "ratio: 3 %}", "ratio: 3 %, other: mass, share: 120 %}", "structure.damping.share E-VALUE-02"),
        (ISOLATED, "[u1, null, null]", "[u1]", "channels.floor_displacements E-VALUE-04"),
        (ISOLATED, "a3]", "a33]", "small.csv:1: there is no column `a33`; did you mean `a3`"),
        (ISOLATED, "acceleration: g", "acceleration: mm", "length"),
        (ISOLATED, "large.csv.gz", "huge.csv.gz", "tests[1].file E-FILE-01"),
        (ISOLATED, "large.csv.gz", "small.csv", "tests[1].file: line 15 E-FILE-09"),
        (ISOLATED, "base: isolated", "base: floating", "isolated"),
        (FIXED, "channels:", "law: {type: viscous, parameters: {c: 1 kN*s/m}}\nchannels:", "law E-KEY-03"),
        (FIXED, "  floor_accelerations: [a1, a2]\n", "", "channels E-KEY-03"),
        (FIXED, "modes: [1, 2]", "modes: [1]", "modes"),
    ],
)
def test_mistakes_are_reported_with_their_place(folder: Path, text: str, old: str, new: str, message: str) -> None:
    assert old in text
    with pytest.raises(InputError) as error:
        load(folder, text.replace(old, new))
    assert says(str(error.value), message)
    assert "campaign.yaml:" in str(error.value) or "small.csv:" in str(error.value)


def test_mistakes_in_records(folder: Path) -> None:
    lines = (folder / "small.csv").read_text().splitlines()
    for change, message in (
        (lambda rows: rows[:5] + rows[9:], "small.csv:6: the time 0.16 s is .* off an even step"),
        (lambda rows: [*rows[:8], rows[6], *rows[9:]], "small\\.csv:9: .*0\\.1 s .*0\\.12 s.*E-CALIB-03"),
        (lambda rows: rows[:9], "small\\.csv:9: .*16 samples, not 8.*E-CALIB-03"),
        (
            lambda rows: [rows[0], *(f"{r.split(',')[0]},0,1,1,1,1" for r in rows[1:])],
            "small\\.csv:2: the base acceleration.*E-CALIB-03",
        ),
    ):
        (folder / "small.csv").write_text("\n".join(change(lines)))
        with pytest.raises(InputError, match=message):
            load(folder, ISOLATED)
    (folder / "small.csv").write_text("\n".join(lines))
    (folder / "large.csv.gz").write_text("no gzip")
    with pytest.raises(InputError, match=r"large\.csv\.gz: .*E-TABLE-02"):
        load(folder, ISOLATED)
    (folder / "large.csv.gz").write_bytes(gzip.compress(b"time,table\n0,x\n"))
    with pytest.raises(InputError, match=r"large\.csv\.gz:2, column 2 \(`table`\): .*E-TABLE-08"):
        load(folder, ISOLATED)


def test_channels_are_compared_over_the_size_of_their_kind(folder: Path) -> None:
    of = problem(folder, ISOLATED)
    (measured,) = of.model(()).measured
    assert measured.size == of.tests[0].values.size
    assert np.mean(measured[: of.tests[0].base.size * 3] ** 2) == pytest.approx(1.0)  # accelerations of the fit
    assert [one.name for one in of.base] == ["storey_stiffness", "storey_damping", "k", "c"]
    model = of.model((), ("validate",))
    (predicted,) = model.predict(np.array([[one.centre for one in of.base]]))
    assert not isinstance(predicted, PredictionError) and nrms(predicted[0], model.measured[0]) < 1e-20


def test_parameters_that_stay(folder: Path) -> None:
    fixed = ISOLATED.replace("ratio: 3 %}", "ratio: 3 %}\n  refit: false").replace(
        "c: 200 kN*s/m}", "c: 200 kN*s/m}, refit: false"
    )
    assert blank_problem(load(folder, fixed)).base == ()
    law = "law: {type: bouc_wen, parameters: {Fy: 50 kN, Y: 10 mm, alpha: 0.3}}"
    text = "\n".join(law if line.startswith("law") else line for line in ISOLATED.splitlines())
    names = [u.name for u in blank_problem(load(folder, text)).base]
    assert names == ["storey_stiffness", "storey_damping", "Fy", "Y", "alpha"]  # none of the defaults


def test_bouc_wen_layer_is_a_linear_one_with_the_effect(folder: Path) -> None:
    # Fy z (1 - alpha) beside alpha Fy / Y: the declared law, and the same as an effect on a linear layer
    hysteretic = ISOLATED.replace(
        "type: kelvin_voigt, parameters: {k: 3 kN/mm, c: 200 kN*s/m}",
        "type: bouc_wen, parameters: {Fy: 50 kN, Y: 5 mm, alpha: 0.3}",
    )
    linear = ISOLATED.replace("c: 200 kN*s/m", "c: 0 kN*s/m")
    own = blank_problem(load(folder, hysteretic))
    other = problem(folder, linear, ("isolation_softening.bouc_wen", (35e3, 0.005)))
    histories = own.model((), ("fit", "validate")).histories(np.array([one.centre for one in own.base]))
    for mine, theirs in zip(histories, other.tests, strict=True):
        # a spring that is part of a link is linear in a step: 1 % of the largest at 20 ms and 12 Hz
        assert np.allclose(mine, theirs.values, rtol=0, atol=0.01 * np.max(np.abs(theirs.values)))


@pytest.mark.parametrize(
    ("text", "label", "values", "tolerance"),
    [
        # with refit: the base moves too, and must come back
        (ISOLATED, "isolation_softening.bouc_wen", (30e3, 0.004), 0.1),
        (ISOLATED, "lag.delay", (0.03,), 0.05),
        (FIXED, "mass_error.floor_2", (0.2,), 0.05),
        (FIXED, "damping.friction", (3e3,), 0.1),
        (FIXED, "flexible_base.rocking", (5e-10,), 0.1),
        (FIXED, "partitions.storey_1", (0.4,), 0.1),
        (FIXED, "partitions.lost", (0.3, 0.004), 0.15),
    ],
)
def test_hidden_effect_is_recovered(
    folder: Path, text: str, label: str, values: tuple[float, ...], tolerance: float
) -> None:
    of = problem(folder, text, (label, values), noise=0.003)
    without, error_without = fitted(of, None)
    found, error_with = fitted(of, label)
    assert error_with[0] < 0.5 * error_without[0]
    assert error_with[0] == pytest.approx(0.003**2, rel=0.2)  # the noise floor, whose mean offset is small
    assert found[-len(values) :] == pytest.approx(values, rel=tolerance)
    if len(error_with) == 2:
        assert error_with[1] < max(0.5 * error_without[1], 1e-3)
    assert found[: len(of.base)] == pytest.approx([one.centre for one in of.base], rel=0.15)


def test_no_motion_makes_a_mass_likely_that_no_floor_has(folder: Path) -> None:
    """5 kN/m2 of concrete, known to 5 %, declared with 0.3 of an imposed load of 3 kN/m2 that may be all there, or not.

    CoV of concrete: JCSS Probabilistic Model Code 2.1.4 (density 4 %) and 2.1.5 (180 mm: 4 + 0.006 * 180 mm).
    """
    own = 3.0 * float(np.hypot(0.04, (4.0 + 0.006 * 180.0) / 180.0))
    declared = 5.0 + 0.3 * 3.0
    believable = (5.0 * (1.0 - own) / declared - 1.0, (5.0 * (1.0 + own) + 3.0) / declared - 1.0)
    of = problem(folder, FIXED, ("mass_error.floor_2", (0.8,)), noise=0.003)
    (mass,) = (one for form in of.effects if form.label == "mass_error.floor_2" for one in form.parameters)
    assert (mass.lower, mass.upper) == pytest.approx(believable, abs=0.03)  # two digits are enough
    found, error = fitted(of, "mass_error.floor_2")
    assert found[-1] <= mass.upper and error[0] > 10.0 * 0.003**2  # 1.8 times is no explanation


def test_mass_and_stiffness_are_confounded(folder: Path) -> None:
    # base motion sees the ratio of stiffness to mass only: of a building that is fitted, all masses are no effect
    assert "mass_error.total" not in {one.label for one in blank_problem(load(folder, FIXED)).effects}
    fixed = problem(
        folder, FIXED.replace("modes: [1, 2]}", "modes: [1, 2]}\n  refit: false"), ("mass_error.total", (0.3,))
    )
    free = replace(fixed, refit=True).model(())
    (predicted,) = free.predict(np.array([[1.0 / 1.3, 1.0]]))
    assert not isinstance(predicted, PredictionError) and nrms(predicted[0], free.measured[0]) < 1e-20


def test_effects_fit_the_building(folder: Path) -> None:
    isolated = {c.label for c in blank_problem(load(folder, ISOLATED)).effects}
    fixed = {c.label for c in blank_problem(load(folder, FIXED)).effects}
    assert "isolation_softening.bouc_wen" in isolated - fixed
    assert {"flexible_base.sway", "flexible_base.rocking", "partitions.storey_1"} <= fixed - isolated
    without = FIXED.replace("  storey_heights: [4 m, 3 m]\n", "")
    assert "flexible_base.rocking" not in {c.label for c in blank_problem(load(folder, without)).effects}
    assert "gain.displacement" in isolated - fixed


def test_isolation_layer_is_a_damper_test(folder: Path) -> None:
    campaign = load(folder, ISOLATED)
    small = isolation_layer_tests(campaign)[0]
    expected = -(1e5 * 0.5 + 1e5 * 0.6 + 8e4 * 0.7) * base_motion(0.4)
    assert np.allclose(small.measured_force(), expected, atol=1e-2)
    assert np.allclose(small.displacement, base_motion(0.4) / 10, atol=1e-7)
    with pytest.raises(InputError, match="E-FILE-05"):
        isolation_layer_tests(load(folder, FIXED))
    with pytest.raises(InputError, match="floor 1 .*E-TABLE-10"):
        isolation_layer_tests(load(folder, ISOLATED.replace("  floor_displacements: [u1, null, null]\n", "")))
