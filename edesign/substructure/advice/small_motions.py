"""Whether small motions grow in a loop that is stable at the amplitude of a test.

Near rest many laws are stiffer: the equivalent dashpot of F = c |v|^alpha sign v, alpha < 1, grows without bound. The
loop then ends in a limit cycle, of which a law that is linearised at one amplitude shows nothing.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from edesign.errors import InputError
from edesign.project.substructure.rig import ServoHydraulicRig
from edesign.substructure.advice.expectation import LinearModel, law_at
from edesign.substructure.advice.loaded_rig import is_unstable, loaded_poles
from edesign.substructure.advice.recommendation import ADAPTIVE
from edesign.substructure.advice.transfers import CompensatorTransfer, rig_response
from edesign.substructure.stability.loop import Loop
from edesign.substructure.stability.sweep import sweep

SMALLEST = 1e-3
"""Of the largest deformation; what is smaller is not looked at."""
A_DECADE = 2
"""Amplitudes a decade. The force of no law falls as the motion grows, so its equivalent stiffness falls no faster than
the amplitude rises: by a factor of 3.2 at most from one to the next. An amplitude is found within that factor."""
LINEAR = 1e-3
"""Relative change of the stiffness below which a law counts as linear."""


def smaller_models(model: LinearModel) -> tuple[LinearModel, ...]:
    """Return a model at smaller amplitudes, the largest first, down to what its encoder resolves; none: none grow.

    A law that is linear is the same there. A given target grows nowhere but in a rig that its specimen loads.

    Args:
        model: at the amplitude of the test.
    """
    sensors, at = model.laboratory.laboratory.sensors, model.linearisation
    least = max(SMALLEST * at.largest, sensors.displacement_noise, sensors.displacement_quantisation)
    loads = isinstance(model.laboratory.file.plant, ServoHydraulicRig)
    if least >= at.amplitude or not (model.part is not None or loads):
        return ()
    smallest = _at(model, least)
    omega = 2.0 * np.pi * model.band + 0j
    own, other = model.specimen(omega), smallest.specimen(omega)
    if np.all(np.abs(other - own) <= LINEAR * np.abs(own)):
        return ()
    count = max(round(A_DECADE * np.log10(at.amplitude / least)), 1)
    between = np.geomspace(at.amplitude, least, count + 1)[1:-1]
    return (*(_at(model, float(one)) for one in between), smallest)


def _at(model: LinearModel, amplitude: float) -> LinearModel:
    file = model.laboratory.file
    specimen = law_at(model.laboratory.damper, amplitude, model.band)
    transfer = model.laboratory.laboratory.transfer
    rig = rig_response(file.plant, transfer, specimen, file.loop.main_step)
    at = replace(model.linearisation, amplitude=amplitude)
    return replace(model, specimen=specimen, rig=rig, linearisation=at)


def grows_below(models: Sequence[LinearModel], name: str, learned: CompensatorTransfer, motion: np.ndarray) -> float:
    """Return the largest amplitude at which motions grow with a compensator, m; 0: at none.

    Args:
        models: of `smaller_models`.
        learned: it, at the amplitude of the test.
        motion: (n,) as of `LinearModel.of`, m.
    """
    return next((one.linearisation.amplitude for one in models if _grows(one, name, learned, motion)), 0.0)


def cycle_rms(growing: float, motion: np.ndarray) -> float:
    """Return the most that a limit cycle may add to a motion: its root mean square over that of the motion.

    A motion grows until the next amplitude that was looked at, at which it does not.

    Args:
        growing: largest amplitude at which motions grow, m.
        motion: (n,) m.
    """
    size = float(np.sqrt(np.mean(motion**2)))
    return 10.0 ** (1.0 / A_DECADE) * growing / np.sqrt(2.0) / size if growing > 0.0 else 0.0


def _grows(model: LinearModel, name: str, learned: CompensatorTransfer, motion: np.ndarray) -> bool:
    file = model.laboratory.file
    if is_unstable(loaded_poles(file.plant, model.specimen)):
        return True
    if model.part is None:
        return False
    adaptive = file.compensators[name].kind in ADAPTIVE
    compensator = learned if adaptive else model.compensator(name, motion)
    try:
        found = sweep(Loop(model.whole, model.seen(compensator)), 0.5 / file.loop.main_step)
    except InputError:  # the structure itself does not come to rest there: nothing can be said of the loop
        return False
    return not found.bounded or found.unstable_roots > 0
