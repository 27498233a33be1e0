"""How far columns, beams and braces are used by the forces of histories, and which are used beyond 1."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from operator import attrgetter
from types import MappingProxyType

from edesign.assess.member_uses import (
    BeamForces,
    LoadedMember,
    beam_forces,
    in_words,
    loaded_members,
    rule_of,
    support_forces,
    without_dampers,
)
from edesign.assess.sets import HistorySet
from edesign.codes.motion_sets import SetRules
from edesign.ground_motion.hazard import rules_in_force
from edesign.project.actions.hazard_base import Hazard
from edesign.project.frame.member_design import ElasticUse
from edesign.project.project import Project
from edesign.report.assessment.measure_tables import label, missing_notes
from edesign.report.tables.column import Column, col, count, text
from edesign.report.tables.number import finite
from edesign.report.tables.table import Table, TableSpec
from edesign.report.tables.text import wrapped
from edesign.report.tables.unit import KN, KN_M, ONE

KINDS = ("column", "beam", "brace")
MOST = 40
NOTHING = 0.5
"""N and N m below which a force is rounding of those beside it."""
NAMED = 5
"""Members that a line names."""
RULES = {"mean": "mean of {count} motions ({code})", "maximum": "largest of {count}"}
MEANING = (
    "N (tension positive), V, M: of the step and history with the largest use. Section: EN 1993-1-1, 6.2.6 and 6.2.8 "
    "to 6.2.10; buckling: 6.3; partial factors of `design`, 1 without it."
)
COLLECTED = (
    "Beams of rigid floors have the N that braces, dampers and columns bring to their line by equilibrium of the "
    "floor, without braces or dampers none."
)
NOT_COLLECTED = "N that beams of rigid floors collect from braces and dampers is not in this archive."


@dataclass(frozen=True)
class _Use:
    """A member with its use in the same frame without dampers; None: it is not known, or that is what it is."""

    member: LoadedMember
    bare: float | None


COLUMNS: tuple[Column[_Use], ...] = (
    text("kind", "member.kind"),
    count("storey", "member.storey"),
    text("member", "member.name"),
    col("use", ONE, "member.use", form=".2f"),
    text("by", "member.check"),
    col("largest", ONE, "member.largest", form=".2f"),
    col("N", KN, lambda one: finite(one.member.N), 3, negligible=NOTHING, optional=True),
    col("V", KN, lambda one: finite(one.member.V), 3, negligible=NOTHING, optional=True),
    col("M", KN_M, lambda one: finite(one.member.M), 3, negligible=NOTHING, optional=True),
    col("without dampers", ONE, "bare", form=".2f", optional=True),
    text("history", "member.history", broken=1),
)
USE = TableSpec[_Use](
    "member_use",
    "{whose}: use of columns, beams and braces, worst of each storey",
    COLUMNS,
    keys=3,
    each="Use of columns, beams and braces",
)
BEYOND = TableSpec[_Use](
    "members_beyond_1",
    "{whose}: members used beyond 1",
    COLUMNS,
    keys=3,
    each="Members used beyond 1",
    most=MOST,
    cut="The first {shown} of {all}.",
)


@dataclass(frozen=True)
class _Beside:
    """A member with its use in the elastic design of its building."""

    member: LoadedMember
    elastic: ElasticUse

    @property
    def across(self) -> str | None:
        """Frames across to whose bracing a column belongs."""
        return None if self.elastic.across is None else ", ".join(self.elastic.across.frames)

    @property
    def N(self) -> float | None:
        """Axial force of the seismic action across, N."""
        return None if self.elastic.across is None else self.elastic.across.N


BEAMS = TableSpec[BeamForces](
    "beam_axial_forces",
    "{whose}: axial forces at the ends of beams that collect those of dampers and braces",
    (
        count("storey", "storey"),
        text("beam", "beam"),
        col("T start", KN, lambda one: one.start[0], 3, negligible=NOTHING),
        col("C start", KN, lambda one: one.start[1], 3, negligible=NOTHING),
        col("T end", KN, lambda one: one.end[0], 3, negligible=NOTHING),
        col("C end", KN, lambda one: one.end[1], 3, negligible=NOTHING),
    ),
    keys=2,
    each="Axial forces at the ends of beams that collect those of dampers and braces",
    notes=("T, C: largest tension and compression, for the connections of the beams, without overstrength.",),
)
ELASTIC = TableSpec[_Beside](
    "elastic_use",
    "{whose}: use beside that in the elastic design of the building",
    (
        text("kind", "member.kind"),
        count("storey", "member.storey"),
        text("member", "member.name"),
        col("use", ONE, "member.use", form=".2f"),
        col("elastic", ONE, "elastic.use", form=".2f"),
        text("bracing", "across", optional=True),
        col("N across", KN, "N", 3, optional=True),
        col("with it", ONE, "member.across", form=".2f", optional=True),
        text("check", "elastic.check"),
        text("combination", "elastic.combination", broken=1),
    ),
    keys=3,
    each="Use beside that in the elastic design of the building",
)
MEANT = "Meant to yield, judged by their plastic deformations, and so never listed as beyond 1:"
ACROSS = (
    "N across: compression that the seismic action across the frame brings to columns of a bracing there, with its "
    "factor in the combinations in which that along the frame leads, overstrength included. With it: use of the column "
    "under the forces of the histories with this compression."
)


@dataclass(frozen=True)
class _Uses:
    """The members of a set, those of the same frame without dampers, and the largest uplift of a support."""

    found: HistorySet
    rules: SetRules
    members: Sequence[LoadedMember]
    bare: Mapping[str, float]
    uplift: float | None
    dissipative: Callable[[str], bool]

    @property
    def rows(self) -> list[_Use]:
        return [_Use(one, self.bare.get(one.name)) for one in self.members]

    @property
    def note(self) -> str:
        """By what rule the uses are taken."""
        text = RULES[rule_of(self.found, self.rules)].format(count=self.found.motions, code=in_words(self.rules))
        return f"Use: {text}." if self.found.motions > 1 else ""

    def of_kind(self, kind: str) -> list[LoadedMember]:
        """Members of a kind."""
        return [one for one in self.members if one.kind == kind]

    def worst(self, kind: str) -> LoadedMember | None:
        return max(self.of_kind(kind), key=lambda one: one.use, default=None)

    def beyond(self, kind: str) -> list[_Use]:
        """Members of a kind beyond 1 that are not meant to yield, the worst first."""
        every = (one for one in self.rows if one.member.kind == kind and one.member.use > 1.0)
        return sorted((one for one in every if not self.dissipative(one.member.name)), key=_order)

    def yielding(self, kind: str) -> list[LoadedMember]:
        """Members of a kind that are meant to yield."""
        return [one for one in self.of_kind(kind) if self.dissipative(one.name)]

    def number(self, kind: str) -> int | None:
        """How many members of a kind go beyond 1, those that are meant to yield too; None: there are none of it."""
        return None if self.worst(kind) is None else sum(one.use > 1.0 for one in self.of_kind(kind))

    @property
    def largest(self) -> float:
        """The largest use of all."""
        return max(one.use for one in self.members)

    @property
    def tension(self) -> float | None:
        """The largest tension of a column, N."""
        return max((one.tension for one in self.members if one.kind == "column"), default=None)


def _order(one: _Use) -> float:
    return -one.member.use


def _never(member: str) -> bool:
    return False


def _uses(sets: Sequence[HistorySet], hazard: Hazard | None, frame: Project | None) -> list[_Uses]:
    """The sets whose archives know uses."""
    dissipative = _never if frame is None else frame.dissipative
    rules = rules_in_force(hazard)
    of_set = {id(found): loaded_members(found, rules) for found in sets}
    found = []
    for one in sets:
        if members := of_set[id(one)]:
            other = without_dampers(sets, one)
            bare = {} if other is None else {member.name: member.use for member in of_set[id(other)]}
            lifts = [support.V for support in support_forces(one, rules) if support.extreme == "least compression"]
            found.append(_Uses(one, rules, members, bare, max(0.0, -min(lifts)) if lifts else None, dissipative))
    return found


def use_tables(
    sets: Iterable[HistorySet],
    hazard: Hazard | None,
    frame: Project | None = None,
    elastic: Mapping[str, ElasticUse] = MappingProxyType({}),
) -> Iterator[Table]:
    """Return the tables of each set of histories: the worst member of each storey, and all beyond 1.

    The use in the elastic design of the building stands beside, where it is known.

    Args:
        sets: those of archives that do not know uses are left out.
        hazard: of the file, whose code says what counts of several motions.
        frame: its project, whose `design` names members that are to yield; None: it is a building.
        elastic: uses of the elastic design of the building by member; halves of a beam have that of the beam.
    """
    for uses in _uses(list(sets), hazard, frame):
        places: dict[tuple[str, int], _Use] = {}
        for one in uses.rows:
            place = one.member.kind, one.member.storey
            if place not in places or one.member.use > places[place].member.use:
                places[place] = one
        rows = sorted(places.items(), key=lambda place: (KINDS.index(place[0][0]), place[0][1]))
        notes = wrapped(f"{uses.note} {MEANING} {_collected(uses)}".strip())
        if kinds := [f"{kind}s" for kind in KINDS if uses.yielding(kind)]:
            notes += wrapped(f"{MEANT} {' and '.join(kinds)}: `design: dissipative`.")
        notes += missing_notes([uses.found], labelled=False)
        without = ("largest",) if uses.found.motions == 1 else ()
        yield USE.of([one for _, one in rows], whose=label(uses.found), notes=notes, without=without)
        if beside := _beside(uses, [one.member for _, one in rows], elastic):
            notes = wrapped(ACROSS) if any(one.N is not None for one in beside) else []
            yield ELASTIC.of(beside, whose=label(uses.found), notes=notes)
        if beams := beam_forces(uses.found, uses.rules):
            yield BEAMS.of(sorted(beams, key=attrgetter("storey")), whose=label(uses.found))
        if beyond := [one for kind in KINDS for one in uses.beyond(kind)]:
            yield BEYOND.of(beyond, whose=label(uses.found), without=without)


def _beside(uses: _Uses, worst: Sequence[LoadedMember], elastic: Mapping[str, ElasticUse]) -> list[_Beside]:
    """The worst members of each storey, and of its columns of a bracing across the worst, beside the elastic design."""
    chosen = {member.name: member for member in worst}
    for storey in sorted({member.storey for member in uses.members}):
        columns = [one for one in uses.members if one.storey == storey and one.across is not None]
        if columns:
            most = max(columns, key=lambda one: one.across or 0.0)
            chosen[most.name] = most
    known = {name: elastic.get(name, elastic.get(name.rpartition("_")[0])) for name in chosen}
    rows = [_Beside(chosen[name], of) for name, of in known.items() if of is not None]
    return sorted(rows, key=lambda row: (KINDS.index(row.member.kind), row.member.storey))


def _collected(uses: _Uses) -> str:
    """Where the axial forces of beams come from."""
    coords = {name for group in uses.found.completed.values() for name in group.coords}
    if "collector" in coords:
        return COLLECTED
    return NOT_COLLECTED if {"damper", "brace"} & coords else ""


def _worst(kind: str, uses: _Uses) -> float | None:
    worst = uses.worst(kind)
    return None if worst is None else worst.use


def _worst_name(kind: str, uses: _Uses) -> str | None:
    worst = uses.worst(kind)
    return None if worst is None else worst.name


def _number(kind: str, uses: _Uses) -> int | None:
    return uses.number(kind)


MOST_SETS = 6
"""Sets of histories from which on the summary has the one of each variant with the largest use."""
IN_SHORT = TableSpec[_Uses](
    "use_in_short",
    "Use of members under the forces of the histories",
    (
        text("histories", lambda uses: label(uses.found)),
        *(
            column
            for kind in KINDS[:2]
            for column in (
                col(f"{kind}s", ONE, partial(_worst, kind), form=".2f", optional=True),
                text("of", partial(_worst_name, kind), name=f"worst {kind}", optional=True),
                count("> 1", partial(_number, kind), name=f"{kind}s beyond 1", optional=True),
            )
        ),
        col("braces", ONE, partial(_worst, "brace"), form=".2f", optional=True),
        col("tension", KN, "tension", 3, negligible=NOTHING, silent=True, optional=True),
        col("uplift", KN, "uplift", 3, negligible=NOTHING, silent=True, optional=True),
    ),
    most=12,
    cut="and {more} more, among all tables",
    named_by_title=True,
)


def use_in_short(sets: Sequence[HistorySet], hazard: Hazard | None, frame: Project | None = None) -> Table:
    """Return the worst uses of each set in a row with how many members go beyond 1, and which do so by the dampers.

    Of more than `MOST_SETS` sets, those with the largest use of each variant.

    Args:
        sets: of histories; those of archives that do not know uses are left out.
        hazard, frame: as of `use_tables`.
    """
    every = _uses(sets, hazard, frame)
    levels = len(every)
    if levels > MOST_SETS:
        worst: dict[str, _Uses] = {}
        for uses in every:
            before = worst.get(uses.found.variant)
            if before is None or uses.largest > before.largest:
                worst[uses.found.variant] = uses
        every = list(worst.values())
    rules = list(dict.fromkeys(uses.note for uses in every if uses.note))
    rules += ["Sections alone: buckling needs `design` in the file."] if any(map(_sections_alone, every)) else []
    said = [*rules, *["The worst level of each variant."] * (len(every) < levels)]
    said.append("Tension of columns, uplift: kN.")
    notes = wrapped(" ".join(said)) if every else []
    for uses in every[: IN_SHORT.most]:
        notes += _in_words(uses)
    return IN_SHORT.of(every, notes=notes)


def _sections_alone(uses: _Uses) -> bool:
    return not any("member_use_max" in group.variables for group in uses.found.completed.values())


def _in_words(uses: _Uses) -> list[str]:
    """Lines on the members beyond 1, and on those of them that dampers bring there."""
    lines = []
    for kind in KINDS:
        beyond = uses.beyond(kind)
        because = [one for one in beyond if one.bare is not None and one.bare <= 1.0]
        if len(because) < len(beyond):
            named = [f"{one.member.name} {one.member.use:.2f}" for one in beyond]
            told = f"{len(beyond)} of {len(uses.of_kind(kind)) - len(uses.yielding(kind))} {kind}s beyond 1"
            lines += wrapped(f"{label(uses.found)}: {told}: {_listed(named)}")
        if because:
            named = [f"{one.member.name} {one.member.use:.2f} (without {one.bare:.2f})" for one in because]
            lines += wrapped(f"{label(uses.found)}: dampers bring {kind}s beyond 1: {_listed(named)}")
    for kind in KINDS:
        meant = uses.yielding(kind)
        if yielded := [one for one in meant if one.use > 1.0]:
            most = max(yielded, key=lambda one: one.use)
            told = f"{len(yielded)} of {len(meant)} {kind}s that are meant to yield do, {most.name} {most.use:.2f}"
            lines += wrapped(f"{label(uses.found)}: {told}: their deformations count")
    across = [one for one in uses.members if one.across is not None and one.across > 1.0 >= one.use]
    if across:
        across.sort(key=lambda one: -(one.across or 0.0))
        named = [f"{one.name} {one.across:.2f} (without {one.use:.2f})" for one in across]
        lines += wrapped(f"{label(uses.found)}: with the seismic action across columns go beyond 1: {_listed(named)}")
    return lines


def _listed(named: Sequence[str]) -> str:
    more = len(named) - NAMED
    return ", ".join(named[:NAMED]) + (f" and {more} more" if more > 0 else "")
