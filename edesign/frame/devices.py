"""Dampers of a project in the frame model: where they attach, at what size, with which brace."""

from __future__ import annotations

import math
from collections.abc import Collection, Iterator, Mapping
from dataclasses import dataclass

from edesign.codes.aisc341.buckling_restrained import RestrainedBrace
from edesign.core import CoreError, LawValues, Model
from edesign.errors import InputError
from edesign.frame.sections.building_sections import BuildingSections
from edesign.frame.sections.named_section import cross_section
from edesign.frame.struts import Strut, strut
from edesign.project.dampers.dampers import (
    PROTOTYPE_SCALE,
    BraceSection,
    BraceStiffness,
    DamperBetween,
    DamperRun,
    restrained_misfits,
)
from edesign.project.frame.sections import no_section
from edesign.project.notation import names
from edesign.project.project import Project
from edesign.project.reading.problems import did_you_mean, keys_text

UX, UY = 0, 1
Term = tuple[float, int, int]


@dataclass(frozen=True)
class DeviceLaw:
    """A law with its parameters, and the layers of elastomer they belong to.

    Attributes:
        law: for the core, with its effects; these are of the prototype, as its parameters are.
        layers, layer_area (m2), layer_thickness (m): of the prototype; None: the law has no size of its own.
        tested_strain: largest shear strain of the tests that it comes from; None: not known.
        property_factor: on all forces.
    """

    law: LawValues
    layers: int | None = None
    layer_area: float | None = None
    layer_thickness: float | None = None
    tested_strain: float | None = None
    property_factor: float = 1.0

    @property
    def restrained(self) -> RestrainedBrace | None:
        """The buckling-restrained brace that its parameters are of; None: they are of another damper."""
        return RestrainedBrace.of_law(self.law.values) if self.law.law == "buckling_restrained" else None


@dataclass(frozen=True)
class BraceBar:
    """A brace of a damper that is given by its section.

    Attributes:
        strut: None: the section has no second moment of area.
        share: its axial force / the force of the damper.
        alternates: one of a pair, of which one is compressed whichever way the damper acts; otherwise a damper that
            shortens compresses it.
    """

    section: str
    strut: Strut | None
    share: float
    alternates: bool


@dataclass(frozen=True)
class DeviceSize:
    """Size of a damper: how many devices stand side by side, and what replaces the size of a law's prototype.

    Attributes:
        number: side by side.
        layers, layer_area (m2), layer_thickness (m): of one of them; None: as the prototype.
        scale: on the forces of a law without prototype.
    """

    number: int
    layers: int | None = None
    layer_area: float | None = None
    layer_thickness: float | None = None
    scale: float = 1.0

    @property
    def resized(self) -> bool:
        """True if anything replaces the size of a prototype."""
        return any(one is not None for one in (self.layers, self.layer_area, self.layer_thickness))

    def scales(self, law: DeviceLaw) -> tuple[float, float, float | None]:
        """Return the factors on force and deformation of a law, and the layers' thickness, m; None: it has no layers.

        Args:
            law: of the prototype.

        Returns:
            Factor on the force, factor on the deformation, and thickness, m.

        Source: thesis Eqs. 5.18-5.21.
        """
        if law.layers is None or law.layer_area is None or law.layer_thickness is None:
            return self.number * law.property_factor * self.scale, 1.0, None
        layers = self.layers if self.layers is not None else law.layers
        area = self.layer_area if self.layer_area is not None else law.layer_area
        thickness = self.layer_thickness if self.layer_thickness is not None else law.layer_thickness
        force = self.number * layers * area / (law.layers * law.layer_area)
        return law.property_factor * force, law.layer_thickness / thickness, thickness


@dataclass(frozen=True)
class Device:
    """A damper in the frame model.

    Attributes:
        number: its id in the core.
        law: name of its law in the project.
        values: the law with its parameters, at its own size and without the brace.
        storey: storey whose drift works it, from 1; 0: none.
        terms: (coefficient, node, degree) that its deformation is the sum of.
        layer_thickness: m, for the shear strain; None: the law has no layers.
        size: that its scales follow from.
        force_scale, deformation_scale: F = force_scale * law(deformation_scale * u).
        brace: N/m; 0: rigid.
        play: of the pins of its brace, from end to end, m.
        tested_strain: of its law.
        strain_limit: largest shear strain that its layers are meant for; None: none is said.
        brace_bar: the brace as a bar; None: it has none, or only its stiffness is known.
        design_deformation: amplitude of damper and brace at which it counts in natural modes, m; None: none is said.
        restrained: all braces that stand at its place, of its length; None: its law is another.
        column_base: name of the node of an isolated base that it acts on from the ground; "": it is no such one.
        carries: whether it acts from the beginning, under the gravity loads too.
    """

    name: str
    number: int
    law: str
    values: LawValues
    storey: int
    terms: tuple[Term, ...]
    layer_thickness: float | None
    size: DeviceSize
    force_scale: float
    deformation_scale: float
    brace: float
    play: float = 0.0
    tested_strain: float | None = None
    strain_limit: float | None = None
    brace_bar: BraceBar | None = None
    design_deformation: float | None = None
    restrained: RestrainedBrace | None = None
    column_base: str = ""
    carries: bool = False


@dataclass(frozen=True)
class Attached:
    """A tuned mass on a floor, m in kg, k in N/m, c in N s/m."""

    name: str
    floor: int
    mass: float
    stiffness: float
    damping: float


@dataclass(frozen=True)
class _Place:
    name: str
    storey: int
    index: int  # of its storey among those of the run
    terms: tuple[Term, ...]
    length: float  # of its brace
    cosine: float  # of the brace to the deformation
    braces: int  # that share the force


def add_devices(
    project: Project,
    model: Model,
    nodes: Mapping[str, int],
    laws: Mapping[str, DeviceLaw],
    outside: Collection[str] = (),
) -> tuple[Device, ...]:
    """Add the dampers of a project to its model.

    Args:
        model: has the nodes already.
        nodes: ids by name.
        laws: by name; dampers of others are left out.
        outside: names of dampers that stand elsewhere, in a laboratory.

    Raises:
        InputError: a place has no node because all that would end there is missing, or the section of a brace does not
            exist.

    Source: thesis Eqs. 5.18-5.21 (size), 5.10 with alpha_b = 2 cos^2 (chevron).
    """
    found: list[Device] = []
    taken: set[str] = set()
    devices = project.dampers.devices if project.dampers is not None else ()
    for i, run in enumerate(devices):
        where = f"{project.where('dampers', 'devices', i)}: dampers.devices[{i}]"
        if run.law not in laws:
            continue
        law = laws[run.law]
        if law.layers is None and run.strain_limit is not None:
            raise InputError(
                f"{where}: strain_limit: the law `{run.law}` has no `prototype`, and so no layers [E-DEVICE-01]"
            )
        if law.layers is None and (run.layers or run.layer_area or run.layer_thickness):
            raise InputError(
                f"{where}: the law `{run.law}` has no `prototype` whose size could be changed [E-DEVICE-01]"
            )
        if law.layers is not None and run.scale is not None:
            raise InputError(f"{where}: scale: {PROTOTYPE_SCALE.format(run.law)}")
        restrained = law.restrained
        if restrained is not None:
            for key, message in restrained_misfits(run.kind, run.brace).items():
                raise InputError(f"{where}: {key}: {message}")
        elif run.carries_gravity:
            message = (
                f"the law `{run.law}` is of a damper that is set in under the gravity loads; leave this key out"
                " [E-DEVICE-02]"
            )
            raise InputError(f"{where}: carries_gravity: {message}")
        for place in _places(project, run, nodes, where):
            size = _size(run, place)
            force_scale, deformation_scale, thickness = size.scales(law)
            own_brace = None
            if restrained is not None:
                deformation_scale = restrained.length / place.length
                own_brace = restrained.at(force_scale, place.length)
            brace = _brace(project, run, place, i)
            play = run.brace.play or 0.0 if isinstance(run.brace, BraceStiffness) else 0.0
            name = names.free_name(place.name, taken)
            taken.add(name)
            if name in outside:
                if run.carries_gravity:
                    message = (
                        f"{name} stands in the laboratory, where the gravity loads are not; leave this key out"
                        " [E-DEVICE-02]"
                    )
                    raise InputError(f"{where}: carries_gravity: {message}")
                continue
            scales = (force_scale, deformation_scale)
            try:
                number = model.damper(name, law.law, place.terms, brace, *scales, play, carries=run.carries_gravity)
            except CoreError as error:  # an effect that the law cannot have with a brace
                raise InputError(f"{where}: {error}") from error
            of_law = (*scales, brace, play, law.tested_strain, run.strain_limit, _brace_bar(project, run, place))
            amplitude = None if run.design_deformation is None else _of_storey(run.design_deformation, place)
            own = (place.storey, place.terms, thickness, size, *of_law, amplitude, own_brace)
            found.append(Device(name, number, run.law, law.law, *own, carries=run.carries_gravity))
    return tuple(found)


def add_attachment(model: Model, attached: Attached, node: int, x: float, y: float) -> int:
    """Add a tuned mass beside a node of its floor.

    Args:
        node: of the floor, number in the core.
        x: place of the mass, m.
        y: level of the mass, m.

    Returns:
        Number of the node of the mass.
    """
    mass = model.node(attached.name, x, y)
    model.tie(mass, node, uy=True, rz=True)
    model.mass(mass, attached.mass)
    model.link(f"{attached.name}_spring", node, mass, (attached.stiffness, 0.0, 0.0))
    if attached.damping > 0.0:
        dashpot = LawValues("viscous", (attached.damping,))
        model.damper(f"{attached.name}_dashpot", dashpot, ((1.0, mass, UX), (-1.0, node, UX)))
    return mass


def _places(project: Project, run: DamperRun | DamperBetween, nodes: Mapping[str, int], where: str) -> Iterator[_Place]:
    frame = project.frame
    if isinstance(run, DamperBetween):
        yield _between(project, run, nodes, where)
        return
    for index, storey in enumerate(run.storeys.numbers(1, frame.n_storeys)):
        for bay in run.bays.numbers(1, frame.n_bays):
            left, right = frame.bay_lines(bay)
            corner = {
                (line, floor): _node(nodes, names.node_name(line, floor), where)
                for line in (left, right)
                for floor in (storey - 1, storey)
            }
            width, height = frame.bay_widths[bay - 1], frame.storey_heights[storey - 1]
            low_left, low_right = corner[left, storey - 1], corner[right, storey - 1]
            top_left, top_right = corner[left, storey], corner[right, storey]
            name, *others = names.damper_names(run.kind, bay, storey)
            top: tuple[Term, ...] = ((0.5, top_left, UX), (0.5, top_right, UX))
            if run.kind == "storey":
                terms = (*top, (-0.5, low_left, UX), (-0.5, low_right, UX))
                yield _Place(name, storey, index, terms, height, 1.0, 1)
            elif run.kind == "chevron":
                # the apex moves with the mean of the lower ends and tilts with their difference
                tilt = 0.5 * height / (0.5 * width)
                lower_ends = ((-0.5, low_left, UX), (-0.5, low_right, UX), (-tilt, low_left, UY), (tilt, low_right, UY))
                length = math.hypot(0.5 * width, height)
                yield _Place(name, storey, index, (*top, *lower_ends), length, 0.5 * width / length, 2)
            elif run.kind == "chevron_braces":
                length = math.hypot(0.5 * width, height)
                apex = _node(nodes, names.beam_name(bay, storey), where)
                for one, lower_end, way in zip((name, *others), (low_left, low_right), (1.0, -1.0), strict=True):
                    c, s = way * 0.5 * width / length, height / length
                    terms = ((c, apex, UX), (s, apex, UY), (-c, lower_end, UX), (-s, lower_end, UY))
                    yield _Place(one, storey, index, terms, length, 1.0, 1)
            else:
                length = math.hypot(width, height)
                low, high = (low_left, top_right) if run.kind == "rising" else (low_right, top_left)
                c = width / length * (1.0 if run.kind == "rising" else -1.0)
                s = height / length
                terms = ((c, high, UX), (s, high, UY), (-c, low, UX), (-s, low, UY))
                yield _Place(name, storey, index, terms, length, 1.0, 1)


def _between(project: Project, run: DamperBetween, nodes: Mapping[str, int], where: str) -> _Place:
    start, end = run.nodes
    first, second = _node(nodes, start, where), _node(nodes, end, where)
    (x0, y0), (x1, y1) = project.frame.nodes[start], project.frame.nodes[end]
    length = math.hypot(x1 - x0, y1 - y0)
    c, s = (x1 - x0) / length, (y1 - y0) / length
    terms = ((c, second, UX), (s, second, UY), (-c, first, UX), (-s, first, UY))
    levels = project.frame.levels
    storey = next((i for i in range(1, len(levels)) if sorted((y0, y1)) == [levels[i - 1], levels[i]]), 0)
    return _Place(names.damper_between_name(start, end), storey, 0, terms, length, 1.0, 1)


def _node(nodes: Mapping[str, int], name: str, where: str) -> int:
    if name not in nodes:
        raise InputError(f"{where}: there is no node `{name}` in this frame{did_you_mean(name, nodes)} [E-NAME-01]")
    return nodes[name]


def _size(run: DamperRun | DamperBetween, place: _Place) -> DeviceSize:
    area = None if run.layer_area is None else _of_storey(run.layer_area, place)
    scale = 1.0 if run.scale is None else _of_storey(run.scale, place)
    return DeviceSize(run.number, run.layers, area, run.layer_thickness, scale)


def _of_storey(values: float | tuple[float, ...], place: _Place) -> float:
    return values[place.index] if isinstance(values, tuple) else values


def _brace_bar(project: Project, run: DamperRun | DamperBetween, place: _Place) -> BraceBar | None:
    if not isinstance(run.brace, BraceSection):
        return None
    share = 1.0 / (place.braces * place.cosine)
    made = strut(project, run.brace.section, run.brace.material, place.length)
    return BraceBar(run.brace.section, made, share, place.braces > 1)


def _brace(project: Project, run: DamperRun | DamperBetween, place: _Place, device: int) -> float:
    """Stiffness in series, N/m; 0: rigid."""
    if isinstance(run.brace, BraceStiffness):
        return _of_storey(run.brace.stiffness, place)
    if not isinstance(run.brace, BraceSection):
        return 0.0
    name = run.brace.section
    if name not in project.sections and BuildingSections().canonical(name) is None:
        keys = ("dampers", "devices", device, "brace", "section")
        message = no_section(name, project.sections, BuildingSections())
        raise InputError(f"{project.where(*keys)}: {keys_text(keys)}: {message}")
    axial = project.materials[run.brace.material].E * cross_section(project, name).area / place.length
    return place.braces * axial * place.cosine**2
