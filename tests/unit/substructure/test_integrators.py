"""Integrators of the numerical part: poles, limits, order of convergence, and a spring in place of the specimen.

Expected figures come from an independent prototype (Python, single degree of freedom) and from closed forms. Where no
other reason is given, a tolerance is some hundred rounding errors.
"""

from __future__ import annotations

import cmath
import math

import numpy as np
import pytest
import scipy
from messages import says

from edesign.errors import InputError
from edesign.project.analysis.damping import RayleighDamping
from edesign.substructure.structure.numerical import LinearPart, shear_building
from edesign.substructure.structure.recursion import (
    METHODS,
    Recursion,
    largest_step,
    recursion,
    unchecked_recursion,
)

SECOND_ORDER = ("newmark_explicit", "central_difference", "cr", "kr_alpha", "chang", "alpha_os")
SPRING = 4.346e6  # N/m, effective stiffness of the thesis' damper, 6.2.5


def oscillator(omega: float, ratio: float = 0.0) -> LinearPart:
    """A mass of 1 kg."""
    one = np.ones(1)
    return LinearPart(np.eye(1), np.array([[2.0 * ratio * omega]]), np.array([[omega**2]]), one, one, ("floor 1",))


def three_storeys() -> LinearPart:
    """The system of thesis 6.2.6 without its damper, which stands in the first storey."""
    damping = RayleighDamping(kind="rayleigh", ratio=0.02, modes=(1, 3))
    return shear_building([143.26e3, 143.26e3, 71.63e3], [22.6e6, 22.6e6, 18.08e6], damping, 1)


def poles(method: str, omega_dt: float, ratio: float = 0.0, rho: float = 0.75) -> np.ndarray:
    return np.linalg.eigvals(unchecked_recursion(oscillator(omega_dt, ratio), 1.0, method, "held", rho=rho).A)


def radius(method: str, omega_dt: float, rho: float = 0.75) -> float:
    return float(np.abs(poles(method, omega_dt, rho=rho)).max())


def average_acceleration(omega_dt: float, ratio: float) -> np.ndarray:
    """Poles of Newmark 1/4, which is the trapezoidal rule on x' = v, v' = -c v - k x."""
    rates = np.array([[0.0, 1.0], [-(omega_dt**2), -2.0 * ratio * omega_dt]])
    return np.linalg.eigvals(np.linalg.solve(np.eye(2) - 0.5 * rates, np.eye(2) + 0.5 * rates))


def distance(found: np.ndarray, expected: np.ndarray) -> float:
    """Largest distance of an expected pole from the nearest one found."""
    return float(max(np.abs(found - pole).min() for pole in expected))


@pytest.mark.parametrize("method", ["newmark_explicit", "central_difference"])
def test_explicit_newmark_is_stable_to_two(method: str) -> None:
    """1 up to omega dt = 2; 1.2213 at 2.01. Closed form: the poles' product is 1, their sum 2 - (omega dt)^2."""
    assert radius(method, 1.99) == pytest.approx(1.0, abs=1e-12)
    half = 1.0 - 0.5 * 2.01**2
    assert radius(method, 2.01) == pytest.approx(-half + math.sqrt(half**2 - 1.0), rel=1e-12)
    assert radius(method, 2.01) == pytest.approx(1.2213, abs=5e-5)


@pytest.mark.parametrize("omega_dt", [0.3, 3.0, 30.0])
@pytest.mark.parametrize("ratio", [0.0, 0.05])
@pytest.mark.parametrize("method", ["cr", "chang"])
def test_poles_of_average_acceleration(method: str, ratio: float, omega_dt: float) -> None:
    """Printed: equal to 2e-15."""
    assert distance(poles(method, omega_dt, ratio), average_acceleration(omega_dt, ratio)) < 1e-14


@pytest.mark.parametrize(("rho", "printed"), [(1.0, 1.0), (0.75, 0.7504), (0.5, 0.5004), (0.0, 0.0005)])
def test_radius_of_kr_alpha_at_high_frequency(rho: float, printed: float) -> None:
    """At omega dt = 1e5, to the four digits printed."""
    assert radius("kr_alpha", 1e5, rho) == pytest.approx(printed, abs=5e-5)


@pytest.mark.parametrize(("rho", "printed"), [(1.0, 8.32e-4), (0.75, 9.08e-4), (0.5, 1.247e-3)])
def test_poles_of_kr_alpha_at_low_frequency(rho: float, printed: float) -> None:
    """|ln(pole) - s dt| / (omega dt) at omega dt 0.1, zeta 0.02, as printed; at half of omega dt a quarter."""

    def error(omega_dt: float) -> float:
        exact = omega_dt * complex(-0.02, math.sqrt(1.0 - 0.02**2))
        return min(abs(cmath.log(pole) - exact) for pole in poles("kr_alpha", omega_dt, 0.02, rho) + 0j) / omega_dt

    assert error(0.1) == pytest.approx(printed, abs=6e-7)
    assert math.log2(error(0.1) / error(0.05)) == pytest.approx(2.0, abs=0.01)


@pytest.mark.parametrize("rho", [0.5, 0.75, 1.0])
def test_radius_of_alpha_os_is_rho(rho: float) -> None:
    """Hilber's alpha -(1 - rho)/(1 + rho) gives the radius rho at infinity; 1e-3 of it is left at omega dt = 1e5."""
    assert radius("alpha_os", 1e5, rho) == pytest.approx(rho, abs=1e-3)


def test_poles_of_the_exact_method() -> None:
    """exp(s dt) of the damped oscillator."""
    s = 0.7 * complex(-0.05, math.sqrt(1.0 - 0.05**2))
    assert distance(poles("exact", 0.7, 0.05), np.exp([s, s.conjugate()])) < 1e-14


def test_limit_of_bogacki_shampine() -> None:
    """omega dt = sqrt 3 without damping; on either side of the limit the radius is below and above 1."""
    assert largest_step(oscillator(1.0), "bogacki_shampine") == (pytest.approx(math.sqrt(3.0), rel=1e-9), 1)
    limit, _ = largest_step(oscillator(1.0, 0.05), "bogacki_shampine")
    assert np.abs(poles("bogacki_shampine", 0.999 * limit, 0.05)).max() < 1.0
    assert np.abs(poles("bogacki_shampine", 1.001 * limit, 0.05)).max() > 1.0


def test_limit_of_several_degrees() -> None:
    """The highest mode limits the step; rounding errors of undamped poles must not."""
    part = three_storeys()
    undamped = LinearPart(part.mass, 0.0 * part.damping, part.stiffness, part.influence, part.interface, part.names)
    highest = float(undamped.modes(SPRING)[0][-1])
    assert largest_step(undamped, "bogacki_shampine", SPRING) == (pytest.approx(math.sqrt(3.0) / highest, rel=1e-6), 3)
    assert largest_step(undamped, "newmark_explicit", SPRING) == (pytest.approx(2.0 / highest, rel=1e-9), 3)
    assert largest_step(undamped, "kr_alpha", SPRING)[0] == math.inf


@pytest.mark.parametrize("method", ["newmark_explicit", "central_difference", "bogacki_shampine"])
def test_a_step_beyond_the_limit_is_refused(method: str) -> None:
    """2 / (2 pi 3.63737 Hz) = 87.51 ms."""
    part = three_storeys()
    with pytest.raises(InputError, match=r"mode 3 .*\(3\.637 Hz\).* \d\d\.\d\d ms.*E-RTS-03"):
        recursion(part, 0.1, method, "held")
    recursion(part, largest_step(part, method)[0], method, "held")


GROUND_STEP = 0.04
GROUND = np.concatenate(([0.0, 0.9, -1.5, 2.1, 0.4, -1.2, 0.3, 0.8, 0.0], np.zeros(18)))  # m/s2
END = GROUND_STEP * (GROUND.size - 1)


def ground(step: float) -> np.ndarray:
    """Samples of the polyline, whose corners are samples at every step that divides GROUND_STEP."""
    time = np.arange(round(END / step) + 1) * step
    return np.interp(time, GROUND_STEP * np.arange(GROUND.size), GROUND)


def run(one: Recursion, step: float, spring: float = 0.0) -> np.ndarray:
    """Outputs (steps, 3 + n) of a loop whose specimen is a spring at the target, without any delay."""
    acceleration = ground(step)
    z, force, before, rows = np.zeros(one.A.shape[0]), 0.0, 0.0, []
    for now, ahead in zip(acceleration[:-1], acceleration[1:], strict=True):
        w = np.array([force, before, now, ahead])
        y = one.C @ z + one.D @ w
        z = one.A @ z + one.B @ w
        before, force = force, spring * y[0]
        rows.append(y)
    return np.array(rows)


def closed_form(part: LinearPart, step: float, spring: float) -> np.ndarray:
    """Outputs of the whole structure, exact for a polyline: scipy's simulation with inputs linear between samples."""
    n = len(part.names)
    inverse = np.linalg.inv(part.mass)
    stiffness = part.with_specimen(spring)
    a = np.block([[np.zeros((n, n)), np.eye(n)], [-inverse @ stiffness, -inverse @ part.damping]])
    b = np.concatenate((np.zeros(n), -part.influence))[:, None]
    i, none = part.interface, np.zeros(n)
    c = np.vstack(
        (
            np.concatenate((i, none)),
            np.concatenate((none, i)),
            i @ np.hstack((-inverse @ stiffness, -inverse @ part.damping)),
            np.hstack((np.eye(n), np.zeros((n, n)))),
        )
    )
    d = np.concatenate(([0.0, 0.0, -i @ part.influence], none))[:, None]
    acceleration = ground(step)
    _, outputs, _ = scipy.signal.lsim((a, b, c, d), acceleration, step * np.arange(acceleration.size))
    return np.asarray(outputs[1:])


def errors(method: str, steps: list[float], spring: float, force: str = "extrapolated") -> np.ndarray:
    """Root mean square error / root mean square of each output (steps, 3 + n)."""
    part, found = three_storeys(), []
    for step in steps:
        expected = closed_form(part, step, spring)
        made = recursion(part, step, method, force, specimen_stiffness=spring)
        off = run(made, step, spring) - expected
        found.append(np.sqrt(np.mean(off**2, axis=0) / np.mean(expected**2, axis=0)))
    return np.array(found)


STEPS = [0.005, 0.0025, 0.00125]


@pytest.mark.parametrize("spring", [0.0, SPRING])
@pytest.mark.parametrize("method", SECOND_ORDER)
def test_order_two(method: str, spring: float) -> None:
    """Every output converges with dt^2 to the closed form of the whole structure, with and without a specimen.

    The ground motion has corners, and at these steps the next order shows: 0.1 of the order.
    """
    found = errors(method, STEPS, spring)
    orders = np.log2(found[-2] / found[-1])
    assert orders == pytest.approx(np.full(orders.size, 2.0), abs=0.1)
    assert np.all(found[-1] < 2e-4)


def test_order_three_of_bogacki_shampine() -> None:
    """Without a force the problem is linear and smooth inside each step."""
    found = errors("bogacki_shampine", STEPS, 0.0)
    orders = np.log2(found[-2] / found[-1])
    assert orders == pytest.approx(np.full(orders.size, 3.0), abs=0.1)


def test_exact_without_a_specimen() -> None:
    """The ground motion is linear over the step, which is all that is assumed."""
    assert np.all(errors("exact", [GROUND_STEP, 0.005], 0.0) < 1e-11)


@pytest.mark.parametrize("method", ["exact", "bogacki_shampine"])
def test_force_inside_the_step(method: str) -> None:
    """Extrapolated force: order 2 and above; held force is late by half a step: order 1."""
    for force, order in (("extrapolated", 2.0), ("held", 1.0)):
        found = errors(method, STEPS, SPRING, force)
        assert np.log2(found[-2, 0] / found[-1, 0]) == pytest.approx(order, abs=0.1)


def test_held_force_takes_damping_away() -> None:
    """Half a step late: zeta lower by (k_E / k) omega dt / 4 to first order; the next is below 1 % of it here."""
    omega, ratio, share, step = 2.0 * math.pi * 2.0, 0.02, 0.2, 1e-3
    c, one = np.array([[2.0 * ratio * omega]]), np.ones(1)
    part = LinearPart(np.eye(1), c, np.array([[(1.0 - share) * omega**2]]), one, one, ("floor 1",))
    made = recursion(part, step, "exact", "held")
    closed = made.A + np.outer(made.B[:, 0], [share * omega**2, 0.0])  # F_k = k_E x_k, the first of the state
    pole = cmath.log(np.linalg.eigvals(closed)[0]) / step
    lost = ratio + pole.real / abs(pole)
    assert lost == pytest.approx(share * omega * step / 4.0, rel=0.01)


def test_a_right_estimate_closes_the_loop_like_the_whole_structure() -> None:
    """With F_k = k_E e_k the methods that take an estimate of k_E have the poles of the whole structure."""
    part, step = three_storeys(), 0.02
    whole = LinearPart(part.mass, part.damping, part.with_specimen(SPRING), part.influence, part.interface, part.names)
    for method in ("cr", "chang", "kr_alpha", "alpha_os"):
        made = recursion(part, step, method, "held", specimen_stiffness=SPRING)
        driven = np.concatenate((part.interface, np.zeros(made.A.shape[0] - 3)))  # states begin with the displacements
        closed = made.A + np.outer(made.B[:, 0], SPRING * driven)
        expected = recursion(whole, step, method, "held").A
        assert distance(np.linalg.eigvals(closed), np.linalg.eigvals(expected)) < 1e-9


@pytest.mark.parametrize("method", ["newmark_explicit", "cr", "bogacki_shampine", "exact"])
def test_free_vibration_with_damping(method: str) -> None:
    """x0 e^(-zeta omega t) (cos + zeta / sqrt(1 - zeta^2) sin) over two periods in 1000 steps.

    Errors of poles over 12.6 rad at omega dt = 0.0126: (omega dt)^2 / 12, and (omega dt)^3 / 24 of third order. The
    velocities that the methods of second order carry are those of half a step before.
    """
    omega, ratio, x0, steps = 2.0 * math.pi, 0.05, 0.01, 1000
    step = 2.0 / steps
    made = recursion(oscillator(omega, ratio), step, method, "held")
    time, damped = step * np.arange(1, steps + 1), omega * math.sqrt(1.0 - ratio**2)
    decay = np.exp(-ratio * omega * time)
    expected = x0 * decay * (np.cos(damped * time) + ratio * omega / damped * np.sin(damped * time))
    late = 0.5 * step * omega**2 * x0 if method in ("newmark_explicit", "cr") else 0.0
    z, found = np.array([x0, late]), []
    for _ in range(steps):
        found.append((made.C @ z)[3])
        z = made.A @ z
    tolerance = {"bogacki_shampine": 3e-6, "exact": 1e-11}.get(method, 3e-4)
    assert np.array(found) == pytest.approx(expected, abs=tolerance * x0)


@pytest.mark.parametrize("method", METHODS)
def test_target_is_the_specimen_s_deformation(method: str) -> None:
    """Shapes of the contract; the interface in the second storey takes the difference of two floors."""
    damping = RayleighDamping(kind="rayleigh", ratio=0.02, modes=(1, 3))
    part = shear_building([143.26e3, 143.26e3, 71.63e3], [22.6e6, 22.6e6, 18.08e6], damping, 2)
    made = recursion(part, 0.005, method, "extrapolated")
    size = made.A.shape[0]
    assert made.A.shape == (size, size) and made.B.shape == (size, 4)
    assert made.C.shape == (6, size) and made.D.shape == (6, 4)
    outputs = run(made, 0.005)
    if method == "alpha_os":  # the target is the predictor
        assert np.abs(outputs[:, 0] - (outputs[:, 4] - outputs[:, 3])).max() < 1e-2 * np.abs(outputs[:, 0]).max()
    else:
        assert outputs[:, 0] == pytest.approx(outputs[:, 4] - outputs[:, 3], abs=1e-15)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"method": "kr_alfa"}, "there is no method `kr_alfa`; did you mean `kr_alpha`?"),
        ({"force": "hold"}, "there is no force `hold`; did you mean `held`?"),
        ({"step": 0.0}, "main step E-RTS-03"),
        ({"step": math.nan}, "main step E-RTS-03"),
        ({"specimen_stiffness": -1.0}, "stiffness E-VALUE-02"),
        ({"rho": 1.2}, "kr_alpha: rho_inf E-VALUE-02"),
        ({"method": "alpha_os", "rho": 0.4}, "alpha_os: rho_inf E-VALUE-02"),
    ],
)
def test_what_is_refused(change: dict[str, object], message: str) -> None:
    arguments: dict[str, object] = {"step": 0.001, "method": "kr_alpha", "force": "held"} | change
    with pytest.raises(InputError) as caught:
        recursion(oscillator(10.0), **arguments)  # type: ignore[arg-type]
    assert says(str(caught.value), message)
