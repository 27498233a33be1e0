"""A campaign of damper tests as a problem of the loop: predicts the force of every test with a law and effects."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property, lru_cache
from itertools import islice
from typing import Generic, TypeVar

import numpy as np
from scipy.interpolate import CubicHermiteSpline
from scipy.linalg import qr

from edesign.calibrate.dampers.acting import Acting, Changed, LawForce, changed_by, spring_beside
from edesign.calibrate.dampers.band import band_power
from edesign.calibrate.dampers.effect import Form, Series
from edesign.calibrate.dampers.extremes import extremes_after
from edesign.calibrate.dampers.finer import finer
from edesign.calibrate.dampers.inside import relaxation_time, without_dashpots, without_power
from edesign.calibrate.dampers.law_force import law_force
from edesign.calibrate.dampers.law_unknowns import law_unknowns
from edesign.calibrate.dampers.left import Left
from edesign.calibrate.dampers.library import candidate_of, candidates
from edesign.calibrate.dampers.own_beginning import Begun, from_own_beginnings
from edesign.calibrate.dampers.trial import REFINED, WARMER, Motion, Sizes, Trial, after
from edesign.calibrate.problem import Candidate, Part, Piece, Point, PredictionError, Use
from edesign.calibrate.unknown import Unknown
from edesign.core import CoreError
from edesign.core.damper import CoreDamper
from edesign.damper.history import NONE, Extremes
from edesign.damper.law import Law
from edesign.damper.temperature import GammaOf, GammaT, at
from edesign.damper.testing.start import BEYOND, SOFTENED, either_way
from edesign.errors import InputError

_DEPENDENT = 1e-8  # columns that others make, as a tone does that samples show as a constant
_WELL_APART = 1e-6  # ratio of eigenvalues with which squares of columns make a basis that is exact to 1e-10
_KEPT = 64  # results of the parameters last used
_ROUGH = 0.5  # of the samples, where models are only put in order
_MOTIONS = 128  # motions of a test or specimen that are not those that were recorded
_COARSE = 3  # samples of a first round with a rig in series, that finds about what it takes of the motion
_FEWEST = 4  # of them; a shorter test has the second round alone

T = TypeVar("T")


@dataclass(frozen=True, eq=False)
class DamperProblem:
    """Tests of one specimen in the order in which they were made.

    Attributes:
        law: declared.
        start: its parameters, SI.
        trials: at the rate of a fit, or at full rate.
        sizes: of the campaign.
        thermometer: standard deviation of its error, K; 0 where temperatures do not matter.
        lasting: whether the law remembers extremes from test to test; otherwise each test has a fresh specimen.
        gamma_of: what gamma_T of an MGMM multiplies.
        fineness: share of the samples that effects ask for, where tests have fewer; tests are predicted between their
            samples then.
    """

    law: Law
    start: Mapping[str, float]
    trials: tuple[Trial, ...]
    sizes: Sizes
    thermometer: float = 0.0
    lasting: bool = False
    gamma_of: GammaOf = "parameters"
    fineness: float = 1.0

    @cached_property
    def names(self) -> tuple[str, ...]:
        """Of the tests."""
        return tuple(trial.name for trial in self.trials)

    @cached_property
    def uses(self) -> tuple[Use, ...]:
        """Of the tests."""
        return tuple(trial.use for trial in self.trials)

    @cached_property
    def base(self) -> tuple[Unknown, ...]:
        """Parameters of the law."""
        return law_unknowns(self.law, self.start, self.sizes)

    @cached_property
    def declared(self) -> np.ndarray:
        """Their declared values, SI."""
        return np.array([self.start[unknown.name] for unknown in self.base])

    @cached_property
    def measured(self) -> tuple[np.ndarray, ...]:
        """Force (n_i,) N of each test."""
        return tuple(trial.force for trial in self.trials)

    def candidates(self, residuals: Sequence[np.ndarray]) -> tuple[Candidate, ...]:
        """Effects that the campaign can show."""
        fitted = [trial for trial in self.trials if trial.use == "fit"]
        relaxes = relaxation_time(self.law, self.start) is not None
        splits = without_dashpots(self.law, self.start) is not None
        powers = without_power(self.law, self.start) is not None
        return candidates(self.sizes, Left(fitted, residuals), relaxes, splits, powers)

    def finer(self, part: Part) -> tuple[Part, ...]:
        """Finer forms of an effect that was found, with the values at which they do what it does."""
        return finer(part, self.sizes, without_dashpots(self.law, self.start) is not None)

    def elsewhere(self, part: Part) -> tuple[Candidate, ...]:
        """Forms that do what a part does to the tests that are fitted to, and something else to others."""
        return self._candidates_of(part[0].effect[0].elsewhere(self.sizes))

    def simpler(self, part: Part) -> tuple[Part, ...]:
        """Nested forms that do what a part does where some of its parameters are at an end, with values near to it."""
        known = {unknown.name: float(v) for unknown, v in zip(part[0].unknowns, part[1], strict=True)}
        found = []
        for form, values in part[0].effect[0].simpler(known):
            for candidate in self._candidates_of((form,)):
                found.append((candidate, np.array([values[unknown.name] for unknown in candidate.unknowns])))
        return tuple(found)

    def _candidates_of(self, forms: Sequence[Form]) -> tuple[Candidate, ...]:
        found = (candidate_of(form, self.sizes, Left()) for form in forms)
        return tuple(candidate for candidate in found if candidate is not None)

    def law_values(self, base: np.ndarray) -> dict[str, float]:
        """Parameters of the law, all of them, of the values of the unknown ones."""
        return {**self.start, **{u.name: float(v) for u, v in zip(self.base, base, strict=True)}}

    def predict(self, base: np.ndarray, parts: Sequence[Part], uses: Sequence[Use]) -> list[np.ndarray | None]:
        """Force (n_i,) N of each test used so; None for others.

        Tests that come later than those asked for are left out; earlier ones are run through where a part remembers.
        """
        acting = [Acting.of(part) for part in parts]
        values = self.law_values(base)
        wanted = [trial.use in uses for trial in self.trials]
        if any(part.form.begins for part in acting):
            begun = self._begun(base, parts)
            return [begun(i).force if asked else None for i, asked in enumerate(wanted)]
        remembers = self.lasting or any(part.form.remembers for part in acting)
        found: list[np.ndarray | None] = []
        been = NONE
        for trial, asked in zip(self.trials, wanted, strict=True):
            force = None
            if asked or remembers:
                force, been = self._run(after(been, trial), values, acting)
            found.append(force if asked else None)
        return found

    def nuisance(
        self, base: np.ndarray, parts: Sequence[Part], index: int, about: Point | None = None
    ) -> np.ndarray | None:
        """Orthonormal columns (n_i, k) of what is each test's own; None: there is nothing."""
        own = [part for part in parts if part[0].effect[0].has_columns]
        columns = [self._kept_nuisance(tuple((_Same(c), tuple(v.tolist())) for c, v in own), index)] if own else []
        if any(part[0].effect[0].begins for part in parts):
            warm = self._begun(base, parts)(index).change
            warm = self._weighted(index, warm[:, np.newaxis])
            columns.append(warm / max(float(np.max(np.abs(warm))), 1e-300))
        start = self.trials[index].start
        if start is not None and not start.known and self.law.name in SOFTENED:
            of, at = about or (base, parts)
            softened = self._kept_softened(
                tuple(of.tolist()), tuple((_Same(c), tuple(v.tolist())) for c, v in at), index
            )
            columns += [] if softened is None else [softened]
        return columns[0] if own and len(columns) == 1 else _orthonormal(columns) if columns else None

    @cached_property
    def _kept_softened(self) -> Callable[[tuple[float, ...], tuple[_KeptPart, ...], int], np.ndarray | None]:
        """What a larger deformation or velocity before a test, of which the record does not tell, would change: columns
        (n, k), weighted, from where the start of the test has them to where no softening is left; None: nothing. Of
        the MGMM the force is linear in what is left of a softening that the test itself does not reach.
        """

        @lru_cache(maxsize=_KEPT)
        def kept(base: tuple[float, ...], parts: tuple[_KeptPart, ...], index: int) -> np.ndarray | None:
            trial, own = self.trials[index], [(candidate.thing, np.array(values)) for candidate, values in parts]

            def force_after(been: Extremes) -> np.ndarray:
                return self.force_of(index, after(been, trial), np.array(base), own)

            plain, motion = force_after(NONE), trial.motion
            far = (
                either_way(BEYOND * float(np.max(np.abs(motion.displacement))), 0.0),
                either_way(0.0, BEYOND * float(np.max(np.abs(motion.velocity)))),
            )
            changes = [self._weighted(index, (force_after(been) - plain)[:, np.newaxis]) for been in far]
            # less than one standard error in all is none
            changes = [change for change in changes if float(np.sum(change**2)) > trial.noise**2]
            return np.hstack(changes) if changes else None

        return kept

    def force_of(self, index: int, trial: Trial, base: np.ndarray, parts: Sequence[Part]) -> np.ndarray:
        """Force (n,) N of a test in the place of one of the campaign, after those before it where a part remembers."""
        acting, values, been = [Acting.of(part) for part in parts], self.law_values(base), NONE
        remembers = self.lasting or any(part.form.remembers for part in acting)
        for before in self.trials[:index] if remembers else ():
            _, been = self._run(after(been, before), values, acting)
        return self._run(after(been, trial), values, acting)[0]

    def judged(self, index: int) -> tuple[Piece, ...]:
        """The samples of a test that do not depend on how it started."""
        return (Piece(self.names[index], slice(self.trials[index].first, None)),)

    def _begun(self, base: np.ndarray, parts: Sequence[Part]) -> Callable[[int], Begun]:
        """Each test by its index, from its own beginning."""
        return self._kept_begun(tuple(base.tolist()), tuple((_Same(c), tuple(v.tolist())) for c, v in parts))

    @cached_property
    def _kept_begun(self) -> Callable[[tuple[float, ...], tuple[_KeptPart, ...]], Callable[[int], Begun]]:
        """Kept for the parameters last used: each test asks for its own, and those before it are run through."""

        @lru_cache(maxsize=1)
        def kept(base: tuple[float, ...], parts: tuple[_KeptPart, ...]) -> Callable[[int], Begun]:
            acting = [Acting.of((candidate.thing, np.array(values))) for candidate, values in parts]
            values = self.law_values(np.array(base))
            coming = from_own_beginnings(self.trials, acting, lambda trial, parts: self._run(trial, values, parts))
            found: list[Begun] = []

            def of(index: int) -> Begun:
                found.extend(islice(coming, max(index + 1 - len(found), 0)))
                if len(found) <= index:
                    raise PredictionError("a test before has no prediction")
                return found[index]

            return of

        return kept

    @cached_property
    def _kept_nuisance(self) -> Callable[[tuple[_KeptPart, ...], int], np.ndarray]:
        """Kept, as most searches move other parameters than those of the columns."""

        @lru_cache(maxsize=_KEPT)
        def kept(parts: tuple[_KeptPart, ...], index: int) -> np.ndarray:
            acting = [Acting.of((candidate.thing, np.array(values))) for candidate, values in parts]
            columns = [part.form.columns(part.p, self.trials[index]) for part in acting]
            return _orthonormal([self._weighted(index, c) for c in columns if c is not None])

        return kept

    def weight(self, index: int) -> np.ndarray | None:
        """Factors (n_i,) of the residuals of a test that make its noise as strong at all times; None: it is."""
        return self.trials[index].counted

    def _weighted(self, index: int, columns: np.ndarray) -> np.ndarray:
        weight = self.weight(index)
        return columns if weight is None else weight[:, np.newaxis] * columns

    def doubt(self, parts: Sequence[Part], index: int) -> np.ndarray | None:
        """What an error of the thermometer changes (n_i,) N; None: nothing."""
        if not self.thermometer:
            return None
        warm = tuple((_Same(c), tuple(v.tolist())) for c, v in parts if c.doubted)
        change = self._kept_warmer(warm)[index]
        return self.thermometer * change if np.any(change) else None

    @cached_property
    def _kept_warmer(self) -> Callable[[tuple[_KeptPart, ...]], tuple[np.ndarray, ...]]:
        """Change of the force (n_i,) N/K with temperature, kept: of the declared law, and of parts that know it."""

        @lru_cache(maxsize=_KEPT)
        def kept(parts: tuple[_KeptPart, ...]) -> tuple[np.ndarray, ...]:
            acting = [Acting.of((candidate.thing, np.array(values))) for candidate, values in parts]
            found = []
            been = NONE
            for trial in self.trials:
                cold = after(been, trial)
                (warmer, _), (colder, been) = (self._run(one, {**self.start}, acting) for one in (cold.warmer, cold))
                found.append((warmer - colder) / WARMER)
            return tuple(found)

        return kept

    @cached_property
    def certain(self) -> DamperProblem:
        """The same with temperatures as they were read."""
        return self.doubting(0.0)

    @cached_property
    def coarse(self) -> DamperProblem:
        """The same at the samples of the tests alone."""
        return replace(self, fineness=0.0) if self.fineness else self

    @cached_property
    def rough(self) -> DamperProblem:
        """The same at half the samples that effects ask for."""
        return replace(self, fineness=_ROUGH * self.fineness)

    def doubting(self, share: float) -> DamperProblem:
        """The same with a share of the thermometer's error; itself where that is no other."""
        error = share * self.thermometer
        return self if error == self.thermometer else replace(self, thermometer=error)

    def left(self, residuals: Sequence[np.ndarray], noise: Sequence[float]) -> float:
        """Power of the residuals in the band of the motion over that of noise there, or of all over all, whichever is
        more.

        The noise in the band is white noise as strong as above it, and what noise of the displacement makes through the
        law.
        """
        fitted = [trial for trial in self.trials if trial.use == "fit"]
        inside = expected = whole = 0.0
        for residual, trial, size in zip(residuals, fitted, noise, strict=True):
            power, white = band_power(residual, trial.motion)
            inside += power
            squares = residual.size if trial.counted is None else float(trial.counted @ trial.counted)
            through = residual.size - (1.0 - (trial.motion_noise / size) ** 2) * squares  # what is not the channel's
            expected += white + 0.5 * through  # of a one-sided spectrum
            whole += residual.size
        return max(inside / expected, sum(float(r @ r) for r in residuals) / whole)

    def _run(self, trial: Trial, values: dict[str, float], acting: Sequence[Acting]) -> tuple[np.ndarray, Extremes]:
        """Force (n,) N that is recorded, and what the law remembers after the test."""
        refined = max((part.form.refined for part in acting), default=REFINED)
        parts_of_step = trial.parts(self.fineness * refined)
        with np.errstate(all="ignore"):  # a search may ask for anything; a force that is not finite is refused
            fine = trial.finer(parts_of_step) if parts_of_step > 1 else trial
            try:
                force, own = self._recorded(fine, values, acting)
            except OverflowError as error:  # where an array has an infinite force, a number alone has this
                raise PredictionError("a force beyond all numbers") from error
        return force[::parts_of_step], extremes_after(trial.been, own) if self.lasting else NONE

    def _recorded(self, trial: Trial, values: dict[str, float], acting: Sequence[Acting]) -> tuple[np.ndarray, Motion]:
        """Force (n,) N that the load cell records, and the motion of the elastomer."""
        motion = trial.motion
        for part in acting:
            motion = _actuator(part, trial, motion)
        own = motion
        for part in acting:
            own = _specimen(part, trial, own)
        for part in acting:
            values = part.form.law(part.p, trial, values)
        own_gamma = not any(part.form.in_place_of_gamma for part in acting)
        values = self._at(trial, values) if own_gamma else self._complete(values)
        series = [s for s in (part.form.series(part.p) for part in acting) if s is not None]
        if series:
            force, own = self._in_series(trial, own, values, acting, Series.together(series))
        else:
            alone = self._law_force(values, own, trial)
            changed = self._changed(trial, own, values, acting, alone)
            force = np.asarray(changed.factor * alone + changed.parallel)
        carried = [part.form.carriage(part.p, trial, motion, force) for part in acting]
        force = sum((own for own in carried if own is not None), start=force)
        for part in acting:
            force = part.form.channel(part.p, trial, force)
        if not np.all(np.isfinite(force)):
            raise PredictionError("the force is not finite")
        return force, own

    def _changed(
        self, trial: Trial, motion: Motion, values: dict[str, float], acting: Sequence[Acting], alone: np.ndarray
    ) -> Changed:
        """What parts make of the law's force (n,) N."""

        def with_values(values: dict[str, float] | None) -> np.ndarray:
            return alone if values is None else self._law_force(values, motion, trial)

        def at_rate(gamma: float) -> np.ndarray:
            return gamma * alone if self._gamma is None else with_values(self._gamma.at_rate(values, gamma))

        law = LawForce(
            alone,
            relaxation_time(self.law, values),
            springs=lambda: with_values(without_dashpots(self.law, values)),
            powerless=lambda: with_values(without_power(self.law, values)),
            at_rate=at_rate,
        )
        return changed_by(acting, trial, motion, law)

    @cached_property
    def _gamma(self) -> GammaT | None:
        """Temperature law of the law; None: it has none of its own."""
        gamma = GammaT(of=self.gamma_of)
        return gamma if self.law.name in gamma.laws else None

    def _in_series(
        self, trial: Trial, motion: Motion, values: dict[str, float], acting: Sequence[Acting], rig: Series
    ) -> tuple[np.ndarray, Motion]:
        """Force (n,) N with the rig in series, and the motion that it leaves.

        What parts make of the law's force goes with the motion that the rig leaves to the specimen, and this with the
        force: a round at fewer samples finds that motion, the second one the force. Springs move with the specimen
        within each round.
        """
        damper = _damper(self.law.name, tuple(values.values()), trial.been)
        remembered = [dict(part.memory) for part in acting]
        needs_force = any(part.form.needs_force for part in acting)
        left, driven = motion, motion.thinned(_COARSE)
        while True:
            for part, memory in zip(acting, remembered, strict=True):
                part.memory = dict(memory)
            alone = self._law_force(values, left, trial) if needs_force else np.zeros_like(left.time)
            changed = self._changed(trial, left, values, acting, alone)
            if changed.still or driven.time.size < _FEWEST:
                driven = motion
            every = 1 if driven is motion else _COARSE
            spring = 0.0 if changed.still else spring_beside(acting, trial, left, changed.parallel)
            beside = (changed.factor, changed.parallel - spring * left.displacement, spring)
            factor, added, springs = (np.broadcast_to(b, left.time.shape)[::every] for b in beside)
            try:
                force, own = damper.force_in_series(
                    driven.time,
                    driven.displacement,
                    driven.velocity,
                    rig.stiffness,
                    rig.play,
                    factor,
                    added,
                    rig.bend,
                    rig.within,
                    springs,
                    rig.power,
                    rig.back,
                    rig.damping,
                )
            except CoreError as error:
                raise PredictionError(str(error)) from error
            if driven is motion:
                return force, motion.moved(own) if self.lasting else left
            taken = _between(driven, driven.displacement - own, motion.time)
            left = replace(motion.moved(motion.displacement - taken), passing=True)
            driven = motion

    def _law_force(self, values: Mapping[str, float], motion: Motion, trial: Trial) -> np.ndarray:
        """Force (n,) N of the law alone."""
        return law_force(self.law, values, motion, trial.been, self.start.get("v_ref"))

    def _complete(self, values: dict[str, float]) -> dict[str, float]:
        """Parameters of the law as parts have made them, in the order of the core."""
        try:
            return self.law.complete(values)
        except InputError as error:
            raise PredictionError(str(error)) from error

    def _at(self, trial: Trial, values: dict[str, float]) -> dict[str, float]:
        """Parameters of the law at the temperature of a test, in the order of the core."""
        return dict(self._kept_at(tuple(values.items()), trial.mean_temperature))

    @cached_property
    def _kept_at(self) -> Callable[[tuple[tuple[str, float], ...], float], tuple[tuple[str, float], ...]]:
        """Kept for the sets of parameters last used: most tests have one temperature."""

        @lru_cache(maxsize=_KEPT)
        def kept(values: tuple[tuple[str, float], ...], temperature_C: float) -> tuple[tuple[str, float], ...]:
            try:
                found, _ = at(self.law, dict(values), temperature_C, self._gamma)
            except InputError as error:
                raise PredictionError(str(error)) from error
            return tuple(found.items())

        return kept


def _between(coarse: Motion, values: np.ndarray, time: np.ndarray) -> np.ndarray:
    """Values (m,) at samples of a coarse motion, by cubics at times (n,); as the last one after it."""
    curve = CubicHermiteSpline(coarse.time, values, coarse.spline.slopes(values))
    return np.asarray(curve(np.minimum(time, coarse.time[-1])))


class _Same(Generic[T]):
    """A thing as a key of kept results: the same object, not an equal one."""

    def __init__(self, thing: T) -> None:
        self.thing = thing

    def __hash__(self) -> int:
        return id(self.thing)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, _Same) and other.thing is self.thing


def _orthonormal(columns: Sequence[np.ndarray]) -> np.ndarray:
    """A basis (n, k) of columns, those that depend on others left out.

    Raises:
        PredictionError: they are not finite, or their squares.
    """
    given = np.hstack(columns)
    with np.errstate(over="ignore"):
        finite = bool(np.isfinite(np.sum(given * given)))
    if not finite:
        raise PredictionError("what is each test's own is not finite")
    try:
        squares, turned = np.linalg.eigh(given.T @ given)  # a tenth of the time of the decomposition below
    except np.linalg.LinAlgError:  # nor do these searches end where dozens of columns stand twice
        squares, turned = np.zeros(1), np.eye(1)
    if squares[0] > _WELL_APART * squares[-1]:
        basis = given @ (turned / np.sqrt(squares))
    else:
        # not the singular values, whose search may not end either
        basis, corner, _ = qr(given, mode="economic", pivoting=True)
        sizes = np.abs(np.diag(corner))
        basis = basis[:, sizes > _DEPENDENT * sizes[0]]
    basis.setflags(write=False)
    return np.asarray(basis)


_KeptPart = tuple[_Same[Candidate], tuple[float, ...]]


def _damper(law: str, values: tuple[float, ...], been: Extremes) -> CoreDamper:
    try:
        return CoreDamper(law, values, been=been)
    except CoreError as error:
        raise PredictionError(str(error)) from error


def _actuator(part: Acting, trial: Trial, motion: Motion) -> Motion:
    """The motion that was made; the same object as long as it is asked for with the same parameters."""
    if type(part.form).actuator is Form.actuator:
        return motion
    return _kept_actuator(part.form, tuple(part.p.items()), trial, motion)


def _specimen(part: Acting, trial: Trial, motion: Motion) -> Motion:
    """The motion of the elastomer, likewise."""
    if type(part.form).specimen is Form.specimen:
        return motion
    return _kept_specimen(part.form, tuple(part.p.items()), trial, motion)


@lru_cache(maxsize=_MOTIONS)
def _kept_actuator(form: Form, p: tuple[tuple[str, float], ...], trial: Trial, motion: Motion) -> Motion:
    return replace(form.actuator(dict(p), trial, motion), resampled=motion.resampled)


@lru_cache(maxsize=_MOTIONS)
def _kept_specimen(form: Form, p: tuple[tuple[str, float], ...], trial: Trial, motion: Motion) -> Motion:
    return replace(form.specimen(dict(p), trial, motion), resampled=motion.resampled)
