"""Braces of the items of a placement that have sections: chosen by histories, one for each item, or checked."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from edesign.archive.dataset import Group
from edesign.assess.devices import force_of_each, names_of_history
from edesign.assess.envelopes import peak
from edesign.assess.sets import HistorySet
from edesign.codes.device_factors import DeviceFactors
from edesign.codes.motion_sets import SetRules
from edesign.damper.factored import force_ratio
from edesign.errors import InputError
from edesign.frame.chosen_braces import Candidate, candidates, why_none
from edesign.frame.devices import Device
from edesign.project.analysis_file import AnalysisFile
from edesign.project.dampers.dampers import AnyChosenBrace, BraceSection, ChosenBrace
from edesign.project.dampers.placement import PlacementDesign
from edesign.study.design.braces import sites_of
from edesign.study.placement.candidates import Candidates
from edesign.study.placement.space import Layout
from edesign.study.results.recording import coordinate


@dataclass(frozen=True)
class BraceAt:
    """The braces of a damper of a layout that have a section.

    Attributes:
        name: of the damper in the layout.
        option: number of the item.
        device: as a candidate.
        factor: on the force of the damper, by stroke, velocity and overstrength.
        force: N_Ed of one brace, N.
    """

    name: str
    option: int
    device: Device
    factor: float
    force: float


class ItemBraces:
    """Sections of the braces of the items of a catalogue; those that are chosen become heavier as histories ask.

    Args:
        factors: of the code, on dampers and on what holds them.
    """

    def __init__(self, project: AnalysisFile, name: str, spec: PlacementDesign, factors: DeviceFactors) -> None:
        self._written, self._factors, self._sites = spec, factors, sites_of(project)
        self._where = {
            option: f"designs.{name}.catalogue.{item}.brace" for option, item in enumerate(spec.catalogue, 1)
        }
        items = enumerate(spec.catalogue.values(), 1)
        self._asked = {option: item.brace for option, item in items if searched(item.brace)}
        self._lists: dict[tuple[int, float], tuple[Candidate, ...]] = {}
        self.sections: dict[int, str] = {}

    def spec(self) -> PlacementDesign:
        """Return the design with the present sections, at first any of the lists, whose places tell the lengths."""
        items = dict(self._written.catalogue)
        for option, name in enumerate(self._written.catalogue, 1):
            brace = self._asked.get(option)
            if isinstance(brace, AnyChosenBrace):
                section = self.sections.get(option) or self._any(option, brace)
                of = BraceSection(
                    section=section, material=brace.material, buckling_length_factor=brace.buckling_length_factor
                )
                items[name] = items[name].model_copy(update={"brace": of})
        return self._written.model_copy(update={"catalogue": items})

    def _any(self, option: int, brace: AnyChosenBrace) -> str:
        return candidates(self._sites, brace, 1.0, (), self._where[option])[0].section

    def begin(self, frame: Candidates) -> bool:
        """Take the lightest sections that may stand in all places of their item; return whether any are chosen.

        Raises:
            InputError: all sections of an item are too slender for a place.
        """
        for option in self._asked:
            lists = [self._list(option, device) for (of, _), device in frame.devices.items() if of == option]
            common = [one.section for one in lists[0] if all(any(c.section == one.section for c in of) for of in lists)]
            if not common:
                message = f"{self._where[option]}.choose: no section of the lists may stand in all places [E-DAMPER-06]"
                raise InputError(message)
            self.sections[option] = common[0]
        return bool(self._asked)

    def _list(self, option: int, device: Device) -> tuple[Candidate, ...]:
        brace, bar = self._asked[option], device.brace_bar
        assert isinstance(brace, AnyChosenBrace) and bar is not None and bar.strut is not None
        length = bar.strut.length / brace.buckling_length_factor
        if (option, length) not in self._lists:
            self._lists[option, length] = candidates(self._sites, brace, length, (), self._where[option])
        return self._lists[option, length]

    def uses(
        self, frame: Candidates, layout: Layout, found: HistorySet, rules: SetRules, frequency: float
    ) -> list[BraceAt]:
        """Return the braces of a layout that have sections, under the forces of histories; none without any.

        Args:
            found: the histories that count.
            rules: of the code in force, from how many motions on the mean counts.
            frequency: of the first mode, with which a stroke has its velocity, Hz.
        """
        completed = list(found.completed.values())
        if not completed:
            return []
        names, forces = names_of_history(completed[0]), force_of_each(found, rules)
        strokes = np.max([of for group in completed if (of := peak(group, "damper_deformation")) is not None], axis=0)
        uses = []
        for place, option in frame.equipped(layout).items():
            device = frame.devices[option, place]
            if device.brace_bar is None or device.brace_bar.strut is None:
                continue
            (name,) = frame.project.grid.damper_names(frame.kind(option, place), place)
            i = names.index(name)
            stroke = float(strokes[i]) * device.deformation_scale
            ratio = force_ratio(
                device.values, stroke, 2.0 * math.pi * frequency * stroke, self._factors.stroke, self._factors.velocity
            )
            own = getattr(self._asked.get(option), "overstrength", None)
            factor = ratio * float(self._factors.overstrength if own is None else own)
            uses.append(BraceAt(name, option, device, factor, factor * device.brace_bar.share * float(forces[i])))
        return uses

    def grow(self, uses: Sequence[BraceAt]) -> bool:
        """Give each chosen brace that is used beyond its resistance the lightest section that holds in all its places.

        Returns:
            Whether any section changed.

        Raises:
            InputError: no section of its lists does.
        """
        before = dict(self.sections)
        for option in self._asked:
            own = [(self._list(option, one.device), one.force) for one in uses if one.option == option]
            names = [one.section for one in own[0][0]] if own else []
            for name in names[names.index(self.sections[option]) :] if own else []:
                at = [next((c for c in among if c.section == name), None) for among, _ in own]
                if all(c is not None and c.strut.resistance >= force for c, (_, force) in zip(at, own, strict=True)):
                    self.sections[option] = name
                    break
            else:
                if own:
                    among, force = max(own, key=lambda one: one[1])
                    message = f"{self._where[option]}.choose: {why_none(among, force, 0.0)} [E-DAMPER-06]"
                    raise InputError(message)
        return self.sections != before


def searched(brace: object) -> bool:
    """Return whether the section of a brace is chosen by histories: lists without a force that it has to hold."""
    return isinstance(brace, AnyChosenBrace) and not isinstance(brace, ChosenBrace)


def store_braces(group: Group, uses: Sequence[BraceAt], about: Mapping[str, str]) -> None:
    """Add the braces of the chosen layout to the group of a placement.

    Args:
        about: attributes: the level of the histories whose forces they hold.
    """
    bars = [(one, one.device.brace_bar) for one in uses]
    if not bars:
        return
    coordinate(group, "braced", [one.name for one in uses], "", "dampers whose braces have sections")
    add = group.add
    add("braced_storey", ("braced",), [one.device.storey for one in uses], "1", "storey of the damper")
    add("braced_section", ("braced",), [bar.section for _, bar in bars if bar is not None], "", "section of its braces")
    for name, values, unit, label in (
        ("share", [bar.share for _, bar in bars if bar], "1", "axial force of a brace over that of the dampers"),
        ("factor", [one.factor for one in uses], "1", "factor on the force: stroke, velocity and overstrength"),
        ("force", [one.force for one in uses], "N", "N_Ed of a brace by the histories of the chosen layout"),
        ("resistance", [b.strut.resistance for _, b in bars if b and b.strut], "N", "N_b,Rd by EN 1993-1-1, 6.3.1"),
    ):
        add(f"braced_{name}", ("braced",), values, unit, label)
    group.attributes |= dict(about)
