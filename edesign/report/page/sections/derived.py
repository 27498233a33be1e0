"""What other values of the project, and bounds of the dampers' properties, make of the response."""

from __future__ import annotations

from edesign.report.assessment.derived_tables import derived_tables
from edesign.report.assessment.vary_figures import vary_figures
from edesign.report.html.section import Section
from edesign.report.page.source import Source


def derived(source: Source) -> Section:
    """Return the section on the measures at each value that the study varies, and on envelopes over bounds."""
    title = "Other values and bounds"
    study = source.study
    if study is None or not study.derived:
        return Section("derived", title)
    tables = derived_tables(study, source.sets)
    return Section("derived", title, (), (*source.pictures(vary_figures), *tables))
