"""The members of a plane frame of SAP2000 at their places in a project: columns, beams, braces, sections, materials."""

from __future__ import annotations

from collections import defaultdict

from edesign.errors import InputError
from edesign.exchange.sap2000.grid import Grid, Placed, Point
from edesign.exchange.sap2000.known_sections import WORTH_TELLING, known_section, own_name, plates_text
from edesign.exchange.sap2000.model import Sap2000Model, Section
from edesign.exchange.sap2000.written import free_identifier, quantity

What = tuple[str, str, str]
"""Section, material, and the axis as an entry says it."""
BraceWhat = tuple[str, str, str, bool]
"""Kind, section, material, and whether it counts in compression."""


class PlaneMembers:
    """Members by their places.

    Args:
        model: in SI.
        grid: on which it stands, in one vertical plane.

    Attributes:
        across: 0 of a frame in the plane X-Z, 1 in Y-Z.
        columns: by (line from 0, storey).
        beams, beam_releases: by (bay, floor).
        braces: by (bay, storey).
        own_sections: those that the catalogue does not have, as a project writes them.
        materials: names in the project by those of the model.
        fillets: whether the areas of rolled sections are those with root fillets.
        left_out: sentences on what differs from the model.

    Raises:
        InputError: a member is of a kind that projects do not have.
    """

    def __init__(self, model: Sap2000Model, grid: Grid) -> None:
        self.model, self.grid = model, grid
        self.across = 0 if grid.plane == "x" else 1
        self.left_out: list[str] = []
        self.sections: dict[str, str] = {}
        self.own_sections: dict[str, str] = {}
        self.materials: dict[str, str] = {}
        self.fillets = self._have_fillets()
        self._members()

    def line(self, point: Point) -> int:
        """The number of the column line of a point."""
        return point[self.across]

    def _have_fillets(self) -> bool:
        """Whether the areas of rolled sections are those with root fillets."""
        used = [self.model.sections[name] for name in {frame.section for frame in self.model.frames.values()}]
        fits = [[known_section(section, fillets) for section in used] for fillets in (True, False)]
        apart = [sum(known.apart if known is not None else 1.0 for known in of) for of in fits]
        return apart[0] <= apart[1]

    def _members(self) -> None:
        columns: dict[tuple[int, int], What] = {}
        beams: dict[tuple[int, int], list[tuple[Placed, What]]] = defaultdict(list)
        braces: dict[tuple[int, int], list[tuple[Placed, tuple[str, str, bool]]]] = defaultdict(list)
        self.released: dict[str, tuple[bool, bool]] = {}
        for placed in self.grid.placed:
            section = self.model.sections[placed.frame.section]
            if placed.kind == "brace":
                self._check_brace(placed)
                full = section.axial_share == 1.0
                if section.axial_share not in (1.0, 0.5):
                    raise self.refuse(
                        placed, f"its section has `AMod` = {section.axial_share:g}, not 1 or 0.5 [E-SAP-12]"
                    )
                place = (min(self.line(placed.start), self.line(placed.end)) + 1, placed.end[2])
                braces[place].append((placed, (*self._of_section(section), full)))
                continue
            if section.axial_share != 1.0:
                raise self.refuse(placed, "its section has an `AMod` other than 1 [E-SAP-12]")
            what = (*self._of_section(section), self._axis(placed))
            self.released[placed.frame.name] = self._released(placed, what[2])
            if placed.kind == "column":
                self._once(columns, (self.line(placed.start), placed.end[2]), what, placed)
            else:
                beams[self.line(placed.start) + 1, placed.start[2]].append((placed, what))
        self.columns, self.beams, self.braces = columns, self._whole_beams(beams), self._brace_kinds(braces)
        if any(floor == 0 for _, floor in self.beams):
            raise InputError("beams at the base level: projects have beams from floor 1 on [E-SAP-23]")

    def _once(
        self,
        there: dict[tuple[int, int], What],
        place: tuple[int, int],
        what: What,
        placed: Placed,
    ) -> None:
        if place in there:
            raise self.refuse(placed, "another frame stands in its place [E-SAP-19]")
        there[place] = what

    def refuse(self, placed: Placed, why: str) -> InputError:
        """An error at the frame of a place."""
        return self.model.error("frame", placed.frame.name, why)

    def _axis(self, placed: Placed) -> str:
        """About which axis of its section a member bends in the plane."""
        two = self.model.axes(placed.frame)[1]
        out_of_plane = abs(float(two[1 - self.across]))
        if out_of_plane < 1e-6:
            return ""
        if out_of_plane > 1.0 - 1e-6:
            return ", axis: weak"
        raise self.refuse(
            placed, f"its local axes are turned by {placed.frame.angle:g} degrees out of the plane [E-SAP-22]"
        )

    def _released(self, placed: Placed, axis: str) -> tuple[bool, bool]:
        """Whether the start and the end are pins, in the direction in which the project counts."""
        bending = 4 if axis else 5
        ends = []
        for released, springs in zip(placed.frame.released, placed.frame.springs, strict=True):
            if any(released[:3]):
                raise self.refuse(
                    placed, "an axial force or a shear force is released, which projects do not have [E-SAP-21]"
                )
            if springs[bending]:
                raise self.refuse(
                    placed, "it has partial fixity; give semi-rigid joints in the project (`joints`) [E-SAP-21]"
                )
            ends.append(released[bending])
        return (ends[1], ends[0]) if placed.reversed else (ends[0], ends[1])

    def _check_brace(self, placed: Placed) -> None:
        axis = self._axis(placed)
        if self._released(placed, axis) != (True, True):
            raise self.refuse(
                placed, "it is a brace whose ends are not released in the plane; braces are pin-ended [E-SAP-21]"
            )

    def _of_section(self, section: Section) -> tuple[str, str]:
        """The names of a section and its material in the project."""
        if section.name not in self.sections:
            self.sections[section.name] = self._new_section(section)
        material = self.model.materials.get(section.material)
        if material is None:
            raise self.model.error("section", section.name, f"its material `{section.material}` has no data [E-SAP-08]")
        if material.name not in self.materials:
            self.materials[material.name] = free_identifier(material.name, set(self.materials.values()))
        return self.sections[section.name], self.materials[material.name]

    def _new_section(self, section: Section) -> str:
        known = known_section(section, self.fillets)
        if known is not None:
            if known.apart > WORTH_TELLING:
                self.left_out.append(
                    f"section {section.name} is taken as {known.name} of the catalogue, which differs by "
                    f"{100.0 * known.apart:.2g} % in area or second moment of area"
                )
            return known.name
        if section.area <= 0.0 or section.I33 <= 0.0:
            raise self.model.error(
                "section", section.name, f"of the shape {section.shape} it has no area or no I33 [E-SAP-08]"
            )
        name = own_name(section, self.own_sections)
        plates = plates_text(section)
        if plates:
            self.own_sections[name] = plates
        else:
            self.left_out.append(f"section {section.name} is in no list of edesign: it stays elastic")
            self.own_sections[name] = (
                f"{{area: {quantity(section.area, 'm^2')}, inertia: {quantity(section.I33, 'm^4')}}}"
            )
        return name

    def _whole_beams(self, beams: dict[tuple[int, int], list[tuple[Placed, What]]]) -> dict[tuple[int, int], What]:
        """One entry for each beam, whole or of two halves, and its releases."""
        found = {}
        self.beam_releases: dict[tuple[int, int], tuple[bool, bool]] = {}
        for place, parts in beams.items():
            parts.sort(key=lambda part: part[0].half)
            if [placed.half for placed, _ in parts] not in ([0], [1, 2]):
                raise self.refuse(parts[-1][0], "another frame stands in its place [E-SAP-19]")
            if len({what for _, what in parts}) > 1:
                raise self.refuse(
                    parts[1][0], "the halves of a beam that braces meet have different sections [E-SAP-20]"
                )
            first, last = self.released[parts[0][0].frame.name], self.released[parts[-1][0].frame.name]
            if len(parts) == 2 and (first[1] or last[0]):
                raise self.refuse(parts[0][0], "a beam that braces meet is released in its middle [E-SAP-20]")
            self.beam_releases[place] = first[0], last[1]
            found[place] = parts[0][1]
        return found

    def _brace_kinds(
        self, braces: dict[tuple[int, int], list[tuple[Placed, tuple[str, str, bool]]]]
    ) -> dict[tuple[int, int], BraceWhat]:
        found = {}
        for place, parts in braces.items():
            if len({what for _, what in parts}) > 1:
                raise self.refuse(parts[1][0], "two braces of one bay have different sections [E-SAP-18]")
            middles = [placed.middle for placed, _ in parts]
            rising = [self.line(placed.start) < self.line(placed.end) for placed, _ in parts]
            if sorted(rising) == [False, True] and middles[0] == middles[1]:
                kind = {"": "cross", "end": "chevron", "start": "v"}[middles[0]]
            elif len(parts) == 1 and not middles[0]:
                kind = "rising" if rising[0] else "falling"
            else:
                raise self.refuse(parts[0][0], "the braces of its bay are no diagonal, cross, chevron or V [E-SAP-18]")
            found[place] = (kind, *parts[0][1])
        return found
