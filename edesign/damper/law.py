"""What a damper law is: its parameters with units and bounds, and what the core calls it."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import ClassVar

from edesign.errors import InputError
from edesign.project.reading.problems import did_you_mean


@dataclass(frozen=True)
class Parameter:
    """A parameter of a law.

    Attributes:
        name: as in the equation.
        meaning: for people.
        unit: in SI, e.g. "N/m"; `alpha` in it stands for the value of that parameter: "N*(s/m)^alpha".
        lower, upper: bounds.
        lower_allowed, upper_allowed: whether the bound itself is allowed.
        default: taken when the parameter is not given; None: it must be given.
        fitted: whether it is a number that data can determine, not a choice.
        choices: of a switch, the values that it takes; (): all within the bounds.
    """

    name: str
    meaning: str
    unit: str
    lower: float = 0.0
    upper: float = math.inf
    lower_allowed: bool = False
    upper_allowed: bool = True
    default: float | None = None
    fitted: bool = True
    choices: tuple[float, ...] = ()

    def allows(self, value: float) -> bool:
        """Say whether a value is finite, inside the bounds and, of a switch, one of its values.

        Args:
            value: SI.
        """
        if self.choices and value not in self.choices:
            return False
        above = value >= self.lower if self.lower_allowed else value > self.lower
        below = value <= self.upper if self.upper_allowed else value < self.upper
        return math.isfinite(value) and above and below

    def written(self, value: float) -> str:
        """Return a value with its unit, for people.

        Args:
            value: SI.
        """
        return f"{value:g} {self.unit}" if self.unit else f"{value:g}"

    @property
    def allowed(self) -> str:
        """The bounds, or the values of a switch, for people."""
        if self.choices:
            *others, last = (f"{value:g}" for value in self.choices)
            return f"{', '.join(others)} or {last}"
        parts = []
        if self.lower > -math.inf:
            parts.append(f"{'at least' if self.lower_allowed else 'greater than'} {self.lower:g}")
        if self.upper < math.inf:
            parts.append(f"{'at most' if self.upper_allowed else 'less than'} {self.upper:g}")
        return " and ".join(parts) or "any number"


@dataclass(frozen=True)
class Law:
    """A damper law.

    Attributes:
        name: key in files and in the core, e.g. "mgmm".
        title: for people.
        parameters: in the order of the core.
        branch: parameters of one branch of a law with any number of branches, e.g. k and c: named k1, c1, k2, c2 ...
        equation: in plain text.
        source: thesis equation and paper.
        rate_dependent: whether the force depends on the speed of the deformation.
        speed: parameters without which, all being zero, a force that may depend on the speed does not; (): it does.
        kind: what messages call it.
    """

    kind: ClassVar[str] = "law"
    name: str
    title: str
    parameters: tuple[Parameter, ...]
    equation: str
    source: str
    rate_dependent: bool
    branch: tuple[Parameter, ...] = ()
    most_branches: int = 16
    speed: tuple[str, ...] = ()

    def with_branches(self, count: int) -> tuple[Parameter, ...]:
        """Return all parameters in the order of the core, with those of some branches."""
        repeated = (
            replace(parameter, name=f"{parameter.name}{i}", meaning=f"{parameter.meaning} {i}")
            for i in range(1, count + 1)
            for parameter in self.branch
        )
        return (*self.parameters, *repeated)

    def all_parameters(self, values: Mapping[str, float]) -> tuple[Parameter, ...]:
        """Return all parameters, with as many branches as `values` names.

        Args:
            values: parameters by name, SI.
        """
        count = 0
        while self.branch and count < self.most_branches and f"{self.branch[0].name}{count + 1}" in values:
            count += 1
        return self.with_branches(max(count, 1) if self.branch else 0)

    def depends_on_speed(self, values: Mapping[str, float]) -> bool:
        """Say whether the force depends on the speed of the deformation with these parameters.

        Args:
            values: parameters by name, SI.
        """
        return self.rate_dependent and (not self.speed or any(values[name] != 0.0 for name in self.speed))

    def complete(self, values: Mapping[str, float]) -> dict[str, float]:
        """Check values and add defaults.

        Args:
            values: parameters by name, SI units.

        Returns:
            All parameters in the order of the core.

        Raises:
            InputError: a parameter is unknown, missing, or out of its bounds.
        """
        parameters = self.all_parameters(values)
        known = [parameter.name for parameter in parameters]
        for name in values:
            if name not in known:
                raise InputError(
                    f"{self.kind} {self.name}: unknown parameter `{name}`{did_you_mean(name, known)}; "
                    f"it has {', '.join(known)}{' ...' if self.branch else ''} [E-LAW-02]"
                )
        found = {}
        for parameter in parameters:
            value = values.get(parameter.name, parameter.default)
            if value is None:
                raise InputError(
                    f"{self.kind} {self.name}: parameter `{parameter.name}` ({parameter.meaning}) is missing [E-LAW-02]"
                )
            if not parameter.allows(value):
                raise InputError(
                    f"{self.kind} {self.name}: {parameter.name} = {parameter.written(value)} "
                    f"is out of range: {parameter.allowed} is allowed [E-LAW-03]"
                )
            found[parameter.name] = float(value)
        return found
