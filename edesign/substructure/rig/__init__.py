"""The rig: transfer functions, and what a record tells of it."""
