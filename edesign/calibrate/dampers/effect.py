"""What an effect is: a plug-in that changes how the force of a test is predicted.

The prediction of a test runs through these stages; a form of an effect overrides those at which it acts:

    measured motion -> `actuator`  the motion that the rig really made (faults of the displacement channel)
                    -> `specimen`  the motion of the elastomer inside (pre-shear, backlash)
                    -> `law`       parameters of the law in this test (temperature)
                    -> force of the law, in series with the rig if a part gives `series`
                    -> `factor`    factors of the law's force (softening, damage, heat)
                    -> `heated`    the law's force with parameters that change within a test
                    -> `parallel`  forces beside it (springs, branches)
                    -> `carriage`  forces of what moves with the actuator (guides, masses): a rig that gives stands
                                   between them and the specimen
                    -> `channel`   what the load cell and its amplifier make of the sum
                    -> `columns`   shares that are each test's own (phase of hum), projected out of the residual

Tests are predicted in their order; `memory` is a dict of the part's own, empty in the virgin specimen, in which a form
carries what the specimen remembers from one test to the next."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from copy import copy
from typing import Any, ClassVar, NamedTuple

import numpy as np

from edesign.calibrate.dampers.left import Left
from edesign.calibrate.dampers.trial import REFINED, Motion, Sizes, Trial, Values
from edesign.calibrate.problem import Described, Kind, PredictionError
from edesign.calibrate.unknown import Unknown

_LEAST = 1e-6  # factor of which a negative power is taken
Memory = dict[str, Any]
BEGUN = "begun"
"""In a memory: by how much more the state at the beginning of a test is than what is left from before."""
BESIDE = "beside"
"""In a memory of a form that counts work: force (n,) N in the specimen beside the law's."""
DASHPOTS = "dashpots"
"""In a memory of a form that counts work and tells springs from dashpots: share (n,) N of dashpots in the force that it
is given.
"""


class Series(NamedTuple):
    """What stands in series with the specimen (CoreDamper.force_in_series).

    Attributes:
        stiffness: N/m.
        bend: by which it stiffens, 1/m2.
        play: end to end, m, across which the stiffness is `within`, N/m.
        power: with which the force goes, if none of the above: stiffness z |sqrt(bend) z|^(power - 1), z the stretch.
        back: times as stiff where it is pushed together.
        damping: beside all of it, N s/m.
    """

    stiffness: float
    bend: float = 0.0
    play: float = 0.0
    within: float = 0.0
    power: float = 1.0
    back: float = 1.0
    damping: float = 0.0

    @property
    def soft(self) -> float:
        """Stiffness about rest, N/m."""
        return self.within if self.play > 0.0 else self.stiffness

    @staticmethod
    def together(each: Sequence[Series]) -> Series:
        """One behind the other: compliances add, plays too; ends of soft parts are where the same force closes them.
        Damping is taken to be little.

        Raises:
            PredictionError: one stiffens with a power of its stretch, or is stiffer to one side, and there is another.
        """
        if len(each) == 1:
            return each[0]
        if any(one.power > 1.0 or one.back != 1.0 for one in each):
            raise PredictionError("a rig that stiffens with a power, or is lopsided, has no other one in series")
        stiffness = 1.0 / sum(1.0 / one.stiffness for one in each)
        # e = F/s - b (F/s)^3 of each, for a little bend
        bend = sum(one.bend * (stiffness / one.stiffness) ** 3 for one in each)
        # 1/(s + i w c) = 1/s - i w c/s^2
        damping = sum(one.damping * (stiffness / one.stiffness) ** 2 for one in each)
        if any(one.soft == 0.0 for one in each):
            return Series(stiffness, bend, sum(one.play for one in each), damping=damping)
        within = 1.0 / sum(1.0 / one.soft for one in each)
        return Series(stiffness, bend, sum(one.play * one.within for one in each) / within, within, damping=damping)


class Form:
    """One form of an effect.

    Attributes:
        name: of the effect, shared by its forms.
        form: how it acts.
        kind: whose the effect is: damper, rig, instrument.
        title: for people.
        signature: what it leaves in the residual of a model without it, for people.
        source: paper, book.
        remembers: whether `memory` carries something from test to test.
        by_order: whether what it does to a test goes with its place among the tests.
        usual: size of its first parameter, from where that does nothing, that is usual; more is an exception.
        may_be_inside: whether its factor or force may also stand inside the law, where what relaxes in the law relaxes
            it too.
        inside: whether it does.
        may_spare_loss: whether its factor may change the law's dashpots less, or more, than its springs, or them alone.
        loss_start: exponent of the dashpots from which a search goes.
        spares_loss: whether it does, see `dashpot_factor`.
        of_mgmm: whether it is one of its own only for the MGMM, whose springs soften and which has gamma_T.
        in_place_of_gamma: whether the law's own gamma_T does not act where it does.
        spares_springs: whether it changes dashpots alone.
        may_be_of_power: whether its factor may act on the law's dashpot of a power of the velocity alone.
        of_power: whether it does.
        of_temperature: whether an error of the thermometer changes what it does.
        beside_motion: whether it is slower or faster than all motion, so that nothing else does what it does.
        counts_work: whether its factor follows the work done on the specimen: the force that it is given has the
            factors of forms that do not, and `BESIDE` is the force beside it.
        elastic: whether its force beside the law goes with the deformation alone.
        has_columns: whether a share of it is each test's own, see `columns`.
        may_be_shaped: whether a finer form of it has a curve of its own (`edesign.calibrate.dampers.finer`).
        begins: whether its state at the beginning of a test is that test's own, by `BEGUN` more than what is left from
            before.
        refined: times the samples of a fit at which it is predicted: more for motions and forces that bend or turn
            between them.
        amendment: whether a law file can carry it (edesign.damper.amendments has this name and form, or
            `amendment_form` where there is one).
    """

    name: ClassVar[str]
    form: ClassVar[str]
    kind: ClassVar[Kind]
    title: ClassVar[str]
    signature: ClassVar[str]
    source: ClassVar[str]
    amendment: ClassVar[bool] = False
    remembers: ClassVar[bool] = False
    by_order: ClassVar[bool] = False
    usual: ClassVar[float] = math.inf
    refined: int = REFINED
    may_be_inside: ClassVar[bool] = False
    inside = False
    may_spare_loss: ClassVar[bool] = False
    loss_start: ClassVar[float] = 0.0
    spares_loss: bool = False
    spares_springs: bool = False
    of_mgmm: bool = False
    in_place_of_gamma: bool = False
    may_be_of_power: ClassVar[bool] = False
    of_power: bool = False
    has_columns: bool = False
    of_temperature: ClassVar[bool] = False
    beside_motion: ClassVar[bool] = False
    counts_work: ClassVar[bool] = False
    elastic: ClassVar[bool] = False
    begins: bool = False
    may_be_shaped: bool = True

    def unknowns(self, sizes: Sizes) -> tuple[Unknown, ...]:
        """Parameters with bounds that suit a campaign; () if the campaign cannot show the effect."""
        raise NotImplementedError

    def starts(self, sizes: Sizes) -> tuple[tuple[float, ...], ...]:
        """Values (SI) to start from, a grid over what acts non-linearly; amplitudes about a twentieth of the force."""
        raise NotImplementedError

    def starts_from_residuals(self, sizes: Sizes, left: Left) -> tuple[tuple[float, ...], ...]:
        """The starts, if they depend on what is left of the tests."""
        return self.starts(sizes)

    def fixed(self, sizes: Sizes) -> Mapping[str, float]:
        """Numbers of the form that are no unknowns (a reference, a side), SI; they are in `p` of the stages too."""
        return {}

    def actuator(self, p: Values, trial: Trial, motion: Motion) -> Motion:
        """The motion that was made, of the one that was measured."""
        return motion

    def specimen(self, p: Values, trial: Trial, motion: Motion) -> Motion:
        """The motion of the elastomer, of that of the specimen."""
        return motion

    def law(self, p: Values, trial: Trial, values: dict[str, float]) -> dict[str, float]:
        """Parameters of the law in this test."""
        return values

    def series(self, p: Values) -> Series | None:
        """What stands in series with the specimen; None: nothing."""
        return None

    def factor(
        self, p: Values, trial: Trial, motion: Motion, force: np.ndarray, memory: Memory
    ) -> np.ndarray | float | None:
        """Factor (n,) of the law's force (n,) N; None: the form is no factor."""
        return None

    def spring_factor(self, p: Values, factor: np.ndarray | float) -> np.ndarray | float:
        """Factor of the law's springs, or of all of it, of the form's factor: 1 where it spares springs, or itself."""
        return 1.0 if self.spares_springs else factor

    def dashpot_factor(self, p: Values, motion: Motion, factor: np.ndarray | float) -> np.ndarray | float:
        """Factor of the law's dashpots where the form spares loss or springs, of its factor: factor^loss, or itself."""
        return factor if self.spares_springs else np.asarray(np.maximum(factor, _LEAST) ** p["loss"])

    def left_by(
        self, p: Values, motion: Motion, force: np.ndarray, memory: Memory
    ) -> Callable[[np.ndarray], np.ndarray]:
        """What a factor (n,) of a form that counts work leaves of the force (n,) N that it is given."""
        if not self.spares_loss:
            return lambda factor: factor * force
        dashpots = memory[DASHPOTS]
        springs = force - dashpots

        def left(factor: np.ndarray) -> np.ndarray:
            own = self.dashpot_factor(p, motion, factor) * dashpots
            return np.asarray(self.spring_factor(p, factor) * springs + own)

        return left

    def heated(
        self, p: Values, motion: Motion, at_rate: Callable[[float], np.ndarray], memory: Memory
    ) -> np.ndarray | None:
        """Force (n,) N beside that of the law where all of the law's parameters change in a test as with temperature.

        Args:
            p: parameters.
            motion: of the specimen.
            at_rate: force (n,) N of the law with a gamma_T that is so many times as large.
            memory: of the part.

        Returns:
            None: the form does not change them.
        """
        return None

    def parallel(self, p: Values, trial: Trial, motion: Motion, memory: Memory) -> np.ndarray | float | None:
        """Force (n,) N beside that of the law; None: the form is none."""
        return None

    def carriage(self, p: Values, trial: Trial, motion: Motion, force: np.ndarray) -> np.ndarray | None:
        """Force (n,) N of guides and masses under the motion that was made, besides the one (n,) N that goes through
        them to the specimen; None: the form is none.
        """
        return None

    def channel(self, p: Values, trial: Trial, force: np.ndarray) -> np.ndarray:
        """The force that is recorded, of the true one (n,) N."""
        return force

    def variant(self, ending: str, title: str, **changes: Any) -> Form:
        """The same with another ending of its name and title, and other attributes; no law file carries it unless they
        say so.
        """
        other = copy(self)
        vars(other).update({"form": f"{self.form}_{ending}", "title": f"{self.title}, {title}", "amendment": False})
        vars(other).update(changes)
        return other

    def within(self) -> Form:
        """The same inside the law."""
        carried = f"{getattr(self, 'amendment_form', self.form)}_inside"
        return self.variant("inside", "inside the law", inside=True, amendment=self.amendment, amendment_form=carried)

    def sparing_loss(self) -> Form:
        """The same with an exponent of its own for the dashpots."""
        unknowns, starts = self.unknowns, self.starts

        def more_unknowns(sizes: Sizes) -> tuple[Unknown, ...]:
            own = unknowns(sizes)
            return (*own, Unknown("loss", "", -1.0, 8.0, 1.0)) if own else ()

        def more_starts(sizes: Sizes) -> tuple[tuple[float, ...], ...]:
            return tuple((*row, self.loss_start) for row in starts(sizes))

        sides = {
            "spares_loss": True,
            "unknowns": more_unknowns,
            "starts": more_starts,
            "simpler": lambda p: ((self, p),),
        }
        return self.variant("loss", "springs and dashpots apart", **sides)

    def of_loss(self) -> Form:
        """The same for the dashpots alone."""
        return self.variant("of_loss", "dashpots alone", spares_loss=True, spares_springs=True)

    def of_power_law(self) -> Form:
        """The same for the law's dashpot of a power of the velocity alone."""
        sides = {"of_power": True, "spares_loss": False, "spares_springs": False, "may_be_shaped": False}
        return self.variant("of_power", "that of the power of the velocity alone", **sides)

    @property
    def needs_force(self) -> bool:
        """Whether what it does beside a factor of the law's force goes with that force itself."""
        return self.counts_work or self.inside or self.spares_loss or self.of_power

    @property
    def described(self) -> Described:
        """What people and files are told of the form, without the numbers that a campaign fixes."""
        amendment = getattr(self, "amendment_form", self.form) if self.amendment else ""
        return Described(self.title, self.signature, amendment)

    def finer(self) -> tuple[Form, ...]:
        """Finer forms that a search would be lost in, for when this one was found; each has its parameters first."""
        return ()

    def simpler(self, p: Values) -> tuple[tuple[Form, Values], ...]:
        """Nested forms, of other effects too, that do the same where some parameters are at an end, with the values at
        which they come near to this one.
        """
        return ()

    def elsewhere(self, sizes: Sizes) -> tuple[Form, ...]:
        """Forms that do the same to the tests that are fitted to, and something else to others."""
        return ()

    def columns(self, p: Values, trial: Trial) -> np.ndarray | None:
        """Columns (n, k) whose share is each test's own; None: there are none."""
        return None
