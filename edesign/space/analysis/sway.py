"""Sway stability of a building under vertical loads, EN 1993-1-1:2005, 5.2 and 5.3: alpha_cr and sway imperfections.

alpha_cr is the least factor of the loads at which the building sways: an eigenvalue of the whole frame, in which
columns bow between their nodes too (P-small-delta). A column near its own buckling load gives way to the sway, and
leans on the others. A shape in which columns bow and floors hardly move is that of members, which 6.3 checks; it cannot
be mistaken for sway (docs/theory/sway_stability.md).

The loads find their way to the ground without braces (EN 1998-1, 6.7.2(1)P); what holds them upright has its braces.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from edesign.codes.ec3.imperfections import AMPLIFICATION, FIRST_ORDER, initial_sway, sway_amplification
from edesign.codes.ec8.analysis.modal_combination import LARGE_MODE
from edesign.codes.en1990.combinations import Combination
from edesign.codes.rule_check import RuleCheck, at_least
from edesign.core.space import SpaceModel
from edesign.core.space_buckling import SETTLED, BucklingShapes, buckling_shapes
from edesign.core.space_modes import SpaceModes
from edesign.space.analysis.effects import Effects
from edesign.space.analysis.response import STATIONS, StaticResponse
from edesign.space.structure.frame import AXES, Axis, SpaceFrame
from edesign.space.structure.load_cases import on_nodes
from edesign.space.structure.model import TENSION_ONLY_SHARE

STABLE = "EN 1993-1-1, 5.2.2(6)"
"""Clause of the criterion on alpha_cr."""
COUNTED = (AMPLIFICATION - 1.0) / (FIRST_ORDER - 1.0)
"""Sum of the shares of sway at which a shape decides. A share e with the factor alpha adds e / (alpha - 1) to the
effects of sway: less than this sum adds less than 1 / (10 - 1), which 5.2.1(3) neglects, if alpha is at least 3."""


@dataclass(frozen=True)
class SwayStability:
    """Sway stability under the persistent combinations.

    Attributes:
        combinations: the persistent combinations, without imperfections.
        alpha_cr: (n_combinations, 3) factors of sway along x, along y, and of twist (infinite: none).
        initial_sway: (n_combinations, 2) phi along x and y.
        amplification: (n_combinations, 2) 1 / (1 - 1/alpha_cr) of the sway effects along x and y; alpha_cr of twist
            counts for both, as forces that act beside the centre of rotation twist the floors.
        cases: names of the load cases that imperfections make: `S_x`, `S_y`, and `P_Delta` where gravity sways.
        internal: (n_cases, n_members, n_stations, 6) their effects, with amplification, as in `StaticResponse`.
        rows: the combinations, and behind them those with imperfections.
    """

    combinations: tuple[Combination, ...]
    alpha_cr: np.ndarray
    initial_sway: np.ndarray
    amplification: np.ndarray
    cases: tuple[str, ...]
    internal: np.ndarray
    rows: tuple[Combination, ...]

    def added(self, effects: Effects) -> Effects:
        """Return effects of load cases with those of the imperfections."""
        if not self.cases:
            return effects
        static = np.concatenate([effects.static, self.internal])
        return replace(effects, cases=(*effects.cases, *self.cases), static=static)


class SwayAnalysis:
    """Finds the sway stability of a building, whatever sections it has.

    Args:
        frame: nodes, members and loads; sections may change from call to call.
        imperfections: whether sway imperfections act in persistent combinations.
    """

    def __init__(self, frame: SpaceFrame, imperfections: bool) -> None:
        self._imperfections = imperfections
        lowest = [place for place, number in enumerate(frame.columns) if frame.storey[number] == frame.held]
        of_frames: dict[str, list[int]] = {}
        for place in lowest:
            for name in frame.members[frame.columns[place]].frame:
                of_frames.setdefault(name, []).append(place)
        self._rows: dict[
            Axis, list[np.ndarray]
        ] = {  # columns of the lowest storey that sways, as places among columns, in each plane frame along an axis
            axis: [np.array(row) for name, row in of_frames.items() if name.startswith(axis.upper())] for axis in AXES
        }
        self._beside_links = _beside_links(frame)
        down = -sum(on_nodes(frame, case)[:, 2] for case in frame.cases.values())
        loaded = np.where(frame.level_of_nodes > frame.held, np.maximum(down, 0.0), 0.0)
        self._mass = loaded if (loaded[frame.node_mass == 0.0] > 0.0).any() else None

    def stability(
        self,
        model: SpaceModel,
        frame: SpaceFrame,
        modes: SpaceModes,
        static: StaticResponse,
        combinations: Sequence[Combination],
        least: bool = False,
    ) -> SwayStability:
        """Return the sway stability under persistent combinations.

        K + alpha K_G loses its definiteness the later, the less columns are compressed. Where the largest compression
        of each column in any combination leaves alpha_cr above 10, so does every combination, and amplifies nothing.

        Args:
            model: that resists horizontal forces, with its braces.
            frame: with the sections of the members.
            modes: all natural modes of the model.
            static: effects of the load cases.
            least: whether the factors under the largest compression stand for those of all combinations, if they are
                above 10.
        """
        mass = frame.node_mass
        if self._mass is not None:  # some loads hang on nodes without mass, which modes leave at rest
            mass, modes = self._mass, model.modes(self._mass)
        factors = np.array([[row.static.get(case, 0.0) for case in static.names] for row in combinations])
        N = static.internal[:, :, STATIONS.size // 2, 0]
        compression = -factors @ (N[:, frame.columns] + N @ self._beside_links.T)
        axial = np.zeros((len(combinations), len(frame.members)))
        axial[:, frame.columns] = -compression
        alpha_cr, levels = np.zeros((len(combinations), 3)), frame.level_of_nodes
        if least:
            alpha_cr[:] = critical_factors(model, modes, axial.min(axis=0), mass, levels)
        if alpha_cr.min() < FIRST_ORDER:
            alpha_cr[:] = [critical_factors(model, modes, of, mass, levels) for of in axial]
        counted = np.clip(np.minimum(alpha_cr[:, :2], alpha_cr[:, 2:]), AMPLIFICATION, None)  # floors twist, too
        amplification = np.array([[sway_amplification(float(of)) for of in row] for row in counted])
        phi = np.array([[self._initial_sway(frame, of, axis) for axis in AXES] for of in compression])
        found = SwayStability(
            tuple(combinations), alpha_cr, phi, amplification, (), np.zeros(0), rows=tuple(combinations)
        )
        if not self._imperfections:
            return found
        drift = self._gravity_drift(frame, static, factors)
        return self._with_imperfections(found, model, frame, compression, drift)

    def _initial_sway(self, frame: SpaceFrame, compression: np.ndarray, axis: Axis) -> float:
        """Return phi of one direction; of its rows of columns that with the fewest counts (5.3.2(3))."""
        rows = (compression[row] for row in self._rows[axis])
        fewest = min(int((row >= 0.5 * row.mean()).sum()) for row in rows)
        return initial_sway(float(frame.heights[-1]), max(fewest, 1))

    def _gravity_drift(self, frame: SpaceFrame, static: StaticResponse, factors: np.ndarray) -> np.ndarray:
        """Return by how much columns lean under combinations, (n_combinations, n_columns, 2) along x and y, rad."""
        start, end = (nodes[frame.columns] for nodes in frame.ends)
        moved = static.displacements[:, end, :2] - static.displacements[:, start, :2]
        return np.asarray(np.tensordot(factors, moved, 1) / frame.length[frame.columns, None])

    def _with_imperfections(
        self, found: SwayStability, model: SpaceModel, frame: SpaceFrame, compression: np.ndarray, drift: np.ndarray
    ) -> SwayStability:
        """Return the same with the effects of N phi at both ends of each column (5.3.2(7)) and of their amplification.

        Where effects of second order count, so do those of the sway that the vertical loads alone make (5.2.2(5)B).
        """
        start, end = (nodes[frame.columns] for nodes in frame.ends)
        cases: list[str] = []
        leans: list[np.ndarray] = []  # (n_columns, 2) N and, in its place, the slope: horizontal forces of columns
        rows = list(found.rows)
        for number, row in enumerate(found.combinations):
            N, grown = compression[number, :, None], found.amplification[number]
            mark = str(number + 1) if len(found.combinations) > 1 else ""
            steady, name = {}, row.name
            if (grown > 1.0).any():
                steady[f"P_Delta{mark}"] = 1.0
                name += f" + P_Delta{mark}"
                leans.append(N * drift[number] * np.where(grown > 1.0, grown, 0.0))
            of_axes = {
                f"S_{axis}{mark}": N * phi
                for axis, phi in zip(AXES, np.diag(found.initial_sway[number] * grown), strict=True)
            }
            leans += of_axes.values()
            cases += [*steady, *of_axes]
            for case in of_axes:
                for sign, text in ((1.0, "+"), (-1.0, "-")):
                    acting = {**row.static, **steady, case: sign}
                    rows.append(replace(row, name=f"{name} {text} {case}", static=acting))
        nodal = np.zeros((len(cases), len(frame.node_names), 6))
        for forces, lean in zip(nodal, leans, strict=True):
            np.add.at(forces[:, :2], end, lean)
            np.add.at(forces[:, :2], start, -lean)
        internal = model.internal(model.static(nodal).end_forces, STATIONS)
        alone = np.where(frame.in_compression, 1.0, 1.0 / TENSION_ONLY_SHARE)  # as under the seismic action
        return replace(found, cases=tuple(cases), internal=internal * alone[:, None, None], rows=tuple(rows))


def _beside_links(frame: SpaceFrame) -> np.ndarray:
    """Return what braces beside seismic links, which carry vertical loads, add to columns, (n_columns, n_members).

    It is the vertical component of a unit of their force, on the column of their storey that ends where they end.
    """
    found = np.zeros((frame.columns.size, len(frame.members)))
    ends = {
        (frame.storey[number], at, node): place
        for place, number in enumerate(frame.columns)
        for at, node in enumerate((frame.members[number].start, frame.members[number].end))
    }
    for number, member in enumerate(frame.members):
        if member.kind == "brace" and member.eccentric:
            rise = frame.coordinates[member.end, 2] - frame.coordinates[member.start, 2]
            for at, node in enumerate((member.start, member.end)):
                if (place := ends.get((frame.storey[number], at, node))) is not None:
                    found[place, number] = rise / frame.length[number]
    return found


def critical_factors(
    model: SpaceModel, modes: SpaceModes, axial: np.ndarray, mass: np.ndarray, levels: np.ndarray
) -> tuple[float, float, float]:
    """Return alpha_cr along x, along y and of twist; infinite where nothing sways so under the forces.

    Of the strain energy of a buckling shape a share e moves the floors; the rest bends members between floors that
    stand still. Shapes with e near 1 sway, with e near 0 they are those of members. Where members are about to buckle
    together with a storey, its sway is spread over several shapes. The shape that decides is therefore the one at which
    the sum of e over the shapes up to it reaches `COUNTED`; see `_of_all` for those before it.

    A shape belongs to a direction if at least 5 % of the mass that it moves goes there with the floors. All others,
    twist above all, are looked at for themselves. A direction without any has the least of the others.

    Args:
        modes: all its natural modes, of generalised mass 1: together all shapes under horizontal forces.
        axial: (n_members,) N, tension positive.
        mass: (n_nodes,) kg, that of the modes.
        levels: (n_nodes,) floor of each node.

    Source: EN 1993-1-1:2005, 5.2.1(3), Eq. 5.1: K + alpha K_G singular.
    """
    weights = (levels[:, None] == np.unique(levels)) * mass[:, None]
    floors = weights[:, weights.any(axis=0)]
    floors = floors / np.sqrt(floors.sum(axis=0))  # amplitudes of floors from the mean of their nodes
    of_floors = np.einsum("knd,nf->kfd", modes.displacements[:, :, :2], floors)

    def groups(found: BucklingShapes) -> list[tuple[int | None, np.ndarray]]:
        """Return the shape that decides, and the shares e of the shapes that count, along x, along y, and of others."""
        moved = found.of_start / modes.omega
        going = (np.tensordot(moved, of_floors, 1) ** 2).sum(axis=1)
        with np.errstate(invalid="ignore"):
            x, y = going.T / (moved**2).sum(axis=1) >= LARGE_MODE
        e = np.where(np.isfinite(found.factor), (found.of_start**2).sum(axis=1), 0.0)
        counted = []
        for of in (x, y, ~(x | y)):
            share = np.where(of, e, 0.0)
            lost = np.cumsum(share) >= COUNTED
            counted.append((int(lost.argmax()) if lost.any() else None, share))
        return counted

    def wanted(found: BucklingShapes) -> list[int]:
        numbers: set[int] = set()
        for number, share in groups(found):
            if number is not None:
                part = _parts(found.factor, share, number)
                numbers |= {number, *np.flatnonzero(part > SETTLED * part.sum()).tolist()}
        return sorted(numbers)

    found = buckling_shapes(model, axial, modes.shapes / modes.omega[:, None], wanted, FIRST_ORDER)
    x, y, twist = (
        np.inf if number is None else _of_all(found.factor, share, number) for number, share in groups(found)
    )
    least = min(x, y, twist)
    return x if np.isfinite(x) else least, y if np.isfinite(y) else least, twist


def _parts(factor: np.ndarray, share: np.ndarray, number: int) -> np.ndarray:
    """What shapes add to the effects of sway, e / (alpha - 1), up to the one that decides, which has all the rest of e.

    Shapes with a factor up to 1 are of members that buckle, which 6.3 does not allow; they add nothing here.
    """
    e, alpha = share[: number + 1].copy(), factor[: number + 1]
    e[number] = 1.0 - e[:number].sum()
    return np.divide(e, alpha - 1.0, out=np.zeros(number + 1), where=alpha > 1.0)


def _of_all(factor: np.ndarray, share: np.ndarray, number: int) -> float:
    """The factor of one shape that would amplify sway as the deciding shape and those before it do together."""
    if factor[number] <= 1.0:
        return float(factor[number])
    return 1.0 + 1.0 / float(_parts(factor, share, number).sum())


def sway_criteria(stability: SwayStability, imperfections: bool) -> list[RuleCheck]:
    """Return whether amplified effects of first order are enough: alpha_cr of each direction is at least 3.

    Shapes that twist have a criterion of their own where they are the first. Without imperfections the values inform
    only: second-order effects are then left to the buckling lengths (5.2.2(8)).

    Args:
        stability: of the building.
        imperfections: whether they are among the actions.

    Source: EN 1993-1-1:2005, 5.2.2(5)B and (6).
    """
    x, y, twist = stability.alpha_cr.T
    whose = [(f"direction {axis}", of) for axis, of in zip(AXES, (x, y), strict=True)]
    if (twist < np.minimum(x, y)).any():
        whose.append(("twist", twist))
    found = []
    for name, of in whose:
        worst = int(of.argmin())
        value, detail = float(of[worst]), stability.combinations[worst].name
        if imperfections:
            text = f"alpha_cr, {name}; below 10 sway effects are amplified, below 3 analysis of second order"
            found.append(at_least(STABLE, text, AMPLIFICATION, value, detail))
        else:
            found.append(RuleCheck(STABLE, f"alpha_cr, {name}; without imperfections", None, value, "", None, detail))
    return found


def sway_notes(stability: SwayStability) -> list[str]:
    """Return what an engineer should know of the sway stability, a sentence each.

    Args:
        stability: of the building.
    """
    found = []
    twist = float(stability.alpha_cr[:, 2].min())
    for number, axis in enumerate(AXES):
        along = float(stability.alpha_cr[:, number].min())
        alpha_cr, what = min((along, f"alpha_cr along {axis}"), (twist, f"for sway along {axis}, alpha_cr of twist"))
        if alpha_cr >= FIRST_ORDER:
            continue
        if stability.cases:
            factor = float(stability.amplification[:, number].max())
            found.append(
                f"{what} is {alpha_cr:.1f}, below 10: sway effects of the persistent combinations are multiplied by "
                f"{factor:.2f} (EN 1993-1-1, 5.2.2(5)B)"
            )
        else:
            found.append(
                f"{what} is {alpha_cr:.1f}, below 10: without imperfections, effects of second order must be in the "
                "buckling lengths (EN 1993-1-1, 5.2.2(8))"
            )
    return found
