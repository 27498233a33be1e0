"""What the models of a search say of its effects, whatever the tests are of: verdict, probability, what stands."""

from __future__ import annotations

import math
import signal
import threading
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import Any, TypeVar

from edesign.calibration.residual.series import Errors, Stage
from edesign.calibration.results.fit import Kept, effect_estimates, estimates
from edesign.calibration.results.models import Posterior, without
from edesign.calibration.results.result import Effect, Hypothesis, SearchDepth, Verdict
from edesign.calibration.search.models import EffortSpentError, FittedModel, Fitter
from edesign.calibration.search.problem import Problem
from edesign.calibration.search.search import Ending, Found, Search
from edesign.calibration.search.settings import SETTINGS, SearchSettings
from edesign.errors import InputError

Progress = Callable[[str], None]
T = TypeVar("T")


@dataclass
class Steps:
    """Steps after a search: after an interrupt among them the rest is left out, after one before all that can be.

    Attributes:
        progress: told what is done.
        ending: how the search ended; interrupted if a step was.
    """

    progress: Progress
    ending: Ending
    _left: bool = False
    _raising: Any = field(default=None, init=False)  # handler of interrupts outside of `held`; None: not in it

    @contextmanager
    def held(self) -> Iterator[None]:
        """Hold interrupts back from what no result can do without; steps that are taken meanwhile end by them."""
        handler = signal.getsignal(signal.SIGINT)
        if handler is None or threading.current_thread() is not threading.main_thread():  # which alone is interrupted
            yield
            return

        def note(*_: object) -> None:
            self.ending, self._left = "interrupted", True
            self.progress("interrupted: what was found is written as it stands")

        self._raising = signal.signal(signal.SIGINT, note)
        try:
            yield
        finally:
            signal.signal(signal.SIGINT, self._raising)
            self._raising = None

    def take(self, what: str, step: Callable[[], T], instead: T, needed: bool = False) -> T:
        """Return what a step makes; what stands instead where it is interrupted or left out.

        Args:
            what: is done, for people.
            step: makes it.
            instead: of it.
            needed: whether it is taken after an interrupt of the search too.
        """
        if self._left or (self.ending == "interrupted" and not needed):
            return instead
        self.progress(what)
        holding = None if self._raising is None else signal.signal(signal.SIGINT, self._raising)
        try:
            return step()
        except KeyboardInterrupt:
            self.ending, self._left = "interrupted", True
            return instead
        finally:
            if holding is not None:
                signal.signal(signal.SIGINT, holding)


@dataclass(frozen=True, eq=False)
class Evidence:
    """What the models of a search say of the effects that it found.

    Attributes:
        fitter: of the problem at the sampling of a fit, without a limit.
        found: by the search.
        kept: the model that stands, and what was taken off it.
        validate: NRMS of the validation tests by a model; nan: it cannot predict them.
        not_carried: why no file carries an effect of a model, by its index, for people; "" if one does.
    """

    fitter: Fitter
    found: Found
    kept: Kept
    validate: Callable[[FittedModel], float]
    not_carried: Callable[[FittedModel, int], str]

    @cached_property
    def posterior(self) -> Posterior:
        """The posterior over the models of the search, about the one that stands."""
        best, final = self.found.best, self.kept.model
        if self.kept.dropped:
            best = self.fitter.fit(final.effects, final.fit.values, best.noise) or best
        return Posterior.of(self.fitter, self.found, best)

    def effects(
        self, steps: Steps, withheld: str, corrected: float
    ) -> tuple[tuple[Effect, ...], tuple[Hypothesis, ...]]:
        """Return the effects of the corrected model, and those that were found and are no part of it.

        Args:
            steps: taken after the search.
            withheld: why the effects are no part of it, for people; "" if they are.
            corrected: NRMS of the validation tests with all effects.
        """
        model = self.kept.model
        every = range(len(model.effects))
        found = steps.take(
            "comparing the models of the search",
            lambda: tuple(self._effect(self.posterior, model, i, i, corrected) for i in every),
            None,
            True,
        )
        posterior = self.posterior if found is not None else None
        dropped = [Hypothesis(self._effect(posterior, m, i, None, corrected), why) for m, i, why in self.kept.dropped]
        if found is None:  # interrupted
            found = tuple(self._effect(None, model, i, i, corrected) for i in every)
        if withheld:
            return (), (*(Hypothesis(one, withheld) for one in found), *dropped)
        return found, tuple(dropped)

    def _effect(
        self, posterior: Posterior | None, model: FittedModel, index: int, stands: int | None, corrected: float
    ) -> Effect:
        """Return an effect of a model; it is one of the model that stands, or none of that.

        Args:
            posterior: over the models of the search; None: not asked.
            model: with the effect.
            index: of the effect.
            stands: index of it in the model that stands; None: it is not in that.
            corrected: NRMS of the validation tests with it.
        """
        effect = model.effects[index]
        rise, gain, error, alike, probability = math.nan, math.nan, math.nan, dict[str, float](), math.nan
        titles: Mapping[str, str] = {}
        if posterior is not None:
            probability = posterior.probability(effect.name)
        if posterior is not None and stands is not None:
            alike, titles = posterior.indistinguishable_from(effect.name), posterior.titles(effect.name)
            fewer, ahead = without(posterior, stands)
            if fewer is not None and ahead is not None:
                gain, error = ahead.total, ahead.error
                rise = self.validate(fewer) - corrected
        return Effect(
            name=effect.name,
            form=effect.form,
            kind=effect.kind,
            title=effect.data.title,
            signature=effect.data.signature,
            parameters=effect_estimates(model, estimates(model), index),
            fixed=dict(effect.data.constants),
            delta_validate=rise,
            gain=gain,
            gain_error=error,
            probability=probability,
            indistinguishable_from=alike,
            not_carried=self.not_carried(model, index),
            meanings=effect.data.meanings,
            titles=titles,
        )


def searched(problem: Problem, settings: SearchSettings, progress: Progress, campaign: Path, model: str) -> Found:
    """Return what a search finds.

    Args:
        problem: of the tests.
        settings: of the search.
        progress: told what is done.
        campaign: the campaign file.
        model: what is declared in it, for people.

    Raises:
        InputError: the declared model cannot predict the tests, or the effort is too little to fit it.
        KeyboardInterrupt: before it was fitted.
    """
    try:
        found = Search(problem, settings, progress).run()
    except ValueError as error:
        raise InputError(f"{campaign}: {model}: {error}") from error
    except EffortSpentError:
        raise InputError(
            f"--effort {settings.effort:g}: too little to fit the {model} alone; {SETTINGS.effort:g} are usual"
        ) from None
    if found.ending == "interrupted":
        progress("interrupted: going on with what was found so far; interrupting again writes it as it stands")
    return found


def verdict_of(reached: bool, effects: bool, ending: Ending) -> Verdict:
    """Return the verdict.

    Args:
        reached: whether only noise is left.
        effects: whether there are any in the corrected model.
        ending: of the search.
    """
    if effects:
        return "explained" if reached else "partly_explained"
    if reached:
        return "none"
    return "nothing_found" if ending == "complete" else "not_searched"


def why_withheld(model: FittedModel, errors: Mapping[Stage, Errors]) -> str:
    """Return why effects are no part of the corrected model, for people: the validation tests; "" if they are.

    Args:
        model: with its effects.
        errors: by stage; corrected: with the effects.
    """
    corrected, refit = (errors[stage].validate for stage in ("corrected", "refit"))
    if not model.effects or corrected <= refit:
        return ""
    return (
        f"with the effects the validation tests are predicted worse ({100.0 * corrected:.3g} %) than without them "
        f"({100.0 * refit:.3g} %)"
    )


def unexplained_share(errors: Mapping[Stage, Errors], noise: float) -> float:
    """Return the share of the excess over noise of the refitted model that is left in the validation tests.

    Args:
        errors: by stage.
        noise: NRMS of noise in these tests.
    """
    over = max(errors["refit"].validate - noise, 1e-300)
    return min(max((errors["corrected"].validate - noise) / over, 0.0), 1.0)


def depths_of(found: Found) -> tuple[SearchDepth, ...]:
    """Return the rounds of a search for people."""
    return tuple(
        SearchDepth(
            _labels(one.best), one.screening.screened, one.fitted, () if one.adopted is None else _labels(one.adopted)
        )
        for one in found.depths
    )


def _labels(model: FittedModel) -> tuple[str, ...]:
    return tuple(effect.label for effect in model.effects)
