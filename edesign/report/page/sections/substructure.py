"""The sections of virtual substructure tests: verdict, what was tested, rig, tracking, response, limits."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator
from dataclasses import replace
from functools import wraps
from typing import TYPE_CHECKING

from edesign.archive.reader import Archive
from edesign.damper.laws import LAWS
from edesign.errors import ArchiveError
from edesign.report.archive_view import input_warnings
from edesign.report.drawing.captions import plain
from edesign.report.html.section import Facts, Folded, Headline, Headlines, Part, Section, Warnings, made
from edesign.report.page.source import Source
from edesign.report.page.words import in_words
from edesign.report.response.energy_figures import energy_figures
from edesign.report.response.mean_profiles import mean_profile_figures
from edesign.report.response.profile_figures import profile_figures
from edesign.report.substructure.alpha_figures import alpha_figures
from edesign.report.substructure.building_tables import building_tables
from edesign.report.substructure.diagram import kind_words, loop_diagrams
from edesign.report.substructure.file import ArchivedTests
from edesign.report.substructure.limits import limits_table, runs_so_far_table, undetermined_table
from edesign.report.substructure.map_figures import map_figures
from edesign.report.substructure.method_figures import method_figures
from edesign.report.substructure.model_figures import tested_structures
from edesign.report.substructure.response_figures import energy_error_figures, loop_figures, response_figures
from edesign.report.substructure.results import NONE, SubstructureResults
from edesign.report.substructure.rig_figures import rig_figures
from edesign.report.substructure.tables import Run, substructure_tables
from edesign.report.substructure.tracking_figures import synchronisation_figures, tracking_figures
from edesign.report.tables.table import Table
from edesign.substructure.archived import INDICATORS

if TYPE_CHECKING:
    from matplotlib.figure import Figure

Drawn = Callable[[SubstructureResults], Iterator[tuple[str, str, "Figure"]]]
TEXTS = (
    ("rts_text", "The file of tests"),
    ("project_text", "The project file"),
    ("rig_text", "The rig file"),
    ("law_text", "The law file"),
)
LIMITS = "Limits that were met"


def substructure_sections(source: Source) -> list[Section]:
    """Return the sections of virtual substructure tests; the first names unreadable parts."""
    results = SubstructureResults(source.archive)
    tables = _tables(results)
    others = [
        made("what was tested", lambda: _tested(source, results)),
        _rig(source, results),
        _stability(source, results),
        made("tracking", lambda: _tracking(source, results, tables)),
        made("response of the test", lambda: _response(source, results, tables)),
        made("building", lambda: _building(source, results)),
        made("coefficients", lambda: _coefficients(source, results, tables)),
        made("other methods", lambda: _other_methods(source, results, tables)),
        made("limits", lambda: _limits(results)),
        made("undetermined", lambda: _undetermined(results)),
    ]
    return [section for section in (made("verdict", lambda: _verdict(source, results)), *others) if section]


def _rig(source: Source, results: SubstructureResults) -> Section:
    return Section("rig", "The rig with and without compensation", (), _pictures(source, results, rig_figures))


def _stability(source: Source, results: SubstructureResults) -> Section:
    return Section("stability", "Where the tests are stable", (), _pictures(source, results, map_figures))


def _tables(results: SubstructureResults) -> list[Table]:
    """Return the tables of tracking, response, coefficients and other methods; none without indicators."""
    if not results.archive.has(INDICATORS):
        return []
    try:
        return substructure_tables(results.archive)
    except (ArchiveError, KeyError) as error:
        results.lost.append(f"tables: {error}")
        return []


def _pictures(source: Source, results: SubstructureResults, *drawn: Drawn) -> tuple[Part, ...]:
    def of_archive(draw: Drawn) -> Callable[[Archive], Iterator[tuple[str, str, Figure]]]:
        @wraps(draw)
        def pictures(archive: Archive) -> Iterator[tuple[str, str, Figure]]:
            return draw(results)

        return pictures

    return source.pictures(*map(of_archive, drawn))


def _some(tables: list[Table], number: int) -> tuple[Part, ...]:
    """A table without its title, which the section has, and with its lines below as one paragraph."""
    found = [replace(table, title="", notes=[" ".join(table.notes)] if table.notes else []) for table in tables]
    return tuple(table for table in found[number : number + 1] if table.rows)


def _verdict(source: Source, results: SubstructureResults) -> Section:
    """Which compensator keeps the response right, what did not end well, and the warnings."""
    parts: list[Part] = []
    if results.lost:
        parts.append(Warnings("What cannot be read of the archive", tuple(results.lost)))
    bad = [f"{run.test}, {run.compensator}: {run.text('outcome')}, {run.text('reason')}" for run in _not_done(results)]
    parts += [Warnings("Runs without a result", tuple(bad))] if bad else []
    warnings = input_warnings(results.archive)
    parts += [Warnings("Warnings", tuple(warnings))] if warnings else []
    tiles = [tile for test in results.tests for tile in _tiles(results, test)]
    parts += [Headlines(tuple(tiles))] if tiles else []
    so_far = runs_so_far_table(results)
    parts += [so_far] if so_far.rows else []
    return Section("summary", "Verdict", tuple(_sentences(results)), tuple(parts))


def _not_done(results: SubstructureResults) -> list[Run]:
    return [run for run in results.runs if run.text("outcome") != "done"]


def _tiles(results: SubstructureResults, test: str) -> Iterator[Headline]:
    """The error of the best run of a test, and of the one without compensation."""
    best = results.best(test)
    none = next((name for name in results.compensators(test) if results.kind(name) == NONE), None)
    for name in dict.fromkeys(filter(None, (best, none))):
        run = results.run(test, name)
        if run is None:
            continue
        error = run.value("response_error")
        closed = not math.isnan(error)
        shown = error if closed else run.value("nrms_root")
        if run.text("outcome") != "done":
            yield Headline(run.text("outcome"), f"{test}, {name}", run.text("reason"), "bad")
        elif not math.isnan(shown):
            state = ("good" if error <= _most(results) else "bad") if closed else ""
            what = "error of the response" if closed else "NRMS of tracking"
            detail = f"{what}; {results.in_words(test, name)}" if closed else f"{what}, {_late(results, test, name)}"
            yield Headline(f"{plain(100.0 * shown)}\N{NO-BREAK SPACE}%", f"{test}, {name}", detail, state)


def _late(results: SubstructureResults, test: str, name: str) -> str:
    return results.in_words(test, name).partition(",")[0]


def _most(results: SubstructureResults) -> float:
    """Largest error of the response that the file allows."""
    limit = results.archive.attributes.get("response_error_limit")
    return float(limit) if isinstance(limit, (int, float)) else math.inf


def _sentences(results: SubstructureResults) -> Iterator[str]:
    """The verdict on each test with a structure, in words."""
    most = _most(results)
    allowed = f"at most {plain(100.0 * most)} % are allowed" if math.isfinite(most) else "no limit is set"
    found = False
    for test in results.tests:
        runs = [run for run in results.runs if run.test == test]
        judged = [run for run in runs if not math.isnan(run.value("response_error")) or run.text("outcome") != "done"]
        if not judged or not results.is_closed(test):
            continue
        found = True
        good = [run for run in judged if run.text("outcome") == "done" and run.value("response_error") <= most]
        yield f"{test}: {_judgement(good, judged)}; {allowed}."
    if not found and results.runs:
        yield "Targets are given in all tests: they show how the rig follows, and nothing of a response."


def _judgement(good: list[Run], judged: list[Run]) -> str:
    """Return the compensators that keep the response right, and the others, each with its error, in words."""
    wrong = [run for run in judged if run not in good]
    words = []
    if good:
        names = _listed(_with_error(run) for run in good)
        words.append(f"{names} {'keeps' if len(good) == 1 else 'keep'} the response right")
    if wrong:
        names = _listed(_with_error(run) for run in wrong)
        words.append(f"{names} {'does' if len(wrong) == 1 else 'do'} not")
    return ", ".join(words) if good else f"no compensator keeps the response right: {words[0]}"


def _with_error(run: Run) -> str:
    name = "the test without compensation" if run.compensator == NONE else run.compensator
    if run.text("outcome") != "done":
        return f"{name} ({run.text('outcome')})"
    return f"{name} ({plain(100.0 * run.value('response_error'))} %)"


def _listed(names: Iterable[str]) -> str:
    *most, last = names
    return f"{', '.join(most)} and {last}" if most else last


def _tested(source: Source, results: SubstructureResults) -> Section:
    """File, structure, law, rig and loop in words and as a diagram."""
    described = results.described
    rows = described.rows()
    parts: list[Part] = [Facts(tuple(rows))] if rows else []
    parts += _pictures(source, results, loop_diagrams, tested_structures)
    driven = {test: str(results.driven(test).attributes.get("source") or "") for test in results.tests}
    motions = [(test, what) for test, what in driven.items() if what and results.is_closed(test)]
    parts += [Facts(tuple((f"Ground motion of {test}", what) for test, what in motions))] if motions else []
    for name, what in TEXTS:
        text = source.text(name)
        if text:
            parts.append(Folded(f"{what}, {len(text.splitlines())} lines", text=text))
    section = Section("tested", "What was tested", (), tuple(parts), tuple(described.notes))
    return in_words(section, _words(described))


def _words(described: ArchivedTests) -> dict[str, str]:
    """The law, the rig, the integration and the compensators in words."""
    file = described.file
    if file is None:
        return {}
    kinds: list[str] = [compensator.kind for compensator in file.compensators.values()]
    kinds += [described.plant.kind] if described.plant is not None else []
    kinds.append(file.integration.method)
    found = {kind: kind_words(kind) for kind in kinds}
    law = file.law
    return found | ({law.law.type: LAWS[law.law.type].title} if law is not None and law.law.type in LAWS else {})


def _tracking(source: Source, results: SubstructureResults, tables: list[Table]) -> Section:
    pictures = _pictures(source, results, tracking_figures, synchronisation_figures)
    return Section("tracking", "How the specimen followed its target", (), (*_some(tables, 0), *pictures))


def _response(source: Source, results: SubstructureResults, tables: list[Table]) -> Section:
    pictures = _pictures(source, results, response_figures, loop_figures, energy_error_figures)
    return Section("test-response", "What the test did to structure and specimen", (), (*_some(tables, 1), *pictures))


def _building(source: Source, results: SubstructureResults) -> Section:
    """Peaks, energies and levels of the whole building, as those of histories."""
    try:
        found = building_tables(results.archive)
    except (ArchiveError, KeyError) as error:
        results.lost.append(f"building: {error}")
        found = []
    tables = tuple(table for table in found if table.rows)
    if not tables:
        return Section("building", "What the building did")
    over, single = source.pictures(mean_profile_figures), source.pictures(profile_figures)
    profiles: tuple[Part, ...] = (*over, Folded("Profiles of each building", single)) if over and single else single
    return Section("building", "What the building did", (), (*tables, *profiles, *source.pictures(energy_figures)))


def _coefficients(source: Source, results: SubstructureResults, tables: list[Table]) -> Section:
    pictures = _pictures(source, results, alpha_figures)
    return Section(
        "coefficients", "Adaptive coefficients, means while the specimen moves", (), (*_some(tables, 2), *pictures)
    )


def _other_methods(source: Source, results: SubstructureResults, tables: list[Table]) -> Section:
    pictures = _pictures(source, results, method_figures)
    return Section("other-methods", "Tests by other methods", (), (*_some(tables, 3), *pictures))


def _limits(results: SubstructureResults) -> Section:
    table = replace(limits_table(results), title="")
    if not table.rows and results.runs:
        return Section("limits", LIMITS, (), (Facts((("Limits", " ".join(table.notes)),)),))
    return Section("limits", LIMITS, (), (table,) if table.rows else ())


def _undetermined(results: SubstructureResults) -> Section:
    table = replace(undetermined_table(results), title="")
    return Section("undetermined", "Indicators that are not determined", (), (table,) if table.rows else ())
