"""`edesign test`: a programme of damper tests on the virtual rig."""

from __future__ import annotations

import json
import time
from collections.abc import Callable
from pathlib import Path
from typing import Annotated

import typer

from edesign.archive.files import check_folder
from edesign.cli.shared.progress import listener
from edesign.damper.testing.campaign import CAMPAIGN_FILE
from edesign.damper.testing.programme import PROPERTIES_FILE, run_programme
from edesign.damper.testing.programme_file import load_programme
from edesign.damper.testing.property_table import from_properties, usable
from edesign.errors import InputError
from edesign.input_files import spare_inputs
from edesign.optional_stages import optional
from edesign.project.reading.file_bytes import is_there
from edesign.report.damper.measured_figures import draw_tests
from edesign.report.damper.measured_tables import properties_data, properties_table
from edesign.report.drawing.style import check_format
from edesign.report.tables.text import print_tables
from edesign.study.run.progress import Listener, Progress


def test(
    programme: Annotated[Path, typer.Argument(help="The programme of tests (.yaml).", show_default=False)],
    output: Annotated[
        Path | None,
        typer.Option("--output", "-o", metavar="DIR", help="Where to write; NAME_campaign here by default."),
    ] = None,
    overwrite: Annotated[bool, typer.Option("--overwrite", help="Replace a campaign that is there.")] = False,
    figures: Annotated[Path | None, typer.Option("--figures", metavar="DIR", help="Draw tests and properties.")] = None,
    figure_format: Annotated[str, typer.Option("--format", help="Of the figures: svg, png, pdf.")] = "svg",
    as_json: Annotated[bool, typer.Option("--json", help="Print JSON in SI units instead of the table.")] = False,
    quiet: Annotated[bool, typer.Option("--quiet", "-q", help="No progress and no table.")] = False,
) -> None:
    """Run tests of a damper law as a laboratory would run them, and write them as a campaign.

    Written are TEST.csv (time, displacement, force), campaign.yaml, and properties.csv of the steady sines.
    """
    check_format(figure_format)
    plan = load_programme(programme)
    folder = output or Path(f"{programme.stem}_campaign")
    places = folder / CAMPAIGN_FILE, folder / PROPERTIES_FILE
    spare_inputs(*places)
    for place, what in zip(places, ("campaign", "table of properties"), strict=True):
        if is_there(place) and not overwrite:
            raise InputError(f"{place}: there is a {what} already; choose another --output, or --overwrite [E-FILE-07]")
    for written in (folder, figures):
        if written is not None:
            check_folder(written)
    with listener(quiet) as listen:
        run = run_programme(plan, folder, _reporter(listen))
    kept = f"the tests are in {run.campaign.path}"
    if as_json:
        with optional("the properties", kept):
            data = {
                "campaign": str(run.campaign.path),
                **properties_data(run.properties, {}),
                "notes": list(run.warnings),
            }
            print(json.dumps(data, indent=2, allow_nan=False, ensure_ascii=False))
    elif not quiet:
        title = f"{len(run.campaign.tests)} tests of {run.campaign.specimen_name}"
        with optional("the table", kept):
            print_tables([properties_table(title, run.properties, [f"note: {text}" for text in run.warnings])])
        print(f"campaign: {run.campaign.path}")
    if figures is not None:
        with optional("the figures", kept):
            rows = usable(run.properties)[0]
            table = from_properties(rows) if rows else None
            draw_tests(run.campaign, table, figures, figure_format)


def _reporter(listen: Listener) -> Callable[[int, int, str], None]:
    """What the rig calls before each test with its number from 1, the number of tests, and its name.

    The many short tests are shown as one analysis.
    """
    began = time.monotonic()

    def report(index: int, count: int, test_name: str) -> None:
        name = f"{count} virtual tests"
        if index == 1:
            listen(Progress("start", name))
        listen(Progress("advance", name, fraction=(index - 1) / count))
        if index == count:
            seconds = time.monotonic() - began
            listen(Progress("end", name, fraction=1.0, message=f"last: {test_name}", seconds=seconds))

    return report


test.__test__ = False  # type: ignore[attr-defined]  # no test of pytest
