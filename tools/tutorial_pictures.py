"""Draws the pictures of the tutorials and of the README: runs what the pages say, and draws what came of it.

Usage: python tools/tutorial_pictures.py [PAGE...]          (all pages with pictures by default; some ten seconds each)
"""

from __future__ import annotations

import re
import sys
import tempfile
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import TYPE_CHECKING

from edesign.archive.reader import open_archive
from edesign.report.archive.figures import all_figures
from edesign.report.html.inline_svg import inline_svg

if TYPE_CHECKING:
    from matplotlib.figure import Figure

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT))
TUTORIALS = ROOT / "docs" / "tutorials"
FONT = "font-family:system-ui,'Segoe UI',Helvetica,Arial,sans-serif"
Drawn = Iterator[tuple[str, str, "Figure"]]


def of_archive(folder: Path) -> Drawn:
    """All figures of the study of the first tutorial."""
    with open_archive(folder / "my_building" / "study.h5") as archive:
        yield from all_figures(archive)


def of_tests(folder: Path) -> Drawn:
    """A test, and the properties of all."""
    from edesign.damper.testing.campaign import load_campaign
    from edesign.damper.testing.property_table import read_property_table
    from edesign.report.damper.measured_figures import measured_figure, properties_figure

    campaign = load_campaign(folder / "tests" / "campaign.yaml")
    third = campaign.tests[2]
    yield "loop", f"Displacement, force and loop of {third.title}", measured_figure(third, campaign.specimen)
    table = read_property_table(folder / "properties.csv")
    yield "properties", "Properties over frequency", properties_figure(table, 20.0)


def of_calibration(folder: Path) -> Drawn:
    """All figures of the calibration of the last tutorial."""
    from edesign.calibration import calibrate
    from edesign.damper.testing.campaign import load_campaign
    from edesign.report.calibration.figures import calibration_figures

    yield from calibration_figures(calibrate(load_campaign(folder / "tests" / "campaign.yaml")))


def of_building(folder: Path) -> Drawn:
    """All figures of a designed building, and of the study of its frames or of itself: up to 35 histories."""
    from tools.doc_pages import printed_by

    printed_by("edesign run study.yaml --workers 2", folder)
    for name in ("designed.h5", "study.h5"):
        with open_archive(folder / name) as archive:
            yield from ((f"{name}/{figure}", caption, drawn) for figure, caption, drawn in all_figures(archive))


PICTURES: dict[str, tuple[Callable[[Path], Drawn], dict[str, str]]] = {
    "first_damped_building": (
        of_archive,
        {
            "response_DBE_el_centro": "first_response",
            "energy_DBE_el_centro": "first_energy",
            "loops_damped_DBE_el_centro": "first_loops",
        },
    ),
    "damper_test": (of_tests, {"loop": "test_loop", "properties": "test_properties"}),
    "what_the_law_lacks": (
        of_calibration,
        {"errors": "lacks_errors", "loops": "lacks_loops", "residuals": "lacks_residuals"},
    ),
    "building": (
        of_building,
        {"designed.h5/elevation_X2": "building_use", "study.h5/profile_storey_drift_DBE": "building_drift"},
    ),
    "irregular_plan": (
        of_building,
        {"designed.h5/plan_1": "irregular_plan", "study.h5/profile_storey_drift_DBE_y": "irregular_drift"},
    ),
}
"""Of each page: what draws, and the figures that are wanted with the names of their files."""


def main(pages: list[str]) -> None:
    """Write the pictures of some pages."""
    from tools.doc_pages import follow

    for page in pages or PICTURES:
        draw, wanted = PICTURES[page]
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            for step, _ in follow(TUTORIALS / f"{page}.md", folder):
                print(f"{page}: {step.kind} {step.name}", flush=True)
            missing = set(wanted)
            for figure_name, caption, figure in draw(folder):
                if figure_name in wanted:
                    write(figure, caption, TUTORIALS / "figures" / f"{wanted[figure_name]}.svg")
                    missing.discard(figure_name)
        if missing:
            sys.exit(f"{page}: nothing drew {', '.join(sorted(missing))}")


def write(figure: Figure, caption: str, path: Path) -> None:
    """Write a figure as a small SVG of its own, on white: pages may be dark.

    Args:
        figure: as the report draws it.
        caption: for those who cannot see it.
        path: of the file.
    """
    element, width = inline_svg(figure, path.stem, caption)
    box = re.search(r'viewBox="0 0 ([0-9.]+) ([0-9.]+)"', element)
    assert box is not None
    height = width * float(box[2]) / float(box[1])
    size = f'xmlns="http://www.w3.org/2000/svg" width="{1.4 * width:.0f}" height="{1.4 * height:.0f}" style="{FONT}"'
    path.parent.mkdir(exist_ok=True)
    path.write_text(element.replace("<svg", f"<svg {size}", 1) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main(sys.argv[1:])
