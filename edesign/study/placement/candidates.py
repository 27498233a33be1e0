"""The frame of a placement with every item of the catalogue at every candidate place, and the dampers of a layout."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import cast

import numpy as np

from edesign.errors import InputError
from edesign.frame.devices import Device
from edesign.project.analysis_file import AnalysisFile
from edesign.project.dampers.dampers import Brace, DamperRun, Dampers
from edesign.project.dampers.placement import CatalogueItem, Kind, PlacementDesign
from edesign.project.notation.frames import parse_frames
from edesign.project.notation.grid import BayPlace
from edesign.project.notation.selections import NumberSelection
from edesign.study.analysis.structure import Structure, make_structure
from edesign.study.design.beside import NOTHING_BESIDE, Standing
from edesign.study.design.building import with_temperature
from edesign.study.placement.space import Layout, LayoutSpace, Stack, make_positions, make_prices

_MIRROR: Mapping[Kind, Kind] = {"rising": "falling", "falling": "rising"}


@dataclass(frozen=True)
class Candidates:
    """The frame, catalogue and layouts that the search for a placement chooses from.

    Attributes:
        project: that is studied, its laws at the temperature of the design.
        spec: the design.
        space: of the layouts.
        structure: without dampers, in the state that the design asks for.
        devices: every item at every place, by number of the item (from 1) and place.
        index: of each of them in the condensed frame.
        beside: dampers of other designs that stand in the frame.
    """

    project: AnalysisFile
    spec: PlacementDesign
    space: LayoutSpace
    structure: Structure
    devices: Mapping[tuple[int, BayPlace], Device]
    index: Mapping[tuple[int, BayPlace], int]
    beside: Standing = NOTHING_BESIDE

    def equipped(self, layout: Layout) -> dict[BayPlace, int]:
        """Return the item at each equipped place of a layout, storey by storey."""
        found = {
            place: option
            for at, option in zip(self.space.positions, layout, strict=True)
            if option
            for place in at.places
        }
        return dict(sorted(found.items(), key=lambda item: (item[0].storey, item[0].frame, item[0].bay)))

    def dampers(self, layout: Layout, amplitudes: Mapping[BayPlace, float] | None = None) -> Dampers:
        """Return the project's dampers with those of a layout in place of its devices; equal ones stand in one run.

        Args:
            layout: of the space.
            amplitudes: estimated, of the dampers and braces of each equipped place, m: what they count at in natural
                modes where their item names no `design_deformation`. None: they count in small vibrations.
        """
        columns: dict[tuple[int, Kind, str, int], list[int]] = {}  # storeys by item, kind, frame and bay
        for place, option in self.equipped(layout).items():
            columns.setdefault((option, self.kind(option, place), place.frame, place.bay), []).append(place.storey)
        rows: dict[tuple[int, Kind, str, tuple[int, ...]], list[int]] = {}  # bays of a frame
        for (option, kind, frame, bay), storeys in sorted(columns.items()):
            rows.setdefault((option, kind, frame, tuple(storeys)), []).append(bay)
        runs: dict[tuple[int, Kind, str, tuple[int, ...], tuple[int, ...]], list[str]] = {}  # frames of a direction
        for (option, kind, frame, run_storeys), bays in rows.items():
            runs.setdefault((option, kind, frame[:1], tuple(bays), run_storeys), []).append(frame)
        items = tuple(self.spec.catalogue.values())
        devices = []
        for (option, kind, _, run_bays, run_storeys), frames in runs.items():
            run = _run(items[option - 1], kind, frames, run_bays, run_storeys)
            if amplitudes is not None and run.design_deformation is None:
                places = [
                    [BayPlace(frame, bay, storey) for frame in frames for bay in run_bays] for storey in run_storeys
                ]
                found = [float(np.mean([amplitudes[place] for place in alike])) for alike in places]
                update = {"design_deformation": tuple(float(f"{mean:.3g}") for mean in found)}
                run = run.model_copy(update=update)
            devices.append(run)
        before = self.project.dampers
        assert before is not None, "check_placement wants the laws"
        return before.model_copy(update={"devices": tuple(devices)})

    def kind(self, option: int, place: BayPlace) -> Kind:
        """Return the kind in which an item stands at a place; diagonals lean the other way in the mirrored half.

        Args:
            option: number of the item, from 1.
        """
        item = list(self.spec.catalogue.values())[option - 1]
        return _kind_at(item.kind or self.spec.kind, place in self._leaning)

    @cached_property
    def _leaning(self) -> frozenset[BayPlace]:
        """Places whose diagonals lean the other way."""
        pairs = (pair for at in self.space.positions for pair in zip(at.places, at.mirrored, strict=True))
        return frozenset(place for place, leaning in pairs if leaning)


def make_stacks(project: AnalysisFile, spec: PlacementDesign) -> Iterator[Stack]:
    """Yield the candidate bays that are equipped alike.

    They are a bay of a plane frame, with its mirror image where the design wants it, the bays of a frame of a
    building, or those of frames that are tied.

    Args:
        project: that is studied.
    """
    mirrored = spec.limits.mirrored
    for run in spec.candidates:
        last = len(project.widths(run.along))
        stacks: dict[object, list[BayPlace]] = {}
        for place in project.grid.bay_places(run):
            if run.along is not None:
                alike: object = None if run.tied else place.frame
            else:
                alike = min(place.bay, last + 1 - place.bay) if mirrored else place.bay
            stacks.setdefault(alike, []).append(place)
        yield from (Stack(tuple(places), last if mirrored else None) for places in stacks.values())


def make_candidates(
    project: AnalysisFile, name: str, spec: PlacementDesign, beside: Standing = NOTHING_BESIDE
) -> Candidates:
    """Build the frame with every item of the catalogue at every candidate place, without tuned masses.

    Args:
        project: with the laws; checked by `check_placement`.
        name: of the design.

    Raises:
        InputError: a law is wrong, a place has no nodes, or the frame cannot be built.
        AnalysisError: the frame is unstable.
    """
    for law in dict.fromkeys(item.law for item in spec.catalogue.values()):
        project = with_temperature(project, law, spec.temperature)
    before = project.dampers
    assert before is not None, "check_placement wants the laws"
    kinds = [item.kind or spec.kind for item in spec.catalogue.values()]
    positions = make_positions(
        make_stacks(project, spec),
        range(1, len(kinds) + 1),
        spec.limits.continuous,
        [group.numbers(1, project.grid.n_storeys) for group in spec.limits.storey_groups],
        [i for i, kind in enumerate(kinds, start=1) if kind in _MIRROR],
    )
    wanted = [
        (option, place, leaning)
        for at in positions
        for option in at.options
        for place, leaning in zip(at.places, at.mirrored, strict=True)
    ]
    items = list(spec.catalogue.values())
    runs = tuple(
        _run(items[option - 1], _kind_at(kinds[option - 1], leaning), [at.frame], (at.bay,), (at.storey,))
        for option, at, leaning in wanted
    )
    laws = {**before.laws, **beside.laws}
    trial = Dampers.model_construct(laws=laws, devices=(*runs, *beside.devices), attachments=())
    try:
        structure = make_structure(project.model_copy(update={"dampers": trial}), dampers=True)
    except InputError as error:  # the devices stand in no file: the place is the item of the catalogue
        found = re.search(r"dampers\.devices\[(\d+)\]([\w.]*): (.*) \[E-", str(error), re.DOTALL)
        if found is None:
            raise
        option, place, _ = wanted[int(found[1])]
        where = f"designs.{name}.catalogue.{list(spec.catalogue)[option - 1]}{found[2]}"
        stands = f"{f'frame {place.frame}, ' if place.frame else ''}bay {place.bay}, storey {place.storey}"
        raise InputError(f"{where}: {found[3]} (at {stands}) [E-PLACE-01]") from error
    if spec.state == "gravity":
        structure.apply_gravity()
    keys = [(option, place) for option, place, _ in wanted]
    own = [device for device in structure.frame.devices if device.name not in beside.stiffness]
    devices = dict(zip(keys, own, strict=True))
    costs = spec.costs
    space = LayoutSpace(
        positions,
        make_prices(
            [item.cost for item in items],
            [item.number for item in items],
            costs.place,
            costs.storey,
            costs.bay,
        ),
        (0, *(item.number for item in items)),
        spec.limits.most_dampers,
        _not_larger(items, kinds, devices),
    )
    index = {key: i for i, key in enumerate(keys)}
    return Candidates(project, spec, space, structure, devices, index, beside)


def _kind_at(kind: Kind, leaning: bool) -> Kind:
    """A kind, leaning the other way where it is a mirror image."""
    return _MIRROR.get(kind, kind) if leaning else kind


def _run(
    item: CatalogueItem, kind: Kind, frames: Sequence[str], bays: tuple[int, ...], storeys: tuple[int, ...]
) -> DamperRun:
    """Dampers of an item in frames of one direction, of which that of a project has no name."""
    named = parse_frames(list(frames)) if frames[0] else None
    return DamperRun.model_construct(
        kind=kind,
        along=named.items[0].along if named is not None else None,
        frames=named,
        bays=_selection(bays),
        storeys=_selection(storeys),
        law=item.law,
        number=item.number,
        layers=item.layers,
        layer_area=item.layer_area,
        layer_thickness=item.layer_thickness,
        scale=item.scale,
        design_deformation=item.design_deformation,
        brace=cast(Brace, item.brace),  # of one that is chosen the section is known here
    )


def _selection(numbers: tuple[int, ...]) -> NumberSelection:
    """Ascending numbers, neighbours as a range."""
    ranges: list[tuple[int, int]] = []
    for number in numbers:
        if ranges and ranges[-1][1] == number - 1:
            ranges[-1] = (ranges[-1][0], number)
        else:
            ranges.append((number, number))
    return NumberSelection(tuple(ranges))


def _not_larger(
    items: list[CatalogueItem], kinds: list[Kind], devices: Mapping[tuple[int, BayPlace], Device]
) -> np.ndarray:
    """Whether an option is another, or has its law, kind and layers' thickness and no more force and brace.

    The empty option is not larger than any; items of different laws do not compare. It has to be so at every place:
    a brace of a section is not equally stiff in all bays, one of a given stiffness is.
    """
    found = np.eye(len(items) + 1, dtype=bool)
    found[0] = True
    compared: dict[tuple[int, int], bool] = {}
    for (a, place), small in devices.items():
        for b in range(1, len(items) + 1):
            large = devices.get((b, place))
            if large is None or a == b:
                continue
            alike = small.law == large.law and small.deformation_scale == large.deformation_scale
            alike = alike and kinds[a - 1] == kinds[b - 1] and small.play == large.play
            braced = _brace(items[a - 1], small) <= _brace(items[b - 1], large)
            here = alike and braced and small.force_scale <= large.force_scale
            compared[a, b] = here and compared.get((a, b), True)
    for pair, everywhere in compared.items():
        found[pair] = everywhere
    return found


def _brace(item: CatalogueItem, device: Device) -> float:
    """Stiffness of the brace of an item at a place, N/m; infinite where it is rigid."""
    return math.inf if item.brace == "rigid" else device.brace
