"""The combinations of actions of a building, from its archive: what is alike in one row."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np

from edesign.report.building.results import BuildingResults, Row
from edesign.report.tables.column import bounded, col, count, formula, text
from edesign.report.tables.table import Table, TableSpec
from edesign.report.tables.unit import ONE
from edesign.space.archived import IMPERFECTION

COMBINATIONS = TableSpec[dict[str, str]](
    "combinations",
    "Combinations of actions",
    (text("no.", broken=1), formula("combination", broken=2), formula("situation"), text("EN 1990")),
    keys=4,
)
SWAY = TableSpec[dict[str, object]](
    "sway",
    "Sway in persistent combinations",
    (
        formula("combination", lambda row: row["combination"], broken=1),
        count("of them", lambda row: row["count"], missing=""),
        *(
            col(name, ONE, bounded(key), 3, optional=True)
            for key, name in (("alpha_cr", "alpha_cr"), ("alpha_cr_x", "alpha_cr,x"), ("alpha_cr_y", "alpha_cr,y"))
        ),
        *(col(f"factor {axis}", ONE, bounded(f"amplification_{axis}"), 4, optional=True) for axis in "xy"),
        *(col(f"1 / phi_{axis}", ONE, bounded(f"inverse_{axis}"), 3, optional=True) for axis in "xy"),
    ),
)
_SWAY_VALUES = ("alpha_cr", *(f"{key}_{axis}" for key in ("alpha_cr", "amplification", "inverse") for axis in "xy"))
_TERM = re.compile(r"(-?)(?:([0-9.e+-]+) )?(.+)")


@dataclass(frozen=True)
class _Term:
    """A term of the name of a combination, and what its load case is an alternative of."""

    sign: str
    factor: str
    symbol: str
    kind: str


def combinations_table(results: BuildingResults) -> Table:
    """Return the combinations of actions; those that differ in sign, direction, arrangement or pattern have one row.

    Of archives without the alternatives of load cases those that differ in signs of horizontal actions have one row.
    """
    cases = [str(case) for case in results.values("combinations", "case")]
    kinds = _alternatives(results, cases)
    of_columns = np.array([kinds[case] for case in cases])
    alike: dict[tuple[object, ...], list[Row]] = {}
    for row in results.rows("combinations", "combination"):
        static = np.abs(row["static"])
        acting = frozenset(zip(of_columns[static > 0.0].tolist(), static[static > 0.0].tolist(), strict=True))
        alike.setdefault((row["set"], row["equation"], acting, *np.abs(row["seismic"])), []).append(row)
    labels: dict[tuple[str, ...], str] = {}
    rows = []
    restrained = [number for number, case in enumerate(cases) if case.startswith("BRB ")]
    by = "amplified by Omega" if restrained else "1.1 gamma_ov Omega"
    for several in alike.values():
        first = several[0]
        amplified = np.abs(first["seismic"]).max(initial=0.0) > 1.0
        amplified_by = f", {by}" if amplified else ""
        if np.any(np.asarray(first["static"])[restrained]):
            amplified_by = ", BRB at adjusted strength"
        rows.append(
            {
                "combination": _together([_terms(str(row["name"]), kinds) for row in several], labels),
                "no.": _ranges([row.number + 1 for row in several]),
                "situation": f"{first['set']}{amplified_by}",
                "EN 1990": first["equation"],
            }
        )
    return COMBINATIONS.of(rows, notes=_notes(rows, labels))


def sway_table(results: BuildingResults) -> Table:
    """Return the sway stability in persistent combinations; those that differ in direction or pattern have one row.

    Of several the least alpha_cr stands there, and the largest factor and imperfection. Old archives have none of it.
    """
    if not results.has("sway"):
        return SWAY.of(())
    names = [str(name) for name in results.values("sway", "persistent")]
    kinds = _alternatives(results, [str(case) for case in results.values("combinations", "case")])
    alike: dict[object, list[int]] = {}
    for number, name in enumerate(names):
        alike.setdefault(frozenset((of.kind, of.factor) for of in _terms(name, kinds)), []).append(number)
    labels: dict[tuple[str, ...], str] = {}
    rows: list[dict[str, object]] = []
    known = results.group("sway").variables
    for several in alike.values():
        row: dict[str, object] = dict.fromkeys(_SWAY_VALUES) | {"count": len(several)}
        row["combination"] = _together([_terms(names[number], kinds) for number in several], labels)
        for key, of in known.items():
            values = of.values[several]
            row[key] = float(values.min() if key.startswith("alpha_cr") else values.max())
        for axis in "xy":
            phi = row.get(f"initial_sway_{axis}")
            row[f"inverse_{axis}"] = 1.0 / phi if isinstance(phi, float) and phi > 0.0 else None
        rows.append(row)
    notes = _notes([{"combination": str(row["combination"])} for row in rows], labels, "building_by_persistent")
    notes += [f"{key}: {of.long_name}" for key, of in known.items() if not key.startswith("initial")]
    return SWAY.of(rows, notes=notes)


def _alternatives(results: BuildingResults, cases: Sequence[str]) -> dict[str, str]:
    """What each load case is an alternative of, by its name; itself, if of nothing."""
    if "alternative" not in results.group("combinations").variables:
        return dict(zip(cases, cases, strict=True))
    return dict(zip(cases, map(str, results.values("combinations", "alternative")), strict=True))


def _terms(name: str, kinds: dict[str, str]) -> list[_Term]:
    parts = re.split(r" ([+-]) ", name)
    found = []
    for sign, part in zip(["+", *parts[1::2]], parts[::2], strict=True):
        match = _TERM.fullmatch(part)
        assert match is not None, "a term has a symbol"
        symbol, minus = match[3], match[1] or sign == "-"
        kind = kinds.get(f"-{symbol}" if minus and f"-{symbol}" in kinds else symbol, symbol)
        found.append(_Term("-" if minus else "+", match[2] or "", symbol, kind))
    return found


def _together(several: Sequence[Sequence[_Term]], labels: dict[tuple[str, ...], str]) -> str:
    """The name of combinations that are alike.

    `labels`: what names the alternatives of several cases, by these; those that are met are added.
    """
    name = ""
    for kind in dict.fromkeys(term.kind for term in several[0]):
        of_kind = [[term for term in terms if term.kind == kind] for terms in several]
        among, one = tuple(dict.fromkeys(map(_sum, of_kind))), of_kind[0][0]
        sign = "+-" if len({term.sign for terms in of_kind for term in terms}) > 1 else one.sign
        if len(among) == 1 and len(of_kind[0]) > 1:
            name += f" {sign} {one.factor} {labels.setdefault(among, kind[1:-1])}"
        elif len(among) == 1:
            name += "".join(f" {term.sign} {term.factor} {term.symbol}" for term in of_kind[0])
        elif len({term.symbol for terms in of_kind for term in terms}) == 1:
            name += f" {sign} {one.factor} {one.symbol}"
        elif kind[0] != "[":
            name += f" {sign} {one.factor} {kind}"
        else:
            again = sum(label[:1] == "[" and label.startswith(kind[:-1]) for label in labels.values())
            label = labels.setdefault(among, f"{kind[:-1]} {again + 1}]" if again else kind)
            name += f" + {one.factor} {label}"
    return re.sub(" +", " ", name).removeprefix(" + ").strip()


def _sum(terms: Iterable[_Term]) -> str:
    """Cases that act together, without factors."""
    return " ".join(f"{term.sign} {term.symbol}" for term in terms).removeprefix("+ ").replace("- ", "-", 1)


def _ranges(numbers: Sequence[int]) -> str:
    """Rising numbers: 2-5, 9."""
    ends = [i for i, number in enumerate(numbers) if i + 1 == len(numbers) or numbers[i + 1] != number + 1]
    begins = [0, *(i + 1 for i in ends[:-1])]
    return ", ".join(
        str(numbers[i]) if i == k else f"{numbers[i]}-{numbers[k]}" for i, k in zip(begins, ends, strict=True)
    )


def _notes(
    rows: Sequence[dict[str, str]], labels: dict[tuple[str, ...], str], table: str = "building_by_combination"
) -> list[str]:
    names = [row["combination"] for row in rows]
    found = [f"{label}: {'one of ' * (len(among) > 1)}{', '.join(among)}" for among, label in labels.items()]
    if symbol := next((of for of in (f" {IMPERFECTION} ", "S_x") if any(of in f"{name} " for name in names)), ""):
        what = "S: sway imperfection along x or y" if symbol[0] == " " else "S_x, S_y: sway imperfections"
        found.append(f"{what}, of the combination that they stand in; P_Delta: its sway amplified")
    if any("[" in name for name in names):
        found.append(f"one by one: `edesign export`, table {table}")
    return found
