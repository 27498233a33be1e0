"""Cross checks of a design: its law, places, levels and records exist, and its keys go together."""

from __future__ import annotations

from collections.abc import Callable

from edesign.project.analysis_file import AnalysisFile
from edesign.project.checks.analyses import check_drift
from edesign.project.checks.dampers import check_beams_met, check_brace
from edesign.project.checks.hysteretic_designs import check_hysteretic_design
from edesign.project.checks.placement import (
    check_bays_of_frame,
    check_design_hazard,
    check_placement_design,
)
from edesign.project.checks.selections import Selections
from edesign.project.dampers.dampers import BraceSection
from edesign.project.dampers.designs import (
    HYSTERETIC_LAWS,
    VISCOUS_LAWS,
    Bounds,
    Design,
    DesignedBrace,
    DesignRun,
    DriftAmplitude,
    ElastomerDesign,
    FixedProperties,
    HystereticDesign,
    SimplifiedDesign,
    SizedDesign,
    StrainEnergyDesign,
    ViscousDesign,
)
from edesign.project.dampers.device_names import names_of_run
from edesign.project.dampers.placement import PlacementDesign
from edesign.project.project import Project
from edesign.project.reading.problems import Keys, Problems, listed, unknown_name
from edesign.project.reading.words import counted

_RECOMMENDED_ALPHA = (10.0, 30.0)
_TYPES = {"viscous": VISCOUS_LAWS, "hysteretic": HYSTERETIC_LAWS}
"""Types of laws that a method can size; the other methods size layers."""
_LEAST = {"least_area": ("area", "`area` or `thickness`"), "least_coefficient": ("coefficients", "`coefficient`")}
"""What distributions that meet a drift sum up, and what rounds of histories may change in them."""
_FIXED = "fixed properties do not change with temperature; give a table or `law` [E-DESIGN-03]"
_UNCHANGED = {
    "viscous": "a viscous law changes with its coefficient alone; give factors that hold for the temperatures"
    " [E-DESIGN-03]",
    "hysteretic": "a hysteretic law changes with its force alone; give factors that hold for the temperatures"
    " [E-DESIGN-03]",
}
"""Why a method has no bounds by temperature."""


def check_design(
    keys: Keys,
    spec: Design,
    project: AnalysisFile,
    problems: Problems,
    stand: Callable[[], object] | None = None,
    stands: Callable[[Keys, DesignRun], object] | None = None,
) -> None:
    """Check a design of a study file.

    Args:
        keys: of the design in the study file, e.g. ("designs", "thesis").
        spec: without schema problems.
        project: that is studied.
        problems: of the study file; collects what is wrong.
        stand: checks the candidates of a placement in a building; None: they are in a plane frame.
        stands: checks the places of dampers of a kind in a building; None: they are in a plane frame.
    """
    if project.isolation is not None:
        message = (
            f"{project.path} has an isolated base; a design sizes dampers of a {project.structure} on its supports: "
            "design for a copy without `dampers.isolation`, or compare sizes as `variants` by histories [E-DESIGN-07]"
        )
        problems.at_key(keys, message)
    if project.masses is None:
        problems.at_key(
            keys, "the project has no `masses`: its frame has no periods to design dampers for [E-MODAL-02]"
        )
    if isinstance(spec, PlacementDesign):
        check_placement_design(
            keys, spec, project, problems, stand or (lambda: check_bays_of_frame(keys, spec, project, problems))
        )
        return
    _law(keys, spec, project, problems)
    _places(keys, spec, project, problems, stands)
    check_design_hazard(keys, spec, project, problems)
    _braces((*keys, "brace"), spec, project, problems)
    _of_storeys(keys, spec, project, problems)
    amplitude = getattr(spec, "amplitude", None)
    if isinstance(amplitude, DriftAmplitude):
        check_drift(project, problems, (*keys, "amplitude", "drift"), amplitude.drift)
    if spec.bounds is not None:
        _bounds((*keys, "bounds"), spec, spec.bounds, problems)
    if isinstance(spec, ViscousDesign):
        _viscous(keys, spec, problems)
    elif isinstance(spec, HystereticDesign):
        check_hysteretic_design(keys, spec, project, problems)
    else:
        _elastomer(keys, spec, problems)


def design_warnings(spec: Design) -> list[str]:
    """Return one sentence for each unusual value of a design."""
    low, high = _RECOMMENDED_ALPHA
    if isinstance(spec, SimplifiedDesign) and not low <= spec.alpha <= high:
        return [f"alpha = {spec.alpha:g} is outside the recommended {low:g} to {high:g} (thesis 5.3.4)"]
    return []


def _places(
    keys: Keys,
    spec: SizedDesign,
    project: AnalysisFile,
    problems: Problems,
    stands: Callable[[Keys, DesignRun], object] | None,
) -> None:
    """A design has a `kind` in its `bays`, or `places` of several kinds; they exist, and none comes twice."""
    for key, what in (("kind", "how the dampers stand"), ("bays", "the bays that get dampers")):
        if spec.places and getattr(spec, key) is not None:
            problems.at_key((*keys, key), f"`places` says this for each kind; leave `{key}` out [E-KEY-03]")
            return
        if not spec.places and getattr(spec, key) is None:
            problems.under(keys, key, f"this key is missing: {what}; or give `places` of several kinds [E-KEY-02]")
            return
    taken: dict[str, int] = {}
    for i, run in enumerate(spec.runs):
        where = (*keys, "places", i) if spec.places else keys
        if stands is not None:
            stands(where, run)
        else:
            _in_frame(where, run, project, problems)
        own = names_of_run(project.grid, run)
        if twice := [name for name in own if name in taken]:
            message = f"`{twice[0]}` stands there by places[{taken[twice[0]]}] already [E-NAME-02]"
            problems.at_value(where, message)
        taken |= dict.fromkeys(own, i)


def _in_frame(keys: Keys, run: DesignRun, project: AnalysisFile, problems: Problems) -> None:
    """Dampers stand in bays of the plane frame."""
    assert isinstance(project, Project)
    for key in ("along", "frames"):
        if getattr(run, key) is not None:
            problems.at_key((*keys, key), "a plane frame has one direction; this is of a building [E-KEY-03]")
    check = Selections(project.frame, problems)
    if check.bays(keys, run.bays) and check.storeys(keys, run.storeys):
        check_beams_met((*keys, "kind"), run, project, problems)


def _law(keys: Keys, spec: SizedDesign, project: AnalysisFile, problems: Problems) -> None:
    laws = project.dampers.laws if project.dampers is not None else {}
    law, keys = laws.get(spec.law), (*keys, "law")
    if law is None:
        problems.at_value(keys, unknown_name("damper law", spec.law, laws))
        return
    types = _TYPES.get(spec.method)
    if types is None:
        if law.prototype is None and law.file is None:
            message = (
                f"the law `{spec.law}` of the project has no `prototype`: it has no layers that could be sized"
                " [E-DESIGN-03]"
            )
            problems.at_value(keys, message)
        return
    if law.prototype is not None:
        message = (
            f"the law `{spec.law}` of the project has a `prototype`; {spec.method} dampers have no layers [E-DESIGN-03]"
        )
        problems.at_value(keys, message)
    if law.file is None and law.type is not None and law.type not in types:  # those of law files are known later
        message = (
            f"the law `{spec.law}` is of type `{law.type}`; {spec.method} dampers are of type {listed(types)}"
            " [E-DESIGN-03]"
        )
        problems.at_value(keys, message)


def _least(keys: Keys, spec: StrainEnergyDesign | ViscousDesign, problems: Problems) -> bool:
    """Check a design that meets a drift with the least sum of the dampers; return whether it is one."""
    if spec.distribution not in _LEAST:
        return False
    summed, changes = _LEAST[spec.distribution]
    _needed(keys, spec, f"`distribution: {spec.distribution}` needs it", problems)
    for key in ("target_in", "damping"):
        if key in spec.model_fields_set:
            message = (
                f"`distribution: {spec.distribution}` meets a drift with the least {summed}, whatever the damping"
                " [E-DESIGN-06]"
            )
            problems.at_key((*keys, key), message)
    if spec.verify is not None and spec.verify.change == "target":
        message = f"this distribution has no target damping to change; choose {changes} [E-DESIGN-06]"
        problems.at_value((*keys, "verify", "change"), message)
    return True


def _needed(keys: Keys, spec: SizedDesign, why: str, problems: Problems) -> None:
    """Check that a design that meets a drift in the estimate has it, and the level of the estimate."""
    for key in ("level", "drift"):
        if getattr(spec, key) is None and not (key == "level" and _has_level(spec)):
            problems.under(keys, key, f"this key is missing; {why} [E-KEY-02]")


def _viscous(keys: Keys, spec: ViscousDesign, problems: Problems) -> None:
    if spec.amplitude == "spectrum" and spec.level is None:
        problems.under(
            keys, "level", "this key is missing; `amplitude: spectrum` needs the spectrum of a hazard level [E-KEY-02]"
        )
    if _least(keys, spec, problems):
        return
    if spec.damping is None:
        problems.under(
            keys, "damping", "this key is missing: the damping ratio that the dampers add, such as `15 %` [E-KEY-02]"
        )
    if spec.drift is not None:
        message = (
            "a drift has no part in the sizing for a damping; meet one by `verify`, or by `least_coefficient`"
            " [E-DESIGN-06]"
        )
        problems.at_key((*keys, "drift"), message)


def _elastomer(keys: Keys, spec: ElastomerDesign, problems: Problems) -> None:
    _thickness(keys, spec, problems)
    if isinstance(spec, StrainEnergyDesign):
        _strain_energy(keys, spec, problems)
    else:
        _simplified(keys, spec, problems)
    if isinstance(spec.strain, str):
        _followed_strain(keys, spec, problems)
    if isinstance(spec.frequency, tuple) and spec.frequency[0] > spec.frequency[1]:
        problems.at_value((*keys, "frequency"), "the band runs backwards; write the lower frequency first [E-VALUE-04]")


def _braces(keys: Keys, spec: SizedDesign, project: AnalysisFile, problems: Problems) -> None:
    """Braces of sections stand along a length, one in each storey, and are held to the forces of a level."""
    brace = getattr(spec, "brace", None)
    if not isinstance(brace, (BraceSection, DesignedBrace)):
        return
    for kind in dict.fromkeys(run.kind for run in spec.runs):
        check_brace(project, problems, keys, brace, kind)
    if not _has_level(spec):
        message = "this key is missing; the forces that braces hold are those of a hazard level [E-KEY-02]"
        problems.under(keys[:-1], "level", message)
    if isinstance(brace, DesignedBrace):
        if brace.level is not None and brace.level not in project.hazard_levels:
            problems.at_value((*keys, "level"), unknown_name("level", brace.level, project.hazard_levels))
        if isinstance(spec, SimplifiedDesign) and brace.ratio is not None:
            problems.at_key((*keys, "ratio"), "`alpha` says how stiff they are at least; keep one of them [E-KEY-03]")
        return
    storeys = len({storey for run in spec.runs for storey in run.storeys.numbers(1, project.grid.n_storeys)})
    if len(brace.sections) not in (1, storeys):
        message = f"{counted(len(brace.sections), 'value')} for {counted(storeys, 'storey')}; one for each is needed"
        problems.at_value((*keys, "section"), f"{message} [E-VALUE-04]")


def _has_level(spec: SizedDesign) -> bool:
    """Whether a design has a hazard level: of layers it is that of `verify` where none is named."""
    verified = isinstance(spec, ElastomerDesign) and spec.verify is not None and bool(spec.verify.levels)
    return spec.level is not None or verified


def _followed_strain(keys: Keys, spec: ElastomerDesign, problems: Problems) -> None:
    if not _has_level(spec):
        message = f"this key is missing; `strain: {spec.strain}` begins with the spectrum of a hazard level [E-KEY-02]"
        problems.under(keys, "level", message)
    if spec.strain == "histories" and spec.verify is None:
        problems.at_value(
            (*keys, "strain"), "there are no histories without `verify`; give it, or take `spectrum` [E-KEY-03]"
        )
    if isinstance(spec.properties, FixedProperties):
        message = "fixed properties do not change with the strain; give the strain, or a table or `law` [E-DESIGN-03]"
        problems.at_value((*keys, "strain"), message)


def _of_storeys(keys: Keys, spec: SizedDesign, project: AnalysisFile, problems: Problems) -> None:
    for key in ("storey_stiffness", "shear"):
        given = getattr(spec, key, None)
        if isinstance(given, tuple) and len(given) != project.grid.n_storeys:
            message = (
                f"{len(given)} values for a {project.structure} of {project.grid.n_storeys} storeys; one for each is "
                "needed [E-VALUE-04]"
            )
            problems.at_value((*keys, key), message)


def _thickness(keys: Keys, spec: ElastomerDesign, problems: Problems) -> None:
    if spec.layer_thickness is None and (spec.drift is None or spec.strain_limit is None):
        problems.under(keys, "layer_thickness", "this key is missing (or both `drift` and `strain_limit`) [E-KEY-02]")
    if spec.layer_thickness is not None and spec.strain_limit is not None:
        message = "`layer_thickness` is given; a thickness from drift and strain limit needs it left out [E-KEY-03]"
        problems.at_key((*keys, "strain_limit"), message)


def _strain_energy(keys: Keys, spec: StrainEnergyDesign, problems: Problems) -> None:
    if _least(keys, spec, problems):
        return
    if spec.damping is None:
        problems.under(
            keys, "damping", "this key is missing: the damping ratio that the dampers add, such as `10 %` [E-KEY-02]"
        )
    if spec.target_in == "storeys" and spec.distribution != "storey_stiffness":
        message = "Eq. 5.9 storey by storey belongs to `distribution: storey_stiffness` alone [E-DESIGN-06]"
        problems.at_value((*keys, "target_in"), message)
    if spec.braces_in_target and spec.brace == "rigid":
        problems.at_value((*keys, "braces_in_target"), "the braces are rigid; give `brace: {ratio: ...}` [E-DAMPER-02]")


def _simplified(keys: Keys, spec: SimplifiedDesign, problems: Problems) -> None:
    _needed(keys, spec, "the simplified method needs it", problems)
    if spec.beta[0] > spec.beta[1]:
        problems.at_value((*keys, "beta"), "the range runs backwards; write the lower value first [E-VALUE-04]")
    if spec.low_temperature is not None:
        if isinstance(spec.properties, FixedProperties):
            problems.at_key((*keys, "low_temperature"), _FIXED)
        if spec.temperature is None:
            problems.under(keys, "temperature", "this key is missing; a low end needs a design temperature [E-KEY-02]")
        elif spec.low_temperature > spec.temperature:
            problems.at_value((*keys, "low_temperature"), "it is above the design `temperature` [E-VALUE-04]")


def _bounds(keys: Keys, spec: SizedDesign, bounds: Bounds, problems: Problems) -> None:
    if not _has_level(spec):
        problems.under(keys[:-1], "level", "this key is missing; bounds are compared at a hazard level [E-KEY-02]")
    fixed = _FIXED if isinstance(getattr(spec, "properties", None), FixedProperties) else None
    message = _UNCHANGED.get(spec.method, fixed)
    if bounds.temperatures is not None and message is not None:
        problems.at_key((*keys, "temperatures"), message)
    check_factors(keys, bounds, problems)


def check_factors(keys: Keys, bounds: Bounds, problems: Problems) -> None:
    """Check factors and temperatures of bounds against each other."""
    for side in ("upper", "lower"):
        if getattr(bounds, side) is not None and getattr(bounds, f"{side}_factors") is not None:
            problems.at_key((*keys, f"{side}_factors"), f"`{side}` is given; keep one of them [E-KEY-03]")
    for side, wrong in (("upper", lambda value: value < 1.0), ("lower", lambda value: value > 1.0)):
        values: dict[Keys, float | None] = {(side,): getattr(bounds, side)}
        factors = getattr(bounds, f"{side}_factors")
        if factors is not None:
            values |= {(f"{side}_factors", name): getattr(factors, name) for name in type(factors).model_fields}
        for at, value in values.items():
            if value is not None and wrong(value):
                allowed = "at least" if side == "upper" else "at most"
                problems.at_value(
                    (*keys, *at), f"a factor of the {side} bound must be {allowed} 1, not {value:g} [E-VALUE-02]"
                )
    if bounds.temperatures is not None and bounds.temperatures[0] > bounds.temperatures[1]:
        problems.at_value(
            (*keys, "temperatures"), "the range runs backwards; write the lower temperature first [E-VALUE-04]"
        )
