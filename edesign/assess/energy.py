"""The energy balance of a history since its motion began: terms, and their shares of the energy put in."""

from __future__ import annotations

import numpy as np

from edesign.archive.dataset import Group

BEFORE = "energy_before"
"""Variable of the energies before the motion, which the others leave out; archives without it count them in."""
Terms = dict[str, np.ndarray]


def energies(group: Group) -> Terms | None:
    """Return the terms of the energy balance over time, (nt,) J since the motion began; None if they were not kept.

    Args:
        group: results of a history, as archived.
    """
    kept = group.variables.get("energy")
    if kept is None:
        return None
    table = np.asarray(kept.values, dtype=float)
    return dict(zip(_names(group), (table - table[:1]).T, strict=True))


def final_energies(group: Group) -> dict[str, float] | None:
    """Return the terms of the energy balance at the end, J since the motion began; None if that is not known.

    Args:
        group: results of a history, as archived.
    """
    final = group.variables.get("energy_final")
    if final is None:
        return None
    values = np.asarray(final.values, dtype=float)
    if BEFORE not in group.variables:
        if "energy" not in group.variables:
            return None
        values = values - np.asarray(group.variables["energy"].values[0], dtype=float)
    return dict(zip(_names(group), map(float, values), strict=True))


def energy_share(group: Group, term: str) -> float | None:
    """Return a term of the energy balance over the energy put in, both at the end and since the motion began.

    Gravity has put energy in before the motion, and goes on working while the frame moves; only the latter counts, as
    in the error of the balance.

    Args:
        group: results of a history, as archived.
        term: a name along `energy_term`.

    Returns:
        The ratio; None if it is not known, or if nothing was put in.
    """
    found = final_energies(group)
    return share_of_input(found, found[term]) if found is not None else None


def share_of_input(final: dict[str, float] | None, part: float | None) -> float | None:
    """Return a part over the energy put in; None without either, or if nothing was put in.

    Args:
        final: see `final_energies`.
        part: J.
    """
    if final is None or part is None or final["input"] <= 0.0:
        return None
    return part / final["input"]


def _names(group: Group) -> list[str]:
    return [str(name) for name in group.coords["energy_term"].values]
