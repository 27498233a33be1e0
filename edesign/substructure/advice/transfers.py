"""Rig, compensators and the step of the loop of a file as transfer functions, for its stability and expected errors."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, replace

import numpy as np

from edesign.core.compensator import DifferenceEquation, Term
from edesign.project.substructure import compensators as kinds
from edesign.project.substructure import rig as rig_kinds
from edesign.project.substructure.rts_file import RtsFile
from edesign.substructure.compensation.compensator_matrices import state_space
from edesign.substructure.compensation.described import compensator_of
from edesign.substructure.rig.rigs import RigTransfer
from edesign.substructure.stability.loop import Transfer
from edesign.substructure.stability.whole import ComplexStiffness

_ORDER = {"target": 0, "velocity": 1, "acceleration": 2}
EXACTLY = "exactly"
"""How the linear loop models a compensator that is linear itself."""


@dataclass(frozen=True)
class CompensatorTransfer:
    """Transfer functions of a compensator beside its rig.

    Attributes:
        command: command over the target that it is given.
        force: what it adds to the measured force over that target, N/m; None: nothing.
        modelled_as: how the linear loop models it, in words.
        settles: whether it is stable by itself, with the rig where it feeds back what is measured.
        alpha: (3,) coefficients of an adaptive series, 1, s, s2; None: it has none.
        limited: whether limits of the file hold one of them.
        equation: it as the loop runs it, an adaptive one with what it has found; None: not known.
    """

    command: Transfer
    force: Transfer | None
    modelled_as: str
    settles: bool = True
    alpha: np.ndarray | None = None
    limited: bool = False
    equation: DifferenceEquation | None = None


def rig_response(plant: rig_kinds.RigModel, transfer: RigTransfer, specimen: ComplexStiffness, step: float) -> Transfer:
    """Return displacement of the specimen over command, the specimen loading the rig.

    Args:
        transfer: of it; of a servo-hydraulic one another is made, with the specimen as it is at each frequency.
        step: main step, s: so late is what is corrected of the flexibility.
    """
    flexibility = plant.flexibility
    if flexibility is None and not _is_servo(plant):
        return transfer  # the specimen changes nothing

    def response(s: np.ndarray) -> np.ndarray:
        stiffness = np.asarray(specimen(-1j * s))
        reach = 1.0 / (1.0 + stiffness / flexibility.stiffness) if flexibility else np.ones_like(stiffness)
        piston = _servo(plant, s, reach * stiffness) if _is_servo(plant) else transfer(s)
        if flexibility and flexibility.corrected:
            piston = piston / (1.0 - np.exp(-s * step) * (1.0 - reach) * piston)
        return np.asarray(reach * piston)

    return response


def _is_servo(plant: rig_kinds.RigModel) -> bool:
    return isinstance(plant, rig_kinds.ServoHydraulicRig)


def _servo(plant: rig_kinds.RigModel, s: np.ndarray, load: np.ndarray) -> np.ndarray:
    """Piston over command with a load (N/m) on the piston; the loop is closed on the piston."""
    assert isinstance(plant, rig_kinds.ServoHydraulicRig)
    soft = 1.0 + load / plant.oil_stiffness if plant.oil_stiffness else 1.0
    gain = plant.proportional_gain
    below = soft * s * (plant.valve_time_constant * s + 1.0) + gain
    return np.asarray(gain * np.exp(-s * plant.delay) / below)


def force_over_step(force: str, step: float) -> Transfer:
    """Return what the numerical part takes for the force over a step, over the force itself.

    Held: (1 - z) / (s T), half a step late. Extrapolated: ((1 - z) / (s T))^2 (1 + s T), late in third order only;
    z = exp(-s T).

    Args:
        force: `held` or `extrapolated`.
        step: main step T, s.

    Source: zero-order and first-order hold; Franklin, Powell & Workman, Digital Control of Dynamic Systems, 5.2.
    """

    def transfer(s: np.ndarray) -> np.ndarray:
        turn = np.asarray(s, dtype=complex) * step
        small = np.abs(turn) < 1e-6  # where the quotient loses digits its series holds to the last
        mean = np.where(small, 1.0 - 0.5 * turn, -np.expm1(-turn) / np.where(small, 1.0, turn))
        return np.asarray(mean if force == "held" else mean**2 * (1.0 + turn))

    return transfer


def late(delay: float, transfer: Transfer) -> Transfer:
    """Return a transfer function behind a delay.

    Args:
        delay: s.
        transfer: without it.
    """
    return lambda s: np.asarray(np.exp(-s * delay) * transfer(s))


def behind(
    file: RtsFile, name: str, rig: Transfer, plain: RigTransfer, learned: CompensatorTransfer | None = None
) -> CompensatorTransfer:
    """Return a compensator of a file, behind the delay that it does not see.

    Args:
        rig: displacement of the specimen over command.
        plain: the rig as far as a state space has it.
        learned: what an adaptive one has come to; None: its coefficients are constant.
    """
    described, step = file.compensators[name], file.loop.main_step
    if learned is None:
        equation = compensator_of(described, step, plain)
        assert isinstance(equation, DifferenceEquation)
        learned = _of_equation(equation, rig, plain, step)
    unseen = 0.0 if described.kind == "none" else file.loop.unseen_delay * step
    force = late(unseen, learned.force) if learned.force is not None else None
    return replace(learned, command=late(unseen, learned.command), force=force)


def actuation(compensator: CompensatorTransfer, rig: Transfer, specimen: ComplexStiffness | None) -> Transfer:
    """Return displacement over target; of one that corrects the force, that force over the one under the target.

    Args:
        compensator: of `behind`.
        rig: displacement of the specimen over command.
        specimen: its complex stiffness; None: nothing corrects the force.
    """

    def transfer(s: np.ndarray) -> np.ndarray:
        value = rig(s) * compensator.command(s)
        if compensator.force is not None:
            assert specimen is not None
            value = value + compensator.force(s) / specimen(-1j * s)
        return np.asarray(value)

    return transfer


def _of_equation(equation: DifferenceEquation, rig: Transfer, plain: RigTransfer, step: float) -> CompensatorTransfer:
    """Return a compensator with constant coefficients; what it takes from the measured displacement closes a loop.

    Args:
        rig: displacement of the specimen over command.
        plain: the rig as far as a state space has it, for whether the two are stable together.
        step: main step, s.
    """

    def command(s: np.ndarray) -> np.ndarray:
        below = 1.0 - _sum(equation.terms, ("command",), s, step)
        measured = _sum(equation.terms, ("measured",), s, step)
        if any(term.of == "measured" for term in equation.terms):
            below = below - measured * np.exp(-s * step) * rig(s)
        return np.asarray(_sum(equation.terms, _ORDER, s, step) / below)

    def force(s: np.ndarray) -> np.ndarray:
        sent = command(s)
        of_target = _sum(equation.force_terms, _ORDER, s, step)
        of_command = _sum(equation.force_terms, ("command",), s, step)
        of_measured = _sum(equation.force_terms, ("measured",), s, step) * np.exp(-s * step) * rig(s)
        return np.asarray(of_target + (of_command + of_measured) * sent)

    added = force if equation.force_terms else None
    return CompensatorTransfer(command, added, EXACTLY, settles(equation, plain, step), equation=equation)


def _sum(terms: Iterable[Term], signals: Iterable[str], s: np.ndarray, step: float) -> np.ndarray:
    found = np.zeros(np.shape(s), dtype=complex)
    for term in terms:
        if term.of in signals:
            found += term.coefficient * s ** _ORDER.get(term.of, 0) * np.exp(-s * term.lag * step)
    return found


def settles(equation: DifferenceEquation, rig: RigTransfer, step: float) -> bool:
    """Say whether a compensator with the rig comes to rest for a target at rest.

    Args:
        rig: loaded as it is; a delay between two steps is linear between them.
        step: main step, s.
    """
    own = state_space(equation)
    measured, direct = own.B[:, 3], own.D[0, 3]
    if not (np.any(measured) or direct):
        return _decays(own.A)
    denominator = tuple(np.trim_zeros(np.array(rig.denominator), "f").tolist())
    moved = replace(rig, denominator=denominator).discrete(step)
    n, m = own.states, len(moved.A)
    whole = math.floor(rig.delay / step)
    part, places = rig.delay / step - whole, whole + 3
    size = n + m + places  # compensator, rig, and commands from the last one back

    def advance(state: np.ndarray) -> np.ndarray:
        z, r, sent = np.split(state, [n, n + m])
        arrived = (1.0 - part) * sent[whole] + part * sent[whole + 1]
        position = moved.c @ r + moved.d * arrived
        command = own.C[0] @ z + direct * position
        line = np.concatenate(([command], sent[:-1]))
        arrives = (1.0 - part) * line[whole] + part * line[whole + 1]
        ahead = moved.A @ r + moved.b0 * arrived + moved.b1 * arrives
        return np.concatenate((own.A @ z + measured * position, ahead, line))

    return _decays(np.array([advance(column) for column in np.eye(size)]).T)


def _decays(matrix: np.ndarray) -> bool:
    return not matrix.size or bool(np.max(np.abs(np.linalg.eigvals(matrix))) < 1.0)


def of_live_delay(
    described: kinds.LiveDelayCompensator, rig_delay: float, peak: float, step: float
) -> CompensatorTransfer:
    """Return the polynomial of a live delay that has found the delay of the rig, or never adapts below its threshold.

    Args:
        rig_delay: s.
        peak: of the motion, m.
        step: main step, s.
    """
    least, largest = described.limits
    adapts = peak > described.threshold
    delay = min(max(rig_delay, least), largest) if adapts else described.delay
    command = live_delay_command(described.order, delay)
    how = "converged: a delay of" if adapts else "never adapts, below its threshold: a delay of"
    said, limited = f"{how} {1e3 * delay:.4g} ms", adapts and delay != rig_delay
    equation = DifferenceEquation(tuple(_between_steps(described.order, delay / step)))
    return CompensatorTransfer(command, None, said, limited=limited, equation=equation)


def _between_steps(order: int, delay: float) -> Iterator[Term]:
    """A polynomial through targets a delay of main steps apart, which are linear between these."""
    for j, weight in enumerate(_polynomial_weights(order)):
        whole = math.floor(j * delay)
        part = j * delay - whole
        yield Term("target", whole, weight * (1.0 - part))
        yield Term("target", whole + 1, weight * part)


def _polynomial_weights(order: int) -> list[int]:
    """Of values at 0, -d, -2 d ... for the value at d."""
    return [(-1) ** j * math.comb(order + 1, j + 1) for j in range(order + 1)]


def live_delay_command(order: int, delay: float) -> Transfer:
    """Return command over target of a polynomial through points of the past.

    Args:
        delay: between the points, s.
    """
    weights = _polynomial_weights(order)

    def command(s: np.ndarray) -> np.ndarray:
        value = sum(weight * np.exp(-s * j * delay) for j, weight in enumerate(weights))
        return np.asarray(value + np.zeros(np.shape(s)))

    return command


def of_adaptive_series(
    described: kinds.AtsCompensator | kinds.ModifiedAtsCompensator, rig: Transfer, motion: np.ndarray, step: float
) -> CompensatorTransfer:
    """Return an adaptive time series that has converged: the least squares over the motion, within its limits.

    The compensator sees the measured motion with backward differences, both channels filtered. Below its threshold it
    never adapts, and stays as it begins.

    Args:
        rig: displacement of the specimen over command.
        motion: (n,) displacement of the specimen, m, at main steps.
        step: main step, s.
    """
    adapts = float(np.max(np.abs(motion))) > described.threshold
    alpha = converged_series(described, rig, motion, step) if adapts else np.array(described.initial)
    limits = described.limits
    clipped = np.clip(alpha, *np.transpose([limits.a0, limits.a1, limits.a2]))
    how = "converged" if adapts else "never adapts, below its threshold"
    said = f"{how}: {clipped[0]:.5g}, {1e3 * clipped[1]:.4g} ms, {1e6 * clipped[2]:.4g}e-6 s2"
    command = series_command(described, clipped, step)
    limited, equation = bool(np.any(clipped != alpha)), _series_equation(clipped, described.derivatives, step)
    return CompensatorTransfer(command, None, said, alpha=clipped, limited=limited, equation=equation)


def series_command(
    described: kinds.AtsCompensator | kinds.ModifiedAtsCompensator, alpha: np.ndarray, step: float
) -> Transfer:
    """Return command over target of an adaptive time series, by the derivatives that it takes.

    Args:
        alpha: (3,) coefficients: -, s, s2.
        step: main step, s.
    """
    derivatives = _differences(step) if described.derivatives == "differences" else lambda s: (s, s**2)

    def command(s: np.ndarray) -> np.ndarray:
        first, second = derivatives(s)
        return np.asarray(alpha[0] + alpha[1] * first + alpha[2] * second)

    return command


def _series_equation(alpha: np.ndarray, derivatives: str, step: float) -> DifferenceEquation:
    """Return alpha_0 x + alpha_1 v + alpha_2 a with constant coefficients.

    Args:
        alpha: (3,) coefficients, 1, s, s2.
        derivatives: `differences` of the target, or `target`, as the numerical part gives them.
        step: main step, s.
    """
    a0, a1, a2 = alpha.tolist()
    if derivatives != "differences":
        return DifferenceEquation((Term("target", 0, a0), Term("velocity", 0, a1), Term("acceleration", 0, a2)))
    first, second = a1 / step, a2 / step**2
    lags = (a0 + first + second, -first - 2.0 * second, second)
    return DifferenceEquation(tuple(Term("target", lag, one) for lag, one in enumerate(lags)))


def converged_series(
    described: kinds.AtsCompensator | kinds.ModifiedAtsCompensator, rig: Transfer, motion: np.ndarray, step: float
) -> np.ndarray:
    """Return alpha_0 (-), alpha_1 (s), alpha_2 (s2) of the least squares.

    For a slow motion they are the series of the inverse rig.

    Args:
        rig: its transfer function.
        motion: (n,) target, m.
        step: main step, s.

    Returns:
        (3,) coefficients: -, s, s2.
    """
    s = 2j * np.pi * np.fft.rfftfreq(motion.size, step)[1:]
    weight = np.abs(np.fft.rfft(motion))[1:]
    if (filtered := described.filter) is not None:
        weight = weight / np.sqrt(1.0 + (np.abs(s) / (2.0 * np.pi * filtered.cutoff)) ** (2 * filtered.order))
    kept = weight > 1e-6 * weight.max()  # the rest is rounding, and a rig may have no inverse up there
    s, weight = s[kept], weight[kept]
    first, second = _differences(step)(s)
    rows = np.column_stack([np.ones_like(s), first, second]) * weight[:, None]
    wanted = weight / rig(s)
    size = np.linalg.norm(rows, axis=0)
    rows, wanted = np.vstack([rows.real, rows.imag]) / size, np.concatenate([wanted.real, wanted.imag])
    return np.asarray(np.linalg.lstsq(rows, wanted, rcond=None)[0] / size)


def _differences(step: float) -> Callable[[np.ndarray], tuple[np.ndarray, np.ndarray]]:
    def derivatives(s: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        first = -np.expm1(-s * step) / step
        return first, first**2

    return derivatives
