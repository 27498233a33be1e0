"""The building as a frame in space: members, loads, masses, and its model."""
