"""Cross checks of wave passage: lines that exist, of which some are reached later than others."""

from __future__ import annotations

from edesign.project.analysis.wave_passage import WavePassage
from edesign.project.frame.frame import Frame
from edesign.project.reading.problems import Keys, Problems, unknown_name

NO_WAVES = "waves that reach one support after the other are of plane frames alone; leave out this key [E-BLDG-04]"
"""Of a building in a study."""


def check_wave_passage(frame: Frame, problems: Problems, keys: Keys, passage: WavePassage | None) -> None:
    """Check the wave passage of an analysis.

    Args:
        frame: read without schema problems.
        problems: collects what is wrong.
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
    unknown = [line for line in passage.delays or {} if line not in frame.lines]
    for line in unknown:
        problems.at_key((*keys, "delays", line), unknown_name("line", line, frame.lines))
    places = dict(zip(frame.lines, frame.x, strict=True))
    if not unknown and not any(passage.delays_of(places).values()):
        problems.at_key(keys, "no line is reached later than another; leave `wave_passage` out [E-KEY-03]")
    if frame.leaning_column is not None:
        message = "where the leaning column stands is not known, so neither is when the wave reaches it [E-FRAME-04]"
        problems.at_key(keys, message)
