"""A project in words and key numbers."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Sequence
from itertools import groupby

from edesign.codes.ec8 import ElasticSpectrum
from edesign.codes.ntc2018 import NtcSpectrum
from edesign.codes.spectrum import Spectrum
from edesign.codes.tabulated import CORRECTIONS, TabulatedSpectrum
from edesign.damper.laws import LAWS
from edesign.errors import EdesignError
from edesign.frame.hinges import member_ends
from edesign.frame.rigid_ends import rigid_ends
from edesign.ground_motion.hazard import action_of, national_values
from edesign.project.actions.hazard import NtcHazard
from edesign.project.actions.hazard_base import YEAR, Hazard
from edesign.project.analysis.damping import CaugheyDamping, MassDamping, ModalDamping, NoDamping, RayleighDamping
from edesign.project.analysis.integration import HHTIntegration, Integration, NewmarkIntegration
from edesign.project.dampers.dampers import DamperLaw
from edesign.project.frame.hinges import Hinges, Joints
from edesign.project.frame.materials import ElasticMaterial
from edesign.project.frame.supports import support_name
from edesign.project.notation.units import STANDARD_GRAVITY
from edesign.project.project import Project
from edesign.report.drawing.captions import plain
from edesign.report.page.load_facts import load_rows

Rows = list[tuple[str, str]]


def project_rows(project: Project) -> Rows:
    """Return geometry, members, steel, loads, damping and integration of a project, without absent ones."""
    frame = project.frame
    columns = [(storey, run.section) for (_, storey), run in frame.column_at.items()]
    beams = [(floor, run.section) for (_, floor), run in frame.beam_at.items()]
    rows = [
        ("Storeys", f"{_lengths(frame.storey_heights)}; {frame.height:g} m in all"),
        ("Bays", f"{_lengths(frame.bay_widths)}; {frame.x[-1]:g} m in all"),
        ("Columns", _over_height(columns, "storey")),
        ("Beams", _over_height(beams, "floor")),
        ("Braces", _braces(project)),
        ("Plastic hinges", _hinges(project)),
        ("Semi-rigid joints", _joints(project)),
        ("Panel zones", _panel_zones(project)),
        ("Rigid ends", _rigid_ends(project)),
        ("Supports", _supports(project)),
        ("Steel", "; ".join(_steel(name, project) for name in project.materials)),
        *load_rows(project),
        ("Inherent damping", _damping(project)),
        ("Integration", _integration(project.integration) if project.integration is not None else ""),
        ("Dampers", _dampers(project)),
        ("Isolation", _isolation(project)),
    ]
    return [(name, text) for name, text in rows if text]


def hazard_rows(hazard: Hazard) -> Rows:
    """Return the action and the levels; nothing if the code does not know them, or a file of theirs is not at hand."""
    action = action_of(hazard)
    try:
        spectra = {level: action.elastic(level) for level in hazard.levels}
        reference = None if hazard.own_shapes else action.elastic(None)
        facts = {level: action.facts(level) for level in hazard.levels}
    except EdesignError:
        return []
    rows = [] if reference is None else [("Reference action", reference.label), ("Spectrum", _shape(reference))]
    rows += [] if (values := national_values(hazard)) is None else [("National values", values)]
    if isinstance(hazard, NtcHazard):
        rows.append(("Class of use", f"{hazard.class_of_use}, nominal life {hazard.nominal_life / YEAR:g} years"))
    for level, spectrum in spectra.items():
        ground = f"peak ground acceleration {plain(spectrum.zero_period / STANDARD_GRAVITY)} g"
        shape = (_shape(spectrum),) if hazard.own_shapes else ()
        rows.append((level, ", ".join(part for part in (facts[level], ground, *shape) if part)))
    return rows


def _shape(spectrum: Spectrum) -> str:
    """Site factor and corner periods, or what a table spans, and damping."""
    factor = f"S = {spectrum.S:.4g}, " if isinstance(spectrum, NtcSpectrum) else ""
    if isinstance(spectrum, ElasticSpectrum):
        p = spectrum.parameters
        factor = f"S = {p.S:g}, " + (f"F_0 = {p.F_0:g}, " if p.F_0 != type(p).F_0 else "")
    corners = ", ".join(f"{name} = {period:.4g} s" for name, period in spectrum.corners.items())
    damping = f"{100 * spectrum.damping:g} % damping"
    if isinstance(spectrum, TabulatedSpectrum):
        corners = ", ".join(part for part in (f"table from 0 s to {spectrum.last_period:g} s", corners) if part)
        if spectrum.correction is not None:
            damping += f", another by {CORRECTIONS[spectrum.correction].title}"
    return f"{factor}{corners}; {damping}"


def _lengths(values: Sequence[float]) -> str:
    """How many lengths there are, and all that follow each other: 3 of 6 m; or 3: 4 m, 2 × 3.5 m."""
    runs = [(value, len(list(same))) for value, same in groupby(values)]
    if len(runs) == 1:
        return f"{len(values)} of {values[0]:g} m"
    of = ", ".join(f"{value:g} m" if count == 1 else f"{count} × {value:g} m" for value, count in runs)
    return f"{len(values)}: {of}"


def _over_height(sections: Iterable[tuple[int, str]], what: str) -> str:
    """Sections with the storeys or floors where they stand."""
    by_number: dict[int, list[str]] = {}
    for number, section in sections:
        by_number.setdefault(number, []).append(section)
    spans = []
    for names, run in groupby(sorted(by_number), key=lambda number: tuple(dict.fromkeys(by_number[number]))):
        numbers = list(run)
        span = f"{what} {numbers[0]}" if len(numbers) == 1 else f"{what}s {numbers[0]}-{numbers[-1]}"
        spans.append(f"{span}: {', '.join(names)}")
    return "; ".join(spans)


def _isolation(project: Project) -> str:
    isolation = project.isolation
    if isolation is None:
        return ""
    under = [f"{item.law} under {_at(str(item.lines))}" for item in isolation.isolators]
    beside = [f"{item.law} at {_at(str(item.lines))}" for item in isolation.beside]
    base = isolation.base
    mass = "" if base.mass is None else f", {plain(base.mass / 1e3)} t"
    beams = "" if base.beams is None else f", beams {base.beams.section}"
    loads = f"base: G = {plain(base.G / 1e3)} kN/m, Q = {plain(base.Q / 1e3)} kN/m{mass}{beams}"
    at = f"design displacement {plain(1e3 * isolation.design_displacement)} mm"
    return "; ".join([*under, *(["beside: " + ", ".join(beside)] if beside else []), loads, at])


def _at(lines: str) -> str:
    return "all lines" if lines == "all" else f"lines {lines}"


def _supports(project: Project) -> str:
    kinds = {line: support_name(project.frame.support(line)) for line in project.frame.lines}
    if len(set(kinds.values())) == 1:
        return next(iter(kinds.values()))
    return ", ".join(f"{line} {kind}" for line, kind in kinds.items())


def _steel(name: str, project: Project) -> str:
    steel = project.materials[name]
    law = steel.law.replace("_", "-")
    text = f"{name}: {law}, E = {plain(steel.E / 1e9)} GPa"
    if isinstance(steel, ElasticMaterial):
        return text
    return f"{text}, f_y = {plain(steel.fy / 1e6)} MPa, hardening {100 * steel.hardening:g} %"


def _braces(project: Project) -> str:
    """How many there are, and how many of them buckle."""
    runs = project.frame.brace_at.values()
    buckling = sum(run.buckling is not None for run in runs)
    return f"{len(runs)}, of which {buckling or 'none'} buckle in the analysis" if runs else ""


def _at_ends(project: Project, run: Hinges | Joints) -> str:
    """The members that springs are at the ends of: at both ends of 6 beams."""
    count = sum(1 for _ in project.frame.members_in(run.beams, run.columns))
    where = "both ends" if run.ends == "both" else f"the {run.ends}"
    return f"at {where} of {count} {'beam' if run.beams is not None else 'column'}{'s' * (count != 1)}"


def _hinges(project: Project) -> str:
    ends = member_ends(project)
    texts = []
    for run in project.hinges:
        names = {name for members in project.frame.members_in(run.beams, run.columns) for name in members}
        found = [end.hinge.M_y / 1e3 for name in names for end in ends[name] if end.hinge is not None]
        by = ", by Lignos and Krawinkler (2011)" if isinstance(run.parameters, str) else ""
        texts.append(f"{_at_ends(project, run)}, M_y = {_range(found)} kN m{by}")
    return "; ".join(texts)


def _range(values: Collection[float]) -> str:
    """The one value, or the least and the largest."""
    low, high = plain(min(values)), plain(max(values))
    return low if low == high else f"{low} to {high}"


def _joints(project: Project) -> str:
    texts = []
    for run in project.joints:
        text = f"{_at_ends(project, run)}, S_j = {plain(run.stiffness / 1e6)} MN m/rad"
        texts.append(text + (f", M_j,Rd = {plain(run.resistance / 1e3)} kN m" if run.resistance is not None else ""))
    return "; ".join(texts)


def _panel_zones(project: Project) -> str:
    texts = []
    for run in project.panel_zones:
        plates = f", doubler plates {plain(1e3 * run.doubler)} mm" if run.doubler is not None else ""
        texts.append(f"lines {run.lines}, floors {run.floors}{plates}")
    return "; ".join(texts)


def _rigid_ends(project: Project) -> str:
    asked = project.elements.rigid_ends
    kinds = (("columns", asked.columns, "beams"), ("beams", asked.beams, "columns"))
    found = rigid_ends(project)
    texts = []
    for kind, end, met in kinds:
        lengths = [1e3 * length for name in found if name[0] == kind[0].upper() for length in found[name] if length]
        if end.is_share and lengths:
            texts.append(f"{kind}: {end} of half the depth of the {met}, {_range(lengths)} mm")
        elif end.value > 0.0:
            texts.append(f"{kind}: {end}")
    return "; ".join(texts)


def _damping(project: Project) -> str:
    damping = project.damping
    if damping is None or isinstance(damping, NoDamping):
        return "none" if damping is not None else ""
    several = damping.ratio if isinstance(damping.ratio, tuple) else (damping.ratio,)
    ratio = f"{', '.join(f'{100 * value:g}' for value in several)} % of critical"
    if isinstance(damping, ModalDamping):
        return f"modal, {ratio} in {f'modes 1-{damping.count}' if damping.count > 1 else 'mode 1'}"
    if isinstance(damping, CaugheyDamping):
        return f"Caughey, {ratio} {_anchors(damping.modes, damping.periods)}"
    if isinstance(damping, RayleighDamping):
        return f"Rayleigh, {ratio} {_anchors(damping.modes, damping.periods)}, {damping.stiffness} stiffness"
    at = _anchors((damping.mode,), None if damping.period is None else (damping.period,))
    if isinstance(damping, MassDamping):
        return f"proportional to mass, {ratio} {at}"
    return f"proportional to the {damping.stiffness} stiffness, {ratio} {at}"


def _anchors(modes: Sequence[int] | None, periods: Sequence[float] | None) -> str:
    """Where damping has its ratio: in modes, or at periods."""
    if periods is not None:
        return f"at {' and '.join(f'{period:g}' for period in periods)} s"
    numbers = [str(mode) for mode in modes or ()]
    return f"in mode{'s' * (len(numbers) > 1)} {' and '.join(numbers)}"


def _integration(method: Integration) -> str:
    step = f"steps of {method.time_step:g} s" if method.time_step is not None else "steps of the record"
    if isinstance(method, NewmarkIntegration):
        return f"Newmark, γ = {method.gamma:g}, β = {method.beta:g}, {step}"
    if isinstance(method, HHTIntegration):
        return f"Hilber-Hughes-Taylor, alpha = {method.alpha:g}, {step}"
    return f"generalised alpha, rho_inf = {method.rho_inf:g}, {step}"


def _law_title(law: DamperLaw) -> str:
    """What a law is in words, or the file that it stands in."""
    return LAWS[law.type].title if law.type in LAWS else law.file or law.type or ""


def _dampers(project: Project) -> str:
    if project.dampers is None:
        return ""
    laws = [f"{name} ({_law_title(law)})" for name, law in project.dampers.laws.items()]
    runs = [f"{run.kind.replace('_', ' ')} of {run.law}" for run in project.dampers.devices]
    tuned = [run.kind.replace("_", " ") for run in project.dampers.attachments]
    parts = (
        "laws: " + ", ".join(laws) if laws else "",
        "devices: " + ", ".join(runs) if runs else "",
        ", ".join(tuned),
    )
    return "; ".join(part for part in parts if part)
