"""Records of a structure as a problem of the loop: predicts the floors' motion with a building and effects."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from scipy.linalg import eigh

from edesign.calibrate.dampers.law_unknowns import held_parameters
from edesign.calibrate.noise import white_noise
from edesign.calibrate.problem import AlwaysFine, Candidate, Part, Piece, PredictionError, Use
from edesign.calibrate.structure.band import band_power
from edesign.calibrate.structure.building import Building
from edesign.calibrate.structure.campaign import Isolation, StructureCampaign
from edesign.calibrate.structure.effect import Setting, StructuralEffect, Values
from edesign.calibrate.structure.effects import MODULES
from edesign.calibrate.structure.isolation import IsolationLaw, equivalent
from edesign.calibrate.structure.links import Link, by_storey
from edesign.calibrate.structure.record import Channel, StructureTest
from edesign.calibrate.structure.simulation import NoResponse, Response, simulate
from edesign.calibrate.unknown import Unknown
from edesign.damper.law import Parameter
from edesign.damper.laws import LAWS
from edesign.errors import InputError

STIFFNESS, DAMPING = "storey_stiffness", "storey_damping"
"""Factors of what is declared."""
LEAST_NOISE = 2e-3
"""Of a test's rms: steps of records, and forces of links linear in them, leave so much."""
_FAR = 1e3  # from the declared value of a parameter, up and down
_INSIDE = 1e-6  # of the size, from a bound that is not allowed
_DRIFT = 0.1  # m, of an isolation layer whose drift is not measured
Acting = tuple[StructuralEffect, Values]


@dataclass(frozen=True, eq=False)
class StructureProblem(AlwaysFine):
    """Tests of one structure in the order in which they were made.

    A test is one row of numbers for the loop: its channels one after the other, each over the `scale` of its measure.

    Attributes:
        declared_building: stiffness, damping and masses; without its isolation layer.
        isolation: law of that layer; None: fixed base.
        refit: whether storey stiffness and damping are unknown.
        tests: in their order.
    """

    declared_building: Building
    isolation: Isolation | None
    refit: bool
    tests: tuple[StructureTest, ...]

    @staticmethod
    def of(campaign: StructureCampaign) -> StructureProblem:
        """The problem of a campaign."""
        return StructureProblem(campaign.building, campaign.isolation, campaign.refit, campaign.tests)

    @cached_property
    def names(self) -> tuple[str, ...]:
        """Of the tests."""
        return tuple(test.name for test in self.tests)

    @cached_property
    def uses(self) -> tuple[Use, ...]:
        """Of the tests."""
        return tuple(test.use for test in self.tests)

    @cached_property
    def base(self) -> tuple[Unknown, ...]:
        """Factors of storey stiffness and damping, and the parameters that the file gives for the isolation layer."""
        found: list[Unknown] = []
        if self.refit:
            found.append(Unknown(STIFFNESS, "", 0.05, 20.0, 1.0, logarithmic=True))
            found.append(Unknown(DAMPING, "", 0.02, 50.0, 1.0, logarithmic=True))
        if self.isolation is not None and self.isolation.refit:
            law = LAWS[self.isolation.law]
            known = {p.name: p for p in law.all_parameters(self.isolation.values)}
            for name in self.isolation.named:
                held = name in held_parameters(law)
                if known[name].fitted and not held and self.isolation.values[name] != 0.0:
                    found.append(_unknown(known[name], self.isolation.values[name]))
        return tuple(found)

    @cached_property
    def declared(self) -> np.ndarray:
        """Declared values of the unknowns, SI."""
        values = {STIFFNESS: 1.0, DAMPING: 1.0, **(self.isolation.values if self.isolation else {})}
        return np.array([values[unknown.name] for unknown in self.base])

    @cached_property
    def scale(self) -> Mapping[str, float]:
        """Root mean square of each measure over the tests fitted to (all, if none is)."""
        tests = [test for test in self.tests if test.use == "fit"] or list(self.tests)
        powers: dict[str, list[np.ndarray]] = {}
        for test in tests:
            for channel, values in zip(test.channels, test.values.T, strict=True):
                powers.setdefault(channel.measure, []).append(values**2)
        return {measure: float(np.sqrt(np.mean(np.concatenate(p)))) for measure, p in powers.items()}

    @cached_property
    def measured(self) -> tuple[np.ndarray, ...]:
        """Scaled channels (n_i,) of each test, one after the other."""
        return tuple(self.flat(test, test.values) for test in self.tests)

    @cached_property
    def noise(self) -> tuple[float, ...]:
        """Standard deviation of each test's noise, as it is scaled: that of its channels together."""
        return tuple(
            max(
                float(np.sqrt(np.mean((self.channel_noise(test) / self._scales(test.channels)) ** 2))),
                LEAST_NOISE * float(np.sqrt(np.mean(flat**2))),
            )
            for test, flat in zip(self.tests, self.measured, strict=True)
        )

    def channel_noise(self, test: StructureTest) -> np.ndarray:
        """Standard deviation of broadband noise of each channel (channels,), SI."""
        return np.array([white_noise(values, test.time) for values in test.values.T])

    def candidates(self, residuals: Sequence[np.ndarray]) -> tuple[Candidate, ...]:
        """Effects that the building and its channels can show, whatever the residuals are."""
        return self._forms

    @cached_property
    def _forms(self) -> tuple[Candidate, ...]:
        setting = self.setting
        found = []
        for module in MODULES:
            for effect in module.forms(setting):
                starts = effect.starts(setting)
                if starts:
                    unknowns = effect.unknowns(setting)
                    found.append(
                        Candidate(
                            effect.name,
                            effect.form,
                            effect.kind,
                            unknowns,
                            starts,
                            effect,
                            between_tests=effect.remembers,
                            usual=effect.usual,
                        )
                    )
        return tuple(found)

    @cached_property
    def setting(self) -> Setting:
        """Sizes by which effects bound their parameters."""
        building = self.building(self.declared)
        tests = [test for test in self.tests if test.use == "fit"] or list(self.tests)
        if self.isolation is not None:
            building = _linear(building, self.isolation, tests)
        measures = frozenset(channel.measure for test in tests for channel in test.channels)
        step = tests[0].step
        drift = np.max([_drifts(building, test) for test in tests], axis=0)
        return Setting(building, drift, 1.0 / first_frequency(building), step, measures)

    def building(self, base: np.ndarray) -> Building:
        """The building with values of the unknowns; its isolation layer has the linear part of its law."""
        values = {u.name: float(v) for u, v in zip(self.base, base, strict=True)}
        declared = self.declared_building
        stiffness, dashpots = declared.stiffness.copy(), declared.dashpots.copy()
        stiffness *= values.get(STIFFNESS, 1.0)
        dashpots *= values.get(DAMPING, 1.0)
        ratio = declared.damping.ratio * values.get(DAMPING, 1.0)
        law = self._law(values)
        if law is not None:
            stiffness[0], dashpots[0] = law.stiffness, law.dashpot
        return replace(declared, stiffness=stiffness, dashpots=dashpots, damping=replace(declared.damping, ratio=ratio))

    def predict(self, base: np.ndarray, parts: Sequence[Part], uses: Sequence[Use]) -> list[np.ndarray | None]:
        """Scaled channels (n_i,) of each test used so; None for others.

        Raises:
            PredictionError: there is no response with these values.
        """
        effects = [acting(part) for part in parts]
        found = self.histories(base, effects, uses)
        return [None if v is None else self.flat(test, v) for test, v in zip(self.tests, found, strict=True)]

    def histories(
        self, base: np.ndarray, effects: Sequence[Acting] = (), uses: Sequence[Use] = ("fit", "validate")
    ) -> list[np.ndarray | None]:
        """Channels (t, channels) SI of each test used so; None for others.

        Raises:
            PredictionError: there is no response with these values.
        """
        found: list[np.ndarray | None] = []
        for test, response in zip(self.tests, self.responses(base, effects, uses), strict=True):
            if response is None:
                found.append(None)
                continue
            values = np.column_stack([getattr(response, c.measure)[:, c.floor] for c in test.channels])
            for effect, p in effects:
                values = effect.channels(p, test.step, test.channels, values)
            found.append(values)
        return found

    def responses(
        self, base: np.ndarray, effects: Sequence[Acting] = (), uses: Sequence[Use] = ("fit", "validate")
    ) -> list[Response | None]:
        """Response of each test used so, as it is before instruments; None for others.

        Earlier tests are run through where an effect remembers them.

        Raises:
            PredictionError: there is no response with these values.
        """
        building = self.building(base)
        for effect, p in effects:
            building = effect.building(p, building)
        links = self._links(base)
        for effect, p in effects:
            links.extend(effect.links(p, building))
        links = by_storey(links)
        remembers = any(effect.remembers for effect, _ in effects)
        wanted = [test.use in uses for test in self.tests]
        last = max((i for i, asked in enumerate(wanted) if asked), default=-1)
        system = building.system()
        found: list[Response | None] = []
        for i, (test, asked) in enumerate(zip(self.tests, wanted, strict=True)):
            if not asked and not (remembers and i < last):
                found.append(None)
                continue
            try:
                response = simulate(system, test.base, test.step, links)
            except (NoResponse, np.linalg.LinAlgError, OverflowError) as error:
                raise PredictionError(str(error)) from error
            found.append(response if asked else None)
        return found

    def judged(self, index: int) -> tuple[Piece, ...]:
        """Each channel of a test; a quiet one has the noise of the test, for which a fit takes it."""
        return self._channels_judged[index]

    @cached_property
    def _channels_judged(self) -> tuple[tuple[Piece, ...], ...]:
        found = []
        for test, size in zip(self.tests, self.noise, strict=True):
            louder = np.maximum(self.channel_noise(test) / self._scales(test.channels) / size, 1.0)
            n = test.time.size
            pieces = (
                Piece(f"{test.name}: {channel.label}", slice(i * n, (i + 1) * n), float(louder[i]))
                for i, channel in enumerate(test.channels)
            )
            found.append(tuple(pieces))
        return tuple(found)

    def weight(self, index: int) -> np.ndarray | None:
        """None: noise is as strong at all times."""
        return None

    def left(self, residuals: Sequence[np.ndarray], noise: Sequence[float]) -> float:
        """Power of the residuals over that of noise: where the channels have theirs, or of all, whichever is more."""
        tests = [test for test in self.tests if test.use == "fit"]
        inside = expected = 0.0
        for residual, test in zip(residuals, tests, strict=True):
            for own, measured in zip(residual.reshape(len(test.channels), -1), test.values.T, strict=True):
                power, white = band_power(own, measured)
                inside += power
                expected += white
        return max(inside / expected, sum(float(r @ r) for r in residuals) / sum(r.size for r in residuals))

    def flat(self, test: StructureTest, values: np.ndarray) -> np.ndarray:
        """Channels (t, channels) SI as the loop takes them (t * channels,)."""
        return np.ascontiguousarray((values / self._scales(test.channels)).T).ravel()

    def channels(self, test: StructureTest, flat: np.ndarray) -> np.ndarray:
        """The way back: channels (t, channels) SI of what the loop takes."""
        return flat.reshape(len(test.channels), -1).T * self._scales(test.channels)

    def _scales(self, channels: Sequence[Channel]) -> np.ndarray:
        return np.array([self.scale[channel.measure] for channel in channels])

    def _law(self, values: Mapping[str, float]) -> IsolationLaw | None:
        if self.isolation is None:
            return None
        own = {**self.isolation.values, **{k: v for k, v in values.items() if k in self.isolation.values}}
        return IsolationLaw.of(self.isolation.law, own)

    def _links(self, base: np.ndarray) -> list[Link]:
        law = self._law({u.name: float(v) for u, v in zip(self.base, base, strict=True)})
        if law is None:
            return []
        try:
            return list(law.links())
        except InputError as error:
            raise PredictionError(str(error)) from error


def acting(part: Part) -> Acting:
    """An effect with its parameters by name."""
    candidate, values = part
    return candidate.effect, {u.name: float(v) for u, v in zip(candidate.unknowns, values, strict=True)}


def _unknown(parameter: Parameter, value: float) -> Unknown:
    """A parameter of a law, about its declared value."""
    size = abs(value)
    lower = parameter.lower if parameter.lower_allowed else parameter.lower + _INSIDE * size
    upper = parameter.upper if parameter.upper_allowed else parameter.upper - _INSIDE * size
    lower = max(lower, size / _FAR if parameter.lower >= 0.0 else -_FAR * size)
    return Unknown(
        parameter.name, parameter.unit, lower, min(upper, _FAR * size), size, logarithmic=parameter.lower >= 0.0
    )


def first_frequency(building: Building) -> float:
    """Frequency of the first mode without damping, Hz."""
    system = building.system()
    return float(np.sqrt(eigh(system.stiffness, np.diag(system.masses), eigvals_only=True)[0]) / (2.0 * np.pi))


def _linear(building: Building, isolation: Isolation, tests: Sequence[StructureTest]) -> Building:
    """With the secant stiffness of the isolation law at the largest drift measured."""
    law = IsolationLaw.of(isolation.law, isolation.values)
    if law.law is None:
        return building
    histories = [test.column("displacement", 0) for test in tests]
    drift = max((float(np.max(np.abs(u))) for u in histories if u is not None), default=_DRIFT)
    stiffness, mass = building.stiffness.copy(), float(building.masses.sum())
    omega = 2.0 * np.pi  # rad/s, to begin with
    for _ in range(5):
        stiffness[0] = equivalent(isolation.law, isolation.values, drift, omega)
        omega = float(np.sqrt(max(stiffness[0], 1e-12) / mass))
    return replace(building, stiffness=stiffness)


def _drifts(building: Building, test: StructureTest) -> np.ndarray:
    """Largest deformation (n,) of each storey: measured where both floors are, else of the linear building, m."""
    response = simulate(building.system(), test.base, test.step)
    found = np.max(np.abs(np.diff(response.displacement, axis=1, prepend=0.0)), axis=0)
    for i in range(building.floors):
        above = test.column("displacement", i)
        below = test.column("displacement", i - 1) if i else np.zeros(test.base.size)
        if above is not None and below is not None:
            found[i] = max(float(np.max(np.abs(above - below))), 1e-12)
    return np.asarray(np.maximum(found, 1e-12))
