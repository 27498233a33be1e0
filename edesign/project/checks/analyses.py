"""Cross checks of analyses, with those of the loads, masses, damping and records that they need."""

from __future__ import annotations

from edesign.project.analysis.analyses import GravityAnalysis, HistoryAnalysis, PushoverAnalysis
from edesign.project.analysis_file import AnalysisFile
from edesign.project.checks.damping import check_damping
from edesign.project.checks.loads import check_loads
from edesign.project.checks.matching import check_fitted_levels
from edesign.project.checks.pushover import check_pushover
from edesign.project.checks.records import check_project_records, check_record_files
from edesign.project.checks.selections import Selections
from edesign.project.checks.vertical_motion import check_horizontal, check_vertical
from edesign.project.checks.wave_passage import check_wave_passage
from edesign.project.notation import names
from edesign.project.project import Project
from edesign.project.reading.problems import Keys, Problems, listed, unknown_name
from edesign.project.records.pairs import InSpace
from edesign.project.records.records import PairRecord, record_of


def check_analyses(project: Project, problems: Problems, files: bool = True) -> None:
    """Check loads, masses, damping, records and analyses of a project without schema problems.

    Args:
        files: whether the files of the records must be there.
    """
    check = Selections(project.frame, problems)
    check_loads(project, problems)
    _masses(project, problems, check)
    check_shared(project, problems, files)
    for i, analysis in enumerate(project.analyses):
        if isinstance(analysis, HistoryAnalysis):
            check_wave_passage(project, problems, ("analyses", i, "wave_passage"), analysis.wave_passage)


def check_shared(project: AnalysisFile, problems: Problems, files: bool = True) -> None:
    """Check damping, records and analyses of a plane frame or a building.

    Args:
        project: the file, which has no schema problems.
        files: whether the files of the records must be there.
    """
    check_damping(project, problems)
    _validity(project, problems)
    check_project_records(project, problems)
    if files:
        check_record_files(project.records, project.folder, problems)
    _analyses(project, problems)


def _masses(project: Project, problems: Problems, check: Selections) -> None:
    masses = project.masses
    if masses is None:
        return
    if (masses.given is None) == (masses.from_loads is None):
        problems.at_key(("masses",), "give either `given` or `from_loads`, one of them [E-KEY-03]")
        return
    if masses.from_loads is not None and not (project.loads.are_vertical or project.frame.leaning_column):
        problems.at_key(("masses", "from_loads"), "there are no loads that masses could come from [E-MODAL-02]")
    first: dict[str, int] = {}
    for i, given in enumerate(masses.given or ()):
        keys: Keys = ("masses", "given", i)
        if not check.nodes(keys, given.lines, given.floors):
            continue
        for place in project.frame.node_places(given.lines, given.floors):
            node = names.node_name(*place)
            if node in first:
                message = f"node {node} already has a mass from masses.given[{first[node]}]; give it once [E-NAME-02]"
                problems.at_value(keys, message)
                break
            first[node] = i


def _validity(project: AnalysisFile, problems: Problems) -> None:
    validity = project.validity
    if "energy_error_warning" in validity.model_fields_set and validity.energy_error_warning > validity.energy_error:
        message = (
            f"{validity.energy_error_warning:g} is greater than `energy_error` ({validity.energy_error:g}), "
            "beyond which an analysis has failed [E-VALUE-04]"
        )
        problems.at_value(("validity", "energy_error_warning"), message)


def check_drift(project: AnalysisFile, problems: Problems, keys: Keys, drift: float | None) -> None:
    """Check that a drift that an analysis is to reach is within the limit of valid results.

    Args:
        project: the file, which has no schema problems.
        drift: drift ratio; None: none is given.
    """
    largest = project.largest_drift
    if drift is not None and largest is not None and drift > largest:
        problems.at_value(
            keys,
            f"{100.0 * drift:g} % is beyond {100.0 * largest:.3g} %, where the geometry of the model no longer holds; "
            "corotational columns (`elements.geometry`) have no such limit, `validity.drift` is another [E-VALUE-02]",
        )


def _analyses(project: AnalysisFile, problems: Problems) -> None:
    first: dict[str, int] = {}
    for i, analysis in enumerate(project.analyses):
        keys: Keys = ("analyses", i)
        if analysis.name in first:
            message = (
                f"`{analysis.name}` is already the name of analyses[{first[analysis.name]}]; choose another [E-NAME-02]"
            )
            problems.at_value((*keys, "name"), message)
        first.setdefault(analysis.name, i)
        if isinstance(analysis, HistoryAnalysis):
            _history(project, problems, keys, analysis)
            check_drift(project, problems, (*keys, "collapse_drift"), analysis.collapse_drift)
            check_horizontal(project, problems, (*keys, "record"), (analysis.record,))
            levels = (analysis.level,) if analysis.level else ()
            check_vertical(project, problems, (*keys, "vertical"), analysis.vertical, (analysis.record,), levels)
        if isinstance(analysis, PushoverAnalysis):
            check_drift(project, problems, (*keys, "roof_drift"), analysis.roof_drift)
            check_pushover(project, problems, keys, analysis)
        if not isinstance(analysis, GravityAnalysis) and project.masses is None:
            message = (
                f"the {analysis.kind} analysis `{analysis.name}` needs `masses`, and the file has none [E-MODAL-02]"
            )
            problems.at_value(keys, message)


def _history(project: AnalysisFile, problems: Problems, keys: Keys, analysis: HistoryAnalysis) -> None:
    if record_of(analysis.record) not in project.records:
        problems.at_value((*keys, "record"), unknown_name("record", record_of(analysis.record), project.records))
    else:
        _level(project, problems, keys, analysis)
    if analysis.pga is not None and isinstance(project.records.get(record_of(analysis.record)), PairRecord | InSpace):
        message = "each component would have a factor of its own; give the `scale` of both [E-KEY-03]"
        problems.at_key((*keys, "pga"), f"`{analysis.record}` is a pair: {message}")
    if analysis.pga is not None and analysis.scale is not None:
        problems.at_key((*keys, "scale"), "`pga` and `scale` exclude each other; keep one of them [E-KEY-03]")
    if project.damping is None:
        message = "a history needs `damping`, and the file has none; for none write `damping: {kind: none}` [E-KEY-02]"
        problems.at_value(keys, message)
    if project.integration is None:
        example = "integration: {method: newmark, time_step: 0.01 s}"
        problems.at_value(
            keys, f"a history needs `integration`, and the file has none; for example `{example}` [E-KEY-02]"
        )


def _level(project: AnalysisFile, problems: Problems, keys: Keys, analysis: HistoryAnalysis) -> None:
    """A level is one of the hazard's, if that has any; a record fitted to its spectrum is scaled by a level only."""
    if project.hazard is None:
        return
    levels = project.hazard.levels
    if levels and analysis.level and analysis.level not in levels:
        problems.at_value((*keys, "level"), unknown_name("level", analysis.level, levels))
    if not project.records[record_of(analysis.record)].fitted:
        return
    fitted = f"`{analysis.record}` is fitted to the spectrum of the hazard"
    if not levels:
        problems.under(("hazard",), "levels", f"this key is missing; {fitted} and scaled to a level of it [E-KEY-02]")
    elif not analysis.level:
        message = f"this key is missing; {fitted} and scaled to a level of it: {listed(levels)} [E-KEY-02]"
        problems.under(keys, "level", message)
    check_fitted_levels((*keys, "level"), (record_of(analysis.record),), (analysis.level,), project, problems)
    for key in ("pga", "scale"):
        if getattr(analysis, key) is not None:
            problems.at_key((*keys, key), f"{fitted}; its `level` says the scale [E-KEY-03]")
