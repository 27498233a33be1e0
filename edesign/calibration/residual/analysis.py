"""Analysis of what a model leaves unexplained in a campaign."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from edesign.calibration.residual.against import Dependence, against
from edesign.calibration.residual.harmonics import Harmonics, harmonics
from edesign.calibration.residual.lag import Lag, find_lag
from edesign.calibration.residual.loops import Loop, residual_loop
from edesign.calibration.residual.maps import ResidualMap, residual_map
from edesign.calibration.residual.motion import Motion
from edesign.calibration.residual.pool import Pool
from edesign.calibration.residual.record import Residual
from edesign.calibration.residual.shape import describe
from edesign.calibration.residual.tones import Tone, find_tones
from edesign.calibration.residual.whiteness import Whiteness, whiteness
from edesign.errors import InputError


@dataclass(frozen=True)
class ResidualOfTest:
    """What is left in one test.

    Attributes:
        name: of the test.
        use: `fit` or `validate`.
        nrms: sum of the squared residual over that of the measured force.
        whiteness: structure and noise.
        tones: strongest first.
        harmonics: of each steady part.
        loop: the mean cycle; None if the test is not periodic.
    """

    name: str
    use: str
    nrms: float
    whiteness: Whiteness
    tones: tuple[Tone, ...]
    harmonics: tuple[Harmonics, ...]
    loop: Loop | None


@dataclass(frozen=True)
class ResidualAnalysis:
    """What is left in all tests.

    Attributes:
        tests: each by itself, in the order given.
        against: dependences on drivers, in both ways.
        lag: of the measured force.
        map: over displacement and velocity.
        shape: one or two sentences.
    """

    tests: tuple[ResidualOfTest, ...]
    against: tuple[Dependence, ...]
    lag: Lag
    map: ResidualMap
    shape: str


def analyse(tests: Sequence[Residual], motions: Sequence[Motion] | None = None) -> ResidualAnalysis:
    """Analyse the residuals of tests.

    Args:
        tests: residuals.
        motions: of each; give them to analyse several models, as the search for cycles takes half of the time.

    Raises:
        InputError: there are none.
    """
    if not tests:
        raise InputError("a residual analysis needs at least one test")
    motions = motions or [Motion(test.time, test.displacement) for test in tests]
    singles = tuple(_single(test, motion) for test, motion in zip(tests, motions, strict=True))
    samples = [single.whiteness.effective_samples for single in singles]
    lag = find_lag(tests)
    pool = Pool(tests, motions, samples, lag.value)
    shape = describe(tests, [single.whiteness for single in singles], pool, [single.tones for single in singles])
    return ResidualAnalysis(singles, against(pool), lag, residual_map(tests), shape)


def _single(test: Residual, motion: Motion) -> ResidualOfTest:
    return ResidualOfTest(
        test.name,
        test.use,
        test.nrms,
        whiteness(motion, test.residual),
        find_tones(motion, test.residual),
        harmonics(test, motion),
        residual_loop(test, motion),
    )
