"""Cross checks of the seismic action."""

from __future__ import annotations

from edesign.project.hazard import Hazard, Level
from edesign.project.problems import Problems, listed

_WAYS = tuple(Level.model_fields)


def check_hazard(hazard: Hazard | None, problems: Problems) -> None:
    """Check the seismic action, which has no schema problems. What names of the code mean is checked later."""
    if hazard is None:
        return
    _reference(hazard, problems)
    _corners(hazard, problems)
    for name, level in hazard.levels.items():
        given = [way for way in _WAYS if getattr(level, way) is not None]
        if not given:
            problems.at_key(("hazard", "levels", name), f"give one of {listed(_WAYS)}")
        for way in given[1:]:
            message = f"`{given[0]}` and `{way}` exclude each other; keep one of them"
            problems.at_key(("hazard", "levels", name, way), message)


def _reference(hazard: Hazard, problems: Problems) -> None:
    """Zone or acceleration, one of them; a zone belongs to a country."""
    if hazard.zone is None and hazard.a_gR is None:
        message = "give either `country` and `zone`, or the reference ground acceleration `a_gR`"
        problems.at_key(("hazard",), message)
    if hazard.zone is not None and hazard.a_gR is not None:
        problems.at_key(("hazard", "a_gR"), "`zone` and `a_gR` exclude each other; keep one of them")
    if hazard.zone is not None and hazard.country is None:
        problems.under(("hazard",), "country", "this key is missing; a zone belongs to a country")


def _corners(hazard: Hazard, problems: Problems) -> None:
    """T_B <= T_C <= T_D among those that are given; against the table they are checked with the code at hand."""
    given = [(name, getattr(hazard.parameters, name)) for name in ("T_B", "T_C", "T_D")]
    known = [(name, value) for name, value in given if value is not None]
    for (low, first), (high, second) in zip(known, known[1:], strict=False):
        if first > second:
            message = f"{high} = {second:g} s is less than {low} = {first:g} s; T_B <= T_C <= T_D is needed"
            problems.at_value(("hazard", "parameters", high), message)
