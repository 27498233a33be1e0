"""The frame of a placement with every item of the catalogue at every candidate place, and the dampers of a layout."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from edesign.errors import InputError
from edesign.frame.devices import Device
from edesign.project.dampers.dampers import BraceSection, BraceStiffness, DamperRun, Dampers
from edesign.project.dampers.placement import CatalogueItem, Kind, PlacementDesign
from edesign.project.notation.selections import NumberSelection
from edesign.project.project import Project
from edesign.study.analysis.structure import make_structure
from edesign.study.design.building import with_temperature
from edesign.study.design.condensed import CondensedFrame, condense
from edesign.study.placement.space import Layout, LayoutSpace, Place, make_positions, make_prices

_MIRROR: Mapping[Kind, Kind] = {"rising": "falling", "falling": "rising"}


@dataclass(frozen=True)
class Candidates:
    """The frame, catalogue and layouts that the search for a placement chooses from.

    Attributes:
        project: that is studied, its laws at the temperature of the design.
        spec: the design.
        space: of the layouts.
        frame: condensed, linear, without dampers, in the state that the design asks for.
        devices: every item at every place, by number of the item (from 1) and place.
        index: of each of them in the condensed frame.
        heights: of the storeys, m.
    """

    project: Project
    spec: PlacementDesign
    space: LayoutSpace
    frame: CondensedFrame
    devices: Mapping[tuple[int, Place], Device]
    index: Mapping[tuple[int, Place], int]
    heights: np.ndarray

    def equipped(self, layout: Layout) -> dict[Place, int]:
        """Return the item at each equipped place of a layout, storey by storey."""
        found = {
            place: option
            for at, option in zip(self.space.positions, layout, strict=True)
            if option
            for place in at.places
        }
        return dict(sorted(found.items(), key=lambda item: (item[0][1], item[0][0])))

    def dampers(self, layout: Layout, amplitudes: Mapping[Place, float] | None = None) -> Dampers:
        """Return the project's dampers with those of a layout in place of its devices; equal ones stand in one run.

        Args:
            layout: of the space.
            amplitudes: estimated, of the dampers and braces of each equipped place, m: what they count at in natural
                modes where their item names no `design_deformation`. None: they count in small vibrations.
        """
        columns: dict[tuple[int, Kind, int], list[int]] = {}  # storeys by item, kind and bay
        for (bay, storey), option in self.equipped(layout).items():
            columns.setdefault((option, self.kind(option, (bay, storey)), bay), []).append(storey)
        runs: dict[tuple[int, Kind, tuple[int, ...]], list[int]] = {}
        for (option, kind, bay), storeys in sorted(columns.items()):
            runs.setdefault((option, kind, tuple(storeys)), []).append(bay)
        items = tuple(self.spec.catalogue.values())
        devices = []
        for (option, kind, run_storeys), bays in runs.items():
            run = _run(items[option - 1], kind, tuple(bays), run_storeys)
            if amplitudes is not None and run.design_deformation is None:
                found = [float(np.mean([amplitudes[bay, storey] for bay in bays])) for storey in run_storeys]
                update = {"design_deformation": tuple(float(f"{mean:.3g}") for mean in found)}
                run = run.model_copy(update=update)
            devices.append(run)
        before = self.project.dampers
        assert before is not None, "check_placement wants the laws"
        return before.model_copy(update={"devices": tuple(devices)})

    def kind(self, option: int, place: Place) -> Kind:
        """Return the kind in which an item stands at a place; diagonals lean the other way in the mirrored half.

        Args:
            option: number of the item, from 1.
            place: bay and storey, from 1.
        """
        item = list(self.spec.catalogue.values())[option - 1]
        leaning = self.spec.limits.mirrored and 2 * place[0] > self.project.frame.n_bays + 1
        return _kind_at(item.kind or self.spec.kind, leaning)


def make_candidates(project: Project, name: str, spec: PlacementDesign) -> Candidates:
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
    before, plane = project.dampers, project.frame
    assert before is not None, "check_placement wants the laws"
    kinds = [item.kind or spec.kind for item in spec.catalogue.values()]
    positions = make_positions(
        spec.bays.numbers(1, plane.n_bays),
        spec.storeys.numbers(1, plane.n_storeys),
        range(1, len(kinds) + 1),
        plane.n_bays if spec.limits.mirrored else None,
        spec.limits.continuous,
        [group.numbers(1, plane.n_storeys) for group in spec.limits.storey_groups],
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
        _run(items[option - 1], _kind_at(kinds[option - 1], leaning), (bay,), (storey,))
        for option, (bay, storey), leaning in wanted
    )
    trial = Dampers.model_construct(laws=before.laws, devices=runs, attachments=())
    try:
        structure = make_structure(project.model_copy(update={"dampers": trial}), dampers=True)
    except InputError as error:  # the devices stand in no file: the place is the item of the catalogue
        found = re.search(r"dampers\.devices\[(\d+)\]([\w.]*): (.*) \[E-", str(error), re.DOTALL)
        if found is None:
            raise
        option, (bay, storey), _ = wanted[int(found[1])]
        where = f"designs.{name}.catalogue.{list(spec.catalogue)[option - 1]}{found[2]}"
        raise InputError(f"{where}: {found[3]} (at bay {bay}, storey {storey}) [E-PLACE-01]") from error
    if spec.state == "gravity":
        structure.apply_gravity()
    keys = [(option, place) for option, place, _ in wanted]
    devices = dict(zip(keys, structure.frame.devices, strict=True))
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
    return Candidates(project, spec, space, condense(structure), devices, index, np.array(plane.storey_heights))


def _kind_at(kind: Kind, leaning: bool) -> Kind:
    """A kind, leaning the other way where it is a mirror image."""
    return _MIRROR.get(kind, kind) if leaning else kind


def _run(item: CatalogueItem, kind: Kind, bays: tuple[int, ...], storeys: tuple[int, ...]) -> DamperRun:
    return DamperRun.model_construct(
        kind=kind,
        bays=_selection(bays),
        storeys=_selection(storeys),
        law=item.law,
        number=item.number,
        layers=item.layers,
        layer_area=item.layer_area,
        layer_thickness=item.layer_thickness,
        scale=item.scale,
        design_deformation=item.design_deformation,
        brace=item.brace,
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
    items: list[CatalogueItem], kinds: list[Kind], devices: Mapping[tuple[int, Place], Device]
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
    return device.brace if isinstance(item.brace, (BraceStiffness, BraceSection)) else math.inf
