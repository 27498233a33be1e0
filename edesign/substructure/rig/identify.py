"""A rig from a measured command and displacement: delay, order, gain and noise by least squares on its response."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from edesign.errors import InputError
from edesign.project.substructure.quantities import MOST_DELAY
from edesign.substructure.compensation.alpha_fit import fitted_alpha
from edesign.substructure.indicators.correlation_delay import correlation_delay
from edesign.substructure.indicators.frequency_index import equivalent_frequency
from edesign.substructure.indicators.undetermined import Undetermined
from edesign.substructure.judgement.measured import MeasuredRecord, clipped, read_measured
from edesign.substructure.rig.rig_fit import ORDERS, STIFFEST, RigFit, fit_rig
from edesign.substructure.rig.rig_response import rig_response

PERIODS = 5.0
"""Of the command's mean frequency that a record needs: fewer do not separate delay from damping."""
CLEARLY = 10.0
"""By which the criterion must fall for a higher order: "very strong" of Kass & Raftery (1995)."""
SURE = 4.0
"""Standard errors by which a lead or a drift is beyond chance: one record in thirty thousand."""
ACCURACY = 2e-4
"""s: accuracy of a delay that is asked for; a drift of less does not matter."""
PARTS = 6
"""Of a record, whose delays show a drift. A line through them leaves four degrees of freedom for their scatter, and
each has most of a period of the shortest record."""
COLOURED = 0.5
"""Share of independent samples below which what is left is not white noise: half is what is left where neighbours
correlate by 0.58 and others by its powers, 1/(sum of squared autocorrelation)."""
UNIT_SLIP = 2.54**0.5
"""Halfway, as a factor, from a gain of 1 to the least mistake of units: an inch for a centimetre."""
_AT_BOUND = 0.99
"""Of the highest frequency: from here on it is undetermined. A search ends within a hundredth of a bound it meets."""


@dataclass(frozen=True)
class IdentifiedRig:
    """Properties of a rig that a record shows.

    Attributes:
        source: the file.
        step: between samples, s.
        samples: how many.
        chosen: the rig.
        tried: one of each order that was tried.
        criteria: Bayesian information criterion of each of them, less that of the best.
        why: this order.
        alpha: alpha_0 (-), alpha_1 (s), alpha_2 (s2) by least squares on the record.
        alpha_of_rig: the same by the series of the inverse rig.
        notes: what to mind, for people.
    """

    source: Path
    step: float
    samples: int
    chosen: RigFit
    tried: tuple[RigFit, ...]
    criteria: tuple[float, ...]
    why: str
    alpha: tuple[float, float, float]
    alpha_of_rig: tuple[float, float, float]
    notes: tuple[str, ...]


def identify(path: Path | str, order: int | None = None) -> IdentifiedRig:
    """Find the rig of a record with its command and the measured displacement.

    Args:
        path: CSV with time, command, displacement.
        order: 0 (delay and gain), 1 or 2; None: the one that the record asks for.

    Raises:
        InputError: the file cannot be read, or no rig can have made the record so; the message says why.
    """
    if order is not None and order not in ORDERS:
        raise InputError(f"order: a rig of order 0, 1 or 2 can be found, not {order} [E-VALUE-02]")
    record = read_measured(path, "command", "displacement")
    u, x, step = record["command"], record["displacement"], record.step
    late = _delay_at_first(record)
    _refuse_no_delay(record, late)
    asked = ORDERS if order is None else (order,)
    tried = tuple(fit_rig(record, one, late) for one in asked)
    criteria = _criteria(tried, u.size)
    chosen = next(fit for fit, value in zip(tried, criteria, strict=True) if value <= CLEARLY)
    _refuse_other_units(record, chosen.parameters["gain"].value)
    _refuse_drift(record, chosen)
    a0, a1, a2 = chosen.transfer.inverse_series(2)
    return IdentifiedRig(
        source=record.path,
        step=step,
        samples=u.size,
        chosen=chosen,
        tried=tried,
        criteria=criteria,
        why=_why(chosen, tried, criteria, order),
        alpha=fitted_alpha(u, x, step),
        alpha_of_rig=(a0, a1, a2),
        notes=_notes(record, chosen),
    )


def _delay_at_first(record: MeasuredRecord) -> float:
    """Delay by correlation, s, of a record that can be one of a rig."""
    u, x, path = record["command"], record["displacement"], record.path
    if (level := clipped(x)) is not None:
        raise InputError(
            f"{path}: the displacement is cut off at {1e3 * level:.4g} mm: range of the encoder, or stroke [E-MEAS-03]"
        )
    frequency, duration = equivalent_frequency(u, record.step), record.step * (u.size - 1)
    if duration * frequency < PERIODS:
        raise InputError(
            f"{path}: {duration:.3g} s are too short: at the command's {frequency:.3g} Hz at least "
            f"{PERIODS / frequency:.3g} s are needed [E-RIG-01]"
        )
    try:
        return correlation_delay(u, x, record.step).delay
    except Undetermined as reason:
        undetermined = str(reason)
    if _delay(u, -x, record.step) is not None:
        raise InputError(
            f"{path}: the displacement goes against the command: one of both has the opposite sign [E-RIG-02]"
        )
    delays = [_delay(u[part], x[part], record.step) for part in _parts(u.size)]
    parts = [delay for delay in delays if delay is not None]
    if len(parts) == len(delays) and np.ptp(parts) > ACCURACY:
        raise InputError(_two_clocks(path, 1e3 * parts[0], 1e3 * parts[-1]))
    words = undetermined.replace("target", "command").replace("measured channel", "displacement")
    raise InputError(f"{path}: {words}; is this the displacement of that command? [E-RIG-01]")


def _refuse_other_units(record: MeasuredRecord, gain: float) -> None:
    """Refuse a gain that is nearer to the least mistake of units than to 1."""
    if not 1.0 / UNIT_SLIP <= gain <= UNIT_SLIP:
        raise InputError(
            f"{record.path}: the displacement is {gain:.4g} times the command: are both columns in the units of their "
            "headers? [E-RIG-02]"
        )


def _refuse_no_delay(record: MeasuredRecord, late: float) -> None:
    """A rig that runs ahead by more than a sample, or that is later than any: the columns are swapped, or shifted."""
    if late < -record.step:
        raise InputError(
            f"{record.path}: the displacement leads the command by {-1e3 * late:.3g} ms: are their columns swapped?"
            " [E-RIG-02]"
        )
    if late > MOST_DELAY:
        raise InputError(
            f"{record.path}: the displacement is {late:.3g} s late, and no rig is: is a column shifted? [E-RIG-02]"
        )


def _refuse_drift(record: MeasuredRecord, fit: RigFit) -> None:
    """A delay that grows steadily through the record, beside the rig's own."""
    made = rig_response(fit.transfer, record["command"], record.step)
    x, step = record["displacement"] - fit.offset, record.step
    delays, errors, middles = [], [], []
    for part in _parts(x.size):
        delay = _delay(made[part], x[part], step)
        if delay is None:
            continue
        speed = np.diff(made[part]) / step
        delays.append(delay)
        errors.append(fit.noise / math.sqrt(float(np.sum(speed**2)) * fit.independent))
        middles.append(step * 0.5 * (part.start + part.stop))
    if len(delays) < 3:
        return
    drift, error = _slope(np.array(middles), np.array(delays), np.array(errors))
    duration = step * x.size
    if abs(drift) > SURE * error and abs(drift) * duration > ACCURACY:
        middle = fit.low_frequency_delay.value
        begin, end = (1e3 * (middle + side * 0.5 * drift * duration) for side in (-1.0, 1.0))
        raise InputError(_two_clocks(record.path, begin, end))


def _two_clocks(path: Path, begin: float, end: float) -> str:
    return (
        f"{path}: the delay drifts from {begin:.3g} to {end:.3g} ms: command and displacement have two clocks, or the "
        "rig changes; record both on one clock [E-RIG-03]"
    )


def _slope(at: np.ndarray, values: np.ndarray, errors: np.ndarray) -> tuple[float, float]:
    """Slope of a line through values with errors, and its standard error, by the scatter about the line if larger."""
    weight = errors**-2
    centred = at - np.sum(weight * at) / np.sum(weight)
    spread = float(np.sum(weight * centred**2))
    slope = float(np.sum(weight * centred * values)) / spread
    left = values - np.sum(weight * values) / np.sum(weight) - slope * centred
    scatter = float(np.sum(weight * left**2)) / (values.size - 2)
    return slope, math.sqrt(max(scatter, 1.0) / spread)


def _delay(u: np.ndarray, x: np.ndarray, step: float) -> float | None:
    try:
        return correlation_delay(u, x, step).delay
    except Undetermined:
        return None


def _parts(samples: int) -> list[slice]:
    edges = np.linspace(0, samples, PARTS + 1).astype(int)
    return [slice(int(a), int(b)) for a, b in zip(edges[:-1], edges[1:], strict=True)]


def _criteria(fits: Sequence[RigFit], samples: int) -> tuple[float, ...]:
    """Bayesian information criteria by as many independent samples as the highest order leaves, less the least."""
    count = max(fits[-1].independent * samples, 2.0)
    values = [2.0 * count * math.log(max(fit.left, 1e-300)) + len(fit.parameters) * math.log(count) for fit in fits]
    return tuple(value - min(values) for value in values)


def _why(chosen: RigFit, tried: Sequence[RigFit], criteria: Sequence[float], asked: int | None) -> str:
    """Why a rig has its order, in words."""
    if asked is not None:
        return f"order {asked}, as asked for"
    pairs = zip(tried, criteria, strict=True)
    lower = [f"order {fit.order} by {value:.0f}" for fit, value in pairs if fit.order < chosen.order]
    higher = [fit for fit in tried if fit.order > chosen.order]
    behind = f"the criterion (BIC) is worse with {', '.join(lower)}" if lower else ""
    enough = f"a higher order does not lower the criterion (BIC) by {CLEARLY:g}" if higher else ""
    return f"order {chosen.order}: {'; '.join(text for text in (behind, enough) if text)}"


def _notes(record: MeasuredRecord, chosen: RigFit) -> tuple[str, ...]:
    notes = []
    if chosen.independent < COLOURED:
        notes.append(
            f"what is left ({100.0 * chosen.left:.2g} % of the displacement) is not white noise: the rig does more "
            "than a linear one of this order, and `encoder_noise` holds that too"
        )
    own = chosen.parameters.get("frequency")
    if own is not None and own.value > _AT_BOUND * STIFFEST / record.step:
        notes.append("the natural frequency is not determined: it is beyond half the sampling rate; take a lower order")
    if record.unread:
        notes.append(f"not read: {', '.join(f'`{header}`' for header in record.unread)}")
    return tuple(notes)
