"""Analyses of a model: static, pushover, modes, time histories."""

from __future__ import annotations

import time as clock
from collections import Counter
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
import scipy
from numpy.typing import ArrayLike

from edesign.core._edcore import ffi, lib
from edesign.core.errors import CoreError, status_name, with_code
from edesign.core.integrators import Integrator, Newmark
from edesign.core.model import Model
from edesign.core.modes import DENSE, Modes, natural_modes
from edesign.core.recording import Recording
from edesign.core.response import FALLBACK_NAMES, KINDS, Channel, Passed, Response, Watch
from edesign.core.stop import STOP, raise_if_stopped
from edesign.stopping import stoppable

STIFFNESS = {
    "initial": lib.ED_STIFFNESS_INITIAL,
    "committed": lib.ED_STIFFNESS_COMMITTED,
    "current": lib.ED_STIFFNESS_CURRENT,
}
SETTINGS = {
    "tolerance": lib.ED_TOLERANCE,
    "max_iterations": lib.ED_MAX_ITERATIONS,
    "element_tolerance": lib.ED_ELEMENT_TOLERANCE,
    "halvings": lib.ED_HALVINGS,
    "fast_elastic": lib.ED_FAST_ELASTIC,
    "reuse_factors": lib.ED_REUSE_FACTORS,
    "energy": lib.ED_ENERGY,
}
AVERAGE_ACCELERATION = Newmark()
DEFAULT_TOLERANCE = 1e-7  # as the core's
NO_LIMITS: Mapping[str, float] = {}
_SECONDS = 0.2  # seconds of computing between looks at the stop flag


def _doubles(array: np.ndarray | None) -> Any:
    return ffi.NULL if array is None else ffi.from_buffer("double[]", array)


@dataclass(frozen=True)
class SupportMotion:
    """A supported degree that moves relative to the ground, from rest.

    Attributes:
        node: its id.
        degree: "ux", "uy", ...; what is tied to it moves along.
        samples: displacement (m), velocity and acceleration, each (nt,), at the times of the ground acceleration.
    """

    node: int
    degree: str
    samples: tuple[ArrayLike, ArrayLike, ArrayLike]


class Analysis:
    """State of one structure and what can be done with it; a run starts from the state that the last one left.

    Several analyses may share a model and run in parallel threads: the core releases the interpreter lock.

    Args:
        model: the structure; it must not change afterwards.
        settings: tolerance (largest unbalance over largest force so far, default 1e-7), max_iterations, halvings,
            element_tolerance, fast_elastic, reuse_factors, energy.

    Raises:
        CoreError: the structure is a mechanism, nodes are disconnected (both named), or a setting is out of range.
    """

    def __init__(self, model: Model, **settings: float) -> None:
        status = ffi.new("int *")
        message = ffi.new("char[]", 1024)
        self.model = model
        self.tolerance = DEFAULT_TOLERANCE
        handle = lib.ed_analysis_new(model.freeze(), status, message, 1024)
        if handle == ffi.NULL:
            raise CoreError(status_name(status[0]), ffi.string(message).decode(errors="replace"))
        self._c = ffi.gc(handle, lib.ed_analysis_free)
        lib.ed_analysis_ask(handle, STOP)
        for name, value in settings.items():
            self.set(name, value)
        n_nodes = len(model.node_names)
        self.n_equations = int(lib.ed_n_equations(self._c))
        self.equations = np.empty((n_nodes, len(model.degrees)), dtype=np.int32)
        lib.ed_equations(self._c, ffi.from_buffer("int[]", self.equations))

    @property
    def handle(self) -> Any:
        """Handle of the core for substructure tests; it lives as long as this object."""
        return self._c

    @property
    def energy_error(self) -> float:
        """Balance of the energies over the largest input so far, at the end of the last run."""
        return float(self._statistics()["energy_error"])

    def record(
        self,
        channels: Sequence[Channel],
        rows: int,
        steps_a_row: int = 1,
        limits: Mapping[str, float] = NO_LIMITS,
        **kept: Any,
    ) -> Recording:
        """Let the run that is begun, or the substructure test that comes next, record channels and energies.

        Args:
            channels: in the place of all before.
            rows: how many there will be at most, with the one at the start.
            limits: as in `history`.
            **kept: which rows are kept, see `Recording`.

        Raises:
            ValueError: two channels have the same name, or a limit belongs to none.
            CoreError: a channel names what the model does not have, or a limit is not positive.
        """
        lib.ed_clear_channels(self._c)
        self._add_channels(channels)
        self._set_limits(channels, limits)
        recording = Recording(channels, limits, self._statistics(), rows, **kept)
        lib.ed_run_buffers(self._c, steps_a_row, *recording.buffers())
        return recording

    def recorded(self, recording: Recording, status: str = "completed", reason: str = "", cpu: float = 0.0) -> Response:
        """Return what a run has recorded, once it has ended.

        Args:
            status: see `Response`.
            reason: see `Response`.
            cpu: s.
        """
        recording.take_rest()
        extremes = [np.zeros(len(recording.channels)) for _ in range(5)]
        lib.ed_extremes(self._c, *(_doubles(e) for e in extremes))
        angles = np.zeros(len(recording.channels))
        lib.ed_angles(self._c, _doubles(angles))
        names = [c.name for c in recording.channels]
        maximum, at_maximum, minimum, at_minimum, last = (
            {name: float(v) for name, v in zip(names, e, strict=True)} for e in extremes
        )
        before, after = recording.before, self._statistics()
        statistics = {k: after[k] - before[k] for k in after if k not in ("worst_unbalance", "energy_error")}
        error = recording.balance.error(self.tolerance)
        statistics |= {"worst_unbalance": after["worst_unbalance"], "energy_error": error, "cpu_s": cpu}
        return Response(
            status=status,
            reason=reason,
            time=recording.time,
            values=recording.values,
            maximum=maximum,
            minimum=minimum,
            final=last,
            time_of_maximum=at_maximum,
            time_of_minimum=at_minimum,
            energy=recording.energy,
            events=self._events(),
            statistics=statistics,
            end=recording.end,
            tail=recording.tail,
            energy_final=recording.energy_final,
            start=recording.start,
            energy_start=recording.energy_start,
            angle={c.name: float(a) for c, a in zip(recording.channels, angles, strict=True) if c.beside is not None},
        )

    def _check(self, status: int) -> None:
        raise_if_stopped(status)
        if status < 0:
            raise CoreError(status_name(status), ffi.string(lib.ed_analysis_message(self._c)).decode(errors="replace"))

    def set(self, name: str, value: float) -> None:
        """Change a setting (see the class).

        Args:
            name: a key of `SETTINGS`.

        Raises:
            ValueError: there is no such setting.
        """
        if name not in SETTINGS:
            raise ValueError(f"unknown setting {name!r}; known: {', '.join(SETTINGS)}")
        self._check(lib.ed_set(self._c, SETTINGS[name], float(value)))
        if name == "tolerance":
            self.tolerance = float(value)

    def stiffness(self) -> scipy.sparse.csc_matrix:
        """Return the tangent stiffness over the equations at the present state, N/m."""
        n = self.n_equations
        return scipy.sparse.csc_matrix(self._stiffness_columns(), shape=(n, n))

    def dense_stiffness(self) -> np.ndarray:
        """Return the stiffness as a full matrix (n_equations, n_equations), for small structures.

        The function does not load scipy.sparse.
        """
        n = self.n_equations
        value, row, start = self._stiffness_columns()
        dense = np.zeros((n, n))
        dense[row, np.repeat(np.arange(n), np.diff(start))] = value
        return dense

    def _stiffness_columns(self) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Entries of the stiffness column by column, their rows, and where each column begins."""
        n, nnz = self.n_equations, int(lib.ed_n_nonzeros(self._c))
        start, row, value = np.empty(n + 1, np.int32), np.empty(nnz, np.int32), np.empty(nnz)
        lib.ed_stiffness(
            self._c, ffi.from_buffer("int[]", start), ffi.from_buffer("int[]", row), ffi.from_buffer("double[]", value)
        )
        return value, row, start

    def masses(self) -> np.ndarray:
        """Return the lumped masses (n_equations,) in kg and kg m2."""
        mass = np.empty(self.n_equations)
        lib.ed_mass(self._c, ffi.from_buffer("double[]", mass))
        return mass

    def modes(self, count: int, damper_stiffness: ArrayLike | None = None) -> Modes:
        """Return the lowest natural modes at the present state.

        Args:
            count: how many.
            damper_stiffness: (n_dampers,) N/m that the dampers add; None: nothing.

        Raises:
            CoreError: the structure is unstable in this state.
        """
        if damper_stiffness is None and lib.ed_unstable_directions(self._c) > 0:
            raise CoreError("ED_E_UNSTABLE", "the structure is unstable in its present state: it has no natural modes")
        influence = np.zeros((self.model.dimension, self.n_equations))
        for axis, along in enumerate(influence):
            free = self.equations[:, axis] >= 0
            along[self.equations[free, axis]] = 1.0
        stiffness: np.ndarray | scipy.sparse.csc_matrix
        if damper_stiffness is not None:
            along = self.damper_directions()
            added = along.T @ scipy.sparse.diags(np.asarray(damper_stiffness)) @ along
            stiffness = (self.stiffness() + added).tocsc()
        else:
            stiffness = self.dense_stiffness() if self.n_equations <= DENSE else self.stiffness()
        modes = natural_modes(stiffness, self.masses(), self.equations, influence, count)
        for node, master in self.model.masters.items():
            modes.shapes[:, node, :2] += modes.shapes[:, master, 5:] * self.model.levers(node)
        return modes

    def damper_directions(self) -> scipy.sparse.csr_matrix:
        """Return the deformation of each damper by displacements of the equations, (n_dampers, n_equations)."""
        return self.along(self.model.damper_terms)

    def along(self, sums: Sequence[Sequence[tuple[float, int, int]]]) -> scipy.sparse.csr_matrix:
        """Return sums of degrees by displacements of the equations, (n, n_equations); supports do not move.

        Args:
            sums: (coefficient, node, degree) of what is added up in each, diaphragms included.
        """
        rows, columns, values = [], [], []
        for row, terms in enumerate(sums):
            for coefficient, node, degree in self.model.on_masters(terms):
                if self.equations[node, degree] >= 0:
                    rows.append(row)
                    columns.append(self.equations[node, degree])
                    values.append(coefficient)
        return scipy.sparse.csr_matrix((values, (rows, columns)), shape=(len(sums), self.n_equations))

    def install_dampers(self) -> None:
        """Let the dampers act from now on; their deformation counts from the present state."""
        self._check(lib.ed_install_dampers(self._c))

    def rayleigh(self, a0: float, a1: float, stiffness: str = "current") -> None:
        """Set the damping a0 M + a1 K.

        Args:
            a0: 1/s.
            a1: s.
            stiffness: "initial", "committed" or "current" K.
        """
        self._check(lib.ed_rayleigh(self._c, a0, a1, STIFFNESS[stiffness]))

    def modal_damping(self, modes: Modes, ratio: ArrayLike) -> None:
        """Set the damping ratio of each of the modes.

        Args:
            modes: n modes of the structure.
            ratio: of critical, a number or (n,).

        Source: Chopra 2012, Eq. 11.4.5.
        """
        shapes = np.ascontiguousarray(modes.equations)
        omega = np.ascontiguousarray(modes.omega)
        ratios = np.ascontiguousarray(np.broadcast_to(np.asarray(ratio, dtype=float), omega.shape))
        self._check(
            lib.ed_modal_damping(self._c, omega.size, _doubles(shapes.ravel()), _doubles(omega), _doubles(ratios))
        )

    def initial_velocity(self, velocity: ArrayLike) -> None:
        """Set the velocities at the start of the next history.

        Args:
            velocity: (n_equations,) m/s.

        Raises:
            ValueError: the shape is not that of the equations.
        """
        v = np.ascontiguousarray(velocity, dtype=float)
        if v.shape != (self.n_equations,):
            raise ValueError(f"{v.size} velocities for {self.n_equations} equations")
        self._check(lib.ed_initial_velocity(self._c, _doubles(v)))

    def state(self) -> np.ndarray:
        """Return a copy of the whole committed state.

        Returns:
            (n,), for `restore`.
        """
        state = np.empty(int(lib.ed_state_size(self._c)))
        lib.ed_state_get(self._c, ffi.from_buffer("double[]", state))
        return state

    def restore(self, state: np.ndarray) -> None:
        """Return to a state from `state()`.

        Args:
            state: from `state()`.

        Raises:
            ValueError: the state belongs to another analysis.
        """
        if state.shape != (int(lib.ed_state_size(self._c)),):
            raise ValueError("this state belongs to another analysis")
        self._check(lib.ed_state_set(self._c, _doubles(np.ascontiguousarray(state))))

    def static(
        self,
        pattern: int,
        factor: float = 1.0,
        steps: int = 1,
        channels: Sequence[Channel] = (),
        limits: Mapping[str, float] = NO_LIMITS,
        watch: Watch | None = None,
    ) -> Response:
        """Bring a pattern to a factor in equal steps (load control); it stays on for later runs.

        Args:
            factor: of the pattern at the end.
            steps: how many.
            channels: what to record.
            limits: as in `history`.
            watch: as in `history`.
        """
        self._check(lib.ed_static_begin(self._c, pattern, factor, steps))
        return self._run(steps, channels, 1, None, None, limits, watch=watch)

    def pushover(
        self,
        pattern: int,
        node: int,
        degree: str,
        target: float,
        steps: int,
        channels: Sequence[Channel] = (),
        progress: Callable[[int, int], None] | None = None,
        stop: Callable[[], bool] | None = None,
        limits: Mapping[str, float] = NO_LIMITS,
        watch: Watch | None = None,
    ) -> Response:
        """Move a degree in equal steps under a pattern of nodal loads (displacement control).

        Args:
            degree: "ux", "uy", ...
            target: displacement at the end, m or rad.
            steps: how many.
            channels: what to record.
            progress: called with (steps done, steps) now and then.
            stop: asked now and then; True ends the run.
            limits: as in `history`.
            watch: as in `history`.
        """
        self._check(lib.ed_pushover_begin(self._c, pattern, node, self.model.degrees.index(degree), target, steps))
        return self._run(steps, channels, 1, progress, stop, limits, watch=watch)

    def history(
        self,
        ground_acceleration: ArrayLike,
        dt: float,
        method: Integrator = AVERAGE_ACCELERATION,
        channels: Sequence[Channel] = (),
        every: int = 1,
        vertical: ArrayLike | None = None,
        progress: Callable[[int, int], None] | None = None,
        stop: Callable[[], bool] | None = None,
        limits: Mapping[str, float] = NO_LIMITS,
        tail: int = 0,
        energies: bool = True,
        supports: Sequence[SupportMotion] = (),
        along_y: ArrayLike | None = None,
        watch: Watch | None = None,
    ) -> Response:
        """Run a time history under ground acceleration.

        Args:
            ground_acceleration: (nt,) m/s2 along x, `dt` s apart; the first sample is at time 0.
            dt: step of the samples, s.
            channels: what to record.
            every: every so many steps are kept, extremes and the balance of the energies count every step. 0: only the
                start is kept, and energies are not counted in between.
            vertical: (nt,) m/s2 upwards.
            progress: called with (steps done, steps) now and then.
            stop: asked now and then; True ends the run with status "interrupted".
            limits: by name of a channel; the run ends with status "limit" in the step in which its magnitude passes it.
            tail: how many of the last steps are kept of channels with a tail.
            energies: whether the energies of the steps that are kept are kept as well.
            supports: supported degrees that move relative to the ground.
            along_y: (nt,) m/s2 along y of a structure in space.
            watch: sees the channels that are watched in every step.

        Returns:
            Response; status "failed" with the reason when equilibrium was lost (what was computed before is in it).

        Raises:
            ValueError: a limit belongs to no channel, or a plane frame is shaken along y.
            CoreError: a limit is not positive; a degree has no support or is not at rest, or the structure is unstable.
        """
        if along_y is not None and self.model.dimension == 2:
            raise ValueError("a plane frame has no motion along y; upwards it is vertical")
        across, upwards = (along_y, vertical) if self.model.dimension == 3 else (vertical, along_y)
        given = (ground_acceleration, across, upwards)
        ground = [None if one is None else np.ascontiguousarray(one, dtype=float) for one in given]
        shape = np.shape(ground_acceleration)
        if len(shape) != 1 or shape[0] < 2 or any(one is not None and one.shape != shape for one in ground):
            raise ValueError("ground acceleration needs at least two samples, and as many in every direction")
        kind, parameters = method.parameters()
        samples, steps = shape[0], shape[0] - 1
        self._check(lib.ed_history_begin(self._c, steps, dt, *(_doubles(one) for one in ground), kind, parameters))
        try:
            self._move_supports(supports, samples)
        except (CoreError, ValueError):
            lib.ed_run_end(self._c)
            raise
        return self._run(steps, channels, every, progress, stop, limits, tail=tail, energies=energies, watch=watch)

    def _move_supports(self, supports: Sequence[SupportMotion], samples: int) -> None:
        for motion in supports:
            parts = [np.ascontiguousarray(part, dtype=float) for part in motion.samples]
            if any(part.shape != (samples,) for part in parts):
                raise ValueError("the motion of a support has as many samples as that of the ground")
            degree = self.model.degrees.index(motion.degree)
            self._check(lib.ed_history_support(self._c, motion.node, degree, *(_doubles(part) for part in parts)))

    def _add_channels(self, channels: Sequence[Channel]) -> None:
        repeated = {name for name, count in Counter(c.name for c in channels).items() if count > 1}
        if repeated:
            raise ValueError(f"channels of the same name: {', '.join(sorted(repeated))}")
        numbers: dict[str, int] = {}
        for channel in channels:
            status = self._add_channel(channel, numbers)
            numbers[channel.name] = status
            if status < 0:
                message = ffi.string(lib.ed_analysis_message(self._c)).decode(errors="replace")
                raise CoreError(status_name(status), f"channel {channel.name}: {message}")

    def _add_channel(self, channel: Channel, numbers: Mapping[str, int]) -> int:
        """Add a channel after those with `numbers`; the return is its own, or a status below zero."""
        if channel.beside is not None:
            for name in channel.beside:
                if name not in numbers:
                    raise ValueError(
                        f"channel {channel.name} is the resultant of {name}, which does not come before it"
                    )
            if channel.terms:
                raise ValueError(f"channel {channel.name} is a resultant and has terms")
            first, second = (numbers[name] for name in channel.beside)
            return int(lib.ed_channel_root(self._c, first, second, channel.written))
        coefficients, kinds, objects, components = zip(*channel.terms, strict=True) if channel.terms else ((),) * 4
        return int(
            lib.ed_channel(
                self._c,
                len(kinds),
                [float(c) for c in coefficients],
                [KINDS[kind] for kind in kinds],
                [int(i) for i in objects],
                [int(k) for k in components],
                channel.written,
            )
        )

    def _set_limits(self, channels: Sequence[Channel], limits: Mapping[str, float]) -> None:
        number = {channel.name: i for i, channel in enumerate(channels)}
        unknown = [name for name in limits if name not in number]
        if unknown:
            raise ValueError(f"limits of channels that are not recorded: {', '.join(unknown)}")
        for name, limit in limits.items():
            self._check(lib.ed_channel_limit(self._c, number[name], float(limit)))

    def _run(
        self,
        steps: int,
        channels: Sequence[Channel],
        every: int,
        progress: Callable[[int, int], None] | None,
        stop: Callable[[], bool] | None,
        limits: Mapping[str, float] = NO_LIMITS,
        **kept: Any,
    ) -> Response:
        try:
            return self._advance(steps, channels, every, progress, stop, limits, **kept)
        finally:
            lib.ed_run_end(self._c)

    def _advance(
        self,
        steps: int,
        channels: Sequence[Channel],
        every: int,
        progress: Callable[[int, int], None] | None,
        stop: Callable[[], bool] | None,
        limits: Mapping[str, float],
        **kept: Any,
    ) -> Response:
        rows, steps_a_row = (steps + 1, 1) if every else (1, steps + 1)
        recording = self.record(channels, rows, steps_a_row, limits, every=max(every, 1), **kept)
        status, reason, done, piece = "completed", "", 0, 1
        passed: Passed | None = None
        cpu = 0.0
        while done < steps:
            wall, start = clock.perf_counter(), clock.thread_time()
            with stoppable(stop):
                result = lib.ed_run_advance(self._c, piece)
            cpu += clock.thread_time() - start
            wall = clock.perf_counter() - wall
            recording.take(lib.ed_run_take_rows(self._c))
            done = int(lib.ed_run_steps_done(self._c))
            if result == lib.ED_E_STOPPED and stop is not None and stop():
                status, reason = "interrupted", f"stopped after {done} of {steps} steps"
                break
            raise_if_stopped(result)
            if result < 0:
                message = ffi.string(lib.ed_analysis_message(self._c)).decode(errors="replace")
                status, reason = "failed", with_code(result, message)
                break
            if result == lib.ED_LIMIT:
                passed = self._passed(channels)
                status, reason = "limit", f"{passed.channel} reached {passed.value:.6g} at {passed.time:.6g} s"
                break
            if progress is not None:
                progress(done, steps)
            if stop is not None and done < steps and stop():
                status, reason = "interrupted", f"stopped after {done} of {steps} steps"
                break
            piece = max(1, min(4 * piece, int(piece * _SECONDS / max(wall, 1e-6)), recording.piece))
        lib.ed_run_end(self._c)
        return replace(self.recorded(recording, status, reason, cpu), passed=passed)

    def _passed(self, channels: Sequence[Channel]) -> Passed:
        value, time = ffi.new("double *"), ffi.new("double *")
        channel = int(lib.ed_run_limit(self._c, value, time))
        return Passed(channels[channel].name, value[0], time[0])

    def _statistics(self) -> dict[str, float]:
        s = ffi.new("ed_statistics *")
        lib.ed_get_statistics(self._c, s)
        names = [name for name, _ in ffi.typeof("ed_statistics").fields]
        return {name: getattr(s, name) for name in names}

    def _events(self) -> list[dict[str, object]]:
        events: list[dict[str, object]] = []
        e = ffi.new("ed_event *")
        for i in range(int(lib.ed_n_events(self._c))):
            lib.ed_get_event(self._c, i, e)
            events.append(
                {
                    "time": e.time,
                    "step": e.step,
                    "fallback": FALLBACK_NAMES[e.fallback],
                    "halvings": e.level,
                    "success": bool(e.success),
                    "iterations": e.iterations,
                }
            )
        return events
