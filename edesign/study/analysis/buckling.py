"""Compression over the buckling resistance, of members that yield in compression in the analysis and do not buckle."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping

from edesign.archive.dataset import Group
from edesign.codes.ec3.buckling import NO_BUCKLING
from edesign.frame.devices import Device
from edesign.frame.frame_model import FrameModel
from edesign.frame.struts import Bar, Kind, Strut
from edesign.study.results.warnings import AnalysisWarning
from edesign.study.results.warnings import Kind as WarningKind

CLAUSE = "EN 1993-1-1, 6.3.1"
_PLURAL: Mapping[Kind, str] = {
    "column": "columns",
    "brace": "braces",
    "brace of a damper": "braces of dampers",
}
_WHY: Mapping[Kind, tuple[WarningKind, str]] = {
    "column": ("column_buckling", "buckling out of the plane of the frame is not in the analysis"),
    "brace": ("brace_buckling", "braces do not buckle in the analysis"),
    "brace of a damper": ("brace_buckling", "they stay elastic in the analysis"),
}
_ROUNDING = 1e-9  # relative, of a compression that equals the resistance


def slender_braces(frame: FrameModel) -> list[str]:
    """Return one sentence for each section of braces that buckle before they yield, or that cannot be judged.

    Args:
        frame: its model; with dampers their braces count too.
    """
    lines = []
    braces = (bar for bar in frame.bars if bar.kind != "column" and bar.compression)
    for (kind, section), bars in _alike(braces).items():
        known = {bar.name: bar.strut for bar in bars if bar.strut is not None}
        if not known:
            lines.append(f"{_PLURAL[kind]} of section `{section}` cannot be judged for buckling: it has no `inertia`")
            continue
        name = min(known, key=lambda name: known[name].resistance)
        if known[name].slenderness > NO_BUCKLING:
            lines.append(
                f"{_PLURAL[kind]} of section `{section}` do not buckle in the analysis; by {CLAUSE}, {name} does at "
                f"{_resistance(known[name])}"
            )
    return lines


def buckling_warnings(group: Group, frame: FrameModel) -> list[AnalysisWarning]:
    """Return a warning for each section of the members whose compression is beyond N_b,Rd in an analysis.

    Adds `column_buckling_resistance` and `brace_buckling_resistance` (N) to the group; nan where it is not known.

    Args:
        group: has the extremes of the axial forces, and of the forces of dampers.
    """
    bars = frame.bars
    compression: dict[tuple[Kind, str], float] = {}
    for kind in ("column", "brace"):
        lowest = group.variables.get(f"{kind}_axial_force_min")
        if lowest is not None:
            resistance = [math.nan if bar.strut is None else bar.strut.resistance for bar in bars if bar.kind == kind]
            label = f"N_b,Rd of the {kind} by {CLAUSE}, nan: not known, or not to be judged"
            group.add(f"{kind}_buckling_resistance", (kind,), resistance, "N", label)
            names = group.coords[kind].values
            compression |= {(kind, str(name)): -float(n) for name, n in zip(names, lowest.values, strict=True)}
    compression |= {("brace of a damper", name): force for name, force in _of_dampers(group, frame.devices).items()}
    found = []
    for (kind, section), several in _alike(bars).items():
        usage = {
            bar.name: compression[kind, bar.name] / bar.strut.resistance
            for bar in several
            if bar.strut is not None and (kind, bar.name) in compression
        }
        beyond = [name for name, ratio in usage.items() if ratio > 1.0 + _ROUNDING]
        if not beyond:
            continue
        worst = max(beyond, key=lambda name: usage[name])
        strut = next(bar.strut for bar in several if bar.name == worst)
        assert strut is not None
        warning, why = _WHY[kind]
        text = (
            f"{len(beyond)} of {len(several)} {_PLURAL[kind]} of section `{section}`: compression beyond the buckling "
            f"resistance by {CLAUSE}, most in {worst}, {1e-3 * compression[kind, worst]:.4g} kN "
            f"({_resistance(strut)}); {why}"
        )
        found.append(AnalysisWarning(warning, text, usage[worst]))
    return found


def _of_dampers(group: Group, devices: Iterable[Device]) -> dict[str, float]:
    """Largest compression of a brace of each damper that has one, N, by name of the damper."""
    highest, lowest = (group.variables.get(f"damper_force_{which}") for which in ("max", "min"))
    if highest is None or lowest is None:
        return {}
    found = {}
    for device, most, least in zip(devices, highest.values, lowest.values, strict=True):
        bar = device.brace_bar
        if bar is not None:
            found[device.name] = bar.share * max(-float(least), float(most) if bar.alternates else 0.0)
    return found


def _alike(bars: Iterable[Bar]) -> dict[tuple[Kind, str], list[Bar]]:
    """Bars by kind and section."""
    found: dict[tuple[Kind, str], list[Bar]] = {}
    for bar in bars:
        found.setdefault((bar.kind, bar.section), []).append(bar)
    return found


def _resistance(strut: Strut) -> str:
    """N_b,Rd and what it follows from."""
    length = f"buckling length {strut.length:.3g} m"
    if math.isinf(strut.squash):
        return f"N_cr = {1e-3 * strut.resistance:.4g} kN, {length}"
    return (
        f"N_b,Rd = {1e-3 * strut.resistance:.4g} kN of A f_y = {1e-3 * strut.squash:.4g} kN, {length}, "
        f"slenderness {strut.slenderness:.2f}"
    )
