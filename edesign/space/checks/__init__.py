"""Checks of the effects: EN 1993-1-1 for members, EN 1998-1 for the building."""
