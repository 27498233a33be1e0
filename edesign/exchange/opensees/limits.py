"""What OpenSees lacks of a project, and what it does in another way."""

from __future__ import annotations

from collections.abc import Sequence

from edesign.errors import InputError
from edesign.exchange.opensees.dampers import Dampers
from edesign.exchange.opensees.structure import NotTranslated
from edesign.frame.frame_model import FrameModel
from edesign.frame.rigid_ends import rigid_ends
from edesign.project.analysis.damping import CaugheyDamping, ModalDamping
from edesign.project.analysis.integration import GeneralisedAlphaIntegration, NewmarkIntegration
from edesign.project.frame.materials import BilinearMaterial, Material, MenegottoPintoMaterial
from edesign.project.project import Project


def refuse(project: Project, without_dampers: bool) -> None:
    """Refuse what OpenSees lacks, where the project file has it.

    Raises:
        InputError: there is something.
    """
    found = []
    if project.panel_zones:
        where = project.where("panel_zones", 0)
        reason = "OpenSees has no joint that carries the ends of members along its edges as these do"
        found.append(f"{where}: panel_zones: {reason}; translate a copy of the project without this key [E-OPS-03]")
    for i, run in enumerate(project.frame.braces):
        if run.buckling is not None:
            where = project.where("frame", "braces", i, "buckling")
            reason = "the cambered parts of a brace are condensed to one bar, which OpenSees does not have"
            found.append(f"{where}: frame.braces[{i}].buckling: {reason}; translate a copy without this key [E-OPS-03]")
    if project.isolation is not None and not without_dampers:
        where = project.where("dampers", "isolation")
        reason = "isolators whose forces follow from their weights are not translated"
        found.append(
            f"{where}: dampers.isolation: {reason}; --without-dampers puts the frame on its supports [E-OPS-01]"
        )
    if found:
        raise InputError("\n".join(found))


def places(project: Project, frame: FrameModel, problems: Sequence[NotTranslated]) -> list[str]:
    """Return the refusals of several parts: of dampers of one law and one reason the first."""
    law_of = {device.name: device.law for device in frame.devices}
    first = {(law_of.get(problem.subject, problem.subject), str(problem)): problem for problem in reversed(problems)}
    return [_place(project, frame, problem) for problem in reversed(first.values())]


def _place(project: Project, frame: FrameModel, problem: NotTranslated) -> str:
    """The refusal of a part, at its place in the project file."""
    for device in frame.devices:
        if device.name == problem.subject and device.play > 0.0:
            runs = enumerate(project.dampers.devices if project.dampers is not None else ())
            i = next(i for i, run in runs if run.law == device.law and getattr(run.brace, "play", None))
            where = project.where("dampers", "devices", i, "brace", "play")
            return f"{where}: dampers.devices[{i}].brace.play: {device.name}: {problem}"
        if device.name == problem.subject:
            where = project.where("dampers", "laws", device.law)
            return f"{where}: dampers.laws.{device.law}: {device.name}: {problem}"
    member = problem.subject.partition(".")[0]
    if member in frame.members:
        kinds = {"column": "columns", "beam": "beams", "brace": "braces"}
        key = kinds[frame.members[member].kind]
        return f"{project.where('frame', key)}: frame.{key}: {problem.subject}: {problem}"
    return f"{project.where('frame', 'supports')}: frame.supports: {problem.subject}: {problem}"


def differences(project: Project, frame: FrameModel, dampers: Dampers) -> list[str]:
    """Return sentences on what OpenSees does in another way."""
    found = []
    laws = {member.material: member.steel for member in frame.members.values()}
    bending = {member.material for member in frame.members.values() if member.fibres is not None}
    soft = [name for name in laws if name in bending and _is_soft(laws[name])]
    if soft:
        why = "OpenSees loses the state of a section all of whose fibres yield"
        found.append(f"{', '.join(soft)} without hardening: {why}; compare with 0.01 % in a copy of the project")
    if any(isinstance(law, MenegottoPintoMaterial) for law in laws.values()):
        found.append("Steel02 forgets the curve that a small unloading has left; edesign reloads on to it")
    if frame.of_kind("brace") and project.elements.geometry.braces == "p_delta":
        found.append("braces with P-Delta are corotational, which differs by the square of the drift")
    if rigid_ends(project):
        found.append("rigid ends are members some 1e5 times as stiff as theirs, which changes periods by some 1e-5")
    modal = isinstance(project.damping, ModalDamping | CaugheyDamping)
    if modal and project.integration is not None and not isinstance(project.integration, NewmarkIntegration):
        found.append("modal damping acts at another instant of a step with a method other than Newmark's")
    if isinstance(project.integration, GeneralisedAlphaIntegration) and project.integration.rho_inf < 1.0:
        found.append(
            "GeneralizedAlpha of OpenSees 3.7 grows without bounds in frames of several storeys, and ends without "
            "convergence; compare with Newmark's method or HHT in a copy of the project"
        )
    if dampers.moving or dampers.at_rest:
        found.append(
            "dampers follow their laws in the steps of the analysis; edesign follows them exactly within a step"
        )
    return found


def _is_soft(material: Material) -> bool:
    return isinstance(material, BilinearMaterial) and material.hardening == 0.0
