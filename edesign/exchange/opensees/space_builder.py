"""The recorded model of a building as commands of OpenSees, where these differ from those of a plane frame."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from edesign.core import Elastic
from edesign.exchange.opensees.commands import command
from edesign.exchange.opensees.loads import LoadBuilder
from edesign.exchange.opensees.materials import steel_material
from edesign.exchange.opensees.structure import NotTranslated
from edesign.exchange.opensees.structure_builder import GEOMETRY, StructureBuilder
from edesign.exchange.recorded_model import Call

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
        ((tag,), _) = self._pieces[call["element"]]
        words = call["transverse"], call["transverse_z"], call["axial"]
        self._on(call["element"], tag, "-beamUniform", *words)

    def _point_load(self, call: Call) -> None:
        ((tag,), _) = self._pieces[call["element"]]
        words = call["transverse"], call["transverse_z"], call["position"], call["axial"]
        self._on(call["element"], tag, "-beamPoint", *words)

    def _partial_load(self, call: Call) -> None:
        raise NotTranslated(self._calls[call["element"]]["name"], "it has a load on a part of its length [E-OPS-04]")


class SpaceBuilder(StructureBuilder):
    """Makes the commands of a recorded building; arguments and errors as of `StructureBuilder`.

    Its force-based element knows no releases, and nodes of a rigid floor, which are tied to the master, can have no
    copies tied to them. A released end is a section there that hardly bends: at the ends of Gauss-Lobatto's points it
    has the moment of that end alone.
    """

    def _load_builder(self) -> LoadBuilder:
        return SpaceLoads(self._to, self._pieces, self._calls, self._elastic, self._without)

    def _rigid_ends(self, call: Call) -> None:
        raise NotTranslated(self._model.element_names[call["element"]], "it has rigid ends [E-OPS-06]")

    def _without_flexibility(self, call: Call) -> None:
        raise NotTranslated(self._model.element_names[call["element"]], "it has hinges [E-OPS-06]")

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
        self._fibred.add(call.result)

    def _geometry(self, call: Call) -> int:
        key = call["geometry"], tuple(call["web"])
        if key not in self._geometries:
            tag = self._geometries[key] = len(self._geometries) + 1
            self._to.elements.append(command("geomTransf", GEOMETRY[call["geometry"]][0], tag, *call["web"]))
        return self._geometries[key]

    def _beam_column(self, call: Call) -> None:
        self._straight(call, [call["i"], call["j"]])

    def _end_sections(self, call: Call) -> tuple[int, int]:
        first, last = (self._released(call, call["release"][at : at + 2]) for at in (0, 2))
        return first, last

    def _released(self, call: Call, about: Sequence[bool]) -> int:
        """Tag of the section at an end, which may be released about local y and z."""
        section, to = call["section"], self._to
        if not any(about):
            return int(section) + 1
        key = section, tuple(about)
        if key not in self._hinges:
            fibres = self._model.calls
            of = next(c for c in fibres if c.name == "fibre_section" and c.result == section)
            area = float(np.sum(of["area"]))
            law = self._laws[int(of["material"])]
            E = law.E
            whole = replace(law, E=E * area) if isinstance(law, Elastic) else replace(law, E=E * area, fy=law.fy * area)
            I_z, I_y = (float(np.asarray(of["area"]) @ np.asarray(of[axis]) ** 2) for axis in "yz")
            told = f"{self._section_name(section)}, released"
            axial = to.add_material(*steel_material(whole), comment=f"{told}: N")
            M_y = to.add_material("Elastic", E * I_y * (RELEASED if about[0] else 1.0), comment=f"{told}: M_y")
            M_z = to.add_material("Elastic", E * I_z * (RELEASED if about[1] else 1.0), comment=f"{told}: M_z")
            torsion = to.add_material("Elastic", of["GJ"], comment=f"{told}: T")
            tag = self._hinges[key] = to.tags.next("section")
            words = ("Aggregator", tag, axial, "P", M_z, "Mz", M_y, "My", torsion, "T")
            to.sections.append(command("section", *words, comment=told))
        return self._hinges[key]

    def _elastic_beam(self, call: Call, ends: Sequence[int], transformation: int, length: float) -> None:
        to, E = self._to, self._modulus(call.result)
        EA, EI_z, EI_y, GJ = self._elastic[call["section"]]
        G = SHEAR_MODULUS * E
        words: list[str | int | float] = [to.nodes[end] for end in ends]
        words += [EA / E, E, G, GJ / G, EI_y / E, EI_z / E, transformation]
        y_start, z_start, y_end, z_end = call["release"]
        for name, code in (("-releasez", z_start + 2 * z_end), ("-releasey", y_start + 2 * y_end)):
            words += [name, code] if code else []
        to.elements.append(command("element", "elasticBeamColumn", call.result + 1, *words, comment=self._told(call)))
