"""Virtual substructure tests as sections and figures read them: runs, histories, and which are shown."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from edesign.archive.dataset import Group
from edesign.archive.reader import Archive
from edesign.errors import ArchiveError
from edesign.report.drawing.captions import plain
from edesign.report.drawing.style import AFTER, VARIANTS
from edesign.report.substructure.file import ArchivedTests, archived_tests
from edesign.report.substructure.linearised import LinearisedTests, linearised
from edesign.report.substructure.tables import Run, runs
from edesign.study.results.kinds import ANALYSES
from edesign.substructure.archived import PLACE, building_name

NONE = "none"
"""Kind of the compensator that does nothing."""
WITHOUT = "without compensation"
FIRST, BEST = VARIANTS[0], AFTER
"""Colours of the run without compensation, and of the best one."""


OTHERS = tuple(color for color in VARIANTS if color not in (FIRST, BEST))
"""Colours of further compensators, which then come again with another line."""
STYLES = ("-", ":", "--", "-.")


def looks(kinds: Mapping[str, str], best: str | None) -> dict[str, tuple[str, str]]:
    """Return colour and line of each compensator, different ones up to a dozen.

    Args:
        best: the one that is shown as such; None: there is none.
    """
    others = [name for name, kind in kinds.items() if kind != NONE and name != best]
    found = {name: (OTHERS[i % len(OTHERS)], STYLES[i // len(OTHERS) % len(STYLES)]) for i, name in enumerate(others)}
    return {name: found.get(name, (FIRST if kind == NONE else BEST, "-")) for name, kind in kinds.items()}


@dataclass(frozen=True)
class Series:
    """A run with its histories and its look in figures.

    Attributes:
        compensator: its name.
        label: of its lines.
        color: of its lines.
        group: its histories.
    """

    compensator: str
    label: str
    color: str
    group: Group

    def of(self, name: str) -> np.ndarray | None:
        """Return a history, None if it was not kept."""
        variable = self.group.variables.get(name)
        return None if variable is None else np.asarray(variable.values, dtype=float)

    @property
    def time(self) -> np.ndarray:
        """The instants of the histories, (n,) s."""
        return times(self.group)


def times(group: Group) -> np.ndarray:
    """Return the instants (n,) of the histories of a group, s; none where it has none."""
    return np.asarray(group.coords["time"].values, dtype=float) if "time" in group.coords else np.zeros(0)


class SubstructureResults:
    """The results of an archive of virtual substructure tests, complete or not.

    Attributes:
        archive: the open archive.
        lost: why groups of it cannot be read.
    """

    def __init__(self, archive: Archive) -> None:
        self.archive = archive
        self.lost: list[str] = []
        self._groups: dict[str, Group | None] = {}

    @cached_property
    def described(self) -> ArchivedTests:
        """The description of the tests, as far as their file can be read."""
        return archived_tests(self.archive)

    @cached_property
    def runs(self) -> list[Run]:
        """The runs in the order of the file; none of an archive that was not completed."""
        try:
            return runs(self.archive)
        except ArchiveError as error:
            self._note(error)
            return []

    @cached_property
    def tests(self) -> list[str]:
        """The names of the tests, in the order of the file where it is known."""
        there = self._names(PLACE)
        file = self.described.file
        order = [run.test for run in self.runs] + [test.name for test in (file.tests if file is not None else ())]
        return [name for name in dict.fromkeys(order) if name in there] + [name for name in there if name not in order]

    def compensators(self, test: str) -> list[str]:
        """Return the names of the compensators with which a test was run, in the order of the file."""
        there = self._names(f"{PLACE}/{test}")
        file = self.described.file
        order = [run.compensator for run in self.runs if run.test == test] or list(file.compensators if file else ())
        return [name for name in order if name in there] + [name for name in there if name not in order]

    def driven(self, test: str) -> Group:
        """Return the motion or command of a test, and the direct analysis; empty if it cannot be read."""
        return self._group(f"{PLACE}/{test}") or Group()

    def run(self, test: str, compensator: str) -> Run | None:
        """Return the indicators of a run, None before the end of all runs."""
        return next((run for run in self.runs if (run.test, run.compensator) == (test, compensator)), None)

    def histories(self, test: str, compensator: str) -> Group | None:
        """Return the group of a run, None if it cannot be read."""
        return self._group(f"{PLACE}/{test}/{compensator}")

    def building(self, test: str, compensator: str = "") -> Group | None:
        """Return the building in a test as a history; without a compensator, that of the direct analysis."""
        place = f"{ANALYSES}/{building_name(test, compensator)}"
        return self._group(place) if self.archive.has(place) else None

    def series(self, test: str, compensator: str, color: str = BEST) -> Series | None:
        """Return a run with its histories, None if it cannot be read or has none.

        Args:
            color: colour of the run in figures.
        """
        group = self.histories(test, compensator)
        if group is None or not times(group).size:
            return None
        label = WITHOUT if self.kind(compensator) == NONE else compensator
        return Series(compensator, label, color, group)

    def kind(self, compensator: str) -> str:
        """Return the kind of a compensator; its name if the file cannot be read."""
        file = self.described.file
        known = file.compensators.get(compensator) if file is not None else None
        return known.kind if known is not None else compensator

    def best(self, test: str) -> str | None:
        """Return the compensator with the least error among those that compensate; None: there is none."""
        names = [name for name in self.compensators(test) if self.kind(name) != NONE]
        errors = {name: self.error(test, name) for name in names}
        known = {name: error for name, error in errors.items() if not math.isnan(error)}
        return min(known, key=lambda name: known[name]) if known else None

    def error(self, test: str, compensator: str) -> float:
        """Return the error of the response of a run, or of tracking a given target; infinite if it did not end."""
        run = self.run(test, compensator)
        if run is not None:
            response = run.value("response_error")
            error = run.value("nrms_root") if math.isnan(response) else response
            return error if run.text("outcome") == "done" else math.inf
        series = self.series(test, compensator)
        target, measured = (series.of(name) if series is not None else None for name in ("target", "measured"))
        if series is None or target is None or measured is None or not np.any(target):
            return math.nan
        if series.group.attributes.get("outcome") != "done":
            return math.inf
        return math.sqrt(float(np.sum((measured - target) ** 2) / np.sum(target**2)))

    def shown(self, test: str) -> list[Series]:
        """Return the runs of a test that figures show: without compensation, then the best."""
        names = self.compensators(test)
        chosen = [name for name in names if self.kind(name) == NONE][:1] + [name for name in [self.best(test)] if name]
        found = [self.series(test, name, FIRST if self.kind(name) == NONE else BEST) for name in (chosen or names[:1])]
        return [series for series in found if series is not None]

    def is_closed(self, test: str) -> bool:
        """Return whether a structure determined the target of a test."""
        return "ground" in self.driven(test).variables

    @cached_property
    def linearised(self) -> LinearisedTests | None:
        """Specimen, rig and structure as `edesign rts check` linearises them; None: not known."""
        motion = self.motion
        return linearised(self.described, motion) if motion is not None else None

    @cached_property
    def motion(self) -> np.ndarray | None:
        """The motion of the specimen in the first direct analysis, else in the first test, (n,) m; None: unknown."""
        found = [self.driven(test).variables.get("direct_deformation") for test in self.tests]
        moved = [one.group.variables for test in self.tests for one in self.shown(test)[-1:]]
        found += [of.get("deformation") for of in moved]
        reach = (np.asarray(one.values, dtype=float) for one in found if one is not None and one.values.size)
        return next((one for one in reach if np.any(one)), None)

    def in_words(self, test: str, compensator: str) -> str:
        """Return error and delay of a run in words, "" if they are not known."""
        run = self.run(test, compensator)
        if run is None:
            return ""
        if run.text("outcome") != "done":
            return run.text("outcome")
        late, error = 1e3 * run.value("crossing_delay_mean"), 100.0 * run.value("nrms_root")
        words = [f"{plain(abs(late))} ms {'late' if late >= 0.0 else 'early'}"] if not math.isnan(late) else []
        words += [f"NRMS {plain(error)} %"] if not math.isnan(error) else []
        return ", ".join(words)

    def _names(self, place: str) -> list[str]:
        try:
            return self.archive.names(place)
        except ArchiveError as error:
            self._note(error)
            return []

    def _group(self, place: str) -> Group | None:
        if place not in self._groups:
            self._groups[place] = self._read(place)
        return self._groups[place]

    def _read(self, place: str) -> Group | None:
        try:
            return self.archive.group(place)
        except ArchiveError as error:
            self._note(error)
            return None

    def _note(self, error: ArchiveError) -> None:
        if str(error) not in self.lost:
            self.lost.append(str(error))
