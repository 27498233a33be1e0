"""The frames of a study: the project with the dampers of each variant."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence

from edesign.errors import InputError
from edesign.project.analysis_file import AnalysisFile
from edesign.project.dampers.dampers import DamperBetween, Dampers, Device
from edesign.project.dampers.designs import Design, ElastomerDesign
from edesign.project.dampers.device_names import laws_of_design
from edesign.project.study.study import Study, Variant
from edesign.study.analysis.dampers import law_warnings
from edesign.study.design.bounds import property_factors
from edesign.study.design.building import with_temperature
from edesign.study.plan.plan import Task


def variant_project(
    study: Study, name: str, designed: Mapping[str, Dampers], temperature_C: float | None = None
) -> AnalysisFile:
    """Return the project of a variant.

    Args:
        designed: dampers by name of the design.
        temperature_C: of the dampers; None: that of the variant.

    Raises:
        KeyError: a design of the variant is not in `designed`.
    """
    variant, base = study.variants[name], study.project_of(name)
    dampers = together(study, variant.designs, designed) if variant.designs else base.dampers
    if variant.dampers == "none" or dampers is None:
        return base.with_dampers(None)
    factor, own_temperature = bound_of(study, name)
    temperature_C = own_temperature if temperature_C is None else temperature_C
    return base.with_dampers(_with_laws(dampers, variant, temperature_C, factor))


def bound_of(study: Study, name: str) -> tuple[float, float | None]:
    """Return factor and temperature of the dampers of a variant that is a bound of another one.

    Returns:
        The factor on the forces, and the temperature in degC; 1 and None for a variant that is no bound.
    """
    source = study.derived.get(name)
    bounds = study.variants[source.of].bounds if source is not None and source.bound else None
    if source is None or bounds is None:
        return 1.0, None
    low, high = property_factors(bounds)
    cold, hot = bounds.temperatures if bounds.temperatures is not None else (None, None)
    return (low, hot) if source.bound == "lower" else (high, cold)


def variant_strain(study: Study, name: str) -> float | None:
    """Return the shear strain at which the dampers of a variant count in its modes; None: that of the devices."""
    designs = study.variants[name].designs
    return _given_strain(study.designs[designs[0]]) if len(designs) == 1 else None


def _given_strain(design: Design) -> float | None:
    """The shear strain that a design gives for the properties of its layers; None: it gives none."""
    return design.strain if isinstance(design, ElastomerDesign) and isinstance(design.strain, float) else None


def together(study: Study, names: Sequence[str], designed: Mapping[str, Dampers]) -> Dampers:
    """Return the dampers of several designs, each with its laws.

    In modes their layers count at the strain of their design.
    """
    first = designed[names[0]]
    if len(names) == 1:
        return first
    laws, devices = dict(first.laws), list[Device]()
    for name in names:
        design, own = study.designs[name], designed[name]
        laws |= {law: own.laws[law] for law in laws_of_design(design)}
        strain = _given_strain(design)
        for device in own.devices:
            if strain is not None and device.layer_thickness is not None:
                device = device.model_copy(update={"design_deformation": strain * device.layer_thickness})
            devices.append(device)
    return first.model_copy(update={"laws": laws, "devices": tuple(devices)})


def variant_warnings(study: Study, tasks: Iterable[Task]) -> list[str]:
    """Return one sentence for each warning about the laws of the variants at their temperatures, before any design.

    Raises:
        InputError: a law has no parameters at a temperature; the message names the variant.
    """
    trial = {name: _unsized(study.base, design) for name, design in study.designs.items()}
    found: list[str] = []
    for name, temperature_C in dict.fromkeys((task.variant, task.temperature_C) for task in tasks):
        project = variant_project(study, name, trial, temperature_C)
        try:
            found += [f"variant {name}: {warning}" for warning in law_warnings(project)]
        except InputError as error:
            raise InputError(f"{study.where('variants', name)}: variants.{name}: {error}") from error
    return list(dict.fromkeys(found))


def _unsized(base: AnalysisFile, design: Design) -> Dampers:
    """The laws of a design at its temperature, of dampers that stand nowhere."""
    names = laws_of_design(design)
    laws = dampers_at_temperature(base, design).laws
    devices = tuple(DamperBetween(kind="nodes", law=name, nodes=("", "")) for name in names)
    return Dampers.model_construct(laws={name: laws[name] for name in names}, devices=devices)


def dampers_at_temperature(project: AnalysisFile, design: Design) -> Dampers:
    """Return the dampers of a project with the laws of a design at the temperature of the design."""
    for law in laws_of_design(design):
        project = with_temperature(project, law, design.temperature)
    assert project.dampers is not None, "check_design wants the law"
    return project.dampers


def _with_laws(dampers: Dampers, variant: Variant, temperature_C: float | None = None, factor: float = 1.0) -> Dampers:
    """Return dampers whose laws have the temperature and the property factor of a variant.

    Args:
        temperature_C: degC; None: that of the variant.
        factor: further factor on the forces.
    """
    change: dict[str, float] = {}
    temperature_C = temperature_C if temperature_C is not None else variant.temperature
    if temperature_C is not None:
        change["temperature"] = temperature_C
    used = dampers.used_laws  # others may not know another temperature
    laws = {
        key: law.model_copy(
            update={**change, "property_factor": law.property_factor * (variant.property_factor or 1.0) * factor}
        )
        if key in used
        else law
        for key, law in dampers.laws.items()
    }
    return dampers.model_copy(update={"laws": laws})
