"""Cross checks of where a criterion looks: what it names stands there, and something does."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence

from edesign.project.analysis_file import AnalysisFile
from edesign.project.criteria.criteria import LimitCriterion, MeasureCriterion, QuantityCriterion
from edesign.project.criteria.criterion_quantities import QUANTITIES
from edesign.project.criteria.measures import MEASURES
from edesign.project.notation.frames import frames_of_line, frames_of_member
from edesign.project.notation.names import member_kind, storey_of
from edesign.project.reading.problems import Keys, Problems, listed

_MEMBERS = {"column": ("column",), "beam": ("beam",), "brace": ("brace",), "member": ("column", "beam")}
_ON_FLOORS = ("floor", "point")
_ON_THE_GROUND = ("support", "isolator")


def check_places(
    keys: Keys,
    criterion: LimitCriterion,
    project: AnalysisFile,
    problems: Problems,
    dampers: Mapping[str, Sequence[str]],
) -> None:
    """Check that each member, damper or column line that a criterion names stands where it looks, and that any does.

    A structure or variant without a single member or damper of the kind is left out: there the criterion does not
    apply, which is reported with its verdict.

    Args:
        criterion: whose names all exist.
    """
    measured = isinstance(criterion, MeasureCriterion)
    place = MEASURES[criterion.subject].place if measured else QUANTITIES[criterion.subject].place
    frames, storeys = criterion.in_space.frames, criterion.storeys
    grid = project.grid

    def in_frames(of: Sequence[str]) -> bool:
        return not frames or not of or any(frame in frames for frame in of)

    if place in _MEMBERS:
        chosen = storeys.numbers(0, grid.n_storeys)  # 0: of beams at an isolated base

        def stands(name: str) -> bool:
            if isinstance(criterion, QuantityCriterion) and not criterion.counts(name, project.dissipative(name)):
                return False
            return storey_of(name) in chosen and in_frames(frames_of_member(name))

        standing = [name for name in grid.members if member_kind(name) in _MEMBERS[place]]
        _check(keys, "members", criterion.members, " or ".join(_MEMBERS[place]), standing, stands, criterion, problems)
    elif place == "damper":
        key = "members" if measured else "dampers"
        standing = [name for variant in criterion.variants or dampers for name in dampers.get(variant, ())]
        names: tuple[str, ...] = getattr(criterion, key)
        _check(
            keys, key, names, "damper", standing, lambda name: in_frames(frames_of_member(name)), criterion, problems
        )
    elif place is not None and place != "frame" and (frames or criterion.in_space.lines):
        floors = (0,) if place in _ON_THE_GROUND else storeys.numbers(1, grid.n_storeys)
        if place in _ON_FLOORS and isinstance(criterion, QuantityCriterion):
            floors = criterion.floors.numbers(1, grid.n_storeys)

        def reaches(line: str) -> bool:
            return in_frames(frames_of_line(line)) and any(
                grid.node_name(line, floor) in grid.nodes for floor in floors
            )

        _check(keys, "at", criterion.in_space.lines, "column line", grid.lines, reaches, criterion, problems)


def _check(
    keys: Keys,
    key: str,
    names: Sequence[str],
    what: str,
    standing: Sequence[str],
    stands: Callable[[str], bool],
    criterion: LimitCriterion,
    problems: Problems,
) -> None:
    """Report names of which none stands where the criterion looks, and places in which nothing does."""
    given = {
        "storeys": "" if criterion.storeys.is_all else f"storeys {criterion.storeys}",
        "floors": f"floors {getattr(criterion, 'floors', '')}" if "floors" in criterion.model_fields_set else "",
        "of": "what `of` chooses" if getattr(criterion, "of", "all") != "all" else "",
        "frames": f"frames {', '.join(criterion.in_space.frames)}" if criterion.in_space.frames else "",
    }
    where = f"in {' of '.join(text for text in given.values() if text)}" if any(given.values()) else "at the base"
    for i, name in enumerate(names):
        if not stands(name):
            problems.at_item((*keys, key), i, f"`{name}` does not stand {where} [E-CRIT-06]")
    if not names and standing and not any(stands(name) for name in standing):
        last = [name for name, text in given.items() if text][-1]
        problems.at_key((*keys, last), f"no {what} stands {where}; there are {listed(standing, 4)} [E-CRIT-06]")
