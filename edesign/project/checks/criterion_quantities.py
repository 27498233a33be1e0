"""Cross checks of criteria on archived quantities: places that they have, and histories that are kept for them."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence

from edesign.project.analysis.outputs import HistoryKind
from edesign.project.analysis_file import AnalysisFile
from edesign.project.checks.names import check_names
from edesign.project.checks.selections import GridSelections, Selections
from edesign.project.criteria.criteria import QuantityCriterion
from edesign.project.criteria.criterion_quantities import QUANTITIES, keys_of
from edesign.project.notation.names import member_kind
from edesign.project.project import Project
from edesign.project.reading.problems import Keys, Problems, did_you_mean, listed

_CHOOSING = ("floors", "storeys", "members", "of", "dampers", "lines", "side", "frequency", "damping", "term")


def check_quantity(
    keys: Keys,
    criterion: QuantityCriterion,
    project: AnalysisFile,
    problems: Problems,
    kept: Collection[HistoryKind] | None,
    dampers: Mapping[str, Sequence[str]],
) -> None:
    """Check the places of a quantity, and that the archive will have its values.

    Args:
        criterion: as read; it has no schema problems.
        project: whose structure it means.
        kept: histories that the study keeps of every record; None: not known.
        dampers: names of the dampers of each variant.
    """
    name = criterion.quantity
    plane, quantity = project.structure == "frame", QUANTITIES[name]
    own = keys_of(name, not plane)
    if plane and quantity.of_buildings:
        problems.at_value((*keys, "quantity"), f"`{name}` is of buildings; a plane frame has none [E-CRIT-04]")
        return
    if quantity.of_designs and getattr(project, "design", None) is None:
        why = f"lengths and factors of `design`, which {project.path.name} does not have"
        problems.at_value((*keys, "quantity"), f"`{name}` is computed with {why} [E-CRIT-05]")
    for key in _CHOOSING:
        if key in criterion.model_fields_set and key not in own:
            problems.at_key((*keys, key), f"`{name}` has no `{key}`; {_allowed(own, project)} [E-CRIT-04]")
    for key in quantity.own:
        if getattr(criterion, key) is None:
            problems.under(keys, key, f"this key is missing; `{name}` is not known without it [E-KEY-02]")
    if quantity.kept is not None and kept is not None and quantity.kept not in kept:
        message = (
            f"`{name}` is computed from the histories of {quantity.kept}, which are not kept; "
            f"add `{quantity.kept}` to `outputs: histories` [E-CRIT-05]"
        )
        problems.at_value((*keys, "quantity"), message)
    if "floors" in own:
        GridSelections(problems, project.grid.n_storeys, project.structure).floors(keys, criterion.floors)
    if "lines" in own and isinstance(project, Project):
        Selections(project.frame, problems).lines((*keys, "lines"), criterion.lines)
    if "members" in own:
        what = "column or beam" if quantity.place == "member" else quantity.place
        check_members((*keys, "members"), criterion.members, project, what, problems)
    if "of" in own and quantity.place == "brace" and criterion.of in ("columns", "beams"):
        problems.at_value((*keys, "of"), f"`{name}` is of braces: `all` or `not_dissipative` goes here [E-CRIT-04]")
    if "dampers" in own and criterion.dampers:
        chosen = criterion.variants or tuple(dampers)
        known = dict.fromkeys(damper for variant in chosen for damper in dampers.get(variant, ()))
        if known:
            check_names(problems, (*keys, "dampers"), "damper", criterion.dampers, known)


def _allowed(own: Sequence[str], project: AnalysisFile) -> str:
    return f"allowed here: {listed(own)}" if own else f"it is one of the whole {project.structure}"


def check_members(keys: Keys, given: Sequence[str], project: AnalysisFile, what: str, problems: Problems) -> None:
    """Check that members are of a kind and stand in a frame or building, each given once.

    Where no such member stands, the criterion does not apply, which is reported with its verdict.

    Args:
        what: kind of the members: `column`, `beam`, `brace`, or `column or beam`.
    """
    allowed = [name for name in project.grid.members if member_kind(name) in what.split(" or ")]
    if not allowed:
        return
    for i, name in enumerate(given):
        if name not in allowed:
            hint = did_you_mean(name, allowed)
            named = f"they are named `{allowed[0]}` to `{allowed[-1]}`"
            where = f"in this {project.structure}{hint} ({named})"
            problems.at_item(keys, i, f"there is no {what} `{name}` {where} [E-NAME-01]")
        elif name in given[:i]:
            problems.at_item(keys, i, f"`{name}` comes twice [E-NAME-02]")
