"""Cross checks of a design of hysteretic dampers: its law yields or slips, and it has one target with what it needs."""

from __future__ import annotations

from edesign.project.analysis_file import AnalysisFile
from edesign.project.dampers.dampers import SET_IN, restrained_misfits
from edesign.project.dampers.designs import (
    DESIGNED_BRACES,
    HYSTERETIC_TARGETS,
    HystereticDesign,
    Optimum,
)
from edesign.project.reading.problems import Keys, Problems, listed


def check_hysteretic_design(keys: Keys, spec: HystereticDesign, project: AnalysisFile, problems: Problems) -> None:
    """Check the keys that only a design of hysteretic dampers has.

    Args:
        keys: of the design in the study file, e.g. ("designs", "dampers").
        spec: without schema problems.
        project: that is studied.
        problems: of the study file; collects what is wrong.
    """
    laws = project.dampers.laws if project.dampers is not None else {}
    law = laws.get(spec.law)
    restrained = law is not None and law.type == "buckling_restrained"
    for i, run in enumerate(spec.runs if restrained else ()):
        for key, message in restrained_misfits(run.kind, spec.brace, DESIGNED_BRACES).items():
            at = ("places", i) if spec.places and key == "kind" else ()
            problems.at_value((*keys, *at, key), message)
    if spec.carries_gravity:
        if not restrained and law is not None and law.file is None:
            problems.at_key((*keys, "carries_gravity"), SET_IN.format(spec.law))
        if spec.distribution in ("storey_stiffness", "strain_energy"):
            message = (
                f"`{spec.distribution}` is of the frame without its dampers, which stands by them here; take "
                "`storey_shear` or `uniform` [E-DESIGN-06]"
            )
            problems.at_value((*keys, "distribution"), message)
        if spec.damping is not None:
            message = (
                "a frame that stands by its braces is damped the more the smaller they are, so that no least braces "
                "reach a damping; give `shear_share`, and meet criteria by `verify` [E-DESIGN-06]"
            )
            problems.at_key((*keys, "damping"), message)
    targets = listed(HYSTERETIC_TARGETS)
    given = [key for key in HYSTERETIC_TARGETS if getattr(spec, key) is not None]
    if not given:
        problems.under(keys, "shear_share", f"this key is missing; one target of {targets} is needed [E-KEY-02]")
    for key in given[1:]:
        problems.at_key((*keys, key), f"`{given[0]}` is given; a design has one target of {targets} [E-KEY-03]")
    if spec.drift is not None:
        message = (
            "a drift has no part in the sizing of hysteretic dampers; meet one by `verify` and its criteria"
            " [E-DESIGN-06]"
        )
        problems.at_key((*keys, "drift"), message)
    if spec.level is None:
        _level(keys, spec, problems)
    if spec.optimum is not None:
        _optimum(keys, spec, spec.optimum, problems)


def _level(keys: Keys, spec: HystereticDesign, problems: Problems) -> None:
    needs = {
        "shear_share": spec.shear_share is not None and not isinstance(spec.shear, tuple),
        "optimum": spec.optimum is not None and not isinstance(spec.shear, tuple),
        "shear: spectrum": spec.shear == "spectrum",
        "amplitude: spectrum": spec.amplitude == "spectrum",
    }
    for key, needed in needs.items():
        if needed:
            problems.under(
                keys, "level", f"this key is missing; `{key}` needs the spectrum of a hazard level [E-KEY-02]"
            )
            return


def _optimum(keys: Keys, spec: HystereticDesign, optimum: Optimum, problems: Problems) -> None:
    low, high = optimum.range
    if low >= high:
        message = f"the range from {low:g} to {high:g} is empty; write the lower share first [E-VALUE-04]"
        problems.at_value((*keys, "optimum", "range"), message)
    if spec.verify is None:
        problems.under(
            keys, "verify", "this key is missing; an `optimum` is found by its histories and criteria [E-KEY-02]"
        )
    elif spec.verify.change != "target":
        problems.at_value(
            (*keys, "verify", "change"), "an `optimum` changes its share of the storey shears: `target` [E-KEY-03]"
        )
