"""Cross checks of a placement: places, laws and levels exist, items differ, and limits leave something to choose."""

from __future__ import annotations

import math
from collections.abc import Callable

from edesign.project.analysis_file import AnalysisFile
from edesign.project.checks.dampers import check_brace, check_size
from edesign.project.checks.names import check_names, check_records
from edesign.project.checks.selections import GridSelections, Selections
from edesign.project.dampers.designs import Design
from edesign.project.dampers.placement import CandidateBays, PlacementDesign
from edesign.project.project import Project
from edesign.project.reading.problems import Keys, Problems, unknown_name


def check_placement_design(
    keys: Keys, spec: PlacementDesign, project: AnalysisFile, problems: Problems, stand: Callable[[], object]
) -> None:
    """Check a placement of a study file.

    Args:
        keys: of the design in the study file, e.g. ("designs", "placed").
        spec: without schema problems.
        project: that is studied.
        problems: of the study file; collects what is wrong.
        stand: checks that it has the candidate places; what it returns is true if it has.
    """
    check_design_hazard(keys, spec, project, problems)
    _catalogue((*keys, "catalogue"), spec, project, problems)
    if stand():
        _limits((*keys, "limits"), spec, project, problems)


def check_bays_of_frame(keys: Keys, spec: PlacementDesign, project: AnalysisFile, problems: Problems) -> bool:
    """Check that a plane frame has the candidate places of a placement, and return whether it has."""
    assert isinstance(project, Project)
    if spec.places:
        message = "a plane frame has one direction; give `bays`, this is of a building [E-KEY-03]"
        problems.at_key((*keys, "places"), message)
    if spec.bays is None:
        problems.under(keys, "bays", "this key is missing: the candidate bays [E-KEY-02]")
        return False
    check = Selections(project.frame, problems)
    bays = check.bays(keys, spec.bays)
    return check.storeys(keys, spec.storeys) and bays and not spec.places


def check_design_hazard(keys: Keys, spec: Design, project: AnalysisFile, problems: Problems) -> None:
    """Check that the project has the levels and records of a design."""
    levels = project.hazard_levels
    if spec.level is not None and spec.level not in levels:
        problems.at_value((*keys, "level"), unknown_name("level", spec.level, levels))
    if spec.verify is not None:
        check_names(problems, (*keys, "verify", "levels"), "level", spec.verify.levels or (), levels)
        check_records(problems, (*keys, "verify", "records"), spec.verify.records, project)


def placement_warnings(spec: PlacementDesign, project: AnalysisFile) -> list[str]:
    """Return one sentence for each value of a placement that may not be meant.

    Args:
        project: that is studied.
    """
    found: dict[str, None] = {}
    for run in spec.candidates if spec.limits.mirrored else ():
        widths = project.widths(run.along)
        pairs = [(bay, len(widths) + 1 - bay) for bay in range(1, len(widths) // 2 + 1)]
        uneven = [(a, b) for a, b in pairs if not math.isclose(widths[a - 1], widths[b - 1])]
        if uneven:
            a, b = uneven[0]
            of = f" along {run.along}" if run.along else ""
            text = f"bay {a}{of} is {widths[a - 1]:.6g} m wide and bay {b} {widths[b - 1]:.6g} m"
            counted = "`mirrored` equips bays alike counted from both ends"
            found[f"{counted}, but the {project.structure} is not symmetric: {text}"] = None
    return list(found)


def _catalogue(keys: Keys, spec: PlacementDesign, project: AnalysisFile, problems: Problems) -> None:
    laws = project.dampers.laws if project.dampers is not None else {}
    same: dict[object, str] = {}
    for name, item in spec.catalogue.items():
        where = (*keys, name)
        if item.law not in laws:
            problems.at_value((*where, "law"), unknown_name("damper law", item.law, laws))
        else:
            check_size(problems, where, item, laws)
        brace = item.brace
        for key in ("stiffness", "section", "force"):
            if isinstance(getattr(brace, key, None), tuple):
                message = f"an item may stand in any place; give one {key}, and others in items of their own"
                problems.at_value((*where, "brace", key), f"{message} [E-VALUE-01]")
        check_brace(project, problems, (*where, "brace"), brace, item.kind or spec.kind or "")
        # what is left changes the force: neither the cost nor the amplitude at which it counts in natural modes does
        alike = {"cost": 1.0, "design_deformation": None, "kind": item.kind or spec.kind, "scale": item.scale or 1.0}
        content = item.model_copy(update=alike).model_dump_json()
        if content in same:
            problems.at_key(where, f"the dampers are those of `{same[content]}`; one of them is enough [E-NAME-02]")
        same.setdefault(content, name)


def _limits(keys: Keys, spec: PlacementDesign, project: AnalysisFile, problems: Problems) -> None:
    limits, last = spec.limits, project.grid.n_storeys
    storeys = sorted({storey for run in spec.candidates for storey in run.storeys.numbers(1, last)})
    for run in spec.candidates if limits.mirrored else ():
        _mirrored((*keys, "mirrored"), spec, run, len(project.widths(run.along)), problems)
    fewest = min(item.number for item in spec.catalogue.values())
    if limits.most_dampers is not None and limits.most_dampers < fewest:
        message = f"{limits.most_dampers} are fewer than one place takes, {fewest} [E-VALUE-02]"
        problems.at_value((*keys, "most_dampers"), message)
    check = GridSelections(problems, last, project.structure)
    taken: set[int] = set()
    for i, group in enumerate(limits.storey_groups):
        where = (*keys, "storey_groups", i)
        if not check.numbers(where, group, "storey", last):
            continue
        numbers = group.numbers(1, last)
        outside = [storey for storey in numbers if storey not in storeys]
        if outside:
            problems.at_value(where, f"storey {outside[0]} is no candidate [E-NAME-01]")
        twice = sorted(taken & set(numbers))
        if twice:
            problems.at_value(where, f"storey {twice[0]} is in two groups [E-NAME-02]")
        taken |= set(numbers)
        between = [storey for storey in storeys if numbers[0] < storey < numbers[-1] and storey not in numbers]
        if limits.continuous and between:
            message = f"with `continuous` a group has no gap, and storey {between[0]} is between [E-PLACE-03]"
            problems.at_value(where, message)


def _mirrored(keys: Keys, spec: PlacementDesign, run: CandidateBays, last: int, problems: Problems) -> None:
    """Bays have mirror images among the candidates, and diagonals a bay beside the middle one."""
    bays = run.bays.numbers(1, last)
    alone = [bay for bay in bays if last + 1 - bay not in bays]
    of = f" along {run.along}" if run.along else ""
    if alone:
        message = (
            f"bay {alone[0]}{of} has its mirror image in bay {last + 1 - alone[0]}, which is no candidate [E-NAME-01]"
        )
        problems.at_value(keys, message)
    elif all(2 * bay == last + 1 for bay in bays) and all(
        (item.kind or spec.kind) in ("rising", "falling") for item in spec.catalogue.values()
    ):
        problems.at_value(keys, f"a diagonal in the middle bay{of} has no mirror image of its own [E-PLACE-03]")
