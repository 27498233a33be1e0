"""The variants of a study: what each of them changes of the project."""

from __future__ import annotations

from edesign.project.study.study import Study, Variant
from edesign.report.tables.column import text
from edesign.report.tables.table import Row, Table, TableSpec
from edesign.study.plan.variants import bound_of

VARIANTS = TableSpec[Row](
    "variants",
    "Variants",
    (text("variant"), text("dampers"), text("otherwise than in the project", broken=1)),
    keys=3,
)


def variants_table(study: Study) -> Table:
    """Return the dampers of each variant of a study, and its other changes of the project."""
    return VARIANTS.of(
        (name, _dampers(study, variant), "; ".join(_changes(study, name, variant)) or None)
        for name, variant in study.variants.items()
    )


def _dampers(study: Study, variant: Variant) -> str:
    if variant.dampers == "none":
        return "none"
    if variant.designs:
        return f"of the design{'s' * (len(variant.designs) > 1)} {' and '.join(variant.designs)}"
    dampers = study.base.dampers
    return "none" if dampers is None or dampers.none else "of the project"


def _changes(study: Study, name: str, variant: Variant) -> list[str]:
    found = []
    source = study.derived.get(name)
    if source is not None and source.bound:
        factor, temperature = bound_of(study, name)
        at = f" and a temperature of {temperature:g} °C" if temperature is not None else ""
        found.append(f"{source.bound} bound of {source.of}: forces of the dampers times {factor:g}{at}")
    elif source is not None:
        found.append(f"as {source.of}, with another {source.vary}")
    if variant.temperature is not None:
        found.append(f"dampers at {variant.temperature:g} °C")
    if variant.property_factor is not None:
        found.append(f"forces of the dampers times {variant.property_factor:g}")
    found += [f"{place} is {value}" for place, value in variant.values.items()]
    return found
