"""Campaigns of damper tests: a YAML file that names the specimen, the law thought of, and the files of the tests."""

from __future__ import annotations

import itertools
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Annotated, Any, Literal

import numpy as np
import yaml
from pydantic import Field

from edesign.archive.files import make_folder, write_text
from edesign.damper.testing.acceptance import Acceptance
from edesign.damper.testing.campaign_blocks import (
    CampaignLaw,
    Celsius,
    LawChoice,
    SpecimenBlock,
    Text,
    check_law,
    check_one,
    check_specimen,
    is_programme,
)
from edesign.damper.testing.measured_columns import ReadingKeys, reading_of
from edesign.damper.testing.measured_files import read_test, write_test
from edesign.damper.testing.measured_histories import DamperTest, Use
from edesign.damper.testing.specimen import Specimen
from edesign.damper.testing.start import StartKind
from edesign.errors import ArchiveError, InputError
from edesign.input_files import spare_inputs
from edesign.project.document import Document
from edesign.project.notation.temperature import Temperature
from edesign.project.notation.units import PositiveTime
from edesign.project.reading.base import Model
from edesign.project.reading.file_bytes import is_there
from edesign.project.reading.problems import FileProblems, Problems
from edesign.project.reading.yaml_file import check_model, read_yaml_text

Order = Literal["as_listed", "unknown"]
"""Whether tests were made in the order in which they are listed."""

Owner = Literal["damper", "rig"]
"""What an effect is a part of: `rig` is all that is not the damper."""

ConditionName = Annotated[str, Field(pattern=r"^[A-Za-z][A-Za-z0-9_]*$")]
CAMPAIGN_FILE = "campaign.yaml"
_WHAT, _BEGINS = "campaign file", "specimen:"
_NEAR = 1.5  # largest steps between samples
_AWAY = 0.1  # of the largest displacement: tests from zero to zero say nothing


class CampaignError(FileProblems):
    """Error: a campaign file is wrong."""


class TestEntry(ReadingKeys):
    """A test of the specimen.

    Attributes:
        file: CSV file of the test, relative to the campaign file.
        title: title for people.
        temperature: ambient temperature; without the key the mean of the file's column.
        temperature_C: ambient temperature in degC, as a plain number, in place of `temperature`.
        use: whether laws are fitted to the test, or it is only compared.
        start: how the test starts, in place of `start` of the file.
        start_ramp: time from rest to the first sample, with `start: at_rest`.
        conditions: other quantities under which the test was made, plain numbers by name, the same names in all tests:
            `{gas_pressure_MPa: 0.69, clicks: 4}`.
    """

    __test__ = False  # no test of pytest

    file: Text
    title: str = ""
    temperature: Temperature | None = None
    temperature_C: Celsius | None = None
    use: Use = "fit"
    start: StartKind | None = None
    start_ramp: PositiveTime | None = None
    conditions: Annotated[dict[ConditionName, float], Field(min_length=1)] | None = None

    @property
    def celsius(self) -> float | None:
        """Ambient temperature, degC."""
        return self.temperature if self.temperature is not None else self.temperature_C


class BelongsTo(Model):
    """What effects belong to of which force and motion cannot tell it: the damper, or the rig with its instruments.

    Attributes:
        friction: of the damper's seals, or of the guides of the rig.
        series_flexibility: of the damper's own parts, or of those of the rig.
        play: of the damper's own pins, or of those of the rig.
        inertia: of the damper's own moving mass, or of that between load cell and specimen.
        limit: of the force of the damper, beyond which it does not grow, or end of the range of the load cell.
        offset: force of the damper, as of its gas, or zero of the load cell.
    """

    friction: Owner | None = None
    series_flexibility: Owner | None = None
    play: Owner | None = None
    inertia: Owner | None = None
    limit: Owner | None = None
    offset: Owner | None = None


class CampaignFile(ReadingKeys):
    """A campaign file: tests of one damper, in the order in which they were made.

    Attributes:
        title: title of the report.
        document: what the cover of a report says beside the title.
        specimen: what was tested; its layers are needed for strains and moduli alone.
        law: law that is thought to describe the specimen; without the key none.
        start: how the tests start.
        start_ramp: time from rest to the first sample, with `start: at_rest`; without the key one sampling interval.
        acceptance: what the device is accepted by; without the key as a viscoelastic one, by both standards.
        order: whether the tests are listed in the order in which they were made; `unknown` also where each has a
            specimen of its own.
        belongs_to: whether effects are of the damper or of the rig where force and motion cannot tell.
        tests: tests in the order in which they were made, if it is known.
    """

    title: str = ""
    document: Document = Document()
    specimen: SpecimenBlock = SpecimenBlock()
    law: CampaignLaw | None = None
    start: StartKind = "unknown"
    start_ramp: PositiveTime | None = None
    acceptance: Acceptance = Acceptance()
    order: Order = "as_listed"
    belongs_to: BelongsTo = BelongsTo()
    tests: Annotated[tuple[TestEntry, ...], Field(min_length=1)]


@dataclass(frozen=True)
class Campaign:
    """Tests of one specimen, in the order in which they were made, if that is known.

    Attributes:
        specimen: the layers that were tested; None: the device has none, or they are not said.
        law: thought to describe it; None: none named.
        tests: in the order of the file.
        path: the campaign file.
        title: for people.
        text: of the campaign file.
        document: for the cover of a report.
        acceptance: what the device is accepted by.
        specimen_name: name of what was tested.
        ordered: whether the order of the file is that in which the tests were made.
        belongs_to: what effects belong to, by name, as far as the file says it.
    """

    specimen: Specimen | None
    law: LawChoice | None
    tests: tuple[DamperTest, ...]
    path: Path
    title: str = ""
    text: str = ""
    document: Document = Document()
    acceptance: Acceptance = field(default_factory=Acceptance)
    specimen_name: str = "specimen"
    ordered: bool = True
    belongs_to: Mapping[str, Owner] = field(default_factory=dict)

    @property
    def label(self) -> str:
        """The title, or else the name of the specimen."""
        return self.title or self.specimen_name

    def layers_for(self, what: str) -> Specimen:
        """Return the layers of the specimen, for a command that makes strains or moduli of them.

        Args:
            what: needs them, in the plural: "moduli".

        Raises:
            InputError: the campaign names none.
        """
        if self.specimen is None:
            raise InputError(
                f"{self.path}: {what} need the layers of the specimen, `specimen: {{layers: 2, layer_area: 41400 mm^2, "
                "layer_thickness: 12 mm}`; of a device without layers `edesign sheet` finds stiffness and damping, and "
                "`edesign fit` the parameters of a law [E-TEST-01]"
            )
        return self.specimen

    def used_for(self, use: Use) -> tuple[DamperTest, ...]:
        """Return the tests of one use: to fit to, or to compare with only."""
        return tuple(test for test in self.tests if test.use == use)

    @property
    def left_out(self) -> tuple[str, ...]:
        """Columns of other quantities that the reader of the files leaves out, one line for tests with the same."""
        return _left_out(self.tests)

    @property
    def readings(self) -> tuple[str, ...]:
        """Notes on how files that are not plain were read and where motions begin; one line for tests with the same."""
        return _readings(self.tests)

    @property
    def notes(self) -> tuple[str, ...]:
        """Notes on what the reader of the files leaves out, and how it reads the others."""
        return notes_of(self.tests)


def notes_of(tests: Sequence[DamperTest]) -> tuple[str, ...]:
    """Return notes on what the reader of tests leaves out, and how it reads those that are not plain."""
    return _left_out(tests) + _readings(tests) + _cut(tests)


def _cut(tests: Sequence[DamperTest]) -> tuple[str, ...]:
    """Say of which tests the record seems to be that of the test before, cut in the middle of a motion."""
    return tuple(
        f"{test.name}: it begins where {before.name} ends; if one record was cut there, say `start: continued`"
        for before, test in itertools.pairwise(tests)
        if test.start in ("in_motion", "unknown") and _goes_on(before, test)
    )


def _goes_on(before: DamperTest, test: DamperTest) -> bool:
    """Whether a test begins away from zero, and no farther from the end of another than samples are from each other."""
    if test.force is None or before.force is None:
        return False
    both = (before.displacement, test.displacement), (before.force, test.force)
    steps = [max(float(np.max(np.abs(np.diff(one)))) for one in pair) for pair in both]
    near = all(abs(there[0] - here[-1]) <= _NEAR * step for (here, there), step in zip(both, steps, strict=True))
    return near and abs(float(test.displacement[0])) > _AWAY * float(np.max(np.abs(test.displacement)))


def _left_out(tests: Sequence[DamperTest]) -> tuple[str, ...]:
    return _by_tests(
        (f"not read: {', '.join(f'`{header}`' for header in test.unread)}" if test.unread else "", test.name)
        for test in tests
    )


def _readings(tests: Sequence[DamperTest]) -> tuple[str, ...]:
    return _by_tests((f"read: {test.reading}" if test.reading else "", test.name) for test in tests)


def _by_tests(notes: Iterable[tuple[str, str]]) -> tuple[str, ...]:
    """Each text once, behind the names of the tests that it belongs to."""
    names: dict[str, list[str]] = {}
    for text, name in notes:
        if text:
            names.setdefault(text, []).append(name)
    return tuple(f"{', '.join(tests)}: {text}" for text, tests in names.items())


def load_campaign(path: Path | str, needs_force: bool = True) -> Campaign:
    """Read and check a campaign file and the tests it names.

    Args:
        path: the YAML file.
        needs_force: whether tests without force are refused.

    Raises:
        InputError: the file cannot be read, is a programme, or tests are wrong; the message lists the first mistake of
            each of them.
        CampaignError: the file is wrong; the message lists all problems with file, line and column.
    """
    path = Path(path)
    text = read_yaml_text(path, _WHAT)
    file, problems = check_model(text, CampaignFile, _WHAT, _BEGINS)
    if is_programme(problems.root):
        raise InputError(
            f"{path}: this is a programme, and tests that were made are needed; `edesign test {path} --output DIR` "
            f"makes them with its law, and writes DIR/{CAMPAIGN_FILE}, which names them [E-FILE-05]"
        )
    if file is None:
        raise CampaignError(path, problems.found)
    check_specimen(file.specimen, problems)
    check_law(file.law, problems, complete=False)
    for i, entry in enumerate(file.tests):
        keys = ("tests", i)
        check_one(entry, "temperature", "temperature_C", keys, problems, required=False)
        if not is_there(path.parent / entry.file):
            problems.at_value((*keys, "file"), f"there is no file {path.parent / entry.file} [E-FILE-01]")
    _check_twins(file, problems)
    _check_starts(file, problems)
    _check_conditions(file, problems)
    if file.order == "unknown" and file.law is not None and file.law.extremes == "lasting":
        problems.at_value(
            ("law", "extremes"), "what lasts from test to test needs their order, and `order` is unknown [E-TEST-02]"
        )
    if problems.found:
        raise CampaignError(path, problems.found)
    tests, wrong = [], []
    for name, entry in zip(_names(file), file.tests, strict=True):
        try:
            test = read_test(
                path.parent / entry.file,
                temperature_C=entry.celsius,
                title=entry.title,
                use=entry.use,
                needs_force=needs_force,
                name=name,
                start=entry.start or file.start,
                start_ramp=_ramp(entry, file),
                said=reading_of(entry, file),
            )
            tests.append(replace(test, conditions=entry.conditions or {}))
        except InputError as error:
            wrong.append(str(error))
    if wrong:
        raise InputError("\n".join(wrong))
    law = None if file.law is None else file.law.choice
    return Campaign(
        file.specimen.specimen,
        law,
        tuple(tests),
        path,
        file.title,
        text,
        file.document,
        file.acceptance,
        file.specimen.name,
        file.order == "as_listed",
        {name: owner for name, owner in file.belongs_to if owner is not None},
    )


def write_campaign(
    folder: Path | str,
    specimen: Specimen | None,
    tests: Sequence[DamperTest],
    law: LawChoice | None = None,
    title: str = "",
    specimen_name: str = "",
) -> Campaign:
    """Write a campaign: NAME.csv for each test, and then campaign.yaml, so that it names whole files only.

    Args:
        folder: made if it does not exist.
        specimen: the layers that were tested; None: a device without layers.
        tests: names without folders, no two alike.
        law: with parameters as text, numbers without dimension, or the name of a set.
        title: for people.
        specimen_name: name of what was tested, where it has no layers.

    Returns:
        The campaign with its place.

    Raises:
        ArchiveError: a file cannot be written.
        InputError: two tests have one name, or an input of the command stands where a file is to go.
    """
    folder = Path(folder)
    names = [test.name.lower() for test in tests]
    for name in names:
        if names.count(name) > 1:
            raise InputError(f"campaign {folder}: two tests are called {name}; their files would be one [E-NAME-02]")
    path = folder / CAMPAIGN_FILE
    spare_inputs(path, *(folder / f"{test.name}.csv" for test in tests))
    make_folder(folder)
    _remove(path)  # one that is replaced must not name tests of two campaigns if this is interrupted
    for test in tests:
        write_test(folder / f"{test.name}.csv", test)
    name = specimen.name if specimen is not None else specimen_name or Campaign.specimen_name
    text = _text(specimen, name, tests, law, title)
    write_text(text, path)
    return Campaign(specimen, law, tuple(tests), path, title, text, specimen_name=name)


def _remove(path: Path) -> None:
    try:
        path.unlink(missing_ok=True)
    except OSError as error:
        raise ArchiveError(f"{path}: cannot be replaced: {error.strerror} [E-FILE-06]") from error


def _text(specimen: Specimen | None, name: str, tests: Sequence[DamperTest], law: LawChoice | None, title: str) -> str:
    data: dict[str, Any] = {"title": title} if title else {}
    data["specimen"] = {"name": name}
    if specimen is not None:
        data["specimen"] |= {
            "layers": specimen.layers,
            "layer_area_mm2": _rounded(1e6 * specimen.layer_area),
            "layer_thickness_mm": _rounded(1e3 * specimen.layer_thickness),
        }
    if law is not None:
        data["law"] = {"type": law.type}
        if law.parameters is not None:
            data["law"]["parameters"] = law.parameters if isinstance(law.parameters, str) else dict(law.parameters)
        if not law.refit:
            data["law"]["refit"] = False
        if law.extremes is not None:
            data["law"]["extremes"] = law.extremes
        if law.gamma_T_of is not None:
            data["law"]["gamma_T_of"] = law.gamma_T_of
    data["tests"] = [
        {
            "file": f"{test.name}.csv",
            **({"title": test.title} if test.title else {}),
            "temperature_C": _rounded(test.temperature_C),
            "use": test.use,
            **({"start": test.start} if test.start != "unknown" else {}),
            **({"start_ramp": f"{test.start_ramp:.12g} s"} if test.start_ramp is not None else {}),
            **({"conditions": dict(test.conditions)} if test.conditions else {}),
        }
        for test in tests
    ]
    # leaves stand in one line each, as a person would write them
    return yaml.safe_dump(data, sort_keys=False, default_flow_style=None, width=1000, allow_unicode=True)


def _rounded(value: float) -> float | int:
    """Twelve digits, so that 1e6 * 0.0414 is 41400."""
    number = float(f"{value:.12g}")
    return int(number) if number == int(number) and abs(number) < 1e15 else number


def short_names(paths: Sequence[Path]) -> list[str]:
    """Return a name for each of several files.

    It is the file's own name without ending; with folders, then with ending, if others have that.
    """
    short, longer = [path.stem for path in paths], [str(path.with_suffix("")) for path in paths]
    return [
        name if short.count(name) == 1 else long if longer.count(long) == 1 else str(path)
        for name, long, path in zip(short, longer, paths, strict=True)
    ]


def _names(file: CampaignFile) -> list[str]:
    """Names of the tests: file names, with ending and folders where these are needed to distinguish them."""
    return short_names([Path(entry.file) for entry in file.tests])


def _ramp(entry: TestEntry, file: CampaignFile) -> float | None:
    """That of the test, or of all tests; of one that starts at rest alone."""
    starts_at_rest = (entry.start or file.start) == "at_rest"
    return (entry.start_ramp or file.start_ramp) if starts_at_rest else None


def _check_starts(file: CampaignFile, problems: Problems) -> None:
    """Refuse a ramp where no test starts at rest, which alone has one, and a test that goes on after none."""
    needs = "it belongs to `start: at_rest`: the way from rest to the first sample [E-KEY-03]"
    if file.start_ramp is not None and all((entry.start or file.start) != "at_rest" for entry in file.tests):
        problems.at_key(("start_ramp",), needs)
    for i, entry in enumerate(file.tests):
        if entry.start_ramp is not None and (entry.start or file.start) != "at_rest":
            problems.at_key(("tests", i, "start_ramp"), needs)
        if entry.start == "continued" and (i == 0 or file.order == "unknown"):
            what = "before the first one there is none" if i == 0 else "`order: unknown` says that none does"
            problems.at_value(
                ("tests", i, "start"), f"a test that is `continued` goes on from the one before it; {what} [E-TEST-02]"
            )
    if file.start == "continued":
        problems.at_value(("start",), "the first test goes on from none: say it of each other one [E-TEST-02]")


def _check_conditions(file: CampaignFile, problems: Problems) -> None:
    """Refuse a condition that some tests declare alone, or that has a key of its own."""
    names = list(dict.fromkeys(name for entry in file.tests for name in entry.conditions or {}))
    for i, entry in enumerate(file.tests):
        own = entry.conditions or {}
        if missing := ", ".join(f"`{name}`" for name in names if name not in own):
            text = f"{missing} of other tests is missing here; all tests need the same conditions [E-TEST-02]"
            if own:
                problems.at_key(("tests", i, "conditions"), text)
            else:
                problems.under(("tests", i), "conditions", text)
        for name in own:
            if name.lower() in ("temperature", "temperature_c"):
                message = "the temperature of a test has a key of its own, `temperature` [E-KEY-03]"
                problems.at_key(("tests", i, "conditions", name), message)


def _check_twins(file: CampaignFile, problems: Problems) -> None:
    first: dict[Path, int] = {}
    for i, entry in enumerate(file.tests):
        other = first.setdefault(Path(entry.file), i)
        if other != i:
            line = problems.node(("tests", other)).mark.line
            problems.at_value(("tests", i, "file"), f"the file is there already, in line {line} [E-FILE-09]")
