"""Checks of the names of grid lines, of a frame or a building."""

from __future__ import annotations

from collections.abc import Sequence

from edesign.project.reading.problems import Keys, Problems
from edesign.project.reading.words import counted


def check_axes(keys: Keys, names: Sequence[str], n_lines: int, problems: Problems) -> None:
    """Check that each line has one name, and no two the same.

    Args:
        names: of the lines in their order.
    """
    if len(names) != n_lines:
        message = f"{counted(len(names), 'name')} for {counted(n_lines, 'line')}; one for each is needed"
        problems.at_value(keys, f"{message} [E-VALUE-04]")
    for i, name in enumerate(names):
        if name in names[:i]:
            problems.at_item(keys, i, f"`{name}` comes twice [E-NAME-02]")
