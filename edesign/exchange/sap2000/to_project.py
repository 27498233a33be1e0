"""A plane frame of SAP2000 as the text of a project file."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from edesign.errors import InputError
from edesign.exchange.sap2000.floors import diaphragm_floors
from edesign.exchange.sap2000.grid import Grid, Point
from edesign.exchange.sap2000.model import Sap2000Model
from edesign.exchange.sap2000.plane_loads import PlaneLoads
from edesign.exchange.sap2000.plane_members import PlaneMembers
from edesign.exchange.sap2000.read_loads import nodal_masses
from edesign.exchange.sap2000.taken_loads import mass_factors, taken_loads
from edesign.exchange.sap2000.written import equal_or_list, number_text, quantity
from edesign.project.notation.names import line_name
from edesign.project.notation.units import STANDARD_GRAVITY
from edesign.project.reading.yaml_edit import yaml_text
from edesign.space.extract.selections import runs

U = (0, 1)
"""Numbers of the degrees ux and uy of a joint, and of rx and ry: of the plane X-Z the first and the last count."""


def project_text(model: Sap2000Model, grid: Grid) -> tuple[str, list[str]]:
    """Return a plane frame as a project file, and sentences on what it does not have of the model.

    Args:
        model: in SI.
        grid: on which it stands, in one vertical plane.

    Raises:
        InputError: the frame has what projects do not have.
    """
    found = _ProjectText(model, grid)
    return "\n".join(found.text()), found.left_out


class _ProjectText:
    """The parts of the file."""

    def __init__(self, model: Sap2000Model, grid: Grid) -> None:
        self.model, self.grid = model, grid
        levels = grid.x if grid.plane == "x" else grid.y
        self.widths = np.diff(levels)
        self.heights = np.diff(grid.z)
        self.lines = range(len(levels))
        self.bays = range(1, len(levels))
        self.storeys = len(self.heights)
        if not self.storeys or not self.bays:
            raise InputError("the model has no storey, or only one column line: there is no frame [E-SAP-07]")
        self.taken = taken_loads(model)
        self.members = PlaneMembers(model, grid)
        self.across = self.members.across
        self.loads = PlaneLoads(model, grid, self.taken, self.across)
        self.left_out = [*self.taken.left_out, *self.members.left_out, *self.loads.left_out]

    def _line(self, point: Point) -> int:
        return point[self.across]

    def text(self) -> list[str]:
        parts = (self._grid(), self._members_text(), self._sections_text(), self._loads_text(), self._masses_text())
        return [line for part in parts for line in part] + self._end()

    def _grid(self) -> list[str]:
        title = yaml_text(self.model.title or "Frame from SAP2000")
        return [
            *("", "edesign: 1", f"title: {title}", "", "frame:"),
            f"  bays: {equal_or_list(self.widths, 'width')}",
            f"  storeys: {equal_or_list(self.heights, 'height')}",
            *self._supports(),
            f"  diaphragms: {self._diaphragms()}",
        ]

    def _supports(self) -> list[str]:
        degrees = (self.across, 2, 4 if self.across == 0 else 3)
        found = {}
        for joint, point in self.grid.points.items():
            restraints = self.model.restraints.get(joint, (False,) * 6)
            springs = self.model.springs.get(joint, (0.0,) * 6)
            three = [(restraints[d], springs[d]) for d in degrees]
            if point[2] > 0:
                self._check_above_base(joint, three)
                continue
            found[self._line(point)] = _support(three)
        for joint in self.grid.middles:
            self._check_above_base(
                joint, [(any(self.model.restraints.get(joint, ())[d : d + 1]), 0.0) for d in degrees]
            )
        kinds = set(found.values())
        if len(kinds) == 1:
            return [
                f"  supports: {kinds.pop()}" if not next(iter(found.values())).startswith("{") else "  supports:"
            ] + ([f"    default: {next(iter(found.values()))}"] if next(iter(found.values())).startswith("{") else [])
        return ["  supports:", *(f"    {line_name(line)}: {kind}" for line, kind in sorted(found.items()))]

    def _check_above_base(self, joint: str, supports: Sequence[tuple[bool, float]]) -> None:
        """Refuse supports above the base; a rotation that nothing turns may be restrained."""
        turns_freely = all(self._is_pinned_at(frame.name, joint) for frame in self.grid.frames_at(joint))
        if (
            supports[0][0]
            or supports[1][0]
            or (supports[2][0] and not turns_freely)
            or any(spring for _, spring in supports)
        ):
            raise self.model.error(
                "joint", joint, "it is supported above the base, which projects do not have [E-SAP-24]"
            )

    def _is_pinned_at(self, frame: str, joint: str) -> bool:
        of = self.model.frames[frame]
        released = of.released[0 if of.i == joint else 1]
        return released[4] or released[5]

    def _diaphragms(self) -> str:
        floors = diaphragm_floors(self.model, self.grid)
        if 0 in floors:
            raise InputError("a diaphragm at the base level, which projects do not have [E-SAP-14]")
        text = ", ".join(map(str, sorted(floors)))
        return "none" if not floors else "all" if len(floors) == self.storeys else f"[{text}]"

    def _members_text(self) -> list[str]:
        text = ["  columns:"]
        for at, storeys, (name, steel, axis) in runs(self.members.columns, self.lines, self.storeys, line_name):
            text.append(f"    - {{lines: {at}, storeys: {storeys}, section: {name}, material: {steel}{axis}}}")
        text = text if self.members.columns else ["  columns: []"]
        text.append("  beams:" if self.members.beams else "  beams: []")
        for at, floors, (name, steel, axis) in runs(self.members.beams, self.bays, self.storeys, str):
            text.append(f"    - {{bays: {at}, floors: {floors}, section: {name}, material: {steel}{axis}}}")
        text += ["  braces:"] if self.members.braces else []
        for at, storeys, (kind, name, steel, full) in runs(self.members.braces, self.bays, self.storeys, str):
            more = "" if full else ", compression: false"
            where = f"bays: {at}, storeys: {storeys}, kind: {kind}"
            text.append(f"    - {{{where}, section: {name}, material: {steel}{more}}}")
        return [*text, *self._missing(), *self._releases(), ""]

    def _missing(self) -> list[str]:
        levels = range(1, self.storeys + 1)
        columns = {(i, s): True for s in levels for i in self.lines if (i, s) not in self.members.columns}
        beams = {(b, f): True for f in levels for b in self.bays if (b, f) not in self.members.beams}
        text = ["  missing:"] if columns or beams else []
        if columns:
            text.append("    columns:")
            for at, s, _ in runs(columns, self.lines, self.storeys, line_name):
                text.append(f"      - {{lines: {at}, storeys: {s}}}")
        if beams:
            text.append("    beams:")
            for at, f, _ in runs(beams, self.bays, self.storeys, str):
                text.append(f"      - {{bays: {at}, floors: {f}}}")
        return text

    def _releases(self) -> list[str]:
        ends = {(True, True): "both", (True, False): "start", (False, True): "end"}
        beams = {place: ends[pins] for place, pins in self.members.beam_releases.items() if any(pins)}
        columns = {
            (self._line(placed.start), placed.end[2]): ends[pins]
            for placed in self.grid.placed
            if placed.kind == "column" and any(pins := self.members.released[placed.frame.name])
        }
        text = ["  releases:"] if beams or columns else []
        for at, floors, which in runs(beams, self.bays, self.storeys, str):
            text.append(f"    - {{beams: {{bays: {at}, floors: {floors}}}, ends: {which}}}")
        for at, storeys, which in runs(columns, self.lines, self.storeys, line_name):
            text.append(f"    - {{columns: {{lines: {at}, storeys: {storeys}}}, ends: {which}}}")
        return text

    def _sections_text(self) -> list[str]:
        text = ["sections:", *(f"  {name}: {own}" for name, own in self.members.own_sections.items()), ""]
        text = text if self.members.own_sections else []
        fillets = "true" if self.members.fillets else "false"
        text += [f"fibres: {{fillets: {fillets}}}                # as in the areas of the model", ""]
        text.append("materials:")
        for name, called in self.members.materials.items():
            material = self.model.materials[name]
            law = "law: elastic" if material.fy is None else f"law: bilinear, fy: {quantity(material.fy, 'MPa')}"
            text.append(f"  {called}: {{{law}, E: {quantity(material.E, 'GPa')}}}")
        return [*text, ""]

    def _loads_text(self) -> list[str]:
        p_delta = self.model.gravity is not None and self.model.gravity.p_delta
        columns = "p_delta" if p_delta else "linear"
        return [
            *self.loads.text(self.lines, self.bays, self.storeys),
            f"elements: {{geometry: {{columns: {columns}, beams: linear, braces: linear}}}}",
            "",
        ]

    def _masses_text(self) -> list[str]:
        masses = nodal_masses(self.model)
        horizontal = {joint: float(mass[self.across]) for joint, mass in masses.items()}
        vertical = {joint: float(mass[2]) for joint, mass in masses.items()}
        above = {joint: mass for joint, mass in horizontal.items() if self._level(joint) > 0 and mass > 0.0}
        self.has_masses = bool(above)
        if not above:
            return []
        same = all(abs(vertical[joint] - mass) <= 1e-9 * mass for joint, mass in above.items())
        if not same and any(vertical[joint] > 0.0 for joint in above):
            self.left_out.append("vertical masses: they differ from the horizontal ones; masses act horizontally")
        text = ["masses:", f"  directions: {'both' if same else 'horizontal'}"]
        if any(joint in self.grid.middles for joint in above):
            every = {joint: horizontal.get(joint, 0.0) for joint in self._joints() if self._level(joint) > 0}
            factors = mass_factors(self.model, self.taken, every, STANDARD_GRAVITY)
            joint = next(joint for joint in above if joint in self.grid.middles)
            variable = {factor for name, factor in (factors or {}).items() if name != "G"}
            if factors is None or len(variable) > 1:
                raise self.model.error(
                    "joint",
                    joint,
                    "it has a mass in the middle of a beam that does not follow from the loads there [E-SAP-15]",
                )
            Q = number_text(variable.pop()) if variable else "0"
            return [*text, f"  from_loads: {{G: {number_text(factors['G'])}, Q: {Q}}}", ""]
        at = {(self._line(self.grid.points[j]), self._level(j)): quantity(mass, "t") for j, mass in above.items()}
        text.append("  given:")
        for lines, floors, mass in runs(at, self.lines, self.storeys, line_name):
            text.append(f"    - {{lines: {lines}, floors: {floors}, mass: {mass}}}")
        return [*text, ""]

    def _joints(self) -> list[str]:
        return [joint for joint in self.model.joints if self.grid.is_used(joint)]

    def _level(self, joint: str) -> int:
        point = self.grid.points.get(joint)
        return point[2] if point is not None else self.grid.point(self.grid.middles[joint][0])[2]

    def _end(self) -> list[str]:
        text = []
        if self.model.links:
            text += self._dampers()
        if standing := self.model.standing_links():
            self.left_out.append(f"links {standing}: their share of the gravity loads; dampers are set in under these")
        text += ["analyses:", "  - {name: gravity, kind: gravity}"]
        if self.has_masses:
            text.append(f"  - {{name: modes, kind: modal, modes: {min(3, self.storeys)}}}")
        return [*text, ""]

    def _dampers(self) -> list[str]:
        laws, devices = [], []
        for name, found in self.model.link_properties.items():
            c = f"{number_text(found.c)} N*(s/m)^{number_text(found.exponent)}"
            if found.kind == "Linear" or not found.nonlinear:
                parameters = f"k: {quantity(found.stiffness, 'kN/m')}, c: {quantity(found.damping, 'kN*s/m')}"
                law = "kelvin_voigt"
            else:
                parameters = f"c: {c}, alpha: {number_text(found.exponent)}, k: {quantity(found.k, 'kN/m')}"
                law = "maxwell_power"
            laws.append(f"    {yaml_text(name)}: {{type: {law}, parameters: {{{parameters}}}}}")
        for link in self.model.links.values():
            ends = [self._node(link.name, joint) for joint in (link.i, link.j)]
            devices.append(f"    - {{kind: nodes, nodes: [{', '.join(ends)}], law: {yaml_text(link.property)}}}")
        return ["dampers:", "  laws:", *laws, "  devices:", *devices, ""]

    def _node(self, link: str, joint: str) -> str:
        point = self.grid.points.get(joint)
        if point is None:
            raise self.model.error(
                "link", link, f"its joint {joint} is no end of a column or of a whole beam [E-SAP-13]"
            )
        return f"{line_name(self._line(point))}{point[2]}"


def _support(supports: Sequence[tuple[bool, float]]) -> str:
    (ux, kx), (uz, kz), (ry, kr) = supports
    if not any((kx and not ux, kz and not uz, kr and not ry)):
        kind = {(True, True, True): "fixed", (True, True, False): "pinned", (False, True, False): "roller"}
        if (ux, uz, ry) in kind:
            return kind[ux, uz, ry]
    parts = []
    for key, fixed, stiffness, unit in (
        ("horizontal", ux, kx, "kN/m"),
        ("vertical", uz, kz, "kN/m"),
        ("rotation", ry, kr, "kN*m/rad"),
    ):
        parts.append(f"{key}: {'fixed' if fixed else quantity(stiffness, unit) if stiffness else 'free'}")
    return f"{{{', '.join(parts)}}}"
