"""The effects that `edesign calibrate` knows, for people: what each does, its forms and their parameters."""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from edesign.calibration.dampers.effect import EffectForm
from edesign.calibration.dampers.effects import forms as damper_forms
from edesign.calibration.dampers.mechanisms import Placement
from edesign.calibration.dampers.sizes import Condition, Sizes
from edesign.calibration.properties import arrangement, reading
from edesign.calibration.results.law_file import form_in_law_files, parameters_in_law_files
from edesign.calibration.structures.building import Building, Damping
from edesign.calibration.structures.corrected import STRUCTURE, where_carried
from edesign.calibration.structures.effect import StructureForm
from edesign.calibration.structures.effects import forms as structure_forms
from edesign.calibration.structures.sizes import StructureSizes
from edesign.errors import InputError
from edesign.project.reading.problems import unknown_name

_USUAL = Sizes(
    force=50e3,
    displacement=6e-3,
    velocity=0.05,
    acceleration=0.5,
    rms=25e3,
    duration=60.0,
    total=300.0,
    path=2.0,
    work=20e3,
    tests=6,
    fitted=(True,) * 6,
    period=2.0,
    temperatures=(10.0, 30.0),
    levels=4,
    tones=(50.0, 100.0),
    conditions=(Condition.of("Q", (1.0, 2.0, 3.0), (1.0, 2.0, 3.0)),),
)
"""Of a campaign that shows all effects; names and units of parameters do not depend on it."""
_PAGES = "docs/reference/effects"
_NUMBERED = re.compile(r"(?<=[ _])\d+$")  # of a storey, floor or test


@dataclass(frozen=True)
class KnownParameter:
    """A parameter of a form: `unit` in SI, `meaning` for people."""

    name: str
    unit: str
    meaning: str = ""


@dataclass(frozen=True)
class KnownForm:
    """A form of an effect.

    Attributes:
        form: its name; N in it stands for a number of a storey, floor or test.
        title: what it is.
        placements: where of the law it acts: whole, inside, springs, dashpots; () of what is no part of the law.
        in_law_files: whether law files and projects carry it.
        parameters: what a calibration finds; () if there are only nuisance amplitudes.
        source: paper, book.
        laws: names of the laws that it is made for; (): all.
    """

    form: str
    title: str
    placements: tuple[str, ...]
    in_law_files: bool
    parameters: tuple[KnownParameter, ...]
    source: str
    laws: tuple[str, ...] = ()


@dataclass(frozen=True)
class KnownEffect:
    """An effect.

    Attributes:
        name: of it.
        tests: in what it may be found: tests of dampers, records of structures, property tables.
        kind: whose it is: damper, rig, instrument, structure.
        or_kind: whose else it may be by the same equation, which force and motion cannot tell; "": nobody's.
        signature: what it leaves in the residual of a model without it.
        forms: equations for it.
        page: of the documentation.
    """

    name: str
    tests: str
    kind: str
    or_kind: str
    signature: str
    forms: tuple[KnownForm, ...]
    page: str


def known_effects() -> tuple[KnownEffect, ...]:
    """Return all effects: those of tests of dampers, of property tables, and of records of structures."""
    own = _by_name(damper_forms(_USUAL))
    tables = _by_name((*arrangement.FORMS, *reading.FORMS))
    structural = _by_name(form for setting in _settings() for form in structure_forms(setting))
    return (
        *(_known("tests of dampers", forms, f"{_PAGES}/{name}.md", _USUAL) for name, forms in own.items()),
        *(_known("property tables", forms, f"{_PAGES}/tables.md", _USUAL) for forms in tables.values()),
        *(
            _known("records of structures", forms, f"{_PAGES}/structures.md", _settings()[0])
            for forms in structural.values()
        ),
    )


def effects_named(name: str) -> tuple[KnownEffect, ...]:
    """Return the effects of a name: of dampers and of structures, some have the same.

    Raises:
        InputError: there is none; names the nearest one.
    """
    every = known_effects()
    found = tuple(effect for effect in every if effect.name == name)
    if not found:
        raise InputError(unknown_name("effect", name, dict.fromkeys(effect.name for effect in every)))
    return found


def _by_name(forms: Iterable[Any]) -> dict[str, list[Any]]:
    found: dict[str, list[Any]] = {}
    for form in forms:
        found.setdefault(form.name, []).append(form)
    return found


def _known(tests: str, forms: list[Any], page: str, sizes: Any) -> KnownEffect:
    """An effect by its forms; those that differ by a number or by where they act once."""
    listed: dict[str, KnownForm] = {}
    for form in forms:
        name, placement = _placed(form)
        known = listed.get(name)
        if known is None:
            carried = form_in_law_files(form) if isinstance(form, EffectForm) else _by_layer(form)
            known_there = parameters_in_law_files(form) if carried and isinstance(form, EffectForm) else {}
            meanings = {**form.meanings, **{name: one.meaning for name, one in known_there.items()}}
            listed[name] = KnownForm(
                name,
                _NUMBERED.sub("N", form.title),
                (placement,) if placement else (),
                carried,
                tuple(KnownParameter(one.name, one.unit, meanings.get(one.name, "")) for one in form.parameters(sizes)),
                form.source,
                getattr(form, "laws", ()),
            )
        elif placement not in known.placements:
            listed[name] = replace(known, placements=(*known.placements, placement))
    first = forms[0]
    signatures = "; or ".join(dict.fromkeys(form.signature for form in forms))
    other = "" if first.twin is None else first.twin.kind
    return KnownEffect(first.name, tests, first.kind, other, signatures, tuple(listed.values()), page)


def _by_layer(form: Any) -> bool:
    """Whether a law file of an isolation layer carries a form of an effect of a structure."""
    return isinstance(form, StructureForm) and where_carried(form) not in ("", STRUCTURE)


def _placed(form: Any) -> tuple[str, str]:
    """Name of a form without the placement in it, N for a number in it, and the placement; "" if it has none."""
    name = _NUMBERED.sub("N", form.form)
    if isinstance(form, EffectForm):
        for placement in {mechanism.placement for mechanism in form.core_effects} - {Placement.WHOLE}:
            if name.endswith(f"_{placement.value}"):
                return name.removesuffix(f"_{placement.value}"), placement.value
        if form.core_effects:
            return name, form.core_effects[0].placement.value
    return name, ""


def _settings() -> tuple[StructureSizes, ...]:
    """Buildings that show all effects: of each two kinds of damping, and with isolators under them."""
    n = 3
    heights = 3.0 * np.arange(1, n + 1)

    def building(damping: Damping, isolated: bool) -> StructureSizes:
        frame = Building(np.full(n, 100e3), np.full(n, 50e6), damping, np.zeros(n), isolated, heights)
        return StructureSizes(
            frame, np.full(n, 0.01), 0.6, 0.01, frozenset(("acceleration", "displacement")), refit=False
        )

    return (
        building(Damping("modal", 0.03), False),
        building(Damping("rayleigh", 0.03), False),
        building(Damping("modal", 0.03), True),
    )
