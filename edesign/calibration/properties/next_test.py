"""Which further test would separate the models that a table of moduli leaves probable."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from edesign.calibration.properties.campaign import Group
from edesign.calibration.properties.problem import PropertyProblem, problem_of
from edesign.calibration.properties.repeatability import QUANTITIES
from edesign.calibration.results.models import Posterior
from edesign.calibration.results.result import NextTest
from edesign.calibration.search.models import FittedModel
from edesign.damper.testing.measured_histories import USES
from edesign.damper.testing.property_table import PropertyTable
from edesign.estimation.model import PredictionError

_STRAINS = (0.3, 1.5)  # of the smallest, of the largest
_FREQUENCIES = (0.2, 2.5)
_MOST_MODELS = 4
_GAIN = 1.2  # times the largest difference so far: less is no reason for a further test


def next_test(problem: PropertyProblem, posterior: Posterior) -> NextTest | None:
    """Return the test in which the model that stands differs most from one that the table leaves.

    It has rows beyond the table, or the loops of rows that the table has. Differences are mean squares: of properties
    over those of the best model, and of forces (NRMS) for loops.

    Returns:
        None: one model alone is left, or no test would separate them better than the table, and from how rows repeat.
    """
    chosen = posterior.rivals()[:_MOST_MODELS]
    one = posterior.best
    best: tuple[float, NextTest] | None = None
    for i in chosen[1:]:
        other = posterior.models[i]
        try:
            so_far = max(_in_properties(problem, one, other))
        except PredictionError:
            continue
        for text, difference in _tests(problem, one, other):
            expected = min(posterior.odds(i), 1.0) * difference
            if difference < max(_GAIN * so_far, problem.repeats**2) or (best is not None and expected <= best[0]):
                continue
            best = expected, NextTest(text, (one.label, other.label), difference, so_far)
    return None if best is None else best[1]


def _tests(problem: PropertyProblem, one: FittedModel, other: FittedModel) -> Iterator[tuple[str, float]]:
    table = problem.table
    loops = _in_loops(problem, one, other)
    if loops is not None:
        row = int(np.argmax(loops))
        yield f"record the loop, force over displacement, of {_named(table, row)}", float(loops[row])
    temperature = float(table.levels[0][0])
    reach = table.strain.min(), table.strain.max(), table.frequency.min(), table.frequency.max()
    for strain in (_STRAINS[0] * reach[0], float(np.median(table.strain)), _STRAINS[1] * reach[1]):
        for frequency in (_FREQUENCIES[0] * reach[2], _FREQUENCIES[1] * reach[3]):
            ones = np.ones(1)
            moduli = (table.G_storage[:1],) * 2
            further = PropertyTable(temperature * ones, strain * ones, frequency * ones, *moduli, ones)
            try:
                (difference,) = _in_properties(_at_rows(problem, further), one, other)
            except PredictionError:
                continue
            yield f"properties at {_named(further, 0)}", difference


def _at_rows(problem: PropertyProblem, table: PropertyTable) -> PropertyProblem:
    """Return the problem of other rows, by the same law."""
    inner = problem.inner
    groups = (Group("further", "fit", np.arange(len(table))),)
    of = table, problem.specimen, groups, inner.law, inner.declared, inner.refit
    return problem_of(*of, problem.cycles, problem.samples, inner.threads)


def _named(table: PropertyTable, row: int) -> str:
    strain, frequency, temperature = table.strain[row], table.frequency[row], table.temperature_C[row]
    return f"{100.0 * strain:.3g} % strain, {frequency:.3g} Hz, {temperature:.3g} degC"


def _in_properties(problem: PropertyProblem, one: FittedModel, other: FittedModel) -> list[float]:
    """Return the mean square difference of the properties of each row."""
    first, second = (problem.model(m.effects, USES).properties(m.fit.values) for m in (one, other))
    squares = [(getattr(second, name) / getattr(first, name) - 1.0) ** 2 for name in QUANTITIES]
    return [float(value) for value in np.mean(squares, axis=0)]


def _in_loops(problem: PropertyProblem, one: FittedModel, other: FittedModel) -> np.ndarray | None:
    """Return the NRMS (rows,) between the forces of two models in the last cycle of each row; None: there are none."""
    last, both = slice(-problem.samples, None), []
    for model in (one, other):
        forces = problem.model(model.effects, USES).forces(model.fit.values)
        if isinstance(forces, PredictionError):
            return None
        both.append([force[last] for force in forces])
    return np.array([float(np.sum((a - b) ** 2) / np.sum(a**2)) for a, b in zip(*both, strict=True)])
