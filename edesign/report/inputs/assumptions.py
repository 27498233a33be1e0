"""Assumptions and limits of the analyses of a frame, in sentences that follow from its project."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from edesign.project.analysis.analyses import HistoryAnalysis
from edesign.project.analysis.damping import MassDamping, ModalDamping, NoDamping, RayleighDamping, StiffnessDamping
from edesign.project.frame.foundations import FootingSupport
from edesign.project.frame.frame import Frame
from edesign.project.frame.materials import ElasticMaterial
from edesign.project.frame.members import BeamRun, ColumnRun
from edesign.project.frame.sections import ElasticSection
from edesign.project.frame.supports import support_name
from edesign.project.project import Project
from edesign.project.study.incremental import Incremental
from edesign.project.study.study import Histories, Study
from edesign.report.drawing.captions import plain
from edesign.space.structure.steel_by_thickness import thick_parts

Rows = list[tuple[str, str]]
Shaken = HistoryAnalysis | Histories | Incremental
HEATING = "self_heating"
"""How the effect of a law is called that softens the damper by its own work."""


def assumption_rows(project: Project, study: Study | None = None) -> Rows:
    """Return a topic and its sentences for each assumption; topics that a project has not are left out.

    Args:
        study: of the archive; None: the analyses are those of the project.
    """
    shaken = _shaken(project, study)
    rows = [
        ("Model", _model(project)),
        ("Yielding", _yielding(project)),
        ("Yield strength in checks", thick_parts(project)),
        ("Second-order effects", _second_order(project)),
        ("Floors", _floors(project.frame)),
        ("Mass", _mass(project)),
        ("Inherent damping", _damping(project) if shaken else ""),
        ("Ground and supports", _ground(project)),
        ("Ground motion", _motion(project, shaken)),
        ("Braces", _braces(project)),
        ("Connections", _connections(project)),
        ("Dampers", _dampers(project, study)),
        ("When an analysis has failed", _validity(project, shaken)),
    ]
    return [(topic, text) for topic, text in rows if text]


def _shaken(project: Project, study: Study | None) -> list[Shaken]:
    if study is not None:
        return [*study.histories, *study.incremental]
    return [spec for spec in project.analyses if isinstance(spec, HistoryAnalysis)]


def _model(project: Project) -> str:
    isolated = " on an isolated base" if project.isolation is not None else ""
    without = project.frame.left_in_building
    behind = f" The building has {', '.join(without)} too, which are not in it." if without else ""
    return (
        f"A plane frame{isolated} is analysed. Torsion of the building, the direction across the frame, walls, "
        "stairs and cladding are not in it. Members bend without shear deformations. Floor slabs add no strength to "
        f"beams.{behind}"
    )


def _yielding(project: Project) -> str:
    frame = project.frame
    runs: list[ColumnRun | BeamRun] = [*frame.columns, *frame.beams]
    elastic = [
        isinstance(project.sections.get(run.section), ElasticSection)
        or isinstance(project.materials[run.material], ElasticMaterial)
        for run in runs
    ]
    found = []
    springs = bool(project.hinges) or any(run.resistance is not None for run in project.joints)
    between = "between the hinges and joints at their ends" if springs else ""
    if all(elastic):
        found.append(f"Columns and beams stay elastic {between or 'whatever their forces are'}.")
    else:
        points = project.elements.integration_points
        found.append(
            f"Columns and beams yield in fibres along their length, at {points} sections each, under axial force and "
            "bending together."
        )
        if any(elastic):
            names = dict.fromkeys(run.section for run, stays in zip(runs, elastic, strict=True) if stays)
            found.append(f"Members of {', '.join(names)} stay elastic{f' {between}' if between else ''}.")
        found.append(
            "Shear forces do not make them yield. Local buckling, lateral-torsional buckling and fracture are not "
            "modelled."
        )
    if project.hinges:
        found.append("Plastic hinges at their ends lose strength and stiffness with the rotations that they have had.")
    elif not all(elastic):
        found.append("Strength does not deteriorate with the number of cycles.")
    return " ".join(found)


def _second_order(project: Project) -> str:
    words = {
        "p_delta": "with the loads on the displaced structure (P-Delta)",
        "linear": "with the geometry of the frame at rest",
        "corotational": "with the geometry of large displacements (corotational)",
    }
    kinds = project.elements.geometry
    parts = [f"Columns are analysed {words[kinds.columns]}"]
    parts.append(f"beams {words[kinds.beams]}" if kinds.beams != kinds.columns else "and so are beams")
    text = ", ".join(parts) + "." if kinds.beams != kinds.columns else " ".join(parts) + "."
    if project.frame.leaning_column is not None:
        return text + " A leaning column has the loads of the part of the building that leans on the frame."
    return text + " Loads that stand beside the frame and lean on it are not in it, unless its own loads contain them."


def _floors(frame: Frame) -> str:
    stiff = frame.diaphragms.numbers(1, frame.n_storeys)
    if not stiff:
        return "Floors are no diaphragms: the beams shorten and stretch, and have axial forces."
    which = "All floors are" if len(stiff) == frame.n_storeys else f"Floors {frame.diaphragms} are"
    return (
        f"{which} rigid diaphragms: their nodes move together horizontally. Beams that braces or dampers meet, and "
        "those joined to them, are checked with the axial force by equilibrium of the floor, others without."
    )


def _mass(project: Project) -> str:
    masses = project.masses
    if masses is None:
        return "The frame has no mass."
    if masses.from_loads is not None:
        text = f"The masses are those of the loads {masses.from_loads.G:g} G + {masses.from_loads.Q:g} Q"
    else:
        text = "The masses are given"
    way = "horizontal motion alone" if masses.directions == "horizontal" else "horizontal and vertical motion"
    return f"{text}, lumped at the nodes; they resist {way}."


def _damping(project: Project) -> str:
    damping = project.damping
    if damping is None or isinstance(damping, NoDamping):
        return "There is no inherent damping."
    if isinstance(damping, (RayleighDamping, StiffnessDamping)):
        rayleigh = isinstance(damping, RayleighDamping)
        mass, it = ("the mass and to ", "this second part") if rayleigh else ("", "it")
        words = {
            "current": f"the stiffness of each moment: {it} falls where members yield",
            "committed": f"the stiffness at the end of the last step: {it} falls where members yield",
            "initial": f"the initial stiffness: {it} does not fall where members yield, so that its forces may grow",
        }
        stays = " The part of the mass stays." if rayleigh and damping.stiffness != "initial" else ""
        return f"Damping is proportional to {mass}{words[damping.stiffness]}.{stays}"
    if isinstance(damping, MassDamping):
        return "Damping is proportional to the mass: it acts against the motion of the floors relative to the ground."
    if isinstance(damping, ModalDamping):
        count = damping.count
        modes = "the first mode" if count == 1 else f"the first {count} modes"
        return f"Damping acts in {modes} of the elastic frame alone, whatever yields later."
    return "Damping follows from the elastic frame, whatever yields later."


def _ground(project: Project) -> str:
    frame = project.frame
    footings = [line for line in frame.lines if isinstance(frame.support(line), FootingSupport)]
    if footings:
        lifts = any(
            isinstance(support := frame.support(line), FootingSupport) and support.footing.uplift for line in footings
        )
        return (
            "Footings stand on springs and dashpots of an elastic half-space, taken at one frequency. "
            + ("They lift off. " if lifts else "They do not lift off, and the soil does not give way. ")
            + "The motion of the ground under the building is that of the free field."
        )
    kinds = {support_name(frame.support(line)) for line in frame.lines}
    if "springs" in kinds:
        return "Supports are springs as given. Neighbouring foundations do not move each other."
    return "The ground does not deform: there is no interaction of soil and structure."


def _motion(project: Project, shaken: Sequence[Shaken]) -> str:
    if not shaken:
        return ""
    waves = any(one.wave_passage is not None for one in shaken)
    found = ["The ground motion reaches the supports one after the other." if waves else "All supports move together."]
    vertical = sum(isinstance(one, HistoryAnalysis | Histories) and one.vertical is not None for one in shaken)
    if not vertical:
        found.append("There is no vertical ground motion.")
    elif vertical < len(shaken):
        found.append("Some of the histories have vertical ground motion.")
    else:
        found.append("There is vertical ground motion.")
    return " ".join(found)


def _braces(project: Project) -> str:
    runs = list(project.frame.brace_at.values())
    if not runs:
        return ""
    buckling = sum(run.buckling is not None for run in runs)
    if not buckling:
        return (
            "Braces yield in compression as in tension: they do not buckle. Their compression is compared afterwards."
        )
    some = "Braces buckle" if buckling == len(runs) else "Some of the braces buckle"
    fracture = any(run.buckling is not None and run.buckling.fracture is not None for run in runs)
    return f"{some} in the analysis" + (", and break by low-cycle fatigue." if fracture else ". They do not break.")


def _connections(project: Project) -> str:
    joints = "turn by their stiffness" if project.joints else "are rigid"
    text = f"Connections of beams and columns {joints}, and do not fracture."
    panels = "Panel zones shear as given." if project.panel_zones else "Panel zones do not shear."
    ends = project.elements.rigid_ends
    lengths = (
        " Members are as long as the grid."
        if ends.columns.value == ends.beams.value == 0.0
        else " Members have rigid ends within the joints."
    )
    return f"{text} {panels}{lengths}"


def _dampers(project: Project, study: Study | None) -> str:
    dampers = project.dampers
    if dampers is None or (study is None and dampers.none):
        return ""
    if study is not None and all(variant.dampers == "none" for variant in study.variants.values()):
        return ""
    found = ["Dampers follow their laws, which know no rupture and no end of their stroke unless a law says so."]
    laws = dampers.laws.values()
    if not any(law.file for law in laws) and not _any_heating(law.effects for law in laws):
        found.append("Their temperature does not change during an earthquake.")
    if project.isolation is not None:
        found.append("Isolators carry the gravity loads; dampers are set in under them.")
    elif not any(device.carries_gravity for device in dampers.devices):
        found.append("They are set in under the gravity loads and carry none of them.")
    found.append("A push of the frame has no speed, so that dampers give what is left of their force at rest.")
    pushed = study.pushovers if study is not None else [one for one in project.analyses if one.kind == "pushover"]
    return " ".join(found if pushed else found[:-1])


def _any_heating(effects: Iterable[Iterable[object]]) -> bool:
    return any(getattr(effect, "name", "") == HEATING for several in effects for effect in several)


def _validity(project: Project, shaken: Sequence[Shaken]) -> str:
    limit = project.largest_drift
    text = f"Its energy balance errs by more than {100.0 * project.validity.energy_error:g} %"
    if limit is not None:
        text += f", or the drift of a storey passes {plain(100.0 * limit)} %"
    text += ". It then counts in no mean."
    collapse = {one.collapse_drift for one in shaken if one.collapse_drift is not None}
    if collapse:
        values = " and ".join(f"{100.0 * value:g} %" for value in sorted(collapse))
        text += f" A history counts as collapsed when the drift of a storey passes {values}."
    return text
