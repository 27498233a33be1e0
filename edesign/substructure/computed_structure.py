"""The structure of a file in the computer: in the loop of its tests, under a known force, and without laboratory."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from edesign.archive.dataset import Group
from edesign.core.frame_part import FrameNumericalPart
from edesign.core.substructure import LoopRecord, Recursion, SubstructureLoop
from edesign.errors import InputError
from edesign.project.substructure.rts_file import RtsFile
from edesign.substructure.compensation import compensators
from edesign.substructure.drive import Drive
from edesign.substructure.laboratory import NOTHING, Laboratory, stiffness_of, tangent_of
from edesign.substructure.rig import rigs
from edesign.substructure.structure.project_frame import ProjectFrame
from edesign.substructure.structure.recursion import growth, recursion

FINER = 4
"""How many times as fine as the main step the direct analysis is. With steps four
times as long the deformation of thesis 6.2.5 differs by 0.018 %."""
FRAME_FINER = 2
"""The same of a frame that may yield, which takes a hundred times as long."""


@dataclass(frozen=True)
class Direct:
    """Response of the structure with its damper in it, without laboratory.

    Attributes:
        deformation: (n,) of the damper, m.
        force: (n,) of the damper, N.
        drift: (n, n_storeys) of the storeys, a ratio, or in m where heights are not known.
        building: its response as the group of a history.
    """

    deformation: np.ndarray
    force: np.ndarray
    drift: np.ndarray
    building: Group


class ComputedStructure:
    """Part of a test that the computer integrates."""

    def __init__(self, file: RtsFile, laboratory: Laboratory) -> None:
        self.file, self.laboratory = file, laboratory
        self.damper = laboratory.damper or NOTHING

    def in_loop(self, record: bool = True) -> Recursion | FrameNumericalPart:
        """Return the numerical part of tests with a loop.

        Args:
            record: whether a frame that may yield records what it does.

        Raises:
            InputError: the integrator is unstable with the main step.
        """
        file, structure = self.file, self.laboratory.structure
        if structure is not None and structure.frame is not None:
            return structure.frame.numerical_part(file.loop.force, file.integration.frame_steps, record)
        return self._recursion(file.loop.main_step, file.integration.method, file.loop.force)

    def by_force(self, force: np.ndarray, ground: np.ndarray) -> np.ndarray:
        """Return the target displacements (n,) in m of the numerical part alone, from rest.

        Args:
            force: (n,) of the specimen at main steps, N.
            ground: (n,) ground acceleration there, m/s2.

        Raises:
            CoreError: the frame failed.
        """
        loop = self.file.loop
        part = SubstructureLoop(
            loop.main_step,
            1,
            compensators.none(),
            rigs.ideal().discrete(loop.main_step),
            NOTHING.values,
            numerical=self.in_loop(record=False),
        )
        return part.by_force(ground, force)

    def _recursion(self, step: float, method: str, force: str) -> Recursion:
        structure = self.laboratory.structure
        assert structure is not None
        rho = self.file.integration.rho_inf
        stiffness = stiffness_of(self.damper)
        rows = structure.building.floor_rows
        return recursion(structure.part, step, method, force, specimen_stiffness=stiffness, rho=rho, accelerations=rows)

    def direct(self, drive: Drive) -> Direct:
        """Return the response without laboratory: an ideal rig, exact integration, steps too fine to count.

        Raises:
            InputError: the main step is far too long for the specimen on the mass at its end.
            AnalysisError: the law of the damper fails.
        """
        assert drive.ground is not None and self.laboratory.structure is not None
        frame = self.laboratory.structure.frame
        if frame is not None:
            return self._direct_frame(frame, drive)
        step = self.file.loop.main_step / FINER
        time = step * np.arange(FINER * (len(drive.time) - 1) + 1)
        numerical = self._recursion(step, "exact", "extrapolated")
        if self._grows(numerical, step, time.size):
            advice = "in a quarter of them too. Take shorter ones, or check masses and stiffnesses [E-RTS-03]"
            where = self.file.where("loop", "main_step")
            raise InputError(f"{where}: loop.main_step: {self._too_long()}, {advice}")
        loop = SubstructureLoop(
            step,
            1,
            compensators.none(),
            rigs.ideal().discrete(step),
            self.damper.values,
            numerical=numerical,
            scales=self.damper.scales,
        )
        found = loop.run(np.interp(time, drive.time, drive.ground))
        group, drift = self._linear_building(drive, found.outputs[::FINER])
        return Direct(found.deformation[::FINER], found.true_force[::FINER], drift, group)

    def _direct_frame(self, frame: ProjectFrame, drive: Drive) -> Direct:
        assert drive.ground is not None
        step = self.file.loop.main_step / FRAME_FINER
        time = step * np.arange(FRAME_FINER * (len(drive.time) - 1) + 1)
        ground = np.interp(time, drive.time, drive.ground)
        found = frame.direct(ground, step, FRAME_FINER)
        return Direct(found.deformation, found.force, found.drift, found.group)

    def building(self, drive: Drive, record: LoopRecord, failed: str) -> tuple[Group, np.ndarray]:
        """Return the response of the numerical part in a test as the group of a history, and its drifts (n, n_storeys).

        Args:
            failed: why the test has no result; empty: it has one.

        Returns:
            The group; drifts, (n, n_storeys).
        """
        structure = self.laboratory.structure
        assert drive.ground is not None and structure is not None
        if structure.frame is None:
            return self._linear_building(drive, record.outputs, failed)
        found = record.frame
        assert found is not None
        if record.aborted:
            found = replace(found, reason=failed)
        response = structure.frame.tested(found, drive.ground, self.file.loop.main_step)
        return response.group, response.drift

    def _linear_building(self, drive: Drive, outputs: np.ndarray, failed: str = "") -> tuple[Group, np.ndarray]:
        """Response of the building, and its drifts, by the outputs of a recursion at main steps."""
        assert drive.ground is not None and self.laboratory.structure is not None
        structure, count = self.laboratory.structure, len(outputs)
        degrees = len(structure.part.names)
        displacements, accelerations = outputs[:, :degrees], outputs[:, degrees:].copy()
        accelerations[0] = -drive.ground[0] * (structure.building.floor_rows @ structure.part.influence)  # at rest
        time, ground, kept = drive.time[:count], drive.ground[:count], "building" in self.file.outputs.histories
        group = structure.building.group(time, displacements, accelerations, ground, kept, failed)
        return group, structure.building.drifts(displacements)

    def step_warnings(self, test: str, drive: Drive) -> Iterator[str]:
        """Yield warnings if steps leave out samples, and if a linear structure is too fast for them, or too slow.

        Too fast is one whose vibrations grow even with an ideal rig.
        """
        structure, loop = self.laboratory.structure, self.file.loop
        if drive.left_out:
            yield f"test {test}: {drive.left_out}"
        if drive.ground is None or structure is None or structure.frame is not None:
            return
        numerical = self._recursion(loop.main_step, self.file.integration.method, loop.force)
        if self._grows(numerical, loop.main_step, drive.time.size):
            yield f"test {test}: {self._too_long()}, whatever rig and compensator"
        lowest = float(structure.part.frequencies(stiffness_of(self.damper))[0])
        if lowest * drive.time[-1] < 1.0:
            yield (
                f"test {test}: the structure has {lowest:.3g} Hz, and completes no oscillation in the "
                f"{drive.time[-1]:.4g} s of the test; check masses and stiffnesses"
            )

    def _grows(self, numerical: Recursion, step: float, steps: int) -> bool:
        """Say whether small vibrations grow in a test, even with an ideal rig, by more than the allowed error."""
        factor = growth(numerical, *tangent_of(self.damper), step)
        return steps * np.log(max(factor, 1.0)) > np.log1p(self.file.criteria.response_error)

    def _too_long(self) -> str:
        assert self.laboratory.structure is not None
        stiffness = stiffness_of(self.damper)
        frequency = self.laboratory.structure.part.frequencies(stiffness)[-1]
        return (
            f"main steps of {1e3 * self.file.loop.main_step:.4g} ms are too long for the specimen: with its "
            f"{1e-6 * stiffness:.4g} kN/mm the structure has a mode of {frequency:.4g} Hz, and small vibrations grow "
            "from step to step"
        )
