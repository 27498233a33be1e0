"""The recorded model of a building as commands of OpenSees, where these differ from those of a plane frame."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Hashable, Sequence
from dataclasses import replace
from itertools import pairwise
from math import dist

import numpy as np

from edesign.core import Elastic
from edesign.core.materials import Steel
from edesign.exchange.opensees.commands import command
from edesign.exchange.opensees.loads import LoadBuilder
from edesign.exchange.opensees.materials import steel_material
from edesign.exchange.opensees.structure import NotTranslated, Structure
from edesign.exchange.opensees.structure_builder import GEOMETRY, StructureBuilder
from edesign.exchange.recorded_model import Call, RecordedModel
from edesign.frame.frame_model import FrameModel
from edesign.frame.loads import MemberLoads, Stretches

MOST_SECTIONS = 10
"""That a force-based element of OpenSees can have in space."""
RELEASED = 1e-9
"""Of the bending stiffness, at the point of a force-based member where it is released."""
SHEAR_MODULUS = 1.0 / 2.6
"""Over E, of elastic members: only its product with the torsion constant counts."""


class SpaceLoads(LoadBuilder):
    """Makes the commands of recorded loads of a model in space."""

    def _nodal_load(self, call: Call) -> None:
        if any(call[name] for name in ("fx", "fy", "fz", "mx", "my", "mz")):
            super()._nodal_load(call)

    def _uniform_load(self, call: Call) -> None:
        for tag in self._pieces[call["element"]][0] if call["transverse"] or call["transverse_z"] else ():
            self._on(call["element"], tag, "-beamUniform", call["transverse"], call["transverse_z"])
        if call["axial"]:
            self._along(self._calls[call["element"]], call["axial"])

    def _along(self, member: Call, load: float) -> None:
        """Put a load along a member on its ends: so P-Delta takes the axial force in the middle, as edesign does."""
        to, ends = self._to, (member["i"], member["j"])
        to.shifted.append(member["name"])
        start, end = (np.array(to.places[node]) for node in ends)
        half = (0.5 * load * (end - start) + 0.0).tolist()  # N/m times the length, along the member
        for node in ends:
            words = (to.nodes[node], *half, 0.0, 0.0, 0.0)
            to.loads.append(command("load", *words, comment=f"{member['name']}: half of its load along it"))

    def _point_load(self, call: Call) -> None:
        tags, stretches = self._pieces[call["element"]]
        parts, _ = MemberLoads(points=[(call["position"], 1.0)]).split(stretches)
        for tag, on in zip(tags, parts, strict=True):
            for position, _ in on.points:
                words = call["transverse"], call["transverse_z"], position, call["axial"]
                self._on(call["element"], tag, "-beamPoint", *words)

    def _partial_load(self, call: Call) -> None:
        reason = "it has a load on a part of its length; give it uniform or at points [E-OPS-04]"
        raise NotTranslated(self._calls[call["element"]]["name"], reason)


class SpaceBuilder(StructureBuilder):
    """Makes the commands of a recorded building; arguments and errors as of `StructureBuilder`.

    The force-based element knows no releases, and nodes of a rigid floor, which are tied to the master, can have no
    copies tied to them. A released end is a section there that hardly bends: at the ends of Gauss-Lobatto's points it
    has the moment of that end alone. Members with more sections than the element takes are several of them. So are
    released elastic members at loads inside them: `elasticBeamColumn` knows uniform loads alone beside releases.
    """

    def __init__(self, frame: FrameModel, model: RecordedModel, structure: Structure) -> None:
        super().__init__(frame, model, structure)
        self._hinges: dict[tuple[Hashable, ...], int] = {}
        self._loaded: dict[int, set[float]] = defaultdict(set)
        for call in model.calls:
            if call.name == "point_load" and 0.0 < call["position"] < 1.0:
                self._loaded[call["element"]].add(call["position"])
        pressed = (call["pressed_by"] for call in model.calls if call.name == "damper")
        self._pressing = {spring for spring, _ in filter(None, pressed)}

    def _spring(self, call: Call) -> None:
        if call.result in self._pressing:
            self._to.pressing[call.result] = call
        else:
            super()._spring(call)

    def _load_builder(self) -> LoadBuilder:
        return SpaceLoads(self._to, self._pieces, self._calls, self._elastic, self._without)

    def _stiff_words(self, section: int, factor: float) -> tuple[float, ...]:
        """What an elastic element has that is so many times as stiff as a section: A, E, G, J, I_y and I_z."""
        if section in self._elastic:
            EA, EI_z, EI_y, GJ = self._elastic[section]
        else:
            call = self._fibred[section]
            y, z, area = (np.asarray(call[key], dtype=float).ravel() for key in ("y", "z", "area"))
            E, GJ = self._laws[int(call["material"])].E, call["GJ"]
            EA, EI_z, EI_y = (E * float(area @ weight) for weight in (np.ones_like(area), y**2, z**2))
        return factor * EA, 1.0, 1.0, factor * GJ, factor * EI_y, factor * EI_z

    def _elastic_section(self, call: Call) -> None:
        self._elastic[call.result] = (call["EA"], call["EI"], call["EI_y"], call["GJ"])

    def _fibre_section(self, call: Call) -> None:
        to, material = self._to, int(call["material"]) + 1
        places = np.stack([np.asarray(call[key], dtype=float).ravel() for key in "yz"], axis=1)
        areas = np.asarray(call["area"], dtype=float).ravel()
        levels, of_fibre = np.unique(places, axis=0, return_inverse=True)
        merged = np.bincount(of_fibre.ravel(), weights=areas)
        fibres = [command("fiber", y, z, A, material) for (y, z), A in zip(levels, merged, strict=True)]
        words = ("Fiber", call.result + 1, "-GJ", call["GJ"])
        to.sections.append(command("section", *words, body=fibres, comment=self._section_name(call.result)))
        self._fibred[call.result] = call

    def _geometry(self, call: Call) -> int:
        key = call["geometry"], tuple(call["web"])
        if key not in self._geometries:
            tag = self._geometries[key] = len(self._geometries) + 1
            self._to.elements.append(command("geomTransf", GEOMETRY[call["geometry"]][0], tag, *call["web"]))
        return self._geometries[key]

    def _released_ends(self, call: Call, ends: Sequence[int]) -> list[int]:
        return list(ends)

    def _fibre_beam(self, call: Call, ends: Sequence[int], transformation: int, inside: Sequence[float]) -> None:
        section, per_element = call["section"] + 1, (MOST_SECTIONS - 1) // (call["points"] - 1)
        cuts = [0.0, *inside[per_element - 1 :: per_element], 1.0]
        first, last = (self._released(call, call["release"][at : at + 2]) for at in (0, 2))
        for tag, pair, low, high in self._divided(call, ends, cuts):
            sections = first if low == 0.0 else section, section, last if high == 1.0 else section
            within = [(at - low) / (high - low) for at in inside if low < at < high]
            self._force_based(tag, pair, transformation, self._rule(call, sections, within), self._told(call))

    def _divided(
        self, call: Call, ends: Sequence[int], cuts: Sequence[float]
    ) -> list[tuple[int, tuple[int, int], float, float]]:
        """Divide a member at shares of its length; returns tag, nodes, start and end of each part."""
        to, number = self._to, call.result
        start, end = (np.array(to.places[node]) for node in ends)
        inner = [tuple((start + cut * (end - start)).tolist()) for cut in cuts[1:-1]]
        nodes = [ends[0], *(to.add_node(f"{call['name']}, inside", place) for place in inner), ends[1]]
        tags = [number + 1, *(to.tags.next("element") for _ in inner)]
        to.divided += [call["name"]] if inner else []
        for tag in tags[1:]:
            to.damp(tag, self._factors.get(number, 1.0))
        lengths = (np.diff(cuts) * dist(start, end)).tolist()
        told, stretches = self._pieces[number]  # with the rigid ends
        at = told.index(number + 1)
        lengths = [*stretches.lengths[:at], *lengths, *stretches.lengths[at + 1 :]]
        self._pieces[number] = [*told[:at], *tags, *told[at + 1 :]], Stretches((0.0, 0.0), tuple(lengths))
        return list(zip(tags, pairwise(nodes), cuts[:-1], cuts[1:], strict=True))

    def _released(self, call: Call, about: Sequence[bool]) -> int:
        """Tag of the section at an end, which may be released about local y and z."""
        section, to = call["section"], self._to
        if not any(about):
            return int(section) + 1
        key = section, tuple(about)
        if key not in self._hinges:
            of, told = self._fibred[section], f"{self._section_name(section)}, released"
            area, law = np.asarray(of["area"], dtype=float), self._laws[int(of["material"])]
            axial = steel_material(_times(law, float(area.sum())))
            words: list[str | int] = [to.add_material(*axial, comment=f"{told}: N"), "P"]
            for free, across, moment in zip(about, "zy", ("My", "Mz"), strict=True):
                EI = law.E * float(area @ np.asarray(of[across], dtype=float) ** 2)
                words += [
                    to.add_material("Elastic", EI * (RELEASED if free else 1.0), comment=f"{told}: {moment}"),
                    moment,
                ]
            words += [to.add_material("Elastic", of["GJ"], comment=f"{told}: T"), "T"]
            tag = self._hinges[key] = to.tags.next("section")
            to.sections.append(command("section", "Aggregator", tag, *words, comment=told))
        return self._hinges[key]

    def _elastic_beam(self, call: Call, ends: Sequence[int], transformation: int, length: float) -> None:
        to, E = self._to, self._modulus(call.result)
        EA, EI_z, EI_y, GJ = self._elastic[call["section"]]
        G = SHEAR_MODULUS * E
        sizes = EA / E, E, G, GJ / G, EI_y / E, EI_z / E
        y_start, z_start, y_end, z_end = call["release"]
        arms, whole = self._rigid.get(call.result, (0.0, 0.0)), dist(*(to.places[call[end]] for end in "ij"))
        places = [(at * whole - arms[0]) / (whole - sum(arms)) for at in self._loaded[call.result]]
        loaded = [at for at in places if 0.0 < at < 1.0] if any(call["release"]) else ()
        for tag, pair, low, high in self._divided(call, ends, [0.0, *sorted(loaded), 1.0]):
            words: list[str | int | float] = [tag, *(to.nodes[node] for node in pair), *sizes, transformation]
            for name, at_start, at_end in (("-releasez", z_start, z_end), ("-releasey", y_start, y_end)):
                code = (at_start and low == 0.0) + 2 * (at_end and high == 1.0)
                words += [name, code] if code else []
            to.elements.append(command("element", "elasticBeamColumn", *words, comment=self._told(call)))


def _times(law: Steel, area: float) -> Steel:
    """The law of forces on an area."""
    if isinstance(law, Elastic):
        return replace(law, E=law.E * area)
    return replace(law, E=law.E * area, fy=law.fy * area)
