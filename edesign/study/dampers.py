"""Dampers of a project made ready for its frame: laws at their temperature, tuned masses."""

from __future__ import annotations

import math

from pydantic import ValidationError

from edesign.building.devices import Attached, DeviceLaw
from edesign.core import CoreError, LawValues
from edesign.core.damper import CoreDamper
from edesign.damper.laws import law
from edesign.damper.parameters import ParameterError, read_parameters
from edesign.damper.temperature import FerryShift, GammaT, at
from edesign.damper.temperature_file import TemperatureLaw
from edesign.damper.tuned import sloshing_frequency, sloshing_mass_ratio
from edesign.errors import InputError
from edesign.project.dampers import DamperLaw, TunedMass
from edesign.project.explain import explain
from edesign.project.problems import Keys, Problems, keys_text
from edesign.project.project import Project
from edesign.project.yaml_nodes import find, parse

WATER = 1000.0  # kg/m3


def device_laws(project: Project) -> dict[str, DeviceLaw]:
    """The laws of a project's dampers at their temperatures, by name.

    Raises:
        InputError: a law does not exist, or parameters are wrong; the message names their places in the project file.
    """
    if project.dampers is None:
        return {}
    return {name: _device_law(project, name)[0] for name in project.dampers.laws}


def law_warnings(project: Project) -> list[str]:
    """What is doubtful about the laws, e.g. a temperature outside the range of its tests."""
    if project.dampers is None:
        return []
    return [
        f"damper law {name}: {warning}" for name in project.dampers.laws for warning in _device_law(project, name)[1]
    ]


def _device_law(project: Project, name: str) -> tuple[DeviceLaw, tuple[str, ...]]:
    assert project.dampers is not None
    spec = project.dampers.laws[name]
    keys: Keys = ("dampers", "laws", name)
    try:
        chosen = law(spec.type)
    except InputError as error:
        raise _at(project, (*keys, "type"), error) from error
    try:
        values = read_parameters(chosen, spec.parameters)
    except ParameterError as error:
        lines = [str(_at(project, (*keys, "parameters", name), message)) for name, message in error.problems]
        raise InputError("\n".join(lines)) from error
    except InputError as error:
        raise _at(project, (*keys, "parameters"), error) from error
    warnings: tuple[str, ...] = ()
    if spec.temperature is not None:
        change = _temperature_law(project, spec, keys)
        try:
            values, warnings = at(chosen, values, spec.temperature, change)
        except InputError as error:
            culprit = "temperature_law" if change is not None and chosen.name not in change.laws else "temperature"
            raise _at(project, (*keys, culprit), error) from error
    numbers = LawValues(chosen.name, tuple(values.values()))
    try:
        CoreDamper(numbers.law, numbers.values)
    except CoreError as error:
        raise _at(project, (*keys, "parameters"), error) from error
    prototype = spec.prototype
    if prototype is None:
        return DeviceLaw(numbers), warnings
    size = (prototype.layers, prototype.layer_area, prototype.layer_thickness)
    return DeviceLaw(numbers, *size), warnings


def _temperature_law(project: Project, spec: DamperLaw, keys: Keys) -> GammaT | FerryShift | None:
    if spec.temperature_law is None:
        return None
    try:
        return TemperatureLaw.model_validate(spec.temperature_law).model()
    except ValidationError as error:
        whole = (*keys, "temperature_law")
        problems = Problems(find(parse(project.text)[0], whole))
        explain(error, TemperatureLaw, problems)
        lines = [
            f"{project.path}:{p.mark.line}:{p.mark.column}: {keys_text(whole)}{'.' if p.keys_text else ': '}{p}"
            for p in problems.found
        ]
        raise InputError("\n".join(lines)) from error


def _at(project: Project, keys: Keys, error: object) -> InputError:
    return InputError(f"{project.where(*keys)}: {keys_text(keys)}: {error}")


def attachments(project: Project) -> list[Attached]:
    """Tuned masses, and tuned liquid dampers as the tuned masses that they are equivalent to."""
    found = []
    for i, item in enumerate(project.dampers.attachments if project.dampers is not None else ()):
        if isinstance(item, TunedMass):
            mass, omega = item.mass, 2.0 * math.pi * item.frequency
        else:
            water = WATER * item.number * item.length * item.width * item.depth
            mass = water * sloshing_mass_ratio(item.length, item.depth)
            omega = sloshing_frequency(item.length, item.depth)
        found.append(
            Attached(f"T_{item.floor}_{i + 1}", item.floor, mass, mass * omega**2, 2.0 * item.damping * mass * omega)
        )
    return found
