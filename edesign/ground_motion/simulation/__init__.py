"""Simulated records in place of recordings that a user does not have: Boore's stochastic point-source method."""

from __future__ import annotations

from edesign.ground_motion.simulation.parameters import SINGLE_CORNER, WESTERN_NORTH_AMERICA, Crust
from edesign.ground_motion.simulation.simulate import simulate

__all__ = ["SINGLE_CORNER", "WESTERN_NORTH_AMERICA", "Crust", "simulate"]
