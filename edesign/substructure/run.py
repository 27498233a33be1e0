"""Run the virtual tests of a file into an archive."""

from __future__ import annotations

import os
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import NamedTuple

import numpy as np

from edesign.archive.csv_files import write_csv_file
from edesign.archive.dataset import Group
from edesign.archive.files import make_folder, source_file
from edesign.archive.owner import check_owner
from edesign.archive.writer import ArchiveWriter
from edesign.errors import ArchiveError, InputError
from edesign.optional_stages import optional
from edesign.project.document import Document
from edesign.project.reading.problems import listed
from edesign.project.substructure.programme import RtsTest
from edesign.project.substructure.rts_file import RtsFile
from edesign.stopping import Stopped
from edesign.study.results.kinds import SUBSTRUCTURE
from edesign.study.results.provenance import circumstances, versions
from edesign.study.run.interrupt import stop_on_signals
from edesign.substructure.advice.unstable_runs import with_unstable_loops
from edesign.substructure.archived import INDICATORS, PLACE, building_name, groups, indicators, method_group
from edesign.substructure.judgement.measured import APPLIED_FORCE, HEADERS
from edesign.substructure.methods import MethodRecord, PseudoDynamicRecord
from edesign.substructure.methods.method_tests import MethodResults
from edesign.substructure.virtual_test import VirtualTest
from edesign.substructure.virtual_tests import TestResults, VirtualLaboratory

_CSV = "the CSV file of a run"


class RtsRun(NamedTuple):
    """The virtual tests of a file that were run.

    Attributes:
        archive: with all of them.
        tests: results of real-time tests, test by test.
        methods: results of tests by other methods.
    """

    archive: Path
    tests: tuple[TestResults, ...]
    methods: tuple[MethodResults, ...]


def run_tests(
    file: RtsFile,
    archive_path: str | os.PathLike[str] | None = None,
    overwrite: bool = False,
    progress: Callable[[str], None] = lambda line: None,
    csv_folder: Path | None = None,
) -> RtsRun:
    """Run all virtual tests of a file, and archive them.

    Args:
        file: from `load_rts_file`.
        archive_path: the archive; by default what the file says.
        overwrite: True replaces the archive of something else too.
        progress: called with the name of each run at its beginning.
        csv_folder: where each run is written as CSV as well; made if it does not exist.

    Returns:
        Where the archive is, and the results.

    Raises:
        InputError: structure, law, compensator or record cannot be used so; two CSV files would have one name.
        ArchiveError: the archive cannot be written, or is that of something else.
        KeyboardInterrupt: by Ctrl-C; nothing is left then.

    Examples:
        >>> file = edesign.load_rts_file(edesign.new_project("rts", kind="substructure"))
        >>> done = edesign.run_tests(file)
        >>> done.archive.name, {run.outcome for run in done.tests[0].runs}
        ('rts.h5', {'done'})
    """
    file.check_unchanged()
    path = Path(archive_path) if archive_path is not None else file.archive_path
    root = _root(file, path)
    gone = check_owner(path, root, overwrite)
    if gone:
        progress(f"replacing {path}, which has {listed(gone, 5)} that {file.path.name} no longer asks for")
    laboratory = VirtualLaboratory(file)
    names = _csv_names(laboratory) if csv_folder is not None else {}
    _ = laboratory.drives  # what is wrong with records and commands is reported before anything is written
    warnings = list(laboratory.laboratory.warnings)
    root.attributes["warnings"] = warnings
    if csv_folder is not None:
        make_folder(csv_folder)
    found: list[TestResults] = []
    others: list[MethodResults] = []
    with stop_on_signals() as stop, ArchiveWriter(path, root, extra={"provenance": circumstances()}) as writer:

        def begin(line: str) -> None:
            if stop.is_set():
                raise Stopped
            progress(line)

        try:
            for results in (_asked(laboratory, one) for one in laboratory.run(begin, stop.is_set)):
                for place, group in groups(results, file.outputs.histories):
                    writer.write(place, group)
                for run in results.runs:
                    if csv_folder is not None and run.record is not None:
                        with optional(_CSV):
                            write_run(run, csv_folder / names[run.test, run.compensator])
                found.append(results)
            for other in laboratory.run_others(begin, stop.is_set):
                time = laboratory.drives[other.name].time
                writer.write(f"{PLACE}/{other.name}", method_group(other, time))
                if csv_folder is not None and other.record is not None:
                    with optional(_CSV):
                        _write_method(other.record, time, csv_folder / names[other.name, ""])
                others.append(other)
            with optional("the indicators", passing=(ArchiveError,)):
                writer.write(INDICATORS, indicators([run for results in found for run in results.runs]))
            warnings += dict.fromkeys(text for results in found for run in results.runs for text in run.warnings)
            writer.finish({"status": "completed", "warnings": warnings})
        except BaseException:  # tests take seconds: the next run begins anew, and nothing half done is left
            writer.close()
            writer.partial.unlink(missing_ok=True)
            raise
    return RtsRun(path, tuple(found), tuple(others))


def _asked(laboratory: VirtualLaboratory, results: TestResults) -> TestResults:
    """Return results with what the linearised loop says of them; where it cannot be asked, runs get a warning."""
    with optional(f"whether the loops of {results.name} are stable") as attempt:
        return with_unstable_loops(laboratory, results)
    reason = str(attempt.failure)
    return replace(results, runs=tuple(replace(run, warnings=(*run.warnings, reason)) for run in results.runs))


def write_run(run: VirtualTest, path: Path) -> None:
    """Write a run as CSV, as a laboratory records it: time, target, command, displacement at the specimen, force.

    Where the compensator corrects the force, `APPLIED_FORCE` is a column too.

    Args:
        path: of the CSV file.

    Raises:
        ArchiveError: it cannot be written.
    """
    record = run.record
    assert record is not None
    mm = (record.target, record.command, record.measured, record.actuator)
    columns = [run.time, *(1e3 * one for one in mm), 1e-3 * record.force]
    headers = list(HEADERS)
    if record.force_is_corrected:
        headers.append(APPLIED_FORCE)
        columns.append(1e-3 * record.applied_force)
    write_csv_file(headers, zip(*(column.tolist() for column in columns), strict=True), path, digits=9)


def _write_method(record: MethodRecord, time: np.ndarray, path: Path) -> None:
    """Write a test by another method as CSV: time of the earthquake, target if it has one, displacement, force.

    Args:
        time: (n,) s, of the earthquake.
        path: of the CSV file.

    Raises:
        ArchiveError: it cannot be written.
    """
    channels = {"time_s": time[: record.deformation.size]}
    if isinstance(record, PseudoDynamicRecord):
        channels["target_mm"] = 1e3 * record.target
    channels |= {"displacement_mm": 1e3 * record.deformation, "force_kN": 1e-3 * record.damper_force}
    columns = [one.tolist() for one in channels.values()]
    write_csv_file(list(channels), zip(*columns, strict=True), path, digits=9)


def _csv_names(laboratory: VirtualLaboratory) -> dict[tuple[str, str], str]:
    """Name of the CSV file of each run, by test and compensator ("" of other methods); `judge` finds the test by it.

    Raises:
        InputError: two runs have one.
    """
    names: dict[tuple[str, str], str] = {}
    runs: dict[str, tuple[str, str]] = {}
    all_runs = [(test.name, compensator) for test in laboratory.tests for compensator in laboratory.compensators]
    for run in (*all_runs, *((test.name, "") for test in laboratory.others)):
        names[run] = name = f"{'_'.join(part for part in run if part)}.csv"
        if name in runs:
            raise InputError(
                f"{laboratory.file.path}: {name} would be both {_called(runs[name])} and {_called(run)}; rename one of "
                "the tests or compensators, or run without CSV files [E-NAME-02]"
            )
        runs[name] = run
    return names


def _called(run: tuple[str, str]) -> str:
    test, compensator = run
    return f"test {test} with {compensator}" if compensator else f"test {test}"


def _planned(file: RtsFile) -> list[str]:
    """The buildings of tests, as they stand among the analyses."""
    shaken = [test.name for test in file.tests if isinstance(test, RtsTest)]
    return [building_name(test, compensator) for test in shaken for compensator in ("", *file.compensators)]


def _root(file: RtsFile, path: Path) -> Group:
    of_project = file.project.document if file.project is not None else Document()
    root = Group(
        attributes={
            "title": file.title or file.path.stem,
            "document": dict(file.document.over(of_project).said),
            "kind": SUBSTRUCTURE,
            "rts_file": file.path.name,
            "rts_checksum": file.checksum,
            "source_file": source_file(file.path, path),
            "response_error_limit": file.criteria.response_error,
            **versions(),
            "planned": _planned(file),
            "status": "running",
        }
    )
    for name, (text, what) in file.texts.items():
        root.add(name, (), text, "", f"text of the {what}")
    return root
