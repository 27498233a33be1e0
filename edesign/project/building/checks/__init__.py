"""Cross checks of a building file: places that exist, loads, ends, dampers, values that are plausible."""
