"""Time integration of a linear numerical part: one step of each method as the formulas that its source prints.

At the start of step k the specimen has just been driven to the target of that instant, and its force F_k is known. Most
methods need the force at such instants only. They are written as a function `Instant`: it completes the motion at
instant k with F_k, and returns the state for instant k + 1, whose first n entries are the next target. Methods with
stages inside the step (Bogacki-Shampine, `exact`) are written as a function `Advance` over the whole step; the force
inside it is an assumption: held, or extrapolated linearly from the last two.

Some methods carry a velocity or acceleration of an instant a fraction of the step away. The motion that a function
returns is of the instant itself, to second order: what a method carries is moved there, or found from balance.

`recursion.py` makes matrices of these functions.
"""

from __future__ import annotations

import numpy as np
import scipy

from edesign.errors import InputError
from edesign.substructure.structure.equation import Advance, Equation, ForceBetween, Instant, Known, Motion


def newmark_explicit(eq: Equation) -> Instant:
    """Return Newmark's explicit method: gamma 1/2, beta 0.

    The state is the displacement, and the velocity without a_k dt/2.

    Args:
        eq: equation of motion of the numerical part over a step.

    Source: thesis Eqs. 6.1-6.3; damping makes 6.1 an equation, (M + dt/2 C) a = ...
    """
    dt = eq.step
    inverse = np.linalg.inv(eq.part.mass + 0.5 * dt * eq.part.damping)

    def instant(state: np.ndarray, force: float, ground: float) -> tuple[np.ndarray, Motion]:
        x, predicted = np.split(state, 2)
        a = inverse @ eq.unbalance(x, predicted, force, ground)
        v = predicted + 0.5 * dt * a
        ahead = x + dt * v + 0.5 * dt**2 * a
        return np.concatenate((ahead, v + 0.5 * dt * a)), Motion(x, v, a)

    return instant


def central_difference(eq: Equation) -> Instant:
    """Return the central difference method.

    The state is the displacements now and a step ago.

    Args:
        eq: equation of motion of the numerical part over a step.

    Source: Chopra, Dynamics of Structures, 5.3; the displacements are those of the explicit Newmark method.
    """
    dt, part = eq.step, eq.part
    inertia, drag = part.mass / dt**2, part.damping / (2.0 * dt)
    inverse = np.linalg.inv(inertia + drag)

    def instant(state: np.ndarray, force: float, ground: float) -> tuple[np.ndarray, Motion]:
        x, before = np.split(state, 2)
        known = eq.load(force, ground) - part.stiffness @ x + inertia @ (2.0 * x - before) + drag @ before
        ahead = inverse @ known
        v, a = (ahead - before) / (2.0 * dt), (ahead - 2.0 * x + before) / dt**2
        return np.concatenate((ahead, x)), Motion(x, v, a)

    return instant


def cr(eq: Equation) -> Instant:
    """Return the CR method, with the poles of Newmark's average acceleration.

    The state is displacement and velocity. As x_(k+1) - x_k = dt v_(k+1), its velocity is that of half a step before;
    the motion has v + a dt/2.

    Args:
        eq: equation of motion of the numerical part over a step.

    Source: Chen & Ricles, J. Eng. Mech. 134(8), 2008; alpha_1 = alpha_2 = 4 (4 M + 2 dt C + dt^2 K)^-1 M.
    """
    dt, part = eq.step, eq.part
    alpha = np.linalg.solve(4.0 * part.mass + 2.0 * dt * part.damping + dt**2 * eq.whole_stiffness, 4.0 * part.mass)

    def instant(state: np.ndarray, force: float, ground: float) -> tuple[np.ndarray, Motion]:
        x, v = np.split(state, 2)
        a = eq.inverse_mass @ eq.unbalance(x, v, force, ground)
        motion = eq.balanced(x, v + 0.5 * dt * a, force, ground)
        return np.concatenate((x + dt * v + dt**2 * alpha @ a, v + dt * alpha @ a)), motion

    return instant


def kr_alpha(eq: Equation) -> Instant:
    """Return the KR-alpha method: explicit, damping of high modes by `rho`.

    The state is x, v, and what instant k-1 adds to balance. Balance is at the weighted instant: M ((1 - a3) a_k + a3
    a_(k-1)) = (1 - alpha_f) p_k + alpha_f p_(k-1), with the unbalance p of an instant without inertia. Its velocity is
    that of gamma dt before; the motion has v + gamma a dt.

    Args:
        eq: equation of motion of the numerical part over a step.

    Source: Kolay & Ricles, Earthquake Eng. Struct. Dyn. 43, 2014.
    """
    dt, part, r = eq.step, eq.part, _rho(eq.rho, 0.0, "kr_alpha")
    alpha_m, alpha_f = (2.0 * r - 1.0) / (r + 1.0), r / (r + 1.0)
    gamma = 0.5 - alpha_m + alpha_f
    beta = 0.25 * (0.5 + gamma) ** 2
    restoring = gamma * dt * part.damping + beta * dt**2 * eq.whole_stiffness
    alpha_1 = np.linalg.solve(part.mass + restoring, part.mass)
    alpha_2 = (0.5 + gamma) * alpha_1
    alpha_3 = np.linalg.solve(part.mass + restoring, alpha_m * part.mass + alpha_f * restoring)
    carry = part.mass @ alpha_3
    inverse = np.linalg.inv(part.mass - carry)

    def instant(state: np.ndarray, force: float, ground: float) -> tuple[np.ndarray, Motion]:
        x, v, carried = np.split(state, 3)
        p = eq.unbalance(x, v, force, ground)
        a = inverse @ ((1.0 - alpha_f) * p + carried)
        ahead, speed = x + dt * v + dt**2 * alpha_2 @ a, v + dt * alpha_1 @ a
        motion = eq.balanced(x, v + gamma * dt * a, force, ground)
        return np.concatenate((ahead, speed, alpha_f * p - carry @ a)), motion

    return instant


def chang(eq: Equation) -> Instant:
    """Return Chang's explicit method, with the poles of Newmark's average acceleration.

    The state is that of `newmark_explicit`. x_(k+1) = x_k + b1 dt v_k + b2 dt^2 a_k with b1 = H (I + dt/2 M^-1 C), b2 =
    H / 2, H = (I + dt/2 M^-1 C + dt^2/4 M^-1 K)^-1; the velocity is that of the trapezoidal rule.

    Args:
        eq: equation of motion of the numerical part over a step.

    Source: Chang, J. Eng. Mech. 128(9), 2002.
    """
    dt, part = eq.step, eq.part
    damped = part.mass + 0.5 * dt * part.damping
    whole = damped + 0.25 * dt**2 * eq.whole_stiffness
    beta_1, beta_2 = np.linalg.solve(whole, damped), 0.5 * np.linalg.solve(whole, part.mass)
    inverse = np.linalg.inv(damped)

    def instant(state: np.ndarray, force: float, ground: float) -> tuple[np.ndarray, Motion]:
        x, predicted = np.split(state, 2)
        a = inverse @ eq.unbalance(x, predicted, force, ground)
        v = predicted + 0.5 * dt * a
        ahead = x + dt * beta_1 @ v + dt**2 * beta_2 @ a
        return np.concatenate((ahead, v + 0.5 * dt * a)), Motion(x, v, a)

    return instant


def alpha_os(eq: Equation) -> Instant:
    """Return operator splitting with Hilber's alpha: the specimen is driven to the predictor, then corrected once.

    The specimen is implicit with the estimate of its stiffness: its force at the corrected displacement is taken as
    F + k_E (e - e_predictor). alpha = -(1 - rho)/(1 + rho), gamma = 1/2 - alpha, beta = (1 - alpha)^2/4. State:
    predictors of displacement and velocity, unbalance of the last instant. Balance is at an instant of weights, so the
    acceleration of the motion is that of the unbalance p_k.

    Args:
        eq: equation of motion of the numerical part over a step.

    Source: Combescure & Pegon, Nuclear Eng. Design 169, 1997; alpha by `rho`: Hilber, Hughes & Taylor, 1977.
    """
    dt, part, rho = eq.step, eq.part, _rho(eq.rho, 0.5, "alpha_os")
    alpha = -(1.0 - rho) / (1.0 + rho)
    gamma, beta = 0.5 - alpha, 0.25 * (1.0 - alpha) ** 2
    implicit = gamma * dt * part.damping + beta * dt**2 * eq.whole_stiffness
    inverse = np.linalg.inv(part.mass + (1.0 + alpha) * implicit)

    def instant(state: np.ndarray, force: float, ground: float) -> tuple[np.ndarray, Motion]:
        predictor, speed, before = np.split(state, 3)
        explicit = eq.unbalance(predictor, speed, force, ground)
        a = inverse @ ((1.0 + alpha) * explicit - alpha * before)
        x, v = predictor + beta * dt**2 * a, speed + gamma * dt * a
        p = explicit - implicit @ a
        ahead = x + dt * v + (0.5 - beta) * dt**2 * a
        return np.concatenate((ahead, v + (1.0 - gamma) * dt * a, p)), Motion(x, v, eq.inverse_mass @ p)

    return instant


def bogacki_shampine(eq: Equation, force: ForceBetween) -> Advance:
    """Return the third-order Runge-Kutta method of three stages, `ode3` of Simulink, which the thesis used.

    Args:
        eq: equation of motion of the numerical part over a step.
        force: how the force goes on in the step.

    Source: Bogacki & Shampine, Appl. Math. Letters 2(4), 1989: nodes 0, 1/2, 3/4, weights 2/9, 1/3, 4/9.
    """
    dt = eq.step

    def slope(state: np.ndarray, known: Known, share: float) -> np.ndarray:
        x, v = np.split(state, 2)
        p = eq.unbalance(x, v, known.force_at(share, force), known.ground_at(share))
        return np.concatenate((v, eq.inverse_mass @ p))

    def advance(state: np.ndarray, known: Known) -> np.ndarray:
        first = slope(state, known, 0.0)
        second = slope(state + 0.5 * dt * first, known, 0.5)
        third = slope(state + 0.75 * dt * second, known, 0.75)
        return np.asarray(state + dt / 9.0 * (2.0 * first + 3.0 * second + 4.0 * third))

    return advance


def exact(eq: Equation, force: ForceBetween) -> Advance:
    """Return the exact solution for ground motion and force linear over the step.

    With loads p + q t, t in steps, the state (x, v, p, q) has a constant matrix; its exponential is the step.

    Args:
        eq: equation of motion of the numerical part over a step.
        force: how the force goes on in the step.

    Source: Van Loan, IEEE Trans. Autom. Control 23(3), 1978.
    """
    part, n, inverse = eq.part, len(eq.part.names), eq.inverse_mass
    nothing, one = np.zeros((n, n)), np.eye(n)
    rates = np.block(
        [
            [nothing, eq.step * one, nothing, nothing],
            [-eq.step * inverse @ part.stiffness, -eq.step * inverse @ part.damping, eq.step * inverse, nothing],
            [nothing, nothing, nothing, one],
            [nothing, nothing, nothing, nothing],
        ]
    )
    transition = scipy.linalg.expm(rates)[: 2 * n]

    def advance(state: np.ndarray, known: Known) -> np.ndarray:
        start = eq.load(known.force, known.ground)
        end = eq.load(known.force_at(1.0, force), known.ground_ahead)
        return np.asarray(transition @ np.concatenate((state, start, end - start)))

    return advance


def _rho(rho: float, least: float, method: str) -> float:
    if not least <= rho <= 1.0:
        raise InputError(f"{method}: rho_inf must lie from {least:g} to 1, not {rho:g} [E-VALUE-02]")
    return rho
