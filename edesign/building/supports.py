"""Springs under the feet of the columns."""

from __future__ import annotations

from collections.abc import Sequence
from math import inf
from typing import TYPE_CHECKING

from edesign.project.frame.supports import VerticalSpring, YieldingRotation, YieldingTranslation

if TYPE_CHECKING:
    from edesign.core import Model, SpringLaw

SpringValues = YieldingTranslation | YieldingRotation
Direction = str | float | SpringValues
_DIRECTIONS = ("horizontal", "vertical", "rotation")


def support_springs(
    model: Model, name: str, node: int, place: tuple[float, float], directions: Sequence[Direction]
) -> tuple[int | None, int | None, int | None]:
    """Add the springs that hold a node.

    Args:
        model: of the core.
        name, node, place: of the supported node, m.
        directions: what holds ux, uy, rz; "fixed" and "free" get no spring.

    Returns:
        For each degree the node of the ground that its spring stands on; None without one.
    """
    ground = model.node(f"{name}.ground", *place)
    model.fix(ground, True, True, True)
    grounds: list[int | None] = []
    for degree, direction in enumerate(directions):
        if isinstance(direction, str):
            grounds.append(None)
            continue
        terms = [0.0] * 6
        terms[degree], terms[3 + degree] = -1.0, 1.0
        model.spring(f"{name}.{_DIRECTIONS[degree]}", ground, node, terms, _law(direction))
        grounds.append(ground)
    return grounds[0], grounds[1], grounds[2]


def vertical_spring(name: str) -> str:
    """Return the name of the element that supports a node vertically, if a spring does."""
    return f"{name}.vertical"


def _law(spring: float | SpringValues) -> SpringLaw:
    from edesign.core import ContactSpring, MultilinearSpring

    if isinstance(spring, float):
        return MultilinearSpring(spring)
    if isinstance(spring, VerticalSpring) and spring.uplift:
        return ContactSpring(spring.stiffness, inf if spring.resistance is None else spring.resistance)
    return MultilinearSpring.bilinear(spring.stiffness, spring.resistance, spring.hardening)
