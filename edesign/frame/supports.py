"""Springs and footings under the column bases."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import inf
from typing import TYPE_CHECKING

from edesign.frame.footings import FootingSprings
from edesign.project.frame.supports import VerticalSpring, YieldingRotation, YieldingTranslation

if TYPE_CHECKING:
    from edesign.core import Model, SpringLaw

SpringValues = YieldingTranslation | YieldingRotation
Direction = str | float | SpringValues
Grounds = tuple[int | None, ...]
_WORDS = ("horizontal", "vertical", "rotation")


def support_springs(
    model: Model, name: str, node: int, place: Sequence[float], directions: Sequence[Direction]
) -> Grounds:
    """Add the springs that support a node.

    Args:
        name: of the supported node.
        place: of the node, m.
        directions: what restrains each degree; "fixed" and "free" get no spring.

    Returns:
        For each degree the node of the ground that its spring stands on; None without one.
    """
    ground = model.node(f"{name}.ground", *place)
    model.fix(ground, **dict.fromkeys(model.degrees, True))
    grounds: list[int | None] = []
    for degree, direction in enumerate(directions):
        if isinstance(direction, str):
            grounds.append(None)
            continue
        _spring(model, name, ground, node, degree, _law(direction))
        grounds.append(ground)
    return tuple(grounds)


@dataclass(frozen=True)
class BuiltFooting:
    """A footing in the frame model.

    Attributes:
        springs: what it is.
        dashpots: ids of its dampers in the core, over its motions; None: none acts there.
    """

    springs: FootingSprings
    dashpots: tuple[int | None, ...]


def add_footing(
    model: Model, name: str, node: int, place: Sequence[float], footing: FootingSprings, turns: bool = True
) -> tuple[Grounds, BuiltFooting]:
    """Add a footing under a node: springs, dashpots beside them, and its mass.

    Damping that is proportional to stiffness leaves the springs out: the dashpots have the damping of the soil.

    Args:
        name: of the supported node.
        place: of the node, m.
        turns: whether anything but the footing restrains the rotation of the node; without, a plane frame has it fixed.

    Returns:
        The node of the ground for each degree, and the footing.
    """
    from edesign.core import ContactSpring, LawValues, MultilinearSpring

    ground = model.node(f"{name}.ground", *place)
    model.fix(ground, **dict.fromkeys(model.degrees, True))
    up = model.dimension - 1
    held = [turns or degree <= up for degree in range(len(model.degrees))]
    dashpots: list[int | None] = [None] * len(held)
    for degree in (degree for degree, acts in enumerate(held) if acts):
        lifts = degree == up and footing.uplift
        stiffness = footing.stiffness[degree]
        law = ContactSpring(stiffness, footing.capacity) if lifts else MultilinearSpring(stiffness)
        model.damping_factor(_spring(model, name, ground, node, degree, law), 0.0)
        if footing.dashpot[degree] > 0.0:
            terms = ((1.0, node, degree), (-1.0, ground, degree))
            dashpot = LawValues("viscous", (footing.dashpot[degree],))
            dashpots[degree] = model.damper(f"{name}.{_word(model, degree)}_dashpot", dashpot, terms)
    if footing.mass > 0.0:
        turning = footing.inertia if turns else (0.0,) * len(footing.inertia)
        masses = zip(model.degrees, (*(footing.mass,) * (up + 1), *turning), strict=True)
        model.mass(node, **{f"m{degree.removeprefix('u')}": value for degree, value in masses})
    return tuple(ground if acts else None for acts in held), BuiltFooting(footing, tuple(dashpots))


def _spring(model: Model, name: str, ground: int, node: int, degree: int, law: SpringLaw) -> int:
    degrees = len(model.degrees)
    terms = [0.0] * (2 * degrees)
    terms[degree], terms[degrees + degree] = -1.0, 1.0
    return model.spring(f"{name}.{_word(model, degree)}", ground, node, terms, law)


def _word(model: Model, degree: int) -> str:
    return _WORDS[degree] if model.dimension == 2 else model.degrees[degree]


def vertical_spring(name: str, dimension: int) -> str:
    """Return the name of the element that supports a node vertically, if a spring does.

    Args:
        dimension: of the model, 2 or 3.
    """
    return f"{name}.vertical" if dimension == 2 else f"{name}.uz"


def _law(spring: float | SpringValues) -> SpringLaw:
    from edesign.core import ContactSpring, MultilinearSpring

    if isinstance(spring, float):
        return MultilinearSpring(spring)
    if isinstance(spring, VerticalSpring) and spring.uplift:
        return ContactSpring(spring.stiffness, inf if spring.resistance is None else spring.resistance)
    return MultilinearSpring.bilinear(spring.stiffness, spring.resistance, spring.hardening)
