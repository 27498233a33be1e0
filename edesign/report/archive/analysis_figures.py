"""The figures of records, hazard, analyses and designs, which archives of several kinds have."""

from __future__ import annotations

from edesign.report.archive.kind import Figures
from edesign.report.capacity.pushover_figures import pushover_figures
from edesign.report.capacity.target_hinges import hinge_figures
from edesign.report.design.figures import design_figures
from edesign.report.ground_motion.hazard_figures import hazard_figures
from edesign.report.ground_motion.record_figures import record_figures
from edesign.report.model.force_envelopes import force_envelopes
from edesign.report.response.axial_figures import axial_figures
from edesign.report.response.brace_figures import brace_figures
from edesign.report.response.damper_loops import damper_figures
from edesign.report.response.energy_figures import energy_figures
from edesign.report.response.frame_figures import frame_figures
from edesign.report.response.interaction_figures import interaction_figures
from edesign.report.response.mean_profiles import mean_profile_figures
from edesign.report.response.mode_figures import mode_figures
from edesign.report.response.moment_rotation_figures import moment_rotation_figures
from edesign.report.response.orbits import orbit_figures
from edesign.report.response.profile_figures import profile_figures
from edesign.report.response.response_figures import response_figures
from edesign.report.response.temperature_figures import temperature_figures

FIGURES: tuple[Figures, ...] = (
    hazard_figures,
    record_figures,
    mode_figures,
    design_figures,
    pushover_figures,
    hinge_figures,
    mean_profile_figures,
    profile_figures,
    frame_figures,
    axial_figures,
    interaction_figures,
    force_envelopes,
    response_figures,
    orbit_figures,
    energy_figures,
    moment_rotation_figures,
    brace_figures,
    damper_figures,
    temperature_figures,
)
"""In the order of the report."""
