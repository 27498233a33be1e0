"""ASCE/SEI 7-16: structures with damping systems."""

from edesign.codes.asce7.damping_devices import largest_property_factor, smallest_property_factor

__all__ = ["largest_property_factor", "smallest_property_factor"]
