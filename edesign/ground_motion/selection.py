"""The best k of many records: the code's criteria hold, their mean is near the target, and their scatter is small.

The deviation of the mean spectrum is that of REXEL (Iervolino, Galasso & Cosenza 2010, Bulletin of Earthquake
Engineering 8, 339-362), the search that of Jayaram, Lin & Baker (2011, Earthquake Spectra 27, 797-815): greedy, then
exchanges.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Hashable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from edesign.codes import Spectrum
from edesign.codes.motion_sets import SetCheck, SetRules
from edesign.errors import InputError
from edesign.ground_motion.record import Record
from edesign.ground_motion.response_spectrum import psa
from edesign.ground_motion.selection_scaling import Library, Scaling, SelectionOptions
from edesign.ground_motion.selection_search import Cap, search


@dataclass(frozen=True)
class Selection:
    """The chosen records and how well they do.

    Attributes:
        chosen: indices into the candidates, rising.
        factors: of the chosen ones, dimensionless.
        common_factor: the part of them that all share.
        periods: of the spectra, s.
        mean_before, mean_after: mean spectrum of the chosen ones unscaled and scaled, m/s2.
        deviation: rms of mean_after / target - 1 over the band.
        scatter: rms over the band of the records' standard deviation (population) / target.
        largest_deviation: largest |mean_after / target - 1| over the band.
        before, after: the criteria of the code for the chosen ones unscaled and scaled.
        exhaustive: every admissible choice was compared; otherwise greedy with exchanges.
    """

    chosen: tuple[int, ...]
    factors: np.ndarray
    common_factor: float
    periods: np.ndarray
    mean_before: np.ndarray
    mean_after: np.ndarray
    deviation: float
    scatter: float
    largest_deviation: float
    before: SetCheck
    after: SetCheck
    exhaustive: bool


def select(
    periods: ArrayLike,
    spectra: ArrayLike,
    pgas: ArrayLike,
    target: Spectrum,
    T_1: float,
    count: int,
    options: SelectionOptions | None = None,
    events: Sequence[str] | None = None,
    stations: Sequence[str] | None = None,
) -> Selection:
    """Choose the `count` records that do best; the same input gives the same choice.

    A choice that meets the criteria of the target's code goes before one that does not; among those the smaller
    deviation2 + scatter_weight scatter2 goes first; where none meets them, the one that falls short by least.

    Args:
        periods: shape (n_T,), s, as for `SetRules.check`; they may reach beyond its band.
        spectra: pseudo-acceleration at 5 % damping as recorded, shape (n, n_T), m/s2.
        pgas: peak ground acceleration as recorded, shape (n,), m/s2.
        target: elastic spectrum at 5 % damping.
        T_1: fundamental period of the structure, s.
        count: how many records are wanted.
        options: how they may be scaled and how they are compared.
        events: earthquake of each candidate, for `options.max_per_event`.
        stations: station of each candidate, for `options.max_per_station`; it counts within an earthquake.

    Raises:
        InputError: too few candidates, shapes that do not fit, or spectra that are not positive.
    """
    options = options or SelectionOptions()
    T, library_psa, pga = (np.asarray(values, dtype=float) for values in (periods, spectra, pgas))
    target.set_rules.check(T, library_psa, pga, target, T_1)  # raises for shapes and periods
    if np.any(library_psa <= 0.0) or np.any(pga <= 0.0):
        raise InputError("a candidate has a spectral ordinate of zero: it cannot be scaled to a target [E-MATCH-05]")
    caps = _caps(options, events, stations, len(pga))
    _enough(caps, count, len(pga))
    library = Library(T, library_psa, pga, target, T_1, options)
    found, exhaustive = search(library, caps, count, options.exhaustive_limit)
    scaling = library.scale(np.array([found]))
    return _selection(library, found, scaling, exhaustive)


def select_records(
    records: Sequence[Record],
    target: Spectrum,
    T_1: float,
    count: int,
    options: SelectionOptions | None = None,
    events: Sequence[str] | None = None,
) -> Selection:
    """Choose among records; their spectra are computed on 201 periods a decade.

    Args:
        records: the candidates.
        target: spectrum of the action.
        T_1: fundamental period, s.
        count: how many are chosen.
        events: earthquake of each record; None: they are not known.

    Returns:
        The choice, as of `select`.

    Raises:
        InputError: as `select`.
    """
    options = options or SelectionOptions()
    T = selection_periods(target.set_rules, T_1, options)
    spectra = np.array([psa(record.acceleration, record.time_step, T) for record in records])
    pgas = np.array([record.pga for record in records])
    return select(T, spectra, pgas, target, T_1, count, options, events)


def selection_periods(rules: SetRules, T_1: float, options: SelectionOptions) -> np.ndarray:
    """Return the periods of the code's check, and beyond them those of the band of the options, equally dense.

    Args:
        T_1: fundamental period, s.

    Returns:
        (n,) s, rising.
    """
    inner = rules.check_periods(T_1)
    step = inner[1] / inner[0]
    low, high = options.band or rules.period_band(T_1)
    below = max(0, int(np.ceil(np.log(inner[0] / low) / np.log(step) - 1e-9)))
    above = max(0, int(np.ceil(np.log(high / inner[-1]) / np.log(step) - 1e-9)))
    left = inner[0] * step ** np.arange(-below, 0)
    right = inner[-1] * step ** np.arange(1, above + 1)
    return np.concatenate((left, inner, right))


def _caps(
    options: SelectionOptions, events: Sequence[str] | None, stations: Sequence[str] | None, n: int
) -> tuple[Cap, ...]:
    """How many of an earthquake, and of a station in it, may be chosen."""
    wanted = (("max_per_event", options.max_per_event, events), ("max_per_station", options.max_per_station, stations))
    for key, most, labels in wanted:
        if most is not None and (labels is None or len(labels) != n):
            raise InputError(f"{key} needs the {key.removeprefix('max_per_')} of each candidate [E-MATCH-06]")
    caps = []
    if options.max_per_event is not None and events is not None:
        caps.append(Cap(tuple(events), options.max_per_event, "event"))
    if options.max_per_station is not None and stations is not None:
        within = events if events is not None else [""] * n
        caps.append(Cap(tuple(zip(within, stations, strict=True)), options.max_per_station, "station"))
    return tuple(caps)


def _enough(caps: Sequence[Cap], count: int, n: int) -> None:
    if count < 1:
        raise InputError(f"at least one record must be chosen, not {count} [E-VALUE-02]")
    available = [True] * n
    for cap in reversed(caps):  # stations lie within earthquakes: what they leave is what earthquakes count
        seen: Counter[Hashable] = Counter()
        for i in range(n):
            seen[cap.labels[i]] += available[i]
            available[i] = available[i] and seen[cap.labels[i]] <= cap.most
    if sum(available) < count:
        limits = " and ".join(f"{cap.most} of {'an event' if cap.of == 'event' else 'a station'}" for cap in caps)
        why = f", with at most {limits}" if caps else ""
        raise InputError(f"{count} records are wanted, but only {sum(available)} of {n} can be had{why} [E-MATCH-07]")


def _selection(library: Library, found: tuple[int, ...], scaling: Scaling, exhaustive: bool) -> Selection:
    chosen = list(found)
    factors, raw = scaling.factors[0], library.psa[chosen]
    scaled = factors[:, None] * raw
    mean = np.mean(scaled, axis=0)
    ratio = scaled[:, library.band] / library.target[library.band]
    off = np.mean(ratio, axis=0) - 1.0
    rules = library.spectrum.set_rules
    before = rules.check(library.periods, raw, library.pga[chosen], library.spectrum, library.T_1)
    after = rules.check(library.periods, scaled, factors * library.pga[chosen], library.spectrum, library.T_1)
    return Selection(
        chosen=found,
        factors=factors,
        common_factor=float(scaling.common[0]),
        periods=library.periods,
        mean_before=np.mean(raw, axis=0),
        mean_after=mean,
        deviation=float(np.sqrt(np.mean(off**2))),
        scatter=float(np.sqrt(np.mean(np.var(ratio, axis=0)))),
        largest_deviation=float(np.max(np.abs(off))),
        before=before,
        after=after,
        exhaustive=exhaustive,
    )
