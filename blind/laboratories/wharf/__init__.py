"""A test house on a wharf: old rigs, their habits and faults, for devices of any law. See summary.md."""
