"""Hazard and ground motions: spectra, where the records come from, what the fit changed, criteria of the code."""

from __future__ import annotations

from edesign.report.ground_motion.hazard_figures import hazard_figures
from edesign.report.ground_motion.record_figures import record_figures
from edesign.report.ground_motion.record_tables import tables_of
from edesign.report.html.section import Facts, Folded, Part, Section
from edesign.report.page.project_facts import hazard_rows
from edesign.report.page.source import Source
from edesign.study.results.kinds import RECORDS

OF_SUITES = ("before", "after", "mean", "spectra")  # endings of the figures of a whole suite


def ground_motion(source: Source) -> Section:
    """Return the section on the ground motions; the histories of single records are folded."""
    parts: list[Part] = []
    rows = hazard_rows(source.base.hazard) if source.base is not None and source.base.hazard else []
    if rows:
        parts.append(Facts(tuple(rows)))
    parts += source.pictures(hazard_figures)
    pictures = source.pictures(record_figures)
    of_suites = {f"figure-{name}_{ending}" for name in source.archive.names(RECORDS) for ending in OF_SUITES}
    parts += [picture for picture in pictures if picture.name in of_suites]
    parts += tables_of(source.archive)
    single = tuple(picture for picture in pictures if picture.name not in of_suites)
    if single:
        parts.append(Folded(f"Time histories and spectra of each fitted record ({len(single)})", single))
    return Section("ground-motion", "Hazard and ground motions", (), tuple(parts))
