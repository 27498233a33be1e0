"""A form of an effect: its equation, its parameters with priors, the starts of a search."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any, Generic, NamedTuple, TypeVar

from edesign.calibration.search.problem import Effect, Kind
from edesign.estimation.parameters import Parameter

Values = Mapping[str, float]
"""Parameters by name, SI: those of a form, and numbers that the campaign fixes."""

Rows = tuple[tuple[float, ...], ...]
A = TypeVar("A")
S = TypeVar("S")

_ORDER_OF_MAGNITUDE = 1.5  # standard deviation of the natural logarithm: a factor of 4.5


class Words(NamedTuple):
    """What a form is, for people.

    Attributes:
        title: what it is.
        signature: what it leaves in the residual of a model without it.
    """

    title: str
    signature: str


@dataclass(frozen=True, eq=False)
class Form(Generic[A, S]):
    """A form of an effect, for campaigns whose sizes set its priors.

    Attributes:
        name: of the effect, shared by its forms.
        form: how it acts.
        kind: what it belongs to: damper, rig, instrument, structure.
        title: for people.
        signature: what it leaves in the residual of a model without it, for people.
        source: paper, book.
        mechanisms: by which it acts, each in its place; most forms have one.
        parameters: with priors that suit a campaign; the first is its size.
        starts: values, SI, to start from: a grid over what acts non-linearly, at a typical size; six at most.
        constants: numbers that the campaign fixes (a reference, a side), SI; they are in the values of mechanisms too.
        shown: whether a campaign can show it.
        proportional: whether what it does is proportional to its size near zero.
        meanings: of parameters by name, for people, as far as no law file has them.
        confounded: forms that do the same in all tests that are fitted, and something else in others; (): none.
        twin: the same equation as a part of something else, which no test can tell from it; None: there is none, or the
            campaign says what it is a part of.
        negative: title and signature where its size is below zero; None: they are the same, or it cannot be.
        exact: whether its equation is right by what it is.
    """

    name: str
    form: str
    kind: Kind
    title: str
    signature: str
    source: str
    mechanisms: tuple[A, ...]
    parameters: Callable[[S], tuple[Parameter, ...]]
    starts: Callable[[S], Rows]
    constants: Callable[[S], Values] = lambda _: {}
    shown: Callable[[S], bool] = lambda _: True
    proportional: bool = True
    meanings: Mapping[str, str] = field(default_factory=dict)
    confounded: tuple[Form[A, S], ...] = ()
    twin: Form[A, S] | None = None
    negative: Words | None = None
    exact: bool = False

    @property
    def label(self) -> str:
        """Name and form."""
        return f"{self.name}.{self.form}"

    @property
    def nuisance(self) -> bool:
        """Whether it acts through nuisance amplitudes of each test."""
        return False

    def of(self, sizes: S) -> FormInCampaign:
        """Return the form with the numbers that a campaign fixes."""
        return FormInCampaign(self, self.constants(sizes), tuple(one.name for one in self.parameters(sizes)))

    def effect(self, sizes: S) -> Effect:
        """Return the form as the search takes it."""
        parameters = self.parameters(sizes)
        first = parameters[0] if parameters else None
        linear = self.proportional and first is not None and not first.logarithmic and first.lower <= 0.0 <= first.upper
        starts, data, confounded = (
            self.starts(sizes),
            self.of(sizes),
            tuple(one.effect(sizes) for one in self.confounded),
        )
        return Effect(
            *(self.name, self.form, self.kind, parameters, starts, linear, self.nuisance, data),
            confounded=confounded,
            exact=self.exact,
        )


@dataclass(frozen=True, eq=False)
class FormInCampaign:
    """A form with the numbers that a campaign fixes.

    Attributes:
        form: the form.
        constants: SI.
        parameters: names of its parameters.
    """

    form: Any
    constants: Values
    parameters: tuple[str, ...]

    def words(self, numbers: Sequence[float]) -> Words:
        """Return what the form is with parameters, the first of which is its size.

        Args:
            numbers: SI.
        """
        negative = self.form.negative if len(numbers) and numbers[0] < 0.0 else None
        return negative or Words(self.form.title, self.form.signature)

    @property
    def twin(self) -> FormInCampaign | None:
        """The same equation as a part of something else; None: there is none, or the campaign says which it is."""
        return None if self.form.twin is None else replace(self, form=self.form.twin)

    @property
    def meanings(self) -> Mapping[str, str]:
        """Meanings of its parameters by name, for people, as far as no law file has them."""
        return dict(self.form.meanings)

    def values(self, numbers: Iterable[float]) -> Values:
        """Return all values of the mechanisms by name, those of the parameters first.

        Args:
            numbers: of the parameters in their order, SI.
        """
        return {**dict(zip(self.parameters, map(float, numbers), strict=True)), **self.constants}


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
        unit: SI.
        centre: SI.
        lower: bound, SI.
        upper: bound, SI.
        spread: standard deviation of the natural logarithm.
    """
    return Parameter(name, unit, lower, upper, centre, spread, True)


def fading() -> Parameter:
    """Return the power q of what fades as exp(-(x/x0)^q): below 1 ever slower."""
    return shape("q", "", 1.0, 0.2, 3.0, spread=0.5)


def share(name: str, centre: float = 0.5, spread: float = 0.5, upper: float = 1.0) -> Parameter:
    """Return a number from 0 to an upper bound.

    Args:
        name: of the parameter.
        centre: mean.
        spread: standard deviation.
    """
    return Parameter(name, "", 0.0, upper, centre, spread)
