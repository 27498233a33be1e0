"""Tests of a file by other methods: pseudo-dynamic, effective force, shaking table, each beside the direct response."""

from __future__ import annotations

from dataclasses import dataclass
from math import inf

import numpy as np

from edesign.archive.dataset import Group, Variable
from edesign.errors import AnalysisError, InputError
from edesign.project.substructure.programme import EffectiveForceTest, PseudoDynamicTest, ShakingTableTest
from edesign.substructure.indicators.interface_energy import work_along
from edesign.substructure.laboratory import Laboratory
from edesign.substructure.methods import (
    ControlError,
    Forcing,
    ShakingTable,
    effective_force_test,
    pseudo_dynamic_test,
    shaking_table_test,
)
from edesign.substructure.sized_damper import SizedDamper
from edesign.substructure.structure.numerical import LinearPart

MethodTest = PseudoDynamicTest | EffectiveForceTest | ShakingTableTest
UNLIKE = 0.05
"""Change of a damper's stiffness or loss in slow motion from which a pseudo-dynamic test is not valid for it: the error
of the response that criteria accept by default."""


@dataclass(frozen=True)
class MethodResults:
    """What a test by another method showed.

    Attributes:
        name, kind: of the test.
        time: (n,) s, of the earthquake.
        deformation, force: (n,) of the damper in the test, m and N; shorter if it was ended.
        direct_deformation, direct_force: (n,) of the damper without a test, m and N.
        response_error: root mean square error over the direct response.
        figures: what the method is known for: name, value, unit, meaning.
        told: sentences for people.
        outcome: `done`, `unstable` or `failed`; the reason is told.
        target: (n,) deformation that a pseudo-dynamic test asks for, m; None: the method has none.
    """

    name: str
    kind: str
    time: np.ndarray
    deformation: np.ndarray
    force: np.ndarray
    direct_deformation: np.ndarray
    direct_force: np.ndarray
    response_error: float
    figures: tuple[tuple[str, float, str, str], ...]
    told: tuple[str, ...]
    outcome: str = "done"
    target: np.ndarray | None = None


def run_method(
    test: MethodTest, laboratory: Laboratory, time: np.ndarray, ground: np.ndarray, abort: float = inf
) -> MethodResults:
    """Run a test by another method.

    Args:
        test: of the file.
        laboratory: structure and damper.
        time: (n,) s at the steps of the integration.
        ground: (n,) ground acceleration, m/s2.
        abort: deformation of the damper that ends a pseudo-dynamic test, m.

    Raises:
        InputError: the structure or a number makes the test impossible.
    """
    structure, damper = laboratory.structure, laboratory.damper
    if structure is None or damper is None:
        raise InputError(f"test {test.name}: this method needs a `structure` and a `specimen`")
    setting = _Setting(structure.part, SizedDamper(damper.values, damper.scales), time, ground)
    try:
        if isinstance(test, PseudoDynamicTest):
            return _pseudo_dynamic(test, setting, abort)
        if isinstance(test, EffectiveForceTest):
            return _effective_force(test, setting)
        return _shaking_table(test, setting)
    except InputError as error:
        raise InputError(f"test {test.name}: {error}") from error
    except AnalysisError as error:
        none = np.zeros(0)
        return MethodResults(
            test.name, test.kind, time, none, none, none, none, np.nan, (), (str(error),), outcome="failed"
        )


@dataclass(frozen=True)
class _Setting:
    part: LinearPart
    device: SizedDamper
    time: np.ndarray
    ground: np.ndarray

    @property
    def step(self) -> float:
        return float(self.time[1] - self.time[0])


def _pseudo_dynamic(test: PseudoDynamicTest, of: _Setting, abort: float) -> MethodResults:
    slow = pseudo_dynamic_test(
        of.part,
        of.device,
        of.step,
        of.ground,
        time_scale=test.time_scale,
        error=ControlError(undershoot=test.error.share if test.error is not None else 0.0),
        feedback=test.feedback,
        abort=abort,
    )
    return MethodResults(
        name=test.name,
        kind=test.kind,
        time=of.time,
        deformation=slow.measured,
        force=slow.force,
        direct_deformation=slow.direct_deformation,
        direct_force=slow.direct_force,
        response_error=slow.response_error,
        figures=(
            ("amplification", slow.amplification, "1", "largest growth of a motion in a step"),
            ("least_damping", float(np.min(slow.damping, initial=inf)), "1", "least damping ratio of the test"),
        ),
        told=(slow.rate.sentence(UNLIKE), *(("the motion left the abort displacement",) if slow.aborted else ())),
        outcome="unstable" if slow.aborted else "done",
        target=slow.target,
    )


def _effective_force(test: EffectiveForceTest, of: _Setting) -> MethodResults:
    forcing = Forcing(test.gain, velocity_feedback=float(test.velocity_feedback))
    pushed = effective_force_test(of.part, of.device, of.step, of.ground, forcing)
    return MethodResults(
        name=test.name,
        kind=test.kind,
        time=of.time,
        deformation=pushed.deformation,
        force=pushed.damper_force,
        direct_deformation=pushed.direct_deformation,
        direct_force=pushed.direct_force,
        response_error=pushed.response_error,
        figures=(
            ("force_ratio", float(abs(pushed.force_ratio[0])), "1", "force over command at the first frequency"),
            ("added_damping", float(pushed.added_damping[0]), "1", "damping ratio that actuators add to mode 1"),
            ("force_error", pushed.force_error, "1", "root mean square error of the force"),
        ),
        told=(),
    )


def _shaking_table(test: ShakingTableTest, of: _Setting) -> MethodResults:
    table = ShakingTable(test.table.mass, test.table.oil_frequency, test.table.gain)
    shaken = shaking_table_test(of.part, of.device, of.step, of.ground, table)
    return MethodResults(
        name=test.name,
        kind=test.kind,
        time=of.time,
        deformation=shaken.deformation,
        force=shaken.damper_force,
        direct_deformation=shaken.direct_deformation,
        direct_force=shaken.direct_force,
        response_error=shaken.response_error,
        figures=(
            ("table_error", float(shaken.table_errors[-1]), "1", "root mean square error of the table"),
            ("table_delay", shaken.delay, "s", "by which the table is late as a whole"),
        ),
        told=(),
    )


def method_group(results: MethodResults) -> Group:
    """Return a test by another method as a group of an archive."""
    group = Group(attributes={"kind": results.kind, "outcome": results.outcome, "told": list(results.told)})
    count = results.deformation.size
    group.coords["time"] = Variable(("time",), results.time[:count], "s", "time of the earthquake")
    for name, unit, text in (
        ("deformation", "m", "deformation of the damper"),
        ("force", "N", "force of the damper"),
        ("direct_deformation", "m", "deformation of the damper, without a test"),
        ("direct_force", "N", "force of the damper, without a test"),
    ):
        group.add(name, ("time",), getattr(results, name)[:count], unit, text)
    if results.target is not None:
        group.add("target", ("time",), results.target, "m", "target displacement of the specimen")
        work = work_along(results.force, results.deformation - results.target)
        group.add("interface_energy_error", ("time",), work, "J", "work that the test feeds into the structure")
    group.add("response_error", (), results.response_error, "1", "root mean square error over the direct response")
    for name, value, unit, text in results.figures:
        group.add(name, (), value, unit, text)
    return group
