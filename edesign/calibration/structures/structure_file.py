"""Campaign files of structures: the building as declared, its instruments, and the files of its tests."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field

from edesign.calibration.structures.building import DampingKind
from edesign.damper.testing.campaign_blocks import LawBlock, Text
from edesign.damper.testing.measured_histories import Use
from edesign.project.document import Document
from edesign.project.notation.quantities import ACCELERATION, LENGTH, TIME, Kind
from edesign.project.notation.unit_patterns import unit_pattern
from edesign.project.notation.units import (
    PositiveLength,
    PositiveMass,
    PositiveRatio,
    PositiveStiffness,
    parse_quantity,
    units_of,
    written,
)
from edesign.project.notation.written import OF_ONE, Inner, Json, Written
from edesign.project.reading.base import Model
from edesign.project.reading.problems import Problems

_DASHPOT = Kind("damping coefficient", "N*s/m", "100 kN*s/m")
Dashpot = Annotated[float, written(_DASHPOT, "not negative")]
Mode = Annotated[int, Field(ge=1)]


def _unit(kind: Kind) -> Written:
    """A unit, which becomes its factor to SI."""

    def schema(_inner: Inner) -> Json:
        said = {"title": f"unit of {kind.name}", "examples": sorted(units_of(kind)), OF_ONE: kind.unit}
        return {"type": "string", "pattern": rf"^\s*(?:{unit_pattern(kind)})\s*$", **said}

    return Written(lambda value: parse_quantity(f"1 {value}", kind), schema)


class DampingBlock(Model):
    """Damping of the building on a fixed base.

    Attributes:
        type: kind of damping: all modes alike, two modes, or proportional to stiffness or mass.
        ratio: ratio of critical damping.
        modes: the two modes of `rayleigh`.
        other: a second kind, which has a share of the damping.
        share: share of the second kind, at most 100 %.
    """

    type: DampingKind
    ratio: PositiveRatio
    modes: Annotated[tuple[Mode, ...], Field(min_length=2, max_length=2)] = (1, 2)
    other: DampingKind | None = None
    share: PositiveRatio | None = None


class StructureBlock(Model):
    """A shear building, from below; storeys of an isolated one are those above its isolation layer.

    Attributes:
        name: name of the structure.
        base: whether the base is fixed, or an isolation layer is below the first floor.
        floor_masses: masses of the floors from below.
        storey_stiffness: stiffnesses of the storeys from below; of an isolated building one less than floors.
        storey_heights: heights of the storeys from below, needed for rocking of the base only.
        storey_dashpots: damping coefficients of dampers of the storeys from below, beside the damping ratio.
        damping: damping of the building on a fixed base.
        refit: whether stiffness and damping are only a first guess; `false` keeps them as they are.
    """

    name: Text = "structure"
    base: Literal["fixed", "isolated"]
    floor_masses: Annotated[tuple[PositiveMass, ...], Field(min_length=1, max_length=60)]
    storey_stiffness: tuple[PositiveStiffness, ...] = ()
    storey_heights: tuple[PositiveLength, ...] | None = None
    storey_dashpots: tuple[Dashpot, ...] | None = None
    damping: DampingBlock | None = None
    refit: bool = True


class UnitsBlock(Model):
    """Units of the columns; SI if not said.

    Attributes:
        time: unit of time.
        acceleration: unit of accelerations.
        displacement: unit of displacements.
    """

    time: Annotated[float, _unit(TIME)] = 1.0
    acceleration: Annotated[float, _unit(ACCELERATION)] = 1.0
    displacement: Annotated[float, _unit(LENGTH)] = 1.0


class ChannelsBlock(Model):
    """Headers of the columns; floors from below, `null` for one without the instrument.

    Attributes:
        time: header of the column of time.
        base_acceleration: header of the acceleration of the base.
        floor_accelerations: headers of absolute accelerations of the floors from below, `null` for a floor without.
        floor_displacements: headers of displacements relative to the base from below, `null` for a floor without.
        units: units of the columns.
    """

    time: Text
    base_acceleration: Text
    floor_accelerations: tuple[Text | None, ...] | None = None
    floor_displacements: tuple[Text | None, ...] | None = None
    units: UnitsBlock


class StructureTestEntry(Model):
    """A test of the structure.

    Attributes:
        file: CSV file, also compressed (.csv.gz), relative to the campaign file.
        title: title for people.
        use: whether models are fitted to the test, or it is only compared.
    """

    file: Text
    title: str = ""
    use: Use = "fit"


class StructureFile(Model):
    """A campaign file of a structure.

    Attributes:
        title: title of the report; without the key the name of the structure.
        document: what the cover of a report says beside the title.
        structure: the building as it is declared.
        law: law of the isolation layer, of an isolated base only.
        channels: the columns of the files.
        tests: tests; two to fit to and one to compare are the least.
    """

    title: str = ""
    document: Document = Document()
    structure: StructureBlock
    law: LawBlock | None = None
    channels: ChannelsBlock
    tests: Annotated[tuple[StructureTestEntry, ...], Field(min_length=1)]


def check_structure(file: StructureFile, problems: Problems) -> None:
    """Check what no key alone can show: numbers of storeys and channels, the law of the isolation layer."""
    block = file.structure
    floors = len(block.floor_masses)
    storeys = floors - 1 if block.base == "isolated" else floors
    for key in ("storey_stiffness", "storey_heights", "storey_dashpots"):
        given = getattr(block, key)
        if given is not None and len(given) != storeys:
            above = " above the isolation layer" if block.base == "isolated" else ""
            problems.at_value(
                ("structure", key), f"{len(given)} values; {floors} floors have {storeys} storeys{above} [E-VALUE-04]"
            )
    if storeys and block.damping is None:
        problems.under(
            ("structure",), "damping", "this key is missing, for example `{type: modal, ratio: 2 %}` [E-KEY-02]"
        )
    _check_damping(block.damping, problems)
    if block.base == "isolated" and file.law is None:
        problems.under((), "law", "an isolated building needs the law of its isolation layer [E-KEY-02]")
    if block.base == "isolated" and file.law is not None and file.law.parameters is None:
        problems.under(("law",), "parameters", "the parameters of the isolation layer are missing [E-KEY-02]")
    if block.base == "fixed" and file.law is not None:
        problems.at_key(
            ("law",), "a building on a fixed base has no isolation layer that could follow a law [E-KEY-03]"
        )
    given = False
    for key in ("floor_accelerations", "floor_displacements"):
        headers = getattr(file.channels, key)
        if headers is not None and len(headers) != floors:
            problems.at_value(
                ("channels", key),
                f"{len(headers)} headers for {floors} floors; write `null` for one without [E-VALUE-04]",
            )
        given = given or any(header is not None for header in headers or ())
    if not given:
        problems.at_key(
            ("channels",), "no floor is measured: `floor_accelerations` or `floor_displacements` is needed [E-KEY-03]"
        )


def _check_damping(damping: DampingBlock | None, problems: Problems) -> None:
    """Check that a second kind of damping is another one, and has a share."""
    if damping is None:
        return
    at = ("structure", "damping")
    if damping.other is None and damping.share is not None:
        problems.at_value((*at, "share"), "a share needs the second kind of damping, the key `other` [E-KEY-02]")
    if damping.other is not None and damping.share is None:
        problems.under(at, "share", "the share of the second kind of damping is missing, for example `30 %` [E-KEY-02]")
    if damping.other == damping.type:
        problems.at_value((*at, "other"), f"the damping is of the kind `{damping.type}` already [E-KEY-03]")
