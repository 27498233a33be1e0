"""Fit a law to measured force histories, all tests at once."""

from __future__ import annotations

import time
from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from edesign.damper.damper import Damper
from edesign.damper.fitting.assemble import assemble
from edesign.damper.fitting.coordinates import Bounds
from edesign.damper.fitting.fit import Fit, Tested
from edesign.damper.fitting.loading import Loading, Predict, prepare, scales_of
from edesign.damper.fitting.observed import observe
from edesign.damper.fitting.setup import Setup, set_up
from edesign.damper.fitting.solve import ErrorModel, Loss, Progress, solve
from edesign.damper.fitting.start import linear_start, spread
from edesign.damper.fitting.starts import ValuesAt, same_starts, start_warnings, with_starts
from edesign.damper.fitting.thermal import ThermalKind
from edesign.damper.fitting.warnings import misfit_warnings, sign_warnings
from edesign.damper.law import Law
from edesign.damper.testing.independence import independent_errors
from edesign.damper.testing.nrms import determination, error_of_peak, nrms
from edesign.errors import AnalysisError, InputError

if TYPE_CHECKING:
    from edesign.damper.testing.measured_histories import DamperTest
    from edesign.damper.testing.specimen import Specimen

STARTS, SCREENED = 6, 8
"""Descents; candidates that are screened for each."""
_BLOCKS = 10  # of a test at most
_PASSES = 5  # of a fit and of what it says about how tests start


def fit_forces(
    law: Law,
    tests: Sequence[DamperTest],
    start: Mapping[str, float] | None = None,
    *,
    specimen: Specimen | None = None,
    bounds: Bounds | None = None,
    fixed: Mapping[str, float] | Sequence[str] = (),
    fit_also: Sequence[str] = (),
    loss: Loss = "linear",
    starts: int = STARTS,
    seed: int = 1,
    weights: Mapping[str, float] | None = None,
    temperature: ThermalKind | None = None,
    reference_C: float | None = None,
    branches: int = 1,
    predict: Predict | None = None,
    workers: int = 1,
    progress: Progress | None = None,
) -> Fit:
    """Fit a law to force histories by least squares over all tests at once.

    Errors of a test are measured in the root mean square of its force, so every test counts alike, whatever its force
    and length.

    Args:
        start: values to start from, SI; those not given come from the data. Fixed parameters keep these.
        specimen: for the tested range as strain.
        bounds: narrower than the law's own, by name, SI.
        fixed: names fixed at their start values, or values to fix, SI; besides those of identifiable.FIXED.
        fit_also: names of identifiable.FIXED that are fitted nevertheless.
        loss: "linear" is least squares; the others give errors beyond twice the usual one less weight.
        starts: descents, from the start and the best of a seeded Latin hypercube about it.
        seed: of the hypercube.
        weights: factor of the squared errors of a test, by name.
        temperature: see thermal.Thermal.
        reference_C: degC at which the parameters hold.
        predict: force of parameters under a loading; None: the law in the core.
        workers: threads.
        progress: called at each start.

    Raises:
        InputError: something is wrong with tests or options, or the data cannot carry so many parameters.
        AnalysisError: the law gives no force at the start.

    Source: thesis Eq. 4.32.
    """
    begun = time.perf_counter()
    loadings = prepare(tests, weights)
    scales = scales_of(loadings)
    observed = observe(loadings, scales)
    temperatures = [loading.temperature_C for loading in loadings]
    setup = set_up(
        law, observed, start, bounds, fixed, fit_also, temperatures, temperature, reference_C, branches, starts, loss
    )
    samples = sum(loading.time.size for loading in loadings)
    if samples <= 2 * len(setup.coordinates.names):
        raise InputError(
            f"{samples} samples cannot carry {len(setup.coordinates.names)} parameters; give more tests, or hold some"
            " [E-FIT-01]"
        )
    force = predict or core_predict(law)
    coordinates = setup.coordinates

    def at(x: np.ndarray) -> ValuesAt:
        values = coordinates.values(x)
        return lambda celsius: setup.thermal.at(law, values, celsius)

    first = coordinates.at(coordinates.start)
    try:
        force(setup.thermal.at(law, coordinates.values(first), loadings[0].temperature_C), loadings[0])
    except AnalysisError as error:
        if start or fixed:
            raise InputError(f"law {law.name} gives no force with the values to start from: {error}") from error
        raise
    candidates = [first, *linear_start(law, coordinates, observed, seed), *spread(coordinates, SCREENED * starts, seed)]
    loadings = with_starts(loadings, tests, law, at(first), force) if start else loadings
    for _ in range(_PASSES):
        slim = tuple(loading.for_search() for loading in loadings)
        coarse, full = _model(setup, slim, force, "linear", 1), _model(setup, loadings, force, loss, workers)
        outcome = solve(coarse, full, candidates, starts, workers, progress, setup.canonical)
        before, loadings = loadings, with_starts(loadings, tests, law, at(outcome.x), force)
        if same_starts(before, loadings, at(outcome.x), force):
            break
        candidates, starts = [outcome.x], 1
    loadings = before  # to which was fitted
    best = coordinates.values(outcome.x)
    predicted = [force(setup.thermal.at(law, best, a.temperature_C), a)[a.first :] for a in loadings]
    found = assemble(
        setup,
        outcome,
        [_blocks(loading) for loading in loadings],
        errors={a.name: nrms(p, a.judged_force) for p, a in zip(predicted, loadings, strict=True)},
        peak_error={a.name: error_of_peak(p, a.judged_force) for p, a in zip(predicted, loadings, strict=True)},
        determined={a.name: determination(p, a.judged_force) for p, a in zip(predicted, loadings, strict=True)},
        overall=nrms(np.concatenate(predicted), np.concatenate([loading.judged_force for loading in loadings])),
        rms_error={
            a.name: float(np.sqrt(np.mean((p - a.judged_force) ** 2))) / a.rms
            for p, a in zip(predicted, loadings, strict=True)
        },
        tested=_tested(loadings, specimen),
        independent=independent_errors(p - a.judged_force for p, a in zip(predicted, loadings, strict=True)),
    )
    misfits = misfit_warnings(found.mean_rms_error)
    warnings = (*start_warnings(loadings), *sign_warnings(loadings), *misfits, *found.warnings)
    return replace(found, warnings=warnings, seconds=time.perf_counter() - begun)


def core_predict(law: Law) -> Predict:
    """Return the function that gives the force of a law as the core computes it."""

    def predict(values: Mapping[str, float], loading: Loading) -> np.ndarray:
        damper = Damper(law, values, prior_extremes=loading.prior_extremes)
        return damper.force(loading.time, loading.displacement, loading.velocity)

    return predict


def _model(setup: Setup, loadings: Sequence[Loading], predict: Predict, loss: Loss, workers: int) -> ErrorModel:
    """Return the model of errors relative to the tests' forces.

    Half the sum of their squares is half the mean over tests. Samples that are not judged have no errors.
    """
    factors = [np.sqrt(a.weight / ((a.time.size - a.first) * len(loadings))) / a.rms for a in loadings]

    def errors(x: np.ndarray) -> list[np.ndarray]:
        values = setup.coordinates.values(x)
        found = []
        for loading, factor in zip(loadings, factors, strict=True):
            own = setup.thermal.at(setup.law, values, loading.temperature_C)
            error = factor * (np.asarray(predict(own, loading)) - loading.force)
            error[: loading.first] = 0.0
            found.append(error)
        return found

    return ErrorModel(setup.coordinates, errors, tuple(a.time.size for a in loadings), loss, workers=workers)


def _blocks(loading: Loading) -> int:
    """Return the number of blocks of a test, at most ten of one cycle or more.

    Errors of a law repeat with the cycles of the test, so shorter blocks would take them for independent.
    """
    cycles = loading.frequency * float(loading.time[-1] - loading.time[0])
    return min(_BLOCKS, max(1, int(cycles)), loading.time.size)


def _tested(loadings: Sequence[Loading], specimen: Specimen | None) -> Tested:
    amplitude = np.array([np.max(np.abs(loading.displacement)) for loading in loadings])
    if specimen is not None:
        amplitude = np.asarray(specimen.strain(amplitude))
    frequency = [loading.frequency for loading in loadings]
    temperature = [loading.temperature_C for loading in loadings]
    return Tested(
        (float(amplitude.min()), float(amplitude.max())),
        (min(frequency), max(frequency)),
        (min(temperature), max(temperature)),
        specimen is not None,
    )
