"""Cross checks of a building: selections inside the grid, every place covered, members that stand on something."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterable

from pydantic_core import PydanticCustomError

from edesign.project.building.building import Building
from edesign.project.building.checks.selections import Selections
from edesign.project.building.layout import DIRECTIONS, Panel, corners, met_beam, ways
from edesign.project.building.members import CHEVRONS, BeamRun, BraceRun, ColumnRun
from edesign.project.building.names import BeamPlace, column_name, frame_name, node_name
from edesign.project.building.places import panels_in, parse_column_lines, parts_of
from edesign.project.checks.axes import check_axes
from edesign.project.checks.sections import check_own_sections
from edesign.project.frame.sections import Catalogue, RectangleSection, SpaceElasticSection, no_section
from edesign.project.notation.axes import Direction, GridAxes
from edesign.project.reading.problems import Keys, Problems, listed, unknown_name

MOST_COLUMNS = 50_000
"""Of a building: twenty times those of 200 storeys with 12 column lines."""

Run = ColumnRun | BeamRun | BraceRun


def check_layout(building: Building, problems: Problems, profiles: Catalogue | None) -> None:
    """Check the grid, the members, their sections and materials.

    Args:
        building: read without schema problems.
        profiles: names of the catalogue; None leaves section names unchecked.
    """
    columns = (building.n_bays("x") + 1) * (building.n_bays("y") + 1) * building.n_storeys
    if columns > MOST_COLUMNS:
        problems.at_key(
            ("plan",),
            f"plan and storeys have {columns} places of columns; at most {MOST_COLUMNS} are read [E-VALUE-02]",
        )
        return
    check_own_sections(building.sections, problems, profiles)
    for name, section in building.sections.items():
        if isinstance(section, RectangleSection) and (gap := section.gap) is not None:
            low, high = (1e3 * edge for edge in gap)
            message = (
                f"nothing connects the rectangles between {low:g} and {high:g} mm along the depth, so that the shear "
                "between them is not known; close the gap, or give `area`, `inertia` and the like [E-FRAME-01]"
            )
            problems.at_key(("sections", name, "rectangles"), message)
    for keys, run in _runs(building):
        _section_of(building, problems, keys, run, profiles)
        if run.material not in building.materials:
            problems.at_value((*keys, "material"), unknown_name("material", run.material, building.materials))
    _groups(building, problems)
    _slabs(building, problems)
    check = Selections(building, problems)
    if not _selections(building, problems, check):
        return
    if _floors(building, problems) and _covered(building, check):
        _stand(building, problems)
        _braces(building, problems)
        _resisting(building, problems)


def _selections(building: Building, problems: Problems, check: Selections) -> bool:
    """Everything that is named is on the grid."""
    before = len(problems.found)
    check.numbers(("diaphragms",), building.diaphragms, "floor", building.n_storeys)
    for i, part in enumerate(building.partial_diaphragms):
        check.numbers(("partial_diaphragms", i, "floors"), part.floors, "floor", building.n_storeys)
        check.bays(("partial_diaphragms", i, "bays"), part.bays)
    for i, setback in enumerate(building.setbacks):
        check.floors(("setbacks", i), setback.floors)
        check.bays(("setbacks", i, "bays"), setback.bays)
    _axes(building, problems)
    _supports(building, problems, check)
    _restrained(building, problems, check)
    for i, column in enumerate(building.columns):
        check.column_places(("columns", i), column)
    for i, beam in enumerate(building.beams):
        check.beam_places(("beams", i), beam)
    for i, brace in enumerate(building.braces):
        keys: Keys = ("braces", i)
        check.frames((*keys, "frames"), brace.frames, brace.along)
        check.numbers((*keys, "bays"), brace.bays, "bay", building.n_bays(brace.along), f" along {brace.along}")
        check.storeys(keys, brace.storeys)
        if brace.kind in CHEVRONS and brace.compression is False:
            message = (
                f"both braces of a {brace.kind} count, in tension and compression (EN 1998-1, 6.7.2(2)P) [E-BLDG-01]"
            )
            problems.at_value((*keys, "compression"), message)
        _link(keys, brace, problems)
        _restrained_brace(building, problems, keys, brace)
    for i, gap in enumerate(building.missing.columns):
        check.column_places(("missing", "columns", i), gap)
    for i, hole in enumerate(building.missing.beams):
        check.beam_places(("missing", "beams", i), hole)
    return len(problems.found) == before


def _link(keys: Keys, brace: BraceRun, problems: Problems) -> None:
    """Braces beside a seismic link leave it free, and count in compression."""
    if brace.link is None:
        return
    if brace.kind == "cross":
        message = (
            "a cross ends at the corners of its bay, beside no link; braces with a `link` are `chevron`, `v`, "
            "`rising`, `falling` or `alternating` [E-BLDG-01]"
        )
        problems.at_value((*keys, "kind"), message)
    if brace.compression is False:
        message = "braces beside a seismic link count in tension and compression (EN 1998-1, 6.8.3(1)) [E-BLDG-01]"
        problems.at_value((*keys, "compression"), message)


def _restrained_brace(building: Building, problems: Problems, keys: Keys, brace: BraceRun) -> None:
    """A buckling-restrained brace has the law of its manufacturer, counts both ways, and crosses no other one."""
    restrained = brace.section not in building.sections and re.fullmatch(r"(?i)BRB ?[0-9.]+", brace.section)
    laws = building.dampers.laws if building.dampers is not None else {}
    if not restrained:
        if brace.law is not None:
            message = f"`{brace.section}` is no buckling-restrained brace, as `BRB25` is, and has no law [E-DEVICE-04]"
            problems.at_key((*keys, "law"), message)
        return
    if brace.law is None:
        message = "this key is missing: one of `dampers.laws`, with omega, beta and KF of the manufacturer [E-KEY-02]"
        problems.under(keys, "law", message)
    elif brace.law not in laws:
        problems.at_value((*keys, "law"), unknown_name("damper law", brace.law, laws))
    if brace.kind == "cross":
        message = "buckling-restrained braces cannot cross; take chevrons, or diagonals in two bays [E-DEVICE-04]"
        problems.at_value((*keys, "kind"), message)
    if brace.compression is False:
        message = "buckling-restrained braces count in compression too; leave this key out [E-KEY-03]"
        problems.at_value((*keys, "compression"), message)


def _axes(building: Building, problems: Problems) -> None:
    """Every grid line has one name, and no two of a direction the same."""
    directions: tuple[Direction, Direction] = ("x", "y")
    for along in directions:
        if (own := getattr(building.plan.axes, along)) is not None:
            check_axes(("plan", "axes", along), own, building.n_bays(along) + 1, problems)


def _supports(building: Building, problems: Problems, check: Selections) -> None:
    if not isinstance(building.supports, dict):
        return
    for name in building.supports:
        if name == "default":
            continue
        try:
            chosen = parse_column_lines(name)
        except PydanticCustomError as error:
            problems.at_key(("supports", name), f"this is not `default`, and {error}")
            continue
        for message in check.lines_outside(chosen).values():
            problems.at_key(("supports", name), message)


def _restrained(building: Building, problems: Problems, check: Selections) -> None:
    """Floors that the ground holds exist, and are held by something that determines how they move."""
    named: set[int] = set()
    for i, held in enumerate(building.restrained_floors):
        keys: Keys = ("restrained_floors", i)
        if not check.numbers((*keys, "floors"), held.floors, "floor", building.n_storeys):
            continue
        floors = held.floors.numbers(1, building.n_storeys)
        for floor in sorted(named & set(floors)):
            problems.at_value((*keys, "floors"), f"floor {floor} is held by an entry before this one [E-NAME-02]")
        named |= set(floors)
        if {held.ux, held.uy, held.rz} == {"free"}:
            problems.at_value(keys, "all directions are `free`; leave this entry out [E-KEY-03]")
        if "fixed" in (held.ux, held.uy) and held.rz != "fixed" and set(floors) & set(building.rigid_floors):
            message = (
                "a rigid floor that is fixed along x or y at all its column lines does not turn; give `rz: fixed`, "
                "or stiffnesses along x and y [E-VALUE-04]"
            )
            problems.at_key((*keys, "rz"), message)
    if building.design is None:
        return
    loose = [i for i, held in enumerate(building.restrained_floors) if {held.ux, held.uy, held.rz} != {"fixed"}]
    for i in loose:
        message = "designs take the floors of a rigid basement, which are `fixed` in plan; or leave `design` out"
        problems.at_value(("restrained_floors", i), f"{message} [E-BLDG-04]")
    if not loose and named and (named != set(range(1, max(named) + 1)) or max(named) == building.n_storeys):
        message = "designs take the lowest floors, from 1 on and not all of them, as a rigid basement"
        problems.at_key(("restrained_floors",), f"{message}; or leave `design` out [E-BLDG-04]")


def _floors(building: Building, problems: Problems) -> bool:
    """Every floor covers a bay; returns whether it is so."""
    layout = building.layout
    bare = [floor for floor, panels in layout.floors.items() if not panels]
    for floor in bare:
        problems.at_key(("setbacks",), f"floor {floor} covers no bay [E-NAME-01]")
    in_part = _partial(building, problems)
    for floor in building.rigid_floors:
        if floor not in in_part and (shared := _shared(building.rigid_parts(floor), building.axes)):
            parts = f"floor {floor} is in parts that touch at {listed(shared)} alone, which two diaphragms cannot share"
            message = f"{parts}; leave it out of `diaphragms` [E-VALUE-04]"
            problems.at_key(("diaphragms",) if problems.root.child("diaphragms") else ("setbacks",), message)
    return not bare


def _partial(building: Building, problems: Problems) -> set[int]:
    """Rigid parts of a floor are covered by it and have no node in common; returns the floors that have some."""
    found: dict[int, frozenset[Panel]] = {}
    for i, part in enumerate(building.partial_diaphragms):
        keys: Keys = ("partial_diaphragms", i)
        panels = panels_in(part.bays, building.n_bays("x"), building.n_bays("y"))
        for floor in part.floors.numbers(1, building.n_storeys):
            before = found.get(floor, frozenset())
            if floor not in building.rigid_floors:
                problems.at_value((*keys, "floors"), f"floor {floor} is not among `diaphragms` [E-NAME-01]")
            elif panels - building.layout.floors[floor]:
                problems.at_key((*keys, "bays"), f"floor {floor} does not cover all of these bays [E-NAME-01]")
            elif len(parts_of(panels)) > 1:
                message = "the bays are in parts that do not touch; give each of them an entry of its own [E-VALUE-04]"
                problems.at_key((*keys, "bays"), message)
            elif shared := _shared((before, panels), building.axes):
                message = f"floor {floor} has a rigid part by an entry before this one, which ties {listed(shared)} too"
                problems.at_value((*keys, "floors"), f"{message} [E-NAME-02]")
            found[floor] = before | panels
    return set(found)


def _shared(parts: tuple[frozenset[Panel], ...], axes: GridAxes) -> list[str]:
    """The column lines at corners of more than one part of a floor."""
    at = [{line for panel in panels for line in corners(panel, axes)} for panels in parts]
    lines = Counter(str(line) for of_part in at for line in of_part)
    return sorted(line for line, count in lines.items() if count > 1)


def _covered(building: Building, check: Selections) -> bool:
    """Every place of the grid has a run or is listed as missing; returns whether it is so."""
    layout = building.layout
    columns = {place for run in (*building.columns, *building.missing.columns) for place in layout.column_places(run)}
    beams = {place for run in (*building.beams, *building.missing.beams) for place in layout.beam_places(run)}
    bare = (column_name(*place) for place in layout.column_grid if place not in columns)
    open_bays = (str(place) for place in layout.beam_grid if place not in beams)
    covered = check.without_section(("columns",), "column", bare)
    return check.without_section(("beams",), "beam", open_bays) and covered


def _stand(building: Building, problems: Problems) -> None:
    """Every storey has columns; every column and every end of a beam rests on something."""
    layout = building.layout
    for storey in range(1, building.n_storeys + 1):
        if all(at != storey for _, at in layout.column_at):
            problems.at_key(
                ("missing", "columns"), f"storey {storey} has no column: nothing carries floor {storey} [E-BLDG-02]"
            )
    beam_ends = {(line, place.floor) for place in layout.beam_at for line in place.lines}
    loose = [
        column_name(line, storey)
        for line, storey in layout.column_at
        if storey > 1 and (line, storey - 1) not in layout.column_at and (line, storey - 1) not in beam_ends
    ]
    if loose:
        message = f"nothing is below {listed(loose)}: no column and no beam [E-BLDG-02]"
        problems.at_key(("missing",) if building.missing.columns else ("setbacks",), message)


def _braces(building: Building, problems: Problems) -> None:
    """Braces end at nodes that columns or beams have, and the bay of a brace has its beam."""
    layout = building.layout
    present = {(line, floor) for line, storey in layout.column_at for floor in (storey - 1, storey)}
    present |= {(line, place.floor) for place in layout.beam_at for line in place.lines}
    numbers = {id(run): i for i, run in enumerate(building.braces)}
    reported: set[tuple[int, str]] = set()
    met = Counter(
        met_beam(place, run) for place, run in layout.brace_at.items() if run.kind in CHEVRONS or run.link is not None
    )
    for place, run in layout.brace_at.items():
        i = numbers[id(run)]
        beam = met_beam(place, run) if run.kind in CHEVRONS else BeamPlace(*place)
        if run.link is not None:
            width = building.widths(place.along)[place.bay - 1]
            if run.link >= width:
                message = f"the link of {run.link:g} m leaves nothing of the beam of {width:g} m beside it"
                reported.add((i, f"{place}: {message} [E-VALUE-02]"))
            if met[beam] > 1 or beam in layout.halved_beams:
                message = f"other braces, or dampers in their place, meet the beam {beam} between its ends as well"
                reported.add((i, f"{place}: {message}; a beam with a `link` has its own braces alone [E-BLDG-01]"))
        if beam not in layout.beam_at:
            where = "at the base, where there is none" if beam.floor == 0 else "which is missing"
            reported.add((i, f"{place} needs the beam {beam}, {where} [E-BLDG-02]"))
            continue
        points = {point for pair in ways(place, run).values() for point in pair}
        for line, floor in sorted((line, floor) for line, floor in points if line is not None):
            if (line, floor) not in present:
                reported.add((i, f"{place} ends at {node_name(line, floor)}, where no column or beam is [E-BLDG-02]"))
    for i, message in sorted(reported):
        problems.at_value(("braces", i), message)


def _resisting(building: Building, problems: Problems) -> None:
    """In each storey and direction something resists horizontal forces.

    That is a brace, or what restrains rotations of column ends: beams with a moment at an end at the floor above or
    below, or the column bases of the first storey.
    """
    layout = building.layout
    for along in DIRECTIONS:
        turning = "rx" if along == "y" else "ry"
        resisting = {place.storey for place in layout.brace_at if place.along == along}
        if any(getattr(building.support(line), turning, "footing") != "free" for line in layout.node_lines[0]):
            resisting.add(1)
        for beam, run in layout.beam_at.items():
            if beam.along == along and (run.ends.start != "pinned" or run.ends.end != "pinned"):
                resisting |= {beam.floor, beam.floor + 1}
        loose = [storey for storey in range(1, building.n_storeys + 1) if storey not in resisting]
        if loose:
            first = next((i for i, run in enumerate(building.beams) if run.along == along), 0)
            storeys = f"storey {loose[0]}" if len(loose) == 1 else f"storeys {', '.join(map(str, loose))}"
            names = [frame_name(along, i, building.axes) for i in range(building.n_frames(along))]
            message = (
                f"nothing resists along {along} in {storeys}: all beams above and below are pinned and no bay of "
                f"{names[0]} to {names[-1]} is braced [E-BLDG-02]"
            )
            problems.at_value(("beams", first, "ends"), message)


def _groups(building: Building, problems: Problems) -> None:
    """Members of one group are of one kind, section and material."""
    first: dict[str | None, tuple[Keys, Run]] = {}
    for keys, run in _runs(building):
        other_keys, other = first.setdefault(run.group, (keys, run))
        if getattr(other, "law", None) != getattr(run, "law", None):
            message = f"the braces of group `{run.group}` have one law, as they are designed as one [E-BLDG-03]"
            problems.at_value((*keys, "group"), message)
        elif (other_keys[0], other.section, other.material) != (keys[0], run.section, run.material):
            message = (
                f"the group `{run.group}` has {run.section} of {run.material} here, and {other.section} of "
                f"{other.material} in {other_keys[0]}[{other_keys[1]}]; a group is of one kind, section and material"
                " [E-BLDG-03]"
            )
            problems.at_value((*keys, "group"), message)


def _section_of(building: Building, problems: Problems, keys: Keys, run: Run, profiles: Catalogue | None) -> None:
    own = building.sections.get(run.section)
    if own is None and profiles is not None and profiles.canonical(run.section) is None:
        if profiles.canonical_in_building(run.section, isinstance(run, BraceRun)) is None:
            problems.at_value((*keys, "section"), no_section(run.section, building.sections, profiles))
    if isinstance(own, SpaceElasticSection) and own.missing and not isinstance(run, BraceRun):
        message = f"the section `{run.section}` has no {listed(own.missing)}; only a brace can do without [E-FRAME-02]"
        problems.at_value((*keys, "section"), message)


def _slabs(building: Building, problems: Problems) -> None:
    """A slab makes the stiffness factor of a beam, and stands at rigid floors on beams that have a height."""
    for i, run in enumerate(building.beams):
        if run.slab is None:
            continue
        keys: Keys = ("beams", i)
        if "stiffness_factor" in run.model_fields_set:
            problems.at_key((*keys, "stiffness_factor"), "the factor follows from `slab`; give one of both [E-KEY-03]")
        if isinstance(building.sections.get(run.section), SpaceElasticSection):
            message = f"`{run.section}` has no height, which the slab lies above; give a profile or plates [E-FRAME-02]"
            problems.at_value((*keys, "section"), message)


def _runs(building: Building) -> Iterable[tuple[Keys, Run]]:
    for kind in ("columns", "beams", "braces"):
        for i, run in enumerate(getattr(building, kind)):
            yield (kind, i), run
