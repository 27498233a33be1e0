"""Events along a capacity curve: first yielding, first hinge, drifts of performance levels, peak, collapse."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from edesign.archive.dataset import Group
from edesign.assess.members import ELASTIC_ROTATION
from edesign.building.frame import FrameModel, Member
from edesign.codes.capacity_curve import DESCENT
from edesign.codes.fema356.drift import PERFORMANCE_LEVELS, drift_limits
from edesign.core import Response
from edesign.project.frame.materials import ElasticMaterial
from edesign.project.project import Project
from edesign.study import quantities as q
from edesign.study.collapse import collapse_reason
from edesign.study.recording import Quantity, Terms, coordinate

MOST_STEPS = 10_000
"""Beyond it yielding is not followed: of each step six numbers of each member end are kept while the push runs, which
for a frame of 90 members is 86 MB."""

KINDS = ("beam", "column")


@dataclass(frozen=True)
class CapacityEvent:
    """What happens in a step of a push for the first time.

    Attributes:
        step: the step, 0 is under gravity alone.
        what: "first yield of a beam", ...
        place: name of the member, or `storey 3`; "" where there is none.
    """

    step: int
    what: str
    place: str = ""


@dataclass(frozen=True)
class _Yielding:
    """Strains of the outer layers at the ends of members of a kind, over the yield strain, and plastic rotations.

    Where hinges yield in place of fibres, `strains` has what `_hinge_yield` gives.
    """

    kind: str
    members: tuple[Member, ...]
    strains: Quantity
    rotations: Quantity


class EventChannels:
    """What a push records so that its events can be told.

    Args:
        project: the validated project.
        frame: its model.
        steps: of the push.
    """

    def __init__(self, project: Project, frame: FrameModel, steps: int) -> None:
        self._storeys = q.line_drift_storeys(frame)
        self._drifts = q.line_drifts(frame)
        self._followed = Quantity("event_drift", ("drift",), self._drifts.shape, self._drifts.cells, "1", "", True, ())
        self._yielding = [found for kind in KINDS if (found := _yielding(project, frame, kind))] * (steps <= MOST_STEPS)

    @property
    def quantities(self) -> list[Quantity]:
        """To be recorded; nothing of them is archived."""
        return [self._followed, *(item for one in self._yielding for item in (one.strains, one.rotations))]

    def events(self, response: Response, base_shear: np.ndarray) -> list[CapacityEvent]:
        """Return the events of a push in their order.

        Args:
            response: of the push.
            base_shear: of each step, N, positive in the direction of the push.
        """
        found = []
        for one in self._yielding:
            found += _first(f"first yield of a {one.kind}", one.strains.values(response), 1.0, one.members)
            rotations = one.rotations.values(response)
            found += _first(f"first hinge in a {one.kind}", rotations, ELASTIC_ROTATION, one.members)
        drifts = np.abs(self._followed.values(response))
        for level in PERFORMANCE_LEVELS:
            limit = drift_limits(level).transient
            beyond = np.nonzero(drifts.max(axis=1) > limit)[0]
            if beyond.size:
                storey = self._storeys[int(np.argmax(drifts[beyond[0]]))]
                found.append(CapacityEvent(int(beyond[0]), f"drift of {level}, {100 * limit:g} %", f"storey {storey}"))
        peak = int(np.argmax(base_shear))
        if base_shear[-1] < base_shear[peak] * (1.0 - DESCENT):
            found.append(CapacityEvent(peak, "largest base shear"))
        gone = np.nonzero(base_shear[1:] <= 0.0)[0]
        if gone.size:
            found.append(CapacityEvent(int(gone[0]) + 1, "no resistance left"))
        elif collapse_reason(response, self._drifts, self._storeys):
            found.append(CapacityEvent(base_shear.size - 1, "equilibrium lost"))
        return sorted(found, key=lambda event: event.step)


def store_capacity_events(
    group: Group, events: Sequence[CapacityEvent], displacement: np.ndarray, base_shear: np.ndarray
) -> None:
    """Add events to the results of a push; nothing if there are none.

    Args:
        group: of the push.
        events: in their order.
        displacement: of the control node since gravity in each step, m.
        base_shear: of each step, N.
    """
    if not events:
        return
    at, dims = [event.step for event in events], ("capacity_event",)
    coordinate(group, "capacity_event", np.arange(1, len(events) + 1), "1", "number of the event on the capacity curve")
    group.add("capacity_event_what", dims, [event.what for event in events], "", "what happens for the first time")
    group.add("capacity_event_place", dims, [event.place for event in events], "", "member or storey where it happens")
    group.add("capacity_event_step", dims, at, "1", "step in which it has happened")
    label = "displacement of the control node since gravity"
    group.add("capacity_event_displacement", dims, displacement[at], "m", label)
    group.add("capacity_event_base_shear", dims, base_shear[at], "N", "base shear in the direction of the push")


def _hinge_yield(member: Member, end: int) -> Terms:
    """Plastic rotation of hinges and joints over a millionth of that at yield: 1 where they begin to yield."""
    springs = [spring for spring in member.springs[end] if spring.yields]
    return tuple((1e6 * s.stiffness / s.M_y, "plastic_rotation", s.element, 0) for s in springs)


def _yielding(project: Project, frame: FrameModel, kind: str) -> _Yielding | None:
    members, strains, rotations = [], [], []
    runs = project.frame.members
    last = project.elements.integration_points - 1
    for member in frame.members.values():
        material = project.materials[runs[member.name].material] if member.kind == kind else None
        fibres = material is not None and not isinstance(material, ElasticMaterial) and member.layers is not None
        if material is None or not (fibres or any(spring.yields for end in member.springs for spring in end)):
            continue
        members.append(member)
        for end, point in enumerate((0, last)):
            if fibres:
                assert member.layers is not None and not isinstance(material, ElasticMaterial)
                factor, count = material.E / material.fy, member.layers.size
                for layer in (0, count - 1):
                    cell: Terms = ((factor, "fibre_strain", member.element, point * count + layer),)
                    strains.append(cell)
            else:
                strains += [_hinge_yield(member, end), ()]
            rotations.append(q.plastic_rotation(member, end))
    if not members:
        return None
    shape = (len(members), 2)
    return _Yielding(
        kind,
        tuple(members),
        Quantity(f"event_{kind}_strain", (kind, "layer"), (len(members), 4), tuple(strains), "1", "", True, ()),
        Quantity(f"event_{kind}_rotation", (kind, "end"), shape, tuple(rotations), "rad", "", True, ()),
    )


def _first(what: str, values: np.ndarray, limit: float, members: Sequence[Member]) -> list[CapacityEvent]:
    """The first step in which a value of a member, (steps, members, places), reaches a limit, and which member."""
    largest = np.abs(values).max(axis=2)
    there = np.nonzero(largest.max(axis=1) >= limit)[0]
    if not there.size:
        return []
    return [CapacityEvent(int(there[0]), what, members[int(np.argmax(largest[there[0]]))].name)]
