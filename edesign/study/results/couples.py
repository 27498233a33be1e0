"""The couple that dampers between floors lack: they push two levels apart, and no vertical forces balance that."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from types import MappingProxyType

import numpy as np

from edesign.core import Response
from edesign.frame.devices import Device
from edesign.frame.frame_model import FrameModel
from edesign.project.analysis_file import AnalysisFile
from edesign.project.dampers.designs import Design
from edesign.project.dampers.placement import PlacementDesign
from edesign.study.results.dampers import storey_damper_forces
from edesign.study.results.recording import Quantity, Terms
from edesign.study.results.storeys import storey_shears
from edesign.study.results.warnings import AnalysisWarning

NEGLECTED = 0.10
"""Share of an overturning moment that may be left out: EN 1998-1, 4.4.2.2(2), lets second-order effects be up to it."""

NO_COUPLE = (
    "dampers of the kind `storey` act without a couple of vertical forces, which axial forces of columns and vertical "
    "reactions lack; `chevron` and diagonals have it"
)
_ROUNDING = 1e-9  # of the height of the frame
Place = tuple[float, ...]
"""A place in plan, m: x of a plane frame, x and y of a building."""


def couple_advice(project: AnalysisFile, designs: Mapping[str, Design] = MappingProxyType({})) -> list[str]:
    """Say which dampers of a project stand between floors, or will by designs of a study."""
    kinds: dict[str, set[str]] = {}
    for i, run in enumerate(project.dampers.devices if project.dampers is not None else ()):
        kinds[f"dampers.devices[{i}]"] = {run.kind}
    for name, spec in designs.items():
        if isinstance(spec, PlacementDesign):
            kinds[f"design {name}"] = {item.kind or spec.kind for item in spec.catalogue.values()}
        else:
            kinds[f"design {name}"] = {run.kind for run in spec.runs}
    where = [place for place, several in kinds.items() if "storey" in several]
    return [f"{', '.join(where)}: {NO_COUPLE}"] if where else []


def couple_terms(frame: FrameModel, direction: int = 0) -> Terms:
    """Return the moment of the couples that dampers lack, N m, positive as that of reactions to loads to the right.

    Args:
        direction: index of the direction in whose vertical planes they would act.
    """
    return tuple((arm, "damper_force", device.number, 0) for device, arm, _ in _lacking(frame, direction))


class LackingCouples:
    """What an analysis records of these couples, and the warning that becomes of it.

    Attributes:
        quantities: for the core, not archived; nothing where no damper lacks its couple.
    """

    def __init__(self, frame: FrameModel) -> None:
        self._axes = [axis.name for axis in frame.directions]
        on: dict[tuple[int, Place], Terms] = {}
        for axis in range(len(self._axes)):
            for device, arm, (left, right) in _lacking(frame, axis):
                for at, way in ((left, 1.0), (right, -1.0)):
                    share = way * arm / (right[axis] - left[axis])
                    on[axis, at] = (*on.get((axis, at), ()), (share, "damper_force", device.number, 0))
        lines = {frame.grid.line_place(line): line for line in frame.grid.lines}
        self._lines = [(axis, lines[at]) for axis, at in on]
        couples = tuple(couple_terms(frame, axis) for axis in range(len(self._axes)))
        totals = tuple(_overturning(frame, axis) for axis in range(len(self._axes)))
        dims, shape = ("direction",), (len(self._axes),)
        self._couple = Quantity("lacking_couple", dims, shape, couples, "N*m", "")
        self._total = Quantity("overturning_of_storeys", dims, shape, totals, "N*m", "")
        self._forces = Quantity("lacking_axial_force", ("line",), (len(on),), tuple(on.values()), "N", "")
        self.quantities = [self._couple, self._total, self._forces] if on else []

    def warnings(self, response: Response) -> list[AnalysisWarning]:
        """Return the warning about overturning, if the couples matter.

        Args:
            response: of the analysis, with `quantities`.
        """
        if not self.quantities:
            return []
        couples, totals, forces = (
            np.maximum(-quantity.extreme(response, "min"), quantity.extreme(response, "max"))
            for quantity in self.quantities
        )
        shares = np.divide(couples, totals, out=np.zeros_like(couples), where=totals > 0.0)
        most = int(shares.argmax())
        share, couple, total = (float(values[most]) for values in (shares, couples, totals))
        if share <= NEGLECTED:
            return []
        of_lines = [(force, line) for force, (axis, line) in zip(forces, self._lines, strict=True) if axis == most]
        force, line = max(of_lines, key=lambda item: item[0])
        about = f" along {self._axes[most]}" if self._axes[most] else ""
        text = (
            f"{couple / 1e3:.4g} of {total / 1e3:.4g} kNm of overturning{about} are in no column, at line "
            f"{line} {force / 1e3:.4g} kN; {NO_COUPLE}"
        )
        return [AnalysisWarning("damper_couple", text, share / NEGLECTED)]


def _overturning(frame: FrameModel, direction: int) -> Terms:
    """The shears of the storeys times their heights."""
    return tuple(
        (storey.height * c, kind, item, at)
        for shear in (storey_shears(frame, history=False), storey_damper_forces(frame, history=False))
        for storey, terms in zip(frame.storeys, shear.cells[direction :: len(frame.directions)], strict=True)
        for c, kind, item, at in terms
    )


def _lacking(frame: FrameModel, direction: int) -> Iterator[tuple[Device, float, tuple[Place, Place]]]:
    """Dampers that lack a couple, its moment over their force in m, and the outer column lines of their bay in plan.

    Along a line between nodes, and at the apex of a chevron, forces balance; those on isolators go to the ground.
    """
    places = {node: frame.places[name] for name, node in frame.nodes.items()}
    across = frame.directions[direction].degree
    for device in frame.devices:
        if device.column_base:
            continue
        arm = sum(c * places[node][-1] for c, node, degree in device.terms if degree == across)
        arm -= sum(c * places[node][across] for c, node, degree in device.terms if degree == frame.up)
        if abs(arm) > _ROUNDING * frame.floors[-1].level:
            ends = sorted((places[node][:-1] for _, node, _ in device.terms), key=lambda place: place[across])
            yield device, arm, (ends[0], ends[-1])
