"""Braces of a design that have sections: chosen for each storey by stiffness and force, or checked."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from edesign.archive.dataset import Group
from edesign.assess.devices import place_forces
from edesign.assess.sets import HistorySet
from edesign.codes.ec3.section import DENSITY
from edesign.codes.motion_sets import SetRules
from edesign.errors import InputError
from edesign.frame.bays import frame_sites
from edesign.frame.chosen_braces import Candidate, candidates, why_none
from edesign.frame.device_places import DamperSites, DevicePlace
from edesign.frame.sections.building_sections import BuildingSections
from edesign.project.analysis_file import AnalysisFile
from edesign.project.building.building import Building as BuildingFile
from edesign.project.dampers.dampers import BraceSection
from edesign.project.dampers.designs import DesignedBrace, HeldBrace
from edesign.project.project import Project
from edesign.space.nonlinear.bays import building_sites
from edesign.study.design.alike_braces import alike

Numbers = tuple[int, ...]
"""Of the section of each storey with dampers among those that it may have."""


@dataclass(frozen=True)
class BraceUse:
    """The braces of the storeys with dampers; of each storey those of the place that is used most, (s,) each.

    Attributes:
        section: names.
        length: of a brace between its nodes, m.
        slenderness: non-dimensional.
        force: N_Ed of a brace, N.
        resistance: N_b,Rd, N.
        mass: of all braces of the storey, kg.
        share: axial force of a brace over that of the dampers of its place.
    """

    section: tuple[str, ...]
    length: np.ndarray
    slenderness: np.ndarray
    force: np.ndarray
    resistance: np.ndarray
    mass: np.ndarray
    share: np.ndarray

    @property
    def use(self) -> np.ndarray:
        """N_Ed / N_b,Rd."""
        return self.force / self.resistance


def sites_of(project: AnalysisFile) -> DamperSites:
    """Return what dampers need of a plane frame or a building."""
    if isinstance(project, BuildingFile):
        return building_sites(project)
    assert isinstance(project, Project)
    return frame_sites(project)


class DesignBraces:
    """Sections of the braces of a design, one in each storey.

    Args:
        project: with the materials.
        brace: what the design asks for.
        places: of the dampers, (d,).
        place_storey: number of the storey of each place among those with dampers, (d,).
        cosine: of the slope of each damper, (d,).
        stiffness: least horizontal stiffness of the braces of each storey with dampers, (s,) N/m.
        storeys: their numbers in the frame, (s,).

    Raises:
        InputError: a section or family does not exist, or none may be used.
    """

    def __init__(
        self,
        project: AnalysisFile,
        brace: HeldBrace,
        places: tuple[DevicePlace, ...],
        place_storey: np.ndarray,
        cosine: np.ndarray,
        stiffness: np.ndarray,
        storeys: np.ndarray,
    ) -> None:
        self.brace, self._places, self._of = _named(project, brace), places, place_storey
        self._cosine, self._least, self._storeys = cosine, stiffness, storeys
        self._E = project.steels[brace.material].E
        sites, lists = sites_of(project), dict[tuple[float, int], tuple[Candidate, ...]]()
        for place, storey in zip(places, place_storey.tolist(), strict=True):
            key = (place.length, storey if isinstance(brace, BraceSection) else 0)
            if key not in lists:
                lists[key] = self._candidates(sites, place.length, storey)
        self._among = [
            lists[place.length, storey if isinstance(brace, BraceSection) else 0]
            for place, storey in zip(places, place_storey.tolist(), strict=True)
        ]

    def _candidates(self, sites: DamperSites, length: float, storey: int) -> tuple[Candidate, ...]:
        brace = self.brace
        if isinstance(brace, DesignedBrace):
            return candidates(sites, brace, length, (), "brace")
        one = brace.model_copy(update={"section": brace.of(storey)})
        try:
            axial, as_strut = sites.bar(one, length, ())
        except InputError as error:  # the brace stands in no file of a frame: the place is the design
            message = str(error).partition("brace.section: ")[2] or str(error)
            raise InputError(f"brace.section: {message}") from error
        if as_strut is None:
            raise InputError(f"brace.section: {one.of(0)} has no `inertia`, and cannot be checked [E-DAMPER-06]")
        return (Candidate(one.of(0), axial, as_strut, DENSITY * axial * length / self._E),)

    @property
    def chosen(self) -> bool:
        """Whether the program chooses the sections."""
        return isinstance(self.brace, DesignedBrace)

    def first(self) -> Numbers:
        """Return the lightest sections that are as stiff as asked for.

        Raises:
            InputError: there are none in a storey.
        """
        nothing = np.zeros(len(self._places))
        return self.following((0,) * self._storeys.size, nothing)

    def following(self, numbers: Numbers, force: np.ndarray, strongest: bool = False) -> Numbers:
        """Return the lightest sections that hold forces, none lighter than those of `numbers`.

        Args:
            force: of the dampers of each place along them, with all factors, (d,) N.
            strongest: whether the strongest that are stiff enough are taken where none holds an estimate.

        Raises:
            InputError: there are none in a storey.
        """
        brace = self.brace
        if not isinstance(brace, DesignedBrace):
            return numbers
        holds = [self._holding(i, begin, force, strongest) for i, begin in enumerate(numbers)]
        if not (brace.same_depth or brace.most_sections):
            return tuple(int(np.argmax(of)) for of in holds)
        own = [np.flatnonzero(self._of == i) for i in range(self._storeys.size)]
        lists = [self._among[of[0]] for of in own]
        names = list(dict.fromkeys(one.section for among in lists for one in among))
        mass = np.full((len(own), len(names)), np.inf)
        for i, among in enumerate(lists):
            lengths = sum(self._places[d].braces * self._places[d].length for d in own[i])
            for number in np.flatnonzero(holds[i]):
                mass[i, names.index(among[number].section)] = among[number].line * lengths
        chosen = alike(names, mass, brace.same_depth, brace.most_sections)
        if chosen is None:
            asked = "one nominal depth" if brace.same_depth else f"{brace.most_sections} sections"
            raise InputError(f"brace.choose: no choice of {asked} holds the dampers of all storeys [E-DAMPER-06]")
        found = [[one.section for one in among].index(name) for among, name in zip(lists, chosen, strict=True)]
        return tuple(found)

    def _holding(self, i: int, begin: int, force: np.ndarray, strongest: bool) -> np.ndarray:
        """Which sections of a storey hold forces of the places (d,) and are stiff enough, from a number on, (n,)."""
        own = np.flatnonzero(self._of == i)
        along = self._cosine[own] * np.array([self._places[d].cosine for d in own])  # of the braces to the drift
        of_storey = float(sum(along**2 * [self._places[d].braces / self._places[d].length for d in own]))
        found = np.ones(min(len(self._among[d]) for d in own), dtype=bool)
        found[:begin] = False
        for d in own:
            place, among = self._places[d], self._among[d][: found.size]
            axial = self._least[i] / (of_storey * place.length)  # equal areas in the storey
            stiff = found & np.array([one.axial >= axial * (1.0 - 1e-12) for one in among])
            resistance = np.array([one.strut.resistance for one in among])
            least = force[d] * place.share
            found = stiff & (resistance >= least)
            if not found.any() and strongest and stiff.any():
                found = stiff & (resistance >= resistance[stiff].max())
            if not found.any():
                why = why_none(among, least, axial)
                raise InputError(f"brace.choose: storey {self._storeys[i]}: {why} [E-DAMPER-06]")
        return found

    def stiffness(self, numbers: Numbers) -> np.ndarray:
        """Return the stiffness of the braces of each place along the damper, (d,) N/m."""
        found = []
        for d, place in enumerate(self._places):
            found.append(place.braces * self._one(d, numbers).axial * place.cosine**2)
        return np.array(found)

    def horizontal(self, numbers: Numbers) -> np.ndarray:
        """Return the stiffness of the braces of each storey along its drift, (s,) N/m."""
        return np.bincount(self._of, self.stiffness(numbers) * self._cosine**2)

    def sections(self, numbers: Numbers) -> BraceSection:
        """Return the braces as a device of a project file has them."""
        if isinstance(self.brace, BraceSection):
            return self.brace
        names = tuple(self._one(int(np.argmax(self._of == i)), numbers).section for i in range(self._storeys.size))
        brace = self.brace
        return BraceSection(section=names, material=brace.material, buckling_length_factor=brace.buckling_length_factor)

    def use(self, numbers: Numbers, force: np.ndarray) -> BraceUse:
        """Return the check of the braces under forces.

        Args:
            force: of the dampers of each place along them, with all factors, (d,) N.

        Source: EN 1993-1-1:2005, 6.3.1.
        """
        share = np.array([place.share for place in self._places])
        at = [self._one(d, numbers) for d in range(len(self._places))]
        N_Ed, resistance = share * force, np.array([one.strut.resistance for one in at])
        use = N_Ed / resistance
        storeys = range(self._storeys.size)
        most = [max(np.flatnonzero(self._of == i), key=lambda d: use[d]) for i in storeys]
        mass = np.array([p.braces * p.length * one.line for p, one in zip(self._places, at, strict=True)])
        return BraceUse(
            tuple(at[d].section for d in most),
            np.array([self._places[d].length for d in most]),
            np.array([at[d].strut.slenderness for d in most]),
            N_Ed[most],
            resistance[most],
            np.bincount(self._of, mass),
            share[most],
        )

    def _one(self, d: int, numbers: Numbers) -> Candidate:
        return self._among[d][numbers[self._of[d]]]


def _named(project: AnalysisFile, brace: HeldBrace) -> HeldBrace:
    """The braces with the catalogue's own names of their sections; own sections go before."""
    if not isinstance(brace, BraceSection):
        return brace
    own = project.sections if isinstance(project, Project | BuildingFile) else {}
    known = BuildingSections()
    names = tuple(name if name in own else known.canonical(name) or name for name in brace.sections)
    return brace.model_copy(update={"section": names if isinstance(brace.section, tuple) else names[0]})


def history_forces(
    histories: Mapping[str, Group], level: str, storeys: np.ndarray, own: tuple[str, ...], rules: SetRules
) -> tuple[float, ...]:
    """Return the force of all dampers of a place that histories give in each storey, (s,) N; () without any.

    Of the motions the mean counts where there are enough of them, else the largest.

    Args:
        histories: results of the histories of a round, by name.
        level: hazard level that counts.
        storeys: with dampers, from 1.
        rules: of the code in force, from how many motions on the mean counts.
    """
    at = {name: group for name, group in histories.items() if str(group.attributes.get("level") or "") == level}
    found = place_forces(HistorySet("", level, at), storeys, own, rules)
    return () if found is None else tuple(found.tolist())
