"""What a calibration found: the errors before and after, the effects, and what the tests cannot decide."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Literal, Protocol

from edesign.calibration.residual.curves import FreeCurve
from edesign.calibration.residual.series import Errors, Series, Stage, Worst
from edesign.calibration.search.problem import Kind
from edesign.calibration.search.search import Ending
from edesign.damper.effects import LawEffect
from edesign.damper.temperature import FerryShift, GammaOf, GammaT
from edesign.damper.testing.measured_histories import Use
from edesign.notebook import facts_html
from edesign.project.document import Document

Subject = Literal["damper", "structure", "table"]
"""What was measured: tests of a damper, records of a structure, a table of a damper's moduli."""

Verdict = Literal["none", "explained", "partly_explained", "nothing_found", "not_searched"]


@dataclass(frozen=True)
class Estimate:
    """A number with its 95 % interval, in one unit.

    Attributes:
        value, standard_error, unit: of the number; the error is 0 where it was not fitted.
        interval: lowest and highest value that the tests leave, at 95 %; not symmetric where a logarithm was fitted.
        not_determined: why the tests do not determine it, for people; "" if they do.
    """

    value: float
    standard_error: float
    unit: str
    interval: tuple[float, float]
    not_determined: str = ""

    @staticmethod
    def fixed(value: float, unit: str) -> Estimate:
        """Return a number that was not fitted."""
        return Estimate(value, 0.0, unit, (value, value))

    def scaled(self, scale: float, unit: str) -> Estimate:
        """Return the estimate in another unit.

        Args:
            scale: one of that unit, in the unit so far.
        """
        low, high = self.interval
        return replace(
            self,
            value=self.value / scale,
            standard_error=self.standard_error / scale,
            unit=unit,
            interval=(low / scale, high / scale),
        )


@dataclass(frozen=True)
class Effect:
    """An effect that the model lacked.

    Attributes:
        name, form, kind: of the library.
        title, signature: for people: what it is, and what it leaves in the residual of a model without it.
        parameters: by name, SI.
        fixed: further numbers of the form, by name, SI.
        delta_validate: NRMS of the validation tests without it, the others fitted again, minus that with it.
        gain, gain_error: by how much better tests left out are predicted with it (log density), and the error of that.
        probability: of an effect of this name, over all models of the search.
        indistinguishable_from: probability, beside the corrected model and at most one half, of others that explain the
            tests as well in its place, by name.
        not_carried: why no law file carries it, for people; "" if one does.
        meanings: of its parameters by name, for people, as far as no law file has them.
        titles: of those that it is indistinguishable from, by name, for people.
        other_kind, other_title: of the same equation as a part of something else, which no test can tell from it; None:
            there is none, or the campaign says what it belongs to.
    """

    name: str
    form: str
    kind: Kind
    title: str
    signature: str
    parameters: Mapping[str, Estimate]
    fixed: Mapping[str, float]
    delta_validate: float
    gain: float
    gain_error: float
    probability: float
    indistinguishable_from: Mapping[str, float]
    not_carried: str = ""
    meanings: Mapping[str, str] = field(default_factory=dict)
    titles: Mapping[str, str] = field(default_factory=dict)
    other_kind: Kind | None = None
    other_title: str = ""

    @property
    def label(self) -> str:
        """Name and form."""
        return f"{self.name}.{self.form}"

    @property
    def question(self) -> str:
        """What the campaign should say of it, as force and motion cannot, for people; "" if there is nothing to ask."""
        if self.other_kind is None:
            return ""
        return (
            f"{self.title}, or {self.other_title}: force and motion cannot tell. It is taken as the former; the key "
            f"`belongs_to: {{{self.name}: damper}}` or `{{{self.name}: rig}}` of the campaign file says which it is"
        )


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
class Fault:
    """A fault of an instrument in one test, with which that test agrees with the others.

    Attributes:
        name, form: of the library.
        title: what it is, for people.
        parameters: by name, SI.
    """

    name: str
    form: str
    title: str
    parameters: Mapping[str, Estimate]

    @property
    def label(self) -> str:
        """Name and form."""
        return f"{self.name}.{self.form}"


@dataclass(frozen=True)
class OutlyingTest:
    """A test that does not agree with the others.

    Attributes:
        name, use: of the test.
        ratio: Student's t of the logarithm of what it leaves, left out, beside what the others leave.
        chance: probability of such a ratio in any one of the tests, at most.
        others_with, others_without: NRMS of all other tests, with this one in the fit and without it.
        only_noise: whether the others leave only noise without it.
        faults: of instruments, each of which explains it alone, the likeliest first; (): none that is known does.
        beyond: in what it goes beyond all others: displacement, velocity, temperature.
    """

    name: str
    use: Use
    ratio: float
    chance: float
    others_with: float
    others_without: float
    only_noise: bool
    faults: tuple[Fault, ...]
    beyond: tuple[str, ...]


@dataclass(frozen=True)
class ComparedModel:
    """A model of the search.

    Attributes:
        effects: labels of its effects; () is the law alone.
        refit: whether the parameters of the law are fitted; otherwise they are as declared.
        nrms: of the tests fitted to.
        behind, error: log density of tests left out by which the corrected model is ahead, and the error of that.
        probability: among all models of the search that may be adopted.
        why_not: why it is not the corrected model although it is ahead, or may not be adopted, for people; "" if it is
            behind.
    """

    effects: tuple[str, ...]
    refit: bool
    nrms: float
    behind: float
    error: float
    probability: float
    why_not: str = ""


@dataclass(frozen=True)
class SearchDepth:
    """A round of the search.

    Attributes:
        beside: labels of the effects of the model beside which effects were screened.
        screened: forms of effects that were predicted.
        fitted: models that were fitted.
        adopted: labels of the effects after it; (): nothing passed.
    """

    beside: tuple[str, ...]
    screened: int
    fitted: int
    adopted: tuple[str, ...]


@dataclass(frozen=True)
class NextTest:
    """A further test that would separate what these cannot.

    Attributes:
        text: for people.
        separates: labels of two models.
        difference: NRMS between their predictions in that test.
        largest: the same in the tests that were made.
    """

    text: str
    separates: tuple[str, str]
    difference: float
    largest: float


@dataclass(frozen=True)
class LawFile:
    """The law as the law file has it: exactly what was found, as far as a law file can carry it.

    Attributes:
        stage: whose parameters it has.
        parameters: of the law, by name, SI.
        effects: effects of the damper.
        temperature: how parameters change with temperature, if that was found or is the law's own; None: not said.
        measurement_effects: of rig and instruments, which are no part of a damper.
        lacking: labels of effects of the damper that it cannot carry.
        validate: NRMS of the validation tests with this law, and with what rig and instruments did.
        withheld: why it is not the corrected law, for people; "" if it is.
        brace: of the damper too, which no law file has, as a project has it in series with the law; "": nothing.
        otherwise: by label of what is taken for rig or instruments and may be of the damper: effects that it has then.
    """

    stage: Stage
    parameters: Mapping[str, float]
    effects: tuple[LawEffect, ...]
    temperature: GammaT | FerryShift | None
    measurement_effects: tuple[str, ...]
    lacking: tuple[str, ...]
    validate: float
    withheld: str = ""
    brace: str = ""
    otherwise: Mapping[str, tuple[LawEffect, ...]] = field(default_factory=dict)


@dataclass(frozen=True)
class OtherLaw:
    """A law of the registry that, without any effect, predicts tests better than the declared one.

    Attributes:
        law, title: its name, and what it is.
        gain, error: by how much better than the declared law fitted again (log density), and the error of that.
        nrms, own_nrms: of the tests fitted to: its own, and that of the declared law fitted again.
        validate, own_validate: of the validation tests.
        sure: whether the gain passes the rule of adoption; it is not small otherwise either.
    """

    law: str
    title: str
    gain: float
    error: float
    nrms: float
    own_nrms: float
    validate: float
    own_validate: float
    sure: bool = True


@dataclass(frozen=True)
class OfTest:
    """A number of a test, with its standard error given the noise.

    Attributes:
        value, error: of the number; of a wave of its amplitude.
        phase, phase_error: of a wave value sin(2 pi f t + phase), t from the first sample, rad; nan: it is none.
    """

    value: float
    error: float
    phase: float = math.nan
    phase_error: float = math.nan


@dataclass(frozen=True)
class OfTests:
    """What belongs to single tests, and is another number in each of them.

    Attributes:
        of: label of the effect; or `start`, what a specimen that moved before had inside it at the first sample; or
            name of what is not known of the tests.
        name: what the number is.
        unit: SI.
        tests: number of each test that has one, by its name.
        frequency: of a wave; None: it is none.
    """

    of: str
    name: str
    unit: str
    tests: Mapping[str, OfTest]
    frequency: Estimate | None = None


class Tested(Protocol):
    """A campaign, whatever its tests are of."""

    @property
    def path(self) -> Path:
        """The campaign file."""

    @property
    def text(self) -> str:
        """Text of the campaign file."""

    @property
    def label(self) -> str:
        """Title, or else the name of what was tested."""

    @property
    def document(self) -> Document:
        """For the cover of a report."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Calibrated:
    """What was calibrated: a campaign, and its model at each stage.

    Attributes:
        campaign: of tests of a damper, records of a structure, or a table of moduli.
        subject: what was measured.
        law: name of the declared law; "" of a structure on a fixed base.
        parameters: of the law, by stage.
        law_fixed: whether the campaign keeps the declared parameters fixed.
        as_declared: whether the corrected model has the declared parameters, although they might be fitted.
        fixed: parameters of the law that are not fitted, as others do what they do: with the reason.
        law_file: the law as the law file has it; of a structure that of its isolation layer, if it has one.
        series: of each test, or each channel of it; () of a table.
        lasting: whether the law remembers extremes from test to test.
        gamma_of: what gamma_T of an MGMM multiplies.
        fitted_first: whether the declared parameters were fitted to the tests, as the campaign names none.
        nuisances: what belongs to single tests, as their zeros.
    """

    campaign: Tested
    subject: Subject
    law: str
    parameters: Mapping[Stage, Mapping[str, Estimate]]
    law_fixed: bool
    fixed: Mapping[str, str] = field(default_factory=dict)
    law_file: LawFile
    series: tuple[Series, ...] = ()
    lasting: bool = False
    gamma_of: GammaOf = "parameters"
    fitted_first: bool = False
    as_declared: bool = False
    nuisances: tuple[OfTests, ...] = ()

    @property
    def title(self) -> str:
        """Title of the campaign, or else the name of what was tested."""
        return self.campaign.label


@dataclass(frozen=True, eq=False, kw_only=True)
class Calibration(Calibrated):
    """What a calibration found in a campaign.

    Errors are NRMS: of a table the mean squares of relative errors of G', G_eq and loss factor.

    Attributes:
        verdict: none: nothing is missing; explained: what was missing is found, noise is left; partly_explained: more
            than noise is left; nothing_found: something is missing, and no effect known here passes; not_searched:
            something is missing, and the search ended before all known effects were screened. Noise is left where it
            is in every test.
        ending: how the search came to its end.
        errors: by stage.
        noise_floor: NRMS in the validation tests of what no model can predict, and of what an error of the thermometer
            changes; `noise_floor_fit` in the others.
        interpolation: the part of it of what is not known of motions between samples; `interpolation_fit` as above.
        doubtful: why the floor does not say whether only noise is left, for people; "" if it does.
        effects: in the order of adoption, and in a round of what they explain.
        hypotheses: effects that were found and are no part of the corrected law.
        unexplained_share: of the error of the refitted law over noise, in the validation tests, that is left.
        unexplained_shape: for people; "" if only noise is left.
        unexplained_curves: what smooth functions of displacement and velocity take of it; () of anything but a damper.
        models: of the search, the most probable first.
        depths: rounds of the search.
        forms: number of forms of effects that the tests may show.
        effort: weighted evaluations that the search took, of at most `most_effort`; `effort_by_step`: what for.
        next_test: what would separate confounded effects; None: nothing is left to separate, or no test would.
        other_law: a law that does better; None: none does, or none was asked for.
        outlying: tests that do not agree with the others.
        worst: test that leaves most over its noise, of those that leave more than noise; None: none does.
        seconds: that the calibration took.
        failed: steps after the search that failed, by what they do, with the reason, for people.
    """

    verdict: Verdict
    ending: Ending
    errors: Mapping[Stage, Errors]
    noise_floor: float
    noise_floor_fit: float
    effects: tuple[Effect, ...]
    hypotheses: tuple[Hypothesis, ...]
    unexplained_share: float
    unexplained_shape: str
    models: tuple[ComparedModel, ...]
    depths: tuple[SearchDepth, ...]
    forms: int
    effort: float
    most_effort: float
    effort_by_step: Mapping[str, float] = field(default_factory=dict)
    next_test: NextTest | None = None
    other_law: OtherLaw | None = None
    outlying: tuple[OutlyingTest, ...] = ()
    worst: Worst | None = None
    interpolation: float = 0.0
    interpolation_fit: float = 0.0
    doubtful: str = ""
    seconds: float = 0.0
    failed: Mapping[str, str] = field(default_factory=dict)
    unexplained_curves: tuple[FreeCurve, ...] = ()

    def __repr__(self) -> str:
        return f"<{type(self).__name__} of {self.title}: {self.verdict_words}>"

    def _repr_html_(self) -> str:
        rows: list[tuple[str, object]] = [
            ("law", self.law),
            ("verdict", self.verdict_words),
            ("effects", [effect.label for effect in self.effects]),
            ("tests", [one.name for one in self.tests]),
            ("noise floor, NRMS", f"{self.noise_floor:.3g}"),
            ("what is left", self.unexplained_shape),
        ]
        return facts_html(self.title, rows)

    @property
    def verdict_words(self) -> str:
        """The verdict, for people."""
        how = "" if self.ending == "complete" else f", the search {self.ending}".replace("effort_", "effort was ")
        return (self.verdict + how).replace("_", " ")

    @property
    def more_is_left(self) -> bool:
        """Whether more than noise is left."""
        return self.verdict not in ("none", "explained")

    @property
    def tests(self) -> tuple[Series, ...]:
        """Series, one of each test."""
        first: dict[str, Series] = {}
        for one in self.series:
            first.setdefault(one.of_test, one)
        return tuple(first.values())
