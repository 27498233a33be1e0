"""The model of a project as figures: geometry and sections with dampers, loads and masses."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Sequence
from typing import TYPE_CHECKING

from edesign.project.frame.materials import ElasticMaterial
from edesign.project.project import Project
from edesign.report.drawing.captions import file_name
from edesign.report.drawing.frame_drawing import FrameElevation
from edesign.report.model.devices import DevicesOnSheet
from edesign.report.model.elevation import Elevation, draw_axes
from edesign.report.model.ends import draw_ends
from edesign.report.model.loads import draw_loads, load_entries
from edesign.report.model.masses import draw_masses
from edesign.report.model.members import draw_frame_members, draw_sections, member_steels
from edesign.report.model.sheet import Entry, Sheet, on_sheet, unwritten
from edesign.report.model.supports import draw_supports
from edesign.report.model.words import section_words, short, steels_of

if TYPE_CHECKING:
    from matplotlib.figure import Figure

Named = tuple[str, str, "Figure"]
WIDTH = 6.6  # of the legend, inches


def project_figures(project: Project, heading: Sequence[str] = ()) -> Iterator[Named]:
    """Yield the drawings of a project's model.

    Args:
        heading: lines above each drawing; (): none.

    Yields:
        Name of the file, caption and figure.
    """
    yield geometry(project, heading)
    if has_loads(project):
        yield loads_and_masses(project, heading)


def geometry(project: Project, heading: Sequence[str] = (), of: str = "") -> Named:
    """Return the drawing of axes, members, supports and dampers; otherwise as `project_figures`.

    Args:
        of: what the model is of where there are several: `variant damped`.
    """
    dampers = ", dampers" if has_dampers(project) else ""
    caption = f"The model{_of(of)}: axes, spans, heights and levels in m, sections, supports{dampers}."
    return file_name("model", of), caption + _scales(project), geometry_figure(project, _under(heading, caption))


def loads_and_masses(project: Project, heading: Sequence[str] = (), of: str = "") -> Named:
    """Return the drawing of loads and masses; arguments as `geometry`."""
    caption = f"Loads and masses of the model{_of(of)}: permanent (G) and variable (Q) loads in kN/m and kN."
    captioned = f"{caption} The sums are those of the floors.{_scales(project)}"
    return file_name("model_loads", of), captioned, loads_figure(project, _under(heading, caption))


def _of(what: str) -> str:
    return f" of {what}" if what else ""


def _under(heading: Sequence[str], caption: str) -> tuple[str, ...]:
    return (*heading, caption.rstrip(".")) if heading else ()


def has_dampers(project: Project) -> bool:
    """Return whether dampers, isolators or tuned masses stand in a project's frame."""
    return project.dampers is not None and not project.dampers.none


def has_loads(project: Project) -> bool:
    """Return whether a project has loads or masses to draw."""
    loads = project.loads
    return bool(
        loads.are_vertical or loads.columns or project.masses or project.frame.leaning_column or project.isolation
    )


def geometry_figure(project: Project, heading: Sequence[str] = (), tested: Collection[str] = ()) -> Figure:
    """Draw axes, members with their sections, supports, ends of members, and dampers with laws and sizes.

    Args:
        heading: lines above the drawing; (): none.
        tested: names of the dampers that stand in a laboratory.
    """

    def draw(sheet: Sheet) -> None:
        place = Elevation.of_frame(project.frame)
        draw_axes(sheet, place)
        entries = draw_supports(sheet, place, project)
        entries += draw_frame_members(sheet, place, project)
        entries += draw_ends(sheet, place, project)
        devices = _devices(project, place)
        drawn = devices.draw(sheet, tested=tested)
        left_out = draw_sections(sheet, project, place)
        left_out += devices.draw_sizes(sheet)
        entries += [*drawn, *_own_sections(project), *_materials(project)]
        entries += [*_rigid_floors(project), Entry("spans, heights and levels in m"), *unwritten(left_out)]
        sheet.legend(entries, WIDTH)

    return on_sheet(draw, heading)


def loads_figure(project: Project, heading: Sequence[str] = ()) -> Figure:
    """Draw the loads on members and nodes by load case, the masses of the nodes, and sums by floor.

    Args:
        heading: title and further lines above the drawing.
    """

    def draw(sheet: Sheet) -> None:
        place = Elevation.of_frame(project.frame)
        draw_axes(sheet, place, dimensions=False)
        draw_supports(sheet, place, project)
        draw_frame_members(sheet, place, project, faint=True)
        left_out = draw_loads(sheet, place, project)
        left_out += draw_masses(sheet, place, project)
        sheet.legend([*load_entries(project), *unwritten(left_out)], WIDTH)

    return on_sheet(draw, heading)


def dampers_figure(project: Project, heading: Sequence[str] = (), design: str = "") -> Figure:
    """Draw the dampers of a frame that is drawn elsewhere: their places, laws and sizes.

    Args:
        heading: lines above the drawing; (): none.
        design: of which no sizes are known; "": they are known.
    """

    def draw(sheet: Sheet) -> None:
        place = Elevation.of_frame(project.frame)
        draw_axes(sheet, place, dimensions=False)
        entries = draw_supports(sheet, place, project) if project.isolation is not None else []
        if project.isolation is None:
            draw_supports(sheet, place, project)
        draw_frame_members(sheet, place, project, faint=True)
        devices = _devices(project, place)
        drawn = devices.draw(sheet, design)
        left_out = devices.draw_sizes(sheet)
        sheet.legend([*entries, *drawn, *unwritten(left_out)], WIDTH)

    return on_sheet(draw, heading)


def _devices(project: Project, place: Elevation) -> DevicesOnSheet:
    return DevicesOnSheet(project, place, FrameElevation(project.frame).damper)


def _scales(project: Project) -> str:
    return "" if Elevation.of_frame(project.frame).true else " Widths and heights have different scales."


def _own_sections(project: Project) -> list[Entry]:
    used = dict.fromkeys(run.section for run in project.frame.members.values())
    beams = project.isolation.base.beams if project.isolation is not None else None
    used |= {beams.section: None} if beams is not None else {}
    return [Entry(section_words(name, project.sections[name])) for name in used if name in project.sections]


def _materials(project: Project) -> list[Entry]:
    entries = []
    for name, kinds in steels_of(member_steels(project.frame)).items():
        steel = project.materials[name]
        text = f"{name}: {steel.law.replace('_', '-')}, E = {short(steel.E / 1e9)} GPa"
        if not isinstance(steel, ElasticMaterial):
            text += f", f_y = {short(steel.fy / 1e6)} MPa, hardening {100.0 * steel.hardening:g} %"
        entries.append(Entry(f"{text}, {kinds}"))
    return entries


def _rigid_floors(project: Project) -> list[Entry]:
    floors = project.frame.diaphragm_floors
    if not floors:
        return [Entry("no floor is rigid in its plane")]
    every = len(floors) == project.frame.n_storeys
    which = "all floors are" if every else f"floors {str(project.frame.diaphragms).strip('[]')} are"
    return [Entry(f"{which} rigid in their plane")]
