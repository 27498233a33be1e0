"""What a calibration found: the errors before and after, the effects, and what the data cannot tell."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import Literal

from edesign.calibrate.problem import Kind
from edesign.calibration.residual.series import Errors, Series, Stage, Worst
from edesign.damper.amendments import Amendment
from edesign.damper.temperature import GammaOf
from edesign.notebook import facts_html

__all__ = ["Calibration", "Errors", "Estimate", "Series", "Stage", "Worst"]

Verdict = Literal["none", "explained", "partly_explained", "unexplained", "not_searched"]
Subject = Literal["damper", "structure"]
Ending = Literal["complete", "interrupted", "out_of_time"]
"""How a search came to its end."""


@dataclass(frozen=True)
class Coverage:
    """What a search has looked at beside the model with which it ended: labels (name.form) of forms of effects.

    Attributes:
        forms: all that the tests may show.
        screened: those of which it was seen how much they could explain.
        fitted: those that were fitted.
    """

    forms: tuple[str, ...] = ()
    screened: frozenset[str] = frozenset()
    fitted: frozenset[str] = frozenset()

    @property
    def not_screened(self) -> tuple[str, ...]:
        """Forms that were not looked at."""
        return tuple(label for label in self.forms if label not in self.screened)

    @property
    def text(self) -> str:
        """For people."""
        screened = len(self.forms) - len(self.not_screened)
        fitted = sum(label in self.fitted for label in self.forms)
        return f"{screened} of {len(self.forms)} forms of effects were screened, {fitted} fitted"


@dataclass(frozen=True)
class Estimate:
    """A number with its standard error, in one unit.

    Attributes:
        value, standard_error, unit: of the number.
        half_width: of its 95 % interval; nan: 1.96 standard errors.
        untold: why the tests do not determine it, for people; "" if they do.
    """

    value: float
    standard_error: float
    unit: str
    half_width: float = math.nan
    untold: str = ""

    @property
    def interval(self) -> tuple[float, float]:
        """95 % confidence interval."""
        half = 1.96 * self.standard_error if math.isnan(self.half_width) else self.half_width
        return self.value - half, self.value + half

    def scaled(self, scale: float, unit: str) -> Estimate:
        """The estimate in another unit, of which one is so many of that so far."""
        return replace(
            self,
            value=self.value / scale,
            standard_error=self.standard_error / scale,
            unit=unit,
            half_width=self.half_width / scale,
        )


@dataclass(frozen=True)
class Effect:
    """An effect that the model lacked.

    Attributes:
        name, form, kind: of the library.
        amendment: form by which a law file carries it (edesign.damper.amendments); "" if it cannot.
        title: for people.
        parameters: by name, SI.
        fixed: further numbers of the form, by name, SI.
        delta_validate: NRMS of the validation tests without it, the others fitted again, minus that with it.
        evidence: for people.
        share: of the excess over noise in tests left out that it removes.
        indistinguishable_from: names of effects that the tests cannot tell from it.
    """

    name: str
    form: str
    kind: Kind
    title: str
    amendment: str
    parameters: Mapping[str, Estimate]
    fixed: Mapping[str, float]
    delta_validate: float
    evidence: str
    share: float
    indistinguishable_from: tuple[str, ...]


@dataclass(frozen=True)
class Hypothesis:
    """An effect that was found, and that is no part of the corrected law.

    Attributes:
        effect: with the numbers of the model that had it.
        why: it is no part, for people.
    """

    effect: Effect
    why: str


@dataclass(frozen=True)
class NextTest:
    """A further test that would separate what these cannot.

    Attributes:
        text: for people.
        separates: names of the two effects.
        difference: NRMS between their predictions in that test.
        largest: the same in the tests that were made.
    """

    text: str
    separates: tuple[str, str]
    difference: float
    largest: float


@dataclass(frozen=True)
class CarriedLaw:
    """The corrected law as a law file can carry it.

    Attributes:
        parameters: of the law, by name, SI.
        effects: of the damper, in forms of law files.
        replaced: effects, by name and form, that no law file carries: the law has them in another form, fitted again,
            or not at all.
        validate: NRMS of the validation tests with it, and with the faults of rig and instruments.
        withheld: whether it is the refitted law without effects, as that predicts those tests better than the effects
            in forms of law files do.
    """

    parameters: Mapping[str, float]
    effects: tuple[Amendment, ...]
    replaced: tuple[str, ...]
    validate: float
    withheld: bool = False


@dataclass(frozen=True)
class LawKind:
    """A law of another kind that explains, without any effect, what the declared one leaves.

    Attributes:
        rival, title: name of that law, and what it is.
        left, rival_left: rms error over rms force of the declared and the other law, mean over the tests fitted to.
        share: of the excess over noise in the validation tests that the other law removes.
        bic: of the declared law above that of the other one.
        signs: how stiffness and damping of steady cycles differ from those of the declared law, for people.
    """

    rival: str
    title: str
    left: float
    rival_left: float
    share: float
    bic: float
    signs: tuple[str, ...]


@dataclass(frozen=True, eq=False)
class Calibration:
    """What the loop found in a campaign.

    Attributes:
        title: of the campaign.
        law: name of the declared law.
        errors: by stage.
        noise_floor: NRMS in the validation tests of the noise and of what an error of the thermometer changes;
            `noise_floor_fit` in the others.
        effects: in the order of adoption.
        verdict: none: nothing is missing; explained: what was missing is found, noise is left; partly_explained: more
            than noise is left; unexplained: something is missing and nothing known explains it; not_searched: something
            is missing, and the search ended before all known effects were tried. Noise is left where it is in every
            test, and in every channel of it.
        unexplained_share: of the error of the refitted law over noise, in the validation tests, that is left.
        unexplained_shape: for people; "" if only noise is left.
        next_test: what would separate look-alikes; None: nothing is left to separate.
        refused: effects that came nearest to being adopted, with the evidence against.
        parameters: of the law, by stage (refit: with standard errors).
        law_held: whether the corrected law keeps the declared parameters.
        series: of each test.
        seconds: that the calibration took.
        carried: the corrected law as a law file can carry it; None: the subject has no law file.
        subject: what was calibrated.
        ending: how the search for effects came to its end.
        coverage: what it has looked at.
        hypotheses: effects that were found and are no part of the corrected law.
        held: parameters of the law that are not fitted, as others do what they do: with the reason.
        lasting: whether the law remembers extremes from test to test.
        gamma_of: what gamma_T of an MGMM multiplies.
        worst: test or channel that leaves most over its noise, of those that leave more than noise; None: none does.
        fitted_first: whether the declared parameters were fitted to the tests, as the campaign names none.
        kind: what shows that the law is of the wrong kind; None: nothing does.
    """

    title: str
    law: str
    errors: Mapping[Stage, Errors]
    noise_floor: float
    noise_floor_fit: float
    effects: tuple[Effect, ...]
    verdict: Verdict
    unexplained_share: float
    unexplained_shape: str
    next_test: NextTest | None
    refused: tuple[tuple[str, str], ...]
    parameters: Mapping[Stage, Mapping[str, Estimate]]
    law_held: bool
    series: tuple[Series, ...]
    seconds: float
    carried: CarriedLaw | None = None
    subject: Subject = "damper"
    ending: Ending = "complete"
    coverage: Coverage = field(default_factory=Coverage)
    hypotheses: tuple[Hypothesis, ...] = ()
    held: Mapping[str, str] = field(default_factory=dict)
    lasting: bool = False
    gamma_of: GammaOf = "parameters"
    worst: Worst | None = None
    fitted_first: bool = False
    kind: LawKind | None = None

    def __repr__(self) -> str:
        return f"<{type(self).__name__} of {self.title}: {self.verdict_words}>"

    def _repr_html_(self) -> str:
        rows: list[tuple[str, object]] = [
            ("law", self.law),
            ("verdict", self.verdict_words),
            ("effects", [effect.name for effect in self.effects]),
            ("tests", [one.of_test for one in self.tests]),
            ("noise floor, NRMS", f"{self.noise_floor:.3g}"),
            ("what is left", self.unexplained_shape),
        ]
        return facts_html(self.title, rows)

    @property
    def verdict_words(self) -> str:
        """The verdict, for people."""
        how = "" if self.ending == "complete" else f", the search {self.ending}: {self.coverage.text}"
        return (self.verdict + how).replace("_", " ")

    @property
    def tests(self) -> tuple[Series, ...]:
        """The first series of each test."""
        first: dict[str, Series] = {}
        for one in self.series:
            first.setdefault(one.of_test, one)
        return tuple(first.values())
