"""The histories of an archive that stand behind the statistics of a comparison."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np

from edesign.archive.dataset import Group
from edesign.archive.reader import Archive
from edesign.assess.envelopes import final
from edesign.assess.measures import located_measure
from edesign.assess.profile import storey_profile
from edesign.assess.sets import DAMAGED, NOT_RUN
from edesign.project.criteria.measures import SHORT_NAMES
from edesign.project.study.checks_reference import PROFILES
from edesign.project.study.reference import ResponseRow
from edesign.report.archive_view import planned
from edesign.study.results.kinds import ANALYSES


class Wanted(NamedTuple):
    """A measure (short name), with the storeys and members to which it is restricted."""

    measure: str
    storeys: tuple[int, ...] | None
    members: tuple[str, ...] | None


@dataclass(frozen=True)
class ComparedHistory:
    """The data of one history for a comparison.

    Attributes:
        variant, level, record: "" where the archive says nothing.
        reason: why it has no values, "" for a completed history.
        values: SI; None where a measure does not apply.
        profiles: measures over the height, (storeys,), SI; by short name.
    """

    name: str
    variant: str
    level: str
    record: str
    reason: str
    values: dict[Wanted, float | None] = field(default_factory=dict)
    profiles: dict[str, np.ndarray] = field(default_factory=dict)

    def belongs(self, variant: str, level: str, records: str | None) -> bool:
        """Return whether the history is one of a variant and level, and of a record or suite.

        Args:
            level: name of the hazard level; "" without levels.
            records: name of a record or suite; None: any.
        """
        if self.reason in (NOT_RUN, DAMAGED):  # of which only the name is known
            return self.name.startswith(f"{variant}.{level}.")
        of_records = records is None or self.record == records or self.record.startswith(f"{records}/")
        return self.variant == variant and self.level == level and of_records


def wanted(row: ResponseRow) -> Wanted:
    """Return the measure that a row of a reference needs of each history."""
    return Wanted(row.measure, row.storeys, row.members)


def compared_histories(archive: Archive, measures: Collection[Wanted]) -> list[ComparedHistory]:
    """Read the measures of all histories, those that were planned and have not run included.

    Histories of an incremental analysis, and those at another temperature than their variant's, are left out.

    Raises:
        ArchiveError: the archive is damaged.
    """
    have = archive.names(ANALYSES)
    missing = [name for name in planned(archive) if name not in have]
    reasons = {name: DAMAGED if archive.lost(f"{ANALYSES}/{name}") else NOT_RUN for name in missing}
    found = [ComparedHistory(name, "", "", "", reason) for name, reason in reasons.items()]
    for name in have:
        attributes = archive.group_attributes(f"{ANALYSES}/{name}")
        apart = attributes.get("incremental") or attributes.get("temperature_C") is not None
        if attributes.get("kind") != "history" or apart:
            continue
        variant, level, record = (str(attributes.get(label) or "") for label in ("variant", "level", "record"))
        status = str(attributes.get("status", ""))
        if status != "completed":
            reason = str(attributes.get("reason") or "")
            found.append(ComparedHistory(name, variant, level, record, f"{status}: {reason}" if reason else status))
            continue
        group = archive.group(f"{ANALYSES}/{name}")
        found.append(ComparedHistory(name, variant, level, record, "", _values(group, measures), _profiles(group)))
    return found


def _values(group: Group, measures: Collection[Wanted]) -> dict[Wanted, float | None]:
    values: dict[Wanted, float | None] = {}
    for one in measures:
        place = located_measure(group, SHORT_NAMES[one.measure], one.storeys, one.members)
        values[one] = None if place is None else place.value
    return values


def _profiles(group: Group) -> dict[str, np.ndarray]:
    profiles = storey_profile(group)
    at_the_end = final(group, "storey_drift")
    if at_the_end is not None:
        profiles["final_storey_drift"] = at_the_end
    return {measure: profiles[name] for measure, name in PROFILES.items() if name in profiles}
