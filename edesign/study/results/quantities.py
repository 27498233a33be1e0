"""The quantities that analyses of frames record.

Horizontal displacements are relative to the ground and include those under gravity. Displacement and acceleration of a
floor are means over its nodes (with a diaphragm all are the same); so is the drift of a storey over the column lines
that have a column there. The extremes of a drift are those of the worst column line. Shears are positive for loads to
the right; they are forces of the members, damping forces are not in them.
"""

from __future__ import annotations

import numpy as np

from edesign.archive.dataset import Group
from edesign.building.frame import FrameModel, Member
from edesign.core import Response
from edesign.project.notation import names
from edesign.study.results.recording import Quantity, Terms, coordinate

END_COMPONENTS = (  # of the core's end forces: N V M at the start, N V M at the end
    ("axial_force", "N", 0, "force on the member's end along its axis, from start to end"),
    ("shear_force", "N", 1, "force on the member's end across its axis, to the left of it"),
    ("bending_moment", "N*m", 2, "moment on the member's end, anticlockwise"),
)


def coordinates(group: Group, frame: FrameModel) -> None:
    """Add floors, storeys, members and member ends to a group."""
    storeys = np.arange(1, frame.frame.n_storeys + 1)
    coordinate(group, "floor", storeys, "1", "floor, the highest is the roof")
    coordinate(group, "storey", storeys, "1", "storey below the floor of the same number")
    if frame.devices:
        coordinate(group, "damper", [device.name for device in frame.devices], "", "name of the damper")
        storeys_of = [device.storey for device in frame.devices]
        group.add("damper_storey", ("damper",), storeys_of, "1", "storey of the damper, 0: of none")
        for name, unit, label in (
            ("layer_thickness", "m", "thickness of a layer, nan: the damper has none"),
            ("tested_strain", "1", "largest shear strain in the tests of its law, nan: not known"),
            ("strain_limit", "1", "largest shear strain that its layers are meant for, nan: none is said"),
        ):
            values = [getattr(device, name) for device in frame.devices]
            if any(values):
                known = [np.nan if value is None else value for value in values]
                group.add(f"damper_{name}", ("damper",), known, unit, label)
        _restrained_coordinates(group, frame)
    if frame.isolated is not None:
        isolators = [isolator.name for isolator in frame.isolated.isolators]
        coordinate(group, "isolator", isolators, "", "name of the isolator")
        group.attributes["isolated"] = True
    for kind in ("column", "beam", "brace"):
        found = [member.name for member in frame.of_kind(kind)]
        if found:
            coordinate(group, kind, found, "", f"name of the {kind}")
    coordinate(group, "member", [member.name for member in bending_members(frame)], "", "name of the column or beam")
    coordinate(group, "end", ["start", "end"], "", "end of the member: the start is below or at the left")
    rigid = [member.rigid_ends for member in bending_members(frame)]
    if any(map(any, rigid)):
        label = "length of the rigid end; forces and rotations of the end are those where it begins to bend"
        group.add("rigid_end", ("member", "end"), rigid, "m", label)
    group.add("floor_level", ("floor",), frame.frame.y[1:], "m", "level of the floor above the base")
    group.add("storey_height", ("storey",), frame.frame.storey_heights, "m", "height of the storey")


RESTRAINED = (
    ("length", "length", "m", "length of the buckling-restrained brace between work points"),
    ("yield_force", "yield_force", "N", "yield force of its core, F_ysc A_sc"),
    ("yield_deformation", "yield_deformation", "m", "its yield deformation"),
    ("tested_core_strain", "tested_strain", "1", "strain of its core up to which omega and beta are known"),
    ("adjusted_tension", "adjusted_tension", "N", "its adjusted strength in tension, omega R_y F_ysc A_sc"),
    (
        "adjusted_compression",
        "adjusted_compression",
        "N",
        "its adjusted strength in compression, beta omega R_y F_ysc A_sc",
    ),
)
"""Variables of buckling-restrained braces, without `damper_`: name, attribute of `RestrainedBrace`, unit, meaning."""


def _restrained_coordinates(group: Group, frame: FrameModel) -> None:
    """Add what the manufacturer's values say of buckling-restrained braces; nan of other dampers."""
    braces = [device.restrained for device in frame.devices]
    if not any(braces):
        return
    for name, attribute, unit, label in RESTRAINED:
        values = [np.nan if brace is None else getattr(brace, attribute) for brace in braces]
        group.add(f"damper_{name}", ("damper",), values, unit, f"{label}; nan: the damper is another")


def bending_members(frame: FrameModel) -> list[Member]:
    """Columns, then beams."""
    return [*frame.of_kind("column"), *frame.of_kind("beam")]


def floor_displacements(frame: FrameModel, history: bool) -> Quantity:
    """Horizontal displacement of each floor."""
    cells = _floor_means(frame, "displacement")
    name = "horizontal displacement of the floor relative to the ground, mean over its nodes"
    return Quantity("floor_displacement", ("floor",), (len(cells),), cells, "m", name, history)


def base_displacement(frame: FrameModel, history: bool) -> list[Quantity]:
    """Horizontal displacement of an isolated base; nothing of a frame on its supports."""
    name = "horizontal displacement of the isolated base relative to the ground"
    terms = _of_base(frame, "displacement")
    return [Quantity("base_displacement", (), (), terms, "m", name, history, tail=True)] if terms else []


def base_acceleration(frame: FrameModel, history: bool) -> list[Quantity]:
    """Total horizontal acceleration of an isolated base; nothing of a frame on its supports."""
    name, keep = "total horizontal acceleration of the isolated base", ("max", "min")
    terms = _of_base(frame, "total_acceleration")
    return [Quantity("base_acceleration", (), (), terms, "m/s^2", name, history, keep)] if terms else []


def _of_base(frame: FrameModel, kind: str) -> tuple[Terms, ...]:
    """A horizontal quantity of the base that all feet share; none of a frame on its supports."""
    if frame.isolated is None:
        return ()
    return (((1.0, kind, frame.nodes[frame.isolated.isolators[0].foot], 0),),)


def isolator_axial_forces(frame: FrameModel, keep: tuple[str, ...] = ("max", "min", "final")) -> list[Quantity]:
    """Axial force of each isolator, positive in tension, as of columns; nothing of a frame on its supports."""
    if frame.isolated is None:
        return []
    feet = [isolator.foot for isolator in frame.isolated.isolators]
    cells = tuple(tuple((-c, kind, i, at) for c, kind, i, at in frame.reaction(foot, 1)) for foot in feet)
    name = "axial force of the isolator, positive in tension"
    return [Quantity("isolator_axial_force", ("isolator",), (len(feet),), cells, "N", name, keep=keep)]


def floor_accelerations(frame: FrameModel, history: bool) -> Quantity:
    """Total horizontal acceleration of each floor."""
    cells = _floor_means(frame, "total_acceleration")
    name = "total horizontal acceleration of the floor, mean over its nodes"
    return Quantity("floor_acceleration", ("floor",), (len(cells),), cells, "m/s^2", name, history, ("max", "min"))


def floor_relative_accelerations(frame: FrameModel) -> Quantity:
    """Horizontal acceleration of each floor relative to the ground, as some programs report it."""
    cells = _floor_means(frame, "acceleration")
    name = "horizontal acceleration of the floor relative to the ground, mean over its nodes"
    keep = ("max", "min")
    return Quantity("floor_relative_acceleration", ("floor",), (len(cells),), cells, "m/s^2", name, keep=keep)


def storey_drifts(frame: FrameModel, history: bool) -> Quantity:
    """Drift ratio of each storey; its extremes are stored by `store_drift_extremes`."""
    cells = tuple(_mean(lines) for lines in _line_drifts(frame))
    name = "drift ratio of the storey, mean over its column lines"
    return Quantity("storey_drift", ("storey",), (len(cells),), cells, "1", name, history, ("final",))


def line_drifts(frame: FrameModel) -> Quantity:
    """Drift ratio of each storey on every column line, one after the other; not stored as such."""
    cells = tuple(terms for lines in _line_drifts(frame) for terms in lines)
    return Quantity("line_drift", ("line_drift",), (len(cells),), cells, "1", "drift ratio on a column line", keep=())


def line_drift_storeys(frame: FrameModel) -> list[int]:
    """The storey, from 1, of each component of `line_drifts`."""
    return [storey for storey, lines in enumerate(_line_drifts(frame), start=1) for _ in lines]


def store_drift_extremes(group: Group, frame: FrameModel, drifts: Quantity, response: Response) -> None:
    """Add the extremes of the storey drifts over time and column lines; `drifts` is what `line_drifts` gave."""
    counts = [len(lines) for lines in _line_drifts(frame)]
    starts = np.concatenate(([0], np.cumsum(counts)[:-1]))
    largest = np.maximum.reduceat(drifts.extreme(response, "max"), starts)
    smallest = np.minimum.reduceat(drifts.extreme(response, "min"), starts)
    label = "drift ratio of the storey"
    group.add("storey_drift_max", ("storey",), largest, "1", f"{label}, largest value over time and column lines")
    group.add("storey_drift_min", ("storey",), smallest, "1", f"{label}, smallest value over time and column lines")


def storey_shears(frame: FrameModel, history: bool) -> Quantity:
    """Horizontal force in all columns and braces of each storey, second-order terms included."""
    cells: list[Terms] = [() for _ in range(frame.frame.n_storeys)]
    for line, storey in frame.frame.column_at:
        element = frame.members[names.column_name(line, storey)].at_end(1)
        cells[storey - 1] += ((1.0, "global_force", element, 3),)
    for bay, storey, way in frame.frame.brace_at:
        element = frame.members[names.brace_name(bay, storey, way)].element
        upper_end = 3 if way == "r" else 0
        cells[storey - 1] += ((1.0, "global_force", element, upper_end),)
    name = "horizontal force on the upper ends of the storey's columns and braces"
    return Quantity("storey_shear", ("storey",), (len(cells),), tuple(cells), "N", name, history)


def base_shear(frame: FrameModel, history: bool) -> Quantity:
    """The sum of the horizontal reactions, that of the leaning column too, with the sign of the loads they carry."""
    held = [name for name, fixed in frame.supports.items() if fixed[0]]
    terms = tuple((-factor, kind, node, at) for name in held for factor, kind, node, at in frame.reaction(name, 0))
    if frame.leaning is not None:
        terms += ((-1.0, "reaction", frame.leaning.base, 0),)
    name = "base shear: minus the sum of the horizontal reactions"
    return Quantity("base_shear", (), (), (terms,), "N", name, history)


def support_reactions(frame: FrameModel, group: Group) -> list[Quantity]:
    """Reactions of each support, gravity included, and their moment; adds the names of the supports to the group.

    A vertical reaction is positive upwards, so that a negative one is uplift. The overturning moment is that of all
    reactions about the point of the base midway between the outer supports, positive for loads to the right. The foot
    of a leaning column is no support of the frame: where it stands is not known.
    """
    supports = frame.supports
    coordinate(group, "support", list(supports), "", "node that is supported")
    parts = (
        ("support_horizontal_reaction", 0, "N", "horizontal reaction on the frame, positive to the right"),
        ("support_vertical_reaction", 1, "N", "vertical reaction on the frame, positive upwards; negative: uplift"),
        ("support_moment", 2, "N*m", "moment of the support on the frame, anticlockwise"),
    )
    found = [
        Quantity(
            name,
            ("support",),
            (len(supports),),
            tuple(frame.reaction(node, at) if fixed[at] else () for node, fixed in supports.items()),
            unit,
            label,
            history=True,
        )
        for name, at, unit, label in parts
    ]
    places = {node: frame.frame.nodes[node] for node in supports}
    middle = 0.5 * (min(x for x, _ in places.values()) + max(x for x, _ in places.values()))
    terms: Terms = ()
    for node, fixed in supports.items():
        x, y = places[node]
        arms = (-y, x - middle, 1.0)
        terms += tuple(
            (arm * factor, kind, number, component)
            for at, arm in enumerate(arms)
            if fixed[at] and arm != 0.0
            for factor, kind, number, component in frame.reaction(node, at)
        )
    label = "moment of all reactions about the middle of the base, anticlockwise, that resists loads to the right"
    found.append(Quantity("overturning_moment", (), (), (terms,), "N*m", label, history=True))
    return found


def member_forces(frame: FrameModel, members: list[Member], dim: str, history: bool) -> list[Quantity]:
    """Forces on both ends of members, in the axes of the member.

    Args:
        frame: the model.
        members: columns, beams or braces.
        dim: the dimension whose coordinate lists them.
        history: whether histories are kept, instead of extremes.
    """
    return [
        Quantity(
            f"member_{name}",
            (dim, "end"),
            (len(members), 2),
            tuple(((1.0, "end_force", m.at_end(end), at + 3 * end),) for m in members for end in (0, 1)),
            unit,
            label,
            history,
            () if history else ("max", "min"),
        )
        for name, unit, at, label in END_COMPONENTS
    ]


def axial_forces(frame: FrameModel) -> list[Quantity]:
    """Axial forces of columns and of braces, positive in tension."""
    found = []
    for kind in ("column", "brace"):
        members = frame.of_kind(kind)
        cells = tuple(((1.0, "axial_force", member.element, 0),) for member in members)
        if members:
            name = f"axial force of the {kind}, positive in tension"
            found.append(Quantity(f"{kind}_axial_force", (kind,), (len(cells),), cells, "N", name))
    return found


def leaning_column(frame: FrameModel) -> list[Quantity]:
    """Axial force of the struts of the leaning column, and how it pulls at the floors; none without one."""
    if frame.leaning is None:
        return []
    elements = frame.leaning.elements
    parts = (
        ("axial_force", "axial_force", 0, "axial force of the leaning column in the storey, positive in tension"),
        (
            "shear",
            "global_force",
            3,
            "horizontal force on the upper end of the leaning column in the storey: minus what the frame's columns and "
            "braces take for it",
        ),
    )
    return [
        Quantity(
            f"leaning_column_{name}",
            ("storey",),
            (len(elements),),
            tuple(((1.0, kind, element, at),) for element in elements),
            "N",
            label,
        )
        for name, kind, at, label in parts
    ]


def plastic_rotations(frame: FrameModel) -> list[Quantity]:
    """Plastic rotations of the ends of columns and beams; members that stay elastic have none."""
    found = []
    for kind in ("column", "beam"):
        members = frame.of_kind(kind)
        cells = tuple(plastic_rotation(member, end) for member in members for end in (0, 1))
        if members:
            name = f"plastic rotation of the end of the {kind}: chord rotation less its elastic part"
            shape = (len(members), 2)
            found.append(Quantity(f"{kind}_plastic_rotation", (kind, "end"), shape, cells, "rad", name))
    return found


def plastic_rotation(member: Member, end: int) -> Terms:
    """Plastic rotation of the start (0) or end (1) of a member: of its fibres, hinges and joints."""
    fibres: Terms = ((1.0, "plastic_rotation", member.element, end),) if member.layers is not None else ()
    return fibres + tuple((1.0, "plastic_rotation", s.element, 0) for s in member.springs[end] if s.yields)


def dampers(frame: FrameModel, history: bool) -> list[Quantity]:
    """Force, deformation and work of the dampers; with layers also their shear strain."""
    numbers = [device.number for device in frame.devices]
    if not numbers:
        return []
    shape = (len(numbers),)
    forces = tuple(((1.0, "damper_force", n, 0),) for n in numbers)
    own = tuple(((1.0, "damper_deformation", n, 1),) for n in numbers)
    label = "force of the damper, positive with its deformation"
    found = [Quantity("damper_force", ("damper",), shape, forces, "N", label, history)]
    label = "deformation of the damper without its brace"
    found.append(Quantity("damper_deformation", ("damper",), shape, own, "m", label, history))
    thicknesses = [device.layer_thickness for device in frame.devices]
    if any(thicknesses):
        cells = tuple(
            ((1.0 / thickness, "damper_deformation", n, 1),) if thickness else ()
            for n, thickness in zip(numbers, thicknesses, strict=True)
        )
        label = "shear strain of the damper's layers"
        found.append(Quantity("damper_strain", ("damper",), shape, cells, "1", label, keep=("max", "min")))
    found += _restrained_braces(frame)
    work = tuple(((1.0, "damper_work", n, 0),) for n in numbers)
    label = "work done on the damper and its brace"
    found.append(Quantity("damper_work", ("damper",), shape, work, "J", label, keep=("final",)))
    storeys: list[Terms] = [() for _ in range(frame.frame.n_storeys)]
    for device in frame.devices:
        if device.storey:
            top = {frame.nodes[name] for name in frame.level_nodes(device.storey)}
            across = sum(c for c, node, degree in device.terms if node in top and degree == 0)
            storeys[device.storey - 1] += ((across, "damper_force", device.number, 0),)
    label = "horizontal force of the storey's dampers, positive as the storey's shear"
    found.append(Quantity("storey_damper_force", ("storey",), (len(storeys),), tuple(storeys), "N", label, history))
    return found


def _restrained_braces(frame: FrameModel) -> list[Quantity]:
    """Strain of the core and ductilities of the dampers that are buckling-restrained braces; of others 0."""
    if not any(device.restrained for device in frame.devices):
        return []
    strains: list[Terms] = []
    ductilities: list[Terms] = []
    cumulated: list[Terms] = []
    for device in frame.devices:
        brace, n = device.restrained, device.number
        if brace is None:
            for cells in (strains, ductilities, cumulated):
                cells.append(())
            continue
        by_force, by_deformation = brace.strain_of_core
        strains.append(((by_force, "damper_force", n, 0), (by_deformation, "damper_deformation", n, 1)))
        ductilities.append(((1.0 / brace.yield_deformation, "damper_deformation", n, 1),))
        cumulated.append(((1.0 / brace.yield_deformation, "damper_deformation", n, 2),))
    shape = (len(strains),)
    label = "strain of the steel core of a buckling-restrained brace, in its yielding length"
    found = [Quantity("core_strain", ("damper",), shape, tuple(strains), "1", label, keep=("max", "min"))]
    label = "deformation of a buckling-restrained brace / its yield deformation"
    found.append(Quantity("core_ductility", ("damper",), shape, tuple(ductilities), "1", label, keep=("max", "min")))
    label = "sum of the plastic deformations of a buckling-restrained brace either way / its yield deformation"
    found.append(Quantity("cumulative_ductility", ("damper",), shape, tuple(cumulated), "1", label, keep=("final",)))
    return found


def _floor_means(frame: FrameModel, kind: str) -> tuple[Terms, ...]:
    """For each floor the mean over its nodes of a horizontal quantity."""
    floors = [frame.floor_nodes(floor) for floor in range(1, frame.frame.n_storeys + 1)]
    return tuple(tuple((1.0 / len(there), kind, frame.nodes[name], 0) for name in there) for there in floors)


def _mean(several: list[Terms]) -> Terms:
    """The mean of several weighted sums as one."""
    share = 1.0 / len(several)
    return tuple((share * factor, kind, item, at) for terms in several for factor, kind, item, at in terms)


def _line_drifts(frame: FrameModel) -> list[list[Terms]]:
    """For each storey the drift ratio on each line that has a column there, from the left.

    Without any column it is taken on the lines with nodes above and below, and else between the leading nodes.
    """
    grid = frame.frame
    found = []
    for storey, height in enumerate(grid.storey_heights, start=1):
        pairs = [(names.node_name(line, storey), names.node_name(line, storey - 1)) for line in grid.lines]
        columns = [(line, storey) in grid.column_at for line in grid.lines]
        chosen = [pair for pair, column in zip(pairs, columns, strict=True) if column]
        if not chosen:
            chosen = [pair for pair in pairs if pair[0] in frame.nodes and pair[1] in frame.nodes]
        if not chosen:
            below = frame.floor_nodes(storey - 1)
            chosen = [(frame.leading_nodes[storey - 1], below[0] if below else "")]
        found.append([_drift(frame, upper, lower, height) for upper, lower in chosen])
    return found


def _drift(frame: FrameModel, upper: str, lower: str, height: float) -> Terms:
    terms: Terms = ((1.0 / height, "displacement", frame.nodes[upper], 0),)
    if lower in frame.nodes:
        terms += ((-1.0 / height, "displacement", frame.nodes[lower], 0),)
    return terms
