"""A property table as a problem of the loop: each row a steady sinusoidal test, predicted by the law with effects."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from edesign.calibrate.dampers.effects.relaxation_branch import Maxwell
from edesign.calibrate.dampers.effects.velocity_exponent import Dashpot
from edesign.calibrate.dampers.left import Left
from edesign.calibrate.dampers.library import candidate_of
from edesign.calibrate.dampers.problem import DamperProblem
from edesign.calibrate.dampers.trial import Motion, Sizes, Trial
from edesign.calibrate.problem import AlwaysFine, Candidate, Part, Piece, Use
from edesign.calibrate.properties.arrangement import Arrangement
from edesign.calibrate.properties.campaign import Group, PropertyCampaign
from edesign.calibrate.properties.candidates import candidates_of
from edesign.calibrate.properties.reading import Reading
from edesign.calibrate.unknown import Unknown
from edesign.damper.history import spline_velocity
from edesign.damper.laws import law as law_of
from edesign.damper.parameters import read_parameters
from edesign.damper.testing.property_table import PropertyTable
from edesign.damper.testing.specimen import Specimen
from edesign.damper.testing.steady_state import CYCLES, SAMPLES, PropertyRows, force_amplitudes, unit_motion

QUICK_CYCLES, QUICK_SAMPLES = (2, 2), 60
"""Of the search: the second full cycle differs from cycles 5 to 15 by less than tables repeat."""


@dataclass(frozen=True, eq=False)
class PropertyProblem(AlwaysFine):
    """Rows of a property table, in groups.

    A value is a property over the measured one, so that all measured values are 1 and a residual is a relative error.

    Attributes:
        table: the rows.
        specimen: what was tested.
        groups: of the rows: the tests of the loop.
        inner: a trial for each row.
        cycles, samples: of the trials, as of `steady_state.predict`.
    """

    table: PropertyTable
    specimen: Specimen
    groups: tuple[Group, ...]
    inner: DamperProblem
    cycles: tuple[int, int]
    samples: int

    @cached_property
    def names(self) -> tuple[str, ...]:
        """Of the groups."""
        return tuple(group.name for group in self.groups)

    @cached_property
    def uses(self) -> tuple[Use, ...]:
        """Of the groups."""
        return tuple(group.use for group in self.groups)

    @cached_property
    def base(self) -> tuple[Unknown, ...]:
        """Parameters of the law."""
        return self.inner.base

    @cached_property
    def declared(self) -> np.ndarray:
        """Their declared values, SI."""
        return self.inner.declared

    @cached_property
    def measured(self) -> tuple[np.ndarray, ...]:
        """Ones (3 rows,): G', G_eq and loss factor of each row over themselves."""
        return tuple(np.ones(3 * group.rows.size) for group in self.groups)

    def candidates(self, residuals: Sequence[np.ndarray]) -> tuple[Candidate, ...]:
        """Effects that steady cycles can show."""
        return candidates_of(self.inner)

    def predict(self, base: np.ndarray, parts: Sequence[Part], uses: Sequence[Use]) -> list[np.ndarray | None]:
        """G', G_eq and loss factor over the measured ones (3 rows,) of each group used so; None for the others."""
        amplitudes = self.force_amplitudes(base, parts, uses)
        return [self._ratios(amplitudes, group) if group.use in uses else None for group in self.groups]

    def judged(self, index: int) -> tuple[Piece, ...]:
        """All of a group."""
        return (Piece(self.names[index], slice(None)),)

    def weight(self, index: int) -> np.ndarray | None:
        """None: noise is as strong at all times."""
        return None

    def left(self, residuals: Sequence[np.ndarray], noise: Sequence[float]) -> float:
        """Mean square of the residuals in units of noise."""
        return sum(float(r @ r) for r in residuals) / sum(r.size for r in residuals)

    def force_amplitudes(self, base: np.ndarray, parts: Sequence[Part], uses: Sequence[Use]) -> np.ndarray:
        """Force amplitudes (3, rows) N: in phase, largest, of the energy dissipated, as read; nan where not used so."""
        _, _, rate = unit_motion(self.cycles[1], self.samples)
        found = np.full((3, len(self.table)), np.nan)
        for i, force in enumerate(self.forces(base, parts, uses)):
            if force is not None:
                found[:, i] = force_amplitudes(force, rate, self.cycles, self.samples)
        for candidate, values in parts:
            form, fixed = candidate.effect
            if isinstance(form, Reading):
                own = {u.name: float(v) for u, v in zip(candidate.unknowns, values, strict=True)}
                found = form.read({**own, **fixed}, found)
        return found

    def forces(self, base: np.ndarray, parts: Sequence[Part], uses: Sequence[Use]) -> list[np.ndarray | None]:
        """Force (n,) N of each row used so; None for the others.

        Raises:
            PredictionError: the model has no prediction for these values.
        """
        return self.inner.predict(base, self.extended(base, parts), uses)

    def rows(self, base: np.ndarray, parts: Sequence[Part]) -> PropertyRows:
        """Properties of all rows."""
        amplitudes = self.force_amplitudes(base, parts, ("fit", "validate"))
        table = self.table
        G_storage, G_eq, G_loss = amplitudes / (self.specimen.area * table.strain)
        return PropertyRows(
            table.strain, table.frequency, table.temperature_C, G_storage, G_eq, G_loss, G_loss / G_storage
        )

    def extended(self, base: np.ndarray, parts: Sequence[Part]) -> tuple[Part, ...]:
        """Parts with what stands beside a rearranged law."""
        values = self.inner.law_values(base)
        found = list(parts)
        for candidate, _ in parts:
            form, _ = candidate.effect
            if isinstance(form, Arrangement):
                for name, kind, own in form.beside(values):
                    beside = _candidate(name, kind, self.inner)
                    found.append((beside, np.array([own[unknown.name] for unknown in beside.unknowns])))
        return tuple(found)

    def _ratios(self, amplitudes: np.ndarray, group: Group) -> np.ndarray:
        in_phase, largest, out_of_phase = amplitudes[:, group.rows]
        table, rows = self.table, group.rows
        area = self.specimen.area * table.strain[rows]
        return np.concatenate(
            (
                in_phase / (area * table.G_storage[rows]),
                largest / (area * table.G_eq[rows]),
                out_of_phase / in_phase / table.loss_factor[rows],
            )
        )


def property_problem(
    campaign: PropertyCampaign, cycles: tuple[int, int] = QUICK_CYCLES, samples: int = QUICK_SAMPLES
) -> PropertyProblem:
    """The problem of a campaign.

    Args:
        campaign: table and declared law.
        cycles, samples: of the simulated tests, as of `steady_state.predict`; as measured: CYCLES, SAMPLES.
    """
    assert campaign.law.parameters is not None
    law = law_of(campaign.law.type)
    start: Mapping[str, float] = read_parameters(law, campaign.law.parameters)
    use = {int(row): group.use for group in campaign.groups for row in group.rows}
    rows = range(len(campaign.table))
    trials = tuple(_trial(campaign.table, campaign.specimen, row, use[row], cycles[1], samples) for row in rows)
    # the samples of a simulated cycle are as many as are needed
    inner = DamperProblem(law, start, trials, Sizes.of(trials), fineness=0.0)
    return PropertyProblem(campaign.table, campaign.specimen, campaign.groups, inner, cycles, samples)


def as_measured(campaign: PropertyCampaign) -> PropertyProblem:
    """The problem with the cycles and samples of a measured test."""
    return property_problem(campaign, CYCLES, SAMPLES)


def at_rows(problem: PropertyProblem, table: PropertyTable) -> PropertyProblem:
    """The same law and effects for other rows, all of them for validation; sizes stay those of the campaign."""
    group = Group("further", "validate", np.arange(len(table)))
    of = problem.specimen, problem.cycles[1], problem.samples
    trials = tuple(_trial(table, of[0], row, "validate", *of[1:]) for row in range(len(table)))
    return replace(problem, table=table, groups=(group,), inner=replace(problem.inner, trials=trials))


def _trial(table: PropertyTable, specimen: Specimen, row: int, use: Use, cycles: int, samples: int) -> Trial:
    """A row as a test; in place of its force the ellipse of its storage and loss modulus."""
    time, shape, rate = unit_motion(cycles, samples)
    f = float(table.frequency[row])
    amplitude = float(table.strain[row]) * specimen.layer_thickness
    time = time / f
    velocity = amplitude * f * rate
    motion = Motion(time, amplitude * shape, velocity, spline_velocity(time, velocity))
    moduli = table.G_storage[row] * shape + table.G_loss[row] * rate / (2.0 * np.pi)
    force = specimen.area * table.strain[row] * moduli
    return Trial(f"row {row + 1}", use, 0, motion, force, np.full(time.size, table.temperature_C[row]))


_BESIDE = {("relaxation_branch", "maxwell"): Maxwell, ("velocity_exponent", "dashpot"): Dashpot}


def _candidate(name: str, form: str, problem: DamperProblem) -> Candidate:
    found = candidate_of(_BESIDE[(name, form)](), problem.sizes, Left())
    assert found is not None
    return found
