"""Quantities of tests of dampers, by the names and units that headers have in several languages."""

from __future__ import annotations

import re
from collections.abc import Mapping

Units = Mapping[str, tuple[float, float]]  # factor and zero: SI = factor * value + zero

TIME: Units = {"s": (1.0, 0.0), "ms": (1e-3, 0.0), "min": (60.0, 0.0)}
DISPLACEMENT: Units = {"mm": (1e-3, 0.0), "m": (1.0, 0.0), "cm": (1e-2, 0.0), "um": (1e-6, 0.0), "in": (0.0254, 0.0)}
FORCE: Units = {
    "kN": (1e3, 0.0),
    "N": (1.0, 0.0),
    "MN": (1e6, 0.0),
    "lbf": (4.4482216152605, 0.0),
    "kip": (4448.2216152605, 0.0),
    "kgf": (9.80665, 0.0),
}
TEMPERATURE: Units = {"C": (1.0, 0.0), "degC": (1.0, 0.0), "K": (1.0, -273.15), "F": (5.0 / 9.0, -160.0 / 9.0)}

QUANTITIES: dict[str, Units] = {
    "time": TIME,
    "displacement": DISPLACEMENT,
    "force": FORCE,
    "temperature": TEMPERATURE,
}

# other names of the quantities on test machines, behind what they put before them
_NAMES = {
    "time": ("time",),
    "displacement": ("displacement", "stroke", "deformation", "disp"),
    "force": ("force", "load"),
    "temperature": ("temperature", "temp"),
}
# names that are taken where no column has one of those: in other languages, and of other channels
_OTHER_NAMES = {
    "time": ("timestamp", "zeit", "prüfzeit", "laufzeit", "tempo", "temps", "tiempo", "时间", "時間", "t"),
    "displacement": (
        *("position", "extension", "crosshead", "weg", "verschiebung", "verformung", "standardweg", "kolbenweg"),
        *("spostamento", "corsa", "déplacement", "deplacement", "desplazamiento", "位移", "変位"),
        *("standard travel", "course standard"),
    ),
    "force": (
        *("kraft", "last", "standardkraft", "prüfkraft", "forza", "carico", "effort", "charge", "fuerza", "carga"),
        *("standard force", "force standard"),
        *("力", "荷载", "载荷", "负荷", "荷重", "load cell"),
    ),
    "temperature": ("temperatur", "temperatura", "température", "温度"),
}
_LONGEST = 500  # characters of a header; paths of signals have about a hundred
_BEFORE = re.compile(r"(?:axial|actuator|elapsed|running|total|(?:ch|channel|kanal|canal) ?\d+)[ _]")
_BRACKETED = re.compile(r"(?P<name>[^\[(]*)[\[(](?P<unit>[^\])]*)[\])]")
_SPELLED = {
    **{"°C": "C", "°F": "F", "µm": "um", "μm": "um", "sec": "s", "Sec": "s", "seconds": "s", "kips": "kip"},
    **{"inch": "in", "inches": "in", "Inch": "in", "lb": "lbf", "lbs": "lbf", "pounds": "lbf"},  # of force in a test
    **{"Newtons": "N", "Meters": "m", "Seconds": "s"},
    **{"秒": "s", "毫秒": "ms", "毫米": "mm", "千牛": "kN", "牛": "N", "℃": "C", "Sek": "s", "Sek.": "s"},
}
_SCALED = re.compile(
    r"(?:(?P<times>[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)\s*)?(?P<unit>[^\d\s/].*?)(?:/(?P<by>\d+\.?\d*))?"
)


def scaled_unit(text: str, units: Mapping[str, float]) -> float | None:
    """Return the factor of a unit, also of one with a number as `g/10` or `5 kN`; None: no unit.

    Args:
        units: factor to SI by unit.
    """
    if text in units:
        return units[text]
    match = _SCALED.fullmatch(text.strip())
    if match is None or match["unit"] not in units:
        return None
    factor = units[match["unit"]] * float(match["times"] or 1.0) / (float(match["by"] or 1.0) or float("inf"))
    return factor if factor != 0.0 else None


def names_quantity(header: str) -> bool:
    """Return whether a header names a quantity, with a unit or without."""
    if len(header) > _LONGEST:
        return False
    name = name_and_unit(header)[0]
    return quantity_of(name) is not None or other_quantity_of(name) is not None


def name_and_unit(header: str) -> tuple[str, str | None]:
    """Return name and unit of a header such as `force_kN`, `Axial Force (kN)`, `Load kN` or `time`."""
    if match := _BRACKETED.fullmatch(header):
        return match["name"], match["unit"].strip() or None
    name, _, unit = header.rpartition("_")
    if name and (quantity_of(name) or _is_unit(unit)):
        return name, unit
    name, _, unit = header.rpartition(" ")
    return (name, unit) if name and _is_unit(unit) else (header, None)


def quantity_of(name: str) -> str | None:
    """Return the quantity that a name means; None: another quantity."""
    plain = _BEFORE.sub("", name.strip().lower())
    return next((quantity for quantity, names in _NAMES.items() if plain in names), None)


def other_quantity_of(name: str) -> str | None:
    """Return the quantity of another name, or of the last word of a path as `Model Root/force`; None: no quantity."""
    plain = _BEFORE.sub("", name.strip().lower())
    found = next((quantity for quantity, names in _OTHER_NAMES.items() if plain in names), None)
    if found is None and "/" in plain:
        last = name_and_unit(plain.rpartition("/")[2])[0]
        return quantity_of(last) or other_quantity_of(last)
    return found


def _is_unit(text: str) -> bool:
    return any(spelled(text) in units for units in QUANTITIES.values())


def spelled(unit: str) -> str:
    """Return the spelling of a unit in `QUANTITIES`; an unknown unit stays as it is."""
    return _SPELLED.get(unit, unit)
