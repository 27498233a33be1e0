"""The virtual test rig: runs a programme of tests on a law and writes what a real campaign would."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from itertools import product
from pathlib import Path

import numpy as np

from edesign.damper.damper import Damper
from edesign.damper.effects_file import read_effects
from edesign.damper.laws import law as law_of
from edesign.damper.parameters import read_parameters
from edesign.damper.testing import signals
from edesign.damper.testing.campaign import Campaign, write_campaign
from edesign.damper.testing.measured_files import read_displacement
from edesign.damper.testing.measured_histories import DamperTest
from edesign.damper.testing.programme_file import Programme, RandomTest, RecordTest, SineTest, SweepTest
from edesign.damper.testing.properties import Properties, properties
from edesign.damper.testing.property_table import from_properties, usable, write_property_table
from edesign.damper.testing.specimen import Specimen
from edesign.errors import AnalysisError, InputError
from edesign.optional_stages import optional

PROPERTIES_FILE = "properties.csv"
Progress = Callable[[int, int, str], None]
"""Called before each test with its number from 1, how many there are, its name."""


@dataclass(frozen=True)
class ProgrammeRun:
    """Results of a test programme.

    Attributes:
        campaign: as written.
        properties: of each steady sine with enough cycles, by name of the test.
        warnings: of the law at the temperatures asked for, and of sines too short for properties.
    """

    campaign: Campaign
    properties: dict[str, Properties]
    warnings: tuple[str, ...]


def run_programme(programme: Programme, folder: Path | str, progress: Progress | None = None) -> ProgrammeRun:
    """Run all tests of a programme, and write NAME.csv of each, campaign.yaml, and properties.csv of the sines.

    Args:
        programme: from `load_programme`.
        folder: made if it does not exist.
        progress: called before each test.

    Raises:
        InputError: parameters or a test are wrong.
        AnalysisError: the law could not follow a test; the message names it.
        ArchiveError: a file cannot be written.
    """
    folder = Path(folder)
    specimen, law = programme.specimen.specimen, law_of(programme.law.type)
    assert programme.law.parameters is not None  # checked by load_programme
    reference = Damper(law, read_parameters(law, programme.law.parameters), effects=read_effects(programme.law.effects))
    planned = list(planned_tests(programme, specimen))
    tests, found = [], {}
    warnings: dict[str, None] = {}
    dampers: dict[float, Damper] = {}
    for i, (plan, test) in enumerate(planned):
        if progress is not None:
            progress(i + 1, len(planned), test.name)
        celsius = test.temperature_C
        if celsius not in dampers:
            dampers[celsius], said = reference.at(celsius)
            warnings.update(dict.fromkeys(said))
        try:
            force = dampers[celsius].force(test.time, test.displacement)
        except AnalysisError as error:
            raise AnalysisError(f"test {test.name}: {error}") from error
        tests.append(test.with_force(_measured(force, programme, i)))
        if isinstance(plan, SineTest) and specimen is not None:
            try:
                with optional(f"the properties of {test.name}", passing=(InputError,)):
                    found[test.name] = properties(tests[-1], specimen)
            except InputError as error:
                warnings[f"no properties: {error}"] = None
    title = programme.title or f"Virtual tests of {law.title}"
    campaign = write_campaign(folder, specimen, tests, programme.law.choice, title, programme.specimen.name)
    if specimen is None:
        warnings[f"no moduli of a specimen without layers; `edesign sheet {campaign.path}` has the device's own"] = None
    path = folder / PROPERTIES_FILE
    rows, notes = usable(found)
    warnings.update(dict.fromkeys(notes))
    if rows:
        write_property_table(from_properties(rows, str(path)), path)
    else:
        path.unlink(missing_ok=True)  # of a campaign that was replaced
    return ProgrammeRun(campaign, found, tuple(warnings))


def planned_tests(
    programme: Programme, specimen: Specimen | None
) -> Iterator[tuple[SineTest | SweepTest | RandomTest | RecordTest, DamperTest]]:
    """Yield the tests without force, in the order in which they are run.

    The last named value of lists changes fastest. The order of a full factorial is temperature, frequency, strain: a
    rig heats its specimen as seldom as it can.

    Args:
        specimen: the layers that are sheared; None: a device without layers.

    Raises:
        InputError: a test of the programme cannot be made.
    """
    number = 0
    for plan in programme.tests:
        displacements: tuple[float | None, ...] = plan.displacement or (None,)
        if plan.strain:
            assert specimen is not None  # checked by load_programme
            displacements = tuple(specimen.displacement(strain) for strain in plan.strain)
        frequencies: tuple[float | None, ...] = (None,)
        if isinstance(plan, (SineTest, SweepTest)):
            frequencies = plan.frequency
        for celsius, frequency, displacement in product(plan.celsius, frequencies, displacements):
            number += 1
            what: list[str] = [plan.type]
            if displacement is not None:
                what.append(
                    f"{1e3 * displacement:.4g}mm"
                    if specimen is None
                    else f"{100.0 * specimen.strain(displacement):.4g}pct"
                )
            if frequency is not None:
                what.append(f"{frequency:g}Hz")
            title = plan.title or " ".join(what).replace("pct", " %").replace("mm", " mm").replace("Hz", " Hz")
            name = f"{number:03d}_{'_'.join([*what, f'{celsius:g}C'])}"
            try:
                time, u = _history(plan, displacement, frequency, programme)
            except InputError as error:
                raise InputError(f"{programme.path}: test {name}: {error}") from error
            yield plan, DamperTest(name, time, u, None, celsius, None, title, plan.use)


def _history(
    plan: SineTest | SweepTest | RandomTest | RecordTest,
    displacement: float | None,
    frequency: float | None,
    programme: Programme,
) -> signals.History:
    rate = programme.sampling_rate
    if isinstance(plan, RecordTest):
        time, u = read_displacement(programme.path.parent / plan.file)
        return signals.from_record(time, u, displacement, rate)
    assert displacement is not None  # checked by load_programme
    if isinstance(plan, RandomTest):
        level = {plan.level: displacement}
        return signals.random(plan.duration, plan.band, plan.seed, **level, sampling_rate=rate)
    assert frequency is not None
    if isinstance(plan, SineTest):
        return signals.sine(displacement, frequency, plan.cycles, plan.ramp_up, plan.ramp_down, rate)
    return signals.sweep_4_4(displacement, frequency, plan.blend, rate)


def _measured(force: np.ndarray, programme: Programme, index: int) -> np.ndarray:
    """The force as a noisy channel gives it; each test has noise of its own."""
    noise = programme.noise
    if noise is None or noise.force == 0.0:
        return force
    generator = np.random.default_rng([noise.seed, index])
    return force + noise.force * float(np.max(np.abs(force))) * generator.standard_normal(force.size)
