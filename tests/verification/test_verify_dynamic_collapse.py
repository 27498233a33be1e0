"""Collapse of a column under gravity that is set in motion: it falls if its energy takes it beyond the last balance.

A cantilever of two fibres yields sharply: its base moment is H L + P u up to Mp and no further, so that the force that
holds it is F = k u up to uy = Mp / (3 E I / L^2) and falls as (Mp - P u) / L beyond, to nothing at u* = Mp / P. A mass
with the velocity v comes back if m v^2 / 2 is less than the work to u*, and falls otherwise. (Work and energy only: no
integration; P-Delta as in the core, u / L small.)
"""

from __future__ import annotations

import math

import numpy as np
import pytest
from verification.structures import FY, E, Structure, channel

from edesign.core import Analysis, Bilinear, Channel, CoreError, Model, Response

L, MASS, AREA, ARM = 4.0, 20e3, 8e-3, 0.15  # m, kg, m2, m from the axis to each fibre
P = 300e3
MP = (FY - P / AREA) * AREA * ARM  # the fibre in compression yields, and statics leave the other no more stress
BENDING = 3.0 * E * AREA * ARM**2 / L**3  # N/m, of the column without P
U_YIELD, U_FALL = MP / (BENDING * L), MP / P
WORK = 0.5 * (BENDING - P / L) * U_YIELD**2 + 0.5 * (MP - P * U_YIELD) / L * (U_FALL - U_YIELD)
VELOCITY = math.sqrt(2.0 * WORK / MASS)
DT = 0.002
DRIFT = "drift"


def column() -> tuple[Analysis, int]:
    m = Model()
    section = m.fibre_section(np.array([-ARM, ARM]), np.array([0.5, 0.5]) * AREA, m.material(Bilinear(E, FY)))
    base, top = m.node("base", 0.0, 0.0), m.node("top", 0.0, L)
    m.fix(base, True, True, True)
    element = m.beam_column("column", base, top, section, points=5, geometry="p_delta")
    m.mass(top, MASS, 0.0)
    gravity = m.pattern()
    m.nodal_load(gravity, top, fy=-P)
    analysis = Structure(m, [base, top], [element], gravity).analysis(tolerance=1e-9)
    assert analysis.static(gravity, steps=2).status == "completed"
    return analysis, top


def thrown(share: float, limit: float | None, seconds: float = 8.0) -> Response:
    """The column with a share of the velocity at which it falls."""
    analysis, top = column()
    velocity = np.zeros(analysis.n_equations)
    velocity[analysis.equations[top, 0]] = share * VELOCITY
    analysis.initial_velocity(velocity)
    drift = Channel(DRIFT, ((1.0 / L, "displacement", top, 0),))
    still = np.zeros(int(seconds / DT) + 1)
    limits = {} if limit is None else {DRIFT: limit}
    return analysis.history(still, DT, channels=[drift, channel("velocity", top, 0, "v")], limits=limits)


def test_below_the_barrier_it_comes_back() -> None:
    """2 % less velocity: it yields, turns before u* where F = 0, and the limit at u* is never met."""
    response = thrown(0.98, U_FALL / L)
    assert response.status == "completed", response.reason
    turned = L * response.maximum[DRIFT]
    # what is left of the barrier, 1 - 0.98^2 of the work, is F's triangle down from the turning point
    left = (1.0 - 0.98**2) * WORK
    assert turned == pytest.approx(U_FALL - math.sqrt(2.0 * left * L / P), rel=2e-3)  # steps of 2 ms
    assert 5.0 * U_YIELD < turned < U_FALL
    assert response.values["v"].min() < 0.0


def test_above_the_barrier_it_falls() -> None:
    """2 % more velocity: it passes u* with what energy is left, and the run ends in the first step beyond the limit."""
    limit = 1.5 * U_FALL / L
    response = thrown(1.02, limit)
    assert response.status == "limit"
    assert response.passed is not None and response.passed.channel == DRIFT
    assert response.reason.startswith(f"{DRIFT} reached 0.") and f"at {response.passed.time:.6g} s" in response.reason
    drift = response.values[DRIFT]
    assert drift[-1] > limit and drift[:-1].max() <= limit
    assert response.passed.value == drift[-1] == response.final[DRIFT]
    assert response.passed.time == response.time[-1] == pytest.approx(DT * (response.time.size - 1), rel=1e-9)
    # energy at u: m v^2 / 2 = 1.02^2 work - (work to u* - P (u - u*)^2 / (2 L)); the force drives it on beyond u*
    beyond = L * drift[-1] - U_FALL
    energy = (1.02**2 - 1.0) * WORK + 0.5 * P / L * beyond**2
    assert response.values["v"][-1] == pytest.approx(math.sqrt(2.0 * energy / MASS), rel=2e-3)


def test_a_limit_changes_nothing_before_it() -> None:
    """Bit for bit the run without a limit, to where it ends; statistics count the steps made."""
    free, watched = thrown(1.02, None, seconds=2.0), thrown(1.02, 0.5 * U_FALL / L, seconds=2.0)
    n = watched.time.size
    assert watched.status == "limit" and 10 < n < free.time.size
    assert np.array_equal(watched.values[DRIFT], free.values[DRIFT][:n])
    assert np.array_equal(watched.energy["kinetic"], free.energy["kinetic"][:n])
    assert watched.statistics["steps"] == n - 1


def test_limits_that_make_no_sense() -> None:
    analysis, top = column()
    still = np.zeros(3)
    with pytest.raises(ValueError, match="not recorded: roof"):
        analysis.history(still, DT, channels=[channel("displacement", top, 0, "u")], limits={"roof": 0.1})
    with pytest.raises(CoreError, match="not positive"):
        analysis.history(still, DT, channels=[channel("displacement", top, 0, "u")], limits={"u": -0.1})
    assert analysis.history(still, DT).status == "completed"
