"""Cross checks of where in a building a criterion looks: directions, column lines, frames, axes of bending."""

from __future__ import annotations

from edesign.project.analysis_file import AnalysisFile
from edesign.project.checks.names import check_names
from edesign.project.criteria.criteria import LimitCriterion, MeasureCriterion
from edesign.project.criteria.criterion_quantities import QUANTITIES
from edesign.project.criteria.measures import CENTRE, ELSEWHERE, MEASURES, ON_LINES, RESULTANTS, SPACE_KEYS
from edesign.project.notation.frames import frames_of_line
from edesign.project.reading.problems import Keys, Problems, listed


def check_in_space(keys: Keys, criterion: LimitCriterion, project: AnalysisFile, problems: Problems) -> None:
    """Check that what is limited has the directions, lines, frames and axes that are asked for, and so the building.

    Args:
        keys: of the criterion.
        criterion: as read; it has no schema problems.
    """
    subject, place = criterion.subject, criterion.in_space
    given = [key for key in SPACE_KEYS if key in criterion.model_fields_set]
    if project.structure == "frame":
        for key in given:
            message = f"`{key}` says where in a building; leave it out for a plane frame [E-CRIT-04]"
            problems.at_key((*keys, key), message)
        return
    measured = isinstance(criterion, MeasureCriterion)
    own = MEASURES[subject].in_space if measured else QUANTITIES[subject].in_space
    for key in given:
        if key not in own:
            allowed = f"of a building it has {listed(own)}" if own else "it is alike in all directions"
            problems.at_key((*keys, key), f"`{subject}` has no `{key}`; {allowed} [E-CRIT-04]")
    if place.direction == "resultant" and criterion.resultant is None:
        have = [name for name, of in MEASURES.items() if of.resultant] if measured else list(RESULTANTS)
        message = f"`{subject}` has no resultant, {listed(have)} have one; write `x` or `y` [E-CRIT-04]"
        problems.at_value((*keys, "direction"), message)
    lines = project.grid.lines
    floors = subject in ELSEWHERE and QUANTITIES[subject].place == "floor"
    check_names(problems, (*keys, "at"), "column line", place.at, (CENTRE, *lines) if floors else lines)
    if floors and CENTRE in place.at and place.lines:
        message = f"`{CENTRE}` stands alone; for column lines too write a second criterion [E-KEY-03]"
        problems.at_value((*keys, "at"), message)
    frames = dict.fromkeys(frame for line in lines for frame in frames_of_line(line))
    check_names(problems, (*keys, "frames"), "frame", place.frames, frames)
    if own == ON_LINES and place.direction is not None:
        across = [frame for frame in place.frames if frame in frames and frame[0].lower() != place.direction]
        if across:
            message = f"{listed(across)} is across {place.direction}, and the drift of a frame is along it [E-VALUE-04]"
            problems.at_value((*keys, "frames"), message)
