"""Forces where a frame stands: base shear, reactions of its supports, forces of isolators."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from edesign.archive.dataset import Group
from edesign.frame.frame_model import FrameModel
from edesign.study.results.couples import couple_terms
from edesign.study.results.recording import Quantity, Terms, coordinate, directed


def base_shear(frame: FrameModel, history: bool) -> Quantity:
    """Return the base shear: minus the sum of the horizontal reactions, that of a leaning column included, N.

    Args:
        history: whether values over time are kept.
    """
    cells = []
    for direction in frame.directions:
        along = direction.degree
        supports = [name for name, fixed in frame.supports.items() if fixed[along]]
        reactions = (frame.reaction(name, along) for name in supports)
        terms = tuple((-factor, kind, node, at) for several in reactions for factor, kind, node, at in several)
        if frame.leaning is not None:
            terms += ((-1.0, "reaction", frame.leaning.base, along),)
        cells.append(terms)
    name = "base shear: minus the sum of the horizontal reactions"
    return Quantity("base_shear", *directed(frame), tuple(cells), "N", name, history)


def support_reactions(frame: FrameModel, group: Group, history: bool = True) -> list[Quantity]:
    """Return the reactions of each support, gravity included, and the overturning moment over time.

    A vertical reaction is positive upwards, so that a negative one is uplift. The overturning moment is that of all
    reactions about the point of the base midway between the outer supports, positive for loads to the right, and of the
    couples that dampers lack. The column base of a leaning column is no support of the frame: where it stands is not
    known.

    Args:
        group: of the history, to which the names of the supports are added.
        history: whether they are kept over time; if not, reactions are there to be watched alone.
    """
    supports = frame.supports
    coordinate(group, "support", list(supports), "", "node that is supported")
    if frame.model.dimension == 3:
        return _reactions_in_space(frame, group, history)
    parts = (
        ("support_horizontal_reaction", 0, "N", "horizontal reaction on the frame, positive to the right"),
        ("support_vertical_reaction", 1, "N", "vertical reaction on the frame, positive upwards; negative: uplift"),
        ("support_moment", 2, "N*m", "moment of the support on the frame, anticlockwise"),
    )
    found = [
        Quantity(
            name,
            ("support",),
            (len(supports),),
            tuple(frame.reaction(node, at) if fixed[at] else () for node, fixed in supports.items()),
            unit,
            label,
            history,
            _KEPT if history else (),
        )
        for name, at, unit, label in parts
    ]
    if not history:
        return found
    places = {node: frame.places[node] for node in supports}
    middle = 0.5 * (min(x for x, _ in places.values()) + max(x for x, _ in places.values()))
    terms: Terms = couple_terms(frame)
    for node, fixed in supports.items():
        x, y = places[node]
        arms = (-y, x - middle, 1.0)
        terms += tuple(
            (arm * factor, kind, number, component)
            for at, arm in enumerate(arms)
            if fixed[at] and arm != 0.0
            for factor, kind, number, component in frame.reaction(node, at)
        )
    label = "moment about the middle of the base, anticlockwise, that resists loads to the right"
    found.append(Quantity("overturning_moment", (), (), (terms,), "N*m", label, history=True))
    return found


_KEPT = ("max", "min", "final")
_OF_BUILDINGS = (
    ("horizontal_reaction", "direction", (0, 1), "N", "horizontal reaction on the building"),
    ("vertical_reaction", "", (2,), "N", "vertical reaction on the building, positive upwards; negative: uplift"),
    ("moment", "turn", (3, 4, 5), "N*m", "moment of the support on the building about the axis"),
)


def _reactions_in_space(frame: FrameModel, group: Group, history: bool) -> list[Quantity]:
    """Reactions of a building, and the moment that resists loads along each direction.

    That moment is about the middle of the supports, and with the couples that dampers lack. Positive: it resists loads
    along the direction.
    """
    coordinate(group, "turn", ["rx", "ry", "rz"], "", "turn about the axis")
    found = []
    for name, dimension, degrees, unit, label in _OF_BUILDINGS:
        dims = ("support", dimension) if dimension else ("support",)
        shape = (len(frame.supports), len(degrees))[: len(dims)]
        cells = tuple(
            frame.reaction(node, at) if fixed[at] else () for node, fixed in frame.supports.items() for at in degrees
        )
        kept = _KEPT if history else ()
        found.append(Quantity(f"support_{name}", dims, shape, cells, unit, label, history, kept))
    if not history:
        return found
    plan = [frame.places[node][:2] for node in frame.supports]
    moments = []
    for along in (direction.degree for direction in frame.directions):
        middle = 0.5 * (min(at[along] for at in plan) + max(at[along] for at in plan))
        terms = couple_terms(frame, along)
        for node, fixed in frame.supports.items():
            place = frame.places[node]
            turn, way = (4, -1.0) if along == 0 else (3, 1.0)
            for degree, arm in ((frame.up, place[along] - middle), (along, -place[frame.up]), (turn, way)):
                if fixed[degree] and arm != 0.0:
                    terms += tuple((arm * c, kind, i, at) for c, kind, i, at in frame.reaction(node, degree))
        moments.append(terms)
    label = "moment about the middle of the base that resists loads along the direction"
    return [*found, Quantity("overturning_moment", *directed(frame), tuple(moments), "N*m", label, history=True)]


def isolator_displacements(frame: FrameModel, history: bool) -> list[Quantity]:
    """Return the displacement of each isolator of a building along x and y, m; nothing for other frames.

    Args:
        history: whether values over time are kept.
    """
    if frame.isolated is None or frame.model.dimension == 2:
        return []
    bases = [frame.nodes[isolator.column_base] for isolator in frame.isolated.isolators]
    cells = tuple(((1.0, "displacement", base, axis.degree),) for base in bases for axis in frame.directions)
    shape, label = (len(bases), len(frame.directions)), "horizontal displacement of the isolator"
    return [Quantity("isolator_displacement", ("isolator", "direction"), shape, cells, "m", label, history)]


def isolator_axial_forces(frame: FrameModel, keep: tuple[str, ...] = ("max", "min", "final")) -> list[Quantity]:
    """Return the axial force of each isolator, positive in tension, N; nothing for a frame on its supports.

    Args:
        keep: which of max, min and final are stored.
    """
    if frame.isolated is None:
        return []
    bases = [isolator.column_base for isolator in frame.isolated.isolators]
    cells = tuple(tuple((-c, kind, i, at) for c, kind, i, at in frame.reaction(base, frame.up)) for base in bases)
    name = "axial force of the isolator, positive in tension"
    return [Quantity("isolator_axial_force", ("isolator",), (len(bases),), cells, "N", name, keep=keep)]


EXTREMES = ("most compression", "least compression", "most shear", "most moment")
"""Extremes of the reactions of a support; least compression that is negative is uplift."""


class SupportExtremes:
    """The extremes of the reactions of each support over the steps of a run, each with what acts with it.

    Shear and moment are resultants: of a building of its reactions along x and y, and of moments about them.
    """

    needs = tuple(f"support_{name}" for name in ("vertical_reaction", "horizontal_reaction", "moment"))
    own: tuple[Quantity, ...] = ()

    def __init__(self, frame: FrameModel) -> None:
        self._in_space = frame.model.dimension == 3
        shape = (len(frame.supports), len(EXTREMES))
        self._best, self._at = np.full(shape, -np.inf), np.full(shape, np.nan)
        self._forces = np.zeros((*shape, 6 if self._in_space else 3))

    def see(self, abscissas: np.ndarray, values: Mapping[str, np.ndarray]) -> None:
        """See further steps; see `Observer`."""
        V, H, M = (values[name] for name in self.needs)
        if self._in_space:
            every = np.concatenate([V[..., None], H, M], axis=2)
            shear, moment = (np.hypot(of[..., 0], of[..., 1]) for of in (H, M))
        else:
            every, shear, moment = np.stack([V, H, M], axis=2), np.abs(H), np.abs(M)
        supports = np.arange(V.shape[1])
        for at, extreme in enumerate((V, -V, shear, moment)):
            rows = extreme.argmax(axis=0)
            found = extreme[rows, supports]
            more = np.flatnonzero(found > self._best[:, at])
            self._best[more, at], self._at[more, at] = found[more], abscissas[rows[more]]
            self._forces[more, at] = every[rows[more], more]

    def store(self, group: Group, abscissa: str, unit: str) -> None:
        """Add the extremes, where they occur and what acts with them to the group; see `Observer`."""
        coordinate(group, "support_extreme", list(EXTREMES), "", "extreme of the reactions of the support")
        dims, with_it = ("support", "support_extreme"), "with the extreme of the reactions of the support"
        V, H, M = self._forces[..., 0], self._forces[..., 1], self._forces[..., 2]
        along: tuple[str, ...] = dims
        about: tuple[str, ...] = dims
        if self._in_space:
            H, M = self._forces[..., 1:3], self._forces[..., 3:6]
            along, about = (*dims, "direction"), (*dims, "turn")
        group.add("support_extreme_at", dims, self._at, unit, f"{abscissa} of the extreme")
        group.add("support_extreme_vertical_reaction", dims, V, "N", f"vertical reaction upwards {with_it}")
        group.add("support_extreme_horizontal_reaction", along, H, "N", f"horizontal reaction {with_it}")
        group.add("support_extreme_moment", about, M, "N*m", f"moment of the support {with_it}")
