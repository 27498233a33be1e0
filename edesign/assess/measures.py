"""Response measures of one analysis: the numbers that tables, JSON and performance checks compare."""

from __future__ import annotations

from collections.abc import Callable, Collection
from dataclasses import dataclass, replace
from typing import Literal

import numpy as np

from edesign.archive.dataset import Group
from edesign.assess.envelopes import final, peak, residual
from edesign.assess.spread import EVERYWHERE, Spread, in_frames, line_and_number, resultant, spread, stored_dims
from edesign.project.criteria.measures import ELSEWHERE, MEASURES, InSpace
from edesign.project.notation.names import storey_of

Where = Literal["roof", "first storey", "anywhere"]


@dataclass(frozen=True)
class Located:
    """A measure with the place where it occurs.

    Attributes:
        value: in SI.
        storey: number of the storey, or of the floor above it; None where there is none.
        member: name of the column, beam, brace, damper or support, "" where there is none.
        floor: number of the floor, of quantities of floors.
        remark: what else is to be said of it.
        direction: "x" or "y" in a building, "" where there is none.
        line: column line of a building, "" where there is none.
        axis: local axis of a member of a building, about which it bends, "" where there is none.
        not_judged: plastic rotation about a weak axis, rad, that no limit is known of, and its member.
    """

    value: float
    storey: int | None = None
    member: str = ""
    floor: int | None = None
    remark: str = ""
    direction: str = ""
    line: str = ""
    axis: str = ""
    not_judged: tuple[float, str] = (0.0, "")


def place_in_words(
    storey: int | None, member: str, floor: int | None = None, line: str = "", direction: str = "", axis: str = ""
) -> str:
    """Return where something occurs: `floor 2`, `storey 3, line A4, y`, `C_A1_3, about y`; "" where it is everywhere.

    Args:
        storey: what is said of a member or floor is not said of its storey too.
    """
    where = member or (f"floor {floor}" if floor is not None else f"storey {storey}" if storey is not None else "")
    parts = (where, f"line {line}" if line else "", direction, f"about {axis}" if axis else "")
    return ", ".join(filter(None, parts))


@dataclass(frozen=True)
class Source:
    """Where a measure is taken from: the extremes or the residual of a quantity, and at which of its components."""

    quantity: str
    of: Callable[[Group, str], np.ndarray | None] = peak
    at: Where = "anywhere"


SOURCES = {
    "roof_displacement_m": Source("floor_displacement", at="roof"),
    "residual_roof_displacement_m": Source("roof_displacement", residual),
    "final_roof_displacement_m": Source("floor_displacement", final, "roof"),
    "roof_drift": Source("floor_displacement", at="roof"),
    "interstorey_drift": Source("storey_drift"),
    "residual_interstorey_drift": Source("storey_drift", residual),
    "final_interstorey_drift": Source("storey_drift", final),
    "base_shear_N": Source("base_shear"),
    "column_base_shear_N": Source("storey_shear", at="first storey"),
    "roof_acceleration_m_s2": Source("floor_acceleration", at="roof"),
    "relative_roof_acceleration_m_s2": Source("floor_relative_acceleration", at="roof"),
    "beam_plastic_rotation_rad": Source("beam_plastic_rotation"),
    "column_plastic_rotation_rad": Source("column_plastic_rotation"),
    "column_axial_force_N": Source("column_axial_force"),
    "brace_ductility": Source("brace_ductility"),
    "brace_damage": Source("brace_damage"),
    "damper_strain": Source("damper_strain"),
    "damper_deformation_m": Source("damper_deformation"),
    "damper_force_N": Source("damper_force"),
}


def response_measures(group: Group) -> dict[str, float | None]:
    """Compute the response measures of an analysis from its envelopes.

    All are absolute values, the largest over time and over floors, storeys, members and member ends. Displacements are
    relative to the ground, the acceleration is total where its name does not say otherwise. Residual values are means
    over the last fundamental period of a history, so that what is left of the free vibration does not count; final
    values are those of the last moment. Rotations are plastic rotations of member ends; the axial force is of columns,
    gravity included. The ductility of braces that buckle is their elongation, positive or negative, over that of first
    yield, their damage that of low-cycle fatigue. The strain of dampers is the shear of their layers. The base shear is
    that of the reactions, with what dampers bring into the supports; the one of columns is the shear of the columns and
    braces of storey 1.

    Args:
        group: results of one analysis, as archived.

    Returns:
        One value in SI for each name of MEASURES; None where it does not apply: everything of a modal analysis, the
        acceleration of a static one, residual and final values of anything but a completed history.
    """
    found: dict[str, float | None] = {}
    for measure in MEASURES:
        _, each = _components(group, measure)
        found[measure] = None if each is None else max(each.values[at].item() for at in _eligible(measure, each))
    return found


def located_measure(
    group: Group,
    measure: str,
    storeys: Collection[int] | None = None,
    members: Collection[str] | None = None,
    chosen: InSpace = EVERYWHERE,
) -> Located | None:
    """Compute one response measure, over all of the frame or a part of it, and say where it occurs.

    Args:
        group: results of one analysis, as archived.
        measure: a name of MEASURES.
        storeys: only drifts of these storeys, only columns and dampers in them and beams at their floors; None: all.
        members: only these columns, beams or dampers; None: all.

    Returns:
        The measure; None where it does not apply (see `response_measures`) or nothing is selected. A measure of the
        whole frame, such as a base shear, knows no selection.
    """
    dimension, each = _components(group, measure, chosen)
    if each is None:
        return None
    at: Collection[int] = _eligible(measure, each)
    place = MEASURES[measure].place
    if place is not None:
        at = [i for i in at if _is_chosen(group, dimension, i, storeys, members, chosen)]
    if not at:
        return None
    worst = max(at, key=each.values.__getitem__)
    value = each.values[worst].item()
    if value == -np.inf:  # no line of the frames in this direction
        return None
    found = Located(value, direction=each.direction[worst], axis=each.axis[worst])
    if place is None:
        return found if SOURCES[measure].at == "anywhere" else replace(found, storey=worst + 1)
    label = _label(group, dimension, worst)
    if dimension == "drift_line":
        line, storey = line_and_number(label)
        return replace(found, storey=storey, line=line)
    return replace(
        found,
        storey=_storey(group, dimension, worst) or None,
        member="" if dimension == "storey" else label,
    )


def _components(group: Group, measure: str, chosen: InSpace = EVERYWHERE) -> tuple[str, Spread | None]:
    """Where the values of a measure are, and the largest at each floor, storey or member; None: there is none.

    Storeys of a building drift on each of their column lines.
    """
    source, name = SOURCES[measure], SOURCES[measure].quantity
    place = MEASURES[measure].place
    dimension: str = "buckling_brace" if place == "brace" else place or ""
    dims: tuple[str, ...] | None = None
    if chosen.direction == "resultant":
        values, dims = resultant(group, MEASURES[measure].resultant or "")
    elif name in ELSEWHERE and dimension == "storey":
        on_lines = source.of(group, ELSEWHERE[name])
        if on_lines is not None or chosen.at or chosen.frames:
            name, dimension = ELSEWHERE[name], "drift_line"
    if dims is None:
        values, dims = source.of(group, name), stored_dims(group, name)
    if values is None or values.size == 0:
        return dimension, None
    if measure == "roof_drift":
        height = group.attributes.get("height")
        if not height or group.attributes.get("isolated"):  # most of that displacement is the base's
            return dimension, None
        values = values / float(height)
    return dimension, spread(group, values, dims, chosen)


def _eligible(measure: str, each: Spread) -> range:
    """Which of all components a measure is the largest of; floors and storeys are stored from the bottom to the top."""
    places = range(len(each.values))
    where: dict[Where, range] = {"roof": places[-1:], "first storey": places[:1]}
    return where.get(SOURCES[measure].at, places)


def _is_chosen(
    group: Group,
    dimension: str,
    at: int,
    storeys: Collection[int] | None,
    members: Collection[str] | None,
    chosen: InSpace,
) -> bool:
    if storeys is not None and _storey(group, dimension, at) not in storeys:
        return False
    if dimension == "drift_line":
        return not chosen.at or line_and_number(_label(group, dimension, at))[0] in chosen.at
    if dimension == "storey":
        return True
    named = members is None or _label(group, dimension, at) in members
    return named and in_frames(group, dimension, at, chosen.frames)


def _storey(group: Group, dimension: str, at: int) -> int:
    """The storey of a component, 0: of none; a beam counts with the storey below its floor."""
    if dimension not in group.coords:
        return 0
    if dimension == "damper":
        stored = group.variables.get("damper_storey")
        return 0 if stored is None else int(stored.values[at])
    label = _label(group, dimension, at)
    return line_and_number(label)[1] if dimension == "drift_line" else storey_of(label)


def _label(group: Group, dimension: str, at: int) -> str:
    """The name of a component; "" where the group does not name them."""
    return str(group.coords[dimension].values[at]) if dimension in group.coords else ""


def lacking_measure(group: Group, measure: str) -> str:
    """Return why a measure does not apply to a completed analysis, "" where it does.

    Args:
        group: of the analysis in the archive.
        measure: a name of MEASURES.
    """
    if MEASURES[measure].place == "damper" and "damper" not in group.coords:
        return "there are no dampers"
    if measure == "damper_strain" and "damper_strain_max" not in group.variables:
        return "no damper has layers"
    return ""
