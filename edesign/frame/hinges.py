"""Members with springs at their ends: plastic hinges, and semi-rigid joints."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from math import dist, inf, sqrt
from typing import TYPE_CHECKING, Literal, Protocol

from edesign.codes.fema356.sections import ISection
from edesign.codes.lignos_krawinkler import (
    CAPPING_RATIO,
    EFFECTIVE_YIELD,
    RESIDUAL_RATIO,
    ULTIMATE_ROTATION,
    rotation_capacity,
)
from edesign.errors import InputError
from edesign.frame.sections.i_shape import IShape, i_section, i_shape
from edesign.project.analysis_file import AnalysisFile
from edesign.project.frame.hinges import AnyHinges, AnyJoints, Hinges, HingeSide, HingeValues, Joints
from edesign.project.frame.members import BeamRun, BraceRun, ColumnRun
from edesign.project.notation import names
from edesign.project.project import Project

if TYPE_CHECKING:
    from edesign.core import DeterioratingSide, Model, SpringLaw

TURN = (0.0, 0.0, -1.0, 0.0, 0.0, 1.0)
"""Terms of a spring between two nodes at one place whose deformation is the rotation of the second less the first."""
Axis = tuple[float, float, float]
"""Unit vector about which a spring in space turns: one of the axes of the building, or against it."""
NO_WEB: Axis = (0.0, 0.0, 0.0)
"""Of members in a plane."""
END_NAMES = ("start", "end")
LATERAL_BRACING = 0.086
"""Largest distance of lateral braces of highly ductile beams over r_y E / F_y (AISC 341-10, D1.2b)."""

SpringKind = Literal["hinge", "joint"]


@dataclass(frozen=True)
class EndSpring:
    """A spring at a member's end; its moment is that on the end, its rotation adds to the chord's.

    Both are anticlockwise in a plane frame, and about local y of the member in a building.

    Attributes:
        element: its id in the core.
        kind: what it stands for.
        stiffness: at the start, N m/rad.
        of_member: E I / L of its member, N m.
        M_y: effective yield moment, or resistance of the joint, N m; infinite if it does not yield.
        rotations: theta_p, theta_pc, theta_u of a hinge, rad; of a joint nan.
    """

    element: int
    kind: SpringKind
    stiffness: float
    of_member: float
    M_y: float = inf
    rotations: tuple[float, float, float] = (float("nan"),) * 3

    @property
    def yields(self) -> bool:
        """True if the spring can yield."""
        return self.M_y < inf


@dataclass(frozen=True)
class MemberEnd:
    """Hinge and joint at one end of a member.

    Attributes:
        hinge: the moment and rotation of a hinge, None: none.
        distance: from the node to the hinge, m.
        ratio: n of the hinge.
        joint: the joint, None: it does not turn.
    """

    hinge: HingeValues | None = None
    distance: float = 0.0
    ratio: float = 10.0
    joint: AnyJoints | None = None

    def from_edge(self, arm: float) -> MemberEnd:
        """Return the end with the distance from the edge of a panel zone; a hinge in the panel stands at its edge.

        Args:
            arm: from the node to the edge, m.
        """
        return replace(self, distance=max(self.distance - arm, 0.0)) if arm else self


Ends = tuple[MemberEnd, MemberEnd]


class EndSites(Protocol):
    """Members of a plane frame or a building at whose ends hinges and joints may stand."""

    def members_in(self, of: AnyHinges | AnyJoints) -> Iterator[tuple[str, str]]:
        """Yield the first and the last member of each beam or column that is chosen; of most they are one."""

    def length(self, name: str) -> float:
        """Return the length of a member between its nodes, m."""

    def i_shape(self, name: str) -> IShape | None:
        """Return the plates of a member's section; None if it is no I section, or bends about its weak axis."""

    def i_section(self, name: str) -> ISection | None:
        """Return the properties of a member's I section; None if it has none, or its steel does not yield."""

    def columns_at(self, node: str, beam: str) -> list[IShape | None]:
        """Return the plates of the columns at the node of a beam's end, as they bend with the beam."""


@dataclass(frozen=True)
class FrameSites:
    """The members of a plane frame."""

    project: Project

    def members_in(self, of: AnyHinges | AnyJoints) -> Iterator[tuple[str, str]]:
        """Yield the first and the last member of each beam or column that is chosen; of most they are one."""
        assert isinstance(of, Hinges | Joints)
        return self.project.frame.members_in(of.beams, of.columns)

    def length(self, name: str) -> float:
        """Return the length of a member between its nodes, m."""
        return self.project.frame.length(name)

    def i_shape(self, name: str) -> IShape | None:
        """Return the plates of a member's section; None if it is no I section, or bends about its weak axis."""
        return i_shape(self.project, self._run(name))

    def i_section(self, name: str) -> ISection | None:
        """Return the properties of a member's I section; None if it has none, or its steel does not yield."""
        return i_section(self.project, self._run(name))

    def columns_at(self, node: str, beam: str) -> list[IShape | None]:
        """Return the plates of the columns at the node of a beam's end, as they bend with the beam."""
        del beam  # all stand in its plane
        return [
            i_shape(self.project, run)
            for (line, storey), run in self.project.frame.column_at.items()
            if node in (names.node_name(line, storey), names.node_name(line, storey - 1))
        ]

    def _run(self, name: str) -> ColumnRun | BeamRun:
        run = self.project.frame.members[name]
        assert not isinstance(run, BraceRun)
        return run


def member_ends(project: Project) -> dict[str, Ends]:
    """Return the hinges and joints at the ends of the members of a project that have any, by name.

    Raises:
        InputError: the regression does not know a section.
    """
    return ends_of_members(project, FrameSites(project))


def ends_of_members(file: AnalysisFile, sites: EndSites) -> dict[str, Ends]:
    """Return the hinges and joints at the ends of the members that have any, by name.

    Raises:
        InputError: the regression does not know a section.
    """
    found: dict[str, list[MemberEnd]] = {}
    for i, hinges in enumerate(file.hinges):
        for first, last in sites.members_in(hinges):
            for name, end in _chosen(first, last, hinges.ends):
                distance = _distance(file, sites, hinges, name, end, i)
                of = found.setdefault(name, [MemberEnd(), MemberEnd()])
                of[end] = replace(of[end], hinge=None, distance=distance, ratio=hinges.stiffness_ratio)
        for first, last in sites.members_in(hinges):
            for name, end in _chosen(first, last, hinges.ends):
                of = found[name]
                of[end] = replace(of[end], hinge=_values(file, sites, hinges, name, of, i))
    for joints in file.joints:
        for first, last in sites.members_in(joints):
            for name, end in _chosen(first, last, joints.ends):
                of = found.setdefault(name, [MemberEnd(), MemberEnd()])
                of[end] = replace(of[end], joint=joints)
    return {name: (of[0], of[1]) for name, of in found.items()}


def _chosen(first: str, last: str, ends: str) -> list[tuple[str, int]]:
    """(member, end) of a beam or column, which may be two members in line."""
    both = {"start": [(first, 0)], "end": [(last, 1)]}
    return [*both["start"], *both["end"]] if ends == "both" else both[ends]


def _distance(file: AnalysisFile, sites: EndSites, hinges: AnyHinges, name: str, end: int, i: int) -> float:
    cut = hinges.reduced_section
    distance = hinges.distance
    if distance is None:
        distance = 0.0
        if cut is not None:
            distance = 0.5 * _column_depth(file, sites, name, end, i) + cut.a + 0.5 * cut.b
    if not distance < 0.5 * sites.length(name):
        where = file.where("hinges", i)
        raise InputError(
            f"{where}: the hinge of {name} is {distance:.3g} m from its node, beyond the middle of the member"
            " [E-HINGE-01]"
        )
    return distance


def _column_depth(file: AnalysisFile, sites: EndSites, name: str, end: int, i: int) -> float:
    """Depth of the deeper column at the node of a beam's end, m."""
    node = file.grid.ends[name][end]
    depths = []
    for plates in sites.columns_at(node, name):
        if plates is None:
            where = file.where("hinges", i)
            raise InputError(
                f"{where}: the column at {node} has no I section; give the `distance` of the hinges [E-HINGE-02]"
            )
        depths.append(plates.height)
    return max(depths, default=0.0)


def _values(
    file: AnalysisFile, sites: EndSites, hinges: AnyHinges, name: str, of: Sequence[MemberEnd], i: int
) -> HingeValues:
    if isinstance(hinges.parameters, HingeValues):
        return hinges.parameters
    run = file.grid.members[name]
    where = file.where("hinges", i, "parameters")
    section, plates = sites.i_section(name), sites.i_shape(name)
    if section is None or plates is None:
        raise InputError(
            f"{where}: the regression is for I sections of steel that yields; {name} has `{run.section}` of "
            f"`{run.material}`: give its parameters one by one [E-HINGE-02]"
        )
    cut, kind = hinges.reduced_section, "other" if hinges.reduced_section is None else "reduced"
    r_y = sqrt(section.weak_inertia / section.area)
    unbraced = hinges.unbraced_length
    if unbraced is None:
        unbraced = LATERAL_BRACING * r_y * section.E / section.expected_yield
    clear = sites.length(name) - of[0].distance - of[1].distance
    span = 0.5 * clear if hinges.ends == "both" else clear
    capacity = rotation_capacity(
        section.web_slenderness,
        section.flange_slenderness,
        unbraced / r_y,
        span / plates.height,
        plates.height,
        section.expected_yield,
        cut is not None,
    )
    Z = section.plastic_modulus
    if cut is not None:
        if not 2.0 * cut.c < plates.width:
            at = file.where("hinges", i, "reduced_section", "c")
            raise InputError(
                f"{at}: two cuts of {cut.c:g} m leave nothing of the flange of {name}, {plates.width:g} m wide"
                " [E-HINGE-03]"
            )
        Z -= 2.0 * cut.c * plates.flange * (plates.height - plates.flange)
    M_y = EFFECTIVE_YIELD[kind] * Z * section.expected_yield
    return HingeValues.model_construct(
        M_y=M_y,
        M_c_ratio=CAPPING_RATIO[kind],
        M_r_ratio=RESIDUAL_RATIO,
        theta_p=capacity.plastic,
        theta_pc=capacity.post_capping,
        theta_u=ULTIMATE_ROTATION,
        Lambda=capacity.Lambda,
    )


def turn_terms(axis: Axis | None) -> tuple[float, ...]:
    """Return the terms of a spring between two nodes at one place: the turn of the second less that of the first.

    Args:
        axis: about which it turns in space; None: in a plane.
    """
    return TURN if axis is None else (0.0, 0.0, 0.0, *(-part for part in axis), 0.0, 0.0, 0.0, *axis)


def turned_degree(axis: Axis) -> int:
    """Return the degree in which a node turns about an axis of the building.

    Args:
        axis: or against it.
    """
    return 3 + max(range(3), key=lambda at: abs(axis[at]))


def _hinge_law(values: HingeValues, stiffness: float, end: int, in_space: bool) -> SpringLaw:
    """Return the core's law of a hinge at the start (0) or end (1) of a member.

    A moment that pulls at the bottom turns the start clockwise and the end anticlockwise, which is positive in a plane;
    about local y of a beam whose web stands upright clockwise is positive.

    Args:
        stiffness: before yield, N m/rad.
        end: 0: start, 1: end.
        in_space: whether the hinge turns about local y.
    """
    from edesign.core import DeterioratingSpring

    other = values.hogging
    sagging = _side(values, HingeSide())
    hogging = _side(values, other)
    sides = (hogging, sagging) if (end == 0) != in_space else (sagging, hogging)

    def energy(own: float | None) -> float:
        Lambda = own if own is not None else values.Lambda
        return inf if Lambda is None else Lambda * values.M_y

    strength, after_capping, unloading = map(energy, (values.Lambda_s, values.Lambda_c, values.Lambda_k))
    return DeterioratingSpring(stiffness, *sides, strength, after_capping, unloading, (values.c,) * 3)


def _side(values: HingeValues, other: HingeSide) -> DeterioratingSide:
    from edesign.core import DeterioratingSide

    def of(name: str) -> float:
        own = getattr(other, name)
        return float(getattr(values, name) if own is None else own)

    return DeterioratingSide(
        plastic=of("theta_p"),
        capping=of("theta_pc"),
        ultimate=of("theta_u"),
        yield_force=of("M_y"),
        capped=of("M_c_ratio"),
        residual=of("M_r_ratio"),
        rate=of("D"),
    )


@dataclass(frozen=True)
class BuiltMember:
    """Parts of a member in the core.

    Attributes:
        parts: its elements from the start; springs are not among them.
        lengths: of these, m.
        interior: the one between the hinges.
        springs: at its start and at its end.
    """

    parts: tuple[int, ...]
    lengths: tuple[float, ...]
    interior: int
    springs: tuple[tuple[EndSpring, ...], tuple[EndSpring, ...]]


@dataclass(frozen=True)
class _BuiltEnd:
    """An end of a member in the core.

    Attributes:
        inner: node at which the part between the hinges ends.
        springs: from the member's node inwards.
        flexibility: of its hinge, which the member leaves out, rad/(N m).
        stub: nodes of the short part outside of its hinge, None: there is none.
    """

    inner: int
    springs: tuple[EndSpring, ...]
    flexibility: float
    stub: tuple[int, int] | None


class MemberBuilder:
    """Adds members with springs at their ends to a model.

    In space the springs turn about local y, of rolled sections the strong axis. Members with springs stand along the
    axes of the building there.

    Args:
        places: of all nodes by their ids, m; nodes that are added are noted.

    Attributes:
        moving_with: nodes behind springs that share the displacements of a node, by its id.
        turning_apart: degree in which a node behind a spring in space turns on its own, by its id.
    """

    def __init__(self, model: Model, places: dict[int, tuple[float, ...]]) -> None:
        self._model, self._places = model, places
        self.moving_with: dict[int, list[int]] = {}
        self.turning_apart: dict[int, int] = {}

    def add(
        self,
        name: str,
        nodes: tuple[int, int],
        section: int,
        EI: float,
        points: int,
        geometry: str,
        release: Sequence[bool],
        ends: Ends,
        breaks: Sequence[float] = (),
        web: Axis = NO_WEB,
    ) -> BuiltMember:
        """Add a member.

        Args:
            nodes: ids of its nodes.
            section: id in the core, elastic if there are hinges.
            EI: bending stiffness of the elastic section, in space about local y, N m2.
            points: of integration in a member of fibres.
            geometry: transformation of the member: "linear", "p_delta" or "corotational".
            release: whether its start and its end are free of moment, in space as of `Model.beam_column`.
            ends: what stands at its start and end.
            breaks: rising positions 0..1 between its nodes where loads begin, end or stand; the parts of a member with
                hinges are elastic and need none.
            web: in space the direction of local z.

        Returns:
            The parts of the member in the core, and the springs of its hinges.
        """
        model = self._model
        length = dist(*(self._places[node] for node in nodes))
        interior = length - ends[0].distance - ends[1].distance
        in_space = model.dimension == 3
        turns = self._local_y(nodes, web) if in_space else None
        built = [self._end(name, end, nodes, ends[end], EI, length, interior, turns) for end in (0, 1)]
        without = [end.flexibility for end in built]
        element = model.beam_column(
            name,
            built[0].inner,
            built[1].inner,
            section,
            points=points,
            geometry=geometry,
            release=release,
            breaks=() if any(without) else breaks,
            web=web,
        )
        if any(without):
            model.without_flexibility(element, without[0], without[1], about_y=in_space)
            model.damping_factor(element, _damping_factor(without, EI, interior))
        parts, lengths = [element], [interior]
        for end, of in enumerate(built):
            if of.stub is None:
                continue
            pair, at = (of.stub, 0) if end == 0 else (of.stub[::-1], len(parts))
            stub = f"{name}.{END_NAMES[end]}"
            parts.insert(at, model.beam_column(stub, *pair, section, 2, geometry, web=web))
            lengths.insert(at, ends[end].distance)
        return BuiltMember(tuple(parts), tuple(lengths), element, (built[0].springs, built[1].springs))

    def _local_y(self, nodes: tuple[int, int], web: Axis) -> Axis:
        first, last = (self._places[node] for node in nodes)
        x = [(b - a) / dist(first, last) for a, b in zip(first, last, strict=True)]
        y = (web[1] * x[2] - web[2] * x[1], web[2] * x[0] - web[0] * x[2], web[0] * x[1] - web[1] * x[0])
        return float(round(y[0])), float(round(y[1])), float(round(y[2]))

    def _end(
        self,
        name: str,
        end: int,
        nodes: tuple[int, int],
        of: MemberEnd,
        EI: float,
        length: float,
        interior: float,
        axis: Axis | None,
    ) -> _BuiltEnd:
        """Add the nodes and springs of an end, from its node inwards: joint, stub, hinge."""
        from edesign.core import MultilinearSpring

        label, at = f"{name}.{END_NAMES[end]}", nodes[end]
        springs: list[EndSpring] = []
        stub, flexibility = None, 0.0
        if of.joint is not None:
            joint = of.joint
            bilinear = MultilinearSpring.bilinear(joint.stiffness, joint.resistance, joint.hardening)
            at, spring = self._spring(f"{label}.joint", at, bilinear, axis)
            resistance = inf if joint.resistance is None else joint.resistance
            springs.append(EndSpring(spring, "joint", joint.stiffness, EI / length, resistance))
        if of.hinge is not None:
            if of.distance > 0.0:
                first, last = (self._places[node] for node in nodes)
                share = of.distance / length if end == 0 else 1.0 - of.distance / length
                cut = self._node(f"{label}.cut", tuple(a + share * (b - a) for a, b in zip(first, last, strict=True)))
                stub, at = (at, cut), cut
            stiffness = (of.ratio + 1.0) * 6.0 * EI / interior
            flexibility = 1.0 / stiffness
            law = _hinge_law(of.hinge, stiffness, end, axis is not None)
            at, spring = self._spring(f"{label}.hinge", at, law, axis)
            self._model.damping_factor(spring, 0.0)
            values = (of.hinge.theta_p, of.hinge.theta_pc, of.hinge.theta_u)
            springs.append(EndSpring(spring, "hinge", stiffness, EI / length, of.hinge.M_y, values))
        return _BuiltEnd(at, tuple(springs), flexibility, stub)

    def _node(self, name: str, place: tuple[float, ...]) -> int:
        node = self._model.node(name, *place)
        self._places[node] = place
        return node

    def _spring(self, name: str, outer: int, law: SpringLaw, axis: Axis | None) -> tuple[int, int]:
        """A spring between a node and another one at the same place, which is returned with it."""
        inner = self._node(name, self._places[outer])
        if axis is None:
            self._model.tie(inner, outer, ux=True, uy=True)
        else:
            self.turning_apart[inner] = turned_degree(axis)
            tie_but(self._model, inner, outer, self.turning_apart[inner])
        for moving in self.moving_with.values():
            moving += [inner] if outer in moving else []
        self.moving_with.setdefault(outer, []).append(inner)
        return inner, self._model.spring(name, inner, outer, turn_terms(axis), law)


def tie_but(model: Model, node: int, other: int, apart: int) -> None:
    """Let a node in space move with another one at its place in all degrees but one of its turns."""
    tied = {degree: at != apart for at, degree in enumerate(model.degrees)}
    if other in model.masters:  # a rigid floor takes both along in plan
        model.diaphragm(model.masters[other], [node])
        tied |= dict.fromkeys(("ux", "uy", "rz"), False)
    model.tie(node, other, **tied)


def _damping_factor(without: Sequence[float], EI: float, length: float) -> float:
    """Energy of the plain member over that of the part between its hinges, in double curvature.

    With hinges of one n at both ends it is (n + 1) / n (Zareian & Medina 2010, Eq. 9).
    """
    plain = length / (6.0 * EI)
    return 2.0 * plain / (2.0 * plain - sum(without))
