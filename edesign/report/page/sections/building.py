"""The sections of a building: verdict, assumptions, warnings, structure, action, storeys, members, checks, rules."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable
from dataclasses import replace
from functools import partial

from edesign.codes.building_rules import BuildingRules
from edesign.project.notation.units import STANDARD_GRAVITY
from edesign.report.building.assumptions import building_assumption_rows
from edesign.report.building.checks import effects_table, worked_table, worked_worst
from edesign.report.building.code_in_use import in_code, rules_in_use
from edesign.report.building.facts import building_rows, design_rows
from edesign.report.building.figures.curves import mode_shapes, spectra, storey_curves
from edesign.report.building.figures.elevations import elevations
from edesign.report.building.figures.force_diagrams import force_diagrams
from edesign.report.building.figures.model_figures import archived_building_model
from edesign.report.building.results import BuildingResults
from edesign.report.building.tables.all import (
    base_shear_table,
    criteria_table,
    failures,
    groups_table,
    modes_table,
    or_missing,
    remarks,
    storeys_table,
    worst_of_groups,
)
from edesign.report.building.tables.basis import (
    floors_table,
    joints_table,
    materials_table,
    overstrength_table,
    selection_table,
)
from edesign.report.building.tables.checks import check_words, group_checks_table
from edesign.report.building.tables.combinations import combinations_table, sway_table
from edesign.report.building.tables.deflections import deflection_table
from edesign.report.building.tables.foundations import foundation_table, persistent_table, reaction_table
from edesign.report.building.tables.lateral import drifts_table, lateral_cases_table
from edesign.report.building.tables.links import link_details_table, links_table
from edesign.report.building.tables.other import other_tables
from edesign.report.building.tables.steel_list import beside_table, doublers_table, every_member_table, steel_list_table
from edesign.report.drawing.captions import plain
from edesign.report.html.section import Facts, Folded, Headline, Headlines, Part, Section, Warnings, made
from edesign.report.page.project_facts import hazard_rows
from edesign.report.page.sections.warnings import NONE, warning_table
from edesign.report.page.source import Source, first_of_each
from edesign.report.page.step import SHARES, steps
from edesign.report.tables.table import Table
from edesign.space.structure.frame import AXES

Parts = Callable[[Source, BuildingResults], Iterable[Part]]


def building_sections(source: Source) -> list[Section]:
    """Return the sections of a building. What cannot be read of it is named in the first."""
    results = BuildingResults(source.archive)
    results.group()
    missing: list[str] = []
    sections = []
    for which, step in zip(
        _SECTIONS, steps([anchor if anchor in SHARES else title for anchor, title, _ in _SECTIONS]), strict=True
    ):
        source.begin(step)
        sections.append(made(which[1], partial(_section, source, results, missing, *which)))
    first, *others = sections
    lost = [Warnings("What cannot be read of the archive", tuple(missing))] if missing else []
    first = Section(first.id, first.title, first.intro, (*lost, *first.parts))
    return [section for section in (first, *others) if section]


def _section(
    source: Source, results: BuildingResults, missing: list[str], anchor: str, title: str, makers: tuple[Parts, ...]
) -> Section:
    parts: list[Part] = []
    for make in makers:
        with or_missing(missing):
            parts += list(make(source, results))
    rules = rules_in_use(results)
    return Section(anchor, title, (), tuple(_in_code(part, rules) for part in parts if _shown(part)))


def _in_code(part: Part, rules: BuildingRules) -> Part:
    """Return a part whose tables are in the words of the seismic code."""
    if isinstance(part, Table):
        return in_code(part, rules)
    if isinstance(part, Folded):
        inner = tuple(in_code(of, rules) if isinstance(of, Table) else of for of in part.parts)
        return replace(part, parts=inner)
    return part


def _shown(part: Part) -> bool:
    return not isinstance(part, Table) or _filled(part)


def _filled(table: Table) -> bool:
    return bool(table.rows) or not table.columns and bool(table.notes)


def _verdict(source: Source, results: BuildingResults) -> Iterable[Part]:
    worst = max(worst_of_groups(results), key=lambda of: -1.0 if math.isnan(of.utilisation) else of.utilisation)
    mass, met, broken = results.number("mass_kg"), bool(results.number("passed")), failures(results)
    period = plain(float(results.values("modes", "period")[0]))
    tiles = [
        Headline("met" if met else "not met", "Checks and rules", f"{len(broken)} not met", _state(met)),
        Headline(
            f"{worst.utilisation:.3f}",
            "Largest utilisation",
            f"{worst.member}, {worst.section}: {check_words(worst.name)}",
            _state(worst.utilisation <= 1.0),
        ),
        Headline(f"{period}\N{NO-BREAK SPACE}s", "First period", f"mass {plain(mass / 1e3, 4)} t"),
    ]
    for axis in AXES:
        shear = results.number(f"base_shear_{axis}_N")
        detail = f"{100 * shear / (mass * STANDARD_GRAVITY):.1f} % of the weight, q = {results.number(f'q_{axis}'):g}"
        value = f"{shear / 1e3:.0f}\N{NO-BREAK SPACE}kN"
        tiles.append(Headline(value, f"Base shear along {axis}", detail))
    parts: list[Part] = [Headlines(tuple(tiles))]
    parts += [Warnings("Not met", tuple(broken))] if broken else []
    return parts


def _state(met: bool) -> str:
    return "good" if met else "bad"


def _structure(source: Source, results: BuildingResults) -> Iterable[Part]:
    building = source.building
    if building is not None:
        yield Facts(tuple(building_rows(building)), formulas=True)
        if building.design is not None:
            with source.or_left_out("the settings of the design"):
                yield Facts(tuple(design_rows(building, results)), formulas=True)


def _model(source: Source, results: BuildingResults) -> Iterable[Part]:
    return first_of_each(source.pictures(archived_building_model))


def _assumptions(source: Source, results: BuildingResults) -> Iterable[Part]:
    if source.building is not None:
        yield Facts(tuple(building_assumption_rows(source.building)))


def _warnings(source: Source, results: BuildingResults) -> Iterable[Part]:
    """Warnings of the check about the input, and what the design has to say of its results."""
    table = warning_table(source)
    table.rows += [["results", f"{text[:1].upper()}{text[1:]}"] for text in remarks(results)]
    yield table if table.rows else Facts((("Warnings", NONE),))


def _diagrams(source: Source, results: BuildingResults) -> Iterable[Part]:
    pictures = source.pictures(force_diagrams)
    if pictures:
        yield Folded(f"Axial force, shear and moment of the frames ({len(pictures)})", pictures)


def _every_member(source: Source, results: BuildingResults) -> Iterable[Part]:
    table = every_member_table(results)
    yield Folded(f"{table.title} ({len(table.rows)})", (table,))


def _checks(source: Source, results: BuildingResults) -> Iterable[Part]:
    table = group_checks_table(results)
    yield Folded(f"{table.title} ({len(table.rows)})", (table,))


def _action(source: Source, results: BuildingResults) -> Iterable[Part]:
    building = source.building
    if building is not None and building.hazard is not None:
        yield Facts(tuple(hazard_rows(building.hazard)))
    yield base_shear_table(results)


def _worked(source: Source, results: BuildingResults) -> Iterable[Part]:
    """The governing check of each group; nothing of those to which no check applies."""
    for worst, found in worked_worst(results):
        state = "" if worst.utilisation <= 1.0 else ", not met"
        name = check_words(worst.name)
        summary = f"{worst.group} {worst.section}: {name} {worst.utilisation:.3f}{state} ({worst.member})"
        yield Folded(summary, (effects_table(results, worst.number, worst.check), worked_table(found)))


def _others(source: Source, results: BuildingResults) -> Iterable[Part]:
    return [Folded(f"{table.title} ({len(table.rows)})", (table,)) for table in other_tables(results)]


def _pictures(maker: Callable[..., object]) -> Parts:
    return lambda source, results: source.pictures(maker)  # type: ignore[arg-type]


def _table(make: Callable[[BuildingResults], Table]) -> Parts:
    return lambda source, results: [make(results)]


_SECTIONS: tuple[tuple[str, str, tuple[Parts, ...]], ...] = (
    ("building", "Verdict", (_verdict,)),
    ("model", "The model", (_model,)),
    ("assumptions", "Assumptions and limits", (_assumptions,)),
    ("warnings", "Warnings", (_warnings,)),
    ("structure", "Structure and loads", (_structure, _table(materials_table), _table(floors_table))),
    ("action", "Seismic action", (_action, _pictures(spectra))),
    ("natural-modes", "Natural modes", (_pictures(mode_shapes), _table(modes_table))),
    (
        "storeys",
        "Storeys",
        (
            _pictures(storey_curves),
            *(_table(partial(storeys_table, axis=axis)) for axis in AXES),
            _table(lateral_cases_table),
            _table(drifts_table),
        ),
    ),
    (
        "members",
        "Members",
        (
            _pictures(elevations),
            _table(partial(groups_table, say=check_words)),
            _table(selection_table),
            _worked,
            _diagrams,
            _every_member,
            _table(deflection_table),
        ),
    ),
    ("steel", "Steel list", (_table(steel_list_table), _table(beside_table), _table(doublers_table))),
    ("checks", "Checks of members", (_checks,)),
    (
        "capacity",
        "Rules and capacity design",
        tuple(map(_table, (criteria_table, links_table, link_details_table, overstrength_table, joints_table))),
    ),
    ("foundations", "Foundations", tuple(map(_table, (reaction_table, persistent_table, foundation_table)))),
    ("others", "Other results", (_others,)),
    ("combinations", "Combinations of actions", (_table(combinations_table), _table(sway_table))),
)
