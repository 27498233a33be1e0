"""`edesign characterise`: mechanical properties of a damper from its tests."""

from __future__ import annotations

import json
import re
from pathlib import Path
from typing import Annotated

import typer
from pydantic_core import PydanticCustomError

from edesign.archive.files import check_csv, check_folder
from edesign.cli.shared.hazard_options import quantity
from edesign.damper.testing.campaign import Campaign, load_campaign, short_names
from edesign.damper.testing.measured_files import read_test
from edesign.damper.testing.properties import Properties, checked_range, cycle_properties, properties
from edesign.damper.testing.property_table import from_properties, usable, write_property_table
from edesign.damper.testing.specimen import Specimen
from edesign.errors import InputError
from edesign.file_kinds.kinds import ARCHIVE, YAML_KINDS
from edesign.file_kinds.recognise import kind_of, refuse_kind
from edesign.optional_stages import optional
from edesign.project.notation.quantities import AREA, LENGTH
from edesign.project.notation.temperature import parse_temperature
from edesign.report.damper.measured_figures import draw_tests
from edesign.report.damper.measured_tables import cycle_properties_table, properties_data, properties_table
from edesign.report.drawing.style import check_format
from edesign.report.tables.text import print_tables


def characterise(
    inputs: Annotated[
        list[Path],
        typer.Argument(
            help="A campaign (.yaml), or test files (.csv).", metavar="CAMPAIGN_OR_TESTS", show_default=False
        ),
    ],
    layers: Annotated[int | None, typer.Option("--layers", min=1, help="Of the specimen of test files.")] = None,
    layer_area: Annotated[str | None, typer.Option("--layer-area", help="Of one layer: `41400 mm^2`.")] = None,
    layer_thickness: Annotated[str | None, typer.Option("--layer-thickness", help="Of one layer: `12 mm`.")] = None,
    temperature: Annotated[
        str | None, typer.Option("--temperature", help="Ambient, of test files without a column of it: `20 degC`.")
    ] = None,
    cycles: Annotated[
        str | None,
        typer.Option(
            "--cycles",
            metavar="FIRST-LAST",
            help="Averaged; 1 is the first of full amplitude. 5-15, or 3 to the last one of fewer, if not said.",
        ),
    ] = None,
    per_cycle: Annotated[
        bool, typer.Option("--per-cycle", help="Each full cycle too, whatever its amplitude.")
    ] = False,
    as_json: Annotated[bool, typer.Option("--json", help="Print JSON in SI units instead of tables.")] = False,
    output: Annotated[
        Path | None, typer.Option("--output", "-o", metavar="FILE", help="Write the properties as CSV.")
    ] = None,
    figures: Annotated[Path | None, typer.Option("--figures", metavar="DIR", help="Draw tests and properties.")] = None,
    figure_format: Annotated[str, typer.Option("--format", help="Of the figures: svg, png, pdf.")] = "svg",
) -> None:
    """Find storage, equivalent and loss modulus and loss factor of each test with a steady amplitude."""
    check_format(figure_format)
    asked = None if cycles is None else checked_range(_cycles(cycles))
    if output is not None:
        check_csv(output)
    if figures is not None:
        check_folder(figures)
    campaign = _campaign(inputs, layers, layer_area, layer_thickness, temperature)
    specimen = campaign.layers_for("moduli")
    found: dict[str, Properties] = {}
    notes, each = list(campaign.notes), {}
    for test in campaign.tests:
        try:
            found[test.name] = properties(test, specimen, asked)
        except InputError as error:
            notes.append(str(error))
        if per_cycle:
            try:
                each[test.name] = cycle_properties(test, specimen)
            except InputError as error:
                notes.append(str(error))
    if not found and not each:
        raise InputError("\n".join(notes))
    rows, left_out = usable(found)
    notes += left_out
    table = from_properties(rows, str(output or inputs[0])) if rows else None
    if output is not None and table is not None:
        write_property_table(table, output)
    if as_json:
        data = {**properties_data(found, each), "notes": notes}
        print(json.dumps(data, indent=2, allow_nan=False, ensure_ascii=False))
    else:
        title = (
            f"{specimen.name}: {specimen.layers} layers of {1e6 * specimen.layer_area:.6g} mm2, "
            f"{1e3 * specimen.layer_thickness:.6g} mm thick"
        )
        tables = [properties_table(title, found, notes)]
        print_tables([*tables, *(cycle_properties_table(name, columns) for name, columns in each.items())])
    if output is not None and table is None:
        raise InputError(f"{output}: there are no properties to write\n" + "\n".join(notes) + " [E-CLI-08]")
    if figures is not None:
        with optional("the figures", "the properties stand"):
            draw_tests(campaign, table, figures, figure_format)


def _cycles(text: str) -> tuple[int, int]:
    match = re.fullmatch(r"\s*(\d{1,6})\s*-\s*(\d{1,6})\s*", text)
    if not match:
        raise InputError(f"--cycles: `{text}` is no range; write first and last, such as `5-15` [E-CLI-04]")
    return int(match[1]), int(match[2])


def _campaign(
    inputs: list[Path], layers: int | None, area: str | None, thickness: str | None, temperature: str | None
) -> Campaign:
    """The campaign of a file, or one made of test files and options."""
    options = {"--layers": layers, "--layer-area": area, "--layer-thickness": thickness}
    if any(path.suffix.lower() in (".yaml", ".yml") for path in inputs):
        if len(inputs) > 1:
            raise InputError(f"{inputs[0]}: one campaign, or test files; not both, and not two campaigns [E-CLI-05]")
        campaign = load_campaign(inputs[0])
        for option, value in {**options, "--temperature": temperature}.items():
            if value is not None:
                raise InputError(f"{option}: the campaign says this; leave the option out [E-CLI-02]")
        return campaign
    for path in inputs:
        refuse_kind(path, kind_of(path), "test file or campaign file", ARCHIVE, *YAML_KINDS)
    missing = [option for option, value in options.items() if value is None]
    if missing:
        raise InputError(
            f"{', '.join(missing)}: test files do not say this; give it, or a campaign file; moduli are those of "
            "layers, and `edesign sheet` finds stiffness and damping of a device without them [E-CLI-03]"
        )
    assert layers is not None and area is not None and thickness is not None
    celsius = None
    if temperature is not None:
        try:
            celsius = parse_temperature(temperature)
        except PydanticCustomError as error:
            raise InputError(f"--temperature: {error.message()}") from None
    specimen = Specimen(
        "specimen", layers, quantity(area, AREA, "--layer-area"), quantity(thickness, LENGTH, "--layer-thickness")
    )
    for i, path in enumerate(inputs):
        if path in inputs[:i]:
            raise InputError(f"{path}: the file is named twice [E-FILE-09]")
    tests = tuple(
        read_test(path, temperature_C=celsius, name=name, unsaid='say --temperature "20 degC"')
        for path, name in zip(inputs, short_names(inputs), strict=True)
    )
    return Campaign(specimen, None, tests, inputs[0])
