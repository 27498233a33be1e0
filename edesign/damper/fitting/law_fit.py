"""Fit a damper law to what was measured, whatever that is."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, TypedDict, Unpack

from edesign.damper.fitting.coordinates import Bounds
from edesign.damper.fitting.fit import Fit
from edesign.damper.fitting.forces import fit_forces
from edesign.damper.fitting.loading import Predict
from edesign.damper.fitting.property_fit import PropertyColumns, Quantity, fit_properties
from edesign.damper.fitting.solve import Loss, Progress
from edesign.damper.fitting.thermal import ThermalKind
from edesign.damper.law import Law
from edesign.damper.laws import law as law_of
from edesign.damper.testing.campaign import Campaign, load_campaign
from edesign.damper.testing.measured_histories import DamperTest
from edesign.damper.testing.specimen import Specimen
from edesign.errors import InputError


class FitOptions(TypedDict, total=False):
    """Options of `fit_forces` and `fit_properties`, which describe them.

    `weights` and `predict` are of forces alone; `quantities`, `cycles` and `samples` of properties alone.
    """

    bounds: Bounds | None
    fixed: Mapping[str, float] | Sequence[str]
    fit_also: Sequence[str]
    loss: Loss
    starts: int
    seed: int
    temperature: ThermalKind | None
    reference_C: float | None
    branches: int
    workers: int
    progress: Progress | None
    weights: Mapping[str, float] | None
    predict: Predict | None
    quantities: Sequence[Quantity]
    cycles: tuple[int, int]
    samples: int


def fit_law(
    law: Law | str,
    measured: Campaign | Path | str | Sequence[DamperTest] | PropertyColumns,
    start: Mapping[str, float] | None = None,
    *,
    specimen: Specimen | None = None,
    **options: Unpack[FitOptions],
) -> Fit:
    """Fit a damper law to measured forces, or to a table of properties.

    Args:
        law: the law, or its name.
        measured: a campaign or its file, of which the tests for fitting are used; tests with forces; or the properties
            of steady sinusoidal tests (`PropertyTable`).
        start: values to start from, SI; those not given come from the data.
        specimen: the layers that were tested; properties need them, forces only for the tested range as strain.
            That of a campaign by default.
        options: of `fit_forces` or of `fit_properties`, such as `fixed`, `bounds`, `starts`, `temperature`, `workers`.

    Returns:
        The fitted parameters with their uncertainty, and the errors of each test.

    Raises:
        InputError: something is wrong with law, data or options, or the data cannot carry so many parameters.
        AnalysisError: the law gives no force at the start.

    Source: thesis Eqs. 4.30 to 4.32.

    Examples:
        A spring of 2 kN/mm beside a dashpot of 0.04 kN s/mm, in a test of two sinusoidal cycles of 10 mm:

        >>> import numpy as np
        >>> from edesign.damper.testing.measured_histories import DamperTest
        >>> time = np.linspace(0.0, 2.0, 401)
        >>> u, v = 0.01 * np.sin(np.pi * time), 0.01 * np.pi * np.cos(np.pi * time)
        >>> fit = edesign.fit_law("kelvin_voigt", [DamperTest("sine", time, u, 2e6 * u + 4e4 * v)])
        >>> {name: f"{value:.3g}" for name, value in fit.values.items()}
        {'k': '2e+06', 'c': '4e+04'}
    """
    known = law_of(law) if isinstance(law, str) else law
    given: dict[str, Any] = {**options}
    of = load_campaign(measured) if isinstance(measured, Path | str) else measured
    if isinstance(of, Campaign):
        specimen = of.specimen if specimen is None else specimen
        of = of.used_for("fit")
    if isinstance(of, Sequence):
        return fit_forces(known, of, start, specimen=specimen, **given)
    if specimen is None:
        raise InputError(f"{known.name}: a fit to properties needs the specimen, whose layers they are of [E-FIT-06]")
    return fit_properties(known, of, specimen, start, **given)
