"""The table of pairs of components: how they act, by which rule they are scaled, how near they are to the target."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

from edesign.codes.rule_check import with_standard
from edesign.report.tables.cell import Listed
from edesign.report.tables.column import col, text
from edesign.report.tables.number import significant
from edesign.report.tables.table import Table, TableSpec
from edesign.report.tables.unit import ONE, PERCENT, S

_DIGITS = 3


def _misfit(key: str) -> Callable[[Mapping[str, Any]], Any]:
    return lambda pair: pair.get("misfit", {}).get(key)


PAIRS = TableSpec[Mapping[str, Any]](
    "pairs_of_components",
    "{whose}: pairs of components",
    (
        text("pair", "name"),
        text("components", lambda pair: ", ".join(pair["components"]), broken=1),
        text("compared", "spectrum"),
        col("factors", ONE, lambda pair: _factors(pair), _DIGITS),
        col("misfit rms", PERCENT, _misfit("rms"), _DIGITS),
        col("largest", PERCENT, _misfit("largest"), _DIGITS),
        col("at T", S, _misfit("at_period"), _DIGITS),
    ),
    keys=1,
    each="Pairs of components",
)


def pairs_table(name: str, about: Mapping[str, Any]) -> Table:
    """Return the pairs of a record with their factors, and how near their combined spectra are to the target.

    Args:
        about: attribute `pairs` of its archived group.
    """
    notes = [about["acting"]]
    notes += [with_standard(about["rule"])] if about["rule"] else []
    if about["suite_factor"] != 1.0:
        notes.append(f"all factors with {about['suite_factor']:.4f} of the whole set")
    for pair in about["of"]:
        notes += [pair["failure"]] if pair["failure"] else []
        best, used = pair.get("best_factor"), pair["factors"][0]
        if best is not None and abs(best - used) > 1e-9 * used:
            shown = (significant(value, _DIGITS) for value in (best, used))
            notes.append("{}: the best factor would be {}; its bound {} was used".format(pair["name"], *shown))
    return PAIRS.of(about["of"], whose=name, notes=notes)


def _factors(pair: Mapping[str, Any]) -> float | Listed:
    """The factor of all components, or one of each."""
    factors = pair["factors"]
    return factors[0] if len(set(factors)) == 1 else Listed(tuple(factors), ", ")
