"""Forces where a frame stands: base shear, reactions of its supports, forces of isolators."""

from __future__ import annotations

from edesign.archive.dataset import Group
from edesign.frame.frame_model import FrameModel
from edesign.study.results.couples import couple_terms
from edesign.study.results.recording import Quantity, Terms, coordinate


def base_shear(frame: FrameModel, history: bool) -> Quantity:
    """Return the base shear: minus the sum of the horizontal reactions, that of a leaning column included, N.

    Args:
        history: whether values over time are kept.
    """
    supports = [name for name, fixed in frame.supports.items() if fixed[0]]
    terms = tuple((-factor, kind, node, at) for name in supports for factor, kind, node, at in frame.reaction(name, 0))
    if frame.leaning is not None:
        terms += ((-1.0, "reaction", frame.leaning.base, 0),)
    name = "base shear: minus the sum of the horizontal reactions"
    return Quantity("base_shear", (), (), (terms,), "N", name, history)


def support_reactions(frame: FrameModel, group: Group) -> list[Quantity]:
    """Return the reactions of each support, gravity included, and the overturning moment over time.

    A vertical reaction is positive upwards, so that a negative one is uplift. The overturning moment is that of all
    reactions about the point of the base midway between the outer supports, positive for loads to the right, and of the
    couples that dampers lack. The column base of a leaning column is no support of the frame: where it stands is not
    known.

    Args:
        group: of the history, to which the names of the supports are added.
    """
    supports = frame.supports
    coordinate(group, "support", list(supports), "", "node that is supported")
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
            history=True,
        )
        for name, at, unit, label in parts
    ]
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


def isolator_axial_forces(frame: FrameModel, keep: tuple[str, ...] = ("max", "min", "final")) -> list[Quantity]:
    """Return the axial force of each isolator, positive in tension, N; nothing for a frame on its supports.

    Args:
        keep: which of max, min and final are stored.
    """
    if frame.isolated is None:
        return []
    bases = [isolator.column_base for isolator in frame.isolated.isolators]
    cells = tuple(tuple((-c, kind, i, at) for c, kind, i, at in frame.reaction(base, 1)) for base in bases)
    name = "axial force of the isolator, positive in tension"
    return [Quantity("isolator_axial_force", ("isolator",), (len(bases),), cells, "N", name, keep=keep)]
