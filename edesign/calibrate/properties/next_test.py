"""Which further test would separate what a property table cannot."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from edesign.calibrate.evidence import Judged
from edesign.calibrate.problem import PredictionError
from edesign.calibrate.properties.problem import PropertyProblem, at_rows
from edesign.calibrate.result import NextTest
from edesign.calibrate.search.selection import Selection
from edesign.damper.testing.property_table import PropertyTable

_STRAINS = (0.3, 1.5)  # of the smallest, of the largest
_FREQUENCIES = (0.2, 2.5)


def next_test(problem: PropertyProblem, found: Selection) -> NextTest | None:
    """The test in which look-alikes would differ most: rows beyond the table, or the loops of rows that it has.

    Differences are mean squares: of properties over those of the final model, and of forces (NRMS) for loops. None: no
    effect has a look-alike among effects.
    """
    best: NextTest | None = None
    for adopted in found.adopted:
        for name, other in adopted.alike.items():
            if name == "refit":
                continue
            names = (adopted.candidate.name, name)
            so_far = max(_properties(problem, found.final, other), default=0.0)
            for text, difference in _tests(problem, found.final, other):
                if best is None or difference > best.difference:
                    best = NextTest(text, names, difference, so_far)
    return best


def _tests(problem: PropertyProblem, one: Judged, other: Judged) -> Iterator[tuple[str, float]]:
    table = problem.table
    loops = _loops(problem, one, other)
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
                differences = _properties(at_rows(problem, further), one, other)
            except PredictionError:
                continue
            yield f"properties at {_named(further, 0)}", differences[0]


def _named(table: PropertyTable, row: int) -> str:
    strain, frequency, temperature = table.strain[row], table.frequency[row], table.temperature_C[row]
    return f"{100.0 * strain:.3g} % strain, {frequency:.3g} Hz, {temperature:.3g} degC"


def _properties(problem: PropertyProblem, one: Judged, other: Judged) -> list[float]:
    first, second = (problem.rows(j.fitted.base, j.fitted.parts) for j in (one, other))
    squares = [
        (getattr(second, name) / getattr(first, name) - 1.0) ** 2 for name in ("G_storage", "G_eq", "loss_factor")
    ]
    return [float(value) for value in np.mean(squares, axis=0)]


def _loops(problem: PropertyProblem, one: Judged, other: Judged) -> np.ndarray:
    """NRMS between the forces of two models in the last cycle of each row."""
    last = slice(-problem.samples, None)
    first, second = (problem.forces(j.fitted.base, j.fitted.parts, ("fit", "validate")) for j in (one, other))
    found = []
    for a, b in zip(first, second, strict=True):
        assert a is not None and b is not None
        found.append(float(np.sum((a[last] - b[last]) ** 2) / np.sum(a[last] ** 2)))
    return np.array(found)
