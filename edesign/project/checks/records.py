"""Cross checks of records: what they say of themselves, the spectrum they are fitted to, and their files."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path

from edesign.project.actions.hazard import UserHazard
from edesign.project.actions.hazard_base import Hazard
from edesign.project.analysis_file import AnalysisFile
from edesign.project.reading.checks_files import check_file
from edesign.project.reading.file_bytes import is_folder
from edesign.project.reading.problems import Keys, Problems, listed, unknown_name
from edesign.project.records.chosen_records import FolderSource, Period, SuiteSource
from edesign.project.records.matching import Matching
from edesign.project.records.processing import Step
from edesign.project.records.record_tables import UNITS
from edesign.project.records.records import (
    ChosenRecords,
    FemaP695Record,
    FileRecord,
    PairRecord,
    Record,
    RecordSet,
    StructdynRecord,
    SuiteRecords,
)
from edesign.project.records.suite_names import is_suite_name, suite_names


def check_project_records(project: AnalysisFile, problems: Problems) -> None:
    """Check the keys of the records of a project against its hazard, without reading their files.

    Args:
        project: the file, which has no schema problems.
        problems: the problems of the file, to which those found are added.
    """
    for name, record in project.records.items():
        keys: Keys = ("records", name)
        _matching(project, record.match, (*keys, "match"), problems)
        if isinstance(record, RecordSet) and record.match is not None and record.match.component == "vertical":
            message = "vertical motion is one record; those of a suite or a pair are horizontal [E-SCALE-01]"
            problems.at_value((*keys, "match", "component"), message)
        fitted_suite = isinstance(record, SuiteRecords | ChosenRecords) and record.fitted
        if fitted_suite and isinstance(project.hazard, UserHazard) and not project.hazard.at_5_percent:
            message = (
                f"the criteria for the suite `{name}` compare spectra of 5 % damping; give tables for 5 %, or "
                "`damping_correction` [E-SCALE-02]"
            )
            problems.at_value(("hazard", "damping"), message)
        check_record(record, keys, problems)
        if isinstance(record, ChosenRecords):
            _choice(project, record, keys, problems)


def check_record(record: Record, keys: Keys, problems: Problems) -> None:
    """Check the keys of a record, without reading its file.

    Args:
        record: as the file describes it.
        problems: the problems of the file, to which those found are added.
    """
    if isinstance(record, ChosenRecords):
        return
    if isinstance(record, PairRecord):
        _pair(record, keys, problems)
        return
    if isinstance(record, SuiteRecords):
        for i, wanted in enumerate(record.only or ()):
            if wanted in (record.only or ())[:i]:
                problems.at_value(
                    (*keys, "only", i), f"`{wanted}` stands here twice; a recording is taken once [E-NAME-02]"
                )
        _processing(record.processing, (*keys, "processing"), problems)
        return
    _processing(record.processing, (*keys, "processing"), problems)
    if not isinstance(record, FemaP695Record):
        _format(record, keys, problems)


def _pair(record: PairRecord, keys: Keys, problems: Problems) -> None:
    """The components are two, and what is done to both stands beside them."""
    for i, component in enumerate(record.pair):
        check_record(component, (*keys, "pair", i), problems)
        if component.match is not None:
            problems.at_key(
                (*keys, "pair", i, "match"),
                "both components are scaled together: `match` stands beside `pair` [E-KEY-03]",
            )
    if record.pair[0] == record.pair[1]:
        problems.at_value((*keys, "pair", 1), "this is the first component again [E-NAME-02]")
    if record.match is not None and record.match.method != "scale":
        message = (
            "a pair is scaled by one factor, which keeps what its components are to each other: `method: scale`"
            " [E-SCALE-01]"
        )
        problems.at_value((*keys, "match", "method"), message)
    if record.match is None and "spectrum" in record.model_fields_set:
        problems.at_key(
            (*keys, "spectrum"), "this is what is compared with the spectrum of the hazard by `match` [E-SCALE-02]"
        )


def _choice(project: AnalysisFile, record: ChosenRecords, keys: Keys, problems: Problems) -> None:
    """Records can be chosen for a spectrum, by rules that fit together."""
    if project.hazard is None:
        problems.at_key(
            (*keys, "choose"), "records are chosen for the spectrum of the `hazard`, and the file has none [E-HAZ-05]"
        )
    elif record.match is None:
        _less_than_critical(project.hazard.damping, problems)
        _fitted_level(project.hazard, record.level, keys, problems)
    elif record.level is not None:
        problems.at_key((*keys, "level"), "with `match` its `level` says for which spectrum [E-KEY-03]")
    if record.T_1 is None and project.masses is None:
        message = "this key is missing; the file has no `masses` from which it would follow [E-MODAL-02]"
        problems.under(keys, "T_1", message)
    first, last = record.periods or (Period(0.0), Period(1.0))  # by the code they rise
    comparable = first.of_T_1 == last.of_T_1 or record.T_1 is not None
    if comparable and first.at(record.T_1 or 1.0) >= last.at(record.T_1 or 1.0):
        problems.at_value((*keys, "periods"), "the shorter period stands first, and the two must differ [E-VALUE-04]")
    if record.scale_bounds[0] > record.scale_bounds[1]:
        problems.at_value((*keys, "scale_bounds"), "the smaller factor stands first [E-VALUE-04]")
    low, high = record.scale_bounds
    if record.scaling == "none" and "scale_bounds" in record.model_fields_set and not low <= 1.0 <= high:
        problems.at_value(
            (*keys, "scale_bounds"), "with `scaling: none` every factor is 1, which lies outside [E-VALUE-04]"
        )
    of_tables: tuple[Keys, ...] = ()
    for i, source in enumerate(record.sources):
        at = _source_keys(keys, i, problems)
        if isinstance(source, FolderSource) and source.acceleration_unit is None:
            of_tables += tuple((*at, key) for key in ("time_step", "layout") if getattr(source, key) is not None)
        if source in record.sources[:i]:
            problems.at_value(at, "these candidates stand here twice [E-NAME-02]")
    for place in of_tables:
        problems.at_key(
            place, "this is of tables of samples, which are read where `acceleration_unit` is given too [E-KEY-03]"
        )


def _source_keys(keys: Keys, i: int, problems: Problems) -> Keys:
    """Where a source of chosen records stands: one alone needs no list."""
    return (*keys, "from", i) if problems.node((*keys, "from")).items is not None else (*keys, "from")


def check_record_files(
    records: Mapping[str, Record], folder: Path, problems: Problems, what: str = "project file"
) -> None:
    """Check that the files and folders of records are there.

    Args:
        problems: collects what is wrong.
        what: the file is, for messages.
    """
    for name, record in records.items():
        keys: Keys = ("records", name)
        if isinstance(record, FileRecord):
            check_file(folder / record.file, (*keys, "file"), problems, what)
        for i, component in enumerate(record.pair if isinstance(record, PairRecord) else ()):
            if isinstance(component, FileRecord):
                check_file(folder / component.file, (*keys, "pair", i, "file"), problems, what)
        if isinstance(record, SuiteRecords):
            _suite_files(record, folder, keys, problems, what)
        if not isinstance(record, ChosenRecords):
            continue
        for i, source in enumerate(record.sources):
            at = _source_keys(keys, i, problems)
            if isinstance(source, SuiteSource):
                _suite_files(source, folder, at, problems, what)
            if isinstance(source, FolderSource):
                _check_folder(folder / source.folder, (*at, "folder"), problems, what)
                if source.flatfile is not None:
                    check_file(folder / source.flatfile, (*at, "flatfile"), problems, what)


def _suite_files(record: SuiteRecords | SuiteSource, folder: Path, keys: Keys, problems: Problems, what: str) -> None:
    if not is_suite_name(record.suite):
        check_file(folder / record.suite, (*keys, "suite"), problems, what)
    elif record.suite not in suite_names():
        ending = f"; a file has an ending: `{record.suite}.yaml`"
        problems.at_value((*keys, "suite"), unknown_name("suite", record.suite, suite_names(), ending))
    for i, below in enumerate(record.folders):
        _check_folder(folder / below, (*keys, "folders", i), problems, what)


def _check_folder(path: Path, keys: Keys, problems: Problems, what: str) -> None:
    if not is_folder(path):
        problems.at_value(keys, f"there is no folder `{path}` (the path is relative to the {what}) [E-FILE-01]")


def _matching(project: AnalysisFile, match: Matching | None, keys: Keys, problems: Problems) -> None:
    if match is None:
        return
    if project.hazard is None:
        problems.at_key(keys, "a record is fitted to the spectrum of the `hazard`, and the file has none [E-HAZ-05]")
    else:
        _less_than_critical(project.hazard.damping, problems)
        _fitted_level(project.hazard, match.level, keys, problems)
    if match.periods[0] >= match.periods[1]:
        problems.at_value((*keys, "periods"), "the shorter period stands first, and the two must differ [E-VALUE-04]")
    if match.scale_bounds[0] > match.scale_bounds[1]:
        problems.at_value((*keys, "scale_bounds"), "the smaller factor stands first [E-VALUE-04]")


def _fitted_level(hazard: Hazard, level: str | None, keys: Keys, problems: Problems) -> None:
    """Which of the levels a record is fitted to, where each has a spectrum of its own."""
    if level is not None and not hazard.own_shapes:
        message = (
            "the levels have spectra of one shape, and records fitted to it are scaled to each; leave this key out"
            " [E-KEY-03]"
        )
        problems.at_key((*keys, "level"), message)
    elif level is not None and level not in hazard.levels:
        problems.at_value((*keys, "level"), unknown_name("level", level, hazard.levels))
    elif level is None and hazard.own_shapes and len(hazard.levels) > 1:
        message = f"this key is missing; each level has a spectrum of its own: {listed(hazard.levels)} [E-KEY-02]"
        problems.under(keys, "level", message)


def check_fitted_levels(
    keys: Keys, records: Iterable[str], levels: Sequence[str], project: AnalysisFile, problems: Problems
) -> None:
    """Check that records fitted to the spectrum of one level are used at no other.

    Args:
        keys: where the levels stand in the file of the problems.
        records: names of fitted records of the project; those that are fitted to a shape of all levels pass.
        project: that has them.
        problems: collects what is wrong.
    """
    for name in records:
        only = project.fitted_level(name)
        for i, level in enumerate(levels):
            if only is not None and level in project.hazard_levels and level != only:
                message = (
                    f"`{name}` is fitted to the spectrum of `{only}`, which has another shape than that of `{level}`"
                )
                problems.at_item(keys, i, f"{message}; match another record to it [E-SCALE-02]")


def _less_than_critical(damping: float, problems: Problems) -> None:
    if damping >= 1.0:
        message = (
            "a record is fitted to this spectrum; its damping must be less than critical, below 100 % [E-VALUE-02]"
        )
        problems.at_value(("hazard", "damping"), message)


def _format(record: FileRecord | StructdynRecord, keys: Keys, problems: Problems) -> None:
    """Tables of text need help; files of other formats say unit and time step themselves."""
    suffix = record.file.lower().rpartition(".")[2]
    kind = record.format or {"at2": "at2", "csv": "table"}.get(suffix)
    if kind in ("table", "sac") and record.acceleration_unit is None:
        what = "a table" if kind == "table" else "a SAC file"
        message = f"this key is missing; {what} does not say its unit (allowed: {listed(UNITS)}) [E-KEY-02]"
        problems.under(keys, "acceleration_unit", message)
    if kind == "table":
        if record.columns is not None and record.columns.time is None and record.time_step is None:
            problems.under(keys, "time_step", "this key is missing; without a time column it is needed [E-KEY-02]")
    elif kind is not None:
        for key in ("acceleration_unit", "time_step", "columns", "table"):
            if getattr(record, key) is not None and (kind, key) != ("sac", "acceleration_unit"):
                problems.at_key(
                    (*keys, key), f"a file of the format `{kind}` says this itself; leave this key out [E-KEY-03]"
                )


def _processing(steps: tuple[Step, ...], keys: Keys, problems: Problems) -> None:
    for i, step in enumerate(steps):
        if not step.given:
            problems.at_value((*keys, i), f"a step is one of {listed(Step.model_fields)} [E-VALUE-01]")
        for name in step.given[1:]:
            problems.at_key(
                (*keys, i, name), f"`{step.given[0]}` is this step; begin a new one with `- {name}:` [E-KEY-03]"
            )
        if step.filter is not None and step.filter.low is None and step.filter.high is None:
            problems.at_key((*keys, i, "filter"), "give `low`, `high`, or both [E-KEY-03]")
        if step.reverse is False:
            message = (
                "`true` is allowed, which reverses the motion; leave the step out for the motion as recorded "
                "[E-VALUE-03]"
            )
            problems.at_value((*keys, i, "reverse"), message)
