"""The members of a SAP2000 model at their places in a building: columns, beams, braces, and what floors cover."""

from __future__ import annotations

from collections import defaultdict

from edesign.errors import InputError
from edesign.exchange.sap2000.grid import Grid, Placed, Point
from edesign.exchange.sap2000.known_sections import WORTH_TELLING, known_section, own_name, plates_text
from edesign.exchange.sap2000.model import Sap2000Model, Section
from edesign.exchange.sap2000.space_loads import beam_place
from edesign.exchange.sap2000.written import free_identifier, quantity
from edesign.project.building.names import BeamPlace, BracePlace, ColumnLine, Direction
from edesign.project.notation.axes import PLAIN_AXES

_STRAIGHT = 1e-6  # sine of an angle that is none


class SpaceMembers:
    """Members by their places.

    Args:
        model: in SI.
        grid: on which it stands.
        diaphragms: floors that are rigid in their plane.

    Attributes:
        columns: section, material and direction of the strong axis.
        beams: section, material and ends.
        braces: kind, section, material, and whether they count in compression.
        own_sections: those that the catalogue does not have, as a building writes them.
        materials: names in the building by those of the model.
        floors: bays of the plan that each floor covers, both from 1.
        left_out: sentences on what differs from the model.

    Raises:
        InputError: a member is of a kind that buildings do not have.
    """

    def __init__(self, model: Sap2000Model, grid: Grid, diaphragms: set[int]) -> None:
        self.model, self.grid, self.diaphragms = model, grid, diaphragms
        self.storeys = len(grid.z) - 1
        self.sections: dict[str, str] = {}
        self.own_sections: dict[str, str] = {}
        self.materials: dict[str, str] = {}
        self.torsion_pins = 0
        self.left_out: list[str] = []
        self.columns: dict[tuple[ColumnLine, int], tuple[str, str, Direction]] = {}
        self.beams: dict[BeamPlace, tuple[str, str, str]] = {}
        self.braces: dict[BracePlace, tuple[str, str, str, bool]] = {}
        if link := next(iter(model.links), ""):
            raise model.error(
                "link", link, "buildings have no dampers and springs; a plane frame may have them [E-SAP-13]"
            )
        self._members()
        self.floors = self._covered()
        if self.torsion_pins:
            self.left_out.append(
                f"torsion pins of {self.torsion_pins} beams: pinned ends of building files transmit torsion"
            )

    def refuse(self, placed: Placed, why: str) -> InputError:
        """An error at the frame of a place."""
        return self.model.error("frame", placed.frame.name, why)

    def _members(self) -> None:
        halves: dict[BeamPlace, list[Placed]] = defaultdict(list)
        braces: dict[BracePlace, list[Placed]] = defaultdict(list)
        for placed in self.grid.placed:
            if any(any(released[:3]) for released in placed.frame.released):
                raise self.refuse(
                    placed, "an axial force or a shear force is released, which buildings do not have [E-SAP-21]"
                )
            if placed.kind == "brace":
                braces[_brace_place(placed)].append(placed)
            elif self.model.sections[placed.frame.section].axial_share != 1.0:
                raise self.refuse(placed, "its section has an `AMod` other than 1 [E-SAP-12]")
            elif placed.kind == "beam":
                halves[beam_place(placed.start, placed.end)].append(placed)
            else:
                self._column(placed)
        for beam, parts in halves.items():
            self._beam(beam, sorted(parts, key=lambda part: part.half))
        for place, members in braces.items():
            self._brace(place, members)
        if any(place.floor == 0 for place in self.beams):
            raise InputError("there are beams at the base level: buildings have beams from floor 1 on [E-SAP-23]")

    def _column(self, placed: Placed) -> None:
        if any(any(released) for released in placed.frame.released):
            raise self.refuse(placed, "it is a column with released ends, which buildings do not have [E-SAP-21]")
        two = self.model.axes(placed.frame)[1]
        if min(abs(two[0]), abs(two[1])) > _STRAIGHT:
            raise self.refuse(
                placed, f"it is turned by {placed.frame.angle:g} degrees, neither along X nor along Y [E-SAP-22]"
            )
        place = ColumnLine(*placed.start[:2], PLAIN_AXES), placed.end[2]
        if place in self.columns:
            raise self.refuse(placed, "another frame stands in its place [E-SAP-19]")
        strong: Direction = "x" if abs(two[0]) > abs(two[1]) else "y"
        self.columns[place] = (*self._of_section(placed), strong)

    def _beam(self, place: BeamPlace, parts: list[Placed]) -> None:
        if [placed.half for placed in parts] not in ([0], [1, 2]):
            raise self.refuse(parts[-1], "another frame stands in its place [E-SAP-19]")
        whats = {self._of_section(placed) for placed in parts}
        if len(whats) > 1:
            raise self.refuse(parts[1], "the halves of a beam that braces meet have different sections [E-SAP-20]")
        for placed in parts:
            if abs(self.model.axes(placed.frame)[1][2]) < 1.0 - _STRAIGHT:
                raise self.refuse(placed, "its web is not upright [E-SAP-22]")
        ends = [self._beam_ends(placed) for placed in parts]
        if len(parts) == 2 and (ends[0][1], ends[1][0]) != ("rigid", "rigid"):
            raise self.refuse(parts[0], "a beam that braces meet is released in its middle [E-SAP-20]")
        start, end = ends[0][0], ends[-1][1]
        self.beams[place] = (*whats.pop(), start if start == end else f"{{start: {start}, end: {end}}}")

    def _beam_ends(self, placed: Placed) -> tuple[str, str]:
        """How the start and the end are joined, in the direction in which buildings count."""
        found = []
        for released, springs in zip(placed.frame.released, placed.frame.springs, strict=True):
            twist, weak, strong = released[3:]
            self.torsion_pins += twist
            stiff_floor = placed.start[2] in self.diaphragms
            if springs[3] or springs[4]:
                raise self.refuse(placed, "it has partial fixity in torsion or about its weak axis [E-SAP-21]")
            if strong and springs[5]:
                if weak and not stiff_floor:
                    raise self.refuse(
                        placed, "it is released about its weak axis and partially fixed about its strong [E-SAP-21]"
                    )
                found.append(quantity(springs[5], "kN*m/rad"))
            elif weak != strong and not stiff_floor:  # in a rigid floor beams do not bend about their weak axis
                raise self.refuse(
                    placed, "it is released about one of its axes alone, on a floor without diaphragm [E-SAP-21]"
                )
            else:
                found.append("pinned" if strong else "rigid")
        return (found[1], found[0]) if placed.reversed else (found[0], found[1])

    def _brace(self, place: BracePlace, parts: list[Placed]) -> None:
        for placed in parts:
            if not all(released[4] and released[5] for released in placed.frame.released):
                raise self.refuse(placed, "it is a brace whose ends are not released about both axes [E-SAP-21]")
        whats = {(*self._of_section(placed), self._share(placed)) for placed in parts}
        rising = [placed.start[:2] < placed.end[:2] for placed in parts]
        middles = [placed.middle for placed in parts]
        if len(whats) > 1:
            raise self.refuse(parts[1], "two braces of one bay have different sections [E-SAP-18]")
        if sorted(rising) == [False, True] and middles[0] == middles[1]:
            kind = {"": "cross", "end": "chevron", "start": "v"}[middles[0]]
        elif len(parts) == 1 and not middles[0]:
            kind = "rising" if rising[0] else "falling"
        else:
            raise self.refuse(parts[0], "the braces of its bay are no diagonal, cross, chevron or V [E-SAP-18]")
        self.braces[place] = (kind, *whats.pop())

    def _share(self, placed: Placed) -> bool:
        """Whether a brace has its whole area."""
        share = self.model.sections[placed.frame.section].axial_share
        if share not in (1.0, 0.5):
            raise self.refuse(placed, f"its section has `AMod` = {share:g}, not 1 or 0.5 [E-SAP-12]")
        return share == 1.0

    def _of_section(self, placed: Placed) -> tuple[str, str]:
        section = self.model.sections[placed.frame.section]
        if section.name not in self.sections:
            self.sections[section.name] = self._known(section)
        material = self.model.materials.get(section.material)
        if material is None or material.fy is None:
            why = f"buildings are of steel, and `{section.material}` has no Fy in the table of STEEL DATA [E-SAP-08]"
            raise self.model.error("section", section.name, why)
        if material.name not in self.materials:
            self.materials[material.name] = free_identifier(material.name, set(self.materials.values()))
        return self.sections[section.name], self.materials[material.name]

    def _known(self, section: Section) -> str:
        known = known_section(section)
        if known is None:
            return self._new_section(section)
        if known.apart > WORTH_TELLING:
            self.left_out.append(
                f"section {section.name} is taken as {known.name} of the catalogue, which differs by "
                f"{100.0 * known.apart:.2g} % in area or second moment of area"
            )
        return known.name

    def _new_section(self, section: Section) -> str:
        """Add a section that the catalogue has not: of plates, or by its properties."""
        name, plates = own_name(section, self.own_sections), plates_text(section)
        if plates:
            self.own_sections[name] = plates
            return name
        given = {
            "area": (section.area, "m^2"),
            "inertia": (section.I33, "m^4"),
            "weak_inertia": (section.I22, "m^4"),
            "torsion_constant": (section.J, "m^4"),
        }
        if any(value <= 0.0 for value, _ in given.values()):
            raise self.model.error(
                "section",
                section.name,
                "it is in none of edesign's lists of sections by its name or its sizes, and as an own section it needs "
                "Area, I33, I22 and TorsConst [E-SAP-27]",
            )
        shear = {"shear_area": (section.AS2, "m^2"), "weak_shear_area": (section.AS3, "m^2")}
        given |= {key: of for key, of in shear.items() if of[0] > 0.0}
        self.left_out.append(
            f"section {section.name} is in no list of edesign: it stays elastic, and members of it are not checked"
        )
        self.own_sections[name] = "{" + ", ".join(f"{key}: {quantity(*of)}" for key, of in given.items()) + "}"
        return name

    def _covered(self) -> dict[int, set[tuple[int, int]]]:
        """Bays of the plan that each floor covers: those whose corners all have joints of the floor."""
        there = set(self.grid.points.values())
        found = {}
        for floor in range(1, self.storeys + 1):
            found[floor] = {
                (i + 1, j + 1)
                for i in range(len(self.grid.x) - 1)
                for j in range(len(self.grid.y) - 1)
                if all((i + a, j + b, floor) in there for a in (0, 1) for b in (0, 1))
            }
        corners = {
            (i - a, j - b, floor) for floor, bays in found.items() for i, j in bays for a in (0, 1) for b in (0, 1)
        }
        loose = sorted(joint for joint, point in self.grid.points.items() if point[2] and point not in corners)
        if loose:
            raise self.model.error(
                "joint",
                loose[0],
                "it is at no corner of a rectangular bay with joints at all of its corners [E-SAP-23]",
            )
        return found


def _brace_place(placed: Placed) -> BracePlace:
    low: Point = min(placed.start[:2], placed.end[:2]) + (0,)
    storey = placed.end[2]
    if placed.along == "x":
        return BracePlace("x", low[1], low[0] + 1, storey, PLAIN_AXES)
    return BracePlace("y", low[0], low[1] + 1, storey, PLAIN_AXES)
