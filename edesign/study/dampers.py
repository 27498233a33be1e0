"""Dampers of a project made ready for its frame: laws at their temperature, tuned masses."""

from __future__ import annotations

import math

from pydantic import ValidationError

from edesign.building.devices import Attached, DeviceLaw
from edesign.core import CoreError, LawValues
from edesign.core.damper import CoreDamper
from edesign.damper.laws import law
from edesign.damper.parameters import ParameterError, read_parameters
from edesign.damper.temperature import at
from edesign.damper.temperature_file import TemperatureLaw
from edesign.damper.tuned import sloshing_frequency, sloshing_mass_ratio
from edesign.errors import InputError
from edesign.project.dampers import DamperLaw, TunedMass
from edesign.project.project import Project

WATER = 1000.0  # kg/m3


def device_laws(project: Project) -> dict[str, DeviceLaw]:
    """The laws of a project's dampers at their temperatures, by name.

    Raises:
        InputError: a law does not exist, or a parameter is wrong; the message names the place in the project file.
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
    keys = ("dampers", "laws", name)
    try:
        chosen = law(spec.type)
    except InputError as error:
        raise _at(project, (*keys, "type"), error) from error
    try:
        values = read_parameters(chosen, spec.parameters)
    except ParameterError as error:
        first = error.problems[0][0]
        raise _at(project, (*keys, "parameters", first), error) from error
    except InputError as error:
        raise _at(project, (*keys, "parameters"), error) from error
    warnings: tuple[str, ...] = ()
    if spec.temperature is not None:
        try:
            values, warnings = at(chosen, values, spec.temperature, _temperature_law(project, spec, keys))
        except InputError as error:
            raise _at(project, (*keys, "temperature"), error) from error
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


def _temperature_law(project: Project, spec: DamperLaw, keys: tuple[str, ...]):  # type: ignore[no-untyped-def]
    if spec.temperature_law is None:
        return None
    try:
        return TemperatureLaw.model_validate(spec.temperature_law).model()
    except ValidationError as error:
        first = error.errors()[0]
        raise _at(project, (*keys, "temperature_law"), first["msg"]) from error


def _at(project: Project, keys: tuple[str, ...], error: object) -> InputError:
    return InputError(f"{project.where(*keys)}: {'.'.join(keys)}: {error}")


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
