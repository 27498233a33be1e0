"""Dampers of a project made ready for its frame: laws at their temperature, tuned masses."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Sequence
from dataclasses import replace

import numpy as np

from edesign.archive.dataset import Group
from edesign.damper.law_file import WHAT, Source, read_law_file, resolve, strain_of_tests
from edesign.damper.laws import law
from edesign.damper.tuned import sloshing_frequency, sloshing_mass_ratio
from edesign.errors import InputError
from edesign.frame.devices import Device, DeviceLaw
from edesign.frame.tuned_masses import Attached
from edesign.project.analysis_file import AnalysisFile
from edesign.project.dampers.dampers import LawDescription, TunedMass
from edesign.project.notation.names import tuned_mass_name
from edesign.project.reading.file_bytes import is_file
from edesign.study.results.warnings import AnalysisWarning, Kind

WATER = 1000.0  # kg/m3


def device_laws(project: AnalysisFile) -> dict[str, DeviceLaw]:
    """Return the laws of a project's dampers at their temperatures, by name.

    Raises:
        InputError: a law does not exist, or parameters are wrong; the message names their places in the project file.
    """
    if project.dampers is None:
        return {}
    return {name: _device_law(project, name)[0] for name in project.dampers.laws}


def laws_that_stand(project: AnalysisFile) -> list[str]:
    """Return the names of the laws whose dampers stand in the frame; a project may have others, for its designs."""
    return [] if project.dampers is None else list(dict.fromkeys(run.law for run in project.dampers.devices))


def with_restrained_braces(project: AnalysisFile, names: Iterable[str]) -> bool:
    """Return whether one of several laws is that of a buckling-restrained brace; errors as `device_laws`."""
    laws = device_laws(project)
    return any(laws[name].restrained is not None for name in names)


def without_dampers_in_modes(project: AnalysisFile) -> bool:
    """Return whether dampers stand that the fundamental period leaves out: all but buckling-restrained braces."""
    laws = device_laws(project)
    return any(laws[name].restrained is None for name in laws_that_stand(project))


VISCOUS_EFFECTS = ("relaxation_branch", "velocity_exponent")
"""Effects that add a force of their own that depends on the speed; others change or add what is there at rest."""


def goes_with_speed(device: Device) -> bool:
    """Return whether a damper is velocity-dependent (FEMA 356, 9.3.3): a slow push does not show all of its work."""
    chosen = law(device.values.law)
    values = dict(zip((p.name for p in chosen.parameters), device.values.values, strict=False))
    return chosen.depends_on_speed(values) or any(
        effect.name.partition(".")[0] in VISCOUS_EFFECTS for effect in device.values.effects
    )


def law_warnings(project: AnalysisFile) -> list[str]:
    """Return one sentence for each warning about the laws, e.g. a temperature outside the range of their tests."""
    if project.dampers is None:
        return []
    return [
        f"damper law {name}: {warning}" for name in project.dampers.laws for warning in _device_law(project, name)[1]
    ]


def _device_law(project: AnalysisFile, name: str) -> tuple[DeviceLaw, tuple[str, ...]]:
    assert project.dampers is not None
    spec = project.dampers.laws[name]
    described: LawDescription = spec
    source = asked = Source(project.path, project.root, ("dampers", "laws", name))
    if spec.file is not None:
        try:
            described, source = read_law_file(project.folder / spec.file, project.yaml_content(spec.file, WHAT))
        except InputError as error:
            if is_file(project.folder / spec.file):
                raise
            raise source.refuse(("file",), error) from error
    resolved = resolve(described, source, spec.temperature, asked)
    numbers, warnings = resolved.for_core, resolved.warnings
    prototype = spec.prototype or described.prototype
    if numbers.law == "buckling_restrained":  # a fit writes the specimen of its tests, whose layers mean nothing here
        if spec.prototype is not None:
            raise asked.refuse(
                ("prototype",), "a buckling-restrained brace has no layers; leave this key out [E-DAMPER-01]"
            )
        if described.effects:  # K, the strain of the core and the adjusted strengths would not know of them
            message = "a buckling-restrained brace takes no effects: omega and beta say what its tests showed"
            raise source.refuse(("effects",), f"{message}; leave this key out [E-DAMPER-01]")
        prototype = None
    if prototype is None and numbers.law == "friction_pendulum":
        # what changes is the friction; the dish that brings it back keeps its radius
        W, R, f_slow, f_fast, *others = numbers.values
        friction = (spec.property_factor * f_slow, spec.property_factor * f_fast)
        return DeviceLaw(replace(numbers, values=(W, R, *friction, *others))), warnings
    if prototype is None:
        return DeviceLaw(numbers, property_factor=spec.property_factor), warnings
    size = (prototype.layers, prototype.layer_area, prototype.layer_thickness)
    return DeviceLaw(numbers, *size, strain_of_tests(described), spec.property_factor), warnings


def strain_warnings(devices: Sequence[Device], strain: np.ndarray) -> list[AnalysisWarning]:
    """Return a warning for each damper that strained beyond the tests of its law, or beyond its strain limit.

    Args:
        strain: (n_devices,) largest shear strain of each.
    """
    found = []
    limits: tuple[tuple[Kind, Callable[[Device], float | None], str], ...] = (
        ("damper_strain", lambda device: device.tested_strain, "its tests, which went to {:g} %"),
        ("strain_limit", lambda device: device.strain_limit, "`strain_limit`, {:g} %"),
    )
    for kind, limit_of, what in limits:
        beyond: dict[tuple[str, float], list[int]] = {}
        for i, device in enumerate(devices):
            limit = limit_of(device)
            if limit is not None and strain[i] > limit:
                beyond.setdefault((device.law, limit), []).append(i)
        for (name, limit), places in beyond.items():
            most = max(places, key=lambda i: strain[i])
            count = "1 damper strains" if len(places) == 1 else f"{len(places)} dampers strain"
            text = (
                f"law {name}: {count} beyond {what.format(100.0 * limit)}: "
                f"{devices[most].name} to {100.0 * strain[most]:.3g} %"
            )
            found.append(AnalysisWarning(kind, text, float(strain[most]) / limit))
    return found


def core_strain_warnings(group: Group, devices: Sequence[Device]) -> list[AnalysisWarning]:
    """Return a warning for braces whose core strained beyond the range of the manufacturer's omega and beta.

    Args:
        group: results of a history or a pushover.
    """
    if "core_strain_max" not in group.variables:
        return []
    largest, least = (np.asarray(group.variables[f"core_strain_{which}"].values) for which in ("max", "min"))
    strain = np.maximum(largest, -least)
    ratios = {i: strain[i] / d.restrained.tested_strain for i, d in enumerate(devices) if d.restrained is not None}
    beyond = [i for i, ratio in ratios.items() if ratio > 1.0]
    if not beyond:
        return []
    most = max(beyond, key=lambda i: ratios[i])
    count = "1 core strains" if len(beyond) == 1 else f"{len(beyond)} cores strain"
    text = (
        f"{count} beyond the largest strain that omega and beta are given at: {devices[most].name} to "
        f"{100.0 * strain[most]:.3g} %, {ratios[most]:.3g} times its own"
    )
    return [AnalysisWarning("core_strain", text, float(ratios[most]))]


def attachments(project: AnalysisFile) -> list[Attached]:
    """Return the tuned masses of a project, and its tuned liquid dampers as equivalent tuned masses."""
    found = []
    for i, item in enumerate(project.dampers.attachments if project.dampers is not None else ()):
        if isinstance(item, TunedMass):
            mass, omega = item.mass, 2.0 * math.pi * item.frequency
        else:
            water = WATER * item.number * item.length * item.width * item.depth
            mass = water * sloshing_mass_ratio(item.length, item.depth)
            omega = sloshing_frequency(item.length, item.depth)
        name, dashpot = tuned_mass_name(item.floor, i + 1), 2.0 * item.damping * mass * omega
        direction = 0 if item.direction is None else ("x", "y").index(item.direction)
        found.append(Attached(name, item.floor, mass, mass * omega**2, dashpot, direction, item.at or ""))
    return found
