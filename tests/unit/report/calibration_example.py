"""A calibration whose numbers follow from a closed form: a spring and dashpot seen through a channel with a gain."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np

from edesign.calibration.residual.series import Errors, Series, Stage
from edesign.calibration.results.result import (
    Calibration,
    ComparedModel,
    Effect,
    Estimate,
    LawFile,
    NextTest,
    SearchDepth,
)
from edesign.damper.testing.campaign import Campaign
from edesign.damper.testing.measured_histories import Use

K, C = 2.0e6, 4.0e4  # N/m, N s/m
GAIN = 0.05
NOISE = 20.0  # N, of alternating sign: its mean square is known exactly
TESTS: tuple[tuple[str, float, float, Use], ...] = (
    ("slow", 0.5, 0.004, "fit"),
    ("fast", 2.0, 0.002, "validate"),
)


def series_of(name: str, frequency: float, amplitude: float, use: Use, order: int, noise: float = NOISE) -> Series:
    """Ten cycles, 50 samples each, of a force with 5 % gain that the declared law does not know."""
    time = np.arange(500) / (50.0 * frequency)
    phase = 2.0 * np.pi * frequency * time
    u, v = amplitude * np.sin(phase), 2.0 * np.pi * frequency * amplitude * np.cos(phase)
    law = K * u + C * v
    measured = (1.0 + GAIN) * law + noise * (-1.0) ** np.arange(500)
    predicted: dict[Stage, np.ndarray] = {"declared": law, "refit": 1.04 * law, "corrected": (1.0 + GAIN) * law}
    return Series(name, f"{frequency:g} Hz", use, order, time, u, v, measured, predicted, np.full(500, 20.0), noise)


def nrms(series: Sequence[Series], stage: Stage) -> float:
    """Over all samples of some tests."""
    squared = sum(float(np.sum((one.measured - one.predicted[stage]) ** 2)) for one in series)
    return squared / sum(float(np.sum(one.measured**2)) for one in series)


def estimate(value: float, error: float, unit: str, not_determined: str = "") -> Estimate:
    """A number with the interval of a normal distribution, two standard errors to each side."""
    return Estimate(value, error, unit, (value - 2.0 * error, value + 2.0 * error), not_determined)


def gain(error: float = 5e-4) -> Effect:
    """The effect that the data hide."""
    return Effect(
        name="gain",
        form="force",
        kind="instrument",
        title="gain of the force channel",
        signature="proportional to the force itself",
        parameters={"g": estimate(GAIN, error, "")},
        fixed={},
        delta_validate=1.1e-4,
        gain=120.0,
        gain_error=9.0,
        probability=0.97,
        indistinguishable_from={},
        not_carried="it is no part of the damper",
    )


def lag() -> Effect:
    """An effect with a time: 4 ms."""
    text = "lag between the channels of force and displacement"
    return replace(gain(), name="lag", form="delay", title=text, parameters={"lag": estimate(0.004, 1e-4, "s")})


def payne() -> Effect:
    """An effect of the damper, with lengths and times."""
    parameters = {
        "d": estimate(0.2, 0.01, ""),
        "a0": estimate(0.003, 2e-4, "m"),
        "m": estimate(1.0, 0.1, ""),
        "tau_a": estimate(5.0, 0.5, "s"),
    }
    title = "softening with amplitude of the whole force"
    confounded = {"mullins": 0.02, "self_heating": 5e-5}
    base = replace(gain(), signature="the secant stiffness falls with the amplitude", indistinguishable_from=confounded)
    carried = replace(base, kind="damper", not_carried="")
    return replace(carried, name="payne", form="whole", title=title, parameters=parameters)


def calibration(effects: tuple[Effect, ...] | None = None, noise: float = NOISE) -> Calibration:
    """A calibration of both tests; by default it found the gain."""
    series = tuple(series_of(*test, order, noise) for order, test in enumerate(TESTS))
    stages: tuple[Stage, ...] = ("declared", "refit", "corrected")
    errors = {
        stage: Errors(
            nrms(series[:1], stage), nrms(series[1:], stage), {one.name: nrms([one], stage) for one in series}
        )
        for stage in stages
    }
    floors = [one.noise**2 / float(np.mean(one.measured**2)) for one in series]
    exact = {"k": Estimate.fixed(K, "N/m"), "c": Estimate.fixed(C, "N*s/m")}
    refit = {"k": estimate(1.04 * K, 3e3, "N/m"), "c": estimate(1.04 * C, 250.0, "N*s/m")}
    found = (gain(),) if effects is None else effects
    labels = tuple(one.label for one in found)
    return Calibration(
        campaign=Campaign(None, None, (), Path("campaign.yaml"), "two sines"),
        subject="damper",
        law="kelvin_voigt",
        errors=errors,
        noise_floor=floors[1],
        noise_floor_fit=floors[0],
        effects=found,
        hypotheses=(),
        verdict="explained",
        ending="complete",
        unexplained_share=0.0,
        unexplained_shape="",
        next_test=None,
        models=(
            ComparedModel(labels, True, 4.3e-5, 0.0, 0.0, 0.97),
            ComparedModel(("inertia.mass",), True, 8.1e-5, 31.0, 4.0, 2e-14),
            ComparedModel((), True, 1.3e-4, 120.0, 9.0, 0.0),
        ),
        depths=(SearchDepth((), 90, 14, labels), SearchDepth(labels, 89, 12, ())),
        forms=93,
        effort=1462.3,
        most_effort=20_000.0,
        law_file=LawFile("corrected", {"k": K, "c": C}, (), None, ("gain.force (instrument)",), (), floors[1]),
        parameters={"declared": exact, "refit": refit, "corrected": exact},
        law_fixed=True,
        series=series,
        seconds=1.5,
    )


def nothing_found() -> Calibration:
    """A law that is right: the corrected prediction is the declared one."""
    found = calibration(())
    series = tuple(
        replace(one, predicted=dict.fromkeys(one.predicted, one.predicted["corrected"])) for one in found.series
    )
    errors = dict.fromkeys(found.errors, found.errors["corrected"])
    return replace(found, verdict="none", series=series, errors=errors)


def more_is_left() -> Calibration:
    """Nothing explains the gain: what the refitted law leaves is left."""
    found = calibration(())
    predicted = [dict(one.predicted) | {"corrected": one.predicted["refit"]} for one in found.series]
    series = tuple(replace(one, predicted=own) for one, own in zip(found.series, predicted, strict=True))
    errors = dict(found.errors) | {"corrected": found.errors["refit"]}
    shape = "0.0091 % of the squared force of all tests is left, 85 % of it structure in the band of the motion."
    return replace(
        found,
        verdict="nothing_found",
        series=series,
        errors=errors,
        unexplained_share=1.0,
        unexplained_shape=shape,
        law_fixed=False,
        law_file=replace(found.law_file, stage="refit", measurement_effects=()),
        parameters=dict(found.parameters) | {"corrected": found.parameters["refit"]},
    )


def confounded() -> Calibration:
    """An effect with confounded effects, and the test that would separate them."""
    further = NextTest("12 cycles of 2 mm at 5 Hz, 35 degC", ("payne", "self_heating"), 0.02, 1e-4)
    return replace(calibration((payne(),)), next_test=further)
