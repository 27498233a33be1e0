"""The rig over frequency, without compensation and behind each compensator that has a transfer function."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from edesign.core.compensator import DifferenceEquation
from edesign.errors import EdesignError
from edesign.project.substructure.compensators import AtsCompensator, ModifiedAtsCompensator
from edesign.report.captions import plain
from edesign.report.figures import MEAN, VARIANTS, logarithmic, new_figure, styled
from edesign.report.substructure.curves import legend_below
from edesign.report.substructure.results import BEST, FIRST, NONE, SubstructureResults
from edesign.substructure.compensation.compensators import response
from edesign.substructure.laboratory import compensator_of
from edesign.substructure.rig.rigs import RigTransfer

if TYPE_CHECKING:
    from matplotlib.figure import Figure

FROM, TO = 0.1, 50.0  # Hz
LEAST = 0.1  # amplitude in the figure
MOST = 6  # compensators in the figure
OTHERS = tuple(color for color in VARIANTS if color not in (FIRST, BEST))
Transfer = Callable[[np.ndarray], np.ndarray]


@dataclass(frozen=True)
class Path:
    """From target to displacement: a label, the transfer function over s, a colour, and the style of the line."""

    label: str
    transfer: Transfer
    color: str
    style: str = "-"


def rig_figures(results: SubstructureResults) -> Iterator[tuple[str, str, Figure]]:
    """Give amplitude and phase of the rig over frequency: name of the file, caption, figure; none if not known."""
    described = results.described
    if described.transfer is None or described.file is None:
        return
    paths, without = _paths(results, described.transfer)
    lines = _frequencies(results)
    at = lines[0] if lines else 1.0
    late = [f"{path.label} {plain(1e3 * delay(path.transfer, at))} ms" for path in paths]
    left = f" Not shown, as they have no transfer function of their own: {', '.join(without)}." if without else ""
    marked = " Thin upright lines are the frequencies of the structure with the specimen." if lines else ""
    caption = (
        "Displacement over target. Above the amplitude, in the middle the phase, below what a sine comes late by."
        f"{marked} At {plain(at)} Hz late: {'; '.join(late)}. Adaptive compensators stand with the means of their "
        f"coefficients.{left}"
    )
    yield "rig", caption, rig_figure(paths, lines, described.file.loop.main_step)


def delay(transfer: Transfer, frequency: float) -> float:
    """Return what a sine of a frequency (Hz) comes late by, s."""
    omega = 2.0 * np.pi * np.linspace(0.0, frequency, 200)[1:]
    return float(-np.unwrap(np.angle(transfer(1j * omega)))[-1] / omega[-1])


def _paths(results: SubstructureResults, rig: RigTransfer) -> tuple[list[Path], list[str]]:
    """The rig alone and behind each compensator; and the compensators that cannot be drawn so."""
    loaded = results.linearised.rig if results.linearised is not None else rig
    paths, without = [Path("without compensation", loaded, FIRST)], []
    best = next((results.best(test) for test in sorted(results.tests, key=results.is_closed, reverse=True)), None)
    file = results.described.file
    assert file is not None
    unseen = file.loop.unseen_delay * file.loop.main_step
    others = 0
    for name in file.compensators:
        if results.kind(name) == NONE:
            continue
        command = _command(results, name, rig)
        if command is None or len(paths) > MOST:
            without.append(name)
            continue
        transfer = _behind(command, loaded, unseen)
        if name == best:
            paths.append(Path(name, transfer, BEST))
            continue
        paths.append(Path(name, transfer, OTHERS[others % len(OTHERS)], "-" if others < len(OTHERS) else ":"))
        others += 1
    return paths, without


def _behind(command: Transfer, rig: Transfer, unseen: float) -> Transfer:
    return lambda s: command(s) * rig(s) * np.exp(-s * unseen)


def _command(results: SubstructureResults, name: str, rig: RigTransfer) -> Transfer | None:
    """Command over target of a compensator; None where it feeds back what is measured, or has found no values."""
    file = results.described.file
    assert file is not None
    described, step = file.compensators[name], file.loop.main_step
    if isinstance(described, (AtsCompensator, ModifiedAtsCompensator)):
        runs = [run for run in results.runs if run.compensator == name]
        found = [[run.value(f"mean_alpha_{i}") for i in range(3)] for run in runs]
        known = [values for values in found if np.all(np.isfinite(values))]
        if not known:
            return None
        a0, a1, a2 = np.mean(known, axis=0)
        return lambda s: np.asarray(a0 + a1 * s + a2 * s**2)
    try:
        equation = compensator_of(described, step, rig)
    except EdesignError:
        return None
    if not isinstance(equation, DifferenceEquation) or equation.force_terms:
        return None
    if any(term.of == "measured" for term in equation.terms):
        return None
    return lambda s: response(equation, step, s)


def _frequencies(results: SubstructureResults) -> list[float]:
    """Of the structure with the specimen, Hz, those that the figure shows."""
    found = results.linearised.frequencies if results.linearised is not None else ()
    return [float(one) for one in found if FROM < one < TO][:10]


@styled
def rig_figure(paths: Sequence[Path], lines: Sequence[float], step: float) -> Figure:
    """Draw amplitude, phase and delay over frequency.

    Args:
        paths: from target to displacement.
        lines: frequencies that are marked, Hz.
        step: main step, s; half its rate is the highest frequency.
    """
    from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter

    figure, axes = new_figure(3, 1, 5.6, 5.2)
    frequency = np.geomspace(FROM, min(TO, 0.5 / step), 400)
    omega = 2.0 * np.pi * frequency
    late, peak = [], 1.0
    for path in paths:
        width = 1.1 if path.color in (FIRST, BEST) else 1.9  # compensators that agree lie on each other
        found = path.transfer(1j * omega)
        peak = max(peak, float(np.max(np.abs(found))))
        phase = np.unwrap(np.angle(found))
        late.append(-1e3 * phase / omega)
        for (axis,), values in zip(axes, (np.abs(found), np.degrees(phase), late[-1]), strict=True):
            axis.plot(frequency, values, color=path.color, lw=width, ls=path.style, zorder=3.2 - 0.2 * width)
    for axis, level, label in zip(
        (row[0] for row in axes), (1.0, 0.0, 0.0), ("amplitude (–)", "phase (degrees)", "delay (ms)"), strict=True
    ):
        axis.axhline(level, color=MEAN, lw=0.5, ls="--")
        for line in lines:
            axis.axvline(line, color=MEAN, lw=0.5, zorder=0.9)
        logarithmic(axis)
        axis.set_xlim(frequency[0], frequency[-1])
        axis.set_ylabel(label)
        axis.tick_params(labelbottom=axis is axes[-1][0])
    amplitude = axes[0][0]
    amplitude.set_yscale("log")
    amplitude.set_ylim(LEAST, max(1.3 * peak, 2.0))
    amplitude.yaxis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0)))
    amplitude.yaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
    amplitude.yaxis.set_minor_formatter(NullFormatter())
    axes[1][0].set_ylim(-180.0, 45.0)
    axes[1][0].set_yticks([-180, -135, -90, -45, 0, 45])
    axes[-1][0].set_xlabel("frequency (Hz)")
    figure.align_ylabels()
    legend_below(figure, [(path.label, path.color, path.style) for path in paths])
    return figure
