"""The dampers and isolators of a project or a design by their names, as frames and archives have them; their laws."""

from __future__ import annotations

from collections.abc import Sequence

from edesign.project.dampers.dampers import DamperBetween, Dampers, Device
from edesign.project.dampers.designs import Design, DesignRun
from edesign.project.dampers.isolation import AnyBaseDevice
from edesign.project.dampers.placement import PlacementDesign
from edesign.project.notation import names
from edesign.project.notation.grid import Grid


def devices_by_name(grid: Grid, dampers: Dampers | None) -> dict[str, tuple[Device, int]]:
    """Return every damper above the base with its description and its storey, 0 of one between nodes.

    Args:
        dampers: the dampers; None: the project has none.
    """
    found: dict[str, tuple[Device, int]] = {}
    for device in dampers.devices if dampers is not None else ():
        if isinstance(device, DamperBetween):
            found[names.free_name(names.damper_between_name(*device.nodes), found)] = device, 0
            continue
        for place in grid.bay_places(device):
            for name in grid.damper_names(device.kind, place):
                found[names.free_name(name, found)] = device, place.storey
    return found


def names_of_dampers(grid: Grid, dampers: Dampers | None) -> tuple[str, ...]:
    """Return the names of the dampers and isolators of a project, those of an isolated base first.

    Args:
        dampers: the dampers; None: the project has none.
    """
    base: list[str] = []
    items: Sequence[AnyBaseDevice]
    isolation = dampers.isolation if dampers is not None else None
    if isolation is not None:
        for named, items in (
            (names.isolator_name, isolation.isolators),
            (names.base_device_name, isolation.beside),
        ):
            for item in items:
                for line in item.under(grid.lines, grid):
                    if grid.node_name(line, 0) in grid.nodes:
                        base += [names.free_name(names.of_axis(named(line), axis), base) for axis in item.axes]
    return (*base, *devices_by_name(grid, dampers))


def laws_of_design(design: Design) -> tuple[str, ...]:
    """Return the names of the laws that the dampers of a design may have."""
    if isinstance(design, PlacementDesign):
        return tuple(dict.fromkeys(item.law for item in design.catalogue.values()))
    return (design.law,)


def names_of_design(grid: Grid, design: Design) -> tuple[str, ...]:
    """Return the names of the dampers that a design places, or may place.

    Args:
        design: a design of a study.
    """
    if not isinstance(design, PlacementDesign):
        return tuple(name for run in design.runs for name in names_of_run(grid, run))
    kinds = dict.fromkeys(kind for item in design.catalogue.values() for kind in design.kinds_of(item))
    return tuple(
        name
        for kind in kinds
        for run in design.candidates
        for place in grid.bay_places(run)
        for name in grid.damper_names(kind, place)
    )


def names_of_run(grid: Grid, run: DesignRun) -> tuple[str, ...]:
    """Return the names of the dampers of one kind of a design."""
    return tuple(name for place in grid.bay_places(run) for name in grid.damper_names(run.kind, place))
