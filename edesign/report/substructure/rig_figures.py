"""The rig over frequency, without compensation and behind each compensator."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from edesign.core.compensator import DifferenceEquation
from edesign.errors import EdesignError
from edesign.project.substructure.compensators import AtsCompensator, LiveDelayCompensator, ModifiedAtsCompensator
from edesign.report.captions import plain
from edesign.report.figures import MEAN, logarithmic, new_figure, styled
from edesign.report.substructure.curves import legend_below
from edesign.report.substructure.results import BEST, FIRST, NONE, WITHOUT, SubstructureResults, looks
from edesign.substructure.advice.transfers import CompensatorTransfer, late, of_equation, of_live_delay
from edesign.substructure.laboratory import compensator_of
from edesign.substructure.rig.rigs import RigTransfer
from edesign.substructure.stability.loop import Transfer

if TYPE_CHECKING:
    from matplotlib.figure import Figure

FROM, TO = 0.1, 50.0  # Hz
LEAST = 0.1  # amplitude in the figure
FORCE = ", force"


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
    times = [f"{path.label} {plain(1e3 * delay(path.transfer, at))} ms" for path in paths]
    left = f" Not shown: {'; '.join(f'{name}, {why}' for name, why in without)}." if without else ""
    corrected = " Of a compensator that corrects the measured force, that force over the one under the target."
    left = (corrected if any(path.label.endswith(FORCE) for path in paths) else "") + left
    marked = " Thin upright lines are the frequencies of the structure with the specimen." if lines else ""
    caption = (
        "Displacement over target. Above the amplitude, in the middle the phase, below what a sine comes late by."
        f"{marked} At {plain(at)} Hz late: {'; '.join(times)}. Adaptive compensators stand with the means of their "
        f"coefficients, a live delay with what it had found at the end.{left}"
    )
    yield "rig", caption, rig_figure(paths, lines, described.file.loop.main_step)


def delay(transfer: Transfer, frequency: float) -> float:
    """Return what a sine of a frequency (Hz) comes late by, s."""
    omega = 2.0 * np.pi * np.linspace(0.0, frequency, 200)[1:]
    return float(-np.unwrap(np.angle(transfer(1j * omega)))[-1] / omega[-1])


def _paths(results: SubstructureResults, rig: RigTransfer) -> tuple[list[Path], list[tuple[str, str]]]:
    """The rig alone and behind each compensator; and the compensators that cannot be drawn so, with the reason."""
    file = results.described.file
    assert file is not None
    loaded = results.linearised.rig if results.linearised is not None else rig
    best = next((results.best(test) for test in sorted(results.tests, key=results.is_closed, reverse=True)), None)
    chosen = looks({name: one.kind for name, one in file.compensators.items()}, best)
    paths, without = [Path(WITHOUT, loaded, FIRST)], []
    for name, described in file.compensators.items():
        if described.kind == NONE:
            continue
        try:
            found = _compensator(results, name, rig, loaded)
        except EdesignError as error:
            without.append((name, str(error)))
            continue
        path = _behind(results, name, found, loaded)
        if isinstance(path, str):
            without.append((name, path))
        else:
            paths.append(Path(*path, *chosen[name]))
    return paths, without


def _compensator(
    results: SubstructureResults, name: str, rig: RigTransfer, loaded: Transfer
) -> CompensatorTransfer | None:
    """A compensator of the file; an adaptive one with what it found in the tests, None if it found nothing."""
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
        return CompensatorTransfer(lambda s: np.asarray(a0 + a1 * s + a2 * s**2), None, "")
    if isinstance(described, LiveDelayCompensator):
        kept = [results.series(test, name) for test in results.tests if name in results.compensators(test)]
        delays = [one.of("alpha_0") for one in kept if one is not None]
        ends = [float(one[-1]) for one in delays if one is not None and one.size and np.isfinite(one[-1])]
        return of_live_delay(described, float(np.mean(ends))) if ends else None
    equation = compensator_of(described, step, rig)
    assert isinstance(equation, DifferenceEquation)
    return of_equation(equation, loaded, rig, step)


def _behind(
    results: SubstructureResults, name: str, found: CompensatorTransfer | None, loaded: Transfer
) -> tuple[str, Transfer] | str:
    """Label and transfer function of a compensator and the rig behind it; or why there is none, in words."""
    file, linear = results.described.file, results.linearised
    assert file is not None
    if found is None:
        return "it kept nothing of what it found"
    if not found.settles:
        return "unstable with the rig alone"
    unseen = file.loop.unseen_delay * file.loop.main_step
    if found.force is None:
        return name, late(unseen, lambda s: found.command(s) * loaded(s))
    if linear is None:
        return "it corrects the force, and no specimen is known"
    force, specimen = found.force, linear.bench.specimen
    return f"{name}{FORCE}", late(unseen, lambda s: found.command(s) * loaded(s) + force(s) / specimen(-1j * s))


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
    times, peak = [], 1.0
    for path in paths:
        width = 1.1 if path.color in (FIRST, BEST) else 1.9  # compensators that agree lie on each other
        found = path.transfer(1j * omega)
        peak = max(peak, float(np.max(np.abs(found))))
        phase = np.unwrap(np.angle(found))
        times.append(-1e3 * phase / omega)
        for (axis,), values in zip(axes, (np.abs(found), np.degrees(phase), times[-1]), strict=True):
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
