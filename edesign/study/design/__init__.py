"""Design of dampers: methods, distributions over the height, bounds, and the loop with time histories."""
