"""The codes of the seismic action that edesign knows, by the name that a project file gives them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType

from edesign.codes.asce7.ground_motions import set_rules
from edesign.codes.ec8.action.accelerograms import SET_RULES
from edesign.codes.motion_sets import SetRules
from edesign.codes.names import unknown
from edesign.codes.ntc2018.accelerograms import ULTIMATE


@dataclass(frozen=True)
class Code:
    """An edition of a code for the seismic action.

    Attributes:
        name: as in a project file.
        title: for people.
        set_rules: for a set of motions, of ultimate limit states where the code distinguishes them.
    """

    name: str
    title: str
    set_rules: SetRules


codes: Mapping[str, Code] = MappingProxyType(
    {
        code.name: code
        for code in (
            Code("ec8-2004", "EN 1998-1:2004", SET_RULES),
            Code("ntc-2018", "NTC 2018", ULTIMATE),
            Code("asce7-16", "ASCE/SEI 7-16", set_rules("7-16")),
            Code("asce7-22", "ASCE/SEI 7-22", set_rules("7-22")),
        )
    }
)


def find_code(name: str) -> Code:
    """Return the code of a name.

    Args:
        name: such as "ec8-2004".

    Raises:
        InputError: there is no such code; the message names those there are.
    """
    if name not in codes:
        raise unknown("code", name, codes)
    return codes[name]
