"""A member under the forces of analyses: its uses, the concurrent forces that govern, and the worked calculation."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from edesign.archive.dataset import Group
from edesign.archive.reader import Archive
from edesign.assess.member_uses import LoadedMember, loaded_members
from edesign.assess.members import VariantMembers
from edesign.assess.sets import HistorySet, history_sets
from edesign.codes.ec3.utilisation import ForcesAlong, utilisation
from edesign.codes.motion_sets import SetRules
from edesign.codes.trace import Step, Trace
from edesign.core.member_checks import CLAUSES, FORCES, MEMBER_CHECKS, Check
from edesign.errors import InputError
from edesign.frame.sections.section_class import section_class
from edesign.ground_motion.hazard import rules_in_force
from edesign.project.analysis_file import AnalysisFile
from edesign.project.notation.names import member_kind
from edesign.project.project import Project
from edesign.project.reading.problems import did_you_mean
from edesign.report.archive_view import all_results
from edesign.report.archived import archived_base, archived_frame, archived_study
from edesign.report.assessment.measure_tables import label
from edesign.report.building.checks import CALCULATION, SAME, WorkedCheck, worked_data
from edesign.report.tables.column import col, count, text
from edesign.report.tables.number import finite, significant
from edesign.report.tables.table import Table, TableSpec
from edesign.report.tables.text import wrapped
from edesign.report.tables.unit import KN, KN_M, ONE, S
from edesign.space.analysis.response import STATIONS
from edesign.space.checks.member_checks import LARGEST_PLASTIC_CLASS
from edesign.study.results.checked_members import CheckedMember, checked_members

USES = ("section_use", "member_use", "brace_use")
_LOADED, _SHEARED = "member_load_moment", ("member_load_shear_before", "member_load_shear_behind")
SECTION_CHECKS = (Check.N_M, Check.V_Y, Check.V_Z)


@dataclass(frozen=True)
class _Row:
    """The use of the member in a set of histories, or in one other analysis."""

    title: str
    number: int
    use: float
    of: LoadedMember


UNDER = TableSpec[_Row](
    "member_under_histories",
    "{whose}: use under the forces of analyses",
    (
        text("analyses", "title"),
        count("n", "number"),
        col("use", ONE, "use", form=".2f"),
        text("by", "of.check"),
        col("largest", ONE, "of.largest", form=".3f"),
        col("at", S, "of.at", form=".2f"),
        col("tension", KN, "of.tension", 3, negligible=0.5, optional=True),
        text("analysis", "of.history", broken=1),
    ),
    each="Use under the forces of analyses",
)


@dataclass(frozen=True)
class _Place:
    """Internal forces at a place of the member."""

    place: float
    forces: tuple[float, ...]

    def of(self, force: str) -> float:
        """A force by its name."""
        return self.forces[FORCES.index(force)]


def _force(force: str, place: _Place) -> float:
    return place.of(force)


CONCURRENT = TableSpec[_Place](
    "concurrent_forces",
    "{whose}: concurrent forces in {history} at {at}",
    (
        col("x / L", ONE, "place", form=".3f"),
        *(
            col(force, KN_M if force[0] == "M" else KN, partial(_force, force), negligible=1e-3)
            for force in ("N", "V_y", "V_z", "M_y", "M_z")
        ),
    ),
    notes=("N positive in tension",),
    each="Concurrent forces",
)


@dataclass(frozen=True)
class Followed:
    """A member in the step of an analysis in which a check of it has its largest use.

    Attributes:
        member: as its checks see it.
        history: name of the analysis.
        at: time, s, of the step, or what the analysis is taken in.
        unit: of it.
        archived: use in the archive.
        check: which governs there.
        clause: of it.
        found: its use by the calculation.
        forces: along the member.
        known: places of these that are of one step.
        axial: what is to be known of the axial force; "" nothing.
        shear: likewise of the shear between the ends.
        steps: of the calculation, which leads to the archived use; none if it does not.
    """

    member: CheckedMember
    history: str
    at: float
    unit: str
    archived: float
    check: str
    clause: str
    found: float
    forces: ForcesAlong
    known: slice
    axial: str
    shear: str
    steps: tuple[Step, ...]


def loaded_member_tables(archive: Archive, name: str, analysis: str | None = None) -> list[Table]:
    """Return the uses of a member by variant and level, and the calculation of the largest with its forces.

    Args:
        name: of a column, beam or brace.
        analysis: name of the only analysis that counts; None: all of the archive.

    Raises:
        InputError: there is no such member, or nothing is known of its use.
        ArchiveError: the archive cannot be read.
    """
    rows, followed = _of_member(archive, name, analysis)
    said = ["Use: by the rule of the code over several motions."] if any(row.number > 1 for row in rows) else []
    said += ["Below: the analysis with the largest; another one by --analysis."] if len(rows) > 1 else []
    said += [*_elastic(archived_frame(archive), name), *_parts(archive, name)]
    notes = wrapped(" ".join(said))
    at = f"{followed.at:.4g} {followed.unit}".strip()
    known, along = followed.known, followed.forces
    places = [
        _Place(float(place), tuple(forces))
        for place, forces in zip(along.stations[known], along.steady[known].tolist(), strict=True)
    ]
    told = [followed.axial] if followed.axial else []
    told += [followed.shear] if len(places) > 2 and followed.shear else []
    told += [] if len(places) > 1 else ["The other end has its largest use in another step."]
    forces = CONCURRENT.of(
        places, whose=name, history=followed.history, at=at, notes=wrapped(" ".join(told)) if told else []
    )
    return [UNDER.of(rows, whose=name, notes=notes), forces, _calculation(followed, at)]


def loaded_member_data(archive: Archive, name: str, analysis: str | None = None) -> dict[str, object]:
    """Return what `loaded_member_tables` has, for JSON in SI units; errors as those."""
    rows, followed = _of_member(archive, name, analysis)
    along, known = followed.forces, followed.known
    forces = {force: along.steady[known, i].tolist() for i, force in enumerate(FORCES) if force != "T"}
    return {
        "member": name,
        "uses": [
            {
                "analyses": row.title,
                "number": row.number,
                "use": finite(row.use),
                "by": row.of.check,
                "largest": finite(row.of.largest),
                "analysis": row.of.history,
                "at": finite(row.of.at),
            }
            for row in rows
        ],
        "analysis": followed.history,
        "at": followed.at,
        "check": followed.check,
        "clause": followed.clause,
        "utilisation": finite(followed.archived),
        "forces": {"x_over_L": along.stations[known].tolist(), **forces},
        "calculation": worked_data(_worked(followed)),
    }


def _elastic(frame: Project | None, name: str) -> Iterator[str]:
    """What the elastic design of the building found for a member, in words."""
    uses = {} if frame is None or frame.design is None else frame.design.elastic_use
    of = uses.get(name) or uses.get(name.rpartition("_")[0])  # half of a beam
    if of is None:
        return
    yield f"In the elastic design of the building {of.use:.2f} by {of.check} under {of.combination}."
    if of.across is not None:
        yield (
            f"It belongs to the bracing of {', '.join(of.across.frames)}, where the seismic action across adds "
            f"{of.across.N / 1e3:.4g} kN of compression, which is not in these uses."
        )


def _parts(archive: Archive, name: str) -> Iterator[str]:
    """Where dampers halve a beam that is whole in other variants, or where a beam is whole of which this is a half."""
    if member_kind(name) != "beam":
        return
    whole, _, half = name.rpartition("_")
    found: dict[tuple[str, ...], list[str]] = {}
    for group in all_results(archive).values():
        there = {str(one) for one in group.coords["member"].values} if "member" in group.coords else set()
        others = (f"{name}_1", f"{name}_2"), (whole,) if half in ("1", "2") else ()
        for beams in filter(None, others):
            if name not in there and there.issuperset(beams):
                found.setdefault(beams, []).append(str(group.attributes.get("variant") or "an analysis without"))
    for beams, variants in found.items():
        where = ", ".join(dict.fromkeys(variants))
        yield f"In {where} it is {' and '.join(beams)}." if len(beams) > 1 else f"In {where} {whole} is not halved."


def _axial(group: Group, name: str, forces: ForcesAlong) -> str:
    """Where the axial force of a beam comes from, or that it has none."""
    if member_kind(name) != "beam":
        return ""
    if "collector" in group.coords and name in {str(one) for one in group.coords["collector"].values}:
        return "N by equilibrium of the floor, from dampers, braces and columns."
    if np.abs(forces.steady[:, 0]).max() > 1.0:  # N, beyond rounding
        return ""
    if "collector" in group.coords or not {"damper", "brace"} & {*group.coords}:
        return "N = 0: neither damper nor brace meets the line of this beam, and its floor is rigid."
    return "N = 0: forces that a beam of a rigid floor collects from dampers and braces are not in this archive."


def _shear(group: Group) -> str:
    """How shear between the ends was found."""
    if _SHEARED[0] in group.variables:
        return "V between the ends with the loads there, at a point load that of its larger side."
    if _LOADED in group.variables:
        return "V between the ends on the line between theirs: the archive is of a version that kept no more."
    return ""


def _of_member(archive: Archive, name: str, analysis: str | None) -> tuple[list[_Row], Followed]:
    groups = {key: group for key, group in all_results(archive).items() if analysis is None or key == analysis}
    names = dict.fromkeys(
        str(member)
        for group in groups.values()
        for kind in ("member", "brace")
        if kind in group.coords
        for member in group.coords[kind].values
    )
    if name not in names:
        raise InputError(f"{archive.path}: no member is named {name!r}{did_you_mean(name, names)} [E-ARCH-07]")
    base = archived_base(archive)
    assert base is not None, "analyses are of a file"
    rows = _rows(groups, name, rules_in_force(base.hazard))
    if not rows:
        raise InputError(
            f"{archive.path}: nothing is known of the use of {name}: its section or steel has no clause, or the "
            "analyses are of a version before 0.3 [E-ARCH-08]"
        )
    worst = max((row.of for row in rows), key=lambda of: of.largest)
    group = groups[worst.history]
    if not math.isfinite(worst.N):
        raise InputError(
            f"{archive.path}: the archive was made before forces were kept with the largest use; `edesign run` makes "
            "it anew [E-ARCH-08]"
        )
    variants = VariantMembers(base, archived_study(archive))
    file = variants.project(str(group.attributes.get("variant") or ""))
    return rows, follow(file, group, worst.history, name)


def _rows(groups: Mapping[str, Group], name: str, rules: SetRules) -> list[_Row]:
    sets = list(history_sets(groups))
    of_sets = {history for found in sets for history in found.histories}
    others = [HistorySet(key, "", {key: group}) for key, group in groups.items() if key not in of_sets]
    rows = []
    for found in [*sets, *others]:
        for of in loaded_members(found, rules):
            if of.name == name:
                title = label(found) if found in sets else found.variant
                number = found.motions if found in sets else 1
                rows.append(_Row(title, number, of.use, of))
    return rows


def follow(file: AnalysisFile, group: Group, history: str, name: str) -> Followed:
    """Return the check of a member with the largest use in an analysis, calculated from the forces of its step.

    Args:
        file: the project or building of the analysis.
    """
    (member,) = checked_members(file, [name]).members
    at = [str(one) for one in group.coords["brace" if member_kind(name) == "brace" else "member"].values].index(name)
    quantity = max(
        (of for of in USES if f"{of}_max" in group.variables and (of == "brace_use") == (member_kind(name) == "brace")),
        key=lambda of: np.max(_of(group, f"{of}_max")[at]),
    )
    use, when = (np.atleast_1d(_of(group, f"{quantity}_{of}")[at]) for of in ("max", "at"))
    end = int(np.argmax(use))
    checks: Sequence[Check] = SECTION_CHECKS
    station = len(STATIONS) - 1 if end else 0
    of_step, known = quantity, slice(None)
    if quantity == "section_use" and when[0] != when[1]:  # each end has its own step; that of buckling has both
        same_step = "member_use_at" in group.variables and _of(group, "member_use_at")[at] == when[end]
        of_step, known = ("member_use", known) if same_step else (quantity, slice(station, station + 1))
    forces = _forces(member, group, of_step, at)
    if quantity == "member_use":
        checks, station = MEMBER_CHECKS, int(np.abs(forces.steady[:, 4:]).max(axis=1).argmax())
    elif quantity == "brace_use":
        checks = (Check.N if forces.steady[0, 0] > 0.0 else Check.N_B,)
    compression = max(
        0.0, float(-forces.steady[:, 0].min() if quantity != "section_use" else -forces.steady[station, 0])
    )
    bends = quantity != "brace_use"
    both = quantity == "section_use" and "axis" in group.coords
    about_y = bends and not member.weak
    of_class = section_class(
        member.plastic.section, member.plastic.fy, -compression, about_y, both or (bends and member.weak)
    )
    steel = member.plastic if of_class.number <= LARGEST_PLASTIC_CLASS else member.elastic
    steel = replace(steel, section_class=of_class.number)  # one of class 1 is checked as one of class 2
    found = {check: utilisation(steel, forces, check.name, station) or 0.0 for check in checks}
    check = max(found, key=found.__getitem__)
    trace, archived = Trace(), float(use[end])
    utilisation(steel, forces, check.name, station, trace=trace)
    same = math.isclose(found[check], archived, rel_tol=SAME, abs_tol=SAME**2)
    return Followed(
        member,
        history,
        float(when[end]),
        group.variables[f"{quantity}_at"].unit.replace("1", ""),
        archived,
        check.name,
        CLAUSES[check],
        found[check],
        forces,
        known,
        _axial(group, name, forces),
        _shear(group),
        tuple(trace.steps) if same else (),
    )


def _of(group: Group, name: str) -> np.ndarray:
    return np.asarray(group.variables[name].values, dtype=float)


def _forces(member: CheckedMember, group: Group, quantity: str, at: int) -> ForcesAlong:
    """Internal forces along a member in the step of its largest use; those between the ends count loads inside."""
    steady = np.zeros((STATIONS.size, len(FORCES)))
    if quantity == "brace_use":
        steady[:, 0] = _of(group, "brace_use_axial_force")[at]
        return ForcesAlong(STATIONS, steady, np.zeros_like(steady))
    N, V, M = (_of(group, f"{quantity}_{part}")[at] for part in ("axial_force", "shear_force", "bending_moment"))
    V, M = (of.reshape(len(of), -1) for of in (V, M))
    inside, before, behind = (_inside(group, name, at, M.shape[1]) for name in (_LOADED, *_SHEARED))
    axes = ("y", "z") if V.shape[1] == 2 else ("z",) if member.weak else ("y",)
    along = {"y": "V_z", "z": "V_y"}
    steady[:, 0] = _between(N)
    middle = f"{quantity}_axial_force_middle"
    if middle in group.variables and np.isfinite(sides := _of(group, middle)[at]).all():
        halves = (N[0], 2.0 * sides[0] - N[0]), (2.0 * sides[1] - N[1], N[1])
        first, second = (_between(np.array(half)) for half in halves)
        steady[:, 0] = np.where(STATIONS < 0.5, first, np.where(STATIONS > 0.5, second, np.minimum(first, second)))
    for i, axis in enumerate(axes):
        steady[:, FORCES.index(f"M_{axis}")] = _between(M[:, i]) + inside[:, i]
        sides = _between(V[:, i]) + before[:, i], _between(V[:, i]) + behind[:, i]
        steady[:, FORCES.index(along[axis])] = np.where(np.abs(sides[0]) >= np.abs(sides[1]), *sides)
    return ForcesAlong(STATIONS, steady, np.zeros_like(steady))


def _inside(group: Group, name: str, at: int, axes: int) -> np.ndarray:
    """What loads inside a member add at `STATIONS`, (stations, axes); 0 if the archive does not have it."""
    return (
        _of(group, name)[at].reshape(STATIONS.size, axes)
        if name in group.variables
        else np.zeros((STATIONS.size, axes))
    )


def _between(ends: np.ndarray) -> np.ndarray:
    return np.asarray(ends[0] + STATIONS * (ends[1] - ends[0]))


def _worked(followed: Followed) -> WorkedCheck:
    member = followed.member
    return WorkedCheck(
        member=member.name,
        group=followed.history,
        kind=member_kind(member.name),
        section=member.plastic.section.name,
        material=f"f_y = {member.plastic.fy / 1e6:.4g} MPa",
        length=0.0,
        check=followed.check,
        clause=followed.clause,
        utilisation=followed.archived,
        combination="",
        number=0,
        steps=followed.steps,
    )


def _calculation(followed: Followed, at: str) -> Table:
    found = _worked(followed)
    met = "met" if followed.archived <= 1.0 else "not met"
    notes = (
        []
        if followed.steps
        else [
            f"the calculation from these forces gives {significant(followed.found)}: the archive is of another "
            "version, or the section of class 4"
        ]
    )
    notes.append(f"utilisation {significant(finite(followed.archived))} at {at}: {met} ({followed.clause})")
    return WORKED.of(followed.steps, whose=f"{found.group}: {found.member}, {found.check}", found=found, notes=notes)


WORKED = TableSpec[Step](
    "member_use_in_numbers",
    "{found.group}: {found.member}, {found.kind} {found.section}, {found.material}: {found.check}",
    CALCULATION.columns,
    keys=3,
    each="Worked calculations of checks",
)
