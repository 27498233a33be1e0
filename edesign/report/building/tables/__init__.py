"""The elastic design of a building as tables."""
