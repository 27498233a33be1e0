"""edesign: seismic design and evaluation of steel frames and their dampers, from a project file to an archive.

The functions behind the commands, loaded when first used:

    load_project(path) -> Project             edesign check
    load_study(path) -> Study                 edesign check
    load_building(path) -> Building           edesign check
    check_project(project) -> dict            edesign check
    check_study(study) -> dict                edesign check
    check_building(building) -> dict          edesign check
    make_project(title, ...) -> Project       a model in Python instead of a file
    make_study(title, project, ...) -> Study  likewise
    make_building(title, ...) -> Building     likewise
    new_project(folder, name, kind) -> Path   edesign new
    run_project(project, ...) -> RunSummary   edesign run
    run_study(study, ...) -> RunSummary       edesign run
    run_building(building, ...)               edesign run
    design_building(building, ...)            edesign design
    load_rts_file(path) -> RtsFile            edesign rts check
    run_tests(file, ...) -> RtsRun            edesign rts run
    load_campaign(path) -> Campaign           edesign check
    calibrate(campaign) -> Calibration        edesign calibrate
    fit_law(law, tests, ...) -> Fit           edesign fit
    read_record_file(path, ...) -> Record     edesign records
    elastic_spectrum(hazard) -> Spectrum      edesign spectrum
    response_spectra(acceleration, ...)       edesign spectrum
    match_records(records, target, ...)       edesign match
    translate(source, target, ...)            edesign translate
    open_archive(path) -> OpenArchive         edesign show, edesign export
    write_page(archive, ...) -> Path          edesign report
    summarise(archive) -> dict                edesign show --json
    data_frames(tables) -> dict               tables of any report, by name
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

from edesign._version import __version__

if TYPE_CHECKING:  # for editors and type checkers
    from edesign.calibration.campaign import load_campaign
    from edesign.calibration.results.result import Calibration
    from edesign.calibration.run import calibrate
    from edesign.damper.fitting.fit import Fit
    from edesign.damper.fitting.law_fit import fit_law
    from edesign.errors import AnalysisError, ArchiveError, EdesignError, InputError, Interrupted
    from edesign.exchange.formats import translate
    from edesign.frame.building_file import load_building
    from edesign.frame.project_file import load_project, load_study
    from edesign.frame.python_files import make_building, make_project, make_study
    from edesign.ground_motion.formats.read import read_record_file
    from edesign.ground_motion.hazard import checked_hazard, elastic_spectrum
    from edesign.ground_motion.matching.options import MatchOptions
    from edesign.ground_motion.record import Record
    from edesign.ground_motion.response_spectrum import response_spectra
    from edesign.project.building.building import Building
    from edesign.project.project import Project
    from edesign.project.study.study import Study
    from edesign.project.substructure.loader import load_rts_file
    from edesign.project.template import new_project
    from edesign.report.archive.document import write_page
    from edesign.report.archive.summary import summarise
    from edesign.report.export.frames import data_frames
    from edesign.report.open_archive import OpenArchive, open_archive
    from edesign.space.check import check_building
    from edesign.study.check.summary import check_project, check_study
    from edesign.study.run.building import BuildingChoice, BuildingRun, design_building, run_building
    from edesign.study.run.match import MatchSummary, match_records
    from edesign.study.run.outcome import RunSummary
    from edesign.study.run.run import run_project, run_study
    from edesign.substructure.run import RtsRun, run_tests

__all__ = [
    "AnalysisError",
    "ArchiveError",
    "Building",
    "BuildingChoice",
    "BuildingRun",
    "Calibration",
    "EdesignError",
    "Fit",
    "InputError",
    "Interrupted",
    "MatchOptions",
    "MatchSummary",
    "OpenArchive",
    "Project",
    "Record",
    "RtsRun",
    "RunSummary",
    "Study",
    "__version__",
    "calibrate",
    "check_building",
    "check_project",
    "check_study",
    "checked_hazard",
    "data_frames",
    "design_building",
    "elastic_spectrum",
    "fit_law",
    "load_building",
    "load_campaign",
    "load_project",
    "load_rts_file",
    "load_study",
    "make_building",
    "make_project",
    "make_study",
    "match_records",
    "new_project",
    "open_archive",
    "read_record_file",
    "response_spectra",
    "run_building",
    "run_project",
    "run_study",
    "run_tests",
    "summarise",
    "translate",
    "write_page",
]

_PLACES = {
    "AnalysisError": "edesign.errors",
    "ArchiveError": "edesign.errors",
    "EdesignError": "edesign.errors",
    "InputError": "edesign.errors",
    "Interrupted": "edesign.errors",
    "Building": "edesign.project.building.building",
    "BuildingChoice": "edesign.study.run.building",
    "BuildingRun": "edesign.study.run.building",
    "Calibration": "edesign.calibration.results.result",
    "Fit": "edesign.damper.fitting.fit",
    "MatchOptions": "edesign.ground_motion.matching.options",
    "MatchSummary": "edesign.study.run.match",
    "OpenArchive": "edesign.report.open_archive",
    "Project": "edesign.project.project",
    "Record": "edesign.ground_motion.record",
    "RtsRun": "edesign.substructure.run",
    "RunSummary": "edesign.study.run.outcome",
    "Study": "edesign.project.study.study",
    "calibrate": "edesign.calibration.run",
    "check_building": "edesign.space.check",
    "check_project": "edesign.study.check.summary",
    "check_study": "edesign.study.check.summary",
    "checked_hazard": "edesign.ground_motion.hazard",
    "data_frames": "edesign.report.export.frames",
    "design_building": "edesign.study.run.building",
    "elastic_spectrum": "edesign.ground_motion.hazard",
    "fit_law": "edesign.damper.fitting.law_fit",
    "load_building": "edesign.frame.building_file",
    "load_campaign": "edesign.calibration.campaign",
    "load_project": "edesign.frame.project_file",
    "load_rts_file": "edesign.project.substructure.loader",
    "load_study": "edesign.frame.project_file",
    "make_building": "edesign.frame.python_files",
    "make_project": "edesign.frame.python_files",
    "make_study": "edesign.frame.python_files",
    "match_records": "edesign.study.run.match",
    "new_project": "edesign.project.template",
    "open_archive": "edesign.report.open_archive",
    "read_record_file": "edesign.ground_motion.formats.read",
    "response_spectra": "edesign.ground_motion.response_spectrum",
    "run_building": "edesign.study.run.building",
    "run_project": "edesign.study.run.run",
    "run_study": "edesign.study.run.run",
    "run_tests": "edesign.substructure.run",
    "summarise": "edesign.report.archive.summary",
    "translate": "edesign.exchange.formats",
    "write_page": "edesign.report.archive.document",
}


if not TYPE_CHECKING:  # else any name would do for a type checker

    def __getattr__(name: str) -> Any:
        """Load a name when it is first asked for, so that `import edesign` stays quick."""
        if name not in _PLACES:
            raise AttributeError(f"module 'edesign' has no attribute {name!r}")
        value = getattr(import_module(_PLACES[name]), name)
        globals()[name] = value
        return value


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})
