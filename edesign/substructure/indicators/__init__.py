"""How well a rig followed its target: indicators of a test from uniformly sampled channels."""

from __future__ import annotations

from edesign.substructure.indicators.assessment import Tracking, definitions, tracking
from edesign.substructure.indicators.benchmark import BenchmarkCriteria, benchmark_criteria
from edesign.substructure.indicators.untold import Untold

__all__ = ["BenchmarkCriteria", "Tracking", "Untold", "benchmark_criteria", "definitions", "tracking"]
