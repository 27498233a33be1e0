"""An isolated base of a building: what it carries, how its column bases are supported, and the beams between them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

from edesign.core import Model
from edesign.frame.isolation import isolator_under
from edesign.frame.sections.own_section import section_of
from edesign.frame.supports import Direction, Grounds, support_springs
from edesign.project.building.building import Building
from edesign.project.building.isolation import Isolation
from edesign.project.building.layout import DIRECTIONS, Diaphragm, corners
from edesign.project.building.names import bay_lines, node_name
from edesign.project.building.supports import Springs
from edesign.project.frame.supports import VerticalSpring
from edesign.project.notation.units import STANDARD_GRAVITY
from edesign.space.structure.frame import NO_DIAPHRAGM, SpaceFrame
from edesign.space.structure.masses import gravity_factor, psi_2

_FREE_IN_PLAN = ("free", "free")
_WEB = (0.0, 0.0, 1.0)


@dataclass(frozen=True)
class BuildingBase:
    """The isolated base of a building.

    Attributes:
        frame: the building on it: a rigid floor 0, with the mass of the base and without supports in plan; with the
            base fixed it has these, and no rigid floor.
        directions: by column base what supports each of its degrees beside the isolators.
        loads: of the gravity combination on the base, N downwards, by column base.
    """

    frame: SpaceFrame
    directions: Mapping[str, tuple[Direction, ...]]
    loads: Mapping[str, float]


def isolated_base(building: Building, isolation: Isolation, frame: SpaceFrame, fixed_base: bool) -> BuildingBase:
    """Return the isolated base of a building, and the building on it.

    Args:
        building: from `load_building`.
        isolation: its base and isolators.
        frame: the building on its supports.
        fixed_base: whether the base is fixed in plan, in place of its isolators.
    """
    nodes = {name: number for number, name in enumerate(frame.node_names)}
    areas = _areas(building)
    directions = {
        node_name(line, 0): _directions(building, isolation, str(line), fixed_base)
        for line in building.layout.node_lines[0]
    }
    fixed, springs = frame.fixed.copy(), frame.springs.copy()
    rigid = frame.diaphragms if fixed_base else (Diaphragm(0), *frame.diaphragms)
    tied, mass = frame.node_diaphragm.copy(), frame.node_mass.copy()
    tied[tied != NO_DIAPHRAGM] += len(rigid) - len(frame.diaphragms)
    of_base = _mass(building, isolation, areas)
    for name, restraints in directions.items():
        node = nodes[name]
        fixed[node] = [restraint == "fixed" for restraint in restraints]
        springs[node] = 0.0
        tied[node] = NO_DIAPHRAGM if fixed_base else 0
        mass[node] += of_base.get(name, 0.0)
    G, Q = isolation.base.G, isolation.base.Q
    load = gravity_factor(building, "permanent") * G
    if isolation.base.category is not None:
        load += gravity_factor(building, isolation.base.category) * Q
    standing = replace(frame, fixed=fixed, springs=springs, node_diaphragm=tied, diaphragms=rigid, node_mass=mass)
    return BuildingBase(standing, directions, {name: load * area for name, area in areas.items()})


def base_mass(building: Building) -> float:
    """Return the mass of the isolated base of a building, kg; 0 without one."""
    isolation = building.isolation
    return 0.0 if isolation is None else sum(_mass(building, isolation, _areas(building)).values())


def support_base(
    base: BuildingBase, model: Model, supports: dict[str, tuple[bool, ...]], grounds: dict[str, Grounds]
) -> None:
    """Support the column bases beside their isolators by springs, and name what holds them.

    Args:
        model: of the core, which has the nodes of the frame in their order and its fixed supports.
        supports: by node which degrees are restrained; isolators restrain those in plan.
        grounds: by node the other ends of its springs.
    """
    for name, restraints in base.directions.items():
        node = base.frame.node_names.index(name)
        supports[name] = (True, True, *(restraint != "free" for restraint in restraints[2:5]), False)
        if not all(isinstance(restraint, str) for restraint in restraints):
            grounds[name] = support_springs(model, name, node, model.node_places[node], restraints)


def add_building_base_beams(building: Building, isolation: Isolation, model: Model, nodes: Mapping[str, int]) -> None:
    """Add the beams of an isolated base, if it has any, along x and y from each column base to the next one.

    They stay elastic, and are no members: they carry what the column bases turn with to the isolators.

    Args:
        building: from `load_building`.
        model: has the nodes already.
        nodes: ids by name.
    """
    beams = isolation.base.beams
    if beams is None:
        return
    shape, steel = section_of(building, beams.section), building.materials[beams.material]
    G = steel.E / (2.0 * (1.0 + steel.nu))
    section = model.elastic_section(steel.E * shape.A, steel.E * shape.I_z, steel.E * shape.I_y, G * shape.I_t)
    for along in DIRECTIONS:
        for frame in range(building.n_frames(along)):
            last, axes = "", building.axes
            lines = [bay_lines(along, frame, 1, axes)[0]]
            lines += [bay_lines(along, frame, bay + 1, axes)[1] for bay in range(building.n_bays(along))]
            for name in (node_name(line, 0) for line in lines):
                if name not in nodes:
                    continue
                if last:
                    title = f"beam of the base from {last} to {name}"
                    model.beam_column(title, nodes[last], nodes[name], section, geometry="linear", web=_WEB)
                last = name


def _directions(building: Building, isolation: Isolation, line: str, fixed_base: bool) -> tuple[Direction, ...]:
    """What supports the degrees of a column base; of a line without isolator, which is free in plan, its support."""
    isolator = isolator_under(isolation, line, building.grid)
    in_plan: tuple[Direction, Direction] = ("fixed", "fixed") if fixed_base else _FREE_IN_PLAN
    turn: Direction = "free" if isolation.base.beams is not None else isolation.base.rotation or "free"
    about: Direction = "fixed" if fixed_base else "free"
    if isolator is None:
        found = next(building.support(at) for at in building.layout.node_lines[0] if str(at) == line)
        assert isinstance(found, Springs), "its check refuses footings beside isolators"
        return (*in_plan, found.uz, turn, turn, about)
    vertical: Direction = isolator.vertical
    if isinstance(vertical, VerticalSpring):
        resistance = None if vertical.resistance is None else isolator.number * vertical.resistance
        change = {"stiffness": isolator.number * vertical.stiffness, "resistance": resistance}
        vertical = vertical.model_copy(update=change)
    elif isinstance(vertical, float):
        vertical = isolator.number * vertical
    return (*in_plan, vertical, turn, turn, about)


def _areas(building: Building) -> dict[str, float]:
    """Area of the base that each column base carries, m2: bays of the first floor in equal parts at their corners."""
    bases = building.layout.node_lines[0]
    found = {node_name(line, 0): 0.0 for line in bases}
    for panel in sorted(building.layout.floors[1]):
        carrying: Sequence = [line for line in corners(panel, building.axes) if line in bases] or bases
        area = building.widths("x")[panel[0] - 1] * building.widths("y")[panel[1] - 1]
        for line in carrying:
            found[node_name(line, 0)] += area / len(carrying)
    return found


def _mass(building: Building, isolation: Isolation, areas: Mapping[str, float]) -> dict[str, float]:
    """Mass of the base at its column bases, kg."""
    base, masses = isolation.base, building.masses
    if base.mass is not None:
        whole = sum(areas.values())
        return {name: base.mass * area / whole for name, area in areas.items()}
    if masses is None or masses.from_loads is None:
        return {}
    load = masses.from_loads.G * base.G
    if base.category is not None:
        load += masses.phi * psi_2(building, base.category) * base.Q
    return {name: load * area / STANDARD_GRAVITY for name, area in areas.items()}
