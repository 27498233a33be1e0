"""Cross checks of the variants that a study makes of others: other values of the project, bounds of dampers."""

from __future__ import annotations

from typing import Any

from edesign.project.checks.designs import check_factors
from edesign.project.checks.names import check_names
from edesign.project.dampers.designs import Bounds
from edesign.project.reading.problems import FileProblems, Keys, Problems, listed
from edesign.project.reading.values import wrong_place
from edesign.project.study.derived import SHARED, derived_name
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
                _check_value(at, place, value, study, problems)
        if variant.bounds is not None:
            _bounds(keys, variant, variant.bounds, problems)
    for i, item in enumerate(study.vary):
        keys = ("vary", i)
        if item.name in [earlier.name for earlier in study.vary[:i]]:
            problems.at_value((*keys, "name"), f"`{item.name}` comes twice [E-NAME-02]")
        check_names(problems, (*keys, "variants"), "variant", item.variants, of_file)
        known = tuple(name for name in item.variants if name in of_file)
        if message := wrong_place(item.place, study.base, study.base.root):
            problems.at_value((*keys, "place"), f"{study.base.path}: `{item.place}`: {message}")
        elif _may_change((*keys, "place"), item.place, known, study, problems):
            for j, value in enumerate(item.values):
                if not _check_value((*keys, "values", j), item.place, value, study, problems):
                    break
    _taken_names(of_file, study, problems)


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


def _check_value(keys: Keys, place: str, value: Any, study: Study, problems: Problems) -> bool:
    """Whether the project is right with this value there, and has the same members."""
    try:
        changed = study.base.with_values(place, value)
    except FileProblems as error:
        first = error.problems[0]
        said = first.message if first.keys_text == place else str(first)
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
            (("vary", i, "name"), f"{item.name}_{j}")
            for i, item in enumerate(study.vary)
            if name in item.variants
            for j in range(1, len(item.values) + 1)
        ]
        for keys, suffix in made:
            if derived_name(name, suffix) in of_file:
                problems.at_key(
                    keys, f"makes a variant `{derived_name(name, suffix)}`, which there is; rename one [E-NAME-02]"
                )
