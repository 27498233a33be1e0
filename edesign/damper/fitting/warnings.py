"""What a user should know about a fit, in words."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from edesign.damper.fitting.fit import FOLLOWS
from edesign.damper.fitting.loading import Loading
from edesign.damper.history import sign_questionable

CORRELATED = 0.98
LOOSE = 0.5
"""Share of a parameter's variance in combinations that data do not determine, for it to be named."""
_PRECISE = 0.05  # standard error / value, up to which correlation does no harm
_UNSURE = 0.5  # standard error / value


def identifiability_warnings(
    names: Sequence[str],
    values: Mapping[str, float],
    errors: Mapping[str, float],
    correlation: np.ndarray,
    loose: Sequence[str],
    condition: float,
) -> list[str]:
    """List warnings about what the data can determine.

    Args:
        names: of the fitted parameters.
        values: SI.
        errors: standard errors, SI.
        correlation: (n, n) of them.
        loose: names of those that data determine in combinations only.
        condition: of the derivatives, with columns of unit length.
    """
    said = []
    if len(loose) > 1:
        said.append(
            f"{_and(loose)}: the data determine only combinations of them (condition {condition:.1e}); fix one or more"
        )
    for i, first in enumerate(names):
        for j in range(i):
            rho = float(correlation[i, j])
            unsure = max(errors[name] / max(abs(values[name]), 1e-300) for name in (first, names[j]))
            together = first in loose and names[j] in loose
            if abs(rho) > CORRELATED and unsure > _PRECISE and not together:
                said.append(f"{names[j]} and {first} are correlated by {rho:.3f}: the data can hardly separate them")
    for name in names:
        if name not in loose and errors[name] > _UNSURE * abs(values[name]):
            said.append(f"{name}: the standard error is {_ratio(errors[name], values[name])} of the value")
    return said


def sign_warnings(loadings: Sequence[Loading]) -> list[str]:
    """List warnings about tests in which a damper gives energy, or pushes the way it is pushed."""
    said = []
    for loading in loadings:
        if sign_questionable(loading.displacement, loading.force):
            said.append(
                f"test {loading.name}: the device gives energy instead of taking it: is the sign of force or "
                "displacement reversed?"
            )
    return said


def misfit_warnings(mean: float) -> list[str]:
    """List warnings about a law that does not follow the tests.

    Args:
        mean: over the tests, of rms error / rms of the force.
    """
    if mean <= FOLLOWS:
        return []
    return [f"the law does not follow the tests: its error is {100.0 * mean:.3g} % of the force"]


def search_warnings(costs: Sequence[float], same: int, converged: bool) -> list[str]:
    """List warnings about the search.

    Args:
        same: how many of them ended at the same minimum.
        converged: whether the search ended by itself.
    """
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
