"""The least dampers by histories against a scan of all dampers, with histories of a linear state space of the test.

Two equal storeys shear: edesign makes the frame and the search, the test makes the histories. Levy and Lavan (2006),
Structural and Multidisciplinary Optimization 32, find that the least dampers are fully stressed: every storey with
dampers drifts as far as it may.
"""

from __future__ import annotations

import itertools
from collections.abc import Callable, Mapping
from pathlib import Path

import numpy as np
import pytest
import scipy
from design_examples import MadeVerdict, design, shear_project
from shear_frames import HEIGHT, MASS, STIFFNESS

from edesign.archive.dataset import Group
from edesign.project.dampers.dampers import DamperRun, Dampers
from edesign.study.design.design import DesignResult, run_design

PRECISION = 0.01
LIMIT = 2.5e-3  # of the drift; 11.3e-3 without dampers
SHAPE = np.array([[1.0, 0.0], [-1.0, 1.0]])  # drifts of the floors' displacements
FRAME = STIFFNESS * SHAPE.T @ SHAPE
INHERENT = 0.03
STEP = 0.01  # s: 24 samples in the second period
OIL = "\ndampers: {laws: {oil: {type: viscous, parameters: {c: 1 kN*s/m}}}}\n"
VERIFY = f"verify: {{records: shake, levels: DBE, criteria: drift, rounds: 20, change: @, precision: {PRECISION}}}"
COMMON = f"kind: storey, bays: 1, state: initial, level: DBE, inherent_damping: {INHERENT}, drift: {100.0 * LIMIT} %"


def motion() -> np.ndarray:
    """Noise that swells and dies out, filtered as by a ground of 2 Hz, m/s2."""
    noise = np.random.default_rng(7).standard_normal(1500)
    time = STEP * np.arange(noise.size)
    b, a = scipy.signal.butter(2, [0.8, 5.0], "bandpass", fs=1.0 / STEP)
    shaken = np.asarray(scipy.signal.lfilter(b, a, noise)) * np.sin(np.pi * time / time[-1])
    return shaken * 3.0 / np.max(np.abs(shaken))


GROUND = motion()


def peak_drifts(k: np.ndarray, c: np.ndarray) -> np.ndarray:
    """Largest drifts over height with springs and dashpots (n, 2) beside the storeys; exact for a motion of lines."""
    omega = np.sqrt(np.linalg.eigvalsh(FRAME / MASS))
    damping = 2.0 * INHERENT / omega[0] * FRAME + SHAPE.T @ (c[:, :, None] * SHAPE)
    stiffness = FRAME + SHAPE.T @ (k[:, :, None] * SHAPE)
    whole = np.zeros((c.shape[0], 6, 6))
    whole[:, :2, 2:4] = STEP * np.eye(2)
    whole[:, 2:4, :2], whole[:, 2:4, 2:4] = -STEP * stiffness / MASS, -STEP * damping / MASS
    whole[:, 2:4, 4], whole[:, 4, 5] = -STEP, 1.0
    exact = scipy.linalg.expm(whole)
    own, now, after = exact[:, :4, :4], exact[:, :4, 4] - exact[:, :4, 5], exact[:, :4, 5]
    state, drifts = np.zeros((c.shape[0], 4)), np.zeros((c.shape[0], 2))
    for one, other in itertools.pairwise(GROUND.tolist()):
        state = np.einsum("nij,nj->ni", own, state) + now * one + after * other
        drifts = np.maximum(drifts, np.abs(state[:, :2] @ SHAPE.T))
    return drifts / HEIGHT


def least_by_scan(drifts: Callable[[np.ndarray], np.ndarray], most: float) -> float:
    """The least sum of two sizes that meet the limit: on a grid, and on two finer ones about the best of it."""
    centre, half = np.array([0.5 * most, 0.5 * most]), 0.5 * most
    for _ in range(3):
        axes = [np.linspace(max(at - half, 0.0), at + half, 41) for at in centre]
        sizes = np.array([(one, other) for one in axes[0] for other in axes[1]])
        good = sizes[drifts(sizes).max(axis=1) <= LIMIT]
        centre, half = good[int(np.argmin(good.sum(axis=1)))], half / 10.0
    return float(centre.sum())


class Histories:
    """Histories of the dampers of a round: `stiffness` and `dashpot` of each storey from what the frame gets."""

    def __init__(self, of: Callable[[DamperRun], tuple[np.ndarray, np.ndarray]]) -> None:
        self.of, self.drifts = of, np.empty(0)

    def respond(self, dampers: Dampers, number: int) -> Mapping[str, Group]:
        (run,) = dampers.devices
        assert isinstance(run, DamperRun)
        self.drifts = peak_drifts(*self.of(run))[0]
        group = Group(attributes={"level": "DBE"})
        for name, values in (("storey_drift_max", self.drifts), ("storey_drift_min", -self.drifts)):
            group.add(name, ("storey",), values, "1", name)
        return {"only": group}

    def judge(self, groups: Mapping[str, Group]) -> list[MadeVerdict]:
        return [MadeVerdict(float(self.drifts.max()), limit=LIMIT)]


@pytest.mark.parametrize("a_gR", [0.02, 0.06, 1.0], ids=["no dampers needed", "about right", "none are enough"])
def test_least_coefficients_whatever_the_estimate_says(a_gR: float) -> None:
    project = shear_project(2, OIL).with_values("hazard.a_gR", f"{a_gR} g")
    text = f"method: viscous, law: oil, distribution: least_coefficient, {COMMON}"

    def of(run: DamperRun) -> tuple[np.ndarray, np.ndarray]:
        return np.zeros((1, 2)), 1e3 * np.array([run.scale])

    reported = run_design(project, "tried", design(text, project), Path("."))
    assert (reported.status == "failed") == (a_gR != 0.06)
    if reported.reason:
        assert reported.reason.endswith("by the response spectrum: with `verify` histories decide [E-DESIGN-04]")
    histories = Histories(of)

    def verified(rounds: int) -> DesignResult:
        verify = VERIFY.replace("@", "coefficient").replace("rounds: 20", f"rounds: {rounds}")
        asked = design(f"{text}, {verify}", project)
        return run_design(project, "tried", asked, Path("."), histories.respond, histories.judge)

    found = verified(20)
    assert found.status == "completed", found.reason
    enough = max(int(np.argmax(found.group.variables["round_met"].values)) + 1, 2)  # that meet the limit
    few = verified(enough)
    assert few.status == "completed" and f"all {enough} `rounds` were used" in str(few.group.attributes["warnings"])
    assert "`rounds`" not in str(found.group.attributes["warnings"])
    c = found.group.variables["damping_coefficient"].values
    (drifts,) = peak_drifts(np.zeros((1, 2)), c[None])
    assert drifts.max() <= LIMIT
    best = least_by_scan(lambda x: peak_drifts(np.zeros_like(x), x), 4e6)
    # the sum is within the precision of dampers that are not enough, and the last step is of the precision, too;
    # every storey keeps dampers of 0.1 % of its stiffness; the finest grid has steps of 2e-4 of 4 MNs/m
    assert 0.995 * best < c.sum() < (1.0 + PRECISION) ** 2 * best + 3e3
    rounds = found.group.variables["round_history_drift"].values
    # rounding of coefficients that become scales and back
    assert np.any(np.all(np.isclose(rounds, drifts, rtol=1e-9), axis=1))


def test_least_area_whatever_the_estimate_says() -> None:
    """Kelvin-Voigt: k and c are proportional to the area, so that the least area is the least of either."""
    project = shear_project(2).with_values("hazard.a_gR", "1.0 g")
    text = (
        "method: strain_energy, law: rubber, distribution: least_area, strain: 20 %, layer_thickness: 10 mm, "
        f"properties: law, {COMMON}, {VERIFY.replace('@', 'area')}"
    )

    def sized(area: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        return 2e6 * area / 0.01, 200e3 * area / 0.01  # over the area of the prototype, of the same thickness

    histories = Histories(lambda run: sized(np.array([run.layer_area])))
    found = run_design(project, "tried", design(text, project), Path("."), histories.respond, histories.judge)
    assert found.status == "completed", found.reason
    area = found.group.variables["layer_area"].values
    assert peak_drifts(*sized(area[None])).max() <= LIMIT
    best = least_by_scan(lambda x: peak_drifts(*sized(x)), 0.5)
    assert 0.995 * best < area.sum() < (1.0 + PRECISION) ** 2 * best  # as above
