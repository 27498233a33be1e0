"""How far sections and members of buildings are used by forces of one step: the worst of each storey."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from itertools import chain
from typing import NamedTuple

import numpy as np

from edesign.archive.dataset import Group
from edesign.assess.envelopes import peak
from edesign.assess.sets import HistorySet
from edesign.project.notation.names import member_kind, storey_of
from edesign.report.assessment.measure_tables import tables_of_sets
from edesign.report.tables.column import col, count, text
from edesign.report.tables.table import Table, TableSpec
from edesign.report.tables.unit import ONE


class _Use(NamedTuple):
    """The largest uses of the columns or beams of a storey over the histories of a set, and who has them."""

    kind: str
    storey: int
    section: float
    of_section: str
    member: float | None
    of_member: str | None


USE = TableSpec[_Use](
    "member_use",
    "{whose}: use of columns and beams",
    (
        text("kind"),
        count("storey"),
        col("section", ONE, "section", form=".2f"),
        text("section of", "of_section"),
        col("buckling", ONE, "member", form=".2f", optional=True),
        text("buckling of", "of_member", optional=True),
    ),
    notes=(
        "The largest of all histories, by the forces of one step. Section: N, M_y and M_z over the resistance, partial "
        "factors 1. Buckling: EN 1993-1-1, 6.3, with the factors of the design.",
    ),
    keys=2,
)


def use_tables(sets: Iterable[HistorySet]) -> Iterator[Table]:
    """Return a table of each set of histories of a building; plane frames have none."""
    return tables_of_sets(
        sets, "section_use_max", lambda motions, whose: USE.of(_uses(list(chain(*motions))), whose=whose)
    )


def _largest(groups: Sequence[Group], quantity: str) -> np.ndarray | None:
    found = [values.reshape(len(values), -1).max(axis=1) for g in groups if (values := peak(g, quantity)) is not None]
    return np.max(found, axis=0) if len(found) == len(groups) else None


def _uses(groups: Sequence[Group]) -> Iterator[_Use]:
    names = [str(name) for name in groups[0].coords["member"].values]
    section, member = (_largest(groups, name) for name in ("section_use", "member_use"))
    assert section is not None
    places: dict[tuple[str, int], list[int]] = {}
    for i, name in enumerate(names):
        places.setdefault((member_kind(name), storey_of(name)), []).append(i)
    for (kind, storey), own in sorted(places.items(), key=lambda place: (place[0][0] != "column", place[0][1])):
        worst = max(own, key=section.__getitem__)
        of_section = float(section[worst]), names[worst]
        if member is None:
            yield _Use(kind, storey, *of_section, None, None)
        else:
            worst = max(own, key=member.__getitem__)
            yield _Use(kind, storey, *of_section, float(member[worst]), names[worst])
