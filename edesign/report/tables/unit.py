"""Units in which tables print what is kept in SI."""

from __future__ import annotations

from dataclasses import dataclass

from edesign.project.notation.units import STANDARD_GRAVITY


@dataclass(frozen=True)
class Unit:
    """A unit.

    Attributes:
        name: as printed in headers and files; "" for a number without unit.
        si: one of it in SI, such as 1e3 N for kN.
    """

    name: str
    si: float = 1.0

    @property
    def in_files(self) -> str:
        """The name in files, where `[-]` is no unit."""
        return "" if self.name == "-" else self.name


ONE = Unit("")
PERCENT = Unit("%", 0.01)
S, MS, HZ, YEARS = Unit("s"), Unit("ms", 1e-3), Unit("Hz"), Unit("years")
M, MM, CM = Unit("m"), Unit("mm", 1e-3), Unit("cm", 1e-2)
M2, CM2, MM2 = Unit("m2"), Unit("cm2", 1e-4), Unit("mm2", 1e-6)
CM3, CM4, CM6 = Unit("cm3", 1e-6), Unit("cm4", 1e-8), Unit("cm6", 1e-12)
M_S, MM_S, M_S2, G = Unit("m/s"), Unit("mm/s", 1e-3), Unit("m/s2"), Unit("g", STANDARD_GRAVITY)
N, KN, MN = Unit("N"), Unit("kN", 1e3), Unit("MN", 1e6)
KN_M, MN_M_RAD = Unit("kN m", 1e3), Unit("MN m/rad", 1e6)
KN_PER_M, KN_MM = Unit("kN/m", 1e3), Unit("kN/mm", 1e6)
PA, KPA, MPA, GPA = Unit("Pa"), Unit("kPa", 1e3), Unit("MPa", 1e6), Unit("GPa", 1e9)
J, KJ = Unit("J"), Unit("kJ", 1e3)
KG, T = Unit("kg"), Unit("t", 1e3)
RAD, MRAD, DEGC = Unit("rad"), Unit("mrad", 1e-3), Unit("degC")
