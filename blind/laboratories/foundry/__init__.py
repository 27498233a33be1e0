"""The test house of a foundry, for dampers and bearings of any law. See summary.md."""
