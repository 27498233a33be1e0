"""Fit recordings to a spectrum, check them against the code, and archive all that came of it."""

from __future__ import annotations

import os
import time
from collections.abc import Mapping
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any

from edesign.archive.dataset import Group
from edesign.archive.files import source_file
from edesign.archive.owner import check_owner
from edesign.archive.writer import ArchiveWriter
from edesign.codes.ec8 import RuleCheck
from edesign.codes.motion_sets import DAMPING
from edesign.codes.spectrum import Spectrum
from edesign.errors import AnalysisError, Interrupted
from edesign.ground_motion.matching import MatchOptions
from edesign.ground_motion.plausibility import unusual_scales
from edesign.ground_motion.record import Record
from edesign.ground_motion.record_choice import choice_facts
from edesign.ground_motion.selection import Selection, select_records
from edesign.ground_motion.selection_scaling import SelectionOptions
from edesign.ground_motion.sources import Found
from edesign.notebook import pictures_html
from edesign.optional_stages import optional
from edesign.study.motions.motions import Motion, fit, prepare_motions, raise_suite
from edesign.study.motions.record_groups import criteria, suite_groups
from edesign.study.results.provenance import circumstances, versions
from edesign.study.run.interrupt import stop_on_signals
from edesign.study.run.progress import Listener, Progress, silent


@dataclass(frozen=True)
class MatchSummary:
    """The result of fitting recordings to a spectrum.

    Attributes:
        archive: the finished archive.
        motions: by reference, in the order given; one that could not be fitted has a `failure`.
        criteria: of the code, for those that could be fitted.
        seconds: time of the whole (s).
    """

    archive: Path
    motions: dict[str, Motion]
    criteria: tuple[RuleCheck, ...]
    seconds: float

    def _repr_html_(self) -> str:
        return pictures_html(self)

    @property
    def failed(self) -> tuple[Motion, ...]:
        """The recordings that could not be fitted."""
        return tuple(motion for motion in self.motions.values() if motion.failure)


def match_records(
    recordings: Mapping[str, Found | Record],
    target: Spectrum,
    options: MatchOptions,
    archive_path: str | os.PathLike[str],
    fundamental_period: float | None = None,
    name: str = "suite",
    title: str = "",
    workers: int = 1,
    progress: Listener | None = None,
    source: Path | None = None,
    overwrite: bool = False,
) -> MatchSummary:
    """Fit recordings to a spectrum and archive originals, results, spectra, measures and criteria.

    Args:
        recordings: by a name that is unique and can stand in an archive; records, or what says where they are from.
        target: the elastic spectrum.
        options: method, band, bounds.
        archive_path: the archive; replaced when all is done.
        fundamental_period: T1 of the structure (s), for the criterion on 0.2 T1 to 2 T1; None leaves it open.
        name: of the suite in the archive.
        title: one line for the archive.
        workers: recordings that are fitted at the same time, in threads; the results do not depend on it.
        progress: called with a `Progress` as each one is ready.
        source: file of the suite, or of the first recording; a later matching of it replaces the archive.
        overwrite: True replaces the archive of something else too.

    Returns:
        The archive, the fitted motions and the criteria of the code.

    Raises:
        ArchiveError: the archive cannot be written, or is that of something else.
        AnalysisError: none of the recordings can be fitted.
        Interrupted: stopped by the user; nothing is written.

    Examples:
        A simulated motion, scaled to the elastic spectrum of a project at the level of its design earthquake:

        >>> from edesign.ground_motion.formats.read import read_record_file
        >>> from edesign.ground_motion.hazard import checked_hazard, elastic_spectrum
        >>> from edesign.ground_motion.matching import MatchOptions
        >>> project = edesign.load_project(edesign.new_project("frame"))
        >>> records = {"simulated": read_record_file("frame/records/simulated_4.AT2")}
        >>> target = elastic_spectrum(checked_hazard(project))
        >>> found = edesign.match_records(records, target, MatchOptions("scale"), "matched.h5")
        >>> f"{found.motions['simulated'].scale:.2f}"
        '1.53'
    """
    started = time.monotonic()
    given = {key: Found(one, "file", one.source) if isinstance(one, Record) else one for key, one in recordings.items()}
    listen = progress or silent
    done: list[str] = []

    def report(motion: Motion) -> None:
        done.append(motion.name)
        text = motion.failure.removeprefix(f"{motion.name} ") or outcome(motion)
        listen(Progress("end", motion.name, len(done), len(given), 1.0, text, time.monotonic() - started))

    first_periods = None if fundamental_period is None else (fundamental_period,)
    root = Group(
        attributes={
            "title": title,
            "target": target.label,
            "record_checksums": {name: found.record.checksum for name, found in given.items()},
            "planned": [],
            "status": "running",
            **versions(),
        }
    )
    if source is not None:
        root.attributes["source_file"] = source_file(source, Path(archive_path))
    check_owner(Path(archive_path), root, overwrite)
    with ArchiveWriter(archive_path, root, extra={"provenance": circumstances()}) as writer:
        try:
            with stop_on_signals() as stop:
                prepare = partial(fit, target=target, options=options)
                motions = prepare_motions(given, prepare, workers, report, stop.is_set)
                if len(motions) < len(given):
                    raise Interrupted(f"interrupted; {writer.path} is unchanged")
            motions = {item.name: item for item in raise_suite(list(motions.values()), target, first_periods)}
            fitted = [motion for motion in motions.values() if not motion.failure]
            if not fitted:
                reasons = "".join(f"\n  {motion.failure}" for motion in motions.values())
                raise AnalysisError(f"none of the recordings can be fitted:{reasons} [E-RUN-01]")
            verdicts: tuple[RuleCheck, ...] = ()
            factors = {motion.name: motion.scale for motion in fitted}
            simulated = {motion.name for motion in fitted if motion.found.origin == "simulated"}
            warnings: list[str] = []
            with optional("the warnings about the factors") as warned:
                warnings += unusual_scales(factors, simulated)
            with optional("the criteria of the code") as judged:
                verdicts = criteria(fitted, target, first_periods)
            warnings += [str(one.failure) for one in (warned, judged) if one.failure is not None]
            for place, group in suite_groups(name, list(motions.values()), target, verdicts, warnings=warnings):
                writer.write(place, group)
            writer.finish({"status": "completed" if len(fitted) == len(motions) else "failed"})
        except BaseException:
            writer.discard()  # nothing of it could be used later
            raise
    return MatchSummary(writer.path, motions, verdicts, time.monotonic() - started)


@dataclass(frozen=True)
class Choice:
    """The recordings of a library that suit a spectrum best.

    Attributes:
        recordings: the chosen ones, by name.
        selection: factors, mean spectrum and criteria.
        of: how many there were.
    """

    recordings: dict[str, Found]
    selection: Selection
    of: int

    @property
    def facts(self) -> dict[str, Any]:
        """The facts about the choice that tables and JSON show."""
        return choice_facts(tuple(self.recordings), self.selection, self.of)


def choose_recordings(
    recordings: Mapping[str, Found],
    target: Spectrum,
    options: MatchOptions,
    fundamental_period: float,
    count: int,
    max_per_event: int | None = None,
) -> Choice:
    """Choose the recordings whose scaled mean is nearest to the spectrum and satisfies the code.

    Args:
        recordings: the library, by name.
        target: the elastic spectrum.
        options: band and bounds of the factors.
        fundamental_period: T1 of the structure, s.
        count: how many are wanted.
        max_per_event: how many of one earthquake at most; None for any number.

    Raises:
        InputError: there are not so many.
    """
    at_5_percent = target.with_damping(DAMPING)
    settings = SelectionOptions(scale_bounds=options.scale_bounds, band=options.periods, max_per_event=max_per_event)
    names = list(recordings)
    events = [recordings[name].event or name for name in names]
    records = [recordings[name].record for name in names]
    found = select_records(records, at_5_percent, fundamental_period, count, settings, events)
    return Choice({names[i]: recordings[names[i]] for i in found.chosen}, found, len(names))


def outcome(motion: Motion) -> str:
    """Return the misfit of a recording before and after its fit in words."""
    if motion.match is None:
        return "as recorded"
    before, after = motion.match.misfit_before, motion.match.misfit_after
    return f"rms misfit {100 * before.rms:.1f} % -> {100 * after.rms:.2f} %, largest {100 * after.largest:.1f} %"
