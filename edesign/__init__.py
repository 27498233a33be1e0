"""edesign: seismic design and evaluation of steel moment frames, from a project file to an archive.

The functions behind the commands, loaded when first used:

    load_project(path) -> Project             edesign check
    load_study(path) -> Study                 edesign check
    load_building(path) -> Building           edesign check
    check_project(project) -> dict            edesign check
    check_study(study) -> dict                edesign check
    check_building(building) -> dict          edesign check
    new_project(folder, name, kind) -> Path   edesign new
    run_project(project, ...) -> RunSummary   edesign run
    run_study(study, ...) -> RunSummary       edesign run
    run_building(building, ...)               edesign run
    load_rts_file(path) -> RtsFile            edesign rts check
    run_tests(file, ...)                      edesign rts run
    calibrate(campaign) -> Calibration        edesign calibrate
    fit_law(law, tests, ...) -> Fit           edesign fit
    match_records(records, target, ...)       edesign match
    response_spectra(acceleration, ...)       edesign spectrum
    translate(source, target, ...)            edesign translate
    open_archive(path) -> OpenArchive         edesign show, edesign export
    summarise(archive) -> dict                edesign show --json
    data_frames(tables) -> dict               tables of any report, by name
"""

from __future__ import annotations

from importlib import import_module
from typing import Any

from edesign._version import __version__

__all__ = [
    "__version__",
    "calibrate",
    "check_building",
    "check_project",
    "check_study",
    "data_frames",
    "fit_law",
    "load_building",
    "load_project",
    "load_rts_file",
    "load_study",
    "match_records",
    "new_project",
    "open_archive",
    "response_spectra",
    "run_building",
    "run_project",
    "run_study",
    "run_tests",
    "summarise",
    "translate",
]

_PLACES = {
    "data_frames": "edesign.report.export.frames",
    "load_project": "edesign.frame.project_file",
    "load_building": "edesign.frame.building_file",
    "load_study": "edesign.frame.project_file",
    "new_project": "edesign.project.template",
    "check_project": "edesign.study.check.summary",
    "check_building": "edesign.space.check",
    "check_study": "edesign.study.check.summary",
    "open_archive": "edesign.report.open_archive",
    "run_building": "edesign.study.run.building",
    "run_project": "edesign.study.run.run",
    "run_study": "edesign.study.run.run",
    "summarise": "edesign.report.archive.summary",
    "calibrate": "edesign.calibration.run",
    "fit_law": "edesign.damper.fitting.law_fit",
    "load_rts_file": "edesign.project.substructure.loader",
    "match_records": "edesign.study.run.match",
    "response_spectra": "edesign.ground_motion.response_spectrum",
    "run_tests": "edesign.substructure.run",
    "translate": "edesign.exchange.formats",
}


def __getattr__(name: str) -> Any:
    """Load a function when it is first asked for, so that `import edesign` stays quick."""
    if name not in _PLACES:
        raise AttributeError(f"module 'edesign' has no attribute {name!r}")
    value = getattr(import_module(_PLACES[name]), name)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})
