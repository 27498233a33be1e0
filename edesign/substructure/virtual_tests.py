"""Virtual tests: every test of a file with every compensator, beside the direct analysis of the same structure."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from edesign.core.frame_part import FrameNumericalPart
from edesign.core.substructure import LoopRecord, Recursion, RigLimits, SubstructureLoop
from edesign.errors import AnalysisError
from edesign.project.substructure.programme import CommandTest, RecordTest, RtsTest
from edesign.project.substructure.rts_file import RtsFile
from edesign.stopping import StopRequest, stoppable
from edesign.substructure.compensation.described import compensator_of
from edesign.substructure.computed_structure import ComputedStructure, Direct
from edesign.substructure.drive import Drive, drive_of
from edesign.substructure.laboratory import Laboratory, TestedDamper, laboratory
from edesign.substructure.methods.method_tests import MethodResults, run_method
from edesign.substructure.virtual_test import DIVERGED, VirtualTest, failed, judged


@dataclass(frozen=True)
class TestResults:
    """All that was done with one test.

    Attributes:
        name, kind: of the test.
        drive: what drove it.
        direct: None without a structure.
        runs: one for each compensator.
    """

    __test__ = False  # no test of pytest

    name: str
    kind: str
    drive: Drive
    direct: Direct | None
    runs: tuple[VirtualTest, ...]


class VirtualLaboratory:
    """The tests of a file, made ready.

    Args:
        file: from `load_rts_file`.

    Raises:
        InputError: structure, law, compensator or record cannot be used so.
    """

    def __init__(self, file: RtsFile) -> None:
        self.file = file
        self.laboratory: Laboratory = laboratory(file)
        self.computed = ComputedStructure(file, self.laboratory)
        self.damper: TestedDamper = self.computed.damper
        step = file.loop.main_step
        self.compensators = {
            name: compensator_of(one, step, self.laboratory.transfer) for name, one in file.compensators.items()
        }
        self.tests = tuple(test for test in file.tests if isinstance(test, (CommandTest, RtsTest)))
        self.others = tuple(test for test in file.tests if not isinstance(test, (CommandTest, RtsTest)))

    @cached_property
    def drives(self) -> dict[str, Drive]:
        """Drive of each test, by its name; errors as `drive`."""
        return {test.name: self.drive(test) for test in self.file.tests}

    def run(
        self, progress: Callable[[str], None] = lambda line: None, stop: StopRequest | None = None
    ) -> Iterator[TestResults]:
        """Yield the results test by test.

        Args:
            progress: called with the name of each run at its beginning.
            stop: whether a run shall end early, by `Stopped`.

        Raises:
            InputError: a record or command cannot be read.
        """
        for test in self.tests:
            drive = self.drives[test.name]
            runs = []
            with stoppable(stop):
                direct = self.direct(drive) if drive.ground is not None else None
                for name in self.compensators:
                    progress(f"{test.name}, {name}")
                    runs.append(self._run(test, name, drive, direct))
            yield TestResults(test.name, test.kind, drive, direct, tuple(runs))

    def run_others(
        self, progress: Callable[[str], None] = lambda line: None, stop: StopRequest | None = None
    ) -> Iterator[MethodResults]:
        """Yield the results of the tests by other methods; errors as `run`.

        Args:
            progress: see `run`.
            stop: see `run`.
        """
        for test in self.others:
            progress(test.name)
            drive = self.drives[test.name]
            assert drive.ground is not None
            with stoppable(stop):
                abort = DIVERGED * float(np.max(np.abs(self.direct(drive).deformation)))
                results = run_method(test, self.laboratory, self.file.loop.main_step, drive.ground, abort)
            yield results

    def drive(self, test: CommandTest | RecordTest) -> Drive:
        """Return what drives a test; errors as `drive_of`."""
        return drive_of(self.file, test)

    def direct(self, drive: Drive) -> Direct:
        """Return the response of the structure without laboratory, as `ComputedStructure.direct`."""
        return self.computed.direct(drive)

    def in_loop(self) -> Recursion | FrameNumericalPart:
        """Return the numerical part of tests with a loop; errors as `ComputedStructure.in_loop`."""
        return self.computed.in_loop()

    def step_warnings(self, test: CommandTest | RtsTest) -> Iterator[str]:
        """Yield the warnings about the main steps of a test, as `ComputedStructure.step_warnings`."""
        yield from self.computed.step_warnings(test.name, self.drives[test.name])

    def moved(self, compensator: str, target: np.ndarray) -> LoopRecord:
        """Return what rig and specimen do under a given target, the force acting on nothing.

        They have no limits here, as a limit that is met ends what a test can say.

        Args:
            target: (n,) m, at main steps, from rest; or (n, 3) with velocity and acceleration.

        Raises:
            AnalysisError: the law of the specimen fails.
        """
        step = self.file.loop.main_step
        if target.ndim == 1:
            velocity = np.gradient(target, step)
            target = np.column_stack([target, velocity, np.gradient(velocity, step)])
        return self._machine(compensator, RigLimits()).run(target, seed=self.file.loop.seed)

    def _machine(
        self,
        compensator: str,
        limits: RigLimits,
        numerical: Recursion | FrameNumericalPart | None = None,
        abort: float = np.inf,
    ) -> SubstructureLoop:
        """The loop of a test; without a numerical part targets are given."""
        lab, loop = self.laboratory, self.file.loop
        return SubstructureLoop(
            loop.main_step,
            loop.sub_steps,
            self.compensators[compensator],
            lab.rig,
            self.damper.values,
            sensors=lab.sensors,
            numerical=numerical,
            limits=limits,
            rig_stiffness=lab.rig_stiffness,
            corrected=lab.corrected,
            unseen_delay=0 if self.file.compensators[compensator].kind == "none" else loop.unseen_delay,
            abort=abort,
            scales=self.damper.scales,
        )

    def _run(self, test: CommandTest | RtsTest, compensator: str, drive: Drive, direct: Direct | None) -> VirtualTest:
        lab, loop = self.laboratory, self.file.loop
        closed = drive.ground is not None
        abort = DIVERGED * float(np.max(np.abs(drive.wanted if direct is None else direct.deformation)))
        machine = self._machine(
            compensator, lab.limits, self.computed.in_loop() if closed else None, abort if abort > 0.0 else np.inf
        )
        try:
            record = machine.run(drive.ground if closed else drive.target, seed=loop.seed)  # type: ignore[arg-type]
        except AnalysisError as error:
            return failed(test, compensator, str(error))
        named = compensator, self.compensators[compensator]
        return judged(self.computed, test, named, drive, direct, record)
