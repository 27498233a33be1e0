"""Cross checks of compensators against the main step, and of their coefficients against their limits."""

from __future__ import annotations

from edesign.project.reading.problems import Keys, Problems
from edesign.project.substructure.checks_rig import corner, nyquist
from edesign.project.substructure.compensators import (
    AtsCompensator,
    Compensator,
    Filter,
    FixedAlphaCompensator,
    LeastSquaresPolynomialCompensator,
    LinearAccelerationCompensator,
    LiveDelayCompensator,
    ModelFeedforwardCompensator,
    ModifiedAtsCompensator,
    PhaseLeadCompensator,
    PiPhaseLeadCompensator,
    PolynomialCompensator,
    SmithCompensator,
)
from edesign.project.substructure.rig import ServoHydraulicRig
from edesign.project.substructure.rts_file import RtsFile

MOST_STEPS_BACK = 1000
"""Main steps that a compensator looks back; the ring of core_c/include/edcompensator.h has 1024."""
MOST_WINDOW = 4096
"""Main steps in the window of ATS; as ED_COMPENSATOR_WINDOW there."""
FEWEST_SAMPLES = 3
"""For three coefficients."""
TAKEN = ("time", "ground", "direct_deformation", "direct_force")
"""What stands in an archive beside the compensators of a test."""
_UNITS = {"a0": (1.0, ""), "a1": (1e3, " ms"), "a2": (1.0, " s^2")}


def check_compensators(rts: RtsFile, problems: Problems) -> None:
    """Check all compensators; the rig of the file is known."""
    for name, compensator in rts.compensators.items():
        if name in TAKEN:
            problems.at_key(
                ("compensators", name), f"`{name}` is a history of the archive; choose another name [E-NAME-03]"
            )
        _check(rts, compensator, ("compensators", name), problems)


def _check(rts: RtsFile, compensator: Compensator, keys: Keys, problems: Problems) -> None:
    if isinstance(compensator, (PolynomialCompensator, LeastSquaresPolynomialCompensator)):
        _polynomial(rts, compensator, keys, problems)
    elif isinstance(compensator, LinearAccelerationCompensator):
        _at_least_a_step(rts, compensator.delay, keys, "takes the acceleration of a delay ago", problems)
    elif isinstance(compensator, (AtsCompensator, ModifiedAtsCompensator)):
        _adaptive(rts, compensator, keys, problems)
    elif isinstance(compensator, LiveDelayCompensator):
        _live_delay(rts, compensator, keys, problems)
    elif isinstance(compensator, (PhaseLeadCompensator, PiPhaseLeadCompensator)):
        _lead(rts, compensator, keys, problems)
    elif isinstance(compensator, FixedAlphaCompensator):
        _positive_a0(compensator.alpha[0], (*keys, "alpha", 0), problems)
    elif isinstance(compensator, ModelFeedforwardCompensator):
        _feedforward(rts, compensator, keys, problems)
    elif isinstance(compensator, SmithCompensator):
        _looks_back(rts, compensator.delay, (*keys, "delay"), problems)


# --- polynomials and delays


def _polynomial(
    rts: RtsFile,
    compensator: PolynomialCompensator | LeastSquaresPolynomialCompensator,
    keys: Keys,
    problems: Problems,
) -> None:
    if isinstance(compensator, LeastSquaresPolynomialCompensator):
        if compensator.points <= compensator.order:
            message = (
                f"{compensator.points} points do not determine a polynomial of order {compensator.order}; at least"
            )
            problems.at_value((*keys, "points"), f"{message} {compensator.order + 1} are needed [E-RTS-04]")
    elif compensator.spacing == "delay" and compensator.order > 0:
        _at_least_a_step(rts, compensator.delay, keys, "takes targets a delay apart (`spacing: delay`)", problems)
        _looks_back(rts, compensator.order * compensator.delay, (*keys, "delay"), problems)


def _at_least_a_step(rts: RtsFile, delay: float, keys: Keys, why: str, problems: Problems) -> None:
    if delay < rts.loop.main_step * (1.0 - 1e-9):
        message = f"{1e3 * delay:.4g} ms is less than the main step, {1e3 * rts.loop.main_step:.4g} ms; the compensator"
        problems.at_value((*keys, "delay"), f"{message} {why} [E-VALUE-04]")


def _looks_back(rts: RtsFile, time: float, keys: Keys, problems: Problems) -> None:
    if time > MOST_STEPS_BACK * rts.loop.main_step:
        steps = round(time / rts.loop.main_step)
        problems.at_value(keys, f"it looks back {steps} main steps; at most {MOST_STEPS_BACK} are kept [E-VALUE-02]")


def _live_delay(rts: RtsFile, compensator: LiveDelayCompensator, keys: Keys, problems: Problems) -> None:
    low, high = compensator.limits
    if _ascending(compensator.limits, (*keys, "limits"), "a1", problems) and not low <= compensator.delay <= high:
        at = (*keys, "delay")
        problems.at_value(
            at, f"{_shown('a1', compensator.delay)} is outside its limits, {_range('a1', low, high)} [E-VALUE-02]"
        )
    _looks_back(rts, compensator.order * high, (*keys, "limits"), problems)


# --- adaptive time series


def _adaptive(
    rts: RtsFile, compensator: AtsCompensator | ModifiedAtsCompensator, keys: Keys, problems: Problems
) -> None:
    for i, name in enumerate(("a0", "a1", "a2")):
        _limits(compensator, i, name, keys, problems)
    if compensator.limits.a0[0] <= 0.0:
        _positive_a0(compensator.limits.a0[0], (*keys, "limits", "a0", 0), problems)
    if compensator.filter is not None:
        _filter(rts, compensator.filter, (*keys, "filter"), problems)
    if isinstance(compensator, AtsCompensator):
        _window(rts, compensator, keys, problems)
    elif (1.0 - compensator.forgetting) * FEWEST_SAMPLES > 1.0:
        samples = 1.0 / (1.0 - compensator.forgetting)
        message = (
            f"{compensator.forgetting:g} remembers {samples:.2g} samples, 1 / (1 - forgetting); three coefficients"
        )
        problems.at_value((*keys, "forgetting"), f"{message} need {FEWEST_SAMPLES} at least [E-RTS-04]")


def _filter(rts: RtsFile, chosen: Filter, keys: Keys, problems: Problems) -> None:
    if chosen.order % 2:
        problems.at_value(
            (*keys, "order"), f"{chosen.order} is odd; the filter is made of sections of second order [E-VALUE-02]"
        )
    if chosen.cutoff >= nyquist(rts):
        message = (
            f"{chosen.cutoff:.4g} Hz is not below half the rate of the main step, {nyquist(rts):.4g} Hz [E-VALUE-04]"
        )
        problems.at_value((*keys, "cutoff"), message)


def _limits(
    compensator: AtsCompensator | ModifiedAtsCompensator, i: int, name: str, keys: Keys, problems: Problems
) -> None:
    """Limits ascend, and what the coefficient begins with lies between them."""
    limits: tuple[float, float] = getattr(compensator.limits, name)
    if not _ascending(limits, (*keys, "limits", name), name, problems):
        return
    initial = compensator.initial[i]
    if not limits[0] <= initial <= limits[1]:
        at: Keys = (*keys, "initial", i) if "initial" in compensator.model_fields_set else (*keys, "limits", name)
        message = (
            f"{name} begins with {_shown(name, initial)}, outside its limits, {_range(name, *limits)} [E-VALUE-02]"
        )
        problems.at_value(at, message)


def _ascending(limits: tuple[float, float], keys: Keys, name: str, problems: Problems) -> bool:
    if limits[0] < limits[1]:
        return True
    low, high = (_shown(name, value) for value in limits)
    problems.at_value(keys, f"the lower limit, {low}, is not below the upper one, {high} [E-VALUE-04]")
    return False


def _window(rts: RtsFile, compensator: AtsCompensator, keys: Keys, problems: Problems) -> None:
    steps = compensator.window / rts.loop.main_step
    at = (*keys, "window")
    shown = f"{compensator.window:.6g} s"
    if abs(steps - round(steps)) > 1e-6 * steps:
        message = f"{shown} is no multiple of the main step, {1e3 * rts.loop.main_step:.6g} ms [E-RTS-04]"
        problems.at_value(at, message)
    elif round(steps) > MOST_WINDOW:
        problems.at_value(at, f"{shown} has {round(steps)} main steps; at most {MOST_WINDOW} are kept [E-VALUE-02]")
    samples = _samples(round(steps), compensator.every)
    if samples < FEWEST_SAMPLES:
        message = f"{shown} has {samples} samples, 1 in {compensator.every} main steps; three coefficients need"
        problems.at_value(at, f"{message} {FEWEST_SAMPLES} at least [E-RTS-04]")


def _samples(steps: int, every: int) -> int:
    """Return how many samples are taken of so many steps, the first one among them."""
    return -(-steps // every)


# --- others


def _lead(
    rts: RtsFile, compensator: PhaseLeadCompensator | PiPhaseLeadCompensator, keys: Keys, problems: Problems
) -> None:
    if isinstance(compensator, PhaseLeadCompensator) and compensator.lead <= compensator.lag:
        message = (
            f"{1e3 * compensator.lead:.4g} ms is not longer than `lag`; the command would be late, not early"
            " [E-VALUE-04]"
        )
        problems.at_value((*keys, "lead"), message)
    if corner(compensator.lag) >= nyquist(rts):
        message = f"its corner, {corner(compensator.lag):.4g} Hz, is not below half the rate of the main step"
        problems.at_value((*keys, "lag"), f"{message}, {nyquist(rts):.4g} Hz [E-VALUE-04]")


def _feedforward(rts: RtsFile, compensator: ModelFeedforwardCompensator, keys: Keys, problems: Problems) -> None:
    if compensator.alpha is not None:
        _positive_a0(compensator.alpha[0], (*keys, "alpha", 0), problems)
    elif isinstance(rts.plant, ServoHydraulicRig):
        message = (
            "this key is missing; a servo-hydraulic rig depends on its specimen, and has no series of its own"
            " [E-KEY-02]"
        )
        problems.under(keys, "alpha", message)


def _positive_a0(a0: float, keys: Keys, problems: Problems) -> None:
    if a0 <= 0.0:
        problems.at_value(
            keys, f"a0 is {a0:g}, and must be greater than 0: the command goes the way of the target [E-VALUE-02]"
        )


def _shown(name: str, value: float) -> str:
    factor, unit = _UNITS[name]
    return f"{factor * value:.4g}{unit}"


def _range(name: str, low: float, high: float) -> str:
    return f"{_shown(name, low)} to {_shown(name, high)}"
