"""Where dampers stand: what their deformation is the sum of, and how long and how steep their braces are."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass

from edesign.errors import InputError
from edesign.frame.struts import Strut
from edesign.project.analysis_file import AnalysisFile
from edesign.project.dampers.dampers import BraceSection, DamperBetween, DamperRun
from edesign.project.notation import names
from edesign.project.notation.grid import BayPlace
from edesign.project.reading.problems import Keys, did_you_mean

Term = tuple[float, int, int]
"""Coefficient, node and degree of the core."""


@dataclass(frozen=True)
class Bay:
    """A bay of a plane frame in a storey.

    Attributes:
        lower, upper: names of the nodes at its left and right, below and above.
        middle: name of the node in the middle of the beam above, which only halved beams have.
        width, height: m.
        across: degree of the core along the frame, to the right.
    """

    lower: tuple[str, str]
    upper: tuple[str, str]
    middle: str
    width: float
    height: float
    across: int


@dataclass(frozen=True)
class DamperSites:
    """What dampers need of the frame or building that they stand in.

    Attributes:
        up: degree of the core along the vertical; those along other coordinates come before it.
        bay: gives a bay.
        bar: gives the axial stiffness of a brace, N/m, and the brace as a strut, by its section and material, its
            length, m, and the keys of the damper.
    """

    up: int
    bay: Callable[[BayPlace], Bay]
    bar: Callable[[BraceSection, float, Keys], tuple[float, Strut | None]]


@dataclass(frozen=True)
class DevicePlace:
    """The place of a damper.

    Attributes:
        storey: whose drift works it, from 1; 0: none.
        index: of its storey among those of the run.
        terms: that its deformation is the sum of.
        length: of its brace, m.
        cosine: of the brace to the deformation.
        braces: that share its force.
        frame: name of the plane frame of a building; "" of other dampers.
        direction: index of the horizontal direction that it acts in; None: both, or none.
    """

    name: str
    storey: int
    index: int
    terms: tuple[Term, ...]
    length: float
    cosine: float = 1.0
    braces: int = 1
    frame: str = ""
    direction: int | None = None

    @property
    def share(self) -> float:
        """The axial force of a brace over the force of the dampers."""
        return 1.0 / (self.braces * self.cosine)


def device_places(
    project: AnalysisFile, run: DamperRun | DamperBetween, sites: DamperSites, nodes: Mapping[str, int], where: str
) -> Iterator[DevicePlace]:
    """Yield the places of the dampers of a run, storey by storey.

    Args:
        nodes: ids by name.
        where: of the run, for messages.

    Raises:
        InputError: a place has no node because all that would end there is missing.

    Source: thesis Eq. 5.10 (chevron).
    """

    def node(name: str) -> int:
        if name not in nodes:
            hint = did_you_mean(name, nodes)
            raise InputError(f"{where}: there is no node `{name}` in this {project.structure}{hint} [E-NAME-01]")
        return nodes[name]

    if isinstance(run, DamperBetween):
        yield _between(project, run, sites, (node(run.nodes[0]), node(run.nodes[1])))
        return
    storeys = run.storeys.numbers(1, project.grid.n_storeys)
    for at in project.grid.bay_places(run):
        bay = sites.bay(at)
        of_names = project.grid.damper_names(run.kind, at)
        found = _in_bay(run.kind, bay, sites.up, node)
        for name, (terms, length, cosine, braces) in zip(of_names, found, strict=True):
            index = storeys.index(at.storey)
            yield DevicePlace(name, at.storey, index, terms, length, cosine, braces, at.frame, bay.across)


def _in_bay(
    kind: str, bay: Bay, up: int, node: Callable[[str], int]
) -> Iterator[tuple[tuple[Term, ...], float, float, int]]:
    """Yield terms, length of a brace, its cosine and the number of braces of the dampers of a kind in a bay."""
    width, height, across = bay.width, bay.height, bay.across
    low_left, low_right = (node(name) for name in bay.lower)
    top_left, top_right = (node(name) for name in bay.upper)
    top: tuple[Term, ...] = ((0.5, top_left, across), (0.5, top_right, across))
    if kind == "storey":
        yield (*top, (-0.5, low_left, across), (-0.5, low_right, across)), height, 1.0, 1
    elif kind == "chevron":
        # the apex moves with the mean of the lower ends and tilts with their difference
        tilt = 0.5 * height / (0.5 * width)
        sway: tuple[Term, ...] = ((-0.5, low_left, across), (-0.5, low_right, across))
        tilting: tuple[Term, ...] = ((-tilt, low_left, up), (tilt, low_right, up))
        length = math.hypot(0.5 * width, height)
        yield (*top, *sway, *tilting), length, 0.5 * width / length, 2
    elif kind == "chevron_braces":
        length = math.hypot(0.5 * width, height)
        apex = node(bay.middle)
        for lower_end, way in ((low_left, 1.0), (low_right, -1.0)):
            c, s = way * 0.5 * width / length, height / length
            yield ((c, apex, across), (s, apex, up), (-c, lower_end, across), (-s, lower_end, up)), length, 1.0, 1
    else:
        length = math.hypot(width, height)
        low, high = (low_left, top_right) if kind == "rising" else (low_right, top_left)
        c = width / length * (1.0 if kind == "rising" else -1.0)
        s = height / length
        yield ((c, high, across), (s, high, up), (-c, low, across), (-s, low, up)), length, 1.0, 1


def _between(project: AnalysisFile, run: DamperBetween, sites: DamperSites, ends: tuple[int, int]) -> DevicePlace:
    start, end = (project.grid.nodes[name] for name in run.nodes)
    apart = [b - a for a, b in zip(start, end, strict=True)]
    length = math.hypot(*apart)
    cosines = [one / length for one in apart]
    first, second = ends
    terms = tuple((way * c, node, d) for node, way in ((second, 1.0), (first, -1.0)) for d, c in enumerate(cosines))
    levels, own = project.grid.levels, sorted((start[-1], end[-1]))
    storey = next((i for i in range(1, len(levels)) if own == [levels[i - 1], levels[i]]), 0)
    horizontal = [d for d in range(sites.up) if cosines[d] != 0.0]
    direction = horizontal[0] if len(horizontal) == 1 else None
    return DevicePlace(names.damper_between_name(*run.nodes), storey, 0, terms, length, direction=direction)
