"""Residual stresses of rolled I sections, which cooling leaves before any load.

Half of each flange, and half of the web, have a stress that falls linearly from tension where they meet to as much
compression at the tip of the flange and in the middle of the web. So each plate is in equilibrium by itself; what
fillets bring is taken off all fibres alike. The stress is a share of 235 MPa whatever the steel, as it does not grow
with the yield strength: 0.5 up to h/b = 1.2, else 0.3.

Source: ECCS, Ultimate limit state calculation of sway frames with rigid joints, publication 33, 1984. It could not be
    read; pattern and shares are those that the programs of others take from it.
"""

from __future__ import annotations

from typing import Protocol

import numpy as np

from edesign.errors import InputError
from edesign.frame.sections.profiles import Profile, profile, profile_names
from edesign.frame.sections.section import CrossSection
from edesign.project.frame.materials import BilinearMaterial, Material
from edesign.project.frame.sections import ResidualStress

_REFERENCE = 235e6
_MOST_COMPACT, _COMPACT, _SLENDER = 1.2, 0.5, 0.3


class _Of(Protocol):
    """What a file says of fibres."""

    @property
    def residual_stress(self) -> ResidualStress:
        """The pattern."""


def pattern_of(fibres: _Of, section: str, own: bool, material: str, law: Material, where: str) -> Profile | None:
    """Return the rolled section whose fibres have residual stresses; None where the file asks for none.

    Args:
        own: whether it is a section of the file.
        law: of the steel `material`.
        where: place of the key in the file, for messages.

    Raises:
        InputError: there is no pattern for the section or the law, or the stresses reach its yield strength.
    """
    if fibres.residual_stress == "none":
        return None
    begins = f"{where}: fibres.residual_stress:"
    if own or profile_names().canonical(section) is None:
        raise InputError(f"{begins} `eccs` is of rolled I sections; there is no pattern for {section} [E-SECT-05]")
    rolled = profile(section)
    if not isinstance(law, BilinearMaterial):
        raise InputError(
            f"{begins} `eccs` is of the law `bilinear`, whose stress is proportional to strain up to yield; {material} "
            f"is `{law.law}` [E-SECT-05]"
        )
    largest = _largest(rolled)
    if not law.fy > largest / (1.0 - law.hardening):
        raise InputError(
            f"{begins} {section} has {largest / 1e6:.4g} MPa, which {material} with {law.fy / 1e6:.4g} MPa has no room "
            "for [E-SECT-05]"
        )
    return rolled


def eccs_stresses(rolled: Profile, y: np.ndarray, z: np.ndarray, area: np.ndarray) -> np.ndarray:
    """Return the stress of each fibre of a section, (n,) Pa, tension positive.

    Args:
        y: (n,) across the web, from the centroid, m.
        z: (n,) along the web, m; beyond the web fibres are of the flanges.
        area: (n,) m2.
    """
    web = rolled.h - 2.0 * rolled.tf
    flange = 1.0 - 4.0 * np.abs(y) / rolled.b
    found = _largest(rolled) * np.where(np.abs(z) > 0.5 * web, flange, 4.0 * np.abs(z) / web - 1.0)
    return np.asarray(found - found @ area / area.sum())


def stressed_layers(rolled: Profile, shape: CrossSection, weak: bool) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return depths (m), areas (m2) and stresses (Pa) of all fibres of a section that bends in one plane.

    Args:
        shape: its strips and fillets, as `rolled_section` gives them.
        weak: it bends about its weak axis.
    """
    web = rolled.h - 2.0 * rolled.tf
    flanges = (0,) if weak else (0, 2)
    parts: list[tuple[np.ndarray, ...]] = []
    for number, strip in enumerate(shape.strips):
        of_flange = number in flanges
        rows = strip.centre + (2.0 * np.arange(strip.rows) + 1.0 - strip.rows) * (strip.depth / (2 * strip.rows))
        across = (2.0 * np.arange(strip.columns) + 1.0 - strip.columns) * (strip.width / (2 * strip.columns))
        depth, beside = (of.ravel() for of in np.meshgrid(rows, across, indexing="ij"))
        y, z = (depth, beside) if weak else (beside, depth)
        if of_flange and weak:
            z = np.full(y.size, web)
        parts.append((depth, y, z, np.full(depth.size, strip.width * strip.depth / depth.size)))
    for spot in shape.spots:
        parts.append(tuple(np.array([value]) for value in (spot.centre, 0.0, 0.5 * web, spot.area)))
    depth, y, z, area = (np.concatenate(of) for of in zip(*parts, strict=True))
    return depth, area, eccs_stresses(rolled, y, z, area)


def _largest(rolled: Profile) -> float:
    """The stress where flange and web meet, Pa."""
    return _REFERENCE * (_COMPACT if rolled.h <= _MOST_COMPACT * rolled.b else _SLENDER)
