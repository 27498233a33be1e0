"""What a script can run, and which blocks build its model, as data."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field

from edesign.exchange.opensees.commands import Block, Command, Name, Value
from edesign.exchange.opensees.floors import FloorBlocks
from edesign.project.analysis.analyses import PlannedAnalysis


@dataclass
class Programme:
    """What a script can run.

    Attributes:
        analyses: by name, what each needs, in the order of the plan.
        blocks: lateral loads and motions.
        files: texts of records by their names.
        damping: inherent damping; empty: none.
        left_out: sentences on what is not in it.
    """

    analyses: dict[str, dict[str, Value]] = field(default_factory=dict)
    blocks: list[Block] = field(default_factory=list)
    files: dict[str, str] = field(default_factory=dict)
    damping: dict[str, Value] = field(default_factory=dict)
    left_out: list[str] = field(default_factory=list)

    def block_name(self, kind: str, analysis: str) -> str:
        """Return a name for a block of an analysis that no other one has."""
        name = re.sub(r"\W", "_", f"{kind}_{analysis}")
        while name in {block.name for block in self.blocks}:
            name += "_"
        return name


@dataclass(frozen=True)
class Parts:
    """Which blocks build the model.

    Attributes:
        plain, with_dampers: of analyses without dampers, and what is added with them; the first is `build`.
        isolators: what an isolated building stands on; without it, there are none.
        floors: of rigid floors and masses of a building.
        soil, at_rest, moving: set in under the gravity loads: soil dashpots in histories; of dampers what resists at
            rest, and in histories what resists speed.
        springs: makes the commands of linear springs in the place of dampers, from their stiffness by name; None: the
            script has no dampers.
        tuned: whether it has tuned masses, with modes of their own.
        base, base_of_dampers: by direction tags of nodes whose reactions are the base shear; of those that dampers add.
        equations: independent degrees of freedom without and with dampers.
        up: degree of the core along the vertical.
    """

    plain: tuple[Name, ...]
    with_dampers: tuple[Name, ...]
    isolators: tuple[Name, ...]
    floors: FloorBlocks
    soil: tuple[Name, ...]
    at_rest: tuple[Name, ...]
    moving: tuple[Name, ...]
    springs: Callable[[Mapping[str, float]], list[Command]] | None
    tuned: bool
    base: tuple[tuple[int, ...], ...]
    base_of_dampers: tuple[tuple[int, ...], ...]
    equations: tuple[int, int]
    up: int

    def bases(self, spec: PlannedAnalysis) -> Value:
        """Tags of the nodes whose reactions are the base shear of an analysis, in space by direction."""
        both = zip(self.base, self.base_of_dampers, strict=True)
        found = tuple((*own, *(more if spec.dampers else ())) for own, more in both)
        return found if len(found) > 1 else found[0]

    def model(self, spec: PlannedAnalysis, isolators: tuple[Name, ...] | None = None) -> tuple[Name, ...]:
        """Blocks that build the model of an analysis, with others in the place of isolators where these are given."""
        added = (*self.with_dampers, *(self.isolators if isolators is None else isolators)) if spec.dampers else ()
        return (*self.plain, *self.floors.of(spec), *added)

    def alone(self, spec: PlannedAnalysis) -> tuple[Name, ...]:
        """Blocks that build it without dampers and tuned masses."""
        return (*self.plain, *self.floors.of(spec.model_copy(update={"dampers": False})))

    def set_in(self, spec: PlannedAnalysis, moves: bool) -> tuple[Name, ...]:
        """Blocks that add what is set in under the gravity loads."""
        found = (*self.at_rest, *(self.moving if moves else ())) if spec.dampers else ()
        return (*(self.soil if moves else ()), *found)
