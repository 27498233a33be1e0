"""YAML files of every kind for tests of schemas, and how files are judged by schema and by edesign."""

from __future__ import annotations

import re
from collections.abc import Iterator
from functools import cache
from pathlib import Path
from typing import Any

import yaml
from jsonschema import Draft202012Validator
from pydantic import ValidationError

from edesign.project.reading.yaml_nodes import parse
from edesign.schema.build import combined_schema, schema_of
from edesign.schema.kinds import KINDS, model_of

ROOT = Path(__file__).parents[3]
WITHOUT_KIND = (
    "templates.yaml",
    "parameter_sets.yaml",
    "recommended.yaml",
    "parameters.yaml",
    "prose.yaml",
    "strd.yaml",
)
"""Data of the package and its tests that no user writes; the recommended values and those of NTC 2018 have no zones."""

EXAMPLES = {
    "campaign": """\
title: Damper A
specimen: {name: A, layers: 2, layer_area: 41400 mm^2, layer_thickness_mm: 12}
law: {type: mgmm, parameters: thesis_table_4_2, refit: false, extremes: fresh}
start: at_rest
start_ramp: 5 ms
tests:
  - {file: a.csv, temperature: 20 degC}
  - {file: b.csv, temperature_C: 25, use: validate, title: b}
""",
    "programme": """\
specimen: {layers: 2, layer_area: 41400 mm^2, layer_thickness: 12 mm}
law:
  type: viscous_power
  parameters: {c: 50 kN*(s/m)^0.5, alpha: 0.5}
  effects: [{name: payne, form: whole, parameters: {d: 0.2, a0: 3 mm, m: 1, tau_a: 5 s}}]
sampling_rate: 500 Hz
noise: {force: 1 %, seed: 3}
tests:
  - {type: sine, strain: [10 %, 0.2], frequency: [0.5 Hz, 1 Hz], temperature: 20 degC}
  - {type: sweep, displacement: 12 mm, frequency: 1 Hz, temperature_C: [20, 25]}
  - {type: random, strain: 0.3, band: [0.1 Hz, 5 Hz], duration: 30 s, seed: 1, level: rms}
  - {type: record, file: motion.csv}
""",
    "structure_campaign": """\
title: Test building
structure:
  base: isolated
  floor_masses: [20 t, 20 t]
  storey_stiffness: [30 MN/m]
  storey_heights: [3 m]
  storey_dashpots: [10 kN*s/m]
  damping: {type: rayleigh, ratio: 2 %, modes: [1, 2]}
law: {type: kelvin_voigt, parameters: {k: 2 kN/mm, c: 100 kN*s/m}}
channels:
  time: t
  base_acceleration: a0
  floor_accelerations: [a1, null]
  floor_displacements: [null, d2]
  units: {time: s, acceleration: g, displacement: mm}
tests: [{file: a.csv}, {file: b.csv, use: validate}]
""",
}


def lists(value: Any) -> Any:
    """Plain data with lists in place of tuples, as a schema wants it."""
    if isinstance(value, dict):
        return {key: lists(of) for key, of in value.items()}
    return [lists(of) for of in value] if isinstance(value, (list, tuple)) else value


def plain(text: str) -> Any:
    """The data of a YAML text, as edesign reads it."""
    return lists(parse(text)[0].plain())


@cache
def validator(name: str) -> Draft202012Validator:
    """The validator of a kind of file."""
    return Draft202012Validator(schema_of(KINDS[name]))


def kind_of(data: Any) -> str | None:
    """The kind that the combined schema sends a file to; None: none."""
    node = combined_schema()
    while "if" in node:
        if Draft202012Validator(node["if"]).is_valid(data):
            return str(node["then"]["$ref"]).removesuffix(".schema.json")
        node = node["else"]
    return None


def model_takes(name: str, data: Any) -> bool:
    """Whether the model of a kind of file takes data, without the checks between its parts."""
    try:
        model_of(KINDS[name]).model_validate(_tuples(data))
    except ValidationError:
        return False
    return all(data.get(key) is not None for key in KINDS[name].needed)


def _tuples(value: Any) -> Any:
    if isinstance(value, dict):
        return {key: _tuples(of) for key, of in value.items()}
    return tuple(_tuples(of) for of in value) if isinstance(value, list) else value


def yaml_files() -> Iterator[Path]:
    """All YAML files of the repository."""
    for folder in ("projects", "tests", "edesign"):
        yield from sorted((ROOT / folder).rglob("*.yaml"))


def documented_files() -> Iterator[tuple[str, str]]:
    """Whole files in pages of the documentation: blocks of YAML that begin with the version of a format."""
    for page in sorted((ROOT / "docs").rglob("*.md")):
        for text in re.findall(
            r"^```yaml[^\n]*\n(.*?)^```", page.read_text(encoding="utf-8"), re.MULTILINE | re.DOTALL
        ):
            if re.match(r"edesign(_\w+)?: 1\b", text):
                yield page.name, text


def example(name: str) -> Any:
    """The data of a right file of a kind, the smallest of the repository."""
    if name in EXAMPLES:
        return yaml.safe_load(EXAMPLES[name])
    found = [data for path in yaml_files() if kind_of(data := plain(path.read_text(encoding="utf-8"))) == name]
    return min(found, key=lambda data: len(str(data)))


def places(value: Any, keys: tuple[str | int, ...] = ()) -> Iterator[tuple[str | int, ...]]:
    """The keys of all values below one."""
    children = value.items() if isinstance(value, dict) else enumerate(value) if isinstance(value, list) else ()
    for key, child in children:
        yield (*keys, key)
        yield from places(child, (*keys, key))


def at(data: Any, keys: tuple[str | int, ...]) -> Any:
    """The value at a place."""
    for key in keys:
        data = data[key]
    return data
