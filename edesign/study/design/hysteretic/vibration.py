"""The first mode of a frame with hysteretic dampers: shape, period, amplitude and secants in agreement."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import scipy

from edesign.errors import AnalysisError
from edesign.project.dampers.designs import RoofAmplitude
from edesign.study.design.condensed import LinearModes
from edesign.study.design.estimate import Action
from edesign.study.design.hysteretic.model import HystereticModel, Secants, SecantVibration
from edesign.study.design.relaxation import AGREEMENT, Relaxation

_MOST_ITERATIONS = 300  # of shapes, and of Newton's method; ten where storeys do not hand the drift to each other
_MOST_DOUBLINGS = 60  # of an amplitude, or halvings, on the way to the one that is wanted
_LEAST_STEP = 0.01  # of Newton's
_LEAST = 1e-9  # deformation of a damper over the largest: below it, none
_GAUSS = np.polynomial.legendre.leggauss(64)  # the kink where a damper yields costs the average about 1e-4
_SHARES, _WEIGHTS = 0.5 * (1.0 + _GAUSS[0]), 0.5 * _GAUSS[1]


def secant_vibration(model: HystereticModel, yield_force: np.ndarray, action: Action | None = None) -> SecantVibration:
    """Return the vibration in the first mode in which shape, period, amplitude and secants agree.

    At each amplitude of the roof shape and secants agree; the amplitude is the one that the design asks for.

    Args:
        yield_force: of all dampers of each storey along its drift, (s,) N.
        action: whose spectrum gives the amplitude; None: what the design says.

    Raises:
        AnalysisError: they do not agree.
    """
    scale, amplitude = model.scale(yield_force), model.spec.amplitude
    if action is None and isinstance(amplitude, RoofAmplitude):
        found = _at_roof(model, scale, amplitude.roof_displacement, None)
    else:
        found = _at_wanted_roof(model, scale, action)
    return replace(found, damping_average=_average(model, scale, found.deformation, found.modes))


def bare_damping(model: HystereticModel, yield_force: np.ndarray) -> float:
    """Return the damping ratio that rigid-plastic dampers add to the first mode without dampers.

    Args:
        yield_force: of all dampers of each storey along its drift, (s,) N.
    """
    bare = model.bare
    roof = model.roof(bare, 0.0, None)
    at_roof, size = float(bare.lead.floors[-1]), np.abs(bare.lead.dampers)
    deformation = roof / abs(at_roof) * np.maximum(size, _LEAST * size.max())
    work = 4.0 * float(model.at_places(yield_force) @ deformation)
    return work / (2.0 * math.pi * (bare.first_omega * (roof / at_roof)) ** 2)


def _at_wanted_roof(model: HystereticModel, scale: np.ndarray, action: Action | None) -> SecantVibration:
    """The first mode at the amplitude that its period, shape and damping at this amplitude want."""
    found: SecantVibration | None = None

    def excess(logarithm: float) -> float:
        """Logarithm of the amplitude that is wanted over the one taken; it falls as the amplitude grows."""
        nonlocal found
        found = _at_roof(model, scale, math.exp(logarithm), found)
        return math.log(model.roof(found.modes, found.damping, action)) - logarithm

    low = high = math.log(model.roof(model.bare, 0.0, action))
    at_start = excess(low)
    for _ in range(_MOST_DOUBLINGS):
        if at_start >= 0.0:
            high += math.log(2.0)
            if excess(high) <= 0.0:
                break
        else:
            low -= math.log(2.0)
            if excess(low) >= 0.0:
                break
    else:
        raise AnalysisError(
            "no amplitude of the first mode with these dampers is the one that the design wants [E-DESIGN-02]"
        )
    excess(scipy.optimize.brentq(excess, low, high, xtol=AGREEMENT))
    assert found is not None
    return found


def _at_roof(model: HystereticModel, scale: np.ndarray, roof: float, start: SecantVibration | None) -> SecantVibration:
    """The first mode at an amplitude of the roof, m: shape and secants in agreement.

    The inertia forces of the present shape act on the frame with its dampers along their skeletons, whose forces
    only grow: there is one answer. Its secants give the next shape.
    """
    modes = model.bare if start is None else start.modes
    u = roof / float(modes.lead.floors[-1]) * modes.lead.dampers
    shape, relax = modes.lead.shape / modes.lead.floors[-1], Relaxation()
    periods: list[float] = []
    for _ in range(_MOST_ITERATIONS):
        u = _static(model, scale, roof, model.building.frame.mass * shape, u)
        deformation = np.maximum(np.abs(u), _LEAST * np.abs(u).max())
        secants = model.secants(scale, deformation)
        modes = model.building.frame.modes(secants.force / deformation)
        following = roof / float(modes.lead.floors[-1]) * modes.lead.dampers
        periods = [*periods[-1:], 2.0 * math.pi / modes.first_omega]
        if float(np.max(np.abs(following - u))) <= AGREEMENT * float(np.max(np.abs(u))):
            return _vibration(model, scale, roof, deformation, secants, modes)
        shape = relax(shape, modes.lead.shape / modes.lead.floors[-1])
    raise AnalysisError(
        f"shape of the first mode and secants of the dampers did not agree to {AGREEMENT:g}: at the roof amplitude of "
        f"{1e3 * roof:.4g} mm the last two trials have first periods of {periods[0]:.6g} and {periods[-1]:.6g} s "
        "[E-DESIGN-02]"
    )


def _static(model: HystereticModel, scale: np.ndarray, roof: float, loads: np.ndarray, start: np.ndarray) -> np.ndarray:
    """Deformations of the dampers (d,) m under loads on the masses (m,), scaled until the roof moves by `roof`, m.

    Newton's method: u = B p - C f(u), with p such that the roof moves as it shall.

    Raises:
        AnalysisError: it does not converge.
    """
    frame = model.building.frame
    by_loads, by_force = frame.B @ loads / float(frame.floor_A[-1] @ loads), frame.floor_B[-1]
    flexibility, standing = frame.C - np.outer(by_loads, by_force), frame.standing

    def residual(u: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        secants = model.secants(scale, np.abs(u))
        force = np.sign(u) * secants.force - standing * u
        return u - by_loads * roof + flexibility @ force, secants.tangent - standing

    u = start
    r, tangent = residual(u)
    for _ in range(_MOST_ITERATIONS):
        size = float(np.max(np.abs(r)))
        if size <= 1e-3 * AGREEMENT * float(np.max(np.abs(u))):
            return u
        step = np.linalg.solve(np.eye(u.size) + flexibility * tangent, r)
        part = 1.0
        while True:
            tried = u - part * step
            r, tangent = residual(tried)
            if float(np.max(np.abs(r))) < size or part < _LEAST_STEP:
                break
            part *= 0.5
        u = tried
    raise AnalysisError(
        "the frame with its dampers under the inertia forces of its first mode did not converge [E-DESIGN-02]"
    )


def _vibration(
    model: HystereticModel,
    scale: np.ndarray,
    roof: float,
    deformation: np.ndarray,
    secants: Secants,
    modes: LinearModes,
) -> SecantVibration:

    def of_mode(i: int) -> float:
        energy = float(secants.energy @ (modes.dampers[i] / deformation) ** 2)  # of generalised displacement 1
        return energy / (2.0 * math.pi * float(modes.omega[i]) ** 2)

    at_amplitude = modes.lead.mean(of_mode)
    average = model.spec.equivalent_damping == "average"
    damping = _average(model, scale, deformation, modes) if average else at_amplitude
    return SecantVibration(scale, roof, deformation, secants, modes, at_amplitude, math.nan, damping)


def _average(model: HystereticModel, scale: np.ndarray, deformation: np.ndarray, modes: LinearModes) -> float:
    """Mean of the equivalent damping over amplitudes up to that of a deformation (d,) m, in the same shapes."""
    amplitudes = _SHARES[:, None] * deformation
    found = model.secants(scale, amplitudes)
    here = model.secants(scale, deformation)

    def of_mode(i: int) -> float:
        of_dampers = modes.dampers[i]
        frame = float(modes.omega[i]) ** 2 - float((here.force / deformation) @ of_dampers**2)
        stiffness = frame + (found.force / amplitudes) @ of_dampers**2
        energy = found.energy @ (of_dampers / deformation) ** 2 / _SHARES**2
        return float(_WEIGHTS @ (energy / (2.0 * math.pi * stiffness)))

    return modes.lead.mean(of_mode)
