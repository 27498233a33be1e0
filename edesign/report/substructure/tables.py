"""Virtual substructure tests as tables and as plain data."""

from __future__ import annotations

import math
import textwrap
from dataclasses import dataclass

from edesign.archive.dataset import Group
from edesign.archive.reader import Archive
from edesign.report.table import Table, number
from edesign.report.text import PAPER
from edesign.substructure.archived import INDICATORS, PLACE

METHODS = {
    "pseudo_dynamic": "pseudo-dynamic",
    "effective_force": "effective force",
    "shaking_table": "shaking table",
}
ROUNDING = 1e-12
"""Ratios, s and J below it are rounding of a perfect rig."""
_NAN = math.nan


@dataclass(frozen=True)
class Run:
    """A test with one compensator, as it stands in an archive: the group of indicators, and its number there."""

    test: str
    compensator: str
    group: Group
    number: int

    def value(self, name: str) -> float:
        """Return an indicator, NaN where it has none."""
        variable = self.group.variables.get(name)
        return float(variable.values[self.number]) if variable is not None else _NAN

    def text(self, name: str) -> str:
        """Return a text of the run."""
        return str(self.group.variables[name].values[self.number])


def runs(archive: Archive) -> list[Run]:
    """Return the runs of an archive in the order of its file; none of one that was interrupted.

    Raises:
        ArchiveError: the group is damaged.
    """
    if not archive.has(INDICATORS):
        return []
    group = archive.group(INDICATORS)
    names = [str(name).partition("/") for name in group.coords["run"].values]
    return [Run(test, compensator, group, i) for i, (test, _, compensator) in enumerate(names)]


def substructure_tables(archive: Archive) -> list[Table]:
    """Return how well each compensator followed, and what the error did to the structure.

    Raises:
        ArchiveError: a group is missing or damaged.
    """
    found = runs(archive)
    warned = archive.attributes.get("warnings")
    notes = [str(line) for line in warned] if isinstance(warned, list) else []
    return [_tracking(found), _response(archive, found, notes), _alphas(found), other_methods(archive)]


def other_methods(archive: Archive) -> Table:
    """Return what tests by other methods showed: pseudo-dynamic, effective force, shaking table.

    Raises:
        ArchiveError: a group is damaged.
    """
    table = Table("Tests by other methods", ("test", "method", "what it shows", "value"), left=3)
    for test in archive.names(PLACE):
        group = archive.group(f"{PLACE}/{test}").without("time")
        kind = str(group.attributes.get("kind"))
        if kind not in METHODS:
            continue
        cells = [test, METHODS[kind]]
        for variable in group.variables.values():
            unit = "" if variable.unit == "1" else f" {variable.unit}"
            table.rows.append([*cells, variable.long_name, f"{_shown(float(variable.values), 1.0)}{unit}"])
            cells = ["", ""]
        told = group.attributes.get("told")
        words = [str(line) for line in told] if isinstance(told, list) else []
        if group.attributes["outcome"] != "done":
            words.insert(0, str(group.attributes["outcome"]))
        if words:
            table.notes += textwrap.wrap(f"{test}: {'. '.join(words)}", PAPER)
    return table


def _tracking(found: list[Run]) -> Table:
    table = Table(
        "How the specimen followed its target",
        ("test", "compensator", "NRMS [%]", "root [%]", "late [ms]", "A-1 [%]", "peak [%]", "work [J]"),
        left=2,
        notes=[
            "NRMS: squared errors over squared targets, without a root as Eq. 6.28 of the thesis",
            "prints it; `root`: with it, as its tables hold. `late`: mean delay of zero crossings.",
            "A: amplitude by the frequency evaluation index. `peak`: largest error over largest",
            "target. `work`: what the error feeds into the structure.",
        ],
    )
    for run in found:
        if run.text("outcome") == "done":
            table.rows.append(
                [
                    run.test,
                    run.compensator,
                    _shown(run.value("nrms"), 0.01),
                    _shown(run.value("nrms_root"), 0.01),
                    _shown(run.value("crossing_delay_mean"), 1e-3),
                    _shown(run.value("frequency_index_amplitude") - 1.0, 0.01, 2),
                    _shown(run.value("maximum_error"), 0.01),
                    _shown(run.value("energy_error"), 1.0),
                ]
            )
        else:
            table.rows.append([run.test, run.compensator, run.text("outcome"), "-", "-", "-", "-", "-"])
    return table


def _response(archive: Archive, found: list[Run], notes: list[str]) -> Table:
    limit = archive.attributes.get("response_error_limit")
    most = float(limit) if isinstance(limit, (int, float)) else math.inf
    table = Table(
        "What the test did to the response of the structure",
        ("test", "compensator", "error rms [%]", "of peak [%]", "storeys [%]", "verdict"),
        left=2,
        sentences=5,
        notes=[
            f"Against the direct analysis of the same structure; at most {100.0 * most:.3g} % are allowed.",
            "`error rms` and `of peak`: of the damper's deformation. `storeys`: as `error rms`, of the",
            "drift of the storey where it is largest.",
            *notes,
        ],
    )
    for run in found:
        error = run.value("response_error")
        if run.text("outcome") == "done" and math.isnan(error):
            continue  # a given target: nothing responds
        table.rows.append(
            [
                run.test,
                run.compensator,
                _shown(error, 0.01),
                _shown(run.value("peak_error"), 0.01),
                _shown(run.value("building_error"), 0.01),
                _verdict(run, error, most),
            ]
        )
    return table


def _verdict(run: Run, error: float, most: float) -> str:
    if run.text("outcome") != "done":
        return f"{run.text('outcome')}: {run.text('reason')}"
    words = "good" if error <= most else "too wrong"
    if saturated := run.text("saturated"):
        words += f"; the rig met its limit of {saturated}"
    return words


def _alphas(found: list[Run]) -> Table:
    table = Table(
        "Means of the adaptive coefficients while the specimen moves",
        ("test", "compensator", "alpha_0", "alpha_1 [ms]", "alpha_2 [1e-6 s2]"),
        left=2,
    )
    for run in found:
        values = [run.value(f"mean_alpha_{i}") for i in range(3)]
        if not any(map(math.isnan, values)):
            shown = (_shown(value, scale, 5) for value, scale in zip(values, (1.0, 1e-3, 1e-6), strict=True))
            table.rows.append([run.test, run.compensator, *shown])
    return table


def substructure_summary(archive: Archive) -> list[dict[str, object]]:
    """Return the runs for JSON, SI units: names, outcome, indicators; None stands for what cannot be told.

    Raises:
        ArchiveError: a group is missing or damaged.
    """
    found: list[dict[str, object]] = []
    for run in runs(archive):
        about = {name: run.text(name) for name in ("kind", "outcome", "reason", "saturated")}
        values = {
            name: None if math.isnan(run.value(name)) else run.value(name)
            for name, variable in run.group.variables.items()
            if variable.unit != ""
        }
        found.append({"test": run.test, "compensator": run.compensator, **about, **values})
    return found


def _shown(value: float, scale: float, digits: int = 3) -> str:
    return number(None if math.isnan(value) else value, digits, scale, negligible=ROUNDING)
