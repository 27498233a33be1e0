"""A frame with other sections in the same places, and the loads and masses that follow from them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from edesign.project.building.building import Building, Steel
from edesign.space.structure.composite import stiffness_factor
from edesign.space.structure.frame import Member, SpaceFrame
from edesign.space.structure.load_cases import SELF_WEIGHT, self_weight
from edesign.space.structure.masses import node_masses
from edesign.space.structure.steel_by_thickness import steel_by_thickness


class OtherSections:
    """The frame of a building with other sections.

    Args:
        building: as its file says.
        made: the same with steels by thickness; steels of other sections are added to its materials.
    """

    def __init__(self, building: Building, made: Building, frame: SpaceFrame) -> None:
        self._building, self._made, self._frame = building, made, frame
        self._material = {
            run.group: run.material for of in (building.columns, building.beams, building.braces) for run in of
        }
        self._groups: dict[str, list[int]] = {}
        for number, member in enumerate(frame.members):
            self._groups.setdefault(member.group, []).append(number)
        self._variants: dict[tuple[str, str], list[Member]] = {}

    def steel_mass(self) -> float:
        """Return the mass of the members of the file, kg."""
        pairs, of_members = self._frame.sections
        metre = [self._frame.section(name).A * self._made.materials[steel].density for name, steel in pairs]
        return float(np.array(metre)[of_members] @ self._frame.length)

    def steel_of(self, group: str, section: str) -> tuple[str, Steel]:
        """Return the steel of a section in a group, and its name.

        Args:
            group: of members.

        Returns:
            Name of the steel, and the steel.

        Raises:
            InputError: with yield strengths by thickness the section is thicker than the standard knows.
        """
        return steel_by_thickness(self._building, section, self._material[group])

    def frame_with(self, sections: Mapping[str, str]) -> SpaceFrame:
        """Return the frame with other sections, and the self weight and masses that follow from them.

        Args:
            sections: section of each group; groups without one keep theirs.

        Raises:
            InputError: a section is not known, or too thick for its steel.
        """
        frame, members = self._frame, list(self._frame.members)
        for name, numbers in self._groups.items():
            wanted = sections.get(name)
            if wanted is not None and wanted != frame.members[numbers[0]].section:
                for number, member in zip(numbers, self._variant(name, wanted), strict=True):
                    members[number] = member
        found = frame.with_sections(tuple(members), frame.cases, frame.node_mass)
        if SELF_WEIGHT not in frame.cases:
            return found
        cases = frame.cases | {SELF_WEIGHT: self_weight(self._made, found)}
        found = found.with_sections(found.members, cases, frame.node_mass)
        return found.with_sections(found.members, cases, node_masses(self._made, found))

    def _variant(self, group: str, section: str) -> list[Member]:
        """Return the members of a group with another section."""
        if (group, section) not in self._variants:
            material, steel = self.steel_of(group, section)
            self._made.materials.setdefault(material, steel)
            factor = self._slab_factor(group, section)
            self._variants[group, section] = [
                replace(
                    of,
                    section=section,
                    material=material,
                    stiffness_factor=of.stiffness_factor if factor is None else factor,
                )
                for of in (self._frame.members[number] for number in self._groups[group])
            ]
        return self._variants[group, section]

    def _slab_factor(self, group: str, section: str) -> float | None:
        """Return the factor on E I that a slab makes with a section in a group; None where it has no slab."""
        for number, run in enumerate(self._building.beams):
            if run.group == group and run.slab is not None:
                return stiffness_factor(self._building, number, run, section)
        return None
