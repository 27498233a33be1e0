"""The search for a placement of dampers."""
