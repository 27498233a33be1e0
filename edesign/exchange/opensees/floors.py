"""Rigid floors and masses of a building, which stand beside their places in some analyses."""

from __future__ import annotations

from collections.abc import Sequence

from edesign.exchange.opensees.commands import Block, Command, Name
from edesign.exchange.opensees.joined import JoinedDegrees
from edesign.exchange.opensees.space_builder import SpaceBuilder
from edesign.exchange.opensees.structure import Structure, Tags
from edesign.exchange.recorded_model import Call, RecordedModel
from edesign.project.analysis.analyses import HistoryAnalysis, PlannedAnalysis
from edesign.project.analysis_file import AnalysisFile
from edesign.study.analysis.structure import make_frame

LOADS = ("pattern", "nodal_load", "uniform_load", "point_load", "partial_load")


class FloorBlocks:
    """Blocks of commands by the eccentricity of the masses.

    Args:
        project: a building; of a plane frame there are none.
        isolated: whether it stands on its isolators.

    Attributes:
        blocks: those that were asked for.
    """

    def __init__(self, project: AnalysisFile, isolated: bool) -> None:
        self._project, self._isolated = project, isolated
        self._names: dict[tuple[tuple[float, float], bool], Name] = {}
        self.blocks: list[Block] = []

    def of(self, spec: PlannedAnalysis | None = None) -> tuple[Name, ...]:
        """Return the name of the block of an analysis; without one that of masses in their places."""
        if len(next(iter(self._project.grid.nodes.values()))) == 2:
            return ()
        eccentricity = 0.0, 0.0
        if isinstance(spec, HistoryAnalysis):
            eccentricity = spec.eccentricity_with(self._project.accidental_torsion)
        dampers = self._project.dampers
        key = eccentricity, spec is not None and spec.dampers and dampers is not None and bool(dampers.attachments)
        if key not in self._names:
            number = f"_{len(self._names)}" if self._names else ""
            self._names[key] = Name(f"build_floors{number}")
            shares = ", ".join(
                f"{share:+g} along {axis}" for share, axis in zip(eccentricity, "xy", strict=True) if share
            )
            beside = f", which stand beside their places by shares of the length: {shares}" if shares else ""
            self.blocks.append(Block(self._names[key].name, f"Rigid floors and masses{beside}.", self._commands(*key)))
        return (self._names[key],)

    def _commands(self, eccentricity: tuple[float, float], tuned: bool) -> tuple[Command, ...]:
        model, project = RecordedModel(3), self._project
        frame = make_frame(project, tuned or self._isolated, eccentricity=eccentricity, model=model)
        calls = model.calls[: first_of_dampers(model.calls)]
        structure = Structure(frame, JoinedDegrees(model.calls, model.degrees), Tags(0, 0, 0, 0))
        SpaceBuilder(frame, model, structure).build(call for call in calls if call.name in ("node", "mass"))
        return structure.floor_commands()


def first_of_dampers(calls: Sequence[Call]) -> int:
    """Return where the calls of dampers and tuned masses begin, which come after the gravity loads."""
    return 1 + max((at for at, call in enumerate(calls) if call.name in LOADS), default=-1)
