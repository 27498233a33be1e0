"""Response measures of one analysis: the numbers that tables, JSON and performance checks compare."""

from __future__ import annotations

from collections.abc import Callable, Collection, Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np

from edesign.archive.dataset import Group
from edesign.assess.envelopes import final, peak, residual
from edesign.project.criteria.measures import MEASURES
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
    """

    value: float
    storey: int | None = None
    member: str = ""
    floor: int | None = None
    remark: str = ""


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
    found = {measure: _components(group, measure) for measure in MEASURES}
    return {
        measure: max(each[at] for at in _eligible(measure, each)) if each else None for measure, each in found.items()
    }


def located_measure(
    group: Group, measure: str, storeys: Collection[int] | None = None, members: Collection[str] | None = None
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
    each = _components(group, measure)
    at: Collection[int] = _eligible(measure, each)
    dimension = _dimension(measure)
    if dimension is not None:
        at = _selected(group, dimension, at, storeys, members)
    if not at:
        return None
    worst = max(at, key=each.__getitem__)
    if dimension is None:
        return Located(each[worst], None if SOURCES[measure].at == "anywhere" else worst + 1)
    name = "" if dimension == "storey" else _label(group, dimension, worst)
    return Located(each[worst], _storey(group, dimension, worst) or None, name)


def _dimension(measure: str) -> str | None:
    """What the archive calls the places that a measure may be chosen among; None: it is one of the whole frame."""
    place = MEASURES[measure].place
    return "buckling_brace" if place == "brace" else place


def _components(group: Group, measure: str) -> list[float]:
    """The values of all floors, storeys or members, of these the larger of both ends; [] where there are none."""
    source = SOURCES[measure]
    values = source.of(group, source.quantity)
    if values is None or values.size == 0:
        return []
    if measure == "roof_drift":
        height = group.attributes.get("height")
        if not height or group.attributes.get("isolated"):  # most of that displacement is the base's
            return []
        values = values / float(height)
    each: list[float] = values.reshape(len(values) if values.ndim else 1, -1).max(axis=1).tolist()
    return each


def _eligible(measure: str, each: Sequence[float]) -> range:
    """Which of all components a measure is the largest of; floors and storeys are stored from the bottom to the top."""
    places = range(len(each))
    chosen: dict[Where, range] = {"roof": places[-1:], "first storey": places[:1]}
    return chosen.get(SOURCES[measure].at, places)


def _selected(
    group: Group,
    dimension: str,
    among: Collection[int],
    storeys: Collection[int] | None,
    members: Collection[str] | None,
) -> list[int]:
    return [
        at
        for at in among
        if (storeys is None or _storey(group, dimension, at) in storeys)
        and (members is None or dimension == "storey" or _label(group, dimension, at) in members)
    ]


def _storey(group: Group, dimension: str, at: int) -> int:
    """The storey of a component, 0: of none; a beam counts with the storey below its floor."""
    if dimension not in group.coords:
        return 0
    if dimension == "damper":
        stored = group.variables.get("damper_storey")
        return 0 if stored is None else int(stored.values[at])
    return storey_of(_label(group, dimension, at))


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
