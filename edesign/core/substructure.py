"""The loop of a virtual real-time substructure test, run by the core."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from math import inf
from time import thread_time
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from edesign.core._edcore import ffi, lib
from edesign.core.compensator import Compensator, compensator_parameters
from edesign.core.damper import CoreDamper, LawValues
from edesign.core.errors import CoreError, status_name
from edesign.core.frame_part import FrameNumericalPart
from edesign.core.response import Passed, Response
from edesign.core.stop import STOP, raise_if_stopped

MOST_RIG_STATES = int(lib.ED_RIG_STATES)
SENSOR = "range of a sensor"
SATURATED = {1: "stroke", 2: "velocity", 4: "force", 8: SENSOR}
"""Bits of the channel `saturated`."""


@dataclass(frozen=True)
class RigLimits:
    """Limits of the rig; a motion beyond stroke or velocity is cut off there.

    Attributes:
        stroke: m; velocity: m/s; force: N.
    """

    stroke: float = inf
    velocity: float = inf
    force: float = inf


@dataclass(frozen=True)
class LinearRig:
    """A rig as a discrete linear system over a sub-step, behind a pure delay.

    r_1 = A r_0 + b0 w_0 + b1 w_1 with the command w linear over the sub-step; the position is c r + d w, the velocity
    c_v r + d_v w. Without states the position is d w, and the velocity its slope.

    Attributes:
        delay: s.
        A: (n, n).
        b0, b1, c, c_v: (n,).
        d, d_v: direct terms.
    """

    delay: float = 0.0
    A: np.ndarray = field(default_factory=lambda: np.zeros((0, 0)))
    b0: np.ndarray = field(default_factory=lambda: np.zeros(0))
    b1: np.ndarray = field(default_factory=lambda: np.zeros(0))
    c: np.ndarray = field(default_factory=lambda: np.zeros(0))
    c_v: np.ndarray = field(default_factory=lambda: np.zeros(0))
    d: float = 1.0
    d_v: float = 0.0

    def fill(self, model: Any) -> None:
        """Write the rig into the core's struct.

        Raises:
            ValueError: the rig has more states than the core takes.
        """
        n = len(self.A)
        if n > MOST_RIG_STATES:
            raise ValueError(f"a rig with {n} states, of {MOST_RIG_STATES} at most")
        model.kind, model.delay, model.n, model.d, model.d_v = lib.ED_RIG_LINEAR, self.delay, n, self.d, self.d_v
        for name in ("A", "b0", "b1", "c", "c_v"):
            values = np.ascontiguousarray(getattr(self, name), dtype=float).ravel()
            ffi.memmove(getattr(model, name), ffi.from_buffer("double[]", values), values.nbytes)


@dataclass(frozen=True)
class ServoHydraulicRig:
    """An actuator with a proportional controller, a valve that lags, and a column of oil.

    valve_lag q' + q = gain (w - x); the piston stands at x = integral of q less F / oil.

    Attributes:
        gain: 1/s.
        oil: stiffness of the oil column, N/m.
        valve_lag: s.
        delay: of the command, s.
    """

    gain: float
    oil: float
    valve_lag: float = 0.0
    delay: float = 0.0

    def fill(self, model: Any) -> None:
        """Write the rig into the core's struct."""
        model.kind, model.delay, model.gain = lib.ED_RIG_SERVO_HYDRAULIC, self.delay, self.gain
        model.oil, model.valve_lag = self.oil, self.valve_lag


@dataclass(frozen=True)
class Sensors:
    """Noise, resolution, range and delay of the sensors of displacement (m) and force (N).

    Attributes:
        displacement_noise, force_noise: standard deviations.
        displacement_quantisation, force_quantisation: of the converter; 0 for none.
        displacement_range, force_range: largest readings.
        force_delay: s.
    """

    displacement_noise: float = 0.0
    displacement_quantisation: float = 0.0
    displacement_range: float = inf
    force_noise: float = 0.0
    force_quantisation: float = 0.0
    force_range: float = inf
    force_delay: float = 0.0


@dataclass(frozen=True, eq=False)
class Recursion:
    """One main step of the numerical part: z' = A z + B w, y' = C z + D w.

    w = (F_k, F_(k-1), a_g,k, a_g,k+1) is what is known at the start of the step, in N and m/s2. y' is at its end:
    target displacement (m), velocity (m/s) and acceleration (m/s2) of the specimen's deformation, then displacements
    of all n degrees (m), and m more that are recorded. Before the first step z = 0, at rest; so the ground motion
    should begin with zero.

    Attributes:
        A: (s, s).
        B: (s, 4).
        C: (3 + n + m, s).
        D: (3 + n + m, 4).
    """

    A: np.ndarray
    B: np.ndarray
    C: np.ndarray
    D: np.ndarray


@dataclass(frozen=True)
class LoopRecord:
    """Record of a virtual test, at the beginnings of main steps and the end of the last: n samples, SI.

    Attributes:
        target, target_velocity, target_acceleration: of the interface.
        command: of the compensator.
        measured: displacement of the specimen as read.
        actuator: displacement of the piston.
        deformation: of the specimen, true.
        force, true_force: of the specimen, as read and true.
        applied_force: on the numerical part: as read, and what a compensator adds to it.
        alpha: (n, 3) of ATS; the first is the delay, s, of a live delay.
        independence: of the signals that the alphas stand for, 1 to 0: smallest pivot of their correlation matrix.
        limited: bits 0 to 2 for an alpha at a limit.
        saturated: bits of SATURATED.
        outputs: (n, m) what else a recursion gives.
        aborted: whether the displacement went beyond the abort displacement in the last sample.
        frame: what a frame recorded; None: nothing was asked for. Its status is "limit" where one of its limits ended
            the test, and "failed" where the test was aborted.
    """

    target: np.ndarray
    target_velocity: np.ndarray
    target_acceleration: np.ndarray
    command: np.ndarray
    measured: np.ndarray
    actuator: np.ndarray
    deformation: np.ndarray
    force: np.ndarray
    true_force: np.ndarray
    applied_force: np.ndarray
    alpha: np.ndarray
    independence: np.ndarray
    limited: np.ndarray
    saturated: np.ndarray
    outputs: np.ndarray
    aborted: bool
    frame: Response | None = None

    @property
    def force_is_corrected(self) -> bool:
        """True if the compensator adds something to the force."""
        return not np.array_equal(self.applied_force, self.force)

    @property
    def response(self) -> np.ndarray:
        """Deformation (n,) whose force the structure gets, m: of the specimen, or of the target if it is corrected."""
        return self.target if self.force_is_corrected else self.deformation


class SubstructureLoop:
    """A virtual test that can be run again and again. One thread at a time may use it.

    Args:
        step: main step, s.
        sub_steps: of the rig in a main step.
        compensator, rig, sensors: of the laboratory.
        scales: of its force and its deformation, F = scales[0] law(scales[1] u).
        numerical: the structure, linear or a frame that may yield; None: targets are given.
        rig_stiffness: between actuator and specimen, N/m; 0: rigid.
        corrected: whether the difference of actuator and specimen is added to the command.
        unseen_delay: main steps between the target and the compensator.
        abort: displacement of target or specimen that ends a run, m.

    Raises:
        CoreError: a value is out of range.
    """

    def __init__(
        self,
        step: float,
        sub_steps: int,
        compensator: Compensator,
        rig: LinearRig | ServoHydraulicRig,
        specimen: LawValues,
        sensors: Sensors | None = None,
        numerical: Recursion | FrameNumericalPart | None = None,
        limits: RigLimits | None = None,
        rig_stiffness: float = 0.0,
        corrected: bool = False,
        unseen_delay: int = 0,
        abort: float = inf,
        scales: tuple[float, float] = (1.0, 1.0),
    ) -> None:
        self._specimen = CoreDamper(specimen.law, specimen.values, effects=specimen.effects)
        self.step, self._numerical = step, numerical
        data, model, read = ffi.new("ed_substructure_input *"), ffi.new("ed_rig_model *"), ffi.new("ed_sensors *")
        rig.fill(model)
        limits = limits or RigLimits()
        model.stroke, model.velocity, model.force = limits.stroke, limits.velocity, limits.force
        model.stiffness, model.corrected = rig_stiffness, int(corrected)
        for name, value in vars(sensors or Sensors()).items():
            setattr(read, name, value)
        parameters = compensator_parameters(compensator, step)
        data.step, data.sub_steps, data.unseen_delay, data.abort_displacement = step, sub_steps, unseen_delay, abort
        data.compensator, data.rig, data.sensors, data.specimen = parameters, model, read, self._specimen.handle
        data.force_scale, data.deformation_scale = scales
        self._outputs = 0
        keep = [parameters, model, read]
        if isinstance(numerical, FrameNumericalPart):
            keep += numerical.fill(data)
        elif numerical is not None:
            keep += self._fill_numerical(data, numerical)
        status, message = ffi.new("int *"), ffi.new("char[256]")
        handle = lib.ed_substructure_new(data, status, message, 256)
        if handle == ffi.NULL:
            raise CoreError(status_name(status[0]), ffi.string(message).decode(errors="replace"))
        self._handle = ffi.gc(handle, lib.ed_substructure_free)
        lib.ed_substructure_ask(handle, STOP)
        del keep

    def _fill_numerical(self, data: Any, numerical: Recursion) -> list[Any]:
        states, rows = len(numerical.A), len(numerical.C)
        shapes = {"A": (states, states), "B": (states, 4), "C": (rows, states), "D": (rows, 4)}
        data.n_states, data.n_outputs = states, rows - 3
        self._outputs = rows - 3
        keep = []
        for name, shape in shapes.items():
            values = np.ascontiguousarray(getattr(numerical, name), dtype=float)
            if values.shape != shape or states == 0 or rows < 3:
                raise ValueError(f"{name} has the shape {values.shape}, not {shape}")
            keep.append(ffi.from_buffer("double[]", values))
            setattr(data, name, keep[-1])
        return keep

    def run(self, drive: ArrayLike, seed: int = 0) -> LoopRecord:
        """Run the test from rest.

        Args:
            drive: (n,) ground acceleration, m/s2, or (n, 3) targets, at the beginnings of main steps and the end of the
                last.
            seed: of the noise of the sensors.

        Raises:
            CoreError: a value is not finite, or the law of the specimen or the frame failed; it says at which time.
            KeyboardInterrupt: the user stopped it.
        """
        values = np.ascontiguousarray(drive, dtype=float)
        given = self._numerical is None
        if values.ndim != (2 if given else 1) or len(values) < 2 or (given and values.shape[1] != 3):
            raise ValueError(f"drive has the shape {values.shape}")
        n, done = len(values) - 1, ffi.new("int *")
        frame = (
            self._numerical if isinstance(self._numerical, FrameNumericalPart) and self._numerical.channels else None
        )
        recording = (
            frame.analysis.record(frame.channels, n + 1, frame.steps, frame.limits, tail=n + 1, whole=True)
            if frame
            else None
        )
        record = np.empty((n + 1, lib.ED_RTS_CHANNELS + self._outputs))
        cpu = thread_time()
        status = lib.ed_substructure_run(
            self._handle, n, ffi.from_buffer("double[]", values), seed, ffi.from_buffer("double[]", record), done
        )
        cpu = thread_time() - cpu
        self._raise_if_failed(status, done[0])
        found = frame.analysis.recorded(recording, cpu=cpu) if frame and recording else None
        aborted = status == lib.ED_LIMIT
        if found is not None and recording is not None and aborted:
            passed = _passed(found, recording.limits, (done[0] - 1) * self.step)
            aborted = passed is None
            found = replace(found, status="failed" if aborted else "limit", passed=passed)
        return _recorded(record[: done[0]], aborted, found)

    def by_force(self, ground: ArrayLike, force: ArrayLike) -> np.ndarray:
        """Run the numerical part alone from rest, and return the target displacements (n,) in m.

        Args:
            ground: (n,) ground acceleration at main steps, m/s2.
            force: (n,) of the specimen, N.

        Raises:
            CoreError: a value is not finite, or the frame failed; it says at which time.
            KeyboardInterrupt: the user stopped it.
        """
        drive, known = (np.ascontiguousarray(values, dtype=float) for values in (ground, force))
        if drive.ndim != 1 or drive.shape != known.shape or not drive.size:
            raise ValueError(f"ground and force have the shapes {drive.shape} and {known.shape}")
        target, done = np.empty(drive.size), ffi.new("int *")
        buffers = (ffi.from_buffer("double[]", values) for values in (drive, known, target))
        self._raise_if_failed(lib.ed_substructure_by_force(self._handle, drive.size - 1, *buffers, done), done[0])
        return target[: done[0]]

    def _raise_if_failed(self, status: int, done: int) -> None:
        raise_if_stopped(status)
        if status < 0:
            why = ffi.string(lib.ed_substructure_message(self._handle)).decode(errors="replace")
            raise CoreError(status_name(status), f"substructure test: failed at {done * self.step:.6g} s: {why}")


def _passed(found: Response, limits: Mapping[str, float], time: float) -> Passed | None:
    """The channel furthest beyond its limit at the end, None if all are within."""
    beyond = {name: abs(found.final[name]) / limit for name, limit in limits.items()}
    worst = max(beyond, key=lambda name: beyond[name], default="")
    return Passed(worst, found.final[worst], time) if worst and beyond[worst] > 1.0 else None


def _recorded(record: np.ndarray, aborted: bool, frame: Response | None) -> LoopRecord:
    def of(channel: int) -> np.ndarray:
        return np.ascontiguousarray(record[:, channel])

    return LoopRecord(
        target=of(lib.ED_RTS_TARGET),
        target_velocity=of(lib.ED_RTS_TARGET_VELOCITY),
        target_acceleration=of(lib.ED_RTS_TARGET_ACCELERATION),
        command=of(lib.ED_RTS_COMMAND),
        measured=of(lib.ED_RTS_MEASURED),
        actuator=of(lib.ED_RTS_ACTUATOR),
        deformation=of(lib.ED_RTS_DEFORMATION),
        force=of(lib.ED_RTS_FORCE),
        true_force=of(lib.ED_RTS_TRUE_FORCE),
        applied_force=of(lib.ED_RTS_APPLIED_FORCE),
        alpha=record[:, lib.ED_RTS_ALPHA : lib.ED_RTS_ALPHA + 3].copy(),
        independence=of(lib.ED_RTS_INDEPENDENCE),
        limited=of(lib.ED_RTS_LIMITED).astype(int),
        saturated=of(lib.ED_RTS_SATURATED).astype(int),
        outputs=record[:, lib.ED_RTS_CHANNELS :].copy(),
        aborted=aborted,
        frame=frame,
    )
