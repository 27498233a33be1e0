"""Small frames with a catalogue of dampers, every layout of which can be analysed, and a sequential search on them."""

from __future__ import annotations

import itertools
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from edesign.archive.dataset import Group
from edesign.frame.project_file import load_project
from edesign.project.analysis.analyses import BuildingHistory, HistoryAnalysis
from edesign.project.analysis_file import AnalysisFile
from edesign.project.dampers.dampers import BraceStiffness, DamperRun, Dampers
from edesign.project.notation.frames import parse_frames
from edesign.project.notation.grid import BayPlace
from edesign.project.notation.selections import NumberSelection
from edesign.project.project import Project
from edesign.study.analysis.history import run_history

Equipped = tuple[tuple[BayPlace, int], ...]
"""Place and number of the item (from 1) of each equipped place, in order."""
RECORDS = ("first", "second")
STEP = 0.02  # s

_FRAME = """\
edesign: 1
title: Small frame for a placement
frame:
  bays: @bays@
  storeys: @storeys@
  diaphragms: all
  columns: [{storeys: all, section: HEB220, material: S275}]
  beams: [{floors: all, section: IPE330, material: S275}]
materials:
  S275: {law: bilinear, E: 210 GPa, fy: 275 MPa, hardening: 1 %}
loads:
  beams: [{floors: all, G: 24 kN/m, Q: 10 kN/m}]
masses: {from_loads: {}, directions: horizontal}
hazard:
  code: ec8-2004
  a_gR: 0.3 g
  ground: B
  spectrum: 1
  levels: {DBE: {probability: 10 %}}
dampers:
  laws:
    oil: {type: viscous_power, parameters: {c: 1 kN*(s/m)^0.35, alpha: 0.35}}
    linear: {type: viscous, parameters: {c: 1 kN*s/m}}
    slip: {type: friction, parameters: {mu: 0.3, N: 1 kN, k: 1 kN/mm}}
    rubber:
      type: mgmm
      parameters: thesis_table_4_2
      prototype: {layers: 2, layer_area: 41400 mm^2, layer_thickness: 12 mm}
damping: {kind: modal, ratio: 3 %, modes: 2}
integration: {method: newmark, time_step: 0.02 s}
records:
  first: {file: first.csv, acceleration_unit: m/s^2}
  second: {file: second.csv, acceleration_unit: m/s^2}
analyses: [{name: modes, kind: modal, modes: 2}]
"""


def project_text(bays: str, storeys: str) -> str:
    """The project file of a frame."""
    return _FRAME.replace("@bays@", bays).replace("@storeys@", storeys)


def small_project(folder: Path, bays: str, storeys: str) -> Project:
    """Write a frame with its motions, and load it."""
    for i, name in enumerate(RECORDS):
        (folder / f"{name}.csv").write_text(motion_text(i), encoding="utf-8")
    (folder / "project.yaml").write_text(project_text(bays, storeys), encoding="utf-8")
    return load_project(folder / "project.yaml")


def motion_text(number: int) -> str:
    """Five seconds of three sines that swell and fade, different for each number."""
    t = STEP * np.arange(251)
    waves = sum(np.sin(2.0 * np.pi * f * t + number * f) for f in (0.9 + 0.1 * number, 2.3, 4.1))
    lines = [f"{x:.4f},{y:.8f}" for x, y in zip(t, 1.8 * waves * np.sin(np.pi * t / t[-1]) ** 2, strict=True)]
    return "\n".join(["time_s,acceleration_m_s2", *lines, ""])


@dataclass(frozen=True)
class Item:
    """An item of a catalogue: keys of a device with their values, N and m."""

    law: str
    cost: float
    scale: float | None = None
    layer_area: float | None = None
    brace: float = 6e7

    @property
    def text(self) -> str:
        """As a study file has it."""
        size = f"scale: {self.scale}" if self.scale is not None else f"layer_area: {self.layer_area} m^2"
        return f"{{law: {self.law}, {size}, cost: {self.cost}, brace: {{stiffness: {self.brace} N/m}}}}"


class EveryLayout:
    """The drifts of layouts by histories that this class runs itself, each once.

    Args:
        project: the frame or building.
        items: of the catalogue.
        kind: of the dampers.
        records: of the project that act.
    """

    def __init__(
        self,
        project: AnalysisFile,
        items: Sequence[Item],
        kind: str = "chevron",
        records: Sequence[str] = RECORDS,
    ) -> None:
        self.project, self.items, self.kind, self.records = project, items, kind, records
        self._known: dict[Equipped, Mapping[str, Group]] = {}

    def histories(self, equipped: Equipped) -> Mapping[str, Group]:
        """Histories of a layout by record."""
        if equipped not in self._known:
            devices = tuple(self._device(place, self.items[option - 1]) for place, option in equipped)
            before = self.project.dampers
            assert before is not None
            project = self.project.model_copy(update={"dampers": before.model_copy(update={"devices": devices})})
            found = {}
            for record in self.records:
                of = BuildingHistory if self.project.structure == "building" else HistoryAnalysis
                spec = of.model_construct(kind="history", name=record, record=record)
                found[record] = run_history(project, spec)
                found[record].attributes |= {"kind": "history", "variant": "tried", "level": "DBE"}
            self._known[equipped] = found
        return self._known[equipped]

    def drift(self, equipped: Equipped) -> float:
        """Largest storey drift, mean of the records."""
        return float(np.mean([storey_drifts(group).max() for group in self.histories(equipped).values()]))

    def cost(self, equipped: Equipped, place: float = 0.0) -> float:
        """What a layout costs; `place` for each that is equipped."""
        return round(sum(self.items[option - 1].cost + place for _, option in equipped), 6)

    def layouts(self, places: Sequence[BayPlace]) -> Iterator[Equipped]:
        """All layouts of some places."""
        for options in itertools.product(range(len(self.items) + 1), repeat=len(places)):
            yield tuple((place, option) for place, option in zip(places, options, strict=True) if option)

    def respond(self, wanted: Sequence[tuple[int, Dampers]]) -> Iterator[Mapping[str, Group]]:
        """Histories of dampers as a search asks for them."""
        for _, dampers in wanted:
            yield self.histories(self.equipped(dampers))

    def equipped(self, dampers: Dampers) -> Equipped:
        """The layout that devices of a search stand for."""
        found = {}
        for run in dampers.devices:
            assert isinstance(run, DamperRun) and run.kind == self.kind
            (option,) = (
                i
                for i, item in enumerate(self.items, start=1)
                if (item.law, item.scale, item.layer_area) == (run.law, run.scale, run.layer_area)
            )
            for place in self.project.grid.bay_places(run):
                found[place] = option
        return tuple(sorted(found.items()))

    def _device(self, place: BayPlace, item: Item) -> DamperRun:
        frames = parse_frames(place.frame) if place.frame else None
        return DamperRun.model_construct(
            kind=self.kind,
            along=frames.items[0].along if frames else None,
            frames=frames,
            bays=NumberSelection(((place.bay, place.bay),)),
            storeys=NumberSelection(((place.storey, place.storey),)),
            law=item.law,
            scale=item.scale,
            layer_area=item.layer_area,
            brace=BraceStiffness.model_construct(stiffness=item.brace),
        )


def storey_drifts(group: Group) -> np.ndarray:
    """Largest drift ratio of each storey, (storeys,), of a building by direction."""
    return np.max(np.abs([group.variables[f"storey_drift_{side}"].values for side in ("max", "min")]), axis=0)


def sequential_search(every: EveryLayout, places: Sequence[BayPlace], option: int, limit: float) -> Equipped | None:
    """The simplified sequential search algorithm: equal dampers one by one, each in the storey that drifts most.

    The location index is the largest drift of a storey, mean of the records; of a storey's places the first free one
    is taken. None: all places of the worst storey are taken.

    Source: D. Lopez Garcia (2001), A simple method for the design of optimal damper configurations in MDOF structures,
        Earthquake Spectra 17(3), 387-398.
    """
    equipped: Equipped = ()
    while every.drift(equipped) > limit:
        drifts = np.mean([storey_drifts(group) for group in every.histories(equipped).values()], axis=0)
        taken = {place for place, _ in equipped}
        storey = int(np.argmax(drifts)) + 1
        free = [place for place in places if place.storey == storey and place not in taken]
        if not free:
            return None
        equipped = tuple(sorted((*equipped, (free[0], option))))
    return equipped
