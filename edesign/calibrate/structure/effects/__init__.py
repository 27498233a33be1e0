"""Effects as plug-ins: one file each, with `forms` for a building; a new one is added to this list."""

from types import ModuleType

from edesign.calibrate.structure.effects import (
    channel,
    damping,
    flexible_base,
    isolation_hardening,
    isolation_softening,
    mass_error,
    partitions,
)

MODULES: tuple[ModuleType, ...] = (
    partitions,
    flexible_base,
    mass_error,
    damping,
    isolation_softening,
    isolation_hardening,
    channel,
)
