"""One design at hand, whatever its method: what its loop changes, all rounds, and what is made of them."""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from functools import cached_property, partial
from typing import Any, ClassVar, Generic, TypeVar, cast

import numpy as np

from edesign.archive.dataset import Group
from edesign.codes.device_factors import NONE
from edesign.damper.factored import force_ratio
from edesign.errors import AnalysisError, InputError
from edesign.ground_motion.hazard import rules_in_force
from edesign.project.analysis_file import AnalysisFile
from edesign.project.dampers.dampers import Brace, BraceStiffness, Dampers
from edesign.project.dampers.designs import DesignRun, Optimum, SizedDesign, StrainEnergyDesign
from edesign.project.reading.words import percent
from edesign.study.design.beside import NOTHING_BESIDE, Standing, standing
from edesign.study.design.bounds import Bound, analyse_bounds
from edesign.study.design.braces import Numbers, history_forces
from edesign.study.design.building import Building, make_building, per_storey, sized_dampers
from edesign.study.design.device_model import DeviceModel, Sizing
from edesign.study.design.device_text import devices_text
from edesign.study.design.estimate import Action, FrameEstimate, action_of, make_action
from edesign.study.design.fully_stressed import StoreySizes, search_fully_stressed
from edesign.study.design.loop import LARGEST_FACTOR, Round, RoundOutcome, Search, search
from edesign.study.design.optimum import search_optimum
from edesign.study.design.plausibility import shared_mode
from edesign.study.design.results import (
    Results,
    of_storeys,
    store_bounds,
    store_braces,
    store_estimate,
    store_iterations,
    store_plan_modes,
    store_rounds,
    store_sizing,
)
from edesign.study.design.verification import Judge, Respond, histories_at, judged, kept_outcome, mean_drift

S = TypeVar("S", bound=Sizing)


class Designer(ABC, Generic[S]):
    """The sizing and verification of one design by one method.

    Attributes:
        words: of what the loop may change, by its name.
        target_word: what the target of this design is, for people.
        results: what is archived of its dampers.
        model: of its dampers in the frame.
        factors: of the code, on stroke and velocity of the dampers, and on what holds them.
    """

    words: ClassVar[Mapping[str, str]]
    target_word: str = "target damping"
    results: ClassVar[Results]
    model: DeviceModel[Any, Any]

    def __init__(
        self,
        project: AnalysisFile,
        name: str,
        spec: SizedDesign,
        progress: Callable[[str], None],
        beside: Standing = NOTHING_BESIDE,
    ) -> None:
        self.name, self.project, self.progress = name, project, progress
        self._spec = spec
        self.building: Building = make_building(project, name, spec, beside)
        self.action: Action | None = make_action(project, spec)
        self.factors = NONE
        self._share: np.ndarray | None = None
        self._lightest: Numbers = ()

    @property
    @abstractmethod
    def target(self) -> float:
        """What the dampers are first sized for, in the quantity of the method; nan: a drift."""

    @abstractmethod
    def largest(self, target: float) -> float:
        """Return the largest target to which the loop may go from the first one."""

    @abstractmethod
    def sized(self, target: float, factor: float) -> S:
        """Size the dampers for a target, with a factor on what the loop changes if that is not the target."""

    @abstractmethod
    def device(self, sizing: S) -> dict[str, Any]:
        """Return the keys of a device of the project file that say how large the dampers of a sizing are."""

    @abstractmethod
    def modes(self, sizing: S) -> Any:
        """Return the modes with the dampers of a sizing, of which the columns `modes` of the results are."""

    @abstractmethod
    def state(self, sizing: S) -> Any:
        """Return the state of the model in which the dampers of a sizing count."""

    @abstractmethod
    def bound(self, sizing: S, action: Action, name: str, factor: float, temperature_C: float | None) -> Bound:
        """Estimate the response with a bound of the dampers' properties.

        Args:
            action: spectrum, and damping ratio of the frame without dampers.
            factor: property modification factor.
            temperature_C: of the dampers, degC; None: that of the design.
        """

    @abstractmethod
    def further(self, group: Group, done: Search[S], found: FrameEstimate | None) -> list[str]:
        """Add what the law itself says to the group of a design; return what is implausible, a sentence each.

        Args:
            done: all rounds and the chosen one.
            found: the estimated response; None: the design has no level.
        """

    def make(self, value: float) -> S:
        """Size the dampers for a value of the quantity that the loop changes, and their braces for these."""
        if self.changed == "target":
            return self.braced(lambda: self.sized(value, 1.0))
        return self.braced(lambda: self.sized(self.target, value))

    def braced(self, size: Callable[[], S]) -> S:
        """Return a sizing whose braces hold its dampers; as it is where the braces have no sections.

        From the lightest sections on, those that do not hold the dampers become heavier, and the dampers are sized anew
        behind them, until all hold. Where histories are to decide, an estimate that no section holds has the strongest.

        Args:
            size: makes a sizing with the present braces.

        Raises:
            InputError: no section of the lists holds the dampers.
        """
        model = self.model
        if model.holding is None:
            return size()
        numbers, undecided = self._lightest or model.holding.first(), self._spec.verify is not None
        while True:
            model.hold(numbers)
            sizing = replace(size(), braces=numbers)
            if sizing.reason or not model.holding.chosen:
                return sizing
            strongest = undecided and self._share is None
            following = model.holding.following(numbers, self._factored(sizing), strongest)
            if following == numbers:
                return sizing
            numbers = following

    @property
    def _overstrength(self) -> float:
        """The factor on the force of the dampers that their braces hold: of the design, else of the code."""
        given = getattr(getattr(self._spec, "brace", None), "overstrength", None)
        return self.factors.overstrength if given is None else float(given)

    @cached_property
    def _brace_action(self) -> Action:
        """The spectrum whose forces the braces hold: of their own level, else that of the design."""
        level = getattr(getattr(self._spec, "brace", None), "level", None)
        inherent = self._spec.inherent_damping
        action = self.action if level is None else action_of(self.project, level, inherent)
        if action is None:
            raise InputError("level: this key is missing; braces are held to the forces that it gives [E-KEY-02]")
        return action

    @property
    def _brace_level(self) -> str:
        return str(getattr(getattr(self._spec, "brace", None), "level", None) or self._spec.level or "")

    def _factored(self, sizing: S) -> np.ndarray:
        """Force of the dampers of each place that their braces hold, (d,) N, with all factors and upper properties."""
        found = [self._estimate(sizing)]
        if self._spec.bounds is not None:
            found.append(
                analyse_bounds(self._spec.bounds, partial(self.bound, sizing, self._brace_action))[-1].response
            )
        shares = 1.0 if self._share is None else self._share[self.building.place_storey]
        forces = [response.damper_force * self._ratio(sizing, response) for response in found]
        return np.asarray(self._overstrength * shares * np.max(forces, axis=0))

    def _estimate(self, sizing: S, action: Action | None = None) -> FrameEstimate:
        """The response at the level of the braces, or under another action, with the amplitude that belongs to it."""
        action = action or self._brace_action
        if action is self.action:
            return self.model.estimate(self.state(sizing), action)
        return self.bound(sizing, action, "nominal", 1.0, None).response

    def _compare(self, chosen: Round[S]) -> None:
        """Learn what the forces of histories are of the estimated ones, at the level of the braces or of the design."""
        outcome = chosen.outcome
        if outcome is None or not outcome.force:
            return
        action = self._brace_action if outcome.force_level == self._brace_level else self.action
        estimated = of_storeys(self.building, self._estimate(chosen.sizing, action).damper_force)
        self._share = np.array(outcome.force) / estimated

    def _brace_use(self, one: Round[S]) -> float:
        """The largest N_Ed / N_b,Rd of the braces of a round by the forces of its histories; nan: they are not known.

        What later sizings learn of histories stays as it is.
        """
        model, share = self.model, self._share
        if model.holding is None or one.outcome is None or not one.outcome.force:
            return math.nan
        model.hold(one.sizing.braces)
        self._compare(one)
        use = model.holding.use(one.sizing.braces, self._factored(one.sizing)).use
        self._share = share
        return float(use.max())

    def _ratio(self, sizing: S, response: FrameEstimate) -> np.ndarray:
        """Force of the dampers at stroke and velocity times the factors of the code over that without, (d,)."""
        law, of = self.building.law, response.dampers
        strokes = of["stroke"] if "stroke" in of else of["strain"] * (law.layer_thickness or 0.0)
        velocities = of.get("velocity", 2.0 * math.pi * self.frequency(sizing) * strokes)
        on_stroke, on_velocity = self.factors.stroke, self.factors.velocity
        both = zip(strokes * self.building.deformation_scale, velocities, strict=True)
        return np.array([force_ratio(law.law, float(x), float(v), on_stroke, on_velocity) for x, v in both])

    @abstractmethod
    def frequency(self, sizing: S) -> float:
        """Return the frequency of the first mode with the dampers of a sizing, Hz."""

    def _agrees(self, last: Round[S]) -> bool:
        """Whether braces that were chosen hold the forces of the histories; if not, later ones are chosen for these."""
        model = self.model
        if model.holding is None or last.outcome is None or not last.outcome.force:
            return True
        model.hold(last.sizing.braces)
        self._compare(last)
        numbers = last.sizing.braces
        try:
            return model.holding.following(numbers, self._factored(last.sizing)) == numbers
        except InputError:
            return False

    def range(self) -> tuple[float, float]:
        """Return the first and the largest value of the quantity that the loop changes."""
        if self.changed != "target":
            return 1.0, LARGEST_FACTOR
        target = self.target
        return target, target if math.isnan(target) or self._spec.verify is None else self.largest(target)

    def take(self, sizing: S) -> None:
        """Let the frame be that of a sizing, where dampers carry gravity loads; it does nothing for others."""

    def standing(self, sizing: S) -> Standing:
        """Return the dampers of a sizing as the designs beside this one see them."""
        self.take(sizing)
        stiffness = self.model.complex_stiffness(self.state(sizing))
        return standing(self.dampers(sizing), self.building.names, stiffness)

    def dampers(self, sizing: S) -> Dampers:
        """Return the project's dampers with those of a sizing."""
        model, brace = self.model, cast(Brace, "rigid")
        if model.holding is not None:
            brace = model.holding.sections(sizing.braces)
        elif model.brace is not None:
            brace = BraceStiffness.model_construct(stiffness=per_storey(model.brace / self.building.attachment()))
        return sized_dampers(self.building, self._spec, brace, self.device(sizing))

    def _identity(self, sizing: S) -> Mapping[str, float | np.ndarray]:
        """What identifies the dampers of a sizing, by the name of the archived variable `round_NAME`."""
        columns, only = {name: of for name, _, of, _, _ in self.results.rounds}, Round(1, math.nan, sizing)
        found = {name: columns[name](self.model, only) for name in self.results.identity}
        if self.model.holding is not None:
            found["brace_stiffness"] = self.model.holding.horizontal(sizing.braces)
        return found

    def group(self, done: Search[S], status: str) -> Group:
        """Return the archived group of a design.

        Args:
            done: all rounds and the chosen one.
            status: completed, failed, interrupted or checked.
        """
        self.take(done.chosen.sizing)
        spec, model, results, sizing = self._spec, self.model, self.results, done.chosen.sizing
        model.hold(sizing.braces)
        group = Group(attributes=labels(spec) | {"status": status, "reason": done.reason})
        store_sizing(group, model, results, sizing, self.modes(sizing))
        store_plan_modes(group, model, self.state(sizing))
        store_iterations(group, model, results, done.rounds)
        self.store_steps(group, done, status)
        store_rounds(group, model, results, done.rounds, self.words[self.changed])
        group.attributes["chosen_round"] = done.chosen.number
        found, action = None, self.action
        if action is not None:
            found = model.estimate(self.state(sizing), action)
            store_estimate(group, model, results, found, model.bare_estimate(action))
            if spec.bounds is not None:
                bounds = analyse_bounds(spec.bounds, partial(self.bound, sizing, action))
                store_bounds(group, model, results, bounds)
        state = self.state(sizing)
        modes = model.building.frame.modes(model.storage(state))
        if model.building.frame.beside is not None:
            group.attributes["beside_damping"] = modes.first_beside_damping
        warnings = [*shared_mode(modes, model.losses(state, modes)), *self.further(group, done, found)]
        if model.holding is not None and action is not None:
            warnings += self._store_braces(group, done.chosen)
        group.attributes["warnings"] = list(dict.fromkeys(warnings))
        group.attributes["devices"] = devices_text(self.dampers(sizing))
        return group

    def _store_braces(self, group: Group, chosen: Round[S]) -> list[str]:
        """Add the check of the braces to the group; return a sentence where they do not hold the dampers."""
        model, sizing = self.model, chosen.sizing
        assert model.holding is not None
        self._compare(chosen)
        shares = np.ones(self.building.storeys.size) if self._share is None else self._share
        use = model.holding.use(sizing.braces, self._factored(sizing))
        estimated = self._estimate(sizing)
        factor = of_storeys(self.building, self._overstrength * self._ratio(sizing, estimated))
        store_braces(group, model, use, factor, shares)
        group.attributes |= {"brace_level": self._brace_level, "brace_overstrength": self._overstrength}
        beyond = np.flatnonzero(use.use > 1.0)
        if not beyond.size:
            return []
        most = int(np.argmax(use.use))
        storeys = ", ".join(str(storey) for storey in self.building.storeys[beyond])
        by = " by the estimate" if self._share is None else ""
        force, resistance = 1e-3 * use.force[most], 1e-3 * use.resistance[most]
        return [
            f"the braces do not hold the dampers in storey {storeys}{by}: most in storey "
            f"{self.building.storeys[most]}, {use.section[most]} with N_Ed = {force:.4g} kN of N_b,Rd = "
            f"{resistance:.4g} kN"
        ]

    def store_steps(self, group: Group, done: Search[S], status: str) -> None:
        """Add to the group of a design what its method alone has on the way to a sizing, or beside it."""

    def strain(self, sizing: S, histories: Sequence[Group]) -> float:
        """Return the effective shear strain of the layers in histories of a sizing; nan for dampers without layers."""
        return math.nan

    def least(self) -> tuple[S, StoreySizes, Callable[[np.ndarray], S]] | None:
        """Return the first dampers of a search for the least sum, their sizes, and how others of sizes (s,) are made.

        None: one number changes all dampers.
        """
        return None

    def settled(self, last: Round[S]) -> bool:
        """Return whether properties and braces that a round was sized with agree with its histories."""
        return self._agrees(last)

    @property
    def changed(self) -> str:
        """The quantity that the loop changes."""
        return self._spec.verify.change if self._spec.verify is not None else "target"

    def search(
        self, respond: Respond | None, judge: Judge | None, resume: Group | None, keep: Callable[[Group], None] | None
    ) -> Search[S]:
        """Size the dampers, and change them round by round until the criteria are met, or an objective is least.

        Args:
            respond: runs the histories of a round; None: the design is not verified.
            judge: judges the histories of a round; None: the design is not verified.
            resume: the group that an earlier run kept; None: none.
            keep: called with the group after each round, for `resume`; None: nothing is kept.

        Returns:
            All rounds and the chosen one.
        """
        start, largest = self.range()
        verify = self._spec.verify
        if verify is None or respond is None or judge is None:
            sizing = self.make(start)
            only = Round(1, self._value(sizing, start), sizing)
            return Search((only,), only, sizing.reason)

        least = self.least()
        tried = self._outcomes(respond, judge, resume, least is not None, verify.rounds)
        kept = self._kept(keep)
        optimum: Optimum | None = getattr(self._spec, "optimum", None)
        if optimum is not None:
            ends = (optimum.range, optimum.least, verify.rounds, verify.precision)
            done = search_optimum(self.make, tried, *ends, kept)
        elif least is not None:
            first, sizes, made = least
            done = search_fully_stressed(first, made, tried, sizes, verify.rounds, verify.precision, kept, self.settled)
            per_size = sizes.first / first.size
            return self._until_held(done, tried, kept, lambda one: made(per_size * one.sizing.size))
        else:
            limits = (start, largest, verify.rounds, verify.precision)
            done = search(self.make, tried, *limits, kept, self._value, self.settled)
        return self._until_held(done, tried, kept, lambda one: self.make(one.changed))

    def _until_held(
        self,
        done: Search[S],
        verify: Callable[[S, int, float], RoundOutcome],
        kept: Callable[[Sequence[Round[S]]], None],
        again: Callable[[Round[S]], S],
    ) -> Search[S]:
        """Give the chosen round braces that hold the forces of its histories, in rounds beyond those of its search.

        Each has the same target with heavier braces, until they hold, or no section of the lists does.

        Args:
            verify: returns the outcome of a sizing, of its round from 1, and of its value.
            kept: called with all rounds after each.
            again: sizes the dampers of a round anew, behind braces that hold the forces of its histories.
        """
        holding, rounds, one = self.model.holding, list(done.rounds), done.chosen
        if done.reason or holding is None or not holding.chosen:
            return done
        before = one.outcome
        while one.outcome is not None and one.outcome.brace_use > 1.0:
            self.model.hold(one.sizing.braces)
            self._compare(one)
            try:
                self._lightest = holding.following(one.sizing.braces, self._factored(one.sizing))
                sizing = again(one)
            except (InputError, AnalysisError) as error:
                return Search(tuple(rounds), one, str(error))
            one = Round(len(rounds) + 1, one.changed, sizing, verify(sizing, len(rounds) + 1, one.changed))
            rounds.append(one)
            kept(rounds)
        missed = before is not None and before.met and one.outcome is not None and not one.outcome.met
        reason = f"with braces that hold its dampers it misses: {one.outcome.misses}" if missed and one.outcome else ""
        return Search(tuple(rounds), one, reason)

    def _outcomes(
        self, respond: Respond, judge: Judge, resume: Group | None, drifts: bool, rounds: int
    ) -> Callable[[S, int, float], RoundOutcome]:
        """The function that verifies a sizing by its histories, or takes the outcome of an earlier run."""
        last: list[tuple[S, float]] = []

        def outcome(sizing: S, number: int, value: float) -> RoundOutcome:
            found = kept_outcome(resume, number, value, self._identity(sizing))
            if found is not None:
                self.progress(f"round {number} is already there")
                return with_braces(sizing, number, value, found)
            told = f"{value:.4g}" if self.changed != "target" or self.target_word == "beta" else percent(value)
            word = self.target_word if self.changed == "target" else self.words[self.changed]
            most = f"of at most {rounds}" if number <= rounds else "for heavier braces"
            again = self._again(last[-1][0], sizing) if last and last[-1][1] == value else ""
            last.append((sizing, value))
            self.progress(f"round {number} {most}, {word} {told}{again}")
            histories = respond(self.dampers(sizing), number)
            at_level = histories_at(self._spec.level, self._spec.verify, histories)
            drift = mean_drift(at_level, self._spec.along) if drifts else ()
            found = replace(judged(histories, judge), strain=self.strain(sizing, at_level), drift=drift)
            if self.model.holding is None:
                return found
            levels = {str(group.attributes.get("level") or ""): None for group in histories.values()}
            level = next((one for one in (self._brace_level, self._spec.level or "") if one in levels), "")
            rules = rules_in_force(self.project.hazard)
            force = history_forces(histories, level, self.building.storeys, self.building.names, rules)
            return with_braces(sizing, number, value, replace(found, force=force, force_level=level))

        def with_braces(sizing: S, number: int, value: float, found: RoundOutcome) -> RoundOutcome:
            return replace(found, brace_use=self._brace_use(Round(number, value, sizing, found)))

        return outcome

    def _again(self, before: S, sizing: S) -> str:
        """What a round with the same value as the one before has that this had not, in words."""
        more = [i for i, (a, b) in enumerate(zip(before.braces, sizing.braces, strict=True)) if a != b]
        found = [f"other braces in storey {', '.join(str(self.building.storeys[i]) for i in more)}"] if more else []
        now, then = self.taken_strain(sizing), self.taken_strain(before)
        found += [f"{percent(now)} strain, not {percent(then)}"] if abs(now - then) > 0.0 else []
        return f", with {' and '.join(found)}" if found else ""

    def taken_strain(self, sizing: S) -> float:
        """Return the strain of histories at which properties were taken; nan where it is not followed, or no layers."""
        return math.nan

    def _kept(self, keep: Callable[[Group], None] | None) -> Callable[[Sequence[Round[S]]], None]:
        """The function that keeps all rounds after each of them; it does nothing where `keep` is None."""

        def kept(rounds: Sequence[Round[S]]) -> None:
            if keep is not None:
                last = rounds[-1]
                keep(self.group(Search(tuple(rounds), last, "the design is not complete"), "interrupted"))

        return kept

    def _value(self, sizing: S, value: float) -> float:
        """The value that a sizing really has: the simplified method may take a larger beta than it is asked for."""
        return sizing.target if self.changed == "target" else value


def labels(spec: SizedDesign) -> dict[str, Any]:
    """Return the attributes of the archive that identify a design."""
    runs = spec.runs
    found: dict[str, Any] = {"method": spec.method, "law": spec.law}
    found |= {"kind": ", ".join(dict.fromkeys(run.kind for run in runs))}
    found["bays"] = _of_runs(runs, [str(run.bays) for run in runs])
    if spec.along is not None:
        found |= {"along": spec.along, "frames": _of_runs(runs, [str(run.frames) for run in runs])}
    if spec.beside:
        found["beside"] = list(spec.beside)
    found |= {"state": spec.state, "level": spec.level or ""}
    found["changed"] = spec.verify.change if spec.verify is not None else "target"
    if hasattr(spec, "distribution"):
        found["distribution"] = spec.distribution
    if (damping := getattr(spec, "damping", None)) is not None:
        found["damping_target"] = damping
    if isinstance(spec, StrainEnergyDesign):
        found["braces_in_target"] = spec.counts_braces
    return found


def _of_runs(runs: Sequence[DesignRun], values: Sequence[str]) -> str:
    """What dampers of all kinds have in common, or what those of each kind have."""
    if len(set(values)) == 1:
        return values[0]
    return "; ".join(f"{value} ({run.kind})" for run, value in zip(runs, values, strict=True))
