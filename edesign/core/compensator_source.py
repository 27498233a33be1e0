"""Compensators as C: the header that the core was built with, and the parameters as an initialiser in C99."""

from __future__ import annotations

import math
from dataclasses import dataclass
from importlib import resources
from typing import Any

from edesign.core._edcore import ffi, lib
from edesign.core.compensator import LONGEST_WINDOW, MEMORY, Compensator, compensator_parameters

HEADER = "edcompensator.h"
_KINDS = ("ED_COMPENSATE_LINEAR", "ED_COMPENSATE_LIVE_DELAY", "ED_COMPENSATE_ATS", "ED_COMPENSATE_MODIFIED_ATS")
_SIGNALS = ("ED_OF_TARGET", "ED_OF_VELOCITY", "ED_OF_ACCELERATION", "ED_OF_MEASURED", "ED_OF_COMMAND")
_NAMES = {
    "kind": {getattr(lib, name): name for name in _KINDS},
    "of": {getattr(lib, name): name for name in _SIGNALS},
}
"""Of the members of structs that hold a constant of an enumeration."""


@dataclass(frozen=True)
class Sizes:
    """Sizes that the header leaves open and a compensator needs.

    Attributes:
        memory: ED_COMPENSATOR_MEMORY, main steps, a power of 2.
        window: ED_COMPENSATOR_WINDOW, main steps.
    """

    memory: int
    window: int

    @property
    def state(self) -> int:
        """Bytes of ed_compensator where `double` and `long` are as on this machine."""
        signals = int(lib.ED_OF_SIGNALS)
        of_memory, of_window = signals * ffi.sizeof("double"), 4 * ffi.sizeof("double")
        saved = of_memory * (MEMORY - self.memory) + of_window * (LONGEST_WINDOW - self.window)
        return int(ffi.sizeof("ed_compensator")) - saved

    @property
    def parameters(self) -> int:
        """Bytes of ed_compensator_parameters where `double` and `long` are as on this machine."""
        return int(ffi.sizeof("ed_compensator_parameters"))


def header_text() -> str:
    """Return edcompensator.h as it is installed.

    In the source tree it is a symbolic link to core_c/include, from which the core is built, and a built package has
    the file itself: there is one source, and one place to read it from.
    """
    return resources.files("edesign.core").joinpath(HEADER).read_text(encoding="utf-8")


def least_sizes(compensator: Compensator, step: float) -> Sizes:
    """Return the least sizes with which a compensator does the same as with those of the core.

    Args:
        step: main step, s.
    """
    parameters = compensator_parameters(compensator, step)
    back = 0
    if parameters.kind == lib.ED_COMPENSATE_LINEAR:
        counted = ((parameters.n_terms, parameters.term), (parameters.n_force_terms, parameters.force_term))
        back = max((terms[i].lag for count, terms in counted for i in range(count)), default=0)
    elif parameters.kind == lib.ED_COMPENSATE_LIVE_DELAY:
        back = math.floor(parameters.order * parameters.largest_delay / step) + 2  # it looks between two samples
    memory = 1 << back.bit_length()
    return Sizes(min(memory, MEMORY), max(int(parameters.window), 1))


def initialiser(compensator: Compensator, step: float) -> str:
    """Return the parameters of a compensator as an initialiser of ed_compensator_parameters.

    Floating-point numbers are hexadecimal, so that every compiler reads the same bits; the decimal number stands
    beside. Members that are 0 are left out.

    Args:
        step: main step, s.
    """
    parameters = compensator_parameters(compensator, step)
    return _value(parameters[0], ffi.typeof("ed_compensator_parameters"), "  ")


def hexadecimal(value: float) -> str:
    """Return a number as C99 reads it to the same bits.

    Raises:
        ValueError: it is not a number.
    """
    if math.isnan(value):
        raise ValueError("not a number cannot be written as C")
    if math.isinf(value):
        return "INFINITY" if value > 0.0 else "-INFINITY"
    return float(value).hex()


def _value(value: Any, of: Any, indent: str, name: str = "") -> str:
    if of.kind == "struct":
        return _struct(value, of, indent)
    if of.kind == "array":
        return _array([_value(value[i], of.item, indent + "  ") for i in range(_used(value, of))], of, indent)
    if of.cname == "double":
        return f"{hexadecimal(value)} /* {value:.10g} */"
    return _NAMES[name][value] if name in _NAMES else str(int(value))


def _array(elements: list[str], of: Any, indent: str) -> str:
    """Numbers in one line, what has elements or members of its own on lines."""
    if of.item.kind == "primitive" or not elements:
        return "{" + (", ".join(elements) or "0") + "}"
    return "{\n" + ",\n".join(indent + element for element in elements) + f"\n{indent[:-2]}}}"


def _struct(value: Any, of: Any, indent: str) -> str:
    """On lines of their own where it holds arrays, else in one."""
    wide = any(field.type.kind == "array" for _, field in of.fields)
    members = [
        f".{name} = {_value(getattr(value, name), field.type, indent + '  ', name)}"
        for name, field in of.fields
        if name in _NAMES or not _is_zero(getattr(value, name), field.type)
    ]
    if not wide:
        return "{" + ", ".join(members) + "}"
    return "{\n" + ",\n".join(indent + member for member in members) + f"\n{indent[:-2]}}}"


def _is_zero(value: Any, of: Any) -> bool:
    if of.kind == "struct":
        return all(_is_zero(getattr(value, name), field.type) for name, field in of.fields)
    if of.kind == "array":
        return _used(value, of) == 0
    return bool(value == 0) and math.copysign(1.0, value) > 0.0


def _used(values: Any, of: Any) -> int:
    """Number of elements up to the last one that is not 0."""
    count = int(of.length)
    while count and _is_zero(values[count - 1], of.item):
        count -= 1
    return count
