"""What the loop found in a property table: what it found in tests, and the properties at each stage."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from edesign.calibrate.properties.campaign import PropertyCampaign
from edesign.calibrate.result import Calibration, Stage
from edesign.damper.amendments import Amendment
from edesign.damper.temperature import GammaT
from edesign.damper.testing.steady_state import PropertyRows


@dataclass(frozen=True, eq=False)
class CorrectedLaw:
    """The law as a law file carries it.

    Attributes:
        values: all its parameters, SI.
        effects: beside or on it.
        gamma_T: how it changes with temperature; None: it does not.
        left_out: what a law file cannot carry, or what is no part of the damper, for people.
    """

    values: Mapping[str, float]
    effects: tuple[Amendment, ...]
    gamma_T: GammaT | None
    left_out: tuple[str, ...]


@dataclass(frozen=True, eq=False)
class PropertyCalibration:
    """What the loop found in a property table.

    Attributes:
        found: errors as mean squares of relative errors of G', G_eq and loss factor, effects, verdict; without series.
        campaign: table, law and groups of rows.
        rows: properties of all rows by stage.
        law: the corrected one.
        noise: relative standard deviation of a property.
    """

    found: Calibration
    campaign: PropertyCampaign
    rows: Mapping[Stage, PropertyRows]
    law: CorrectedLaw
    noise: float
