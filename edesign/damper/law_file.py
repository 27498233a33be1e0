"""Law files: a damper law with its parameters, as `edesign fit` writes it and projects use it."""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path

from pydantic import ValidationError

from edesign.core import CoreError, LawValues
from edesign.core.damper import CoreDamper
from edesign.damper.effects import LawEffect, parameters_at
from edesign.damper.effects_file import EffectsError, read_effects
from edesign.damper.law import Law
from edesign.damper.laws import law
from edesign.damper.parameters import PARAMETER_SETS, ParameterError, read_parameters
from edesign.damper.temperature import REFERENCE_C, FerryShift, GammaT
from edesign.damper.temperature_file import TemperatureLaw
from edesign.errors import InputError
from edesign.project.dampers.dampers import LawDescription
from edesign.project.reading.explain import explain
from edesign.project.reading.problems import Keys, Problems, ProjectError, keys_text
from edesign.project.reading.yaml_file import check_model, read_yaml_file, yaml_text
from edesign.project.reading.yaml_nodes import Node, find

WHAT = "law file"
_RANGE_PERCENT = re.compile(r"\s*([0-9.]+)(?:\s*to\s*([0-9.]+))?\s*%\s*")
_RANGE_C = re.compile(r"\s*(-?[0-9.]+)(?:\s*to\s*(-?[0-9.]+))?\s*degC\s*")


@dataclass(frozen=True)
class ResolvedLaw:
    """A law as a file or a project describes it, at a temperature.

    Attributes:
        law: the law.
        values: all its parameters, SI units.
        effects: its effects.
        temperature_C: degC; None: that of the parameters.
        warnings: a temperature outside the range of tests or tables names that range.
    """

    law: Law
    values: dict[str, float]
    effects: tuple[LawEffect, ...]
    temperature_C: float | None
    warnings: tuple[str, ...]

    @property
    def for_core(self) -> LawValues:
        """The law as the core takes it."""
        effects = tuple(one.for_core(self.temperature_C) for one in self.effects)
        return LawValues(self.law.name, tuple(self.values.values()), effects)


@dataclass(frozen=True)
class Source:
    """Place of the description of a law, for messages.

    Attributes:
        path: of the file.
        root: the YAML tree of the file.
        keys: of the description in it; () in a law file.
    """

    path: Path
    root: Node
    keys: Keys = ()

    def refuse(self, keys: Keys, message: object) -> InputError:
        """Return an error at a key of the description.

        Args:
            keys: below that of the description.
            message: what is wrong.
        """
        whole = (*self.keys, *keys)
        mark = find(self.root, whole).mark
        return InputError(f"{self.path}:{mark.line}:{mark.column}: {keys_text(whole)}: {message}")


def read_law_file(path: Path, content: bytes | None = None) -> tuple[LawDescription, Source]:
    """Read a law file.

    Args:
        content: of the file, if it has been read.

    Returns:
        The law, and where its keys stand in the file.

    Raises:
        InputError: it cannot be read, or is wrong; the message has file, line, column and key.
    """
    text = yaml_text(read_yaml_file(path, WHAT) if content is None else content, path)
    description, problems = check_model(text, LawDescription, WHAT, "type: mgmm")
    if description is not None:
        for key in ("type", "parameters"):
            if getattr(description, key) is None:
                problems.under((), key, "this key is missing [E-KEY-02]")
    if description is None or problems.found:
        raise ProjectError(path, problems.found)
    return description, Source(path, problems.root)


def resolve(
    described: LawDescription, source: Source, temperature_C: float | None, asked: Source | None = None
) -> ResolvedLaw:
    """Return the law, its parameters and its effects at a temperature.

    Args:
        described: has type and parameters.
        source: for messages.
        temperature_C: degC; None: that of the parameters.
        asked: where the temperature is asked for; None: where the law stands.

    Raises:
        InputError: no such law or effect, wrong parameters, or no parameters at this temperature.
    """
    try:
        chosen = law(described.type or "")
    except InputError as error:
        raise source.refuse(("type",), error) from error
    try:
        values = read_parameters(chosen, described.parameters or {})
    except ParameterError as error:
        lines = [str(source.refuse(("parameters", name), message)) for name, message in error.problems]
        raise InputError("\n".join(lines)) from error
    except InputError as error:
        raise source.refuse(("parameters",), error) from error
    try:
        effects = read_effects(described.effects)
    except EffectsError as error:
        lines = [str(source.refuse(("effects", *keys), message)) for keys, message in error.problems]
        raise InputError("\n".join(lines)) from error
    warnings: tuple[str, ...] = ()
    if temperature_C is not None:
        change = _temperature_law(described, source)
        low, high = _tested_C(described) or (REFERENCE_C, REFERENCE_C)
        held_at = min(max(temperature_C, low), high)  # one set of parameters holds for all tests
        try:
            values, warnings = parameters_at(chosen, values, effects, temperature_C, change, held_at)
        except InputError as error:
            culprit = "temperature_law" if change is not None and chosen.name not in change.laws else "temperature"
            place = source if culprit == "temperature_law" else asked or source
            raise place.refuse((culprit,), error) from error
        warnings += _outside_tests(described, temperature_C)
    try:
        CoreDamper(chosen.name, list(values.values()))
    except CoreError as error:
        raise source.refuse(("parameters", *_culprit(described, str(error))), error) from error
    for i, one in enumerate(effects):
        try:
            CoreDamper(chosen.name, list(values.values()), effects=(one.for_core(temperature_C),))
        except CoreError as error:  # no such placement in this law
            key = "placement" if "placement" in described.effects[i].model_fields_set else "form"
            raise source.refuse(("effects", i, key), error) from error
    return ResolvedLaw(chosen, values, effects, temperature_C, warnings)


def _culprit(described: LawDescription, message: str) -> tuple[str, ...]:
    """The key of the parameter that a message of the core begins with, as it is given; () where that is not known."""
    match = re.match(r"(\w+?)(\d*) = ", message)
    given = described.parameters if isinstance(described.parameters, dict) else {}
    names = (f"{match[1]}{match[2]}", match[1]) if match else ()
    return next(((name,) for name in names if name in given), ())


def strain_of_tests(described: LawDescription) -> float | None:
    """Return the largest shear strain of the tests that the parameters come from; None: not known.

    Returns:
        Dimensionless, or None.
    """
    ranges = described.tested or {}
    if isinstance(described.parameters, str):
        ranges = {**PARAMETER_SETS[described.parameters].tested, **ranges}
    match = _RANGE_PERCENT.fullmatch(ranges.get("shear_strain", ""))
    return float(match[2] or match[1]) / 100.0 if match else None


def _tested_C(described: LawDescription) -> tuple[float, float] | None:
    """Lowest and highest temperature of the tests, degC."""
    match = _RANGE_C.fullmatch((described.tested or {}).get("temperature", ""))
    return (float(match[1]), float(match[2] or match[1])) if match else None


def _outside_tests(described: LawDescription, temperature_C: float) -> tuple[str, ...]:
    tested = _tested_C(described)
    if tested is None or tested[0] <= temperature_C <= tested[1]:
        return ()
    low, high = tested
    span = f"{low:g} degC" if low == high else f"{low:g} to {high:g} degC"
    return (f"it was tested at {span} and is used at {temperature_C:g} degC",)


def _temperature_law(described: LawDescription, source: Source) -> GammaT | FerryShift | None:
    if described.temperature_law is None:
        return None
    try:
        return TemperatureLaw.model_validate(described.temperature_law).model()
    except ValidationError as error:
        whole = (*source.keys, "temperature_law")
        problems = Problems(find(source.root, whole))
        explain(error, TemperatureLaw, problems)
        lines = [
            f"{source.path}:{p.mark.line}:{p.mark.column}: {keys_text(whole)}{'.' if p.keys_text else ': '}{p}"
            for p in problems.found
        ]
        raise InputError("\n".join(lines)) from error
