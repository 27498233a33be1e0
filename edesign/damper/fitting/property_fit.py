"""Fit a law to a table of properties: storage modulus, loss factor, and the equivalent modulus if asked for."""

from __future__ import annotations

import time
from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Literal, Protocol, get_args

import numpy as np

from edesign.damper.damper import Damper
from edesign.damper.fitting.assemble import assemble
from edesign.damper.fitting.coordinates import Bounds
from edesign.damper.fitting.fit import Fit, Tested
from edesign.damper.fitting.forces import SCREENED, STARTS
from edesign.damper.fitting.observed import Observed
from edesign.damper.fitting.scales import Scales
from edesign.damper.fitting.setup import Setup, set_up
from edesign.damper.fitting.solve import ErrorModel, Loss, Progress, solve
from edesign.damper.fitting.start import linear_start, spread
from edesign.damper.fitting.thermal import ThermalKind
from edesign.damper.law import Law
from edesign.damper.temperature import REFERENCE_C
from edesign.damper.testing.nrms import determination, error_of_peak, nrms
from edesign.damper.testing.steady_state import CYCLES, SAMPLES, predict
from edesign.errors import InputError
from edesign.project.reading.problems import did_you_mean

if TYPE_CHECKING:
    from edesign.damper.testing.specimen import Specimen

Quantity = Literal["G_storage", "loss_factor", "G_eq"]
_QUICK_CYCLES, _QUICK_SAMPLES = (3, 4), 80  # of the search; the polish takes those of a measured test


class PropertyColumns(Protocol):
    """Columns (n,) of a property table, SI units."""

    @property
    def strain(self) -> np.ndarray:
        """Amplitude of the shear strain of each row, (n,), dimensionless."""

    @property
    def frequency(self) -> np.ndarray:
        """Frequency of each row, (n,) Hz."""

    @property
    def temperature_C(self) -> np.ndarray:
        """Temperature of each row, (n,) degC."""

    @property
    def G_storage(self) -> np.ndarray:
        """Storage modulus G' of each row, (n,) Pa."""

    @property
    def G_eq(self) -> np.ndarray:
        """Equivalent modulus of each row, (n,) Pa."""

    @property
    def loss_factor(self) -> np.ndarray:
        """Loss factor eta of each row, (n,), dimensionless."""


def fit_properties(
    law: Law,
    table: PropertyColumns,
    specimen: Specimen,
    start: Mapping[str, float] | None = None,
    *,
    quantities: Sequence[Quantity] = ("G_storage", "loss_factor"),
    bounds: Bounds | None = None,
    fixed: Mapping[str, float] | Sequence[str] = (),
    fit_also: Sequence[str] = (),
    loss: Loss = "linear",
    starts: int = STARTS,
    seed: int = 1,
    temperature: ThermalKind | None = None,
    reference_C: float | None = None,
    branches: int = 1,
    cycles: tuple[int, int] = CYCLES,
    samples: int = SAMPLES,
    workers: int = 1,
    progress: Progress | None = None,
) -> Fit:
    """Fit a law to the properties of steady sinusoidal tests; errors are relative, so every row counts alike.

    Args:
        specimen: the layers that were tested.
        start: parameters to begin from, see `fit_forces`.
        quantities: what is fitted.
        bounds: of parameters, see `fit_forces`.
        fixed: parameters that are kept, see `fit_forces`.
        fit_also: further parameters that are fitted, see `fit_forces`.
        loss: of the residuals, see `fit_forces`.
        starts: number of starting points, see `fit_forces`.
        seed: of the starting points.
        temperature: what the temperature changes, see `fit_forces`.
        reference_C: reference temperature, degC.
        branches: number of branches of the law, see `fit_forces`.
        cycles: first and last full cycle that is averaged, see `steady_state.predict`.
        samples: of a simulated cycle, see `steady_state.predict`.
        workers: number of threads.
        progress: called at each start.

    Returns:
        The fitted parameters with their uncertainty and errors.

    Raises:
        InputError: something is wrong with table or options, or the rows cannot carry so many parameters.
        AnalysisError: the law gives no properties at the start.

    Source: thesis Eqs. 4.30-4.31, with relative errors so that both can be minimised as one.
    """
    begun = time.perf_counter()
    for name in quantities:
        if name not in get_args(Quantity):
            known = get_args(Quantity)
            raise InputError(
                f"quantities: `{name}` is unknown{did_you_mean(name, known)} ({', '.join(known)}) [E-FIT-04]"
            )
    measured = _measured(table, quantities)
    observed = _observed(table, specimen)
    temperatures = np.asarray(table.temperature_C, dtype=float).tolist()
    setup = set_up(
        law, observed, start, bounds, fixed, fit_also, temperatures, temperature, reference_C, branches, starts, loss
    )
    coordinates = setup.coordinates
    if measured.size <= len(coordinates.names):
        raise InputError(
            f"{measured.size} measured properties cannot carry {len(coordinates.names)} parameters; "
            "give more rows, or hold some [E-FIT-01]"
        )
    full = replace(_model(setup, table, specimen, quantities, measured, cycles, samples), loss=loss, workers=workers)
    coarse = _model(setup, table, specimen, quantities, measured, _QUICK_CYCLES, _QUICK_SAMPLES)
    first = coordinates.at(coordinates.start)
    candidates = [first, *linear_start(law, coordinates, observed, seed), *spread(coordinates, SCREENED * starts, seed)]
    outcome = solve(coarse, full, candidates, starts, workers, progress, setup.canonical)
    predicted = measured * (1.0 + np.column_stack(outcome.errors) * np.sqrt(measured.size))
    found = assemble(
        setup,
        outcome,
        None,
        errors={name: nrms(predicted[i], measured[i]) for i, name in enumerate(quantities)},
        peak_error={name: error_of_peak(predicted[i], measured[i]) for i, name in enumerate(quantities)},
        determined={name: determination(predicted[i], measured[i]) for i, name in enumerate(quantities)},
        overall=float(np.mean((predicted / measured - 1.0) ** 2)),
        rms_error={
            name: float(np.sqrt(np.mean((predicted[i] / measured[i] - 1.0) ** 2))) for i, name in enumerate(quantities)
        },
        tested=Tested(_range(table.strain), _range(table.frequency), _range(table.temperature_C), strain=True),
        independent=float(measured.size),
        against="properties",
    )
    return replace(found, seconds=time.perf_counter() - begun)


def _measured(table: PropertyColumns, quantities: Sequence[Quantity]) -> np.ndarray:
    """Properties (quantities, rows)."""
    values = np.array([np.asarray(getattr(table, name), dtype=float) for name in quantities])
    if not values.size:
        raise InputError("there are no properties to fit to [E-FIT-01]")
    if not np.all(np.isfinite(values) & (values > 0.0)):
        worst = np.argwhere(~(np.isfinite(values) & (values > 0.0)))[0]
        raise InputError(
            f"properties: {quantities[worst[0]]} of row {worst[1] + 1} is {values[tuple(worst)]:g}; relative errors "
            "need values greater than 0 [E-FIT-06]"
        )
    return values


def _observed(table: PropertyColumns, specimen: Specimen) -> Observed:
    omega = 2.0 * np.pi * np.asarray(table.frequency, dtype=float)
    stiffness = np.array(
        [
            specimen.stiffness(float(g)) * complex(1.0, float(n))
            for g, n in zip(table.G_storage, table.loss_factor, strict=True)
        ]
    )
    amplitude = np.asarray(table.strain, dtype=float) * specimen.layer_thickness
    force = np.abs(stiffness) * amplitude
    scales = Scales(*(float(np.mean(values)) for values in (force, amplitude, omega * amplitude)))
    return Observed(omega, stiffness, scales, float(force.max()))


def _model(
    setup: Setup,
    table: PropertyColumns,
    specimen: Specimen,
    quantities: Sequence[Quantity],
    measured: np.ndarray,
    cycles: tuple[int, int],
    samples: int,
) -> ErrorModel:
    """Relative errors, each row as a test; half the sum of their squares is half their mean square."""
    temperature = np.asarray(table.temperature_C, dtype=float)
    one_set = setup.thermal.kind is None
    groups = [np.full(temperature.size, True)] if one_set else [temperature == t for t in np.unique(temperature)]
    factor = 1.0 / np.sqrt(measured.size)

    def errors(x: np.ndarray) -> list[np.ndarray]:
        values = setup.coordinates.values(x)
        found = np.empty_like(measured)
        for rows in groups:
            own = setup.thermal.at(setup.law, values, float(temperature[rows][0]))
            damper, motion = Damper(setup.law, own), (table.strain[rows], table.frequency[rows])
            there = predict(damper, specimen, *motion, REFERENCE_C, None, cycles, samples)
            found[:, rows] = [getattr(there, name) for name in quantities] / measured[:, rows] - 1.0
        return list(factor * found.T)

    return ErrorModel(setup.coordinates, errors, (len(quantities),) * temperature.size)


def _range(values: np.ndarray) -> tuple[float, float]:
    return float(np.min(values)), float(np.max(values))
