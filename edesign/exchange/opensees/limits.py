"""What OpenSees lacks of a project, and what it does in another way."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from edesign.errors import InputError
from edesign.exchange.opensees.dampers import Dampers
from edesign.exchange.opensees.dynamics import damped_modes
from edesign.exchange.opensees.structure import NotTranslated, Structure
from edesign.frame.frame_model import FrameModel
from edesign.frame.rigid_ends import rigid_ends
from edesign.project.analysis.damping import CaugheyDamping, ModalDamping
from edesign.project.analysis.integration import GeneralisedAlphaIntegration, NewmarkIntegration
from edesign.project.analysis_file import AnalysisFile
from edesign.project.building.building import Building
from edesign.project.frame.materials import BilinearMaterial, Material, MenegottoPintoMaterial
from edesign.project.project import Project
from edesign.project.reading.problems import Keys, keys_text
from edesign.project.reading.words import counted
from edesign.space.file_places import keys_of_member
from edesign.space.nonlinear.rigid_ends import rigid_ends as rigid_ends_of_building


def refuse(project: AnalysisFile, without_dampers: bool) -> None:
    """Refuse what OpenSees lacks, where the file has it.

    Raises:
        InputError: there is something.
    """
    found = _of_frame(project) if isinstance(project, Project) else []
    if isinstance(project, Building):
        found = [
            f"{project.where(*keys)}: {keys_text(keys)}: {what} of buildings are not translated: nodes of rigid floors "
            "can have no others tied to them in OpenSees; leave them out of a copy [E-OPS-06]"
            for keys, what in _of_building(project)
        ]
    if isinstance(project, Project) and project.isolation is not None and not without_dampers:
        where = project.where("dampers", "isolation")
        found.append(
            f"{where}: dampers.isolation: isolators of plane frames are not translated; --without-dampers puts the "
            "frame on its supports [E-OPS-01]"
        )
    if project.fibres.residual_stress != "none":
        where = project.where("fibres", "residual_stress")
        reason = "residual stresses of fibres are not translated"
        found.append(f"{where}: fibres.residual_stress: {reason}; translate a copy without this key [E-OPS-03]")
    if found:
        raise InputError("\n".join(found))


def _of_frame(project: Project) -> list[str]:
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
    return found


def _of_building(building: Building) -> Iterator[tuple[Keys, str]]:
    """What stands on springs between nodes of a floor, by its place."""
    for key, what in (("hinges", "hinges"), ("joints", "joints"), ("panel_zones", "panel zones")):
        if getattr(building, key):
            yield (key, 0), what
    for i, run in enumerate(building.beams):
        if any(isinstance(end, float) for end in (run.ends.start, run.ends.end)):
            yield ("beams", i, "ends"), "ends with a stiffness"


def places(project: AnalysisFile, frame: FrameModel, problems: Sequence[NotTranslated]) -> list[str]:
    """Return the refusals of several parts: of dampers of one law and one reason the first."""
    law_of = {device.name: device.law for device in frame.devices}
    first = {(law_of.get(problem.subject, problem.subject), str(problem)): problem for problem in reversed(problems)}
    return [_place(project, frame, problem) for problem in reversed(first.values())]


def _place(project: AnalysisFile, frame: FrameModel, problem: NotTranslated) -> str:
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
    if any(problem.subject.startswith(f"{name}_") for name in frame.attached):
        return f"{project.where('dampers', 'attachments')}: dampers.attachments: {problem.subject}: {problem}"
    member = problem.subject.partition(".")[0]
    if member in frame.members and isinstance(project, Building):
        keys = keys_of_member(project, member)
        return f"{project.where(*keys)}: {keys_text(keys)}: {problem.subject}: {problem}"
    if member in frame.members:
        kinds = {"column": "columns", "beam": "beams", "brace": "braces"}
        key = kinds[frame.members[member].kind]
        return f"{project.where('frame', key)}: frame.{key}: {problem.subject}: {problem}"
    keys = ("supports",) if isinstance(project, Building) else ("frame", "supports")
    return f"{project.where(*keys)}: {keys_text(keys)}: {problem.subject}: {problem}"


def differences(project: AnalysisFile, structure: Structure, dampers: Dampers) -> list[str]:
    """Return sentences on what OpenSees does in another way."""
    found, frame = [], structure.frame
    geometry = project.elements.geometry
    laws = {member.material: member.steel for member in frame.members.values()}
    bending = {member.material for member in frame.members.values() if member.fibres is not None}
    soft = [name for name in laws if name in bending and _is_soft(laws[name])]
    if soft:
        why = "OpenSees loses the state of a section all of whose fibres yield"
        found.append(f"{', '.join(soft)} without hardening: {why}; compare with 0.01 % in a copy of the project")
    if any(isinstance(law, MenegottoPintoMaterial) for law in laws.values()):
        found.append("Steel02 forgets the curve that a small unloading has left; edesign reloads on to it")
    if frame.of_kind("brace") and geometry.braces == "p_delta":
        found.append("braces with P-Delta are corotational, which differs by the square of the drift")
    if isinstance(project, Building) and "corotational" in (geometry.columns, geometry.beams):
        found.append(
            "corotational members in space are formulated otherwise, which differs by the square of their turns"
        )
    if structure.shifted:
        along = f"loads along {counted(len(structure.shifted), 'member')} stand at their ends"
        found.append(f"{along}: P-Delta takes the axial force in the middle, as in edesign")
    divided = [name for name in structure.divided if frame.members[name].fibres is not None]
    if divided:
        found.append(
            f"{counted(len(divided), 'member')} of more than 10 sections are divided: damping in proportion to the "
            "stiffness acts within them too; compare with fewer `elements.integration_points` in a copy"
        )
    ends = rigid_ends_of_building(project) if isinstance(project, Building) else None
    if ends or (isinstance(project, Project) and rigid_ends(project)):
        found.append("rigid ends are members some 1e5 times as stiff as theirs, which changes periods by some 1e-5")
    modal = isinstance(project.damping, ModalDamping | CaugheyDamping)
    if modal and project.integration is not None and not isinstance(project.integration, NewmarkIntegration):
        found.append("modal damping acts at another instant of a step with a method other than Newmark's")
    if isinstance(project.integration, GeneralisedAlphaIntegration) and project.integration.rho_inf < 1.0:
        found.append(
            "GeneralizedAlpha of OpenSees 3.7 grows without bounds in frames of several storeys, and ends without "
            "convergence; compare with Newmark's method or HHT in a copy of the project"
        )
    if dampers.carrying:
        found.append("isolators within a circle step along chords, which differs by the order of the time step")
        if damped_modes(project):
            found.append("damping by modes on isolators is that of masses in their places, also where they are beside")
    if structure.dimension == 3 and (dampers.moving or dampers.at_rest):
        found.append("dampers are zeroLength between nodes that are apart, of which OpenSees warns without need")
    if dampers.moving or dampers.at_rest:
        found.append(
            "dampers follow their laws in the steps of the analysis; edesign follows them exactly within a step"
        )
    return found


def _is_soft(material: Material) -> bool:
    return isinstance(material, BilinearMaterial) and material.hardening == 0.0
