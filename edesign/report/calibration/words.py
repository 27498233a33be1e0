"""Words of the report of a calibration: effects with their numbers, probabilities, how far the search looked."""

from __future__ import annotations

import math
from dataclasses import replace

from edesign.calibration.results.practical_units import practical
from edesign.calibration.results.result import Calibration, Effect, Estimate, Fault, OutlyingTest
from edesign.report.calibration.error_tables import MODELS
from edesign.report.calibration.units import UNKNOWN, percent, plus_minus, value_text

_NAMED = 2  # parameters of an effect in a sentence
_LEAST = 1e-4  # probability that is printed as a number
_FACTORS = {"displacement": {1.0 / 25.4: "inches read as millimetres"}, "force": {-1.0: "the wrong sign"}}
"""Reading over what was, of a channel, and what it is like."""


def searched(calibration: Calibration) -> str:
    """Return how far the search looked."""
    depths = calibration.depths
    if not depths and calibration.ending == "complete":
        model = MODELS[calibration.subject]
        return (
            f"no effect was screened, as the {model} alone leaves noise at the sampling of the search; effort "
            f"{calibration.effort:.0f} of {calibration.most_effort:g}"
        )
    if not depths:
        return f"no effect was screened to the end; effort {calibration.effort:.0f} of {calibration.most_effort:g}"
    screened, fitted = max((one.screened for one in depths), default=0), sum(one.fitted for one in depths)
    return (
        f"{len(depths)} round{'' if len(depths) == 1 else 's'} over up to {screened} of {calibration.forms} forms of "
        f"effects, {fitted} models fitted; effort {calibration.effort:.0f} of {calibration.most_effort:g}"
    )


def effect_text(effect: Effect) -> str:
    """Return an effect in words, with its first parameters."""
    numbers = numbers_text(effect, _NAMED)
    return f"{effect.title} ({effect.kind}{', ' + numbers if numbers else ''})"


def name_of(name: str) -> str:
    """Return the name of an effect, or of a model by its label, in words.

    Args:
        name: of the effect, or label.
    """
    return "the model alone" if name == "none" else name if "." in name else name.replace("_", " ")


def probability_text(p: float) -> str:
    """Return a probability (0 to 1) in percent; "-" where it was not asked."""
    if not math.isfinite(p):
        return "-"
    return f"under {percent(_LEAST)} %" if p < _LEAST else f"{percent(p, 3 if p < 0.995 else 4)} %"


def numbers_text(effect: Effect, most: int) -> str:
    """Return the first parameters of an effect, `most` of them, in practical units."""
    parameters = dict(list(effect.parameters.items())[:most])
    shown = {name: practical(value, effect.parameters) for name, value in parameters.items()}
    return ", ".join(f"{name} = {_in_text(one)}" for name, one in shown.items())


def _in_text(estimate: Estimate) -> str:
    """A number in a sentence, without its reason if it is not determined."""
    if estimate.not_determined:
        return f"{value_text(estimate)} {estimate.unit}".rstrip() + f" ({UNKNOWN})"
    return plus_minus(estimate)


def outlying_text(test: OutlyingTest) -> str:
    """Return in words that a test does not agree with the others, and why as far as that is known."""
    which = f"The validation test {test.name}" if test.use == "validate" else test.name
    left = "only noise is left in them"
    if not test.only_noise:
        before, after = percent(test.others_with), percent(test.others_without)
        left = f"an NRMS of {after} % is left in them, with it in the fit {before} %"
    texts = [f"{which} does not agree with the other tests: without it {left}."]
    if test.faults:
        texts.append(f"One fault explains it: {', or '.join(map(fault_text, test.faults))}.")
    else:
        texts.append("No fault of an instrument that is known here explains all of it.")
        if test.beyond:
            texts.append(
                f"It goes beyond all others in {' and '.join(test.beyond)}, where the law itself may be wrong."
            )
    return " ".join(texts)


def fault_text(fault: Fault) -> str:
    """Return a fault of an instrument in one test in words, with its size."""
    (size,) = fault.parameters.values()
    over, shown = size.value > 0.0, practical(size, {})
    channel = "force" if fault.form.startswith("force") else "displacement"
    if fault.name == "lag":
        return f"its force is {_amount(shown)} {'late' if over else 'early'}"
    if fault.name == "thermometer":
        return f"its temperature reads {_amount(shown)} too {'high' if over else 'low'}"
    if fault.name == "clock":
        channel = "time column"
    low, high = (1.0 + end for end in size.interval)
    like = [f": it has {what}" for factor, what in _FACTORS.get(channel, {}).items() if low <= factor <= high]
    return f"its {channel} reads {_amount(size.scaled(0.01, '%'))} too {'much' if over else 'little'}{''.join(like)}"


def _amount(estimate: Estimate) -> str:
    return plus_minus(replace(estimate, value=abs(estimate.value)))
