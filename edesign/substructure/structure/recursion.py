"""A step of the numerical part as matrices, which is all that the core needs of an integrator."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

from edesign.core.substructure import Recursion
from edesign.errors import InputError
from edesign.one_thread import one_thread
from edesign.project.reading.problems import unknown_name
from edesign.substructure.structure import integrators
from edesign.substructure.structure.equation import Advance, Equation, ForceBetween, Instant, Known, Motion
from edesign.substructure.structure.numerical import LinearPart

AT_INSTANTS: dict[str, tuple[int, Callable[[Equation], Instant]]] = {
    "newmark_explicit": (2, integrators.newmark_explicit),
    "central_difference": (2, integrators.central_difference),
    "cr": (2, integrators.cr),
    "kr_alpha": (3, integrators.kr_alpha),
    "chang": (2, integrators.chang),
    "alpha_os": (3, integrators.alpha_os),
}
"""Methods that need the force at the ends of steps only; n times the number is the length of their state."""

OVER_THE_STEP: dict[str, Callable[[Equation, ForceBetween], Advance]] = {
    "bogacki_shampine": integrators.bogacki_shampine,
    "exact": integrators.exact,
}
"""Methods that need the force inside the step; their state is displacement and velocity."""

METHODS = (*AT_INSTANTS, *OVER_THE_STEP)
FORCES: tuple[ForceBetween, ForceBetween] = ("held", "extrapolated")
INPUTS = 4
TARGETS = 3

_SLACK = 1e-9  # of the largest step: a step at the limit itself is allowed
_UNDAMPED = 1e-9  # damping ratio that is rounding errors of the poles


def recursion(
    part: LinearPart,
    step: float,
    method: str,
    force: str,
    *,
    specimen_stiffness: float = 0.0,
    rho: float = 0.75,
    accelerations: np.ndarray | None = None,
) -> Recursion:
    """Return the recursion of a numerical part with a method of integration.

    The target displacement is what the specimen is driven to: with `alpha_os` the predictor, otherwise the displacement
    at the end of the step. Target velocity and acceleration, and displacements of `alpha_os`, need the force at the
    end. There it is extrapolated linearly from the last two, and the method's own formulas of that instant follow:

    - newmark_explicit, chang: balance with (M + dt/2 C) a, velocity of the trapezoidal rule;
    - central_difference: differences over the displacements around that instant, the next one predicted so;
    - cr: v + a dt/2, as v is late by half a step; acceleration from balance;
    - kr_alpha: v + gamma a dt, as v is late by gamma dt; acceleration from balance;
    - alpha_os: corrector of displacement and velocity; acceleration from balance;
    - bogacki_shampine, exact: velocity of the state; acceleration from balance with the force that `force` says.

    Args:
        step: main step, s.
        method: one of METHODS.
        force: inside the step `held` at F_k or `extrapolated` from F_(k-1) and F_k; methods that need it at the ends of
            steps only ignore it.
        specimen_stiffness: estimate for the parameters of cr, kr_alpha, chang and alpha_os, and for the limits of the
            explicit methods, N/m.
        rho: spectral radius at infinite frequency, of kr_alpha (0 to 1) and alpha_os (1/2 to 1).
        accelerations: (m, n) sums of the degrees whose accelerations relative to the ground, m/s2, are outputs after
            the displacements; None: each step is spared them.

    Raises:
        InputError: an unknown method or force, an impossible number, or a step beyond the limit of the method.
    """
    matrices = unchecked_recursion(
        part, step, method, force, specimen_stiffness=specimen_stiffness, rho=rho, accelerations=accelerations
    )
    largest, mode = largest_step(part, method, specimen_stiffness)
    if step > largest * (1.0 + _SLACK):
        frequency = part.frequencies(specimen_stiffness)[mode - 1]
        raise InputError(
            f"{method} is unstable with steps of {1e3 * step:g} ms: mode {mode} of the numerical part "
            f"({frequency:.4g} Hz) allows at most {1e3 * largest:.4g} ms; take a shorter main step, or `kr_alpha`, "
            "which has no limit [E-RTS-03]"
        )
    return matrices


def unchecked_recursion(
    part: LinearPart,
    step: float,
    method: str,
    force: str,
    *,
    specimen_stiffness: float = 0.0,
    rho: float = 0.75,
    accelerations: np.ndarray | None = None,
) -> Recursion:
    """Return the recursion of a method without asking whether it is stable.

    Args:
        step: main step, s.
        method: see `recursion`.
        force: see `recursion`.
        specimen_stiffness: N/m, see `recursion`.
        rho: see `recursion`.
        accelerations: see `recursion`.

    Raises:
        InputError: there is no such method.
    """
    if method not in METHODS:
        raise InputError(unknown_name("method", method, METHODS))
    between = next((known for known in FORCES if known == force), None)
    if between is None:
        raise InputError(unknown_name("force", force, FORCES))
    if not 0.0 < step < math.inf:
        raise InputError(f"main step: must be greater than zero, not {step:g} s [E-RTS-03]")
    if not 0.0 <= specimen_stiffness < math.inf:
        raise InputError(
            f"estimate of the specimen's stiffness: must not be negative, not {specimen_stiffness:g} N/m [E-VALUE-02]"
        )
    with one_thread():
        return _matrices(Equation(part, step, specimen_stiffness, rho), method, between, accelerations)


def _matrices(equation: Equation, method: str, between: ForceBetween, accelerations: np.ndarray | None) -> Recursion:
    """Evaluate the step on unit vectors of the state and of what is known."""
    part, n = equation.part, len(equation.part.names)
    if method in AT_INSTANTS:
        blocks, make = AT_INSTANTS[method]
        whole = _between_instants(make(equation), part)
    else:
        blocks, whole = 2, _over_step(OVER_THE_STEP[method](equation, between), equation, between)
    size = blocks * n
    unit = np.eye(size + INPUTS)
    columns = [np.concatenate(whole(column[:size], Known(*map(float, column[size:])))) for column in unit]
    table = np.array(columns).T
    outputs, last = table[size:], TARGETS + n
    more = np.zeros((0, n)) if accelerations is None else accelerations
    outputs = np.vstack((outputs[:last], more @ outputs[last:]))
    return Recursion(table[:size, :size], table[:size, size:], outputs[:, :size], outputs[:, size:])


def largest_step(part: LinearPart, method: str, specimen_stiffness: float = 0.0) -> tuple[float, int]:
    """Return the largest step (s) at which a method is stable, and the mode that limits it, from 1.

    Of the methods without a limit the step is infinite and the mode the highest.

    Args:
        method: one of METHODS.
        specimen_stiffness: in the place of the specimen, N/m.

    Returns:
        Step, s, and number of the mode.

    Raises:
        InputError: the structure is unstable.

    Source: omega dt = 2 of central differences (Chopra, Dynamics of Structures, 5.3.2); |R(dt lambda)| = 1 with
    R = 1 + z + z^2/2 + z^3/6 of Bogacki-Shampine, sqrt(3) without damping (Hairer & Wanner, IV.2).
    """
    n = len(part.names)
    if method not in ("newmark_explicit", "central_difference", "bogacki_shampine"):
        return math.inf, n
    omega, _ = part.modes(specimen_stiffness)
    if method != "bogacki_shampine":
        return (2.0 / float(omega[-1]) if omega[-1] > 0.0 else math.inf), n
    inverse = np.linalg.inv(part.mass)
    stiffness = part.with_specimen(specimen_stiffness)
    rates = np.block([[np.zeros((n, n)), np.eye(n)], [-inverse @ stiffness, -inverse @ part.damping]])
    poles = np.linalg.eigvals(rates)
    limits = [_runge_kutta_limit(complex(pole)) for pole in poles]
    first = int(np.argmin(limits))
    return limits[first], int(np.argmin(np.abs(omega - abs(poles[first])))) + 1


Step = Callable[[np.ndarray, Known], tuple[np.ndarray, np.ndarray]]
"""(state, what is known) -> (state a step later, y')."""


def _between_instants(instant: Instant, part: LinearPart) -> Step:
    """The step from one instant to the next; the motion at its end is that with the force extrapolated."""

    def step(state: np.ndarray, known: Known) -> tuple[np.ndarray, np.ndarray]:
        ahead, _ = instant(state, known.force, known.ground)
        _, end = instant(ahead, known.force_at(1.0, "extrapolated"), known.ground_ahead)
        return ahead, _outputs(part, ahead[: len(part.names)], end)

    return step


def _over_step(advance: Advance, equation: Equation, force: ForceBetween) -> Step:
    """The step of a method with stages; the acceleration at its end is that of balance there."""
    part = equation.part

    def step(state: np.ndarray, known: Known) -> tuple[np.ndarray, np.ndarray]:
        ahead = advance(state, known)
        x, v = np.split(ahead, 2)
        return ahead, _outputs(part, x, equation.balanced(x, v, known.force_at(1.0, force), known.ground_ahead))

    return step


def _outputs(part: LinearPart, driven: np.ndarray, end: Motion) -> np.ndarray:
    targets = [part.interface @ values for values in (driven, end.velocity, end.acceleration)]
    return np.concatenate((targets, end.displacement, end.acceleration))


def _runge_kutta_limit(pole: complex) -> float:
    """Smallest step above zero at which |R(step pole)| grows beyond 1, s."""
    if abs(pole) == 0.0:
        return math.inf
    direction = pole / abs(pole)
    if abs(direction.real) < _UNDAMPED:
        direction = 1j
    response = np.polynomial.Polynomial([1.0, direction, direction**2 / 2.0, direction**3 / 6.0])
    conjugate = np.polynomial.Polynomial(np.conj(response.coef))
    growth = (response * conjugate).coef.real[1:]  # (|R|^2 - 1) / step
    growth[np.abs(growth) < 1e-14] = 0.0
    roots = np.polynomial.Polynomial(growth).roots()
    real = roots[np.abs(roots.imag) < 1e-6 * np.abs(roots)].real
    positive = real[real > 0.0]
    return float(positive.min()) / abs(pole) if positive.size else math.inf


def growth(numerical: Recursion, stiffness: float, damping: float, step: float) -> float:
    """Return by how much small vibrations grow in a step of the loop with an ideal rig; 1 and below: they do not.

    The specimen is a spring and a dashpot, which the rig moves in ramps.

    Args:
        stiffness: of the specimen, N/m.
        damping: of the specimen, N s/m.
        step: s.

    Returns:
        Largest magnitude of an eigenvalue of the step; infinite where the step overflows.
    """
    A, B, states = numerical.A, numerical.B, len(numerical.A)
    unit = np.eye(states + 3)
    z, force, before, position = unit[:states], unit[states], unit[states + 1], unit[states + 2]
    ahead = A @ z + np.outer(B[:, 0], force) + np.outer(B[:, 1], before)
    moved = numerical.C[0] @ z + numerical.D[0, 0] * force + numerical.D[0, 1] * before
    met = stiffness * moved + damping / step * (moved - position)
    whole = np.vstack([ahead, met, force, moved])
    return float(np.max(np.abs(np.linalg.eigvals(whole)))) if np.all(np.isfinite(whole)) else math.inf
