"""The catalogue of rolled I sections (data/profiles.csv, which data/generate_profiles.py writes)."""

from __future__ import annotations

import csv
from dataclasses import dataclass
from functools import cache
from importlib import resources

from edesign.errors import InputError
from edesign.frame.sections.section_names import SectionNames

_MM = 1e-3


@dataclass(frozen=True)
class Profile:
    """A rolled I section with parallel flanges, in SI.

    Attributes:
        h, b: height and width, m.
        tw, tf: thickness of web and flanges, m.
        r: radius of the fillets between them, m.
        area: m2, fillets included.
        inertia: second moment of area about the strong axis, m4, fillets included.
    """

    name: str
    h: float
    b: float
    tw: float
    tf: float
    r: float
    area: float
    inertia: float


@cache
def profile_names() -> SectionNames:
    """Return the names of all catalogue sections."""
    return SectionNames(tuple(_catalogue()))


def profile(name: str) -> Profile:
    """Return a section of the catalogue.

    Args:
        name: such as "IPE450" or "HEB300", or as it is usually written (`SectionNames.canonical`).

    Raises:
        InputError: there is no such section; the message says what there is near it.
    """
    known = profile_names().canonical(name)
    if known is None:
        raise InputError(f"there is no section `{name}`; {profile_names().near(name)} [E-NAME-01]")
    return _catalogue()[known]


@cache
def _catalogue() -> dict[str, Profile]:
    text = resources.files("edesign.frame.sections").joinpath("data/profiles.csv").read_text(encoding="utf-8")
    rows = csv.reader(line for line in text.splitlines() if not line.startswith("#"))
    next(rows)  # the header names the units: mm, mm2, mm4
    found = {}
    for name, *cells in rows:
        h, b, tw, tf, r, area, inertia = map(float, cells)
        found[name] = Profile(
            name, h * _MM, b * _MM, tw * _MM, tf * _MM, r * _MM, area=area * _MM**2, inertia=inertia * _MM**4
        )
    return found
