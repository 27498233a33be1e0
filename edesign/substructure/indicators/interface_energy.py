"""Energy that the tracking error brings into the structure at the interface."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from edesign.substructure.indicators.channels import channel
from edesign.substructure.indicators.undetermined import Undetermined


def work(force: ArrayLike, displacement: ArrayLike) -> np.ndarray:
    """Work of a force on a path from the first sample on, by trapezoids.

    Args:
        force: F (n,), N.
        displacement: x (n,), m.

    Returns:
        (n,) J.

    Raises:
        InputError: lengths that differ, NaN.
    """
    x = channel("displacement", displacement)
    return work_along(channel("force", force, x.size), x)


def work_along(force: np.ndarray, displacement: np.ndarray) -> np.ndarray:
    """Return `work` of arrays that need no check.

    Args:
        force: (n,) N, n > 0.
        displacement: (n,) m.

    Returns:
        (n,) J.
    """
    return np.concatenate(([0.0], np.cumsum(0.5 * (force[1:] + force[:-1]) * np.diff(displacement))))


def energy_error(
    force: ArrayLike, target: ArrayLike, measured: ArrayLike, applied: ArrayLike | None = None
) -> np.ndarray:
    """Return the integral of F dx_m - F_a dx_t: what the specimen took less what the structure believes to have given.

    Without a correction of the force F_a = F, and it is the integral of F d(x_m - x_t).

    Above zero the rig has fed energy into the structure, as a negative damper does. A spring k under a sine of
    amplitude a, late by phi, gains pi k a^2 sin(phi) a cycle.

    Args:
        force: F (n,) of the specimen, above zero for x above zero, N.
        target: x_t (n,), m.
        measured: x_m (n,), m.
        applied: F_a (n,) on the structure, which a compensator may correct, N; None: F.

    Returns:
        (n,) J.

    Raises:
        InputError: lengths that differ, NaN.

    Source: Mosqueda, Stojadinovic & Mahin (2007), Real-time error monitoring for hybrid simulation, part I, J.
    Structural Engineering 133 (energy of tracking errors at the interface).
    """
    x_t = channel("target", target)
    x_m = channel("measured", measured, x_t.size)
    f = channel("force", force, x_t.size)
    given = f if applied is None else channel("applied force", applied, x_t.size)
    return work_along(f, x_m) - work_along(given, x_t)


def relative_energy_error(
    force: ArrayLike, target: ArrayLike, measured: ArrayLike, applied: ArrayLike | None = None
) -> float:
    """Return the energy error at the end over the largest work done on the specimen.

    Args:
        force: see `energy_error`.
        target: see `energy_error`.
        measured: see `energy_error`.
        applied: see `energy_error`.

    Raises:
        Undetermined: no work is done on the specimen, or it gives out more than it took, as with a force of wrong sign.
        InputError: as `energy_error`.
    """
    error = float(energy_error(force, target, measured, applied)[-1])
    done = work(force, measured)
    most, least = float(np.max(done)), float(np.min(done))
    if -least > most:
        raise Undetermined("the specimen gives out more energy than it took: the force may have the wrong sign")
    if most == 0.0:
        raise Undetermined("no work is done on the specimen")
    return error / most
