"""How much more a building's column lines move by turns of its floors than a push of it shows."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from edesign.codes.ec8.modal_combination import LEAST_MASS, cqc, cqc_coefficients
from edesign.codes.spectrum import Spectrum
from edesign.core import Modes
from edesign.frame.frame_model import FrameModel
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
    """Compare an elastic modal analysis of a building with a push of it; None where no floor turns as a rigid one.

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
    tops = {line: floor for line, floor in tops.items() if frame.floors[floor - 1].turn}
    if not tops:
        return None
    degree = frame.directions[push.direction].degree
    moved, turned = ((of[-1] - of[0]) for of in (push.floors, push.turned))
    levers = np.array([_lever(frame, line, floor, degree) for line, floor in tops.items()])
    floors = np.array(list(tops.values())) - 1
    pushed = 1.0 + levers * turned[floors] / moved[floors]

    modes = _modes(structure, degree, stiffness)
    masters = [_master(structure.frame, floor) for floor in tops.values()]
    nodes = [structure.frame.nodes[frame.grid.node_name(line, floor)] for line, floor in tops.items()]
    peaks = modes.participation[:, degree] * np.asarray(spectrum.displacement(modes.period))
    on_lines = peaks[:, None] * modes.shapes[:, nodes, degree]
    at_centres = on_lines - peaks[:, None] * modes.shapes[:, masters, 5] * levers
    rho = cqc_coefficients(modes.period, spectrum.damping)
    return TorsionalAmplification(tuple(tops), cqc(on_lines, rho) / cqc(at_centres, rho), pushed)


def _modes(structure: Structure, degree: int, stiffness: np.ndarray | None) -> Modes:
    """As many modes as have the mass that EN 1998-1, 4.3.3.3.1(3), asks for."""
    most = int(np.count_nonzero(structure.analysis.masses()))
    count = min(3 * len(structure.frame.floors), most)
    while True:
        modes = structure.modes(count, stiffness)
        if count == most or modes.effective_mass_ratio[:, degree].sum() >= LEAST_MASS:
            return modes
        count = min(2 * count, most)


def _master(frame: FrameModel, floor: int) -> int:
    (_, master, _), *_ = frame.floors[floor - 1].turn
    return master


def _lever(frame: FrameModel, line: str, floor: int, degree: int) -> float:
    """Displacement on a column line for a unit turn of its floor about the centre of mass, m."""
    x, y, *_ = frame.grid.nodes[frame.grid.node_name(line, floor)]
    x_m, y_m, *_ = frame.model.node_places[_master(frame, floor)]
    return y_m - y if degree == 0 else x - x_m
