"""The frames of a study: the project with the dampers of each variant."""

from __future__ import annotations

from collections.abc import Mapping

from edesign.project.dampers import Dampers
from edesign.project.project import Project
from edesign.project.study import Study, Variant


def variant_project(
    study: Study, name: str, designed: Mapping[str, Dampers], temperature_C: float | None = None
) -> Project:
    """The project that a variant is.

    Args:
        study: the validated study.
        name: of the variant.
        designed: dampers by name of the design.
        temperature_C: of the dampers; None: that of the variant.

    Raises:
        KeyError: the variant's design is not in `designed`.
    """
    variant, base = study.variants[name], study.base
    dampers = designed[variant.design] if variant.design is not None else base.dampers
    if variant.dampers == "none" or dampers is None:
        return base.model_copy(update={"dampers": None})
    return base.model_copy(update={"dampers": with_laws(dampers, variant, temperature_C)})


def with_laws(dampers: Dampers, variant: Variant, temperature_C: float | None = None) -> Dampers:
    """Dampers whose laws are at the temperature of a variant, or at the one given, with its property factor."""
    change: dict[str, float] = {}
    temperature_C = temperature_C if temperature_C is not None else variant.temperature
    if temperature_C is not None:
        change["temperature"] = temperature_C
    laws = {
        key: law.model_copy(
            update={**change, "property_factor": law.property_factor * (variant.property_factor or 1.0)}
        )
        for key, law in dampers.laws.items()
    }
    return dampers.model_copy(update={"laws": laws})
