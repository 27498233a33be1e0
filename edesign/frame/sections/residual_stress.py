"""Residual stresses of rolled I sections in the fibres of their sections."""

from __future__ import annotations

import numpy as np

from edesign.frame.sections.profiles import Profile
from edesign.frame.sections.space_section import SpaceSection


def residual_stress(rolled: Profile, section: SpaceSection, f_y: float) -> np.ndarray:
    """Return the residual stresses of the fibres of a rolled I section, (n,) Pa, tension positive.

    They vary linearly from 0.5 f_y at the joint of flange and web to -0.5 f_y at the tips of the flanges and in the
    middle of the web, with 0.3 in place of 0.5 if h / b > 1.2. The fillets go with the web. What force they leave, some
    per cent of f_y A, is taken from all fibres alike, so that N, M_y and M_z are zero.

    Args:
        section: fibres of `rolled`.
        f_y: yield strength that the pattern scales with, Pa.

    Source: ECCS publication 33, Ultimate limit state calculation of sway frames with rigid joints, 1984.
    """
    share = 0.5 if rolled.h <= 1.2 * rolled.b else 0.3
    half_web = 0.5 * rolled.h - rolled.tf
    y, z = abs(section.y), abs(section.z)
    pattern = np.where(z > half_web, 1.0 - 4.0 * y / rolled.b, 2.0 * z / half_web - 1.0)
    return share * f_y * (pattern - pattern @ section.area / section.area.sum())
