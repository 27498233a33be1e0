"""Campaigns of a fifth laboratory: the habits of rigs, faults of single tests, shapes that nobody has in a list."""
