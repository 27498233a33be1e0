"""Cross checks of a design of viscous dampers: its law is a dashpot, and its keys go together."""

from __future__ import annotations

from edesign.project.checks.dampers import check_sized_law
from edesign.project.dampers.designs import VISCOUS_LAWS, ViscousDesign
from edesign.project.project import Project
from edesign.project.reading.problems import Keys, Problems


def check_viscous_design(keys: Keys, spec: ViscousDesign, project: Project, problems: Problems) -> None:
    """Check the keys that only a design of viscous dampers has.

    Args:
        keys: of the design in the study file, e.g. ("designs", "dampers").
        spec: without schema problems.
        project: that is studied.
        problems: of the study file; collects what is wrong.
    """
    laws = project.dampers.laws if project.dampers is not None else {}
    if spec.law in laws:
        check_sized_law((*keys, "law"), spec, laws[spec.law], VISCOUS_LAWS, problems)
    if spec.amplitude == "spectrum" and spec.level is None:
        problems.under(keys, "level", "this key is missing; `amplitude: spectrum` needs the spectrum of a hazard level")
    if spec.bounds is not None and spec.bounds.temperatures is not None:
        message = "a viscous law changes with its coefficient alone; give factors that hold for the temperatures"
        problems.at_key((*keys, "bounds", "temperatures"), message)
    if spec.distribution == "least_coefficient":
        _least_coefficient(keys, spec, problems)
        return
    if spec.damping is None:
        problems.under(keys, "damping", "this key is missing: the damping ratio that the dampers add, such as `15 %`")
    if spec.drift is not None:
        message = "a drift has no part in the sizing for a damping; meet one by `verify`, or by `least_coefficient`"
        problems.at_key((*keys, "drift"), message)


def _least_coefficient(keys: Keys, spec: ViscousDesign, problems: Problems) -> None:
    for key in ("level", "drift"):
        if getattr(spec, key) is None:
            problems.under(keys, key, "this key is missing; `distribution: least_coefficient` needs it")
    if spec.damping is not None:
        message = "`distribution: least_coefficient` meets a drift with the least coefficients, whatever the damping"
        problems.at_key((*keys, "damping"), message)
    if spec.verify is not None and spec.verify.change == "target":
        message = "this distribution has no target damping to change; choose `coefficient`"
        problems.at_value((*keys, "verify", "change"), message)
