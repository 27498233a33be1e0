"""What drives a virtual test: the ground motion of a record at main steps, or given targets."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from edesign.errors import InputError
from edesign.ground_motion.project_records import find_recordings
from edesign.project.substructure.checks_tests import MOST_STEPS
from edesign.project.substructure.programme import CommandTest, RecordTest
from edesign.project.substructure.rts_file import RtsFile
from edesign.substructure.commands import command_motion


@dataclass(frozen=True)
class Drive:
    """Ground motion or commands that drive a test.

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
        """Target displacements (n,) m that are given; zeros where the structure makes them."""
        return np.zeros(self.time.size) if self.target is None else self.target[:, 0]


def drive_of(file: RtsFile, test: CommandTest | RecordTest) -> Drive:
    """Return what drives a test.

    Raises:
        InputError: its record or command cannot be read.
    """
    step = file.loop.main_step
    if isinstance(test, CommandTest):
        target = command_motion(test.command, step, file.folder)
        _refuse_rest(file, test, target)
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
            " [E-RTS-01]"
        )
    time = np.arange(0.0, last + 0.5 * step, step)
    ground = scale * np.interp(time, record.time, record.acceleration, right=0.0)
    _refuse_rest(file, test, ground)
    said = f"{motion.record} x {scale:.4g}"
    if record.time_step > 1.001 * step:
        said += f", linear between its samples {1e3 * record.time_step:.4g} ms apart"
    left_out = ""
    if step > 1.001 * record.time_step:
        whole, kept = abs(scale) * record.pga, float(np.max(np.abs(ground)))
        left_out = (
            f"the record {motion.record} has samples {1e3 * record.time_step:.4g} ms apart, and main steps of "
            f"{1e3 * step:.4g} ms leave some out: of its peak of {whole:.4g} m/s2 {kept:.4g} m/s2 act; take main "
            "steps no longer than its own"
        )
    return Drive(time, ground, None, said, motion.record, left_out)


def _refuse_rest(file: RtsFile, test: CommandTest | RecordTest, driving: np.ndarray) -> None:
    if not np.any(driving):
        where = file.where("tests", file.tests.index(test))
        raise InputError(f"{where}: test {test.name}: what drives it is zero from beginning to end [E-RTS-02]")
