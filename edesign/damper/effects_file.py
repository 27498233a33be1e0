"""How effects of a damper law are written in YAML: the key `effects`."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from edesign.damper.effects import LAW_EFFECTS, LawEffect, law_effect_form, placement_of
from edesign.damper.parameters import ParameterError, read_parameters, write_parameters
from edesign.errors import InputError
from edesign.project.dampers.dampers import Effect
from edesign.project.reading.problems import Keys


class EffectsError(InputError):
    """Error: effects of a law are wrong; the message lists all problems.

    Attributes:
        problems: keys below `effects`, and what is wrong there.
    """

    def __init__(self, problems: Sequence[tuple[Keys, str]]) -> None:
        self.problems = tuple(problems)
        super().__init__("\n".join(message for _, message in problems))


def read_effects(effects: Sequence[Effect]) -> tuple[LawEffect, ...]:
    """Read the effects that a file describes.

    Raises:
        EffectsError: an effect or form does not exist, or parameters are wrong; names all of them.
    """
    problems: list[tuple[Keys, str]] = []
    found = []
    for i, effect in enumerate(effects):
        try:
            definition = law_effect_form(effect.name, effect.form)
        except InputError as error:
            key = "form" if any(effect.name == name for name, _ in LAW_EFFECTS) else "name"
            problems.append(((i, key), str(error)))
            continue
        try:
            said = effect.placement if "placement" in effect.model_fields_set else None
            placement = placement_of(effect.name, effect.form, said)
        except InputError as error:
            problems.append(((i, "placement"), str(error)))
            continue
        try:
            values = read_parameters(definition, effect.parameters)
            law_effect = LawEffect(effect.name, effect.form, values, placement)
            law_effect.for_core()  # a factor that is none
        except ParameterError as error:
            problems += [((i, "parameters", name), message) for name, message in error.problems]
        except InputError as error:
            problems.append(((i, "parameters"), str(error)))
        else:
            found.append(law_effect)
    if problems:
        raise EffectsError(problems)
    return tuple(found)


def write_effects(effects: Sequence[LawEffect]) -> list[dict[str, Any]]:
    """Return effects as a file describes them, with parameters in kN, mm and s; `read_effects` reads them back."""
    written = []
    for one in effects:
        units = {parameter.name: parameter.unit for parameter in one.definition.parameters}
        texts = write_parameters(one.definition, one.values)
        parameters = {name: text if units[name] else float(text) for name, text in texts.items()}
        placement = {} if one.placement == "whole" else {"placement": one.placement}
        written.append({"name": one.name, "form": one.form, **placement, "parameters": parameters})
    return written
