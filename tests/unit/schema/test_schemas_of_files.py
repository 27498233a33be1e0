"""Schemas take every YAML file of the repository, and refuse what edesign refuses."""

from __future__ import annotations

import copy
import re
from dataclasses import replace
from typing import Any

import pytest
import schema_files as files
from every_building_key import EVERY_KEY
from jsonschema import Draft202012Validator

from edesign.damper.effects import LAW_EFFECTS
from edesign.damper.law import Law, Parameter
from edesign.damper.laws import LAWS
from edesign.damper.parameters import practical_unit, read_parameters
from edesign.errors import InputError
from edesign.schema.build import combined_schema
from edesign.schema.kinds import KINDS

_QUANTITY = re.compile(r"\s*[-+]?[0-9.]+(?:[eE][-+]?[0-9]+)?\s*[A-Za-z%].*")
_WITH_CHECKS_ELSEWHERE = ("parameters", "values", "temperature_law", "standard_errors")
"""Keys below which models take anything: laws, effects and studies read it when they are resolved."""


@pytest.mark.parametrize("name", KINDS)
def test_schemas_are_right_by_the_draft(name: str) -> None:
    schema = files.validator(name).schema
    Draft202012Validator.check_schema(schema)
    assert schema["additionalProperties"] is False


def test_all_files_of_the_repository_satisfy_the_schema_of_their_kind() -> None:
    Draft202012Validator.check_schema(combined_schema())
    seen = set()
    for path in files.yaml_files():
        if path.name in files.WITHOUT_KIND:
            continue
        data = files.plain(path.read_text(encoding="utf-8"))
        name = files.kind_of(data)
        assert name is not None, path
        seen.add(name)
        assert not [f"{path}: {error.json_path}: {error.message}" for error in files.validator(name).iter_errors(data)]
    assert seen | set(files.EXAMPLES) == set(KINDS)


def test_whole_files_in_the_documentation_satisfy_their_schema() -> None:
    found = 0
    for page, text in files.documented_files():
        data = files.plain(text)
        name = files.kind_of(data)
        assert name is not None, page
        errors = [f"{page}: {error.json_path}: {error.message}" for error in files.validator(name).iter_errors(data)]
        assert not errors
        found += 1
    assert found >= 4


def test_the_recommended_national_values_satisfy_the_schema() -> None:
    path = files.ROOT / "edesign" / "codes" / "ec8" / "data" / "recommended.yaml"
    assert files.validator("national").is_valid(files.plain(path.read_text(encoding="utf-8")))


def test_a_building_with_every_key_satisfies_its_schema() -> None:
    assert not list(files.validator("building").iter_errors(files.plain(EVERY_KEY)))


@pytest.mark.parametrize("name", KINDS)
def test_examples_are_taken_by_schema_and_model(name: str) -> None:
    data = files.example(name)
    assert files.kind_of(data) == name
    assert not list(files.validator(name).iter_errors(data))
    assert files.model_takes(name, data)


@pytest.mark.parametrize("name", KINDS)
def test_a_misspelt_key_is_refused_by_schema_and_model(name: str) -> None:
    data = files.example(name)
    blocks = [(), *(keys for keys in files.places(data) if isinstance(files.at(data, keys), dict))]
    checked = 0
    for keys in blocks:
        if any(key in _WITH_CHECKS_ELSEWHERE for key in keys):
            continue
        for key in files.at(data, keys):
            wrong = _changed(data, keys, lambda block, key=key: {**_without(block, key), f"{key}_": block[key]})
            if files.model_takes(name, wrong):
                continue  # a name of the user's own
            assert not files.validator(name).is_valid(wrong), (keys, key)
            checked += 1
    assert checked >= 2


@pytest.mark.parametrize("name", KINDS)
def test_a_missing_key_is_refused_as_by_the_model(name: str) -> None:
    data = files.example(name)
    blocks = [(), *(keys for keys in files.places(data) if isinstance(files.at(data, keys), dict))]
    refused = 0
    for keys in blocks:
        if any(key in _WITH_CHECKS_ELSEWHERE for key in keys):
            continue
        for key in files.at(data, keys):
            wrong = _changed(data, keys, lambda block, key=key: _without(block, key))
            taken = files.model_takes(name, wrong)
            refused += not taken
            assert files.validator(name).is_valid(wrong) == taken, (keys, key)
    assert refused >= 1 or name == "national"  # of which every key may be left out


@pytest.mark.parametrize("name", KINDS)
def test_another_dimension_is_refused_as_by_the_model(name: str) -> None:
    data = files.example(name)
    for keys in files.places(data):
        value = files.at(data, keys)
        if not isinstance(value, str) or not _QUANTITY.fullmatch(value):
            continue
        for other in ("3 mol", 3, "3 m s", "m"):
            wrong = _changed(data, keys, lambda _, other=other: other)
            taken = files.model_takes(name, wrong)
            if taken and any(key in _WITH_CHECKS_ELSEWHERE for key in keys):
                continue
            assert files.validator(name).is_valid(wrong) == taken, (keys, other)


@pytest.mark.parametrize(
    "parameters",
    [
        {"c": "50 kN*(s/m)^0.5"},
        {"c": "50 kN*(s/m)^0.5", "alpha": 0.5, "k": "1 kN/mm"},
        {"c": "50 kN*(s/m)^0.5", "alpha": -0.5},
        {"c": 50, "alpha": 0.5},
        "thesis_table_4_2",
    ],
)
def test_parameters_of_another_law_are_refused(parameters: Any) -> None:
    law = files.validator("law")
    assert law.is_valid({"type": "viscous_power", "parameters": {"c": "50 kN*(s/m)^0.5", "alpha": 0.5}})
    assert law.is_valid({"type": "mgmm", "parameters": "thesis_table_4_2"})
    assert law.is_valid(
        {"type": "generalised_maxwell", "parameters": {"k0": "1 kN/mm", "k": ["1 kN/mm"], "c": ["1 kN*s/m"]}}
    )
    assert not law.is_valid({"type": "viscous_power", "parameters": parameters})


def test_parameters_are_taken_as_they_are_read() -> None:
    """Of each law and effect a parameter is changed at a time: what edesign reads the schema does not refuse."""
    definitions = files.validator("law").schema["$defs"]
    refused = 0
    for name, law in (*LAWS.items(), *LAW_EFFECTS.items()):
        place = f"#/$defs/parameters_of_{name if isinstance(name, str) else '_'.join(name)}"
        schema = Draft202012Validator({"$ref": place, "$defs": definitions})
        parameters = [*law.parameters, *(replace(one, name=f"{one.name}1") for one in law.branch)]
        right = {one.name: _value(one) for one in parameters}
        for one in parameters:
            unit = practical_unit(one) if one.unit else ""
            for value in (right[one.name], f"-2 {unit}", f"0 {unit}", 0.5, 0, True, [1], "50 %", "1 mol"):
                changed: dict[str, Any] = {**right, one.name: value}
                taken = schema.is_valid(changed)
                refused += not taken
                assert taken or not _is_read(law, changed), (name, one.name, value)
    assert refused > 200


def _value(parameter: Parameter) -> Any:
    """A value that a parameter may have."""
    if parameter.unit:
        return "20 degC" if parameter.unit == "degC" else f"1.5 {practical_unit(parameter)}"
    if parameter.default is not None:
        return parameter.default
    low = max(parameter.lower, 0.0)
    return 0.5 * (low + min(parameter.upper, low + 2.0))


def _is_read(law: Law, values: dict[str, Any]) -> bool:
    try:
        read_parameters(law, values)
    except InputError:
        return False
    return True


def _without(block: Any, key: str) -> Any:
    return {other: of for other, of in block.items() if other != key}


def _changed(data: Any, keys: tuple[str | int, ...], change: Any) -> Any:
    """A copy of data with another value at a place."""
    found = copy.deepcopy(data)
    if not keys:
        return change(found)
    files.at(found, keys[:-1])[keys[-1]] = change(files.at(found, keys))
    return found
