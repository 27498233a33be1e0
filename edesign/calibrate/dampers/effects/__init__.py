"""Effects as plug-ins: one file each; a new one is added to this list."""

from types import ModuleType

from edesign.calibrate.dampers.effects import (
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

MODULES: tuple[ModuleType, ...] = (
    payne,
    mullins,
    hardening,
    one_sided,
    relaxation_branch,
    velocity_exponent,
    temperature_law,
    self_heating,
    degradation,
    ageing,
    friction,
    play,
    series_flexibility,
    static_offset,
    lag,
    gain,
    offset,
    drift,
    inertia,
    hum,
)
