"""A model of SAP2000 in three dimensions as the text of a building file."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Mapping

import numpy as np

from edesign.errors import InputError
from edesign.exchange.sap2000.floors import diaphragm_floors
from edesign.exchange.sap2000.grid import Grid
from edesign.exchange.sap2000.model import Sap2000Model
from edesign.exchange.sap2000.space_loads import SpaceLoads
from edesign.exchange.sap2000.space_masses import masses_text
from edesign.exchange.sap2000.space_members import SpaceMembers
from edesign.exchange.sap2000.taken_loads import taken_loads
from edesign.exchange.sap2000.written import equal_or_list, number_text, quantity
from edesign.project.building.layout import edges
from edesign.project.building.names import BeamPlace, ColumnLine, Direction, line_label
from edesign.project.notation.axes import PLAIN_AXES
from edesign.project.notation.units import STANDARD_GRAVITY
from edesign.project.reading.yaml_edit import yaml_text
from edesign.space.extract.selections import runs, selection

_UNITS = ("kN/m", "kN/m", "kN/m", "kN*m/rad", "kN*m/rad", "kN*m/rad")
_KEYS = ("ux", "uy", "uz", "rx", "ry", "rz")


def building_text(model: Sap2000Model, grid: Grid) -> tuple[str, list[str]]:
    """Return a model as a building file, and sentences on what it does not have of the model.

    Args:
        model: in SI.
        grid: on which it stands.

    Raises:
        InputError: the model has what building files do not have.
    """
    found = _BuildingText(model, grid)
    return "\n".join(found.text()), found.left_out


class _BuildingText:
    """The parts of the file."""

    def __init__(self, model: Sap2000Model, grid: Grid) -> None:
        self.model, self.grid = model, grid
        self.storeys = len(grid.z) - 1
        if not self.storeys:
            raise InputError("the model has no storey: all joints are at one level [E-SAP-07]")
        self.taken = taken_loads(model)
        self.diaphragms = diaphragm_floors(model, grid)
        self.members = SpaceMembers(model, grid, self.diaphragms)
        self.loads = SpaceLoads(model, grid, self.taken)
        self.left_out = [*self.taken.left_out, *self.members.left_out, *self.loads.left_out]

    def text(self) -> list[str]:
        parts = (
            self._plan(),
            self._supports(),
            self._columns_text(),
            self._beams_text(),
            self._braces_text(),
            self._missing(),
            self._sections_text(),
            self._materials_text(),
            self._loads_text(),
            masses_text(self.model, self.grid, self.taken, self.left_out),
        )
        return [line for part in parts for line in part]

    def _plan(self) -> list[str]:
        x, y, z = (np.diff(levels) for levels in (self.grid.x, self.grid.y, self.grid.z))
        text = ["", "edesign_building: 1", f"title: {yaml_text(self.model.title or 'Building from SAP2000')}", ""]
        text += [f"plan: {{x: {equal_or_list(x, 'width')}, y: {equal_or_list(y, 'width')}}}"]
        text += [f"storeys: {equal_or_list(z, 'height')}"]
        every = {(i + 1, j + 1) for i in range(len(x)) for j in range(len(y))}
        setbacks = [
            f"  - {{floors: {floor}, bays: [{', '.join(_blocks(bays))}]}}"
            for floor, bays in self.members.floors.items()
            if bays != every
        ]
        text += ["setbacks:", *setbacks] if setbacks else []
        numbers = list(range(1, self.storeys + 1))
        floors = sorted(self.diaphragms)
        return [*text, f"diaphragms: {selection(floors, numbers, str) if floors else 'none'}"]

    def _supports(self) -> list[str]:
        found = {}
        for joint, point in self.grid.points.items():
            restraints = self.model.restraints.get(joint, (False,) * 6)
            springs = self.model.springs.get(joint, (0.0,) * 6)
            if point[2] > 0:
                if any(restraints) or any(springs):
                    raise self.model.error(
                        "joint", joint, "it is supported above the base, which buildings do not have [E-SAP-24]"
                    )
                continue
            found[ColumnLine(*point[:2], PLAIN_AXES)] = _support(restraints, springs)
        if joint := next((j for j in self.grid.middles if any(self.model.restraints.get(j, ()))), ""):
            raise self.model.error(
                "joint", joint, "it is supported above the base, which buildings do not have [E-SAP-24]"
            )
        kinds = list(found.values())
        usual = max(set(kinds), key=kinds.count)
        others = [f"  {line}: {kind}" for line, kind in sorted(found.items()) if kind != usual]
        return ["supports:", f"  default: {usual}", *others, ""]

    def _columns_text(self) -> list[str]:
        """Runs of columns on the lines across x, line by line across y."""
        text = ["columns:"]
        grouped: dict[tuple[str, str, Direction], dict[tuple[int, int], bool]] = defaultdict(dict)
        lines = sorted({line for line, _ in self.members.columns})
        for (line, storey), what in self.members.columns.items():
            grouped[what][lines.index(line), storey] = True
        for (section, steel, strong), places in grouped.items():
            for at, storeys, _ in runs(places, range(len(lines)), self.storeys, lambda i: str(lines[i])):
                text.append(
                    f"  - {{at: {_single(at, lines)}, storeys: {storeys}, section: {section}, material: {steel}, "
                    f"strong: {strong}}}"
                )
        return text

    def _beams_text(self) -> list[str]:
        text = ["beams:"]
        for along in ("x", "y"):
            text += self._runs(along, self.members.beams, _beam_text)
        return text

    def _braces_text(self) -> list[str]:
        text = []
        for along in ("x", "y"):
            text += self._runs(along, self.members.braces, _brace_text)
        return ["braces:", *text] if text else []

    def _runs(self, along: str, places: Mapping, what: Callable[[tuple], str], word: str = "") -> list[str]:
        """Entries of beams or braces along x or y, frame by frame."""
        word = word or ("storeys" if places is self.members.braces else "floors")
        bays = range(1, len(self.grid.x if along == "x" else self.grid.y))
        by_frame: dict[tuple, list[int]] = defaultdict(list)
        frames = len(self.grid.y if along == "x" else self.grid.x)
        for frame in range(frames):
            own = {(p[2], p[3]): value for p, value in places.items() if p.along == along and p.frame == frame}
            for at, levels, value in runs(own, bays, self.storeys, str):
                by_frame[at, levels, value].append(frame)
        text = []
        for (at, levels, value), of in by_frame.items():
            names = selection(of, list(range(frames)), lambda n: line_label(along, n, PLAIN_AXES))  # type: ignore[arg-type]
            if word == "storeys" and names == "all":
                names = f"{line_label(along, 0, PLAIN_AXES)}-{line_label(along, frames - 1, PLAIN_AXES)}"  # type: ignore[arg-type]
            where = f"along: {along}, frames: {names}, bays: {at}, {word}: {levels}"
            text.append(f"  - {{{where}{what(value)}}}")
        return text

    def _missing(self) -> list[str]:
        beams = {
            place
            for floor, bays in self.members.floors.items()
            for bay in bays
            for place in edges(bay, floor, PLAIN_AXES)
        }
        corners = {
            (ColumnLine(i - a, j - b, PLAIN_AXES), floor)
            for floor, bays in self.members.floors.items()
            for i, j in bays
            for a in (0, 1)
            for b in (0, 1)
        }
        for place in self.members.beams:
            if place not in beams:
                raise InputError(f"a beam stands at {place}, beside no bay that its floor covers [E-SAP-23]")
        for line, storey in self.members.columns:
            if (line, storey) not in corners:
                raise InputError(f"a column stands on line {line} in storey {storey}, below no covered bay [E-SAP-23]")
        no_beams = {place: "" for place in sorted(beams - set(self.members.beams))}
        no_columns = sorted(corners - set(self.members.columns))
        text = []
        if no_columns:
            text.append("  columns:")
            text += [f"    - {{at: {line}, storeys: {storey}}}" for line, storey in no_columns]
        if no_beams:
            text.append("  beams:")
            for along in ("x", "y"):
                text += [f"  {line}" for line in self._runs(along, no_beams, lambda _: "", "floors")]
        return ["missing:", *text, ""] if text else [""]

    def _sections_text(self) -> list[str]:
        own = [f"  {name}: {of}" for name, of in self.members.own_sections.items()]
        return ["sections:", *own, ""] if own else []

    def _materials_text(self) -> list[str]:
        text = ["materials:"]
        for name, called in self.members.materials.items():
            steel = self.model.materials[name]
            density = steel.weight / STANDARD_GRAVITY if self.loads.self_weight else steel.density
            more = f", density: {quantity(density, 'kg/m^3')}" if density > 0.0 else ""
            fy, E = quantity(steel.fy or 0.0, "MPa"), quantity(steel.E, "GPa")
            text.append(f"  {called}: {{fy: {fy}, E: {E}, nu: {number_text(steel.nu)}{more}}}")
        return [*text, ""]

    def _loads_text(self) -> list[str]:
        by_beam = self.loads.beam_texts()
        beams = self._loads_of_beams(by_beam)
        nodes = self.loads.node_texts()
        found = ["loads:", f"  self_weight: {'true' if self.loads.self_weight else 'false'}"]
        found += ["  beams:", *beams] if beams else []
        found += ["  nodes:", *(f"    - {{{node}}}" for node in nodes)] if nodes else []
        return [*found, ""]

    def _loads_of_beams(self, by_beam: Mapping[BeamPlace, tuple[str, ...]]) -> list[str]:
        single: dict[str, dict[BeamPlace, str]] = defaultdict(dict)
        for place, loads in by_beam.items():
            for load in loads:
                single[load][place] = load
        text = []
        for places in single.values():
            for along in ("x", "y"):
                text += [f"  {line}" for line in self._runs(along, places, lambda one: f", {one}", "floors")]
        return text


def _beam_text(value: tuple[str, str, str]) -> str:
    section, steel, ends = value
    return f", section: {section}, material: {steel}" + ("" if ends == "rigid" else f", ends: {ends}")


def _brace_text(value: tuple[str, str, str, bool]) -> str:
    kind, section, steel, whole = value
    return f", kind: {kind}, section: {section}, material: {steel}, compression: {'true' if whole else 'false'}"


def _single(at: str, lines: list[ColumnLine]) -> str:
    """A selection of column lines, whose ranges here run along the list and are written one by one."""
    if at == "all":
        return "all"
    names = [str(line) for line in lines]
    found: list[str] = []
    for part in at.strip("[]").split(", "):
        first, _, last = part.partition("-")
        found += names[names.index(first) : names.index(last or first) + 1]
    return found[0] if len(found) == 1 else f"[{', '.join(found)}]"


def _blocks(bays: set[tuple[int, int]]) -> list[str]:
    """Blocks of bays that together are a set of them: rows along x, those that are alike together."""
    rows: dict[tuple[int, ...], list[int]] = defaultdict(list)
    for j in sorted({j for _, j in bays}):
        rows[tuple(sorted(i for i, row in bays if row == j))].append(j)
    return [f"{{x: {selection(list(xs), [], str)}, y: {selection(ys, [], str)}}}" for xs, ys in rows.items()]


def _support(restraints: tuple[bool, ...], springs: tuple[float, ...]) -> str:
    if all(restraints):
        return "fixed"
    soft = any(stiffness and not fixed for stiffness, fixed in zip(springs, restraints, strict=True))
    if restraints == (True, True, True, False, False, True) and not soft:
        return "pinned"
    parts = [
        f"{key}: {'fixed' if fixed else quantity(stiffness, unit) if stiffness else 'free'}"
        for key, fixed, stiffness, unit in zip(_KEYS, restraints, springs, _UNITS, strict=True)
    ]
    return f"{{{', '.join(parts)}}}"
