"""Cross checks of an isolated base: lines and laws that exist, columns on isolators or free to slide, its mass."""

from __future__ import annotations

from edesign.project.analysis.analyses import HistoryAnalysis, PushoverAnalysis
from edesign.project.analysis_file import AnalysisFile
from edesign.project.checks.selections import Selections
from edesign.project.dampers.dampers import PROTOTYPE_SCALE
from edesign.project.dampers.isolation import (
    CIRCULAR,
    NEEDS_STIFFNESS,
    UNCOUPLED,
    WEIGHED,
    AnyBaseDevice,
    AnyIsolator,
    Isolation,
    not_in_all_directions,
)
from edesign.project.frame.foundations import FootingSupport
from edesign.project.frame.supports import SupportKind, SupportSprings, springs_of, support_name
from edesign.project.notation import names
from edesign.project.project import Project
from edesign.project.reading.problems import Keys, Problems, listed, unknown_name

_AT: Keys = ("dampers", "isolation")


def check_isolation(project: Project, problems: Problems) -> None:
    """Check the isolated base of a project; `project` has no schema problems, and may have no isolation.

    Args:
        project: the project, which has no schema problems.
    """
    isolation = project.isolation
    if isolation is None:
        return
    taken: dict[str, int] = {}
    inside = True
    for i, isolator in enumerate(isolation.isolators):
        keys: Keys = (*_AT, "isolators", i)
        inside &= Selections(project.frame, problems).lines((*keys, "lines"), isolator.lines)
        check_isolator(project, problems, i, isolator, taken, "lines")
    for i, item in enumerate(isolation.beside):
        inside &= Selections(project.frame, problems).lines((*_AT, "beside", i, "lines"), item.lines)
        check_law(project, problems, (*_AT, "beside", i), item)
    if inside:
        _other_bases(project, problems, isolation, taken)
    _base(project, problems, isolation)
    if project.frame.leaning_column is not None:
        message = (
            "a leaning column stands on the ground; with an isolated base give its loads at nodes of the frame"
            " [E-FRAME-04]"
        )
        problems.at_key(("frame", "leaning_column"), message)
    check_isolated_analyses(project, problems)


NO_WAVE_PASSAGE = "the ground under isolators moves as one; wave passage needs fixed supports [E-ISOL-03]"
NO_PUSHOVER = (
    "a pushover of an isolated building is not offered: its roof moves with its base, which the targets do not know; "
    "with `dampers: false` it is pushed on the supports that it has without isolators [E-ISOL-03]"
)


def check_isolated_analyses(project: AnalysisFile, problems: Problems) -> None:
    """Check that nothing is asked of a file with an isolated base that is not offered for one."""
    for i, analysis in enumerate(project.analyses):
        if isinstance(analysis, PushoverAnalysis) and analysis.dampers:
            problems.at_key(("analyses", i, "kind"), NO_PUSHOVER)
        if isinstance(analysis, HistoryAnalysis) and analysis.dampers and analysis.wave_passage is not None:
            problems.at_key(("analyses", i, "wave_passage"), NO_WAVE_PASSAGE)


def check_isolator(
    project: AnalysisFile, problems: Problems, i: int, isolator: AnyIsolator, taken: dict[str, int], lines: str
) -> None:
    """Check law, weight and vertical direction of an isolator, and that its lines have no other one.

    Args:
        isolator: of a plane frame or a building.
        taken: numbers of isolators by column line, to which those of its lines are added.
        lines: key of its column lines.
    """
    keys: Keys = (*_AT, "isolators", i)
    check_law(project, problems, keys, isolator)
    _weight(project, problems, keys, isolator)
    if isolator.vertical == "free":
        problems.at_value(
            (*keys, "vertical"), "an isolator carries the column; it is `fixed` or has a stiffness [E-KEY-03]"
        )
    for line in isolator.under(project.grid.lines, project.grid):
        if line in taken:
            message = f"line {line} has an isolator already, isolators[{taken[line]}]; one carries the column"
            problems.at_value((*keys, lines), f"{message} (give what acts beside it under `beside`) [E-ISOL-04]")
            break
        taken[line] = i


def check_law(project: AnalysisFile, problems: Problems, keys: Keys, item: AnyBaseDevice) -> None:
    """Check that a law exists, with a size that it knows, and acts in the directions of what has it.

    Args:
        keys: place of what has it.
        item: an isolator, or what acts beside isolators.
    """
    assert project.dampers is not None
    laws = project.dampers.laws
    if item.law not in laws:
        problems.at_value((*keys, "law"), unknown_name("damper law", item.law, laws))
        return
    law = laws[item.law]
    if law.type == "buckling_restrained":
        message = f"the law `{item.law}` is of a buckling-restrained brace, which acts along its own length [E-ISOL-03]"
        problems.at_value((*keys, "law"), message)
    elif len(item.axes) == 2 and law.type is not None and (law.effects or law.type not in CIRCULAR + UNCOUPLED):
        message = not_in_all_directions(item.law, law.type, bool(law.effects))
        problems.at_value((*keys, "law"), message)
    if law.prototype is None and law.file is None:
        for key in ("layers", "layer_area", "layer_thickness"):
            if getattr(item, key) is not None:
                problems.at_key(
                    (*keys, key), f"the law `{item.law}` has no `prototype` whose size could be changed [E-DAMPER-03]"
                )
    elif law.prototype is not None and item.scale is not None:
        problems.at_key((*keys, "scale"), PROTOTYPE_SCALE.format(item.law))


def _weight(project: AnalysisFile, problems: Problems, keys: Keys, isolator: AnyIsolator) -> None:
    """A weight belongs to friction pendulums, whose forces follow from it or from a scale."""
    assert project.dampers is not None
    law = project.dampers.laws.get(isolator.law)
    if law is None or law.type is None:
        return
    if law.type != WEIGHED:
        if isolator.weight is not None:
            message = f"the forces of the law `{isolator.law}` ({law.type}) need no weight; leave it out [E-KEY-03]"
            problems.at_key((*keys, "weight"), message)
    elif isolator.weight == "varying" and isolator.vertical == "fixed":
        problems.at_value((*keys, "weight"), NEEDS_STIFFNESS)
    if law.type == WEIGHED and isolator.weight != "law" and isolator.scale is not None:
        message = (
            "the forces of this isolator follow from the weight on it; leave `scale` out, or say `weight: law`"
            " [E-KEY-03]"
        )
        problems.at_key((*keys, "scale"), message)


def _other_bases(project: Project, problems: Problems, isolation: Isolation, taken: dict[str, int]) -> None:
    """Column bases without an isolator do not restrain the base; isolators stand under column bases that exist."""
    frame = project.frame
    column_bases = [line for line in frame.lines if names.node_name(line, 0) in frame.nodes]
    restrained = [line for line in column_bases if line not in taken and _restrains(frame.support(line))]
    if restrained:
        one = len(restrained) == 1
        kinds = ", ".join(f"{line} {support_name(frame.support(line))}" for line in restrained)
        lines = f"line{'s' * (not one)} {listed(restrained)} {'has' if one else 'have'} no isolator"
        message = f"{lines} and would restrain the base"
        problems.at_key(
            (*_AT, "isolators"), f"{message} ({kinds}); isolate them, or let them slide: `roller` [E-ISOL-01]"
        )
    for i, isolator in enumerate(isolation.isolators):
        bare = [line for line in isolator.under(frame.lines, frame) if line not in column_bases]
        if bare and not isolator.lines.is_all:
            message = f"no column stands on line {listed(bare)}; `all` takes the lines that have one [E-NAME-01]"
            problems.at_value((*_AT, "isolators", i, "lines"), message)


def _restrains(support: SupportKind | SupportSprings | FootingSupport) -> bool:
    """Whether a support restrains its column base horizontally."""
    return isinstance(support, FootingSupport) or springs_of(support).horizontal != "free"


def _base(project: Project, problems: Problems, isolation: Isolation) -> None:
    """The base has a mass in analyses with masses, and beams between column bases, which nothing else restrains."""
    base, masses = isolation.base, project.masses
    column_bases = [line for line in project.frame.lines if names.node_name(line, 0) in project.frame.nodes]
    if base.beams is not None and base.rotation is not None:
        message = "the column bases turn with the `beams` of the base; leave `rotation` out, or the beams [E-KEY-03]"
        problems.at_key((*_AT, "base", "rotation"), message)
    if base.beams is None and base.rotation is None:
        message = "how do the column bases turn? with `beams`, which bring their moments to the isolators"
        problems.at_key(
            (*_AT, "base"), f"{message}, or restrained by `rotation`, which lets these into the ground [E-ISOL-02]"
        )
    if base.beams is not None and len(column_bases) == 1:
        problems.at_key(
            (*_AT, "base", "beams"), "the frame has one column base, which no beam of the base leads from [E-ISOL-02]"
        )
    if base.mass is not None and masses is None:
        message = "the frame itself has no `masses`, which analyses with masses need [E-MODAL-02]"
        problems.at_key((*_AT, "base", "mass"), message)
    if base.mass is None and masses is not None:
        factors = masses.from_loads
        if factors is None or not factors.G * base.G + factors.Q * base.Q > 0.0:
            message = "the base has no mass; give `mass`, or loads `G` and `Q` with `masses.from_loads` [E-MODAL-02]"
            problems.at_key((*_AT, "base"), message)
