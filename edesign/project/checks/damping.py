"""Cross checks of inherent damping: modes or periods that differ, as many ratios as modes."""

from __future__ import annotations

from collections.abc import Sequence

from edesign.project.analysis.damping import (
    CaugheyDamping,
    MassDamping,
    ModalDamping,
    RayleighDamping,
    StiffnessDamping,
)
from edesign.project.analysis_file import AnalysisFile
from edesign.project.reading.problems import Keys, Problems

MOST_TERMS = 8
"""Of Caughey's series: with more its powers of the frequency, from -1 to 15, leave no digits in double precision."""


def check_damping(project: AnalysisFile, problems: Problems) -> None:
    """Check the inherent damping; `project` has no schema problems.

    Args:
        project: the file, which has no schema problems.
    """
    damping = project.damping
    if isinstance(damping, RayleighDamping):
        _either(damping, "modes", "periods", problems)
        _different(("damping", "modes"), damping.modes, "mode {}", problems)
        _different(("damping", "periods"), damping.periods or (), "{:g} s", problems)
    elif isinstance(damping, (MassDamping, StiffnessDamping)):
        _either(damping, "mode", "period", problems)
    elif isinstance(damping, ModalDamping):
        _modal(damping, problems)
    elif isinstance(damping, CaugheyDamping):
        _caughey(damping, problems)


def _either(
    damping: RayleighDamping | MassDamping | StiffnessDamping, mode: str, period: str, problems: Problems
) -> None:
    if getattr(damping, period) is not None and mode in damping.model_fields_set:
        problems.at_key(("damping", period), f"`{mode}` and `{period}` exclude each other; keep one of them [E-KEY-03]")


def _different(keys: Keys, values: Sequence[float], shown: str, problems: Problems) -> None:
    """Several values, each once."""
    what = keys[-1]
    for i, value in enumerate(values):
        if value in values[:i]:
            text = shown.format(value)
            if len(values) == 2:
                problems.at_value(keys, f"two different {what} are needed, not twice {text} [E-VALUE-04]")
            else:
                problems.at_value((*keys, i), f"{text} stands here twice [E-NAME-02]")


def _modal(damping: ModalDamping, problems: Problems) -> None:
    if isinstance(damping.ratio, tuple):
        if damping.modes is not None and damping.modes != len(damping.ratio):
            message = (
                f"{damping.modes} modes, but {len(damping.ratio)} ratios; leave this key out, the list says how many"
                " [E-KEY-03]"
            )
            problems.at_value(("damping", "modes"), message)
    elif damping.modes is None:
        message = "this key is missing: how many modes have the ratio; or give a list of ratios [E-KEY-02]"
        problems.under(("damping",), "modes", message)


def _caughey(damping: CaugheyDamping, problems: Problems) -> None:
    if (damping.modes is None) == (damping.periods is None):
        problems.at_key(("damping",), "Caughey damping needs either `modes` or `periods`, one of them [E-KEY-03]")
        return
    key, given, shown = ("modes", damping.modes, "mode {}") if damping.modes else ("periods", damping.periods, "{:g} s")
    given = given or ()
    if not 2 <= len(given) <= MOST_TERMS:
        message = f"{len(given)} {key}; from 2 to {MOST_TERMS} of them are possible"
        problems.at_value(("damping", key), f"{message}, and `modal` damping takes any number of modes [E-VALUE-04]")
    _different(("damping", key), given, shown, problems)
    if isinstance(damping.ratio, tuple) and len(damping.ratio) != len(given):
        message = f"{len(damping.ratio)} ratios for {len(given)} {key}; give one ratio, or one for each [E-VALUE-04]"
        problems.at_value(("damping", "ratio"), message)
