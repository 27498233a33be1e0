"""The dampers of a project as links of SAP2000."""

from __future__ import annotations

from edesign.errors import InputError
from edesign.exchange.sap2000.model import Link, LinkProperty, Sap2000Model
from edesign.frame.devices import Device
from edesign.frame.frame import build_frame
from edesign.project.project import Project
from edesign.study.analysis.dampers import device_laws

_TAKEN = (
    "SAP2000's links take `kelvin_voigt` and `viscous` without a brace, and `viscous`, `viscous_power`, `maxwell` and "
    "`maxwell_power` with a spring in series"
)


def add_dampers(project: Project, model: Sap2000Model) -> None:
    """Add the dampers of a project to a model as links along the line between two joints.

    Raises:
        InputError: a damper has no such link, or there are isolators or tuned masses.
    """
    dampers = project.dampers
    assert dampers is not None
    if dampers.isolation is not None or dampers.attachments:
        key = "isolation" if dampers.isolation is not None else "attachments"
        raise InputError(
            f"{project.where('dampers', key)}: dampers.{key}: this translation for SAP2000 takes no such devices; "
            "--without-dampers leaves all dampers out [E-SAP-28]"
        )
    built = build_frame(project, laws=device_laws(project))
    names = {number: name for name, number in built.nodes.items()}
    for device in built.devices:
        where = f"{project.where('dampers', 'devices')}: damper {device.name}"
        ends = {node for _, node, _ in device.terms}
        if len(ends) != 2 or not ends <= set(names):
            raise InputError(
                f"{where}: it acts between floors and not along the line between two nodes, which links of SAP2000 do; "
                "--without-dampers leaves all dampers out [E-SAP-28]"
            )
        found = _property(device, where)
        model.link_properties[device.name] = found
        first, second = _ordered(device)
        model.links[device.name] = Link(device.name, names[first], names[second], device.name)


def _ordered(device: Device) -> tuple[int, int]:
    nodes = list(dict.fromkeys(node for _, node, _ in device.terms))
    return nodes[1], nodes[0]  # the terms of the second end stand first


def _property(device: Device, where: str) -> LinkProperty:
    """The link of a damper: F = force_scale * law(deformation_scale * u), in series with its brace."""
    law, values = device.values.law, device.values.values
    force, stretch = device.force_scale, device.deformation_scale
    if device.values.effects:
        raise InputError(
            f"{where}: its law `{law}` has effects, which links of SAP2000 do not have; {_TAKEN} [E-SAP-28]"
        )
    if device.play:
        raise InputError(
            f"{where}: the pins of its brace have play, which this link of SAP2000 does not have [E-SAP-28]"
        )
    linear = force * stretch
    if not device.brace and law == "kelvin_voigt":
        return LinkProperty(device.name, "Linear", linear * values[0], linear * values[1])
    if not device.brace and law == "viscous":
        return LinkProperty(device.name, "Linear", 0.0, linear * values[0])
    c, exponent, flexibility = 0.0, 1.0, 1.0 / device.brace if device.brace else 0.0
    if law == "viscous":
        c = linear * values[0]
    elif law == "viscous_power" and device.brace:
        c, exponent = force * stretch ** values[1] * values[0], values[1]
    elif law == "maxwell":
        c = linear * values[0]
        flexibility += values[1] / c
    elif law == "maxwell_power":
        c, exponent = force * stretch ** values[1] * values[0], values[1]
        flexibility += 1.0 / (linear * values[2])
    else:
        brace = "with its brace" if device.brace else "without a brace"
        raise InputError(
            f"{where}: SAP2000 has no link of its law `{law}` {brace}; {_TAKEN}; --without-dampers leaves all out"
            " [E-SAP-28]"
        )
    return LinkProperty(
        device.name, "Damper - Exponential", k=1.0 / flexibility, c=c, exponent=exponent, nonlinear=True
    )
