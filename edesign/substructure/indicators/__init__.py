"""How well a rig followed its target: indicators of a test from uniformly sampled channels."""

from __future__ import annotations

from edesign.substructure.indicators.assessment import Tracking, definitions, tracking
from edesign.substructure.indicators.undetermined import Undetermined

__all__ = ["Tracking", "Undetermined", "definitions", "tracking"]
