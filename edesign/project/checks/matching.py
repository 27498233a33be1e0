"""Cross checks of the fit of records: a spectrum to fit them to, its level and damping, bounds that rise."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from edesign.project.actions.hazard import UserHazard
from edesign.project.actions.hazard_base import Hazard
from edesign.project.analysis_file import AnalysisFile
from edesign.project.reading.problems import Keys, Problems, listed, unknown_name
from edesign.project.records.matching import Matching


def check_matching(
    hazard: Hazard | None, match: Matching | None, keys: Keys, problems: Problems, damping: Keys = ("hazard", "damping")
) -> None:
    """Check how a record is fitted to the spectrum of the hazard.

    Args:
        hazard: the seismic action; None: there is none.
        match: what the file says; None: the record stays as recorded.
        keys: its place in the file of the problems.
        damping: the place of the damping of the hazard there, or what leads to it.
    """
    if match is None:
        return
    if hazard is None:
        problems.at_key(keys, "a record is fitted to the spectrum of the `hazard`, and the file has none [E-HAZ-05]")
    else:
        check_less_than_critical(hazard.damping, problems, damping)
        check_fitted_level(hazard, match.level, keys, problems)
    if match.periods[0] >= match.periods[1]:
        problems.at_value((*keys, "periods"), "the shorter period stands first, and the two must differ [E-VALUE-04]")
    if match.scale_bounds[0] > match.scale_bounds[1]:
        problems.at_value((*keys, "scale_bounds"), "the smaller factor stands first [E-VALUE-04]")


def check_fitted_level(hazard: Hazard, level: str | None, keys: Keys, problems: Problems) -> None:
    """Check which of the levels a record is fitted to, where each has a spectrum of its own.

    Args:
        level: that the file names; None: none.
        keys: of what the level belongs to, in the file of the problems.
    """
    if level is not None and not hazard.own_shapes:
        message = (
            "the levels have spectra of one shape, and records fitted to it are scaled to each; leave this key out"
            " [E-KEY-03]"
        )
        problems.at_key((*keys, "level"), message)
    elif level is not None and level not in hazard.levels:
        problems.at_value((*keys, "level"), unknown_name("level", level, hazard.levels))
    elif level is None and hazard.own_shapes and len(hazard.levels) > 1:
        message = f"this key is missing; each level has a spectrum of its own: {listed(hazard.levels)} [E-KEY-02]"
        problems.under(keys, "level", message)


def check_fitted_levels(
    keys: Keys, records: Iterable[str], levels: Sequence[str], project: AnalysisFile, problems: Problems
) -> None:
    """Check that records fitted to the spectrum of one level are used at no other.

    Args:
        keys: where the levels stand in the file of the problems.
        records: names of fitted records of the project; those that are fitted to a shape of all levels pass.
        project: that has them.
    """
    for name in records:
        only = project.fitted_level(name)
        for i, level in enumerate(levels):
            if only is not None and level in project.hazard_levels and level != only:
                message = (
                    f"`{name}` is fitted to the spectrum of `{only}`, which has another shape than that of `{level}`"
                )
                problems.at_item(keys, i, f"{message}; match another record to it [E-SCALE-02]")


def check_compared_damping(hazard: Hazard | None, suite: str, problems: Problems, keys: Keys) -> None:
    """Check that there is a spectrum of the damping at which the criteria of codes compare suites.

    Args:
        hazard: the seismic action; None: there is none.
        suite: name of the records.
        keys: the place that is told.
    """
    if isinstance(hazard, UserHazard) and not hazard.at_5_percent:
        message = (
            f"the criteria for the suite `{suite}` compare spectra of 5 % damping; give tables for 5 %, or "
            "`damping_correction` [E-SCALE-02]"
        )
        problems.at_value(keys, message)


def check_less_than_critical(damping: float, problems: Problems, keys: Keys = ("hazard", "damping")) -> None:
    """Check that there are records of a damping.

    Args:
        damping: ratio of critical.
        keys: its place in the file of the problems.
    """
    if damping >= 1.0:
        message = (
            "a record is fitted to this spectrum; its damping must be less than critical, below 100 % [E-VALUE-02]"
        )
        problems.at_value(keys, message)
