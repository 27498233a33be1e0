"""Histories of the cases against modal superposition, equilibrium with inertia, energy, and another program."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
import scipy.linalg

from edesign import summarise
from edesign.archive.dataset import Group

Results = Callable[[str, str], Group]
G = 9.80665  # m/s2


def oscillator(omega: float, ratio: float, ground: np.ndarray, step: float) -> np.ndarray:
    """Displacement (n,) of a damped oscillator, exact for a ground acceleration that is linear between its samples."""
    # state: displacement, velocity, load, rate of the load; the load is -ground
    system = np.zeros((4, 4))
    system[0, 1], system[1, 2], system[2, 3] = 1.0, 1.0, 1.0
    system[1, 0], system[1, 1] = -(omega**2), -2 * ratio * omega
    over_step = scipy.linalg.expm(system * step)[:2]
    found, state = np.zeros(ground.size), np.zeros(2)
    for i in range(1, ground.size):
        rate = -(ground[i] - ground[i - 1]) / step
        state = over_step @ np.array([state[0], state[1], -ground[i - 1], rate])
        found[i] = state[0]
    return found


def test_elastic_history_is_the_sum_of_its_modes(results_of: Results) -> None:
    """Five modes with 5 % each are all that the five rigid floors have."""
    modes, shaken = results_of("diaphragm_modal_hht", "modes"), results_of("diaphragm_modal_hht", "shake")
    frequency = modes.variables["circular_frequency"].values
    factor = modes.variables["participation_factor_x"].values
    shape = modes.variables["floor_shape"].values  # (mode, floor), of the state under gravity
    ratio = modes.variables["effective_mass_ratio_x"].values
    assert ratio.sum() == pytest.approx(1.0, rel=1e-9)
    mass = float(
        modes.attributes["mass_kg"]
    )  # (20 + 0.24 * 15) kN/m on four floors of 18 m, (14 + 0.24 * 5) on the roof
    assert mass == pytest.approx(18.0 * (4 * 23.6e3 + 15.2e3) / G, rel=1e-12)

    path = Path(__file__).parent / "records" / "motion.csv"
    time, given = np.loadtxt(path, delimiter=",", skiprows=1, unpack=True)
    every = np.arange(0.0, time[-1] + 3.0 + 1e-9, 0.005)
    ground = np.interp(every, time, given, right=0.0)
    ground[every > time[-1]] = 0.0
    deflection = np.array([oscillator(w, 0.05, ground, 0.005) for w in frequency])
    roof = (factor * shape[:, -1]) @ deflection
    base = -(ratio * mass * frequency**2) @ -deflection
    kept = shaken.coords["time"].values
    assert kept[1] == pytest.approx(0.01)  # every second step
    # 1 % of the peaks: alpha = -0.05 delays and damps, most in the higher modes, which add to the base shear
    found = shaken.variables["floor_displacement"].values[:, -1]
    assert np.abs(found - roof[::2]).max() < 0.01 * np.abs(roof).max()
    shear = shaken.variables["base_shear"].values
    assert np.abs(shear - base[::2]).max() < 0.02 * np.abs(base).max()
    assert np.abs(roof).max() > 0.1


def test_caughey_damping_is_a_series_in_the_modes(results_of: Results) -> None:
    """zeta = sum a_b omega^(2b - 1) / 2 (Chopra, Eq. 11.4.15) through modes 1, 2, 3 and 5; sum of exact modes."""
    modes, shaken = results_of("caughey_damping", "modes"), results_of("caughey_damping", "shake")
    frequency = modes.variables["circular_frequency"].values
    powers = frequency[:, None] ** np.array([-1.0, 1.0, 3.0, 5.0]) / 2.0
    named = [0, 1, 2, 4]
    ratios = powers @ np.linalg.solve(powers[named], [0.03, 0.04, 0.05, 0.06])
    assert ratios[named] == pytest.approx([0.03, 0.04, 0.05, 0.06], rel=1e-6)
    assert 0.05 < ratios[3] < 0.08
    path = Path(__file__).parent / "records" / "motion.csv"
    time, given = np.loadtxt(path, delimiter=",", skiprows=1, unpack=True)
    every = np.arange(0.0, time[-1] + 1.0 + 1e-9, 0.005)
    ground = np.interp(every, time, given, right=0.0)
    ground[every > time[-1]] = 0.0
    deflection = np.array([oscillator(w, z, ground, 0.005) for w, z in zip(frequency, ratios, strict=True)])
    factor, shape = modes.variables["participation_factor_x"].values, modes.variables["floor_shape"].values
    floors = (factor[:, None] * shape).T @ deflection
    found = shaken.variables["floor_displacement"].values.T
    # Newmark lengthens periods by (omega dt)^2 / 12, after the cycles of the motion 0.3 % of the peak of a floor; a
    # hundredth more of the ratio of mode 1 alone would change it by as much
    for floor, exact in zip(found, floors, strict=True):
        assert np.abs(floor - exact).max() < 5e-3 * np.abs(exact).max()


def test_vertical_motion_shakes_the_posts_axially(results_of: Results) -> None:
    """Axial force k u of the exact oscillator of frequency sqrt(E A / h / m) under the vertical motion, twice."""
    stiffness, mass = 210e9 * 10e-4 / 4.0, 50e3
    modes = results_of("vertical_motion", "modes").variables["circular_frequency"].values
    assert np.sqrt(stiffness / mass) == pytest.approx(modes[1:], rel=1e-9)
    path = Path(__file__).parent / "records" / "motion.csv"
    time, given = np.loadtxt(path, delimiter=",", skiprows=1, unpack=True)
    every = np.arange(0.0, time[-1] + 1e-9, 0.001)
    peak = np.abs(given).max()
    early = np.interp(every, time[time <= 4.0 + 1e-9], given[(time >= 1.0 - 1e-9) & (time <= 5.0 + 1e-9)], right=0.0)
    early[every > 4.0 + 1e-9] = 0.0
    motions = {
        "ratio": (0.9 * 0.2 * G / peak * np.interp(every, time, given), 0.0),
        "other": (0.1 * G / np.abs(early).max() * early, 0.5),
    }
    for name, (upwards, after) in motions.items():
        group = results_of("vertical_motion", name)
        upwards = np.concatenate((upwards, np.zeros(round(after / 0.001))))
        kept = group.variables["ground_acceleration_vertical"].values
        np.testing.assert_allclose(kept, upwards[::5], atol=1e-9)
        force = stiffness * oscillator(float(modes[1]), 0.05, upwards, 0.001)[::5]
        axial = group.variables["member_axial_force"].values  # (time, member, end): at the end positive in tension
        # Newmark lengthens the period by (omega dt)^2 / 12, 1e-4: 2 % of a peak after 200 rad, less with damping
        for post in (0, 1):
            assert np.abs(axial[:, post, 1] - force).max() < 0.005 * np.abs(force).max()
        assert group.attributes["vertical_pga_m_s2"] == pytest.approx(np.abs(upwards).max(), rel=1e-9)
        shear = group.variables["floor_displacement"].values
        assert np.abs(shear).max() > 1e-3  # the horizontal motion is there as well


def test_a_divided_beam_vibrates_under_vertical_motion(results_of: Results) -> None:
    """Moment in the middle of a beam on hinges: w L^2/8, and what its modes add as exactly integrated oscillators.

    The flexibility of three masses at the quarter points is that of a simple beam, x b (L^2 - b^2 - x^2) / (6 E I L)
    for x <= a, b = L - a. The first frequency is that of the continuous beam, pi^2 sqrt(E I / (m L^4)), but for 0.05 %:
    with one mass it is sqrt(96/pi^4), 0.7 %, and that of lumped masses falls with the fourth power of their spacing.
    """
    length, bending, load = 8.0, 210e9 * 2e-4, 20e3
    at = length * np.array([0.25, 0.5, 0.75])
    low, high = np.minimum.outer(at, at), np.maximum.outer(at, at)
    away = length - high
    flexibility = low * away * (length**2 - away**2 - low**2) / (6.0 * bending * length)
    mass = load * length / 4.0 / G
    values, shapes = np.linalg.eigh(np.linalg.inv(flexibility) / mass)
    omega = np.sqrt(values)
    found = results_of("divided_beam", "modes").variables["circular_frequency"].values
    # the posts are not rigid: 5e10 N/m each, against 4e6 N/m of the beam
    assert found[1:4] == pytest.approx(omega, rel=1e-3)
    continuous = np.pi**2 * np.sqrt(bending / (load / G * length**4))
    assert omega[0] == pytest.approx(continuous, rel=2.0**-4 * (1.0 - np.sqrt(96.0 / np.pi**4)))

    path = Path(__file__).parent / "records" / "motion.csv"
    time, given = np.loadtxt(path, delimiter=",", skiprows=1, unpack=True)
    upwards = 0.9 * 0.2 * G / np.abs(given).max() * np.interp(np.arange(0.0, time[-1] + 1e-9, 0.001), time, given)
    modal = np.array([oscillator(w, 0.05, upwards, 0.001) for w in omega]) * shapes.sum(axis=0)[:, None]
    forces = -np.linalg.inv(flexibility) @ (shapes @ modal)  # of the masses on the beam, downwards
    dynamic = (np.minimum(at, length - at) / 2.0 @ forces)[::5]  # influence line of the moment in the middle
    static = load * length**2 / 8.0
    assert np.abs(dynamic).max() > 0.2 * static
    for name, sign in (("up", 1.0), ("down", -1.0), ("reversed", -1.0)):
        group = results_of("divided_beam", name)
        moment = group.variables["member_bending_moment"].values  # (time, member, end)
        # Newmark lengthens periods by (omega dt)^2 / 12, 4e-5 of the first, and the posts by 3e-5
        assert np.abs(moment[:, 0, 1] - static - sign * dynamic).max() < 2e-3 * np.abs(dynamic).max()
        assert np.abs(moment[:, 1]).max() < 1e-6 * static  # the ends of the beam on hinges that is not divided
        assert group.attributes["beams_without_vertical_motion"] == ["B_5_1"]
    sway = {
        name: results_of("divided_beam", name).variables["floor_displacement"].values for name in ("up", "reversed")
    }
    assert np.abs(sway["up"] + sway["reversed"]).max() < 1e-9


def test_without_damping_the_base_shear_balances_the_inertia_of_the_roof(results_of: Results) -> None:
    """One rigid floor: m a + V = -m ag, weighted between the ends of each step as generalised-alpha does."""
    group = results_of("plates_menegotto_pinto", "shake")
    mass = 2 * 300e3 / G
    acceleration, shear = group.variables["floor_acceleration"].values[:, 0], group.variables["base_shear"].values
    # rho = 0.9: alpha_m = 8/19, alpha_f = 9/19 (Chung & Hulbert 1993); index n+1-alpha is (1-alpha) new + alpha old
    am, af = 8 / 19, 9 / 19
    ground = group.variables["ground_acceleration"].values
    relative = acceleration - ground
    inertia = mass * ((1 - am) * relative[1:] + am * relative[:-1])
    load = -mass * ((1 - af) * ground[1:] + af * ground[:-1])
    resisting = (1 - af) * shear[1:] + af * shear[:-1]
    residual = inertia + resisting - load
    assert np.abs(residual).max() < 1e-5 * np.abs(shear).max()


def test_work_of_the_ground_is_found_again_in_the_balance(results_of: Results) -> None:
    """Input energy from the motion of the floor: the integral of -m ag du, by the trapezoidal rule."""
    group = results_of("plates_menegotto_pinto", "shake")
    terms = list(group.coords["energy_term"].values)
    energy = dict(zip(terms, group.variables["energy"].values.T, strict=True))
    ground = group.variables["ground_acceleration"].values
    step = np.diff(group.variables["floor_displacement"].values[:, 0])
    work = -2 * 300e3 / G * np.concatenate([[0.0], np.cumsum(0.5 * (ground[1:] + ground[:-1]) * step)])
    largest = np.abs(work).max()
    assert np.abs(energy["input"] - work).max() < 1e-3 * largest
    rest = energy["input"] - sum(energy[term] for term in terms if term not in ("input", "residual"))
    assert np.abs(rest).max() < 0.01 * largest  # the numerical damping of the integrator, and the error of the step
    assert energy["hysteretic"][-1] > 0.3 * largest  # the beam did yield
    assert np.all(energy["damping"] == 0.0)


def test_gravity_of_the_ten_storeys_is_carried_to_the_ground(results_of: Results) -> None:
    group = results_of("thesis_4_bays", "gravity")
    assert group.variables["reaction_y_final"].values.sum() == pytest.approx(10 * 28.8 * (23e3 + 0.3 * 9.6e3), rel=1e-8)
    assert results_of("thesis_4_bays", "modes_bare").attributes["mass_kg"] == pytest.approx(10 * 127.2e3, rel=1e-12)


# Known values: OpenSees, force-based fibre elements of 24 layers and 5 points, P-Delta columns, Rayleigh damping on the
# current stiffness, time step 0.01 s.
OPENSEES_PERIODS = {"modes_bare": 2.7486, "modes_loaded": 2.8150}  # s
OPENSEES_PEAKS = {  # roof displacement m, base shear N, largest storey drift, total acceleration of the roof m/s2
    "as_recorded": (0.3401, 1322.7e3, 0.0138, 3.89),
    "at_0.414_g": (0.3711, 1443.3e3, 0.0184, 4.59),
}


@pytest.mark.parametrize(("analysis", "period"), OPENSEES_PERIODS.items())
def test_periods_of_the_ten_storeys_are_those_of_opensees(results_of: Results, analysis: str, period: float) -> None:
    found = results_of("thesis_4_bays", analysis).variables["period"].values[0]
    assert found == pytest.approx(period, abs=1e-4)  # the last digit of the known value and half of it


@pytest.mark.parametrize(("analysis", "peaks"), OPENSEES_PEAKS.items())
def test_peaks_of_the_ten_storeys_are_those_of_opensees(
    archive_of: Callable[[str], Path], analysis: str, peaks: tuple[float, float, float, float]
) -> None:
    (item,) = summarise(archive_of("thesis_4_bays"), analysis)["analyses"]
    found = item["measures"]
    assert found["roof_displacement_m"] == pytest.approx(peaks[0], rel=3e-3)
    assert found["base_shear_N"] == pytest.approx(peaks[1], rel=3e-3)
    # known to three digits: 0.3 %, and half of the last digit
    assert found["interstorey_drift"] == pytest.approx(peaks[2], abs=3e-3 * peaks[2] + 0.5e-4)
    assert found["roof_acceleration_m_s2"] == pytest.approx(peaks[3], abs=3e-3 * peaks[3] + 0.5e-2)
