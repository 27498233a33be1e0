"""The effects that a calibration knows, as tables: all of them, or the forms and parameters of one."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from edesign.archive.csv_files import Cell, write_csv_file
from edesign.calibration.effect_list import KnownEffect, KnownForm, KnownParameter
from edesign.damper.law import Parameter
from edesign.damper.parameters import practical_unit
from edesign.report.tables.cell import Verdict
from edesign.report.tables.column import count, text, verdict
from edesign.report.tables.table import Row, Table, TableSpec


def _placements(form: KnownForm) -> str | None:
    return ", ".join(form.placements) or None


def _parameters(form: KnownForm) -> str | None:
    return ", ".join(f"{one.name} [{_unit(one)}]" for one in form.parameters) or None


EFFECTS = TableSpec[KnownEffect](
    "known_effects",
    "Effects in {tests}",
    (
        text("effect", "name"),
        text("of", lambda effect: " or ".join(filter(None, (effect.kind, effect.or_kind)))),
        text("what", lambda effect: effect.forms[0].title, broken=1),
        count("forms", lambda effect: len(effect.forms)),
    ),
    keys=3,
    named_by_title=True,
)
FORMS = TableSpec[KnownForm](
    "forms_of_effect",
    "{effect}: forms, in {tests}",
    (
        text("form"),
        text("what", "title", broken=1),
        text("acts on", _placements, broken=2),
        text("parameters", _parameters, broken=3),
        verdict("law file", lambda form: Verdict("yes", "good") if form.in_law_files else None),
    ),
    notes=("law file: whether law files and projects carry it (`effects`) if it is of the damper; all can be found",),
    keys=5,
    named_by_title=True,
)
PARAMETERS = TableSpec[Row](
    "parameters_of_effect",
    "{effect}: parameters",
    (text("form"), text("parameter"), text("unit"), text("meaning", broken=1)),
    keys=4,
    named_by_title=True,
)


def effects_tables(effects: tuple[KnownEffect, ...]) -> list[Table]:
    """Return a table of effects for each kind of tests."""
    kinds = dict.fromkeys(effect.tests for effect in effects)
    tables = [EFFECTS.of((effect for effect in effects if effect.tests == tests), tests=tests) for tests in kinds]
    tables[-1].notes.append("what: of the first form; forms: how many equations are tried for it")
    tables[-1].notes.append("`edesign effects NAME` lists its forms, their parameters, its signature and its sources.")
    return tables


def effect_tables(effect: KnownEffect) -> list[Table]:
    """Return the forms of an effect with their parameters, and what those mean."""
    sources = dict.fromkeys(source for form in effect.forms for source in form.source.split("; "))
    notes = (f"signature: {effect.signature}", f"source: {'; '.join(sources)}", f"page: {effect.page}")
    rows = [(form.form, one.name, _unit(one), one.meaning) for form in effect.forms for one in form.parameters]
    forms = FORMS.of(effect.forms, notes=notes, effect=effect.name, tests=effect.tests)
    return [forms, PARAMETERS.of(rows, effect=effect.name)] if rows else [forms]


def effects_data(effects: tuple[KnownEffect, ...]) -> list[dict[str, Any]]:
    """Return effects as plain data, units in SI."""
    return [
        {
            "name": effect.name,
            "tests": effect.tests,
            "kind": effect.kind,
            "or_kind": effect.or_kind,
            "signature": effect.signature,
            "page": effect.page,
            "forms": [_form(form) for form in effect.forms],
        }
        for effect in effects
    ]


def write_effects_csv(effects: tuple[KnownEffect, ...], path: Path) -> None:
    """Write a line for each parameter of each form.

    Raises:
        ArchiveError: it cannot be written.
    """
    rows: list[list[Cell]] = [
        [effect.name, effect.tests, effect.kind, form.form, form.title, form.in_law_files, one.name, one.unit]
        for effect in effects
        for form in effect.forms
        for one in form.parameters or (KnownParameter("", ""),)
    ]
    write_csv_file(["effect", "tests", "of", "form", "what", "law_file", "parameter", "unit"], rows, path)


def _form(form: KnownForm) -> dict[str, Any]:
    return {
        "form": form.form,
        "title": form.title,
        "placements": list(form.placements),
        "laws": list(form.laws),
        "law_file": form.in_law_files,
        "source": form.source,
        "parameters": [{"name": one.name, "unit": one.unit, "meaning": one.meaning} for one in form.parameters],
    }


def _unit(parameter: KnownParameter) -> str:
    return practical_unit(Parameter(parameter.name, "", parameter.unit)) or "-"
