"""The effects that `edesign calibrate` knows, for people: what each does, its forms and their parameters."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np

from edesign.calibrate.dampers.effect import Form
from edesign.calibrate.dampers.effects import MODULES
from edesign.calibrate.dampers.trial import Sizes
from edesign.calibrate.properties.reading import Reading
from edesign.calibrate.structure.building import Building
from edesign.calibrate.structure.damping import Damping
from edesign.calibrate.structure.effect import Setting
from edesign.calibrate.structure.effects import MODULES as STRUCTURAL_MODULES
from edesign.calibrate.unknown import Unknown
from edesign.damper.amendment_kinds import kind_if_known
from edesign.errors import InputError
from edesign.project.reading.problems import unknown_name

_USUAL = Sizes(
    force=50e3,
    displacement=6e-3,
    velocity=0.05,
    acceleration=0.5,
    duration=60.0,
    path=2.0,
    work=20e3,
    tests=6,
    fitted=(True,) * 6,
    period=2.0,
    temperatures=(10.0, 30.0),
    levels=3,
)
"""Of a campaign that shows all effects; names and units of parameters do not depend on it."""
_NUMBERED = re.compile(r"(?<=[ _])\d+$")  # of a storey, floor or test


@dataclass(frozen=True)
class EffectParameter:
    """A parameter of a form: `unit` in SI, `meaning` where law files carry it."""

    name: str
    unit: str
    meaning: str = ""


@dataclass(frozen=True)
class EffectForm:
    """A form of an effect.

    Attributes:
        form: its name; N in it stands for a number of a storey, floor or test.
        title: what it is.
        in_law_files: whether law files and projects carry it.
        parameters: what a calibration finds; () if there is only what is each test's own.
        source: paper, book.
    """

    form: str
    title: str
    in_law_files: bool
    parameters: tuple[EffectParameter, ...]
    source: str


@dataclass(frozen=True)
class KnownEffect:
    """An effect.

    Attributes:
        name: of it.
        tests: in what it may be found: tests of dampers, records of structures, property tables.
        kind: whose it is: damper, rig, instrument, structure.
        signature: what it leaves in the residual of a model without it.
        forms: equations for it.
        page: of the documentation.
    """

    name: str
    tests: str
    kind: str
    signature: str
    forms: tuple[EffectForm, ...]
    page: str


def known_effects() -> tuple[KnownEffect, ...]:
    """Return all effects: those of tests of dampers, of property tables, and of records of structures."""
    pages = "docs/reference/effects"
    found = []
    for module in MODULES:
        own = list(_with_finer(kind() for kind in module.FORMS))
        own += [form for form in getattr(module, "forms_of", lambda _: ())(_USUAL) if not form.in_place_of_gamma]
        found.append(_known("tests of dampers", own, f"{pages}/{own[0].name}.md"))
    readings: dict[str, list[Any]] = {}
    for kind in _below(Reading):
        readings.setdefault(kind.name, []).append(kind())
    found += [_known("property tables", forms, "docs/results/thesis_residual.md") for forms in readings.values()]
    structural: dict[str, list[Any]] = {}
    for module in STRUCTURAL_MODULES:
        for setting in _settings():
            for form in module.forms(setting):
                structural.setdefault(form.name, []).append(form)
    found += [_known("records of structures", forms, f"{pages}/structures.md") for forms in structural.values()]
    return tuple(found)


def effects_named(name: str) -> tuple[KnownEffect, ...]:
    """Return the effects of a name: of dampers and of structures, some have the same.

    Raises:
        InputError: there is none; tells the nearest name.
    """
    every = known_effects()
    found = tuple(effect for effect in every if effect.name == name)
    if not found:
        raise InputError(unknown_name("effect", name, dict.fromkeys(effect.name for effect in every)))
    return found


def _known(tests: str, forms: Iterable[Any], page: str) -> KnownEffect:
    """An effect by its forms, those that differ by a number once."""
    forms = list(forms)
    listed: dict[str, EffectForm] = {}
    for form in forms:
        name = _NUMBERED.sub("N", form.form)
        if name in listed:
            continue
        kind = kind_if_known(*_carried(form))
        meanings = {one.name: one.meaning for one in kind.parameters} if kind is not None else {}
        listed[name] = EffectForm(
            name,
            _NUMBERED.sub("N", form.title),
            kind is not None,
            tuple(EffectParameter(one.name, one.unit, meanings.get(one.name, "")) for one in _unknowns(form)),
            form.source,
        )
    first = forms[0]
    signatures = dict.fromkeys(form.signature for form in forms)
    return KnownEffect(first.name, tests, first.kind, "; or ".join(signatures), tuple(listed.values()), page)


def _carried(form: Any) -> tuple[str, str]:
    """Effect and form by which law files carry a form; "" if they do not."""
    if isinstance(form.amendment, str):  # of a structure: in the law file of its isolation layer
        name, _, carried = form.amendment.partition(".")
        return name, carried
    return form.name, getattr(form, "amendment_form", form.form) if form.amendment else ""


def _unknowns(form: Any) -> tuple[Unknown, ...]:
    setting = _USUAL if not hasattr(form, "links") else _settings()[0]
    return tuple(form.unknowns(setting))


def _settings() -> tuple[Setting, ...]:
    """Buildings that show all effects: with isolators under them, and without."""
    n = 3
    damping = Damping("modal", 0.03)
    storeys = np.full(n, 50e6), np.zeros(n)
    return tuple(
        Setting(
            Building(np.full(n, 100e3), storeys[0], damping, storeys[1], isolated, 3.0 * np.arange(1, n + 1)),
            np.full(n, 0.01),
            0.6,
            0.01,
            frozenset(("acceleration", "displacement")),
        )
        for isolated in (False, True)
    )


def _with_finer(forms: Iterable[Form]) -> Iterator[Form]:
    """Forms, and after each those of their own that are sought where it was found; no variants of it."""
    for form in forms:
        yield form
        yield from _with_finer(one for one in form.finer() if "form" not in vars(one))


def _below(kind: type[Reading]) -> Iterator[type[Reading]]:
    """Classes below another that have a form of their own."""
    for one in kind.__subclasses__():
        if "form" in vars(one):
            yield one
        yield from _below(one)
