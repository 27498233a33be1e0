"""A recording that may be chosen, and why one may not."""

from __future__ import annotations

import hashlib
import re
from collections.abc import Sequence
from dataclasses import dataclass, fields
from pathlib import Path
from typing import Any

from edesign.errors import InputError
from edesign.ground_motion.formats.facts import Facts
from edesign.ground_motion.sources import Found, find_recording
from edesign.ground_motion.suite import TAKEN, Suite, SuiteEntry
from edesign.project.records.chosen_records import Limits

_LONGEST = 64  # characters of a name, as in suites
_PLAIN = re.compile(r"[^a-z0-9]+")


@dataclass(frozen=True)
class Candidate:
    """A recording that may be chosen.

    Attributes:
        entry: what is known of it, and where it is; its `id` is its name.
        suite: that it is found by; paths are relative to its file.
        folders: in which it is looked for.
        simulated_records: whether it may be simulated.
        pulse: whether its velocity has a pulse; None where that is not known.
    """

    entry: SuiteEntry
    suite: Suite
    folders: tuple[Path, ...] = ()
    simulated_records: bool = False
    pulse: bool | None = None

    @property
    def name(self) -> str:
        """Name of the recording in results."""
        return self.entry.id

    @property
    def event(self) -> str:
        """The earthquake, for counting; a recording of which it is not known is of its own one."""
        if self.entry.event is None:
            return f"recording {self.entry.rsn or self.name}"
        return f"{_PLAIN.sub(' ', self.entry.event.lower())} {self.entry.year or ''}"

    @property
    def station(self) -> str:
        """The station, for counting its components; one of which it is not known is of its own one."""
        if self.entry.rsn is not None:
            return f"recording {self.entry.rsn}"
        return _PLAIN.sub(" ", self.entry.station.lower()) if self.entry.station else f"recording {self.name}"

    def find(self) -> Found:
        """Read it.

        Raises:
            InputError: it cannot be found or read.
        """
        return find_recording(self.entry, self.suite, self.folders, self.simulated_records)


@dataclass(frozen=True)
class Refusal:
    """Recording that was left out, and the reason."""

    name: str
    reason: str


class Names:
    """The names of candidates in results: letters, digits and `_ - + .`, no two alike but for capitals."""

    def __init__(self) -> None:
        self._taken: set[str] = set()

    def free(self, *texts: str) -> str:
        """Return a name made of the first text whose name is free, and take it.

        Args:
            *texts: names in the order in which they are tried.

        Raises:
            InputError: none of them is.
        """
        for text in texts:
            name = re.sub(r"[^A-Za-z0-9_.+-]+", "_", text).lstrip("_.+-") or "record"
            if len(name) > _LONGEST:
                name = f"{name[: _LONGEST - 9]}_{hashlib.sha256(text.encode()).hexdigest()[:8]}"
            name = f"{name}_" if name in TAKEN else name
            if name.lower() not in self._taken:
                self._taken.add(name.lower())
                return name
        raise InputError(f"another candidate is called `{texts[0]}` too [E-NAME-02]")


def entry_of(name: str, facts: Facts, component: str | None, **places: Any) -> SuiteEntry:
    """Return what a suite would say of a recording; its values are in SI and need no reading.

    Args:
        **places: fields of `SuiteEntry` that say where it is.
    """
    about: dict[str, Any] = {field.name: getattr(facts, field.name) for field in fields(facts) if field.name != "pulse"}
    return SuiteEntry.model_construct(id=name, component=component, **about, **places)


def suite_of(title: str, project: Path) -> Suite:
    """Return a suite without a file of its own; paths of its recordings are relative to the project file."""
    suite = Suite.model_construct(edesign_suite=1, title=title, records=())
    suite._path = project
    return suite


def outside(candidate: Candidate, limits: Limits) -> str:
    """Return why a candidate is outside of limits; "" if it is within.

    Args:
        candidate: the recording.
        limits: for recordings.
    """
    entry = candidate.entry
    values: Sequence[tuple[str, tuple[float, float] | None, float | None, float, str]] = (
        ("magnitude", limits.magnitude, entry.magnitude, 1.0, ""),
        ("distance", limits.distance, entry.distance, 1e3, " km"),
        ("v_s30", limits.v_s30, entry.v_s30, 1.0, " m/s"),
    )
    for key, bounds, value, unit, shown in values:
        if bounds is None:
            continue
        if value is None:
            return f"its {key} is not known; a flatfile would say it"
        if not bounds[0] <= value <= bounds[1]:
            low, high = (f"{bound / unit:g}" for bound in bounds)
            return f"its {key} of {value / unit:g}{shown} is outside of {low} to {high}{shown}"
    if limits.pulse is not None and candidate.pulse is None:
        return "whether it has a pulse is not known; a flatfile would say it"
    if limits.pulse is not None and candidate.pulse is not limits.pulse:
        return "it has a pulse" if candidate.pulse else "it has no pulse"
    return ""
