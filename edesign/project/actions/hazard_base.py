"""What the seismic action of every code has: levels, damping, and the files that it names."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import replace
from pathlib import Path
from typing import Annotated, Any

from pydantic import Field, PrivateAttr

from edesign.errors import InputError
from edesign.project.notation.quantities import TIME
from edesign.project.notation.units import PositiveRatio, parse_quantity, parse_ratio
from edesign.project.notation.written import NUMBER, Written, ratio, text
from edesign.project.reading.base import Model, refuse
from edesign.project.reading.problems import Keys

YEAR = 365.25 * 86400.0
"""The Julian year that units of the project file mean by `year`, s."""

LevelName = Annotated[str, Field(pattern=r"^[A-Za-z0-9][A-Za-z0-9_.+-]*$", max_length=64)]


def _probability(value: Any) -> float:
    return parse_ratio(value, 0.0, 1.0, low_allowed=False, high_allowed=False)


_RETURN_PERIOD = replace(TIME, name="number of years", example="475 years")


def _years(value: Any) -> float:
    seconds = parse_quantity(value, _RETURN_PERIOD, "positive")
    if seconds < YEAR * (1.0 - 1e-9):
        raise refuse(f"`{value}` is shorter than a year; it is written like `{_RETURN_PERIOD.example}` [E-VALUE-02]")
    return seconds


Probability = Annotated[float, Written(_probability, ratio(0.0, 1.0, low_allowed=False, high_allowed=False))]
"""Of exceedance, between 0 and 1."""
Years = Annotated[
    float,
    Written(
        _years, text("time of a year or more", rf"{NUMBER}\s*(?:years?|days?|weeks?|months?|h|min|s)", "475 years")
    ),
]
"""A time of a year or more, s."""


class Hazard(Model):
    """The seismic action by a code, and the levels that are looked at.

    Attributes:
        code: code of the action; `user` for spectra as tables.
        damping: damping of the elastic spectrum, ratio of critical.
        levels: hazard levels by name; what a level is depends on the code.
    """

    code: str
    damping: PositiveRatio = 0.05
    levels: Mapping[str, Any] = {}

    _folder: Path = PrivateAttr(default=Path())
    _contents: dict[Path, bytes] = PrivateAttr(default_factory=dict)

    @property
    def own_shapes(self) -> bool:
        """Whether each level has a spectrum of its own shape, so that no factor leads from one to another."""
        return False

    @property
    def q(self) -> float | None:
        """The behaviour factor of the design spectrum; None without one, or where the code has another notion."""
        return None

    def files(self) -> Iterator[tuple[Keys, str]]:
        """Yield key path below `hazard` and name of each file that the action needs."""
        return iter(())

    def lend(self, folder: Path, contents: dict[Path, bytes]) -> None:
        """Set the folder of the files that the action names, and the contents of those that were read.

        Args:
            folder: to which paths are relative.
            contents: by path; files that are read later are added to it.
        """
        self._folder, self._contents = folder, contents

    def content(self, file: str, read: Callable[[Path], bytes]) -> bytes:
        """Return the content of a file that the action names, as it was on its first reading.

        Raises:
            InputError: it cannot be read.
        """
        path = self._folder / file
        if path not in self._contents:
            self._contents[path] = read(path)
        return self._contents[path]

    def path_of(self, file: str) -> Path:
        """Return the path of a file that the action names."""
        return self._folder / file


def level_of(hazard: Hazard, level: str | None) -> str:
    """Return the level of an action whose levels have spectra of their own; None stands for the only one.

    Args:
        level: name of a level, or None.

    Raises:
        InputError: there are several.
    """
    if level is not None:
        return level
    if len(hazard.levels) == 1:
        return next(iter(hazard.levels))
    names = ", ".join(f"`{name}`" for name in hazard.levels)
    raise InputError(f"hazard.levels: each has a spectrum of its own; name one of {names} [E-HAZ-04]")
