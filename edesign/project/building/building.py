"""The whole building file."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from functools import cached_property
from itertools import accumulate
from pathlib import Path
from typing import Annotated, Any, ClassVar, Literal, Self

from pydantic import Field, PrivateAttr

from edesign.project.actions.hazard import AnyHazard, EC8Hazard, NtcHazard
from edesign.project.analysis.analyses import BuildingAnalysis
from edesign.project.analysis.damping import Damping
from edesign.project.analysis.integration import Integration
from edesign.project.analysis.outputs import Outputs
from edesign.project.analysis.shaking import ECCENTRICITY
from edesign.project.analysis.validity import Validity
from edesign.project.analysis_file import AnalysisFile, Identifier
from edesign.project.building.design import Design
from edesign.project.building.hinges import BuildingHinges, BuildingJoints, BuildingPanelZones
from edesign.project.building.isolation import Isolation
from edesign.project.building.layout import Layout, Panel
from edesign.project.building.loads import Loads, Masses
from edesign.project.building.members import BeamRun, BraceRun, ColumnRun, Missing
from edesign.project.building.names import ColumnLine, Direction
from edesign.project.building.places import Bays, ColumnLineSelection, panels_in, parse_column_lines, parts_of
from edesign.project.building.steel import Steel
from edesign.project.building.supports import RestrainedFloors, Springs, Support, springs_of
from edesign.project.dampers.dampers import DamperRun, Dampers
from edesign.project.document import Document
from edesign.project.frame import spacing
from edesign.project.frame.elements import Elements
from edesign.project.frame.foundations import Footing, FootingSupport, Soil
from edesign.project.frame.materials import Material
from edesign.project.frame.sections import SpaceFibres, SpaceSection
from edesign.project.notation.axes import GridAxes, LetteredAxis, NumberedAxis
from edesign.project.notation.grid import Grid
from edesign.project.notation.repeated import Repeated
from edesign.project.notation.selections import ALL_NUMBERS, Numbers, NumbersOrNone
from edesign.project.notation.units import PositiveLength
from edesign.project.reading.base import FormatVersion, Model
from edesign.project.reading.one_of import OneOf
from edesign.project.reading.problems import Keys
from edesign.project.records.pairs import BuildingRecord

MOST_BAYS = 100
"""In one direction, so that letters of lines and names of frames (`XA`, `YA`) are distinguished."""
MOST_STOREYS = 200


class EqualBays(spacing.EqualBays):
    """Bays of one width."""

    count: Annotated[int, Field(ge=1, le=MOST_BAYS)]


Widths = Annotated[tuple[PositiveLength, ...], Repeated(EqualBays, most=MOST_BAYS)]
BayWidths = Annotated[Widths | EqualBays, OneOf()]


class EqualStoreys(spacing.EqualStoreys):
    """Storeys of one height."""

    count: Annotated[int, Field(ge=1, le=MOST_STOREYS)]


Heights = Annotated[tuple[PositiveLength, ...], Repeated(EqualStoreys, most=MOST_STOREYS)]


class PlanAxes(Model):
    """Names of the grid lines, as the plans of the office have them.

    Attributes:
        x: names of the lines across x from the left, which begin with a letter; without the key A, B, ...
        y: names of the lines across y from below, which begin with a figure; without the key 1, 2, ...
    """

    x: tuple[LetteredAxis, ...] | None = None
    y: tuple[NumberedAxis, ...] | None = None


class Plan(Model):
    """The grid in plan.

    Attributes:
        x: widths of the bays along x, as a list, or `{count, width}` for equal ones, which may stand in it.
        y: widths of the bays along y, as a list, or `{count, width}` for equal ones, which may stand in it.
        axes: names of the grid lines in members, nodes, selections and drawings; without the key A, B, ... across x
            and 1, 2, ... across y.
    """

    x: BayWidths
    y: BayWidths
    axes: PlanAxes = PlanAxes()


class Setback(Model):
    """Floors that cover some bays of the plan only; a later one overrides an earlier one.

    Attributes:
        floors: floors that cover some bays only.
        bays: bays that these floors cover.
    """

    floors: Numbers
    bays: Bays


class PartialDiaphragm(Model):
    """Floors of which a part alone is rigid in its plane, or several are, each by an entry of its own.

    Attributes:
        floors: floors that are rigid in part.
        bays: bays of one rigid part.
    """

    floors: Numbers
    bays: Bays


class BuildingDampers(Dampers):
    """All dampers of a building, and its isolators; analyses with `dampers: false` leave them out.

    Attributes:
        isolation: isolators under the columns, and the base on them.
    """

    isolation: Isolation | None = None  # type: ignore[assignment]


class Building(spacing.Storeys, AnalysisFile):
    """A building file: a building in three dimensions, what acts on it, what it is designed for, and what is analysed.

    Once validated all values are in SI. Made by `load_building`.

    Attributes:
        edesign_building: version of the file format.
        title: one line for tables and reports.
        document: what the cover of a report says beside the title.
        plan: the grid in plan.
        storeys: heights of the storeys from the bottom, as a list, or `{count, height}` for equal ones, which
            may also stand in the list.
        setbacks: floors that cover some bays of the plan only; a later one overrides an earlier one.
        supports: support of all columns, or a mapping by column line; lines that it does not name take its `default`,
            else `fixed`.
        restrained_floors: floors above the base that the ground holds in plan; of a design the lowest, as a basement.
        soils: soils by name, on which footings stand.
        diaphragms: floors that are rigid in their plane, in each part of them that does not touch another.
        partial_diaphragms: those of these floors of which some bays alone are rigid, in one or more parts.
        columns: runs of columns; a later one overrides an earlier one.
        beams: runs of beams; a later one overrides an earlier one.
        braces: runs of pin-ended braces.
        missing: members that the regular grid has and this building has not.
        materials: steels by name, to which members refer.
        sections: own cross-sections by name; a name of the catalogue cannot be used again.
        fibres: how many fibres a section is cut into in analyses.
        loads: permanent loads G and variable loads Q, downwards.
        masses: masses of the nodes, from the loads or given.
        elements: how members are modelled in analyses: integration points, geometry, rigid ends.
        hinges: plastic hinges lumped at the ends of members, in analyses.
        joints: semi-rigid joints in analyses, as springs between the ends of members and their nodes.
        panel_zones: joints whose panel shears, in analyses.
        dampers: dampers, tuned masses and isolators of the building; its elastic design is without them.
        damping: inherent damping of the building; histories need it.
        integration: time integration; histories need it.
        validity: errors and drifts beyond which a result does not count.
        hazard: the seismic action, without `behaviour_factor`; a design needs that of EN 1998-1.
        records: ground motions by name.
        design: what is checked, and how the seismic action is combined.
        analyses: what is analysed beside the design, in this order; names differ.
        outputs: what is kept in the archive beside the envelopes.
    """

    kind: ClassVar[str] = "building"
    structure: ClassVar[str] = "building"
    grid_key: ClassVar[str] = "plan"
    member_names: ClassVar[str] = "columns are named C_A2_3, beams BX_2_1_5, braces DX_2_1_5_r or _f"

    edesign_building: FormatVersion
    title: Annotated[str, Field(min_length=1)]
    document: Document = Document()
    plan: Plan
    storeys: Annotated[Heights | EqualStoreys, OneOf()]
    setbacks: tuple[Setback, ...] = ()
    supports: Annotated[Literal["fixed", "pinned"] | dict[str, Support], OneOf()] = "fixed"
    restrained_floors: tuple[RestrainedFloors, ...] = ()
    soils: dict[Identifier, Soil] = {}
    diaphragms: NumbersOrNone = ALL_NUMBERS
    partial_diaphragms: tuple[PartialDiaphragm, ...] = ()
    columns: Annotated[tuple[ColumnRun, ...], Field(min_length=1)]
    beams: Annotated[tuple[BeamRun, ...], Field(min_length=1)]
    braces: tuple[BraceRun, ...] = ()
    missing: Missing = Missing()
    materials: dict[Identifier, Steel]
    sections: dict[Identifier, SpaceSection] = {}
    fibres: SpaceFibres = SpaceFibres()
    loads: Loads = Loads()
    masses: Masses | None = None
    elements: Elements = Elements()
    hinges: tuple[BuildingHinges, ...] = ()
    joints: tuple[BuildingJoints, ...] = ()
    panel_zones: tuple[BuildingPanelZones, ...] = ()
    dampers: BuildingDampers | None = None
    damping: Damping | None = None
    integration: Integration | None = None
    validity: Validity = Validity()
    hazard: AnyHazard | None = None
    records: dict[Identifier, BuildingRecord] = {}
    design: Design | None = None
    analyses: tuple[BuildingAnalysis, ...] = ()
    outputs: Outputs = Outputs()

    _path: Path = PrivateAttr(default=Path("building.yaml"))
    _stood: tuple[DamperRun, ...] = PrivateAttr(default=())
    _halves: frozenset[str] | None = PrivateAttr(default=None)

    def model_copy(self, *, update: Mapping[str, Any] | None = None, deep: bool = False) -> Self:
        """Return a copy whose derived values are computed anew.

        Args:
            update: values in place of those of the building, by name.
            deep: whether nested models are copied too.
        """
        found = super().model_copy(update=update, deep=deep)
        for name in ("layout", "storey_heights", "levels"):
            found.__dict__.pop(name, None)
        return found

    @property
    def design_level(self) -> str:
        """The name of the hazard level that the building is designed for; "" without a design."""
        if self.design is None or self.hazard is None:
            return ""
        of_state = self.level_of_limit_state("SLV") if isinstance(self.hazard, NtcHazard) else None
        return self.design.level or of_state or next(iter(self.hazard.levels))

    @property
    def design_hazard(self) -> EC8Hazard | NtcHazard | None:
        """The action by a code that designs are for; None: the file has none, or one of another code."""
        return self.hazard if isinstance(self.hazard, EC8Hazard | NtcHazard) else None

    def level_of_limit_state(self, state: str) -> str | None:
        """Return the first level of the hazard that is of a limit state of NTC 2018; None: there is none."""
        levels = self.hazard.levels if isinstance(self.hazard, NtcHazard) else {}
        return next((name for name, level in levels.items() if level.limit_state == state), None)

    @property
    def rigid_floors(self) -> tuple[int, ...]:
        """The floors that are rigid in plan, whose masses may stand beside their places."""
        return tuple(self.diaphragms.numbers(1, self.n_storeys))

    def rigid_parts(self, floor: int) -> tuple[frozenset[Panel], ...]:
        """Return the bays of each rigid part of a floor; none of one that is not rigid."""
        if floor not in self.rigid_floors:
            return ()
        partial = [part for part in self.partial_diaphragms if floor in part.floors.numbers(1, self.n_storeys)]
        given = tuple(panels_in(part.bays, self.n_bays("x"), self.n_bays("y")) for part in partial)
        return given or parts_of(self.layout.floors[floor])

    @property
    def held_floors(self) -> tuple[int, ...]:
        """The floors above the base that the ground holds in plan."""
        return tuple(floor for held in self.restrained_floors for floor in held.floors.numbers(1, self.n_storeys))

    @property
    def accidental_torsion(self) -> float:
        """Accidental eccentricity of the masses over the length of a floor, of its design or as usual."""
        return ECCENTRICITY if self.design is None else self.design.accidental_torsion

    @cached_property
    def layout(self) -> Layout:
        """The members at each place of the grid."""
        return Layout(self)

    @property
    def isolation(self) -> Isolation | None:
        """The isolated base of the building; None: it stands on its supports."""
        return self.dampers.isolation if self.dampers is not None else None

    @property
    def grid(self) -> Grid:
        """What stands where, by name."""
        return self.layout

    @property
    def steels(self) -> Mapping[str, Material]:
        """The law of each steel in analyses, by its name."""
        return {name: steel.material for name, steel in self.materials.items()}

    @property
    def in_place_of_chevrons(self) -> tuple[DamperRun, ...]:
        """The dampers that stand in place of a chevron's braces, or did so; they meet the middle of the beam above."""
        devices = self.dampers.devices if self.dampers is not None else ()
        return self._stood + tuple(d for d in devices if isinstance(d, DamperRun) and d.kind == "chevron_braces")

    def with_dampers(self, dampers: Dampers | None) -> Self:
        """Return the building with other dampers; those in place of a chevron's braces meet the beams above.

        Without any the beams stay as they are, so that members keep their names.
        """
        found = self.model_copy(update={"dampers": dampers})
        found._stood = self.in_place_of_chevrons if dampers is None else ()
        return found

    def with_halves(self, beams: Collection[str]) -> Self:
        """Return the building whose dampers meet those beams in the middle of which the halves are named."""
        if not beams:
            return self
        found = self.model_copy()
        found._halves = frozenset(beams)
        return found

    @property
    def halves(self) -> frozenset[str] | None:
        """Names among which are the halves of beams that dampers meet; None: the dampers say which beams they meet."""
        return self._halves

    def widths(self, along: Direction | None = None) -> tuple[float, ...]:
        """Return the widths of the bays along x or y, m."""
        assert along is not None, "a building has two directions"
        return spacing.widths(self.plan.x if along == "x" else self.plan.y)

    def n_bays(self, along: Direction) -> int:
        """Return the number of bays along x or y."""
        return len(self.widths(along))

    def n_frames(self, along: Direction) -> int:
        """Return the number of plane frames along x or y."""
        return self.n_bays("y" if along == "x" else "x") + 1

    @property
    def axes(self) -> GridAxes:
        """Names of the grid lines."""
        own = self.plan.axes
        x, y = own.x or (), own.y or ()  # the cross checks tell another number of them
        return GridAxes(x if len(x) == self.n_bays("x") + 1 else (), y if len(y) == self.n_bays("y") + 1 else ())

    def coordinates(self, along: Direction) -> tuple[float, ...]:
        """Return the coordinates of the grid lines, m; the first is at 0."""
        return tuple(accumulate(self.widths(along), initial=0.0))

    def support(self, line: ColumnLine) -> Springs | FootingSupport:
        """Return the support of a column line, by its name, by `default`, or fixed."""
        if not isinstance(self.supports, dict):
            return springs_of(self.supports)
        name = self._support_entry(line)
        return springs_of(self.supports[name] if name else "fixed")

    def _support_entry(self, line: ColumnLine) -> str:
        """The key of `supports` that a column line takes, the last one that names it; "": none of them."""
        names = self.supports if isinstance(self.supports, dict) else {}
        found = "default" if "default" in names else ""
        for name in names:
            if name != "default" and line in parse_column_lines(name):
                found = name
        return found

    def support_keys(self, line: str) -> Keys:
        """Return the entry of `supports` that a column line takes."""
        (of,) = self.lines_of(parse_column_lines(line))
        name = self._support_entry(of)
        return ("supports", name) if name else ("supports",)

    @property
    def footings(self) -> Mapping[str, Footing]:
        """The footings by the lines of columns that stand on them."""
        supports = {str(line): self.support(line) for line in self.layout.node_lines[0]}
        return {line: on.footing for line, on in supports.items() if isinstance(on, FootingSupport)}

    def lines_of(self, chosen: ColumnLineSelection) -> tuple[ColumnLine, ...]:
        """Return the column lines of a selection."""
        return tuple(chosen.lines(self.n_bays("x") + 1, self.n_bays("y") + 1, self.axes))

    def place(self, line: ColumnLine) -> tuple[float, float]:
        """Return the place of a column line in plan, m."""
        return self.coordinates("x")[line.i], self.coordinates("y")[line.j]
