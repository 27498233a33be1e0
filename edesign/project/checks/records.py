"""Cross checks of records: what they say of themselves, the spectrum they are fitted to, and their files."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from edesign.project.analysis_file import AnalysisFile
from edesign.project.checks.matching import (
    check_compared_damping,
    check_fitted_level,
    check_less_than_critical,
    check_matching,
)
from edesign.project.reading.checks_files import check_file
from edesign.project.reading.file_bytes import is_folder
from edesign.project.reading.problems import Keys, Problems, listed, unknown_name
from edesign.project.records.chosen_records import FolderSource, Period, SuiteSource
from edesign.project.records.pairs import AnyRecord, InSpace
from edesign.project.records.processing import Step
from edesign.project.records.record_tables import UNITS
from edesign.project.records.records import (
    ChosenRecords,
    FemaP695Record,
    FileRecord,
    PairRecord,
    Record,
    RecordSet,
    RecordsOfSuite,
    StructdynRecord,
    SuiteRecords,
    TwoComponents,
)
from edesign.project.records.suite_names import is_suite_name, suite_names


def check_project_records(project: AnalysisFile, problems: Problems) -> None:
    """Check the keys of the records of a project against its hazard, without reading their files.

    Args:
        project: the file, which has no schema problems.
    """
    for name, record in project.records.items():
        keys: Keys = ("records", name)
        if isinstance(record, InSpace):
            continue  # of buildings, which check them
        check_matching(project.hazard, record.match, (*keys, "match"), problems)
        if isinstance(record, RecordSet) and record.match is not None and record.match.component == "vertical":
            message = "vertical motion is one record; those of a suite or a pair are horizontal [E-SCALE-01]"
            problems.at_value((*keys, "match", "component"), message)
        if isinstance(record, SuiteRecords | ChosenRecords) and record.fitted:
            check_compared_damping(project.hazard, name, problems, ("hazard", "damping"))
        check_record(record, keys, problems)
        if isinstance(record, ChosenRecords):
            _choice(project, record, keys, problems)


def check_record(record: Record, keys: Keys, problems: Problems) -> None:
    """Check the keys of a record, without reading its file.

    Args:
        record: as the file describes it.
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
        check_processing(record.processing, (*keys, "processing"), problems)
        return
    check_processing(record.processing, (*keys, "processing"), problems)
    if not isinstance(record, FemaP695Record):
        _format(record, keys, problems)


def check_components(record: TwoComponents, keys: Keys, problems: Problems) -> None:
    """Check that the components of a pair are two, and that what is done to both stands beside them.

    Args:
        record: as the file describes it.
        keys: its place in the file.
    """
    for i, component in enumerate(record.pair):
        check_record(component, (*keys, "pair", i), problems)
        if component.match is not None:
            problems.at_key(
                (*keys, "pair", i, "match"),
                "both components are scaled together: `match` stands beside `pair` [E-KEY-03]",
            )
    if record.pair[0] == record.pair[1]:
        problems.at_value((*keys, "pair", 1), "this is the first component again [E-NAME-02]")


def _pair(record: PairRecord, keys: Keys, problems: Problems) -> None:
    check_components(record, keys, problems)
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
        check_less_than_critical(project.hazard.damping, problems)
        check_fitted_level(project.hazard, record.level, keys, problems)
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
    records: Mapping[str, AnyRecord], folder: Path, problems: Problems, what: str = "project file"
) -> None:
    """Check that the files and folders of records are there.

    Args:
        what: the file is, for messages.
    """
    for name, record in records.items():
        keys: Keys = ("records", name)
        if isinstance(record, FileRecord):
            check_file(folder / record.file, (*keys, "file"), problems, what)
        if isinstance(record, PairRecord):
            check_component_files(record, folder, keys, problems, what)
        if isinstance(record, SuiteRecords):
            check_suite_files(record, folder, keys, problems, what)
        if not isinstance(record, ChosenRecords):
            continue
        for i, source in enumerate(record.sources):
            at = _source_keys(keys, i, problems)
            if isinstance(source, SuiteSource):
                check_suite_files(source, folder, at, problems, what)
            if isinstance(source, FolderSource):
                _check_folder(folder / source.folder, (*at, "folder"), problems, what)
                if source.flatfile is not None:
                    check_file(folder / source.flatfile, (*at, "flatfile"), problems, what)


def check_component_files(record: TwoComponents, folder: Path, keys: Keys, problems: Problems, what: str) -> None:
    """Check that the files of both components of a pair are there.

    Args:
        record: as the file describes it.
        folder: to which paths are relative.
        keys: its place in the file.
        what: the file is, for messages.
    """
    for i, component in enumerate(record.pair):
        if isinstance(component, FileRecord):
            check_file(folder / component.file, (*keys, "pair", i, "file"), problems, what)


def check_suite_files(
    record: RecordsOfSuite | SuiteSource, folder: Path, keys: Keys, problems: Problems, what: str
) -> None:
    """Check that the file of a suite and the folders with its recordings are there.

    Args:
        record: as the file describes it.
        folder: to which paths are relative.
        keys: its place in the file.
        what: the file is, for messages.
    """
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


def check_processing(steps: tuple[Step, ...], keys: Keys, problems: Problems) -> None:
    """Check the steps of a processing, each of which is one thing.

    Args:
        steps: in their order.
        keys: their place in the file.
    """
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
