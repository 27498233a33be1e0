"""What the inherent damping of a frame does to its tuned masses."""

from __future__ import annotations

import math

from edesign.errors import AnalysisError
from edesign.frame.damping import modes_needed, proportional_factors
from edesign.project.analysis.damping import MassDamping, RayleighDamping, StiffnessDamping
from edesign.project.analysis_file import AnalysisFile
from edesign.project.reading.words import percent
from edesign.study.analysis.dampers import attachments
from edesign.study.analysis.structure import frame_alone


def tuned_mass_advice(project: AnalysisFile) -> list[str]:
    """Say how much damping of tuned masses is not their own: C = a0 M + a1 K acts on their mass and their spring.

    Source: a0 / (2 omega) + a1 omega / 2; Chopra, Dynamics of Structures, Eq. (11.4.8).
    """
    damping, masses = project.damping, attachments(project)
    if not masses or not isinstance(damping, RayleighDamping | MassDamping | StiffnessDamping):
        return []
    try:
        alone = frame_alone(project)
        if damping.state == "gravity":
            alone.apply_gravity()
        a0, a1 = proportional_factors(damping, alone.modes(max(modes_needed(damping, 1), 1)).omega)
    except AnalysisError:
        return []  # the analyses will say why
    found = []
    for mass in masses:
        omega = math.sqrt(mass.stiffness / mass.mass)
        own, more = mass.damping / (2.0 * mass.mass * omega), a0 / (2.0 * omega) + a1 * omega / 2.0
        found.append(
            f"{mass.name} has {percent(own)} of critical damping, and `{damping.kind}` damping of the frame adds "
            f"{percent(more)}: it acts on the attached mass too; `modal` does not"
        )
    return found
