"""Forces, deformations, strains and work of dampers."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from edesign.archive.dataset import Group
from edesign.frame.frame_model import FrameModel
from edesign.study.results.recording import Quantity, Terms, directed, recorded


def damper_quantities(frame: FrameModel, history: bool) -> list[Quantity]:
    """Return force, deformation and work of the dampers, and of those with layers their shear strain.

    Args:
        history: whether values over time are kept.
    """
    numbers = [device.number for device in frame.devices]
    if not numbers:
        return []
    shape = (len(numbers),)
    forces = tuple(((1.0, "damper_force", n, 0),) for n in numbers)
    own = tuple(((1.0, "damper_deformation", n, 1),) for n in numbers)
    label = "force of the damper, positive with its deformation"
    found = [Quantity("damper_force", ("damper",), shape, forces, "N", label, history)]
    label = "deformation of the damper without its brace"
    found.append(Quantity("damper_deformation", ("damper",), shape, own, "m", label, history))
    thicknesses = [device.layer_thickness for device in frame.devices]
    if any(thicknesses):
        cells = tuple(
            ((1.0 / thickness, "damper_deformation", n, 1),) if thickness else ()
            for n, thickness in zip(numbers, thicknesses, strict=True)
        )
        label = "shear strain of the damper's layers"
        found.append(Quantity("damper_strain", ("damper",), shape, cells, "1", label, keep=("max", "min")))
    found += _restrained_braces(frame)
    work = tuple(((1.0, "damper_work", n, 0),) for n in numbers)
    label = "work done on the damper and its brace in this analysis"
    found.append(Quantity("damper_work", ("damper",), shape, work, "J", label, keep=("final",), since_start=True))
    return [*found, storey_damper_forces(frame, history)]


def storey_damper_forces(frame: FrameModel, history: bool) -> Quantity:
    """Return the horizontal force of the dampers of each storey on the floor above, N.

    Args:
        history: whether values over time are kept.
    """
    cells: dict[tuple[int, int], Terms] = {
        (storey.number, axis.degree): () for storey in frame.storeys for axis in frame.directions
    }
    for device in frame.devices:
        if not device.storey:
            continue
        top = {frame.nodes[name] for name in frame.floors[device.storey - 1].nodes}
        for axis in frame.directions:
            if device.direction in (None, axis.degree):
                across = sum(c for c, node, degree in device.terms if node in top and degree == axis.degree)
                cells[device.storey, axis.degree] += ((across, "damper_force", device.number, 0),)
    label = "horizontal force of the storey's dampers, positive as the storey's shear"
    return Quantity("storey_damper_force", *directed(frame, "storey"), tuple(cells.values()), "N", label, history)


class DamperSpeeds:
    """The largest velocity of each damper without its brace, by its deformation at every step of a history.

    Source: the derivative of the polynomial through five points in equal steps errs by h^4 u'''''/30: at 5 Hz and
        0.01 s by 3e-4. Where steps differ it is that of the three in the middle.
    """

    needs: tuple[str, ...] = ("damper_deformation",)
    own: tuple[Quantity, ...] = ()

    def __init__(self, frame: FrameModel) -> None:
        count = len(frame.devices)
        self._times, self._last, self._largest = np.zeros(0), np.zeros((0, count)), np.zeros(count)

    def see(self, abscissas: np.ndarray, values: Mapping[str, np.ndarray]) -> None:
        """See further steps; see `Observer`."""
        t, u = np.append(self._times, abscissas), np.concatenate([self._last, values[self.needs[0]]])
        self._times, self._last = t[-4:].copy(), u[-4:].copy()
        if t.size < 5:
            return
        steps = np.stack([t[i + 1 : t.size - 3 + i] - t[i : t.size - 4 + i] for i in range(4)])
        equal = np.ptp(steps, axis=0) <= 1e-6 * steps.max(axis=0)
        five = (u[:-4] - 8.0 * u[1:-3] + 8.0 * u[3:-1] - u[4:]) / (12.0 * steps[1, :, None])
        three = (u[3:-1] - u[1:-3]) / (steps[1] + steps[2])[:, None]
        np.maximum(self._largest, np.abs(np.where(equal[:, None], five, three)).max(axis=0), out=self._largest)

    def store(self, group: Group, abscissa: str, unit: str) -> None:
        """Add the velocities to the group of a history; see `Observer`."""
        if unit == "s":
            label = "largest velocity of the damper without its brace"
            group.add("damper_velocity_max", ("damper",), self._largest, "m/s", label)


def tuned_mass_displacements(frame: FrameModel, history: bool) -> list[Quantity]:
    """Displacement of each tuned mass relative to its floor, the stroke that it needs; nothing without any."""
    if not frame.attached:
        return []
    cells = tuple(recorded(stroke) for stroke in frame.attached.values())
    label = "horizontal displacement of the tuned mass relative to its floor"
    return [Quantity("tuned_mass_displacement", ("tuned_mass",), (len(cells),), cells, "m", label, history)]


def _restrained_braces(frame: FrameModel) -> list[Quantity]:
    """Strain of the core and ductilities of the dampers that are buckling-restrained braces; of others 0."""
    if not any(device.restrained for device in frame.devices):
        return []
    strains: list[Terms] = []
    ductilities: list[Terms] = []
    cumulated: list[Terms] = []
    for device in frame.devices:
        brace, n = device.restrained, device.number
        if brace is None:
            for cells in (strains, ductilities, cumulated):
                cells.append(())
            continue
        by_force, by_deformation = brace.strain_of_core
        strains.append(((by_force, "damper_force", n, 0), (by_deformation, "damper_deformation", n, 1)))
        ductilities.append(((1.0 / brace.yield_deformation, "damper_deformation", n, 1),))
        cumulated.append(((1.0 / brace.yield_deformation, "damper_deformation", n, 2),))
    shape = (len(strains),)
    label = "strain of the steel core of a buckling-restrained brace, in its yielding length"
    found = [Quantity("core_strain", ("damper",), shape, tuple(strains), "1", label, keep=("max", "min"))]
    label = "deformation of a buckling-restrained brace / its yield deformation"
    found.append(Quantity("core_ductility", ("damper",), shape, tuple(ductilities), "1", label, keep=("max", "min")))
    label = "sum of the plastic deformations of a buckling-restrained brace either way / its yield deformation"
    found.append(Quantity("cumulative_ductility", ("damper",), shape, tuple(cumulated), "1", label, keep=("final",)))
    return found
