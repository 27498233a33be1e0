"""Dampers in a project file, and their designs in a study file."""
