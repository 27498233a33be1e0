"""A blind study of buildings: records made by SciPy's integrator with something hidden, and what the loop says."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.linalg import eigh

from edesign.calibrate.result import Calibration
from edesign.calibrate.structure.building import Building
from edesign.calibrate.structure.campaign import Isolation, StructureCampaign
from edesign.calibrate.structure.damping import Damping
from edesign.calibrate.structure.record import Channel, StructureTest
from edesign.calibrate.structure.run import calibrate_structure

STEP, SAMPLES = 0.01, 1200
MASSES, STOREYS, RATIO = np.array([1e5, 1e5, 8e4]), np.array([9e7, 8e7, 6e7]), 0.03
LAYER = {"k": 3e6, "c": 2e5}  # under two floors: 0.6 Hz
NOISE = 0.005  # of the rms of each channel
SIZES = {"small": 0.3, "large": 1.5, "other": 0.8}  # m/s2; the last one is for validation
Force = Callable[[np.ndarray, np.ndarray, np.ndarray], np.ndarray]


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


def modal_damping(masses: np.ndarray, stiffness: np.ndarray, ratio: float) -> np.ndarray:
    """Clough and Penzien, Dynamics of Structures, 12.5: M (sum of 2 z w f f^T) M."""
    squares, shapes = eigh(stiffness, np.diag(masses))
    return np.asarray(np.diag(masses) @ shapes @ np.diag(2.0 * ratio * np.sqrt(squares)) @ shapes.T @ np.diag(masses))


def accelerations(masses: np.ndarray, force: Force, ground: np.ndarray, states: int = 0) -> np.ndarray:
    """Absolute accelerations (t, n) of floors held by force(q, v, z), with the rates of own states z at its end."""
    n, time = masses.size, STEP * np.arange(ground.size)

    def rate(t: float, y: np.ndarray) -> np.ndarray:
        found = force(y[:n], y[n : 2 * n], y[2 * n :])
        at = min(int(t / STEP), ground.size - 2)
        shaking = ground[at] + (t / STEP - at) * (ground[at + 1] - ground[at])
        return np.concatenate((y[n : 2 * n], -shaking - found[:n] / masses, found[n:]))

    start = np.zeros(2 * n + states)
    y = solve_ivp(rate, (0.0, time[-1]), start, t_eval=time, rtol=1e-6, atol=1e-9, max_step=STEP).y
    held = [force(y[:n, i], y[n : 2 * n, i], y[2 * n :, i])[:n] for i in range(time.size)]
    return np.asarray(-np.array(held) / masses)


def linear(masses: np.ndarray, stiffness: np.ndarray, damping: np.ndarray) -> tuple[np.ndarray, Force]:
    return masses, lambda q, v, z: stiffness @ q + damping @ v


def fixed(masses: np.ndarray = MASSES, springs: np.ndarray = STOREYS) -> tuple[np.ndarray, Force]:
    """A building on a fixed base with modal damping."""
    return linear(masses, chain(springs), modal_damping(masses, chain(springs), RATIO))


def on_soft_ground() -> tuple[np.ndarray, Force]:
    """Under the lowest storey stands a spring on the ground: both are one softer spring."""
    return fixed(springs=np.array([1.0 / (1.0 / STOREYS[0] + 1.0 / 2.5e8), *STOREYS[1:]]))


def damped_by_stiffness() -> tuple[np.ndarray, Force]:
    """Ratios in proportion to frequency, as declared in the first mode."""
    stiffness = chain(STOREYS)
    first = float(np.sqrt(eigh(stiffness, np.diag(MASSES), eigvals_only=True)[0]))
    return linear(MASSES, stiffness, 2.0 * RATIO / first * stiffness)


def isolated(strength: float = 0.0, yielding: float = 0.004) -> tuple[np.ndarray, Force, int]:
    """Two floors on a linear layer, with a Bouc-Wen force (Wen 1976, n = 1) beside it."""
    stiffness = chain(np.array([LAYER["k"], STOREYS[1]]))
    above = 2.0 * RATIO * np.sqrt(STOREYS[1] * MASSES[1])  # critical damping of the floor on the layer's, held
    damping = chain(np.array([LAYER["c"], above]))

    def force(q: np.ndarray, v: np.ndarray, z: np.ndarray) -> np.ndarray:
        held = stiffness @ q + damping @ v
        held[0] += strength * z[0]
        return np.append(held, (v[0] - 0.5 * abs(v[0]) * z[0] - 0.5 * v[0] * abs(z[0])) / yielding)

    return MASSES[:2], force, 1


def calibrated(made: tuple, on_layer: bool = False, late: int = 0, declared: float = 1.0) -> Calibration:  # type: ignore[type-arg]
    """What the loop says of a building declared as MASSES, STOREYS (times a factor) and LAYER."""
    masses, force, *states = made
    random = np.random.default_rng(8)
    tests = []
    for seed, (name, size) in enumerate(SIZES.items()):
        ground = base_motion(seed, size)
        values = accelerations(masses, force, ground, *states)
        values = np.roll(values, late, axis=0)  # it begins and ends at rest
        values += NOISE * values.std(axis=0) * random.standard_normal(values.shape)
        channels = tuple(Channel("acceleration", i) for i in range(masses.size))
        use = "validate" if name == "other" else "fit"
        tests.append(StructureTest(name, STEP, ground, channels, values, use=use))
    n = masses.size
    stiffness = np.array([0.0, STOREYS[1]]) if on_layer else declared * STOREYS[:n]
    building = Building(MASSES[:n], stiffness, Damping("modal", RATIO), np.zeros(n), on_layer)
    law = Isolation("kelvin_voigt", LAYER, ("k", "c")) if on_layer else None
    return calibrate_structure(StructureCampaign("blind", building, law, True, tuple(tests), Path("none")), workers=1)


@pytest.mark.parametrize("on_layer", [False, True], ids=["fixed", "isolated"])
def test_nothing_is_found_in_a_building_as_declared(on_layer: bool) -> None:
    found = calibrated(isolated() if on_layer else fixed(), on_layer)
    assert (found.verdict, found.effects) == ("none", ())
    # noise of 0.5 % is all that is left
    assert found.errors["corrected"].validate == pytest.approx(NOISE**2, rel=0.1)


@pytest.mark.parametrize(
    ("made", "label", "name", "value"),
    [
        pytest.param(fixed(springs=STOREYS * [1.0, 1.4, 1.0]), "partitions.storey_2", "r", 0.4, marks=pytest.mark.slow),
        (on_soft_ground(), "flexible_base.sway", "k", 2.5e8),
        (fixed(masses=MASSES * [1.0, 1.0, 1.3]), "mass_error.floor_3", "factor", 1.3),
        (damped_by_stiffness(), "damping.stiffness", "ratio", RATIO),
    ],
    ids=["partitions", "flexible_base", "mass_error", "damping"],
)
def test_what_a_building_hides(made: tuple, label: str, name: str, value: float) -> None:  # type: ignore[type-arg]
    found = calibrated(made)
    assert found.verdict == "explained"
    assert [f"{one.name}.{one.form}" for one in found.effects] == [label]
    # records without much noise: a hundredth; the damping of fewer cycles is less sure
    assert found.effects[0].parameters[name].value == pytest.approx(value, rel=0.05)


def test_what_an_isolation_layer_hides() -> None:
    found = calibrated(isolated(strength=2e4), on_layer=True)
    assert [f"{one.name}.{one.form}" for one in found.effects] == ["isolation_softening.bouc_wen"]
    assert found.verdict == "explained"
    assert found.effects[0].parameters["F"].value == pytest.approx(2e4, rel=0.1)
    # the linear layer alone cannot be right for small and large motions at once
    assert found.errors["corrected"].validate < 0.01 * found.errors["refit"].validate


@pytest.mark.slow  # a lag of a damper test is found by make test
def test_late_instruments() -> None:
    found = calibrated(fixed(MASSES[:2], STOREYS[:2]), late=2)
    assert [f"{one.name}.{one.form}" for one in found.effects] == ["lag.delay"]
    assert found.effects[0].parameters["lag"].value == pytest.approx(2 * STEP, rel=0.02)


def test_stiffness_declared_wrong_is_told_as_such() -> None:
    # base motion sees stiffness over mass: less mass, or more stiffness by partitions, are one and the same
    found = calibrated(fixed(), declared=0.8)
    assert found.errors["corrected"].validate == pytest.approx(NOISE**2, rel=0.1)
    assert found.errors["refit"].validate == pytest.approx(NOISE**2, rel=0.1)
    (effect,) = found.effects
    assert {effect.name, *effect.indistinguishable_from} >= {"partitions", "mass_error"}
