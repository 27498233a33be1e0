"""Designs of viscous dampers: dashpots of the same energy at the amplitude of the design, their modes, sizing."""
