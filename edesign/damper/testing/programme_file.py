"""Programmes of damper tests for the virtual rig: the form of the YAML file."""

from __future__ import annotations

import math
from collections.abc import Callable
from pathlib import Path
from typing import Annotated, Any, Literal

from pydantic import Field, PrivateAttr
from pydantic_core import PydanticCustomError

from edesign.damper.effects_file import EffectsError, read_effects
from edesign.damper.testing.campaign_blocks import (
    LawBlock,
    SpecimenBlock,
    Text,
    check_law,
    check_one,
    check_specimen,
    is_campaign,
    parse_celsius,
)
from edesign.damper.testing.measured_histories import Use
from edesign.errors import InputError
from edesign.project.dampers.dampers import Effect
from edesign.project.notation.quantities import FREQUENCY, LENGTH
from edesign.project.notation.temperature import TEMPERATURE_TEXT, parse_temperature
from edesign.project.notation.units import PositiveTime, parse_quantity, parse_ratio, written_ratio
from edesign.project.notation.written import SchemaMaker, Written, given, one_or_list_of, quantity, ratio
from edesign.project.reading.base import Model, refuse
from edesign.project.reading.file_bytes import is_file
from edesign.project.reading.one_of import OneOf
from edesign.project.reading.problems import FileProblems, Problems
from edesign.project.reading.yaml_file import check_model, read_yaml_text

LARGEST_STRAIN = 10.0  # no elastomer shears so far: `50` is meant as `50 %`
MOST_TESTS = 1000  # of one entry
_WHAT, _BEGINS = "programme file", "specimen:"


class ProgrammeError(FileProblems):
    """Error: a programme file is wrong."""


def parse_frequency(value: Any) -> float:
    """Read a frequency such as `0.5 Hz`, in Hz.

    Raises:
        PydanticCustomError: it is none, or a circular frequency.
    """
    if "rad" in str(value) or "rpm" in str(value):
        raise refuse(f"`{value}` is an angular velocity; write the frequency in Hz, for example `0.5 Hz` [E-UNIT-02]")
    return parse_quantity(value, FREQUENCY, "positive")


def _several(parse: Callable[[Any], float], schema: SchemaMaker) -> Written:
    """One value or a list of them."""

    def read(value: Any) -> tuple[float, ...]:
        if not isinstance(value, (tuple, list)):
            return (parse(value),)
        if not value:
            raise refuse("the list is empty [E-PROG-01]")
        found = []
        for i, item in enumerate(value):
            try:
                found.append(parse(item))
            except PydanticCustomError as error:
                raise refuse(error.message(), i) from None
        return tuple(found)

    return Written(read, one_or_list_of(schema))


Frequency = Annotated[float, Written(parse_frequency, quantity(FREQUENCY, "positive"))]
Frequencies = Annotated[tuple[float, ...], _several(parse_frequency, quantity(FREQUENCY, "positive"))]
Strains = Annotated[
    tuple[float, ...],
    _several(
        lambda value: parse_ratio(value, 0.0, LARGEST_STRAIN, low_allowed=False),
        ratio(0.0, LARGEST_STRAIN, low_allowed=False),
    ),
]
Displacements = Annotated[
    tuple[float, ...], _several(lambda value: parse_quantity(value, LENGTH, "positive"), quantity(LENGTH, "positive"))
]
Temperatures = Annotated[tuple[float, ...], _several(parse_temperature, TEMPERATURE_TEXT)]
CelsiusList = Annotated[tuple[float, ...], _several(parse_celsius, given({"type": "number"}))]


class _Test(Model):
    """What all tests share; a list makes a test of each value.

    Attributes:
        strain: largest shear strain, one or a list; this key or `displacement`.
        displacement: largest displacement, one or a list; this key or `strain`.
        temperature: temperature, one or a list.
        temperature_C: temperature in degC, as plain numbers, in place of `temperature`.
        title: title for people.
        use: whether laws are fitted to the test, or it is only compared.
    """

    strain: Strains | None = None
    displacement: Displacements | None = None
    temperature: Temperatures | None = None
    temperature_C: CelsiusList | None = None
    title: str = ""
    use: Use = "fit"

    @property
    def celsius(self) -> tuple[float, ...]:
        """Ambient temperatures, degC."""
        return self.temperature or self.temperature_C or ()


class SineTest(_Test):
    """Steady sines between ramps (thesis 3.2).

    Attributes:
        type: steady sines between ramps.
        frequency: frequency, or a list of them.
        cycles: steady cycles.
        ramp_up: cycles in which the amplitude grows, in halves.
        ramp_down: cycles in which the amplitude falls, in halves.
    """

    type: Literal["sine"]
    frequency: Frequencies
    cycles: Annotated[int, Field(ge=1)] = 18
    ramp_up: Annotated[float, Field(ge=0.0)] = 2.0
    ramp_down: Annotated[float, Field(ge=0.0)] = 2.0


class SweepTest(_Test):
    """Amplitude sweeps (thesis 4.4).

    Attributes:
        type: amplitude sweep.
        frequency: frequency, or a list of them.
        blend: cycles over which the amplitude changes.
    """

    type: Literal["sweep"]
    frequency: Frequencies
    blend: Annotated[float, Field(ge=0.0, le=0.5)] = 0.25


class RandomTest(_Test):
    """Band-limited noise; one test of each amplitude.

    Attributes:
        type: band-limited noise.
        band: least and largest frequency.
        duration: length of the test.
        seed: seed of the noise.
        level: whether the amplitude is the peak or the root mean square.
    """

    type: Literal["random"]
    band: tuple[Frequency, Frequency]
    duration: PositiveTime
    seed: Annotated[int, Field(ge=0)]
    level: Literal["peak", "rms"] = "peak"


class RecordTest(_Test):
    """A displacement history from a CSV file.

    Attributes:
        type: displacement history of a file.
        file: CSV file of time and displacement, relative to the programme; scaled to the amplitude as its peak if one
            is given.
    """

    type: Literal["record"]
    file: Text


TestPlan = Annotated[SineTest | SweepTest | RandomTest | RecordTest, OneOf("type")]


class Noise(Model):
    """White noise of the force channel.

    Attributes:
        force: standard deviation of the noise over the peak force of each test.
        seed: seed of the noise.
    """

    force: Annotated[float, written_ratio(0.0, 1.0)]
    seed: Annotated[int, Field(ge=0)]


class VirtualLaw(LawBlock):
    """The law of the virtual specimen.

    Attributes:
        effects: effects in the forces of the specimen, which the law that the campaign names does not have.
    """

    effects: tuple[Effect, ...] = ()


class Programme(Model):
    """A programme of tests for the virtual rig.

    Attributes:
        title: title of the campaign that is made.
        specimen: the virtual specimen; its layers are needed for `strain` and moduli alone.
        law: the law of the specimen.
        sampling_rate: samples a second.
        noise: noise of the force channel; without the key there is none.
        tests: tests in their order.
    """

    title: str = ""
    specimen: SpecimenBlock = SpecimenBlock()
    law: VirtualLaw
    sampling_rate: Frequency = 1000.0
    noise: Noise | None = None
    tests: Annotated[tuple[TestPlan, ...], Field(min_length=1)]

    _path: Path = PrivateAttr(default=Path("programme.yaml"))

    @property
    def path(self) -> Path:
        """Programme file, as it was given."""
        return self._path


def load_programme(path: Path | str) -> Programme:
    """Read and check a programme file.

    Raises:
        InputError: the file cannot be read, or is a campaign.
        ProgrammeError: the file is wrong; the message lists all problems with file, line and column.
    """
    path = Path(path)
    programme, problems = check_model(read_yaml_text(path, _WHAT), Programme, _WHAT, _BEGINS)
    if programme is None and is_campaign(problems.root):
        raise InputError(
            f"{path}: this is a campaign, and a programme is needed, whose tests have a `type`; "
            "`edesign characterise`, `sheet`, `fit` and `calibrate` read campaigns [E-FILE-05]"
        )
    if programme is None:
        raise ProgrammeError(path, problems.found)
    check_specimen(programme.specimen, problems)
    if programme.law.parameters is None:
        problems.under(("law",), "parameters", "this key is missing [E-KEY-02]")
    check_law(programme.law, problems, complete=True)
    try:
        read_effects(programme.law.effects)
    except EffectsError as error:
        for keys, message in error.problems:
            problems.at_value(("law", "effects", *keys), message)
    for i, test in enumerate(programme.tests):
        _check_test(test, i, path, problems)
        if test.strain is not None and programme.specimen.layers is None:
            problems.at_key(
                ("tests", i, "strain"),
                "a strain needs `specimen.layers`, `layer_area` and `layer_thickness`; of a device without layers give "
                "`displacement` [E-TEST-01]",
            )
    if problems.found:
        raise ProgrammeError(path, problems.found)
    programme._path = path
    return programme


def _check_test(test: _Test, i: int, path: Path, problems: Problems) -> None:
    keys = ("tests", i)
    check_one(test, "temperature", "temperature_C", keys, problems)
    check_one(test, "displacement", "strain", keys, problems, required=not isinstance(test, RecordTest))
    for key in ("ramp_up", "ramp_down"):
        ramp = getattr(test, key, 0.0)
        if (2.0 * ramp) % 1.0 != 0.0:
            problems.at_value((*keys, key), f"`{ramp:g}`: a multiple of half a cycle is needed [E-PROG-02]")
    lists = (test.strain, test.displacement, test.celsius, getattr(test, "frequency", None))
    count = math.prod(len(values) for values in lists if values)
    if count > MOST_TESTS:
        problems.at_value(keys, f"these are {count} tests; at most {MOST_TESTS} are possible [E-PROG-01]")
    if isinstance(test, RandomTest) and test.band[0] >= test.band[1]:
        problems.at_value((*keys, "band"), f"{test.band[0]:g} Hz is not below {test.band[1]:g} Hz [E-PROG-03]")
    if isinstance(test, RecordTest) and not is_file(path.parent / test.file):
        problems.at_value((*keys, "file"), f"there is no file {path.parent / test.file} [E-FILE-01]")
