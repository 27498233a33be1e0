"""Damping of the storeys: its level, its kind, and friction."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from edesign.calibration.form import Values, share, size
from edesign.calibration.structures.building import KINDS, Building, DampingKind
from edesign.calibration.structures.effect import ChangedBuilding, Links, StructureForm
from edesign.calibration.structures.response import Link
from edesign.calibration.structures.sizes import StructureSizes, has_storeys

_STUCK = 1.0  # times the stiffness of a storey, that stands beside it until it slips


def _more(p: Values, building: Building) -> Building:
    return replace(building, damping=replace(building.damping, ratio=(1.0 + p["r"]) * building.damping.ratio))


def _of_kind(kind: DampingKind) -> Callable[[Values, Building], Building]:
    def change(p: Values, building: Building) -> Building:
        return replace(building, damping=replace(building.damping, other=kind, share=p["share"]))

    return change


def _friction(p: Values, building: Building) -> list[Link]:
    above = np.cumsum(building.masses[::-1])[::-1]
    links = []
    for i in building.storeys if p["F"] > 0.0 else ():
        k, force = _STUCK * float(building.stiffness[i]), p["F"] * float(above[i] / above[building.storeys[0]])
        links.append(Link(i, k, "elastic_plastic", (k, force, 0.0)))
    return links


def _is_another(kind: DampingKind) -> Callable[[StructureSizes], bool]:
    def is_another(s: StructureSizes) -> bool:
        if s.building.damping.other is not None:
            return False  # a mixture is declared already
        # of one mode all kinds are the same; Rayleigh's has the ratio in two of them, as modal damping has
        both, storeys = {kind, s.building.damping.kind}, len(s.building.storeys)
        return storeys > 1 and len(both) > 1 and (storeys > 2 or both != {"modal", "rayleigh"})

    return is_another


_LEVEL = StructureForm(
    "damping",
    "level",
    "structure",
    "damping ratio",
    "the height of resonances is wrong, of all modes alike (level) or of high modes the other way (kind)",
    "Chopra, Dynamics of Structures, 3.8, 11.3-11.4",
    (ChangedBuilding(_more),),
    lambda s: (size("r", "", 0.7, -0.95, 20.0),),
    lambda s: ((0.3,),),
    shown=lambda s: has_storeys(s) and not s.refit,
    meanings={
        "r": "share by which the damping ratio is more than declared; negative: less",
        "share": "of the damping that is of this kind",
        "F": "friction force of the lowest storey",
    },
)
_FRICTION = replace(
    _LEVEL,
    form="friction",
    title="friction in the storeys, in proportion to the mass above; F is that of the lowest",
    signature="small motions are damped more, and stiffer, than large ones; free vibration ends at once",
    mechanisms=(Links(_friction),),
    parameters=lambda s: (size("F", "N", 0.1 * s.storey_shear, 0.0, 2.0 * s.storey_shear),),
    starts=lambda s: tuple((part * s.storey_shear,) for part in (0.005, 0.05)),
    shown=has_storeys,
)
_OTHER = tuple(
    replace(
        _LEVEL,
        form=kind,
        title=f"{kind} damping in the place of a share of the declared one",
        mechanisms=(ChangedBuilding(_of_kind(kind)),),
        parameters=lambda _: (replace(share("share", 0.0, 1.0), whole=True),),
        starts=lambda _: ((0.5,),),
        shown=_is_another(kind),
    )
    for kind in KINDS
)

FORMS = (_LEVEL, *_OTHER, _FRICTION)
