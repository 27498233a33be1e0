"""The devices of a project by their names, as frames and archives have them."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from edesign.project.dampers.dampers import DamperBetween, Device
from edesign.project.notation import names
from edesign.project.project import Project


def devices_of(project: Project) -> dict[str, tuple[Device, int]]:
    """Return every device with its description and its storey, 0 of one between nodes."""
    found: dict[str, tuple[Device, int]] = {}
    for device in project.dampers.devices if project.dampers is not None else ():
        for name, storey in _places(project, device):
            found[_free(name, found)] = device, storey
    return found


def law_of(project: Project, physical: Sequence[str]) -> str | None:
    """Return the name of the law that the physical devices have; None: there are none, or they have several.

    Args:
        project: the validated project.
        physical: names of the devices in the laboratory.
    """
    known = devices_of(project)
    laws = {known[name][0].law for name in physical if name in known}
    return laws.pop() if len(laws) == 1 else None


def _places(project: Project, device: Device) -> Iterator[tuple[str, int]]:
    if isinstance(device, DamperBetween):
        yield "N_{}_{}".format(*device.nodes), 0
        return
    for storey in device.storeys.numbers(1, project.frame.n_storeys):
        for bay in device.bays.numbers(1, project.frame.n_bays):
            for name in names.damper_names(device.kind, bay, storey):
                yield name, storey


def _free(name: str, taken: dict[str, tuple[Device, int]]) -> str:
    """The name, or with the next number where several devices stand at one place."""
    if name not in taken:
        return name
    return next(free for number in range(2, len(taken) + 3) if (free := f"{name}_{number}") not in taken)
