"""Forces that braces bring to the columns and beams of their frames, by equilibrium.

In a linear model two diagonals of half the area stand for one in tension, and the beams of a rigid floor have no axial
force. What follows from both is made good here, for each sense of the earthquake:

- Of the braces that count in tension only those in tension act, with twice the force of the model. The vertical
  components of the differences go down the column lines.
- The horizontal components of the braces above and below a floor go into the beams of their frame at its nodes. What
  is left over comes from the floor, evenly along the length of these beams: they are its collectors. Where the floor
  is not rigid the model has their forces, but for those of the diagonals in tension alone.

Source: EN 1998-1:2004, 6.7.2(2)P and 6.7.4(1).
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from edesign.core.space import combine
from edesign.space.analysis.response import STATIONS
from edesign.space.structure.frame import AXES, NO_DIAPHRAGM, Member, SpaceFrame
from edesign.space.structure.model import TENSION_ONLY_SHARE

SENSES = (1.0, -1.0)
"""Of an earthquake along an axis: with it, and against it."""
_N = 0  # place in internal forces


@dataclass(frozen=True)
class Bracing:
    """The braces of a frame, and the forces that they bring to columns and beams; sections do not change it.

    Attributes:
        braces: (b,) numbers of the braces.
        axis: (b,) 0 of those along x, 1 along y.
        in_tension: (2, b) whether a brace is in tension in a sense of `SENSES`: it rises that way.
        share: (2, b) force of each brace over that in the linear model, in either sense: 1 of those that count in
            compression; of the others 2 in tension and 0 else.
        columns: (c,) numbers of the columns.
        to_columns: (c, b) axial force of a column by a unit of tension in a brace, whose ends load the column lines.
        collectors: (h,) numbers of the beams in whose frame and floor braces meet.
        in_model: (h,) whether the linear model has their axial force already: their floor is not rigid.
        to_collectors: (h n_stations, b) axial force of the beams at `STATIONS` by a unit of tension in a brace.
        halves: numbers of the beams that chevrons or V braces meet, each of which is two members; none with a link.
        middles: numbers of the nodes between them.
        span: (n_members,) length of members, of halves that of the whole beam, m; braces support a beam with a link.
    """

    braces: np.ndarray
    axis: np.ndarray
    in_tension: np.ndarray
    share: np.ndarray
    columns: np.ndarray
    to_columns: np.ndarray
    collectors: np.ndarray
    in_model: np.ndarray
    to_collectors: np.ndarray
    halves: np.ndarray
    middles: np.ndarray
    span: np.ndarray

    def axial_forces(self, internal: np.ndarray, axial: np.ndarray, rho: np.ndarray) -> np.ndarray:
        """Return the combined internal forces with the axial forces of columns and collectors in the worse sense.

        Args:
            internal: (n_members, n_stations, 6) combined, of the linear model.
            axial: (k, n_members) axial force in each mode of the linear model, N, tension positive.
            rho: (k, k) correlation of the modes, scaled by their amplitudes.

        Returns:
            In the shape of `internal`, N and N m.
        """
        if not self.braces.size:
            return internal
        found = internal.copy()
        force = axial[:, self.braces]
        if self.collectors.size:
            there = np.repeat(axial[:, self.collectors].T, internal.shape[1], axis=0)
            there -= np.repeat(self.in_model, internal.shape[1])[:, None] * (self.to_collectors @ force.T)
            shares = self.share if (self.share != 1.0).any() else self.share[:1]
            each = [combine(there + self.to_collectors @ (force * share).T, rho) for share in shares]
            found[self.collectors, :, _N] = np.max(each, axis=0).reshape(self.collectors.size, -1)
        if (self.share != 1.0).any():
            model = axial[:, self.columns].T
            each = [combine(model + self.to_columns @ (force * more).T, rho) for more in self.beyond_the_model()]
            found[self.columns, :, _N] = np.max(each, axis=0)[:, None]
        return found

    def under_static(self, internal: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Return the internal forces of static cases with what braces bring to columns and beams, with their sign.

        Of braces that count in tension those in tension have the force of both.

        Args:
            internal: (c, n_members, n_stations, 6) of the linear model.

        Returns:
            In the shape of `internal`, N and N m; the force of each brace beyond that of the linear model, (c, b) N.
        """
        force = internal[:, self.braces, 0, _N]
        both = (self.share == 1.0).all(axis=0)
        acting = np.where(both, force, np.maximum(force, 0.0) / TENSION_ONLY_SHARE)
        beyond = acting - force
        if not self.braces.size:
            return internal, beyond
        found = internal.copy()
        N = found[..., _N]
        N[:, self.braces] = acting[:, :, None]
        N[:, self.columns] += (beyond @ self.to_columns.T)[:, :, None]
        if self.collectors.size:
            shape = len(internal), self.collectors.size, -1
            more = acting @ self.to_collectors.T
            more -= np.repeat(self.in_model, internal.shape[2]) * (force @ self.to_collectors.T)
            N[:, self.collectors] += more.reshape(shape)
        return found, beyond

    def beyond_the_model(self) -> list[np.ndarray]:
        """Return the force of each brace beyond that of the linear model, over it, (b,), by senses along x and y."""
        if not (self.share != 1.0).any():
            return [np.zeros(self.braces.size)]
        along_x = self.axis == 0
        senses = ((0, 0), (0, 1), (1, 0), (1, 1))
        return [np.where(along_x, self.share[x], self.share[y]) - 1.0 for x, y in senses]


def bracing(frame: SpaceFrame) -> Bracing:
    """Return what the braces of a frame bring to its columns and beams."""
    members = frame.members
    braces = np.array([number for number, member in enumerate(members) if member.kind == "brace"], dtype=int)
    axis = np.array([AXES.index(members[number].frame[0][0].lower()) for number in braces], dtype=int)
    start, end = (nodes[braces] for nodes in frame.ends)
    along = (frame.coordinates[end] - frame.coordinates[start]) / frame.length[braces, None]
    cosine, sine = along[np.arange(braces.size), axis], along[:, 2]
    in_tension = np.array([cosine * sense > 0.0 for sense in SENSES])
    share = np.where(frame.in_compression[braces], 1.0, in_tension / TENSION_ONLY_SHARE)
    middles = _middles(frame)
    collectors, to_collectors = _collectors(frame, braces, cosine)
    halves = sorted(number for pair in middles.values() for number in pair)
    span = frame.length.copy()
    for first, second in middles.values():
        span[[first, second]] = frame.length[first] + frame.length[second]
    return Bracing(
        braces=braces,
        axis=axis,
        in_tension=in_tension,
        share=share,
        columns=frame.columns,
        to_columns=_to_columns(frame, braces, sine, middles),
        collectors=collectors,
        in_model=frame.node_diaphragm[frame.ends[0][collectors]] == NO_DIAPHRAGM,
        to_collectors=to_collectors,
        halves=np.array(halves, dtype=int),
        middles=np.array(sorted(middles), dtype=int),
        span=span,
    )


def _middles(frame: SpaceFrame) -> dict[int, tuple[int, int]]:
    """Return the nodes in the middle of a beam that braces meet, and the two members of that beam."""
    in_columns = {node for number in frame.columns for node in (frame.members[number].start, frame.members[number].end)}
    ends = {(node, of.frame[0]) for of in frame.members if of.kind == "brace" for node in (of.start, of.end)}
    beams = [(number, of) for number, of in enumerate(frame.members) if of.kind == "beam" and not of.eccentric]
    before = {of.end: n for n, of in beams if of.end not in in_columns and (of.end, of.frame[0]) in ends}
    after = {of.start: n for n, of in beams if (of.start, of.frame[0]) in ends}
    return {node: (number, after[node]) for node, number in before.items() if node in after}


def _to_columns(
    frame: SpaceFrame, braces: np.ndarray, sine: np.ndarray, middles: dict[int, tuple[int, int]]
) -> np.ndarray:
    """Return the force of each column by a unit of tension in each brace: what pulls at its line above it."""
    top = np.array([frame.members[number].end for number in frame.columns], dtype=int)
    lines, tops = frame.coordinates[top, :2], frame.level_of_nodes[top]
    found = np.zeros((frame.columns.size, braces.size))
    for column, number in enumerate(braces):
        member = frame.members[number]
        for node, down in ((member.end, sine[column]), (member.start, -sine[column])):
            halves = middles.get(node)
            at = [node] if halves is None else [frame.members[halves[0]].start, frame.members[halves[1]].end]
            for support in at:
                same = np.abs(lines - frame.coordinates[support, :2]).max(axis=1, initial=0.0) < 1e-9 * frame.levels[-1]
                found[same & (tops <= frame.level_of_nodes[support]), column] -= down / len(at)
    return found


def _collectors(frame: SpaceFrame, braces: np.ndarray, cosine: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return the beams that collect the forces of braces, and their axial force by a unit of tension in each brace."""
    ends: dict[int, list[tuple[int, float]]] = {}
    for column, number in enumerate(braces):
        member = frame.members[number]
        ends.setdefault(member.start, []).append(
            (column, cosine[column])
        )  # a brace in tension pulls towards its middle
        ends.setdefault(member.end, []).append((column, -cosine[column]))
    collectors: list[int] = []
    rows: list[np.ndarray] = []
    for run in joined_beams(frame):
        beams = [frame.members[number] for number in run]
        nodes = [beams[0].start, *(beam.end for beam in beams)]
        pull = np.zeros((len(nodes), braces.size))
        for place, node in enumerate(nodes):
            for column, force in ends.get(node, ()):
                if beams[0].frame[0] == frame.members[braces[column]].frame[0]:
                    pull[place, column] += force
        if not pull.any():
            continue
        places = np.concatenate([[0.0], np.cumsum(frame.length[run])])
        for number, (start, end) in zip(run, axial_by_pulls(pull, places), strict=True):
            collectors.append(number)
            rows.append(start + STATIONS[:, None] * (end - start))
    stacked = np.concatenate(rows) if rows else np.zeros((0, braces.size))
    return np.array(collectors, dtype=int), stacked


def axial_by_pulls(pull: np.ndarray, places: np.ndarray) -> np.ndarray:
    """Return the axial forces of joined beams under pulls at their nodes, which the floor holds evenly along them.

    Args:
        pull: (n, k) horizontal force on each node along the beams in k cases, N.
        places: (n,) of the nodes along the beams, which rise, m.

    Returns:
        (n - 1, 2, k) N at the start and the end of each stretch between nodes, tension positive.
    """
    along = (places - places[0])[:, None]
    total, before = pull.sum(axis=0), np.cumsum(pull, axis=0)[:-1]
    from_floor = -total / along[-1]
    return -np.stack([before + along[:-1] * from_floor, before + along[1:] * from_floor], axis=1)


def joined_beams(frame: SpaceFrame) -> Iterator[list[int]]:
    """Yield the beams of each frame and floor that are joined end to end, by their numbers."""
    lines: dict[tuple[str, int], list[tuple[int, Member]]] = {}
    for number, member in enumerate(frame.members):
        if member.kind == "beam":
            lines.setdefault((member.frame[0], member.storey), []).append((number, member))
    for (name, _), beams in lines.items():
        axis = AXES.index(name[0].lower())
        beams.sort(key=lambda of: float(frame.coordinates[of[1].start, axis]))
        run: list[int] = []
        for number, member in beams:
            if run and frame.members[run[-1]].end != member.start:
                yield run
                run = []
            run.append(number)
        yield run
