"""All indicators of tracking of a test in one object."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any, TypeVar

from numpy.typing import ArrayLike

from edesign.errors import InputError
from edesign.substructure.indicators.channels import channel, time_step
from edesign.substructure.indicators.correlation_delay import correlation_delay
from edesign.substructure.indicators.crossing_delay import crossing_delay
from edesign.substructure.indicators.frequency_index import equivalent_frequency, frequency_index
from edesign.substructure.indicators.interface_energy import energy_error, relative_energy_error
from edesign.substructure.indicators.peaks import peak_errors
from edesign.substructure.indicators.synchronisation import tracking_indicator
from edesign.substructure.indicators.tracking_error import maximum_error, nrms, nrms_root
from edesign.substructure.indicators.undetermined import Undetermined

_T = TypeVar("_T")


def _indicator(long_name: str, unit: str) -> Any:
    return field(metadata={"long_name": long_name, "unit": unit})


@dataclass(frozen=True)
class Tracking:
    """Quality of a rig's tracking; delays are above zero where the measured channel is late.

    `definitions` has meaning, unit and source of each indicator. One that cannot be determined is NaN.

    Attributes:
        undetermined: why an indicator is NaN, by its name.
    """

    nrms: float = _indicator(
        "sum of squared errors over sum of squared targets, without a root (thesis Eq. 6.28 as printed)", "1"
    )
    nrms_root: float = _indicator("root of nrms (what Tables 6.1, 6.3 and 6.4 of the thesis hold)", "1")
    maximum_error: float = _indicator("largest error over largest target", "1")
    crossing_delay_mean: float = _indicator("mean delay between zero crossings of target and measured", "s")
    crossing_delay_largest: float = _indicator("delay of largest magnitude between zero crossings", "s")
    crossing_pairs: int = _indicator("zero crossings compared", "1")
    correlation_delay: float = _indicator("delay of largest correlation coefficient, finer than a sample", "s")
    correlation: float = _indicator("correlation coefficient of target and measured at that delay", "1")
    frequency_index_amplitude: float = _indicator(
        "measured over target amplitude by the frequency evaluation index (Guo et al. 2014)", "1"
    )
    frequency_index_phase: float = _indicator(
        "phase by the frequency evaluation index, below zero if late (Guo et al. 2014)", "rad"
    )
    equivalent_frequency: float = _indicator(
        "mean frequency of the target, weighted by squared Fourier amplitude (Guo et al. 2014)", "Hz"
    )
    frequency_index_delay: float = _indicator(
        "delay by the frequency evaluation index: -phase / (2 pi equivalent frequency) (Guo et al. 2014)", "s"
    )
    peak_error_mean: float = _indicator("mean of measured over target peak of the half-cycles, less 1", "1")
    peak_error_largest: float = _indicator("measured over target peak less 1, of largest magnitude", "1")
    peaks: int = _indicator("half-cycles compared by their peaks", "1")
    tracking_indicator: float = _indicator(
        "signed area of the synchronisation plot, summed, above zero if late (Mercan & Ricles 2007)", "m2"
    )
    energy_error: float = _indicator(
        "work on the specimen less that of the structure, above zero if the rig feeds it (Mosqueda et al. 2007)",
        "J",
    )
    relative_energy_error: float = _indicator("energy error over the largest work done on the specimen", "1")
    undetermined: dict[str, str] = field(default_factory=dict)


def definitions() -> dict[str, tuple[str, str]]:
    """Return meaning with source, and unit, of each indicator by its name."""
    return {
        entry.name: (entry.metadata["long_name"], entry.metadata["unit"])
        for entry in dataclasses.fields(Tracking)
        if entry.metadata
    }


def tracking(
    target: ArrayLike,
    measured: ArrayLike,
    step: float,
    force: ArrayLike | None = None,
    *,
    applied: ArrayLike | None = None,
    threshold: float | None = None,
) -> Tracking:
    """Return all indicators of tracking of a test.

    Args:
        target: x_t (n,), m.
        measured: x_m (n,), m, at the same instants.
        step: between samples, s.
        force: F (n,) of the specimen, above zero for x above zero, N; None: no energies.
        applied: (n,) force on the structure, which a compensator may correct, N; None: that of the specimen.
        threshold: of displacement, m: half-cycles within it have no crossings and no peaks; None: `QUIET` of the
            largest target.

    Raises:
        InputError: lengths that differ, NaN or infinity, a step or threshold out of range.
    """
    x_t = channel("target", target)
    x_m = channel("measured", measured, x_t.size)
    f = None if force is None else channel("force", force, x_t.size)
    _check_threshold(threshold)
    time_step(step)
    why: dict[str, str] = {}
    correlated = _determined(lambda: correlation_delay(x_t, x_m, step), why, "correlation_delay", "correlation")
    late = correlated.delay if correlated else None
    crossings = _determined(
        lambda: crossing_delay(x_t, x_m, step, threshold, late), why, "crossing_delay_mean", "crossing_delay_largest"
    )
    index = _determined(
        lambda: frequency_index(x_t, x_m, step),
        why,
        "frequency_index_amplitude",
        "frequency_index_phase",
        "frequency_index_delay",
    )
    errors = _determined(
        lambda: peak_errors(x_t, x_m, step, threshold, late), why, "peak_error_mean", "peak_error_largest"
    )
    return Tracking(
        nrms=_number(lambda: nrms(x_t, x_m), why, "nrms"),
        nrms_root=_number(lambda: nrms_root(x_t, x_m), why, "nrms_root"),
        maximum_error=_number(lambda: maximum_error(x_t, x_m), why, "maximum_error"),
        crossing_delay_mean=crossings.mean if crossings else math.nan,
        crossing_delay_largest=crossings.largest if crossings else math.nan,
        crossing_pairs=crossings.delays.size if crossings else 0,
        correlation_delay=correlated.delay if correlated else math.nan,
        correlation=correlated.correlation if correlated else math.nan,
        frequency_index_amplitude=index.amplitude if index else math.nan,
        frequency_index_phase=index.phase if index else math.nan,
        equivalent_frequency=_number(lambda: equivalent_frequency(x_t, step), why, "equivalent_frequency"),
        frequency_index_delay=index.delay if index else math.nan,
        peak_error_mean=errors.mean if errors else math.nan,
        peak_error_largest=errors.largest if errors else math.nan,
        peaks=errors.errors.size if errors else 0,
        tracking_indicator=float(tracking_indicator(x_t, x_m)[-1]),
        energy_error=_number(lambda: float(energy_error(_given(f), x_t, x_m, applied)[-1]), why, "energy_error"),
        relative_energy_error=_number(
            lambda: relative_energy_error(_given(f), x_t, x_m, applied), why, "relative_energy_error"
        ),
        undetermined=why,
    )


def _determined(indicator: Callable[[], _T], why: dict[str, str], *names: str) -> _T | None:
    """An indicator, or None with the reason under its names."""
    try:
        return indicator()
    except Undetermined as reason:
        why.update(dict.fromkeys(names, str(reason)))
        return None


def _number(indicator: Callable[[], float], why: dict[str, str], name: str) -> float:
    """An indicator, or NaN with the reason under its name."""
    value = _determined(indicator, why, name)
    return math.nan if value is None else value


def _given(force: ArrayLike | None) -> ArrayLike:
    if force is None:
        raise Undetermined("no force was given")
    return force


def _check_threshold(threshold: float | None) -> None:
    if threshold is not None and not (math.isfinite(threshold) and threshold > 0.0):
        raise InputError(f"threshold = {threshold:g} m is out of range: a displacement above 0 is needed [E-VALUE-02]")
