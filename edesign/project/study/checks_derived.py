"""Cross checks of the variants that a study makes of others: other values of the project, bounds of dampers."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from edesign.project.checks.designs import check_factors
from edesign.project.checks.names import check_names
from edesign.project.dampers.designs import Bounds
from edesign.project.reading.problems import FileProblems, Keys, Problems, listed
from edesign.project.reading.values import wrong_place
from edesign.project.study.derived import SHARED, Vary, derived_name
from edesign.project.study.study import Study, Variant


def check_derived(study: Study, problems: Problems) -> None:
    """Check `values` and `bounds` of the variants, and `vary`, after variants and designs.

    Args:
        study: the study, which has no schema problems.
    """
    of_file = [name for name in study.variants if name not in study.derived]
    for name in of_file:
        variant = study.variants[name]
        keys: Keys = ("variants", name)
        for place, value in variant.values.items():
            at: Keys = (*keys, "values", place)
            if message := wrong_place(place, study.base, study.base.root):
                problems.at_key(at, f"{study.base.path}: {message}")
            elif _may_change(at, place, (name,), study, problems):
                _check_values(at, {place: value}, study, problems)
        if variant.bounds is not None:
            _bounds(keys, variant, variant.bounds, problems)
    for i, item in enumerate(study.vary):
        keys = ("vary", i)
        if item.name in [earlier.name for earlier in study.vary[:i]]:
            problems.at_value((*keys, "name"), f"`{item.name}` comes twice [E-NAME-02]")
        check_names(problems, (*keys, "variants"), "variant", item.variants, of_file)
        known = tuple(name for name in item.variants if name in of_file)
        _check_vary(keys, item, known, study, problems)
    _taken_names(of_file, study, problems)


def _check_vary(keys: Keys, item: Vary, known: tuple[str, ...], study: Study, problems: Problems) -> None:
    """Check the places of a variation, and the project with each of its combinations."""
    if (item.place is None) == (not item.grid):
        problems.at_key(keys, "give either `place` with `values`, or a `grid` of several places [E-KEY-03]")
        return
    if (item.place is None) != (not item.values):
        problems.at_key(keys, "`place` and `values` belong together; a `grid` has places with their values [E-KEY-03]")
        return
    good = True
    for place in item.places:
        at: Keys = (*keys, "place") if item.place is not None else (*keys, "grid", place)
        if message := wrong_place(place, study.base, study.base.root):
            problems.at_value(at, f"{study.base.path}: `{place}`: {message}")
            good = False
        else:
            good = _may_change(at, place, known, study, problems) and good
    for _, below, values in item.points if good else ():
        if not _check_values((*keys, *below), values, study, problems):
            break


def _may_change(keys: Keys, place: str, variants: tuple[str, ...], study: Study, problems: Problems) -> bool:
    """Whether the variants may differ from the project there."""
    first = place.replace("[", ".").partition(".")[0]
    if first in SHARED:
        problems.at_value(
            keys,
            f"`{first}` is the same for all variants of a study; choose another part of the project [E-VARIANT-01]",
        )
        return False
    for name in variants if first == "dampers" else ():
        variant = study.variants[name]
        if variant.design is not None:
            message = f"the dampers of the variant `{name}` are those of a design: {listed(variant.designs)}"
            problems.at_value(keys, f"{message} [E-VARIANT-01]")
            return False
        if variant.dampers == "none":
            problems.at_value(keys, f"the variant `{name}` has no dampers [E-DAMPER-04]")
            return False
    return True


def _check_values(keys: Keys, values: Mapping[str, Any], study: Study, problems: Problems) -> bool:
    """Whether the project is right with these values at their places, and has the same members."""
    try:
        changed = study.base.with_values(dict(values.items()))
    except FileProblems as error:
        first = error.problems[0]
        place = first.keys_text if first.keys_text in values else next(iter(values))
        said = first.message if first.keys_text == place else str(first)
        if keys[-1] == "grid":
            keys = (*keys, place, study.vary[int(keys[1])].grid[place].index(values[place]))
        problems.at_value(keys, f"{study.base.path}: {place}: {said}")
        return False
    mine, other = changed.grid, study.base.grid
    if set(mine.members) != set(other.members) or mine.n_storeys != other.n_storeys:
        problems.at_value(
            keys, "this adds or removes members or storeys; variants of a study have the same ones [E-VARIANT-01]"
        )
        return False
    return True


def _bounds(keys: Keys, variant: Variant, bounds: Bounds, problems: Problems) -> None:
    at: Keys = (*keys, "bounds")
    if variant.dampers == "none":
        problems.at_key(at, "this variant has no dampers [E-DAMPER-04]")
    if not bounds.model_fields_set:
        problems.at_key(at, f"nothing is given; allowed: {listed(Bounds.model_fields)} [E-KEY-02]")
    check_factors(at, bounds, problems)


def _taken_names(of_file: list[str], study: Study, problems: Problems) -> None:
    """Names of derived variants that the file gives to others."""
    for name in of_file:
        variant = study.variants[name]
        made: list[tuple[Keys, str]] = [
            (("variants", name, "bounds"), side) for side in ("lower", "upper") if variant.bounds is not None
        ]
        made += [
            (("vary", i, "name"), suffix)
            for i, item in enumerate(study.vary)
            if name in item.variants and item.name not in [earlier.name for earlier in study.vary[:i]]
            for suffix, _, _ in item.points
        ]
        taken = list(of_file)
        for keys, suffix in made:
            if derived_name(name, suffix) in taken:
                problems.at_key(
                    keys, f"makes a variant `{derived_name(name, suffix)}`, which there is; rename one [E-NAME-02]"
                )
            taken.append(derived_name(name, suffix))
