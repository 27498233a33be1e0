"""Rigid floors and masses of a building, which stand beside their places in some analyses."""

from __future__ import annotations

from edesign.exchange.opensees.commands import Block, Command, Name
from edesign.exchange.opensees.joined import JoinedDegrees
from edesign.exchange.opensees.space_builder import SpaceBuilder
from edesign.exchange.opensees.structure import Structure, Tags
from edesign.exchange.recorded_model import RecordedModel
from edesign.project.analysis.analyses import HistoryAnalysis, PlannedAnalysis
from edesign.project.analysis_file import AnalysisFile
from edesign.study.analysis.structure import build


class FloorBlocks:
    """Blocks of commands by the eccentricity of the masses.

    Args:
        project: a building; of a plane frame there are none.

    Attributes:
        blocks: those that were asked for.
    """

    def __init__(self, project: AnalysisFile) -> None:
        self._project = project
        self._names: dict[tuple[float, float], Name] = {}
        self.blocks: list[Block] = []

    def of(self, spec: PlannedAnalysis | None = None) -> tuple[Name, ...]:
        """Return the name of the block of an analysis; without one that of masses in their places."""
        if len(next(iter(self._project.grid.nodes.values()))) == 2:
            return ()
        key = 0.0, 0.0
        if isinstance(spec, HistoryAnalysis):
            key = spec.eccentricity_with(self._project.accidental_torsion)
        if key not in self._names:
            number = f"_{len(self._names)}" if self._names else ""
            self._names[key] = Name(f"build_floors{number}")
            shares = ", ".join(f"{share:+g} along {axis}" for share, axis in zip(key, "xy", strict=True) if share)
            beside = f", which stand beside their places by shares of the length: {shares}" if shares else ""
            self.blocks.append(Block(self._names[key].name, f"Rigid floors and masses{beside}.", self._commands(key)))
        return (self._names[key],)

    def _commands(self, eccentricity: tuple[float, float]) -> tuple[Command, ...]:
        model = RecordedModel(3)
        frame = build(self._project, eccentricity, model=model)
        structure = Structure(frame, JoinedDegrees(model.calls, model.degrees), Tags(0, 0, 0, 0))
        SpaceBuilder(frame, model, structure).build(call for call in model.calls if call.name in ("node", "mass"))
        return structure.floor_commands()
