"""The sections of the report of a project or study."""

from __future__ import annotations

from collections.abc import Callable

from edesign.report.html.section import Section
from edesign.report.page.sections.assumptions import assumptions
from edesign.report.page.sections.braces import braces
from edesign.report.page.sections.dampers import dampers
from edesign.report.page.sections.derived import derived
from edesign.report.page.sections.design import design
from edesign.report.page.sections.ground_motion import ground_motion
from edesign.report.page.sections.hinges import hinges
from edesign.report.page.sections.histories import histories
from edesign.report.page.sections.incremental import incremental
from edesign.report.page.sections.inputs import inputs
from edesign.report.page.sections.isolation import isolation
from edesign.report.page.sections.model import model
from edesign.report.page.sections.modes import modes
from edesign.report.page.sections.moment_rotation import moment_rotation
from edesign.report.page.sections.motion import motion
from edesign.report.page.sections.provenance import provenance
from edesign.report.page.sections.pushover import pushover
from edesign.report.page.sections.response import response
from edesign.report.page.sections.summary import summary
from edesign.report.page.sections.temperature import temperature
from edesign.report.page.sections.verdicts import checks
from edesign.report.page.sections.warnings import warnings
from edesign.report.page.source import Source

SECTIONS: tuple[Callable[[Source], Section], ...] = (
    summary,
    checks,
    model,
    assumptions,
    warnings,
    inputs,
    ground_motion,
    modes,
    isolation,
    design,
    pushover,
    response,
    motion,
    hinges,
    braces,
    moment_rotation,
    histories,
    dampers,
    temperature,
    derived,
    incremental,
    provenance,
)
"""In the order of the page; those without content are left out."""
