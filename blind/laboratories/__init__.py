"""Blind tests with five programs of others, who had the pages on files and laws, and not the code. The list of effects
they had too, but for `wharf`. Their equations, motions, noise and draws are kept as they came; each folder has a
summary.md of its own."""

LABORATORIES = ("foundry", "harbour", "polytechnic", "proving", "wharf")
CATEGORIES = ("clean_F", "clean_H", "one_F", "one_H", "two_F", "two_H", "unlisted")
"""Of campaigns: how many effects are hidden, and the group of laws. F: Kelvin-Voigt and MGMM; H: all others."""
