"""Events along a capacity curve: first yielding, hinge and buckling, drifts of performance levels, peak, collapse."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from edesign.archive.dataset import Group
from edesign.assess.acceptance import ELASTIC_ROTATION
from edesign.codes.capacity_curve import DESCENT
from edesign.codes.fema356.drift import PERFORMANCE_LEVELS, drift_limits
from edesign.core import Response
from edesign.frame.frame_model import FrameModel, Member
from edesign.project.frame.materials import ElasticMaterial
from edesign.project.notation.names import MemberKind
from edesign.study.analysis.collapse import collapse_reason
from edesign.study.results.members import plastic_rotation
from edesign.study.results.recording import Quantity, Terms, coordinate
from edesign.study.results.storeys import drifts_in_words, line_drifts

MOST_STEPS = 10_000
"""Beyond it yielding is not followed: of each step six numbers of each member end are kept while the push runs, which
for a frame of 90 members is 86 MB."""
MOST_IN_SPACE = 1_000
"""The same of a building, of which about 20 numbers of each member end are kept: of 570 members 182 MB."""

KINDS: tuple[MemberKind, ...] = ("beam", "column")


@dataclass(frozen=True)
class CapacityEvent:
    """An event that occurs for the first time in a step of a push.

    Attributes:
        step: the step, 0 is under gravity alone.
        what: "first yield of a beam", "first hinge in a column about z", ...
        place: name of the member or of the node of the panel zone, `storey 3`, or `storey 3 along x at A1` of
            a building; "" where there is none.
    """

    step: int
    what: str
    place: str = ""


@dataclass(frozen=True)
class _Yielding:
    """Strains of the outer layers at the ends of members of a kind, over the yield strain, and plastic rotations.

    Where hinges yield in place of fibres, `strains` has what `_hinge_yield` gives. `rotations` are those about each
    axis, whose words follow "first hinge in a column".
    """

    kind: str
    members: tuple[Member, ...]
    strains: Quantity
    rotations: dict[str, Quantity]


class EventChannels:
    """The quantities that a push records to find its events."""

    def __init__(self, frame: FrameModel, steps: int) -> None:
        self._words = drifts_in_words(frame)
        self._drifts = line_drifts(frame)
        self._followed = Quantity("event_drift", ("drift",), self._drifts.shape, self._drifts.cells, "1", "", True, ())
        follows = steps <= (MOST_STEPS if frame.model.dimension == 2 else MOST_IN_SPACE)
        self._yielding = [found for kind in KINDS if follows and (found := _yielding(frame, kind))]
        self._braces = _Braces(frame) if follows and frame.of_kind("brace") else None
        self._panels = list(frame.panels) if follows else []
        terms: list[Terms] = [
            ((built.panel.stiffness / built.panel.yield_moment, "deformation", built.element, 0),)
            for built in frame.panels.values()
        ]
        self._distortions = _followed("panel_distortion", terms[: len(self._panels)])

    @property
    def quantities(self) -> list[Quantity]:
        """The quantities to be recorded, none of which is archived."""
        found = [self._followed, *(item for one in self._yielding for item in (one.strains, *one.rotations.values()))]
        found += [self._braces.forces, self._braces.elongations] if self._braces else []
        return [*found, self._distortions] if self._panels else found

    def line_drifts(self, response: Response) -> np.ndarray:
        """Return the drift ratio of each step on every column line, (steps, n), in the order of `line_drifts`."""
        return self._followed.values(response)

    def events(self, response: Response, resistance: np.ndarray) -> list[CapacityEvent]:
        """Return the events of a push in their order.

        Args:
            resistance: base shear of each step against the resultant of the lateral loads, N.

        Returns:
            The events, ascending by step.
        """
        found = []
        for one in self._yielding:
            names = [member.name for member in one.members]
            found += _first(f"first yield of a {one.kind}", one.strains.values(response), 1.0, names)
            for about, rotations in one.rotations.items():
                what = f"first hinge in a {one.kind}{about}"
                found += _first(what, rotations.values(response), ELASTIC_ROTATION, names)
        if self._panels:
            distortions = self._distortions.values(response)[..., np.newaxis]
            found += _first("first yield of a panel zone", distortions, 1.0, self._panels)
        if self._braces:
            found += self._braces.events(response)
        drifts = np.abs(self.line_drifts(response))
        for level in PERFORMANCE_LEVELS:
            limit = drift_limits(level).transient
            beyond = np.nonzero(drifts.max(axis=1) > limit)[0]
            if beyond.size:
                at = int(np.argmax(drifts[beyond[0]]))
                place = self._words[at].removeprefix("drift of ")
                found.append(CapacityEvent(int(beyond[0]), f"drift of {level}, {100 * limit:g} %", place))
        peak = int(np.argmax(resistance))
        if resistance[-1] < resistance[peak] * (1.0 - DESCENT):
            found.append(CapacityEvent(peak, "largest base shear"))
        gone = np.nonzero(resistance[1:] <= 0.0)[0]
        if gone.size:
            found.append(CapacityEvent(int(gone[0]) + 1, "no resistance left"))
        elif collapse_reason(response, self._drifts, self._words):
            found.append(CapacityEvent(resistance.size - 1, "equilibrium lost"))
        return sorted(found, key=lambda event: event.step)


def store_capacity_events(
    group: Group, events: Sequence[CapacityEvent], displacement: np.ndarray, base_shear: np.ndarray
) -> None:
    """Add events to the results of a push; nothing if there are none.

    Args:
        events: in their order.
        displacement: of the control node since gravity in each step, m.
        base_shear: of each step, N.
    """
    if not events:
        return
    at, dims = [event.step for event in events], ("capacity_event",)
    coordinate(group, "capacity_event", np.arange(1, len(events) + 1), "1", "number of the event on the capacity curve")
    group.add("capacity_event_what", dims, [event.what for event in events], "", "what happens for the first time")
    group.add(
        "capacity_event_place",
        dims,
        [event.place for event in events],
        "",
        "member, node of a panel zone, or storey where it happens",
    )
    group.add("capacity_event_step", dims, at, "1", "step in which it has happened")
    label = "displacement of the control node since gravity"
    group.add("capacity_event_displacement", dims, displacement[at], "m", label)
    group.add("capacity_event_base_shear", dims, base_shear[at], "N", "base shear in the direction of the push")


def _hinge_yield(member: Member, end: int) -> Terms:
    """Plastic rotation of hinges and joints over a millionth of that at yield: 1 where they begin to yield."""
    springs = [spring for spring in member.springs[end] if spring.yields]
    return tuple((1e6 * s.stiffness / s.M_y, "plastic_rotation", s.element, 0) for s in springs)


def _yielding(frame: FrameModel, kind: MemberKind) -> _Yielding | None:
    members: list[Member] = []
    strains: list[list[Terms]] = []
    for member in frame.of_kind(kind):
        steel = member.steel
        fibres = None if isinstance(steel, ElasticMaterial) else member.fibres
        if fibres is None and not any(spring.yields for end in member.springs for spring in end):
            continue
        members.append(member)
        of_ends: list[Terms] = []
        for end, point in enumerate((0, member.points - 1)):
            if fibres is not None and not isinstance(steel, ElasticMaterial):
                first, factor = point * len(fibres), steel.E / steel.fy
                of_ends += [((factor, "fibre_strain", member.element, first + layer),) for layer in member.outer]
            else:
                of_ends += [_hinge_yield(member, end), ()]
        strains.append(of_ends)
    if not members:
        return None
    places = max(len(of_ends) for of_ends in strains)
    cells = tuple(terms for of_ends in strains for terms in (*of_ends, *[()] * (places - len(of_ends))))
    rotations = {}
    for axis, bending in enumerate(members[0].bending):
        turned = tuple(plastic_rotation(member, end, member.bending[axis]) for member in members for end in (0, 1))
        name, shape = f"event_{kind}_rotation{bending.axis}", (len(members), 2)
        about = f" about {bending.axis}" if bending.axis else ""
        rotations[about] = Quantity(name, (kind, "end"), shape, turned, "rad", "", True, ())
    return _Yielding(
        kind,
        tuple(members),
        Quantity(f"event_{kind}_strain", (kind, "layer"), (len(members), places), cells, "1", "", True, ()),
        rotations,
    )


def _followed(name: str, cells: Sequence[Terms]) -> Quantity:
    """What is kept of each step while a push runs, without extremes."""
    return Quantity(f"event_{name}", (name,), (len(cells),), tuple(cells), "1", "", True, ())


class _Braces:
    """Axial forces of the braces of a frame, N, and elongations over those at which they yield.

    Args:
        frame: its model, with braces.
    """

    def __init__(self, frame: FrameModel) -> None:
        braces = frame.of_kind("brace")
        self._names = [brace.name for brace in braces]
        self._buckles = np.array([brace.yield_elongation is not None for brace in braces])
        yields = [
            np.inf if isinstance(brace.steel, ElasticMaterial) else brace.steel.fy / brace.steel.E * brace.length
            for brace in braces
        ]
        self._yields = np.array(yields)
        self.forces = _followed("brace_force", [((1.0, "axial_force", brace.element, 0),) for brace in braces])
        self.elongations = _followed("brace_elongation", [((1.0, "deformation", b.element, 0),) for b in braces])

    def events(self, response: Response) -> list[CapacityEvent]:
        """Return the first yield and the first buckling of a brace.

        A brace that buckles yields in tension, as it shortens by its deflection too; another one in compression also.
        It has buckled at its largest compression, if it then shortens further under less.
        """
        elongations = self.elongations.values(response)
        stretched = np.where(self._buckles, np.maximum(elongations, 0.0), elongations) / self._yields
        found = _first("first yield of a brace", stretched[..., np.newaxis], 1.0, self._names)
        compressions = -self.forces.values(response)
        buckled = [
            (step, name)
            for i, name in enumerate(self._names)
            if self._buckles[i] and (step := _limit_point(compressions[:, i], -elongations[:, i])) is not None
        ]
        return [*found, *(CapacityEvent(step, "first buckling of a brace", name) for step, name in sorted(buckled)[:1])]


def _limit_point(compression: np.ndarray, shortening: np.ndarray) -> int | None:
    """The step of the largest compression so far after which a brace first shortens further under less; None: none."""
    largest = np.maximum.accumulate(compression)
    at = np.maximum.accumulate(np.where(compression == largest, np.arange(largest.size), 0))
    beyond = (compression < largest * (1.0 - DESCENT)) & (shortening > shortening[at]) & (largest > 0.0)
    return int(at[np.argmax(beyond)]) if beyond.any() else None


def _first(what: str, values: np.ndarray, limit: float, names: Sequence[str]) -> list[CapacityEvent]:
    """The first step in which a value of a member, (steps, members, places), reaches a limit, and which member."""
    largest = np.abs(values).max(axis=2)
    there = np.nonzero(largest.max(axis=1) >= limit)[0]
    if not there.size:
        return []
    return [CapacityEvent(int(there[0]), what, names[int(np.argmax(largest[there[0]]))])]
