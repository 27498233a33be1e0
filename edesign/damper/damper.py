"""A damper: a law with parameters, at the size of the device."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from edesign.core.damper import CoreDamper, Method
from edesign.damper.history import spline_velocity
from edesign.damper.law import Law


@dataclass(frozen=True)
class Damper:
    """A damper law with its parameters.

    Attributes:
        law: the law.
        parameters: by name, SI units; completed with defaults and checked.
        brace: stiffness in series, N/m; 0: rigid.
    """

    law: Law
    parameters: Mapping[str, float]
    brace: float = 0.0
    values: dict[str, float] = field(init=False)

    def __post_init__(self) -> None:
        object.__setattr__(self, "values", self.law.complete(self.parameters))

    @cached_property
    def core(self) -> CoreDamper:
        """The damper in the core."""
        return CoreDamper(self.law.name, list(self.values.values()), self.brace)

    def force(
        self, time: ArrayLike, deformation: ArrayLike, velocity: ArrayLike | None = None, method: Method = "best"
    ) -> np.ndarray:
        """Force history (n,) N under a deformation (n,) m at ascending times (n,) s, from rest.

        Without a velocity (n,) m/s, it is that of the cubic spline through the deformation.
        """
        if velocity is None:
            velocity = spline_velocity(time, deformation)
        return self.core.force(time, deformation, velocity, method)
