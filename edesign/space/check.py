"""What `edesign check` says of a building: its geometry, its members, loads and masses of its floors."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence
from typing import TypeVar

import numpy as np

from edesign.errors import InputError
from edesign.frame.sections.own_section import section_of
from edesign.frame.sections.section_lists import family_of, sections_of
from edesign.ground_motion.hazard import checked_hazard
from edesign.project.building.building import Building
from edesign.project.building.checks.plausible import unusual
from edesign.project.building.design import DEFAULT_PRICE, KINDS
from edesign.project.building.layout import DIRECTIONS
from edesign.project.building.names import column_name
from edesign.project.reading.problems import did_you_mean, listed
from edesign.space.elastic_design import ElasticAnalysis
from edesign.space.joint_stiffness import unusual_ends
from edesign.space.nonlinear.panel_zones import panels_of
from edesign.space.structure.frame import AXES, SpaceFrame
from edesign.space.structure.geometry import space_frame
from edesign.space.structure.load_cases import on_nodes
from edesign.space.structure.masses import floor_masses
from edesign.space.structure.secondary_beams import secondary_beams
from edesign.space.structure.steel_by_thickness import with_steel_by_thickness

R = TypeVar("R")
ELASTIC_ALONE = "own load cases act in the elastic design alone; histories, pushovers and modes have `loads.gravity`"


def check_building(building: Building) -> dict[str, str]:
    """Check what a run would meet, and describe the building in a few lines.

    Args:
        building: from `load_building`.

    Returns:
        Text by label: title, plan, storeys, members, loads, masses; and warnings, one a line.

    Raises:
        InputError: the values are not those of the text, a name in the hazard is unknown, a mass is negative, a
            panel zone has a member without I section, or the elastic design refuses the building before it analyses
            it, such as a mechanism.
    """
    building.check_unchanged()
    if building.hazard is not None:
        checked_hazard(building)
    _check_lists(building)
    if building.design is not None:
        ElasticAnalysis(building)
    made = with_steel_by_thickness(building)
    panels_of(made)
    frame = space_frame(made, design=True)
    warnings = building_warnings(building)
    return {
        "title": building.title,
        "plan": ", ".join(_bays(building.widths(along), along) for along in DIRECTIONS),
        "storeys": f"{building.n_storeys}, {building.levels[-1]:g} m high; {len(frame.node_names)} nodes",
        "members": _members(frame),
        **({"secondary": secondary} if (secondary := _secondary(made)) else {}),
        "loads": _loads(frame),
        "masses": _masses(frame) if building.masses is not None else "none",
        **({"warnings": "\n".join(warnings)} if warnings else {}),
    }


def floor_loads(frame: SpaceFrame) -> dict[str, np.ndarray]:
    """Return what each load case brings to the floors, (n_floors + 1,) N downwards, the base first, by case."""
    floors = frame.level_of_nodes
    return {
        name: np.bincount(floors, -on_nodes(frame, case)[:, 2], minlength=frame.n_floors + 1)
        for name, case in frame.cases.items()
    }


def _bays(widths: tuple[float, ...], along: str) -> str:
    count = f"{len(widths)} bay{'s' * (len(widths) > 1)}"
    return f"{count} along {along}, {sum(widths):g} m"


def _members(frame: SpaceFrame) -> str:
    """Number, kind, section and material of each group, a line each."""
    groups = Counter((m.group, m.kind, m.section, m.material) for m in frame.members)
    return "\n".join(
        f"{group}: {count} {kind}{'s' * (count > 1)} {section} {material}"
        for (group, kind, section, material), count in groups.items()
    )


def _secondary(building: Building) -> str:
    """Number, section, length and mass of the secondary beams that have a section, a line each; "" without any."""
    lines = []
    for beam in secondary_beams(building):
        length = beam.number * beam.length
        mass = length * section_of(building, beam.section).mass / 1e3
        lines.append(
            f"{beam.number} beams {beam.section} {beam.material} of {beam.length:.4g} m every {beam.strip:.4g} m: "
            f"{mass:.2f} t"
        )
    return "\n".join(lines)


def _loads(frame: SpaceFrame) -> str:
    """Total load of each case by floors, equal floors in one line, and in all."""
    loads = {name: np.round(values / 1e3, 6) for name, values in floor_loads(frame).items() if name[0] != "-"}
    for name, case in frame.cases.items():
        for number, axis in enumerate(AXES):
            if name[0] != "-" and case.nodal[:, number].any():
                sums = np.bincount(frame.level_of_nodes, case.nodal[:, number], minlength=frame.n_floors + 1)
                loads[f"{name} along {axis}"] = np.round(sums / 1e3, 6)
    rows = [tuple(values[floor] for values in loads.values()) for floor in range(1, frame.n_floors + 1)]
    names = list(loads)
    lines = [f"{floors}: {_sums(names, row)}" for floors, row in _floors(rows)]
    totals = tuple(float(values.sum()) for values in loads.values())
    return "\n".join([*lines, f"building, with the lower half of storey 1: {_sums(names, totals)}"])


def _sums(names: list[str], values: tuple[float, ...]) -> str:
    return ", ".join(f"{name} {value:.1f} kN" for name, value in zip(names, values, strict=True) if value) or "no load"


def _masses(frame: SpaceFrame) -> str:
    """Mass, its centre and radius of gyration at each floor, and the mass in all."""
    of = floor_masses(frame)
    rows = [
        f"{mass / 1e3:.1f} t at ({x:.2f}, {y:.2f}) m, radius of gyration {gyration:.2f} m" if mass else "no mass"
        for mass, x, y, gyration in list(zip(of.mass, of.x, of.y, of.gyration, strict=True))[1:]
    ]
    lines = [f"{floors_text}: {text}" for floors_text, text in _floors(rows)]
    return "\n".join([*lines, f"building: {frame.node_mass.sum() / 1e3:.1f} t"])


def _floors(rows: Sequence[R]) -> Iterator[tuple[str, R]]:
    """Each run of equal rows with the floors that it is of."""
    first = 0
    for i in range(1, len(rows) + 1):
        if i == len(rows) or rows[i] != rows[first]:
            yield (f"floor {first + 1}" if i == first + 1 else f"floors {first + 1}-{i}"), rows[first]
            first = i


def _check_lists(building: Building) -> None:
    """Check that the sections to choose from exist; the names of families with prices too."""
    if building.design is None:
        return
    select = building.design.select
    lists: dict[tuple[str, ...], tuple[str, ...]] = {(kind,): getattr(select.lists, kind) for kind in KINDS}
    braces = {"braces", *(run.group for run in building.braces)}
    lists |= {("groups", group): names for group, names in select.lists.groups.items()}
    families = {DEFAULT_PRICE}
    for keys, names in lists.items():
        for place, name in enumerate(names):
            try:
                found = sections_of(name)
                families |= {family_of(section.name) for section in found}
            except InputError as error:
                where = building.where("design", "select", "lists", *keys, place)
                raise InputError(f"{where}: design.select.lists.{'.'.join(keys)}: {error}") from error
            if keys[-1] not in braces and any(section.axial_alone for section in found):
                where = building.where("design", "select", "lists", *keys, place)
                raise InputError(
                    f"{where}: design.select.lists.{'.'.join(keys)}: `{name}` are sections that only braces can have; "
                    "columns and beams have I, H or hollow sections [E-SPACE-08]"
                )
    for family in select.prices:
        if family.upper() not in families and family != DEFAULT_PRICE:
            where = building.where("design", "select", "prices", family)
            near = did_you_mean(family, families)
            raise InputError(
                f"{where}: design.select.prices: no section of the lists is a `{family}`{near}; prices are for "
                f"{listed(sorted(families))} [E-SPACE-08]"
            )


def building_warnings(building: Building) -> list[str]:
    """List what is allowed and may not be meant: unusual values and ends, columns that grow upwards.

    Returns:
        Sentences, each with its place in the file.
    """
    found = [f"{building.where(*keys)}: {text}" for keys, text in unusual(building)] + unusual_ends(building)
    at = building.layout.column_at
    larger = [
        column_name(line, storey)
        for (line, storey), run in at.items()
        if (below := at.get((line, storey - 1))) is not None
        and section_of(building, run.section).A > section_of(building, below.section).A
    ]
    if building.loads.cases and (building.analyses or building.design is None):
        found.append(f"{building.where('loads', 'cases')}: {ELASTIC_ALONE}")
    if larger:
        found.append(f"columns are larger than those below them: {listed(larger)}")
    return found
