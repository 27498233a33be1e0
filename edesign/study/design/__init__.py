"""Design of dampers: device model, methods, distributions over the height, bounds, loop with time histories."""
