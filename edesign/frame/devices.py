"""Dampers of a project in the frame model: where they attach, at what size, with which brace."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import dataclass

from edesign.codes.aisc341.buckling_restrained import RestrainedBrace
from edesign.core import CoreError, LawValues, Model
from edesign.errors import InputError
from edesign.frame.chosen_braces import chosen_brace
from edesign.frame.device_places import DamperSites, DevicePlace, Term, device_places
from edesign.frame.struts import Strut
from edesign.project.analysis_file import AnalysisFile
from edesign.project.dampers.dampers import (
    PROTOTYPE_SCALE,
    SET_IN,
    BraceStiffness,
    ChosenBrace,
    DamperBetween,
    DamperRun,
    restrained_misfits,
)
from edesign.project.notation import names
from edesign.project.reading.problems import Keys


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
        material: name of its steel.
    """

    section: str
    strut: Strut | None
    share: float
    alternates: bool
    material: str = ""


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
        across: number of the other direction of an isolator of a building; None: it has one direction alone.
        column_base: name of the node of an isolated base that it acts on from the ground; "": it is no such one.
        carries: whether it acts from the beginning, under the gravity loads too.
        frame: name of the plane frame of a building that it stands in; "": of none, or of a plane frame.
        direction: index of the horizontal direction that it acts in; None: both, or none.
        stands: how, as `kind` in the file; "" on an isolated base.
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
    across: int | None = None
    column_base: str = ""
    carries: bool = False
    frame: str = ""
    direction: int | None = 0
    stands: str = ""


def add_devices(
    project: AnalysisFile,
    model: Model,
    nodes: Mapping[str, int],
    laws: Mapping[str, DeviceLaw],
    sites: DamperSites,
    outside: Collection[str] = (),
) -> tuple[Device, ...]:
    """Add the dampers of a project or building to its model.

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
            raise InputError(f"{where}: carries_gravity: {SET_IN.format(run.law)}")
        for place in device_places(project, run, sites, nodes, where):
            size = _size(run, place)
            force_scale, deformation_scale, thickness = size.scales(law)
            own_brace = None
            if restrained is not None:
                deformation_scale = restrained.length / place.length
                own_brace = restrained.at(force_scale, place.length)
            brace, bar = _brace(sites, run, place, ("dampers", "devices", i), f"{where}: brace")
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
            of_law = (*scales, brace, play, law.tested_strain, run.strain_limit, bar)
            amplitude = None if run.design_deformation is None else _of_storey(run.design_deformation, place)
            own = (place.storey, place.terms, thickness, size, *of_law, amplitude, own_brace)
            device = Device(
                name,
                number,
                run.law,
                law.law,
                *own,
                carries=run.carries_gravity,
                frame=place.frame,
                direction=place.direction,
                stands=run.kind,
            )
            found.append(device)
    return tuple(found)


def _size(run: DamperRun | DamperBetween, place: DevicePlace) -> DeviceSize:
    area = None if run.layer_area is None else _of_storey(run.layer_area, place)
    scale = 1.0 if run.scale is None else _of_storey(run.scale, place)
    return DeviceSize(run.number, run.layers, area, run.layer_thickness, scale)


def _of_storey(values: float | tuple[float, ...], place: DevicePlace) -> float:
    return values[place.index] if isinstance(values, tuple) else values


def _brace(
    sites: DamperSites, run: DamperRun | DamperBetween, place: DevicePlace, keys: Keys, where: str
) -> tuple[float, BraceBar | None]:
    """Stiffness in series, N/m, 0: rigid; and the brace as a bar if it is given by its section."""
    brace = run.brace
    if isinstance(brace, BraceStiffness):
        return _of_storey(brace.stiffness, place), None
    if brace == "rigid":
        return 0.0, None
    if isinstance(brace, ChosenBrace):
        brace = chosen_brace(sites, brace, place, keys, where)
    else:
        brace = brace.model_copy(update={"section": brace.of(place.index)})
    axial, as_strut = sites.bar(brace, place.length, keys)
    bar = BraceBar(brace.of(0), as_strut, place.share, place.braces > 1, brace.material)
    return place.braces * axial * place.cosine**2, bar
