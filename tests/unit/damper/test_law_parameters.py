"""The core has the parameters of laws and effects as edesign/damper/laws.py and effect_forms.py have them."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from edesign.core import CoreError
from edesign.core.damper import CoreDamper, EffectValues, effect_number, law_number
from edesign.damper.effect_forms import parameters_in_core
from edesign.damper.law import Law, Parameter
from edesign.damper.laws import LAWS
from tools.law_parameters import Entry, _pair, sources

PUBLIC = (Path(__file__).parents[3] / "core_c" / "include" / "eddamper.h").read_text(encoding="utf-8")
LAW_EFFECTS = parameters_in_core()
SOURCES = sources()


@pytest.mark.parametrize("path", SOURCES, ids=lambda path: path.name)
def test_file_of_the_core_is_of_these_tables(path: Path) -> None:
    assert path.read_text(encoding="utf-8") == SOURCES[path], "run `python -m tools.law_parameters` and build again"


def test_the_core_has_these_laws_and_no_other() -> None:
    numbers = re.findall(r"ED_LAW_(\w+) = (\d+)", PUBLIC)
    assert {name.lower(): int(number) for name, number in numbers} == {name: law_number(name) for name in LAWS}


def test_the_core_has_these_effects_and_no_other() -> None:
    numbers = {name.lower(): int(number) for name, number in re.findall(r"ED_EFFECT_(\w+) = (\d+)", PUBLIC)}
    assert numbers == {name.replace(".", "_"): effect_number(name) for name in LAW_EFFECTS}


@pytest.mark.parametrize("name", LAWS)
def test_public_header_names_the_parameters_in_their_order(name: str) -> None:
    law = LAWS[name]
    first, _, rest = _comment(f"ED_LAW_{name.upper()}").partition(", then ")
    assert re.split(r"[:(]", first)[0].split() == [parameter.name for parameter in law.parameters]
    assert bool(rest) == bool(law.branch)
    assert rest.split()[: len(law.branch)] == [f"{parameter.name}_i" for parameter in law.branch]


@pytest.mark.parametrize("name", LAW_EFFECTS)
def test_public_header_names_the_parameters_of_effects(name: str) -> None:
    comment = _comment(f"ED_EFFECT_{name.replace('.', '_').upper()}").replace("(1, -1)", "")
    assert comment.partition(":")[0].split() == [parameter.name for parameter in LAW_EFFECTS[name]]


def _comment(name: str) -> str:
    (comment,) = re.findall(rf"{name} = \d+,?\s*/\* (.*?) \*/", PUBLIC)
    return comment


def _beyond(parameter: Parameter) -> list[float]:
    """Values that the bounds of a parameter refuse."""
    found = [float("nan"), float("inf")]
    if parameter.lower > float("-inf"):
        found += [parameter.lower - 1.0] if parameter.lower_allowed else [parameter.lower]
    if parameter.upper < float("inf"):
        found += [parameter.upper + 1.0] if parameter.upper_allowed else [parameter.upper]
    return [*found, 0.5] if parameter.choices else found


def _within(parameter: Parameter) -> float:
    if parameter.choices:
        return parameter.choices[-1]
    lower, upper = max(parameter.lower, 0.25), min(parameter.upper, 4.0)
    return 0.5 * (lower + upper)


@pytest.mark.parametrize("name", LAW_EFFECTS)
def test_the_core_refuses_parameters_of_effects_beyond_their_bounds(name: str) -> None:
    parameters = LAW_EFFECTS[name]
    good = [_within(parameter) for parameter in parameters]
    CoreDamper("viscous", [1.0], effects=[EffectValues(name, tuple(good))])
    for i, parameter in enumerate(parameters):
        for value in _beyond(parameter):
            values = tuple([*good[:i], value, *good[i + 1 :]])
            with pytest.raises(CoreError, match=rf"effect {name}: {parameter.name} = \S+ is not allowed: "):
                CoreDamper("viscous", [1.0], effects=[EffectValues(name, values)])
    with pytest.raises(CoreError, match=f"effect {name}: number of parameters = {len(good) + 1} is not allowed"):
        CoreDamper("viscous", [1.0], effects=[EffectValues(name, (*good, 1.0))])


@pytest.mark.parametrize("law", [law for law in LAWS.values() if any(one.choices for one in law.parameters)])
def test_the_core_names_the_values_of_a_switch(law: Law) -> None:
    values = [_within(parameter) for parameter in law.parameters]
    CoreDamper(law.name, values)
    for i, parameter in enumerate(law.parameters):
        if parameter.choices:
            assert not parameter.allows(0.5)
            with pytest.raises(CoreError, match=f"{parameter.name} = 0.5 is not allowed: {parameter.allowed}"):
                CoreDamper(law.name, [*values[:i], 0.5, *values[i + 1 :]])


def test_names_that_an_enum_cannot_distinguish_are_refused() -> None:
    two = Entry((Parameter("a", "of one thing", ""), Parameter("A", "of another", "")))
    with pytest.raises(ValueError, match="ED_LAW_X: names of parameters differ by the case of letters alone: A, A"):
        _pair("law", "laws", "laws.py", {"ED_LAW_X": two})
