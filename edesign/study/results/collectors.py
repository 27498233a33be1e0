"""Axial forces that beams collect from dampers, braces and columns, by equilibrium of their floor.

Floors that are rigid leave no axial force in the beams of a model. The rule is that of the elastic design of buildings
(`edesign.space.analysis.bracing`): what pulls at the joined beams of a frame and floor is held by the floor, evenly
along them. Here columns pull too, with the change of their shear at the floor, so that the floor brings its inertia
and what stands beside the frame. Beams count that dampers or braces meet, and those joined to them.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator, Sequence

import numpy as np
from scipy.sparse import csr_array

from edesign.frame.devices import Device
from edesign.frame.frame_model import FrameModel, Member, Terms
from edesign.project.frame.frame import Frame
from edesign.space.analysis.bracing import axial_by_pulls
from edesign.space.structure.model import TENSION_ONLY_SHARE
from edesign.study.results.recording import Quantity

_SAME_PLACE = 1e-6
"""m between nodes that are one."""
Pulls = dict[float, list[tuple[int, float]]]
"""By place along a run of beams: channels, and the pull of a unit of each."""


class Collectors:
    """The beams of a frame that collect forces, and what is watched for these.

    A chevron whose damper pushes the beam above has its force in the middle of that beam, which is one member in the
    model: its axial force jumps there. Of a pair of braces of which one is in tension at a time that one has the force
    of both. Dampers of the kind `storey` act where the model has them, half at each end of their bay.

    Attributes:
        beams: that collect, in the order in which `axial` has them.
        jumping: numbers of those among `beams` whose force jumps in their middle.
        quantity: pulls and forces of braces, for the core; None: no beam collects.
    """

    def __init__(self, frame: FrameModel) -> None:
        self._frame = frame
        self._cells: list[Terms] = []
        self._channel: dict[tuple[object, ...], int] = {}
        self.beams: list[Member] = []
        ends: list[dict[int, float]] = []
        inside: list[dict[int, float]] = []
        jumping: list[int] = []
        self._named = {node: name for name, node in frame.nodes.items()}
        self._members: defaultdict[str, list[Member]] = defaultdict(list)  # columns and braces by their nodes
        self._devices: defaultdict[str, list[Device]] = defaultdict(list)
        for member in frame.members.values():
            if member.kind != "beam":
                self._members[member.start].append(member)
                self._members[member.end].append(member)
        for device in frame.devices:
            if device.column_base:
                continue
            for node in dict.fromkeys(node for _, node, _ in device.terms):
                self._devices[self._named[node]].append(device)
        for axis, run in _runs(frame):
            pulls = self._pulls(axis, run)
            if not pulls:
                continue
            places = sorted(pulls)
            channels = sorted({channel for at in pulls.values() for channel, _ in at})
            of_run = np.zeros((len(places), len(channels)))
            for row, place in zip(of_run, places, strict=True):
                for channel, pull in pulls[place]:
                    row[channels.index(channel)] += pull
            stretches = [
                [dict(zip(channels, end, strict=True)) for end in stretch]
                for stretch in axial_by_pulls(of_run, np.array(places)).tolist()
            ]
            for beam in run:
                first, last = (places.index(frame.places[node][axis]) for node in (beam.start, beam.end))
                if last - first > 1:
                    jumping.append(len(self.beams))
                    inside += [stretches[first][1], stretches[last - 1][0]]
                self.beams.append(beam)
                ends += [stretches[first][0], stretches[last - 1][1]]
        self.jumping = np.array(jumping, dtype=int)
        self._pairs = np.array([key[0] == "pair" for key in self._channel], dtype=bool)
        rows = [*ends, *inside]
        entries = [(value, (row, channel)) for row, of in enumerate(rows) for channel, value in of.items()]
        values, at = zip(*entries, strict=True) if entries else ((), ())
        self._matrix = csr_array((values, tuple(zip(*at, strict=True)) or ((), ())), (len(rows), len(self._cells)))
        label = "horizontal pull at the beams of a floor, or force of a brace of which one of a pair is in tension"
        cells = tuple(self._cells)
        self.quantity = (
            Quantity("collected_pull", ("collected_pull",), (len(cells),), cells, "N", label, keep=(), watched=True)
            if self.beams
            else None
        )

    def axial(self, pulls: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Return the axial forces of the beams beyond those of the model, tension positive, N.

        Args:
            pulls: (n, channels) of n steps.

        Returns:
            (n, beams, 2) at both ends, and (n, jumping, 2) on both sides of the middle.
        """
        if self._pairs.any():
            pulls = np.where(self._pairs, np.maximum(pulls, 0.0) / TENSION_ONLY_SHARE, pulls)
        found = (self._matrix @ pulls.T).T.reshape(len(pulls), -1, 2)
        return found[:, : len(self.beams)], found[:, len(self.beams) :]

    def _of(self, *key: object, terms: Terms) -> int:
        """The number of a channel, which is added if it is new."""
        if key not in self._channel:
            self._channel[key] = len(self._cells)
            self._cells.append(terms)
        return self._channel[key]

    def _pulls(self, axis: int, run: Sequence[Member]) -> Pulls:
        """What pulls at a run of beams; nothing where neither damper nor brace meets it."""
        frame = self._frame
        nodes = [run[0].start, *(beam.end for beam in run)]
        rigid = self._rigid(run)
        held: defaultdict[float, Terms] = defaultdict(tuple)  # linear terms of each place
        found: Pulls = {frame.places[node][axis]: [] for node in nodes}
        met = False
        for device in {one.number: one for node in nodes for one in self._devices.get(node, ())}.values():
            for place, pull in self._of_device(device, axis, nodes, rigid):
                held[place] += ((pull, "damper_force", device.number, 0),)
                met = True
        for node in nodes:
            place = frame.places[node][axis]
            for member in self._members.get(node, ()):
                end = int(member.end == node)
                along = frame.places[member.end][axis] - frame.places[member.start][axis]
                braces = member.kind == "brace" and abs(along) > _SAME_PLACE
                met = met or braces
                if braces and _one_of_a_pair(member):
                    terms: Terms = ((1.0, "axial_force", member.element, 0),)
                    pull = (1.0 - 2.0 * end) * along / member.length
                    found[place].append((self._of("pair", member.name, terms=terms), pull))
                    if not rigid:  # the model has the force of both of the pair
                        found[place].append((self._of("model", member.name, terms=terms), -pull))
                elif rigid:
                    component = axis + end * len(frame.model.degrees)
                    held[place] += ((-1.0, "global_force", member.at_end(end), component),)
        if not met:
            return {}
        for place, sums in held.items():
            found.setdefault(place, []).append((self._of("place", axis, *nodes, place, terms=sums), 1.0))
        return found if any(found.values()) else {}

    def _rigid(self, run: Sequence[Member]) -> bool:
        """Whether the floor leaves no axial force in the beams of the model."""
        frame, model = self._frame, self._frame.model
        start = run[0].start
        if model.dimension == 3:
            return model.masters.get(frame.nodes[start]) is not None
        level = frame.places[start][-1]
        assert isinstance(frame.grid, Frame)
        return any(abs(frame.grid.levels[floor] - level) < _SAME_PLACE for floor in frame.grid.diaphragm_floors)

    def _of_device(self, device: Device, axis: int, nodes: Sequence[str], rigid: bool) -> Iterator[tuple[float, float]]:
        """Places along a run at which a damper that pulls with 1 acts, and its pulls there."""
        places = self._frame.places
        forces: defaultdict[str, float] = defaultdict(float)
        for coefficient, node, degree in device.terms:
            if degree == axis and self._named[node] in nodes:
                forces[self._named[node]] -= coefficient
        low = min(places[self._named[node]][-1] for _, node, _ in device.terms)
        above = [name for name in forces if device.stands == "chevron" and places[name][-1] > low + _SAME_PLACE]
        if len(above) == 2:
            total, ends = sum(forces.pop(name) for name in above), [places[name][axis] for name in above]
            middle, known = 0.5 * sum(ends), [places[name][axis] for name in nodes]
            yield min((x for x in known if abs(x - middle) < _SAME_PLACE), default=middle), total
            if not rigid:  # the model has half of it at each end
                yield from ((end, -0.5 * total) for end in ends)
        if rigid:
            yield from ((places[name][axis], force) for name, force in forces.items() if force != 0.0)


def _one_of_a_pair(brace: Member) -> bool:
    """Whether a brace does not count in compression, and has half of its area in the model."""
    return brace.bar is not None and not brace.bar.compression and brace.yield_elongation is None


def _runs(frame: FrameModel) -> Iterator[tuple[int, list[Member]]]:
    """The beams that are joined end to end along an axis, with the coordinate along it."""
    after: dict[tuple[int, str], Member] = {}
    for beam in frame.of_kind("beam"):
        first, last = (np.array(frame.places[node]) for node in (beam.start, beam.end))
        after[int(np.argmax(np.abs(last - first)[: frame.up])), beam.start] = beam
    joined = {(axis, beam.end) for (axis, _), beam in after.items()}
    for (axis, start), beam in after.items():
        if (axis, start) in joined:
            continue
        run = [beam]
        while following := after.get((axis, run[-1].end)):
            run.append(following)
        yield axis, run
