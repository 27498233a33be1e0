"""Hidden effects by name, each in several forms."""

from __future__ import annotations

from types import ModuleType

from blind.effects import (
    ageing,
    degradation,
    drift,
    friction,
    gain,
    hardening,
    hum,
    inertia,
    lag,
    mullins,
    offset,
    one_sided,
    payne,
    play,
    relaxation_branch,
    self_heating,
    series_flexibility,
    static_offset,
    temperature_law,
    velocity_exponent,
)
from blind.effects.base import Effect

_MODULES: tuple[ModuleType, ...] = (
    payne,
    friction,
    lag,
    mullins,
    series_flexibility,
    gain,
    hardening,
    play,
    offset,
    one_sided,
    static_offset,
    drift,
    relaxation_branch,
    inertia,
    velocity_exponent,
    hum,
    temperature_law,
    self_heating,
    degradation,
    ageing,
)
EFFECTS: dict[str, tuple[type[Effect], ...]] = {module.FORMS[0].name: module.FORMS for module in _MODULES}
"""Forms of each effect."""
