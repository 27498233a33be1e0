"""The records of a project or a building: single ones, those of its suites, and pairs.

A reference is the name of a record under `records`, SUITE/ID for one recording of a suite, or SUITE/NUMBER for one of
its pairs that act at once.
"""

from __future__ import annotations

import os
from collections.abc import Iterable, Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np

from edesign.errors import InputError
from edesign.ground_motion.components import one_time_axis, read_component
from edesign.ground_motion.pairs import pair_references, read_pairs
from edesign.ground_motion.processing.steps import processed
from edesign.ground_motion.record_choice import RecordChoice
from edesign.ground_motion.sources import Found, find_suite
from edesign.ground_motion.suite import Suite, load_suite
from edesign.project.analysis_file import File
from edesign.project.reading.file_bytes import is_folder
from edesign.project.reading.problems import unknown_name
from edesign.project.records.pairs import AnyRecord, InSpace, OnePair
from edesign.project.records.record_files import HoldsRecords
from edesign.project.records.records import (
    ChosenRecords,
    PairRecord,
    RecordsOfSuite,
    SuiteRecords,
    component_references,
    record_of,
)


def references(project: HoldsRecords, name: str) -> tuple[str, ...]:
    """Return the references of a record: itself, or one for each of a suite, of those that were chosen, or of a pair.

    Pairs whose components act at once have one for both.

    Raises:
        InputError: there is no such record, the suite cannot be read, or nothing was chosen for it yet.
    """
    spec = _spec(project, name)
    if isinstance(spec, ChosenRecords):
        return tuple(f"{name}/{recording}" for recording in _choice(project, name).candidates)
    if isinstance(spec, PairRecord):
        return component_references(name)
    if isinstance(spec, InSpace):
        try:
            return pair_references(project.folder, name, spec)
        except InputError as error:
            raise InputError(f"{project.where('records', name)}: records.{name}: {error}") from error
    if not isinstance(spec, SuiteRecords):
        return (name,)
    return tuple(f"{name}/{entry.id}" for entry in _suite(project, name, spec).records)


def find_recordings(project: HoldsRecords, wanted: Iterable[str]) -> dict[str, Found]:
    """Read recordings as the project describes them.

    Args:
        project: the validated project, or another file with records.
        wanted: references.

    Returns:
        Each recording as recorded, m/s2, by its reference, in the order of `wanted`; of pairs that act at once each
        component, by NAME/COMPONENT.

    Raises:
        InputError: one cannot be found or read; the message names the place in the project file too.
    """
    wanted = tuple(dict.fromkeys(wanted))
    found: dict[str, Found] = {}
    components: dict[str, tuple[str, ...]] = {}
    for name in dict.fromkeys(record_of(reference) for reference in wanted):
        spec = _spec(project, name)
        try:
            if isinstance(spec, ChosenRecords):
                chosen = _choice(project, name).candidates
                parts = {f"{name}/{recording}": item for recording, item in chosen.items()}
                found |= {reference: item.find() for reference, item in parts.items() if reference in wanted}
            elif isinstance(spec, SuiteRecords):
                suite = _suite(project, name, spec)
                entries = tuple(entry for entry in suite.records if f"{name}/{entry.id}" in wanted)
                part = suite.model_copy(update={"records": entries})
                recordings = find_suite(part, project.suite_folders(name), spec.simulated_records)
                done = [replace(item, record=processed(item.record, spec.processing)) for item in recordings]
                found |= {f"{name}/{entry.id}": item for entry, item in zip(entries, done, strict=True)}
            elif isinstance(spec, InSpace):
                folders = [] if isinstance(spec, OnePair) else project.suite_folders(name)
                for pair in read_pairs(project.folder, folders, name, spec):
                    of_pair = {f"{name}/{item.record.name}": item for item in pair.found}
                    components[pair.name] = tuple(of_pair)
                    found |= of_pair
            elif isinstance(spec, PairRecord):
                found |= _pair(project, name, spec)
            else:
                found[name] = read_component(project.folder, name, spec)
        except InputError as error:
            raise InputError(f"{project.where('records', name)}: records.{name}: {error}") from error
    places = {reference: components.get(reference, (reference,)) for reference in wanted}
    for reference, at in places.items():
        if at[0] not in found:
            name = record_of(reference)
            where = project.where("records", name)
            raise InputError(
                f"{where}: records.{name}: {unknown_name('recording', reference, references(project, name))}"
            )
    return {place: found[place] for at in places.values() for place in at}


def with_folders(project: File, folders: Sequence[Path]) -> File:
    """Return the project with more folders for the recordings of its suites, which are searched after its own.

    Args:
        folders: in the order of the search.

    Raises:
        InputError: a folder does not exist, or the project has no suite.
    """
    if not folders:
        return project
    for folder in folders:
        if not is_folder(folder):
            raise InputError(f"--folder: there is no folder {folder} [E-FILE-01]")
    if not any(isinstance(spec, RecordsOfSuite) for spec in project.records.values()):
        raise InputError(f"--folder: {project.path} has no suite of recordings [E-SUITE-11]")
    return project.with_folders([Path(os.path.realpath(folder)) for folder in folders])


def _spec(project: HoldsRecords, name: str) -> AnyRecord:
    if name not in project.records:
        raise InputError(f"{project.where('records')}: {unknown_name('record', name, project.records)}")
    return project.records[name]


def _choice(project: HoldsRecords, name: str) -> RecordChoice:
    """What was chosen for a record.

    Raises:
        InputError: nothing was.
    """
    choice = project.record_choice(name)
    if not isinstance(choice, RecordChoice):
        raise InputError(
            f"{project.where('records', name)}: records.{name}: its recordings are not chosen yet; a run and a check "
            "of the project choose them, and `edesign.study.plan.choosing.with_choices` [E-MATCH-08]"
        )
    return choice


def _suite(project: HoldsRecords, name: str, spec: SuiteRecords) -> Suite:
    """The suite, restricted to what the project takes from it."""
    suite = load_suite(project.suite_path(name))
    if spec.only is None:
        return suite.horizontal()
    ids = [entry.id for entry in suite.records]
    for i, wanted in enumerate(spec.only):
        if wanted not in ids:
            where = project.where("records", name, "only", i)
            number = int(wanted) if wanted.isdecimal() and 1 <= int(wanted) <= len(ids) else 0
            if number:
                said = f"`only` takes names, and number {number} of the suite is `{ids[number - 1]}` [E-NAME-01]"
            else:
                said = unknown_name("recording", wanted, ids)
            raise InputError(f"{where}: records.{name}.only[{i}]: {said}")
    return suite.model_copy(update={"records": tuple(entry for entry in suite.records if entry.id in spec.only)})


def _pair(project: HoldsRecords, name: str, spec: PairRecord) -> dict[str, Found]:
    """Both components, with zeros after the shorter one.

    Raises:
        InputError: one cannot be read, they have different time steps, or are the same.
    """
    places = component_references(name)
    found = [
        read_component(project.folder, place.partition("/")[2], of) for place, of in zip(places, spec.pair, strict=True)
    ]
    first, second = (item.record for item in found)
    if abs(first.time_step - second.time_step) > 1e-9 * first.time_step:
        raise InputError(
            f"the components have time steps of {first.time_step:g} s and {second.time_step:g} s; `processing: "
            "[{resample: ...}]` gives them one [E-MOTION-04]"
        )
    if np.array_equal(first.acceleration, second.acceleration):
        raise InputError("both components are the same motion [E-SUITE-07]")
    return dict(zip(places, one_time_axis(found), strict=True))
