"""What other values of the project, and bounds of the dampers' properties, make of the response."""

from __future__ import annotations

from edesign.report.derived_tables import derived_tables
from edesign.report.page.section import Section
from edesign.report.page.source import Source
from edesign.report.vary_figures import vary_figures


def derived(source: Source) -> Section:
    """Measures by each value that the study varies, and envelopes over bounds."""
    title = "Other values and bounds"
    study = source.study
    if study is None or not study.derived:
        return Section("derived", title)
    tables = derived_tables(study, source.sets)
    return Section("derived", title, (), (*source.pictures(vary_figures), *tables))
