"""The model as it was analysed: geometry, sections, supports, loads, masses, dampers with the sizes that they got."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from edesign.archive.reader import Archive
from edesign.report.building.figures.model_figures import building_model_figures
from edesign.report.building.figures.variant_elevations import variant_elevations
from edesign.report.html.section import Section
from edesign.report.inputs.designed_dampers import archived_dampers
from edesign.report.model.archived import model_drawings
from edesign.report.page.source import Source, first_of_each
from edesign.space.archived import PLACE

if TYPE_CHECKING:
    from matplotlib.figure import Figure


def model(source: Source) -> Section:
    """Return the section with the drawings of the model; empty where this version cannot read the project."""

    def drawings_of_the_model(archive: Archive) -> Iterator[tuple[str, str, Figure]]:
        if source.project is not None:
            yield from model_drawings(archive, source.project, source.study)
        elif source.building is not None and not archive.has(PLACE):  # a design has drawings of its own
            yield from building_model_figures(source.building)
            if source.study is not None:
                yield from variant_elevations(source.study, archived_dampers(archive, source.study))

    return Section("model", "The model", (), tuple(first_of_each(source.pictures(drawings_of_the_model))))
