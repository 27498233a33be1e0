"""Designs of hysteretic dampers: secants of their loops at the amplitude of the design, first mode, sizing."""
