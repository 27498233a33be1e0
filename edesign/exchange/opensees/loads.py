"""The loads of the gravity combination as commands of OpenSees."""

from __future__ import annotations

from collections.abc import Mapping
from math import dist

from edesign.exchange.opensees.commands import command
from edesign.exchange.opensees.fixed_ends import released_flexibility_loads
from edesign.exchange.opensees.structure import NotTranslated, Structure
from edesign.exchange.recorded_model import Call
from edesign.frame.loads import MemberLoads, Stretches


class LoadBuilder:
    """Makes the commands of recorded loads.

    Args:
        structure: that is filled.
        pieces: by element of the core, the tags of its parts and their lengths.
        calls: that added the elements, by element.
        elastic: E A, E I and in space further stiffnesses of elastic sections by section, N and N m2.
        without: the flexibility that an element lacks for hinges at its ends, by element.
    """

    def __init__(
        self,
        structure: Structure,
        pieces: Mapping[int, tuple[list[int], Stretches]],
        calls: Mapping[int, Call],
        elastic: Mapping[int, tuple[float, ...]],
        without: Mapping[int, tuple[float, float]],
    ) -> None:
        self._to, self._pieces, self._calls = structure, pieces, calls
        self._elastic, self._without = elastic, without

    def add(self, call: Call) -> bool:
        """Add what a call added to the core if it is a load, and say whether it is one.

        Raises:
            NotTranslated: OpenSees lacks such a load.
        """
        make = getattr(self, f"_{call.name}", None)
        if make is not None:
            make(call)
        return make is not None

    def _nodal_load(self, call: Call) -> None:
        names = (("f" if degree[0] == "u" else "m") + degree[1] for degree in self._to.joined.degrees)
        words = (self._to.nodes[call["node"]], *(call[name] for name in names))
        self._to.loads.append(command("load", *words, comment=self._to.names[call["node"]]))

    def _uniform_load(self, call: Call) -> None:
        tags, _ = self._pieces[call["element"]]
        for tag in tags:
            self._on(call["element"], tag, "-beamUniform", call["transverse"], call["axial"])
        self._correct(call["element"], MemberLoads(call["transverse"]))

    def _point_load(self, call: Call) -> None:
        self._inside(call["element"], MemberLoads(points=[(call["position"], call["transverse"])]))

    def _partial_load(self, call: Call) -> None:
        part = (call["start"], call["end"], call["at_start"], call["at_end"])
        self._inside(call["element"], MemberLoads(parts=[part]))

    def _inside(self, element: int, loads: MemberLoads) -> None:
        tags, stretches = self._pieces[element]
        if element in self._without and loads.parts:
            reason = "a member with hinges has a load on a part of its length; give it uniform or at points [E-OPS-04]"
            raise NotTranslated(self._calls[element]["name"], reason)
        for tag, on in zip(tags, loads.split(stretches)[0], strict=True):
            for position, force in on.points:
                self._on(element, tag, "-beamPoint", force, position, 0.0)
            for begin, end, at_begin, at_end in on.parts:
                self._on(element, tag, "-beamUniform", at_begin, 0.0, begin, end, at_end, 0.0)
        self._correct(element, loads)

    def _on(self, element: int, tag: int, kind: str, *words: float) -> None:
        name = self._calls[element]["name"]
        self._to.loads.append(command("eleLoad", "-ele", tag, "-type", kind, *words, comment=name))

    def _correct(self, element: int, loads: MemberLoads) -> None:
        """Add what `ModElasticBeam2d` leaves out: it takes the fixed-end moments of a plain member."""
        if element not in self._without:
            return
        call, to = self._calls[element], self._to
        first, last = (to.places[call[end]] for end in "ij")
        length = dist(first, last)
        c, s = ((b - a) / length for a, b in zip(first, last, strict=True))
        missing = released_flexibility_loads(self._elastic[call["section"]][1], length, self._without[element], loads)
        for end, (force, moment) in zip("ij", missing, strict=True):
            words = (to.nodes[call[end]], -s * force, c * force, moment)
            comment = f"{call['name']}: fixed-end moment that its hinges add to that of a plain member"
            to.loads.append(command("load", *words, comment=comment))
