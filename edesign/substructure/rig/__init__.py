"""The rig: transfer functions, and what a record shows of it."""
