"""The shape of a residual in one or two plain sentences."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
from scipy.interpolate import CubicSpline

from edesign.calibration.residual.curves import FreeCurve, plainest, symmetry_of
from edesign.calibration.residual.cycles import Cycles
from edesign.calibration.residual.pool import DRIVERS, Pool
from edesign.calibration.residual.series import Residual
from edesign.calibration.residual.tones import Tone, find_tones
from edesign.calibration.residual.whiteness import effective_samples, structured_share
from edesign.calibration.signals.noise import smooth

WORTH_TELLING = 0.1
"""Share of the squared residual."""

_RARE = 1e-3  # probability by chance
_NOISE = 0.05  # structured share below which only noise is left
_MOST = 3  # things named
NEARLY = 0.85
"""Of the share of the best: something simpler that has it is named in its place."""
_ALIKE = 0.98  # the same: as well
_MONOTONE = 0.75  # rank correlation
_SMOOTH = ("displacement", "velocity")  # what curves are over
_STATES = ("displacement", "velocity", "sign of velocity")
_BOTH = ("time", "test order", "temperature")  # offsets change with them as well as factors
_SCALES = {"m": (1e3, "mm"), "m/s": (1e3, "mm/s")}
_LAG_STEPS, _LAG_ENOUGH = 8, 1e-4  # of Gauss-Newton; of a standard error of the lag


@dataclass(frozen=True)
class _Thing:
    """Something a residual is like: its share beyond chance, what it takes away, and words."""

    share: float
    fitted: np.ndarray
    words: str
    driver: str = ""
    judged: str = ""  # by which tests, if not by all


def describe_residual(
    tests: Sequence[Residual], motions: Sequence[Cycles] | None = None, curves: Sequence[FreeCurve] = ()
) -> str:
    """Return what is left, how much of it is structure, and what that depends on.

    Things are taken one after another, each the one that explains most of what those before have left; at most three,
    of at least 10 % of the squared residual.

    Args:
        tests: residuals, one at least.
        motions: of each, where they are known.
        curves: smooth functions of displacement and velocity fitted to the residual, where there are any; they stand
            first for what depends on these.
    """
    motions = motions or [Cycles(test.time, test.displacement) for test in tests]
    names = {test.order: test.name for test in tests}
    pool = Pool(tests, motions, [effective_samples(test.residual) for test in tests], find_lag(tests))
    total = float(pool.error @ pool.error)
    if total == 0.0:
        return "Nothing is left."
    weights = np.array([float(np.sum(test.residual**2)) / test.rms_force**2 for test in tests])
    shares = [structured_share(motion, test.residual) for test, motion in zip(tests, motions, strict=True)]
    structured = float(weights @ shares) / total
    left = f"{100.0 * total / pool.error.size:.2g} % of the squared force of all tests is left"
    hum = _tones([find_tones(motion, test.residual) for test, motion in zip(tests, motions, strict=True)])
    if structured < _NOISE:
        return f"{left}, all of it noise{' but ' + hum if hum else ''}."
    rest = pool.error
    named: list[str] = []
    while len(named) < _MOST:
        best = _best(rest, pool, names, () if named else _smooth(tests, plainest(curves, NEARLY)))
        share = best.share * float(rest @ rest) / total if best else 0.0
        if best is None or share < WORTH_TELLING:
            break
        named.append(f"{best.words} ({100.0 * share:.0f} %{best.judged})")
        rest = rest - best.fitted
    first = f"{left}, {100.0 * structured:.0f} % of it structure in the band of the motion"
    like = f" It is like {', then '.join(named)}." if named else " None of the quantities examined explains it."
    return f"{first}{', beside ' + hum if hum else ''}.{like}"


def _best(error: np.ndarray, pool: Pool, names: Mapping[int, str], smooth: Sequence[_Thing]) -> _Thing | None:
    """What explains most; something simple if it explains nearly as much as the best of the others."""
    simple = max(_simple(error, pool), key=lambda thing: thing.share, default=None)
    binned = (thing for thing in _binned(error, pool, names) if not smooth or thing.driver not in _SMOOTH)
    every = sorted((*smooth, *binned), key=lambda thing: -thing.share)
    if not every:
        return simple
    first = every[0]
    others = [thing.driver for thing in every[1:] if thing.share > _ALIKE * first.share]
    others = [driver for driver in dict.fromkeys(others) if driver != first.driver]
    if others:
        first = replace(first, words=f"{first.words}, or as well with the {' or the '.join(others)}")
    if simple is None:
        return first
    return simple if simple.share > NEARLY * first.share else first


def _smooth(tests: Sequence[Residual], curve: FreeCurve | None) -> list[_Thing]:
    """The curve, as a thing."""
    if curve is None or not curve.share:
        return []
    forces = [curve.force(test.displacement, test.velocity) / test.rms_force for test in tests]
    return [_Thing(curve.share, np.concatenate(forces), curve.words, curve.of, " of the validation tests")]


def _simple(error: np.ndarray, pool: Pool) -> Iterator[_Thing]:
    """Things with one coefficient."""
    for regressor, words in (
        (np.ones_like(error), lambda c: f"a constant force, {_signed(c)} of the rms force"),
        (pool.predicted, lambda c: f"a factor on the whole force, {_signed(c)}"),
        (pool.late, lambda c: f"a force {1e3 * abs(c * pool.lag):.3g} ms {'late' if c * pool.lag > 0.0 else 'early'}"),
    ):
        power = float(regressor @ regressor)
        coefficient = float(error @ regressor) / power if power > 0.0 else 0.0
        share = coefficient**2 * power / max(float(error @ error), np.finfo(float).tiny)
        if pool.p_value(share, 2) < _RARE:
            yield _Thing(share - 1.0 / pool.independent, coefficient * regressor, words(coefficient))


def _binned(error: np.ndarray, pool: Pool, names: Mapping[int, str]) -> Iterator[_Thing]:
    """Things with a coefficient in each bin of a driver: states of a cycle as a force, slow ones as a factor."""
    for driver, number in pool.number.items():
        count = np.bincount(number)
        centre = np.bincount(number, pool.values[driver]) / count
        for action, regressor in (("force", np.ones_like(error)), ("factor", pool.predicted)):
            if action != ("force" if driver in _STATES else "factor") and driver not in _BOTH:
                continue
            part = pool.explained(error, regressor, number)
            if pool.p_value(part.share, count.size) < _RARE:
                state = driver in _STATES
                text = (
                    _state(driver, centre, part.coefficient)
                    if state
                    else _slow(driver, action, _places(driver, centre, names), centre, part.coefficient)
                )
                yield _Thing(part.whole - pool.chance(count.size + 1), part.fitted, text, driver)


def _state(driver: str, centre: np.ndarray, mean: np.ndarray) -> str:
    """Words for a force that depends on the displacement or velocity: even or odd."""
    if driver == "sign of velocity":
        return f"a force with the sign of the velocity, {_signed(0.5 * (mean[-1] - mean[0]))} of the rms force"
    symmetry = symmetry_of(centre, mean)
    if symmetry:
        return f"a force {symmetry} in the {driver}"
    return f"a force that depends on the {driver}{', on one side' if symmetry is None else ''}"


def _places(driver: str, centre: np.ndarray, names: Mapping[int, str]) -> list[str]:
    """Where each bin (b,) of a driver is: a value with its unit, of the order of tests the name of the nearest one."""
    if driver == "test order":
        return [f"in {names[min(names, key=lambda order: abs(order - one))]}" for one in centre.tolist()]
    scale, unit = _SCALES.get(DRIVERS[driver][0], (1.0, DRIVERS[driver][0]))
    return [f"at {scale * one:.3g} {unit}".strip() for one in centre.tolist()]


def _slow(driver: str, action: str, places: Sequence[str], centre: np.ndarray, mean: np.ndarray) -> str:
    """Words for a force or factor that changes slowly: up, down, or where it is largest."""
    from scipy.stats import spearmanr  # takes a second; most calibrations have no need of it

    low, high = float(mean[0]), float(mean[-1])
    rank = float(spearmanr(centre, mean).statistic) if centre.size > 2 else float(np.sign(high - low))
    if abs(rank) >= _MONOTONE:
        verb = "rises" if rank > 0.0 else "falls"
        return f"a {action} that {verb} with the {driver} from {_signed(low)} to {_signed(high)}"
    at = int(np.argmax(np.abs(mean)))
    return f"a {action} that depends on the {driver}, {_signed(mean[at])} {places[at]}"


def _signed(share: float) -> str:
    return f"{100.0 * share:+.2g} %"


def _tones(tones: Sequence[Sequence[Tone]]) -> str:
    """The strongest tone and in how many tests it is."""
    every = [tone for one in tones for tone in one]
    if not every:
        return ""
    strongest = max(every, key=lambda tone: tone.amplitude)
    alike = sum(any(abs(tone.frequency / strongest.frequency - 1.0) < 0.01 for tone in one) for one in tones)
    size = f"{1e-3 * strongest.amplitude:.3g} kN, in {alike} of {len(tones)} tests"
    return f"a tone of {strongest.frequency:.4g} Hz ({size})"


def find_lag(tests: Sequence[Residual]) -> float:
    """Return the lag with the least squared residual, s; above zero if the measured force is late.

    The residual is taken on the slope of the prediction, again and again with the shifted one. Each test counts by its
    rms force.
    """
    shapes = [_Late(test) for test in tests]
    lag, best, step = 0.0, np.inf, 0.0
    for _ in range(_LAG_STEPS):
        pairs = [shape.shifted(lag + step) for shape in shapes]
        squares = sum(float(r @ r) for r, _ in pairs)
        if squares > best:
            step *= 0.5
            continue
        lag, best = lag + step, squares
        normal = sum(float(v @ v) for _, v in pairs)
        if normal <= 0.0 or squares <= 0.0:
            break
        scatter = sum(float(r @ r) * float(v @ v) / effective_samples(r) for r, v in pairs)
        step = -sum(float(r @ v) for r, v in pairs) / normal
        if abs(step) <= _LAG_ENOUGH * float(np.sqrt(scatter)) / normal:
            break
    return lag


class _Late:
    """A test with its prediction as a spline without noise, over its rms force."""

    def __init__(self, test: Residual) -> None:
        self.time, self.measured = test.time, test.measured / test.rms_force
        predicted = test.predicted / test.rms_force
        clean = smooth(test.time, predicted)[0]
        self.rest = predicted - clean  # stays where it is
        self.spline = CubicSpline(test.time, clean)

    def shifted(self, lag: float) -> tuple[np.ndarray, np.ndarray]:
        """Residual and slope of the prediction at a lag."""
        at = np.clip(self.time - lag, self.time[0], self.time[-1])
        return self.measured - self.rest - self.spline(at), self.spline(at, 1)
