"""What is to be expected of a test: its damper linearised, its rig and compensators as transfer functions."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from edesign.core.compensator import DifferenceEquation
from edesign.core.substructure import Recursion
from edesign.damper.harmonic import complex_stiffness
from edesign.errors import AnalysisError, InputError
from edesign.project.substructure import compensators as kinds
from edesign.substructure.advice.loaded_rig import is_unstable, loaded_poles, pole_in_words
from edesign.substructure.advice.sampled_rig import MOST_SUB_STEPS, REACH, sampled_rig
from edesign.substructure.advice.transfers import (
    CompensatorTransfer,
    actuation,
    behind,
    force_over_step,
    late,
    of_adaptive_series,
    of_live_delay,
    rig_response,
)
from edesign.substructure.computed_structure import Direct
from edesign.substructure.drive import Drive
from edesign.substructure.indicators.frequency_index import equivalent_frequency
from edesign.substructure.indicators.response_error import peak_error, response_error
from edesign.substructure.laboratory import TestedDamper
from edesign.substructure.stability.expected import DisturbedLoops
from edesign.substructure.stability.loop import Loop, RigDelayLoop, Transfer, ideal, nothing, phase_delay
from edesign.substructure.stability.margins import (
    LoopStability,
    critical_delays,
    delay_factor,
    loop_stability,
)
from edesign.substructure.stability.sampled import SampledLoop, SampledPlant, SampledStability
from edesign.substructure.stability.specimens import linearised_law, tabulated_specimen
from edesign.substructure.stability.whole import ComplexStiffness, StructureMode, WholeStructure
from edesign.substructure.structure.numerical import LinearPart
from edesign.substructure.structure.recursion import OVER_THE_STEP
from edesign.substructure.virtual_tests import VirtualLaboratory

EFFECTIVE_AMPLITUDE = 0.65
"""Of the largest deformation, at which a law stands for its motion under an earthquake.

Source: effective strain of the equivalent linear method, Schnabel, Lysmer & Seed (1972), SHAKE, report EERC 72-12.
"""
MOVES_SPECIMEN = 0.01
"""Share of a mode's stiffness from which it moves the specimen. With less, a delay of a radian takes half a percent of
damping at most, p omega tau / 2."""
FREQUENCIES = 40
"""At which the law is linearised, evenly spaced on a logarithmic scale: some ten a decade, over which it is smooth."""
LOWEST = 0.05
"""Of the lowest frequency of the structure: below, its displacements are those at rest."""
FADE = 0.1
"""Of a history, at its end: some seconds, so that the fading is slow beside the motion."""
SETTLED = 1e-6
"""Relative change of the frequency at which the law and the mode agree."""
ROUNDS = 50
UNSTABLE_RIG = "the rig itself is unstable with the specimen"
FAILS = "the specimen fails under the motion of the structure itself"


@dataclass(frozen=True)
class Linearisation:
    """Linear stiffness that stands for the damper in a test.

    Attributes:
        largest: deformation in the direct analysis, m.
        amplitude: at which the law is linearised, m.
        frequency: of the first mode that moves the specimen, Hz.
        stiffness: there, with the loss as imaginary part, N/m.
    """

    largest: float
    amplitude: float
    frequency: float
    stiffness: complex

    @property
    def loss_factor(self) -> float:
        """Loss factor: imaginary over real part of the stiffness."""
        return self.stiffness.imag / self.stiffness.real


@dataclass(frozen=True)
class ModeAdvice:
    """Mode of the structure and what the rig does to it without compensation.

    Attributes:
        number: from 1.
        without_specimen, frequency: Hz, the latter with it.
        damping: ratio, with the specimen.
        share: k_E / k, of its stiffness that is the specimen's.
        rig_delay: s, at its frequency.
        rig_amplitude: measured over command, there.
        critical_delay: of the force, at which it goes, s; inf: no delay does that.
        delay_factor: of the critical delay over that of rig and force, see `delay_factor`.
    """

    number: int
    without_specimen: float
    frequency: float
    damping: float
    share: float
    rig_delay: float
    rig_amplitude: float
    critical_delay: float
    delay_factor: float


@dataclass(frozen=True)
class ExpectedTest:
    """Expected behaviour of a test with a compensator.

    Attributes:
        compensator: its name.
        modelled_as: how the linear loop models it, in words.
        stability: verdict and margins; None: the test has no loop, or the compensator is unstable with the rig alone.
        stable: the verdict.
        delay_left: of rig, compensator and force at the mode that goes first, s; NaN: none goes.
        delay_factor: of the delay that is left and the margin over the former, see `delay_factor`.
        limited: whether limits of the file keep it from what it would find.
        tracking_rms, tracking_peak: of measured less target, over those of the target.
        response_rms: error of the deformation over that of the direct analysis; inf: it grows; NaN: there is no loop.
        response_peak: relative error of its peak.
        grows_below: amplitude below which motions grow though the test is stable at its own, m; 0: none.
        cycle_rms: most that the limit cycle of such motions may be, root mean square over that of the motion; 0: none.
        sampled: verdict on the loop in main steps, which is that of the test; None: there is none, and `stability` is.
    """

    compensator: str
    modelled_as: str
    stability: LoopStability | None
    stable: bool
    delay_left: float
    delay_factor: float
    limited: bool
    tracking_rms: float
    tracking_peak: float
    response_rms: float
    response_peak: float
    grows_below: float = 0.0
    cycle_rms: float = 0.0
    sampled: SampledStability | None = None


def force_delay(laboratory: VirtualLaboratory) -> float:
    """Return the delay of the force beside that of the rig, s: of its sensor, and half a step if it is held over it."""
    file = laboratory.file
    held = file.loop.force == "held" and file.integration.method in OVER_THE_STEP
    return laboratory.laboratory.sensors.force_delay + (0.5 * file.loop.main_step if held else 0.0)


@dataclass(frozen=True)
class LinearModel:
    """Rig, linearised damper and structure of a test.

    Attributes:
        laboratory: of the file.
        part: of the structure; None: targets are given.
        linearisation: of the damper.
        specimen: its complex stiffness.
        rig: displacement of the specimen over command.
        band: (n,) frequencies at which the law is linearised, Hz.
    """

    laboratory: VirtualLaboratory
    part: LinearPart | None
    linearisation: Linearisation
    specimen: ComplexStiffness
    rig: Transfer
    band: np.ndarray

    @classmethod
    def of(cls, laboratory: VirtualLaboratory, motion: np.ndarray, part: LinearPart | None) -> LinearModel:
        """Return the model for a test.

        Args:
            motion: (n,) deformation of the damper at main steps, of the direct analysis or as given, m.
            part: of the structure; None: the motion is given.

        Raises:
            InputError: the damper does not move, or the structure is unstable.
        """
        largest = float(np.max(np.abs(motion)))
        if largest == 0.0:
            raise InputError("the specimen does not move at all; is the record or the command zero? [E-RTS-02]")
        step, damper = laboratory.file.loop.main_step, laboratory.damper
        amplitude = EFFECTIVE_AMPLITUDE * largest
        dominant = equivalent_frequency(motion, step)
        lowest = min(dominant, *part.frequencies()[:1]) if part is not None else dominant
        band = np.geomspace(LOWEST * max(lowest, LOWEST * dominant), 0.5 / step, FREQUENCIES)
        force, deformation = damper.scales
        specimen = law_at(damper, amplitude, band)
        frequency = _first_moving(part, specimen) if part is not None else dominant
        exact = complex_stiffness(damper.values, amplitude * deformation, frequency)
        at = Linearisation(largest, amplitude, frequency, force * deformation * exact)
        rig = rig_response(laboratory.file.plant, laboratory.laboratory.transfer, specimen, step)
        return cls(laboratory, part, at, specimen, rig, band)

    @cached_property
    def whole(self) -> WholeStructure:
        """Structure with its specimen, shared by all compensators; None without a structure."""
        assert self.part is not None
        part = self.part
        return WholeStructure(part.mass, part.damping, part.stiffness, part.interface, self.specimen)

    @cached_property
    def modes(self) -> tuple[ModeAdvice, ...]:
        """The modes of the structure, from the lowest; none without a structure.

        Raises:
            InputError: a mode has no damping.
        """
        if self.part is None:
            return ()
        highest, bare = 0.5 / self.laboratory.file.loop.main_step, self.part.frequencies()
        crossings = critical_delays(self.whole, highest)
        found = []
        for number, mode in enumerate(self.whole.modes, 1):
            critical = min((one.delay for one in crossings if one.mode == number), default=math.inf)
            found.append(self._mode(number, mode, float(bare[number - 1]), critical))
        return tuple(found)

    def _mode(self, number: int, mode: StructureMode, bare: float, critical: float) -> ModeAdvice:
        delay = phase_delay(self.rig, mode.frequency)
        factor = delay_factor(critical, delay + force_delay(self.laboratory), self.laboratory.file.loop.main_step)
        amplitude = abs(complex(self.rig(np.array([1j * mode.omega]))[0]))
        share = self.whole.share_of(mode)
        return ModeAdvice(number, bare, mode.frequency, mode.damping, share, delay, amplitude, critical, factor)

    def compensator(self, name: str, motion: np.ndarray) -> CompensatorTransfer:
        """Return a compensator of the file, with the delay that it does not see.

        Args:
            motion: (n,) that an adaptive one learns from, m.
        """
        file = self.laboratory.file
        described, step = file.compensators[name], file.loop.main_step
        learned = None
        match described:
            case kinds.LiveDelayCompensator():
                delay = phase_delay(self.rig, self.linearisation.frequency)
                learned = of_live_delay(described, delay, float(np.max(np.abs(motion))), step)
            case kinds.AtsCompensator() | kinds.ModifiedAtsCompensator():
                learned = of_adaptive_series(described, self.rig, motion, step)
        return behind(file, name, self.rig, self.laboratory.laboratory.transfer, learned)

    @cached_property
    def plant(self) -> SampledPlant | None:
        """Structure and rig in main steps, shared by all compensators; None: a frame that may yield has none.

        Raises:
            InputError: the integrator of the file is unstable with its main step.
        """
        file, numerical = self.laboratory.file, self.laboratory.in_loop()
        if not isinstance(numerical, Recursion):
            return None
        step, count = file.loop.main_step, file.loop.sub_steps
        rig = sampled_rig(self.laboratory.laboratory, self._specimen_in_sub_steps(), step, count)
        roots = np.array([mode.root for mode in self.whole.modes if np.isfinite(mode.root)])
        return SampledPlant(numerical, rig, step, np.concatenate([roots, self.whole.numerical_roots]))

    def _specimen_in_sub_steps(self) -> ComplexStiffness:
        """The specimen as far up as its path in sub-steps goes, as closely as below half the rate of main steps."""
        count = REACH * min(self.laboratory.file.loop.sub_steps, MOST_SUB_STEPS)
        known = 2.0 * np.pi * self.band
        further = math.ceil(math.log(count) / math.log(self.band[-1] / self.band[-2]))
        beyond = np.geomspace(self.band[-1], count * self.band[-1], further + 1)[1:]
        damper = self.laboratory.damper
        force, deformation = damper.scales
        values = [
            force * deformation * complex_stiffness(damper.values, self.linearisation.amplitude * deformation, f)
            for f in beyond.tolist()
        ]
        frequency = np.concatenate([self.band, beyond])
        return tabulated_specimen(frequency, np.concatenate([self.specimen(known + 0j), values]))

    def sampled(self, name: str, compensator: CompensatorTransfer) -> SampledStability | None:
        """Return whether the loop in main steps is stable; None: there is no recursion of it.

        Args:
            name: of the compensator.
            compensator: of `compensator`.

        Raises:
            InputError: as `plant`, or a part of the loop is not finite.
        """
        if self.plant is None or compensator.equation is None:
            return None
        file = self.laboratory.file
        unseen = 0 if file.compensators[name].kind == "none" else file.loop.unseen_delay
        corrected = self.laboratory.laboratory.corrected
        return SampledLoop(self.plant, compensator.equation, unseen, corrected).stability()

    @property
    def unstable_pole(self) -> str:
        """The unstable pole of a rig that the specimen makes unstable, in words; empty: it is stable."""
        poles = loaded_poles(self.laboratory.file.plant, self.specimen)
        return pole_in_words(poles) if is_unstable(poles) else ""

    def rig_delay_loop(self, name: str, compensator: CompensatorTransfer) -> Loop:
        """Return the loop of a test opened at its rig, the compensator being left as it is.

        Args:
            compensator: of `compensator`.
        """
        loop = Loop(self.whole, self.seen(compensator))
        equation = self.laboratory.compensators[name]
        feeds_back = isinstance(equation, DifferenceEquation) and any(term.of == "measured" for term in equation.terms)
        if not feeds_back and compensator.force is None:
            return loop
        standing = replace(self, rig=nothing)
        opened = standing.compensator(name, np.zeros(0)) if feeds_back else compensator
        return RigDelayLoop(
            self.whole,
            loop.rig,
            still=_quiet(standing.seen(opened)),
            opened=_quiet(lambda s: np.asarray(opened.command(s) / compensator.command(s))),
        )

    def nonlinear_share(self, direct: Direct) -> float:
        """Return the share of the specimen's force in the structure itself that the linearised law does not give.

        Root mean square of the remainder over that of the force. Both fade out at the end, where a dashpot would see
        the deformation jump.

        Args:
            direct: response of the structure without laboratory.
        """
        step, size = self.laboratory.file.loop.main_step, direct.force.size
        fade = np.minimum((size - 1 - np.arange(size)) / max(FADE * size, 1.0), 1.0)
        padded = int(2 ** math.ceil(math.log2(2 * size)))
        s = 2j * np.pi * np.fft.rfftfreq(padded, step)
        spectrum = self.specimen(-1j * s) * np.fft.rfft(fade * direct.deformation, padded)
        linear, force = np.fft.irfft(spectrum, padded)[:size], fade * direct.force
        return response_error(linear, force)

    @cached_property
    def _disturbed(self) -> DisturbedLoops:
        return DisturbedLoops(self.whole, self.laboratory.file.loop.main_step)

    def expected(
        self, name: str, drive: Drive, direct: Direct | None, compensator: CompensatorTransfer
    ) -> ExpectedTest:
        """Return what is to be expected with a compensator.

        Rig and specimen are moved once as the structure itself, or the given target, moves. So their force has all
        that is not linear in the law, in the oil that it shortens, and in the adaptation. What that force changes in
        the motion of the structure follows from the linearised loop.

        Args:
            direct: analysis of the structure itself; None: the target is given.
            compensator: of `compensator`.

        Raises:
            InputError: a part of the loop has no finite transfer function.
        """
        nan, unstable_pole = math.nan, self.unstable_pole
        if unstable_pole or not compensator.settles:
            said, grown = UNSTABLE_RIG if unstable_pole else "unstable with the rig alone", math.inf
            return ExpectedTest(name, said, None, False, nan, 0.0, False, nan, nan, grown, grown)
        if direct is not None:
            return self._in_loop(name, compensator, direct)
        assert drive.target is not None
        said, limited, tracking = compensator.modelled_as, compensator.limited, (nan, nan)
        try:
            tracking = _tracking(drive.target[:, 0], self.laboratory.moved(name, drive.target).measured)
        except AnalysisError as error:
            said = f"{said}; {FAILS}: {error}"
        return ExpectedTest(name, said, None, True, nan, math.inf, limited, *tracking, nan, nan)

    def _in_loop(self, name: str, compensator: CompensatorTransfer, direct: Direct) -> ExpectedTest:
        step, loop = self.laboratory.file.loop.main_step, Loop(self.whole, self.seen(compensator))
        opened = self.rig_delay_loop(name, compensator)
        verdict = loop_stability(loop, 0.5 / step, opened if isinstance(opened, RigDelayLoop) else None)
        sampled = self.sampled(name, compensator)
        stable = verdict.stable if sampled is None else sampled.stable
        grown = math.nan if stable else math.inf
        tracking, wrong, said = (math.nan, math.nan), (grown, grown), compensator.modelled_as
        if stable:
            try:
                tracking, wrong = self._errors(name, compensator, loop, verdict, direct)
            except AnalysisError as error:
                said = f"{said}; {FAILS}: {error}"
        limited = compensator.limited
        left, factor = _delay_left(verdict, step)
        return ExpectedTest(
            name, said, verdict, stable, left, factor if stable else 0.0, limited, *tracking, *wrong, sampled=sampled
        )

    def _errors(
        self, name: str, compensator: CompensatorTransfer, loop: Loop, verdict: LoopStability, direct: Direct
    ) -> tuple[tuple[float, float], tuple[float, float]]:
        """Of tracking and of the response, root mean square and peak; NaN: the loop hardly decays.

        Raises:
            AnalysisError: the law of the specimen fails.
        """
        file = self.laboratory.file
        found = self.laboratory.moved(name, direct.deformation)
        over_step = force_over_step(file.loop.force, file.loop.main_step)
        change = self._disturbed.change(
            loop,
            verdict,
            found.applied_force,
            direct.force,
            over_step if file.integration.method in OVER_THE_STEP else ideal,
            lambda s: np.asarray(self.rig(s) * compensator.command(s)),
        )
        if change is None:
            return (math.nan, math.nan), (math.nan, math.nan)
        target, measured = direct.deformation + change.target, found.measured + change.measured
        of_force = target if found.force_is_corrected else found.deformation + change.measured
        wrong = response_error(of_force, direct.deformation), peak_error(of_force, direct.deformation)
        return _tracking(target, measured), wrong

    def seen(self, compensator: CompensatorTransfer) -> Transfer:
        """Return the force that the numerical part gets, over the force of the target, as a transfer function.

        Args:
            compensator: of the test.
        """
        file = self.laboratory.file
        sensor = self.laboratory.laboratory.sensors.force_delay
        over_step = force_over_step(file.loop.force, file.loop.main_step)
        holds = file.integration.method in OVER_THE_STEP
        moved = actuation(replace(compensator, command=late(sensor, compensator.command)), self.rig, self.specimen)

        def seen(s: np.ndarray) -> np.ndarray:
            s = np.asarray(s, dtype=complex)
            value = moved(s)
            return np.asarray(value * over_step(s) if holds else value)

        return seen


def law_at(damper: TestedDamper, amplitude: float, band: np.ndarray) -> ComplexStiffness:
    """Return a damper in the rig as it is in steady sines of one amplitude.

    Args:
        amplitude: of its deformation, m.
        band: (n,) frequencies, Hz, rising, n >= 4.
    """
    force, deformation = damper.scales
    law = linearised_law(damper.values, amplitude * deformation, band)
    return lambda omega: np.asarray(force * deformation * law(omega))


def _first_moving(part: LinearPart, specimen: ComplexStiffness) -> float:
    """Return the frequency of the first mode that moves the specimen, Hz; with the specimen's stiffness there.

    A dashpot has no stiffness that would share in that of a mode, but its force does: |k_E| counts.

    Args:
        specimen: its complex stiffness over omega.
    """

    def at(stiffness: complex) -> float:
        omega, shapes = part.modes(stiffness.real)
        shares = abs(stiffness) * (part.interface @ shapes) ** 2 / np.maximum(omega, np.finfo(float).tiny) ** 2
        moving = np.flatnonzero(shares >= MOVES_SPECIMEN)
        return float(omega[moving[0] if moving.size else np.argmax(shares)])

    omega = at(0j) or 1.0
    for _ in range(ROUNDS):
        before, omega = omega, at(complex(specimen(np.array([omega + 0j]))[0]))
        if abs(omega - before) <= SETTLED * omega:
            break
    return omega / (2.0 * math.pi)


def _delay_left(verdict: LoopStability, step: float) -> tuple[float, float]:
    """Delay that is left at the mode that goes first, and the factor on it until that goes."""
    if verdict.first_mode == 0:
        return math.nan, math.inf if verdict.stable else 0.0
    left = verdict.modes[verdict.first_mode - 1].delay
    return left, delay_factor(left + verdict.delay_margin, left, step) if verdict.stable else 0.0


def _quiet(transfer: Transfer) -> Transfer:
    """Without warnings at rest, where the integrator of a controller that is not closed is infinite."""

    def value(s: np.ndarray) -> np.ndarray:
        with np.errstate(divide="ignore", invalid="ignore"):
            return transfer(s)

    return value


def _tracking(target: np.ndarray, measured: np.ndarray) -> tuple[float, float]:
    error = measured - target
    rms = float(np.sqrt(np.mean(error**2) / np.mean(target**2)))
    return rms, float(np.max(np.abs(error)) / np.max(np.abs(target)))
