"""A form of an effect: its parameters with priors, its starts, its acts."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field, replace

from edesign.calibration.dampers.acts import Act, Amendment, OwnShares, Placement, Values
from edesign.calibration.dampers.sizes import Sizes
from edesign.calibration.search.problem import Kind
from edesign.estimation.parameters import Parameter

REFINED = 2
"""Times the samples of a fit at which tests are predicted: the MGMM exact to 3e-5, most effects to a few 1e-3."""

Rows = tuple[tuple[float, ...], ...]

_TITLES = {
    Placement.WHOLE: "",
    Placement.INSIDE: ", inside the law",
    Placement.SPRINGS: ", of the springs alone",
    Placement.DASHPOTS: ", of the dashpots alone",
}
_ORDER_OF_MAGNITUDE = 1.5  # standard deviation of the natural logarithm: a factor of 4.5


@dataclass(frozen=True, eq=False)
class EffectForm:
    """A form of an effect.

    Attributes:
        name: of the effect, shared by its forms.
        form: how it acts.
        kind: what it belongs to: damper, rig, instrument.
        title: for people.
        signature: what it leaves in the residual of a model without it, for people.
        source: paper, book.
        acts: where it acts; most forms do so in one place.
        parameters: with priors that suit a campaign; the first is its size.
        starts: values, SI, to start from: a grid over what acts non-linearly, at a typical size; six at most.
        constants: numbers that the campaign fixes (a reference, a side), SI; they are in the values of the acts too.
        shown: whether a campaign can show it.
        laws: names of the laws that it is made for; (): all.
        proportional: whether what it does goes with its size, about nothing at zero.
        refined: times the samples of a fit at which it is predicted: more where motion or force bend between them.
        meanings: of parameters by name, for people, as far as no law file has them.
    """

    name: str
    form: str
    kind: Kind
    title: str
    signature: str
    source: str
    acts: tuple[Act, ...]
    parameters: Callable[[Sizes], tuple[Parameter, ...]]
    starts: Callable[[Sizes], Rows]
    constants: Callable[[Sizes], Mapping[str, float]] = lambda _: {}
    shown: Callable[[Sizes], bool] = lambda _: True
    laws: tuple[str, ...] = ()
    proportional: bool = True
    refined: int = REFINED
    meanings: Mapping[str, str] = field(default_factory=dict)

    @property
    def label(self) -> str:
        """Name and form."""
        return f"{self.name}.{self.form}"

    @property
    def own(self) -> bool:
        """Whether it adds shares that are each test's own."""
        return any(isinstance(act, OwnShares) for act in self.acts)

    @property
    def amendments(self) -> tuple[Amendment, ...]:
        """What of it is in the C core."""
        return tuple(act for act in self.acts if isinstance(act, Amendment))


@dataclass(frozen=True, eq=False)
class FormInCampaign:
    """A form with the numbers that a campaign fixes.

    Attributes:
        form: the form.
        constants: SI.
        parameters: names of its parameters.
    """

    form: EffectForm
    constants: Mapping[str, float]
    parameters: tuple[str, ...]

    @property
    def title(self) -> str:
        """What the form is, for people."""
        return self.form.title

    @property
    def signature(self) -> str:
        """What it leaves in the residual of a model without it, for people."""
        return self.form.signature

    @property
    def meanings(self) -> Mapping[str, str]:
        """Meanings of its parameters by name, for people, as far as no law file has them."""
        return self.form.meanings

    def values(self, numbers: Iterable[float]) -> Values:
        """Return all values of the acts by name, those of the parameters first.

        Args:
            numbers: of the parameters in their order, SI.
        """
        return {**dict(zip(self.parameters, map(float, numbers), strict=True)), **self.constants}


def placed(form: EffectForm, *placements: Placement) -> tuple[EffectForm, ...]:
    """Return a form, whose amendments act on the whole law, once for each placement.

    Args:
        form: with one amendment or more.
        placements: where they act in its place.
    """

    def at(placement: Placement) -> EffectForm:
        acts = tuple(replace(act, placement=placement) if isinstance(act, Amendment) else act for act in form.acts)
        ending = "" if placement is Placement.WHOLE else f"_{placement.value}"
        return replace(form, form=form.form + ending, title=form.title + _TITLES[placement], acts=acts)

    return tuple(map(at, placements))


def size(name: str, unit: str, spread: float, lower: float, upper: float) -> Parameter:
    """Return a size, N(0, spread): nothing is likelier than anything else.

    Args:
        name: of the parameter.
        unit: SI.
        spread: standard deviation, SI.
        lower: bound, SI.
        upper: bound, SI.
    """
    return Parameter(name, unit, lower, upper, 0.0, spread)


def shape(
    name: str, unit: str, centre: float, lower: float, upper: float, spread: float = _ORDER_OF_MAGNITUDE
) -> Parameter:
    """Return a positive parameter that acts non-linearly, its logarithm normal about the scale of the motion.

    Args:
        name: of the parameter.
        unit: SI.
        centre: SI.
        lower: bound, SI.
        upper: bound, SI.
        spread: standard deviation of the natural logarithm.
    """
    return Parameter(name, unit, lower, upper, centre, spread, True)


def share(name: str, centre: float = 0.5, spread: float = 0.5, upper: float = 1.0) -> Parameter:
    """Return a number from 0 to an upper bound.

    Args:
        name: of the parameter.
        centre: mean.
        spread: standard deviation.
        upper: bound.
    """
    return Parameter(name, "", 0.0, upper, centre, spread)
