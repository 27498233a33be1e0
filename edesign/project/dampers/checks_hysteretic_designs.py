"""Cross checks of a design of hysteretic dampers: its law yields or slips, and it has one target with what it needs."""

from __future__ import annotations

from edesign.project.dampers.dampers import DamperLaw
from edesign.project.dampers.designs import BRACE_KINDS, HYSTERETIC_LAWS, HystereticDesign, Optimum
from edesign.project.project import Project
from edesign.project.reading.problems import Keys, Problems, listed

TARGETS = ("shear_share", "damping", "optimum")


def check_hysteretic_design(keys: Keys, spec: HystereticDesign, project: Project, problems: Problems) -> None:
    """Check what only a design of hysteretic dampers has.

    Args:
        keys: of the design in the study file, e.g. ("designs", "dampers").
        spec: without schema problems.
        project: that is studied.
        problems: of the study file; collects what is wrong.
    """
    laws = project.dampers.laws if project.dampers is not None else {}
    if spec.law in laws:
        _law((*keys, "law"), spec.law, laws[spec.law], problems)
        if laws[spec.law].type == "buckling_restrained":
            for key, message in restrained_misfits(spec).items():
                problems.at_value((*keys, key), message)
    given = [key for key in TARGETS if getattr(spec, key) is not None]
    if not given:
        problems.under(keys, "shear_share", f"this key is missing; one target of {listed(TARGETS)} is needed")
    for key in given[1:]:
        problems.at_key((*keys, key), f"`{given[0]}` is given; a design has one target of {listed(TARGETS)}")
    if spec.drift is not None:
        message = "a drift has no part in the sizing of hysteretic dampers; meet one by `verify` and its criteria"
        problems.at_key((*keys, "drift"), message)
    if spec.level is None:
        _level(keys, spec, problems)
    if spec.bounds is not None and spec.bounds.temperatures is not None:
        message = "a hysteretic law changes with its force alone; give factors that hold for the temperatures"
        problems.at_key((*keys, "bounds", "temperatures"), message)
    if spec.optimum is not None:
        _optimum(keys, spec, spec.optimum, problems)


def _law(keys: Keys, name: str, law: DamperLaw, problems: Problems) -> None:
    if law.prototype is not None:
        problems.at_value(keys, f"the law `{name}` of the project has a `prototype`; hysteretic dampers have no layers")
    if law.file is None and law.type is not None and law.type not in HYSTERETIC_LAWS:
        message = f"the law `{name}` is of type `{law.type}`; hysteretic dampers are of type {listed(HYSTERETIC_LAWS)}"
        problems.at_value(keys, message)


def restrained_misfits(spec: HystereticDesign) -> dict[str, str]:
    """What a design of buckling-restrained braces must not say, by its key."""
    found = {}
    if spec.kind not in BRACE_KINDS:
        message = f"`{spec.kind}` acts horizontally, and a buckling-restrained brace along its length"
        found["kind"] = f"{message}; take {listed(BRACE_KINDS)}"
    if spec.brace != "rigid":
        found["brace"] = "the ends of a buckling-restrained brace are in its `KF`; leave this key out"
    return found


def _level(keys: Keys, spec: HystereticDesign, problems: Problems) -> None:
    needs = {
        "shear_share": spec.shear_share is not None and not isinstance(spec.shear, tuple),
        "optimum": spec.optimum is not None and not isinstance(spec.shear, tuple),
        "shear: spectrum": spec.shear == "spectrum",
        "amplitude: spectrum": spec.amplitude == "spectrum",
    }
    for key, needed in needs.items():
        if needed:
            problems.under(keys, "level", f"this key is missing; `{key}` needs the spectrum of a hazard level")
            return


def _optimum(keys: Keys, spec: HystereticDesign, optimum: Optimum, problems: Problems) -> None:
    low, high = optimum.range
    if low >= high:
        message = f"the range from {low:g} to {high:g} is empty; write the lower share first"
        problems.at_value((*keys, "optimum", "range"), message)
    if spec.verify is None:
        problems.under(keys, "verify", "this key is missing; an `optimum` is found by its histories and criteria")
    elif spec.verify.change != "target":
        problems.at_value((*keys, "verify", "change"), "an `optimum` changes its share of the storey shears: `target`")
