"""A format of record files, and choosing one of the components that a file holds."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

from edesign.errors import InputError
from edesign.ground_motion.formats.facts import Facts
from edesign.ground_motion.record import Record
from edesign.project.reading.problems import listed


@dataclass(frozen=True)
class Channel:
    """A component in a file.

    Attributes:
        label: for people, such as `1: 340 deg`.
        names: all that it may be called.
        acceleration: m/s2.
        time_step: s.
        about: what its header says of event, station and processing.
    """

    label: str
    names: tuple[str, ...]
    acceleration: Sequence[float]
    time_step: float
    about: str

    def record(self, path: Path, name: str) -> Record:
        """Return the record of this component.

        Args:
            name: of the record; "": that of the file.
        """
        factual = ", ".join(part for part in (self.about, self.label and f"component {self.label}") if part)
        return Record(name or path.stem, self.acceleration, self.time_step, f"{path.name}: {factual}")  # type: ignore[arg-type]


CHOICE = "by --component on the command line, by `component` in a project or suite file"
"""How one of several components is chosen."""


def choose(path: Path, channels: Sequence[Channel], component: str | int | None) -> Channel:
    """Return the component that is asked for, or the only one.

    Args:
        component: label or number; None: the only one.

    Raises:
        InputError: none is named but the file has several, or the name fits none or several; lists them.
    """
    labels = listed(channel.label for channel in channels)
    if component is None:
        if len(channels) > 1:
            raise InputError(
                f"{path}: the file holds {len(channels)} components; name one: {labels}, {CHOICE} [E-REC-13]"
            )
        return channels[0]
    wanted = _plain(str(component))
    found = [channel for channel in channels if wanted in {_plain(name) for name in (channel.label, *channel.names)}]
    if len(found) == 1:
        return found[0]
    if found:
        raise InputError(
            f"{path}: `{component}` fits {listed(channel.label for channel in found)}; name one of them [E-REC-13]"
        )
    raise InputError(f"{path}: there is no component `{component}`; the file has {labels} [E-REC-14]")


@dataclass(frozen=True)
class RecordFormat:
    """A format whose files name the components in them; each has a module, which ends in the `FORMAT` that it reads.

    Attributes:
        title: for people.
        fits: whether the first lines of a file are of this format.
        channels: reads the components of a file.
        several: whether a file may hold more than one, so that its components are read to be named.
        keeps_suffix: whether the suffix of a file names its component and so belongs to the name of the record.
        suffixes: of such files, for those whose lines don't show it.
        facts: reads what a file says of earthquake and station.
    """

    title: str
    fits: Callable[[list[str]], bool]
    channels: Callable[[Path], list[Channel]]
    several: bool = True
    keeps_suffix: bool = False
    suffixes: tuple[str, ...] = ()
    facts: Callable[[Path], Facts] = lambda path: Facts()

    def read(self, path: Path, component: str | int | None = None, name: str = "") -> Record:
        """Read the record of one component.

        Args:
            component: what it is called; None: the only one.
            name: of the record; "": that of the file.

        Raises:
            InputError: what `channels` and `choose` find.
        """
        if self.keeps_suffix:
            name = name or path.name
        return choose(path, self.channels(path), component).record(path, name)


def _plain(name: str) -> str:
    """A name without what people leave out or write differently: case, spaces, hyphens."""
    return "".join(char for char in name.casefold() if char not in " -_")
