"""An isolated base in the frame model: its loads and mass, its supports, its isolators and what acts beside them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

from edesign.core import Model
from edesign.errors import InputError
from edesign.frame.devices import Device, DeviceLaw, DeviceSize
from edesign.frame.sections.named_section import cross_section
from edesign.frame.supports import vertical_spring
from edesign.project.actions.loads import Combination
from edesign.project.analysis_file import AnalysisFile
from edesign.project.dampers.dampers import PROTOTYPE_SCALE
from edesign.project.dampers.isolation import (
    CIRCULAR,
    NEEDS_STIFFNESS,
    UNCOUPLED,
    WEIGHED,
    AnyBaseDevice,
    AnyIsolation,
    AnyIsolator,
    Isolation,
    not_in_all_directions,
)
from edesign.project.frame.frame import Frame
from edesign.project.frame.supports import SupportSprings, VerticalSpring
from edesign.project.notation import names
from edesign.project.notation.grid import Grid
from edesign.project.notation.units import STANDARD_GRAVITY
from edesign.project.project import Project

AXES = ("x", "y")
"""Horizontal directions by their degrees in the core."""


@dataclass(frozen=True)
class IsolatedBases:
    """Devices of an isolated base in a model.

    Attributes:
        devices: all that acts between the ground and the base, isolators first.
        isolators: what carries the columns, of those along x and along y the one along x by the name of both.
        weighed: names of isolators whose forces are proportional to the weight under gravity, whatever comes later.
    """

    devices: tuple[Device, ...]
    isolators: tuple[Device, ...]
    weighed: frozenset[str]

    def at(self, column_base: str, direction: int) -> tuple[int, ...]:
        """Return the numbers in the core of all that acts at a column base along a horizontal direction.

        Args:
            column_base: name of its node.
            direction: degree of the core.
        """
        return tuple(
            device.number
            for device in self.devices
            if device.column_base == column_base and device.direction == direction
        )


def base_loads(frame: Frame, isolation: Isolation, factors: Combination) -> dict[str, float]:
    """Return the loads of an isolated base on the column bases, N downwards, by node.

    A column base carries half of what lies between it and its neighbours.

    Args:
        frame: of the project.
        isolation: base and isolators.
        factors: on the permanent and the variable part.
    """
    load = factors.G * isolation.base.G + factors.Q * isolation.base.Q
    return {node: load * width for node, width in _widths(frame).items()}


def base_masses(project: Project) -> dict[str, float]:
    """Return the mass of an isolated base at the column bases, kg, by node."""
    frame, isolation, masses = project.frame, project.isolation, project.masses
    if isolation is None:
        return {}
    base = isolation.base
    if base.mass is not None:
        widths = _widths(frame)
        return {node: base.mass * width / sum(widths.values()) for node, width in widths.items()}
    if masses is None or masses.from_loads is None:
        return {}
    return {node: load / STANDARD_GRAVITY for node, load in base_loads(frame, isolation, masses.from_loads).items()}


def isolated_support(frame: Frame, isolation: Isolation, line: str) -> SupportSprings:
    """Return how the base of a line is supported in other directions than the horizontal one.

    Args:
        frame: of the project.
        isolation: base and isolators.
        line: name of the column line.
    """
    isolator = isolator_under(isolation, line, frame)
    rotation = isolation.base.rotation or "free"  # with beams there is none: checked
    if isolator is None:  # it slides freely: checked
        return SupportSprings(horizontal="free", vertical="fixed", rotation=rotation)
    vertical = isolator.vertical
    if isinstance(vertical, VerticalSpring):
        resistance = None if vertical.resistance is None else isolator.number * vertical.resistance
        change = {"stiffness": isolator.number * vertical.stiffness, "resistance": resistance}
        vertical = vertical.model_copy(update=change)
    elif isinstance(vertical, float):
        vertical = isolator.number * vertical
    return SupportSprings.model_construct(horizontal="free", vertical=vertical, rotation=rotation)


def add_base_beams(project: Project, model: Model, nodes: Mapping[str, int]) -> None:
    """Add the beams of an isolated base, if it has any, from each column base to the next one.

    They stay elastic, and are no members: they carry what the column bases turn with to the isolators.

    Args:
        model: has the nodes and the materials already.
        nodes: ids by name.
    """
    beams = None if project.isolation is None else project.isolation.base.beams
    if beams is None:
        return
    shape = cross_section(project, beams.section, beams.axis)
    E = project.materials[beams.material].E
    section = model.elastic_section(E * shape.area, E * (shape.inertia or 0.0))
    column_bases = [column_base for line in project.frame.lines if (column_base := names.node_name(line, 0)) in nodes]
    for left, right in pairwise(column_bases):
        name = f"beam of the base from {left} to {right}"
        model.beam_column(name, nodes[left], nodes[right], section, geometry="linear")


def isolator_under(isolation: AnyIsolation, line: str, grid: Grid) -> AnyIsolator | None:
    """Return the isolator under a line; None if there is none.

    Args:
        isolation: base and isolators.
        line: name of the column line.
        grid: of the structure.
    """
    return next((item for item in isolation.isolators if line in item.under((line,), grid)), None)


def goes_with_weight(isolator: AnyIsolator, law: DeviceLaw) -> bool:
    """Say whether the forces of an isolator follow from the weight that stands on it under gravity."""
    return law.law.law == WEIGHED and isolator.weight != "law"


def add_isolation(
    project: AnalysisFile,
    model: Model,
    nodes: Mapping[str, int],
    laws: Mapping[str, DeviceLaw],
    weights: Mapping[str, float],
) -> IsolatedBases:
    """Add the isolators of a project or building, which act from the beginning, and what acts beside them.

    Isolators of buildings act along x and y: by a law whose forces lie within a circle, or by two of a linear law.

    Args:
        project: validated, with an isolation.
        model: has the nodes already.
        nodes: ids by name.
        weights: on the column bases under the gravity combination, N, by node; of those whose isolator needs it.

    Raises:
        InputError: a size or a weight that the law does not know, an isolator without weight, or one of a building
            whose law acts in one direction alone.
    """
    grid, isolation = project.grid, project.isolation
    assert isolation is not None
    found: list[Device] = []
    isolators: list[Device] = []
    weighed: set[str] = set()
    taken: set[str] = set()
    groups: tuple[tuple[str, Sequence[AnyBaseDevice]], ...] = (
        ("isolators", isolation.isolators),
        ("beside", isolation.beside),
    )
    for group, items in groups:
        for i, item in enumerate(items):
            where = f"{project.where('dampers', 'isolation', group, i)}: dampers.isolation.{group}[{i}]"
            law = laws[item.law]
            _check_size(item, law, where)
            _check_directions(item, law, where)
            size = DeviceSize(item.number, item.layers, item.layer_area, item.layer_thickness, item.scale or 1.0)
            for line in item.under(grid.lines, grid):
                column_base = grid.node_name(line, 0)
                if column_base not in nodes:
                    continue
                force_scale, deformation_scale, thickness = size.scales(law)
                carries = isinstance(item, AnyIsolator)
                name = (names.isolator_name if carries else names.base_device_name)(line)
                pressed_by = None
                if isinstance(item, AnyIsolator) and goes_with_weight(item, law):
                    weight = _weight(weights, column_base, where)
                    force_scale = law.property_factor * weight / law.law.values[0]
                    if item.weight == "varying":
                        spring = vertical_spring(column_base, model.dimension)
                        pressed_by = model.element_names.index(spring), weight
                    else:
                        weighed.add(name)
                along = [AXES.index(axis) if axis else 0 for axis in item.axes]
                own = [names.free_name(names.of_axis(name, axis), taken) for axis in item.axes]
                taken.update(own)
                terms = [((1.0, nodes[column_base], degree),) for degree in along]
                scales = (force_scale, deformation_scale)
                circular = len(along) == 2 and law.law.law in CIRCULAR
                across = (own[1], terms[1]) if circular else None
                numbers = [
                    model.damper(
                        own[at], law.law, terms[at], 0.0, *scales, carries=True, pressed_by=pressed_by, across=across
                    )
                    for at in range(1 if circular else len(along))
                ]
                numbers += [numbers[0] + 1] * circular
                devices = [
                    Device(
                        own[at],
                        numbers[at],
                        item.law,
                        law.law,
                        0,
                        terms[at],
                        thickness,
                        size,
                        *scales,
                        0.0,
                        tested_strain=law.tested_strain,
                        design_deformation=isolation.design_displacement,
                        across=numbers[1 - at] if len(along) == 2 else None,
                        column_base=column_base,
                        direction=degree,
                    )
                    for at, degree in enumerate(along)
                ]
                found += devices
                if carries:
                    isolators.append(devices[0] if len(along) == 1 else replace(devices[0], name=name))
    return IsolatedBases(tuple(found), tuple(isolators), frozenset(weighed))


def _widths(frame: Frame) -> dict[str, float]:
    """Half of the distances from each column base to its neighbours, m, by node; of an only column base 1 m."""
    column_bases = [(names.node_name(line, 0), x) for line, x in zip(frame.lines, frame.x, strict=True)]
    column_bases = [(node, x) for node, x in column_bases if node in frame.nodes]
    if len(column_bases) == 1:
        return {column_bases[0][0]: 1.0}
    spans = [right - left for (_, left), (_, right) in zip(column_bases, column_bases[1:], strict=False)]
    halves = zip([0.0, *spans], [*spans, 0.0], strict=True)
    return {node: 0.5 * (before + after) for (node, _), (before, after) in zip(column_bases, halves, strict=True)}


def _check_directions(item: AnyBaseDevice, law: DeviceLaw, where: str) -> None:
    """An isolator of a building acts alike in all horizontal directions; law files are known only here."""
    if len(item.axes) == 2 and (law.law.effects or law.law.law not in CIRCULAR + UNCOUPLED):
        raise InputError(f"{where}: law: {not_in_all_directions(item.law, law.law.law, bool(law.law.effects))}")


def _check_size(item: AnyBaseDevice, law: DeviceLaw, where: str) -> None:
    """A size needs a prototype, a scale needs none and no weight of the law; law files are known only here."""
    if law.layers is None and (item.layers or item.layer_area or item.layer_thickness):
        raise InputError(f"{where}: the law `{item.law}` has no `prototype` whose size could be changed [E-DEVICE-01]")
    if isinstance(item, AnyIsolator) and item.weight is not None and law.law.law != WEIGHED:
        raise InputError(
            f"{where}.weight: the forces of the law `{item.law}` ({law.law.law}) need no weight [E-DEVICE-03]"
        )
    if isinstance(item, AnyIsolator) and item.weight == "varying" and item.vertical == "fixed":
        raise InputError(f"{where}.weight: {NEEDS_STIFFNESS}")
    if item.scale is None:
        return
    if law.layers is not None:
        raise InputError(f"{where}: scale: {PROTOTYPE_SCALE.format(item.law)}")
    if isinstance(item, AnyIsolator) and goes_with_weight(item, law):
        message = "its forces follow from the weight on it; leave the `scale` out, or say `weight: law` [E-DEVICE-03]"
        raise InputError(f"{where}: scale: {message}")


def _weight(weights: Mapping[str, float], column_base: str, where: str) -> float:
    weight = weights.get(column_base, 0.0)
    if not weight > 0.0:
        message = (
            f"the isolator under {column_base} carries {weight:.4g} N under gravity; it needs a weight for its friction"
            " [E-DEVICE-03]"
        )
        raise InputError(f"{where}: {message}")
    return weight
