"""Virtual tests as groups of an archive."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from edesign.archive.dataset import Group, Variable
from edesign.substructure.indicators import definitions
from edesign.substructure.virtual_tests import TestResults, VirtualTest

PLACE = "tests"
HISTORIES = {
    "target": (
        ("target", "m", "target displacement of the specimen"),
        ("target_velocity", "m/s", "target velocity"),
        ("target_acceleration", "m/s^2", "target acceleration"),
    ),
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
    """Yield the groups of a test with their places: what drove it, then one for each compensator.

    Args:
        results: of the test.
        histories: which are kept, by the names of `outputs: histories`.
    """
    yield f"{PLACE}/{results.name}", _test(results)
    for run in results.runs:
        yield f"{PLACE}/{results.name}/{run.compensator}", _run(run, histories)


def _test(results: TestResults) -> Group:
    drive, direct = results.drive, results.direct
    group = Group(attributes={"kind": results.kind, "source": drive.source})
    group.coords["time"] = Variable(("time",), drive.time, "s", "time at the main steps")
    if drive.ground is not None:
        group.add("ground", ("time",), drive.ground, "m/s^2", "ground acceleration")
    if direct is not None:
        group.add("direct_deformation", ("time",), direct.deformation, "m", "deformation of the damper, without a test")
        group.add("direct_force", ("time",), direct.force, "N", "force of the damper, without a test")
        group.coords["floor"] = Variable(("floor",), np.arange(1, direct.floors.shape[1] + 1), "1", "floor, from below")
        group.add("direct_floors", ("time", "floor"), direct.floors, "m", "displacement of the floors, without a test")
    return group


def _run(run: VirtualTest, histories: Sequence[str]) -> Group:
    group = Group(
        attributes={"kind": run.kind, "outcome": run.outcome, "reason": run.reason, "saturated": list(run.saturated)}
    )
    text = "root mean square error of the damper's deformation over the direct one"
    group.add("response_error", (), run.response_error, "1", text)
    group.add("peak_error", (), run.peak_error, "1", "relative error of its largest magnitude")
    for i, unit in enumerate(("1", "s", "s^2")):
        group.add(f"mean_alpha_{i}", (), run.alpha[i], unit, f"mean of alpha_{i} while the specimen moves")
    if run.tracking is not None:
        for name, (text, unit) in definitions().items():
            value = getattr(run.tracking, name, None)
            if isinstance(value, (int, float)):
                group.add(name, (), float(value), unit, text)
        group.attributes["untold"] = [f"{name}: {why}" for name, why in run.tracking.untold.items()]
    _add_histories(group, run, histories)
    return group


def _add_histories(group: Group, run: VirtualTest, histories: Sequence[str]) -> None:
    record = run.record
    if record is None:
        return
    group.coords["time"] = Variable(("time",), run.time, "s", "time at the main steps")
    for kept in histories:
        for name, unit, text in HISTORIES.get(kept, ()):
            group.add(name, ("time",), getattr(record, name), unit, text)
    if "alpha" in histories and record.alpha.any():
        for i, unit in enumerate(("1", "s", "s^2")):
            group.add(f"alpha_{i}", ("time",), record.alpha[:, i], unit, f"coefficient alpha_{i} of the compensator")
        group.add("limited", ("time",), record.limited, "1", "bits 0 to 2: alpha_0 to alpha_2 at a limit or rate")
        text = "smallest pivot of the correlation matrix of displacement, velocity, acceleration"
        group.add("independence", ("time",), record.independence, "1", text)
    if "energy" in histories:
        late = record.measured - record.target
        work = np.concatenate([[0.0], np.cumsum(0.5 * (record.force[1:] + record.force[:-1]) * np.diff(late))])
        group.add("interface_energy_error", ("time",), work, "J", "work that the test feeds into the structure")
    if run.floors.shape[1]:
        group.coords["floor"] = Variable(("floor",), np.arange(1, run.floors.shape[1] + 1), "1", "floor, from below")
        group.add("floors", ("time", "floor"), run.floors, "m", "displacement of the floors in the numerical part")
