"""Panel zones of beam-to-column joints."""

from __future__ import annotations

from edesign.project.base import Model
from edesign.project.selections import ALL_LINES, Lines, Numbers
from edesign.project.units import Hardening, PositiveLength


class PanelZones(Model):
    """Joints whose panel shears.

    Attributes:
        lines, floors: which joints.
        doubler: thickness of doubler plates, together.
        hardening: slope beyond the full shear over that before yield (0.03: Gupta & Krawinkler 1999).
    """

    lines: Lines = ALL_LINES
    floors: Numbers
    doubler: PositiveLength | None = None
    hardening: Hardening = 0.03
