"""A property table as a problem of the search: each row a steady sinusoidal test, predicted by the law with effects."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from edesign.calibration.dampers.effect import EffectForm
from edesign.calibration.dampers.experiment import Experiment
from edesign.calibration.dampers.mechanisms import LastingExtremes
from edesign.calibration.dampers.motion import Motion
from edesign.calibration.dampers.problem import DamperProblem
from edesign.calibration.dampers.sizes import Sizes
from edesign.calibration.form import FormInCampaign, Values
from edesign.calibration.problems import EffectModel, Predicted, TestedProblem
from edesign.calibration.properties import arrangement, reading
from edesign.calibration.properties.campaign import Group
from edesign.calibration.properties.reading import Reading, ReadingForm
from edesign.calibration.properties.repeatability import noise_of
from edesign.calibration.results.law_file import ARRANGEMENT
from edesign.calibration.search.problem import Effect
from edesign.damper.history import spline_velocity
from edesign.damper.law import Law
from edesign.damper.testing.measured_histories import Use
from edesign.damper.testing.property_table import PropertyTable
from edesign.damper.testing.specimen import Specimen
from edesign.damper.testing.steady_state import PropertyRows, force_amplitudes, unit_motion
from edesign.estimation.model import PredictionError
from edesign.estimation.parameters import Parameter

# what fades, wears or drifts is gone in the mean of late cycles of tests of which the order is unknown
_SHOWN = {
    *("payne", "hardening", "relaxation_branch", "velocity_exponent", "temperature_law"),
    *("friction", "play", "series_flexibility", "lag", "gain", "inertia"),
}
_ONE_TEST = "_from_test_"  # in names of forms that begin at a test


class SteadyTest(Experiment):
    """A row as a test, in place of its force the ellipse of its moduli: its cycles have the samples that they need."""

    def parts(self, refined: float) -> int:
        """Return 1: no step is cut."""
        return 1


@dataclass(frozen=True, eq=False)
class PropertyProblem(TestedProblem):
    """Rows of a property table, in groups: the tests of the search.

    A value is a property over the measured one, so that all measured values are 1 and a residual is a relative error.

    Attributes:
        table: the rows.
        specimen: what was tested.
        groups: of the rows.
        inner: the law, with a test for each row.
        cycles, samples: of these tests, as of `steady_state.predict`.
    """

    table: PropertyTable
    specimen: Specimen
    groups: tuple[Group, ...]
    inner: DamperProblem
    cycles: tuple[int, int]
    samples: int

    @property
    def base(self) -> tuple[Parameter, ...]:
        """Parameters of the law with priors about what is declared."""
        return self.inner.base

    @property
    def uses(self) -> tuple[Use, ...]:
        """Use of each group."""
        return tuple(group.use for group in self.groups)

    @cached_property
    def repeats(self) -> float:
        """How well rows repeat: relative standard deviation of a property."""
        return noise_of(self.table)

    @cached_property
    def deviations(self) -> tuple[float, ...]:
        """How well rows repeat, of each group that is fitted."""
        return (self.repeats,) * len(self.used_for("fit"))

    @cached_property
    def sizes(self) -> tuple[float, ...]:
        """Size of the measured values of each group that is fitted: 1."""
        return (1.0,) * len(self.used_for("fit"))

    @cached_property
    def effects(self) -> tuple[Effect, ...]:
        """Effects that steady cycles, or what was read from them, can show."""
        steady = [one for one in self.inner.effects if one.name in _SHOWN and _in_every_row(one)]
        arranged = [form.effect(self.inner.typical) for form in arrangement.FORMS if self.inner.law.name in form.laws]
        return (*steady, *arranged, *(form.effect(self.inner.typical) for form in reading.FORMS))

    def model(self, effects: Sequence[Effect], uses: Sequence[Use] = ("fit",)) -> PropertyModel:
        """Return the law with effects; its parameters are those of the law, and of the effects in their order."""
        return PropertyModel(self, tuple(effects), self.used_for(*uses))


@dataclass(frozen=True, eq=False)
class PropertyModel(EffectModel[PropertyProblem]):
    """A law with effects, of some groups of rows, which are its tests."""

    @cached_property
    def measured(self) -> tuple[np.ndarray, ...]:
        """Ones (3 rows,) of each group: G', G_eq and loss factor of each row over themselves."""
        return tuple(np.ones(3 * self.problem.groups[i].rows.size) for i in self.tests)

    @cached_property
    def rows(self) -> np.ndarray:
        """Indices (n,) of the rows, ascending."""
        return np.sort(np.concatenate([self.problem.groups[i].rows for i in self.tests]))

    def predict(self, values: np.ndarray) -> list[Predicted]:
        """Return G', G_eq and loss factor over the measured ones (3 rows,) of each group for each set."""
        return [
            found if isinstance(found, PredictionError) else [self._ratios(found, i) for i in self.tests]
            for found in self.amplitudes(values)
        ]

    def amplitudes(self, values: np.ndarray) -> list[np.ndarray | PredictionError]:
        """Return force amplitudes (3, all rows), N: in phase, largest, of the energy; nan of rows of other groups.

        Args:
            values: (m, p) SI.
        """
        problem, sets = self.problem, [self._of(one) for one in np.atleast_2d(values)]
        _, _, rate = unit_motion(problem.cycles[1], problem.samples)
        asked = [(law, steady) for law, steady, _ in sets]
        found: list[np.ndarray | PredictionError] = []
        for forces, (_, _, readings) in zip(
            problem.inner.prediction.predict(asked, self.rows.tolist()), sets, strict=True
        ):
            if isinstance(forces, PredictionError):
                found.append(forces)
                continue
            here = np.full((3, len(problem.table)), np.nan)
            for row, force in zip(self.rows, forces, strict=True):
                here[:, row] = force_amplitudes(force, rate, problem.cycles, problem.samples)
            for one, p in readings:
                here = one.read(p, here)
            positive = bool(np.all(here[:, self.rows] > 0.0))
            found.append(here if positive else PredictionError("a modulus is not positive"))
        return found

    def forces(self, values: np.ndarray) -> Sequence[np.ndarray] | PredictionError:
        """Return the force (n,) N of the test of each row, in their order, as it is before it is read.

        Args:
            values: (p,) SI.
        """
        law, steady, _ = self._of(values)
        (forces,) = self.problem.inner.prediction.predict([(law, steady)], self.rows.tolist())
        return forces

    def properties(self, values: np.ndarray) -> PropertyRows:
        """Return the properties of all rows; nan of rows of other groups.

        Args:
            values: (p,) SI.

        Raises:
            PredictionError: there are none.
        """
        (found,) = self.amplitudes(values)
        if isinstance(found, PredictionError):
            raise found
        table = self.problem.table
        G_storage, G_eq, G_loss = found / (self.problem.specimen.area * table.strain)
        of = table.strain, table.frequency, table.temperature_C
        return PropertyRows(*of, G_storage, G_eq, G_loss, G_loss / G_storage)

    def _of(
        self, values: np.ndarray
    ) -> tuple[dict[str, float], list[tuple[FormInCampaign, Values]], list[tuple[Reading, Values]]]:
        """Return the law's parameters, effects on the loops and those of reading, with theirs."""
        law = {**self.problem.inner.declared, **self.base_values(values)}
        steady: list[tuple[FormInCampaign, Values]] = []
        readings: list[tuple[Reading, Values]] = []
        for of, p in self.effect_values(values):
            if isinstance(of.form, ReadingForm):
                readings += [(mechanism, p) for mechanism in of.form.mechanisms]
            else:
                steady.append((of, law if of.form.name == ARRANGEMENT else p))
        return law, steady, readings

    def _ratios(self, amplitudes: np.ndarray, group: int) -> np.ndarray:
        table, rows = self.problem.table, self.problem.groups[group].rows
        in_phase, largest, out_of_phase = amplitudes[:, rows]
        area = self.problem.specimen.area * table.strain[rows]
        storage, equivalent = area * table.G_storage[rows], area * table.G_eq[rows]
        return np.concatenate(
            (in_phase / storage, largest / equivalent, out_of_phase / in_phase / table.loss_factor[rows])
        )


def steady_tests(
    table: PropertyTable, specimen: Specimen, groups: Sequence[Group], cycles: int, samples: int
) -> tuple[SteadyTest, ...]:
    """Return the rows of a table as tests.

    Args:
        specimen: what was tested.
        groups: of the rows, with their use.
        cycles: full cycles of each test.
        samples: of a cycle.
    """
    use = {int(row): group.use for group in groups for row in group.rows}
    unit_time, unit, rate = unit_motion(cycles, samples)
    found = []
    for row in range(len(table)):
        f, strain = float(table.frequency[row]), float(table.strain[row])
        amplitude, time = strain * specimen.layer_thickness, unit_time / f
        velocity = amplitude * f * rate
        motion = Motion(time, amplitude * unit, velocity, spline_velocity(time, velocity))
        moduli = table.G_storage[row] * unit + table.G_loss[row] * rate / (2.0 * np.pi)
        force = specimen.area * strain * moduli
        degrees = float(table.temperature_C[row])
        found.append(SteadyTest(f"row {row + 1}", use[row], row, 0.0, motion, force, degrees))
    return tuple(found)


def problem_of(
    table: PropertyTable,
    specimen: Specimen,
    groups: Sequence[Group],
    law: Law,
    declared: Values,
    refit: bool,
    cycles: tuple[int, int],
    samples: int,
    threads: int | None = None,
) -> PropertyProblem:
    """Return the problem of a table.

    Args:
        specimen: what was tested.
        law: declared.
        declared: its parameters, all of them in the order of the core, SI.
        refit: whether they are only a first guess.
        cycles: of the simulated tests that are averaged, first and last.
        samples: of such a cycle.
        threads: of predictions, at most so many; None: as many as there are processors.
    """
    tests = steady_tests(table, specimen, groups, cycles[1], samples)
    inner = DamperProblem(law, declared, tests, Sizes.of(tests), refit, threads=threads)
    return PropertyProblem(table, specimen, tuple(groups), inner, cycles, samples)


def _in_every_row(effect: Effect) -> bool:
    form: EffectForm = effect.data.form
    return (
        _ONE_TEST not in form.form
        and not form.nuisance
        and not any(isinstance(a, LastingExtremes) for a in form.mechanisms)
    )
