"""Sway stability of a building under vertical loads, EN 1993-1-1:2005, 5.2 and 5.3: alpha_cr and sway imperfections.

alpha_cr is the least factor of the loads at which the building sways. The shapes among which it is sought are those
that horizontal forces at the nodes with mass give the structure: all combinations of its natural modes. A column that
buckles between its nodes, which stand still, is none of them, and cannot be mistaken for sway. The geometric stiffness
is that of the bent members, so that the factor is that of the frame and not of the storey formula, which leaves out the
bending of columns under their own load and is up to 22 % too large (feet on hinges).

The loads find their way to the ground without braces (EN 1998-1, 6.7.2(1)P); what holds them upright has its braces.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
import scipy

from edesign.codes.criterion import Criterion, at_least
from edesign.codes.ec3.imperfections import AMPLIFICATION, FIRST_ORDER, initial_sway, sway_amplification
from edesign.codes.ec8.modal_combination import LARGE_MODE
from edesign.codes.en1990.combinations import Combination
from edesign.core.space import PROPERTIES, SpaceModel
from edesign.core.space_modes import SpaceModes
from edesign.space.analysis.effects import Effects
from edesign.space.analysis.response import STATIONS, StaticResponse
from edesign.space.structure.frame import AXES, Axis, SpaceFrame
from edesign.space.structure.load_cases import on_nodes
from edesign.space.structure.model import TENSION_ONLY_SHARE

STABLE = "EN 1993-1-1, 5.2.2(6)"
"""Clause of the criterion on alpha_cr."""
_MOMENTS = [4, 10, 5, 11]  # M_y at both ends, M_z at both ends, in end forces


@dataclass(frozen=True)
class SwayStability:
    """Sway stability under the persistent combinations.

    Attributes:
        combinations: the persistent combinations, without imperfections.
        alpha_cr: (n_combinations, 3) least factor of shapes that move along x, along y, and of all shapes.
        initial_sway: (n_combinations, 2) phi along x and y.
        amplification: (n_combinations, 2) 1 / (1 - 1/alpha_cr) of the sway effects along x and y.
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
        """Return effects of load cases with those of the imperfections.

        Args:
            effects: of the load cases.
        """
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
        lowest = [place for place, number in enumerate(frame.columns) if frame.storey[number] == 0]
        of_frames: dict[str, list[int]] = {}
        for place in lowest:
            for name in frame.members[frame.columns[place]].frame:
                of_frames.setdefault(name, []).append(place)
        self._rows: dict[
            Axis, list[np.ndarray]
        ] = {  # columns of the lowest storey, as places among columns, in each plane frame along an axis
            axis: [np.array(row) for name, row in of_frames.items() if name.startswith(axis.upper())] for axis in AXES
        }
        down = -sum(on_nodes(frame, case)[:, 2] for case in frame.cases.values())
        loaded = np.where(frame.level_of_nodes > 0, np.maximum(down, 0.0), 0.0)
        self._mass = loaded if (loaded[frame.node_mass == 0.0] > 0.0).any() else None

    def stability(
        self,
        model: SpaceModel,
        frame: SpaceFrame,
        modes: SpaceModes,
        properties: np.ndarray,
        static: StaticResponse,
        combinations: Sequence[Combination],
    ) -> SwayStability:
        """Return the sway stability under persistent combinations.

        Args:
            model: that resists horizontal forces, with its braces.
            frame: with the sections of the members.
            modes: all natural modes of the model.
            properties: (n_members, 8) of the members in the model.
            static: effects of the load cases.
            combinations: persistent ones.
        """
        mass = frame.node_mass
        if self._mass is not None:  # some loads hang on nodes without mass, which modes leave at rest
            mass, modes = self._mass, model.modes(self._mass)
        factors = np.array([[row.static.get(case, 0.0) for case in static.names] for row in combinations])
        compression = -factors @ static.internal[:, frame.columns, STATIONS.size // 2, 0]
        geometric = geometric_stiffness(frame, modes, properties, compression)
        alpha_cr = np.array([critical_factors(modes, of, float(mass.sum())) for of in geometric])
        counted = np.clip(alpha_cr[:, :2], AMPLIFICATION, None)
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
        return initial_sway(float(frame.levels[-1]), max(fewest, 1))

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


def geometric_stiffness(
    frame: SpaceFrame, modes: SpaceModes, properties: np.ndarray, compression: np.ndarray
) -> np.ndarray:
    """Return what compression of the columns takes from the stiffness in the modes, (n_combinations, n_modes, n_modes).

    It is N times the integral of the products of slopes along each column: of its chord, and of the bent column from
    its chord. The latter follows from the moments at the ends. The end sections turn from the chord by
    t_1 = (L/3EI + 1/GA_sL) M_1 + (-L/6EI + 1/GA_sL) M_2, t_2 likewise, and with phi = 12 EI / (G A_s L2)

        integral = L [(s - 1/4) (t_1 + t_2)2 + (t_1 - t_2)2 / 12],  s = (1.2 + 2 phi + phi2) / (4 (1 + phi)2)

    Args:
        frame: places of the members.
        modes: natural modes.
        properties: (n_members, 8) in the order of `PROPERTIES`.
        compression: (n_combinations, n_columns) N.

    Source: Przemieniecki (1968), chapter 15, with the shear deformation of Timoshenko's beam.
    """
    columns = frame.columns
    start, end = (nodes[columns] for nodes in frame.ends)
    L, of = frame.length[columns], dict(zip(PROPERTIES, properties[columns].T, strict=True))
    apart = modes.displacements[:, end, :2] - modes.displacements[:, start, :2]
    moments = modes.end_forces[:, columns[:, None], _MOMENTS]
    slopes, weights = [apart[:, :, 0], apart[:, :, 1]], [1.0 / L] * 2
    for number, (inertia, area) in enumerate(((of["I_y"], of["A_z"]), (of["I_z"], of["A_y"]))):
        EI, GA = of["E"] * inertia, of["G"] * area
        shear = np.divide(1.0, GA * L, out=np.zeros_like(L), where=GA > 0.0)
        phi = 12.0 * EI * shear / L
        square = (1.2 + 2.0 * phi + phi**2) / (4.0 * (1.0 + phi) ** 2)
        one, other = moments[:, :, 2 * number], moments[:, :, 2 * number + 1]
        slopes += [(L / (6.0 * EI) + 2.0 * shear) * (one + other), L / (2.0 * EI) * (one - other)]
        weights += [L * (square - 0.25), L / 12.0]
    every, weight = np.concatenate(slopes, axis=1), np.array(weights)
    return np.stack([(every * (weight * N).ravel()) @ every.T for N in compression])


def critical_factors(modes: SpaceModes, geometric: np.ndarray, mass: float) -> tuple[float, float, float]:
    """Return alpha_cr along x, along y and of all shapes; infinite where nothing sways under the loads.

    A shape belongs to a direction if at least 5 % of the mass moves with it there, as a mode that counts in EN 1998-1,
    4.3.3.3.1(3); without any of these all shapes do.

    Args:
        modes: natural modes, of generalised mass 1.
        geometric: (n_modes, n_modes) by `geometric_stiffness`.
        mass: that moves, kg.

    Returns:
        alpha_cr along x, along y, and of all shapes.

    Source: EN 1993-1-1:2005, 5.2.1(3), Eq. 5.1: K - alpha K_G singular. In natural modes K is diagonal, omega2.
    """
    scaled = geometric / np.outer(modes.omega, modes.omega)
    eigenvalues, shapes = scipy.linalg.eigh(0.5 * (scaled + scaled.T), check_finite=False, driver="evd")
    sways = eigenvalues > 0.0
    if not sways.any():
        return np.inf, np.inf, np.inf
    eigenvalues, shapes = eigenvalues[sways], shapes[:, sways] / modes.omega[:, None]
    share = (modes.participation[:, :2].T @ shapes) ** 2 / ((shapes**2).sum(axis=0) * mass)
    least = float(1.0 / eigenvalues[-1])
    x, y = (float(1.0 / eigenvalues[moves][-1]) if moves.any() else least for moves in share >= LARGE_MODE)
    return x, y, least


def sway_criteria(stability: SwayStability, imperfections: bool) -> list[Criterion]:
    """Return whether amplified effects of first order are enough: alpha_cr of each direction is at least 3.

    Shapes that twist have a criterion of their own where they are the first. Without imperfections the values inform
    only: second-order effects are then left to the buckling lengths (5.2.2(8)).

    Args:
        stability: of the building.
        imperfections: whether they are among the actions.

    Source: EN 1993-1-1:2005, 5.2.2(5)B and (6).
    """
    x, y, least = stability.alpha_cr.T
    whose = [(f"direction {axis}", of) for axis, of in zip(AXES, (x, y), strict=True)]
    if (least < np.minimum(x, y)).any():
        whose.append(("twist", least))
    found = []
    for name, of in whose:
        worst = int(of.argmin())
        value, detail = float(of[worst]), stability.combinations[worst].name
        if imperfections:
            text = f"alpha_cr, {name}; below 10 sway effects are amplified, below 3 analysis of second order"
            found.append(at_least(STABLE, text, AMPLIFICATION, value, detail))
        else:
            found.append(Criterion(STABLE, f"alpha_cr, {name}; without imperfections", None, value, "", None, detail))
    return found


def sway_notes(stability: SwayStability) -> list[str]:
    """Return what an engineer should know of the sway stability, a sentence each.

    Args:
        stability: of the building.
    """
    found = []
    for number, axis in enumerate(AXES):
        alpha_cr = float(stability.alpha_cr[:, number].min())
        if alpha_cr >= FIRST_ORDER:
            continue
        if stability.cases:
            factor = float(stability.amplification[:, number].max())
            found.append(
                f"alpha_cr along {axis} is {alpha_cr:.1f}, below 10: sway effects of the persistent combinations are "
                f"multiplied by {factor:.2f} (EN 1993-1-1, 5.2.2(5)B)"
            )
        else:
            found.append(
                f"alpha_cr along {axis} is {alpha_cr:.1f}, below 10: without imperfections, effects of second order "
                "must be in the buckling lengths (EN 1993-1-1, 5.2.2(8))"
            )
    return found
