"""Columns, beams and braces of a plane frame or a building as the checks by EN 1993-1-1 see them."""

from __future__ import annotations

from collections.abc import Container, Sequence
from dataclasses import dataclass

import numpy as np

from edesign.codes.ec3.member import Stability
from edesign.codes.ec3.section import SteelSection
from edesign.frame.frame_model import FrameModel
from edesign.frame.loads import MemberLoads, beam_loads, column_loads
from edesign.frame.sections.own_section import section_of
from edesign.project.analysis_file import AnalysisFile
from edesign.project.building.building import Building
from edesign.project.building.steel import Steel
from edesign.project.frame.materials import ElasticMaterial
from edesign.project.frame.member_design import BucklingLength, FrameDesign, LengthFactors
from edesign.project.frame.members import BraceRun
from edesign.project.frame.sections import ElasticSection, RectangleSection
from edesign.project.notation.names import member_kind
from edesign.project.project import Project
from edesign.space.analysis.response import STATIONS
from edesign.space.checks.member_checks import (
    LARGEST_CLASS,
    LARGEST_PLASTIC_CLASS,
    as_checked,
    member_of_frame,
)
from edesign.space.checks.steel_member import SteelMember
from edesign.space.nonlinear.gravity import gravity_loads
from edesign.space.structure.design_block import frame_design_of
from edesign.space.structure.geometry import space_frame
from edesign.space.structure.steel_by_thickness import with_steel_by_thickness, yield_by_thickness

_WITHOUT_CLASS = (RectangleSection, ElasticSection)
"""Own sections that EN 1993-1-1 does not classify."""
SHARED = 2.0
"""What one of a pair of braces that do not count in compression carries in truth, over the force of its model."""


@dataclass(frozen=True)
class CheckedMember:
    """A member as its checks see it.

    Attributes:
        name: of the member.
        plastic: as of class 1 or 2; equal members are one object.
        elastic: likewise as of class 3.
        weak: whether a member of a plane frame bends about its z axis.
        share: by which forces are multiplied: of a pair of braces of which one is in tension at a time one takes all.
        compressed: whether it counts in compression.
    """

    name: str
    plastic: SteelMember
    elastic: SteelMember
    weak: bool = False
    share: float = 1.0
    compressed: bool = True


@dataclass(frozen=True)
class CheckedMembers:
    """Members of a file that the clauses know.

    Attributes:
        members: in the order in which they were asked for, without those whose section or steel has no clause.
        judged: whether each that was asked for is among them, (n,).
        stability: whether lengths, restraints and factors are known: the file has `design`.
    """

    members: tuple[CheckedMember, ...]
    judged: np.ndarray
    stability: bool


def checked_members(file: AnalysisFile, names: Sequence[str]) -> CheckedMembers:
    """Return members as the checks see them: those of a section with a class, of a steel with a yield strength.

    Without `design` the partial factor is 1, and nothing is known of buckling. Moment factors are those of a uniform
    moment, of columns of a plane frame without `frame.braces` those of sway (EN 1993-1-1, Table B.3), as in buildings.
    Beams have the length of their bay: braces and dampers that meet them do not hold them.

    Args:
        names: of columns, beams or braces.

    Raises:
        InputError: a section is not known, or the strength of a steel by its thickness is not.
    """
    found = _in_space(file, names) if isinstance(file, Building) else _in_plane(file, names)
    judged = np.array([one is not None for one in found], dtype=bool)
    return CheckedMembers(tuple(one for one in found if one), judged, getattr(file, "design", None) is not None)


def _in_space(building: Building, names: Sequence[str]) -> list[CheckedMember | None]:
    made = with_steel_by_thickness(building)
    frame = space_frame(made)
    number = {member.name: at for at, member in enumerate(frame.members)}
    if made.design is not None:
        plastic, elastic = as_checked(made, frame)
    else:
        known: dict[tuple[str, str, int], SteelMember] = {}

        def of_class(of: int) -> list[SteelMember]:
            for member in frame.members:
                key = (member.section, member.material, of)
                if key not in known:
                    known[key] = _bare(frame.section(member.section), made.materials[member.material].fy, of)
            return [known[member.section, member.material, of] for member in frame.members]

        plastic, elastic = of_class(LARGEST_PLASTIC_CLASS), of_class(LARGEST_CLASS)
    found: list[CheckedMember | None] = []
    for name in names:
        at = number[_whole(name, number)]
        counts = frame.members[at].compression
        one = CheckedMember(name, plastic[at], elastic[at], share=1.0 if counts else SHARED, compressed=counts)
        found.append(one if plastic[at].section.has_class else None)
    return found


def _in_plane(file: AnalysisFile, names: Sequence[str]) -> list[CheckedMember | None]:
    assert isinstance(file, Project)
    frame, design = file.frame, frame_design_of(file)
    braced = bool(frame.brace_at)
    known: dict[tuple[object, ...], tuple[SteelMember, SteelMember]] = {}
    found: list[CheckedMember | None] = []
    for name in names:
        own, kind = _whole(name, frame.members), member_kind(name)
        run = frame.members[own]
        material = file.materials[run.material]
        if isinstance(file.sections.get(run.section), _WITHOUT_CLASS) or isinstance(material, ElasticMaterial):
            found.append(None)
            continue
        section = section_of(file, run.section)
        fy, standard = material.fy, design.members.yield_by_thickness if design is not None else None
        if standard is not None:
            fy = yield_by_thickness(file, run.section, run.material, fy, standard)[0]
        of, length = design, frame.length(own)
        if kind == "beam":
            length = frame.bay_widths[frame.beam_members[own].bay - 1]
        if isinstance(run, BraceRun) and design is not None:
            of = _of_brace(design, run)
        key = (run.section, fy, material.E, kind, length, of is design or getattr(run, "buckling_length_factor", None))
        if key not in known:
            if of is None:
                known[key] = (_bare(section, fy, LARGEST_PLASTIC_CLASS), _bare(section, fy, LARGEST_CLASS))
            else:
                about = of, section, Steel.model_construct(fy=fy, E=material.E)
                role = kind, length, kind == "column" and not braced
                known[key] = (member_of_frame(*about, True, *role), member_of_frame(*about, False, *role))
        counts = not isinstance(run, BraceRun) or run.compression
        weak = not isinstance(run, BraceRun) and run.axis == "weak"
        found.append(CheckedMember(name, *known[key], weak, 1.0 if counts else SHARED, counts))
    return found


def _whole(name: str, known: Container[str]) -> str:
    """The name of a member in its file: a beam that dampers of a design halve is one there."""
    return name if name in known else name.rpartition("_")[0]


def _of_brace(design: FrameDesign, run: BraceRun) -> FrameDesign:
    """The design of a brace, whose own buckling length counts where its run gives one."""
    if "buckling_length_factor" not in run.model_fields_set:
        return design
    both = LengthFactors(y=run.buckling_length_factor, z=run.buckling_length_factor)
    lengths = BucklingLength.model_copy(design.members.buckling_length, update={"braces": both})
    return design.model_copy(update={"members": design.members.model_copy(update={"buckling_length": lengths})})


def _bare(section: SteelSection, fy: float, number: int) -> SteelMember:
    """A member of which the section alone is checked, with a partial factor of 1."""
    return SteelMember(section, fy, Stability(0.0, 0.0, 0.0), number, gamma_M0=1.0)


def loads_inside(file: AnalysisFile, frame: FrameModel, names: Sequence[str]) -> tuple[np.ndarray, np.ndarray]:
    """Return what loads of the gravity combination inside members add to lines between the forces at their ends.

    Args:
        names: of columns and beams.

    Returns:
        Moments, (n, stations, axes) N m at `STATIONS` of the part that bends: about y and z in space; positive as in
        the middle of a beam under loads downwards. Shear that goes with each of them, (2, n, stations, axes) N: before
        and behind point loads that stand there.
    """
    if isinstance(file, Building):
        whole = space_frame(file)
        number, loads = {member.name: at for at, member in enumerate(whole.members)}, gravity_loads(file, whole)
        own = (
            (loads.uniform[at], loads.points.get(at, ()), float(whole.length[at]))
            for at in (number[name] for name in names)
        )
        moments, shears = np.zeros((len(names), STATIONS.size, 2)), np.zeros((2, len(names), STATIONS.size, 2))
        for at, (uniform, points, length) in enumerate(own):
            for axis, across, sign in ((0, 2, 1.0), (1, 1, -1.0)):
                on = MemberLoads(float(uniform[across]), [(place, float(force[across])) for place, force in points])
                moments[at, :, axis], shears[:, at, :, axis] = _within_ends(on, (0.0, 1.0), length)
                moments[at, :, axis] *= sign
        return moments, shears
    assert isinstance(file, Project)
    of_beams, of_columns = beam_loads(file, file.loads.gravity), column_loads(file, file.loads.gravity)
    moments, shears = np.zeros((len(names), STATIONS.size, 1)), np.zeros((2, len(names), STATIONS.size, 1))
    for at, name in enumerate(names):
        load = of_beams.get(name) or (MemberLoads(of_columns[name]) if name in of_columns else None)
        if load is not None:
            stretches = frame.members[name].bending_stretches
            ends = stretches.places[0], stretches.places[-1]
            moments[at, :, 0], shears[:, at, :, 0] = _within_ends(load, ends, stretches.length)
    return moments, shears


def _within_ends(load: MemberLoads, ends: tuple[float, float], length: float) -> tuple[np.ndarray, np.ndarray]:
    """Moments and shears of loads at `STATIONS` between two shares of the length, beside lines between both ends."""
    x = ends[0] + STATIONS * (ends[1] - ends[0])
    moments, (before, behind) = load.moments(x, length), load.before(x, length)
    line = (1.0 - STATIONS) * behind[0] + STATIONS * before[-1]
    shears = np.stack((before, behind)) - line
    shears[:, [0, -1]] = 0.0
    return moments - (1.0 - STATIONS) * moments[0] - STATIONS * moments[-1], shears
