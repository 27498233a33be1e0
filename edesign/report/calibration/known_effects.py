"""The effects that a calibration knows, as tables: all of them, or the forms and parameters of one."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from edesign.archive.csv_files import Cell, write_csv_file
from edesign.calibration.effect_list import KnownEffect, KnownForm, KnownParameter
from edesign.damper.law import Parameter
from edesign.damper.parameters import practical_unit
from edesign.report.tables.table import Table


def effects_tables(effects: tuple[KnownEffect, ...]) -> list[Table]:
    """Return a table of effects for each kind of tests."""
    tables: list[Table] = []
    for tests in dict.fromkeys(effect.tests for effect in effects):
        own = [effect for effect in effects if effect.tests == tests]
        rows = [[one.name, one.kind, one.forms[0].title, str(len(one.forms))] for one in own]
        tables.append(Table(f"Effects in {tests}", ("effect", "of", "what", "forms"), rows, left=3, sentences=2))
    tables[-1].notes.append("what: of the first form; forms: how many equations are tried for it")
    tables[-1].notes.append("`edesign effects NAME` tells its forms, their parameters, its signature and its sources.")
    return tables


def effect_tables(effect: KnownEffect) -> list[Table]:
    """Return the forms of an effect with their parameters, and what those mean."""
    columns = ("form", "what", "acts on", "parameters", "law file")
    forms = Table(f"{effect.name}: forms, in {effect.tests}", columns, left=5, sentences=(1, 2, 3))
    forms.rows = [
        [
            form.form,
            form.title,
            ", ".join(form.placements) or "-",
            ", ".join(f"{one.name} [{_unit(one)}]" for one in form.parameters) or "-",
            "yes" if form.in_law_files else "-",
        ]
        for form in effect.forms
    ]
    sources = dict.fromkeys(source for form in effect.forms for source in form.source.split("; "))
    forms.notes = [
        "law file: whether law files and projects carry it (`effects`); all can be found",
        f"signature: {effect.signature}",
        f"source: {'; '.join(sources)}",
        f"page: {effect.page}",
    ]
    parameters = Table(f"{effect.name}: parameters", ("form", "parameter", "unit", "meaning"), left=4)
    parameters.sentences = 3
    parameters.rows = [
        [form.form, one.name, _unit(one), one.meaning] for form in effect.forms for one in form.parameters
    ]
    return [forms, parameters] if parameters.rows else [forms]


def effects_data(effects: tuple[KnownEffect, ...]) -> list[dict[str, Any]]:
    """Return effects as plain data, units in SI."""
    return [
        {
            "name": effect.name,
            "tests": effect.tests,
            "kind": effect.kind,
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
