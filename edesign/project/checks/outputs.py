"""Cross checks of outputs: every member, point and layer that is asked for exists in this frame."""

from __future__ import annotations

from edesign.project.actions.beam_loads import breaks_of_members, points_of_member
from edesign.project.analysis.outputs import FibreOutput, SectionOutput
from edesign.project.analysis_file import AnalysisFile
from edesign.project.checks.selections import Selections
from edesign.project.frame.members import BeamRun, BraceRun, ColumnRun
from edesign.project.frame.sections import ElasticSection, RectangleSection, is_hollow
from edesign.project.notation.selections import NumberSelection
from edesign.project.project import Project
from edesign.project.reading.problems import Keys, Problems, did_you_mean


def check_outputs(project: Project, problems: Problems) -> None:
    """Check the outputs of a project without schema problems.

    Args:
        project: the project, which has no schema problems.
    """
    outputs = project.outputs
    check_kept(project, problems)
    for i, section in enumerate(outputs.sections):
        _points(project, problems, ("outputs", "sections", i), section)
    for i, fibre in enumerate(outputs.fibres):
        keys: Keys = ("outputs", "fibres", i)
        if _points(project, problems, keys, fibre) and isinstance(fibre.layers, NumberSelection):
            last = _layers_at_most(project, project.frame.members[fibre.member])
            if last is not None:
                Selections(project.frame, problems).numbers((*keys, "layers"), fibre.layers, "layer", last)


def check_kept(project: AnalysisFile, problems: Problems) -> None:
    """Check the outputs of a plane frame or a building, but for sections and fibres.

    Args:
        project: the file, which has no schema problems.
    """
    outputs = project.outputs
    for i, kind in enumerate(outputs.histories):
        if kind in outputs.histories[:i]:
            problems.at_value(("outputs", "histories", i), f"`{kind}` comes twice [E-NAME-02]")
    for i, member in enumerate(outputs.members):
        keys: Keys = ("outputs", "members", i)
        if check_member(project, problems, keys, member) and member in outputs.members[:i]:
            problems.at_value(keys, f"`{member}` comes twice [E-NAME-02]")
    if outputs.archive is not None and not outputs.archive.endswith((".h5", ".hdf5", ".nc")):
        problems.at_value(("outputs", "archive"), f"`{outputs.archive}` needs the ending .h5, .hdf5 or .nc [E-FILE-08]")


def _layers_at_most(project: Project, run: ColumnRun | BeamRun | BraceRun) -> int | None:
    """Return the number of layers of fibres of an I section; None where the section does not determine it.

    It does with fillets and residual stresses, about a weak axis, and for stacks of rectangles and hollow sections.

    Args:
        project: the project, which has no schema problems.
        run: the run of members, with their section.
    """
    fibres = project.fibres
    weak = not isinstance(run, BraceRun) and run.axis == "weak"
    stack = isinstance(project.sections.get(run.section), RectangleSection)
    hollow = run.section not in project.sections and is_hollow(run.section)
    if fibres.fillets or fibres.residual_stress != "none" or weak or stack or hollow:
        return None
    return 2 * fibres.flange_thickness + fibres.web_height


def check_member(project: AnalysisFile, problems: Problems, keys: Keys, member: str) -> bool:
    """Check that a member exists, and return whether it does.

    Args:
        project: the file, which has no schema problems.
    """
    known = project.grid.members
    if member in known:
        return True
    hint = did_you_mean(member, known)
    message = f"there is no member `{member}` in this {project.structure}{hint} ({project.member_names}) [E-NAME-01]"
    problems.at_value(keys, message)
    return False


def _points(project: Project, problems: Problems, keys: Keys, asked: SectionOutput | FibreOutput) -> bool:
    """The member exists, has integration points, and has those that are asked for."""
    if not check_member(project, problems, (*keys, "member"), asked.member):
        return False
    run = project.frame.members[asked.member]
    if isinstance(run, BraceRun):
        message = f"`{asked.member}` is a brace; a brace has no section points, only an axial force [E-HIST-04]"
        problems.at_value((*keys, "member"), message)
        return False
    if isinstance(project.sections.get(run.section), ElasticSection):
        message = (
            f"`{asked.member}` has the elastic section `{run.section}`, which has no integration points [E-HIST-04]"
        )
        problems.at_value((*keys, "member"), message)
        return False
    breaks = breaks_of_members(project.frame, project.loads).get(asked.member, ())
    last = points_of_member(project.elements, breaks)
    return Selections(project.frame, problems).numbers((*keys, "points"), asked.points, "point", last)
