"""Dampers of a building as elements between its nodes, which are apart.

Nodes of rigid floors are tied to the centre of mass already, so that no copies can be tied to them, as in plane frames.
The elements measure displacements since they are set in; `twoNodeLink` would measure those under gravity too.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Mapping

import numpy as np

from edesign.exchange.opensees.bearings import FORCE_BALANCE, UPRIGHT, bearing, pendulum
from edesign.exchange.opensees.commands import Command, command
from edesign.exchange.opensees.dampers import CLOSE, DamperBuilder, Dampers, Direction, Terms
from edesign.exchange.opensees.materials import OTHER_LAW, Material, NoSuchMaterial, spring_material
from edesign.exchange.opensees.structure import NotTranslated, Structure
from edesign.exchange.recorded_model import Call

UP = 2
"""Degree of the core along the vertical."""
_NONE: Material = ("Elastic", 0.0)
"""What bearings resist in other directions: the supports of the file are there."""


class SpaceDampers(DamperBuilder):
    """Makes the commands of dampers of a building; arguments as of `DamperBuilder`."""

    TURNS = (3, 4, 5)
    DIRECTIONS = (1, 2, 3)

    def __init__(self, structure: Structure, largest: float) -> None:
        super().__init__(structure, largest)
        self._standing: dict[str, tuple[int, int, Material, Direction]] = {}

    def springs(self, stiffness: Mapping[str, float]) -> list[Command]:
        """Return linear springs as `DamperBuilder` does, and what bearings carry vertically."""
        commands = super().springs(stiffness)
        for name, (ground, node, material, up) in self._standing.items():
            if name in stiffness:
                self._spring(name, ground, node, material, up, commands)
        return commands

    def _damper(self, call: Call, found: Dampers) -> None:
        if call["across"] is None:
            super()._damper(call, found)
            if call["carries"]:
                self._to.below[call.result] = self._ends_of[call["name"]][0]
            return
        (_, node, _), s = call["terms"][0], self._to
        try:
            if call["pressed_by"] is None:
                ground = self._ground(call["name"], node)
                kind, *words = bearing(call["law"], call["force_scale"], call["deformation_scale"])
                material = _NONE
            else:
                spring, weight = call["pressed_by"]
                ground, material = s.pressing[spring]["i"], spring_material(s.pressing[spring]["law"])
                self._standing[call["name"]] = ground, node, material, Direction(UP + 1)
                model, rest = pendulum(call["law"], call["force_scale"], weight)
                tag = s.tags.next("friction")
                found.carrying.append(command("frictionModel", model[0], tag, *model[1:], comment=call["name"]))
                kind, *words = "singleFPBearing", tag, *rest
        except NoSuchMaterial as error:
            raise NotTranslated(call["name"], str(error)) from error
        ends: list[str | int] = []
        for key, one in (("-P", material), ("-T", _NONE), ("-My", _NONE), ("-Mz", _NONE)):
            ends += [key, s.tags.next("material")]
            found.carrying.append(command("uniaxialMaterial", one[0], ends[-1], *one[1:], comment=call["name"]))
        pair = s.nodes[ground], s.nodes[node]
        words = [s.tags.next("element"), *pair, *words, *ends, *UPRIGHT]
        words += FORCE_BALANCE if call["pressed_by"] else ()
        found.carrying.append(command("element", kind, *words, comment=call["name"]))
        both = (call["name"], call["terms"]), call["across"]
        for number, (name, ((_, _, degree),)) in enumerate(both, call.result):
            self._ends_of[name], s.below[number] = (ground, node, Direction(degree + 1)), ground

    def _ground(self, name: str, node: int) -> int:
        ground = self._to.add_node(f"{name}, ground", self._to.places[node])
        for at in range(len(self._to.joined.degrees)):
            self._to.joined.fix((ground, at))
        return ground

    def _ends(self, name: str, terms: Terms, found: Dampers) -> tuple[int, int, Direction]:
        """Nodes whose distance in a direction is the deformation, and this direction."""
        s = self._to
        of: dict[int, np.ndarray] = defaultdict(lambda: np.zeros(len(s.joined.degrees)))
        for coefficient, node, degree in terms:
            of[node][degree] += coefficient
        if len(terms) == 1 and terms[0][0] == 1.0:  # beside isolators
            _, node, degree = terms[0]
            return self._ground(name, node), node, Direction(degree + 1)
        if len(of) == 2:
            (end, ahead), (start, behind) = of.items()
            if np.allclose(ahead, -behind, atol=CLOSE) and not ahead[3:].any():
                return start, end, _along(ahead[:3])
            turns = np.flatnonzero(ahead)
            if np.allclose(ahead, -behind, atol=CLOSE) and turns.size == 1 and ahead[turns[0]] == 1.0:
                return start, end, Direction(int(turns[0]) + 1)  # of a footing that rocks or twists
        ends = [(node, int(np.argmax(np.abs(of[node][:UP])))) for node in of]
        top, low = ([node for node, at in ends if way * of[node][at] > 0.0] for way in (1.0, -1.0))
        if len(top) != 2 or len(low) != 2 or any(values[3:].any() for values in of.values()):
            raise NotTranslated(
                name, f"it couples displacements as no element of OpenSees does; {OTHER_LAW} [E-OPS-02]"
            )
        across = ends[0][1]
        if not (self._as_one(top) and self._as_one(low)):
            raise NotTranslated(
                name, f"it moves with the mean of nodes that no rigid floor holds together; {OTHER_LAW} [E-OPS-02]"
            )
        axis = np.eye(3)[across]
        if not any(of[node][UP] for node in low):
            return low[0], top[0], _along(axis)
        first, last = sorted(top, key=lambda node: s.places[node][across])
        middle = tuple((0.5 * (np.array(s.places[first]) + s.places[last])).tolist())
        apex = self._apex(name, low, middle, found, (1 - across, *self.TURNS))
        return apex, last, _along(axis)

    def _as_one(self, nodes: list[int]) -> bool:
        """Whether nodes move alike along their line: on one rigid floor, or all supported."""
        floors = [master for master, on in self._to.joined.masters.items() if set(nodes) <= set(on)]
        return bool(floors) or all(self._to.joined.is_fixed((node, at)) for node in nodes for at in range(UP))


def _along(axis: np.ndarray) -> Direction:
    """The direction of an axis, with another one at right angles to it."""
    other = np.cross(axis, np.eye(3)[int(np.argmin(np.abs(axis)))])
    other /= np.linalg.norm(other)
    return Direction(1, ("-orient", *axis.tolist(), *other.tolist()))
