"""The whole project."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from functools import cached_property
from pathlib import Path
from typing import Annotated, ClassVar, Self

from pydantic import Field, PrivateAttr, model_validator

from edesign.project.actions.hazard import AnyHazard
from edesign.project.actions.loads import Loads
from edesign.project.actions.masses import Masses
from edesign.project.analysis.analyses import Analysis
from edesign.project.analysis.damping import Damping
from edesign.project.analysis.integration import Integration
from edesign.project.analysis.outputs import Outputs
from edesign.project.analysis.validity import Validity
from edesign.project.analysis_file import AnalysisFile, Identifier
from edesign.project.dampers.dampers import DamperRun, Dampers
from edesign.project.dampers.isolation import Isolation
from edesign.project.document import Document
from edesign.project.frame.elements import Elements
from edesign.project.frame.foundations import Footing, Soil
from edesign.project.frame.frame import Frame
from edesign.project.frame.hinges import Hinges, Joints, PanelZones
from edesign.project.frame.materials import Material
from edesign.project.frame.member_design import FrameDesign
from edesign.project.frame.sections import Fibres, Section
from edesign.project.notation import names
from edesign.project.notation.frames import Direction
from edesign.project.notation.grid import Grid
from edesign.project.reading.base import FormatVersion
from edesign.project.reading.problems import Keys
from edesign.project.records.records import Record


class Project(AnalysisFile):
    """A project file: a plane frame, what acts on it, what is analysed, and what is kept.

    Once validated all values are in SI. Made by `load_project`, which also keeps the text and its marks.

    Attributes:
        edesign: version of the file format.
        title: one line for tables and reports.
        document: what the cover of a report says beside the title.
        frame: the plane frame: its grid, supports and members.
        sections: own cross-sections by name; a name of the catalogue cannot be used again.
        fibres: how many fibres an I section is cut into.
        materials: steels by name, to which members refer.
        loads: permanent loads G and variable loads Q, positive downwards.
        masses: masses of the nodes, given or taken from the loads; all analyses but `gravity` need them.
        elements: how members are modelled: integration points, geometry, rigid ends.
        hinges: plastic hinges lumped at the ends of members.
        joints: semi-rigid joints, as springs between the ends of members and their nodes.
        panel_zones: joints whose panel shears.
        soils: soils by name, on which footings stand.
        design: what checks of columns, beams and braces by EN 1993-1-1 go by; without it sections alone are checked.
        dampers: dampers, tuned masses and isolators of the frame.
        damping: inherent damping of the frame; histories need it.
        integration: time integration; histories need it.
        validity: errors and drifts beyond which a result does not count.
        hazard: the seismic action at the site and its levels.
        records: ground motions by name.
        analyses: what is analysed, in this order; names differ.
        outputs: what is kept in the archive beside the envelopes.
    """

    kind: ClassVar[str] = "project"
    structure: ClassVar[str] = "frame"
    grid_key: ClassVar[str] = "frame"
    member_names: ClassVar[str] = "columns are named C_line_storey, beams B_bay_floor, braces D_bay_storey_r or _f"

    edesign: FormatVersion
    title: Annotated[str, Field(min_length=1)]
    document: Document = Document()
    frame: Frame
    sections: dict[Identifier, Section] = {}
    fibres: Fibres = Fibres()
    materials: dict[Identifier, Material]
    loads: Loads = Loads()
    masses: Masses | None = None
    elements: Elements = Elements()
    hinges: tuple[Hinges, ...] = ()
    joints: tuple[Joints, ...] = ()
    panel_zones: tuple[PanelZones, ...] = ()
    soils: dict[Identifier, Soil] = {}
    design: FrameDesign | None = None
    dampers: Dampers | None = None
    damping: Damping | None = None
    integration: Integration | None = None
    validity: Validity = Validity()
    hazard: AnyHazard | None = None
    records: dict[Identifier, Record] = {}
    analyses: Annotated[tuple[Analysis, ...], Field(min_length=1)]
    outputs: Outputs = Outputs()

    _path: Path = PrivateAttr(default=Path("project.yaml"))

    @model_validator(mode="after")
    def _meet_beams(self) -> Self:
        """Dampers in place of a chevron's braces meet the middle of the beam above."""
        self.frame.meet_by_dampers(self._beams_met(self.dampers))
        return self

    def _beams_met(self, dampers: Dampers | None) -> list[tuple[int, int]]:
        grid = self.frame
        return [
            (bay, storey)
            for run in (dampers.devices if dampers is not None else ())
            if isinstance(run, DamperRun) and run.kind == "chevron_braces"
            for storey in run.storeys.numbers(1, grid.n_storeys)
            for bay in run.bays.numbers(1, grid.n_bays)
        ]

    def dissipative(self, member: str) -> bool:
        """Return whether `design` says that a beam or brace is meant to yield; halves of a beam are what it is."""
        return not self.dissipative_members.isdisjoint((member, member.rpartition("_")[0]))

    @cached_property
    def dissipative_members(self) -> frozenset[str]:
        """Names of the beams and braces that are meant to yield; halves of a beam are one here."""
        if self.design is None:
            return frozenset()
        frame, of = self.frame, self.design.dissipative
        places = {place for chosen in of.beams for place in frame.standing_beams(chosen)}
        braces = [name for name in frame.members if of.braces == "all" and names.member_kind(name) == "brace"]
        return frozenset([*(frame.beam_name(*place) for place in places), *braces])

    def widths(self, along: Direction | None = None) -> tuple[float, ...]:
        """Return the widths of the bays from the left, m; the frame has no other direction."""
        return self.frame.bay_widths

    def with_dampers(self, dampers: Dampers | None) -> Self:
        """Return the project with other dampers; those in place of a chevron's braces meet the beams above.

        Without any the beams stay as they are, so that members keep their names.
        """
        if dampers is None:
            return self.model_copy(update={"dampers": None})
        frame = self.frame.met_by_dampers(self._beams_met(dampers))
        return self.model_copy(update={"dampers": dampers, "frame": frame})

    def with_halves(self, beams: Collection[str]) -> Self:
        """Return the project whose dampers meet those beams in the middle of which the halves are named."""
        if not beams:
            return self
        found, grid = frozenset(beams), self.frame
        met = [place for place in grid.beam_at if f"{grid.beam_name(*place)}_1" in found]
        return self.model_copy(update={"frame": grid.met_by_dampers(met)})

    @property
    def footings(self) -> Mapping[str, Footing]:
        """The footings by the lines of columns that stand on them."""
        return self.frame.footings

    def support_keys(self, line: str) -> Keys:
        """Return the place of the support that a line of columns takes."""
        named = self.frame.supports if isinstance(self.frame.supports, dict) else ()
        return ("frame", "supports", line if line in named else "default")

    @property
    def isolation(self) -> Isolation | None:
        """The isolated base of the frame; None: it stands on its supports."""
        return self.dampers.isolation if self.dampers is not None else None

    @property
    def grid(self) -> Grid:
        """What stands where, by name."""
        return self.frame

    @property
    def steels(self) -> Mapping[str, Material]:
        """The law of each material, by name."""
        return self.materials
