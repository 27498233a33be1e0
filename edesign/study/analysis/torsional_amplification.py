"""How much more a building's column lines move by turns of its floors than a push of it shows."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from edesign.codes.ec8.analysis.modal_combination import LEAST_MASS, cqc, cqc_coefficients
from edesign.codes.spectrum import Spectrum
from edesign.core import Modes
from edesign.frame.frame_model import Floor, FrameModel, RigidPart
from edesign.study.analysis.push import Push
from edesign.study.analysis.structure import Structure


@dataclass(frozen=True)
class TorsionalAmplification:
    """Displacements of column lines in the direction of a push, over that of the centre of mass, at their upper ends.

    Attributes:
        lines: names of the column lines whose upper end is on a rigid floor.
        elastic: by the elastic modal analysis, (n,).
        pushed: by the push at its end, (n,).
    """

    lines: tuple[str, ...]
    elastic: np.ndarray
    pushed: np.ndarray

    @property
    def factor(self) -> np.ndarray:
        """What displacements and deformations on the lines are multiplied with, at least 1, (n,).

        Where the elastic analysis moves a line less than the centre of mass, no less than that is counted on. It is
        infinite on a line that does not move with the push.
        """
        wanted = np.maximum(self.elastic, 1.0)
        moves = self.pushed > 0.0
        return np.maximum(np.divide(wanted, self.pushed, out=np.full_like(wanted, np.inf), where=moves), 1.0)


def torsional_amplification(
    push: Push, structure: Structure, stiffness: np.ndarray | None, spectrum: Spectrum
) -> TorsionalAmplification | None:
    """Compare an elastic modal analysis of a building with a push of it; None where nothing turns as a rigid floor.

    Args:
        push: at whose end the displacements count, less those under gravity.
        structure: the building under gravity, its masses where the loads of the push stand.
        stiffness: that its dampers have, (n_dampers,) N/m; None: none.
        spectrum: elastic, of the horizontal action.

    Raises:
        AnalysisError: the building is unstable.

    Source: EN 1998-1:2004, 4.3.3.4.2.7(2)-(3); ratios at the top as the extension of the N2 method has them: Fajfar,
        Marušić & Peruš (2005), Journal of Earthquake Engineering 9, 831-854. CQC: `cqc_coefficients`.
    """
    frame = push.frame
    tops = {at.line: storey.number for storey in frame.storeys for at in storey.drifts[push.direction]}
    tying = {line: _tying(frame, frame.grid.node_name(line, floor), floor) for line, floor in tops.items()}
    tops = {line: floor for line, floor in tops.items() if tying[line] is not None}
    rigid = [of for of in tying.values() if of is not None]
    if not tops:
        return None
    degree = frame.directions[push.direction].degree
    levers = np.array(
        [_lever(frame, line, floor, of, degree) for (line, floor), of in zip(tops.items(), rigid, strict=True)]
    )
    moved, turned = np.array([_pushed(push, of) for of in rigid]).T
    pushed = 1.0 + levers * turned / moved

    modes = _modes(structure, degree, stiffness)
    masters = [of.turn[0][1] for of in rigid]
    nodes = [structure.frame.nodes[frame.grid.node_name(line, floor)] for line, floor in tops.items()]
    peaks = modes.participation[:, degree] * np.asarray(spectrum.displacement(modes.period))
    on_lines = peaks[:, None] * modes.shapes[:, nodes, degree]
    at_centres = on_lines - peaks[:, None] * modes.shapes[:, masters, 5] * levers
    rho = cqc_coefficients(modes.period, spectrum.damping)
    return TorsionalAmplification(tuple(tops), cqc(on_lines, rho) / cqc(at_centres, rho), pushed)


def _modes(structure: Structure, degree: int, stiffness: np.ndarray | None) -> Modes:
    """As many modes as have the mass that EN 1998-1, 4.3.3.3.1(3), asks for."""
    most = structure.most_modes
    count = min(3 * len(structure.frame.floors), most)
    while True:
        modes = structure.modes(count, stiffness)
        if count == most or modes.effective_mass_ratio[:, degree].sum() >= LEAST_MASS:
            return modes
        count = min(2 * count, most)


def _tying(frame: FrameModel, node: str, floor: int) -> Floor | RigidPart | None:
    """What turns as one with a node of a floor."""
    return next((of for of in frame.floors[floor - 1].rigid if node in of.nodes), None)


def _pushed(push: Push, rigid: Floor | RigidPart) -> tuple[float, float]:
    """How far a push moved the centre of mass of a floor or diaphragm, m, and turned it, rad, since gravity."""
    if isinstance(rigid, RigidPart):
        at = list(push.group.coords["diaphragm"].values).index(rigid.name)
        moved = push.group.variables["diaphragm_displacement"].values[:, at, push.direction]
        turned = push.group.variables["diaphragm_rotation"].values[:, at]
    else:
        moved, turned = push.floors[:, rigid.number - 1], push.turned[:, rigid.number - 1]
    return float(moved[-1] - moved[0]), float(turned[-1] - turned[0])


def _lever(frame: FrameModel, line: str, floor: int, rigid: Floor | RigidPart, degree: int) -> float:
    """Displacement on a column line for a unit turn of what ties it about the centre of mass, m."""
    (_, master, _), *_ = rigid.turn
    x, y, *_ = frame.grid.nodes[frame.grid.node_name(line, floor)]
    x_m, y_m, *_ = frame.model.node_places[master]
    return y_m - y if degree == 0 else x - x_m
