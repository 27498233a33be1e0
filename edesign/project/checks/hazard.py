"""Cross checks of the seismic action."""

from __future__ import annotations

from edesign.project.actions.hazard import EC8Hazard, Level, UserHazard
from edesign.project.actions.hazard_base import Hazard
from edesign.project.actions.spectrum_tables import SpectrumValues
from edesign.project.reading.checks_files import check_file
from edesign.project.reading.file_model import FileModel
from edesign.project.reading.problems import Keys, Problems, listed

_WAYS = tuple(Level.model_fields)


def check_hazard(hazard: Hazard | None, holder: FileModel, problems: Problems, files: bool = True) -> None:
    """Check the seismic action of a file without schema problems; names of the code are checked later.

    Args:
        holder: the file that it stands in, which keeps the contents of the files that the action names.
        files: whether the files that it names must be there.
    """
    if hazard is None:
        return
    holder.lend_contents(hazard.lend)
    if files:
        for keys, file in hazard.files():
            check_file(holder.folder / file, ("hazard", *keys), problems, f"{holder.kind} file")
    if isinstance(hazard, EC8Hazard):
        _reference(hazard, problems)
        _corners(hazard, problems)
        for name, level in hazard.levels.items():
            given = [way for way in _WAYS if getattr(level, way) is not None]
            if not given:
                problems.at_key(("hazard", "levels", name), f"give one of {listed(_WAYS)} [E-KEY-02]")
            for way in given[1:]:
                message = f"`{given[0]}` and `{way}` exclude each other; keep one of them [E-KEY-03]"
                problems.at_key(("hazard", "levels", name, way), message)
    if isinstance(hazard, UserHazard):
        _tables(hazard, problems)


def _reference(hazard: EC8Hazard, problems: Problems) -> None:
    """Zone or acceleration, one of them; a zone belongs to a country."""
    if hazard.zone is None and hazard.a_gR is None:
        message = "give either `country` and `zone`, or the reference ground acceleration `a_gR` [E-KEY-03]"
        problems.at_key(("hazard",), message)
    if hazard.zone is not None and hazard.a_gR is not None:
        problems.at_key(("hazard", "a_gR"), "`zone` and `a_gR` exclude each other; keep one of them [E-KEY-03]")
    if hazard.zone is not None and hazard.country is None:
        problems.under(("hazard",), "country", "this key is missing; a zone belongs to a country [E-KEY-02]")


def _corners(hazard: EC8Hazard, problems: Problems) -> None:
    """T_B <= T_C <= T_D among those that are given; against the table they are checked with the code at hand."""
    given = [(name, getattr(hazard.parameters, name)) for name in ("T_B", "T_C", "T_D")]
    known = [(name, value) for name, value in given if value is not None]
    for (low, first), (high, second) in zip(known, known[1:], strict=False):
        if first > second:
            message = (
                f"{high} = {second:g} s is less than {low} = {first:g} s; T_B <= T_C <= T_D is needed [E-VALUE-04]"
            )
            problems.at_value(("hazard", "parameters", high), message)


def _tables(hazard: UserHazard, problems: Problems) -> None:
    """One table with factors on it, or a table for each level; as many ordinates as periods."""
    for keys, table in hazard.tables():
        if isinstance(table, SpectrumValues) and len(table.periods) != len(table.accelerations):
            message = (
                f"{len(table.accelerations)} ordinates for {len(table.periods)} periods; each period has one"
                " [E-VALUE-04]"
            )
            problems.at_value(("hazard", *keys, "accelerations"), message)
    for name, level in hazard.levels.items():
        at: Keys = ("hazard", "levels", name)
        if level.probability is not None and level.return_period is not None:
            message = "`probability` and `return_period` exclude each other; keep one of them [E-KEY-03]"
            problems.at_key((*at, "return_period"), message)
        if hazard.spectrum is not None and level.spectrum is not None:
            problems.at_key(
                (*at, "spectrum"), "the levels are factors on `hazard.spectrum`; give a `factor` here [E-HAZ-04]"
            )
        elif hazard.spectrum is not None and level.factor is None:
            problems.under(at, "factor", "this key is missing; the level is a factor on `hazard.spectrum` [E-KEY-02]")
        elif hazard.spectrum is None and level.factor is not None:
            message = (
                "a factor needs a spectrum; give `hazard.spectrum`, or a `spectrum` here in place of the factor"
                " [E-HAZ-04]"
            )
            problems.at_key((*at, "factor"), message)
        elif hazard.spectrum is None and level.spectrum is None:
            problems.under(
                at,
                "spectrum",
                "this key is missing; there is no `hazard.spectrum` that a factor could be on [E-KEY-02]",
            )
    if hazard.spectrum is None and not hazard.levels:
        problems.under(
            ("hazard",), "spectrum", "this key is missing; or give `levels`, each with a `spectrum` [E-KEY-02]"
        )
