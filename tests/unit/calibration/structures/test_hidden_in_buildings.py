"""What a search finds in records of buildings that SciPy's integrator made, with something hidden or nothing."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pytest
import yaml
from scipy.integrate import solve_ivp
from scipy.linalg import eigh

from edesign.calibration import calibrate
from edesign.calibration.residual.series import Stage
from edesign.calibration.results.result import Calibration
from edesign.calibration.structures.building import Building, Damping
from edesign.calibration.structures.campaign import Isolation, StructureCampaign
from edesign.calibration.structures.corrected import corrected_texts
from edesign.calibration.structures.record import Channel, StructureTest
from edesign.report.calibration.figures import calibration_figures
from edesign.report.html.lettering import faults

STEP, SAMPLES = 0.01, 700
MASSES, STOREYS, RATIO = np.array([1e5, 1e5, 8e4]), np.array([9e7, 8e7, 6e7]), 0.03
LAYER = {"k": 3e6, "c": 2e5}  # under two floors: 0.6 Hz
NOISE = 0.005  # of the rms of each channel
SIZES = {"small": 0.3, "large": 1.5, "other": 0.8}  # m/s2; the last one is for validation
Force = Callable[[np.ndarray, np.ndarray, np.ndarray], np.ndarray]


@dataclass(frozen=True)
class Made:
    """A building with masses (n,) and the restoring force of (q, v, z), followed by the rates of its own states z."""

    masses: np.ndarray
    force: Force
    states: int = 0


def base_motion(seed: int, size: float) -> np.ndarray:
    """Sines of 0.2 to 12 Hz with random phases in an envelope, (t,) m/s2."""
    random = np.random.default_rng(seed)
    time = STEP * np.arange(SAMPLES)
    omega = 2.0 * np.pi * np.geomspace(0.2, 12.0, 80)
    sines = np.sin(np.outer(time, omega) + random.uniform(0.0, 2.0 * np.pi, omega.size)) @ omega**-0.3
    shaped = sines * np.sin(np.pi * time / time[-1])
    return np.asarray(size * shaped / np.max(np.abs(shaped)))


def chain(springs: np.ndarray) -> np.ndarray:
    """Matrix (n, n) of springs (n,) between neighbours, the first to the ground."""
    upper = np.append(springs[1:], 0.0)
    return np.diag(springs + upper) - np.diag(springs[1:], 1) - np.diag(springs[1:], -1)


def modal_damping(masses: np.ndarray, stiffness: np.ndarray) -> np.ndarray:
    """Clough and Penzien, Dynamics of Structures, 12.5: M (sum of 2 z w f f^T) M."""
    squares, shapes = eigh(stiffness, np.diag(masses))
    return np.asarray(np.diag(masses) @ shapes @ np.diag(2.0 * RATIO * np.sqrt(squares)) @ shapes.T @ np.diag(masses))


def accelerations(made: Made, ground: np.ndarray) -> np.ndarray:
    """Absolute accelerations (t, n) of the floors."""
    n, time = made.masses.size, STEP * np.arange(ground.size)

    def rate(t: float, y: np.ndarray) -> np.ndarray:
        found = made.force(y[:n], y[n : 2 * n], y[2 * n :])
        at = min(int(t / STEP), ground.size - 2)
        shaking = ground[at] + (t / STEP - at) * (ground[at + 1] - ground[at])
        return np.concatenate((y[n : 2 * n], -shaking - found[:n] / made.masses, found[n:]))

    start = np.zeros(2 * n + made.states)
    y = solve_ivp(rate, (0.0, time[-1]), start, t_eval=time, rtol=1e-6, atol=1e-9, max_step=STEP).y
    forces = [made.force(y[:n, i], y[n : 2 * n, i], y[2 * n :, i])[:n] for i in range(time.size)]
    return np.asarray(-np.array(forces) / made.masses)


def linear(masses: np.ndarray, stiffness: np.ndarray, damping: np.ndarray) -> Made:
    return Made(masses, lambda q, v, z: stiffness @ q + damping @ v)


def fixed(masses: np.ndarray = MASSES, springs: np.ndarray = STOREYS) -> Made:
    """A building on a fixed base with modal damping."""
    return linear(masses, chain(springs), modal_damping(masses, chain(springs)))


def on_soft_ground() -> Made:
    """Under the lowest storey stands a spring on the ground: both are one softer spring."""
    return fixed(springs=np.array([1.0 / (1.0 / STOREYS[0] + 1.0 / 2.5e8), *STOREYS[1:]]))


def damped_by_stiffness() -> Made:
    """Ratios in proportion to frequency, as declared in the first mode."""
    stiffness = chain(STOREYS)
    first = float(np.sqrt(eigh(stiffness, np.diag(MASSES), eigvals_only=True)[0]))
    return linear(MASSES, stiffness, 2.0 * RATIO / first * stiffness)


def isolated(strength: float = 0.0, yielding: float = 0.004) -> Made:
    """Two floors on a linear layer, with a Bouc-Wen force (Wen 1976, n = 1) beside it."""
    stiffness = chain(np.array([LAYER["k"], STOREYS[1]]))
    above = 2.0 * RATIO * np.sqrt(STOREYS[1] * MASSES[1])  # critical damping of the floor on the layer's, fixed
    damping = chain(np.array([LAYER["c"], above]))

    def force(q: np.ndarray, v: np.ndarray, z: np.ndarray) -> np.ndarray:
        forces = stiffness @ q + damping @ v
        forces[0] += strength * z[0]
        return np.append(forces, (v[0] - 0.5 * abs(v[0]) * z[0] - 0.5 * v[0] * abs(z[0])) / yielding)

    return Made(MASSES[:2], force, 1)


def calibrated(made: Made, on_layer: bool = False, late: int = 0, declared: float = 1.0) -> Calibration:
    """What the search says of a campaign."""
    return calibrate(campaign_of(made, on_layer, late, declared), threads=1)


def campaign_of(made: Made, on_layer: bool = False, late: int = 0, declared: float = 1.0) -> StructureCampaign:
    """Records of a building declared as MASSES, STOREYS (times a factor) and LAYER."""
    random = np.random.default_rng(8)
    n, tests = made.masses.size, []
    for seed, (name, size) in enumerate(SIZES.items()):
        ground = base_motion(seed, size)
        values = np.roll(accelerations(made, ground), late, axis=0)  # it begins and ends at rest
        values += NOISE * values.std(axis=0) * random.standard_normal(values.shape)
        channels = tuple(Channel("acceleration", i) for i in range(n))
        use = "validate" if name == "other" else "fit"
        tests.append(StructureTest(name, STEP, ground, channels, values, use=use))
    stiffness = np.array([0.0, STOREYS[1]]) if on_layer else declared * STOREYS[:n]
    building = Building(MASSES[:n], stiffness, Damping("modal", RATIO), np.zeros(n), on_layer)
    law = Isolation("kelvin_voigt", LAYER, ("k", "c")) if on_layer else None
    return StructureCampaign("blind", building, law, True, tuple(tests), Path("none"))


def sizes(found: Calibration) -> dict[str, float]:
    """First parameter of each effect by its label."""
    return {one.label: next(iter(one.parameters.values())).value for one in found.effects}


def _left(found: Calibration, stage: Stage) -> float:
    """What a model leaves of the test for validation, rms."""
    return float(np.sqrt(found.errors[stage].validate))


@pytest.mark.parametrize("on_layer", [False, True], ids=["fixed", "isolated"])
def test_nothing_is_found_in_a_building_as_declared(on_layer: bool) -> None:
    found = calibrated(isolated() if on_layer else fixed(), on_layer)
    assert (found.verdict, found.effects) == ("none", ())
    # noise of 0.5 % is all that is left
    assert _left(found, "corrected") == pytest.approx(NOISE, rel=0.1)


@pytest.mark.parametrize(
    ("made", "label", "value", "key", "expected"),
    [
        (fixed(springs=STOREYS * [1.0, 1.4, 1.0]), "partitions.storey_2", 0.4, "storey_stiffness", [90.0, 112.0, 60.0]),
        # the storeys as declared: no key has the ground
        (on_soft_ground(), "flexible_base.sway", 1.0 / 2.5e8, "storey_stiffness", [90.0, 80.0, 60.0]),
        (fixed(masses=MASSES * [1.0, 1.0, 1.3]), "mass_error.floor_3", 0.3, "floor_masses", [100.0, 100.0, 104.0]),
        (damped_by_stiffness(), "damping.stiffness", 1.0, "damping", [3.0, 100.0]),
    ],
    ids=["partitions", "flexible_base", "mass_error", "damping"],
)
def test_what_a_building_hides(made: Made, label: str, value: float, key: str, expected: list[float]) -> None:
    campaign = campaign_of(made)
    found = calibrate(campaign, threads=1)
    assert found.verdict == "explained"
    # the damping of few cycles is less sure than frequencies are
    assert sizes(found) == {label: pytest.approx(value, rel=0.05)}
    assert _left(found, "corrected") == pytest.approx(NOISE, rel=0.1)
    text = corrected_texts(found, campaign)["structure.yaml"]
    block = yaml.safe_load(text)["structure"][key]
    reported = [block["ratio"], block["share"]] if key == "damping" else block
    assert [float(one.split()[0]) for one in reported] == pytest.approx(expected, rel=0.05)
    assert ("in no file: flexible_base.sway" in text) == (label == "flexible_base.sway")
    drawn = {name: faults(figure) for name, _, figure in calibration_figures(found)}
    assert drawn and not any(drawn.values()), drawn


def test_what_an_isolation_layer_hides() -> None:
    found = calibrated(isolated(strength=2e4), on_layer=True)
    assert sizes(found) == {"isolation_softening.bouc_wen": pytest.approx(2e4, rel=0.1)}
    # the linear layer alone cannot be right for small and large motions at once
    assert _left(found, "corrected") < 0.1 * _left(found, "refit")


def test_late_instruments() -> None:
    found = calibrated(fixed(MASSES[:2], STOREYS[:2]), late=2)
    assert sizes(found) == {"lag.delay": pytest.approx(2 * STEP, rel=0.02)}


def test_stiffness_declared_wrong_is_fitted() -> None:
    # base motion sees stiffness over mass: that all storeys are stiffer is no effect, but a parameter
    found = calibrated(fixed(), declared=0.8)
    assert found.effects == ()
    assert found.parameters["refit"]["storey_stiffness"].value == pytest.approx(1.25, rel=0.01)
