"""The laws of the dampers with the values of all their parameters, as the analyses take them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

from edesign.damper.law import Law
from edesign.damper.laws import LAWS
from edesign.damper.parameters import DASHPOTS, coefficient_in_words, write_parameters
from edesign.frame.devices import DeviceLaw
from edesign.project.analysis_file import AnalysisFile
from edesign.project.dampers.dampers import DamperLaw
from edesign.report.inputs.variant_frames import VariantFrames
from edesign.report.tables.column import formula, text
from edesign.report.tables.number import SCIENTIFIC, significant
from edesign.report.tables.table import Row, Table, TableSpec
from edesign.report.tables.unit import MM, MM2
from edesign.study.analysis.dampers import device_laws

DIGITS = 5
_OWN = "thesis"  # how sources begin that say nothing to those who have not this work

PARAMETERS = TableSpec[Row](
    "law_in_analyses",
    "Law {law}{of}: {title}{at}",
    (formula("parameter"), formula("value"), text("meaning", broken=1)),
    keys=3,
    named_by_title=True,
)


def law_tables(frames: VariantFrames) -> list[Table]:
    """Return the parameters of each law that some damper has; of variants with other values each its own table.

    Raises:
        InputError: a law cannot be read, as its file is not at hand.
    """
    alike: dict[tuple[str, DeviceLaw, float | None], dict[str, float]] = {}
    for variant in frames.variants:
        project = frames.project(variant)
        if project.dampers is None:
            continue
        laws = device_laws(project)
        for name in laws:
            if name in project.dampers.used_laws:
                key = (name, replace(laws[name], property_factor=1.0), project.dampers.laws[name].temperature)
                alike.setdefault(key, {})[variant] = laws[name].property_factor
    several = [name for name, _, _ in alike]
    tables = []
    for (name, values, temperature), variants in alike.items():
        project = frames.project(next(iter(variants)))
        of = f", {', '.join(variants)}" if several.count(name) > 1 else ""
        table = _table(name, values, temperature, project, of)
        table.notes += _factors(variants)
        tables.append(table)
    return tables


def _table(name: str, values: DeviceLaw, temperature: float | None, project: AnalysisFile, of: str) -> Table:
    assert project.dampers is not None
    law, spec = LAWS[values.law.law], project.dampers.laws[name]
    branches = (len(values.law.values) - len(law.parameters)) // len(law.branch) if law.branch else 0
    parameters = law.with_branches(branches)
    by_name = dict(zip((p.name for p in parameters), values.law.values, strict=True))
    written = write_parameters(law, by_name)
    rows: list[Row] = []
    for parameter in parameters:
        value, _, unit = written[parameter.name].partition(" ")
        text = f"{_short(value)} {unit}".strip()
        if law.name in DASHPOTS and parameter.name == "c":
            text = coefficient_in_words(by_name["c"], by_name.get("alpha", 1.0))
        rows.append((parameter.name, text, parameter.meaning))
    at = "" if temperature is None else f" at {temperature:g} °C"
    return PARAMETERS.of(rows, notes=_notes(law, values, spec), law=name, of=of, title=law.title, at=at)


def _factors(variants: Mapping[str, float]) -> list[str]:
    """What the forces are multiplied by, and in which variants."""
    found: dict[float, list[str]] = {}
    for variant, factor in variants.items():
        if factor != 1.0:
            found.setdefault(factor, []).append(variant)
    whose = {factor: f" in {', '.join(names)}" if len(variants) > 1 else "" for factor, names in found.items()}
    return [f"All forces are multiplied by the property factor {factor:g}{of}." for factor, of in whose.items()]


def _short(value: str) -> str:
    try:
        number_of = float(value)
    except ValueError:
        return value
    return f"{number_of:.0f}" if 10.0**DIGITS <= abs(number_of) < SCIENTIFIC else f"{number_of:.{DIGITS}g}"


def _notes(law: Law, values: DeviceLaw, spec: DamperLaw) -> list[str]:
    sources = [part for part in law.source.split("; ") if not part.startswith(_OWN)]
    notes = [f"Equation: {law.equation}" + (f" ({'; '.join(sources)})" if sources else "")]
    if values.layers is not None and values.layer_area is not None and values.layer_thickness is not None:
        layers = f"{values.layers} layer{'s' * (values.layers > 1)}"
        size = f"{significant(values.layer_area / MM2.si)} mm2, {significant(values.layer_thickness / MM.si)} mm thick"
        notes.append(f"The parameters belong to a damper of {layers} of {size}.")
    if values.tested_strain is not None:
        notes.append(f"They come from tests up to a shear strain of {100.0 * values.tested_strain:g} %.")
    for effect in values.law.effects:
        numbers = ", ".join(f"{value:.{DIGITS}g}" for value in effect.values)
        place = "" if effect.placement == "whole" else f" ({effect.placement})"
        notes.append(f"Effect {effect.name.replace('_', ' ').replace('.', ', ')}{place}: {numbers} (SI units).")
    if spec.file is not None:
        notes.append(f"The law stands in the file {spec.file}.")
    return notes
