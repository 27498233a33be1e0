"""Forms of effects in tests of dampers: made for a law, placed in it, predicted at a sampling."""

from __future__ import annotations

from dataclasses import dataclass, replace

from edesign.calibration.dampers.mechanisms import CoreEffect, Mechanism, NuisanceAmplitudes, Placement
from edesign.calibration.dampers.sizes import Sizes
from edesign.calibration.form import Form

REFINED = 2
"""Times the samples of a fit at which tests are predicted: the MGMM exact to 3e-5, most effects to a few 1e-3."""

_TITLES = {
    Placement.WHOLE: "",
    Placement.INSIDE: ", inside the law",
    Placement.SPRINGS: ", of the springs alone",
    Placement.DASHPOTS: ", of the dashpots alone",
}


@dataclass(frozen=True, eq=False)
class EffectForm(Form[Mechanism, Sizes]):
    """A form of an effect of dampers, rigs and instruments.

    Attributes:
        laws: names of the laws that it is made for; (): all.
        refined: times the samples of a fit at which it is predicted: more where motion or force bend between them.
    """

    laws: tuple[str, ...] = ()
    refined: int = REFINED

    @property
    def nuisance(self) -> bool:
        """Whether it acts through nuisance amplitudes of each test."""
        return any(isinstance(mechanism, NuisanceAmplitudes) for mechanism in self.mechanisms)

    @property
    def core_effects(self) -> tuple[CoreEffect, ...]:
        """What of it is in the C core."""
        return tuple(mechanism for mechanism in self.mechanisms if isinstance(mechanism, CoreEffect))


def placed(form: EffectForm, *placements: Placement) -> tuple[EffectForm, ...]:
    """Return a form, whose effects act on the whole law, once for each placement.

    Args:
        form: with one effect or more.
        placements: where they act in its place.
    """

    def at(placement: Placement) -> EffectForm:
        mechanisms = tuple(
            replace(mechanism, placement=placement) if isinstance(mechanism, CoreEffect) else mechanism
            for mechanism in form.mechanisms
        )
        ending = "" if placement is Placement.WHOLE else f"_{placement.value}"
        return replace(form, form=form.form + ending, title=form.title + _TITLES[placement], mechanisms=mechanisms)

    return tuple(map(at, placements))
