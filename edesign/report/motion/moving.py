"""A variant in motion, read from a history: its nodes, drifts, hinges, damper forces and loops at each picture."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from edesign.archive.dataset import Group
from edesign.report.motion.geometry import Geometry, floor_shares
from edesign.report.motion.plan_motion import floors_in_plan, storey_drifts
from edesign.report.response.frame_figures import End
from edesign.report.response.histories import History, names_of

FINER = 3
"""Points of a loop for each picture: at 15 a second it would have corners."""
MOST_LOOPS = 12
"""Of a variant that can be chosen, those with the largest deformations."""


@dataclass(frozen=True)
class Loop:
    """A loop whose point moves.

    Attributes:
        label: what it is of.
        x, y: at each picture and `FINER` - 1 times before the next, in the units of the labels.
        x_label, y_label: with units.
    """

    label: str
    x: np.ndarray
    y: np.ndarray
    x_label: str
    y_label: str

    def at(self, pictures: np.ndarray) -> Loop:
        """Return the loop at pictures in equal distances."""
        every = int(pictures[1] - pictures[0]) if len(pictures) > 1 else 1
        points = slice(0, FINER * int(pictures[-1]) + 1, every)
        return replace(self, x=self.x[points], y=self.y[points])


@dataclass(frozen=True)
class Moving:
    """A variant in motion.

    Attributes:
        title: of the variant, "" if it has none.
        analysis: whose results it shows.
        color: of the variant.
        geometry: what moves.
        floors: displacement of base and floors at each picture, (pictures, floors + 1) m; of a building along x and y,
            (pictures, floors + 1, 2).
        nodes: of the nodes (pictures, nodes, 3) m, m, rad, of a building (pictures, nodes, 6); None: not kept.
        drift: of the storeys at each picture (pictures, storeys), ratio; of a building (pictures, storeys, 2).
        drift_max, drift_min: largest and smallest until then, of all samples.
        rotation: largest plastic rotation of an end until then (pictures, ends) rad, ends as `ends`, of a building that
            about the axis about which it is larger; None: not kept.
        ends: ends of members that yield, with their largest plastic rotation of the history, rad.
        limits: of each of `ends`, from which its color is the next, rad.
        force: of each damper in `geometry` at each picture, (pictures, dampers) N; None: not kept.
        strokes: of each tuned mass in `geometry` relative to its floor at each picture, (pictures, masses) m.
        loops: that can be chosen.
        deformation: of each damper as `force`, (pictures, dampers) m; None: not kept.
        plan: of a building whose nodes were not kept, base and floors as rigid bodies: displacements of the origin
            along x and y and turn about the vertical, (pictures, floors + 1, 3) m, m, rad.
    """

    title: str
    analysis: str
    color: str
    geometry: Geometry
    floors: np.ndarray
    nodes: np.ndarray | None
    drift: np.ndarray
    drift_max: np.ndarray
    drift_min: np.ndarray
    rotation: np.ndarray | None
    ends: dict[End, float]
    limits: tuple[tuple[float, ...], ...]
    force: np.ndarray | None
    strokes: np.ndarray
    loops: tuple[Loop, ...]
    deformation: np.ndarray | None = None
    plan: np.ndarray | None = None

    @property
    def reach(self) -> float:
        """The largest displacement of a floor or of a tuned mass, of a building that of a floor or node, m."""
        if self.geometry.in_space:
            return float(max(np.max(np.abs(self.floors)), np.max(np.abs(self.node_motion[..., :3]))))
        return float(np.max(np.abs(np.column_stack((self.floors, self._masses)))))

    @cached_property
    def node_motion(self) -> np.ndarray:
        """Displacements and rotations of the nodes, (pictures, nodes, 3 or 6) m, m, rad.

        Where only floors were kept, nodes move with them, and do not turn but with the floor of a building.
        """
        if self.nodes is not None:
            return self.nodes
        places = list(self.geometry.nodes.values())
        below, share = (np.array(part) for part in zip(*floor_shares(self.geometry.levels, places), strict=True))
        floors = self.floors if self.plan is None else self.plan
        share = share.reshape(-1, *(1,) * (floors.ndim - 2))
        moved = (1.0 - share) * floors[:, below] + share * floors[:, below + 1]
        if self.plan is None:
            return np.stack((moved, np.zeros_like(moved), np.zeros_like(moved)), axis=-1)
        x, y, _ = np.array(places).T
        ux, uy, turn = np.moveaxis(moved, -1, 0)
        none = np.zeros_like(turn)
        return np.stack((ux - turn * y, uy + turn * x, none, none, none, turn), axis=-1)

    @property
    def _masses(self) -> np.ndarray:
        floors = [self.geometry.levels.index(mass.at.at[1]) for mass in self.geometry.masses]
        return np.asarray(self.floors[:, floors] + self.strokes)

    def at(self, pictures: np.ndarray) -> Moving:
        """Return the motion at some pictures, of which the last has the largest values of all samples."""
        largest = np.append(pictures[:-1], len(self.floors) - 1)
        return replace(
            self,
            floors=self.floors[pictures],
            nodes=None if self.nodes is None else self.nodes[pictures],
            drift=self.drift[pictures],
            drift_max=self.drift_max[largest],
            drift_min=self.drift_min[largest],
            rotation=None if self.rotation is None else self.rotation[largest],
            force=None if self.force is None else self.force[pictures],
            deformation=None if self.deformation is None else self.deformation[pictures],
            plan=None if self.plan is None else self.plan[pictures],
            strokes=self.strokes[pictures],
            loops=tuple(loop.at(pictures) for loop in self.loops),
        )


def nearest(group: Group, along: str, time: np.ndarray) -> np.ndarray:
    """Return the positions of the samples nearest to the pictures; after the end the last one.

    Args:
        group: of a history.
        along: the name of its time.
        time: of the pictures, s.
    """
    own = np.asarray(group.coords[along].values, dtype=float)
    after = np.clip(np.searchsorted(own, time), 1, len(own) - 1)
    return np.where(time - own[after - 1] < own[after] - time, after - 1, after)


def read_moving(
    history: History,
    group: Group,
    color: str,
    geometry: Geometry,
    ends: dict[End, float],
    limits: tuple[tuple[float, ...], ...],
    time: np.ndarray,
) -> Moving:
    """Return a variant in motion.

    Args:
        geometry: what moves.
        ends: those that yield, with their largest plastic rotation, rad.
        limits: of each of them, rad.
        time: of the pictures, s.
    """
    at = nearest(group, "time", time)
    displacement = np.asarray(group.variables["floor_displacement"].values, dtype=float)
    base = group.variables.get("base_displacement")
    ground = np.zeros_like(displacement[:, 0]) if base is None else np.asarray(base.values, dtype=float)
    floors = np.concatenate((ground[:, np.newaxis], displacement), axis=1)
    stored = group.variables.get("storey_drift")
    drift = storey_drifts(group, floors) if stored is None else np.asarray(stored.values, dtype=float)
    dampers = names_of(group, "damper")
    own = [dampers.index(damper.name) for damper in geometry.dampers]
    force, deformation = (
        None if (found := group.variables.get(f"damper_{name}")) is None else np.asarray(found.values, dtype=float)
        for name in ("force", "deformation")
    )
    nodes = _nodes(group, geometry, time)
    strokes = np.zeros((len(displacement), 0))
    if geometry.masses:
        strokes = np.asarray(group.variables["tuned_mass_displacement"].values, dtype=float)
    return Moving(
        history.variant,
        history.name,
        color,
        geometry,
        floors[at],
        nodes,
        drift[at],
        np.maximum.accumulate(drift)[at],
        np.minimum.accumulate(drift)[at],
        _rotations(group, ends, time),
        ends,
        limits,
        None if force is None else force[at][:, own],
        strokes[at],
        tuple(_loops(group, nearest(group, "time", _finer(time)))),
        None if deformation is None else deformation[at][:, own],
        floors_in_plan(group, geometry, floors)[at] if geometry.in_space and nodes is None else None,
    )


def _finer(time: np.ndarray) -> np.ndarray:
    """The times of the points of loops."""
    return np.interp(np.arange(FINER * (len(time) - 1) + 1) / FINER, np.arange(len(time)), time)


def _nodes(group: Group, geometry: Geometry, time: np.ndarray) -> np.ndarray | None:
    stored = group.variables.get("node_displacement")
    if stored is None:
        return None
    where = {name: i for i, name in enumerate(names_of(group, "node"))}
    if not all(name in where for name in geometry.nodes):
        return None
    return np.asarray(stored.values, dtype=float)[nearest(group, "motion_time", time)][
        :, [where[n] for n in geometry.nodes]
    ]


def _rotations(group: Group, ends: dict[End, float], time: np.ndarray) -> np.ndarray | None:
    """The largest so far; at the end that of all steps, which the pictures may have missed by little."""
    columns = []
    where = {kind: {name: i for i, name in enumerate(names_of(group, kind))} for kind in ("column", "beam")}
    for (member, end), largest in ends.items():
        kind = "column" if member in where["column"] else "beam"
        stored = group.variables.get(f"{kind}_plastic_rotation")
        if stored is None:
            return None
        values = np.abs(np.asarray(stored.values, dtype=float)[:, where[kind][member], end])
        values = np.maximum.accumulate(values.reshape(len(values), -1).max(axis=1))  # in space about two axes
        values = values[nearest(group, "motion_time", time)]
        values[-1] = max(values[-1], largest)
        columns.append(values)
    if not columns and "beam_plastic_rotation" not in group.variables:
        return None
    return np.column_stack(columns) if columns else np.zeros((len(time), 0))


def _loops(group: Group, at: np.ndarray) -> Iterator[Loop]:
    """Loops of dampers, and moments of recorded members against rotations."""
    deformation, force = (group.variables.get(f"damper_{name}") for name in ("deformation", "force"))
    if deformation is not None and force is not None:
        largest = np.max(np.abs(deformation.values), axis=0)
        chosen = set(np.argsort(-largest, kind="stable")[:MOST_LOOPS].tolist())
        for i, name in enumerate(names_of(group, "damper")):
            if i not in chosen:
                continue
            x, y = 1e3 * deformation.values[at, i], 1e-3 * force.values[at, i]
            what = "isolator" if name in names_of(group, "isolator") else "damper"
            yield Loop(f"{what} {name}", x, y, "deformation (mm)", "force (kN)")
    rotation, moment = (group.variables.get(f"member_{name}") for name in ("chord_rotation", "bending_moment"))
    if rotation is not None and moment is not None and moment.dims[:2] == ("time", "recorded_member"):
        for i, name in enumerate(names_of(group, "recorded_member")):
            for end, word in enumerate(("start", "end")):
                turned, resisted = (np.asarray(of.values)[:, i, end][at].T for of in (rotation, moment))
                about = [f", about {axis}" for axis in names_of(group, "axis")] if turned.ndim > 1 else [""]
                for axis, x, y in zip(about, 1e3 * np.atleast_2d(turned), 1e-3 * np.atleast_2d(resisted), strict=True):
                    if np.any(x):
                        yield Loop(f"{name}, {word}{axis}", x, y, "chord rotation (mrad)", "moment (kN m)")
