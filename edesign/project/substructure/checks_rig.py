"""Cross checks of rig, sensors and loop."""

from __future__ import annotations

import math

import numpy as np

from edesign.project.reading.problems import Keys, Problems
from edesign.project.substructure.rig import RigFile, RigInFile, RigModel, ServoHydraulicRig, TransferFunctionRig
from edesign.project.substructure.rts_file import RtsFile

COVARIANCE_ROUNDING = 1e-6
"""Of correlations that are written with ten digits, and of their sums, with a margin for files written by hand."""
LONGEST_STEP = 0.1
"""Of the loop, s."""


def check_plant(rig: RigModel, keys: Keys, problems: Problems) -> None:
    """Check a rig.

    Args:
        rig: without schema problems.
    """
    if isinstance(rig, TransferFunctionRig):
        _transfer_function(rig, keys, problems)
    if isinstance(rig, ServoHydraulicRig) and (rig.limits.velocity is None) != (rig.limits.force is None):
        missing = "velocity" if rig.limits.velocity is None else "force"
        message = (
            "this key is missing; the flow through a valve falls with the force, so both limits belong together"
            " [E-KEY-02]"
        )
        problems.under((*keys, "limits"), missing, message)


def check_covariance(file: RigFile, problems: Problems) -> None:
    """Check that the covariance of a rig file is a covariance matrix of the numbers of its rig."""
    if file.covariance is None:
        return
    names, rows, keys = list(file.standard_errors), file.covariance, ("covariance",)
    strangers = [name for name in names if not isinstance(getattr(file.rig, name, None), float)]
    if strangers:
        problems.at_key(("standard_errors", strangers[0]), f"a {file.rig.kind} rig has no such number [E-RIG-04]")
        return
    if len(rows) != len(names) or any(len(row) != len(names) for row in rows):
        widths = ", ".join(str(len(row)) for row in rows) or "no"
        problems.at_value(
            keys,
            f"{len(rows)} rows of {widths} numbers; of {len(names)} standard errors {len(names)} x {len(names)}"
            " [E-VALUE-04]",
        )
        return
    matrix = np.array(rows)
    size = np.sqrt(np.abs(np.diag(matrix)))
    scaled = matrix / np.outer(np.where(size > 0.0, size, 1.0), np.where(size > 0.0, size, 1.0))
    if not np.allclose(scaled, scaled.T, rtol=0.0, atol=COVARIANCE_ROUNDING):
        problems.at_value(keys, "a covariance is symmetric [E-RIG-04]")
    elif np.any(np.diag(matrix) < 0.0) or float(np.linalg.eigvalsh(scaled)[0]) < -COVARIANCE_ROUNDING:
        problems.at_value(
            keys, "this is no covariance: it gives a combination of the values a variance below zero [E-RIG-04]"
        )


def _transfer_function(rig: TransferFunctionRig, keys: Keys, problems: Problems) -> None:
    numerator, denominator = (*keys, "numerator"), (*keys, "denominator")
    for at, coefficients in ((numerator, rig.numerator), (denominator, rig.denominator)):
        if coefficients[0] == 0.0 and len(coefficients) > 1:
            problems.at_value((*at, 0), "the coefficient of the highest power is 0; leave it out [E-RIG-04]")
            return
    orders = f"order {len(rig.numerator) - 1} over order {len(rig.denominator) - 1}"
    if len(rig.numerator) > len(rig.denominator):
        problems.at_value(
            numerator, f"the transfer function is improper ({orders}): it would run ahead of its command [E-RIG-04]"
        )
    elif len(rig.numerator) == len(rig.denominator) > 1:
        problems.at_value(
            numerator, f"the actuator would jump with its command ({orders}); a lower order is needed [E-RIG-04]"
        )
    if rig.denominator[-1] == 0.0:
        problems.at_value(
            (*denominator, len(rig.denominator) - 1), "there is a pole at 0: the rig would drift away [E-RIG-04]"
        )
        return
    gain = rig.numerator[-1] / rig.denominator[-1]
    if gain == 0.0:
        problems.at_value(numerator, "the gain at rest is 0: the rig would come back from every command [E-RIG-04]")
    elif gain < 0.0:
        problems.at_value(
            numerator, f"the gain at rest is {gain:.3g}: the rig would move against its command [E-RIG-04]"
        )
    poles = np.roots(rig.denominator)
    if poles.size and (worst := poles[np.argmax(poles.real)]).real >= -1e-12 * abs(poles).max():
        real = f"{worst.real + 0.0:.3g}"
        pole = real if worst.imag == 0.0 else f"{real} +- {abs(worst.imag):.3g}i"
        problems.at_value(denominator, f"the rig is unstable on its own: it has a pole at {pole} 1/s [E-RIG-04]")


def check_sensors(rts: RtsFile, problems: Problems) -> None:
    """Check the sensors; the rig of the file is known."""
    sensors, limits = rts.sensors, rts.plant.limits
    for key, limit, value in (
        ("displacement_range", "stroke", rts.displacement_range),
        ("force_range", "force", rts.force_range),
    ):
        if sensors.bits is not None and value is None:
            message = (
                f"this key is missing; `bits` divide a range, and the rig has no limit of {limit} to take for it"
                " [E-KEY-02]"
            )
            problems.under(("sensors",), key, message)
    if (
        sensors.displacement_range is not None
        and limits.stroke is not None
        and sensors.displacement_range < limits.stroke
    ):
        message = f"the encoder ends at {1e3 * sensors.displacement_range:.4g} mm, before the stroke of the actuator"
        problems.at_value(("sensors", "displacement_range"), f"{message}, {1e3 * limits.stroke:.4g} mm [E-RIG-06]")
    if sensors.force_range is not None and limits.force is not None and sensors.force_range < limits.force:
        message = f"the load cell ends at {1e-3 * sensors.force_range:.4g} kN, before the force of the actuator"
        problems.at_value(("sensors", "force_range"), f"{message}, {1e-3 * limits.force:.4g} kN [E-RIG-06]")


def check_sub_steps(rts: RtsFile, problems: Problems) -> None:
    """Check that the sub-steps of a servo-hydraulic rig do not make it oscillate; the rig of the file is known."""
    plant, h = rts.plant, rts.sub_step
    if not isinstance(plant, ServoHydraulicRig):
        return
    lag = plant.valve_time_constant
    left = math.exp(-h / lag) if lag > 0.0 else 0.0
    mean = (1.0 - left) * lag / h
    # of the flow at the end of a sub-step, by position and flow at its start, as core_c/src/substructure/rig.c has it
    by_x, by_q = -plant.proportional_gain * (1.0 - left), left - plant.proportional_gain * (1.0 - mean) * h
    step = np.array([[1.0 + 0.5 * h * by_x, 0.5 * h * (1.0 + by_q)], [by_x, by_q]])
    if np.max(np.abs(np.linalg.eigvals(step))) >= 1.0:
        keys = ("rig", "file") if isinstance(rts.rig, RigInFile) else ("rig", "proportional_gain")
        message = f"{plant.proportional_gain:.4g} /s is too fast for sub-steps of {1e3 * h:.4g} ms: the rig oscillates"
        problems.at_value(keys, f"{message} by them alone; take more `sub_steps` or a shorter `main_step` [E-RTS-03]")


def check_noise(rts: RtsFile, problems: Problems) -> None:
    """Check that the noise of the sensors is within their range; the rig of the file is known."""
    in_rig_file = rts.sensors.encoder_noise is None
    for keys, noise, reach, what, scale, unit in (
        (
            ("rig", "file") if in_rig_file else ("sensors", "encoder_noise"),
            rts.encoder_noise,
            rts.displacement_range,
            "displacement",
            1e3,
            "mm",
        ),
        (("sensors", "force_noise"), rts.sensors.force_noise, rts.force_range, "force", 1e-3, "kN"),
    ):
        if reach is not None and noise >= reach:
            message = f"a noise of {scale * noise:.4g} {unit} is not below the largest {what} that the sensor reads or"
            problems.at_value(keys, f"{message} the rig reaches, {scale * reach:.4g} {unit} [E-RIG-06]")


def check_loop(rts: RtsFile, problems: Problems) -> None:
    """Check steps, and parameters of the integration."""
    if rts.loop.main_step > LONGEST_STEP:
        message = (
            f"{rts.loop.main_step:.4g} s is no step of a loop; at most {LONGEST_STEP:g} s is possible [E-VALUE-02]"
        )
        problems.at_value(("loop", "main_step"), message)
    if "rho_inf" in rts.integration.model_fields_set and rts.integration.method != "kr_alpha":
        message = f"`{rts.integration.method}` has no spectral radius to choose; it is of `kr_alpha` [E-RTS-03]"
        problems.at_key(("integration", "rho_inf"), message)


def nyquist(rts: RtsFile) -> float:
    """Return half the rate of the main step, Hz."""
    return 0.5 / rts.loop.main_step


def corner(time_constant: float) -> float:
    """Return the corner frequency of a time constant, Hz."""
    return 1.0 / (2.0 * math.pi * time_constant)
