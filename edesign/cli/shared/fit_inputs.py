"""What `edesign fit` reads from files and options."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from edesign.cli.shared.hazard_options import quantity
from edesign.damper.fitting.scales import exponent_in
from edesign.damper.law import Law, Parameter
from edesign.damper.laws import law
from edesign.damper.parameters import PARAMETER_SETS, ParameterError, parameter_set, read_parameters, write_parameters
from edesign.damper.testing.campaign import load_campaign
from edesign.damper.testing.campaign_blocks import LawChoice
from edesign.damper.testing.measured_histories import DamperTest
from edesign.damper.testing.properties import properties
from edesign.damper.testing.property_table import PropertyTable, from_properties, read_property_table, usable
from edesign.damper.testing.specimen import Specimen
from edesign.errors import InputError
from edesign.project.notation.quantities import AREA, LENGTH
from edesign.project.reading.problems import did_you_mean

AGAINST = ("forces", "properties")


@dataclass(frozen=True)
class FitInput:
    """The tests or properties that laws are fitted to.

    Attributes:
        against: "forces" or "properties".
        title: of the campaign or table.
        specimen: the layers that were tested; None: a device without layers, with forces only.
        law: that the campaign names; None: none.
        tests: to fit to; () for a property table.
        validation: tests to compare with only.
        table: properties; None when forces are fitted.
        notes: on columns that are not read, on how files are read, and on tests that have no properties.
    """

    against: str
    title: str
    specimen: Specimen | None
    law: LawChoice | None
    tests: tuple[DamperTest, ...]
    validation: tuple[DamperTest, ...]
    table: PropertyTable | None
    notes: tuple[str, ...] = ()


def read_input(path: Path, against: str | None, specimen: Specimen | None) -> FitInput:
    """Read a campaign (YAML) or a property table (CSV).

    Raises:
        InputError: the file cannot be read, nothing in it can be fitted to, or an option does not apply to it.
    """
    if against is not None and against not in AGAINST:
        raise InputError(
            f"--against: `{against}` is unknown{did_you_mean(against, AGAINST)} ({', '.join(AGAINST)}) [E-CLI-04]"
        )
    if path.suffix.lower() == ".csv":
        if against == "forces":
            raise InputError(
                "--against forces: a property table has no forces; give the campaign file of the tests [E-CLI-05]"
            )
        if specimen is None:
            raise InputError(
                f"{path}: a property table needs the specimen: --layers, --layer-area and --layer-thickness; a test "
                f"with forces is fitted to by a campaign file that lists it (`edesign inspect {path}` prints its entry)"
                " [E-CLI-03]"
            )
        return FitInput("properties", path.stem, specimen, None, (), (), read_property_table(path))
    if specimen is not None:
        raise InputError(
            "--layers, --layer-area, --layer-thickness: the campaign file says what the specimen is [E-CLI-02]"
        )
    campaign = load_campaign(path, needs_force=False)
    tests, title = campaign.used_for("fit"), campaign.label
    if not tests:
        raise InputError(f"{path}: no test has `use: fit`, so there is nothing to fit to [E-CLI-08]")
    if against == "properties":
        specimen = campaign.layers_for("properties")
        table, notes = _properties(tests, specimen, path)
        left_out = tuple(f"not fitted to: {note}" for note in notes)
        return FitInput("properties", title, specimen, campaign.law, (), (), table, campaign.notes + left_out)
    validation = campaign.used_for("validate")
    return FitInput("forces", title, campaign.specimen, campaign.law, tests, validation, None, campaign.notes)


def _properties(tests: Sequence[DamperTest], specimen: Specimen, path: Path) -> tuple[PropertyTable, tuple[str, ...]]:
    """Properties of the tests that have them, and notes on the others, such as sweeps."""
    found, notes = {}, []
    for test in tests:
        try:
            found[test.name] = properties(test, specimen)
        except InputError as error:
            notes.append(str(error))
    rows, left_out = usable(found)
    notes += left_out
    if not rows:
        raise InputError("\n".join(notes))
    return from_properties(rows, str(path)), tuple(notes)


def read_specimen(layers: int | None, area: str | None, thickness: str | None) -> Specimen | None:
    """Return the specimen of the options; None if none is given.

    Raises:
        InputError: some of them are missing, or have no unit.
    """
    if layers is None and area is None and thickness is None:
        return None
    if layers is None or area is None or thickness is None:
        raise InputError("--layers, --layer-area and --layer-thickness: all three are needed [E-CLI-03]")
    return Specimen(
        "specimen", layers, quantity(area, AREA, "--layer-area"), quantity(thickness, LENGTH, "--layer-thickness")
    )


def read_laws(names: Sequence[str], choice: LawChoice | None) -> tuple[Law, ...]:
    """Return the laws of --law, else that of the campaign.

    Raises:
        InputError: one is unknown or named twice, or there is none.
    """
    if not names and choice is None:
        raise InputError("--law: which law is to be fitted? The campaign names none [E-CLI-03]")
    wanted = list(names) if names or choice is None else [choice.type]
    for name in wanted:
        if wanted.count(name) > 1:
            raise InputError(f"--law: `{name}` stands there twice [E-CLI-04]")
    return tuple(law(name) for name in wanted)


def read_starts(law: Law, given: Sequence[str], choice: LawChoice | None, alone: bool) -> dict[str, float]:
    """Return start values of a law: of the campaign's law, a published set, or NAME=VALUE; `data`: none.

    Args:
        choice: the campaign's law.
        alone: whether it is the only law; a value of another law's parameter is a mistake only then.
    """
    values: dict[str, float] = {}
    if not given and choice is not None and choice.type == law.name and choice.parameters is not None:
        try:
            return read_parameters(law, choice.parameters)
        except InputError as error:
            raise InputError(f"law of the campaign: {error} (or `--start data`)") from None
    pairs = [text for text in given if "=" in text]
    for text in given:
        if "=" in text or text == "data":
            continue
        if not alone and text in PARAMETER_SETS and PARAMETER_SETS[text].law != law.name:
            continue
        values |= read_parameters(law, parameter_set(law, text).values)
    return values | _read_values(law, pairs, "--start", alone)


def read_fixed(law: Law, given: Sequence[str], start: Mapping[str, float], alone: bool) -> dict[str, float] | list[str]:
    """Return the parameters of --fix: NAME=VALUE, or NAME alone for its start value."""
    names = [text for text in given if "=" not in text]
    values = _read_values(law, [text for text in given if "=" in text], "--fix", alone)
    known = {parameter.name for parameter in law.parameters} | set(start) | set(values)
    for name in names:
        if name in start:
            values[name] = start[name]
        elif name in known:
            raise InputError(f"--fix {name}: at which value? `--fix {name}=...` or a start value is needed [E-CLI-03]")
        elif alone:
            _unknown(law, name, "--fix")
    return values


def _read_values(law: Law, pairs: Sequence[str], option: str, alone: bool) -> dict[str, float]:
    """Return the values of NAME=VALUE with units, by name.

    Raises:
        InputError: a name is unknown, or a value cannot be read.
    """
    texts: dict[str, str] = {}
    for pair in pairs:
        name, _, text = pair.partition("=")
        if name.strip() in texts:
            raise InputError(f"{option} {name.strip()}: the parameter is named twice [E-CLI-04]")
        texts[name.strip()] = text.strip()
    parameters = {p.name: p for p in law.all_parameters(dict.fromkeys(texts, 0.0))}
    for name in list(texts):
        if name not in parameters:
            if alone:
                _unknown(law, name, option)
            del texts[name]
    for name in texts:
        exponent = exponent_in(parameters[name].unit)
        if exponent is not None and exponent not in texts:
            raise InputError(f"{option} {name}: its unit contains {exponent}; give `{exponent}=...` too [E-CLI-03]")
    if not texts:
        return {}
    placeholders = write_parameters(law, {p.name: _placeholder(p) for p in parameters.values()})
    for name, parameter in parameters.items():  # of exponents in units the text may say another number
        if exponent_in(parameter.unit) in texts and name not in texts:
            placeholders[name] = placeholders[name].partition("^")[0] + f"^{exponent_in(parameter.unit)}"
    try:
        found = read_parameters(law, {**placeholders, **texts})
    except ParameterError as error:
        lines = [f"{option} {name}: {message}" for name, message in error.problems if name in texts]
        raise InputError("\n".join(lines or [str(error)])) from None
    return {name: found[name] for name in texts}


def _unknown(law: Law, name: str, option: str) -> None:
    known = [parameter.name for parameter in law.with_branches(1 if law.branch else 0)]
    raise InputError(
        f"{option}: law {law.name} has no parameter `{name}`{did_you_mean(name, known)} (there are: {', '.join(known)})"
        " [E-CLI-04]"
    )


def _placeholder(parameter: Parameter) -> float:
    if parameter.default is not None:
        return parameter.default
    if math.isfinite(parameter.upper):
        return 0.5 * (parameter.lower + parameter.upper)
    return parameter.lower + 1.0 if math.isfinite(parameter.lower) else 1.0
