"""Energy balance: input = kinetic + damping + stored + hysteretic + second-order + residual."""

from __future__ import annotations

import numpy as np
import pytest
from verification.structures import FY, E, Structure, steel_portal

from edesign.core import HHT, Bilinear, Integrator, MenegottoPinto, Newmark, Response, Steel


def motion(dt: float, amplitude: float) -> np.ndarray:
    t = np.arange(0.0, 6.0 + dt / 2, dt)
    return amplitude * np.sin(np.pi * t / 6.0) * (np.sin(8.0 * t) + 0.5 * np.sin(19.0 * t))


def shaken(
    law: Steel,
    dt: float,
    amplitude: float,
    kind: str = "current",
    method: Integrator | None = None,
    geometry: str = "p_delta",
) -> Response:
    s: Structure = steel_portal(geometry, law)
    m = s.model
    for node in s.nodes[2:]:
        m.nodal_load(s.pattern, node, fy=-200e3)
    m.uniform_load(s.pattern, s.elements[2], transverse=-15e3)
    a = s.analysis(tolerance=1e-9)
    assert a.static(s.pattern, steps=2).status == "completed"
    a.rayleigh(0.3, 1e-3, kind)
    r = a.history(motion(dt, amplitude), dt, method or Newmark())
    assert r.status == "completed", r.reason
    return r


def closes(r: Response) -> None:
    """The residual is what the terms leave: an identity of the recorded numbers."""
    e = r.energy
    rest = e["input"] - e["kinetic"] - e["damping"] - e["elastic"] - e["hysteretic"] - e["p_delta"]
    np.testing.assert_allclose(rest, e["residual"], atol=1e-9 * np.abs(e["input"]).max())
    assert np.all(e["kinetic"] >= 0.0)
    assert np.all(e["elastic"] >= 0.0)


def test_elastic_balance_is_exact() -> None:
    """Average acceleration: the trapezoidal works balance exactly when all is linear; what remains is the equilibrium
    tolerance (1e-9) over 600 steps."""
    r = shaken(Bilinear(E, 1e3 * FY), 0.01, 1.0, "initial", geometry="linear")
    closes(r)
    assert np.abs(r.energy["residual"]).max() < 1e-7 * np.abs(r.energy["input"]).max()
    assert np.all(r.energy["hysteretic"] == 0.0)
    assert np.all(np.diff(r.energy["damping"]) > -1e-6 * r.energy["damping"][-1])


@pytest.mark.parametrize(
    "law",
    [Bilinear(E, FY, 0.0), Bilinear(E, FY, 0.02), MenegottoPinto(E, FY, 0.02)],
    ids=["perfect", "hardening", "curved"],
)
def test_yielding_balance(law: Steel) -> None:
    """Works of yielding elements by the trapezoidal rule: within 0.5 % of the input at dt = 0.01 s, and falling
    with dt."""
    shares = []
    for dt in (0.01, 0.0025):
        r = shaken(law, dt, 9.0)
        closes(r)
        e = r.energy
        assert e["hysteretic"][-1] > 0.2 * e["input"][-1]  # it yields
        if isinstance(law, Bilinear) and law.b == 0.0:
            assert np.all(np.diff(e["hysteretic"]) >= 0.0)
        missing, given = e["residual"] - e["residual"][0], e["input"] - e["input"][0]
        shares.append(np.abs(missing).max() / np.abs(given).max())
        assert r.statistics["energy_error"] == pytest.approx(shares[-1], rel=1e-12)
    assert shares[0] < 5e-3, shares
    assert shares[1] < max(0.5 * shares[0], 1e-8), (
        shares
    )  # Menegotto-Pinto counts its loss as the work not stored: no residual


def test_damping_never_gives_energy() -> None:
    """Rayleigh on the initial stiffness: a positive semidefinite matrix, so that the work only grows (averages of
    two ends of a step may take 1e-3 of it back)."""
    e = shaken(Bilinear(E, FY), 0.005, 9.0, "initial").energy["damping"]
    assert np.all(np.diff(e) > -1e-3 * e[-1])
    assert e[-1] > 0.0


def test_numerical_damping_shows_in_the_residual() -> None:
    """HHT takes energy that no element took: the residual is positive and larger than with the average acceleration."""
    law = Bilinear(E, 1e3 * FY)
    plain = shaken(law, 0.02, 1.0, "initial", geometry="linear").energy["residual"]
    numerical = shaken(law, 0.02, 1.0, "initial", HHT(-0.3), "linear").energy["residual"]
    assert np.abs(numerical).max() > 100 * np.abs(plain).max()


def test_static_work() -> None:
    """Load control to F on a linear structure: input = F u / 2 = stored, member loads included (1e-9)."""
    s = steel_portal("linear", Bilinear(E, 1e3 * FY))
    s.model.nodal_load(s.pattern, s.nodes[2], fx=50e3, fy=-80e3)
    s.model.uniform_load(s.pattern, s.elements[2], transverse=-20e3)
    r = s.analysis(tolerance=1e-11).static(s.pattern, steps=7)
    e = r.energy
    assert e["elastic"][-1] > 0.0
    np.testing.assert_allclose(e["input"], e["elastic"], rtol=1e-8, atol=1e-9 * e["input"][-1])
    np.testing.assert_allclose(e["input"], e["input"][-1] * np.linspace(0, 1, 8) ** 2, rtol=1e-8)


def test_p_delta_work() -> None:
    """A linear P-Delta column: work of H is stored energy plus second-order work, which is negative under
    compression (1e-7)."""
    s = steel_portal("p_delta", Bilinear(E, 1e3 * FY))
    for node in s.nodes[2:]:
        s.model.nodal_load(s.pattern, node, fy=-1e6)
    lateral = s.model.pattern()
    s.model.nodal_load(lateral, s.nodes[2], fx=60e3)
    a = s.analysis(tolerance=1e-11)
    assert a.static(s.pattern).status == "completed"
    r = a.static(lateral, steps=50)
    assert r.energy["p_delta"][-1] < 0.0
    # gravity does no work over the drift in the linearised theory, so that the balance closes step by step
    assert np.abs(r.energy["residual"]).max() < 1e-5 * r.energy["input"][-1]
