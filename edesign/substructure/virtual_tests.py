"""Virtual tests: every test of a file with every compensator, beside the direct analysis of the same structure."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from edesign.archive.dataset import Group
from edesign.core.compensator import AdaptiveTimeSeries, Compensator, LiveDelay
from edesign.core.frame_part import FrameNumericalPart
from edesign.core.substructure import (
    LinearRig,
    LoopRecord,
    Recursion,
    Sensors,
    SubstructureLoop,
)
from edesign.errors import AnalysisError, InputError
from edesign.ground_motion.project_records import find_recordings
from edesign.project.substructure.checks_tests import MOST_STEPS
from edesign.project.substructure.programme import CommandTest, RecordTest, RtsTest
from edesign.project.substructure.rts_file import RtsFile
from edesign.stopping import Wish, stoppable
from edesign.substructure.commands import command_motion
from edesign.substructure.compensation import compensators
from edesign.substructure.indicators import Tracking, tracking
from edesign.substructure.indicators.response_error import peak_error, response_error
from edesign.substructure.laboratory import (
    NOTHING,
    Laboratory,
    TestedDamper,
    compensator_of,
    laboratory,
    stiffness_of,
    tangent_of,
)
from edesign.substructure.met_limits import MetLimit, met_limits
from edesign.substructure.methods.method_tests import MethodResults, run_method
from edesign.substructure.rig import rigs
from edesign.substructure.structure.project_frame import ProjectFrame
from edesign.substructure.structure.recursion import growth, recursion

FINER = 4
"""How many times as fine as the main step the direct analysis is. With steps four
times as long the deformation of thesis 6.2.5 differs by 0.018 %."""
FRAME_FINER = 2
"""The same of a frame that may yield, which takes a hundred times as long."""
DIVERGED = 10.0
"""Times the largest direct deformation, or given target, at which a test counts as unstable: its loop feeds itself."""


@dataclass(frozen=True)
class Drive:
    """What drives a test.

    Attributes:
        time: (n,) s at main steps.
        ground: (n,) ground acceleration, m/s2; None: targets are given.
        target: (n, 3) m, m/s, m/s2; None: the structure makes them.
        source: in words.
        record: name of the ground motion, "" without one.
        left_out: what main steps leave out of a record, a sentence; empty: nothing.
    """

    time: np.ndarray
    ground: np.ndarray | None
    target: np.ndarray | None
    source: str
    record: str = ""
    left_out: str = ""

    @property
    def wanted(self) -> np.ndarray:
        """Given target displacements (n,) m; zeros where the structure makes them."""
        return np.zeros(self.time.size) if self.target is None else self.target[:, 0]


@dataclass(frozen=True)
class Direct:
    """The structure with its damper in it, without laboratory.

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


@dataclass(frozen=True)
class VirtualTest:
    """A test with one compensator.

    Attributes:
        test, compensator: their names.
        kind: of the test.
        time: (n,) s; shorter than asked for if the test was ended.
        record: of the loop; None: the specimen's law failed.
        building: response of the numerical part as the group of a history; None: there is none.
        tracking: how well the rig followed; None for a test that did not reach its end.
        response_error: root mean square of the error of the damper's deformation over that of the direct analysis; NaN
            without a structure.
        peak_error: relative error of its largest magnitude.
        building_error: as `response_error`, of the drift of the storey where it is largest.
        alpha: (3,) means of the adaptive coefficients between the first and the last motion above the threshold; NaN of
            other compensators.
        outcome: `done`, `unstable`, `saturated` or `failed`.
        reason: why, if it is not done.
        saturated: limits of rig and sensors that it met.
        warnings: what is doubtful about it, in sentences.
    """

    test: str
    compensator: str
    kind: str
    time: np.ndarray
    record: LoopRecord | None
    building: Group | None
    tracking: Tracking | None
    response_error: float
    peak_error: float
    building_error: float
    alpha: np.ndarray
    outcome: str
    reason: str
    saturated: tuple[MetLimit, ...]
    warnings: tuple[str, ...] = ()


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
        self.damper: TestedDamper = self.laboratory.damper or NOTHING
        step = file.loop.main_step
        self.compensators = {
            name: compensator_of(one, step, self.laboratory.transfer) for name, one in file.compensators.items()
        }
        self.tests = tuple(test for test in file.tests if isinstance(test, (CommandTest, RtsTest)))
        self.others = tuple(test for test in file.tests if not isinstance(test, (CommandTest, RtsTest)))

    @cached_property
    def drives(self) -> dict[str, Drive]:
        """What drives each test, by its name; errors as `drive`."""
        return {test.name: self.drive(test) for test in self.file.tests}

    def run(self, tell: Callable[[str], None] = lambda line: None, wish: Wish | None = None) -> Iterator[TestResults]:
        """Yield the results test by test.

        Args:
            tell: called with the name of each run at its beginning.
            wish: whether a run shall end early, by `Stopped`.

        Raises:
            InputError: a record or command cannot be read.
        """
        for test in self.tests:
            drive = self.drives[test.name]
            runs = []
            with stoppable(wish):
                direct = self.direct(drive) if drive.ground is not None else None
                for name in self.compensators:
                    tell(f"{test.name}, {name}")
                    runs.append(self._run(test, name, drive, direct))
            yield TestResults(test.name, test.kind, drive, direct, tuple(runs))

    def run_others(
        self, tell: Callable[[str], None] = lambda line: None, wish: Wish | None = None
    ) -> Iterator[MethodResults]:
        """Yield the results of the tests by other methods; arguments and errors as `run`."""
        for test in self.others:
            tell(test.name)
            drive = self.drives[test.name]
            assert drive.ground is not None
            with stoppable(wish):
                abort = DIVERGED * float(np.max(np.abs(self.direct(drive).deformation)))
                results = run_method(test, self.laboratory, self.file.loop.main_step, drive.ground, abort)
            yield results

    def drive(self, test: CommandTest | RecordTest) -> Drive:
        """Return what drives a test.

        Raises:
            InputError: its record or command cannot be read.
        """
        file, step = self.file, self.file.loop.main_step
        if isinstance(test, CommandTest):
            target = command_motion(test.command, step, file.folder)
            self._moves(test, target)
            return Drive(step * np.arange(len(target)), None, target, "command")
        motion = file.motion(test)
        holder = file.project if motion.of_project else file
        assert holder is not None
        record = find_recordings(holder, [motion.record])[motion.record].record
        scale = motion.scale if motion.scale is not None else (motion.pga or 0.0) / record.pga
        last = float(record.time[-1]) + motion.free_vibration
        if last > MOST_STEPS * step:
            where = file.where("tests", file.tests.index(test))
            raise InputError(
                f"{where}: test {test.name}: {last:.4g} s are {last / step:.3g} main steps; at most {MOST_STEPS} run"
            )
        time = np.arange(0.0, last + 0.5 * step, step)
        ground = scale * np.interp(time, record.time, record.acceleration, right=0.0)
        self._moves(test, ground)
        said = f"{motion.record} x {scale:.4g}"
        if record.time_step > 1.001 * step:
            said += f", linear between its samples {1e3 * record.time_step:.4g} ms apart"
        left_out = ""
        if step > 1.001 * record.time_step:
            whole, kept = abs(scale) * record.pga, _largest(ground)
            left_out = (
                f"the record {motion.record} has samples {1e3 * record.time_step:.4g} ms apart, and main steps of "
                f"{1e3 * step:.4g} ms leave some out: of its peak of {whole:.4g} m/s2 {kept:.4g} m/s2 act; take main "
                "steps no longer than its own"
            )
        return Drive(time, ground, None, said, motion.record, left_out)

    def _moves(self, test: CommandTest | RecordTest, driving: np.ndarray) -> None:
        if not np.any(driving):
            where = self.file.where("tests", self.file.tests.index(test))
            raise InputError(f"{where}: test {test.name}: what drives it is zero from beginning to end")

    def _numerical(self, step: float, method: str, force: str) -> Recursion:
        structure = self.laboratory.structure
        assert structure is not None
        rho = self.file.integration.rho_inf
        stiffness = stiffness_of(self.damper)
        rows = structure.building.floor_rows
        return recursion(structure.part, step, method, force, specimen_stiffness=stiffness, rho=rho, accelerations=rows)

    def direct(self, drive: Drive) -> Direct:
        """Return the response without laboratory: an ideal rig, exact integration, steps too fine to count.

        Args:
            drive: with a ground motion.

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
        numerical = self._numerical(step, "exact", "extrapolated")
        if self._grows(numerical, step, time.size):
            advice = "in a quarter of them too. Take shorter ones, or check masses and stiffnesses"
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

    def step_warnings(self, test: CommandTest | RtsTest) -> Iterator[str]:
        """Yield warnings if steps leave out samples, and if a linear structure is too fast for them, or too slow.

        Too fast is one whose vibrations grow even with an ideal rig.
        """
        drive, structure, loop = self.drives[test.name], self.laboratory.structure, self.file.loop
        if drive.left_out:
            yield f"test {test.name}: {drive.left_out}"
        if drive.ground is None or structure is None or structure.frame is not None:
            return
        numerical = self._numerical(loop.main_step, self.file.integration.method, loop.force)
        if self._grows(numerical, loop.main_step, drive.time.size):
            yield f"test {test.name}: {self._too_long()}, whatever rig and compensator"
        lowest = float(structure.part.frequencies(stiffness_of(self.damper))[0])
        if lowest * drive.time[-1] < 1.0:
            yield (
                f"test {test.name}: the structure has {lowest:.3g} Hz, and swings not once in the "
                f"{drive.time[-1]:.4g} s of the test; check masses and stiffnesses"
            )

    def _grows(self, numerical: Recursion, step: float, steps: int) -> bool:
        """Whether small vibrations grow in a test, even with an ideal rig, by more than its response may be wrong."""
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

    def _direct_frame(self, frame: ProjectFrame, drive: Drive) -> Direct:
        assert drive.ground is not None
        step = self.file.loop.main_step / FRAME_FINER
        time = step * np.arange(FRAME_FINER * (len(drive.time) - 1) + 1)
        ground = np.interp(time, drive.time, drive.ground)
        found = frame.direct(ground, step, FRAME_FINER)
        return Direct(found.deformation, found.force, found.drift, found.group)

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

    def _building(self, drive: Drive, record: LoopRecord, failed: str) -> tuple[Group, np.ndarray]:
        """Response of the numerical part in a test, and its drifts."""
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
        return self._numerical(file.loop.main_step, file.integration.method, file.loop.force)

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

    def _run(self, test: CommandTest | RtsTest, compensator: str, drive: Drive, direct: Direct | None) -> VirtualTest:
        lab, loop = self.laboratory, self.file.loop
        closed = drive.ground is not None
        none = self.file.compensators[compensator].kind == "none"
        abort = DIVERGED * float(np.max(np.abs(drive.wanted if direct is None else direct.deformation)))
        machine = SubstructureLoop(
            loop.main_step,
            loop.sub_steps,
            self.compensators[compensator],
            lab.rig,
            self.damper.values,
            sensors=lab.sensors,
            numerical=self.in_loop() if closed else None,
            limits=lab.limits,
            flexibility=lab.flexibility,
            corrected=lab.corrected,
            unseen_delay=0 if none else loop.unseen_delay,
            abort=abort if abort > 0.0 else np.inf,
            scales=self.damper.scales,
        )
        try:
            record = machine.run(drive.ground if closed else drive.target, seed=loop.seed)  # type: ignore[arg-type]
        except AnalysisError as error:
            return _failed(test, compensator, str(error))
        return self._judged(test, compensator, drive, direct, record)

    def _judged(
        self, test: CommandTest | RtsTest, compensator: str, drive: Drive, direct: Direct | None, record: LoopRecord
    ) -> VirtualTest:
        count, tracked, group = len(record.target), None, None
        response = peak = of_building = np.nan
        outcome, reason = self._outcome(drive, direct, record)
        drift = np.zeros((count, 0))
        if direct is not None:
            group, drift = self._building(drive, record, reason)
            if group.attributes["status"] != "completed" and outcome == "done":
                outcome, reason = "failed", f"the numerical part: {group.attributes['reason']}"
        if outcome == "done":
            step, applied = self.file.loop.main_step, record.applied_force
            tracked = tracking(record.target, record.measured, step, record.force, applied=applied)
        if outcome == "done" and direct is not None:
            response = response_error(record.deformation, direct.deformation)
            peak = peak_error(record.deformation, direct.deformation)
            of_building = _largest_error(drift, direct.drift)
        return VirtualTest(
            test=test.name,
            compensator=compensator,
            kind=test.kind,
            time=drive.time[:count],
            record=record,
            building=group,
            tracking=tracked,
            response_error=response,
            peak_error=peak,
            building_error=of_building,
            alpha=_mean_alpha(record, self.compensators[compensator]),
            outcome=outcome,
            reason=reason,
            saturated=met_limits(record, drive.time),
            warnings=tuple(self._doubts(test, compensator, drive, direct, record)),
        )

    def _outcome(self, drive: Drive, direct: Direct | None, record: LoopRecord) -> tuple[str, str]:
        """How a run ended, and why it gives no result."""
        if record.aborted:
            what = "largest target" if direct is None else "direct deformation"
            return (
                "unstable",
                f"diverged: {DIVERGED:g} times the {what} after {drive.time[len(record.target) - 1]:.4g} s",
            )
        weak = [one for one in met_limits(record, drive.time) if one.name == "force"]
        if weak and isinstance(self.laboratory.rig, LinearRig):
            needed, limit = np.max(np.abs(record.true_force)), self.laboratory.limits.force
            return "saturated", (
                f"the specimen took {1e-3 * needed:.4g} kN, and the actuator has {1e-3 * limit:.4g} kN{weak[0].times}. "
                f"A rig of the kind {self.file.plant.kind} has no balance of forces, so the actuator would have moved "
                "less than here"
            )
        return "done", ""

    def _doubts(
        self, test: CommandTest | RtsTest, compensator: str, drive: Drive, direct: Direct | None, record: LoopRecord
    ) -> Iterator[str]:
        """What is doubtful about a run."""
        motion, force = (drive.wanted, record.true_force) if direct is None else (direct.deformation, direct.force)
        yield from self.step_warnings(test)
        yield from lost_in_noise(test.name, self.laboratory.sensors, _largest(motion), _largest(force))
        of = self.compensators[compensator]
        if isinstance(of, (AdaptiveTimeSeries, LiveDelay)) and not np.any(np.ptp(record.alpha, axis=0)):
            largest = _largest(record.measured)
            why = (
                f": the measured displacement stayed at {1e3 * largest:.3g} mm and below, and its threshold is "
                f"{1e3 * of.threshold:.3g} mm"
                if largest <= of.threshold
                else ""
            )
            yield f'test {test.name}: "{compensator}" never adapted, and kept what it began with{why}'


def _largest_error(found: np.ndarray, direct: np.ndarray) -> float:
    """Root mean square error over that of the direct analysis, of the column where it is largest; NaN: none moves."""
    errors = [response_error(one, other) for one, other in zip(found.T, direct.T, strict=True)]
    return max((error for error in errors if not np.isnan(error)), default=np.nan)


def without_result(run: VirtualTest, outcome: str, reason: str) -> VirtualTest:
    """Return a run with another outcome, and without indicators, which would be no result."""
    nan = np.nan
    return replace(
        run, outcome=outcome, reason=reason, tracking=None, response_error=nan, peak_error=nan, building_error=nan
    )


def lost_in_noise(test: str, sensors: Sensors, deformation: float, force: float) -> Iterator[str]:
    """Yield a warning for each channel whose noise, or step of its converter, is not below the motion of a test.

    Args:
        test: its name.
        sensors: of the laboratory.
        deformation, force: largest of the specimen, m and N; 0: it has none.
    """
    for channel, largest, noise, quantum, scale, unit in (
        ("displacement", deformation, sensors.displacement_noise, sensors.displacement_quantum, 1e3, "mm"),
        ("force", force, sensors.force_noise, sensors.force_quantum, 1e-3, "kN"),
    ):
        for what, size in (("the noise", noise), ("a step of the converter", quantum)):
            if 0.0 < largest <= size:
                yield (
                    f"test {test}: {what} of the {channel}, {scale * size:.3g} {unit}, is not below the largest "
                    f"{channel} of the specimen, {scale * largest:.3g} {unit}"
                )


def _largest(values: np.ndarray) -> float:
    return float(np.max(np.abs(values)))


def _mean_alpha(record: LoopRecord, compensator: Compensator) -> np.ndarray:
    """From the first to the last displacement above the threshold: before and after, rest and noise would count."""
    moving = np.flatnonzero(np.abs(record.measured) > getattr(compensator, "threshold", np.inf))
    if not isinstance(compensator, AdaptiveTimeSeries) or not moving.size:
        return np.full(3, np.nan)
    return np.asarray(np.mean(record.alpha[moving[0] : moving[-1] + 1], axis=0))


def _failed(test: CommandTest | RtsTest, compensator: str, reason: str) -> VirtualTest:
    return VirtualTest(
        test=test.name,
        compensator=compensator,
        kind=test.kind,
        time=np.zeros(0),
        record=None,
        building=None,
        tracking=None,
        response_error=np.nan,
        peak_error=np.nan,
        building_error=np.nan,
        alpha=np.full(3, np.nan),
        outcome="failed",
        reason=reason,
        saturated=(),
    )
