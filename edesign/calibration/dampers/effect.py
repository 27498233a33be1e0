"""Forms of effects in tests of dampers: made for a law, placed in it, predicted at a sampling."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

from edesign.calibration.dampers.experiment import Experiment
from edesign.calibration.dampers.mechanisms import (
    CoreEffect,
    ForceChannel,
    Mechanism,
    NuisanceAmplitudes,
    Placement,
    Rest,
    Rig,
)
from edesign.calibration.dampers.sizes import Sizes
from edesign.calibration.form import Form
from edesign.calibration.search.problem import Effect

REFINED = 2
"""Times the samples of a fit at which tests are predicted: the MGMM exact to 3e-5, most effects to a few 1e-3."""
_IN_SERIES = 4.0  # forces of a law that a step in series with a rig takes: measured, 3 to 5

_SIDES = {"positive": 1.0, "negative": -1.0}
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
        usual_in: names of the laws in which it is taken for this rather than for its twin.
        numbers: of the tests in which it acts, from 1; None: in all.
        places: how many forms there are that differ in `numbers` alone, of which one acts at most.
    """

    laws: tuple[str, ...] = ()
    refined: int = REFINED
    usual_in: tuple[str, ...] = ()
    twin: EffectForm | None = None
    numbers: range | None = None
    places: int = 1

    def acts_in(self, test: Experiment) -> bool:
        """Return whether it acts in a test."""
        return self.numbers is None or test.order + 1 in self.numbers

    def effect(self, sizes: Sizes) -> Effect:
        """Return the form as the search takes it."""
        fitted = [order + 1 for order, of in enumerate(sizes.fitted) if of]
        tests = () if self.numbers is None else tuple(k for k, at in enumerate(fitted) if at in self.numbers)
        return replace(super().effect(sizes), tests=tests, log_prior=-math.log(self.places), cost=self.cost)

    @property
    def cost(self) -> float:
        """Of a prediction with it, in those of the law alone: by the samples, and by the balance with a rig in each."""
        in_series = any(isinstance(mechanism, Rig) for mechanism in self.mechanisms)
        return max(self.refined / REFINED, 1.0) * (_IN_SERIES if in_series else 1.0)

    @property
    def nuisance(self) -> bool:
        """Whether it acts through nuisance amplitudes of each test."""
        return any(isinstance(mechanism, NuisanceAmplitudes) for mechanism in self.mechanisms)

    def read(self, law: str, belongs_to: str | None = None) -> EffectForm:
        """Return the form as a part of what it belongs to; where nobody says it, of what is usual, beside its twin.

        Args:
            belongs_to: "damper", or "rig" with its instruments; None: not said.
        """
        if self.twin is None:
            return self
        of_damper, alone = replace(self.twin, laws=self.laws), replace(self, twin=None)
        if belongs_to is not None:
            return of_damper if belongs_to == of_damper.kind else alone
        if self.twin.laws and law not in self.twin.laws:
            return alone
        return replace(of_damper, twin=alone) if law in of_damper.usual_in else self

    @property
    def remembers(self) -> bool:
        """Whether its force depends on what the specimen did before; in series with a rig it always does."""
        return any(
            isinstance(one, Rig) or (isinstance(one, CoreEffect | ForceChannel) and one.remembers)
            for one in self.mechanisms
        )

    @property
    def carries(self) -> bool:
        """Whether the specimen remembers what it does from test to test."""
        return any(isinstance(one, Rest) for one in self.mechanisms) or any(one.carries for one in self.core_effects)

    @property
    def core_effects(self) -> tuple[CoreEffect, ...]:
        """What of it is in the C core."""
        return tuple(mechanism for mechanism in self.mechanisms if isinstance(mechanism, CoreEffect))


def either(
    form: EffectForm,
    title: str,
    mechanisms: tuple[Mechanism, ...] = (),
    laws: tuple[str, ...] = (),
    usual_in: tuple[str, ...] = (),
) -> EffectForm:
    """Return a form of rig or instruments that may as well be a part of the damper.

    Args:
        title: of it as a part of the damper, for people.
        mechanisms: of it as a part of the damper, as law files carry it; (): the same.
        laws: names of those of dampers that may have it; (): all.
        usual_in: names of those of dampers in which it is rather that than a part of the rig.
    """
    own = replace(form, kind="damper", title=title, laws=laws, usual_in=usual_in)
    return replace(form, twin=replace(own, mechanisms=mechanisms or form.mechanisms))


def renamed(form: EffectForm, name: str, title: str) -> EffectForm:
    """Return a form with another name and titles.

    Args:
        title: with {} in the place of the titles that it had.
    """
    negative = form.negative and form.negative._replace(title=title.format(form.negative.title))
    return replace(form, form=name, title=title.format(form.title), negative=negative)


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
        return replace(renamed(form, form.form + ending, f"{{}}{_TITLES[placement]}"), mechanisms=mechanisms)

    return tuple(map(at, placements))


def both_sides(form: EffectForm) -> tuple[EffectForm, ...]:
    """Return a form for each side, which its constants name beside what they are.

    Args:
        form: with an equation that has a side, 1 or -1.
    """

    def to(name: str, side: float) -> EffectForm:
        return replace(
            renamed(form, f"{form.form}_{name}", f"{{}} on the {name} side"),
            constants=lambda s: {**form.constants(s), "side": side},
        )

    return tuple(to(name, side) for name, side in _SIDES.items())
