"""What is shown of the archive of the elastic design of a building."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import chain
from typing import TYPE_CHECKING, Any

from edesign.archive.reader import Archive
from edesign.report.archive.kind import ArchiveKind, Figures
from edesign.report.archive.project import missing_analyses
from edesign.report.archive.project_tables import project_tables
from edesign.report.archive.short_tables import short_project_tables
from edesign.report.tables.table import Table
from edesign.space.archived import PLACE
from edesign.study.results.kinds import BUILDING

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from edesign.report.html.section import Section
    from edesign.report.page.source import Source


def _tables(archive: Archive) -> list[Table]:
    from edesign.report.building.tables.all import building_tables

    of_design = [*building_tables(archive)] if archive.has(PLACE) else []
    return [*of_design, *(project_tables(archive) if archive.attributes.get("planned") else [])]


def _short_tables(archive: Archive, top: Table) -> list[Table]:
    from edesign.report.building.tables.all import short_building_tables

    of_design = [*short_building_tables(archive)] if archive.has(PLACE) else []
    return [*of_design, *(short_project_tables(archive, top) if archive.attributes.get("planned") else [])]


def _figures() -> Sequence[Figures]:
    from edesign.report.archive.analysis_figures import FIGURES

    return (building_drawings, *FIGURES)


def building_drawings(archive: Archive) -> Iterator[tuple[str, str, Figure]]:
    """Yield all figures of a building.

    Yields:
        Name of the file, caption and figure.
    """
    from edesign.report.building.figures.curves import mode_shapes, spectra, storey_curves
    from edesign.report.building.figures.elevations import elevations
    from edesign.report.building.figures.force_diagrams import force_diagrams
    from edesign.report.building.figures.model_figures import archived_building_model

    drawn = (archived_building_model, spectra, mode_shapes, storey_curves, elevations, force_diagrams)
    yield from chain.from_iterable(figures(archive) for figures in drawn)


def _sections(source: Source) -> list[Section]:
    from edesign.report.archive.analysis_sections import SECTIONS
    from edesign.report.page.sections.building import building_sections
    from edesign.report.page.sections.provenance import provenance
    from edesign.report.page.source import made_of

    of_design = building_sections(source) if source.archive.has(PLACE) else []
    of_analyses = SECTIONS if source.attributes.get("planned") else (provenance,)
    taken = {section.id for section in of_design}
    return [*of_design, *(section for section in made_of(source, of_analyses) if section.id not in taken)]


def _summary(archive: Archive, names: Sequence[str], whole: bool) -> tuple[dict[str, Any], list[str]]:
    from edesign.report.building.summary import building_summary

    return {"building": building_summary(archive)}, []


BUILDING_KIND = ArchiveKind(
    name=BUILDING,
    report="Design report",
    tables=_tables,
    short_tables=_short_tables,
    figures=_figures,
    sections=_sections,
    unfinished=missing_analyses,
    summary=_summary,
)
