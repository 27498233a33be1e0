"""Summaries of files about dampers: laws, campaigns and programmes of tests."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from pathlib import Path

import numpy as np

from edesign.damper.effects_file import read_effects
from edesign.damper.history import sign_questionable
from edesign.damper.law_file import read_law_file, resolve
from edesign.damper.laws import law as law_of
from edesign.damper.parameters import practical_unit, write_parameters
from edesign.damper.testing.campaign import load_campaign
from edesign.damper.testing.campaign_blocks import LawChoice, is_programme
from edesign.damper.testing.clipping import clipping_warning
from edesign.damper.testing.measured_histories import DamperTest
from edesign.damper.testing.programme import planned_tests
from edesign.damper.testing.programme_file import Programme, SineTest, SweepTest, load_programme
from edesign.damper.testing.property_table import PropertyTable
from edesign.damper.testing.specimen import LARGE_STRAIN, Specimen, layer_warning
from edesign.damper.testing.spikes import spike_warnings
from edesign.project.reading.yaml_file import read_yaml_text
from edesign.project.reading.yaml_nodes import parse

_FEW_SAMPLES = 20.0  # a cycle: moduli are then within 0.5 % (docs/how_to/damper_tests.md, accuracy)


def law_summary(path: Path) -> dict[str, str]:
    """Return a description of a law file.

    Raises:
        InputError: it is wrong.
    """
    described, source = read_law_file(path)
    found = resolve(described, source, None)
    units = {parameter.name: practical_unit(parameter) for parameter in found.law.all_parameters(found.values)}
    written = write_parameters(found.law, found.values)
    errors = described.standard_errors or {}
    parameters = [
        f"{name} = {value}{f', std. error {errors[name]}' if name in errors else ''}" for name, value in written.items()
    ]
    warnings = list(found.warnings)
    unknown = [name for name in errors if name not in units]
    if unknown:
        warnings.append(f"standard_errors: {', '.join(unknown)}: no parameter of {found.law.name}")
    if not described.tested and not isinstance(described.parameters, str):
        warnings.append("`tested` is missing: nobody is warned beyond the strains and temperatures of the tests")
    size = described.prototype
    return {
        "law": f"{found.law.name}: {found.law.title}",
        "parameters": "\n".join(parameters),
        **({"effects": "\n".join(one.label for one in found.effects)} if found.effects else {}),
        "prototype": _size(Specimen("", size.layers, size.layer_area, size.layer_thickness))
        if size is not None
        else "none: the law has the size of the device",
        **(
            {"tested": ", ".join(f"{key.replace('_', ' ')} {text}" for key, text in described.tested.items())}
            if described.tested
            else {}
        ),
        **warnings_of(warnings),
    }


def tests_summary(path: Path) -> dict[str, str]:
    """Return a description of a campaign or programme of damper tests; tests of a programme have a `type`.

    Raises:
        InputError: it, or a file of a test, is wrong.
    """
    root, _ = parse(read_yaml_text(path, "campaign or programme file"))
    if is_programme(root):
        return _programme_summary(load_programme(path))
    return _campaign_summary(path)


def _campaign_summary(path: Path) -> dict[str, str]:
    from edesign.calibration.signals.interpolation import sampling_notes

    campaign = load_campaign(path, needs_force=False)
    specimen, tests = campaign.specimen, campaign.tests
    warnings = [*campaign.left_out, *_specimen_warnings(specimen)]
    uses = Counter(test.use for test in tests)
    if uses["fit"] < 2:
        warnings.append(f"{uses['fit']} tests with `use: fit`; `edesign calibrate` needs two, `edesign fit` one")
    if not uses["validate"]:
        warnings.append("no test has `use: validate`; `edesign calibrate` needs one to judge what it finds")
    for test in tests:
        warnings += [f"{test.name}: {text}" for text in _test_warnings(test, specimen)]
    return {
        "title": campaign.title or path.stem,
        "specimen": f"{campaign.specimen_name}: {_size(specimen)}",
        "law": _law(campaign.law),
        **({"read": "\n".join(campaign.readings).replace(": read: ", ": ")} if campaign.readings else {}),
        "tests": f"{len(tests)}: {uses['fit']} to fit to, {uses['validate']} to validate",
        "range": _range(tests, specimen),
        **({"sampling": "\n".join(notes)} if (notes := sampling_notes(tests)) else {}),
        **warnings_of(warnings),
    }


def _programme_summary(programme: Programme) -> dict[str, str]:
    specimen = programme.specimen.specimen
    warnings, planned = _specimen_warnings(specimen), []
    for plan, test in planned_tests(programme, specimen):
        planned.append(test)
        strain = _largest_strain(test, specimen)
        if strain > LARGE_STRAIN:
            warnings.append(f"{test.name}: a shear strain of {strain:.0%}; is the size of the specimen right?")
        if isinstance(plan, (SineTest, SweepTest)) and programme.sampling_rate < _FEW_SAMPLES * max(plan.frequency):
            warnings.append(
                f"{test.name}: {programme.sampling_rate / max(plan.frequency):.3g} samples a cycle at "
                f"{max(plan.frequency):g} Hz; {_FEW_SAMPLES:g} or more give moduli well"
            )
    kinds = Counter(plan.type for plan, _ in planned_tests(programme, specimen))
    hours = sum(float(test.time[-1]) for test in planned)
    noise = programme.noise
    effects = ", ".join(one.label for one in read_effects(programme.law.effects))
    return {
        "title": programme.title or programme.path.stem,
        "specimen": f"{programme.specimen.name}: {_size(specimen)}",
        "law": _law(programme.law.choice) + (f", with {effects}" if effects else ""),
        "tests": f"{len(planned)}: {', '.join(f'{count} {kind}' for kind, count in kinds.items())}",
        "range": _range(planned, specimen),
        "sampling": f"{programme.sampling_rate:g} Hz, {hours:.4g} s in all; "
        + (f"noise of the force {noise.force:.3g} of its peak" if noise is not None else "no noise"),
        **warnings_of(warnings),
    }


def property_campaign_summary(path: Path) -> dict[str, str]:
    """Return a description of the campaign of a property table.

    Raises:
        InputError: it is wrong.
    """
    from edesign.calibration.properties.campaign import load_property_campaign

    campaign = load_property_campaign(path)
    uses = Counter(group.use for group in campaign.groups)
    rows = Counter({use: sum(group.rows.size for group in campaign.groups if group.use == use) for use in uses})
    warnings = []
    if not rows["validate"]:
        warnings.append("no rows are held out; `hold_out` names those that judge what is found")
    return {
        "title": campaign.title or path.stem,
        "specimen": f"{campaign.specimen.name}: {_size(campaign.specimen)}",
        "law": _law(campaign.law),
        "table": campaign.table.source,
        "rows": f"{rows['fit']} to fit to, {rows['validate']} held out; {table_range(campaign.table)}",
        **warnings_of(warnings),
    }


def table_range(table: PropertyTable) -> str:
    """Return the range of a property table."""
    spans = (
        (100.0 * table.strain, "% strain"),
        (table.frequency, "Hz"),
        (table.temperature_C, "degC"),
    )
    return ", ".join(f"{_span(values)} {unit}" for values, unit in spans)


def _largest_strain(test: DamperTest, specimen: Specimen | None) -> float:
    """Largest shear strain of a test; 0 of a device without layers."""
    return 0.0 if specimen is None else specimen.strain(float(np.max(np.abs(test.displacement))))


def _specimen_warnings(specimen: Specimen | None) -> list[str]:
    """What is unlikely about the size of a specimen."""
    if specimen is None:
        return []
    warning = layer_warning(specimen.layer_area, specimen.layer_thickness)
    return [f"specimen {specimen.name}: {warning}"] if warning else []


def _test_warnings(test: DamperTest, specimen: Specimen | None) -> list[str]:
    """What is unlikely about a test."""
    found = []
    strain = _largest_strain(test, specimen)
    if strain > LARGE_STRAIN:
        found.append(f"a shear strain of {strain:.0%}; are the unit of the displacement and the layers right?")
    return [*found, *force_warnings(test)]


def force_warnings(test: DamperTest) -> list[str]:
    """Return the warnings about the force of a test.

    Args:
        test: with or without a force.
    """
    if test.force is None:
        return ["no force was measured"]
    if not np.any(test.force - np.mean(test.force)):
        return ["the force is the same throughout; was the load cell connected?"]
    found = [warning] if (warning := clipping_warning(test)) else []
    found += spike_warnings(test)
    if sign_questionable(test.displacement, test.force):
        found.append("the damper gives energy instead of taking it: is the sign of force or displacement reversed?")
    return found


def _range(tests: Sequence[DamperTest], specimen: Specimen | None) -> str:
    """Largest strains, or displacements of a device without layers, durations and temperatures of tests."""
    largest = np.array([np.max(np.abs(test.displacement)) for test in tests])
    reach = f"{_span(1e3 * largest)} mm largest displacement"
    if specimen is not None:
        reach = f"{_span(100.0 * specimen.strain(largest))} % largest strain"
    times = np.array([float(test.time[-1] - test.time[0]) for test in tests])
    temperatures = np.array([test.temperature_C for test in tests])
    return f"{reach}, {_span(times)} s long, {_span(temperatures)} degC"


def _span(values: np.ndarray) -> str:
    low, high = f"{np.min(values):.3g}", f"{np.max(values):.3g}"
    return low if low == high else f"{low} to {high}"


def _size(specimen: Specimen | None) -> str:
    if specimen is None:
        return "no layers"
    layers = f"{specimen.layers} layer{'s' * (specimen.layers > 1)}"
    return f"{layers} of {1e6 * specimen.layer_area:.6g} mm2, {1e3 * specimen.layer_thickness:.4g} mm thick"


def _law(choice: LawChoice | None) -> str:
    if choice is None:
        return "none named"
    given = choice.parameters
    shown = given if isinstance(given, str) else "parameters given" if given else "no parameters"
    fixed = "" if choice.refit else ", fixed"
    return f"{choice.type} ({law_of(choice.type).title}), {shown}{fixed}"


def warnings_of(warnings: Sequence[str]) -> dict[str, str]:
    """Return warnings as an entry of a summary, one line each; {} without warnings."""
    return {"warnings": "\n".join(warnings)} if warnings else {}
