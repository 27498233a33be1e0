"""Tests of a file by other methods: pseudo-dynamic, effective force, shaking table, each beside the direct response."""

from __future__ import annotations

from dataclasses import dataclass
from math import inf, nan

import numpy as np

from edesign.errors import AnalysisError, InputError
from edesign.project.substructure.programme import (
    AnyControlError,
    ControlNoise,
    EffectiveForceTest,
    Lag,
    PseudoDynamicTest,
    ShakingTableTest,
    Undershoot,
)
from edesign.substructure.laboratory import Laboratory
from edesign.substructure.methods import (
    ControlError,
    Forcing,
    MethodRecord,
    ShakingTable,
    effective_force_test,
    pseudo_dynamic_test,
    shaking_table_test,
)
from edesign.substructure.methods.pseudo_dynamic import NO_ERROR
from edesign.substructure.sized_damper import SizedDamper
from edesign.substructure.structure.numerical import LinearPart

MethodTest = PseudoDynamicTest | EffectiveForceTest | ShakingTableTest
UNLIKE = 0.05
"""Change of a damper's stiffness or loss in slow motion from which a pseudo-dynamic test is not valid for it: the error
of the response that criteria accept by default."""


@dataclass(frozen=True)
class MethodResults:
    """Results of a test by another method.

    Attributes:
        name, kind: of the test.
        record: None if the test failed.
        figures: what the method is known for: name, value, unit, meaning.
        notes: sentences for people.
        outcome: `done`, `unstable` or `failed`; the reason is in `notes`.
    """

    name: str
    kind: str
    record: MethodRecord | None
    figures: tuple[tuple[str, float, str, str], ...]
    notes: tuple[str, ...]
    outcome: str = "done"


def run_method(
    test: MethodTest, laboratory: Laboratory, step: float, ground: np.ndarray, abort: float = inf
) -> MethodResults:
    """Run a test by another method.

    Args:
        step: of the integration, s.
        ground: (n,) ground acceleration at the steps, m/s2.
        abort: deformation of the damper that ends a pseudo-dynamic test, m.

    Raises:
        InputError: the structure or a number makes the test impossible.
    """
    structure, damper = laboratory.structure, laboratory.damper
    if structure is None or damper is None:
        raise InputError(f"test {test.name}: this method needs a `structure` and a `specimen` [E-KEY-02]")
    setting = _Setting(structure.part, SizedDamper(damper.values, damper.scales), step, ground)
    try:
        if isinstance(test, PseudoDynamicTest):
            return _pseudo_dynamic(test, setting, abort)
        if isinstance(test, EffectiveForceTest):
            return _effective_force(test, setting)
        return _shaking_table(test, setting)
    except InputError as error:
        raise InputError(f"test {test.name}: {error}") from error
    except AnalysisError as error:
        return MethodResults(test.name, test.kind, None, (), (str(error),), outcome="failed")


@dataclass(frozen=True)
class _Setting:
    part: LinearPart
    device: SizedDamper
    step: float
    ground: np.ndarray


def _pseudo_dynamic(test: PseudoDynamicTest, of: _Setting, abort: float) -> MethodResults:
    record = pseudo_dynamic_test(
        of.part,
        of.device,
        of.step,
        of.ground,
        time_scale=test.time_scale,
        error=_control_error(test.error),
        feedback=test.feedback,
        physical=test.physical,
        abort=abort,
    )
    least = float(np.min(record.damping)) if record.damping.size else nan  # no mode oscillates
    figures = (
        ("amplification", record.amplification, "1", "largest growth of a motion in a step"),
        ("least_damping", least, "1", "least damping ratio of the test"),
    )
    notes = record.rate.sentence(UNLIKE)
    if record.aborted:  # no method is valid then, whatever the rate does to the damper
        notes = "The method is not valid for this test: the motion left the abort displacement."
    return MethodResults(test.name, test.kind, record, figures, (notes,), "unstable" if record.aborted else "done")


def _control_error(described: AnyControlError | None) -> ControlError:
    match described:
        case Undershoot():
            return ControlError(undershoot=described.share)
        case Lag():
            return ControlError(lag=described.displacement)
        case ControlNoise():
            return ControlError(noise=described.displacement, seed=described.seed)
    return NO_ERROR


def forcing_of(test: EffectiveForceTest) -> Forcing:
    """Return the actuators of an effective force test."""
    return Forcing(test.gain, test.oil_stiffness or inf, test.velocity_feedback)


def table_of(test: ShakingTableTest) -> ShakingTable:
    """Return the shaking table of a test."""
    return ShakingTable(test.table.mass, test.table.oil_frequency, test.table.gain, test.table.leakage)


def _effective_force(test: EffectiveForceTest, of: _Setting) -> MethodResults:
    record = effective_force_test(of.part, of.device, of.step, of.ground, forcing_of(test))
    figures = (
        ("force_ratio", float(abs(record.force_ratio[0])), "1", "force over command at the first frequency"),
        ("added_damping", float(record.added_damping[0]), "1", "damping ratio that actuators add to mode 1"),
        ("force_error", record.force_error, "1", "root mean square error of the force"),
    )
    return MethodResults(test.name, test.kind, record, figures, ())


def _shaking_table(test: ShakingTableTest, of: _Setting) -> MethodResults:
    record = shaking_table_test(of.part, of.device, of.step, of.ground, table_of(test), iterations=test.iterations)
    figures = (
        ("table_error", float(record.table_errors[-1]), "1", "root mean square error of the table"),
        ("table_delay", record.delay, "s", "by which the table is late as a whole"),
    )
    return MethodResults(test.name, test.kind, record, figures, ())
