"""Use of columns, beams and braces by the forces of each step: the largest is found while the run goes on.

No history is kept for it. Of several steps together the peaks of each force bound the use. Where they pass the largest
use so far, a sum bounds it in each step; where that does as well, the clauses follow.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence

import numpy as np

from edesign.archive.dataset import Group
from edesign.frame.frame_model import FrameModel
from edesign.frame.sections.section_class import section_class
from edesign.project.analysis_file import AnalysisFile
from edesign.space.analysis.response import STATIONS
from edesign.space.checks.member_checks import LARGEST_CLASS
from edesign.study.results.checked_members import CheckedMember, checked_members, loads_inside
from edesign.study.results.collectors import Collectors
from edesign.study.results.coordinates import bending_members
from edesign.study.results.dampers import DamperSpeeds
from edesign.study.results.largest_use import Buckling, Forces, Largest, Sections
from edesign.study.results.moment_envelope import MomentEnvelope
from edesign.study.results.recording import SINGLE, Quantity, by_axis, coordinate
from edesign.study.results.supports import SupportExtremes
from edesign.study.results.watch import Observer, StepWatch

_COMPRESSION = np.array([1.0, -1.0])  # forces on both ends act inwards
_INSIDE = -_COMPRESSION
"""Internal forces over those on the ends: positive on the face that looks to the end of the member."""
_WHOLE = 1.0 - 1e-9
"""Load factor of gravity analyses from which all loads act, but for rounding."""
_LARGEST = "the largest use of the brace, positive in tension; of a pair of which one pulls at a time that of both"
_PARTS = (("axial_force", "N", "N"), ("shear_force", "N", "V"), ("bending_moment", "N*m", "M"))


class MemberUse:
    """The largest use of each column and beam of a frame or building over the steps of a run.

    `section_use` is that of each end by N, V and M of one step: shear alone, and bending and axial force with what
    shear leaves. Hardening may lead beyond 1. `member_use` is that against buckling, as the elastic design of a
    building has it, by the compression and the largest moments of one step; a file without `design` has none, and its
    partial factor is 1. M_b,Rd is that of a uniform moment, unless the flange is held. Sections have the class that
    they have under the compression of the step; of class 4 the use is infinite. Members whose section has no class, or
    whose steel does not yield, are not judged, and have 0. The forces of the step are kept with each largest use.

    With `across` columns that belong to a bracing across are judged once more, with the compression that the seismic
    action across adds: `across_use` is the larger one of both uses.

    Args:
        across: that compression of columns, by name, N; None: all members by the forces of the run alone.

    Raises:
        InputError: the steel or section of a member is not known to the clauses.

    Source: EN 1993-1-1:2005, 6.2.6; 6.2.8 and 6.2.10; 6.2.9.1(2), Eq. 6.31, and (6), Eq. 6.41, or 6.2.1(7), Eq. 6.2,
        of class 1 and 2; 6.2.9.2, Eq. 6.42, of class 3. 6.3.1 to 6.3.3, Eqs. 6.46, 6.54, 6.61 and 6.62.
    """

    needs = tuple(f"member_{name}" for name, _, _ in _PARTS)
    own: tuple[Quantity, ...] = ()

    def __init__(self, file: AnalysisFile, frame: FrameModel, across: Mapping[str, float] | None = None) -> None:
        names = [member.name for member in bending_members(frame)]
        found = checked_members(file, names)
        self._judged, members = found.judged, found.members
        self._added: np.ndarray | None = None
        if across is not None:
            self._judged = self._judged & np.array([name in across for name in names], dtype=bool)
            members = tuple(member for member in members if member.name in across)
            self._added = np.array([across[member.name] for member in members])
        self._in_space = frame.model.dimension == 3
        self._axes = len(frame.bending)
        self._dims = by_axis(frame, "member", "end")
        self._weak = np.array([member.weak for member in members], dtype=bool)
        self._ends: Sections | None = None
        if members:  # both ends of each
            sections = Sections(members, (True, self._in_space))
            self._ends = sections.of(np.repeat(np.arange(len(members)), 2))
        self._weak_ends = np.repeat(self._weak, 2)
        width = 1 + 2 * self._axes
        self._section_use = Largest((len(members), 2), width)
        self._of_members = Buckling(members, (True, False)) if found.stability and members else None
        self._member_use = Largest((len(members),), 2 * width + 2)
        self._load_moments = np.zeros((len(names), STATIONS.size, self._axes))
        self._load_shears = np.zeros((2, *self._load_moments.shape))
        if self._of_members is not None:
            self._load_moments, self._load_shears = loads_inside(file, frame, names)
        self._collectors = Collectors(frame)
        if self._collectors.quantity is not None and across is None:  # it is watched once, for beams
            self.own = (self._collectors.quantity,)
            self.needs = (*self.needs, self.own[0].name)
        self._collecting = np.array([names.index(beam.name) for beam in self._collectors.beams], dtype=int)
        shape = len(self._collectors.beams), 2
        self._axial_max, self._axial_min = np.full(shape, -np.inf), np.full(shape, np.inf)
        jumping = self._collecting[self._collectors.jumping]
        self._jumps = np.flatnonzero(self._judged[jumping])  # among beams whose axial force jumps in their middle
        self._jumping = (np.cumsum(self._judged) - 1)[jumping[self._jumps]]  # their numbers among judged members
        self._loads = self._load_moments[self._judged]
        self._load_tops = np.abs(self._loads).max(axis=1)

    def see(self, abscissas: np.ndarray, values: Mapping[str, np.ndarray]) -> None:
        """See further steps; see `Observer`. Of most of them the peaks of each force show that they are not needed."""
        names = [f"member_{name}" for name, _, _ in _PARTS]
        every = [values[name].reshape(len(abscissas), self._judged.size, 2, -1) for name in names]
        middle = np.zeros((len(abscissas), 0, 2))
        if self.own:
            every[0], middle = self._with_collected(every[0], values[self.own[0].name])
        if self._ends is None:
            return
        if not self._judged.all():
            every = [of[:, self._judged] for of in every]
        if self._added is not None:
            every[0] = every[0] + self._added[:, None, None] * _COMPRESSION[:, None]
        peaks = [np.maximum(of.max(axis=0), -of.min(axis=0)) for of in every]
        self._see_ends(abscissas, [of.reshape(len(of), -1, of.shape[3]) for of in every], peaks)
        if self._of_members is not None:
            self._see_members(abscissas, every, peaks, middle)

    def _with_collected(self, axial: np.ndarray, pulls: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Axial forces on the ends of all members, (n, m, 2, 1), and in the middle of judged beams where they jump."""
        ends, middle = self._collectors.axial(pulls)
        found = axial[..., 0].copy()
        beyond = 0.5 * (found[:, self._collecting] @ _INSIDE)  # in the middle by the model
        found[:, self._collecting] += ends * _INSIDE
        of_beams = found[:, self._collecting]
        np.maximum(self._axial_max, of_beams.max(axis=0), out=self._axial_max)
        np.minimum(self._axial_min, of_beams.min(axis=0), out=self._axial_min)
        return found[..., None], (middle + beyond[:, self._collectors.jumping, None])[:, self._jumps]

    def _see_ends(self, abscissas: np.ndarray, every: Sequence[np.ndarray], peaks: Sequence[np.ndarray]) -> None:
        assert self._ends is not None
        N, _, M = every
        weak, largest = self._weak_ends, self._section_use
        of_N, of_V, of_M = (of.reshape(weak.size, -1) for of in peaks)
        peak = Forces(of_N[:, 0], *self._by_axis(of_M, weak), *self._shear(of_V, weak))
        per_N, per_M, reached = self._ceiling(self._ends, peak, weak)
        chosen = np.flatnonzero(of_N[:, 0] * per_N + (of_M * per_M).sum(axis=1) > largest.least(reached))
        if not chosen.size:
            return
        total = np.abs(_some(N[..., 0], chosen)) * per_N[chosen]
        for axis in range(self._axes):
            total += np.abs(_some(M[..., axis], chosen)) * per_M[chosen, axis]
        for rows, places in _largest_first(total, chosen, lambda: largest.least(reached)):
            forces = [of[rows, places] for of in every]
            about, ends = weak[places], self._ends.of(places)
            V_y_z = self._shear(np.abs(forces[1]), about)
            acting = Forces(
                forces[0][:, 0] * _COMPRESSION[places % 2], *self._by_axis(np.abs(forces[2]), about), *V_y_z
            )
            internal = np.concatenate(forces, axis=1) * _INSIDE[places % 2][:, None]
            largest.see(abscissas[rows], places, ends, acting, internal)

    def _see_members(
        self,
        abscissas: np.ndarray,
        every: Sequence[np.ndarray],
        peaks: Sequence[np.ndarray],
        middle: np.ndarray,
    ) -> None:
        assert self._of_members is not None
        N, _, M = every
        weak, largest, of_N, of_M = self._weak, self._member_use, peaks[0].max(axis=(1, 2)), peaks[2].max(axis=1)
        inner = np.zeros((len(abscissas), len(weak), 2)) if self._jumping.size else None
        if inner is not None:
            inner[:, self._jumping] = middle
            np.maximum(of_N, np.abs(inner).max(axis=(0, 2)), out=of_N)
        peak = Forces(of_N, *self._by_axis(of_M + self._load_tops, weak))
        per_N, per_M, reached = self._ceiling(self._of_members, peak, weak)
        inside = (self._load_tops * per_M).sum(axis=1)
        chosen = np.flatnonzero(of_N * per_N + (of_M * per_M).sum(axis=1) > largest.least(reached) - inside)
        if not chosen.size:
            return
        total = np.maximum(_some(N[:, :, 0, 0], chosen), -_some(N[:, :, 1, 0], chosen))
        np.maximum(total, 0.0, out=total)
        if inner is not None:
            np.maximum(total, -_some(inner, chosen).min(axis=2), out=total)
        total *= per_N[chosen]
        for axis in range(self._axes):
            start, end = (np.abs(_some(M[:, :, at, axis], chosen)) for at in range(2))
            total += np.maximum(start, end, out=start) * per_M[chosen, axis]
        for rows, places in _largest_first(total, chosen, lambda: largest.least(reached) - inside):
            forces = [of[rows, places] for of in every]
            tops, members = self._largest_moments(forces[2], places), self._of_members.of(places)
            compression = np.maximum(forces[0][:, 0, 0], -forces[0][:, 1, 0])
            internal = (np.concatenate(forces, axis=2) * _INSIDE[:, None]).reshape(len(rows), -1)
            beside = np.zeros((len(rows), 2)) if inner is None else inner[rows, places]
            compression = np.maximum(compression, -beside.min(axis=1))
            internal = np.concatenate([internal, beside], axis=1)
            acting = Forces(compression, *self._by_axis(tops, weak[places]))
            largest.see(abscissas[rows], places, members, acting, internal)

    def _ceiling(self, of: Sections, peak: Forces, weak: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Factors of N and of M by axis of the sum that the use does not pass, and what it may reach without them."""
        per_N, per_M_y, per_M_z, reached = of.ceiling(peak)
        both = (per_M_y, per_M_z) if self._in_space else (np.where(weak, per_M_z, per_M_y),)
        return per_N, np.stack(both, axis=1), reached

    def _by_axis(self, values: np.ndarray, weak: np.ndarray) -> tuple[np.ndarray, np.ndarray | None]:
        """Moments about y and z of moments by axis, (k, axes); of a plane frame each member has one of them."""
        if self._in_space:
            return values[:, 0], values[:, 1]
        values = values[:, 0]
        if not self._weak.any():
            return values, None
        return np.where(weak, 0.0, values), np.where(weak, values, 0.0)

    def _shear(self, values: np.ndarray, weak: np.ndarray) -> tuple[np.ndarray | None, np.ndarray | None]:
        """Shears along y and z: those that go with bending about z and y."""
        with_y, with_z = self._by_axis(values, weak)
        return with_z, with_y

    def _largest_moments(self, moments: np.ndarray, members: np.ndarray) -> np.ndarray:
        """The largest moments of members by axis, (k, axes), of those at their ends, (k, 2, axes), and loads inside."""
        tops = np.maximum(np.abs(moments[:, 0]), np.abs(moments[:, 1]))
        for axis in range(self._axes):
            at = np.flatnonzero(self._load_tops[members, axis] > 0.0)
            start, end = moments[at, 0, axis, None], moments[at, 1, axis, None]
            share = STATIONS[1:-1]
            inside = share * end - (1.0 - share) * start + self._loads[members[at], 1:-1, axis]
            tops[at, axis] = np.maximum(tops[at, axis], np.abs(inside).max(axis=1))
        return np.asarray(tops)

    def store(self, group: Group, abscissa: str, unit: str) -> None:
        """Add the largest uses, where they occur and the forces there to the group; see `Observer`."""
        if self.own:
            coordinate(group, "collector", [beam.name for beam in self._collectors.beams], "", "beam that collects")
            for which, of in (("max", self._axial_max), ("min", self._axial_min)):
                variable = group.variables.get(f"member_axial_force_{which}")
                if variable is not None:
                    variable.values[self._collecting] = of
        if self._ends is None:
            return
        if self._added is not None:
            use = np.full(self._judged.size, np.nan)
            use[self._judged] = np.maximum(self._section_use.use.max(axis=1), self._member_use.use)
            label = "largest use of the column with the compression of the seismic action across"
            group.add("across_use_max", ("member",), use, "1", label)
            return
        kinds: list[tuple[str, tuple[str, ...], Largest, str]] = [
            ("section_use", ("member", "end"), self._section_use, "N, V and M at the end of the member")
        ]
        if self._of_members is not None:
            kinds.append(("member_use", ("member",), self._member_use, "the member against buckling"))
        for name, dims, largest, what in kinds:
            whole = (self._judged.size, *largest.use.shape[1:])
            use, at = np.zeros(whole), np.full(whole, np.nan)
            use[self._judged], at[self._judged] = largest.use, largest.at
            group.add(f"{name}_max", dims, use, "1", f"use of {what}, largest value")
            group.add(f"{name}_at", dims, at, unit, f"{abscissa} of the largest use of {what}")
            forces = np.full((self._judged.size, 2, 1 + 2 * self._axes), np.nan)
            kept = largest.forces[..., : 2 * forces.shape[2]] if name == "member_use" else largest.forces
            forces[self._judged] = kept.reshape(-1, *forces.shape[1:])
            parts = forces[..., 0], forces[..., 1 : 1 + self._axes], forces[..., 1 + self._axes :]
            for (part, of_part, symbol), values in zip(_PARTS, parts, strict=True):
                shape = ("member", "end") if symbol == "N" else self._dims
                label = f"internal force {symbol} at the end of the member with the largest use of {what}"
                values = values.reshape(*values.shape[: len(shape)]).astype(SINGLE)
                group.add(f"{name}_{part}", shape, values, of_part, label)
        if self._of_members is not None and self._jumping.size:
            sides = np.full((self._judged.size, 2), np.nan)
            sides[np.flatnonzero(self._judged)[self._jumping]] = self._member_use.forces[self._jumping, -2:]
            label = (
                "axial force on both sides of the middle of the beam, where a damper pushes it, with its largest use"
            )
            group.add("member_use_axial_force_middle", ("member", "end"), sides.astype(SINGLE), "N", label)
        if self._of_members is not None and self._load_moments.any():
            coordinate(group, "station", STATIONS, "1", "place on the member over its length from the start")
            dims = (*by_axis_of(self._dims),)
            label = "moment that gravity loads inside add to the line between the moments at both ends"
            axes = ... if len(dims) == 3 else (..., 0)
            group.add("member_load_moment", dims, self._load_moments[axes].astype(SINGLE), "N*m", label)
            for side, shears in zip(("before", "behind"), self._load_shears, strict=True):
                label = f"shear that gravity loads inside add to the line between both ends, {side} points at the place"
                group.add(f"member_load_shear_{side}", dims, shears[axes].astype(SINGLE), "N", label)


def by_axis_of(dims: tuple[str, ...]) -> tuple[str, ...]:
    """Return dimensions with stations in the place of ends."""
    return tuple("station" if dim == "end" else dim for dim in dims)


def _some(values: np.ndarray, chosen: np.ndarray) -> np.ndarray:
    """Columns that are chosen."""
    return values if chosen.size == values.shape[1] else values.take(chosen, axis=1)


def _largest_first(
    total: np.ndarray, chosen: np.ndarray, least: Callable[[], np.ndarray]
) -> Iterator[tuple[np.ndarray, np.ndarray]]:
    """Rows and places where a sum over chosen places passes what it must: of each its largest, then those left."""
    yield total.argmax(axis=0), chosen
    rows, at = np.divmod(np.flatnonzero(total > least()[chosen]), chosen.size)
    if rows.size:
        yield rows, chosen[at]


class BraceUse:
    """The largest use of each brace of a frame or building over the steps of a run: N over N_pl,Rd or N_b,Rd.

    Of a pair of which one is in tension at a time, one takes the force of both, in tension. A brace of class 4 in
    compression has an infinite use.

    Source: EN 1993-1-1:2005, 6.2.3, Eq. 6.5; 6.3.1.1, Eq. 6.46. EN 1998-1:2004, 6.7.2(2)P.
    """

    needs: tuple[str, ...] = ("brace_axial_force",)
    own: tuple[Quantity, ...] = ()

    def __init__(self, file: AnalysisFile, frame: FrameModel) -> None:
        found = checked_members(file, [member.name for member in frame.of_kind("brace")])
        self._judged = found.judged
        self._share = np.array([member.share for member in found.members])
        self._per_tension = np.array([member.share / member.plastic.constants.N_Rd for member in found.members])
        self._per_compression = np.array([_per_compression(member) for member in found.members])
        count = len(found.members)
        self._use, self._at, self._force = np.zeros(count), np.full(count, np.nan), np.full(count, np.nan)

    def see(self, abscissas: np.ndarray, values: Mapping[str, np.ndarray]) -> None:
        """See further steps; see `Observer`."""
        (force,) = (values[name][:, self._judged] for name in self.needs)
        with np.errstate(invalid="ignore"):
            use = np.maximum(force * self._per_tension, np.nan_to_num(-force * self._per_compression, nan=0.0))
        rows = use.argmax(axis=0)
        places = np.arange(use.shape[1])
        more = np.flatnonzero(use[rows, places] > self._use)
        self._use[more] = use[rows[more], more]
        self._at[more], self._force[more] = abscissas[rows[more]], force[rows[more], more]

    def store(self, group: Group, abscissa: str, unit: str) -> None:
        """Add the largest uses, where they occur and the forces to the group; see `Observer`."""
        what = "the brace in tension or against buckling"
        for name, values, of, label in (
            ("max", self._use, "1", f"use of {what}, largest value"),
            ("at", self._at, unit, f"{abscissa} of the largest use of {what}"),
            ("axial_force", self._share * self._force, "N", f"axial force that the check takes with {_LARGEST}"),
        ):
            whole = np.full(self._judged.size, 0.0 if name == "max" else np.nan)
            whole[self._judged] = values
            group.add(f"brace_use_{name}", ("brace",), whole, of, label)


def _per_compression(member: CheckedMember) -> float:
    """Use of a brace over its compression, 1/N."""
    if not member.compressed:
        return 0.0
    steel, constants = member.plastic, member.plastic.constants
    if section_class(steel.section, steel.fy, -1.0, about_y=False).number > LARGEST_CLASS:
        return np.inf
    return 1.0 / min(constants.N_b_y_Rd, constants.N_b_z_Rd)


def gravity_watch(file: AnalysisFile, frame: FrameModel) -> StepWatch:
    """Return what watches a gravity analysis: the use of members under all of the loads, those inside them included.

    Raises:
        InputError: as `checked_members`.
    """
    return StepWatch(_uses(file, frame), start=_WHOLE)


def run_watch(file: AnalysisFile, frame: FrameModel) -> StepWatch:
    """Return what watches a run under gravity: uses of members, velocities of dampers, and reactions of supports.

    Raises:
        InputError: as `checked_members`.
    """
    observers = _uses(file, frame)
    if frame.model.dimension == 2 and bending_members(frame):
        observers.append(MomentEnvelope(file, frame))
    if frame.devices:
        observers.append(DamperSpeeds(frame))
    return StepWatch([*observers, SupportExtremes(frame)])


def _uses(file: AnalysisFile, frame: FrameModel) -> list[Observer]:
    found: list[Observer] = [MemberUse(file, frame)] if bending_members(frame) else []
    if across := getattr(getattr(file, "design", None), "across", None):
        found.append(MemberUse(file, frame, across))
    if frame.of_kind("brace") and getattr(file, "design", None) is not None:
        found.append(BraceUse(file, frame))
    return found
