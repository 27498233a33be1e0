"""Other arrangements of the MGMM: what passes the relaxation of its Maxwell branch, and what stands beside it.

In Eq. 4.29 all forces pass the relaxation c1/k1, which rounds the corners that a power of the velocity makes."""

from __future__ import annotations

from collections.abc import Mapping
from typing import ClassVar

from edesign.calibrate.dampers.effect import Form
from edesign.calibrate.dampers.trial import Sizes, Trial, Values
from edesign.calibrate.problem import Kind
from edesign.calibrate.unknown import Unknown

AT_ONCE = 1e-4
"""s: relaxation that is none, for dashpots at 4 Hz a phase of 0.0025."""
_NOTHING = 1e-6  # share of k1 that is left where the branch has been taken out

Beside = tuple[str, str, dict[str, float]]
"""An effect that a law file carries: name, form, parameters."""


class Arrangement(Form):
    """A form that rearranges the law: other parameters, and what then stands beside it."""

    name: ClassVar[str] = "arrangement"
    kind: ClassVar[Kind] = "damper"
    signature: ClassVar[str] = (
        "loops with sharper corners than the law's: G_eq too small beside G' and loss factor, a hump of the loss "
        "factor over frequency"
    )

    def unknowns(self, sizes: Sizes) -> tuple[Unknown, ...]:
        return ()

    def starts(self, sizes: Sizes) -> tuple[tuple[float, ...], ...]:
        return ((),)

    def law(self, p: Values, trial: Trial | None, values: dict[str, float]) -> dict[str, float]:
        return self.arranged(values)

    def arranged(self, values: Mapping[str, float]) -> dict[str, float]:
        """Parameters of the law, of those of the law as printed."""
        raise NotImplementedError

    def beside(self, values: Mapping[str, float]) -> tuple[Beside, ...]:
        """What stands beside it, of the parameters of the law as printed."""
        return ()


class Consistent(Arrangement):
    """The softened spring beside the relaxation: the derivative of k_mod u is carried in Eq. 4.29."""

    form: ClassVar[str] = "consistent"
    title: ClassVar[str] = "the softened spring beside the Maxwell branch"
    source: ClassVar[str] = "thesis Eqs. 4.19 and 4.24, carried to the end (docs/reference/laws/mgmm.md)"

    def arranged(self, values: Mapping[str, float]) -> dict[str, float]:
        return {**values, "consistent": 1.0}


class PowerBeside(Arrangement):
    """The power-law dashpot beside the relaxation."""

    form: ClassVar[str] = "power_beside"
    title: ClassVar[str] = "the power-law dashpot beside the Maxwell branch"
    source: ClassVar[str] = "thesis Eq. 4.24 read as elements in parallel"

    def arranged(self, values: Mapping[str, float]) -> dict[str, float]:
        return {**values, "c_NL": 0.0}

    def beside(self, values: Mapping[str, float]) -> tuple[Beside, ...]:
        return (("velocity_exponent", "dashpot", {"c": values["c_NL"], "alpha": values["alpha"]}),)


class AllBeside(Arrangement):
    """All softened forces and the power-law dashpot beside the Maxwell branch, which then stands alone as an effect."""

    form: ClassVar[str] = "all_beside"
    title: ClassVar[str] = "softened spring, softened dashpot and power-law dashpot beside the Maxwell branch"
    source: ClassVar[str] = "thesis Eq. 4.24 read as elements in parallel: the relaxation c1/k1 is the branch's alone"

    def arranged(self, values: Mapping[str, float]) -> dict[str, float]:
        k1 = _NOTHING * values["k1"]
        return {**values, "k1": k1, "c1": AT_ONCE * k1, "consistent": 1.0}

    def beside(self, values: Mapping[str, float]) -> tuple[Beside, ...]:
        return (("relaxation_branch", "maxwell", {"k": values["k1"], "tau": values["c1"] / values["k1"]}),)


FORMS = (Consistent, PowerBeside, AllBeside)
