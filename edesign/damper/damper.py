"""A damper: a law with parameters and effects, at the size of the device."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from edesign.core.damper import CoreDamper, Method
from edesign.damper.effects import LawEffect, parameters_at
from edesign.damper.history import NONE, Extremes, spline_velocity
from edesign.damper.law import Law
from edesign.damper.temperature import TemperatureModel


@dataclass(frozen=True)
class Damper:
    """A damper law with its parameters.

    Attributes:
        law: the law.
        parameters: by name, SI units; completed with defaults and checked.
        brace: stiffness in series, N/m; 0: rigid.
        effects: effects that the law has not.
        temperature_C: of the damper, degC, for effects that change with it; the parameters are those of this
            temperature. None: the one at which their factor is 1.
        prior_extremes: what it went through before: some laws are softened by it for good.
    """

    law: Law
    parameters: Mapping[str, float]
    brace: float = 0.0
    effects: tuple[LawEffect, ...] = ()
    temperature_C: float | None = None
    prior_extremes: Extremes = NONE
    values: dict[str, float] = field(init=False)

    def __post_init__(self) -> None:
        object.__setattr__(self, "values", self.law.complete(self.parameters))

    @cached_property
    def core(self) -> CoreDamper:
        """The damper in the core."""
        effects = [one.for_core(self.temperature_C) for one in self.effects]
        return CoreDamper(self.law.name, list(self.values.values()), self.brace, effects, self.prior_extremes)

    def at(self, temperature_C: float, model: TemperatureModel | None = None) -> tuple[Damper, tuple[str, ...]]:
        """Return the damper at a temperature if its parameters are those of the reference, and warnings.

        Args:
            temperature_C: degC.

        Raises:
            InputError: as of `temperature.at`.
        """
        values, warnings = parameters_at(self.law, self.values, self.effects, temperature_C, model)
        return replace(self, parameters=values, temperature_C=temperature_C), warnings

    def force(
        self,
        time: ArrayLike,
        deformation: ArrayLike,
        velocity: ArrayLike | None = None,
        method: Method = "best",
        length: float | None = None,
    ) -> np.ndarray:
        """Return the force history under a deformation, from rest.

        Args:
            time: (n,) s, ascending.
            deformation: (n,) m.
            velocity: (n,) m/s; None: that of the cubic spline through the deformation.
            method: how the law is integrated, as in `CoreDamper.force`.
            length: of "fixed", m.

        Returns:
            (n,) N.
        """
        if velocity is None:
            velocity = spline_velocity(time, deformation)
        return self.core.force(time, deformation, velocity, method, length=length)
