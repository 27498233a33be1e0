"""Archived quantities at some of their places: the value that a criterion limits, and where it occurs."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from edesign.archive.dataset import Group
from edesign.assess.energy import energy_share
from edesign.assess.envelopes import peak, residual
from edesign.assess.measures import Located, storey_of
from edesign.ground_motion.response_spectrum import response_spectra
from edesign.project.criteria.criteria import QuantityCriterion
from edesign.project.criteria.criterion_quantities import QUANTITIES
from edesign.project.project import Project

HISTORY_OF = {"floor_spectral_acceleration": "floor_acceleration", "damper_velocity": "damper_deformation"}
"""Variables over time that a quantity is computed from."""
OF_CORES = ("core_strain", "core_ductility", "cumulative_ductility")
"""Quantities of buckling-restrained braces alone."""
SUMS = ("damper_work", "cumulative_ductility")
"""Quantities whose value at the end counts."""


def located_quantity(group: Group, asked: QuantityCriterion, project: Project) -> Located | None:
    """Compute the quantity of a criterion in one analysis, and say where it occurs.

    Args:
        group: results of the analysis, as archived, with the histories that `HISTORY_OF` names.
        asked: the criterion.
        project: of the frame.

    Returns:
        The largest value over the chosen places; None where it does not apply, see `lacking`.
    """
    if asked.quantity == "energy_share":
        share = energy_share(group, str(asked.term))
        return None if share is None else Located(share)
    place = QUANTITIES[asked.quantity].place
    if place == "frame":
        left = asked.quantity.startswith("residual_")
        extreme = residual(group, asked.quantity.removeprefix("residual_")) if left else peak(group, asked.quantity)
        return None if extreme is None else Located(float(extreme))
    chosen = _chosen(group, asked, project)
    each = _values(group, asked, chosen) if chosen else None
    if each is None:
        return None
    at = int(np.argmax(each))
    label, number = group.coords[place].values[chosen[at]], None
    if place in ("floor", "storey"):
        number = int(label)
    elif place == "damper":
        number = int(group.variables["damper_storey"].values[chosen[at]]) or None
    elif place not in ("support", "isolator"):
        number = storey_of(str(label))
    value = float(each[at])
    if place == "floor":
        return Located(value, floor=number)
    return Located(value, number, "" if place == "storey" else str(label))


def lacking(group: Group, asked: QuantityCriterion, project: Project) -> str:
    """Return why the quantity of a criterion does not apply to a completed analysis, "" where it does.

    Args:
        group: of the analysis in the archive.
        asked: criterion with the quantity.
        project: the validated project.
    """
    quantity = QUANTITIES[asked.quantity]
    if asked.of_dampers and "damper" not in group.coords:
        return "there are no dampers"
    if quantity.isolated and not group.attributes.get("isolated"):
        return "the base is not isolated"
    if quantity.place != "frame" and quantity.place not in group.coords:
        return f"there are no {quantity.place}s"
    if quantity.place != "frame" and not _chosen(group, asked, project):
        return f"there is no {quantity.place} in the places chosen"
    if asked.quantity == "damper_strain" and "damper_strain_max" not in group.variables:
        return "no damper has layers"
    if asked.quantity in OF_CORES and "core_strain_max" not in group.variables:
        return "no damper is a buckling-restrained brace"
    return ""


def missing_history(group: Group, asked: QuantityCriterion) -> str:
    """Return the name of a variable that the quantity of a criterion needs and the archive does not have, "" if none.

    What a study has to keep for its criteria is checked before it runs; archives of other studies may lack it.

    Args:
        group: of the analysis in the archive.
        asked: criterion with the quantity.
    """
    needed = HISTORY_OF.get(asked.quantity)
    if needed is not None:
        return "" if needed in group.variables else needed
    kept = QUANTITIES[asked.quantity].kept
    return asked.quantity if kept is not None and f"{asked.quantity}_max" not in group.variables else ""


def _chosen(group: Group, asked: QuantityCriterion, project: Project) -> list[int]:
    """Indices of the places that a criterion chooses."""
    place = QUANTITIES[asked.quantity].place
    labels = group.coords[place].values.tolist() if place in group.coords else []
    frame, places = project.frame, range(len(labels))
    if place == "floor":
        return [i for i in places if int(labels[i]) in asked.floors.numbers(1, frame.n_storeys)]
    if place in ("support", "isolator"):  # A0, I_A
        lines = asked.lines.names(frame.lines)
        return [i for i in places if str(labels[i]).removeprefix("I_").rstrip("0123456789") in lines]
    names = asked.dampers if place == "damper" else asked.members
    if place == "damper":
        storeys = [int(number) for number in group.variables["damper_storey"].values] if labels else []
    else:
        storeys = [storey_of(str(label)) for label in labels]
    wanted = asked.storeys.numbers(1, frame.n_storeys)
    return [
        i for i in places if (asked.storeys.is_all or storeys[i] in wanted) and (not names or str(labels[i]) in names)
    ]


def _values(group: Group, asked: QuantityCriterion, chosen: list[int]) -> np.ndarray | None:
    """The value at each of the chosen places, of members the larger of both ends."""
    found: np.ndarray | None
    if asked.quantity in _COMPUTED:
        name = HISTORY_OF[asked.quantity]
        if name not in group.variables:
            return None
        over_time = np.asarray(group.variables[name].values, dtype=float)[:, chosen]
        time = np.asarray(group.coords["time"].values, dtype=float)
        return _COMPUTED[asked.quantity](time, over_time, asked)
    if asked.quantity.startswith("residual_"):
        found = residual(group, asked.quantity.removeprefix("residual_"))
    elif asked.quantity in SUMS:
        final = group.variables.get(f"{asked.quantity}_final")
        found = None if final is None else np.asarray(final.values, dtype=float)
    elif asked.side is not None:
        found = _one_side(group, asked)
    else:
        found = peak(group, asked.quantity)
    return None if found is None else found.reshape(len(found), -1).max(axis=1)[chosen]


def _one_side(group: Group, asked: QuantityCriterion) -> np.ndarray | None:
    """Tension or compression alone, 0 where there is none; supports pull the frame down where it would lift."""
    upper = (asked.side == "tension") != (QUANTITIES[asked.quantity].place == "support")
    variable = group.variables.get(f"{asked.quantity}_{'max' if upper else 'min'}")
    if variable is None:
        return None
    values = np.asarray(variable.values, dtype=float)
    return np.maximum(values if upper else -values, 0.0)


def floor_spectral_acceleration(time: np.ndarray, floors: np.ndarray, asked: QuantityCriterion) -> np.ndarray:
    """Return the largest total acceleration of an oscillator on each floor, m/s2.

    It does not act back on the floor. After the last sample it swings on freely.

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


def damper_velocity(time: np.ndarray, deformations: np.ndarray, asked: QuantityCriterion) -> np.ndarray:
    """Return the largest velocity of each damper as a criterion asks for it; see `largest_velocity`.

    Args:
        time: (n,) s.
        deformations: (n, dampers) m.
        asked: the criterion.

    Returns:
        One value a damper, m/s.
    """
    return largest_velocity(time, deformations)


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


_COMPUTED: dict[str, Callable[[np.ndarray, np.ndarray, QuantityCriterion], np.ndarray]] = {
    "floor_spectral_acceleration": floor_spectral_acceleration,
    "damper_velocity": damper_velocity,
}


def _known(value: float | None) -> float:
    assert value is not None, "check_quantity wants it"
    return value
