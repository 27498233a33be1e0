"""Another factor gamma_T of the MGMM at each temperature of a table (thesis Eq. 4.34)."""

from __future__ import annotations

from collections.abc import Sequence
from typing import ClassVar

import numpy as np

from edesign.calibrate.dampers.effect import Form
from edesign.calibrate.dampers.trial import Sizes, Trial, Values
from edesign.calibrate.problem import Kind
from edesign.calibrate.unknown import Unknown
from edesign.damper.laws import law as law_of
from edesign.damper.temperature import REFERENCE_C, GammaT

_TABLE = GammaT()


class FreeGamma(Form):
    """gamma_T free at the temperatures fitted to, linear between them, in place of Table 4.4."""

    name: ClassVar[str] = "temperature_law"
    form: ClassVar[str] = "gamma"
    kind: ClassVar[Kind] = "damper"
    title: ClassVar[str] = "another change with temperature"
    signature: ClassVar[str] = "all moduli off by a factor of the temperature, whatever strain and frequency"
    source: ClassVar[str] = "thesis Eqs. 4.34-4.36"

    def __init__(self, temperatures: Sequence[float]) -> None:
        self.temperatures = tuple(sorted(t for t in temperatures if t != REFERENCE_C))

    def unknowns(self, sizes: Sizes) -> tuple[Unknown, ...]:
        return tuple(
            Unknown(f"gamma_{t:g}", "", 0.05, 20.0, _TABLE.gamma(t), logarithmic=True) for t in self.temperatures
        )

    def starts(self, sizes: Sizes) -> tuple[tuple[float, ...], ...]:
        return (tuple(0.98 * _TABLE.gamma(t) for t in self.temperatures),) if self.temperatures else ()

    def gamma_T(self, p: Values) -> GammaT:
        """The table found."""
        rows = {REFERENCE_C: 1.0} | {t: float(p[f"gamma_{t:g}"]) for t in self.temperatures}
        return GammaT(tuple(sorted(rows.items())))

    def law(self, p: Values, trial: Trial, values: dict[str, float]) -> dict[str, float]:
        # the problem itself takes Table 4.4 at the temperature of the trial: the ratio is what is missing
        temperature = float(np.mean(trial.temperature))
        if temperature == REFERENCE_C:
            return values
        ratio = self.gamma_T(p).gamma(temperature) / _TABLE.gamma(temperature)
        if ratio == 1.0:
            return values
        there = GammaT(tuple(sorted(((REFERENCE_C, 1.0), (temperature, ratio)))))
        return there.shifted(law_of("mgmm"), values, temperature)[0]
