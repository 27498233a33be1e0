"""Whether the frame of a project is one that somebody would build: period, masses, damping, state under gravity.

Mistakes of units change masses and stiffnesses by ten times or more. The bands are so wide that a frame which was meant
stays inside, and such a mistake leaves them.
"""

from __future__ import annotations

import math

from edesign.assess.measures import located_measure
from edesign.building.loads import beam_loads, node_loads
from edesign.building.masses import node_masses
from edesign.project import names
from edesign.project.analyses import GravityAnalysis
from edesign.project.damping import NoDamping
from edesign.project.project import Project
from edesign.project.units import STANDARD_GRAVITY
from edesign.study.gravity import run_gravity
from edesign.study.warnings import warnings_of

STIFF = 0.050
"""C_t of the stiffest structures in EN 1998-1, 4.3.3.2.2(3), Eq. 4.6: T1 = C_t H^(3/4), s and m."""
TEN_TIMES = math.sqrt(10.0)
"""What a mass ten times too small or a stiffness ten times too large divides the period by."""
SENSITIVITY = 0.3
"""Largest interstorey drift sensitivity coefficient that EN 1998-1, 4.4.2.2(5) allows."""
LEAST_BEHAVIOUR_FACTOR = 1.5
"""EN 1998-1, 6.1.2, Table 6.1: of low dissipative steel structures; taken where the project has no `behaviour_factor`."""
LEAST_WEIGHT, LARGEST_WEIGHT = 0.3, 30.0
"""Weight of the masses over the gravity loads. Two frames at the perimeter of a building of ten bays hold ten times
what stands on them: 30 lies half way, in logarithms, from there to a mistake of a hundred times. The least lies half way
from masses without the variable loads, about half, to loads in kN taken for masses in t, ten times too small."""
LARGEST_DAMPING = 0.15
"""Largest damping ratio that Newmark & Hall (1982) recommend for steel: bolted, at or just below yielding."""
LARGEST_GRAVITY_DRIFT = 0.01
"""EN 1998-1, 4.4.3.2(1)c: what the earthquake of damage limitation may cause; gravity alone leaves a frame upright."""
ELASTIC_ROTATION = 1e-3
"""Plastic rotation, rad, up to which only outer fibres have yielded, about a tenth of the rotation at yielding."""


def implausible(project: Project, period: float | None) -> list[str]:
    """Return a sentence for each property of a frame that is outside of what is built.

    Args:
        project: the validated project.
        period: T1 under gravity, s; None without masses, or if it is not known.

    Raises:
        InputError: the frame cannot be built.
        CoreError: it is a mechanism.
    """
    found = [_period(project, period) if period is not None else "", _weight(project), _damping(project)]
    return [*(text for text in found if text), *_under_gravity(project)]


def _period(project: Project, period: float) -> str:
    """Say what is wrong with a period, "" if it is plausible.

    Under its own weight, applied horizontally, a frame moves by d = T1^2/4 (EN 1998-1, Eq. 4.9: T1 = 2 sqrt(d), m). With
    P_tot / V_tot = 1, d/H is its mean interstorey drift over P_tot / V_tot, so that q d/H is the mean interstorey drift
    sensitivity coefficient theta = P_tot d_r / (V_tot h) of Eq. 4.28, with d_r = q d_e. A frame with a larger theta than
    0.3 is not allowed.
    """
    height = project.frame.height
    q = project.hazard.behaviour_factor if project.hazard is not None else None
    q = q or LEAST_BEHAVIOUR_FACTOR
    low, high = STIFF * height**0.75 / TEN_TIMES, 2.0 * math.sqrt(SENSITIVITY * height / q)
    if period > high:
        return (
            f"T1 = {period:.3g} s is implausible for a frame {height:.3g} m high: from {high:.2g} s on its interstorey "
            f"drift sensitivity exceeds {SENSITIVITY:g} (EN 1998-1, 4.4.2.2, with q = {q:g}); are masses too large, or "
            "sections too small?"
        )
    if period < low:
        return (
            f"T1 = {period:.3g} s is implausible for a frame {height:.3g} m high: stiff ones have {STIFF:.2f} H^(3/4) = "
            f"{STIFF * height**0.75:.2g} s (EN 1998-1, Eq. 4.6), and this is less than 1/{TEN_TIMES:.2g} of it; are "
            "masses too small, or sections too large?"
        )
    return ""


def _weight(project: Project) -> str:
    """Loads are those of gravity on beams and nodes; a frame without any has no ratio."""
    weight = STANDARD_GRAVITY * sum(node_masses(project).values())
    loads = sum(node_loads(project, project.loads.gravity).values())
    widths = project.frame.bay_widths
    on_beams = beam_loads(project, project.loads.gravity)
    loads += sum(
        on_beams.get(names.beam_name(bay, floor), 0.0) * widths[bay - 1] for bay, floor in project.frame.beam_at
    )
    if weight == 0.0 or loads <= 0.0 or LEAST_WEIGHT <= weight / loads <= LARGEST_WEIGHT:
        return ""
    return (
        f"the masses weigh {1e-3 * weight:.4g} kN, {weight / loads:.3g} times the gravity loads of {1e-3 * loads:.4g} "
        f"kN; {LEAST_WEIGHT:g} to {LARGEST_WEIGHT:g} times are plausible (frames at the perimeter carry masses of the "
        "whole building)"
    )


def _damping(project: Project) -> str:
    damping = project.damping
    if damping is None or isinstance(damping, NoDamping) or damping.ratio <= LARGEST_DAMPING:
        return ""
    return (
        f"the inherent damping of {100.0 * damping.ratio:g} % is more than the {100.0 * LARGEST_DAMPING:g} % that "
        "Newmark & Hall (1982) recommend for steel at most; dampers come under `dampers`"
    )


def _under_gravity(project: Project) -> list[str]:
    """What the gravity loads alone do to the frame."""
    group = run_gravity(project, GravityAnalysis(kind="gravity", name="gravity", dampers=False))
    if group.attributes["status"] != "completed":
        return [f"under the gravity loads alone {group.attributes['reason']}"]
    found = []
    drift = located_measure(group, "interstorey_drift")
    if drift is not None and drift.value > LARGEST_GRAVITY_DRIFT:
        found.append(
            f"the gravity loads alone make a drift of {100.0 * drift.value:.3g} % in storey {drift.storey}, more than "
            f"{100.0 * LARGEST_GRAVITY_DRIFT:g} %"
        )
    for kind in ("beam", "column"):
        most = located_measure(group, f"{kind}_plastic_rotation_rad")
        if most is not None and most.value > ELASTIC_ROTATION:
            found.append(
                f"{kind}s yield under the gravity loads alone, most {most.member} with a plastic rotation of "
                f"{1e3 * most.value:.3g} mrad"
            )
    return found + [f"under the gravity loads alone {warning.text}" for warning in warnings_of(group)]
