"""Effects that tests have shown and a damper law has not, as law files and projects carry them.

Each is an equation, a factor or a force, at a placement. The force is phi F_law + parallel forces, phi the product of
the factors, + what acts inside the law; factors may act on its springs or dashpots alone
(docs/reference/laws/effects.md).
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

from edesign.core import EffectValues
from edesign.core.damper import PLACEMENTS, Placement
from edesign.damper.effect_forms import LAW_EFFECTS, LawEffectForm, law_effect_form, placed_form
from edesign.damper.law import Law
from edesign.damper.temperature import REFERENCE_C, GammaT, TemperatureModel, at, passed
from edesign.errors import InputError
from edesign.project.reading.problems import did_you_mean, listed

__all__ = ["LAW_EFFECTS", "LawEffect", "LawEffectForm", "law_effect_form", "parameters_at"]


@dataclass(frozen=True)
class LawEffect:
    """An effect beside or on a damper law.

    Attributes:
        name: of the effect, e.g. "payne".
        form: its equation, e.g. "whole"; a former name such as "whole_inside" is that of today with a placement.
        values: parameters by name, SI units; completed with defaults and checked.
        placement: where it acts, see `edesign.core.EffectValues`.

    Raises:
        InputError: no such effect, form or placement, or wrong parameters.
    """

    name: str
    form: str
    values: Mapping[str, float]
    placement: Placement = "whole"
    definition: LawEffectForm = field(init=False, repr=False, compare=False)

    def __post_init__(self) -> None:
        definition = law_effect_form(self.name, self.form)
        placement = placement_of(self.name, self.form, None if self.placement == "whole" else self.placement)
        object.__setattr__(self, "form", placed_form(self.name, self.form)[0])
        object.__setattr__(self, "placement", placement)
        object.__setattr__(self, "definition", definition)
        object.__setattr__(self, "values", definition.complete(self.values))

    @property
    def label(self) -> str:
        """Effect, form and placement, if that is not the usual one, e.g. "payne.whole (springs)"."""
        return self.definition.name if self.placement == "whole" else f"{self.definition.name} ({self.placement})"

    def for_core(self, temperature_C: float | None = None) -> EffectValues:
        """Return the effect as the core takes it at a temperature.

        Args:
            temperature_C: degC; None: that at which its factor is 1.

        Raises:
            InputError: a constant factor is not greater than zero.
        """
        if self.definition.constant:
            return EffectValues("constant", (self._factor(temperature_C),), self.placement)
        return EffectValues(
            self.definition.name, tuple(self.values.values())[: self.definition.for_core], self.placement
        )

    def _factor(self, temperature_C: float | None) -> float:
        if self.name == "temperature_law":
            return self._of_temperature(self.values["T0"] if temperature_C is None else temperature_C)
        n = self.values["n"]
        age, text = (n, "n")
        if self.form == "logarithmic":
            age, text = math.log1p(n / self.values["n0"]), "ln(1 + n/n0)"
        factor = 1.0 + self.values["rate"] * age
        if not factor > 0.0:
            raise InputError(
                f"effect {self.definition.name}: 1 + rate {text} = {factor:g} must be greater than 0 [E-LAW-04]"
            )
        return factor

    def _of_temperature(self, degrees: float) -> float:
        p, warmer = self.values, degrees - self.values["T0"]
        if self.form == "transition":
            factor = 1.0 - p["d"] * float(passed(degrees, p["Tc"], p["w"], p["T0"]))
            if not factor > 0.0:
                raise InputError(
                    f"effect {self.definition.name}: no force is left at {degrees:g} degC, its factor is {factor:.3g}"
                    " [E-LAW-04]"
                )
            return factor
        slowed = 1.0 + p.get("c", 0.0) * warmer
        if not slowed > 0.0:
            raise InputError(
                f"effect {self.definition.name}: 1 + c (T - T0) = {slowed:.3g} at {degrees:g} degC "
                "must be greater than 0 [E-LAW-04]"
            )
        return math.exp(-p["b"] * warmer / slowed)


def placement_of(name: str, form: str, placement: Placement | None) -> Placement:
    """Return where an effect acts, and refuse a placement at which it cannot, whatever the law.

    Args:
        form: of the effect, which there is; a former name says a placement.
        placement: where it should act; None: not said.

    Raises:
        InputError: there is no such placement, it is one for factors alone, or the form says another.
    """
    definition, (today, said) = law_effect_form(name, form), placed_form(name, form)
    if placement is None:
        return said
    if placement not in PLACEMENTS:
        hint = did_you_mean(placement, PLACEMENTS)
        raise InputError(
            f"effect {definition.name}: there is no placement `{placement}`{hint} (there are: {listed(PLACEMENTS)})"
            " [E-LAW-01]"
        )
    if placement not in definition.placements:
        why = (
            "it is proportional to the law's force, and does not act"
            if definition.is_factor
            else "it is a force of its own, and only factors act"
        )
        raise InputError(
            f"effect {definition.name}: {why} on {placement} alone (allowed: {listed(definition.placements)})"
            " [E-LAW-01]"
        )
    if today != form and placement != said:
        raise InputError(
            f"effect {name}.{form}: the form says the placement `{said}`, which is not `{placement}`; write "
            f"`form: {today}` with the placement that is meant [E-LAW-01]"
        )
    return placement


def parameters_at(
    law: Law,
    values: Mapping[str, float],
    effects: Sequence[LawEffect],
    temperature_C: float,
    model: TemperatureModel | None = None,
    reference_C: float = REFERENCE_C,
) -> tuple[dict[str, float], tuple[str, ...]]:
    """Return the parameters of a law with effects at a temperature.

    Effects act on the parameters of the law, whatever these are.

    Args:
        law: see `temperature.at`.
        values: parameters at the reference temperature, SI units, see `temperature.at`.
        effects: of the law; with one that changes with temperature a law need not.
        temperature_C: degC.
        model: what the temperature changes, see `temperature.at`.
        reference_C: temperature of the values, degC.

    Returns:
        All parameters at that temperature, SI units; warnings.

    Raises:
        InputError: as of `temperature.at`.
    """
    found, warnings = at(law, values, temperature_C, model, reference_C)
    changes = any(one.name == "temperature_law" for one in effects)
    return found, () if changes and model is None and law.name not in GammaT().laws else warnings
