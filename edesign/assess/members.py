"""Plastic rotations of a frame's members over what performance levels allow them."""

from __future__ import annotations

import math
from collections.abc import Callable, Collection, Iterable, Mapping
from dataclasses import dataclass, replace
from typing import Generic, TypeVar, cast

from edesign.archive.dataset import Group
from edesign.assess.acceptance import ACCEPTANCE, FrameMember, Kind
from edesign.assess.envelopes import peak
from edesign.assess.spread import stored_dims
from edesign.codes.fema356.strength import lower_bound_axial_strength
from edesign.codes.motion_sets import SetRules
from edesign.frame.sections.i_shape import full_i_section, i_section
from edesign.frame.sections.own_section import section_of
from edesign.ground_motion.hazard import rules_in_force
from edesign.project.analysis_file import AnalysisFile
from edesign.project.building.building import Building
from edesign.project.notation.names import column_name, member_kind, storey_of
from edesign.project.project import Project
from edesign.project.study.study import Study, own_variant
from edesign.space.structure.steel_by_thickness import with_steel_by_thickness

AXIAL_FORCE = "column_axial_force"


@dataclass(frozen=True)
class MemberUsage:
    """The plastic rotation of a member over what a performance level allows.

    Attributes:
        ratio: the level is met up to 1.
        rotation: largest plastic rotation of the member's ends, rad.
        allowed: rad.
        axial_ratio: of a column, as the standard has it, P/P_CL with the peak compression in FEMA 356; 0 for beams.
        elastic: why the standard allows no plastic rotation, "" where it allows one.
        axis: about which it rotates, "" in a plane frame.
        other: largest rotation about the weak axis, which nothing limits, rad.
    """

    member: FrameMember
    ratio: float
    rotation: float
    allowed: float
    axial_ratio: float = 0.0
    elastic: str = ""
    axis: str = ""
    other: float = 0.0


File = TypeVar("File", bound=AnalysisFile)


class VariantMembers(Generic[File]):
    """The members of each variant, as `frame_members` gives them.

    Args:
        project: of variants that no study is of.
        study: whose variants may have other values of the project; None: there is none.
    """

    def __init__(self, project: File, study: Study | None = None) -> None:
        self._project, self._study = project, study
        self._found: dict[int, dict[str, FrameMember]] = {}

    def project(self, variant: str) -> File:
        """Return the file of a variant, which may be named with a temperature.

        Args:
            variant: its name, also with a temperature.
        """
        own = own_variant(variant)
        if self._study is None or own not in self._study.variants:
            return self._project
        if not self._study.variants[own].values:
            return self._project
        return cast("File", self._study.project_of(own))  # of the kind of the study's own

    @property
    def rules(self) -> SetRules:
        """The rules of the code in force for motions."""
        return rules_in_force(self._project.hazard)

    def __call__(self, variant: str) -> dict[str, FrameMember]:
        """Return the members of a variant by name."""
        project = self.project(variant)
        if id(project) not in self._found:
            self._found[id(project)] = frame_members(project)
        return self._found[id(project)]


def frame_members(project: AnalysisFile) -> dict[str, FrameMember]:
    """Return the columns and beams of a frame or building that Table 5-6 knows, by name, and the halves of its beams.

    The file's fy is taken for both the expected and the lower-bound yield stress. P_CL is that of the length between
    nodes about both axes (K = 1: P-Delta is part of the analysis). Left out are braces, members that stay elastic,
    sections that are no I section, and columns of a plane frame that bend about their weak axis.

    Members of a building are judged about their strong axis. What the table asks of rotations about the weak axis, and
    of both at once, is not known here; a force-controlled column stays elastic about both.
    """
    if isinstance(project, Building):
        return _building_members(project)
    assert isinstance(project, Project)
    found = {}
    frame = project.frame
    for (line, storey), column in frame.column_at.items():
        section = i_section(project, column)
        if section is not None:
            length = frame.storey_heights[storey - 1]
            strength = lower_bound_axial_strength(section, length, length)
            name = column_name(line, storey)
            found[name] = FrameMember(name, "column", storey, length, section, strength)
    for name, beam in frame.beam_members.items():
        section = i_section(project, frame.beam_at[beam.bay, beam.floor])
        if section is not None:
            found[name] = FrameMember(name, "beam", beam.floor, beam.length, section)
    return found | _halves(found, (frame.beam_name(*place) for place in frame.beam_at))


def _building_members(building: Building) -> dict[str, FrameMember]:
    found = {}
    building, layout = with_steel_by_thickness(building), building.layout
    for name, run in building.layout.members.items():
        kind, steel = member_kind(name), building.materials[run.material]
        shape = section_of(building, run.section)
        if kind == "brace" or steel.law == "elastic" or shape.kind != "I":
            continue
        section = full_i_section(shape, steel.E, steel.fy)
        length = math.dist(*(layout.nodes[end] for end in layout.ends[name]))
        strength = lower_bound_axial_strength(section, length, length) if kind == "column" else math.inf
        found[name] = FrameMember(name, kind, storey_of(name), length, section, strength, "y")
    return found | _halves(found, (str(place) for place in layout.beam_at))


def _halves(members: Mapping[str, FrameMember], beams: Iterable[str]) -> dict[str, FrameMember]:
    """The halves of beams that are whole in the file: dampers of a variant may meet any of them in the middle."""
    return {
        half: replace(members[beam], name=half, length=0.5 * members[beam].length)
        for beam in beams
        if beam in members
        for half in (f"{beam}_1", f"{beam}_2")
    }


def member_usages(
    group: Group,
    members: Mapping[str, FrameMember],
    level: str,
    kinds: Collection[Kind] = ("column", "beam"),
    storeys: Collection[int] | None = None,
    standard: str = "fema356",
) -> list[MemberUsage] | None:
    """Return the usage of each member by one history, in the order of the frame.

    The axial force of a column is its largest compression in the history, gravity included; the force at the instant of
    the largest rotation is not archived, and would be the smaller.

    Args:
        members: as `frame_members` gives them.
        level: a performance level of the standard.
        kinds: which members count.
        storeys: only members of these; None: all.
        standard: a key of `ACCEPTANCE`.

    Returns:
        The usages; None if the history has no plastic rotations.
    """
    found = []
    stored = False
    for kind in kinds:
        rotations = peak(group, f"{kind}_plastic_rotation")
        if rotations is None:
            continue
        stored = True
        of_columns = compressions(group) if kind == "column" else {}
        if stored_dims(group, f"{kind}_plastic_rotation")[-1:] == ("axis",):
            about = [str(axis) for axis in group.coords["axis"].values]
            largest, others = (rotations[..., about.index(axis)].max(axis=1).tolist() for axis in ("y", "z"))
        else:
            largest = rotations.reshape(len(rotations), -1).max(axis=1).tolist()
            others = [0.0] * len(largest)
        for label, rotation, other in zip(group.coords[kind].values.tolist(), largest, others, strict=True):
            member = members.get(str(label))
            if member is not None and (storeys is None or member.storey in storeys):
                compression = of_columns.get(member.name, 0.0)
                found.append(_usage(member, rotation, other, compression, level, standard))
    return found if stored else None


def _usage(member: FrameMember, rotation: float, other: float, compression: float, level: str, of: str) -> MemberUsage:
    limits = ACCEPTANCE[of](member, compression)
    allowed, axis = limits.rotation(level), member.axis
    if other > rotation and member.kind == "column" and limits.elastic:
        rotation, axis = other, "z"  # it stays elastic about both
    usage = rotation / allowed if allowed > 0.0 else math.inf if rotation > 0.0 else 0.0
    return MemberUsage(member, usage, rotation, allowed, limits.axial_ratio, limits.elastic, axis, other)


def compressions(group: Group) -> dict[str, float]:
    """Return the largest compression of each column in a history, N; {} if it has no axial forces.

    Args:
        group: of the history in the archive.
    """
    lowest = group.variables.get(f"{AXIAL_FORCE}_min")  # tension is positive
    if lowest is None:
        return {}
    names = group.coords["column"].values
    return {str(name): max(-float(value), 0.0) for name, value in zip(names, lowest.values, strict=True)}


def gravity_states(groups: Mapping[str, Group]) -> dict[str, Group]:
    """Return the results of gravity analyses among those of all analyses, by name.

    Args:
        groups: of the archive.
    """
    return {
        name: group
        for name, group in groups.items()
        if group.attributes.get("kind") == "gravity" and f"{AXIAL_FORCE}_final" in group.variables
    }


def with_gravity(members: VariantMembers, groups: Mapping[str, Group]) -> Callable[[str], dict[str, FrameMember]]:
    """Return what gives the members of a variant with the compression of its columns under gravity.

    Args:
        groups: results by name, gravity analyses among them.
    """
    states = {str(group.attributes.get("variant") or ""): group for group in gravity_states(groups).values()}
    return lambda variant: under_gravity(members(variant), states.get(own_variant(variant)))


def under_gravity(members: dict[str, FrameMember], group: Group | None) -> dict[str, FrameMember]:
    """Return members with the compression of columns in a gravity analysis; as they are without one.

    Args:
        members: of the frame, by name.
        group: results of the gravity analysis of their variant.
    """
    if group is None:
        return members
    forces = zip(group.coords["column"].values, group.variables[f"{AXIAL_FORCE}_final"].values, strict=True)
    found = {str(name): max(-float(force), 0.0) for name, force in forces}
    return {name: replace(member, gravity=found.get(name)) for name, member in members.items()}
