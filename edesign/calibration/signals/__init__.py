"""Measured channels: how they were sampled, what noise they have, and a motion without it."""
