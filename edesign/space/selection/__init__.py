"""Sections of a building chosen so that all checks are met with the least mass of steel."""
