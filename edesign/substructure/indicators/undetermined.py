"""An indicator that the channels of a test do not determine."""

from __future__ import annotations

from edesign.errors import EdesignError


class Undetermined(EdesignError):
    """Error: an indicator has no number; the message says why, for people.

    `tracking` turns the indicator into NaN with this reason.
    """


LEAST_EXPLAINED = 0.5
"""Least share of the measured variance that the target explains, for a delay or an amplitude to mean anything.

Below it more than half of what was measured is something else: another channel, another clock or noise.
"""


def moving(name: str, channel_range: float) -> None:
    """Make sure that a channel moves.

    Args:
        name: of the channel, for people.
        channel_range: its largest less its smallest value.

    Raises:
        Undetermined: the channel is constant.
    """
    if channel_range == 0.0:
        raise Undetermined(f"the {name} channel is constant")
