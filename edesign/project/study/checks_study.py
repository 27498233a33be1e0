"""Cross checks of a study: names that exist, in the file itself and in the project that it studies."""

from __future__ import annotations

from collections.abc import Sequence
from typing import get_args

from edesign.project.analysis.pushover import BuildingDirections, FrameDirections, Pushovers
from edesign.project.analysis.shaking import Eccentric
from edesign.project.building.building import Building
from edesign.project.building.checks.analyses import check_positions
from edesign.project.building.checks.dampers import check_bays
from edesign.project.building.checks.placement import check_candidates
from edesign.project.checks.analyses import check_drift
from edesign.project.checks.criteria import check_criteria
from edesign.project.checks.designs import check_design
from edesign.project.checks.isolation import NO_PUSHOVER, NO_WAVE_PASSAGE
from edesign.project.checks.matching import check_fitted_levels
from edesign.project.checks.names import ALL, check_names, check_records
from edesign.project.checks.outputs import check_member
from edesign.project.checks.pushover import check_pushover
from edesign.project.checks.shaking import check_shaking
from edesign.project.checks.vertical_motion import check_horizontal, check_vertical
from edesign.project.checks.wave_passage import check_wave_passage
from edesign.project.criteria.criteria import QuantityCriterion
from edesign.project.dampers.designs import Design
from edesign.project.dampers.device_names import laws_of_design, names_of_dampers, names_of_design
from edesign.project.dampers.placement import PlacementDesign
from edesign.project.dampers.verification import AnyVerify, PlacementVerify
from edesign.project.frame.sections import ElasticSection, RectangleSection, SpaceElasticSection
from edesign.project.project import Project
from edesign.project.reading.problems import Keys, Problems, listed, unknown_name
from edesign.project.records.records import record_of
from edesign.project.study.checks_derived import check_derived
from edesign.project.study.checks_incremental import check_incremental
from edesign.project.study.study import Histories, Study, Variant

_USES = ("section_use", "member_use", "brace_use")
_WITHOUT_CLASS = (RectangleSection, ElasticSection, SpaceElasticSection)
"""Own sections that EN 1993-1-1 does not classify."""


def check_study(study: Study, problems: Problems) -> None:
    """Check a study against its project; `study` has no schema problems.

    Args:
        study: the study, which has no schema problems.
    """
    base = study.base
    for name, design in study.designs.items():
        _design(study, problems, ("designs", name), design)
        if design.verify is not None:
            _verify(study, problems, ("designs", name, "verify"), design.verify)
    for name, variant in study.variants.items():
        if name not in study.derived:
            _variant(study, problems, ("variants", name), variant)
    check_derived(study, problems)
    for i, histories in enumerate(study.histories):
        _histories(study, problems, ("histories", i), histories)
    for i, incremental in enumerate(study.incremental):
        check_incremental(("incremental", i), incremental, base, tuple(study.variants), problems)
    for i, pushovers in enumerate(study.pushovers):
        _pushovers(study, problems, ("pushovers", i), pushovers)
    _own_names(study, problems)
    check_criteria(
        (),
        study.criteria,
        study.objectives,
        base,
        tuple(study.variants),
        problems,
        study.outputs.histories,
        {name: _dampers(study, variant) for name, variant in study.variants.items()},
    )
    _with_class(study, problems)
    _outputs(study, problems)
    for what, items in (("histories", study.histories or study.incremental), ("pushovers", study.pushovers)):
        if items and base.masses is None:
            problems.at_key(("project",), f"{what} need `masses`, and {base.path} has none [E-MODAL-02]")
    for key in ("damping", "integration"):
        if (study.histories or study.incremental) and getattr(base, key) is None:
            problems.at_key(("project",), f"histories need `{key}`, and {base.path} has none [E-KEY-02]")


def _design(study: Study, problems: Problems, keys: Keys, design: Design) -> None:
    base = study.base
    if not isinstance(base, Building):
        check_design(keys, design, base, problems)
    elif isinstance(design, PlacementDesign):
        check_design(keys, design, base, problems, lambda: check_candidates(base, problems, keys, design))
    else:
        check_design(keys, design, base, problems, stands=lambda at, run: check_bays(base, problems, at, run))
    _beside(study, problems, keys, design)


def _beside(study: Study, problems: Problems, keys: Keys, design: Design) -> None:
    """A design stands beside designs above it, whose dampers are known when it is sized, on places of its own."""
    keys = (*keys, "beside")
    order = list(study.designs)
    above = order[: order.index(str(keys[1]))]
    for i, name in enumerate(design.beside):
        if name not in study.designs:
            problems.at_item(keys, i, unknown_name("design", name, above))
            return
        if name not in above:
            message = f"`{name}` stands below; designs are sized in the order of the file, so put it above [E-NAME-03]"
            problems.at_item(keys, i, message)
            return
        if isinstance(study.designs[name], PlacementDesign):
            message = f"`{name}` is a placement, whose dampers have no stiffness at one amplitude; size beside others"
            problems.at_item(keys, i, f"{message} [E-DESIGN-03]")
            return
    if design.beside:
        _together(study, problems, keys, (*study.beside(str(keys[1])), str(keys[1])))


def _variant(study: Study, problems: Problems, keys: Keys, variant: Variant) -> None:
    if keys[-1] == ALL:
        problems.at_key(keys, f"`{ALL}` stands for all variants; choose another name [E-NAME-03]")
    if (variant.dampers is None) == (variant.design is None):
        problems.at_key(keys, "give either `dampers` (`none` or `project`) or a `design`, one of them [E-KEY-03]")
        return
    if variant.design is not None:
        check_names(problems, (*keys, "design"), "design", variant.design, study.designs)
        _all_beside(study, problems, (*keys, "design"), variant.design)
        _together(study, problems, (*keys, "design"), variant.design)
    dampers = study.base.dampers
    if variant.dampers == "project" and (dampers is None or dampers.none):
        message = f"{study.base.path} has no devices, no attachments and no isolation under `dampers` [E-DAMPER-04]"
        problems.at_value((*keys, "dampers"), message)
    if variant.dampers == "none":
        for key in ("temperature", "property_factor"):
            if getattr(variant, key) is not None:
                problems.at_key((*keys, key), "this variant has no dampers [E-DAMPER-04]")


def _all_beside(study: Study, problems: Problems, keys: Keys, names: Sequence[str]) -> None:
    """A variant has the designs beside which its own are sized."""
    for i, name in enumerate(names):
        absent = [other for other in study.beside(name) if other not in names] if name in study.designs else []
        if absent:
            message = f"`{name}` is sized beside `{absent[0]}`, which the variant lacks; write `design: "
            whole = [other for other in study.designs if other in {*names, *absent}]
            problems.at_item(keys, i, f"{message}[{', '.join(whole)}]` [E-VARIANT-02]")
            return


def _together(study: Study, problems: Problems, keys: Keys, names: Sequence[str]) -> None:
    """Several designs take no place twice, and give a law one temperature, and layers one strain in modes."""
    designs = {name: study.designs[name] for name in names if name in study.designs}
    places: dict[str, str] = {}
    temperatures: dict[str, tuple[str, float | None]] = {}
    for i, name in enumerate(names):
        if name in names[:i]:
            problems.at_item(keys, i, f"`{name}` comes twice [E-NAME-02]")
            return
        if name not in designs:
            return
        own = names_of_design(study.base.grid, designs[name])
        if taken := [damper for damper in own if damper in places]:
            message = f"`{name}` places dampers where `{places[taken[0]]}` does: {listed(taken, 4)} [E-VARIANT-02]"
            problems.at_item(keys, i, message)
            return
        places |= dict.fromkeys(own, name)
        for law in laws_of_design(designs[name]):
            other, temperature = temperatures.setdefault(law, (name, designs[name].temperature))
            if temperature != designs[name].temperature:
                message = (
                    f"`{name}` and `{other}` have the law `{law}` at different temperatures; give each of them a law "
                    "of its own [E-VARIANT-02]"
                )
                problems.at_item(keys, i, message)
                return


def _dampers(study: Study, variant: Variant) -> tuple[str, ...]:
    """Names of the dampers of a variant."""
    if variant.design is not None:
        designs = [study.designs[name] for name in variant.design if name in study.designs]
        return tuple(name for design in designs for name in names_of_design(study.base.grid, design))
    return names_of_dampers(study.base.grid, study.base.dampers) if variant.dampers == "project" else ()


def _histories(study: Study, problems: Problems, keys: Keys, histories: Histories) -> None:
    base = study.base
    if histories.variants != (ALL,):
        check_names(problems, (*keys, "variants"), "variant", histories.variants, study.variants)
    check_records(problems, (*keys, "records"), histories.records, base)
    check_drift(base, problems, (*keys, "collapse_drift"), histories.collapse_drift)
    check_horizontal(base, problems, (*keys, "records"), histories.records)
    levels = histories.levels or ()
    check_vertical(base, problems, (*keys, "vertical"), histories.vertical, histories.records, levels)
    check_wave_passage(base, problems, (*keys, "wave_passage"), histories.wave_passage)
    check_shaking(base, problems, keys, histories)
    isolated = [name for name in study.variants_of(histories) if study.variants[name].dampers == "project"]
    if histories.wave_passage is not None and base.isolation is not None and isolated:
        problems.at_key((*keys, "wave_passage"), f"{listed(isolated)}: {NO_WAVE_PASSAGE}")
    fitted = []
    for name in dict.fromkeys(map(record_of, histories.records)):
        if name not in base.records:
            continue
        if base.records[name].fitted:
            fitted.append(name)
        elif histories.levels is not None and len(histories.levels) > 1:
            message = f"`{name}` is not fitted to the spectrum of the hazard; its histories would be the same at each"
            problems.at_value((*keys, "levels"), f"{message}; give one level, or `match` to the record [E-SCALE-03]")
    if histories.levels is not None:
        check_names(problems, (*keys, "levels"), "level", histories.levels, base.hazard_levels)
        check_fitted_levels((*keys, "levels"), fitted, histories.levels, base, problems)
    elif fitted:
        message = f"this key is missing; {listed(fitted)} is fitted to the spectrum of the hazard and scaled to a level"
        problems.under(keys, "levels", f"{message}: {listed(base.hazard_levels)} [E-KEY-02]")
    if histories.temperatures is not None:
        for name in study.variants_of(histories):
            if study.variants[name].dampers == "none":
                message = f"the variant `{name}` has no dampers, whose temperature this is [E-DAMPER-04]"
                problems.at_key((*keys, "temperatures"), message)


def _pushovers(study: Study, problems: Problems, keys: Keys, pushovers: Pushovers) -> None:
    if pushovers.variants != (ALL,):
        check_names(problems, (*keys, "variants"), "variant", pushovers.variants, study.variants)
    _ways(study, problems, keys, pushovers)
    check_drift(study.base, problems, (*keys, "roof_drift"), pushovers.roof_drift)
    check_pushover(study.base, problems, keys, pushovers)
    isolated = study.base.isolation is not None
    wanted = [name for name in study.variants_of(pushovers) if study.variants[name].dampers == "project"]
    if isolated and wanted:
        message = NO_PUSHOVER.replace("with `dampers: false` it", "a variant with `dampers: none`")
        problems.at_key((*keys, "variants"), f"{listed(wanted)}: {message}")


def _with_class(study: Study, problems: Problems) -> None:
    """Criteria on the use of members name none that EN 1993-1-1 does not judge, by its section or steel."""
    base = study.base
    assert isinstance(base, Building | Project)
    members = base.layout.members if isinstance(base, Building) else base.frame.members
    for at, criterion in enumerate(study.criteria):
        if not isinstance(criterion, QuantityCriterion) or criterion.quantity not in _USES:
            continue
        for i, name in enumerate(criterion.members):
            run, why = members.get(name), ""
            if run is not None and isinstance(base.sections.get(run.section), _WITHOUT_CLASS):
                why = f"its section `{run.section}` has no class"
            elif run is not None and isinstance(base, Project) and base.materials[run.material].law == "elastic":
                why = f"its material `{run.material}` does not yield"
            if why:
                message = f"`{criterion.quantity}` does not judge `{name}`: {why} [E-CRIT-05]"
                problems.at_item(("criteria", at, "members"), i, message)


def _ways(study: Study, problems: Problems, keys: Keys, pushovers: Pushovers) -> None:
    """Directions and positions of masses are those of what is pushed, a plane frame or a building."""
    base = study.base
    own = get_args(BuildingDirections if isinstance(base, Building) else FrameDirections)
    if pushovers.direction not in own:
        told = "direction" in pushovers.model_fields_set
        message = f"`{pushovers.direction}` is not of a {base.structure} (allowed: {listed(own)}) [E-VALUE-03]"
        missing = f"this key is missing; a building is pushed in one of {listed(own)} [E-KEY-02]"
        (problems.at_value if told else problems.at_key)((*keys, "direction"), message if told else missing)
        return
    if isinstance(base, Building):
        check_positions(base, problems, keys, pushovers)
        return
    for key in Eccentric.model_fields:
        if key in pushovers.model_fields_set:
            message = "a plane frame has no masses beside their places in plan; leave out this key [E-KEY-03]"
            problems.at_key((*keys, key), message)


def _own_names(study: Study, problems: Problems) -> None:
    """Names that stand in names of analyses after that of the variant, beside levels, modes and gravity."""
    places = [(("incremental", i), item.name) for i, item in enumerate(study.incremental)]
    places += [(("pushovers", i), item.name) for i, item in enumerate(study.pushovers)]
    names = [name for _, name in places]
    taken = {*study.base.hazard_levels, "modes", "gravity"}
    for i, (keys, name) in enumerate(places):
        if name in names[:i]:
            problems.at_value((*keys, "name"), f"`{name}` comes twice [E-NAME-02]")
        elif name in taken:
            message = f"analyses are named `VARIANT.{name}` already; choose another name [E-NAME-02]"
            problems.at_value((*keys, "name"), message)


def _verify(study: Study, problems: Problems, keys: Keys, verify: AnyVerify) -> None:
    check_names(problems, (*keys, "criteria"), "criterion", verify.criteria, [c.name for c in study.criteria])
    check_shaking(study.base, problems, keys, verify)
    if verify.levels is None:
        message = "this key is missing; criteria judge histories at levels of the hazard"
        problems.under(keys, "levels", f"{message}: {listed(study.base.hazard_levels)} [E-KEY-02]")
        return
    _at_their_levels(study, problems, keys, verify)
    _of_more_than_dampers(study, problems, keys, verify)
    for i, name in enumerate(verify.criteria):
        asked = next((c.levels for c in study.criteria if c.name == name), ())
        if asked and not set(asked) & set(verify.levels):
            message = (
                f"`{name}` is of {listed(asked)}, and the histories here are at {listed(verify.levels)} [E-CRIT-05]"
            )
            problems.at_item((*keys, "criteria"), i, message)


def _at_their_levels(study: Study, problems: Problems, keys: Keys, verify: AnyVerify) -> None:
    """Records that are fitted to the spectrum of one level are run at it, and each level needs records."""
    known = [name for name in map(record_of, verify.records) if name in study.base.records]
    fits = {name: study.base.fitted_level(name) for name in known}
    elsewhere = [name for name, only in fits.items() if only is not None and only not in (verify.levels or ())]
    check_fitted_levels((*keys, "levels"), elsewhere, verify.levels or (), study.base, problems)
    if elsewhere or not fits or None in fits.values():
        return
    for i, level in enumerate(verify.levels or ()):
        if level in study.base.hazard_levels and level not in fits.values():
            others = listed(dict.fromkeys(only for only in fits.values() if only is not None))
            message = f"no record here is fitted to the spectrum of `{level}`, only to that of {others}"
            problems.at_item((*keys, "levels"), i, f"{message}; add one with `match: {{level: {level}}}` [E-SCALE-02]")


def _of_more_than_dampers(study: Study, problems: Problems, keys: Keys, verify: AnyVerify) -> None:
    """A placement needs a criterion of the frame: those of dampers alone are best met without any."""
    asked = [criterion for criterion in study.criteria if criterion.name in verify.criteria]
    if isinstance(verify, PlacementVerify) and asked and all(criterion.traits.of_dampers for criterion in asked):
        message = (
            f"{listed(verify.criteria)} judge dampers alone, and nothing asks for any; add one of the frame [E-CRIT-05]"
        )
        problems.at_value((*keys, "criteria"), message)


def _outputs(study: Study, problems: Problems) -> None:
    outputs = study.outputs
    if outputs.archive is not None and not outputs.archive.endswith((".h5", ".hdf5", ".nc")):
        problems.at_value(("outputs", "archive"), f"`{outputs.archive}` needs the ending .h5, .hdf5 or .nc [E-FILE-08]")
    if outputs.details is None:
        return
    keys: Keys = ("outputs", "details")
    check_records(problems, (*keys, "records"), outputs.details.records, study.base)
    for i, member in enumerate(outputs.details.members):
        check_member(study.base, problems, (*keys, "members", i), member)
