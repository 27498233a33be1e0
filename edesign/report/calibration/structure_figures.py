"""Records of a structure before and after a calibration: peaks over the floors, histories, Fourier spectra."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

import numpy as np

from edesign.calibration.residual.series import Series
from edesign.report.calibration.units import scale_of
from edesign.report.calibration.view import COLOURS, MEASURED, View, outline
from edesign.report.drawing.captions import file_name
from edesign.report.drawing.style import grid_figure, legend_below, logarithmic, new_figure, styled

if TYPE_CHECKING:
    from matplotlib.figure import Figure

_CYCLES = 12.0  # of the channel's strongest frequency, shown of a history
_POWER = 0.998  # of a channel lies below the end of its spectrum, and as much above its beginning
_BANDS = 60  # over which a spectrum is smoothed


def peak_figures(view: View) -> Iterator[tuple[str, str, Figure]]:
    """Largest acceleration of each floor, by test; nothing where fewer than two floors have an instrument."""
    tests = [(one, floors) for one in view.calibration.tests if len(floors := _accelerations(view, one)) > 1]
    if tests:
        caption = (
            "Largest absolute acceleration of each floor, measured and predicted. Validation tests are in bold; no "
            "model is fitted to them."
        )
        yield "peaks", caption, _peaks_figure(view, tests)


def _accelerations(view: View, test: Series) -> list[Series]:
    return [s for s in view.calibration.series if s.of_test == test.of_test and s.quantity == "acceleration"]


@styled
def _peaks_figure(view: View, tests: list[tuple[Series, list[Series]]]) -> Figure:
    figure, cells = grid_figure(len(tests), 3, 2.6, 2.6)
    for axis, (test, floors) in zip(cells, tests, strict=True):
        place = np.arange(1, len(floors) + 1)
        measured = [float(np.max(np.abs(one.measured))) for one in floors]
        axis.plot(measured, place, "o-", ms=5.0, lw=2.4, alpha=0.55, color=MEASURED, label="measured")
        for stage, label in view.stages.items():
            peaks = [float(np.max(np.abs(one.predicted[stage]))) for one in floors]
            axis.plot(peaks, place, "o-", ms=3.0, lw=0.9, color=COLOURS[stage], label=label)
        axis.set_xlim(left=0.0)
        axis.set_yticks(place, [one.channel.removeprefix("acceleration of ") for one in floors])
        axis.set_xlabel("acceleration (m/s²)")
        weight = "bold" if test.use == "validate" else "normal"
        axis.set_title(_title(test), fontsize=8.0, loc="left", fontweight=weight)
    legend_below(figure, *cells[0].get_legend_handles_labels(), 3)
    return figure


def history_figures(view: View) -> Iterator[tuple[str, str, Figure]]:
    """Every channel of every test over time, about its largest error as declared."""
    for test in view.calibration.tests:
        channels = _channels(view, test)
        caption = (
            f"{_title(test)}: all channels, measured (wide, grey) and predicted, about the largest error of the "
            "building as declared."
        )
        yield file_name(f"history-{test.of_test.replace('/', '-')}"), caption, _histories_figure(view, channels)


@styled
def _histories_figure(view: View, channels: list[Series]) -> Figure:
    figure, rows = new_figure(len(channels), 1, 8.4, 0.7 + 1.15 * len(channels))
    part = _window(channels)
    for (axis,), one in zip(rows, channels, strict=True):
        scale, unit = scale_of(one)
        time = one.time[part]
        axis.plot(*outline(time, one.measured[part] / scale), color=MEASURED, lw=2.4, alpha=0.55, label="measured")
        for stage, label in view.stages.items():
            axis.plot(*outline(time, one.predicted[stage][part] / scale), color=COLOURS[stage], lw=0.9, label=label)
        axis.set_xlim(float(time[0]), float(time[-1]))
        axis.set_title(f"{one.channel} ({unit})", fontsize=7.5, loc="left")
    for (axis,) in rows[:-1]:
        axis.tick_params(labelbottom=False)
    rows[-1][0].set_xlabel("time (s)")
    legend_below(figure, *rows[0][0].get_legend_handles_labels(), 3)
    return figure


def spectrum_figures(view: View) -> Iterator[tuple[str, str, Figure]]:
    """Fourier spectra of every channel of every test."""
    for test in view.calibration.tests:
        channels = _channels(view, test)
        caption = (
            f"{_title(test)}: Fourier amplitudes of all channels, smoothed. A peak beside the measured one is an error "
            "of stiffness or mass, a higher or lower one an error of damping."
        )
        yield file_name(f"spectrum-{test.of_test.replace('/', '-')}"), caption, _spectra_figure(view, channels)


@styled
def _spectra_figure(view: View, channels: list[Series]) -> Figure:
    figure, cells = grid_figure(len(channels), 3, 2.6, 1.9)
    for axis, one in zip(cells, channels, strict=True):
        scale, unit = scale_of(one)
        frequency = np.fft.rfftfreq(one.time.size, float(one.time[1] - one.time[0]))
        power = np.cumsum(np.abs(np.fft.rfft(one.measured)) ** 2)
        last = max(int(np.searchsorted(power, _POWER * power[-1])), 8)
        first = max(int(np.searchsorted(power, (1.0 - _POWER) * power[-1])), 1)
        style: Any = {"color": MEASURED, "lw": 2.4, "alpha": 0.55, "label": "measured"}
        axis.plot(*_smooth(frequency, one.measured / scale, last), **style)
        for stage, label in view.stages.items():
            shown = _smooth(frequency, one.predicted[stage] / scale, last)
            axis.plot(*shown, color=COLOURS[stage], lw=0.9, label=label)
        logarithmic(axis)
        axis.set_xlim(0.5 * float(frequency[first]), float(frequency[last]))
        axis.set_ylim(bottom=0.0)
        axis.set_xlabel("frequency (Hz)")
        axis.set_ylabel(f"{unit} s")
        axis.set_title(one.channel, fontsize=7.5, loc="left")
    legend_below(figure, *cells[0].get_legend_handles_labels(), 3)
    return figure


def _smooth(frequency: np.ndarray, values: np.ndarray, last: int) -> tuple[np.ndarray, np.ndarray]:
    """Root of the mean square amplitude in bands of equal logarithmic width."""
    edges = np.unique(np.geomspace(1, last + 1, _BANDS + 1).astype(int))
    power = np.abs(np.fft.rfft(values)) ** 2 * (2.0 * frequency[-1]) ** -2
    count = np.diff(edges)
    found = np.sqrt(np.add.reduceat(power, edges)[:-1] / count)
    return np.add.reduceat(frequency, edges)[:-1] / count, found


def _channels(view: View, test: Series) -> list[Series]:
    return [one for one in view.calibration.series if one.of_test == test.of_test]


def _window(channels: list[Series]) -> slice:
    """Some cycles about the largest error of all channels together."""
    error = sum((one.measured - one.predicted["declared"]) ** 2 / float(np.mean(one.measured**2)) for one in channels)
    first = channels[0]
    step = float(first.time[1] - first.time[0])
    spectrum = np.abs(np.fft.rfft(first.measured)) ** 2
    strongest = max(float(np.fft.rfftfreq(first.time.size, step) @ spectrum / spectrum.sum()), step)
    width = min(int(_CYCLES / strongest / step), first.time.size)
    energy = np.concatenate(([0.0], np.cumsum(np.asarray(error))))
    begin = int(np.argmax(energy[width:] - energy[: energy.size - width]))
    return slice(begin, begin + width)


def _title(test: Series) -> str:
    name = f"{test.of_test}: {test.title}" if test.title and test.title != test.of_test else test.of_test
    return f"{name} ({'validation' if test.use == 'validate' else 'fitted'})"
