"""The recorded frame as commands of OpenSees: nodes, sections, members, springs and masses."""

from __future__ import annotations

from collections.abc import Hashable, Iterable, Sequence
from math import dist

import numpy as np

from edesign.core.materials import Steel
from edesign.exchange.opensees.commands import command
from edesign.exchange.opensees.fixed_ends import stiffness_factors
from edesign.exchange.opensees.integration import piecewise_lobatto
from edesign.exchange.opensees.loads import LoadBuilder
from edesign.exchange.opensees.materials import NoSuchMaterial, spring_material, steel_material
from edesign.exchange.opensees.structure import NotTranslated, Structure
from edesign.exchange.recorded_model import Call, RecordedModel
from edesign.frame.frame_model import FrameModel
from edesign.frame.loads import Stretches

GEOMETRY = {"linear": ("Linear", 1), "p_delta": ("PDelta", 2), "corotational": ("Corotational", 3)}
ITERATIONS: tuple[str | int | float, ...] = ("-iter", 50, 1e-10)
"""Within a force-based element: iterations at most, and the energy in J at which they end."""
MOST_SECTIONS = 20
"""That a force-based element of OpenSees can have."""
RIGID = 3e8
"""Stiffness of a rigid end over that of its member, times the square of the member's length over that of the end: what
the end bends, and what rounding does to its large terms of stiffness, change a frame by as little as each other."""
PINNED = 1e-6
"""Of the bending stiffness of struts pinned at both ends, which carry no moment. The rotations of their ends are free
in OpenSees: where a strut turns far, they feel damping, and the base shear holds what balances it."""
SAME_PLACE = 1e-9  # m
DIRECTIONS = {2: (1, 2, 6), 3: (1, 2, 3, 4, 5, 6)}
"""Numbers of the degrees in elements without length, by dimension."""
ELSEWHERE = {"fix", "tie", "diaphragm", "pattern", "damper", "rigid_ends", "without_flexibility", "damping_factor"}
"""What is read of the calls as a whole."""


class StructureBuilder:
    """Makes the commands of a recorded frame.

    Args:
        frame: built in `model`.
        model: with its calls.
        structure: that is filled.
    """

    def __init__(self, frame: FrameModel, model: RecordedModel, structure: Structure) -> None:
        self._frame, self._model, self._to = frame, model, structure
        self._laws: dict[int, Steel] = {}
        self._elastic: dict[int, tuple[float, ...]] = {}
        self._fibred: dict[int, Call] = {}
        self._member_of = {part: member.name for member in frame.members.values() for part in member.parts}
        self._rules: dict[tuple[Hashable, ...], int] = {}
        self._geometries: dict[tuple[Hashable, ...], int] = {}
        self._rigid = {c["element"]: (c["start"], c["end"]) for c in model.calls if c.name == "rigid_ends"}
        self._without = {c["element"]: (c["at_i"], c["at_j"]) for c in model.calls if c.name == "without_flexibility"}
        self._factors = {c["element"]: c["factor"] for c in model.calls if c.name == "damping_factor"}
        self._pieces: dict[int, tuple[list[int], Stretches]] = {}
        self._calls: dict[int, Call] = {}
        self._loads = self._load_builder()

    def _load_builder(self) -> LoadBuilder:
        return LoadBuilder(self._to, self._pieces, self._calls, self._elastic, self._without)

    def build(self, calls: Iterable[Call]) -> None:
        """Add what calls added to the core; dampers are not among it.

        Raises:
            NotTranslated: OpenSees lacks something.
        """
        for call in calls:
            make = getattr(self, f"_{call.name}", None)
            if make is not None:
                make(call)
            elif not self._loads.add(call):
                assert call.name in ELSEWHERE, f"the core has {call.name}, which is not translated"

    def _node(self, call: Call) -> None:
        self._to.add_node(call["name"], tuple(call[axis] for axis in "xyz"[: self._to.dimension]), call.result)

    def _mass(self, call: Call) -> None:
        words = tuple(call["m" + degree.removeprefix("u")] for degree in self._to.joined.degrees)
        degrees = [(call["node"], at) for at, value in enumerate(words) if value > 0.0]
        self._to.moving |= {self._to.joined.leader(one) for one in degrees if not self._to.joined.is_fixed(one)}
        self._to.masses.append(command("mass", self._to.nodes[call["node"]], *words, comment=self._named(call["node"])))

    def _named(self, node: int) -> str:
        return self._to.names[node]

    def _material(self, call: Call) -> None:
        self._laws[call.result] = call["law"]
        name, *values = steel_material(call["law"])
        self._to.materials.append(command("uniaxialMaterial", name, call.result + 1, *values))

    def _elastic_section(self, call: Call) -> None:
        self._elastic[call.result] = (call["EA"], call["EI"])

    def _fibre_section(self, call: Call) -> None:
        depths, areas = (np.asarray(call[key], dtype=float).ravel() for key in ("y", "area"))
        levels, of_fibre = np.unique(depths, return_inverse=True)
        merged = np.bincount(of_fibre, weights=areas)
        material = int(call["material"]) + 1
        fibres = [command("fiber", y, 0.0, A, material) for y, A in zip(levels, merged, strict=True)]
        named = self._section_name(call.result)
        comment = f"{named}: {depths.size} fibres, those at one depth as one"
        self._to.sections.append(command("section", "Fiber", call.result + 1, body=fibres, comment=comment))
        self._fibred[call.result] = call

    def _section_name(self, section: int) -> str:
        for member in self._frame.members.values():
            if self._model.element_sections[member.element] == section:
                return f"{member.section}, {member.material}"
        return "section"

    def _geometry(self, call: Call) -> int:
        kind, tag = GEOMETRY[call["geometry"]]
        if (kind,) not in self._geometries:
            self._geometries[kind,] = tag
            self._to.elements.append(command("geomTransf", kind, tag))
        return tag

    def _beam_column(self, call: Call) -> None:
        number, to = call.result, self._to
        self._calls[number] = call
        ends = [call["i"], call["j"]]
        places = [to.places[end] for end in ends]
        length = dist(*places)
        tags, lengths = [number + 1], [length]
        arms = self._rigid.get(number, (0.0, 0.0))
        if any(arms):
            tags, lengths, ends = self._arms(call, ends, places, length, arms)
        ends = self._released_ends(call, ends)
        self._pieces[number] = tags, Stretches((0.0, 0.0), tuple(lengths))
        transformation = self._geometry(call)
        to.damp(number + 1, self._factors.get(number, 1.0))
        if call["section"] in self._fibred:
            middle = length - sum(arms)
            inside = [x for at in call["breaks"] if 0.0 < (x := (at * length - arms[0]) / middle) < 1.0]
            self._fibre_beam(call, ends, transformation, inside)
        else:
            self._elastic_beam(call, ends, transformation, length)

    def _released_ends(self, call: Call, ends: Sequence[int]) -> list[int]:
        """Nodes between which a member bends, behind its rigid ends, with copies of those where it is released."""
        to, found = self._to, list(ends)
        for at, free in enumerate(call["release"]):
            if free:
                name = f"{call['name']}, released at {to.names[found[at]]}"
                found[at] = to.tied_copy(name, found[at], (0, 1))
        return found

    def _fibre_beam(self, call: Call, ends: Sequence[int], transformation: int, inside: Sequence[float]) -> None:
        section = call["section"] + 1
        rule = self._rule(call, (section, section, section), inside)
        self._force_based(call.result + 1, ends, transformation, rule, self._told(call))

    def _force_based(self, tag: int, ends: Sequence[int], transformation: int, rule: int, comment: str) -> None:
        words = ("forceBeamColumn", tag, *(self._to.nodes[end] for end in ends), transformation, rule, *ITERATIONS)
        self._to.elements.append(command("element", *words, comment=comment))

    def _told(self, call: Call) -> str:
        known = call.result in self._member_of
        return f"{call['name']}: {self._section_name(call['section'])}" if known else call["name"]

    def _elastic_beam(self, call: Call, ends: Sequence[int], transformation: int, length: float) -> None:
        number, to, comment = call.result, self._to, self._told(call)
        i, j = (to.nodes[end] for end in ends)
        EA, EI = self._elastic[call["section"]]
        E = self._modulus(number)
        if number not in self._member_of and all(call["release"]):
            EI *= PINNED
        if number in self._without:
            factors = stiffness_factors(EI, length, self._without[number])
            words: tuple[str | float, ...] = ("ModElasticBeam2d", number + 1, i, j, EA / E, E, EI / E, *factors)
            comment += "; without the flexibility of its hinges"
        else:
            words = ("elasticBeamColumn", number + 1, i, j, EA / E, E, EI / E)
        to.elements.append(command("element", *words, transformation, comment=comment))

    def _modulus(self, element: int) -> float:
        """E of an elastic member; 1 Pa where only its stiffnesses are known."""
        name = self._member_of.get(element)
        return 1.0 if name is None else self._frame.members[name].steel.E

    def _rule(self, call: Call, sections: tuple[int, int, int], inside: Sequence[float]) -> int:
        """Tag of the integration of a member with sections at its start, between and at its end."""
        first, section, last = sections
        points = call["points"]
        key = (*sections, points, *inside)
        if key in self._rules:
            return self._rules[key]
        tag = self._rules[key] = len(self._rules) + 1
        if not inside and first == last == section:
            self._to.elements.append(command("beamIntegration", "Lobatto", tag, section, points))
            return tag
        places, weights = piecewise_lobatto(points, inside)
        if len(places) > MOST_SECTIONS:
            reason = (
                f"{len(places)} sections between its loads, and a member of OpenSees has at most {MOST_SECTIONS}; "
                "fewer loads inside the member or fewer `elements.integration_points` [E-OPS-04]"
            )
            raise NotTranslated(call["name"], reason)
        words = (tag, len(places), first, *[section] * (len(places) - 2), last, *places, *weights)
        comment = f"{points} points of Gauss-Lobatto in each part between loads"
        self._to.elements.append(command("beamIntegration", "UserDefined", *words, comment=comment))
        return tag

    def _arms(
        self, call: Call, ends: list[int], places: list[tuple[float, ...]], length: float, arms: tuple[float, float]
    ) -> tuple[list[int], list[float], list[int]]:
        """Add rigid ends; returns the tags and lengths of all parts, and the nodes between which the member bends."""
        to, number = self._to, call.result
        along = [(b - a) / length for a, b in zip(*places, strict=True)]
        transformation = self._geometry(call)
        tags, lengths, inner = [number + 1], [length - sum(arms)], list(ends)
        for at, arm in enumerate(arms):
            if arm == 0.0:
                continue
            way = arm if at == 0 else -arm
            place = tuple(here + way * part for here, part in zip(places[at], along, strict=True))
            inner[at] = to.add_node(f"{call['name']}, face at {to.names[ends[at]]}", place)
            pair = (ends[at], inner[at]) if at == 0 else (inner[at], ends[at])
            tag = to.tags.next("element")
            rigid = RIGID * (arm / length) ** 2
            stiff = self._stiff_words(call["section"], rigid)
            words = (tag, *(to.nodes[one] for one in pair), *stiff, transformation)
            comment = f"{call['name']}: rigid end"
            to.elements.append(command("element", "elasticBeamColumn", *words, comment=comment))
            where = 0 if at == 0 else len(tags)
            tags.insert(where, tag)
            lengths.insert(where, arm)
        return tags, lengths, inner

    def _stiff_words(self, section: int, factor: float) -> tuple[float, ...]:
        """What an elastic element has that is so many times as stiff as a section: A, E and I."""
        EA, EI = self.stiffness(section)
        return factor * EA, 1.0, factor * EI

    def members(self) -> list[Call]:
        """Return the calls that added beam-columns of the project, no struts of the leaning column."""
        return [call for number, call in self._calls.items() if number in self._member_of]

    def stiffness(self, section: int) -> tuple[float, float]:
        """Return E A and E I of a section, N and N m2."""
        if section in self._elastic:
            return self._elastic[section][0], self._elastic[section][1]
        call = self._fibred[section]
        y, area = (np.asarray(call[key], dtype=float) for key in ("y", "area"))
        E = self._laws[int(call["material"])].E
        return E * float(area.sum()), E * float((area * y**2).sum())

    def _truss(self, call: Call) -> None:
        to = self._to
        kind = "truss" if call["geometry"] == "linear" else "corotTruss"
        pair = (to.nodes[call["i"]], to.nodes[call["j"]])
        words = (kind, call.result + 1, *pair, call["area"], call["material"] + 1, "-doRayleigh", 1)
        of = self._frame.members.get(call["name"])
        comment = call["name"] if of is None else f"{call['name']}: {of.section}, {of.material}"
        to.damp(call.result + 1)
        to.elements.append(command("element", *words, comment=comment))

    def _strut(self, call: Call) -> None:
        raise NotTranslated(
            call["name"], "a brace that buckles is condensed to one bar, which OpenSees does not have [E-OPS-03]"
        )

    def _link(self, call: Call) -> None:
        """The spring of a tuned mass, along x alone."""
        material = self._to.add_material("Elastic", call["stiffness"][0], comment=call["name"])
        self._zero_length(call, material, 0)

    def _spring(self, call: Call) -> None:
        terms = call["terms"]
        n = len(terms) // 2
        degree = next((at for at in range(n) if terms[n + at] == 1.0), None)
        alone = degree is not None and [at for at, c in enumerate(terms) if c] == [degree, n + degree]
        apart = dist(*(self._to.places[call[end]] for end in "ij"))
        if degree is None or not alone or terms[degree] != -1.0 or apart > SAME_PLACE:
            raise NotTranslated(call["name"], "it couples displacements of several directions [E-OPS-05]")
        try:
            law = spring_material(call["law"])
        except NoSuchMaterial as error:
            raise NotTranslated(call["name"], str(error)) from error
        self._zero_length(call, self._to.add_material(*law, comment=call["name"]), degree)

    def _zero_length(self, call: Call, material: int, degree: int) -> None:
        to, tag = self._to, call.result + 1
        pair = (to.nodes[call["i"]], to.nodes[call["j"]])
        direction = DIRECTIONS[to.dimension][degree]
        factor = self._factors.get(call.result, 1.0)
        damped = ("-doRayleigh", 1) if factor > 0.0 else ()
        words = ("zeroLength", tag, *pair, "-mat", material, "-dir", direction, *damped)
        to.damp(tag, factor)
        to.springs.append(command("element", *words, comment=call["name"]))
