"""A damper law in place of the specimen of a laboratory: trials, commits, and what a real damper could not do."""

from __future__ import annotations

from edesign.core.damper import CoreDamper
from edesign.errors import AnalysisError
from edesign.substructure.server.protocol import Measured, Motion

EXPLICIT = "NewmarkExplicit, or AlphaOS with alpha = 1"
"""Integrators of OpenSees that move an element once a step, to where the step ends.

CentralDifference sends two displacements a step. KRAlphaExplicit with rho = 1 sends the motion of half a step, which is
not seen here: the peak of thesis 6.2.5 becomes 5 % too large.
"""

STEP_AT_REST = 1e-3
"""s: duration of the step whose stiffness is returned before the first motion, as in usual tests. Laws that relax have
a stiffness for each duration."""


class RefusedMotion(AnalysisError):
    """Error: the specimen cannot do a motion."""


class MountedSpecimen:
    """A damper that starts at rest at time 0, undeformed, and is moved step by step.

    A trial always starts at the end of the last committed step, so that asking twice does not move it twice.

    Args:
        damper: law of the specimen, at the size of the device.
        allow_iterations: whether a step may have trials with different displacements. A real damper cannot go back.
    """

    def __init__(self, damper: CoreDamper, allow_iterations: bool = False) -> None:
        self._damper, self._allow = damper, allow_iterations
        self._state = self._trial_state = damper.start()
        _, _, (stiffness, _) = damper.step(self._state, STEP_AT_REST, (0.0, 0.0), (0.0, 0.0))
        self.committed = self.trial = Measured(0.0, 0.0, 0.0, 0.0, stiffness)
        self.steps = 0
        self.trials = 0

    @property
    def under_way(self) -> bool:
        """True if a step is begun and not committed."""
        return self.trial.time > self.committed.time

    def move(self, motion: Motion) -> None:
        """Try a motion from the committed state on: the cubic through displacements and velocities at its ends.

        Without a velocity the motion is a straight line. A trial with the displacement of the one before, as explicit
        integrators send it when they know the velocity better, takes that one's place.

        Raises:
            RefusedMotion: time runs backwards, or stands still while the specimen moves; a second displacement in one
                step, unless iterations are allowed; or the law has no force there.
        """
        self._check(motion)
        before, duration = self.committed, motion.time - self.committed.time
        if duration == 0.0:
            self._wait(motion)
            return
        self.trials += 1
        u0, v0, u1, v1 = before.displacement, before.velocity, motion.displacement, motion.velocity
        if v1 is None:
            v0 = v1 = (u1 - u0) / duration
        try:
            state, force, (stiffness, _) = self._damper.step(self._state, duration, (u0, v0), (u1, v1))
        except AnalysisError as error:
            what = f"from {1e3 * u0:.6g} mm to {1e3 * u1:.6g} mm in {duration:.6g} s"
            raise RefusedMotion(
                f"the specimen's law has no force at t = {motion.time:.9g} s, {what}: {error}"
            ) from error
        self._trial_state = state
        self.trial = Measured(motion.time, u1, v1, force, stiffness)

    def commit(self) -> bool:
        """Keep the last trial; return whether it was a step: whether time went on."""
        stepped = self.under_way
        self.steps += stepped
        self._state, self.committed = self._trial_state, self.trial
        return stepped

    def _wait(self, motion: Motion) -> None:
        """Take the velocity with which a motion begins; nothing moves yet."""
        last, velocity = self.committed, motion.velocity
        self._trial_state = self._state
        self.trial = (
            last if velocity is None else Measured(last.time, last.displacement, velocity, last.force, last.stiffness)
        )

    def _check(self, motion: Motion) -> None:
        last = self.committed
        if motion.time < last.time:
            raise RefusedMotion(
                f"time runs backwards, from {last.time:.9g} s to {motion.time:.9g} s: the specimen cannot; "
                "serve anew for a new analysis, also after loadConst -time [E-SERVE-02]"
            )
        if motion.time == last.time and motion.displacement != last.displacement:
            raise RefusedMotion(
                f"the specimen shall jump from {1e3 * last.displacement:.6g} mm to {1e3 * motion.displacement:.6g} mm "
                f"at t = {last.time:.9g} s; a test begins at rest and undeformed, and takes time to move [E-SERVE-02]"
            )
        if self._allow or not self.under_way or motion.displacement == self.trial.displacement:
            return
        raise RefusedMotion(
            f"a second trial in the step to t = {motion.time:.9g} s: {1e3 * motion.displacement:.6g} mm after "
            f"{1e3 * self.trial.displacement:.6g} mm. A damper cannot take a trial back: use an integrator without "
            f"iterations ({EXPLICIT}), or allow iterations, which only a virtual specimen can follow [E-SERVE-02]"
        )
