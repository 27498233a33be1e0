"""The names of sections that a file may use: the catalogue's, and hollow sections of any size."""

from __future__ import annotations

from collections.abc import Collection, Iterator

from edesign.errors import InputError, split_code
from edesign.frame.sections.angles import angle_name, near_angle
from edesign.frame.sections.channels import near_channel, pair_name
from edesign.frame.sections.hollow_section import hollow_section
from edesign.frame.sections.profiles import profile_names
from edesign.frame.sections.restrained_core import core_name
from edesign.frame.sections.tapered import near_tapered, tapered_name


class BuildingSections(Collection[str]):
    """The names of sections that a building or project may use: the catalogue's, and hollow sections of any size."""

    def __eq__(self, other: object) -> bool:
        return isinstance(other, BuildingSections)

    def __hash__(self) -> int:
        return hash(BuildingSections)

    def __contains__(self, name: object) -> bool:
        return isinstance(name, str) and self.canonical(name) == name

    def __iter__(self) -> Iterator[str]:
        return iter(profile_names())

    def __len__(self) -> int:
        return len(profile_names())

    def canonical(self, name: str) -> str | None:
        """Return the name as edesign writes it, `SHS200x10`; None if there is no such section.

        Args:
            name: as a user writes it.
        """
        try:
            hollow = hollow_section(name)
        except InputError:
            return None
        return profile_names().canonical(name) if hollow is None else hollow.name

    def canonical_in_building(self, name: str, brace: bool = False) -> str | None:
        """Return the name of a section that only buildings have, or only their braces; None of others.

        Args:
            name: as a user writes it.
            brace: whether it is that of a pin-ended brace.
        """
        return tapered_name(name) or ((angle_name(name) or pair_name(name) or core_name(name)) if brace else None)

    def near(self, name: str) -> str:
        """Return what there is near a name that is none, as a clause.

        Args:
            name: as a user writes it.
        """
        try:
            hollow_section(name)
        except InputError as error:
            return split_code(str(error))[0]
        return near_angle(name) or near_tapered(name) or near_channel(name) or profile_names().near(name)
