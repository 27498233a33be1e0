"""Histories, and states at target displacements, that belong together: one variant at one hazard level."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Collection, Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property

from edesign.archive.dataset import Group
from edesign.assess.measures import response_measures
from edesign.assess.statistics import Statistics, statistics
from edesign.ground_motion.processing.steps import REVERSED
from edesign.project.analysis.pushover import METHODS, Method
from edesign.project.criteria.measures import MEASURES
from edesign.project.study.study import warm_variant

NOT_RUN = "not run"
"""Status of a history that was planned and has no result yet."""
DAMAGED = "damaged"
"""Status of a history whose result the archive has, but damaged."""


TARGET = "target"
"""Kind of the analyses that push a frame to a target displacement."""


@dataclass(frozen=True)
class HistorySet:
    """All histories of a variant at a level, by name; completed ones, failed ones, and those that have not run.

    Attributes:
        method: of target displacements, whose states stand in the place of histories; None: they are histories.
    """

    variant: str
    level: str
    histories: dict[str, Group] = field(default_factory=dict)
    method: Method | None = None

    @property
    def label(self) -> str:
        """The variant in tables: `bare`, or `bare by N2`."""
        return f"{self.variant} by {METHODS[self.method]}".strip() if self.method else self.variant

    @property
    def completed(self) -> dict[str, Group]:
        """Histories with all their results, by name."""
        return {name: group for name, group in self.histories.items() if _status(group) == "completed"}

    @cached_property
    def measures(self) -> dict[str, dict[str, float | None]]:
        """The response measures of the completed ones; see `response_measures`."""
        return {name: response_measures(group) for name, group in self.completed.items()}

    @property
    def not_run(self) -> tuple[str, ...]:
        """Names of histories whose results are still to come."""
        return tuple(name for name, group in self.histories.items() if _status(group) == NOT_RUN)

    @cached_property
    def motion_of(self) -> dict[str, str]:
        """The motion of each history, by name: that of the first one with its record at other angles, other masses.

        One without angle and eccentricity, as of every plane frame, is a motion of its own. What has not run is known
        by its name alone.
        """
        ends = {name: _ending(name, group.attributes) for name, group in self.histories.items()}
        known = sorted({end for end in ends.values() if end}, key=len, reverse=True)
        waiting = set(self.not_run)
        first: dict[str, str] = {}
        for name, end in ends.items():
            if name in waiting:
                end = next((end for end in known if name.endswith(end)), "")
                ends[name] = end
            first.setdefault(name.removesuffix(end), name)
        return {name: first[name.removesuffix(end)] for name, end in ends.items()}

    def by_motion(self, chosen: Mapping[str, Group]) -> list[list[Group]]:
        """Return histories of the set by motion."""
        of: dict[str, list[Group]] = {}
        for name, group in chosen.items():
            of.setdefault(self.motion_of[name], []).append(group)
        return list(of.values())

    @property
    def motions(self) -> int:
        """Number of ground motions: a record and its reverse, shaking to both sides, are one."""
        about = [
            (str(group.attributes.get("record_checksum")), str(group.attributes.get("record_source")))
            for group in (self.histories[name] for name in dict.fromkeys(self.motion_of.values()))
        ]
        plain = {motion for motion in about if REVERSED not in motion[1]}
        return sum(
            (checksum, source.replace(REVERSED, "")) not in plain or REVERSED not in source
            for checksum, source in about
        )

    @property
    def failed(self) -> tuple[str, ...]:
        """Names of histories that did not come to their end."""
        return tuple(name for name in self.histories if name not in self.completed and name not in self.not_run)

    def statistics(self, measure: Callable[[Group], float | None]) -> Statistics:
        """Return the statistics of a measure over the completed histories; peaks of others are not the last word.

        Args:
            measure: gives the value of one history, None where it has none.
        """
        completed = self.completed
        values = {name: measure(completed[name]) if name in completed else None for name in self.histories}
        return self.statistics_of(values)

    def statistics_of(self, values: Mapping[str, float | None]) -> Statistics:
        """Return the statistics of values of its histories, in which the worst one of each motion counts.

        Args:
            values: by history; None where it has none.
        """
        there = {name: value for name, value in values.items() if value is not None}
        missing = tuple(name for name in values if name not in there)
        return replace(statistics(self.worst_of_motions(there)), missing=missing)

    def worst_of_motions(self, values: Mapping[str, float | None], from_below: bool = False) -> dict[str, float | None]:
        """Return the worst value of each motion by the history that has it.

        A motion counts as failed if one of its histories has no value, else as not run if one has not run.

        Args:
            values: by history; None: it failed, or has not run.
            from_below: whether the smallest value is the worst.
        """
        of: dict[str, list[str]] = {}
        for name in values:
            of.setdefault(self.motion_of[name], []).append(name)
        found: dict[str, float | None] = {}
        waiting = set(self.not_run)
        for names in of.values():
            without = sorted((name for name in names if values[name] is None), key=waiting.__contains__)
            there = {name: value for name in names if (value := values[name]) is not None}
            worst = without[0] if without else (min if from_below else max)(there, key=there.__getitem__)
            found[worst] = values[worst]
        return found


def turned(about: Mapping[str, object]) -> tuple[str, str]:
    """Return angle and eccentricity of a history of a building by its attributes; "" and "" of a plane frame."""
    angle, eccentricity = (about.get(key) for key in ("angle_deg", "eccentricity"))
    return "" if angle is None else f"{float(str(angle)):g}", str(eccentricity or "")


def measure_statistics(histories: HistorySet, names: Collection[str] | None = None) -> dict[str, Statistics]:
    """Return the statistics of all response measures over the completed histories of a set, by measure.

    The others are missing in all of them.

    Args:
        names: only these of them; None: all.
    """
    measures = histories.measures
    chosen = [name for name in histories.histories if names is None or name in names]
    return {
        measure: histories.statistics_of(
            {name: measures[name][measure] if name in measures else None for name in chosen}
        )
        for measure in MEASURES
    }


def history_sets(histories: Mapping[str, Group]) -> tuple[HistorySet, ...]:
    """Sort the histories of an archive by variant and level, in the order in which they come.

    A variant at another temperature than its own is a variant of its own: `damped at 35 degC`. Where two without a
    variant have the same level, record, angle and eccentricity, as one record at two scales, the names of the analyses,
    without that of the record, stand for variants. Histories of incremental analyses, and everything that is no
    history, are left out.

    Args:
        histories: groups of the archive, by name.
    """
    labelled: dict[str, tuple[str, str, str]] = {}
    same: Counter[tuple[str, ...]] = Counter()
    for name, group in histories.items():
        about = group.attributes
        if about.get("kind") != "history" or about.get("incremental"):
            continue
        variant, temperature = str(about.get("variant") or ""), about.get("temperature_C")
        if temperature is not None:
            variant = warm_variant(variant, float(temperature))
        labelled[name] = variant, str(about.get("level") or ""), str(about.get("record") or "")
        same[*labelled[name], *turned(about)] += 1
    mixed = {variant for (variant, _, record, *_), count in same.items() if count > 1 and record and not variant}
    found: dict[tuple[str, str], HistorySet] = {}
    for name, (variant, level, _) in labelled.items():
        group = histories[name]
        own = without_motion(name, group.attributes) if variant in mixed else variant
        key = (own, level)
        found.setdefault(key, HistorySet(*key)).histories[name] = group
    return tuple(found.values())


def _ending(name: str, about: Mapping[str, object]) -> str:
    """Angle and eccentricity at the end of the name of a history, where it has several: .90deg.+x+y."""
    angle, eccentricity = turned(about)
    whole = name
    for text in (eccentricity, f"{angle}deg" if angle else ""):
        name = name.removesuffix(f".{text}") if text else name
    return whole[len(name) :]


def without_motion(name: str, about: Mapping[str, object]) -> str:
    """Return the name of a history without that of its record, and the angle and eccentricity after it.

    Args:
        about: its attributes.
    """
    record = str(about.get("record") or "").rpartition("/")[2]
    return name.removesuffix(_ending(name, about)).removesuffix(f".{record}")


def target_sets(groups: Mapping[str, Group]) -> tuple[HistorySet, ...]:
    """Sort the states at target displacements by variant, level and method; everything else is left out.

    Args:
        groups: of the archive, by name.
    """
    found: dict[tuple[str, str, Method], HistorySet] = {}
    for name, group in groups.items():
        about = group.attributes
        if about.get("kind") != TARGET:
            continue
        variant, level = (str(about.get(key) or "") for key in ("variant", "level"))
        method = next((one for one in METHODS if about.get("method") == one), None)
        if method is not None:
            key = (variant, level, method)
            found.setdefault(key, HistorySet(variant, level, method=method)).histories[name] = group
    return tuple(found.values())


def _status(group: Group) -> str:
    return str(group.attributes.get("status", ""))
