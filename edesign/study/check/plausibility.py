"""Whether the frame of a project is one that somebody would build: period, masses, damping, state under gravity.

Mistakes of units change masses and stiffnesses by ten times or more. The bands are so wide that a frame which was meant
stays inside, and such a mistake leaves them.
"""

from __future__ import annotations

import math
from itertools import pairwise

import numpy as np

from edesign.archive.dataset import Group
from edesign.assess.acceptance import ELASTIC_ROTATION
from edesign.assess.envelopes import peak
from edesign.assess.measures import located_measure
from edesign.damper.testing.specimen import LARGE_STRAIN, layer_warning
from edesign.frame.loads import gravity_load
from edesign.frame.masses import node_masses
from edesign.frame.sections.named_section import cross_section
from edesign.project.analysis.analyses import GravityAnalysis
from edesign.project.analysis.damping import NoDamping
from edesign.project.frame.materials import ElasticMaterial
from edesign.project.frame.sections import ElasticSection
from edesign.project.notation.plausible_range import HEIGHT, WIDTH
from edesign.project.notation.units import STANDARD_GRAVITY
from edesign.project.project import Project
from edesign.project.reading.problems import listed
from edesign.study.analysis.dampers import without_dampers_in_modes
from edesign.study.analysis.gravity import run_gravity
from edesign.study.design.plausibility import percent
from edesign.study.results.warnings import warnings_of

STIFF = 0.050
"""C_t of the stiffest structures in EN 1998-1, 4.3.3.2.2(3), Eq. 4.6: T1 = C_t H^(3/4), s and m."""
TEN_TIMES = math.sqrt(10.0)
"""What a mass ten times too small or a stiffness ten times too large divides the period by."""
SENSITIVITY = 0.3
"""Largest interstorey drift sensitivity coefficient that EN 1998-1, 4.4.2.2(5) allows."""
LEAST_BEHAVIOUR_FACTOR = 1.5
"""EN 1998-1, 6.1.2, Table 6.1, low dissipative steel structures: taken where the project has no `behaviour_factor`."""
YIELD_STRAINS = (3e-4, 1e-2)
"""fy / E: steels of a low yield point for dampers have 100 MPa, 0.05 %; S700 has 0.33 %, alloys of titanium 0.9 %."""
LEAST_WEIGHT, LARGEST_WEIGHT = 0.3, 30.0
"""Weight of the masses over the gravity loads. Two frames at the perimeter of a building of ten bays hold ten times
what stands on them; 30 lies half way, in logarithms, from there to a mistake of a hundred times. Masses may leave out
a part of the loads; 0.3 lies half way to loads in kN that were taken for masses in t, ten times too small."""
LARGEST_DAMPING = 0.28
"""EN 1998-1, 3.2.2.2(3), Eq. 3.6: eta = sqrt(10/(5 + xi)) >= 0.55 counts no more, whatever dissipates."""
_ROTATIONS = (
    ("beam", "beams", "rotation"),
    ("column", "columns", "rotation"),
    ("panel", "panel zones", "distortion"),
)
"""What yields in bending or shear: coordinate in archives, word, and which plastic rotation it has there."""
_ROUNDING = 1e-9  # of a force that equals the resistance
LARGEST_GRAVITY_DRIFT = 0.01
"""EN 1998-1, 4.4.3.2(1)c: what the earthquake of damage limitation may cause; gravity alone leaves a frame upright."""


def implausible(project: Project, period: float | None) -> list[str]:
    """Return one sentence for each property of a frame outside the range of built steel frames.

    Args:
        period: T1 under gravity, of an isolated frame with its base fixed, s; None without masses, or if it is not
            known.

    Raises:
        InputError: the frame cannot be built.
        CoreError: it is a mechanism.
    """
    found = [_period(project, period) if period is not None else "", _weight(project), _damping(project)]
    sizes_of = [*_lengths(project), *_materials(project), *_devices(project)]
    return [*sizes_of, *(text for text in found if text), *_under_gravity(project)]


def sizes(project: Project) -> str:
    """Return storeys, bays, moduli and gravity loads of a project in words with units."""
    y, x = project.frame.levels, project.frame.x
    heights = [upper - lower for lower, upper in pairwise(y)]
    widths = [right - left for left, right in pairwise(x)]
    moduli = ", ".join(f"E of {name} is {material.E / 1e9:.4g} GPa" for name, material in project.materials.items())
    storeys = f"storeys are {min(heights):.4g} to {max(heights):.4g} m high"
    bays = f", bays {min(widths):.4g} to {max(widths):.4g} m wide" if widths else ""
    return f"{storeys}{bays}; {moduli}; gravity loads are {gravity_load(project) / 1e3:.4g} kN"


def _lengths(project: Project) -> list[str]:
    """Storeys and bays that no member spans, as in building files."""
    found = []
    for what, places, bounds in (("storey", project.frame.levels, HEIGHT), ("bay", project.frame.x, WIDTH)):
        for number, (start, end) in enumerate(pairwise(places), start=1):
            if bounds.refuses(end - start):
                found.append(
                    f"{what} {number}: {end - start:.4g} m is implausible as {bounds.what}, which is "
                    f"{bounds.shown(bounds.possible)} ({bounds.why})"
                )
    return found


def _materials(project: Project) -> list[str]:
    """Materials that yield at a strain at which no structural metal does."""
    low, high = YIELD_STRAINS
    return [
        f"material {name}: fy = {1e-6 * material.fy:.4g} MPa over E = {1e-9 * material.E:.4g} GPa is a yield strain of "
        f"{100.0 * material.fy / material.E:.3g} %; structural metals have {100.0 * low:g} to {100.0 * high:g} %"
        for name, material in project.materials.items()
        if not isinstance(material, ElasticMaterial) and not low <= material.fy / material.E <= high
    ]


def _devices(project: Project) -> list[str]:
    """Dampers with layers that nobody makes, or that are to strain further than elastomers do."""
    found = []
    for i, run in enumerate(project.dampers.devices if project.dampers is not None else ()):
        assert project.dampers is not None
        prototype = project.dampers.laws[run.law].prototype
        own = run.layer_thickness or (prototype.layer_thickness if prototype is not None else None)
        areas = run.layer_area or ((prototype.layer_area,) if prototype is not None else ())
        texts = []
        if own is not None:
            areas = areas if isinstance(areas, tuple) else (areas,)
            texts += [warning for area in areas if (warning := layer_warning(area, own))][:1]
            amplitudes = run.design_deformation or ()
            strain = max(amplitudes if isinstance(amplitudes, tuple) else (amplitudes,), default=0.0) / own
            if strain > LARGE_STRAIN:
                texts.append(
                    f"design_deformation is a shear strain of {percent(strain)} of layers {1e3 * own:.4g} mm thick"
                )
        if run.strain_limit is not None and run.strain_limit > LARGE_STRAIN:
            texts.append(f"a strain limit of {percent(run.strain_limit)} is more than elastomers of dampers bear")
        found += [f"dampers.devices[{i}]: {text}" for text in texts]
    return found


def _period(project: Project, period: float) -> str:
    """Say what is wrong with a period, "" if it is plausible.

    Under its own weight, applied horizontally, a frame moves by d = T1^2/4 (EN 1998-1, Eq. 4.9: T1 = 2 sqrt(d), in m).
    Its mean interstorey drift sensitivity coefficient theta = P_tot d_r / (V_tot h) (Eq. 4.28, d_r = q d_e) is then
    q d/H. More than 0.3 is not allowed, and stands for a frame that falls rather than sways.
    """
    height = project.grid.height
    left_out = " and ".join(
        ["isolators"] * (project.isolation is not None) + ["dampers"] * without_dampers_in_modes(project)
    )
    of = f"T1 = {period:.3g} s{f' without its {left_out}' if left_out else ''}"
    q = project.hazard.q if project.hazard is not None else None
    q = q or LEAST_BEHAVIOUR_FACTOR
    low, high = STIFF * height**0.75 / TEN_TIMES, 2.0 * math.sqrt(SENSITIVITY * height / q)
    if period > high:
        return (
            f"{of} is implausible for a frame {height:.3g} m high: from {high:.2g} s on its interstorey "
            f"drift sensitivity exceeds {SENSITIVITY:g} (with q = {q:g}); are masses too large, or "
            "sections too small?"
        )
    if period < low:
        return (
            f"{of} is implausible for a frame {height:.3g} m high: up to {low:.2g} s its masses are ten "
            f"times too small for the stiffest frames ({STIFF:.2f} H^(3/4)), or its sections too large"
        )
    return ""


def _weight(project: Project) -> str:
    """Say what is wrong with the masses, "" if they are plausible; a frame without gravity loads has no ratio."""
    weight = STANDARD_GRAVITY * sum(node_masses(project).values())
    loads = gravity_load(project)
    if weight == 0.0 or loads <= 0.0 or LEAST_WEIGHT <= weight / loads <= LARGEST_WEIGHT:
        return ""
    return (
        f"the masses weigh {1e-3 * weight:.4g} kN, {weight / loads:.3g} times the gravity loads of {1e-3 * loads:.4g} "
        f"kN; {LEAST_WEIGHT:g} to {LARGEST_WEIGHT:g} times are plausible (frames at the perimeter carry masses of the "
        "whole building)"
    )


def _damping(project: Project) -> str:
    damping = project.damping
    ratio = 0.0
    if damping is not None and not isinstance(damping, NoDamping):
        ratio = max(damping.ratio) if isinstance(damping.ratio, tuple) else damping.ratio
    if ratio <= LARGEST_DAMPING:
        return ""
    return (
        f"an inherent damping of {100.0 * ratio:g} % is implausible: spectra of codes count up to "
        f"{100.0 * LARGEST_DAMPING:g} %, devices included, and steel frames have a few per cent"
    )


def _under_gravity(project: Project) -> list[str]:
    """What the gravity loads alone do to the frame."""
    group = run_gravity(project, GravityAnalysis(kind="gravity", name="gravity"))
    if group.attributes["status"] != "completed":
        return [f"under the gravity loads alone {group.attributes['reason']}"]
    found = []
    drift = located_measure(group, "interstorey_drift")
    if drift is not None and drift.value > LARGEST_GRAVITY_DRIFT:
        found.append(
            f"the gravity loads alone make a drift of {100.0 * drift.value:.3g} % in storey {drift.storey}, more than "
            f"{100.0 * LARGEST_GRAVITY_DRIFT:g} %"
        )
    for of, what, kind in _ROTATIONS:
        rotations = peak(group, f"{of}_plastic_{kind}")
        if rotations is None or rotations.max() <= ELASTIC_ROTATION:
            continue
        worst = group.coords[of].values[np.unravel_index(np.argmax(rotations), rotations.shape)[0]]
        found.append(
            f"{what} yield under the gravity loads alone, most {worst} with a plastic {kind} of "
            f"{1e3 * rotations.max():.3g} mrad"
        )
    found += _yielding_braces(project, group)
    return found + [f"under the gravity loads alone {warning.text}" for warning in warnings_of(group)]


def _yielding_braces(project: Project, group: Group) -> list[str]:
    """Braces, and cores of buckling-restrained ones, that the gravity loads alone bring to their yield force."""
    usage: dict[str, float] = {}
    forces, ductility = peak(group, "brace_axial_force"), peak(group, "core_ductility")
    if forces is not None:
        for name, force in zip(map(str, group.coords["brace"].values), forces, strict=True):
            run = project.grid.members[name]
            steel = project.materials[run.material]
            section = cross_section(project, run.section)
            if not isinstance(steel, ElasticMaterial) and not isinstance(section, ElasticSection):
                usage[name] = float(force) / (section.area * steel.fy)
    if ductility is not None:
        usage |= dict(zip(map(str, group.coords["damper"].values), map(float, ductility), strict=True))
    beyond = {name: ratio for name, ratio in usage.items() if ratio >= 1.0 - _ROUNDING}
    if not beyond:
        return []
    most = max(beyond, key=beyond.__getitem__)
    return [f"braces yield under the gravity loads alone: {listed(beyond, 3)}, most {most}"]
