"""The mode that leads in a horizontal direction, and modes that turn a building."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from edesign.core import Modes
from edesign.frame.frame_model import Direction, FrameModel

if TYPE_CHECKING:
    from edesign.study.analysis.structure import Structure

CLUSTER = 1e-6
"""Relative distance of frequencies up to which modes are one cluster: within it any turn of them is as good."""
_FIRST_ASKED = 6
"""Modes that are asked for at first in space; as many more follow as may hide one with more mass."""


@dataclass(frozen=True)
class Mode:
    """A natural mode.

    Attributes:
        period: s.
        shape: (n_nodes, 3 or 6), generalised mass 1.
        participation: for ground motion in the direction, sqrt(kg).
    """

    period: float
    shape: np.ndarray
    participation: float


def leading_mode(structure: Structure, direction: Direction, damper_stiffness: np.ndarray | None = None) -> Mode:
    """Return the mode with most effective mass in a direction in the present state; of a plane frame the first one.

    Modes of one frequency, as a building with equal stiffness along both axes has them, are turned within their
    cluster so that one of them has all of its effective mass.

    Args:
        direction: in which the mass counts.
        damper_stiffness: as of `Structure.modes`.

    Raises:
        AnalysisError: there is no mode, or the structure is unstable.
    """
    if not direction.name:
        modes = structure.modes(1, damper_stiffness)
        return _turned(modes, np.array([0]), direction)
    modes, (leading,) = leading_modes(
        lambda count: structure.modes(count, damper_stiffness), 1, structure.most_modes, [direction]
    )
    return _turned(modes, leading, direction)


def leading_modes(
    find: Callable[[int], Modes], least: int, most: int, directions: Sequence[Direction]
) -> tuple[Modes, list[np.ndarray]]:
    """Return the lowest modes in space, and the numbers of those that lead in each direction, from 0.

    They are of one cluster, with most effective mass in the direction. As many modes are asked for as may hide one with
    more.

    Args:
        find: the lowest modes, so many.
        least: how many modes are asked for at least, if there are so many.
        most: how many there are.
    """
    count = min(max(least, _FIRST_ASKED), most)
    while True:
        modes = find(count)
        all_clusters, leading, hidden = clusters(modes.omega), [], False
        for direction in directions:
            ratios = modes.effective_mass_ratio[:, direction.degree]
            cluster = max(all_clusters, key=lambda one: float(ratios[one].sum()))
            hidden |= bool(cluster[-1] == count - 1 or ratios[cluster].sum() < 1.0 - ratios.sum())
            leading.append(cluster)
        if count == most or not hidden:
            return modes, leading
        count = min(2 * count, most)


def torsional_ratios(frame: FrameModel, modes: Modes) -> np.ndarray:
    """Return the part of each mode of a building in turns about the vertical, (n,).

    The effective mass is that for a turn of the ground about the vertical through the centre of all masses, over the
    moment of inertia about it: Chopra, Dynamics of Structures, 13.3.

    Args:
        frame: its model, with rigid floors.
        modes: as the core returns them.
    """
    nodes = [frame.nodes[name] for name in frame.masses]
    mass = np.array(list(frame.masses.values()))
    polar = np.array([frame.turning.get(name, 0.0) for name in frame.masses])
    plan = np.array([frame.places[name][:2] for name in frame.masses])
    x, y = (plan - np.average(plan, axis=0, weights=mass)).T
    along_x, along_y, turn = (modes.shapes[:, nodes, degree] for degree in (0, 1, 5))
    taking_part = (mass * (x * along_y - y * along_x) + polar * turn).sum(axis=1)
    return np.asarray(taking_part**2 / float(np.sum(mass * (x**2 + y**2) + polar)))


def clusters(omega: np.ndarray) -> list[np.ndarray]:
    """Return the numbers of modes from 0, those of one frequency together.

    Args:
        omega: their circular frequencies, ascending, (n,) rad/s.
    """
    apart = np.diff(omega) > CLUSTER * omega[1:]
    return np.split(np.arange(omega.size), np.flatnonzero(apart) + 1)


def _turned(modes: Modes, cluster: np.ndarray, direction: Direction) -> Mode:
    first, factors = int(cluster[0]), modes.participation[cluster, direction.degree]
    period = float(modes.period[first])
    if cluster.size == 1:
        return Mode(period, modes.shapes[first], float(factors[0]))
    whole = float(np.linalg.norm(factors))
    return Mode(period, np.tensordot(factors / whole, modes.shapes[cluster], axes=1), whole)
