"""Virtual substructure tests as tables and as plain data."""

from __future__ import annotations

import math
from dataclasses import dataclass

from edesign.archive.dataset import Group
from edesign.archive.reader import Archive
from edesign.report.tables.table import Table, number
from edesign.report.tables.text import wrapped
from edesign.substructure.archived import INDICATORS, PLACE
from edesign.substructure.met_limits import MetLimit, in_words

METHODS = {
    "pseudo_dynamic": "pseudo-dynamic",
    "effective_force": "effective force",
    "shaking_table": "shaking table",
}
QUANTITIES = {
    "response_error": ("response error, rms [%]", 0.01),
    "amplification": ("largest growth in a step", 1.0),
    "least_damping": ("least damping ratio [%]", 0.01),
    "force_ratio": ("force/command, mode 1", 1.0),
    "added_damping": ("damping added, mode 1 [%]", 0.01),
    "force_error": ("force error, rms [%]", 0.01),
    "table_error": ("table error, rms [%]", 0.01),
    "table_delay": ("delay of the table [ms]", 1e-3),
}
"""What tests by other methods show: name with the unit shown, and that unit in SI."""
ROUNDING = 1e-12
"""Ratios, s and J below it are rounding of a perfect rig."""
HELD_THERE = "Of the rig: its motion, or the reading of the sensor, was held there; a force was not."
LIMIT_TIMES = ("first", "last", "duration")
"""What is told of a limit that was met, s."""
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

    def limits(self) -> list[tuple[str, float, float, float]]:
        """Return the limits of rig and sensors that the run met: name, first and last time, and duration in all, s."""
        met = [name for name in self.text("saturated").split(", ") if name]
        if any(f"limit_{what}" not in self.group.variables for what in LIMIT_TIMES):  # of an older version
            return [(name, _NAN, _NAN, _NAN) for name in met]
        names = [str(name) for name in self.group.coords["limit"].values]
        kept = [self.group.variables[f"limit_{what}"].values[self.number] for what in LIMIT_TIMES]
        first, last, duration = ([float(of[names.index(name)]) for name in met] for of in kept)
        return list(zip(met, first, last, duration, strict=True))

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
    """Return the tracking of each compensator, and the errors of the response.

    Raises:
        ArchiveError: a group is missing or damaged.
    """
    found = runs(archive)
    warned = archive.attributes.get("warnings")
    notes = [str(line) for line in warned] if isinstance(warned, list) else []
    tables = [_tracking(found), _response(archive, found), _alphas(found), other_methods(archive), rig_limits(found)]
    last = tables[1] if tables[1].rows else tables[0]  # given targets alone have no response
    last.notes += [line for note in notes for line in wrapped(note)]
    return tables


def other_methods(archive: Archive) -> Table:
    """Return the results of tests by other methods: pseudo-dynamic, effective force, shaking table.

    Raises:
        ArchiveError: a group is damaged.
    """
    most = response_error_limit(archive)
    table = Table(
        "Tests by other methods",
        ("test", "method", "quantity", "value", "verdict"),
        left=3,
        sentences=4,
        name="tests_by_other_methods",
    )
    told: list[str] = []
    for test in archive.names(PLACE):
        group = archive.group(f"{PLACE}/{test}").without("time")
        kind = str(group.attributes.get("kind"))
        if kind not in METHODS:
            continue
        cells = [test, METHODS[kind]]
        found = group.variables
        outcome = str(group.attributes["outcome"])
        error = float(found["response_error"].values) if "response_error" in found else _NAN
        verdict = outcome if outcome != "done" else _in_short(error, most)
        for name in sorted(found, key=lambda name: name != "response_error"):
            quantity, scale = QUANTITIES.get(name, (found[name].long_name, 1.0))
            table.rows.append([*cells, quantity, _shown(float(found[name].values), scale), verdict])
            cells, verdict = ["", ""], ""
        if not found:
            table.rows.append([*cells, "-", "-", verdict])
        lines = group.attributes.get("told")
        words = [str(line).rstrip(".") for line in lines] if isinstance(lines, list) else []
        told += wrapped(f"{test}: {'. '.join(words)}.") if words else []
    if table.rows:
        table.notes = wrapped(f"rms: root mean square error over that of the direct analysis; {_accepted(most)}")
    table.notes += told
    return table


def _tracking(found: list[Run]) -> Table:
    table = Table(
        "How the specimen followed its target",
        ("test", "compensator", "NRMS %", "root %", "delay ms", "A-1 %", "peak %", "work J"),
        left=2,
        notes=wrapped(
            "NRMS: squared errors over squared targets, without a root; root: with it; delay: mean of zero crossings; "
            "A: amplitude ratio by the frequency evaluation index (Guo et al. 2014); peak: largest error over largest "
            "target; work: interface energy error, which the tracking error feeds into the structure (Mosqueda et al. "
            "2007)"
        ),
        name="tracking",
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


def _response(archive: Archive, found: list[Run]) -> Table:
    most = response_error_limit(archive)
    table = Table(
        "What the test did to the response of the structure",
        ("test", "compensator", "rms [%]", "peak [%]", "storeys [%]", "verdict"),
        left=2,
        sentences=5,
        notes=wrapped(
            "rms, peak: errors of the deformation whose force the structure gets (the specimen's, or the target where "
            "the force is corrected), root mean square and of its largest value, against the direct analysis of the "
            "same structure; storeys: rms of the drift of the storey where it is largest; " + _accepted(most)
        ),
        name="response_errors",
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
    words = _in_short(error, most)
    if limits := run.limits():
        words += f"; it met {in_words([MetLimit(*one) for one in limits])}"
    return words


def _in_short(error: float, most: float) -> str:
    return "good" if error <= most else "too wrong"


def response_error_limit(archive: Archive) -> float:
    """Return the largest error of the response that the file accepts (ratio); infinity: it is not known."""
    limit = archive.attributes.get("response_error_limit")
    return float(limit) if isinstance(limit, (int, float)) else math.inf


def _accepted(most: float) -> str:
    return f"accepted: rms up to {100.0 * most:.3g} % (`criteria: response_error`)"


def rig_limits(found: list[Run]) -> Table:
    """Return the limits of rig and sensors that each run met; no rows if none was met."""
    table = Table(
        "Limits of the rig that were met",
        ("test", "compensator", "limit", "first [s]", "last [s]", "in all [s]"),
        left=3,
        notes=wrapped(f"in all: main steps in which it was met. {HELD_THERE}"),
        name="rig_limits",
    )
    for run in found:
        table.rows += [[run.test, run.compensator, *cells] for cells in limit_cells(run)]
    return table


def limit_cells(run: Run) -> list[list[str]]:
    """Return name, first time and duration (s) of each limit of rig and sensors that a run met."""
    return [[name, *(_shown(one, 1.0) for one in times)] for name, *times in run.limits()]


def _alphas(found: list[Run]) -> Table:
    table = Table(
        "Means of what adaptive compensators find while the specimen moves",
        ("test", "compensator", "alpha_0", "alpha_1 [ms]", "alpha_2 [1e-6 s2]", "delay [ms]"),
        left=2,
        name="adaptive_compensators",
    )
    for run in found:
        values = [run.value(f"mean_alpha_{i}") for i in range(3)]
        delay = run.value("estimated_delay")
        if not all(map(math.isnan, (*values, delay))):
            shown = (_shown(value, scale, 5) for value, scale in zip(values, (1.0, 1e-3, 1e-6), strict=True))
            table.rows.append([run.test, run.compensator, *shown, _shown(delay, 1e-3, 4)])
    if table.rows:
        table.notes = wrapped(
            "command = alpha_0 x + alpha_1 x' + alpha_2 x'' of the target x; delay: estimated delay of the rig, "
            "alpha_1 / alpha_0, or that of a live delay"
        )
    return table


def substructure_summary(archive: Archive) -> list[dict[str, object]]:
    """Return the runs for JSON, SI units: names, outcome, indicators; unknown values are None.

    Raises:
        ArchiveError: a group is missing or damaged.
    """
    found: list[dict[str, object]] = []
    for run in runs(archive):
        about = {name: run.text(name) for name in ("kind", "outcome", "reason", "saturated")}
        values = {
            name: _known(run.value(name))
            for name, variable in run.group.variables.items()
            if variable.unit != "" and "limit" not in variable.dims
        }
        limits = [
            {"limit": name, **{what: _known(one) for what, one in zip(LIMIT_TIMES, times, strict=True)}}
            for name, *times in run.limits()
        ]
        found.append({"test": run.test, "compensator": run.compensator, **about, "limits": limits, **values})
    return found


def _known(value: float) -> float | None:
    return None if math.isnan(value) else value


def _shown(value: float, scale: float, digits: int = 3) -> str:
    return number(_known(value), digits, scale, negligible=ROUNDING)
