"""Regular expressions of the units of quantities, for JSON schemas.

They know what engineers write; reading knows every unit of pint, so that a rare one may be right all the same.
"""

from __future__ import annotations

from edesign.project.notation.quantities import Kind

_LENGTH = "(?:[kcdmuµμn]?m|in|inch|ft|foot|feet|yd)"
_FORCE = "(?:[kMG]?N|lbf|kip|kgf)"
_MASS = "(?:kg|g|Mg|t|lb)"
_TIME = "(?:[mu]?s|min|h|hours?|days?|weeks?|years?)"
_ANGLE = "(?:m?rad|deg|degrees?)"
_SQUARE, _CUBE, _FOURTH = (rf"(?:(?:\^|\*\*)?{n}|{sign})" for n, sign in ((2, "²"), (3, "³"), (4, "⁴")))
_TIMES, _OVER = r" ?[*·⋅ ] ?", " ?/ ?"
# of one dimension, as an angle has none
_MOMENT = f"{_FORCE}{_TIMES}{_LENGTH}(?:{_OVER}{_ANGLE})?|[kM]?J"
_STRESS = f"[kMG]?Pa|psi|ksi|psf|ksf|bar|{_FORCE}{_OVER}{_LENGTH}{_SQUARE}"

_PATTERNS = {
    "m": _LENGTH,
    "m^2": _LENGTH + _SQUARE,
    "m^3": _LENGTH + _CUBE,
    "m^4": _LENGTH + _FOURTH,
    "N": _FORCE,
    "N/m": f"{_FORCE}{_OVER}{_LENGTH}|plf|klf",
    "Pa": _STRESS,
    "N/m^2": _STRESS,
    "kg": _MASS,
    "s": _TIME,
    "m/s": f"{_LENGTH}{_OVER}{_TIME}",
    "m/s^2": f"g|{_LENGTH}{_OVER}{_TIME}{_SQUARE}",
    "kg/m": f"{_MASS}{_OVER}{_LENGTH}",
    "kg/m^3": f"{_MASS}{_OVER}{_LENGTH}{_CUBE}|pcf",
    "1/s": f"[kM]?Hz|1{_OVER}{_TIME}",
    "N*m": _MOMENT,
    "J": _MOMENT,
    "N*m/rad": _MOMENT,
    "rad": _ANGLE,
    "N*s/m": rf"{_FORCE}{_TIMES}{_TIME}{_OVER}{_LENGTH}|{_FORCE}{_OVER}\({_LENGTH}{_OVER}{_TIME}\)",
    "s^2": _TIME + _SQUARE,
    "s^3": _TIME + _CUBE,
    "s^2/s": f"{_TIME}{_SQUARE}{_OVER}{_TIME}",
    "m/s/N": f"{_LENGTH}{_OVER}{_TIME}{_OVER}{_FORCE}",
}
_ANY_UNIT = r"[A-Za-zµμ°%0-9 ·⋅*/^()²³⁴._+-]{1,60}"


def unit_pattern(kind: Kind) -> str:
    """Return the regular expression of the units of a quantity; of rare quantities any unit matches."""
    return _PATTERNS.get(kind.unit, _ANY_UNIT)
