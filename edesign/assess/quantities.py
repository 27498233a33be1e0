"""Archived quantities at some of their places: the value that a criterion limits, and where it occurs."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from edesign.archive.dataset import Group
from edesign.assess.energy import energy_share
from edesign.assess.envelopes import peak, residual
from edesign.assess.measures import Located
from edesign.assess.spread import Spread, in_frames, line_and_number, resultant, spread, stored_dims
from edesign.codes.ec8.analysis.directions import SHARE
from edesign.ground_motion.response_spectrum import response_spectra
from edesign.project.analysis_file import AnalysisFile
from edesign.project.criteria.criteria import QuantityCriterion
from edesign.project.criteria.criterion_quantities import QUANTITIES
from edesign.project.criteria.measures import ELSEWHERE
from edesign.project.notation.names import isolator_name, storey_of


def located_quantity(group: Group, asked: QuantityCriterion, project: AnalysisFile) -> Located | None:
    """Compute the quantity of a criterion in one analysis, and say where it occurs.

    Args:
        group: results of the analysis, as archived, with the histories that the quantity needs.

    Returns:
        The largest value over the chosen places; None where it does not apply, see `lacking`.
    """
    asked = _on_lines(group, asked)
    place = QUANTITIES[asked.quantity].place
    chosen = _chosen(group, asked, project)
    each = _values(group, asked, project, chosen) if chosen else None
    if each is None or each.values.size == 0:
        return None
    at = int(np.argmax(each.values))
    value = float(each.values[at])
    if value == -np.inf:  # no line of the frames in this direction
        return None
    found = Located(value, direction=each.direction[at], axis=each.axis[at])
    if place == "frame":
        return found
    label = str(group.coords[place].values[chosen[at]])
    if place == "floor":
        return replace(found, floor=int(label))
    if place == "storey":
        return replace(found, storey=int(label))
    if place == "point":
        line, floor = line_and_number(label)
        return replace(found, floor=floor, line=line)
    if place == "drift_line":
        line, storey = line_and_number(label)
        return replace(found, storey=storey, line=line)
    number = None
    if place == "damper":
        number = int(group.variables["damper_storey"].values[chosen[at]]) or None
    elif place not in ("support", "isolator"):
        number = storey_of(label)
    return replace(found, storey=number, member=label)


def _on_lines(group: Group, asked: QuantityCriterion) -> QuantityCriterion:
    """The criterion on column lines of a building, where it names some, and of the drift of a storey in any case."""
    name = asked.quantity
    if name in ELSEWHERE and (
        asked.in_space.lines or asked.frames or (name == "storey_drift" and "line_drift_max" in group.variables)
    ):
        return asked.model_copy(update={"quantity": ELSEWHERE[name]})
    return asked


def lacking(group: Group, asked: QuantityCriterion, project: AnalysisFile) -> str:
    """Return why the quantity of a criterion does not apply to a completed analysis, "" where it does.

    Args:
        group: of the analysis in the archive.
    """
    asked = _on_lines(group, asked)
    quantity = QUANTITIES[asked.quantity]
    if asked.traits.of_dampers and "damper" not in group.coords:
        return "there are no dampers"
    if quantity.isolated and not group.attributes.get("isolated"):
        return "the base is not isolated"
    if quantity.place != "frame" and quantity.place not in group.coords:
        return f"there are no {_IN_WORDS.get(quantity.place, quantity.place)}s"
    if quantity.place != "frame" and not _chosen(group, asked, project):
        return f"there is no {_IN_WORDS.get(quantity.place, quantity.place)} in the places chosen"
    variable, why = _source(asked).needs
    return why if variable and variable not in group.variables else ""


_IN_WORDS = {"drift_line": "column line", "point": "corner of a floor"}
_FOUND_ON_THE_WAY = ("section_use", "member_use", "brace_use")
"""Which archives of before do not have."""


def missing_history(group: Group, asked: QuantityCriterion) -> str:
    """Return the name of a variable that the quantity of a criterion needs and the archive does not have, "" if none.

    What a study has to keep for its criteria is checked before it runs; archives of other studies may lack it.

    Args:
        group: of the analysis in the archive.
    """
    needed = asked.traits.over_time
    if needed:
        return "" if needed in group.variables else needed
    if asked.quantity == "damper_velocity":
        return "" if {"damper_velocity_max", "damper_deformation"} & {*group.variables} else "damper_velocity"
    kept = asked.traits.kept is not None or asked.quantity in _FOUND_ON_THE_WAY
    return asked.quantity if kept and f"{asked.quantity}_max" not in group.variables else ""


def _chosen(group: Group, asked: QuantityCriterion, project: AnalysisFile) -> list[int]:
    """Indices of the places that a criterion chooses."""
    place = QUANTITIES[asked.quantity].place
    if place == "frame":
        return [0]
    labels = [str(label) for label in group.coords[place].values.tolist()] if place in group.coords else []
    grid, at = project.grid, asked.in_space.lines
    places = list(range(len(labels)))
    if place == "floor":
        return [i for i in places if int(labels[i]) in asked.floors.numbers(1, grid.n_storeys)]
    if place == "point":
        floors, points = asked.floors.numbers(1, grid.n_storeys), [line_and_number(label) for label in labels]
        return [i for i, (line, floor) in enumerate(points) if floor in floors and (not at or line in at)]
    if place in ("support", "isolator"):
        name_of = isolator_name if place == "isolator" else partial(grid.node_name, floor=0)
        there = [name_of(line) for line in at or asked.lines.names(grid.lines)]
        return [i for i in places if labels[i] in there]
    names = asked.dampers if place == "damper" else asked.members
    if place == "damper":
        storeys = [int(number) for number in group.variables["damper_storey"].values] if labels else []
    elif place == "drift_line":
        lines = [line_and_number(label) for label in labels]
        storeys = [storey for _, storey in lines]
        places = [i for i in places if not at or lines[i][0] in at]
    else:
        storeys = [storey_of(label) for label in labels]
        places = [i for i in places if place == "storey" or in_frames(group, place, i, asked.frames)]
    if place == "damper":
        places = [i for i in places if in_frames(group, place, i, asked.frames)]
    if asked.of != "all":
        places = [i for i in places if asked.counts(labels[i], project.dissipative(labels[i]))]
    wanted = asked.storeys.numbers(1, grid.n_storeys)
    return [i for i in places if (asked.storeys.is_all or storeys[i] in wanted) and (not names or labels[i] in names)]


def _values(group: Group, asked: QuantityCriterion, project: AnalysisFile, chosen: list[int]) -> Spread | None:
    """The value at each of the chosen places, of members the larger of both ends."""
    source, name = _source(asked), asked.traits.over_time
    if source.over_time is None:
        dims: tuple[str, ...]
        if of_both := asked.resultant or _RESULTANTS.get(asked.quantity):
            found, dims = resultant(group, of_both)
        else:
            found = source.of(group, asked, project)
            dims = source.dims if source.dims is not None else stored_dims(group, asked.quantity)
        if found is None or found.size == 0:
            return None
        each = spread(group, found, dims, asked.in_space)
        direction, axis = (tuple(of[i] for i in chosen) for of in (each.direction, each.axis))
        return Spread(each.values[chosen], direction, axis)
    if name not in group.variables:
        return None
    variable = group.variables[name]
    over_time = np.asarray(variable.values, dtype=float)[:, chosen]
    flat = over_time.reshape(len(over_time), -1)
    values = source.over_time(np.asarray(group.coords["time"].values, dtype=float), flat, asked)
    return spread(group, values.reshape(over_time.shape[1:]), variable.dims[1:], asked.in_space)


def _extreme(group: Group, asked: QuantityCriterion, project: AnalysisFile) -> np.ndarray | None:
    """The largest absolute value over time, or tension or compression alone.

    Of a side it is 0 where there is none; supports pull the frame down where it would lift.
    """
    if asked.side is None:
        return peak(group, asked.quantity)
    upper = (asked.side == "tension") != (QUANTITIES[asked.quantity].place == "support")
    variable = group.variables.get(f"{asked.quantity}_{'max' if upper else 'min'}")
    if variable is None:
        return None
    values = np.asarray(variable.values, dtype=float)
    return np.maximum(values if upper else -values, 0.0)


def _residual(group: Group, asked: QuantityCriterion, project: AnalysisFile) -> np.ndarray | None:
    return residual(group, asked.quantity.removeprefix("residual_"))


def _sum(group: Group, asked: QuantityCriterion, project: AnalysisFile) -> np.ndarray | None:
    """The value at the end."""
    final = group.variables.get(f"{asked.quantity}_final")
    return None if final is None else np.asarray(final.values, dtype=float)


def _energy_share(group: Group, asked: QuantityCriterion, project: AnalysisFile) -> np.ndarray | None:
    share = energy_share(group, str(asked.term))
    return None if share is None else np.asarray(share)


def floor_spectral_acceleration(time: np.ndarray, floors: np.ndarray, asked: QuantityCriterion) -> np.ndarray:
    """Return the largest total acceleration of an oscillator on each floor, m/s2.

    It does not act back on the floor. After the last sample it vibrates on freely.

    Args:
        time: (nt,) s, in equal steps.
        floors: (nt, n) total accelerations, m/s2.
        asked: has the frequency, Hz, and damping ratio of the oscillator.

    Returns:
        One value a floor, m/s2.
    """
    step, period = float(time[-1] - time[0]) / (time.size - 1), 1.0 / _known(asked.frequency)
    damping = _known(asked.damping)
    return np.array([response_spectra(one, step, [period], [damping]).sa[0, 0] for one in floors.T])


def damper_velocity(group: Group, asked: QuantityCriterion, project: AnalysisFile) -> np.ndarray | None:
    """Return the largest velocity of each damper, (n,) m/s; in archives of before 0.3 by what was kept over time."""
    if (found := peak(group, "damper_velocity")) is not None or "damper_deformation" not in group.variables:
        return found
    time, deformation = group.coords["time"].values, group.variables["damper_deformation"].values
    return largest_velocity(np.asarray(time, dtype=float), np.asarray(deformation, dtype=float))


def largest_velocity(time: np.ndarray, deformations: np.ndarray) -> np.ndarray:
    """Return the largest velocity of each damper, m/s, by the cubic spline through its deformation.

    Args:
        time: (nt,) s.
        deformations: (nt, n) m.

    Returns:
        (n,) m/s.

    Source: the derivative of a spline at its knots errs by h^4 u'''''/180; at 5 Hz and 0.01 s by 5e-5.
    """
    from scipy.interpolate import CubicSpline  # a fifth of a second, for this alone

    return np.asarray(np.abs(CubicSpline(time, deformations).derivative()(time)).max(axis=0))


def torsional_ratio(group: Group, asked: QuantityCriterion, project: AnalysisFile) -> np.ndarray | None:
    """Return the largest drift of the worst column line over the largest mean drift of all lines, by its own peak each.

    Without a direction in the criterion those count whose base shear is at least 30 % of that in the other one, as
    EN 1998-1, 4.3.3.5.1(3), has buildings act in both at once. In a direction that is pushed less both drifts come of
    what is pushed across, and their ratio says nothing of the building.

    Args:
        group: of an analysis of a building.

    Returns:
        (storeys, directions); None without the drifts.
    """
    lines, mean = peak(group, "line_drift"), peak(group, "mean_storey_drift")
    if mean is None:  # pushovers
        mean = _over_steps(group, "storey_drift")
    if lines is None or mean is None:
        return None
    shear = peak(group, "base_shear")
    if shear is None:
        shear = _over_steps(group, "base_shear")
    storeys = group.coords["storey"].values.tolist()
    of = np.array([line_and_number(str(label))[1] for label in group.coords["drift_line"].values])
    worst = np.array([lines[of == storey].max(axis=0) for storey in storeys])
    pushed = asked.direction is not None or shear is None or shear >= SHARE * shear.max()
    counts = (mean > 0.0) & pushed
    return np.divide(worst, mean, out=np.zeros_like(mean), where=counts)


def _over_steps(group: Group, name: str) -> np.ndarray | None:
    variable = group.variables.get(name)
    return None if variable is None else np.abs(np.asarray(variable.values, dtype=float)).max(axis=0)


@dataclass(frozen=True)
class Source:
    """How a quantity is taken of an analysis.

    Attributes:
        of: its values at all of its places, of a frame one.
        dims: of these values; None: those of the archived quantity.
        over_time: its values out of the time, (nt,) s, and of the variable over time of its places, (nt, n).
        needs: a variable without which it does not apply, and why.
    """

    of: Callable[[Group, QuantityCriterion, AnalysisFile], np.ndarray | None] = _extreme
    dims: tuple[str, ...] | None = None
    over_time: Callable[[np.ndarray, np.ndarray, QuantityCriterion], np.ndarray] | None = None
    needs: tuple[str, str] = ("", "")


_LAYERS = ("damper_strain_max", "no damper has layers")
_CORES = ("core_strain_max", "no damper is a buckling-restrained brace")
SOURCES = {
    "residual_floor_displacement": Source(_residual),
    "residual_storey_drift": Source(_residual),
    "residual_line_drift": Source(_residual),
    "residual_base_displacement": Source(_residual),
    "floor_spectral_acceleration": Source(over_time=floor_spectral_acceleration),
    "damper_velocity": Source(damper_velocity, dims=("damper",)),
    "damper_strain": Source(needs=_LAYERS),
    "core_strain": Source(needs=_CORES),
    "core_ductility": Source(needs=_CORES),
    "cumulative_ductility": Source(_sum, needs=_CORES),
    "damper_work": Source(_sum),
    "energy_share": Source(_energy_share, dims=()),
    "torsional_ratio": Source(torsional_ratio, dims=("storey", "direction")),
}
"""Of those that are more than an extreme over time which is always there."""


_RESULTANTS = {"base_shear_resultant": "base_shear"}
"""Quantities that are resultants by their name."""


def _source(asked: QuantityCriterion) -> Source:
    return SOURCES.get(asked.quantity, Source())


def _known(value: float | None) -> float:
    assert value is not None, "check_quantity wants it"
    return value
