"""Virtual tests as groups of an archive."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

import numpy as np

from edesign.archive.dataset import Group, Variable
from edesign.core.substructure import SATURATED
from edesign.study.results.kinds import ANALYSES, DIRECT
from edesign.study.run.outcome import FAILED
from edesign.substructure.indicators import definitions
from edesign.substructure.indicators.interface_energy import work_along
from edesign.substructure.methods import PseudoDynamicRecord
from edesign.substructure.methods.method_tests import MethodResults
from edesign.substructure.virtual_test import VirtualTest
from edesign.substructure.virtual_tests import TestResults

PLACE = "tests"
INDICATORS = "indicators"
"""Where what was found of all runs stands side by side."""
HISTORIES = {
    "target": (("target", "m", "target displacement of the specimen"),),
    "measured": (
        ("measured", "m", "displacement of the specimen as read"),
        ("deformation", "m", "displacement of the specimen, true"),
        ("actuator", "m", "displacement of the piston"),
    ),
    "command": (("command", "m", "command of the compensator"),),
    "force": (("force", "N", "force of the specimen as read"), ("true_force", "N", "force of the specimen, true")),
}
"""Channels by the names of `outputs: histories`: name, unit, meaning."""


def groups(results: TestResults, histories: Sequence[str]) -> Iterator[tuple[str, Group]]:
    """Yield the groups of a test with their places: what drove it, the histories of each compensator, the buildings.

    Args:
        histories: which are kept, by the names of `outputs: histories`.
    """
    yield f"{PLACE}/{results.name}", _test(results)
    for run in results.runs:
        group = Group(attributes={"outcome": run.outcome, "reason": run.reason})
        _add_histories(group, run, histories)
        yield f"{PLACE}/{results.name}/{run.compensator}", group
    if results.direct is not None:
        yield _analysis(results, results.direct.building)
        for run in results.runs:
            building = run.building or Group()
            if run.outcome != "done":
                failed = {"status": FAILED, "reason": run.reason}
                building = Group(building.coords, building.variables, building.attributes | failed)
            yield _analysis(results, building, run.compensator)


def building_name(test: str, compensator: str = "") -> str:
    """Return the name under which the building of a test stands among the analyses; of its direct one without both.

    Args:
        compensator: its name; "": the direct response.
    """
    return f"{test}:{compensator}" if compensator else test


def _analysis(results: TestResults, building: Group, compensator: str = "") -> tuple[str, Group]:
    """The response of the building as an analysis of `edesign run` is archived."""
    name = building_name(results.name, compensator)
    drive = results.drive
    assert drive.ground is not None
    # two tests may have one record: the test stands where studies have their level
    of_test = {"variant": compensator or DIRECT, "record": drive.record, "level": results.name}
    labels = {"name": name, "kind": "history", **of_test}
    motion = {
        "input_motion": drive.source,
        "input_pga_m_s2": float(np.max(np.abs(drive.ground))),
        "time_step_s": float(drive.time[1] - drive.time[0]),
    }
    attributes = {**labels, **motion, **building.attributes}
    return f"{ANALYSES}/{name}", Group(building.coords, building.variables, attributes)


def indicators(runs: Sequence[VirtualTest]) -> Group:
    """Return what was found of each run, side by side."""
    names = np.array([f"{run.test}/{run.compensator}" for run in runs])
    group = Group(coords={"run": Variable(("run",), names, "", "test/compensator")})
    for name, text in (
        ("kind", "of the test"),
        ("outcome", "done, unstable, saturated or failed"),
        ("reason", "why it is not done"),
    ):
        group.add(name, ("run",), np.array([getattr(run, name) for run in runs]), "", text)
    _add_limits(group, runs)
    text = "root mean square error of the deformation whose force the structure gets, over the direct deformation"
    group.add("response_error", ("run",), [run.response_error for run in runs], "1", text)
    text = "relative error of the largest deformation"
    group.add("peak_error", ("run",), [run.peak_error for run in runs], "1", text)
    text = "as the response error, of the drift of the storey where it is largest"
    group.add("building_error", ("run",), [run.building_error for run in runs], "1", text)
    for i, unit in enumerate(("1", "s", "s^2")):
        text = f"mean of alpha_{i} while the specimen moves"
        group.add(f"mean_alpha_{i}", ("run",), [run.alpha[i] for run in runs], unit, text)
    text = "mean of the delay that an adaptive compensator estimates while the specimen moves"
    group.add("estimated_delay", ("run",), [run.estimated_delay for run in runs], "s", text)
    for name, (text, unit) in definitions().items():
        values = [getattr(run.tracking, name, np.nan) for run in runs]
        if all(isinstance(value, (int, float)) for value in values):
            group.add(name, ("run",), np.array(values, dtype=float), unit, text)
    undetermined = [
        f"{run.test}/{run.compensator}: {name}: {why}" for run in runs for name, why in _undetermined(run).items()
    ]
    group.attributes["undetermined"] = undetermined
    return group


def _add_limits(group: Group, runs: Sequence[VirtualTest]) -> None:
    """Which limits of rig and sensors were met, when first, and for how long."""
    names = [", ".join(one.name for one in run.saturated) for run in runs]
    group.add("saturated", ("run",), np.array(names), "", "limits of the rig and its sensors that were met")
    group.coords["limit"] = Variable(("limit",), np.array(list(SATURATED.values())), "", "of the rig, or of a sensor")
    met = [{one.name: one for one in run.saturated} for run in runs]
    for name, text in (
        ("first", "end of the first main step in which a limit was met"),
        ("last", "end of the last main step in which a limit was met"),
        ("duration", "of the main steps in which a limit was met"),
    ):
        values = np.full((len(met), len(SATURATED)), np.nan)
        for i, of in enumerate(met):
            values[i] = [getattr(of.get(limit), name, np.nan) for limit in SATURATED.values()]
        group.add(f"limit_{name}", ("run", "limit"), values, "s", text)


def _undetermined(run: VirtualTest) -> Mapping[str, str]:
    return run.tracking.undetermined if run.tracking is not None else {}


def _test(results: TestResults) -> Group:
    drive, direct = results.drive, results.direct
    group = Group(attributes={"kind": results.kind, "source": drive.source})
    group.coords["time"] = Variable(("time",), drive.time, "s", "time at the main steps")
    if drive.ground is not None:
        group.add("ground", ("time",), drive.ground, "m/s^2", "ground acceleration")
    if direct is not None:
        group.add("direct_deformation", ("time",), direct.deformation, "m", "deformation of the damper, without a test")
        group.add("direct_force", ("time",), direct.force, "N", "force of the damper, without a test")
    return group


def _add_histories(group: Group, run: VirtualTest, histories: Sequence[str]) -> None:
    record = run.record
    if record is None:
        return
    group.coords["time"] = Variable(("time",), run.time, "s", "time at the main steps")
    for kept in histories:
        for name, unit, text in HISTORIES.get(kept, ()):
            group.add(name, ("time",), getattr(record, name), unit, text)
    if "force" in histories and record.force_is_corrected:
        text = "force on the numerical part: as read, and what the compensator adds"
        group.add("applied_force", ("time",), record.applied_force, "N", text)
    if "alpha" in histories and record.alpha.any():
        for i, unit in enumerate(("1", "s", "s^2")):
            group.add(f"alpha_{i}", ("time",), record.alpha[:, i], unit, f"coefficient alpha_{i} of the compensator")
        group.add("limited", ("time",), record.limited, "1", "bits 0 to 2: alpha_0 to alpha_2 at a limit or rate")
        text = "smallest pivot of the correlation matrix of displacement, velocity, acceleration"
        group.add("independence", ("time",), record.independence, "1", text)
    if "energy" in histories:
        work = work_along(record.force, record.measured) - work_along(record.applied_force, record.target)
        group.add("interface_energy_error", ("time",), work, "J", "work that the test feeds into the structure")


def method_group(results: MethodResults, time: np.ndarray) -> Group:
    """Return a test by another method.

    Args:
        time: (n,) s, of the earthquake.
    """
    group = Group(attributes={"kind": results.kind, "outcome": results.outcome, "told": list(results.notes)})
    record = results.record
    count = 0 if record is None else record.deformation.size
    group.coords["time"] = Variable(("time",), time[:count], "s", "time of the earthquake")
    if record is None:
        return group
    for name, values, unit, text in (
        ("deformation", record.deformation, "m", "deformation of the damper"),
        ("force", record.damper_force, "N", "force of the damper"),
        ("direct_deformation", record.direct_deformation, "m", "deformation of the damper, without a test"),
        ("direct_force", record.direct_force, "N", "force of the damper, without a test"),
    ):
        group.add(name, ("time",), values[:count], unit, text)
    if isinstance(record, PseudoDynamicRecord):
        group.add("target", ("time",), record.target, "m", "target displacement of the specimen")
        work = work_along(record.damper_force, record.deformation - record.target)
        group.add("interface_energy_error", ("time",), work, "J", "work that the test feeds into the structure")
    text = "root mean square error of the damper's deformation over the direct one"
    group.add("response_error", (), record.response_error, "1", text)
    for name, value, unit, text in results.figures:
        group.add(name, (), value, unit, text)
    return group
