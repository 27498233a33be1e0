"""Decay of free vibrations: Rayleigh damping on three stiffnesses, modal damping mode by mode."""

from __future__ import annotations

import numpy as np
import pytest
from verification.structures import channel, oscillator, steel_portal
from verification.test_verify_modes import N, shear_building

from edesign.core import Bilinear, Newmark
from edesign.errors import InputError
from edesign.frame.damping import modal_ratios, modes_needed, proportional_factors
from edesign.project.analysis.damping import (
    CaugheyDamping,
    MassDamping,
    ModalDamping,
    RayleighDamping,
    StiffnessDamping,
)


def test_frequency_and_logarithmic_decrement() -> None:
    """exp(-zeta omega t) cos(omega_d t) of an oscillator; dt = T/500 leaves (omega dt)^2 / 12 = 1e-5 a radian."""
    k, mass = 5e6, 2e4
    omega, zeta = np.sqrt(k / mass), 0.04
    for a0, a1 in ((2 * zeta * omega, 0.0), (0.0, 2 * zeta / omega)):
        s = oscillator(k, mass)
        a = s.analysis(tolerance=1e-10)
        a.rayleigh(a0, a1)
        a.initial_velocity([0.1])
        dt = 2 * np.pi / omega / 500
        r = a.history(np.zeros(2501), dt, channels=[channel("displacement", s.nodes[1], 0, "u")])
        wd = omega * np.sqrt(1 - zeta**2)
        exact = 0.1 / wd * np.exp(-zeta * omega * r.time) * np.sin(wd * r.time)
        np.testing.assert_allclose(r.values["u"], exact, atol=5e-4 * 0.1 / wd)  # 31 rad x 1e-5


@pytest.mark.parametrize("geometry", ["linear", "p_delta"])
def test_rayleigh_stiffnesses_agree_while_elastic(geometry: str) -> None:
    """Initial, committed and current stiffness are one matrix for an elastic structure without gravity: to the
    tolerance."""
    t = np.arange(300) * 0.01
    ground = 0.5 * np.sin(9.0 * t)
    found = []
    for kind in ("initial", "committed", "current"):
        s = steel_portal(geometry, Bilinear(2.1e11, 1e12))
        a = s.analysis(tolerance=1e-11)
        a.rayleigh(0.4, 2e-3, kind)
        r = a.history(ground, 0.01, channels=[channel("displacement", s.nodes[2], 0, "u")])
        assert r.status == "completed", r.reason
        found.append(r.values["u"])
    scale = np.abs(found[0]).max()
    # P-Delta: the tangent changes with the small axial forces of sway: 1e-4 of EI terms
    tolerance = 1e-9 if geometry == "linear" else 1e-4
    np.testing.assert_allclose(found[1], found[0], atol=tolerance * scale)
    np.testing.assert_allclose(found[2], found[0], atol=tolerance * scale)


@pytest.mark.parametrize("mode", range(3))
def test_modal_damping_acts_on_its_mode(mode: int) -> None:
    """A shear building let go in one mode stays in it and decays with the ratio of that mode."""
    ratios = np.array([0.02, 0.05, 0.10])
    s = shear_building()
    a = s.analysis(tolerance=1e-10)
    modes = a.modes(3)
    a.modal_damping(modes, ratios)
    omega, zeta = modes.omega[mode], ratios[mode]
    a.initial_velocity(modes.equations[mode])
    dt = 2 * np.pi / omega / 400
    r = a.history(np.zeros(1201), dt, Newmark(), [channel("displacement", n, 0, str(n)) for n in s.nodes[1:]])
    u = np.array([r.values[str(n)] for n in s.nodes[1:]])
    wd = omega * np.sqrt(1 - zeta**2)
    q = np.exp(-zeta * omega * r.time) * np.sin(wd * r.time) / wd
    expected = np.outer(modes.shapes[mode, 1:, 0], q)
    # 19 rad, an error of (2 pi / 400)^2 / 12 = 2e-5 each
    np.testing.assert_allclose(u, expected, atol=1e-3 * np.abs(expected).max())


def test_modes_without_a_ratio_are_undamped() -> None:
    """Damping in modes 1 to 3 leaves mode 5 its energy (average acceleration keeps it; 400 steps)."""
    s = shear_building()
    a = s.analysis(tolerance=1e-11)
    modes = a.modes(N)
    three = a.modes(3)
    a.modal_damping(three, 0.1)
    a.initial_velocity(modes.equations[4])
    r = a.history(np.zeros(401), 0.005)
    total = r.energy["kinetic"] + r.energy["elastic"]
    np.testing.assert_allclose(total, 0.5, rtol=1e-7)
    assert abs(r.energy["damping"][-1]) < 1e-7


def test_rayleigh_ratios_of_a_shear_building() -> None:
    """zeta = a0 / 2 omega + a1 omega / 2 in every mode (Chopra 2012, Eq. 11.4.8), read off the decay of the
    amplitude."""
    s = shear_building()
    modes = s.analysis().modes(3)
    w1, w2 = modes.omega[0], modes.omega[2]
    a0, a1 = 2 * 0.03 * w1 * w2 / (w1 + w2), 2 * 0.03 / (w1 + w2)
    for k in range(3):
        a = shear_building().analysis(tolerance=1e-11)
        a.rayleigh(a0, a1)
        a.initial_velocity(modes.equations[k])
        omega = modes.omega[k]
        zeta = a0 / (2 * omega) + a1 * omega / 2
        r = a.history(np.zeros(1601), 2 * np.pi / omega / 400)
        energy = r.energy["kinetic"] + r.energy["elastic"]
        # whole periods apart (undamped ones: the shift to damped ones is zeta^2 / 2)
        assert energy[1600] / energy[0] == pytest.approx(np.exp(-2 * zeta * omega * r.time[1600]), rel=3e-3)


def decays(damping: ModalDamping | CaugheyDamping | RayleighDamping | MassDamping | StiffnessDamping) -> np.ndarray:
    """Ratios (N,) of the modes of a shear building as its free vibration in each of them shows."""
    found = []
    for k in range(N):
        a = shear_building().analysis(tolerance=1e-11)
        modes = a.modes(N)
        if isinstance(damping, (ModalDamping, CaugheyDamping)):
            damped = a.modes(modes_needed(damping, N))
            a.modal_damping(damped, modal_ratios(damping, damped.omega))
        else:
            a.rayleigh(*proportional_factors(damping, modes.omega), "initial")
        a.initial_velocity(modes.equations[k])
        cycles = 2  # whole ones, in which Newmark's average acceleration damps by (omega dt)^2 / 12 too little
        r = a.history(np.zeros(400 * cycles + 1), 2 * np.pi / modes.omega[k] / 400)
        energy = r.energy["kinetic"] + r.energy["elastic"]
        zeta = -np.log(energy[-1] / energy[0]) / (4 * np.pi * cycles)
        found.append(zeta * (1.0 + 0.5 * zeta**2))  # whole undamped periods are not whole damped ones
    return np.array(found)


def test_ratios_mode_by_mode() -> None:
    given = (0.01, 0.03, 0.0, 0.08)
    found = decays(ModalDamping(kind="modal", ratio=given))
    np.testing.assert_allclose(found, [*given, *[0.0] * (N - 4)], atol=1e-3 * 0.08)


def test_proportional_to_mass_or_stiffness_alone() -> None:
    """The ratio is proportional to the period, or to the frequency; 0.1 %: whole undamped periods, (omega dt)^2."""
    omega = shear_building().analysis().modes(N).omega
    found = decays(MassDamping(kind="mass_proportional", ratio=0.05))
    np.testing.assert_allclose(found, 0.05 * omega[0] / omega, rtol=3e-3)
    given = {"kind": "stiffness_proportional", "ratio": 0.02, "period": f"{2 * np.pi / omega[1]:.15g} s"}
    found = decays(StiffnessDamping.model_validate(given))
    np.testing.assert_allclose(found, 0.02 * omega / omega[1], rtol=3e-3)


def test_rayleigh_at_periods_is_rayleigh_in_their_modes() -> None:
    omega = shear_building().analysis().modes(N).omega
    periods = [f"{2 * np.pi / omega[k]:.15g} s" for k in (0, 2)]
    given = RayleighDamping.model_validate({"kind": "rayleigh", "ratio": 0.03, "periods": tuple(periods)})
    at = proportional_factors(given, np.empty(0))
    named = proportional_factors(RayleighDamping(kind="rayleigh", ratio=0.03, modes=(1, 3)), omega)
    assert at == pytest.approx(named, rel=1e-13)


@pytest.mark.parametrize("modes", [(1, 2), (1, 3, 4), (1, 2, 3, 5)])
def test_caughey_damping_is_its_matrix(modes: tuple[int, ...]) -> None:
    """Complex eigenvalues of M u'' + C u' + K u with C = M sum a_b (M^-1 K)^b (Chopra, Eq. 11.4.13), made here.

    The a_b are those of the ratios at the frequencies of the modes (Eq. 11.4.15); 0.1 % for steps and whole periods.
    """
    a = shear_building().analysis()
    mass, omega = np.diag(a.masses()), a.modes(N).omega
    stiffness = a.stiffness().toarray()
    heavy = np.flatnonzero(np.diag(mass) > 0.0)
    light = np.flatnonzero(np.diag(mass) == 0.0)
    inverse = np.linalg.inv(mass[np.ix_(heavy, heavy)])
    k = stiffness[np.ix_(heavy, heavy)]
    if light.size:
        k = k - stiffness[np.ix_(heavy, light)] @ np.linalg.solve(
            stiffness[np.ix_(light, light)], stiffness[np.ix_(light, heavy)]
        )
    ratios = np.linspace(0.03, 0.05, len(modes))
    anchors = omega[np.array(modes) - 1]
    series = np.linalg.solve(anchors[:, None] ** (2.0 * np.arange(len(modes)) - 1.0) / 2.0, ratios)
    power, damped = np.eye(heavy.size), np.zeros((heavy.size, heavy.size))
    for coefficient in series:
        damped += coefficient * power
        power = power @ inverse @ k
    n = heavy.size
    system = np.block([[np.zeros((n, n)), np.eye(n)], [-inverse @ k, -damped]])
    values = np.linalg.eigvals(system)
    values = values[values.imag > 0.0]
    values = values[np.argsort(np.abs(values))]
    np.testing.assert_allclose(np.abs(values), omega, rtol=1e-8)
    found = decays(CaugheyDamping(kind="caughey", ratio=tuple(ratios), modes=modes))
    np.testing.assert_allclose(found, -values.real / np.abs(values), rtol=2e-3)


def test_a_series_that_feeds_in_energy_is_refused() -> None:
    omega = shear_building().analysis().modes(N).omega
    with pytest.raises(InputError, match=r"mode 8 \(T = .* s\) a ratio of -.* %.*even number of terms"):
        modal_ratios(CaugheyDamping(kind="caughey", ratio=(0.02, 0.05, 0.02), modes=(1, 2, 3)), omega)
