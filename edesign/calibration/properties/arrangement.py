"""Other arrangements of the MGMM: what passes the relaxation of its Maxwell branch, and what stands beside it.

In Eq. 4.29 all forces pass the relaxation c1/k1, which rounds the corners that a power of the velocity makes. The
values that these forms act with are those of the law as it is without them.
"""

from __future__ import annotations

from dataclasses import replace

from edesign.calibration.dampers.effect import EffectForm
from edesign.calibration.dampers.experiment import Experiment
from edesign.calibration.dampers.mechanisms import CoreEffect, LawParameters
from edesign.calibration.form import Values
from edesign.damper.law import Law

_AT_ONCE = 1e-4  # s: relaxation that is none, for dashpots at 4 Hz a phase of 0.0025
_NOTHING = 1e-6  # share of k1 that is left where the branch has been taken out


def _consistent(p: Values, test: Experiment, law: Law, values: dict[str, float]) -> dict[str, float]:
    return {**values, "consistent": 1.0}


def _without_power(p: Values, test: Experiment, law: Law, values: dict[str, float]) -> dict[str, float]:
    return {**values, "c_NL": 0.0}


def _without_branch(p: Values, test: Experiment, law: Law, values: dict[str, float]) -> dict[str, float]:
    k1 = _NOTHING * values["k1"]
    return {**values, "k1": k1, "c1": _AT_ONCE * k1, "consistent": 1.0}


_CONSISTENT = EffectForm(
    "arrangement",
    "consistent",
    "damper",
    "the softened spring beside the Maxwell branch",
    "loops with sharper corners than the law's: G_eq too small beside G' and loss factor, a hump of the loss factor "
    "over frequency",
    "thesis Eqs. 4.19 and 4.24, carried to the end (docs/reference/laws/mgmm.md)",
    (LawParameters(_consistent),),
    lambda _: (),
    lambda _: ((),),
    laws=("mgmm",),
    proportional=False,
)
_POWER_BESIDE = replace(
    _CONSISTENT,
    form="power_beside",
    title="the power-law dashpot beside the Maxwell branch",
    source="thesis Eq. 4.24 read as elements in parallel",
    mechanisms=(
        LawParameters(_without_power),
        CoreEffect("velocity_exponent.dashpot", more=lambda p: {"c": p["c_NL"], "alpha": p["alpha"]}),
    ),
)
_ALL_BESIDE = replace(
    _CONSISTENT,
    form="all_beside",
    title="softened spring, softened dashpot and power-law dashpot beside the Maxwell branch",
    source="thesis Eq. 4.24 read as elements in parallel: the relaxation c1/k1 is the branch's alone",
    mechanisms=(
        LawParameters(_without_branch),
        CoreEffect("relaxation_branch.maxwell", more=lambda p: {"k": p["k1"], "tau": p["c1"] / p["k1"]}),
    ),
)

FORMS = (_CONSISTENT, _POWER_BESIDE, _ALL_BESIDE)
