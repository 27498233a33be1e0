"""Virtual substructure tests as tables and as plain data."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass

from edesign.archive.dataset import Group
from edesign.archive.reader import Archive
from edesign.report.tables.cell import Quantity, Value, Verdict
from edesign.report.tables.column import Column, col, text
from edesign.report.tables.table import Row, Table, TableSpec
from edesign.report.tables.text import wrapped
from edesign.report.tables.unit import MS, ONE, PERCENT, J, S, Unit
from edesign.substructure.archived import INDICATORS, PLACE
from edesign.substructure.met_limits import MetLimit, in_words

METHODS = {
    "pseudo_dynamic": "pseudo-dynamic",
    "effective_force": "effective force",
    "shaking_table": "shaking table",
}
QUANTITIES = {
    "response_error": ("response error, rms [%]", PERCENT),
    "amplification": ("largest growth in a step", ONE),
    "least_damping": ("least damping ratio [%]", PERCENT),
    "force_ratio": ("force/command, mode 1", ONE),
    "added_damping": ("damping added, mode 1 [%]", PERCENT),
    "force_error": ("force error, rms [%]", PERCENT),
    "table_error": ("table error, rms [%]", PERCENT),
    "table_delay": ("delay of the table [ms]", MS),
}
"""What tests by other methods show: name with the unit shown, and that unit."""
ROUNDING = 1e-12
"""Ratios, s and J below it are rounding of a perfect rig."""
LIMITED_THERE = "Of the rig: its motion, or the reading of the sensor, was cut off there; a force was not."
LIMIT_TIMES = ("first", "last", "duration")
"""What is printed of a limit that was met, s."""
MICRO_S2 = Unit("1e-6 s2", 1e-6)
"""Of the coefficient alpha_2."""
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

    def known(self, name: str) -> float | None:
        """Return an indicator, None where it has none."""
        return _known(self.value(name))

    @property
    def done(self) -> bool:
        """Whether the test came to its end."""
        return self.text("outcome") == "done"

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


def _indicator(name: str) -> Callable[[Run], float | None]:
    return lambda run: run.known(name)


def _of_done(name: str) -> Callable[[Run], float | None]:
    return lambda run: run.known(name) if run.done else None


def _nrms(run: Run) -> Value:
    """The error of the tracking, or how the run ended without one."""
    return run.known("nrms") if run.done else outcome_of(run.text("outcome"))


def _amplitude(run: Run) -> float | None:
    return _known(run.value("frequency_index_amplitude") - 1.0) if run.done else None


def outcome_of(word: str) -> Value:
    """Return how a run ended."""
    return Verdict(word, "bad") if word == "failed" else word


TRACKING = TableSpec[Run](
    "tracking",
    "How the specimen followed its target",
    (
        text("test"),
        text("compensator"),
        col("NRMS", PERCENT, _nrms, 3, negligible=ROUNDING, bare=True),
        col("root", PERCENT, _of_done("nrms_root"), 3, negligible=ROUNDING, bare=True),
        col("delay", MS, _of_done("crossing_delay_mean"), 3, negligible=ROUNDING, bare=True),
        col("A-1", PERCENT, _amplitude, 2, negligible=ROUNDING, bare=True),
        col("peak", PERCENT, _of_done("maximum_error"), 3, negligible=ROUNDING, bare=True),
        col("work", J, _of_done("energy_error"), 3, negligible=ROUNDING, bare=True),
    ),
    notes=wrapped(
        "NRMS: squared errors over squared targets, without a root; root: with it; delay: mean of zero crossings; "
        "A: amplitude ratio by the frequency evaluation index (Guo et al. 2014); peak: largest error over largest "
        "target; work: interface energy error, which the tracking error feeds into the structure (Mosqueda et al. "
        "2007)"
    ),
    keys=2,
)
RESPONSE = TableSpec[Run](
    "response_errors",
    "What the test did to the response of the structure",
    (
        text("test"),
        text("compensator"),
        col("rms", PERCENT, _indicator("response_error"), 3, negligible=ROUNDING),
        col("peak", PERCENT, _indicator("peak_error"), 3, negligible=ROUNDING),
        col("storeys", PERCENT, _indicator("building_error"), 3, negligible=ROUNDING),
    ),  # and the verdict by the error that the file accepts
    keys=2,
)
ALPHAS = TableSpec[Run](
    "adaptive_compensators",
    "Means of what adaptive compensators find while the specimen moves",
    (
        text("test"),
        text("compensator"),
        col("alpha_0", ONE, _indicator("mean_alpha_0"), 5, negligible=ROUNDING),
        col("alpha_1", MS, _indicator("mean_alpha_1"), 5, negligible=ROUNDING),
        col("alpha_2", MICRO_S2, _indicator("mean_alpha_2"), 5, negligible=ROUNDING),
        col("delay", MS, _indicator("estimated_delay"), 4, negligible=ROUNDING),
    ),
    notes=wrapped(
        "command = alpha_0 x + alpha_1 x' + alpha_2 x'' of the target x; delay: estimated delay of the rig, "
        "alpha_1 / alpha_0, or that of a live delay"
    ),
    keys=2,
)
OTHER_METHODS = TableSpec[Row](
    "tests_by_other_methods",
    "Tests by other methods",
    (text("test"), text("method"), text("quantity"), col("value", ONE), text("verdict", broken=1)),
    keys=3,
)
LIMIT_COLUMNS: tuple[Column[Row], ...] = (
    text("test"),
    text("compensator"),
    text("limit"),
    col("first", S, digits=3, negligible=ROUNDING),
    col("last", S, digits=3, negligible=ROUNDING),
    col("in all", S, digits=3, negligible=ROUNDING),
)
RIG_LIMITS = TableSpec[Row](
    "rig_limits",
    "Limits of the rig that were met",
    LIMIT_COLUMNS,
    notes=wrapped(f"in all: main steps in which it was met. {LIMITED_THERE}"),
    keys=3,
)


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
    tables = [
        TRACKING.of(found),
        _response(archive, found),
        ALPHAS.of(run for run in found if any(column.of(run) is not None for column in ALPHAS.columns[2:])),
        other_methods(archive),
        RIG_LIMITS.of(limit for run in found for limit in limits_met(run)),
    ]
    last = tables[1] if tables[1].rows else tables[0]  # given targets alone have no response
    last.notes += [line for note in notes for line in wrapped(note)]
    return tables


def other_methods(archive: Archive) -> Table:
    """Return the results of tests by other methods: pseudo-dynamic, effective force, shaking table.

    Raises:
        ArchiveError: a group is damaged.
    """
    most = response_error_limit(archive)
    rows: list[Row] = []
    notes: list[str] = []
    for test in archive.names(PLACE):
        group = archive.group(f"{PLACE}/{test}").without("time")
        if str(group.attributes.get("kind")) in METHODS:
            rows += _of_method(test, group, most)
            lines = group.attributes.get("told")
            words = [str(line).rstrip(".") for line in lines] if isinstance(lines, list) else []
            notes += wrapped(f"{test}: {'. '.join(words)}.") if words else []
    rms = wrapped(f"rms: root mean square error over that of the direct analysis; {_accepted(most)}")
    return OTHER_METHODS.of(rows, notes=[*(rms if rows else []), *notes])


def _of_method(test: str, group: Group, most: float) -> Iterator[Row]:
    """The quantities of a test, the error of its response first."""
    found, outcome = group.variables, str(group.attributes["outcome"])
    error = float(found["response_error"].values) if "response_error" in found else _NAN
    cells = (test, METHODS[str(group.attributes["kind"])])
    verdict = outcome_of(outcome) if outcome != "done" else _in_short(error, most)
    if not found:
        yield *cells, None, None, verdict
    for name in sorted(found, key=lambda name: name != "response_error"):
        quantity, unit = QUANTITIES.get(name, (found[name].long_name, ONE))
        value = Quantity(_known(float(found[name].values)), unit, 3, negligible=ROUNDING, beside=True)
        yield *cells, quantity, value, verdict
        cells, verdict = ("", ""), ""


def _response(archive: Archive, found: list[Run]) -> Table:
    most = response_error_limit(archive)
    responding = (run for run in found if not run.done or run.known("response_error") is not None)
    notes = wrapped(
        "rms, peak: errors of the deformation whose force the structure gets (the specimen's, or the target where "
        "the force is corrected), root mean square and of its largest value, against the direct analysis of the "
        "same structure; storeys: rms of the drift of the storey where it is largest; " + _accepted(most)
    )
    return RESPONSE.of(responding, more=[text("verdict", lambda run: _verdict(run, most), broken=1)], notes=notes)


def _verdict(run: Run, most: float) -> str:
    if not run.done:
        return f"{run.text('outcome')}: {run.text('reason')}"
    words = _in_short(run.value("response_error"), most)
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


def limits_met(run: Run) -> list[Row]:
    """Return the limits of rig and sensors that a run met."""
    return [(run.test, run.compensator, name, *map(_known, times)) for name, *times in run.limits()]


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
