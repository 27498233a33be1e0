"""What a user should know about a fit, in words."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from edesign.damper.fitting.uncertainty import Uncertainty

CORRELATED = 0.98
_SHARE = 0.5  # of a parameter's variance in loose combinations, for it to be named
_TOLD = 0.05  # standard error / value, up to which correlation does no harm
_UNSURE = 0.5  # standard error / value


def doubts_of(
    names: Sequence[str],
    values: Mapping[str, float],
    errors: Mapping[str, float],
    found: Uncertainty,
) -> list[str]:
    """Doubts about what the data can tell.

    Args:
        names: of the fitted parameters, in the order of `found`.
        values: SI.
        errors: standard errors, SI.
        found: of the same parameters.
    """
    said = []
    loose = [name for name, share in zip(names, found.loose, strict=True) if share > _SHARE]
    if len(loose) > 1:
        said.append(
            f"{_and(loose)}: the data tell only combinations of them "
            f"(condition {found.condition:.1e}); hold one or more"
        )
    for i, first in enumerate(names):
        for j in range(i):
            rho = float(found.correlation[i, j])
            unsure = max(errors[name] / max(abs(values[name]), 1e-300) for name in (first, names[j]))
            together = first in loose and names[j] in loose
            if abs(rho) > CORRELATED and unsure > _TOLD and not together:
                said.append(f"{names[j]} and {first} are correlated by {rho:.3f}: the data can hardly tell them apart")
    for name in names:
        if name not in loose and errors[name] > _UNSURE * abs(values[name]):
            said.append(f"{name}: the standard error is {_ratio(errors[name], values[name])} of the value")
    return said


def start_doubts(costs: Sequence[float], same: int, converged: bool) -> list[str]:
    """Doubts about the search."""
    said = []
    if len(costs) > 1 and same == 1:
        said.append(
            f"only one of {len(costs)} starts ended at the least error; more starts would show whether it is the least"
        )
    if not converged:
        said.append("the last search did not end by itself; the parameters may be short of the best ones")
    return said


def _and(names: Sequence[str]) -> str:
    return ", ".join(names[:-1]) + f" and {names[-1]}"


def _ratio(error: float, value: float) -> str:
    return f"{100.0 * error / abs(value):.0f} %" if value else "a multiple"
