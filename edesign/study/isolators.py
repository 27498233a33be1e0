"""What is doubtful about an isolated base after a history: isolators that are pulled, weights that change."""

from __future__ import annotations

import numpy as np

from edesign.archive.dataset import Group
from edesign.building.frame import FrameModel
from edesign.project.notation.units import STANDARD_GRAVITY
from edesign.study.warnings import AnalysisWarning

_ROUNDING = 1e-9  # of an axial force that is none, against the largest


def isolator_warnings(group: Group, frame: FrameModel) -> list[AnalysisWarning]:
    """Return warnings of friction pendulums that lost contact, and of weights that vertical motion changed.

    Args:
        group: of the history, with its axial forces, and its vertical motion if it has one.
        frame: the model.
    """
    isolated = frame.isolated
    if isolated is None or not isolated.weighed:
        return []
    names = [isolator.name for isolator in isolated.isolators]
    most, least = (np.asarray(group.variables[f"isolator_axial_force_{which}"].values) for which in ("max", "min"))
    weighed = [i for i, name in enumerate(names) if name in isolated.weighed]
    free = [i for i in weighed if most[i] >= -_ROUNDING * np.abs(least).max()]
    found = []
    if free:
        worst = max(free, key=lambda i: most[i])
        pulled = most[worst] > _ROUNDING * np.abs(least).max()
        text = f"pulls at {names[worst]} with {most[worst] / 1e3:.4g} kN" if pulled else f"lifts off {names[worst]}"
        count = "1 friction pendulum" if len(free) == 1 else f"{len(free)} friction pendulums"
        rest = "it slides as under its weight" if len(free) == 1 else "they slide as under their weight"
        message = f"{count} of {len(weighed)} lost contact: the frame {text}; {rest} (`weight: varying` follows it)"
        found.append(AnalysisWarning("isolator_uplift", message, 1.0 + float(most[worst] / np.abs(least).max())))
    if "vertical_pga_m_s2" in group.attributes:
        peak = float(str(group.attributes["vertical_pga_m_s2"])) / STANDARD_GRAVITY
        text = (
            f"the vertical ground motion, {peak:.3g} g, changes the weight on the friction pendulums, which slide as "
            "under gravity (`weight: varying` follows it)"
        )
        found.append(AnalysisWarning("isolator_weight", text, 1.0 + peak))
    return found
