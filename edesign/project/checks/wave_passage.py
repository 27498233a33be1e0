"""Cross checks of wave passage: lines that exist, of which some are reached later than others."""

from __future__ import annotations

from edesign.project.analysis.wave_passage import WavePassage
from edesign.project.analysis_file import AnalysisFile
from edesign.project.project import Project
from edesign.project.reading.problems import Keys, Problems, unknown_name


def check_wave_passage(base: AnalysisFile, problems: Problems, keys: Keys, passage: WavePassage | None) -> None:
    """Check the wave passage of an analysis.

    Args:
        base: the frame or building, read without schema problems.
        keys: where the wave is described.
        passage: the wave; None: there is none.
    """
    if passage is None:
        return
    if (passage.velocity is None) == (passage.delays is None):
        problems.at_key(keys, "give either `velocity` or `delays`, one of them [E-KEY-03]")
        return
    if passage.delays is not None and passage.direction is not None:
        problems.at_key(
            (*keys, "direction"), "the `delays` say which way the wave propagates; leave this key out [E-KEY-03]"
        )
    if passage.direction is not None and isinstance(passage.direction, str) != isinstance(base, Project):
        message = (
            "the direction of a wave along a frame is `right` or `left` [E-VALUE-03]"
            if isinstance(base, Project)
            else "the direction of a wave below a building is an angle from x towards y, such as `90 deg` [E-VALUE-03]"
        )
        problems.at_value((*keys, "direction"), message)
        return
    unknown = [line for line in passage.delays or {} if not base.grid.lines_in(line)]
    for line in unknown:
        problems.at_key((*keys, "delays", line), unknown_name("line", line, base.grid.lines))
    if not unknown and not any(passage.delays_of(base.grid).values()):
        problems.at_key(keys, "no line is reached later than another; leave `wave_passage` out [E-KEY-03]")
    if isinstance(base, Project) and base.frame.leaning_column is not None:
        message = "where the leaning column stands is not known, so neither is when the wave reaches it [E-FRAME-04]"
        problems.at_key(keys, message)
