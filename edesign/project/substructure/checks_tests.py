"""Cross checks of the tests: names, records, and commands that the rig can follow."""

from __future__ import annotations

import math

from edesign.project.checks.records import check_record, check_record_files
from edesign.project.reading.checks_files import check_file
from edesign.project.reading.problems import Keys, Problems, unknown_name
from edesign.project.records.records import ChosenRecords, record_of
from edesign.project.substructure.checks_rig import nyquist
from edesign.project.substructure.programme import (
    Command,
    CommandInFile,
    CommandTest,
    PseudoDynamicTest,
    RandomCommand,
    RecordTest,
    RtsTest,
    SineCommand,
    SweepCommand,
    Undershoot,
)
from edesign.project.substructure.rts_file import RtsFile
from edesign.project.substructure.structure import ProjectStructure

MOST_STEPS = 5_000_000
"""Main steps of a test: more than an hour at 1 kHz, and a GB of memory."""
_WHAT = "substructure test file"


def check_tests(rts: RtsFile, problems: Problems) -> None:
    """Check tests, records and outputs; the rig of the file is known."""
    if rts.structure is None and not rts.tests:
        message = "there is nothing to test; give the `structure`, or `tests` of the kind `command` [E-KEY-02]"
        problems.at_key(("compensators",), message)
    first: dict[str, int] = {}
    for i, test in enumerate(rts.tests):
        keys: Keys = ("tests", i)
        if test.name in first:
            message = f"`{test.name}` is already the name of tests[{first[test.name]}]; choose another [E-NAME-02]"
            problems.at_value((*keys, "name"), message)
        first.setdefault(test.name, i)
        if isinstance(test, CommandTest):
            _command(rts, test.command, (*keys, "command"), problems)
            continue
        if isinstance(test, PseudoDynamicTest) and isinstance(test.error, Undershoot) and test.error.share >= 1.0:
            message = (
                "an actuator that stops short by all of its way does not move; the share is below 100 % [E-VALUE-02]"
            )
            problems.at_value((*keys, "error", "share"), message)
        if isinstance(test, PseudoDynamicTest) and test.time_scale < 1.0:
            message = "a pseudo-dynamic test is not faster than the earthquake; 1 is real time [E-RTS-06]"
            problems.at_value((*keys, "time_scale"), message)
        if rts.structure is None:
            message = f"a test of the kind `{test.kind}` needs the `structure`, and the file has none [E-KEY-02]"
            problems.at_value((*keys, "kind"), message)
            continue
        if rts.may_yield and not isinstance(test, RtsTest):
            message = (
                f"`{test.kind}` takes the frame's linear tangent, and `structure.frame: nonlinear` asks for all that "
                "yields (allowed with it: `rts`, `command`; or `frame: linear`) [E-PART-06]"
            )
            problems.at_value((*keys, "kind"), message)
        _record(rts, test, keys, problems)
    _records(rts, problems)
    _outputs(rts, problems)


# --- records


def _record(rts: RtsFile, test: RecordTest, keys: Keys, problems: Problems) -> None:
    if isinstance(rts.structure, ProjectStructure) and (rts.project is None or _says_analysis(rts, test)):
        return  # what is wrong with project or analysis is reported there
    of_project = rts.project.records if rts.project is not None else {}
    known = {**rts.records, **of_project}
    if test.record is None:
        message = (
            "this key is missing; the `analysis` of the `structure` would say it too, and none is named [E-KEY-02]"
        )
        problems.under(keys, "record", message)
    elif record_of(test.record) not in known:
        problems.at_value((*keys, "record"), unknown_name("record", record_of(test.record), known))


def _says_analysis(rts: RtsFile, test: RecordTest) -> bool:
    """Whether a test takes its record from an analysis."""
    structure = rts.structure
    return test.record is None and isinstance(structure, ProjectStructure) and structure.analysis is not None


def _records(rts: RtsFile, problems: Problems) -> None:
    for name, record in rts.records.items():
        keys: Keys = ("records", name)
        check_record(record, keys, problems)
        if record.fitted:
            message = "a record is fitted to the spectrum of a hazard; give such a record in the project [E-SCALE-03]"
            problems.at_key((*keys, "choose" if isinstance(record, ChosenRecords) else "match"), message)
    check_record_files(rts.records, rts.folder, problems, _WHAT)


# --- commands


def _command(rts: RtsFile, command: Command, keys: Keys, problems: Problems) -> None:
    if isinstance(command, CommandInFile):
        check_file(rts.folder / command.file, (*keys, "file"), problems, _WHAT)
    if command.displacement is not None:
        _amplitude(rts, command.displacement, (*keys, "displacement"), problems)
    if isinstance(command, (RandomCommand, SweepCommand)):
        _band(rts, command, keys, problems)
    elif isinstance(command, SineCommand):
        for i, frequency in enumerate(command.frequency):
            _below_nyquist(rts, frequency, (*keys, "frequency"), i, problems)
        _speed(rts, command.displacement, max(command.frequency), keys, problems)
        seconds = sum(command.cycles / frequency for frequency in command.frequency)
        _length(rts, seconds, (*keys, "cycles"), problems)


def _amplitude(rts: RtsFile, displacement: float, keys: Keys, problems: Problems) -> None:
    """The peak is within stroke and range, and above the noise."""
    stroke, reach = rts.plant.limits.stroke, rts.displacement_range
    shown = f"{1e3 * displacement:.4g} mm"
    if stroke is not None and displacement > stroke:
        problems.at_value(keys, f"{shown} is beyond the stroke of the actuator, {1e3 * stroke:.4g} mm [E-RIG-06]")
    elif reach is not None and displacement > reach:
        problems.at_value(keys, f"{shown} is beyond the range of the encoder, {1e3 * reach:.4g} mm [E-RIG-06]")
    if displacement <= rts.encoder_noise:
        message = f"{shown} is lost in the noise of the encoder, {1e3 * rts.encoder_noise:.4g} mm [E-RIG-06]"
        problems.at_value(keys, message)


def _band(rts: RtsFile, command: RandomCommand | SweepCommand, keys: Keys, problems: Problems) -> None:
    low, high = command.band
    at = (*keys, "band")
    if isinstance(command, RandomCommand) and low >= high:
        problems.at_value(at, f"{low:g} Hz is not below {high:g} Hz; the lower frequency stands first [E-VALUE-04]")
    elif low == high:
        problems.at_value(at, f"the frequency stays at {low:g} Hz; `type: sine` does that [E-RTS-06]")
    for i, frequency in enumerate(command.band):
        _below_nyquist(rts, frequency, at, i, problems)
    if command.duration * max(low, high) < 1.0:
        problems.at_value(
            (*keys, "duration"), f"{command.duration:.4g} s is less than a cycle of {high:g} Hz [E-VALUE-04]"
        )
    if isinstance(command, SweepCommand):
        _speed(rts, command.displacement, max(low, high), keys, problems)
    _length(rts, command.duration, (*keys, "duration"), problems)


def _below_nyquist(rts: RtsFile, frequency: float, keys: Keys, i: int, problems: Problems) -> None:
    if frequency >= nyquist(rts):
        message = f"{frequency:.4g} Hz is not below half the rate of the main step, {nyquist(rts):.4g} Hz [E-VALUE-04]"
        problems.at_item(keys, i, message)


def _speed(rts: RtsFile, displacement: float, frequency: float, keys: Keys, problems: Problems) -> None:
    """The peak velocity of a sine is one that the actuator reaches."""
    limit = rts.plant.limits.velocity
    velocity = 2.0 * math.pi * frequency * displacement
    if limit is not None and velocity > limit:
        message = f"{1e3 * displacement:.4g} mm at {frequency:.4g} Hz is {velocity:.3g} m/s, beyond the velocity of the"
        problems.at_value((*keys, "displacement"), f"{message} actuator, {limit:.3g} m/s [E-RIG-06]")


def _length(rts: RtsFile, seconds: float, keys: Keys, problems: Problems) -> None:
    if seconds > MOST_STEPS * rts.loop.main_step:
        message = f"{seconds:.3g} s has more than {MOST_STEPS} main steps; make the test shorter [E-RTS-01]"
        problems.at_value(keys, message)


# --- outputs


def _outputs(rts: RtsFile, problems: Problems) -> None:
    archive = rts.outputs.archive
    if archive is not None and not archive.endswith((".h5", ".hdf5", ".nc")):
        problems.at_value(("outputs", "archive"), f"`{archive}` needs the ending .h5, .hdf5 or .nc [E-FILE-08]")
    for i, kind in enumerate(rts.outputs.histories):
        if kind in rts.outputs.histories[:i]:
            problems.at_value(("outputs", "histories", i), f"`{kind}` comes twice [E-NAME-02]")
