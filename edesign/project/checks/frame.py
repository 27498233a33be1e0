"""Cross checks of the frame: selections inside the grid, every place covered, names that exist."""

from __future__ import annotations

from collections.abc import Iterable

from edesign.project.checks.axes import check_axes
from edesign.project.checks.sections import check_own_sections
from edesign.project.checks.selections import Selections
from edesign.project.dampers.isolation import BaseBeams
from edesign.project.frame.frame import Frame
from edesign.project.frame.materials import ElasticMaterial
from edesign.project.frame.members import BeamRun, BraceRun, ColumnRun
from edesign.project.frame.sections import Catalogue, ElasticSection, PlateSection, no_section
from edesign.project.notation import names
from edesign.project.notation.frames import frames_of_line
from edesign.project.project import Project
from edesign.project.reading.problems import Keys, Problems, did_you_mean, listed, unknown_name

Run = ColumnRun | BeamRun | BraceRun | BaseBeams


def check_frame(project: Project, problems: Problems, profiles: Catalogue | None) -> None:
    """Check the frame and its sections and materials.

    Args:
        project: read without schema problems.
        profiles: names of the catalogue; None leaves section names that the project does not define unchecked.
    """
    frame = project.frame
    check = Selections(frame, problems)
    _axes(frame, problems)
    _supports(frame, problems)
    check.numbers(("frame", "diaphragms"), frame.diaphragms, "floor", frame.n_storeys)
    for i, column in enumerate(frame.columns):
        check.column_places(("frame", "columns", i), column)
    for i, beam in enumerate(frame.beams):
        check.beam_places(("frame", "beams", i), beam)
    for i, brace in enumerate(frame.braces):
        check.bays(("frame", "braces", i), brace.bays)
        check.storeys(("frame", "braces", i), brace.storeys)
        _buckling(project, problems, ("frame", "braces", i), brace)
    for i, gap in enumerate(frame.missing.columns):
        check.column_places(("frame", "missing", "columns", i), gap)
    for i, hole in enumerate(frame.missing.beams):
        check.beam_places(("frame", "missing", "beams", i), hole)
    if _covered(frame, check):
        _floors(frame, problems)
        _met_beams(frame, problems)
    _releases(frame, problems, check)
    _leaning_column(project, problems)
    check_own_sections(project.sections, problems, profiles)
    if project.design is not None:
        for i, beams in enumerate(project.design.dissipative.beams):
            check.standing_beams(("design", "dissipative", "beams", i), beams)
        for name in project.design.elastic_use:
            if name not in frame.members:
                problems.at_key(("design", "elastic_use", name), unknown_name("member", name, frame.members))
    for keys, run in _runs(frame):
        _section_of(project, problems, keys, run, profiles)
    for keys, run in _runs(frame):
        _material_of(project, problems, keys, run)
    isolation = project.isolation
    if isolation is not None and isolation.base.beams is not None:
        place: Keys = ("dampers", "isolation", "base", "beams")
        _section_of(project, problems, place, isolation.base.beams, profiles)
        _material_of(project, problems, place, isolation.base.beams)


def _axes(frame: Frame, problems: Problems) -> None:
    if frame.axes is not None:
        check_axes(("frame", "axes"), frame.axes, frame.n_lines, problems)
    for i, name in enumerate(frame.in_building):
        if name in frame.in_building[:i]:
            problems.at_item(("frame", "in_building"), i, f"`{name}` comes twice [E-NAME-02]")
        there = [number for number, line in enumerate(frame.lines) if name in frames_of_line(line)]
        if len(there) < 2 or there[-1] - there[0] != len(there) - 1:
            example = "A2, B2, ..." if name[0] == "X" else "A1, A2, ..."
            message = f"`axes` has not the column lines of frame {name} beside each other, such as {example}"
            problems.at_item(("frame", "in_building"), i, f"{message} [E-NAME-01]")


def _supports(frame: Frame, problems: Problems) -> None:
    if isinstance(frame.supports, dict):
        for line in frame.supports:
            if line != "default" and line not in frame.lines:
                allowed = ["default", *frame.lines]
                message = (
                    f"there is no line `{line}`{did_you_mean(line, allowed)} (allowed here: {listed(allowed)})"
                    " [E-NAME-01]"
                )
                problems.at_key(("frame", "supports", line), message)


def _buckling(project: Project, problems: Problems, keys: Keys, brace: BraceRun) -> None:
    """A brace that buckles is compressed, made of fibres, and has points enough; one that breaks yields."""
    if brace.buckling is None:
        return
    where = (*keys, "buckling")
    if not brace.compression:
        problems.at_value(
            (*keys, "compression"), "a brace with `buckling` counts in compression; leave one of them out [E-KEY-03]"
        )
    if isinstance(project.sections.get(brace.section), ElasticSection):
        message = (
            f"the section `{brace.section}` is elastic; a brace that buckles needs plates, `rectangles` or a profile"
            " [E-FRAME-02]"
        )
        problems.at_value((*keys, "section"), message)
    if project.elements.integration_points < 3:
        message = "a brace that buckles needs at least 3 `integration_points`, `elements` has "
        problems.at_key(where, f"{message}{project.elements.integration_points} [E-FRAME-02]")
    if brace.buckling.fracture is not None and isinstance(project.materials.get(brace.material), ElasticMaterial):
        message = (
            f"the material `{brace.material}` is elastic; only a steel that yields breaks by low-cycle fatigue"
            " [E-FRAME-02]"
        )
        problems.at_key((*where, "fracture"), message)


def _covered(frame: Frame, check: Selections) -> bool:
    """Every place of the grid has a run or is listed as missing; returns whether it is so."""
    runs = {p for run in (*frame.columns, *frame.missing.columns) for p in frame.column_places(run)}
    grid = [(line, s) for s in range(1, frame.n_storeys + 1) for line in frame.lines]
    columns = check.without_section(
        ("frame", "columns"), "column", (names.column_name(*p) for p in grid if p not in runs)
    )
    spans = {p for run in (*frame.beams, *frame.missing.beams) for p in frame.beam_places(run)}
    bays = [(b, f) for f in range(1, frame.n_storeys + 1) for b in range(1, frame.n_bays + 1)]
    beams = check.without_section(("frame", "beams"), "beam", (frame.beam_name(*p) for p in bays if p not in spans))
    return columns and beams


def _floors(frame: Frame, problems: Problems) -> None:
    """Every floor has a node."""
    for floor in range(1, frame.n_storeys + 1):
        if not any(names.node_name(line, floor) in frame.nodes for line in frame.lines):
            message = f"floor {floor} has no node: all columns and beams that end there are missing [E-FRAME-03]"
            problems.at_key(("frame", "missing"), message)


def _met_beams(frame: Frame, problems: Problems) -> None:
    """Every beam that braces meet in the middle is there."""
    for (bay, floor), run in frame.met_beams.items():
        if run is not None and (bay, floor) not in frame.beam_at:
            beam = f"{frame.beam_name(bay, floor)} is missing" if floor else f"bay {bay} has no beam at the base"
            message = f"a `{run.kind}` meets a beam in the middle, and {beam} [E-DAMPER-05]"
            problems.at_value(("frame", "braces", frame.braces.index(run), "kind"), message)


def _releases(frame: Frame, problems: Problems, check: Selections) -> None:
    for i, release in enumerate(frame.releases):
        keys: Keys = ("frame", "releases", i)
        if (release.beams is None) == (release.columns is None):
            problems.at_value(keys, "give either `beams` or `columns`, one of them [E-KEY-03]")
        if release.beams is not None:
            check.standing_beams((*keys, "beams"), release.beams)
        if release.columns is not None:
            check.standing_columns((*keys, "columns"), release.columns)


def _leaning_column(project: Project, problems: Problems) -> None:
    """It has a load, and columns whose geometry knows of its second-order forces."""
    column, floors = project.frame.leaning_column, project.frame.n_storeys
    if column is None:
        return
    keys: Keys = ("frame", "leaning_column")
    for key in ("G", "Q", "mass"):
        values = getattr(column, key)
        if isinstance(values, tuple) and len(values) != floors:
            message = (
                f"{len(values)} values, but the frame has {floors} floors; give one value, or one for each floor"
                " [E-VALUE-04]"
            )
            problems.at_value((*keys, key), message)
    loads = [value for values in (column.G, column.Q) for value in (values if isinstance(values, tuple) else (values,))]
    if not any(loads):
        problems.at_key(keys, "the leaning column has no load; give `G` or `Q`, a force at each floor [E-LOAD-02]")
    if project.elements.geometry.columns == "linear":
        message = (
            "the second-order forces of a leaning column need the geometry `p_delta` or `corotational` of "
            "`elements.geometry.columns`, and they are `linear` [E-FRAME-04]"
        )
        problems.at_key(keys, message)
    if column.mass is not None and project.masses is None:
        problems.at_key(
            (*keys, "mass"), "the frame itself has no `masses`, which analyses with masses need [E-MODAL-02]"
        )


def _section_of(project: Project, problems: Problems, keys: Keys, run: Run, profiles: Catalogue | None) -> None:
    own = project.sections.get(run.section)
    weak = not isinstance(run, BraceRun) and run.axis == "weak"
    if weak and own is not None and not isinstance(own, PlateSection):
        message = (
            f"the own section `{run.section}` has one axis; only I and hollow sections have a weak one [E-FRAME-02]"
        )
        problems.at_value((*keys, "axis"), message)
    if own is None and profiles is not None and profiles.canonical(run.section) is None:
        problems.at_value((*keys, "section"), no_section(run.section, project.sections, profiles))
    if isinstance(own, ElasticSection) and own.inertia is None and not isinstance(run, BraceRun):
        message = f"the section `{run.section}` has no `inertia`; only a brace can do without [E-FRAME-02]"
        problems.at_value((*keys, "section"), message)


def _material_of(project: Project, problems: Problems, keys: Keys, run: Run) -> None:
    if run.material not in project.materials:
        problems.at_value((*keys, "material"), unknown_name("material", run.material, project.materials))


def _runs(frame: Frame) -> Iterable[tuple[Keys, ColumnRun | BeamRun | BraceRun]]:
    for kind in ("columns", "beams", "braces"):
        for i, run in enumerate(getattr(frame, kind)):
            yield ("frame", kind, i), run
