"""The rig over frequency, without compensation and behind each compensator."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np

from edesign.errors import EdesignError
from edesign.project.substructure.compensators import AtsCompensator, LiveDelayCompensator, ModifiedAtsCompensator
from edesign.project.substructure.rig import RigFile
from edesign.report.drawing.captions import plain
from edesign.report.substructure.bode import SIGMAS, Deviations, Path, bode_figure
from edesign.report.substructure.results import FIRST, NONE, WITHOUT, SubstructureResults, looks
from edesign.substructure.advice.transfers import (
    CompensatorTransfer,
    actuation,
    behind,
    live_delay_command,
    series_command,
)
from edesign.substructure.rig.rigs import RigTransfer
from edesign.substructure.rig.uncertainty import transfer_deviations
from edesign.substructure.stability.loop import Transfer, phase_delay

if TYPE_CHECKING:
    from matplotlib.figure import Figure

FROM, TO = 0.1, 50.0  # Hz
FORCE = ", force"


def rig_figures(results: SubstructureResults) -> Iterator[tuple[str, str, Figure]]:
    """Yield amplitude and phase of the rig over frequency; none if it is not known.

    Yields:
        Name of the file, caption and figure.
    """
    described = results.described
    if described.transfer is None or described.file is None:
        return
    paths, without = _paths(results, described.transfer)
    lines = _frequencies(results)
    at = lines[0] if lines else 1.0
    times = [f"{path.label} {plain(1e3 * phase_delay(path.transfer, at))} ms" for path in paths]
    left = f" Not shown: {'; '.join(f'{name}, {why}' for name, why in without)}." if without else ""
    corrected = " Of a compensator that corrects the measured force, that force over the one under the target."
    left = (corrected if any(path.label.endswith(FORCE) for path in paths) else "") + left
    marked = " Thin upright lines are the frequencies of the structure with the specimen." if lines else ""
    caption = (
        "Displacement over target. Above the amplitude, in the middle the phase, below what a sine comes late by."
        f"{marked} At {plain(at)} Hz late: {'; '.join(times)}. Adaptive compensators stand with the means of their "
        f"coefficients, a live delay with what it had found at the end.{left}{_band(paths[0], at)}"
    )
    highest = min(TO, 0.5 / described.file.loop.main_step)
    yield "rig", caption, bode_figure(paths, lines, (FROM, highest), ("amplitude (–)", "phase (degrees)", "delay (ms)"))


def _deviations(file: RigFile | None) -> Deviations | None:
    """How sure an identified rig is; None: it was not identified, or its file does not say."""
    if file is None or file.covariance is None:
        return None
    return lambda omega: transfer_deviations(file, omega)


def _band(rig: Path, at: float) -> str:
    """What the band of the rig is, in words."""
    if rig.deviations is None:
        return ""
    omega = 2.0 * np.pi * at
    amplitude, phase = (SIGMAS * float(one[0]) for one in rig.deviations(np.array([omega])))
    return (
        f" The band of the rig is {SIGMAS:g} standard deviations of its identification to either side: at "
        f"{plain(at)} Hz {plain(100.0 * amplitude)} % of the amplitude and {plain(1e3 * phase / omega)} ms."
    )


def _paths(results: SubstructureResults, rig: RigTransfer) -> tuple[list[Path], list[tuple[str, str]]]:
    """The rig alone and behind each compensator; and the compensators that cannot be drawn so, with the reason."""
    file = results.described.file
    assert file is not None
    loaded = results.linearised.rig if results.linearised is not None else rig
    best = next((results.best(test) for test in sorted(results.tests, key=results.is_closed, reverse=True)), None)
    chosen = looks({name: one.kind for name, one in file.compensators.items()}, best)
    paths, without = [Path(WITHOUT, loaded, FIRST, deviations=_deviations(file.rig_file))], []
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
    described, learned = file.compensators[name], None
    if isinstance(described, (AtsCompensator, ModifiedAtsCompensator)):
        runs = [run for run in results.runs if run.compensator == name]
        found = [[run.value(f"mean_alpha_{i}") for i in range(3)] for run in runs]
        known = [values for values in found if np.all(np.isfinite(values))]
        if not known:
            return None
        learned = series_command(described, np.mean(known, axis=0), file.loop.main_step)
    elif isinstance(described, LiveDelayCompensator):
        kept = [results.series(test, name) for test in results.tests if name in results.compensators(test)]
        delays = [one.of("alpha_0") for one in kept if one is not None]
        ends = [float(one[-1]) for one in delays if one is not None and one.size and np.isfinite(one[-1])]
        if not ends:
            return None
        learned = live_delay_command(described.order, float(np.mean(ends)))
    as_found = CompensatorTransfer(learned, None, "") if learned is not None else None
    return behind(file, name, loaded, rig, as_found)


def _behind(
    results: SubstructureResults, name: str, found: CompensatorTransfer | None, loaded: Transfer
) -> tuple[str, Transfer] | str:
    """Label and transfer function of a compensator and the rig behind it; or why there is none, in words."""
    linear = results.linearised
    if found is None:
        return "it kept nothing of what it found"
    if not found.settles:
        return "unstable with the rig alone"
    if found.force is None:
        return name, actuation(found, loaded, None)
    if linear is None:
        return "it corrects the force, and no specimen is known"
    return f"{name}{FORCE}", actuation(found, loaded, linear.model.specimen)


def _frequencies(results: SubstructureResults) -> list[float]:
    """Return the frequencies of the structure with the specimen that the figure shows, Hz."""
    found = results.linearised.frequencies if results.linearised is not None else ()
    return [float(one) for one in found if FROM < one < TO][:10]
