"""Tuned masses on floors, and tanks as such."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from edesign.core import LawValues, Model, MultilinearSpring
from edesign.frame.device_places import Term


@dataclass(frozen=True)
class Attached:
    """A tuned mass on a floor, m in kg, k in N/m, c in N s/m.

    Attributes:
        direction: degree of the core that it moves along.
        at: of a building, the column line that it stands on; "": the centre of mass.
    """

    name: str
    floor: int
    mass: float
    stiffness: float
    damping: float
    direction: int = 0
    at: str = ""


def add_attachment(model: Model, attached: Attached, node: int, place: Sequence[float]) -> tuple[Term, ...]:
    """Add a tuned mass to its floor, with its inertia along its direction alone.

    Args:
        node: of the floor, number in the core; of a rigid floor in space its master.
        place: coordinates of the mass, m.

    Returns:
        Its displacement relative to the floor: coefficients, nodes and degrees of the core.
    """
    mass, along = model.node(attached.name, *place), attached.direction
    spring = f"{attached.name}_spring"
    stroke: tuple[Term, ...] = ((1.0, mass, along), (-1.0, node, along))
    if model.dimension == 2:
        model.tie(mass, node, uy=True, rz=True)
        model.mass(mass, attached.mass)
        model.link(spring, node, mass, (attached.stiffness, 0.0, 0.0))
    else:
        model.fix(mass, **{name: degree != along for degree, name in enumerate(model.degrees)})
        model.mass(mass, *(attached.mass if degree == along else 0.0 for degree in range(2)))
        across, turn = 1 - along, model.degrees.index("rz")
        lever = place[across] - model.node_places[node][across]
        if lever != 0.0:
            stroke = (*stroke, (lever if along == 0 else -lever, node, turn))
        terms = np.zeros((2, len(model.degrees)))
        for coefficient, at, degree in stroke:
            terms[int(at == mass), degree] = coefficient
        model.spring(spring, node, mass, terms.ravel().tolist(), MultilinearSpring(attached.stiffness))
    if attached.damping > 0.0:
        model.damper(f"{attached.name}_dashpot", LawValues("viscous", (attached.damping,)), stroke)
    return stroke
